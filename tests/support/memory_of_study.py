"""The memory that a study of a cheap drive takes, step by step, in a process of its own: `python memory_of_study.py CASES FOLDER METHOD`.

Prints a line `step peak` for each step, the peak of the resident memory up to its end [MB].
"""

import resource
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from study_toy import TOY, Toy, exact, install

import drivewright as dw
from drivewright.report.study import write_answers
from drivewright.report.tabular import write_study_table
from drivewright.studies.answers import analyse_study
from drivewright.studies.variation import linspace, normal, uniform, with_variation

RANDOM = {"size": uniform("8 mm", "13 mm"), "ratio": normal(0.25, 0.05)}


def spec_of(cases, method):
    """So many cases of the toy: a grid, or a sample by some method."""
    if method == "grid":
        side = round(cases**0.5)
        return with_variation(Toy(), {"size": linspace("8 mm", "13 mm", side), "ratio": linspace(0.1, 0.9, side)})
    return with_variation(Toy(), RANDOM, method=method, samples=cases)


def told(step):
    print(step, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024, flush=True)


def main(cases, folder, method):
    install(setattr, replace(TOY, batch=exact))
    folder, spec = Path(folder), spec_of(cases, method)
    told("start")
    study = dw.sweep(spec, out=folder, on="serial")
    told("sweep")
    study = dw.sweep(spec, out=folder, on="serial")
    told("again")
    assert study.complete and np.isfinite(next(iter(study.batches(["area"])))["area"].to_numpy()).all()
    write_answers(study, analyse_study(study), folder)
    told("report")
    for form in ("csv", "parquet"):
        write_study_table(study, folder / f"table.{form}")
        told(form)


if __name__ == "__main__":
    main(int(float(sys.argv[1])), sys.argv[2], sys.argv[3])
