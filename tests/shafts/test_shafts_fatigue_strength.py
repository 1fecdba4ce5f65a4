"""Safety of the sections of a shaft: published examples, Goodman's limits, which sections are judged, tables and values."""

import math

import numpy as np
import pytest
from shaft_steel import STEEL

from drivewright import materials, shafts
from drivewright.errors import InputError, UnknownName
from drivewright.materials import Strength
from drivewright.shafts.fatigue_strength import (
    NominalStress,
    Service,
    StrengthSection,
    endurance_limit,
    fatigue_notch_factors,
    judge,
    notch_sensitivity,
    strength_at,
)
from drivewright.shafts.haigh import haigh_plots, haigh_table, strength_table, strength_values
from drivewright.shafts.notches import (
    CrossHole,
    Keyway,
    NotchFactors,
    PressFit,
    RectangularGroove,
    RoundGroove,
    ShoulderFillet,
    SmoothPlace,
    Spline,
)
from drivewright.shafts.strength_sections import ASSUMED_FILLET, assumed_fillets, section_at, shaft_sections

pytestmark = pytest.mark.analytical

MM, MPA, INCH, KPSI, LBF_IN = 1e-3, 1e6, 25.4e-3, 6.894757e6, 0.1129848
PLAIN = NotchFactors(1.0, 1.0, 1.0, "none")
RIGID = math.inf


def section(bending=0.0, tension=0.0, torsion=0.0, diameter=0.04, notch=SmoothPlace("here", 0.1)):
    return StrengthSection(notch, diameter, diameter, 0.0, NominalStress(bending * MPA, tension * MPA, torsion * MPA))


def judged(service=Service(), factors=PLAIN, limit=400 * MPA, **stresses):
    return judge(section(**stresses), factors, limit, STEEL, service)


# -- published numbers ---------------------------------------------------------------------------------------------------------


def test_shigley_example_7_1():
    # 9th ed., p. 370: shoulder of 1.100 in, M = 1260 lbf in reversed, T = 1100 lbf in steady, 105/82 kpsi, machined, 99 %;
    # there Kf = 1.58, Kfs = 1.37; results n = 1.62 (Goodman) and 4.50 (yield) recalled
    diameter, strength = 1.1 * INCH, Strength(105 * KPSI, 82 * KPSI, STEEL.source)
    modulus = math.pi * diameter**3 / 32
    nominal = NominalStress(1260 * LBF_IN / modulus, 0.0, 1100 * LBF_IN / (2 * modulus))
    notch = ShoulderFillet("step", 0.0, 1.65 * INCH, diameter, 0.11 * INCH)
    found = StrengthSection(notch, 1.65 * INCH, diameter, 0.0, nominal)
    limit = endurance_limit(strength.tensile, diameter)
    assert limit / KPSI == pytest.approx(0.787 * 0.870 * 0.814 * 52.5, rel=2e-3)
    row = judge(found, NotchFactors(1.0, 1.58, 1.37, "p. 370"), limit, strength, Service())
    assert (row.fatigue_safety, row.static_safety) == pytest.approx((1.62, 4.50), abs=0.005)
    ours = strength_at(found, strength)  # charts read lower than finite elements: Kt 1.68 and 1.42
    assert (ours.kf_bending, ours.kf_torsion) == pytest.approx((1.58, 1.37), rel=0.08) and 1.5 < ours.fatigue_safety < 1.62


def test_shigley_example_6_6():
    # 690 MPa, fillet of 3 mm: q = 0.8468 in bending and 0.8792 in torsion, Kf = 1.55 with Kt = 1.65
    bending, torsion = notch_sensitivity(3 * MM, 690 * MPA), notch_sensitivity(3 * MM, 690 * MPA, torsion=True)
    assert (bending, torsion) == pytest.approx((0.8468, 0.8792), abs=5e-4)
    assert 1 + bending * (1.65 - 1) == pytest.approx(1.55, abs=0.005)


@pytest.mark.parametrize("percent, factor", [(50, 1.0), (90, 0.897), (95, 0.868), (99, 0.814), (99.9, 0.753), (99.99, 0.702)])
def test_reliability_factors_of_shigley(percent, factor):
    whole = endurance_limit(690 * MPA, 32 * MM, reliability=0.5)
    assert endurance_limit(690 * MPA, 32 * MM, reliability=percent / 100) / whole == pytest.approx(factor, abs=1e-3)


