"""What pages load: the typesetter of the formulas (MathJax, one file of the package that brings it) and the mark of the program."""

import importlib.util
import shutil
from collections.abc import Callable
from pathlib import Path

import drivewright

PACKAGE = "mathjax"  # of the distribution django-static-mathjax, which holds MathJax's files and nothing else
SCRIPT = "static/mathjax/es5/tex-svg-full.js"  # TeX in, SVG out; no fonts to load
LICENCE = "static/mathjax/LICENSE"


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/assets/mathjax and docs/assets/mark.svg."""
    found = importlib.util.find_spec(PACKAGE)
    if found is None or found.origin is None:
        raise SystemExit("MathJax is not installed: pip install 'drivewright[docs]'")
    source, target = Path(found.origin).parent, docs / "assets" / "mathjax"
    target.mkdir(parents=True, exist_ok=True)
    for file in (SCRIPT, LICENCE):
        shutil.copyfile(source / file, target / Path(file).name)
    shutil.copyfile(Path(drivewright.__file__).parent / "studio" / "web" / "mark.svg", docs / "assets" / "mark.svg")
