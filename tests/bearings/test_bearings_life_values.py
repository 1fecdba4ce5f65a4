"""Lives as values and findings of a result: which there are, how they hang together, what is told."""

import numpy as np
import pytest

from drivewright.bearings import (
    BallBearing,
    Lubrication,
    RollerBearing,
    fatigue_limit_load,
    life_modification_factor,
    reference_load,
    reference_viscosity,
    reliability_factor,
    solve,
    static_rating,
)
from drivewright.bearings.tables import duty_table
from drivewright.bearings.values import DutyCase, bearing_findings, life_values, load_values, spectrum_values, system_values
from drivewright.labels import duplicates, faults, label_of

BALLS = BallBearing(balls=9, ball_diameter="11.9 mm", pitch_diameter="60 mm", outer_conformity=0.52, dynamic_rating="29.1 kN")
ROLLERS = RollerBearing(rollers=14, roller_diameter="10 mm", roller_length="8.5 mm", pitch_diameter="54 mm", dynamic_rating="56 kN")
COMBINED = solve(BALLS, force=[2000.0, 0.0, 1500.0, 0.0, 0.0])
RADIAL = solve(ROLLERS, force=[0.0, 3000.0, 0.0, 0.0, 0.0], held=("z",))
SPEED = 100.0
LIVES = ("basic_life", "reference_life", "modified_life")


def numbers(values):
    return {key.removeprefix("bearings.A."): value.value for key, value in values.items()}


@pytest.mark.interface
def test_names_and_units():
    values = life_values("A", COMBINED, SPEED)
    wanted = {"equivalent_load": "N", "viscosity_ratio": "-", "a_iso": "-"}
    wanted |= dict.fromkeys(LIVES, "rev") | {f"{life}.time": "s" for life in LIVES}
    assert {key: value.unit for key, value in values.items()} == {f"bearings.A.{key}": unit for key, unit in wanted.items()}
    for value in [*values.values(), load_values("A", COMBINED)["bearings.A.static_rating_safety"]]:
        assert faults(label_of(value.meaning)) == ()
    assert "X Fr + Y Fa by ISO 281, table 3" in values["bearings.A.equivalent_load"].meaning
    assert "equal to the radial force" in life_values("A", RADIAL)["bearings.A.equivalent_load"].meaning
    assert "a1 a_ISO L10r" in values["bearings.A.modified_life"].meaning
    still = life_values("A", COMBINED)
    assert set(still) == {"bearings.A.equivalent_load", "bearings.A.basic_life", "bearings.A.reference_life"}


@pytest.mark.analytical
def test_lives_of_a_combined_load():
    """P = 0.56 2000 + Y 1500 with Y = 1.55 - 0.1 (1.17695 - 1.03)/0.35."""
    got, load = numbers(life_values("A", COMBINED, SPEED)), 0.56 * 2000 + (1.55 - 0.1 * (1500 / (9 * 11.9**2) - 1.03) / 0.35) * 1500
    assert got["equivalent_load"] == pytest.approx(load, rel=1e-9)
    assert got["basic_life"] == pytest.approx(1e6 * (29100 / load) ** 3, rel=1e-9)
    assert got["reference_life"] == pytest.approx(COMBINED.reference_life, rel=1e-12)
    for life in LIVES:
        assert got[f"{life}.time"] == pytest.approx(got[life] * 2 * np.pi / SPEED, rel=1e-12)
    backwards = numbers(life_values("A", COMBINED, -SPEED))
    assert backwards == got


