"""Whole drives, one of each kind: they run, energy adds up, the chain stays on, and forces are where statics asks for them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from drivewright.chains.explicit.assembly import start
from drivewright.chains.explicit.simulate import Settings, simulate
from drivewright.chains.link import design_link, seat_height, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket, with_sprocket
from drivewright.chains.roller_sprocket import design_roller_sprocket
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.chains.tooth import Tooth

pytestmark = pytest.mark.analytical

PITCH, ANGLE, K, SPEED = 9.525e-3, np.pi / 6, 1e8, 60.0
JOINT = design_link(PITCH, 1.2e-3, ANGLE, 2.6e-3)
TOUCH = ChainContact(K, 50.0)


def tooth(z, joint=JOINT):
    """A tooth with its active radii."""
    found = Tooth(z, PITCH * z / (2 * np.pi) * np.cos(ANGLE), seat_support(joint, z))
    height = seat_height(joint, z)
    return {"tooth": found, "tip_radius": height - 1.9e-3, "form_radius": height - 6.2e-3}


def roller_tooth(z):
    wheel = design_roller_sprocket(z, PITCH, 6.35e-3, 0.5)
    form = RollerTooth(z, wheel.pitch_radius, wheel.seat_radius, wheel.seat_angle, wheel.flank_radius, 0.5 * wheel.roller_diameter)
    return {"tooth": form, "tip_radius": wheel.tip_radius}


def drive(teeth=(27, 29), count=72, joint=JOINT, kind=None, wheels=(), **chain):
    kind = kind or (lambda z: tooth(z, joint))
    # without any resistance to articulation the plates' rocking builds up for seconds, and no mean of a tenth of one says anything
    chain = {"articulation_damping": 1e-5} | chain
    plates = Chain(joint, count, 2.5e-3, 6.4e-8, K / 3, 2e-6, **({} if joint.radius == 0 else {"toe": 6e-3, "crotch": 1.4e-3}) | chain)
    further = tuple(Sprocket(contact=TOUCH, centre=at, inertia=1e-5, damping=1e-4, **kind(z)) for z, at in wheels)
    return ChainDrive(
        plates,
        (
            Sprocket(contact=TOUCH, drive=SpeedRamp(-SPEED, -SPEED), **kind(teeth[0])),
            Sprocket(
                contact=TOUCH,
                centre=(0.2095, 0.0),
                mass=0.3,
                inertia=2e-4,
                damping=0.01,
                slide=Slide(0.0, 150.0, damping=300.0),
                **kind(teeth[1]),
            ),
            *further,
        ),
    )


def fixed(model, shorter=0.0):
    """The model with its slide held where the chain is taut, less `shorter` [m]."""
    place = model.sprockets[1].centre[0] + start(model).q[1] - shorter
    return with_sprocket(model, 1, slide=None, centre=(place, 0.0))


def ran(model, duration=0.1):
    """The run, after all that holds for every drive."""
    run = simulate(model, duration, Settings(settle=0.5 * duration, joints=tuple(range(model.chain.count)), tolerance=3e-3))
    teeth, w = [s.tooth.teeth for s in model.sprockets], [run.mean(run.body(n, "w")) for n in range(len(model.sprockets))]
    assert run.outcome == "complete", run.advice
    np.testing.assert_allclose(np.array(w) * teeth, w[0] * teeth[0], rtol=5e-3)  # no tooth is skipped
    assert np.max(run.tension[run.steady]) < 500.0
    assert max(run.momentum_residual) < 1e-8
    return run


def strand(run, upper):
    """Mean tension of the joints in the middle of a strand: that of every joint while its plate is there."""
    x, y = run.column("x")[run.steady], run.column("y")[run.steady]
    here = (x > 0.06) & (x < 0.15) & ((y > 0) == upper)
    assert np.sum(here) > 20
    return float(np.mean(run.tension[run.steady][here, 0]))


def by_force(run):
    """What the chain does to the sliding sprocket, on average."""
    return run.mean(run.body(1, "fx"))


@pytest.mark.parametrize(
    ("model", "pull"),
    [
        (drive(), 150.0),
        (drive(count=73), 150.0),
        (drive(teeth=(29, 27)), 150.0),
        (drive(teeth=(28, 28)), 150.0),
        (drive(elongation=3e-3), 150.0),
        (drive(joint=design_link(PITCH, 0.0, ANGLE, 2.6e-3), toe=6e-3), 150.0),
        (drive(joint=design_link(PITCH, 0.0, ANGLE, 2.6e-3), kind=roller_tooth), 150.0),
    ],
    ids=["plain", "odd", "larger driver", "equal", "worn", "round pins", "rollers"],
)
def test_a_drive_of_two_sprockets_runs_and_carries_its_preload(model, pull):
    assert by_force(ran(model)) == pytest.approx(-pull, rel=0.05)


def test_a_load_torque_stretches_one_strand_and_eases_the_other():
    torque = 1.2
    run = ran(with_sprocket(drive(), 1, torque=torque), 0.8)
    carried = torque + 0.01 * SPEED * 27 / 29
    radius = PITCH / (2 * np.sin(np.pi / 29))
    tight, slack = strand(run, True), strand(run, False)
    assert abs(tight - slack) == pytest.approx(carried / radius, rel=0.1)
    assert tight + slack == pytest.approx(150.0 + 2 * run.model.chain.line_density * (SPEED * 27 * PITCH / (2 * np.pi)) ** 2, rel=0.06)


def test_gravity_pulls_on_what_slides_and_hangs():
    g = 40.0  # along the slide: the weight of the sprocket and of half the chain
    pulled = ran(replace(drive(), gravity=(g, 0.0)))
    assert by_force(pulled) == pytest.approx(-150.0 - 0.3 * g, rel=0.03)
    on_both = pulled.mean(pulled.body(0, "fx")) + by_force(pulled)
    assert on_both == pytest.approx(72 * 2.5e-3 * g, abs=3.5)


def rail_force(depth, radius, tension=75.0, span=0.2095):
    """Force on a rail of `radius` pushed `depth` into a string: F = 2 T sin a, (L/2) sin a + (R - depth) cos a = R."""
    angle = brentq(lambda a: 0.5 * span * np.sin(a) + (radius - depth) * np.cos(a) - radius, 0.0, 0.3)
    return 2 * tension * np.sin(angle)


def test_a_ramp_from_rest_ends_at_speed():
    model = with_sprocket(drive(), 0, drive=SpeedRamp(-SPEED, 0.0, 0.05))
    run = simulate(model, 0.12, Settings(settle=0.08, tolerance=3e-4))
    assert run.outcome == "complete", run.advice
    assert run.column("kinetic")[0] < 1e-3 * run.column("kinetic")[-1]
    assert run.mean(run.body(1, "w")) == pytest.approx(-SPEED * 27 / 29, rel=5e-3)


def test_an_idler_below():
    run = ran(drive(count=80, wheels=((21, (0.11, -0.08)),)))
    assert by_force(run) == pytest.approx(-150.0, rel=0.05)
    assert run.mean(run.body(2, "fy")) > 30.0  # the strands press it upwards, into the loop


def test_a_fixed_centre_distance_tightens_with_its_stretch():
    means = [float(np.mean((run := ran(fixed(drive(), shorter))).tension[run.steady])) for shorter in (0.0, -2e-5)]
    assert means[1] > means[0] + 10.0


@pytest.mark.parametrize(("side", "sign"), [("outside", -1.0), ("inside", 1.0)])
def test_a_fixed_guide_bends_the_strand_by_its_force(side, sign):
    height = start(drive()).poses[:, 1].max() - 0.0005
    off, radius, depths = 3e-3 if side == "outside" else 6e-3, 0.15, (2.5e-3, 5e-3)
    middle, pushes = -np.pi / 2 if side == "outside" else np.pi / 2, []
    for depth in depths:
        guide = Guide(
            (0.105, height - sign * (off + radius - depth)),
            radius,
            middle - 0.4,
            middle + 0.4,
            side,
            off,
            ChainContact(1e7, 50.0),
            friction=0.1,
        )
        run = ran(replace(drive(), guides=(guide,)), 0.2)
        pushes.append(-sign * run.mean(run.body(2, "fy")))
        assert np.sign(run.mean(run.body(2, "fx"))) == (1.0 if run.mean(run.body(0, "w")) < 0 else -1.0)
        assert run.column("friction")[-1] < run.column("friction")[0] - 1e-4
    # where the polygon of plates begins to touch is uncertain by a fraction of a millimetre: the growth with depth is not
    assert pushes[1] - pushes[0] == pytest.approx(rail_force(depths[1], radius) - rail_force(depths[0], radius), rel=0.2)


def test_a_sprung_tensioner_takes_up_the_slack():
    slack = 1e-3
    low = start(drive()).poses[:, 1].min() + 0.0005
    guide = Guide(
        (0.105, low - 3e-3 - 0.15),
        0.15,
        np.pi / 2 - 0.4,
        np.pi / 2 + 0.4,
        "outside",
        3e-3,
        ChainContact(1e7, 50.0),
        friction=0.1,
        mass=0.05,
        slide=Slide(np.pi / 2, 50.0, 1e3, 20.0),
    )
    run = ran(replace(fixed(drive(), slack), guides=(guide,)), 0.4)
    q = run.mean(run.body(2, "q"))
    # straight to both ends from the arc of radius R: two strands are longer by 2 q^2/L less what the arc cuts off
    assert q == pytest.approx(np.sqrt(slack * 0.2085), rel=0.15)
    assert run.mean(run.body(2, "fy")) == pytest.approx(-(50.0 - 1e3 * q), rel=0.05)
