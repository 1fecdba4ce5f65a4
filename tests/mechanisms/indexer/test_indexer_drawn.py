"""What is drawn of an indexing drive fits together: pins and cams touch and never overlap, holes sit on crank pins, pins reach the disc."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry
from drivewright.curves.touching import touches
from drivewright.indexing.drawing import cam_poses
from drivewright.mechanisms.indexer.scene import parts, plates, scene
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
