"""Types of arrays for annotations; what their axes mean is said in the docstrings."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["ArrayLike", "Bools", "Complexes", "Floats", "Ints", "Numbers", "Records"]

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int64]
Bools: TypeAlias = NDArray[np.bool_]
Complexes: TypeAlias = NDArray[np.complex128]
Numbers: TypeAlias = float | Floats  # a formula for one number, or for arrays of any matching shapes
Records: TypeAlias = Any  # numpy.recarray: rows with named fields, whose types numpy does not state
