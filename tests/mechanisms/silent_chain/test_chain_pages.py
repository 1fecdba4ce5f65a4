"""The pages on chains show what their examples and tables have."""

import re

import numpy as np
import pytest
from places import EXAMPLES, ROOT

import drivewright as dw
from drivewright import units
from drivewright.chains.sizes import chain_size

ROW = re.compile(r"\| `([\w.]+)` \| (-?[\d.]+)(?: (\w+))? \|")
ANALYSES = ("layout", "closure", "contact", "wear")


@pytest.fixture(scope="module")
def worked():
    return dw.run(dw.load(EXAMPLES / "duplex_chain.toml"), only=ANALYSES)


@pytest.mark.golden
def test_the_page_shows_the_numbers_of_its_example(worked):
    rows = ROW.findall((ROOT / "docs" / "duplex_chain.md").read_text(encoding="utf-8"))
    assert len(rows) > 7
    for key, number, unit in rows:
        factor = units.exact_factor(unit) if unit else 1
        digits = len(number.partition(".")[2])
        assert worked.values[key].value / float(factor) == pytest.approx(float(number), abs=1.01 * 10.0**-digits), key


@pytest.mark.analytical
def test_static_safety_by_hand(worked):
    """The pull of the load on 57 teeth, the preload along strands that lean by their own angle, and the centrifugal force."""
    p, z = 25.4e-3, 57
    lean = np.arcsin((p / (2 * np.sin(np.pi / 57)) - p / (2 * np.sin(np.pi / 19))) / worked["layout.centre_distance"])
    pull = 525 * 2 * np.pi / (z * p)
    force = 0.5 * (3000 / np.cos(lean) + pull) + 5.42 * (19 * p * 10) ** 2
    assert pull == pytest.approx(2278.4, abs=0.1) and force == pytest.approx(2787.6, abs=0.1)
    assert worked["chain.static_safety"] == pytest.approx(106e3 / force, rel=1e-9)


@pytest.mark.golden
def test_the_page_of_sizes_has_the_table_of_sizes():
    text = (ROOT / "docs" / "chain_sizes.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (0\d[ABC]|085|[1-7]\dB|[1-4]\dA) \| (.+) \|$", text, re.M)
    assert len(rows) == 31
    for number, cells in rows:
        _, *lengths, apart, strengths, masses = cells.split(" | ")
        size = chain_size(number)
        own = (size.pitch, size.roller_diameter, size.inner_width, size.pin_diameter, size.plate_height, size.inner_plate, size.outer_plate)
        assert [float(each) * 1e-3 for each in lengths] == pytest.approx(own, rel=1e-12)
        assert (0.0 if apart == "-" else float(apart) * 1e-3) == pytest.approx(size.row_pitch, rel=1e-12)
        for rows_of, strength, mass in zip((1, 2, 3), strengths.split(", "), masses.split(", "), strict=False):
            found = chain_size(f"{number}-{rows_of}")
            assert found.tensile_strength == pytest.approx(1e3 * float(strength)) and found.mass_per_length == float(mass)
