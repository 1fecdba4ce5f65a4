"""Shafts against closed forms: simply supported, overhung, misaligned, with play, conical, vibrating, whirling."""

import numpy as np
import pytest

from drivewright import shafts
from drivewright.shafts.beam import FREEDOMS, PLANES
from drivewright.shafts.sections import area, cowper_coefficient, second_moment

pytestmark = pytest.mark.analytical

E, NU, RHO, D, L = 206e9, 0.3, 7850.0, 0.02, 0.4
G, A, I = E / 2.6, float(area(D, 0.0)), float(second_moment(D, 0.0))
KAPPA = float(cowper_coefficient(D, 0.0, NU))
RIGID, EB = np.inf, shafts.EULER_BERNOULLI


def support(name, position, radial=RIGID, axial=0.0, tilt=0.0, **more):
    return shafts.Support(name, position, (radial, radial, axial, tilt, tilt), **more)


def shaft(supports, stations=(), shear=EB, sections=None, density=RHO):
    return shafts.Shaft(sections or (shafts.Section(L, D, D),), E, NU, density, tuple(supports), tuple(stations), shear)


def simple(shear=EB, stations=(), **more):
    return shaft([support("A", 0.0), support("B", L)], stations, shear, **more)


def moved(loaded, position, freedom=1):
    found = loaded.equilibrium
    return found.u[FREEDOMS * found.model.beam.node(position) + freedom]


# -- statics -------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shear", [EB, shafts.COWPER, 0.7])
def test_uniform_load_on_two_supports(shear):
    q = 1500.0
    loaded = shafts.apply_loads(
        simple(shear, [shafts.Station("m", L / 2)]), shafts.ShaftLoads(lines=(shafts.LineLoad(0.0, L, (0, -q), (0, -q)),))
    )
    slip = 0.0 if shear == EB else q * L**2 / (8 * (shear or KAPPA) * G * A)
    assert moved(loaded, L / 2) == pytest.approx(-(5 * q * L**4 / (384 * E * I) + slip), rel=1e-10)


def test_between_the_nodes_the_curve_is_exact():
    q, z = 1500.0, np.linspace(0.01, 0.39, 7)
    loaded = shafts.apply_loads(simple(), shafts.ShaftLoads(lines=(shafts.LineLoad(0.0, L, (0, -q), (0, -q)),)))
    found = loaded.equilibrium
    curve = shafts.beam.elastic_line(found.model.beam, 1, found.unknowns, z, loaded.spread[1])
    assert curve.deflection == pytest.approx(-q * z * (L**3 - 2 * L * z**2 + z**3) / (24 * E * I), rel=1e-9)
    assert curve.slope == pytest.approx(-q * (L**3 - 6 * L * z**2 + 4 * z**3) / (24 * E * I), rel=1e-9)
    assert np.abs(curve.moment) == pytest.approx(q * z * (L - z) / 2, rel=1e-9)
    assert np.abs(curve.shear) == pytest.approx(np.abs(q * (L / 2 - z)), rel=1e-9)


def test_a_triangular_load_divides_one_to_two():
    loaded = shafts.apply_loads(simple(), shafts.ShaftLoads(lines=(shafts.LineLoad(0.0, L, (0, 0.0), (0, -3000.0)),)))
    assert loaded.equilibrium.reactions[:, 1] == pytest.approx([3000 * L / 6, 3000 * L / 3], rel=1e-10)
    with_sag = 3000 * L**4 / E / I * 5 / 768  # at mid-span
    station = shafts.apply_loads(
        simple(stations=[shafts.Station("m", L / 2)]), shafts.ShaftLoads(lines=(shafts.LineLoad(0.0, L, (0, 0), (0, -3000.0)),))
    )
    assert moved(station, L / 2) == pytest.approx(-with_sag, rel=1e-10)


