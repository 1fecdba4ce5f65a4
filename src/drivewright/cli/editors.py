"""A folder set up for editors that know TOML schemas: Even Better TOML of Visual Studio Code, and the taplo language server elsewhere.

Schemas go to `.drivewright`, associations of the specs that are there to `.taplo.toml` and `.vscode/settings.json`.  What a person wrote
there stays: settings are merged, and a file that cannot be merged is left alone, and the lines to add are printed.
"""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from drivewright.cli import show
from drivewright.errors import InputError
from drivewright.spec import read_document, schema

FOLDER = ".drivewright"
ASSOCIATIONS = "evenBetterToml.schema.associations"
MARK = "# Written by `drivewright schema --install`, and overwritten by it; put rules of your own into another file."
OURS = re.compile(rf"/{re.escape(FOLDER)}/[^/]+\.schema\.json$")  # addresses of schemas that this module wrote
DEEPEST = 3  # folders below the one that is set up in which specs are looked for
MOST = 2000  # files that are looked at


def install(folder: Path, kinds: Sequence[str]) -> bool:
    """Write schemas and associations; whether everything is in its place.  Notes say what was written and what is left to do."""
    if not folder.is_dir():
        raise InputError(f"{folder}: there is no such folder; make it first")
    (folder / FOLDER).mkdir(exist_ok=True)
    for kind in kinds:
        show.write_text(folder / FOLDER / f"{kind}.schema.json", json.dumps(schema(kind), indent=1) + "\n")
    specs = {kind: [] for kind in kinds} | {kind: paths for kind, paths in specs_of(folder).items() if kind in kinds}
    found = sum(map(len, specs.values()))
    show.note(f"wrote {len(kinds)} schemas to {folder / FOLDER}/; {found} specs found")
    done = [_taplo_rules(folder / ".taplo.toml", specs), _settings(folder / ".vscode" / "settings.json", specs)]
    show.note(f"a spec that comes later: name it NAME.KIND.toml, or begin it with {directive('KIND')}, as `drivewright new` does here")
    return all(done)


def directive(kind: str) -> str:
    """The comment that names a spec's schema, for the first line of the file."""
    return f"#:schema ./{FOLDER}/{kind}.schema.json"


def is_installed(folder: Path, kind: str) -> bool:
    """Whether a folder has the schema of a kind."""
    return (folder / FOLDER / f"{kind}.schema.json").is_file()


def specs_of(folder: Path) -> dict[str, list[str]]:
    """{kind: paths of its specs relative to a folder, with slashes}, not far below it."""
    found: dict[str, list[str]] = {}
    for path in sorted(_files(folder, DEEPEST))[:MOST]:
        kind = _kind_of(path)
        if kind:
            found.setdefault(kind, []).append(path.relative_to(folder).as_posix())
    return found


def _files(folder: Path, depth: int) -> Iterator[Path]:
    """TOML files of a folder and of those below; hidden ones and links are left out."""
    for path in folder.iterdir():
        if path.name.startswith(".") or path.is_symlink():
            continue
        if path.is_dir() and depth:
            yield from _files(path, depth - 1)
        elif path.suffix == ".toml" and path.is_file():
            yield path


def _kind_of(path: Path) -> str:
    """The kind that a file names as its mechanism, "" where it is no spec."""
    try:
        kind = read_document(path).get("mechanism", "")
    except (InputError, OSError):  # a file of another program, or one that is being written
        return ""
    return kind if isinstance(kind, str) else ""


def _taplo_rules(path: Path, specs: Mapping[str, Sequence[str]]) -> bool:
    """Write .taplo.toml; one that is not ours is left alone."""
    text = "\n".join([MARK, *(_rule(kind, paths) for kind, paths in specs.items())])
    if path.exists() and not path.read_text(encoding="utf-8").startswith(MARK):
        show.note(f"{path} exists and is left alone; add to it:\n{text.removeprefix(MARK)}")
        return False
    show.write_text(path, text)
    show.note(f"wrote {path}")
    return True


def _rule(kind: str, paths: Sequence[str]) -> str:
    """One [[rule]] for the specs of a kind."""
    include = json.dumps([f"**/*.{kind}.toml", *paths], ensure_ascii=False)
    return f'\n[[rule]]\ninclude = {include}\n[rule.schema]\npath = "./{FOLDER}/{kind}.schema.json"\nenabled = true\n'


def _settings(path: Path, specs: Mapping[str, Sequence[str]]) -> bool:
    """Merge the associations into settings.json; one that is not plain JSON is left alone.

    Addresses are absolute: the language server takes a relative one for a neighbour of the folder.
    """
    schemas = (path.parents[1] / FOLDER).resolve()
    ours = {_pattern(kind, paths): (schemas / f"{kind}.schema.json").as_uri() for kind, paths in specs.items()}
    try:
        settings = json.loads(path.read_text(encoding="utf-8") or "{}") if path.exists() else {}
        merged = _merged(settings, ours)
    except (ValueError, TypeError):
        missing = json.dumps({ASSOCIATIONS: ours}, indent=4)
        show.note(f"{path} is not plain JSON (it may have comments) and is left alone; add to it:\n{missing}")
        return False
    path.parent.mkdir(exist_ok=True)
    show.write_text(path, json.dumps(merged, indent=4, ensure_ascii=False) + "\n")
    show.note(f"wrote {path}")
    return True


def _merged(settings: Any, ours: Mapping[str, str]) -> dict[str, Any]:
    """The settings with our associations in place of older ones of ours; TypeError where they have another form."""
    others = settings.get(ASSOCIATIONS, {}) if isinstance(settings, dict) else None
    if not isinstance(others, dict):
        raise TypeError("no object")
    kept = {pattern: address for pattern, address in others.items() if not OURS.search(str(address))}
    return {**settings, ASSOCIATIONS: kept | dict(ours)}


def _pattern(kind: str, paths: Sequence[str]) -> str:
    """Regular expression of the addresses of the specs of a kind."""
    named = rf"[^/]+\.{re.escape(kind)}\.toml"
    return f"^.*/({'|'.join([named, *(re.escape(quote(path)) for path in paths)])})$"
