"""Labels: short names for people that stand alone, apart from the sentence that says what a thing means."""

import pytest

from drivewright.labels import LONGEST, duplicates, faults, key_in_words, label_of, label_of_key, usual_unit
from drivewright.result import Check, Column, Table, Value
from drivewright.spec import schema

pytestmark = pytest.mark.interface


@pytest.mark.parametrize(
    ("meaning", "label"),
    [
        ("greatest lift, above the base", "Greatest lift"),
        ("pressure angle (positive where it opposes the rise)", "Pressure angle"),
        ("Lift", "Lift"),
        ("first; second", "First"),
        ("", ""),
    ],
)
def test_without_a_label_the_first_phrase_of_the_meaning_is_taken(meaning, label):
    assert label_of(meaning) == label
    assert Value(1.0, "m", meaning).record()["label"] == label
    assert Check("c", 1.0, 2.0, "<=", "m", meaning).record()["label"] == label


def test_a_label_of_its_own_stands_beside_the_meaning():
    value = Value(1.0, "m", "how far it rises, from the base circle", label="lift")
    assert (value.record()["label"], value.record()["meaning"]) == ("Lift", "how far it rises, from the base circle")
    assert Value.of(value, "m", "rise", "stroke").label == "Stroke"
    assert Check.of(value, "lift", 2.0, "<=", "too high", label="stroke").record()["label"] == "Stroke"
    column = Column("s", "m", "how far it rises", [0.0, 1.0], "lift")
    metadata = Table("t", "T", (column,)).arrow().schema.field("s").metadata
    assert (metadata[b"label"], metadata[b"meaning"]) == (b"Lift", b"how far it rises")


def test_a_convention_stands_apart_from_label_and_meaning():
    value = Value(1.0, "rad", "largest pressure angle", label="maximum pressure angle", convention="positive where it opposes the rise")
    assert value.record()["convention"] == "positive where it opposes the rise" and Value(**value.record()).record() == value.record()
    assert Value.of(value, "rad", "angle", convention="from above").record()["convention"] == "from above"
    assert "convention" not in Value(1.0, "m", "lift").record()


def test_the_key_of_a_spec_in_words():
    assert label_of_key("base_radius") == "Base radius" and label_of_key("n", "Number of teeth") == "Number of teeth"


@pytest.mark.parametrize(
    "label", ["", " ", "x" * (LONGEST + 1), "Of a pin", "The same of bearing C", "Stiffness in um", "Area [mm^2]", "Where it stands"]
)
def test_what_does_not_stand_alone_is_a_fault(label):
    assert faults(label)


@pytest.mark.parametrize("label", ["Lift", "x" * LONGEST, "Offset of the follower", "Inner ring", "Atmosphere", "Umbrella number"])
def test_what_stands_alone_is_none(label):
    assert faults(label) == ()


def test_duplicates_are_named_once():
    assert duplicates(["a", "b", "a", "a"]) == ("a",) and duplicates(["a", "b"]) == ()


def test_the_fields_of_a_schema_have_labels():
    properties = schema("cam")["$defs"]["Follower"]["properties"]
    assert properties["prime_radius"]["title"] == "Prime radius" and properties["face"]["title"] == "Face"


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("cams.roller_radius", "roller radius"),
        ("roller_radius", "roller radius"),
        ("bearings.A.position", "position of bearings.A"),
        ("teeth.0", "teeth.0"),
    ],
)
def test_a_key_within_a_sentence(key, words):
    assert key_in_words(key) == words


def test_a_dash_or_a_colon_ends_the_first_phrase_a_hyphen_does_not():
    assert label_of("peak-to-peak play - over one turn") == "Peak-to-peak play"
    assert label_of("play of the B side: over one turn") == "Play of the B side"


@pytest.mark.parametrize(
    ("label", "unit", "wanted"),
    [
        ("Transmission error", "rad", "arcmin"),
        ("Backlash", "rad", "arcmin"),
        ("Angle of maximum play", "rad", ""),
        ("Fraction of time", "-", "%"),
    ],
)
def test_units_of_small_angles_and_of_shares(label, unit, wanted):
    assert usual_unit(label, unit) == wanted


def test_a_label_that_leans_on_others_is_a_fault_of_its_own():
    assert faults("Bearings, the others") == ("leans on another label",) and faults("Bearings, others") == ()