def test_a_force_has_the_same_effect_in_every_plane():
    stations = [shafts.Station("m", 0.15)]
    x, y = (
        moved(shafts.apply_loads(simple(stations=stations), shafts.ShaftLoads((shafts.ShaftLoad(0.15, force),))), 0.15, freedom)
        for force, freedom in (((700.0, 0, 0), 0), ((0, 700.0, 0), 1))
    )
    a, b = 0.15, L - 0.15
    assert x == pytest.approx(700 * a**2 * b**2 / (3 * E * I * L), rel=1e-10) and x == pytest.approx(y, rel=1e-12)


@pytest.mark.parametrize("axis, freedom, sign", [((0.0, 12.0, 0.0), 0, 1.0), ((12.0, 0.0, 0.0), 1, -1.0)])
def test_a_couple_turns_right_handed(axis, freedom, sign):
    """A couple M about y at the left support lifts the span along +x by M L^2/16 EI; one about x pushes it along -y."""
    loaded = shafts.apply_loads(simple(stations=[shafts.Station("m", L / 2)]), shafts.ShaftLoads((shafts.ShaftLoad(0.0, moment=axis),)))
    assert moved(loaded, L / 2, freedom) == pytest.approx(sign * 12.0 * L**2 / (16 * E * I), rel=1e-10)


def test_weight_of_shaft_and_station():
    loaded = shafts.apply_loads(simple(stations=[shafts.Station("m", L / 4, 3.0)]), shafts.ShaftLoads(gravity=(0.0, -9.81, 0.0)))
    own = RHO * A * L * 9.81
    assert loaded.equilibrium.reactions[:, 1] == pytest.approx([own / 2 + 3 * 9.81 * 0.75, own / 2 + 3 * 9.81 * 0.25], rel=1e-10)


def test_weight_along_the_axis_stretches_the_shaft():
    held = shaft([support("A", 0.0, axial=RIGID), support("B", L)])
    loaded = shafts.apply_loads(held, shafts.ShaftLoads(gravity=(0.0, 0.0, 9.81)))
    assert moved(loaded, L, 2) == pytest.approx(RHO * 9.81 * L**2 / (2 * E), rel=1e-9)
    assert loaded.equilibrium.reactions[0, 2] == pytest.approx(-RHO * A * L * 9.81, rel=1e-12)


def test_weight_of_a_cone_is_that_of_its_volume():
    d0, d1, bore = 0.02, 0.05, 0.01
    cone = shaft([support("A", 0.0), support("B", L)], sections=(shafts.Section(L, d0, d1, bore),))
    loaded = shafts.apply_loads(cone, shafts.ShaftLoads(gravity=(0.0, -9.81, 0.0)))
    volume = np.pi * L / 12 * (d0**2 + d0 * d1 + d1**2) - np.pi / 4 * bore**2 * L
    assert loaded.equilibrium.reactions[:, 1].sum() == pytest.approx(RHO * 9.81 * volume, rel=1e-10)


def test_torque_twists_and_tension_stretches_a_stepped_shaft():
    sections = (shafts.Section(0.1, 0.02, 0.02), shafts.Section(0.3, 0.03, 0.03, 0.01))
    held = shaft([support("A", 0.0, axial=RIGID), support("B", L)], sections=sections)
    loaded = shafts.apply_loads(
        held, shafts.ShaftLoads((shafts.ShaftLoad(0.0, moment=(0, 0, -40.0)), shafts.ShaftLoad(L, (0, 0, 900.0), (0, 0, 40.0))))
    )
    twist = 40 / G * sum(s.length / (2 * second_moment(s.start, s.bore)) for s in sections)
    stretch = 900 / E * sum(s.length / area(s.start, s.bore) for s in sections)
    assert moved(loaded, L, 5) == pytest.approx(twist, rel=1e-10)
    assert moved(loaded, L, 2) == pytest.approx(stretch, rel=1e-10)
    drawn = shafts.diagram(loaded)
    assert drawn.axial == pytest.approx(900.0) and drawn.torque == pytest.approx(40.0)
    d = 0.02
    assert drawn.torsion[0] == pytest.approx(16 * 40 / (np.pi * d**3), rel=1e-9)
    assert drawn.von_mises[0] == pytest.approx(np.hypot(900 / area(d, 0.0), np.sqrt(3) * 16 * 40 / (np.pi * d**3)), rel=1e-9)


