"""Messages of one tab that wait for their turn."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Mapping
from typing import Any, TypeAlias

from drivewright.errors import InputError
from drivewright.execution.workers import Cancellation

MOST, MOST_TEXT = 100, 3_000_000  # messages that wait, and their characters
Arguments: TypeAlias = dict[str, Any]


class Inbox:
    """Works messages off one after another with `act(message)`; `refuse(error)` tells the page what is too much."""

    def __init__(self, act: Callable[[Arguments], Awaitable[None]], refuse: Callable[[InputError], None]) -> None:
        self._act, self._refuse = act, refuse
        self._waiting: deque[Arguments] = deque()
        self.work: asyncio.Task[None] | None = None  # while there is any

    def put(self, message: Arguments) -> None:
        """One more; steps of one drag that are still waiting are one, the newest."""
        if self._waiting and _same_drag(self._waiting[-1], message):
            self._waiting.pop()
        if len(self._waiting) >= MOST or sum(map(_size, self._waiting)) + _size(message) > MOST_TEXT:
            return self._refuse(InputError("the page sends more than the studio can answer; this was left out, try it again in a moment"))
        self._waiting.append(message)
        if self.work is None:
            self.work = asyncio.get_running_loop().create_task(self._work_off())
        return None

    def close(self) -> None:
        """Nobody waits for an answer any more."""
        self._waiting.clear()
        if self.work:
            self.work.cancel(Cancellation.NOW)

    async def _work_off(self) -> None:
        try:
            while self._waiting:
                await self._act(self._waiting.popleft())
        finally:
            self.work = None


def _same_drag(before: Mapping[str, Any], after: Mapping[str, Any]) -> bool:
    """Whether two messages are steps of one drag of a slider or of a handle."""
    same = ("what", "key", "gesture")
    return before["what"] in ("set", "drag") and bool(before.get("gesture")) and all(before.get(name) == after.get(name) for name in same)


def _size(message: Mapping[str, Any]) -> int:
    """Characters of a message, about."""
    return sum(len(value) for value in message.values() if isinstance(value, str))
