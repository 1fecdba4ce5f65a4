"""Labels: short names for people that stand alone, apart from the sentence that says what a thing means."""

import pytest

from drivewright.labels import LONGEST, duplicates, faults, label_of, label_of_key
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
