"""How work that takes a while reports its progress, and how much longer it may take."""

from typing import Any, Protocol

LONGER = 10  # times as long, where a person asks for it


class Progress(Protocol):
    """`progress(done, total, text, partial)`: `partial` is a preview of the answer."""

    def __call__(self, done: int, total: int, text: str = "", partial: Any = None, /) -> object: ...
