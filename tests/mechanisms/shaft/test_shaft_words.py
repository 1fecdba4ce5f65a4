"""Words of a shaft for people: no two of a result share a label, and a check names a section only where it is the weakest."""

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.labels import duplicates, faults, label_of

pytestmark = pytest.mark.interface


@pytest.fixture(scope="module", params=["gearbox_shaft", "two_disc_rotor", "spindle_duty"])
def result(request):
    return dw.run(dw.load(EXAMPLES / f"{request.param}.toml"))


def test_labels_of_values_and_checks_are_short_and_each_its_own(result):
    values = {name: label_of(value.meaning, value.label) for name, value in result.values.items()}
    checks = [check.display_label for check in result.checks]
    assert duplicates(values.values()) == () and duplicates(checks) == ()
    assert not any(faults(label) for label in (*values.values(), *checks))


def test_columns_of_a_table_have_labels_of_their_own(result):
    for table in result.tables.values():
        assert duplicates(label_of(column.meaning, column.label) for column in table.columns) == (), table.name


def test_checks_of_lives_do_not_repeat_the_numbers_of_their_row(result):
    messages = [check.message for check in result.checks if check.name.startswith(("life.", "modified_life."))]
    assert not any(" h" in message for message in messages)


@pytest.mark.parametrize(("shock", "key"), [(1.0, "fatigue_safety"), (9.0, "static_safety")])
def test_only_the_check_with_the_least_safety_names_the_section(shock, key):
    spec = dw.load(EXAMPLES / "gearbox_shaft.toml")
    found = dw.run(spec.replace(limits=spec.limits.replace(shock_factor=shock)), only=("strength",))
    (other,) = {"fatigue_safety", "static_safety"} - {key}
    assert found[f"strength.{key}"] == found["strength.min_safety"] < found[f"strength.{other}"]
    section = found.values["strength.min_safety"].meaning.partition(", at ")[2]
    assert section and found.check(f"strength.{key}").message.endswith(f"; weakest section: {section}")
    assert "weakest" not in found.check(f"strength.{other}").message
