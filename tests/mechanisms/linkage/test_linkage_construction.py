"""A linkage built by tools that take clicked places: what the tables become, and what is said to be missing."""

import math

import numpy as np
import pytest

from drivewright import registry
from drivewright.errors import DoesNotAssemble, InputError
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.construction import CONSTRUCTION, TOOLS, _match_run
from drivewright.mechanisms.linkage.sketch import connected, loose_poses, sketch, stated_poses, unfinished
from drivewright.spec import from_document, read_document
from drivewright.studio.document import Document
from drivewright.studio.opening import preset

pytestmark = pytest.mark.interface


class Building:
    """A document and a hand on its drawing; places in mm."""

    def __init__(self, name=None):
        self.document = Document(preset("linkage", name))

    def use(self, tool, *places):
        """One use of a tool; what is missing then."""
        self.document.construct(tool, [(x / 1e3, y / 1e3) for x, y in places], 0.003)
        return unfinished(self.spec)

    @property
    def tables(self):
        return self.document.design.tables

    @property
    def spec(self):
        return self.document.design.spec()


@pytest.fixture
def hand():
    return Building()


def test_a_four_bar_from_clicks_moves():
    hand = Building()
    before = hand.document.design
    hand.use("body", (0, -200), (40, -200))
    hand.use("body", (40, -200), (100, -120))
    hand.use("body", (100, -120), (120, -200))
    for place in ((0, -200), (40, -200), (100, -120), (120, -200)):
        missing = hand.use("pin", place)
    assert missing == ("remaining degrees of freedom beside the drive: 1; add a drive on another pin, or joints",)
    assert build(hand.spec).assembly.freedom == 1
    assert [joint["connects"] for joint in hand.tables["joints"][4:]] == [
        ["ground.A", "link_1.A"],
        ["link_1.B", "link_2.A"],
        ["link_2.B", "link_3.A"],
        ["ground.B", "link_3.B"],
    ]
    assert hand.use("drive", (0, -200)) == ()  # beside the drive of the first
    assert hand.tables["drive"]["joint"] == "O2" and [drive["joint"] for drive in hand.tables["drives"]] == ["A_2"]
    for _ in range(8):
        hand.document.undo()
    assert hand.document.design.tables == before.tables and not hand.document.can_undo


def test_a_body_without_joints_stands_where_it_was_clicked(hand):
    missing = hand.use("body", (-80, 10), (-80, 70), (-120, 70))
    assert missing == (
        "body link_1 is held by no joint: add a pin or a slide",
        "remaining degrees of freedom beside the drive: 3; add joints",
    )
    assert not connected(hand.spec)
    assert hand.tables["bodies"]["link_1"]["points"]["C"] == ["-120 mm", "70 mm"]
    drawn = {body.name: body for body in sketch(hand.spec).bodies}
    assert drawn["link_1"].poses.tolist() == [[0, 0, 0], [0, 0, 0]] and abs(drawn["coupler"].poses[0, 0] - 0.04) < 1e-9


def test_a_pin_on_a_bar_makes_the_point_and_says_what_remains(hand):
    hand.use("body", (-80, 0), (-80, 60))
    assert hand.use("pin", (-80, 30)) == ("remaining degrees of freedom beside the drive: 1; body link_1 is held by one joint only",)
    assert hand.tables["bodies"]["link_1"]["points"]["C"] == ["-80 mm", "30 mm"]


def test_a_slide_has_its_direction_in_the_frame_of_the_second_body(hand):
    hand.use("body", (-80, 0), (-80, 60))
    hand.use("slide", (-80, 60), (-50, 100))
    assert hand.tables["joints"][-1]["axis"] == [0.6, 0.8] and build(hand.spec).assembly.freedom == 1


def test_the_drive_goes_before_its_pin_and_comes_back(hand):
    assert hand.use("delete", (0, 0)) == ("remaining degrees of freedom: 1; add a drive on a pin",)
    assert "drive" not in hand.tables and "simulate" not in hand.tables and len(hand.tables["joints"]) == 4
    assert hand.use("delete", (0, 0)) == ("remaining degrees of freedom: 3; add a drive on a pin",)
    hand.use("pin", (0, 0))
    assert hand.use("drive", (0, 0)) == ()
    assert hand.tables["drive"]["joint"] == "O2" and hand.tables["simulate"]["turns"] > 0


LEFT, RIGHT, TOOL = (0, 0), (150, 0), (80, 90)
BEYOND = "remaining degrees of freedom beside the drive: 1; add a drive on another pin, or joints"


