"""One tab of the browser: what the page says changes the document, and the page hears what became of it.

Nothing of NiceGUI is in here: `send(message)` reaches the page, `receive(message)` takes what comes from it.
"""

import base64
import zlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from drivewright import registry
from drivewright.errors import DrivewrightError, InputError, SpecError, brief
from drivewright.report.folder import file_name
from drivewright.spec import parse_document, preset_path, read_document
from drivewright.studio import translations
from drivewright.studio.computations import Message, TabComputations
from drivewright.studio.design import Design
from drivewright.studio.document import Document, without_folder
from drivewright.studio.form import changed_fields, form
from drivewright.studio.jobs import JOBS, OPTIONS
from drivewright.studio.resources import ServerResources

LARGEST = 1_000_000  # characters that a page may send as files, or as a shared design
MOST_FILES = 20
ALL = "*"  # every complaint is settled


class Session:
    """The design of one tab.  `start` is the design that the studio was opened with."""

    def __init__(self, send: Callable[[Message], object], resources: ServerResources, start: Design, name: str = "") -> None:
        self.send, self.resources, self.start, self.start_name = send, resources, start, name
        self._document: Document | None = None
        self.gen, self.files = 0, ""
        self._form = self._kind = None
        self.computations = TabComputations(send, self._describe, resources)

    @property
    def document(self) -> Document:
        """The design with its past; there is one as soon as the page has said hello."""
        assert self._document is not None
        return self._document

    def receive(self, message: object) -> None:
        """One message {what, ...} of the page; what it asks wrongly is answered in the words of the command line."""
        arguments = {str(name): value for name, value in message.items()} if isinstance(message, dict) else {}
        action = ACTIONS.get(str(arguments.pop("what", "")))
        if action is None or (self._document is None and action is not ACTIONS["hello"]):
            return
        try:
            action(self, **arguments)
        except DrivewrightError as error:
            key = str(arguments.get("key") or getattr(error, "key", None) or "")
            self.send({"what": "refused", "key": key, "text": str(arguments.get("text", "")), "message": self._describe(error, key)})
        except (TypeError, ValueError, AttributeError, ArithmeticError, LookupError, RecursionError) as error:
            self.send({"what": "refused", "key": "", "text": "", "message": f"the page asked for something odd: {brief(str(error))}"})
        except OSError as error:
            self.send({"what": "refused", "key": "", "text": "", "message": f"a file cannot be kept: {error.strerror}"})

    def close(self) -> None:
        """The tab has gone."""
        self.computations.close()

    # -- beginning -------------------------------------------------------------------------------------------------------------

    def hello(self, saved: str = "", shared: str = "", files: str = "") -> None:
        """A page begins: with what it had before a reload, with the design in its address, or with the start."""
        self.send({"what": "start", "kinds": _kinds(), "words": translations.texts(None)})
        design, trouble = self.start, None
        try:
            if shared or saved:
                design = self._kept(unpacked(shared) if shared else _limited(saved), files)
        except DrivewrightError as error:
            trouble = error
        self._open(design, self.start_name if design is self.start else "")
        if trouble:
            self.send({"what": "refused", "key": "", "text": "", "message": self._describe(trouble)})

    def _kept(self, text: str, files: str) -> Design:
        """The design that a page brings, with the files that it once sent, or those of the start."""
        folder = self.resources.folder(files)
        self.files = files if folder else ""
        place = Design({}, folder, frozenset(folder.iterdir())) if folder else self.start
        design = place.with_tables(parse_document(text))
        design.spec()
        return design

    def again(self) -> None:
        """The connection was lost for a moment: everything once more."""
        self._form = None
        self._changed()

    # -- changing --------------------------------------------------------------------------------------------------------------

    def set(self, key: str, text: str, gesture: str = "") -> None:
        """A value as typed, or as a slider gives it."""
        self.document.set(str(key), str(text), str(gesture))
        self._changed(str(key))

    def unset(self, key: str) -> None:
        """Back to the default, or out."""
        self.document.unset(str(key))
        self._changed(str(key))

    def add(self, list: str) -> None:
        """Another element."""
        self.document.add(str(list))
        self._changed()

    def drop(self, list: str, index: int) -> None:
        """An element less."""
        self.document.drop(str(list), index)
        self._changed(ALL)

    def put(self, table: str) -> None:
        """An optional table in."""
        self.document.put(str(table))
        self._changed()

    def take(self, table: str) -> None:
        """An optional table out."""
        self.document.take(str(table))
        self._changed(ALL)

    def undo(self) -> None:
        """One step back."""
        self.document.undo()
        self._changed(ALL)

    def redo(self) -> None:
        """One step forward."""
        self.document.redo()
        self._changed(ALL)

    def lock(self, key: str, on: bool) -> None:
        """Hold a value."""
        self.document.lock(str(key), bool(on))
        self._show()

    def text(self, toml: str) -> None:
        """The whole spec as text."""
        self.document.text(_limited(toml))
        self._changed(ALL)

    def load(self, changes: Mapping[str, str]) -> None:
        """Several values at once: a row of a study."""
        self.document.load({str(key): str(text) for key, text in changes.items()})
        self._changed(ALL)

    def preset(self, name: str) -> None:
        """Another preset of the same kind."""
        self.document.replace(_preset(self.document.design.kind, name))
        self.document.saved()
        self._changed(ALL)

    # -- files -----------------------------------------------------------------------------------------------------------------

    def fresh(self, kind: str, preset: str | None = None) -> None:
        """Another drive."""
        self.files = ""
        self._open(_preset(kind, preset), "")

    def open(self, files: Sequence[Mapping[str, str]]) -> None:
        """A spec with its data files, as text."""
        given = {file_name(str(file["name"])[-80:]): _limited(file["text"]) for file in files[:MOST_FILES]}
        specs = [name for name in given if name.lower().endswith(".toml")]
        if len(specs) != 1:
            raise InputError(f"open one spec (.toml) and the data files that it names; here are {len(specs)} specs in {len(given)} files")
        _limited("".join(given.values()))
        tables = parse_document(given[specs[0]])
        token, folder = self.resources.new_folder()
        for name, text in given.items():
            (folder / name).write_text(text, encoding="utf-8")
        design = Design(tables, folder, frozenset(folder.iterdir()))
        design.spec()
        self.files = token
        self._open(design, Path(specs[0]).stem)

    def share(self) -> None:
        """The design as the end of an address."""
        design = self.document.design
        if design.spec().data_files():
            raise InputError("a design with data files does not fit into an address; save it and send the file")
        self.send({"what": "shared", "fragment": packed(design.toml())})

    def reference(self, preset: str) -> None:
        """A preset to compare with."""
        design = _preset(self.document.design.kind, preset)
        self.computations.compare_with(str(preset), design)

    # -- computing -------------------------------------------------------------------------------------------------------------

    def job(self, name: str, options: Mapping[str, Any] | None = None) -> None:
        """Begin a job of jobs.JOBS."""
        if name not in JOBS:
            raise InputError(f"there is no job {brief(name)}")
        options = {str(option): value for option, value in dict(options or {}).items()}
        if other := sorted(set(options) - set(OPTIONS.get(name, ()))):
            raise InputError(f"{name} takes no {brief(other[0])}")
        locks = {"locks": sorted(self.document.locks)} if name in TAKE_LOCKS else {}
        self.computations.job(name, self.gen, self.document.design, {**options, **locks})

    def export(self, format: str, anyway: bool = False) -> None:
        """A manufacturing file."""
        self.job("export", {"format": str(format), "anyway": bool(anyway)})

    def save(self) -> None:
        """The spec as a file."""
        self.document.saved()
        self.job("save")
        self._show()

    def analyse(self) -> None:
        """The analyses once more, after they were cancelled."""
        self.computations.analyse()

    def cancel(self, name: str) -> None:
        """End a job, or the analyses ("look")."""
        self.computations.cancel(str(name))

    # -- telling ---------------------------------------------------------------------------------------------------------------

    def _open(self, design: Design, name: str) -> None:
        """A design that has nothing to do with the one before."""
        self._document = Document(design, name)
        self._changed(ALL, opened=True)

    def _changed(self, *settled: str, opened: bool = False) -> None:
        """First the drawing, which is waited for; while it is on its way, the form."""
        self.gen += 1
        opened = opened or self.document.design.kind != self._kind
        if opened:
            self._kind, self._form = self.document.design.kind, None
            self.computations.reset(self.gen)
        self.computations.update(self.gen, self.document.design)
        self._show(settled, opened)

    def _show(self, settled: Sequence[str] = (), opened: bool = False) -> None:
        """The form; only the fields that differ, where nothing else does."""
        document, design = self.document, self.document.design
        before = self._form
        self._form = form(design, translations.fields(design.kind) | translations.tables(design.kind), before)
        fields = changed_fields(before, self._form) if before else None
        common = {
            "gen": self.gen,
            "undo": document.can_undo,
            "redo": document.can_redo,
            "locks": sorted(document.locks),
            "changed": document.changed,
            "toml": design.toml(),
            "files": self.files,
            "settled": list(settled),
        }
        if fields is not None:
            self.send({"what": "values", "fields": fields, **common})
            return
        self.send(
            {
                "what": "design",
                "kind": design.kind,
                "title": str(design.tables.get("title", "")),
                "name": document.name,
                "presets": _presets(design.kind),
                "form": self._form,
                "words": translations.texts(design.kind),
                "opened": opened,
                **common,
            }
        )

    def _describe(self, error: Exception, key: str | None = None) -> str:
        """An error in words, without folders of this machine, and without the key where it stands beside its field."""
        beside = key and getattr(error, "key", None) == key
        folder = (self._document.design if self._document else self.start).folder
        return without_folder(error.message if isinstance(error, SpecError) and beside else str(error), folder)