@pytest.mark.property
@pytest.mark.parametrize(("state", "contact", "exponent"), [(COMBINED, "point", 3), (RADIAL, "line", 10 / 3)])
def test_the_modified_life_is_made_of_its_parts(state, contact, exponent):
    """a1 a_ISO L10r with the load that gives L10r, the lubricant and the bearing's own fatigue limit."""
    oil = Lubrication(viscosity="12 mm^2/s", contamination="slight", reliability=0.97)
    got, bearing = numbers(life_values("A", state, SPEED, oil)), state.bearing
    kappa = 12e-6 / reference_viscosity(SPEED, bearing.pitch_diameter)
    limit = fatigue_limit_load(static_rating(bearing), bearing.pitch_diameter, contact)
    factor = life_modification_factor(kappa, 0.4 * limit / reference_load(bearing.dynamic_rating, state.reference_life, exponent), contact)
    assert got["viscosity_ratio"] == pytest.approx(kappa, rel=1e-12) and got["a_iso"] == pytest.approx(factor, rel=1e-12)
    assert got["modified_life"] == pytest.approx(reliability_factor(0.97) * factor * state.reference_life, rel=1e-12)


@pytest.mark.property
def test_the_modified_life_shrinks_with_dirt_heat_and_reliability():
    def modified(**keys):
        return life_values("A", COMBINED, SPEED, Lubrication(**keys))["bearings.A.modified_life"].value

    plain = modified()
    assert modified(contamination="typical") < modified(contamination="slight") < plain < modified(contamination="extreme-cleanliness")
    assert modified(temperature="90 degC") < plain < modified(grade="ISO VG 150")
    assert modified(reliability=0.99) == pytest.approx(reliability_factor(0.99) * plain, rel=1e-12)


@pytest.mark.property
def test_every_loaded_rated_bearing_has_a_basic_life():
    tapered, angular = ROLLERS.replace(contact_angle="14 deg"), BALLS.replace(contact_angle="25 deg")
    for bearing, force in ((BALLS, [0, 0, 900, 0, 0]), (tapered, [800, 0, 900, 0, 0]), (angular, [800, 0, 900, 0, 0])):
        assert {f"bearings.A.{life}.time" for life in LIVES} < set(life_values("A", solve(bearing, force=force), SPEED))


@pytest.mark.property
def test_what_an_idle_or_an_unrated_bearing_has():
    idle = solve(BALLS, displacement=np.zeros(5))
    assert set(life_values("A", idle, SPEED)) == {"bearings.A.viscosity_ratio"}
    assert "bearings.A.static_rating_safety" not in load_values("A", idle)
    slight = solve(BALLS, force=[0.3, 0, 0, 0, 0])
    assert life_values("A", slight)["bearings.A.basic_life"].value == pytest.approx(1e6 * (29100 / 0.3) ** 3, rel=1e-9)
    assert "bearings.A.static_rating_safety" in load_values("A", slight)
    assert life_values("A", slight)["bearings.A.equivalent_load"].value == pytest.approx(0.3)
    bare = solve(BALLS.replace(dynamic_rating=None), force=[2000, 0, 1500, 0, 0])
    assert set(life_values("A", bare, SPEED)) == {"bearings.A.equivalent_load"}
    assert list(bearing_findings("A", bare, SPEED)) == ["life of bearing 'A' is absent: it has no dynamic_rating"]


@pytest.mark.analytical
def test_static_safety_by_rating():
    """C0/P0 with P0 = 0.6 Fr + 0.5 Fa, below which stands Fr."""
    rated = BALLS.replace(static_rating="18 kN")
    pushed, radial = solve(rated, force=[0, 2000, -4500, 0, 0]), solve(rated, force=[3000, 0, 100, 0, 0])
    assert load_values("A", pushed)["bearings.A.static_rating_safety"].value == pytest.approx(18000 / (0.6 * 2000 + 0.5 * 4500), rel=1e-9)
    assert load_values("A", radial)["bearings.A.static_rating_safety"].value == pytest.approx(6.0, rel=1e-9)


