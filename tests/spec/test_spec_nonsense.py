"""Nonsense in: a spec comes out, or our complaint that names a key or the file.  Never a traceback."""

import copy
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import EXAMPLES

from drivewright import registry
from drivewright.errors import InputError, SpecError
from drivewright.spec import change_key, document, from_document, load, read_document
from drivewright.spec.serialisation import toml_text

pytestmark = pytest.mark.interface

PRESETS = [path for kind in registry.kinds() for path in registry.mechanism(kind).presets().values()]
DESIGNS = sorted(EXAMPLES.glob("*.toml"))
SPECS = [(path.parent, read_document(path)) for path in [*DESIGNS, *PRESETS]]
WORDS = sorted({word for path in DESIGNS for word in path.read_text().replace('"', " ").split() if word.isidentifier()})

NUMBERS = st.one_of(st.integers(), st.floats(), st.sampled_from([0, -1, 10**400, 2**63, -0.0, 5e-324, 1.7e308]))
UNITS = st.sampled_from(
    ["mm", "m", "deg", "rad", "rpm", "rev/h", "Hz", "N", "N m", "N/m", "N m/rad", "kg", "MPa", "mm/min", "", "^", "mm^-9"]
)
QUANTITIES = st.builds(lambda number, unit: f"{number} {unit}", st.floats(), UNITS)
TEXTS = st.one_of(st.text(max_size=20), QUANTITIES, st.sampled_from(WORDS))
SCALARS = st.one_of(NUMBERS, TEXTS, st.booleans(), st.dates(), st.times(), st.datetimes())
KEYS = st.one_of(st.sampled_from(WORDS), st.text(max_size=8))
VALUES = st.recursive(SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3), max_leaves=6)
GONE = object()


def accepted(tables, folder):
    """The spec of some tables, or None where it is refused with a message that names a key."""
    try:
        spec = from_document(tables, folder=folder)
    except SpecError as error:
        assert error.key and str(error).startswith(error.key) and len(error.message) < 5000
        return None
    except InputError as error:
        pytest.fail(f"names no key: {error}")
    return spec


def places(value, path=()):
    """Paths of all tables, lists and values below a value."""
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield (*path, key)
        yield from places(inner, (*path, key))


def with_change(tables, path, value):
    tables = copy.deepcopy(tables)
    place = tables
    for step in path[:-1]:
        place = place[step]
    if value is GONE:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return tables


@st.composite
def damaged_specs(draw):
    """(folder, tables) of a real spec with one to three places replaced, removed or filled with nonsense."""
    folder, tables = draw(st.sampled_from(SPECS))
    for _ in range(draw(st.integers(1, 3))):
        if found := list(places(tables)):
            tables = with_change(tables, draw(st.sampled_from(found)), draw(st.one_of(VALUES, st.just(GONE))))
    return folder, tables


@settings(max_examples=150)
@given(damaged_specs())
def test_a_damaged_spec_is_read_or_refused_by_key(case):
    folder, tables = case
    if (spec := accepted(tables, folder)) is not None:
        again = from_document(tomllib.loads(spec.to_toml()))
        assert again == spec and again.digest() == spec.digest() and tomllib.loads(toml_text(document(spec))) == document(spec)


@settings(max_examples=80)
@given(st.dictionaries(KEYS, VALUES, max_size=5), st.sampled_from([*registry.kinds(), None]))
def test_a_document_of_nonsense_is_refused_by_key(tables, kind):
    assert accepted(tables | ({"mechanism": kind} if kind else {}), Path()) is None


@pytest.fixture(scope="module")
def scratch(tmp_path_factory):
    return tmp_path_factory.mktemp("nonsense") / "spec.toml"


TOKENS = st.sampled_from(
    ["[", "]", "[[", "]]", "{", "}", "=", ".", ",", '"', "'''", "\n", "#", "mechanism", '"cam"', "follower", "1e9", "nan", "0x", "89 deg"]
)


@settings(max_examples=150)
@given(
    content=st.one_of(
        st.binary(max_size=60),
        st.text(max_size=60).map(lambda t: t.encode("utf-8", "replace")),
        st.lists(TOKENS, max_size=15).map(lambda t: " ".join(t).encode()),
    )
)
def test_a_file_of_nonsense_is_refused_by_name(scratch, content):
    scratch.write_bytes(content)
    with pytest.raises(SpecError) as caught:
        load(scratch)
    assert str(caught.value).startswith(f"{scratch}: ") and caught.value.file == str(scratch)


@settings(max_examples=80)
@given(st.data())
def test_a_spec_file_with_a_hole_is_read_or_refused_by_name(scratch, data):
    text = data.draw(st.sampled_from(DESIGNS)).read_bytes()
    start = data.draw(st.integers(0, len(text)))
    scratch.write_bytes(text[:start] + data.draw(st.binary(max_size=4)) + text[data.draw(st.integers(start, min(start + 40, len(text)))) :])
    try:
        load(scratch)
    except SpecError as error:
        assert str(error).startswith(f"{scratch}: ")


@settings(max_examples=80)
@given(
    st.sampled_from(SPECS),
    st.lists(st.sampled_from([*WORDS, "0", "1", "-1", "", " ", "²"]), max_size=4),
    st.one_of(TEXTS, NUMBERS.map(str)),
)
def test_any_change_is_made_or_refused(case, steps, value):
    folder, tables = case
    tables = copy.deepcopy(tables)
    try:
        change_key(tables, ".".join(steps) + "=" + value)
    except SpecError as error:
        assert error.key or "--set" in error.message
    else:
        accepted(tables, folder)
