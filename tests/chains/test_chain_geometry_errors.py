"""What plates and sprockets refuse, with the number that is wrong and the way out."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright.chains.link import Link, design_link
from drivewright.chains.plate import design_plate
from drivewright.chains.plate_holes import HingePin, RockerPins, RoundPins
from drivewright.chains.plate_stack import sheet_heights
from drivewright.chains.roller_sprocket import design_roller_sprocket, roller_plate
from drivewright.chains.sprocket import design_sprocket
from drivewright.chains.tooth import Cutter
from drivewright.errors import InputError

pytestmark = pytest.mark.error

P, A = 9.525e-3, np.radians(30)
CHAIN = design_link(P, 1.2e-3, A, 2.6e-3)
HINGE = Link(P, 0.0, A, CHAIN.flank_support)
CLASSICAL = Link(P + 14.8e-3, 7.4e-3, A, CHAIN.flank_support)


def refuses(text, make, *args, **kwargs):
    with pytest.raises(InputError, match=text):
        make(*args, **kwargs)


@pytest.mark.parametrize(
    "text, lengths",
    [
        ("toe -1, crotch -1.4 and back 3.1 mm", {"toe": -1e-3}),
        ("crotch below and back above 0", {"crotch": 0.1e-3}),
        ("back -1 mm", {"back": -1e-3}),
        ("thickness = 0 m; it must be finite and positive", {"thickness": 0.0}),
        ("toe_radius = nan", {"toe_radius": np.nan}),
        ("crotch_radius = -0.001 m; it must be finite and not negative", {"crotch_radius": -1e-3}),
        ("need 0.4.* mm more than the 1.1.* mm of edge 'toe left'", {"toe_radius": 1.4e-3}),
        ("toe at -8 mm has the width -1.*shorter toes", {"toe": -8e-3}),
        ("inner flanks cross below the crotch at -1.4 mm; they are -.* apart.*inner_gap", {"inner_gap": -1.5e-3}),
    ],
)
def test_plate_refuses(text, lengths):
    refuses(text, design_plate, CHAIN, **lengths)


@pytest.mark.parametrize(
    "text, chain, pins",
    [
        ("HingePin: the link's pins roll with r = 1.2 mm", CHAIN, HingePin(1e-3)),
        ("HingePin: radius = 5 mm; it lies between 0 and half the pitch, 4.76", HINGE, HingePin(5e-3)),
        ("RoundPins: rolling radius r = 0 m.*HingePin", HINGE, RoundPins()),
        ("clearance = 1 pin radii; it lies between 1", CHAIN, RoundPins(clearance=1.0)),
        ("turn = -0.1 rad", CHAIN, RoundPins(turn=-0.1)),
        ("reach 7.48.* mm inwards.*overlap in a plate of hole pitch 14.3.*RockerPins", design_link(P, 2.4e-3, A, 2.6e-3), RoundPins()),
        ("back_radius = -0.001 m", CLASSICAL, RockerPins(-1e-3, 1e-3, 1e-4)),
        ("thickness = 1.5 mm; with back_radius 1.5 mm.*between 1.55 mm.*and 3 mm", CLASSICAL, RockerPins(1.5e-3, 1.5e-3, 1e-4)),
        ("reach 5.1 mm from the pitch points overlap", CLASSICAL, RockerPins(3e-3, 5e-3, 1e-4)),
        ("the joint turns from .*° only, 0 to 45.84° are required", CLASSICAL, RockerPins(1.6e-3, 2e-3, 2e-4, 0.8)),
    ],
)
def test_pins_refuse(text, chain, pins):
    refuses(text, design_plate, chain, pins)


def test_plate_refuses_steep_flanks_and_unknown_sides():
    refuses("flank angle = 50°; it lies between 0 and 45", design_plate, CHAIN._replace(flank_angle=np.radians(50)))
    refuses("side = 'top'; a plate has a 'left' and a 'right' side", design_plate(CHAIN).hole, "top")


def test_a_stack_needs_alternating_sheets():
    refuses("lacing 1 x 3: alternating plates", sheet_heights, design_plate(CHAIN), (1, 3))


@pytest.mark.parametrize(
    "text, teeth, lengths",
    [
        ("teeth = 35.5; the number is whole", 35.5, {}),
        ("teeth = 5; the number is whole and at least 6", 5, {}),
        ("the root lies below the chamfer", 35, {"root_radius": 0.052}),
        ("chamfer -0.1 mm", 35, {"tip_chamfer": -1e-4}),
        ("tip nan mm", 35, {"tip_radius": np.nan}),
        ("no involute is left between the form radius 47.9.* mm and the chamfered tip at 47.8 mm", 35, {"tip_radius": 0.048}),
        ("teeth are pointed; their flanks meet at 53.* mm, the tip is at 54 mm", 35, {"tip_radius": 0.054}),
        ("tip_rounding = 2 mm; the hob's tip has room for more than 0 and at most 0.778", 35, {"tip_rounding": 2e-3}),
        ("bore|tip_rounding = 0 mm", 35, {"tip_rounding": 0.0}),
    ],
)
def test_sprocket_refuses(text, teeth, lengths):
    refuses(text, design_sprocket, CHAIN, teeth, **lengths)


def test_sprocket_refuses_a_foreign_cutter_a_wide_bore_and_unfit_pins():
    sprocket = design_sprocket(CHAIN, 35)
    refuses("cutter leaves the base radius 48.2.* mm, the tooth has 45.9", replace, sprocket, cutter=Cutter(1e-2, A))
    refuses("a bore of 100 mm breaks through the root", sprocket.drawing, 0.1)
    refuses("measuring pin of 9 mm touches at .* off the flank.*nearer to 5.24", sprocket.over_pins, 9e-3)
    refuses("measuring pin of 1 mm touches no flank", sprocket.over_pins, 1e-3)


def test_hob_refuses_a_rounding_above_its_rolling_circle():
    refuses(
        "reaches over the rolling circle of 48.899 mm.*lower root",
        design_sprocket,
        CHAIN,
        35,
        Cutter(P * np.cos(A) / np.cos(np.radians(20)), np.radians(20)),
        root_radius=0.0488,
    )


@pytest.mark.parametrize(
    "text, args, lengths",
    [
        ("at least 5 teeth", (4, P, 6e-3), {}),
        ("a roller smaller than the pitch", (17, P, 1e-2), {}),
        ("space = 1.2; it lies between 0", (17, P, 6.35e-3, 1.2), {}),
        ("seat_radius = 3 mm; a roller of 6.35 mm", (17, P, 6.35e-3), {"seat_radius": 3e-3}),
        ("tip_radius = 22 mm; it must lie on the flank arcs, which reach from 24.667 to", (17, P, 6.35e-3), {"tip_radius": 0.022}),
        ("pointed below the tip at 29.5 mm; they overlap by", (17, P, 6.35e-3, 1.0), {"tip_radius": 0.0295}),
        ("seat_angle = 200°", (17, P, 6.35e-3), {"seat_angle": np.radians(200)}),
    ],
)
def test_roller_sprocket_refuses(text, args, lengths):
    refuses(text, design_roller_sprocket, *args, **lengths)


def test_roller_sprocket_and_plate_refuse_what_breaks_through():
    refuses("a bore of 60 mm breaks through the root", design_roller_sprocket(17, P, 6.35e-3).drawing, 0.06)
    refuses("end_radius = 5 mm", roller_plate, P, 5e-3, 5e-3)
    refuses("arcs of the waist meet; waist_radius = 0.2 mm must exceed", roller_plate, P, 3e-3, 0.2e-3)
