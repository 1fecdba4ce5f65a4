"""What a printed number means, and how the verdict follows from it."""

import math

import pytest

from drivewright import plugins, validation
from drivewright.errors import InputError, UnitError, UnknownName
from drivewright.validation import (
    AGREES,
    BASES,
    CALIBRATED,
    COMPUTED,
    EXPLAINED,
    NOT_COMPARED,
    OPEN,
    PRINT_ONLY,
    VERDICTS,
    Explanation,
    Printed,
    Row,
    Source,
    about,
    best_verdicts,
    counts,
    evaluated,
    rounded,
)
from drivewright.validation.source import EVALUATED, IMPLIED, implied

pytestmark = pytest.mark.analytical

DEGREE = math.pi / 180


def row(ours, printed="50.22 deg", unit="rad", **more):
    return Row("quantity", rounded(printed, unit), ours, unit, AGREES, "published table", "table 1", **more)


@pytest.mark.parametrize(
    ("text", "unit", "low", "high"),
    [
        ("50.22 deg", "rad", 50.215 * DEGREE, 50.225 * DEGREE),
        ("253 deg", "rad", 252.5 * DEGREE, 253.5 * DEGREE),
        ("0.2 mm", "m", 0.15e-3, 0.25e-3),
        ("-23.15", "-", -23.155, -23.145),
        ("60.0", "-", 59.95, 60.05),
        ("+3 kN", "N", 2500, 3500),
        ("4.560e11 min", "s", 4.5595e11 * 60, 4.5605e11 * 60),
        ("-1.5e-3 m", "m", -1.55e-3, -1.45e-3),
        ("3e2", "-", 250, 350),
        ("0.340e4", "-", 3395, 3405),
        ("2.0e+3", "-", 1950, 2050),
    ],
)
def test_a_printed_number_is_all_that_rounds_to_it(text, unit, low, high):
    printed = rounded(text, unit)
    assert (printed.low, printed.high) == pytest.approx((low, high), rel=1e-12)
    assert str(printed) == text


def test_a_text_that_does_not_begin_with_a_number_is_refused():
    with pytest.raises(InputError, match=r"the printed value 'about 3 N' does not begin with a number; write e\.g\."):
        rounded("about 3 N", "N")


def test_a_printed_number_in_the_wrong_unit_is_refused():
    with pytest.raises(UnitError, match="wants an angle"):
        rounded("50.22 mm", "rad")


@pytest.mark.parametrize(("degrees", "verdict"), [(50.2151, AGREES), (50.2249, AGREES), (50.2149, OPEN), (50.2251, OPEN), (math.nan, OPEN)])
def test_verdict_without_an_explanation(degrees, verdict):
    assert row(degrees * DEGREE).verdict == verdict


def test_an_explanation_must_give_the_printed_number():
    assert row(48.0 * DEGREE, explanation=Explanation("another reading", 50.22 * DEGREE)).verdict == EXPLAINED
    assert row(48.0 * DEGREE, explanation=Explanation("another reading", 50.3 * DEGREE)).verdict == OPEN
    assert row(48.0 * DEGREE, explanation=Explanation("another reading", math.nan)).verdict == OPEN
    assert row(50.22 * DEGREE, explanation=Explanation("another reading", 0.0)).verdict == AGREES


def test_a_text_alone_is_no_explanation():
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'value'"):
        Explanation("a misprint")


def test_an_explanation_cannot_lean_on_the_interval_of_our_number():
    """Ours is far off and certain to 0.1 deg; the other reading has no interval to hide in."""
    spread = {"low": 47.95 * DEGREE, "high": 48.05 * DEGREE}
    assert row(48.0 * DEGREE, explanation=Explanation("another reading", 50.2 * DEGREE), **spread).verdict == OPEN
    assert row(48.0 * DEGREE, explanation=Explanation("another reading", 50.22 * DEGREE), **spread).verdict == EXPLAINED


# -- what a number rests on ------------------------------------------------------------------------------------------------------


def test_bases_and_verdicts():
    assert BASES == (COMPUTED, CALIBRATED, PRINT_ONLY) == ("computed", "calibrated", "print-only")
    assert VERDICTS == (AGREES, EXPLAINED, OPEN, NOT_COMPARED) == ("agrees", "differs, explained", "differs, open", "not compared")


@pytest.mark.parametrize("degrees", [50.22, 48.0])
@pytest.mark.parametrize("basis", [CALIBRATED, PRINT_ONLY])
def test_only_a_computed_number_is_compared(basis, degrees):
    """Not even an explanation or an interval make evidence of it."""
    made = row(degrees * DEGREE, basis=basis, explanation=Explanation("another reading", 50.22 * DEGREE), low=0.0, high=3.0)
    assert (made.verdict, made.deviation_text()) == (NOT_COMPARED, "")
    assert "no evidence" in made.commentary and made.commentary.endswith("another reading")
    assert row(50.22 * DEGREE, basis=COMPUTED).verdict == AGREES


