"""Solids in a report: only where they are asked for, packed with the scene's motion, and as a picture for paper."""

import json
import re
from types import SimpleNamespace

import numpy as np
import pytest
from packed_solids import solid_corners
from sample_designs import all_views, four_bar_result, four_bar_scene
from sample_solids import PARTS, SOLIDS

from drivewright.errors import InputError
from drivewright.report import content
from drivewright.report.content import pictures
from drivewright.report.form import report_form
from drivewright.report.html import SOLID_MODULES, solid_texts, write_report
from drivewright.report.solids import numbered, pack_solids, solid_surfaces
from drivewright.report.words import words_of
from drivewright.scene import Part, Prism, rectangle
from drivewright.view.solid_picture import solid_image

pytestmark = pytest.mark.interface


def data_of(text):
    return json.loads(re.search(r'id="data">(.*?)</script>', text, re.DOTALL)[1])


def written(tmp_path, seen, **form):
    drawn = pictures(four_bar_result(), seen)
    return write_report(four_bar_result(), seen, tmp_path, drawn, report_form(**form)).read_text(encoding="utf-8")


def test_a_report_has_solids_only_where_they_are_asked_for(tmp_path):
    bare = written(tmp_path, all_views())
    assert "createAssembly" not in bare and ".so-stage" not in bare and "solids" not in data_of(bare)
    text = written(tmp_path, all_views()._replace(solids=SOLIDS))
    packed = data_of(text)["solids"]
    assert [(part["name"], part["motion"] >= 0) for part in packed["parts"]] == [("crank", True), ("coupler", True), ("frame", False)]
    assert text.count("createAssembly(") == 2 and 'id="solids-view"' in text and ".so-stage" in text  # made, and called once
    assert 'alt="Solids of the assembly"' in text and 'alt="Solids of the assembly"' not in bare
    assert len(text) < len(bare) + 700_000


def test_a_report_in_chinese_names_everything_of_the_viewer(tmp_path):
    words = data_of(written(tmp_path, all_views()._replace(solids=SOLIDS), language="zh"))["words"]
    assert len(solid_texts()) > 12 and {text for text in solid_texts() if not re.search("[\u4e00-\u9fff]", words[text])} == set()
    assert words_of("zh")("Solids of the assembly") != "Solids of the assembly" and "assembly_bar.js" in SOLID_MODULES


def test_the_numbers_of_points_have_room():
    few, many = numbered(np.array([1, 65535]), 65536), numbered(np.array([1, 65536]), 65537)
    assert len(few) == 8 and len(many) == 12


def test_an_assembly_for_a_report_has_a_limit_and_says_what_to_do():
    with pytest.raises(InputError, match="triangles of the solids of a report.*export STEP or STL"):
        solid_surfaces(PARTS, most=30)
    assert len(solid_surfaces(PARTS, most=1000)) == 3


@pytest.mark.parametrize(
    "parts, reason",
    [(None, "no solids to show: toy has none"), (lambda model: PARTS, "no solids to show: .*triangles of the solids.*export STEP")],
)
def test_what_cannot_be_shown_is_a_remark(monkeypatch, parts, reason):
    kind = SimpleNamespace(kind="toy", scene=None, drawings=None, parts=parts)
    monkeypatch.setattr(content, "registry", SimpleNamespace(is_known=lambda name: True, mechanism=lambda name: kind))
    monkeypatch.setattr(content, "MOST_TRIANGLES", 30)
    wanted, bare = (content.views(four_bar_result(), object(), solids) for solids in (True, False))
    assert wanted.solids == () and re.search(reason, wanted.remarks[0]) and bare.remarks == ()


def test_packed_parts_are_the_surfaces():
    packed = pack_solids(SOLIDS, four_bar_scene())
    for part, surface in zip(packed["parts"], SOLIDS, strict=True):
        corners, normals, edges = solid_corners(part)
        assert len(corners) == 3 * part["triangles"] and np.allclose(
            np.sort(corners, axis=0), np.sort(surface.points[surface.corners].reshape(-1, 3), axis=0), atol=1e-7
        )
        assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5) and len(edges)
    assert np.allclose(packed["low"], np.min([each.points.min(axis=0) for each in SOLIDS], axis=0))


# -- the picture -----------------------------------------------------------------------------------------------------------------


def test_the_picture_shows_the_nearer_part_and_nothing_of_what_is_hidden():
    near = Part("near", (Prism(rectangle((0.0, 0.0), 0.1, 0.1), (), 0.0, 0.01),), colour="orange")
    far = Part("far", (Prism(rectangle((0.0, 0.0), 0.04, 0.04), (), -0.03, 0.01),), colour="blue")

    def blue(parts):
        image = solid_image(solid_surfaces(parts), 300).astype(int)
        return np.sum(image[..., 2] > image[..., 0] + 30), image

    alone, _ = blue([far])
    hidden, image = blue([near, far])
    swapped, other = blue([far, near])
    assert alone > 1000 and hidden == 0 and swapped == 0
    assert np.array_equal(image, other) and np.sum(image[..., 0] > image[..., 2] + 30) > 10_000  # whatever the order
    assert np.all(image[0] == 255) and np.all(image[:, 0] == 255)  # a margin
