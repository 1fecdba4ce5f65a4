"""The forms of the page, run in node: what a search and a study send, how many designs they say, what is scaled and what is chosen."""

import math

import pytest
from in_node import STORE, in_node

pytestmark = pytest.mark.interface

RESULT = {
    "headline": [{"name": "stroke"}],
    "values": [
        {"name": "force", "label": "Force", "shown": "120 N", "number": "120", "unit": "N"},
        {"name": "stroke", "label": "Stroke", "shown": "20 mm", "number": "20", "unit": "mm"},
        {"name": "ratio", "label": "Ratio", "shown": "0.5", "number": "0.5", "unit": "-"},
    ],
    "checks": [{"name": "pressure", "label": "Pressure"}, {"name": "life", "label": "Life"}],
    "timings": {"motion": 0.5, "forces": 1.5},
    "needs": {"forces": ["motion", "forces"]},
    "sources": {"force": "forces", "stroke": "motion", "check.pressure": "motion", "check.life": "forces"},
}
KEYS = [
    {"key": "a", "label": "a", "kind": "quantity", "text": "4 mm", "lower": "2 mm", "upper": "8 mm", "choices": []},
    {"key": "n", "label": "n", "kind": "integer", "text": "8", "lower": "4", "upper": "16", "choices": []},
    {"key": "c", "label": "c", "kind": "choice", "text": "left", "lower": "", "upper": "", "choices": ["left", "right"]},
    {"key": "held", "label": "held", "kind": "quantity", "text": "1 mm", "lower": "0.5 mm", "upper": "2 mm", "choices": [], "locked": True},
]

# -- the search ----------------------------------------------------------------------------------------------------------------

SEARCH = (
    STORE
    + """
    learn(store);
    const form = createSearchForm(tools, () => {}), part = name => form.node.named(`search-${name}`)[0];
    form.load({keys: data.keys, optimise: data.table ?? null});
    const sent = () => { part("start").fire("click"); return said.at(-1).table; };
"""
)


def search(body, **more):
    given = {"state": {"result": RESULT}, "keys": KEYS, **more}
    return in_node(SEARCH + body, given, store="createStore", search_form="createSearchForm", costs="learn")


TABLE = {
    "unknowns": [{"key": "a", "lower": "3 mm", "upper": "5 mm"}],
    "objectives": [{"value": "force", "goal": "minimise"}],
    "requirements": [{"value": "check.life"}, {"value": "stroke", "at_least": "10 mm", "at_most": "30 mm"}],
    "generations": 7,
}


def test_a_search_is_sent_as_its_table_says_it():
    table, budget = search("return [sent(), part('budget').value];", table=TABLE)
    assert table == {**TABLE, "requirements": [TABLE["requirements"][0], *split(TABLE["requirements"][1])], "method": "auto"}
    assert budget == str(16 * (7 + 1))  # of one unknown 16 designs in a generation, and the first ones


def split(need):
    """A value with two limits is two rows."""
    return [{"value": need["value"], side: need[side]} for side in ("at_least", "at_most")]


def test_a_draft_of_a_search_comes_back_as_it_was():
    first, second = search(
        """typed(part("budget"), "99"); const draft = form.draft(), first = [sent(), part("budget").value]; form.load(draft);
        return [first, [sent(), part("budget").value]];""",
        table=TABLE,
    )
    assert first == second and first[1] == "99"


def test_checks_are_all_respected_unless_a_table_names_others():
    assert search("return sent().requirements;") == [{"value": "check.pressure"}, {"value": "check.life"}]
    assert search("return sent().requirements;", table={**TABLE, "requirements": []}) == []
    limited = {"value": "check.life", "at_least": 0.2}
    found = search("return sent().requirements;", table={**TABLE, "requirements": [limited]})
    assert found == [limited]  # a margin of its own stays
    assert search("ticked(part('check-pressure'), false); return sent().requirements;") == [{"value": "check.life"}]


