"""The independent routes of the chain drive's `verify` agree with the analyses, and would notice if they were wrong."""

import sys
from dataclasses import replace
from importlib import import_module

import pytest

import drivewright as dw
from drivewright import registry
from drivewright.spec import document, from_document

pytestmark = pytest.mark.analytical

route = import_module("drivewright.oracles.silent_chain.independent_check")
MECHANISM = registry.mechanism("silent-chain")
ONLY = ("meshing", "closure", "contact")


def spec(preset="default", **changes):
    """The preset; one or more of its tables changed."""
    base = document(dw.load(MECHANISM.presets()[preset]))
    merged = {key: {**base.get(key, {}), **value} if isinstance(value, dict) else value for key, value in changes.items()}
    return from_document({**base, **merged})


def rows(chosen, result=None):
    model = MECHANISM.build(chosen)
    return tuple(route.verify(model, result or dw.run(chosen, only=ONLY)))


def differing(found):
    return [name for name, ours, other, _, allowed, _ in found if not abs(ours - other) <= allowed]


@pytest.mark.parametrize(
    ("chosen", "least"),
    [
        (spec(), 24),
        (spec("classical"), 24),
        (spec("roller"), 2),
        (spec(closure={"strands": "straight"}), 23),
        (spec(cutter={"half_angle": "25 deg"}, joint={"offset": "minimax"}, links=83), 24),
        (spec(joint={"offset": "0.1 mm"}, meshing={"ideal": "rack"}), 24),
    ],
)
def test_the_other_routes_agree(chosen, least):
    found = rows(chosen)
    assert len(found) >= least
    assert differing(found) == []


def test_running_agrees_with_implicit_steps():
    chosen = spec(drive={"load_torque": "2 N m"})
    found = tuple(route._running(MECHANISM.build(chosen)))
    assert [row[0].split(" after")[0] for row in found] == ["slide", "transmission error", "tension"]
    assert differing(found) == []


@pytest.mark.parametrize(
    ("changes", "noticed"),
    [
        (
            {"joint": {"rolling_radius": "1.21 mm"}},
            {
                "hole_pitch",
                "pin_offset",
                "seated_pitch.driven",
                "modification.driven",
                "gap of a seated plate.drive",
                "rolling radius of the pins",
            },
        ),
        ({"teeth": [36, 37]}, {"pin_offset", "seated_pitch.drive", "modification.drive", "contact_radius.drive", "centre_distance.mean"}),
        ({"contact": {"force": "120 N"}, "joint": {"contact_length": "5 mm"}}, {"pin.force"}),
    ],
)
def test_a_wrong_result_is_noticed(changes, noticed):
    wrong = set(differing(rows(spec(), dw.run(spec(**changes), only=ONLY))))
    assert noticed <= wrong


def test_the_loop_notices_another_seat():
    """One plate seated more on the driver: the loop is another."""
    model = MECHANISM.build(spec())
    result = dw.run(model.spec, only=("closure",), model=model)
    states = model.closure.states
    moved = replace(model.closure, states=states._replace(seats=states.seats + [1, 0, 0, 0]))
    object.__setattr__(model, "__dict__", {**model.__dict__, "closure": moved})
    assert len(differing(tuple(route._loop(model, result)))) == 2


def test_without_mpmath_long_doubles_do(monkeypatch):
    monkeypatch.setitem(sys.modules, "mpmath", None)
    found = rows(spec())
    assert differing(found) == []
    assert "long doubles" in found[0][-1]
