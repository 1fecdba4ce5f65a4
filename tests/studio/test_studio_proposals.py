"""Searches and studies without text: what the forms propose, the tables that they write, and the change that corrects a failed check."""

import tomllib

import pytest
from places import EXAMPLES

from drivewright import registry, runner
from drivewright.errors import DrivewrightError, InputError, SpecError, UnknownName
from drivewright.studio.design import Design
from drivewright.studio.document import Document
from drivewright.studio.jobs import JOBS, fix
from drivewright.studio.proposals import LONGEST, _ends, propose, search_table

pytestmark = pytest.mark.interface

UNKNOWNS = [{"key": "follower.prime_radius", "lower": "30", "upper": "60 mm"}]
WRITTEN = [{"key": "follower.prime_radius", "lower": "30 mm", "upper": "60 mm"}]
OBJECTIVES = [{"value": "profile.max_radius", "goal": "minimise"}]


def quiet(*news):
    """A progress that nobody looks at."""


def cam(**changes):
    tables = tomllib.loads((EXAMPLES / "disc_cam.toml").read_text(encoding="utf-8"))
    return Design(tables, EXAMPLES).changed({key.replace("__", "."): value for key, value in changes.items()})


def proposed(design, locks=()):
    found = propose(None, design, locks)
    return {each["key"]: each for each in found["keys"]}, found


# -- what is proposed ----------------------------------------------------------------------------------------------------------


def test_every_number_that_may_vary_is_proposed_with_bounds_around_it():
    keys, found = proposed(cam(), ["spring.preload"])
    radius = keys["follower.prime_radius"]
    assert (radius["text"], radius["lower"], radius["upper"]) == ("40 mm", "20 mm", "80 mm")
    assert radius["label"] == "follower · prime radius" and radius["usual"] and not radius["locked"]
    assert keys["spring.preload"]["locked"] and not keys["drive.speed"]["usual"]
    assert keys["programme.0.rise"]["lower"] == "10 mm" and keys["vibration.damping_ratio"]["kind"] == "number"
    assert keys["rotation"]["choices"] == ["counter-clockwise", "clockwise"]
    assert not {"title", "format", "mechanism"} & set(keys)
    usual = [each["usual"] for each in found["keys"]]
    assert usual == sorted(usual, reverse=True)  # what the kind calls adjustable comes first
    assert found["optimise"] is None and found["study"] is None


@pytest.mark.parametrize("name", ["disc_cam", "four_bar", "hyvo_chain", "seedling_pusher", "pin_indexer", "pressure_roller_shaft"])
def test_what_is_proposed_can_be_searched(name):
    """Every bound is a value of its key, the lower one below the upper one, and a table of all of them is a spec."""
    path = EXAMPLES / f"{name}.toml"
    document = Document(Design(tomllib.loads(path.read_text(encoding="utf-8")), EXAMPLES))
    keys, _ = proposed(document.design)
    numbers = [each for each in keys.values() if each["kind"] not in ("choice", "flag")]
    assert len(numbers) >= 5
    unknowns = [{name: each[name] for name in ("key", "lower", "upper")} for each in numbers]
    document.write("optimise", {"unknowns": unknowns, "objectives": OBJECTIVES})
    from drivewright.studies.search.problem import _bounds, _kind

    spec = document.design.spec()
    for number, unknown in enumerate(spec.optimise.unknowns):
        low, high = _bounds(_kind(spec, spec.optimise.unknowns, number), unknown, "here")
        assert low < high, unknown


@pytest.mark.parametrize(
    ("value", "slider", "ends"),
    [
        (3.0, None, ("1.5 mm", "6 mm")),
        (-3.0, None, ("-6 mm", "-1.5 mm")),  # the lower end comes first
        (3.0, [2.25, 3.5], ("2.25 mm", "3.5 mm")),
        ("rigid", None, ("", "")),
    ],
)
def test_bounds_are_the_ends_of_the_slider_or_half_and_twice_the_value(value, slider, ends):
    assert _ends({"kind": "quantity", "value": value, "slider": slider, "unit": "mm"}) == ends


def test_bounds_of_what_has_no_unit_are_plain_and_choices_have_none():
    assert _ends({"kind": "integer", "value": 8, "slider": None, "unit": ""}) == ("4", "16")
    assert _ends({"kind": "flag", "value": True, "slider": [0, 1], "unit": ""}) == ("", "")


