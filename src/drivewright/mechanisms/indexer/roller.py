"""Profile, contacts, play and stress of roller-gear cams, barrel and globoidal."""

import numpy as np

from drivewright.indexing import roller_gear
from drivewright.indexing.motion import TURN
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.geometry import WAYS, play_answer
from drivewright.result import Answer, Answers, Array, Check, Column, Table, Value

STEPS = 181  # input angles over the turn
ALONG = 9  # places along a roller


def surface(model: IndexerModel, done: Answers) -> Answer:
    """Flanks of the cam over the turn, trimmed by every roller: points, curvature, pressure angle, undercut."""
    angle = np.linspace(0, TURN, STEPS) if model.spec.load.angle is None else model.angles
    flanks = roller_gear.compute_flanks(model.cam, angle, ALONG)
    touch, limits = flanks.contact, model.spec.limits
    values = {
        "profile.undercut": Value(float(flanks.undercut), "-", "part of the contact lines that is cut away"),
        "profile.pitch_radius": Value(float(model.cam.pitch_radius), "m", "least distance of the rollers' middles from the cam's axis"),
    }
    relative = flanks.mask_off_cam(touch.relative_curvature)
    checks = [Check("undercut", float(flanks.undercut), 0.0, "<=", "-", "part of the contact lines that is cut away", ("cam",), True)]
    if np.isfinite(relative).any():
        values["profile.min_relative_radius"] = Value(float(1 / np.nanmax(relative)), "m", "least relative radius of roller and cam")
    worst = flanks.pressure_angle_maximum
    if np.isfinite(worst).any():
        values["pressure_angle.maximum"] = Value(float(np.nanmax(worst)), "rad", "largest pressure angle of all contact lines")
        checks.append(
            Check(
                "pressure_angle",
                float(np.nanmax(worst)),
                limits.pressure_angle,
                "<=",
                "rad",
                "angle between the normal and the roller's way, all contact lines",
                ("cam", "wheel"),
            )
        )
    return Answer(values, (_surface_table(flanks),), tuple(checks), data=flanks)


def _surface_table(flanks: roller_gear.CamFlanks) -> Table:
    """Points of the finished cam in its own frame, y along its axis."""
    flank, roller, theta, u = np.nonzero(flanks.on_cam)
    touch = flanks.contact
    at = touch.point[flanks.on_cam]
    return Table(
        "profile",
        "Flanks of the cam",
        (
            Column("angle", "rad", "input angle", flanks.theta[theta]),
            Column("pin", "-", "roller", np.array(flanks.cam.rollers, float)[roller]),
            Column("flank", "-", "1 pushes the wheel forward, -1 backward", roller_gear.FLANKS[flank]),
            Column("along", "m", "along the roller from its middle", flanks.u[u]),
            Column("x", "m", "from the cam's axis", at[:, 0]),
            Column("y", "m", "along the cam's axis", at[:, 1]),
            Column("z", "m", "from the cam's axis", at[:, 2]),
            Column(
                "curvature",
                "1/m",
                "of the cam across the contact line, positive where it is convex",
                np.broadcast_to(touch.cam_curvature, flanks.on_cam.shape)[flanks.on_cam],
            ),
            Column(
                "pressure_angle",
                "rad",
                "between normal and the roller's way",
                np.broadcast_to(touch.pressure_angle, flanks.on_cam.shape)[flanks.on_cam],
            ),
        ),
    )


def contact_map(model: IndexerModel, done: Answers) -> Answer:
    """Which rollers touch which flank at every input angle."""
    flanks = done["profile"].data
    forward, backward = (np.sum(side, axis=0) for side in flanks.contact_map)
    count = np.sum(flanks.contact_map.any(axis=0), axis=0)
    values = {
        "contacts.minimum": Value(float(count.min()), "-", "fewest rollers that touch the cam"),
        "contacts.maximum": Value(float(count.max()), "-", "most rollers that touch the cam"),
    }
    table = Table(
        "contacts",
        "Rollers in contact with the cam",
        (
            Column("angle", "rad", "input angle", flanks.theta),
            Column("pins", "-", "rollers that touch", count.astype(float)),
            Column("forward", "-", "rollers that the cam can push forward", forward.astype(float)),
            Column("backward", "-", "rollers that the cam can push backward", backward.astype(float)),
            Column("pressure_angle", "rad", "largest pressure angle", flanks.pressure_angle_maximum),
        ),
    )
    way = flanks.contact_map[0].astype(float) - flanks.contact_map[1]
    names = (tuple(f"{np.degrees(angle):.6g} deg" for angle in flanks.theta), tuple(str(k) for k in flanks.cam.rollers))
    return Answer(values, (table,), (), (), {"contact_map": Array("-", ("angle", "pin"), names, way.T)})


def free_play(model: IndexerModel, done: Answers) -> Answer:
    """Free rotation of the wheel in either direction."""
    flanks = done["profile"].data
    free = {name: np.where(np.isfinite(turn := roller_gear.find_turret_play(flanks, way)), turn, np.nan) for name, way in WAYS}
    return play_answer(model, flanks.theta, free)


def stress(model: IndexerModel, done: Answers) -> tuple[Table, tuple[str, ...]]:
    """Forces and Hertz pressure of the rollers under the torque."""
    flanks = done["profile"].data
    loads = roller_gear.compute_roller_loads(flanks, model.torque, model.modulus)
    pressure = np.nanmax(np.where(np.isfinite(loads.pressure), loads.pressure, -1.0), axis=2)
    roller, theta = np.nonzero(np.nan_to_num(loads.force) > 0)
    data = (flanks.theta[theta], np.array(flanks.cam.rollers, float)[roller], loads.force[roller, theta], pressure[roller, theta])
    order = np.argsort(data[0], kind="stable")
    table = Table(
        "pin_forces",
        "Forces of the cam on the rollers",
        tuple(
            Column(name, unit, words, column[order])
            for (name, unit, words), column in zip(
                (
                    ("angle", "rad", "input angle"),
                    ("pin", "-", "roller"),
                    ("force", "N", "force on the roller"),
                    ("pressure", "Pa", "Hertz pressure"),
                ),
                data,
                strict=True,
            )
        ),
    )
    lost = np.isnan(loads.line_load)
    findings = (f"nothing carries the torque at {np.sum(lost)} of {len(lost)} input angles",) if lost.any() else ()
    return table, findings
