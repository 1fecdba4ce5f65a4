"""Work that takes a while: each job is `name(design, progress, **options) -> answer`, called in a worker process.

`progress(done, total, text, partial=None)` says how far it is; `partial` is a preview of the answer.  An answer is plain data for JSON
without nan, or {"files": [{"name", "data": bytes}]}.  Our own errors go up to whoever asked, who shows their words.  A job
may start processes of its own, so the process that it runs in must be no daemon.

design_keys  the keys of a design as jobs see them
fields       fields of an analysis on the deformed solids
figures      figures for the page
fix          the smallest change of a dimension or two with which a failed check passes
other_part   another bought part with which a failed check passes
reach        the changes of one dimension with which a value is as wanted
search       the [optimise] of a design: a search for its best, told while it goes on
sensitivity  which key moves which number: every key of a design a little down and up, one at a time
solid        the assembly as triangles for a viewer
study        the [study] of a design: its cases as rows of a table, and what they say
trade_off    the designs of a search as a table like that of a study
timing       the seconds of each analysis, for an estimate
"""

from typing import Any

from drivewright.errors import InputError, brief
from drivewright.studio.jobs import fields, figures, files, fix, reach, search, sensitivity, solid, study, timing

# What a page may ask for: nothing that names a place on the disk, another machine, or how much of this one to take.
JOBS = {
    "sensitivity": sensitivity.sensitivity,
    "fix": fix.fix,
    "reach": reach.reach_value,
    "timing": timing.timing,
    "study": study.study,
    "optimise": search.optimise,
    "solid": solid.solid,
    "fields": fields.fields,
    "figures": figures.figures,
    "export": files.export,
    "report": files.report,
    "save": files.save,
}
MOST, LONGEST = 100, 500  # texts in an option, and characters in one
OPTIONS: dict[str, dict[str, type]] = {
    "fix": {"check": str, "longer": bool},
    "reach": {"value": str, "target": str, "longer": bool},
    "figures": {"theme": str, "analyses": list},
    "fields": {"analysis": str, "run": bool},
    "study": {"theme": str},
    "optimise": {"theme": str},
    "export": {"format": str, "anyway": bool},
    "report": {"whole": bool, "solids": bool, "language": str},
}


def checked_options(name: object, options: object = None) -> dict[str, Any]:
    """The options of a job that a page asks for; InputError where there is no such job, or it takes no such option or value."""
    if not isinstance(name, str) or name not in JOBS:
        raise InputError(f"there is no job {brief(name)}")
    if not isinstance(options, dict | None):
        raise InputError(f"{name} has no options in a list or a value")
    for option, value in (options or {}).items():
        wanted = OPTIONS.get(name, {}).get(option)
        if wanted is None:
            raise InputError(f"{name} takes no {brief(option)}")
        if not isinstance(value, wanted) or not _is_short(value):
            raise InputError(f"{name} cannot have {brief(value)} as {option}")
    return dict(options or {})


def _is_short(value: object) -> bool:
    """Whether a value of an option has a length that a page sends; a list holds texts only."""
    if isinstance(value, list):
        return len(value) <= MOST and all(isinstance(each, str) and len(each) <= LONGEST for each in value)
    return not isinstance(value, str) or len(value) <= LONGEST
