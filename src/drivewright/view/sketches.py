"""Scenes and drawings as figures, to scale."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from drivewright.errors import UnknownName
from drivewright.scene import Drawing, Frame, Scene, place
from drivewright.units import System
from drivewright.view.motion import fractions, path, pose_at, seen_from, step_back
from drivewright.view.outlines import overall_size, simplified_points
from drivewright.view.palette import SERIES, TRACES, colour
from drivewright.view.style import MUTED, arrange, figure_to_scale, legend_columns, nice_length, styled
from drivewright.view.text import display_unit, literal, number, quantity, sentence, with_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FINENESS = 4e-4  # curves become chords within this part of the whole picture: a twentieth of a millimetre on paper
BAR_ROOM = 0.07  # room for the scale bar below a drawing, over its larger side
PAST = 2  # cycles before this one whose traces an advancing observer still sees
LAYERS = {  # layer -> line width, dashes, filled; colour is the body's
    "profile": (1.4, "-", True),
    "body": (1.2, "-", True),
    "roller": (1.2, "-", True),
    "hole": (1.0, "-", False),
    "pitch": (0.9, (0, (7, 2, 1.5, 2)), False),
    "base": (0.8, (0, (2, 2)), False),
    "axis": (0.7, (0, (9, 2, 2, 2)), False),
    "ground": (1.6, "-", False),
    "defect": (2.2, "-", False),
    "edge": (1.2, "-", False),
}
DRAWN = {
    "profile": "blue",
    "body": "blue",
    "hole": "ink",
    "pitch": "orange",
    "base": "green",
    "roller": "violet",
    "axis": "muted",
    "ground": "ground",
    "defect": "bad",
}
NAMES = {
    "profile": "profile",
    "body": "body",
    "hole": "hole",
    "pitch": "pitch curve",
    "base": "base circle",
    "roller": "roller",
    "axis": "axis",
    "ground": "ground",
    "defect": "defect",
}


def draw_scene(
    scene: Scene, frame: str | None = None, at: Sequence[float] = (0.0,), ghosts: Sequence[float] = (), system: System = "mm"
) -> "Figure":
    """Figure of a scene for one observer (the first one by default).

    A panel for each phase 0 ... 1 of the cycle in `at`; the bodies' edges at the phases in `ghosts` lie faintly behind.
    """
    observer = observer_of(scene, frame)
    with styled():
        figure, axes = figure_to_scale(len(at), sentence(observer.label))
        for axis, phase in zip(axes, at, strict=True):
            _draw_state(axis, scene, observer, phase, ghosts, system)
        axes[0].set_ylabel(f"{observer.axes[1]} [{_length(system)[1]}]")
        rows = _legend(figure, scene)
        arrange(figure, axes, *_extent(axes), bottom=0.55 + 0.19 * rows)
    return figure


def draw_thumbnail(scene: Scene, phase: float = 0.3) -> "Figure":
    """Small figure of a scene for its first observer: no axes, no names."""
    with styled():
        figure, axes = figure_to_scale(1)
        _draw_state(axes[0], scene, scene.frames[0], phase, ())
        axes[0].set_title("")
        axes[0].set_axis_off()
        arrange(figure, axes, *_extent(axes), left=0.1, right=0.1, top=0.1, bottom=0.1, trim=True)
    return figure


def observer_of(scene: Scene, name: str | None) -> Frame:
    """The observer of a name, the first one without a name."""
    frames = {frame.name: frame for frame in scene.frames}
    if name is not None and name not in frames:
        raise UnknownName("frame of the scene", name, frames)
    return frames[name] if name is not None else scene.frames[0]


def _length(system: System) -> tuple[float, str]:
    return display_unit("m", system)


def _draw_state(axis, scene, observer, phase, ghosts, system: System = "mm"):
    """One moment with its traces, ghosts behind, and what it is called."""
    draw_moment(axis, scene, observer, phase, ghosts, system)
    value = scene.cycle[0] + phase * (scene.cycle[-1] - scene.cycle[0])
    at = quantity(value, scene.cycle_unit, 4, system)
    axis.set_title(f"{sentence(scene.cycle_label)} {at}", fontweight="normal", fontsize=9, color=MUTED)
    axis.set_xlabel(f"{observer.axes[0]} [{_length(system)[1]}]")


def draw_moment(axis: "Axes", scene: Scene, observer: Frame, phase: float, ghosts: Sequence[float] = (), system: System = "mm") -> None:
    """Draw a scene at a phase 0 ... 1 of its cycle as an observer sees it, with its traces, into axes in the unit of lengths that `system`
    shows; ghosts behind, the frame's own shapes as far as they lie near."""
    tolerance = FINENESS * overall_size(scene)
    length = _length(system)[0]
    _draw_ghosts(axis, scene, observer, ghosts, 4 * tolerance, length)
    _draw_traces(axis, scene, observer, length)
    for body, pose in _seen_bodies(scene, observer, phase):
        for shape in body.shapes:
            _draw_shape(axis, shape, pose, body.colour, tolerance, length)
    near = _around(axis.dataLim.get_points(), 0.25)
    for shape in observer.shapes:
        _draw_shape(axis, shape, (0.0, 0.0, 0.0), "ground", tolerance, length, near)


