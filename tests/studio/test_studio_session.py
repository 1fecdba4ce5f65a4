"""One tab of the studio without a browser: what it is told, and what it lets nobody do."""

import asyncio
import json
import shutil

import loops
import pytest
from places import EXAMPLES
from studio_tab import Here, Tab

from drivewright.errors import InputError, SpecError
from drivewright.studio.app import _files as served_files
from drivewright.studio.edited_design import SHORT
from drivewright.studio.jobs import JOBS
from drivewright.studio.opening import LARGEST, first_design, opened, packed, unpacked
from drivewright.studio.outbox import PACE
from drivewright.studio.resources import KEPT, MOST_OFFERS, ServerResources
from drivewright.studio.session import MOST_FILES

pytestmark = pytest.mark.interface


@pytest.fixture
def resources(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    shop = ServerResources()
    shop.reading = Here()
    yield shop
    shop.close()


@pytest.fixture
def tab(resources, tmp_path):
    found = Tab(opened(shutil.copy(EXAMPLES / "four_bar.toml", tmp_path)), resources)
    found.say("hello")
    return found


def only(messages, what):
    return [message for message in messages if message["what"] == what]


def test_hello_brings_the_kinds_the_form_and_a_drawing(resources):
    tab = Tab(opened(EXAMPLES / "four_bar.toml"), resources)
    assert tab.say("set", key="title", text="x") == []  # nothing before hello
    start, design = tab.say("hello")
    assert {kind["kind"] for kind in start["kinds"]} >= {tab.session.document.design.kind}
    assert design["title"] == "Crank-rocker four-bar" and design["form"]["groups"] and not design["undo"]
    assert tab.quiet.asked[-1] == ("update", 1, tab.session.document.design, False)


def test_the_start_has_the_name_of_its_file_and_what_a_page_brings_has_none(resources):
    tab = Tab(opened(EXAMPLES / "four_bar.toml"), resources)
    tab.session.start_name = "four_bar"
    assert only(tab.say("hello"), "design")[0]["name"] == "four_bar"
    assert only(tab.say("hello", saved=tab.toml), "design")[0]["name"] == ""


def test_a_change_sends_its_field_only(tab):
    (values,) = tab.say("set", key="drive.speed", text="150")
    assert set(values["fields"]) == {"drive.speed"} and values["fields"]["drive.speed"]["text"] == "150 rpm"
    assert values["undo"] and values["changed"] and values["settled"] == ["drive.speed"] and values["gen"] == 2
    assert 'speed = "150 rpm"' in values["toml"]
    assert tab.quiet.asked[-1][:2] == ("update", 2)


def test_the_text_of_the_spec_follows_a_drag_and_does_not_hold_it_up(tab, monkeypatch):
    monkeypatch.setattr("drivewright.studio.session.REST", 60.0)
    made = []
    monkeypatch.setattr("drivewright.studio.design.source_text", lambda source, tables: made.append(tables) or "text")
    (values,) = tab.say("set", key="drive.speed", text="150 rpm", gesture="a")
    assert "toml" not in values and not made and values["fields"]
    (after,) = tab.say("source")
    assert after["toml"] == "text" and len(made) == 1


def test_a_tool_is_one_step_of_undo_and_the_drawing_stands_still_while_a_person_builds(tab):
    tab.quiet.building = False
    said = tab.say("sketch", on=True)
    assert tab.quiet.building is True and said and tab.quiet.asked[-1][0] == "update"
    (design,) = tab.say("construct", tool="body", places=[[-0.08, 0], [-0.08, 0.06]], near=0.001)
    assert "[bodies.link_1]" in design["toml"] and "# A four-bar" in design["toml"] and design["undo"]
    (back,) = tab.say("undo")
    assert "link" not in back["toml"].partition("[bodies")[2] and not back["undo"]
    assert tab.say("sketch", on=False) and tab.quiet.building is False


def test_a_refusal_has_the_words_of_the_command_line_and_changes_nothing(tab):
    before = tab.toml
    (refused,) = tab.say("set", key="drive.speed", text="3 kg")
    assert refused == {"what": "refused", "key": "drive.speed", "text": "3 kg", "message": "wants an angular speed, got '3 kg' (mass)"}
    assert tab.toml == before and tab.session.gen == 1


def test_undo_and_redo_are_designs_like_others(tab):
    before = tab.toml
    tab.say("set", key="drive.speed", text="150")
    (back,) = tab.say("undo")
    assert back["toml"] == before and back["redo"] and not back["undo"] and set(back["fields"]) == {"drive.speed"}
    (again,) = tab.say("redo")
    assert 'speed = "150 rpm"' in again["toml"]


def test_a_reload_brings_the_design_back(tab, resources):
    tab.say("set", key="drive.speed", text="150")
    other = Tab(tab.session.start, resources)
    other.say("hello", saved=tab.toml, files="")
    assert other.toml == tab.toml != Tab(tab.session.start, resources).session.start.text()


@pytest.mark.parametrize("saved", ["mechanism = ", 'mechanism = "nothing"', "x" * (LARGEST + 1), 7])
def test_what_cannot_be_brought_back_is_told_and_the_start_is_there(tab, resources, saved):
    other = Tab(tab.session.start, resources)
    said = other.say("hello", saved=saved)
    assert only(said, "refused") and only(said, "design")
    assert other.toml == tab.toml


def test_an_address_holds_a_whole_design(tab):
    (shared,) = tab.say("share")
    assert unpacked(shared["fragment"]) == tab.toml
    assert len(shared["fragment"]) < 2000


def test_texts_of_every_length_come_back():
    for length in range(1, 40):
        text = "".join(chr(48 + (7 * n * n + length) % 75) for n in range(length))
        assert unpacked(packed(text)) == text


@pytest.mark.parametrize("fragment", ["", "d=", "d=!!!", "d=AAAA", 3])
def test_a_damaged_address(fragment):
    with pytest.raises(InputError, match="damaged"):
        unpacked(fragment)


def test_an_address_that_unfolds_without_end():
    with pytest.raises(InputError, match="1,000,000 characters"):
        unpacked(packed("x" * 50_000_000))


# -- files ---------------------------------------------------------------------------------------------------------------------


def sample_with_file(name):
    """The text of the example that names a data file, with another name in its place."""
    text = (EXAMPLES / "oscillating_cam.toml").read_text(encoding="utf-8")
    assert '"lift.csv"' in text
    return text.replace('"lift.csv"', json.dumps(name))


LIFT = (EXAMPLES / "lift.csv").read_text(encoding="utf-8")


def test_a_spec_opens_with_its_data_files(tab):
    said = tab.say("open", files=[{"name": "mine.toml", "text": sample_with_file("my lift.csv")}, {"name": "my lift.csv", "text": LIFT}])
    assert only(said, "refused")  # the name on the disk is another one: blanks go
    said = tab.say("open", files=[{"name": "mine.toml", "text": sample_with_file("lift.csv")}, {"name": "lift.csv", "text": LIFT}])
    (design,) = only(said, "design")
    assert design["name"] == "mine" and design["files"] and '"lift.csv"' in design["toml"]
    other = Tab(tab.session.start, tab.session.resources)
    other.say("hello", saved=design["toml"], files=design["files"])  # and is there after a reload
    assert other.toml == design["toml"]
    (refused,) = tab.say("share")
    assert "data files" in refused["message"]


@pytest.mark.parametrize("name", ["/etc/passwd", "/etc/no-such-file", "../../../../../etc/passwd", "lift.csv", str(EXAMPLES / "lift.csv")])
def test_a_page_cannot_read_the_disk_nor_learn_what_is_on_it(tab, name):
    messages = set()
    for what in (
        {"what": "open", "files": [{"name": "a.toml", "text": sample_with_file(name)}]},
        {"what": "text", "toml": sample_with_file(name)},
    ):
        (refused,) = tab.say(**what)
        assert refused["what"] == "refused"
        messages.add((refused["key"], refused["message"]))
    # neither words nor key tell whether the file exists
    assert messages == {("", "there is no such data file here; open the spec together with the data files that it names")}


@pytest.mark.parametrize("name", ["/etc/passwd", str(EXAMPLES / "lift.csv"), "../lift.csv", "other.csv"])
def test_nor_with_files_that_it_once_sent(tab, name):
    said = tab.say("open", files=[{"name": "mine.toml", "text": sample_with_file("lift.csv")}, {"name": "lift.csv", "text": LIFT}])
    token = only(said, "design")[0]["files"]
    other = Tab(tab.session.start, tab.session.resources)
    said = other.say("hello", saved=sample_with_file(name), files=token)
    assert "there is no such data file here" in only(said, "refused")[0]["message"] and other.toml == other.session.start.text()


def test_another_drive_has_no_files(tab):
    tab.say("open", files=[{"name": "mine.toml", "text": sample_with_file("lift.csv")}, {"name": "lift.csv", "text": LIFT}])
    kind = tab.session.start.kind
    assert only(tab.say("fresh", kind=kind), "design")[0]["files"] == ""


def test_a_worked_example_brings_copies_of_its_data_files(tab):
    (design,) = only(tab.say("example", name="oscillating_cam"), "design")
    assert design["name"] == "oscillating_cam" and design["files"] and '"lift.csv"' in design["toml"]
    other = Tab(tab.session.start, tab.session.resources)
    other.say("hello", saved=design["toml"], files=design["files"])  # and is there after a reload
    assert other.toml == design["toml"]
    assert str(EXAMPLES) not in json.dumps(design)


def test_what_is_offered_to_begin_with_has_its_pictures(tab):
    (start,) = only(tab.say("hello"), "start")
    served = served_files()
    for kind in start["kinds"]:
        assert set(kind["pictures"]) == set(kind["presets"]) and kind["examples"] and kind["drawings"]
        assert all(f"preset.{kind['kind']}.{name}.webp" in served for name in kind["pictures"])
        assert all(f"drawing.{sheet['name']}.svg" in served for sheet in kind["drawings"])
        for example in kind["examples"]:
            assert f"example.{example['name']}.webp" in served
            assert (f"example.{example['name']}.moving.webp" in served) == example["moving"]


def test_only_some_files_are_looked_at(tab):
    spec = {"name": "a.toml", "text": (EXAMPLES / "four_bar.toml").read_text(encoding="utf-8")}
    others = [{"name": f"{n}.csv", "text": ""} for n in range(MOST_FILES)]
    assert only(tab.say("open", files=[*others[1:], spec]), "design")
    (refused,) = tab.say("open", files=[*others, spec])
    assert f"here are 0 specs in {MOST_FILES} files" in refused["message"]


def test_no_message_shows_a_folder_of_this_machine(resources):
    tab = Tab(opened(EXAMPLES / "oscillating_cam.toml"), resources)
    said = tab.say("hello")
    said += tab.say("set", key="motion.file", text="missing.csv") + tab.say("text", toml="format = 1\n]")
    assert str(EXAMPLES) not in json.dumps(said)


def test_names_of_files_cannot_leave_their_folder(tab, tmp_path):
    said = tab.say("open", files=[{"name": "../../evil.toml", "text": (EXAMPLES / "four_bar.toml").read_text(encoding="utf-8")}])
    assert only(said, "design") and not list(tmp_path.glob("evil*"))
    assert len(list(tmp_path.glob("drivewright-studio-*/*/*evil.toml"))) == 1


@pytest.mark.parametrize("files", [[], [{"name": "a.csv", "text": ""}], [{"name": "a.toml", "text": ""}, {"name": "b.toml", "text": ""}]])
def test_one_spec_at_a_time(tab, files):
    (refused,) = tab.say("open", files=files)
    assert "open one spec (.toml)" in refused["message"]


def test_too_much_is_refused(tab):
    half = "#" * (LARGEST // 2 + 1)
    (refused,) = tab.say("open", files=[{"name": "a.toml", "text": half}, {"name": "b.csv", "text": half}])
    assert "1,000,000 characters" in refused["message"]


def test_too_many_messages_at_once_are_refused_in_one_line_each(tab):
    said = tab.send(*({"what": "unset", "key": "drive.speed"} for _ in range(120)))
    refused = [message for message in only(said, "refused") if "more than the studio can answer" in message["message"]]
    assert len(refused) == 20 and len(only(said, "refused")) + len(only(said, "values")) == 120


def test_steps_of_one_drag_that_wait_are_one(tab):
    steps = [{"what": "set", "key": "drive.speed", "text": f"{speed} rpm", "gesture": "a"} for speed in range(100, 150)]
    tab.quiet.asked.clear()
    said = tab.send(*steps, {"what": "set", "key": "drive.speed", "text": "7 rpm", "gesture": "b"})
    assert [design.tables["drive"]["speed"] for _, _, design, _ in tab.quiet.asked] == ["149 rpm", "7 rpm"]
    assert [message["fields"]["drive.speed"]["text"] for message in only(said, "values")] == ["7 rpm"]  # the form follows more slowly
    assert tab.say("undo")[0]["fields"]["drive.speed"]["text"] == "149 rpm"
    said = tab.send(*({"what": "set", "key": "drive.speed", "text": f"{speed} rpm"} for speed in (1, 2, 3)))  # typed: each counts
    assert len(only(said, "values")) == 3


def drag(gesture="g", **parts):
    changes = {f"bodies.crank.points.A.{part[1:]}": text for part, text in parts.items()}
    return {"what": "drag", "changes": changes, "gesture": gesture}


def test_a_drag_is_one_step_and_the_newest_of_those_that_wait_is_taken(tab):
    before = tab.toml
    said = tab.send(*(drag(_0=f"{40 + n} mm", _1=f"{n} mm") for n in range(1, 30)))
    assert [message["fields"]["bodies.crank.points.A"]["text"] for message in only(said, "values")] == ["69 mm, 29 mm"]
    tab.send(drag(_0="45 mm", _1="1 mm"))
    assert "45 mm" in tab.toml
    tab.say("undo")
    assert tab.toml == before


def test_what_a_hand_moves_is_drawn_quickly(tab):
    tab.quiet.asked.clear()
    tab.send(drag(_0="45 mm"))
    tab.say("set", key="drive.speed", text="99 rpm", gesture="slider")
    tab.say("set", key="drive.speed", text="98 rpm")
    tab.say("revert", gesture="g")
    assert [moving for name, _, _, moving in tab.quiet.asked if name == "update"] == [True, True, False, False]


def test_a_tab_that_goes_under_a_hand_is_told_no_more(tab):
    tab.heard.clear()

    async def leaving():
        tab.session.receive(drag(_0="45 mm"))
        await tab.session._inbox.work
        tab.session.close()
        await asyncio.sleep(2 * PACE)

    loops.run(leaving())
    assert not tab.heard


def test_a_drag_that_is_taken_back_leaves_no_step(tab):
    before = tab.toml
    for _ in range(2):
        tab.send(drag(_0="45 mm"))
        tab.send(drag(_0="46 mm"))
        (said,) = tab.say("revert", gesture="g")
        assert tab.toml == before and not said["undo"] and said["fields"]["bodies.crank.points.A"]["parts"][0]["value"] == 40


def test_only_the_drag_under_way_can_be_taken_back(tab):
    tab.send(drag("first", _0="45 mm"))
    tab.say("set", key="drive.speed", text="99 rpm")
    after = tab.toml
    for gesture in ("first", "other", ""):
        (said,) = tab.say("revert", gesture=gesture)
        assert tab.toml == after and said["undo"]
    tab.say("undo")
    assert "45 mm" in tab.toml and "99 rpm" not in tab.toml


def test_a_locked_point_is_not_dragged(tab):
    tab.say("lock", key="bodies.crank.points.A", on=True)
    before = tab.toml
    (refused,) = tab.send(drag(_0="45 mm", _1="3 mm"))
    assert refused["what"] == "refused" and "is locked" in refused["message"] and tab.toml == before


# -- odd pages -----------------------------------------------------------------------------------------------------------------


ODD = ({}, [], None, "set", {"what": ["set"]}, {"what": None}, {"what": "close"}, {"what": "_open"}, {"what": "__init__"})


@pytest.mark.parametrize("message", ODD)
def test_what_is_no_request_is_nothing(tab, message):
    before = tab.toml
    assert tab.send(message) == [] and tab.toml == before


@pytest.mark.parametrize(
    "message",
    [
        {"what": "set"},
        {"what": "set", "key": None, "text": None},
        {"what": "set", "key": "drive.speed", "text": "1 rpm", "more": 1},
        {"what": "load", "changes": 3},
        {"what": "construct", "tool": "pin", "places": [[0, 0]] * 51, "near": 0.001},
        {"what": "construct", "tool": "pin", "places": [[0]], "near": 0.001},
        {"what": "construct", "tool": "pin", "places": [[0, 0]], "near": "x"},
        {"what": "construct", "tool": "_delete", "places": [[0, 0]], "near": 0.001},
        {"what": "drag", "changes": 3, "gesture": "g"},
        {"what": "drag", "changes": ["drive.speed"], "gesture": "g"},
        {"what": "drag", "changes": {"drive.speed": "9 rpm"}},
        {"what": "drag", "changes": {"drive.speed": ["9 rpm"]}, "gesture": "g"},
        {"what": "drag", "changes": {"drive.speed": "9 rpm", "drive.none": "1 mm"}, "gesture": "g"},
        {"what": "drag", "changes": {"k" * 501: "1 mm"}, "gesture": "g"},
        {"what": "drag", "changes": {f"joints.{n}.name": "1 mm" for n in range(17)}, "gesture": "g"},
        {"what": "drag", "changes": {"mechanism": "cam"}, "gesture": "g"},
        {"what": "revert"},
        {"what": "revert", "gesture": "g", "key": "drive.speed"},
        {"what": "open", "files": 3},
        {"what": "drop", "list": "joints", "index": "x"},
        {"what": "job", "name": "rm"},
        {"what": "job", "name": "study", "options": {"folder": "/tmp/x"}},
        {"what": "drop", "list": "joints", "index": 1e999},
        {"what": "job", "name": "optimise", "options": {"on": "tcp://127.0.0.1:1"}},
        {"what": "text", "toml": "[a" + ".a" * 3000 + "]"},
        {"what": "open", "files": [{"name": "x" * 300 + "/../" + "y" * 400 + ".toml", "text": "format = 1"}]},
        {"what": "put", "table": "x.y"},
        {"what": "fresh", "kind": "../x"},
        {"what": "example", "name": "../oscillating_cam"},
        {"what": "example", "name": "/etc/passwd"},
        {"what": "example", "name": ["disc_cam"]},
        {"what": "example"},
        {"what": "propose", "more": 1},
        {"what": "begin"},
        {"what": "begin", "name": "optimise"},
        {"what": "begin", "name": "rm", "table": {}},
        {"what": "begin", "name": ["study"], "table": {}},
        {"what": "begin", "name": "study", "table": [1]},
        {"what": "begin", "name": "study", "table": {"points": "/etc/passwd"}},
        {"what": "begin", "name": "study", "table": {"vary": [{"key": "torques.load.file", "values": ["/etc/passwd"], "also": ["x"]}]}},
        {"what": "begin", "name": "study", "table": {"vary": [{"key": ["x"], "lower": {}, "steps": "9" * 5000}]}},
        {"what": "begin", "name": "optimise", "table": {"settings": [{"key": "torques.load.file", "value": "/etc/passwd"}]}},
        {"what": "begin", "name": "optimise", "table": {"unknowns": 3, "objectives": None}},
        {"what": "job", "name": "fix", "options": {"seconds": 1e9}},
        {"what": "job", "name": "fix", "options": {"check": {}}},
        {"what": "job", "name": "fix", "options": {"check": "x", "longer": 1e9}},
        {"what": "job", "name": "fix", "options": {"check": "x", "locks": []}},
        {"what": "job", "name": "fix", "options": {"check": "x", "held": ["a"], "tried": 1}},
        {"what": "job", "name": "optimise", "options": {"locks": []}},
        {"what": "job", "name": "figures", "options": {"analyses": "statics"}},
        {"what": "job", "name": "figures", "options": {"analyses": [["statics"]]}},
        {"what": "job", "name": "figures", "options": {"everything": True}},
        {"what": "job", "name": "figures", "options": {"kept": "/tmp"}},
        {"what": "job", "name": "figures", "options": ["theme"]},
        {"what": "job", "name": "fields", "options": {"analysis": 3}},
        {"what": "job", "name": "fields", "options": {"analysis": "x", "run": "yes"}},
        {"what": "job", "name": "report", "options": {"whole": []}},
        {"what": "job", "name": {"fix": 1}},
        {"what": "job", "name": "timing", "options": {"analyses": "x"}},
    ],
)
def test_an_odd_request_is_answered_and_changes_nothing(tab, message):
    before = tab.toml
    (refused,) = tab.say(**message)
    assert refused["what"] == "refused" and refused["message"]
    assert tab.toml == before


def refusal(tab, message):
    return next((each["message"] for each in tab.say(**message) if each["what"] == "refused"), "")


@pytest.mark.parametrize(
    ("message", "most", "words"),
    [
        (lambda n: {"what": "drag", "changes": {f"joints.{k}.name": "x" for k in range(n)}, "gesture": "g"}, 16, "at most 16 keys at once"),
        (
            lambda n: {"what": "construct", "tool": "body", "places": [[k, 0] for k in range(n)], "near": 0.001},
            50,
            "at most 50 places at once",
        ),
        (lambda n: {"what": "set", "key": "k" * n, "text": "1"}, 500, "a key has at most 500 characters"),
    ],
)
def test_a_message_has_limits_of_its_own(tab, message, most, words):
    """What keeps within them is refused in other words here, if at all."""
    assert words in refusal(tab, message(most + 1)) and words not in refusal(tab, message(most))


def test_what_is_said_again_about_building_changes_nothing(tab):
    """A page that says twice that it builds, or that it does not, has nothing drawn anew."""
    tab.quiet.building = False
    assert tab.say("sketch", on=False) == [] and tab.say("sketch", on=True) and tab.say("sketch", on=True) == []


@pytest.mark.parametrize(("length", "elsewhere"), [(100, False), (SHORT, True)])
def test_a_long_message_is_read_in_another_process(tab, length, elsewhere):
    """A short one by the loop itself: taking it apart costs less than handing it on."""
    called, call = [], tab.session._call

    async def noted(function, *arguments):
        called.append(function.__name__)
        return await call(function, *arguments)

    async def reading():
        tab.session.read(json.dumps({"what": "set", "key": "title", "text": "x" * length}))
        await tab.session._inbox.work

    tab.session._call = noted
    loops.run(reading())
    assert ("read_message" in called) == elsewhere and called[-1] == "edit"


def test_a_refusal_repeats_no_more_than_a_page_shows(tab):
    (refused,) = tab.say("set", key="drive.speed", text="x" * 30_000)
    assert len(refused["text"]) == 20_000 and refused["key"] == "drive.speed"


def test_a_search_cannot_name_a_file(tab):
    text = tab.toml + '[[optimise.settings]]\nkey = "torques.load.file"\nvalue = "/etc/passwd"\n'
    text += '[[optimise.unknowns]]\nkey = "drive.speed"\nlower = "1 rpm"\nupper = "2 rpm"\n[[optimise.objectives]]\nvalue = "x"\n'
    (design,) = tab.say("text", toml=text)[:1]
    with pytest.raises(SpecError, match="is a data file, which a search cannot change") as caught:
        JOBS["optimise"](tab.session.document.design, lambda *news: None)
    assert caught.value.key == "optimise.settings.0.key"


def test_text_of_another_kind_is_another_drive(tab):
    first = tab.session.document.design.kind
    tab.say("job", name="sensitivity", options={})
    (design,) = tab.say("text", toml=(EXAMPLES / "disc_cam.toml").read_text(encoding="utf-8"))
    assert design["opened"] and design["kind"] != first and design["settled"] == ["*"]
    assert tab.quiet.asked[-3:-1] == [("reset", tab.session.gen), ("cancel_all",)]
    (back,) = tab.say("undo")
    assert back["opened"] and back["kind"] == first


def test_jobs_get_the_locks(tab):
    tab.say("lock", key="drive.speed", on=True)
    tab.say("job", name="sensitivity", options={})
    assert tab.quiet.asked[-1] == ("begin", "sensitivity", 1, tab.session.document.design, {"locks": ["drive.speed"]})
    (refused,) = tab.say("set", key="drive.speed", text="1 rpm")
    assert "lock" in refused["message"]


def test_a_search_is_written_and_begun_in_one_message_and_one_step(tab):
    (proposals,) = tab.say("propose")
    crank = next(each for each in proposals["keys"] if each["key"] == "drive.speed")
    unknowns = [{name: crank[name] for name in ("key", "lower", "upper")}]
    table = {"unknowns": unknowns, "objectives": [{"value": "mobility", "goal": "maximise"}]}
    before = tab.toml
    (design,) = tab.say("begin", name="optimise", table=table, options={"theme": "dark"})
    assert "[optimise]" in design["toml"] or "[[optimise.unknowns]]" in design["toml"]
    assert tab.quiet.asked[-1] == ("begin", "optimise", 2, tab.session.document.design, {"theme": "dark", "locks": []})
    tab.say("undo")
    assert tab.toml == before and not tab.session.document.can_undo


def test_a_job_that_is_refused_writes_no_table(tab):
    before, table = tab.toml, {"vary": [{"key": "drive.speed", "lower": "90 rpm", "upper": "99 rpm", "steps": 2}]}
    for options in ({"folder": "/tmp/x"}, {"theme": 3}, [1], {"workers": 99}):
        (refused,) = tab.say("begin", name="study", table=table, options=options)
        assert refused["what"] == "refused" and tab.toml == before
    assert not tab.session.document.can_undo


def test_a_table_that_is_refused_begins_nothing(tab):
    asked = len(tab.quiet.asked)
    (refused,) = tab.say("begin", name="study", table={"vary": [{"key": "drive.speed", "lower": "1 rpm", "upper": "2 rpm", "steps": "-1"}]})
    assert refused["key"] == "study.vary.0.steps" and len(tab.quiet.asked) == asked


def test_other_jobs_do_not(tab):
    tab.say("lock", key="drive.speed", on=True)
    tab.say("export", format="dxf")
    assert tab.quiet.asked[-1] == ("begin", "export", 1, tab.session.document.design, {"format": "dxf", "anyway": False})
    tab.say("lock", key="drive.speed", on=False)
    assert only(tab.say("set", key="drive.speed", text="1 rpm"), "values")


def test_what_is_saved_is_no_change_any_more(tab):
    assert tab.say("set", key="drive.speed", text="150")[0]["changed"]
    (values,) = tab.say("save")
    assert not values["changed"] and tab.quiet.asked[-1][:2] == ("begin", "save")


@pytest.mark.parametrize(("name", "asked"), [("look", ("cancel",)), ("study", ("cancel", "study"))])
def test_what_is_cancelled_is_the_look_of_the_design_or_a_job_and_waits_for_nothing(tab, name, asked):
    tab.quiet.asked.clear()
    tab.session.receive({"what": "cancel", "name": name})
    assert tab.quiet.asked == [asked]


def test_a_tab_that_closes_ends_its_computations_and_its_jobs(tab):
    tab.quiet.asked.clear()
    tab.session.close()
    assert tab.quiet.asked == [("close",), ("cancel_all",)]


def test_after_a_lost_connection_everything_comes_once_more(tab):
    (design,) = tab.say("again")
    assert design["what"] == "design" and design["form"]["groups"] and design["gen"] == 2
    assert tab.quiet.asked[-1][:2] == ("update", 2)


def test_another_kind_forgets_what_was_computed(tab):
    other = next(kind["kind"] for kind in only(tab.say("hello"), "start")[0]["kinds"] if kind["kind"] != tab.session.document.design.kind)
    (design,) = tab.say("fresh", kind=other)
    assert design["kind"] == other and design["undo"] and not design["redo"]
    assert tab.quiet.asked[-3:-1] == [("reset", tab.session.gen), ("cancel_all",)]


def test_opening_another_design_loses_nothing(tab):
    """A step back brings what was open, with its changes and its past, and a step forward the other one; its data files are there again."""
    first = tab.session.document.design.kind
    before = tab.session.document.design.text()
    other = "linkage" if first != "linkage" else "cam"
    tab.say("set", key="title", text="changed, and in no file yet")
    mine = tab.session.document.design.text()
    tab.say("fresh", kind=other)
    tab.say("example", name="valve_train")  # which has a data file
    files = tab.session.files
    assert files and tab.session.document.design.spec().data_files()
    (back,) = tab.say("undo")
    assert (back["kind"], back["files"]) == (other, "") and back["redo"]
    (back,) = tab.say("undo")
    assert back["kind"] == first and tab.session.document.design.text() == mine != before
    tab.say("undo")
    assert tab.session.document.design.text() == before and not tab.session.document.can_undo
    for _ in range(3):
        (last,) = tab.say("redo")
    assert last["files"] == files and tab.session.document.design.spec().data_files()


def test_an_offered_file_is_fetched_once(resources):
    address = resources.offer("../a b.dxf", b"0\nEOF")
    token = address.rpartition("/")[2]
    assert resources.fetch(token) == ("a-b.dxf", b"0\nEOF")
    assert resources.fetch(token) is None and resources.folder("nobody") is None and resources.folder(["x"]) is None


def test_the_first_design_is_one():
    first_design().spec()


def test_files_wait_for_a_while_and_some_at_a_time(resources, monkeypatch):
    now = 0.0
    monkeypatch.setattr("drivewright.studio.resources.time.monotonic", lambda: now)
    first = resources.offer("a", b"a").rpartition("/")[2]
    now = KEPT - 1
    second = resources.offer("b", b"b").rpartition("/")[2]
    assert resources.fetch(first) == ("a", b"a")
    now = 2 * KEPT
    resources.offer("c", b"c")
    assert resources.fetch(second) is None
    tokens = [resources.offer("d", b"d").rpartition("/")[2] for _ in range(MOST_OFFERS + 1)]
    assert resources.fetch(tokens[0]) is None and resources.fetch(tokens[1]) == resources.fetch(tokens[-1]) == ("d", b"d")


def test_the_oldest_folder_goes_and_all_of_them_at_the_end(resources, monkeypatch, tmp_path):
    monkeypatch.setattr("drivewright.studio.resources.TABS_FILES", 2)
    (first, place), (second, _), (third, _) = (resources.new_folder() for _ in range(3))
    assert resources.folder(first) is None and not place.exists()
    assert all(resources.folder(token).is_dir() for token in (second, third))
    resources.close()
    assert not list(tmp_path.glob("drivewright-studio-*"))


def test_a_spec_of_this_machine_may_read_the_tables_beside_it_only(tmp_path):
    for name in ("four_bar.toml", "lift.csv"):
        shutil.copy(EXAMPLES / name, tmp_path)
    (tmp_path / "secret.txt").write_text("x")
    assert opened(tmp_path / "four_bar.toml").readable == {tmp_path / "lift.csv"}
