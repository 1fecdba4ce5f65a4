"""Drawings of what the keys measure: each length drawn is the key's value, and each name can be read."""

import math
import shutil
from dataclasses import replace
from itertools import combinations

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from drivewright import registry
from drivewright.dimensions import Angle, DimensionSheet, Length
from drivewright.report.dimension_drawings import dimension_figure, drawing_files, measured, write_drawings
from drivewright.spec.fields import dimension_at, value_at
from drivewright.view.dimensions import spread
from drivewright.view.style import styled

pytestmark = pytest.mark.conformance

SHEETS = [(kind, sheet) for kind in registry.kinds() for sheet in registry.mechanism(kind).dimensions]
EVERY = pytest.mark.parametrize(("kind", "sheet"), SHEETS, ids=[sheet.name for _, sheet in SHEETS])


def mismatches(found):
    """Dimensions whose drawn value is not that of their key."""
    pairs = [(each, value_at(found.spec, each.key)) for each in found.dimensions]
    return [(each.key, each.drawn, value) for each, value in pairs if value is None or not math.isclose(each.drawn, value, rel_tol=1e-5)]


@EVERY
def test_each_length_is_that_of_its_key(kind, sheet):
    found = measured(kind, sheet)
    assert found.dimensions and mismatches(found) == []
    for each in found.dimensions:
        known, dimension = dimension_at(registry.mechanism(kind).spec, each.key)
        wanted = "angle" if isinstance(each, Angle) else "length"
        assert known and dimension is not None and wanted in dimension.name, f"{each.key}: {dimension}"


@EVERY
def test_the_drawing_that_is_kept_names_all_keys(kind, sheet):
    path = drawing_files(kind).get(sheet.name)
    again = "python docs/generate.py dimensions draws them again"
    assert path is not None, again
    text = path.read_text()
    assert [each.key for each in measured(kind, sheet).dimensions if each.key not in text] == [], again


def test_a_wrong_length_is_noticed():
    kind, sheet = SHEETS[0]
    wrong = sheet._replace(
        dimensions=lambda model, scene: (each._replace(key="follower.prime_radius") for each in sheet.dimensions(model, scene))
    )
    assert len(mismatches(measured(kind, wrong))) == len(measured(kind, sheet).dimensions) - 1


@EVERY
def test_names_do_not_overlap_and_stay_within_the_picture(kind, sheet):
    figure = dimension_figure(kind, sheet)
    with styled():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    boxes = [(text.get_text(), text.get_window_extent(canvas.get_renderer())) for axis in figure.axes for text in axis.texts]
    assert len(boxes) == 2 * len(measured(kind, sheet).dimensions)
    for text, box in boxes:
        assert figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1 and figure.bbox.y0 <= box.y0 and box.y1 <= figure.bbox.y1, text
    for (a, one), (b, other) in combinations(boxes, 2):
        assert not one.overlaps(other), (a, b)


@EVERY
def test_lines_of_measure_keep_clear_of_the_names(kind, sheet):
    """One scale in both directions, and everything measured between the two columns."""
    (axis,) = dimension_figure(kind, sheet).axes
    figure = axis.figure
    wide, high = (end - start for start, end in (axis.get_xlim(), axis.get_ylim()))
    assert wide / high == pytest.approx(figure.get_figwidth() / (figure.get_figheight() * axis.get_position().height), rel=1e-6)
    names = [text.get_position()[0] for text in axis.texts]
    for each in measured(kind, sheet).dimensions:
        if isinstance(each, Length):
            assert min(names) < 1e3 * each.start[0] < max(names) and min(names) < 1e3 * each.end[0] < max(names), each.key


def test_every_kind_has_a_drawing_and_every_drawing_a_name_of_its_own():
    assert {kind for kind, _ in SHEETS} == set(registry.kinds())
    names = [sheet.name for _, sheet in SHEETS]
    assert len(set(names)) == len(names) and all(name.startswith(kind) for (kind, _), name in zip(SHEETS, names, strict=True))
    assert all(isinstance(sheet, DimensionSheet) for _, sheet in SHEETS)


def test_rows_are_apart_and_within_their_column():
    assert spread([0.0, 0.1, 5.0], 1.0, 0.0, 10.0) == [0.5, 1.5, 5.0]
    assert spread([9.9, 9.9], 1.0, 0.0, 10.0) == [8.5, 9.5]
    assert spread([], 1.0, 0.0, 1.0) == []


def test_drawings_are_written_into_the_folder_of_the_kind_and_written_again(tmp_path, monkeypatch):
    own = registry.mechanism("linkage")
    shutil.copytree(own.folder / "presets", tmp_path / "presets")
    monkeypatch.setattr(registry, "mechanism", lambda kind: replace(own, folder=tmp_path))
    assert drawing_files("linkage") == {}, "a package that brings a kind may leave its drawings out"
    names = [sheet.name for sheet in own.dimensions]
    told, paths = [], [tmp_path / "drawings" / f"{name}.svg" for name in names]
    assert [write_drawings("linkage", told.append) for _ in range(2)] == [paths, paths]
    assert drawing_files("linkage") == dict(zip(names, paths, strict=True)) and all(path.read_text().count("<svg") == 1 for path in paths)
    assert told == [f"dimensions: {name}" for name in names] * 2
