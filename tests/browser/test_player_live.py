"""The player and the plots under a design that changes: what stays, what follows, what is compared, enlarged, clicked."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from browsing import until
from sample_designs import PLOTS, four_bar_result, four_bar_scene

from drivewright.report import html
from drivewright.report.pack import pack_plot_groups, pack_scene
from drivewright.scene import Body, Frame, Scene, Shape, polygon
from drivewright.view.palette import style_sheet

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser]

PAGE = """<!doctype html><meta charset="utf-8">
<style>{style} body {{ margin: 0 }} #host {{ height: 600px; width: 900px }} .far {{ height: 3000px }}</style>
<div id="host"></div><div id="plots"></div><script type="module">{script}
window.picked = [];
const clock = createClock();
window.live = {{clock, poseOf, player: null, plots: null,
  start(scene, text) {{ live.player = createPlayer(host, scene, {{clock, text, picked: name => picked.push(name)}}); }},
  plot(packed) {{ live.plots = createPlots(plots, packed, {{clock}}); }}}};
</script>"""
FRAME = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))))"
PIXELS = """() => { const c = document.querySelector('.dw-canvas'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  let h = 0; for (let i = 0; i < d.length; i += 4) h = (h * 31 + d[i] * 65536 + d[i + 1] * 256 + d[i + 2]) >>> 0; return h; }"""
ORANGE = """() => { const c = document.querySelector('.dw-canvas'), v = live.player.view;
  const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  let n = 0, x = 0, y = 0;
  for (let i = 0; i < d.length; i += 4) if (d[i] - d[i + 2] > 25) { n++; x += i / 4 % c.width; y += Math.floor(i / 4 / c.width); }
  return [(x / n + 0.5 - v.width / 2) / v.scale + v.centre[0], (v.height / 2 - y / n - 0.5) / v.scale + v.centre[1]]; }"""
CURVE = "n => { const c = document.querySelectorAll('.dw-plot-canvas')[n]; return c.toDataURL(); }"


@pytest.fixture
def page(open_page, tmp_path):
    style = style_sheet() + (Path(html.__file__).parent / "player.css").read_text(encoding="utf-8")
    (tmp_path / "live.html").write_text(PAGE.format(style=style, script=html.scripts()), encoding="utf-8")
    return open_page((tmp_path / "live.html").as_uri(), width=920, height=1000)


def settle(page):
    page.evaluate(FRAME)
    return page.evaluate(PIXELS) if page.locator(".dw-canvas").count() else None


def call(page, what, *data):
    """Calls a method of the page's player or plots with plain data and lets it draw."""
    page.evaluate(f"data => {{ live.{what}(...data); }}", [json.loads(json.dumps(one)) for one in data])
    return settle(page)


def packed(crank=1.0, **more):
    """The four-bar with all bodies larger by a factor."""
    scene = four_bar_scene()
    bodies = tuple(replace(body, poses=body.poses * (crank, crank, 1.0)) for body in scene.bodies)
    return pack_scene(replace(scene, bodies=bodies)) | more


def block(poses, **more):
    shape = Shape("body", polygon([(-0.01, -0.01), (0.01, -0.01), (0.01, 0.01), (-0.01, 0.01)]))
    return Body("block", "block, deflection × 50", (shape,), poses, "orange", **more)


def lifted(**more):
    """A block that stands at rest at (0, 0) and is drawn at (30, 20) mm, and a frame around that holds the window."""
    still = np.zeros((5, 3))
    edge = Body("edge", "edge", (Shape("base", polygon([(-0.15, -0.1), (0.15, -0.1), (0.15, 0.1), (-0.15, 0.1)])),), still, "ground")
    raised = still + (0.03, 0.02, 0.0)
    return pack_scene(
        Scene(
            np.linspace(0, 1, 5),
            "time",
            "s",
            1.0,
            (edge, block(raised, rest=still, magnified=50.0, **more)),
            (Frame("machine", "machine frame", still),),
        )
    )


def framed(size):
    """A frame 300 mm wide, times a size, and nothing else."""
    still = np.zeros((5, 3))
    edge = Body("edge", "edge", (Shape("base", polygon(size * np.array([(-0.15, -0.1), (0.15, -0.1), (0.15, 0.1), (-0.15, 0.1)]))),), still)
    return pack_scene(Scene(np.linspace(0, 1, 5), "time", "s", 1.0, (edge,), (Frame("machine", "machine frame", still),)))


# -- live updates --------------------------------------------------------------------------------------------------------------


def test_an_update_keeps_what_the_reader_has_set(page):
    call(page, "start", packed())
    for act in ("player.setFrame('coupler')", "player.setGhosts(true)", "clock.set(0.3)"):
        page.evaluate(f"() => {{ live.{act}; }}")
    page.locator(".dw-chip", has_text="rocker").click()
    page.mouse.move(450, 300)
    page.mouse.down()
    page.mouse.move(520, 340, steps=3)
    page.mouse.up()
    page.keyboard.press("+")
    settle(page)
    state = "JSON.stringify([live.player.view.scale, live.player.view.centre, live.player.frame, live.clock.phase, host.dataset.frame])"
    page.evaluate("() => { window.chip = document.querySelector('.dw-chip'); }")
    before, picture = page.evaluate(state), settle(page)
    after = call(page, "player.load", packed(1.3))
    assert page.evaluate(state) == before and after != picture
    assert page.evaluate("chip.isConnected"), "the controls are the same and stay"
    assert page.locator(".dw-chip", has_text="rocker").get_attribute("aria-pressed") == "false"
    assert page.locator("[title^=Ghost]").get_attribute("aria-pressed") == "true"
    assert call(page, "player.load", packed()) == picture


def test_other_labels_make_other_controls_that_remember(page):
    call(page, "start", packed())
    page.locator(".dw-chip", has_text="rocker").click()
    changed = packed()
    changed["bodies"][2]["label"] = "handle"
    changed["observers"] = changed["observers"][:1]
    call(page, "player.load", changed)
    assert [chip.inner_text() for chip in page.locator(".dw-chip").all()] == ["frame", "coupler", "handle", "rocker"]
    assert page.locator(".dw-chip[aria-pressed=false]").inner_text() == "rocker"
    assert page.locator(".dw-segments").count() == 0


def test_the_window_holds_still_until_the_scene_leaves_it_or_gets_small(page):
    call(page, "start", framed(1.0))
    scale, moved = "live.player.view.scale", []
    first = page.evaluate(scale)
    for size in (0.98, 0.9, 0.5, 0.3):
        call(page, "player.load", framed(size))
        moved.append(page.evaluate(scale) != first)
    assert moved == [False, False, False, True]
    small = page.evaluate(scale)
    assert small == pytest.approx(first / 0.3)
    call(page, "player.load", framed(1.0))
    assert page.evaluate(scale) == pytest.approx(first)
    page.keyboard.press("Tab")
    page.locator(".dw-canvas").focus()
    page.keyboard.press("-")
    own = page.evaluate(scale)
    call(page, "player.load", framed(0.1))
    assert page.evaluate(scale) == own, "a view of the reader's own is left alone"


def test_a_drawing_tells_its_generation(page):
    call(page, "start", packed(gen=7))
    assert page.evaluate("host.dataset.gen") == "7"
    before = page.evaluate(PIXELS)
    draw = "next => { live.player.load(next); requestAnimationFrame(() => { window.early = host.dataset.gen; }); }"
    page.evaluate(draw, packed(0.9, gen=8))
    until(page, "window.early")
    assert page.evaluate("early") == "8" and page.evaluate(PIXELS) != before, "drawn in the next frame: a person waits for it"


def test_outlines_with_the_same_text_are_not_decoded_again(page):
    call(page, "start", packed())
    page.evaluate("() => { const real = atob; window.decoded = []; window.atob = text => { decoded.push(text); return real(text); }; }")
    call(page, "player.load", packed(1.1))
    shapes = {shape["points"] for shape in packed()["shapes"]}
    texts = set(page.evaluate("decoded"))
    assert texts and not texts & shapes


def test_real_time_stays_real_time_when_the_period_changes(page):
    call(page, "start", packed())
    page.select_option(".dw-speed", label="real time")
    call(page, "player.load", packed() | {"period": 2.0})
    assert page.evaluate("live.clock.speed") == pytest.approx(4 / 2.0) and page.locator(".dw-rate").inner_text() == "real time"
    call(page, "player.load", packed() | {"period": None})
    assert page.evaluate("live.clock.speed") == 1 and page.locator(".dw-speed").input_value() == "1"


def test_every_word_can_be_another_language_s(page):
    page.evaluate("scene => live.start(scene, english => `<${english}>`)", packed())
    words = page.evaluate("""() => [...document.querySelectorAll('#host [title], #host [aria-label], .dw-chip, .dw-segments button')]
      .flatMap(e => [e.title, e.getAttribute('aria-label'), e.children.length ? '' : e.textContent]).filter(Boolean)""")
    assert len(words) > 20 and [word for word in words if not word.startswith("<")] == ["0.0°"]


def test_traces_go_and_come_with_their_key(page):
    call(page, "start", packed())
    plain = settle(page)
    page.locator(".dw-canvas").focus()
    page.keyboard.press("t")
    assert settle(page) != plain
    page.locator("[title^=Paths]").click()
    assert settle(page) == plain


# -- exaggeration --------------------------------------------------------------------------------------------------------------


def test_the_exaggerated_pose_is_the_rest_and_so_many_times_the_way_from_it(page):
    pose = """scale => live.poseOf({motion: [1, 2, 0.5, 3, 6, 0.9], rest: [0, 1, 0.4], most: 2.5}, 0, 0.5, scale)"""
    assert page.evaluate(pose, 0) == pytest.approx([0, 1, 0.4])
    assert page.evaluate(pose, 1) == pytest.approx([2, 4, 0.7])
    assert page.evaluate(pose, 2) == pytest.approx([4, 7, 1.0])
    assert page.evaluate(pose, 3) == pytest.approx([5, 8.5, 1.15]), "no further than it may"
    assert page.evaluate("live.poseOf({motion: [1, 2, 3]}, 0, 0, 2)") == [1, 2, 3]


@pytest.mark.parametrize(("scale", "place"), [(0, (0, 0)), (1, (0.03, 0.02)), (2, (0.06, 0.04))])
def test_the_block_is_drawn_there_and_the_numbers_are_true(page, scale, place):
    call(page, "start", lifted())
    page.locator(".dw-exaggeration input").fill(str(scale))
    settle(page)
    assert page.evaluate(ORANGE) == pytest.approx(place, abs=5e-4)
    assert page.locator(".dw-factor").inner_text() == f"× {50 * scale}"
    assert page.locator(".dw-chip").nth(1).inner_text() == f"block, deflection × {50 * scale}"
    page.locator(".dw-exaggeration input").dblclick()
    settle(page)
    assert page.evaluate(ORANGE) == pytest.approx((0.03, 0.02), abs=5e-4)


def test_a_body_that_may_go_no_further_gives_a_shorter_slider(page):
    call(page, "start", lifted(most=1.0))
    slider = page.locator(".dw-exaggeration input")
    assert slider.get_attribute("max") == "1"
    call(page, "player.setExaggeration", 2)
    assert page.evaluate(ORANGE) == pytest.approx((0.03, 0.02), abs=5e-4) and page.locator(".dw-factor").inner_text() == "× 50"
    call(page, "player.load", packed())
    assert slider.count() == 0


# -- comparing and clicking ----------------------------------------------------------------------------------------------------


def test_a_reference_is_drawn_behind_and_goes_again(page):
    call(page, "start", packed())
    plain = settle(page)
    grey = call(page, "player.compare", packed(0.8))
    assert grey != plain
    page.evaluate("() => live.player.setFrame('field')")
    settle(page)
    page.evaluate("() => live.player.setFrame('machine')")
    assert settle(page) == grey
    page.evaluate("() => live.clock.set(0.4)")
    assert settle(page) != grey
    page.evaluate("() => live.clock.set(0)")
    settle(page)
    assert call(page, "player.load", packed()) == grey, "an update keeps it"
    assert call(page, "player.compare", None) == plain


def test_a_reference_without_the_observer_is_seen_from_its_first(page):
    alone = packed(0.9)
    alone["observers"] = alone["observers"][:1]
    call(page, "start", packed())
    page.evaluate("() => live.player.setFrame('coupler')")
    plain = settle(page)
    assert call(page, "player.compare", alone) != plain


def test_a_click_names_the_topmost_body_and_a_drag_does_not(page):
    call(page, "start", packed())
    page.evaluate("() => live.clock.set(0.25)")
    settle(page)
    box = page.locator(".dw-canvas").bounding_box()

    def at(x, y):
        spot = page.evaluate(f"[live.player.view.toX({x}), live.player.view.toY({y})]")
        return box["x"] + spot[0], box["y"] + spot[1]

    page.mouse.click(*at(0.0, 0.016))  # on the crank alone
    page.mouse.click(*at(0.0, 0.034))  # the crank is drawn over the coupler
    page.mouse.click(*at(0.03, -0.03))  # nothing
    page.mouse.move(*at(0.0, 0.016))
    page.mouse.down()
    page.mouse.move(*at(0.0, 0.022), steps=4)  # let go on the crank, which has come along
    page.mouse.up()
    page.evaluate("() => live.player.fit()")
    page.locator(".dw-chip", has_text="crank").click()
    settle(page)
    page.mouse.click(*at(0.0, 0.034))
    assert page.evaluate("picked") == ["crank", "crank", "coupler"]


# -- plots ---------------------------------------------------------------------------------------------------------------------


def groups(factor=1.0, plots=PLOTS):
    """The sample's plots with all rocker speeds larger by a factor."""
    result = four_bar_result()
    motion = result.tables["motion"]
    columns = tuple(c._replace(data=c.data * factor) if c.name == "rocker_speed" else c for c in motion.columns)
    return pack_plot_groups(replace(result, tables={**result.tables, "motion": replace(motion, columns=columns)}), four_bar_scene(), plots)


def test_groups_have_names_and_boxes(page):
    call(page, "plot", groups())
    for name, panels in (("rocker", 1), ("speed", 2), ("transmission", 1), ("radius", 1)):
        group = page.get_by_test_id(f"plot-{name}")
        box = group.bounding_box()
        assert group.is_visible() and box["width"] > 300 and box["height"] > 150 and group.locator(".dw-plot").count() == panels


def test_other_values_are_drawn_in_the_same_nodes(page):
    call(page, "plot", groups())
    page.evaluate("() => { live.clock.set(0.4); window.kept = [...document.querySelectorAll('.dw-plot')]; }")
    before, value = page.evaluate(CURVE, 1), page.locator(".dw-plot b").nth(1).inner_text()
    call(page, "plots.update", groups(3.0))
    assert page.evaluate("kept.length === 5 && kept.every(node => node.isConnected)")
    assert page.evaluate(CURVE, 1) != before, "the axis follows"
    number = [float(text.replace("−", "-")) for text in (value, page.locator(".dw-plot b").nth(1).inner_text())]
    assert number[1] == pytest.approx(3 * number[0], rel=0.05)
    call(page, "plots.update", groups(plots=PLOTS[:2]))
    assert page.locator(".dw-plot").count() == 3 and not page.evaluate("kept.some(node => node.isConnected)")


def test_plots_of_another_design_stand_behind_with_their_value(page):
    call(page, "plot", groups())
    page.evaluate("() => live.clock.set(0.4)")
    plain, own = page.evaluate(CURVE, 1), page.locator(".dw-plot").nth(1).locator("b").inner_text()
    assert page.locator(".dw-plot small").nth(1).inner_text() == ""
    call(page, "plots.compare", groups(2.0, PLOTS[:3]))
    assert page.evaluate(CURVE, 1) != plain
    shown = page.locator(".dw-plot small").nth(1).inner_text().strip(" ()").replace("−", "-")
    assert float(shown) == pytest.approx(2 * float(own.replace("−", "-")), rel=0.05)
    assert page.locator(".dw-plot").nth(1).locator("b").inner_text() == own
    angles = page.get_by_test_id("plot-transmission")
    angles.scroll_into_view_if_needed()
    until(page, "document.querySelectorAll('[data-testid=plot-transmission] small')[0].textContent !== ''")
    assert [t.strip(" ()") for t in angles.locator("small").all_inner_texts()] == angles.locator("b").all_inner_texts(), "line by line"
    assert page.get_by_test_id("plot-radius").locator("small").inner_text() == "", "not among the other's plots"
    call(page, "plots.compare", None)
    assert page.evaluate(CURVE, 1) == plain and page.locator(".dw-plot small").nth(1).inner_text() == ""


def test_a_panel_out_of_sight_is_drawn_when_it_comes_into_sight(page):
    page.evaluate("() => { const far = document.createElement('div'); far.className = 'far'; plots.before(far); }")
    call(page, "plot", groups())
    value = page.locator(".dw-plot b").first
    page.evaluate("() => live.clock.set(0.1)")
    settle(page)
    at_rest = value.inner_text()
    page.evaluate("() => live.clock.set(0.6)")
    settle(page)
    assert value.inner_text() == at_rest
    page.evaluate("() => plots.scrollIntoView()")
    until(page, f"document.querySelector('.dw-plot b').textContent !== {json.dumps(at_rest)}")
