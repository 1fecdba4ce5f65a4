"""Cards for notebooks: a heading with its verdict, a figure, tables and notes as one piece of HTML without scripts.

Every text is escaped.  The style is confined to the card; its colours are dark where the page says that it is: JupyterLab, Visual Studio
Code, and documentation themes do.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape

from drivewright.view.palette import ROLES, declarations

CARD = "drivewright-card"
RULE = f".{CARD}" * 3  # stronger than a notebook's own rules for tables
LARGEST_FIGURE = 120_000  # characters of SVG
DARK_PAGES = (
    'body[data-jp-theme-light="false"]',  # JupyterLab
    "body.vscode-dark",
    '[data-theme="dark"]',  # Sphinx themes
    '[data-md-color-scheme="slate"]',  # Material for MkDocs
)
STYLE = """
%(rule)s { %(light)s box-sizing: border-box; display: flow-root; max-width: 62rem; margin: .4rem 0; padding: .8rem 1rem;
  font: 13px/1.5 system-ui, -apple-system, "Segoe UI", sans-serif; color: var(--ink); background: var(--surface);
  border: 1px solid var(--line); border-radius: 6px }
%(dark_rules)s { %(dark)s }
%(rule)s header { display: flex; flex-wrap: wrap; align-items: baseline; gap: .2rem .7rem; margin: 0 0 .5rem }
%(rule)s header b { font-size: 15px }
%(rule)s header span { color: var(--muted) }
%(rule)s header .good, %(rule)s header .warn, %(rule)s header .bad { padding: 0 .5rem; border-radius: 9px; font-weight: 600 }
%(rule)s header .good { color: var(--good); background: var(--good-soft) }
%(rule)s header .warn { color: var(--warn); background: var(--warn-soft) }
%(rule)s header .bad { color: var(--bad); background: var(--bad-soft) }
%(rule)s .side { display: flex; flex-wrap: wrap; gap: .5rem 1.4rem; align-items: flex-start }
%(rule)s figure { flex: 0 1 auto; margin: 0; max-width: 100%% }
%(rule)s .side > :not(figure) { flex: 1 1 24rem }
%(rule)s svg { display: block; max-width: 100%%; max-height: 24rem; height: auto }
%(rule)s svg * { stroke-linejoin: round; stroke-linecap: butt }
%(rule)s table { border-collapse: collapse; margin: 0 0 .5rem; font-size: 13px; color: inherit; border: 0 }
%(rule)s tr { background: none; border: 0 }
%(rule)s th, %(rule)s td { padding: .15rem .9rem .15rem 0; text-align: left; vertical-align: top; white-space: normal; max-width: none;
  border: 0; border-bottom: 1px solid var(--line) }
%(rule)s th { color: var(--muted); font-weight: 400 }
%(rule)s .n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums }
%(rule)s code { font-size: 12px; color: var(--muted); background: none; padding: 0 }
%(rule)s .pass { color: var(--good) }
%(rule)s .fail { color: var(--bad); font-weight: 600 }
%(rule)s ul { margin: 0 0 .5rem; padding: 0 0 0 1.1rem }
%(rule)s summary { cursor: pointer; color: var(--muted); margin: .2rem 0 }
"""


def card(title: str, kind: str, verdict: Mapping[str, str], blocks: Iterable[str]) -> str:
    """A whole card: title, kind of drive and verdict {'state', 'text'}, below them blocks of HTML; empty blocks are left out."""
    heading = f'<b>{escape(title)}</b><span>{escape(kind)}</span><span class="{verdict["state"]}">{escape(verdict["text"])}</span>'
    return f'<div class="{CARD}"><style>{style_sheet()}</style><header>{heading}</header>{"".join(blocks)}</div>'


def style_sheet() -> str:
    """The rules of a card, for light and dark pages."""
    dark_rules = ", ".join(f"{page} {RULE}" for page in DARK_PAGES)
    return STYLE % {"rule": RULE, "light": declarations("light"), "dark": declarations("dark"), "dark_rules": dark_rules}


def beside(*blocks: str) -> str:
    """Blocks side by side where the page is wide enough."""
    return f'<div class="side">{"".join(blocks)}</div>' if any(blocks) else ""


def table(rows: Iterable[Sequence[str]], head: Sequence[str] = (), kinds: str = "") -> str:
    """Rows of texts; `kinds` has a letter for each column: "n" a number, "c" a name as in code, anything else a text.  "" without rows.

    A cell ✓ or ✗ has its colour.
    """
    body = "".join(f"<tr>{''.join(_cell(text, kind) for text, kind in _kinds(row, kinds))}</tr>" for row in rows)
    top = "".join(f"<th{_class(kind)}>{escape(text)}</th>" for text, kind in _kinds(head, kinds))
    return f"<table>{f'<thead><tr>{top}</tr></thead>' if top else ''}<tbody>{body}</tbody></table>" if body else ""


def _kinds(cells: Sequence[str], kinds: str) -> Iterable[tuple[str, str]]:
    return zip(cells, kinds.ljust(len(cells)), strict=False)


def _cell(text: str, kind: str) -> str:
    if text in SIGNS:
        return f'<td class="{SIGNS[text]}">{text}</td>'
    return f"<td><code>{_breakable(text)}</code></td>" if kind == "c" else f"<td{_class(kind)}>{escape(text)}</td>"


def _breakable(name: str) -> str:
    """A dotted name, escaped, that may be broken behind its dots and underscores."""
    return re.sub(r"([._])(?=.)", r"\1<wbr>", escape(name))


def _class(kind: str) -> str:
    return ' class="n"' if kind == "n" else ""


SIGNS = {"✓": "pass", "✗": "fail"}


def notes(lines: Iterable[str]) -> str:
    """A list of sentences; "" without any."""
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    return f"<ul>{items}</ul>" if items else ""


def folded(summary: str, block: str) -> str:
    """A block that opens with a click; "" for an empty one."""
    return f"<details><summary>{escape(summary)}</summary>{block}</details>" if block else ""


def figure(svg: str, caption: str, width: int, follows_page: bool = True) -> str:
    """A picture of SVG text, `width` pixels wide at most; "" for one of more than `LARGEST_FIGURE` characters.

    The caption is for those who hear the page.  A picture whose colours are data, such as a map, does not follow the page: it stays light.
    """
    drawing = _bare(svg).replace("<svg", f'<svg role="img" aria-label="{escape(caption)}"', 1)
    drawing = _themed(drawing) if follows_page else drawing
    if len(drawing) > LARGEST_FIGURE:
        return ""
    return f'<figure style="width: {width}px">{drawing}</figure>'


def _bare(svg: str) -> str:
    """The element <svg> alone: no prolog, no metadata, no rules that would reach beyond it, only the ids that it refers to itself."""
    text = svg[svg.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>|<style[^>]*>.*?</style>|<!--.*?-->", "", text, flags=re.DOTALL)
    referred = set(re.findall(r'#([^")]+)[")]', text))
    text = re.sub(r' id="([^"]*)"', lambda found: found[0] if found[1] in referred else "", text)
    return re.sub(r">\s+<", "><", re.sub(r"\s+", " ", text)).strip()


def _themed(svg: str) -> str:
    """The same with the colours of the palette by role, so that they follow the page."""
    roles = {light: role for role, (light, _) in ROLES.items()}
    return re.sub(r"#[0-9a-f]{6}\b", lambda found: f"var(--{roles[found[0]]},{found[0]})" if found[0] in roles else found[0], svg)
