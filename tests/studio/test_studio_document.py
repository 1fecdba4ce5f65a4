"""The document of a browser tab: what a change does, what refuses it, and that nothing is ever lost."""

import pickle
import random
import re
import tomllib
from copy import deepcopy
from pathlib import Path

import pytest
from places import EXAMPLES
from spec_cases import FULL, install

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.spec import read_document
from drivewright.studio.design import Design
from drivewright.studio.document import Document
from drivewright.studio.error_text import without_folder
from drivewright.studio.field_info import ABSENT, field_infos
from drivewright.studio.form import form, values
from drivewright.studio.input_parsing import keys_overlap, value_in
from drivewright.studio.sample_values import unused_name, with_unused_name
from drivewright.studio.undo_history import STEPS

pytestmark = pytest.mark.interface

PRESETS = [path for kind in registry.kinds() for path in registry.mechanism(kind).presets().values()]
SPECS = [*sorted(EXAMPLES.rglob("*.toml")), *PRESETS]


def design_of(path):
    return Design(read_document(path), path.parent)


def example(name):
    return Document(design_of(EXAMPLES / f"{name}.toml"), name)


@pytest.fixture
def toy(monkeypatch, tmp_path):
    install(monkeypatch, tmp_path)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n1,1\n")
    field_infos.cache_clear()
    return Document(Design(tomllib.loads(FULL), tmp_path), "toy")


def at(document, key):
    return value_in(document.design.tables, key)


def refused(document, act, *arguments):
    """The error of an act that is refused, and proof that it changed nothing."""
    before = deepcopy((document.design.tables, document.locks, document.can_undo, document.can_redo, document.changed))
    with pytest.raises(SpecError) as caught:
        act(*arguments)
    assert (document.design.tables, document.locks, document.can_undo, document.can_redo, document.changed) == before
    return caught.value


# -- all designs there are -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_every_field_set_to_its_own_text_changes_nothing(path):
    document = Document(design_of(path))
    digest = document.design.spec().digest()
    texts = {key: field["text"] for key, field in values(form(document.design)).items() if field["text"]}
    given = {key: text for key, text in texts.items() if at(document, key) is not ABSENT}
    document.load(given)
    assert not document.changed and not document.can_undo and len(given) >= 3
    document.load(texts)  # now also the defaults are said
    assert document.design.spec().digest() == digest


UNFIT = {  # a crank on one pin has no room for another, and no output
    ("crank", "joints"): "zero length",
    ("crank", "drives"): "no joint is called",
    ("crank", "poincare"): "no output is called",
    ("crank", "bifurcation"): "no output is called",
    ("crank", "table"): "no output is called",
}


@pytest.mark.parametrize("path", PRESETS, ids=lambda path: f"{path.parts[-3]}-{path.stem}")
def test_everything_can_be_added_and_put_and_taken_back(path):
    document = Document(design_of(path))
    first, tried = document.design, 0
    for group in form(first)["groups"]:
        if words := UNFIT.get((path.stem, group["key"])):
            with pytest.raises(SpecError, match=words):
                (document.add if group["role"] in ("list", "names") else document.put)(group["key"])
            continue
        if group["role"] in ("list", "names"):
            document.add(group["key"])
        elif not group["present"]:
            document.put(group["key"])
            after = document.design
            document.take(group["key"])
            assert document.design.tables == first.tables
            document.undo()
            assert document.design.tables == after.tables
        else:
            continue
        assert document.design.spec() and document.design.tables != first.tables
        document.undo()
        assert document.design.tables == first.tables and not document.can_undo
        tried += 1
    assert tried >= 2


