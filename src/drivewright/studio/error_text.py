"""Messages for a page, in one line and without the folders of this machine."""

import re
from pathlib import Path

# Absolute paths in a message, but neither units (N m/rad, 1/mm) nor addresses (https://...).
FOLDERS = re.compile(r"""(?<![\w.)\]/])(?:[A-Za-z]:[\\/]+|\\\\|/)(?:[^\s/\\'":,;<>|]+[/\\]+)+(?=[^\s/\\])""")
QUOTED = re.compile(r"""(['"])(?:[A-Za-z]:[\\/]|\\\\|/)[^'"\n]*[\\/]([^'"\\/\n]+)\1""")


def without_folder(message: str, *folders: Path) -> str:
    """A message without the folders of this machine: "/home/x/y/lift.csv" -> "lift.csv"."""
    for folder in sorted({text for each in folders for text in (str(each), str(each.resolve()))}, key=len, reverse=True):
        message = re.sub(re.escape(folder.rstrip("/\\")) + r"[/\\]+", "", message) if len(folder) > 1 else message
    return FOLDERS.sub("", QUOTED.sub(r"\1\2\1", message))


def last_line(text: str) -> str:
    """What a bug's traceback ends with, or the one line that an error is."""
    return text.strip().splitlines()[-1]
