"""Strain-life and cyclic curves: values by hand, inversions against a bracketing solver, the uniform material law's printed numbers."""

import numpy as np
import pytest
from scipy.optimize import brentq

from drivewright import fatigue
from drivewright._jit import kernel
from drivewright.fatigue import curves
from drivewright.units import SI

pytestmark = pytest.mark.analytical

CARD = fatigue.StrainLife(
    youngs_modulus="206 GPa",
    poisson_ratio=0.28,
    fatigue_strength="1470 MPa",
    fatigue_strength_exponent=-0.087,
    fatigue_ductility=0.46,
    fatigue_ductility_exponent=-0.58,
    cyclic_strength="1617 MPa",
    cyclic_hardening_exponent=0.15,
)


def test_the_two_terms_by_hand():
    # 2N = 1: the coefficients themselves; 2N = 1e6 with the powers written out.
    assert fatigue.strain_at_life(0.5, CARD) == pytest.approx(1470e6 / 206e9 + 0.46, rel=1e-15)
    by_hand = (1470e6 - 90e6) / 206e9 * 10 ** (-6 * 0.087) + 0.46 * 10 ** (-6 * 0.58)
    assert fatigue.strain_at_life(5e5, CARD, mean_stress=90e6) == pytest.approx(by_hand, rel=1e-14)


@pytest.mark.parametrize("mean", [0.0, 300e6, -400e6])
def test_life_inverts_strain_over_forty_decades(mean):
    life = np.logspace(-8, 32, 161)
    assert fatigue.life_at_strain(fatigue.strain_at_life(life, CARD, mean), CARD, mean) == pytest.approx(life, rel=1e-11)


def test_life_against_bracketing():
    for strain in (3.1e-2, 4.2e-3, 1.1e-3):
        miss = lambda y, strain=strain: 1470e6 / 206e9 * np.exp(-0.087 * y) + 0.46 * np.exp(-0.58 * y) - strain  # noqa: E731
        assert fatigue.life_at_strain(strain, CARD) == pytest.approx(np.exp(brentq(miss, -5, 60, xtol=1e-13)) / 2, rel=1e-11)


@pytest.mark.parametrize("sense", [1, -1])
def test_a_sum_of_two_powers_is_inverted_for_all_exponents(sense):
    rng = np.random.default_rng(4)
    p, q = sense * 10 ** rng.uniform(-2.5, 0.5, (2, 3000))
    log_a, log_b, total = rng.uniform(-20, 20, (3, 3000))
    root = roots(log_a, p, log_b, q, total)
    assert np.logaddexp(log_a + p * root, log_b + q * root) == pytest.approx(total, abs=1e-12, rel=1e-13)


@kernel
def roots(log_a, p, log_b, q, total):
    root = np.empty_like(p)
    for k in range(len(p)):
        root[k] = curves.log_root(log_a[k], p[k], log_b[k], q[k], total[k])
    return root


def test_ends_of_life():
    assert fatigue.life_at_strain([0.0, 0.01], CARD, [0.0, 1470e6]).tolist() == [np.inf, 0.0]


def test_cyclic_curve_by_hand_and_odd():
    assert fatigue.ramberg_osgood(1617e6, CARD) == pytest.approx(1617 / 206e3 + 1, rel=1e-14)
    s = np.array([120e6, 655e6])
    assert fatigue.ramberg_osgood(s, CARD) == pytest.approx(s / 206e9 + (s / 1617e6) ** (20 / 3), rel=1e-14)
    assert np.array_equal(fatigue.ramberg_osgood(-s, CARD), -fatigue.ramberg_osgood(s, CARD))


def test_compatible_cyclic_constants():
    card = CARD.replace(cyclic_strength=None, cyclic_hardening_exponent=None)
    assert card.hardening_exponent == pytest.approx(0.15, rel=1e-12)
    # Compatible means: at every life the stress of the elastic term lies on the cyclic curve at the whole strain.
    life = np.logspace(1, 7, 13)
    stress = 1470e6 * (2 * life) ** -0.087
    assert fatigue.ramberg_osgood(stress, card) == pytest.approx(fatigue.strain_at_life(life, card), rel=1e-12)
    assert fatigue.ramberg_osgood(card.cyclic_yield, card) - card.cyclic_yield / 206e9 == pytest.approx(0.002, rel=1e-12)
    assert card.replace(yield_strength="700 MPa").cyclic_yield == 700e6


def test_neuber_keeps_the_energy_and_stays_on_the_curve():
    elastic = np.array([[40e6, -700e6, 1500e6], [0.0, 3000e6, -1e3]])
    stress, strain = fatigue.neuber(elastic, CARD)
    assert stress * strain == pytest.approx(elastic**2 / 206e9, rel=1e-13)
    assert strain == pytest.approx(stress / 206e9 + np.sign(stress) * (np.abs(stress) / 1617e6) ** (20 / 3), rel=1e-13)
    assert np.all(np.sign(stress) == np.sign(elastic)) and np.all(np.abs(stress) <= np.abs(elastic) * (1 + 1e-14))
    assert fatigue.neuber(1e6, CARD).stress == pytest.approx(1e6, rel=1e-12)  # nothing yields


# ------------------------------------------------------------------------------------------------------- along a history


def uniaxial(values):
    tensors = np.zeros((len(values), 3, 3))
    tensors[:, 2, 2] = values
    return tensors


