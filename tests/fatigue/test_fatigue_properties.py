"""Fatigue lives: what turning, scaling, shifting and reordering must and must not change; a map is its nodes; a card in a TOML file."""

import tomllib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivewright import fatigue
from drivewright.spec import MechanismSpec
from drivewright.units import SI

pytestmark = pytest.mark.property

CARD = fatigue.uniform_material_law("980 MPa", "206 GPa")
PLANES = ("max-shear", "max-damage")
LEVELS = st.lists(st.integers(-20, 20), min_size=1, max_size=40)


def blocks(seed, nodes=6, samples=20):
    """Stresses (nodes, samples, 3, 3) of one frequency, every component with its own phase, and a mean."""
    rng = np.random.default_rng(seed)
    t = 2 * np.pi * np.arange(samples) / samples
    mean, a, b = rng.normal(size=(3, nodes, 1, 3, 3))
    stress = mean + np.cos(t)[:, None, None] * a + np.sin(t)[:, None, None] * b
    return 120e6 * (stress + np.swapaxes(stress, 2, 3)) / 2


def lives(stress, plane, card=CARD):
    return fatigue.life_map(fatigue.elastic_strain(stress, card), stress, card, plane).life


def rotations(count, seed=0):
    for matrix in np.random.default_rng(seed).normal(size=(count, 3, 3)):
        q = np.linalg.qr(matrix)[0]
        yield q * np.sign(np.linalg.det(q))


@pytest.mark.parametrize("plane", [PLANES[0], pytest.param(PLANES[1], marks=pytest.mark.slow)])
def test_turning_the_axes_changes_nothing(plane):
    stress = blocks(1)
    plain = lives(stress, plane)
    for turn in rotations(3):
        turned = turn @ stress @ turn.T
        assert lives((turned + np.swapaxes(turned, 2, 3)) / 2, plane) == pytest.approx(plain, rel=1e-9)


@pytest.mark.parametrize("plane", PLANES)
def test_planes_turn_with_the_axes(plane):
    stress = blocks(2, nodes=1)[0]
    turn = next(rotations(1, 5))
    turned = turn @ stress @ turn.T
    first, second = (fatigue.brown_miller(fatigue.elastic_strain(s, CARD), s, CARD, plane) for s in (stress, turned))
    assert abs(second.plane @ turn @ first.plane) == pytest.approx(1, abs=1e-8)
    assert abs(second.direction @ turn @ first.direction) == pytest.approx(1, abs=1e-8)
    assert first.plane @ first.direction == pytest.approx(0, abs=1e-12) and first.plane @ first.plane == pytest.approx(1, rel=1e-12)


@pytest.mark.parametrize("plane", PLANES)
def test_uniaxial_stress_along_any_axis(plane):
    stress = np.array([0.0, 700e6])[:, None, None] * np.diag([1.0, 0, 0])
    turned = np.array([turn @ stress @ turn.T for turn in (np.eye(3), *rotations(5, 3))])
    life = lives((turned + np.swapaxes(turned, 2, 3)) / 2, plane)
    assert life == pytest.approx(life[0], rel=1e-9)


@pytest.mark.parametrize("plane", PLANES)
def test_units_of_stress_are_free(plane):
    stress = blocks(3)
    other = CARD.replace(**{name: SI(getattr(CARD, name) * 1e-6) for name in ("youngs_modulus", "fatigue_strength", "cyclic_strength")})
    assert lives(stress * 1e-6, plane, other) == pytest.approx(lives(stress, plane), rel=1e-9)


@pytest.mark.parametrize("plane", PLANES)
def test_strain_may_be_shifted_and_stress_pressed(plane):
    stress = blocks(4, nodes=3)
    strain, pressure, shift = fatigue.elastic_strain(stress, CARD), 200e6, np.array([[0.02, 0.01, 0], [0.01, 0, 0.03], [0, 0.03, -0.01]])
    plain = fatigue.life_map(strain, stress, CARD, plane).life
    assert fatigue.life_map(strain + shift, stress, CARD, plane).life == pytest.approx(plain, rel=1e-9)
    # A constant hydrostatic stress is one mean stress on every plane: the same as another sf'.
    weaker = CARD.replace(fatigue_strength=SI(CARD.fatigue_strength - pressure))
    pulled = fatigue.life_map(strain, stress + pressure * np.eye(3), CARD, plane).life
    assert pulled == pytest.approx(fatigue.life_map(strain, stress, weaker, plane).life, rel=1e-9)
    assert np.all(pulled < plain) and np.all(fatigue.life_map(strain, stress - pressure * np.eye(3), CARD, plane).life > plain)


@pytest.mark.parametrize("plane", PLANES)
def test_a_block_has_no_first_sample_and_no_direction_of_time(plane):
    stress = blocks(5)
    plain = lives(stress, plane)
    assert lives(np.roll(stress, 7, axis=1), plane) == pytest.approx(plain, rel=1e-9)
    assert lives(stress[:, ::-1], plane) == pytest.approx(plain, rel=1e-9)


@pytest.mark.parametrize("plane", PLANES)
def test_two_repeats_do_twice_the_damage(plane):
    stress = blocks(6)
    assert lives(np.concatenate([stress, stress], axis=1), plane) == pytest.approx(lives(stress, plane) / 2, rel=1e-9)


@pytest.mark.parametrize("plane", PLANES)
def test_more_strain_less_life(plane):
    stress = blocks(7)
    assert np.all(lives(1.02 * stress, plane) < lives(stress, plane))


