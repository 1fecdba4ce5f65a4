"""The drawings of what the keys of a kind measure, from its presets; `drawings/NAME.svg` in the folder of the kind keeps them."""

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from drivewright import registry
from drivewright.atomic import write_text
from drivewright.dimensions import Dimension, DimensionSheet, shown
from drivewright.result import SpecLike
from drivewright.scene import Scene
from drivewright.spec import change_key, load, read_document
from drivewright.spec.fields import field_at, table_of
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


def fitting_drawings(kind: str, tables: Mapping[str, Any]) -> list[str]:
    """Names of the drawings of a kind that show the variant of a design, given by its raw tables; all where none does."""
    sheets = [sheet for sheet in registry.mechanism(kind).dimensions if sheet.name in drawing_files(kind)]
    fitting = [sheet.name for sheet in sheets if all(_variant_value(kind, tables, key) == value for key, value in _variant(kind, sheet))]
    return fitting or [sheet.name for sheet in sheets]


@cache
def _variant(kind: str, sheet: DimensionSheet) -> tuple[tuple[str, Any], ...]:
    """(key, value) of the design of a sheet, at the keys of its variant."""
    tables = read_document(registry.mechanism(kind).presets()[sheet.preset])
    for change in sheet.changes:
        tables = change_key(tables, change)
    return tuple((key, _variant_value(kind, tables, key)) for key in sheet.variant)


def _variant_value(kind: str, tables: Any, key: str) -> Any:
    """The value at a key of raw tables, or else its default; of a table whether it is given."""
    for step in key.split("."):
        tables = tables.get(step) if isinstance(tables, Mapping) else None
    field = field_at(registry.mechanism(kind).spec, key.split("."))
    if field is None or table_of(field.annotation):
        return tables is not None
    return field.default if tables is None else tables


def write_drawings(kind: str, progress: Callable[[str], None] = print) -> list[Path]:
    """Draw all sheets of a kind anew into its folder."""
    mechanism, written = registry.mechanism(kind), []
    (mechanism.folder / DRAWINGS).mkdir(exist_ok=True)
    for sheet in mechanism.dimensions:
        progress(f"dimensions: {sheet.name}")
        written.append(mechanism.folder / DRAWINGS / f"{sheet.name}.svg")
        write_text(written[-1], svg(dimension_figure(kind, sheet)))
    return written
