"""The formulas behind the studio's jobs, each on its own: how values are written, how a search goes on, which rows are told."""

import io
import math
import tomllib
import zipfile
from types import SimpleNamespace

import numpy as np
import pytest
from packed_solids import solid_corners
from places import EXAMPLES

from drivewright import runner
from drivewright.errors import SpecError
from drivewright.execution.case_table import CASE, STATUS
from drivewright.execution.keys import KeyKind, key_kind
from drivewright.execution.outputs import CHECK, MARGIN_OF, OutputInfo
from drivewright.report import solids
from drivewright.report.solids import shaded
from drivewright.studies.plan import Block, Plan
from drivewright.studies.variables import Variable
from drivewright.studio.design import Design
from drivewright.studio.jobs import figures, files, search, solid, trade_off
from drivewright.studio.jobs import study as studying
from drivewright.studio.jobs.design_keys import input_text, label, numeric, plain
from drivewright.units import SI

pytestmark = pytest.mark.interface


def design(name):
    path = EXAMPLES / f"{name}.toml"
    return Design(tomllib.loads(path.read_text()), path.parent)


class Columns(dict):
    """Columns by name, with whatever else a table or a study has."""

    def __init__(self, data, **more):
        super().__init__(data)
        self.__dict__.update(more)

    def __len__(self):
        return len(next(iter(self.values())))

    def bounds(self, name):
        """No column of these has intervals."""


# -- keys ----------------------------------------------------------------------------------------------------------------------


def test_a_value_is_written_as_it_is_read_to_the_last_digit():
    spec = design("disc_cam").spec()
    radius, ratio = key_kind(spec, "follower.prime_radius"), key_kind(spec, "vibration.damping_ratio")
    assert input_text(radius, SI(0.04)) == input_text(radius, 0.04) == "40 mm" and input_text(ratio, 0.05) == "0.05"
    exact = 0.1 + 0.2
    assert float(input_text(ratio, exact)) == exact and radius.read(input_text(radius, exact), "here") == exact
    assert [input_text(KeyKind("integer"), 12.0), input_text(KeyKind("flag"), True), input_text(KeyKind("text"), "cycloidal")] == [
        "12",
        "true",
        "cycloidal",
    ]
    assert input_text(key_kind(design("hyvo_chain").spec(), "joint.offset"), "match-drive") == "match-drive"


def test_numbers_are_told_in_the_unit_people_read_or_not_at_all():
    assert plain(0.04, "m") == pytest.approx(40) and plain(math.pi, "rad") == pytest.approx(180) and plain(2.5) == 2.5
    assert plain(math.nan) is None and plain(-math.inf, "m") is None


def test_whole_numbers_texts_and_words_do_not_vary_by_per_cent():
    chain = design("hyvo_chain")
    found = numeric(chain, chain.spec())
    assert found["drive.speed"][1] == pytest.approx(2000 * 2 * math.pi / 60) and found["cutter.half_angle"][1] == pytest.approx(math.pi / 6)
    assert not {"links", "teeth.0", "joint.offset", "joint.kind", "mechanism", "title"} & set(found) and len(found) == 12


def test_a_label_has_the_names_of_elements_and_no_underscores():
    tables = {"wear_marks": [{"name": "B"}, {"name": ""}, {}], "speeds": ["1 rpm"]}
    assert [label(tables, key) for key in ("wear_marks.0.end_gap", "wear_marks.1.a", "wear_marks.2", "wear_marks.7.a", "speeds.0")] == [
        "wear marks · B · end gap",
        "wear marks · 2 · a",
        "wear marks · 3",
        "wear marks · 8 · a",
        "speeds · 1",
    ]


# -- search --------------------------------------------------------------------------------------------------------------------


def problem(sign=-1.0, violation=(0.0,)):
    return SimpleNamespace(
        objectives=[("gap", sign)], about={"gap": OutputInfo("m", "smallest gap")}, total_violation=lambda values: np.array(violation)
    )


def test_the_course_of_a_search_has_every_improvement_and_the_end():
    values = {"gap": np.array([9.0, 1.0, 2.0, math.nan, 1.5, 3.0, 2.5]) * 1e-3}
    violation = (0.5, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0)
    course, best = search._best_so_far(problem(violation=violation), values)
    assert course == [[1, None, 0.5], [2, None, 0.2], [3, pytest.approx(2), 0], [6, pytest.approx(3), 0], [7, pytest.approx(3), 0]]
    assert best == 5
    course, best = search._best_so_far(problem(1.0, violation), values)
    assert course == [[1, None, 0.5], [2, None, 0.2], [3, pytest.approx(2), 0], [5, pytest.approx(1.5), 0], [7, pytest.approx(1.5), 0]]
    assert best == 4


