"""The jobs of one tab: work that a person asks for by name, with news on the way, until it is done, fails or is cancelled."""

import asyncio
from collections.abc import Callable, Mapping
from typing import Any

from drivewright.errors import DrivewrightError, GeometryCheckFailed
from drivewright.execution.workers import Cancellation, WorkerFault
from drivewright.studio.design import Design
from drivewright.studio.error_text import last_line
from drivewright.studio.jobs import JOBS
from drivewright.studio.outbox import Message
from drivewright.studio.resources import ServerResources


class TabJobs:
    """Jobs under way, one of each name.  `send(message)` tells the page; `describe(error)` gives its text for the page."""

    def __init__(self, send: Callable[[Message], object], describe: Callable[[Exception], str], resources: ServerResources) -> None:
        self.send, self.describe, self.resources = send, describe, resources
        self._jobs: dict[str, asyncio.Task[None]] = {}

    def begin(self, name: str, gen: int, design: Design, options: Mapping[str, Any]) -> None:
        """Begin a job with the design of a generation; one of the same name that is under way ends."""
        self.cancel(name)
        self._jobs[name] = asyncio.create_task(self._job(name, gen, design, options))

    def cancel(self, name: str) -> None:
        """End a job, where there is one of this name."""
        if job := self._jobs.get(name):
            job.cancel(Cancellation.NOW)

    def cancel_all(self) -> None:
        """End all of them: another drive begins, or the tab has gone."""
        for name in self._jobs:
            self.cancel(name)

    async def _job(self, name, gen, design, options):
        """A job's way: running with news, then done, failed or cancelled."""
        own = asyncio.current_task()

        def tell(state, **more):
            if self._jobs.get(name) is own:  # and not of one that has begun since
                self.send({"what": "job", "name": name, "state": state, "gen": gen, **more})

        def on_message(news):
            done, total, text, partial = news
            tell("running", done=done, total=total, text=text, **({"answer": partial} if partial is not None else {}))

        tell("running", done=0, total=0, text="", answer=None)
        try:
            async with self.resources.jobs.worker(self) as worker:
                answer = await worker.call(_work, name, design, options, on_message=on_message)
            tell("done", text="", answer=self._downloaded(answer))
        except asyncio.CancelledError:
            tell("cancelled", text="")
            raise
        except DrivewrightError as error:
            tell("failed", text=self.describe(error), **({"overridable": True} if isinstance(error, GeometryCheckFailed) else {}))
        except WorkerFault as error:
            tell("failed", text=last_line(self.describe(error)))
        finally:
            if self._jobs.get(name) is own:
                del self._jobs[name]

    def _downloaded(self, answer):
        """Files become addresses to fetch them from."""
        if not isinstance(answer, dict) or "files" not in answer:
            return answer
        files = [{"name": file["name"], "url": self.resources.offer(file["name"], file["data"])} for file in answer["files"]]
        return {**answer, "files": files}


def _work(tell, name, design, options):
    """In the process: a job by its name."""
    return JOBS[name](design, lambda done, total, text="", partial=None: tell((done, total, text, partial)), **options)
