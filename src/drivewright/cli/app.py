"""Commands.  They depend on the registry, the schema and the result, and on no kind of drive by name."""

import json
import os
from collections import Counter
from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from drivewright import registry
from drivewright.cli import plugin_commands, show
from drivewright.errors import DEBUG, InputError, UnknownName

app = typer.Typer(
    cls=plugin_commands.CommandGroup,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Design, simulate and verify mechanical drives.",
)

# The base class of errors in the use of the command line; its module depends on the version of the library.
usage_errors: Any = next(base for base in typer.BadParameter.__mro__ if base.__name__ == "ClickException")

SpecFile = Annotated[Path, typer.Argument(help="spec file (TOML)")]
SetOption = Annotated[list[str] | None, typer.Option("--set", help="key=value, repeatable; replaces a key of the spec, key= removes it")]
OnlyOption = Annotated[str, typer.Option("--only", help="analyses to run, comma separated, with what they need")]
AllOption = Annotated[bool, typer.Option("--all", help="every analysis")]
UnitsOption = Annotated[str | None, typer.Option("--units", help="units of the pages: mm, si or inch; as the spec's own key")]
ReportOption = Annotated[
    str, typer.Option("--report", help="short: the first page; normal; full: everything open, with how it was computed")
]
LanguageOption = Annotated[str, typer.Option("--lang", help="language of the report: en or zh")]
OutOption = Annotated[Path | None, typer.Option("--out", help="folder to write; default out/<stem of the spec>")]
AdviceOption = Annotated[
    bool | None,
    typer.Option(
        "--advice/--no-advice",
        help="say what to change for checks that fail: however long that takes, or not at all; unless given, within 3 s",
    ),
]
VARY_HELP = (
    "repeatable: KEY=FROM:TO:STEPS, KEY=V1,V2, KEY=FROM:TO or uniform(FROM, TO), KEY=normal(MEAN, SIGMA), "
    "KEY=triangular(FROM, PEAK, TO), KEY=+-TOLERANCE; FROM and TO also as -5 % and +5 % of the spec's own value, SIGMA and "
    "TOLERANCE as 5 %; KEY+KEY=... for keys with the same value, KEY + -KEY=... with the negative one; "
    "KEY=-2 * OTHER + 3 mm for one that follows another; instead of what the spec's [study] varies"
)
RETRY_HELP = (
    "failed: compute the failed cases of the study in --out once more; incomplete: the partial ones too; all other rows stay. Without "
    "--vary and [study] the study's own plan counts; or give the folder of the study in place of the spec"
)
METHOD_HELP = "latin-hypercube, sobol, random, corners, one-at-a-time, tolerance, sobol-indices"
JsonOption = Annotated[bool, typer.Option("--json", help="print JSON to stdout in place of tables; numbers in SI")]
StrictOption = Annotated[bool, typer.Option("--strict", help="exit 3 when a design check fails")]


def _load(path: Path, changes: Iterable[str] | None, units: str | None = None) -> Any:
    from drivewright.spec import load

    return load(path, [*(changes or ()), *([f"units={units}"] if units is not None else [])])


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())


def _refuse_both(only: str, everything: bool) -> None:
    if only and everything:
        raise InputError("--only and --all contradict each other; give one of them")


def _advised(result: Any, advice: bool | None, progress: Any = None) -> Any:
    """The result with what to change where a check fails, as `AdviceOption` has it."""
    from drivewright.studies.advising import PATIENCE, advise

    return result if advice is False else advise(result, None if advice else PATIENCE, progress)


def _paper_names(incomplete: str) -> list[str]:
    from drivewright.reproduction import NAMES

    return [name for name in NAMES if name.startswith(incomplete)]


def _folder(path: Path, out: Path | None, several: bool = False) -> Path:
    if out is None:
        return Path("out") / path.stem
    return out / path.stem if several else out


@app.command()
def new(
    kind: Annotated[str, typer.Argument(help="kind of drive")],
    file: Annotated[Path | None, typer.Argument(help="file to write; default KIND.toml")] = None,
    preset: Annotated[str | None, typer.Option(help="start from this preset")] = None,
) -> None:
    """Write a commented spec with every key, its unit, default and limits."""
    from drivewright.cli import editors
    from drivewright.spec import template

    path = file or Path(f"{kind}.toml")
    text = template(kind, preset)
    if editors.is_installed(path.parent, kind):
        text = f"{editors.directive(kind)}\n{text}"
    show.refuse_existing(path)
    show.write_text(path, text)
    show.copy_data_files(kind, preset, path)
    presets = ", ".join(registry.mechanism(kind).presets())
    show.note(f"wrote {path} (presets of {kind}: {presets}); next: drivewright run {path}")


