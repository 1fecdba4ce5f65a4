"""Closed forms of the oil film against quadrature of the pressure and against Reynolds' equation on a grid."""

import numpy as np
import pytest

from drivewright._jit import plain
from drivewright.contact import film, reynolds
from drivewright.errors import InputError
from drivewright.numerics.quadrature import integrate_pieces

pytestmark = pytest.mark.analytical

FILMS = [film.long_bearing, film.short_bearing]
OIL = (0.08, 0.019, 0.011, 0.4e-3)  # viscosity, length, radius, clearance
P_LONG = 0.08 * 0.019 * 0.011**3 / 0.4e-3**2
P_SHORT = 0.08 * 0.019**3 * 0.011 / 0.4e-3**2
STATES = [((1.1e-4, 0.7e-4), (0.02, -0.031), 40.0), ((-0.2e-4, 3.1e-4), (0.004, 0.05), -90.0), ((2e-4, -2.4e-4), (-0.03, 0.03), 12.0)]


def pressure_force(pressure, zeros):
    """-(integral of the positive pressure) (cos x, sin x) over a turn; the pressure changes sign at most at `zeros`."""
    breaks = np.unique(np.concatenate([np.linspace(-np.pi, np.pi, 801), zeros]))
    part = lambda x: np.maximum(pressure(x), 0)  # noqa: E731
    return -integrate_pieces(lambda x: part(x) * np.array([np.cos(x), np.sin(x)]), breaks, 8)


def endless(eps, wedge, squeeze):
    """Force over P of a bearing of endless length: the 1-D pressure whose integral with H^3 is 0, as its open ends demand."""

    def pressure(x):
        H = 1 - eps * np.cos(x)
        return -wedge * np.sin(x) * (1 + H) / ((2 + eps**2) * H**2) + squeeze / (2 * eps) * (1 / H**2 - 2 / (2 + 3 * eps**2))

    return 12 * pressure_force(pressure, [0.0])


def polar(law, eps, wedge, squeeze, spin=0.0):
    """(radial, tangential) force of a closed form in units where P = c = 1, from eccentricity along x."""
    return np.array(law(eps, 0.0, squeeze, 0.5 * spin * eps - wedge, spin, 1.0, 1.0, 1.0, 1.0))


# ----------------------------------------------------------------------------------------------------- shared by both


@pytest.mark.parametrize("law", FILMS)
@pytest.mark.parametrize("e, v, spin", STATES)
def test_force_turns_with_the_motion_and_mirrors(law, e, v, spin):
    force = complex(*law(*e, *v, spin, *OIL))
    assert abs(force) > 1
    turn = np.exp(0.83j)
    e, v = complex(*e), complex(*v)
    turned = complex(*law((e * turn).real, (e * turn).imag, (v * turn).real, (v * turn).imag, spin, *OIL))
    assert turned == pytest.approx(force * turn, rel=1e-12)
    assert complex(*law(e.real, -e.imag, v.real, -v.imag, -spin, *OIL)) == pytest.approx(force.conjugate(), rel=1e-12)


@pytest.mark.parametrize("law", FILMS)
@pytest.mark.parametrize("e, v, spin", STATES)
def test_turning_everything_together_drags_nothing(law, e, v, spin):
    # Journal, bearing and line of centres turn by W more: the spin, a sum of two speeds, by 2 W.  So half-speed whirl has no wedge.
    W = 17.0
    whirled = law(*e, v[0] - W * e[1], v[1] + W * e[0], spin + 2 * W, *OIL)
    assert whirled == pytest.approx(law(*e, *v, spin, *OIL), rel=1e-11)
    n = np.array(e) / np.hypot(*e)
    wedge_free = law(*e, -0.5 * spin * e[1] + 0.3 * n[0], 0.5 * spin * e[0] + 0.3 * n[1], spin, *OIL)
    assert n[0] * wedge_free[1] - n[1] * wedge_free[0] == pytest.approx(0, abs=1e-10 * np.hypot(*wedge_free)) and np.dot(n, wedge_free) < -1


