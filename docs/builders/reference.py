"""The pages of the Python interface, filled by mkdocstrings."""

from collections.abc import Callable
from pathlib import Path

PAGES = (
    "motion",
    "curves",
    "gears",
    "cams",
    "contact",
    "bearings.ball",
    "bearings.roller",
    "bearings.solving",
    "bearings.dynamic_rating",
    "bearings.life",
    "bearings.stiffness_curve",
    "bearings.approximate_stiffness",
    "bearings.catalogue",
    "shafts.model",
    "shafts.equilibrium",
    "shafts.loads",
    "shafts.supports",
    "shafts.influence",
    "shafts.strength",
    "shafts.vibration",
    "shafts.batch",
    "chains.link",
    "chains.meshing",
    "chains.tooth",
    "chains.plate",
    "chains.sprocket",
    "chains.interference",
    "chains.closure.drive",
    "chains.model",
    "chains.explicit.simulate",
    "chains.explicit.motion",
    "chains.implicit.equilibrium",
    "chains.standards",
    "chains.stress.plate",
    "chains.stress.pins",
    "fatigue.material",
    "fatigue.critical",
    "fatigue.rainflow",
    "fatigue.curves",
    "materials",
    "studies.sweeps",
    "studies.variation",
    "studies.study",
    "studies.plan",
    "execution.executors",
    "studies.answers.whole",
    "studies.statistics",
    "studies.sensitivity",
    "studies.pareto",
    "studies.optimisation",
    "units",
    "spec",
    "result",
    "scene",
    "errors",
)


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/reference.md."""
    lines = "\n\n".join(f"::: drivewright.{name}" for name in PAGES)
    (docs / "reference.md").write_text(f"# Reference\n\n{lines}\n", encoding="utf-8")
