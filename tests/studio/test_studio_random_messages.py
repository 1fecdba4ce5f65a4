"""Random messages against a whole session: no fault, a design that loads again from its own text, and a way back to the first one."""

import math
import tomllib

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from places import EXAMPLES
from studio_tab import Here, Tab

from drivewright import registry
from drivewright.spec.keys import leaves
from drivewright.studio.form import form, values
from drivewright.studio.jobs import JOBS
from drivewright.studio.opening import opened
from drivewright.studio.proposals import ENTRIES, TABLES
from drivewright.studio.resources import ServerResources
from drivewright.studio.session import ACTIONS
from drivewright.studio.undo_history import STEPS

pytestmark = [pytest.mark.interface, pytest.mark.property]

SPECS = ["four_bar", "disc_cam", "spindle", "oscillating_cam", "jansen_leg"]
OPENING = ("hello", "fresh", "example", "open")  # begin a document of their own
TEXTS = ["", " ", "7", "-1", "1e999", "nan", "inf", "1e-320 mm", "0 mm", "-3 mm", "45 mm", "3 kg", "40 deg", "99 rpm", "true", "x" * 3000]
TEXTS += [
    "<img src=x onerror=alert(1)>",
    "__class__",
    "mechanism",
    "title",
    "../../etc/passwd",
    "/etc/passwd",
    "a.b.c",
    '"',
    "#",
    "\n",
    "\0",
]
TEXTS += ["1, 2", "[1, 2]", '["1 mm", "2 mm"]', "[[[[[[1]]]]]]", "{a = 1}", "__import__('os').system('id')", "1979-05-27", "0x10", "1_000"]
KEYS = ["", ".", "..", "mechanism", "title", "format", "units", "__class__", "design", "tables.title", "joints", "joints.0", "joints.-1"]
KEYS += ["joints.99.name", "bodies", "bodies.crank", "bodies.new.mass", "programme.0.angle", "optimise.unknowns.0.key", "study.points"]
junk = st.recursive(
    st.one_of(
        st.none(), st.booleans(), st.integers(-(2**53), 2**53), st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(TEXTS)
    ),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(st.sampled_from(TEXTS), inner, max_size=3)),
    max_leaves=6,
)
places = st.lists(st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3)).map(list), max_size=4)
seen = st.sampled_from([[0.0, 0.0], [0.04, 0.0], [0.1, 0.0], [0.02, 0.001], [0.0, 0.02]])  # where a four-bar has points and bars
gestures = st.sampled_from(["", "g", "h"])
tools = st.sampled_from([tool.name for tool in registry.mechanism("linkage").construction.tools])


