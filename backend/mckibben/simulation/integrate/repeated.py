"""A compiled function called many times without Python in between: for blocks of sets, and for roots."""

from __future__ import annotations

import numpy as np
from numba import njit

from mckibben.simulation.integrate import switching
from mckibben.simulation.integrate.stamp import kernel
from mckibben.simulation.integrate.switching import call


@kernel("void(int64,float64[:,:,::1],float64[:,:,::1])", switching)
def call_blocks(address: int, given: np.ndarray, results: np.ndarray) -> None:
    """Call the function at an address for each block of arguments.

    Args:
        given: arguments, shape (blocks, size, lanes); lanes = 1 for a function of single numbers.
        results: written, shape (blocks, width, lanes).
    """
    for block in range(given.shape[0]):
        call(address, results[block].ctypes.data, given[block].ctypes.data)


_MOST_TRIES = 200
_ROW, _TABLE = "float64[::1]", "float64[:,:,::1]"


@njit(error_model="numpy")
def _called(
    address: int, result: int, line: np.ndarray, places: np.ndarray, slopes: np.ndarray, offsets: np.ndarray,
    given: np.ndarray, results: np.ndarray, x: np.ndarray, values: np.ndarray,
) -> None:  # fmt: skip
    """Values of the function of `roots` at x, of one block."""
    for place in range(places.shape[0]):
        for lane in range(x.shape[0]):
            given[places[place], lane] = offsets[place, lane] + slopes[place] * x[lane]
    call(address, results.ctypes.data, given.ctypes.data)
    for lane in range(x.shape[0]):
        values[lane] = line[0] + line[1] * results[result, lane]


@kernel(
    f"void(int64,int64,{_ROW},int64[::1],{_ROW},{_TABLE},{_TABLE},{_TABLE},float64[:,::1],float64[:,::1],"
    "boolean[:,::1],float64)",
    switching,
)
def find_roots(
    address: int,
    result: int,
    line: np.ndarray,
    places: np.ndarray,
    slopes: np.ndarray,
    offsets: np.ndarray,
    given: np.ndarray,
    results: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    wanted: np.ndarray,
    narrow: float,
) -> None:
    """Roots of ``line[0] + line[1] * results[result]``, positive at ``low`` and not at ``high``.

    Regula falsi of the Illinois kind, set by set; a bracket that three tries do not halve is bisected.

    Args:
        address: of the function.
        result: number of the result that counts.
        line: see there.
        places, slopes, offsets: the arguments that follow x: argument ``places[i]`` is
            ``offsets[:, i] + slopes[i] * x``; ``offsets`` has the shape (blocks, places, lanes).
        given: arguments, shape (blocks, size, lanes); those of ``places`` are overwritten.
        results: room, shape (blocks, width, lanes).
        low, high: brackets, shape (blocks, lanes); ``low`` is overwritten with the roots.
        wanted: where a root is wanted; elsewhere ``low`` stays.
        narrow: width of a bracket that is narrow enough.
    """
    lanes = low.shape[1]
    at_low, at_high, value, x = np.empty(lanes), np.empty(lanes), np.empty(lanes), np.empty(lanes)
    side, width = np.empty(lanes), np.empty(lanes)
    for block in range(given.shape[0]):
        mine, found, shift = given[block], results[block], offsets[block]
        a, b, chosen = low[block], high[block], wanted[block]
        if not chosen.any():
            continue
        for lane in range(lanes):
            if not chosen[lane]:
                b[lane] = a[lane]
            side[lane], width[lane] = 0.0, b[lane] - a[lane]
        _called(address, result, line, places, slopes, shift, mine, found, a, at_low)
        _called(address, result, line, places, slopes, shift, mine, found, b, at_high)
        for attempt in range(_MOST_TRIES):
            searching = False
            for lane in range(lanes):
                x[lane] = a[lane]
                if not (chosen[lane] and b[lane] - a[lane] > narrow):
                    continue
                searching = True
                straight = (a[lane] * at_high[lane] - b[lane] * at_low[lane]) / (at_high[lane] - at_low[lane])
                slow = attempt % 4 == 3 and not b[lane] - a[lane] < 0.5 * width[lane]
                if attempt % 4 == 3:
                    width[lane] = b[lane] - a[lane]
                if straight > a[lane] and straight < b[lane] and not slow:
                    x[lane] = straight
                else:
                    x[lane] = 0.5 * (a[lane] + b[lane])
            if not searching:
                break
            _called(address, result, line, places, slopes, shift, mine, found, x, value)
            for lane in range(lanes):
                if not (chosen[lane] and b[lane] - a[lane] > narrow):
                    continue
                if value[lane] > 0.0:
                    if side[lane] == 1.0:
                        at_high[lane] *= 0.5
                    a[lane], at_low[lane], side[lane] = x[lane], value[lane], 1.0
                else:
                    if side[lane] == -1.0:
                        at_low[lane] *= 0.5
                    if value[lane] == 0.0:
                        a[lane] = x[lane]
                    b[lane], at_high[lane], side[lane] = x[lane], value[lane], -1.0
        # The end with the smaller value.
        _called(address, result, line, places, slopes, shift, mine, found, a, at_low)
        _called(address, result, line, places, slopes, shift, mine, found, b, at_high)
        for lane in range(lanes):
            if chosen[lane] and not abs(at_low[lane]) < abs(at_high[lane]):
                a[lane] = b[lane]
