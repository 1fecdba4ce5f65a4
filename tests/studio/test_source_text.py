"""The text of a spec as its author wrote it: what changes in it when the tables change, and what never does."""

import difflib
import tomllib
from copy import deepcopy

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import EXAMPLES

from drivewright import registry
from drivewright.spec.keys import leaves, set_key
from drivewright.spec.serialisation import toml_text
from drivewright.studio.document import Document
from drivewright.studio.jobs.files import save
from drivewright.studio.opening import opened
from drivewright.studio.source_text import source_text

pytestmark = pytest.mark.interface

PRESETS = [path for kind in registry.kinds() for path in registry.mechanism(kind).presets().values()]
SPECS = [*sorted(EXAMPLES.rglob("*.toml")), *PRESETS]
JANSEN = (EXAMPLES / "jansen_leg.toml").read_text(encoding="utf-8")
COMMENTED = """# head
format = 1  # kept

# above the table
[bodies.crank]  # beside the table
mass = "1 kg"  # weighed
# its own
length = ["1 mm", "2 mm"]
list = [
  1,  # one
  2,  # two
]

[[joints]]  # the first
name = "A"
kind = "pin"

[[joints]]
name = "B"  # named
kind = "slide"
"""


def differing(before, after):
    """The lines that differ, as difflib marks them."""
    return [line for line in difflib.ndiff(before.splitlines(), after.splitlines()) if line[0] in "+-"]


def entered(edit, text=COMMENTED):
    """The text after `edit(tables)`, which says what the tables say."""
    tables = tomllib.loads(text)
    edit(tables)
    made = source_text(text, tables)
    assert tomllib.loads(made) == tables
    return made


@pytest.mark.parametrize("path", SPECS, ids=lambda path: f"{path.parent.parent.name}-{path.stem}")
def test_a_spec_that_is_opened_and_saved_has_the_same_bytes(path):
    design = opened(path)
    assert Document(design).design.text() == path.read_text(encoding="utf-8")
    (file,) = save(design, lambda *news: None)["files"]
    if file["name"].endswith(".toml"):
        assert file["data"] == path.read_bytes()


@pytest.mark.parametrize("path", SPECS, ids=lambda path: f"{path.parent.parent.name}-{path.stem}")
def test_one_changed_value_is_one_line_that_differs(path):
    text = path.read_text(encoding="utf-8")
    tables = tomllib.loads(text)
    for key, value in list(leaves(tables))[::5]:
        other = deepcopy(tables)
        set_key(other, key, f"other {value}" if isinstance(value, str) else 77.5)
        made = source_text(text, other)
        assert tomllib.loads(made) == other and [line[0] for line in differing(text, made)] == ["-", "+"], key


def test_a_changed_value_keeps_its_comment_and_its_place():
    assert 'mass = "2 kg"  # weighed\n# its own' in entered(lambda tables: tables["bodies"]["crank"].update(mass="2 kg"))
    made = entered(lambda tables: tables["bodies"]["crank"]["list"].__setitem__(1, 3))
    assert differing(COMMENTED, made) == ["-   2,  # two", "+   3,  # two"]


def test_a_new_key_goes_into_its_table_and_a_removed_one_goes_with_its_comment():
    made = entered(lambda tables: tables["bodies"]["crank"].update(angle="3 deg"))
    assert differing(COMMENTED, made) == ['+ angle = "3 deg"'] and made.index("angle") < made.index("[[joints]]")
    made = entered(lambda tables: tables["bodies"]["crank"].pop("length"))
    assert differing(COMMENTED, made) == ["- # its own", '- length = ["1 mm", "2 mm"]']


def test_elements_of_a_list_come_and_go_and_the_others_keep_their_comments():
    made = entered(lambda tables: tables["joints"].pop(0))
    assert 'name = "B"  # named' in made and '"A"' not in made
    made = entered(lambda tables: tables["joints"].insert(1, {"name": "M", "kind": "pin"}))
    assert made.index('"A"') < made.index('"M"') < made.index('"B"  # named') and "[[joints]]  # the first" in made
    made = entered(lambda tables: tables["joints"].reverse())
    assert made.index('"B"') < made.index('"A"')


def test_a_table_comes_and_goes():
    made = entered(lambda tables: tables["bodies"].update(rod={"mass": "3 kg", "points": {"A": ["0 mm", "0 mm"]}}))
    assert "# weighed" in made and 'points = {A = ["0 mm", "0 mm"]}' in made
    assert "crank" not in entered(lambda tables: tables["bodies"].pop("crank")) and "# head" in entered(lambda tables: tables.pop("joints"))