def test_while_no_design_is_allowed_the_nearest_is_the_best():
    course, best = search._best_so_far(problem(1.0, (0.5, 0.2, 0.3)), {"gap": np.array([1.0, 2.0, 3.0])})
    assert course == [[1, None, 0.5], [2, None, 0.2], [3, None, 0.2]] and best == 1
    assert search._so_far(None, problem(), SimpleNamespace(tables=list)) is None


def test_what_a_search_wants_is_told_with_its_direction():
    assert search._objective(problem(-1.0)) == {"name": "gap", "label": "Smallest gap", "unit": "mm", "goal": "maximise"}
    assert search._objective(problem(1.0))["goal"] == "minimise"


@pytest.mark.parametrize(
    "front, feasible, left_out, said",
    [
        (3, True, ["a.b"], "3 designs that no other beats, of 40. Locked and left as they are: a.b"),
        (1, True, ["a", "b"], "the best of 40 designs. Locked and left as they are: a, b"),
        (1, False, [], "no design of 40 meets every requirement; this one comes nearest"),
        (2, False, [], "no design of 40 meets every requirement; this one comes nearest"),
    ],
)
def test_the_message_of_a_search(front, feasible, left_out, said):
    assert search._message(SimpleNamespace(front=[0] * front, feasible=feasible, evaluations=40), left_out) == said


def test_settings_of_a_search_go_with_its_unknowns():
    length = key_kind(design("disc_cam").spec(), "follower.offset")
    set_too = [SimpleNamespace(key="a", value=True), SimpleNamespace(key="b", value="lowest"), SimpleNamespace(key="c", value=3)]
    found = SimpleNamespace(search=SimpleNamespace(settings=set_too), keys=("x.y",), kinds=(length,))
    assert trade_off.settings(found, np.array([0.002])) == {"a": "true", "b": "lowest", "c": "3", "x.y": "2 mm"}


def test_unknowns_that_are_locked_are_left_out_of_the_search_alone():
    cam = design("disc_cam")
    cam.tables["optimise"] = {"unknowns": [{"key": key} for key in ("follower.offset", "spring.preload", "programme.0.rise")]}
    free, left_out = search._freed(cam, ("spring", "programme.0"))
    assert [unknown["key"] for unknown in free.tables["optimise"]["unknowns"]] == ["follower.offset"]
    assert left_out == ["spring.preload", "programme.0.rise"] and len(cam.tables["optimise"]["unknowns"]) == 3
    assert search._freed(cam, ())[1] == []
    cam.tables["optimise"] = {}
    assert search._freed(cam, ("spring",))[1] == []  # what is missing in it, the spec says
    del cam.tables["optimise"]
    with pytest.raises(SpecError, match=r"write them into the text of the design, for example:\n\[\[optimise.unknowns\]\]"):
        search._freed(cam, ())


# -- study ---------------------------------------------------------------------------------------------------------------------


def test_a_look_takes_a_small_share_of_the_time(monkeypatch):
    now, looks, cost = [100.0], [], [0.0]

    def look():
        looks.append(now[0])
        now[0] += cost[0]

    monkeypatch.setattr(studying, "time", SimpleNamespace(monotonic=lambda: now[0]))
    live = studying.Live(lambda *told: None, look)
    live(0, 9, "")  # nothing is done yet
    for step in range(8):
        now[0] = 100 + 0.2 * step
        live(1, 9, "")
    assert looks == pytest.approx([100, 100.6, 101.2])
    now[0], cost[0] = 200.0, 3.0
    live(2, 9, "")
    for late in (232.9, 233.1):
        now[0] = late
        live(3, 9, "")
    assert looks[3:] == [200.0, 233.1]  # 3 s long, then ten times as long none


