"""Keys that follow another one by a relation: grammar, columns, one axis, errors that name key and place, the same on every route."""

import math
from pathlib import Path

import numpy as np
import pytest
from study_toy import Body, Part, Toy, install

import drivewright as dw
from drivewright.errors import InputError, SpecError
from drivewright.studies import linked
from drivewright.studies.answers import analyse_study
from drivewright.studies.plan import make_plan
from drivewright.studies.relations import Relation, relation
from drivewright.studies.variation import linspace, normal, parse_variation, tolerance, uniform, with_options, with_variation

pytestmark = pytest.mark.property

SPEC = Toy(parts=(Part(name="left", width="4 mm"), Part(name="right", width="6 mm")), bodies={"arm": Body(mass="2 kg")})

GEARS = """
mechanism = "shaft"
[[segments]]
length = "200 mm"
diameter = "25 mm"
[[bearings]]
name = "A"
position = "10 mm"
radial_stiffness = "1e8 N/m"
axial_stiffness = "1e8 N/m"
[[bearings]]
name = "B"
position = "190 mm"
radial_stiffness = "1e8 N/m"
[[gears]]
name = "pinion"
position = "70 mm"
pitch_diameter = "40 mm"
torque = "30 N m"
[[gears]]
name = "wheel"
position = "140 mm"
pitch_diameter = "80 mm"
torque = "-30 N m"
mesh_angle = "90 deg"
[study]
analyses = ["statics"]
"""


def columns(vary, spec=SPEC, **settings):
    plan = make_plan(with_variation(spec, vary, **settings))
    return plan, plan.cases(0, len(plan))


@pytest.fixture
def gears(tmp_path):
    (tmp_path / "gears.toml").write_text(GEARS)
    return dw.load(tmp_path / "gears.toml")


# -- what a relation says --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("size", Relation(1.0, "size")),
        ("-size", Relation(-1.0, "size")),
        ("- size", Relation(-1.0, "size")),
        ("+ 3 * size", Relation(3.0, "size")),
        ("-2 * gears.pinion.torque", Relation(-2.0, "gears.pinion.torque")),
        ("-.5e-1*loads.0.force", Relation(-0.05, "loads.0.force")),
        ("0.5 * segments.0.length + 3 mm", Relation(0.5, "segments.0.length", "3 mm")),
        ("size - 3 mm", Relation(1.0, "size", "-3 mm")),
        ("-2 * ratio -.5", Relation(-2.0, "ratio", "-.5")),
        ("1 * joints.A-B.clearance + 1 um", Relation(1.0, "joints.A-B.clearance", "1 um")),
        ("2 * a.b-3", Relation(2.0, "a.b-3")),
    ],
)
def test_the_grammar(text, wanted):
    assert relation(text) == wanted


@pytest.mark.parametrize(
    "text", ["", "5", "5 N*m", "2 size", "2 * 3", "size * 2", "size+3 mm", "a.b-3 mm", "(size)", "2 * size + ", "a b", "3 mm + size"]
)
def test_what_is_no_relation(text):
    assert relation(text) is None


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("gears.b.torque = -2 * gears.a.torque", ("gears.b.torque", {"link": "-2 * gears.a.torque"})),
        ("b=-a.width", ("b", {"link": "-a.width"})),
        ("b = 0.5 * a + 3 mm", ("b", {"link": "0.5 * a + 3 mm"})),
        ("b = a - 3 mm", ("b", {"link": "a - 3 mm"})),
        ("law = cycloid", ("law", ["cycloid"])),
        ("a = -3 mm, 4 mm", ("a", ["-3 mm", "4 mm"])),
        ("a + -b = 1 mm:2 mm:3", ("a + -b", {"lower": "1 mm", "upper": "2 mm", "steps": 3})),
        ("a = +-3 mm", ("a", {"distribution": "normal", "tolerance": "3 mm"})),
    ],
)
def test_on_the_command_line(text, wanted):
    assert parse_variation(text) == wanted


