"""Results of long runs in a folder of the server, so that the figures and the solids of one design share one run.

Only the server's own processes write there and read it again.
"""

import pickle
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from drivewright import runner
from drivewright.atomic import replacing
from drivewright.result import Result
from drivewright.runner import Progress
from drivewright.spec import MechanismSpec

MOST = 12  # results in a folder; the oldest goes


def kept_result(folder: Path | None, digest: str, analyses: Sequence[str]) -> Result[Any] | None:
    """The newest result of a spec's `digest` that holds all the analyses, None where there is none."""
    for path in reversed(_by_age(folder, f"{digest}-*.pickle")):
        with suppress(FileNotFoundError), path.open("rb") as file:  # another process may have removed it
            if set(analyses) <= set(pickle.load(file)):
                return pickle.load(file)
    return None


def keep_result(folder: Path, result: Result[Any]) -> None:
    """Write a result into the folder."""
    done = tuple(result.provenance["analyses"])
    number = 1 + max((int(path.stem.rpartition("-")[2]) for path in folder.glob("*.pickle")), default=0)
    with replacing(folder / f"{result.digest}-{number}.pickle") as fresh:
        fresh.write_bytes(pickle.dumps(done) + pickle.dumps(result))
    for path in _by_age(folder, "*.pickle")[:-MOST]:
        path.unlink(missing_ok=True)


def result_of(spec: MechanismSpec, analyses: Sequence[str], folder: Path | None, progress: Progress, model: Any) -> Result[Any]:
    """A result that holds the analyses, and what they need: a kept one, else of a run, which is kept where there is a folder."""
    found = kept_result(folder, spec.digest(), analyses)
    if found is None:
        found = runner.run(spec, tuple(analyses), False, progress, model)
        if folder is not None:
            keep_result(folder, found)
    return found


def _by_age(folder: Path | None, pattern: str) -> list[Path]:
    return sorted(folder.glob(pattern), key=lambda path: int(path.stem.rpartition("-")[2])) if folder is not None else []
