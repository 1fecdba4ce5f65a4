"""Sprockets by formula: rollers and pins placed in the gaps, limits in order, printed sizes, numbers of silent chains."""

import numpy as np
import pytest
from scipy.optimize import brentq

from drivewright.chains import standards as s

pytestmark = pytest.mark.analytical

MM = 1e-3
# pitch, roller, teeth: d, da max, da min, df, over pins [mm], as a public sheet prints them (m.doczj.com, 71ca24e0f111f18582d05a4f)
PRINTED = {
    (9.525, 6.35, 12): (36.80, 42.36, 38.71, 30.45, 43.15),
    (12.7, 7.92, 14): (57.07, 65.03, 60.40, 49.15, 64.99),
    (12.7, 8.51, 24): (97.30, 104.66, 100.64, 88.79, 105.81),
    (19.05, 11.91, 17): (103.67, 115.58, 109.02, 91.76, 115.14),
    (25.4, 15.88, 20): (162.37, 178.24, 169.86, 146.49, 178.25),
}
CASES = [(9.525, 6.35, 11), (12.7, 8.51, 18), (19.05, 11.91, 17), (25.4, 15.88, 45)]


@pytest.mark.parametrize(("pitch", "roller", "teeth"), PRINTED)
def test_printed_sizes(pitch, roller, teeth):
    least, greatest = s.tip_range(pitch, teeth, roller)
    ours = s.pitch_diameter(pitch, teeth), greatest, least, s.root_diameter(pitch, teeth, roller), s.over_pins(pitch, teeth, roller)
    assert ours == pytest.approx(PRINTED[pitch, roller, teeth], abs=0.0101)


@pytest.mark.parametrize(("pitch", "roller", "teeth"), [*CASES, *PRINTED])
def test_tips_are_the_tooth_heights_above_the_pitch_polygon(pitch, roller, teeth):
    apothem = 0.5 * pitch / np.tan(np.pi / teeth)
    heights = 0.5 * (pitch - roller), 0.625 * pitch - 0.5 * roller + 0.8 * pitch / teeth
    least, greatest = s.tip_range(pitch, teeth, roller)
    assert least == pytest.approx(2 * (apothem + heights[0]), abs=0.03 * pitch / teeth)  # the rise d (1 - cos t) is 1.571 p/z, not 1.6
    assert greatest == pytest.approx(2 * (apothem + heights[1]), abs=0.03 * pitch / teeth)
    assert s.root_diameter(pitch, teeth, roller) < s.pitch_diameter(pitch, teeth) < least < greatest


def test_the_american_tip_lies_in_the_range():
    teeth = np.arange(9, 121)
    least, greatest = s.tip_range(19.05, teeth, 11.91)
    american = 19.05 * (0.6 + 1 / np.tan(np.pi / teeth))  # ASME B29.1 as makers print it
    assert np.all((least < american) & (american < greatest))


def radius_and_angle(points):
    return np.hypot(*points.T), np.arctan2(points[:, 0], points[:, 1])


def gaps(pitch, roller, teeth):
    tip = s.tip_range(pitch, teeth, roller)[0]
    return {form: s.gap_outline(pitch, teeth, roller, s.tooth_gap(teeth, roller, form), tip, 2001) for form in ("least", "greatest")}, tip


