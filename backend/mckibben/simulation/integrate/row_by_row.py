"""The way of a muscle that carries a load, row by row: the kernel of `mckibben.simulation.drive.isotonic`.

It holds no physics: balance and rates are compiled functions of the same arguments, which begin with the
inputs below. States go from row to row by steps of Rosenbrock's exponential Euler method with the diagonal of
their Jacobian, which is exact where a state is linear and apart from the others. None goes farther than its
value in an endless motion.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from mckibben.simulation.integrate import switching
from mckibben.simulation.integrate.stamp import kernel
from mckibben.simulation.integrate.switching import call

#: Arguments of the compiled functions: these, then the states, then constants.
INPUTS = ("length", "pressure", "velocity", "direction", "temperature", "pressure_rate", "load")
_LENGTH, _PRESSURE, _VELOCITY, _DIRECTION, _TEMPERATURE, _RATE, _LOAD, _STATES = range(8)
_PARTS = 2  # steps of the states from row to row
_STRAIGHT = 1e-6  # of a step times the Jacobian; below, the exponential is a line
_CLOSE = 2e-8  # m; from there one step of Newton's method is enough
_MOST_TRIES = 60
_BESIDE = 1e-7  # m; for the slope of the balance
_LEAST_STEP = 1e-8  # m
_FREE, _STUCK, _AT_LIMIT, _LOST = 0.0, 1.0, 2.0, 3.0  # of a row: what a small change does

_ROW, _TABLE = "float64[::1]", "float64[:,::1]"


@njit(error_model="numpy", inline="always")
def _followed(
    rates: int, given: np.ndarray, made: np.ndarray, states: np.ndarray, begin: np.ndarray, rows: np.ndarray,
    bounds: np.ndarray, k: int, step: float, before: float, length: float,
) -> None:  # fmt: skip
    """Put the states at row k into ``given``, for a way from the length before to a length."""
    count = states.shape[0]
    for i in range(count):
        given[_STATES + i] = states[i]
    given[_VELOCITY], given[_RATE] = 0.0, 0.0
    if step > 0.0:
        last, here = rows[k - 1, 0], rows[k, 0]
        given[_VELOCITY], given[_RATE] = (length - before) / step, (here - last) / step
        part = step / _PARTS
        for n in range(_PARTS):
            share = (n + 0.5) / _PARTS
            given[_LENGTH] = before + share * (length - before)
            given[_PRESSURE] = last + share * (here - last)
            call(rates, made.ctypes.data, given.ctypes.data)
            for i in range(count):
                rate, by_itself = made[i] * part, made[count + i] * part
                grown = (
                    np.expm1(by_itself) / by_itself if abs(by_itself) > _STRAIGHT else 1.0 + 0.5 * by_itself
                )
                moved = given[_STATES + i] + rate * grown
                given[_STATES + i] = min(max(moved, -bounds[i]), bounds[i])
    for i in range(count):
        if not np.isnan(begin[i]):
            given[_STATES + i] = begin[i]


@njit(error_model="numpy")
def _excess(
    balance: int, rates: int, given: np.ndarray, made: np.ndarray, states: np.ndarray, begin: np.ndarray,
    rows: np.ndarray, bounds: np.ndarray, k: int, step: float, before: float, length: float, way: float,
) -> float:  # fmt: skip
    """Force over the load at row k, for a way from the length before to a length."""
    given[_DIRECTION], given[_TEMPERATURE], given[_LOAD] = way, rows[k, 2], rows[k, 1]
    _followed(rates, given, made, states, begin, rows, bounds, k, step, before, length)
    given[_LENGTH], given[_PRESSURE] = length, rows[k, 0]
    call(balance, made.ctypes.data, given.ctypes.data)
    return made[0]


@njit(error_model="numpy")
def _carried(
    balance: int, rates: int, given: np.ndarray, made: np.ndarray, states: np.ndarray, begin: np.ndarray,
    rows: np.ndarray, bounds: np.ndarray, k: int, step: float, before: float, stiffness: float,
    limits: np.ndarray, found: np.ndarray,
) -> None:  # fmt: skip
    """Write length, way, slope of the excess and what a small change does at row k into ``found``."""
    low, high, farthest = limits[0], limits[1], limits[2]
    found[:] = before, 0.0, stiffness, _STUCK
    way, x = 1.0, before
    at_x = _excess(balance, rates, given, made, states, begin, rows, bounds, k, step, before, x, way)
    if not at_x < 0.0:
        way = -1.0
        if limits[4] > 0.0:  # the way matters
            at_x = _excess(balance, rates, given, made, states, begin, rows, bounds, k, step, before, x, way)
        if np.isnan(at_x):
            found[3] = _LOST
            return
        if not at_x > 0.0:
            return
    # The excess grows with the length: go against it until its sign changes, then between.
    stride = min(max(abs(at_x) / stiffness, _LEAST_STEP), farthest)
    other, at_other, bracketed, side = x, at_x, False, 0.0
    for attempt in range(_MOST_TRIES):
        if not bracketed:
            new = min(max(x + way * stride, low), high)
        elif attempt % 8 == 7:
            new = 0.5 * (x + other)
        else:
            new = (x * at_other - other * at_x) / (at_other - at_x)
        at_new = _excess(balance, rates, given, made, states, begin, rows, bounds, k, step, before, new, way)
        if np.isnan(at_new):
            found[3] = _LOST
            return
        if way * at_new < 0.0:
            if not bracketed and not low < new < high:
                found[0], found[1], found[3] = new, way, _AT_LIMIT
                return
            slope = (at_new - at_x) / (new - x)
            if bracketed and side == -1.0:
                at_other *= 0.5
            stride = 2.0 * stride
            if slope > 0.0:
                stride = min(max(1.1 * abs(at_new) / slope, _LEAST_STEP), 2.0 * stride)
            stride, side = min(stride, farthest), -1.0
            moved = abs(new - x)
            x, at_x = new, at_new
        else:
            slope = (at_new - at_x) / (new - x)
            if bracketed and side == 1.0:
                at_x *= 0.5
            side = 1.0 if bracketed else 0.0
            moved = abs(new - other) if bracketed else np.inf
            other, at_other, bracketed = new, at_new, True
        if abs(at_new) <= _CLOSE * abs(slope) or moved < _CLOSE or (bracketed and abs(other - x) < _CLOSE):
            break
    # One step of Newton's method from there, with the slope that the others need as well.
    beside = new + way * _BESIDE
    at_beside = _excess(
        balance, rates, given, made, states, begin, rows, bounds, k, step, before, beside, way
    )
    slope = (at_beside - at_new) / (beside - new)
    if slope > 0.0 and abs(at_new) < 10.0 * _CLOSE * slope:
        new -= at_new / slope
        if way * (new - before) < 0.0:
            new = before
    found[:] = new, way, slope, _FREE if slope > 0.0 else _AT_LIMIT


@kernel(
    f"void(int64,int64,{_TABLE},float64[:,:,::1],{_TABLE},{_ROW},{_TABLE},{_ROW},int64[::1],float64[:,:,::1],"
    f"{_ROW},{_TABLE},{_ROW})",
    switching,
)
def carry(
    balance: int,
    rates: int,
    constants: np.ndarray,
    rows: np.ndarray,
    states: np.ndarray,
    steps: np.ndarray,
    first: np.ndarray,
    limits: np.ndarray,
    places: np.ndarray,
    begins: np.ndarray,
    bounds: np.ndarray,
    lengths: np.ndarray,
    made: np.ndarray,
) -> None:
    """Lengths at which muscles carry their loads; all but the first differ little from it.

    The first one is solved row by row. Of the others one step of Newton's method is taken with its slope.

    Args:
        balance: address of the function whose results are the force over the load and the length shown.
        rates: address of the function whose results are the rates of the states, and the diagonal of their
            Jacobian.
        constants: of each muscle, shape (muscles, constants).
        rows: pressure, load and temperature, shape (muscles, rows, 3).
        states: overwritten; at first of any values, shape (muscles, states).
        steps: time since the row before; 0 at the first row of a record, shape (rows,).
        first: length before the first row of each record; elsewhere ignored, shape (muscles, rows).
        limits: shortest and longest length, longest step of a search, a usual stiffness, whether the balance
            depends on the way alone, as dry friction does, and whether the length shown is another one.
        places: of each row the number of its begin, -1 for none, shape (rows,).
        begins: states that begin anew, NaN for those that go on, shape (muscles, begins, states).
        bounds: largest magnitude of each state, shape (states,).
        lengths: written, shape (muscles, rows).
        made: room for results.
    """
    muscles, count = constants.shape[0], states.shape[1]
    filled = np.empty((muscles, _STATES + count + constants.shape[1]))
    filled[:, _STATES + count :] = constants
    on, found, before = np.full(count, np.nan), np.empty(4), np.zeros(muscles)
    stiffness = limits[3]
    for k in range(rows.shape[1]):
        if steps[k] == 0.0:
            before[:] = first[:, k]
        last = before[0]
        for m in range(muscles):
            given = filled[m]
            begin = on if places[k] < 0 else begins[m, places[k]]
            if m == 0:
                _carried(balance, rates, given, made, states[0], begin, rows[0], bounds, k, steps[k], last,
                         stiffness, limits, found)  # fmt: skip
                if found[3] == _LOST:
                    lengths[:, k:] = np.nan
                    return
                length = found[0]
                if found[3] == _FREE:
                    stiffness = found[2]
            elif found[3] == _STUCK:
                length = before[m]
            elif found[3] == _AT_LIMIT:
                length = found[0]
            else:
                length = found[0] + before[m] - last
                length -= _excess(balance, rates, given, made, states[m], begin, rows[m], bounds, k, steps[k],
                                  before[m], length, found[1]) / found[2]  # fmt: skip
            given[_DIRECTION], given[_TEMPERATURE], given[_LOAD] = found[1], rows[m, k, 2], rows[m, k, 1]
            _followed(rates, given, made, states[m], begin, rows[m], bounds, k, steps[k], before[m], length)
            for i in range(count):
                states[m, i] = given[_STATES + i]
            before[m], lengths[m, k] = length, length
            if limits[5] > 0.0:  # something is stretched beside the muscle
                given[_LENGTH], given[_PRESSURE] = length, rows[m, k, 0]
                call(balance, made.ctypes.data, given.ctypes.data)
                lengths[m, k] = made[1]
