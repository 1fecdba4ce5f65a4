"""Fill the pages and pictures that are made from the code, each by a module of docs/builders.

python docs/generate.py                 # all steps, in about two minutes
python docs/generate.py theory papers   # these steps alone
python docs/generate.py --full          # also what takes long: all cases of the worked studies, finite elements of the papers
"""

import argparse
import importlib
import time
from pathlib import Path

from rich.console import Console
from rich.markup import escape

DOCS = Path(__file__).resolve().parent
STEPS = (
    "assets",
    "home",
    "theory",
    "theory_motion",
    "theory_cam",
    "theory_pusher",
    "theory_gears",
    "theory_linkage",
    "theory_shaft",
    "theory_geneva",
    "theory_indexer",
    "theory_chain",
    "dimensions",
    "gallery",
    "moving",
    "example_pictures",
    "tutorials",
    "studies",
    "papers",
    "reference_commands",
    "reference_keys",
    "reference_results",
    "reference_python",
)
WITH_FULL = {"studies", "papers"}  # their `build` takes `full=True`


def build_step(name: str, full: bool, console: Console) -> None:
    """Run one step with a line that shows what it is doing, then its seconds."""
    began = time.perf_counter()
    with console.status(name) as status:
        builder = importlib.import_module(f"builders.{name}")
        options = {"full": full} if name in WITH_FULL else {}
        builder.build(DOCS, lambda doing: status.update(f"{name}: {escape(doing)}"), **options)
    console.print(f"{name:20} {time.perf_counter() - began:6.1f} s", highlight=False)


def main() -> None:
    """Run the steps that the command line names, or all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("steps", nargs="*", choices=[[], *STEPS], metavar="STEP", help=f"of {', '.join(STEPS)}; all if none is named")
    parser.add_argument("--full", action="store_true", help="compute what takes long, too")
    given = parser.parse_args()
    console = Console()
    for name in given.steps or STEPS:
        build_step(name, given.full, console)


if __name__ == "__main__":
    main()
