"""The two shafts of a pipe-lining machine against numbers computed independently (unit-load integrals, an own beam programme, ROSS).

Printed digits are the tolerance: half a unit of the last one.  The diameter gives the paper's I = 7854 mm^4.
"""

from decimal import Decimal
from functools import cache

import numpy as np
import pytest

import drivewright as dw

pytestmark = pytest.mark.analytical

DIAMETER = "20.00001169 mm"
MASSES = {"m1": "3 kg", "m2": "8 kg", "m3": "25 kg", "m4": "10 kg"}
BALLS = {
    "balls": 12,
    "ball_diameter": "3.572 mm",
    "pitch_diameter": "26 mm",
    "inner_conformity": 0.52,
    "outer_conformity": 0.53,
    "youngs_modulus": "206 GPa",
    "poisson_ratio": 0.3,
}
EULER = "euler-bernoulli"


def printed(text):
    """What a printed number means: all that rounds to it."""
    number = Decimal(text)
    return pytest.approx(float(number), rel=0, abs=0.5001 * 10.0 ** number.as_tuple().exponent)


def meets(found, texts):
    """Whether numbers round to the printed ones."""
    texts = texts.replace(",", " ").split()
    assert len(found) == len(texts)
    assert [float(value) for value in found] == [printed(text) for text in texts]


def pressure_roller(l1=56.5, l2=80.0, l3=108.5):
    """(length, bearings, stations) of shaft 1 [mm]: overhangs both bearings."""
    return l1 + l2 + l3 + 95.0, {"A": l1, "B": l1 + l2}, {"m1": 0.0, "m2": l1 + l2 + l3}


def rubber_roller(l5=53.0, l6=82.0, l7=66.5, l8=259.5):
    """Shaft 2 in the reading R1: overhangs the left bearing, the second mass between them."""
    return l5 + l6 + l7 + l8 + 29.0, {"C": l5 + l6, "D": l5 + l6 + l7 + l8}, {"m3": l5, "m4": l5 + l6 + l7}


LAYOUTS = {
    "1": pressure_roller(),
    "R1": rubber_roller(),
    "R2": (259.0, {"C": 95.0, "D": 148.0}, {"m3": 0.0, "m4": 230.0}),
    "R3": (490.0, {"C": 135.0, "D": 201.5}, {"m3": 53.0, "m4": 461.0}),
}


def shaft(layout, stiffness="3.0e7 N/m", load=None, bearing=None, limits=None, **analysis):
    """The spec; `load` is (station, force), `bearing` the keys of every bearing instead of its stiffness, one for all or by name."""
    length, places, stations = LAYOUTS[layout] if isinstance(layout, str) else layout
    keys = bearing or {"radial_stiffness": stiffness}
    table = {
        "material": {"youngs_modulus": "206 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m^3", "yield_strength": "355 MPa"},
        "segments": [{"length": f"{length} mm", "diameter": DIAMETER}],
        "bearings": [{"name": name, "position": f"{at} mm", **keys.get(name, keys)} for name, at in places.items()],
        "stations": [{"name": name, "position": f"{at} mm", "mass": MASSES.get(name, "0 kg")} for name, at in stations.items()],
        "loads": [{"station": load[0], "force": load[1]}] if load else [],
        "analysis": analysis,
    }
    return dw.Shaft(**table, limits=limits or {})


@cache
def run(layout, stiffness="3.0e7 N/m", theory=EULER, only=("flexibility",)):
    return dw.run(shaft(layout, stiffness, theory=theory), only=only)


def three(array):
    """(11, 12, 22)."""
    return array.values[0, 0], array.values[0, 1], array.values[1, 1]


def delta(*arguments, **keys):
    return three(run(*arguments, **keys).arrays["flexibility"])


# -- flexibility and stiffness -------------------------------------------------------------------------------------------------

