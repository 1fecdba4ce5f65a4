"""In which keys specs differ."""

import pytest

import drivewright as dw
from drivewright.spec.differences import differing_keys, flat_tables, is_same_entry

pytestmark = pytest.mark.interface


@pytest.fixture
def cam(tmp_path):
    """Loads the default cam with some keys changed."""
    from drivewright import registry

    preset = registry.mechanism("cam").presets()["default"]
    return lambda *changes: dw.load(preset, changes)


def test_keys_that_differ_come_with_the_value_of_each_spec(cam):
    rows = differing_keys([cam(), cam("follower.roller_radius=6 mm"), cam("drive.speed=700 rpm", "follower.roller_radius=6 mm")])
    assert {row.key: row.values for row in rows} == {
        "follower.roller_radius": ("8 mm", "6 mm", "6 mm"),
        "drive.speed": ("600 rpm", "600 rpm", "700 rpm"),
    }


def test_other_units_and_other_titles_are_no_difference(cam):
    assert differing_keys([cam(), cam("follower.roller_radius=0.8 cm", "title=Another")]) == ()


def test_a_default_counts_as_written(cam):
    assert differing_keys([cam(), cam("follower.offset=0 mm")]) == ()


def test_a_table_that_a_spec_does_not_have_is_none(cam):
    rows = {row.key: row.values for row in differing_keys([cam(), cam("spring=")])}
    assert rows["spring.stiffness"][0] is not None and rows["spring.stiffness"][1] is None


def test_tables_become_dotted_keys():
    assert flat_tables({"a": {"b": [1, {"c": 2}]}, "d": 3}) == {"a.b.0": 1, "a.b.1.c": 2, "d": 3}


def test_copies_of_one_file_say_the_same(tmp_path):
    one, two = tmp_path / "one.csv", tmp_path / "two.csv"
    one.write_text("1")
    two.write_text("1")
    assert is_same_entry(str(one), str(two)) and is_same_entry("30 mm", "3 cm") and not is_same_entry("30 mm", "30 N")
    two.write_text("2")
    assert not is_same_entry(str(one), str(two))
