"""The studio in a real browser: every kind of drive opens and moves, and everything that a hand can do to it."""

import os
import re
import signal
import subprocess
import time
import zipfile

import ezdxf
import pytest
from browsing import until
from studio_running import EXAMPLES, analysed, drawn, enter, field, free_port, running, shared

from drivewright.spec import load

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

ONE_OF_EACH = (  # four_bar is what the studio opens with, in nearly every other test
    "disc_cam",
    "hyvo_chain",
    *(pytest.param(name, marks=pytest.mark.slow) for name in ("seedling_pusher", "four_bar", "pressure_roller_shaft", "pin_indexer")),
)
FRAME = """async () => {
  const canvas = document.querySelector('.dw-canvas');
  const wait = () => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
  const seen = () => { const c = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    let sum = 0; for (let i = 0; i < c.length; i += 4) sum = (sum * 31 + c[i] + 3 * c[i + 1] + 7 * c[i + 2]) % 1000000007; return sum; };
  const first = seen(); for (let n = 0; n < 12; n++) await wait(); return [first, seen()];
}"""
STATE = "window.drivewright.state"


@pytest.fixture(scope="module")
def studio():
    with running(free_port(), EXAMPLES / "four_bar.toml") as (address, process):
        yield address, process


@pytest.fixture
def tab(open_tab):
    """Opens tabs, their drawings at rest or in motion."""
    return lambda address, width=1440, height=900, motion="reduce": open_tab(address, width, height, reduced_motion=motion)


@pytest.mark.parametrize("name", ONE_OF_EACH)
def test_every_kind_opens_and_moves(studio, tab, name):
    page = tab(shared(studio[0], name), motion="no-preference")
    assert page.evaluate(f"{STATE}.design.title") == load(EXAMPLES / f"{name}.toml").title
    before, after = page.evaluate(FRAME)
    assert before != after
    analysed(page)
    assert page.locator("[data-testid^=check-]").count() >= 3
    assert page.locator("[data-testid^=field-]").count() >= 5
    assert page.get_by_test_id("player").is_visible()


def test_a_slider_changes_the_drawing_and_a_check(studio, tab):
    page = tab(studio[0])
    analysed(page)
    key = "bodies.crank.points.A.0"
    checks = page.evaluate(f"JSON.stringify({STATE}.result.checks)")
    scene = page.evaluate(f"{STATE}.scene.scene.motions.join()")
    box, slider = field(page, key).locator("input").first, page.get_by_test_id(f"slider-{key}")
    before = box.input_value()
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    until(page, f"{STATE}.design.gen > 1")
    drawn(page)
    assert box.input_value() != before
    assert page.evaluate(f"{STATE}.scene.scene.motions.join()") != scene
    analysed(page)
    assert page.evaluate(f"JSON.stringify({STATE}.result.checks)") != checks


def test_drawings_that_come_together_are_shown_one_a_frame_and_none_of_the_drive_before(studio, tab):
    page = tab(studio[0])
    analysed(page)
    seen = page.evaluate(
        """async () => {
          const store = window.drivewright, {scene, design} = store.state, frame = () => new Promise(done => requestAnimationFrame(done));
          const json = JSON.stringify({scene: scene.scene}), message = gen => JSON.stringify({what: "scene", gen, json});
          const hear = gen => window.socket.listeners("studio").forEach(act => act(message(gen)));
          const now = () => store.state.scene.gen - design.gen;
          await frame();
          for (const n of [1, 2, 3]) hear(design.gen + n);
          const first = now();
          await frame();
          const second = now();
          await frame();
          hear(design.opened - 1);
          return [first, second, now()];
        }"""
    )
    assert seen == [1, 3, 3]


def test_a_bad_value_shows_its_message_and_loses_nothing(studio, tab):
    page = tab(studio[0])
    analysed(page)
    key = "drive.speed"
    toml = page.evaluate(f"{STATE}.design.toml")
    for text, words in (("3 kg", "wants an angular speed, got '3 kg' (mass)"), ("fast", "'fast' is not \"number unit\"")):
        enter(page, key, text)
        page.get_by_test_id(f"message-{key}").filter(has_text=words).wait_for()
        assert field(page, key).locator("input").first.input_value() == text
        assert page.evaluate(f"{STATE}.design.toml") == toml
    enter(page, key, "301 rpm")
    until(page, f"{STATE}.design.toml.includes('301 rpm')")
    page.get_by_test_id(f"message-{key}").wait_for(state="hidden")


def test_an_impossible_design_says_so_and_keeps_the_drawing(studio, tab):
    page = tab(studio[0])
    analysed(page)
    enter(page, "bodies.crank.points.A.0", "900 mm")
    until(page, f"Object.values({STATE}.refused).length > 0")
    assert page.evaluate(f"{STATE}.scene.scene !== null")
    assert page.evaluate("[...document.querySelectorAll('[data-testid^=message-]')].some(e => e.innerText.length > 20)")
    assert page.get_by_test_id("verdict").inner_text() == "no solution"
    page.get_by_test_id("undo").click()
    until(page, f"Object.values({STATE}.refused).length === 0")
    analysed(page)