def test_a_limit_has_the_unit_that_the_value_is_shown_in():
    body = """
        const row = (n, value, wish, limit) => {
          part("add").fire("click");
          part(`value-${n}`).value = value; typed(part(`goal-${n}`), wish, "change"); typed(part(`limit-${n}`), limit);
        };
        const begins = [];
        part("add").fire("click"); part("value-1").value = "force"; typed(part("goal-1"), "at_most", "change");
        begins.push(part("limit-1").value);
        ["12", "−1.5e2", "3 kN", "x"].forEach((limit, n) => row(n + 2, "force", n % 2 ? "at_least" : "at_most", limit));
        row(6, "ratio", "at_least", "0.4"); row(7, "unknown", "at_most", "9");
        return [begins, part("limit-0").hidden, sent().requirements.slice(2)];
    """
    begins, hidden, limits = search(body)
    assert begins == ["120 N"] and hidden  # the limit begins with the number that the value has now; a goal alone has none
    assert limits == [
        {"value": "force", "at_most": "120 N"},
        {"value": "force", "at_most": "12 N"},
        {"value": "force", "at_least": "-1.5e2 N"},
        {"value": "force", "at_most": "3 kN"},
        {"value": "force", "at_least": "x"},
        {"value": "ratio", "at_least": "0.4"},
        {"value": "unknown", "at_most": "9"},
    ]


def test_a_limit_of_a_pure_number_begins_without_a_unit():
    body = """
        typed(part("value-0"), "ratio", "change"); typed(part("goal-0"), "at_most", "change"); const first = part("limit-0").value;
        typed(part("limit-0"), "7"); typed(part("value-0"), "force", "change");
        return [first, part("limit-0").value];
    """
    assert search(body) == ["0.5", "7"]  # and what a person has typed stays


def test_how_long_a_search_takes_at_most():
    body = """
        const note = () => [part("estimate").textContent, part("start").disabled];
        const first = note();
        ticked(part("key-a"), true); const second = note();
        part("value-0").value = "stroke"; typed(part("budget"), "160"); const third = note();
        typed(part("budget"), "0"); const fourth = note();
        typed(part("budget"), "160"); ticked(part("check-life"), false); const quick = note();
        typed(part("method"), "nsga2", "change"); const several = note();
        return [first, second, third, fourth, quick, several];
    """
    first, second, third, fourth, quick, several = search(body)
    assert first == ["Tick at least one dimension that may change.", True] and fourth == ["Give a number of designs.", True]
    assert second == ["Choose a value to minimise or maximise.", True]
    assert third == ["160 designs, at most about 5 min by one process", False]  # the life wants both analyses, 2 s
    assert quick == ["160 designs, at most about 80 s by one process", False]
    assert several == quick  # 10 generations of 16 either way, of which the first is not counted in one


@pytest.mark.parametrize(("seconds", "designs"), [(0.1, 500), (1.0, 300), (2.26, 130), (1000, 64), (None, 500)])
def test_a_budget_takes_some_minutes_and_is_no_toy(seconds, designs):
    """As many designs as fit into five minutes, to the nearest ten."""
    result = {**RESULT, "timings": {} if seconds is None else {"motion": seconds}}
    assert search("return part('budget').value;", state={"result": result}) == str(designs)


def test_choices_have_no_bounds_and_locked_keys_do_not_vary():
    body = """
        ticked(part("key-n"), true);
        return [form.node.named("search-key-").map(each => each.dataset.testid), sent().unknowns];
    """
    names, unknowns = search(body, table={**TABLE, "unknowns": [{"key": "a", "lower": "3 mm", "upper": "5 mm"}, {"key": "held"}]})
    assert "search-key-c" not in names and "search-key-held" in names
    assert unknowns == [{"key": "a", "lower": "3 mm", "upper": "5 mm"}, {"key": "n", "lower": "4", "upper": "16"}]


def test_values_to_choose_from_are_the_key_numbers_first_then_all_then_margins():
    body = "return part('value-0').children.map(each => [each.attributes.label ?? '', each.options.map(one => one.value)]);"
    assert search(body) == [
        ["", []],
        ["Key numbers", ["stroke"]],
        ["Values", ["force", "ratio"]],
        ["Margins of checks", ["check.pressure", "check.life"]],
    ]


# -- the study -----------------------------------------------------------------------------------------------------------------

STUDY = (
    STORE
    + """
    learn(store);
    const form = createStudyForm(tools, () => {}), part = name => form.node.named(`study-${name}`)[0];
    form.load({keys: data.keys, study: data.table ?? null});
    const sent = () => { part("start").fire("click"); return said.at(-1).table; };
    const note = () => [part("estimate").textContent, part("start").disabled];
"""
)


