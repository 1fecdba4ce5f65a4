"""Solids in motion: our WebGL renderer and three.js over the same parts, cycle, view and window, in a headless browser.

three.js is the one that NiceGUI brings.  Chromium draws by SwiftShader here, a rasteriser in software: what it takes is told apart from
what JavaScript takes, and the processor time of all processes of the browser, which other load does not change, stands beside.
"""

import gzip
import json
import os
import shutil
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parent.parent
PLACES = {"bench": ROOT / "benchmarks" / "viewers", "studio": ROOT / "src" / "drivewright" / "report"}
EXAMPLE, WINDOW, FRAMES, STARTS, SECONDS = "seedling_pusher", (1100, 640), 200, 5, 3.0
KINDS = {"own": "ours", "quick": "ours without multisampling", "three": "three.js with its materials", "same": "three.js with our shaders"}
OWN = ("triangles.js", "shaders.js")  # what a library would replace
ARGUMENTS = ("--no-sandbox", "--disable-dev-shm-usage", "--enable-unsafe-swiftshader", "--use-angle=swiftshader-webgl")
OPEN = """async ([kind, width, height, cut]) => {
  const began = performance.now(), bench = await import('/bench/bench.js');
  const assembly = bench.unpack(await (await fetch('/data.json')).json()), read = performance.now();
  const shown = await bench.opened(kind, assembly, width, height, cut);
  shown.draw(0); shown.wait();
  window.shown = shown; window.bench = bench; window.assembly = assembly;
  return performance.now() - read;
}"""


def _three():
    """three.js as NiceGUI has it."""
    import nicegui

    return Path(nicegui.__file__).parent / "elements" / "scene" / "dist" / "index.js"


def _assembly():
    """The answer of the job "solid" as text."""
    from drivewright.spec.parsing import parse_document
    from drivewright.studio.design import Design
    from drivewright.studio.jobs.solid import solid

    path = ROOT / "examples" / f"{EXAMPLE}.toml"
    return json.dumps(solid(Design(parse_document(path.read_text(encoding="utf-8")), path.parent), lambda *news: None))


@contextmanager
def _browser():
    """(what opens a page with the modules and the assembly, the assembly's text)."""
    from playwright.sync_api import sync_playwright

    data, three = _assembly(), _three()

    def serve(route):
        place, _, file = route.request.url.split("/", 3)[3].partition("/")
        if place == "data.json":
            route.fulfill(body=data, content_type="application/json")
        elif place == "three.js":
            route.fulfill(body=three.read_bytes(), content_type="text/javascript")
        elif place in PLACES and (PLACES[place] / file).is_file():
            route.fulfill(body=(PLACES[place] / file).read_bytes(), content_type="text/javascript")
        else:
            route.fulfill(body="<!doctype html><body style='margin: 0'>", content_type="text/html")

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=os.environ.get("CHROMIUM") or shutil.which("chromium"), args=list(ARGUMENTS))

        def page():
            made = browser.new_page(viewport={"width": WINDOW[0] + 20, "height": WINDOW[1] + 20})
            made.route("**/*", serve)
            made.goto("http://solids.test/")
            return made

        yield page, data
        browser.close()


def _processor_time():
    """Seconds of processor that all processes below this one have used."""
    below, parents = {os.getpid()}, {}
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                fields = (folder / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            parents[int(folder.name)] = (int(fields[1]), int(fields[11]) + int(fields[12]))
    found = -1
    while found != len(below):
        found = len(below)
        below |= {number for number, (parent, _) in parents.items() if parent in below}
    return sum(parents[number][1] for number in below if number in parents and number != os.getpid()) / os.sysconf("SC_CLK_TCK")


def frames():
    """A frame of the pusher: JavaScript alone, and until it is rasterised; in a window of a few pixels without the cost of filling it."""
    with _browser() as (page, _):
        for size in (WINDOW, (64, 37)):
            for kind, name in KINDS.items():
                each = page()
                each.evaluate(OPEN, [kind, *size, None])
                each.evaluate("bench.timed(shown, 40)")
                began, used = time.perf_counter(), _processor_time()
                issued, drawn = np.array(each.evaluate(f"bench.timed(shown, {FRAMES})")).T
                used, wall = (_processor_time() - used) / FRAMES, (time.perf_counter() - began) / FRAMES
                remark = (
                    f"95 % within {np.percentile(drawn, 95):.1f} ms; JavaScript {np.median(issued):.2f} ms, 95 % within "
                    f"{np.percentile(issued, 95):.2f} ms; processor {1e3 * used:.1f} ms of {1e3 * wall:.1f} ms"
                )
                yield f"{name}, {size[0]} x {size[1]} pixels", (drawn.min() / 1e3, np.median(drawn) / 1e3), remark
                each.close()


def playing():
    """Frames per second of a page that plays, and the start."""
    with _browser() as (page, _):
        for kind, name in KINDS.items():
            each = page()
            each.evaluate(OPEN, [kind, *WINDOW, None])
            gaps = np.array(each.evaluate(f"bench.played(shown, {SECONDS})")) / 1e3
            each.close()
            yield f"{name}, playing", (gaps.min(), np.median(gaps)), f"{1 / gaps.mean():.0f} frames per second"
        for kind, name in KINDS.items():
            starts = []
            for _ in range(STARTS):
                each = page()
                starts.append(each.evaluate(OPEN, [kind, *WINDOW, None]) / 1e3)
                each.close()
            yield f"{name}, modules, context, upload and first frame", (min(starts), float(np.median(starts))), f"{STARTS} fresh pages"


def sizes():
    """Bytes that are loaded, lines of our own, and pixels that differ."""
    own = [PLACES["studio"] / name for name in OWN]
    adapter = PLACES["bench"] / "three_renderer.js"
    yield "ours", None, f"{_bytes(own)}, {_lines(own)} lines of code of our own, with fields of values"
    yield "three.js", None, f"{_bytes([_three(), adapter])}, {_lines([adapter])} lines of code of our own, without fields of values"
    with _browser() as (page, data):
        yield "the assembly of the pusher", None, f"{len(data) / 1e3:.0f} kB"
        for cut, words in ((None, "whole"), ([0, 0, 1, 0.003], "in section")):
            for kind in ("same", "three"):
                each = page()
                each.evaluate(OPEN, ["own", *WINDOW, cut])
                other = f"bench.opened('{kind}', assembly, {WINDOW[0]}, {WINDOW[1]}, {cut or 'null'})"
                found = each.evaluate(f"async () => bench.difference(shown, await {other}, 8)")
                each.close()
                remark = f"{100 * found['any']:.3f} % of the pixels by more than 2 of 255; outline: {100 * found['outline']:.4f} %"
                yield f"ours and {KINDS[kind]}, {words}, 8 phases", None, remark


def _bytes(paths):
    plain = [path.read_bytes() for path in paths]
    return f"{sum(map(len, plain)) / 1e3:.0f} kB, {sum(len(gzip.compress(each)) for each in plain) / 1e3:.0f} kB compressed"


def _lines(paths):
    """Lines that are neither empty nor comments."""
    lines = [line.strip() for path in paths for line in path.read_text(encoding="utf-8").splitlines()]
    return sum(bool(line) and not line.startswith(("//", "/*", "*")) for line in lines)


SECTIONS = (("Solids: a frame", frames), ("Solids: playing and start", playing), ("Solids: sizes and pixels", sizes))
