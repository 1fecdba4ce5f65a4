"""`--set key=value` and dotted keys."""

import tomllib

import pytest
from spec_cases import FULL, ToySpec, install

from drivewright.errors import SpecError
from drivewright.spec import Field, Named, Spec, change_key, dimension_at, from_document, read_value, set_key
from drivewright.units import Length

pytestmark = pytest.mark.interface


@pytest.fixture
def tables(monkeypatch, tmp_path):
    install(monkeypatch, tmp_path)
    return {k: v for k, v in tomllib.loads(FULL).items() if k != "table"}


def spec_with(tables, *changes):
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


@pytest.mark.parametrize("text", ['length="6.35 mm"', "length=6.35mm", "length = 6.35 mm ", "length='6.35 mm'", "length=0.635 cm"])
def test_a_quantity_needs_no_quotes(tables, text):
    assert spec_with(tables, text).length == 0.00635


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("7", 7),
        ("7.5", 7.5),
        ("true", True),
        ("[1, 2]", [1, 2]),
        ('"7"', "7"),
        ("{a = 1}", {"a": 1}),
        ("hello world", "hello world"),
        ("", ""),
        ("08", "08"),
        ("2 rev/s", "2 rev/s"),
        ('"a" # b', "a"),
        ("1\nformat = 2", "1\nformat = 2"),
        ("[" * 5000, "[" * 5000),
        ("9" * 5000, "9" * 5000),
        ("[1,", "[1,"),
        ("x=y", "x=y"),
    ],
)
def test_a_value_is_toml_or_else_text(text, value):
    assert read_value(text) == value


def test_later_changes_win_and_tables_come_into_being(tables):
    del tables["spring"]
    spec = spec_with(tables, "turns=2", "turns=5", "spring.rate=2", "drive.sense=forward", "title=two words", "weights=[1, 2.5]")
    assert (spec.turns, spec.spring.rate, spec.drive.sense, spec.title, spec.weights) == (5, 2.0, "forward", "two words", (1.0, 2.5))


def test_list_elements_go_by_name_or_by_number(tables):
    spec = spec_with(
        tables,
        "joints.rocker.clearance=7 um",
        "joints.0.at=['3 mm', '4 mm']",
        "points.1.0=0.75",
        "weights.0=9",
        "optimise.unknowns.0.upper=0.2 mm",
    )
    assert [j.clearance for j in spec.joints] == pytest.approx([2e-5, 7e-6], rel=1e-15) and spec.joints[0].at == (0.003, 0.004)
    assert spec.points[1] == (0.75, 0.25) and spec.weights == (9.0,) and spec.optimise.unknowns[0].upper == "0.2 mm"


@pytest.mark.parametrize(
    ("change", "key", "wanted"),
    [
        ("length", None, "--set takes key=value with a dotted key, got 'length'"),
        ("=3", None, "--set takes key=value with a dotted key, got '=3'"),
        ("a..b=3", None, "--set takes key=value"),
        ("drive.=3", None, "--set takes key=value"),
        ("joints.x.clearance=1 mm", "joints.x", "the list has no element 'x'; it has 2, named crank, rocker"),
        (
            "joints.rokcer.clearance=1 mm",
            "joints.rokcer",
            "the list has no element 'rokcer' (did you mean 'rocker'?); it has 2, named crank, rocker",
        ),
        ("joints.2=1", "joints.2", "the list has no element '2'"),
        ("joints.-1=1", "joints.-1", "the list has no element '-1'"),
        ("weights.²=1", "weights.²", "the list has no element '²'; it has 1, numbered from 0 to 0"),
        ("points.0.9=1", "points.0.9", "the list has no element '9'; it has 2, numbered from 0 to 1"),
        ("title.a=1", "title", "is no table, so it has no key 'a'"),
        ("title.a.b=1", "title.a", "is no table"),
        ("length=7", "length", 'unit missing: a length, e.g. "7 mm"'),
        ("drvie.speed=1 rpm", "drvie", "unknown key (did you mean 'drive'?)"),
        ("turns=" + "9" * 5000, "turns", "must be a whole number, got '999"),
    ],
)
def test_a_change_that_cannot_be_made_says_why(tables, change, key, wanted):
    with pytest.raises(SpecError) as caught:
        spec_with(tables, change)
    assert caught.value.key == key and wanted in str(caught.value)


