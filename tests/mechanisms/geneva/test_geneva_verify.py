"""The independent routes of `verify` agree with the analyses, and would notice if they were wrong."""

from dataclasses import replace

import pytest

import drivewright as dw
from drivewright import registry
from drivewright.spec import load

pytestmark = pytest.mark.analytical

MECHANISM = registry.mechanism("geneva")
PRESETS = MECHANISM.presets()


def rows(spec, result=None):
    return tuple(MECHANISM.verify(MECHANISM.build(spec), result or dw.run(spec)))


def differing(found):
    return [name for name, ours, other, _, allowed, _ in found if not abs(ours - other) <= allowed]


CHANGES = (
    (),
    ("slots=3", "pin.radius=3 mm", "pin.journal_radius=1 mm", "wheel.bore=8 mm", "wheel.hub_diameter=10 mm"),
    ("slots=12", "pin.radius=2 mm", "pin.journal_radius=1 mm", "pin.kind=fixed", "locking.bore=2 mm"),
    ("crank_radius=70.72 mm", "load.process_torque=-2 N m"),
    ("drive.law=polynomial-4567", "drive.inertia=0.01 kg m^2", "bearing.friction=0.1", "bearing.radius=8 mm"),
)


@pytest.mark.parametrize("changes", CHANGES, ids=lambda changes: changes[0] if changes else "default")
def test_the_other_routes_agree(changes):
    found = rows(load(PRESETS["default"], changes))
    assert len(found) >= 9 and differing(found) == []


def test_a_wrong_result_is_noticed():
    spec = load(PRESETS["default"])
    result = dw.run(spec)
    names = ("wheel.inertia", "wheel.mass", "locking.clearance", "crossing.speed", "crank.mean_power")
    wrong = replace(
        result, values={name: value._replace(value=value.value * (1.3 if name in names else 1.0)) for name, value in result.values.items()}
    )
    assert sorted(differing(rows(spec, wrong))) == sorted(names)
