"""Impact laws against integrated impacts, the elastic laws of a bearing with play against Hertz."""

from decimal import Decimal, localcontext
from types import SimpleNamespace

import numpy as np
import pytest

from drivewright import plugins
from drivewright._jit import plain
from drivewright.contact import hertz, impact
from drivewright.errors import InputError, UnknownName
from drivewright.numerics.ode import Event, Functions, integrate

pytestmark = pytest.mark.analytical

BUILT_IN = ["elastic", "flores-2011", "gonthier", "herbert-mcwhannell", "hunt-crossley", "lankarani-nikravesh"]
BEARING = (0.5e-3, 10e-3, 9.5e-3, 1.1e11, 0.018)  # clearance, radii, E*, length


def bounce(force, mass, speed, time):
    """Coefficient of restitution of a free impact, by integration of m d'' = -max(F(d, d'), 0)."""
    system = Functions(
        lambda t, y: np.array([y[1], -max(force(max(y[0], 0.0), y[1]), 0.0) / mass]), lambda t, y: np.array([1.0 if y[1] > 0 else y[0]])
    )
    run = integrate(system, 0, time, [0.0, speed], 1e-10, [1e-15, 1e-11], watch=[Event(-1, terminal=True)], max_step=time / 100)
    assert run.outcome == "event"
    return -run.y_end[1] / speed


# ------------------------------------------------------------------------------------------------------------ the laws


@pytest.mark.parametrize(
    "name, delivered",
    [
        ("lankarani-nikravesh", (0.9132, 0.7960, 0.7252, 0.6653)),
        ("hunt-crossley", (0.9090, 0.7680, 0.6630, 0.5158)),
        ("flores-2011", (0.8939, 0.6832, 0.4704, 0.0694)),
    ],
)
def test_delivered_restitution_of_the_laws(name, delivered):
    law = impact.impact_law(name)
    assert [impact.delivered_restitution(law.factor(e)) for e in (0.9, 0.7, 0.5, 0.1)] == pytest.approx(delivered, abs=5.1e-5)


def test_herbert_mcwhannell_by_hand():
    factor = impact.impact_law("herbert-mcwhannell").factor
    assert [factor(e) for e in (0.5, 0.9, 1.0)] == pytest.approx([1.0, 0.6 / 3.64, 0.0], rel=1e-14)


@pytest.mark.parametrize("e", [1e-3, 0.05, 0.3, 0.8, 0.999, 0.99995, 1.0])
def test_gonthier_delivers_exactly_what_is_asked(e):
    assert impact.delivered_restitution(impact.impact_law("gonthier").factor(e)) == pytest.approx(e, rel=2e-11)


def test_elastic_loses_nothing():
    assert impact.impact_law("elastic").factor(0.3) == 0.0 and impact.delivered_restitution(0.0) == 1.0


@pytest.mark.parametrize("h, mass, exponent", [(0.17, 0.3, 1.5), (1.6, 2.0, 1.5), (1.6, 0.4, 1.0), (9.0, 0.3, 2.2)])
def test_delivered_restitution_by_integration(h, mass, exponent):
    stiffness, speed = 3e9, 0.7
    depth = (0.5 * (exponent + 1) * mass * speed**2 / stiffness) ** (1 / (exponent + 1))
    e = bounce(lambda d, v: stiffness * d**exponent * (1 + h * v / speed), mass, speed, 30 * (1 + h) * depth / speed)
    assert impact.delivered_restitution(h) == pytest.approx(e, rel=1e-6)


def test_the_cylinder_law_delivers_the_same():
    mass, speed, h = 0.4, 0.5, 0.9
    force = plain(impact.cylinder_force)
    e = bounce(lambda d, v: force(d, *BEARING) * (1 + h * v / speed), mass, speed, 4e-4)
    assert impact.delivered_restitution(h) == pytest.approx(e, rel=1e-6)


@pytest.mark.parametrize("h", [2e-4, 0.999e-3, 1.001e-3, 9.9e-3, 0.02, 0.7, 6.0])
def test_delivered_restitution_solves_its_equation(h):
    e = impact.delivered_restitution(h)
    with localcontext(prec=50):
        H, E = Decimal(h), Decimal(e)
        residual = H * (1 + E) - ((1 + H) / (1 - H * E)).ln()
        error = residual / (H * H * E / (1 - H * E))  # over the slope
    assert abs(float(error) / e) < 1e-12


@pytest.mark.parametrize("name", BUILT_IN)
def test_reliable_is_where_ten_percent_begin(name):
    law = impact.impact_law(name)
    error = lambda e: abs(impact.delivered_restitution(law.factor(e)) / e - 1)  # noqa: E731
    assert max(error(e) for e in np.linspace(max(law.reliable, 1e-3), 1, 300)) <= 0.1
    assert name == "gonthier" or error(law.reliable - 2e-3) > 0.1