@pytest.mark.interface
def test_findings():
    assert not list(bearing_findings("A", COMBINED, SPEED))
    loose = BALLS.replace(radial_clearance="25 um")
    (shift,) = bearing_findings("A", solve(loose, force=[200, 0, 400, 0, 0]))
    assert "the reference life is" in shift and "contact angle under load" in shift
    (tilted,) = bearing_findings("A", solve(ROLLERS, force=[3000, 0, 0, 0, 20], held=("z",)))
    assert "is 0.036 times the basic life" in tilted and "preload, tilt" in tilted  # (1/2.706)^(10/3)
    (thin,) = bearing_findings("A", COMBINED, 2.0, Lubrication(viscosity="5 mm^2/s"))
    assert "viscosity ratio 0.0" in thin and "static safety" in thin
    (steep,) = bearing_findings("A", solve(BALLS.replace(contact_angle="60 deg"), force=[0, 0, 900, 0, 0]))
    assert "thrust bearing in ISO 281" in steep


@pytest.mark.interface
def test_an_axial_force_on_cylindrical_rollers_is_told():
    import dataclasses

    pushed = dataclasses.replace(RADIAL, force=RADIAL.force + np.array([0, 0, 250.0, 0, 0]))
    (words,) = bearing_findings("A", pushed, SPEED)
    assert "axial force of 250 N on a cylindrical roller bearing" in words and "P = Fr" in words
    assert life_values("A", pushed)["bearings.A.equivalent_load"].value == pytest.approx(3000.0, rel=1e-9)
    assert not list(bearing_findings("A", RADIAL, SPEED))


LIGHT = solve(BALLS, force=[500.0, 0.0, 100.0, 0.0, 0.0])


@pytest.mark.property
def test_a_duty_cycle_is_the_miner_sum_of_its_cases():
    cases = [DutyCase(0.3, 100.0, COMBINED), DutyCase(0.2, 0.0, COMBINED), DutyCase(0.5, -200.0, LIGHT)]
    got = numbers(spectrum_values("A", cases))
    heavy, light = numbers(life_values("A", COMBINED, 100.0)), numbers(life_values("A", LIGHT, 200.0))
    for life in LIVES:
        time = 1 / (0.3 / heavy[f"{life}.time"] + 0.5 / light[f"{life}.time"])
        assert got[f"{life}.time"] == pytest.approx(time, rel=1e-12)
        assert got[life] == pytest.approx(time * 130 / (2 * np.pi), rel=1e-12)
    assert got["mean_load"] == pytest.approx(
        np.cbrt((30 * heavy["equivalent_load"] ** 3 + 100 * light["equivalent_load"] ** 3) / 130), rel=1e-12
    )
    assert got["basic_life"] == pytest.approx(1e6 * (29100 / got["mean_load"]) ** 3, rel=1e-12)


@pytest.mark.interface
def test_lives_say_what_they_are_counted_by():
    """At the speed of the shaft, or over the duty cycle - never one for the other."""
    one, cycle = life_values("A", COMBINED, SPEED), spectrum_values("A", [DutyCase(0.5, SPEED, COMBINED), DutyCase(0.5, SPEED, LIGHT)])
    for life, symbol in zip(LIVES, ("L10", "L10r", "Lnm"), strict=True):
        single, total = one[f"bearings.A.{life}.time"].meaning, cycle[f"bearings.A.{life}.time"].meaning
        assert single.endswith(f", {symbol}h at the shaft's speed") and total.endswith(f", {symbol}h over the duty cycle")
        assert one[f"bearings.A.{life}"].meaning.endswith("281")
        assert cycle[f"bearings.A.{life}"].meaning == one[f"bearings.A.{life}"].meaning + ", over the duty cycle"
    for values in (one, cycle):
        labels = [label_of(value.meaning) for value in values.values()]
        assert duplicates(labels) == () and not any(faults(label) for label in labels)


