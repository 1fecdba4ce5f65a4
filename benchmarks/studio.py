"""The studio in a real browser (headless, software raster): slider to new drawing, frames per second, a handle that is dragged and the
CPU time of each process for it, memory over a thousand changes."""

import os
import shutil
import subprocess
import sys
import time
import urllib.request
from contextlib import contextmanager
from pathlib import Path

import numpy as np

EXAMPLES = Path(__file__).parent.parent / "examples"
CHANGES, MANY, SECONDS = 60, 1000, 4.0
SLIDERS = {
    "seedling_pusher": ("train.axis_ratio", "cams.roller_radius", "lever.output_arm"),
    "four_bar": ("bodies.crank.points.A.0", "bodies.coupler.points.B.0"),
    "pin_indexer": ("eccentricity", "pin_radius"),
    "roller_gear_indexer": ("pin_radius",),
    "hyvo_chain": ("joint.rolling_radius", "plate.apothem"),
}
WANTED = {"seedling_pusher": 33}  # ms, median; 60 for the others

MOVE = """async ([key, changes, pause]) => {
  const slider = document.querySelector(`[data-testid="slider-${key}"]`), stage = () => document.querySelector('[data-gen]');
  const [low, high, step] = ['min', 'max', 'step'].map(name => +slider[name]), start = +slider.value;
  const frame = () => new Promise(done => requestAnimationFrame(done)), times = [];
  slider.dispatchEvent(new PointerEvent('pointerdown', {bubbles: true, pointerId: 1}));
  for (let n = 0; n < changes; n++) {
    const before = +stage().dataset.gen, began = performance.now();
    slider.value = Math.min(Math.max(start + ((n % 20) - 10) * Math.max(step, (high - low) / 2000), low), high);
    slider.dispatchEvent(new Event('input', {bubbles: true}));
    while (!(+stage().dataset.gen > before) && performance.now() - began < 3000) await frame();
    times.push(performance.now() - began);
    await new Promise(done => setTimeout(done, pause));
  }
  slider.dispatchEvent(new PointerEvent('pointerup', {bubbles: true, pointerId: 1}));
  slider.dispatchEvent(new Event('change', {bubbles: true}));
  return times;
}"""
FRAMES = """async ([key, seconds]) => {
  const slider = key ? document.querySelector(`[data-testid="slider-${key}"]`) : null, gaps = [];
  let last = performance.now(), n = 0;
  const [low, high, step, start] = slider ? [+slider.min, +slider.max, +slider.step, +slider.value] : [];
  const until = last + 1000 * seconds, first = +document.querySelector('[data-gen]').dataset.gen;
  slider?.dispatchEvent(new PointerEvent('pointerdown', {bubbles: true, pointerId: 1}));
  while (last < until) {
    await new Promise(done => requestAnimationFrame(done));
    const now = performance.now();
    gaps.push(now - last);
    last = now;
    if (!slider) continue;
    slider.value = start + ((n++ % 40) - 20) * Math.max(step, (high - low) / 2000);
    slider.dispatchEvent(new Event('input', {bubbles: true}));
  }
  slider?.dispatchEvent(new PointerEvent('pointerup', {bubbles: true, pointerId: 1}));
  return [gaps, +document.querySelector('[data-gen]').dataset.gen - first];
}"""
HANDLES = {  # what is dragged, and the drawings a second that are wanted
    "four_bar": ("bodies.crank.points.A", 60),
    "slider_crank_clearance": ("bodies.crank.points.A", 60),
    "seedling_pusher": ("train.carrier_angle", 30),
}
DRAG = """async ([key, seconds]) => {
  const handle = document.querySelector(`[data-testid="handle-${key}"]`), box = handle.getBoundingClientRect(), gens = new Set(), gaps = [];
  const stage = document.querySelector('[data-gen]'), [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const send = (type, dx, dy) => handle.dispatchEvent(new PointerEvent(type, {bubbles: true, cancelable: true, button: 0, pointerId: 1,
    clientX: x + dx, clientY: y + dy}));
  handle.setPointerCapture = () => {};  // there is no such pointer
  let last = performance.now(), n = 0;
  const until = last + 1000 * seconds;
  send('pointerdown', 0, 0);
  while (last < until) {
    await new Promise(done => requestAnimationFrame(done));
    const now = performance.now();
    gaps.push(now - last);
    last = now;
    send('pointermove', 20 * Math.sin(n / 7), 20 * (1 - Math.cos(n / 7)));  // 3 px a frame: another number in every frame
    n += 1;
    gens.add(stage.dataset.gen);
  }
  send('pointerup', 0, 0);
  return [gaps, gens.size - 1];
}"""
SETTLED = """(() => { const {design, result, work} = window.drivewright?.state || {};
  return !!(design && result && result.full && result.gen === design.gen && work.state === 'idle'); })()"""


