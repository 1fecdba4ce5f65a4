"""A case computed again on an independent route, row by row beside our own numbers."""

from math import nan
from typing import NamedTuple

from drivewright import registry
from drivewright.errors import DrivewrightError, InputError, MissingExtra, SolverError
from drivewright.runner import failure_reason, run
from drivewright.spec import MechanismSpec


class Comparison(NamedTuple):
    """One number by both routes [SI]; they agree when they differ by no more than `allowed`.

    left_out: why there are no numbers, where the route is not to be had; extra: what to install where only that is missing.
    """

    name: str
    ours: float
    other: float
    unit: str
    allowed: float
    route: str
    left_out: str = ""
    extra: str = ""

    @property
    def ok(self) -> bool:
        """Whether both routes agree, where both are there; a number that does not exist (nan) agrees with nothing."""
        return bool(self.left_out) or abs(self.other - self.ours) <= self.allowed


def verify(spec: MechanismSpec) -> tuple[Comparison, ...]:
    """Tuple of `Comparison`: the default analyses of a spec against its kind's independent route.

    A kind's `verify(model, result)` gives the rows as tuples (name, ours, other, unit, allowed, route), and a `registry.LeftOut` for what
    it cannot compare.
    InputError where the kind has none, MissingExtra where the route needs an optional dependency, SolverError where it fails or where the
    run lacks what it compares with.
    """
    mechanism = registry.mechanism(spec.mechanism)
    if mechanism.verify is None:
        able = [kind for kind in registry.kinds() if registry.mechanism(kind).verify]
        raise InputError(f"mechanism '{mechanism.kind}' has no independent route to verify it by; kinds that have one: {', '.join(able)}")
    model = mechanism.build(spec)
    result = run(spec, model=model)
    try:
        return tuple(_comparison(row) for row in mechanism.verify(model, result))
    except MissingExtra:
        raise
    except Exception as error:
        if isinstance(error, DrivewrightError) and not result.provenance["failed"]:
            raise
        lacking = [f"the run lacks {', '.join(result.provenance['failed'])}"] if result.provenance["failed"] else []
        raise SolverError("; ".join([f"the independent route failed: {failure_reason(spec, error)}", *lacking])) from error


def _comparison(row: registry.Row | registry.LeftOut) -> Comparison:
    if isinstance(row, registry.LeftOut):
        return Comparison(row.name, nan, nan, "-", nan, "", row.reason, row.extra)
    return Comparison(*row)
