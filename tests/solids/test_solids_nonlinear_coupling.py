"""Substructures on springs with laws: closed forms, energy, contacts that open and close, and what nothing holds."""

from typing import NamedTuple

import numpy as np
import pytest

from drivewright.errors import DoesNotAssemble, SolverError
from drivewright.solids.coupling import InterfaceSpring, solve_coupled
from drivewright.solids.nonlinear_coupling import NonlinearSpring, solve_nonlinear
from drivewright.solids.substructures import InterfaceLoad, radial_loads, rigid_substructure

pytestmark = pytest.mark.analytical

BAR = ("bar",)


class Power(NamedTuple):
    """F = k d^n of a contact that only presses."""

    k: float
    n: float

    def __call__(self, strain):
        d = np.maximum(strain, 0.0)
        force = self.k * d**self.n
        return float(np.sum(force * d)) / (self.n + 1), force, np.diag(np.where(strain > 0, self.n * self.k * d ** (self.n - 1), 0.0))


class Radial(NamedTuple):
    """F = k r^n along the displacement (x, y), r its length."""

    k: float
    n: float

    def __call__(self, strain):
        r = max(float(np.hypot(*strain)), 1e-300)
        e, force = strain / r, self.k * r**self.n
        return force * r / (self.n + 1), force * e, self.n * force / r * np.outer(e, e) + force / r * (np.eye(2) - np.outer(e, e))


def bar(flexibility):
    """A bar along x with ends 0 and 1 and the flexibility `flexibility` [m/N] between them."""
    places = [InterfaceLoad((n,), np.array([1.0, 0, 0]), np.zeros(3)) for n in (0, 1)]
    return rigid_substructure(places, (0,))._replace(flexibility=0.25 * flexibility * np.array([[1.0, -1.0], [-1.0, 1.0]]))


def contact(law, body=BAR, end=0, sign=1.0, gap=0.0, usual=1e8):
    return NonlinearSpring("contact", (((body, (end,), sign),),), law, usual, (gap,))


def test_two_springs_in_a_row_and_a_gap():
    """A bar of flexibility f between a spring behind a gap and a load P: u = P/k + gap + f P."""
    found = solve_coupled({BAR: bar(8e-9)}, [InterfaceSpring("ground", ((BAR, (0,), 1.0),), 1 / 3e8, 1e-5)], (BAR, (1,), 500.0))
    assert found.displacements[1] == pytest.approx(500 / 3e8 + 1e-5 + 500 * 8e-9, rel=1e-12)
    assert found.forces == pytest.approx([500.0])


@pytest.mark.parametrize("gap", [0.0, 3e-5])
@pytest.mark.parametrize("exponent", [1.0, 10 / 9, 1.5])
def test_a_contact_in_series_with_a_bar(exponent, gap):
    """u = gap + (P/k)^(1/n) + f P, and the energy n/(n + 1) ... of either: P^(1 + 1/n)/k^(1/n)/(n + 1) + f P^2/2."""
    k, f, p = 5e10, 2e-9, 4321.0
    found = solve_nonlinear({BAR: bar(f)}, [], [contact(Power(k, exponent), gap=gap)], (BAR, (1,), p))
    depth = (p / k) ** (1 / exponent)
    assert found.coupled.displacements[1] == pytest.approx(gap + depth + f * p, rel=1e-9)
    assert found.coupled.forces == pytest.approx([p], rel=1e-12)
    assert found.energy == pytest.approx(p * depth / (exponent + 1) + 0.5 * f * p**2, rel=1e-9)


def test_energy_grows_by_the_work_of_the_load():
    """dE = P du; two contacts, one of which closes on the way, and a linear spring."""
    laws = [contact(Power(3e9, 1.3)), contact(Power(8e8, 1.0), end=1, gap=2e-6, usual=0.0)]
    spring = [InterfaceSpring("side", ((BAR, (1,), 1.0),), 1 / 4e7)]
    loads = np.linspace(0, 900, 401)[1:]
    found = [solve_nonlinear({BAR: bar(3e-9)}, spring, laws, (BAR, (1,), load)) for load in loads]
    moved = np.array([0.0, *(each.coupled.displacements[1] for each in found)])
    pull = np.array([0.0, *loads])
    assert found[0].coupled.forces[2] == 0 < found[-1].coupled.forces[2]
    assert found[-1].energy == pytest.approx(np.sum(0.5 * (pull[1:] + pull[:-1]) * np.diff(moved)), rel=1e-4)


def test_a_contact_that_would_pull_is_open():
    """A bar between two stops carries on the side it is pushed to, and forces do not depend on where the search starts."""
    laws = [contact(Power(1e9, 1.2)), contact(Power(2e9, 1.2), end=1, sign=-1.0)]
    for load, closed in ((700.0, 0), (-700.0, 1)):
        forces = solve_nonlinear({BAR: bar(1e-9)}, [], laws, (BAR, (1,), load)).coupled.forces
        assert forces[closed] == pytest.approx(700.0, rel=1e-12) and forces[1 - closed] == 0
        started = [each._replace(usual=usual) for each, usual in zip(laws, (0.0, 3e6), strict=True)]
        assert solve_nonlinear({BAR: bar(1e-9)}, [], started, (BAR, (1,), load)).coupled.forces == pytest.approx(forces, abs=1e-6)