def test_a_front_is_told_by_rows_and_with_its_directions():
    wanted = SimpleNamespace(objectives=[SimpleNamespace(value="speed", goal="maximise")])
    study = Columns({CASE: np.array([3, 5, 9, 12])}, spec=SimpleNamespace(optimise=wanted))
    names = ("speed", "mass", CASE, "other")
    table = Columns({CASE: SimpleNamespace(data=[9, 3])}, columns=[SimpleNamespace(name=name) for name in names])
    assert studying._fronts(study, SimpleNamespace(tables={"front": table})) == [
        {"name": "front", "objectives": [{"name": "speed", "goal": "maximise"}, {"name": "mass", "goal": "minimise"}], "rows": [2, 0]}
    ]
    study.spec.optimise = None
    assert studying._fronts(study, SimpleNamespace(tables={"front": table}))[0]["objectives"][0]["goal"] == "minimise"
    assert studying._fronts(study, SimpleNamespace(tables={})) == []


def cases(count):
    """A study of four columns with one key, of the disc cam."""
    cam = design("disc_cam")
    kind = key_kind(cam.spec(), "follower.offset")
    offsets = np.arange(count) * 1e-3
    plan = Plan((), (Variable("follower.offset", kind, 0.0),), offsets[:, None], (Block("grid", 0, count),), {})
    margins = np.where(np.arange(count) % 4 == 1, -0.1, 0.0)
    status = np.where(np.arange(count) % 4 == 2, "failed", "complete")
    about = {"follower.offset": "m", f"{CHECK}wall": "m"}
    columns = {"follower.offset": offsets, f"{CHECK}wall": margins, CASE: 10 + np.arange(count), STATUS: status}
    return cam, Columns(
        columns,
        spec=cam.changed({"study.values": []}).spec(),
        plan=plan,
        value_names=(),
        check_names=("wall",),
        unit=about.__getitem__,
        meaning=lambda name: f"{MARGIN_OF}thin wall",
    )


def test_rows_are_thinned_with_all_that_belongs_to_them():
    cam, study = cases(9)
    rows = studying._rows(cam, study, 3, [5])
    assert rows["cases"] == [10, 14, 15, 18] and rows["total"] == 9
    assert rows["load"] == [{"follower.offset": f"{n} mm"} for n in (0, 4, 5, 8)]
    assert np.allclose(rows["rows"], [[0, 0], [4, 0], [5, -100], [8, 0]])
    assert rows["passes"] == [True, True, False, True] and studying._rows(cam, study, 9)["passes"][2:4] == [False, True]
    assert rows["columns"] == [
        {"name": "follower.offset", "label": "follower · offset", "unit": "mm", "role": "key"},
        {"name": f"{CHECK}wall", "label": "Thin wall", "unit": "mm", "role": "check"},
    ]


def test_the_even_part_has_both_ends_and_no_row_twice():
    found = studying.evenly_spaced_rows(10, 4, [3])
    assert found.tolist() == [0, 3, 6, 9] and studying.evenly_spaced_rows(7, 7, [2]).tolist() == list(range(7))


# -- figures -------------------------------------------------------------------------------------------------------------------


def test_a_run_for_figures_has_the_analyses_asked_for_besides_the_default_ones(monkeypatch):
    asked = []

    def run(spec, only, everything, tell, model):
        asked.append((only, everything))
        raise SpecError("enough")

    monkeypatch.setattr(figures.runner, "run", run)
    monkeypatch.setattr(runner, "run", run)
    for options in ({}, {"analyses": ("rest",)}, {"everything": True}):
        with pytest.raises(SpecError, match="enough"):
            figures.figures(design("four_bar"), None, **options)
    (default, _), (more, _), last = asked
    assert default and "rest" not in default and more == (*default, "rest") and last == ((), True) and not asked[1][1]


# -- files ---------------------------------------------------------------------------------------------------------------------


def test_an_archive_is_sorted_small_and_readable_for_everyone():
    data = files.archive({"b/c.txt": b"x" * 5000, "a.txt": b"y"})
    with zipfile.ZipFile(io.BytesIO(data)) as found:
        entries = found.infolist()
        assert [entry.filename for entry in entries] == ["a.txt", "b/c.txt"] and found.read("b/c.txt") == b"x" * 5000
    assert all(entry.external_attr == 0o644 << 16 and entry.create_system == 3 for entry in entries) and len(data) < 1000


