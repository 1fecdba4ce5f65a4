"""What a study says, on tables made by hand whose answers are known."""

import re
import warnings

import numpy as np
import pyarrow as pa
import pytest
from places import EXAMPLES
from scipy.stats import norm

import drivewright as dw
from drivewright.errors import UnknownName
from drivewright.report.study import varied
from drivewright.result import Plot
from drivewright.spec import document, from_document
from drivewright.studies.answers import analyse_study
from drivewright.studies.plan import make_plan
from drivewright.studies.study import Study

pytestmark = pytest.mark.property

SPEC = document(dw.load(EXAMPLES / "disc_cam.toml"))
ROLLER, PRIME, FORCE = "follower.roller_radius", "follower.prime_radius", "load.force"
RANDOM = [{"key": ROLLER, "tolerance": "0.6 mm"}, {"key": PRIME, "lower": "38 mm", "upper": "42 mm"}]
LEVELS = {"key": FORCE, "values": ["10 N", "20 N", "40 N"]}
STEEL = {"key": "material", "values": ["16MnCr5", "42CrMo4"]}
CUT = np.sqrt(1 - 6 * norm.pdf(3) / (1 - 2 * norm.cdf(-3)))  # standard deviation of a normal distribution cut off at three of them
METHODS = ("latin-hypercube", "sobol", "random", "corners", "one-at-a-time", "tolerance", "sobol-indices")


def spec_of(vary, optimise=None, **study):
    tables = {"study": {"vary": vary} | study} | ({"optimise": optimise} if optimise else {})
    return from_document(SPEC | tables)


def made(spec, status=None, keep=None, unit="m", **columns):
    """A `Study` whose values are functions of the keys {key: (n,)}; `check_x` is check.x; None is a column without any number."""
    plan = make_plan(spec)
    cases = plan.cases(0, len(plan))
    states = np.full(len(plan), "complete") if status is None else np.asarray(status)[np.arange(len(plan)) % len(status)]
    reasons = [f"misses by {number} mm at the {state} joint" if state != "complete" else "" for number, state in enumerate(states)]
    fields, arrays = [], []

    def add(name, array, unit):
        fields.append(pa.field(name, array.type, metadata={"unit": unit, "meaning": f"the {name}"}))
        arrays.append(array)

    for name, column in {"case": np.arange(len(plan)), "status": states, "message": reasons, **cases}.items():
        add(name, pa.array(column), "")
    for name, function in columns.items():
        numbers = pa.nulls(len(plan)) if function is None else np.broadcast_to(np.asarray(function(cases), float), len(plan))
        add(name.replace("check_", "check."), numbers if function is None else pa.array(numbers, mask=~np.isfinite(numbers)), unit)
    table = pa.Table.from_arrays(arrays, schema=pa.schema(fields))
    return Study(spec, plan, table if keep is None else table.take(np.flatnonzero(keep(np.arange(len(plan))))))


def straight(cases):
    """3 x roller - 2 x prime, whatever else varies."""
    return 3.0 * cases[ROLLER] - 2.0 * cases[PRIME]


def rows(result, table, **wanted):
    """Rows of a table as dictionaries, those with the wanted entries."""
    return [row for row in result.table(table).to_pylist() if all(row[name] == value for name, value in wanted.items())]


# -- random samples ------------------------------------------------------------------------------------------------------------


