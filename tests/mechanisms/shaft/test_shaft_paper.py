"""The paper on the transverse stiffness of shafts: verdicts, and the claims that explanations and errata make."""

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry
from drivewright.validation import AGREES, EXPLAINED, NOT_COMPARED, OPEN, shaft_bearings, shaft_model, shaft_paper
from drivewright.validation.shaft_model import L1, L2, L3, L5, L6, L7, L8, SPAN, flexibility, literal_bearing_flexibility, own_flexibility

pytestmark = pytest.mark.analytical

PRESETS = registry.mechanism("shaft").presets()
SPINDLE = EXAMPLES / "spindle.toml"
EI = 1617.924
RUBBER = "rubber-roller-r1"


@pytest.fixture(scope="module")
def rows():
    return {row.name: row for row in shaft_paper.source.rows()}


def near(text):
    """What a printed number means: all that rounds to its digits."""
    decimals = len(text.partition(".")[2])
    return pytest.approx(float(text), rel=0, abs=0.5001 * 10.0**-decimals)


def test_every_verdict_is_the_pinned_one(rows):
    assert [(row.name, row.verdict) for row in rows.values() if row.verdict != row.pinned] == []
    assert {row.pinned for row in rows.values()} == {AGREES, EXPLAINED, OPEN, NOT_COMPARED}


# -- section 5.3 ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("mass", "claim", "truth", "historical", "verdict"),
    [
        ("m1", "no significant change: within 10 %", "126.6", "26", OPEN),
        ("m2", "decreases: below 1", "53.9", "-65.7", EXPLAINED),
        ("m4", "decreases: below 1", "12.0", "-3.6", EXPLAINED),
        ("m3", "increases: above 1", "9.6", "7.4", AGREES),
    ],
)
def test_claims_of_section_5_3(rows, mass, claim, truth, historical, verdict):
    """Change of the flexibility of a mass under its own load [%]: by mechanics, and by the printed equations."""
    name = f"elastic over rigid flexibility of {mass}"
    right, printed = rows[name], rows[f"{name}, eqs. (16), (17) to the letter"]
    assert str(right.printed) == str(printed.printed) == claim
    assert 100 * (right.ours - 1) == near(truth)
    assert 100 * (printed.ours - 1) == near(historical)
    assert (right.verdict, printed.verdict) == (verdict, NOT_COMPARED)
    assert "no evidence" in printed.commentary


@pytest.mark.parametrize(
    ("mass", "texts"),
    [
        ("m1", ("89.77392", "203.4432")),
        ("m2", ("457.1845", "703.5621")),
        ("m3", ("565.2083", "619.5285")),
        ("m4", ("188.2006", "210.7088")),
    ],
)
def test_own_load_diagonals(mass, texts):
    """Rigid and elastic [nm/N]."""
    assert [1e9 * own_flexibility(mass, np.inf), 1e9 * own_flexibility(mass)] == [near(text) for text in texts]


def test_the_cross_flexibilities_may_fall():
    """+50.5 to -82.1 and -262 to -230 nm/N."""
    found = [1e9 * flexibility(preset, stiffness)[0, 1] for preset in ("pressure-roller", RUBBER) for stiffness in (np.inf, None)]
    assert found == [pytest.approx(value, abs=0.05) for value in (50.52, -82.09, -261.80, -230.30)]


def test_the_printed_equations_do_not_leave_m1_unchanged_either(rows):
    """They add 24 nm/N to its 90, the bearings 114."""
    claim = rows["elastic over rigid flexibility of m1"]
    literal = rows["elastic over rigid flexibility of m1, eqs. (16), (17) to the letter"]
    assert (claim.printed.low, claim.printed.high) == pytest.approx((0.9, 1.1)) and not claim._meets(literal.ours)
    assert claim.explanation is None and "Not even" in literal.note
    assert 1e9 * literal_bearing_flexibility("m1") == near("23.54")


