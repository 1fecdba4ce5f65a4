"""The form of the studio: every key of every design is in it, and what a box shows reads back to what is given."""

import json
import math
import tomllib
from functools import cache

import pytest
from places import EXAMPLES
from pydantic import BaseModel, Field
from spec_cases import FULL, install

from drivewright import registry
from drivewright.spec import read_document, set_key
from drivewright.studio.design import Design
from drivewright.studio.field_info import ABSENT, field_info_at, field_infos, parse_text, plain_text
from drivewright.studio.form import changed_fields, form, values
from drivewright.studio.input_parsing import form_key, value_in
from drivewright.studio.sliders import Limits, slider, tidied, typical
from drivewright.units import any_quantity

pytestmark = pytest.mark.interface

PRESETS = [path for kind in registry.kinds() for path in registry.mechanism(kind).presets().values()]
SPECS = [*sorted(EXAMPLES.rglob("*.toml")), *PRESETS]


@cache
def opened(path):
    design = Design(read_document(path), path.parent)
    return design, design.spec(), form(design)


@pytest.fixture
def toy(monkeypatch, tmp_path):
    install(monkeypatch, tmp_path)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n1,1\n")
    field_infos.cache_clear()
    return Design(tomllib.loads(FULL), tmp_path)


def group(made, key):
    return next(each for each in made["groups"] if each["key"] == key)


def leaves(value, path=()):
    """(key of the form, value) of all that is no table, lists of values as one."""
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from leaves(getattr(value, name), (*path, name))
    elif isinstance(value, dict) or (isinstance(value, tuple) and value and isinstance(value[0], BaseModel)):
        for step, entry in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(entry, (*path, str(step)))
    elif path not in (("mechanism",), ("format",)):
        yield ".".join(path), value


def si(info, value):
    """A raw value as the spec has it."""
    if isinstance(value, list):
        return tuple(si(info.items[min(n, len(info.items) - 1)] if info.items else info, entry) for n, entry in enumerate(value))
    return info.dimension.parse(value) if info.dimension else value


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_every_value_of_the_effective_spec_is_in_the_form(path):
    design, spec, made = opened(path)
    fields, tables = values(made), {each["key"]: each for each in made["groups"]}
    found = 0
    for key, value in leaves(spec):
        key = form_key(design.tables, key)
        if key in tables:  # a table or a list of them that is not there
            assert value in (None, (), {}) and not tables[key]["fields"]
            continue
        field, info = fields[key], field_info_at(type(spec), key.split("."))
        shown = field["value"]
        if field["kind"] == "file":
            assert (shown and (path.parent / shown).resolve()) == value
        elif field["kind"] == "quantity" and isinstance(shown, float):
            assert any_quantity(f"{shown!r} {field['unit']}")[0] == pytest.approx(value, rel=1e-14)
        elif info.dimension or field["kind"] == "list":
            assert (si(info, shown) if shown is not None else None) in (value, value or None)
        else:
            assert shown == value or field["text"] in (value, str(value))
        found += 1
    assert found > 10


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_what_a_box_shows_reads_back(path):
    design, spec, made = opened(path)
    for key, field in values(made).items():
        info, given = field_info_at(type(spec), key.split(".")), value_in(design.tables, key)
        wanted = info.default if given is ABSENT else given
        assert field["given"] == (given is not ABSENT) or key.rpartition(".")[0] in values(made)
        if field["text"]:
            got = parse_text(info, field["text"], field["text"])
            assert (got, type(got)) == (wanted, type(wanted)), key
        elif wanted not in (None, ""):
            pytest.fail(f"{key} shows nothing of {wanted!r}")


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_the_form_is_plain_and_its_sliders_hold_their_values(path):
    _, _, made = opened(path)
    assert json.loads(json.dumps(made, allow_nan=False)) == made
    assert len({each["key"] for each in made["groups"]}) == len(made["groups"])
    for field in values(made).values():
        if field["slider"]:
            low, high = field["slider"]
            assert low <= field["value"] <= high and 0 < field["step"] <= (high - low)
            assert field["low"] is None or low >= field["low"]
            assert field["high"] is None or high <= field["high"]


