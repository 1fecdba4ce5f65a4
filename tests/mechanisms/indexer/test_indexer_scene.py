"""The moving picture of an indexing drive: pins and cams where they should be, every normal through the pitch point."""

from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry

pytestmark = pytest.mark.property

PRESETS = Path(dw.__file__).parent / "mechanisms/indexer/presets"


def scene(name):
    model = dw.build(dw.load(PRESETS / f"{name}.toml"))
    return model, registry.mechanism("indexer").scene(model)


@pytest.mark.parametrize("name", ["default", "cycloid", "parallel"])
def test_every_normal_passes_through_the_pitch_point(name):
    model, found = scene(name)
    bodies = {body.name: body for body in found.bodies}
    pitch = bodies["pitch_point"].poses[:, :2] @ (1, 1j)
    near = np.abs(pitch) < 1.14 * max(model.spec.pin_circle_radius, model.spec.centre_distance or 0.0)
    lines = [body for body in found.bodies if body.name.startswith("normal")]
    assert len(lines) == model.spec.pins and near.sum() > 100
    feet = []
    for line in lines:
        foot = line.poses[:, :2] @ (1, 1j)
        off = np.imag((pitch - foot) * np.exp(-1j * line.poses[:, 2]))
        assert np.max(np.abs(off[near])) < 1e-7
        feet.append(foot)
    counts = np.array([len(np.unique(np.round(row, 7))) for row in np.array(feet).T])
    assert counts.max() == (12 if name == "default" else counts.max()) and counts.min() >= 1
    assert np.median(counts) > (6 if name != "parallel" else 0)


def test_the_second_cam_is_the_first_turned_about_the_wheel():
    _, found = scene("default")
    bodies = {body.name: body for body in found.bodies}
    first, second = bodies["cam1"].poses, bodies["cam2"].poses
    assert second[:, :2] == pytest.approx(-first[:, :2], abs=1e-15) and second[:, 2] == pytest.approx(first[:, 2] + np.pi)
    assert bodies["wheel"].poses[-1, 2] == pytest.approx(np.pi / 6) and bodies["wheel"].poses[0, 2] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("name", ["globoidal", "barrel"])
def test_no_roller_enters_a_rib_of_the_developed_cam(name):
    shapely = pytest.importorskip("shapely")
    model, found = scene(name)
    cam = next(body for body in found.bodies if body.name == "cam")
    ribs = [shapely.Polygon(shape.outline.points()) for shape in cam.shapes]
    worst = 0.0
    for frame in range(0, len(found.cycle), 20):
        for body in found.bodies:
            if body.name.startswith("roller"):
                at = body.poses[frame, :2] - cam.poses[frame, :2]
                disc = shapely.Point(at).buffer(0.98 * model.spec.pin_radius)
                worst = max(worst, max(rib.intersection(disc).area for rib in ribs))
    assert worst < 0.02 * np.pi * model.spec.pin_radius**2
