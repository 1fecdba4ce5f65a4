"""The README's moving picture: small, endless, and of checks that its designs have."""

import importlib

import numpy as np
import pytest
from PIL import Image
from places import ROOT

pytestmark = pytest.mark.interface


@pytest.fixture(scope="module")
def module():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT / "docs"))
        yield importlib.import_module("builders.moving")


@pytest.fixture(scope="module")
def acts(module):
    return list(module.acts())


def test_the_file_is_small_and_runs_endlessly(module):
    path = ROOT / "docs" / "img" / module.FILE
    film = Image.open(path)
    assert path.stat().st_size < module.BUDGET and film.size == (module.WIDTH, module.HEIGHT)
    assert film.n_frames == module.FRAMES * len(module.ACTS) and film.info["loop"] == 0


def test_it_was_made_from_the_specs_as_they_stand(module):
    assert (ROOT / "docs" / "img" / module.MADE).read_text() == module.digests(), "python docs/builders/moving.py makes it again"


def test_the_turn_closes(module, acts):
    for act in acts:
        ends = [np.asarray(module.image(module.picture(act, phase)), int) for phase in (0.0, 1.0)]
        moved = np.asarray(module.image(module.picture(act, 0.3)), int)
        machine = slice(None), slice(0, int(module.STAGE[2] * module.WIDTH))  # the cursor of the plot goes from end to end
        assert np.abs(ends[0][machine] - ends[1][machine]).mean() < 0.05 * np.abs(ends[0][machine] - moved[machine]).mean()


def test_what_is_shown_is_what_the_runs_say(module, acts):
    published, optimised = (act.result for act in acts)
    for result in (published, optimised):
        assert set(module.CHECKS) <= {check.name for check in result.checks}
    assert not all(check.ok for check in published.checks) and all(check.ok for check in optimised.checks)


def test_nothing_written_lies_on_anything_else(module, acts):
    from itertools import combinations

    from matplotlib.backends.backend_agg import FigureCanvasAgg

    for act in acts:
        figure = module.picture(act, 0.2)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        boxes = [(text.get_text(), text.get_window_extent(canvas.get_renderer())) for text in figure.texts]
        assert len(boxes) == 3 + 4 * len(module.CHECKS)
        for (a, one), (b, other) in combinations(boxes, 2):
            assert not one.overlaps(other), (a, b)
