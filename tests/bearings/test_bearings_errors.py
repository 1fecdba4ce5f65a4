"""What a ball bearing, and the search for its equilibrium, refuse; the messages are read."""

from typing import NamedTuple

import numpy as np
import pytest

from drivewright import bearings
from drivewright._jit import implements
from drivewright.bearings import BallBearing, basic_dynamic_rating, basic_life, law_of, newton, solve, solving
from drivewright.bearings.response import response
from drivewright.errors import InputError, SolverError, SpecError, UnknownName

pytestmark = pytest.mark.error

GIVEN = {"balls": 7, "ball_diameter": "11.5 mm", "pitch_diameter": "43.5 mm"}
BEARING = BallBearing(**GIVEN)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"balls": 2}, "balls: must be at least 3, got 2"),
        ({"balls": 7.5}, "balls: must be a whole number, got 7.5"),
        ({"ball_diameter": "0 mm"}, "ball_diameter: must be greater than 0 mm, got 0 mm"),
        ({"balls": 12}, "ball_diameter: 12 balls of 11.5 mm do not fit on the pitch circle, where they are 11.2586 mm apart; take fewer"),
        ({"inner_conformity": 0.5}, "inner_conformity: must be greater than 0.5, got 0.5"),
        ({"outer_conformity": 0.48}, "outer_conformity: must be greater than 0.5, got 0.48"),
        (
            {"radial_clearance": "1.2 mm"},
            "radial_clearance: 1.2 mm leaves no contact angle: with grooves whose centres are 0.575 mm apart it "
            "must stay within +-1.15 mm; check the unit",
        ),
        ({"radial_clearance": "-1.2 mm"}, "radial_clearance: -1.2 mm leaves no contact angle"),
        ({"radial_clearance": "0.9 mm", "contact_angle": "40 deg"}, r"radial_clearance: 0.9 mm leaves .* within +-0.880951 mm"),
        ({"contact_angle": "90 deg"}, "contact_angle: must be less than 90 deg, got 90 deg"),
        ({"contact_angle": "-1 deg"}, "contact_angle: must be at least 0 deg, got -1 deg"),
        ({"dynamic_rating": "0 N"}, "dynamic_rating: must be greater than 0 N"),
        ({"poisson_ratio": 0.5}, "poisson_ratio: must be less than 0.5, got 0.5"),
        ({"clearance": "1 um"}, "clearance: unknown key .did you mean 'radial_clearance'"),
    ],
)
def test_impossible_bearings(changes, message):
    with pytest.raises(SpecError, match=message.replace("+-", r"\+-")):
        BallBearing(**{**GIVEN, **changes})


def test_a_bare_number_is_no_diameter():
    with pytest.raises(SpecError, match="ball_diameter: unit missing: a length"):
        BallBearing(**{**GIVEN, "ball_diameter": 11.5})


@pytest.mark.parametrize("given", [{}, {"force": np.zeros(5), "displacement": np.zeros(5)}])
def test_force_or_displacement(given):
    with pytest.raises(InputError, match=r"give either force=\[Fx, Fy, Fz, Mx, My\] or displacement=\[x, y, z, tilt_x, tilt_y\]"):
        solve(BEARING, **given)


@pytest.mark.parametrize("value", [[1, 2, 3], 5.0, [1, 2, 3, 4, "x"], [0, 0, np.nan, 0, 0], [0, np.inf, 0, 0, 0], np.zeros((1, 5))])
@pytest.mark.parametrize(("name", "units"), [("force", "N, N, N, N·m, N·m"), ("displacement", "m, m, m, rad, rad")])
def test_five_finite_numbers(name, units, value):
    with pytest.raises(InputError, match=rf"{name} needs five finite numbers \[{units}\], got"):
        solve(BEARING, **{name: value})


def test_a_displacement_beyond_all_numbers():
    with pytest.raises(InputError, match=r"the displacement \[1e\+200, 0, 0, 0, 0\] is too large; it is in m and rad"):
        solve(BEARING, displacement=[1e200, 0, 0, 0, 0])