def study(body, **more):
    given = {"state": {"result": RESULT}, "keys": KEYS, **more}
    return in_node(STUDY + body, given, store="createStore", study_form="createStudyForm", costs="learn")


@pytest.mark.parametrize(
    "entry",
    [
        {"key": "a", "lower": "3 mm", "upper": "5 mm", "steps": "4"},
        {"key": "a", "lower": "3 mm", "upper": "5 mm", "distribution": "uniform"},
        {"key": "a", "tolerance": "2 %", "distribution": "normal"},
        {"key": "a", "values": ["3 mm", "4 mm"]},
        {"key": "c", "values": ["right"]},
    ],
)
def test_what_a_study_varies_is_sent_as_its_table_says_it(entry):
    assert study("return sent().vary;", table={"vary": [entry]}) == [entry]


@pytest.mark.parametrize(
    ("entry", "means"),
    [
        ({"key": "a", "lower": "3 mm", "upper": "5 mm"}, {"lower": "3 mm", "upper": "5 mm", "distribution": "uniform"}),
        ({"key": "a", "tolerance": "2 %"}, {"tolerance": "2 %", "distribution": "normal"}),
        ({"key": "a", "tolerance": "2 %", "distribution": "uniform"}, {"as_written": True}),
        ({"key": "a", "lower": "1 mm", "upper": "2 mm", "distribution": "normal"}, {"as_written": True}),
        ({"key": "a", "points": "p.csv"}, {"as_written": True}),
        ({"key": "a", "distribution": "uniform"}, {"as_written": True}),
    ],
)
def test_what_the_form_has_no_boxes_for_stays_as_written(entry, means):
    assert study("return sent().vary;", table={"vary": [entry]}) == [{"key": "a", **means}]


def test_what_is_ticked_begins_with_five_levels_about_its_value_and_a_choice_with_all_of_its_values():
    """A fifth to either side; a whole number over the range of its slider."""
    body = "for (const key of ['a', 'n', 'c']) ticked(part(`key-${key}`), true); return sent();"
    assert study(body) == {
        "vary": [
            {"key": "a", "lower": "3.2 mm", "upper": "4.8 mm", "steps": "5"},
            {"key": "n", "lower": "4", "upper": "16", "steps": "5"},
            {"key": "c", "values": ["left", "right"]},
        ],
        "values": [],
    }


def test_listed_values_are_those_between_commas():
    body = """
        ticked(part("key-a"), true); typed(part("way-a"), "values", "change"); typed(part("values-a"), " 3 mm,, 4 mm , ");
        return sent().vary[0].values;
    """
    assert study(body) == ["3 mm", "4 mm"]


def test_how_many_cases_a_study_has_and_how_long_they_take():
    body = """
        const seen = [note()];
        ticked(part("key-a"), true); ticked(part("key-c"), true); seen.push(note());
        typed(part("way-a"), "normal", "change"); typed(part("samples"), "50"); form.node.fire("input"); seen.push(note());
        typed(part("samples"), ""); form.node.fire("input"); seen.push(note());
        typed(part("method"), "corners", "change"); seen.push([...note(), part("samples").parentElement.hidden]);
        typed(part("method"), "tolerance", "change"); seen.push([...note(), part("samples").parentElement.hidden]);
        return seen;
    """
    none, crossed, sampled, empty, corners, tolerance = study(body)
    assert none == ["Tick at least one dimension that varies.", True] and empty == ["Give a number of levels or samples.", True]
    assert crossed == ["10 cases, at most about 20 s by one process", False]  # five levels by two values, 2 s each
    assert sampled == ["100 cases, at most about 3 min by one process", False]  # 50 samples at each of two values
    assert corners == ["The number of cases follows from the method.", False, True]
    assert tolerance == ["The number of cases follows from the method.", False, False]


def test_only_what_is_sampled_is_sent_with_a_method_and_a_sample_size():
    body = "const plain = sent(); typed(part('way-a'), 'uniform', 'change'); return [plain, sent()];"
    plain, sampled = study(
        body, table={"vary": [{"key": "a", "lower": "3 mm", "upper": "5 mm", "steps": 2}], "method": "sobol", "samples": 64}
    )
    assert "method" not in plain and "samples" not in plain and (sampled["method"], sampled["samples"]) == ("sobol", "64")


