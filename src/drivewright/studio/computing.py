"""What is computed for one tab: always the newest drawing, the analyses when the design rests, and the jobs that were asked for."""

import asyncio
from contextlib import suppress

from drivewright import registry
from drivewright.errors import DrivewrightError
from drivewright.studio import looking
from drivewright.studio.jobs import JOBS
from drivewright.studio.lanes import NOW, Failed, Lost

REST = 0.25  # seconds without a change after which the analyses follow
PATIENCE = 30.0  # seconds that a drawing may keep a newer one waiting: enough to compile what it needs
BUDGET = 0.02  # seconds of analyses that go with every drawing


class Computing:
    """Computations of one tab.  `send(message)` tells the page; `words(error)` puts an error into its words."""

    def __init__(self, send, words, workshop):
        self.send, self.words, self.workshop = send, words, workshop
        self._newest = self._shown = None  # (gen, design); what the page shows of it
        self._since = 0  # generation of the first design of this drive
        self._drawing = self._pen = self._analysing = None
        self._jobs = {}

    def look(self, gen, design):
        """Draw this design as soon as the one under way is drawn, and analyse it when it has rested."""
        self._newest = gen, design
        if self._analysing:
            self._analysing.cancel()
        if self._drawing:
            asyncio.get_running_loop().call_later(PATIENCE, self._give_up, self._pen)
        else:
            self._drawing = asyncio.create_task(self._draw_newest())

    def analyse(self):
        """Begin the analyses of the newest design again, after they were cancelled."""
        if not self._drawing and (not self._analysing or self._analysing.done()):
            self._analysing = asyncio.create_task(self._analyse(*self._newest))

    def job(self, name, gen, design, options):
        """Begin a job; one of the same name that is under way ends."""
        self.cancel(name)
        self._jobs[name] = asyncio.create_task(self._job(name, gen, design, options))

    def refer(self, title, design):
        """Draw and analyse another design, to be compared with."""
        self.cancel("reference")
        self._jobs["reference"] = asyncio.create_task(self._reference(title, design))

    def cancel(self, name):
        """End a job, or the analyses of the design ("look")."""
        task = self._analysing if name == "look" else self._jobs.get(name)
        if task:
            task.cancel(NOW)

    def forget(self, since):
        """Another drive begins with the generation `since`: nothing of the one before belongs to it."""
        self._since, self._shown = since, None
        for name in self._jobs:
            self.cancel(name)

    def close(self):
        """The tab has gone."""
        for task in (self._drawing, self._pen, self._analysing, *self._jobs.values()):
            if task:
                task.cancel()

    # -- the drawing -----------------------------------------------------------------------------------------------------------

    async def _draw_newest(self):
        """Draw until the newest is drawn; analyse it, where it has a solution."""
        drawn, solved = None, False
        try:
            while drawn is not self._newest:
                drawn = self._newest
                self._pen = asyncio.create_task(self._drawn(*drawn))
                await asyncio.wait([self._pen])
                solved = not self._pen.cancelled() and self._pen.result()
        finally:
            self._pen.cancel()
            self._drawing = None
        if solved:
            self._analysing = asyncio.create_task(self._analyse(*drawn))

    def _give_up(self, pen):
        """A drawing that takes all too long makes way for the newer one."""
        if pen is self._pen and not pen.done():
            pen.cancel(NOW)
            self.send({"what": "work", "state": "lost", "text": "the drawing took too long and was given up for the newer one"})

    async def _drawn(self, gen, design):
        """Whether the design has a solution; its drawing and the analyses that cost next to nothing, once more where the process died."""
        try:
            try:
                await self._draw(gen, design)
            except Lost as loss:
                self.send({"what": "work", "state": "lost", "text": str(loss)})
                await self._draw(gen, design)
        except (Lost, Failed) as error:
            self.send({"what": "work", "state": "lost", "text": _last_line(error)})
            return False
        except DrivewrightError as error:
            self._impossible(gen, error)
            return False
        return True

    async def _draw(self, gen, design):
        def heard(text):
            self.send({"what": "scene", "gen": gen, "json": text})

        quick = looking.affordable(registry.mechanism(design.kind).analyses, self.workshop.seconds.get(design.kind, {}), BUDGET)
        async with self.workshop.quick.lane() as lane:
            found = await lane.call(looking.draw, design, quick, heard=heard)
        self.send({"what": "possible", "gen": gen})
        if found:
            self._show(gen, found, quick)

    def _impossible(self, gen, error):
        """A design that is a proper spec, but has no solution: the page keeps what it showed and says so."""
        self.send({"what": "impossible", "gen": gen, "key": getattr(error, "key", None) or "", "message": self.words(error)})

    def _show(self, gen, found, quick=None):
        """A result; one of the quick analyses takes over from what is shown where it can, the rest is stale."""
        if gen < self._since:
            return
        self._shown = found if quick is None or self._shown is None else looking.merged(self._shown, found)
        full = quick is None and gen == self._newest[0]
        self.send({"what": "result", "gen": gen, "full": full, "result": self._shown})

    # -- the analyses ----------------------------------------------------------------------------------------------------------

    async def _analyse(self, gen, design):
        """All default analyses, once the design has rested."""
        await asyncio.sleep(REST)
        try:
            found, seconds = await self._analysed(design)
            self.workshop.seconds[design.kind] = seconds
            self._show(gen, found)
            self.send({"what": "work", "state": "idle", "text": ""})
        except asyncio.CancelledError as cancelled:
            self.send({"what": "work", "state": "stopped" if NOW in cancelled.args else "drawing", "text": ""})
            raise
        except (Lost, Failed) as error:
            self.send({"what": "work", "state": "lost", "text": _last_line(error)})
        except DrivewrightError as error:
            self._impossible(gen, error)
            self.send({"what": "work", "state": "idle", "text": ""})

    async def _analysed(self, design):
        def heard(news):
            done, total, name = news
            self.send({"what": "work", "state": "analysing", "text": name, "done": done, "total": total})

        async with self.workshop.heavy.lane() as lane:
            return await lane.call(looking.analyse, design, heard=heard)

    async def _reference(self, title, design):
        scenes = []
        try:
            async with self.workshop.heavy.lane() as lane:
                await lane.call(looking.draw, design, (), heard=scenes.append)
                found, _ = await lane.call(looking.analyse, design)
            self.send({"what": "reference", "title": title, "json": scenes[-1], "result": found})
        except DrivewrightError as error:
            self.send({"what": "refused", "key": "", "text": "", "message": self.words(error)})
        except Failed as error:
            self.send({"what": "work", "state": "lost", "text": _last_line(error)})

    # -- jobs ------------------------------------------------------------------------------------------------------------------

    async def _job(self, name, gen, design, options):
        """A job's way: running with news, then done, failed or cancelled."""
        def tell(state, **more):
            self.send({"what": "job", "name": name, "state": state, "gen": gen, **more})

        def heard(news):
            done, total, text, partial = news
            tell("running", done=done, total=total, text=text, **({"answer": partial} if partial is not None else {}))

        tell("running", done=0, total=0, text="", answer=None)
        try:
            async with self.workshop.heavy.lane() as lane:
                answer = await lane.call(_work, name, design, options, heard=heard)
            tell("done", text="", answer=self._downloaded(answer))
        except asyncio.CancelledError:
            tell("cancelled", text="")
            raise
        except DrivewrightError as error:
            tell("failed", text=self.words(error))
        except Failed as error:
            tell("failed", text=_last_line(error))
        finally:
            if self._jobs.get(name) is asyncio.current_task():
                with suppress(KeyError):
                    del self._jobs[name]

    def _downloaded(self, answer):
        """Files become addresses to fetch them from."""
        if not isinstance(answer, dict) or "files" not in answer:
            return answer
        files = [{"name": file["name"], "url": self.workshop.offer(file["name"], file["data"])} for file in answer["files"]]
        return {**answer, "files": files}


def _work(tell, name, design, options):
    """In the process: a job by its name."""
    return JOBS[name](design, lambda done, total, text="", partial=None: tell((done, total, text, partial)), **options)


def _last_line(error):
    """What a bug's traceback ends with, or the one line that an error is."""
    return str(error).strip().splitlines()[-1]
