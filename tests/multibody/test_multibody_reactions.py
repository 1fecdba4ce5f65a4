"""Joint forces on a second route: what the tree's motion leaves over of Newton's equations is rounding, and known forces come out."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright.multibody.assembly import assemble
from drivewright.multibody.curves import curve_slope
from drivewright.multibody.model import (
    AppliedForce,
    AppliedTorque,
    Body,
    Bushing,
    CamPair,
    Curve,
    Dry,
    Friction,
    Gear,
    JointDrive,
    LoadCurve,
    Lubricated,
    Marker,
    MasslessLink,
    MultibodyModel,
    PinSlot,
    PointSpring,
    Prismatic,
    Revolute,
    Rolling,
    RotationalSpring,
    line,
)
from drivewright.multibody.observe import observe
from drivewright.multibody.reactions import reactions
from drivewright.multibody.simulate import work_at_state

pytestmark = pytest.mark.analytical

G = (0.7, -9.81)
STATES = 9


def states(assembly, seed=5, spread=0.05, speed=3.0):
    """(t, y): poses near the start, loops closed, any rates."""
    rng, system = np.random.default_rng(seed), assembly.system
    t, y = rng.uniform(0.0, 0.02, STATES), np.repeat(assembly.state[None], STATES, axis=0)
    free = np.searchsorted(system.stored, system.independent)
    first, last = len(system.stored), len(system.stored) + len(free)
    y[:, free] += spread * rng.uniform(-1, 1, (STATES, len(free)))
    y[:, first:last] = speed * rng.uniform(-1, 1, (STATES, len(free)))
    y[:, system.contacts.memory] = 0.3
    for time, state in zip(t, y, strict=True):
        state[:first] = work_at_state(system, time, state).coordinates.q[system.stored]
    return t, y


def solved(model, **options):
    assembly = assemble(model)
    observed = observe(assembly.system, *states(assembly, **options))
    return assembly, observed, reactions(assembly, assembly.system, observed)


def body(name, mass=1.3, inertia=0.02, **more):
    return Body(name, mass, inertia, centroid=(0.07, 0.02), **more)


def quintic(period):
    return Curve(np.array([0.0, period]), np.array([[0.03, 0.4, -0.3, 0.2, 0.1, 0.05]]), 0.0)


def four_bar(pin_b=None, driven=True, **drive):
    pins = {"model": pin_b} if pin_b else {}
    return MultibodyModel(
        (body("crank"), body("coupler", angle=0.4), body("rocker", angle=1.9)),
        (
            Revolute("O", Marker("ground"), Marker("crank")),
            Revolute("A", Marker("crank", 0.1), Marker("coupler")),
            Revolute("B", Marker("coupler", 0.3), Marker("rocker", 0.2), **pins),
            Revolute("C", Marker("rocker"), Marker("ground", 0.35)),
        ),
        (PointSpring("s", Marker("coupler", 0.1, 0.05), Marker("ground", 0.1, 0.4), 300.0, 0.2, 5.0),),
        (JointDrive("O", Curve(np.array([0.0, 1.0]), np.array([[0.0, 40.0, 9.0, 0, 0, 0]]))),) if driven else (),
        G,
    )


def chain():
    push = AppliedForce("f", Marker("b", 0.1, 0.1), (1.0, 2.0), LoadCurve(line(3.0, 1.0), "angle"), follows=True)
    return MultibodyModel(
        (body("a", angle=0.5), body("b", angle=-0.3), body("c")),
        (
            Revolute("O", Marker("ground", 0.1, 0.2), Marker("a")),
            Prismatic("P", Marker("b", 0.1), Marker("a", 0.2, 0.1), axis=(0.6, 0.8)),
            Revolute("Q", Marker("c", -0.1, 0.05), Marker("b", 0.3)),
        ),
        (AppliedTorque("m", "c", LoadCurve(line(2.0, 0.3)), on="a"), push),
        gravity=G,
    )


def six_bar(driven):
    base = four_bar(driven=driven)
    return MultibodyModel(
        (*base.bodies, body("rod", angle=0.3), Body("slider", 0.8, 0.001)),
        (
            *base.joints,
            Revolute("D", Marker("rocker", 0.15, 0.06), Marker("rod")),
            Revolute("E", Marker("rod", 0.4), Marker("slider")),
            Prismatic("F", Marker("slider"), Marker("ground", 0.0, 0.1)),
        ),
        base.forces,
        base.drives,
        G,
    )


def pin_slot():
    return MultibodyModel(
        (body("crank", angle=0.8), body("swing", angle=0.3)),
        (
            Revolute("O", Marker("ground"), Marker("crank")),
            Revolute("C", Marker("ground", -0.3), Marker("swing")),
            PinSlot("S", Marker("crank", 0.1), Marker("swing", 0.0, 0.01), axis=(1.0, 0.1)),
        ),
        gravity=G,
    )


def geared():
    return MultibodyModel(
        (body("arm"), body("planet", angle=0.4), body("sun")),
        (
            Revolute("O", Marker("ground"), Marker("arm")),
            Revolute("S", Marker("ground"), Marker("sun")),
            Revolute("P", Marker("arm", 0.3), Marker("planet")),
            Gear("teeth", "sun", "planet", -2.5, carrier="arm"),
        ),
        (RotationalSpring("t", "planet", "ground", 3.0, 0.1, 0.2),),
        gravity=G,
    )


def rolling(track_radius, held=False):
    """A wheel that rolls on a track which moves itself; `held` on an arm, which repeats that it stays at its distance."""
    away = abs(track_radius + 0.1) if track_radius else 0.1
    start = {"velocity": (0.0, 0.0)}
    arm = (Body("arm", 1.0, 0.01, (0.05, 0.0), angle=1.2),) if held else ()
    pins = (Revolute("H", Marker("base"), Marker("arm")), Revolute("hub", Marker("arm", away), Marker("wheel"))) if held else ()
    return MultibodyModel(
        (body("base", mass=3.0), *arm, Body("wheel", 1.2, 0.005, (0.03, 0.01), **start)),
        (
            Revolute("O", Marker("ground", 0.0, -0.2), Marker("base", 0.0, -0.2)),
            *pins,
            Rolling("roll", Marker("wheel"), Marker("base"), 0.1, track_radius=track_radius),
        ),
        (PointSpring("s", Marker("wheel"), Marker("ground", 0.5, 0.1), 200.0, 0.1),),
        gravity=G,
    )


def cam(axis):
    joint = (
        Prismatic("guide", Marker("follower"), Marker("frame", 0.1, 0.3), axis)
        if axis
        else Revolute("guide", Marker("follower"), Marker("frame", 0.1, 0.3))
    )
    return MultibodyModel(
        (body("frame"), body("cam", angle=0.1), body("follower", angle=0.0 if axis else 0.03)),
        (
            Revolute("O", Marker("ground"), Marker("frame")),
            Revolute("C", Marker("frame", 0.2), Marker("cam")),
            joint,
            CamPair("pair", "cam", Marker("follower", 0.02, 0.01), quintic(6.0), carrier="frame", origin=(0.12, 0.31), axis=axis),
        ),
        gravity=G,
    )


LINKED = MasslessLink(1e-3, damping=0.01, angle=0.7)
CASES = {
    "open chain": chain(),
    "free four-bar": four_bar(driven=False),
    "driven four-bar": four_bar(),
    "free six-bar": six_bar(False),
    "driven six-bar": six_bar(True),
    "pin-slot": pin_slot(),
    "planetary gear": geared(),
    "rolling on a line": rolling(0.0),
    "rolling outside": rolling(0.25),
    "rolling inside": rolling(-0.35),
    "rolling on an arm": rolling(0.25, True),
    "rolling in a ring on an arm": rolling(-0.35, True),
    "cam and slide": cam((0.6, 0.8)),
    "cam and lever": cam(None),
    "massless link": four_bar(LINKED),
    "bushing": four_bar(Bushing(1e4, 20.0, 5.0, 0.1)),
    "free body": MultibodyModel((body("a", velocity=(1.0, 2.0), angular_velocity=3.0),), (), gravity=G),
}


@pytest.mark.parametrize("name", CASES)
def test_the_motion_of_the_tree_leaves_nothing_over_of_the_equations_of_all_bodies(name):
    _, _, found = solved(CASES[name])
    assert found.residual.shape == (STATES,)
    assert np.max(found.residual) < 2e-11


@pytest.mark.parametrize("name", ["driven four-bar", "driven six-bar", "massless link"])
def test_the_drives_torque_is_that_of_the_tree(name):
    _, observed, found = solved(CASES[name])
    assert found.drives == pytest.approx(observed.drives, rel=1e-8, abs=1e-9)
    assert np.min(np.abs(found.drives)) > 0.1


def test_a_row_left_out_of_the_equations_would_be_seen():
    """The residual is no empty word: loads that the motion does not know of show up in it."""
    assembly = assemble(CASES["free six-bar"])
    observed = observe(assembly.system, *states(assembly))
    observed.bodies[:, assembly.names.index("rod"), 11] += 1e-3
    assert np.min(reactions(assembly, assembly.system, observed).residual) > 1e-7


def test_chunks_of_states_change_nothing(monkeypatch):
    assembly = assemble(four_bar(LINKED))
    observed = observe(assembly.system, *states(assembly))
    whole = reactions(assembly, assembly.system, observed)
    monkeypatch.setattr("drivewright.multibody.reactions.CHUNK", 4)
    parts = reactions(assembly, assembly.system, observed)
    for name, reaction in whole.joints.items():
        assert parts.joints[name].force == pytest.approx(reaction.force, rel=1e-9)
    assert parts.tensions["B"] == pytest.approx(whole.tensions["B"], rel=1e-9)


# ----------------------------------------------------------------------------------------------------------- known forces


def test_a_spinning_crank_pulls_its_pin_outwards_and_weighs_on_it():
    model = MultibodyModel(
        (Body("crank", 2.0, 0.1, (0.3, 0.0)),),
        (Revolute("O", Marker("ground"), Marker("crank")),),
        drives=(JointDrive("O", line(0.4, 7.0)),),
        gravity=(0.0, -9.81),
    )
    _, observed, found = solved(model)
    angle = 0.4 + 7.0 * observed.t
    outwards = 2.0 * 0.3 * 49.0 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    assert found.joints["O"].force == pytest.approx(outwards + [0.0, -2.0 * 9.81], rel=1e-10)
    assert found.joints["O"].moment == pytest.approx(0.0, abs=1e-12)
    assert found.drives[:, 0] == pytest.approx(2.0 * 9.81 * 0.3 * np.cos(angle), rel=1e-10)


def test_a_slide_carries_the_moment_of_an_overhanging_weight():
    model = MultibodyModel(
        (Body("slider", 2.0, 0.1, (0.3, 0.1)),), (Prismatic("guide", Marker("slider"), Marker("ground")),), gravity=(0.0, -10.0)
    )
    _, _, found = solved(model)
    assert found.joints["guide"].force == pytest.approx(np.tile([0.0, 20.0], (STATES, 1)), abs=1e-9)
    assert found.joints["guide"].moment == pytest.approx(np.full(STATES, 6.0), rel=1e-10)


@pytest.mark.parametrize("swapped", [False, True])
def test_a_driven_slide_asks_for_mass_times_acceleration_and_the_weight_along_it(swapped):
    ends = (Marker("ground"), Marker("slider")) if swapped else (Marker("slider"), Marker("ground"))
    model = MultibodyModel(
        (Body("slider", 2.0, 0.1),),
        (Prismatic("guide", *ends, axis=(0.6, 0.8)),),
        drives=(JointDrive("guide", Curve(np.array([0.0, 1.0]), np.array([[0.1, 0.2, 1.5, 0, 0, 0]]))),),
        gravity=(0.0, -10.0),
    )
    _, observed, found = solved(model)
    assert observed.body(1, "ax") * 0.6 + observed.body(1, "ay") * 0.8 == pytest.approx(np.full(STATES, 3.0))
    assert observed.drives[:, 0] == pytest.approx(np.full(STATES, 2.0 * 3.0 + 16.0))
    assert found.drives[:, 0] == pytest.approx(observed.drives[:, 0])


def test_gears_share_the_torque_by_their_inertias():
    ratio, torque = -2.5, 4.0
    model = MultibodyModel(
        (Body("one", 1.0, 0.3), Body("two", 1.0, 0.05)),
        (
            Revolute("O", Marker("ground"), Marker("one")),
            Revolute("C", Marker("ground", 0.2), Marker("two")),
            Gear("teeth", "one", "two", ratio),
        ),
        (AppliedTorque("motor", "one", LoadCurve(line(torque, 0.0))),),
    )
    _, observed, found = solved(model)
    acceleration = torque / (0.3 + ratio**2 * 0.05)
    assert observed.body(1, "alpha") == pytest.approx(acceleration)
    assert found.joints["teeth"].moment == pytest.approx(np.full(STATES, 0.3 * acceleration - torque))


def test_a_disc_rolls_down_a_slope_with_a_third_of_the_pull_as_friction():
    model = MultibodyModel(
        (Body("disc", 3.0, 0.5 * 3.0 * 0.2**2),), (Rolling("roll", Marker("disc"), Marker("ground"), 0.2),), gravity=(4.0, -9.0)
    )
    _, observed, found = solved(model)
    assert observed.body(1, "ax") == pytest.approx(np.full(STATES, 4.0 * 2 / 3))
    assert found.joints["roll"].force == pytest.approx(np.tile([-4.0, 27.0], (STATES, 1)))
    assert found.joints["roll"].moment == pytest.approx(np.full(STATES, -4.0 * 0.2))


def test_a_cam_pushes_its_follower_with_what_it_needs_and_takes_it_from_its_own_turning():
    base = cam((0.6, 0.8))
    joints = (Prismatic("base", Marker("frame"), Marker("ground")), *base.joints[1:])
    model = MultibodyModel(base.bodies, joints, drives=(JointDrive("base", line(0.0, 0.0)),), gravity=G)
    assembly, observed, found = solved(model)
    follower = assembly.names.index("follower")
    need = 1.3 * (np.stack([observed.body(follower, "ax"), observed.body(follower, "ay")], axis=-1) - G)
    push = found.joints["pair"].force
    assert push @ [0.6, 0.8] == pytest.approx(need @ [0.6, 0.8])
    assert push @ [-0.8, 0.6] == pytest.approx(0.0, abs=1e-9)
    turn = observed.body(assembly.names.index("cam"), "angle")
    slope = 0.4 - 0.6 * turn + 0.6 * turn**2 + 0.4 * turn**3 + 0.25 * turn**4
    assert curve_slope(quintic(6.0), turn) == pytest.approx(slope)
    assert curve_slope(replace(quintic(6.0), period=6.0), turn - 12.0) == pytest.approx(slope)


@pytest.mark.parametrize(("angle", "sign"), [(-np.pi / 2, 1.0), (np.pi / 2, -1.0)])
def test_a_massless_link_pulls_where_the_weight_hangs_and_is_pushed_where_it_stands(angle, sign):
    """Hanging, the journal lies at the end of a link that points downwards; standing, upwards."""
    pin = MasslessLink(1e-3, damping=1.0, angle=angle)
    model = MultibodyModel(
        (Body("rod", 0.5, 0.001, angle=0.3),), (Revolute("pin", Marker("ground"), Marker("rod"), pin),), gravity=(0.0, -10.0)
    )
    assembly = assemble(model)
    y = assembly.state[None].copy()
    link = assembly.tree.link("link:pin").turn
    y[0, np.searchsorted(assembly.system.stored, link)] = angle
    observed = observe(assembly.system, np.zeros(1), y)
    found = reactions(assembly, assembly.system, observed)
    assert found.tensions["pin"] == pytest.approx([sign * 5.0], rel=1e-9)


def test_two_guides_on_one_line_share_the_weight_evenly():
    guides = tuple(Prismatic(name, Marker("block", x), Marker("ground")) for name, x in (("left", -0.2), ("right", 0.2)))
    assembly, _, found = solved(MultibodyModel((Body("block", 2.0, 0.1),), guides, gravity=(0.0, -10.0)))
    assert any("right" in finding for finding in assembly.findings)
    for guide in guides:
        assert found.joints[guide.name].force == pytest.approx(np.tile([0.0, 10.0], (STATES, 1)))
        assert found.joints[guide.name].moment == pytest.approx(0.0, abs=1e-9)
    assert np.max(found.residual) < 1e-12


PLAY = Dry(1e-3, 0.02, 1e7, 1.5, 0.4, length=0.02, friction=Friction("coulomb", 0.2, 0.01))
PINS = {"dry": PLAY, "lubricated": Lubricated(PLAY, 0.05, roughness=1e-5), "bushing": Bushing(1e4, 20.0, 5.0, 0.1)}


@pytest.mark.parametrize("name", PINS)
@pytest.mark.parametrize("away", [0.4e-3, 1.02e-3])
def test_force_and_moment_of_a_pin_with_play_move_its_body(name, away):
    model = MultibodyModel((body("rod", angle=0.3),), (Revolute("pin", Marker("ground", 0.1, 0.2), Marker("rod", 0.01), PINS[name]),))
    assembly = assemble(model)
    system, y = assembly.system, np.repeat(assembly.state[None], 1, axis=0)
    y[0, :3] += [0.0, 0.6 * away, 0.8 * away]
    y[0, 3:6] = [4.0, 0.05, 0.03]
    y[0, system.contacts.memory] = 0.3
    observed = observe(system, np.zeros(1), y)
    pin = reactions(assembly, system, observed).joints["pin"]
    moved = [1.3 * observed.body(1, "ax"), 1.3 * observed.body(1, "ay"), 0.02 * observed.body(1, "alpha")]
    arm = np.array([0.1, 0.2]) - [observed.body(1, "x")[0], observed.body(1, "y")[0]]
    fx, fy = -pin.force[0]
    assert [moved[0][0], moved[1][0]] == pytest.approx([fx, fy], rel=1e-9, abs=1e-12)
    assert moved[2][0] == pytest.approx(-pin.moment[0] + arm[0] * fy - arm[1] * fx, rel=1e-9, abs=1e-12)
    assert (np.hypot(fx, fy) > 1e-3) == (name != "dry" or away > 1e-3)
