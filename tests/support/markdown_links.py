"""Pages of the documentation as tests read them: their places on the site, their links, the anchors of their headings."""

import re
from fnmatch import fnmatch
from pathlib import Path

from places import ROOT

DOCS = ROOT / "docs"
IGNORED = [line.lstrip("!/") for line in (ROOT / ".gitignore").read_text(encoding="utf-8").splitlines() if line.startswith("/docs/")]
KEPT = [line.lstrip("!/") for line in (ROOT / ".gitignore").read_text(encoding="utf-8").splitlines() if line.startswith("!/docs/")]


def is_generated(path: Path) -> bool:
    """Whether a file of the checkout is made by docs/generate.py."""
    name = path.relative_to(ROOT).as_posix()
    return name not in KEPT and any(fnmatch(name, pattern) or name.startswith(pattern.rstrip("*/") + "/") for pattern in IGNORED)


def written_pages() -> dict[Path, Path]:
    """{place on the site or in the checkout: file} of every page that somebody wrote."""
    pages = {path: path for path in DOCS.rglob("*.md") if not is_generated(path) and not path.name.endswith(".in.md")}
    pages |= {ROOT / name: ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")}
    for theory in ROOT.glob("src/drivewright/mechanisms/*/theory.md"):
        pages[DOCS / "theory" / f"{theory.parent.name.replace('_', '-')}.md"] = theory
    pages[DOCS / "theory" / "motion.md"] = DOCS / "theory" / "motion.in.md"
    return pages


def prose(text: str) -> str:
    """A page without blocks of code and without code in lines."""
    return re.sub(r"`[^`\n]+`", "", re.sub(r"^( *)```.*?^\1```", "", text, flags=re.DOTALL | re.MULTILINE))


def links(text: str) -> list[str]:
    """Targets of the relative links and images of a page."""
    shown = re.sub(r"^( *)```.*?^\1```", "", text, flags=re.DOTALL | re.MULTILINE)
    targets = re.findall(r"\]\(<?([^)\s>]+)>?(?: \"[^\"]*\")?\)", shown) + re.findall(r"(?:src|href)=\"([^\"]+)\"", shown)
    return [target for target in targets if not re.match(r"[a-z]+:", target)]


def anchors(text: str) -> set[str]:
    """Anchors of the headings of a page, as mkdocs makes them, and those that are given."""
    shown = re.sub(r"^( *)```.*?^\1```", "", text, flags=re.DOTALL | re.MULTILINE)
    headings = re.findall(r"^#{1,6} +(.+?)\s*$", shown, flags=re.MULTILINE)
    given = set(re.findall(r"\{#([\w.-]+)[^}]*\}", shown)) | set(re.findall(r"\bid=\"([^\"]+)\"", shown))
    return given | {slug(heading) for heading in headings}


def slug(heading: str) -> str:
    """The anchor of a heading: letters, digits, _ and - in small letters, blanks as hyphens."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"\{#[^}]*\}", "", heading))
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", text.encode("ascii", "ignore").decode()).strip().lower())
