"""Many like systems integrated side by side, in the lanes of vectors: each with steps and events of its own, the same to the bit.

Cases run in threads, as `cases.run` starts them, and ask `integrate` for their trajectories.  Under `together` such a thread waits while
its problem is solved beside up to seven others, by one of a few threads that do nothing else.  Problems that have nothing in common with
the others under way (another structure, another method) are solved by their own thread.
"""

import threading
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any

import numpy as np

from drivewright._jit.lane_arrays import WIDTH, in_lanes, is_of_compiler, put_in_lane, structure, take_from_lane
from drivewright.numerics.ode import advancing
from drivewright.numerics.ode.advancing import ACCEPTED, AGAIN, GOES_ON, HITS, OUTCOME, REJECTED
from drivewright.numerics.ode.locating import StepBatch
from drivewright.numerics.ode.loop import Problem, RunUnderWay, Trajectory, finish, solve, solving_with
from drivewright.numerics.ode.system import Functions

STEPS = 2000  # that are taken at once
WORTHWHILE = 3 * WIDTH  # cases from which it is faster, what has to be compiled for it included
SPARE = 4  # cases in Python's hands while others are under way, for each thread that solves
IN_LANES = {"dopri5"}  # methods whose formulas do without branches
NOBODY = GOES_ON - 1.0  # outcome of a lane without a run


@contextmanager
def together(cases: int, threads: int) -> Iterator[int]:
    """While the context lasts, `integrate` solves its problems side by side; gives how many threads should run the cases."""
    if cases < WORTHWHILE or not hasattr(advancing.advance_together, "py_func"):
        yield threads
        return
    desk = Desk(min(threads, cases // WIDTH))
    token = solving_with(desk.solve)
    try:
        yield (WIDTH + SPARE) * desk.threads
    finally:
        token.var.reset(token)
        desk.close()


class Desk:
    """Where threads hand in their problems, and others take them to solve."""

    def __init__(self, threads: int):
        self.threads, self.is_open = threads, True
        self.waiting: deque[_Request] = deque()
        self.changed = threading.Condition()
        self.solvers = [threading.Thread(target=self._work, daemon=True) for _ in range(threads)]
        for each in self.solvers:
            each.start()

    def solve(self, problem: Problem) -> Trajectory:
        """The Trajectory of a problem; what cannot go side by side with others goes on alone."""
        if problem.method.name not in IN_LANES or problem.max_steps < STEPS or isinstance(problem.system, Functions):
            return solve(problem)
        request = _Request(problem)
        if request.run.goes_on:
            with self.changed:
                self.waiting.append(request)
                self.changed.notify()
            if is_of_compiler(request.is_back.exception()):  # a formula, of a package, say, decides by branches
                return solve(problem)
            request.is_back.result()
        return finish(request.run)

    def close(self) -> None:
        """Let the threads that solve end."""
        with self.changed:
            self.is_open = False
            self.changed.notify_all()
        for each in self.solvers:
            each.join()

    def take(self, key: object, may_wait: bool) -> "_Request | None":
        """The next request whose problem has the structure `key` (None: any), or None: there is none, and none to wait for."""
        with self.changed:
            while self.is_open or self.waiting:
                for request in self.waiting:
                    if key is None or request.key == key:
                        self.waiting.remove(request)
                        return request
                if not may_wait:
                    return None
                self.changed.wait()
        return None

    def _work(self):
        while request := self.take(None, True):
            try:
                lanes = _Lanes(request)
            except BaseException as error:
                request.is_back.set_exception(error)
            else:
                lanes.solve(self)


class _Request:
    """A run that is to go on side by side with others, and the promise that it comes back."""

    def __init__(self, problem):
        self.run, self.is_back = RunUnderWay(problem), Future()
        self.key = structure((problem.system, problem.watch, self.run.y, problem.method.name))


class _Lanes:
    """Up to `WIDTH` runs of one structure side by side."""

    def __init__(self, request):
        from drivewright._jit.compiling import tell_numba_of_lanes

        tell_numba_of_lanes()
        run, self.key, self.rules = request.run, request.key, request.run.rules
        batch: StepBatch = run.batch(STEPS)
        self.state, self.batch = in_lanes(_state(run)), in_lanes(batch)
        self.counts, self.dense = in_lanes(np.zeros(5)), in_lanes(np.zeros(batch.dense.shape[1:]))
        self.counts.values[OUTCOME] = NOBODY
        self.requests: list[_Request | None] = [None] * WIDTH
        self._fill(0, request)

    def solve(self, desk):
        """Solve until there is nothing left to solve; what ends makes room for what waits."""
        try:
            while any(self.requests):
                for lane in range(WIDTH):
                    if self.requests[lane] is None and (request := desk.take(self.key, False)):
                        self._fill(lane, request)
                self._advance()
        except BaseException as error:
            for request in filter(None, self.requests):
                request.is_back.set_exception(error)

    def _fill(self, lane, request):
        self.requests[lane] = request
        put_in_lane(self.state, lane, _state(request.run))
        self.counts.values[[OUTCOME, AGAIN], lane] = GOES_ON, 0.0

    def _advance(self):
        systems, control, work, clock, y, values = self.state
        self.counts.values[[ACCEPTED, REJECTED, HITS]] = 0.0
        more: Any = (control, self.rules, clock, y, values, self.batch, self.counts, self.dense)  # in lanes what the types call arrays
        advancing.advance_together(work, *systems, *more)
        for lane, request in enumerate(self.requests):
            if request is not None:
                self._keep(lane, request)

    def _keep(self, lane, request):
        """Keep what a run has done; give it back where it has ended, or nears its limit of steps between two of them."""
        run, (_, _, *rest) = request.run, self.state
        take_from_lane(tuple(rest), lane, _state(run)[2:])
        accepted, rejected, hits, outcome, again = (int(count) for count in self.counts.values[:, lane])
        run.take(StepBatch(*(each.values[..., lane] for each in self.batch)), outcome, accepted, rejected, hits)
        if not run.goes_on or (run.steps_left < STEPS and not again):
            self.requests[lane], self.counts.values[OUTCOME, lane] = None, NOBODY
            request.is_back.set_result(None)


def _state(run):
    """(systems, control, workspace, clock, y, event functions) of a run; the last four change."""
    return run.systems, run.problem.control, run.work, run.clock, run.y, run.values