@pytest.mark.parametrize("law", FILMS)
def test_the_force_is_proportional_to_the_speeds_and_takes_energy(law):
    rng = np.random.default_rng(3)
    for _ in range(200):
        eps, angle = rng.uniform(0, 0.98), rng.uniform(-np.pi, np.pi)
        e, v = 0.4e-3 * eps * np.array([np.cos(angle), np.sin(angle)]), rng.normal(size=2)
        force = np.array(law(*e, *v, 30.0, *OIL))
        assert np.array(law(*e, *(7 * v), 210.0, *OIL)) == pytest.approx(7 * force, rel=1e-9)
        assert np.dot(law(*e, *v, 0.0, *OIL), v) < 0


@pytest.mark.parametrize("law", FILMS)
def test_units_of_length_and_mass(law):
    (e, v, spin), (viscosity, length, radius, clearance) = STATES[0], OIL
    scaled = law(*(1e3 * np.array(e)), *(1e3 * np.array(v)), spin, viscosity * 1e-3, length * 1e3, radius * 1e3, clearance * 1e3)
    assert np.array(scaled) == pytest.approx(1e3 * np.array(law(*e, *v, spin, *OIL)), rel=1e-12)  # kg mm/s^2


@pytest.mark.parametrize("law", FILMS)
def test_the_force_is_continuous_through_zero_squeeze_and_zero_eccentricity(law):
    away, still, back = (polar(law, 0.6, 0.7, b) for b in (1e-9, 0.0, -1e-9))
    np.testing.assert_allclose([away, back], [still, still], rtol=1e-7)
    middle = np.array(law(0.0, 0.0, 0.3, -0.4, 50.0, *OIL))
    for angle in np.linspace(0, 6, 7):
        near = law(1e-12 * np.cos(angle), 1e-12 * np.sin(angle), 0.3, -0.4, 50.0, *OIL)
        assert np.array(near) == pytest.approx(middle, rel=1e-6)
    scale = 6 * np.pi * P_LONG if law is film.long_bearing else 0.5 * np.pi * P_SHORT
    assert middle == pytest.approx(-scale / OIL[3] * np.array([0.3, -0.4]), rel=1e-12)


@pytest.mark.parametrize("law", FILMS)
def test_finite_up_to_the_wall_and_zero_at_rest(law):
    for wedge, squeeze in ((1.0, 0.0), (-0.4, 0.7), (0.2, -1.0), (0.0, 1.0), (0.0, -1.0)):
        assert np.all(np.isfinite(polar(law, 0.9999, wedge, squeeze))) and polar(law, 0.9999, wedge, squeeze)[0] < 0 or squeeze < 0
    assert law(1e-4, 2e-4, 0.0, 0.0, 0.0, *OIL) == pytest.approx((0, 0), abs=0) and law(0.0, 0.0, 0.0, 0.0, 9.0, *OIL) == (0.0, 0.0)


@pytest.mark.parametrize("law", FILMS)
@pytest.mark.parametrize("e, v, spin", STATES)
def test_compiled_equals_plain(law, e, v, spin):
    assert plain(law)(*e, *v, spin, *OIL) == pytest.approx(law(*e, *v, spin, *OIL), rel=1e-12)


# ----------------------------------------------------------------------------------------------------------- long bearing


@pytest.mark.parametrize("eps", [0.05, 0.4, 0.85])
def test_long_bearing_at_a_fixed_place_is_sommerfelds_half(eps):
    spin = 2.0
    radial, tangential = polar(film.long_bearing, eps, eps * spin / 2, 0.0, spin)
    assert radial == pytest.approx(-12 * eps**2 * spin / ((2 + eps**2) * (1 - eps**2)), rel=1e-12)
    assert tangential == pytest.approx(6 * np.pi * eps * spin / ((2 + eps**2) * np.sqrt(1 - eps**2)), rel=1e-12)
    assert (radial, tangential) == pytest.approx(endless(eps, eps * spin / 2, 0.0), rel=1e-9)


