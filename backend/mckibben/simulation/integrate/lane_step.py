"""One step of Rodas4 for a row of lanes; each lane has its own instant and step.

The functions are those of `mckibben.simulation.integrate.lane_code`; arrays hold one row of lanes per
variable.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.integrate.coefficients import ALPHA, DELTA, DENSE_2, DENSE_3, A, C
from mckibben.simulation.integrate.lane_control import ERROR, HOPELESS, INSTANT, INVERSE, REACHED, STEP
from mckibben.simulation.integrate.lane_type import (
    LANES,
    call_with_data,
    larger,
    load,
    magnitude,
    reciprocal,
    smaller,
    splat,
    store,
    where_positive,
)
from mckibben.simulation.integrate.switching import call


@njit(inline="always", error_model="numpy")
def _stage(at_u: int, at_state: int, at_packed: int, at_sum: int, n: int, k: int) -> None:
    """Arguments of stage k and what its right side takes from the stages before it."""
    if k == 1:
        for i in range(n):
            u0 = load(at_u, i)
            store(at_packed, i, load(at_state, i) + A[1, 0] * u0)
            store(at_sum, i, C[1, 0] * u0)
    elif k == 2:
        for i in range(n):
            u0, u1 = load(at_u, i), load(at_u, n + i)
            store(at_packed, i, load(at_state, i) + A[2, 0] * u0 + A[2, 1] * u1)
            store(at_sum, i, C[2, 0] * u0 + C[2, 1] * u1)
    elif k == 3:
        for i in range(n):
            u0, u1, u2 = load(at_u, i), load(at_u, n + i), load(at_u, 2 * n + i)
            store(at_packed, i, load(at_state, i) + A[3, 0] * u0 + A[3, 1] * u1 + A[3, 2] * u2)
            store(at_sum, i, C[3, 0] * u0 + C[3, 1] * u1 + C[3, 2] * u2)
    elif k == 4:
        for i in range(n):
            u0, u1 = load(at_u, i), load(at_u, n + i)
            u2, u3 = load(at_u, 2 * n + i), load(at_u, 3 * n + i)
            total = load(at_state, i) + A[4, 0] * u0 + A[4, 1] * u1
            store(at_packed, i, total + A[4, 2] * u2 + A[4, 3] * u3)
            store(at_sum, i, C[4, 0] * u0 + C[4, 1] * u1 + C[4, 2] * u2 + C[4, 3] * u3)
    else:
        # The argument of the last stage is that of the one before plus its result.
        for i in range(n):
            u0, u1 = load(at_u, i), load(at_u, n + i)
            u2, u3, u4 = load(at_u, 2 * n + i), load(at_u, 3 * n + i), load(at_u, 4 * n + i)
            store(at_packed, i, load(at_packed, i) + u4)
            store(at_sum, i, C[5, 0] * u0 + C[5, 1] * u1 + C[5, 2] * u2 + C[5, 3] * u3 + C[5, 4] * u4)


@njit(inline="always", error_model="numpy")
def attempt(
    functions: tuple[int, int, int, int, int],
    sizes: tuple[int, int, int, int],
    timed: np.ndarray,
    rtol: float,
    atol: np.ndarray,
    at_whole: int,
    at_packed: int,
    places: tuple[int, int, int, int, int, int, int],
) -> None:
    """Try a step in every lane: writes the stages, the new states and the rows ERROR and INVERSE.

    Args:
        functions: addresses of ``rates``, ``jacobian``, ``factorise`` and ``solve``.
        sizes: numbers of states, of entries of the Jacobian and of positions of the plan; the clock.
        timed: rates that depend on time.
        rtol, atol: error per step.
        at_whole: rates, entries of the Jacobian and derivatives by time at the start of the step.
        at_packed: arguments; they hold the new states afterwards, as does the trial.
        places: addresses of state, trial, stages, sums, matrix, values and control.
    """
    rates, _, factorise, solve, _ = functions
    n, entries, positions, clock = sizes
    at_state, at_trial, at_u, at_sums, at_matrix, at_values, at_control = places
    row = 8 * LANES
    step, now, zero = load(at_control, STEP), load(at_control, INSTANT), splat(0.0)
    inverse = 1.0 / step
    store(at_control, INVERSE, inverse)
    call_with_data(factorise, at_matrix, at_whole + row * n, at_control + row * STEP)
    least = load(at_matrix, positions - 1)
    for k in range(6):
        at_result = at_u + row * n * k
        if k == 0:
            for i in range(n):
                store(at_result, i, load(at_whole, i))
        else:
            _stage(at_u, at_state, at_packed, at_sums, n, k)
            store(at_packed, clock, now + ALPHA[k] * step)
            call(rates, at_values, at_packed)
            for i in range(n):
                store(at_result, i, load(at_values, i) + load(at_sums, i) * inverse)
        if DELTA[k] != 0.0:
            for i in range(timed.shape[0]):
                slope = load(at_whole, n + entries + i)
                store(at_result, timed[i], load(at_result, timed[i]) + (DELTA[k] * step) * slope)
        store(at_result, clock, zero)
        call_with_data(solve, at_result, at_matrix, at_matrix)
    errors = zero
    for i in range(n):
        last = load(at_u, 5 * n + i)
        new = load(at_packed, i) + last
        store(at_trial, i, new)
        store(at_packed, i, new)
        scale = splat(atol[i]) + rtol * larger(magnitude(load(at_state, i)), magnitude(new))
        estimate = reciprocal(scale)
        share = last * (estimate + estimate * (1.0 - scale * estimate))  # 8 digits
        errors = errors + share * share
    # A pivot close to zero, or a NaN: `smaller` gives its second argument.
    errors = where_positive(least - 1e-10 * inverse, errors, splat(np.nan))
    store(at_control, ERROR, smaller(errors * (1.0 / n), splat(HOPELESS)))
    reached = load(at_control, REACHED)
    store(at_trial, clock, reached)
    store(at_packed, clock, reached)


@njit(inline="always", error_model="numpy")
def write_dense(kept: np.ndarray, at_state: int, at_trial: int, at_u: int, at_dense: int, n: int) -> None:
    """Coefficients of the dense output of the kept states: y(s) = b0 + s (b1 + s (b2 + s b3))."""
    for c in range(kept.shape[0]):
        i = kept[c]
        first = second = splat(0.0)
        for j in range(5):
            stage = load(at_u, n * j + i)
            first = first + DENSE_2[j] * stage
            second = second + DENSE_3[j] * stage
        begin = load(at_state, i)
        store(at_dense, 4 * c, begin)
        store(at_dense, 4 * c + 1, load(at_trial, i) - begin + first)
        store(at_dense, 4 * c + 2, second - first)
        store(at_dense, 4 * c + 3, splat(0.0) - second)


@njit(inline="always", error_model="numpy")
def row_of(dense: np.ndarray, c: int, lane: int, s: Any) -> Any:
    """The kept state c of a lane at several shares s of its step."""
    bent = dense[4 * c + 2, lane] + s * dense[4 * c + 3, lane]
    return dense[4 * c, lane] + s * (dense[4 * c + 1, lane] + s * bent)
