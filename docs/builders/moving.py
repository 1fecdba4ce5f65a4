"""The moving picture of the README: a seedling pusher as published and as optimised, each over one turn, with its design checks.

Everything comes from runs of the two examples: the bodies from their scenes, the checks and the plot from their results.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch
from PIL import Image

from drivewright import registry, runner
from drivewright.report.content import SIGNS, check_label, verdict_of
from drivewright.report.worked_examples import digest, examples
from drivewright.scene import Scene, place
from drivewright.spec import load
from drivewright.view.motion import path, pose_at
from drivewright.view.moving import image, moving_webp
from drivewright.view.palette import colour
from drivewright.view.sketches import draw_moment
from drivewright.view.style import angle_ticks, styled
from drivewright.view.text import quantity

FILE, MADE = "running.webp", "running.toml"
ACTS = (  # example, what stands above it, the command that leads to it
    ("seedling_pusher", "Seedling pusher as published", "drivewright run seedling_pusher.toml"),
    ("seedling_pusher_improved", "The same drive, optimised", "drivewright optimise seedling_pusher.toml"),
)
CHECKS = (
    "undercut.return",
    "pressure_angle.main",
    "angle_difference",
    "track.height",
    "mouth_width",
    "pitch_radius",
    "contact_pressure.main",
    "rod_error",
)
WIDTH, HEIGHT, DPI = 960, 560, 100
FRAMES, SECONDS = 50, 3.6  # of one turn
FADE = 5  # images in which an act becomes the next one
BUDGET = 2_000_000  # bytes
MM, TURN = 1e3, 2 * np.pi
WINDOW = (-106.0, 198.0, -158.0, 114.0)  # mm: left, right, bottom, top of what is shown of the machine
STAGE = (0.0, 0.0, 0.545, 0.836)  # of the picture: left, bottom, width, height of the machine
SIDE, SIDE_END = 0.56, 0.98  # of the picture: the column of checks and plot
STATES = {True: "good", False: "bad"}


class Act(NamedTuple):
    """A run that is shown: its scene with the needle's track alone, its result, and the carrier angles of taking and of planting."""

    title: str
    command: str
    scene: Scene
    result: Any
    take: float
    plant: float


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/img/running.webp, where the specs that it shows have changed: three quarters of a minute."""
    file, noted = docs / "img" / FILE, docs / "img" / MADE
    if file.is_file() and noted.is_file() and noted.read_text(encoding="utf-8") == digests():
        progress("moving picture: its specs are those that it was made from")
        return
    pictures = []
    for act in acts():
        progress(f"moving picture: {act.title}")
        pictures.append([image(picture(act, n / FRAMES)) for n in range(FRAMES)])
    film = moving_webp(list(joined(pictures)), SECONDS * len(ACTS), quality=78)
    if len(film) > BUDGET:
        raise ValueError(f"{FILE} has {len(film)} bytes, more than {BUDGET}: fewer frames or a smaller picture")
    file.write_bytes(film)
    noted.write_text(digests(), encoding="utf-8")
    progress(f"moving picture: {len(film) / 1e6:.2f} MB")


def digests() -> str:
    """What the specs of both acts say, as lines of TOML."""
    lines = [f'{name} = "{digest(examples()[name])}"' for name, _, _ in ACTS]
    return "\n".join(["# Digest of the specs that running.webp was made from; docs/builders/moving.py makes it again.", *lines, ""])


def acts() -> Iterator[Act]:
    """The runs that are shown, computed now."""
    known = examples()
    for name, title, command in ACTS:
        spec = load(known[name])
        model = runner.build(spec)
        result = runner.run(spec, model=model)
        make = registry.mechanism(spec.mechanism).scene
        assert make is not None
        scene = make(model)
        track = tuple(trace for trace in scene.traces if trace.name == "tip")
        lowest = next(value for value, label in scene.marks if label == "lowest")
        yield Act(title, command, replace(scene, traces=track), result, result["needle.take_event"] % TURN, lowest % TURN)


def joined(pictures: list[list[Image.Image]]) -> Iterator[Image.Image]:
    """One act after the other; at the end of each the next one fades in, as far on in its turn."""
    for own, following in zip(pictures, pictures[1:] + pictures[:1], strict=True):
        yield from own[FADE:]
        yield from (Image.blend(own[n], following[n], (n + 1) / (FADE + 1)) for n in range(FADE))


def picture(act: Act, phase: float) -> Figure:
    """The whole picture at a phase 0 ... 1 of the carrier's turn."""
    with styled():
        figure = Figure(figsize=(WIDTH / DPI, HEIGHT / DPI), dpi=DPI)
        draw_machine(figure.add_axes(STAGE), act, phase)
        write_head(figure, act)
        write_checks(figure, act)
        draw_plot(figure.add_axes((SIDE + 0.048, 0.115, SIDE_END - SIDE - 0.048, 0.225)), act, phase)
    return figure


# -- the machine -----------------------------------------------------------------------------------------------------------------


def draw_machine(axis: Axes, act: Act, phase: float) -> None:
    """The drive over the soil, with the needle's track and the seedlings."""
    scene, t = act.scene, phase * TURN
    field, carried = soil(act), (t - act.take) % TURN <= (act.plant - act.take) % TURN
    left, right, bottom, top = WINDOW
    axis.axhspan(bottom, MM * field["ground"], color="#efe7dc", lw=0)
    axis.plot([left, right], [MM * field["ground"]] * 2, color="#9a7b52", lw=1.4)
    for x in planted(act, t):
        draw_seedling(axis, x, field["foot"], act)
    if carried:
        x, y = tip(act, phase)
        draw_seedling(axis, x, y, act)
    draw_moment(axis, scene, scene.frames[0], phase)
    x, y = tip(act, phase)
    axis.plot(MM * x, MM * y, "o", ms=5, color=colour("violet"), zorder=5)
    speed = act.result.spec.drive.speed
    note = f"carrier {60 * speed / TURN:.0f} rpm, shown {SECONDS * speed / TURN:.0f} times slower"
    axis.text(left + 6, bottom + 7, note, fontsize=8.5, color="#7a6240")
    axis.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    axis.set_axis_off()