def test_another_design_begins_with_nothing_of_the_one_before(studio, tab):
    page = tab(studio[0])
    analysed(page)
    enter(page, "drive.speed", "3 kg")
    page.get_by_test_id("message-drive.speed").wait_for()
    page.get_by_test_id("tab-text").click()
    page.get_by_test_id("toml").fill("a draft")
    spec = (EXAMPLES / "slider_crank_clearance.toml").read_text(encoding="utf-8")
    page.get_by_test_id("open-files").set_input_files({"name": "mine.toml", "mimeType": "text/plain", "buffer": spec.encode()})
    until(page, f"{STATE}.design.name === 'mine'")
    assert page.evaluate(f"Object.keys({STATE}.refused).length") == 0
    assert page.get_by_test_id("toml").input_value() == page.evaluate(f"{STATE}.design.toml")
    drawn(page)


def test_a_new_design_starts_from_a_picture(studio, tab):
    page = tab(studio[0])
    page.get_by_test_id("new").click()
    cards = page.locator(".st-card")
    until(page, "[...document.querySelectorAll('.st-card img')].slice(0, 6).every(image => image.complete && image.naturalWidth === 480)")
    assert cards.count() == page.locator(".st-card img").count() > 40
    page.get_by_test_id("example-oscillating_cam").click()  # it has a data file
    until(page, f"{STATE}.design.name === 'oscillating_cam' && !document.querySelector('.st-popover')")
    drawn(page)
    page.get_by_test_id("keys").click()
    until(page, "[...document.querySelectorAll('.st-drawing img')].some(image => image.complete && image.naturalWidth > 300)")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.slow
def test_cancelled_analyses_can_be_begun_again(studio, tab):
    page = tab(shared(studio[0], "hyvo_chain"))
    analysed(page)
    for speed in range(2990, 2999):
        enter(page, "drive.speed", f"{speed} rpm")
        until(page, f"{STATE}.work.state === 'analysing'")
        page.evaluate("document.querySelector('[data-testid=cancel-look]').click()")
        page.wait_for_timeout(300)
        if page.evaluate(f"{STATE}.work.state") == "stopped":
            break
    assert not page.evaluate(f"{STATE}.result.full")
    page.get_by_test_id("analyse").click()
    analysed(page)


def test_undo_and_redo(studio, tab):
    page = tab(studio[0])
    first = page.evaluate(f"{STATE}.design.toml")
    enter(page, "drive.speed", "281 rpm")
    until(page, f"{STATE}.design.toml.includes('281 rpm')")
    page.get_by_test_id("undo").click()
    until(page, f"!{STATE}.design.toml.includes('281 rpm')")
    assert page.evaluate(f"{STATE}.design.toml") == first
    page.get_by_test_id("redo").click()
    until(page, f"{STATE}.design.toml.includes('281 rpm')")
    assert field(page, "drive.speed").locator("input").first.input_value() == "281 rpm"


def test_compare_draws_the_design_before(studio, tab):
    page = tab(studio[0])
    analysed(page)
    page.get_by_test_id("compare").click()
    if page.evaluate(f"{STATE}.reference === null"):
        page.get_by_text("Pin this design").first.click()
    until(page, f"{STATE}.reference !== null")
    pinned = page.evaluate(f"{STATE}.reference.scene.motions.join()")
    enter(page, "bodies.crank.points.A.0", "35 mm")
    until(page, f"{STATE}.design.toml.includes('35 mm')")
    analysed(page)
    assert page.evaluate(f"{STATE}.reference.scene.motions.join()") == pinned != page.evaluate(f"{STATE}.scene.scene.motions.join()")
    until(page, f"Object.values({STATE}.result.differences.values).some(text => text !== '0')")
    told = [text for text in page.locator(".sd-number em").all_inner_texts() if text]
    assert told and all(" · " in text for text in told) and any("%" in text for text in told)


def test_export_downloads_a_dxf_that_audits_clean(studio, tab, tmp_path):
    page = tab(shared(studio[0], "disc_cam"))
    analysed(page)
    with page.expect_download(timeout=60_000) as coming:
        page.get_by_test_id("export-dxf").click()
    assert re.fullmatch(r"[\w.-]+", coming.value.suggested_filename)
    path = tmp_path / coming.value.suggested_filename
    coming.value.save_as(path)
    if path.suffix == ".zip":
        with zipfile.ZipFile(path) as packed:
            packed.extractall(tmp_path)
    found = list(tmp_path.glob("*.dxf"))
    assert found
    for file in found:
        assert not ezdxf.readfile(file).audit().errors


