"""The studio's jobs: small designs through each, beside what the command line makes of them."""

import io
import json
import math
import tomllib
import zipfile
from pathlib import Path

import numpy as np
import pytest
from packed_solids import solid_corners, vectors
from places import EXAMPLES

import drivewright as dw
from drivewright import registry, runner
from drivewright.errors import GeometryCheckFailed, SpecError, UnknownName
from drivewright.report.content import pictures, views
from drivewright.report.export import export as exported
from drivewright.report.pack import pack_plots
from drivewright.report.solids import shaded
from drivewright.spec import load
from drivewright.studies.store import Memory
from drivewright.studio.design import Design
from drivewright.studio.jobs import JOBS, search
from drivewright.studio.jobs.design_keys import is_locked, label, leaves, numbered
from drivewright.studio.jobs.figures import themed
from drivewright.studio.jobs.sensitivity import _effect
from drivewright.studio.jobs.study import Live, evenly_spaced_rows

pytestmark = pytest.mark.interface

CAM_KEPT = ("programme", "drive", "load", "spring", "face", "vibration", "manufacture")


def design(name):
    path = EXAMPLES / f"{name}.toml"
    return Design(tomllib.loads(path.read_text()), path.parent)


class Told(list):
    """What a job told; true as functions are, also before anything is told."""

    def __bool__(self):
        return True

    def __call__(self, done, total, text, partial=None):
        json.dumps(partial, allow_nan=False)
        self.append((done, total, text, partial))


def asked(name, of, **options):
    """(answer, what was told); the answer is data for JSON, or files, and names no place of this disk."""
    told = Told()
    answer = JOBS[name](of, told, **options)
    data = [file["data"] for file in answer["files"]] if "files" in answer else [json.dumps(answer, allow_nan=False).encode()]
    texts = [*data, *(part for archive in data if archive[:2] == b"PK" for part in unpacked(archive).values())]
    assert not [place for place in (str(EXAMPLES), str(Path.cwd()), str(Path.home()) + "/") for text in texts if place.encode() in text]
    return answer, told