EULER_BERNOULLI = {  # flexibility rigid, elastic; stiffness rigid, elastic
    "1": (
        "8.977392e-8, 5.051947e-8, 4.571845e-7",
        "2.034432e-7, -8.208730e-8, 7.035621e-7",
        "1.187769e7, -1.312500e6, 2.332334e6",
        "5.158209e6, 6.018281e5, 1.491556e6",
    ),
    "R1": (
        "5.652083e-7, -2.618019e-7, 1.882006e-7",
        "6.195285e-7, -2.303044e-7, 2.107088e-7",
        "4.974600e6, 6.920061e6, 1.493983e7",
        "2.718823e6, 2.971668e6, 7.993913e6",
    ),
    "R2": (
        "2.751880e-7, 4.253084e-8, 1.870174e-7",
        "6.422107e-7, -2.536718e-7, 4.830777e-7",
        "3.766254e6, -8.565080e5, 5.541879e6",
        "1.964623e6, 1.031655e6, 2.611799e6",
    ),
    "R3": (
        "2.057192e-7, 1.457684e-7, 4.522858e-6",
        "4.226242e-7, -3.461964e-7, 5.831515e-6",
        "4.974600e6, -1.603278e5, 2.262664e5",
        "2.487118e6, 1.476514e5, 1.802476e5",
    ),
}


@pytest.mark.parametrize("layout", EULER_BERNOULLI)
@pytest.mark.parametrize(("place", "stiffness"), [(0, "rigid"), (1, "3.0e7 N/m")])
def test_flexibility_and_stiffness_without_shear(layout, place, stiffness):
    arrays = run(layout, stiffness).arrays
    meets(three(arrays["flexibility"]), EULER_BERNOULLI[layout][place])
    meets(three(arrays["stiffness"]), EULER_BERNOULLI[layout][2 + place])
    for array in (arrays["flexibility"].values, arrays["stiffness"].values):
        assert array[0, 1] == pytest.approx(array[1, 0], rel=1e-12)


@pytest.mark.parametrize(("layout", "ratios"), [("1", "2.266, 1.539"), ("R1", "1.0961, 1.1196")])
def test_what_elastic_bearings_do_to_the_diagonal(layout, ratios):
    rigid, elastic = delta(layout, "rigid"), delta(layout)
    meets((elastic[0] / rigid[0], elastic[2] / rigid[2]), ratios)


@pytest.mark.parametrize(
    ("layout", "bearing", "texts"),
    [
        ("1", "A", "9.70430e-8, -7.71367e-8, 6.13138e-8"),
        ("1", "B", "1.66263e-8, -5.54701e-8, 1.85064e-7"),
        ("R1", "C", "5.22112e-8, 3.32079e-8, 2.11212e-8"),
        ("R1", "D", "2.10897e-9, -1.71033e-9, 1.38703e-9"),
    ],
)
def test_share_of_each_bearing(layout, bearing, texts):
    """By the shares of the run on two springs, and as what one spring alone adds to rigid bearings."""
    array = run(layout).arrays["flexibility.shares"]
    share = array.values[array.labels[0].index(bearing)]
    meets((share[0, 0], share[0, 1], share[1, 1]), texts)
    each = {name: {"radial_stiffness": "3.0e7 N/m" if name == bearing else "rigid"} for name in LAYOUTS[layout][1]}
    alone = dw.run(shaft(layout, bearing=each, theory=EULER), only=("flexibility",))
    meets(np.subtract(three(alone.arrays["flexibility"]), delta(layout, "rigid")), texts)


@pytest.mark.parametrize(("layout", "below", "above"), [("1", 7.874585e7, 7.874595e7), ("R1", 3.609315e6, 3.609325e6)])
def test_the_cross_flexibility_changes_its_sign(layout, below, above):
    """Printed: 7.87459e7 and 3.60932e6 N/m, equal bearings."""
    low, high = (delta(layout, f"{k} N/m")[1] for k in (below, above))
    assert low * high < 0
    assert (low < 0) == (layout == "1")


@pytest.mark.parametrize(
    ("layout", "rigid", "elastic"),
    [
        ("1", "9.414345e-8, 4.704625e-8, 4.687721e-7", "2.078127e-7, -8.556052e-8, 7.151497e-7"),
        ("R1", "5.698598e-7, -2.618019e-7, 1.905999e-7", "6.241800e-7, -2.303044e-7, 2.131081e-7"),
    ],
)
def test_flexibility_with_shear(layout, rigid, elastic):
    meets(delta(layout, "rigid", theory="timoshenko"), rigid)
    meets(delta(layout, theory="timoshenko"), elastic)


