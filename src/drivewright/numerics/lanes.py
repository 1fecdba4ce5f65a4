"""Decisions of kernels that compute one case or many at once: by value instead of by branch."""

from typing import Any

from drivewright._jit import branch_free


@branch_free
def where(condition: Any, one: Any, other: Any) -> Any:
    """`one` where the condition holds, else `other`; both are computed."""
    return one if condition else other


@branch_free
def any_lane(condition: Any) -> bool:
    """Whether a condition holds in any of the cases."""
    return condition


@branch_free
def all_lanes(condition: Any) -> bool:
    """Whether a condition holds in all cases."""
    return condition


@branch_free
def opposite(condition: Any) -> Any:
    """Where the condition does not hold."""
    return not condition