def test_values_to_keep_are_all_until_one_is_left_out():
    body = """
        const kept = () => sent().values, count = form.node.all().find(each => each.classList.contains("sd-count"));
        const words = () => count.textContent, seen = [[kept(), words()]];
        ticked(part("keep-force"), false); seen.push([kept(), words()]);
        ticked(part("keep-force"), true); seen.push([kept(), words()]);
        return seen;
    """
    everything, fewer, again = study(body)
    assert everything == again == [[], "all"]
    assert fewer == [["stroke", "ratio", "check.pressure", "check.life"], "4"]


# -- lengths times a factor ----------------------------------------------------------------------------------------------------


def length(key, value, unit="mm", **more):
    return {"key": key, "value": value, "unit": unit, **more}


FORM = {
    "form": {
        "groups": [
            {
                "fields": [
                    {"key": "ground.points.A", "parts": [length("ground.points.A.0", 40), length("ground.points.A.1", 0)]},
                    {
                        "key": "bodies.rod.points.B",
                        "parts": [length("bodies.rod.points.B.0", 1.5, "cm"), length("bodies.rod.points.B.1", -3)],
                    },
                    length("bodies.rod.centroid.0", 12),
                    length("bodies.rod.mass", 2, "kg"),
                    length("springs.0.free_length", 50),
                    length("bodies.rod.points.C.0", 7, "parsec"),
                    length("bodies.rod.points.D.0", None),
                ]
            }
        ]
    }
}


def test_every_place_is_scaled_and_nothing_else():
    found = in_node("return scaledPlaces(data, 1 / 3);", FORM, scaling="scaledPlaces")
    assert list(found) == ["ground.points.A.0", "bodies.rod.points.B.0", "bodies.rod.points.B.1", "bodies.rod.centroid.0"]
    assert {key: text.split()[1] for key, text in found.items()} == {
        "ground.points.A.0": "mm",
        "bodies.rod.points.B.0": "cm",
        "bodies.rod.points.B.1": "mm",
        "bodies.rod.centroid.0": "mm",
    }
    assert [float(text.split()[0]) for text in found.values()] == pytest.approx([40 / 3, 0.5, -1, 4], rel=1e-7)


@pytest.mark.parametrize(
    ("wanted", "factor"), [("100", 2.5), ("10 cm", 2.5), ("0.02 m", 0.5), ("0", None), ("-3", None), ("x", None), ("3 kg", None)]
)
def test_a_wanted_length_scales_the_design_in_one_step(wanted, factor):
    """The measured length is 40 mm."""
    body = (
        STORE
        + """
        const shown = new Part("span"), host = new Part("div"); host.append(shown);
        const scaling = createScaling(shown, tools, () => 0.04);
        scaling.show(true);
        scaling.node.fire("click");
        const box = host.named("measure-wanted")[0], begins = box.value;
        box.value = data.wanted; box.fire("keydown", {key: "Enter"}); box.fire("blur");
        return [begins, said, host.children[0] === shown];
    """
    )
    begins, said, back = in_node(body, {"state": {"design": FORM}, "wanted": wanted}, store="createStore", scaling="createScaling")
    assert begins == "40 mm" and back
    assert [message["what"] for message in said] == (["load"] if factor else [])
    if factor:
        assert float(said[0]["changes"]["ground.points.A.0"].split()[0]) == pytest.approx(40 * factor)
        assert math.isclose(float(said[0]["changes"]["bodies.rod.points.B.0"].split()[0]), 1.5 * factor)


def test_nothing_is_scaled_by_escape_or_where_there_are_no_places():
    body = (
        STORE
        + """
        const shown = new Part("span"), host = new Part("div"); host.append(shown);
        const scaling = createScaling(shown, tools, () => 0.04);
        scaling.show(true); const there = scaling.node.hidden;
        scaling.show(false); const off = scaling.node.hidden;
        scaling.node.fire("click");
        const box = host.named("measure-wanted")[0];
        box.value = "80"; box.fire("keydown", {key: "Escape"});
        store.set({design: {form: {groups: []}}}); scaling.show(true);
        return [said, there, off, scaling.node.hidden];
    """
    )
    assert in_node(body, {"state": {"design": FORM}}, store="createStore", scaling="createScaling") == [[], False, True, True]
