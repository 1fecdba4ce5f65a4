"""What the results of a kind of drive obey exactly: data that a `Mechanism` states and the conformance suite (`drivewright.testing`) reads.

`Mechanism.claims(spec)` gives the claims for a spec; where there are none on one of the `SUBJECTS`, `reasons` says why.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

SUBJECTS = ("derivatives", "balances", "speed", "mirror", "limits")


@dataclass(frozen=True)
class Derivative:
    """d(position)/d(over) = rate / per in a table; `per` is what the rate was scaled by, e.g. an angular speed.

    At a corner of the motion the rate of an interval lies between those at its ends; `tolerance` is relative to the largest rate.
    """

    table: str
    position: str
    rate: str
    over: str
    per: float = 1.0
    tolerance: float = 1e-3


@dataclass(frozen=True)
class Balance:
    """A value, or the value of a check, that is 0 in exact arithmetic: an audit of energy, power or equilibrium, at most `limit`."""

    name: str
    limit: float
    analyses: tuple[str, ...] = ()


@dataclass(frozen=True)
class Scaling:
    """Values go with powers of a key: doubled, it changes each value by 2^exponent."""

    key: str
    exponents: Mapping[str, float]
    analyses: tuple[str, ...] = ()
    tolerance: float = 1e-9


@dataclass(frozen=True)
class Mirror:
    """The mirror image of a spec, as changes of its keys, and the values that change sign with it (patterns); the others stay."""

    image: Callable[[dict[str, Any]], dict[str, Any]]  # raw tables of a spec -> those of its mirror image
    odd: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()  # patterns of values that are neither
    analyses: tuple[str, ...] = ()
    tolerance: float = 1e-9


@dataclass(frozen=True)
class Limit:
    """A value tends to a number, or to that of a changed spec, as keys grow without bound: the difference goes with factor^-order."""

    keys: tuple[str, ...]
    value: str
    towards: float | Mapping[str, Any]
    order: float
    factors: tuple[float, ...] = (10.0, 100.0)
    analyses: tuple[str, ...] = ()


@dataclass(frozen=True)
class Claims:
    """All claims for a spec; `reasons` says by subject why there are none."""

    derivatives: tuple[Derivative, ...] = ()
    balances: tuple[Balance, ...] = ()
    speed: tuple[Scaling, ...] = ()
    mirror: tuple[Mirror, ...] = ()
    limits: tuple[Limit, ...] = ()
    reasons: Mapping[str, str] = field(default_factory=dict)
