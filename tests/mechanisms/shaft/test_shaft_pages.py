"""The pages on worked shafts show what their examples give."""

import re

import pytest
from places import EXAMPLES, ROOT

import drivewright as dw
from drivewright import units

ROW = re.compile(r"\| `([\w.]+)` \| (-?[\d.]+)(?: (\w+))? \|")
PAGES = ("gearbox_shaft", "two_disc_rotor", "spindle_duty")


@pytest.mark.golden
@pytest.mark.parametrize("name", PAGES)
def test_a_page_shows_the_numbers_of_its_example(name):
    """Every row of a table of values: within a unit of the last printed digit."""
    rows = ROW.findall((ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8"))
    result = dw.run(dw.load(EXAMPLES / f"{name}.toml"))
    assert len(rows) > 5
    for key, number, unit in rows:
        value = result.values[key]
        factor = units.exact_factor(unit) if unit else 1
        digits = len(number.partition(".")[2])
        assert value.value / float(factor) == pytest.approx(float(number), abs=1.01 * 10.0**-digits), key
