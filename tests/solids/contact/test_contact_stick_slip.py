"""Friction between elastic bodies: Cattaneo's and Mindlin's partial slip, there and back, its energy, and the solver by two routes."""

from functools import cache

import numpy as np
import pytest

from drivewright.contact import hertz
from drivewright.errors import InputError
from drivewright.solids.contact import ContactModel, Functional, Link, Pair, friction
from drivewright.solids.contact.complementarity import unbalanced
from drivewright.solids.contact.friction import Grips, solve_friction
from drivewright.solids.elastic import FreeBody, Plane
from tests.support.pressed_bodies import NU, SHEET, E, bowl, quarter_ball

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]

MODULUS = hertz.effective_modulus(E, NU, E, NU)
DISC, FORCE, MU = 1.2e-3, 33.3333, 0.3  # m, N on a sheet of 1 mm
LINE = hertz.line_contact(FORCE, SHEET, DISC / 2, MODULUS)


@cache
def two_bowls(share=0.05, coefficient=MU, stiffer=1.0):
    """Two half discs between flat faces that move but do not turn."""
    import ngsolve as ng

    size = 1e3 * float(LINE.half_width) * share
    upper = FreeBody(bowl(1.2, 1, size, 0.02), E, NU, Plane(SHEET))
    lower = FreeBody(bowl(1.2, -1, 1.3 * size, 0.02), stiffer * E, NU, Plane(SHEET))
    bodies = {"upper": upper, "lower": lower}
    turns = {name: Functional(name, body.weighted("flat", ng.CF((0, ng.x)))) for name, body in bodies.items()}
    held = [Functional("lower", lower.mean("flat", way)) for way in ((1, 0), (0, 1))]
    loads = {name: Functional("upper", upper.mean("flat", way)) for name, way in (("push", (0, -1)), ("shear", (1, 0)))}
    pair = Pair(("upper", "contact"), ("lower", "contact"), 1e-6, friction=coefficient)
    return ContactModel(bodies, [pair], [Link((each,)) for each in (*turns.values(), *held)], loads)


def along_x(state):
    """(x / b, traction on the lower body along x over mu p0, area) at the hats."""
    (pairing,) = state.model.pairings
    traction = state.traction[0][:, 0] * pairing.tangents[:, 0, 0]
    return 1e-3 * pairing.places[:, 0] / LINE.half_width, traction / (MU * LINE.pressure), pairing.area


def ellipse(x, end=1.0):
    return np.sqrt(np.maximum(end**2 - x**2, 0.0))


def partial_slip(x, share):
    """Cattaneo's traction over mu p0 under a share of the greatest shear force: an ellipse less that of the sticking part."""
    return ellipse(x) - ellipse(x, np.sqrt(1 - share))


def off(found, expected, area):
    """Difference in the mean square."""
    return np.sqrt((found - expected) ** 2 @ area / area.sum())


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_cylinders_slip_at_their_edges_as_cattaneo_says(share):
    model = two_bowls()
    pressed = model.solve({"push": FORCE})
    assert np.abs(along_x(pressed)[1]).max() < 0.02  # like bodies do not rub when pressed
    state = model.solve({"push": FORCE, "shear": share * MU * FORCE}, pressed)
    x, traction, area = along_x(state)
    assert off(traction, partial_slip(x, share), area) < 0.03
    sticks = (state.pressure[0] > 0) & (state.slip[0][:, 0] == 0)
    assert np.ptp(x[sticks]) / 2 == pytest.approx(np.sqrt(1 - share), abs=0.06)  # elements of 0.05
    assert state.force(0) == pytest.approx([-share * MU * FORCE, FORCE], rel=1e-9)


def test_the_shear_force_taken_back_leaves_tractions_of_both_senses():
    model, share, left = two_bowls(), 0.6, 0.1
    loaded = model.solve({"push": FORCE, "shear": share * MU * FORCE}, model.solve({"push": FORCE}))
    back = model.solve({"push": FORCE, "shear": left * MU * FORCE}, loaded)
    x, traction, area = along_x(back)
    expected = partial_slip(x, share) - 2 * partial_slip(x, (share - left) / 2)  # Mindlin and Deresiewicz
    assert expected.min() < -0.3 and expected.max() > 0.1
    assert off(traction, expected, area) < 0.05


def test_a_mirrored_load_has_the_mirrored_answer():
    model = two_bowls(stiffer=3.0)
    states = [model.solve({"push": FORCE, "shear": way * 4.0}, model.solve({"push": FORCE})) for way in (1.0, -1.0)]
    (x, one, area), (_, other, _) = (along_x(state) for state in states)
    order = np.argsort(x)
    assert np.interp(x, -x[order][::-1], -other[order][::-1]) == pytest.approx(one, abs=0.06)
    assert states[0].dissipated == pytest.approx(states[1].dissipated, rel=0.01)


