"""The cases of a study: which they are, in which order, whatever part of them is asked for."""

import tomllib
from itertools import product

import numpy as np
import pytest
from scipy import stats
from study_toy import Part, Toy

from drivewright.studies.plan import FEW_CORNERS, Block, make_plan
from drivewright.studies.variation import geomspace, linspace, normal, tolerance, triangular, uniform, with_variation

pytestmark = pytest.mark.property

SIZE, FORCE, ANGLE = uniform("8 mm", "13 mm"), normal("2 N", "0.3 N"), triangular("10 deg", "20 deg", "50 deg")
RANDOM = {"size": SIZE, "force": FORCE, "angle": ANGLE}
LAWS = (stats.uniform(8e-3, 5e-3), stats.norm(2, 0.3), stats.triang(0.25, *np.radians([10, 40])))
LEVELS = {"count": [5, 1, 3], "colour": ["red", "blue"]}
METHODS = ("latin-hypercube", "sobol", "random", "corners", "one-at-a-time", "tolerance", "sobol-indices")


def plan(vary, spec=None, **settings):
    return make_plan(with_variation(spec or Toy(), vary, **settings))


def rows(found, first=0, stop=None):
    """The cases as tuples."""
    columns = found.cases(first, len(found) if stop is None else stop)
    return list(zip(*(columns[key].tolist() for key in found.keys), strict=True))


def block(found, name):
    where = found.block(name)
    return found.points[where.start : where.stop]


# -- order ---------------------------------------------------------------------------------------------------------------------


def test_levels_are_crossed_and_the_first_key_changes_slowest():
    found = plan({"count": [5, 1, 3], "flag": [True, False], "colour": ["red", "green", "blue"]})
    assert found.keys == ("count", "flag", "colour") and found.shape == (3, 2, 3) and found.inner == 1 and len(found) == 18
    assert rows(found) == list(product([5, 1, 3], [True, False], ["red", "green", "blue"]))


def test_every_combination_of_levels_comes_with_the_same_points():
    found, alone = plan(LEVELS | RANDOM, samples=5), plan(RANDOM, samples=5)
    assert found.keys == ("count", "colour", "size", "force", "angle") and found.inner == 5 and len(found) == 30
    assert rows(found) == [(*levels, *point) for levels in product([5, 1, 3], ["red", "blue"]) for point in rows(alone)]


def test_random_keys_stand_behind_the_levels_and_change_none_of_their_points():
    mixed = plan({"size": SIZE, "count": [5, 1], "force": FORCE, "flag": [True]}, samples=6)
    assert mixed.keys == ("count", "flag", "size", "force")
    assert np.array_equal(mixed.points, plan({"size": SIZE, "force": FORCE}, samples=6).points)