def unpacked(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def one_file(answer):
    (file,) = answer["files"]
    return file["name"], file["data"]


# -- keys ----------------------------------------------------------------------------------------------------------------------


def test_keys_go_by_number_whatever_they_are_called():
    tables = {"joints": [{"name": "A", "at": ["1 mm", "2 mm"]}, {"name": "B"}], "drive": {"speed": "1 rpm"}}
    assert [key for key, _ in leaves(tables)] == ["joints.0.name", "joints.0.at.0", "joints.0.at.1", "joints.1.name", "drive.speed"]
    assert numbered(tables, "joints.B.gap") == numbered(tables, "joints.1.gap") == "joints.1.gap"
    assert is_locked(tables, "joints.0.at.1", ["joints.A.at"]) and not is_locked(tables, "joints.0.atom", ["joints.A.at"])
    assert label(tables, "joints.0.at.1") == "joints · A · at · 2"


# -- sensitivity ---------------------------------------------------------------------------------------------------------------


def test_sensitivity_is_that_of_direct_differences_and_of_the_formula():
    cam, names = design("disc_cam"), ("check.bore_wall", "check.separation", "max_velocity", "max_acceleration", "max_jerk")
    answer, told = asked("sensitivity", cam, locks=("follower", "programme", "load", "vibration", "face"), targets=names, on="serial")
    wall, separation, *motion = answer["targets"]
    bars = {bar["key"]: bar for bar in separation["bars"]}
    keys = {*bars, *separation["still"]}
    assert {"drive.speed", "spring.preload", "manufacture.bore"} <= keys and not [key for key in keys if key.startswith("follower")]
    speeds = [
        runner.run(cam.changed({"drive.speed": speed}).spec()).check("separation").margin for speed in ("594 rpm", "600 rpm", "606 rpm")
    ]
    bar = bars["drive.speed"]
    assert np.allclose([bar["low"], separation["base"], bar["high"]], speeds, rtol=1e-9)
    assert bar["effect"] == pytest.approx((speeds[2] - speeds[0]) / 2, rel=1e-9) and bar["effect"] < 0
    assert bar["label"] == "drive · speed" and bar["step"] == "6\u00a0rpm" and separation["unit"] == "N" and separation["kind"] == "check"
    # Half the bore goes off the wall: 0.08 mm per per cent of 16 mm.
    (bore,) = wall["bars"]
    assert bore["key"] == "manufacture.bore" and bore["effect"] == pytest.approx(-0.08, rel=1e-9) and wall["unit"] == "mm"
    # Velocity, acceleration and jerk go with the first, second and third power: ((1 + h)^3 - (1 - h)^3)/2h = 3 + h^2.
    for target, power in zip(motion, (1.0, 2.0, 3.0001), strict=True):
        (speed,) = target["bars"]
        assert target["relative"] and speed["key"] == "drive.speed" and speed["effect"] == pytest.approx(power, rel=1e-9)
    sizes = [abs(bar["effect"]) for bar in separation["bars"]]
    assert sizes == sorted(sizes, reverse=True) and len(sizes) > 2
    assert told[-1][0] == told[-1][1] == 1 + 2 * len(keys) and len(told) > 2


def test_sensitivity_stays_within_limits_and_says_what_cannot_change_alone():
    cam = design("disc_cam")
    answer, _ = asked("sensitivity", cam, locks=CAM_KEPT[1:], share=0.02, on="serial")
    told = {failure["key"]: failure["text"] for failure in answer["failed"]}
    assert "sum to 358.2°" in told["programme.0.angle"]
    angle = next(target for target in answer["targets"] if target["name"] == "check.pressure_angle")
    assert "programme.0.angle" in angle["failed"]
    # The offset is 0: its step is 2 % of the largest length beside it, and counts as 2 per cent.
    offset = next(bar for bar in angle["bars"] if bar["key"] == "follower.offset")
    assert offset["step"] == "0.8\u00a0mm" and offset["effect"] == pytest.approx((offset["high"] - offset["low"]) / 2)
    answer, _ = asked(
        "sensitivity",
        cam,
        locks=(*CAM_KEPT, "follower.offset", "follower.prime_radius"),
        share=1.2,
        on="serial",
        targets=["check.undercut"],
    )
    (roller,) = answer["targets"][0]["bars"]
    assert answer["failed"] == [] and roller["key"] == "follower.roller_radius"  # the radius must be positive: half of it down, 120 % up
    assert roller["effect"] == pytest.approx((roller["high"] - roller["low"]) / 170)


def test_sensitivity_asks_for_something_to_change_and_something_to_look_at():
    cam = design("disc_cam")
    with pytest.raises(SpecError, match="no number of this design is free to change; unlock some"):
        asked("sensitivity", cam, locks=(*CAM_KEPT, "follower"))
    with pytest.raises(UnknownName, match=r"no value or check is called 'check.bore_wal' \(did you mean 'check.bore_wall'\?\)"):
        asked("sensitivity", cam, targets=["check.bore_wal"])


def test_where_one_side_has_no_number_the_other_counts():
    assert _effect(5.0, 4.0, 6.0, at=10.0, steps=(0.1, 0.1)) == pytest.approx(1.0)  # 2 over two per cent
    assert _effect(5.0, math.nan, 6.5, at=10.0, steps=(0.1, 0.1)) == pytest.approx(1.5)
    assert _effect(5.0, 5.0, 6.5, at=-10.0, steps=(0.0, 0.1)) == pytest.approx(1.5)  # no room below
    assert math.isnan(_effect(5.0, math.nan, math.nan, at=10.0, steps=(0.1, 0.1)))
    assert _effect(5.0, 5.0, 5.0 + 1e-15, at=0.0, steps=(0.1, 0.1)) == 0.0


# -- study ---------------------------------------------------------------------------------------------------------------------

RADII = ("follower.prime_radius=38 mm:44 mm:4", "follower.roller_radius=8 mm,-1 mm")


def test_rows_of_a_study_are_those_of_a_sweep():
    cam = design("disc_cam")
    answer, told = asked("study", cam, vary=RADII, on="serial")
    swept = dw.sweep(
        cam.spec(), {"follower.prime_radius": dw.linspace("38 mm", "44 mm", 4), "follower.roller_radius": ["8 mm", "-1 mm"]}, on="serial"
    )
    names = [column["name"] for column in answer["columns"]]
    assert names[:2] == list(swept.plan.keys) and set(swept.check_names) == {name[6:] for name in names if name.startswith("check.")}
    assert [column["role"] for column in answer["columns"]][:2] == ["key", "key"]
    factors = {"mm": 1e3, "°": 180 / math.pi, "": 1.0, "N": 1.0, "MPa": 1e-6}
    compared = 0
    for place, column in enumerate(answer["columns"]):
        found = np.array([math.nan if row[place] is None else row[place] for row in answer["rows"]])
        if column["unit"] in factors:
            assert np.allclose(found, swept[column["name"]] * factors[column["unit"]], rtol=1e-12, equal_nan=True), column
            compared += 1
    assert compared > 8 and answer["failed"] == 4 and answer["total"] == 8 and answer["cases"] == list(range(8))
    assert answer["load"][2] == {"follower.prime_radius": "40 mm", "follower.roller_radius": "8 mm"}
    again = runner.run(cam.changed(answer["load"][4]).spec())
    place = names.index("check.pressure_angle")
    assert answer["rows"][4][place] == pytest.approx(math.degrees(again.check("pressure_angle").margin), rel=1e-12)
    assert answer["passes"][4] == again.ok and not answer["passes"][5] and answer["rows"][5][place] is None
    partials = [partial for *_, partial in told if partial]
    assert partials and partials[0]["rows"] and len(partials[0]["rows"]) <= 8
    statements = answer["statements"]
    assert "4 of 8 cases complete" in statements["verdict"]["text"]
    assert any("greater than 0" in each["text"] for each in statements["reasons"])
    assert answer["figures"] and all(figure["svg"].lstrip().startswith("<") for figure in answer["figures"])


def test_what_a_design_without_a_study_is_told_is_a_study(tmp_path):
    with pytest.raises(SpecError, match="choose at least one parameter to vary and write it") as caught:
        asked("study", design("disc_cam"))
    example = caught.value.message.partition("example:\n")[2]
    again = Design(tomllib.loads((EXAMPLES / "disc_cam.toml").read_text() + "\n" + example), EXAMPLES)
    answer, _ = asked("study", again, samples=3, on="serial", folder=tmp_path / "kept")
    assert len(answer["rows"]) == 3 and answer["failed"] == 0 and any((tmp_path / "kept").iterdir())


def test_the_front_of_a_study_is_of_rows_that_no_other_beats():
    named = ["max_pressure_angle", "profile.max_radius", "check.pressure_angle"]
    cam = design("disc_cam").changed({"study.values": named})
    answer, _ = asked("study", cam, vary=("follower.prime_radius=34 mm:44 mm:4", "follower.offset=0 mm,8 mm,16 mm"), on="serial")
    (front,) = answer["fronts"]
    assert front["objectives"] == [{"name": name, "goal": "minimise"} for name in named[:2]]
    assert [column["name"] for column in answer["columns"]][2:] == named
    points = np.array([row[2:4] for row in answer["rows"]], float)
    good = [n for n, row in enumerate(answer["rows"]) if row[4] >= 0]
    beaten = [any(np.all(points[m] <= points[n]) and np.any(points[m] < points[n]) for m in good) for n in good]
    assert sorted(front["rows"]) == [n for n, worse in zip(good, beaten, strict=True) if not worse]
    assert 1 < len(front["rows"]) < len(good) < 12 and [n for n, passes in enumerate(answer["passes"]) if passes] == good


def test_many_rows_are_thinned_and_the_chosen_ones_stay():
    assert evenly_spaced_rows(5, 10).tolist() == [0, 1, 2, 3, 4]
    found = evenly_spaced_rows(1000, 11, [123, 999])
    assert set(found) >= {0, 100, 123, 999} and len(found) == 12 and np.all(np.diff(found) > 0)


def test_a_look_at_what_is_done_is_taken_now_and_then():
    told, looks = Told(), []
    live = Live(told, lambda: looks.append(1) or {"rows": []})
    for done in range(50):
        live(done, 50, "")
    assert len(told) == 50 and len(looks) == 1 and told[0][3] is None and told[1][3] == {"rows": []}


# -- optimise ------------------------------------------------------------------------------------------------------------------


def test_a_search_for_speed_ends_below_the_acceleration_allowed(monkeypatch):
    """Velocity, acceleration and jerk go with speed, its square and its cube: designs at less speed have less of all three."""
    cam = design("disc_cam")
    lift, angle, allowed = 0.02, math.pi / 2, 140.0
    cam.tables["optimise"] = {
        "seed": 1,
        "population": 8,
        "generations": 2,
        "settings": [{"key": "load.mass", "value": "0.5 kg"}],
        "unknowns": [
            {"key": "drive.speed", "lower": "300 rpm", "upper": "700 rpm"},
            {"key": "spring.preload", "lower": "30 N", "upper": "60 N"},
        ],
        "objectives": [{"value": "max_velocity", "goal": "maximise"}, {"value": "max_jerk", "goal": "minimise"}],
        "requirements": [{"value": "max_acceleration", "at_most": f"{allowed} m/s^2"}],
    }
    kept, problems, prepare = Memory(), [], search.prepare
    monkeypatch.setattr(search, "Memory", lambda: kept)
    monkeypatch.setattr(search, "prepare", lambda spec: problems.append(prepare(spec)) or problems[0])
    answer, _ = asked("optimise", cam, locks=("spring",), on="serial")
    assert set(answer["changes"]) == {"drive.speed", "load.mass"} and answer["changes"]["load.mass"] == "0.5 kg"
    assert answer["evaluations"] == 16 and answer["feasible"] and "Locked and left as they are: spring.preload" in answer["message"]
    front = answer["front"]
    assert [column["name"] for column in front["columns"]] == ["drive.speed", "max_velocity", "max_jerk", "max_acceleration"]
    assert [column["role"] for column in front["columns"]] == ["key", "value", "value", "value"]
    assert [column["unit"] for column in front["columns"]] == ["rpm", "m/s", "m/s³", "m/s²"]
    speed, velocity, jerk, acceleration = np.array(front["rows"]).T
    omega = speed * 2 * math.pi / 60 / angle
    assert np.allclose(velocity, 2 * lift * omega) and np.allclose(acceleration, 2 * math.pi * lift * omega**2)
    assert np.allclose(jerk, 4 * math.pi**2 * lift * omega**3) and np.all(acceleration <= allowed) and len(speed) > 1
    assert velocity[0] == max(velocity) == answer["history"][-1][1] and answer["history"][-1][0] == 16
    assert np.allclose([float(load["drive.speed"].removesuffix(" rpm")) for load in front["load"]], speed, rtol=1e-12)
    (unknown,) = answer["unknowns"]
    assert [unknown[key] for key in ("key", "label", "lower", "upper")] == ["drive.speed", "drive · speed", "300 rpm", "700 rpm"]
    assert float(unknown["best"].removesuffix(" rpm")) == pytest.approx(speed[0], rel=1e-4)
    (requirement,) = answer["requirements"]
    assert requirement["ok"] and requirement["limit"] == "≤ 140\u00a0m/s²" and requirement["name"] == "max_acceleration"
    assert answer["objective"]["goal"] == "maximise" and answer["verdict"]["state"] in ("good", "warn", "bad")
    on_the_way = {
        "cases": 16,
        "history": answer["history"],
        "best": answer["changes"],
        "objective": answer["objective"],
        "tried": answer["tried"],
    }
    assert search._so_far(cam, problems[0], kept) == on_the_way
    tried = answer["tried"]
    assert (
        tried["total"] == len(tried["rows"]) == 16
        and tried["passes"] == [row[-1] <= allowed for row in tried["rows"]]
        and not all(tried["passes"])
    )
    (best,) = tried["fronts"]
    assert [tried["rows"][row] for row in best["rows"]] == front["rows"]
    assert best["objectives"] == [{"name": "max_velocity", "goal": "maximise"}, {"name": "max_jerk", "goal": "minimise"}]
    assert [figure["name"] for figure in answer["figures"]] == ["plot-search"]


def searching(**changes):
    return design("seedling_pusher").changed({f"optimise.{key}": value for key, value in changes.items()})


@pytest.mark.slow
def test_a_search_brings_a_design_that_does_what_it_says():
    pusher = searching(generations=6, population=32)
    answer, told = asked("optimise", pusher, locks=("arm", "train.bend"), on="serial")
    spec = pusher.changed({key: _typed(text) for key, text in answer["changes"].items()}).spec()
    assert not [key for key in answer["changes"] if key.startswith(("arm.", "train.bend"))]
    assert "Locked and left as they are: train.bend, arm.tip_angle" in answer["message"]
    reached = runner.run(spec)["cam.max_pressure_angle"]
    assert answer["front"]["rows"][0][-len(_about(answer))] == pytest.approx(math.degrees(reached), rel=1e-4)
    assert answer["feasible"] == all(each["ok"] for each in answer["requirements"]) and len(answer["requirements"]) == 13
    course = np.array([[math.nan if x is None else x for x in row] for row in answer["history"]])
    assert np.all(np.diff(course[:, 0]) > 0) and course[-1, 0] == answer["evaluations"] and np.all(np.diff(course[:, 2]) <= 0)
    assert len(told) >= 6 and answer["figures"][0]["name"] == "plot-search"


def _typed(text):
    try:
        return float(text)
    except ValueError:
        return text


def _about(answer):
    return [column for column in answer["front"]["columns"] if column["role"] != "key"]


def test_a_search_without_anything_to_change_says_so():
    pusher = searching(generations=1)
    keys = [unknown["key"] for unknown in pusher.tables["optimise"]["unknowns"]]
    with pytest.raises(SpecError, match="every unknown is locked .*so nothing may change; unlock one"):
        asked("optimise", pusher, locks=keys)
    assert len(pusher.tables["optimise"]["unknowns"]) == len(keys)  # the design itself is as it was
    with pytest.raises(SpecError, match=r"(?s)Choose the parameters to vary and an objective.*optimise\.unknowns"):
        asked("optimise", design("four_bar"))


# -- solids --------------------------------------------------------------------------------------------------------------------


def test_a_shaft_is_a_smooth_cylinder_with_two_sharp_rims():
    answer, told = asked("solid", design("pressure_roller_shaft"))
    (part,), unit = answer["parts"], answer["unit"]
    points, normals, rims = solid_corners(part)
    length, radius = 0.34, 0.01
    a, b, c = np.moveaxis(points.reshape(-1, 3, 3), 1, 0)
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    assert unit == "m" and volume == pytest.approx(math.pi * radius**2 * length, rel=0.01) and len(points) == 3 * part["triangles"]
    assert np.linalg.norm(rims[:, 1] - rims[:, 0], axis=1).sum() == pytest.approx(2 * 2 * math.pi * radius + length, rel=0.01), (
        "with a line along it that shows how it turns"
    )
    ends = np.abs(normals[:, 0]) > 0.5
    assert np.allclose(np.abs(normals[ends]), [1, 0, 0], atol=1e-6)
    outward = (points - (points.min(axis=0) + points.max(axis=0)) / 2) * [0, 1, 1]
    assert np.allclose(normals[~ends], (outward / radius)[~ends], atol=1e-5)  # those of the true cylinder, not of its facets
    assert answer["size"] == pytest.approx(np.linalg.norm([length, 2 * radius, 2 * radius]), rel=1e-3) and told == [(0, 1, "shaft", None)]


def test_a_cube_keeps_its_twelve_edges_and_its_flat_faces():
    points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    corners = np.array([corner for a, b, c, d in quads for corner in ((a, b, c), (a, c, d))])
    packed = shaded(points[corners].reshape(-1, 3), np.arange(36).reshape(-1, 3))  # every triangle with points of its own
    points, normals, edges = solid_corners(packed)
    assert len(edges) == 12 and np.allclose(np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1), 1)
    assert np.allclose(np.abs(normals).max(axis=1), 1) and np.allclose(normals.sum(axis=0), 0)
    assert np.all(np.einsum("ij,ij->i", normals, points - 0.5) > 0) and len(vectors(packed["positions"])) == 24


