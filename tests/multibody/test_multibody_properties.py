"""What any planar multibody kernel must keep: its twin in closed form, energy, and the symmetries of mechanics."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import (
    GROUND,
    AppliedForce,
    AppliedTorque,
    Body,
    Curve,
    Dry,
    Friction,
    Gear,
    Ideal,
    JointDrive,
    LoadCurve,
    Marker,
    MasslessLink,
    MultibodyModel,
    PinSlot,
    PointSpring,
    Prismatic,
    Revolute,
    RotationalSpring,
    line,
)
from drivewright.multibody.observe import Observed, observe
from drivewright.multibody.simulate import Settings, simulate
from drivewright.oracles.linkage.four_bar_closed_form import (
    COUPLER,
    COUPLER_TURN,
    ROCKER,
    ROCKER_TURN,
    FourBar,
    ideal_motion,
    link_accelerations,
)

pytestmark = pytest.mark.property

SPEED = 8 * 2 * np.pi
PERIOD = 2 * np.pi / SPEED


class Seen:
    """What a mechanism does at some times: seen("crank", "angle") -> (m,)."""

    def __init__(self, model, times, rtol=1e-10, atol=None):
        self.assembly = assemble(model)
        self.run = simulate(self.assembly, times[-1], Settings(rtol=rtol, atol=atol), samples=times)
        assert self.run.outcome == "complete", self.run.advice
        parts = [observe(s.system, s.t, s.y) for s in self.run.stretches if len(s.t)]
        self.observed = Observed(*(np.concatenate(rows) for rows in zip(*parts, strict=True)))

    def __call__(self, body, field):
        return self.observed.body(self.assembly.names.index(body), field)

    def place(self, body):
        return self(body, "x") + 1j * self(body, "y")

    def energy(self):
        """Kinetic and of the weight."""
        total = 0.0
        for body in self.assembly.model.bodies:
            v2 = self(body.name, "vx") ** 2 + self(body.name, "vy") ** 2
            height = -(self(body.name, "x") * self.assembly.model.gravity[0] + self(body.name, "y") * self.assembly.model.gravity[1])
            total = total + 0.5 * body.mass * v2 + 0.5 * body.inertia * self(body.name, "w") ** 2 + body.mass * height
        return total


# ------------------------------------------------------------------------------------------------------- the four-bar's twin


def four_bar(clearances=(0.0,) * 4, alphas=(0.1, 0.2, 3.0, 0.3), damping=0.0, link_damping=1e-4, forward=True):
    """(multibody model, closed form) of the knife folder; `forward` False: the crank's pin and the rocker's stated the other way round."""
    bar = FourBar(
        np.array([0.484, 0.066, 0.158, 0.424]),
        np.array([1.0, 1.113, 6.883]),
        np.array([2316e-6, 0.0423]),
        np.array([0.0, 0.079, 0.243]),
        np.array(clearances),
        body_damping=damping,
        link_damping=link_damping,
    )

    def pin(name, k, *ends):
        way = 1 if forward or k in (1, 2) else -1
        link = MasslessLink(clearances[k], link_damping, alphas[k] + (np.pi if way < 0 else 0.0)) if clearances[k] else Ideal()
        return Revolute(name, *ends[::way], link)

    model = MultibodyModel(
        (
            Body("crank", 1.0, 0.0),
            Body("coupler", 1.113, 2316e-6, (0.079, 0.0), angle=-1.0),
            Body("rocker", 6.883, 0.0423, (0.243, 0.0), angle=3.4),
        ),
        (
            pin("O2", 0, Marker(GROUND), Marker("crank")),
            pin("A", 1, Marker("crank", 0.066), Marker("coupler")),
            pin("B", 2, Marker("coupler", 0.158), Marker("rocker", 0.424)),
            pin("O4", 3, Marker("rocker"), Marker(GROUND, 0.484)),
        ),
        forces=(RotationalSpring("c3", "coupler", damping=damping), RotationalSpring("c4", "rocker", damping=damping)),
        drives=(JointDrive("O2", line(0.0, SPEED)),),
        gravity=(0, -9.81),
    )
    return model, bar


@pytest.mark.parametrize("forward", [True, False])
def test_ideal_four_bar_is_its_twin(forward):
    model, bar = four_bar(forward=forward)
    t = np.linspace(0, PERIOD, 200)
    seen = Seen(model, t)
    e, v, a = ideal_motion(bar, SPEED * t)
    places = {"coupler": (0.066 * e[0] + 0.079 * e[1], COUPLER), "rocker": (0.484 - 0.243 * e[2], ROCKER)}
    turns = {"coupler": (e[1], COUPLER_TURN), "rocker": (-e[2], ROCKER_TURN)}
    for name, (place, row) in places.items():
        np.testing.assert_allclose(seen.place(name), place, rtol=0, atol=1e-9)
        for found, wanted in (
            (seen(name, "vx") + 1j * seen(name, "vy"), SPEED * v[row]),
            (seen(name, "ax") + 1j * seen(name, "ay"), SPEED**2 * a[row]),
        ):
            np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9 * np.abs(wanted).max())
    for name, (way, row) in turns.items():
        np.testing.assert_allclose(np.exp(1j * seen(name, "angle")), way, rtol=0, atol=1e-9)
        np.testing.assert_allclose(seen(name, "w"), SPEED * v[row].real, rtol=0, atol=1e-9 * SPEED)
        np.testing.assert_allclose(seen(name, "alpha"), SPEED**2 * a[row].real, rtol=0, atol=1e-9 * SPEED**2)
        assert np.abs(np.diff(seen(name, "angle"))).max() < 0.2


@pytest.mark.parametrize("clearances", [(0, 2e-4, 2e-4, 2e-4), (0, 0, 3e-4, 0), (2e-4, 1e-4, 2e-4, 3e-4)])
@pytest.mark.parametrize("forward", [True, False])
def test_massless_links_are_their_twin(clearances, forward):
    """The links' own angles, from rest, over one turn."""
    model, bar = four_bar(clearances, damping=0.1, forward=forward)
    t = np.linspace(0, PERIOD, 41)
    seen = Seen(model, t, rtol=1e-11)
    start = np.array([0.1, 0.2, 3.0, 0.3, 0, 0, 0, 0])
    twin = solve_ivp(
        lambda at, y: np.append(y[4:], link_accelerations(bar, SPEED * at, SPEED, y[:4], y[4:])),
        (0.0, PERIOD),
        start,
        method="DOP853",
        rtol=1e-11,
        atol=1e-12,
        t_eval=t,
    ).y.T
    for k, name in enumerate(("O2", "A", "B", "O4")):
        if clearances[k]:
            angle = seen(f"link:{name}", "angle") - (0.0 if forward or k in (1, 2) else np.pi)
            np.testing.assert_allclose(angle, twin[:, k], rtol=0, atol=1e-6)
            assert np.ptp(angle) > 0.1
    np.testing.assert_allclose(seen("crank", "w"), SPEED, rtol=1e-9)


