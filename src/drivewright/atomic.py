"""Files that appear whole or not at all: written under another name beside their place, forced to the disk, renamed.

The other name is random, and its writer holds a lock on it: a name of this kind that nobody holds was left by a process that died, and
the next writer of the same file removes it.
"""

import os
import re
import secrets
import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # no such locks on this system
    fcntl = None

TOKEN = r"[0-9a-f]{16}"
UNFINISHED = re.compile(rf"\..+\.{TOKEN}\.tmp(\..*)?")  # the other name of any file


def token() -> str:
    """Part of a name that no other process takes."""
    return secrets.token_hex(8)


@contextmanager
def replacing(path: str | Path, clear: bool = True) -> Iterator[Path]:
    """A temporary name beside `path` to write to; it takes the place of `path` when the block ends well, else it is removed.

    `clear` False leaves what dead writers of `path` left: for a folder of very many files whose owner looks for that once.
    """
    path = Path(path)
    _make_folder(path.parent)
    if clear:
        _remove_remnants(path)
    temporary = path.with_name(f".{path.name}.{token()}.tmp{path.suffix}")
    try:
        with _made(temporary):
            yield temporary
            force(temporary)
            temporary.replace(path)
            force(path.parent)
    except OSError as error:
        locate(error, path)
        raise
    finally:
        temporary.unlink(missing_ok=True)


def locate(error: OSError, path: Path) -> None:
    """Names the file or folder that was written in an error of the disk that does not name one itself."""
    error.filename = error.filename or str(path)


def write_text(path: str | Path, text: str) -> None:
    """`text` as UTF-8 with plain newlines, the same bytes on every system."""
    with replacing(path) as temporary:
        temporary.write_bytes(text.encode())


def copy(source: str | Path, path: str | Path) -> None:
    """A copy of a file, byte for byte."""
    with replacing(path) as temporary:
        shutil.copyfile(source, temporary)


def force(path: Path) -> None:
    """Force a file, or the names in a folder, to the disk."""
    if os.name == "nt":  # folders cannot be opened there, and files only for writing
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def is_held(path: Path) -> bool:
    """Whether a living process holds a file or folder; True where the system cannot say."""
    if fcntl is None:
        return True
    handle = os.open(path, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(handle)
    return False


@contextmanager
def hold(path: Path) -> Iterator[None]:
    """Hold a file or folder: `is_held` says so to every other process, until this one releases it or ends."""
    if fcntl is None:
        yield
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        with suppress(OSError):  # a file system without locks
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def _make_folder(folder: Path) -> None:
    """Make a folder unless it is there; again where another process exchanges it at this moment."""
    while not folder.is_dir():
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except FileExistsError:
            if folder.exists() and not folder.is_dir():
                raise


@contextmanager
def _made(file: Path) -> Iterator[None]:
    """A new empty file, held; made again where another process took it for a remnant in between."""
    while True:
        file.open("xb").close()
        with ExitStack() as held:
            with suppress(FileNotFoundError):
                held.enter_context(hold(file))
            if file.exists():
                yield
                return


def _remove_remnants(path: Path) -> None:
    """Remove what writers of `path` left that died."""
    left = re.compile(rf"\.{re.escape(path.name)}\.{TOKEN}\.tmp{re.escape(path.suffix)}")
    for file in list(path.parent.iterdir()):
        if left.fullmatch(file.name) and file.is_file() and not file.is_symlink():
            with suppress(OSError):  # held by a living writer, gone by now, or not ours to remove
                _remove_unheld(file)


def _remove_unheld(file: Path) -> None:
    """Remove a file while it is held here, so that no writer can begin to hold it in between; OSError where another holds it."""
    if fcntl is None:
        return
    handle = os.open(file, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if os.path.samestat(os.fstat(handle), file.stat()):  # else its writer has made it again since another process removed it
            file.unlink()
    finally:
        os.close(handle)
