"""Fields of an analysis for the viewer: what is packed is what the analysis found, and one run serves the whole page."""

import base64
import json
import re
import shutil
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from test_studio_jobs import design
from test_studio_translations import LATIN, translated

from drivewright import runner
from drivewright.chains.solid import fields as chain
from drivewright.errors import InputError, MissingExtra, UnknownName
from drivewright.indexing.solid import fields as indexer
from drivewright.studio.jobs import JOBS, fields, figures
from drivewright.studio.jobs.fields import packed_fields
from drivewright.studio.kept_results import MOST, keep_result, kept_result, result_of
from drivewright.studio.resources import ServerResources
from drivewright.surface_fields import ScalarField, SurfaceBody, SurfaceFields, single

pytestmark = pytest.mark.interface

RANDOM = np.random.default_rng(3)
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def quiet(done, total, text="", partial=None):
    """Progress that nobody hears."""


@cache
def cube():
    """A half cube, z >= 0, of elements that share no points; the value of a field is missing on its first triangle."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float) * 0.01
    triangles = np.array([corner for a, b, c, d in FACES for corner in ((a, b, c), (a, c, d))])
    points = corners[triangles].reshape(-1, 3)
    stress = RANDOM.uniform(1e6, 9e6, (2, 36))
    stress[:, :3] = np.nan
    life = np.full((1, 36), np.inf)
    life[0, 7] = 1e6
    own = (
        ScalarField("mises", "Pa", "Von Mises stress", single(stress), missing="not evaluated"),
        ScalarField("life", "-", "Life", single(life), log=True, missing="longer"),
    )
    moved = single(RANDOM.normal(size=(2, 8, 3))[:, triangles].reshape(2, 36, 3) * 1e-6)
    return SurfaceBody("cube", "Cube", points, np.arange(36).reshape(-1, 3), moved, own, np.array([[0.0, 0, 0, 0], [0, 0, 1, 0]]), True)


def found():
    return SurfaceFields("solid_stress", "Cube", ("1 ms", "2 ms"), 1, (cube(),), 20.0, ("a note",))


def values(text, kind="<f4"):
    return np.frombuffer(base64.b64decode(text), kind)


# -- packing -------------------------------------------------------------------------------------------------------------------


def test_what_is_packed_is_what_the_analysis_found():
    packed = packed_fields(found())
    json.dumps(packed, allow_nan=False)
    (body,), own = packed["bodies"], cube()
    for step in (0, 1):
        assert np.nanmax(values(body["values"]["mises"][step])) == np.nanmax(own.field("mises").values[step])
        assert np.array_equal(values(body["values"]["mises"][step]), own.field("mises").values[step], equal_nan=True)
        deformed = values(body["positions"]).reshape(-1, 3) + 20.0 * values(body["displacements"][step]).reshape(-1, 3)
        unplaced = own._replace(places=None).deformed(step, 20.0)
        assert deformed == pytest.approx(unplaced, abs=1e-8)
    assert body["ranges"]["mises"] == list(own.field("mises").range) and body["ranges"]["life"] == [1e6, 1e6]
    assert body["triangles"] == 12 and body["mirrored"] and not body["hidden"] and body["places"][1][2] == 1


def test_edges_are_pairs_of_corners_and_none_lies_where_the_mirror_image_joins():
    (body,) = packed_fields(found())["bodies"]
    edges = values(body["edges"], "<u4").reshape(-1, 2)
    assert edges.max() < 36 and len(edges) == 8  # twelve of a cube but the four at z = 0
    ends = values(body["positions"]).reshape(-1, 3)[edges]
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) == pytest.approx(0.01)
    assert ends[:, :, 2].max(axis=1).min() > 0


def test_what_a_reader_needs_of_the_fields():
    packed = packed_fields(found())
    stress, life = packed["fields"]
    assert (stress["unit"], stress["factor"], stress["log"], stress["missing"]) == ("MPa", 1e-6, False, "not evaluated")
    assert (life["unit"], life["log"], life["missing"]) == ("", True, "longer")
    assert packed["steps"] == ["1 ms", "2 ms"] and packed["worst"] == 1 and packed["scale"] == 20.0 and packed["notes"] == ["a note"]
    assert packed["colours"][0] == "#440154" and packed["colours"][-1] == "#fde725" and all(len(each) == 7 for each in packed["colours"])


def test_a_field_without_any_value_is_not_offered():
    bare = cube()._replace(fields=tuple(each._replace(values=np.full_like(each.values, np.nan)) for each in cube().fields))
    assert packed_fields(found()._replace(bodies=(bare,)))["fields"] == []


# -- results that are kept -----------------------------------------------------------------------------------------------------


@cache
def short_run():
    """A run of the chain without its long analyses, as if `solid_stress` had run too."""
    result = runner.run(design("hyvo_chain").spec(), only=("layout",))
    done = {**result.provenance, "analyses": ["layout", "solid_stress"]}
    return replace(result, provenance=done, fields={"solid_stress": found()})


def test_a_kept_result_is_found_by_what_it_holds(tmp_path):
    digest = short_run().digest
    assert kept_result(tmp_path, digest, ["layout"]) is None and kept_result(None, digest, []) is None
    keep_result(tmp_path, short_run())
    assert kept_result(tmp_path, digest, ["solid_stress", "layout"]).values == short_run().values
    assert kept_result(tmp_path, digest, ["solid_stress", "speeds"]) is None and kept_result(tmp_path, "0" * 64, ["layout"]) is None


def test_the_newest_counts_and_the_oldest_goes(tmp_path):
    for number in range(MOST + 2):
        keep_result(tmp_path, replace(short_run(), title=str(number)))
    assert len(list(tmp_path.iterdir())) == MOST
    assert kept_result(tmp_path, short_run().digest, ["layout"]).title == str(MOST + 1)


def test_one_run_serves_figures_and_fields(tmp_path, monkeypatch):
    runs, once = [], runner.run
    monkeypatch.setattr(runner, "run", lambda *given: runs.append(given) or once(*given))
    spec = design("four_bar").spec()
    first = result_of(spec, (), tmp_path, quiet, runner.build(spec))
    assert result_of(spec, (), tmp_path, quiet, None).values == first.values and len(runs) == 1
    figures.figures(design("four_bar"), quiet, kept=str(tmp_path))
    assert len(runs) == 1


def test_the_folder_of_results_is_no_page_s_folder():
    resources = ServerResources.__new__(ServerResources)
    resources._root, resources._folders = None, []
    try:
        folder = resources.results_folder()
        assert folder.is_dir() and folder == resources.results_folder() and resources.folder(folder.name) is None
    finally:
        shutil.rmtree(folder.parent)


# -- the job -------------------------------------------------------------------------------------------------------------------


def test_what_has_run_is_shown_and_what_has_not_is_offered(tmp_path):
    chain = design("hyvo_chain")
    assert fields.fields(chain, quiet, "solid_stress", kept=str(tmp_path)) == {"analysis": "solid_stress", "absent": True}
    keep_result(tmp_path, short_run())
    answer = JOBS["fields"](chain, quiet, analysis="solid_stress", kept=str(tmp_path))
    assert answer["analysis"] == "solid_stress" and answer["steps"] == ["1 ms", "2 ms"]


def test_an_analysis_without_fields_is_refused():
    with pytest.raises(UnknownName, match="no analysis with fields is called 'layout'"):
        fields.fields(design("hyvo_chain"), quiet, "layout")


def test_without_finite_elements_it_says_so_before_anything_runs(tmp_path, monkeypatch):
    def absent(name, purpose):
        raise MissingExtra(purpose, "fe")

    monkeypatch.setattr(fields, "fe_module", absent)
    monkeypatch.setattr(runner, "run", lambda *given: pytest.fail("it ran"))
    with pytest.raises(MissingExtra, match=r"drivewright\[fe\]"):
        fields.fields(design("hyvo_chain"), quiet, "solid_stress", run=True, kept=str(tmp_path))


def test_a_run_without_fields_says_why(tmp_path, monkeypatch):
    monkeypatch.setattr(fields, "fe_module", lambda name, purpose: None)
    left = replace(short_run(), fields={}, findings=("solid_stress is left out: the chain does not run",))
    monkeypatch.setattr(runner, "run", lambda *given: left)
    with pytest.raises(InputError, match="solid_stress is left out: the chain does not run"):
        fields.fields(design("hyvo_chain"), quiet, "solid_stress", run=True, kept=str(tmp_path))


def test_the_parts_say_which_analyses_have_fields():
    assert JOBS["solid"](design("pressure_roller_shaft"), quiet)["analyses"] == []


@pytest.mark.parametrize(
    ("kind", "texts"),
    [
        (
            "silent-chain",
            [*chain.LABELS.values(), *chain.NOTES, chain.BESIDE, chain.LONGER]
            + ["Von Mises stress", "Life in revolutions of the chain", "Contact pressure on the seats"],
        ),
        ("indexer", [*indexer.NOTES, indexer.MISSING, "Von Mises stress", "Cam 2", "Shaft 1", "Wheel", "input at 45°"]),
    ],
)
def test_every_text_of_the_fields_is_translated(kind, texts):
    left = [text for text in translated([(kind, texts)])[0] if set(re.findall("[A-Za-z]{2,}", text)) - LATIN]
    assert left == []
