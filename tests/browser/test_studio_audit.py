"""Every state of the studio's page on a phone and on a tablet: what is there can be reached, read and hit by a finger."""

import re

import pytest
from browsing import until
from places import ROOT
from studio_running import analysed
from studio_states import SPECS, STATES, address_of

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

AUDIT = (ROOT / "tests" / "support" / "page_audit.js").read_text(encoding="utf-8")
SIZES = {390: 844, 820: 1180, 1440: 900}
FEW = [pytest.param(spec, marks=[] if spec == "failing_cam" else [pytest.mark.slow]) for spec in SPECS]  # one of them in the short run


@pytest.fixture
def tab(browser, studio):
    """Opens a tab with a design at a width."""
    contexts = []

    def open_it(spec, width, lang="en", theme="light"):
        size = {"width": width, "height": SIZES[width]}
        context = browser.new_context(viewport=size, reduced_motion="reduce", has_touch=width < 900, color_scheme=theme)
        contexts.append(context)
        page = context.new_page()
        page.goto(address_of(studio, spec))
        until(page, "window.drivewright !== undefined", 30)
        analysed(page)
        page.evaluate("lang => window.drivewright.set({lang})", lang)
        return page

    yield open_it
    for context in contexts:
        context.close()


def found(page, state, what, *more):
    """What an audit finds wrong with a state."""
    return [f"{state.name}: {one}" for one in page.evaluate(f"given => {AUDIT}.{what}(...given)", [state.scope, *more])]


def audited(page, spec, audits):
    """What the audits find in all states of a design, {name: further arguments}."""
    wrong = []
    for state in (state for state in STATES if state.spec == spec):
        state.open(page)
        page.wait_for_timeout(200)  # a frame or two: what has just opened is laid out
        for what, more in audits.items():
            wrong += found(page, state, what, *more)
        state.close(page)
    return wrong


@pytest.mark.slow
@pytest.mark.parametrize("spec", SPECS)
@pytest.mark.parametrize("width", [390, 820])
def test_everything_can_be_reached_read_and_named(tab, spec, width):
    audits = {"controls": [True], "panels": [], "cut": [], "nameless": []}
    assert audited(tab(spec, width), spec, audits) == []


@pytest.mark.slow
@pytest.mark.parametrize("spec", SPECS)
def test_everything_fits_in_chinese_on_a_phone(tab, spec):
    assert audited(tab(spec, 390, "zh"), spec, {"controls": [True], "panels": [], "cut": []}) == []


# What stays as it is in Chinese: names in the spec, the name of the program, formats of files, units, and values as they are typed.
UNITS = r"[-−\d.,~/\s×⁻⁰¹²³]*(mm|MPa|GPa|mPa s|rpm|rad|deg|arcmin|min|kg|N|m|s|[\s/·^²])+"
KEPT = re.compile(
    rf'"(Drivewright|English|inch|(DXF|SVG|CSV|STEP|STL|GCODE|PDF)|{UNITS})" '
    r'|^option |^title |aria-label "[^"]*: [-\d]|16MnCr5|^placeholder "[\w-]+"|st-group-title|group-[\w.]+$'
)


@pytest.mark.parametrize("spec", [spec for spec in FEW if spec.values[0] != "shaft"])
def test_no_english_word_is_left_in_chinese(tab, spec):
    wrong = audited(tab(spec, 1440, "zh"), spec, {"english": []})
    assert [one for one in wrong if not KEPT.search(one.partition(": ")[2])] == []


# What is drawn and not written: lines of plots and of kept runs, handles, the bubble beside one, the mark of the focus.
LINES = ("blue", "orange", "green", "violet", "steel", "ground", "cursor", "accent", "bad", *(f"run-{n}" for n in range(1, 5)))
PAIRS = [
    *((line, ground, 3) for line in LINES for ground in ("surface", "canvas")),
    *((text, ground, 4.5) for text in ("ink", "muted", "accent", "good", "warn", "bad") for ground in ("surface", "canvas", "raised")),
    *((tone, f"{tone}-soft", 4.5) for tone in ("good", "warn", "bad")),
    ("surface", "ink", 4.5),
    ("surface", "accent", 4.5),
]
OUTDATED = """({drivewright: store}) => {
  const {result} = store.state, checks = result.checks.map(check => ({...check, stale: true}));
  store.set({result: {...result, full: false, verdict: {...result.verdict, stale: true}, checks}});
}"""


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_colours_stand_out(tab, theme):
    page = tab("four_bar", 1440, theme=theme)
    assert page.evaluate(f"pairs => {AUDIT}.colours(pairs)", PAIRS) == []


@pytest.mark.parametrize("spec", FEW)
@pytest.mark.parametrize(("theme", "lang"), [("light", "en"), pytest.param("dark", "zh", marks=pytest.mark.slow)])
def test_every_text_and_every_sign_stands_out(tab, spec, theme, lang):
    page = tab(spec, 1440, lang, theme)
    assert audited(page, spec, {"contrast": []}) == []
    page.evaluate(f"() => ({OUTDATED})(window)")  # what a change has overtaken is still to be read
    assert page.locator(".sd-card.is-stale").count() > 0
    assert page.evaluate(f"() => {AUDIT}.contrast()") == []
