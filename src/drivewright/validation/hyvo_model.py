"""The Hy-Vo chain as printed: data, Table 2, and its drives at rest, rigid and elastic."""

from dataclasses import replace
from functools import cache

import numpy as np

from drivewright.chains import closure, meshing
from drivewright.chains.closure.model import Strands
from drivewright.chains.implicit.equilibrium import Equilibrium, equilibrium
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Slide, SpeedRamp, Sprocket
from drivewright.chains.tooth import Tooth
from drivewright.validation.source import BELOW_ONE, Printed

MM = 1e-3
P, Z1, Z2, LINKS = 9.525 * MM, 35, 37, 82
NEW_RADII, CLASSICAL_RADIUS = (1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6), 7.4  # rolling radii in mm
TABLE = {
    1.0: ("11.525", "0.258794"),
    1.1: ("11.725", "0.263285"),
    1.2: ("11.925", "0.267776"),
    1.3: ("12.125", "0.272267"),
    1.4: ("12.325", "0.276758"),
    1.5: ("12.525", "0.281249"),
    1.6: ("12.725", "0.285740"),
}
MODULUS, POISSON, YIELD, TENSILE = 206e9, 0.3, 835e6, 980e6
STIFFNESS = 1e8  # of a contact [N/m]: 100 000 N/mm

CHAIN = "p = 9.525 mm, 35 and 37 teeth"
DRIVE = f"{CHAIN}, 82 links, 2000 rpm, 150 N, contact stiffness 100 000 and damping 10, Table 2"
PINS = "200 N in the tight strand, 38CrMoAl with a yield stress of 835 MPa, groups 3 and control"
MASSES = "contact stiffness in N/mm, three contacts in line in a joint, half of the 150 N in each strand"
FORCES = "pins that touch over 6 mm, E = 206 GPa, Poisson's ratio 0.3"
MATERIAL_CARD = "uniform material law for Rm = 980 MPa, stress repeated from 0, Brown and Miller's shear plane, mean stress after Morrow"
GROWS, SMALLER = Printed("grows: above 0", np.nextafter(0.0, 1.0), np.inf), Printed("below 1", *BELOW_ONE)


def pin_offset(radius: float) -> float:
    """Pin offset of a group [m] by (21)."""
    return float(meshing.matching_offset(P, radius * MM, Z1))


def pitch_deviation(radius: float) -> float:
    """delta_p2 of a group  (22)  [m]."""
    return float(meshing.pitch_deviation(P, radius * MM, pin_offset(radius), Z2))


def seated_pitch_difference(radius: float, e: float) -> float:
    """pp2'' - pp1''  (25)  [m]."""
    seats = [meshing.seated_pitch(meshing.hole_pitch(P, radius * MM), radius * MM, e, teeth) for teeth in (Z2, Z1)]
    return float(seats[0] - seats[1])


@cache
def rigid_closure(radius: float, strands: Strands = "equilibrium") -> closure.Closure:
    """Closure of a group over a tooth."""
    return closure.close(closure.Drive(design_link(P, radius * MM, np.pi / 6, 0.0), Z1, Z2, LINKS, strands))


@cache
def elastic_equilibrium(radius: float) -> Equilibrium:
    """Equilibrium of a group with the paper's contact stiffness and force; the same outer flank for all, as in the paper."""
    joint = design_link(P, radius * MM, np.pi / 6, (2.6 + (1.2 - radius) * np.cos(np.pi / 6)) * MM)
    plates = Chain(joint, LINKS, 2.5e-3, 6.4e-8, STIFFNESS / 3)  # at rest, masses do not matter
    teeth = [Tooth(z, P * z / (2 * np.pi) * np.cos(np.pi / 6), seat_support(joint, z)) for z in (Z1, Z2)]
    first = Sprocket(teeth[0], ChainContact(STIFFNESS), angle=0.0, drive=SpeedRamp(-200.0, -200.0))
    second = Sprocket(teeth[1], ChainContact(STIFFNESS), (219.056 * MM, 0.0), mass=0.6, inertia=9e-4, slide=Slide(0.0, 150.0))
    tips = [0.5 * P / np.sin(np.pi / z) - 0.9 * MM for z in (Z1, Z2)]
    return equilibrium(ChainDrive(plates, tuple(replace(s, tip_radius=tip) for s, tip in zip((first, second), tips, strict=True))), 24)
