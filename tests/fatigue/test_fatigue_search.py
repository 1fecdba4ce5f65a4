"""The search for the most damaged plane: what bounds rule out, what a tangent of the damage is, and where its top lies."""

from collections.abc import Iterator

import numpy as np
import pytest
from scipy.optimize import minimize

from drivewright import fatigue
from drivewright._jit import kernel
from drivewright.fatigue import bounds, climbing, critical, planes

pytestmark = pytest.mark.analytical

CARD = fatigue.uniform_material_law("980 MPa", "206 GPa")
CURVE = critical.brown_miller_curve(CARD)
GRID, MIRRORED = bounds.search_grid(), bounds.mirrored_grid()


def block(seed, harmonics, samples=30, size=150e6, mean=1.0):
    """A `Block` of a stress whose principal axes turn."""
    rng = np.random.default_rng(seed)
    t = 2 * np.pi * np.arange(samples) / samples
    stress = np.broadcast_to(mean * rng.normal(size=(3, 3)), (samples, 3, 3))
    for order in range(1, harmonics + 1):
        a, b = rng.normal(size=(2, 3, 3)) / order
        stress = stress + np.cos(order * t)[:, None, None] * a + np.sin(order * t)[:, None, None] * b
    stress = 0.5 * size * (stress + stress.transpose(0, 2, 1))
    return planes.pack_block(fatigue.elastic_strain(stress, CARD), stress)


def proportional(seed, mean=0.5, samples=30):
    """A `Block` of one stress tensor times a wave with a smaller one on it."""
    t = 2 * np.pi * np.arange(samples) / samples
    tensor = np.random.default_rng(seed).normal(size=(3, 3))
    stress = 200e6 * (np.sin(t) + 0.6 * np.sin(3 * t) + mean)[:, None, None] * (tensor + tensor.T) / 2
    return planes.pack_block(fatigue.elastic_strain(stress, CARD), stress)


def frames(seed: int, count: int) -> Iterator[tuple[planes.Vector, planes.Vector]]:
    """Random pairs of a normal and a direction."""
    for matrix in np.random.default_rng(seed).normal(size=(count, 3, 3)):
        normal, direction = np.linalg.qr(matrix)[0][:2].tolist()
        yield tuple(normal), tuple(direction)


@kernel
def damage_on(block, curve, normal, direction, work):
    return planes.plane_damage(block, curve, normal, direction, work)


@kernel
def measured(block, grid, work, search):
    return bounds.measure_shears(block, grid, work, search)


@kernel
def ruled_out(block, curve, grid, damage, work, search):
    bounds.measure_shears(block, grid, work, search)
    bounds.rule_out(block, curve, grid, damage, work, search)


@kernel
def rests(block, grid, factor, work, search):
    return bounds._measure_rests(block, grid, factor, work, search)


@kernel
def tangent_at(block, curve, normal, direction, work, t):
    return climbing.tangent(block, curve, normal, direction, work, t)


@kernel
def turned(normal, direction, angles):
    return climbing.turn_frame(normal, direction, angles[0], angles[1], angles[2])


@kernel
def step_to_top(t, normal, direction, farthest):
    return climbing.newton_step(t, normal, direction, farthest)


@kernel
def around(value, middle, amplitude, reach):
    return bounds.greatest_around(value, bounds.Family(middle, amplitude), reach)


@kernel
def family(most, opposite, reach):
    return bounds._family(most, opposite, reach)


@kernel
def limit(curve, shares, travel, rest, whole):
    return bounds.damage_limit(curve, shares, travel, rest, whole)


def damage(history, frame):
    return damage_on(history, CURVE, frame[0], frame[1], planes.plane_workspace(history.strain.shape[1]))


def full(t):
    """The tensor (..., 3, 3) of six numbers (6, ...)."""
    return np.moveaxis(np.array([[t[0], t[5], t[4]], [t[5], t[1], t[3]], [t[4], t[3], t[2]]]), (0, 1), (-2, -1))


