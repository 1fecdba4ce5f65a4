"""How a job reports its progress."""

from typing import Any, Protocol


class Progress(Protocol):
    """`progress(done, total, text, partial)`: `partial` is a preview of the answer."""

    def __call__(self, done: int, total: int, text: str = "", partial: Any = None, /) -> object: ...