def test_massless_links_approach_the_ideal_pins_in_first_order():
    """Heavily damped links: the rocker's deviation over a decade of the play."""
    t = np.linspace(0, PERIOD, 81)[1:]
    ideal = Seen(four_bar()[0], t)("rocker", "angle")
    plays = np.array([2e-5, 6e-5, 2e-4])
    misses = [np.abs(Seen(four_bar((0, r, r, r), link_damping=10 * r)[0], t, 1e-8)("rocker", "angle") - ideal).max() for r in plays]
    slope = np.polyfit(np.log(plays), np.log(misses), 1)[0]
    assert slope == pytest.approx(1.0, abs=0.1)


# --------------------------------------------------------------------------------------------------------------------- energy


def swinging(lengths, rate, start=(0.3, None, None)):
    """A free four-bar of rods in gravity."""
    l1, l2, l3, l4 = lengths
    rods = [
        Body(name, length, length**3 / 12, (length / 2, 0.0), angle=angle)
        for name, length, angle in zip(("crank", "coupler", "rocker"), (l2, l3, l4), start, strict=True)
    ]
    rods[0] = replace(rods[0], angular_velocity=rate)
    return MultibodyModel(
        tuple(rods),
        (
            Revolute("O2", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", l2), Marker("coupler")),
            Revolute("B", Marker("coupler", l3), Marker("rocker", l4)),
            Revolute("O4", Marker(GROUND, l1), Marker("rocker")),
        ),
        gravity=(0, -9.81),
    )


@pytest.mark.parametrize(
    "lengths, start, rate",
    [
        ((0.5, 0.2, 0.45, 0.4), (0.3, 0.6, 1.2), 25.0),  # the crank goes round
        ((0.5, 0.4, 0.35, 0.42), (1.0, 0.2, 1.6), 3.0),  # no link can go round: every one of them has its dead points
        ((0.4, 0.5, 0.3, 0.45), (1.2, 0.1, 1.5), 9.0),
    ],
)
def test_free_four_bar_keeps_its_energy_through_dead_points(lengths, start, rate):
    seen = Seen(swinging(lengths, rate, start), np.linspace(0, 4, 4001), rtol=1e-10)
    energy = seen.energy()
    scale = np.ptp(sum(b.mass * 9.81 * seen(b.name, "y") for b in seen.assembly.model.bodies)) + energy[0]
    assert np.abs(energy - energy[0]).max() < 1e-7 * abs(scale)
    assert (len(seen.run.stretches) > 1) == (rate < 20)  # another split of the coordinates on the way
    for name in ("crank", "coupler", "rocker"):
        w = seen(name, "w")
        np.testing.assert_allclose(np.diff(seen(name, "angle")), 0.5e-3 * (w[1:] + w[:-1]), rtol=0, atol=2e-3)
        np.testing.assert_allclose(np.diff(w), 0.5e-3 * (seen(name, "alpha")[1:] + seen(name, "alpha")[:-1]), rtol=0, atol=1.0)


def test_double_pendulum_keeps_its_energy_over_many_swings():
    model = MultibodyModel(
        (Body("upper", 1.0, 0.02, (0.3, 0.0), angle=1.0), Body("lower", 0.7, 0.01, (0.2, 0.1), angle=0.5, angular_velocity=2.0)),
        (Revolute("O", Marker(GROUND), Marker("upper")), Revolute("A", Marker("upper", 0.5), Marker("lower"))),
        gravity=(1.0, -9.81),
    )
    energy = Seen(model, np.linspace(0, 20, 401), rtol=1e-11).energy()
    assert np.ptp(energy) < 1e-7


def test_power_of_the_drive_feeds_the_energy():
    """Kinetic energy and weight change by what drive, dampers and springs give."""
    model, _ = four_bar(damping=0.1)
    t = np.linspace(0, PERIOD, 4001)
    seen = Seen(model, t)
    power = seen.observed.powers.sum(axis=1)
    work = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(t))])
    energy = seen.energy()
    np.testing.assert_allclose(energy - energy[0], work, rtol=0, atol=1e-5 * np.ptp(energy))
    assert seen.observed.powers[:, 0].max() < 0 < np.ptp(energy)


