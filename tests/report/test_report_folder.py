"""The run folder: complete, replaced whole, and nothing lost when writing fails."""

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pyarrow import parquet
from sample_designs import PLOTS, SPEC_TEXT, all_views, four_bar_result, four_bar_scene

from drivewright.errors import InputError
from drivewright.report import folder as module
from drivewright.report import renames
from drivewright.report.content import Views
from drivewright.report.folder import file_name, is_run_folder, record_text, write_run_folder
from drivewright.report.index import write_index
from drivewright.surface_fields import ScalarField, SurfaceBody, SurfaceFields, single

pytestmark = pytest.mark.interface

BARE = Views(four_bar_scene())
FULL = all_views()._replace(plots=PLOTS[:1])


def listing(path):
    return sorted(str(p.relative_to(path)) for p in Path(path).rglob("*") if p.is_file())


def test_a_run_folder_has_everything(tmp_path):
    out = write_run_folder(four_bar_result(), tmp_path / "deep" / "run", seen=FULL)
    names = listing(out)
    assert [n for n in names if "/" not in n] == ["report.html", "result.json", "spec.toml"]
    assert [n for n in names if n.startswith("tables")] == ["tables/links.parquet", "tables/motion.parquet"]
    assert {"figures/plot-rocker.svg", "figures/scene-field.svg", "figures/drawing-cam.svg", "figures/thumbnail.svg"} <= set(names)
    assert (out / "spec.toml").read_text() == SPEC_TEXT
    assert os.listdir(tmp_path / "deep") == ["run"]


def test_without_figures_there_are_none_but_a_player(tmp_path):
    out = write_run_folder(four_bar_result(), tmp_path / "run", figures=False, seen=FULL)
    assert not (out / "figures").exists() and 'id="player"' in (out / "report.html").read_text()


def test_tables_carry_units_and_meanings(tmp_path):
    out = write_run_folder(four_bar_result(), tmp_path / "run", figures=False, seen=BARE)
    field = parquet.read_schema(out / "tables" / "motion.parquet").field("rocker")
    assert field.metadata == {b"unit": b"rad", b"label": b"Rocker angle", b"meaning": b"rocker angle"}


def test_the_record_is_plain_json_in_full_precision():
    record = json.loads(record_text(four_bar_result()))
    assert record["values"]["deviation"]["value"] == 2.4669517247e-06
    assert record["checks"][0]["ok"] is True and record["checks"][1]["ok"] is False


def test_a_run_folder_is_replaced_whole(tmp_path):
    out = write_run_folder(four_bar_result("first"), tmp_path / "run", seen=FULL)
    (out / "figures" / "old.svg").write_text("old")
    write_run_folder(four_bar_result("second"), out, figures=False, seen=BARE)
    assert json.loads((out / "result.json").read_text())["title"] == "second" and not (out / "figures").exists()
    assert os.listdir(tmp_path) == ["run"]


def test_an_empty_folder_is_taken(tmp_path):
    (tmp_path / "run").mkdir()
    assert is_run_folder(write_run_folder(four_bar_result(), tmp_path / "run", figures=False, seen=BARE))


@pytest.mark.parametrize("content", ["{}", "[1]", "3", "no json", '{"name": "somebody else\'s"}'])
def test_a_folder_with_other_things_is_refused_and_untouched(tmp_path, content):
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "result.json").write_text(content)
    with pytest.raises(InputError, match=r"thesis: is not empty and is no run folder \(it holds result.json .*nothing was written"):
        write_run_folder(four_bar_result(), tmp_path / "thesis", seen=BARE)
    assert listing(tmp_path) == ["thesis/result.json"] and (tmp_path / "thesis" / "result.json").read_text() == content


def test_a_file_in_the_place_is_refused(tmp_path):
    (tmp_path / "run").write_text("precious")
    with pytest.raises(InputError, match="is a file, a run folder cannot take its place"):
        write_run_folder(four_bar_result(), tmp_path / "run", seen=BARE)
    assert (tmp_path / "run").read_text() == "precious" and os.listdir(tmp_path) == ["run"]


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
@pytest.mark.parametrize("step", ["write_report", "_write_tables", "record_text"])
def test_failure_while_writing_leaves_the_old_folder_and_no_litter(tmp_path, monkeypatch, error, step):
    out = write_run_folder(four_bar_result("first"), tmp_path / "run", figures=False, seen=BARE)
    before = listing(out)

    def fail(*_):
        raise error

    monkeypatch.setattr(module, step, fail)
    with pytest.raises(error):
        write_run_folder(four_bar_result("second"), out, figures=False, seen=BARE)
    assert listing(out) == before and json.loads((out / "result.json").read_text())["title"] == "first"
    assert os.listdir(tmp_path) == ["run"]


@pytest.mark.parametrize("error", [OSError, KeyboardInterrupt])
def test_failure_while_moving_in_puts_the_old_folder_back(tmp_path, monkeypatch, error):
    """On a system that cannot exchange two names."""
    monkeypatch.setattr(renames, "_renameat2", lambda: None)
    out = write_run_folder(four_bar_result("first"), tmp_path / "run", figures=False, seen=BARE)
    rename = Path.rename

    def fail_the_new_one(path, target):
        if ".tmp-" in path.name:
            raise error
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", fail_the_new_one)
    with pytest.raises(error):
        write_run_folder(four_bar_result("second"), out, figures=False, seen=BARE)
    assert json.loads((out / "result.json").read_text())["title"] == "first" and os.listdir(tmp_path) == ["run"]


def test_file_names_have_no_path_in_them():
    assert file_name("../../etc/passwd") == "etc-passwd"
    assert file_name("cam_main.1") == "cam_main.1"
    assert file_name("a b\\c:d*") == "a-b-c-d"
    assert file_name("...") == "unnamed"


def test_the_gallery_links_what_is_there(tmp_path):
    first = write_run_folder(four_bar_result("One & <b>only</b>"), tmp_path / "out" / "a run", seen=FULL)
    second = write_run_folder(four_bar_result("Two"), tmp_path / "out" / "b", figures=False, seen=BARE)
    page = write_index([first, second], tmp_path / "out" / "index.html").read_text()
    assert 'href="a%20run/report.html"' in page and 'src="a%20run/figures/thumbnail.svg"' in page and 'href="b/report.html"' in page
    assert "One &amp; &lt;b&gt;only&lt;/b&gt;" in page and page.count("<img") == 1
    assert "2 with failed checks" in page and "55.134°" in page and "computed in 0.41 s" in page
    assert "http" not in page.replace("http-equiv", "")


def test_fields_on_solids_are_arrays_in_single_precision(tmp_path):
    corner = SurfaceBody(
        "plate",
        "Plate",
        np.eye(3),
        np.array([[0, 1, 2]]),
        single(np.ones((1, 3, 3))),
        (ScalarField("mises", "Pa", "Von Mises stress", single(np.ones((1, 3)))),),
    )
    result = replace(four_bar_result(), fields={"solid_stress": SurfaceFields("solid_stress", "Solids", ("1 ms",), 0, (corner,))})
    folder = write_run_folder(result, tmp_path / "run", figures=False)
    with np.load(folder / "fields" / "solid_stress.npz") as found:
        assert set(found) == {"steps", "plate.points", "plate.triangles", "plate.displacements", "plate.mises"}
        assert found["plate.mises"].dtype == np.float32 and found["steps"].tolist() == ["1 ms"]
