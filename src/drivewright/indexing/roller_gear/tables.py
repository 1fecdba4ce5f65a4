"""Flanks, contacts and loads of a roller gear as tables and values."""

import numpy as np

from drivewright.indexing.roller_gear.flanks import FLANKS, CamFlanks
from drivewright.indexing.roller_gear.stress import RollerLoads
from drivewright.result import Array, Column, Table, Value


def flank_table(flanks: CamFlanks) -> Table:
    """Points of the finished cam in its own frame, y along its axis."""
    flank, roller, theta, u = np.nonzero(flanks.on_cam)
    touch = flanks.contact
    at = touch.point[flanks.on_cam]
    curvature, pressure_angle = (
        np.broadcast_to(each, flanks.on_cam.shape)[flanks.on_cam] for each in (touch.cam_curvature, touch.pressure_angle)
    )
    across = "curvature of the cam across the contact line"
    return Table(
        "profile",
        "Flanks of the cam",
        (
            Column("angle", "rad", "input angle", flanks.theta[theta]),
            Column("pin", "-", "roller", np.array(flanks.cam.rollers, float)[roller]),
            Column("flank", "-", "flank, 1 pushes the wheel forward, -1 backward", FLANKS[flank]),
            Column("along", "m", "position along the roller, from its middle", flanks.u[u]),
            Column("x", "m", "coordinate x from the cam's axis", at[:, 0], "Coordinate x"),
            Column("y", "m", "coordinate y along the cam's axis", at[:, 1], "Coordinate y"),
            Column("z", "m", "coordinate z from the cam's axis", at[:, 2], "Coordinate z"),
            Column("curvature", "1/m", f"{across}, positive where convex", curvature, "Curvature across the contact line"),
            Column("pressure_angle", "rad", "pressure angle, between the normal and the motion of the roller", pressure_angle),
        ),
    )


def flank_values(flanks: CamFlanks) -> dict[str, Value]:
    """Undercut, radii and largest pressure angle of the finished cam; without those of a cam of which nothing is left."""
    values = {
        "profile.undercut": Value(float(flanks.undercut), "-", "share of the contact lines lost to undercut", label="Undercut"),
        "profile.pitch_radius": Value(
            float(flanks.cam.pitch_radius),
            "m",
            "minimum distance of the roller middles from the cam's axis",
            label="Pitch radius of the cam",
        ),
    }
    relative = flanks.mask_off_cam(flanks.contact.relative_curvature)
    if np.isfinite(relative).any():
        meaning = "minimum relative radius of curvature of roller and cam"
        values["profile.min_relative_radius"] = Value(
            float(1 / np.nanmax(relative)), "m", meaning, label="Minimum relative radius of curvature"
        )
    if np.isfinite(flanks.pressure_angle_maximum).any():
        largest = float(np.nanmax(flanks.pressure_angle_maximum))
        values["pressure_angle.maximum"] = Value(
            largest, "rad", "maximum pressure angle over all contact lines", label="Maximum pressure angle"
        )
    return values


def contact_count_table(flanks: CamFlanks) -> Table:
    """How many rollers touch the cam at every input angle, and on which flank."""
    forward, backward = (np.sum(side, axis=0) for side in flanks.contact_map)
    count = np.sum(flanks.contact_map.any(axis=0), axis=0)
    return Table(
        "contacts",
        "Rollers in contact with the cam",
        (
            Column("angle", "rad", "input angle", flanks.theta),
            Column("pins", "-", "rollers in contact", count.astype(float)),
            Column("forward", "-", "rollers that the cam can push forward", forward.astype(float)),
            Column("backward", "-", "rollers that the cam can push backward", backward.astype(float)),
            Column("pressure_angle", "rad", "maximum pressure angle", flanks.pressure_angle_maximum),
        ),
    )


def contact_map_array(flanks: CamFlanks) -> Array:
    """(angle, roller): 1 where the roller touches the flank that pushes it forward, -1 where it touches the other, 0 elsewhere or both."""
    way = flanks.contact_map[0].astype(float) - flanks.contact_map[1]
    names = (tuple(f"{np.degrees(angle):.6g}°" for angle in flanks.theta), tuple(str(k) for k in flanks.cam.rollers))
    return Array("-", ("angle", "pin"), names, way.T)


def roller_force_table(flanks: CamFlanks, loads: RollerLoads) -> Table:
    """Force and largest Hertz pressure of every loaded roller, one row each, in the order of the input angle."""
    pressure = np.nanmax(np.where(np.isfinite(loads.pressure), loads.pressure, -1.0), axis=2)
    roller, theta = np.nonzero(np.nan_to_num(loads.force) > 0)
    order = np.argsort(flanks.theta[theta], kind="stable")
    roller, theta = roller[order], theta[order]
    return Table(
        "pin_forces",
        "Forces on the rollers",
        (
            Column("angle", "rad", "input angle", flanks.theta[theta]),
            Column("pin", "-", "roller", np.array(flanks.cam.rollers, float)[roller]),
            Column("force", "N", "force on the roller", loads.force[roller, theta]),
            Column("pressure", "Pa", "Hertz pressure", pressure[roller, theta]),
        ),
    )