def test_the_printed_equations_by_hand():
    """mu = |reaction|/k; eq. (16): mu_2 - x (mu_1 + mu_2)/l2 at x = 0 and 245 mm; eq. (17) with l6 + l7 at 0 and 148.5 mm."""
    k = 3e7
    assert literal_bearing_flexibility("m1") == pytest.approx(L1 / L2 / k, rel=1e-9)
    assert literal_bearing_flexibility("m2") == pytest.approx(((1 + L3 / L2) - (L1 + L2 + L3) / L2 * (1 + 2 * L3 / L2)) / k, rel=1e-9)
    assert literal_bearing_flexibility("m3") == pytest.approx((1 + L6 / SPAN) / k, rel=1e-9)
    assert literal_bearing_flexibility("m4") == pytest.approx(-L7 / SPAN / k, rel=1e-9)


@pytest.mark.parametrize(
    ("preset", "places", "load"),
    [("pressure-roller", (L1, L1 + L2), "m1"), ("pressure-roller", (L1, L1 + L2), "m2"), (RUBBER, (L5 + L6, L5 + L6 + SPAN), "m4")],
)
def test_what_bearings_add_is_a_line_through_their_displacements(preset, places, load):
    """The erratum to eqs. (16), (17): z = w_A + (w_B - w_A)(x - x_A)/L, with signs."""
    table = shaft_model.run_preset(preset, None, ("flexibility",)).tables["unit_load"]
    x, added = table["z"].data, table[load].data - table[f"{load}.rigid"].data
    first, last = np.interp(places, x, added)
    assert added == pytest.approx(first + (last - first) * (x - places[0]) / (places[1] - places[0]), abs=1e-6 * np.abs(added).max())
    assert max(abs(first), abs(last)) > 1e-8


@pytest.mark.parametrize("mass", ["m1", "m2", "m3", "m4"])
def test_conclusion_3_at_any_stiffness(mass):
    """Stiffer bearings, less flexibility, over four decades; and it contradicts section 5.3."""
    found = [own_flexibility(mass, float(k)) for k in np.geomspace(1e6, 1e10, 9)]
    assert np.all(np.diff(found) < 0) and found[-1] > own_flexibility(mass, np.inf)


# -- formulas ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "printed", "ours", "verdict"),
    [
        ("second moment of area of 20 mm, in mm^4", "7854", 7853.98, AGREES),
        ("slope at A, force at m1, in urad/N", "0.931235", 0.931235, AGREES),
        ("moment at A over the force at m1, in m", "0.0565", 0.0565, AGREES),
        ("flexibility of m1, bearings rigid", "89.7739 um/kN", 8.97739e-8, AGREES),
        ("flexibility of m2, bearings rigid", "457.184 um/kN", 4.57184e-7, AGREES),
        ("slope at C, force at m3, in urad/N", "1.12346", 5.50747, EXPLAINED),
        ("flexibility of m3, bearings rigid", "205.719 um/kN", 5.65208e-7, EXPLAINED),
        ("deflection between m1 and A, pressure-roller shaft", "63.1794 um/kN", 6.31794e-8, AGREES),
        ("deflection between A and B, pressure-roller shaft", "-40.793 um/kN", -4.07930e-8, AGREES),
        ("deflection between B and m2, pressure-roller shaft", "204.511 um/kN", 2.04511e-7, AGREES),
        ("deflection right end, pressure-roller shaft", "890.802 um/kN", 1.067443e-6, EXPLAINED),
        ("deflection at m3, rubber-roller shaft", "232.657 um/kN", 3.034064e-7, EXPLAINED),
        ("deflection between m3 and C, rubber-roller shaft", "83.2084 um/kN", 1.304040e-7, EXPLAINED),
        ("deflection between C and m4, rubber-roller shaft", "-50.9441 um/kN", -5.291647e-8, EXPLAINED),
        ("deflection at m4, rubber-roller shaft", "-144.487 um/kN", -7.360128e-8, EXPLAINED),
        ("displacement in bearing A, force at m1", "56.875 um/kN", 5.6875e-8, AGREES),
        ("displacement in bearing B, force at m2", "78.5417 um/kN", 7.85417e-8, AGREES),
        ("displacement in bearing C, force at m3", "41.7178 um/kN", 4.17178e-8, AGREES),
        ("contribution of the bearings at m1", "23.5417 um/kN", 1.136693e-7, EXPLAINED),
        ("contribution of the bearings at m2", "-300.443 um/kN", 2.463776e-7, EXPLAINED),
        ("contribution of the bearings at m3", "41.7178 um/kN", 5.432020e-8, EXPLAINED),
        ("contribution of the bearings at m4", "-6.79959 um/kN", 2.250822e-8, EXPLAINED),
        ("flexibility of m2 as the sum of beam and bearings", "703.562 um/kN", 7.035621e-7, AGREES),
        ("flexibility of m2 on elastic bearings", "156.742 um/kN", 7.035621e-7, EXPLAINED),
        ("flexibility of m4 on elastic bearings", "-193.817 um/kN", 2.107088e-7, EXPLAINED),
        ("stiffness of m1, m2 held, from the inverse", "5.15821 kN/mm", 5.158209e6, AGREES),
        ("rank of the flexibility with indices 31, 32; 41, 42", "2, implied by its inverse K2", 0, EXPLAINED),
    ],
)
def test_printed_formulas(rows, name, printed, ours, verdict):
    row = rows[name]
    assert (str(row.printed).removesuffix(", evaluated"), row.verdict) == (printed, verdict)
    assert row.ours == pytest.approx(ours, rel=2e-6)


