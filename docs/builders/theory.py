"""Theory pages: of each drive from the folder of its kind, of motion laws with the peak factors that the code computes."""

import shutil
from collections.abc import Callable
from pathlib import Path

from drivewright import motion, registry

PEAKS = "{{ motion_peaks }}"


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/theory/KIND.md and docs/theory/motion.md."""
    for kind in registry.kinds():
        progress(kind)
        shutil.copyfile(registry.mechanism(kind).folder / "theory.md", docs / "theory" / f"{kind}.md")
    progress("motion laws")
    text = (docs / "theory" / "motion.in.md").read_text(encoding="utf-8")
    (docs / "theory" / "motion.md").write_text(text.replace(PEAKS, peak_factors()), encoding="utf-8")


def peak_factors() -> str:
    """Markdown table of the peak factors of every motion law without parameters."""
    rows = ["| law | Vm | Am | Jm | AVm |", "|---|---:|---:|---:|---:|"]
    for name in motion.names():
        try:
            peaks = motion.law(name).peaks()
        except (TypeError, ValueError):
            continue  # a law that needs parameters
        rows.append(f"| {name} | " + " | ".join(f"{value:.6g}" for value in peaks) + " |")
    return "\n".join(rows)
