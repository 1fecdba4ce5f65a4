"""A chain at speed: its unevenness, the forces in it, the impact of joint and seat, strands in resonance.

Only what follows from mechanics; strengths and allowable pressures are the user's.  w is a sprocket's angular speed [rad/s], t = pi/z,
q the chain's mass per length [kg/m].
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Numbers
from drivewright.chains.standards.given import above_zero, from_zero, whole, whole_teeth
from drivewright.chains.standards.layout import pitch_diameter, strand_angle_cosine
from drivewright.errors import InputError

# Effective mass of the meeting joint over a link's: the seated link's own share, and that of the endless straight strand behind it.
MEETING_SHARE = 1 / 3 + 1 / np.sqrt(12)


def chain_speed(pitch: float, teeth: int, angular_speed: float) -> float:
    """Mean speed p z w/(2 pi)  [m/s]: z pitches to a turn."""
    above_zero("chain", pitch=pitch)
    whole_teeth("chain", teeth)
    return pitch * teeth * angular_speed / (2 * np.pi)


def mesh_frequency(teeth: Numbers, angular_speed: Numbers) -> Numbers:
    """Joints that meet the sprocket in a second, z w/(2 pi)  [Hz]."""
    whole_teeth("chain", teeth)
    return teeth * angular_speed / (2 * np.pi)


def speed_range(pitch: Numbers, teeth: Numbers, angular_speed: Numbers) -> tuple[Numbers, Numbers]:
    """Least and greatest speed of a long straight strand along itself [m/s]: R w cos t and R w."""
    greatest = 0.5 * pitch_diameter(pitch, teeth) * angular_speed
    return greatest * np.cos(np.pi / np.asarray(teeth)), greatest


def speed_fluctuation(teeth: Numbers) -> Numbers:
    """Range of the strand's speed over its mean, t tan(t/2)  [-]; pi^2/(2 z^2) for many teeth."""
    whole_teeth("chain", teeth)
    t = np.pi / np.asarray(teeth)
    return t * np.tan(t / 2)


def centrifugal_tension(mass_per_length: Numbers, speed: Numbers) -> Numbers:
    """q v^2  [N]: the tension with which a chain runs around any curve without pressing on it."""
    from_zero("chain", mass_per_length=mass_per_length)
    return mass_per_length * np.square(speed)


def strand_tension(power: Numbers, speed: Numbers, mass_per_length: Numbers, slack_tension: Numbers = 0.0) -> Numbers:
    """Tension of the tight strand, P/v + q v^2 + F0  [N].

    slack_tension F0 [N]: what the resting chain carries, from its sag or a tensioner.
    """
    above_zero("chain", speed=speed)
    from_zero("chain", power=power, slack_tension=slack_tension)
    return power / speed + centrifugal_tension(mass_per_length, speed) + slack_tension


def strand_pulls(preload: float, torque: float, pitch: float, teeth: int, cosine: float) -> tuple[float, float]:
    """Forces of the tight and of the slack strand without the centrifugal one, F/(2 cos g) +- pi T/(z p)  [N].

    preload F [N]: between the sprockets; torque T [N m]: on the one with z teeth; cosine: that of the strands' angle g to the centres.
    """
    pull = torque * 2 * np.pi / (teeth * pitch)
    along = preload / cosine
    return 0.5 * (along + pull), 0.5 * (along - pull)


class StrandForces(NamedTuple):
    """Strands of a running drive: speed of the chain [m/s]; centrifugal force [N]; tight and slack strand [N] without it."""

    speed: float
    centrifugal: float
    tight: float
    slack: float

    @property
    def tension(self) -> float:
        """The whole tension of the tight strand  [N]."""
        return self.tight + self.centrifugal


def strand_forces(
    pitch: float, teeth: tuple[int, int], links: int, mass_per_length: float, speed: float, preload: float, torque: float
) -> StrandForces:
    """`StrandForces` of a chain around two sprockets: `strand_pulls` by the pitch circles, and q v^2.

    pitch [m]; mass_per_length q [kg/m]; speed [rad/s] of the driving sprocket; preload [N] between the sprockets; torque [N m] that the
    driven one overcomes.
    """
    velocity = chain_speed(pitch, teeth[0], speed)
    tight, slack = strand_pulls(preload, torque, pitch, teeth[1], strand_angle_cosine(pitch, *teeth, links))
    return StrandForces(velocity, float(centrifugal_tension(mass_per_length, velocity)), tight, slack)


