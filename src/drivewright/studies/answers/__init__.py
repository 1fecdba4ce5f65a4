"""Evaluation of a study: `analyse_study(study)` gives a `Result` and its plots.

`spread` of a sample and corners, `causes` of the spread, `maps` over levels, `fronts` of objectives; `parts` is what they are made of.

all_cases  statistics over all cases of a study that are too many for memory
cases      how each case ended, whether it passes, which are a random sample
extremes   which inputs give the least and the greatest of each value
factorial  the levels behind a file of points, where its points are all combinations of some
thinned    the cases of a large study that plots are made of
whole      what a study says: a `Result` with values, tables and findings, and how to look at it
within     spread within a case, separated from the spread that the varied keys cause
"""

from drivewright.studies.answers.whole import Answers, analyse_study

__all__ = ["Answers", "analyse_study"]