@app.command()
def run(
    specs: Annotated[list[Path], typer.Argument(help="spec files")],
    out: OutOption = None,
    set_: SetOption = None,
    only: OnlyOption = "",
    all_: AllOption = False,
    units: UnitsOption = None,
    report: ReportOption = "normal",
    lang: LanguageOption = "en",
    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="draw the figures")] = True,
    solids: Annotated[bool, typer.Option("--solids", help="show the parts as solids in motion in the report, about 0.5 MB more")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="print the result as JSON to stdout")] = False,
    strict: StrictOption = False,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="print all values, checks and findings")] = False,
    advice: AdviceOption = None,
) -> None:
    """Validate, analyse and write a run folder per spec."""
    from drivewright import runner
    from drivewright.execution.helper import compiling_ahead, helping_hand
    from drivewright.report.content import prepare_drawing, views
    from drivewright.report.folder import write_run_folder
    from drivewright.report.form import report_form
    from drivewright.report.letterhead import read_letterhead

    _refuse_both(only, all_)
    form = report_form(report, lang)
    stems = [path.stem for path in specs]
    if len(set(stems)) < len(stems):
        raise InputError("two specs have the same file name and would share a run folder; run them one by one with --out")
    results = []
    for path in specs:
        spec = _load(path, set_, units)
        with show.located(path):
            read_letterhead(spec)  # a wrong logo is refused before anything is computed
        with helping_hand(prepare_drawing, figures) as compute, show.progress(path.name, spec.mechanism) as step, show.located(path):
            with compiling_ahead(spec):
                model = runner.build(spec)
                result = runner.run(spec, _names(only), all_, step, model)
            result = _advised(result, advice, step)
            folder = write_run_folder(result, _folder(path, out, len(specs) > 1), figures, views(result, model, solids), compute, form)
        results.append(result)
        if not as_json:
            show.result(result, verbose)
        show.note(f"report: {folder / 'report.html'}")
    show.finish_run(results, _names(only), as_json, strict)


@app.command()
def compare(
    specs: Annotated[
        list[Path], typer.Argument(help="spec files of one kind; each is compared with the first; one alone with what --set makes of it")
    ],
    out: Annotated[Path | None, typer.Option("--out", help="folder to write; default out/<stem of the first spec>-compared")] = None,
    set_: SetOption = None,
    only: OnlyOption = "",
    units: UnitsOption = None,
    labels: Annotated[str, typer.Option("--labels", help="name of each design, comma separated; the titles unless given")] = "",
    as_json: JsonOption = False,
) -> None:
    """Run designs of one kind and write one page of them."""
    from drivewright import runner
    from drivewright.cli import compared
    from drivewright.cli.records import print_json
    from drivewright.report.comparison import check_count, check_kinds
    from drivewright.report.comparison import compare as side_by_side
    from drivewright.report.comparison_page import refuse_foreign, write_comparison

    changes = [set_] * len(specs)
    if with_itself := len(specs) == 1 and bool(set_):
        specs, changes, labels = specs * 2, [None, set_], labels or f"{specs[0].stem},changed"
    check_count(len(specs))
    loaded = [_load(path, each, units) for path, each in zip(specs, changes, strict=True)]
    check_kinds([spec.mechanism for spec in loaded])
    names, kind = compared.labels_of(specs, loaded, labels), loaded[0].mechanism
    folder = out or Path("out") / f"{specs[0].stem}-compared"
    refuse_foreign(folder)
    runner.select_analyses(registry.mechanism(kind).analyses, _names(only))
    with compared.helped(kind) as compute, show.progress("compare", kind):
        designs = compared.run_designs(specs, loaded, _names(only), compute)
        comparison = side_by_side([result for result, _ in designs], names)
        with show.located(folder):
            write_comparison(comparison, [seen for _, seen in designs], folder, compute)
    show.note(f"wrote {folder}/")
    if as_json:
        print_json(comparison.record())
    else:
        compared.show_comparison(comparison, bool(set_) and not with_itself)
    show.finish_run(comparison.results, _names(only))


