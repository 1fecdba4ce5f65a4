"""The independent routes of `verify`: they agree with the analyses and would notice if those were wrong."""

import importlib
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from drivewright import registry
from drivewright.errors import InputError
from drivewright.gears import EllipticGearPair
from drivewright.oracles.seedling_pusher.rolled_motion import RolledMotion, arc_speed, rolled_pair, roller_at_rest
from drivewright.runner import run
from drivewright.spec import load
from drivewright.studies.verification import Comparison, verify

pytestmark = pytest.mark.property

routes = importlib.import_module("drivewright.oracles.seedling_pusher.rows")
PUSHER = registry.mechanism("seedling-pusher")
ONLY = ("train", "planting", "cams")
CASES = [
    pytest.param(("paper-interior", []), id="interior"),
    pytest.param(("default", []), id="default", marks=pytest.mark.slow),
    pytest.param(("design-b", ["cams.orbit=counter-clockwise"]), id="other sense", marks=pytest.mark.slow),
    pytest.param(("default", ["train.start=far"]), id="far", marks=pytest.mark.slow),
    pytest.param(
        ("design-a", ["lever.arm_main=14.7 mm", "push.hold=0 deg", "push.law=modified-sine", "arm.tip_reference=planet"]),
        id="asymmetric",
        marks=pytest.mark.slow,
    ),
]


@pytest.fixture(scope="module", params=CASES)
def case(request):
    preset, changes = request.param
    spec = load(PUSHER.presets()[preset], changes)
    model = PUSHER.build(spec)
    return model, run(spec, ONLY, model=model)


def rows(model, result):
    return [Comparison(*row) for row in routes.geometry(model, result, RolledMotion(model))]


@pytest.fixture(scope="module")
def compared(case):
    """Rows of the case by both routes."""
    return rows(*case)


def test_both_routes_agree(compared):
    found = compared
    assert [row for row in found if not row.ok] == []
    assert len(found) == len({row.name for row in found}) == 25


NOTICED = {
    "train.axis_ratio=0.984": {"train.collinear_angle", "tip.lowest_angle", "tip.track_height", "tip.track_width", "cam.main.profile_area"},
    "train.bend=88 deg": {"train.collinear_angle", "tip.lowest_angle", "tip.track_height"},
    "arm.tip_angle=36 deg": {"tip.lowest_angle", "tip.track_height", "tip.track_width"},
    "push.law=cycloidal": {
        "cam.main.max_pressure_angle.rise",
        "cam.return.max_pressure_angle.return",
        "cam.main.min_convex_radius",
        "cam.return.min_convex_radius",
        "cam.return.lost_motion",
    },
    "cams.roller_radius=6.1 mm": {"cam.main.profile_area", "cam.main.profile_perimeter", "cam.return.lost_motion"},
    "lever.arm_return=16.2 mm": {"cam.roller_distance", "cam.return.max_pressure_angle.rise"},
    "cams.orbit=counter-clockwise": {"cam.main.max_pressure_angle.rise", "cam.main.profile_perimeter"},
}


@pytest.fixture(scope="module")
def other_numbers():
    """Rows of the published design, mirrored: what its independent route says."""
    model = PUSHER.build(load(PUSHER.presets()["paper-mirrored"]))
    return rows(model, run(model.spec, ONLY, model=model))


@pytest.mark.parametrize("change", NOTICED)
def test_the_result_of_another_design_is_noticed(other_numbers, change):
    wrong = run(load(PUSHER.presets()["paper-mirrored"], [change]), ONLY)
    named = [row._replace(ours=wrong[row.name]) for row in other_numbers if row.name in wrong.values]
    assert len(named) == 19
    assert NOTICED[change] <= {row.name for row in named if not row.ok}


def test_a_train_that_meshes_otherwise_is_noticed():
    """The free foci keep their distance only where every mesh starts with the right radii in contact."""
    model = PUSHER.build(load(PUSHER.presets()["default"]))
    right, t = 2 * model.spec.train.semi_major, np.linspace(0, 6, 50)
    assert routes._free_foci(model, t) == pytest.approx(right, abs=1e-15)
    near, far = EllipticGearPair(0.17, right / 2), EllipticGearPair(0.17, right / 2, "far")
    for pairs in ((near, far), (far, near), (near, near)):
        object.__setattr__(model.arm.train, "pairs", pairs)
        assert abs(routes._free_foci(model, t) - right) > 1e-5


@pytest.mark.parametrize("start", ["near", "far"])
@pytest.mark.parametrize("eccentricity", [0.0, 0.17255, 0.45, 0.7])
def test_rolling_by_arc_length_is_the_closed_form(eccentricity, start):
    angle = np.random.default_rng(3).uniform(-9, 16, 60)
    assert rolled_pair(eccentricity, start)(angle) == pytest.approx(EllipticGearPair(eccentricity, start=start).driven(angle), abs=1e-10)