@pytest.mark.parametrize(("stiffness", "texts"), [("rigid", "4.9, -6.9, 2.5"), ("3.0e7 N/m", "2.1, 4.2, 1.6")])
def test_what_shear_is_worth_on_the_pressure_roller(stiffness, texts):
    worth = np.divide(delta("1", stiffness, theory="timoshenko"), delta("1", stiffness)) - 1
    meets(100 * worth, texts)


def test_a_load_between_the_bearings_and_one_on_the_overhang_share_no_shear():
    array = run("R1", theory="timoshenko").arrays["flexibility.shares"]
    shear = array.values[array.labels[0].index("shear")]
    assert abs(shear[0, 1]) < 1e-12 * shear[0, 0] and shear[0, 0] > 1e-9 and shear[1, 1] > 1e-9


# -- lines under a unit load ---------------------------------------------------------------------------------------------------

LINES = {  # (shaft, load, bearings): nm/N at PLACES
    ("1", "m1", "rigid"): "89.7739 37.9196 0.0000 -13.9685 0.0000 24.9105 50.5195 94.7531",
    ("1", "m1", "3.0e7 N/m"): "203.4432 123.1918 56.8750 2.6981 -23.5417 -52.4098 -82.0873 -133.3485",
    ("1", "m2", "rigid"): "50.5195 25.2597 0.0000 -26.8245 0.0000 175.8727 457.1845 972.6898",
    ("1", "m2", "3.0e7 N/m"): "-82.0873 -63.6478 -45.2083 -10.1578 78.5417 337.1722 703.5621 1366.0206",
    ("R1", "m3", "rigid"): "967.2366 565.2083 261.3049 0.0000 -261.8019 -336.6441 -162.0965 0.0000 79.8583",
    ("R1", "m3", "3.0e7 N/m"): "1029.7023 619.5285 309.3239 41.7178 -230.3044 -319.9774 -161.1060 -8.3845 67.0169",
    ("R1", "m4", "rigid"): "-431.0153 -261.8019 -130.9009 0.0000 188.2006 257.8632 125.7878 0.0000 -62.0683",
    ("R1", "m4", "3.0e7 N/m"): "-396.3095 -230.3044 -101.8853 26.5337 210.7088 274.5298 136.2800 6.7996 -57.0242",
}
PLACES = {"1": (0, 28.25, 56.5, 96.5, 136.5, 190, 245, 340), "R1": (0, 53, 94, 135, 201.5, 298, 400, 461, 490)}


@pytest.mark.parametrize(("layout", "load", "stiffness"), LINES)
def test_lines_under_a_unit_load(layout, load, stiffness):
    """By stations all along, and by the table that is drawn."""
    length, bearings, stations = LAYOUTS[layout]
    at = PLACES[layout].index(stations[load])
    along = length, bearings, {f"s{number}": place for number, place in enumerate(PLACES[layout])}
    line = dw.run(shaft(along, stiffness, theory=EULER), only=("flexibility",)).arrays["flexibility"].values[:, at]
    meets(1e9 * line, LINES[layout, load, stiffness])
    table = run(layout, stiffness).tables["unit_load"]
    drawn = np.interp(1e-3 * np.array(PLACES[layout]), table["z"].data, table[load].data)
    assert drawn == pytest.approx(line, abs=1e-4 * np.abs(line).max())


def test_the_table_of_unit_loads_has_the_rigid_lines_too():
    table, rigid = (run("R1", k).tables["unit_load"] for k in ("3.0e7 N/m", "rigid"))
    assert table["m4.rigid"].data == pytest.approx(rigid["m4"].data, abs=1e-18)
    assert np.abs(table["m4.rigid"].data - table["m4"].data).max() > 1e-8


# -- sweeps --------------------------------------------------------------------------------------------------------------------