def test_bending_stress_is_moment_over_section_modulus():
    loaded = shafts.apply_loads(simple(), shafts.ShaftLoads((shafts.ShaftLoad(L / 2, (0, -800.0, 0)),)))
    assert shafts.diagram(loaded).bending.max() == pytest.approx(32 * 800 * L / 4 / (np.pi * D**3), rel=1e-6)


def test_shear_is_the_slope_of_the_moment():
    loads = shafts.ShaftLoads(
        (shafts.ShaftLoad(0.1, (300.0, -800.0, 0)),), (shafts.LineLoad(0.15, 0.35, (0, -900), (200, 100)),), (0, -9.81, 0)
    )
    loaded = shafts.apply_loads(simple(), loads)
    z = np.linspace(0.16, 0.34, 2001)
    for plane in (0, 1):
        curve = shafts.beam.elastic_line(loaded.equilibrium.model.beam, plane, loaded.equilibrium.unknowns, z, loaded.spread[plane])
        assert np.gradient(curve.moment, z)[2:-2] == pytest.approx(-curve.shear[2:-2], abs=1e-4 * np.abs(curve.shear).max())
        assert np.gradient(curve.deflection, z)[2:-2] == pytest.approx(curve.slope[2:-2], abs=1e-6 * np.abs(curve.slope).max())
        assert E * I * np.gradient(curve.slope, z)[2:-2] == pytest.approx(curve.moment[2:-2], abs=1e-4 * np.abs(curve.moment).max())


# -- supports ------------------------------------------------------------------------------------------------------------------


def test_one_bearing_with_tilt_stiffness():
    """delta = 1/k + a^2/k_t + a^3/3EI of a force a beside the bearing."""
    held = shaft([support("A", 0.1, 4e7, tilt=3e4)], [shafts.Station("m", 0.35)])
    loaded = shafts.apply_loads(held, shafts.ShaftLoads((shafts.ShaftLoad(0.35, (0, -100.0, 0)),)))
    a = 0.25
    assert moved(loaded, 0.35) == pytest.approx(-100 * (1 / 4e7 + a**2 / 3e4 + a**3 / (3 * E * I)), rel=1e-10)
    assert np.abs(loaded.equilibrium.reactions[0, 3]) == pytest.approx(25.0, rel=1e-10)


def test_clamped_ends():
    both = shaft([support("A", 0.0, tilt=RIGID), support("B", L, tilt=RIGID)], [shafts.Station("m", L / 2)])
    assert moved(shafts.apply_loads(both, shafts.ShaftLoads((shafts.ShaftLoad(L / 2, (0, -500.0, 0)),))), L / 2) == pytest.approx(
        -500 * L**3 / (192 * E * I), rel=1e-10
    )


def test_a_misaligned_middle_bearing_bends_the_shaft():
    """48 EI s/L^3 to push the middle of the span s aside; half of it back at either end."""
    lifted = support("M", L / 2, offset=(0.0, 5e-5, 0.0, 0.0, 0.0))
    loaded = shafts.apply_loads(shaft([support("A", 0.0), lifted, support("B", L)]), shafts.ShaftLoads())
    force = 48 * E * I * 5e-5 / L**3
    assert loaded.equilibrium.reactions[:, 1] == pytest.approx([-force / 2, force, -force / 2], rel=1e-9)


def test_a_seat_on_springs_yields_like_springs_in_series():
    stations = [shafts.Station("m", 0.15)]
    series = shaft([support("A", 0.0, 1 / (1 / 5e7 + 1 / 2e7)), support("B", L, 3e7)], stations)
    seated = shaft([support("A", 0.0, 5e7, seat=(2e7, 2e7, RIGID, RIGID, RIGID)), support("B", L, 3e7)], stations)
    one, two = (
        moved(shafts.apply_loads(each, shafts.ShaftLoads((shafts.ShaftLoad(0.15, (60.0, -400.0, 0)),))), 0.15) for each in (series, seated)
    )
    assert one == pytest.approx(two, rel=1e-10)


