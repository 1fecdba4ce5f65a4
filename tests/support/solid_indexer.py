"""The drive that the tests of its solids share: the sheet's set A."""

from functools import cache

import numpy as np

from drivewright.bearings import approximate_stiffness
from drivewright.indexing.drivetrain import Drivetrain, GearMesh, SplitShaft, pin_contact, power_law_bearing
from drivewright.indexing.motion import index_motion
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import find_contacts
from drivewright.indexing.solid import CamBody, ShaftBody, solid_stiffness
from drivewright.shafts import Section

WIDTH, E, NU = 0.018, 206e9, 0.3
CAM, SHAFT = CamBody(WIDTH, 0.072), ShaftBody(0.035, WIDTH, 0.009, 0.014)
CRANK = power_law_bearing(lambda force: approximate_stiffness.liu_roller(force, 14, 8.5e-3))
SUPPORT = power_law_bearing(lambda force: approximate_stiffness.liu_ball(force, 11, 4.762e-3))
ANGLES = np.radians([20.0, 45.0, 83.0])


@cache
def wheel(side="inside"):
    return PinWheel(12, 0.12, 0.008, 0.01, index_motion("modified-sine", 12, 1.0), side)


def split_shaft(cams=2, modulus=E):
    places = tuple(0.05 + 0.025 * j for j in range(cams))
    sections = (Section(0.03, 0.02, 0.02), Section(places[-1] + 0.01 - 0.03, 0.03, 0.03), Section(0.015, 0.02, 0.02))
    return SplitShaft(sections, 0.0, (0.025, places[-1] + 0.025), places, modulus, NU)


def drive(cams=2, **changes):
    gear = GearMesh(0.0275, 2.8e8, np.radians(20.0))
    return Drivetrain(0.11, pin_contact(WIDTH, 5e8), CRANK, SUPPORT, None, split_shaft(cams), gear)._replace(**changes)


def solved(train, solids, torque=-1000.0, side="inside", theta=ANGLES, **settings):
    return solid_stiffness(wheel(side), train, solids, theta, [find_contacts(wheel(side), each) for each in theta], torque, **settings)
