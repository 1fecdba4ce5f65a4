"""The presets and examples that are damaged, and the analyses that cost little."""

import tomllib
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from drivewright import registry

EXAMPLES = Path(__file__).parents[2] / "examples"
CHEAP = {  # analyses of a kind that take well under a second; all the default ones of other kinds
    "seedling-pusher": ("train", "planting", "cams", "load"),
    "silent-chain": ("meshing", "layout", "geometry", "closure", "contact"),
    "indexer": ("motion", "profile", "contacts", "play"),
    "linkage": ("motion", "pins", "forces", "energy"),
}
COSTS = {  # key: the most that is asked for, as its run takes as long as it is told to
    "simulate.turns": 4.0,
    "simulate.max_steps": 20_000,
    "simulate.samples_per_turn": 2000,
    "simulate.ensemble": 2,
    "lyapunov.turns": 32,
    "lyapunov.discard": 4,
    "tolerances.samples": 300,
}


class Base(NamedTuple):
    """A spec that is right: where it stands, its kind, its text and its tables."""

    path: Path
    kind: str
    text: str
    tables: dict[str, Any]


@cache
def bases() -> tuple[Base, ...]:
    """Every preset and every example that is a design, always in the same order."""
    presets = [path for kind in registry.kinds() for _, path in sorted(registry.mechanism(kind).presets().items())]
    return tuple(filter(None, map(_base, [*presets, *sorted(EXAMPLES.glob("*.toml"))])))


def _base(path):
    text = path.read_text(encoding="utf-8")
    tables = tomllib.loads(text)
    return Base(path, tables["mechanism"], text, tables) if tables["mechanism"] in registry.kinds() else None


def cut_costs(tables: dict[str, Any]) -> None:
    """Numbers of turns, steps and samples to at most `COSTS`, in place, where they are numbers at all."""
    for key, most in COSTS.items():
        table, _, name = key.partition(".")
        place = tables.get(table)
        if isinstance(place, dict) and isinstance(place.get(name), (int, float)) and place[name] > most:
            place[name] = most
    simulate = tables.get("simulate")
    if isinstance(simulate, dict):
        simulate.setdefault("max_steps", COSTS["simulate.max_steps"])