def test_a_single_word_is_a_key_where_a_key_of_numbers_follows_it_and_a_level_where_texts_vary():
    spec = with_options(SPEC, ["size=8 mm,9 mm", "offset = size", "colour = size", "count = 4"])
    assert [(each.key, each.link, each.values) for each in spec.study.vary] == [
        ("size", None, ("8 mm", "9 mm")),
        ("offset", "size", ()),
        ("colour", None, ("size",)),
        ("count", None, (4,)),
    ]


# -- the cases -----------------------------------------------------------------------------------------------------------------


def test_a_linked_key_has_its_own_column_and_no_axis_of_its_own():
    plan, cases = columns(
        {"count": [1, 2], "size": ["8 mm", "10 mm"], "offset": linked("-2 * size + 3 mm"), "parts.left.width": linked("0.5*size")}
    )
    assert plan.keys == ("count", "size", "offset", "parts.left.width") and plan.shape == (2, 2) and len(plan) == 4
    assert cases["size"].tolist() == [8e-3, 10e-3, 8e-3, 10e-3]
    assert cases["offset"] == pytest.approx([-13e-3, -17e-3, -13e-3, -17e-3], rel=1e-14)
    assert cases["parts.left.width"] == pytest.approx([4e-3, 5e-3, 4e-3, 5e-3], rel=1e-14)


def test_a_minus_makes_the_negative():
    plan, cases = columns({"size + -offset + parts.left.width": linspace("1 mm", "3 mm", 3)})
    assert plan.keys == ("size", "offset", "parts.left.width") and plan.shape == (3,)
    assert np.array_equal(cases["offset"], -cases["size"]) and np.array_equal(cases["parts.left.width"], cases["size"])


def test_random_keys_are_followed_in_every_block():
    vary = {"size": normal("10 mm", "1 mm"), "force": tolerance("0.2 N"), "offset": linked("3 * size - 1 mm")}
    plan, cases = columns(vary, method="tolerance", samples=20)
    assert plan.points.shape == (1 + 4 + 4 + 20, 2) and [each.name for each in plan.blocks] == ["nominal", "steps", "corners", "sample"]
    assert cases["offset"] == pytest.approx(3 * cases["size"] - 1e-3, rel=1e-13) and np.ptp(cases["offset"]) > 10e-3


def test_a_key_that_does_not_vary_is_followed_at_its_value_in_the_spec():
    plan, cases = columns({"size": ["8 mm", "9 mm"], "parts.right.width": linked("2 * parts.left.width + 1 mm")})
    assert plan.keys == ("size", "parts.left.width", "parts.right.width") and len(plan) == 2
    assert cases["parts.left.width"].tolist() == [4e-3, 4e-3] and cases["parts.right.width"] == pytest.approx([9e-3, 9e-3], rel=1e-14)


def test_list_elements_go_by_name_or_number():
    _, cases = columns({"parts.0.width": ["1 mm", "2 mm"], "parts.right.width": linked("2 * parts.left.width")})
    assert cases["parts.right.width"] == pytest.approx([2e-3, 4e-3], rel=1e-14)


def test_whole_numbers_stay_whole():
    _, cases = columns({"count": [1, 2, 3], "teeth.0": linked("2 * count + 15"), "ratio": linked("0.5 * count - 0.1")})
    assert cases["teeth.0"].dtype == np.int64 and cases["teeth.0"].tolist() == [17, 19, 21]
    assert cases["ratio"] == pytest.approx([0.4, 0.9, 1.4], rel=1e-14)


def test_columns_of_a_file_are_followed(tmp_path):
    (tmp_path / "p.csv").write_text("size [mm],ratio\n8,0.1\n9,0.4\n7,0.2\n")
    spec = with_options(SPEC, ["offset = 2 * size"], points=tmp_path / "p.csv")
    plan = make_plan(spec)
    assert plan.keys == ("size", "offset", "ratio") and plan.cases(0, 3)["offset"] == pytest.approx([16e-3, 18e-3, 14e-3], rel=1e-14)