def test_a_rigid_contact_stops_at_its_gap():
    """Beyond the gap the stop takes what the spring does not: P - k gap; below it nothing."""
    spring = [InterfaceSpring("ground", ((BAR, (1,), 1.0),), 1 / 1e7)]
    for load, held in ((50.0, 0.0), (400.0, 400.0 - 1e7 * 1e-5)):
        found = solve_nonlinear({BAR: bar(0.0)}, spring, [contact(None, gap=1e-5)], (BAR, (1,), load))
        assert found.coupled.forces[1] == pytest.approx(held, abs=1e-6)
        assert found.coupled.displacements[0] == pytest.approx(min(load / 1e7, 1e-5), rel=1e-8)


@pytest.mark.parametrize("law", [Radial(4e10, 1.5), Radial(2e9, 10 / 9)])
def test_a_bearing_yields_along_its_load(law):
    """Its principal axes are those of the displacement, whatever the frame; a linear spring along x turns it."""
    point = rigid_substructure(list(radial_loads((), (0.0, 0.0, 0.0))), (0, 1))
    bearing = NonlinearSpring("bearing", (((("p",), (0,), 1.0),), ((("p",), (1,), 1.0),)), law, 1e8, (0.0, 0.0))
    push = InterfaceSpring("push", ((("p",), (0,), 0.6), (("p",), (1,), 0.8)), 1 / 3e8)
    found = solve_nonlinear({("p",): point}, [push], [bearing], (("p",), (0,), 2000.0)).coupled
    x, y = found.displacements
    along = 3e8 * (0.6 * x + 0.8 * y)
    force = law.k * np.hypot(x, y) ** (law.n - 1) * np.array([x, y])
    assert force == pytest.approx([2000 - 0.6 * along, -0.8 * along], rel=1e-9)
    assert abs(y) > 0.05 * x


def test_three_strains_that_act_on_one_another():
    """A law F = K d with a full matrix K, between a point and the ground: d = K^-1 P, to a tangent of any axes."""
    matrix = 1e8 * np.array([[3.0, 0.4, -0.9], [0.4, 1.0, 0.6], [-0.9, 0.6, 2.0]])
    point = rigid_substructure([InterfaceLoad((n,), np.eye(3)[n], np.zeros(3)) for n in range(3)], (0, 1, 2))
    rows = tuple(((("p",), (n,), 1.0),) for n in range(3))
    law = NonlinearSpring("full", rows, lambda d: (0.5 * d @ matrix @ d, matrix @ d, matrix), 2e7, (0.0, 0.0, 0.0))
    found = solve_nonlinear({("p",): point}, [], [law], (("p",), (1,), 2000.0))
    assert found.coupled.displacements == pytest.approx(np.linalg.solve(matrix, [0, 2000.0, 0]), rel=1e-9)
    assert found.steps <= 6


def test_a_law_that_softens_needs_the_safeguard():
    """F = F0 atan(d/d0): whole steps of Newton's method run away from a start beyond 1.4 d0."""
    f0, d0, load = 1000.0, 1e-5, 1400.0

    def soft(d):
        x = d / d0
        return float(f0 * d0 * (x * np.arctan(x) - 0.5 * np.log1p(x**2))[0]), f0 * np.arctan(x), np.diag(f0 / d0 / (1 + x**2))

    spring = NonlinearSpring("soft", (((BAR, (0,), 1.0),),), soft, load / 30 / d0, (0.0,))
    found = solve_nonlinear({BAR: bar(1e-9)}, [], [spring], (BAR, (1,), load))
    assert found.coupled.strains == pytest.approx([d0 * np.tan(load / f0)], rel=1e-9)
    assert found.steps < 40


def test_at_its_secant_it_is_the_linear_solution():
    laws = [contact(Power(3e9, 1.3)), contact(Power(5e9, 1.4), end=1)]
    bodies, load = {BAR: bar(3e-9)}, (BAR, (1,), 800.0)
    found = solve_nonlinear(bodies, [], laws, load).coupled
    secants = [
        InterfaceSpring("s", each.rows[0], strain / force) for each, strain, force in zip(laws, found.strains, found.forces, strict=True)
    ]
    assert solve_coupled(bodies, secants, load).displacements == pytest.approx(found.displacements, rel=1e-12)


def test_twice_as_stiff_in_everything_moves_half_as_far():
    def moved(times):
        laws = [contact(Power(times * 3e9, 1.3), gap=0.0), contact(Power(times * 5e9, 1.0), end=1)]
        return solve_nonlinear({BAR: bar(3e-9 / times)}, [], laws, (BAR, (1,), times * 800.0)).coupled.displacements

    assert moved(2.0) == pytest.approx(moved(1.0), rel=1e-12)


def test_what_no_spring_holds_is_refused_by_name():
    ground = InterfaceSpring("ground", ((BAR, (0,), 1.0),), 0.0)
    with pytest.raises(DoesNotAssemble, match=r"assembly: body 'other' moves freely \(shift along x; 1 of 2 rigid motions are held"):
        solve_coupled({BAR: bar(0.0), ("other",): bar(0.0)}, [ground], (BAR, (1,), 1.0))
    with pytest.raises(DoesNotAssemble, match="Give it a support, or a contact that presses"):
        solve_nonlinear({BAR: bar(0.0), ("other",): bar(0.0)}, [ground], [contact(Power(1e9, 1.5))], (BAR, (1,), 1.0))


def test_what_only_an_open_contact_holds_does_not_settle():
    with pytest.raises(SolverError, match=r"assembly: no equilibrium after 100 steps.*body 'bar' has moved by .* mm\. Look for a body"):
        solve_nonlinear({BAR: bar(1e-9)}, [], [contact(Power(1e9, 1.5))], (BAR, (1,), -300.0))