def test_neuber_history_of_a_repeated_load_by_hand():
    stress, strain = fatigue.neuber_history(uniaxial([0.0, 1400e6]), CARD)
    up, down = fatigue.neuber(1400e6, CARD), fatigue.neuber(700e6, CARD)  # the way down is the doubled curve
    assert stress[:, 2, 2] == pytest.approx([up.stress - 2 * down.stress, up.stress], rel=1e-13)
    assert strain[:, 2, 2] == pytest.approx([up.strain - 2 * down.strain, up.strain], rel=1e-12)
    plastic = strain[:, 2, 2] - stress[:, 2, 2] / 206e9
    assert strain[:, 0, 0] == pytest.approx(-0.28 * stress[:, 2, 2] / 206e9 - 0.5 * plastic, rel=1e-12)


def test_neuber_history_remembers_the_loop_it_interrupted():
    plain = np.array([900e6, -700e6, -1300e6, 200e6])
    looped = np.array([900e6, -200e6, 300e6, -200e6, -700e6, -1300e6, 200e6])
    a, b = (fatigue.neuber_history(uniaxial(history), CARD) for history in (plain, looped))
    assert b.stress[[0, 4, 5, 6], 2, 2] == pytest.approx(a.stress[:, 2, 2], rel=1e-13)
    assert b.strain[[0, 4, 5, 6], 2, 2] == pytest.approx(a.strain[:, 2, 2], rel=1e-13)
    assert b.strain[1, 2, 2] == pytest.approx(b.strain[3, 2, 2], rel=1e-13)  # the small loop is closed
    small = fatigue.neuber(250e6, CARD)
    assert b.stress[2, 2, 2] - b.stress[1, 2, 2] == pytest.approx(2 * small.stress, rel=1e-12)


def test_neuber_history_in_torsion_stands_on_von_mises():
    elastic = np.zeros((2, 3, 3))
    elastic[0, 0, 1] = elastic[0, 1, 0] = 800e6
    elastic[1] = -elastic[0]
    stress, strain = fatigue.neuber_history(elastic, CARD)
    same = fatigue.neuber(800e6 * np.sqrt(3), CARD)
    assert stress[:, 0, 1] == pytest.approx(np.array([1, -1]) * same.stress / np.sqrt(3), rel=1e-12)
    slide = 2 * 1.28 * stress[0, 0, 1] / 206e9 + np.sqrt(3) * (same.strain - same.stress / 206e9)
    assert 2 * strain[:, 0, 1] == pytest.approx([slide, -slide], rel=1e-12)
    assert np.count_nonzero(np.round(stress, 3)) == 4


def test_what_does_not_yield_comes_back():
    elastic = uniaxial([CARD.cyclic_yield, -0.2 * CARD.cyclic_yield])
    stress, strain = fatigue.neuber_history(elastic, CARD)
    assert np.array_equal(stress, elastic) and np.array_equal(strain, fatigue.elastic_strain(elastic, CARD))
    assert np.max(fatigue.neuber_history(1.001 * elastic, CARD).stress) < 0.99 * CARD.cyclic_yield


def test_hooke_inverts_lame():
    strain = np.random.default_rng(3).normal(size=(5, 3, 3))
    strain = strain + strain.transpose(0, 2, 1)
    shear = 206e9 / (2 * 1.28)
    stress = 2 * shear * (strain + 0.28 / 0.44 * np.trace(strain, axis1=1, axis2=2)[:, None, None] * np.eye(3))
    assert fatigue.elastic_strain(stress, CARD) == pytest.approx(strain, rel=1e-12)


# -------------------------------------------------------------------------------------------------------------- the cards


def test_uniform_material_law_of_980_MPa_steel():
    card = fatigue.uniform_material_law("980 MPa", "206 GPa")
    assert card.fatigue_ductility == pytest.approx(0.59 * 0.78034, abs=5e-6) == pytest.approx(0.46040, abs=5e-6)
    assert (card.fatigue_strength, card.fatigue_strength_exponent, card.fatigue_ductility_exponent) == (1470e6, -0.087, -0.58)
    assert (card.cyclic_strength, card.cyclic_hardening_exponent) == (pytest.approx(1617e6, rel=1e-12), 0.15)
    assert card.estimated and card.source.startswith("recalled:") and "980 MPa" in card.source
    assert card == fatigue.uniform_material_law(980e6, 206e9)


def test_uniform_material_law_at_full_ductility_and_of_light_metals():
    assert fatigue.uniform_material_law(600e6, 206e9).fatigue_ductility == 0.59
    light = fatigue.uniform_material_law("400 MPa", "70 GPa", 0.33, "aluminium-titanium")
    assert light.fatigue_strength == pytest.approx(668e6, rel=1e-12) and light.poisson_ratio == 0.33
    assert (light.fatigue_ductility, light.fatigue_strength_exponent, light.fatigue_ductility_exponent) == (0.35, -0.095, -0.69)
    assert light.cyclic_strength == pytest.approx(644e6, rel=1e-12) and light.cyclic_hardening_exponent == 0.11


@pytest.mark.parametrize(
    ("life", "text"),
    [
        (314159.0, "3.14e5"),
        (1e9, "1e9"),
        (1.01e9, ">1e9 (extrapolated)"),
        (812.3, "812"),
        (np.inf, "unlimited"),
        (0.0, "0"),
        (0.012, "0.012"),
        (2.5e-7, "2.5e-7"),
    ],
)
def test_lives_as_text(life, text):
    assert fatigue.life_text(life, CARD) == text
    assert fatigue.life_text(2e6, CARD.replace(longest_life=SI(1e6))) == ">1e6 (extrapolated)"
