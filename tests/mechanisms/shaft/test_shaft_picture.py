"""The picture of a shaft: slices that join and bend as computed, arrows where the loads come from, bearings where they bear."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.bearings.drawing import bearing_section
from drivewright.curves import outline_area
from drivewright.mechanisms.shaft.scene import drawings, scene
from drivewright.shafts.drawing import ARROW, silhouette, slices

pytestmark = pytest.mark.property

SECTIONS = ((0.09, 0.025, 0.025, 0.008), (0.12, 0.03, 0.04, 0.0), (0.11, 0.028, 0.028, 0.0))
TABLES = {
    "segments": [
        {"length": "90 mm", "diameter": "25 mm", "bore": "8 mm"},
        {"length": "120 mm", "diameter": "30 mm", "end_diameter": "40 mm"},
        {"length": "110 mm", "diameter": "28 mm"},
    ],
    "bearings": [
        {"name": "A", "position": "40 mm", "radial_stiffness": "4e7 N/m"},
        {"name": "B", "position": "250 mm", "radial_stiffness": "9e7 N/m"},
    ],
    "stations": [{"name": "p", "position": "0 mm"}, {"name": "q", "position": "160 mm"}],
    "loads": [
        {"station": "p", "force": "700 N"},
        {"position": "120 mm", "force": "-300 N"},
        {"station": "q", "force": "50 N", "angle": "0 deg"},
        {"station": "q", "moment": "3 N m"},
    ],
}

GEARS = [
    {"name": "pinion", "position": "200 mm", "pitch_diameter": "80 mm", "torque": "10 N m"},
    {"name": "wheel", "position": "300 mm", "pitch_diameter": "60 mm", "torque": "-10 N m"},
]


def model(**changes):
    return dw.build(dw.Shaft(**(TABLES | changes)))


def points(outline):
    return np.array([piece.start for piece in outline.pieces] + [outline.pieces[-1].end])


def bodies(drawn, start):
    return [body for body in drawn.bodies if body.name.startswith(start)]


def test_slices_follow_the_deflection_and_its_slope():
    drawn = bodies(scene(model()), "shaft.")
    z, up, turn = np.array([body.poses[30] for body in drawn]).T
    table = dw.run(model().spec, only=("statics",)).tables["diagram"]
    factor = float(drawn[0].label.split("×")[1])
    assert up == pytest.approx(-factor * np.interp(z, table["z"].data, table["deflection"].data), abs=2e-3 * np.abs(up).max())
    slope = -factor * np.interp(z, table["z"].data, table["slope"].data)
    assert np.tan(turn) == pytest.approx(slope, abs=5e-3 * np.abs(slope).max())
    assert np.abs(up).max() > 0.005 and np.gradient(up, z)[5] * turn[5] > 0
    half = drawn[0].poses[15]
    assert half[1] == pytest.approx(drawn[0].poses[30][1] / 2) and np.tan(half[2]) == pytest.approx(np.tan(drawn[0].poses[30][2]) / 2)


def test_everything_that_bends_knows_where_it_is_straight():
    """The drawn way from rest is the deflection times the factor of the label; the outline at rest has none."""
    made = scene(model(gears=GEARS))
    table = dw.run(model(gears=GEARS).spec, only=("statics",)).tables["diagram"]
    for body in made.bodies:
        if body.name == "rest":
            assert body.rest is None
            continue
        assert body.magnified == float(bodies(made, "shaft.")[0].label.split("×")[1]) > 1 and body.most == np.inf
        assert body.rest == pytest.approx(body.poses * (1, 0, 0)), body.name
        if not body.name.startswith("bearing."):
            place = np.clip(body.poses[30][0], *(bodies(made, "shaft.")[n].poses[30][0] for n in (0, -1)))
            real = -np.interp(place, table["z"].data, table["deflection"].data)
            away = (body.poses - body.rest)[30, 1] / body.magnified
            assert away == pytest.approx(real, abs=3e-3 * np.abs(table["deflection"].data).max()), body.name
    assert {body.name.split(".")[0] for body in made.bodies} == {"rest", "bearing", "gear", "shaft", "load"}


def test_without_loads_it_is_bent_by_a_force_at_the_last_station():
    drawn = bodies(scene(bare := model(loads=[])), "shaft.")
    z, up, _ = np.array([body.poses[30] for body in drawn]).T
    line = dw.run(bare.spec, only=("flexibility",)).tables["unit_load"]
    wanted = np.interp(z, line["z"].data, line["q"].data)
    assert "force at q" in drawn[0].label
    assert up / np.abs(up).max() == pytest.approx(-wanted / np.abs(wanted).max(), abs=5e-3)


def test_arrows_ride_on_the_shaft_on_the_side_the_load_comes_from():
    """Down on top, up from below; what acts square to the picture, or is a couple, has none."""
    drawn = scene(model())
    arrows = {body.name: body for body in bodies(drawn, "load.")}
    assert set(arrows) == {"load.0", "load.1"}
    places = np.array([body.poses[30] for body in bodies(drawn, "shaft.")])
    for body, place, radius, side in ((arrows["load.0"], 0.0, 0.0125, 1), (arrows["load.1"], 0.12, 0.01625, -1)):
        head, tail = (points(shape.outline) for shape in body.shapes)
        assert side * head[0, 1] == pytest.approx(radius) and head[0, 0] == 0.0
        assert np.max(side * tail[:, 1]) == pytest.approx(radius + ARROW * 0.32)
        assert body.poses[30][:2] == pytest.approx((place, np.interp(place, places[:, 0], places[:, 1])), abs=1e-9)
    assert abs(arrows["load.0"].poses[30][1]) > 1e-3


def test_the_outline_at_rest_has_the_area_of_the_section():
    (_, base) = silhouette(model().shaft)
    assert outline_area(base.outline) == pytest.approx(sum(length * (a + b) / 2 for length, a, b, _ in SECTIONS), rel=1e-9)


def test_slices_are_the_outline_in_pieces():
    """Edges end where the next begins, faces close the steps and both ends."""
    shaft = model().shaft
    z = np.unique(np.concatenate([np.linspace(0, 0.32, 41), shaft.ends]))
    drawn = list(slices(shaft, z))
    middles, area, faces = 0.5 * (z[1:] + z[:-1]), 0.0, []
    for middle, shapes in zip(middles, drawn, strict=True):
        for shape in shapes:
            (x0, y0), (x1, y1) = points(shape.outline)
            if x0 == x1:
                faces.append((round(middle + x0, 9), round(min(abs(y0), abs(y1)), 9), round(max(abs(y0), abs(y1)), 9)))
            else:
                area += (x1 - x0) * abs(y0 + y1) / 2
    assert area == pytest.approx(sum(length * (a + b) / 2 for length, a, b, _ in SECTIONS), rel=1e-9)
    assert sorted(set(faces)) == [(0.0, 0.0, 0.0125), (0.09, 0.0125, 0.015), (0.21, 0.014, 0.02), (0.32, 0.0, 0.014)]


def test_the_drawing_has_the_hole():
    (drawing,) = drawings(model())
    (hole,) = drawing.on("hole")
    found = points(hole)
    assert (np.ptp(found[:, 0]), np.ptp(found[:, 1])) == pytest.approx((0.09, 0.008)) and found[:, 0].min() == pytest.approx(0.0)


@pytest.mark.parametrize("carries", ["right", "left"])
def test_tapered_rollers_lean_against_the_force_they_take(carries):
    """One that takes a force to the right narrows to the right; rings reach from the shaft as far beyond the rollers as within."""
    taper = {"rollers": 15, "roller_diameter": "4 mm", "roller_length": "8 mm", "pitch_diameter": "36 mm", "contact_angle": "14 deg"}
    held = [{"name": "A", "position": "40 mm", "roller_geometry": taper, "carries": carries}, TABLES["bearings"][1]]
    one = model(bearings=held)
    shapes = list(bearing_section(one.rolling["A"], 0.04, 0.025, one.shaft.supports[0].mirrored))
    rings, rollers = ([points(s.outline) for s in shapes if s.layer == layer] for layer in ("body", "roller"))
    assert [np.abs(ring[:, 1]).min() for ring in rings] == pytest.approx([0.0125] * 2)
    assert [np.abs(ring[:, 1]).max() for ring in rings] == pytest.approx([0.036 - 0.0125] * 2)
    for roller in rollers:
        corners = roller[:4]
        assert np.abs(corners.mean(axis=0)) == pytest.approx((0.04, 0.018))
        right, left = (np.abs(corners[np.argsort(way * corners[:, 0])][:2].mean(axis=0)[1]) for way in (-1, 1))
        assert left - right == pytest.approx((1 if carries == "right" else -1) * 0.008 * np.sin(np.radians(14)), rel=1e-9)


def test_a_seat_off_the_axis_is_drawn_where_it_stands():
    bearings = [TABLES["bearings"][0], TABLES["bearings"][1] | {"seat_offset": ["0.3 mm", "0.05 mm"]}]
    built = model(bearings=bearings, analysis={"direction": "-90 deg"})
    drawn = scene(built)
    factor = float(bodies(drawn, "shaft.")[0].label.split("×")[1])
    here, there = (body.poses for body in bodies(drawn, "bearing."))
    assert np.all(here[:, 1] == 0) and there[:, 1] == pytest.approx(factor * 0.05e-3)  # up against the load
