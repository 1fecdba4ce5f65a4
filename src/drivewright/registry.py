"""What can be plugged in, by entry point.

Groups: `drivewright.mechanisms` (a `Mechanism`), `drivewright.commands` (a command's name, pointing at the `Mechanism` that brings it, so
that the names are known before anything is imported), `drivewright.motion_laws` (a function returning a motion law),
`drivewright.impact_laws` (a `contact.ImpactLaw`), `drivewright.contact_laws` (a function of `contact.ContactParameters` that returns a
law), `drivewright.joints` (a function that makes a joint of a linkage's table and two markers),
`drivewright.views` (a function that draws a table), `drivewright.validation` (a published source beside ours).
A third-party package declares the same groups in its own pyproject.
"""

import tomllib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeAlias, TypeVar

from drivewright import plugins
from drivewright.claims import Claims
from drivewright.errors import InputError

if TYPE_CHECKING:
    from drivewright.construction import Construction
    from drivewright.dimensions import DimensionSheet
    from drivewright.motion_diagram import MotionDiagram
    from drivewright.result import Answer, Answers, Plot, Result, SpecLike
    from drivewright.scene import Drawing, Part, Scene

SpecT = TypeVar("SpecT", bound="SpecLike")  # not imported from `result`, for listing what is registered must not import numpy
ModelT = TypeVar("ModelT")
Row: TypeAlias = tuple[str, float, float, str, float, str]  # of `verify`: name, ours, other, unit, allowed difference, route


class LeftOut(NamedTuple):
    """A comparison that `verify` cannot make: what it is, why, and the extra to install where only that is missing."""

    name: str
    reason: str
    extra: str = ""


@dataclass(frozen=True)
class Analysis(Generic[SpecT, ModelT]):
    """A question a mechanism can answer: `answer(model, done) -> Answer`.

    `needs` names analyses that come first; their answers are in `done` by name.  `default` analyses run without being asked, those of
    `manufacture` before every export, for their checks or tables are the workshop's.
    `missing(spec)` gives the reason why this analysis has to be left out (missing input), or None.  `fields`: its answer has
    `SurfaceFields` of its name, which a viewer of solids shows.
    """

    name: str
    answer: "Callable[[ModelT, Answers], Answer]"
    meaning: str
    default: bool = True
    needs: tuple[str, ...] = ()
    missing: Callable[[SpecT], str | None] = lambda spec: None
    manufacture: bool = False
    fields: bool = False


@dataclass(frozen=True)
class Mechanism(Generic[SpecT, ModelT]):
    """All that the house knows of a kind of drive.

    `build(spec)` gives the model; `analyses` ask it; `scene(model)`, `plots` (or `plots(result)`, where they depend on it),
    `drawings(model)` and `parts(model)` show it, `programme(model)` draws its motion for whoever edits it; `quick_scene(model)` is a
    scene for a design that a hand is moving, None where the scene itself is quick;
    `verify(model, result)` re-computes it on independent routes, with a `LeftOut` in place of the rows of one that is not to be had;
    `batch(spec, keys, names)` gives a fast evaluation of many designs (n, keys) in SI -> {name: (n,)} for values, and checks as
    `check.NAME` (their margins), or None where it does not cover them; a design that it cannot speak for is nan in every name.
    `supplied(spec)` gives {key: value in SI} of keys that the spec leaves out and that come from a catalogue, a card or a default of
    the drive, list elements by name, so that a study can vary about them.
    `adjustable` are the dimensions that advice on a failed check may change, with the greatest factor of each: not what states the task.
    `before_varying(tables, keys)` gives the raw tables of a design whose keys are to vary, with what they need besides.
    `folder` holds `presets/*.toml`, `theory.md` and, for screens in other languages, `zh.toml`.
    """

    kind: str
    summary: str
    spec: type[SpecT]
    build: Callable[[SpecT], ModelT]
    analyses: tuple[Analysis[SpecT, ModelT], ...]
    folder: Path
    scene: "Callable[[ModelT], Scene] | None" = None
    programme: "Callable[[ModelT], MotionDiagram] | None" = None  # its motion, where a person may edit it segment by segment
    before_varying: Callable[[Mapping[str, Any], Collection[str]], dict[str, Any]] | None = None
    quick_scene: "Callable[[ModelT], Scene | None] | None" = None
    plots: "tuple[Plot, ...] | Callable[[Result[Any]], tuple[Plot, ...]]" = ()
    drawings: "Callable[[ModelT], tuple[Drawing, ...]] | None" = None
    parts: "Callable[[ModelT], tuple[Part, ...]] | None" = None
    verify: "Callable[[ModelT, Result[Any]], Iterable[Row | LeftOut]] | None" = None
    batch: Callable[..., Any] | None = None
    supplied: Callable[[SpecT], Mapping[str, float]] | None = None
    sources: tuple[str, ...] = ()
    headline: tuple[str, ...] = ()  # value names shown first; "*" stands for what users name
    main_plots: tuple[str, ...] = ()  # "plot" or "plot/column" that a page opens with, in this order, "*" as above; () for the first ones
    diagrams: tuple[str, ...] = ()  # the same of plots whose x is what points to the right in the scene: they stand under it
    adjustable: Mapping[str, float] = field(default_factory=dict)  # {key, with "*": greatest factor} of what advice may change
    compile_ahead: Callable[[SpecT], Sequence[Callable[[], object]]] | None = None  # what compiles the kernels that a run comes to last
    dimensions: "tuple[DimensionSheet, ...]" = ()  # drawings that show what its keys measure
    claims: Callable[[SpecT], Claims] | None = None  # what its results obey exactly, for `drivewright.testing`
    construction: "Construction | None" = None  # how it is built by clicks on its drawing
    moving_presets: bool = False  # its presets are offered as starts, with pictures that move
    commands: "tuple[Command, ...]" = ()  # what it brings to the command line, each a `Command`

    def presets(self) -> dict[str, Path]:
        """Name -> path of the spec files that come with the kind."""
        return {path.stem: path for path in sorted((self.folder / "presets").glob("*.toml"))}

    def translations(self, language: str) -> dict[str, Any]:
        """Tables of `<language>.toml` in the folder: `fields`, `tables`, `hints`, `texts`, `presets`; {} where the kind brings none."""
        path = self.folder / f"{language}.toml"
        try:
            return tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
        except ValueError as error:  # no TOML, or no UTF-8
            raise InputError(f"mechanism {self.kind!r}: {path.name} cannot be read: {error}; repair the package that brings it") from error