@pytest.mark.parametrize(("pitch", "roller", "teeth"), CASES)
def test_the_gap_is_smooth_and_seats_the_roller(pitch, roller, teeth):
    outlines, tip = gaps(pitch, roller, teeth)
    centre = 0.5 * s.pitch_diameter(pitch, teeth)
    for points in outlines.values():
        radius, angle = radius_and_angle(points)
        assert radius[[0, -1]] == pytest.approx(0.5 * tip, rel=1e-12)
        assert points[::-1] * (-1, 1) == pytest.approx(points, abs=1e-12 * pitch)
        assert np.min(points[:, 1]) == pytest.approx(0.5 * s.root_diameter(pitch, teeth, roller), rel=1e-12)
        steps = np.diff(points, axis=0)
        assert np.max(np.abs(np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))))) < 2e-3  # a kink would be one of a finite angle
        distance = np.hypot(points[:, 0], points[:, 1] - centre)
        assert distance.argmin() == len(points) // 2
        assert distance.min() == pytest.approx(0.5 * roller, rel=1e-12)
        assert np.all(np.diff(distance[len(points) // 2 :]) > 0)  # play grows from the bottom to the tip
        assert np.all(np.abs(angle) < np.pi / teeth)


@pytest.mark.parametrize(("pitch", "roller", "teeth"), CASES)
def test_the_least_gap_lies_inside_the_greatest(pitch, roller, teeth):
    outlines, tip = gaps(pitch, roller, teeth)
    right = {form: radius_and_angle(points[len(points) // 2 :]) for form, points in outlines.items()}
    radius = np.linspace(0.5 * s.root_diameter(pitch, teeth, roller) + 1e-3 * pitch, 0.5 * tip, 200)
    least, greatest = (np.interp(radius, *right[form]) for form in ("least", "greatest"))
    assert np.all(least < greatest)


def test_measures_of_the_gap():
    assert s.tooth_gap(17, 11.91 * MM, "least") == pytest.approx((6.01455 * MM, np.radians(134.705882353), 27.1548 * MM), rel=1e-9)
    seat = 6.01455 + 0.069 * 11.91 ** (1 / 3)
    assert s.tooth_gap(17, 11.91 * MM, "greatest") == pytest.approx((seat * MM, np.radians(114.705882353), 44.68632 * MM), rel=1e-9)


@pytest.mark.parametrize("teeth", [9, 10, 17, 24])
@pytest.mark.parametrize("pin", [None, 5.0])
def test_over_pins_placed_in_the_gaps(teeth, pin):
    pitch, roller = 9.525, 6.35
    size = pin or roller
    outline = s.gap_outline(pitch, teeth, roller, s.tooth_gap(teeth, roller, "least"), s.tip_range(pitch, teeth, roller)[0], 4001)
    root, tip = np.min(outline[:, 1]), np.max(outline[:, 1])
    # lowered along the gap's middle until it touches
    height = brentq(lambda y: np.min(np.hypot(outline[:, 0], outline[:, 1] - y)) - 0.5 * size, root + 0.1 * size, 0.5 * (root + tip) + size)
    turns = 2 * np.pi * np.arange(teeth) / teeth
    centres = height * np.column_stack([np.cos(turns), np.sin(turns)])
    greatest = np.max(np.hypot(*(centres[:, None] - centres[None]).transpose(2, 0, 1))) + size
    assert s.over_pins(pitch, teeth, roller, pin) == pytest.approx(greatest, rel=1e-9)


def test_numbers_of_silent_chains_in_the_standard():
    inch = 25.4 * MM
    assert s.silent_chain("SC302") == pytest.approx((3 / 8 * inch, 1 / 2 * inch), rel=1e-14)
    assert s.silent_chain("SC1012") == pytest.approx((5 / 4 * inch, 3 * inch), rel=1e-14)
    assert s.silent_chain("SC0309") == pytest.approx((3 / 16 * inch, 9 / 32 * inch), rel=1e-14)


def test_each_number_of_a_silent_chain_comes_back():
    numbers = [f"SC{pitch}{width:02d}" for pitch in (3, 4, 6, 8, 9, 10, 12, 16) for width in (2, 9, 10, 48, 99)]
    numbers += ["SC16128", "SC12999", "SC0305", "SC0309", "SC0315"]
    assert [s.silent_number(*s.silent_chain(number)) for number in numbers] == numbers


def test_radius_over_a_silent_chain():
    assert s.max_radius_over_chain(1.0, 6) == pytest.approx(1.75, rel=1e-14)  # a hexagon's radius is its side


def test_each_source_says_whether_it_was_read():
    assert set(s.SOURCES) <= set(s.__all__)
    assert all(source.recalled == source.text.startswith("recalled") for source in s.SOURCES.values())