def test_a_choice_that_the_design_leaves_open_is_not_proposed():
    """It has no value around which it could vary; as soon as it is stated it may."""
    keys, _ = proposed(cam())
    assert "follower.lift_at" not in keys and "rotation" in keys
    valve, _ = proposed(Design(tomllib.loads((EXAMPLES / "valve_train.toml").read_text(encoding="utf-8")), EXAMPLES))
    assert valve["follower.lift_at"]["choices"] == ["arm", "tip", "valve"]


# -- what is written -----------------------------------------------------------------------------------------------------------


def test_a_search_is_written_in_one_step_and_runs():
    document = Document(cam())
    requirements = [{"value": "check.pressure_angle"}, {"value": "max_contact_force", "at_most": "300 N"}]
    document.write(
        "optimise", {"unknowns": UNKNOWNS, "objectives": OBJECTIVES, "requirements": requirements, "method": "auto", "generations": "2"}
    )
    table = document.design.tables["optimise"]
    assert table["unknowns"] == [
        {"key": "follower.prime_radius", "lower": "30 mm", "upper": "60 mm"}
    ]  # a bare number has the unit of its key
    assert table["generations"] == 2 and table["requirements"] == requirements
    answer = JOBS["optimise"](document.design, quiet, on="serial")
    assert answer["feasible"] and set(answer["changes"]) == {"follower.prime_radius"}
    document.undo()
    assert "optimise" not in document.design.tables and not document.can_undo


def test_what_the_form_does_not_show_stays():
    document = Document(
        cam(
            optimise__seed=7,
            optimise__unknowns=WRITTEN,
            optimise__objectives=OBJECTIVES,
            optimise__settings=[{"key": "drive.speed", "value": "500 rpm"}],
        )
    )
    document.write("optimise", {"unknowns": UNKNOWNS, "objectives": OBJECTIVES, "requirements": [], "method": "nsga2"})
    table = document.design.tables["optimise"]
    assert table["seed"] == 7 and table["settings"] and table["method"] == "nsga2" and "requirements" not in table


def test_a_study_of_levels_values_and_tolerances_is_written_and_runs():
    document = Document(cam())
    levels = {"key": "follower.prime_radius", "lower": "36", "upper": "44", "steps": "2"}
    listed, spread = (
        {"key": "drive.speed", "values": ["500", "600 rpm"]},
        {"key": "spring.preload", "tolerance": "5 %", "distribution": "normal"},
    )
    document.write("study", {"vary": [levels, listed, spread], "samples": "3", "method": "random", "values": ["max_contact_force"]})
    assert (
        document.design.tables["study"]["vary"][0]["lower"] == "36 mm"
        and document.design.tables["study"]["vary"][1]["values"][0] == "500 rpm"
    )
    answer = JOBS["study"](document.design, quiet, on="serial")
    assert len(answer["rows"]) == answer["total"] == 2 * 2 * 3 and answer["failed"] == 0
    document.load(answer["load"][-1])
    assert document.design.tables["follower"]["prime_radius"] == "44 mm"


def test_an_entry_that_the_form_cannot_show_stays_as_written():
    entry = {"key": "follower.prime_radius", "distribution": "triangular", "lower": "30 mm", "upper": "50 mm", "mode": "41 mm"}
    document = Document(cam(study__vary=[entry]))
    document.write("study", {"vary": [{"key": "follower.prime_radius", "as_written": True}, {"key": "drive.speed", "values": ["500 rpm"]}]})
    assert document.design.tables["study"]["vary"][0] == entry and len(document.design.tables["study"]["vary"]) == 2


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("study", {"points": "/etc/passwd"}, "has no 'points'"),
        ("optimise", {"settings": []}, "has no 'settings'"),
        ("study", {"vary": [{"key": "drive.speed", "points": "x"}]}, "that no page sends"),
        ("study", {"vary": [3]}, "that no page sends"),
        ("study", {"vary": "drive.speed"}, "must be a list"),
        ("study", {"vary": [{"key": "drive.speed"}] * 1001}, "at most 1000"),
        ("study", {"vary": [{"key": "follower.offset", "as_written": True}]}, "is not in the table"),
        ("study", {"samples": "many"}, "wants a whole number"),
        ("optimise", {"unknowns": UNKNOWNS, "objectives": []}, "objectives"),
        ("optimise", {"unknowns": UNKNOWNS, "objectives": OBJECTIVES, "generations": -1}, "at least 1"),
    ],
)
def test_what_no_form_says_is_refused_and_changes_nothing(name, content, words):
    document = Document(cam())
    before = document.design
    with pytest.raises(DrivewrightError, match=words):
        document.write(name, content)
    assert document.design is before


