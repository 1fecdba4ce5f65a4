"""In which form a report is wanted: how much it says, and in which language."""

from typing import Literal, NamedTuple, TypeAlias, get_args

from drivewright.errors import UnknownName

Detail: TypeAlias = Literal["short", "normal", "full"]
Language: TypeAlias = Literal["en", "zh"]
MAIN_PLOTS = 2  # that a short report shows


class ReportForm(NamedTuple):
    """short: the first page alone; normal: with figures, values, tables, spec and sources; full: all open, and how it was computed."""

    detail: Detail = "normal"
    language: Language = "en"


def report_form(detail: str = "normal", language: str = "en") -> ReportForm:
    """The form of these names; UnknownName for others."""
    for what, name, known in (("form of a report", detail, get_args(Detail)), ("language of reports", language, get_args(Language))):
        if name not in known:
            raise UnknownName(what, name, known)
    return ReportForm(detail, language)  # pyright: ignore[reportArgumentType]  # looked up above
