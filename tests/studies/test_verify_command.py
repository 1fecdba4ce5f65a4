"""`verify` and `validate` at the terminal: tables on stdout, messages on stderr, exit codes."""

import math
import sys

import pytest

from drivewright import registry, validation
from drivewright.cli import main
from drivewright.studies import verification as study
from drivewright.validation import AGREES, OPEN, Row, Source, rounded

pytestmark = pytest.mark.interface

PRESET = str(registry.mechanism("seedling-pusher").presets()["default"])


def run(capsys, *arguments):
    """(exit code, stdout, stderr)."""
    with pytest.raises(SystemExit) as left:
        main(list(arguments))
    return (left.value.code, *capsys.readouterr())


def source(pinned):
    row = Row("wheel angle", rounded("50.22 deg", "rad"), 0.84, "rad", pinned, "published table", "table 1", note="A remark.")
    return Source("mine", "Somebody: A book. 1999.", lambda: [row])


def test_validate_shows_a_source(capsys):
    code, out, err = run(capsys, "validate", "modified-sine-help")
    assert (code, err) == (0, "")
    for words in ("Modified-Sinusoid Motion-Law", "69.47", "69.466", "agrees", "differs, explained", "cuts the third digit off"):
        assert words in out


def test_validate_knows_its_sources(capsys):
    code, out, err = run(capsys, "validate", "nobody")
    assert (code, out) == (2, "")
    known = (
        "clearance-joints, elliptic-gears, folding-linkage, geneva-tables, hyvo-paper, indexer-paper, modified-sine-help, motion-laws, "
        "nelson-mcvaugh, pusher-paper, shaft-paper, two-disc-rotor"
    )
    assert f"no validation source is called 'nobody'; known: {known}" in err


def test_validate_ends_well_while_the_verdicts_are_the_pinned_ones(capsys, monkeypatch):
    monkeypatch.setattr(validation, "sources", lambda name=None: (source(OPEN),))
    code, out, _ = run(capsys, "validate")
    assert code == 0
    for words in ("Somebody: A book. 1999.", "wheel angle", "50.22 deg", "48.128°", "-2.09 deg", "differs, open", "A remark."):
        assert words in out


def test_validate_fails_when_a_pinned_verdict_changes(capsys, monkeypatch):
    monkeypatch.setattr(validation, "sources", lambda name=None: (source(AGREES),))
    code, out, err = run(capsys, "validate")
    assert code == 1
    assert "differs, open" in out and "1 verdict(s) differ from the pinned ones" in err


@pytest.mark.parametrize(("other", "code"), [(0.1805, 0), (0.182, 1)])
def test_verify_fails_when_the_routes_part(capsys, monkeypatch, other, code):
    monkeypatch.setattr(study, "verify", lambda spec: (study.Comparison("tip.track_height", 0.18, other, "m", 1e-3, "by hand"),))
    found, out, _ = run(capsys, "verify", PRESET)
    assert found == code
    assert "tip.track_height" in out and f"{1e3 * other:.6g} mm" in out and "1 mm" in out and "by hand" in out


def test_verify_ends_with_2_where_an_extra_is_missing_and_with_0_where_a_route_does_not_fit(capsys, monkeypatch):
    agreeing = study.Comparison("tip.track_height", 0.18, 0.18, "m", 1e-3, "by hand")
    for extra, wanted in (("peers", 2), ("", 0)):
        left = study.Comparison("the rod in Exudyn", math.nan, math.nan, "-", math.nan, "", "not to be had", extra)
        monkeypatch.setattr(study, "verify", lambda spec, left=left: (agreeing, left))
        code, out, _ = run(capsys, "verify", PRESET)
        assert code == wanted
        assert "left out: the rod in Exudyn: not to be had" in out
        assert "tip.track_height" in out


@pytest.mark.slow
def test_verify_without_its_extra_says_what_is_left_out_and_why(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "exudyn", None)
    monkeypatch.delitem(sys.modules, "drivewright.oracles.seedling_pusher.exudyn_model", raising=False)
    monkeypatch.delattr("drivewright.oracles.seedling_pusher.exudyn_model", raising=False)
    code, out, err = run(capsys, "verify", PRESET)
    assert code == 2 and "Traceback" not in err
    assert "tip.track_height" in out
    assert "left out: motion of the rod in Exudyn: the multibody run of the cam pair in Exudyn needs the extra 'peers'" in out
