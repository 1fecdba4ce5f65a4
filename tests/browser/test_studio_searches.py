"""Searches and studies without text, and the correction of a failed check, by hand in a real browser."""

import pytest
from browsing import until
from studio_running import EXAMPLES, analysed

from drivewright.studio.opening import packed

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

STATE = "window.drivewright.state"
RADIUS = "follower.prime_radius"


@pytest.fixture
def cam(open_tab, studio):
    """Opens the cam, with its text changed, analysed."""

    def open_it(*changes, **settings):
        text = (EXAMPLES / "disc_cam.toml").read_text(encoding="utf-8")
        for before, after in changes:
            assert before in text
            text = text.replace(before, after)
        page = open_tab(f"{studio}/#{packed(text)}", **settings)
        analysed(page)
        return page

    return open_it


def value_of(page, key):
    """The number that a field of the design has."""
    return page.evaluate(f"key => {STATE}.design.form.groups.flatMap(group => group.fields).find(field => field.key === key).value", key)


def ended(page, job, seconds=200):
    until(page, f"{STATE}.jobs.{job}?.state === 'done'", seconds)


def test_a_search_is_set_up_run_and_loaded_without_text(cam):
    page = cam()
    assert "optimise" not in page.evaluate(f"{STATE}.design.toml")
    page.get_by_test_id("job-optimise").click()  # which opens the form, where there is no table yet
    page.get_by_test_id(f"search-key-{RADIUS}").check()
    assert page.get_by_test_id(f"search-lower-{RADIUS}").input_value() == "20 mm"
    page.get_by_test_id(f"search-lower-{RADIUS}").fill("30")
    assert page.get_by_test_id("search-start").is_disabled()  # nothing is wanted yet
    page.get_by_test_id("search-value-0").select_option("profile.max_radius")
    page.get_by_test_id("search-budget").fill("64")
    assert "designs" in page.get_by_test_id("search-estimate").inner_text()
    assert page.locator("[data-testid^=search-check-]:not(:checked)").count() == 0
    page.get_by_test_id("search-start").click()
    ended(page, "optimise")
    assert page.get_by_test_id("search-form").is_hidden() and page.get_by_test_id("history").is_visible()
    page.get_by_test_id("load-best").click()
    until(page, f"{STATE}.design.toml.includes('[[optimise.unknowns]]') && {STATE}.design.gen >= 3")
    analysed(page)
    assert page.evaluate(f"{STATE}.result.checks.every(check => check.ok)")
    assert 30 <= value_of(page, RADIUS) < 40
    for _ in range(2):  # the values of the best design, and the table: a step each
        page.get_by_test_id("undo").click()
    until(page, f"!{STATE}.design.toml.includes('optimise') && !{STATE}.design.undo")


@pytest.mark.slow
def test_a_form_that_is_refused_stays_with_the_reason(cam):
    page = cam()
    page.get_by_test_id("setup-study").click()
    page.get_by_test_id(f"study-key-{RADIUS}").check()
    page.get_by_test_id(f"study-way-{RADIUS}").select_option("normal")
    page.get_by_test_id(f"study-tolerance-{RADIUS}").fill("3 kg")
    page.get_by_test_id("study-start").click()
    page.get_by_test_id("study-refused").filter(has_text="wants a length, got '3 kg' (mass)").wait_for()
    page.get_by_test_id(f"study-tolerance-{RADIUS}").fill("2 %")
    page.get_by_test_id("study-samples").fill("4")
    page.get_by_test_id("study-start").click()
    ended(page, "study")
    assert page.get_by_test_id("study-form").is_hidden() and page.evaluate(f"{STATE}.jobs.study.answer.rows.length") == 4


@pytest.mark.slow
def test_a_study_of_nine_cases_is_set_up_run_and_a_row_loaded(cam):
    page = cam()
    page.get_by_test_id("job-study").click()
    for key, words, low, high in ((RADIUS, "prime radius", "36 mm", "44 mm"), ("drive.speed", "drive speed", "500 rpm", "1500 rpm")):
        page.get_by_test_id("study-find").fill(words)
        page.get_by_test_id(f"study-key-{key}").check()
        for box, text in (("from", low), ("to", high), ("steps", "3")):
            page.get_by_test_id(f"study-{box}-{key}").fill(text)
    assert "9 cases" in page.get_by_test_id("study-estimate").inner_text()
    page.get_by_test_id("study-start").click()
    ended(page, "study")
    until(page, f"{STATE}.view === 'study'")
    assert page.evaluate(f"{STATE}.jobs.study.answer.rows.length") == 9
    for number, label in ((0, "follower · prime radius [mm]"), (1, "drive · speed [rpm]")):
        page.locator(".sc-bar select").nth(number).select_option(label=label)
    canvas = page.locator(".sc-canvas")
    box = canvas.bounding_box()
    wide, high = box["width"] - 66 - 18, box["height"] - 14 - 46  # inside the axes, which reach 4 % beyond the points
    canvas.click(position={"x": 66 + wide * 1.04 / 1.08, "y": 14 + high * 0.04 / 1.08})
    until(page, f"{STATE}.design.toml.includes('prime_radius = \"44 mm\"')", 10)
    assert value_of(page, "drive.speed") == 1500


def test_a_failed_check_is_corrected_by_what_is_proposed(cam):
    page = cam(('prime_radius = "40 mm"', 'prime_radius = "24 mm"'))
    assert page.locator("[data-testid^=fix-]:visible").count() == 1  # the one check that fails
    page.get_by_test_id("fix-pressure_angle").click()
    page.get_by_test_id("fix-apply").wait_for(timeout=90_000)
    assert "instead of 24 mm" in page.get_by_test_id("fix-answer").inner_text().replace("\u00a0", " ")
    page.get_by_test_id("fix-apply").click()
    until(page, f"{STATE}.design.gen === 2")
    analysed(page)
    assert page.evaluate(f"{STATE}.result.checks.find(check => check.name === 'pressure_angle').ok") and value_of(page, RADIUS) > 24
    assert page.locator("[data-testid^=fix-]:visible").count() == 0
    page.get_by_test_id("undo").click()
    until(page, f"{STATE}.design.gen === 3 && !{STATE}.design.undo")
    assert value_of(page, RADIUS) == 24


def test_a_proposal_is_dismissed_and_says_why_there_is_none(cam):
    page = cam(('prime_radius = "40 mm"', 'prime_radius = "24 mm"'))
    page.evaluate(f"{STATE}.design.gen")
    page.get_by_test_id(f"field-{RADIUS}").hover()
    page.get_by_test_id(f"field-{RADIUS}").locator("[aria-pressed]").click()
    until(page, f"{STATE}.design.locks.includes('{RADIUS}')")
    page.get_by_test_id("fix-pressure_angle").click()
    page.get_by_test_id("fix-answer").filter(has_text="No change found").wait_for(timeout=90_000)
    assert page.get_by_test_id("fix-apply").is_hidden()
    page.get_by_test_id("fix-dismiss").click()
    page.get_by_test_id("fix-answer").wait_for(state="detached")
    assert value_of(page, RADIUS) == 24


@pytest.mark.slow
def test_sensitivity_opens_on_the_check_that_fails(cam):
    page = cam(('prime_radius = "40 mm"', 'prime_radius = "24 mm"'))
    page.get_by_test_id("job-sensitivity").click()
    ended(page, "sensitivity")
    assert page.locator(".sd-section[data-name=sensitivity] select").input_value() == "check.pressure_angle"
