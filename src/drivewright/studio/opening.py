"""Where a design comes from: a file of this machine, a preset, the end of an address."""

import base64
import zlib
from dataclasses import replace
from pathlib import Path

from drivewright import registry
from drivewright.errors import InputError, SpecError
from drivewright.spec import preset_path
from drivewright.spec.parsing import read_text
from drivewright.studio.design import Design

LARGEST = 1_000_000  # characters that a page may send as files, or as a shared design


def opened(path: str | Path) -> Design:
    """The design of a spec file on this machine; it may read what it names, and the tables beside it."""
    text, folder = read_text(path), Path(path).resolve().parent
    try:
        design = Design({}, folder).with_text(text)
    except SpecError as error:
        raise error.located(file=str(path)) from None
    named = design.spec().data_files()
    beside = [beside_path for pattern in ("*.csv", "*.parquet") for beside_path in folder.glob(pattern)]
    return replace(design, readable=frozenset([*named, *beside]))


def preset(kind: str, name: str | None = None) -> Design:
    """A preset of a kind, the one to start with unless named."""
    path = preset_path(str(kind), name and str(name))
    if path is None:
        raise InputError(f"{kind} brings no preset to start from")
    return opened(path)


def first_design() -> Design:
    """Where the studio begins when it is given no spec: the first kind's own example."""
    return preset(next(kind for kind in registry.kinds() if registry.mechanism(kind).presets()))


def limited(text: object) -> str:
    """A text of a page; InputError where it is none, or too long."""
    if not isinstance(text, str) or len(text) > LARGEST:
        raise InputError(f"this is no text, or has more than {LARGEST:,} characters; that is too much for the studio")
    return text


def packed(text: str) -> str:
    """A text as the end of an address."""
    return "d=" + base64.urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")


def unpacked(fragment: str) -> str:
    """The text that `packed` was given; InputError where it is none, or too long."""
    letters = str(fragment).removeprefix("d=")
    try:
        raw = base64.b64decode(letters + "=" * (-len(letters) % 4), altchars="-_", validate=True)
        text = zlib.decompressobj().decompress(raw, LARGEST + 1).decode()
    except (ValueError, zlib.error):
        text = ""
    if not text:
        raise InputError("the design in this address is damaged; request the file, or the address again")
    return limited(text)
