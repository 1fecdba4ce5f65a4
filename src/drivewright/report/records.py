"""What a report wants of a study and of a search; `studies` has them, and stands above the reports."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from numpy.typing import NDArray

from drivewright._typing import Floats
from drivewright.execution.case_reasons import ReasonGroup
from drivewright.execution.keys import KeyKind
from drivewright.execution.outputs import OutputInfo
from drivewright.result import Plot, Result, Table
from drivewright.spec import MechanismSpec

if TYPE_CHECKING:
    import pyarrow


class BlockRecord(Protocol):
    """Rows of the points that come with every combination of levels."""

    @property
    def name(self) -> str:
        """What kind of points they are."""
        ...

    @property
    def start(self) -> int:
        """The first row."""
        ...

    @property
    def stop(self) -> int:
        """The row behind the last one."""
        ...


class VariableRecord(Protocol):
    """A key that varies, with its levels or its distribution."""

    @property
    def key(self) -> str:
        """Dotted key of the spec."""
        ...

    @property
    def also(self) -> tuple[str, ...]:
        """Keys that have the same value."""
        ...

    @property
    def kind(self) -> KeyKind:
        """What the key takes."""
        ...

    @property
    def nominal(self) -> Any:
        """Its value in the spec [SI], None where it has none."""
        ...

    @property
    def levels(self) -> NDArray[Any] | None:
        """Its levels [SI], None where it is random."""
        ...

    @property
    def distribution(self) -> Any:
        """A frozen distribution of scipy.stats, None where it has none."""
        ...


class PlanRecord(Protocol):
    """Every case of a study."""

    @property
    def variables(self) -> Sequence[VariableRecord]:
        """Everything that varies."""
        ...

    @property
    def grid(self) -> Sequence[VariableRecord]:
        """Keys with levels."""
        ...

    @property
    def random(self) -> Sequence[VariableRecord]:
        """Keys with a distribution."""
        ...

    @property
    def listed(self) -> Mapping[Any, NDArray[Any]]:
        """Columns of a file of points."""
        ...

    @property
    def blocks(self) -> Sequence[BlockRecord]:
        """Blocks of the points of the random keys."""
        ...

    @property
    def shape(self) -> tuple[int, ...]:
        """How many levels each key of the grid has."""
        ...

    @property
    def inner(self) -> int:
        """Cases that come with each combination of levels."""
        ...

    @property
    def seed(self) -> int:
        """Of the random numbers."""
        ...

    @property
    def digest(self) -> str:
        """SHA-256 of all cases."""
        ...

    def __len__(self) -> int: ...


class StudyRecord(Protocol):
    """The rows of a study, with the plan that they come from."""

    @property
    def spec(self) -> MechanismSpec:
        """The spec with its [study] table."""
        ...

    @property
    def plan(self) -> PlanRecord:
        """Every case, computed or not."""
        ...

    @property
    def schema(self) -> "pyarrow.Schema":
        """The columns, with unit, label and meaning in the metadata of each."""
        ...

    def batches(self) -> "Iterator[pyarrow.Table]":
        """A row per case, in pieces that need little memory."""
        ...

    def reasons(self) -> Sequence[ReasonGroup]:
        """Why cases are not complete, the commonest reason first."""
        ...

    @property
    def folder(self) -> Path | None:
        """Where it is stored, None in memory."""
        ...

    @property
    def seconds(self) -> float:
        """Time that the workers spent on it [s]."""
        ...

    @property
    def counts(self) -> dict[str, int]:
        """{status: number of cases}."""
        ...

    @property
    def complete(self) -> bool:
        """Whether every case of the plan has its row."""
        ...

    def __len__(self) -> int: ...


class AnswersRecord(Protocol):
    """The answers of a study."""

    @property
    def result(self) -> Result[Any]:
        """Values and tables."""
        ...

    @property
    def plots(self) -> tuple[Plot, ...]:
        """How to look at them."""
        ...


class ProblemRecord(Protocol):
    """The unknowns of a search."""

    @property
    def keys(self) -> tuple[str, ...]:
        """Dotted keys of the unknowns."""
        ...

    @property
    def kinds(self) -> Sequence[KeyKind]:
        """What each key takes."""
        ...

    @property
    def about(self) -> Mapping[str, OutputInfo]:
        """What is known of each value that is looked at."""
        ...


class OptimisedRecord(Protocol):
    """The outcome of a search."""

    @property
    def problem(self) -> ProblemRecord:
        """What was searched for."""
        ...

    @property
    def best(self) -> Result[Any]:
        """The best design."""
        ...

    @property
    def front(self) -> Floats:
        """(designs, unknowns) of the best trade-offs [SI]."""
        ...

    @property
    def front_values(self) -> dict[str, Floats]:
        """{value: (designs,)} of them."""
        ...

    @property
    def table(self) -> "pyarrow.Table":
        """A row per evaluation."""
        ...

    @property
    def folder(self) -> Path | None:
        """Where it is stored, None in memory."""
        ...

    def search(self) -> tuple[Table, Plot]:
        """The evaluations as a table, and how to look at it."""
        ...
