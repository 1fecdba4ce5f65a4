"""How a kind of drive is built by clicks on its drawing: what its package declares, and the studio calls."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from drivewright.scene import Scene

Place: TypeAlias = tuple[float, float]  # x, y [m] of the machine at its start


class Tool(NamedTuple):
    """A tool: its name in messages, its label and hint in English, and how many places it takes; more than `fewest` end on request.

    `picks`: it takes what is at a place, so that no place is moved to a grid.
    """

    name: str
    label: str
    hint: str
    fewest: int = 1
    most: int = 1
    picks: bool = False


class Construction(NamedTuple):
    """`step(tables, spec, tool, places, near)` gives the raw tables after one use of a tool, InputError where the places do not suit it.

    `sketch(spec)` draws a spec that is not finished, every body where the spec puts it; `unfinished(spec)` says in words what is missing;
    `connected(spec)` whether every body is held by the frame: what is not would fall out of the picture.  `start` is the preset that a
    person begins to build with.
    """

    tools: tuple[Tool, ...]
    step: Callable[[dict[str, Any], Any, str, Sequence[Place], float], dict[str, Any]]
    sketch: "Callable[[Any], Scene]"
    unfinished: Callable[[Any], tuple[str, ...]]
    connected: Callable[[Any], bool]
    start: str = ""
