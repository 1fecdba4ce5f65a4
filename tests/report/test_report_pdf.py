"""The PDF report: the same content, typeset; text stays text."""

import sys
import types
from dataclasses import replace

import pytest
from sample_designs import PLOTS, all_views, four_bar_result

from drivewright import registry
from drivewright.errors import MissingExtra
from drivewright.report import pdf
from drivewright.report.content import Picture, Views
from drivewright.report.export import export
from drivewright.report.pdf import write_pdf
from drivewright.spec import load

pytestmark = pytest.mark.interface

NASTY = '#panic[x] *b* $x$ \\u{41} " ` @ref <l> = heading // no comment'


def test_without_typst_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "typst", None)
    with pytest.raises(MissingExtra, match=r"the PDF report needs the extra 'pdf'.*pip install 'drivewright\[pdf\]'"):
        write_pdf(four_bar_result(), tmp_path / "report.pdf", Views())
    assert not list(tmp_path.iterdir())


def test_nothing_is_written_when_typesetting_fails(tmp_path, monkeypatch):
    def fail(*_, **__):
        raise RuntimeError("no")

    monkeypatch.setitem(sys.modules, "typst", types.SimpleNamespace(compile=fail))
    (tmp_path / "report.pdf").write_text("old")
    with pytest.raises(RuntimeError):
        write_pdf(four_bar_result(), tmp_path / "report.pdf", Views(), ())
    assert [p.name for p in tmp_path.iterdir()] == ["report.pdf"] and (tmp_path / "report.pdf").read_text() == "old"


@pytest.mark.needs_pdf
def test_a_pdf_with_every_figure(tmp_path):
    bare = write_pdf(four_bar_result(), tmp_path / "bare.pdf", Views(), ()).read_bytes()
    full = write_pdf(four_bar_result(), tmp_path / "full.pdf", all_views()._replace(plots=PLOTS[:2])).read_bytes()
    assert bare.startswith(b"%PDF") and full.startswith(b"%PDF") and len(full) > len(bare) + 20_000


@pytest.mark.needs_pdf
def test_text_of_the_user_is_no_markup(tmp_path):
    result = replace(four_bar_result(NASTY), findings=(NASTY,))
    figure = Picture("x", NASTY, '<svg xmlns="http://www.w3.org/2000/svg" width="10" height="10"><rect width="5" height="5"/></svg>')
    assert write_pdf(result, tmp_path / "r.pdf", Views(), (figure,)).read_bytes().startswith(b"%PDF")


@pytest.mark.needs_pdf
def test_a_result_with_nothing_but_a_title(tmp_path):
    bare = replace(four_bar_result(), values={}, checks=(), tables={}, arrays={}, findings=(), provenance={})
    assert write_pdf(bare, tmp_path / "r.pdf", Views(), ()).read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize("solids", [False, True])
def test_the_parts_are_shown_where_solids_are_asked_for(tmp_path, monkeypatch, solids):
    seen = []
    monkeypatch.setattr(pdf, "write_pdf", lambda result, path, **given: seen.append(given["seen"]))
    export(load(registry.mechanism("linkage").presets()["crank"]), ("pdf",), tmp_path, solids=solids)
    (shown,) = seen
    assert shown.scene is not None and bool(shown.solids) is solids