def test_surface_and_size_factors_of_shigley():
    # table 6-2 and example 6-6 (ground, 690 MPa, 32 mm: ka = 0.9065, kb = 0.8558); solutions 7-2: 1226 MPa, 22 mm, machined: 375 MPa
    assert endurance_limit(690 * MPA, 32 * MM, "ground", 0.5) == pytest.approx(0.9065 * 0.8558 * 345 * MPA, rel=1e-3)
    assert endurance_limit(1226 * MPA, 22 * MM, "machined", 0.5) == pytest.approx(375 * MPA, rel=3e-3)
    rolled, forged = (endurance_limit(690 * MPA, 32 * MM, surface, 0.5) for surface in ("hot-rolled", "forged"))
    assert (rolled, forged) == pytest.approx((57.7 * 690**-0.718 * 0.8558 * 345 * MPA, 272 * 690**-0.995 * 0.8558 * 345 * MPA), rel=1e-3)
    assert endurance_limit(690 * MPA, 100 * MM, "ground", 0.5) == pytest.approx(0.9065 * 1.51 * 100**-0.157 * 345 * MPA, rel=1e-3)


@pytest.mark.property
def test_the_endurance_limit_has_a_ceiling_and_joins_at_51_mm():
    assert endurance_limit(2000 * MPA, 32 * MM, "ground") / endurance_limit(1500 * MPA, 32 * MM, "ground") == pytest.approx(
        (2000 / 1500) ** -0.085
    )
    assert endurance_limit(690 * MPA, 51.5 * MM) == pytest.approx(endurance_limit(690 * MPA, 103 * MM) * 2**0.157, rel=1e-9)
    expected = 1.58 * 2000**-0.085 * 1.24 * 32**-0.107 * 700 * MPA
    assert endurance_limit(2000 * MPA, 32 * MM, "ground", 0.5) == pytest.approx(expected, rel=1e-9)
    below, above = (endurance_limit(690 * MPA, 51 * MM * each) for each in (0.9999, 1.0001))
    assert below == pytest.approx(above, rel=2e-3)
    assert endurance_limit(690 * MPA, 1 * MM) == endurance_limit(690 * MPA, 2.79 * MM) > endurance_limit(690 * MPA, 2.8 * MM)
    assert endurance_limit(100 * MPA, 20 * MM) == pytest.approx(endurance_limit(200 * MPA, 20 * MM, "ground") / 2)  # neither above polished


@pytest.mark.property
def test_sensitivity_to_notches():
    q = [notch_sensitivity(radius * MM, 800 * MPA) for radius in (0.01, 0.3, 3, 300)]
    assert q == sorted(q) and q[0] < 0.3 and q[-1] > 0.97
    by_strength = [notch_sensitivity(1 * MM, strength * MPA) for strength in (400, 800, 1200, 1700)]
    assert by_strength == sorted(by_strength)
    assert notch_sensitivity(1 * MM, 800 * MPA, torsion=True) > q[1]
    assert notch_sensitivity(1 * MM, 100 * MPA) == notch_sensitivity(1 * MM, 50 * KPSI) < notch_sensitivity(1 * MM, 51 * KPSI)
    assert notch_sensitivity(1 * MM, 3000 * MPA) == notch_sensitivity(1 * MM, 250 * KPSI) != notch_sensitivity(1 * MM, 249 * KPSI)


def test_fatigue_notch_factors_lie_between_one_and_the_elastic_ones():
    fillet = ShoulderFillet("step", 0.1, 0.05, 0.04, 1 * MM)
    q, q_torsion = notch_sensitivity(1 * MM, STEEL.tensile), notch_sensitivity(1 * MM, STEEL.tensile, torsion=True)
    elastic = shafts.stress_concentration(fillet, 0.05, 0.0)
    expected = (1 + q * (elastic.tension - 1), 1 + q * (elastic.bending - 1), 1 + q_torsion * (elastic.torsion - 1))
    assert fatigue_notch_factors(fillet, 0.05, 0.0, STEEL)[:3] == pytest.approx(expected)
    assert fatigue_notch_factors(SmoothPlace("s", 0.1), 0.05, 0.0, STEEL)[:3] == (1, 1, 1)
    assert fatigue_notch_factors(Keyway("k", 0.1), 0.04, 0.0, STEEL)[:3] == pytest.approx((3.0, 3.0, 1.78))


