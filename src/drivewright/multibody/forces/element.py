"""The interface of a force: the table of the system into which its record goes, and the record."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from drivewright.multibody.index import ModelIndex

if TYPE_CHECKING:
    from drivewright.multibody.wrenches import ObservedBodies, Reaction


@dataclass(frozen=True)
class ForceElement:
    """A force between bodies, or on one."""

    table: ClassVar[str]  # field of `system.System` that holds its records

    name: str

    def record(self, index: ModelIndex) -> Mapping[str, Any]:
        """Fields of its record."""
        raise NotImplementedError

    def reaction(self, number: int, bodies: "ObservedBodies") -> "Reaction":
        """What the pin that it stands for transmits; `number` counts the elements of its table."""
        raise NotImplementedError