def test_a_straight_value_under_tolerances():
    """Sigma by root sum of squares, shares, worst case at the corners and by linear theory: all in closed form, all the same."""
    result, plots = analyse_study(made(spec_of(RANDOM, method="tolerance", samples=400), y=straight))
    parts = np.array([3 * 0.2e-3 * CUT, 2 * 4e-3 / np.sqrt(12)])
    least, greatest = 3 * 8e-3 - 2 * 40e-3 + np.array([-1, 1]) * (3 * 0.6e-3 + 2 * 2e-3)
    assert result["linear.sigma.y"] == pytest.approx(np.hypot(*parts), rel=1e-9)
    assert [result["linear.least.y"], result["linear.greatest.y"]] == pytest.approx([least, greatest], rel=1e-9)
    assert [result["worst_case.least.y"], result["worst_case.greatest.y"]] == pytest.approx([least, greatest], rel=1e-9)
    for method, error in (("linear", 1e-9), ("regression", 0.02), ("ranks", 0.2)):
        found = {row["key"]: row["share"] for row in rows(result, "contributions", value="y", method=method)}
        assert [found[ROLLER], found[PRIME]] == pytest.approx(parts**2 / np.sum(parts**2), abs=error)
    assert result["determination.y"] == pytest.approx(1.0, abs=1e-9)
    assert result["sigma.y"] == pytest.approx(np.hypot(*parts), rel=0.05) and result["mean.y"] == pytest.approx(-56e-3, abs=2e-5)
    slopes = {row["key"]: row["slope"] for row in rows(result, "linear", value="y")}
    assert slopes == {ROLLER: pytest.approx(3.0), PRIME: pytest.approx(-2.0)}
    by_name = {plot.name: plot for plot in plots}
    assert by_name["histogram.y"].style == "histogram" and by_name["contributions.y"].y == ("linear", "regression", "ranks")
    assert len(rows(result, "sample")) == 400  # neither steps nor corners


def test_sobol_indices_of_a_straight_value():
    result, plots = analyse_study(made(spec_of(RANDOM, method="sobol-indices", samples=2048), y=straight))
    parts = np.array([(3 * 0.2e-3 * CUT) ** 2, (2 * 4e-3) ** 2 / 12])
    found = {row["key"]: row for row in rows(result, "indices", value="y")}
    for name in ("first_order", "total"):
        assert [found[key][name] for key in (ROLLER, PRIME)] == pytest.approx(parts / parts.sum(), abs=0.01)
        assert all(found[key][f"{name}.low"] < found[key][name] < found[key][f"{name}.high"] for key in found)
    assert {plot.name: plot.reference for plot in plots}["indices.y"] == ("first_order.low", "first_order.high")
    assert rows(result, "confidence", value="y")[0]["cases"] == 2 * 2048  # A and B, not the mixed points
    assert "contributions" not in result.tables


def test_neighbours_of_a_sobol_sequence_are_not_random_so_ranks_say_nothing():
    for method, ranked in (("sobol", False), ("random", True), ("latin-hypercube", True)):
        result, _ = analyse_study(made(spec_of(RANDOM, method=method, samples=256), y=straight))
        assert bool(rows(result, "contributions", method="ranks")) == ranked


def test_yield_counts_what_passes_and_what_could_not_be_computed():
    """Of 100 cases a tenth fails to run, a tenth is not complete; a passes below the middle, b always, c exists in none that ran."""
    spec = spec_of(RANDOM, method="random", samples=100)
    there = np.arange(100) % 10 != 9
    study = made(
        spec,
        status=["complete"] * 8 + ["partial", "failed"],
        y=straight,
        check_a=lambda c: np.where(there, 44.5 - np.arange(100), np.nan),
        check_b=lambda c: np.where(there, 2.0, np.nan),
        check_c=None,
    )
    result, _ = analyse_study(study)
    found = {row["check"]: row for row in rows(result, "yield")}
    passing = int(np.sum(np.arange(45) % 10 < 8))
    assert [found[name]["passes"] for name in ("a", "b", "c", "all checks")] == [int(np.sum(there[:45])), 90, 0, passing]
    assert all(found[name]["cases"] == 100 for name in ("a", "b", "all checks")) and found["c"]["cases"] == 10
    assert result["yield"] == passing / 100 and result["yield.low"] < passing / 100 < result["yield.high"]
    margins = (44.5 - np.arange(100))[there]
    assert found["a"]["capability"] == pytest.approx(margins.mean() / (3 * margins.std(ddof=1)), rel=1e-12)
    assert (result["cases"], result["cases.failed"], result["cases.complete"]) == (100, 10, 80)
    said = "10 of 100 cases are failed; 10 times: misses by 9 … 99 mm at the failed joint (the first: misses by 9 mm at the failed joint)"
    assert said in result.findings


