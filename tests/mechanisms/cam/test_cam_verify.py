"""The independent route of `verify` agrees with the analyses, and would notice if they were wrong."""

import pytest

import drivewright as dw
from drivewright import registry
from drivewright.spec import document, from_document

pytestmark = pytest.mark.analytical

MECHANISM = registry.mechanism("cam")
ONLY = ("geometry", "profile")


def rows(spec, result=None):
    return tuple(MECHANISM.verify(MECHANISM.build(spec), result or dw.run(spec, only=ONLY)))


def differing(found):
    return [name for name, ours, other, _, allowed, _ in found if not abs(ours - other) <= allowed]


@pytest.mark.parametrize(
    ("preset", "changes"),
    [
        ("default", {"rotation": "clockwise"}),
        ("oscillating", {}),
        ("oscillating", {"rotation": "clockwise"}),
        ("flat", {}),
        ("default", {"follower": {"face": "knife", "prime_radius": "40 mm", "offset": "6 mm"}}),
    ],
)
def test_the_other_route_agrees(preset, changes):
    spec = dw.load(MECHANISM.presets()[preset]).replace(**changes)
    found = rows(spec)
    assert len(found) >= 3
    assert differing(found) == []


def test_a_wrong_result_is_noticed():
    spec = dw.load(MECHANISM.presets()["default"])
    other = from_document({**document(spec), "follower": {**document(spec)["follower"], "prime_radius": "41 mm"}})
    wrong = differing(rows(spec, dw.run(other, only=ONLY)))
    assert {"profile.area", "profile.perimeter", "max_pressure_angle", "min_convex_radius"} <= set(wrong)
