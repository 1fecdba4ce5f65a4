"""Kernels: forces on the bodies, element by element, at a known state."""

from drivewright._jit import inner
from drivewright._typing import Floats
from drivewright.multibody.forces.actuator import apply_actuator
from drivewright.multibody.forces.bushing import apply_bushing
from drivewright.multibody.forces.load import apply_load_force, apply_torque
from drivewright.multibody.forces.pin_contact import apply_pin_contact
from drivewright.multibody.forces.rotational_spring import apply_rotational_spring
from drivewright.multibody.forces.spring import apply_spring
from drivewright.multibody.system import System, Work


@inner
def apply_forces(system: System, work: Work, t: float, y: Floats, dy: Floats) -> None:
    """All forces and torques on the bodies at the time t [s]; the rates of the elements' own states go into dy.

    y, dy (states,): stored positions [m, rad], independent rates, then the states of the contacts (`forces.pin_contact`).
    """
    clear_forces(work)
    apply_springs(system, work)
    apply_loads(system, work, t)
    pin_forces(system, work, y, dy)


@inner
def pin_forces(system: System, work: Work, y: Floats, dy: Floats) -> None:
    """Pins with play; y, dy (states,) as in `apply_forces`."""
    for n in range(system.contacts.size):
        apply_pin_contact(system, n, work, y, dy)


@inner
def clear_forces(work: Work) -> None:
    """No force and no torque on any body."""
    for i in range(work.poses.size):
        pose = work.poses[i]
        pose.fx = pose.fy = pose.ft = 0.0


@inner
def apply_springs(system: System, work: Work) -> None:
    """Springs, dampers and bushings."""
    for n in range(system.springs.size):
        apply_spring(work.poses, system.springs[n])
    for n in range(system.rotational_springs.size):
        apply_rotational_spring(work.poses, system.rotational_springs[n])
    for n in range(system.bushings.size):
        apply_bushing(work.poses, system.bushings[n])


@inner
def apply_loads(system: System, work: Work, t: float) -> None:
    """Torques and forces from outside."""
    for n in range(system.torques.size):
        apply_torque(work.poses, system.torques[n], system.curves, system.pieces, t)
    for n in range(system.forces.size):
        apply_load_force(work.poses, system.forces[n], system.curves, system.pieces, t)
    for n in range(system.actuators.size):
        apply_actuator(work.poses, system.actuators[n], system.curves, system.pieces, t)