def test_absent_tables_lists_and_names_have_groups(toy):
    search = {"unknowns": [{"key": "length", "lower": "1 mm", "upper": "2 mm"}], "objectives": [{"value": "x"}]}
    made = form(toy.changed({"optimise": search}))
    keys = [each["key"] for each in made["groups"]]
    assert keys[0] == "" and keys[-2:] == ["study", "report"]
    assert keys.index("joints") < keys.index("optimise") < keys.index("optimise.unknowns.0")
    study, joints, joint = (group(made, key) for key in ("study", "joints", keys[keys.index("joints") + 1]))
    assert (study["present"], study["optional"], study["fields"]) == (False, True, [])
    assert (joints["role"], joints["present"], joints["depth"]) == ("list", True, 0)
    assert (joint["role"], joint["list"], joint["index"], joint["title"], joint["depth"]) == ("element", "joints", 0, "crank", 1)
    assert not {"mechanism", "format"} & values(made).keys()
    assert {field["key"] for field in joint["fields"]} == {"joints.crank.name", "joints.crank.clearance", "joints.crank.at"}


def test_a_field_says_all_that_a_box_needs(toy):
    field = values(form(toy, {"length": "长度", "joints.*.clearance": "间隙"}))
    length, clearance = field["length"], field["joints.crank.clearance"]
    assert (length["label"], length["zh"], length["unit"], length["value"], length["text"]) == ("length", "长度", "mm", 40.0, "40 mm")
    assert (length["low"], length["high"], length["optional"], length["default"], length["kind"]) == (0, 2000, False, None, "quantity")
    assert length["slider"] == [20, 80]
    assert (clearance["zh"], clearance["default"]) == ("间隙", "0.1 mm")
    assert field["drive.speed"]["unit"] == "rev/s" and field["drive.speed"]["default"] == "100 rpm"
    assert field["drive.sense"]["choices"] == ["forward", "backward"]
    assert field["mirrored"]["value"] is True and field["turns"]["kind"] == "integer" and field["table"]["kind"] == "file"
    assert [part["key"] for part in field["joints.crank.at"]["parts"]] == ["joints.crank.at.0", "joints.crank.at.1"]
    assert field["weights"]["text"] == "3.0" and field["points"]["text"] == "[[0.0, 0.5], [1.0, 0.25]]" and "parts" not in field["weights"]


def test_limits_are_in_the_unit_shown(toy):
    degrees, radians = (values(form(toy.changed({"tilt": text})))["tilt"] for text in ("-30 deg", "-0.5 rad"))
    assert degrees["high"] == pytest.approx(math.degrees(1), rel=1e-11) and (radians["low"], radians["high"]) == (-1, 1)
    assert radians["slider"] == [-1, 1] and degrees["slider"][1] == degrees["high"]
    assert values(form(toy.changed({"length": "4 cm"})))["length"]["slider"] == [2, 8]  # the example "40 mm" is no usual number of cm


@pytest.mark.parametrize(
    ("key", "text", "shown", "value"),
    [
        ("length", "35", "40 mm", "35 mm"),
        ("length", " 35 ", "4 cm", "35 cm"),
        ("length", "35", "", "35 mm"),
        ("length", "35 in", "40 mm", "35 in"),
        ("length", "1,5", "40 mm", "1,5"),
        ("drive.speed", "-3e2", "", "-3e2 rpm"),
        ("turns", "7", "4", 7),
        ("ratio", "0.5", "", 0.5),
        ("mirrored", "false", "true", False),
        ("mirrored", "maybe", "true", "maybe"),
        ("drive.sense", " forward", "", "forward"),
        ("title", "42", "", "42"),
        ("table", "42", "", "42"),
        ("weights", "1, 2.5", "3.0", [1, 2.5]),
        ("weights", "[1, 2.5]", "3.0", [1, 2.5]),
        ("points", "[[0, 1]]", "", [[0, 1]]),
        ("joints.0.at", "3, 4", "1 mm, 2 cm", ["3 mm", "4 cm"]),
        ("joints.0.at", '["3 in", "4 in"]', "1 mm, 2 cm", ["3 in", "4 in"]),
        ("joints.0.at.1", "5", "2 cm", "5 cm"),
        ("joints.0.at.1", "5", "", "5 mm"),
        ("optimise.unknowns.0.lower", "5", "2 cm", "5 cm"),
        ("optimise.unknowns.0.lower", "5", "2", 5),
        ("optimise.settings.0.value", "forward", "", "forward"),
        ("optimise.settings.0.value", "true", "", True),
    ],
)
def test_typed_text_becomes_a_value(toy, key, text, shown, value):
    got = parse_text(field_info_at(type(toy.spec()), key.split(".")), text, shown)
    assert (got, type(got)) == (value, type(value))


