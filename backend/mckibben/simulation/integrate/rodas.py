"""The step of the kernel: Rodas4, a stiff Rosenbrock method, over two compiled functions.

It holds no physics, so numba compiles it once per installation, whatever is simulated. A model is passed as
the addresses of four functions of states, constants, inputs and switches: ``rates``, ``jacobian`` (-> rates,
nonzero entries of the Jacobian, derivatives by time, guards), ``outputs`` and ``guards``; and as the plan of
its linear systems (`mckibben.simulation.integrate.elimination`). Inputs are constant within a segment;
switching instants are segment ends, so no step crosses a jump. One state is the clock: it is known in advance
and not part of the linear systems.

A switch is 0 or 1. It changes where its guard falls below zero: the step is then repeated up to that instant,
so no step crosses such a change either. A switch that is an end stop also takes the speed, or turns it round
with a coefficient of restitution.

Method: Rodas4 of Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7: six stages, order
4 with an embedded order 3, L-stable, dense output of order 3.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.integrate.coefficients import ALPHA, DELTA, GAMMA, A, C
from mckibben.simulation.integrate.switching import (
    call,
    change_switch,
    first_event,
    may_change,
    recedes,
    write_dense,
)


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _factorise(a: np.ndarray, least: float, plan: Any) -> bool:
    """Factorise in place, with reciprocal pivots. False when a pivot is close to zero."""
    _, _, _, pivots, lower, updates, _, _ = plan
    for k in range(pivots.shape[0]):
        if not abs(a[pivots[k, 0]]) > least:
            return False
        reciprocal = 1.0 / a[pivots[k, 0]]
        a[pivots[k, 0]] = reciprocal
        for i in range(pivots[k, 1], pivots[k, 2]):
            a[lower[i]] *= reciprocal
        for i in range(pivots[k, 3], pivots[k, 4]):
            a[updates[i, 0]] -= a[updates[i, 1]] * a[updates[i, 2]]
    return True


@njit(inline="always", error_model="numpy", fastmath={"contract"})
def _solve(a: np.ndarray, plan: Any, vector: np.ndarray) -> None:
    """Solve in place with the factors of `_factorise`."""
    _, _, _, _, _, _, rows, terms = plan
    for k in range(rows.shape[0]):
        total = vector[rows[k, 0]]
        for i in range(rows[k, 1], rows[k, 2]):
            total -= a[terms[i, 0]] * vector[terms[i, 1]]
        vector[rows[k, 0]] = total * a[rows[k, 3]]


@njit(error_model="numpy", fastmath={"contract"})
def advance(
    functions: tuple[int, int, int, int],
    plan: Any,
    positions: int,
    clock: int,
    moved: tuple[int, int],
    switching: Any,
    packed: np.ndarray,
    state: np.ndarray,
    switches: np.ndarray,
    span: np.ndarray,
    grid: np.ndarray,
    last_row: int,
    rtol: float,
    atol: np.ndarray,
    out: np.ndarray,
    events: np.ndarray,
    counts: np.ndarray,
    max_steps: int,
    buffers: Any,
) -> int:
    """Integrate over ``span`` = (begin, end, first step; overwritten with the next) at constant inputs.

    Arrays are copied in loops: numba takes 2 s to compile the message for shapes that do not fit.

    Writes the rows of the grid in between, from row ``counts[2]`` to ``last_row`` - 1; see
    `mckibben.simulation.integrate.kernels.rodas4`.
    """
    rates, jacobian, outputs, guards = functions
    places, timed, diagonal, _, _, _, _, _ = plan
    least, _, _, _, _ = switching
    u, trial, residual, matrix, values, guarded, whole, next_whole, dense = buffers
    n, width, entries = state.shape[0], out.shape[1], places.shape[0]
    kinds, first_switch = switches.shape[0], packed.shape[0] - switches.shape[0]
    first_guard = n + entries + timed.shape[0]
    at_packed, at_values, at_whole = packed.ctypes.data, values.ctypes.data, whole.ctypes.data
    at_next, at_out = next_whole.ctypes.data, out.ctypes.data
    t, end, h = span
    row, fresh, last_failed, landing, last_wanted = counts[2], True, False, -1, h
    while t < end:
        if counts[0] + counts[1] >= max_steps:
            return 2
        if fresh:
            # Inputs or switches have changed: a guard may be violated at once.
            for _ in range(2 * kinds + 1):
                for i in range(n):
                    packed[i] = state[i]
                for i in range(kinds):
                    packed[first_switch + i] = switches[i]
                call(jacobian, at_whole, at_packed)
                changed = False
                for k in range(kinds):
                    if whole[first_guard + k] < -least[k]:
                        change_switch(
                            k, t, whole, guards, moved, switching, packed, guarded, state, switches, events,
                            counts,
                        )  # fmt: skip
                        changed = True
                        break
                if not changed:
                    break
            fresh = False
        wanted = h
        last = t + 1.0000001 * h >= end
        if last:
            h = end - t
        inverse = 1.0 / h
        matrix[:] = 0.0
        for i in range(entries):
            matrix[places[i]] = -whole[n + i]
        for i in range(diagonal.shape[0]):
            matrix[diagonal[i]] += inverse / GAMMA
        matrix[positions - 1] = 1.0
        solvable = _factorise(matrix, 1e-10 * inverse, plan)
        for k in range(6):
            if k == 0:
                for i in range(n):
                    residual[i] = whole[i]
            else:
                for i in range(n):
                    total = state[i]
                    for j in range(k):
                        total += A[k, j] * u[i, j]
                    packed[i] = trial[i] = total
                packed[clock] = t + ALPHA[k] * h
                call(rates, at_values, at_packed)
                for i in range(n):
                    total = 0.0
                    for j in range(k):
                        total += C[k, j] * u[i, j]
                    residual[i] = values[i] + total * inverse
            for i in range(timed.shape[0]):
                residual[timed[i]] += DELTA[k] * h * whole[n + entries + i]
            residual[clock] = 0.0
            _solve(matrix, plan, residual)
            for i in range(n):
                u[i, k] = residual[i]
        error = 0.0
        for i in range(n):
            trial[i] += u[i, 5]
            scale = atol[i] + rtol * max(abs(state[i]), abs(trial[i]))
            error += (u[i, 5] / scale) ** 2
        error = np.sqrt(error / n)
        if not (solvable and error < 1e10):
            error = 1e10
        factor = min(6.0, max(0.2, 0.9 * error**-0.25)) if error > 0.0 else 6.0
        if error > 1.0:
            counts[1] += 1
            last_failed = True
            landing = -1
            h *= factor
            if h < 1e-13 * max(1.0, abs(t)):
                return 3 if error >= 1e10 else 1
            continue
        reached = end if last else t + h
        trial[clock] = reached
        for i in range(n):
            packed[i] = trial[i]
        call(jacobian, at_next, at_packed)
        if landing < 0:
            share = 2.0
            if may_change(next_whole, first_guard, least, moved[1], state, trial):
                write_dense(dense, u)
                share, landing = first_event(
                    guards, t, h, whole, next_whole, first_guard, switches, moved, switching, clock, packed,
                    guarded, state, trial, dense,
                )  # fmt: skip
            if landing >= 0:
                counts[1] += 1
                if share * h > 1e-13 * max(1.0, abs(t)):
                    h *= share
                    last_wanted = wanted
                    continue
                change_switch(
                    landing, t, whole, guards, moved, switching, packed, guarded, state, switches, events,
                    counts,
                )  # fmt: skip
                landing, fresh = -1, True
                continue
        elif recedes(next_whole[first_guard + landing], whole[first_guard + landing]):
            landing = -1
        counts[0] += 1
        if row < last_row and grid[row] <= reached:
            write_dense(dense, u)
            while row < last_row and grid[row] <= reached:
                s = (grid[row] - t) / h
                for i in range(n):
                    bent = dense[0, i] + s * dense[1, i]
                    packed[i] = state[i] * (1.0 - s) + s * (trial[i] + (1.0 - s) * bent)
                packed[clock] = grid[row]
                for i in range(n):
                    out[row, i] = packed[i]
                call(outputs, at_out + 8 * (width * row + n), at_packed)
                row += 1
            counts[2] = row
        t = reached
        for i in range(n):
            state[i] = trial[i]
        if landing >= 0:
            change_switch(
                landing, t, next_whole, guards, moved, switching, packed, guarded, state, switches, events,
                counts,
            )  # fmt: skip
            landing, fresh = -1, True
            h = last_wanted
        else:
            for i in range(whole.shape[0]):
                whole[i] = next_whole[i]
            h *= min(factor, 1.0) if last_failed else factor
            if last and not last_failed:
                h = max(h, wanted)
        last_failed = False
    span[2] = h
    return 0


@njit(error_model="numpy")
def buffers_of(n: int, width: int, positions: int, plan: Any, kinds: int) -> Any:
    """Work arrays: stages, trial, right side, matrix, rates, guards, two Jacobians, dense output."""
    entries = n + plan[0].shape[0] + plan[1].shape[0] + kinds
    stages, dense = np.zeros((n, 6)), np.zeros((2, n))
    values, guarded = np.zeros(width), np.zeros(kinds + 1)
    return (
        stages, np.zeros(n), np.zeros(n), np.zeros(positions), values, guarded, np.zeros(entries),
        np.zeros(entries), dense,
    )  # fmt: skip


@njit(error_model="numpy")
def packed_for(n: int, constants: np.ndarray, inputs: int, kinds: int) -> np.ndarray:
    """Argument array of the functions, with the constants filled in."""
    packed = np.zeros(n + constants.shape[0] + inputs + kinds)
    for i in range(constants.shape[0]):
        packed[n + i] = constants[i]
    return packed
