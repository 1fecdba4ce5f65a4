"""What the analyses of a kind give, collected by running its worked examples: names, labels, meanings and units, without numbers."""

import hashlib
import os
import pickle
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

from drivewright import registry, runner
from drivewright.cli.gallery import examples
from drivewright.reproduction.parts import sources_digest
from drivewright.result import Answer
from drivewright.spec import document, load, read_document
from drivewright.spec.fields import has_user_keys, table_of

PLACEHOLDERS = {"bodies": "BODY", "gears": "GEAR"}  # singular of a table's name, where taking an s away does not give it


class ValueRow(NamedTuple):
    """What a value is."""

    label: str
    meaning: str
    unit: str  # SI
    convention: str


class CheckRow(NamedTuple):
    """What a check demands."""

    label: str
    sense: str
    unit: str
    message: str


class ColumnRow(NamedTuple):
    """What a column of a table is."""

    label: str
    meaning: str
    unit: str


@dataclass
class Found:
    """What one analysis gave, by name pattern; the first example that gives a name describes it."""

    values: dict[str, ValueRow] = field(default_factory=dict)
    checks: dict[str, CheckRow] = field(default_factory=dict)
    tables: dict[str, str] = field(default_factory=dict)  # name -> title
    columns: dict[tuple[str, str], ColumnRow] = field(default_factory=dict)  # (table, column)

    def add(self, other: "Found") -> None:
        """Take over what another example gave besides."""
        for mine, theirs in (
            (self.values, other.values),
            (self.checks, other.checks),
            (self.tables, other.tables),
            (self.columns, other.columns),
        ):
            mine |= {name: row for name, row in theirs.items() if name not in mine}


Collected = dict[str, Found]  # by analysis, in the order of the kind


def example_paths(kind: str) -> list[Path]:
    """The worked examples of a kind."""
    return [path for path in examples().values() if read_document(path)["mechanism"] == kind]


def collect(kinds: Iterable[str], progress: Callable[[str], None], kept: Path) -> dict[str, Collected]:
    """{kind: what its analyses give}, from runs side by side; analyses that run on request are not among them.

    The answer is kept in the file `kept`, and taken from it while neither the package's sources nor the examples change.
    """
    kinds = list(kinds)
    key = sources_digest() + hashlib.sha256(b"".join(path.read_bytes() for path in examples().values())).hexdigest()
    if kept.is_file() and (record := pickle.loads(kept.read_bytes()))[0] == key:
        return record[1]
    collected = _collected(kinds, progress)
    kept.parent.mkdir(parents=True, exist_ok=True)
    kept.write_bytes(pickle.dumps((key, collected)))
    return collected


def _collected(kinds: list[str], progress: Callable[[str], None]) -> dict[str, Collected]:
    paths = [(kind, path) for kind in kinds for path in example_paths(kind)]
    collected = {kind: {analysis.name: Found() for analysis in registry.mechanism(kind).analyses} for kind in kinds}
    with ProcessPoolExecutor(min(os.cpu_count() or 1, len(paths)), mp_context=get_context("spawn")) as pool:
        for number, ((kind, path), found) in enumerate(zip(paths, pool.map(run_example, [path for _, path in paths]), strict=True), 1):
            progress(f"{number} of {len(paths)} examples, {path.stem}")
            for name, each in found.items():
                collected[kind][name].add(each)
    return collected


def run_example(path: Path) -> Collected:
    """What the default analyses of one example give."""
    spec = load(path)
    analyses = runner.select_analyses(registry.mechanism(spec.mechanism).analyses, (), False)
    answers = runner.run_analyses(spec, runner.build(spec), analyses)
    names = dict(user_names(type(spec), document(spec)))
    return {name: _found(answer, names) for name, answer in answers.items()}


def _found(answer: Answer, names: Mapping[str, str]) -> Found:
    """What an answer holds, by name pattern; of each pattern the first."""
    found = Found()
    for name, value in answer.values.items():
        plain = value.plain()
        row = ValueRow(unnamed(plain.label, names), unnamed(plain.meaning, names), plain.unit, plain.convention)
        found.values.setdefault(pattern_of(name, names), row)
    for check in answer.checks:
        row = CheckRow(unnamed(check.display_label, names), check.sense, check.unit, unnamed(check.message, names))
        found.checks.setdefault(pattern_of(check.name, names), row)
    for table in answer.tables:
        place = pattern_of(table.name, names)
        found.tables.setdefault(place, unnamed(table.title, names))
        for column in table.columns:
            about = column.about()
            row = ColumnRow(unnamed(about["label"], names), unnamed(about["meaning"], names), about["unit"])
            found.columns.setdefault((place, pattern_of(column.name, names)), row)
    return found


def user_names(model: type[Any], tables: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """(name, placeholder) of everything that a spec gives a name: "A" of [bearings.A] -> ("A", "BEARING")."""
    for key, field_ in model.model_fields.items():
        given, inner = tables.get(key), table_of(field_.annotation)
        if isinstance(given, dict) and has_user_keys(field_.annotation):
            yield from ((name, placeholder(key)) for name in given)
        entries = list(given.values()) if isinstance(given, dict) and has_user_keys(field_.annotation) else given
        for entry in entries if isinstance(entries, list) else [entries]:
            if isinstance(entry, dict):
                yield from ((entry["name"], placeholder(key)) for _ in [0] if isinstance(entry.get("name"), str))
                yield from user_names(inner, entry) if inner else ()


def placeholder(owner: str) -> str:
    """What stands for the names of a table's entries: "bearings" -> "BEARING"."""
    return PLACEHOLDERS.get(owner, owner.removesuffix("s").upper())


def unnamed(text: str, names: Mapping[str, str]) -> str:
    """A label or sentence with placeholders for quoted names: "Reaction of 'A'" -> "Reaction of 'BEARING'"."""
    return re.sub(r"'([\w-]+)'", lambda quoted: f"'{names.get(quoted[1], quoted[1])}'", text)


def pattern_of(name: str, names: Mapping[str, str]) -> str:
    """A name with placeholders for what users name, and N for a running number: "bearings.A.reaction" -> "bearings.BEARING.reaction"."""
    return ".".join(_step(step, names) for step in name.split("."))


def _step(step: str, names: Mapping[str, str]) -> str:
    if step in names:
        return names[step]
    if step.isdecimal():
        return "N"
    stem = re.sub(r"_\d+$", "", step)
    return names.get(stem, step) if stem != step else step
