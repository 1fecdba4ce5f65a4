"""Messages of one tab to its page, in their order; the form of a design that a hand moves is told ten times a second.

Its drawings are told as they come, and the page has its processor for them: nobody reads numbers in a form that change faster, and the
handle has its own beside it.
"""

import asyncio
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

Message: TypeAlias = Mapping[str, Any]  # to the page: {"what": its name, ...}
PACE = 0.1  # seconds that a form waits, at most


class Outbox:
    """Tells the page what it is called with: `send(message)` reaches it."""

    def __init__(self, send: Callable[[Message], object]) -> None:
        self._send = send
        self._held: dict[str, Any] | None = None
        self._timer: asyncio.TimerHandle | None = None

    def __call__(self, message: Message) -> None:
        """A message: behind what is held, unless it is a drawing."""
        if message["what"] != "scene":
            self.release()
        self._send(message)

    def hold(self, values: Message) -> None:
        """The fields that a step has changed: they go before the next message that is no drawing, or after `PACE`, joined with those of
        the steps until then."""
        before = self._held
        self._held = {**values} if before is None else joined(before, values)
        if self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(PACE, self.release)

    def release(self) -> None:
        """Send what is held."""
        held = self._held
        self.close()
        if held is not None:
            self._send(held)

    def close(self) -> None:
        """Forget what is held."""
        self._held = None
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


def joined(before: Message, after: Message) -> dict[str, Any]:
    """Two messages of fields as one: the later one counts, and every field that either has."""
    settled = list(dict.fromkeys([*before["settled"], *after["settled"]]))
    return {**after, "fields": {**before["fields"], **after["fields"]}, "settled": settled}