def test_another_unit_of_a_value_scales_its_spread_and_no_share():
    spec = spec_of(RANDOM, method="tolerance", samples=200)
    one, _ = analyse_study(made(spec, y=straight))
    other, _ = analyse_study(made(spec, y=lambda c: 1e3 * straight(c) + 4.0))
    for name in ("sigma.y", "linear.sigma.y"):
        assert other[name] == pytest.approx(1e3 * one[name], rel=1e-9)
    for name in ("mean.y", "worst_case.least.y", "linear.greatest.y"):
        assert other[name] == pytest.approx(1e3 * one[name] + 4.0, rel=1e-9)
    shares = [[row["share"] for row in rows(result, "contributions")] for result in (one, other)]
    assert shares[1] == pytest.approx(shares[0], rel=1e-6, abs=1e-9)


# -- grids ---------------------------------------------------------------------------------------------------------------------


def test_a_map_over_two_keys_and_a_panel_for_each_level_of_a_third():
    grid = [{"key": ROLLER, "lower": "6 mm", "upper": "9 mm", "steps": 4}, STEEL, {"key": PRIME, "values": ["40 mm", "50 mm", "70 mm"]}]
    hard = lambda c: np.where(c["material"] == "42CrMo4", 1.0, 0.0)  # noqa: E731
    study = made(
        spec_of(grid), y=lambda c: straight(c) + hard(c), check_a=lambda c: c[PRIME] - 0.045, check_b=lambda c: 100 * (c[ROLLER] - 6.5e-3)
    )
    result, plots = analyse_study(study)
    by_name = {plot.name: plot for plot in plots}
    assert by_name["map.y.2"].style == "map" and by_name["map.y.2"].y == (PRIME, "y") and "42CrMo4" in by_name["map.y.2"].title
    assert by_name["curve.y.1"].by == PRIME and "curve.checks.failing.1" not in by_name
    for table, extra in (("response.1", 0.0), ("response.2", 1.0)):
        found = rows(result, table)
        assert len(found) == 12
        for row in found:
            assert row["y"] == pytest.approx(3 * row[ROLLER] - 2 * row[PRIME] + extra)
            a, b = row[PRIME] - 0.045, 100 * (row[ROLLER] - 6.5e-3)
            assert row["checks.failing"] == (a < 0) + (b < 0)
            assert row["checks.margin"] == pytest.approx(min(a / 0.025, b / 0.25))
    assert (result["least.y"], result["greatest.y"]) == pytest.approx((3 * 6e-3 - 0.14, 3 * 9e-3 - 0.08 + 1))
    assert rows(result, "range", value="y")[0]["greatest.case"] == 3 * 6 + 3


def test_many_further_levels_are_shown_at_the_first_and_a_finding_says_so():
    grid = [{"key": ROLLER, "lower": "6 mm", "upper": "9 mm", "steps": 4}, {"key": PRIME, "values": ["40 mm", "50 mm"]}, LEVELS, STEEL]
    result, _ = analyse_study(made(spec_of(grid), y=lambda c: straight(c) + c[FORCE]))
    assert [name for name in result.tables if name.startswith("response")] == ["response"]
    expected = [3 * r - 2 * p + 10 for r in (6e-3, 7e-3, 8e-3, 9e-3) for p in (40e-3, 50e-3)]
    assert [row["y"] for row in rows(result, "response")] == pytest.approx(expected, rel=1e-12)
    told = " ".join(result.findings).replace("\u00a0", " ")
    assert f"one of 6 combinations of {FORCE}, material: {FORCE} = 10 N, material = 16MnCr5" in told


def test_whole_numbers_are_an_axis_and_flags_are_words():
    pusher = document(dw.load(EXAMPLES / "seedling_pusher.toml"))
    vary = [{"key": "train.teeth", "values": [19, 21, 23]}, {"key": "cams.coplanar_rollers", "values": [True, False]}]
    spec = from_document({name: table for name, table in pusher.items() if name != "optimise"} | {"study": {"vary": vary}})
    found = analyse_study(made(spec, y=lambda c: c["train.teeth"] + 100.0 * c["cams.coplanar_rollers"]))
    consistent(found)
    assert found.plots[0].x == "train.teeth" and found.plots[0].by == "cams.coplanar_rollers"
    read = {(row["train.teeth"], row["cams.coplanar_rollers"]): row["y"] for row in rows(found.result, "response")}
    assert read == {(19, "true"): 119, (21, "true"): 121, (23, "true"): 123, (19, "false"): 19, (21, "false"): 21, (23, "false"): 23}


