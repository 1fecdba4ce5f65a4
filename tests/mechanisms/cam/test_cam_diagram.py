"""The motion programme as a diagram: its courses are the motion of the model, and every law offered makes a cam."""

import base64
import json

import numpy as np
import pytest
from places import EXAMPLES

from drivewright import registry, runner
from drivewright.errors import InputError
from drivewright.mechanisms.cam.diagram import laws
from drivewright.motion import MotionLaw, Programme, Segment, law
from drivewright.motion.diagram import LEAST, MOST_PIECES, diagram_segments
from drivewright.motion.laws import BUILT_IN
from drivewright.report.programme import pack_programme
from drivewright.spec import from_document, load, read_document
from drivewright.studio.design import Design
from drivewright.studio.document import Document

KINDS_WITHOUT = ("geneva", "indexer", "linkage", "shaft", "silent-chain")


def model_of(name):
    return runner.build(load(EXAMPLES / f"{name}.toml"))


def diagram_of(model):
    return registry.mechanism("cam").programme(model)


@pytest.mark.parametrize("name", ["disc_cam", "yoke_cam", "oscillating_cam", "valve_train"])
def test_courses_are_the_motion_that_the_segments_state(name):
    model = model_of(name)
    diagram, stated = diagram_of(model), model.programme.stated
    assert sum(segment.angle for segment in diagram.segments) == pytest.approx(diagram.cycle)
    start = 0.0
    for segment in diagram.segments:
        theta, *course = segment.course
        assert theta[0] == 0.0 and theta[-1] == pytest.approx(segment.angle)
        inside = (
            (theta > 1e-6)
            & (theta < segment.angle - 1e-6)
            & (np.append(np.diff(theta), 1.0) > 1e-9)
            & (np.append(1.0, np.diff(theta)) > 1e-9)
        )
        for ours, exact in zip(course, stated(start + theta[inside]), strict=True):
            assert ours[inside] == pytest.approx(exact, rel=1e-6, abs=1e-9 + 1e-9 * np.max(np.abs(exact)))
        start += segment.angle


def test_a_jump_stands_as_two_values_at_one_angle():
    document = read_document(EXAMPLES / "disc_cam.toml")
    document["programme"][0]["law"] = "parabolic"
    segment = diagram_of(runner.build(from_document(document))).segments[0]
    theta, _, _, acceleration, _ = segment.course
    twice = np.flatnonzero(np.diff(theta) < 1e-9)
    assert theta[twice] == pytest.approx([np.pi / 4])
    assert acceleration[twice] == pytest.approx(-acceleration[twice + 1]) and abs(acceleration[twice[0]]) > 0


@pytest.mark.parametrize("choice", laws(), ids=lambda choice: choice.name)
def test_every_law_offered_makes_a_motion_with_the_parameters_it_starts_with(choice):
    cam = Document(Design(read_document(EXAMPLES / "disc_cam.toml"), EXAMPLES), "cam")
    rest = {"rise": ""} if choice.name == "dwell" else {}
    others = {"rise": "-10 mm"}, {"law": "cycloidal", "rise": "10 mm"}
    if choice.name == "dwell":
        elements = [{"of": 0, "changes": {"law": choice.name, **rest}}, *({"of": n + 1, "changes": each} for n, each in enumerate(others))]
    else:
        elements = [{"of": 0, "changes": {"law": choice.name, **choice.parameters}}, *({"of": n + 1, "changes": {}} for n in range(2))]
    cam.arrange("programme", elements)
    diagram = diagram_of(runner.build(cam.design.spec()))
    assert diagram.segments[0].law == choice.name
    assert bool(diagram.segments[0].points) == (choice.name == "spline")


