"""Ratings by the inner geometry: ISO 281 of rollers, ISO 76 of both, against the ratings that a maker prints."""

import csv
from pathlib import Path

import numpy as np
import pytest

from drivewright.bearings import BallBearing, RollerBearing, basic_dynamic_rating, basic_static_rating
from drivewright.bearings.boundary_dimensions import boundary_dimensions
from drivewright.bearings.dynamic_rating import ball_dynamic_rating, roller_dynamic_rating, roller_factor
from drivewright.bearings.roller import roller_static_rating
from drivewright.bearings.standard_static_rating import ball_standard_static_rating, roller_standard_static_rating, static_factor
from drivewright.errors import InputError
from drivewright.units import SI

pytestmark = pytest.mark.analytical

MAKERS = {row["designation"]: row for row in csv.DictReader((Path(__file__).parent / "makers_ratings.csv").open())}
INCH_32 = 25.4e-3 / 32
# What NSK's C, C0 and f_0 hold: number of balls and their diameter in 32nds of an inch, whole numbers all; contact angle [deg].
BALLS = {
    "6000": (7, 6, 0),
    "6008": (12, 10, 0),
    "6020": (15, 19, 0),
    "61820": (26, 9, 0),
    "16008": (15, 8, 0),
    "6204": (8, 10, 0),
    "6206": (9, 12, 0),
    "6208": (9, 15, 0),
    "6306": (8, 15, 0),
    "6310": (8, 24, 0),
    "6314": (8, 32, 0),
    "6318": (8, 40, 0),
    "7208B": (14, 15, 40),
    "7310B": (12, 24, 40),
    "7010C": (19, 11, 15),
    "7210C": (14, 16, 15),
}


def printed(name):
    """Pitch diameter [m] midway in the envelope, C and C0 [N] as NSK prints them."""
    row = MAKERS[name]
    return (float(row["bore"]) + float(row["outer_diameter"])) / 2e3, 1e3 * float(row["nsk_dynamic"]), 1e3 * float(row["nsk_static"])


@pytest.mark.parametrize("name", BALLS)
def test_ball_ratings_of_a_catalogue(name):
    """C within 1.2 % and C0 within 2 %, both rounded by the maker, whose f_0 of the thinnest sections alone is 8 % higher."""
    balls, size, angle = BALLS[name]
    pitch, dynamic, static = printed(name)
    numbers = balls, size * INCH_32, pitch, np.radians(angle)
    assert ball_dynamic_rating(*numbers) == pytest.approx(dynamic, rel=0.012)
    assert ball_standard_static_rating(*numbers) == pytest.approx(static / 1.08 if name == "61820" else static, rel=0.02)


# Number of balls and their diameter in 32nds of an inch that give SKF's C0; C that FBJ prints with the same C0, the rating of SKF's
# older catalogues (recalled), and C of SKF's Explorer class [kN].
EXPLORER = {
    "6204": (8, 10, 6.55, 12.7, 13.5),
    "6205": (9, 10, 7.8, 14.0, 14.8),
    "6206": (9, 12, 11.2, 19.5, 20.3),
    "6208": (9, 15.5, 19.0, 30.7, 32.5),
    "6305": (7, 14.5, 11.6, 22.5, 23.4),
    "6306": (8, 15.5, 16.0, 28.1, 29.6),
    "6308": (8, 19, 24.0, 41.0, 42.3),
}


@pytest.mark.parametrize("name", EXPLORER)
def test_ratings_above_the_standard_come_from_its_material_factor(name):
    """One geometry, one C0, two ratings: the older is ISO 281 with b_m = 1.3, the one of today 4 to 6 % more."""
    balls, size, static, older, today = EXPLORER[name]
    numbers = balls, size * INCH_32, printed(name)[0], 0.0
    standard = ball_dynamic_rating(*numbers)
    assert ball_standard_static_rating(*numbers) == pytest.approx(1e3 * static, rel=0.03)
    assert 1e3 * older / standard == pytest.approx(1.0, abs=0.012)
    assert 1e3 * today / standard == pytest.approx(1.048, abs=0.012)
    assert (float(MAKERS[name]["skf_dynamic"]), MAKERS[name]["skf_explorer"]) == (today, "yes")