SWEEPS = [  # parameter [mm], what answers it, entry, rigid and elastic flexibility
    (
        "l1",
        lambda v: pressure_roller(l1=v),
        0,
        {20: "8.24101e-9 6.24077e-8", 40: "3.95569e-8 1.22890e-7", 80: "2.10970e-7 3.77637e-7", 100: "3.70846e-7 5.91679e-7"},
    ),
    (
        "l3",
        lambda v: pressure_roller(l3=v),
        2,
        {50: "6.69582e-8 1.68000e-7", 80: "2.10970e-7 3.77637e-7", 140: "8.88381e-7 1.24255e-6", 170: "1.48853e-6 1.96457e-6"},
    ),
    (
        "l5",
        lambda v: rubber_roller(l5=v, l6=135 - v),
        0,
        {0: "1.73097e-6 1.80334e-6", 25: "1.08691e-6 1.15033e-6", 80: "2.37449e-7 2.83928e-7", 110: "4.51968e-8 8.40347e-8"},
    ),
    (
        "l7",
        lambda v: rubber_roller(l7=v, l8=326 - v),
        2,
        {30: "4.98344e-8 7.75973e-8", 100: "3.22790e-7 3.41946e-7", 163: "4.46122e-7 4.62788e-7", 260: "1.86096e-7 2.08665e-7"},
    ),
]


@pytest.mark.parametrize(
    ("layout", "entry", "texts"),
    [
        pytest.param(make(value), entry, texts, id=f"{name}={value}")
        for name, make, entry, table in SWEEPS
        for value, texts in table.items()
    ],
)
def test_sweeps_of_the_lengths(layout, entry, texts):
    found = [three(dw.run(shaft(layout, k, theory=EULER), only=("flexibility",)).arrays["flexibility"]) for k in ("rigid", "3.0e7 N/m")]
    meets([each[entry] for each in found], texts)


def test_lengths_that_do_not_matter():
    """l1 is not felt by m2, and where l5 or a tail alone changes the shaft only moves along."""
    at_hand = [
        dw.run(shaft(layout, theory=EULER), only=("flexibility",)).arrays["flexibility"].values
        for layout in (pressure_roller(), pressure_roller(l1=80), rubber_roller(), rubber_roller(l5=10))
    ]
    assert at_hand[0][1, 1] == pytest.approx(at_hand[1][1, 1], rel=1e-11)
    assert at_hand[2] == pytest.approx(at_hand[3], rel=1e-11)


@pytest.mark.parametrize(
    ("stiffness", "texts"),
    [
        ("1e7 N/m", "4.30782e-7 -3.47301e-7 1.19632e-6 7.28169e-7 -1.67309e-7 2.55725e-7"),
        ("1e8 N/m", "1.23875e-7 1.07374e-8 5.31098e-7 5.81504e-7 -2.52353e-7 1.94953e-7"),
        ("1e9 N/m", "9.31840e-8 4.65413e-8 4.64576e-7 5.66838e-7 -2.60857e-7 1.88876e-7"),
    ],
)
def test_stiffness_of_the_bearings(stiffness, texts):
    meets((*delta("1", stiffness), *delta("R1", stiffness)), texts)


@pytest.mark.parametrize(
    ("layout", "parameter", "texts"),
    [
        ("1", "distance.m1-A", "1.6235 0.4493 0.0000"),
        ("1", "distance.A-B", "-0.2997 -3.0088 -0.2013"),
        ("1", "distance.B-m2", "0.0000 0.7132 2.1508"),
        ("1", "bearings.stiffness", "-0.5587 -1.6154 -0.3502"),
        ("1", "youngs_modulus", "-0.4413 0.6154 -0.6498"),
        ("R1", "bearings.stiffness", "-0.0877 0.1368 -0.1068"),
        ("R1", "youngs_modulus", "-0.9123 -1.1368 -0.8932"),
        ("R1", "distance.m3-C", "2.0487 1.1152 0.0000"),
    ],
)
def test_sensitivities(layout, parameter, texts):
    result, (one, two) = run(layout, only=("sensitivities",)), LAYOUTS[layout][2]
    meets([result[f"sensitivity.{pair}.{parameter}"] for pair in (f"{one}.{one}", f"{one}.{two}", f"{two}.{two}")], texts)


