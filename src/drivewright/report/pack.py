"""A scene and the linked plots as JSON for the browser: arrays as base64 of little-endian float32, equal ones once."""

import base64
from collections.abc import Sequence
from typing import Any

import numpy as np

from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.result import Plot, Result
from drivewright.scene import Body, Scene
from drivewright.units import System
from drivewright.view.motion import fractions
from drivewright.view.outlines import overall_size, simplified_points
from drivewright.view.panels import STANDING, decimals, drawable, panels
from drivewright.view.text import display_unit, quantity, shown_scale

FINENESS = 3e-5  # curves become chords within this part of the scene's size: under a pixel at twenty-fold zoom
MOST_ROWS = 2000  # a longer table is thinned: more points than a plot is wide


def floats(array: ArrayLike) -> str:
    """base64 of an array as float32, row by row."""
    return base64.b64encode(np.ascontiguousarray(array, "<f4").tobytes()).decode()


def pack_handles(scene: Scene) -> list[dict[str, Any]]:
    """The handles of a scene for a page that changes the design; `body` is the number of the body that carries one, -1 of the frame."""
    order = {body.name: number for number, body in enumerate(scene.bodies)}
    return [
        {
            "key": handle.key,
            "body": order[handle.body] if handle.body else -1,
            "point": [float(part) for part in handle.point],
            "label": handle.label,
            **({"direction": [float(part) for part in handle.direction]} if handle.direction else {}),
        }
        for handle in scene.handles
        if not handle.body or handle.body in order
    ]


def pack_scene(scene: Scene, system: System = "mm") -> dict[str, Any]:
    """Plain dictionary of a scene for `createPlayer`; `length` is (factor, unit) of its scale bar, absent where it is metric.

    `motions` holds every different set of poses once, as (frames or 1) x (x, y, angle) with continuous angles, and `shapes` every
    different shape once; bodies and observers point into them.  `u` is the driving quantity as 0 ... 1.
    """
    motions, pool, tolerance = {}, {}, _fineness(overall_size(scene))
    bodies = [
        {
            "name": b.name,
            "label": b.label,
            "colour": b.colour,
            "motion": _pooled(b.poses, motions),
            "shapes": _pooled_shapes(b.shapes, pool, tolerance),
            **_magnified(b, motions),
            **_shown(b),
        }
        for b in scene.bodies
    ]
    observers = [
        {
            "name": f.name,
            "label": f.label,
            "motion": _pooled(f.poses, motions),
            "advance": [float(a) for a in f.advance],
            "shapes": _pooled_shapes(f.shapes, pool, tolerance),
        }
        for f in scene.frames
    ]
    order = [b.name for b in scene.bodies]
    traces = [
        {"label": t.label, "body": order.index(t.body), "point": [float(p) for p in t.point], **({"colour": t.colour} if t.colour else {})}
        for t in scene.traces
    ]
    period = float(scene.period) if np.isfinite(scene.period) and scene.period > 0 else None
    return {
        "cycle": pack_cycle(scene, system),
        **({} if system == "mm" else {"length": list(display_unit("m", system))}),
        "period": period,
        "bodies": bodies,
        "observers": observers,
        "traces": traces,
        **({"labels": _labels(scene, order, system)} if scene.labels else {}),
        "motions": list(motions),
        "shapes": [packed for _, packed in pool.values()],
        "frames": len(scene.cycle),
        "u": floats(fractions(scene.cycle)),
    }


def _labels(scene: Scene, order: Sequence[str], system: System) -> list[dict[str, Any]]:
    """Words on the drawing, numbers in the unit people read; `body` is the number of the body that carries one, -1 of the frame."""
    return [
        {
            "text": " ".join(
                part for part in (label.text, "" if label.value is None else quantity(label.value, label.unit, 4, system)) if part
            ),
            "body": order.index(label.body) if label.body else -1,
            "point": [float(part) for part in label.point],
            "above": label.above,
        }
        for label in scene.labels
    ]


def _fineness(size: float) -> float:
    """A power of two, so that a scene that grows a little keeps the chords of its curves, and a viewer what it has made of them."""
    return 2.0 ** np.floor(np.log2(FINENESS * size))


def _magnified(body: Body, motions: dict[str, int]) -> dict[str, float]:
    """What the viewer needs to draw play or deflection larger or smaller; nothing of a body that is where it is."""
    if body.rest is None:
        return {}
    limit = {"most": float(body.most)} if np.isfinite(body.most) else {}
    return {"rest": _pooled(body.rest, motions), "magnified": float(body.magnified), **limit}


def _shown(body: Body) -> dict[str, list[list[int]]]:
    """First and last frame of every stretch of the cycle in which a body is drawn; nothing of one that always is."""
    if body.shown is None or body.shown.all():
        return {}
    ends = np.flatnonzero(np.diff(np.pad(body.shown.astype(int), 1)))
    return {"shown": [[int(first), int(last) - 1] for first, last in ends.reshape(-1, 2)]}