# -- replace -------------------------------------------------------------------------------------------------------------------


def test_replace_takes_plain_keys_and_dotted_ones(tables):
    spec = from_document(tables)
    changed = spec.replace({"joints.rocker.clearance": "7 um", "drive.sense": "forward"}, turns=5)
    assert (changed.joints[1].clearance, changed.drive.sense, changed.turns) == (pytest.approx(7e-6, rel=1e-15), "forward", 5)
    assert changed == spec.replace(**{"joints.1.clearance": "7 um", "drive.sense": "forward", "turns": 5})
    assert spec == from_document(tables) and spec.replace() == spec
    assert changed == spec_with(tables, "joints.rocker.clearance=7 um", "drive.sense=forward", "turns=5")


def test_replace_changes_an_entry_of_a_table_that_the_user_names():
    class Pin(Spec):
        clearance: Length = Field(gt=0)

    class Drive(Spec):
        joints: Named[Pin]

    drive = Drive(joints={"A": Pin(clearance="10 um"), "B": Pin(clearance="10 um")})
    changed = drive.replace({"joints.A.clearance": "20 um"})
    assert [pin.clearance for pin in changed.joints.values()] == pytest.approx([2e-5, 1e-5])
    assert drive.joints["A"].clearance == pytest.approx(1e-5)


@pytest.mark.parametrize(
    ("changes", "key", "wanted"),
    [
        ({"drive.sped": "1 rpm"}, "drive.sped", "unknown key (did you mean 'speed'?)"),
        ({"drvie.speed": "1 rpm"}, "drvie", "unknown key (did you mean 'drive'?)"),
        ({"drive.speed": "3 mm"}, "drive.speed", "angular speed"),
        ({"length": 7}, "length", 'unit missing: a length, e.g. "7 mm"'),
        ({"joints.x.clearance": "1 mm"}, "joints.x", "the list has no element 'x'; it has 2, named crank, rocker"),
        ({"title.a": 1}, "title", "is no table, so it has no key 'a'"),
    ],
)
def test_replace_says_why_it_cannot_as_set_does(tables, changes, key, wanted):
    with pytest.raises(SpecError) as caught:
        from_document(tables).replace(changes)
    assert caught.value.key == key and wanted in str(caught.value)


def test_changing_keys_changes_the_tables_in_place():
    tables = {"a": {"b": [1, 2]}}
    assert set_key(tables, "a.b.1", 5) is tables and tables == {"a": {"b": [1, 5]}}
    assert set_key(tables, "c.d.e", 1)["c"] == {"d": {"e": 1}}


@pytest.mark.parametrize(
    ("key", "name"),
    [
        ("length", "length"),
        ("drive.speed", "angular speed"),
        ("joints.0.clearance", "length"),
        ("joints.crank.clearance", "length"),
        ("joints.crank.at.1", "length"),
        ("joints.3.at", "length"),
        ("turns", None),
        ("weights.0", None),
        ("points.0.1", None),
        ("spring", None),
        ("spring.rate", None),
        ("optimise.unknowns.0.lower", None),
    ],
)
def test_the_dimension_of_a_key(key, name):
    exists, dimension = dimension_at(ToySpec, key)
    assert exists and (dimension.name if dimension else None) == name


@pytest.mark.parametrize("key", ["lenght", "drive.sped", "joints.clearance.x", "length.x", "spring.rate.x", "", "joints.0.0.clearance"])
def test_a_key_that_is_none_has_no_dimension(key):
    assert dimension_at(ToySpec, key) == (False, None)


def test_nothing_after_the_equals_sign_removes_a_key():
    from drivewright.spec import change_key

    tables = {"a": {"b": 1, "c": 2}, "list": [{"name": "x", "k": 1}]}
    change_key(tables, "a.b=")
    change_key(tables, "list.x.k= ")
    assert tables == {"a": {"c": 2}, "list": [{"name": "x"}]}
    change_key(tables, 'a.c=""')
    assert tables["a"] == {"c": ""}
    with pytest.raises(SpecError, match="a.zz: is not there, so it cannot be removed"):
        change_key(tables, "a.zz=")
