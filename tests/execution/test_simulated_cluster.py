"""The simulated cluster of the benchmarks: a free scheduler wastes nothing, one resource that is there once bounds the batches a second."""

import importlib.util
import sys

import numpy as np
import pytest
from places import ROOT

from drivewright.execution.batches import TARGET

pytestmark = pytest.mark.property


def _module():
    """benchmarks/cluster.py, which is no part of the package."""
    about = importlib.util.spec_from_file_location("benchmarks_cluster", ROOT / "benchmarks" / "cluster.py")
    module = importlib.util.module_from_spec(about)
    sys.modules[about.name] = module  # its annotations are looked up there
    about.loader.exec_module(module)
    return module


cluster = _module()
LENGTH = 0.01  # s of a case


class Even:
    """Cases of equal length; `counts` are those of the batches."""

    def __init__(self, length=LENGTH):
        self.length, self.counts = length, []

    def __call__(self, count):
        self.counts.append(count)
        return self.length * count


@pytest.mark.parametrize("workers", [1, 7, 40])
def test_without_costs_hardly_anything_is_wasted_and_every_case_is_computed_once(workers):
    draw, total = Even(), 30_000 * workers
    found = cluster.simulate(total, workers, cluster.Costs(), draw)
    assert sum(draw.counts) == total and len(draw.counts) == found.batches
    assert found.work == pytest.approx(LENGTH * total)
    assert 0.99 < found.efficiency <= 1 + 1e-12
    assert found.bottleneck == "-"


def test_one_worker_does_all_it_has_to_one_after_another():
    """Where nothing else costs anything, its start, its first batch and what comes with every batch add up."""
    costs = cluster.Costs(start=3.0, first=5.0, batch=0.2)
    found = cluster.simulate(20_000, 1, costs, Even())
    assert found.seconds == pytest.approx(3.0 + 5.0 + 0.2 * found.batches + LENGTH * 20_000, rel=1e-12)


@pytest.mark.parametrize("resource", ["hand_out", "part", "ledger", "dispatch"])
def test_a_resource_that_is_there_once_bounds_the_batches_a_second(resource):
    """Sixty workers want twenty times the batches that it can take."""
    workers, cost = 60, 20 * TARGET / 60
    found = cluster.simulate(100_000, workers, cluster.Costs(**{resource: cost}), Even())
    assert found.seconds >= cost * found.batches - 1e-9
    assert found.seconds == pytest.approx(cost * found.batches, rel=0.05)
    assert found.bottleneck.startswith("cluster's scheduler" if resource == "dispatch" else "process that writes")


def test_resources_of_one_process_add_up_and_those_of_two_overlap():
    cost = 0.5
    for costs, both in ((cluster.Costs(part=cost, ledger=cost), 2 * cost), (cluster.Costs(part=cost, dispatch=cost), cost)):
        found = cluster.simulate(100_000, 60, costs, Even())
        assert found.seconds == pytest.approx(both * found.batches, rel=0.05)


def test_a_row_costs_the_writing_process_its_time():
    total, row = 100_000, 2 * LENGTH  # twice what a worker needs for it
    assert cluster.simulate(total, 10, cluster.Costs(row=row), Even()).seconds == pytest.approx(row * total, rel=0.05)


def test_a_second_batch_for_every_worker_hides_the_delay_of_the_network():
    slow = cluster.simulate(300_000, 10, cluster.Costs(latency=0.1), Even())
    assert 0.98 < slow.efficiency < cluster.simulate(300_000, 10, cluster.Costs(), Even()).efficiency


def test_cases_are_drawn_as_they_were_measured():
    sample = np.array([1.0, 2.0, 6.0])
    draw = cluster.drawn(sample, 0.3)
    few, many = (np.array([draw(count) for _ in range(4000)]) for count in (2, 4 * cluster.MANY))
    for sums, count in ((few, 2), (many, 4 * cluster.MANY)):
        deviation = 0.3 / sample.mean() * sample.std() * np.sqrt(count)
        assert sums.mean() == pytest.approx(0.3 * count, abs=5 * deviation / np.sqrt(len(sums)))
        assert sums.std() == pytest.approx(deviation, rel=0.08)
    assert {np.round(cluster.drawn(sample, 0.3, seed)(1) / 0.1, 9) for seed in range(9)} <= {1.0, 2.0, 6.0}


def test_the_cost_of_handing_out_is_measured_with_as_many_batches_out_as_asked():
    """It comes to an end with every worker's two batches out."""
    assert cluster.handing_out(3, batches=20) > 0
