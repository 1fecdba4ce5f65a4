"""What the command line prints: results to stdout, everything else to stderr."""

import contextlib
import json
import math
import shlex
import sys
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, get_args

from drivewright import atomic, digits, registry, units
from drivewright.errors import InputError, MissingExtra, SpecError, UnknownName
from drivewright.labels import usual_unit

if TYPE_CHECKING:
    from rich.console import JustifyMethod

    from drivewright.result import Check, Result, Value
    from drivewright.runner import Progress
    from drivewright.studies.answers.extremes import End
    from drivewright.studies.answers.whole import Answers
    from drivewright.studies.optimisation import Optimised
    from drivewright.studies.study import Study
    from drivewright.studies.verification import Comparison
    from drivewright.validation.source import Row, Source

    Header: TypeAlias = Iterable[tuple[str, JustifyMethod]]

MOST_REMARKS = 5  # notes of a run on one screen
MAX_STUDY_ROWS = 12  # of a study's values
MOST_ENDS = 3  # values whose inputs are printed at both ends
MOST_REASONS = 3  # why its cases are not complete
LONGEST_REASON = 300  # characters
ROUNDING = 1e-9  # of a limit: a margin that is none
CLOSE = ("°",)  # units that stand close to their number
SELDOM = 30.0  # seconds between two lines on how far a command is, where no bar can be drawn


def note(text: str) -> None:
    """One line for the person at the terminal."""
    print(text, file=sys.stderr)


@contextlib.contextmanager
def located(path: Path) -> Iterator[None]:
    """Names the spec file in an error that does not know where it came from."""
    try:
        yield
    except MissingExtra:
        raise
    except SpecError as error:
        raise error.located(file=str(path)) if error.file is None else error from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except OSError as error:
        raise _disk_error(error) from None


def _disk_error(error: OSError) -> InputError:
    """The error of a full disk or of a missing permission, in one line: no fault of the program."""
    return InputError(f"{error.filename or 'the output'}: {error.strerror or error}; nothing was written over")