# -- figures -------------------------------------------------------------------------------------------------------------------


def test_figures_are_what_the_page_does_not_draw_itself(monkeypatch):
    runs, once = [], runner.run
    monkeypatch.setattr(runner, "run", lambda *given: runs.append((once(*given), given[-1])) or runs[-1][0])
    bar = design("four_bar")
    answer, told = asked("figures", bar, analyses=("rest",))
    ((result, model),) = runs
    seen = views(result, model)
    linked = {f"plot-{plot.name}" for plot in seen.plots if pack_plots(result, seen.scene, (plot,))}
    every = {picture.name for picture in pictures(result, seen)}
    names = {figure["name"] for figure in answer["figures"]}
    assert linked and names == {name for name in every - linked if not name.startswith("scene-")} and "drawing-crank" in names
    known = registry.mechanism(bar.kind).analyses
    assert set(result.provenance["analyses"]) == {a.name for a in known if a.default} | {"rest"}
    assert {each["name"]: each["missing"] for each in answer["requests"]} == {
        a.name: a.missing(bar.spec()) for a in known if not a.default and a.name != "rest"
    }
    assert "no [wear] table" in next(each["missing"] for each in answer["requests"] if each["name"] == "wear")
    assert told[-1][2] == "drawing" and told[-1][0] == told[-1][1] == len(result.provenance["analyses"])