def test_corrected_equations_5_and_6():
    """l6 (l7 + l8)/(3 EI) and l6^2 (l6 + l7 + l8)/(3 EI): the span of the bearings C and D is l7 + l8."""
    slope, own = L6 * (L7 + L8) / (3 * EI), L6**2 * (L6 + L7 + L8) / (3 * EI)
    assert (slope, own) == pytest.approx((5.50747e-6, 5.65208e-7), rel=2e-6)
    assert shaft_model.value_per_newton(RUBBER, "m3", "bearings.C.slope") == pytest.approx(slope, rel=1e-6)
    assert own_flexibility("m3", np.inf) == pytest.approx(own, rel=1e-6)


@pytest.mark.parametrize(("name", "factor"), [("slope at C, force at m3, in urad/N", 4.9), ("flexibility of m3, bearings rigid", 2.75)])
def test_how_far_off_eqs_5_and_6_are(rows, name, factor):
    row = rows[name]
    assert row.ours / row.explanation.value == pytest.approx(factor, abs=0.005)
    assert row.printed.low <= row.explanation.value <= row.printed.high


def macaulay(x, loads, reactions, signs=(1.0, 1.0)):
    """Deflection at x with two constants, 0 at the bearings; `signs` of the loads' cubic terms, 1 for both if they are right."""
    places = [place for place, _ in reactions]

    def cubic(x):
        return (
            sum(sign * force * max(x - s, 0.0) ** 3 for sign, (s, force) in zip(signs, loads, strict=True))
            - sum(force * max(x - s, 0.0) ** 3 for s, force in reactions)
        ) / 6

    c1, c2 = np.linalg.solve([[place, 1.0] for place in places], [-cubic(place) for place in places])
    return (c1 * x + c2 + cubic(x)) / EI


@pytest.mark.parametrize(
    ("preset", "loads", "bearings", "end"),
    [("pressure-roller", (0.0, L1 + L2 + L3), (L1, L1 + L2), 0.340), (RUBBER, (L5, L5 + L6 + L7), (L5 + L6, L5 + L6 + SPAN), 0.490)],
)
def test_two_constants_and_equal_signs_of_the_loads(preset, loads, bearings, end):
    """Errata to eqs. (7) to (14): with them the lines are the beam's to the end of the shaft; with the printed sign of F2 they are not."""
    forces = [(place, 1.0) for place in loads]
    span = bearings[1] - bearings[0]
    last = sum(place - bearings[0] for place in loads) / span
    reactions = [(bearings[0], 2.0 - last), (bearings[1], last)]
    table = shaft_model.run_preset(preset, np.inf, ("flexibility",)).tables["unit_load"]
    names = [name for name in ("m1", "m2", "m3", "m4") if name in [column.name for column in table.columns]]
    beam = sum(table[name].data for name in names)
    ours = [macaulay(x, forces, reactions) for x in table["z"].data]
    assert ours == pytest.approx(beam, abs=1e-6 * np.abs(beam).max())
    assert table["z"].data[-1] == pytest.approx(end)
    assert abs(macaulay(end, forces, reactions, (1.0, -1.0)) - beam[-1]) > 0.05 * np.abs(beam).max()


