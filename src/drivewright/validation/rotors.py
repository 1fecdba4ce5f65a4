"""Rotors of the literature: whirl at speed and critical speeds, the printed numbers quoted second hand."""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from drivewright import shafts
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.validation.source import AGREES, EXPLAINED, OPEN, Explanation, Row, Source, rounded

RPM = np.pi / 30
STEEL = {"modulus": 211e9, "density": 7810.0, "poisson": 0.3}
COARSE, FINE = 6, 60  # elements: of the printed numbers, and ours
EVERY = 200  # modes that are kept: all

# -- two discs -----------------------------------------------------------------------------------------------------------------

DISCS = ((0.5, 0.28), (1.0, 0.35))  # place and outer diameter [m]
AT_REST = ("86.66", "274.31", "716.78")  # rad/s, each twice
TURNING = ("85.39", "87.80", "251.78", "294.71", "600.18")  # rad/s, at 4000 rpm


def _disc(number: int, place: float, outer: float) -> shafts.Station:
    """A disc of 70 mm width on the shaft of 50 mm."""
    mass = STEEL["density"] * np.pi / 4 * (outer**2 - 0.05**2) * 0.07
    polar = mass / 8 * (outer**2 + 0.05**2)
    return shafts.Station(f"disc {number}", place, mass, polar, polar / 2 + mass / 12 * 0.07**2)


@cache
def two_discs(elements: int) -> ShaftEquilibrium:
    """The rotor with two discs at rest."""
    supports = tuple(shafts.spring_support(name, place, 1e6) for name, place in (("A", 0.0), ("B", 1.5)))
    stations = tuple(_disc(n, place, outer) for n, (place, outer) in enumerate(DISCS, 1))
    bar = (shafts.Section(1.5, 0.05, 0.05),)
    return _at_rest(shafts.Shaft(bar, STEEL["modulus"], STEEL["poisson"], STEEL["density"], supports, stations), elements)


def _at_rest(shaft: shafts.Shaft, elements: int) -> ShaftEquilibrium:
    return shafts.refined_equilibrium(shafts.apply_loads(shaft, shafts.ShaftLoads()).equilibrium, shaft.length / elements)


def _two_disc_rows() -> Iterator[Row]:
    fine, coarse = (shafts.reduced_rotor(two_discs(elements), kept=EVERY) for elements in (FINE, COARSE))
    common: dict[str, Any] = {
        "unit": "rad/s",
        "kind": "published table",
        "where": "example 5.9.1",
        "inputs": "shaft 1.5 m by 50 mm; discs 280 and 350 mm across, 70 mm wide, at 0.5 and 1 m; bearings 1 MN/m",
        "assumed": "Cowper's shear coefficient",
    }
    at_rest, turning = (shafts.whirl_modes(fine, speed, 3).frequency for speed in (0.0, 4000 * RPM))
    meshed = [shafts.whirl_modes(coarse, speed, 3).frequency for speed in (0.0, 4000 * RPM)]
    for n, printed in enumerate(AT_REST):
        yield _meshed(f"natural frequency {n + 1} at rest", printed, at_rest[2 * n], meshed[0][2 * n], common)
    for n, printed in enumerate(TURNING):
        way = "forward" if n % 2 else "backward"
        yield _meshed(f"{way} whirl {n // 2 + 1} at 4000 rpm", printed, turning[n], meshed[1][n], common)


def _meshed(name: str, printed: str, ours: float, coarse: float, common: dict[str, Any]) -> Row:
    """A row whose printed number may be that of six elements; the third at rest is theirs but for its last digit."""
    number = rounded(f"{printed} rad/s", "rad/s")
    reason = Explanation("The printed number is that of six elements.", float(coarse))
    plain = Row(name, number, float(ours), pinned=AGREES, **common)
    if plain.verdict == AGREES:
        return plain
    if number.low <= coarse <= number.high:
        return Row(name, number, float(ours), pinned=EXPLAINED, explanation=reason, **common)
    return Row(name, number, float(ours), pinned=OPEN, note=f"Six elements give {coarse:.2f} rad/s.", **common)


two_disc_rotor = Source(
    "two-disc-rotor",
    "Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines, Cambridge 2010, example 5.9.1, as quoted by the tests of the program "
    "ROSS (https://github.com/petrobras/ross); the book was not opened.",
    _two_disc_rows,
)

# -- Nelson and McVaugh --------------------------------------------------------------------------------------------------------

PLACES = 1e-2 * np.array(
    [0, 1.27, 5.08, 7.62, 8.89, 10.16, 10.67, 11.43, 12.70, 13.46, 16.51, 19.05, 22.86, 26.67, 28.70, 30.48, 31.50, 34.54, 35.81]
)
OUTER = 2e-2 * np.array([0.51, 1.02, 0.76, 2.03, 2.03, 3.3, 3.3, 2.54, 2.54, 1.27, 1.27, 1.52, 1.52, 1.27, 1.27, 3.81, 2.03, 2.03])
INNER = 2e-2 * np.array([0, 0, 0, 0, 0, 0, 1.52, 1.78, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.52])
CRITICAL = ("15470", "17159", "46612", "49983", "64752", "96547")  # rpm, backward and forward by turns


def overhung() -> ShaftEquilibrium:
    """The rotor of 18 pieces with an overhung disc on two bearings, at rest; Rayleigh's beam."""
    supports = tuple(shafts.spring_support(name, float(PLACES[n]), 4.378e7) for name, n in (("A", 10), ("B", 14)))
    disc = shafts.Station("disc", float(PLACES[4]), 1.401, 0.00203, 0.00136)
    pieces = tuple(shafts.Section(*row) for row in np.stack([np.diff(PLACES), OUTER, OUTER, INNER], axis=1).tolist())
    return _at_rest(shafts.Shaft(pieces, 2.078e11, 0.3, 7806.0, supports, (disc,), shafts.EULER_BERNOULLI, True), FINE)


def _overhung_rows() -> Iterator[Row]:
    found = shafts.critical_speeds(overhung(), 3)
    for n, (printed, ours) in enumerate(zip(CRITICAL, np.sort([*found.forward, *found.backward]), strict=True)):
        yield Row(
            f"{'forward' if n % 2 else 'backward'} critical speed {n // 2 + 1}",
            rounded(f"{printed} rpm", "rad/s"),
            float(ours),
            "rad/s",
            pinned=OPEN,
            kind="published table",
            where="whirl ratio 1, isotropic bearings",
            inputs="18 pieces of shaft, disc of 1.401 kg, bearings 4.378e7 N/m, E = 207.8 GPa",
            assumed="rotary inertia without shear; the dimensions of a public repository of exercises, in steps of 0.1 mm",
            note="The first, second and fifth are within 0.05 %. ROSS' whirl of these data at 70 000 rpm is ours to 2e-5." if not n else "",
        )


nelson_mcvaugh = Source(
    "nelson-mcvaugh",
    "Nelson, McVaugh: The dynamics of rotor-bearing systems using finite elements, ASME Journal of Engineering for Industry 98 (1976), the "
    "critical speeds as quoted by a finite-element program's manual (https://2022.help.altair.com, OS-V: 1000); the paper was not opened.",
    _overhung_rows,
)
