"""Manufacturing files of a design: everything that `drivewright export` can write."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from drivewright import registry, runner
from drivewright.errors import GeometryCheckFailed, InputError, UnknownName
from drivewright.registry import Mechanism
from drivewright.report import dxf, gcode, svgout, tabular
from drivewright.report.content import views
from drivewright.report.form import ReportForm
from drivewright.report.letterhead import read_letterhead
from drivewright.report.names import file_name
from drivewright.result import Result
from drivewright.scene import Drawing, Part
from drivewright.spec import MechanismSpec
from drivewright.view.text import quantity

REPORTS = ("pdf",)  # no workshop makes a part from them
FORMATS = ("dxf", "svg", "csv", "step", "stl", "gcode", *REPORTS)


def export(
    spec: MechanismSpec,
    formats: Sequence[str],
    folder: str | Path,
    anyway: bool = False,
    progress: Callable[[int, int, str], object] | None = None,
    form: ReportForm = ReportForm(),
    advise: Callable[[Result[Any]], Result[Any]] = lambda result: result,
    solids: bool = False,
) -> list[Path]:
    """Write the formats of a design into `folder`; returns the paths.  What is checked, and what tables there are, is that of the
    default analyses and of those for manufacture.

    GeometryCheckFailed where a geometry check fails, unless `anyway`, or only the PDF report is wanted, which says so itself, in the
    `form` given; a solid format needs the extra 'fe', the PDF the extra 'pdf'.  `advise` adds to the result of the PDF what to change
    where a check fails (`studies.advise`); `solids` shows the parts in it.
    """
    _refuse_unknown(formats)
    read_letterhead(spec)
    mechanism = registry.mechanism(spec.mechanism)
    model = mechanism.build(spec)
    result = runner.run(spec, [analysis.name for analysis in mechanism.analyses if analysis.default or analysis.manufacture], model=model)
    if not anyway and any(name not in REPORTS for name in formats):
        _refuse_bad_geometry(result)
    folder = Path(folder)
    step = progress or (lambda done, total, what: None)
    files = []
    for number, name in enumerate(formats):
        step(number, len(formats), name)
        files += _pdf(advise(result), folder, form, model, solids) if name in REPORTS else WRITERS[name](mechanism, model, result, folder)
    return files


def _refuse_unknown(formats: Sequence[str]) -> None:
    if not formats:
        raise InputError(f"export needs at least one format of {', '.join(FORMATS)}")
    for name in formats:
        if name not in FORMATS:
            raise UnknownName("export format", name, FORMATS)


def _refuse_bad_geometry(result: Result[Any]) -> None:
    if failed := _failures(result):
        raise GeometryCheckFailed(
            f"this design fails a geometry check and is not exported: {'; '.join(failed)}. Fix the design, or export it with --anyway"
        )
    if missing := dict.fromkeys(result.failures.values()):
        raise GeometryCheckFailed(
            f"this design is not checked in full and not exported: {'; '.join(missing)}. Fix the design, or export it with --anyway"
        )


def _failures(result: Result[Any]) -> list[str]:
    """The failed geometry checks in words."""
    return [
        f"{check.display_label}: {quantity(check.value, check.unit, system=result.units, label=check.display_label)}, "
        f"limit {check.sense} {quantity(check.limit, check.unit, system=result.units, label=check.display_label)} ({check.message})"
        for check in result.checks
        if check.geometry and not check.ok
    ]


def _drawings(mechanism: Mechanism[Any, Any], model: object) -> tuple[Drawing, ...]:
    drawings = tuple(mechanism.drawings(model)) if mechanism.drawings else ()
    if not drawings:
        raise InputError(f"{mechanism.kind} has no flat parts to draw; try step or csv")
    return drawings


def _parts(mechanism: Mechanism[Any, Any], model: object) -> tuple[Part, ...]:
    parts = tuple(mechanism.parts(model)) if mechanism.parts else ()
    if not parts:
        raise InputError(f"{mechanism.kind} has no solids; try dxf or csv")
    return parts


def _dxf(mechanism, model, result, folder):
    return [_written(dxf.write_dxf, d, folder / f"{file_name(d.name)}.dxf") for d in _drawings(mechanism, model)]


def _svg(mechanism, model, result, folder):
    return [_written(svgout.write_svg, d, folder / f"{file_name(d.name)}.svg") for d in _drawings(mechanism, model)]


def _csv(mechanism, model, result, folder):
    write = partial(tabular.write_csv, system=result.units)
    return [_written(write, t, folder / f"{file_name(t.name)}.csv") for t in result.tables.values()]


def _step(mechanism, model, result, folder):
    from drivewright.report import cad

    return [_written(cad.write_step, _parts(mechanism, model), folder / "assembly.step")]


def _stl(mechanism, model, result, folder):
    from drivewright.report import cad

    return [_written(cad.write_stl, [part], folder / f"{file_name(part.name)}.stl") for part in _parts(mechanism, model)]


def _gcode(mechanism, model, result, folder):
    milled = [drawing for drawing in _drawings(mechanism, model) if drawing.milled]
    if not milled:
        raise InputError(f"{mechanism.kind} has no milled parts; try dxf or step")
    make = model.spec.manufacture
    settings = {
        "cutter_diameter": make.cutter_diameter,
        "feed": make.feed,
        "plunge": make.plunge,
        "step_down": make.step_down,
        "spindle_speed": make.spindle_speed,
        "tolerance": make.chord_tolerance,
        "warnings": _failures(result),
    }
    return [_written(lambda d, path: gcode.write_gcode(d, path, **settings), d, folder / f"{file_name(d.name)}.nc") for d in milled]


def _pdf(result: Result[Any], folder: Path, form: ReportForm, model: object, solids: bool) -> list[Path]:
    from drivewright.report import pdf

    return [_written(partial(pdf.write_pdf, seen=views(result, model, solids), form=form), result, folder / "report.pdf")]


def _written(write, what, path):
    try:
        write(what, path)
    except FileNotFoundError:  # a run has just replaced the folder
        write(what, path)
    return path


WRITERS = {"dxf": _dxf, "svg": _svg, "csv": _csv, "step": _step, "stl": _stl, "gcode": _gcode}
