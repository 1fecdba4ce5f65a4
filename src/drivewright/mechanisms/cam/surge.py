"""Surge of the spring: its natural frequency, the harmonic of the cam that meets it, and the force that it adds."""

import numpy as np

from drivewright import cams
from drivewright.cams.cycle import Quantity
from drivewright.cams.spring_surge import COARSE, SAMPLES, PeriodicSurge
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.cam.spec import TURN, CamSpec
from drivewright.result import Answer, Answers, Check, Column, Table, Value

SHOWN = 40  # harmonics in the table, at least
ASIDE = 1.5  # jump speeds with surge are looked for up to so many times the one without


def no_surge(spec: CamSpec) -> str | None:
    """Why there is no surge to compute, or None."""
    if spec.drive is None:
        return "no [drive] speed"
    return None if spec.spring and spec.spring.mass and spec.spring.stiffness else "no [spring] mass"


def surge_force(model: CamModel) -> Quantity:
    """Force of surge along the follower's travel [N], of the jets of angle and lift."""
    surge = model.surge
    assert surge is not None
    return lambda angle, lift: model.path.ratio(lift) * surge.force(angle)


def jump_with_surge(model: CamModel, quiet: float) -> cams.Jump:
    """The `Jump` with surge, between an eighth and `ASIDE` times the speed without surge and that of the drive."""
    spring = model.surging_spring
    assert spring is not None
    fine, coarse = (cams.lift_harmonics(model.load_travel, samples) for samples in (SAMPLES, COARSE))

    def force_at(speed, lift):
        """Force along the travel at a speed, of the jets of angle and lift."""
        added = PeriodicSurge(spring, lift, speed).force
        return lambda angle, swing: model.path.force(swing, model.load, speed) + model.path.ratio(swing) * added(angle)

    angle, swing = model.cycle.at_angle(TURN * np.arange(COARSE) / COARSE)
    held, forward, back = (model.path.force(swing, model.load, speed).d0 for speed in (0.0, model.speed, -model.speed))
    inertia, damping = 0.5 * (forward + back) - held, 0.5 * (forward - back)
    ratio = model.path.ratio(swing).d0

    def screen(speed):
        """Least force at equal steps over the turn: without surge it is a square of the speed."""
        part = speed / model.speed
        force = held + part * (damping + part * inertia) + ratio * PeriodicSurge(spring, coarse, speed).sampled()
        place = int(np.argmin(force))
        return cams.Extreme(float(force[place]), float(angle.d0[place]), 0)

    known = [speed for speed in (quiet, model.speed) if np.isfinite(speed) and speed > 0]
    return cams.jump_with_surge(
        screen, lambda speed: model.cycle.minimum(force_at(speed, fine)), min(known) / 8, ASIDE * max(known), spring.damping
    )


def surge(model: CamModel, done: Answers) -> Answer:
    """Natural frequency, the nearest harmonic of the cam, and the force of the spring with surge over the turn."""
    found = model.surge
    assert found is not None
    return Answer(_values(model, found), (_force_table(model, found), _harmonics_table(found)), _checks(model, found))


def _values(model, found):
    harmonic, ratio = found.nearest_harmonic()
    amplitude = abs(found.lift.amplitude[harmonic]) if harmonic < len(found.lift.amplitude) else 0.0
    ends = [extreme(lambda angle, _: found.force(angle)).value for extreme in (model.cycle.maximum, model.cycle.minimum)]
    return {
        "surge.natural_frequency": Value(found.spring.frequency / (2 * np.pi), "Hz", "first natural frequency of the spring, ends held"),
        "surge.harmonic": Value(float(harmonic), "-", "nearest harmonic of the cam, to the spring's first natural frequency"),
        "surge.resonance_speed": Value(model.speed / ratio, "rad/s", "cam speed of surge resonance, by the nearest harmonic"),
        "surge.harmonic_lift": Value(float(amplitude), "m", "lift of the nearest harmonic, amplitude"),
        "surge.max_force": Value(max(map(abs, ends)), "N", "largest force of surge, magnitude, beside the static spring force"),
        "spring.max_force": Value(_spring_force(model, found, model.cycle.maximum), "N", "largest force of the spring, surge included"),
        "spring.min_force": Value(_spring_force(model, found, model.cycle.minimum), "N", "least force of the spring, surge included"),
    }


def _spring_force(model, found, extreme):
    def force(angle, lift):
        return model.load.stiffness * model.path.travel(lift) + model.load.preload + found.force(angle)

    return extreme(force).value


def _checks(model, found):
    least = _spring_force(model, found, model.cycle.minimum)
    message = "the spring stays on its seats: least force of the spring, surge included"
    return (Check("spring_force", least, 0.0, ">=", "N", message, ("spring",), label="Least spring force with surge"),)


def _force_table(model, found):
    angle, lift = model.cycle.sampled()
    static = model.load.stiffness * model.path.travel(lift).d0 + model.load.preload + 0 * angle.d0
    added = found.force(angle).d0
    columns = (
        Column("angle", "rad", "cam angle", angle.d0),
        Column("static_force", "N", "force of the spring without surge", static),
        Column("spring_force", "N", "force of the spring, surge included", static + added),
        Column("surge_force", "N", "force of surge", added),
    )
    return Table("surge", "Force of the spring over the turn", columns)


def _harmonics_table(found):
    """Harmonics of lift and surge, to beyond the first natural frequency."""
    count = min(max(SHOWN, 2 * found.nearest_harmonic()[0]), len(found.lift.amplitude) - 1)
    order = np.arange(1, count + 1)
    columns = (
        Column("harmonic", "-", "harmonic of the cam's turn", order.astype(float)),
        Column("frequency", "Hz", "frequency of the harmonic", order * found.speed / (2 * np.pi)),
        Column("lift", "m", "amplitude of the harmonic in the lift", np.abs(found.lift.amplitude[order])),
        Column("surge_force", "N", "amplitude of the harmonic in the surge", np.abs(found.harmonics.amplitude[order])),
    )
    return Table("surge_harmonics", "Harmonics of lift and surge", columns)