# -- setting -------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("length", "35", "35 mm"),
        ("drive.speed", "3", "3 rev/s"),
        ("turns", "7", 7),
        ("mirrored", "false", False),
        ("drive.sense", "forward", "forward"),
        ("weights", "1, 2", [1, 2]),
        ("points.1.0", "0.75", 0.75),
        ("joints.rocker.clearance", "7 um", "7 um"),
        ("joints.1.clearance", "7 um", "7 um"),
        ("joints.rocker.at.0", "7", "7 mm"),
        ("joints.crank.at.1", "7", "7 mm"),
        ("spring.preload", "3", 3),
        ("study.seed", "3", 3),
    ],
)
def test_a_value_is_set_and_undone(toy, key, text, value):
    before = toy.design
    toy.set(key, text)
    assert at(toy, key) == value and type(at(toy, key)) is type(value) and toy.design.spec() and toy.changed
    after = toy.design
    toy.undo()
    assert toy.design.tables == before.tables and toy.can_redo and not toy.changed
    toy.redo()
    assert toy.design.tables == after.tables and not toy.can_redo


@pytest.mark.parametrize(
    ("key", "text", "named", "words"),
    [
        ("length", "-3", "length", "must be greater than 0"),
        ("length", "3 kg", "length", "wants a length, got '3 kg' (mass)"),
        ("length", "1,5", "length", "has a comma"),
        ("length", "", "length", "is missing"),
        ("turns", "2.5", "turns", "must be a whole number, got 2.5"),
        ("mirrored", "maybe", "mirrored", "must be true or false, got 'maybe'"),
        ("drive.sense", "backwards", "drive.sense", "did you mean 'backward'?"),
        ("drive.spead", "3", "drive.spead", "unknown key (did you mean 'speed'?)"),
        ("joints.rocker.clearance", "-1", "joints.rocker.clearance", "must be at least 0"),
        ("joints.1.clearance", "-1", "joints.rocker.clearance", "must be at least 0"),
        ("joints.ghost.clearance", "1", "joints.ghost", "the list has no element 'ghost'"),
        ("joints.crank.at.2", "1 mm", "joints.crank.at.2", "the list has no element '2'"),
        ("table", "missing.csv", "table", "there is no file"),
        ("mechanism", "nonsense", "mechanism", "no mechanism is called 'nonsense'"),
    ],
)
def test_a_refused_value_changes_nothing_and_says_why(toy, key, text, named, words):
    error = refused(toy, toy.set, key, text)
    assert error.key == named and words in error.message


def test_the_empty_text_goes_back_to_the_default(toy):
    toy.set("turns", " ")
    assert at(toy, "turns") is ABSENT and toy.design.spec().turns == 3
    toy.unset("turns")
    toy.unset("drive.speed")
    assert at(toy, "drive") == {"sense": "backward"}
    toy.undo()
    toy.undo()
    assert at(toy, "turns") == 4 and not toy.can_undo


def test_parts_of_a_default_begin_with_all_of_it():
    document = example("jansen_leg")
    document.unset("gravity")
    document.set("gravity.1", "-1.6")
    assert at(document, "gravity") == ["0 m/s^2", "-1.6 m/s^2"]
    document.set("gravity.1", "")
    assert at(document, "gravity") == ["0 m/s^2", "0 m/s^2"]
    document.set("bodies.crank.velocity.0", "2")
    assert at(document, "bodies.crank.velocity") == ["2 m/s", "0 m/s"]
    document.set("bodies.crank.velocity.1", "")
    assert at(document, "bodies.crank.velocity") is ABSENT
    assert "there are always 2" in refused(document, document.set, "ground.points.O.0", "").message
    document.set("limits.joint_force", "2 kN")
    assert at(document, "limits") == {"joint_force": "2 kN"}


def test_another_part_brings_its_own_values():
    """The ratings that a spec gives for one bearing say nothing about another; the same bearing once more keeps them."""
    document = example("gearbox_shaft")
    assert at(document, "bearings.A.bearing") == "6306"
    given = at(document, "bearings.A.dynamic_rating")
    document.pick("bearings.A.bearing", "6306")
    assert at(document, "bearings.A.dynamic_rating") == given and not document.can_undo
    document.pick("bearings.A.bearing", "6406")
    assert at(document, "bearings.A.bearing") == "6406"
    assert at(document, "bearings.A.dynamic_rating") is ABSENT and at(document, "bearings.A.static_rating") is ABSENT
    document.undo()
    assert at(document, "bearings.A.dynamic_rating") == given and not document.can_undo
    document.lock("bearings.A.dynamic_rating", True)
    assert "locked" in refused(document, document.pick, "bearings.A.bearing", "6406").message


