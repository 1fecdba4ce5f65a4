"""What a cam spec may not say, and what the message tells."""

import math

import pytest

import drivewright as dw
from drivewright import runner
from drivewright.errors import InputError
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.spec import from_document

pytestmark = pytest.mark.error

ROLLER = {"face": "roller", "roller_radius": "8 mm", "prime_radius": "40 mm"}
LEVER = {**ROLLER, "motion": "oscillating", "pivot_distance": "80 mm", "arm_length": "60 mm"}


def segments(rise="20 mm", law="cycloidal", **more):
    back = rise[1:] if rise.startswith("-") else f"-{rise}"
    return [
        {"angle": "90 deg", "law": law, "rise": rise, **more},
        {"angle": "180 deg", "law": law, "rise": back, **more},
        {"angle": "90 deg", "law": "dwell"},
    ]


def message(follower=ROLLER, programme=None, only=("geometry", "profile"), folder=".", **tables):
    data = {"mechanism": "cam", "follower": follower, "programme": programme or segments(), **tables}
    with pytest.raises(InputError) as caught:
        dw.run(from_document(data, CamSpec, folder=folder), only=only)
    return str(caught.value)


def without(table, *names):
    return {key: value for key, value in table.items() if key not in names}


@pytest.mark.parametrize(
    ("follower", "words"),
    [
        (without(ROLLER, "roller_radius"), ("follower.roller_radius", "missing")),
        (without(ROLLER, "prime_radius"), ("follower.prime_radius", "missing")),
        ({**ROLLER, "base_radius": "32 mm"}, ("prime_radius", "base_radius", "leave one out")),
        ({**ROLLER, "face": "shoe"}, ("follower.face_radius", "missing")),
        ({**ROLLER, "prime_radius": "8 mm"}, ("follower.prime_radius", "8 mm", "larger")),
        ({**ROLLER, "prime_radius": "0 mm"}, ("follower.prime_radius", "greater than 0 mm")),
        ({**ROLLER, "prime_radius": "nan mm"}, ("follower.prime_radius", "not finite")),
        ({**ROLLER, "prime_radius": "40 deg"}, ("follower.prime_radius", "wants a length", "angle")),
        ({**ROLLER, "prime_radius": 40}, ("follower.prime_radius", "unit missing", "40 mm")),
        ({**ROLLER, "prime_radus": "40 mm"}, ("follower.prime_radus", "did you mean 'prime_radius'")),
        ({**ROLLER, "face": "rolller"}, ("follower.face", "'roller'")),
        ({**ROLLER, "offset": "-40 mm"}, ("offset", "40 mm", "prime_radius")),
    ],
)
def test_follower(follower, words):
    text = message(follower)
    assert all(word in text for word in words), text


@pytest.mark.parametrize(
    ("follower", "rise", "words"),
    [
        (without(LEVER, "pivot_distance"), "18 deg", ("follower.pivot_distance", "missing")),
        (without(LEVER, "arm_length"), "18 deg", ("follower.arm_length", "missing")),
        (LEVER, "20 mm", ("programme.0.rise", "must be an angle")),
        (ROLLER, "18 deg", ("programme.0.rise", "must be a length")),
        ({**LEVER, "arm_length": "30 mm"}, "18 deg", ("pivot_distance 80 mm", "arm_length 30 mm", "50 to 110 mm", "prime_radius 40 mm")),
        ({**LEVER, "prime_radius": "140 mm"}, "18 deg", ("20 to 140 mm", "not between")),
        (LEVER, "160 deg", ("lever swings", "180°", "Reduce the rise")),
        (LEVER, "-40 deg", ("lever swings", "0 and 180°")),
        ({**ROLLER, "face": "flat"}, "-41 mm", ("face 1 mm beyond the cam's centre", "base radius")),
        (ROLLER, "-60 mm", ("takes the roller's centre to -20 mm", "prime_radius")),
        ({**LEVER, "face": "flat", "pivot_distance": "38 mm"}, "5 deg", ("base radius 40 mm", "pivot_distance 38 mm", "pivot away")),
        ({**LEVER, "face": "flat"}, "-85 deg", ("turns as fast as the cam", "Spread the motion")),
    ],
)
def test_kinematics(follower, rise, words):
    text = message(follower, segments(rise))
    assert all(word in text for word in words), text


