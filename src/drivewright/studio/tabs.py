"""The open tabs, and the framework's socket between them and their sessions.

Of what may come over the socket only what our own page sends is taken; whatever else comes is left out without a word on the terminal.
"""

import asyncio
import logging
from collections import deque
from collections.abc import Callable
from typing import Any

from drivewright.studio.outbox import Message
from drivewright.studio.session import Session

MOST = 300  # tabs
AHEAD = 8  # messages that the framework may hold for a page
MOST_UNSENT = 400  # messages that wait for that; a page that takes none is disconnected
BREATH = 0.05  # seconds between two looks at a page that is behind
REPLACED = ("scene", "result")  # messages of which only the newest counts, unless it builds on the one before


class Tabs:
    """Sessions by the id that the framework gives their page."""

    def __init__(self) -> None:
        self._sessions: dict[str, Session] = {}
        self._unsent: dict[str, deque[Message]] = {}
        self._senders: dict[str, asyncio.Task[None]] = {}
        self._sio: Any = None
        self._written: Callable[[object], str]  # a message in JSON: the framework would walk through every part of one that is not text

    @property
    def full(self) -> bool:
        """Whether there are as many as the server can hold."""
        return len(self._sessions) >= MOST

    def open(self, page: str, session: Session) -> None:
        """A tab has been opened."""
        self._sessions[page], self._unsent[page] = session, deque()

    def close(self, page: str) -> None:
        """A tab has gone."""
        if session := self._sessions.pop(page, None):
            session.close()
            self._unsent.pop(page)
            if sender := self._senders.pop(page, None):
                sender.cancel()

    def listen(self, sio: Any) -> None:
        """Take over from the framework what comes over its socket."""
        from nicegui import json

        self._sio, self._written = sio, json.dumps
        for name, handler in list(sio.handlers["/"].items()):
            if name in ("connect", "handshake", "ack"):
                sio.on(name, _forgiving(handler))
        sio.on("javascript_response", _nothing)
        sio.on("log", _nothing)
        sio.on("event", self._hear)
        for logger in ("engineio.server", "socketio.server"):
            logging.getLogger(logger).addFilter(_is_ours)
        logging.getLogger("uvicorn.error").addFilter(lambda record: not record.getMessage().startswith("Invalid UTF-8"))

    async def _hear(self, socket: str, event: object = None, *more: object) -> None:
        """An event of a page, {client_id, args}: its only argument is a message in JSON."""
        page = event.get("client_id") if isinstance(event, dict) else None
        session = self._sessions.get(page) if isinstance(page, str) else None
        if session is None or page not in self._sio.rooms(socket):  # a socket acts for its own page only
            return
        arguments = event.get("args") if isinstance(event, dict) else None
        session.read(arguments[0] if isinstance(arguments, list) and arguments and isinstance(arguments[0], str) else "")

    def send(self, page: str, message: Message) -> None:
        """A message for a page; a drawing that has not gone yet gives way to a newer one."""
        unsent = self._unsent.get(page)
        if unsent is None:
            return
        if message["what"] in REPLACED and not message.get("builds_on"):
            older = [each for each in unsent if each["what"] == message["what"]]
            for each in older:
                unsent.remove(each)
        unsent.append(message)
        if page not in self._senders:
            self._senders[page] = asyncio.get_running_loop().create_task(self._send(page, unsent))

    async def _send(self, page: str, unsent: deque[Message]) -> None:
        """Hand messages to the framework, no faster than the page takes them."""
        try:
            while unsent:
                while behind := self._behind(page):
                    if len(unsent) > MOST_UNSENT:  # the page comes back, and has everything once more
                        unsent.clear()
                        await asyncio.gather(*(connection.close(wait=False, abort=True) for connection in behind))
                    await asyncio.sleep(BREATH)
                if unsent:
                    await self._sio.emit("studio", self._written(unsent.popleft()), room=page)
        finally:
            self._senders.pop(page, None)

    def _behind(self, page: str) -> list[Any]:
        """The connections of a page that have not taken yet what they were sent."""
        sockets = (self._sio.eio.sockets.get(connection) for _, connection in self._sio.manager.get_participants("/", page))
        return [socket for socket in sockets if socket is not None and not socket.closed and socket.queue.qsize() > AHEAD]


def _forgiving(handler: Callable[..., Any]) -> Callable[..., Any]:
    """A handler of the framework that answers False to what it cannot read."""

    async def handling(*arguments: Any) -> Any:
        try:
            answer = handler(*arguments)
            return await answer if asyncio.iscoroutine(answer) else answer
        except (TypeError, ValueError, LookupError, AttributeError):
            return False

    return handling


def _nothing(*arguments: object) -> None:
    """Leave a message out."""


def _is_ours(record: logging.LogRecord) -> bool:
    """Whether the terminal should see a line of the socket's log: nothing that a hostile page can cause."""
    return record.exc_info is None
