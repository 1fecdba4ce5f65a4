"""The pictures that stand for a design: its scene, still and moving, or a plot of its run; 480 x 300 pixels, on white."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from drivewright import registry, runner
from drivewright.atomic import write_text
from drivewright.report.content import scene_phase
from drivewright.report.worked_examples import (
    GALLERY,
    MADE,
    PICTURES,
    digest,
    examples,
    folder,
    made_from,
    outdated,
    outdated_presets,
    picture_settings,
    pictures,
)
from drivewright.scene import Scene
from drivewright.spec import load
from drivewright.view.figures import draw_panels
from drivewright.view.moving import DPI, View, draw_view, image, images, largest_within, still_webp, view_of
from drivewright.view.panels import find_plot, panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = (480, 300)
SECONDS = 2.4  # a round of the moving picture
IMAGES = 24  # of a round
STILL_BUDGET, MOVING_BUDGET = 40_000, 150_000  # bytes
QUALITY, MOVING_QUALITY = 75, 62


class Thumbnail(NamedTuple):
    """WebP files; `moving` is empty where nothing moves."""

    still: bytes
    moving: bytes = b""


def thumbnail_of(scene: Scene, settings: Mapping[str, Any] | None = None) -> Thumbnail:
    """The pictures of a scene; `settings` as in worked_examples.toml: phase, part, frame, seconds."""
    given = dict(settings or {})
    view = view_of(scene, SIZE[0] / SIZE[1], given.get("frame"), given.get("part", (0.0, 0.0, 1.0, 1.0)))
    still = _still(scene, view, given.get("phase"))
    moving = largest_within(MOVING_BUDGET, images(scene, view, IMAGES, SIZE), given.get("seconds", SECONDS), MOVING_QUALITY)
    return Thumbnail(still, moving)


def still_of(scene: Scene) -> bytes:
    """The still picture of a whole scene alone."""
    return _still(scene, view_of(scene, SIZE[0] / SIZE[1]), None)


def _still(scene: Scene, view: View, phase: float | None) -> bytes:
    return still_webp(image(draw_view(scene, view, scene_phase(scene) if phase is None else phase, SIZE)), QUALITY)


def thumbnail_of_plot(figure: "Figure") -> Thumbnail:
    """The picture of a plot, drawn anew in the size of a thumbnail, without its legend."""
    for axis in figure.axes:
        if legend := axis.get_legend():
            legend.remove()
    figure.set_size_inches(SIZE[0] / DPI, SIZE[1] / DPI)
    return Thumbnail(still_webp(image(figure), QUALITY))


def make_thumbnail(path: Path, settings: Mapping[str, Any] | None = None) -> Thumbnail:
    """The pictures of a spec file, computed now; `settings` as in worked_examples.toml."""
    spec, given = load(path), dict(settings or {})
    mechanism, model = registry.mechanism(spec.mechanism), runner.build(spec)
    if "plot" in given:
        result = runner.run(spec, model=model)
        return thumbnail_of_plot(draw_panels(panels(result, find_plot(result, given["plot"]))[:1]))
    if mechanism.scene is None:
        raise ValueError(f"{path.name}: its kind has no scene; name a plot of its run in worked_examples.toml")
    return thumbnail_of(mechanism.scene(model), given)


def remake(names: Sequence[str] | None = None, progress: Callable[[str], None] = print) -> list[str]:
    """Make the pictures of these examples again, unless given of those that are outdated; names of what was made."""
    known, chosen = examples(), outdated() if names is None else list(names)
    for name in chosen:
        progress(f"picture of {name}")
        for file, content in zip(pictures(name), make_thumbnail(known[name], picture_settings(name)), strict=True):
            if content:
                file.write_bytes(content)
            else:
                file.unlink(missing_ok=True)
        _note_digest(folder() / GALLERY, known, name)
    return chosen


def remake_presets(kind: str, progress: Callable[[str], None] = print) -> list[str]:
    """Make the pictures of the presets of a kind that are outdated, moving ones where the kind says so; names of what was made."""
    mechanism, chosen = registry.mechanism(kind), outdated_presets(kind)
    place = mechanism.folder / "presets" / PICTURES
    place.mkdir(exist_ok=True)
    for name in chosen:
        progress(f"picture of preset {name} of {kind}")
        spec = load(mechanism.presets()[name])
        assert mechanism.scene is not None
        scene = mechanism.scene(mechanism.build(spec))
        if mechanism.moving_presets:
            still, moving = thumbnail_of(scene)
            (place / f"{name}.moving.webp").write_bytes(moving)
        else:
            still = still_of(scene)
        (place / f"{name}.webp").write_bytes(still)
        _note_digest(place, mechanism.presets(), name)
    return chosen


def _note_digest(place: Path, known: Mapping[str, Path], name: str) -> None:
    """Write down what the picture of `name` in a folder was made from; forget what is not known any more."""
    made = {**made_from(place), name: digest(known[name])}
    write_text(place / MADE, json.dumps({each: made[each] for each in sorted(made) if each in known}, indent=1) + "\n")
