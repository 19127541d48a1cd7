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
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic


def _call_at(_typing: Any, _address: Any, _out: Any, _inputs: Any) -> Any:
    """Call ``void f(double* out, double* inputs, void*)`` at an address."""

    def generate(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
        double = ir.DoubleType().as_pointer()
        function = ir.FunctionType(ir.VoidType(), [double] * 3)
        out, inputs = (builder.inttoptr(argument, double) for argument in args[1:])
        builder.call(builder.inttoptr(args[0], function.as_pointer()), [out, inputs, inputs])
        return _context.get_dummy_value()

    return types.void(types.int64, types.uintp, types.uintp), generate


call: Any = intrinsic(_call_at)

# Coefficients of Rodas4, in the transformed variables of the book's (7.25): gamma = 0.25.
_GAMMA = 0.25
_A = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [1.544, 0.0, 0.0, 0.0, 0.0],
    [0.9466785280815826, 0.2557011698983284, 0.0, 0.0, 0.0],
    [3.314825187068521, 2.896124015972201, 0.9986419139977817, 0.0, 0.0],
    [1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 0.0],
    [1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1.0],
])  # fmt: skip
_C = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [-5.6688, 0.0, 0.0, 0.0, 0.0],
    [-2.430093356833875, -0.2063599157091915, 0.0, 0.0, 0.0],
    [-0.1073529058151375, -9.594562251023355, -20.47028614809616, 0.0, 0.0],
    [7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160, 0.0],
    [8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054],
])  # fmt: skip
# Time of each stage as a share of the step, and its factor of the derivative by time.
_ALPHA = np.array([0.0, 0.386, 0.21, 0.63, 1.0, 1.0])
_DELTA = np.array([0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0])
_D2 = np.array(
    [10.12623508344586, -7.487995877610167, -34.80091861555747, -7.992771707568823, 1.025137723295662]
)
_D3 = np.array(
    [-0.6762803392801253, 6.087714651680015, 16.43084320892478, 24.76722511418386, -6.594389125716872]
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


@njit(inline="always", error_model="numpy")
def _interpolated(i: int, s: float, start: np.ndarray, end: np.ndarray, u: np.ndarray) -> float:
    """Dense output of a state at the share s of a step."""
    first = second = 0.0
    for j in range(5):
        first += _D2[j] * u[i, j]
        second += _D3[j] * u[i, j]
    return start[i] * (1.0 - s) + s * (end[i] + (1.0 - s) * (first + s * second))


@njit(error_model="numpy")
def _guard_at(
    guards: int, s: float, t: float, h: float, k: int, clock: int, packed: np.ndarray, values: np.ndarray,
    start: np.ndarray, end: np.ndarray, u: np.ndarray,
) -> float:  # fmt: skip
    """Guard of switch k at the share s of a step."""
    for i in range(start.shape[0]):
        packed[i] = _interpolated(i, s, start, end, u)
    packed[clock] = t + s * h
    call(guards, values.ctypes.data, packed.ctypes.data)
    return values[k]


@njit(error_model="numpy")
def _crossing(
    guards: int, upper: float, t: float, h: float, k: int, least: float, clock: int, packed: np.ndarray,
    values: np.ndarray, start: np.ndarray, end: np.ndarray, u: np.ndarray,
) -> float:  # fmt: skip
    """Share of a step at which guard k falls below -least; it is above at 0 and below at ``upper``.

    Regula falsi of the Illinois kind.
    """
    low, high = 0.0, upper
    at_low = _guard_at(guards, low, t, h, k, clock, packed, values, start, end, u) + least
    at_high = _guard_at(guards, high, t, h, k, clock, packed, values, start, end, u) + least
    if at_low <= 0.0:
        return 0.0
    side = 0
    for _ in range(60):
        if high - low < 1e-12 or not at_high < 0.0:
            break
        middle = (low * at_high - high * at_low) / (at_high - at_low)
        value = _guard_at(guards, middle, t, h, k, clock, packed, values, start, end, u) + least
        if abs(value) <= 0.5 * least:
            return middle
        if value < 0.0:
            high, at_high = middle, value
            if side == -1:
                at_low *= 0.5
            side = -1
        else:
            low, at_low = middle, value
            if side == 1:
                at_high *= 0.5
            side = 1
    return high


@njit(error_model="numpy")
def _turning(i: int, start: np.ndarray, end: np.ndarray, u: np.ndarray) -> float:
    """Share of a step at which a speed that changes its sign is zero."""
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        if _interpolated(i, middle, start, end, u) * start[i] > 0.0:
            low = middle
        else:
            high = middle
    return low


@njit(error_model="numpy")
def _switch(
    k: int, t: float, rates: np.ndarray, guards: int, moved: tuple[int, int], switching: Any,
    packed: np.ndarray, guarded: np.ndarray, state: np.ndarray, switches: np.ndarray, events: np.ndarray,
    counts: np.ndarray,
) -> None:  # fmt: skip
    """Change switch k; an end stop stops the load or throws it back. ``rates`` are those before."""
    _, stops, bounce, follows = switching
    speed = acceleration = 0.0
    if moved[1] >= 0:
        speed, acceleration = state[moved[1]], rates[moved[1]]
    to = 1.0 - switches[k]
    if to == 1.0 and stops[k] == stops[k]:
        state[moved[0]] = stops[k]
        state[moved[1]] = 0.0
        if bounce[0] * abs(speed) > bounce[1]:
            state[moved[1]] = -bounce[0] * speed
            to = 0.0
    if follows[k] >= 0.0:
        # The guard of a switch that is 1 is the distance to be closed, times a stiffness.
        for i in range(state.shape[0]):
            packed[i] = state[i]
        first = packed.shape[0] - switches.shape[0]
        for i in range(switches.shape[0]):
            packed[first + i] = switches[i]
        packed[first + k] = 1.0
        call(guards, guarded.ctypes.data, packed.ctypes.data)
        state[int(follows[k])] -= guarded[k] / bounce[2]
    switches[k] = to
    if counts[3] < events.shape[0]:
        row = counts[3]
        events[row, 0], events[row, 1], events[row, 2] = t, float(k), to
        events[row, 3], events[row, 4] = speed, acceleration
    counts[3] += 1


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
    least, stops, _, _ = switching
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
                        _switch(
                            k,
                            t,
                            whole,
                            guards,
                            moved,
                            switching,
                            packed,
                            guarded,
                            state,
                            switches,
                            events,
                            counts,
                        )
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
            matrix[diagonal[i]] += inverse / _GAMMA
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
                        total += _A[k, j] * u[i, j]
                    packed[i] = trial[i] = total
                packed[clock] = t + _ALPHA[k] * h
                call(rates, at_values, at_packed)
                for i in range(n):
                    total = 0.0
                    for j in range(k):
                        total += _C[k, j] * u[i, j]
                    residual[i] = values[i] + total * inverse
            for i in range(timed.shape[0]):
                residual[timed[i]] += _DELTA[k] * h * whole[n + entries + i]
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
            for k in range(kinds):
                upper = 1.0 if next_whole[first_guard + k] < -least[k] else 0.0
                free = upper == 0.0 and switches[k] == 0.0 and stops[k] == stops[k]
                if free and state[moved[1]] * trial[moved[1]] < 0.0:
                    # A load that turns round within the step may have touched the stop.
                    turn = _turning(moved[1], state, trial, u)
                    at = _guard_at(guards, turn, t, h, k, clock, packed, guarded, state, trial, u)
                    upper = turn if at < -least[k] else 0.0
                if upper > 0.0:
                    at = _crossing(guards, upper, t, h, k, least[k], clock, packed, guarded, state, trial, u)
                    if at < share:
                        share, landing = at, k
            if landing >= 0:
                counts[1] += 1
                if share * h > 1e-13 * max(1.0, abs(t)):
                    h *= share
                    last_wanted = wanted
                    continue
                _switch(
                    landing,
                    t,
                    whole,
                    guards,
                    moved,
                    switching,
                    packed,
                    guarded,
                    state,
                    switches,
                    events,
                    counts,
                )
                landing, fresh = -1, True
                continue
        counts[0] += 1
        if row < last_row and grid[row] <= reached:
            for i in range(n):
                dense[0, i] = dense[1, i] = 0.0
                for j in range(5):
                    dense[0, i] += _D2[j] * u[i, j]
                    dense[1, i] += _D3[j] * u[i, j]
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
            _switch(
                landing,
                t,
                next_whole,
                guards,
                moved,
                switching,
                packed,
                guarded,
                state,
                switches,
                events,
                counts,
            )
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
