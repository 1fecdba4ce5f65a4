"""Scenarios for `file_faults`: what is done, what must be true after it was cut off, and after the same was given again.

Run as a script: SCENARIO FOLDER FAULT [STEP]; prints how often the fault was tried.
"""

import contextlib
import errno
import importlib
import io
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple
from unittest import mock

from file_faults import FULL, KILL, KILLED, ONCE, TORN, Counter, in_fork, operations

SUPPORT = Path(__file__).parents[1] / "support"
sys.path.insert(0, str(SUPPORT))
BAD_INPUT = 2  # exit code of a disk that is full


class Scenario(NamedTuple):
    """`prepare(place)` once; then, in a copy of the place, `act(place)`, which returns an exit code, is cut off, `cut(place)` checks what
    is left, and `whole(place)` what is there after another `act`."""

    prepare: Callable[[Path], object]
    act: Callable[[Path], object]
    cut: Callable[[Path], object]
    whole: Callable[[Path], object]


class Fault(NamedTuple):
    """What happens at an operation: the end of the process, or an error number that it gives."""

    mode: int
    error: int = 0


def fail_everywhere(scenario: Scenario, place: Path, fault: Fault, step: int = 1) -> int:
    """A fault at every operation (every `step`-th), then the same without; how often."""
    template = _prepared(scenario, place)
    total, tried = _count(scenario, place, template), 0
    for number in range(1, total + 1, step):
        work = place / "work"
        shutil.copytree(template, work, symlinks=True)
        with _told(work, fault, number):
            found = _cut_off(scenario, work, fault, number)
            if found == 0 and not fault.error and number > total / 2:  # timing decides how many parts there are, and here they are fewer
                break
            assert found in ((BAD_INPUT, 0) if fault.error else (KILLED,)), f"exit code {found}"
            tried += 1
            scenario.cut(work)
            _again(scenario, work)
        shutil.rmtree(work)
    return tried


def kill_twice(scenario: Scenario, place: Path, step: int = 1) -> int:
    """Kill at every operation, kill the next start at every operation of its own, then do it again without; how many pairs."""
    template, pairs = _prepared(scenario, place), 0
    total = _count(scenario, place, template)
    for first in range(1, total + 1, step):
        base = place / "base"
        shutil.copytree(template, base, symlinks=True)
        found = _cut_off(scenario, base, FAULTS["kill"], first)
        if found == 0 and first > total / 2:  # as above
            break
        assert found == KILLED, f"exit code {found}"
        second, code = 1, KILLED
        while code == KILLED:
            work = place / "work"
            shutil.copytree(base, work, symlinks=True)
            with _told(work, FAULTS["kill"], first, second):
                code = _cut_off(scenario, work, FAULTS["kill"], second)
                assert code in (KILLED, 0), f"exit code {code}"
                scenario.cut(work)
                _again(scenario, work)
            shutil.rmtree(work)
            second, pairs = second + step, pairs + 1
        shutil.rmtree(base)
    return pairs


def _again(scenario, work):
    code = in_fork(lambda: scenario.act(work))
    assert code == 0, f"exit code {code} of the next start"
    scenario.whole(work)


@contextlib.contextmanager
def _told(work, fault, *numbers):
    """Where an assertion fails, say at which operations."""
    try:
        yield
    except AssertionError as error:
        left = sorted(str(path.relative_to(work)) for path in work.rglob("*"))
        error.add_note(f"{fault} at operation {numbers}; it left {left}")
        raise


def _prepared(scenario, place):
    template = place / "template"
    template.mkdir(parents=True)
    assert in_fork(lambda: scenario.prepare(template)) == 0
    return template


def _import_beforehand(names):
    """Load what a fork had to load, so that the next one has it."""
    for name in names.read_text().split():
        if not name.endswith("__main__"):
            with contextlib.suppress(Exception):
                importlib.import_module(name)


def _count(scenario, place, template):
    work = place / "work"
    shutil.copytree(template, work, symlinks=True)

    def act():
        code = scenario.act(work)
        (place / "modules.txt").write_text("\n".join(sys.modules))
        return code

    total = operations(Counter(work), act)
    _import_beforehand(place / "modules.txt")
    scenario.whole(work)
    shutil.rmtree(work)
    return total


def _cut_off(scenario, work, fault, number):
    counter = Counter(work)

    def act():
        counter.arm(fault.mode, number, fault.error)
        return scenario.act(work)

    return in_fork(act)


def command(*arguments: object) -> int:
    """Exit code of the command line, in one process, whose operations are counted; what it says is shown where it is not expected."""
    from drivewright.cli import main

    said, alone = io.StringIO(), mock.patch("drivewright.execution.helper.worker_count", lambda workers: 1)
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), alone:
        try:
            main([str(each) for each in arguments])
        except SystemExit as end:
            code = end.code or 0
    if code not in (0, BAD_INPUT):
        print(said.getvalue(), file=sys.stderr)
    return code