@app.command()
def export(
    spec: SpecFile,
    to: Annotated[str, typer.Option("--to", help="formats, comma separated: dxf, svg, csv, step, stl, gcode, pdf")],
    out: OutOption = None,
    set_: SetOption = None,
    units: UnitsOption = None,
    report: ReportOption = "normal",
    lang: LanguageOption = "en",
    advice: AdviceOption = None,
    anyway: Annotated[bool, typer.Option("--anyway", help="manufacturing files also with a failed geometry check")] = False,
    solids: Annotated[bool, typer.Option("--solids", help="show the parts as solids in the PDF report")] = False,
) -> None:
    """Write manufacturing files and the PDF report."""
    from drivewright.report.export import export as write
    from drivewright.report.folder import recover_run_folder
    from drivewright.report.form import report_form

    form = report_form(report, lang)
    loaded = _load(spec, set_, units)
    with show.progress(spec.name, loaded.mechanism) as step, show.located(spec):
        folder = _folder(spec, out)
        recover_run_folder(folder)
        files = write(loaded, _names(to), folder / "cad", anyway, step, form, partial(_advised, advice=advice), solids)
    for file in files:
        print(file)


@app.command()
def sweep(
    spec: Annotated[Path, typer.Argument(help="spec file (TOML), or the folder of a study")],
    vary: Annotated[list[str] | None, typer.Option("--vary", help=VARY_HELP)] = None,
    sample: Annotated[int | None, typer.Option("--sample", help="size of the sample of what has a distribution")] = None,
    method: Annotated[str | None, typer.Option("--method", help=METHOD_HELP)] = None,
    seed: Annotated[int | None, typer.Option("--seed", help="of the sample")] = None,
    points: Annotated[Path | None, typer.Option("--points", help="CSV or Parquet file of cases, a column per key: key [unit]")] = None,
    only: OnlyOption = "",
    all_: AllOption = False,
    values: Annotated[str, typer.Option("--values", help="values and checks (check.NAME) to keep, comma separated; all unless given")] = "",
    out: Annotated[Path | None, typer.Option("--out", help="folder of the study; default out/<stem of the spec>-study")] = None,
    set_: SetOption = None,
    units: UnitsOption = None,
    workers: Annotated[int | None, typer.Option("--workers", help="processes on this machine; default: one per core")] = None,
    on: Annotated[str | None, typer.Option("--on", help="local:N or tcp://HOST:PORT (Dask), or serial")] = None,
    yes: Annotated[bool, typer.Option("--yes", help="also a very large number of cases")] = False,
    retry: Annotated[str | None, typer.Option("--retry", help=RETRY_HELP)] = None,
    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="write the report with its figures")] = True,
    as_json: JsonOption = False,
) -> None:
    """Compute many cases of a spec; the same command again, or with the folder of the study, goes on where it stopped."""
    from drivewright.cli import long_work, records
    from drivewright.report.study import write_answers
    from drivewright.studies.answers import analyse_study
    from drivewright.studies.study_reading import SPEC, is_study
    from drivewright.studies.sweeps import rerun_cases
    from drivewright.studies.sweeps import sweep as compute
    from drivewright.studies.variation import with_options

    _refuse_both(only, all_)
    if is_study(spec):
        spec, out = spec / SPEC, out or spec
    with show.located(spec):
        loaded = with_options(
            _load(spec, set_, units),
            vary or (),
            points,
            samples=sample,
            method=method,
            seed=seed,
            analyses=_names(only) or None,
            every_analysis=all_ or None,
            values=_names(values) or None,
        )
    with long_work.counted(spec.name, loaded.mechanism, "cases", workers, on) as step, show.located(spec):
        folder = out or Path("out") / f"{spec.stem}-study"
        study = compute(loaded, out=folder, workers=workers, on=on, confirmed=yes, progress=step, retry=retry)
        for notice in study.notices:
            show.note(f"note: {notice}")
        show.note(f"{study.folder}: {len(study)} of {len(study.plan)} cases")
        if study.interrupted:
            raise KeyboardInterrupt
        summary = analyse_study(study, rerun=rerun_cases(study)) if figures else None
        if summary:
            show.note(f"wrote {write_answers(study, summary, study.folder or folder)}")
    if as_json:
        records.print_json(records.study_record(study, summary))
    else:
        show.study(study, summary)
    if not study.answered:
        raise typer.Exit(4)


