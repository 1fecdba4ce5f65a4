"""Every kind can be swept, and who computes changes no byte: serial = processes = Dask."""

import re

import pytest

import drivewright as dw
from drivewright import registry
from drivewright.execution.keys import key_kind
from drivewright.spec import document, load, preset_path
from drivewright.studies.variation import tolerance

pytestmark = pytest.mark.conformance

LEVELS, SAMPLES = 3, 2


def quantities(tables, path=""):
    """Dotted keys of the quantities above 0 that a spec states."""
    for key, value in tables.items() if isinstance(tables, dict) else enumerate(tables):
        place = f"{path}.{key}" if path else str(key)
        if isinstance(value, (dict, list)):
            yield from quantities(value, place)
        elif isinstance(value, str) and re.fullmatch(r"[0-9.e-]+ \S.*", value) and float(value.split()[0]) > 0:
            yield place


def study_of(kind):
    """A study of a kind's own preset: one quantity over levels, another one at random, by its first analysis that gives values."""
    spec = load(preset_path(kind))
    analysis = next(each.name for each in registry.mechanism(kind).analyses if dw.run(spec, each.name).values)
    keys = [key for key in quantities(document(spec)) if key_kind(spec, key).name == "quantity"]
    first, second = keys[0], keys[len(keys) // 2]
    number, unit = document_value(spec, first).split(maxsplit=1)
    levels = dw.linspace(f"{0.995 * float(number)!r} {unit}", f"{1.005 * float(number)!r} {unit}", LEVELS)
    number, unit = document_value(spec, second).split(maxsplit=1)
    changes = {first: levels, second: tolerance(f"{0.002 * float(number)!r} {unit}")}
    settings = [f"study.samples={SAMPLES}", f'study.analyses=["{analysis}"]']
    return load(preset_path(kind), settings), changes


def document_value(spec, key):
    """The text of a key."""
    found = document(spec)
    for step in key.split("."):
        found = found[int(step) if isinstance(found, list) else step]
    return found


@pytest.fixture(scope="module")
def serial():
    """{kind: its study}, computed in this process."""
    return {kind: dw.sweep(*study_of(kind), on="serial") for kind in registry.kinds()}


@pytest.mark.parametrize("kind", registry.kinds())
def test_every_case_has_its_row_and_its_numbers(serial, kind):
    study = serial[kind]
    assert study["case"].tolist() == list(range(LEVELS * SAMPLES)) and study.complete
    assert study.answered and study.value_names
    first, second = study.plan.keys
    assert len(set(study[first])) == LEVELS and len(set(study[second])) == SAMPLES
    assert all(study.unit(name) and study.meaning(name) for name in study.value_names)


FIRST = ("cam", "silent-chain")  # the other kinds go the same ways, in the slow tests


@pytest.mark.parametrize("kind", [kind if kind in FIRST else pytest.param(kind, marks=pytest.mark.slow) for kind in registry.kinds()])
def test_processes_give_the_same_bytes(serial, kind):
    assert dw.sweep(*study_of(kind), workers=2).table.equals(serial[kind].table)


@pytest.mark.needs_cluster
@pytest.mark.slow
def test_dask_gives_the_same_bytes(serial):
    import distributed

    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
        for kind, study in serial.items():
            assert dw.sweep(*study_of(kind), on=cluster.scheduler_address).table.equals(study.table), kind