def test_a_chinese_page_tells_what_keys_mean_and_downloads_its_report_with_solids(studio, tab, tmp_path):
    page = tab(studio[0])
    name = page.locator('[data-testid="field-bodies.crank.mass"] .st-name').first
    assert name.get_attribute("title") == "bodies.crank.mass\nmass" and page.evaluate(f"{STATE}.hints === null")
    page.get_by_test_id("language").click()
    until(page, f"{STATE}.hints !== null")
    assert name.get_attribute("title") == "bodies.crank.mass\n质量"
    page.get_by_test_id("dock-drawing").click()
    drawing = page.locator(".st-dock img").first
    until(page, "document.querySelector('.st-dock img').naturalWidth > 0")
    assert drawing.get_attribute("src") == "/web/drawing.linkage.zh.svg"
    page.get_by_test_id("report-menu").click()
    with page.expect_download(timeout=60_000) as coming:
        page.get_by_role("menuitem", name="含实体运动的报告").click()
    coming.value.save_as(tmp_path / "report.html")
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert '"solids":{' in report and "设计校核" in report


def test_a_reload_keeps_the_design(studio, tab):
    page = tab(studio[0])
    enter(page, "drive.speed", "277 rpm")
    until(page, f"{STATE}.design.toml.includes('277 rpm')")
    page.reload()
    until(page, "window.drivewright !== undefined", 30)
    drawn(page)
    assert page.evaluate(f"{STATE}.design.toml").count("277 rpm") == 1


def test_two_tabs_do_not_disturb_each_other(studio, tab):
    one, other = tab(studio[0]), tab(shared(studio[0], "disc_cam"))
    enter(one, "drive.speed", "266 rpm")
    until(one, f"{STATE}.design.toml.includes('266 rpm')")
    drawn(one)
    assert other.evaluate(f"{STATE}.design.kind") != one.evaluate(f"{STATE}.design.kind")
    assert "266 rpm" not in other.evaluate(f"{STATE}.design.toml")
    assert other.evaluate(f"{STATE}.design.gen") == 1


def workers(server):
    """Ids of the server's computing processes."""
    found = subprocess.run(["pgrep", "-P", str(server.pid), "-f", "spawn_main"], capture_output=True, text=True, check=False).stdout
    return [int(pid) for pid in found.split()]


def test_workers_killed_at_rest_are_replaced(studio, tab):
    page = tab(studio[0])
    analysed(page)
    before = workers(studio[1])
    for pid in before:
        os.kill(pid, signal.SIGKILL)
    enter(page, "drive.speed", "264 rpm")
    drawn(page)
    analysed(page)
    end = time.monotonic() + 60
    while not (now := workers(studio[1])) and time.monotonic() < end:  # a new one begins when there is something to compute
        time.sleep(0.1)
    assert now and not set(now) & set(before)


@pytest.mark.slow
def test_a_worker_killed_at_work_is_reported(studio, tab):
    page = tab(shared(studio[0], "hyvo_chain"))
    analysed(page)
    for speed in range(3000, 3020):
        enter(page, "drive.speed", f"{speed} rpm")
        until(page, f"{STATE}.work.state === 'analysing'")
        for pid in workers(studio[1]):
            os.kill(pid, signal.SIGKILL)
        page.wait_for_timeout(500)
        if "was ended by signal 9" in page.evaluate(f"{STATE}.notice"):
            break
    assert page.get_by_text("was ended by signal 9").is_visible()
    enter(page, "drive.speed", "2999 rpm")
    drawn(page)
    analysed(page)


def test_a_script_that_gets_into_the_page_is_not_run(studio, browser):
    """The policy itself, in a browser: no inline script or handler, no style attribute, nothing from outside, no frame."""
    context = browser.new_context()
    try:
        page = context.new_page()
        refused = []
        page.on("console", lambda said: refused.append(said.text) if said.type == "error" else None)
        page.goto(studio[0])
        until(page, "window.drivewright !== undefined", 30)
        page.evaluate("""() => {
          const script = document.createElement('script'); script.textContent = 'window.got = 1'; document.body.append(script);
          const other = document.createElement('script'); other.src = 'https://evil.example/x.js'; document.body.append(other);
          const box = document.createElement('div');
          box.innerHTML = '<img src="/none" onerror="window.got = 2"><b style="color: red">x</b>';
          document.body.append(box);
          fetch('https://evil.example/').catch(() => { window.kept = true; }); }""")
        until(page, "window.kept === true", 10)
        page.wait_for_timeout(300)
        assert page.evaluate("window.got") is None
        assert len([text for text in refused if "Content Security Policy" in text]) >= 4
        frame = context.new_page()
        frame.goto("about:blank")
        frame.set_content(f'<iframe src="{studio[0]}"></iframe>')
        frame.wait_for_timeout(500)
        assert all("drivewright" not in (each.title() or "").lower() for each in frame.frames)
    finally:
        context.close()


@pytest.mark.slow
def test_analyses_that_take_too_long_can_run_longer(studio, tab):
    page = tab(studio[0])
    analysed(page)
    page.evaluate("window.drivewright.set({work: {state: 'over', text: 'motion', seconds: 120, done: 0, total: 0}})")
    button = page.get_by_test_id("analyse-longer")
    assert button.inner_text() == "Run it longer" and "motion took more than 120 s and was ended" in page.locator(".sd-line").inner_text()
    page.get_by_test_id("analyse-longer").click()
    until(page, f"{STATE}.work.state === 'analysing' || {STATE}.work.state === 'idle'", 10)
    analysed(page)
    assert page.get_by_test_id("analyse-longer").is_hidden()
