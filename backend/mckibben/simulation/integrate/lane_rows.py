"""Rows of the lanes: states as soon as a step has passed them, outputs when many have been written.

For the outputs the lanes are rows of one set. All arrays are given by one table of addresses and sizes: as
arguments they would cost more than the work.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numba.np.numpy_support import carray

from mckibben.simulation.integrate.borrowed import pointer_at
from mckibben.simulation.integrate.lane_control import CONTROL_ROWS, INSTANT, NEXT_ROW, REACHED, STEP
from mckibben.simulation.integrate.lane_step import write_column, write_dense
from mckibben.simulation.integrate.lane_type import (
    LANES,
    first_bit,
    load,
    load_any,
    positive_bits,
    splat,
    store,
    store_any,
)
from mckibben.simulation.integrate.switching import call

#: Rows after which the outputs are computed: until then their states stay in the cache.
WINDOW = 128
# Whole numbers of a lane: its set, segment and next row; next row without outputs, and a segment before it.
OWNER, SEGMENT, ROW, DONE, PIECE = range(5)
NUMBERS = 5

# Entries of the table: sizes.
(
    STATES, CONSTANTS, INPUTS, SEGMENTS, CLOCK, KEPT, KEPT_SWITCHES, OUTPUTS, COLUMNS, ROOM, SCRATCH_COLUMNS,
    FIRST_SWITCH,
) = range(12)  # fmt: skip
# Addresses.
(
    AT_CONTROL, AT_NUMBERS, AT_STATE, AT_TRIAL, AT_STAGES, AT_DENSE, AT_VALUES, AT_ROW_PACKED, AT_PACKED,
    AT_SCRATCH, AT_OUT, AT_KEPT, AT_COLUMN_OF, AT_KEPT_SWITCHES, AT_OUTPUT_COLUMNS, AT_FUNCTION,
) = range(12, 28)  # fmt: skip
# Addresses of what may be common to all sets, and the bytes from one set to the next.
AT_GRIDS, GRID_STEP, AT_TIMES, TIMES_STEP, AT_INPUTS, INPUTS_STEP, AT_CONSTANTS, CONSTANTS_STEP = range(
    28, 36
)


@njit(inline="always")
def _reals(address: int, size: int) -> Any:
    return carray(pointer_at(address), (size,), np.float64)


@njit(inline="always")
def _integers(address: int, size: int) -> Any:
    return carray(pointer_at(address), (size,), np.int64)


@njit(inline="always")
def _by_lane(address: int, rows: int) -> Any:
    return carray(pointer_at(address), (rows, LANES), np.float64)


@njit(inline="always")
def _kept_column(table: np.ndarray, q: int, lane: int, column: int, c: int) -> int:
    """Address of the rows of the kept state c: its column of ``out``, else of the scratch."""
    room = 8 * table[ROOM]
    if column >= 0:
        return table[AT_OUT] + room * (q * table[COLUMNS] + column)
    return table[AT_SCRATCH] + room * (lane * table[SCRATCH_COLUMNS] + c)


@njit(error_model="numpy")
def write_rows(crossing: int, table: np.ndarray) -> None:
    """Write the rows in the accepted steps of some lanes."""
    n, count, switches = table[STATES], table[KEPT], table[KEPT_SWITCHES]
    kept, column_of = _integers(table[AT_KEPT], count), _integers(table[AT_COLUMN_OF], count)
    kept_switches = _integers(table[AT_KEPT_SWITCHES], switches)
    control = _by_lane(table[AT_CONTROL], CONTROL_ROWS)
    numbers = carray(pointer_at(table[AT_NUMBERS]), (NUMBERS, LANES), np.int64)
    packed, dense = _by_lane(table[AT_PACKED], table[FIRST_SWITCH] + 1), _by_lane(table[AT_DENSE], 4 * count)
    write_dense(kept, table[AT_STATE], table[AT_TRIAL], table[AT_STAGES], table[AT_DENSE], n)
    for lane in range(LANES):
        if not (crossing >> lane) & 1:
            continue
        q, first, reached = numbers[OWNER, lane], numbers[ROW, lane], splat(control[REACHED, lane])
        at_grid = table[AT_GRIDS] + q * table[GRID_STEP]
        stop, beyond = first, 0
        while not beyond:  # the grid ends with infinity
            beyond = positive_bits(load_any(at_grid + 8 * stop) - reached)
            stop += first_bit(beyond) if beyond else LANES
        numbers[ROW, lane] = stop
        control[NEXT_ROW, lane] = _reals(at_grid + 8 * stop, 1)[0]
        t, over = control[INSTANT, lane], 1.0 / control[STEP, lane]
        for c in range(count):
            at_column = _kept_column(table, q, lane, column_of[c], c)
            write_column(dense, c, lane, at_grid, at_column, t, over, first, stop)
        for c in range(switches):
            value = splat(packed[table[FIRST_SWITCH] + kept_switches[c], lane])
            at_column = _kept_column(table, q, lane, -1, count + c)
            for row in range(first, stop, LANES):
                store_any(at_column + 8 * row, value)
        if stop - numbers[DONE, lane] >= WINDOW:
            write_outputs(lane, stop - stop % LANES, table)


@njit(error_model="numpy")
def write_outputs(lane: int, end: int, table: np.ndarray) -> None:
    """Compute the outputs of the rows of a lane before ``end`` that have none yet."""
    numbers = carray(pointer_at(table[AT_NUMBERS]), (NUMBERS, LANES), np.int64)
    q, begin, piece = numbers[OWNER, lane], numbers[DONE, lane], numbers[PIECE, lane]
    numbers[DONE, lane] = end
    n, fixed, many, segments = table[STATES], table[CONSTANTS], table[INPUTS], table[SEGMENTS]
    count, switches, clock, wanted = table[KEPT], table[KEPT_SWITCHES], table[CLOCK], table[OUTPUTS]
    kept, column_of = _integers(table[AT_KEPT], count), _integers(table[AT_COLUMN_OF], count)
    at_grid = table[AT_GRIDS] + q * table[GRID_STEP]
    grid = _reals(at_grid, end)
    for c in range(count):
        if kept[c] == clock and column_of[c] >= 0:
            column = _reals(_kept_column(table, q, lane, column_of[c], c), end)
            for row in range(begin, end):
                column[row] = grid[row]
    if wanted == 0:
        return
    kept_switches = _integers(table[AT_KEPT_SWITCHES], switches)
    output_columns = _integers(table[AT_OUTPUT_COLUMNS], wanted)
    times = _reals(table[AT_TIMES] + q * table[TIMES_STEP], segments + 1)
    inputs = _reals(table[AT_INPUTS] + q * table[INPUTS_STEP], segments * many)
    constants = _reals(table[AT_CONSTANTS] + q * table[CONSTANTS_STEP], fixed)
    at_packed, at_values = table[AT_ROW_PACKED], table[AT_VALUES]
    packed = _by_lane(at_packed, n + fixed + many)
    for i in range(fixed):
        store(at_packed, n + i, splat(constants[i]))
    filled = -1
    for row in range(begin, end, LANES):
        # A row at a limit belongs to the segment that ends there, as in the step.
        while piece < segments - 1 and grid[row] > times[piece + 1]:
            piece += 1
        final = min(row + LANES, end) - 1
        if piece < segments - 1 and grid[final] > times[piece + 1]:
            at = piece
            for other in range(LANES):
                while at < segments - 1 and grid[min(row + other, final)] > times[at + 1]:
                    at += 1
                for i in range(many):
                    packed[n + fixed + i, other] = inputs[at * many + i]
            filled = -1
        elif filled != piece:
            for i in range(many):
                store(at_packed, n + fixed + i, splat(inputs[piece * many + i]))
            filled = piece
        for c in range(count):
            store(at_packed, kept[c], load_any(_kept_column(table, q, lane, column_of[c], c) + 8 * row))
        store(at_packed, clock, load_any(at_grid + 8 * row))
        for c in range(switches):
            at_column = _kept_column(table, q, lane, -1, count + c)
            store(at_packed, table[FIRST_SWITCH] + kept_switches[c], load_any(at_column + 8 * row))
        call(table[AT_FUNCTION], at_values, at_packed)
        for c in range(wanted):
            store_any(_kept_column(table, q, lane, output_columns[c], 0) + 8 * row, load(at_values, c))
    numbers[PIECE, lane] = piece
