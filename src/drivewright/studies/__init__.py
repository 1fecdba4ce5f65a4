"""Studies: many cases of one spec, from one core to a cluster.

`sweep` computes the cases, `open_study` reads those of a folder, `analyse_study` says what came out; `optimise` searches the best design;
`verify` computes a case once more on an independent route; `advise` says what to change so that a failed check passes.
What varies is stated with `linspace`, `geomspace`, `uniform`, `normal`,
`triangular`, `tolerance` and `linked`.

adjustable        the dimensions of a design that may be changed to make it pass
advising          what to change in a design so that a check which fails passes
answers           what a study says: `analyse_study(study)` gives a `Result` and its plots
ledger            the ledger of a study: which parts there are, each with size and checksum
links             keys that follow other keys, joined to what they follow
nominal           the value that a key has where nothing varies
optimisation      optimisation of any drive
parts             the parts of a study: Parquet files that prove what they are
pareto            designs that no other design beats in every objective
plan              the plan of a study: every case, known before the first one runs
points            cases from a file
random_points     points of the random keys, many of them made where they are read
reaching          what to change in a design so that a value becomes the number that is wanted
relations         a key that follows another one: its text, read by hand
retry             cases without a whole answer, computed once more
search            a search for the best design
sensitivity       which of the varying keys causes how much of a number's spread
spec_differences  what makes a study another one than that in a folder, key by key
streaming         statistics of numbers that are too many to be held
statistics        what a random sample says about a number
store             what keeps the parts of a study, or of a search, as they are done
stored_rows       the rows of a study in its folder, read part by part where they are many
study             a study that has been run, whole or in part
study_frames      a study as a frame of pandas and as a dataset of xarray
study_folder      the folder in which a study lives, for who writes it
study_reading     the same as a reader finds it
sweeps            a study from its plan to its rows: `sweep(spec)` computes what is not there yet and keeps it
variables         what varies: a key of the spec with its levels or its distribution, in SI
variation         how to say what varies: from Python, and as on the command line
verification      a case computed again on an independent route, row by row beside our own numbers
"""

from drivewright.studies.advising import advise
from drivewright.studies.answers import Answers, analyse_study
from drivewright.studies.optimisation import Optimised, optimise
from drivewright.studies.plan import Block, Plan, make_plan
from drivewright.studies.statistics import Sampled, Summary, summary
from drivewright.studies.study import Study
from drivewright.studies.sweeps import open_study, sweep
from drivewright.studies.variables import Variable
from drivewright.studies.variation import geomspace, linked, linspace, normal, tolerance, triangular, uniform, with_variation
from drivewright.studies.verification import Comparison, verify

__all__ = [
    "Answers",
    "Block",
    "Comparison",
    "Optimised",
    "Plan",
    "Sampled",
    "Study",
    "Summary",
    "Variable",
    "advise",
    "analyse_study",
    "geomspace",
    "linked",
    "linspace",
    "make_plan",
    "normal",
    "open_study",
    "optimise",
    "summary",
    "sweep",
    "tolerance",
    "triangular",
    "uniform",
    "verify",
    "with_variation",
]