@pytest.mark.parametrize("key", ["nothing", "length.0", "drive.nothing", "joints.0", "joints.0.at.2", "weights.0.1", "spring"])
def test_where_no_value_stands_there_is_no_fact(toy, key):
    info = field_info_at(type(toy.spec()), key.split("."))
    assert info is None or info.table


def test_a_slider_move_sends_its_field_only(toy):
    before = form(toy)
    after = form(toy.changed({"length": "41 mm", "joints.0.at": ["1 mm", "2 mm"]}), old=before)
    assert changed_fields(before, after) == {key: values(after)[key] for key in ("length", "joints.crank.at")}
    assert changed_fields(before, form(toy, old=before)) == {}
    for changes in ({"joints.0.name": "other"}, {"joints": []}, {"study": {}}):
        assert changed_fields(before, form(toy.changed(changes), old=before)) is None


def test_a_range_stays_while_the_value_moves_in_it_and_follows_a_unit(toy):
    before = form(toy)
    made = [values(form(toy.changed({"length": text}), old=before))["length"] for text in ("79 mm", "21 mm", "81 mm", "50 cm")]
    assert [each["slider"] for each in made[:2]] == [[20, 80]] * 2
    assert made[2]["slider"][1] > 81 and made[3]["slider"] == [1, 199]


def test_a_key_of_a_message_finds_its_field(toy):
    assert form_key(toy.tables, "joints.0.clearance") == "joints.crank.clearance" == form_key(toy.tables, "joints.crank.clearance")
    assert form_key(toy.tables, "weights.0") == "weights.0" and form_key(toy.tables, 'a."b c".d') == "a.b c.d"
    twins = {"joints": [{"name": "a"}, {"name": "a"}, {"name": "7"}]}
    assert [form_key(twins, f"joints.{n}.at") for n in range(3)] == ["joints.0.at", "joints.1.at", "joints.2.at"]


def test_of_two_elements_with_one_name_both_ways_mean_the_same():
    tables = {"joints": [{"name": "A", "at": 1}, {"name": "A", "at": 2}, {"name": "B", "at": 3}]}
    set_key(tables, "joints.A.at", 5)
    assert value_in(tables, "joints.A.at") == 5


def test_no_folder_of_the_disk_is_shown(toy, tmp_path):
    field = values(form(toy.changed({"table": str(tmp_path / "lift.csv")})))["table"]
    assert field["text"] == "lift.csv" and str(tmp_path) not in json.dumps({**field, "value": field["text"]})


# -- sliders -------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "limits", "more", "ends", "step"),
    [
        (60.0, Limits(), {}, [30, 150], 0.5),
        (-60.0, Limits(), {}, [-150, -30], 0.5),
        (0.00123, Limits(0.0), {}, [0.0006, 0.0025], 5e-06),
        (1.0, Limits(-57, 57), {"around": 90.0}, [-57, 57], 0.5),
        (1.0, Limits(-57, 57), {"around": 2.0}, [0.5, 2], 0.005),
        (0.3, Limits(0, 0.5), {}, [0, 0.5], 0.002),
        (0.9, Limits(0, 1, open_low=True), {}, [0.005, 1], 0.005),
        (60.0, Limits(0, 180, True, True), {}, [0.5, 179.5], 0.5),
        (16.0, Limits(0, 1e6), {}, [8, 40], 0.1),
        (0.0, Limits(0), {"around": 8.0}, [0, 8], 0.02),
        (0.0, Limits(), {"around": 90.0}, [-100, 100], 1),
        (0.0, Limits(None, 0), {"around": 2.0}, [-2, 0], 0.01),
        (35, Limits(6), {"integer": True}, [15, 80], 1),
        (2, Limits(1, 4), {"integer": True}, [1, 4], 1),
        (1, Limits(0, 2**31), {"integer": True}, [0, 6], 1),
        (20000, Limits(2), {"integer": True}, [10000, 40000], 100),
        (5.0, Limits(4, None), {}, [4, 10], 0.02),
        (5.0, Limits(4, None, True), {}, [4.02, 10], 0.02),
        (5.0, Limits(None, 7.3), {}, [2.5, 7.3], 0.02),
        (1.0, Limits(0, 20), {}, [0, 20], 0.1),
        (1.0, Limits(0, 21), {}, [0.5, 2], 0.005),
        (0.5, Limits(0.3, 0.7), {}, [0.3, 0.7], 0.002),  # whose difference is a little less than 0.4
        (1.0000000000000002, Limits(), {}, [0.5, 2], 0.005),
        (0.001, Limits(0, 1, open_low=True), {}, [0.001, 1], 0.005),
        (0.999, Limits(0, 1, open_high=True), {}, [0, 0.999], 0.005),
        (0.0, Limits(), {"around": -8.0}, [-8, 8], 0.05),
        (10.0, Limits(), {"old": ([2, 10], 0.05)}, [2, 10], 0.05),
        (2.0, Limits(), {"old": ([2, 10], 0.05)}, [2, 10], 0.05),
        (1e-8, Limits(1e-13, 1e-2), {"old": ([5e-9, 2e-8], 5e-11)}, [5e-9, 2e-8], 5e-11),
    ],
)
def test_ranges(value, limits, more, ends, step):
    assert slider(value, limits, **more) == (pytest.approx(ends, rel=1e-12), pytest.approx(step, rel=1e-12))


