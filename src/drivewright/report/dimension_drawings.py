"""The drawings of what the keys of a kind measure, from its presets."""

from typing import TYPE_CHECKING, NamedTuple

from drivewright import registry
from drivewright.dimensions import Dimension, DimensionSheet, shown
from drivewright.result import SpecLike
from drivewright.scene import Scene
from drivewright.spec import load
from drivewright.view.dimensions import draw_dimensions

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Measured(NamedTuple):
    """A sheet's spec, what it shows, and its dimensions."""

    spec: SpecLike
    scene: Scene
    dimensions: tuple[Dimension, ...]


def measured(kind: str, sheet: DimensionSheet) -> Measured:
    """The preset of a sheet with its changes, as its scene and dimensions."""
    mechanism = registry.mechanism(kind)
    spec = load(mechanism.presets()[sheet.preset], sheet.changes)
    model = mechanism.build(spec)
    make = sheet.scene or mechanism.scene
    assert make is not None
    whole = make(model)
    return Measured(spec, shown(sheet, whole), tuple(sheet.dimensions(model, whole)))


def dimension_figure(kind: str, sheet: DimensionSheet) -> "Figure":
    """Figure of a sheet."""
    found = measured(kind, sheet)
    return draw_dimensions(sheet, found.scene, found.dimensions)
