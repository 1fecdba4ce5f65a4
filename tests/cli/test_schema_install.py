"""A folder set up for editors: schemas, associations of its specs, and nothing of a person's written over."""

import json
import re
import tomllib

import pytest
from places import EXAMPLES

from drivewright.cli import main
from drivewright.cli.editors import ASSOCIATIONS
from drivewright.spec import read_document, schema

pytestmark = pytest.mark.interface


def install(folder, *arguments):
    """Exit code of the command."""
    with pytest.raises(SystemExit) as end:
        main(["schema", "--install", "--out", str(folder), *arguments])
    return end.value.code or 0


@pytest.fixture
def folder(tmp_path):
    """A project with a cam, a shaft in a folder below whose name has a blank, and files that are no specs."""
    (tmp_path / "my shafts").mkdir()
    (tmp_path / "cam.toml").write_bytes((EXAMPLES / "disc_cam.toml").read_bytes())
    (tmp_path / "my shafts" / "spindle.toml").write_bytes((EXAMPLES / "spindle.toml").read_bytes())
    (tmp_path / "pyproject.toml").write_text('[project]\nname = "x"\n')
    (tmp_path / "broken.toml").write_text("mechanism = ")
    return tmp_path


def schema_of(folder, path):
    """The schemas that settings.json associates with a file."""
    settings = json.loads((folder / ".vscode" / "settings.json").read_text())
    return [address for pattern, address in settings[ASSOCIATIONS].items() if re.search(pattern, (folder / path).as_uri())]


def test_specs_are_associated_with_the_schema_of_their_kind(folder):
    assert install(folder) == 0
    for path, kind in (("cam.toml", "cam"), ("my shafts/spindle.toml", "shaft"), ("new.linkage.toml", "linkage")):
        assert schema_of(folder, path) == [(folder / ".drivewright" / f"{kind}.schema.json").as_uri()]
    assert schema_of(folder, "pyproject.toml") == schema_of(folder, "broken.toml") == []
    rules = tomllib.loads((folder / ".taplo.toml").read_text())["rule"]
    assert ["**/*.shaft.toml", "my shafts/spindle.toml"] in [rule["include"] for rule in rules]
    for rule in rules:
        assert json.loads((folder / rule["schema"]["path"]).read_text())["title"].startswith("Drivewright ")


def test_settings_are_merged_and_old_associations_replaced(folder):
    (folder / ".vscode").mkdir()
    settings = folder / ".vscode" / "settings.json"
    stale = {"^.*/gone\\.toml$": "file:///elsewhere/.drivewright/cam.schema.json", "^x$": "https://a.b/c.json"}
    settings.write_text(json.dumps({"editor.tabSize": 2, ASSOCIATIONS: stale}))
    assert install(folder, "cam") == 0
    merged = json.loads(settings.read_text())
    assert merged["editor.tabSize"] == 2 and merged[ASSOCIATIONS]["^x$"] == "https://a.b/c.json"
    assert "^.*/gone\\.toml$" not in merged[ASSOCIATIONS] and len(merged[ASSOCIATIONS]) == 2
    again = settings.read_text()
    assert install(folder, "cam") == 0 and settings.read_text() == again


@pytest.mark.parametrize("text", ['{\n  // tabs\n  "editor.tabSize": 2,\n}\n', "[]", f'{{"{ASSOCIATIONS}": 3}}'])
def test_settings_that_are_not_plain_json_are_left_alone(folder, capsys, text):
    (folder / ".vscode").mkdir()
    (folder / ".vscode" / "settings.json").write_text(text)
    assert install(folder) == 1 and (folder / ".vscode" / "settings.json").read_text() == text
    said = capsys.readouterr().err
    assert "left alone; add to it" in said and ASSOCIATIONS in said


def test_a_taplo_file_of_a_person_is_left_alone(folder, capsys):
    (folder / ".taplo.toml").write_text("[formatting]\n")
    assert install(folder) == 1 and (folder / ".taplo.toml").read_text() == "[formatting]\n"
    assert "[[rule]]" in capsys.readouterr().err


def test_a_new_spec_names_its_schema_where_there_is_one(folder):
    for number, first in enumerate(("#:schema", "# Disc")):
        path = folder / f"new{number}.toml" if first == "#:schema" else folder / "my shafts" / "new.toml"
        install(folder)
        with pytest.raises(SystemExit) as end:
            main(["new", "cam", str(path)])
        assert not end.value.code and path.read_text().startswith(first) and read_document(path)["mechanism"] == "cam"


def test_a_schema_wants_a_kind(capsys):
    with pytest.raises(SystemExit) as end:
        main(["schema"])
    assert end.value.code == 2 and "name a kind of drive" in capsys.readouterr().err


@pytest.mark.parametrize("path", sorted(EXAMPLES.rglob("*.toml")), ids=lambda path: path.stem)
def test_the_schema_accepts_every_example(path):
    jsonschema = pytest.importorskip("jsonschema")
    data = read_document(path)
    checker = jsonschema.Draft202012Validator(schema(data["mechanism"])) if data["mechanism"] != "fit-stiffness" else None
    assert checker is None or [error.message for error in checker.iter_errors(data)] == []
    assert checker is None or list(checker.iter_errors({**data, "tytle": "x"}))
