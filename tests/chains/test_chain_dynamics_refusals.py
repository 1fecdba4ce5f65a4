"""What a chain drive refuses says what, where, how much and what to try."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright.chains.explicit.assembly import start
from drivewright.chains.explicit.batch import Scatter, campbell, monte_carlo, scattered
from drivewright.chains.explicit.simulate import Settings, simulate
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket, with_sprocket
from drivewright.chains.tooth import Tooth
from drivewright.errors import DoesNotAssemble, InputError

pytestmark = pytest.mark.error

JOINT = design_link(9.525e-3, 1.2e-3, np.pi / 6, 2e-4)
TEETH = [Tooth(z, 9.525e-3 * z / (2 * np.pi) * np.cos(np.pi / 6), seat_support(JOINT, z)) for z in (9, 10)]
CHAIN = Chain(JOINT, 24, 2.5e-3, 6.4e-8, 3e6, 2e-6)
DRIVER = Sprocket(TEETH[0], ChainContact(1e7), drive=SpeedRamp(-100.0, -100.0))
DRIVEN = Sprocket(TEETH[1], ChainContact(1e7), (0.0692, 0.0), mass=0.2, inertia=2e-5, slide=Slide(0.0, 150.0, damping=100.0))
MODEL = ChainDrive(CHAIN, (DRIVER, DRIVEN))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"count": 4}, "count must be a whole number from 6 up, got 4"),
        ({"mass": -1.0}, "mass must be finite and above 0, got -1"),
        ({"joint_stiffness": np.nan}, "joint_stiffness must be finite and above 0, got nan"),
        ({"joint_damping": -1e-6}, "joint_damping must be finite and 0 or more"),
        ({"articulation_damping": -1e-6}, "articulation_damping must be finite and 0 or more"),
        ({"toe": 1e-3, "crotch": 2e-3}, "the toe .0.001 m below the pins. must lie deeper than the crotch"),
        ({"deviations": (1e-6,) * 5}, "5 pitch deviations for 24 plates"),
    ],
)
def test_chains(change, told):
    with pytest.raises(InputError, match=told):
        replace(MODEL, chain=replace(CHAIN, **change))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"contact": ChainContact(0.0)}, "sprocket 2: contact stiffness must be finite and above 0, got 0"),
        ({"inertia": 0.0}, "sprocket 2: inertia of a sprocket without a drive must be finite and above 0"),
        ({"mass": 0.0}, "sprocket 2: mass of a body on a slide"),
        ({"tip_radius": 0.01, "form_radius": 0.02}, "sprocket 2: tip radius 0.01 m must exceed form radius 0.02 m"),
        ({"slide": Slide(0.0, 1.0, damping=-1.0)}, "sprocket 2: slide damping must be finite and 0 or more"),
    ],
)
def test_sprockets(change, told):
    with pytest.raises(InputError, match=told):
        with_sprocket(MODEL, 1, **change)


def test_drives():
    with pytest.raises(InputError, match="1 sprocket is not enough for a loop"):
        ChainDrive(CHAIN, (DRIVER,))
    with pytest.raises(InputError, match="no sprocket is driven"):
        ChainDrive(CHAIN, (DRIVEN, DRIVEN))
    with pytest.raises(InputError, match="guide 1: side must be 'outside' or 'inside', got 'top'"):
        ChainDrive(CHAIN, (DRIVER, DRIVEN), (Guide((0, 0), 1.0, 0.0, 1.0, "top", 1e-3, ChainContact(1e6)),))


def test_a_step_beyond_stability_names_the_largest():
    with pytest.raises(InputError, match="largest stable one, 1e-05 s: the fastest mode has .* kHz"):
        simulate(MODEL, 0.01, Settings(step=1e-4))


def test_literal_contact_damping_is_told_as_over_critical():
    stiff = with_sprocket(MODEL, 0, contact=ChainContact(1e7, 1e4))
    with pytest.raises(InputError, match="damping of joints or contacts is .* times critical; take that step, .* or integrate implicitly"):
        simulate(stiff, 0.01)


def test_a_flank_too_short_for_its_seat():
    with pytest.raises(InputError, match="sprocket 1: a seated plate touches .* mm below its pins, but .* from .* to 1.5 mm"):
        simulate(replace(MODEL, chain=replace(CHAIN, toe=1.5e-3)), 0.01)
    with pytest.raises(InputError, match="sprocket 2: a seated plate touches at radius .* mm, but the flank is active from 0 to 10 mm"):
        simulate(with_sprocket(MODEL, 1, tip_radius=0.01), 0.01)


def test_loops_that_do_not_close():
    with pytest.raises(DoesNotAssemble, match="needs .* pitches, the chain has 24"):
        start(with_sprocket(MODEL, 1, slide=None, centre=(0.09, 0.0)))
    with pytest.raises(InputError, match="leaves the chain slack .*point its direction outward"):
        start(with_sprocket(MODEL, 1, slide=Slide(0.0, -150.0)))


@pytest.mark.parametrize(
    ("duration", "settings", "told"),
    [
        (0.0, Settings(), "duration must be finite and above 0 s"),
        (0.01, Settings(settle=0.02), "0.02 s of settling do not lie within"),
        (0.01, Settings(samples_per_tooth=5), "5 samples per tooth alias"),
        (0.01, Settings(joints=(24,)), "there is no joint 24; the chain has 0 .. 23"),
        (0.01, Settings(plate=-1), "there is no plate -1"),
    ],
)
def test_settings(duration, settings, told):
    with pytest.raises(InputError, match=told):
        simulate(MODEL, duration, settings)


def test_sweeps():
    with pytest.raises(InputError, match="needs 1 revolution"):
        campbell(MODEL, [-10.0], revolutions=0)
    with pytest.raises(InputError, match="needs 2 samples or more"):
        monte_carlo(MODEL, Scatter(), 1, 0.01)
    one, same, other = (scattered(MODEL, Scatter(1e-6, 2e-6), seed) for seed in (1, 1, 2))
    assert one.chain.deviations == same.chain.deviations != other.chain.deviations
    assert one.sprockets[0].tooth.support != MODEL.sprockets[0].tooth.support
