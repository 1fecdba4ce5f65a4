"""The report in a real browser: it plays, scrubs, switches frames and themes, and sleeps when nobody looks."""

import math

import numpy as np
import pytest
from browsing import until

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser]

PHASE = "drivewright.clock.phase"
PIXELS = """() => { const c = document.querySelector('.dw-canvas'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  let h = 0; for (let i = 0; i < d.length; i += 4) h = (h * 31 + d[i] * 65536 + d[i + 1] * 256 + d[i + 2]) >>> 0; return h; }"""
DATA = """() => { const c = document.querySelector('.dw-canvas'); return c.getContext('2d').getImageData(0, 0, c.width, c.height).data; }"""
FRAME = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"


def settle(page):
    page.evaluate(FRAME)


def still(page, phase=0.0):
    page.evaluate(f"() => {{ drivewright.clock.pause(); drivewright.clock.set({phase}); }}")
    settle(page)
    return page


def shown(page, phase=0.0):
    still(page, phase)
    return page.evaluate(PIXELS)


def colour_at(page, x, y):
    """Colour of the canvas at a CSS pixel."""
    return page.evaluate(
        """([x, y]) => { const c = document.querySelector('.dw-canvas'), k = c.width / c.clientWidth;
      return [...c.getContext('2d').getImageData(x * k, y * k, 1, 1).data]; }""",
        [x, y],
    )


def test_it_plays_by_itself_and_the_picture_changes(open_page, report):
    page = open_page(report)
    first = page.evaluate(PIXELS)
    until(page, f"{PHASE} > 0.02")
    until(page, f"(({PIXELS})()) !== {first}")
    assert page.evaluate("drivewright.clock.playing && drivewright.clock.running")


def test_a_reader_who_wants_no_motion_gets_none(open_page, report):
    page = open_page(report, reduced_motion="reduce")
    assert not page.evaluate("drivewright.clock.playing")


def test_the_same_phase_is_the_same_picture_and_the_cycle_closes(open_page, report):
    page = open_page(report)
    assert shown(page, 0.25) == shown(page, 0.25) != shown(page, 0.3)
    page.evaluate("() => drivewright.player.highlight([])")
    at_end = shown(page, 1.0)
    assert at_end == shown(page, 0.0)


def test_the_loop_sleeps_when_paused_or_out_of_sight(open_page, report):
    page = open_page(report, height=700)
    until(page, "drivewright.clock.running")
    page.evaluate("() => scrollTo(0, document.body.scrollHeight)")
    until(page, "!drivewright.clock.running && drivewright.clock.playing")
    page.evaluate("() => scrollTo(0, 0)")
    until(page, "drivewright.clock.running")
    page.keyboard.press("Tab")
    page.locator(".dw-canvas").focus()
    page.keyboard.press("Space")
    until(page, "!drivewright.clock.running && !drivewright.clock.playing")


@pytest.mark.slow
def test_the_pace_is_one_cycle_in_four_seconds_and_follows_the_speed(open_page, report):
    page = open_page(report)
    drive = """speed => new Promise(done => { const c = drivewright.clock; c.setSpeed(speed); c.play();
      let start = 0; const began = []; const stop = c.subscribe(() => {
        const now = performance.now(), at = c.turn + c.phase; if (!began.length) began.push(now, at);
        if (now - began[0] > 500) { stop(); done((at - began[1]) / (now - began[0]) * 1000); } }); })"""

    def pace(speed):
        """Turns per second; the best of some measurements, for a busy machine drops frames and the player does not catch up."""
        return min((page.evaluate(drive, speed) for _ in range(6)), key=lambda measured: abs(measured - speed / 4))

    assert pace(1) == pytest.approx(0.25, rel=0.15) and pace(4) == pytest.approx(1.0, rel=0.15)
    page.select_option(".dw-speed", label="real time")
    assert page.evaluate("drivewright.clock.speed") == pytest.approx(4 / 0.3)
    assert page.locator(".dw-rate").inner_text() == "real time"
    page.select_option(".dw-speed", label="0.1×")
    assert page.locator(".dw-rate").inner_text() == "133× slow motion"