@pytest.mark.property
def test_the_table_of_a_duty_cycle_shares_the_damage():
    cases = [DutyCase(0.3, 100.0, COMBINED), DutyCase(0.2, 0.0, COMBINED), DutyCase(0.5, -200.0, LIGHT)]
    table, values = duty_table(cases, "A", [str(n) for n, _ in enumerate(cases)]), spectrum_values("A", cases)
    assert (table.name, list(table["speed"].data), table["share"].data.sum()) == ("duty.A", [100.0, 0.0, -200.0], 1.0)
    assert table["equivalent_load"].data[2] == pytest.approx(0.56 * 500 + 2.3 * 100)
    for kind, life in zip(("basic", "reference", "modified"), LIVES, strict=True):
        damage = table[f"{kind}_damage"].data
        single = life_values("A", LIGHT, 200.0)[f"bearings.A.{life}.time"].value
        assert damage[2] == pytest.approx(0.5 / single * values[f"bearings.A.{life}.time"].value, rel=1e-12)
        assert damage[1] == 0.0 and damage.sum() == pytest.approx(1.0, rel=1e-12)
    idle = duty_table([DutyCase(1.0, 0.0, COMBINED)], "A", ["idle"])
    assert list(idle["basic_damage"].data) == [0.0]
    bare = solve(BALLS.replace(dynamic_rating=None), force=[2000, 0, 1500, 0, 0])
    assert np.isnan(duty_table([DutyCase(1.0, 9.0, bare)], "A", ["bare"])["basic_damage"].data).all()


@pytest.mark.property
def test_a_cycle_of_one_case_is_that_case():
    one, other = numbers(life_values("A", COMBINED, SPEED)), numbers(spectrum_values("A", [DutyCase(1.0, SPEED, COMBINED)]))
    assert {key: other[key] for key in other if key != "mean_load"} == pytest.approx({key: one[key] for key in other if key != "mean_load"})
    assert other["mean_load"] == pytest.approx(one["equivalent_load"])
    assert "bearings.A.basic_life.time" in spectrum_values("A", [DutyCase(1.0, 0.01, COMBINED)])
    oil = Lubrication(contamination="severe")
    assert spectrum_values("A", [DutyCase(1.0, SPEED, COMBINED)], oil)["bearings.A.modified_life"].value < one["modified_life"]


@pytest.mark.property
def test_what_a_cycle_leaves_out():
    bare = solve(BALLS.replace(dynamic_rating=None), force=[2000, 0, 1500, 0, 0])
    assert set(spectrum_values("A", [DutyCase(1.0, SPEED, bare)])) == {"bearings.A.mean_load"}
    assert spectrum_values("A", [DutyCase(1.0, 0.0, COMBINED)]) == {}
    steep = solve(BALLS.replace(contact_angle="60 deg"), force=[0, 0, 900, 0, 0])
    assert "bearings.A.reference_life" in (got := spectrum_values("A", [DutyCase(1.0, SPEED, steep)]))
    assert "bearings.A.mean_load" not in got and "bearings.A.basic_life" not in got


@pytest.mark.property
def test_lives_of_all_bearings_together():
    values = life_values("A", COMBINED, SPEED) | life_values("B", RADIAL, SPEED)
    both = system_values({"A": BALLS, "B": ROLLERS}, values)
    assert set(both) == {f"shaft.system_{life}.time" for life in LIVES}
    for life in LIVES:
        time = both[f"shaft.system_{life}.time"].value
        shares = [(time / values[f"bearings.{name}.{life}.time"].value) ** slope for name, slope in (("A", 10 / 9), ("B", 9 / 8))]
        assert sum(shares) == pytest.approx(1.0, rel=1e-12)
    assert "9/8 (rollers) and 10/9 (balls)" in both["shaft.system_basic_life.time"].meaning
    assert system_values({"A": BALLS}, values) == {}
    del values["bearings.B.modified_life.time"]
    assert set(system_values({"A": BALLS, "B": ROLLERS}, values)) == {"shaft.system_basic_life.time", "shaft.system_reference_life.time"}
