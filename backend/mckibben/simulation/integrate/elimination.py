"""Elimination plan for the linear systems of a structure: an order of its states by their dependencies.

The kernel solves (1/(gamma h) - J) x = b some thousand times a run, and most of J is zero. The states form
strongly connected blocks, ordered so that each block depends only on earlier ones: a valve before the muscle,
an integral last. Elimination is needed within a block only, along the diagonal and in the order of least
fill. Pivots stay on the diagonal: 1/(gamma h) is added to it, so a vanishing pivot means that the step is too
long; the kernel then shortens it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np


class Plan(NamedTuple):
    """Elimination as lists of positions in one array of matrix entries; the last position holds 1.

    Attributes:
        places: position of each entry of the Jacobian, in the order of ``entries``.
        diagonal: positions of the diagonal entries.
        pivots: rows (position of the pivot, first and last + 1 of its column in ``lower``, first and last + 1
            of its ``updates``).
        lower: positions of the entries below pivots.
        updates: rows (target, below, right): target -= below * right.
        rows: steps of a solution, rows (state, first and last + 1 of its ``terms``, position of its factor).
        terms: rows (position, state) of the products entry * solution to subtract.
        size: number of positions.
    """

    places: np.ndarray
    diagonal: np.ndarray
    pivots: np.ndarray
    lower: np.ndarray
    updates: np.ndarray
    rows: np.ndarray
    terms: np.ndarray
    size: int


def plan_of(size: int, entries: Iterable[tuple[int, int]], *, without: int = -1) -> Plan:
    """The elimination for a Jacobian.

    Args:
        size: number of states.
        entries: (row, column) of the nonzero entries, in the order of their values.
        without: a state that is known in advance (the clock); it has no entries.
    """
    pairs = list(entries)
    states = [state for state in range(size) if state != without]
    needs = {state: {column for row, column in pairs if row == state} - {state} for state in states}
    position = {entry: index for index, entry in enumerate(pairs)}

    def place(row: int, column: int) -> int:
        return position.setdefault((row, column), len(position))

    diagonal = {state: place(state, state) for state in states}
    pivots: list[tuple[int, ...]] = []
    lower: list[int] = []
    updates: list[tuple[int, int, int]] = []
    rows: list[tuple[int, int, int, tuple[int, int] | None]] = []
    terms: list[tuple[int, int]] = []

    def step(state: int, columns: Iterable[int], factor: tuple[int, int] | None) -> None:
        begin = len(terms)
        terms.extend((place(state, column), column) for column in columns)
        rows.append((state, begin, len(terms), factor))

    for block in _blocks(needs):
        inside = set(block)
        order, right = _eliminate(block, {state: needs[state] & inside for state in block})
        below = {state: [k for k in order if state in right[1][k]] for state in order}
        for state in order:
            first, start = len(lower), len(updates)
            lower += [place(row, state) for row in sorted(right[1][state])]
            updates += [
                (place(row, column), place(row, state), place(state, column))
                for row in sorted(right[1][state])
                for column in sorted(right[0][state])
            ]
            pivots.append((diagonal[state], first, len(lower), start, len(updates)))
        for state in order:
            outside = sorted(needs[state] - inside)
            last = state == order[-1]
            if outside or below[state] or last:
                step(state, [*outside, *below[state]], (state, state) if last else None)
        for state in reversed(order[:-1]):
            step(state, sorted(right[0][state]), (state, state))
    one = len(position)
    table = [(*row, one if factor is None else position[factor]) for *row, factor in rows]
    return Plan(
        places=np.array([position[entry] for entry in pairs], np.int64),
        diagonal=np.array(list(diagonal.values()), np.int64),
        pivots=np.array(pivots, np.int64).reshape(-1, 5),
        lower=np.array(lower, np.int64),
        updates=np.array(updates, np.int64).reshape(-1, 3),
        rows=np.array(table, np.int64).reshape(-1, 4),
        terms=np.array(terms, np.int64).reshape(-1, 2),
        size=one + 1,
    )


def _eliminate(
    block: list[int], needs: dict[int, set[int]]
) -> tuple[list[int], tuple[dict[int, set[int]], dict[int, set[int]]]]:
    """The order of least fill; for each state the later columns of its row and later rows of its column."""
    across = {state: set(needs[state]) for state in block}
    down = {state: {row for row in block if state in needs[row]} for state in block}
    order: list[int] = []
    right: dict[int, set[int]] = {}
    under: dict[int, set[int]] = {}
    left = set(block)
    while left:
        state = min(left, key=lambda s: (len(across[s] & left - {s}) * len(down[s] & left - {s}), s))
        left.remove(state)
        right[state], under[state] = across[state] & left, down[state] & left
        for row in under[state]:
            new = right[state] - {row}
            across[row] |= new
            for column in new:
                down[column].add(row)
        order.append(state)
    return order, (right, under)


def _blocks(needs: dict[int, set[int]]) -> list[list[int]]:
    """Strongly connected states, each block after those it depends on (Tarjan)."""
    index: dict[int, int] = {}
    low: dict[int, int] = {}
    stack: list[int] = []
    found: list[list[int]] = []

    def visit(state: int) -> None:
        index[state] = low[state] = len(index)
        stack.append(state)
        for other in sorted(needs[state]):
            if other not in index:
                visit(other)
                low[state] = min(low[state], low[other])
            elif other in stack:
                low[state] = min(low[state], index[other])
        if low[state] == index[state]:
            cut = stack.index(state)
            found.append(sorted(stack[cut:]))
            del stack[cut:]

    for state in needs:
        if state not in index:
            visit(state)
    return found
