"""The drawings of what the keys of a kind measure, from its presets; `drawings/NAME.svg` in the folder of the kind keeps them."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from drivewright import registry
from drivewright.atomic import write_text
from drivewright.dimensions import Dimension, DimensionSheet, shown
from drivewright.result import SpecLike
from drivewright.scene import Scene
from drivewright.spec import load
from drivewright.view.dimensions import draw_dimensions
from drivewright.view.style import svg

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DRAWINGS = "drawings"


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


def drawing_files(kind: str) -> dict[str, Path]:
    """Name of a sheet -> path of its drawing, of those that there are; a package that brings a kind may leave them out."""
    mechanism = registry.mechanism(kind)
    places = {sheet.name: mechanism.folder / DRAWINGS / f"{sheet.name}.svg" for sheet in mechanism.dimensions}
    return {name: path for name, path in places.items() if path.is_file()}


def write_drawings(kind: str, progress: Callable[[str], None] = print) -> list[Path]:
    """Draw all sheets of a kind anew into its folder."""
    mechanism, written = registry.mechanism(kind), []
    (mechanism.folder / DRAWINGS).mkdir(exist_ok=True)
    for sheet in mechanism.dimensions:
        progress(f"dimensions: {sheet.name}")
        written.append(mechanism.folder / DRAWINGS / f"{sheet.name}.svg")
        write_text(written[-1], svg(dimension_figure(kind, sheet)))
    return written