def test_the_packed_diagram_is_plain_data_with_units():
    packed = pack_programme(diagram_of(model_of("disc_cam")))
    assert packed["lift"]["unit"] == "mm" and packed["cycle"]["unit"] == "°" and packed["speed"] == pytest.approx(2 * np.pi * 10)
    lift = np.frombuffer(base64.b64decode(packed["segments"][0]["course"][1]), "<f4")
    assert lift[0] == pytest.approx(0, abs=1e-12) and lift[-1] == pytest.approx(0.02)
    assert [segment["rise"] for segment in packed["segments"]] == pytest.approx([0.02, -0.02, 0])
    assert packed["cycle"]["span"] == pytest.approx(2 * np.pi) == pytest.approx(sum(segment["angle"] for segment in packed["segments"]))
    assert packed["lift"]["factor"] == pytest.approx(1e3) and packed["cycle"]["factor"] == pytest.approx(180 / np.pi)
    swing = pack_programme(diagram_of(model_of("oscillating_cam")))
    assert swing["lift"]["unit"] == "°" and swing["lift"]["angular"] and not packed["lift"]["angular"]


def test_rows_of_a_table_come_along_with_the_name_of_their_file():
    (segment,) = diagram_of(model_of("oscillating_cam")).segments
    assert segment.file == "lift.csv" and segment.absolute
    assert np.degrees(segment.rows[:3]) == pytest.approx(np.array([(0, 0.1018), (6, 0.1655), (12, 0.2679)]))
    first, dwell = pack_programme(diagram_of(model_of("valve_train")))["segments"]
    assert (
        first["rowCount"] == len(first["rows"]) == 131 and first["rows"][-1][0] == pytest.approx(np.radians(130)) and dwell["rowCount"] == 0
    )


def rows_of(diagram, angular):
    """The rows of the first segment as texts of a spec."""
    factor, unit = (180 / np.pi, "deg") if angular else (1e3, "mm")
    return [[f"{np.degrees(angle):.12g} deg", f"{lift * factor:.12g} {unit}"] for angle, lift in diagram.segments[0].rows]


@pytest.mark.parametrize("name", ["oscillating_cam", "valve_train"])
def test_rows_in_the_spec_make_the_same_motion_as_those_of_a_file(name):
    model = model_of(name)
    cam = Document(Design(read_document(EXAMPLES / f"{name}.toml"), EXAMPLES), "cam")
    rest = [{"of": n, "changes": {}} for n in range(1, len(cam.design.tables["programme"]))]
    texts = rows_of(diagram_of(model), model.programme.lift_unit == "rad")
    cam.arrange("programme", [{"of": 0, "changes": {"rows": json.dumps(texts), "file": ""}}, *rest])
    other, theta = runner.build(cam.design.spec()), np.linspace(0, 2 * np.pi, 500)
    assert other.programme.stated(theta).s == pytest.approx(model.programme.stated(theta).s, abs=1e-11)
    assert diagram_of(other).segments[0].file == "" and len(diagram_of(other).segments[0].rows) == len(texts)
    cam.undo()
    assert not cam.can_undo and "rows" not in cam.design.tables["programme"][0]


def test_a_long_table_is_counted_and_not_sent():
    document = read_document(EXAMPLES / "disc_cam.toml")
    angles = np.linspace(0, 360, 1201)
    rows = [[f"{angle:.10g} deg", f"{10 - 10 * np.cos(np.radians(angle)):.10g} mm"] for angle in angles]
    document["programme"] = [{"angle": "360 deg", "law": "table", "rows": rows}]
    (segment,) = pack_programme(diagram_of(runner.build(from_document(document))))["segments"]
    assert segment["rows"] == [] and segment["rowCount"] == 1201