@pytest.mark.parametrize("plane", PLANES)
def test_a_map_is_its_nodes(plane):
    stress = blocks(8, nodes=70)  # more than a chunk
    strain = fatigue.elastic_strain(stress, CARD)
    stress[3], strain[3] = stress[3, 0], strain[3, 0]
    told = []
    found = fatigue.life_map(strain, stress, CARD, plane, progress=lambda done, total, what: told.append((done, total)))
    assert told[-1] == (3, 3)
    for node in (0, 3, 31, 32, 69):
        alone = fatigue.brown_miller(strain[node], stress[node], CARD, plane)
        assert (found.life[node], found.damage[node]) == (alone.life, alone.damage)
        assert np.array_equal(found.plane[node], alone.plane, equal_nan=True)
        assert np.sum(alone.cycles.damage) == pytest.approx(alone.damage, rel=1e-12, abs=0)


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize(
    "history",
    [np.zeros((5, 3, 3)), np.full((4, 3, 3), 77e6), np.full((1, 3, 3), 77e6), np.array([0, 300e6, -1e9])[:, None, None] * np.eye(3)],
    ids=["zero", "constant", "one", "hydrostatic"],
)
def test_what_shears_nothing_lives_for_ever(plane, history):
    turn = next(rotations(1, 9))
    history = turn @ history @ turn.T
    history = (history + np.swapaxes(history, 1, 2)) / 2
    found = fatigue.brown_miller(fatigue.elastic_strain(history, CARD), history, CARD, plane)
    assert (found.life, found.damage, len(found.cycles.damage)) == (np.inf, 0.0, 0)
    assert np.all(np.isnan(found.plane))


@pytest.mark.parametrize("plane", PLANES)
def test_mean_stress_at_the_fatigue_strength_leaves_no_life(plane):
    stress = np.array([1e6, -1e6])[:, None, None] * np.diag([1.0, 0, 0]) + CARD.fatigue_strength * np.eye(3)
    found = fatigue.brown_miller(fatigue.elastic_strain(stress, CARD), stress, CARD, plane)
    assert (found.life, found.damage) == (0.0, np.inf)
    pressed = fatigue.brown_miller(fatigue.elastic_strain(-stress, CARD), -stress, CARD, plane)
    assert np.isfinite(np.log(pressed.life)) and pressed.life > 1e30


def test_superposition_is_linear():
    rng = np.random.default_rng(4)
    factors, unit = rng.normal(size=(5, 3)), rng.normal(size=(3, 7, 3))
    found = fatigue.superpose(factors, unit)
    assert found.shape == (7, 5, 3, 3) and np.array_equal(found, np.swapaxes(found, 2, 3)) and not found[..., 2].any()
    assert [found[2, 4, 0, 0], found[2, 4, 1, 1], found[2, 4, 0, 1]] == pytest.approx(sum(factors[4, k] * unit[k, 2] for k in range(3)))


def test_von_mises_of_simple_states():
    states = [np.diag([3.0, 0, 0]), np.array([[0, 2.0, 0], [2, 0, 0], [0, 0, 0]]), 5 * np.eye(3)]
    assert fatigue.von_mises(np.array(states)) == pytest.approx([3, 2 * np.sqrt(3), 0], abs=1e-12)


# --------------------------------------------------------------------------------------------------------------- rainflow


def pairs(x, repeating):
    found = fatigue.cycles(x, repeating)
    return sorted(zip(found.range.tolist(), found.mean.tolist(), found.count.tolist(), strict=True))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(LEVELS, st.integers(0, 40))
def test_a_repeated_block_may_begin_anywhere_and_run_backwards(levels, shift):
    sizes = lambda x: sorted(fatigue.cycles(x, repeating=True).range.tolist())  # noqa: E731
    assert sizes(np.roll(levels, shift)) == sizes(levels) == sizes(levels[::-1]) == sizes([-x for x in levels])
    assert np.all(fatigue.cycles(levels, repeating=True).count == 1)
    travel = np.sum(np.abs(np.diff([*levels, levels[0]])))
    assert sum(sizes(levels)) * 2 == travel  # every branch belongs to one cycle


@settings(max_examples=60, deadline=None, derandomize=True)
@given(LEVELS, st.integers(1, 3), st.integers(-5, 5))
def test_once_through_every_branch_is_counted_once(levels, scale, shift):
    found = fatigue.cycles(levels)
    assert np.sum(2 * found.count * found.range) == np.sum(np.abs(np.diff(levels)))
    assert np.all(np.asarray(levels)[found.start] + np.asarray(levels)[found.end] == 2 * found.mean)
    assert max(found.range, default=0) == np.ptp(levels)
    moved = pairs([scale * x + shift for x in levels], False)
    assert moved == sorted((scale * r, scale * m + shift, c) for r, m, c in pairs(levels, False))
    assert pairs(np.repeat(levels, 2), False) == pairs(levels, False)


# -------------------------------------------------------------------------------------------------------------- the card


class Plate(MechanismSpec):
    steel: fatigue.StrainLife


def test_a_card_stands_in_a_toml_table():
    spec = Plate(mechanism="plate", steel=CARD)
    text = spec.to_toml()
    assert "[steel]" in text and 'youngs_modulus = "206000 MPa"' in text and "estimated = true" in text
    assert Plate(**tomllib.loads(text)) == spec