def test_more_shear_than_friction_bears_is_refused():
    model = two_bowls()
    pressed = model.solve({"push": FORCE})
    assert model.solve({"push": FORCE, "shear": 0.999 * MU * FORCE}, pressed).force(0)[0] == pytest.approx(-0.999 * MU * FORCE)
    with pytest.raises(InputError, match="pressure and friction do not keep 'upper' from moving along x, where the loads drive it"):
        model.solve({"push": FORCE, "shear": 1.1 * MU * FORCE}, pressed)


def test_without_friction_nothing_is_lost_and_pressure_is_as_before():
    smooth, rough = two_bowls(coefficient=0.0), two_bowls()
    one, other = smooth.solve({"push": FORCE}), rough.solve({"push": FORCE})
    assert one.traction[0].size == 0 and one.dissipated == 0
    assert other.pressure[0] == pytest.approx(one.pressure[0], abs=1e-3 * LINE.pressure)


def test_links_hold_either_way_and_pressures_one_way():
    model = two_bowls()
    held = np.random.default_rng(1).normal(size=(6, len(model.one_sided)))
    link, pressure = held[:, -1], held[:, 0]
    rays = model._rays(held)
    assert [any(np.allclose(way * link, ray) for ray in rays.T) for way in (1, -1)] == [True, True]
    edge = held[:, 0] + MU * held[:, len(model.pairings[0].gap)]
    assert [any(np.allclose(way * edge, ray) for ray in rays.T) for way in (1, -1)] == [True, False]
    assert not any(np.allclose(pressure, ray) for ray in rays.T)


def test_a_cycle_of_shear_loses_what_its_loop_encloses():
    """The work of the load round a closed loop is what friction takes: displacements by one route, slips by the other."""
    model, top = two_bowls(0.1), 0.7 * MU * FORCE
    state, states = model.solve({"push": FORCE}), []
    turn = np.concatenate([np.linspace(0, 1, 9), np.linspace(1, -1, 33)[1:], np.linspace(-1, 1, 33)[1:]])
    for share in turn:
        state = model.solve({"push": FORCE, "shear": share * top}, state)
        states.append(state)
    loop = states[8:]
    force, moved = (np.array([part(s) for s in loop]) for part in (lambda s: s.forces["shear"], lambda s: s.travel("shear")))
    lost = sum(s.dissipated for s in loop[1:])
    assert all(s.dissipated >= 0 for s in loop)
    assert moved[0] == pytest.approx(moved[-1], rel=1e-6)
    assert lost == pytest.approx(np.trapezoid(force, moved), rel=0.1)  # steps of 1/32 and implicit: off by a part of a step


@pytest.mark.slow
def test_balls_slip_as_mindlin_says():
    """c = a (1 - Q/mu P)^(1/3), the traction an ellipse less that of the sticking part, along the force."""
    radius, force, share = 10e-3, 500.0, 0.5
    half_width = (3 * force * radius / 2 / (4 * MODULUS)) ** (1 / 3)
    pressure = 1.5 * force / (np.pi * half_width**2)
    size, patch = 1e3 * half_width / 6, 1.2e3 * half_width
    upper = FreeBody(quarter_ball(10.0, 1, size, patch, whole=True), E, NU, dirichlety="symy")
    lower = FreeBody(quarter_ball(10.0, -1, size, patch, whole=True), E, NU, dirichlety="symy", dirichletz="flat", dirichletx="flat")
    import ngsolve as ng

    pair = Pair(("upper", "contact"), ("lower", "contact"), 2e-5, friction=MU)
    loads = {name: Functional("upper", upper.mean("flat", way)) for name, way in (("push", (0, 0, -1)), ("shear", (1, 0, 0)))}
    turn = Link((Functional("upper", upper.weighted("flat", ng.CF((0, 0, ng.x)))),))
    model = ContactModel({"upper": upper, "lower": lower}, [pair], [turn], loads)
    pressed = model.solve({"push": force / 2})
    state = model.solve({"push": force / 2, "shear": share * MU * force / 2}, pressed)
    pairing = model.pairings[0]
    traction = np.einsum("hk,hkd->hd", state.traction[0], pairing.tangents)
    r = 1e-3 * np.hypot(*pairing.places[:, :2].T) / half_width
    stuck = (1 - share) ** (1 / 3)
    expected = ellipse(r) - ellipse(r, stuck)
    found = traction[:, 0] / (MU * pressure)
    assert off(found, expected, pairing.area) < 0.09
    assert np.abs(traction[:, 1]).max() < 0.15 * np.abs(traction[:, 0]).max()  # 0 but for Poisson's ratio
    sticks = (state.pressure[0] > 0) & np.all(state.slip[0] == 0, axis=1)
    assert r[sticks].max() == pytest.approx(stuck, abs=1 / 6)
    assert state.force(0) == pytest.approx([-share * MU * force / 2, state.force(0)[1], force / 2], rel=1e-6)


