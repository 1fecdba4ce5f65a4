"""The whole spec of one drive: what all kinds have in common."""

import filecmp
import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drivewright import atomic
from drivewright.spec.base import Spec
from drivewright.spec.fields import Field, Integer, Text
from drivewright.spec.optimise_table import Optimise
from drivewright.spec.serialisation import canonical_text, data_file_places, data_files_in, document, toml_text
from drivewright.spec.study_table import Study


class MechanismSpec(Spec):
    """The whole spec of one drive."""

    format: Integer = Field(1, ge=1, le=1, description="version of the file format")
    if TYPE_CHECKING:
        mechanism: Any  # a text, which each kind narrows to its own name
    else:
        mechanism: Text = Field(description="kind of drive")
    title: Text = Field("", description="a name for people")
    optimise: Optimise | None = Field(None, description="unknowns, requirements and objectives for `drivewright optimise`")
    study: Study | None = Field(None, description="what varies from case to case for `drivewright sweep`")

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
        shared = {name: tables.pop(name) for name in ("optimise", "study") if name in tables}
        return tables | shared  # what all kinds share reads best at the end

    def digest(self) -> str:
        """SHA-256 of the canonical effective spec in SI; data files by content; title and study change no number of a run, so they are
        left out."""
        return hashlib.sha256(canonical_text(self, leave_out=("title", "study")).encode()).hexdigest()

    def data_files(self) -> list[Path]:
        """Absolute paths of all data files the spec names."""
        return sorted(set(data_files_in(self)))