def test_one_drag_is_one_step_and_its_numbers_are_short(toy):
    for number in (0.1, 0.2, 0.30000000000000004):
        toy.set("ratio", repr(number), "drag 1")
    assert at(toy, "ratio") == 0.3
    toy.set("ratio", "0.4", "drag 2")
    toy.set("turns", "5", "drag 2")
    toy.set("turns", "6")
    toy.set("turns", "7")
    found = []
    while toy.can_undo:
        toy.undo()
        found.append((at(toy, "ratio"), at(toy, "turns")))
    assert found == [(0.4, 6), (0.4, 5), (0.4, 4), (0.3, 4), (0.25, 4)]


def test_an_undo_ends_a_drag(toy):
    toy.set("ratio", "0.5", "drag")
    toy.undo()
    toy.set("ratio", "0.6", "drag")
    toy.undo()
    assert at(toy, "ratio") == 0.25 and not toy.can_undo


def test_a_change_ends_the_future(toy):
    toy.set("ratio", "0.5")
    toy.undo()
    toy.set("turns", "5")
    assert not toy.can_redo
    toy.redo()
    assert (at(toy, "ratio"), at(toy, "turns")) == (0.25, 5)


def test_a_file_elsewhere_stays_where_it_is(toy, tmp_path):
    (tmp_path / "inner").mkdir()
    place = str((tmp_path / "lift.csv").rename(tmp_path / "inner" / "far.csv"))
    toy.set("table", place)
    toy.set("table", values(form(toy.design))["table"]["text"])
    assert at(toy, "table") == place


def test_the_past_has_an_end(toy):
    for number in range(STEPS + 50):
        toy.set("ratio", f"{0.1 + number / 1000}")
    steps = 0
    while toy.can_undo:
        toy.undo()
        steps += 1
    assert steps == STEPS and at(toy, "ratio") == pytest.approx(0.149)


def test_saved_is_what_changes_are_counted_from(toy):
    assert not toy.changed
    toy.set("turns", "5")
    toy.saved()
    assert not toy.changed
    toy.undo()
    assert toy.changed and toy.name == "toy"


# -- elements and tables -------------------------------------------------------------------------------------------------------


def test_elements_come_and_go(toy):
    toy.add("joints")
    toy.add("joints")
    assert [joint["name"] for joint in at(toy, "joints")] == ["crank", "rocker", "rocker2", "rocker3"]
    toy.drop("joints", 1)
    assert [joint["name"] for joint in at(toy, "joints")] == ["crank", "rocker2", "rocker3"]
    assert "has no element 3; it has 3" in refused(toy, toy.drop, "joints", 3).message
    assert "is no list" in refused(toy, toy.add, "length").message
    toy.add("weights")
    toy.add("points")
    assert at(toy, "weights") == [3.0, 3.0] and at(toy, "points")[2] == at(toy, "points")[1]


def test_a_copy_moves_aside_where_places_must_differ():
    document = example("spindle")
    document.add("stations")
    assert at(document, "stations.2.name") == "nose2" and at(document, "stations.nose2.position") != at(document, "stations.nose.position")
    document.add("bearings")
    assert at(document, "bearings.4.name") == "front_3"


def test_names_come_and_go():
    document = example("four_bar")
    document.put("bodies.plate")
    document.add("ground.points")
    assert "plate" in at(document, "bodies") and list(at(document, "ground.points")) == ["O2", "O4", "O5"]
    document.take("ground.points.O5")
    document.take("bodies.plate")
    assert not document.changed
    assert "is no name here" in refused(document, document.put, "bodies.two words").message
    assert "is no table" in refused(document, document.put, "limits.joint_force").message


def test_a_new_table_names_what_the_design_has():
    document = example("four_bar")
    refused(document, document.take, "drive")  # the run counts turns
    document.take("simulate")
    document.take("drive")
    document.set("joints.O2.name", "shaft")  # the sample says "O2"
    document.put("drive")
    assert at(document, "drive.joint") in [joint["name"] for joint in at(document, "joints")]
    document.put("optimise")
    assert document.design.spec().optimise.unknowns and {"optimise", "study"} <= {group["key"] for group in form(document.design)["groups"]}


