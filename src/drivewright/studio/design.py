"""A design on its way through the studio: the raw tables of a spec, and the folder that its data files are in."""

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, TypeAlias

from drivewright.errors import MissingFile, SpecError
from drivewright.spec import MechanismSpec, from_document, parse_document, set_key
from drivewright.spec.serialisation import toml_text
from drivewright.studio.source_text import source_text

Tables: TypeAlias = dict[str, Any]  # raw tables as TOML has them


@dataclass(frozen=True)
class Design:
    """Raw tables as TOML has them, quantities as text with unit.  Nobody changes `tables` in place.

    `source` is the text that its author wrote: an earlier state of the tables, with comments.
    `readable` are the data files that the tables may name, None for any: what a page sends must not read the disk.
    """

    tables: Tables
    folder: Path = field(default_factory=Path.cwd)
    readable: frozenset[Path] | None = None
    source: str = ""

    @property
    def kind(self) -> str:
        """Kind of drive."""
        return self.tables.get("mechanism", "")

    def spec(self) -> MechanismSpec:
        """The spec; SpecError where the tables are none, or name a file that is not theirs."""
        try:
            spec = from_document(deepcopy(self.tables), folder=self.folder)
        except MissingFile:
            if self.readable is not None:
                raise _not_here() from None
            raise
        if self.readable is not None and not self.readable.issuperset(spec.data_files()):
            raise _not_here()
        return spec

    def spec_on_screen(self) -> MechanismSpec:
        """The same shown in millimetres: the studio's own fields, sliders and scales are; files are written in the units of the spec."""
        return self.spec().model_copy(update={"units": "mm"})

    def toml(self) -> str:
        """The tables as TOML text, data files as the user named them."""
        return self._toml

    @cached_property
    def _toml(self) -> str:
        return toml_text(self.tables)  # wanted several times for every change

    def text(self, tables: Tables | None = None) -> str:
        """The text of the author with the present tables, or with others such as the tables of a copy; comments stay."""
        return self._text if tables is None else source_text(self.source, tables)

    @cached_property
    def _text(self) -> str:
        return source_text(self.source, self.tables)

    def same_as(self, other: "Design") -> bool:
        """Whether another design has the same values and the same text."""
        if self.tables != other.tables or self.toml() != other.toml():  # equal tables may have another order
            return False
        return self.source == other.source or self.text() == other.text()

    def with_tables(self, tables: Tables) -> "Design":
        """Other tables in the same place."""
        return replace(self, tables=tables)

    def with_text(self, text: str) -> "Design":
        """Another text in the same place; SpecError where it is not TOML."""
        return replace(self, tables=parse_document(text), source=text)

    def changed(self, changes: Mapping[str, Any]) -> "Design":
        """The design with {dotted key: raw value} set; SpecError where a key cannot be entered."""
        tables = deepcopy(self.tables)
        for key, value in changes.items():
            set_key(tables, key, value)
        return self.with_tables(tables)


def _not_here() -> SpecError:
    # The same words whether the file exists or not: a page gets no information about the disk.
    return SpecError("there is no such data file here; open the spec together with the data files that it names")
