"""The worked examples: listed, copied, run.  They are packed into the wheel; in a checkout they lie beside the sources."""

import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from drivewright import registry, runner
from drivewright.cli import show
from drivewright.errors import DrivewrightError
from drivewright.result import Result
from drivewright.spec import load, read_document

PACKED = Path(__file__).parent.parent / "examples"
CHECKOUT = Path(__file__).parents[3] / "examples"


def examples() -> dict[str, Path]:
    """Name -> path of every example spec."""
    return {path.stem: path for path in sorted(_folder().glob("*.toml"))}


def studies() -> dict[str, Path]:
    """Name -> path of every worked study: specs with a [study] table, for `sweep`."""
    return {path.stem: path for path in sorted((_folder() / "studies").glob("*.toml"))}


def _folder() -> Path:
    return PACKED if PACKED.is_dir() else CHECKOUT


def listing() -> None:
    """Print name, kind and title of each."""
    for title, known in (
        ("worked examples (drivewright examples NAME copies one, --run NAME runs it)", examples()),
        ("worked studies (the same; a copy is run by drivewright sweep)", studies()),
    ):
        data = {name: read_document(path) for name, path in known.items()}
        rows = [(name, tables.get("mechanism", ""), tables.get("title", "")) for name, tables in data.items()]
        show.table(title, (("name", "left"), ("kind", "left"), ("what it shows", "left")), rows)


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
    from drivewright.studies.sweeps import sweep

    with show.progress(path.stem) as step:
        study = sweep(load(path), out=out, progress=step)
    if study.interrupted:
        raise KeyboardInterrupt
    summary = analyse_study(study)
    show.note(f"wrote {write_answers(study, summary, study.folder or out)}")
    show.study(study, summary)


def run_examples(chosen: Mapping[str, Path], out: Path) -> None:
    """Run examples, print their key numbers, write out/index.html; a failed design check is part of the show."""
    from drivewright.report.content import views
    from drivewright.report.folder import write_run_folder
    from drivewright.report.index import write_index

    folders = []
    for number, (name, path) in enumerate(chosen.items(), 1):
        started = time.perf_counter()
        show.note(f"[{number}/{len(chosen)}] {name} ...")
        try:
            spec = load(path)
            with show.progress(name, spec.mechanism) as step:
                model = runner.build(spec)
                result = runner.run(spec, progress=step, model=model)
                folders.append(write_run_folder(result, out / name, seen=views(result, model)))
        except DrivewrightError as error:
            show.note(f"    {error}")
            raise
        _print(result, time.perf_counter() - started)
    show.note(f"wrote {write_index(folders, out / 'index.html')}: open it in a browser")


def _print(result: Result[Any], seconds: float) -> None:
    """Key numbers of one run, on stdout."""
    failed = [check for check in result.checks if not check.ok]
    print(f"\n{result.title}   ({seconds:.1f} s)")
    for name in registry.headlines(registry.mechanism(result.mechanism), result.values)[:6]:
        value = result.values[name]
        print(f"  {name:40s} {show.number(value.value, value.unit, value.low, value.high):>14s}   {value.meaning}")
    for check in failed:
        print(
            f"  check fails: {check.name} = {show.number(check.value, check.unit)}, "
            f"limit {check.sense} {show.number(check.limit, check.unit)}"
        )
    if result.checks and not failed:
        print(f"  all {len(result.checks)} checks pass")