def plausible(document):
    """{action: strategy of arguments as a page has them} for a document as it is."""
    shown = form(document.design)
    fields = values(shown)
    key = st.one_of(st.sampled_from(list(fields)), st.sampled_from(KEYS))
    text = st.one_of(st.sampled_from(TEXTS), st.sampled_from([field["text"] for field in fields.values()]))
    number = st.sampled_from([field["text"] for field in fields.values() if field["kind"] in ("quantity", "number")] or ["1"])
    changes = st.dictionaries(key, st.one_of(number, text), max_size=4)
    some = st.sampled_from([group["key"] for group in shown["groups"]] + ["joints", "bodies"])
    index = st.integers(-1, 4)
    element = st.fixed_dictionaries(
        {"of": st.one_of(st.none(), index), "changes": st.dictionaries(st.sampled_from(["angle", "law", "name"]), text)}
    )
    entries = {
        part: st.dictionaries(st.sampled_from(names), st.one_of(text, key, st.integers(-1, 9), st.lists(text)))
        for part, names in ENTRIES.items()
    }
    parts = {
        part: st.lists(entries[part], max_size=2) if part in entries else st.one_of(text, st.integers(-1, 50))
        for names in TABLES.values()
        for part in names
    }
    table = st.sets(st.sampled_from(sorted(parts)), max_size=3).flatmap(
        lambda names: st.fixed_dictionaries({name: parts[name] for name in names})
    )
    toml = st.sampled_from(
        ["", "a", 'mechanism = "cam"', "\ufeff", document.design.text() + "# end\n", document.design.text().replace("0", "1", 3)]
    )
    name = st.sampled_from(sorted(registry.mechanism(document.design.kind).presets()))
    return {
        "set": st.fixed_dictionaries({"key": key, "text": st.one_of(text, number)}, optional={"gesture": gestures}),
        "drag": st.fixed_dictionaries({"changes": changes, "gesture": gestures}),
        "revert": st.fixed_dictionaries({"gesture": gestures}),
        "unset": st.fixed_dictionaries({"key": key}),
        "construct": st.fixed_dictionaries(
            {
                "tool": tools,
                "places": st.one_of(places, st.lists(seen, min_size=1, max_size=3)),
                "near": st.sampled_from([1e-9, 1e-3, 0.05, 10]),
            }
        ),
        "sketch": st.fixed_dictionaries({"on": st.booleans()}),
        "add": st.fixed_dictionaries({"list": some}),
        "drop": st.fixed_dictionaries({"list": some, "index": index}),
        "arrange": st.fixed_dictionaries({"list": some, "elements": st.lists(element, max_size=4)}),
        "put": st.fixed_dictionaries({"table": st.one_of(some, key)}),
        "take": st.fixed_dictionaries({"table": st.one_of(some, key)}),
        "lock": st.fixed_dictionaries({"key": key, "on": st.booleans()}),
        "text": st.fixed_dictionaries({"toml": toml}),
        "load": st.fixed_dictionaries({"changes": changes}),
        "preset": st.fixed_dictionaries({"name": name}),
        "begin": st.fixed_dictionaries({"name": st.sampled_from(sorted(TABLES)), "table": table}),
        "job": st.fixed_dictionaries({"name": st.sampled_from(sorted(JOBS))}),
        "pin": st.fixed_dictionaries({"gen": st.integers(0, 9)}),
        "reference": st.fixed_dictionaries({"preset": name}),
        "undo": st.just({}),
        "redo": st.just({}),
        "source": st.just({}),
        "propose": st.just({}),
        "save": st.just({}),
    }


def message(document):
    """A message: mostly as a page sends it, some with a part that no page has."""
    proper = st.sampled_from(sorted(wanted := plausible(document))).flatmap(
        lambda what: wanted[what].map(lambda given: {"what": what, **given})
    )
    odd = st.builds(
        lambda good, name, value: {**good, name: value},
        proper,
        st.sampled_from(
            ["key", "text", "changes", "gesture", "places", "near", "list", "index", "elements", "table", "options", "name", "__class__"]
        ),
        junk,
    )
    wild = st.builds(
        lambda what, given: {**given, "what": what},
        st.sampled_from(sorted(set(ACTIONS) - set(OPENING))),
        st.dictionaries(st.sampled_from(["key", "text"]), junk),
    )
    return st.one_of(proper, proper, proper, odd, wild)


@pytest.fixture(scope="module")
def shop():
    resources = ServerResources()
    resources.reading = Here()
    yield resources
    resources.close()


def as_it_is(tab):
    """What a document holds now, after it has been looked through: it is a design, and its text says all of it."""
    document = tab.session.document
    document.design.spec()
    text = document.design.text()
    assert tomllib.loads(text) == document.design.tables
    assert all(math.isfinite(value) for _, value in leaves(document.design.tables) if isinstance(value, float))
    return text


@pytest.mark.parametrize("name", SPECS)
@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow, HealthCheck.data_too_large])
@given(data=st.data())
def test_no_message_is_a_fault_and_every_change_can_be_undone_to_the_letter(name, shop, data):
    tab = Tab(opened(EXAMPLES / f"{name}.toml"), shop)
    tab.say("hello")
    texts = [as_it_is(tab)]
    for _ in range(data.draw(st.integers(1, 12))):
        before, given = as_it_is(tab), data.draw(message(tab.session.document))
        answers = tab.send(given)
        if any(answer["what"] == "refused" for answer in answers) and given["what"] not in ("save",):
            assert as_it_is(tab) == before
        texts.append(as_it_is(tab))
    assert len(texts) < STEPS
    while tab.session.document.can_undo:
        tab.say("undo")
        assert as_it_is(tab) in texts
    assert as_it_is(tab) == texts[0]
    while tab.session.document.can_redo:
        tab.say("redo")