@pytest.mark.parametrize("name", [name for name, row in MAKERS.items() if name.startswith("NU") and row["nsk_dynamic"]])
def test_roller_ratings_of_a_catalogue(name):
    """Between known raceways C0 says Z L, and C follows within 1 %: L^(7/9) Z^(3/4) is (Z L)^(7/9) Z^(-1/36)."""
    series = "10" if name.startswith("NU10") else name[2]
    size = boundary_dimensions("cylindrical", series)[name.removeprefix("NU" + series)[:2]]
    diameter, pitch = (size.outer_raceway - size.inner_raceway) / 2, (size.outer_raceway + size.inner_raceway) / 2
    _, dynamic, static = printed(name)
    rollers = round(0.85 * np.pi * pitch / diameter)
    length = static / roller_standard_static_rating(rollers, diameter, 1.0, pitch, 0.0)
    assert roller_dynamic_rating(rollers, diameter, length, pitch, 0.0) == pytest.approx(dynamic, rel=0.01)


@pytest.mark.parametrize(
    ("curvature", "factor"),
    [(0.01, 52.1), (0.02, 60.8), (0.05, 74.1), (0.10, 84.2), (0.14, 87.7), (0.18, 88.8), (0.20, 88.7), (0.24, 87.5), (0.30, 83.8)],
)
def test_factor_of_rollers(curvature, factor):
    """The standard's table, recalled, of which every value is rounded to 0.1."""
    assert roller_factor(curvature) == pytest.approx(factor, abs=0.11)


def test_factor_of_rollers_is_largest_near_018():
    grid = np.linspace(0.01, 0.3, 291)
    assert grid[np.argmax(roller_factor(grid))] == pytest.approx(0.185, abs=0.01)


@pytest.mark.parametrize(
    ("curvature", "factor"), [(0.01, 14.9), (0.05, 15.7), (0.10, 16.4), (0.15, 15.2), (0.20, 14.0), (0.25, 12.8), (0.30, 11.6)]
)
def test_static_factor_of_balls(curvature, factor):
    """f_0 of ISO 76, recalled to 0.1."""
    assert static_factor(curvature) / 1e6 == pytest.approx(factor, abs=0.06)


def test_exponents_of_roller_ratings():
    """C ~ L^(7/9) Z^(3/4) Dw^(29/27) at one curvature ratio; the contact angle enters L cos a and the ratio."""
    base = roller_dynamic_rating(14, 0.01, 0.01, 0.05, 0.0)
    assert roller_dynamic_rating(14, 0.01, 0.02, 0.05, 0.0) / base == pytest.approx(2 ** (7 / 9), rel=1e-12)
    assert roller_dynamic_rating(28, 0.01, 0.01, 0.05, 0.0) / base == pytest.approx(2**0.75, rel=1e-12)
    assert roller_dynamic_rating(14, 0.02, 0.01, 0.10, 0.0) / base == pytest.approx(2 ** (29 / 27), rel=1e-12)
    angle = np.radians(30)
    assert roller_dynamic_rating(14, 0.01, 0.01, 0.05 * np.cos(angle), angle) / base == pytest.approx(np.cos(angle) ** (7 / 9), rel=1e-12)


def test_static_ratings_are_those_of_a_bearing_of_the_standards_steel():
    ball = BallBearing(balls=14, ball_diameter="12 mm", pitch_diameter="60 mm", contact_angle="40 deg", youngs_modulus="207 GPa")
    assert ball_standard_static_rating(14, 0.012, 0.06, np.radians(40)) == pytest.approx(basic_static_rating(ball), rel=1e-9)
    numbers = {"rollers": 14, "roller_diameter": SI(0.01), "roller_length": SI(0.011), "pitch_diameter": SI(0.054)}
    roller = RollerBearing(**numbers, contact_angle="20 deg", youngs_modulus="206 GPa")
    assert roller_standard_static_rating(14, 0.01, 0.011, 0.054, np.radians(20)) == pytest.approx(roller_static_rating(roller), rel=0.01)
    assert basic_dynamic_rating(roller) == roller_dynamic_rating(14, 0.01, 0.011, 0.054, np.radians(20))


def test_a_thing_without_a_rating():
    with pytest.raises(InputError, match=r"'6205' is no bearing; build one"):
        basic_dynamic_rating("6205")
