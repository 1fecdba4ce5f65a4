"""Every length and angle of a spec is shown by a drawing, or stands here with the reason why not."""

from fnmatch import fnmatchcase

import pytest

from drivewright import registry
from drivewright.report.dimension_drawings import drawing_files, fitting_drawings, measured
from drivewright.spec import read_document
from drivewright.spec.fields import containers_of, dimension_of, table_of
from drivewright.spec.mechanism_spec import MechanismSpec

pytestmark = pytest.mark.conformance

EVERYWHERE = {
    "a limit or a tolerance, no size of a part": ("limits.*", "tolerances.*", "scatter.*", "*tolerance", "*.band"),
    "of the cutting, not of the part": ("manufacture.cutter_diameter", "manufacture.step_down", "manufacture.chord_tolerance"),
    "too small to be seen in a drawing": (
        "*clearance*",
        "*roughness",
        "*bristle_deflection",
        "*rolling_resistance",
        "contact.interference",
    ),
    "of a computation": ("analysis.*", "simulate.*", "compare.*", "dynamics.*", "load.angle", "solid.*"),
}
NOT_SHOWN = {
    "cam": {"the scene draws a face as long as it is used": ("follower.half_face",)},
    "indexer": {"too small to be seen in a drawing": ("gear.backlash",), "the standard meaning": ("gear.pressure_angle",)},
    "linkage": {
        "where a motion begins or a spring is free, not in a scene": ("drive*.phase", "springs.*", "rotational_springs.*"),
        "of joints that no preset has, without a drawing so far": (
            *(f"joints.*.{name}" for name in ("link_angle", "bearing_radius", "bearing_length", "radius", "track_radius")),
        ),
    },
    "seedling-pusher": {"angles of the carrier's turn": ("push.*",), "without a drawing so far": ("cams.*", "events.*", "field.*")},
    "shaft": {
        "directions about the axis, which a side view does not show": ("*.angle", "*_angle", "*.first_element", "*.seat_*"),
        "of the heat treatment": ("material.bar_diameter",),
        "without a drawing so far": (
            "bearings.*.geometry.*",
            "bearings.*.roller_geometry.*",
            "bearings.*.envelope.*",
            "bearings.*.width",
            "loads.*.position",
            "line_loads.*",
        ),
    },
    "silent-chain": {
        "without a drawing so far": (
            "row_pitch",
            "joint.*",
            "plate.*",
            "cutter.*",
            "driven.*",
            "sprockets.*",
            "guides.*",
            "roller.inner_width",
        )
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
    groups = [*EVERYWHERE.values(), *NOT_SHOWN[kind].values()]
    return any(fnmatchcase(key, each) for group in groups for each in group)


@pytest.mark.parametrize("kind", registry.kinds())
def test_every_length_and_angle_is_shown_or_listed(kind):
    mechanism = registry.mechanism(kind)
    shown = {pattern(mechanism.spec, each.key) for sheet in mechanism.dimensions for each in measured(kind, sheet).dimensions}
    keys = set(measurable(mechanism.spec))
    assert shown <= keys and sorted(key for key in keys - shown if not excused(kind, key)) == []
    idle = [each for group in NOT_SHOWN[kind].values() for each in group if not any(fnmatchcase(key, each) for key in keys - shown)]
    assert idle == [], "listed as not shown, and shown or gone"


@pytest.mark.parametrize("kind", registry.kinds())
def test_each_preset_with_a_drawing_of_its_own_gets_it(kind):
    mechanism = registry.mechanism(kind)
    for sheet in mechanism.dimensions:
        if sheet.variant and not any("=" in change for change in sheet.changes):
            assert sheet.name in fitting_drawings(kind, read_document(mechanism.presets()[sheet.preset])), sheet.name


def test_drawings_are_those_of_the_variant():
    presets = registry.mechanism("cam").presets()
    assert fitting_drawings("cam", read_document(presets["groove"])) == ["cam-groove", "cam-section"]
    assert "cam-valve-train" not in fitting_drawings("cam", read_document(presets["oscillating"]))
    assert fitting_drawings("cam", {"follower": {"face": "roller"}}) == ["cam", "cam-section"], "defaults count"
    indexers = registry.mechanism("indexer").presets()
    assert fitting_drawings("indexer", read_document(indexers["barrel"])) == ["indexer-barrel", "indexer-barrel-side"]
    assert fitting_drawings("indexer", {"kind": "unknown"}) == list(drawing_files("indexer")), "better all than none"
