"""The oil film between cam and follower over the turn, for information."""

import numpy as np

from drivewright import cams
from drivewright.contact import film_ratio
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.cam.loads import no_forces
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.result import Answer, Answers, Column, Table, Value, merge_answers


def no_film(spec: CamSpec) -> str | None:
    """Why there is no film to compute, or None."""
    return no_forces(spec) if spec.lubricant else "no [lubricant]"


def film(model: CamModel, done: Answers) -> Answer:
    """Entrainment speed, film thickness by Dowson and Higginson, and where the entrainment reverses."""
    return merge_answers(_one_film(model, track) for track in model.tracks)


def _one_film(model, track):
    """The film on one surface."""
    if reason := track.without_pressure(model.cycle):
        return Answer(findings=(f"{track.prefix}film is absent: {reason}",))
    rolls = model.spec.follower.face == "roller"
    angle, lift = model.cycle.sampled()
    contact = track.contact(angle, lift)
    speed = cams.entrainment(contact, rolls).d0 * model.speed + 0 * angle.d0
    force = np.maximum(model.normal_force(track, angle, lift).d0 + 0 * angle.d0, 0.0)
    thickness = _thickness(model, track, contact, speed, force)
    places = cams.reversals(model.cycle, lambda a, s: cams.entrainment(track.contact(a, s), rolls))
    values = _values(model, track, contact, force, thickness, places)
    return Answer(values, (_table(model, track, angle.d0, speed, thickness),), findings=tuple(_findings(track, places)))


def _thickness(model, track, contact, speed, force):
    oil, width, modulus = model.spec.lubricant, model.spec.face.width, cams.pair_modulus(model.material)
    return cams.cam_film(contact, speed, force, track.radius, width, modulus, oil.viscosity, oil.pressure_viscosity)


def _values(model, track, contact, force, thickness, places):
    pressure = cams.contact_pressure(force, contact, track.radius, model.spec.face.width, cams.pair_modulus(model.material))
    worst, roughness = int(np.argmax(pressure)), model.spec.lubricant.roughness
    at_worst, of, name = float(thickness.minimum[worst]), track.of, f"{track.prefix}film"
    found = {
        f"{name}.max_thickness": Value(
            float(np.nanmax(thickness.minimum)),
            "m",
            f"maximum over the turn of the steady film thickness{of}",
            label=track.label("Maximum film thickness"),
        ),
        f"{name}.reversals": Value(
            float(len(places)),
            "-",
            f"number of reversals of the entrainment speed per turn{of}",
            label=track.label("Entrainment reversals"),
        ),
    }
    if at_worst > 0:
        found[f"{name}.at_peak_pressure"] = Value(
            at_worst,
            "m",
            f"minimum steady film thickness at the peak Hertz pressure{of}",
            label=track.label("Minimum film thickness, peak pressure"),
        )
        found[f"{name}.central_at_peak_pressure"] = Value(
            float(thickness.central[worst]),
            "m",
            f"central steady film thickness at the peak Hertz pressure{of}",
            label=track.label("Central film thickness, peak pressure"),
        )
    if at_worst > 0 and roughness:
        found[f"{name}.ratio"] = Value(
            float(film_ratio(at_worst, roughness)),
            "-",
            f"minimum film thickness over composite roughness at the peak Hertz pressure{of}",
            label=track.label("Lambda ratio, peak pressure"),
            convention="below 1 the surfaces touch",
        )
    return found if np.any(np.isfinite(thickness.minimum)) else {f"{name}.reversals": found[f"{name}.reversals"]}


def _table(model, track, angle, speed, thickness):
    columns = [
        Column("angle", "rad", "cam angle", angle),
        Column("entrainment_speed", "m/s", f"entrainment speed of the oil{track.of}", speed),
        Column("central_thickness", "m", f"central film thickness{track.of}", thickness.central),
        Column("min_thickness", "m", f"minimum film thickness{track.of}", thickness.minimum),
    ]
    if model.spec.lubricant.roughness:
        ratio = film_ratio(thickness.minimum, model.spec.lubricant.roughness)
        columns.append(Column("film_ratio", "-", f"minimum film thickness over composite roughness{track.of}", ratio, "Lambda ratio"))
    missing = "no contact force there" if np.any(np.isnan(thickness.minimum)) else ""
    return Table(f"film{track.suffix}", track.label("Oil film"), tuple(columns), missing)


def _findings(track, places):
    if len(places):
        angles = ", ".join(f"{np.degrees(place % (2 * np.pi)):.1f}" for place in places)
        yield (
            f"the entrainment speed{track.of} reverses at the cam angles {angles}°: the steady film thickness is zero there, and the "
            "squeeze film is not computed"
        )
