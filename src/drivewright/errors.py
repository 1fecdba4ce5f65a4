"""Every error a user can cause or meet, in one tree.

::

    DrivewrightError
    ├── InputError (ValueError)          the request has no meaning or no solution     exit code 2
    │   ├── SpecError                    a key of a spec file, named with its value
    │   │   ├── UnitError                a quantity without, or with the wrong, unit
    │   │   └── MissingFile              a data file that is not there
    │   ├── UnknownName                  a kind, law, value ... that nobody registered
    │   ├── GeometryCheckFailed          an export of what is not, or not in full, checked to be feasible
    │   ├── DoesNotAssemble              a loop that does not close, a singular system
    │   └── MissingExtra                 an optional dependency is not installed
    └── SolverError (RuntimeError)       a solver gave up; carries the partial result  exit code 4

A message says what, where, how much, and what to try.  A design that can be computed but should not be built is
no error: it is a failed check of the result.

Once the spec is accepted and its model built, no exception of one analysis ends a run: it is a finding of that analysis, the outcome
is "partial", and the other analyses keep their answers (`runner`).
"""

import difflib
import reprlib
from collections.abc import Iterable
from datetime import date, time
from os.path import commonprefix
from typing import Any, Self

DEBUG = "DRIVEWRIGHT_DEBUG"  # in the environment: show the traceback of a fault of the program on stderr, where a run keeps going


class DrivewrightError(Exception):
    """Root of the tree; the command line turns it into one message and `exit_code`."""

    exit_code = 2

    def __reduce__(self) -> tuple[Any, ...]:
        # A pool of processes sends errors back pickled; Exception itself would call __init__ with the finished message.
        return _restored, (type(self), self.args, self.__dict__)


def _restored(kind: type[DrivewrightError], args: tuple[Any, ...], state: dict[str, Any]) -> DrivewrightError:
    error = kind.__new__(kind, *args)
    error.__dict__.update(state)
    return error


class InputError(DrivewrightError, ValueError):
    """The request has no meaning or no solution."""


class SpecError(InputError):
    """A key of a spec is wrong: `key` is its dotted path, `file` where it stands (None outside a file)."""

    def __init__(self, message: str, key: str | None = None, file: str | None = None) -> None:
        super().__init__(message)
        self.message, self.key, self.file = message, key, file

    def __str__(self) -> str:
        return " ".join(part for part in (f"{self.file}:" if self.file else "", f"{self.key}:" if self.key else "", self.message) if part)

    def located(self, key: str | None = None, file: str | None = None) -> Self:
        """The same complaint with its place filled in."""
        return type(self)(self.message, key if key is not None else self.key, file if file is not None else self.file)


class UnitError(SpecError):
    """A quantity without, or with the wrong, unit."""


class MissingFile(SpecError):
    """A data file that is not there."""


class GeometryCheckFailed(InputError):
    """An export of a design that fails a geometry check, or is not checked in full; it goes out only where that is asked for."""


class UnknownName(InputError):
    """A name that is not among the known ones."""

    def __init__(self, what: str, name: object, known: Iterable[str]) -> None:
        super().__init__(f"no {what} is called {name!r}{nearest(name, known)}; known: {', '.join(sorted(known))}")


class DoesNotAssemble(InputError):
    """A loop that does not close, or a system without a solution."""


class MissingExtra(InputError):
    """An optional dependency is needed and not installed."""

    def __init__(self, what: str, extra: str, cause: object = None) -> None:
        reason = f" ({cause})" if cause else ""
        super().__init__(f"{what} needs the extra '{extra}', which is not installed{reason}; try: pip install 'drivewright[{extra}]'")
        self.extra = extra


class SolverError(DrivewrightError, RuntimeError):
    """A solver gave up.  `partial` is what it had."""

    exit_code = 4

    def __init__(self, message: str, partial: object = None) -> None:
        super().__init__(message)
        self.partial = partial


def counted(count: float, most: int, what: str, remedy: str) -> int:
    """How many of something will be made, as a whole number; InputError, before they are, where they are more than `most`."""
    if count <= most:
        return int(count)
    raise InputError(f"{count:.3g} {what} are more than the {most:.3g} that fit into memory and time; {remedy}")


def nearest(name: object, known: Iterable[str]) -> str:
    """Hint ' (did you mean ...?)' when a known name is close, capitals aside, else ''."""
    by_lower = {str(k).lower(): k for k in known}
    text = (name if isinstance(name, str) else brief(name)).lower()[:80]
    close = difflib.get_close_matches(text, list(by_lower), n=3, cutoff=0.65)
    if not close:
        return ""
    alike = [each for each in close if _likeness(text, each) == _likeness(text, close[0])]
    best = max(alike, key=lambda each: len(commonprefix([text, each])))
    return f" (did you mean {by_lower[best]!r}?)"


def _likeness(one: str, other: str) -> float:
    return difflib.SequenceMatcher(None, other, one).ratio()


def brief(value: object) -> str:
    """A value as the user may have written it, on one short line whatever it is."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (date, time)):
        return value.isoformat()
    try:
        return _BRIEF.repr(value)
    except ValueError:  # Python refuses to print integers of more than 4300 digits
        return "a huge integer"


_BRIEF = reprlib.Repr()
_BRIEF.maxlevel, _BRIEF.maxstring, _BRIEF.maxlong, _BRIEF.maxother = 3, 80, 60, 80