@app.command()
def table(
    study: Annotated[Path, typer.Argument(help="folder of a study")],
    to: Annotated[str, typer.Option("--to", help="formats, comma separated: csv, xlsx, parquet")] = "csv",
    units: UnitsOption = None,
    out: Annotated[Path | None, typer.Option("--out", help="folder to write to; default the study's own")] = None,
) -> None:
    """Write a study's cases as one table; its columns check.NAME are margins to the limits: 0 or more where the check passes."""
    from drivewright.report.tabular import write_study_table
    from drivewright.studies.sweeps import open_study

    opened = open_study(study, skip_damaged=True)
    for notice in opened.notices:
        show.note(f"note: {notice}")
    if not opened.complete:
        show.note(f"note: {len(opened)} of {len(opened.plan)} cases are computed; give the same command again to continue")
    system = show.system_of(opened.spec.units if units is None else units)
    with show.located(study):
        for form in _names(to):
            print(write_study_table(opened, (out or study) / f"table.{form}", system))
    if opened.damaged:
        raise typer.Exit(4)


@app.command()
def optimise(
    spec: SpecFile,
    out: Annotated[Path | None, typer.Option("--out", help="folder of the search; default out/<stem of the spec>-optimised")] = None,
    set_: SetOption = None,
    units: UnitsOption = None,
    workers: Annotated[int | None, typer.Option("--workers", help="processes on this machine; default: one per core")] = None,
    on: Annotated[str | None, typer.Option("--on", help="local:N or tcp://HOST:PORT (Dask), or serial")] = None,
    as_json: JsonOption = False,
) -> None:
    """Optimise the unknowns of the spec's [optimise] table, exit 4 when nothing feasible was found; the same command again goes on."""
    from drivewright.cli import long_work, records
    from drivewright.report.optimised import write_optimised
    from drivewright.studies.optimisation import optimise as search

    loaded = _load(spec, set_, units)
    task = long_work.search_text(loaded.optimise) if loaded.optimise else ""
    with long_work.counted(spec.name, loaded.mechanism, "evaluations", workers, on, task) as step, show.located(spec):
        folder = out or Path("out") / f"{spec.stem}-optimised"
        outcome = search(loaded, out=folder, workers=workers, on=on, progress=step)
        folder = write_optimised(outcome, outcome.folder or folder)
    show.note(f"wrote {folder}/ (best.toml, history.parquet, best/)")
    if as_json:
        records.print_json(records.search_record(outcome))
    else:
        show.optimised(outcome)
    if outcome.interrupted:
        raise KeyboardInterrupt
    if not outcome.feasible:
        raise typer.Exit(4)


@app.command()
def verify(spec: SpecFile, set_: SetOption = None, as_json: JsonOption = False) -> None:
    """Compute the case again on an independent route and print the differences; exit 1 where they are too large, 2 where an extra is
    missing."""
    from drivewright.cli import records
    from drivewright.studies.verification import verify as compare

    with show.located(spec):
        loaded = _load(spec, set_)
        comparison = compare(loaded)
    if as_json:
        records.print_json(records.verification_record(comparison))
    else:
        show.comparison(comparison, loaded.units)
    if not all(row.ok for row in comparison):
        raise typer.Exit(1)
    if any(row.extra for row in comparison):
        raise typer.Exit(2)


@app.command()
def validate(name: Annotated[str | None, typer.Argument(help="a source; default all")] = None, as_json: JsonOption = False) -> None:
    """Published numbers beside ours, with a verdict each; exit 1 when a pinned verdict changes."""
    from drivewright import validation
    from drivewright.cli import records

    sources = validation.sources(name)
    with show.progress("validate") as step:
        rows = validation.rows_of(sources, step)
    changed, verdicts = 0, Counter()
    for source in sources:
        if not as_json:
            show.source(source, rows[source.name])
        changed += sum(row.verdict != row.pinned for row in rows[source.name])
        verdicts.update(row.verdict for row in rows[source.name])
    if as_json:
        records.print_json(records.validation_record(sources, rows))
    else:
        print(", ".join(f"{count} {verdict}" for verdict, count in sorted(verdicts.items())))
    if changed:
        show.note(f"{changed} verdict(s) differ from the pinned ones")
        raise typer.Exit(1)


