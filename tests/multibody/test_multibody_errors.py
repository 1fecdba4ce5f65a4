"""Multibody systems that cannot be, or cannot go on: what is said about them."""

import re

import numpy as np
import pytest

from drivewright.errors import DoesNotAssemble, InputError, UnknownName
from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import (
    GROUND,
    AppliedForce,
    AppliedTorque,
    Body,
    Dry,
    Gear,
    JointDrive,
    LoadCurve,
    Marker,
    MasslessLink,
    MultibodyModel,
    PointSpring,
    Prismatic,
    Revolute,
    line,
)
from drivewright.multibody.observe import observe
from drivewright.multibody.simulate import simulate

pytestmark = pytest.mark.error


def four_bar(crank=0.1, coupler=0.3, rocker=0.25, frame=0.35, angles=(0.5, 0.3, 1.2), drives=("O2",), extra=(), **more):
    return MultibodyModel(
        tuple(
            Body(name, 1.0, 0.01, (length / 2, 0.0), angle=angle)
            for name, length, angle in zip(("crank", "coupler", "rocker"), (crank, coupler, rocker), angles, strict=True)
        ),
        (
            Revolute("O2", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", crank), Marker("coupler")),
            Revolute("B", Marker("coupler", coupler), Marker("rocker", rocker)),
            Revolute("O4", Marker(GROUND, frame), Marker("rocker")),
            *extra,
        ),
        drives=tuple(JointDrive(name, line(0.0, 1.0)) for name in drives),
        **more,
    )


def refusal(kind, action, *words):
    with pytest.raises(kind) as caught:
        action()
    for word in words:
        assert word in str(caught.value), str(caught.value)
    return str(caught.value)


def test_the_four_bar_itself_is_sound():
    assembly = assemble(four_bar())
    assert assembly.freedom == 0
    assert assembly.findings == ()


@pytest.mark.parametrize("play", [None, Dry(1e-4, 0.01, 1e9), MasslessLink(1e-4)])
def test_impossible_loop_names_the_joint_and_how_much(play):
    """Coupler and rocker of 0.1 and 0.05 m cannot bridge the way from the crank's pin to O4."""
    model = four_bar(coupler=0.1, rocker=0.05)
    if play:
        joints = list(model.joints)
        joints[1] = Revolute("A", Marker("crank", 0.1), Marker("coupler"), play)
        model = MultibodyModel(model.bodies, tuple(joints), drives=model.drives)
    apart = abs(0.35 - 0.1 * np.exp(0.5j)) - 0.15
    message = refusal(DoesNotAssemble, lambda: assemble(model), "does not close", "joint '", "Check the lengths")
    assert float(re.search(r"a gap of ([\d.]+) mm", message)[1]) == pytest.approx(1e3 * apart, rel=0.02)


def test_drive_beyond_reach_names_the_drive_and_the_angle():
    """A crank that cannot go round: it stops where coupler and rocker are stretched."""
    model = four_bar(crank=0.3, coupler=0.2, rocker=0.15, frame=0.35, angles=(0.4, 0.3, 1.2))
    last = np.degrees(np.arccos((0.3**2 + 0.35**2 - 0.35**2) / (2 * 0.3 * 0.35)))
    refusal(DoesNotAssemble, lambda: simulate(assemble(model), 3.0), "cannot go on beyond t = ", f"'O2' at {last:.2f}°", "Change a length")
    assert simulate(assemble(model), np.radians(last) - 0.41).outcome == "complete"


def test_slide_driven_beyond_reach_names_the_way():
    """A rod of 0.2 m from a crank of 0.05 m holds the slider back at 0.25 m."""
    model = MultibodyModel(
        (Body("crank", 1.0, 0.01, angle=0.8), Body("rod", 1.0, 0.01, angle=-0.2), Body("slider", 1.0, 0.01)),
        (
            Revolute("O", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", 0.05), Marker("rod")),
            Revolute("B", Marker("rod", 0.2), Marker("slider")),
            Prismatic("guide", Marker("slider"), Marker(GROUND)),
        ),
        drives=(JointDrive("guide", line(0.22, 0.01)),),
    )
    refusal(DoesNotAssemble, lambda: simulate(assemble(model), 5.0), "'guide' at 250 mm")


def test_redundant_joint_is_found_and_named():
    """A parallel crank between the rockers of a parallelogram repeats what they do already."""
    model = four_bar(crank=0.2, coupler=0.35, rocker=0.2, frame=0.35, angles=(1.0, 0.0, 1.0))
    third = Body("third", 1.0, 0.01, angle=1.0)
    more = (Revolute("O5", Marker(GROUND, 0.1), Marker("third")), Revolute("C", Marker("coupler", 0.1), Marker("third", 0.2)))
    assembly = assemble(MultibodyModel((*model.bodies, third), (*model.joints, *more), drives=model.drives))
    assert assembly.freedom == 0
    assert len(assembly.findings) == 1
    assert "repeats a constraint" in assembly.findings[0]
    assert "not determined" in assembly.findings[0]
    assert any(f"'{name}'" in assembly.findings[0] for name in ("B", "O4", "O5", "C"))
    assert simulate(assembly, 1.0).outcome == "complete"


def test_drive_of_a_frame_cannot_move():
    model = four_bar(extra=(Gear("lock", "crank", "rocker", 1.0),))
    message = refusal(DoesNotAssemble, lambda: assemble(model), "cannot move", "Remove a joint or a drive")
    assert any(f"'{name}'" in message for name in ("lock", "B", "A", "O4"))


def test_start_in_a_dead_point():
    """A slider-crank driven by its slider, crank and rod in line."""
    model = MultibodyModel(
        (Body("crank", 1.0, 0.01), Body("rod", 1.0, 0.01), Body("slider", 1.0, 0.01)),
        (
            Revolute("O", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", 0.05), Marker("rod")),
            Revolute("B", Marker("rod", 0.2), Marker("slider")),
            Prismatic("guide", Marker("slider"), Marker(GROUND)),
        ),
        drives=(JointDrive("guide", line(0.25, -0.01)),),
    )
    refusal(DoesNotAssemble, lambda: assemble(model), "singular position", "few degrees away")


def test_unknown_driven_joint():
    refusal(UnknownName, lambda: assemble(four_bar(drives=("O3",))), "driven joint", "'O3'", "O2")


def test_a_gear_cannot_be_driven():
    model = four_bar(drives=("lock",), extra=(Gear("lock", "crank", "rocker", 1.0),))
    refusal(InputError, lambda: assemble(model), "'lock'", "cannot be driven")


def test_too_many_drives():
    """Two for one freedom, two of one joint, and two joints about one axis."""
    found = assemble(four_bar())
    seen = observe(found.system, [0.0], found.state[None])
    angles = [seen.body(found.names.index(name), "angle")[0] for name in ("crank", "coupler", "rocker")]
    refusal(DoesNotAssemble, lambda: assemble(four_bar(drives=("O2", "O4"), angles=angles)), "'O2' and 'O4' conflict")
    refusal(InputError, lambda: assemble(four_bar(drives=("O2", "O2"))), "'O2'", "twice")
    again = (Revolute("again", Marker(GROUND), Marker("crank")),)
    refusal(InputError, lambda: assemble(four_bar(drives=("O2", "again"), extra=again)), "'O2' and 'again' conflict")
    loose = (Revolute("loose", Marker(GROUND), Marker("crank"), Dry(1e-4, 0.01, 1e9)),)
    refusal(InputError, lambda: assemble(four_bar(drives=("O2", "loose"), extra=loose)), "'O2' and 'loose' conflict")


@pytest.mark.parametrize(
    "joint",
    [
        Revolute("X", Marker("crank"), Marker("lever")),
        Prismatic("X", Marker("lever"), Marker(GROUND)),
        Gear("X", "crank", "lever", 2.0),
        Revolute("X", Marker("lever"), Marker(GROUND), Dry(1e-4, 0.01, 1e9)),
    ],
)
def test_joint_of_an_unknown_body(joint):
    refusal(UnknownName, lambda: assemble(four_bar(extra=(joint,))), "'lever'", "'X'", "crank")


@pytest.mark.parametrize(
    "force",
    [
        PointSpring("X", Marker("crank"), Marker("lever"), 1.0),
        AppliedTorque("X", "lever", LoadCurve(line(1.0, 0.0))),
        AppliedForce("X", Marker("lever"), (1.0, 0.0), LoadCurve(line(1.0, 0.0))),
    ],
)
def test_force_on_an_unknown_body(force):
    refusal(UnknownName, lambda: assemble(four_bar(forces=(force,))), "'lever'", "'X'")


def test_axis_without_direction():
    slide = Prismatic("X", Marker("crank"), Marker(GROUND), (0.0, 0.0))
    refusal(InputError, lambda: assemble(four_bar(extra=(slide,))), "'X'", "no direction")
