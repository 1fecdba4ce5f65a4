"""The rolling bearings under the shaft's load: stiffness with the load behind it, load distribution, pressure, lives."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright import bearings, shafts
from drivewright.bearings import BearingEquilibrium
from drivewright.bearings.tables import duty_table, element_table, load_curve_tables
from drivewright.bearings.values import DutyCase, bearing_findings, life_values, load_values, spectrum_values, system_values
from drivewright.errors import InputError, SolverError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.refusals import duty_speed, is_rolling
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Answer, Answers, Check, Table, Value
from drivewright.shafts.values import stiffness_values

FELT = 1e-3  # of a preload: axial force in the bearing from which it has an effect
SEAT = 0.005  # of the diameter: what a seat and a bore may differ by
FACTORS = np.geomspace(0.02, 4.0, 25)  # of the curve of stiffness, over the bearing's load


def no_rolling(spec: ShaftSpec) -> str | None:
    """Why there is nothing to say of rolling bearings."""
    return None if any(is_rolling(b) or b.table or b.radial_clearance for b in spec.bearings) else "all bearings are linear springs"


def rolling(model: ShaftModel, done: Answers) -> Answer:
    """Every bearing that is not linear, at the equilibrium of the loads; `data` are the states of the loaded rolling bearings by name."""
    at_rest: shafts.ShaftEquilibrium = done["statics"].data.equilibrium
    values, tables, checks, findings = {}, [], [], []
    for number, mount in enumerate(at_rest.model.mounts):
        name = mount.support.name
        if mount.support.law is None or name in model.sprung:
            continue
        stiffness = stiffness_values(name, shafts.support_stiffness(at_rest, number, model.direction))
        values |= stiffness
        if not stiffness:
            findings.append(f"stiffness of bearing {name!r} is absent: it carries no load")
    findings += [*_catalogue_findings(model), *_axial_findings(model, at_rest)]
    states = _states(model, at_rest)
    findings += [f"bearing {name!r} carries no load" for name in model.rolling if name not in states]
    findings += _preload_findings(model, states)
    for name, state in states.items():
        values |= load_values(name, state)
        tables += [element_table(state, name), *load_curve_tables(state, name, FACTORS)]
        checks += [] if model.spec.duty else _static_checks(model, name, state)
    lives, life_tables, life_findings = _duty_lives(model, states, checks) if model.spec.duty else _lives(model, states)
    values |= lives | system_values({name: model.rolling[name] for name in states}, lives)
    checks += _life_checks(model, lives)
    return Answer(values, (*tables, *life_tables), tuple(checks), (*findings, *life_findings), data=states)


def _catalogue_findings(model: ShaftModel) -> Iterator[str]:
    """What is estimated of the bearings, and ratings that contradict their dimensions."""
    for bearing in model.spec.bearings:
        own = model.rolling.get(bearing.name)
        if own is None:
            continue
        if bearing.bearing is not None:
            entry, given = bearings.entry(str(bearing.bearing), model.spec.catalogue), (bearing.dynamic_rating, bearing.static_rating)
            yield from bearings.catalogue_findings(bearing.name, str(bearing.bearing), entry, *(each is not None for each in given))
            yield from _bore_findings(model, bearing.name, bearing.position, entry.bore)
        if bearing.envelope is not None:
            yield from _bore_findings(model, bearing.name, bearing.position, bearing.envelope.bore)
        yield from bearings.rating_findings(bearing.name, own)


def _bore_findings(model: ShaftModel, name: str, position: float, bore: float | None) -> Iterator[str]:
    """Where the bore of a bearing is none of the diameters that the shaft has at its seat."""
    seats = shafts.diameters_at(model.shaft, position)
    if bore and not any(abs(bore - seat) <= SEAT * seat for seat in seats):
        found = " or ".join(f"{1e3 * seat:.6g} mm" for seat in seats)
        yield f"bearing {name!r} has a bore of {1e3 * bore:g} mm, and the shaft has {found} at its seat; take the bearing of that bore"


def _axial_findings(model: ShaftModel, at_rest: shafts.ShaftEquilibrium) -> Iterator[str]:
    """Where nothing holds a shaft on rolling bearings along its axis."""
    if model.rolling and shafts.slides_freely(at_rest):
        yield (
            "no bearing locates the shaft along its axis, which is correct only where gears or couplings do; take a locating bearing, or "
            "give one an axial_stiffness"
        )


def _preload_findings(model: ShaftModel, states: Mapping[str, BearingEquilibrium]) -> Iterator[str]:
    """Preloads that nothing answers: another bearing has to take them."""
    for bearing in model.spec.bearings:
        state = states.get(bearing.name)
        if bearing.preload and state is not None and abs(state.force[2]) < FELT * bearing.preload:
            yield (
                f"the preload of bearing {bearing.name!r} has no effect: no other bearing takes it, and the shaft moves freely; "
                "preload it against a bearing that takes the opposite force"
            )


def _states(model: ShaftModel, at_rest: shafts.ShaftEquilibrium) -> dict[str, BearingEquilibrium]:
    """The rolling bearings that carry something, by name."""
    return {
        mount.support.name: bearings.solve(model.rolling[mount.support.name], displacement=shafts.bearing_displacement(at_rest, number))
        for number, mount in enumerate(at_rest.model.mounts)
        if mount.support.name in model.rolling and not shafts.is_idle(at_rest, number)
    }


# -- lives ---------------------------------------------------------------------------------------------------------------------


def _lives(model: ShaftModel, states: Mapping[str, BearingEquilibrium]) -> tuple[dict[str, Value], list[Table], list[str]]:
    """(values, tables, findings) of the lives under the loads at the speed of the shaft."""
    speed, lubrication, values, findings = model.spec.drive.speed if model.spec.drive else None, model.spec.lubrication, {}, []
    for name, state in states.items():
        values |= life_values(name, state, speed, lubrication)
        findings += bearing_findings(name, state, speed, lubrication)
    return values, [], [*findings, *_lubrication_findings(model, values)]


def _lubrication_findings(model: ShaftModel, values: Mapping[str, Value]) -> Iterator[str]:
    """What the modified lives assume, where there are any."""
    if any(name.endswith(".modified_life") for name in values):
        yield from bearings.lubrication_findings(model.spec.lubrication)


def _duty_lives(
    model: ShaftModel, given: Mapping[str, BearingEquilibrium], checks: list[Check]
) -> tuple[dict[str, Value], list[Table], list[str]]:
    """The same over the duty cycle: the shaft once more at rest in every case, each with its part of the loads; `checks` get the static
    ones of the largest load, that `given` in the spec among them."""
    try:
        cases = [
            _states(model, shafts.apply_loads(model.shaft, shafts.scaled_loads(model.loads, c.load)).equilibrium) for c in model.spec.duty
        ]
    except (InputError, SolverError) as error:
        return {}, [], [f"lives over the duty cycle are absent: {error}"]
    values, tables, findings, lubrication = {}, [], [], model.spec.lubrication
    for name, bearing in model.rolling.items():
        rows = [
            DutyCase(case.share, duty_speed(model.spec, case), states.get(name) or _idle(bearing))
            for case, states in zip(model.spec.duty, cases, strict=True)
        ]
        values |= spectrum_values(name, rows, lubrication)
        tables.append(duty_table(rows, name, [case.name or str(n) for n, case in enumerate(model.spec.duty, 1)], lubrication))
        worst = max(rows, key=lambda row: float(np.abs(row.state.force[:3]).max()))
        findings += bearing_findings(name, worst.state, worst.speed or None, lubrication)
        candidates = [worst.state, *([given[name]] if name in given else [])]
        largest = candidates[int(np.argmin([state.static_safety for state in candidates]))]
        checks += _static_checks(model, name, largest)
    return values, tables, [*findings, *_lubrication_findings(model, values)]


def _idle(bearing: bearings.RollingBearing) -> BearingEquilibrium:
    """A bearing that nothing loads."""
    return bearings.solve(bearing, displacement=[0.0, 0.0, bearings.measures(bearings.law_of(bearing)).centre, 0.0, 0.0])


# -- checks --------------------------------------------------------------------------------------------------------------------


def _static_checks(model: ShaftModel, name: str, state: BearingEquilibrium) -> Iterator[Check]:
    limits, shock = model.spec.limits, model.spec.limits.shock_factor
    if state.pressures.max() > 0:
        under = f", at {shock:g} times the load" if shock > 1 else ""
        message = f"static safety of bearing {name!r}, by its contact pressure{under}; take a larger bearing"
        yield Check(f"static_safety.{name}", state.static_safety / shock, limits.static_safety, ">=", "-", message, (name,))


def _life_checks(model: ShaftModel, lives: Mapping[str, Value]) -> Iterator[Check]:
    limits = model.spec.limits
    for kind, check, limit in (("reference_life", "life", limits.life), ("modified_life", "modified_life", limits.modified_life)):
        for name in model.rolling if limit else ():
            value = lives.get(f"bearings.{name}.{kind}.time")
            if value is not None and limit:
                message = f"{kind.replace('_', ' ')} of bearing {name!r}; take a bearing of larger dynamic rating"
                yield Check(f"{check}.{name}", value.value, limit, ">=", "s", message, (name,))