def test_relations_are_part_of_the_plan():
    vary = {"size": ["1 mm", "2 mm"]}
    plans = [
        columns(vary | {"offset": linked(text)})[0] for text in ("size", "2 * size", "-2 * size", "2 * size + 1 mm", "2 * size - 1 mm")
    ]
    same = columns({"size+offset": ["1 mm", "2 mm"]})[0]
    assert len({plan.digest for plan in plans}) == 5 and columns(vary | {"offset": linked("2*size")})[0].digest == plans[1].digest
    assert same.digest not in {plan.digest for plan in plans[1:]}


def test_a_tie_without_a_relation_keeps_the_digest_of_older_folders():
    import hashlib

    plan, _ = columns({"size+offset": ["1 mm", "2 mm"]})
    known = hashlib.sha256(repr((("size", "offset"), (2,), ())).encode())
    for column in (np.array([1e-3, 2e-3]), np.zeros((1, 0))):
        known.update(column.tobytes())
    assert plan.digest == known.hexdigest()


# -- where the spec says another thing -------------------------------------------------------------------------------------------


def test_the_relation_wins_and_a_remark_says_so():
    plan, _ = columns({"parts.left.width": ["1 mm"], "parts.right.width": linked("2 * parts.left.width")})
    said = plan.remarks[0].replace("\u00a0", " ")
    assert said == (
        "parts.right.width is 6 mm in the spec, where 2 * parts.left.width gives 8 mm; in this study it follows parts.left.width"
    )
    plan, _ = columns({"parts.left.width + parts.right.width": ["1 mm"]})
    assert "is 6 mm in the spec, and parts.left.width is 4 mm; in this" in plan.remarks[0].replace("\u00a0", " ")


@pytest.mark.parametrize("text", ["1.5 * parts.left.width", "parts.left.width + 2 mm", "-parts.left.width + 10 mm"])
def test_no_remark_where_the_spec_agrees(text):
    assert columns({"parts.left.width": ["1 mm"], "parts.right.width": linked(text)})[0].remarks == ()
    assert columns({"size": ["1 mm"], "offset": linked("2 * size")})[0].remarks == ()  # without a value in the spec there is no other


# -- errors --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ({"offset": linked("2 size")}, "study.vary.0.link: must be NUMBER * KEY + QUANTITY, such as"),
        ({"offset": linked("2 * size-3 mm")}, "a minus behind a key needs a blank on its left"),
        ({"ratio": linked("2 * ratio-3")}, "a minus behind a key needs a blank on its left"),
        ({"offset": linked("2 * sise")}, "study.vary.0.link: this spec has no key 'sise' (did you mean 'size'?)"),
        ({"ofset": linked("2 * size")}, "study.vary.0.key: this spec has no key 'ofset'"),
        (
            {"offset": linked("2 * force")},
            "study.vary.0.link: offset takes a length and force a force; a relation is between keys of one kind",
        ),
        ({"ratio": linked("2 * size")}, "ratio takes a number and size a length"),
        ({"count": linked("2 * ratio")}, "count takes whole numbers and ratio does not, so it cannot follow it"),
        ({"colour": linked("-form")}, "study.vary.0.link: colour takes a text; a relation is between numbers"),
        ({"offset": linked("2 * flag")}, "flag takes true or false; a relation is between numbers"),
        ({"offset": linked("0 * size")}, "study.vary.0.link: the factor must be a number other than 0, got 0"),
        ({"offset": linked("1e999 * size")}, "the factor must be a number other than 0, got inf"),
        ({"offset": linked("size + 3")}, "study.vary.0.link: unit missing"),
        ({"offset": linked("size + 3 N")}, "study.vary.0.link: wants a length, got '3 N' (force)"),
        ({"ratio": linked("ratio + 3"), "size": ["1 mm"]}, "ratio cannot follow itself; name another key"),
        ({"parts.0.width": linked("2 * parts.left.width")}, "parts.0.width cannot follow itself"),
        ({"size": linked("2 * offset")}, "study.vary.0.link: offset does not vary and has no value in this spec, so nothing can follow it"),
        (
            {"size": ["1 mm"], "offset": linked("2 * size"), "parts.0.width": linked("2 * offset")},
            "study.vary.2.link: offset follows another",
        ),
        ({"size + offset": ["1 mm"], "parts.0.width": linked("2 * offset")}, "study.vary.1.link: offset follows another key itself"),
        ({"size": ["1 mm"], "offset": linked("2 * size") | {"values": ["1 mm"]}}, "study.vary.1.values: has no meaning beside link"),
        ({"size": ["1 mm"], "offset": linked("2 * size") | {"tolerance": "1 mm"}}, "study.vary.1.tolerance: has no meaning beside link"),
        ({"size": ["1 mm"], "offset + ratio": linked("2 * size")}, "study.vary.1.also: has no meaning beside link"),
        ({"size": ["1 mm"], "parts.0.width": ["2 mm"], "parts.left.width": linked("2 * size")}, "parts.0.width varies twice; give it once"),
        ({"count": [1, 2], "teeth.0": linked("0.5 * count")}, "study.vary.1.link: teeth.0 takes whole numbers, but 0.5 * count gives 0.5"),
        ({"size + -force": ["1 mm"]}, "study.vary.0.also.0: force cannot have the same value as size"),
        ({"colour + -form": ["red"]}, "form cannot have the same value as colour"),
        ({"flag + -flag": [True]}, "study.vary.0.also.0: flag takes true or false, which has no negative; leave out the minus"),
        ({"size + -sise": ["1 mm"]}, "study.vary.0.also.0: this spec has no key 'sise'"),
        ({"size + -size": ["1 mm"]}, "size varies twice; give it once"),
    ],
)
def test_relations_that_are_none(vary, words):
    with pytest.raises(SpecError) as found:
        make_plan(with_variation(SPEC, vary))
    assert words in str(found.value)