def test_a_list_of_nothing_gets_a_sample_that_fits():
    document = example("jansen_leg")
    assert at(document, "springs") is ABSENT
    document.add("springs")
    bodies = {*at(document, "bodies"), "ground"}
    assert {end.split(".")[0] for end in at(document, "springs.0.connects")} <= bodies


# -- locks ---------------------------------------------------------------------------------------------------------------------


def test_a_locked_key_refuses_every_change(toy):
    for key in ("length", "joints.1.clearance", "spring.preload"):
        toy.lock(key, True)
    assert toy.locks == {"length", "joints.rocker.clearance", "spring.preload"}
    for act, *arguments in (
        (toy.set, "length", "3 mm"),
        (toy.set, "length", "nonsense"),
        (toy.unset, "length"),
        (toy.take, "spring"),
        (toy.drop, "joints", 1),
        (toy.set, "joints.1.name", "other"),
        (toy.text, toy.design.toml().replace("40 mm", "4 mm")),
    ):
        assert "is locked" in refused(toy, act, *arguments).message
    assert refused(toy, toy.set, "length", "3").key == "length"
    toy.set("joints.1.at", "1, 2")
    toy.drop("joints", 0)
    toy.lock("length", False)
    toy.set("length", "3")
    assert at(toy, "length") == "3 mm"
    assert "is no field" in refused(toy, toy.lock, "nothing", True).message


def test_a_preset_and_a_row_keep_what_is_locked(toy):
    toy.lock("length", True)
    toy.lock("drive.speed", True)
    toy.lock("tilt", True)
    toy.unset("ratio")
    toy.lock("ratio", True)
    other = toy.design.changed({"length": "77 mm", "tilt": "5 deg", "ratio": 0.7, "turns": 9, "title": "other"})
    del other.tables["drive"]
    toy.replace(other)
    assert [at(toy, key) for key in ("length", "tilt", "turns", "title")] == ["40 mm", "-30 deg", 9, "other"]
    assert at(toy, "drive") == {"speed": "2 rev/s"} and at(toy, "ratio") is ABSENT
    toy.load({"length": "1 mm", "turns": "2", "drive.speed": "1 rpm", "spring.rate": "4.5"})
    assert (at(toy, "length"), at(toy, "turns"), at(toy, "spring.rate")) == ("40 mm", 2, 4.5) and at(toy, "drive.speed") == "2 rev/s"
    toy.undo()
    toy.undo()
    assert at(toy, "title") == "a toy" and toy.locks == {"length", "drive.speed", "tilt", "ratio"}


def test_half_a_point_can_be_locked(toy):
    toy.set("joints.0.at.0", "3")
    toy.lock("joints.0.at.0", True)
    other = toy.design.changed({"joints.0": {"name": "crank"}})
    toy.replace(other)
    assert at(toy, "joints.crank.at") == ["3 mm", "1 mm"]


def test_a_locked_element_that_has_no_place_is_named(toy):
    toy.set("joints.rocker.clearance", "3 um")
    toy.lock("joints.rocker.clearance", True)
    other = toy.design.changed({"joints": []})
    error = refused(toy, toy.replace, other)
    assert error.key == "joints.rocker.clearance" and "has no place for it" in error.message


def test_another_kind_forgets_the_locks_and_can_be_undone():
    document = example("disc_cam")
    document.lock("face.width", True)
    document.replace(design_of(EXAMPLES / "four_bar.toml"))
    assert document.design.kind == "linkage" and not document.locks and document.changed
    document.undo()
    assert document.design.kind == "cam" and not document.changed


# -- whole designs -------------------------------------------------------------------------------------------------------------


