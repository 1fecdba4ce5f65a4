"""A case run in this process, and what is wrong with the answer."""

import contextlib
import io
import json
import math
import os
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright import cli, runner
from drivewright.errors import DrivewrightError, InputError, SolverError, SpecError
from drivewright.spec import load

from .bases import bases
from .cases import SPEC, Case, write_case

REPEATED = 0.5  # seconds that a case may take that is run twice, for the same message
CODES = {0, 2, 3, 4}
MEMORY = "needs more memory than there is"


class Answer(NamedTuple):
    """What came of a case: an exit code, what was printed, what is wrong with that, and how long it took."""

    code: int | None
    out: str
    err: str
    wrong: list[str]
    seconds: float = 0.0


def warm(number: int) -> None:
    """The undamaged spec of a case run once, so that its kernels are there: compiling counts for no case."""
    base = bases()[number % len(bases())]
    if base.path in _WARM:
        return
    _WARM.add(base.path)
    from .bases import CHEAP

    with _quiet():
        runner.run(load(base.path), CHEAP.get(base.kind, ()))


_WARM: set[Path] = set()


def answer_of(case: Case) -> Answer:
    """The answer to a case, in a folder of its own; a quick one is asked for twice and must be the same."""
    with tempfile.TemporaryDirectory() as place, contextlib.chdir(place), _quiet(), _faults() as faults:
        write_case(case, Path(place))
        started = time.perf_counter()
        answer = _entered(case)
        seconds = time.perf_counter() - started
        wrong = [*answer.wrong, *faults]
        if not wrong and seconds < REPEATED and answer.code not in (0, 4):
            again = _entered(case)
            wrong += [] if (again.code, again.err) == (answer.code, answer.err) else [f"another message: {answer.err!r}, {again.err!r}"]
    return answer._replace(wrong=wrong, seconds=round(seconds, 3))


@contextlib.contextmanager
def _quiet():
    """As for a user: numbers leave their range without an exception, and nobody reads warnings."""
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


@contextlib.contextmanager
def _faults():
    """What went wrong in analyses by a fault of the program, which a run keeps as a finding."""
    found, usual = [], runner._program_fault

    def note(spec, error):
        found.append(_trace(error))
        return usual(spec, error)

    runner._program_fault = note
    try:
        yield found
    finally:
        runner._program_fault = usual


def _trace(error):
    """An exception with the place in our code where it came from."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if "drivewright" in frame.filename]
    place = " < ".join(f"{Path(frame.filename).name}:{frame.lineno} {frame.name}" for frame in frames[:-4:-1])
    return f"{type(error).__name__}: {str(error)[:200]} at {place}"


def _entered(case):
    if case.entry == "command":
        return _commanded(case)
    try:
        spec = load(SPEC)
    except SpecError as error:
        return Answer(2, "", str(error), [] if error.file else ["refused without the file's name"])
    except Exception as error:
        return Answer(None, "", "", [_trace(error)])
    return _written(spec) if case.entry == "load" else _run(spec, case.only)


def _written(spec):
    """A spec that is accepted reads back from what it writes."""
    try:
        Path("again.toml").write_text(spec.to_toml(), encoding="utf-8", newline="\n")
        again = load("again.toml")
        same = again == spec and again.digest() == spec.digest()
        return Answer(0, "", "", [] if same else ["reads back as another spec"])
    except SpecError as error:
        refused = error.args[0].startswith("data file")
        return Answer(2 if refused else None, "", str(error), [] if refused else [f"does not read back: {error}"])
    except Exception as error:
        return Answer(None, "", "", [_trace(error)])


def _run(spec, only):
    try:
        model = runner.build(spec)
        result = runner.run(spec, only, model=model)
        text = json.dumps(result.record(), allow_nan=False)
    except (InputError, SolverError) as error:
        return Answer(error.exit_code, "", str(error), [] if len(str(error)) > 15 else [f"says too little: {error}"])
    except Exception as error:
        return Answer(None, "", "", [_trace(error)])
    wrong = [finding for finding in result.findings if MEMORY in finding]
    return Answer(4 if result.outcome == "partial" else 0, text, "\n".join(result.findings), wrong)


def _commanded(case):
    """The command line in this process, its output caught as a pipe would."""
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", errors=errors) for errors in ("strict", "backslashreplace"))
    usual = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = out, err
    code, wrong = None, []
    try:
        cli.main(list(case.arguments))
    except SystemExit as left:
        code = left.code if isinstance(left.code, int) else 0 if left.code is None else 1
    except DrivewrightError as error:
        wrong = [f"not caught: {error}"]
    except BaseException as error:
        wrong = [_trace(error)]
    finally:
        sys.stdout, sys.stderr = usual
    printed, said = (stream.detach().getvalue().decode("utf-8", "replace") if not stream.flush() else "" for stream in (out, err))
    return Answer(code, printed, said, [*wrong, *_wrong_output(case, code, printed, said)])


def _wrong_output(case, code, printed, said):
    if code not in CODES:
        yield f"exit code {code}: {said[-200:]}"
    if "Traceback" in said or "Traceback" in printed:
        yield "a traceback"
    if MEMORY in said:
        yield said
    if code == 2 and len(said.strip()) < 15:
        yield f"says too little: {said!r}"
    if code == 2 and printed:
        yield "prints something to stdout and refuses"
    if code in (0, 4) and "--json" in case.arguments:
        yield from _wrong_numbers(json.loads(printed, parse_constant=_Constant)) if printed else ["no JSON"]
    for file in Path("out").rglob("result.json") if os.path.isdir("out") else ():
        yield from _wrong_numbers(json.loads(file.read_text(encoding="utf-8"), parse_constant=_Constant))


class _Constant(float):
    """NaN or an infinity in a JSON file, where none may be."""

    def __new__(cls, text):
        return super().__new__(cls, math.nan)


def _wrong_numbers(record):
    inside = record.values() if isinstance(record, dict) else record if isinstance(record, list) else ()
    if isinstance(record, float) and not math.isfinite(record):
        yield "a number in the record is not finite"
    for value in inside:
        yield from _wrong_numbers(value)