def pack_cycle(scene: Scene, system: System) -> dict[str, Any]:
    """The driving quantity in the unit people read, with its marks as (0 ... 1, label)."""
    shown = shown_scale(scene.cycle_unit, system=system)
    start, span = float(scene.cycle[0]), float(scene.cycle[-1] - scene.cycle[0])
    marks = sorted([(value - start) / span, label] for value, label in scene.marks)
    return {"label": scene.cycle_label, "unit": shown.unit, "start": shown.of(start), "span": span * shown.factor, "marks": marks}


def _pooled(poses: ArrayLike, motions: dict[str, int]) -> int:
    """Number of these poses in the pool, which takes them in when they are new; poses that never change are one row."""
    poses = np.asarray(poses, float)
    turned = np.column_stack([poses[:, :2], np.unwrap(poses[:, 2])])
    text = floats(turned[:1] if np.array_equal(turned, np.broadcast_to(turned[0], turned.shape)) else turned)
    return motions.setdefault(text, len(motions))


def _pooled_shapes(shapes, pool, tolerance):
    """Numbers of these shapes in the pool {id: (number, packed)}, as chords within `tolerance` [m]; the links of a chain share theirs."""
    for shape in shapes:
        if id(shape) not in pool:
            points = floats(simplified_points(shape.outline, tolerance))
            pool[id(shape)] = len(pool), {"layer": shape.layer, "closed": bool(shape.outline.closed), "points": points}
    return [pool[id(shape)][0] for shape in shapes]


def pack_plots(result: Result[Any], scene: Scene, plots: Sequence[Plot]) -> dict[str, Any] | None:
    """Plain dictionary for `createPlots`: the panels over the scene's cycle, one after another; None where there are none."""
    packed = pack_plot_groups(result, scene, plots)
    return packed and {"cycle": packed["cycle"], "panels": [panel for plot in packed["plots"] for panel in plot["panels"]]}


def pack_plot_groups(result: Result[Any], scene: Scene, plots: Sequence[Plot]) -> dict[str, Any] | None:
    """The same with the panels of every plot together: {"cycle", "plots": [{"name", "title", "panels"}]}; None where there are none.

    A plot is linked when its x column is the one that leads the scene's table and covers one cycle at most, whichever table it is in.
    """
    main = result.tables.get(scene.table)
    chosen = [
        (plot, along(result.tables[plot.table][plot.x].data, scene))
        for plot in drawable(result, plots)
        if main and plot.x == main.columns[0].name and not plot.equal and plot.style not in STANDING
    ]
    packed = [
        {"name": plot.name, "title": plot.title, "panels": list(_panels(panels(result, plot), u, scene, result.units))}
        for plot, u in chosen
        if u is not None
    ]
    return {"cycle": pack_cycle(scene, result.units), "plots": packed} if packed else None


def along(x: ArrayLike, scene: Scene) -> Floats | None:
    """x as 0 ... 1 along the scene's closed cycle, wherever on it x starts; None where x covers more than one cycle."""
    u = (np.asarray(x, float) - scene.cycle[0]) / (scene.cycle[-1] - scene.cycle[0])
    if not len(u) or not np.all(np.isfinite(u)) or np.ptp(u) > 1 + 1e-6:
        return None
    return u if u.min() > -1e-6 and u.max() < 1 + 1e-6 else u % 1.0


def _panels(panels, u, scene, system):
    """The panels of one plot; where there are several, one with a single line is named after it."""
    order = np.argsort(u, kind="stable")
    for panel in panels:
        rows = order[envelope_rows([each[order] for s in panel.series for each in (s.data, *s.ends)])]
        title = panel.title if len(panels) == 1 or len(panel.series) > 1 else panel.series[0].label
        yield {
            "name": panel.series[0].name,
            "title": title,
            "low": panel.low,
            "high": panel.high,
            "decimals": int(decimals(panel.low, panel.high)),
            "u": floats(u[rows]),
            "style": panel.style,
            "log": panel.log,
            "shade": _shade(panel, scene, system),
            "limits": [[float(value), text] for value, text in panel.limits],
            "series": [
                {
                    "label": s.label,
                    "unit": s.unit,
                    "role": s.role,
                    "dashed": s.dashed,
                    "data": floats(s.data[rows]),
                    **({"ends": [floats(end[rows]) for end in s.ends]} if s.ends else {}),
                }
                for s in panel.series
            ],
        }


def _shade(panel, scene, system):
    """Shaded stretches as [from, to] in 0 ... 1 along the scene's cycle."""
    start, span = scene.cycle[0], scene.cycle[-1] - scene.cycle[0]
    shown = shown_scale(scene.cycle_unit, system=system)
    return [[((edge - shown.zero) / shown.factor - start) / span for edge in stretch] for stretch in panel.shade]


def envelope_rows(lines: Sequence[Floats], most: int = MOST_ROWS) -> Ints:
    """Rows that draw the same picture: all of a short table; of a long one the lowest and highest of each line in equal stretches."""
    count = len(lines[0])
    if count <= most:
        return np.arange(count)
    stretches = np.array_split(np.arange(count), most // (2 * len(lines)))
    chosen = [{0, count - 1}]
    for line in lines:
        line = np.where(np.isfinite(line), line, 0.0)
        chosen += [{rows[line[rows].argmin()], rows[line[rows].argmax()]} for rows in stretches]
    return np.array(sorted(set().union(*chosen)))