def test_keys_with_the_same_value_are_one_axis_and_the_report_names_them_all():
    tied = [{"key": ROLLER, "also": [PRIME, "manufacture.bore"], "values": ["6 mm", "7 mm"]}, LEVELS]
    study = made(spec_of(tied), y=lambda c: c[ROLLER] + c[PRIME] + c[FORCE])
    found = analyse_study(study)
    consistent(found)
    assert [column.name for column in found.result.tables["response"].columns] == [ROLLER, FORCE, "y"]
    assert [row["y"] for row in rows(found.result, "response")] == pytest.approx([f + 2 * r for r in (6e-3, 7e-3) for f in (10, 20, 40)])
    assert [varied(each)[0] for each in study.plan.variables] == [f"{ROLLER}, also {PRIME}, manufacture.bore", FORCE]


def test_words_as_levels_become_a_column_of_words():
    result, plots = analyse_study(made(spec_of([STEEL]), y=lambda c: np.arange(2.0)))
    assert [row["material"] for row in rows(result, "response")] == ["16MnCr5", "42CrMo4"]
    assert plots[0].x == "material" and plots[0].style == "line"


def test_a_sample_crossed_with_a_grid_is_told_level_by_level():
    spec = spec_of([LEVELS, *RANDOM], method="tolerance", samples=150)
    study = made(spec, y=lambda c: straight(c) * c[FORCE], check_a=lambda c: 30.0 - c[FORCE])
    result, plots = analyse_study(study)
    alone = [
        analyse_study(made(spec_of(RANDOM, method="tolerance", samples=150), y=lambda c, f=f: straight(c) * f))[0] for f in (10, 20, 40)
    ]
    found = rows(result, "response")
    assert [row[FORCE] for row in found] == [10.0, 20.0, 40.0] and [row["yield"] for row in found] == [1.0, 1.0, 0.0]
    for row, single in zip(found, alone, strict=True):
        assert row["mean.y"] == pytest.approx(single["mean.y"], rel=1e-12) and row["sigma.y"] == pytest.approx(single["sigma.y"], rel=1e-12)
        assert (row["lower.y"], row["upper.y"]) == pytest.approx((row["mean.y"] - row["sigma.y"], row["mean.y"] + row["sigma.y"]))
        assert rows(result, "linear_totals", **{FORCE: row[FORCE]})[0]["sigma"] == pytest.approx(single["linear.sigma.y"], rel=1e-9)
    assert {plot.name for plot in plots} == {"curve.y", "curve.sigma.y", "curve.yield", "curve.shares.y"}
    assert "yield" not in result.values and len(rows(result, "contributions", **{FORCE: 20.0}, method="ranks")) == 2


# -- trade-offs ----------------------------------------------------------------------------------------------------------------


def test_the_front_of_the_objectives_keeps_the_requirements():
    """y and z are best at the smallest roller, which a requirement in mm rules out; a check rules out the largest."""
    search = {
        "unknowns": [{"key": ROLLER, "lower": "6 mm", "upper": "9 mm"}],
        "objectives": [{"value": "y", "goal": "minimise"}, {"value": "z", "goal": "maximise"}],
        "requirements": [{"value": "z", "at_most": "-7.5 mm"}],
    }
    study = made(
        spec_of([{"key": ROLLER, "lower": "6 mm", "upper": "9 mm", "steps": 7}], search),
        y=lambda c: c[ROLLER],
        z=lambda c: -c[ROLLER],
        w=lambda c: c[ROLLER] ** 2,
        check_a=lambda c: 8.8e-3 - c[ROLLER],
    )
    result, plots = analyse_study(study)
    found = {round(row["y"] * 1e3, 3): row["set"] for row in rows(result, "pareto")}
    assert found == {6.0: "fails", 6.5: "fails", 7.0: "fails", 7.5: "front", 8.0: "dominated", 8.5: "dominated", 9.0: "fails"}
    assert result["front.cases"] == 1
    assert plots[-1]._replace(title="") == Plot("pareto", "", "pareto", "y", ("z",), style="points", by="set")


