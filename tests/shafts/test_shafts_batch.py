"""The two-bearing shafts of the spiral-winding paper, re-computed: flexibility, stiffness, curves, sweeps and sensitivities, by the closed
form and by the sweep over a stepped shaft, to every printed digit.

The numbers were computed by three solvers other than this package (beam elements, unit-load integral, Macaulay's equations), with
I = 7854 mm^4, which the diameter below has.
"""

import numpy as np
import pytest

from drivewright.shafts.batch import flexibilities
from drivewright.shafts.closed_form import flexibility
from drivewright.shafts.model import COWPER, EULER_BERNOULLI
from drivewright.shafts.sections import area, cowper_coefficient, second_moment

pytestmark = pytest.mark.analytical

DIAMETER, MODULUS, POISSON, NOMINAL = 20.00001169e-3, 206e9, 0.3, 3.0e7
# bearings, stations [m]
LAYOUTS = {
    "1": ((0.0565, 0.1365), (0.0, 0.245)),
    "R1": ((0.135, 0.461), (0.053, 0.2015)),
    "R2": ((0.095, 0.148), (0.0, 0.230)),
    "R3": ((0.135, 0.2015), (0.053, 0.461)),
}


def closed(supports, stations, stiffness=NOMINAL, shear=EULER_BERNOULLI, modulus=MODULUS, reactions=False):
    """The uniform shaft, stated as two equal sections: the batch takes the closed form."""
    return flexibilities([0.3, 0.3], DIAMETER, supports, stiffness, stations, modulus, POISSON, shear, reactions=reactions)


def swept(supports, stations, stiffness=NOMINAL, shear=EULER_BERNOULLI, modulus=MODULUS, reactions=False):
    """The same with a thick end beyond everything, which carries nothing: the batch takes the way of stepped shafts."""
    return flexibilities([0.49, 0.1], [DIAMETER, 2 * DIAMETER], supports, stiffness, stations, modulus, POISSON, shear, reactions=reactions)


def arrays(supports, stations, stiffness=NOMINAL, shear=EULER_BERNOULLI, modulus=MODULUS):
    """The closed form in numpy."""
    slide = modulus / 2.6 * area(DIAMETER, 0.0) * cowper_coefficient(DIAMETER, 0.0, POISSON) if shear == COWPER else np.inf
    stiffness = np.broadcast_to(stiffness, np.shape(stiffness)[:-1] + (2,))
    delta = flexibility(stations, supports, stiffness, modulus * second_moment(DIAMETER, 0.0), slide)
    return delta if delta.ndim == 3 else delta[None]


routes = pytest.mark.parametrize("route", [closed, swept, arrays])


def agree(ours, printed):
    """Every value rounds to what is printed."""
    printed = printed.split() if isinstance(printed, str) else list(printed)
    ours = np.ravel(ours)
    assert len(ours) == len(printed) > 0
    for value, text in zip(ours, printed, strict=True):
        digits, _, power = text.partition("e")
        unit = 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))
        assert abs(value - float(text)) <= 0.5 * unit * (1 + 1e-3), f"{value!r} is printed as {text}"


def upper(matrices):
    """11, 12, 22."""
    return np.asarray(matrices)[..., [0, 0, 1], [0, 1, 1]]


def test_the_second_moment_is_that_of_the_numbers():
    assert np.isclose(second_moment(DIAMETER, 0.0), 7854e-12, rtol=5e-10)


@routes
@pytest.mark.parametrize(
    ("layout", "stiffness", "delta", "stiff"),
    [
        ("1", np.inf, "8.977392e-8 5.051947e-8 4.571845e-7", "1.187769e7 -1.312500e6 2.332334e6"),
        ("1", 3e7, "2.034432e-7 -8.208730e-8 7.035621e-7", "5.158209e6 6.018281e5 1.491556e6"),
        ("R1", np.inf, "5.652083e-7 -2.618019e-7 1.882006e-7", "4.974600e6 6.920061e6 1.493983e7"),
        ("R1", 3e7, "6.195285e-7 -2.303044e-7 2.107088e-7", "2.718823e6 2.971668e6 7.993913e6"),
        ("R2", np.inf, "2.751880e-7 4.253084e-8 1.870174e-7", "3.766254e6 -8.565080e5 5.541879e6"),
        ("R2", 3e7, "6.422107e-7 -2.536718e-7 4.830777e-7", "1.964623e6 1.031655e6 2.611799e6"),
        ("R3", np.inf, "2.057192e-7 1.457684e-7 4.522858e-6", "4.974600e6 -1.603278e5 2.262664e5"),
        ("R3", 3e7, "4.226242e-7 -3.461964e-7 5.831515e-6", "2.487118e6 1.476514e5 1.802476e5"),
    ],
)
def test_euler_bernoulli(route, layout, stiffness, delta, stiff):
    found = route(*LAYOUTS[layout], stiffness)[0]
    agree(upper(found), delta)
    agree(upper(np.linalg.inv(found)), stiff)


