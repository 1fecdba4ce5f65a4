"""Whether a linkage is a crank-driven four-bar, and its motion in the closed form of `four_bar_closed_form` then."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.multibody.model import GROUND, Marker, Revolute, RotationalSpring
from drivewright.multibody.observe import concatenate, observe
from drivewright.multibody.simulate import Settings, simulate, states_outside_folds
from drivewright.numerics.ode import integrate
from drivewright.oracles.linkage.four_bar_closed_form import (
    COUPLER_TURN,
    ROCKER_TURN,
    FourBar,
    LinkMotion,
    ideal_motion,
    link_accelerations,
    positions,
    velocities,
)
from drivewright.registry import Row

ROUTE = "closed form of the four-bar"
SAMPLES = 721  # of a turn with ideal pins
PART = 0.5  # of a turn over which massless links are followed


class Step(NamedTuple):
    """A pin on the way around the loop, from the body where the way comes from to the next one."""

    joint: Revolute
    near: Marker
    far: Marker


class Chain(NamedTuple):
    """Names of crank, coupler and rocker; the pins O2, A, B, O4; the bars O2-O4, O2-A, A-B, O4-B, complex, in their bodies' frames."""

    bodies: tuple[str, ...]
    steps: tuple[Step, ...]
    bars: Complexes


def chain_of(model: LinkageModel) -> Chain | None:
    """The `Chain` of a mechanism driven at constant speed; None where it is no four-bar of ideal pins and massless links."""
    stated = model.assembly.model
    if not model.period or (len(stated.bodies), len(stated.joints), len(stated.drives)) != (3, 4, 1):
        return None
    if not all(joint.pin_markers and (joint.massless_link or not joint.play) for joint in stated.joints):
        return None
    steps = _walk(stated.joints, next(joint for joint in stated.joints if joint.name == stated.drives[0].joint))
    if len(steps) < 4 or steps[0].near.body != GROUND or steps[3].far.body != GROUND:
        return None
    o2, a, b, o4 = steps
    bars = np.array([_from_to(o2.near, o4.far), _from_to(o2.far, a.near), _from_to(a.far, b.near), _from_to(o4.near, b.far)])
    return Chain((o2.far.body, a.far.body, b.far.body), steps, bars) if np.all(np.abs(bars) > 0) else None


def _walk(joints, joint):
    """Steps from the ground through `joint` and on, while there is one way only."""
    steps, body, left = [], GROUND, list(joints)
    while joint is not None:
        left.remove(joint)
        near, far = (joint.first, joint.second) if joint.first.body == body else (joint.second, joint.first)
        steps.append(Step(joint, near, far))
        body = far.body
        onward = [other for other in left if body in (other.first.body, other.second.body)]
        joint = onward[0] if len(onward) == 1 else None
    return tuple(steps)


def _from_to(start, end):
    return complex(end.x - start.x, end.y - start.y)


def closed_form(model: LinkageModel) -> Iterable[Row]:
    """Rows of a four-bar: a turn with ideal pins, half a turn with massless links; none for another mechanism."""
    chain = chain_of(model)
    if chain is None:
        return ()
    return _turn(model, chain) if not model.massless_links else _links(model, chain)


def _directions(model, chain, observed):
    """Unit vectors (3, m) of crank O2-A, coupler A-B and rocker B-O4 from the observed bodies, the frame on the real axis."""
    angles = np.array([observed.bodies[:, model.assembly.names.index(body), 2] for body in chain.bodies])
    turned = np.exp(1j * (angles + np.angle(chain.bars[1:])[:, None] - np.angle(chain.bars[0])))
    return turned * np.array([[1], [1], [-1]])


def _bar(chain, **more):
    lengths = np.abs(chain.bars)
    return FourBar(lengths, np.ones(3), np.ones(2), np.zeros(3), np.zeros(4), **more)


def _branch(bar, crank, alphas, e):
    """The bar in the assembly in which its rocker points along e[2]."""
    return min((bar._replace(branch=sign) for sign in (1.0, -1.0)), key=lambda tried: abs(positions(tried, crank, alphas)[2] - e[2]))


# -- ideal pins ----------------------------------------------------------------------------------------------------------------