@pytest.fixture
def five_bar():
    """A hand that has built a five-bar upon a driven crank: two degrees of freedom, one drive."""
    hand = Building("crank")
    for ends in (((40, 0), TOOL), (TOOL, (130, 30)), ((130, 30), RIGHT)):
        hand.use("body", *ends)
    for place in ((40, 0), TOOL, (130, 30), RIGHT):
        missing = hand.use("pin", place)
    assert missing == (BEYOND,)
    return hand


def test_a_second_drive_completes_a_five_bar(five_bar):
    assert five_bar.use("drive", RIGHT) == ()
    assert five_bar.tables["drive"]["joint"] == "O2" and five_bar.tables["drives"] == [{"joint": "B", "speed": "60 rpm"}]
    assert build(five_bar.spec).assembly.freedom == 0
    five_bar.document.undo()
    assert "drives" not in five_bar.tables and unfinished(five_bar.spec) == (BEYOND,)


def test_drives_are_taken_away_one_by_one(five_bar):
    five_bar.use("drive", RIGHT)
    assert five_bar.use("delete", LEFT) == (BEYOND,)  # the other one is the first drive now
    assert five_bar.tables["drive"]["joint"] == "B" and "drives" not in five_bar.tables and len(five_bar.tables["joints"]) == 5
    assert five_bar.use("delete", RIGHT) == ("remaining degrees of freedom: 2; add a drive on a pin",)
    assert "drive" not in five_bar.tables and "simulate" not in five_bar.tables


def test_a_third_drive_and_one_on_a_driven_pin_are_refused(five_bar):
    five_bar.use("drive", RIGHT)
    before = five_bar.document.design
    for place, words in (((130, 30), "no degree of freedom is left"), (RIGHT, "has a drive already")):
        with pytest.raises(InputError, match=words):
            five_bar.use("drive", place)
    assert five_bar.document.design is before


def test_a_pin_that_the_first_drive_turns_takes_no_further_one(hand):
    hand.use("body", (-80, 0), (-80, 60))
    hand.use("pin", (-80, 0))  # a pendulum beside the four-bar
    with pytest.raises(InputError, match="already set how this pin turns"):
        hand.use("drive", (120, 0))
    assert hand.use("drive", (-80, 0)) == () and [drive["joint"] for drive in hand.tables["drives"]] == ["A_2"]


def test_a_single_drive_moves_where_nothing_is_free(hand):
    hand.use("drive", (120, 0))
    assert hand.tables["drive"]["joint"] == "O4" and "drives" not in hand.tables


def test_a_mark_stands_at_each_driven_pin(five_bar):
    def marks():
        return {body.name for body in sketch(five_bar.spec).bodies if body.name.startswith("drive ")}

    assert marks() == {"drive O2"}
    five_bar.use("drive", RIGHT)
    assert marks() == {"drive O2", "drive B"}


def test_loads_and_springs(hand):
    hand.use("force", (40, 0))  # on the coupler, which lies upon the crank
    hand.use("load", (20, 0))
    hand.use("spring", (40, 0), (40, -50))
    assert hand.tables["forces"][0]["body"] == "coupler" and hand.tables["torques"][0]["body"] == "crank"
    assert hand.tables["springs"][0]["free_length"] == "50 mm" and hand.tables["springs"][0]["connects"][1].startswith("ground.")
    hand.use("delete", (20, 0))  # the bar of the crank
    assert "crank" not in hand.tables["bodies"] and not {"torques", "springs"} & set(hand.tables) and hand.tables["forces"]


def test_an_output_belongs_to_the_uppermost_body_at_its_place(hand):
    hand.use("body", (300, 0), (340, 60))
    hand.use("body", (340, 60), (380, 0))
    hand.use("output", (340, 60))
    assert hand.tables["outputs"][-1] == {"name": "output_2", "body": "link_2", "point": "A"}


def test_a_body_that_goes_takes_its_supports_along(hand):
    hand.use("body", (300, 0), (340, 60), (380, 0))
    hand.use("pin", (300, 0))
    kept = set(hand.tables["ground"]["points"])
    hand.use("delete", (340, 20))  # inside the plate, far from its sides
    assert "link_1" not in hand.tables["bodies"] and set(hand.tables["ground"]["points"]) == kept - {"A"} == {"O2", "O4"}


def test_a_preset_to_begin_with_moves_and_has_nothing_but_a_crank():
    spec = from_document(read_document(registry.mechanism("linkage").presets()[CONSTRUCTION.start]))
    assert list(spec.bodies) == ["crank"] and unfinished(spec) == () and build(spec).assembly.freedom == 0


