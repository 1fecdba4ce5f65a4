"""Comparison designs: trade-offs over the rolling radius, and the phase map over links and tooth numbers."""

import numpy as np

from drivewright.chains import meshing as published
from drivewright.chains.closure import Drive
from drivewright.chains.closure.comparison import closure_numbers, phase_map_table
from drivewright.chains.link import design_link
from drivewright.chains.stress.rolling import rolling_contact
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel, offset_of
from drivewright.mechanisms.silent_chain.meshing import SIDE_WORDS
from drivewright.result import Answer, Answers, Column, Table, Value

OVER_PITCH = (0.02, 0.04, 0.07, 0.1, 0.126, 0.17, 0.25, 0.35, 0.5, 0.78)  # rolling radii compared by default
AROUND = 4  # links on either side of the design's


def trade_off(model: ChainModel, done: Answers) -> Answer:
    """Fluctuation, deviation of the published measure and contact pressure over the rolling radius."""
    radii, material, force = _radii(model), model.spec.material, model.row_force
    links, driven = model.spec.links, model.teeth[1]
    mean, fluctuation, ripple = closure_numbers([_drive(model, r, links, driven) for r in radii]).T
    hinged = closure_numbers([_drive(model, 0.0, links, driven)])[0, 0]
    contact = rolling_contact(force, model.contact_length, (radii, radii), material.youngs_modulus, material.poisson_ratio)
    hertz = f"Hertz pressure between the pins at {force:.4g} N"
    columns = [
        Column("rolling_radius", "m", "rolling radius of the pins", radii),
        Column("fluctuation", "m", "peak-to-peak centre distance", fluctuation),
        Column("transmission_error", "rad", "peak-to-peak transmission error", ripple),
        Column("mean", "m", "mean centre distance", mean),
        Column(
            "running_deviation", "m", "mean centre distance minus that of a hinged chain", mean - hinged, "Deviation from a hinged chain"
        ),
        *([] if model.spec.roller else _published(model, radii)),
        Column("contact_pressure", "Pa", hertz, np.asarray(contact.pressure), "Hertz pressure between the pins"),
    ]
    return Answer({}, (Table("trade_off", "Trade-offs over the rolling radius", tuple(columns)),))


def phases(model: ChainModel, done: Answers) -> Answer:
    """Fluctuation over the number of links, for rolling radii and tooth numbers."""
    given, spec = model.spec.compare, model.spec
    links = given.links or range(max(spec.links - AROUND, max(model.teeth) + 2), spec.links + AROUND + 1)
    radii = [0.0] if model.joint_kind == "revolute" else given.rolling_radii or (0.0, model.link.radius, 0.78 * spec.pitch)
    drives = [_drive(model, r, n, z) for z in given.driven_teeth or (model.teeth[1],) for r in radii for n in links]
    numbers = closure_numbers(drives)
    table, fluctuation = phase_map_table(drives, numbers), numbers[:, 1]
    missing = int(np.sum(~np.isfinite(fluctuation)))
    findings = (
        (f"phase map: {missing} of {len(drives)} chains do not close and have no numbers; change links or teeth in [compare]",)
        if missing
        else ()
    )
    if missing == len(drives):
        return Answer({}, (table,), (), findings)
    best = int(np.nanargmin(fluctuation))
    meaning = f"minimum peak-to-peak centre distance in the phase map: {drives[best].links} links, {table['design'].data[best]}"
    label = "Minimum fluctuation in the phase map"
    return Answer({"phase_map.least_fluctuation": Value(fluctuation[best], "m", meaning, label=label)}, (table,), (), findings)


def _radii(model):
    """Rolling radii, ascending, above 0."""
    given = [r for r in model.spec.compare.rolling_radii if r > 0]
    return np.array(sorted(given or {*(share * model.spec.pitch for share in OVER_PITCH), model.link.radius}))


def _drive(model, radius, links, driven_teeth):
    """The drive with another rolling radius [m], number of links and teeth of the driven sprocket."""
    link = model.lengthened(design_link(model.spec.pitch, radius, model.spec.plate.flank_angle, 0.0))
    return Drive(link, model.teeth[0], driven_teeth, links, model.spec.closure.strands)


def _published(model, radii):
    """Columns of the published measure."""
    offset = np.broadcast_to(offset_of(model.spec, radii), radii.shape)
    for side, teeth in zip(SIDES, model.teeth, strict=True):
        deviation = published.pitch_deviation(model.spec.pitch, radii, offset, teeth, model.spec.meshing.ideal)
        yield Column(
            f"pitch_deviation_{side}",
            "m",
            f"pitch deviation (seated minus ideal), {SIDE_WORDS[side]}",
            np.asarray(deviation),
            f"Pitch deviation, {SIDE_WORDS[side]}",
        )
    yield Column("pin_offset", "m", "pin offset", offset)
