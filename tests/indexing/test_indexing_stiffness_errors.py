"""What the torsional stiffness of an indexer refuses, and how it says so."""

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import Drivetrain, GearMesh, PinContact, PowerLawBearing, SplitShaft, pin_contact, refuse_invalid
from drivewright.indexing.stiffness import solve_torsional_stiffness
from drivewright.indexing.stiffness.layout import bending_stiffness, torsion_stiffness
from drivewright.shafts import Section

pytestmark = pytest.mark.error

DRIVE = Drivetrain(0.11, crank=PowerLawBearing(4e7))
SHAFT = SplitShaft((Section(0.1, 0.02, 0.02),), 0.0, (0.025, 0.1), (0.05, 0.075), 206e9, 0.3)
ONE = CamContacts(np.array([0]), np.array([0.12j]), np.array([1.0 + 0j]), np.array([-0.12]), np.zeros(1), np.zeros(1), np.array([True]))


@pytest.mark.parametrize(
    ("drive", "parts"),
    [
        (DRIVE._replace(spacing=0.0), ("spacing = 0 m", "above 0")),
        (DRIVE._replace(housing=-1e8), ("housing = -1e+08 N/m", "leave it out for a rigid part")),
        (DRIVE._replace(crank=PowerLawBearing(-4e7)), ("crank.constant", "above 0")),
        (DRIVE._replace(support=PowerLawBearing(4e7, 0.8)), ("support.exponent = 0.8", "1 or more")),
        (DRIVE._replace(support=PowerLawBearing(4e7, 1.0, -1e-6)), ("support.clearance = -1e-06 m", "0 or more")),
        (DRIVE._replace(pins=PinContact(series=0.0)), ("pins.series = 0 N/m",)),
        (DRIVE._replace(gear=GearMesh(0.06, 2e8, 0.35)), ("60 mm", "110 mm apart", "below half")),
        (DRIVE._replace(gear=GearMesh(0.02, 2e8, 0.35, -1e-5)), ("gear.backlash = -1e-05 m", "0 or more")),
        (DRIVE._replace(gear=GearMesh(0.02, 2e8, 20.0)), ("pressure angle", "1146°", "radians")),
        (DRIVE._replace(shaft=SHAFT._replace(cams=(0.05,))), ("positions for 1 cams", "has 2")),
        (DRIVE._replace(shaft=SHAFT._replace(supports=(0.1, 0.025))), ("front support at 100 mm", "25 mm")),
        (DRIVE._replace(shaft=SHAFT._replace(cams=(0.05, 0.05))), ("50 mm", "different positions")),
    ],
)
def test_parts_without_a_meaning(drive, parts):
    with pytest.raises(InputError) as caught:
        refuse_invalid(drive, 2)
    for part in parts:
        assert part in str(caught.value)


def test_a_station_on_a_support():
    with pytest.raises(InputError, match="station 'cam 1' stands on a rigid bearing"):
        bending_stiffness(SHAFT._replace(cams=(0.025, 0.075)))


def test_a_place_off_the_shaft():
    with pytest.raises(InputError, match="outside the shaft"):
        torsion_stiffness(SHAFT._replace(cams=(0.05, 0.3)))


def test_a_width_of_nothing():
    with pytest.raises(InputError, match="width must be above 0, got 0 mm"):
        pin_contact(0.0)


@pytest.mark.parametrize("torque", [0.0, np.nan, np.inf])
def test_no_torque(torque):
    with pytest.raises(InputError, match="finite and not 0.*no secant"):
        solve_torsional_stiffness(DRIVE, [0.1], [ONE], 0.01, torque)


def test_as_many_contacts_as_positions():
    with pytest.raises(InputError, match="2 positions need as many sets of contacts, got 1"):
        solve_torsional_stiffness(DRIVE, [0.1, 0.2], [ONE], 0.01, 100.0)


def test_an_unknown_model():
    with pytest.raises(InputError, match="no model 'glued'.*unilateral.*bonded"):
        solve_torsional_stiffness(DRIVE, [0.1], [ONE], 0.01, 100.0, model="glued")
