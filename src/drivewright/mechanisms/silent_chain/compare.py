"""Designs beside this one: what the rolling radius trades, and what links and tooth numbers do to the phase."""

import numpy as np

from drivewright.chains import meshing as published
from drivewright.chains.closure import Drive, phase_map
from drivewright.chains.link import design_link
from drivewright.chains.stress.rolling import rolling_contact
from drivewright.mechanisms.silent_chain.build import ChainModel, offset_of
from drivewright.mechanisms.silent_chain.contact import no_contact
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec
from drivewright.mechanisms.silent_chain.strands import strand_force
from drivewright.result import Answer, Answers, Column, Table, Value

OVER_PITCH = (0.02, 0.04, 0.07, 0.1, 0.126, 0.17, 0.25, 0.35, 0.5, 0.78)  # rolling radii looked at, unless told otherwise
AROUND = 4  # links on either side of the design's
POSITIONS = 24  # of a closure in a tooth


def no_comparison(spec: SilentChainSpec) -> str | None:
    """Why there is none."""
    if spec.joint.kind == "revolute":
        return "a revolute joint has no rolling radius to compare"
    return "it is for two sprockets" if spec.sprockets else no_contact(spec)


def no_phase_map(spec: SilentChainSpec) -> str | None:
    """Why there is none."""
    return "it is for two sprockets" if spec.sprockets else None


def trade_off(model: ChainModel, done: Answers) -> Answer:
    """Fluctuation, deviation of the published measure and contact pressure over the rolling radius."""
    radii = _radii(model)
    closures = _closed(model, [(r, model.spec.links, model.teeth[1]) for r in radii])
    force = model.spec.contact.force or strand_force(model)
    pressure = [_pressure(model, r, force) for r in radii]
    columns = [
        Column("rolling_radius", "m", "rolling radius of the pins", radii),
        Column("fluctuation", "m", "fluctuation of the centre distance", closures[:, 1]),
        Column("transmission_error", "rad", "transmission error, greatest less least", closures[:, 2]),
        Column("mean", "m", "mean centre distance", closures[:, 0]),
        Column(
            "running_deviation",
            "m",
            "mean centre distance less that of a hinged chain",
            closures[:, 0] - _closed(model, [(0.0, model.spec.links, model.teeth[1])])[0, 0],
        ),
        *_published(model, radii),
        Column("contact_pressure", "Pa", f"Hertz pressure of the pins under {force:.4g} N", np.array(pressure)),
    ]
    return Answer({}, (Table("trade_off", "What the rolling radius trades", tuple(columns)),))


def phases(model: ChainModel, done: Answers) -> Answer:
    """Fluctuation over the number of links, for rolling radii and tooth numbers."""
    given, spec = model.spec.compare, model.spec
    links = given.links or range(max(spec.links - AROUND, max(model.teeth) + 2), spec.links + AROUND + 1)
    radii = [0.0] if spec.joint.kind == "revolute" else given.rolling_radii or (0.0, model.link.radius, 0.78 * spec.pitch)
    cases = [(r, n, z) for z in given.driven_teeth or (model.teeth[1],) for r in radii for n in links]
    found = _closed(model, cases)
    radius, count, teeth = np.array(cases, float).T
    names = np.array([f"r {1e3 * r:.4g} mm, z {model.teeth[0]}/{z}" for r, _, z in cases])
    table = Table(
        "phase_map",
        "Fluctuation by the number of links",
        (
            Column("links", "-", "links of the chain", count),
            Column("rolling_radius", "m", "rolling radius", radius),
            Column("driven_teeth", "-", "teeth of the driven sprocket", teeth),
            Column("design", "-", "rolling radius and teeth", names),
            Column("fluctuation", "m", "fluctuation of the centre distance", found[:, 1]),
            Column("transmission_error", "rad", "transmission error, greatest less least", found[:, 2]),
        ),
    )
    missing = int(np.sum(~np.isfinite(found[:, 1])))
    findings = (f"phase map: {missing} of {len(cases)} chains do not close",) if missing else ()
    if missing == len(cases):
        return Answer({}, (table,), (), findings)
    best = int(np.nanargmin(found[:, 1]))
    values = {"phase_map.least_fluctuation": Value(found[best, 1], "m", f"least in the phase map: {count[best]:.0f} links, {names[best]}")}
    return Answer(values, (table,), (), findings)


def _radii(model):
    """Rolling radii, ascending, above 0."""
    given = [r for r in model.spec.compare.rolling_radii if r > 0]
    return np.array(sorted(given or {*(share * model.spec.pitch for share in OVER_PITCH), model.link.radius}))


def _closed(model, cases):
    """(mean, fluctuation, transmission error) (n, 3) of chains (radius, links, driven teeth); nan where one does not close."""
    spec = model.spec
    drives = [
        Drive(model.lengthened(design_link(spec.pitch, r, spec.plate.flank_angle, 0.0)), model.teeth[0], z, n, spec.closure.strands)
        for r, n, z in cases
    ]
    rows = phase_map(drives, POSITIONS).rows
    return np.array([(row.value.mean, row.value.fluctuation, row.value.transmission_ripple) if row.ok else (np.nan,) * 3 for row in rows])


def _published(model, radii):
    """Columns of the published measure."""
    if model.spec.roller:
        return
    for number, side in enumerate(("drive", "driven")):
        deviation = [
            published.pitch_deviation(model.spec.pitch, r, offset_of(model.spec, r), model.teeth[number], model.spec.meshing.ideal)
            for r in radii
        ]
        yield Column(f"pitch_deviation_{side}", "m", f"seated less ideal pitch as published, {side}", np.array(deviation))
    yield Column("pin_offset", "m", "offset of the pins", np.array([offset_of(model.spec, r) for r in radii]))


def _pressure(model, radius, force):
    material = model.spec.material
    return float(rolling_contact(force, model.contact_length, (radius, radius), material.youngs_modulus, material.poisson_ratio).pressure)