# ---------------------------------------------------------------------------------------------------------------- symmetries


def machine(dry=None):
    """A free slider-crank with a geared wheel, a slotted rocker, springs, a motor and a force; `dry` puts play into the wrist."""
    pin = 0.04 * np.exp(0.5j)
    return MultibodyModel(
        (
            Body("crank", 1.0, 2e-3, (0.01, 0.005), angle=0.5, angular_velocity=40.0),
            Body("rod", 0.3, 4e-4, (0.07, -0.01), angle=-np.arcsin(0.05 * np.sin(0.5) / 0.15)),
            Body("slider", 0.4, 1e-4, (0.01, 0.02)),
            Body("wheel", 0.5, 3e-4, (0.005, 0.0), angle=0.2),
            Body("rocker", 0.2, 5e-4, (0.06, 0.01), angle=np.angle(pin + 0.12)),
        ),
        (
            Revolute("O", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", 0.05), Marker("rod")),
            Revolute("wrist", Marker("rod", 0.15), Marker("slider"), dry or Ideal()),
            Prismatic("guide", Marker("slider"), Marker(GROUND)),
            Revolute("V", Marker(GROUND, 0.0, 0.1), Marker("wheel")),
            Gear("mesh", "crank", "wheel", -1.7),
            Revolute("R", Marker(GROUND, -0.12), Marker("rocker")),
            PinSlot("slot", Marker("crank", 0.04), Marker("rocker")),
        ),
        forces=(
            PointSpring("s", Marker("slider", 0.01, 0.01), Marker(GROUND, 0.3, 0.05), 300.0, 0.08, 2.0),
            RotationalSpring("t", "rocker", "rod", 1.0, 0.1, 0.001),
            AppliedTorque("m", "crank", LoadCurve(line(0.5, -0.01), "speed")),
            AppliedForce("f", Marker("rod", 0.1, 0.01), (3.0, 1.0), LoadCurve(line(1.0, -2.0))),
        ),
        gravity=(2.0, -9.81),
    )


DRY = Dry(2e-4, 8e-3, 1e9, 1.5, 0.3, friction=Friction("coulomb", 0.1, 0.01))
TIMES = np.linspace(0, 0.12, 13)


def moved(model, turn=0.0, shift=0j, mirror=False):
    """The same mechanism elsewhere: mirrored about the x axis, then turned, then shifted, with the gravity."""

    def in_body(z):
        return z.conjugate() if mirror else z

    def in_world(z):
        return in_body(z) * np.exp(1j * turn)

    def pair(z):
        return z.real, z.imag

    def marker(m):
        z = complex(m.x, m.y)
        return Marker(m.body, *pair(in_world(z) + shift if m.body == GROUND else in_body(z)))

    def element(e):
        changes = {k: marker(getattr(e, k)) for k in ("first", "second", "point") if isinstance(getattr(e, k, None), Marker)}
        if hasattr(e, "axis"):
            changes["axis"] = pair((in_world if e.second.body == GROUND else in_body)(complex(*e.axis)))
        if isinstance(e, AppliedForce):
            changes["direction"] = pair(in_world(complex(*e.direction)))
        if isinstance(e, RotationalSpring):
            changes["rest"] = sense * e.rest
        if isinstance(e, AppliedTorque):
            c = e.load.curve
            changes["load"] = replace(e.load, curve=Curve(c.breaks, sense * c.coefficients * sense ** np.arange(6)))
        return replace(e, **changes)

    sense = -1 if mirror else 1
    bodies = tuple(
        replace(
            b,
            centroid=pair(in_body(complex(*b.centroid))),
            angle=sense * b.angle + turn,
            angular_velocity=None if b.angular_velocity is None else sense * b.angular_velocity,
        )
        for b in model.bodies
    )
    return replace(
        model,
        bodies=bodies,
        joints=tuple(map(element, model.joints)),
        forces=tuple(map(element, model.forces)),
        gravity=pair(in_world(complex(*model.gravity))),
    )


@pytest.fixture(scope="module", params=[None, DRY], ids=["ideal", "dry"])
def reference(request):
    return request.param, Seen(machine(request.param), TIMES, rtol=1e-11)


def same(found, wanted, within):
    for name in ("crank", "rod", "slider", "wheel", "rocker"):
        for field in ("angle", "w"):
            size = max(np.abs(wanted(name, field)).max(), 1.0)
            np.testing.assert_allclose(found(name, field), wanted(name, field), rtol=0, atol=within * size, err_msg=f"{name} {field}")
        np.testing.assert_allclose(found.place(name), wanted.place(name), rtol=0, atol=within)


def test_the_machine_does_something(reference):
    dry, seen = reference
    assert np.ptp(seen("crank", "angle")) > 1.5
    assert seen.assembly.freedom == (3 if dry else 1)
    assert (len(seen.run.impacts) > 2) == bool(dry)


class Turned:
    """The reference seen from elsewhere."""

    def __init__(self, seen, turn, shift, mirror):
        self.seen, self.turn, self.shift, self.mirror = seen, turn, shift, mirror

    def __call__(self, body, field):
        sense = -1 if self.mirror else 1
        return sense * self.seen(body, field) + (self.turn if field == "angle" else 0.0)

    def place(self, body):
        z = self.seen.place(body)
        return (z.conjugate() if self.mirror else z) * np.exp(1j * self.turn) + self.shift


@pytest.mark.parametrize("turn, shift, mirror", [(0.0, 0j, True), (0.0, 1.5 - 0.7j, False), (2.1, 0.3 + 0.2j, False), (-0.8, 0.1j, True)])
def test_mechanism_moved_elsewhere_moves_alike(reference, turn, shift, mirror):
    dry, seen = reference
    there = Seen(moved(machine(dry), turn, shift, mirror), TIMES, rtol=1e-11)
    same(there, Turned(seen, turn, shift, mirror), 1e-7 if dry else 1e-9)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_order_of_the_description_does_not_matter(reference, seed):
    dry, seen = reference
    model, rng = machine(dry), np.random.default_rng(seed)

    def shuffled(items):
        return tuple(items[k] for k in rng.permutation(len(items)))

    mixed = replace(model, bodies=shuffled(model.bodies), joints=shuffled(model.joints), forces=shuffled(model.forces))
    same(Seen(mixed, TIMES, rtol=1e-11), seen, 1e-7 if dry else 1e-9)


def rescaled(model, length, mass, time):
    """The same mechanism in other units: a metre is `length` of the new ones, and so on."""
    force = mass * length / time**2

    def marker(m):
        return Marker(m.body, length * m.x, length * m.y)

    def load(at, unit):
        c, x = at.curve, {"time": time, "angle": 1.0, "speed": 1 / time}[at.over]
        return replace(at, curve=Curve(c.breaks * x, c.coefficients * unit / x ** np.arange(6)))

    def element(e):
        changes = {k: marker(getattr(e, k)) for k in ("first", "second", "point") if isinstance(getattr(e, k, None), Marker)}
        if isinstance(e, PointSpring):
            changes |= {
                "stiffness": e.stiffness * force / length,
                "free_length": e.free_length * length,
                "damping": e.damping * mass / time,
            }
        if isinstance(e, RotationalSpring):
            changes |= {"stiffness": e.stiffness * force * length, "damping": e.damping * force * length * time}
        if isinstance(e, (AppliedTorque, AppliedForce)):
            changes["load"] = load(e.load, force * length if isinstance(e, AppliedTorque) else force)
        if isinstance(getattr(e, "model", None), Dry):
            d = e.model
            changes["model"] = replace(
                d,
                clearance=d.clearance * length,
                bearing_radius=d.bearing_radius * length,
                stiffness=d.stiffness * force / length**d.exponent,
                friction=replace(d.friction, speed=d.friction.speed * length / time),
            )
        return replace(e, **changes)

    bodies = tuple(
        replace(
            b,
            mass=b.mass * mass,
            inertia=b.inertia * mass * length**2,
            centroid=tuple(length * np.array(b.centroid)),
            angular_velocity=None if b.angular_velocity is None else b.angular_velocity / time,
        )
        for b in model.bodies
    )
    return replace(
        model,
        bodies=bodies,
        joints=tuple(map(element, model.joints)),
        forces=tuple(map(element, model.forces)),
        gravity=tuple(np.array(model.gravity) * length / time**2),
    )


@pytest.mark.parametrize("length, mass, time", [(1000.0, 1.0, 1.0), (1000.0, 1e-3, 1e3), (1.0, 7.0, 10.0), (0.3, 1.0, 0.1)])
def test_units_do_not_matter(reference, length, mass, time):
    """Angles are pure numbers; tolerances of places and rates scale with the unit of the smallest."""
    dry, seen = reference
    there = Seen(rescaled(machine(dry), length, mass, time), TIMES * time, rtol=1e-11, atol=1e-14 * min(1.0, length, 1 / time))
    for name in ("crank", "rod", "slider", "wheel", "rocker"):
        np.testing.assert_allclose(there(name, "angle"), seen(name, "angle"), rtol=0, atol=1e-6 if dry else 1e-8)
        np.testing.assert_allclose(there.place(name) / length, seen.place(name), rtol=0, atol=1e-6 if dry else 1e-8)
