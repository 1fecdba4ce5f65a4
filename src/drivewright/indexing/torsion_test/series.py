"""Springs in series: the share of the loading bar and of the support of the test rig in the angle."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright.errors import InputError
from drivewright.indexing.torsion_test.regression import Estimate, compliance_estimate

DOUBTFUL_RATIO = 2.0  # corrected over measured stiffness: beyond it most of the angle was the rig's


class SeriesSpring(NamedTuple):
    """A spring in series with the drive: stiffness [N m/rad] and its standard uncertainty."""

    name: str
    stiffness: float
    uncertainty: float = 0.0


def remove_series_springs(measured: Estimate, freedom: float, parts: Sequence[SeriesSpring], confidence: float = 0.95) -> Estimate:
    """The `Estimate` of k from 1/k = 1/k_r - sum 1/k_i; `measured` is the estimate of k_r, `freedom` its degrees of freedom.

    u(k) = k^2 sqrt((u_r/k_r^2)^2 + sum (u_i/k_i^2)^2).  InputError where the parts alone are as soft as what was measured.
    """
    compliance = 1 / measured.value - sum(1 / part.stiffness for part in parts)
    if compliance <= 0:
        softest = min(parts, key=lambda part: part.stiffness)
        raise InputError(
            f"series correction: 1/k = 1/{measured.value:.6g} - {' - '.join(f'1/{part.stiffness:.6g}' for part in parts)} rad/(N·m) "
            f"= {compliance:.3g} is not positive: the rig would be softer than rig and drive together. Check the {softest.name} stiffness "
            f"(it has to be well above {measured.value:.6g} N·m/rad) and its unit"
        )
    spread = np.sqrt(sum((each.uncertainty / each.stiffness**2) ** 2 for each in parts) + (measured.uncertainty / measured.value**2) ** 2)
    return compliance_estimate(compliance, float(spread), freedom, confidence)