def test_two_named_values_trade_off_and_what_is_assumed_is_said():
    study = made(
        spec_of([{"key": ROLLER, "lower": "6 mm", "upper": "9 mm", "steps": 7}]),
        y=lambda c: c[ROLLER],
        z=lambda c: 1 / c[ROLLER],
        w=lambda c: c[ROLLER],
    )
    result, _ = analyse_study(study, ("y", "z"))
    assert [row["set"] for row in rows(result, "pareto")] == ["front"] * 7
    assert [row["z"] for row in rows(analyse_study(study, ("z", "y"))[0], "front")] == pytest.approx(1e3 / np.arange(9.0, 5.9, -0.5))
    assert any("takes y and z as to be made small" in text for text in result.findings)
    assert {row["set"] for row in rows(analyse_study(study, ("y", "w"))[0], "pareto")} == {"front", "dominated"}
    assert "pareto" not in analyse_study(study)[0].tables


# -- whatever comes ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("samples", [1, 30])
@pytest.mark.parametrize("grid", [[], [LEVELS], [STEEL, LEVELS]], ids=["plain", "levels", "words and levels"])
@pytest.mark.parametrize("states", [["complete"], ["failed"], ["complete", "partial", "failed"]], ids=lambda states: states[-1])
def test_nothing_that_a_study_can_hold_is_too_odd(method, samples, grid, states):
    spec = spec_of([*grid, *RANDOM], method=method, samples=samples)
    there = {} if states == ["failed"] else {"y": straight, "still": lambda c: 0.1, "check_a": lambda c: c[ROLLER] - 8e-3}
    values = dict.fromkeys(("y", "still", "none", "check_a", "check_b")) | there
    for keep in (None, lambda case: case < case[-1] / 2, lambda case: case % 3 == 1, lambda case: case < 0):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            consistent(analyse_study(made(spec, states, keep, **values)))


@pytest.mark.parametrize(
    "grid",
    [[{"key": ROLLER, "values": ["8 mm"]}], [STEEL], [LEVELS], [STEEL, LEVELS], [{"key": ROLLER, "values": ["8 mm", "8 mm"]}]],
    ids=["one", "words", "levels", "words and levels", "twice"],
)
@pytest.mark.parametrize("states", [["complete"], ["failed"], ["complete", "partial", "failed"]], ids=lambda states: states[-1])
def test_nor_a_grid(grid, states):
    values = {"y": None if states == ["failed"] else lambda c: np.arange(len(next(iter(c.values())))), "none": None, "check_a": None}
    for keep in (None, lambda case: case > 0, lambda case: case < 0):
        consistent(analyse_study(made(spec_of(grid), states, keep, **values)))


def consistent(found):
    """Every plot has its columns, every column a meaning and one length, every value a dotted lower-case name and a number."""
    result, plots = found
    for table in result.tables.values():
        assert len({len(column.data) for column in table.columns}) == 1 and len(table.columns[0].data) > 0
        assert all(column.meaning for column in table.columns) and len({column.name for column in table.columns}) == len(table.columns)
        table.arrow()
    for plot in plots:
        names = {column.name for column in result.tables[plot.table].columns}
        assert {plot.x, *plot.y, *plot.reference, *([plot.by] if plot.by else [])} <= names
        assert plot.title and all(np.isfinite(value) for value, _ in plot.limits)
    assert len({plot.name for plot in plots}) == len(plots)
    for name, value in result.values.items():
        assert re.fullmatch(r"[a-z0-9_.]+", name) and np.isfinite(value.value) and value.meaning
    result.record()


# -- files of points -----------------------------------------------------------------------------------------------------------


def from_file(path, lines, vary=()):
    """A spec whose study is a file of points, crossed with levels."""
    path.write_text("\n".join(lines), encoding="utf-8")
    return spec_of(list(vary), points=str(path))


