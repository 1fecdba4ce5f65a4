"""Keys that always have the same value: one axis of a study, several columns."""

import numpy as np
import pytest
from study_toy import Body, Part, Toy, install

import drivewright as dw
from drivewright.errors import SpecError
from drivewright.studies.plan import make_plan
from drivewright.studies.variation import normal, tolerance, with_options, with_variation

pytestmark = pytest.mark.property

SPEC = Toy(parts=(Part(name="left"), Part(name="right")), bodies={"arm": Body()})
BOTH = "parts.left.width + parts.right.width"


def test_a_tied_key_has_its_own_column_and_no_axis_of_its_own():
    plan = make_plan(with_variation(SPEC, {"count": [1, 2], BOTH: ["3 mm", "4 mm"], "size+offset": normal("10 mm", "1 mm")}, samples=5))
    assert plan.keys == ("count", "parts.left.width", "parts.right.width", "size", "offset")
    assert plan.shape == (2, 2) and plan.inner == 5 and len(plan) == 20 and plan.points.shape == (5, 1)
    cases = plan.cases(0, 20)
    assert list(cases) == list(plan.keys)
    for key, other in (("parts.left.width", "parts.right.width"), ("size", "offset")):
        assert np.array_equal(cases[key], cases[other])
    assert cases["parts.left.width"].tolist() == np.tile(np.repeat([3e-3, 4e-3], 5), 2).tolist()


def test_tied_keys_reach_the_drive(monkeypatch, tmp_path):
    install(monkeypatch.setattr)
    (tmp_path / "toy.toml").write_text('mechanism = "toy"\n')
    spec = with_options(dw.load(tmp_path / "toy.toml"), ["size+offset=8 mm,9 mm"], analyses=["main", "more"])
    assert spec.study.vary[0].also == ("offset",)
    study = dw.sweep(spec, out=tmp_path / "S", on="serial")
    assert study["offset"].tolist() == study["size"].tolist() == [8e-3, 9e-3] and study.unit("offset") == "m"
    assert "offset" not in study.value_names and dw.open_study(tmp_path / "S").plan.keys == ("size", "offset")


def test_a_tie_is_part_of_the_plan():
    tied, alone, longer = (make_plan(with_variation(SPEC, {key: ["1 mm", "2 mm"]})) for key in ("size+offset", "size", BOTH))
    assert len({tied.digest, alone.digest, longer.digest}) == 3


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ({"size + force": ["1 mm"]}, "study.vary.0.also.0: force cannot have the same value as size: they take different kinds of values"),
        ({"size + sise": ["1 mm"]}, "study.vary.0.also.0: this spec has no key 'sise' (did you mean 'size'?)"),
        ({"count": [1], "size + study.seed": ["1 mm"]}, "study.vary.1.also.0: study.seed cannot vary"),
        ({"size + size": ["1 mm"]}, "size varies twice; give it once"),
        ({"offset": ["1 mm"], "size + offset": ["1 mm"]}, "offset varies twice; give it once"),
        ({"ratio + count": tolerance(0.1)}, "count cannot have the same value as ratio"),
    ],
)
def test_ties_that_are_none(vary, words):
    with pytest.raises(SpecError) as found:
        make_plan(with_variation(SPEC, vary))
    assert words in str(found.value)
