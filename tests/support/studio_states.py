"""Everything that the studio's page can show: each state with how to come there and back, at any width."""

from typing import NamedTuple

from browsing import until
from studio_running import EXAMPLES

from drivewright.studio.opening import packed

STATE = "window.drivewright.state"
RADIUS = "follower.prime_radius"
DISTANCE = ("|handle ground.points.O2", "coupler|handle bodies.coupler.points.C")  # in the four-bar
SPECS = {  # {name: (example, changes of its text)}
    "four_bar": ("four_bar", ()),
    "cam": ("disc_cam", ()),
    "failing_cam": ("disc_cam", (('prime_radius = "40 mm"', 'prime_radius = "24 mm"'),)),
    "shaft": ("pressure_roller_shaft", ()),
    "pusher": ("seedling_pusher", ()),
}


class State(NamedTuple):
    """What is open: `scope` is the part of the page that is looked at, all of it where it is None."""

    name: str
    spec: str
    open: object
    close: object = lambda page: None
    scope: str | None = None


def address_of(address, spec):
    """Address that opens a design of SPECS."""
    name, changes = SPECS[spec]
    text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    return f"{address}/#{packed(text)}"


def _click(*names):
    def act(page):
        for name in names:
            page.get_by_test_id(name).click()

    return act


def _narrow(page):
    return page.viewport_size["width"] < 900


def _pane(name, *more):
    """One of the tabs of a small screen, and buttons in it."""

    def act(page):
        if _narrow(page):
            page.get_by_test_id(f"pane-{name}").click()
        _click(*more)(page)

    return act


def _bar(name):
    """A button of the bar, which is behind another one on a small screen."""

    def act(page):
        if _narrow(page) and name != "new":
            page.get_by_test_id("more").click()
        page.get_by_test_id(name).click()
        page.locator(".st-popover").wait_for()

    return act


def _escape(page):
    for _ in range(2):
        page.keyboard.press("Escape")


def _done(job, seconds=200):
    return f"{STATE}.jobs.{job}?.state === 'done'", seconds


def _measure(page):
    _pane("mechanism", "measure", "measure-distance")(page)
    for feature in DISTANCE:
        page.get_by_test_id("measure-point").select_option(feature)
        page.get_by_test_id("measure-pick").click()


def _form(name):
    def act(page):
        _pane("checks", f"setup-{name}")(page)
        page.get_by_test_id(f"{'search' if name == 'optimise' else name}-key-{RADIUS}").check()

    return act


def _build(page):
    _pane("mechanism", "build")(page)
    until(page, f"Array.isArray({STATE}.scene?.missing)", 60)


def _spline(page):
    """The programme with a spline, and one of its points chosen."""
    _pane("mechanism", "view-programme")(page)
    page.get_by_test_id("programme-law").select_option("spline")
    page.get_by_test_id("programme-point-0-2").wait_for(state="visible")
    page.get_by_test_id("programme-point").fill("3")


def _job(view_or_pane, job, *buttons):
    def act(page):
        view_or_pane(page)
        _click(*buttons)(page)
        until(page, *_done(job))

    return act


def _fix(page):
    _pane("checks", "fix-pressure_angle")(page)
    page.get_by_test_id("fix-apply").wait_for(timeout=90_000)


STATES = (
    State("form", "four_bar", _pane("form")),
    State("text", "four_bar", _pane("form", "tab-text"), _click("tab-form")),
    State("drawing beside the form", "four_bar", _pane("form", "dock-drawing"), _click("dock-drawing")),
    State("mechanism", "four_bar", _pane("mechanism")),
    State("checks", "four_bar", _pane("checks")),
    State("plots", "four_bar", _pane("plots")),
    State("choice of plots", "four_bar", _pane("plots", "plot-picker"), _escape, ".st-popover"),
    State("kept run", "four_bar", _pane("plots", "run-keep")),
    State("more of the bar", "four_bar", lambda page: _narrow(page) and page.get_by_test_id("more").click(), _escape, ".st-bar"),
    State("new", "four_bar", _bar("new"), _escape, ".st-popover"),
    State("share", "four_bar", _bar("share"), _escape, ".st-popover"),
    State("compare", "four_bar", _bar("compare-menu"), _escape, ".st-popover"),
    State("measure", "four_bar", _measure, _click("measure-drop", "measure")),
    State("build", "four_bar", _build, _click("build")),
    State("figures", "four_bar", _pane("mechanism", "view-figures"), _click("view-motion")),
    State("form of a cam", "cam", _pane("form")),
    State("checks of a cam", "cam", _pane("checks")),
    State("keys", "cam", _bar("keys"), _escape, ".st-popover"),
    State("programme", "cam", _pane("mechanism", "view-programme", "programme-segment-0"), _click("view-motion")),
    State("points of a spline", "cam", _spline, _click("undo", "view-motion")),
    State("search form", "cam", _form("optimise"), _click("search-close"), ".st-side"),
    State("study form", "cam", _form("study"), _click("study-close"), ".st-side"),
    State("sensitivity", "cam", _job(_pane("checks"), "sensitivity", "job-sensitivity"), scope=".st-side"),
    State("correction", "failing_cam", _fix, _click("fix-dismiss"), ".st-side"),
    State("shaft with diagrams", "shaft", _pane("mechanism")),
    State("form of a shaft", "shaft", _pane("form")),
    State("checks of a shaft", "shaft", _pane("checks")),
    State("plots of a shaft", "shaft", _pane("plots")),
    State("mechanism of the pusher", "pusher", _pane("mechanism")),
    State("programme of the pusher", "pusher", _pane("mechanism", "view-programme", "programme-segment-3"), _click("view-motion")),
    State("solids of the pusher", "pusher", _job(_pane("mechanism"), "solid", "view-solid"), _click("view-motion")),
)