def test_dragging_in_a_plot_moves_player_readout_and_every_cursor(open_page, report):
    page = still(open_page(report), 0.1)
    before = page.evaluate(PIXELS)
    cover = page.locator(".dw-cover").nth(1)
    box = cover.bounding_box()
    left, right = box["x"] + 52, box["x"] + box["width"] - 14
    page.mouse.move(left + 0.2 * (right - left), box["y"] + 60)
    page.mouse.down()
    page.mouse.move(left + 0.75 * (right - left), box["y"] + 60, steps=4)
    page.mouse.up()
    settle(page)
    assert page.evaluate(PHASE) == pytest.approx(0.75, abs=0.01)
    assert page.evaluate(PIXELS) != before
    assert page.locator(".dw-value").inner_text() == f"{360 * page.evaluate(PHASE):.1f}°"
    places = page.evaluate("""[...document.querySelectorAll('.dw-cursor')].map(
      c => c.getBoundingClientRect().x - c.parentElement.getBoundingClientRect().x)""")
    assert len(places) == 5 and max(places) - min(places) < 1.5


def test_running_values_are_the_tables(open_page, report):
    from sample_designs import four_bar_result

    page = still(open_page(report), 0.4)
    motion = four_bar_result().tables["motion"]
    angle = 0.4 * 2 * math.pi
    expected = [
        np.degrees(np.interp(angle, motion["angle"].data, motion["rocker"].data)),
        np.interp(angle, motion["angle"].data, motion["rocker_speed"].data) * 30 / math.pi,
    ]
    # The panels of the plot that shows the failed check, speed and acceleration, come first.
    texts = [page.locator(".dw-plot-values b").nth(n).inner_text().replace("−", "-") for n in (2, 0)]
    assert [float(t) for t in texts] == pytest.approx(expected, abs=0.051)


def test_where_a_column_has_no_value_the_reader_sees_a_dash(open_page, report):
    page = still(open_page(report), 0.0)
    assert page.locator(".dw-plot").nth(4).locator("b").inner_text() == "–"


def crank_alone(page):
    for other in ("frame", "coupler", "rocker"):
        page.locator(".dw-chip", has_text=other).click()
    return page


def orange(page, x, y):
    """Whether the crank covers a point of the plane [m]."""
    spot = page.evaluate(f"[drivewright.player.view.toX({x}), drivewright.player.view.toY({y})]")
    red, _, blue, _ = colour_at(page, *spot)
    return red - blue > 25


def test_a_body_is_drawn_where_its_pose_says(open_page, report):
    """The crank at a quarter turn: a bar 10 mm wide with round ends, from the pivot 32 mm straight up."""
    page = still(crank_alone(open_page(report)), 0.25)
    assert all(orange(page, x, y) for x, y in ((0.003, 0.016), (-0.003, 0.016), (0.0, 0.0355), (0.0, -0.0035)))
    assert not any(orange(page, x, y) for x, y in ((0.007, 0.016), (-0.007, 0.016), (0.0, 0.039), (0.0, -0.007), (0.016, 0.0)))


def test_a_turning_observer_sees_the_common_pin_at_rest(open_page, report):
    """Seen from the coupler, whose origin is the crank pin, the crank's end stays there while its other end goes round."""
    page = crank_alone(open_page(report))
    page.evaluate("() => drivewright.player.setFrame('coupler')")
    for phase in (0.1, 0.45, 0.8):
        still(page, phase)
        assert orange(page, 0.0, 0.0)
    from sample_designs import CRANK, solve

    coupler, _, _ = solve(np.array([0.8 * 2 * np.pi]))
    along = CRANK * np.exp(1j * (0.8 * 2 * np.pi - coupler[0]))
    assert orange(page, -0.5 * along.real, -0.5 * along.imag) and not orange(page, 0.5 * along.real, 0.5 * along.imag)