# -- a run folder with files of a person in it ---------------------------------------------------------------------------------

USERS = {"notes.txt": "mine", "cad/part.dxf": "a drawing", "photos/a/b.jpg": "a picture"}


def _result(title):
    from sample_designs import four_bar_result

    return four_bar_result(title)


def _write(place, title):
    from sample_designs import four_bar_scene

    from drivewright.cli import show
    from drivewright.errors import InputError
    from drivewright.report.content import Views
    from drivewright.report.folder import write_run_folder

    try:
        with show.located(place):
            write_run_folder(_result(title), place / "run", figures=False, seen=Views(four_bar_scene()))
    except InputError:
        return BAD_INPUT
    return 0


def _first_run(place):
    _write(place, "first")
    for name, text in USERS.items():
        (place / "run" / name).parent.mkdir(parents=True, exist_ok=True)
        (place / "run" / name).write_text(text)


def _title(place):
    import json

    return json.loads((place / "run" / "result.json").read_text())["title"]


def _users_files_are_somewhere(place):
    texts = {file.read_bytes() for file in place.rglob("*") if file.is_file() and file.stat().st_size < 100}
    assert {text.encode() for text in USERS.values()} <= texts


def _there_is_a_run(place):
    assert _title(place) in ("first", "second") and (place / "run" / "report.html").stat().st_size > 1000
    _users_files_are_somewhere(place)


def _second_run_is_whole(place):
    assert [path.name for path in place.iterdir()] == ["run"] and _title(place) == "second"
    assert {name: (place / "run" / name).read_text() for name in USERS} == USERS
    assert not [path for path in place.rglob("*") if "recovered" in path.name]


def _without_exchange(place):
    from drivewright.report import renames

    renames._renameat2 = lambda: None
    return _write(place, "second")


# -- a study of a toy ----------------------------------------------------------------------------------------------------------

SPEC = 'mechanism = "toy"\n[study]\nmethod = "one-at-a-time"\n[[study.vary]]\nkey = "size"\nvalues = [{sizes}]\n'
SIZES = ", ".join(f'"{n} mm"' for n in range(1, 12))
SEARCH = """mechanism = "toy"
[optimise]
population = 8
generations = 2
unknowns = [{key = "size", lower = "1 mm", upper = "9 mm"}]
objectives = [{value = "area"}]
"""


def _sweep(place):
    return command("sweep", place / "toy.toml", "--out", place / "S", "--on", "serial", "--no-figures")


def _spec(place):
    (place / "toy.toml").write_text(SPEC.format(sizes=SIZES))


def _whole_study(place):
    from pyarrow import parquet

    _spec(place)
    assert _sweep(place) == 0
    parquet.write_table(_open(place).table, place / "reference.parquet")


def _new_study(place):
    _whole_study(place)
    shutil.rmtree(place / "S")


def _without_ledger(place):
    _whole_study(place)
    (place / "S" / "ledger.sqlite").unlink()


def _with_damaged_ledger(place):
    _whole_study(place)
    ledger = place / "S" / "ledger.sqlite"
    ledger.write_bytes(b"\0" * 4096 + ledger.read_bytes()[4096:])