TAKE_LOCKS = ("sensitivity", "optimise")
ACTIONS = {
    name: getattr(Session, name)
    for name in (
        "hello",
        "again",
        "set",
        "unset",
        "add",
        "drop",
        "put",
        "take",
        "undo",
        "redo",
        "lock",
        "text",
        "load",
        "preset",
        "fresh",
        "open",
        "share",
        "reference",
        "job",
        "export",
        "save",
        "analyse",
        "cancel",
    )
}


def opened(path: str | Path) -> Design:
    """The design of a spec file on this machine; it may read what it names, and the tables beside it."""
    tables, folder = read_document(path), Path(path).resolve().parent
    named = Design(tables, folder).spec().data_files()
    beside = [beside_path for pattern in ("*.csv", "*.parquet") for beside_path in folder.glob(pattern)]
    return Design(tables, folder, frozenset([*named, *beside]))


def _preset(kind: str, name: str | None = None) -> Design:
    path = preset_path(str(kind), name and str(name))
    if path is None:
        raise InputError(f"{kind} brings no preset to start from")
    return opened(path)


def first_design() -> Design:
    """Where the studio begins when it is given no spec: the first kind's own example."""
    return _preset(next(kind for kind in registry.kinds() if registry.mechanism(kind).presets()))


def _presets(kind):
    """Names of the presets, the one to start with first."""
    return sorted(registry.mechanism(kind).presets(), key=lambda name: (name != "default", name))


def _kinds():
    return [{"kind": kind, "summary": registry.mechanism(kind).summary, "presets": _presets(kind)} for kind in registry.kinds()]


def _limited(text: object) -> str:
    if not isinstance(text, str) or len(text) > LARGEST:
        raise InputError(f"this is no text, or has more than {LARGEST:,} characters; that is too much for the studio")
    return text


def packed(text: str) -> str:
    """A text as the end of an address."""
    return "d=" + base64.urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")


def unpacked(fragment: str) -> str:
    """The text that `packed` was given; InputError where it is none, or too long."""
    letters = str(fragment).removeprefix("d=")
    try:
        raw = base64.b64decode(letters + "=" * (-len(letters) % 4), altchars="-_", validate=True)
        text = zlib.decompressobj().decompress(raw, LARGEST + 1).decode()
    except (ValueError, zlib.error):
        text = ""
    if not text:
        raise InputError("the design in this address is damaged; ask for the file, or for the address once more")
    return _limited(text)
