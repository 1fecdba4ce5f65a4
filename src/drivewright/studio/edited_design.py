"""The design of one tab: changed in worker processes, drawn and analysed, and shown to the page."""

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

from drivewright.errors import SpecError
from drivewright.execution.workers import WorkerDied
from drivewright.report.dimension_drawings import fitting_drawings
from drivewright.studio import editing, translations
from drivewright.studio.computations import TabComputations
from drivewright.studio.design import Design
from drivewright.studio.document import Document
from drivewright.studio.editing import Edited
from drivewright.studio.error_text import without_folder
from drivewright.studio.offers import presets
from drivewright.studio.outbox import Message, Outbox
from drivewright.studio.resources import ServerResources
from drivewright.studio.tab_jobs import TabJobs

SHORT = 20_000  # characters of a message that the loop itself reads
LONGEST_KEY = 500  # characters
PATIENCE = 60.0  # seconds that a change of a design may take, the start of its process included
ALL = "*"  # every complaint is settled


class EditedDesign:
    """The document of a tab, its computations and its jobs.

    `send(message)` reaches the page; `start` is the design that the studio was opened with, and `name` that of its file.
    """

    def __init__(self, send: Callable[[Message], object], resources: ServerResources, start: Design, name: str = "") -> None:
        self.send, self.resources, self.start, self.start_name = Outbox(send), resources, start, name
        self._document: Document | None = None
        self.gen = 0
        self._kept, self._kind = b"", ""
        self.computations = TabComputations(self.send, self._describe, resources)
        self.jobs = TabJobs(self.send, self._describe, resources)

    @property
    def document(self) -> Document:
        """The design with its past; there is one as soon as the page has said hello."""
        assert self._document is not None
        return self._document

    @property
    def files(self) -> str:
        """Token of the folder that the page has sent the data files of the design into, "" where it has none."""
        folder = self._document.design.folder if self._document else None
        return folder.name if folder and self.resources.folder(folder.name) == folder else ""

    # -- changes ----------------------------------------------------------------------------------------------------------------

    async def _call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """What a worker process makes of it; another one where the first died, as one may for the memory that others take."""
        async with self.resources.reading.worker(self) as worker:
            with suppress(WorkerDied):
                return await worker.call(function, *arguments, limit=PATIENCE)
            return await worker.call(function, *arguments, limit=PATIENCE)

    async def _edited(self, change: str, **arguments: Any) -> Edited:
        """A change of the document in a worker process, taken over."""
        edited = await self._call(editing.edit, self.document.present(), self._kept, change, arguments)
        self.document.follow(change, edited.document)
        self._kept = edited.kept
        return edited

    def _open(self, edited: Edited) -> None:
        """A design that has nothing to do with the one before, which a step back brings again."""
        if self._document is not None:
            edited.document.continue_from(self._document)
        self._document, self._kept = edited.document, edited.kept
        self._changed(edited, ALL, opened=True)

    def _changed(self, edited: Edited, *settled: str, opened: bool = False, moving: bool = False) -> None:
        """Draw it, and show its form; `moving`: a hand moves it, and the next change follows."""
        self.gen += 1
        opened = opened or self.document.design.kind != self._kind
        if opened:
            self._kind = self.document.design.kind
            self.computations.reset(self.gen)
            self.jobs.cancel_all()
        self.computations.update(self.gen, self.document.design, moving)
        self._show(edited, settled, opened, moving)

    # -- telling ----------------------------------------------------------------------------------------------------------------

    def _show(self, edited: Edited, settled: Sequence[str] = (), opened: bool = False, moving: bool = False) -> None:
        """The form; only the fields that differ, where nothing else does; unless a hand moves it, with the text of the spec and the
        names of its dimension drawings."""
        document, design = self.document, self.document.design
        common = {
            "gen": self.gen,
            "undo": document.can_undo,
            "redo": document.can_redo,
            "locks": sorted(document.locks),
            "changed": document.changed,
            "files": self.files,
            "settled": list(settled),
            **({} if moving else {"toml": design.text(), "drawings": fitting_drawings(design.kind, design.tables)}),
        }
        if edited.fields is not None:
            tell = self.send.hold if moving else self.send
            tell({"what": "values", "fields": edited.fields, **common})
            return
        self.send(
            {
                "what": "design",
                "kind": design.kind,
                "title": str(design.tables.get("title", "")),
                "name": document.name,
                "presets": presets(design.kind),
                "form": edited.form,
                "words": translations.texts(design.kind),
                "opened": opened,
                **common,
            }
        )

    def _refuse(self, error: Exception, key: str = "", text: str = "") -> None:
        self.send({"what": "refused", "key": key[:LONGEST_KEY], "text": text[:SHORT], "message": self._describe(error, key)})

    def _describe(self, error: Exception, key: str | None = None) -> str:
        """An error in words, without folders of this machine, and without the key where it stands beside its field."""
        beside = key and getattr(error, "key", None) == key
        folder = (self._document.design if self._document else self.start).folder
        return without_folder(error.message if isinstance(error, SpecError) and beside else str(error), folder)
