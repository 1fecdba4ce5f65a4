"""Fatigue and yield of every section of the shaft."""

from collections.abc import Iterator

from drivewright import materials, shafts
from drivewright.errors import InputError, SolverError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.mechanisms.shaft.statics import SAMPLES
from drivewright.result import Answer, Answers, Check, Value


def no_strength(spec: ShaftSpec) -> str | None:
    """Why the strength is not evaluated."""
    return materials.no_strength_reason(*_given(spec))


def _given(spec):
    """(card, diameter of the bar [m], tensile and yield strength [Pa]): as given; without card and tensile strength the yield strength
    stands for both, which is the least that the tensile strength can be."""
    material = spec.material
    tensile = material.yield_strength if _by_yield_alone(spec) else material.tensile_strength
    return material.card, bar_diameter(spec), tensile, material.yield_strength


def _by_yield_alone(spec):
    material = spec.material
    return material.card is None and material.tensile_strength is None and material.yield_strength is not None


def _assumptions(spec, sections):
    """What the strength assumes where the spec does not give it."""
    if worst_factor(spec) > 1:
        yield f"strength is computed for the maximum loads of the duty cycle, {worst_factor(spec):g} times those given"
    if _by_yield_alone(spec):
        yield (
            "the tensile strength is not given: the yield strength, which is lower, is used instead, so fatigue safeties are conservative; "
            "give material.tensile_strength or a card"
        )
    fillets = shafts.assumed_fillets(sections)
    if fillets:
        yield fillets


def bar_diameter(spec: ShaftSpec) -> float:
    """Diameter [m] of the bar that the shaft is made from: as given, else its largest."""
    largest = max(max(segment.diameter, segment.end_diameter or 0.0) for segment in spec.segments)
    return spec.material.bar_diameter or largest


def strength(model: ShaftModel, done: Answers) -> Answer:
    """Safety of every section against fatigue and yield under the loads."""
    spec = model.spec
    if not model.loaded:
        return Answer(findings=("strength is absent: there are no loads",), outcome="left out")
    given = materials.given_strength(*_given(spec))
    service = shafts.Service(spec.strength.torsion, spec.limits.shock_factor, spec.strength.surface, spec.strength.reliability)
    radii = [segment.fillet_radius for segment in spec.segments[:-1]]
    notches = [notch.notch() for notch in spec.notches]
    try:
        along = shafts.diagram(_worst_loaded(model, done), SAMPLES)
        sections = shafts.shaft_sections(model.shaft, notches, along, radii)
        rows = [shafts.strength_at(section, given, service) for section in sections]
    except (InputError, SolverError) as error:
        return Answer(findings=(f"strength is absent: {error}",), outcome="left out")
    values = shafts.strength_values(rows)
    if not values:
        return Answer(findings=("strength is absent: the loads cause no stress in the shaft",))
    values |= _material_values(given)
    tables = (shafts.strength_table(rows), shafts.haigh_table(rows, given))
    return Answer(values, tables, tuple(_checks(spec, values)), tuple(_assumptions(spec, sections)))


def _worst_loaded(model, done):
    """The shaft under its loads, or under the largest ones of its duty cycle where those are larger."""
    factor = worst_factor(model.spec)
    if factor <= 1:
        return done["statics"].data
    places = [notch.position for notch in model.spec.notches]
    return shafts.apply_loads(model.shaft, shafts.scaled_loads(model.loads, factor), places)


def worst_factor(spec: ShaftSpec) -> float:
    """The largest factor on the loads: that of the duty cycle, or 1 of the loads as given."""
    return max([1.0, *(case.load for case in spec.duty)])


def _material_values(given: materials.Strength) -> dict[str, Value]:
    return {
        "strength.tensile_strength": Value(given.tensile, "Pa", "tensile strength, used for the safeties"),
        "strength.yield_strength": Value(given.yield_strength, "Pa", "yield strength, used for the safeties"),
    }


def _checks(spec: ShaftSpec, values: dict[str, Value]) -> Iterator[Check]:
    least = values["strength.min_safety"]
    where = least.meaning.partition(", at ")[2]
    for key, limit, label, words in (
        ("fatigue_safety", spec.limits.fatigue_safety, "fatigue safety", "minimum fatigue safety"),
        (
            "static_safety",
            spec.limits.yield_safety,
            "yield safety at notches",
            "minimum yield safety, under the shock load with the notch factors",
        ),
    ):
        value = values[f"strength.{key}"]
        section = f"; weakest section: {where}" if value.value == least.value else ""
        message = f"{words}; take a larger diameter, a larger fillet radius or a stronger material{section}"
        yield Check.of(value, f"strength.{key}", limit, ">=", message, ("shaft",), label)
