"""Brown-Miller on critical planes: closed forms in uniaxial, torsional and biaxial strain, and a second route for everything else."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from drivewright import fatigue
from drivewright._jit import plain
from drivewright.fatigue import critical, planes
from drivewright.fatigue.bounds import search_grid, search_workspace

pytestmark = pytest.mark.analytical

E, NU, SF, B, EF, C = 206e9, 0.3, 1470e6, -0.087, 0.4604, -0.58
CARD = fatigue.StrainLife(
    youngs_modulus="206 GPa",
    poisson_ratio=NU,
    fatigue_strength="1470 MPa",
    fatigue_strength_exponent=B,
    fatigue_ductility=EF,
    fatigue_ductility_exponent=C,
)


def block(first, second, strain=None):
    """A block of two stress tensors, elastic unless the strain is given."""
    stress = np.array([np.asarray(first, float), np.asarray(second, float)])
    return (fatigue.elastic_strain(stress, CARD) if strain is None else strain), stress


def diagonal(x, y=0.0, z=0.0):
    return np.diag([x, y, z])


def shear(t):
    return np.array([[0, 0, t], [0, 0, 0], [t, 0, 0]], float)


def parameter(life, mean=0.0, card=CARD):
    """Right-hand side, written out once more."""
    c1, c2 = 1.5 + card.poisson_ratio / 2, 1.5 + card.plastic_poisson_ratio / 2
    return c1 * (SF - mean) / E * (2 * life) ** B + c2 * EF * (2 * life) ** C


def life_of(p, mean=0.0):
    if p <= 0:
        return np.inf
    return np.exp(brentq(lambda y: np.log(parameter(np.exp(y), mean) / p), -40, 200, xtol=1e-13))


@pytest.mark.parametrize(
    ("stress", "life", "digits"), [(162.03e6, 1.07e14, 3), (245.18e6, 7.7e11, 2), (303.13e6, 6.0e10, 2), (468.66e6, 2.9e8, 2)]
)
def test_repeated_uniaxial_stress(stress, life, digits):
    found = fatigue.brown_miller(*block(diagonal(0), diagonal(stress)), CARD)
    assert float(f"{found.life:.{digits - 1}e}") == life
    assert found.life == pytest.approx(life_of(1.65 * stress / 2 / E, stress / 4), rel=1e-10)
    assert abs(found.plane[0]) == pytest.approx(np.sqrt(0.5), rel=1e-12)
    assert found.cycles.mean_normal_stress == pytest.approx(stress / 4, rel=1e-12)


# --------------------------------------------------------------------------------------------------- plane of largest shear


@pytest.mark.parametrize("life", [3.0, 2e3, 5e5, 1e9])
def test_uniaxial_strain_with_yielding_is_coffin_manson(life):
    elastic, plastic = SF / E * (2 * life) ** B, EF * (2 * life) ** C
    across = -NU * elastic - 0.5 * plastic
    strain = diagonal(across, elastic + plastic, across)
    stress = diagonal(0, elastic * E, 0)
    found = fatigue.brown_miller(*block(stress, -stress, np.array([strain, -strain])), CARD)
    assert found.life == pytest.approx(life, rel=1e-11)
    assert fatigue.life_at_strain(elastic + plastic, CARD) == pytest.approx(life, rel=1e-11)


def test_other_poisson_ratios_have_other_factors():
    card = CARD.replace(poisson_ratio=0.24, plastic_poisson_ratio=0.44)
    elastic, plastic = SF / E * (2e4) ** B, EF * (2e4) ** C
    across = -0.24 * elastic - 0.44 * plastic
    strain = diagonal(elastic + plastic, across, across)
    stress = diagonal(elastic * E)
    assert fatigue.brown_miller(np.array([strain, -strain]), np.array([stress, -stress]), card).life == pytest.approx(1e4, rel=1e-11)


@pytest.mark.parametrize(("plane", "factor"), [("max-shear", 1.0), ("max-damage", np.sqrt(1.25))])
def test_torsion(plane, factor):
    g = parameter(4e6) / factor  # engineering shear amplitude
    t = g * E / (2 * (1 + NU))
    found = fatigue.brown_miller(*block(shear(t), shear(-t)), CARD, plane)
    assert found.life == pytest.approx(4e6, rel=1e-9)
    cycle = found.cycles
    assert (cycle.shear_amplitude + cycle.normal_strain_amplitude) == pytest.approx(factor * g, rel=1e-10)
    if plane == "max-shear":
        assert cycle.normal_strain_amplitude == pytest.approx(0, abs=1e-15) and cycle.shear_amplitude == pytest.approx(g, rel=1e-12)


@pytest.mark.parametrize(("plane", "factor"), [("max-shear", 13 / 7), ("max-damage", 1 / 14 + np.sqrt(5) * 13 / 14)])
def test_equibiaxial_stress(plane, factor):
    # Strains e, e, -6/7 e: middle 1/14 e and radius 13/14 e of the circle; on the 45 deg plane shear 13/7 e, normal strain 1/14 e.
    factor = factor + 1 / 14 if plane == "max-shear" else factor
    assert factor == pytest.approx({"max-shear": 1.9286, "max-damage": 2.1478}[plane], abs=5e-5)
    s = parameter(7e4) / factor * E / (1 - NU)
    assert fatigue.brown_miller(*block(diagonal(s, s), diagonal(-s, -s)), CARD, plane).life == pytest.approx(7e4, rel=1e-9)


@pytest.mark.parametrize("strain", [(1.0, -0.3, -0.3), (1.0, 0.4, -0.7), (-0.2, -0.9, 0.1), (0.8, 0.5, 0.3)])
def test_any_reversed_strain_has_a_closed_form(strain):
    # For a given normal strain the largest shear lies on the outer circle: max of 2 r sin 2a + |m + r cos 2a| = |m| + sqrt(5) r.
    top, bottom = max(strain), min(strain)
    m, r = (top + bottom) / 2, (top - bottom) / 2
    scale = parameter(3e5) / (abs(m) + np.sqrt(5) * r)
    e = scale * diagonal(*strain)
    free = np.zeros((3, 3))
    assert fatigue.brown_miller(*block(free, free, np.array([e, -e])), CARD, "max-damage").life == pytest.approx(3e5, rel=1e-9)
    shares = parameter(3e5) / (abs(m) + 2 * r) * diagonal(*strain)
    assert fatigue.brown_miller(*block(free, free, np.array([shares, -shares])), CARD).life == pytest.approx(3e5, rel=1e-10)


def test_uniaxial_factor_of_the_most_damaged_plane():
    stress = parameter(1e6) / 1.8034441853748634 * E
    assert fatigue.brown_miller(*block(diagonal(stress), diagonal(-stress)), CARD, "max-damage").life == pytest.approx(1e6, rel=1e-9)


def test_repeated_stress_on_the_most_damaged_plane_against_one_angle():
    # With a mean the most damaged plane leans to where the normal stress is high; about the axis all planes are alike.
    s = 600e6

    def life(a):
        amplitude = s / 2 / E * (1.3 * np.sin(2 * a) + 0.35 + 0.65 * np.cos(2 * a))
        return life_of(amplitude, s / 2 * np.cos(a) ** 2)

    best = minimize_scalar(life, bounds=(0.2, 0.8), method="bounded", options={"xatol": 1e-9})
    found = fatigue.brown_miller(*block(diagonal(0, 0, s), diagonal(0)), CARD, "max-damage")
    assert found.life == pytest.approx(best.fun, rel=1e-9)
    assert abs(found.plane[2]) == pytest.approx(np.cos(best.x), abs=1e-4)


def test_miner_adds_the_cycles_of_a_block():
    # Ranges 9, 7, 4, 3 of the standard's example, means 0.5, 0.5, 1, -0.5.
    levels = 60e6 * np.array([-2, 1, -3, 5, -1, 3, -4, 4])
    stress = levels[:, None, None] * diagonal(0, 1, 0)
    found = fatigue.brown_miller(fatigue.elastic_strain(stress, CARD), stress, CARD)
    by_hand = sum(1 / life_of(1.65 * 60e6 * size / 2 / E, 60e6 * mean / 2) for size, mean in ((9, 0.5), (7, 0.5), (4, 1), (3, -0.5)))
    assert found.damage == pytest.approx(by_hand, rel=1e-10) and found.life == pytest.approx(1 / by_hand, rel=1e-10)
    assert sum(found.cycles.damage) == pytest.approx(found.damage, rel=1e-13)
    order = np.argsort(-found.cycles.shear_amplitude)
    assert found.cycles.shear_amplitude[order] == pytest.approx(1.3 * 60e6 / E / 2 * np.array([9, 7, 4, 3]), rel=1e-12)
    assert {*zip(found.cycles.start, found.cycles.end, strict=True)} == {(3, 6), (7, 2), (4, 5), (0, 1)}


# ------------------------------------------------------------------------------------------------------------ second route


def turning(seed, samples=24, harmonics=2):
    """A block whose principal axes turn."""
    rng = np.random.default_rng(seed)
    t = 2 * np.pi * np.arange(samples) / samples
    stress = np.broadcast_to(rng.normal(size=(3, 3)), (samples, 3, 3))
    for order in range(1, harmonics + 1):
        a, b = rng.normal(size=(2, 3, 3)) / order
        stress = stress + np.cos(order * t)[:, None, None] * a + np.sin(order * t)[:, None, None] * b
    stress = 150e6 * (stress + stress.transpose(0, 2, 1)) / 2
    return fatigue.elastic_strain(stress, CARD), stress


def second_route(strain, stress, normal, direction):
    """Damage on a plane: the smallest loop of the ring of samples is taken out first; a loop lasts until it is back at its level."""
    g = 2 * np.einsum("i,tij,j->t", direction, strain, normal)
    top = int(np.argmax(np.abs(g)))
    ring = [(top + k) % len(g) for k in range(len(g) + 1)]
    g, e, s = g[ring], np.einsum("i,tij,j->t", normal, strain, normal)[ring], np.einsum("i,tij,j->t", normal, stress, normal)[ring]
    points = [0, *(k for k in range(1, len(g) - 1) if (g[k] - g[k - 1]) * (g[k + 1] - g[k]) < 0), len(g) - 1]
    damage = 0.0
    while len(points) > 1:
        sizes = np.abs(np.diff(g[points]))
        k = int(np.argmin(sizes))
        # The first of the pair is where a loop begins unless that is the very beginning of the ring; at the end one big loop is left.
        if len(points) == 3:
            k = 0
        a, b = points[k], points[k + 1]
        back = np.abs(g - g[b])
        after = next(j for j in range(b + 1, len(g)) if back[j] >= abs(g[a] - g[b]) * (1 - 1e-14))
        part = min((abs(g[a] - g[b]) - back[after - 1]) / (back[after] - back[after - 1]), 1)
        ends = [x[after - 1] + part * (x[after] - x[after - 1]) for x in (e, s)]
        over_e, over_s = [*e[a:after], ends[0]], [*s[a:after], ends[1]]
        damage += 1 / life_of(abs(g[a] - g[b]) / 2 + (max(over_e) - min(over_e)) / 2, (max(over_s) + min(over_s)) / 2)
        del points[k : k + 2]
    return damage


def frames(seed, count):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        yield np.linalg.qr(rng.normal(size=(3, 3)))[0][:2]


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_damage_on_a_plane_by_the_second_route(seed):
    strain, stress = turning(seed, harmonics=4)
    counts = set()
    for normal, direction in frames(seed, 12):
        table = planes.cycle_table(planes.pack_block(strain, stress), critical.brown_miller_curve(CARD), normal, direction)
        counts.add(len(table))
        assert table[:, 3].sum() == pytest.approx(second_route(strain, stress, normal, direction), rel=1e-9)
    assert max(counts) > 2


@pytest.mark.parametrize("seed", [4, 5, 6, 7])
def test_the_largest_shear_of_all_pairs_of_instants(seed):
    strain, stress = turning(seed)
    found = fatigue.brown_miller(strain, stress, CARD)
    pairs = np.linalg.eigvalsh(strain[:, None] - strain[None])
    assert 2 * np.max(found.cycles.shear_amplitude) == pytest.approx(np.max(pairs[..., 2] - pairs[..., 0]), rel=1e-12)
    both = [second_route(strain, stress, *frame) for frame in ((found.plane, found.direction), (found.direction, found.plane))]
    assert found.damage == pytest.approx(max(both), rel=1e-9) and min(both) < 0.999 * max(both)


@pytest.mark.parametrize("samples", [[0, 1, 2], [1, 0, 2]])
def test_of_a_cone_of_tied_planes_the_most_damaged(samples):
    # Two samples of reversed uniaxial stress, which all planes at 45 deg to z share, and a third that tells these planes apart.
    stress = 1e6 * np.array([diagonal(0, 0, 500), diagonal(0, 0, -500), [[600, 60, 20], [60, 300, 30], [20, 30, 350]]])[samples]
    strain = fatigue.elastic_strain(stress, CARD)
    found = fatigue.brown_miller(strain, stress, CARD)

    def damage(a):
        around = np.array([np.cos(a), np.sin(a), 0])
        return second_route(strain, stress, (around + [0, 0, 1]) / np.sqrt(2), (around - [0, 0, 1]) / np.sqrt(2))

    at = max(np.linspace(0, 2 * np.pi, 73), key=damage)
    best = minimize_scalar(lambda a: -damage(a), bounds=(at - 0.1, at + 0.1), method="bounded", options={"xatol": 1e-9})
    assert damage(at + 1.5) < 0.99 * damage(at)
    assert found.damage == pytest.approx(-best.fun, rel=1e-8) and abs(found.plane[2]) == pytest.approx(np.sqrt(0.5), rel=1e-12)


@pytest.mark.parametrize("seed", [4, 5])
def test_no_plane_is_sheared_or_damaged_more(seed):
    strain, stress = turning(seed)
    most_shear, most_damage = (fatigue.brown_miller(strain, stress, CARD, plane) for plane in ("max-shear", "max-damage"))
    assert second_route(strain, stress, most_damage.plane, most_damage.direction) == pytest.approx(most_damage.damage, rel=1e-9)
    assert most_damage.damage >= most_shear.damage
    for normal, direction in frames(seed, 200):
        table = planes.cycle_table(planes.pack_block(strain, stress), critical.brown_miller_curve(CARD), normal, direction)
        assert table[:, 3].sum() < most_damage.damage and np.max(table[:, 0]) < np.max(most_shear.cycles.shear_amplitude)


def test_out_of_phase_by_hand():
    # Shear a quarter behind tension: the normal strain of a plane is greatest between the shear's turning points.
    t = 2 * np.pi * np.arange(360) / 360
    strain = np.zeros((360, 3, 3))
    strain[:, 0, 1] = strain[:, 1, 0] = 2e-3 * np.sin(t)
    strain[:, 1, 1] = 1e-3 * np.cos(t)
    table = planes.cycle_table(
        planes.pack_block(strain, 0 * strain), critical.brown_miller_curve(CARD), np.array([0.0, 1, 0]), np.array([1.0, 0, 0])
    )
    assert table[:, :3] == pytest.approx(np.array([[4e-3, 1e-3, 0.0]]), rel=1e-12)


def test_kernels_run_uncompiled():
    strain, stress = turning(6, samples=9)
    curve, grid, work = critical.brown_miller_curve(CARD), search_grid(6, 2), planes.plane_workspace(9)
    for kernel, more in ((critical._max_shear_planes, (work,)), (critical._max_damage_planes, (grid, work, search_workspace(grid)))):
        with np.errstate(divide="ignore", invalid="ignore"):
            damage, _ = plain(kernel)(strain[None], stress[None], curve, *more)
        assert damage == pytest.approx(kernel(strain[None], stress[None], curve, *more)[0], rel=1e-9)
