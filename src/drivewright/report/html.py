"""The self-contained report page: no request leaves it, and nothing of the user's text is taken as markup."""

import json
import re
import traceback
from collections.abc import Collection, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drivewright.atomic import write_text
from drivewright.errors import InputError
from drivewright.report.content import Picture, Views, caption, content
from drivewright.report.form import ReportForm
from drivewright.report.letterhead import Letterhead, read_letterhead
from drivewright.report.names import file_name
from drivewright.report.numbering import in_order, numbered_figures, seen_in, with_figures
from drivewright.report.pack import pack_plot_groups, pack_scene
from drivewright.report.solids import pack_solids
from drivewright.report.words import Words, translated, words_of
from drivewright.result import Result
from drivewright.scene import Scene
from drivewright.view.palette import style_sheet

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup

HERE = Path(__file__).parent
SETTINGS: Any = {"autoescape": True, "trim_blocks": True, "lstrip_blocks": True}  # of every Jinja environment
NO_LETTERHEAD = Letterhead().content()
MODULES = (
    "clock.js",
    "scene.js",
    "drawing.js",
    "controls.js",
    "player.js",
    "plotting.js",
    "panel.js",
    "plots.js",
)  # each behind those that it imports
SOLID_MODULES = (
    "assembly.js",
    "cube.js",
    "pacing.js",
    "picking.js",
    "shaders.js",
    "triangles.js",
    "solid.js",
    "assembly_bar.js",
)  # behind those, where solids are shown


def write_report(
    result: Result[Any], seen: Views, folder: str | Path, pictures: Sequence[Picture] = (), form: ReportForm = ReportForm()
) -> Path:
    """Write `folder`/report.html: numbers, checks, motion player with linked plots, pictures, sources.  `seen` is a `Views`."""
    chosen = seen_in(form, result, seen)
    figures = numbered_figures(result, chosen)
    packed = packed_views(result, chosen, form.language, seen.scene)
    moving = {f"plot-{plot['name']}" for plot in packed["plots"]["plots"]} if packed and packed["plots"] else set()
    drawn = [(number, each) for number, each in in_order(pictures, figures) if form.detail != "short" or number <= len(figures)]
    text = page(
        "report.html.j2",
        with_figures(content(result, seen.remarks, form=form), result, chosen),
        read_letterhead(result.spec).templates,
        player=packed and data_text(packed),
        solids=packed is not None and "solids" in packed,
        pictures=[{**embedded(each), "number": number, "moving": _is_moving(each.name, moving, packed)} for number, each in drawn],
    )
    path = Path(folder) / "report.html"
    write_text(path, text)
    return path


def _is_moving(name: str, plots: Collection[str], packed: Mapping[str, Any] | None) -> bool:
    """Whether a picture stands for something that moves on the page."""
    solids = name == "solids" and packed is not None and "solids" in packed
    return solids or name in {file_name(plot) for plot in plots} or (packed is not None and name.startswith("scene-"))


def packed_views(result: Result[Any], seen: Views, language: str = "en", scene: Scene | None = None) -> dict[str, Any] | None:
    """The data of the player and of the plots, with the words of the player; None without a scene.

    `scene` is the one that moves, that of `seen` unless given."""
    scene = scene or seen.scene
    if scene is None:
        return None
    words = words_of(language, result.mechanism)
    plots = pack_plot_groups(result, scene, seen.plots)
    numbers = {figure.name: words("Figure *", figure.number) for figure in numbered_figures(result, seen)}
    captions = {plot.name: caption(plot) for plot in seen.plots}
    for plot in plots["plots"] if plots else ():
        for number, panel in enumerate(plot["panels"]):
            panel["meaning"] = "" if number else captions[plot["name"]]
            panel["figure"] = numbers[f"plot-{plot['name']}"]
    solids = {"solids": _named_solids(pack_solids(seen.solids, scene), words)} if seen.solids else {}
    texts = (*player_texts(), *(solid_texts() if solids else ()))
    spoken = {} if language == "en" else {"words": {english: words(english) for english in texts}}
    return {**translated({"scene": pack_scene(scene, result.units), "plots": plots}, words), **solids, **spoken}


def _named_solids(packed: dict[str, Any], words: Words) -> dict[str, Any]:
    """Packed solids, each part with its name in words as `label`."""
    return {**packed, "parts": [{**part, "label": words(part["name"].replace("_", " "))} for part in packed["parts"]]}