def test_the_clock_counts_turns_both_ways(open_page, report):
    page = still(open_page(report), 0.9)
    forth = page.evaluate("() => { const c = drivewright.clock; c.turn = 3; c.step(0.2); return [c.turn, c.phase]; }")
    back = page.evaluate("() => { const c = drivewright.clock; c.step(-1.3); return [c.turn, c.phase]; }")
    assert forth == [4, pytest.approx(0.1)] and back == [2, pytest.approx(0.8)]


def test_frames_switch(open_page, report):
    page = open_page(report)
    machine = shown(page, 0.3)
    page.get_by_role("button", name="field frame").click()
    assert page.evaluate("document.querySelector('#player').dataset.frame") == "field"
    assert page.get_by_role("button", name="field frame").get_attribute("aria-pressed") == "true"
    assert shown(page, 0.3) != machine
    page.get_by_role("button", name="machine frame").click()
    assert shown(page, 0.3) == machine


def test_the_field_carries_on_from_cycle_to_cycle_without_a_jump(open_page, report):
    """Soil, grid and machine at the end of one cycle are those at the start of the next; only the way drawn so far starts anew."""
    page = open_page(report)
    page.evaluate("() => drivewright.player.setFrame('field')")

    def difference(turn):
        """Share of pixels that change from the end of a cycle to the start of the given one."""
        still(page, 1.0)
        page.evaluate(f"() => {{ window.before = ({DATA})(); drivewright.clock.turn += {turn}; }}")
        still(page, 0.0)
        return page.evaluate(f"""() => {{ const now = ({DATA})(); let n = 0;
          now.forEach((v, i) => {{ n += Math.abs(v - before[i]) > 12; }}); return n / now.length; }}""")

    assert difference(1) < 0.004
    assert difference(0) > 0.008  # the grid stays behind


def test_ghosts_highlight_and_hiding_change_the_picture_and_come_back(open_page, report):
    page = open_page(report)
    plain = shown(page, 0.3)
    for change, undo in (("setGhosts(true)", "setGhosts(false)"), ("highlight(['rocker'])", "highlight([])")):
        page.evaluate(f"() => drivewright.player.{change}")
        assert shown(page, 0.3) != plain
        page.evaluate(f"() => drivewright.player.{undo}")
        assert shown(page, 0.3) == plain
    chip = page.locator(".dw-chip", has_text="coupler")
    chip.click()
    assert chip.get_attribute("aria-pressed") == "false" and shown(page, 0.3) != plain
    chip.click()
    assert shown(page, 0.3) == plain


def test_a_check_lights_its_parts(open_page, report):
    page = open_page(report)
    plain = shown(page, 0.3)
    page.locator(".check[data-parts='rocker']").hover()
    assert shown(page, 0.3) != plain
    page.mouse.move(5, 5)
    assert shown(page, 0.3) == plain


