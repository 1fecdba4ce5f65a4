"""Types of arrays for annotations; what their axes mean is said in the docstrings."""

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["ArrayLike", "Bools", "Complexes", "Floats", "Ints", "Numbers"]

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int64]
Bools: TypeAlias = NDArray[np.bool_]
Complexes: TypeAlias = NDArray[np.complex128]
Numbers: TypeAlias = float | Floats  # a formula for one number, or for arrays of any matching shapes
