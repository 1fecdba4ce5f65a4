"""One tab of the studio without a browser, a server or processes."""

import asyncio
import json
import pickle
from contextlib import asynccontextmanager
from types import SimpleNamespace

import loops

from drivewright.studio.session import Session


class Quiet:
    """Stands for the computations and the jobs: notes what is asked of them."""

    def __init__(self):
        self.asked = []

    def __getattr__(self, name):
        return lambda *arguments: self.asked.append((name, *arguments))


class Here:
    """Stands for the processes that read what a page sends: everything goes there and back pickled."""

    @asynccontextmanager
    async def worker(self, owner):
        async def call(function, *arguments, limit):
            answer = function(None, *pickle.loads(pickle.dumps(arguments)))
            await asyncio.sleep(0)
            return pickle.loads(pickle.dumps(answer))

        yield SimpleNamespace(call=call)

    def close(self):
        pass


class Tab:
    """A session and all that it has said."""

    def __init__(self, start, resources):
        self.heard = []
        self.session = Session(self.heard.append, resources, start)
        self.session.computations = self.session.jobs = self.quiet = Quiet()

    def say(self, what, **more):
        """What the session answers to one message."""
        return self.send({"what": what, **more})

    def send(self, *messages):
        """What the session answers to messages, whatever they are, that come together."""

        async def sending():
            for message in messages:
                self.session.receive(message)
            if work := self.session._inbox.work:
                await work
            self.session.send.release()  # there is no drawing that it would wait for

        self.heard.clear()
        loops.run(sending())
        json.dumps(self.heard, allow_nan=False).encode()  # everything can be sent
        return list(self.heard)

    @property
    def toml(self):
        return self.session.document.design.text()