def test_what_does_not_close_is_drawn_as_it_is_stated(hand):
    spec = from_document({**hand.tables, "joints": [*hand.tables["joints"], {"name": "x", "connects": ["coupler.C", "ground.O2"]}]})
    with pytest.raises(DoesNotAssemble):
        build(spec)
    assert {body.name for body in sketch(spec).bodies} == {"ground", "crank", "coupler", "rocker", "drive O2"}
    assert "does not close" in unfinished(spec)[-1] and stated_poses(spec)["coupler"][:2] == pytest.approx((0.04, 0))


@pytest.mark.parametrize(
    "tool, places, words",
    [
        ("pin", [(0, 500)], "no body here"),
        ("pin", [(0, 0)], "already joined"),
        ("drive", [(20, 0)], "no pin here"),
        ("body", [(0, 500), (1, 500)], "at the same place"),
        ("spring", [(0, 500), (50, 500)], "same body"),
        ("body", [(0, 500)], "takes 2 to 12 places"),
        ("pin", [(0, 0), (1, 1)], "takes 1 to 1 places"),
        ("weld", [(0, 0)], "is not built with"),
        ("pin", [(1e12, 0)], "too far away"),
        ("pin", [(-1e12, 0)], "too far away"),
        ("pin", [(0, -1e12)], "too far away"),
        ("pin", [(float("nan"), 0)], "too far away"),
    ],
)
@pytest.mark.error
def test_places_that_do_not_suit_a_tool_change_nothing(hand, tool, places, words):
    before = hand.document.design
    with pytest.raises(InputError, match=words):
        hand.use(tool, *places)
    assert hand.document.design is before and not hand.document.can_undo


def test_other_kinds_have_no_tools():
    with pytest.raises(InputError, match="is not built with"):
        Document(preset("cam")).construct("pin", [(0.0, 0.0)], 0.001)
    assert len({tool.name for tool in TOOLS}) == len(TOOLS) == 9


# -- what a click makes, in numbers --------------------------------------------------------------------------------------------


def carried(pose, point):
    """Where a point of a body is seen [m]."""
    x, y, angle = pose
    c, s = math.cos(angle), math.sin(angle)
    return x + c * point[0] - s * point[1], y + s * point[0] + c * point[1]


@pytest.mark.parametrize(
    ("corners", "mass", "size", "centroid"),
    [
        ([(300, 0), (400, 0)], 0.1, 0.1, (350, 0)),
        ([(300, 0), (360, 0), (360, 80)], 0.14, 0.1, (340, 26.6667)),  # 60 + 80 mm along its sides, 100 mm across
        ([(300, 0), (400, 0), (303.5, 0)], 0.1965, 0.1, (334.5, 0)),  # there and almost back again
    ],
)
def test_a_body_weighs_a_kilogram_a_metre_and_turns_like_a_slender_bar(hand, corners, mass, size, centroid):
    """Steiner's bar about its middle: m L^2 / 12, over its largest extent."""
    hand.use("body", *corners)
    made = hand.spec.bodies["link_1"]
    assert made.mass == pytest.approx(mass, rel=5e-3) and made.inertia == pytest.approx(mass * size**2 / 12, rel=1e-2)
    assert [1e3 * part for part in made.centroid] == pytest.approx(centroid, abs=1e-3)


def test_places_are_kept_to_a_tenth_of_a_micrometre(hand):
    hand.use("body", (300.1234, -0.5678), (340, 0))
    assert hand.tables["bodies"]["link_1"]["points"]["A"] == ["300.1234 mm", "-0.5678 mm"]


@pytest.mark.parametrize(("body", "part"), [("coupler", 0.3), ("rocker", 0.6)])
def test_a_point_that_is_made_on_a_turned_body_is_seen_where_it_was_clicked(hand, body, part):
    pose, points = loose_poses(hand.spec)[body], list(hand.spec.bodies[body].points.values())[:2]
    a, b = (np.array(carried(pose, point)) for point in points)
    place = a + part * (b - a)
    hand.use("output", 1e3 * place)
    made = hand.spec.outputs[-1]
    assert made.body == body and abs(math.sin(pose[2])) > 0.05
    assert carried(loose_poses(hand.spec)[body], hand.spec.bodies[body].points[made.point]) == pytest.approx(place, abs=2e-7)


def test_of_two_points_of_a_body_the_nearer_one_is_meant(hand):
    hand.use("body", (300, 0), (340, 0))
    hand.use("output", (304, 0))  # makes C, four millimetres beside A
    for x, name in ((301.5, "A"), (302.5, "C")):
        hand.use("output", (x, 0))
        assert hand.tables["outputs"][-1]["point"] == name


