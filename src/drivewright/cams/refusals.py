"""Refusals of one design, or of many at once: whether any is refused, and the numbers of the first of them for the message."""

from typing import Any

import numpy as np


def first_refused(good: Any, *numbers: Any) -> tuple[float, ...] | None:
    """The numbers (of any matching shapes) of the first design that is not `good`; None where all are."""
    good = np.asarray(good)
    if good.all():
        return None
    place = int(np.argmin(good.ravel()))
    return tuple(float(np.broadcast_to(number, good.shape).ravel()[place]) for number in numbers)