def _turn(model, chain):
    run = simulate(model.assembly, model.period, samples=np.linspace(0, model.period, SAMPLES))
    observed = concatenate([observe(*states) for states in states_outside_folds(run)])
    e = _directions(model, chain, observed)
    crank, speed = np.angle(e[0]), model.drive_speed
    both = [ideal_motion(_bar(chain)._replace(branch=sign), crank) for sign in (1.0, -1.0)]  # in a fold one goes over into the other
    mine = np.argmin([np.abs(solution[0][2] - e[2]) for solution in both], axis=0)
    other, bent = (np.where(mine == 0, both[0][k], both[1][k]) for k in (0, 2))
    for k, row in ((1, COUPLER_TURN), (2, ROCKER_TURN)):
        name = chain.bodies[k]
        apart = np.angle(e[k] / other[k])
        yield f"{name}, angle: maximum difference over a turn", 0.0, float(np.max(np.abs(apart))), "rad", 1e-9, ROUTE
        alpha, closed = observed.body(model.assembly.names.index(name), "alpha"), bent[row].real * speed**2
        worst, size = np.argmax(np.abs(alpha - closed)), float(np.max(np.abs(closed)))
        yield (
            f"{name}, angular acceleration at the maximum difference",
            float(alpha[worst]),
            float(closed[worst]),
            "rad/s^2",
            1e-9 * size,
            ROUTE,
        )


# -- massless links --------------------------------------------------------------------------------------------------------------


def _links(model, chain):
    """Half a turn from the start, integrated in the links' angles."""
    bar = _loaded(model, chain)
    if bar is None:
        return
    speed, length = model.drive_speed, PART * model.period
    run = simulate(model.assembly, length, Settings(1e-11), samples=np.array([0.0, length]))
    first, last = run.stretches[0], run.end
    start, end = observe(first.system, first.t[:1], first.y[:1]), observe(last[0], [last[1]], last[2][None])
    alphas, rates = _link_angles(model, chain, start)
    e = _directions(model, chain, start)[:, 0]
    crank = float(np.angle(e[0]))
    bar = _branch(bar, crank, alphas, e)
    link_accelerations(bar, crank, speed, alphas, rates)  # it allocates, so it must be compiled before the integrator's kernels call it
    y = (
        integrate(
            LinkMotion(bar, speed),
            crank / speed,
            crank / speed + length,
            np.concatenate([alphas, rates]),
            1e-11,
            1e-13 * np.repeat([1.0, 10 * abs(speed)], 4),
            max_steps=5_000_000,
        )
        .checked()
        .y_end
    )
    other = positions(bar, crank + speed * length, y[:4])
    turning = velocities(bar, other, speed, y[:4], y[4:])
    for k, row in ((1, COUPLER_TURN), (2, ROCKER_TURN)):
        name = chain.bodies[k]
        ours = _directions(model, chain, end)[k, 0]
        yield f"{name}, direction after {PART:g} turns", float(np.angle(ours)), float(np.angle(other[k])), "rad", 1e-9, ROUTE
        rate = float(end.body(model.assembly.names.index(name), "w")[0])
        yield f"{name}, angular velocity after {PART:g} turns", rate, float(turning[row].real), "rad/s", 1e-8 * abs(speed), ROUTE


def _link_angles(model, chain, observed):
    """(alphas, rates) of the links O2, A, B, O4 in the sense of the loop, the frame on the real axis; 0 at ideal pins."""
    alphas, rates = np.zeros(4), np.zeros(4)
    for k, step in enumerate(chain.steps):
        if step.joint.massless_link:
            link = observed.bodies[0, model.assembly.names.index(f"link:{step.joint.name}")]
            alphas[k] = link[2] - np.angle(chain.bars[0]) + (0.0 if step.joint.first == step.near else np.pi)
            rates[k] = link[5]
    return alphas, rates


def _loaded(model, chain):
    """The FourBar with masses, damping and weight; None where the closed form has no place for what acts on it."""
    stated = model.assembly.model
    bodies = [next(body for body in stated.bodies if body.name == name) for name in chain.bodies]
    pins = (chain.steps[0].far, chain.steps[1].far, chain.steps[3].near)
    arms = np.array([_from_to(pin, Marker("", *body.centroid)) for pin, body in zip(pins, bodies, strict=True)])
    arms *= np.conj(chain.bars[1:]) / np.abs(chain.bars[1:])
    weight = complex(*stated.gravity) * np.conj(chain.bars[0]) / abs(chain.bars[0])
    drag = {name: sum(force.damping for force in stated.forces if getattr(force, "first", None) == name) for name in chain.bodies[1:]}
    plain = all(isinstance(f, RotationalSpring) and f.stiffness == 0 and f.second == GROUND for f in stated.forces)
    dampings = {joint.massless_link.damping for joint in stated.joints if joint.massless_link}
    level = abs(weight.real) < 1e-12 * (1 + abs(weight)) and np.max(np.abs(arms.imag)) < 1e-12
    if not (plain and level and len(dampings) == 1 and len(set(drag.values())) == 1):
        return None
    plays = np.array([getattr(step.joint.model, "clearance", 0.0) for step in chain.steps])
    masses, inertias = np.array([body.mass for body in bodies]), np.array([body.inertia for body in bodies[1:]])
    return FourBar(
        np.abs(chain.bars),
        masses,
        inertias,
        arms.real.copy(),
        plays,
        body_damping=drag[chain.bodies[1]],
        link_damping=dampings.pop(),
        gravity=float(-weight.imag),
    )
