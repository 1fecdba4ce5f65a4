"""The shafts of the pipe-lining machine as printed: data of Table 1, and what runs of the presets give for them."""

from functools import cache
from typing import Any

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.result import Result
from drivewright.runner import run
from drivewright.spec import load
from drivewright.validation.source import Printed, evaluated

# Table 1, SI; I is the printed one.
L1, L2, L3, L5, L6, L7, L8 = 0.0565, 0.080, 0.1085, 0.053, 0.082, 0.0665, 0.2595
E, SECOND, STIFFNESS = 206e9, 7854e-12, 3.0e7
EI = E * SECOND
SPAN = L7 + L8  # between C and D
PRINTED_SECTION = 'segments.0.diameter="20.00001169 mm"'  # that has the printed I
LAYOUT = {
    "m1": ("pressure-roller", "A", 0),
    "m2": ("pressure-roller", "B", 1),
    "m3": ("rubber-roller-r1", "C", 0),
    "m4": ("rubber-roller-r1", "C", 1),
}  # preset, bearing next to it, place in the matrix

DATA = "Table 1: l1 to l9 = 56.5, 80, 108.5, 95, 53, 82, 66.5, 259.5, 29 mm; E = 206 GPa; I = 7854 mm^4; 3.0e7 N/m for each bearing"
READING = "the prose with l7 counted from C (reading R1); beam after Euler and Bernoulli, as in the paper"


@cache
def flexibility(preset: str, stiffness: float | None = None) -> Floats:
    """(2, 2) of a preset with the printed I, on its own bearings or others [N/m]."""
    return run_preset(preset, stiffness, ("flexibility",)).arrays["flexibility"].values


def run_preset(preset: str, stiffness: float | None = None, only: tuple[str, ...] = (), *changes: str) -> Result[Any]:
    """Result of a preset, after Euler and Bernoulli."""
    changes = (PRINTED_SECTION, 'analysis.theory="euler-bernoulli"', *changes)
    spec = load(registry.mechanism("shaft").presets()[preset], changes)
    if stiffness is not None:
        text = "rigid" if np.isinf(stiffness) else f"{stiffness!r} N/m"
        spec = spec.replace(bearings=[{"name": b.name, "position": f"{b.position!r} m", "radial_stiffness": text} for b in spec.bearings])
    return run(spec, only)


def own_flexibility(mass: str, stiffness: float | None = None) -> float:
    """Flexibility of a mass under its own load [m/N]."""
    preset, _, place = LAYOUT[mass]
    return float(flexibility(preset, stiffness)[place, place])


def flexibility_of_formula(value: float) -> Printed:
    """A printed formula's flexibility [m/N] for the printed data, to six digits."""
    return evaluated(f"{1e9 * value:.6g} um/kN", "m/N")


def slope_of_formula(value: float) -> Printed:
    """A printed formula's slope [rad/N], in urad/N, to six digits."""
    return evaluated(f"{1e6 * value:.6g}", "-")


def value_per_newton(preset: str, station: str, name: str) -> float:
    """A value of a run under 1 N at a station, bearings rigid."""
    return run_preset(preset, np.inf, ("statics",), f'loads=[{{station="{station}", force="1 N"}}]')[name]


def literal_bearing_flexibility(mass: str) -> float:
    """Eqs. (16) and (17) as printed [m/N]: what bearings of 3.0e7 N/m would add under 1 N at a mass.  Wrong; kept for comparison.

    mu are the reactions' magnitudes over the stiffness, x counts from the first mass of the shaft.
    """
    preset, _, place = LAYOUT[mass]
    left, right = np.abs(run_preset(preset, None, ("flexibility",)).arrays["reactions.unit_load"].values[:, place]) / STIFFNESS
    if preset == "pressure-roller":
        x = (0.0, L1 + L2 + L3)[place]
        return float(right - x * (left + right) / L2)
    x = (0.0, L6 + L7)[place]
    return float(left - x * (left + right) / (L6 + L7))