# -- eqs. (7) to (21) by a second route ------------------------------------------------------------------------------------------

ON_1, ON_2 = (L1, L1 + L2), (L5 + L6, L5 + L6 + SPAN)  # bearings of both shafts
MASSES = {"m1": 0.0, "m2": L1 + L2 + L3, "m3": L5, "m4": L5 + L6 + L7}
BEARINGS = {"m1": ON_1, "m2": ON_1, "m3": ON_2, "m4": ON_2}
K = 3.0e7


def reactions_of(loads, bearings):
    """((place, force against the loads), ...) of two bearings under (place, force) loads: moments about the first."""
    (first, second), total = bearings, sum(force for _, force in loads)
    last = sum(force * (place - first) for place, force in loads) / (second - first)
    return ((first, total - last), (second, last))


def deflection(x, loads, bearings):
    return macaulay(x, loads, reactions_of(loads, bearings), [1.0] * len(loads))


def by_macaulay(mass, other):
    """Flexibility (mass, other) on rigid bearings."""
    return deflection(MASSES[mass], [(MASSES[other], 1.0)], BEARINGS[other])


def by_bearings(mass, other):
    """What springs K add: the sum of the products of both reactions over K."""
    at, to = (reactions_of([(MASSES[name], 1.0)], BEARINGS[name]) for name in (mass, other))
    return sum(one * two for (_, one), (_, two) in zip(at, to, strict=True)) / K


@pytest.mark.parametrize(
    ("name", "x", "masses"),
    [
        ("between m1 and A, pressure-roller shaft", L1 / 2, ("m1", "m2")),
        ("between A and B, pressure-roller shaft", L1 + L2 / 2, ("m1", "m2")),
        ("between B and m2, pressure-roller shaft", L1 + L2 + L3 / 2, ("m1", "m2")),
        ("right end, pressure-roller shaft", 0.340, ("m1", "m2")),
        ("at m3, rubber-roller shaft", L5, ("m3", "m4")),
        ("between m3 and C, rubber-roller shaft", L5 + L6 / 2, ("m3", "m4")),
        ("between C and m4, rubber-roller shaft", L5 + L6 + L7 / 2, ("m3", "m4")),
        ("at m4, rubber-roller shaft", L5 + L6 + L7, ("m3", "m4")),
    ],
)
def test_deflections_of_eqs_7_to_14_are_the_beams(rows, name, x, masses):
    """Ours by Macaulay's bracket under both unit forces."""
    loads = [(MASSES[mass], 1.0) for mass in masses]
    assert rows[f"deflection {name}"].ours == pytest.approx(deflection(x, loads, BEARINGS[masses[0]]), rel=2e-5)


def test_printed_eq_10_is_the_beam_with_f2_turned_round_behind_m2(rows):
    """Right up to m2, so both constants come from the right line; past m2 the printed sign of F2's cubic bends it up."""
    row, loads = rows["deflection right end, pressure-roller shaft"], [(MASSES["m1"], 1.0), (MASSES["m2"], 1.0)]
    made = macaulay(0.340, loads, reactions_of(loads, ON_1), (1.0, -1.0))
    assert row.printed.low <= made <= row.printed.high
    assert row.explanation.value == pytest.approx(made, rel=2e-5)
    assert row.ours / made == pytest.approx(1.198, abs=1e-3)


@pytest.mark.parametrize(
    ("number", "name", "x"),
    [(11, "at m3", 0.0), (12, "between m3 and C", 0.0475), (13, "between C and m4", 0.095 + 0.053 + 0.041), (14, "at m4", 0.230)],
)
def test_printed_eqs_11_to_14_are_those_of_an_older_shaft(rows, number, name, x):
    """m3 at 0, C at 95, D at 148 and m4 at 230 mm, m4 pulled up where m3 is pressed down."""
    row = rows[f"deflection {name}, rubber-roller shaft"]
    assert row.where == f"eq. ({number})"
    made = deflection(x, [(0.0, 1.0), (0.230, -1.0)], (0.095, 0.148))
    assert row.printed.low - 1e-15 <= made <= row.printed.high + 1e-15
    assert row.explanation.value == pytest.approx(made, rel=2e-5)


