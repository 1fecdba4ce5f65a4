"""The whole spec of one drive: what all kinds have in common."""

import filecmp
import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self

from drivewright import atomic
from drivewright.spec.base import Spec
from drivewright.spec.fields import Field, Integer, Text, value_at
from drivewright.spec.optimise_table import Optimise
from drivewright.spec.readings import readings
from drivewright.spec.report_table import Report
from drivewright.spec.serialisation import canonical_text, data_file_places, data_files_in, document, toml_text
from drivewright.spec.study_table import Study
from drivewright.units import System


class MechanismSpec(Spec):
    """The whole spec of one drive."""

    format: Integer = Field(1, ge=1, le=1, description="version of the file format")
    if TYPE_CHECKING:
        mechanism: Any  # a text, which each kind narrows to its own name
    else:
        mechanism: Text = Field(description="kind of drive")
    title: Text = Field("", description="title shown in reports")
    units: System = Field("mm", description="units shown in reports: mm (mm, N, MPa), si (m, N, Pa) or inch (in, lbf, ksi)")
    optimise: Optimise | None = Field(None, description="unknowns, requirements and objectives for `drivewright optimise`")
    study: Study | None = Field(None, description="what varies from case to case for `drivewright sweep`")
    report: Report | None = Field(None, description="company, logo, author and templates of the reports")

    readings: ClassVar[Mapping[str, str]] = {}  # {key: what its unit, one of another kind, is read as}; each spec has its own

    def _made_from(self, tables: Mapping[str, Any]) -> Self:
        """Readings are kept beside the fields: they belong to the text, and specs that differ in them are equal."""
        if found := readings(self, tables):
            object.__setattr__(self, "readings", found)
        return self

    def replace(self, changes: Mapping[str, Any] | None = None, /, **keys: Any) -> Self:
        """As `Spec.replace`; keys that keep their values keep their readings."""
        spec = super().replace(changes, **keys)
        kept = {key: words for key, words in self.readings.items() if value_at(spec, key) == value_at(self, key)}
        if kept:
            object.__setattr__(spec, "readings", {**kept, **spec.readings})
        return spec

    def to_toml(self, moved: bool = False) -> str:
        """The effective spec as TOML text with units; reads back to an equal spec on this machine, or `moved` beside copies of its data
        files, as `write` makes them."""
        return toml_text(self._tables(data_file_places(self.data_files()) if moved else None))

    def write(self, path: str | Path) -> None:
        """The effective spec as a file, with copies of its data files in `data/` beside it: together they can move to another machine.
        Each file appears whole or not at all."""
        path = Path(path)
        places = data_file_places(self.data_files())
        for source, place in places.items():
            target = path.parent / place
            if not (target.exists() and filecmp.cmp(source, target, shallow=False)):  # it may be the same file
                atomic.copy(source, target)
        atomic.write_text(path, self.to_toml(moved=True))

    def _tables(self, places: Mapping[Path, str] | None = None) -> dict[str, Any]:
        tables = document(self, places)
        shared = {name: tables.pop(name) for name in ("optimise", "study", "report") if name in tables}
        return tables | shared  # what all kinds share reads best at the end

    def digest(self) -> str:
        """SHA-256 of the canonical effective spec in SI; data files by content; title, study, the units shown and the look of reports
        change no number of a run, so they are left out."""
        return hashlib.sha256(canonical_text(self, leave_out=("title", "study", "units", "report")).encode()).hexdigest()

    def data_files(self) -> list[Path]:
        """Absolute paths of all data files the spec names."""
        return sorted(set(data_files_in(self)))
