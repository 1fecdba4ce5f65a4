"""Rolling bearings of the shaft paper: which kind is the stiffest, and how stiff a 61804 is."""

from collections.abc import Iterator
from functools import cache
from typing import Any

from drivewright import bearings, registry
from drivewright.bearings.ball import BallBearing
from drivewright.bearings.roller import RollerBearing
from drivewright.result import Result
from drivewright.runner import run
from drivewright.spec import load
from drivewright.validation.shaft_model import DATA, LAYOUT, PRINTED_SECTION
from drivewright.validation.source import ABOVE_ONE, AGREES, BELOW_ONE, EXPLAINED, OPEN, Explanation, Printed, Row, rounded

LOAD = 500.0  # N, where bearings of an inner geometry are compared
ROLLERS: dict[str, Any] = {"rollers": 16, "roller_length": "3.2 mm"}  # of the cylindrical bearing
KINDS = ("61804", "hypothetical-ACBB15-20x32x7", "hypothetical-ACBB25-20x32x7", "hypothetical-TRB-20x32x7")
LOADED = {"pressure-roller": "m2", "rubber-roller-r1": "m3"}  # the mass of each shaft that carries `LOAD` where bearings are compared
BEARINGS = {
    "deep-groove ball 61804": "61804",
    "angular-contact ball 15°": "hypothetical-ACBB15-20x32x7",
    "tapered roller": "hypothetical-TRB-20x32x7",
    "cylindrical roller": "hypothetical-CRB-20x32x7",
}
INNER_OF_SHAFTS = "inner geometries of the size of a 61804, inclined bearings back to back without preload"
INNER = (
    "assumed inner geometries of the size of a 61804, of which only the first is a catalogue bearing; no clearance, rings parallel, 500 "
    "N radially; without "
    "an axial load the rings keep their axial place"
)


def radial_stiffness(bearing: BallBearing | RollerBearing, axial: float = 0.0) -> float:
    """Tangent stiffness [N/m] of a bearing under `LOAD` and an axial force [N], rings parallel."""
    held = ("tilt_x", "tilt_y") if axial else ("z", "tilt_x", "tilt_y")
    return float(bearings.solve(bearing, force=[LOAD, 0.0, axial, 0.0, 0.0], held=held).stiffness[0, 0])


def stiffness_ratio(axial: float, taper: BallBearing | RollerBearing) -> float:
    """Stiffness of the cylindrical bearing over that of the stiffest other; bearings with a contact angle get `axial` [N] each."""
    others = [taper if "TRB" in name else bearings.bearing(name) for name in KINDS]
    best = max(radial_stiffness(other, axial if other.contact_angle else 0.0) for other in others)
    return radial_stiffness(bearings.bearing("hypothetical-CRB-20x32x7")) / best


def secant_stiffness_of_61804(force: float) -> float:
    """Radial force over displacement [N/m]."""
    equilibrium = bearings.solve(bearings.bearing("61804"), force=[force, 0.0, 0.0, 0.0, 0.0])
    return float(force / equilibrium.displacement[0])


@cache
def on_bearings(preset: str, designation: str, mass: str) -> Result[Any]:
    """Result of a preset on rolling bearings of a designation under `LOAD` at a mass."""
    spec = load(registry.mechanism("shaft").presets()[preset], (PRINTED_SECTION, 'analysis.theory="euler-bernoulli"'))
    each = [{"name": b.name, "position": f"{b.position!r} m", "bearing": designation} for b in spec.bearings]
    return run(spec.replace(bearings=each, loads=[{"station": mass, "force": f"{LOAD} N"}]), ("flexibility", "rolling"))


def flexibility_on_bearings(mass: str, designation: str) -> float:
    """Flexibility [m/N] of a mass under its own load, under `LOAD` at the mass of its shaft that carries it."""
    preset = LAYOUT[mass][0]
    return float(on_bearings(preset, designation, LOADED[preset])[f"flexibility.{mass}.{mass}"])


def rows() -> Iterator[Row]:
    """Which kind is the stiffest, what that does to the shafts, and the stiffness of a 61804."""
    yield from _stiffest()
    yield _least_flexible()
    light = Explanation(
        "A 61804 has this secant stiffness at 107 N. No bearing of this kind has a constant stiffness: without preload it "
        "grows with the cube root of the load, from 0 at no load.",
        secant_stiffness_of_61804(107.0),
    )
    assumed = "balls of the catalogue's back-fitted 61804; no clearance; the load, which the paper leaves out"
    yield Row(
        "secant stiffness of a 61804 at 500 N",
        rounded("3.0e7 N/m", "N/m"),
        secant_stiffness_of_61804(LOAD),
        "N/m",
        pinned=EXPLAINED,
        kind="published table",
        where="Table 1",
        inputs=DATA,
        assumed=assumed,
        explanation=light,
    )


def _least_flexible() -> Row:
    """Whether the shafts on cylindrical bearings are the least flexible, at every mass."""
    others = [name for name in BEARINGS.values() if "CRB" not in name]
    shares = [
        flexibility_on_bearings(mass, BEARINGS["cylindrical roller"]) / min(flexibility_on_bearings(mass, other) for other in others)
        for mass in LAYOUT
    ]
    return Row(
        "flexibility on cylindrical bearings over the least on the others, the largest of the four masses",
        Printed("lowest flexibility: below 1", *BELOW_ONE),
        max(shares),
        "-",
        pinned=OPEN,
        kind="published table",
        where="section 5.3, figs. 17 and 18",
        inputs="61804, 'identical dimensions'",
        assumed=f"{INNER_OF_SHAFTS}; 500 N at m2 and m3",
        note="The tapered bearings are stiffer at all four places: 17 rollers of 4 mm against 16 of 3.2 mm in the cylindrical ones.",
    )


def _stiffest() -> Iterator[Row]:
    taper = bearings.bearing("hypothetical-TRB-20x32x7")
    alike = taper.replace(**ROLLERS)
    plain, claim = stiffness_ratio(0.0, alike), Printed("highest support stiffness: above 1", *ABOVE_ONE)
    loaded = Explanation(
        "The claim holds for equal rollers and no axial load. With it, all rollers of a tapered bearing carry load.", plain
    )
    longer = Explanation("The claim holds for equal rollers. A tapered bearing of the same size may have more and longer ones.", plain)
    common: dict[str, Any] = {
        "unit": "-",
        "kind": "published table",
        "where": "section 5.3, figs. 17 and 18",
        "inputs": "61804, 'identical dimensions'",
        "assumed": INNER,
    }
    name = "cylindrical roller bearing over the stiffest other"
    common["reading_of"] = name
    yield Row(f"{name}, equal rollers, no axial load", claim, plain, pinned=AGREES, **common)
    yield Row(
        f"{name}, tapered with 17 rollers of 4 mm, no axial load",
        claim,
        stiffness_ratio(0.0, taper),
        pinned=EXPLAINED,
        explanation=longer,
        **common,
    )
    yield Row(f"{name}, equal rollers, 300 N axially", claim, stiffness_ratio(300.0, alike), pinned=EXPLAINED, explanation=loaded, **common)