# -- Goodman and yield ---------------------------------------------------------------------------------------------------------


@pytest.mark.property
def test_goodman_line_ends_at_the_endurance_limit_and_at_the_tensile_strength():
    assert judged(bending=100).fatigue_safety == pytest.approx(4.0)
    assert judged(tension=100).fatigue_safety == pytest.approx(10.0)
    assert judged(bending=200, tension=500).fatigue_safety == pytest.approx(1.0)
    assert judged(bending=100, tension=60).static_safety == pytest.approx(5.0)


@pytest.mark.property
@pytest.mark.parametrize("torsion, amplitude, mean", [("constant", 0, 100), ("pulsating", 50, 50), ("alternating", 100, 0)])
def test_the_torque_as_it_acts(torsion, amplitude, mean):
    row = judged(Service(torsion), torsion=100)
    assert (row.tau_a, row.tau_m) == pytest.approx((amplitude * MPA, mean * MPA))
    assert (row.amplitude, row.mean) == pytest.approx((math.sqrt(3) * amplitude * MPA, math.sqrt(3) * mean * MPA))
    assert row.fatigue_safety == pytest.approx(1 / (math.sqrt(3) * (amplitude / 400 + mean / 1000)))
    assert row.static_safety == pytest.approx(800 / (math.sqrt(3) * 100))


def test_each_factor_raises_its_own_stress():
    row = judged(Service("pulsating"), NotchFactors(1.5, 2.0, 3.0, ""), bending=40, tension=30, torsion=20)
    assert row.amplitude == pytest.approx(math.hypot(80, math.sqrt(3) * 30) * MPA)
    assert row.mean == pytest.approx(math.hypot(45, math.sqrt(3) * 30) * MPA)
    assert row.static_safety == pytest.approx(800 / math.hypot(125, math.sqrt(3) * 60))
    assert (row.sigma_a, row.sigma_m, row.kf_tension, row.kf_bending, row.kf_torsion) == (40 * MPA, 30 * MPA, 1.5, 2.0, 3.0)
    assert row.safety == min(row.fatigue_safety, row.static_safety)


@pytest.mark.property
def test_twice_the_load_is_half_the_safety_and_a_shock_is_for_yield_alone():
    once, twice = (judged(bending=20 * n, tension=7 * n, torsion=15 * n) for n in (1, 2))
    assert (once.fatigue_safety, once.static_safety) == pytest.approx((2 * twice.fatigue_safety, 2 * twice.static_safety))
    shock = judged(Service(shock_factor=2.5), bending=20, tension=7, torsion=15)
    assert shock.static_safety == pytest.approx(once.static_safety / 2.5) and shock.fatigue_safety == once.fatigue_safety


def test_without_stress_there_is_no_limit():
    assert judged().fatigue_safety == judged().static_safety == math.inf
    assert judged(bending=1e-7).fatigue_safety == math.inf > judged(bending=1e-5).fatigue_safety  # what rounding leaves is no stress


# -- which sections ------------------------------------------------------------------------------------------------------------

STEPPED = (
    shafts.Section(0.05, 0.03, 0.03),
    shafts.Section(0.10, 0.04, 0.04),
    shafts.Section(0.10, 0.045, 0.045, 0.01),
    shafts.Section(0.05, 0.03, 0.03),
)


def model(scale=1.0):
    supports = tuple(
        shafts.Support(name, place * scale, (RIGID, RIGID, axial, 0.0, 0.0))
        for name, place, axial in (("A", 0.02, RIGID), ("B", 0.28, 0.0))
    )
    sections = tuple(shafts.Section(*(scale * length for length in each)) for each in STEPPED)
    return shafts.Shaft(sections, 206e9, 0.3, 7850.0, supports)


