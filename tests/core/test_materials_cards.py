import pickle

import pytest

from drivewright import materials
from drivewright.errors import InputError, UnknownName
from drivewright.materials import given_strength, material, names, no_strength_reason, strength

pytestmark = pytest.mark.property

CARDS = [material(name) for name in names()]
QUANTITIES = "modulus", "poisson", "density", "yield_strength", "hertz_limit"


@pytest.mark.parametrize("card", CARDS, ids=names())
def test_every_number_has_a_source_and_no_source_lacks_a_number(card):
    for quantity in QUANTITIES:
        if getattr(card, quantity) is None:
            with pytest.raises(UnknownName, match=f"{quantity!r}"):
                card.source(quantity)
        else:
            source = card.source(quantity)
            assert len(source.text) > 20 and source.recalled == source.text.startswith("recalled: ")
    assert card.condition


@pytest.mark.parametrize("card", CARDS, ids=names())
def test_numbers_are_in_SI_and_of_this_world(card):
    assert 1e9 < card.modulus < 400e9 and 0.2 < card.poisson < 0.45 and 900 < card.density < 12e3
    assert 3e-4 < card.yield_strength / card.modulus < 0.03  # strain at yield
    assert card.hertz_limit is None or card.yield_strength / 2 < card.hertz_limit < 5e9
    assert 600 < (card.modulus / card.density) ** 0.5 < 6000  # speed of sound in a bar, m/s


def test_steels_are_alike_in_stiffness_and_apart_in_strength():
    steels = [material(name) for name in ("S355J2", "C45", "42CrMo4", "34CrNiMo6", "100Cr6")]
    assert {steel.modulus for steel in steels} == {210e9}
    strengths = [steel.yield_strength for steel in steels]
    assert strengths == sorted(strengths)


@pytest.mark.parametrize(
    "name, quantity, value",
    [
        ("42CrMo4", "yield_strength", 650e6),
        ("C45", "yield_strength", 430e6),
        ("C45+N", "yield_strength", 305e6),
        ("C35", "yield_strength", 380e6),
        ("16MnCr5", "yield_strength", 490e6),
        ("EN-GJS-600-3", "yield_strength", 370e6),
        ("EN-GJS-600-3", "modulus", 175e9),
        ("POM", "poisson", 0.363),
        ("POM", "modulus", 2.82e9),
        ("100Cr6", "hertz_limit", 1.5e9),
    ],
)
def test_numbers_that_were_read_and_not_recalled(name, quantity, value):
    assert getattr(material(name), quantity) == value and not material(name).source(quantity).recalled


def test_an_unknown_name_is_answered_with_the_nearest():
    with pytest.raises(UnknownName, match=r"no material is called '42CrMo' \(did you mean '42CrMo4'\?\); known: 100Cr6, 16MnCr5"):
        material("42CrMo")


def test_cards_are_values():
    card = material("POM")
    assert pickle.loads(pickle.dumps(card)) == card and hash(card) == hash(material("POM"))
    with pytest.raises(AttributeError):
        card.modulus = 1.0
    assert materials.names() == sorted(materials.names())


# -- strength by diameter ------------------------------------------------------------------------------------------------------

MM, MPA = 1e-3, 1e6
BY_DIAMETER = ("16MnCr5", "34CrNiMo6", "42CrMo4", "C35", "C45", "C45+N", "E295", "E335", "S355J2")
WITHIN = {"S355J2": 16, "E295": 16, "E335": 16, "16MnCr5": 30, "42CrMo4": 100, "34CrNiMo6": 100, "C45+N": 100}  # mm, of the condition


@pytest.mark.parametrize("name", BY_DIAMETER)
def test_thicker_bars_are_weaker_and_a_card_agrees_with_the_table(name):
    steps = [strength(name, diameter * MM) for diameter in (10, 16, 25, 40, 60)]
    assert all(a.tensile >= b.tensile and a.yield_strength >= b.yield_strength for a, b in zip(steps, steps[1:], strict=False))
    assert steps[0].yield_strength > steps[-1].yield_strength
    assert all(0.45 * each.tensile < each.yield_strength < 0.95 * each.tensile for each in steps)
    assert strength(name, WITHIN.get(name, 40) * MM).yield_strength == material(name).yield_strength
    assert len(steps[0].source.text) > 20 and steps[0].source.recalled == (name in ("34CrNiMo6", "E295", "E335"))


@pytest.mark.parametrize(
    "name, diameter, yield_strength, tensile",
    [
        ("C45", 16, 490, 700),
        ("C45", 16.01, 430, 650),
        ("C45", 100, 370, 630),
        ("C45+N", 250, 275, 560),
        ("C35", 50, 320, 550),
        ("42CrMo4", 12, 900, 1100),
        ("42CrMo4", 40, 750, 1000),
        ("42CrMo4", 200, 500, 750),
        ("16MnCr5", 11, 735, 1030),
        ("16MnCr5", 63, 440, 640),
        ("S355J2", 16, 355, 470),
        ("S355J2", 120, 295, 450),
        ("34CrNiMo6", 15, 1000, 1200),
        ("E335", 50, 315, 570),
    ],
)
def test_strengths_as_specified(name, diameter, yield_strength, tensile):
    found = strength(name, diameter * MM)
    assert (found.yield_strength, found.tensile) == (yield_strength * MPA, tensile * MPA)


def test_what_is_given_goes_first():
    assert given_strength("C45", 30 * MM, None, None) == strength("C45", 30 * MM)
    own = given_strength("C45", 30 * MM, None, 500 * MPA)
    assert (own.tensile, own.yield_strength) == (650 * MPA, 500 * MPA)
    assert given_strength("POM", 30 * MM, 70 * MPA, None)[:2] == (70 * MPA, material("POM").yield_strength)
    both = given_strength(None, 30 * MM, 700 * MPA, 500 * MPA)
    assert both[:2] == (700 * MPA, 500 * MPA) and both.source.text == "given by the design"


@pytest.mark.error
@pytest.mark.parametrize(
    "card, diameter, tensile, yield_strength, reason",
    [
        (None, 30, None, 355e6, "neither a material card nor a tensile strength is given"),
        (None, 30, 700e6, None, "a tensile strength is given, but neither a material card nor a yield strength"),
        ("POM", 30, None, None, "the card of POM has no tensile strength"),
        ("C45", 101, None, 300e6, "C45, quenched and tempered, 16 to 40 mm: specified up to 100 mm, the shaft has 101 mm"),
    ],
)
def test_without_a_tensile_strength_there_is_a_reason(card, diameter, tensile, yield_strength, reason):
    given = card, diameter * MM, tensile, yield_strength
    assert no_strength_reason(*given) == reason
    with pytest.raises(InputError, match=f"^{reason}; give tensile_strength and yield_strength$"):
        given_strength(*given)


@pytest.mark.error
def test_strength_of_a_card_alone():
    with pytest.raises(InputError, match=r"^C45\+N, normalised, 16 to 100 mm: specified up to 250 mm, the shaft has 260 mm; give tensile"):
        strength("C45+N", 260 * MM)
    with pytest.raises(UnknownName, match=r"no material is called 'C46'"):
        strength("C46", 30 * MM)
    assert no_strength_reason("C45", 30 * MM, None, None) is None and no_strength_reason(None, 30 * MM, 7e8, 5e8) is None
