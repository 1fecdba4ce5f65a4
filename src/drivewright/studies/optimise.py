"""Optimisation of any drive: the unknowns, requirements and objectives of a spec's [optimise] table.

One objective: differential evolution (SciPy); several: NSGA-II (pymoo).  Seeded and deterministic.  A mechanism that offers
`batch` evaluates a whole generation in compiled code; any other is run design by design.
"""

import time
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright import registry, units
from drivewright.errors import InputError, MissingExtra, SpecError, UnknownName
from drivewright.result import Check, Result
from drivewright.runner import run
from drivewright.spec import MechanismSpec, dimension_at, document, from_document, set_key

HOPELESS = 1e3  # violation of a design that has no solution at all, in units of the limits


@dataclass(frozen=True)
class Problem:
    """The [optimise] table in numbers: keys, bounds (n, 2) SI, objectives (name, sign), limits (name, sense, limit)."""

    spec: MechanismSpec
    keys: tuple
    bounds: np.ndarray
    objectives: tuple
    limits: tuple
    reference: Result

    @property
    def names(self):
        """Every value that is looked at."""
        return tuple(dict.fromkeys([name for name, _ in self.objectives] + [name for name, _, _ in self.limits]))

    @cached_property
    def scales(self):
        """Size by which each limit's violation is measured."""
        return np.array([abs(limit) or 1.0 for _, _, limit in self.limits])

    def objective_values(self, values):
        """(m, designs), to be made small; nan becomes huge."""
        rows = np.array([sign * values[name] for name, sign in self.objectives])
        return np.where(np.isfinite(rows), rows, HOPELESS)

    def violations(self, values):
        """(limits, designs): how far beyond each limit, over its size; 0 or less is met."""
        if not self.limits:
            return np.zeros((1, len(next(iter(values.values())))))
        rows = [
            (limit - values[name] if sense == ">=" else values[name] - limit) / scale
            for (name, sense, limit), scale in zip(self.limits, self.scales, strict=True)
        ]
        return np.where(np.isfinite(rows), rows, HOPELESS)

    def column_units(self):
        """SI unit of every unknown and value."""
        found = {key: dimension_at(type(self.spec), key)[1] for key in self.keys}
        return {key: d.unit if d else "-" for key, d in found.items()} | {name: self.reference.values[name].unit for name in self.names}

    def design(self, x):
        """The spec with the unknowns at x (SI)."""
        data = document(self.spec)
        for key, value in zip(self.keys, x, strict=True):
            dimension = dimension_at(type(self.spec), key)[1]
            set_key(data, key, dimension.text(float(value)) if dimension else float(value))
        return from_document(data, type(self.spec))


@dataclass(frozen=True)
class Optimised:
    """The outcome: best design with its full result, the front of several objectives, and every evaluation."""

    problem: Problem
    best: Result
    front: np.ndarray
    front_values: dict
    requirements: tuple
    feasible: bool
    history: dict
    evaluations: int
    seconds: float
    seed: int
    method: str
    findings: tuple
    interrupted: bool = False

    def objective_rows(self):
        """(value, reached, direction) as text."""
        rows = []
        for name, sign in self.problem.objectives:
            value = self.best.values[name]
            factor, shown = units.display(value.unit)
            rows.append(
                (
                    name,
                    f"{value.value * factor:.6g} {shown}".removesuffix(" -"),
                    "as small as possible" if sign > 0 else "as large as possible",
                )
            )
        return rows

    def unknown_rows(self):
        """(key, best, lower, upper) as text."""
        rows = []
        for key, x, (low, high) in zip(self.problem.keys, self.front[0], self.problem.bounds, strict=True):
            dimension = dimension_at(type(self.problem.spec), key)[1]
            show = (
                (lambda v, d=dimension: f"{v / units.unit_factor(d.shown, d.name):.5g} {d.shown}") if dimension else (lambda v: f"{v:.5g}")
            )
            rows.append((key, show(x), show(low), show(high)))
        return rows


def optimise(spec, progress=None):
    """`Optimised` of a spec with an [optimise] table.  SpecError where the table cannot be understood."""
    started = time.perf_counter()
    problem = prepare(spec)
    search = spec.optimise
    method = search.method if search.method != "auto" else ("nsga2" if len(problem.objectives) > 1 else "differential-evolution")
    evaluator = Evaluator(problem, search.generations, progress or (lambda done, total, what: None))
    if method == "differential-evolution" and len(problem.objectives) > 1:
        raise SpecError("differential-evolution takes one objective; take nsga2 for several", "optimise.method")
    interrupted = False
    try:
        front = (_nsga2 if method == "nsga2" else _differential_evolution)(problem, search, evaluator)
    except KeyboardInterrupt:
        if not evaluator.designs:
            raise
        front, interrupted = _best_so_far(problem, evaluator), True
    return _outcome(problem, front, evaluator, method, time.perf_counter() - started, interrupted)


# -- reading the table ---------------------------------------------------------------------------------------------------------


