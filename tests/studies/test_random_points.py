"""Points that are made where they are read: the rows of the whole, however they are asked for; strata, independence, permutations."""

import numpy as np
import pytest
from scipy import stats
from study_toy import Toy

from drivewright.studies import random_points
from drivewright.studies.plan import Block, make_plan
from drivewright.studies.random_points import Independent, LatinHypercube, Permutation, Points, Sobol
from drivewright.studies.variation import normal, triangular, uniform, with_variation

pytestmark = pytest.mark.property

RANDOM = {"size": uniform("8 mm", "13 mm"), "force": normal("2 N", "0.3 N"), "angle": triangular("10 deg", "20 deg", "50 deg")}
CUBES = (Independent, Sobol, LatinHypercube)


@pytest.fixture
def in_blocks(monkeypatch):
    """All points are made in blocks of 16 rows."""
    monkeypatch.setattr(random_points, "HELD", 0)
    monkeypatch.setattr(random_points, "BLOCK", 16)


def plan(method, samples=100, seed=3, **vary):
    return make_plan(with_variation(Toy(), RANDOM | vary, method=method, samples=samples, seed=seed))


@pytest.mark.parametrize("cube", CUBES)
@pytest.mark.parametrize("dimensions", [1, 3, 4])
def test_rows_of_a_cube_do_not_depend_on_how_they_are_cut(cube, dimensions):
    source = cube(150, dimensions, 7)
    whole = source.rows(0, 150)
    assert whole.shape == (150, dimensions) and np.all((whole >= 0) & (whole < 1))
    for cuts in ([0, 1, 2, 7, 64, 150], [0, 63, 65, 149, 150]):
        pieces = [source.rows(first, stop) for first, stop in zip(cuts, cuts[1:], strict=False)]
        assert np.array_equal(np.concatenate(pieces), whole)


@pytest.mark.parametrize("method", ["sobol", "random", "corners", "one-at-a-time", "sobol-indices"])
def test_points_made_in_blocks_are_those_made_at_once(method, monkeypatch, in_blocks):
    made = plan(method)
    monkeypatch.undo()
    held = plan(method)
    assert isinstance(made.points, Points) and isinstance(held.points, np.ndarray)
    assert made.blocks == held.blocks and made.points.shape == held.points.shape and len(made) == len(held)
    assert np.array_equal(made.points[:], held.points) and np.array_equal(made.points[5:40], held.points[5:40])
    some = np.random.default_rng(1).integers(len(held), size=300)
    assert np.array_equal(made.points[some], held.points[some])
    one, other = made.cases(3, len(made)), held.cases(3, len(held))
    assert all(np.array_equal(one[key], other[key]) for key in held.keys)


def test_the_blocks_of_a_tolerance_study_stand_one_behind_the_other(in_blocks):
    found = plan("tolerance", samples=90)
    assert found.blocks == (Block("nominal", 0, 1), Block("steps", 1, 7), Block("corners", 7, 15), Block("sample", 15, 105))
    assert np.array_equal(found.points[7:15], plan("corners").points[:])
    assert np.array_equal(found.points[15:], plan("latin-hypercube", samples=90).points[:])


def test_levels_come_with_the_same_points(in_blocks):
    found = plan("random", samples=40, count=[5, 1])
    columns = found.cases(0, 80)
    assert np.array_equal(columns["size"][:40], columns["size"][40:]) and np.array_equal(found.at(np.array([79, 3]))["count"], [1, 5])


@pytest.mark.parametrize("method", ["latin-hypercube", "sobol", "random", "sobol-indices"])
def test_the_digest_tells_seeds_and_sizes_apart(method, in_blocks):
    digests = {plan(method, samples, seed).digest for samples in (64, 128) for seed in (3, 4)}
    assert len(digests) == 4 and plan(method, 64, 3).digest in digests


# -- a hypercube without a table -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 2, 3, 7, 64, 65, 1000, 4097])
def test_a_permutation_takes_each_number_to_one_place(count):
    keys = np.random.default_rng(count).integers(2**62, size=(4, 2), dtype=np.uint64)
    places = Permutation(count, keys).at(np.arange(count))
    assert np.array_equal(np.sort(places), np.arange(count))
    if count > 1:
        other = Permutation(count, keys[::-1] + np.uint64(5)).at(np.arange(count))
        assert count < 5 or not np.array_equal(places, other)


@pytest.mark.parametrize("count", [1, 7, 1000])
def test_each_key_has_one_point_in_each_stratum(count):
    strata = np.sort(np.floor(LatinHypercube(count, 3, 5).rows(0, count) * count).astype(int), axis=0)
    assert np.array_equal(strata, np.repeat(np.arange(count)[:, None], 3, axis=1))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("count", [3000, 4096])
def test_strata_are_paired_at_random(count, seed):
    """Keys with each other, each with its row, and with the row before; and the cells of any two are filled as by chance."""
    cube = LatinHypercube(count, 3, seed).rows(0, count)
    columns = [np.arange(count) / count, *cube.T, *np.roll(cube, 1, axis=0).T]
    correlation = np.corrcoef(columns) - np.eye(len(columns))
    assert np.abs(correlation).max() < 4.5 / np.sqrt(count)
    for i, j in ((0, 1), (0, 3), (1, 2), (1, 3), (2, 3)):
        cells = np.histogram2d(columns[i], columns[j], bins=16, range=[[0, 1], [0, 1]])[0]
        assert 1e-5 < stats.chi2.cdf(np.sum((cells - count / 256) ** 2) / (count / 256), 225) < 1 - 1e-5


def test_the_mean_of_a_large_hypercube_is_as_certain_as_its_strata_make_it():
    """A sum of functions of one key each: its error is far below that of independent points."""
    count = 20_000
    cube = LatinHypercube(count, 3, 2).rows(0, count)
    error = abs(np.mean(np.sum(cube**2, axis=1)) - 1.0)
    assert error < 0.05 * np.sqrt(3 * 4 / 45 / count)
