"""Supports of a shaft away from the usual: mirrored, coupled, on seats, one-sided; and stocky or conical shafts, against closed forms."""

import numpy as np
import pytest

from drivewright import bearings, shafts
from drivewright.bearings.response import evaluate_response
from drivewright.errors import InputError
from drivewright.shafts import beam as beams
from drivewright.shafts.beam import FREEDOMS
from drivewright.shafts.sections import area, cowper_coefficient, second_moment
from drivewright.shafts.vibration import element_shapes, is_isotropic

pytestmark = pytest.mark.analytical

E, NU, RHO, D, L = 206e9, 0.25, 7850.0, 0.02, 0.4
G, A, I = E / 2.5, float(area(D, 0.0)), float(second_moment(D, 0.0))
RIGID, EB = np.inf, shafts.EULER_BERNOULLI
T = np.array([1.0, 1.0, -1.0, -1.0, -1.0])  # a mirror across the axis turns z, and rotations about x and y, round
BALLS = bearings.BallBearing(balls=12, ball_diameter="5 mm", pitch_diameter="32 mm", contact_angle="25 deg")


def support(name, position, radial=RIGID, axial=0.0, tilt=0.0, **more):
    return shafts.Support(name, position, (radial, radial, axial, tilt, tilt), **more)


def shaft(supports, stations=(), shear=EB, sections=None, density=RHO):
    return shafts.Shaft(sections or (shafts.Section(L, D, D),), E, NU, density, tuple(supports), tuple(stations), shear)


def full_tangent(seed=1):
    """A stiffness matrix (5, 5) with every coupling."""
    scale = np.sqrt([3e7, 2e7, 1e7, 3e3, 2e3])
    noise = 0.1 * np.random.default_rng(seed).normal(size=(5, 5))
    return scale[:, None] * (np.eye(5) + noise @ noise.T + 0.1 * (noise + noise.T)) * scale


def loaded(one, *points, **more):
    return shafts.apply_loads(one, shafts.ShaftLoads(tuple(points), **more))


def moved(found, position, freedom=1):
    return found.equilibrium.u[FREEDOMS * found.equilibrium.model.beam.node(position) + freedom]


def at_rest(one, elements=24):
    system = shafts.assemble(one, np.linspace(0.0, one.length, elements + 1))
    return shafts.solve(system, 0 * shafts.nodal_forces(system, ()))


# -- mirrored and coupled supports ---------------------------------------------------------------------------------------------


def mirrored_and_plain():
    """The same shaft twice: a support whose own axis points left, and the support as it looks in the shaft's axes."""
    k, offset, push = full_tangent(), np.array([1e-5, -2e-5, 3e-5, 2e-4, -1e-4]), np.array([10.0, 20.0, 30.0, 0.4, 0.5])
    seat = (5e7, 4e7, 3e7, 8e3, 6e3)
    stations = [shafts.Station("p", 0.0), shafts.Station("q", 0.22)]
    return [
        shaft(
            [
                support("A", 0.3, 4e7),
                shafts.Support(
                    "B",
                    0.1,
                    law=shafts.LinearSupport(turn[:, None] * k * turn),
                    mirrored=turn[2] < 0,
                    offset=tuple(turn * offset),
                    seat=seat,
                    push=tuple(turn * push),
                ),
            ],
            stations,
        )
        for turn in (np.ones(5), T)
    ]


def test_a_mirrored_support_is_the_same_in_its_own_axes():
    load = shafts.ShaftLoad(0.22, (200.0, -500.0, 80.0), (3.0, -2.0, 0.0))
    plain, turned = (loaded(one, load).equilibrium for one in mirrored_and_plain())
    assert turned.reactions == pytest.approx(plain.reactions, rel=1e-8, abs=1e-8)
    assert turned.relative == pytest.approx(plain.relative, rel=1e-8, abs=1e-14)
    assert turned.tangent == pytest.approx(plain.tangent, rel=1e-9, abs=1e-3)
    assert np.abs(turned.relative[1]).min() > 1e-7
    one, two = (shafts.flexibility(each, [0.0, 0.22], (0.6, -0.8)) for each in (plain, turned))
    assert two.delta == pytest.approx(one.delta, rel=1e-9, abs=0)
    assert two.reactions == pytest.approx(one.reactions, rel=1e-8)
    assert two.shares == pytest.approx(one.shares, rel=1e-8, abs=1e-18)


