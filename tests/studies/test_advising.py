"""Advice on failed checks: it passes in a run, it is hardly more than needed, and it keeps to what may be changed."""

import math
from dataclasses import replace
from fnmatch import fnmatchcase
from pathlib import Path

import pytest
from study_toy import TOY, install

import drivewright as dw
from drivewright import registry, runner
from drivewright.registry import Analysis
from drivewright.result import Answer, Check
from drivewright.spec import from_document
from drivewright.studies.adjustable import Dimension, dimensions

EXAMPLES = Path(__file__).parents[2] / "examples"


def toy(monkeypatch, checks, adjustable, **keys):
    """Result of a toy whose checks are functions of its spec."""
    drive = replace(TOY, analyses=(Analysis("main", lambda spec, done: Answer(checks=checks(spec)), "what it is"),), adjustable=adjustable)
    install(monkeypatch.setattr, drive)
    return runner.run(from_document({"mechanism": "toy", **keys}))


def changed(result, advice):
    """Result of the design with the advice."""
    return runner.run(result.spec.replace({change.key: change.given for change in advice.changes}))


def at_most(name, value, limit, **more):
    return Check(name, value, limit, "<=", "-", name, **more)


@pytest.mark.analytical
def test_the_smallest_change_of_a_square_is_found_and_rounded(monkeypatch):
    def checks(spec):
        return (Check("area", spec.size**2, 2e-4, ">=", "m^2", "area"),)  # passes from 14.1421 mm

    advised = dw.advise(toy(monkeypatch, checks, {"size": 2.0}, size="10 mm"), None)
    (advice,) = advised.advice
    assert [(change.key, change.given) for change in advice.changes] == [("size", "14.2 mm")]
    assert advice.value == pytest.approx(0.0142**2)
    assert changed(advised, advice).ok


@pytest.mark.analytical
def test_a_high_power_gets_no_more_than_it_needs(monkeypatch):
    """As a life does, which grows with a high power of the rating: the whole range would give 60 000 times what is wanted."""

    def checks(spec):
        return (Check("life", (spec.size / 0.01) ** 8, 6.0, ">=", "-", "life"),)

    (advice,) = dw.advise(toy(monkeypatch, checks, {"size": 5.0}, size="10 mm"), None).advice
    (change,) = advice.changes
    needed = 0.01 * 6.0**0.125
    assert needed <= change.after <= needed + 0.25 * (needed - 0.01)


@pytest.mark.analytical
def test_a_dimension_is_made_smaller_where_that_helps(monkeypatch):
    for limit in (0.00771, 0.00776):  # the nearest number of two digits passes, and does not pass
        advised = dw.advise(toy(monkeypatch, lambda spec: (at_most("small", spec.size, limit),), {"size": 2.0}, size="10 mm"), None)  # noqa: B023
        assert advised.advice[0].changes[0].given == "7.7 mm"
        assert advised.advice[0].value == pytest.approx(0.0077)


@pytest.mark.property
def test_a_run_has_the_last_word_on_what_the_compiled_route_says(monkeypatch):
    def hopeful(spec, keys, names):
        return lambda designs: {name: 0.0085 - designs[:, keys.index("size")] for name in names}

    checks = lambda spec: (at_most("small", spec.size, 0.008),)  # noqa: E731
    result = toy(monkeypatch, checks, {"size": 2.0}, size="10 mm")
    drive = replace(registry.mechanism("toy"), batch=hopeful)
    monkeypatch.setattr(registry, "mechanism", lambda kind: drive)
    assert all(changed(result, advice).ok for advice in dw.advise(result, None).advice)


@pytest.mark.property
def test_no_change_beyond_the_factor_that_the_kind_allows(monkeypatch):
    result = toy(monkeypatch, lambda spec: (at_most("small", spec.size, 0.004),), {"size": 2.0}, size="10 mm")
    assert dw.advise(result, None).advice == ()
    result = toy(monkeypatch, lambda spec: (at_most("small", spec.size, 0.004),), {"size": 3.0}, size="10 mm")
    assert dw.advise(result, None).advice[0].changes[0].after == pytest.approx(0.004)


@pytest.mark.property
def test_two_dimensions_do_what_one_alone_cannot(monkeypatch):
    def checks(spec):
        return (Check("product", spec.size * spec.force, 0.06, ">=", "N m", "work"),)  # 0.02 now: either alone would have to grow 3-fold

    result = toy(monkeypatch, checks, {"size": 2.0, "force": 2.0}, size="10 mm", force="2 N")
    (advice,) = dw.advise(result, None).advice
    assert {change.key for change in advice.changes} == {"size", "force"}
    assert changed(result, advice).ok
    growth = [change.after / change.before for change in advice.changes]
    assert growth == pytest.approx([math.sqrt(3)] * 2, rel=0.1)  # equal factors: the shortest way