@pytest.mark.parametrize("eps, squeeze", [(0.5, 0.8), (0.5, -0.8), (0.83, 0.3), (0.83, -0.3), (0.2, 2.0)])
def test_long_bearing_as_the_book_prints_it(eps, squeeze):
    w, whirl = 3.0, 0.4
    k = np.sqrt((1 - eps**2) * (((w - 2 * whirl) / (2 * squeeze)) ** 2 + 1 / eps**2))
    share, side = ((k + 3) / (k + 1.5), 1) if squeeze > 0 else (k / (k + 1.5), -1)
    # Where squeeze < 0 the size of the rate is meant, or the force would jump at 0 and drive the journal on.
    radial = -6 * abs(squeeze) / ((2 + eps**2) * (1 - eps**2) ** 1.5) * (4 * k * eps**2 + side * (2 + eps**2) * np.pi) * share
    tangential = 6 * np.pi * eps * (w - 2 * whirl) / ((2 + eps**2) * np.sqrt(1 - eps**2)) * share
    assert film.long_bearing(eps, 0.0, squeeze, whirl * eps, w, 1.0, 1.0, 1.0, 1.0) == pytest.approx((radial, tangential), rel=1e-12)


def test_how_far_the_book_is_from_the_endless_bearing():
    def off(eps, direction):
        wedge, squeeze = np.sin(direction), np.cos(direction)
        exact = endless(eps, wedge, squeeze)
        return np.linalg.norm(polar(film.long_bearing, eps, wedge, squeeze) - exact) / np.linalg.norm(exact)

    approach = [off(eps, d) for eps in (0.05, 0.3, 0.6, 0.8, 0.99) for d in (0.0, 0.4, 0.8, 1.2, np.pi / 2)]
    assert 0.11 < max(approach) < 0.13
    assert [off(eps, np.pi) for eps in (0.1, 0.5, 0.8)] == pytest.approx([0.0435, 1.387, 10.30], rel=2e-3)


# ---------------------------------------------------------------------------------------------------------- short bearing


@pytest.mark.parametrize("eps", [0.0, 0.1, 0.6, 0.93])
@pytest.mark.parametrize(
    "wedge, squeeze", [(1.0, 0.0), (-0.7, 0.0), (0.6, 0.5), (-0.6, 0.5), (0.6, -0.5), (-0.2, -0.9), (0.0, 1.0), (0.0, -1.0)]
)
def test_short_bearing_is_the_integral_of_its_pressure(eps, wedge, squeeze):
    pressure = lambda x: (squeeze * np.cos(x) - wedge * np.sin(x)) / (1 - eps * np.cos(x)) ** 3  # noqa: E731
    zeros = np.mod(np.arctan2(-wedge, squeeze) + np.array([-0.5, 0.5]) * np.pi + np.pi, 2 * np.pi) - np.pi
    assert polar(film.short_bearing, eps, wedge, squeeze) == pytest.approx(pressure_force(pressure, zeros), rel=1e-9, abs=1e-12)


def test_short_bearing_at_a_fixed_place_is_ocvirks():
    eps, spin = 0.62, 3.0
    radial, tangential = polar(film.short_bearing, eps, eps * spin / 2, 0.0, spin)
    assert radial == pytest.approx(-spin * eps**2 / (1 - eps**2) ** 2, rel=1e-12)
    assert tangential == pytest.approx(spin * np.pi * eps / (4 * (1 - eps**2) ** 1.5), rel=1e-12)


def test_scales_of_the_two_films():
    eps, wedge, squeeze, clearance = 0.55, 30.0, 20.0, OIL[3]
    args = (eps * clearance, 0.0, squeeze * clearance, -wedge * clearance, 0.0, *OIL)
    assert np.array(film.long_bearing(*args)) == pytest.approx(P_LONG * polar(film.long_bearing, eps, wedge, squeeze), rel=1e-12)
    assert np.array(film.short_bearing(*args)) == pytest.approx(P_SHORT * polar(film.short_bearing, eps, wedge, squeeze), rel=1e-12)