@pytest.mark.parametrize("e", [-0.45, 0.0, 0.7])
def test_arc_length_of_the_ellipse(e):
    from scipy.special import ellipe

    x = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    assert 2 * np.pi * np.mean(arc_speed(e)(x)) == pytest.approx(4 * ellipe(e**2), rel=1e-12)


def test_vertex_of_a_parabola_is_exact_between_the_samples():
    x = np.linspace(0, 1, 12)
    assert routes._vertex(x, 3.0 - 7 * (x - 0.417) ** 2) == pytest.approx((0.417, 3.0), abs=1e-13)


def test_rolled_ellipses_touch_on_the_line_of_centres():
    e, angle = 0.45, np.linspace(0, 6.2, 40)
    short = (1 - e**2) / (1 + e * np.cos(angle))
    long = (1 - e**2) / (1 - e * np.cos(rolled_pair(e)(angle)))
    assert short + long == pytest.approx(2 * np.ones(40), abs=1e-11)


def test_roller_at_rest_has_the_sides_of_its_triangle(case):
    model, _ = case
    for cam in model.pair.cams:
        z = roller_at_rest(cam)
        sides = abs(z), abs(z + 1j * cam.pivot_distance)
        assert sides == pytest.approx((cam.prime_radius, cam.arm), rel=1e-14)
        assert np.sign(z.real) == cam.side


def test_rows_of_a_motion(case):
    model, result = case
    angle = np.linspace(0, 2 * np.pi, 721)
    programme = model.pair.travel(model.pair.start + angle).d0
    wrong = np.where(programme > 0.017, 0.11e-3, np.where(programme > 0.001, 0.0, -0.07e-3))
    made = SimpleNamespace(angle=angle, travel=programme + wrong, swing=np.arctan(programme / model.spec.lever.output_arm))
    found = {row.name: row for row in (Comparison(*row) for row in routes.motion(model, result, made))}
    assert found["rod, furthest ahead of its programme"].other == pytest.approx(0.11e-3, rel=1e-9)
    assert found["rod, furthest behind its programme"].other == pytest.approx(-0.07e-3, rel=1e-9)
    assert found["rod, stroke"].other - found["rod, stroke"].ours == pytest.approx(0.18e-3, rel=1e-6)
    assert found["lever.swing"].other == pytest.approx(found["lever.swing"].ours, rel=1e-9)
    assert all(row.ok for row in found.values())
    undercut = result["cam.main.lost_motion"] > 0, result["cam.return.lost_motion"] > 0
    behind, ahead = (found[f"rod, furthest {side} its programme"].allowed for side in ("behind", "ahead of"))
    assert (behind > 0.2e-3, ahead > 0.2e-3) == undercut


def test_rows_know_whether_they_agree():
    assert Comparison("x", 1.0, 1.2, "m", 0.2 + 1e-12, "r").ok
    assert not Comparison("x", 1.0, 1.2, "m", 0.19, "r").ok
    assert not Comparison("x", 1.2, 1.0, "m", 0.19, "r").ok
    assert not Comparison("x", 1.0, float("nan"), "m", 0.2, "r").ok


def test_a_kind_without_a_second_route_says_so(monkeypatch):
    kinds = {"seedling-pusher": replace(PUSHER, verify=None), "other": replace(PUSHER, kind="other")}
    monkeypatch.setattr(registry, "mechanism", kinds.__getitem__)
    monkeypatch.setattr(registry, "kinds", lambda: sorted(kinds))
    message = "mechanism 'seedling-pusher' has no independent route to verify it by; kinds that have one: other"
    with pytest.raises(InputError, match=message):
        verify(load(PUSHER.presets()["default"]))


def without_exudyn(monkeypatch):
    monkeypatch.setitem(sys.modules, "exudyn", None)
    monkeypatch.delitem(sys.modules, "drivewright.oracles.seedling_pusher.exudyn_model", raising=False)
    monkeypatch.delattr("drivewright.oracles.seedling_pusher.exudyn_model", raising=False)


def test_without_exudyn_its_rows_are_left_out_and_the_extra_is_named(case, compared, monkeypatch):
    without_exudyn(monkeypatch)
    monkeypatch.setattr(routes, "geometry", lambda *asked: compared)  # which another test looks at
    *others, left = PUSHER.verify(*case)
    assert others[: len(compared)] == compared and len(others) > 10 and all(Comparison(*row).ok for row in others)
    assert left.name == "motion of the rod in Exudyn"
    assert "in Exudyn needs the extra 'peers'" in left.reason and "pip install 'drivewright[peers]'" in left.reason
    assert left.extra == "peers"
