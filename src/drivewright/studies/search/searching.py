"""Ways to search: one objective by differential evolution (SciPy), several by NSGA-II (pymoo).  Seeded and deterministic.

A search calls `evaluator(points)` with each generation (m, n) and leaves it to the evaluator to remember what came of it.
"""

from typing import Protocol

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import MissingExtra, SpecError
from drivewright.spec import Optimise
from drivewright.studies.search.problem import Problem


class Evaluation(Protocol):
    """What gives the values of a generation."""

    def __call__(self, points: Floats) -> dict[str, Floats]: ...

    def values(self, points: Floats) -> dict[str, Floats]:
        """{name: (m,)} at points that have been evaluated."""
        ...


def method_of(search: Optimise) -> str:
    """Name of the method for an [optimise] table."""
    several = len(search.objectives) > 1
    if search.method == "differential-evolution" and several:
        raise SpecError("differential-evolution takes one objective; take nsga2 for several", "optimise.method")
    return search.method if search.method != "auto" else ("nsga2" if several else "differential-evolution")


def population_of(search: Optimise) -> int:
    """Designs per generation."""
    return search.population or max(16, 8 * len(search.unknowns))


def _members(search: Optimise) -> int:
    """Designs per generation of differential evolution: a multiple of the unknowns, raised to the power of two that Sobol's points want."""
    least = max(5, max(1, -(-population_of(search) // len(search.unknowns))) * len(search.unknowns))
    return 1 << (least - 1).bit_length()


def most_evaluations(search: Optimise) -> int:
    """How many designs a search evaluates, if it goes through all of its generations."""
    if method_of(search) == "nsga2":
        return population_of(search) * search.generations
    return _members(search) * (search.generations + 1)  # the first population is none of the generations


def differential_evolution(problem: Problem, search: Optimise, evaluator: Evaluation) -> None:
    """A whole generation per call, Lampinen's rule for the constraints."""
    from scipy.optimize import NonlinearConstraint, differential_evolution

    low, high = problem.space.T
    number = len(problem.limits) + 1

    def points(u):
        return low + u.T * (high - low)

    def violations(u):
        """Asked of each generation before the objective; and of one design (n,), for the number of constraints only."""
        return problem.violations(evaluator(points(u))) if u.ndim == 2 else np.zeros(number)

    differential_evolution(
        lambda u: problem.objective_values(evaluator.values(points(u)))[0],
        [(0.0, 1.0)] * len(low),
        maxiter=search.generations,
        popsize=max(1, -(-population_of(search) // len(low))),
        rng=np.random.default_rng(search.seed),
        polish=False,
        vectorized=True,
        updating="deferred",
        mutation=(0.4, 0.9),
        recombination=0.9,
        tol=1e-6,
        atol=0,
        init="sobol",
        constraints=NonlinearConstraint(violations, np.full(number, -np.inf), np.zeros(number)),
    )


def nsga2(problem: Problem, search: Optimise, evaluator: Evaluation) -> None:
    """Non-dominated sorting of each generation with its parents."""
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

    low, high = problem.space.T
    task = Task(n_var=len(low), n_obj=len(problem.objectives), n_ieq_constr=len(problem.limits) + 1, xl=low, xu=high)
    minimize(task, NSGA2(pop_size=population_of(search)), ("n_gen", search.generations), seed=search.seed, verbose=False)


METHODS = {"differential-evolution": differential_evolution, "nsga2": nsga2}
