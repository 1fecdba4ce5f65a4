"""What is computed for one tab: always the newest drawing, the analyses when the design rests, and a design to compare with."""

import asyncio
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

from drivewright import registry
from drivewright.errors import DrivewrightError
from drivewright.execution.workers import CallTimedOut, Cancellation, WorkerDied, WorkerFault
from drivewright.studio import preview
from drivewright.studio.design import Design
from drivewright.studio.error_text import last_line
from drivewright.studio.jobs.progress import LONGER
from drivewright.studio.outbox import Message
from drivewright.studio.resources import ServerResources

REST = 0.25  # seconds without a change after which the analyses follow
SLOW = 3.0  # seconds after which a drawing says that it is under way
PATIENCE = 120.0  # seconds after which it is given up: enough to compile what it needs
BUDGET = 0.02  # seconds of analyses that go with a drawing, or beside it
PACE = 0.2  # seconds at least between two rounds of such analyses: as fast as numbers are read
SHARE = 4  # times as long as a round took, at least, where that is more
ANALYSIS = 120.0  # seconds that one analysis may take: enough to compile what it needs


class TabComputations:
    """Computations of one tab.  `send(message)` tells the page; `describe(error)` gives its text for the page."""

    def __init__(self, send: Callable[[Message], object], describe: Callable[[Exception], str], resources: ServerResources) -> None:
        self.send, self.describe, self.resources = send, describe, resources
        self._newest: tuple[int, Design] | None = None
        self._limit = ANALYSIS
        self._shown: dict[str, Any] | None = None  # what the page shows of it
        self._known: dict[str, Any] = {}  # panels of the plots that the page has, by the name of the plot
        self._full: tuple[int, dict[str, Any]] | None = None  # the newest full result, with its generation
        self._pinned: dict[str, Any] | None = None  # the result that what is shown is compared with
        self._moving = -1  # generation of the newest design that a hand is moving
        self._since = 0  # generation of the first design of this drive
        self.building = False  # while a person builds on the drawing: the mechanism stands still at its start
        self._refused = False  # whether the page shows that the newest design has no solution
        self._fresh = False  # whether what is shown is the full result of the newest design
        self._draw_loop: asyncio.Task[None] | None = None
        self._draw_task: asyncio.Task[bool] | None = None
        self._analyse_task: asyncio.Task[None] | None = None
        self._glance_task: asyncio.Task[None] | None = None
        self._quick_from = -math.inf  # when the next round of quick analyses may begin [s], by the loop's clock
        self._reference_task: asyncio.Task[None] | None = None
        self._seconds: dict[str, float] = {}  # of each analysis, as last measured with this drive

    def update(self, gen: int, design: Design, moving: bool = False) -> None:
        """Draw this design as soon as the one under way is drawn, and analyse it when it has rested.

        moving: a hand moves it: its quick scene now, where its kind has one, and its drawing too when it has rested.
        """
        self._newest, self._limit = (gen, design), ANALYSIS
        self._moving = gen if moving else -1
        if self._analyse_task and not self._analyse_task.cancelling():  # a second word would end the process
            self._analyse_task.cancel()
        if self._fresh:
            self._fresh = False
            self.send({"what": "outdated"})
        if not self._draw_loop:
            self._draw_loop = asyncio.create_task(self._draw_newest())

    def analyse(self, longer: bool = False) -> None:
        """Begin with the newest design again, after its computation was cancelled; `longer` after an analysis took too long."""
        if not self._draw_loop and self._newest:
            self.update(*self._newest)
            self._limit = LONGER * ANALYSIS if longer else ANALYSIS

    def compare_with(self, title: str, design: Design) -> None:
        """Draw and analyse another design, to be compared with."""
        _cancel_now(self._reference_task)
        self._reference_task = asyncio.create_task(self._reference(title, design))

    def pin(self, gen: int | None) -> None:
        """Compare what follows with the full result of a generation, None with nothing."""
        _cancel_now(self._reference_task)
        self._pinned = self._full[1] if self._full and self._full[0] == gen else None

    def cancel(self) -> None:
        """End what is computed of the design."""
        for task in (self._draw_task, self._analyse_task):
            _cancel_now(task)

    def reset(self, since: int) -> None:
        """Another drive begins with the generation `since`: nothing of the one before belongs to it."""
        self._since, self._shown, self._fresh, self._seconds = since, None, False, {}
        self._full = self._pinned = None
        self._known = {}
        _cancel_now(self._reference_task)

    def close(self) -> None:
        """The tab has gone."""
        for task in (self._draw_loop, self._draw_task, self._analyse_task, self._glance_task):
            if task:
                task.cancel()
        _cancel_now(self._reference_task)

    # -- the drawing -----------------------------------------------------------------------------------------------------------

    async def _draw_newest(self) -> None:
        """Draw until the newest is drawn; analyse it, where it has a solution."""
        drawn, solved = None, False
        try:
            while self._newest and drawn is not self._newest:
                drawn = self._newest
                self._draw_task = asyncio.create_task(self._drawn(*drawn))
                await asyncio.wait([self._draw_task])
                solved = not self._draw_task.cancelled() and self._draw_task.result()
        finally:
            if self._draw_task:
                self._draw_task.cancel()
            self._draw_loop = None
        if drawn and solved:
            self._analyse_task = asyncio.create_task(self._analyse(*drawn))

    async def _drawn(self, gen: int, design: Design) -> bool:
        """Whether the design has a solution; its drawing and the analyses that cost next to nothing, once more where the process died."""
        try:
            try:
                await self._draw(gen, design)
            except WorkerDied as loss:
                self._lost(loss)
                await self._draw(gen, design)
        except (WorkerDied, WorkerFault) as error:
            self._lost(error)
            return False
        except DrivewrightError as error:
            self._impossible(gen, error)
            return False
        except Exception as error:  # a bug on this side: the page must not wait for ever
            self._lost(error)
            raise
        return True

    def _lost(self, error: Exception) -> None:
        """A process that died, or a bug, in one line."""
        self.send({"what": "work", "state": "lost", "text": last_line(self.describe(error))})

    async def _draw(self, gen: int, design: Design) -> None:
        def on_message(text):
            self.send({"what": "scene", "gen": gen, "json": text})

        moving = gen == self._moving
        async with self.resources.quick.worker(self) as worker:
            quick, began = [] if moving else self._affordable(design), asyncio.get_running_loop().time()
            with self._limited():
                result = await worker.call(preview.draw, design, quick, self.building, moving, on_message=on_message)
        if self._refused:
            self._refused = False
            self.send({"what": "possible", "gen": gen})
        if result:
            self._rest_from(began)
            self._show(gen, result, quick)
        if moving and not self._glance_task and (beside := self._affordable(design)):
            self._glance_task = asyncio.create_task(self._glance(gen, design, beside))

    async def _glance(self, gen, design, quick):
        """The analyses that cost next to nothing, beside the drawings of a design that a hand is moving."""
        began = asyncio.get_running_loop().time()
        try:
            async with self.resources.heavy.worker(self) as worker:
                result = await worker.call(preview.glance, design, quick, limit=self._limit)
            if result:
                self._show(gen, result, quick)
        except (DrivewrightError, WorkerFault):
            pass  # the drawing, or the analyses when the design rests, say what is wrong
        finally:
            self._rest_from(began)
            self._glance_task = None

    def _rest_from(self, began):
        """Quick analyses that began then have ended: the next ones leave the processor to others for a while."""
        took = asyncio.get_running_loop().time() - began
        self._quick_from = max(self._quick_from, began + SHARE * took)

    def _affordable(self, design: Design) -> list[str]:
        """Analyses that go with a drawing, or beside it: none while others wait, a person builds, or too soon after those before."""
        now = asyncio.get_running_loop().time()
        if self.building or self.resources.quick.crowded or now < self._quick_from:
            return []
        chosen = preview.affordable_analyses(registry.mechanism(design.kind).analyses, self._seconds, BUDGET)
        if chosen:
            self._quick_from = now + PACE
        return chosen

    @contextmanager
    def _limited(self) -> Iterator[None]:
        """A drawing that takes long says so and can be cancelled; one that takes all too long is given up."""
        loop, task = asyncio.get_running_loop(), asyncio.current_task()
        slow = {"what": "work", "state": "analysing", "text": "drawing", "done": 0, "total": 0}
        timers = loop.call_later(SLOW, self.send, slow), loop.call_later(PATIENCE, _cancel_now, task)
        try:
            yield
        except asyncio.CancelledError:
            self.send({"what": "work", "state": "stopped", "text": ""})
            raise
        finally:
            for timer in timers:
                timer.cancel()

    def _impossible(self, gen, error):
        """A design that is a proper spec, but has no solution: the page keeps what it showed and says so."""
        self._refused = True
        self.send({"what": "impossible", "gen": gen, "key": getattr(error, "key", None) or "", "message": self.describe(error)})

    def _show(self, gen, result, quick=None, full=True):
        """A result; one of the quick analyses takes over from what is shown where it can, the rest is stale."""
        if gen < self._since:
            return
        self._shown = result if quick is None or self._shown is None else preview.merge_results(self._shown, result)
        self._fresh = full and quick is None and self._newest is not None and gen == self._newest[0]
        if self._fresh:
            self._full = gen, self._shown
        apart = {"differences": preview.differences(self._pinned, self._shown)} if self._pinned else {}
        plots, known = self._shown["plots"], {} if quick is None else self._known
        self._known = {plot["name"]: plot.get("panels") for plot in plots["plots"]} if plots else {}
        told = {**self._shown, **apart, "plots": preview.without_known(plots, known)}
        self.send({"what": "result", "gen": gen, "full": self._fresh, **({"builds_on": True} if known else {}), "result": told})

    # -- the analyses ----------------------------------------------------------------------------------------------------------

    async def _analyse(self, gen, design):
        """All default analyses, once the design has rested."""
        await asyncio.sleep(REST)
        begun: list[str] = []
        try:
            if gen == self._moving and registry.mechanism(design.kind).quick_scene:
                self._moving = -1
                await self._drawn(gen, design)
            result = await self._analysed(design, begun)
            self._seconds = result["timings"] if gen >= self._since else {}
            self._show(gen, result)
            self.send({"what": "work", "state": "idle", "text": ""})
        except asyncio.CancelledError as cancelled:
            if self._analyse_task is asyncio.current_task():
                self.send({"what": "work", "state": "stopped" if Cancellation.NOW in cancelled.args else "drawing", "text": ""})
            raise
        except CallTimedOut:
            await self._without_last(gen, design, begun)
        except (WorkerDied, WorkerFault) as error:
            self._lost(error)
        except DrivewrightError as error:
            self._impossible(gen, error)
            self.send({"what": "work", "state": "idle", "text": ""})

    async def _without_last(self, gen, design, begun):
        """After an analysis took too long: say so, with the answers of those before it."""
        over = {"what": "work", "state": "over", "text": begun[-1] if begun else "", "seconds": self._limit}
        if len(begun) > 1:
            with suppress(CallTimedOut, WorkerDied, WorkerFault, DrivewrightError):
                self._show(gen, await self._analysed(design, [], begun[:-1]), full=False)
        self.send(over)

    async def _analysed(self, design, begun, only=()):
        def on_message(news):
            done, total, name, compiling = news
            if name and name not in begun:
                begun.append(name)
            self.send({"what": "work", "state": "analysing", "text": name, "done": done, "total": total, "compiling": compiling})

        async with self.resources.heavy.worker(self) as worker:
            return await worker.call(preview.analyse, design, only, on_message=on_message, limit=self._limit)

    async def _reference(self, title, design):
        scenes = []
        try:
            async with self.resources.heavy.worker(self) as worker:
                await worker.call(preview.draw, design, (), on_message=scenes.append, limit=ANALYSIS)
                result = await worker.call(preview.analyse, design, limit=ANALYSIS)
            self._pinned = result
            self.send({"what": "reference", "title": title, "json": scenes[-1], "result": result})
            if self._shown:
                self.send({"what": "differences", "differences": preview.differences(result, self._shown)})
        except DrivewrightError as error:
            self.send({"what": "refused", "key": "", "text": "", "message": self.describe(error)})
        except WorkerFault as error:
            self._lost(error)


def _cancel_now(task: asyncio.Task[Any] | None) -> None:
    if task:
        task.cancel(Cancellation.NOW)