def test_a_text_that_is_no_toml_gives_way_to_the_tables():
    assert source_text("a = = 1", {"a": 2}) == "a = 2\n" == source_text("", {"a": 2})


def test_undo_brings_the_text_back_with_its_comments():
    document = Document(opened(EXAMPLES / "jansen_leg.toml"))
    document.drop("joints", 2)
    assert "P_lower" not in document.design.text() and "# A triangle with the sides 41.5" in document.design.text()
    document.undo()
    assert document.design.text() == JANSEN


def test_a_comment_alone_is_a_change_that_can_be_undone():
    document = Document(opened(EXAMPLES / "jansen_leg.toml"))
    document.text(JANSEN.replace("# O: the crank's shaft.", "# O: the shaft of the crank."))
    assert document.can_undo and document.changed and "# O: the shaft of the crank." in document.design.text()
    document.set("drive.speed", "70 rpm")
    assert "# O: the shaft of the crank." in document.design.text()
    document.undo()
    document.undo()
    assert not document.changed and document.design.text() == JANSEN


# -- random edits --------------------------------------------------------------------------------------------------------------

names = st.sampled_from(["a", "b", "mass", "odd key", 'quo"te'])
values = st.one_of(
    st.integers(-9, 9),
    st.booleans(),
    st.text(st.characters(codec="utf-8"), max_size=6),
    st.lists(st.integers(0, 3), max_size=4),
    st.lists(st.text("xyz", max_size=2), max_size=3),
)
elements = st.dictionaries(names, values, max_size=3)
nested = st.dictionaries(
    names, st.one_of(values, elements, st.dictionaries(names, elements, max_size=2), st.lists(elements, max_size=3)), max_size=5
)


def commented(text):
    """The text with a comment above and beside every line that is a statement of its own."""
    return "".join(f"# above {n}\n{line}  # beside {n}\n" if line else "\n" for n, line in enumerate(text.split("\n")))


@given(nested, nested)
@settings(max_examples=300, deadline=None)
@pytest.mark.property
def test_the_text_says_what_the_tables_say_whatever_is_edited(before, after):
    source = commented(toml_text(before))
    assert tomllib.loads(source) == before
    assert tomllib.loads(source_text(source, after)) == after
    mixed = {**before, **after}
    assert tomllib.loads(source_text(source, mixed)) == mixed


@pytest.mark.property
@given(st.data())
@settings(max_examples=60, deadline=None)
def test_edits_of_a_real_spec_keep_every_comment_of_what_stays(data):
    tables = tomllib.loads(JANSEN)
    for key, _ in data.draw(st.lists(st.sampled_from(list(leaves(tables))), max_size=4)):
        set_key(tables, key, data.draw(st.sampled_from(["x", 3, 1.5])))
    for number in sorted(data.draw(st.sets(st.integers(0, 9), max_size=3)), reverse=True):
        del tables["joints"][number]
    made = source_text(JANSEN, tables)
    assert tomllib.loads(made) == tables
    wanted = [line for line in JANSEN.splitlines() if line.startswith("#") and "three bodies share" not in line]
    assert [line for line in made.splitlines() if line in wanted] == wanted


def test_a_number_that_becomes_a_truth_is_entered():
    """In Python 1 and true are equal; in a spec they are not."""
    made = entered(lambda tables: tables.update(format=True, other=1))
    assert tomllib.loads(made)["format"] is True and "# kept" in made


def test_values_between_others_are_entered_in_their_order():
    """Two in the place of one, and one in the place of two; what stands around them stays."""
    text = "a = [1, 2, 3]  # of a\nb = [4, 5, 6, 7]\n# the end\n"
    made = entered(lambda tables: tables.update(a=[1, 8, 9, 3], b=[4, 10, 7]), text)
    assert "# of a" in made and "# the end" in made


def test_an_element_is_followed_by_its_name_through_a_change_and_another_that_goes():
    """What an author wrote inside of it stays with it, though its number and its values are others."""

    def edit(tables):
        del tables["joints"][0]
        tables["joints"][0]["kind"] = "pin"

    made = entered(edit)
    assert '"B"  # named' in made and "# the first" not in made


def test_a_number_that_becomes_a_truth_value_alone_is_entered():
    """1 == True in Python, and not in TOML."""
    assert source_text("a = 1  # one\n", {"a": True}) == "a = true  # one\n"
