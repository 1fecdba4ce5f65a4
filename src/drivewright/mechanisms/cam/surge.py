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
        "surge.natural_frequency": Value(
            found.spring.frequency / (2 * np.pi),
            "Hz",
            "first natural frequency of the spring with both ends held",
            label="Natural frequency of the spring",
        ),
        "surge.harmonic": Value(
            float(harmonic),
            "-",
            "harmonic of the cam nearest to the first natural frequency of the spring",
            label="Harmonic nearest to resonance",
        ),
        "surge.resonance_speed": Value(
            model.speed / ratio,
            "rad/s",
            "cam speed at which the nearest harmonic meets the first natural frequency of the spring",
            label="Cam speed of surge resonance",
        ),
        "surge.harmonic_lift": Value(
            float(amplitude), "m", "amplitude of the nearest harmonic in the lift", label="Lift amplitude of the nearest harmonic"
        ),
        "surge.max_force": Value(
            max(map(abs, ends)),
            "N",
            "maximum magnitude of the force that surge adds to the static spring force",
            label="Maximum surge force",
        ),
        **{
            f"spring.{name}_force": Value(
                _spring_force(model, found, extreme),
                "N",
                f"{words} force of the spring, surge included",
                label=f"{words.capitalize()} spring force",
            )
            for name, words, extreme in (("max", "maximum", model.cycle.maximum), ("min", "minimum", model.cycle.minimum))
        },
    }


def _spring_force(model, found, extreme):
    def force(angle, lift):
        return model.load.stiffness * model.path.travel(lift) + model.load.preload + found.force(angle)

    return extreme(force).value


def _checks(model, found):
    least = _spring_force(model, found, model.cycle.minimum)
    message = "minimum force of the spring, surge included; below 0 the spring leaves its seats: increase its preload"
    return (Check("spring_force", least, 0.0, ">=", "N", message, ("spring",), label="Minimum spring force with surge"),)


def _force_table(model, found):
    angle, lift = model.cycle.sampled()
    static = model.load.stiffness * model.path.travel(lift).d0 + model.load.preload + 0 * angle.d0
    added = found.force(angle).d0
    columns = (
        Column("angle", "rad", "cam angle", angle.d0),
        Column("static_force", "N", "spring force without surge", static),
        Column("spring_force", "N", "spring force, surge included", static + added, "Spring force with surge"),
        Column("surge_force", "N", "surge force", added),
    )
    return Table("surge", "Spring force over the turn", columns)


def _harmonics_table(found):
    """Harmonics of lift and surge, to beyond the first natural frequency."""
    count = min(max(SHOWN, 2 * found.nearest_harmonic()[0]), len(found.lift.amplitude) - 1)
    order = np.arange(1, count + 1)
    columns = (
        Column("harmonic", "-", "harmonic of the cam's rotation", order.astype(float)),
        Column("frequency", "Hz", "frequency of the harmonic", order * found.speed / (2 * np.pi)),
        Column("lift", "m", "lift amplitude of the harmonic", np.abs(found.lift.amplitude[order])),
        Column("surge_force", "N", "surge force amplitude of the harmonic", np.abs(found.harmonics.amplitude[order])),
    )
    return Table("surge_harmonics", "Harmonics of lift and surge", columns)