def test_springs_of_a_mirrored_support_beside_its_law():
    """z and the tilts turn their signs on the way in and on the way out: what the shaft feels and exerts is the same."""
    k, springs = full_tangent(), (2e7, 3e7, 1e7, 4e3, 5e3)
    load, found = shafts.ShaftLoad(0.22, (200.0, -500.0, 80.0), (3.0, -2.0, 0.0)), []
    for turn in (np.ones(5), T):
        held = shafts.Support("B", 0.1, springs, law=shafts.LinearSupport(turn[:, None] * k * turn), mirrored=turn[2] < 0)
        found.append(loaded(shaft([support("A", 0.3, 4e7), held], [shafts.Station("q", 0.22)]), load).equilibrium)
    plain, turned = found
    assert turned.reactions == pytest.approx(plain.reactions, rel=1e-8) and np.abs(plain.reactions[1]).min() > 1
    assert turned.relative == pytest.approx(plain.relative, rel=1e-8, abs=1e-14)
    assert -plain.reactions[1] == pytest.approx((k + np.diag(springs)) @ plain.relative[1], rel=1e-8)
    one, two = (shafts.flexibility(each, [0.22], (0.6, -0.8)) for each in found)
    assert two.delta == pytest.approx(one.delta, rel=1e-9, abs=0) and two.support_forces == pytest.approx(
        one.support_forces, rel=1e-8, abs=1e-12
    )
    assert np.abs(one.support_forces[1, 3:]).min() > 1e-3


def test_a_coupled_support_on_a_seat_balances_and_its_shares_add_up():
    """Forces of support and seat are those of their matrices; the part of the seat is in the share of its support."""
    load = shafts.ShaftLoad(0.22, (200.0, -500.0, 80.0), (3.0, -2.0, 0.0))
    one = mirrored_and_plain()[0]
    found = loaded(one, load).equilibrium
    held = one.supports[1]
    assert -found.reactions[1] == pytest.approx(held.law.k @ found.relative[1], rel=1e-8)
    node = found.u[FREEDOMS * found.model.beam.node(0.1) :][:5]
    ring = node - held.offset - found.relative[1]
    assert np.multiply(held.seat, ring) == pytest.approx(np.array(held.push) - found.reactions[1], rel=1e-7)
    assert found.reactions[:, :2].sum(axis=0) == pytest.approx([-200.0, 500.0], rel=1e-8)
    flexible = shafts.flexibility(found, [0.0, 0.22], (0.6, -0.8))
    assert flexible.shares.sum(axis=0) == pytest.approx(flexible.delta, rel=1e-8, abs=0)
    assert flexible.names == ("bending", "shear", "A", "B")


def test_unit_reactions_are_what_one_newton_more_changes():
    """On rigid, elastic and coupled supports, in a slanting direction."""
    way, one = (
        np.array([0.6, -0.8]),
        shaft(
            [support("A", 0.05), shafts.Support("B", 0.2, law=shafts.LinearSupport(full_tangent())), support("C", 0.38, tilt=3e3)],
            [shafts.Station("p", 0.12)],
        ),
    )
    zero, unit = (loaded(one, shafts.ShaftLoad(0.12, (force * 0.6, force * -0.8, 0.0))).equilibrium for force in (0.0, 1.0))
    found = shafts.flexibility(zero, [0.12], way)
    assert found.reactions[:, 0] == pytest.approx(-(unit.reactions - zero.reactions)[:, :2] @ way, rel=1e-8)
    assert found.delta[0, 0] == pytest.approx(way @ [moved_by(unit, 0.12, freedom) for freedom in (0, 1)], rel=1e-9)


def moved_by(equilibrium, position, freedom):
    return equilibrium.u[FREEDOMS * equilibrium.model.beam.node(position) + freedom]


