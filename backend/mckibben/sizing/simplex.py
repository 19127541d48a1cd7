"""The simplex method of Nelder and Mead, one round of points at a time, so that many searches run together.

Source: Nelder & Mead, A simplex method for function minimization, Computer Journal 7 (1965); coefficients of
reflection 1, expansion 2, contraction and shrinking 1/2.
"""

from __future__ import annotations

from collections.abc import Generator

import numpy as np

Rounds = Generator[list[np.ndarray], list[float], None]


def simplex_search(simplex: np.ndarray, *, most: int, near: float, alike: float) -> Rounds:
    """Rounds of points whose costs are wanted; send them back in the same order.

    Args:
        simplex: the first points, shape (variables + 1, variables).
        most: number of points after which the search ends.
        near, alike: it also ends when all points are this near to the best one, and their costs this alike.
    """
    points = np.array(simplex, dtype=float)
    first = list(points[:most])
    costs = np.full(len(points), np.inf)
    costs[: len(first)] = yield first
    left = most - len(first)
    while left > 0:
        order = np.argsort(costs, kind="stable")
        points, costs = points[order], costs[order]
        if np.max(np.abs(points[1:] - points[0])) <= near and np.max(np.abs(costs[1:] - costs[0])) <= alike:
            return
        middle = points[:-1].mean(axis=0)
        away = middle - points[-1]
        reflected = middle + away
        (cost,) = yield [reflected]
        left -= 1
        if cost < costs[0]:
            best, least = reflected, cost
            if left > 0:
                expanded = middle + 2.0 * away
                (cost,) = yield [expanded]
                left -= 1
                if cost < least:
                    best, least = expanded, cost
            points[-1], costs[-1] = best, least
            continue
        if cost < costs[-2]:
            points[-1], costs[-1] = reflected, cost
            continue
        if left == 0:
            return
        outside = cost < costs[-1]
        limit = cost if outside else costs[-1]
        contracted = middle + (0.5 if outside else -0.5) * away
        (cost,) = yield [contracted]
        left -= 1
        if cost <= limit if outside else cost < limit:
            points[-1], costs[-1] = contracted, cost
            continue
        points[1:] = points[0] + 0.5 * (points[1:] - points[0])
        chosen = list(points[1 : 1 + left])
        if not chosen:
            return
        costs[1 : 1 + len(chosen)] = yield chosen
        left -= len(chosen)
