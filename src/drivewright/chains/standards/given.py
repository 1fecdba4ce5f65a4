"""Checks of the arguments of the formulas of chain drives."""

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.errors import InputError


def above_zero(where: str, **values: ArrayLike) -> None:
    """Refuse numbers or arrays that are not finite and above 0, by their argument's name."""
    for name, value in values.items():
        value = np.asarray(value, dtype=float)
        if not np.all(np.isfinite(value) & (value > 0)):
            raise InputError(f"{where}: {name.replace('_', ' ')} must be finite and above 0, got {_worst(value):g} (SI units).")


def from_zero(where: str, **values: ArrayLike) -> None:
    """Refuse numbers or arrays that are not finite or below 0."""
    for name, value in values.items():
        value = np.asarray(value, dtype=float)
        if not np.all(np.isfinite(value) & (value >= 0)):
            raise InputError(f"{where}: {name.replace('_', ' ')} must be finite and 0 or more, got {_worst(value):g} (SI units).")


def whole_teeth(where: str, *teeth: ArrayLike) -> None:
    """Refuse tooth numbers that are not whole or below 5."""
    for each in teeth:
        each = np.asarray(each, dtype=float)
        good = np.isfinite(each) & (each >= 5) & (each == np.floor(each))
        if not np.all(good):
            raise InputError(f"{where}: tooth numbers must be whole and 5 or more, got {each[~good].flat[0]:g}.")


def whole(where: str, **values: ArrayLike) -> None:
    """Refuse what is not a whole number from 1 up."""
    for name, given in values.items():
        value = float(np.asarray(given))
        if not (np.isfinite(value) and value >= 1 and value == np.floor(value)):
            raise InputError(f"{where}: {name.replace('_', ' ')} must be a whole number from 1 up, got {value:g}.")


def _worst(value):
    """The number to show: one that is not finite where there is one, else the least."""
    odd = value[~np.isfinite(value)]
    return odd.flat[0] if odd.size else np.min(value)