def test_a_word_among_levels_has_no_multiple(gears, tmp_path):
    vary = {"bearings.A.radial_stiffness": ["rigid", "1e8 N/m"], "bearings.B.radial_stiffness": linked("2 * bearings.A.radial_stiffness")}
    with pytest.raises(SpecError, match=r"study\.vary\.1\.link: .*takes numbers, but 'rigid' is among the values there"):
        make_plan(with_variation(gears, vary))
    with pytest.raises(SpecError, match=r"study\.vary\.0\.also\.0: .*'rigid'"):
        make_plan(with_variation(gears, {"bearings.A.radial_stiffness + -bearings.B.radial_stiffness": ["rigid"]}))
    fixed = dw.load(tmp_path / "gears.toml", ['bearings.A.radial_stiffness="rigid"'])
    with pytest.raises(SpecError, match="has no finite value in this spec"):
        make_plan(with_variation(fixed, {"bearings.B.radial_stiffness": linked("2 * bearings.A.radial_stiffness")}))


def test_a_sample_size_wants_something_random():
    with pytest.raises(SpecError, match="--sample 5: nothing has a distribution to sample from"):
        with_options(SPEC, ["size=1 mm,2 mm", "offset = 2 * size"], samples=5)


# -- the same numbers ----------------------------------------------------------------------------------------------------------


def by_hand(spec, changes):
    return dw.run(dw.load(spec, changes), "statics")