def test_a_shaft_stretched_by_coupled_bearings_has_a_share_of_tension():
    one = shaft(
        [shafts.Support(n, z, law=shafts.LinearSupport(full_tangent(seed))) for n, z, seed in (("A", 0.1, 3), ("B", 0.3, 4))],
        [shafts.Station("p", 0.0)],
    )
    found = shafts.flexibility(loaded(one).equilibrium, [0.0], (0.0, -1.0))
    share = found.shares[found.names.index("tension"), 0, 0]
    assert found.shares.sum(axis=0) == pytest.approx(found.delta, rel=1e-9, abs=0)
    system = loaded(one, shafts.ShaftLoad(0.0, (0.0, -1.0, 0.0)))
    pull = shafts.diagram(system).axial
    assert share == pytest.approx(pull[np.argmax(np.abs(pull))] ** 2 * 0.2 / (E * A), rel=1e-6, abs=0)


def test_a_spring_in_a_seat_aside_pushes_the_shaft_towards_it():
    """s over the compliances in series: 1/k and L^3/48EI."""
    lifted = support("M", L / 2, 2e5, offset=(3e-5, 5e-5, 0.0, 0.0, 0.0))
    found = loaded(shaft([support("A", 0.0), lifted, support("B", L)])).equilibrium
    per = 1 / (1 / 2e5 + L**3 / (48 * E * I))
    assert found.reactions[1, :2] == pytest.approx([3e-5 * per, 5e-5 * per], rel=1e-9)
    assert found.relative[1, 1] == pytest.approx(-5e-5 * per / 2e5, rel=1e-9)


# -- what is held and what is not ----------------------------------------------------------------------------------------------


def axial_spring():
    return shaft([support("A", 0.0, axial=4e6), support("B", L)])


@pytest.mark.parametrize("force", [300.0, -300.0])
def test_an_axial_spring_takes_both_ways(force):
    found = loaded(axial_spring(), shafts.ShaftLoad(L / 2, (0.0, 0.0, force)))
    assert moved(found, 0.0, 2) == pytest.approx(force / 4e6, rel=1e-9)
    assert found.equilibrium.reactions[0, 2] == pytest.approx(-force, rel=1e-9)


def angular(mirrored, **more):
    law = bearings.law_of(BALLS)
    return shafts.Support("B", 0.3, law=law, mirrored=mirrored, **more)


@pytest.mark.parametrize("mirrored", [False, True])
def test_an_angular_bearing_takes_its_way_and_no_other(mirrored):
    """A force of 300 N is met by the displacement of the bearing alone, turned round where it is mirrored."""
    way = -1.0 if mirrored else 1.0
    one = shaft([support("A", 0.05), angular(mirrored)])
    alone = bearings.solve(BALLS, force=[0, 0, 300.0, 0, 0], held=("x", "y", "tilt_x", "tilt_y")).displacement[2]
    found = loaded(one, shafts.ShaftLoad(0.3, (0.0, 0.0, way * 300.0))).equilibrium
    assert found.relative[1, 2] == pytest.approx(way * alone, rel=1e-6)
    assert found.reactions[1, 2] == pytest.approx(-way * 300.0, rel=1e-8)


def test_a_roller_bearing_takes_one_way_only():
    rollers = bearings.law_of(
        bearings.RollerBearing(rollers=15, roller_diameter="4 mm", roller_length="8 mm", pitch_diameter="30 mm", contact_angle="14 deg")
    )
    for mirrored, side in ((False, "left"), (True, "right")):
        one = shaft([support("A", 0.05), shafts.Support("B", 0.3, law=rollers, mirrored=mirrored)])
        way = 1.0 if mirrored else -1.0
        with pytest.raises(InputError, match=f"an axial force of {way * 50:g} N, and no bearing that takes a force to the {side}"):
            loaded(one, shafts.ShaftLoad(0.2, (0.0, -10.0, way * 50.0)))
        found = loaded(one, shafts.ShaftLoad(0.2, (0.0, -10.0, -way * 50.0))).equilibrium
        assert found.reactions[1, 2] == pytest.approx(way * 50.0, rel=1e-7)


def test_a_seat_that_slides_takes_no_axial_force():
    one = shaft([support("A", 0.05), angular(False, seat=(RIGID, RIGID, 0.0, RIGID, RIGID))])
    with pytest.raises(InputError, match="no bearing that takes a force to the right"):
        loaded(one, shafts.ShaftLoad(0.2, (0.0, -10.0, 50.0)))