@pytest.mark.property
def test_a_change_that_breaks_no_other_check_is_preferred(monkeypatch):
    def checks(spec):
        return (Check("work", spec.size * spec.force, 0.03, ">=", "N m", "work"), at_most("small", spec.size, 0.011))

    result = toy(monkeypatch, checks, {"size": 3.0, "force": 2.0}, size="10 mm", force="2 N")
    (advice,) = dw.advise(result, None).advice
    assert [change.key for change in advice.changes] == ["force"] and advice.then_fails == ()
    (advice,) = dw.advise(toy(monkeypatch, checks, {"size": 3.0}, size="10 mm", force="2 N"), None).advice
    assert [change.key for change in advice.changes] == ["size"] and advice.then_fails == ("small",)


@pytest.mark.property
def test_other_checks_that_it_mends_are_named(monkeypatch):
    def checks(spec):
        return at_most("small", spec.size, 0.008), at_most("less small", spec.size, 0.009)

    advised = dw.advise(toy(monkeypatch, checks, {"size": 2.0}, size="10 mm"), None)
    assert [(each.check, each.also_passes) for each in advised.advice] == [("small", ("less small",)), ("less small", ())]


@pytest.mark.property
def test_the_bounds_of_optimise_are_kept(monkeypatch):
    table = {"unknowns": [{"key": "size", "lower": "9 mm", "upper": "11 mm"}], "objectives": [{"value": "size"}]}
    checks = lambda spec: (at_most("small", spec.size, 0.0085),)  # noqa: E731
    result = toy(monkeypatch, checks, {"size": 3.0}, size="10 mm", optimise=table)
    assert dw.advise(result, None).advice == ()
    table["unknowns"][0]["lower"] = "8 mm"
    result = toy(monkeypatch, checks, {"size": 3.0}, size="10 mm", optimise=table)
    assert 0.008 <= dw.advise(result, None).advice[0].changes[0].after <= 0.0085


@pytest.mark.property
def test_what_gets_no_advice(monkeypatch):
    passing = toy(monkeypatch, lambda spec: (at_most("small", spec.size, 1.0),), {"size": 2.0})
    chaotic = toy(monkeypatch, lambda spec: (at_most("small", spec.size, 0.008, low=0.005, high=0.02),), {"size": 2.0}, size="10 mm")
    absent = toy(monkeypatch, lambda spec: (at_most("small", math.inf, 0.008),), {"size": 2.0}, size="10 mm")
    blind = toy(monkeypatch, lambda spec: (at_most("small", 1.0, 0.008),), {"size": 2.0}, size="10 mm")
    assert [dw.advise(each, None).advice for each in (passing, chaotic, absent, blind)] == [()] * 4


@pytest.mark.interface
def test_advice_that_runs_out_of_time_says_so(monkeypatch):
    result = toy(monkeypatch, lambda spec: (at_most("small", spec.size, 0.008),), {"size": 2.0}, size="10 mm")
    advised = dw.advise(result, -1.0)
    assert advised.advice == () and advised.advice_stopped
    assert not dw.advise(result, None).advice_stopped


@pytest.mark.interface
def test_advice_on_one_check_that_leaves_keys_alone(monkeypatch):
    def checks(spec):
        return (at_most("small", spec.size, 0.008), at_most("smaller", spec.size, 0.007))

    result, tried = toy(monkeypatch, checks, {"size": 2.0}, size="10 mm"), []
    advised = dw.advise(result, None, checks=("small",), tried=tried.append)
    assert [(each.check, each.changes[0].given) for each in advised.advice] == [("small", "8 mm")]
    assert tried == list(range(1, len(tried) + 1)) and len(tried) > 3
    assert dw.advise(result, None, held=("size",)).advice == ()
    assert len(dw.advise(result, None).advice) == 2


@pytest.mark.interface
def test_a_result_keeps_its_advice(monkeypatch):
    advised = dw.advise(toy(monkeypatch, lambda spec: (at_most("small", spec.size, 0.008),), {"size": 2.0}, size="10 mm"), None)
    (record,) = advised.record()["advice"]
    assert record["check"] == "small" and record["changes"][0]["given"] == "8 mm"
    assert (record["changes"][0]["before"], record["changes"][0]["after"]) == (0.01, 0.008)


@pytest.mark.needs_pdf
def test_an_exported_report_says_what_to_change(monkeypatch, tmp_path):
    from drivewright.report import export, pdf

    given = []
    monkeypatch.setattr(pdf, "write_pdf", lambda result, path, form, **more: given.append(result))
    spec = toy(monkeypatch, lambda spec: (at_most("small", spec.size, 0.008),), {"size": 2.0}, size="10 mm").spec
    export.export(spec, ("pdf",), tmp_path)
    export.export(spec, ("pdf",), tmp_path, advise=dw.advise)
    assert [[advice.check for advice in result.advice] for result in given] == [[], ["small"]]