def _seen_bodies(scene, observer, phase):
    """(body, its pose relative to the observer) at a phase."""
    eye = pose_at(observer.poses, scene.cycle, phase)
    frame = round(float(np.interp(phase, fractions(scene.cycle), np.arange(len(scene.cycle)))))
    drawn = (body for body in scene.bodies if body.shown is None or body.shown[frame])
    return [(body, seen_from(pose_at(body.poses, scene.cycle, phase)[None], eye[None])[0]) for body in drawn]


def _around(box, share):
    """The box (low, high) with a margin of so much of its larger side."""
    margin = share * np.ptp(box, axis=0).max()
    return box[0] - margin, box[1] + margin


def _extent(axes):
    """The box (low, high) around everything drawn in any of the axes, with a little air."""
    boxes = np.array([axis.dataLim.get_points() for axis in axes])
    return _around(np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]), 0.04)


def _draw_shape(axis, shape, pose, role, tolerance, length, near=None):
    """One outline: filled where it is material, dashed where it is a construction line.  What lies beyond `near` counts for no extent."""
    width, dashes, filled = LAYERS.get(shape.layer, LAYERS["body"])
    points = place(simplified_points(shape.outline, tolerance), pose) * length
    edge = {"defect": colour("bad"), "hole": colour("ink"), "axis": MUTED}.get(shape.layer, colour(role))
    face = (edge, 0.22) if filled and shape.outline.closed else "white" if shape.layer == "hole" else "none"
    _add(axis, points, shape.outline.closed, near, ec=edge, fc=face, lw=width, ls=dashes)


def _draw_ghosts(axis, scene, observer, phases, tolerance, length):
    """Edges of the material at other phases, faint: those of one colour in one stroke, which is as faint where they lie upon each other."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    lines = {}
    for phase in phases:
        for body, pose in _seen_bodies(scene, observer, phase):
            for shape in body.shapes:
                if LAYERS.get(shape.layer, LAYERS["body"])[2]:
                    points = place(simplified_points(shape.outline, tolerance), pose) * length
                    lines.setdefault(body.colour, []).append(points[[*range(len(points)), 0]] if shape.outline.closed else points)
    for role, outlines in lines.items():
        edges = Path.make_compound_path(*map(Path, outlines))
        axis.add_artist(PathPatch(edges, fill=False, ec=colour(role), lw=0.6, alpha=0.25, joinstyle="round"))
        axis.update_datalim(edges.vertices)


def _add(axis, points, closed, near=None, **look):
    """A polygon or chain; its points, held within the box `near`, widen the extent of the axes."""
    from matplotlib.patches import Polygon

    axis.add_artist(Polygon(points, closed=closed, joinstyle="round", **look))
    axis.update_datalim(points if near is None else np.clip(points, *near))


def _draw_traces(axis, scene, observer, length):
    """Every trace over the whole cycle; an advancing observer also sees the last cycles'."""
    bodies = {body.name: body for body in scene.bodies}
    for number_, trace in enumerate(scene.traces):
        points = path(trace.point, seen_from(bodies[trace.body].poses, observer.poses)) * length
        role = _trace_colour(trace, number_)
        axis.plot(*points.T, color=role, lw=1.1, ls=(0, (4, 2)))
        for past in range(1, PAST + 1 if any(observer.advance) else 1):
            axis.plot(*(points + past * step_back(observer) * length).T, color=role, lw=0.9, alpha=0.45)


def _trace_colour(trace, number_):
    return colour(trace.colour or TRACES[number_ % len(TRACES)])