@routes
@pytest.mark.parametrize(
    ("layout", "stiffness", "delta"),
    [
        ("1", np.inf, "9.414345e-8 4.704625e-8 4.687721e-7"),
        ("1", 3e7, "2.078127e-7 -8.556052e-8 7.151497e-7"),
        ("R1", np.inf, "5.698598e-7 -2.618019e-7 1.905999e-7"),
        ("R1", 3e7, "6.241800e-7 -2.303044e-7 2.131081e-7"),
    ],
)
def test_timoshenko(route, layout, stiffness, delta):
    agree(upper(route(*LAYOUTS[layout], stiffness, COWPER)[0]), delta)


@routes
@pytest.mark.parametrize(
    ("layout", "elastic", "delta"),
    [
        ("1", 0, "9.70430e-8 -7.71367e-8 6.13138e-8"),
        ("1", 1, "1.66263e-8 -5.54701e-8 1.85064e-7"),
        ("R1", 0, "5.22112e-8 3.32079e-8 2.11212e-8"),
        ("R1", 1, "2.10897e-9 -1.71033e-9 1.38703e-9"),
    ],
)
def test_share_of_one_bearing(route, layout, elastic, delta):
    stiffness = [np.inf, np.inf]
    stiffness[elastic] = 3e7
    agree(upper(route(*LAYOUTS[layout], stiffness)[0] - route(*LAYOUTS[layout], np.inf)[0]), delta)


@routes
@pytest.mark.parametrize(("layout", "stiffness", "last"), [("1", 7.87459e7, 1e2), ("R1", 3.60932e6, 1e1)])
def test_cross_flexibility_changes_its_sign(route, layout, stiffness, last):
    low, high = (route(*LAYOUTS[layout], value)[0, 0, 1] for value in (stiffness - last, stiffness + last))
    assert low * high < 0.0


@routes
@pytest.mark.parametrize(
    ("layout", "places", "curves"),
    [
        (
            "1",
            (0, 28.25, 56.5, 96.5, 136.5, 190, 245, 340),
            {
                (0, np.inf): "89.7739 37.9196 0 -13.9685 0 24.9105 50.5195 94.7531",
                (0, 3e7): "203.4432 123.1918 56.8750 2.6981 -23.5417 -52.4098 -82.0873 -133.3485",
                (1, np.inf): "50.5195 25.2597 0 -26.8245 0 175.8727 457.1845 972.6898",
                (1, 3e7): "-82.0873 -63.6478 -45.2083 -10.1578 78.5417 337.1722 703.5621 1366.0206",
            },
        ),
        (
            "R1",
            (0, 53, 94, 135, 201.5, 298, 400, 461, 490),
            {
                (0, np.inf): "967.2366 565.2083 261.3049 0 -261.8019 -336.6441 -162.0965 0 79.8583",
                (0, 3e7): "1029.7023 619.5285 309.3239 41.7178 -230.3044 -319.9774 -161.1060 -8.3845 67.0169",
                (1, np.inf): "-431.0153 -261.8019 -130.9009 0 188.2006 257.8632 125.7878 0 -62.0683",
                (1, 3e7): "-396.3095 -230.3044 -101.8853 26.5337 210.7088 274.5298 136.2800 6.7996 -57.0242",
            },
        ),
    ],
)
def test_curves_under_a_unit_force(route, layout, places, curves):
    supports, stations = LAYOUTS[layout]
    for (load, stiffness), printed in curves.items():
        delta = route(supports, [*(1e-3 * np.array(places)), stations[load]], stiffness)[0]
        agree(1e9 * delta[:-1, -1], printed.replace(" 0 ", " 0.0000 "))