# ------------------------------------------------------------------------------------------------------------- bounds


@pytest.mark.parametrize("grid", [GRID, MIRRORED], ids=["all", "mirrored"])
def test_no_direction_is_farther_from_the_normals_than_the_reach(grid):
    points = np.random.default_rng(1).normal(size=(40_000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    cosines = np.abs(points @ grid.normals.T)
    if grid.mirrored:
        cosines = np.maximum(cosines, np.abs(points * (1, 1, -1) @ grid.normals.T))
    farthest = np.arccos(np.max(cosines, axis=1)).max()
    assert 0.95 * grid.reach < farthest <= grid.reach < 0.25


@pytest.mark.parametrize("seed", range(3))
def test_the_greatest_shear_and_variation_of_a_normal_stay_below_their_bound(seed):
    history = block(seed, 3, samples=27)
    search, work = bounds.search_workspace(GRID), planes.plane_workspace(27)
    best = measured(history, GRID, work, search)
    shear = 2 * np.einsum("mi,tij,mdj->mdt", GRID.normals, full(history.strain), GRID.directions)
    ranges, travels = np.ptp(shear, axis=2), np.abs(np.diff(shear, axis=2, append=shear[..., :1])).sum(axis=2)
    between = 1 / np.cos(np.pi / 16)
    assert search.shear == pytest.approx(between * ranges.max(axis=1), rel=1e-12)
    assert search.variation == pytest.approx(between * travels.max(axis=1), rel=1e-12)
    opening = np.ptp(np.einsum("mi,tij,mj->mt", GRID.normals, full(history.strain), GRID.normals), axis=1)
    assert best == np.argmax(ranges + opening[:, None])


def test_a_single_tensor_goes_to_its_bound():
    # Shear of pure torsion cos 2a over an angle a, its greatest value 1 and its least -1: the bound is the function itself.
    for angle in np.linspace(0, 1.5, 7):
        assert around(np.cos(2 * angle), 0.0, 1.0, 0.2) == pytest.approx(np.cos(2 * max(angle - 0.2, 0)), abs=1e-12)
    middle, amplitude = family(1 + 2 * np.cos(0.4), -1 + 2 * np.cos(0.4), 0.2)  # 1 + 2 cos 2a seen up to 0.2 from its top and bottom
    assert (middle, amplitude) == pytest.approx((1.0, 2.0), rel=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_greatest_values_around_a_normal_stay_below_their_bound(seed):
    history, reach = block(seed, 2), GRID.reach
    strain, rng = full(history.strain), np.random.default_rng(seed)

    def opening(n):
        values = np.einsum("i,tij,j->t", n, strain, n)
        return values.max(), -values.min()

    most, opposite = np.array([opening(n) for n in GRID.normals]).max(axis=0)
    middle, amplitude = family(most, opposite, reach)
    values = np.linalg.eigvalsh(strain)
    assert middle + amplitude >= values.max() and amplitude - middle >= -values.min()
    for n in rng.normal(size=(300, 3)):
        n /= np.linalg.norm(n)
        side = np.cross(n, rng.normal(size=3))
        turn = rng.uniform(0, reach)
        there = np.cos(turn) * n + np.sin(turn) * side / np.linalg.norm(side)
        assert opening(there)[0] <= around(opening(n)[0], middle, amplitude, turn) * (1 + 1e-12)


@pytest.mark.parametrize("mean", [-2.0, 0.0, 2.0])
def test_what_a_cycle_has_besides_its_shear_stays_below_its_bound(mean):
    history, factor, above = block(9, 3, mean=mean), 1e-12, []
    search, work = bounds.search_workspace(GRID), planes.plane_workspace(30)
    least, most = rests(history, GRID, factor, work, search)
    tension = np.einsum("mi,tij,mj->mt", GRID.normals, full(history.stress), GRID.normals)
    assert (least, most) == pytest.approx((tension.min(), tension.max()), rel=1e-12)
    for i in range(0, len(GRID.normals), 3):
        for direction in GRID.directions[i]:
            for _, opening, stress, *_ in planes.cycle_table(history, CURVE, GRID.normals[i], direction):
                above.append(search.rest[i] - opening - factor * max(stress, 0.0))
                assert search.opposite[i] - opening + factor * min(stress, 0.0) > -1e-12
    assert -1e-12 < min(above) < 1e-9  # and it is reached, where a cycle is the whole block


def test_the_most_damage_of_cycles_that_share_a_travel():
    # One cycle of the whole range, and none of it left; twice the travel is two of them, as its chord is straight.
    one = limit(CURVE, 0.0, 4 * 2e-3, 1e-3, 3e-3)
    assert one == pytest.approx(1 / fatigue_life(3e-3) - 1 / fatigue_life(1e-3), rel=1e-9)
    assert limit(CURVE, 5.0, 8 * 2e-3, 1e-3, 3e-3) == pytest.approx(2 * one + 5 / fatigue_life(1e-3), rel=1e-9)
    assert limit(CURVE, 5.0, 8 * 2e-3, 1e-3, 1e-3) == np.inf


def fatigue_life(parameter):
    """Life at a parameter without mean stress, by bisection."""
    low, high = -40.0, 300.0
    for _ in range(200):
        y = 0.5 * (low + high)
        side = CURVE.elastic * CURVE.strength * np.exp(CURVE.b * (y + np.log(2))) + CURVE.plastic * np.exp(CURVE.c * (y + np.log(2)))
        low, high = (y, high) if side > parameter else (low, y)
    return np.exp(0.5 * (low + high))


@pytest.mark.parametrize(
    "history",
    [
        *(proportional(seed, mean) for seed, mean in ((1, 0.5), (2, -1.0), (3, 3.0))),
        *(block(seed, 1, size=120e6) for seed in (4, 5)),
        block(6, 3),
    ],
)
def test_no_plane_around_a_normal_that_is_ruled_out_wins(history):
    search, work = bounds.search_workspace(GRID), planes.plane_workspace(history.strain.shape[1])
    strain, stress = full(history.strain), full(history.stress)
    won = fatigue.brown_miller(strain, stress, CARD, "max-damage").damage
    for share in (1.0, 0.3):
        ruled_out(history, CURVE, GRID, share * won, work, search)
        out = np.flatnonzero(np.isnan(search.shear))
        for normal, direction in frames(7, 3000):
            if np.any(np.abs(GRID.normals[out] @ normal) > np.cos(GRID.reach)):
                assert damage(history, (normal, direction)) < share * won


@pytest.mark.parametrize("seed", range(3))
def test_planes_of_a_simple_block_are_ruled_out(seed):
    history = proportional(seed, 0.0)
    won = fatigue.brown_miller(full(history.strain), full(history.stress), CARD, "max-damage").damage
    search = bounds.search_workspace(GRID)
    ruled_out(history, CURVE, GRID, won, planes.plane_workspace(30), search)
    assert np.mean(np.isnan(search.shear)) > 0.1


def test_nothing_is_ruled_out_where_the_mean_stress_can_reach_the_strength():
    history = proportional(1)
    pulled = history._replace(stress=history.stress + 0.9 * CARD.fatigue_strength * np.array([[1.0]] * 3 + [[0.0]] * 3))
    search, work = bounds.search_workspace(GRID), planes.plane_workspace(30)
    for each, some in ((history, True), (pulled, False)):
        ruled_out(each, CURVE, GRID, 1e3, work, search)
        assert np.any(np.isnan(search.shear)) == some


# --------------------------------------------------------------------------------------------------------------- images


def plane_stress(seed, harmonics, samples=30):
    """Stresses (samples, 3, 3) in the plane z = 0."""
    stress = full(block(seed, harmonics, samples, 200e6).stress).copy()
    stress[:, 2], stress[:, :, 2] = 0.0, 0.0
    return stress


def worst(stress):
    return fatigue.brown_miller(fatigue.elastic_strain(stress, CARD), stress, CARD, "max-damage")


@pytest.mark.parametrize("seed", range(4))
def test_plane_stress_out_of_its_axes_does_the_same_damage(seed):
    # Turned out of the plane z = 0 it has no images that the search knows of.
    stress, turn = plane_stress(seed, 1 + seed % 2), np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    turned = turn @ stress @ turn.T
    assert worst(stress).damage == pytest.approx(worst((turned + turned.transpose(0, 2, 1)) / 2).damage, rel=1e-8)


def test_which_blocks_are_searched_by_images(monkeypatch):
    stress = np.array([plane_stress(3, 2)] * 4)
    strain, searched = fatigue.elastic_strain(stress, CARD), []
    stress[1, 7, 0, 2] = stress[1, 7, 2, 0] = strain[2, 9, 1, 2] = strain[2, 9, 2, 1] = 1e-9

    def search(strain, stress, curve, grid, *more):
        searched.append((grid.mirrored, len(strain)))
        return np.zeros(len(strain)), np.zeros((len(strain), 2, 3))

    monkeypatch.setattr(critical, "_max_damage_planes", search)
    critical._critical(strain, stress, CURVE, "max-damage")
    assert sorted(searched) == [(False, 2), (True, 2)]


@pytest.mark.parametrize("seed", range(2))
def test_no_frame_in_the_plane_of_stress_does_more(seed):
    stress = plane_stress(20 + seed, 2)
    history = planes.pack_block(fatigue.elastic_strain(stress, CARD), stress)
    angles = np.pi * np.arange(400) / 400
    around = [damage(history, ((np.cos(a), np.sin(a), 0.0), (-np.sin(a), np.cos(a), 0.0))) for a in angles]
    assert max(around) <= worst(stress).damage


# ------------------------------------------------------------------------------------------------------------ tangents


def form(t, normal, direction):
    """n.A.d + n.G.n/2."""
    n, d, (a, g) = np.array(normal), np.array(direction), (full(t[0]), full(t[1]))
    return n @ a @ d + n @ g @ n / 2


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("make", [lambda seed: block(seed, 1, size=200e6), proportional], ids=["one cycle", "cycles"])
def test_the_tangent_has_the_slopes_of_the_damage(seed, make):
    # Where no extreme lies at the instant a cycle closes, which moves with the plane.
    history, t, step = make(seed), np.empty((2, 6)), 1e-6
    (frame,) = frames(100 + seed, 1)
    here = tangent_at(history, CURVE, *frame, planes.plane_workspace(30), t)
    assert here == pytest.approx(damage(history, frame), rel=1e-12)
    for angles in np.eye(3) * step:
        ahead, behind = turned(*frame, angles), turned(*frame, -angles)
        slope = (damage(history, ahead) - damage(history, behind)) / (2 * step)
        assert (form(t, *ahead) - form(t, *behind)) / (2 * step) == pytest.approx(slope, rel=1e-4, abs=1e-5 * here)


@pytest.mark.parametrize("seed", range(5))
def test_steps_lead_to_the_top_of_a_tangent(seed):
    t = np.random.default_rng(seed).normal(size=(2, 6))
    (frame,) = frames(seed, 1)
    best = max(-minimize(lambda x, f=f: -form(t, *turned(f[0], f[1], x)), np.zeros(3)).fun for f in frames(50 + seed, 20))
    sizes = []
    for _ in range(40):
        angles = np.array(step_to_top(t, frame[0], frame[1], 0.3))
        sizes.append(np.abs(angles).max())
        frame = turned(frame[0], frame[1], angles)
    slopes = [(form(t, *turned(*frame, x)) - form(t, *turned(*frame, -x))) / 2e-5 for x in 1e-5 * np.eye(3)]
    assert slopes == pytest.approx([0.0] * 3, abs=1e-8) and max(sizes) < 0.3
    assert form(t, *frame) <= best * (1 + 1e-9)
    last = [size for size in sizes if size > 1e-14][-3:]
    assert last[-1] < 1e-3 * last[-2]  # quadratic