@contextlib.contextmanager
def progress(title: str, kind: str = "") -> "Iterator[Progress]":
    """A callable step(done, total, what) that moves a bar; without a terminal a line on stderr every `SELDOM` seconds says how far it is.

    `kind` of the drive, for the words about compiling.
    """
    from drivewright._jit.compilation import Compilation, watched_by
    from drivewright.steps import detailed

    if not sys.stderr.isatty():
        with compiling(kind or title), detailed(_seldom(title)) as step:
            yield step
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TextColumn, TimeRemainingColumn
    from rich.text import Text

    compilation = Compilation(kind or title)

    class Work(ProgressColumn):
        """What is compiled, or which analysis runs and how far it is."""

        def render(self, task: Task) -> Text:
            return Text(compilation.words or task.fields["what"])

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), Work(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar, watched_by(compilation):
        task = bar.add_task(title, total=None, what="")
        with detailed(lambda done, total, what: bar.update(task, completed=done, total=total, what=what)) as step:
            yield step


def _seldom(title: str) -> "Progress":
    """step(done, total, what) that says how far it is once `SELDOM` seconds have passed since it last did, or since now."""
    shown_at = time.monotonic()

    def step(done: int, total: int, what: str) -> None:
        nonlocal shown_at
        if time.monotonic() - shown_at >= SELDOM:
            shown_at = time.monotonic()
            note(f"{title}: {', '.join(filter(None, [f'{done} of {total} done' if total else '', what]))}")

    return step


@contextlib.contextmanager
def compiling(kind: str) -> Iterator[None]:
    """Within the block the compilation for a kind of drive is reported on stderr, line by line."""
    from drivewright._jit.compilation import watched_by

    lines = _Lines(kind)
    with watched_by(lines.compilation), contextlib.closing(lines):
        yield


class _Lines:
    """Says on stderr what is compiled: once it has taken, or will take, more than `FIRST` seconds, and then every `EACH` seconds."""

    FIRST, EACH = 2.0, 10.0

    def __init__(self, kind: str) -> None:
        from drivewright._jit.compilation import Compilation

        self.compilation = Compilation(kind, self._begun)
        self.shown_at, self.over, self.looking = -math.inf, threading.Event(), None
        self.one_at_a_time = threading.Lock()

    def _begun(self) -> None:
        self.look()
        if self.looking is None:  # one kernel may take longer than what comes between two lines
            self.looking = threading.Thread(target=self._keep_looking, daemon=True)
            self.looking.start()

    def _keep_looking(self) -> None:
        while not self.over.wait(0.25):
            self.look()

    def look(self) -> None:
        """Say how far it is, if that is due."""
        with self.one_at_a_time:
            words, now = self.compilation.words, time.monotonic()
            if words and max(self.compilation.seconds, self.compilation.left) > self.FIRST and now - self.shown_at >= self.EACH:
                self.shown_at = now
                note(words)

    def close(self) -> None:
        """Say nothing more."""
        self.over.set()


def table(title: str, header: "Header", rows: Iterable[Iterable[object]]) -> None:
    """A table on stdout; plain where stdout is no terminal, so that it can be piped and diffed."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    grid = Table(title=title, box=SIMPLE_HEAD, title_justify="left", title_style="bold")
    for name, justify in header:
        grid.add_column(name, justify=justify, overflow="fold")
    for row in rows:
        grid.add_row(*(cell if isinstance(cell, Text) else Text(str(cell)) for cell in row))
    Console(file=sys.stdout, width=None if sys.stdout.isatty() else 140, highlight=False).print(grid)


def number(
    value: float, unit: str, low: float | None = None, high: float | None = None, wanted: str = "", system: units.System = "mm"
) -> str:
    """A number in the unit people read, or in a `wanted` one, with the unit, and with its interval in the digits that this supports."""
    from drivewright.view.text import shown_scale

    return _on_scale(value, None if low is None or high is None else (low, high), shown_scale(unit, wanted, system, value))


def _on_scale(value: float, bounds: tuple[float, float] | None, shown: units.Scale) -> str:
    """A number with its interval on a scale, with the unit."""
    text, *ends = digits.plain(*(shown.of(each) for each in (value, *(bounds or ()))))
    return _with_unit(f"{text} ({ends[0]} to {ends[1]})" if ends else text, shown.unit)


def system_of(name: str) -> units.System:
    """A system of units by name; UnknownName where it is none."""
    systems: dict[str, units.System] = {each: each for each in get_args(units.System)}
    if name not in systems:
        raise UnknownName("system of units", name, systems)
    return systems[name]


def _with_unit(text: str, shown: str) -> str:
    unit = shown.replace("\u00a0", " ")
    return text if unit in ("-", "") else f"{text}{'' if unit in CLOSE else ' '}{unit}"


def result(run: "Result[Any]", everything: bool = False) -> None:
    """Verdict, key numbers, the checks that fail with what to do, warnings and findings of a run, on one screen; `everything` for all."""
    from drivewright.report.content import key_names, verdict_of

    names = list(run.values) if everything else key_names(run)
    columns = 4 if everything else 3  # with the names by which result.json has them
    rows = [(label_text(run.values[name]), value_text(run, name), _made(run, name), name)[:columns] for name in names]
    header: Header = [("quantity", "left"), ("value", "right"), ("", "left"), ("name", "left")]
    table(run.title, header[:columns], rows)
    shown = [c._replace(value=0.0) if run.is_noise(c) else c for c in run.checks if everything or not c.ok or c.undecided]
    checks(shown, run.units)
    advice(run)
    for line in _remarks_of(run, everything):
        note(f"note: {line}")
    for warning in run.warnings:
        _coloured_note(f"warning: {warning}", "warn")
    verdict = verdict_of(run)
    _coloured_note(f"verdict: {verdict['text']}", verdict["state"])


def _remarks_of(run: "Result[Any]", everything: bool) -> "Iterator[str]":
    """The findings that are no warnings; those on analyses that did not run in one line, unless `everything` is wanted."""
    from drivewright.runner import ON_REQUEST

    findings = [finding for finding in run.findings if finding not in run.warnings]
    optional = [finding for finding in findings if finding in run.left_out.values() or ON_REQUEST in finding]
    shown = findings if everything else [finding for finding in findings if finding not in optional]
    most = len(shown) if everything or run.outcome != "complete" else MOST_REMARKS  # a partial result needs every reason
    yield from shown[:most]
    folded = [_counted(len(shown) - most, "more note", "more notes")] if len(shown) > most else []
    if optional:
        folded.append(f"{_counted(len(optional), 'analysis', 'analyses')} not run (on request only, or without their input)")
    if folded and not everything:
        yield f"{', '.join(folded)}: see the report, or drivewright run -v"


def _counted(count: int, one: str, many: str) -> str:
    return f"{count} {one if count == 1 else many}"


def _coloured_note(text: str, state: str) -> None:
    """A note, at a terminal in the colour of a verdict's state."""
    from rich.console import Console
    from rich.text import Text

    style = {"good": "green", "warn": "bold yellow", "bad": "bold red"}[state]
    Console(file=sys.stderr, highlight=False).print(Text(text, style=style), soft_wrap=True)


def value_text(run: "Result[Any]", name: str) -> str:
    """A value in the unit in which people read it; 0 where it is rounding."""
    value = run.values[name]
    seen = 0.0 if run.is_noise(value) else value.value
    return number(seen, value.unit, value.low, value.high, usual_unit(label_text(value), value.unit), run.units)


def label_text(value: "Value") -> str:
    """The short name of a value."""
    from drivewright.labels import label_of

    return label_of(value.meaning, value.label)


def _made(run: "Result[Any]", name: str) -> str:
    """How its interval was made, where one is shown."""
    return run.values[name].made if " to " in value_text(run, name) else run.values[name].interval


def finish_run(results: "Sequence[Result[Any]]", only: "Sequence[str]" = (), as_json: bool = False, strict: bool = False) -> None:
    """The end of a run: JSON on stdout where requested; exit 4 after a solver that gave up, 2 where an analysis that was asked for by
    name was left out, 3 after a failed check with `strict`."""
    import typer

    if as_json:
        records = [each.record() for each in results]
        json.dump(records[0] if len(records) == 1 else records, sys.stdout, indent=1)
        print()
    if any(each.outcome == "partial" for each in results):
        raise typer.Exit(4)
    if any(name in each.left_out for each in results for name in only):
        raise typer.Exit(2)
    if strict and not all(each.ok for each in results):
        raise typer.Exit(3)


def checks(design_checks: "Iterable[Check]", system: units.System = "mm") -> None:
    """Every design check with value, limit and margin, in a system of units."""
    from rich.text import Text

    from drivewright.result import UNDECIDED

    def verdict(check):
        return Text("ok", style="green") if check.ok else Text("FAILS", style="bold red")

    rows = [
        (verdict(c), c.display_label, *check_numbers(c, system), f"{c.message} ({UNDECIDED})" if c.undecided else c.message)
        for c in sorted(design_checks, key=lambda c: c.ok)
    ]
    if rows:
        table(
            "design checks",
            (("", "left"), ("check", "left"), ("value", "right"), ("limit", "right"), ("margin", "right"), ("", "left")),
            rows,
        )


def advice(run: "Result[Any]") -> None:
    """What to change for the checks that fail, each as options of the same command; one change that serves several is said once."""
    from drivewright.report.advice import advice_text

    checks_by_name = {check.name: check for check in run.checks}
    for each in {advice.changes: advice for advice in reversed(run.advice)}.values():
        options = " ".join(f"--set {change.key}={shlex.quote(change.given)}" for change in each.changes)
        print(f"  to pass '{checks_by_name[each.check].display_label}': {advice_text(each, checks_by_name, run.units)}")
        print(f"      {options}")
    if run.advice_stopped:
        note("note: the search for what to change stopped after its usual time; with --advice it runs to the end")


def check_numbers(check: "Check", system: units.System) -> tuple[str, str, str]:
    """Value, limit and margin in one unit, the one that suits the limit: a life of half an hour stands beside its limit of 10000 h."""
    from drivewright.view.text import labelled_scale

    shown = labelled_scale(check.display_label, check.unit, system, check.limit or check.value)
    limit = _with_unit(digits.plain(shown.of(check.limit))[0], shown.unit)
    return _on_scale(check.value, check.bounds, shown), f"{check.sense} {limit}", _margin(check, shown)


def _margin(check: "Check", shown: units.Scale) -> str:
    """With the digits that the check's value has; 0 where it is no more than rounding."""
    if abs(check.margin) <= ROUNDING * abs(check.limit) < math.inf:
        return _with_unit("0", shown.unit)
    margin, *ends = (shown.factor * each for each in (check.margin, *(check.margin_bounds or ())))
    return _with_unit(digits.plain(margin, *ends)[0], shown.unit)


def optimised(search: "Optimised") -> None:
    """The best design(s) of a search and the requirements it met or missed."""
    table("objectives", (("value", "left"), ("best", "right"), ("wanted", "left")), search.objective_rows())
    table("unknowns", (("key", "left"), ("best", "right"), ("lower", "right"), ("upper", "right")), search.unknown_rows())
    checks(search.requirements, search.best.units)
    so_far = " so far: the best of them, not the end of the search" if search.interrupted else ""
    note(f"{search.evaluations} evaluations{so_far}, {search.seconds:.1f} s, seed {search.seed}")
    for line in search.findings:
        note(f"note: {line}")


def study(study: "Study", answers: "Answers | None" = None) -> None:
    """How the cases of a study ended, between which ends its headline values lie, and the yield where the answers have one."""
    from drivewright.studies.answers.extremes import ends_of_columns

    ends = ends_of_columns(study, _headline_columns(study))
    names = list(ends)
    rows = [(name, *_ends(study, name, ends[name]), study.meaning(name)) for name in names[:MAX_STUDY_ROWS]]
    title = ", ".join(f"{count} {status}" for status, count in study.counts.items())
    table(title, (("value", "left"), ("least", "right"), ("greatest", "right"), ("meaning", "left")), rows)
    for name, *_ in rows[:MOST_ENDS] if answers else ():
        print(_inputs_of_ends(study, name, ends[name]))
    if answers and "yield" in answers.result.values:
        share, low, high = (answers.result.values[name].value for name in ("yield", "yield.low", "yield.high"))
        print(f"yield: {share:.1%} of the random cases pass every check ({low:.1%} to {high:.1%} with 95% confidence)")
    if len(names) > len(rows):
        note(f"{len(names) - len(rows)} more values in the report and in the study's table")
    for group in study.reasons()[:MOST_REASONS]:
        note(f"note: {group.cases} x {group.text(LONGEST_REASON)}")
    for remark in (*study.plan.remarks, *study.remarks):
        note(f"note: {remark}")


def _inputs_of_ends(study: "Study", name: str, ends: "tuple[End, End]") -> str:
    """Two lines, "area least: 64 mm^2 with size 8 mm (case 0)" and that of the greatest."""
    from drivewright.studies.answers.extremes import inputs_text

    return "\n".join(
        f"{name} {word}: {_ends(study, name, (end,))[0]} with {inputs_text(study, end.case)} (case {end.case})"
        for word, end in zip(("least", "greatest"), ends, strict=True)
    )


def _ends(study: "Study", name: str, ends: "Sequence[End]") -> list[str]:
    """Least and greatest of a column in one unit, each with the interval that it has in its case."""
    from drivewright.view.text import labelled_scale

    shown = labelled_scale(study.label(name), study.unit(name), study.spec.units, max(abs(end.number) for end in ends))
    return [_on_scale(end.number, end.bounds, shown) for end in ends]


def _headline_columns(study: "Study") -> list[str]:
    """Names of the requested values, or of the headline; those that vary come first."""
    requested = study.spec.study.values if study.spec.study else ()
    names = requested or registry.headlines(registry.mechanism(study.spec.mechanism), dict.fromkeys(study.value_names))
    known = [name for name in names if name in study.column_names]
    first = next(study.batches(known), None)
    return sorted(known, key=lambda name: first is not None and len(first[name].slice(0, 1000).unique()) == 1)


def comparison(rows: "Iterable[Comparison]", system: units.System = "mm") -> None:
    """Our numbers beside those of the independent route in a system of units, and below them what was not compared and why."""
    rows = tuple(rows)
    table(
        "independent route",
        (("quantity", "left"), ("ours", "right"), ("other", "right"), ("difference", "right"), ("allowed", "right"), ("route", "left")),
        [
            (r.name, *(number(each, r.unit, system=system) for each in (r.ours, r.other, r.other - r.ours, r.allowed)), r.route)
            for r in rows
            if not r.left_out
        ],
    )
    for row in rows:
        if row.left_out:
            print(f"left out: {row.name}: {row.left_out}")


def source(published: "Source", rows: "Iterable[Row]") -> None:
    """One published source: its numbers beside ours."""
    header: Header = (
        ("quantity", "left"),
        ("printed", "right"),
        ("ours", "right"),
        ("deviation", "right"),
        ("verdict", "left"),
        ("why", "left"),
    )
    table(
        published.citation,
        header,
        [
            (
                r.name,
                r.printed,
                "" if r.ours is None else number(r.ours, r.unit, r.low, r.high, r.printed.unit),
                r.deviation_text(),
                r.verdict,
                r.commentary,
            )
            for r in rows
        ],
    )


def write_text(path: str | Path, text: str) -> None:
    """A text file, written whole or not at all."""
    if not Path(path).parent.is_dir():
        raise InputError(f"{path}: there is no folder {str(Path(path).parent)!r}; make it first")
    try:
        atomic.write_text(path, text)
    except OSError as error:
        raise _disk_error(error) from None


def copy_file(source: Path, target: Path) -> None:
    """A copy of a file, written whole or not at all."""
    try:
        atomic.copy(source, target)
    except OSError as error:
        raise _disk_error(error) from None


def copy_data_files(kind: str, preset: str | None, path: Path) -> None:
    """Data files that a preset names go beside the new spec; one that is there already is left alone."""
    from drivewright.spec import load, preset_path

    preset_file = preset_path(kind, preset)
    if preset_file is None:
        return
    for source in load(preset_file).data_files():
        target = Path(path).parent / source.relative_to(preset_file.resolve().parent)
        if target.exists() and target.read_bytes() != source.read_bytes():
            note(f"note: {target} exists and is left alone, so the new spec reads it instead of the preset's")
        else:
            copy_file(source, target)


def refuse_existing(path: str | Path) -> None:
    """Nothing of the user's is written over."""
    if Path(path).exists():
        raise InputError(f"{path} exists and is left alone; name another file or move it away")