@contextmanager
def opened(name):
    """(page, server process) of the studio with an example, analysed and playing."""
    from playwright.sync_api import sync_playwright

    port = 8390
    command = [sys.executable, "-m", "drivewright", "studio", str(EXAMPLES / f"{name}.toml"), "--port", str(port), "--no-browser"]
    server = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    try:
        began = time.perf_counter()
        while not _healthy(port):
            assert server.poll() is None and time.perf_counter() - began < 60, "the studio does not start"
            time.sleep(0.05)
        with sync_playwright() as playwright:
            path = os.environ.get("CHROMIUM") or shutil.which("chromium")
            browser = playwright.chromium.launch(executable_path=path, args=["--disable-dev-shm-usage", "--no-sandbox", "--disable-gpu"])
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            page.goto(f"http://127.0.0.1:{port}/")
            _settled(page)
            yield page, server
            browser.close()
    finally:
        server.terminate()
        server.wait(10)


def _healthy(port):
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/healthz", timeout=1):
            return True
    except OSError:
        return False


def _settled(page):
    deadline = time.monotonic() + 120
    while not page.evaluate(SETTLED):
        assert time.monotonic() < deadline, "the studio does not come to rest"
        page.wait_for_timeout(50)


def latency():
    """From the slider's event to the drawing of the new design, while the motion plays."""
    for name, keys in SLIDERS.items():
        with opened(name) as (page, _):
            for key in keys:
                page.evaluate(MOVE, [key, 10, 50])
                times = np.array(page.evaluate(MOVE, [key, CHANGES, 120])) / 1e3
                remark = f"95 % within {1e3 * np.percentile(times, 95):.0f} ms; wanted: median {WANTED.get(name, 60)} ms"
                yield f"{name}, {key}, {CHANGES} changes", (times.min(), np.median(times)), remark


def frames():
    """Frames of the page: playing, and with a new value in every frame."""
    for name, key in (
        ("seedling_pusher", ""),
        ("seedling_pusher", "cams.roller_radius"),
        ("four_bar", "bodies.crank.points.A.0"),
        ("hyvo_chain", ""),
    ):
        with opened(name) as (page, _):
            page.evaluate(FRAMES, [key, 1.0])
            _settled(page)
            gaps, drawn = page.evaluate(FRAMES, [key, SECONDS])
            gaps = np.array(gaps) / 1e3
            what = f"a new value of {key} in every frame, {drawn} of them drawn" if key else "playing"
            remark = f"{1 / gaps.mean():.0f} frames per second; 95 % within {1e3 * np.percentile(gaps, 95):.0f} ms"
            yield f"{name}, {what}", (gaps.min(), np.median(gaps)), remark


def dragging():
    """A handle that is moved in every frame: drawings a second, and what each costs in the server, its workers, and the browser."""
    for name, (key, wanted) in HANDLES.items():
        with opened(name) as (page, server):
            page.evaluate(DRAG, [key, 1.0])
            _settled(page)
            before = _cpu(page, server)
            gaps, drawn = page.evaluate(DRAG, [key, SECONDS])
            spent = {what: 1e3 * (seconds - before.get(what, 0.0)) / max(drawn, 1) for what, seconds in _cpu(page, server).items()}
            gaps = np.array(gaps) / 1e3
            cost = ", ".join(f"{what} {each:.1f}" for what, each in spent.items())
            remark = f"{drawn / SECONDS:.0f} drawings a second (wanted: {wanted}), {1 / gaps.mean():.0f} frames; CPU ms a drawing: {cost}"
            yield f"{name}, {key} dragged", (SECONDS / max(drawn, 1), SECONDS / max(drawn, 1)), remark


def _cpu(page, server):
    """CPU time [s] of the server, of its workers, and of the browser's processes by what they do."""
    spent = {"server": _used(server.pid), "workers": sum(map(_used, _children(server)))}
    session = page.context.browser.new_browser_cdp_session()
    for process in session.send("SystemInfo.getProcessInfo")["processInfo"]:
        spent[process["type"]] = spent.get(process["type"], 0.0) + process["cpuTime"]
    session.detach()
    return spent


def _used(pid):
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory():
    """Over a thousand changes: the page's heap after a collection, the server and its processes."""
    with opened("four_bar") as (page, server):
        key = SLIDERS["four_bar"][0]
        page.evaluate(MOVE, [key, 100, 0])
        before = _memory(page, server)
        times = np.array(page.evaluate(MOVE, [key, MANY, 0])) / 1e3
        _settled(page)
        after = _memory(page, server)
    words = ", ".join(f"{what} {a:.1f} -> {b:.1f} MB" for (what, a), b in zip(before.items(), after.values(), strict=True))
    yield f"{MANY} changes one after another", (times.min(), np.median(times)), words


def _memory(page, server):
    """MB of the page's heap after a garbage collection, of the server, and of its worker processes."""
    session = page.context.new_cdp_session(page)
    for _ in range(3):
        session.send("HeapProfiler.collectGarbage")
    heap = session.send("Runtime.getHeapUsage")["usedSize"] / 1e6
    return {"page": heap, "server": _resident(server.pid), "workers": sum(map(_resident, _children(server)))}


def _children(server):
    return list(map(int, subprocess.run(["pgrep", "-P", str(server.pid)], capture_output=True, text=True, check=False).stdout.split()))


def _resident(pid):
    text = Path(f"/proc/{pid}/status").read_text()
    return int(text.partition("VmRSS:")[2].split()[0]) / 1e3


SECTIONS = (
    ("Studio: slider to new drawing", latency),
    ("Studio: frames", frames),
    ("Studio: dragging", dragging),
    ("Studio: memory", memory),
)