@routes
@pytest.mark.parametrize(
    ("swept_length", "values", "entry", "printed"),
    [
        ("l1", (20, 40, 80, 100), 0, "8.24101e-9 6.24077e-8 3.95569e-8 1.22890e-7 2.10970e-7 3.77637e-7 3.70846e-7 5.91679e-7"),
        ("l3", (50, 80, 140, 170), 1, "6.69582e-8 1.68000e-7 2.10970e-7 3.77637e-7 8.88381e-7 1.24255e-6 1.48853e-6 1.96457e-6"),
        ("l5", (0, 25, 80, 110), 0, "1.73097e-6 1.80334e-6 1.08691e-6 1.15033e-6 2.37449e-7 2.83928e-7 4.51968e-8 8.40347e-8"),
        ("l7", (30, 100, 163, 260), 1, "4.98344e-8 7.75973e-8 3.22790e-7 3.41946e-7 4.46122e-7 4.62788e-7 1.86096e-7 2.08665e-7"),
    ],
)
def test_sweeps(route, swept_length, values, entry, printed):
    """One call a sweep: eight designs, rigid and elastic in turn."""
    places = {
        "l1": lambda l: ((l, l + 0.080), (0.0, l + 0.1885)),
        "l3": lambda l: ((0.0565, 0.1365), (0.0, 0.1365 + l)),
        "l5": lambda l: ((0.135, 0.461), (l, 0.2015)),
        "l7": lambda l: ((0.135, 0.461), (0.053, 0.135 + l)),
    }[swept_length]
    supports, stations = (np.repeat(each, 2, axis=0) for each in zip(*(places(1e-3 * value) for value in values), strict=True))
    delta = route(supports, stations, np.tile([[np.inf], [3e7]], (4, 1)))
    agree(delta[:, entry, entry], printed)
    if swept_length == "l1":
        assert np.allclose(delta[::2, 1, 1], 4.571845e-7, rtol=1e-6, atol=0)


@routes
@pytest.mark.parametrize(
    ("stiffness", "printed"),
    [
        (1e7, "4.30782e-7 -3.47301e-7 1.19632e-6 7.28169e-7 -1.67309e-7 2.55725e-7"),
        (1e8, "1.23875e-7 1.07374e-8 5.31098e-7 5.81504e-7 -2.52353e-7 1.94953e-7"),
        (1e9, "9.31840e-8 4.65413e-8 4.64576e-7 5.66838e-7 -2.60857e-7 1.88876e-7"),
    ],
)
def test_bearing_stiffness(route, stiffness, printed):
    agree(np.concatenate([upper(route(*LAYOUTS[layout], stiffness)[0]) for layout in ("1", "R1")]), printed)


SENSITIVITIES = {
    "1": {
        "l1": "1.6235 0.4493 0.0000",
        "l2": "-0.2997 -3.0088 -0.2013",
        "l3": "0.0000 0.7132 2.1508",
        "k": "-0.5587 -1.6154 -0.3502",
        "E": "-0.4413 0.6154 -0.6498",
    },
    "R1": {"k": "-0.0877 0.1368 -0.1068", "E": "-0.9123 -1.1368 -0.8932", "l6": "2.0487 1.1152 0.0000"},
}


@routes
@pytest.mark.parametrize(("layout", "name"), [(layout, name) for layout, each in SENSITIVITIES.items() for name in each])
def test_logarithmic_sensitivities(route, layout, name):
    """d ln delta / d ln p by central differences of one call; what is left of the first station does not matter, so l6 may grow alone."""
    step = 1e-4
    factors = np.exp([step, -step])
    of = {key: factors if key == name else np.ones(2) for key in ("l1", "l2", "l3", "l6", "k", "E")}
    if layout == "1":
        ends = np.cumsum([0.0565 * of["l1"], 0.080 * of["l2"], 0.1085 * of["l3"]], axis=0)
        supports, stations = ends[:2].T, np.array([np.zeros(2), ends[2]]).T
    else:
        supports, stations = LAYOUTS["R1"][0], np.array([0.135 - 0.082 * of["l6"], np.full(2, 0.2015)]).T
    delta = upper(route(np.broadcast_to(supports, (2, 2)), stations, NOMINAL * of["k"][:, None], modulus=MODULUS * of["E"]))
    agree(np.log(delta[0] / delta[1]) / (2 * step), SENSITIVITIES[layout][name])


@pytest.mark.parametrize("route", [closed, swept])
@pytest.mark.parametrize(("layout", "largest"), [("1", "1.70625 2.35625"), ("R1", "1.25153 0.79601")])
def test_largest_reaction_per_unit_force(route, layout, largest):
    agree(np.abs(route(*LAYOUTS[layout], reactions=True)[1][0]).max(axis=0), largest)
