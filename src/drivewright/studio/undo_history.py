"""A design with the steps before and after it."""

from copy import copy
from typing import Self

from drivewright.studio.design import Design

STEPS = 200  # that can be undone
HISTORY = 4_000_000  # characters of all designs that can be gone back to


class UndoHistory:
    """A design that changes step by step.  `design` is the present one, which is never changed in place."""

    def __init__(self, design: Design) -> None:
        self.design = design
        self._past: list[Design] = []
        self._future: list[Design] = []
        self._gesture: tuple[str, str] | None = None  # what moves it and which of its drags, of the step that is going on
        self._remembered = 0  # steps that have gone into the past, also those that have left it since
        self._saved = design

    # -- past and future -------------------------------------------------------------------------------------------------------

    @property
    def can_undo(self) -> bool:
        """Whether there is a step back."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Whether there is a step forward."""
        return bool(self._future)

    @property
    def changed(self) -> bool:
        """Whether the design is another one than the file has."""
        return not self.design.same_as(self._saved)

    def saved(self) -> None:
        """The present design is in a file now."""
        self._saved = self.design

    def undo(self) -> None:
        """One step back, where there is one."""
        self._step(self._past, self._future)

    def redo(self) -> None:
        """One step forward, where there is one."""
        self._step(self._future, self._past)

    def revert(self, gesture: str) -> None:
        """Take back all steps of the drag that is under way, as if it had not begun."""
        if self._past and self._gesture is not None and self._gesture[1] == gesture:
            self.design, self._gesture = self._past.pop(), None

    def _step(self, source: list[Design], target: list[Design]) -> None:
        if source:
            target.append(self.design)
            self.design, self._gesture = source.pop(), None

    def _take(self, design: Design, gesture: tuple[str, str] | None = None) -> None:
        """The next design; a step of the same gesture as the one before goes into the same undo step."""
        if design.same_as(self.design) and design.folder == self.design.folder:
            return
        if gesture is None or gesture != self._gesture:
            self._remember()
        self._future.clear()
        self.design, self._gesture = design, gesture

    def _remember(self) -> None:
        """The design as it is becomes a step to go back to; the oldest ones go where there are too many, or too large ones."""
        self._past = [*self._past[1 - STEPS :], self.design]
        self._remembered += 1
        while len(self._past) > 1 and sum(len(design.toml()) + len(design.source) for design in self._past) > HISTORY:
            del self._past[0]

    def continue_from(self, before: Self) -> None:
        """The design that was open until now is a step to go back to: opening another one loses nothing."""
        self._past = [*before._past, *self._past]
        opened, self.design = self.design, before.design
        self._remember()
        self.design = opened

    # -- in two processes ------------------------------------------------------------------------------------------------------

    def present(self) -> Self:
        """The same with one step of its past and its future: enough for a change that another process makes of it."""
        document = copy(self)
        document._past, document._future = self._past[-1:], self._future[-1:]
        return document

    def _follow_steps(self, change: str, after: "UndoHistory") -> None:
        """Take the same step forward or back as a change has made of `present()` in another process; `change` is the name of the method."""
        if change == "undo" and self._past:
            self._future.append(self.design)
            self._past.pop()
        elif self._past and not after._past:  # a drag was taken back
            self._past.pop()
        elif change == "redo" and self._future:
            self._past.append(self.design)
            self._future.pop()
        elif after._remembered > self._remembered:
            self._remember()
        if self._future and not after._future and change not in ("undo", "redo"):
            self._future.clear()
        self.design, self._gesture = after.design, after._gesture
