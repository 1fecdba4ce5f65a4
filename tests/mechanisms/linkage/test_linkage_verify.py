"""The independent routes of `verify` agree with the kernel, and would notice if it were wrong."""

import numpy as np
import pytest
from places import EXAMPLES

from drivewright.mechanisms.linkage.build import build
from drivewright.oracles.linkage import four_bar, independent_check
from drivewright.spec import load

pytestmark = pytest.mark.property


def model(name, *changes):
    return build(load(EXAMPLES / f"{name}.toml", changes))


def differing(rows):
    return [name for name, ours, other, _, allowed, _ in rows if not abs(ours - other) <= allowed]


def routes(rows):
    return {row[5] for row in rows}


@pytest.mark.needs_peers
@pytest.mark.parametrize("name", ["four_bar", "slider_crank_clearance", "jansen_leg"])
def test_exudyn_and_the_absolute_equations_agree(name):
    found = independent_check.verify(model(name, "simulate.turns=1.5", "simulate.discard=0"), None)
    assert differing(found) == []
    assert {independent_check.EXUDYN, independent_check.ABSOLUTE} <= routes(found)
    for _, ours, other, unit, allowed, route in found:
        if route == independent_check.EXUDYN:  # with dry pins its own answer still changes by 1e-5 rad with the step, and comes to ours
            assert allowed <= (2e-5 if unit == "m" else 5e-5) and abs(ours - other) <= 2e-5


def test_a_four_bar_in_closed_form():
    found = list(four_bar.closed_form(model("four_bar")))
    assert len(found) == 4 and differing(found) == []


@pytest.mark.parametrize("changes", [(), ('drive.speed="-20000 rev/h"',), ('joints.A.model="ideal"', 'bodies.crank.angle="130 deg"')])
def test_massless_links_in_closed_form(changes):
    found = list(four_bar.closed_form(model("knife_folder", *changes)))
    assert len(found) == 4 and differing(found) == []
    assert all(np.isfinite(row[1]) for row in found) and any(row[1] != row[2] for row in found)  # not one number twice


@pytest.mark.parametrize("change", ['joints.B.clearance="0.21 mm"', 'gravity=["0 m/s^2", "-9.8 m/s^2"]', 'bodies.knife.mass="6.9 kg"'])
def test_the_closed_form_notices_another_mechanism(change):
    """The rows of one mechanism beside the closed form's of another."""
    ours, other = (list(four_bar.closed_form(model("knife_folder", *changes))) for changes in ((), (change,)))
    mixed = [(*mine[:2], theirs[2], *mine[3:]) for mine, theirs in zip(ours, other, strict=True)]
    assert len(differing(mixed)) == 4


@pytest.mark.parametrize(
    "changes",
    [
        ('gravity=["1 m/s^2", "-9.81 m/s^2"]',),
        ('bodies.coupler.centroid=["79 mm", "1 mm"]',),
        ('joints.A.link_damping="2e-4 N m s/rad"',),
        ('joints.A.model="dry"',),
    ],
)
def test_what_the_closed_form_has_no_place_for(changes):
    assert list(four_bar.closed_form(model("knife_folder", *changes))) == []


def test_a_wrong_acceleration_leaves_newton_and_euler_unsatisfied():
    """Of a mechanism with freedom: without it the reactions can make up for anything, and the drive's torque tells."""
    bar = model("knife_folder", "simulate.turns=1.5", "simulate.discard=0")
    seen = list(independent_check._observed_states(bar))
    assert differing(independent_check._newton_euler(bar, seen)) == []
    wrong = [(system, observed._replace(bodies=observed.bodies * np.where(np.arange(12) == 8, 1 + 1e-4, 1))) for system, observed in seen]
    assert "Newton-Euler equations: maximum residual, relative to the largest force" in differing(
        independent_check._newton_euler(bar, wrong)
    )


def test_a_joint_that_gapes_is_noticed():
    bar = model("four_bar", "simulate.turns=1.5", "simulate.discard=0")
    seen = [
        (system, observed._replace(bodies=observed.bodies + 1e-6 * (np.arange(12) == 2) * (np.arange(4) == 2)[:, None]))
        for system, observed in independent_check._observed_states(bar)
    ]
    assert differing(independent_check._closed_joints(bar, seen)) == ["ideal joints, revolute: maximum gap"]


@pytest.mark.needs_peers
def test_exudyn_notices_another_restitution():
    one, other = (model("slider_crank_clearance", f"joints.wrist.restitution={e}") for e in (0.9, 0.89))
    mine, theirs = ([row for row in independent_check.verify(m, None) if row[5] == independent_check.EXUDYN] for m in (one, other))
    mixed = [(*a[:2], b[2], *a[3:]) for a, b in zip(mine, theirs, strict=True)]
    assert any(name.startswith("bodies.slider.x after 0.0") for name in differing(mixed))


@pytest.mark.parametrize(
    ("change", "missing"),
    [
        ('joints.wrist.model="massless-link"', "the law of a joint with clearance"),
        ("joints.wrist.friction=0.1", "the law of a joint with clearance"),
        ('joints.wrist.normal="cylinder"', "the law of a joint with clearance"),
        ('bodies.crank.inertia="0 kg m^2"', "bodies without mass or inertia"),
    ],
)
def test_what_exudyn_does_not_know_is_left_out_with_the_reason(change, missing):
    assert independent_check._missing_in_exudyn(model("slider_crank_clearance")) == ""
    assert independent_check._missing_in_exudyn(model("slider_crank_clearance", change)) == missing
    (left,) = independent_check._exudyn_rows(model("slider_crank_clearance", change))
    assert left == ("the linkage in Exudyn", f"its Exudyn model does not support {missing}", "")


def test_without_exudyn_its_rows_are_left_out_and_the_extra_is_named(monkeypatch):
    import sys

    from drivewright.oracles import linkage

    monkeypatch.setitem(sys.modules, "exudyn", None)
    monkeypatch.delitem(sys.modules, "drivewright.oracles.linkage.exudyn_model", raising=False)
    monkeypatch.delattr(linkage, "exudyn_model", raising=False)
    *others, left = independent_check.verify(model("four_bar"), None)
    assert differing(others) == [] and len(others) > 4
    assert left.name == "the linkage in Exudyn" and "needs the extra 'peers'" in left.reason and left.extra == "peers"