def test_a_further_body_on_a_support_is_pinned_to_the_frame(hand):
    hand.use("body", (300, 0), (340, 60))
    hand.use("pin", (300, 0))
    hand.use("body", (300, 0), (260, 60))
    hand.use("pin", (300, 0))
    assert [joint["connects"] for joint in hand.tables["joints"][4:]] == [["ground.A", "link_1.A"], ["ground.A", "link_2.A"]]


def test_a_run_of_turns_keeps_its_duration_without_a_drive():
    run = {"turns": 3, "discard": 1, "duration": "2 s", "output_step": "1 ms"}
    tables = {"joints": [], "drive": {"joint": "gone", "speed": "60 rpm"}, "simulate": dict(run)}
    _match_run(tables)
    assert tables == {"joints": [], "simulate": {"duration": "2 s", "output_step": "1 ms"}}
    kept = {"joints": [{"name": "O2"}], "drive": {"joint": "O2", "speed": "60 rpm"}, "simulate": dict(run)}
    _match_run(kept)
    assert kept["simulate"] == run


@pytest.mark.parametrize("angle", [0, 30, -110])
def test_bodies_that_are_not_assembled_hang_on_their_joints_at_their_angles(hand, angle):
    """The pins of every stated body meet, from the frame outwards; one without joints turns about the origin."""
    hand.use("body", (300, 0), (340, 60))
    hand.use("body", (500, 0), (540, 60))
    hand.use("pin", (300, 0))
    bodies = {**hand.tables["bodies"]}
    for name in ("link_1", "link_2"):
        bodies[name] = {**bodies[name], "angle": f"{angle} deg"}
    loose = {"name": "x", "connects": ["coupler.C", "ground.O2"]}
    spec = from_document({**hand.tables, "bodies": bodies, "joints": [*hand.tables["joints"], loose]})
    poses = stated_poses(spec)
    assert carried(poses["link_1"], spec.bodies["link_1"].points["A"]) == pytest.approx((0.3, 0), abs=1e-9)
    assert poses["link_1"][2] == pytest.approx(math.radians(angle)) and poses["link_2"] == pytest.approx((0, 0, math.radians(angle)))
    drawn = {body.name: body.poses for body in sketch(spec).bodies}
    assert drawn["link_2"] == pytest.approx(np.tile(poses["link_2"], (2, 1)))


def test_the_loose_end_is_not_the_body_that_the_drive_turns():
    hand = Building()
    hand.document = Document(preset("linkage", CONSTRUCTION.start))
    hand.use("body", (300, 0), (340, 60))
    assert hand.use("pin", (300, 0)) == ("remaining degrees of freedom beside the drive: 1; body link_1 is held by one joint only",)


def test_a_sketch_stands_still_at_the_start(hand):
    drawn = sketch(hand.spec)
    assert {body.name for body in drawn.bodies} >= {"crank", "coupler", "rocker"}
    for body in drawn.bodies:
        assert np.ptp(body.poses, axis=0) == pytest.approx(0, abs=1e-12)
        if body.name in hand.spec.bodies:
            assert body.poses[0] == pytest.approx(loose_poses(hand.spec)[body.name])


@pytest.mark.parametrize("near", [0.0, -1e-3, 1e6, float("nan")])
@pytest.mark.error
def test_what_counts_as_upon_a_point_is_a_length(hand, near):
    before = hand.document.design
    with pytest.raises(InputError, match="takes 1 to 1 places"):
        hand.document.construct("pin", [(0.0, 0.0)], near)
    assert hand.document.design is before


def test_the_direction_of_a_slide_is_kept_in_the_frame_of_a_body_that_is_turned(hand):
    """Between two bodies: on the drawing it runs along the line of the two clicks, whatever the first one's angle is."""
    pose = loose_poses(hand.spec)["coupler"]
    ends = [np.array(carried(pose, point)) for point in list(hand.spec.bodies["coupler"].points.values())[:2]]
    place = 1e3 * (ends[0] + 0.4 * (ends[1] - ends[0]))
    hand.use("body", tuple(place), tuple(place + [0, -150]))
    hand.use("slide", tuple(place), tuple(place + [30, 40]))
    joint = hand.tables["joints"][-1]
    assert [end.partition(".")[0] for end in joint["connects"]] == ["link_1", "coupler"] and abs(math.sin(pose[2])) > 0.05
    assert carried((0.0, 0.0, pose[2]), joint["axis"]) == pytest.approx((0.6, 0.8), abs=2e-6)