# ------------------------------------------------------------------------------------------------------- Reynolds' equation


def order(force):
    """Observed order from three or more halvings of the grid, in the size of the force's change."""
    change = np.linalg.norm(np.diff(force, axis=0), axis=1)
    return np.log2(change[:-1] / change[1:])


@pytest.mark.parametrize("eps, direction", [(0.5, np.pi / 2), (0.6, 0.8), (0.7, 2.2)])
def test_the_grid_converges_in_second_order(eps, direction):
    maps = [reynolds.film_map(0.6, [eps], [direction], (24 * k, 6 * k + 1)) for k in (1, 2, 4, 8)]
    assert order([(m.radial[0, 0], m.tangential[0, 0]) for m in maps])[-1] == pytest.approx(2, abs=0.1)


def test_a_short_bearing_tends_to_ocvirk():
    eps, directions = [0.2, 0.6], [0.0, 0.7, np.pi / 2, 2.3, np.pi]
    off = [
        reynolds.film_deviation(
            reynolds.closed_form_map(film.short_bearing, slenderness, eps, directions),
            reynolds.film_map(slenderness, eps, directions, (240, 17)),
        )
        for slenderness in (0.06, 0.03)
    ]
    assert np.max(off[1]) < 0.004 and np.max(off[0]) < 0.01


@pytest.mark.parametrize("direction", [0.0, 0.7, np.pi / 2, 2.3, np.pi])
def test_a_long_bearing_tends_to_the_endless_one(direction):
    # The open ends cost a part proportional to D/L: it halves from one length to the next, and the rest is the endless bearing.
    eps, exact = 0.5, endless(0.5, np.sin(direction), np.cos(direction))
    solved = [reynolds.film_map(length, [eps], [direction], (90, 24 * length + 1)) for length in (3, 6)]
    short, long = (np.array([m.radial[0, 0], m.tangential[0, 0]]) for m in solved)
    assert np.linalg.norm(short - exact) == pytest.approx(2 * np.linalg.norm(long - exact), rel=0.03)
    assert 2 * long - short == pytest.approx(exact, abs=2e-3 * np.linalg.norm(exact))


def test_the_long_closed_form_is_the_limit_of_the_grid_in_pure_wedge():
    solved = [reynolds.film_map(length, [0.7], [np.pi / 2], (96, 24 * length + 1)) for length in (3, 6)]
    limit = [2 * getattr(solved[1], part)[0, 0] - getattr(solved[0], part)[0, 0] for part in ("radial", "tangential")]
    closed = reynolds.closed_form_map(film.long_bearing, 6, [0.7], [np.pi / 2])
    assert limit == pytest.approx([closed.radial[0, 0], closed.tangential[0, 0]], rel=3e-3)


def test_how_far_the_closed_forms_are_off_at_length_equal_to_half_the_diameter():
    eps, directions = [0.3, 0.6], [0.0, np.pi / 2]
    solved = reynolds.film_map(0.5, eps, directions)
    short = reynolds.film_deviation(reynolds.closed_form_map(film.short_bearing, 0.5, eps, directions), solved)
    long = reynolds.film_deviation(reynolds.closed_form_map(film.long_bearing, 0.5, eps, directions), solved)
    assert np.all((short > 0.1) & (short < 0.5)) and np.all(long > 3)


