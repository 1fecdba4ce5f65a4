"""One Chromium for all browser tests, and a report page made once."""

import re

import pytest
from browsing import until
from studio_running import EXAMPLES, drawn, free_port, running

COMPLAINTS, OURS = ("error", "warning"), re.compile("getImageData|ReadPixels")  # reading a canvas is what the tests do


@pytest.fixture(scope="session")
def browser(chromium):
    sync_api = pytest.importorskip("playwright.sync_api")
    path, flags = chromium
    with sync_api.sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=path, args=[*flags, "--disable-gpu"])
        yield running
        running.close()


@pytest.fixture(scope="session")
def studio():
    """Address of a studio for the tests of one process; every page of it is a design of its own, first the four-bar."""
    with running(free_port(), EXAMPLES / "four_bar.toml") as (address, _):
        yield address


@pytest.fixture
def open_tab(browser):
    """Opens tabs of a studio, their drawings at rest, for they keep a core busy; afterwards none may have complained, or asked for
    anything outside."""
    contexts, complaints = [], []

    def open_it(address, width=1440, height=900, **settings):
        settings = {"reduced_motion": "reduce", "accept_downloads": True, **settings}
        context = browser.new_context(viewport={"width": width, "height": height}, **settings)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        own = (address.partition("#")[0], "ws", "data:", "blob:")
        page.on("request", lambda request: None if request.url.startswith(own) else complaints.append(request.url))
        page.goto(address)
        until(page, "window.drivewright !== undefined", 30)
        drawn(page)
        return page

    yield open_it
    for context in contexts:
        context.close()
    assert complaints == []


@pytest.fixture(scope="session")
def report(tmp_path_factory):
    """Address of the sample's report.html with two pictures."""
    from sample_designs import PLOTS, all_views, four_bar_result

    from drivewright.report.content import Views, pictures
    from drivewright.report.html import write_report

    result = four_bar_result()
    drawn = pictures(result, Views(None, PLOTS[:2]))
    return write_report(result, all_views(), tmp_path_factory.mktemp("report"), drawn).as_uri()


@pytest.fixture
def open_page(browser):
    """Opens an address in a fresh context; afterwards the page must have asked for nothing outside and complained about nothing."""
    contexts, complaints = [], []

    def open_it(address, width=1300, height=1500, **settings):
        context = browser.new_context(viewport={"width": width, "height": height}, **settings)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: complaints.append(said.text) if said.type in COMPLAINTS and not OURS.search(said.text) else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: None if request.url.startswith(("data:", "file:")) else complaints.append(request.url))
        page.goto(address)
        until(page, "!window.drivewright || document.querySelector('#player').dataset.phase !== undefined")
        return page

    yield open_it
    for context in contexts:
        context.close()
    assert complaints == []
