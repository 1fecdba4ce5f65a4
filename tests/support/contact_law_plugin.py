"""A package that brings a contact law: its class, its force, and the function that makes it from what a mechanism states."""

from typing import NamedTuple

from drivewright import implements
from drivewright.contact import ContactParameters, normal_force


class Progressive(NamedTuple):
    """Soft at first, then stiffer: k d (1 + d/s), with losses as of Hunt and Crossley."""

    k: float  # [N/m]
    s: float  # depth at which the stiffness has grown threefold [m]
    chi: float  # [s/m]


@implements(normal_force, Progressive)
def _(law, gap, gap_rate):
    depth = max(-gap, 0.0)
    return max(law.k * depth * (1.0 + depth / law.s) * (1.0 - law.chi * gap_rate), 0.0)


class Linear(NamedTuple):
    """The same as the law of the package, stated by another package: k d + c d'."""

    k: float
    c: float


@implements(normal_force, Linear)
def _(law, gap, gap_rate):
    if gap >= 0.0:
        return 0.0
    return max(-law.k * gap - law.c * gap_rate, 0.0)


def progressive(contact: ContactParameters) -> Progressive:
    """As stiff at a hundredth of a millimetre as K d^n."""
    return Progressive(contact.stiffness * 1e-5 ** (contact.exponent - 1.0), 1e-4, 1.0 - contact.restitution)


def linear(contact: ContactParameters) -> Linear:
    """Stiffness and damping as stated."""
    return Linear(contact.stiffness, contact.damping)
