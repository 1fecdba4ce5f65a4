"""Linkages side by side in lanes: the same trajectories, to the bit, as one after the other."""

import threading

import numpy as np
import pytest

from drivewright import cases
from drivewright.errors import InputError
from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import (
    AppliedForce,
    Body,
    Dry,
    Friction,
    JointDrive,
    LoadCurve,
    Lubricated,
    Marker,
    MasslessLink,
    MultibodyModel,
    PointSpring,
    Prismatic,
    Revolute,
    line,
)
from drivewright.multibody.simulate import Settings, simulate
from drivewright.numerics.ode import together as side_by_side
from drivewright.numerics.ode.together import Desk, together

pytestmark = pytest.mark.property

SPEED = 300.0
TURN = 2 * np.pi / SPEED


def slider_crank(wrist, crank_length=0.05, forces=()):
    """A crank at constant speed, a rod, a slider; `wrist` is the model of the pin between the latter."""
    bodies = (Body("crank", 0.3, 1e-4, (crank_length / 2, 0.0)), Body("rod", 0.21, 2.5e-4, (0.06, 0.0)), Body("slider", 0.14, 1e-4))
    joints = (
        Revolute("main", Marker("ground"), Marker("crank")),
        Revolute("crank_pin", Marker("crank", crank_length), Marker("rod")),
        Revolute("wrist", Marker("rod", 0.12), Marker("slider"), wrist),
        Prismatic("guide", Marker("slider"), Marker("ground")),
    )
    return MultibodyModel(bodies, joints, forces, drives=(JointDrive("main", line(0.0, SPEED)),), gravity=(0.3, -9.81))


def dry(clearance, **more):
    """A dry pin of steel."""
    return Dry(clearance, 0.01, 6.6e10, 1.5, **{"hysteresis": 0.15, "length": 0.02} | more)


def pendulum_with_link(clearance):
    """Two pendulums whose ends a massless link holds at a distance of the clearance: a loop to be closed."""
    bodies = (Body("one", 1.0, 1e-3, (0.1, 0.0)), Body("two", 0.6, 1e-3, (0.1, 0.0), angle=0.3, velocity=(0.0, 0.0)))
    joints = (
        Revolute("a", Marker("ground"), Marker("one")),
        Revolute("b", Marker("ground", 0.25), Marker("two")),
        Revolute("c", Marker("one", 0.2), Marker("two", 0.2), MasslessLink(clearance)),
    )
    return MultibodyModel(bodies, joints, gravity=(0.0, -9.81))


SPRING = PointSpring("spring", Marker("slider"), Marker("ground", 0.2), stiffness=900.0, free_length=0.05, damping=3.0)
LOAD = AppliedForce("load", Marker("slider"), (1.0, 0.0), LoadCurve(line(-20.0, 3000.0)))
MODELS = {
    "impacts": lambda c: slider_crank(dry(c)),
    "kelvin-voigt and coulomb": lambda c: slider_crank(dry(c, hysteresis=0.0, damping=40.0, friction=Friction("coulomb", 0.1))),
    "lugre": lambda c: slider_crank(dry(c, friction=Friction("lugre", 0.1, 0.01, 0.0, 0.15, 1e5, 100.0, 0.02))),
    "cylinder and ambrosio": lambda c: slider_crank(
        Dry(c, 0.01, 1.1e11, 1.5, 0.15, cylinder=True, length=0.02, friction=Friction("ambrosio", 0.05, 0.02, 0.001))
    ),
    "oil": lambda c: slider_crank(Lubricated(dry(c), 0.05, "short")),
    "spring and load": lambda c: slider_crank(dry(c), forces=(SPRING, LOAD)),
}


def run(model, turns=1.2, **settings):
    """A run of a model from its assembly, its slider beside the middle of its play."""
    assembly = assemble(model)
    state = assembly.state
    state[0] += 1e-5
    return simulate(assembly, turns * TURN, Settings(**{"rtol": 1e-6} | settings), state=state)


