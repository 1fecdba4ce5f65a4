"""Every length and angle of a spec is shown by a drawing, or stands here with the reason why not."""

import pytest

from drivewright import registry
from drivewright.report.dimension_drawings import drawing_files, fitting_drawings, measured
from drivewright.spec import read_document
from drivewright.spec.fields import containers_of, dimension_of, table_of
from drivewright.spec.mechanism_spec import MechanismSpec
from drivewright.studio.translations import texts

pytestmark = pytest.mark.conformance

CUTTING = ("cutter_diameter", "step_down", "chord_tolerance", "profile_tolerance")
CUT = {"of the cutting or its accuracy, not of the part": tuple(f"manufacture.{name}" for name in CUTTING)}
SMALL = "too small to be seen in a drawing"
LIMITS = "limits."  # of a check, no size of a part
NOT_SHOWN = {
    "cam": {
        SMALL: ("lubricant.roughness",),
        "the drawn walls touch the roller on both sides": ("groove.clearance",),
        "of a table's points, not of the part": ("programme.*.band", "programme.*.rows.*.*"),
        **CUT,
    },
    "geneva": {
        "beyond a depth that the drawing does not show": ("locking.relief",),
        "where friction acts, no size of a part": ("bearing.radius",),
        **CUT,
    },
    "indexer": {
        SMALL: ("gear.backlash", "contact.interference", "crank_bearings.radial_clearance", "support_bearings.radial_clearance"),
        "the standard meaning": ("gear.pressure_angle",),
        "where the load of a computation acts": ("load.angle",),
        **CUT,
    },
    "linkage": {
        "where a motion begins": ("drive.phase", "drives.*.phase"),
        "of a spring without force, which no position shows": ("springs.*.free_length", "rotational_springs.*.rest"),
        SMALL: ("joints.*.bristle_deflection", "joints.*.rolling_resistance", "joints.*.roughness"),
        "several values for joints.*.clearance": ("table.clearances.*",),
        "of a computation": ("simulate.absolute_tolerance",),
        "deviations of a computation": ("tolerances.angle", "tolerances.dimensions.*.tolerance"),
    },
    "seedling-pusher": {SMALL: ("contact.clearance",), **CUT},
    "shaft": {
        SMALL: ("bearings.*.radial_clearance", "bearings.*.geometry.radial_clearance", "bearings.*.roller_geometry.radial_clearance"),
        "tilts that neither the side view nor the end view shows": ("bearings.*.seat_tilt.*", "gears.*.helix_angle"),
        "as of a ball bearing": ("bearings.*.roller_geometry.first_element",),
        "only an arm in the moment of a tilted bearing": ("bearings.*.geometry.tilt_radius",),
        "of the heat treatment": ("material.bar_diameter",),
        "forces per length": ("line_loads.*.force", "line_loads.*.end_force"),
        "of a computation": ("analysis.direction", "analysis.element_length", "analysis.solid_band"),
    },
    "silent-chain": {
        SMALL: ("dynamics.thickness_deviation", "solid.clearance", "scatter.pitch", "scatter.tooth_thickness"),
        "roundings and seats of the solid model alone": ("solid.edge_radius", "solid.seat"),
        "several values for joint.rolling_radius": ("compare.rolling_radii.*",),
    },
}


def measurable(model, path="", above=()):
    """Keys of lengths and angles below a table class; a step that the user chooses or counts is a star."""
    for name, field in model.model_fields.items():
        key, inner = path + name + ".*" * len(containers_of(field.annotation)), table_of(field.annotation)
        if not path and name in MechanismSpec.model_fields:
            continue
        if inner and inner not in above:
            yield from measurable(inner, f"{key}.", (*above, inner))
        dimension = None if inner else dimension_of(field)
        if dimension and ("length" in dimension.name or "angle" in dimension.name):
            yield key


def pattern(model, key):
    """A key of a drawing with stars as in `measurable`."""
    steps, found = key.split("."), []
    while steps:
        field = model.model_fields[steps[0]]
        depth, model = len(containers_of(field.annotation)), table_of(field.annotation)
        found += [steps[0], *"*" * depth]
        del steps[: 1 + depth]
    return ".".join(found)


def excused(kind, key):
    """Whether a key is a limit, or listed: as it is, since its stars stand for steps that the user chooses."""
    return key.startswith(LIMITS) or key in listed(kind)


def listed(kind):
    return [key for group in NOT_SHOWN[kind].values() for key in group]


@pytest.mark.parametrize("kind", registry.kinds())
def test_every_length_and_angle_is_shown_or_listed(kind):
    mechanism = registry.mechanism(kind)
    shown = {pattern(mechanism.spec, each.key) for sheet in mechanism.dimensions for each in measured(kind, sheet).dimensions}
    keys = set(measurable(mechanism.spec))
    assert shown <= keys and sorted(key for key in keys - shown if not excused(kind, key)) == []
    assert [key for key in listed(kind) if key not in keys - shown] == [], "listed as not shown, and shown or gone"


@pytest.mark.parametrize("kind", registry.kinds())
def test_each_preset_with_a_drawing_of_its_own_gets_it(kind):
    mechanism = registry.mechanism(kind)
    for sheet in mechanism.dimensions:
        if sheet.variant and not any("=" in change for change in sheet.changes):
            assert sheet.name in fitting_drawings(kind, read_document(mechanism.presets()[sheet.preset])), sheet.name


@pytest.mark.parametrize("kind", registry.kinds())
def test_every_title_has_its_chinese(kind):
    """The studio shows it where the drawing cannot be seen."""
    known = texts(kind)
    assert [sheet.title for sheet in registry.mechanism(kind).dimensions if sheet.title not in known] == []


def test_drawings_are_those_of_the_variant():
    presets = registry.mechanism("cam").presets()
    assert fitting_drawings("cam", read_document(presets["groove"])) == ["cam-groove", "cam-section"]
    assert "cam-valve-train" not in fitting_drawings("cam", read_document(presets["oscillating"]))
    assert fitting_drawings("cam", {"follower": {"face": "roller"}}) == ["cam", "cam-section"], "defaults count"
    indexers = registry.mechanism("indexer").presets()
    assert fitting_drawings("indexer", read_document(indexers["barrel"])) == ["indexer-barrel", "indexer-barrel-side"]
    assert fitting_drawings("indexer", {"kind": "unknown"}) == list(drawing_files("indexer")), "better all than none"