def test_a_dark_figure_has_the_dark_colours():
    svg = '<path style="fill: #ffffff; stroke: #1a222c"/><image href="data:#1A222C #123456 #ffffff0"/>'
    assert themed(svg, "light") == svg
    assert themed(svg, "dark") == '<path style="fill: #171c22; stroke: #e8edf2"/><image href="data:#1A222C #123456 #ffffff0"/>'


# -- files ---------------------------------------------------------------------------------------------------------------------


def test_a_drawing_is_the_file_of_the_command_line(tmp_path):
    import ezdxf

    cam = design("disc_cam")
    answer, told = asked("export", cam, format="dxf")
    name, data = one_file(answer)
    (path,) = exported(cam.spec(), ("dxf",), tmp_path)
    assert name == "Disc-cam-with-a-spring-loaded-roller.dxf" and data == path.read_bytes()
    assert told == [(0, 1, "dxf", None)]
    (tmp_path / name).write_bytes(data)
    assert not ezdxf.readfile(tmp_path / name).audit().errors


def test_several_files_are_one_archive_that_is_always_the_same(tmp_path):
    four_bar = design("four_bar")
    name, data = one_file(asked("export", four_bar, format="svg")[0])
    written = {path.name: path.read_bytes() for path in exported(four_bar.spec(), ("svg",), tmp_path)}
    assert name == "Crank-rocker-four-bar-svg.zip" and unpacked(data) == written and len(written) == 3
    assert one_file(asked("export", four_bar, format="svg")[0])[1] == data
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_what_should_not_be_made_is_refused_in_words():
    small = design("disc_cam").changed({"follower.prime_radius": "12 mm", "manufacture.bore": "4 mm", "manufacture.hub_diameter": "6 mm"})
    with pytest.raises(GeometryCheckFailed, match=r"this design fails a geometry check and is not exported: .* or export it with --anyway"):
        asked("export", small, format="dxf")
    assert one_file(asked("export", small, format="dxf", anyway=True)[0])[0].endswith(".dxf")
    with pytest.raises(UnknownName, match="no export format is called 'dwg'"):
        asked("export", small, format="dwg")


