"""Five hundred random legal specs of each kind: a finite, audited record or a refusal with its reason, never a fault of the program.

About five minutes on two cores.  Where the default analyses take long, most specs get the cheap ones, and every `WHOLE`-th all of them.
"""

import json
import math
import warnings

import numpy as np
import pytest
from random_specs import bases, random_tables

from drivewright import registry, runner
from drivewright.errors import InputError, SolverError, SpecError
from drivewright.spec import from_document

pytestmark = pytest.mark.property

SPECS, CHUNK = 500, 50
WHOLE = 100  # every so many specs get all default analyses where most get the cheap ones
CHEAP = {
    "seedling-pusher": ("train", "planting", "cams", "load"),
    "silent-chain": ("meshing", "layout", "geometry", "closure", "contact"),
    "indexer": ("motion", "profile", "contacts", "play"),
}
AUDITS = ("energy_audit", "power_audit", "energy_drift", "equilibrium")  # checks that hold the numbers against a balance
USUAL = ("runs on request", "is left out: ")  # findings of a complete result, too
REFUSED = 0.5  # of the specs, at most: the others must be computed

kinds = pytest.mark.parametrize("kind", registry.kinds())


def complaints(tables, only):
    """(whether the spec is refused, what is wrong with the answer or the refusal)."""
    try:
        spec = from_document(tables)
        model = runner.build(spec)
    except (InputError, SolverError) as error:
        keyless = isinstance(error, SpecError) and not error.key
        return True, [f"refused without {'a key' if keyless else 'a reason'}: {error}"] if keyless or len(str(error)) < 20 else []
    return False, list(faults_of(runner.run(spec, only, model=model)))


def faults_of(result):
    """What must not be in a result, in words."""
    told = " ".join(result.findings)
    record = json.loads(json.dumps(result.record(), allow_nan=False))
    yield from (f"value {name} is {value['value']}" for name, value in record["values"].items() if not math.isfinite(value["value"]))
    for check in result.checks:
        if not (math.isfinite(check.value) and math.isfinite(check.limit)) and f"'{check.name}'" not in told:
            yield f"check {check.name} is {check.value} without a word"
        if check.name in AUDITS and check.name not in [each["name"] for each in record["checks"]]:
            yield f"audit {check.name} is {check.value}"
    for table in result.tables.values():
        holes = [c.name for c in table.columns if np.asarray(c.data).dtype.kind == "f" and not np.all(np.isfinite(c.data))]
        if holes and not table.missing and f"table '{table.name}'" not in told:
            yield f"table {table.name} has holes in {holes} without a word"
    if result.outcome == "partial" and all(any(words in finding for words in USUAL) for finding in result.findings):
        yield "it is partial without a reason"


@pytest.mark.slow
@kinds
@pytest.mark.parametrize("first", range(0, SPECS, CHUNK))
def test_random_legal_specs_are_answered_or_refused_with_a_reason(kind, first):
    known, refusals, wrong = bases(kind), 0, []
    with np.errstate(all="ignore"), warnings.catch_warnings():  # as for a user: numbers leave their range without an exception
        warnings.simplefilter("ignore")
        for number in range(first, first + CHUNK):
            tables, changes = random_tables(kind, number, known)
            try:
                refused, found = complaints(tables, () if number % WHOLE == 0 else CHEAP.get(kind, ()))
            except Exception as fault:
                refused, found = False, [f"{type(fault).__name__}: {fault}"]
            refusals += refused
            wrong += [f"{kind} {number}, changed {changes}: {each}" for each in found]
    assert wrong == [] and refusals <= REFUSED * CHUNK


@kinds
def test_the_same_number_gives_the_same_spec_and_another_one_another(kind):
    one, again, other = random_tables(kind, 7)[0], random_tables(kind, 7)[0], random_tables(kind, 7 + len(bases(kind)))[0]
    assert one == again != other
