import pickle

import pytest

from drivewright import materials
from drivewright.errors import UnknownName
from drivewright.materials import material, names

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