@pytest.mark.parametrize(
    "title, name", [("../up \\ a: b?\n[x]", "up-a-b-x.toml"), ("", "cam.toml"), ("凸轮 1", "凸轮-1.toml"), ("n" * 300, "n" * 80 + ".toml")]
)
def test_a_saved_design_is_the_design_whatever_its_title(title, name):
    cam = design("disc_cam").changed({"title": title})
    found, data = one_file(asked("save", cam)[0])
    assert found == name and tomllib.loads(data.decode()) == cam.tables
    assert data.startswith(b"# Written by the studio of Drivewright ") and f"drivewright run {name}\n".encode() in data


def test_a_design_with_data_files_is_saved_with_them(tmp_path):
    cam = design("oscillating_cam")
    name, data = one_file(asked("save", cam)[0])
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        archive.extractall(tmp_path)
    assert name == "Conjugate-cams-with-a-measured-swing.zip" and set(unpacked(data)) == {name.replace("zip", "toml"), "data/lift.csv"}
    assert load(tmp_path / name.replace("zip", "toml")).digest() == cam.spec().digest()


def test_the_report_is_a_page_or_the_whole_run_folder():
    cam = design("oscillating_cam")
    name, page = one_file(asked("report", cam)[0])
    assert name == "Conjugate-cams-with-a-measured-swing.html" and b"data/lift.csv" in page and cam.spec().digest()[:12].encode() in page
    name, data = one_file(asked("report", cam, whole=True)[0])
    files = unpacked(data)
    stem = "Conjugate-cams-with-a-measured-swing"
    wanted = {f"{stem}/{each}" for each in ("result.json", "report.html", "spec.toml", "data/lift.csv")}
    assert name == f"{stem}.zip" and wanted <= set(files)
    assert json.loads(files[f"{stem}/result.json"])["digest"] == cam.spec().digest()


def test_the_report_has_solids_in_motion_and_the_language_where_they_are_asked_for():
    bar = design("four_bar")
    answer, told = asked("report", bar, solids=True, language="zh")
    page = one_file(answer)[1].decode()
    assert '"solids":{' in page and 'lang="zh' in page and "设计校核" in page
    shares = [(done, total) for done, total, *_ in told]
    assert shares[-1] == (shares[-1][1] - 1, shares[-1][1]) and all(done < total for done, total in shares)  # the figures are to come
    plain = one_file(asked("report", bar)[0])[1].decode()
    assert '"solids":{' not in plain and 'lang="en' in plain
    with pytest.raises(UnknownName, match="language of reports"):
        asked("report", bar, language="../zh")


def test_the_jobs_are_those_of_the_page():
    named = "sensitivity fix reach timing study optimise solid fields figures export report save"
    assert list(JOBS) == named.split()