def prepare(spec):
    """The `Problem` of a spec; each complaint names the key of the [optimise] table."""
    if spec.optimise is None:
        raise SpecError("is missing; it says what may change, what is required and what is wanted (see `drivewright new`)", "optimise")
    base = _with_settings(spec)
    reference = run(base)
    bounds = [_bounds(base, unknown, number) for number, unknown in enumerate(spec.optimise.unknowns)]
    objectives = tuple(
        (_known(reference, o.value, f"optimise.objectives.{n}.value"), 1.0 if o.goal == "minimise" else -1.0)
        for n, o in enumerate(spec.optimise.objectives)
    )
    limits = tuple(limit for n, r in enumerate(spec.optimise.requirements) for limit in _limits(reference, r, n))
    return Problem(base, tuple(u.key for u in spec.optimise.unknowns), np.array(bounds), objectives, limits, reference)


def _with_settings(spec):
    data = document(spec)
    for setting in spec.optimise.settings:
        set_key(data, setting.key, setting.value)
    return from_document(data, type(spec))


def _bounds(spec, unknown, number):
    place = f"optimise.unknowns.{number}"
    exists, dimension = dimension_at(type(spec), unknown.key)
    if not exists:
        raise SpecError(f"this spec has no key {unknown.key!r}", f"{place}.key")
    low, high = (_in_si(getattr(unknown, side), dimension, f"{place}.{side}") for side in ("lower", "upper"))
    if not low < high:
        raise SpecError(f"lower bound {unknown.lower} is not below upper bound {unknown.upper}", place)
    return low, high


def _in_si(value, dimension, key):
    if dimension is None:
        if isinstance(value, str):
            raise SpecError(f"is a pure number here, got {value!r}", key)
        return float(value)
    try:
        return dimension.parse(value)
    except SpecError as error:
        raise error.located(key) from None


def _known(reference, name, key):
    if name not in reference.values:
        raise SpecError(str(UnknownName("value of the result", name, reference.values)), key)
    return name


def _limits(reference, requirement, number):
    place = f"optimise.requirements.{number}"
    name = _known(reference, requirement.value, f"{place}.value")
    dimension = units.BY_UNIT.get(reference.values[name].unit)
    if requirement.at_least is None and requirement.at_most is None:
        raise SpecError("needs at_least, at_most, or both", place)
    for side, sense in (("at_least", ">="), ("at_most", "<=")):
        if (limit := getattr(requirement, side)) is not None:
            yield name, sense, _in_si(limit, dimension, f"{place}.{side}")


# -- evaluating ----------------------------------------------------------------------------------------------------------------


class Evaluator:
    """Counts, remembers and evaluates: `evaluator(x)` with designs (n, d) gives {name: (n,)}."""

    def __init__(self, problem, generations, progress):
        self.problem, self.generations, self.progress = problem, generations, progress
        offer = registry.mechanism(problem.spec.mechanism).batch
        self.many = (offer(problem.spec, problem.keys, problem.names) if offer else None) or self._one_by_one
        self.designs, self.values = [], []

    def __call__(self, x):
        if self.designs and x.shape == self.designs[-1].shape and np.array_equal(x, self.designs[-1]):
            return self.values[-1]  # objective and constraints ask for the same generation
        values = self.many(x)  # an interrupted generation leaves no trace
        self.designs.append(x.copy())
        self.values.append(values)
        self.progress(min(len(self.designs), self.generations), self.generations, f"{self.count} designs")
        return self.values[-1]

    def _one_by_one(self, x):
        rows = [self._one(row) for row in x]
        return {name: np.array([row.get(name, np.nan) for row in rows]) for name in self.problem.names}

    def _one(self, row):
        try:
            return {name: value.value for name, value in run(self.problem.design(row), self._analyses).values.items()}
        except InputError:
            return {}

    @cached_property
    def _analyses(self):
        """The analyses that give the values looked at; the others need not run for every design."""
        wanted, chosen = set(self.problem.names), []
        for analysis in registry.mechanism(self.problem.spec.mechanism).analyses:
            if analysis.default and (given := wanted & set(run(self.problem.spec, (analysis.name,)).values)):
                wanted -= given
                chosen.append(analysis.name)
        return tuple(chosen)

    @property
    def count(self):
        """Designs evaluated so far."""
        return sum(len(x) for x in self.designs)

    def history(self):
        """Columns of every evaluation: generation, unknowns, values, total violation."""
        x, values = np.concatenate(self.designs), {n: np.concatenate([v[n] for v in self.values]) for n in self.problem.names}
        generation = np.repeat(np.arange(len(self.designs)), [len(d) for d in self.designs])
        violation = np.maximum(self.problem.violations(values), 0).sum(axis=0)
        return {"generation": generation, **dict(zip(self.problem.keys, x.T, strict=True)), **values, "violation": violation}


def _population(search):
    return search.population or max(16, 8 * len(search.unknowns))


