"""Contact with Coulomb's friction: a programme of `complementarity` with tractions beside the pressures.

With g = A x + b + H'a the gaps at pressures p and the slips since the state before at tractions q,

    p >= 0,  g >= 0,  p g = 0      and      |q| <= mu p,  q = -mu p s/|s|  where s is not 0.

Both are projections, p = max(p - g, 0) and q = P(q - s) on the circle of radius mu p (Alart and Curnier, 1991), and a semismooth Newton
method solves them together with H x + h = 0: in the plane it is an active set of places that are open, stick or slip.  Where it does not
settle, a method of alternating directions (ADMM) whose circles follow the pressures brings it near, and Newton's method makes it exact.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import SolverError
from drivewright.solids.contact.complementarity import BALANCED, TINY, Pressed, sizes

TRIES = 40  # of Newton's method
CLOSE = 1e-9  # of the unknowns, relative: two iterates that agree
ABOVE = 1e-9  # of what friction bears: a traction at its bound whose place does not slip sticks
ROUNDS = 4000  # of alternating directions
NEAR = 1e-7  # of the unknowns, relative: where they stop
HELD = 1e-12  # keeps motions that nothing holds from being singular


class Grips(NamedTuple):
    """g places with friction: normal (g,) and along (g, 1 or 2), the unknowns of pressure and traction; coefficient (g,) of friction."""

    normal: Ints
    along: Ints
    coefficient: Floats

    def rays(self, held: Floats) -> Floats:
        """Resultants (m, k) of the edges of an eight-sided pyramid about each cone |q| <= mu p, in the plane of its two sides; H (m, n)."""
        turn = np.arange(8) * np.pi / 4
        ways = np.stack([np.cos(turn), np.sin(turn)]) / np.cos(np.pi / 8) if self.along.shape[1] == 2 else np.array([[1.0, -1.0]])
        edges = held[:, self.normal, None] + self.coefficient[:, None] * (held[:, self.along] @ ways)
        return edges.reshape(len(held), -1)


def solve_friction(
    matrix: Floats, right: Floats, held: Floats, load: Floats, one_sided: Bools, grips: Grips, first: Pressed | None = None
) -> Pressed:
    """`Pressed` for A, b, H, h and one-sided unknowns as in `solve_complementarity`; `first`: the state before.

    Of the answer `gap` holds the slip at tractions, and `pressing` whether they stick.  SolverError where neither method ends.
    """
    scale = sizes(matrix, held)
    scale[grips.along] = scale[grips.normal, None]  # circles stay circles
    push = np.linalg.norm(held / scale, axis=1)
    push = np.where(push > 0, push, 1.0)
    problem = _Problem(
        matrix / np.outer(scale, scale),
        right / scale,
        held / scale / push[:, None],
        load / push,
        one_sided | _at(grips.normal, one_sided),
        grips,
    )
    x, motions = (np.zeros(len(right)), np.zeros(len(held))) if first is None else (first.x * scale, first.motions * push)
    found = problem.newton(x, motions, first is None) or problem.newton(*problem.alternating(x), False)
    if found is None:
        raise SolverError(
            f"contact: the sets of sticking and slipping places, out of {len(grips.normal)}, did not converge; "
            "the load may reach the limit of friction. Try smaller load steps, a smaller load across the contact, or a finer mesh."
        )
    return Pressed(found.x / scale, found.motions / push, found.gap * scale, found.pressing)


class _Problem(NamedTuple):
    """Scaled: the diagonal of A is about 1."""

    matrix: Floats
    right: Floats
    held: Floats
    load: Floats
    one_sided: Bools
    grips: Grips

    def gap(self, x: Floats, motions: Floats) -> Floats:
        return self.matrix @ x + self.right + self.held.T @ motions

    def newton(self, x: Floats, motions: Floats, everything: bool) -> Pressed | None:
        """From x and motions, or with all places closed and sticking; None where it does not settle."""
        normal, along, coefficient = self.grips
        before: bytes = b""
        gap = self.gap(x, motions)
        for _ in range(TRIES):
            trial = x - gap
            closed = ~self.one_sided | (trial > 0) | everything
            pull, most = np.linalg.norm(trial[along], axis=1), coefficient * np.maximum(x[normal], 0.0)
            slips = closed[normal] & (pull > most * (1 + ABOVE)) & (not everything)
            sticks = closed[normal] & ~slips
            everything = False
            new, motions = self._step(closed, sticks, slips, trial, most / np.where(slips, pull, 1.0))
            moved, x = np.abs(new - x).max(), new
            gap = self.gap(x, motions)
            state = closed.tobytes() + slips.tobytes()
            if state == before and moved < CLOSE * max(np.abs(x).max(), 1e-300):
                if np.abs(self.held @ x + self.load).max(initial=0.0) > BALANCED * np.abs(self.load).max(initial=0.0):
                    return None  # what presses and rubs cannot carry the load
                pressing = closed.copy()
                pressing[along] = sticks[:, None]
                return Pressed(x, motions, np.where(pressing, 0.0, gap), pressing)
            before = state
        return None

    def _step(self, closed: Bools, sticks: Bools, slips: Bools, trial: Floats, share: Floats) -> tuple[Floats, Floats]:
        """Unknowns and motions of one Newton step; share (g,): mu p over the length of a slipping place's trial traction."""
        import scipy.linalg

        normal, along, coefficient = self.grips
        unknown = closed.copy()
        unknown[along] = (sticks | slips)[:, None]
        at, number = np.flatnonzero(unknown), np.cumsum(unknown) - 1
        count, motions = len(at), len(self.held)
        block = np.zeros((count + motions,) * 2)
        block[:count, :count] = self.matrix[np.ix_(at, at)] + TINY * np.eye(count)
        block[:count, count:] = self.held[:, at].T
        block[count:, :count] = self.held[:, at]
        block[count:, count:] = -HELD * np.eye(motions)
        right = np.concatenate([-self.right[at], -self.load])
        rows, pull = number[along[slips]], trial[along[slips]]
        way, eye = pull / np.linalg.norm(pull, axis=1, keepdims=True), np.eye(along.shape[1])
        turn = share[slips, None, None] * (eye - way[:, :, None] * way[:, None, :])  # 0 in the plane
        block[rows], right[rows] = turn @ block[rows], (turn @ right[rows][..., None])[..., 0]
        block[rows[:, :, None], rows[:, None, :]] += eye - turn
        block[rows, number[normal[slips], None]] -= coefficient[slips, None] * way
        answer = scipy.linalg.solve(block, right, check_finite=False)
        x = np.zeros(len(self.right))
        x[at] = answer[:count]
        return x, answer[count:]

    def alternating(self, x: Floats) -> tuple[Floats, Floats]:
        """x and motions near the solution."""
        import scipy.linalg

        count, motions = len(self.right), len(self.held)
        block = np.block([[self.matrix + np.eye(count), self.held.T], [self.held, -HELD * np.eye(motions)]])
        factor = scipy.linalg.lu_factor(block, check_finite=False)
        inside, dual, answer = self._projected(x), np.zeros(count), np.zeros(count + motions)
        for _ in range(ROUNDS):
            answer = scipy.linalg.lu_solve(factor, np.concatenate([inside - dual - self.right, -self.load]), check_finite=False)
            new = self._projected(answer[:count] + dual)
            dual += answer[:count] - new
            moved, inside = np.abs(new - inside).max(), new
            if max(moved, np.abs(answer[:count] - inside).max()) < NEAR * max(np.abs(inside).max(), 1e-300):
                break
        return inside, answer[count:]

    def _projected(self, x: Floats) -> Floats:
        """x with pressures that push and tractions within friction."""
        normal, along, coefficient = self.grips
        inside = np.where(self.one_sided, np.maximum(x, 0.0), x)
        pull, most = np.linalg.norm(x[along], axis=1), coefficient * inside[normal]
        inside[along] *= np.minimum(1.0, most / np.maximum(pull, 1e-300))[:, None]
        return inside


def _at(places: Ints, like: Bools) -> Bools:
    marked = np.zeros(len(like), bool)
    marked[places] = True
    return marked
