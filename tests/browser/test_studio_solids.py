"""Fields on the deformed solids in a real browser: the offer to run, then field, load step, deformation, section and colours."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from browsing import until
from studio_running import EXAMPLES, drawn, free_port, running

from drivewright import registry, runner
from drivewright.spec import load
from drivewright.studio.kept_results import keep_result
from drivewright.surface_fields import ScalarField, SurfaceBody, SurfaceFields, single

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio, pytest.mark.needs_fe]

EXAMPLE = EXAMPLES / "hyvo_chain.toml"
SHADES = """() => {
  const c = document.querySelector('.so-fields .so-canvas'), copy = document.createElement('canvas');
  Object.assign(copy, {width: c.width, height: c.height});
  return new Promise(done => requestAnimationFrame(() => {
    document.querySelector('[data-testid=solid-slider]').dispatchEvent(new Event('input'));
    requestAnimationFrame(() => { const g = copy.getContext('2d'); g.drawImage(c, 0, 0);
      const d = g.getImageData(0, 0, c.width, c.height).data, seen = new Set();
      for (let i = 0; i < d.length; i += 4) seen.add(d[i] << 16 | d[i + 1] << 8 | d[i + 2]);
      done(seen.size); });
  })); }"""
DATA = "document.querySelector('.so-fields').dataset"


def box(name, label, at, stress, hidden=False):
    """Half a box, z >= 0, whose stress rises along x to `stress` [Pa] at the first step, to half of that at the second."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([corner for a, b, c, d in faces for corner in ((a, b, c), (a, c, d))])
    points = corners[triangles].reshape(-1, 3)
    values = single(np.array([stress * points[:, 0], 0.5 * stress * points[:, 0]]))
    moved = single(1e-6 * np.stack([points, 0.5 * points]))
    mises = ScalarField("mises", "Pa", "Von Mises stress", values)
    return SurfaceBody(name, label, 4e-3 * points + at, np.arange(36).reshape(-1, 3), moved, (mises,), mirrored=True, hidden=hidden)


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    """(address, folder of the server's temporary files)."""
    folder, patch = tmp_path_factory.mktemp("server"), pytest.MonkeyPatch()
    patch.setenv("TMPDIR", str(folder))
    try:
        with running(free_port(), EXAMPLE) as (address, _):
            yield address, folder
    finally:
        patch.undo()


def kept(folder):
    """A result for the server, as an earlier run leaves it."""
    result = runner.run(load(EXAMPLE), only=("layout",))
    bodies = (box("plate", "Plate", 0.0, 2e8), box("left", "Left pin", 6e-3, 4e8, hidden=True))
    found = SurfaceFields("solid_stress", "Plate and pins as solids", ("1 ms", "2 ms"), 0, bodies, 50.0, ("a note",))
    default = [each for each in registry.mechanism("silent-chain").analyses if each.default]
    done = {**result.provenance, "analyses": [*(each.name for each in default), "solid_stress"]}
    (place,) = Path(folder).glob("drivewright-studio-*/results")
    keep_result(place, replace(result, fields={"solid_stress": found}, provenance=done))


@pytest.mark.slow
def test_fields_on_the_deformed_solids(studio, browser):
    address, folder = studio
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    complaints = []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
    page.goto(address)
    until(page, "window.drivewright !== undefined", 30)
    drawn(page)
    page.get_by_test_id("view-solid").click()
    page.get_by_test_id("solid-solid_stress").click(timeout=120_000)
    run = page.get_by_test_id("job-fields")
    run.wait_for(state="visible", timeout=60_000)
    assert "plate and pins as solids in contact" in page.locator(".vw-empty:visible").inner_text()

    kept(folder)
    run.click()
    until(page, f"document.querySelector('.so-fields') && {DATA}.field === 'mises'", 60)
    extreme, limit = page.get_by_test_id("solid-extreme"), page.get_by_test_id("solid-limit")
    assert extreme.inner_text().endswith("200") and limit.input_value() == "200"  # the hidden pin does not count
    assert "[MPa]" in page.get_by_test_id("solid-scale").inner_text()
    assert page.evaluate(f"{DATA}.step") == "0" and float(page.evaluate(f"{DATA}.scale")) == 50
    assert page.evaluate(SHADES) > 30

    page.get_by_test_id("solid-instant").select_option("1")
    assert extreme.inner_text().endswith("100") and limit.input_value() == "200"  # the same colours at every step
    page.locator(".so-fields .dw-chip", has_text="Left pin").click()
    assert limit.input_value() == "400" and extreme.inner_text().endswith("200")

    box_of_scale = page.get_by_test_id("solid-exaggeration")
    box_of_scale.fill("120")
    box_of_scale.press("Enter")
    assert float(page.evaluate(f"{DATA}.scale")) == 120
    limit.fill("150")
    limit.press("Enter")
    assert page.locator(".so-marks span").first.inner_text() == "150"
    page.get_by_test_id("solid-section").select_option("2")
    page.get_by_test_id("solid-depth").wait_for(state="visible")
    assert page.evaluate(SHADES) > 10

    page.get_by_test_id("solid-parts").click()
    page.get_by_test_id("solid-solid_stress").click()
    assert float(page.evaluate(f"{DATA}.scale")) == 120  # nothing is asked for again
    page.close()
    assert complaints == []