def diagram(one, force=4000.0, axial=800.0, torque=150.0, scale=1.0, places=()):
    middle = shafts.ShaftLoad(0.13 * scale, (0.0, -force, axial), (0.0, 0.0, torque))
    loads = shafts.ShaftLoads((middle, shafts.ShaftLoad(0.295 * scale, (0.0, 0.0, 0.0), (0.0, 0.0, -torque))))
    return shafts.diagram(shafts.apply_loads(one, loads, places))


def by_name(sections):
    return {each.notch.name: each for each in sections}


def test_every_step_every_notch_and_a_smooth_place_of_every_segment():
    notches = [CrossHole("pin", 0.17, 5 * MM), Keyway("key", 0.11, 0.03)]
    found = by_name(shaft_sections(model(), notches, diagram(model()), (1 * MM, None, 2 * MM)))
    assert list(found) == ["shoulder_1", "shoulder_2", "shoulder_3", "pin", "key", *(f"segment_{n}" for n in (1, 2, 3, 4))]
    fillets = [found[f"shoulder_{n}"].notch for n in (1, 2, 3)]
    assert [f.radius for f in fillets] == pytest.approx([1 * MM, ASSUMED_FILLET * 0.04, 2 * MM])
    assert [f.assumed for f in fillets] == [False, True, False]
    assert [(f.larger, f.smaller) for f in fillets] == [(0.04, 0.03), (0.045, 0.04), (0.045, 0.03)]
    assert found["key"].notch.position == pytest.approx(0.13)  # where it is stressed most
    assert found["segment_2"].notch.position == pytest.approx(0.13) and found["segment_2"].diameter == 0.04
    assert found["segment_3"].notch.position == pytest.approx(0.15) and found["segment_3"].diameter == 0.045
    assert found["segment_3"].bore == found["shoulder_3"].bore == 0.01 and found["segment_4"].bore == 0.0
    assert assumed_fillets(tuple(found.values())) == (
        "fillet radii are assumed, 0.02 of the smaller diameter: shoulder_2 (0.8 mm). Give fillet_radius."
    )
    assert assumed_fillets(shaft_sections(model(), (), diagram(model()), (1 * MM,) * 3)) is None


def test_segments_of_one_diameter_have_no_shoulder_between_them():
    one = model()._replace(sections=(*STEPPED[:2], STEPPED[1], shafts.Section(0.05, 0.039, 0.039)))
    found = by_name(shaft_sections(one, (), diagram(one)))
    assert [name for name in found if name.startswith("shoulder")] == ["shoulder_1", "shoulder_3"]


def test_a_notch_without_a_length_is_where_it_is():
    notches = [Keyway("key", 0.2), PressFit("hub", 0.2), Spline("teeth", 0.2)]
    found = by_name(shaft_sections(model(), notches, diagram(model())))
    assert [found[notch.name].notch for notch in notches] == notches


def test_nominal_stresses_of_the_sections():
    # reactions of 4000 N at 0.13 m on bearings at 0.02 m and 0.28 m; torque from 0.13 m to the right; axial force to the bearing A
    left = 4000 * 0.15 / 0.26
    notches = [RoundGroove("groove", 0.09, 2 * MM, 1 * MM), RectangularGroove("ring", 0.2, 1 * MM, 2 * MM, 0.2 * MM)]
    found = by_name(shaft_sections(model(), notches, diagram(model(), places=(0.09, 0.2))))
    groove, ring, loaded = found["groove"], found["ring"], found["segment_2"].nominal
    assert (groove.outer, groove.diameter, ring.diameter) == pytest.approx((0.04, 0.036, 0.043))
    assert groove.nominal == pytest.approx((left * 0.07 * 32 / math.pi / 0.036**3, 800 * 4 / math.pi / 0.036**2, 0.0), rel=1e-6)
    second = math.pi / 64 * (0.043**4 - 0.01**4)
    bending = (4000 - left) * 0.08 * 0.0215 / second
    assert ring.nominal == pytest.approx((bending, 0.0, 150 * 0.0215 / (2 * second)), rel=1e-6, abs=1)
    # at the load itself both sides count: the axial force of the left, the torque of the right
    expected = (left * 0.11 * 32 / math.pi / 0.04**3, 800 * 4 / math.pi / 0.04**2, 150 * 16 / math.pi / 0.04**3)
    assert loaded == pytest.approx(expected, rel=1e-6)