@pytest.mark.parametrize(("bearing", "mass"), [("A", "m1"), ("B", "m2"), ("C", "m3")])
def test_displacement_in_the_bearing_beside_a_load(rows, bearing, mass):
    """Eq. (15): reaction over stiffness, by moments about the other bearing."""
    row = rows[f"displacement in bearing {bearing}, force at {mass}"]
    own = dict(zip("ABCD", (*reactions_of([(MASSES[mass], 1.0)], BEARINGS[mass]),) * 2, strict=True))[bearing][1]
    assert row.ours == pytest.approx(abs(own) / K, rel=1e-6) and row.where == "eq. (15)"


@pytest.mark.parametrize("mass", ["m1", "m2", "m3", "m4"])
def test_the_contribution_of_bearings_is_the_sum_of_squares_of_their_reactions(rows, mass):
    """Of which eqs. (16) and (17) give another, at m2 and m4 of the wrong sign."""
    row = rows[f"contribution of the bearings at {mass}"]
    assert row.ours == pytest.approx(by_bearings(mass, mass), rel=1e-5)
    assert row.explanation.value == pytest.approx(literal_bearing_flexibility(mass), rel=1e-12)
    assert (row.explanation.value < 0) == (mass in ("m2", "m4"))


def test_flexibilities_are_beam_and_bearings_together(rows):
    """Eqs. (18) to (20)."""
    for mass, names in (("m2", ("as the sum of beam and bearings", "on elastic bearings")), ("m4", ("on elastic bearings",))):
        whole = by_macaulay(mass, mass) + by_bearings(mass, mass)
        assert [rows[f"flexibility of {mass} {name}"].ours for name in names] == pytest.approx([whole] * len(names), rel=1e-5)


def test_printed_eqs_19_and_20_by_hand(rows):
    """(19): rigid beam, and eq. (16) at m2.  (20): the older shaft's m4 pulled up, and eq. (17) at m4."""
    rigid, literal = by_macaulay("m2", "m2"), literal_bearing_flexibility("m2")
    old = -deflection(0.230, [(0.230, 1.0)], (0.095, 0.148))
    for name, value in (("m2", rigid + literal), ("m4", old + literal_bearing_flexibility("m4"))):
        row = rows[f"flexibility of {name} on elastic bearings"]
        assert row.printed.low - 1e-15 <= value <= row.printed.high + 1e-15
        assert row.explanation.value == pytest.approx(value, rel=1e-5)


def test_stiffness_is_the_inverse_of_the_flexibility(rows):
    """Eq. (21), K1, of beam and bearings by hand."""
    names = ("m1", "m2")
    made = np.array([[by_macaulay(one, two) + by_bearings(one, two) for two in names] for one in names])
    assert rows["stiffness of m1, m2 held, from the inverse"].ours == pytest.approx(np.linalg.inv(made)[0, 0], rel=2e-5)
    assert flexibility("pressure-roller") == pytest.approx(made, rel=2e-5)


@pytest.mark.parametrize(
    ("mass", "flexibility", "percent"), [("m1", "37.16", "-59"), ("m2", "263.2", "-42"), ("m3", "113.6", "-80"), ("m4", "30.56", "-84")]
)
def test_fixed_supports(rows, mass, flexibility, percent):
    preset, _, place = shaft_model.LAYOUT[mass]
    assert 1e9 * shaft_paper.clamped_flexibility(preset)[place, place] == near(flexibility)
    row = rows[f"flexibility of {mass}, clamped over simply supported"]
    assert 100 * (row.ours - 1) == near(percent)
    assert row.verdict == OPEN and "cannot be determined" in row.commentary


@pytest.mark.parametrize(("mass", "length"), [("m1", L1), ("m2", L3), ("m3", L6)])
def test_beyond_a_fixed_support_a_mass_hangs_on_a_cantilever(mass, length):
    """l^3/(3 EI), from the support to the mass."""
    preset, _, place = shaft_model.LAYOUT[mass]
    assert shaft_paper.clamped_flexibility(preset)[place, place] == pytest.approx(length**3 / (3 * EI), rel=1e-6)