def test_the_names_and_an_unknown_one():
    assert impact.impact_law_names() == BUILT_IN
    assert [impact.impact_law(name).name for name in BUILT_IN] == BUILT_IN
    with pytest.raises(UnknownName, match=r"no impact law is called 'flores' \(did you mean 'flores-2011'\?\); known: elastic, "):
        impact.impact_law("flores")


def test_a_law_of_another_package(monkeypatch):
    theirs = impact.ImpactLaw("half", lambda e: 1 - e, 0.8, "a test")
    points = {"half": SimpleNamespace(load=lambda: theirs), "broken": SimpleNamespace(load=lambda: 3.0)}
    monkeypatch.setattr(plugins, "installed", lambda group: points if group == "drivewright.impact_laws" else {})
    assert "half" in impact.impact_law_names() and impact.impact_law("half") is theirs
    with pytest.raises(InputError, match="impact law 'broken': its entry point gives a float; it must name an ImpactLaw"):
        impact.impact_law("broken")


@pytest.mark.parametrize("name", [*BUILT_IN, "kelvin-voigt"])
@pytest.mark.parametrize("e", [0.0, -0.5, 1.01, np.nan])
def test_impossible_restitution(name, e):
    with pytest.raises(InputError, match=rf"restitution must lie in \(0, 1\], got {e:g} for '{name}'"):
        impact.kelvin_voigt_damping(e, 1.0, 1.0) if name == "kelvin-voigt" else impact.impact_law(name).factor(e)


def test_a_factor_that_gains_energy_is_refused():
    with pytest.raises(InputError, match="got -0.1; below 0 an impact would gain energy"):
        impact.delivered_restitution(-0.1)


# -------------------------------------------------------------------------------------------------------- Kelvin-Voigt


@pytest.mark.parametrize("e", [0.9, 0.5, 0.1])
def test_kelvin_voigt_delivers_under_the_clipped_force(e):
    stiffness, mass, speed = 4e6, 0.7, 1.3
    damping = impact.kelvin_voigt_damping(e, stiffness, mass)
    delivered = bounce(lambda d, v: stiffness * d + damping * v if d > 0 or v > 0 else 0.0, mass, speed, 0.1)
    assert delivered == pytest.approx(e, rel=1e-6)
    textbook = -2 * np.log(e) * np.sqrt(stiffness * mass / (np.pi**2 + np.log(e) ** 2))
    assert impact.kelvin_voigt_restitution(textbook, stiffness, mass) == pytest.approx({0.9: 0.902, 0.5: 0.550, 0.1: 0.253}[e], abs=5e-4)


@pytest.mark.parametrize("e", [1e-6, 0.02, np.exp(-2), 0.4, 0.9999999, 1.0])
def test_kelvin_voigt_there_and_back(e):
    damping = impact.kelvin_voigt_damping(e, 5e5, 2.0)
    assert impact.kelvin_voigt_restitution(damping, 5e5, 2.0) == pytest.approx(e, rel=1e-12)
    assert damping == impact.kelvin_voigt_damping(e, 5e5 * 9, 2.0) / 3 or damping == pytest.approx(
        impact.kelvin_voigt_damping(e, 5e5 * 9, 2.0) / 3, rel=1e-13
    )


def test_kelvin_voigt_at_critical_damping_is_smooth():
    near = [impact.kelvin_voigt_restitution(2 * z, 1.0, 1.0) for z in (1 - 2e-6, 1 - 5e-7, 1 + 5e-7, 1 + 2e-6)]
    np.testing.assert_allclose(near, np.exp(-2 - 4 / 3 * np.array([-2e-6, -5e-7, 5e-7, 2e-6])), rtol=1e-9)


def test_kelvin_voigt_refuses_a_body_without_mass():
    with pytest.raises(InputError, match="kelvin-voigt needs stiffness and mass above 0, got 1 N/m and 0 kg"):
        impact.kelvin_voigt_damping(0.5, 1.0, 0.0)


# ------------------------------------------------------------------------------------------------------ lasting contact


@pytest.mark.parametrize("h", [5e-4, 0.17, 1.6, 14.4, 300.0])
@pytest.mark.parametrize("exponent, mass", [(1.0, 0.3), (1.5, 2.0), (2.2, 0.1)])
def test_the_lasting_factor_delivers_the_restitution_of_the_impact(h, exponent, mass):
    """F = F_el (1 + h_w d'/w) integrated over a free impact, without a pull; the body leaves where the force is gone."""
    stiffness, speed, factor = 3e9, 0.7, impact.lasting_factor(h)

    def force(d, v):
        elastic = stiffness * d**exponent
        w = np.sqrt(2 * elastic * d / ((exponent + 1) * mass))
        return elastic * (1 + factor * v / w) if d > 0 else 0.0

    depth = (0.5 * (exponent + 1) * mass * speed**2 / stiffness) ** (1 / (exponent + 1))
    e = bounce(force, mass, speed, 30 * (1 + factor) ** 2 * depth / speed)
    assert impact.delivered_restitution(h) == pytest.approx(e, rel=2e-5)


