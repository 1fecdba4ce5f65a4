"""Tables whose keys the user chooses: read, refused by key, written back, digested, shown in the template and the schema."""

import copy
import json
import pickle
import tomllib

import pytest
from pydantic import Field

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.spec import Integer, MechanismSpec, Name, Named, Spec, change_key, dimension_at, document, from_document, schema, template
from drivewright.spec.serialisation import toml_text
from drivewright.units import Length, Mass

pytestmark = pytest.mark.interface


class Part(Spec):
    """A part."""

    mass: Mass = Field(ge=0, description="mass", examples=["1 kg"])
    points: Named[tuple[Length, Length]] = Field({}, description="points", examples=[{"A": ["0 mm", "0 mm"]}])
    called: Name = Field("x", description="a name")


class Sack(MechanismSpec):
    """A sack of parts."""

    parts: Named[Part] = Field(description="parts")
    spare: Named[Part] = Field({}, description="spare parts")
    sizes: Named[Length] = Field({}, description="sizes")
    counts: Named[Integer] = Field({}, description="counts")


TABLES = tomllib.loads("""
mechanism = "sack"
[parts.left-arm]
mass = "2 kg"
points = { A = ["1 mm", "2 mm"], B = ["3 cm", "0 mm"] }
[parts.bein]
mass = "1 kg"
[sizes]
"größe" = "5 mm"
""")


def sack(*changes):
    tables = copy.deepcopy(TABLES)
    for change in changes:
        change_key(tables, change)
    return from_document(tables, Sack)


def test_names_are_keys_all_the_way():
    spec = sack("parts.bein.mass=3 kg", "parts.left-arm.points.B.1=7 mm", "sizes.new=1 in")
    assert spec.parts["bein"].mass == 3.0 and spec.parts["left-arm"].points == {"A": (0.001, 0.002), "B": (0.03, 0.007)}
    assert spec.sizes == {"größe": 0.005, "new": 0.0254} and spec.spare == {}


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        ("parts.bein.mass=3 m", "parts.bein.mass", "wants a mass, got '3 m' (length)"),
        ("parts.bein.mass=-3 kg", "parts.bein.mass", "must be at least 0 kg, got -3 kg"),
        ("parts.bein.mas=3 kg", "parts.bein.mas", "unknown key (did you mean 'mass'?)"),
        ("parts.biene.points={}", "parts.biene.mass", "is missing (mass)"),
        ("parts.left-arm.points.B=[1]", "parts.left-arm.points.B.0", "unit missing"),
        ("parts.left-arm.points.B.1=4 kg", "parts.left-arm.points.B.1", "wants a length"),
        ("parts.left-arm.points=7", "parts.left-arm.points", "must be a table, got 7"),
        ("parts=[]", "parts", "must be a table, got []"),
        ("sizes.new=7", "sizes.new", "unit missing"),
        ("sizes.two words=7 mm", 'sizes."two words"', "'two words' is no name here: letters, digits, _ and - only"),
        ("parts.bein.called=a.b", "parts.bein.called", "'a.b' is no name here"),
    ],
)
def test_a_wrong_key_below_a_name_is_named(change, key, words):
    with pytest.raises(SpecError) as caught:
        sack(change)
    assert caught.value.key == key and words in str(caught.value)


def test_a_complaint_of_a_rule_between_keys_brings_its_own_key():
    class Pair(Spec):
        low: float = Field(0.0)

        def model_post_init(self, context):
            if self.low > 1:
                raise SpecError("too high", key="low")

    class Two(Spec):
        pairs: Named[Pair] = Field({})

    with pytest.raises(SpecError, match="^pairs.a.low: too high$") as caught:
        Two(pairs={"a": {"low": 2.0}})
    assert caught.value.key == "pairs.a.low"


@pytest.mark.parametrize(
    ("key", "found"),
    [
        ("parts.anything.mass", "mass"),
        ("parts.a.points.B", "length"),
        ("parts.a.points.B.0", "length"),
        ("sizes.a", "length"),
        ("parts.a.mas", False),
        ("parts.mass", None),
        ("sizes.a.b", False),
    ],
)
def test_the_dimension_below_a_name(key, found):
    exists, dimension = dimension_at(Sack, key)
    assert exists == (found is not False) and (dimension.name if dimension else None) == (found or None)


def test_it_is_written_back_equal_and_without_empty_headings():
    spec = sack()
    text = spec.to_toml()
    assert from_document(tomllib.loads(text), Sack) == spec and tomllib.loads(text) == document(spec)
    assert "[parts.left-arm.points]" in text and "[parts]" not in text and "spare" not in text and '"größe" = "5 mm"' in text
    assert tomllib.loads(toml_text({"a": {"b c": {"d": 1}, "e": {}}})) == {"a": {"b c": {"d": 1}, "e": {}}}


def test_the_digest_knows_the_names_and_not_their_order():
    spec = sack()
    swapped = copy.deepcopy(TABLES)
    swapped["parts"] = dict(reversed(swapped["parts"].items()))
    assert from_document(swapped, Sack).digest() == spec.digest() == from_document(document(spec), Sack).digest()
    others = [sack("parts.bein.points.A=['0 mm', '0 mm']"), sack("parts.left-arm.points.B.1=1 um"), sack("sizes.other=5 mm")]
    swapped["parts"]["leg"] = swapped["parts"].pop("bein")
    assert len({spec.digest(), from_document(swapped, Sack).digest(), *(other.digest() for other in others)}) == 5


def test_it_is_frozen_hashable_and_can_be_copied():
    spec = sack()
    for spoil in (lambda p: p.update(a=1), lambda p: p.pop("bein"), lambda p: p.__setitem__("a", 1), lambda p: p.__delitem__("bein")):
        with pytest.raises(TypeError, match="a spec is frozen"):
            spoil(spec.parts)
    assert {spec: 1}[sack()] == 1 and pickle.loads(pickle.dumps(spec)) == spec == copy.deepcopy(spec)
    assert spec.replace(sizes={}).sizes == {} and len(spec.sizes) == 1


def test_template_and_schema(monkeypatch, tmp_path):
    (tmp_path / "presets").mkdir()
    (tmp_path / "presets" / "default.toml").write_text(toml_text(TABLES), encoding="utf-8")
    kind = registry.Mechanism("sack", "a sack", Sack, None, (), tmp_path)
    monkeypatch.setattr(registry, "mechanism", lambda name: kind)
    text = template("sack")
    assert from_document(tomllib.loads(text), Sack) == sack()
    assert 'points = { A = ["1 mm", "2 mm"], B = ["3 cm", "0 mm"] }\n' in text and "[table of list of 2 x length; default {}]" in text
    assert "# counts  [table of whole number; default]" in text
    assert text.count("# mass  [mass >= 0]") == 2  # explained in the first part, not again in the second, and in the spare one
    assert "\n[parts.left-arm]  # parts\n" in text and "\n[parts.bein]\n" in text and "\n#[spare.a]  # spare parts\n" in text
    (tmp_path / "presets" / "default.toml").unlink()
    bare = template("sack")
    assert "\n[parts.a]  # parts\n" in bare and "#sizes = {}" in bare and from_document(tomllib.loads(bare), Sack).parts["a"].mass == 1.0
    jsonschema = pytest.importorskip("jsonschema")
    found = json.loads(json.dumps(schema("sack")))
    assert not list(jsonschema.Draft202012Validator(found).iter_errors(TABLES))
    assert list(jsonschema.Draft202012Validator(found).iter_errors({**TABLES, "sizes": {"a": 7}}))