def test_a_sliding_seat_under_rollers_that_slide_anyway_changes_nothing():
    """Cylindrical rollers do not resist along the axis: a ring free to slide would be held by nothing, and is none."""
    rollers = bearings.law_of(bearings.RollerBearing(rollers=15, roller_diameter="4 mm", roller_length="8 mm", pitch_diameter="30 mm"))
    found = [
        loaded(
            shaft(
                [support("A", 0.05, 3e7), shafts.Support("B", 0.3, law=rollers, seat=(RIGID, RIGID, along, RIGID, RIGID))],
                [shafts.Station("p", L)],
            ),
            shafts.ShaftLoad(L, (0.0, -200.0, 0.0)),
        ).equilibrium
        for along in (RIGID, 0.0)
    ]
    one, two = (shafts.flexibility(each, [L], (0.0, -1.0)).delta for each in found)
    assert two == pytest.approx(one, rel=1e-9, abs=0) and found[1].model.size == found[0].model.size


def test_one_rolling_bearing_holds_by_its_tilt_stiffness_unless_its_seat_turns():
    """One bearing takes the moment of the overhanging load, with the sign that holds the shaft up."""
    found = loaded(
        shaft([angular(False, seat=(RIGID, RIGID, RIGID, RIGID, RIGID), offset=(0, 0, -1e-5, 0, 0))]),
        shafts.ShaftLoad(0.35, (0.0, -20.0, 0.0)),
    ).equilibrium
    assert found.reactions[0, 1] == pytest.approx(20.0, rel=1e-8) and found.reactions[0, 3] == pytest.approx(-20.0 * 0.05, rel=1e-7)
    with pytest.raises(InputError, match="'B'.* leave it free to swing"):
        shafts.assemble(shaft([angular(False, seat=(RIGID, RIGID, RIGID, 0.0, 0.0))]))


def test_torques_that_partly_cancel_do_not_balance():
    with pytest.raises(InputError, match="their sum is 2 N·m"):
        loaded(axial_spring(), shafts.ShaftLoad(0.1, moment=(0, 0, 5.0)), shafts.ShaftLoad(0.3, moment=(0, 0, -3.0)))


@pytest.mark.parametrize("place", [-0.01, 0.45])
def test_a_place_off_the_shaft_is_told(place):
    with pytest.raises(InputError, match=f"a place at {1e3 * place:g} mm lies outside the shaft, which runs from 0 to 400 mm"):
        loaded(axial_spring(), shafts.ShaftLoad(place, (0.0, 1.0, 0.0)))


def test_places_close_together_stay_apart():
    """A station 0.2 mm beside a support moves a + by the slope there."""
    found = loaded(shaft([support("A", 0.0), support("B", 0.3)], [shafts.Station("p", 0.3002)]), shafts.ShaftLoad(L, (0.0, -100.0, 0.0)))
    slope = 100 * 0.1 * 0.3 / (3 * E * I)
    assert moved(found, 0.3002) == pytest.approx(-2e-4 * slope, rel=2e-2)


# -- cones, twist, tension, weight ---------------------------------------------------------------------------------------------

CONE = (shafts.Section(L, 0.03, 0.06, 0.015),)
GAUSS = [0.5 * (part + shift) for part, shift in zip(np.polynomial.legendre.leggauss(60), (1.0, 0.0), strict=True)]


def along_cone(of):
    """int of(diameter) dz over the cone."""
    return L * np.sum(GAUSS[1] * of(0.03 + 0.03 * GAUSS[0]))


def test_a_cone_twists_and_stretches_by_its_integrals():
    one = shaft([support("A", 0.0, axial=RIGID), support("B", L)], sections=CONE)
    found = loaded(one, shafts.ShaftLoad(0.0, moment=(0, 0, -40.0)), shafts.ShaftLoad(L, (0, 0, -900.0), (0, 0, 40.0)))
    ring, polar = along_cone(lambda d: 4 / (np.pi * (d**2 - 0.015**2))), along_cone(lambda d: 32 / (np.pi * (d**4 - 0.015**4)))
    assert moved(found, L, 2) == pytest.approx(-900 / E * ring, rel=1e-9)
    assert moved(found, L, 5) == pytest.approx(40 / G * polar, rel=1e-9)
    drawn = shafts.diagram(found)
    diameter = 0.03 + 0.03 * drawn.z / L
    assert drawn.axial == pytest.approx(-900.0) and drawn.torque == pytest.approx(40.0)
    assert drawn.bending == pytest.approx(900 * 4 / (np.pi * (diameter**2 - 0.015**2)), rel=1e-6)  # pressed is stressed, too
    assert drawn.torsion == pytest.approx(40 * 16 * diameter / (np.pi * (diameter**4 - 0.015**4)), rel=1e-6)
    assert drawn.von_mises == pytest.approx(np.sqrt(drawn.bending**2 + 3 * drawn.torsion**2), rel=1e-12)