def test_a_file_of_points_is_a_sample_with_its_numbers_and_words(tmp_path):
    rng = np.random.default_rng(1)
    lines = [f"{ROLLER} [mm],load.force [N],material"] + [
        f"{r},{f},{s}" for r, f, s in zip(rng.uniform(6, 9, 50), rng.uniform(10, 20, 50), ["16MnCr5", "42CrMo4"] * 25, strict=True)
    ]
    found = analyse_study(made(from_file(tmp_path / "points.csv", lines), y=lambda c: c[ROLLER] * 1e3 + c[FORCE]))
    consistent(found)
    shares = {row["key"]: row["share"] for row in rows(found.result, "contributions", value="y")}
    assert set(shares) == {ROLLER, FORCE} and sum(shares.values()) == pytest.approx(1.0, abs=0.3)
    assert {row["method"] for row in rows(found.result, "contributions")} == {"regression"}
    assert found.result.tables["sample"].title == "The points of the file"
    assert any("taken as a random sample" in text for text in found.result.findings)


DESIGNED = [(steel, r, p) for steel in ("42CrMo4", "C45", "16MnCr5") for r in (6, 7, 9) for p in (40, 50)]
HEAD = f"material,{ROLLER} [mm],{PRIME} [mm],manufacture.bore [mm],{FORCE} [N]"  # the bore as the roller, the force from all the others


def designed(points):
    return [HEAD, *(f"{steel},{r},{p},{r},{r * p + (5 if steel == '16MnCr5' else 0)}" for steel, r, p in points)]


HARD = {"42CrMo4": 1e-3, "C45": 5e-4, "16MnCr5": 0.0}


def bent(cases):
    return cases[ROLLER] * cases[PRIME] + np.array([HARD[steel] for steel in cases["material"]])


def test_a_file_with_all_combinations_is_a_grid_in_whatever_order_its_lines_stand(tmp_path):
    points = [DESIGNED[n] for n in np.random.default_rng(0).permutation(len(DESIGNED))]
    assert list(dict.fromkeys(steel for steel, _, _ in points)) == ["42CrMo4", "C45", "16MnCr5"]  # by the alphabet it would be 1, 2, 0
    study = made(from_file(tmp_path / "points.csv", designed(points)), y=bent, check_a=lambda c: c[PRIME] - 0.045)
    found = analyse_study(study)
    consistent(found)
    result, plots = found
    assert set(result.tables) == {"range", "response.1", "response.2", "response.3", "extremes", "extremes.y"} and {
        plot.style for plot in plots
    } == {"map", "line"}
    assert not any("sample" in text for text in result.findings)
    assert not any(name.startswith(("mean.", "sigma.", "yield")) for name in result.values)
    told = f"all combinations of the levels of material, {ROLLER}, {PRIME}; these decide manufacture.bore, {FORCE}, so they are answered"
    assert any(told in text for text in result.findings)
    for number, steel in enumerate(dict.fromkeys(steel for steel, _, _ in points), 1):
        told = rows(result, f"response.{number}")
        assert [(row[ROLLER], row[PRIME]) for row in told] == [pytest.approx((r * 1e-3, p * 1e-3)) for r in (6, 7, 9) for p in (40, 50)]
        expected = [r * p * 1e-6 + HARD[steel] for r in (6, 7, 9) for p in (40, 50)]
        assert [row["y"] for row in told] == pytest.approx(expected) and [row["checks.failing"] for row in told] == [1, 0] * 3
        assert steel in {plot.name: plot for plot in plots}[f"map.y.{number}"].title
    row = rows(result, "range", value="y")[0]
    assert points[row["greatest.case"]] == ("42CrMo4", 9, 50) and points[row["least.case"]] == ("16MnCr5", 6, 40)
    assert result.provenance["plan"] == study.plan.digest