def _differential_evolution(problem, search, evaluator):
    """Best design (1, d) by SciPy's differential evolution, a whole generation per call, Lampinen's rule for the constraints."""
    from scipy.optimize import NonlinearConstraint, differential_evolution

    low, high = problem.bounds.T
    number = max(1, len(problem.limits))
    constraint = NonlinearConstraint(
        lambda u: problem.violations(evaluator(np.atleast_2d(low + u.T * (high - low)))).reshape(number, *u.shape[1:]),
        np.full(number, -np.inf),
        np.zeros(number),
    )
    found = differential_evolution(
        lambda u: problem.objective_values(evaluator(low + u.T * (high - low)))[0],
        [(0.0, 1.0)] * len(low),
        maxiter=search.generations,
        popsize=max(1, -(-_population(search) // len(low))),
        rng=np.random.default_rng(search.seed),
        polish=False,
        vectorized=True,
        updating="deferred",
        mutation=(0.4, 0.9),
        recombination=0.9,
        tol=1e-6,
        atol=0.0,
        init="sobol",
        constraints=constraint if problem.limits else (),
    )
    return (low + found.x * (high - low))[None]


def _nsga2(problem, search, evaluator):
    """The non-dominated designs (n, d) by pymoo's NSGA-II, sorted by the first objective."""
    try:
        from pymoo.algorithms.moo.nsga2 import NSGA2
        from pymoo.core.problem import Problem as Vectorised
        from pymoo.optimize import minimize
    except ImportError as error:
        raise MissingExtra("NSGA-II", "optimise", error) from None

    class Task(Vectorised):
        def _evaluate(self, x, out, *_, **__):
            values = evaluator(x)
            out["F"], out["G"] = problem.objective_values(values).T, problem.violations(values).T

    task = Task(
        n_var=len(problem.keys),
        n_obj=len(problem.objectives),
        n_ieq_constr=max(1, len(problem.limits)),
        xl=problem.bounds[:, 0],
        xu=problem.bounds[:, 1],
    )
    found = minimize(task, NSGA2(pop_size=_population(search)), ("n_gen", search.generations), seed=search.seed, verbose=False)
    front = found.X if found.X is not None else np.atleast_2d(_least_violating(problem, evaluator))
    front = np.atleast_2d(front)
    return front[np.argsort(problem.objective_values(evaluator.many(front))[0], kind="stable")]


def _least_violating(problem, evaluator):
    violation = evaluator.history()["violation"]
    return np.concatenate(evaluator.designs)[np.argmin(violation)]


# -- outcome -------------------------------------------------------------------------------------------------------------------


def _best_so_far(problem, evaluator):
    """The design to keep when a search is interrupted: the best that meets every requirement, else the least violating one."""
    history = evaluator.history()
    objective = problem.objective_values({name: history[name] for name in problem.names})[0]
    order = np.lexsort((objective, np.maximum(history["violation"], 0.0)))
    return np.concatenate(evaluator.designs)[order[:1]]


def _outcome(problem, front, evaluator, method, seconds, interrupted=False):
    values = evaluator.many(front)
    feasible = bool(np.all(problem.violations(values)[:, 0] <= 0))
    best = run(problem.design(front[0]))
    requirements = tuple(
        Check(
            name,
            best.values[name].value if name in best.values else float("nan"),
            limit,
            sense,
            problem.reference.values[name].unit,
            "requirement",
        )
        for name, sense, limit in problem.limits
    )
    findings = () if feasible else (_blame(problem, front[0], evaluator),)
    if method != "nsga2":
        findings += tuple(_on_bounds(problem, front[0]))
    return Optimised(
        problem,
        best,
        front,
        values,
        requirements,
        feasible,
        evaluator.history(),
        evaluator.count,
        seconds,
        problem.spec.optimise.seed,
        method,
        findings,
        interrupted,
    )


def _blame(problem, x, evaluator):
    """Which requirement cannot be met: the one that the least violating design misses most."""
    violations = problem.violations(evaluator.many(x[None]))[:, 0]
    name, sense, limit = problem.limits[int(np.argmax(violations))]
    history = evaluator.history()
    alone = int(np.sum(problem.violations({n: history[n] for n in problem.names})[int(np.argmax(violations))] <= 0))
    unit = problem.reference.values[name].unit
    factor, shown = units.display(unit)
    reached = evaluator.many(x[None])[name][0]
    return (
        f"no feasible design after {evaluator.count} evaluations; the requirement to blame is {name} {sense} {limit * factor:.6g} {shown}: "
        f"the least violating design reaches {reached * factor:.6g} {shown}, and {alone} of the designs tried meet this one at all. "
        "Relax it or widen the bounds of the unknowns."
    )


def _on_bounds(problem, x):
    low, high = problem.bounds.T
    share = (x - low) / (high - low)
    for key, u in zip(problem.keys, share, strict=True):
        if u < 0.01 or u > 0.99:
            yield f"{key} sits on its {'lower' if u < 0.5 else 'upper'} bound; a wider bound may give a better design"
