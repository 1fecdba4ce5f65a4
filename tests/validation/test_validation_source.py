"""What a printed number means, and how the verdict follows from it."""

import math

import pytest

from drivewright import plugins, validation
from drivewright.errors import InputError, UnitError, UnknownName
from drivewright.validation import AGREES, EXPLAINED, OPEN, Explanation, Printed, Row, Source, rounded

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
    ],
)
def test_a_printed_number_is_all_that_rounds_to_it(text, unit, low, high):
    printed = rounded(text, unit)
    assert (printed.low, printed.high) == pytest.approx((low, high), rel=1e-12)
    assert str(printed) == text


def test_a_printed_number_in_the_wrong_unit_is_refused():
    with pytest.raises(UnitError, match="wants an angle"):
        rounded("50.22 mm", "rad")


@pytest.mark.parametrize(("degrees", "verdict"), [(50.2151, AGREES), (50.2249, AGREES), (50.2149, OPEN), (50.2251, OPEN), (math.nan, OPEN)])
def test_verdict_without_an_explanation(degrees, verdict):
    assert row(degrees * DEGREE).verdict == verdict


def test_an_explanation_must_give_the_printed_number():
    assert row(48.0 * DEGREE, explanation=Explanation("another reading", 50.22 * DEGREE)).verdict == EXPLAINED
    assert row(48.0 * DEGREE, explanation=Explanation("another reading", 50.3 * DEGREE)).verdict == OPEN
    assert row(48.0 * DEGREE, explanation=Explanation("a misprint")).verdict == EXPLAINED
    assert row(50.22 * DEGREE, explanation=Explanation("another reading", 0.0)).verdict == AGREES


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
    assert "| quantity | table 1 | published table | 50.22 deg | 57.2958 deg | +7.08 deg | differs, open [1] |" in page
    assert "| 50.22 deg | 50.22 deg | +0 deg | agrees |" in page
    assert "- [1] Odd." in page and "- Assumed: a size." in page and "- Erratum: A fault." in page
