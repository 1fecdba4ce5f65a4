"""Each subject of the conformance suite refuses a claim that is wrong by a factor, a sign or an exponent."""

from dataclasses import replace

import pytest

from drivewright import registry, testing
from drivewright.claims import SUBJECTS, Balance, Claims, Derivative, Limit, Mirror, Scaling
from drivewright.mechanisms.cam.claims import image
from drivewright.result import Answer, Column, Table, Value
from drivewright.spec import set_key

pytestmark = pytest.mark.conformance

CASES = {subject: testing.Case("cam", "default", subject) for subject in (*SUBJECTS, "units", "record")}
KEYS = ("vibration.natural_frequency",)


@pytest.fixture
def claimed(monkeypatch):
    """Makes the cam claim something else."""
    cam = registry.mechanism("cam")

    def claim(**claims):
        other = replace(cam, claims=lambda spec: Claims(**claims))
        monkeypatch.setattr(testing.registry, "mechanism", lambda kind: other)

    return claim


@pytest.mark.parametrize(
    ("subject", "claim", "complaint"),
    [
        ("derivatives", Derivative("motion", "lift", "slope", "angle", per=1.01), "slope is not the derivative of lift"),
        ("derivatives", Derivative("motion", "lift", "slope", "angle", per=-1.0), "slope is not the derivative of lift"),
        ("derivatives", Derivative("motion", "lift", "bend", "angle"), "bend is not the derivative of lift"),
        ("derivatives", Derivative("moton", "lift", "bend", "angle"), "no table 'moton'"),
        ("balances", Balance("max_torque", 1e-3), "max_torque = .* more than 0.001"),
        ("balances", Balance("pressure_angle", 1e-3), "pressure_angle = "),
        ("speed", Scaling("drive.speed", {"max_velocity": 2}), "max_velocity at twice drive.speed"),
        ("speed", Scaling("drive.speed", {"max_speed": 2}), "no value is called 'max_speed'"),
        ("mirror", Mirror(image, odd=("lift",)), "lift of the mirror image"),
        ("mirror", Mirror(lambda tables: set_key(tables, "follower.prime_radius", "41 mm")), "of the mirror image is"),
        ("limits", Limit(KEYS, "vibration.max_error", 0.0, 1.0, analyses=("vibration",)), "with order 2.*, not 1"),
        ("limits", Limit(KEYS, "lift", 0.02, 1.0), "lift is at its limit already"),
    ],
)
def test_a_wrong_claim_is_refused(claimed, subject, claim, complaint):
    claimed(**{subject: (claim,)})
    with pytest.raises(AssertionError, match=complaint):
        CASES[subject].check()


def test_the_cams_own_claims_hold_and_what_is_not_claimed_has_a_reason():
    assert CASES["derivatives"].check() == "" and "power" in CASES["balances"].check()


def test_what_is_not_claimed_without_a_reason_is_told(claimed):
    claimed()
    assert CASES["speed"].check() == "cam claims nothing on speed of this preset"


def test_a_spec_that_other_units_change_is_refused(monkeypatch):
    monkeypatch.setitem(testing.OTHER_UNITS, "mm", "um")
    CASES["units"].check()
    monkeypatch.setattr(testing, "DIGITS", 5)
    monkeypatch.setitem(testing.OTHER_UNITS, "mm", "in")
    with pytest.raises(AssertionError, match="other units change the spec: "):
        CASES["units"].check()


@pytest.mark.parametrize(
    ("answer", "complaint"),
    [
        (Answer({"Lift Max": Value(1.0, "m", "lift")}), "no dotted lower-case name"),
        (Answer({"lift": Value(1.0, "", "lift")}), "'lift' lacks unit"),
        (Answer({"lift": Value(1.0, "m", "")}), "'lift' lacks unit, label or meaning"),
        (Answer(tables=(Table("t", "", ()),)), "'t' has no title"),
        (Answer(tables=(Table("t", "T", (Column("x", "", "place", [0.0]),)),)), "'x' of table 't' lacks unit"),
        (Answer(tables=(Table("t", "T", (Column("x", "m", "place", [0.0]), Column("y", "m", "y", []))),)), "has another length"),
    ],
)
def test_a_record_that_lacks_something_is_refused(monkeypatch, answer, complaint):
    cam = registry.mechanism("cam")
    analyses = (registry.Analysis("toy", lambda model, done: answer, "toy"),)
    monkeypatch.setattr(testing.runner.registry, "mechanism", lambda kind: replace(cam, analyses=analyses))
    testing._whole_run.cache_clear()
    with pytest.raises(AssertionError, match=complaint):
        CASES["record"].check()
    testing._whole_run.cache_clear()