def test_pan_zoom_and_fit(open_page, report):
    page = open_page(report)
    plain = shown(page, 0.3)
    box = page.locator(".dw-canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.wheel(0, -300)
    assert shown(page, 0.3) == plain, "the wheel scrolls the page until the canvas has the focus"
    page.evaluate("() => scrollTo(0, 0)")
    page.mouse.down()
    page.mouse.move(x + 80, y + 30, steps=3)
    page.mouse.up()
    panned = shown(page, 0.3)
    assert panned != plain
    scale = page.evaluate("drivewright.player.view.scale")
    page.mouse.wheel(0, -300)
    until(page, f"drivewright.player.view.scale > {scale * 1.3}")
    page.keyboard.press("f")
    assert shown(page, 0.3) == plain


def test_keys_step_and_jump(open_page, report):
    page = still(open_page(report), 0.5)
    page.locator(".dw-canvas").focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate(PHASE) == pytest.approx(0.5 + 1 / 360)
    page.keyboard.press("Shift+ArrowLeft")
    assert page.evaluate(PHASE) == pytest.approx(0.5 - 9 / 360)
    page.keyboard.press("Home")
    assert page.evaluate(PHASE) == 0
    page.keyboard.press("ArrowLeft")
    assert page.evaluate(PHASE) == pytest.approx(1 - 1 / 360)


def test_marks_on_the_scrubber(open_page, report):
    page = still(open_page(report), 0.1)
    assert page.locator(".dw-phase").inner_text() == "forward + 36.0°"
    page.locator(".dw-mark[title=return]").click()
    settle(page)
    assert page.evaluate(PHASE) == pytest.approx(2.6 / 2 / math.pi) and page.locator(".dw-phase").inner_text() == "return + 0.0°"
    page.locator(".dw-range").fill("0.9")
    assert page.evaluate(PHASE) == pytest.approx(0.9)


def test_dark_by_preference_and_by_the_button(open_page, report):
    light, dark = open_page(report), open_page(report, color_scheme="dark")
    for page, ground in ((light, [251, 252, 254]), (dark, [18, 22, 28])):
        still(page, 0.3)
        assert ground in [colour_at(page, x, 200)[:3] for x in (3, 4, 5)]
    first = shown(light, 0.3)
    assert first != shown(dark, 0.3)
    light.locator("#theme").click()
    until(light, f"(({PIXELS})()) !== {first}")
    assert shown(light, 0.3) == shown(dark, 0.3)
    assert light.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(14, 18, 22)"


def test_sharp_on_a_dense_screen_and_whole_on_a_phone(open_page, report):
    page = open_page(report, width=400, height=800, device_scale_factor=3)
    ratio = page.evaluate("(() => { const c = document.querySelector('.dw-canvas'); return c.width / c.clientWidth; })()")
    assert ratio == pytest.approx(3, abs=0.01)
    assert page.evaluate("document.documentElement.scrollWidth") <= 400


def test_two_fingers_zoom(open_page, report):
    page = still(open_page(report, has_touch=True), 0.3)
    scale = page.evaluate("drivewright.player.view.scale")
    box = page.locator(".dw-canvas").bounding_box()
    touch = page.context.new_cdp_session(page)
    x, y = box["x"] + 300, box["y"] + 250

    def fingers(kind, apart):
        points = [{"x": x - apart, "y": y, "id": 0}, {"x": x + apart, "y": y, "id": 1}] if apart else []
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    fingers("touchStart", 40)
    for apart in (50, 60, 70, 80):
        fingers("touchMove", apart)
    fingers("touchEnd", 0)
    assert page.evaluate("drivewright.player.view.scale") == pytest.approx(2 * scale, rel=0.05)


def test_on_paper_everything_is_open_and_the_player_gives_way(open_page, report):
    page = open_page(report)
    page.emulate_media(media="print")
    page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
    assert page.evaluate("[...document.querySelectorAll('details:not(#si)')].every(d => d.open)")
    assert not page.locator("#player").is_visible() and page.locator(".gallery img").first.is_visible()
    page.evaluate("() => dispatchEvent(new Event('afterprint'))")
    assert not page.evaluate("document.querySelector('#spec').open")


def test_the_pictures_load(open_page, report):
    page = open_page(report)
    page.evaluate("() => { document.querySelector('#figures').open = true; }")
    until(page, "[...document.querySelectorAll('.gallery img')].every(i => i.complete && i.naturalWidth > 300)")
    assert page.locator(".gallery img").count() == 2


def test_without_javascript_the_numbers_are_there(open_page, report, browser):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(report)
    assert "55.134" in page.locator("main").inner_text()
    context.close()


def test_destroyed_players_leave_nothing_behind(open_page, report):
    page = open_page(report)
    page.evaluate("() => { drivewright.player.destroy(); drivewright.plots.destroy(); }")
    until(page, "!drivewright.clock.running")
    assert page.evaluate("document.querySelector('#player').childElementCount + document.querySelector('#plots').childElementCount") == 0