def test_between_fixed_supports_a_mass_hangs_on_a_beam_built_in_at_both_ends():
    """a^3 b^3/(3 EI L^3) for m4 between C and D."""
    made = (L7 * (SPAN - L7) / SPAN) ** 3 / (3 * EI)
    assert shaft_paper.clamped_flexibility(RUBBER)[1, 1] == pytest.approx(made, rel=1e-6)


@pytest.mark.parametrize("preset", ["pressure-roller", RUBBER])
def test_masses_do_not_feel_each_other_past_a_fixed_support(preset):
    found = shaft_paper.clamped_flexibility(preset)
    assert abs(found[0, 1]) < 1e-9 * found[0, 0]


# -- bearings ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("case", "ratio", "verdict"),
    [
        ("equal rollers, no axial load", 1.058, AGREES),
        ("tapered with 17 rollers of 4 mm, no axial load", 0.860, EXPLAINED),
        ("equal rollers, 300 N axially", 0.614, EXPLAINED),
    ],
)
def test_the_cylindrical_roller_bearing_is_not_always_the_stiffest(rows, case, ratio, verdict):
    row = rows[f"cylindrical roller bearing over the stiffest other, {case}"]
    assert row.ours == pytest.approx(ratio, abs=0.0005)
    assert row.verdict == verdict


def test_which_bearing_is_stiffer_than_the_cylindrical_one():
    """The tapered one; balls are softer by a third and more, whatever axial load of this size they have."""
    from drivewright import bearings

    cylindrical = shaft_bearings.radial_stiffness(bearings.bearing("hypothetical-CRB-20x32x7"))
    for axial in (0.0, 300.0):
        balls = [bearings.bearing(name) for name in shaft_bearings.KINDS if "TRB" not in name]
        assert max(shaft_bearings.radial_stiffness(ball, axial) for ball in balls) < 0.65 * cylindrical
    taper = bearings.bearing("hypothetical-TRB-20x32x7")
    assert shaft_bearings.radial_stiffness(taper, 300.0) == pytest.approx(1.96 * cylindrical, rel=0.01)


def test_a_61804_has_the_printed_stiffness_at_a_light_load_only(rows):
    row = rows["secant stiffness of a 61804 at 500 N"]
    assert row.ours == pytest.approx(5.02e7, abs=0.005e7)
    assert row.explanation.value == pytest.approx(3.0e7, abs=0.005e7)
    soft, stiff = shaft_bearings.secant_stiffness_of_61804(1.0), shaft_bearings.secant_stiffness_of_61804(8.0)
    assert stiff / soft == pytest.approx(2.0, abs=0.01), "it grows with the cube root of the load"


# -- presets -------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("preset", "bearings", "stations"),
    [
        ("pressure-roller", {"A": 56.5, "B": 136.5}, {"m1": 0, "m2": 245}),
        ("rubber-roller-r1", {"C": 135, "D": 461}, {"m3": 53, "m4": 201.5}),
        ("rubber-roller-r2", {"C": 95, "D": 148}, {"m3": 0, "m4": 230}),
        ("rubber-roller-r3", {"C": 135, "D": 201.5}, {"m3": 53, "m4": 461}),
    ],
)
def test_presets_are_the_readings(preset, bearings, stations):
    spec = dw.load(PRESETS[preset])
    assert {b.name: 1e3 * b.position for b in spec.bearings} == pytest.approx(bearings)
    assert {s.name: 1e3 * s.position for s in spec.stations} == pytest.approx(stations)
    assert {b.radial_stiffness for b in spec.bearings} == {3e7}
    result = dw.run(spec)
    assert result.outcome == "complete" and "stiffness" in result.arrays


def test_the_spindle_is_the_example():
    assert PRESETS["spindle"].read_text(encoding="utf-8") == SPINDLE.read_text(encoding="utf-8")


def test_the_paper_has_its_errata():
    assert len(shaft_paper.ERRATA) == 16 and all(text.endswith(".") for text in shaft_paper.ERRATA)
    for words in ("cantilevers", "Eq. (5)", "Eq. (6)", "Eq. (10)", "Eqs. (16), (17)", "Eq. (21)", "Section 4.1", "three of the four"):
        assert sum(words in text for text in shaft_paper.ERRATA) == 1
