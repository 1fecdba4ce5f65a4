"""The page of a comparison: verdicts, values, checks and specs side by side, plots and drawings upon each other, one motion."""

import json
import math
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from drivewright import registry
from drivewright.execution.helper import Map
from drivewright.labels import label_of
from drivewright.report.comparison import DesignComparison, difference_text, distinct, entry_text, identical_text, value_text
from drivewright.report.content import (
    Content,
    Picture,
    Sketch,
    Views,
    check_label,
    draw_sketch,
    failing_sketch,
    program,
    scene_phase,
    summary,
)
from drivewright.report.folder import file_name, refuse_other
from drivewright.report.html import embedded, page, template_text
from drivewright.report.moving import Place, recover, replacing_folder
from drivewright.report.pack import pack_scene
from drivewright.result import Check, Result, Value
from drivewright.scene import Scene
from drivewright.units import System
from drivewright.view import draw_overlaid, draw_panels, draw_scene
from drivewright.view.axis_names import common_phrase
from drivewright.view.merged_scenes import merged_scene
from drivewright.view.overlays import apart, common_plots, is_apart, overlay
from drivewright.view.palette import SERIES
from drivewright.view.text import SIGNS, ends_shown, labelled_scale, number, numbers, quantity, sentence, unit_text, with_unit

PAGE, RECORD = "index.html", "compare.json"
OURS = {PAGE, RECORD, "figures"}  # what a comparison writes, and the next one replaces
MOST_KEYS = 200  # keys of the specs that differ and are on the page


class Shown(NamedTuple):
    """What there is to see of a comparison: one scene of all designs, the figures, and remarks about what is missing."""

    scene: Scene | None
    pictures: tuple[Picture, ...]
    remarks: tuple[str, ...]


def write_comparison(comparison: DesignComparison, seen: Sequence[Views], out: str | Path, compute: Map = map) -> Path:
    """Write index.html, compare.json and figures/*.svg of a comparison into the folder `out`, and return its path.

    `seen` are the views of each design.  What an earlier comparison wrote is replaced, everything else in the folder stays; InputError
    for a folder that is not empty and no comparison.  `compute` may draw the figures side by side.
    """
    out = recover_comparison(out)
    refuse_foreign(out)
    with replacing_folder(Place(out, OURS, refuse_foreign)) as fresh:
        record = json.dumps(comparison.record(), indent=1, ensure_ascii=False, allow_nan=False)
        (fresh / RECORD).write_text(f"{record}\n", encoding="utf-8")
        shown = views_of(comparison, seen, compute)
        _write_figures(fresh, shown.pictures)
        (fresh / PAGE).write_text(_page(comparison, shown), encoding="utf-8")
    return out


def recover_comparison(out: str | Path) -> Path:
    """The absolute path of the folder, after whatever writers that died have left beside it was brought back, or removed."""
    out = Path(out).resolve()
    recover(Place(out, OURS, refuse_foreign))
    return out


def refuse_foreign(out: Path) -> None:
    """InputError where writing to `out` would take the place of something that is no comparison."""
    refuse_other(out, "comparison", _is_comparison, RECORD)