def _with_damaged_part(place):
    _whole_study(place)
    part = sorted((place / "S" / "parts").iterdir())[-1]
    content = bytearray(part.read_bytes())
    content[len(content) // 2] ^= 1
    part.write_bytes(content)


def _of_a_search(place):
    (place / "toy.toml").write_text(SEARCH)


def _open(place):
    from drivewright.studies.sweeps import open_study

    return open_study(place / "S", skip_damaged=True)


def _reference(place):
    from pyarrow import parquet

    return parquet.read_table(place / "reference.parquet")


def _rows_are_those_of_the_reference(place):
    """Or there is no study, or none that can be read, yet."""
    from drivewright.errors import InputError

    try:
        rows = _open(place).table
    except InputError:
        return
    assert rows.num_rows == 0 or rows.equals(_reference(place).take(rows["case"]))


def _study_is_whole(place):
    study = _open(place)
    assert study.complete and not study.damaged and study.table.equals(_reference(place))
    assert all(path.suffix == ".parquet" and path.name[0] != "." for path in (place / "S" / "parts").iterdir())


def _optimise(place):
    return command("optimise", place / "toy.toml", "--out", place / "S", "--on", "serial")


def _search_is_whole(place):
    import tomllib

    from pyarrow import parquet

    found = tomllib.loads((place / "S" / "best.toml").read_text())
    assert found["size"].startswith("1") and parquet.read_table(place / "S" / "history.parquet").num_rows > 4
    assert (place / "S" / "best" / "result.json").is_file() and not list((place / "S").glob("best.tmp*"))


def _answers(place):
    return command("sweep", place / "toy.toml", "--out", place / "S", "--on", "serial")


def _answers_are_whole(place):
    _study_is_whole(place)
    assert (place / "S" / "report.html").stat().st_size > 1000 and not list((place / "S").rglob("*.tmp*"))


def _tables(place):
    return command("table", place / "S", "--to", "csv,parquet,xlsx")


def _tables_are_whole(place):
    from pyarrow import parquet

    assert parquet.read_table(place / "S" / "table.parquet").num_rows == 11
    assert (place / "S" / "table.csv").read_text().count("\n") == 12 and not list((place / "S").rglob("*.tmp*"))


# -- commands of a cam ---------------------------------------------------------------------------------------------------------

CAM = Path(__file__).parents[2] / "examples" / "oscillating_cam.toml"  # it has a data file


def _run_cam(place):
    return command("run", CAM, "--only", "profile", "--out", place / "run")


def _first_cam(place):
    assert _run_cam(place) == 0
    (place / "run" / "notes.txt").write_text("mine")


def _cam_is_whole(place):
    import drivewright as dw

    assert [path.name for path in place.iterdir()] == ["run"] and (place / "run" / "notes.txt").read_text() == "mine"
    assert dw.load(place / "run" / "spec.toml").digest() == dw.load(CAM).digest()
    assert (place / "run" / "report.html").is_file() and list((place / "run" / "figures").iterdir())


def _notes_are_somewhere(place):
    assert [file.read_text() for file in place.rglob("notes.txt")] == ["mine"]


def _export(place):
    return command("export", CAM, "--to", "dxf,svg,csv,stl", "--out", place / "run", "--anyway")


def _export_is_whole(place):
    _exported(place, {".dxf", ".svg", ".csv", ".stl"})


def _exported(place, suffixes):
    files = list((place / "run" / "cad").iterdir())
    assert {file.suffix for file in files} == suffixes
    assert not [file for file in files if file.name.startswith(".")]


def _export_for_the_shop(place):
    """Files that other libraries write: a solid, the passes of a cutter, the report on paper."""
    return command("export", CAM, "--to", "step,gcode,pdf", "--out", place / "run", "--anyway")


def _export_for_the_shop_is_whole(place):
    _exported(place, {".step", ".nc", ".pdf"})
    assert (place / "run" / "cad" / "report.pdf").read_bytes().rstrip().endswith(b"%%EOF")


SCENARIOS = {
    "run-folder": Scenario(_first_run, lambda place: _write(place, "second"), _there_is_a_run, _second_run_is_whole),
    "run-folder-by-two-renames": Scenario(_first_run, _without_exchange, _users_files_are_somewhere, _second_run_is_whole),
    "sweep": Scenario(_new_study, _sweep, _rows_are_those_of_the_reference, _study_is_whole),
    "sweep-without-ledger": Scenario(_without_ledger, _sweep, _rows_are_those_of_the_reference, _study_is_whole),
    "sweep-with-damaged-ledger": Scenario(_with_damaged_ledger, _sweep, _rows_are_those_of_the_reference, _study_is_whole),
    "sweep-with-damaged-part": Scenario(_with_damaged_part, _sweep, _rows_are_those_of_the_reference, _study_is_whole),
    "optimise": Scenario(_of_a_search, _optimise, lambda place: None, _search_is_whole),
    "answers": Scenario(_whole_study, _answers, _rows_are_those_of_the_reference, _answers_are_whole),
    "table": Scenario(_whole_study, _tables, _study_is_whole, _tables_are_whole),
    "run": Scenario(_first_cam, _run_cam, _notes_are_somewhere, _cam_is_whole),
    "export": Scenario(_first_cam, _export, _notes_are_somewhere, _export_is_whole),
    "export-for-the-shop": Scenario(_first_cam, _export_for_the_shop, _notes_are_somewhere, _export_for_the_shop_is_whole),
}
FAULTS = {
    "kill": Fault(KILL),
    "torn": Fault(TORN),
    "full": Fault(FULL, errno.ENOSPC),
    "read-only": Fault(FULL, errno.EROFS),
    "once": Fault(ONCE, errno.EIO),
}


def main(name: str, folder: str, fault: str, step: str = "1") -> None:
    """Try a fault everywhere in a scenario; "kill-twice" in two starts after one another."""
    import study_toy

    study_toy.install()
    scenario, place = SCENARIOS[name], Path(folder)
    if fault == "kill-twice":
        print(kill_twice(scenario, place, int(step)))
    else:
        print(fail_everywhere(scenario, place, FAULTS[fault], int(step)))


if __name__ == "__main__":
    main(*sys.argv[1:])