def test_play_shifts_the_shaft_until_it_is_met():
    """Two springs with a gap each: the loaded shaft lies in the gap, deflected as without play from there."""
    gap, stations = 20e-6, [shafts.Station("m", 0.15)]
    with_play = shaft([shafts.Support(n, z, law=shafts.with_play(3e7, gap)) for n, z in (("A", 0.0), ("B", L))], stations)
    without = shaft([support("A", 0.0, 3e7), support("B", L, 3e7)], stations)
    down = shafts.ShaftLoads((shafts.ShaftLoad(0.15, (0, -400.0, 0)),))
    one, two = shafts.apply_loads(with_play, down), shafts.apply_loads(without, down)
    assert moved(one, 0.15) == pytest.approx(moved(two, 0.15) - gap, rel=1e-9)
    assert one.equilibrium.reactions == pytest.approx(two.equilibrium.reactions, abs=1e-6)


def test_a_straight_table_is_a_spring_and_a_curved_one_meets_its_rows():
    rows = np.array([0.0, 1e-5, 3e-5])
    straight = shaft([shafts.Support(n, z, law=shafts.tabulated(rows, 3e7 * rows)) for n, z in (("A", 0.0), ("B", L))])
    loaded = shafts.apply_loads(straight, shafts.ShaftLoads((shafts.ShaftLoad(0.1, (300.0, -400.0, 0)),)))
    force, moved_by = loaded.equilibrium.reactions[:, :2], loaded.equilibrium.relative[:, :2]
    assert -force / moved_by == pytest.approx(np.full((2, 2), 3e7), rel=1e-9)
    bent = shaft([shafts.Support(n, z, law=shafts.tabulated(rows, [0.0, 200.0, 1000.0])) for n, z in (("A", 0.0), ("B", L))])
    found = shafts.apply_loads(bent, shafts.ShaftLoads((shafts.ShaftLoad(L / 2, (0, -2000.0, 0)),))).equilibrium
    assert found.relative[:, 1] == pytest.approx([-3e-5, -3e-5], rel=1e-8)


def test_a_tangent_with_all_its_couplings_is_the_matrix_it_holds():
    matrix = np.diag([2e7, 3e7, 1e7, 2e3, 3e3]) + 1e3 * (np.eye(5, k=1) + np.eye(5, k=-1))
    one = shaft([shafts.Support("A", 0.1, law=shafts.LinearSupport(matrix)), support("B", 0.3, 4e7)])
    found = shafts.apply_loads(one, shafts.ShaftLoads((shafts.ShaftLoad(0.0, (100.0, -400.0, 0)),))).equilibrium
    assert -found.reactions[0] == pytest.approx(matrix @ found.relative[0], rel=1e-9, abs=1e-9)


def test_spreading_a_reaction_over_a_width_keeps_it_and_takes_the_mean():
    wide = [support("A", 0.1, 3e7, width=0.02), support("B", 0.3, width=0.02)]
    found = shafts.apply_loads(shaft(wide, shear=shafts.COWPER), shafts.ShaftLoads((shafts.ShaftLoad(0.0, (0, -400.0, 0)),)))
    assert found.equilibrium.reactions[:, 1] == pytest.approx([600.0, -200.0], rel=1e-9)
    beam, u = found.equilibrium.model.beam, found.equilibrium.unknowns
    for start, mean in ((0.09, found.equilibrium.relative[0, 1]), (0.29, 0.0)):
        z = start + 0.02 * (np.polynomial.legendre.leggauss(40)[0] + 1) / 2
        line = shafts.beam.elastic_line(beam, 1, u, z).deflection
        assert np.dot(np.polynomial.legendre.leggauss(40)[1], line) / 2 == pytest.approx(
            mean, abs=2e-4 * abs(found.equilibrium.relative[0, 1])
        )