def _legend(figure, scene):
    """Names of bodies and traces along the lower edge; the number of rows they take."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    labels = {body.label: body.colour for body in reversed(scene.bodies)}
    keys = [Patch(fc=(colour(role), 0.3), ec=colour(role), label=sentence(label)) for label, role in reversed(labels.items())]
    keys += [
        Line2D([], [], color=_trace_colour(trace, n), ls=(0, (4, 2)), lw=1.2, label=sentence(trace.label))
        for n, trace in enumerate(scene.traces)
        if trace.label not in labels
    ]
    columns = legend_columns([str(key.get_label()) for key in keys])
    figure.legend(handles=keys, loc="lower left", ncols=columns, handlelength=1.6, borderaxespad=0.3)
    return -(-len(keys) // columns)


def draw_drawing(drawing: Drawing, system: System = "mm") -> "Figure":
    """Figure of a flat part: its layers to one scale, a scale bar, its overall size."""
    factor, unit = _length(system)
    tolerance = FINENESS * float(np.ptp(_points(drawing), axis=0).max())
    with styled():
        figure, (axis,) = figure_to_scale(1, sentence(drawing.title))
        for layer, role in DRAWN.items():
            for number_, shape in enumerate(shape for shape in drawing.shapes if shape.layer == layer):
                width, dashes, filled = LAYERS[layer]
                face = (colour(role), 0.14) if filled and shape.outline.closed else "white" if layer == "hole" else "none"
                _add(
                    axis,
                    simplified_points(shape.outline, tolerance) * factor,
                    shape.outline.closed,
                    ec=colour(role),
                    fc=face,
                    lw=width,
                    ls=dashes,
                    label=(shape.label or NAMES[layer]) if number_ == 0 else None,
                )
        low, high = _extent([axis])
        arrange(figure, [axis], low - (0.0, BAR_ROOM * (high - low).max()), high, right=2.2)
        axis.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")
        axis.set_title(_size(drawing, factor, unit), fontweight="normal", fontsize=9, color=MUTED)
        _scale_bar(axis, unit)
        axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    return figure


def draw_overlaid(drawings: Sequence[Drawing], labels: Sequence[str], title: str, system: System = "mm") -> "Figure":
    """Figure of flat parts of several designs upon each other, each design in its colour, the first one filled, to one scale."""
    from matplotlib.patches import Patch

    factor, unit = _length(system)
    tolerance = FINENESS * max(float(np.ptp(_points(drawing), axis=0).max()) for drawing in drawings)
    with styled():
        figure, (axis,) = figure_to_scale(1, sentence(title))
        for number_, drawing in enumerate(drawings):
            for shape in drawing.shapes:
                _draw_outline(axis, shape, SERIES[number_ % len(SERIES)], tolerance, factor, number_ == 0)
        keys = [Patch(fc=(hue, 0.2), ec=hue, label=literal(label)) for hue, label in zip(_hues(labels), labels, strict=True)]
        columns = legend_columns(labels)
        figure.legend(handles=keys, loc="lower left", ncols=columns, handlelength=1.6, borderaxespad=0.3)
        arrange(figure, [axis], *_extent([axis]), bottom=0.55 + 0.19 * -(-len(labels) // columns))
        axis.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")
    return figure


def _hues(labels):
    return [colour(SERIES[number_ % len(SERIES)]) for number_ in range(len(labels))]


def _draw_outline(axis, shape, role, tolerance, length, is_first):
    """An outline of one design among several: holes let through what lies below."""
    width, dashes, filled = LAYERS.get(shape.layer, LAYERS["body"])
    face = (colour(role), 0.14) if is_first and filled and shape.outline.closed else "none"
    edge = MUTED if shape.layer == "axis" else colour(role)
    points = simplified_points(shape.outline, tolerance) * length
    _add(axis, points, shape.outline.closed, ec=edge, fc=face, lw=0.8 * width, ls=dashes)


def _size(drawing, factor, unit):
    """'62.4 × 58.1 mm, 8 mm thick' of the profile, or of everything where there is none."""
    wide, high = np.ptp(_points(drawing), axis=0) * factor
    thick = f", {with_unit(number(drawing.thickness * factor, 4), unit)} thick" if drawing.thickness else ""
    return f"{number(wide, 4)} × {with_unit(number(high, 4), unit)}{thick}"


def _points(drawing):
    """Points of the profile, or of everything where there is none."""
    outlines = drawing.on("profile") or tuple(shape.outline for shape in drawing.shapes)
    return np.concatenate([outline.points() for outline in outlines])


def _scale_bar(axis, unit):
    """A bar of 1, 2 or 5 times a power of ten in the lower left corner."""
    low, high = axis.get_xlim()
    length = nice_length(0.22 * (high - low))
    start, height = low + 0.03 * (high - low), axis.get_ylim()[0] + 0.03 * np.ptp(axis.get_ylim())
    axis.plot([start, start + length], [height, height], color=colour("ink"), lw=2, solid_capstyle="butt")
    axis.annotate(
        with_unit(number(length), unit), (start + length / 2, height), xytext=(0, 3), textcoords="offset points", ha="center", fontsize=8
    )
