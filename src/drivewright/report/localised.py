"""A figure with its words in another language: replaced in the figure itself, before it is laid out, so that nothing is cut off."""

import logging
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FONTS = {  # of a language, the best one first; those that are not installed are left out
    "zh": (
        "Noto Sans CJK SC",
        "Noto Sans SC",
        "Source Han Sans SC",
        "PingFang SC",
        "Microsoft YaHei",
        "WenQuanYi Micro Hei",
        "WenQuanYi Zen Hei",
        "SimHei",
    )
}


def localised(figure: "Figure", words: Callable[[str], str], language: str) -> "Figure":
    """The figure, every text in it translated as far as it is known."""
    if language == "en":
        return figure
    from matplotlib.text import Text
    from matplotlib.ticker import FixedFormatter

    logging.getLogger("matplotlib.font_manager").addFilter(_is_no_weight)
    families = ["DejaVu Sans", *_installed(language)]
    for text in figure.findobj(Text):
        written = text.get_text()  # pyright: ignore[reportAttributeAccessIssue]  # findobj gives what was asked for
        told = _translated(written, words)
        text.set_fontfamily(families)  # pyright: ignore[reportAttributeAccessIssue]
        if told != written:
            text.set_text(told)  # pyright: ignore[reportAttributeAccessIssue]
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            formatter = axis.get_major_formatter()
            if isinstance(formatter, FixedFormatter):  # names along an axis
                formatter.seq = [_translated(str(each), words) for each in formatter.seq]
            axis.set_tick_params(labelfontfamily=families)
    return figure


def _is_no_weight(record: logging.LogRecord) -> bool:
    """Whether a message is about something else than a font that is there in one weight alone, as most Chinese ones are."""
    return "font weight" not in record.getMessage()


def _translated(text: str, words: Callable[[str], str]) -> str:
    """A text that may stand in several lines; what is not known keeps its lines."""
    whole = " ".join(text.split())
    told = words(whole)
    return text if told == whole else told


def _installed(language: str) -> list[str]:
    from matplotlib import font_manager

    known = {font.name for font in font_manager.fontManager.ttflist}
    return [name for name in FONTS[language] if name in known]