def test_start_wants_five_numbers_too():
    with pytest.raises(InputError, match="start needs five finite numbers"):
        solve(BEARING, force=np.zeros(5), start=[0, 0, 0])


def test_held_freedoms():
    with pytest.raises(UnknownName, match="no freedom of a bearing is called 'tilt_z'.*; known: tilt_x, tilt_y, x, y, z"):
        solve(BEARING, force=np.zeros(5), held=("tilt_z",))
    with pytest.raises(InputError, match="y is held, so its force is a reaction to be found, but 20 is given; set it to 0"):
        solve(BEARING, force=[10, 20, 0, 0, 0], held=("y",))
    with pytest.raises(InputError, match="held and start need a given force"):
        solve(BEARING, displacement=np.zeros(5), held=("y",))


def test_what_is_no_bearing():
    with pytest.raises(InputError, match=r"'6205' is no bearing; build one, e.g. BallBearing"):
        law_of("6205")


def test_life():
    with pytest.raises(InputError, match="the life needs a load above 0 N, got -5"):
        basic_life(BEARING, -5)
    with pytest.raises(InputError, match="no dynamic rating is known for grooves of 0.52 and 0.54 ball diameters; .* Give dynamic_rating"):
        basic_dynamic_rating(BEARING.replace(outer_conformity=0.54))


# ------------------------------------------------------------------------------------------------ bearings of a test's own


class Track(NamedTuple):
    """A stiffness along x and one against +z; the other freedoms are free.  At x = 0 the force jumps by twice `ripple`."""

    k: float
    ripple: float = 0.0


class Rail:
    """A bearing without axial hold, and one that no Newton step can solve."""

    def __init__(self, ripple=0.0):
        self.law = Track(1e6, ripple)


@solving.law_of.register(Rail)
def _(bearing):
    return bearing.law


@implements(newton.measures, Track)
def _(law):
    return newton.BearingMeasures(1e-3, 1.0, 0.0, 0, 0)


@implements(solving.elements, Track)
def _(law, displacement, loads, angles, pressures, laminae):
    return


@implements(response, Track)
def _(law, displacement, force, stiffness):
    for i in range(5):
        force[i] = 0.0
        for j in range(5):
            stiffness[i, j] = 0.0
    z = max(displacement[2], 0.0)
    force[0], force[2] = law.k * displacement[0], law.k * z
    if law.ripple > 0.0:
        force[0] += law.ripple * (1.0 if displacement[0] > 0.0 else -1.0)
    stiffness[0, 0], stiffness[2, 2] = law.k, law.k if z > 0.0 else 0.0
    return 0.5 * law.k * (displacement[0] ** 2 + z**2)


def test_a_force_that_nothing_resists():
    message = (
        r"nothing resists -z, where -7 N of the force \[10, 0, -7, 0, 0\] acts: the inner ring moves without limit. "
        r"Reverse the force, hold it with held=\('z',\)"
    )
    with pytest.raises(InputError, match=message):
        solve(Rail(), force=[10, 0, -7, 0, 0])
    with pytest.raises(InputError, match=r"nothing resists \+tilt_x, where 2 N·m of the force"):
        solve(Rail(), force=[10, 0, 0, 2, 0])


def test_a_freedom_that_nothing_pushes_stays_at_its_start():
    state = solve(Rail(), force=[10, 0, 0, 0, 0], start=[0, 3e-3, -2e-3, 1e-2, 0])
    np.testing.assert_allclose(state.displacement, [1e-5, 3e-3, -2e-3, 1e-2, 0], rtol=1e-9)
    held = solve(Rail(), force=[10, 0, 0, 0, 0], held="z", start=[0, 0, 2e-3, 0, 0])
    np.testing.assert_allclose(held.force, [10, 0, 2000, 0, 0], rtol=1e-9)


def test_a_kind_without_ratings():
    with pytest.raises(InputError, match="no dynamic rating is known by the geometry of a Rail. Give dynamic_rating"):
        basic_dynamic_rating(Rail())
    with pytest.raises(InputError, match="no static rating is known for a Rail"):
        bearings.basic_static_rating(Rail())


