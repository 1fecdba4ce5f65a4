"""The commented template and the JSON schema, for every kind that is installed and for a spec with every sort of key."""

import json
import tomllib

import pytest
from spec_cases import FULL, ToySpec, install

from drivewright import registry
from drivewright.errors import SpecError, UnknownName
from drivewright.spec import document, from_document, load, preset_path, schema, template
from drivewright.spec.fields import dimension_of, table_of

pytestmark = pytest.mark.interface

PRESETS = [(kind, name) for kind in registry.kinds() for name in registry.mechanism(kind).presets()]


@pytest.fixture
def toy(monkeypatch, tmp_path):
    install(monkeypatch, tmp_path)
    (tmp_path / "presets").mkdir()
    (tmp_path / "presets" / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n1,1\n")
    (tmp_path / "presets" / "full.toml").write_text(FULL)
    return tmp_path


def every_key(model, path=""):
    for name, field in model.model_fields.items():
        yield name, field
        if inner := table_of(field.annotation):
            yield from every_key(inner, f"{path}{name}.")


def code(line):
    """The part of a line before its comment, the # of a switched-off key taken away; '' for prose."""
    line = line.removeprefix("#")
    return "" if line.startswith(" ") else line.split("  #")[0].strip()


@pytest.mark.parametrize(("kind", "preset"), PRESETS)
def test_a_template_reads_back_as_its_preset(kind, preset):
    path = preset_path(kind, preset)
    spec = from_document(tomllib.loads(template(kind, preset)), folder=path.parent)
    assert spec == load(path) and spec.digest() == load(path).digest()


@pytest.mark.parametrize("kind", registry.kinds())
def test_every_preset_and_every_kind_has_a_default_and_names_itself(kind):
    assert "default" in registry.mechanism(kind).presets() and '(preset "default")' in template(kind)
    assert template(kind) == template(kind, "default")


@pytest.mark.parametrize(("kind", "preset"), PRESETS)
def test_a_template_fits_a_terminal_and_has_every_key(kind, preset):
    lines = template(kind, preset).splitlines()
    assert max(map(len, lines)) <= 118 and not any(line != line.rstrip() for line in lines)
    keys = [code(line).partition(" = ")[0] for line in lines if " = " in code(line)]
    headings = [code(line).strip("[]") for line in lines if code(line).startswith("[")]
    for name, field in every_key(registry.mechanism(kind).spec):
        assert any(name in h.split(".") for h in headings) if table_of(field.annotation) else name in keys, name


@pytest.mark.parametrize(("kind", "preset"), PRESETS)
def test_a_switched_off_key_can_be_switched_on(kind, preset):
    """One by one: those at their default change nothing, those without one change only what they name."""
    lines, path = template(kind, preset).splitlines(), preset_path(kind, preset)
    plain = load(path)
    off = [n for n, line in enumerate(lines) if line.startswith("#") and " = " in code(line)]
    table_off = next((n for n, line in enumerate(lines) if line.startswith("#[")), len(lines))
    for number in [n for n in off if n < table_off]:
        text = "\n".join([*lines[:number], lines[number].removeprefix("#"), *lines[number + 1 :]])
        try:
            spec = from_document(tomllib.loads(text), folder=path.parent)
        except SpecError as error:
            assert any(file in str(error) for file in ("data.csv", "logo.svg")), lines[number]
            continue
        comment = " ".join(line.strip() for line in lines[number : number + 3])
        assert spec == plain or "no default]" in comment, lines[number]


# A crank alone has no second joint and no output, which drives and sections of phase space name.
@pytest.mark.parametrize(("kind", "preset"), [pair for pair in PRESETS if pair != ("linkage", "crank")])
def test_all_switched_on_at_once_is_a_complete_spec(kind, preset):
    lines = [code(line) for line in template(kind, preset).splitlines() if "data.csv" not in line and "logo.svg" not in line]
    spec = from_document(tomllib.loads("\n".join(lines)), folder=preset_path(kind, preset).parent)
    assert spec.optimise is not None and not [name for name, value in document(spec).items() if value is None]


def test_limits_units_defaults_and_choices_are_in_words(toy):
    text = " ".join(line.strip().removeprefix("#   ") for line in template("toy").splitlines())  # wrapped comments in one
    for wanted in (
        '# A toy (preset "full").',
        'length = "40 mm"',
        "# length  [0 < length < 2000 mm]",
        '# tilt  [-1 rad <= angle <= 1 rad; default "0 deg"]',
        "# turns  [1 <= whole number <= 9; default 3]",
        "# ratio  [0 < number <= 1; default 0.5]",
        "# mirrored  [true or false; default false]",
        "# weights  [list of number; default [1.0, 2.0]]",
        '# sense  ["forward" or "backward"; default "forward"]',
        "# version of the file format  [1; default]",
        '# speed  [angular speed > 0; default "100 rpm"]',
        "# points  [list of list of number; no default]",
        "# second table  [file; no default]",
        "# place  [list of 2 x length; no default]",
        '# radial play  [length >= 0; default "0.1 mm"]',  # explained where the list begins, not again
        "# lower bound, in the key's own unit  [number or quantity]",
    ):
        assert wanted in text, wanted
    assert text.count("[[joints]]") == 2 and text.index("[optimise]") > text.rindex("[[joints]]")


def test_without_a_preset_the_template_is_made_of_samples(monkeypatch, tmp_path):
    install(monkeypatch, tmp_path)
    text = template("toy")
    spec = from_document(tomllib.loads(text))
    assert spec.length == 0.04 and spec.joints == () and preset_path("toy") is None
    assert "#[spring]" in text and "#rate = 2.0" in text and '#at = ["1 mm", "1 mm"]' in text and "#points = [[1.0, 1.0]]" in text
    with pytest.raises(UnknownName, match="preset of toy"):
        template("toy", "full")


def test_an_unknown_preset_or_kind_is_refused_with_the_nearest():
    with pytest.raises(UnknownName, match="no preset of cam is called 'defualt' .did you mean 'default'"):
        template("cam", "defualt")
    with pytest.raises(UnknownName, match="did you mean 'cam'"):
        template("camm")


# -- schema --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", registry.kinds())
def test_the_schema_is_valid_and_accepts_the_presets(kind):
    jsonschema = pytest.importorskip("jsonschema")
    found = schema(kind)
    jsonschema.Draft202012Validator.check_schema(found)
    checker = jsonschema.Draft202012Validator(found)
    for path in registry.mechanism(kind).presets().values():
        assert not list(checker.iter_errors(tomllib.loads(path.read_text()))) and not list(checker.iter_errors(document(load(path))))
        assert list(checker.iter_errors({**tomllib.loads(path.read_text()), "typo": 1}))


@pytest.mark.parametrize("kind", registry.kinds())
def test_the_schema_is_json_and_every_reference_has_an_end(kind):
    found = json.loads(json.dumps(schema(kind), allow_nan=False))
    text = json.dumps(found)
    assert found["$schema"] == "https://json-schema.org/draft/2020-12/schema" and found["additionalProperties"] is False
    for name in {part.split('"')[0] for part in text.split("#/$defs/")[1:]}:
        assert name in found["$defs"]


def test_the_schema_says_units_limits_and_defaults_as_a_file_has_them(toy):
    found = schema("toy")
    length, drive = found["properties"]["length"], found["$defs"]["Drive"]
    assert (length["type"], length["x-dimension"], length["x-unit"], length["x-si-unit"], length["x-gt"], length["x-lt"]) == (
        "string",
        "length",
        "mm",
        "m",
        0,
        2,
    )
    assert (
        found["properties"]["drive"]["default"] == {"speed": "100 rpm", "sense": "forward"}
        and drive["properties"]["speed"]["default"] == "100 rpm"
    )
    assert found["required"] == ["length"] and dimension_of(ToySpec.model_fields["tilt"]).name == "angle"
    assert found["$defs"]["Unknown"]["properties"]["lower"]["type"] == ["string", "number"]