@pytest.mark.parametrize("e, v, spin", STATES)
def test_solve_film_agrees_with_the_map_and_its_own_pressure(e, v, spin):
    solved = reynolds.solve_film(e, v, spin, *OIL)
    closed = np.array(film.short_bearing(*e, *v, spin, *OIL))
    n, c = np.array(e) / np.hypot(*e), OIL[3]
    wedge, squeeze = 0.5 * spin * np.hypot(*e) / c - (n[0] * v[1] - n[1] * v[0]) / c, n @ v / c
    table = reynolds.film_map(OIL[1] / OIL[2] / 2, [np.hypot(*e) / c], [np.arctan2(wedge, squeeze)])
    size = P_LONG * np.hypot(wedge, squeeze) * np.array([table.radial[0, 0], table.tangential[0, 0]])
    assert solved.force == pytest.approx(size[0] * n + size[1] * np.array([-n[1], n[0]]), rel=1e-9)
    assert 0.1 < np.linalg.norm(solved.force) / np.linalg.norm(closed) < 1
    along = np.sum(solved.pressure[:, 1:] + solved.pressure[:, :-1], axis=1) * solved.axial[1]  # from end to end
    from_pressure = -OIL[2] * 2 * np.pi / 180 * np.array([along @ np.cos(solved.angle), along @ np.sin(solved.angle)])
    assert from_pressure == pytest.approx(solved.force, rel=2e-3)
    assert np.all(solved.pressure >= 0) and np.all(solved.pressure[:, -1] == 0)


def test_reynolds_condition_ends_the_film_smoothly():
    e, v, spin = STATES[0]
    gumbel, smooth = (reynolds.solve_film(e, v, spin, *OIL, cavitation=name, shape=(240, 13)) for name in ("gumbel", "reynolds"))
    assert np.all(smooth.pressure >= 0) and np.all(smooth.pressure >= gumbel.pressure - 1e-9 * gumbel.pressure.max())

    def edge(film):
        """Greatest kink of the pressure where it is 0."""
        p = film.pressure[:, 0]
        return np.max(np.abs(np.diff(p, 2)[p[1:-1] == 0])) / p.max()

    assert edge(smooth) < 0.3 * edge(gumbel)
    assert np.linalg.norm(gumbel.force) < np.linalg.norm(smooth.force) < 1.2 * np.linalg.norm(gumbel.force)


def test_reynolds_condition_is_met_at_every_node():
    eps, wedge, squeeze, (n, m) = 0.6, 0.8, -0.3, (96, 9)
    film = reynolds.solve_film((eps, 0.0), (squeeze, -wedge), 0.0, 1 / 12, 1.4, 1.0, 1.0, "reynolds", (n, m))
    P, dx, du = film.pressure, 2 * np.pi / n, 1 / (m - 1)
    flow = (1 - eps * np.cos(film.angle + dx / 2))[:, None] ** 3 * (np.roll(P, -1, axis=0) - P) / dx
    around = (flow - np.roll(flow, 1, axis=0))[:, 1:-1] / dx
    along = (1 - eps * np.cos(film.angle))[:, None] ** 3 * np.diff(P, 2, axis=1) / (0.7 * du) ** 2
    left = around + along - (wedge * np.sin(film.angle) - squeeze * np.cos(film.angle))[:, None]
    full = P[:, 1:-1] > 0
    assert 0.2 < full.mean() < 0.8 and np.max(np.abs(left[full])) < 1e-10 and np.max(left[~full]) < 0


def test_reynolds_condition_changes_nothing_in_a_short_bearing():
    e, v, spin = STATES[0]
    forces = [
        reynolds.solve_film(e, v, spin, 0.08, 0.0004, *OIL[2:], cavitation=name, shape=(120, 7)).force for name in ("gumbel", "reynolds")
    ]
    assert forces[0] == pytest.approx(forces[1], rel=1e-3)


@pytest.mark.parametrize(
    "change, message",
    [
        ({"eccentricity": (5e-4, 0.0)}, r"the eccentricity must lie in \[0, 1\) of the clearance and L/D be above 0, got 1.25"),
        ({"cavitation": "jfo"}, "cavitation is 'gumbel' or 'reynolds', got 'jfo'"),
        ({"shape": (6, 3)}, "a grid of 6 x 3 nodes is too coarse"),
    ],
)
def test_refusals(change, message):
    given = {
        "eccentricity": (1e-4, 0.0),
        "velocity": (0.0, 0.1),
        "spin": 1.0,
        "viscosity": 0.1,
        "length": 0.02,
        "radius": 0.01,
        "clearance": 4e-4,
    }
    with pytest.raises(InputError, match=message):
        reynolds.solve_film(**(given | change))