@pytest.mark.parametrize("value", [0.0, 7.77e-9, -3.3e-4, 0.123456789, 1.0, -99.99, 4711.0, 6.02e23])
@pytest.mark.parametrize("limits", [Limits(), Limits(-1e30), Limits(None, 1e30), Limits(-1e30, 1e30, True, True)])
def test_a_range_holds_its_value_in_some_hundred_short_steps(value, limits):
    (low, high), step = slider(value, limits, around=3.0)
    assert low <= value <= high and 150 < (high - low) / step < 520
    assert all(len(f"{number:.3g}") >= len(f"{number:.10g}") for number in (low, high, step))
    inside = low + (high - low) / 3
    assert slider(inside, limits, old=([low, high], step)) == ([low, high], step)
    outside = min(3 * high - 2 * low, 9e29)
    assert slider(outside, limits, old=([low, high], step))[0] != [low, high]


def test_where_there_is_no_room_there_is_no_slider():
    assert slider(2.0, Limits(2, 2)) is None and slider(math.inf) is None and slider(1e-200) is None and slider(math.nan) is None


def test_steps_of_whole_numbers_are_whole():
    assert repr(slider(20000, Limits(2), integer=True)[1]) == "100"


def test_an_old_range_that_breaks_the_limits_goes():
    assert slider(5.0, Limits(0, 6), old=([2.0, 10.0], 0.05)) == ([0, 6], 0.02)


@pytest.mark.parametrize(
    ("text", "short"),
    [
        ("1.234567890 mm", "1.234567890 mm"),
        ("1.2345678901 mm", "1.23456789 mm"),
        ("0.30000000000000004 mm", "0.3 mm"),
        ("0.30000000000000004", "0.3"),
        ("-12.3 deg", "-12.3 deg"),
        ("1.1e-7", "1.1e-7"),
        ("rigid", "rigid"),
        ("2.9999999999999996e-05 kg m^2", "3e-05 kg m^2"),
        ("12345678.9", "12345678.9"),
    ],
)
def test_numbers_of_a_slider_are_short(text, short):
    assert tidied(text) == short


def test_usual_sizes():
    assert typical("mm") == 10 and typical("mm", -4.0) == 4 and typical("mm", 0.0) == 10 and typical("furlong") == 1


def test_an_open_limit_is_open_on_its_own_side():
    class Both(BaseModel):
        """Limits of either sort."""

        above: float = Field(1.0, gt=0, le=2)
        below: float = Field(1.0, ge=0, lt=2)

    found = field_infos(Both)
    assert found["above"].limits == Limits(0, 2, True, False) and found["below"].limits == Limits(0, 2, False, True)


@pytest.mark.parametrize(("value", "text"), [(3.0, "3"), (-2.0, "-2"), (0.5, "0.5"), (1e20, "1e+20"), (None, ""), ("3 mm", "3 mm")])
def test_numbers_as_people_write_them(value, text):
    assert plain_text(value) == text
