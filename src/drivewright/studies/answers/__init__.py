"""What a study says: `analyse_study(study)` gives a `Result` and its plots.

`spread` of a sample and corners, `causes` of the spread, `maps` over levels, `fronts` of objectives; `parts` is what they are made of.
"""

from drivewright.studies.answers.whole import Answers, analyse_study

__all__ = ["Answers", "analyse_study"]