def test_one_file_takes_the_name_of_the_design_and_several_an_archive():
    alone = files._files("cam", "csv", {"whatever.table.csv": b"1"})
    assert alone == {"files": [{"name": "cam.csv", "data": b"1"}]}
    (both,) = files._files("cam", "csv", {"a.csv": b"1", "b.csv": b"2"})["files"]
    assert both["name"] == "cam-csv.zip" and both["data"] == files.archive({"b.csv": b"2", "a.csv": b"1"})


def test_saving_leaves_the_design_as_it_is():
    cam = design("oscillating_cam")
    before = repr(cam.tables)
    files.save(cam, None)
    assert repr(cam.tables) == before


# -- solids --------------------------------------------------------------------------------------------------------------------


def test_a_lone_triangle_is_all_edge_and_one_without_area_is_nothing():
    points = np.array([[0, 0, 0], [2, 0, 0], [0, 3, 0], [1, 0, 0]], float)
    packed = shaded(points, np.array([[0, 1, 2], [0, 1, 3]]))
    corners, normals, edges = solid_corners(packed)
    assert len(corners) == 3 and np.allclose(normals, [0, 0, 1])
    lengths = np.linalg.norm(np.diff(edges, axis=1)[:, 0], axis=1)
    assert sorted(lengths) == pytest.approx([2, 3, math.sqrt(13)])


@pytest.mark.parametrize("turn, sharp", [(25, False), (35, True)])
def test_faces_that_turn_by_more_than_thirty_degrees_meet_in_an_edge(turn, sharp):
    """Two unit squares that meet at x = 0; below the crease the normal there stands between the two, at half the angle."""
    angle = math.radians(turn)
    down = [math.cos(angle), 0.0, -math.sin(angle)]
    points = np.array([[-1, 0, 0], [-1, 1, 0], [0, 0, 0], [0, 1, 0], down, [down[0], 1, down[2]]], float)
    packed = shaded(points, np.array([[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]]))
    corners, normals, ends = solid_corners(packed)
    shared = np.all(np.abs(ends[:, :, 0]) < 1e-6, axis=1)
    assert shared.sum() == sharp and len(ends) == 6 + shared.sum()
    middle = normals[np.abs(corners[:, 0]) < 1e-6]
    between = [math.sin(angle / 2), 0, math.cos(angle / 2)]
    assert np.allclose(middle, between, atol=1e-6) != sharp


def test_each_face_counts_by_its_angle_at_the_corner():
    """A flat right angle beside half a right angle, 20 degrees on: the normal leans to the wider one, by their angles."""
    a = math.radians(20)
    points = np.array([[0, 0, 0], [0, 1, 0], [-1, 0, 0], [math.cos(a), 1, -math.sin(a)]], float)
    packed = shaded(points, np.array([[0, 1, 2], [0, 3, 1]]))
    flat, tilted = np.array([0, 0, 1.0]), np.array([math.sin(a), 0, math.cos(a)])
    wanted = 90 * flat + 45 * tilted
    corners, normals, _ = solid_corners(packed)
    found = normals[np.all(corners == 0, axis=1)]
    assert np.allclose(found, wanted / np.linalg.norm(wanted), atol=1e-6)


def test_the_size_of_an_assembly_is_that_of_the_box_around_its_parts(monkeypatch):
    places = (("left", "blue", -2.0), ("right", "steel", 1.0))
    parts = [SimpleNamespace(name=name, colour=colour, body="", turning=None, at=at) for name, colour, at in places]
    tetrahedron = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 2]], float), np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    kind = SimpleNamespace(kind="cam", analyses=(), parts=lambda model: parts, scene=None)
    monkeypatch.setattr(solid, "registry", SimpleNamespace(mechanism=lambda name: kind))
    monkeypatch.setattr(solid.runner, "build", lambda spec: None)
    monkeypatch.setattr(solids.facets, "viewed_triangles", lambda part, tolerance: (tetrahedron[0] + [part.at, 0, 0], tetrahedron[1]))
    told = []
    answer = solid.solid(design("disc_cam"), lambda *words: told.append(words))
    assert answer["low"] == [-2, 0, 0] and answer["high"] == [2, 2, 2] and answer["size"] == pytest.approx(math.sqrt(24))
    assert [(part["name"], part["colour"], part["triangles"]) for part in answer["parts"]] == [("left", "blue", 4), ("right", "steel", 4)]
    assert [part["motion"] for part in answer["parts"]] == [-1, -1] and answer["motions"] == []
    assert told == [(0, 2, "left"), (1, 2, "right")]