def test_edited_text(toy):
    toy.text(toy.design.toml().replace("turns = 4", "turns = 8"))
    assert at(toy, "turns") == 8
    for text, key, words in (
        ("length = 3 mm", None, "at line 1"),
        ("", "mechanism", "is missing"),
        (toy.design.toml().replace("turns = 8", "turns = 88"), "turns", "must be at most 9, got 88"),
        ('mechanism = "no such"', "mechanism", "no mechanism is called 'no such'"),
    ):
        error = refused(toy, toy.text, text)
        assert error.key == key and words in error.message
    toy.undo()
    assert at(toy, "turns") == 4 and not toy.can_undo


def test_a_key_said_elsewhere_is_put_in_its_place():
    tables = read_document(EXAMPLES / "disc_cam.toml")
    tables["drive"]["rotation"] = "clockwise"
    design = Design(tables, EXAMPLES)
    document = Document(design)
    assert at(document, "rotation") == "clockwise" and at(document, "drive") == {"speed": "600 rpm"}
    assert document.design.spec().digest() == design.spec().digest() and not document.changed
    assert set(document.design.tables) == {*tables, "rotation"}  # and no defaults


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["four_bar", "spindle", "oscillating_cam"])
def test_any_walk_can_be_walked_back(name, seed):
    """Random changes, allowed and refused: each leaves a valid design, and undo goes back through the very tables."""
    document, pick = example(name), random.Random(seed)
    trail, refusals = [document.design.tables], 0
    for _ in range(40):
        fields = values(form(document.design))
        key = pick.choice(list(fields))
        lists = [group["key"] for group in form(document.design)["groups"] if group["role"] == "list"]
        some = pick.choice(lists)
        acts = [
            (document.set, key, pick.choice(["7", "-1", "0.5", "nonsense", "true", "", fields[key]["text"], "3 mm", "1, 2"])),
            (document.unset, key),
            (document.add, some),
            (document.drop, some, 0),
        ]
        act, *arguments = pick.choice(acts)
        frozen = deepcopy(document.design.tables)
        try:
            act(*arguments)
        except SpecError as error:
            assert document.design.tables == frozen and error.message
            refusals += 1
        document.design.spec()
        if document.design.toml() != Design(trail[-1]).toml():
            trail.append(document.design.tables)
    assert refusals > 3 and len(trail) > 5
    last = document.design.tables
    for tables in reversed(trail[:-1]):
        document.undo()
        assert document.design.tables == tables
    assert not document.can_undo
    for _ in trail[1:]:
        document.redo()
    assert document.design.tables == last and not document.can_redo


# -- messages ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("message", "clean"),
    [
        ("there is no file '/home/x y/z/lift.csv'; a path is relative", "there is no file 'lift.csv'; a path is relative"),
        ("/home/x/y/lift.csv: line 3: the angle is 'a'", "lift.csv: line 3: the angle is 'a'"),
        ("table: /srv/some folder/data/lift.csv: no column", "table: data/lift.csv: no column"),
        (r"C:\Users\me\lift.csv: no column", "lift.csv: no column"),
        (r"there is no file 'C:\\Users\\me too\\lift.csv'", "there is no file 'lift.csv'"),
        ("a torque wants N m/rad or 1/mm, mm^3/(N m) and/or m/s", "a torque wants N m/rad or 1/mm, mm^3/(N m) and/or m/s"),
        ("see https://example.org/a/b and 3 / 4", "see https://example.org/a/b and 3 / 4"),
        ("two: /a/b/c.csv, (/d/e/f.csv)", "two: c.csv, (f.csv)"),
    ],
)
def test_no_folder_of_this_machine_is_in_a_message(message, clean):
    assert without_folder(message, Path("/srv/some folder")) == clean


def test_a_missing_file_names_no_folder(toy, tmp_path):
    error = refused(toy, toy.set, "table", "missing.csv")
    assert str(tmp_path) in error.message and without_folder(error.message, tmp_path).startswith("there is no file 'missing.csv'")


@pytest.mark.parametrize(
    ("name", "taken", "found"),
    [
        ("arm", {"arm"}, "arm2"),
        ("arm", {"arm", "arm2"}, "arm3"),
        ("arm2", set(), "arm3"),
        ("arm2", {"arm2", "arm3"}, "arm4"),
        ("arm_1", {"arm_1"}, "arm_2"),
        ("arm_7", {"arm_8"}, "arm_9"),
        ("7", {"7"}, "8"),
        (None, set(), "a2"),
    ],
)
def test_a_fresh_name(name, taken, found):
    assert unused_name(name, taken) == found


