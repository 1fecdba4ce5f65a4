"""How a result was computed: versions, analyses, seconds and the numerical settings of its spec, for the full report."""

import re
from collections import Counter
from typing import Any, TypeAlias

from drivewright.result import BOUNDED, Result
from drivewright.spec.differences import flat_tables
from drivewright.spec.serialisation import document

Rows: TypeAlias = list[tuple[str, str]]  # (what, text)
NUMERICAL = re.compile(r"tolerance|\bstep|steps|samples|seed|solver|elements|settle|turns")  # in a key: how, not what, is computed
NOT_OF_RUNS = ("optimise", "study", "report")  # tables that the analyses do not read


def how_computed(result: Result[Any]) -> Rows:
    """Rows for people: one for each analysis that was left out or failed, one for each numerical setting."""
    made = result.provenance
    without = {**result.left_out, **result.failures}
    rows = [
        ("outcome", result.outcome),
        ("analyses", ", ".join(name for name in made.get("analyses", ()) if name not in without)),
        *((f"analysis {name}", reason) for name, reason in without.items()),
        ("computing time", f"{made['seconds']:.3g} s" if "seconds" in made else ""),
        ("seed of random numbers", str(made.get("seed", ""))),
        *((name, version) for name, version in made.get("versions", {}).items()),
        ("intervals", _intervals(result)),
        *settings(result.spec),
    ]
    return [(what, text) for what, text in rows if text]


def settings(spec: Any) -> Rows:
    """The keys of a spec that say how it is computed, with their values; none of what is no spec of ours."""
    if not hasattr(type(spec), "model_fields"):
        return []
    tables = {name: table for name, table in document(spec).items() if name not in NOT_OF_RUNS}
    return [(key, str(value)) for key, value in flat_tables(tables).items() if NUMERICAL.search(key)]


def _intervals(result: Result[Any]) -> str:
    """How the intervals of the values were made, and of how many."""
    made = Counter(value.interval for value in result.values.values() if value.interval)
    return ", ".join(f"{count} {'bounds' if how in BOUNDED else '95 %'} ({how})" for how, count in made.items())