def test_such_a_file_crossed_with_levels_and_not_yet_whole(tmp_path):
    laws = {"key": "programme.0.law", "values": ["cycloidal", "modified-sine"]}
    spec = from_file(tmp_path / "points.csv", designed(DESIGNED[:6][::-1]), [laws])
    study = made(spec, y=lambda c: bent(c) + np.where(c["programme.0.law"] == "cycloidal", 0, 1), keep=lambda case: case != 2)
    result, _ = analyse_study(study)
    for number in (1, 2):
        told = [row["y"] for row in rows(result, f"response.{number}")]
        expected = [r * p * 1e-6 + 1e-3 + number - 1 for r in (6, 7, 9) for p in (40, 50)]
        assert told == pytest.approx([np.nan if (number, n) == (1, 3) else each for n, each in enumerate(expected)], nan_ok=True)
    assert rows(result, "range", value="y")[0]["greatest.case"] == 6 and result["cases.missing"] == 1


@pytest.mark.parametrize(
    "points",
    [DESIGNED[:-1], [*DESIGNED, DESIGNED[0]], [*DESIGNED[:-1], DESIGNED[0]], [("42CrMo4", 6, 40)]],
    ids=["one less", "one twice", "one for another", "alone"],
)
def test_what_lacks_a_combination_is_no_grid(tmp_path, points):
    result, _ = analyse_study(made(from_file(tmp_path / "points.csv", designed(points)), y=bent))
    assert "range" not in result.tables and len(rows(result, "tolerance", value="y")) == 1


def test_words_alone_do_not_make_a_grid_of_numbers(tmp_path):
    """Four roller radii, each with another pair of words: the words do not decide the radius."""
    lines = [f"{ROLLER} [mm],material,programme.0.law"] + [
        f"{r},{steel},{law}"
        for r, (steel, law) in zip(
            (6.1, 7.3, 8.8, 6.7), [(a, b) for a in ("16MnCr5", "42CrMo4") for b in ("cycloidal", "modified-sine")], strict=True
        )
    ]
    result, _ = analyse_study(made(from_file(tmp_path / "points.csv", lines), y=lambda c: c[ROLLER]))
    assert "range" not in result.tables and rows(result, "tolerance", value="y")[0]["least"] == pytest.approx(6.1e-3)


def test_values_that_do_not_vary_are_named_and_not_drawn():
    columns = {f"v{n}": (lambda c, n=n: straight(c) + n) for n in range(9)} | {"still": lambda c: 0.1, "none": None}
    study = made(spec_of(RANDOM, method="random", samples=30), **columns)
    result, plots = analyse_study(study)
    assert [plot.y for plot in plots if plot.style == "histogram"] == [(f"v{n}",) for n in range(6)]
    assert any(text.startswith("the plots show 6 of 9 values: v0, v1") for text in result.findings)
    assert {row["value"] for row in rows(result, "tolerance")} == set(columns)
    assert "values that do not vary over the study (1): still" in result.findings
    assert "values that no case has (1): none" in result.findings
    chosen = [plot.name for plot in analyse_study(study, ("v8", "still"))[1] if plot.style == "histogram"]
    assert chosen == ["histogram.v8"]
    with pytest.raises(UnknownName, match="no column of the study is called 'vv'"):
        analyse_study(study, ("vv",))


def test_what_is_missing_makes_the_outcome_partial():
    spec = spec_of(RANDOM, method="random", samples=40)
    result, _ = analyse_study(made(spec, y=straight, keep=lambda case: case < 25))
    assert result.outcome == "partial" and result["cases.missing"] == 15 and "15 of 40 cases have not been run yet" in result.findings
    whole, _ = analyse_study(made(spec_of(RANDOM, method="random", samples=25), y=straight))
    assert whole.outcome == "complete" and whole["mean.y"] == result["mean.y"] and whole["sigma.y"] == result["sigma.y"]
    assert whole.digest == spec.digest() and whole.provenance["seed"] == 1


def test_the_front_lies_on_top_of_what_it_beats():
    spec = spec_of(RANDOM, method="random", samples=60, values=["y", "z"])
    result, _ = analyse_study(made(spec, y=lambda c: c[ROLLER], z=lambda c: c[PRIME] ** 2 / c[ROLLER]))
    sets = result.tables["pareto"]["set"].data.tolist()
    assert sets[0] == "front" and "dominated" in sets and sets == sorted(sets, key=["front", "dominated", "fails"].index)