def test_a_key_overlaps_what_is_in_it_only():
    assert (
        keys_overlap("bodies.crank", "bodies.crank")
        and keys_overlap("bodies", "bodies.crank.mass")
        and keys_overlap("bodies.crank.mass", "bodies")
    )
    assert not keys_overlap("bodies.crank", "bodies.crank2") and not keys_overlap("bodies.crank2.mass", "bodies.crank")


def test_a_copy_shares_nothing_with_its_model():
    model = {"name": "arm", "at": ["1 mm"]}
    copy, plain = with_unused_name(model, [model]), with_unused_name(["1 mm"], [])
    copy["at"][0] = "2 mm"
    assert copy["name"] == "arm2" and plain == ["1 mm"] and model == {"name": "arm", "at": ["1 mm"]}


# -- in two processes ----------------------------------------------------------------------------------------------------------


def test_changes_made_in_another_process_are_the_same_changes():
    """The same hundred steps, on a document and by way of pickled copies with one step of its past: equal after each."""
    straight, far, random_ = example("four_bar"), example("four_bar"), random.Random(5)
    speeds = [
        ("set", {"key": "drive.speed", "text": f"{speed} rpm", "gesture": gesture}) for speed in (90, 91, 92) for gesture in ("", "a")
    ]
    speeds += [("drag", {"changes": {"drive.speed": f"{speed} rpm"}, "gesture": "d"}) for speed in (93, 94)]
    speeds += [("revert", {"gesture": gesture}) for gesture in ("a", "d")]
    others = [("undo", {}), ("undo", {}), ("redo", {}), ("unset", {"key": "drive.speed"}), ("lock", {"key": "drive.speed", "on": True})]
    others += [("lock", {"key": "drive.speed", "on": False}), ("set", {"key": "drive.speed", "text": "3 kg"}), ("", {})]
    for _ in range(100):
        change, arguments = random_.choice(speeds + others)
        copy = pickle.loads(pickle.dumps(far.present()))
        try:
            if change:
                getattr(copy, change)(**arguments)
                far.follow(change, copy)
        except SpecError as error:
            with pytest.raises(SpecError, match=re.escape(str(error))):
                getattr(straight, change)(**arguments)
        else:
            if change:
                getattr(straight, change)(**arguments)
        for document in (straight, far):
            document.seen = [
                document.design.toml(),
                document.locks,
                document.changed,
                *([design.toml() for design in designs] for designs in (document._past, document._future)),
            ]
        assert straight.seen == far.seen


def test_a_copy_for_another_process_does_not_grow_with_the_past():
    document = example("four_bar")
    for speed in (91, 92):
        document.set("drive.speed", f"{speed} rpm")
    first = len(pickle.dumps(document.present()))
    for speed in range(100, 150):
        document.set("drive.speed", f"{speed} rpm")
    assert len(pickle.dumps(document.present())) < 1.5 * first


def test_the_past_of_a_large_design_is_shorter(monkeypatch):
    document = example("four_bar")
    monkeypatch.setattr("drivewright.studio.undo_history.HISTORY", 5 * len(document.design.toml()) + 100)
    for speed in range(100, 120):
        document.set("drive.speed", f"{speed} rpm")
    assert len(document._past) == 5
    document.undo()
    assert at(document, "drive.speed") == "118 rpm"


def test_steps_of_designs_too_large_for_a_past_are_remembered_one_at_a_time(monkeypatch):
    """Also where another process makes the changes, whose copy forgets the step before."""
    document = example("four_bar")
    monkeypatch.setattr("drivewright.studio.undo_history.HISTORY", 10)
    for speed in range(100, 104):
        copy = pickle.loads(pickle.dumps(document.present()))
        copy.set("drive.speed", f"{speed} rpm")
        document.follow("set", copy)
    document.undo()
    assert at(document, "drive.speed") == "102 rpm" and not document.can_undo