def same(one, other):
    """Whether two runs are the same to the bit."""
    for first, second in zip(one.stretches, other.stretches, strict=True):
        np.testing.assert_array_equal(first.t, second.t)
        np.testing.assert_array_equal(first.y, second.y)
    np.testing.assert_array_equal(one.impacts, other.impacts)
    assert (one.steps, one.outcome) == (other.steps, other.outcome)


def side_by_side_and_alone(task, given):
    """The values of a task for each case, in lanes and one by one."""
    with together(max(len(given), side_by_side.WORTHWHILE), 1) as threads:
        assert threads > 1
        lanes = cases.run(task, given, threads)
    return [row.value for row in lanes.rows], [row.value for row in cases.run(task, given).rows]


@pytest.mark.parametrize("name", MODELS)
def test_runs_side_by_side_are_those_alone(name):
    given = np.linspace(1e-4, 5e-4, 11).tolist()
    found, alone = side_by_side_and_alone(lambda clearance: run(MODELS[name](clearance)), given)
    for one, other in zip(found, alone, strict=True):
        same(one, other)
    assert len({each.steps for each in alone}) > 3 and (name == "oil" or all(len(each.impacts) for each in alone))


def test_loops_are_closed_side_by_side():
    given = np.linspace(0.19, 0.26, 11).tolist()
    found, alone = side_by_side_and_alone(lambda length: run(pendulum_with_link(length), 20.0), given)
    for one, other in zip(found, alone, strict=True):
        same(one, other)


def test_cases_of_several_structures_and_lengths():
    """Six mechanisms in a row, each for other times, with methods and limits that lanes do not know."""
    names = list(MODELS)

    def task(n):
        more = {"method": "radau"} if n % 7 == 0 else {"max_steps": 150} if n % 5 == 0 else {}
        return run(MODELS[names[n % 2]](1e-4 * (1 + n % 4)), 0.2 + 0.1 * (n % 3), **more)

    found, alone = side_by_side_and_alone(task, list(range(24)))
    for one, other in zip(found, alone, strict=True):
        same(one, other)
    assert {each.outcome for each in alone} == {"complete", "partial"}


def test_a_limit_of_steps_in_the_middle_of_a_run(monkeypatch):
    monkeypatch.setattr(side_by_side, "STEPS", 60)
    given = np.linspace(1e-4, 5e-4, 9).tolist()
    found, alone = side_by_side_and_alone(lambda clearance: run(MODELS["impacts"](clearance), max_steps=200), given)
    for one, other in zip(found, alone, strict=True):
        same(one, other)
    assert {each.steps for each in alone} == {200}


def test_an_error_stays_with_its_case():
    def task(clearance):
        if clearance > 3e-4:
            raise InputError("too much")
        return run(MODELS["impacts"](clearance), 0.2)

    with together(side_by_side.WORTHWHILE, 1) as threads:
        rows = cases.run(task, [1e-4, 2e-4, 4e-4], threads).rows
    assert [row.reason for row in rows] == ["", "", "too much"]


def test_a_fault_reaches_who_asked(monkeypatch):
    def fails(*arguments):
        raise ZeroDivisionError("a fault of the program")

    monkeypatch.setattr(side_by_side.advancing, "advance_together", fails)
    desk = Desk(1)
    token = side_by_side.solving_with(desk.solve)
    try:
        with pytest.raises(ZeroDivisionError, match="a fault of the program"):
            run(MODELS["impacts"](2e-4), 0.2)
    finally:
        token.var.reset(token)
        desk.close()


def test_few_cases_go_alone_and_threads_end():
    before = threading.active_count()
    with together(side_by_side.WORTHWHILE - 1, 2) as threads:
        assert threads == 2 and threading.active_count() == before
    with together(side_by_side.WORTHWHILE, 2):
        assert threading.active_count() == before + 2
    assert threading.active_count() == before
