"""A list of tables arranged anew in one step: the segments of a cam's motion, as the page of the programme changes them."""

import pytest
from places import EXAMPLES

from drivewright.errors import SpecError
from drivewright.spec import read_document
from drivewright.studio.design import Design
from drivewright.studio.document import Document
from drivewright.studio.opening import LARGEST

pytestmark = pytest.mark.interface


@pytest.fixture
def cam():
    path = EXAMPLES / "disc_cam.toml"
    return Document(Design(read_document(path), path.parent), "cam")


def keep(number, **changes):
    return {"of": number, "changes": changes}


def segments(document):
    return [(each["angle"], each["law"], each.get("rise")) for each in document.design.tables["programme"]]


def test_elements_are_changed_added_and_moved_in_one_step(cam):
    before = segments(cam)
    new = {"of": None, "changes": {"angle": "30 deg", "law": "dwell"}}
    cam.arrange("programme", [keep(0), new, keep(1, law="parabolic", angle="150 deg"), keep(2)])
    assert segments(cam) == [before[0], ("30 deg", "dwell", None), ("150 deg", "parabolic", "-20 mm"), before[2]]
    cam.undo()
    assert segments(cam) == before and not cam.can_undo


def test_an_empty_text_takes_a_key_out_and_an_element_may_be_halved(cam):
    cam.arrange("programme", [keep(0, angle="45 deg"), keep(0, angle="45 deg", law="dwell", rise=""), keep(1), keep(2)])
    assert segments(cam)[:2] == [("45 deg", "cycloidal", "20 mm"), ("45 deg", "dwell", None)]
    assert "rise" not in cam.design.tables["programme"][1]


@pytest.mark.parametrize(
    ("key", "elements", "words"),
    [
        ("programme", [keep(3)], "has no element 3; it has 3"),
        ("programme", [keep(-1)], "has no element -1"),
        ("programme", [keep(0), keep(0), keep(0)], "more than twice"),
        ("programme", [keep(0, angle="3 kg")], "wants an angle"),
        ("programme", [keep(0, nonsense="3")], "nonsense"),
        ("programme", [], "programme"),
        ("follower", [keep(0)], "is no list"),
        ("programme.0.points", [keep(0)], "is no list of tables"),
    ],
)
def test_what_cannot_be_arranged_is_refused_and_changes_nothing(cam, key, elements, words):
    before = segments(cam)
    with pytest.raises(SpecError, match=words):
        cam.arrange(key, elements)
    assert segments(cam) == before and not cam.can_undo


def test_a_locked_number_stays(cam):
    cam.lock("programme.0.angle", True)
    with pytest.raises(SpecError, match="locked"):
        cam.arrange("programme", [keep(0, angle="80 deg"), keep(1, angle="190 deg"), keep(2)])
    cam.arrange("programme", [keep(0), keep(1, law="modified-sine"), keep(2)])
    assert segments(cam)[1][1] == "modified-sine"


def test_a_drag_of_a_border_is_one_step(cam):
    before = segments(cam)
    for angle in (91, 95, 100):
        cam.drag({"programme.0.angle": f"{angle} deg", "programme.1.angle": f"{270 - angle} deg"}, "a border")
    assert [angle for angle, _, _ in segments(cam)] == ["100 deg", "170 deg", "90 deg"]
    cam.undo()
    assert segments(cam) == before


def test_steps_of_other_keys_are_another_step_of_undo_whatever_their_gesture(cam):
    cam.drag({"follower.prime_radius": "41 mm", "spring.preload": "31 N"}, "g")
    cam.drag({"follower.prime_radius": "42 mm"}, "g")
    cam.undo()
    assert cam.design.tables["follower"]["prime_radius"] == "41 mm" and cam.can_undo


def test_what_would_outgrow_the_studio_is_refused_before_it_is_read(cam):
    before = cam.design
    with pytest.raises(SpecError, match="is too much for the studio"):
        cam.arrange("programme", [keep(0, file="x" * (LARGEST + 1)), keep(1), keep(2)])
    assert cam.design is before


@pytest.mark.parametrize("locked", ["bodies.crank.points.A", "bodies.crank.points.A.0"])
def test_a_row_that_is_loaded_leaves_what_is_locked_and_all_of_a_locked_point(locked):
    """Whichever of the two is the part of the other: the rest of the row is loaded."""
    bar = Document(Design(read_document(EXAMPLES / "four_bar.toml"), EXAMPLES), "four_bar")
    before = bar.design.tables["bodies"]["crank"]["points"]["A"]
    bar.lock(locked, True)
    bar.load({"bodies.crank.points.A.0": "45 mm", "drive.speed": "99 rpm"})
    assert bar.design.tables["bodies"]["crank"]["points"]["A"] == before and bar.design.tables["drive"]["speed"] == "99 rpm"


@pytest.mark.parametrize("index", [-1, 3])
def test_only_an_element_that_is_there_goes(cam, index):
    before = cam.design
    with pytest.raises(SpecError, match=f"has no element {index}; it has 3"):
        cam.drop("programme", index)
    assert cam.design is before


def test_a_lock_goes_with_what_a_step_back_takes_away(cam):
    """It would hold a field that nobody can see, and refuse whatever comes into its place."""
    cam.lock("spring.preload", True)
    cam.arrange("programme", [keep(0), {"of": None, "changes": {"angle": "30 deg", "law": "dwell"}}, keep(1), keep(2)])
    cam.lock("programme.3.law", True)
    cam.undo()
    assert cam.locks == {"spring.preload"}
    cam.redo()
    assert cam.locks == {"spring.preload"}