def tensile_safety(tensile_strength: float, tension: float) -> float:
    """Minimum tensile strength, the user's, over the tension of the tight strand  [-]."""
    above_zero("chain", tensile_strength=tensile_strength, tension=tension)
    return tensile_strength / tension


def max_power(allowable_tension: float, mass_per_length: float, slack_tension: float = 0.0) -> tuple[float, float]:
    """Speed [m/s] at which a chain of given tension carries the greatest power, and that power [W].

    P = v (F - F0 - q v^2) is greatest at v = sqrt((F - F0)/(3 q)), where it is 2/3 v (F - F0).  At sqrt(3) of that speed nothing is left.
    """
    above_zero("chain", mass_per_length=mass_per_length, tension_above_that_at_rest=np.subtract(allowable_tension, slack_tension))
    free = np.subtract(allowable_tension, slack_tension)
    speed = np.sqrt(free / (3 * mass_per_length))
    return speed, 2 / 3 * speed * free


def articulation_pressure(tension: float, pin_diameter: float, bush_length: float, strands: int = 1) -> float:
    """Pressure in the joints, F/(n d b), on the projected bearing area  [Pa]; strands n of a multiple chain carry alike."""
    from_zero("chain joint", tension=tension)
    above_zero("chain joint", pin_diameter=pin_diameter, bush_length=bush_length, strands=strands)
    return tension / (strands * pin_diameter * bush_length)


def meeting_velocity(pitch: Numbers, angular_speed: Numbers, normal_angle: float = 0.5 * np.pi) -> Numbers:
    """Velocity [m/s] at which a joint of a long straight strand meets its seat, along the normal of the contact: p w sin b.

    The strand translates with its last seated joint, so the next one is ahead of its seat by w x the link: p w across the link.
    normal_angle b [rad]: between link and contact normal; a right angle gives the whole velocity.
    """
    above_zero("chain", pitch=pitch)
    return pitch * np.abs(angular_speed) * np.sin(normal_angle)


def meeting_energy(pitch: float, mass_per_length: float, angular_speed: float) -> float:
    """Energy [J] lost where a joint of a long straight strand of uniform links comes to rest in its seat: m (1/3 + 1/sqrt(12)) (p w)^2/2.

    m = q p.  Behind the joint the hinged links take a velocity that falls by -(2 - sqrt 3) from joint to joint, which adds m/sqrt(12);
    the link before it turns about its seated joint, m/3.  The joint can only move across the link, so the direction of the contact
    normal changes the impulse, not the energy.  The sprocket counts as heavy.
    """
    from_zero("chain", mass_per_length=mass_per_length)
    velocity = meeting_velocity(pitch, angular_speed)
    return 0.5 * MEETING_SHARE * mass_per_length * pitch * velocity**2


def strand_frequency(tension: Numbers, mass_per_length: float, length: float, speed: Numbers = 0.0, mode: int = 1) -> Numbers:
    """Natural frequency of a strand that runs through two fixed places, n (c^2 - v^2)/(2 L c), c = sqrt(T/q)  [Hz].

    tension T: the whole of it, the centrifugal one included; so T > q v^2, or there is none.
    """
    above_zero("chain strand", tension=tension, mass_per_length=mass_per_length, length=length)
    whole("chain strand", mode=mode)
    wave = np.sqrt(np.divide(tension, mass_per_length))
    if np.any(np.abs(speed) >= wave):
        raise InputError(
            f"chain strand: its speed of {np.max(np.abs(speed)):g} m/s exceeds the wave speed of {np.min(wave):g} m/s; "
            "the tension must exceed the centrifugal tension q v^2. Give the total tension of the running strand."
        )
    return mode * (wave - speed) * (wave + speed) / (2 * length * wave)


def resonance_speed(pull: Numbers, mass_per_length: float, length: float, pitch: float, mode: int = 1, harmonic: float = 1) -> Numbers:
    """Chain speed [m/s] at which a harmonic k of the meshing meets the mode n of a strand: k v/p = n (c^2 - v^2)/(2 L c).

    pull F [N]: what the strand carries besides the centrifugal tension; c^2 - v^2 = F/q = s.  With b = n p s/(2 k L):
    v^2 (s + v^2) = b^2, v^2 = 2 b^2/(s + sqrt(s^2 + 4 b^2)).
    """
    above_zero("chain strand", pull=pull, mass_per_length=mass_per_length, length=length, pitch=pitch)
    whole("chain strand", mode=mode, harmonic=harmonic)
    s = np.divide(pull, mass_per_length)
    b = mode * pitch * s / (2 * harmonic * length)
    return b * np.sqrt(2 / (s + np.sqrt(s**2 + 4 * b**2)))
