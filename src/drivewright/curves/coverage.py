"""How deep points lie in the members of a cutting family."""

import numpy as np

_COVERED = 1e-13  # a point counts as cut away when it lies deeper in a member than this, relative to the size of the curve
_TAIL = 64  # crossings whose places are nearer than this many samples get members of their own


class Coverage:
    """Gaps between points and the whole family, from dense members refined by Newton."""

    def __init__(self, family, chain, crossings):
        self.family = family
        index, t = chain.index, chain.t
        # Members between the two branches of a crossing are those that cover the little tail there.
        close = [c for c in crossings if c.second - c.first < _TAIL]
        if close:
            extra_index, extra_t = chain.locate(np.concatenate([np.linspace(c.first, c.second, 33) for c in close]))
            index, t = np.append(index, extra_index), np.append(t, extra_t)
        sources = np.array([-1 if piece.source is None else piece.source for piece in chain.pieces])
        real = sources[index] >= 0
        self.index, self.t = sources[index][real], t[real]
        order = np.lexsort((self.t, self.index))
        self.index, self.t = self.index[order], self.t[order]
        self.values = family.values(family.members(self.index, self.t))
        self.depth = _COVERED * chain.size

    def coarse(self, points):
        """Least gap among the dense members: covered for certain where negative."""
        return self.family.gap(self.values[..., self.family.deepest(self.values, points)], points)

    def least(self, points, steps=4):
        """Least gap over all members, each minimum refined between its neighbours."""
        best = self.family.deepest(self.values, points)
        least = self.family.gap(self.values[..., best], points)
        index, t = self.index[best], self.t[best].copy()
        low, high = self._neighbours(best, -1), self._neighbours(best, 1)
        for _ in range(steps):
            gap = self.family.gap(self.family.members(index, t), points)
            least = np.minimum(least, gap.d0)
            t = newton_step(t, gap, low, high)
        return least

    def _neighbours(self, number, way):
        other = np.clip(number + way, 0, len(self.t) - 1)
        return np.where(self.index[other] == self.index[number], self.t[other], self.t[number])


def newton_step(t, gap, low, high):
    """One step towards gap' = 0, downhill only, inside [low, high]."""
    with np.errstate(divide="ignore", invalid="ignore"):
        step = np.where(gap.d2 > 0, -gap.d1 / gap.d2, 0.0)
    return np.clip(t + np.where(np.isfinite(step), step, 0.0), low, high)
