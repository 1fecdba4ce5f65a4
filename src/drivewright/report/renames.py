"""Renames that the standard library does not have: two names exchanged at once, and a name that is never taken from something else."""

import ctypes
import errno
import os
from collections.abc import Callable
from functools import cache
from pathlib import Path

HERE = -100  # AT_FDCWD of fcntl.h
NO_REPLACE, EXCHANGE = 1, 2  # flags of renameat2(2)
TAKEN = (errno.ENOTEMPTY, errno.EEXIST, errno.ENOTDIR, errno.EISDIR)  # somebody has just given the name to something else
UNABLE = (errno.ENOSYS, errno.EINVAL, errno.ENOTSUP)  # the answer of a kernel, or of a file system, that cannot do it


def exchange(first: Path, second: Path) -> bool:
    """Exchange two names at once; whether system and file system can."""
    return _renamed(first, second, EXCHANGE)


def move(source: Path, target: Path) -> bool:
    """Rename where nothing has the new name; whether nothing had."""
    try:
        if _renamed(source, target, NO_REPLACE):
            return True
    except FileExistsError:
        return False
    if os.path.lexists(target):
        return False
    try:
        source.rename(target)
    except OSError as error:
        if error.errno in TAKEN:
            return False
        raise
    return True


def _renamed(source: Path, target: Path, flag: int) -> bool:
    """Whether renameat2 did it; False where there is no such call."""
    call = _renameat2()
    if call is None:
        return False
    if call(HERE, os.fsencode(source), HERE, os.fsencode(target), flag) == 0:
        return True
    error = ctypes.get_errno()
    if error in UNABLE:
        return False
    raise OSError(error, os.strerror(error), str(source), None, str(target))


@cache
def _renameat2() -> Callable[..., int] | None:
    """The C library's call; None where it has none."""
    try:
        call = ctypes.CDLL(None, use_errno=True).renameat2
    except (AttributeError, OSError, TypeError):
        return None
    call.argtypes = (ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_uint)
    return call