def data_text(packed: Mapping[str, Any]) -> str:
    """JSON that cannot end a script element."""
    plots = packed["plots"] and {
        "cycle": packed["plots"]["cycle"],
        "panels": [panel for plot in packed["plots"]["plots"] for panel in plot["panels"]],
    }
    data = {**packed, "plots": plots}
    return json.dumps(data, ensure_ascii=True, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


@cache
def player_texts() -> tuple[str, ...]:
    """The English texts of the player's controls."""
    table = re.search(r"export const TEXT = \{(.*?)\};", _text("controls.js"), re.DOTALL)
    return tuple(re.findall(r'"([^"]+)"', table[1])) if table else ()


@cache
def solid_texts() -> tuple[str, ...]:
    """The English texts of the viewer of solids."""
    found = [text for name in SOLID_MODULES for text in re.findall(r'\bt\("([^"]+)"', _text(name))]
    return (*dict.fromkeys(found), "Play (space)", "Pause (space)")


def page(template: str, values: Mapping[str, Any], templates: Mapping[str, str] | None = None, **more: object) -> str:
    """A template filled in; every value is escaped unless the template marks it safe.  `templates` of a user replace ours by name."""
    own = {name: text for name, text in (templates or {}).items() if name.endswith(".css")}
    solids = bool(more.get("solids"))
    look = own.pop("report.css", _text("templates/report.css")) + _text("player.css") + (_text("solid.css") if solids else "")
    language = values.get("language", "en")
    style = look + "".join(own.values()) + _page_numbers(language)
    script = scripts((*MODULES, *SOLID_MODULES) if solids else MODULES)
    filled = {"letterhead": NO_LETTERHEAD, **values, **more, "colours": style_sheet(), "style": style, "script": script}
    if not templates:
        return environment(language).get_template(template).render(**filled)
    try:
        return _environment_of(language, templates).get_template(template).render(**filled)
    except Exception as error:  # whatever a template of a user does wrong
        raise InputError(f"report.templates: {_place(error)}{type(error).__name__}: {error}; correct the template") from error


def _page_numbers(language: str) -> str:
    """The rule that puts "page 3 of 9" below every page on paper."""
    before, between, behind = words_of(language)("page * of *").split("*")
    content = f'"{before}" counter(page) "{between}" counter(pages) "{behind}"'
    return f"@page {{ @bottom-right {{ content: {content}; font: 8pt sans-serif; color: #666; }} }}\n"


def _place(error: Exception) -> str:
    """'report.html.j2, line 7: ' of the template that an error comes from."""
    name, line = getattr(error, "name", None), getattr(error, "lineno", None)
    if line is None:
        steps = [step for step in traceback.extract_tb(error.__traceback__) if step.filename.endswith((".j2", "<template>"))]
        name, line = (steps[-1].filename, steps[-1].lineno) if steps else (None, None)
    return f"{'template' if name == '<template>' else Path(name).name}, line {line}: " if name and line else ""


@cache
def environment(language: str = "en") -> "Environment":
    """The Jinja environment of the page templates, which escapes every value; `t` in it translates the words of the frame."""
    import jinja2

    return _prepared(
        jinja2.Environment(loader=jinja2.FileSystemLoader(HERE / "templates"), **SETTINGS, undefined=jinja2.StrictUndefined), language
    )


def _environment_of(language: str, templates: Mapping[str, str]) -> "Environment":
    """The same with templates of a user in front of ours, in Jinja's sandbox: they reach no file and no Python."""
    import jinja2
    from jinja2.sandbox import SandboxedEnvironment

    loader = jinja2.ChoiceLoader([jinja2.DictLoader(templates), jinja2.FileSystemLoader(HERE / "templates")])
    return _prepared(SandboxedEnvironment(loader=loader, **SETTINGS, undefined=jinja2.StrictUndefined), language)


def _prepared(templates: "Environment", language: str) -> "Environment":
    """An environment with our filters and words."""
    templates.filters["breakable"] = _breakable
    templates.globals["t"] = words_of(language)
    templates.globals["language"] = language
    return templates


def _breakable(name: str) -> "Markup":
    """A dotted name that may be broken behind its dots and underscores."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"([._])", r"\1<wbr>", str(escape(name))))


@cache
def scripts(modules: Sequence[str] = MODULES) -> str:
    """The modules of the player and the plots as one: the lines that import from one another go, the rest stays as it is."""
    return "\n".join(re.sub(r"^(import|export) \{.*\} from .*$", "", _text(name), flags=re.MULTILINE) for name in modules)


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
    source = Markup(f"data:image/svg+xml;charset=utf-8,{data}")
    return {"name": picture.name, "title": picture.title, "meaning": picture.meaning, "source": source}
