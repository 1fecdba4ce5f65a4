"""The worked examples: listed, copied, run.  They are packed into the wheel; in a checkout they lie beside the sources."""

import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from drivewright import registry, runner
from drivewright._jit.compilation import seconds_of_a_first_run
from drivewright.cli import show
from drivewright.cli.records import print_json
from drivewright.errors import InputError
from drivewright.report.worked_examples import examples, studies
from drivewright.result import Result
from drivewright.spec import load, read_document


def listing(as_json: bool = False) -> None:
    """Print name, kind and title of each."""
    if as_json:
        print_json(_records())
        return
    for title, known in (
        ("worked examples (drivewright examples NAME copies one, --run NAME runs it)", examples()),
        ("worked studies (the same; a copy is run by drivewright sweep)", studies()),
    ):
        data = {name: read_document(path) for name, path in known.items()}
        rows = [(name, tables.get("mechanism", ""), tables.get("title", "")) for name, tables in data.items()]
        show.table(title, (("name", "left"), ("kind", "left"), ("what it shows", "left")), rows)


def show_gallery(out: Path, other: str | None) -> None:
    """Write the gallery page below `out` and print its path; `other` is an example that was named as well, which is refused."""
    from drivewright.report.gallery import write_gallery

    if other is not None:
        raise InputError("--gallery shows every example; leave the name and --run out")
    print(write_gallery(out / "gallery" / "index.html"))


def _records() -> list[dict[str, Any]]:
    """Name, kind, title and path of every example and study."""
    known = [(path, False) for path in examples().values()] + [(path, True) for path in studies().values()]
    tables = [(path, is_study, read_document(path)) for path, is_study in known]
    return [
        {"name": path.stem, "mechanism": each.get("mechanism", ""), "title": each.get("title", ""), "study": is_study, "path": str(path)}
        for path, is_study, each in tables
    ]


def copy(path: Path, folder: Path) -> list[Path]:
    """Copy an example and the data files it names; nothing is written over."""
    sources = [path, *load(path).data_files()]
    targets = [folder / source.name for source in sources]
    for target in targets:
        show.refuse_existing(target)
    for source, target in zip(sources, targets, strict=True):
        show.copy_file(source, target)
    return targets


def run_study(path: Path, out: Path) -> None:
    """Run a worked study and write its folder with the report."""
    from drivewright.report.study import write_answers
    from drivewright.studies.answers import analyse_study
    from drivewright.studies.sweeps import rerun_cases, sweep

    with show.progress(path.stem) as step:
        study = sweep(load(path), out=out, progress=step)
    if study.interrupted:
        raise KeyboardInterrupt
    summary = analyse_study(study, rerun=rerun_cases(study))
    show.note(f"wrote {write_answers(study, summary, study.folder or out)}")
    show.study(study, summary)


def run_examples(chosen: Mapping[str, Path], out: Path) -> None:
    """Run examples, print their key numbers, write out/index.html; a failed design check is part of the show.

    Side by side, those of one kind one after another, for the first compiles what the next ones need; kinds that compile little come first.
    """
    from drivewright.execution.executors import side_by_side
    from drivewright.report.index import write_index

    kinds = {name: read_document(path)["mechanism"] for name, path in chosen.items()}
    names = sorted(chosen, key=lambda name: (seconds_of_a_first_run(kinds[name]), name))
    folders = {}

    def begun(index: int) -> None:
        show.note(f"[{index + 1}/{len(names)}] {names[index]} ...")

    calls = [(chosen[name], out / name) for name in names]
    groups = [kinds[name] for name in names]
    done = side_by_side(_run_example, calls, groups, begun) if len(calls) > 1 else enumerate(_run_example(*call) for call in calls)
    for index, (folder, words) in done:
        print(words)
        folders[names[index]] = folder
    show.note(f"wrote {write_index([folders[name] for name in chosen], out / 'index.html')}: open it in a browser")


def _run_example(path: Path, out: Path) -> tuple[Path, str]:
    """(run folder, what to print) of one example."""
    from drivewright.report.content import views
    from drivewright.report.folder import write_run_folder

    started = time.perf_counter()
    with show.located(path):
        spec = load(path)
        with show.compiling(spec.mechanism):
            model = runner.build(spec)
            result = runner.run(spec, model=model)
            folder = write_run_folder(result, out, seen=views(result, model))
    return folder, "\n".join(_key_numbers(result, time.perf_counter() - started))


def _key_numbers(result: Result[Any], seconds: float) -> Iterator[str]:
    from drivewright.report.content import verdict_of

    failed = [check for check in result.checks if not check.ok]
    yield f"\n{result.title}   ({seconds:.1f} s)"
    for name in registry.key_values(registry.mechanism(result.mechanism), result.values, 6):
        yield f"  {show.label_text(result.values[name]):40s} {show.value_text(result, name):>14s}"
    for check in failed:
        value, limit, _ = show.check_numbers(check, result.units)
        yield f"  check fails: {check.display_label} {value}, limit {limit}"
    if result.checks and not failed:
        yield f"  {verdict_of(result)['text']}"
    yield from (f"  warning: {warning}" for warning in result.warnings)