def test_the_texts_of_an_entry_have_a_limit():
    def written(length):
        return search_table(cam(), "optimise", {"objectives": [{"value": "v" * length, "goal": "minimise"}]})

    assert len(written(LONGEST)["objectives"][0]["value"]) == LONGEST == 500
    with pytest.raises(InputError, match=r"optimise\.objectives\.0 has a text of more than 500 characters"):
        written(LONGEST + 1)


@pytest.mark.parametrize(("typed", "read"), [("0.5", 0.5), ("-3", -3), ("300 N", "300 N"), ("5 %", "5 %")])
def test_a_limit_without_a_unit_is_a_number(typed, read):
    needs = [{"value": "max_contact_force", "at_most": typed, "at_least": typed}]
    (need,) = search_table(cam(), "optimise", {"requirements": needs})["requirements"]
    for side in ("at_most", "at_least"):
        assert need[side] == read and isinstance(need[side], type(read))


@pytest.mark.parametrize(("typed", "read"), [("5 %", "5 %"), ("5%", "5%"), ("5", "5 N"), ("0.02 kN", "0.02 kN")])
def test_a_tolerance_is_a_part_of_the_value_or_has_the_unit_of_its_key(typed, read):
    entry = {"key": "spring.preload", "tolerance": typed, "distribution": "normal"}
    assert search_table(cam(), "study", {"vary": [entry]})["vary"] == [{**entry, "tolerance": read}]


def test_a_locked_bound_stays():
    document = Document(cam(optimise__unknowns=WRITTEN, optimise__objectives=OBJECTIVES))
    document.lock("optimise.unknowns.0.lower", True)
    with pytest.raises(SpecError, match="is locked"):
        document.write("optimise", {"unknowns": [{**UNKNOWNS[0], "lower": "35 mm"}], "objectives": OBJECTIVES})


# -- what corrects a failed check ----------------------------------------------------------------------------------------------


def test_the_change_that_is_proposed_makes_the_check_pass():
    design = cam(follower__prime_radius="24 mm")
    news = []
    found = fix.fix(design, lambda *told: news.append(told), check="pressure_angle")
    (change,) = found["changes"]
    assert change["key"] == "follower.prime_radius" and change["before"] == "24\u00a0mm" and not found["reason"] and not found["then_fails"]
    assert runner.run(design.changed(found["load"]).spec()).check("pressure_angle").ok
    assert any("is being computed" in text for *_, text in news)


def test_what_is_locked_is_not_changed():
    design = cam(follower__prime_radius="24 mm")
    found = fix.fix(design, quiet, check="pressure_angle", locks=["follower"])
    assert not found["load"] and found["reason"].startswith("no change of one or two dimensions")
    keys = [key.partition(".")[0] for key in registry.mechanism("cam").adjustable]
    assert fix.fix(design, quiet, check="pressure_angle", locks=keys)["reason"] == "no dimension that may change is free; unlock one"


def test_a_correction_goes_beyond_the_unknowns_of_a_search():
    search = {"optimise__unknowns": [{"key": "spring.preload", "lower": "20 N", "upper": "60 N"}], "optimise__objectives": OBJECTIVES}
    found = fix.fix(cam(follower__prime_radius="24 mm", **search), quiet, check="pressure_angle")
    assert [change["key"] for change in found["changes"]] == ["follower.prime_radius"] and not found["reason"]


def test_a_search_of_segment_angles_frees_the_last_dwell():
    document = Document(cam())
    unknowns = [{"key": f"programme.{n}.angle", "lower": "60 deg", "upper": "160 deg"} for n in (0, 1)]
    document.write("optimise", {"unknowns": unknowns, "objectives": OBJECTIVES})
    assert ["angle" in segment for segment in document.design.tables["programme"]] == [True, True, False]
    assert document.design.spec().programme[2].angle is None


def test_time_that_ran_out_is_said(monkeypatch):
    monkeypatch.setattr(fix, "PATIENCE", -1.0)
    found = fix.fix(cam(follower__prime_radius="24 mm"), quiet, check="pressure_angle")
    assert found["stopped"] and found["reason"].startswith("no change was found within") and not found["load"]


def test_only_a_check_that_fails_is_corrected():
    with pytest.raises(UnknownName, match="check"):
        fix.fix(cam(), quiet, check="no such check")
    with pytest.raises(InputError, match="passes, so there is nothing to change"):
        fix.fix(cam(), quiet, check="pressure_angle")
