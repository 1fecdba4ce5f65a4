"""The page on the dial table shows what its example gives, and what closed forms give."""

import re

import numpy as np
import pytest
from places import EXAMPLES, ROOT

import drivewright as dw
from drivewright import units

ROW = re.compile(r"\| `([\w.]+)` \| (-?[\d.]+)(?: ([^|]+?))? \|")
PAGE = (ROOT / "docs" / "dial_table.md").read_text(encoding="utf-8")
EXAMPLE = EXAMPLES / "dial_table.toml"
STEP, ANGLE, SPEED, INERTIA, FRICTION = np.pi / 2, 4 * np.pi / 3, 2 * np.pi, 5.0, 12.0


@pytest.fixture(scope="module")
def result():
    return dw.run(dw.load(EXAMPLE))


@pytest.mark.golden
def test_the_page_shows_the_numbers_of_its_example(result):
    """Every row of the table of values: within a unit of the last printed digit."""
    rows = ROW.findall(PAGE)
    assert len(rows) > 12
    for key, number, unit in rows:
        factor = units.exact_factor(unit) if unit else 1
        digits = len(number.partition(".")[2])
        assert result[key] / float(factor) == pytest.approx(float(number), abs=1.01 * 10.0**-digits), key


@pytest.mark.golden
def test_the_text_shows_other_designs():
    eight = dw.run(dw.load(EXAMPLE, ["stations=8"]), ("drive",))
    assert f"{eight['drive.peak_torque']:.2f} N·m" in PAGE
    loose = dw.run(dw.load(EXAMPLE, ["contact.interference=0 um"]), ("stiffness",))
    arcmin = loose["dwell.stiffness.minimum"] * np.pi / 180 / 60
    assert f"{arcmin:.0f} without it" in PAGE


@pytest.mark.analytical
def test_closed_forms_of_the_modified_sine(result):
    """Published factors: V 1.7596, V A 5.4578."""
    inertia_alone = dw.run(dw.load(EXAMPLE, ["table.friction_torque=0 N m"]), ("drive",))
    peak = INERTIA * SPEED**2 * STEP**2 * 5.4578 / ANGLE**3
    assert inertia_alone["drive.peak_torque"] == pytest.approx(peak, rel=2e-5)
    assert f"{peak:.2f} N·m" in PAGE
    assert peak < result["drive.peak_torque"] < peak + FRICTION * result["motion.velocity_factor"]
    assert result["drive.reflected_inertia.maximum"] == pytest.approx(INERTIA * (1.7596 * STEP / ANGLE) ** 2, rel=1e-5)


@pytest.mark.analytical
def test_work_over_a_step_is_that_of_friction(result):
    assert result["drive.friction_work"] == pytest.approx(FRICTION * STEP, rel=1e-6)
    assert result["drive.mean_torque"] * 2 * np.pi == pytest.approx(FRICTION * STEP, rel=1e-6)
    assert result["drive.mean_power"] == pytest.approx(FRICTION * STEP * SPEED / (2 * np.pi), rel=1e-6)


@pytest.mark.conformance
def test_no_roller_enters_a_flank_and_bisection_gives_the_stiffness():
    rows = dw.verify(dw.load(EXAMPLE))
    assert len(rows) == 5
    for row in rows:
        assert abs(row.ours - row.other) <= row.allowed, row