def test_the_section_counts_four_times_the_modulus_and_stiffnesses_sum_to_minus_one():
    result = run("1", only=("sensitivities",))
    for pair in ("m1.m1", "m1.m2", "m2.m2"):
        modulus, bearings = (result[f"sensitivity.{pair}.{name}"] for name in ("youngs_modulus", "bearings.stiffness"))
        assert modulus + bearings == pytest.approx(-1, abs=1e-9)
        assert result[f"sensitivity.{pair}.segments.0.diameter"] == pytest.approx(4 * modulus, abs=1e-8)
    assert any("parts to the right move along" in held for held in result.tables["sensitivities"]["held"].data)


# -- vibration -----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("layout", "theory", "texts", "third"),
    [
        ("1", EULER, "64.477 207.033 953.7", 953.55),
        ("1", "timoshenko", "63.950 205.103 938.5", 937.98),
        ("R1", EULER, "38.965 141.764 776.7", 776.53),
        ("R1", "timoshenko", "38.835 140.079 766.3", 765.98),
    ],
)
def test_natural_frequencies(layout, theory, texts, third):
    """The printed third mode is that of elements of some 55 mm, up to 0.06 % above where finer meshes lead."""
    coarse, usual = (dw.run(shaft(layout, theory=theory, **mesh), only=("modes",)) for mesh in ({"element_length": "55 mm"}, {}))
    meets([usual["modes.1.frequency"], usual["modes.2.frequency"], coarse["modes.3.frequency"]], texts)
    assert usual["modes.3.frequency"] == pytest.approx(third, abs=0.015)
    assert third + 0.1 < coarse["modes.3.frequency"]


@pytest.mark.parametrize(("layout", "texts"), [("1", "66.8947 209.2863"), ("R1", "39.2826 146.4938")])
def test_frequencies_on_a_massless_shaft(layout, texts):
    """The other computation has 39.2825 and 146.4939 for the last two, one off in the last place; det(1/w^2 - delta m) = 0 has these."""
    result = run(layout, only=("flexibility", "modes"))
    meets([result[f"massless_modes.{n}.frequency"] for n in (1, 2)], texts)
    (a, b, c), (m, n) = delta(layout), [float(MASSES[name].split()[0]) for name in LAYOUTS[layout][2]]
    trace, determinant = m * a + n * c, m * n * (a * c - b * b)
    root = np.sqrt(trace**2 - 4 * determinant)
    meets(np.sqrt(np.array([trace - root, trace + root]) / (2 * determinant)) / (2 * np.pi), texts)


def test_a_uniform_shaft_on_rigid_ends():
    """f_n = n^2 pi/2 sqrt(EI/(rho A L^4)): Euler and Bernoulli."""
    result = dw.run(shaft((500.0, {"A": 0.0, "B": 500.0}, {}), "rigid", theory=EULER), only=("modes",))
    diameter = 0.02000001169
    first = np.pi / 2 * np.sqrt(206e9 * diameter**2 / 16 / 7850) / 0.5**2
    assert [result[f"modes.{n}.frequency"] for n in (1, 2, 3)] == pytest.approx([first, 4 * first, 9 * first], rel=3e-6)


def test_error_of_the_massless_shaft_is_told():
    """4 to 5 % on mode 1 of the pressure roller where shear is left out, too; 3.7 % is due to the mass alone."""
    simple, full = (run("1", theory=theory, only=("flexibility", "modes")) for theory in (EULER, "timoshenko"))
    assert 0.04 < simple["massless_modes.1.frequency"] / full["modes.1.frequency"] - 1 < 0.05
    for result in (simple, full):
        off = 100 * (result["massless_modes.1.frequency"] / result["modes.1.frequency"] - 1)
        assert any("neglecting the shaft's own mass" in finding and f"{off:+.1f} %" in finding for finding in result.findings)
        assert 3.6 < off < 3.8


