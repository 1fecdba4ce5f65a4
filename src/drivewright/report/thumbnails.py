"""The pictures that stand for a design: its scene, still and moving, or a plot of its run; 480 x 300 pixels, on white."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from drivewright import registry, runner
from drivewright.atomic import write_text
from drivewright.report.content import scene_phase
from drivewright.report.worked_examples import GALLERY, MADE, digest, examples, folder, made_from, outdated, picture_settings, pictures
from drivewright.scene import Scene
from drivewright.spec import load
from drivewright.view.figures import draw_panels
from drivewright.view.moving import DPI, draw_view, image, images, largest_within, still_webp, view_of
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
    """The pictures of a scene; `settings` as in gallery.toml: phase, part, frame, seconds."""
    given = dict(settings or {})
    view = view_of(scene, SIZE[0] / SIZE[1], given.get("frame"), given.get("part", (0.0, 0.0, 1.0, 1.0)))
    still = still_webp(image(draw_view(scene, view, given.get("phase", scene_phase(scene)), SIZE)), QUALITY)
    moving = largest_within(MOVING_BUDGET, images(scene, view, IMAGES, SIZE), given.get("seconds", SECONDS), MOVING_QUALITY)
    return Thumbnail(still, moving)


def thumbnail_of_plot(figure: "Figure") -> Thumbnail:
    """The picture of a plot, drawn anew in the size of a thumbnail, without its legend."""
    for axis in figure.axes:
        if legend := axis.get_legend():
            legend.remove()
    figure.set_size_inches(SIZE[0] / DPI, SIZE[1] / DPI)
    return Thumbnail(still_webp(image(figure), QUALITY))


def make_thumbnail(path: Path) -> Thumbnail:
    """The pictures of an example, computed now."""
    spec, settings = load(path), picture_settings(path.stem)
    mechanism, model = registry.mechanism(spec.mechanism), runner.build(spec)
    if "plot" in settings:
        result = runner.run(spec, model=model)
        return thumbnail_of_plot(draw_panels(panels(result, find_plot(result, settings["plot"]))[:1]))
    if mechanism.scene is None:
        raise ValueError(f"{path.name}: its kind has no scene; name a plot of its run in gallery.toml")
    return thumbnail_of(mechanism.scene(model), settings)


def remake(names: Sequence[str] | None = None, progress: Callable[[str], None] = print) -> list[str]:
    """Make the pictures of these examples again, unless given of those that are outdated; names of what was made."""
    known, made = examples(), made_from()
    chosen = outdated() if names is None else list(names)
    (folder() / GALLERY).mkdir(exist_ok=True)
    for name in chosen:
        progress(f"picture of {name}")
        made[name] = digest(known[name])
        for file, content in zip(pictures(name), make_thumbnail(known[name]), strict=True):
            if content:
                file.write_bytes(content)
            else:
                file.unlink(missing_ok=True)
        lines = [f'{each} = "{made[each]}"' for each in sorted(made) if each in known]
        write_text(folder() / GALLERY / MADE, "\n".join(["# Digest of the spec that each picture was made from.", *lines, ""]))
    return chosen
