"""The drive on screen and for manufacture: scene, plots, drawings, parts.

The crank turns counter-clockwise about the origin; the axis of the wheel is to the right of it.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.mechanisms.geneva.handles import handles
from drivewright.result import Plot, Result
from drivewright.scene import Body, Drawing, Frame, Part, Prism, Scene, Shape, Trace, capsule, circle, polygon

FRAMES = 361
PIN_WALL = 1.6  # radius of the crank's end over that of the pin
SHAFT = 0.3  # radius of a shaft that has no bore, over the room that it has
BESIDE, LEAST = 0.7, 0.12  # ... of a crank, over the depth of its relief, and at least over the locking radius
PLATE = 0.8  # thickness of the crank over that of the wheel
GAP = 0.05  # between crank and wheel, over the thickness of the wheel


# -- the moving picture ----------------------------------------------------------------------------------------------------------


def scene(model: GenevaModel) -> Scene:
    """Crank and wheel over one turn of the crank, from the middle of one dwell to that of the next."""
    u = np.linspace(0.0, 1.0, FRAMES)
    angle, still = model.crank.at(u)[0], np.zeros((FRAMES, 3))
    crank, wheel = _poses(0.0, angle), _poses(model.step.centre_distance, wheel_turn(model, angle))
    bodies = (
        Body("crank", "crank with locking disc", tuple(_crank_shapes(model)), crank, "blue"),
        Body("wheel", "Geneva wheel", tuple(_wheel_shapes(model)), wheel, "orange"),
        Body("pin", "pin", tuple(_pin_shapes(model)), crank, "green"),
        Body("frame", "frame", tuple(_ground(model)), still, "ground"),
    )
    frames = (
        Frame("machine", "machine frame", still),
        Frame("wheel", "seen from the wheel", wheel),
        Frame("crank", "seen from the crank", crank),
    )
    traces = (Trace("pin", "path of the pin", "pin", (model.step.crank_radius, 0.0)),)
    starts = [model.crank.part_at(side * model.step.half_engagement) for side in (-1, 1)]
    cycle, label, unit = (angle, "crank angle", "rad") if model.steady else (u * model.crank.period, "time", "s")
    marks = tuple((float(np.interp(start, u, cycle)), name) for start, name in zip((0.0, *starts), ("dwell", "step", "dwell"), strict=True))
    return Scene(cycle, label, unit, model.crank.period, bodies, frames, traces, "motion", marks, tuple(handles(model)))


def wheel_turn(model: GenevaModel, angle: np.ndarray) -> np.ndarray:
    """Turn of the wheel [rad], slot 0 being the one that the pin takes, at crank angles from -pi to pi."""
    engaged = np.abs(angle) <= model.step.half_engagement
    return np.pi + model.step.half_pitch - model.step.wheel(angle, engaged).d0


def _poses(x, angle):
    return np.stack(np.broadcast_arrays(np.full(len(angle), x), 0.0 * angle, angle), axis=1)


def _crank_shapes(model: GenevaModel) -> Iterator[Shape]:
    """Arm and locking disc; the disc lies in the plane of the wheel."""
    yield Shape("body", arm_outline(model))
    yield Shape("profile", model.shape.disc_outline)
    yield Shape("hole", circle((0.0, 0.0), shaft_radius(model, "crank")))


def arm_outline(model: GenevaModel) -> Any:
    """The arm that carries the pin, below the wheel."""
    return capsule((0.0, 0.0), (model.step.crank_radius, 0.0), PIN_WALL * model.spec.pin.radius)


def shaft_radius(model: GenevaModel, name: str) -> float:
    """Radius of the shaft of crank or wheel: of the bore that is given, else one that fits."""
    bore = model.spec.locking.bore if name == "crank" else model.spec.wheel.bore
    if bore:
        return bore / 2
    if name == "wheel":
        return SHAFT * model.shape.slot_bottom
    return min(SHAFT * model.shape.locking_radius, max(BESIDE * model.shape.relief_depth, LEAST * model.shape.locking_radius))


def _wheel_shapes(model: GenevaModel) -> Iterator[Shape]:
    yield Shape("profile", model.shape.wheel_outline)
    yield Shape("hole", circle((0.0, 0.0), shaft_radius(model, "wheel")))
    if hub := model.spec.wheel.hub_diameter:
        yield Shape("base", circle((0.0, 0.0), hub / 2), "hub")


def _pin_shapes(model: GenevaModel) -> Iterator[Shape]:
    centre = (model.step.crank_radius, 0.0)
    yield Shape("roller", circle(centre, model.spec.pin.radius))
    if model.spec.pin.kind == "roller":
        yield Shape("hole", circle(centre, model.journal_radius))


def _ground(model: GenevaModel) -> Iterator[Shape]:
    for name, x in (("crank", 0.0), ("wheel", model.step.centre_distance)):
        yield Shape("ground", circle((x, 0.0), 0.7 * shaft_radius(model, name)))


# -- plots -----------------------------------------------------------------------------------------------------------------------


def plots(result: Result[Any]) -> tuple[Plot, ...]:
    """All plots; over time where the crank does not turn at constant speed."""
    over = result.tables["motion"].columns[0].name if "motion" in result.tables else "angle"
    return tuple(plot for plot in _all(over) if plot.table in result.tables)


def _all(over: str) -> Iterator[Plot]:
    limit = (("contact_pressure", "limit"),)
    yield Plot("motion", "Motion of the wheel", "motion", over, ("wheel", "wheel_speed", "wheel_acceleration", "wheel_jerk"))
    yield Plot("crank_motion", "Speed of crank and wheel", "motion", over, ("crank_speed", "wheel_speed"))
    yield Plot("step", "Step over the crank angle", "step", "angle", ("rate", "bend", "third"))
    yield Plot("pin_force", "Force of the pin in the slot", "forces", over, ("drive_force", "brake_force"))
    yield Plot("pressure", "Hertz pressure of pin and slot", "forces", over, ("drive_pressure", "brake_pressure"), limit)
    yield Plot("torque", "Torque on the wheel and at the crank", "torque", over, ("load_torque", "crank_torque"))
    yield Plot("power", "Power at the crank", "torque", over, ("crank_power", "pin_loss"))
    yield Plot("sliding", "Sliding speed of the pin", "forces", over, ("sliding_speed",))
    yield Plot("bearing_force", "Force on the bearing of the wheel", "forces", over, ("bearing_force",))
    yield Plot("locking", "Clearance of the locking disc", "locking", "angle", ("distance",), (("locking_clearance", "limit"),))


# -- drawings and parts ----------------------------------------------------------------------------------------------------------


def drawings(model: GenevaModel) -> tuple[Drawing, ...]:
    """Wheel and locking disc as flat parts."""
    name, thickness = model.spec.title or "Geneva drive", model.spec.wheel.thickness
    wheel = [Shape("profile", model.shape.wheel_outline), *_bore(model.spec.wheel.bore), *_axes(model.shape.outer_radius)]
    disc = [Shape("profile", model.shape.disc_outline), *_bore(model.spec.locking.bore), *_axes(model.shape.locking_radius)]
    return (Drawing("wheel", f"{name}: wheel", tuple(wheel), thickness), Drawing("disc", f"{name}: locking disc", tuple(disc), thickness))


def _bore(diameter: float | None) -> Iterator[Shape]:
    if diameter:
        yield Shape("hole", circle((0.0, 0.0), diameter / 2))


def _axes(radius: float) -> Iterator[Shape]:
    reach = 1.1 * radius
    for pair in (((-reach, 0.0), (reach, 0.0)), ((0.0, -reach), (0.0, reach))):
        yield Shape("axis", polygon(pair, closed=False))


def parts(model: GenevaModel) -> tuple[Part, ...]:
    """Crank with locking disc, pin, and wheel with hub, in the middle of the dwell."""
    thickness, spec = model.spec.wheel.thickness, model.spec
    gap, plate = GAP * thickness, PLATE * thickness
    angle = -np.pi
    crank, wheel = (0.0, 0.0, angle), (model.step.centre_distance, 0.0, float(wheel_turn(model, np.array(angle))))
    holes = tuple(circle((0.0, 0.0), bore / 2) for bore in [spec.locking.bore] if bore)
    arm = Prism(arm_outline(model), holes, -gap - plate, plate)
    disc = Prism(model.shape.disc_outline, holes, -gap, thickness + gap)
    base = Prism(circle((0.0, 0.0), max(PIN_WALL * spec.pin.radius, 1.5 * shaft_radius(model, "crank"))), holes, -gap - plate, plate)
    pin = Prism(circle((model.step.crank_radius, 0.0), spec.pin.radius), (), -gap, thickness + gap)
    return (
        Part("crank", (arm, base, disc), crank, "blue"),
        Part("pin", (pin,), crank, "green"),
        Part("wheel", tuple(_wheel_solids(model)), wheel, "orange"),
    )


def _wheel_solids(model: GenevaModel) -> Iterator[Prism]:
    wheel = model.spec.wheel
    bore = tuple(circle((0.0, 0.0), diameter / 2) for diameter in [wheel.bore] if diameter)
    yield Prism(model.shape.wheel_outline, bore, 0.0, wheel.thickness)
    if wheel.hub_diameter:
        yield Prism(circle((0.0, 0.0), wheel.hub_diameter / 2), bore, wheel.thickness, wheel.hub_length)