# -- the solver alone ----------------------------------------------------------------------------------------------------------


def problem(seed, ways, coefficient, places=12):
    """A programme of places with friction, a two-sided unknown and a rigid motion that only they hold."""
    rng = np.random.default_rng(seed)
    count = places * (1 + ways) + 1
    root = rng.normal(size=(count, count)) + 4 * np.eye(count)
    right = rng.normal(size=count)
    held = np.zeros((1, count))
    held[0, :places] = -rng.uniform(0.5, 1.5, places)
    grips = Grips(np.arange(places), places + np.arange(places * ways).reshape(places, ways), np.full(places, coefficient))
    one_sided = np.arange(count) < places
    return root @ root.T / count, right, held, np.array([float(places)]), one_sided, grips


@pytest.mark.parametrize("ways", [1, 2])
@pytest.mark.parametrize("coefficient", [0.05, 0.3, 0.8])
@pytest.mark.parametrize("seed", range(6))
def test_pressures_tractions_and_slips_obey_coulomb(ways, coefficient, seed):
    matrix, right, held, load, one_sided, grips = given = problem(seed, ways, coefficient)
    found = solve_friction(*given)
    gap = matrix @ found.x + right + held.T @ found.motions
    p, g, q, s = found.x[grips.normal], gap[grips.normal], found.x[grips.along], gap[grips.along]
    close = 1e-7
    assert held @ found.x == pytest.approx(-load, rel=1e-7)
    assert np.all(p >= -close) and np.all(g >= -close) and np.abs(p * g).max() < close
    pull, slip = np.linalg.norm(q, axis=1), np.linalg.norm(s, axis=1)
    assert np.all(pull <= coefficient * p + close)
    pressed = p > close
    assert slip[pressed] * pull[pressed] == pytest.approx(-np.einsum("hk,hk->h", q, s)[pressed], abs=close)
    moving = pressed & (slip > close)
    assert moving.any() and pull[moving] == pytest.approx(coefficient * p[moving], abs=close)
    assert gap[~one_sided][-1] == pytest.approx(0.0, abs=close)
    assert found.gap[grips.along][pressed] == pytest.approx(s[pressed], abs=close)


@pytest.mark.parametrize("ways", [1, 2])
@pytest.mark.parametrize("seed", range(6))
def test_the_same_load_once_more_changes_nothing(ways, seed):
    """Tractions at their bound whose places slip no further, which rounding could take for sticking or slipping."""
    matrix, right, *rest = problem(seed, ways, 0.3, places=60)
    first = solve_friction(matrix, right, *rest)
    along = rest[-1].along.ravel()
    held = rest[0]
    slipped = right.copy()
    slipped[along] -= (matrix @ first.x + right + held.T @ first.motions)[along]
    again = solve_friction(matrix, slipped, *rest, first)
    assert again.x == pytest.approx(first.x, abs=1e-9 * np.abs(first.x).max())
    assert np.abs(again.gap[along]).max() < 1e-9


@pytest.mark.parametrize(("ways", "over"), [(1, 1.001), (2, 1.083)])
def test_a_balance_wants_the_cone_and_its_pyramid_stands_close_about_it(ways, over):
    """One place that presses with 1: a pull across it of less than mu is balanced in any direction, one beyond the pyramid is not."""
    grips, held = Grips(np.array([0]), np.array([[1, 2][:ways]]), np.array([0.4])), np.eye(1 + ways)
    for turn in np.linspace(0, 2 * np.pi, 17)[: 16 if ways == 2 else None : 1 if ways == 2 else 8]:
        across = 0.4 * np.array([np.cos(turn), np.sin(turn)][:ways])
        rays, load = grips.rays(held), -np.append(1.0, over * across)
        assert not unbalanced(rays, -np.append(1.0, across)).any()
        motion = unbalanced(rays, load)
        assert load @ motion == pytest.approx(motion @ motion)
        assert motion @ motion > 0
        assert np.all(rays.T @ motion >= -1e-12)


@pytest.mark.parametrize("ways", [1, 2])
def test_alternating_directions_find_what_newton_finds(ways, monkeypatch):
    given = problem(3, ways, 0.3)
    expected = solve_friction(*given)
    newton = friction._Problem.newton
    calls = []

    def second_time(self, x, motions, everything):
        calls.append(x)
        return newton(self, x, motions, everything) if len(calls) > 1 else None

    monkeypatch.setattr(friction._Problem, "newton", second_time)
    found = solve_friction(*given)
    assert len(calls) == 2
    grips = given[-1]
    pressure, traction = calls[1][grips.normal], np.linalg.norm(calls[1][grips.along], axis=1)
    assert pressure.min() >= 0 and np.all(traction <= 0.3 * pressure * (1 + 1e-9))  # within friction before Newton makes it exact
    assert found.x == pytest.approx(expected.x, abs=1e-8)
