"""One model-independent Rodas4 kernel: a stiff Rosenbrock method over two compiled functions.

The kernel holds no physics, so numba compiles it once per installation, whatever is simulated. A model comes
in as raw function pointers made by symengine's LLVM back end: ``rates`` (states, parameters, inputs -> rates
and outputs) and ``jacobian`` (the same states -> rates and the dense Jacobian, row by row). Inputs are
constant within a segment; switching instants are segment ends, so no step crosses a jump.

Method: Rodas4 of Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7: six stages, order
4 with an embedded order 3, L-stable, dense output of order 3.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Any

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic


class Status(IntEnum):
    """How a run of the kernel ended."""

    COMPLETED = 0
    STEP_TOO_SMALL = 1
    TOO_MANY_STEPS = 2
    NOT_FINITE = 3


def _call_at(_typing: Any, _address: Any, _out: Any, _inputs: Any, _data: Any) -> Any:
    """Call ``void f(double* out, double* inputs, void* data)`` at an address."""

    def generate(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
        double = ir.DoubleType().as_pointer()
        function = ir.FunctionType(ir.VoidType(), [double] * 3)
        pointers = [builder.inttoptr(argument, double) for argument in args[1:]]
        builder.call(builder.inttoptr(args[0], function.as_pointer()), pointers)
        return _context.get_dummy_value()

    return types.void(types.int64, types.uintp, types.uintp, types.uintp), generate


_call: Any = intrinsic(_call_at)


@njit(inline="always")
def _factorise(matrix: np.ndarray, pivots: np.ndarray) -> bool:
    """LU factors in place with row pivoting; the diagonal holds reciprocals. False when singular."""
    n = pivots.shape[0]
    for k in range(n):
        best, row = abs(matrix[k, k]), k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > best:
                best, row = abs(matrix[i, k]), i
        pivots[k] = row
        if not best > 0.0:
            return False
        if row != k:
            for j in range(n):
                matrix[k, j], matrix[row, j] = matrix[row, j], matrix[k, j]
        reciprocal = 1.0 / matrix[k, k]
        matrix[k, k] = reciprocal
        for i in range(k + 1, n):
            if matrix[i, k] != 0.0:
                factor = matrix[i, k] * reciprocal
                matrix[i, k] = factor
                for j in range(k + 1, n):
                    matrix[i, j] -= factor * matrix[k, j]
    return True


@njit(inline="always")
def _solve(matrix: np.ndarray, pivots: np.ndarray, vector: np.ndarray) -> None:
    """Solve with the factors of `_factorise`, in place; further rows of the vector are left alone."""
    n = pivots.shape[0]
    for k in range(n):
        row = pivots[k]
        if row != k:
            vector[k], vector[row] = vector[row], vector[k]
    for i in range(n):
        total = vector[i]
        for j in range(i):
            total -= matrix[i, j] * vector[j]
        vector[i] = total
    for i in range(n - 1, -1, -1):
        total = vector[i]
        for j in range(i + 1, n):
            total -= matrix[i, j] * vector[j]
        vector[i] = total * matrix[i, i]


# Coefficients of Rodas4, in the transformed variables of the book's (7.25): gamma = 0.25.
_GAMMA = 0.25
_A = np.array([
    [0.0, 0.0, 0.0, 0.0],
    [1.544, 0.0, 0.0, 0.0],
    [0.9466785280815826, 0.2557011698983284, 0.0, 0.0],
    [3.314825187068521, 2.896124015972201, 0.9986419139977817, 0.0],
    [1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950],
])  # fmt: skip
_C = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [-5.6688, 0.0, 0.0, 0.0, 0.0],
    [-2.430093356833875, -0.2063599157091915, 0.0, 0.0, 0.0],
    [-0.1073529058151375, -9.594562251023355, -20.47028614809616, 0.0, 0.0],
    [7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160, 0.0],
    [8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054],
])  # fmt: skip
_D2 = np.array(
    [10.12623508344586, -7.487995877610167, -34.80091861555747, -7.992771707568823, 1.025137723295662]
)
_D3 = np.array(
    [-0.6762803392801253, 6.087714651680015, 16.43084320892478, 24.76722511418386, -6.594389125716872]
)
_SIGNATURE = (
    "int64(int64,int64,int64,int64,float64[::1],float64[::1],float64[::1],float64[:,::1],"
    "float64[::1],float64,float64[::1],float64[:,::1],int64[::1],int64,int64)"
)


@njit(_SIGNATURE, cache=True, error_model="numpy", nogil=True)
def rodas4(
    rates: int,
    rates_data: int,
    jacobian: int,
    jacobian_data: int,
    parameters: np.ndarray,
    state: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    grid: np.ndarray,
    rtol: float,
    atol: np.ndarray,
    out: np.ndarray,
    counts: np.ndarray,
    max_steps: int,
    dynamic: int,
) -> int:
    """Integrate segment by segment and write states and outputs on a grid.

    Args:
        rates, rates_data: address of the function (states, parameters, inputs) -> (rates, outputs).
        jacobian, jacobian_data: address of (states, parameters, inputs) -> (rates, d rates/d states by rows).
        parameters: constants of the run.
        state: start, overwritten with the end.
        times: segment limits, one more than segments, ascending; none may be skipped by a step.
        inputs: constants of each segment, shape (segments, inputs).
        grid: ascending times between the first and the last limit at which ``out`` is written.
        rtol, atol: error per step: weighted root mean square below 1; ``atol`` has one entry per state.
        out: shape (grid, states + outputs).
        counts: accepted and rejected steps, and the number of grid rows written, are put here.
        max_steps: give up after this many accepted and rejected steps.
        dynamic: how many leading states any rate depends on; the others are integrals of them, whose share of
            each linear system is a sum instead of an elimination.

    Returns:
        a `Status`.
    """
    n, width, fixed = state.shape[0], out.shape[1], parameters.shape[0]
    stage = np.zeros((6, n))
    trial, residual = np.zeros(n), np.zeros(n)
    dense = np.zeros((2, n))
    point = np.zeros(n)
    values = np.zeros(max(width, n))
    both = np.zeros(n + n * n)
    matrix = np.zeros((dynamic, dynamic))
    pivots = np.zeros(dynamic, np.int64)
    packed = np.empty(n + fixed + inputs.shape[1])
    packed[n : n + fixed] = parameters
    at_packed, at_values, at_both = packed.ctypes.data, values.ctypes.data, both.ctypes.data
    accepted = rejected = row = 0
    t = times[0]
    for segment in range(inputs.shape[0]):
        end = times[segment + 1]
        packed[n + fixed :] = inputs[segment]
        if not end > t:
            continue
        h = min(1e-4, end - t)
        fresh, last_failed = True, False
        while t < end:
            if accepted + rejected >= max_steps:
                counts[0], counts[1], counts[2] = accepted, rejected, row
                return 2
            last = t + 1.0000001 * h >= end
            if last:
                h = end - t
            if fresh:
                packed[:n] = state
                _call(jacobian, at_both, at_packed, jacobian_data)
                fresh = False
            for i in range(dynamic):
                for j in range(dynamic):
                    matrix[i, j] = -both[n + i * n + j]
                matrix[i, i] += 1.0 / (_GAMMA * h)
            solvable = _factorise(matrix, pivots)
            for k in range(6):
                for i in range(n):
                    if k == 0:
                        residual[i] = both[i]
                        continue
                    if k < 5:
                        total = state[i]
                        for j in range(k):
                            total += _A[k, j] * stage[j, i]
                        trial[i] = total
                    else:
                        trial[i] += stage[4, i]
                if k > 0:
                    packed[:n] = trial
                    _call(rates, at_values, at_packed, rates_data)
                    for i in range(n):
                        total = 0.0
                        for j in range(k):
                            total += _C[k, j] * stage[j, i]
                        residual[i] = values[i] + total / h
                _solve(matrix, pivots, residual)
                for i in range(dynamic, n):
                    total = residual[i]
                    for j in range(dynamic):
                        total += both[n + i * n + j] * residual[j]
                    residual[i] = _GAMMA * h * total
                stage[k] = residual
            error = 0.0
            for i in range(n):
                trial[i] += stage[5, i]
                scale = atol[i] + rtol * max(abs(state[i]), abs(trial[i]))
                error += (stage[5, i] / scale) ** 2
            error = np.sqrt(error / n)
            if not (solvable and error < 1e10):
                error = 1e10
            factor = min(6.0, max(0.2, 0.9 * error**-0.25)) if error > 0.0 else 6.0
            if error > 1.0:
                rejected += 1
                last_failed = True
                h *= factor
                if h < 1e-13 * max(1.0, abs(t)):
                    counts[0], counts[1], counts[2] = accepted, rejected, row
                    return 3 if error >= 1e10 else 1
                continue
            accepted += 1
            reached = end if last else t + h
            if row < grid.shape[0] and grid[row] <= reached:
                for i in range(n):
                    dense[0, i] = dense[1, i] = 0.0
                    for j in range(5):
                        dense[0, i] += _D2[j] * stage[j, i]
                        dense[1, i] += _D3[j] * stage[j, i]
                while row < grid.shape[0] and grid[row] <= reached:
                    s = (grid[row] - t) / h
                    for i in range(n):
                        bent = dense[0, i] + s * dense[1, i]
                        point[i] = state[i] * (1.0 - s) + s * (trial[i] + (1.0 - s) * bent)
                        out[row, i] = point[i]
                    if width > n:
                        packed[:n] = point
                        _call(rates, at_values, at_packed, rates_data)
                        out[row, n:] = values[n:width]
                    row += 1
            t = reached
            state[:] = trial
            h *= min(factor, 1.0) if last_failed else factor
            last_failed, fresh = False, True
    counts[0], counts[1], counts[2] = accepted, rejected, row
    return 0
