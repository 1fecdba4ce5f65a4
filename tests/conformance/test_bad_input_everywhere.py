"""Every key of every preset of every kind, one by one: nonsense in it is refused by that key, and the others are not blamed."""

import copy

import pytest

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.spec import from_document, load
from drivewright.spec.fields import choices_of, dimension_of, field_at, type_of
from drivewright.spec.serialisation import document

pytestmark = pytest.mark.error

PRESETS = [(kind, path) for kind in registry.kinds() for path in registry.mechanism(kind).presets().values()]
SPECS = [(path.parent, type(load(path)), document(load(path))) for _, path in PRESETS]


def leaves(value, path=()):
    if isinstance(value, (dict, list)):
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(inner, (*path, key))
    else:
        yield path


def field_of(model, path):
    return field_at(model, [str(step) for step in path])


CASES = {
    (model, ".".join("0" if isinstance(step, int) else step for step in path)): (folder, model, tables, path)
    for folder, model, tables in SPECS
    for path in leaves(tables)
}
NUMERIC = [
    case
    for case in CASES.values()
    if dimension_of(field_of(case[1], case[3])) or type_of(field_of(case[1], case[3]).annotation) in (int, float)
]
NUMERIC = [case for case in NUMERIC if not choices_of(field_of(case[1], case[3]).annotation)]


def names(case):
    return ".".join(map(str, case[3]))


def refusal(case, value):
    folder, model, tables, path = case
    tables = copy.deepcopy(tables)
    place = tables
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    with pytest.raises(SpecError) as caught:
        from_document(tables, folder=folder)
    return caught.value


def test_there_are_many():
    assert len(CASES) > 100 and len(NUMERIC) > 70


NONSENSE = [float("nan"), float("inf"), -float("inf"), "nan mm", "-inf deg", "inf", "", "much", True, [], {}, [[]], "1 furlong", "1e999 mm"]


@pytest.mark.parametrize("case", NUMERIC, ids=names)
def test_no_numeric_key_takes_nonsense(case):
    for value in NONSENSE:
        error = refusal(case, value)
        assert error.key == names(case), value
        assert len(str(error)) < 600 and "\n" not in str(error)


@pytest.mark.parametrize("case", [case for case in NUMERIC if dimension_of(field_of(case[1], case[3]))], ids=names)
def test_no_quantity_takes_a_bare_number_or_another_dimension(case):
    assert "unit missing" in str(refusal(case, 1.5)) and "unit missing" in str(refusal(case, "1.5"))
    assert "wants a" in str(refusal(case, "1.5 kg^2 K")) and "got '1.5 kg^2 K'" in str(refusal(case, "1.5 kg^2 K"))


@pytest.mark.parametrize("case", [case for case in CASES.values() if isinstance(case[3][-1], str)], ids=names)
def test_a_misspelt_key_is_refused_with_the_right_one(case):
    folder, model, tables, path = case
    tables = copy.deepcopy(tables)
    place = tables
    for step in path[:-1]:
        place = place[step]
    place[path[-1] + "x"] = place.pop(path[-1])
    with pytest.raises(SpecError) as caught:
        from_document(tables, model, folder)
    assert caught.value.key == f"{names(case)}x" and f"(did you mean '{path[-1]}'?)" in str(caught.value)
