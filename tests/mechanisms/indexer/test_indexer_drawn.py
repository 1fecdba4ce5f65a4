"""What is drawn of an indexing drive fits together: pins and cams touch and never overlap, holes sit on crank pins, pins reach the disc."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry
from drivewright.curves.touching import touches
from drivewright.indexing.drawing import cam_poses
from drivewright.mechanisms.indexer.scene import drawings, parts, plates, scene
from drivewright.runner import build

pytestmark = pytest.mark.property

PRESETS = registry.mechanism("indexer").presets()
OUTSIDE = 'side="outside"', 'pin_radius="7 mm"'


def model_of(*changes, preset="default"):
    return build(dw.load(PRESETS[preset], changes))


def centre_and_radius(outline):
    arc = outline.pieces[0]
    return complex(*arc.center), arc.radius


def bodies(model):
    found = scene(model)
    return found, {body.name: body for body in found.bodies}


@pytest.mark.parametrize(("preset", "changes"), [("default", ()), ("default", ("cams=3",)), ("default", OUTSIDE), ("parallel", ())])
def test_the_pins_on_screen_touch_every_cam_and_enter_none(preset, changes):
    model = model_of(*changes, preset=preset)
    angle = np.radians([0.0, 33.0, 71.0, 118.0, 200.0, 291.0])
    phi = model.drive.motion(angle).d0
    if model.translating:  # copies evenly around the wheel's axis are in balance
        assert np.abs(sum(cam_poses(cam, angle)[:, :2] for cam in plates(model).placed_cams)).max() < 1e-15
    for cam in plates(model).placed_cams:
        poses = cam_poses(cam, angle)
        for (x, y, turn), wheel in zip(poses, phi, strict=True):
            at = cam.drive.pin_centres(0.0).d0 * np.exp(1j * wheel)
            gap = touches(cam.drive.nodes, (at - complex(x, y)) * np.exp(-1j * turn), cam.drive.pin_radius, 1e-3).gap
            assert -1e-8 < gap.min() < 1e-6


@pytest.mark.parametrize("changes", [(), OUTSIDE])
def test_the_holes_of_both_cams_sit_on_the_crank_pins(changes):
    model = model_of(*changes)
    found, named = bodies(model)
    for frame in (0, 57, 200, 333):
        pins = []
        for side in (1, 2):
            x, y, turn = named[f"crank{side}"].poses[frame]
            pins.append(
                [
                    complex(x, y) + np.exp(1j * turn) * centre_and_radius(shape.outline)[0]
                    for shape in named[f"crank{side}"].shapes
                    if shape.layer == "body"
                ]
            )
        for number in range(model.spec.cams):
            x, y, turn = named[f"cam{number + 1}"].poses[frame]
            holes = [
                complex(x, y) + np.exp(1j * turn) * centre_and_radius(shape.outline)[0]
                for shape in named[f"cam{number + 1}"].shapes
                if shape.layer == "hole"
            ]
            assert len(holes) == 2
            # A cam turned half round has its left hole on the right crank.
            centre = complex(x, y)
            for side in (0, 1):
                assert np.min(np.abs(np.array(holes) - pins[side][number])) < 1e-12
            assert abs(sum(holes) / 2 - centre) < 1e-12
    assert len(found.bodies) > 4


def test_pins_reach_from_the_disc_through_the_last_cam():
    for preset in ("default", "parallel", "cycloid"):
        model = model_of(preset=preset)
        named = {part.name: part for part in parts(model)}
        disc, *pins = named["wheel"].solids
        plates = [named[name].solids[0] for name in sorted(named) if name.startswith("cam")]
        top, low, high = disc.z + disc.thickness, min(each.z for each in plates), max(each.z + each.thickness for each in plates)
        assert top <= low + 1e-15 and len(pins) == model.drive.pins * len(model.drive.levels)
        assert all(pin.z <= top + 1e-15 for pin in pins)
        assert max(pin.z + pin.thickness for pin in pins) >= high - 1e-15


# -- the gear of input and split shafts --------------------------------------------------------------------------------------------


def gear_drawing(*changes, preset="default"):
    found = [drawing for drawing in drawings(model_of(*changes, preset=preset)) if drawing.name == "gear"]
    return found[0] if found else None


def radius_over_turn(outline):
    """(polar angle, radius) of a dense polygon along a closed outline, by angle."""
    points = outline.points(1e-7)
    at = points[:, 0] + 1j * points[:, 1]
    order = np.argsort(np.angle(at))
    return np.angle(at)[order], np.abs(at)[order]


@pytest.mark.parametrize(
    ("changes", "module", "teeth", "pressure_angle"),
    [((), 2.5e-3, 22, 20.0), (("gear.teeth=31", 'gear.module="2 mm"', 'gear.pressure_angle="14.5 deg"'), 2e-3, 31, 14.5)],
)
def test_the_gear_has_its_teeth_and_tip_diameter(changes, module, teeth, pressure_angle):
    """z teeth, tips at m (z + 2)/2, roots at m (z - 2.5)/2, and half a pitch of tooth on the pitch circle."""
    drawing = gear_drawing(*changes)
    angle, radius = radius_over_turn(drawing.on("profile")[0])
    assert 2 * radius.max() == pytest.approx(module * (teeth + 2), rel=1e-6)
    assert 2 * radius.min() == pytest.approx(module * (teeth - 2.5), rel=1e-4)
    pitch = 0.5 * module * teeth
    outside = radius > pitch
    assert np.count_nonzero(outside & ~np.roll(outside, 1)) == teeth
    crossings = np.flatnonzero(outside[1:] != outside[:-1])
    share = (pitch - radius[crossings]) / (radius[crossings + 1] - radius[crossings])
    places = angle[crossings] + share * (angle[crossings + 1] - angle[crossings])
    assert np.diff(places)[::2].mean() == pytest.approx(np.pi / teeth, rel=2e-3)
    base = pitch * np.cos(np.radians(pressure_angle))
    normal = involute_normal(drawing.on("profile")[0], pitch)
    assert normal == pytest.approx(base, rel=2e-3), "normals of the flanks touch the base circle"
    assert f"{teeth} teeth, module {1e3 * module:g} mm" in drawing.title and not drawing.milled


def involute_normal(outline, pitch):
    """Mean distance from the axis of the normals of the outline near the pitch circle."""
    points = outline.points(1e-8)
    at = points[:, 0] + 1j * points[:, 1]
    middle, along = 0.5 * (at[1:] + at[:-1]), np.diff(at)
    near = np.abs(np.abs(middle) - pitch) < 0.01 * pitch
    return float(np.mean(np.abs((middle * np.conj(along / np.abs(along))).real[near])))


def test_the_gear_sits_on_the_first_diameter_of_its_shaft():
    centre, radius = centre_and_radius(gear_drawing().on("hole")[0])
    assert (centre, radius) == (0, pytest.approx(0.010, rel=1e-12))


def test_a_pinion_as_slim_as_its_shaft_has_no_bore_and_stops_no_drawing():
    names = [drawing.name for drawing in drawings(model_of("gear.teeth=9"))]
    assert names == [drawing.name for drawing in drawings(model_of())] and not gear_drawing("gear.teeth=9").on("hole")


@pytest.mark.parametrize("change", [("gear.teeth=4",), ('gear.pressure_angle="40 deg"',), ("gear.teeth=301", 'gear.module="0.1 mm"')])
def test_a_gear_that_no_standard_rack_cuts_stops_no_drawing_of_the_cams(change):
    assert [drawing.name for drawing in drawings(model_of(*change))] == ["cam"]


@pytest.mark.parametrize("preset", ["cycloid", "parallel", "globoidal", "barrel"])
def test_without_a_table_of_the_gear_none_is_drawn(preset):
    assert gear_drawing(preset=preset) is None


def test_a_drive_with_a_gear_still_draws_its_cams():
    assert [drawing.name for drawing in drawings(model_of())] == ["cam", "gear"]