# -- flexibility ---------------------------------------------------------------------------------------------------------------


def test_shares_add_up_and_are_what_they_say():
    kA, kB, a, b = 2e7, 5e7, 0.1, 0.3
    held = shaft(
        [support("A", a, kA), support("B", b, kB)],
        [shafts.Station("p", 0.0), shafts.Station("q", 0.2), shafts.Station("r", L)],
        shafts.COWPER,
    )
    rest = shafts.solve(system := shafts.assemble(held), shafts.nodal_forces(system, ()))
    found = shafts.flexibility(rest, [0.0, 0.2, L], (0.6, -0.8))
    assert found.names == ("bending", "shear", "A", "B")
    assert found.shares.sum(axis=0) == pytest.approx(found.delta, rel=1e-10)
    right = (np.array([0.0, 0.2, L]) - a) / (b - a)
    assert found.shares[2] == pytest.approx(np.outer(1 - right, 1 - right) / kA, abs=1e-18)
    assert found.shares[3] == pytest.approx(np.outer(right, right) / kB, abs=1e-18)
    assert found.reactions == pytest.approx(np.array([1 - right, right]), abs=1e-10)
    assert found.shares[0][0, 0] == pytest.approx(a**2 * (b - a + a) / (3 * E * I), rel=1e-9)
    assert found.shares[1][0, 0] == pytest.approx((a + (a / (b - a)) ** 2 * (b - a)) / (KAPPA * G * A), rel=1e-9)


def test_a_station_on_a_rigid_bearing_has_no_stiffness():
    held = shaft([support("A", 0.1), support("B", 0.3, 3e7)], [shafts.Station("p", 0.1), shafts.Station("q", 0.2)])
    rest = shafts.solve(system := shafts.assemble(held), shafts.nodal_forces(system, ()))
    found = shafts.flexibility(rest, [0.1, 0.2], (0, -1))
    with pytest.raises(shafts.stiffness.__globals__["InputError"], match="'p' stands on a rigid bearing"):
        shafts.stiffness(found.delta, ("p", "q"))


# -- vibration -----------------------------------------------------------------------------------------------------------------


def at_rest(one, elements=24):
    system = shafts.assemble(one, np.linspace(0.0, one.length, elements + 1))
    return shafts.solve(system, 0 * shafts.nodal_forces(system, ()))


def test_modes_of_a_simply_supported_beam():
    bending, axial = shafts.modes(at_rest(simple()), 3)
    wanted = [(n * np.pi) ** 2 / (2 * np.pi) * np.sqrt(E * I / (RHO * A * L**4)) for n in (1, 2, 3)]
    assert bending.frequencies == pytest.approx(wanted, rel=2e-5) and len(axial.frequencies) == 0


def test_shear_and_rotary_inertia_lower_the_modes_as_timoshenko_has_it():
    """Simply supported: r w^4 - b w^2 + c = 0 with the wave number n pi/L."""
    found, _ = shafts.modes(at_rest(simple(shafts.COWPER), 60), 3)
    for n, frequency in enumerate(found.frequencies, 1):
        k2 = (n * np.pi / L) ** 2
        quadratic = [RHO**2 * I / (KAPPA * G), -(RHO * A + RHO * I * k2 * (1 + E / (KAPPA * G))), E * I * k2**2]
        assert (2 * np.pi * frequency) ** 2 == pytest.approx(min(np.roots(quadratic).real), rel=1e-4)


def test_modes_of_a_stepped_shaft_converge_at_the_order_of_cubic_elements():
    sections = (shafts.Section(0.15, 0.02, 0.02), shafts.Section(0.25, 0.03, 0.03, 0.01))
    exact = shafts.modes(at_rest(simple(sections=sections), 64), 2)[0].frequencies[1]
    errors = [shafts.modes(at_rest(simple(sections=sections), n), 2)[0].frequencies[1] / exact - 1 for n in (8, 16)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.15)


