import numpy as np
import pytest

from drivewright import fatigue
from drivewright.errors import InputError, SpecError, UnknownName

pytestmark = pytest.mark.error

NUMBERS = {
    "youngs_modulus": "206 GPa",
    "fatigue_strength": "1470 MPa",
    "fatigue_strength_exponent": -0.087,
    "fatigue_ductility": 0.46,
    "fatigue_ductility_exponent": -0.58,
}
CARD = fatigue.StrainLife(**NUMBERS)
STRESS = 1e8 * np.array([np.diag([1.0, 2, 3]), np.zeros((3, 3))])
STRAIN = fatigue.elastic_strain(STRESS, CARD)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"fatigue_strength": "-3 MPa"}, "fatigue_strength: must be greater than 0 MPa, got -3 MPa"),
        ({"fatigue_strength": 1470e6}, "fatigue_strength: unit missing"),
        ({"fatigue_strength": "1470 mm"}, "fatigue_strength: .*length"),
        ({"fatigue_strength_exponent": 0.087}, "fatigue_strength_exponent: must be less than 0, got 0.087"),
        (
            {"fatigue_strength_exponent": -0.58, "fatigue_ductility_exponent": -0.087},
            "fatigue_ductility_exponent: -0.087 must lie below .*sw",
        ),
        ({"fatigue_ductility": 0.0}, "fatigue_ductility: must be greater than 0, got 0"),
        ({"poisson_ratio": 0.5}, "poisson_ratio: must be less than 0.5"),
        ({"longest_life": float("nan")}, "longest_life: "),
        ({"fatigue_limit": "300 MPa"}, "fatigue_limit: "),
    ],
)
def test_cards(change, message):
    with pytest.raises(SpecError, match=message):
        fatigue.StrainLife(**{**NUMBERS, **change})


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("2300 MPa", "206 GPa"), "2300 MPa is 0.01117 of Young's modulus; from 0.011 on"),
        ((-980e6, 206e9), "tensile_strength must be above 0 and finite, got -980000000.0"),
        (("980 MPa", float("nan")), "youngs_modulus must be above 0 and finite, got nan"),
        (("980 MPa", "206 GPa", 0.3, "steal"), "no family of the uniform material law is called 'steal' .did you mean 'steel'"),
        (("980 mm", "206 GPa"), "length"),
    ],
)
def test_uniform_material_law(arguments, message):
    with pytest.raises(InputError, match=message):
        fatigue.uniform_material_law(*arguments)


def changed(place, value):
    strain = STRAIN.copy()
    strain[place] = value
    return strain


@pytest.mark.parametrize(
    ("strain", "stress", "message"),
    [
        (STRAIN[0], STRESS, r"brown_miller: strain must have the shape \(samples, 3, 3\), got \(3, 3\)"),
        (STRAIN[:0], STRESS[:0], r"got \(0, 3, 3\)"),
        (STRAIN[:, :2], STRESS, r"got \(2, 2, 3\)"),
        (STRAIN[:1], STRESS, r"sample by sample, got the shapes \(1, 3, 3\) and \(2, 3, 3\)"),
        (changed((1, 0, 2), np.nan), STRESS, r"strain\[1, 0, 2\] is nan, 1 in all are not finite"),
        (changed((1, 0, 2), 1e-3), STRESS, r"strain\[1, 0, 2\] is 0.001 but its mirror is 0; tensors are symmetric, with the tensor shear"),
        (STRESS, STRAIN, r"the largest strain is 3e\+08; .*Give strain first"),
        ("none", STRESS, "strain must be an array of numbers"),
    ],
)
def test_histories(strain, stress, message):
    with pytest.raises(InputError, match=message):
        fatigue.brown_miller(strain, stress, CARD)


def test_a_map_wants_nodes_first():
    with pytest.raises(InputError, match=r"life_map: strain must have the shape \(nodes, samples, 3, 3\), got \(2, 3, 3\)"):
        fatigue.life_map(STRAIN, STRESS, CARD)


def test_an_unknown_plane():
    with pytest.raises(UnknownName, match="no choice of plane is called 'max_shear' .did you mean .max-shear.*max-damage, max-shear"):
        fatigue.brown_miller(STRAIN, STRESS, CARD, "max_shear")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: fatigue.cycles([]), r"one row of at least one number, got the shape \(0,\)"),
        (lambda: fatigue.cycles([[1, 2], [3, 4]]), r"got the shape \(2, 2\); count one signal each"),
        (lambda: fatigue.cycles([1, np.inf, np.nan]), "sample 1 of the history is inf; 2 are not finite"),
        (lambda: fatigue.cycles("abc"), "a row of numbers"),
        (lambda: fatigue.life_at_strain(-1e-3, CARD), "amplitudes must not be negative, got -0.001"),
        (lambda: fatigue.life_at_strain(np.nan, CARD), "life_at_strain: amplitude must be finite, got nan"),
        (lambda: fatigue.strain_at_life(0, CARD), "lives must be above 0, got 0"),
        (
            lambda: fatigue.strain_at_life(1e3, CARD, 1.5e9),
            "a mean stress of 1500 MPa leaves no strain .* below fatigue_strength, 1470 MPa",
        ),
        (lambda: fatigue.neuber("high", CARD), "neuber: elastic_stress must be a number"),
        (lambda: fatigue.neuber_history(STRESS[0], CARD), r"neuber_history: elastic_stress must have the shape \(samples, 3, 3\)"),
        (lambda: fatigue.elastic_strain(np.full((2, 3, 3), np.inf), CARD), r"elastic_strain: stress\[0, 0, 0\] is inf, 18 in all"),
        (lambda: fatigue.elastic_strain(3.0, CARD), r"elastic_strain: stress must have the shape \(samples, 3, 3\), got \(\)"),
        (lambda: fatigue.plane_tensors([1.0, 2.0]), r"the last axis xx, yy, xy; got the shape \(2,\)"),
        (lambda: fatigue.superpose(np.ones((4, 2)), np.ones((3, 9, 3))), r"got the shapes \(4, 2\) and \(3, 9, 3\)"),
        (lambda: fatigue.life_text(float("nan"), CARD), "a life is a number from 0 on, got nan"),
    ],
)
def test_one_clear_message(call, message):
    with pytest.raises(InputError, match=message) as told:
        call()
    assert "\n" not in str(told.value)


def test_an_unknown_name_of_the_package():
    with pytest.raises(AttributeError, match="goodman"):
        fatigue.goodman  # noqa: B018
