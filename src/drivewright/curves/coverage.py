"""How deep points lie in the members of a cutting family."""

import numpy as np

_COVERED = 1e-13  # a point counts as cut away when it lies deeper in a member than this, relative to the size of the curve
_TAIL = 64  # crossings whose places are nearer than this many samples get members of their own


class Coverage:
    """Gaps between points and a whole family, from dense members: those at the samples of the envelope and more in small tails."""

    def __init__(self, family, chain, crossings):
        self.family = family
        index, t = chain.index, chain.t
        # What covers a little tail are the members between the two branches of its crossing; the samples may have none there.
        tails = [np.linspace(c.first, c.second, 33) for c in crossings if c.second - c.first < _TAIL]
        if tails:
            more = chain.locate(np.concatenate(tails))
            index, t = np.append(index, more[0]), np.append(t, more[1])
        sources = np.array([-1 if piece.source is None else piece.source for piece in chain.pieces])[index]
        self.members = family.members(sources[sources >= 0], t[sources >= 0])
        self.depth = _COVERED * chain.size

    def least(self, points):
        """Least gap between each point and the members; a negative one means covered."""
        return self.family.gap(self.members[..., self.family.deepest(self.members, points)], points)