@pytest.mark.parametrize(
    ("rows", "more", "words"),
    [
        (
            [["0 deg", "0 mm"], ["60 deg", "3 deg"], ["360 deg", "0 mm"]],
            {},
            "row 2: the lift is an angle, but that of the first row a length",
        ),
        ([["0 deg", "0 mm"], ["360 deg", "0 mm"]], {}, "2 rows are too few"),
        ([["0 deg", "0 mm"], ["90 deg", "3 mm"], ["80 deg", "3 mm"], ["360 deg", "0 mm"]], {}, "must increase from row to row"),
        ([["0 deg", "0 mm"], ["90 deg", "3 mm"], ["360 deg", "1 mm"]], {}, "first and the last row disagree"),
        ([["0 deg", "0 deg"], ["90 deg", "3 deg"], ["360 deg", "0 deg"]], {}, "programme.0.rows: the lift in its table must be a length"),
        ([["0 deg", "0 mm"], ["90 deg", "3 mm"], ["360 deg", "0 mm"]], {"file": str(EXAMPLES / "lift.csv")}, "either a file"),
        ([["0 deg", "0 kg"], ["90 deg", "3 mm"], ["360 deg", "0 mm"]], {}, "programme.0.rows"),
    ],
)
@pytest.mark.error
def test_rows_that_make_no_motion_are_refused(rows, more, words):
    document = read_document(EXAMPLES / "disc_cam.toml")
    document["programme"] = [{"angle": "360 deg", "law": "table", "rows": rows, **more}]
    with pytest.raises(InputError) as caught:
        runner.build(from_document(document))
    assert words in str(caught.value)


@pytest.mark.parametrize("kind", KINDS_WITHOUT)
def test_kinds_without_a_list_of_segments_have_no_diagram(kind):
    assert registry.mechanism(kind).programme is None


def test_no_law_is_offered_under_two_names():
    builders = [BUILT_IN[choice.name] for choice in laws() if choice.name != "dwell"]
    assert len(builders) == len(set(builders)) > 10


def test_without_a_speed_derivatives_are_per_radian():
    """Where the spec states no speed there is none to multiply by, and nothing that JSON cannot say."""
    document = read_document(EXAMPLES / "disc_cam.toml")
    del document["drive"]
    model = runner.build(from_document(document))
    assert not model.turns and pack_programme(diagram_of(model))["speed"] is None
    json.dumps(pack_programme(diagram_of(model)), allow_nan=False)


# -- the segments of any programme ---------------------------------------------------------------------------------------------


def absolute_table():
    """A table that goes from 2 mm to 12 mm over half a turn."""
    return MotionLaw("table", law("cycloidal").function.scaled(height=0.01, level=0.002), np.pi)


def test_lifts_of_a_table_are_its_own_and_of_other_laws_begin_where_the_one_before_ended():
    programme = Programme((Segment(np.pi, absolute_table()), Segment(np.pi, "cycloidal", -0.01)))
    table, back = diagram_segments(programme)
    assert table.absolute and not back.absolute
    assert table.course[1, [0, -1]] == pytest.approx([0.002, 0.012]) and back.course[1, [0, -1]] == pytest.approx([0.012, 0.002])


def knots(count):
    """(u, s) of so many points on half a wave."""
    u = np.linspace(0, 1, count)
    return [[float(x), float((1 - np.cos(np.pi * x)) / 2)] for x in u]


@pytest.mark.parametrize("pieces", [1, 8, MOST_PIECES - 1, MOST_PIECES + 5])
def test_a_segment_of_any_number_of_pieces_is_drawn_from_its_start_to_its_end(pieces):
    rise = law("spline", points=knots(pieces + 1)) if pieces > 1 else law("polynomial-345")
    assert rise.function.count >= pieces
    programme = Programme((Segment(2.0, rise, 0.03), Segment(2 * np.pi - 2.0, "cycloidal", -0.03)))
    (drawn, _), many = diagram_segments(programme), rise.function.count > MOST_PIECES
    theta, lift, velocity, *_ = drawn.course
    assert theta[0] == 0 and theta[-1] == pytest.approx(2.0) and np.all(np.diff(theta) >= -1e-12)
    assert lift == pytest.approx(programme(np.minimum(theta, 2.0 - 1e-12)).s, abs=1e-9)
    assert np.sum(np.diff(theta) * (velocity[1:] + velocity[:-1]) / 2) == pytest.approx(0.03, rel=1e-2)
    assert len(theta) == 2 * MOST_PIECES + 1 if many else len(theta) >= (LEAST + 1) * rise.function.count
    assert 90 < len(theta) < 8 * MOST_PIECES  # a smooth line, and no more than a page can move