@dataclass(frozen=True)
class Command:
    """A command that a mechanism brings: `drivewright NAME ARGUMENT --key value ...` writes a run folder.

    `evaluation` is a `Mechanism` like any other, only that its spec is written as options instead of a file: its kind is the name of the
    command, the plain keys of its spec are the options, their descriptions the help.  `argument` is the key that stands without a name.
    """

    evaluation: Mechanism[Any, Any]
    argument: str

    @property
    def name(self) -> str:
        """What is typed."""
        return self.evaluation.kind

    @property
    def summary(self) -> str:
        """One line for the help."""
        return self.evaluation.summary


def oracle(kind: str) -> "Callable[[Any, Result[Any]], Iterable[Row | LeftOut]]":
    """`verify` of the package drivewright.oracles.KIND, which is imported when it is called."""

    def verify(model: Any, result: "Result[Any]") -> Iterable[Row | LeftOut]:
        return import_module(f"{plugins.OURS}.oracles.{kind}").verify(model, result)

    return verify


def kinds() -> list[str]:
    """Names of all mechanism kinds, sorted."""
    return sorted(plugins.installed("drivewright.mechanisms"))


def mechanism(kind: str) -> Mechanism[Any, Any]:
    """The `Mechanism` of a kind, or the evaluation of a command by its name."""
    if kind in plugins.installed("drivewright.mechanisms") or kind not in commands():
        return plugins.load("drivewright.mechanisms", kind, "mechanism")
    return command(kind).evaluation


def is_known(kind: str) -> bool:
    """Whether a kind, or a command, of this name is installed."""
    return kind in kinds() or kind in commands()


def commands() -> dict[str, str]:
    """Name -> kind of the mechanism that brings it, sorted; nothing is imported."""
    kind_of = {point.value: kind for kind, point in plugins.installed("drivewright.mechanisms").items()}
    return {name: kind_of.get(point.value, point.value) for name, point in sorted(plugins.installed("drivewright.commands").items())}


def command(name: str) -> Command:
    """The `Command` of a name; InputError where the mechanism that is declared to bring it does not."""
    bringing = plugins.load("drivewright.commands", name, "command")
    named = next((each for each in bringing.commands if each.name == name), None)
    if named is None:
        raise InputError(f"command {name!r} is not among the commands of {bringing.kind!r}; repair the package that declares it")
    return named


def headlines(mechanism: Mechanism[Any, Any], values: Iterable[str] | Mapping[str, Any]) -> list[str]:
    """Names of the values that are shown first, in the order of the mechanism's headline; the first ones where it names none.

    `values` are names, or {name: Value}; a value that has not settled is left out.
    """
    return [name for group in headline_groups(mechanism, values) for name in group]


def key_values(mechanism: Mechanism[Any, Any], values: Iterable[str] | Mapping[str, Any], most: int) -> list[str]:
    """The few of them for a first page: one of each pattern of the headline, then a second one, until there are `most`."""
    groups = headline_groups(mechanism, values)
    turns = sorted((turn, place, name) for place, group in enumerate(groups) for turn, name in enumerate(group))
    chosen = {name for _, _, name in turns[:most]}
    return [name for group in groups for name in group if name in chosen]


def headline_groups(mechanism: Mechanism[Any, Any], values: Iterable[str] | Mapping[str, Any]) -> list[list[str]]:
    """The names of `headlines`, those of one pattern together."""
    values = [name for name in values if not isinstance(values, Mapping) or getattr(values[name], "settled", True)]
    groups: dict[str, list[str]] = {pattern: [] for pattern in mechanism.headline}
    for name in values:
        first = next((pattern for pattern in mechanism.headline if fnmatchcase(name, pattern)), None)
        if first:
            groups[first].append(name)
    named = [group for group in groups.values() if group]
    return named or [[name] for name in values[:12]]