# -- what fails first ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("layout", "station", "reaction", "moment", "crushed", "bent"),
    [
        ("1", "m1", "1.70625", "0.0565", "1360", "4935"),
        ("1", "m2", "2.35625", "0.1085", "985", "2570"),
        ("R1", "m3", "1.25153", "0.0820", "1854", "3400"),
        ("R1", "m4", "0.79601", "0.052935", "2915", "5267"),
    ],
)
def test_what_fails_first(layout, station, reaction, moment, crushed, bent):
    rated = {"radial_stiffness": "3.0e7 N/m", "static_rating": "2.32 kN"}
    result = dw.run(shaft(layout, bearing=rated, load=(station, "1 N"), theory=EULER), only=("statics", "failure"))
    carried = [result[f"bearings.{name}.reaction"] for name in LAYOUTS[layout][1]]
    assert max(np.abs(carried)) == printed(reaction)
    array = result.arrays["reactions.unit_load"]
    assert array.values[:, array.labels[1].index(station)] == pytest.approx(carried, abs=1e-9)
    assert result["shaft.max_moment"] == printed(moment)
    table = result.tables["failure"]
    mine = table["station"].data == station
    loads = dict(zip(table["part"].data[mine], table["load"].data[mine], strict=True))
    bearing = min(load for part, load in loads.items() if part.startswith("bearing"))
    assert bearing == printed(crushed) and bearing == result[f"stations.{station}.limit_load"]
    assert loads["shaft, yield"] == printed(bent)


@pytest.mark.parametrize(("shock", "allowed"), [(4, 245), (6, 160)])
def test_shock_leaves_little_of_the_load(shock, allowed):
    """About 160 to 245 N at the pressure roller."""
    rated = {"radial_stiffness": "3.0e7 N/m", "static_rating": "2.32 kN"}
    result = dw.run(shaft("1", bearing=rated, limits={"shock_factor": shock}), only=("failure",))
    assert result["stations.m2.allowed_load"] == pytest.approx(2320 / 2.35625 / shock, rel=1e-9)
    assert result["stations.m2.allowed_load"] == pytest.approx(allowed, abs=5)


# -- rolling bearings ----------------------------------------------------------------------------------------------------------


def coupled(layout, load, free):
    keys = {"geometry": BALLS, "free": free}
    return dw.run(shaft(layout, bearing=keys, load=load, theory=EULER), only=("rolling",))


RADIAL = ["axial", "tilt"]


def test_shaft_and_bearings_together():
    """Bearings that only carry across the shaft, as in the other computation: their rings slide and tilt along."""
    result = coupled("1", ("m2", "500 N"), RADIAL)
    meets((result["bearings.A.reaction"], result["bearings.B.reaction"]), "-678.125 1178.125")
    meets(
        [1e6 * result[name] for name in ("bearings.A.displacement", "bearings.B.displacement", "stations.m2.deflection")],
        "-12.2115 17.6478 286.737",
    )


@pytest.mark.parametrize(("layout", "station", "text"), [("1", "m2", "549.483"), ("R1", "m3", "589.789")])
def test_shaft_and_bearings_together_under_1000_newton(layout, station, text):
    assert 1e6 * coupled(layout, (station, "1000 N"), RADIAL)[f"stations.{station}.deflection"] == printed(text)


def test_bearings_also_resist_tilting():
    """With all five freedoms the balls hold the tilting shaft a little: 285.45 instead of 286.74 um, and moments at the bearings."""
    full, radial = (coupled("1", ("m2", "500 N"), free) for free in ((), RADIAL))
    assert 1e6 * full["stations.m2.deflection"] == pytest.approx(285.45, abs=0.005)
    assert full["stations.m2.deflection"] < radial["stations.m2.deflection"]
    assert full["bearings.B.moment"] > 0.1
    assert "bearings.B.moment" not in radial.values or radial["bearings.B.moment"] < 1e-6


def test_secant_and_tangent_with_the_load_behind_them():
    """Where all balls bear on one line d ~ F^(2/3): the secant is two thirds of the tangent."""
    result = coupled("1", ("m2", "500 N"), RADIAL)
    for name, load in (("A", 678.125), ("B", 1178.125)):
        stiffness = {key: result[f"bearings.{name}.stiffness.{key}"] for key in ("tangent", "secant", "load")}
        assert stiffness["load"] == pytest.approx(load, abs=1e-3)
        assert stiffness["secant"] == pytest.approx(load / abs(result[f"bearings.{name}.displacement"]), rel=1e-6)
        assert stiffness["secant"] / stiffness["tangent"] == pytest.approx(2 / 3, abs=2e-3)


