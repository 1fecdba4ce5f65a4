"""One tab of the browser: messages of the page change the document, and the page receives the outcome.

Nothing of NiceGUI is in here: `send(message)` reaches the page, `receive(message)` takes what comes from it.  Messages are worked off one
after another, and whatever reads or changes a design does so in a worker process: the server's loop only hands on.
"""

import asyncio
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from drivewright.errors import DrivewrightError, InputError, brief
from drivewright.execution.workers import WorkerFault
from drivewright.report.folder import file_name
from drivewright.studio import editing, part_lists, proposals, translations
from drivewright.studio.computations import REST
from drivewright.studio.design import Design
from drivewright.studio.edited_design import ALL, LONGEST_KEY, SHORT, EditedDesign
from drivewright.studio.editing import Edited
from drivewright.studio.inbox import Inbox
from drivewright.studio.jobs import checked_options
from drivewright.studio.offers import offered
from drivewright.studio.opening import limited
from drivewright.studio.outbox import Message
from drivewright.studio.resources import ServerResources

MOST_FILES = 20
MOST_PLACES = 50  # of one use of a tool
MOST_DRAGGED = 16  # keys that a handle moves


class Session(EditedDesign):
    """What a page may ask of its design: each message is a method of its name."""

    def __init__(self, send: Callable[[Message], object], resources: ServerResources, start: Design, name: str = "") -> None:
        super().__init__(send, resources, start, name)
        self._waiting: asyncio.TimerHandle | None = None  # for the end of a drag, to show the text of the spec
        self._inbox = Inbox(self._act, self._refuse)

    # -- messages --------------------------------------------------------------------------------------------------------------

    def read(self, text: str) -> None:
        """One message of the page as JSON; a long one is read in a worker process."""
        if len(text) > SHORT:
            return self._inbox.put({"what": "read", "text": text})
        try:
            return self.receive(editing.read_message(None, text))
        except InputError as error:
            return self._refuse(error)

    def receive(self, message: object) -> None:
        """One message {what, ...} of the page; what it asks wrongly is answered in the words of the command line."""
        try:
            arguments = editing.checked_message(message)
        except InputError as error:
            return self._refuse(error)
        if arguments.get("what") == "cancel":  # which does not wait in the queue
            self._cancel(str(arguments.get("name", "")))
        elif arguments.get("what") in tuple(ACTIONS):
            self._inbox.put(arguments)
        return None

    async def _act(self, arguments: dict[str, Any]) -> None:
        try:
            if arguments["what"] == "read":
                arguments = await self._call(editing.read_message, arguments["text"])
            await self._do(**arguments)
        except WorkerFault as error:
            self._refuse(InputError(f"a fault of the program: {str(error).strip().splitlines()[-1]}"))
        except DrivewrightError as error:
            self._refuse(error, str(arguments.get("key") or getattr(error, "key", None) or ""), str(arguments.get("text", "")))
        except OSError as error:
            self._refuse(InputError(f"a file cannot be kept: {error.strerror}"))

    async def _do(self, what: object = "", **arguments: Any) -> None:
        action = ACTIONS.get(what) if isinstance(what, str) else None
        if action is None or (self._document is None and action is not ACTIONS["hello"]):
            return
        with editing.in_words():
            await action(self, **arguments)

    def close(self) -> None:
        """The tab has gone."""
        self._stop_waiting()
        self._inbox.close()
        self.computations.close()
        self.jobs.cancel_all()
        self.send.close()

    # -- beginning -------------------------------------------------------------------------------------------------------------

    async def hello(self, saved: str = "", shared: str = "", files: str = "") -> None:
        """A page begins: with what it had before a reload, with the design in its address, or with the start."""
        self.send({"what": "start", "kinds": offered(), "words": translations.texts(None)})
        trouble = None
        if shared or saved:
            try:
                await self._resume(limited(saved), limited(shared), files)
            except DrivewrightError as error:
                trouble = error
            else:
                return
        self._begin(await self._call(editing.begin, self.start, self.start_name))
        if trouble:
            self._refuse(trouble)

    async def _resume(self, saved: str, shared: str, files: str) -> None:
        """The design that a page brings, with the files that it once sent, or those of the start."""
        folder = self.resources.folder(files)
        place = Design({}, folder, frozenset(folder.iterdir())) if folder else self.start
        self._begin(await self._call(editing.begin, place, "", saved, shared))

    def _begin(self, edited: Edited) -> None:
        """The first design of a page."""
        self._document = None
        self._open(edited)

    async def again(self) -> None:
        """The connection was lost for a moment: everything once more."""
        self._kept = b""
        await self._edit("", ALL)

    # -- changing --------------------------------------------------------------------------------------------------------------

    async def set(self, key: str, text: str, gesture: str = "") -> None:
        """A value as typed, or as a slider gives it."""
        await self._edit("set", _key(key), key=_key(key), text=str(text), gesture=str(gesture))

    async def pick(self, key: str, text: str) -> None:
        """A part by its name, with what it has of its own."""
        await self._edit("pick", _key(key), key=_key(key), text=str(text))

    async def names(self, list: str) -> None:
        """The parts that a field may name, with what one chooses them by."""
        self.send({"what": "names", "list": str(list)[:SHORT], "entries": await self._call(part_lists.entries, str(list)[:SHORT])})

    async def hints(self) -> None:
        """What the keys of this kind mean, in the other language: a page that shows it asks for them."""
        self.send({"what": "hints", "words": translations.hints(self.document.design.kind)})

    async def drag(self, changes: Mapping[str, str], gesture: str) -> None:
        """What a handle moves, as it moves."""
        if len(changes) > MOST_DRAGGED:
            raise InputError(f"a handle moves at most {MOST_DRAGGED} keys at once")
        texts = {_key(key): str(text) for key, text in changes.items()}
        await self._edit("drag", *texts, changes=texts, gesture=str(gesture))

    async def revert(self, gesture: str) -> None:
        """A drag is taken back before it has ended."""
        await self._edit("revert", ALL, gesture=str(gesture))

    async def unset(self, key: str) -> None:
        """Back to the default, or out."""
        await self._edit("unset", _key(key), key=_key(key))

    async def construct(self, tool: str, places: Sequence[Sequence[float]], near: float) -> None:
        """A tool of the kind at places of the drawing."""
        if len(places) > MOST_PLACES:
            raise InputError(f"at most {MOST_PLACES} places at once")
        await self._edit("construct", ALL, tool=str(tool)[:SHORT], places=[(float(x), float(y)) for x, y in places], near=float(near))

    async def sketch(self, on: bool) -> None:
        """Whether a person builds on the drawing, which stands still meanwhile."""
        if self.computations.building is not bool(on):
            self.computations.building = bool(on)
            await self._edit("", ALL)

    async def add(self, list: str) -> None:
        """Another element."""
        await self._edit("add", key=_key(list))

    async def drop(self, list: str, index: int) -> None:
        """An element less."""
        await self._edit("drop", ALL, key=_key(list), index=index)

    async def arrange(self, list: str, elements: Sequence[Mapping[str, Any]]) -> None:
        """The elements of a list anew: each one of before or none, {"of": number | null}, with "changes" {name: text as typed}."""
        asked = [{"of": each.get("of"), "changes": {_key(name): str(text) for name, text in each["changes"].items()}} for each in elements]
        await self._edit("arrange", ALL, key=_key(list), elements=asked)

    async def put(self, table: str) -> None:
        """An optional table in."""
        await self._edit("put", key=_key(table))

    async def take(self, table: str) -> None:
        """An optional table out."""
        await self._edit("take", ALL, key=_key(table))

    async def undo(self) -> None:
        """One step back."""
        await self._edit("undo", ALL)

    async def redo(self) -> None:
        """One step forward."""
        await self._edit("redo", ALL)

    async def lock(self, key: str, on: bool) -> None:
        """Hold a value."""
        self._show(await self._edited("lock", key=_key(key), on=bool(on)))

    async def source(self) -> None:
        """The text of the spec, after a drag."""
        self._show(await self._edited(""))

    async def text(self, toml: str) -> None:
        """The whole spec as text."""
        await self._edit("text", ALL, toml=limited(toml))

    async def load(self, changes: Mapping[str, str]) -> None:
        """Several values at once: a row of a study."""
        await self._edit("load", ALL, changes={_key(key): str(text) for key, text in changes.items()})

    async def preset(self, name: str) -> None:
        """Another preset of the same kind."""
        design = await self._call(editing.preset_design, self.document.design.kind, str(name))
        edited = await self._edited("replace", design=design)
        self.document.saved()
        self._changed(edited, ALL)

    # -- files -----------------------------------------------------------------------------------------------------------------

    async def fresh(self, kind: str, preset: str | None = None) -> None:
        """Another drive."""
        self._open(await self._call(editing.begin_preset, str(kind), preset and str(preset)))

    async def example(self, name: str) -> None:
        """A worked example, with copies of its data files."""
        await self.open(await self._call(editing.example_files, str(name)))

    async def open(self, files: Sequence[Mapping[str, str]]) -> None:
        """A spec with its data files, as text."""
        given = {file_name(str(file["name"])[-80:]): limited(file["text"]) for file in files[:MOST_FILES]}
        specs = [name for name in given if name.lower().endswith(".toml")]
        if len(specs) != 1:
            raise InputError(f"open one spec (.toml) and the data files that it names; here are {len(specs)} specs in {len(given)} files")
        limited("".join(given.values()))
        token, folder = self.resources.new_folder()
        try:
            for name, text in given.items():
                (folder / name).write_text(text, encoding="utf-8")
            place = Design({}, folder, frozenset(folder.iterdir()))
            self._open(await self._call(editing.begin, place, Path(specs[0]).stem, given[specs[0]]))
        finally:
            if self.files != token:
                self.resources.drop_folder(token)

    async def share(self) -> None:
        """The design as the end of an address."""
        self.send({"what": "shared", "fragment": await self._call(editing.fragment, self.document.design)})

    async def reference(self, preset: str) -> None:
        """A preset to compare with."""
        design = await self._call(editing.preset_design, self.document.design.kind, str(preset))
        self.computations.compare_with(str(preset), design)

    async def pin(self, gen: int | None = None) -> None:
        """The design of a generation to compare with, None for none."""
        self.computations.pin(gen)

    # -- computing -------------------------------------------------------------------------------------------------------------

    async def job(self, name: str, options: Mapping[str, Any] | None = None) -> None:
        """Begin a job of jobs.JOBS."""
        options = checked_options(name, options)
        locks = {"locks": sorted(self.document.locks)} if name in TAKE_LOCKS else {}
        kept = {"kept": str(self.resources.results_folder())} if name in TAKE_RESULTS else {}
        self.jobs.begin(name, self.gen, self.document.design, {**options, **locks, **kept})

    async def propose(self) -> None:
        """What a search or a study of this design may vary, and what its tables say."""
        found = await self._call(proposals.propose, self.document.design, sorted(self.document.locks))
        self.send({"what": "proposals", "gen": self.gen, **found})

    async def begin(self, name: str, table: Mapping[str, Any], options: Mapping[str, Any] | None = None) -> None:
        """Write the table of a search or of a study, in one step, and begin its job."""
        if name not in proposals.TABLES:
            raise InputError(f"{brief(name)} has no table that a form could write")
        if not isinstance(table, Mapping):
            raise InputError("the page sent an unexpected request: a table of a search is missing")
        checked_options(name, options)
        await self._edit("write", ALL, name=name, content=dict(table))
        await self.job(name, options)

    async def export(self, format: str, anyway: bool = False) -> None:
        """A manufacturing file."""
        await self.job("export", {"format": str(format), "anyway": bool(anyway)})

    async def save(self) -> None:
        """The spec as a file."""
        self.document.saved()
        await self.job("save")
        self._show(await self._edited(""))

    async def analyse(self, longer: bool = False) -> None:
        """The analyses once more, after they were cancelled; with more time where they took too long."""
        self.computations.analyse(longer=bool(longer))

    def _cancel(self, name: str) -> None:
        """End a job, or what is computed of the design ("look")."""
        if name == "look":
            self.computations.cancel()
        else:
            self.jobs.cancel(name)

    # -- telling ---------------------------------------------------------------------------------------------------------------

    async def _edit(self, change: str, *settled: str, **arguments: Any) -> None:
        edited = await self._edited(change, **arguments)
        self._stop_waiting()
        if moving := editing.under_way(change, arguments):
            self._waiting = asyncio.get_running_loop().call_later(REST, self._inbox.put, {"what": "source"})
        self._changed(edited, *settled, moving=moving)

    def _stop_waiting(self) -> None:
        if self._waiting:
            self._waiting.cancel()
            self._waiting = None


TAKE_LOCKS = ("sensitivity", "optimise", "fix", "reach")
TAKE_RESULTS = ("fields", "figures")  # of earlier runs
WORDS = (
    "hello again set pick names hints drag revert unset construct sketch add drop arrange put take undo redo lock source text load preset "
    "fresh example open share reference pin job propose begin export save analyse"
)
ACTIONS = {name: getattr(Session, name) for name in WORDS.split()}


def _key(key):
    """A dotted key, of a length that keys have."""
    if len(str(key)) > LONGEST_KEY:
        raise InputError(f"a key has at most {LONGEST_KEY} characters")
    return str(key)