def test_nothing_beside_the_print_is_not_compared():
    nothing = row(None, basis=PRINT_ONLY, note="A mesh of others.")
    assert (nothing.verdict, nothing.deviation, nothing.deviation_text()) == (NOT_COMPARED, None, "")
    assert (row(None).verdict, row(None).deviation_text()) == (NOT_COMPARED, "")
    page = validation.page([Source("mine", "A book", lambda: [nothing])])
    assert "| quantity | table 1 | published table | 50.22° |  |  | not compared [1] |" in page
    assert "- [1] From the print alone: no evidence. A mesh of others." in page


# -- intervals -------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ours", "low", "high", "verdict"),
    [
        (51.0, 50.0, 52.0, AGREES),  # the printed number lies inside
        (51.0, 50.2149, 52.0, AGREES),  # all that rounds to it
        (51.0, 50.22, 52.0, OPEN),  # only a part of what the print means
        (51.0, 50.5, 51.5, OPEN),
        (50.22, 50.219, 50.221, AGREES),  # narrower than the print's rounding
        (50.0, 49.0, 50.2249, OPEN),
    ],
)
def test_a_printed_number_agrees_where_it_lies_in_the_interval(ours, low, high, verdict):
    assert row(ours * DEGREE, low=low * DEGREE, high=high * DEGREE).verdict == verdict


@pytest.mark.parametrize(
    ("limit", "ours", "low", "high", "verdict"),
    [
        (Printed("below 1", -math.inf, 1.0), 0.8, 0.6, 0.99, AGREES),
        (Printed("below 1", -math.inf, 1.0), 0.8, 0.6, 1.01, OPEN),  # the number keeps it, its interval does not
        (Printed("above 1", 1.0, math.inf), 1.2, 1.01, 1.4, AGREES),
        (Printed("above 1", 1.0, math.inf), 1.2, 0.99, 1.4, OPEN),
        (Printed("above 1", 1.0, math.inf), 0.9, 0.5, 1.3, OPEN),
    ],
)
def test_an_interval_keeps_a_printed_limit_as_a_whole(limit, ours, low, high, verdict):
    assert Row("ratio", limit, ours, "-", AGREES, "other code", "here", low=low, high=high).verdict == verdict


def test_half_an_interval_is_none():
    assert row(51.0 * DEGREE, low=50.0 * DEGREE).verdict == OPEN
    assert row(51.0 * DEGREE, high=52.0 * DEGREE).verdict == OPEN


# -- readings and records --------------------------------------------------------------------------------------------------------


def named(name, degrees, reading_of="", **more):
    return Row(name, rounded("50.22 deg", "rad"), degrees * DEGREE, "rad", AGREES, "experiment", "here", reading_of=reading_of, **more)


def test_the_best_verdict_among_the_readings_of_a_printed_number():
    other = Explanation("another reading", 50.22 * DEGREE)
    readings = [
        named("one", 48.0, "angle"),
        named("two", 48.0, "angle", explanation=other),
        named("three", 50.22, "angle", basis=CALIBRATED),
    ]
    assert best_verdicts(readings) == {"angle": EXPLAINED}
    assert best_verdicts(readings[::-1]) == {"angle": EXPLAINED}
    assert best_verdicts([*readings, named("angle", 50.22)]) == {"angle": AGREES}, "a row without reading_of is its own number"
    assert best_verdicts([readings[2], named("height", 48.0)]) == {"angle": NOT_COMPARED, "height": OPEN}
    assert best_verdicts([]) == {}


def test_a_record_has_the_keys_of_rows_json_and_no_others():
    made = row(48.0 * DEGREE, low=47.0 * DEGREE, high=49.0 * DEGREE)
    assert made.record("mine") == {
        "source": "mine",
        "where": "table 1",
        "quantity": "quantity",
        "printed": "50.22 deg",
        "ours": 48.0 * DEGREE,
        "low": 47.0 * DEGREE,
        "high": 49.0 * DEGREE,
        "unit": "rad",
        "basis": "computed",
        "verdict": "differs, open",
    }


def test_a_record_of_an_exact_number_has_itself_for_both_ends_and_of_none_none():
    exact, nothing = row(48.0 * DEGREE).record("mine"), row(None, basis=PRINT_ONLY).record("mine")
    assert exact["low"] == exact["ours"] == exact["high"] == 48.0 * DEGREE
    assert (nothing["ours"], nothing["low"], nothing["high"], nothing["verdict"]) == (None, None, None, NOT_COMPARED)


def test_a_note_explains_nothing():
    noted = row(48.0 * DEGREE, note="It is late.")
    assert (noted.verdict, noted.commentary) == (OPEN, "It is late.")


