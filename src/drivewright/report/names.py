"""Names of files that are valid on all file systems."""

import re


def file_name(name: str) -> str:
    """A name as part of a file name."""
    return re.sub(r"[^\w.-]+", "-", name).strip(".-") or "unnamed"
