"""The folder's impact loads with real contact in its pins, beside Table 2: dry steel with intervals; oil and wear as its outlook.

Every speed is a table of its own in a folder, so that what was stopped goes on.
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from drivewright.atomic import replacing
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.runner import run
from drivewright.validation.folding_linkage import CALIBRATION_SPEED, OPEN, PLAYS, TABLE, folding_spec, load_row
from drivewright.validation.source import ABOVE_ONE, AGREES, BELOW_ONE, Printed, Row

if TYPE_CHECKING:
    import pyarrow

Progress: TypeAlias = Callable[[int, int, str], object]
PINS = ("A", "B", "O4")
OIL_PLAYS = ("0.02", "0.05", "0.10", "0.20")  # mm
SPARED, WORN = "0.02", "0.20"  # mm
RUN: dict[str, object] = {"turns": 12, "discard": 5, "relative_tolerance": 1e-6, "ensemble": 4}
CONTACT = (
    "contact and flight in A, B and O4: bearings of 15 mm radius, steel, restitution 0.9 after Flores et al. 2011, friction 0.1; inertia "
    "of the knife about its pivot; twelve turns of which five are discarded, four starts"
)
RIGID = (
    "Another model than the paper's, which cannot leave contact. Rigid links with dry steel pins strike: K_d is 7 to 110 times the print "
    "and scatters; elastic links, oil and damping of a real machine take that away."
)


def pins_with(speed: int, plays: Sequence[str], **keys: object) -> LinkageSpec:
    """The folder at a speed [turns/h] with a table of impact loads over the play [mm] of its three pins, and other keys in these pins."""
    pins: dict[str, object] = {"model": "dry", "bearing_radius": "15 mm", "friction": 0.1, **keys}
    spec = folding_spec(speed, "0.20", 0.0, pins, **RUN)
    return spec.replace(table={"output": "knife", "speeds": [f"{speed} rev/h"], "clearances": [f"{play} mm" for play in plays]})


def impact_loads(folder: Path, spec: LinkageSpec) -> "pyarrow.Table":
    """The table of impact loads of a spec, kept in the folder under the spec's digest."""
    from pyarrow import parquet

    path = folder / "studies" / "impact-loads" / f"{spec.digest()[:16]}.parquet"
    if not path.is_file():
        with replacing(path) as temporary:
            parquet.write_table(run(spec, ("load_table",)).table("load_table"), temporary)
    return parquet.read_table(path)


def dry_specs() -> dict[int, LinkageSpec]:
    """{speed [turns/h]: its spec} with dry contact."""
    return {speed: pins_with(speed, PLAYS) for speed in TABLE}


def oil_spec() -> LinkageSpec:
    """Oil films of 100 mPa s in the pins, at 28 800 r/h."""
    return pins_with(CALIBRATION_SPEED, OIL_PLAYS, model="lubricated", viscosity="100 mPa s")


def worn_specs() -> dict[str, LinkageSpec]:
    """{pin: dry contact with this one worn, the others spared}, at 28 800 r/h."""
    return {worn: _one_worn(worn) for worn in PINS}


def _one_worn(worn: str) -> LinkageSpec:
    """One pin with play, the others ideal: their play would be another nine motions to tell apart."""
    spec = pins_with(CALIBRATION_SPEED, (WORN,))
    return spec.replace({f"joints.{pin}.model": "ideal" for pin in PINS if pin != worn})


def compute(folder: Path, progress: Progress) -> None:
    """Every table of this module."""
    specs = [*dry_specs().values(), oil_spec(), *worn_specs().values()]
    for number, spec in enumerate(specs):
        progress(number, len(specs), "")
        impact_loads(folder, spec)


def dry_rows(folder: Path) -> Iterator[Row]:
    """Every cell of Table 2 with dry contact and its interval."""
    for speed, spec in dry_specs().items():
        table = impact_loads(folder, spec).to_pydict()
        for play, value, low, high in zip(PLAYS, *(table[f"coefficient{end}"] for end in ("", ".low", ".high")), strict=True):
            ends: dict[str, Any] = {"low": low, "high": high} if low == low else {}
            yield load_row(speed, play, "dry contact", value, pinned=OPEN, assumed=CONTACT, note=RIGID, **ends)
    yield from _trends({speed: impact_loads(folder, spec).to_pydict() for speed, spec in dry_specs().items()})


def _trends(tables: dict[int, dict[str, list[float]]]) -> Iterator[Row]:
    """Statements of section 3 about its table: K_d grows with the play at every speed, and not with the speed everywhere."""
    common: dict[str, Any] = {"unit": "-", "pinned": AGREES, "kind": "published table", "where": "section 3", "assumed": CONTACT}
    fastest, slowest = (tables[speed] for speed in (max(tables), min(tables)))
    over_play = [_quotient(table, -1, table, 0) for table in tables.values()]
    grows = Printed("grows markedly: above 1", *ABOVE_ONE)
    least = min(over_play, key=lambda found: found[1])
    yield Row("K_d at r = 0.40 over 0.01 mm, least of the speeds", grows, least[0], low=least[1], high=least[2], **common)
    over_speed = [_quotient(fastest, play, slowest, play) for play in range(len(PLAYS))]
    falls = Printed("not with the speed everywhere: below 1", *BELOW_ONE)
    most = min(over_speed, key=lambda found: found[2])
    yield Row("K_d at the highest over the lowest speed, least of the plays", falls, most[0], low=most[1], high=most[2], **common)


def _ends(table: dict[str, list[float]], at: int) -> tuple[float, float, float]:
    """(coefficient, ends of its interval); one without interval is its own ends."""
    value = table["coefficient"][at]
    low, high = (table[f"coefficient.{end}"][at] for end in ("low", "high"))
    return (value, low, high) if low == low else (value, value, value)


def _quotient(upper: dict[str, list[float]], one: int, lower: dict[str, list[float]], other: int) -> tuple[float, float, float]:
    """Two coefficients' quotient with the widest interval that theirs allow; one without interval is exact."""
    (value, low, high), (by, least, most) = _ends(upper, one), _ends(lower, other)
    return value / by, low / most, high / least
