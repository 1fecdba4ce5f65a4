"""A `Case` of a number: its files, and how it enters the program."""

import contextlib
import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .bases import CHEAP, Base, bases, cut_costs
from .damage import damaged_tables, damaged_text, text_of
from .files import damaged_file, write_file
from .values import TEXTS, other_value

SPEC = "spec.toml"
EXPORTED = ("cam", "linkage")  # kinds whose export takes seconds
NAMES = ("-x.toml", "\u202etoml.x", "a\nb.toml", "\udcff.toml", "é.toml", "a b.toml", "x" * 255, "=1.toml", ".toml", "x.toml/")


@dataclass(frozen=True)
class Case:
    """Files {name: bytes, or what is there in their place}, and an entry: "load", "run" or the arguments of a command line."""

    number: int
    base: str
    kind: str
    files: dict[str, Any]
    entry: str
    arguments: tuple[str, ...] = ()
    only: tuple[str, ...] = ()


def case_of(number: int) -> Case:
    """The case of a number; the same number always gives the same case."""
    rng = np.random.default_rng([20260101, number])
    base = bases()[number % len(bases())]
    entry = ("load", "run", "command")[int(rng.choice(3, p=(0.4, 0.35, 0.25)))]
    content = _spec(base, entry, rng)
    files = {SPEC: content, **_data_files(base, rng)}
    only = CHEAP.get(base.kind, ())
    if entry != "command":
        return Case(number, base.path.name, base.kind, files, entry, only=only)
    name = NAMES[int(rng.integers(len(NAMES)))] if rng.random() < 0.1 else SPEC
    if name != SPEC:
        files[name] = files.pop(SPEC)
    return Case(number, base.path.name, base.kind, files, entry, _arguments(base, name, only, rng), only)


def _spec(base: Base, entry, rng):
    if entry == "load" and rng.random() < 0.4 or rng.random() < 0.05:
        return damaged_text(base.text, rng)
    whole = entry == "command" and rng.random() < 0.5
    tables = copy.deepcopy(base.tables) if whole else damaged_tables(base.tables, rng)
    if entry != "load":
        cut_costs(tables)
    return text_of(tables).encode("utf-8", "surrogatepass")


def _data_files(base: Base, rng):
    """The data files of a base; one of them damaged now and then."""
    files = {path.relative_to(base.path.parent).as_posix(): path.read_bytes() for path in base.path.parent.rglob("*.csv")}
    named = [name for name in files if name in base.text]
    if named and rng.random() < 0.5:
        chosen = named[int(rng.integers(len(named)))]
        return {name: files[name] for name in named} | {chosen: damaged_file(files[chosen], rng)}
    return {name: files[name] for name in named}


def _arguments(base: Base, name, only, rng):
    """The arguments of a command line about a spec file."""
    changes = [part for _ in range(int(rng.integers(0, 3))) for part in ("--set", _change(base.tables, rng))]
    analyses = ("--only", ",".join(only)) if only else ()
    commands = (
        ("run", name, "--no-figures", "--json", "--out", "out", *analyses),
        ("run", name, "--out", "out", "--strict", *analyses),
        ("run", name, "--only", "nothing"),
        ("run", name, name),
        ("sweep", name, "--vary", _change(base.tables, rng, vary=True), "--sample", "2", "--on", "serial", "--no-figures", *analyses),
        ("export", name, "--to", "csv,dxf,svg", "--anyway", "--out", "out") if base.kind in EXPORTED else ("verify", "nothing.toml"),
        ("export", name, "--to", TEXTS[int(rng.integers(len(TEXTS)))]),
        ("table", "."),
        ("optimise", name, "--on", "serial") if "optimise" not in base.tables else ("table", name),
        ("new", base.kind, name),
        ("schema", TEXTS[int(rng.integers(len(TEXTS)))].replace("\0", "")),
    )
    chosen = commands[int(rng.choice(len(commands), p=[0.4, 0.14, 0.03, 0.03, 0.14, 0.14, 0.02, 0.02, 0.04, 0.02, 0.02]))]
    return tuple(part.replace("\0", "") for part in (*chosen, *(changes if chosen[0] in ("run", "sweep", "export", "optimise") else ())))


def _change(tables, rng, vary=False):
    """A key of a spec with another value, as `--set` or `--vary` takes it."""
    steps, place = [], tables
    while isinstance(place, (dict, list)) and place:
        keys = list(place) if isinstance(place, dict) else list(range(len(place)))
        step = keys[int(rng.integers(len(keys)))]
        steps.append(str(step))
        place = place[step]
    key = ".".join(steps)
    key = key if rng.random() < 0.9 else f"{key}.x" if rng.random() < 0.5 else "a." * int(rng.integers(1, 9000)) + key
    value = str(other_value(place, rng))
    if vary:
        value = (f"{place},{value}", f"{place}:{value}:3", "+-" + value, f"normal({place}, {value})", value)[int(rng.integers(5))]
    return f"{key}={value}"


def write_case(case: Case, folder: Path) -> None:
    """The files of a case in a folder."""
    for name, content in case.files.items():
        with contextlib.suppress(OSError):  # a name that no file can have
            write_file(folder / name, content)