@pytest.mark.property
def test_loads_across_each_other_add_up_and_signs_do_not_matter():
    one = model()
    across = [shafts.ShaftLoad(0.13, force, (0.0, 0.0, 0.0)) for force in ((3000.0, 0.0, 0.0), (0.0, -4000.0, 0.0), (3000.0, 4000.0, 0.0))]
    found = [shaft_sections(one, (), shafts.diagram(shafts.apply_loads(one, shafts.ShaftLoads((load,))))) for load in across]
    stress = np.array([[each.nominal.bending for each in sections] for sections in found])
    assert stress[2] == pytest.approx(np.hypot(stress[0], stress[1]), rel=1e-6)
    plus, minus = (shaft_sections(one, (), diagram(one, axial=sign * 800, torque=sign * 150)) for sign in (1, -1))
    assert [each.nominal for each in plus] == [pytest.approx(each.nominal) for each in minus]


@pytest.mark.property
def test_a_larger_world_under_larger_loads_has_the_same_stresses_and_factors():
    notches, s = [CrossHole("pin", 0.17, 5 * MM)], 7.0
    small = shaft_sections(model(), notches, diagram(model()))
    large = shaft_sections(model(s), [CrossHole("pin", 0.17 * s, 5 * MM * s)], diagram(model(s), 4000 * s**2, 800 * s**2, 150 * s**3, s))
    for a, b in zip(small, large, strict=True):
        assert b.nominal == pytest.approx(a.nominal, rel=1e-6, abs=1)
        assert shafts.stress_concentration(b.notch, b.outer, b.bore)[:3] == pytest.approx(
            shafts.stress_concentration(a.notch, a.outer, a.bore)[:3], rel=1e-9
        )


def test_diameters_at_a_step_and_on_a_cone():
    cone = model()._replace(sections=(shafts.Section(0.1, 0.02, 0.04), shafts.Section(0.1, 0.04, 0.04, 0.01)))
    assert section_at(cone, 0.025) == pytest.approx((0.025, 0.0)) and section_at(cone, 0.1) == pytest.approx((0.04, 0.01))
    assert section_at(model(), 0.05) == (0.03, 0.0) and section_at(model(), 0.25) == (0.03, 0.01)


@pytest.mark.error
def test_notches_off_the_shaft_are_refused():
    for notch in (CrossHole("pin", 0.31, 5 * MM), CrossHole("pin", -0.01, 5 * MM), Keyway("key", 0.28, 0.03)):
        with pytest.raises(InputError, match=r"a notch at (310|-10) mm is not on the shaft, which ends at 300 mm"):
            shaft_sections(model(), [notch], diagram(model()))
    with pytest.raises(InputError, match=r"^ring: nothing is left of the shaft at 200 mm: net diameter 9 mm, bore 10 mm\."):
        shaft_sections(model(), [RectangularGroove("ring", 0.2, 18 * MM, 2 * MM, 0.2 * MM)], diagram(model()))


@pytest.mark.error
def test_unknown_words_are_answered_with_the_nearest():
    with pytest.raises(UnknownName, match=r"no surface of a shaft is called 'machine' \(did you mean 'machined'\?\)"):
        endurance_limit(700 * MPA, 0.03, "machine")
    with pytest.raises(UnknownName, match=r"no way in which the torque acts is called 'pulsing' \(did you mean 'pulsating'\?\)"):
        judged(Service("pulsing"), bending=1)
    for reliability in (0.4, 1.0):
        with pytest.raises(InputError, match=r"reliability of the endurance limit: (0\.4|1) is outside 0\.5 to below 1"):
            endurance_limit(700 * MPA, 0.03, reliability=reliability)


# -- tables and values ---------------------------------------------------------------------------------------------------------


def rows():
    notches = [CrossHole("pin", 0.17, 5 * MM), RectangularGroove("ring", 0.295, 1 * MM, 2 * MM, 0.2 * MM)]
    sections = shaft_sections(model(), notches, diagram(model(), torque=0.0))
    return [strength_at(each, materials.strength("42CrMo4", 0.045), Service("pulsating", 2.0)) for each in sections]