def test_a_hollow_cone_bends_and_shears_by_its_integrals():
    """Clamped at one end, a force at the other: int x^2/EI + int 1/(kappa G A), kappa by Cowper at every place."""
    one = shaft([support("A", L, axial=RIGID, tilt=RIGID)], [shafts.Station("p", 0.0)], shafts.COWPER, CONE)
    found = loaded(one, shafts.ShaftLoad(0.0, (0.0, -1000.0, 0.0)))
    z = L * GAUSS[0]
    bend = along_cone(lambda d: z**2 * 64 / (np.pi * (d**4 - 0.015**4)))
    kappa = np.array([float(cowper_coefficient(d, 0.015, NU)) for d in 0.03 + 0.03 * GAUSS[0]])
    slip = along_cone(lambda d: 4 / (kappa * np.pi * (d**2 - 0.015**2)))
    assert -moved(found, 0.0) / 1000 == pytest.approx(bend / E + slip / G, rel=1e-9)
    drawn = shafts.diagram(found)
    diameter = 0.03 + 0.03 * drawn.z / L
    assert drawn.bending == pytest.approx(1000 * drawn.z * 32 * diameter / (np.pi * (diameter**4 - 0.015**4)), rel=1e-6, abs=1.0)


def test_cowpers_coefficient_at_its_ends():
    """Solid: 6 (1 + nu)/(7 + 6 nu); thin tube: 2 (1 + nu)/(4 + 3 nu)  (both recalled with the paper)."""
    assert float(cowper_coefficient(0.02, 0.0, 0.3)) == pytest.approx(7.8 / 8.8, rel=1e-14)
    assert float(cowper_coefficient(0.02, 0.02 * (1 - 1e-9), 0.3)) == pytest.approx(2.6 / 4.9, rel=1e-7)


def test_a_hanging_cone_pulls_at_the_ends_of_its_pieces_by_its_moment():
    """Held at the left, gravity to the right: the whole weight there, and at the free end int rho A z/L of it."""
    one = shaft([support("A", 0.0, axial=RIGID), support("B", L)], sections=CONE)
    found = loaded(one, gravity=(0.0, 0.0, 9.81))
    total, far = (9.81 * RHO * np.pi / 4 * along_cone(lambda d, p=p: GAUSS[0] ** p * (d**2 - 0.015**2)) for p in (0, 1))
    assert found.equilibrium.reactions[0, 2] == pytest.approx(-total, rel=1e-9) and far > 0.55 * total
    assert moved(found, L, 2) == pytest.approx(far / E * along_cone(lambda d: 4 / (np.pi * (d**2 - 0.015**2))), rel=1e-9)


def test_weight_sideways_is_felt_too():
    one = shaft([support("A", 0.0), support("B", L)], [shafts.Station("m", L / 4, 3.0)])
    found = loaded(one, gravity=(-9.81, 0.0, 0.0)).equilibrium
    own = RHO * A * L * 9.81
    assert found.reactions[:, 0] == pytest.approx([own / 2 + 3 * 9.81 * 0.75, own / 2 + 3 * 9.81 * 0.25], rel=1e-9)


def test_bending_of_a_cone_under_its_weight_is_exact_between_the_nodes():
    """E I(z) dt/dz = M and dM/dz = -V, at places inside of one element under a parabolic load."""
    found = loaded(shaft([support("A", 0.0), support("B", L)], sections=CONE), gravity=(0.0, -9.81, 0.0))
    z = np.linspace(0.05, 0.35, 3001)
    curve = beams.elastic_line(found.equilibrium.model.beam, 1, found.equilibrium.unknowns, z, found.spread[1])
    diameter = 0.03 + 0.03 * z / L
    load = -9.81 * RHO * np.pi / 4 * (diameter**2 - 0.015**2)
    assert np.gradient(curve.shear, z)[2:-2] == pytest.approx(-load[2:-2], rel=1e-5)
    assert np.gradient(curve.moment, z)[2:-2] == pytest.approx(-curve.shear[2:-2], abs=1e-5 * np.abs(curve.shear).max())
    turned = E * np.pi / 64 * (diameter**4 - 0.015**4) * np.gradient(curve.slope, z)
    assert turned[2:-2] == pytest.approx(curve.moment[2:-2], abs=1e-5 * np.abs(curve.moment).max())
    assert np.gradient(curve.deflection, z)[2:-2] == pytest.approx(curve.slope[2:-2], abs=1e-6 * np.abs(curve.slope).max())