def test_a_linked_sweep_is_each_case_by_hand(gears, tmp_path):
    vary = {
        "gears.pinion.torque + -gears.wheel.torque": linspace("20 N m", "40 N m", 3),
        "bearings.A.radial_stiffness": ["1e8 N/m", "2e8 N/m"],
        "bearings.B.radial_stiffness": linked("0.5 * bearings.A.radial_stiffness + 1e7 N/m"),
    }
    study = dw.sweep(gears, vary, on="serial")
    assert set(study["status"]) == {"complete"} and study.unit("gears.wheel.torque") == "N m" and len(study) == 6
    for case in range(6):
        torque, stiffness = (20, 30, 40)[case // 2], (1e8, 2e8)[case % 2]
        changes = [
            f'gears.pinion.torque="{torque} N m"',
            f'gears.wheel.torque="-{torque} N m"',
            f'bearings.A.radial_stiffness="{stiffness} N/m"',
            f'bearings.B.radial_stiffness="{0.5 * stiffness + 1e7} N/m"',
        ]
        result = by_hand(tmp_path / "gears.toml", changes)
        assert {name: study[name][case] for name in result.values} == pytest.approx(
            {name: value.value for name, value in result.values.items()}, rel=1e-12, abs=1e-15
        )


def test_forces_are_linear_in_balanced_torques(gears):
    study = dw.sweep(gears, {"gears.pinion.torque + -gears.wheel.torque": ["10 N m", "20 N m"]}, on="serial")
    force = study["bearings.A.radial_force"]
    assert force[1] == pytest.approx(2 * force[0], rel=1e-9) and force[0] > 100


def test_a_table_in_a_file_says_the_same_as_the_command_line(gears, tmp_path):
    text = GEARS + (
        '[[study.vary]]\nkey = "gears.pinion.torque"\nvalues = ["20 N m", "30 N m"]\nalso = ["-gears.wheel.torque"]\n'
        '[[study.vary]]\nkey = "bearings.B.position"\nlink = "bearings.A.position + 150 mm"\n'
    )
    (tmp_path / "all.toml").write_text(text)
    options = ["gears.pinion.torque+-gears.wheel.torque=20 N m,30 N m", "bearings.B.position = bearings.A.position + 150 mm"]
    one, two = make_plan(dw.load(tmp_path / "all.toml")), make_plan(with_options(gears, options))
    assert one.digest == two.digest and one.cases(0, 2)["bearings.B.position"] == pytest.approx([0.16, 0.16])


def test_relations_survive_being_interrupted_and_opened(gears, tmp_path):
    vary = {"gears.pinion.torque": linspace("20 N m", "40 N m", 9), "gears.wheel.torque": linked("-1 * gears.pinion.torque")}
    whole, calls = dw.sweep(gears, vary, on="serial"), []

    def stop(done, total, what):
        calls.append(done)
        if done:
            raise KeyboardInterrupt

    part = dw.sweep(gears, vary, out=tmp_path / "S", on="serial", progress=stop)
    assert part.interrupted and 0 < len(part) < 9
    assert dw.open_study(tmp_path / "S").plan.relations[0].factor == -1
    resumed = dw.sweep(gears, vary, out=tmp_path / "S", on="serial")
    assert resumed.table.equals(whole.table) and dw.open_study(tmp_path / "S").table.equals(whole.table)
    with pytest.raises(InputError, match=r"holds another study.*study\.vary\.1\.link: -1 \* gears\.pinion\.torque there"):
        dw.sweep(gears, vary | {"gears.wheel.torque": linked("-2 * gears.pinion.torque")}, out=tmp_path / "S", on="serial")


def test_processes_give_the_same_bytes(gears):
    vary = {"gears.pinion.torque + -gears.wheel.torque": linspace("20 N m", "40 N m", 5)}
    assert dw.sweep(gears, vary, workers=2).table.equals(dw.sweep(gears, vary, on="serial").table)


@pytest.mark.needs_cluster
@pytest.mark.slow
def test_dask_gives_the_same_bytes(gears):
    vary = {"gears.pinion.torque + -gears.wheel.torque": linspace("20 N m", "40 N m", 5)}
    assert dw.sweep(gears, vary, on="local:2").table.equals(dw.sweep(gears, vary, on="serial").table)


# -- answers -------------------------------------------------------------------------------------------------------------------


def toy(monkeypatch, vary, tmp_path, **settings):
    install(monkeypatch.setattr)
    (tmp_path / "toy.toml").write_text('mechanism = "toy"\n')
    spec = with_variation(dw.load(tmp_path / "toy.toml"), vary, analyses=["main", "more"], **settings)
    return dw.sweep(spec, on="serial")


def test_shares_of_the_variance_count_key_and_followers_as_one_variable(monkeypatch, tmp_path):
    """more = force / size: with the force following the size it is factor + offset / size, and the size causes all of it."""
    vary = {"size": uniform("8 mm", "12 mm"), "bodies.arm.mass": uniform("1 kg", "2 kg"), "offset": linked("2 * size")}
    install(monkeypatch.setattr)
    (tmp_path / "toy.toml").write_text('mechanism = "toy"\n[bodies.arm]\n')
    spec = with_variation(dw.load(tmp_path / "toy.toml"), vary, method="sobol-indices", samples=64)
    study = dw.sweep(spec, on="serial")
    assert len(study) == 64 * (2 + 2) and "offset" in study.table.column_names and "offset" not in study.value_names
    table = next(table for name, table in analyse_study(study).result.tables.items() if "sobol" in name.lower() or "indices" in name)
    keys = {value for column in table.columns for value in column.data.tolist() if isinstance(value, str)}
    assert "size" in keys and "offset" not in keys


def test_the_report_says_what_follows(monkeypatch, tmp_path):
    from drivewright.report.study import varied, write_answers

    study = toy(monkeypatch, {"size": ["8 mm", "9 mm"], "offset": linked("-2 * size  + 3 mm")}, tmp_path)
    assert varied(study.plan.variables[0])[0] == "size, also offset = -2 * size + 3 mm"
    page = write_answers(study, analyse_study(study), tmp_path / "report").read_text(encoding="utf-8")
    assert "also offset = -2 * size + 3 mm" in page
    assert study["offset"].tolist() == pytest.approx([-13e-3, -15e-3], rel=1e-13)
    assert Path(tmp_path / "report" / "answers.json").is_file() and not math.isnan(study["area"][0])


def test_followers_do_not_count_as_dimensions():
    """One random key has two corners, whatever follows it; thirty keys would have a billion."""
    spec = Toy(parts=tuple(Part(name=f"p{n}") for n in range(31)))
    vary = {"parts.p0.width": uniform("1 mm", "2 mm")} | {f"parts.p{n}.width": linked(f"{n} * parts.p0.width") for n in range(1, 31)}
    plan, cases = columns(vary, spec, method="corners")
    assert len(plan) == 2 and cases["parts.p30.width"] == pytest.approx([30e-3, 60e-3], rel=1e-14)


def test_one_follower_needs_no_list_and_a_relation_may_begin_with_its_sign(tmp_path):
    """`also = "-KEY"` and `link = "= -1 * KEY"` say what `also = ["-KEY"]` does."""
    path, columns = tmp_path / "gears.toml", []
    vary = '[[study.vary]]\nkey = "gears.pinion.torque"\nlower = "20 N m"\nupper = "40 N m"\nsteps = 3\n'
    linked_entry = '[[study.vary]]\nkey = "gears.wheel.torque"\nlink = "= -1 * gears.pinion.torque"\n'
    for text in ('also = ["-gears.wheel.torque"]\n', 'also = "-gears.wheel.torque"\n', linked_entry):
        path.write_text(GEARS + vary + text, encoding="utf-8")
        columns.append(make_plan(dw.load(path)).cases(0, 3)["gears.wheel.torque"].tolist())
    assert columns[0] == columns[1] == columns[2] == pytest.approx([-20.0, -30.0, -40.0])


def test_a_follower_with_a_minus_cannot_be_followed():
    vary = {"size + -offset": ["1 mm"], "parts.0.width": linked("2 * offset")}
    with pytest.raises(SpecError, match=r"study\.vary\.1\.link: offset follows another key itself"):
        make_plan(with_variation(SPEC, vary))


@pytest.mark.parametrize(("width", "is_told"), [("8.0000001 mm", True), ("8.000000001 mm", False), ("0 mm", True)])
def test_a_remark_where_the_spec_differs_by_more_than_a_part_in_a_thousand_million(width, is_told):
    spec = SPEC.replace({"parts.right.width": width})
    plan, _ = columns({"parts.left.width": ["1 mm"], "parts.right.width": linked("2 * parts.left.width")}, spec)
    assert bool(plan.remarks) is is_told
