"""Rated power of American chains against printed tables of ASME B29.1."""

import numpy as np
import pytest

from drivewright.chains.standards import ansi_power, strand_factor
from drivewright.errors import InputError

RPM, HP, INCH = np.pi / 30, 745.699872, 0.0254
# Horsepower over teeth and speed [1/min], as printed on public pages (engineersedge.com, Nos. 40, 41, 50; amesweb.info, No. 25).
NO_40 = (
    (50, 100, 200, 300, 400, 500, 700, 900, 1000, 1200, 1400, 1600, 1800),
    {
        11: (0.23, 0.43, 0.80, 1.16, 1.50, 1.83, 2.48, 3.11, 3.42, 4.03, 4.63, 5.22, 4.66),
        12: (0.25, 0.47, 0.88, 1.27, 1.65, 2.01, 2.73, 3.42, 3.76, 4.43, 5.09, 5.74, 5.31),
        13: (0.28, 0.52, 0.96, 1.39, 1.80, 2.20, 2.97, 3.73, 4.10, 4.83, 5.55, 6.26, 5.99),
        14: (0.30, 0.56, 1.04, 1.50, 1.95, 2.38, 3.22, 4.04, 4.44, 5.23, 6.01, 6.78, 6.70),
        15: (0.32, 0.60, 1.12, 1.62, 2.10, 2.56, 3.47, 4.35, 4.78, 5.64, 6.47, 7.30, 7.43),
        16: (0.35, 0.65, 1.20, 1.74, 2.25, 2.75, 3.72, 4.66, 5.13, 6.04, 6.94, 7.83, 8.18),
        17: (0.37, 0.69, 1.29, 1.85, 2.40, 2.93, 3.97, 4.98, 5.48, 6.45, 7.41, 8.36, 8.96),
        18: (0.39, 0.73, 1.37, 1.97, 2.55, 3.12, 4.22, 5.30, 5.82, 6.86, 7.88, 8.89, 9.76),
    },
)
NO_41 = (
    (10, 25, 50, 100, 200, 300, 400, 500, 700, 900, 1000, 1200, 1400),
    {
        11: (0.03, 0.07, 0.13, 0.24, 0.44, 0.64, 0.82, 1.01, 1.37, 1.71, 1.88, 1.71, 1.36),
        14: (0.04, 0.09, 0.16, 0.31, 0.57, 0.83, 1.07, 1.31, 1.77, 2.22, 2.44, 2.46, 1.95),
        17: (0.05, 0.11, 0.20, 0.38, 0.71, 1.02, 1.32, 1.61, 2.18, 2.74, 3.01, 3.29, 2.61),
        20: (0.06, 0.13, 0.24, 0.45, 0.84, 1.21, 1.57, 1.92, 2.60, 3.26, 3.59, 4.20, 3.33),
        22: (0.06, 0.14, 0.27, 0.50, 0.93, 1.35, 1.74, 2.13, 2.89, 3.62, 3.98, 4.69, 3.85),
    },
)
NO_50 = (
    (25, 50, 100, 200, 300, 400, 500, 700, 900, 1000, 1200, 1400, 1600),
    {
        11: (0.24, 0.45, 0.84, 1.56, 2.25, 2.92, 3.57, 4.83, 6.06, 6.66, 7.85, 8.13, 6.65),
        13: (0.29, 0.54, 1.00, 1.87, 2.70, 3.50, 4.27, 5.78, 7.25, 7.97, 9.40, 10.4, 8.55),
        15: (0.34, 0.63, 1.17, 2.19, 3.15, 4.08, 4.99, 6.75, 8.47, 9.31, 11.0, 12.6, 10.6),
        17: (0.39, 0.72, 1.34, 2.50, 3.61, 4.67, 5.71, 7.73, 9.69, 10.7, 12.6, 14.4, 12.8),
    },
)
NO_25_FAST = ((4000, 4500), {11: (1.38, 1.16), 14: (1.98, 1.66), 17: (2.65, 2.22), 20: (3.38, 2.83), 25: (4.73, 3.96)})


@pytest.mark.golden
@pytest.mark.parametrize(("number", "pitch", "table"), [("40", 0.5, NO_40), ("41", 0.5, NO_41), ("50", 0.625, NO_50)])
def test_printed_tables_within_their_rounding(number, pitch, table):
    speeds, rows = table
    for teeth, printed in rows.items():
        ours = ansi_power(number, pitch * INCH, teeth, np.array(speeds) * RPM).rated / HP
        rounding = np.where(np.array(printed) < 10, 0.0061, 0.061)
        assert np.all(np.abs(ours - printed) <= rounding + 1e-3 * np.array(printed)), (teeth, ours - printed)


@pytest.mark.golden
def test_the_fast_branch_of_a_bush_chain():
    speeds, rows = NO_25_FAST
    for teeth, printed in rows.items():
        found = ansi_power("25", 0.25 * INCH, teeth, np.array(speeds) * RPM, bush_chain=True)
        assert found.roller_impact / HP == pytest.approx(printed, abs=0.0061)


@pytest.mark.golden
def test_the_slow_branch_of_number_25_is_below_the_print():
    """That table has another law of the plates for No. 25, 28 to 47 % above the formula: the formula is on the safe side."""
    slow = ansi_power("25", 0.25 * INCH, 17, np.array([500, 1200, 2500]) * RPM, bush_chain=True).rated / HP
    assert np.all(np.array([0.47, 1.08, 2.19]) / slow > 1.25) and np.all(np.array([0.47, 1.08, 2.19]) / slow < 1.5)


@pytest.mark.property
def test_plates_limit_slow_chains_and_impact_fast_ones():
    found = ansi_power("80", INCH, 17, np.array([100.0, 3000.0]) * RPM)
    assert found.rated[0] == found.plate_fatigue[0] and found.rated[1] == found.roller_impact[1]
    speeds = np.array([10.0, 20.0])
    found = ansi_power("80", INCH, 17, speeds)
    assert found.plate_fatigue[1] / found.plate_fatigue[0] == pytest.approx(2**0.9)
    assert found.roller_impact[1] / found.roller_impact[0] == pytest.approx(2**-1.5)
    teeth = ansi_power("80", INCH, np.array([15, 30]), 10.0)
    assert teeth.plate_fatigue[1] / teeth.plate_fatigue[0] == pytest.approx(2**1.08)
    assert teeth.roller_impact[1] / teeth.roller_impact[0] == pytest.approx(2**1.5)
    pitches = ansi_power("80", np.array([1.0, 2.0]) * INCH, 17, 10.0)
    assert pitches.plate_fatigue[1] / pitches.plate_fatigue[0] == pytest.approx(2 ** (3 - 0.14)) and pitches.roller_impact[
        1
    ] / pitches.roller_impact[0] == pytest.approx(2**0.8)


@pytest.mark.error
def test_rows_without_a_factor_are_refused():
    assert [strand_factor(rows) for rows in (1, 2, 3, 4)] == [1, 1.7, 2.5, 3.3]
    with pytest.raises(InputError, match="no factor is known for 5 rows"):
        strand_factor(5)
