"""A case computed again on an independent route, row by row beside our own numbers."""

from typing import NamedTuple

from drivewright import registry
from drivewright.errors import InputError
from drivewright.runner import run


class Comparison(NamedTuple):
    """One number by both routes [SI]; they agree when they differ by no more than `allowed`."""

    name: str
    ours: float
    other: float
    unit: str
    allowed: float
    route: str

    @property
    def ok(self):
        """Whether both routes agree; a number that does not exist (nan) agrees with nothing."""
        return abs(self.other - self.ours) <= self.allowed


def verify(spec):
    """Tuple of `Comparison`: the default analyses of a spec against its kind's independent route.

    A kind's `verify(model, result)` gives the rows as tuples (name, ours, other, unit, allowed, route).
    InputError where the kind has none, MissingExtra where the route needs an optional dependency.
    """
    mechanism = registry.mechanism(spec.mechanism)
    if mechanism.verify is None:
        able = [kind for kind in registry.kinds() if registry.mechanism(kind).verify]
        raise InputError(f"mechanism '{mechanism.kind}' has no independent route to verify it by; kinds that have one: {', '.join(able)}")
    model = mechanism.build(spec)
    return tuple(Comparison(*row) for row in mechanism.verify(model, run(spec, model=model)))