def tip(act: Act, phase: float) -> tuple[float, float]:
    """Where the tip of the needle is [m]."""
    track = act.scene.traces[0]
    body = next(body for body in act.scene.bodies if body.name == track.body)
    x, y = place([track.point], pose_at(body.poses, act.scene.cycle, phase))[0]
    return float(x), float(y)


def soil(act: Act) -> dict[str, float]:
    """Heights [m] of the ground and of the foot of a planted seedling, where the tip is lowest."""
    track = act.scene.traces[0]
    body = next(body for body in act.scene.bodies if body.name == track.body)
    foot = float(path(track.point, body.poses)[:, 1].min())
    return {"foot": foot, "ground": foot + act.result.spec.field.mouth_height}


def planted(act: Act, t: float) -> Iterator[float]:
    """Places [m] of the seedlings in the soil at a carrier angle: the machine has left them behind since each was planted."""
    advance = -act.scene.frames[1].advance[0]
    first = tip(act, act.plant / TURN)[0]
    for turn in range(4):
        since = (t - act.plant) / TURN + turn
        if since > 0:
            yield first - advance * since


def draw_seedling(axis: Axes, x: float, y: float, act: Act) -> None:
    """A seedling whose foot is at (x, y) [m]."""
    height = act.result.spec.field.seedling_height + act.result.spec.field.mouth_height
    s = np.linspace(0, 1, 12)
    for lean in (-0.13, -0.03, 0.11):
        axis.plot(MM * (x + lean * height * s**2), MM * (y + height * (1 - abs(lean)) * s), color="#8cbf78", lw=1.5)


# -- words and numbers -----------------------------------------------------------------------------------------------------------


def write_head(figure: Figure, act: Act) -> None:
    """Title, command and verdict above everything."""
    verdict, command = verdict_of(act.result), f"$ {act.command}".replace("$", r"\$")
    state = verdict["state"]
    figure.text(0.022, 0.945, act.title, fontsize=17, fontweight="bold", va="center")
    figure.text(0.022, 0.893, command, fontsize=9.5, family="DejaVu Sans Mono", color=colour("muted"), va="center")
    pill = {"boxstyle": "round,pad=0.5,rounding_size=1", "fc": colour(f"{state}-soft"), "ec": "none"}
    look = {"fontsize": 11.5, "fontweight": "bold", "ha": "right", "va": "center"}
    figure.text(SIDE_END - 0.012, 0.935, verdict["text"], color=colour(state), bbox=pill, **look)


def write_checks(figure: Figure, act: Act) -> None:
    """The chosen checks as traffic lights: name, value and limit."""
    by_name = {check.name: check for check in act.result.checks}
    top, step, height = 0.845, 0.058, 0.050
    for number, name in enumerate(CHECKS):
        check, middle = by_name[name], top - step * number - height / 2
        state = STATES[check.ok]
        look = {"fc": colour(f"{state}-soft"), "ec": "none", "transform": figure.transFigure, "mutation_aspect": WIDTH / HEIGHT}
        corner, size = (SIDE, middle - height / 2), (SIDE_END - SIDE, height)
        figure.add_artist(FancyBboxPatch(corner, *size, boxstyle="round,pad=0,rounding_size=0.008", **look))
        value, limit = (quantity(number_, check.unit, 3) for number_ in (check.value, check.limit))
        words = (
            (SIDE + 0.010, "●", "left", colour(state), "normal"),
            (SIDE + 0.030, check_label(check), "left", colour("ink"), "normal"),
            (SIDE_END - 0.094, value, "right", colour(state), "bold"),
            (SIDE_END - 0.008, f"{SIGNS[check.sense]} {limit}", "right", colour("muted"), "normal"),
        )
        for x, text, side, hue, weight in words:
            figure.text(x, middle, text, ha=side, color=hue, fontweight=weight, va="center", fontsize=8.5)


def draw_plot(axis: Axes, act: Act, phase: float) -> None:
    """Pressure angle of both cams over the turn, its limit, and where the carrier is."""
    table, limit = act.result.tables["cams"], act.result.spec.limits.pressure_angle
    angle = np.asarray(table["carrier_angle"].data) % TURN
    order = np.argsort(angle)
    for column, role, label in (("main.pressure_angle", "orange", "main cam"), ("return.pressure_angle", "violet", "return cam")):
        values = np.degrees(np.asarray(table[column].data)[order])
        axis.plot(np.degrees(angle[order]), values, color=colour(role), lw=1.6, label=label)
        axis.plot(360 * phase, np.interp(phase * TURN, angle[order], values), "o", ms=5, color=colour(role))
    for side in (-1, 1):
        axis.axhline(side * np.degrees(limit), color=colour("bad"), lw=1.0, ls=(0, (5, 3)))
    axis.axvline(360 * phase, color=colour("cursor"), lw=1.2)
    axis.set(xlim=(0, 360), ylim=(-50, 62), xlabel="Carrier angle [°]")
    axis.set_yticks([-40, 0, 40])
    axis.set_title("Pressure angle of both cams [°]", fontsize=9)
    axis.legend(loc="upper right", ncols=2, borderaxespad=0.1, handlelength=1.3, columnspacing=1.2)
    angle_ticks(axis.xaxis, 0, 360)


if __name__ == "__main__":
    build(Path(__file__).parents[1], print)
