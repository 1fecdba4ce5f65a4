"""The reference is complete: every command, option, key of a spec and analysis is on its page."""

import importlib
import re
import sys

import pytest
import typer
from markdown_links import DOCS

from drivewright import registry
from drivewright.cli.app import app
from drivewright.result import Answer, Check, Column, Table, Value
from drivewright.spec.fields import table_of

pytestmark = pytest.mark.interface


@pytest.fixture(scope="module")
def builder():
    """Imports a module of docs/builders."""
    sys.path.insert(0, str(DOCS))
    yield lambda name: importlib.import_module(f"builders.{name}")
    sys.path.remove(str(DOCS))


@pytest.fixture(scope="module")
def pages(tmp_path_factory, builder):
    """The folder of the pages that need no run."""
    docs = tmp_path_factory.mktemp("docs")
    for name in ("reference_commands", "reference_keys"):
        builder(name).build(docs, lambda doing: None)
    return docs / "reference"


def test_every_command_and_option_is_there(pages):
    text = (pages / "commands.md").read_text(encoding="utf-8")
    root = typer.main.get_command(app)
    names = root.list_commands(typer.Context(root))
    assert {"run", "sweep", "fit-stiffness"} <= set(names)
    assert set(re.findall(r"^## drivewright ([\w-]+)$", text, flags=re.MULTILINE)) == set(names)
    section = text.partition("## drivewright run\n")[2].partition("\n## ")[0]
    options = [spelling for each in root.get_command(typer.Context(root), "run").params for spelling in each.opts if spelling[0] == "-"]
    assert len(options) > 8 and all(f"`{option}`" in section for option in options)


def fields_below(model, seen):
    """(table class, key) of every key below a table class, each class once."""
    if model in seen:
        return
    seen.add(model)
    for name, field in model.model_fields.items():
        inner = table_of(field.annotation)
        if inner:
            yield from fields_below(inner, seen)
        else:
            yield model, name, field


@pytest.mark.parametrize("kind", registry.kinds())
def test_every_key_is_there_with_its_meaning(pages, kind):
    text = (pages / f"spec-{kind}.md").read_text(encoding="utf-8") + (pages / "spec-shared.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", text, flags=re.MULTILINE))
    found = [(model.__name__, name) for model, name, _ in fields_below(registry.mechanism(kind).spec, set()) if name not in rows]
    assert found == []
    assert all(cells.split(" | ")[0].strip() for cells in rows.values()), "a key without a meaning"


def test_dimension_drawings_stand_where_they_are(builder, tmp_path):
    drawings = tmp_path / "img" / "dimensions"
    drawings.mkdir(parents=True)
    assert list(builder("reference_keys")._drawings("cam", tmp_path)) == []
    for name in ("cam-flat.svg", "cam.svg", "camshaft.svg"):
        (drawings / name).touch()
    text = "\n".join(builder("reference_keys")._drawings("cam", tmp_path))
    assert re.findall(r"dimensions/([\w.-]+)\)", text) == ["cam.svg", "cam-flat.svg"]


def test_names_of_users_become_placeholders(builder):
    collected = builder("collected")
    names = {"A": "BEARING", "slider": "BODY"}
    assert collected.pattern_of("bearings.A.reaction", names) == "bearings.BEARING.reaction"
    assert collected.pattern_of("bearings.A_2.life", names) == "bearings.BEARING.life"
    assert collected.pattern_of("modes.12.frequency", names) == "modes.N.frequency"
    assert collected.unnamed("Reaction of 'A'; a sliderless 'other'", names) == "Reaction of 'BEARING'; a sliderless 'other'"


def test_what_an_answer_holds_is_found(builder):
    collected = builder("collected")
    table = Table("motion", "Motion", (Column("time", "s", "time", [0.0, 1.0]),))
    check = Check("stress.A", 1.0, 2.0, "<=", "Pa", "stress of 'A', of all loads")
    answer = Answer({"A.force": Value(1.0, "N", "force on 'A', magnitude")}, (table,), (check,))
    found = collected._found(answer, {"A": "PIN"})
    assert found.values["PIN.force"].label == "Force on 'PIN'" and found.values["PIN.force"].unit == "N"
    assert found.checks["stress.PIN"].label == "Stress of 'PIN'"
    assert found.tables == {"motion": "Motion"} and found.columns["motion", "time"].unit == "s"


def test_lists_of_modules_become_lists(builder):
    pytest.importorskip("griffe")
    text = "About.\n\nrack      cuts a gear,\n          and more\n`a`, `b`   two\n\nEnd."
    lines = builder("docstrings").listed(text).splitlines()
    assert "- `rack`: cuts a gear, and more" in lines and "- `a`, `b`: two" in lines and lines[-1] == "End."


def test_a_table_has_no_column_that_is_empty_in_all_rows(builder):
    table = builder("markdown").table
    assert table(("a", "b", "c"), [("1", "", "3"), ("4", "", "")]) == ["", "| a | c |", "|---|---|", "| 1 | 3 |", "| 4 |  |", ""]
    assert table(("a",), []) == []