def test_a_kind_without_a_life():
    with pytest.raises(InputError, match="no reference life is known for a Rail"):
        solve(Rail(), force=[10, 0, 0, 0, 0]).reference_life  # noqa: B018


def test_no_equilibrium_found():
    """A force that jumps from -50 to 50 N never is 10 N: an energy with a kink, as no bearing has."""
    with pytest.raises(SolverError, match=r"no equilibrium with the force \[10, 0, 0, 0, 0\] after .* Give a closer start=") as caught:
        solve(Rail(ripple=50.0), force=[10, 0, 0, 0, 0])
    assert caught.value.partial["displacement"].shape == (5,)


# -- every public function with every bearing ----------------------------------------------------------------------------------

BEARINGS = {
    "ball": BEARING,
    "angular": BallBearing(balls=13, ball_diameter="3.5 mm", pitch_diameter="26 mm", contact_angle="25 deg"),
    "rollers": bearings.RollerBearing(rollers=16, roller_diameter="3.5 mm", roller_length="3.2 mm", pitch_diameter="26 mm"),
    "tapered": bearings.RollerBearing(
        rollers=17, roller_diameter="3.5 mm", roller_length="4 mm", pitch_diameter="26 mm", contact_angle="14 deg", dynamic_rating="10 kN"
    ),
}
NONE = {"text": "61804", "nothing": None, "law": law_of(BEARING)}
CALLS = {
    "basic_dynamic_rating": basic_dynamic_rating,
    "basic_static_rating": bearings.basic_static_rating,
    "basic_life": lambda b: basic_life(b, 1000.0),
    "contact_of": bearings.contact_of,
    "law_of": law_of,
    "solve": lambda b: solve(b, force=[100, 0, 0, 0, 0], held=("z",)),
    "life_of": lambda b: bearings.life_of(b, solve(b, displacement=[1e-5, 0, 0, 0, 0])),
    "roller_static_rating": bearings.roller_static_rating,
    "roller_reference_life": lambda b: bearings.roller_reference_life(b, np.ones((b.rollers if hasattr(b, "rollers") else 3, 41))),
    "measures": lambda b: bearings.measures(law_of(b)),
    "respond": lambda b: bearings.evaluate_response(law_of(b), np.zeros(5)),
    "equilibria": lambda b: bearings.equilibria(law_of(b), np.array([[100.0, 0, 0, 0, 0]]), np.array([False, False, True, False, False])),
}
REFUSED = {
    ("roller_static_rating", "ball"),
    ("roller_static_rating", "angular"),
    ("roller_reference_life", "ball"),
    ("roller_reference_life", "angular"),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("kind", [*BEARINGS, *NONE])
def test_every_call_answers_or_refuses_with_our_words(call, kind):
    if kind in BEARINGS and (call, kind) not in REFUSED:
        CALLS[call](BEARINGS[kind])
        return
    words = "is no bearing" if kind in NONE else "is stated for a RollerBearing, and this is a BallBearing"
    with pytest.raises(InputError, match=words):
        CALLS[call]((BEARINGS | NONE)[kind])


@pytest.mark.parametrize("kind", BEARINGS)
def test_the_static_rating_is_the_load_at_the_permissible_pressure(kind):
    """5 F/(Z cos a) on one element: at C0 of the geometry it has 4200 MPa as a ball and 4000 MPa as a roller."""
    bearing = BEARINGS[kind]
    pressure, power = bearings.PERMISSIBLE[bearings.contact_of(bearing)]
    rating = bearings.basic_static_rating(bearing)
    plain = bearing.replace(profile="none") if kind in ("rollers", "tapered") else bearing
    state = solve(plain, displacement=[2e-6, 0, 0, 0, 0])
    load = state.element_loads.max()
    share = 5 / (len(state.element_loads) * np.cos(bearing.contact_angle))
    at_rating = state.pressures.max() * (rating * share / load) ** (1 / power)
    assert at_rating == pytest.approx(pressure, rel=5e-3)