def _is_comparison(folder: Path) -> bool:
    try:
        return {"labels", "values"} <= set(json.loads((folder / RECORD).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return False


def _write_figures(folder: Path, pictures: Sequence[Picture]) -> None:
    for picture in pictures:
        (folder / "figures").mkdir(exist_ok=True)
        (folder / "figures" / f"{picture.name}.svg").write_text(picture.svg, encoding="utf-8")


def _page(comparison: DesignComparison, shown: Shown) -> str:
    scene = shown.scene and {"scene": pack_scene(shown.scene, comparison.system)}
    player = scene and json.dumps(scene, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    values = comparison_content(comparison, shown.remarks)
    pictures = [embedded(picture) for picture in shown.pictures]
    return page("comparison.html.j2", values, player=player, pictures=pictures, own_style=template_text("comparison.css"))


# -- what is drawn -------------------------------------------------------------------------------------------------------------


def views_of(comparison: DesignComparison, seen: Sequence[Views], compute: Map = map) -> Shown:
    """The scene of all designs and every figure; what cannot be drawn is a remark, and costs nothing else."""
    scene, remarks = _scene(seen, comparison.labels)
    plots, told = _plots(comparison)
    sketches = [*_scene_sketches(scene, seen, comparison.system), *plots]
    sketches += _drawing_sketches(seen, comparison.labels, comparison.system)
    names = distinct([file_name(sketch.name) for sketch in sketches])
    named = [sketch._replace(name=name) for sketch, name in zip(sketches, names, strict=True)]
    pictures = tuple(compute(partial(draw_sketch, comparison.results[0].spec), named))
    return Shown(scene, pictures, (*remarks, *_own_remarks(seen, comparison.labels), *told))


def _scene(seen, labels):
    """(one scene of the designs that have one, remarks)."""
    moving = [(view.scene, label) for view, label in zip(seen, labels, strict=True) if view.scene]
    if len(moving) < 2:
        return None, ("fewer than two of these designs have a motion to show",)
    return merged_scene([scene for scene, _ in moving], [label for _, label in moving])


def _own_remarks(seen, labels):
    return tuple(f"{label}: {remark}" for view, label in zip(seen, labels, strict=True) for remark in view.remarks)


def _scene_sketches(scene: Scene | None, seen: Sequence[Views], system: System) -> Iterator[Sketch]:
    first = next((view.scene for view in seen if view.scene), scene)
    if scene and first:
        for frame in scene.frames:
            yield Sketch(f"scene-{frame.name}", sentence(frame.label), draw_scene, (scene, frame.name, [scene_phase(first)], (), system))


def _plots(comparison: DesignComparison) -> tuple[list[Sketch], list[str]]:
    """(figures of the plots that designs have in common, remarks)."""
    sketches, remarks = [], []
    for name, having in common_plots(comparison.results).items():
        if len(having) < len(comparison.results):
            remarks.append(f"plot '{name}' is that of {', '.join(comparison.labels[n] for n in having)} only")
        try:
            drawn, left_out = _panels(comparison, name)
            if not drawn:
                remarks.append(f"plot '{name}' is not drawn: the designs have none of its quantities in common")
                continue
            sketches += [_plot_sketch(name, n, panels) for n, panels in enumerate(drawn)]
            remarks += [f"plot '{name}': {left_out} more quantities, or those of one design only, are not drawn"] if left_out else []
        except Exception as error:  # one plot that fails must not cost the others
            sketches.append(failing_sketch(f"plot-{name}", name, error))
    return sketches, remarks


def _panels(comparison, name):
    """(panels of each figure of a plot, none where designs share no quantity; number of the quantities that are left out)."""
    if is_apart(comparison.results, name):
        return apart(comparison.results, comparison.labels, name), 0
    together = overlay(comparison.results, comparison.labels, name)
    shared = any(sum(not series.dashed for series in panel.series) > 1 for panel in together.panels)
    return [together.panels] if shared else [], together.left_out


def _plot_sketch(name, number_, panels):
    return Sketch(f"plot-{name}-{number_ + 1}" if number_ else f"plot-{name}", panels[0].title, draw_panels, (panels,))


def _drawing_sketches(seen: Sequence[Views], labels: Sequence[str], system: System) -> Iterator[Sketch]:
    found: dict[str, list[Any]] = {}
    for view, label in zip(seen, labels, strict=True):
        for drawing in view.drawings:
            found.setdefault(drawing.name, []).append((drawing, label))
    for name, parts in found.items():
        if len(parts) > 1:
            drawings, own = zip(*parts, strict=True)
            title = common_phrase([drawing.title for drawing in drawings]) or sentence(name.replace("_", " "))
            yield Sketch(f"drawing-{name}", title, draw_overlaid, (drawings, own, title, system))


# -- what the page says --------------------------------------------------------------------------------------------------------


def comparison_content(comparison: DesignComparison, remarks: Sequence[str] = ()) -> Content:
    """What the page says, as plain text in plain dictionaries."""
    results, labels = comparison.results, comparison.labels
    verdicts = [summary(result)["verdict"] for result in results]
    names, checks = list(comparison.values), dict.fromkeys(check.name for result in results for check in result.checks)
    headline = headline_names(comparison)
    keys = comparison.differing_keys
    rows = [_value_row(comparison, name) for name in names]
    return {
        "title": f"Comparison of {len(results)} designs",
        "mechanism": comparison.mechanism,
        "version": program(),
        "verdict": _verdict(results),
        "identical": [identical_text(group) for group in comparison.identical],
        "designs": [_design(*each) for each in zip(results, labels, verdicts, range(len(labels)), strict=True)],
        "headline": [_value_row(comparison, name) for name in headline],
        "checks": [_check_row(name, results, comparison.system) for name in checks],
        "keys": [_key_row(row) for row in keys[:MOST_KEYS]],
        "more_keys": max(len(keys) - MOST_KEYS, 0),
        "values": rows,
        "pair": len(results) == 2,
        "uncertain": any(not cell["certain"] for row in rows for cell in row["cells"]),
        "findings": [{"label": label, "findings": list(result.findings)} for result, label in zip(results, labels, strict=True)],
        "remarks": list(remarks),
        "sources": list(dict.fromkeys(str(source) for result in results for source in result.provenance.get("sources", ()))),
    }


def _verdict(results: Sequence[Result[Any]]) -> dict[str, str]:
    """How many designs fail a check, else how many have warnings."""
    failed, warned = sum(not result.ok for result in results), sum(bool(result.warnings) for result in results)
    if failed:
        return {"state": "bad", "text": f"{failed} of {len(results)} fail a check"}
    if warned:
        return {"state": "warn", "text": f"no failed check, {warned} of {len(results)} with warnings"}
    return {"state": "good", "text": "no failed check"}


def headline_names(comparison: DesignComparison) -> list[str]:
    """The mechanism's headline values; the first six of a kind that is not installed here."""
    known = {name: comparison.known(name) for name in comparison.values}
    if not registry.is_known(comparison.mechanism):
        return list(known)[:6]
    return registry.headlines(registry.mechanism(comparison.mechanism), known)


def _design(result: Result[Any], label: str, verdict: dict[str, str], number_: int) -> Content:
    seconds = with_unit(number(result.provenance.get("seconds", 0.0), 2), unit_text("s"))
    colour = SERIES[number_ % len(SERIES)]
    failed = [check_label(check) for check in result.checks if not check.ok]
    return {
        "label": label,
        "title": result.title,
        "colour": colour,
        "verdict": verdict,
        "failed": failed,
        "digest": result.digest[:12],
        "seconds": seconds,
    }


def _value_row(comparison: DesignComparison, name: str) -> Content:
    """A value of all designs, each with its difference from the first one."""
    known, apart_ = comparison.known(name), comparison.differences(name)
    cells = [
        {
            **_shown_value(result.values.get(name), comparison.system),
            "difference": difference_text(step, known.unit, comparison.system, label_of(known.meaning, known.label)) if n else "",
            "certain": step is None or step.certain,
            "same": step is not None and step.absolute == 0,
        }
        for n, (result, step) in enumerate(zip(comparison.results, apart_, strict=True))
    ]
    differs = any(not cell["same"] for cell in cells[1:])
    return {"name": name, "label": label_of(known.meaning or name, known.label), "cells": cells, "differs": differs}


def _shown_value(value: Value | None, system: System) -> dict[str, str]:
    """{value, interval}: the number with its unit, and the ends of its interval, "" where that says nothing."""
    if value is None or not math.isfinite(value.value):
        return {"value": value_text(None), "interval": ""}
    shown = labelled_scale(label_of(value.meaning, value.label), value.unit, system, value.value)
    text, low, high = numbers(shown.of(value.value), *ends_shown(value.low, value.high, shown))
    return {"value": with_unit(text, shown.unit), "interval": f"{low} to {high}" if low else ""}


def _check_row(name: str, results: Sequence[Result[Any]], system: System) -> Content:
    """A check of all designs; the limit stands in the cells where it is not the same for all."""
    found = [next((check for check in result.checks if check.name == name), None) for result in results]
    known = [check for check in found if check]
    limits = {(check.sense, check.limit) for check in known}
    return {
        "name": name,
        "label": check_label(known[0]),
        "message": sentence(known[0].message),
        "limit": _limit(known[0], system) if len(limits) == 1 else "",
        "cells": [_check_cell(check, len(limits) > 1, system) for check in found],
    }


def _limit(check: Check, system: System) -> str:
    return f"{SIGNS[check.sense]} {quantity(check.limit, check.unit, system=system, label=check_label(check))}"


def _check_cell(check: Check | None, own_limit: bool, system: System) -> Content:
    if check is None:
        return {"state": "none", "mark": "", "word": "not made", **_shown_value(None, system), "limit": ""}
    state = "bad" if not check.ok else "warn" if check.undecided else "good"
    mark, word = {"bad": ("✕", "fails"), "warn": ("?", "undecided"), "good": ("✓", "passes")}[state]
    value = _shown_value(Value(check.value, check.unit, check_label(check), *(check.bounds or (None, None))), system)
    return {"state": state, "mark": mark, "word": word, **value, "limit": _limit(check, system) if own_limit else ""}


def _key_row(row) -> Content:
    first = row.values[0]
    return {"key": row.key, "cells": [{"text": entry_text(value), "same": value == first} for value in row.values]}
