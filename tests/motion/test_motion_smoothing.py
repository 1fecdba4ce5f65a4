"""Measured lifts in the programme of a cam: what their last digit makes of the jerk, and smoothing within a band."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import InputError
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.motion import law
from drivewright.motion.ripple import jerk_gain, rounding
from drivewright.motion.splines import through_points
from drivewright.spec import from_document

TURN = 2 * np.pi


def lift(angle):
    return 5 * (1 - np.cos(angle)) + 0.4 * (1 - np.cos(3 * angle))


def table(folder, step, digits, comma=False):
    degrees = np.arange(0, 360 + step / 2, step)
    text = "\n".join(f"{a:g};{s:.{digits}f}" for a, s in zip(degrees, lift(np.radians(degrees)), strict=True))
    path = folder / "lift.csv"
    path.write_text("angle [deg];lift [mm]\n" + (text.replace(".", ",") if comma else text) + "\n")
    return path


def spec(folder, **segment):
    segment = {"angle": "360 deg", "law": "table", "file": "lift.csv", **segment}
    follower = {"roller_radius": "8 mm", "prime_radius": "60 mm"}
    return from_document({"mechanism": "cam", "follower": follower, "programme": [segment]}, CamSpec, folder=folder)


@pytest.mark.analytical
@pytest.mark.parametrize("degree", [3, 5])
def test_jerk_of_rounding_against_random_errors(degree):
    """Rms jerk of splines through random errors, evenly spread over a digit, at a spacing of 1/200."""
    from scipy.interpolate import make_interp_spline

    random, u = np.random.default_rng(7), np.linspace(0, 1, 201)
    errors = random.uniform(-0.5, 0.5, (200, 400)) * 1e-3
    spline = make_interp_spline(u, np.concatenate([errors, errors[:1]]), k=degree, bc_type="periodic")
    node, weight = np.polynomial.legendre.leggauss(4)
    places = (u[:-1, None] + 0.5 / 200 * (1 + node)).ravel()
    mean = np.mean(np.tile(0.5 * weight, 200)[:, None] * spline(places, nu=3) ** 2) * 4
    assert jerk_gain(degree) * 1e-3 / np.sqrt(12) * 200**3 == pytest.approx(np.sqrt(mean), rel=0.02)
    lifts = np.cos(TURN * u)
    function = through_points(u, lifts, degree, "periodic", "rows")
    assert rounding(u, lifts, 1e-3, function).jerk == pytest.approx(np.sqrt(mean), rel=0.02)


@pytest.mark.property
def test_rounding_goes_with_the_digit_and_the_third_power_of_the_spacing(tmp_path):
    coarse, fine = (law("table", file=table(tmp_path, step, 6)) for step in (6, 3))
    assert fine.rounding.jerk / coarse.rounding.jerk == pytest.approx(8, rel=1e-9)
    u, s = fine.rows.T
    assert rounding(u, s, 1e-6, fine.function).jerk == pytest.approx(1e3 * rounding(u, s, 1e-9, fine.function).jerk)
    true = np.sqrt(np.mean((-5e-3 * np.sin(u * TURN) - 0.4e-3 * 27 * np.sin(3 * u * TURN)) ** 2)) * TURN**3
    assert fine.rounding.wanted == pytest.approx(true, rel=0.05)
    assert fine.digit == pytest.approx(1e-9)


@pytest.mark.parametrize(("step", "digits", "shows"), [(6, 4, False), (1, 3, True), (1, 6, False), (6, 1, True)])
def test_a_finding_where_the_last_digit_shows_in_the_jerk(tmp_path, step, digits, shows):
    table(tmp_path, step, digits)
    found = [finding for finding in dw.run(spec(tmp_path), only=("motion",)).findings if "rounded to" in finding]
    assert bool(found) == shows
    if shows:
        assert f"rounded to {10.0**-digits:.4g} mm" in found[0] and f'band = "{0.5 * 10.0**-digits:.4g} mm"' in found[0]


def test_smoothing_within_half_the_last_digit(tmp_path):
    table(tmp_path, 1, 3, comma=True)
    rough, smooth = dw.run(spec(tmp_path), only=("motion",)), dw.run(spec(tmp_path, band="0.5 um"), only=("motion",))
    assert 0.4e-6 < smooth["smoothing.departure"] <= 0.5e-6
    assert smooth["smoothing.jerk"] < 0.2 and "smoothing.jerk" not in rough.values
    found = [finding for finding in smooth.findings if "is smoothed" in finding]
    assert len(found) == 1 and "within 0.0005 mm of each of its 361 rows" in found[0] and "least integral of the squared jerk" in found[0]
    assert not any("rounded to" in finding for finding in smooth.findings)
    motion = smooth.tables["motion"]
    angle = motion["angle"].data
    true = 1e-3 * (-5 * np.sin(angle) - 0.4 * 27 * np.sin(3 * angle))
    assert motion["third"].data == pytest.approx(true, abs=0.05 * np.max(np.abs(true)))
    assert np.max(np.abs(rough.tables["motion"]["third"].data - true)) > 5 * np.max(np.abs(true))
    rows = np.radians(np.arange(0, 361, 1.0))
    drawn = np.interp(rows, angle, motion["lift"].data)
    assert drawn == pytest.approx(np.round(lift(rows), 3) / 1e3, abs=0.5e-6 + 1e-12)


def test_a_part_of_the_turn_keeps_its_ends(tmp_path):
    degrees = np.arange(0, 121, 2)
    u = degrees / 120
    rows = "\n".join(f"{a},{s:.2f}" for a, s in zip(degrees, 8 * (u - np.sin(TURN * u) / TURN), strict=True))
    (tmp_path / "lift.csv").write_text(f"angle [deg],lift [mm]\n{rows}\n")
    segments = [
        {"angle": "120 deg", "law": "table", "file": "lift.csv", "band": "5 um"},
        {"angle": "120 deg", "law": "cycloidal", "rise": "-8 mm"},
        {"angle": "120 deg", "law": "dwell"},
    ]
    data = {"mechanism": "cam", "follower": {"roller_radius": "8 mm", "prime_radius": "60 mm"}, "programme": segments}
    result = dw.run(from_document(data, CamSpec, folder=tmp_path), only=("motion",))
    assert result["continuity"] >= 2 and result["smoothing.departure"] <= 5e-6


@pytest.mark.error
@pytest.mark.parametrize(
    ("segment", "words"),
    [
        ({"band": "1 deg"}, ("programme.0.law", "the band must be a length")),
        ({"band": "0 mm"}, ("programme.0.band", "greater than 0")),
        ({"band": "2 um", "degree": 3}, ("degree 3", "degree 5")),
        ({"band": "6 mm"}, ("band of 0.006", "half the stroke")),
        ({"law": "cycloidal", "rise": "5 mm", "band": "2 um", "file": None}, ("programme.0.law", "band")),
    ],
)
def test_refusals(tmp_path, segment, words):
    table(tmp_path, 6, 3)
    given = {key: value for key, value in {"angle": "360 deg", "law": "table", "file": "lift.csv", **segment}.items() if value is not None}
    with pytest.raises(InputError) as caught:
        data = {"mechanism": "cam", "follower": {"roller_radius": "8 mm", "prime_radius": "60 mm"}, "programme": [given]}
        dw.run(from_document(data, CamSpec, folder=tmp_path), only=("motion",))
    assert all(word in str(caught.value) for word in words), str(caught.value)


def with_gaps(folder, *missing, step=3):
    """A table over a turn with a row every `step` degrees but those within the open intervals."""
    degrees = [a for a in range(0, 361, step) if not any(low < a < high for low, high in missing)]
    path = folder / "lift.csv"
    path.write_text("angle [deg],lift [mm]\n" + "".join(f"{a},{lift(np.radians(a)):.9f}\n" for a in degrees))
    return path


def gap_findings(path):
    return [each for each in law("table", file=path).findings if "are missing" in each]


@pytest.mark.property
def test_missing_rows_of_an_even_table_are_told(tmp_path):
    """Eleven of 121 rows are cut out: a step of 36 deg where there is one every 3 deg."""
    (told,) = gap_findings(with_gaps(tmp_path, (120, 156)))
    assert "missing from 120 to 156°: elsewhere there is one every 3°" in told
    (told,) = gap_findings(with_gaps(tmp_path, (30, 36), (90, 99)))
    assert "missing from 30 to 36°, 90 to 99°:" in told
    assert not gap_findings(with_gaps(tmp_path))
    model = dw.build(spec(tmp_path) if with_gaps(tmp_path, (120, 156)) else None)
    assert any("missing from 120 to 156°" in each for each in model.findings)


@pytest.mark.property
def test_rows_that_are_uneven_or_rounded_have_no_gaps(tmp_path):
    """Angles of a third of a degree printed to a tenth; rows that are closer in the flanks than elsewhere."""
    for degrees in (
        np.round(np.linspace(0, 360, 1081), 1),
        np.r_[0:90:5, 90:150:1, 150:361:5],
        180 * (1 - np.cos(np.linspace(0, np.pi, 61))),
    ):
        radians = np.radians(degrees)
        assert not [each for each in law("table", angle=radians, lift=lift(radians)).findings if "are missing" in each]
