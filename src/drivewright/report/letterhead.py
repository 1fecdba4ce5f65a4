"""Company, author, logo and templates of a report, as the [report] table of its spec names them: read, and checked before they are used."""

import base64
import re
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from drivewright.errors import InputError

LARGEST_LOGO, LARGEST_TEMPLATE = 500_000, 200_000  # bytes
MOST_PIXELS = 4_000_000
PNG = b"\x89PNG\r\n\x1a\n"
SVG_ROOT = re.compile(rb"\A(?:\xef\xbb\xbf)?\s*(?:<\?xml[^>]*>\s*)?(?:<!--.*?-->\s*|<!DOCTYPE[^>\[]*>\s*)*<svg[\s>/]", re.DOTALL)
ENTITY = re.compile(rb"<!ENTITY", re.IGNORECASE)


class Letterhead(NamedTuple):
    """What stands in the head of a report besides its title; `templates` {file name: text} replace those of the page."""

    company: str = ""
    author: str = ""
    logo: bytes = b""
    suffix: str = ""  # of the logo: .svg or .png
    templates: Mapping[str, str] = {}

    @property
    def logo_source(self) -> str:
        """The logo as the source of an image, "" where there is none; a script inside an image does not run."""
        kind = {".svg": "image/svg+xml", ".png": "image/png"}.get(self.suffix)
        return f"data:{kind};base64,{base64.b64encode(self.logo).decode()}" if kind else ""

    def content(self) -> dict[str, str]:
        """What the templates print of it."""
        return {"company": self.company, "author": self.author, "logo": self.logo_source}


def read_letterhead(spec: Any) -> Letterhead:
    """The letterhead of a spec; InputError naming the key where a file is too large, or no picture."""
    table = getattr(spec, "report", None)
    if table is None:
        return Letterhead()
    logo, suffix = _logo(table.logo) if table.logo else (b"", "")
    return Letterhead(table.company, table.author, logo, suffix, {path.name: _template(path) for path in table.templates})


def _logo(path: Path) -> tuple[bytes, str]:
    """(bytes, suffix) of a logo; what it is says its content, not its name."""
    data = _read(path, LARGEST_LOGO, "report.logo")
    if data.startswith(PNG):
        width, height = struct.unpack(">II", data[16:24]) if len(data) >= 24 else (0, 0)
        if not 0 < width * height <= MOST_PIXELS:
            raise InputError(f"report.logo: {path.name} has {width} × {height} pixels; a logo has at most {MOST_PIXELS:,}")
        return data, ".png"
    if SVG_ROOT.match(data) and not ENTITY.search(data):
        return data, ".svg"
    raise InputError(f"report.logo: {path.name} is neither an SVG (without entities) nor a PNG file; save the logo as one of these")


def _template(path: Path) -> str:
    try:
        return _read(path, LARGEST_TEMPLATE, "report.templates").decode("utf-8")
    except UnicodeDecodeError:
        raise InputError(f"report.templates: {path.name} is not text in UTF-8; save it as UTF-8") from None


def _read(path: Path, most: int, key: str) -> bytes:
    """The bytes of a file; InputError where there are too many."""
    try:
        with path.open("rb") as stream:
            data = stream.read(most + 1)
    except OSError as error:
        raise InputError(f"{key}: {path.name} cannot be read: {error.strerror}") from None
    if len(data) > most:
        raise InputError(f"{key}: {path.name} has more than {most // 1000} kB, the most that is taken into a report; make it smaller")
    return data