# -- radial curves -------------------------------------------------------------------------------------------------------------

LAWS = {
    "play": shafts.with_play(3e7, 8e-6),
    "table": shafts.tabulated([0.0, 1e-5, 3e-5, 4e-5], [0.0, 200.0, 1000.0, 1700.0]),
    "tangent": shafts.LinearSupport(full_tangent()),
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("size", [4e-6, 1.3e-5, 3.7e-5, 6e-5])
def test_force_and_stiffness_are_derivatives_of_the_energy(law, size):
    place, step = np.array([0.8, -0.6, 0.3, 2.0, -1.0]) * size, 1e-9
    _, force, stiffness = evaluate_response(LAWS[law], place)
    around = [[evaluate_response(LAWS[law], place + way * step * np.eye(5)[i]) for way in (1, -1)] for i in range(5)]
    slope = np.array([(up[0] - down[0]) / (2 * step) for up, down in around])
    bend = np.array([(up[1] - down[1]) / (2 * step) for up, down in around])
    assert slope == pytest.approx(force, rel=1e-6, abs=1e-5)
    assert bend == pytest.approx(stiffness, rel=1e-6, abs=1.0)


def test_a_table_runs_on_straight_from_its_end():
    law, way = LAWS["table"], np.array([1.0, 0.0, 0.0, 0.0, 0.0])
    last, beyond, far = (evaluate_response(law, r * way) for r in (4e-5 - 1e-12, 6e-5, 8e-5))
    assert beyond[2][0, 0] == pytest.approx(last[2][0, 0], rel=1e-5) and far[2][0, 0] == beyond[2][0, 0]
    assert far[1][0] - beyond[1][0] == pytest.approx(2e-5 * last[2][0, 0], rel=1e-5)
    assert evaluate_response(law, 1e-5 * way)[0] < evaluate_response(law, 2e-5 * way)[0] < evaluate_response(law, 4e-5 * way)[0]


# -- vibration -----------------------------------------------------------------------------------------------------------------


def test_critical_speeds_of_a_stocky_shaft_have_its_own_gyroscopic_moments():
    """Simply supported, wave number k: det[[kGA k^2 - rho A s^2, -kGA k], [-kGA k, EI k^2 + kGA - c rho I s^2]] = 0 with c = 1 - 2 for a
    whirl with the shaft and 1 + 2 for one against it."""
    d = 0.1
    a, i, kappa = float(area(d, 0.0)), float(second_moment(d, 0.0)), float(cowper_coefficient(d, 0.0, NU))
    one = shaft([support("A", 0.0), support("B", L)], shear=shafts.COWPER, sections=(shafts.Section(L, d, d),))
    found, k, stiff = shafts.critical_speeds(at_rest(one, 40), 1), np.pi / L, kappa * G * a
    for speeds, c in ((found.forward, -1.0), (found.backward, 3.0)):
        squares = np.roots([RHO * a * c * RHO * i, -(stiff * k**2 * c * RHO * i + RHO * a * (E * i * k**2 + stiff)), stiff * E * i * k**4])
        assert speeds[0] == pytest.approx(np.sqrt(min(s.real for s in squares if s.real > 0)), rel=2e-4)
    assert found.forward[0] > 1.05 * found.backward[0]


def test_shapes_inside_an_element_are_the_lines_of_its_nodes():
    """On a cone with shear, by the route that draws the deflection."""
    found = beams.beam(shaft([support("A", 0.0), support("B", L)], shear=shafts.COWPER, sections=CONE))
    deflection, slope = element_shapes(found)
    z = L * 0.5 * (np.polynomial.legendre.leggauss(8)[0] + 1)
    for number, freedom in enumerate((0, 4, 6, 10)):
        curve = beams.elastic_line(found, 0, np.linalg.solve(beams.displacement_basis(found), np.eye(1, found.size, freedom)[0]), z)
        assert deflection[0, :, number] == pytest.approx(curve.deflection, rel=1e-8, abs=1e-12)
        assert slope[0, :, number] == pytest.approx(curve.slope, rel=1e-8, abs=1e-9)


def on_matrix(turn, matrix):
    """A shaft with a disc on one rigid bearing and one support with `matrix` turned about the axis."""
    c, s = np.cos(turn), np.sin(turn)
    round_axis = np.eye(5)
    round_axis[:2, :2] = round_axis[3:, 3:] = [[c, -s], [s, c]]
    law = shafts.LinearSupport(round_axis @ matrix @ round_axis.T)
    return shaft([support("A", 0.05, axial=RIGID), shafts.Support("B", 0.3, law=law)], [shafts.Station("d", L, 3.0, 0.01, 0.006)])


@pytest.mark.parametrize("matrix", [np.diag([2e7, 5e6, 0.0, 0.0, 0.0]), np.diag([2e7, 2e7, 0.0, 5e3, 5e2])], ids=["radial", "tilt"])
def test_turning_the_supports_turns_the_modes(matrix):
    """Principal stiffnesses along x and y, or aslant: the frequencies are those of the two planes, taken one by one."""
    planes = [np.diag([k, k, 0.0, t, t]) for k, t in ((matrix[0, 0], matrix[4, 4]), (matrix[1, 1], matrix[3, 3]))]
    wanted = np.sort(np.concatenate([shafts.modes(at_rest(on_matrix(0.0, each)), 2)[0].frequencies for each in planes]))
    assert wanted[1] > 1.002 * wanted[0]
    speeds = shafts.critical_speeds(at_rest(on_matrix(0.0, matrix)), 2)
    for turn in (0.0, 0.4, np.pi / 4):
        rest = at_rest(on_matrix(turn, matrix))
        assert not is_isotropic(rest)
        assert shafts.modes(rest, 4)[0].frequencies == pytest.approx(wanted, rel=1e-7)
        turned = shafts.critical_speeds(rest, 2)
        assert turned.forward == pytest.approx(speeds.forward, rel=1e-7) and turned.backward == pytest.approx(speeds.backward, rel=1e-7)


def test_the_axial_mode_is_no_mode_of_bending():
    """A mass on an axial spring softer than all else across: it comes first and is told apart, at rest and among the speeds."""
    held = shafts.Support("B", 0.3, (5e6, 6e6, 1e4, 0.0, 0.0))
    one = shaft([support("A", 0.05, 1e7), held], [shafts.Station("m", L, 3.0)])
    bending, axial = shafts.modes(at_rest(one), 3)
    assert axial.frequencies[0] == pytest.approx(np.sqrt(1e4 / (3.0 + RHO * A * L)) / (2 * np.pi), rel=1e-3)
    assert len(bending.frequencies) == 3 and bending.frequencies[0] > 2 * axial.frequencies[0]
    speeds = shafts.critical_speeds(at_rest(one), 2)
    assert len(speeds.forward) == 2 and speeds.forward[0] == pytest.approx(2 * np.pi * bending.frequencies[0], rel=1e-2)


def test_a_seat_that_yields_softens_the_modes_like_a_spring_in_series():
    stations = [shafts.Station("m", L, 3.0)]
    series = shaft([support("A", 0.05), support("B", 0.3, 1 / (1 / 5e6 + 1 / 2e6))], stations)
    seated = shaft([support("A", 0.05), support("B", 0.3, 5e6, seat=(2e6, 2e6, RIGID, RIGID, RIGID))], stations)
    wanted = shafts.modes(at_rest(series), 2)[0].frequencies
    assert shafts.modes(at_rest(seated), 4)[0].frequencies[::2] == pytest.approx(wanted, rel=1e-8)


def test_shapes_of_torsion_are_waves_with_free_ends():
    rest = at_rest(shaft([support("A", 0.0), support("B", L)]), 40)
    found = shafts.torsional_modes(rest, 2)
    z, turned = rest.model.beam.z, found.shapes[5 : rest.model.beam.size : FREEDOMS]
    for number, shape in enumerate(turned.T, 1):
        assert shape / shape[0] == pytest.approx(np.cos(number * np.pi * z / L), abs=2e-3)