def test_the_lasting_factor_of_small_and_of_no_loss():
    """h -> 0: e = 1 - 2 h/3 and h_w = 2 (1 - e)/pi."""
    assert impact.lasting_factor(0.0) == 0.0
    assert impact.lasting_factor(1e-5) == pytest.approx(4e-5 / (3 * np.pi), rel=1e-4)
    assert np.all(np.diff([impact.lasting_factor(h) for h in np.geomspace(1e-6, 1e3, 60)]) > 0)


@pytest.mark.parametrize("depth", [1e-8, 1e-6, 2e-5, 1.7e-4, 3e-4])
def test_the_energy_of_the_cylinder_law_is_its_work(depth):
    ends = np.linspace(0, depth**0.25, 4001) ** 4
    forces = np.array([plain(impact.cylinder_force)(d, *BEARING) for d in ends])
    work = np.sum(0.5 * (forces[1:] + forces[:-1]) * np.diff(ends))
    assert plain(impact.cylinder_energy)(depth, forces[-1], *BEARING) == pytest.approx(work, rel=2e-6)
    assert plain(impact.cylinder_energy)(0.0, 0.0, *BEARING) == 0.0


# ------------------------------------------------------------------------------------------------------- elastic force


def test_journal_stiffness():
    modulus = hertz.effective_modulus(207e9, 0.3, 207e9, 0.3)
    assert impact.journal_stiffness(10e-3, 9.5e-3, modulus) == pytest.approx(6.6102e10, rel=1e-5)
    radius = hertz.effective_radius(0.0311, -0.0317)
    assert impact.journal_stiffness(0.0317, 0.0311, modulus) == pytest.approx(hertz.point_constant((radius, radius), modulus), rel=1e-12)
    with pytest.raises(InputError, match="the journal's radius 0.01 m must be below the bearing's 0.01 m"):
        impact.journal_stiffness(0.01, 0.01, modulus)


def test_cylinder_depth_is_the_sum_of_both_compressions():
    bearing, journal, length, force = 0.0104, 0.0099, 0.018, np.array([3.0, 400.0, 9e3])
    modulus = hertz.effective_modulus(207e9, 0.3, 207e9, 0.3)
    half_width = hertz.line_contact(force, length, hertz.effective_radius(journal, -bearing), modulus).half_width
    both = sum(hertz.cylinder_compression(force, length, half_width, radius, 207e9, 0.3) for radius in (bearing, journal))
    np.testing.assert_allclose(impact.cylinder_depth(force, bearing - journal, bearing, journal, modulus, length), both, rtol=1e-12)


def test_cylinder_force_inverts_the_depth_and_grows():
    depth = np.concatenate([np.geomspace(1e-18, 1.2e-3, 300), [9.3e-5, 9.4e-5]])
    depth.sort()
    force = np.array([impact.cylinder_force(d, *BEARING) for d in depth])
    np.testing.assert_allclose(impact.cylinder_depth(force, *BEARING), depth, rtol=2e-11)
    assert np.all(np.diff(force) > 0)
    assert [impact.cylinder_force(d, *BEARING) for d in (0.0, -1e-6)] == [0.0, 0.0] and impact.cylinder_depth(0.0, *BEARING) == 0.0


def test_beyond_hertz_the_force_goes_on_straight_without_a_kink():
    clearance, bearing, journal, modulus, length = BEARING
    end = impact.cylinder_depth(np.pi * modulus * length * clearance * journal / (16 * bearing), *BEARING)
    radius = hertz.effective_radius(journal, -bearing)
    half_width = hertz.line_contact(impact.cylinder_force(end, *BEARING), length, radius, modulus).half_width
    assert half_width == pytest.approx(journal / 2, rel=1e-9)
    force = [impact.cylinder_force(end + step, *BEARING) for step in (-2e-8, -1e-8, 0.0, 1e-8, 3e-4, 6e-4)]
    slopes = np.diff(force) / np.array([1e-8, 1e-8, 1e-8, 3e-4 - 1e-8, 3e-4])
    assert slopes[1] == pytest.approx(slopes[2], rel=3e-4) and slopes[0] < slopes[1]
    np.testing.assert_allclose(slopes[2:], slopes[2], rtol=1e-6)


def test_cylinder_force_in_other_units_and_in_plain_python():
    clearance, bearing, journal, modulus, length = BEARING
    for depth in (3e-7, 2e-5, 3e-4):
        newton = impact.cylinder_force(depth, *BEARING)
        millimetres = impact.cylinder_force(depth * 1e3, clearance * 1e3, bearing * 1e3, journal * 1e3, modulus * 1e-6, length * 1e3)
        assert millimetres == pytest.approx(newton, rel=1e-12)
        assert plain(impact.cylinder_force)(depth, *BEARING) == pytest.approx(newton, rel=1e-13)
