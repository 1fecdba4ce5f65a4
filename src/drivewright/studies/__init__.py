"""Studies: many cases of one spec, from one core to a cluster.

`sweep` computes the cases, `open_study` reads those of a folder, `analyse_study` says what came out; `optimise` searches the best design;
`verify` computes a case once more on an independent route.  What varies is said with `linspace`, `geomspace`, `uniform`, `normal`,
`triangular` and `tolerance`.
"""

from drivewright.studies.answers import Answers, analyse_study
from drivewright.studies.optimisation import Optimised, optimise
from drivewright.studies.plan import Block, Plan, make_plan
from drivewright.studies.statistics import Sampled, Summary, summary
from drivewright.studies.study import Study
from drivewright.studies.sweeps import open_study, sweep
from drivewright.studies.variables import Variable
from drivewright.studies.variation import geomspace, linspace, normal, tolerance, triangular, uniform, with_variation
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
    "analyse_study",
    "geomspace",
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