def test_axial_mode_of_a_shaft_held_at_one_end():
    held = shaft([support("A", 0.0, axial=RIGID), shafts.Support("B", L, (3e9, 1e9, 0.0, 0.0, 0.0))])
    _, axial = shafts.modes(at_rest(held, 40), 8)
    assert axial.frequencies[0] == pytest.approx(np.sqrt(E / RHO) / (4 * L), rel=1e-3)


def test_torsional_modes_of_a_free_shaft_with_a_flywheel():
    assert shafts.torsional_modes(at_rest(simple(), 60), 2).frequencies == pytest.approx(
        np.sqrt(G / RHO) / (2 * L) * np.array([1, 2]), rel=2e-3
    )
    heavy = shaft([support("A", 0.0), support("B", L)], [shafts.Station("w", 0.0, polar=0.4), shafts.Station("v", L, polar=0.2)])
    stiff = G * 2 * I / L
    assert shafts.torsional_modes(at_rest(heavy), 1).frequencies[0] == pytest.approx(
        np.sqrt(stiff * (1 / 0.4 + 1 / 0.2)) / (2 * np.pi), rel=1e-4
    )


def test_critical_speeds_of_an_overhung_disc():
    """A heavy disc on a nearly massless overhang: det(1 - s^2 delta diag(m, I_d -+ I_p)) = 0, closed form."""
    m, polar, diametral = 6.0, 0.05, 0.03
    one = shaft([support("A", 0.0), support("B", 0.2)], [shafts.Station("disc", L, m, polar, diametral)], density=1e-3)
    a, span = L - 0.2, 0.2
    delta = np.array([[a**2 * (a + span) / 3, a * span / 3 + a**2 / 2], [a * span / 3 + a**2 / 2, span / 3 + a]]) / (E * I)
    found = shafts.critical_speeds(at_rest(one), 1)
    for speeds, inertia in ((found.forward, diametral - polar), (found.backward, diametral + polar)):
        squares = np.linalg.eigvals(delta @ np.diag([m, inertia])).real
        assert speeds[0] == pytest.approx(1 / np.sqrt(squares.max()), rel=1e-5)


def test_whirl_on_supports_that_are_nearly_round_is_the_same():
    """The route in space against the one in the plane."""
    station = shafts.Station("disc", L, 4.0, 0.05, 0.03)
    one = shaft([support("A", 0.0, 3e7), support("B", 0.3, 5e7)], [station], shafts.COWPER)
    two = shaft([support("A", 0.0, 3e7), shafts.Support("B", 0.3, (5e7, 5e7 * (1 + 1e-7), 0, 0, 0))], [station], shafts.COWPER)
    plane, space = (shafts.critical_speeds(at_rest(each, 12), 2) for each in (one, two))
    assert space.forward == pytest.approx(plane.forward, rel=1e-5) and space.backward == pytest.approx(plane.backward, rel=1e-5)
    assert plane.forward[0] > 1.01 * plane.backward[0]


def test_a_disc_without_polar_inertia_is_critical_at_its_natural_frequency():
    one = shaft([support("A", 0.0, 3e7), support("B", 0.3, 5e7)], [shafts.Station("disc", L, 4.0)])
    rest = at_rest(one)
    assert shafts.critical_speeds(rest, 2).forward == pytest.approx(2 * np.pi * shafts.modes(rest, 2)[0].frequencies, rel=1e-7)


def test_the_planes_are_one_and_the_same():
    assert PLANES[0][0] == 0 and PLANES[1][0] == 1
    one = shaft([support("A", 0.0, 3e7), shafts.Support("B", 0.3, (5e7, 5e7 * (1 + 1e-6), 0, 0, 0))], [shafts.Station("d", L, 4.0)])
    bending, _ = shafts.modes(at_rest(one), 4)
    assert bending.frequencies[0] == pytest.approx(bending.frequencies[1], rel=1e-5)
    assert bending.frequencies[2] == pytest.approx(bending.frequencies[3], rel=1e-5)
