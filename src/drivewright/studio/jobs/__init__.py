"""Work that takes a while: each job is `name(design, progress, **options) -> answer`, called in a worker process.

`progress(done, total, text, partial=None)` says how far it is; `partial` is a preview of the answer.  An answer is plain data for JSON
without nan, or {"files": [{"name", "data": bytes}]}.  Our own errors go up to whoever asked, who shows their words.  A job
may start processes of its own, so the process that it runs in must be no daemon.
"""

from drivewright.studio.jobs import figures, files, search, sensitivity, solid, study

# What a page may ask for: nothing that names a place on the disk, another machine, or how much of this one to take.
JOBS = {
    "sensitivity": sensitivity.sensitivity,
    "study": study.study,
    "optimise": search.optimise,
    "solid": solid.solid,
    "figures": figures.figures,
    "export": files.export,
    "report": files.report,
    "save": files.save,
}
OPTIONS = {
    "figures": ("theme", "analyses"),
    "study": ("theme",),
    "optimise": ("theme",),
    "export": ("format", "anyway"),
    "report": ("whole",),
}
