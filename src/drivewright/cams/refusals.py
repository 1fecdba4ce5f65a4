"""Invalid designs, one or many at once: whether any is invalid, and the numbers of the first for its message; nan for missing values."""

from typing import Any

import numpy as np


def first_refused(good: Any, *numbers: Any) -> tuple[float, ...] | None:
    """The numbers (of any matching shapes) of the first design that is not `good`; None where all are."""
    good = np.asarray(good)
    if good.all():
        return None
    place = int(np.argmin(good.ravel()))
    return tuple(float(np.broadcast_to(number, good.shape).ravel()[place]) for number in numbers)


def nan_unless(good: Any, number: Any) -> Any:
    """A number, or the column of many designs, where it is `good`; nan where not."""
    return np.where(good, number, np.nan)[()]