def test_the_table_is_ordered_and_an_unstressed_section_has_no_safety():
    table, least = strength_table(rows()), min(row.safety for row in rows())
    safety = np.minimum(table["fatigue_safety"].data, table["static_safety"].data)
    assert safety[0] == least and np.all(np.diff(safety[:-1]) >= 0)
    assert table["section"].data[-1] == "ring" and np.isnan(safety[-1]) and table.missing
    assert set(table["kind"].data) == {"smooth", "shoulder", "cross hole", "rectangular groove"}


def test_values_of_the_shaft_and_of_every_notch():
    found, values = {row.name: row for row in rows()}, strength_values(rows())
    weakest = min(found.values(), key=lambda row: row.safety)
    assert values["strength.min_safety"].value == weakest.safety and values["strength.min_safety.at"].value == weakest.position
    assert weakest.name in values["strength.min_safety"].meaning
    for name in ("fatigue_safety", "static_safety"):
        assert values[f"strength.{name}"].value == min(getattr(row, name) for row in found.values())
        assert values[f"strength.pin.{name}"].value == getattr(found["pin"], name)
        assert values[f"strength.shoulder_2.{name}"].value == getattr(found["shoulder_2"], name)
        assert f"strength.ring.{name}" not in values and f"strength.segment_1.{name}" not in values
    assert strength_values([found["ring"]]) == {}


def test_the_haigh_diagram_holds_the_sections_under_the_lower_line():
    steel = materials.strength("42CrMo4", 0.045)
    table = haigh_table(rows(), steel)
    mean = table["mean"].data
    limit = min(row.endurance_limit for row in rows())
    amplitude = {name: table[name].data[np.isfinite(table[name].data)] for name in ("weakest", "notches", "smooth", "goodman", "yield")}
    place = {name: mean[np.isfinite(table[name].data)] for name in amplitude}
    assert amplitude["goodman"] / limit + place["goodman"] / steel.tensile == pytest.approx(np.ones(len(place["goodman"])))
    assert amplitude["yield"] + place["yield"] == pytest.approx(np.full(len(place["yield"]), steel.yield_strength))
    assert place["goodman"].min() == 0 and amplitude["yield"].min() == pytest.approx(0)
    assert place["goodman"].max() == place["yield"].min() and amplitude["goodman"].min() == pytest.approx(amplitude["yield"].max())
    worst = min(rows(), key=lambda row: row.safety)
    assert (place["weakest"], amplitude["weakest"]) == (worst.mean, worst.amplitude)
    others = [row for row in rows() if row is not worst and row.name != worst.name]
    notches = sorted((row.mean, row.amplitude) for row in others if row.kind != "smooth")
    assert sorted(zip(place["notches"], amplitude["notches"], strict=True)) == notches
    assert len(place["smooth"]) == sum(row.kind == "smooth" for row in others)
    (plot,) = haigh_plots({"haigh": table})
    assert {plot.x, *plot.y} == {column.name for column in table.columns} and not list(haigh_plots({}))
    gaps = np.flatnonzero(np.isfinite(table["notches"].data))
    assert np.all(np.diff(gaps) > 1)  # no line joins two sections


def test_the_yield_line_alone_where_it_is_lower_everywhere():
    soft = Strength(1000 * MPA, 200 * MPA, STEEL.source)
    row = judge(section(bending=10), PLAIN, 400 * MPA, soft, Service())
    table = haigh_table([row], soft)
    (plot,) = haigh_plots({"haigh": table})
    assert plot.y == ("weakest", "goodman", "yield")  # nothing is named that has no point
    place = {name: table["mean"].data[np.isfinite(table[name].data)] for name in ("goodman", "yield")}
    assert np.all(place["goodman"] == 0)
    assert place["yield"][[0, -1]] == pytest.approx([0, 200 * MPA])


def test_the_goodman_line_alone_where_nothing_yields_before_it_breaks():
    brittle = Strength(500 * MPA, 500 * MPA, STEEL.source)
    row = judge(section(bending=10), PLAIN, 100 * MPA, brittle, Service())
    table = haigh_table([row], brittle)
    (plot,) = haigh_plots({"haigh": table})
    assert plot.y == ("weakest", "goodman")
    place = table["mean"].data[np.isfinite(table["goodman"].data)]
    assert place[[0, -1]] == pytest.approx([0, 500 * MPA])
