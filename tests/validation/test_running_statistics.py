"""Means, quotients and kept tables behind the rows of running chains and of pins in contact."""

import numpy as np
import pytest

from drivewright.validation import AGREES, OPEN, folding_contact, folding_linkage, hyvo_running
from drivewright.validation.hyvo_running import Interval, difference, mean_of_cases, quotient, ratio

pytestmark = pytest.mark.property


def test_student_interval_of_a_mean_by_hand():
    """1, 2, 3, 4: mean 2.5, s = 1.29099, t(0.975, 3) = 3.18245."""
    found = mean_of_cases(np.array([1.0, 2.0, 3.0, 4.0]))
    assert found.value == 2.5
    assert found.high - found.value == pytest.approx(3.18245 * 1.29099 / 2, rel=1e-5) == found.value - found.low


def test_means_of_lives_are_geometric_and_scale():
    lives = np.array([1e8, 1e9, 1e10])
    found, thousandfold = mean_of_cases(lives, logarithmic=True), mean_of_cases(1000 * lives, logarithmic=True)
    assert found.value == pytest.approx(1e9, rel=1e-12)
    assert np.array(thousandfold) == pytest.approx(1000 * np.array(found), rel=1e-9)
    assert found.high / found.value == pytest.approx(found.value / found.low, rel=1e-9)


def test_cases_without_a_number_do_not_count():
    assert mean_of_cases(np.array([1.0, np.nan, 3.0])) == mean_of_cases(np.array([1.0, 3.0]))


def test_the_interval_covers_a_mean_as_often_as_it_says():
    random = np.random.default_rng(7)
    found = [mean_of_cases(random.normal(5.0, 2.0, 8)) for _ in range(2000)]
    assert np.mean([each.low <= 5.0 <= each.high for each in found]) == pytest.approx(0.95, abs=0.02)


def test_relative_widths_of_a_quotient_add_as_squares():
    found = ratio(Interval(10.0, 9.7, 10.3), Interval(5.0, 4.8, 5.2))
    assert found.value == 2.0
    assert (found.high - found.value) / found.value == pytest.approx(0.05, rel=1e-12)
    assert ratio(Interval(3.0, 3.0, 3.0), Interval(2.0, 2.0, 2.0)) == (1.5, 1.5, 1.5)


def test_an_exact_number_shifts_an_interval():
    assert difference(Interval(5.0, 4.0, 7.0), 3.0) == (2.0, 1.0, 4.0)


def test_groups_share_masses_and_outer_profile():
    spec = hyvo_running.preset("default", *hyvo_running.OUTLINE, *hyvo_running.MASSES)
    control = hyvo_running.preset("classical")
    assert spec.plate.standard_apothem == control.plate.standard_apothem == pytest.approx(3.773e-3)
    assert (spec.plate.link_mass, spec.driven.mass) == (control.plate.link_mass, control.driven.mass) == (2.5e-3, 0.6)


def test_the_load_case_is_the_papers():
    """F1 = 200 N and F0 = 50 N: outward 250 N, and 150 N on the driven pitch radius p z/(2 pi)."""
    spec = hyvo_running.preset("paper-load")
    control = hyvo_running.preset("classical", *hyvo_running.LOAD)
    radius = spec.pitch * 37 / (2 * np.pi)
    for each in (spec, control):
        assert each.drive.preload == 250.0
        assert each.drive.load_torque == pytest.approx(150.0 * radius, rel=2e-3)
        assert each.contact.force == 200.0 and each.drive.speed == pytest.approx(2000 * np.pi / 30)
    assert spec.plate.thickness == 2e-3 and spec.plate.lacing == (1, 2)


def test_a_table_of_impact_loads_is_computed_once(tmp_path, monkeypatch):
    spec, calls = folding_contact.pins_with(28800, ("0.20",)), []
    result = folding_contact.run

    def counted(*arguments):
        calls.append(arguments)
        return result(*arguments)

    monkeypatch.setattr(folding_contact, "run", counted)
    quick = spec.replace({"simulate.turns": 6, "simulate.discard": 1, "simulate.ensemble": 1, "limits.least_turns": 1})
    first, second = (folding_contact.impact_loads(tmp_path, quick).to_pydict() for _ in range(2))
    assert len(calls) == 1 and np.array_equal(first["coefficient"], second["coefficient"])
    assert first["coefficient"][0] > 5


def test_one_worn_pin_has_the_only_play():
    for worn, spec in folding_contact.worn_specs().items():
        assert [joint.name for joint in spec.joints if joint.has_play] == [worn]


def test_a_spec_of_the_folder_takes_other_pins():
    spec = folding_linkage.folding_spec(28800, "0.20", 0.0, {"model": "dry", "friction": 0.1}, turns=12)
    assert {joint.model for joint in spec.joints if joint.name != "O2"} == {"dry"} and spec.simulate.turns == 12


def test_the_running_deviation_counts_from_the_distance_at_rest():
    """219.1256 mm running less 0.0696 mm, as printed."""
    assert pytest.approx(0.2191256 - 0.0000696, abs=1e-12) == hyvo_running.INITIAL


def test_a_quotient_of_coefficients_has_the_widest_interval():
    one = {"coefficient": [6.0], "coefficient.low": [5.0], "coefficient.high": [8.0]}
    other = {"coefficient": [2.0], "coefficient.low": [1.0], "coefficient.high": [4.0]}
    assert folding_contact._quotient(one, 0, other, 0) == (3.0, 1.25, 8.0)


def test_a_quotient_of_lives_is_wide_in_the_logarithm():
    """Factors of 2 and 3 to either side: a factor of exp(sqrt(ln 2^2 + ln 3^2)) to either side of the quotient."""
    found = quotient(Interval(8e8, 4e8, 16e8), Interval(2e8, 2e8 / 3, 6e8))
    factor = np.exp(np.sqrt(np.log(2.0) ** 2 + np.log(3.0) ** 2))
    assert found == pytest.approx((4.0, 4.0 / factor, 4.0 * factor), rel=1e-12)


def test_a_cell_of_impact_loads_has_the_interval_of_its_starts_where_there_is_one(tmp_path, monkeypatch):
    def table(folder, spec):
        values, nothing = [2.0 + n for n in range(len(folding_contact.PLAYS))], float("nan")
        low, high = [nothing, *(value - 0.5 for value in values[1:])], [nothing, *(value + 0.5 for value in values[1:])]
        columns = {"coefficient": values, "coefficient.low": low, "coefficient.high": high}
        return type("Table", (), {"to_pydict": lambda self: columns})()

    monkeypatch.setattr(folding_contact, "impact_loads", table)
    rows = list(folding_contact.dry_rows(tmp_path))
    cells, (over_play, over_speed) = rows[:-2], rows[-2:]
    assert len(cells) == 55 and all((row.low, row.high) == (row.ours - 0.5, row.ours + 0.5) for row in cells if row.ours > 2)
    assert {(row.low, row.high) for row in cells if row.ours == 2} == {(None, None)}
    assert (over_play.ours, over_play.low, over_play.high) == (3.0, 2.75, 3.25), "6 (5.5 to 6.5) over 2, which is exact"
    assert over_play.verdict == AGREES
    assert (over_speed.ours, over_speed.low, over_speed.high) == (1.0, 1.0, 1.0) and over_speed.verdict == OPEN, "no speed changes it here"