# -- real drives ---------------------------------------------------------------------------------------------------------------


@pytest.mark.property
def test_a_cam_that_is_too_steep_gets_a_larger_prime_radius():
    result = dw.run(dw.load(EXAMPLES / "disc_cam.toml").replace({"follower.prime_radius": "24 mm"}))
    advice = next(each for each in dw.advise(result, None).advice if each.check == "pressure_angle")
    (change,) = advice.changes
    assert change.key == "follower.prime_radius" and advice.then_fails == ()
    assert changed(result, advice).check("pressure_angle").ok
    less = change.before + 0.8 * (change.after - change.before)
    assert not dw.run(result.spec.replace({change.key: f"{less!r} m"})).check("pressure_angle").ok


@pytest.mark.analytical
def test_a_bearing_gets_the_static_rating_that_its_load_needs():
    result = dw.run(dw.load(EXAMPLES / "rubber_roller_shaft.toml"))
    check = result.check("static_safety.C")
    (advice,) = dw.advise(result, None).advice
    (change,) = advice.changes
    assert change.key == "bearings.C.static_rating"
    needed = change.before / check.value  # the safety is the rating over the load
    assert needed <= change.after <= needed + 0.25 * (needed - change.before)


KINDS = ("cam", "geneva", "indexer", "linkage", "seedling-pusher", "shaft", "silent-chain")


@pytest.mark.conformance
@pytest.mark.parametrize("kind", KINDS)
def test_every_adjustable_key_is_one_of_the_kind(kind):
    paths = [*registry.mechanism(kind).presets().values(), *EXAMPLES.glob("*.toml")]
    specs = [spec for spec in map(dw.load, paths) if spec.mechanism == kind]
    known = {each.key for spec in specs for each in dimensions(spec.model_copy(update={"optimise": None}))}
    patterns = registry.mechanism(kind).adjustable
    assert [pattern for pattern in patterns if not any(fnmatchcase(key, pattern) for key in known)] == []
    assert all(factor > 1 for factor in patterns.values())


# -- what a dimension may become -------------------------------------------------------------------------------------------------


def dimension(value, low, high):
    return Dimension("size", None, value, low, high)


@pytest.mark.analytical
def test_a_move_goes_by_equal_factors_to_either_end():
    """Half way from 4 to 16 is 8, half way down to 1 is 2; no move leads beyond an end."""
    each = dimension(4.0, 1.0, 16.0)
    assert [each.at(move) for move in (-1.0, -0.5, 0.0, 0.5, 1.0)] == pytest.approx([1.0, 2.0, 4.0, 8.0, 16.0])
    assert each.at(3.0) == pytest.approx(16.0) and each.at(-3.0) == pytest.approx(1.0)
    below = dimension(-4.0, -16.0, -1.0)
    assert [below.at(move) for move in (-0.5, 0.5)] == pytest.approx([-8.0, -2.0])


@pytest.mark.analytical
def test_a_move_from_or_through_zero_goes_by_equal_steps():
    assert [dimension(0.0, -2.0, 8.0).at(move) for move in (-0.5, 0.25, 0.5, 1.0)] == pytest.approx([-1.0, 2.0, 4.0, 8.0])
    assert dimension(2.0, -2.0, 8.0).at(-0.25) == pytest.approx(1.0), "the lower end has another sign: no factor leads there"


@pytest.mark.analytical
def test_a_step_is_a_fiftieth_of_the_value_to_the_side_that_has_room():
    """As a move over the wider side: 0.02*10/(30 - 10); of a key at 0 a fiftieth of a move; never more than half of one."""
    assert dimension(10.0, 9.0, 30.0).step == pytest.approx(0.01)
    assert dimension(10.0, 5.0, 10.0).step == pytest.approx(-0.04), "at its upper end it can only become smaller"
    assert dimension(0.0, -1.0, 2.0).step == pytest.approx(0.02)
    assert dimension(10.0, 9.9, 10.1).step == 0.5


@pytest.mark.property
def test_dimensions_have_room_and_their_ends_in_order(monkeypatch):
    """A negative value has its larger factor below; a key at 0, or whose ends are one, cannot be changed by factors."""
    install(monkeypatch.setattr, replace(TOY, adjustable={"offset": 2.0, "size": 4.0, "force": 1.0, "ratio": 3.0}))
    spec = from_document({"mechanism": "toy", "offset": "-4 mm", "size": "10 mm", "force": "2 N", "ratio": 0.0})
    found = {each.key: (each.low, each.value, each.high) for each in dimensions(spec)}
    assert found == {"offset": pytest.approx((-8e-3, -4e-3, -2e-3)), "size": pytest.approx((2.5e-3, 10e-3, 40e-3))}
