"""Handles on the drawing: each moves, to first order, as its key says; for all kinds, presets and some designs between them."""

import numpy as np
import pytest

from drivewright import registry, runner
from drivewright.errors import DrivewrightError
from drivewright.scene import place
from drivewright.spec.keys import remove_key
from drivewright.studio.design import Design
from drivewright.studio.form import form, values
from drivewright.studio.input_parsing import form_key
from drivewright.studio.opening import preset

SI = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "rad": 1.0, "deg": np.pi / 180, "": 1.0}
STEP = 1e-5  # of a key in SI [m, rad]; a whole number changes by 1
VARIANTS = [
    ("cam", "default", {"rotation": "clockwise", "follower.offset": "7 mm"}),
    ("cam", "default", {"follower.face": "shoe", "follower.face_radius": "30 mm", "follower.face_offset": "2 mm"}),
    ("cam", "default", {"follower.face": "knife", "follower.offset": "-5 mm"}),
    ("cam", "flat", {"follower.face_angle": "8 deg", "follower.offset": "4 mm", "manufacture.bore": "12 mm"}),
    ("cam", "oscillating", {"rotation": "clockwise"}),
    (
        "cam",
        "oscillating",
        {
            "follower.face": "flat",
            "follower.base_radius": "30 mm",
            "follower.face_offset": "3 mm",
            "follower.prime_radius": None,
            "follower.roller_radius": None,
            "programme.0.rise": "8 deg",
            "programme.2.rise": "-8 deg",
        },
    ),
    ("seedling-pusher", "default", {"cams.orbit": "counter-clockwise", "arm.tip_reference": "planet"}),
    ("shaft", "default", {"segments.0.end_diameter": "18 mm", "segments.0.bore": "4 mm", "segments.0.fillet_radius": "1 mm"}),
]
PRESETS = [(kind, name, {}) for kind in registry.kinds() for name in registry.mechanism(kind).presets()]


def designed(kind, name, changes):
    """A preset with other values; a key with None is left out."""
    design = preset(kind, name)
    design = design.changed({key: value for key, value in changes.items() if value is not None})
    for key in (key for key, value in changes.items() if value is None):
        remove_key(design.tables, key)
    return design


def drawn(design: Design):
    return registry.mechanism(design.kind).scene(runner.build(design.spec()))


def carried(scene, handle, frame):
    """Place of a handle in the machine frame, and the turn of the body that carries it."""
    pose = next(body.poses[frame] for body in scene.bodies if body.name == handle.body) if handle.body else np.zeros(3)
    return place([handle.point], pose)[0], pose[2]


def changed_scenes(design, field, step):
    """[(by how much [SI], the scene)] with the number of a field less and more by a step; as it is where that is refused at an end."""
    return [at_step(design, field, sign * step) for sign in (-1, 1)]


def at_step(design, field, step):
    text = f"{field['value'] + step / SI[field['unit']]:.12g} {field['unit']}".strip()
    try:
        return step, drawn(design.changed({field["key"]: int(text) if field["kind"] == "integer" else text}))
    except DrivewrightError:  # the other end tells then
        return 0.0, drawn(design)


def by_key(scene, key):
    return next(handle for handle in scene.handles if handle.key == key)


@pytest.mark.parametrize(("kind", "name", "changes"), PRESETS + VARIANTS)
def test_handles_move_as_their_keys_say(kind, name, changes):
    design = designed(kind, name, changes)
    scene, fields = drawn(design), values(form(design))
    assert scene.handles
    assert len({handle.key for handle in scene.handles}) == len(scene.handles)
    for handle in scene.handles:
        key = form_key(design.tables, handle.key)
        if handle.direction is None:
            point_follows(design, handle, [fields[f"{key}.{part}"] for part in (0, 1)])
        else:
            number_follows(design, scene, handle, fields[key])


def point_follows(design, handle, parts):
    """Both components of the key are those of the point, in the frame of its body."""
    for number, field in enumerate(parts):
        assert handle.point[number] == pytest.approx(field["value"] * SI[field["unit"]], abs=1e-12)
        (low, before), (high, after) = changed_scenes(design, field, STEP)
        moved = np.subtract(by_key(after, handle.key).point, by_key(before, handle.key).point)
        assert high > low
        assert moved == pytest.approx((high - low) * np.eye(2)[number], abs=1e-9)


def number_follows(design, scene, handle, field):
    """The point, carried by its body, moves by the direction at the start.  At another frame, where the key may change the pose too, it
    goes about as far along that direction, so that a drag finds the hand there as well."""
    whole = field["kind"] == "integer"
    step, tolerance = (1.0, 0.03) if whole else (STEP, 1e-3)
    (low, before), (high, after) = changed_scenes(design, field, step)
    assert high > low
    size = np.hypot(*handle.direction)
    for frame, near in ((0, tolerance), (len(scene.cycle) // 3, 0.25)):
        ends = [carried(each, by_key(each, handle.key), frame)[0] for each in (before, after)]
        (wanted,) = place([handle.direction], (0.0, 0.0, carried(scene, handle, frame)[1]))
        moved = np.subtract(ends[1], ends[0]) / (high - low)
        assert moved == pytest.approx(wanted, abs=near * size), (handle.key, frame, moved, wanted)


def test_a_quick_scene_has_the_handles_of_the_scene_and_no_play():
    linkage = registry.mechanism("linkage")
    assert linkage.quick_scene(runner.build(preset("linkage").spec())) is None  # its scene is as quick
    model = runner.build(preset("linkage", "slider_crank").spec())
    quick, scene = linkage.quick_scene(model), linkage.scene(model)
    assert quick.handles == scene.handles and len(quick.cycle) == len(scene.cycle)
    assert any(body.rest is not None for body in scene.bodies) and all(body.rest is None for body in quick.bodies)