@pytest.mark.parametrize(
    ("stiffness", "texts"),
    [
        ("7.53e7 N/m", "1.351e-7 5.553e-7 5.868e-7 1.972e-7"),
        ("1.12e8 N/m", "1.202e-7 5.232e-7 5.798e-7 1.942e-7"),
        ("1.91e8 N/m", "1.076e-7 4.959e-7 5.737e-7 1.917e-7"),
        ("5.0e8 N/m", "9.659e-8 4.720e-7 5.685e-7 1.896e-7"),
    ],
)
def test_shafts_on_the_stiffness_of_four_bearings(stiffness, texts):
    """Deep groove, angular contact, cylindrical, tapered: their tangents at 500 N."""
    one, two = delta("1", stiffness), delta("R1", stiffness)
    meets((one[0], one[2], two[0], two[2]), texts)


# -- names ---------------------------------------------------------------------------------------------------------------------


def test_labels_and_axes_of_the_arrays():
    arrays = run("R1").arrays
    stations, bearings = ("m3", "m4"), ("C", "D")
    told = {
        "flexibility": ("m/N", ("station", "station"), (stations, stations)),
        "stiffness": ("N/m", ("station", "station"), (stations, stations)),
        "flexibility.shares": ("m/N", ("part", "station", "station"), (("bending", "shear", *bearings), stations, stations)),
        "reactions.unit_load": ("-", ("bearing", "station"), (bearings, stations)),
    }
    assert {name: tuple(arrays[name][:3]) for name in told} == told
    for name in told:
        assert arrays[name].values.shape == tuple(len(labels) for labels in arrays[name].labels)
    assert arrays["flexibility.shares"].values.sum(axis=0) == pytest.approx(arrays["flexibility"].values, rel=1e-9)


def test_names_of_the_values():
    result = dw.run(shaft("1", load=("m1", "500 N")))
    for name, unit in {
        "stations.m1.deflection": "m",
        "stations.m2.slope": "rad",
        "bearings.A.reaction": "N",
        "condition_number": "-",
        "bearings.B.stiffness.tangent": "N/m",
        "bearings.B.stiffness.secant": "N/m",
        "modes.1.frequency": "Hz",
    }.items():
        assert result.values[name].unit == unit and np.isfinite(result[name])
    assert result["stations.m1.deflection"] == pytest.approx(500 * delta("1", theory="timoshenko")[0], rel=1e-9)
    assert result["stations.m1.deflection_y"] == pytest.approx(-result["stations.m1.deflection"], rel=1e-12)
    assert (result["bearings.A.reaction"], result["bearings.B.reaction"]) == pytest.approx((853.125, -353.125), rel=1e-9)


def test_a_force_has_the_direction_it_is_given():
    """Up at 90 deg, along x at 0 deg; unless told, down."""
    for angle, axis, sign in (("90 deg", "y", 1), ("0 deg", "x", 1), (None, "y", -1)):
        load = {"station": "m2", "force": "500 N"} | ({"angle": angle} if angle else {})
        base = shaft("1", load=("m2", "500 N"), theory=EULER)
        found = dw.run(base.replace(loads=[load]), only=("statics",))
        assert found[f"stations.m2.deflection_{axis}"] == pytest.approx(sign * 500 * delta("1")[2], rel=1e-9)
        assert found[f"stations.m2.deflection_{'x' if axis == 'y' else 'y'}"] == pytest.approx(0, abs=1e-15)


def test_stiffness_is_withheld_where_a_station_stands_on_a_rigid_bearing():
    length, bearings, stations = LAYOUTS["1"]
    result = dw.run(shaft((length, bearings, {**stations, "seat": bearings["A"]}), "rigid"), only=("flexibility",))
    assert "flexibility" in result.arrays and "stiffness" not in result.arrays
    assert any("'seat' stands on a rigid bearing" in finding for finding in result.findings)
