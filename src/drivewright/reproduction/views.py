"""A mechanism's scene and drawings as figures."""

from typing import TYPE_CHECKING

from drivewright import registry
from drivewright.errors import UnknownName
from drivewright.runner import build
from drivewright.scene import Drawing
from drivewright.spec import MechanismSpec
from drivewright.view import draw_scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def scene_figure(spec: MechanismSpec, observer: str | None = None, phase: float = 0.0) -> "Figure":
    """The mechanism of a spec to scale at a phase 0 ... 1 of its cycle."""
    scene = registry.mechanism(spec.mechanism).scene
    assert scene is not None
    return draw_scene(scene(build(spec)), observer, (phase,))


def drawing_of(spec: MechanismSpec, name: str) -> Drawing:
    """The mechanism's drawing of that name, else the first whose name contains it."""
    drawings = registry.mechanism(spec.mechanism).drawings
    known = {drawing.name: drawing for drawing in (drawings(build(spec)) if drawings else ())}
    chosen = known.get(name) or next((drawing for each, drawing in known.items() if name in each), None)
    if chosen is None:
        raise UnknownName("drawing", name, known)
    return chosen
