"""The [report] table: whose report it is and with which templates its page is made.  The same for every kind of drive."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, ValidationInfo

from drivewright.errors import MissingFile, brief
from drivewright.spec.base import Spec
from drivewright.spec.fields import DataFile, Field, Text

TEMPLATE_SUFFIXES = (".j2", ".css")
MOST_TEMPLATES = 20  # files in a folder of templates


def _beside_spec(value: Any, info: ValidationInfo) -> Any:
    """A path that stays in the folder of the spec file; what Python code sets may lie anywhere, for it has no such folder."""
    folder = (info.context or {}).get("folder", ".")
    if folder == "." or not isinstance(value, (str, Path)) or "\0" in str(value):
        return value  # no path at all is refused by the next validator
    home = Path(folder).resolve()
    try:
        inside = (home / value).resolve().is_relative_to(home)
    except (OSError, RuntimeError):  # a loop of links
        inside = False
    if not inside:
        raise ValueError(f"{brief(str(value))} lies outside the folder of the spec; copy it into that folder")
    return value


def _template_files(value: Any, info: ValidationInfo) -> Any:
    """The templates in a folder; a list of files stands as it is."""
    if not isinstance(value, (str, Path)):
        return value
    folder = Path((info.context or {}).get("folder", ".")) / _beside_spec(value, info)
    try:
        files: Sequence[Path] = sorted(path for path in folder.iterdir() if path.suffix in TEMPLATE_SUFFIXES)
    except (OSError, ValueError):
        files = []
    if not files:
        raise MissingFile(
            f"there is no folder with templates {str(folder)!r}; it holds report.html.j2 or report.css, its path is relative to the spec"
        )
    if len(files) > MOST_TEMPLATES:
        raise ValueError(f"{brief(str(value))} holds {len(files)} templates; at most {MOST_TEMPLATES} are read")
    return [str(path.absolute()) for path in files]


FileBesideSpec: TypeAlias = Annotated[DataFile, BeforeValidator(_beside_spec)]
Templates: TypeAlias = Annotated[tuple[FileBesideSpec, ...], BeforeValidator(_template_files)]


class Report(Spec):
    """Company, logo, author and templates of the reports."""

    company: Text = Field("", description="company in the head of reports")
    logo: FileBesideSpec | None = Field(
        None, examples=["logo.svg"], description="SVG or PNG file in the spec's folder, in the head of reports"
    )
    author: Text = Field("", description="author in the head of reports")
    templates: Templates = Field(
        (), description='folder in the spec\'s folder, e.g. "templates", whose report.html.j2 and report.css replace ours'
    )