@pytest.mark.parametrize("method", METHODS)
def test_however_the_range_is_cut_the_cases_are_the_same(method):
    found, cuts = plan(LEVELS | RANDOM, method=method, samples=8), np.random.default_rng(5)
    whole = rows(found)
    assert len(whole) == len(found) == 6 * found.inner
    for _ in range(4):
        ends = [0, *sorted(cuts.integers(0, len(found) + 1, 6).tolist()), len(found)]
        assert [row for start, stop in zip(ends, ends[1:], strict=False) for row in rows(found, start, stop)] == whole
    assert all(rows(found, n, n + 1) == [whole[n]] for n in (0, len(whole) // 3, len(whole) - 1))


def test_a_file_of_points_is_crossed_with_levels(tmp_path):
    (tmp_path / "p.csv").write_text("size [mm],ratio\n8,0.5\n12,0.25\n10,2\n")
    found = plan({"count": [4, 2]}, points=str(tmp_path / "p.csv"))
    assert found.keys == ("size", "ratio", "count") and (found.shape, found.inner, len(found)) == ((2,), 3, 6)
    points = [(8e-3, 0.5), (12e-3, 0.25), (10e-3, 2.0)]
    assert rows(found) == [(*point, count) for count in (4, 2) for point in points]
    assert rows(found, 2, 5) == rows(found)[2:5]


def test_types_of_the_columns():
    found = plan({"count": [4, 2], "flag": [True], "colour": ["red"], "ratio": [1], "size": ["1 mm"]}).cases(0, 2)
    assert {key: column.dtype.kind for key, column in found.items()} == {
        "count": "i",
        "flag": "b",
        "colour": "O",
        "ratio": "f",
        "size": "f",
    }


# -- methods -------------------------------------------------------------------------------------------------------------------


def quantiles(points):
    """Through the distributions, written down a second time."""
    return np.stack([law.cdf(column) for law, column in zip(LAWS, points.T, strict=True)], axis=1)


@pytest.mark.parametrize("n", [1, 7, 50])
def test_a_latin_hypercube_has_one_point_in_each_stratum_of_each_key(n):
    found = plan(RANDOM, samples=n)
    assert found.blocks == (Block("sample", 0, n),)
    strata = np.sort(np.floor(quantiles(found.points) * n).astype(int), axis=0)
    assert np.array_equal(strata, np.repeat(np.arange(n)[:, None], 3, axis=1))


def test_a_latin_hypercube_pairs_the_strata_at_random():
    order = np.argsort(np.argsort(plan(RANDOM, samples=400).points, axis=0), axis=0)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        assert abs(stats.spearmanr(order[:, i], order[:, j]).statistic) < 0.2  # 4 standard deviations


@pytest.mark.parametrize("cells", [(1, 64), (64, 1), (2, 32), (8, 8), (16, 4)])
def test_sobol_points_fill_every_elementary_cell_once(cells):
    """The first two keys of 2^m points are a (0, m, 2) net, scrambled or not."""
    found = plan(RANDOM, method="sobol", samples=64)
    unit = quantiles(found.points)[:, :2]
    assert len({tuple(row) for row in np.floor(unit * cells).astype(int).tolist()}) == 64


@pytest.mark.parametrize("method", ["sobol", "random"])
def test_a_longer_sample_continues_a_shorter_one(method):
    short, long = (plan(RANDOM, method=method, samples=n).points for n in (16, 64))
    assert np.array_equal(long[:16], short)


@pytest.mark.parametrize("edge", [0.0, 1.0])
def test_a_sobol_point_on_the_edge_of_the_cube_is_not_infinitely_far(monkeypatch, edge):
    monkeypatch.setattr(stats.qmc.Sobol, "random", lambda self, n: np.full((n, self.d), edge))
    assert np.all(np.isfinite(plan(RANDOM, method="sobol", samples=2).points))


def test_random_points_are_independent():
    unit = quantiles(plan(RANDOM, method="random", samples=2000).points)
    assert all(stats.kstest(column, "uniform").pvalue > 0.01 for column in unit.T)
    assert len(set(np.floor(unit[:, 0] * 2000))) == pytest.approx(2000 * (1 - np.exp(-1)), abs=60)  # no strata: 1 - 1/e of them are hit


def test_corners_are_all_ends_once():
    found = plan(RANDOM, method="corners")
    ends = [(8e-3, 13e-3), (2 - 0.9, 2 + 0.9), tuple(np.radians([10, 50]))]
    assert found.blocks == (Block("corners", 0, 8),)
    assert found.points == pytest.approx(np.array(list(product(*ends))), rel=1e-12)


def test_one_at_a_time_steps_each_key_by_its_standard_deviation():
    found = plan(RANDOM, method="one-at-a-time")
    means, sigmas = np.array([10.5e-3, 2, np.radians(80 / 3)]), np.array([5e-3 / np.sqrt(12), 0.3, np.radians(np.sqrt(1300 / 18))])
    assert found.blocks == (Block("nominal", 0, 1), Block("steps", 1, 7))
    assert block(found, "nominal")[0] == pytest.approx(means, rel=1e-12)
    assert block(found, "steps") - means == pytest.approx(np.kron(np.diag(sigmas), [[-1], [1]]), rel=1e-9, abs=1e-15)


def test_a_tolerance_study_has_the_mean_the_steps_the_corners_and_a_sample():
    found = plan(RANDOM, method="tolerance", samples=9)
    assert found.blocks == (Block("nominal", 0, 1), Block("steps", 1, 7), Block("corners", 7, 15), Block("sample", 15, 24))
    for name, method in (("steps", "one-at-a-time"), ("corners", "corners"), ("sample", "latin-hypercube")):
        assert np.array_equal(block(found, name), block(plan(RANDOM, method=method, samples=9), name))
    assert found.block("a") is None


@pytest.mark.parametrize("keys", [FEW_CORNERS, FEW_CORNERS + 1])
def test_a_tolerance_study_of_many_keys_does_without_corners(keys):
    spec = Toy(parts=tuple(Part() for _ in range(keys)))
    found = plan({f"parts.{n}.width": tolerance("0.1 mm") for n in range(keys)}, spec, method="tolerance", samples=4)
    expected = 1 + 2 * keys + 4 + (2**FEW_CORNERS if keys == FEW_CORNERS else 0)
    assert (found.block("corners") is None) == (keys > FEW_CORNERS) and found.inner == found.blocks[-1].stop == expected


def test_sobol_indices_mix_two_samples_column_by_column():
    found = plan(RANDOM, method="sobol-indices", samples=16)
    assert found.blocks == (Block("a", 0, 16), Block("b", 16, 32), Block("mixed", 32, 80))
    a, b, mixed = (block(found, name) for name in ("a", "b", "mixed"))
    for k in range(3):
        part = mixed[16 * k : 16 * (k + 1)]
        assert np.array_equal(part[:, k], b[:, k]) and np.array_equal(np.delete(part, k, 1), np.delete(a, k, 1))
    assert not np.any(a == b)
    for sample in (a, b):  # each key of each sample is even in itself
        assert np.array_equal(np.sort(np.floor(quantiles(sample) * 16), axis=0)[:, 0], np.arange(16))


@pytest.mark.parametrize(("samples", "near"), [(100, 128), (90, 64), (3, 4)])
@pytest.mark.parametrize("method", ["sobol", "sobol-indices"])
def test_a_sobol_sequence_that_is_cut_short_is_remarked_upon(method, samples, near):
    (remark,) = plan(RANDOM, method=method, samples=samples).remarks
    assert remark == f"{samples} points of a Sobol sequence are less even than a power of two: {near} would be better spent"


def test_others_are_not_remarked_upon():
    assert not any(
        plan(RANDOM, method=m, samples=n).remarks for m, n in (("sobol", 64), ("sobol-indices", 1), ("random", 100), ("tolerance", 5))
    )
    assert plan(LEVELS, method="sobol", samples=100).remarks == ()


# -- seed and digest -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
def test_the_seed_repeats_and_decides(method):
    one, again, other = (plan(RANDOM, method=method, samples=8, seed=seed) for seed in (3, 3, 4))
    assert np.array_equal(one.points, again.points) and one.digest == again.digest and (one.seed, other.seed) == (3, 4)
    sampled = method not in ("corners", "one-at-a-time")
    assert np.array_equal(one.points, other.points) != sampled and (one.digest != other.digest) == sampled


BASE = {"count": [1, 2], "size": SIZE, "colour": ["red", "blue"]}


@pytest.mark.parametrize(
    "changed",
    [
        BASE | {"count": [1, 3]},
        BASE | {"count": [2, 1]},
        BASE | {"count": [1, 2, 2]},
        BASE | {"colour": ["red", "green"]},
        BASE | {"size": uniform("8 mm", "13.000001 mm")},
        BASE | {"size": normal("10 mm", "1 mm")},
        {"count": [1, 2], "size": SIZE},
        {"colour": ["red", "blue"], "count": [1, 2], "size": SIZE},
        {"count": [1, 2], "offset": SIZE, "colour": ["red", "blue"]},
        BASE | {"flag": [False]},
        BASE | {"size": ["9 mm", "10 mm"]},
        BASE | {"colour": ["redblue", ""]},
    ],
)
def test_the_digest_knows_every_key_and_value(changed):
    assert plan(BASE, samples=4).digest != plan(changed, samples=4).digest


@pytest.mark.parametrize("settings", [{"samples": 5}, {"seed": 2}, {"method": "sobol"}, {"method": "corners"}])
def test_the_digest_knows_the_sample(settings):
    assert plan(BASE, **{"samples": 4} | settings).digest != plan(BASE, samples=4).digest


def test_the_digest_knows_the_blocks():
    """A sample of three and one of one with two steps beside it are not the same study, whatever the numbers."""
    points = plan({"size": SIZE}, method="one-at-a-time")
    assert points.digest != type(points)(points.grid, points.random, points.points, (Block("sample", 0, 3),), {}).digest


def test_the_digest_knows_nothing_else():
    spec = with_variation(Toy(), BASE, samples=4)
    same = [
        with_variation(Toy(title="T", ratio=0.5), BASE, samples=4, analyses=["main"], values=["area"]),
        with_variation(Toy(), BASE | {"size": uniform("0.8 cm", "13000 um")}, samples=4),
        with_variation(Toy(), BASE | {"count": linspace(1, 2, 2)}, samples=4),
    ]
    assert {make_plan(each).digest for each in same} == {make_plan(spec).digest}
    assert plan({"count": [1, 2]}, seed=5, samples=7, method="sobol").digest == plan({"count": [1, 2]}).digest


def test_the_digest_follows_what_a_tolerance_is_about():
    assert plan({"size": tolerance("1 mm")}, samples=3).digest != plan({"size": tolerance("1 mm")}, Toy(size="10.1 mm"), samples=3).digest
    assert plan({"force": geomspace("1 N", "4 N", 3)}).digest != plan({"force": linspace("1 N", "4 N", 3)}).digest


def test_the_digest_knows_a_file_of_points_by_its_numbers(tmp_path):
    def digest(text):
        (tmp_path / "p.csv").write_text(text)
        return plan({}, points=str(tmp_path / "p.csv")).digest

    first = digest("size [mm],colour\n8,red\n10,blue\n")
    assert first == digest("size [mm], colour\n8.0,red\n1e1,blue\n") == digest("size [m],colour\n0.008,red\n0.010,blue\n")
    others = [
        "size [mm],colour\n8,red\n10,green\n",
        "size [mm],colour\n10,blue\n8,red\n",
        "size [mm]\n8\n10\n",
        "offset [mm],colour\n8,red\n10,blue\n",
    ]
    assert len({first, *map(digest, others)}) == 5


def test_the_plan_of_a_spec_that_was_written_and_read_is_the_same():
    spec = with_variation(Toy(), LEVELS | RANDOM, samples=5)
    assert make_plan(Toy(**tomllib.loads(spec.to_toml()))).digest == make_plan(spec).digest