def test_deviation_is_from_the_number_or_beyond_the_limit():
    assert row(48.176 * DEGREE).deviation_text() == "-2.04 deg"
    assert row(50.22 * DEGREE * (1 + 1e-15)).deviation_text() == "+0 deg"
    limit = Printed(">= 1", 1.0, math.inf)
    below, just, above = (Row("ratio", limit, value, "-", AGREES, "closed form", "here") for value in (0.86, 1.0, 1.12))
    assert (below.deviation_text(), below.verdict) == ("-0.14", OPEN)
    assert (above.deviation_text(), above.verdict) == (just.deviation_text(), just.verdict) == ("+0", AGREES)


def test_deviation_from_a_range_is_how_far_beyond_it():
    def off(value, printed):
        return Row("ratio", printed, value, "-", AGREES, "closed form", "here").deviation

    assert [off(value, Printed("5 to 25", 5.0, 25.0)) for value in (4.0, 5.0, 19.6, 26.5)] == [-1.0, 0.0, 0.0, 1.5]
    assert [off(value, about("about 50", 50.0, 5.0)) for value in (48.0, 50.0, 60.0)] == [-2.0, 0.0, 10.0], "a number is printed"


def test_a_number_stands_in_the_unit_of_its_print():
    life = Row("life", rounded("4.560e11 min", "s"), 4.5e11 * 60, "s", OPEN, "other code", "here")
    assert life.shown_unit == (pytest.approx(1 / 60), "min") and life.deviation_text() == "-6e+09 min"
    assert Row("life", Printed("long", 0.0, 1.0), 2.0, "s", OPEN, "other code", "here").shown_unit[1] == "s"


def test_evaluated_formulas_are_counted_apart():
    formula = evaluated("12.34 mm", "m")
    assert str(formula) == "12.34 mm, evaluated" and formula[1:3] == rounded("12.34 mm", "m")[1:3]
    rows = [named("angle", 50.22), named("height", 48.0)]
    rows.append(Row("length", formula, 0.01234, "m", AGREES, "closed form", "eq. (1)"))
    assert counts(rows) == {AGREES: 1, EXPLAINED: 0, OPEN: 1, NOT_COMPARED: 0}
    assert counts(rows, EVALUATED) == {AGREES: 1, EXPLAINED: 0, OPEN: 0, NOT_COMPARED: 0}


def test_what_a_text_implies_is_counted_apart():
    expected = Row("ratio", implied("above 1", 1.0, math.inf), 1.2, "-", AGREES, "closed form", "here")
    assert str(expected.printed) == "above 1, implied" and expected.verdict == AGREES
    assert sum(counts([expected]).values()) == 0 and counts([expected], IMPLIED)[AGREES] == 1


def test_an_idealised_number_explains_and_never_agrees():
    claim = Printed("below 1", -math.inf, 1.0)
    rigid = Row("ratio, rigid", claim, 0.5, "-", EXPLAINED, "other code", "here", reading_of="ratio", idealised=True)
    running = Row("ratio, running", claim, 2.4, "-", OPEN, "other code", "here", reading_of="ratio", low=2.2, high=2.6)
    assert (rigid.verdict, running.verdict) == (EXPLAINED, OPEN)
    assert counts([rigid, running]) == {AGREES: 0, EXPLAINED: 1, OPEN: 0, NOT_COMPARED: 0}


def test_an_unknown_source_is_named_with_its_neighbour():
    with pytest.raises(UnknownName, match=r"no validation source is called 'pusher-papr' \(did you mean 'pusher-paper'\?\)"):
        validation.sources("pusher-papr")


def plugged(monkeypatch, **sources):
    monkeypatch.setattr(plugins, "installed", lambda group: sources if group == "drivewright.validation" else {})
    monkeypatch.setattr(plugins, "load", lambda group, name: sources[name])


def test_a_plug_in_adds_a_source(monkeypatch):
    plugged(monkeypatch, mine=Source("mine", "A book", lambda: [row(50.22 * DEGREE)]))
    assert [source.name for source in validation.sources()][-1] == "mine"
    assert [found.verdict for found in validation.sources("mine")[0].rows()] == [AGREES]


def test_a_plug_in_does_not_replace_a_source(monkeypatch):
    plugged(monkeypatch, mine=Source("pusher-paper", "Another", tuple))
    with pytest.raises(InputError, match="two validation sources are called 'pusher-paper'; rename or uninstall"):
        validation.sources()


def test_page_numbers_each_remark_once():
    rows = [row(1.0, note="Odd."), row(50.22 * DEGREE), row(2.0, note="Odd.", assumed="a size")]
    page = validation.page([Source("mine", "A book", lambda: rows, ("A fault.",))])
    assert page.count("[1]") == 3 and "[2]" not in page
    assert "| quantity | table 1 | published table | 50.22° | 57.2958° | +7.08° | differs, open [1] |" in page
    assert "| 50.22° | 50.22° | +0° | agrees |" in page
    assert "- [1] Odd." in page and "- Assumed: a size." in page and "- Erratum: A fault." in page
