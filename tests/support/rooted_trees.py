"""Butcher's rooted trees and elementary weights, by which the order of a Runge-Kutta method is read from its tableau."""

import numpy as np


def trees(order):
    """All rooted trees with `order` nodes, each the sorted tuple of the trees hanging from its root."""

    def forests(nodes, most):
        if nodes == 0:
            yield ()
        for size in range(min(nodes, most), 0, -1):
            for tree in trees(size):
                for rest in forests(nodes - size, size):
                    yield tuple(sorted((tree, *rest), key=repr))

    return sorted(set(forests(order - 1, order - 1)), key=repr)


def nodes(tree):
    return 1 + sum(nodes(branch) for branch in tree)


def density(tree):
    return nodes(tree) * np.prod([density(branch) for branch in tree])


def elementary_weights(tree, a):
    """The product over the branches of A times their weights, per stage."""
    return np.prod([np.ones(len(a)), *(a @ elementary_weights(branch, a) for branch in tree)], axis=0)
