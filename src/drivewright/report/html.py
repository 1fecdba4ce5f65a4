"""The self-contained report page: no request leaves it, and nothing of the user's text is taken as markup."""

import json
import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drivewright.atomic import write_text
from drivewright.report.content import Picture, Views, content
from drivewright.report.pack import pack_plots, pack_scene
from drivewright.result import Result
from drivewright.view.palette import style_sheet

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup

HERE = Path(__file__).parent
MODULES = ("clock.js", "scene.js", "drawing.js", "controls.js", "player.js", "plots.js")  # each behind those that it imports


def write_report(result: Result[Any], seen: Views, folder: str | Path, pictures: Sequence[Picture] = ()) -> Path:
    """Write `folder`/report.html: numbers, checks, motion player with linked plots, pictures, sources.  `seen` is a `Views`."""
    text = page(
        "report.html.j2",
        content(result, seen.remarks),
        player=player_data(result, seen),
        pictures=[embedded(picture) for picture in pictures],
    )
    path = Path(folder) / "report.html"
    write_text(path, text)
    return path


def player_data(result: Result[Any], seen: Views) -> str | None:
    """The player's and the plots' data as JSON that cannot end a script element; None without a scene."""
    if seen.scene is None:
        return None
    data = {"scene": pack_scene(seen.scene, result.units), "plots": pack_plots(result, seen.scene, seen.plots)}
    return json.dumps(data, ensure_ascii=True, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def page(template: str, values: Mapping[str, Any], **more: object) -> str:
    """A template filled in; every value is escaped unless the template marks it safe."""
    look = _text("templates/report.css") + _text("player.css")
    return environment().get_template(template).render(**values, **more, colours=style_sheet(), style=look, script=scripts())


@cache
def environment() -> "Environment":
    """The Jinja environment of the page templates, which escapes every value."""
    import jinja2

    templates = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    templates.filters["breakable"] = _breakable
    return templates


def _breakable(name: str) -> "Markup":
    """A dotted name that may be broken behind its dots and underscores."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"([._])", r"\1<wbr>", str(escape(name))))


@cache
def scripts() -> str:
    """The modules of the player and the plots as one: the lines that import from one another go, the rest stays as it is."""
    return "\n".join(re.sub(r"^(import|export) \{.*\} from .*$", "", _text(name), flags=re.MULTILINE) for name in MODULES)


def template_text(name: str) -> str:
    """A file beside the templates, as text."""
    return _text(f"templates/{name}")


@cache
def _text(name: str) -> str:
    return (HERE / name).read_text(encoding="utf-8")


def embedded(picture: Picture) -> "dict[str, str | Markup]":
    """A picture as an image of its own, so that the ids inside several SVGs cannot meet; as text, a quarter smaller than base64."""
    from markupsafe import Markup

    data = re.sub(r"\s+", " ", picture.svg).replace("%", "%25").replace("#", "%23").replace("&", "&amp;").replace('"', "%22")
    return {"name": picture.name, "title": picture.title, "source": Markup(f"data:image/svg+xml;charset=utf-8,{data}")}