def test_programme(tmp_path):
    rows = zip(range(0, 361, 60), (0, 1, 2, 3, 2, 1, 0), strict=True)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n" + "\n".join(f"{a},{s}" for a, s in rows))
    cases = [
        (segments()[:2], ("sum to 270°", "90° less")),
        (
            [*segments()[:2], {"angle": "90 deg", "law": "cycloidal", "rise": "1 mm"}],
            ("programme: the lift ends 1 mm above its start", "20 mm, -20 mm, 1 mm; as a dwell segment 3"),
        ),
        (segments(law="cyclodial"), ("programme.0", "did you mean 'cycloidal'")),
        (segments(b=0.5), ("programme.0.law", "unexpected keyword argument 'b'")),
        ([*segments()[:2], {"angle": "90 deg", "law": "dwell", "b": 0.25}], ("programme.2.b", "dwell has no parameters")),
        ([{"angle": "360 deg", "law": "table"}], ("programme.0.law", "either a file")),
        ([{"angle": "360 deg", "law": "table", "file": "none.csv"}], ("programme.0.file", "there is no file")),
        ([{"angle": "300 deg", "law": "table", "file": "lift.csv"}, {"angle": "60 deg", "law": "dwell"}], ("360°", "300°")),
        ([{"angle": "-90 deg", "law": "dwell"}], ("programme.0.angle", "greater than 0 deg")),
        ([], ("programme", "at least 1")),
    ]
    for programme, words in cases:
        data = {"mechanism": "cam", "follower": ROLLER, "programme": programme}
        with pytest.raises(InputError) as caught:
            dw.run(from_document(data, CamSpec, folder=tmp_path))
        assert all(word in str(caught.value) for word in words), (words, str(caught.value))
    text = message(LEVER, [{"angle": "360 deg", "law": "table", "file": "lift.csv"}], folder=tmp_path)
    assert "programme.0.file" in text
    assert "must be an angle" in text


@pytest.mark.parametrize(
    ("follower", "tables", "words"),
    [
        (ROLLER, {"closure": "conjugate"}, ("conjugate", "missing")),
        (ROLLER, {"closure": "conjugate", "conjugate": {"prime_radius": "7 mm"}}, ("conjugate.prime_radius", "7 mm")),
        (ROLLER, {"closure": "conjugate", "conjugate": {"prime_radius": "15 mm"}}, ("above the cam's centre",)),
        ({**ROLLER, "face": "flat"}, {"closure": "groove"}, ("closure", "roller", "flat")),
        ({**ROLLER, "face": "knife"}, {"closure": "conjugate", "conjugate": {"prime_radius": "60 mm"}}, ("closure", "rollers", "knife")),
        ({**ROLLER, "offset": "2 mm"}, {"closure": "yoke"}, ("closure", "yoke", "without offset")),
        (ROLLER, {"material": "16MnCr6"}, ("material", "did you mean '16MnCr5'")),
        (ROLLER, {"drive": {"speed": "5 1/s"}}, ("drive.speed", "rev/s")),
        (ROLLER, {"rotation": "left"}, ("rotation", "clockwise")),
    ],
)
def test_tables(follower, tables, words):
    text = message(follower, **tables)
    assert all(word in text for word in words), text


def test_a_cam_that_is_cut_away_altogether():
    text = message({"face": "shoe", "face_radius": "60 mm", "prime_radius": "61 mm"}, segments("-20 mm"))
    assert "nothing is left of the cam" in text


def test_resonance_without_damping():
    tables = {"drive": {"speed": "600 rpm"}, "vibration": {"natural_frequency": "50 Hz", "damping_ratio": 0.0}}
    result = dw.run(from_document({"mechanism": "cam", "follower": ROLLER, "programme": segments(), **tables}, CamSpec))
    assert any("vibration" in finding and "5 times the cam's speed" in finding for finding in result.findings)
    assert result.outcome == "partial" and "max_pressure_angle" in result.values
    assert not any(name.startswith("vibration") for name in result.values)


def test_a_stiff_follower_is_left_out_of_the_vibration():
    data = {
        "mechanism": "cam",
        "follower": ROLLER,
        "programme": segments(),
        "drive": {"speed": "1 rpm"},
        "vibration": {"natural_frequency": "400 Hz"},
    }
    result = dw.run(from_document(data, CamSpec))
    assert any("practically rigid" in finding for finding in result.findings)
    assert "max_pressure_angle" in result.values


def test_left_out_keys_and_analyses_are_findings():
    data = {
        "mechanism": "cam",
        "follower": {**ROLLER, "face_radius": "10 mm", "pivot_distance": "80 mm"},
        "programme": segments(),
        "groove": {"clearance": "0.1 mm"},
    }
    findings = " | ".join(dw.run(from_document(data, CamSpec)).findings)
    for words in (
        "follower.face_radius is not used: it does not apply",
        "follower.pivot_distance is not used: it does not apply",
        "[groove] is not used",
        "no [drive] speed",
        "no [vibration]",
    ):
        assert words in findings


def open_segments(*angles):
    """A programme whose segments have these angles; None for one that states none."""
    return [
        segment | {"angle": f"{angle} deg"} if angle else {k: v for k, v in segment.items() if k != "angle"}
        for segment, angle in zip(segments(), angles, strict=True)
    ]


def test_one_segment_may_leave_its_angle_out():
    data = {"mechanism": "cam", "follower": ROLLER, "programme": open_segments(100, 170, None)}
    programme = runner.build(from_document(data, CamSpec)).programme
    assert [round(math.degrees(segment.angle), 9) for segment in programme.segments] == [100, 170, 90]


def test_what_leaves_nothing_of_the_turn_is_refused():
    assert "one segment may leave its angle out" in message(programme=open_segments(100, None, None))
    assert "leave nothing of the turn: they take 360°" in message(programme=open_segments(100, 260, None))
    assert "sum to 350°, 10° less than the cycle" in message(programme=open_segments(100, 160, 90))
