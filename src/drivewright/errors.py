"""Every error a user can cause or meet, in one tree.

::

    DrivewrightError
    ├── InputError (ValueError)          the request has no meaning or no solution     exit code 2
    │   ├── SpecError                    a key of a spec file, named with its value
    │   │   └── UnitError                a quantity without, or with the wrong, unit
    │   ├── UnknownName                  a kind, law, value ... that nobody registered
    │   ├── DoesNotAssemble              a loop that does not close, a singular system
    │   └── MissingExtra                 an optional dependency is not installed
    └── SolverError (RuntimeError)       a solver gave up; carries the partial result  exit code 4

A message says what, where, how much, and what to try.  A design that can be computed but should not be built is
no error: it is a failed check of the result.
"""

import difflib


class DrivewrightError(Exception):
    """Root of the tree; the command line turns it into one message and `exit_code`."""

    exit_code = 2


class InputError(DrivewrightError, ValueError):
    """The request has no meaning or no solution."""


class SpecError(InputError):
    """A key of a spec is wrong: `key` is its dotted path, `file` where it stands (None outside a file)."""

    def __init__(self, message, key=None, file=None):
        super().__init__(message)
        self.message, self.key, self.file = message, key, file

    def __str__(self):
        return " ".join(part for part in (f"{self.file}:" if self.file else "", f"{self.key}:" if self.key else "", self.message) if part)

    def located(self, key=None, file=None):
        """The same complaint with its place filled in."""
        return type(self)(self.message, key if key is not None else self.key, file if file is not None else self.file)


class UnitError(SpecError):
    """A quantity without, or with the wrong, unit."""


class UnknownName(InputError):
    """A name that is not among the known ones."""

    def __init__(self, what, name, known):
        super().__init__(f"no {what} is called {name!r}{nearest(name, known)}; known: {', '.join(sorted(known))}")


class DoesNotAssemble(InputError):
    """A loop that does not close, or a system without a solution."""


class MissingExtra(InputError):
    """An optional dependency is needed and not installed."""

    def __init__(self, what, extra, cause=None):
        reason = f" ({cause})" if cause else ""
        super().__init__(f"{what} needs the extra '{extra}', which is not installed{reason}; try: pip install 'drivewright[{extra}]'")
        self.extra = extra


class SolverError(DrivewrightError, RuntimeError):
    """A solver gave up.  `partial` is what it had."""

    exit_code = 4

    def __init__(self, message, partial=None):
        super().__init__(message)
        self.partial = partial


def nearest(name, known):
    """Hint ' (did you mean ...?)' when a known name is close, else ''."""
    close = difflib.get_close_matches(str(name), list(known), n=1, cutoff=0.6)
    return f" (did you mean {close[0]!r}?)" if close else ""
