"""A folder that is replaced as a whole: by one exchange of two names where the system has it, else by two renames.

The new folder is written as `OUT.tmp-<random>`.  What it is exchanged for, or what is moved aside as `OUT.old-<random>`, gives back to
the new one whatever no run writes; only then is the rest of it removed.  A process that dies in between leaves such a folder, and the
next one with the same OUT ends its work (`recover`).  Nothing else has such a name, and what a living process holds is left alone.
"""

import errno
import os
import re
import shutil
from collections.abc import Callable, Collection, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from drivewright.atomic import TOKEN, UNFINISHED, force, hold, is_held, locate, token
from drivewright.errors import InputError
from drivewright.report.renames import exchange, move


class Place(NamedTuple):
    """A folder that is replaced as a whole: the names in it that its writer writes, and what raises InputError for a folder of others."""

    path: Path
    ours: Collection[str]
    refuse: Callable[[Path], None]

    def accepts(self, folder: Path) -> bool:
        """Whether a folder may be replaced."""
        try:
            self.refuse(folder)
        except InputError:
            return False
        return True


@contextmanager
def replacing_folder(place: Place) -> Iterator[Path]:
    """A new folder to write to; it takes the place of `place.path` when the block ends well, else it is removed."""
    parent = place.path.parent
    parent.mkdir(parents=True, exist_ok=True)
    fresh = _beside(place.path, "tmp")
    try:
        with ExitStack() as held:
            with hold(parent):
                fresh.mkdir()
                held.enter_context(hold(fresh))
            yield fresh
            _force_tree(fresh)
            with hold(parent):
                place.refuse(place.path)
                _put(fresh, place.path)
    except OSError as error:
        locate(error, place.path)
        raise
    finally:
        recover(place)


def recover(place: Place) -> None:
    """End what processes that died have left beside a folder: bring back what is not theirs, remove the rest."""
    parent = place.path.parent
    if not parent.is_dir():
        return
    with hold(parent):
        for old in _remnants(place.path, "old"):
            if not place.path.exists() and place.accepts(old):
                old.rename(place.path)
        for left in (*_remnants(place.path, "tmp"), *_remnants(place.path, "old")):
            if not is_held(left):
                _dissolve(left, place)


def _put(fresh: Path, out: Path) -> None:
    """The new folder in its place, the old one under another name."""
    while not move(fresh, out):
        with suppress(FileNotFoundError):  # the old one has just been taken away
            if not exchange(fresh, out):
                _swap(fresh, out)
            break
    force(out.parent)


def _swap(fresh: Path, out: Path) -> None:
    """The same by two renames; the old folder goes back where the second one fails.

    Where somebody has made the folder anew in between, to put a file into it, that one is taken away too: what is in it comes back.
    """
    while True:
        old = _beside(out, "old")
        out.rename(old)
        try:
            fresh.rename(out)
            return
        except BaseException as error:
            if getattr(error, "errno", None) not in (errno.ENOTEMPTY, errno.EEXIST):
                old.rename(out)
                raise


def _beside(out: Path, role: str) -> Path:
    return out.with_name(f"{out.name}.{role}-{token()}")


def _remnants(out: Path, role: str) -> list[Path]:
    """Folders that a writer of `out` has left, or is at work on."""
    name = re.compile(rf"{re.escape(out.name)}\.{role}-{TOKEN}")
    found = sorted(path for path in out.parent.iterdir() if name.fullmatch(path.name))
    return [path for path in found if path.is_dir() and not path.is_symlink()]


def _dissolve(left: Path, place: Place) -> None:
    """Bring what its writer has not written from a remnant to its place, and remove the rest; without a place, all of it stays.

    A file that was not finished when its folder was taken away is never brought: its writer has lost it, and begins again.
    """
    for file in left.rglob(".*"):
        if UNFINISHED.fullmatch(file.name) and _is_file(file):
            file.unlink(missing_ok=True)
    others = [entry for entry in sorted(left.iterdir()) if entry.name not in place.ours]
    if others:
        if not place.path.is_dir() or not place.accepts(place.path):
            return
        for entry in others:
            _bring(entry, place.path / entry.name)
        force(place.path)
    for name in place.ours:
        _remove(left / name)
    with suppress(OSError):  # somebody has put something in
        left.rmdir()


def _bring(entry: Path, target: Path) -> None:
    """Move a file or a folder, into the folder that is there; a file that differs from the one that is there comes to lie beside it."""
    with suppress(FileNotFoundError):  # a writer has just given it its name
        if move(entry, target):
            return
    if _is_folder(entry) and _is_folder(target):
        for inner in sorted(entry.iterdir()):
            _bring(inner, target / inner.name)
        with suppress(OSError):  # somebody has put something in
            entry.rmdir()
    elif not os.path.lexists(entry):
        return
    elif _is_file(entry) and _is_file(target) and entry.read_bytes() == target.read_bytes():
        entry.unlink()
    else:
        move(entry, target.with_name(f"{target.stem}.recovered-{token()}{target.suffix}"))


def _is_folder(path: Path) -> bool:
    return path.is_dir() and not path.is_symlink()


def _is_file(path: Path) -> bool:
    return path.is_file() and not path.is_symlink()


def _remove(path: Path) -> None:
    if _is_folder(path):
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


def _force_tree(folder: Path) -> None:
    """Force all that is in a folder to the disk."""
    for path in (*folder.rglob("*"), folder):
        force(path)
