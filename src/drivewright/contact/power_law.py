"""The power law F = k d^n and its inverse for arrays of depths and forces; the response serves kernels too, one depth at a time."""

from typing import Any, NamedTuple, TypeVar

import numpy as np

from drivewright._jit import generic, implements
from drivewright._typing import Floats, Numbers
from drivewright.contact.normal import PowerLaw

ForceT = TypeVar("ForceT", float, Floats)


class PowerLawResponse(NamedTuple):
    """What a contact by the power law answers with to depths of any shape; each field has that shape."""

    energy: Floats  # V = F d/(n + 1) [J]
    force: Floats  # F [N]
    secant: Floats  # F/d [N/m], also where d is 0
    tangent: Floats  # dF/dd = n F/d [N/m]


@generic
def power_law_response(law: PowerLaw, depth: Numbers) -> PowerLawResponse:
    """Energy, force and stiffness at depths [m] of any shape, and of one depth in kernels: F = k d^n where d >= 0, nothing below."""
    raise NotImplementedError


@implements(power_law_response, PowerLaw)
def _(law, depth):
    inside = np.maximum(depth, 0.0)
    secant = law.k * inside ** (law.n - 1) if law.n != 1 else law.k * (depth >= 0.0)
    force = secant * inside
    return PowerLawResponse(force * inside / (1 + law.n), force, secant, law.n * secant)


def power_law_depth(law: PowerLaw, force: ForceT) -> ForceT:
    """The depth [m] under forces [N] >= 0: (F/k)^(1/n)."""
    depth: Any = (force / law.k) ** (1 / law.n)
    return depth


def power_law_secant(law: PowerLaw, force: ForceT) -> ForceT:
    """F/d [N/m] under forces [N] > 0: k^(1/n) F^(1 - 1/n)."""
    return law.k ** (1 / law.n) * force ** (1 - 1 / law.n)
