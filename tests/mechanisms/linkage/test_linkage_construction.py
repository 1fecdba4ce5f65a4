"""A linkage built by tools that take clicked places: what the tables become, and what is said to be missing."""

import pytest

from drivewright import registry
from drivewright.errors import DoesNotAssemble, InputError
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.construction import CONSTRUCTION, TOOLS
from drivewright.mechanisms.linkage.sketch import connected, sketch, stated_poses, unfinished
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