@app.command()
def reproduce(
    paper: Annotated[str | None, typer.Argument(help="name of a paper, see --list", autocompletion=_paper_names)] = None,
    all_: Annotated[bool, typer.Option("--all", help="every paper, each in a folder of its own")] = False,
    list_: Annotated[bool, typer.Option("--list", help="print the names of the papers and end")] = False,
    out: Annotated[Path | None, typer.Option("--out", help="folder to write; default out/<paper>, with --all out/papers")] = None,
    solids: Annotated[bool, typer.Option("--solids/--no-solids", help="with what needs solid models")] = True,
) -> None:
    """A published paper as a page, figure by figure, printed beside ours; the same command again goes on where it stopped."""
    from drivewright import reproduction
    from drivewright.cli import reproduced

    if list_:
        reproduced.listing()
        return
    if (paper is None) == (not all_):
        raise InputError(f"name one paper ({', '.join(reproduction.NAMES)}), or --all")
    reproduced.write_papers(reproduction.papers(paper), out, all_, solids)


@app.command()
def studio(
    spec: Annotated[Path | None, typer.Argument(help="spec file (TOML) to begin with")] = None,
    host: Annotated[str, typer.Option(help="address to listen at; others than this machine's own require a token")] = "127.0.0.1",
    port: Annotated[int | None, typer.Option(help="port; the first free one from 8123 unless given")] = None,
    token: Annotated[str, typer.Option(help="token for another host; a new one unless given")] = "",
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="open a browser")] = True,
) -> None:
    """The web studio: a design as a form, moving, with its checks and plots."""
    from drivewright.studio.app import serve
    from drivewright.studio.opening import first_design, opened

    with show.located(spec or Path("studio")):
        start = opened(spec) if spec else first_design()
    serve(start, spec.stem if spec else "", host, port, token, browser, show.note)


@app.command()
def examples(
    name: Annotated[str | None, typer.Argument(help="example to copy into this folder")] = None,
    run_: Annotated[str | None, typer.Option("--run", help="'all', or the name of an example to run")] = None,
    gallery_: Annotated[
        bool, typer.Option("--gallery", help="write a page of all examples, with a picture of each, and print its path")
    ] = False,
    out: Annotated[Path, typer.Option("--out", help="folder of the runs, and of the page in gallery/")] = Path("out"),
    as_json: Annotated[bool, typer.Option("--json", help="print the list as JSON to stdout")] = False,
) -> None:
    """List, copy or run the worked examples and studies, or show them on a page."""
    from drivewright.cli import gallery

    if gallery_:
        gallery.show_gallery(out, name or run_)
        return

    known, studies = gallery.examples(), gallery.studies()
    for chosen in (name, run_ if run_ != "all" else None):
        if chosen is not None and chosen not in known | studies:
            raise UnknownName("example", chosen, known | studies)
    if run_ in studies:
        gallery.run_study(studies[run_], out / run_)
    elif run_:
        gallery.run_examples(known if run_ == "all" else {run_: known[run_]}, out)
    elif name:
        show.note("wrote " + ", ".join(str(path) for path in gallery.copy((known | studies)[name], Path("."))))
    else:
        gallery.listing(as_json)


@app.command()
def schema(
    kind: Annotated[str | None, typer.Argument(help="kind of drive; with --install every kind unless given")] = None,
    install: Annotated[bool, typer.Option("--install", help="set a folder up for editors instead: schemas and associations")] = False,
    out: Annotated[Path, typer.Option("--out", help="folder that --install sets up")] = Path("."),
) -> None:
    """The JSON schema of a kind's spec files; --install makes editors check and complete the specs of a folder, exit 1 where a file
    of yours is left alone."""
    from drivewright.cli import editors
    from drivewright.spec import schema as json_schema

    if not install:
        if kind is None:
            raise InputError(f"name a kind of drive ({', '.join(registry.kinds())}), or --install")
        print(json.dumps(json_schema(kind), indent=1))
        return
    kinds = [registry.mechanism(kind).kind] if kind else list(registry.kinds())
    with show.located(out):
        in_place = editors.install(out, kinds)
    if not in_place:
        raise typer.Exit(1)


@app.command()
def doctor(warm: Annotated[bool, typer.Option("--warm", help="compile every kernel now")] = False, as_json: JsonOption = False) -> None:
    """What is installed, what each extra adds, the state of the cache, a self-test."""
    from drivewright.cli import doctor as doctor_report

    if not doctor_report.report(warm, as_json):
        raise typer.Exit(1)


@app.callback(invoke_without_command=True)
def _root(
    version: Annotated[bool, typer.Option("--version", help="print the version")] = False,
    debug: Annotated[bool, typer.Option("--debug", help="show the traceback of an analysis that fails by a fault of the program")] = False,
) -> None:
    if debug:
        os.environ[DEBUG] = "1"  # of the processes that a study starts, too
    if version:
        from drivewright import __version__

        print(__version__)
        raise typer.Exit
