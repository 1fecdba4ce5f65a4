"""A pair of conjugate cams over the driving angle as tables: geometry of both cams, and their loads without clearance.

Columns stand for one turn from the start of the programme on, one-sided at the joints of its smooth pieces.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.cams.clearance import LeverRun
from drivewright.cams.conjugate import SAMPLES, ConjugatePair, SmoothPiece
from drivewright.cams.pressure import roller_pressure
from drivewright.result import Column, Table

QUANTITIES = {  # unit and meaning of the columns of the loads, by the last part of their names
    "carrier_angle": ("rad", "carrier angle"),
    "velocity": ("m/s", "velocity of the rod in the arm"),
    "acceleration": ("m/s^2", "acceleration of the rod in the arm"),
    "rod_force": ("N", "force on the rod along its travel"),
    "force": ("N", "normal force"),
    "pressure": ("Pa", "Hertz pressure"),
    "torque": ("N m", "torque about the planet axis"),
}


def geometry_table(pair: ConjugatePair) -> Table:
    """Pressure angle, curvature and radius of both pitch curves over the turn."""
    samples = [(np.linspace(low, high, SAMPLES), k) for low, high, _, k in pair.pieces]
    t = np.concatenate([angle for angle, _ in samples])
    columns = [
        Column("carrier_angle", "rad", "carrier angle, one turn from the start of the push", t),
        Column("planet_angle", "rad", "rotation of the planet on the carrier", pair.orbit_angle(t).d0),
    ]
    for name, cam in ((cam.name, cam) for cam in pair.cams):
        pressure_angle = np.concatenate([pair.pressure_angle(cam, angle, k).d0 for angle, k in samples])
        curvature = np.concatenate([pair.curvature(cam, angle, k) for angle, k in samples])
        pitch = np.concatenate([pair.pitch(cam, angle, k).d0 for angle, k in samples])
        columns += [
            Column(f"{name}.pressure_angle", "rad", f"pressure angle of the {name} cam, signed", pressure_angle),
            Column(f"{name}.curvature", "1/m", f"curvature of the {name} pitch curve, convex positive", curvature),
            Column(
                f"{name}.convex_ratio",
                "-",
                f"roller over convex radius, {name} cam",
                curvature * cam.roller_radius,
                f"roller over convex radius, {name} cam",
            ),
            Column(f"{name}.pitch_radius", "m", f"pitch radius of the {name} cam", np.abs(pitch)),
        ]
    return Table("cams", "Cam geometry over the push cycle", tuple(columns))


class DrivenMass(NamedTuple):
    """What the lever drives: speed of the driving angle [rad/s], mass [kg], force [N] against it in the rise; and the rollers that bear it:
    face width [m], effective modulus [Pa]."""

    speed: float
    mass: float
    resistance: float
    face_width: float
    modulus: float


def load_table(pair: ConjugatePair, driven: DrivenMass) -> Table:
    """Motion of the mass, normal force and Hertz pressure of both rollers, torque about the orbit's axis: no clearance, no friction."""
    rows = [_loads(pair, driven, piece) for piece in pair.pieces]
    data = {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}
    return Table("load", "Loads over the push cycle", tuple(_load_column(name, column) for name, column in data.items()))


def _load_column(name: str, data: Floats) -> Column:
    """The column "force", or that of one cam: "main.force"."""
    cam, _, quantity = name.rpartition(".")
    unit, meaning = QUANTITIES[quantity]
    return Column(name, unit, f"{meaning} on the {cam} cam" if cam else meaning, data)


def _loads(pair: ConjugatePair, driven: DrivenMass, piece: SmoothPiece) -> dict[str, Floats]:
    """On one smooth piece: the mass needs m a + resistance; the main cam gives the positive part, the return cam the rest."""
    t, k = np.linspace(piece.low, piece.high, SAMPLES), piece.number
    travel, swing = pair.travel(t, k), pair.swing(t, k)
    acceleration = travel.d2 * driven.speed**2
    required = driven.mass * acceleration + (driven.resistance if piece.phase == "rise" else 0.0)
    moment = pair.lever_moment(required, swing.d0)
    row = {"carrier_angle": t, "velocity": travel.d1 * driven.speed, "acceleration": acceleration, "rod_force": required}
    row["torque"] = moment * swing.d1 / pair.orbit_angle(t).d1
    for cam in pair.cams:
        force = pair.roller_force(cam, moment, t, k)
        row[f"{cam.name}.force"] = force
        row[f"{cam.name}.pressure"] = roller_pressure(
            force, pair.curvature(cam, t, k), cam.roller_radius, driven.face_width, driven.modulus
        )
    return row


def contact_table(run: LeverRun, start: float) -> Table:
    """Forces of both rollers and deviation of the mass in the last turn of a run with clearance, from the driving angle `start` [rad]."""
    columns = (
        Column("carrier_angle", "rad", "carrier angle", start + run.angle),
        Column("main.force", "N", "normal force on the main cam", run.main),
        Column("return.force", "N", "normal force on the return cam", run.back),
        Column("rod_error", "m", "deviation of the rod from its programme, positive ahead of it", run.deviation, "Rod error"),
    )
    return Table("contact", "Contact over the last simulated turn", columns)
