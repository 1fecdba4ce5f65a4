"""Extreme but legal chains run: finite and audited, or refused with a reason; never a traceback."""

import tomllib

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.errors import DrivewrightError
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.property

HYVO = EXAMPLES / "hyvo_chain.toml"
SHORT = ('dynamics.settling="4 ms"', 'dynamics.duration="6 ms"', "dynamics.ensemble=2")

EXTREMES = {
    "a millisecond": ('dynamics.duration="1 ms"', 'dynamics.settling="0 s"'),
    "two teeth": ('dynamics.duration="1.8 ms"', 'dynamics.settling="0 s"'),
    "one run": (*SHORT, "dynamics.ensemble=1"),
    "few links": (*SHORT, "links=24", "teeth=[9, 9]"),
    "fewest": (*SHORT, "links=14", "teeth=[6, 6]"),
    "many links": (*SHORT, "links=300"),
    "unequal": (*SHORT, "links=130", "teeth=[9, 120]"),
    "tiny radius": (*SHORT, 'joint.rolling_radius="1e-9 mm"'),
    "small radius": (*SHORT, 'joint.rolling_radius="0.01 mm"'),
    "huge radius": (*SHORT, 'joint.rolling_radius="40 mm"'),
    "fast": ('drive.speed="30000 rpm"', 'dynamics.settling="0.4 ms"', 'dynamics.duration="0.6 ms"'),
    "faster": ('drive.speed="300000 rpm"', 'dynamics.settling="0.04 ms"', 'dynamics.duration="0.06 ms"'),
    "slow": (*SHORT, 'drive.speed="30 rpm"'),
    "stiff": (*SHORT, 'contact.stiffness="1e7 N/mm"'),
    "very stiff": (*SHORT, 'contact.stiffness="1e12 N/mm"', 'dynamics.duration="1e-5 s"'),
    "soft": (*SHORT, 'contact.stiffness="1e3 N/mm"'),
    "very soft": (*SHORT, 'contact.stiffness="10 N/mm"'),
    "softest": (*SHORT, 'contact.stiffness="1e-6 N/mm"'),
    "no damping": (*SHORT, 'contact.joint_damping="0 s"', "contact.articulation_damping_ratio=0", "driven.damping_ratio=0"),
    "over-damped": (*SHORT, "contact.articulation_damping_ratio=1e4"),
    "heavy articulation": (*SHORT, "contact.articulation_damping_ratio=3"),
    "light links": (*SHORT, 'plate.link_mass="1 mg"'),
    "heavy sprocket": (*SHORT, 'driven.mass="1e6 kg"'),
    "light sprocket": (*SHORT, 'driven.mass="1 mg"'),
    "preload of a newton": (*SHORT, 'drive.preload="1 mN"'),
    "preload of a mega-newton": (*SHORT, 'drive.preload="1 MN"'),
    "overload": (*SHORT, 'drive.load_torque="500 N m"'),
    "implicit": (*SHORT, 'dynamics.integrator="implicit"', 'dynamics.duration="2 ms"', 'dynamics.settling="0 s"'),
    "coarse implicit": (*SHORT, 'dynamics.integrator="implicit"', 'dynamics.step="1 ms"'),
    "small pitch": (*SHORT, 'pitch="0.1 mm"', 'joint.rolling_radius="0.01 mm"', 'plate.apothem="0.03 mm"', 'plate.thickness="0.02 mm"'),
    "thick teeth": (*SHORT, 'dynamics.thickness_deviation="1 mm"'),
    "thin teeth": (*SHORT, 'dynamics.thickness_deviation="-1 mm"'),
    "ramp": (*SHORT, 'drive.ramp="5 ms"'),
    "gravity": (*SHORT, 'drive.gravity=["0 m/s^2", "-1e4 m/s^2"]'),
}


def changed(*changes):
    """The worked Hy-Vo chain with some keys changed, as tables."""
    tables = tomllib.loads(HYVO.read_text())
    for change in changes:
        change_key(tables, change)
    return tables


def outcome(*changes):
    """The result, or None where the spec is refused with a reason."""
    tables = changed(*changes)
    try:
        with np.errstate(all="ignore"):
            return dw.run(from_document(tables), only=("dynamics",))
    except DrivewrightError as reason:
        assert len(str(reason)) > 20
        return None


def is_honest(found):
    """Every number is finite and within its interval, and a run that drifts has no statistics."""
    for name, value in found.values.items():
        assert np.isfinite(value.value), name
        if value.low is not None and value.high is not None:
            assert value.low <= value.value <= value.high, name
    if "dynamics.centre_distance.mean" in found.values:
        assert found.check("energy_drift").ok
        assert found.check("settled").value >= 0
    else:
        assert found.findings


def test_an_endless_run_is_refused_before_it_begins():
    result = dw.run(from_document(changed('dynamics.duration="2000 s"')), only=("dynamics",))
    assert result.outcome == "partial" and any("steps of a link" in finding for finding in result.findings)


@pytest.mark.slow
@pytest.mark.parametrize("name", EXTREMES)
def test_an_extreme_chain_is_finite_and_audited_or_refused(name):
    found = outcome(*EXTREMES[name])
    if found is not None:
        is_honest(found)
