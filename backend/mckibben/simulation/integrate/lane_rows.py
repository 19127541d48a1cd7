"""Rows of the lanes: collected in a window, then completed with outputs and written.

For the outputs the lanes are rows of one set. The windows of all lanes stay in the cache. All arrays
are given by one table of addresses and sizes: as arguments they would cost more than the work.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numba.np.numpy_support import carray

from mckibben.simulation.integrate.borrowed import pointer_at
from mckibben.simulation.integrate.lane_control import CONTROL_ROWS, INSTANT, INVERSE, NEXT_ROW, REACHED
from mckibben.simulation.integrate.lane_step import row_of, write_dense
from mckibben.simulation.integrate.lane_type import (
    LANES,
    first_bit,
    load,
    load_any,
    positive_bits,
    splat,
    store,
    store_any,
    stream,
)
from mckibben.simulation.integrate.switching import call

WINDOW = 64  # rows
_COLUMN = 8 * (WINDOW + LANES)  # bytes of a column in a window
# Whole numbers of a lane: its set, segment and next row; first row of its window, and a segment before it.
OWNER, SEGMENT, ROW, DONE, PIECE = range(5)
NUMBERS = 5

# Entries of the table: sizes.
(
    STATES, CONSTANTS, INPUTS, SEGMENTS, CLOCK, KEPT, KEPT_SWITCHES, OUTPUTS, COLUMNS, ROOM, FIRST_SWITCH,
) = range(11)  # fmt: skip
# Addresses.
(
    AT_CONTROL, AT_NUMBERS, AT_STATE, AT_TRIAL, AT_STAGES, AT_DENSE, AT_VALUES, AT_ROW_PACKED, AT_PACKED,
    AT_WINDOWS, AT_OUT, AT_KEPT, AT_COLUMN_OF, AT_KEPT_SWITCHES, AT_OUTPUT_COLUMNS, AT_FUNCTION,
) = range(11, 27)  # fmt: skip
# Addresses of what may be common to all sets, and the bytes from one set to the next.
(
    AT_GRIDS, GRID_STEP, AT_TIMES, TIMES_STEP, AT_INPUTS, INPUTS_STEP, AT_CONSTANTS, CONSTANTS_STEP,
) = range(27, 35)  # fmt: skip
ENTRIES = 35


@njit(inline="always")
def _reals(address: int, size: int) -> Any:
    return carray(pointer_at(address), (size,), np.float64)


@njit(inline="always")
def _integers(address: int, size: int) -> Any:
    return carray(pointer_at(address), (size,), np.int64)


@njit(inline="always")
def _by_lane(address: int, rows: int) -> Any:
    return carray(pointer_at(address), (rows, LANES), np.float64)


@njit(error_model="numpy")
def write_rows(crossing: int, table: np.ndarray) -> None:
    """Write the rows in the accepted steps of some lanes."""
    count, switches, first_switch = table[KEPT], table[KEPT_SWITCHES], table[FIRST_SWITCH]
    kept, kept_switches = _integers(table[AT_KEPT], count), _integers(table[AT_KEPT_SWITCHES], switches)
    control, dense = _by_lane(table[AT_CONTROL], CONTROL_ROWS), _by_lane(table[AT_DENSE], 4 * count)
    numbers = carray(pointer_at(table[AT_NUMBERS]), (NUMBERS, LANES), np.int64)
    packed = _by_lane(table[AT_PACKED], first_switch + 1)
    write_dense(kept, table[AT_STATE], table[AT_TRIAL], table[AT_STAGES], table[AT_DENSE], table[STATES])
    for lane in range(LANES):
        if not (crossing >> lane) & 1:
            continue
        at_grid = table[AT_GRIDS] + numbers[OWNER, lane] * table[GRID_STEP]
        at_window = table[AT_WINDOWS] + _COLUMN * lane * (count + switches)
        reached, t, over = control[REACHED, lane], control[INSTANT, lane], control[INVERSE, lane]
        finished = False
        while not finished:
            first = numbers[ROW, lane] - numbers[DONE, lane]
            # Of the last block the rows behind the step are written again later.
            place, beyond = first, 0
            at_instants = at_grid + 8 * numbers[DONE, lane]
            while beyond == 0 and place < WINDOW:  # the grid ends with infinity
                at, instants = at_window + 8 * place, load_any(at_instants + 8 * place)
                s = (instants - t) * over
                for c in range(count):
                    store_any(at, row_of(dense, c, lane, s))
                    at += _COLUMN
                for c in range(switches):
                    store_any(at, splat(packed[first_switch + kept_switches[c], lane]))
                    at += _COLUMN
                beyond = positive_bits(instants - reached)
                place += first_bit(beyond) if beyond else LANES
            finished = beyond != 0 and place <= WINDOW
            numbers[ROW, lane] = numbers[DONE, lane] + min(place, WINDOW)
            if place >= WINDOW:
                complete(lane, table)
        control[NEXT_ROW, lane] = _reals(at_grid + 8 * numbers[ROW, lane], 1)[0]


@njit(error_model="numpy")
def complete(lane: int, table: np.ndarray) -> None:
    """Compute the outputs of the rows in the window of a lane, write all that is wanted, empty the window."""
    numbers = carray(pointer_at(table[AT_NUMBERS]), (NUMBERS, LANES), np.int64)
    q, done, piece = numbers[OWNER, lane], numbers[DONE, lane], numbers[PIECE, lane]
    rows = numbers[ROW, lane] - done
    numbers[DONE, lane] = numbers[ROW, lane]
    n, fixed, many, segments = table[STATES], table[CONSTANTS], table[INPUTS], table[SEGMENTS]
    count, switches, clock, wanted = table[KEPT], table[KEPT_SWITCHES], table[CLOCK], table[OUTPUTS]
    kept, column_of = _integers(table[AT_KEPT], count), _integers(table[AT_COLUMN_OF], count)
    at_grid = table[AT_GRIDS] + q * table[GRID_STEP] + 8 * done
    column = 8 * table[ROOM]
    at_window = table[AT_WINDOWS] + _COLUMN * lane * (count + switches)
    at_out = table[AT_OUT] + column * table[COLUMNS] * q + 8 * done
    for c in range(count):
        if column_of[c] < 0:
            continue
        at_from, at_to = at_window + _COLUMN * c, at_out + column * column_of[c]
        if kept[c] == clock:
            at_from = at_grid
        for row in range(0, rows, LANES):
            stream(at_to + 8 * row, load_any(at_from + 8 * row))
    if wanted == 0:
        return
    grid, kept_switches = _reals(at_grid, rows), _integers(table[AT_KEPT_SWITCHES], switches)
    output_columns = _integers(table[AT_OUTPUT_COLUMNS], wanted)
    times = _reals(table[AT_TIMES] + q * table[TIMES_STEP], segments + 1)
    inputs = _reals(table[AT_INPUTS] + q * table[INPUTS_STEP], segments * many)
    constants = _reals(table[AT_CONSTANTS] + q * table[CONSTANTS_STEP], fixed)
    at_packed, at_values, first_switch = table[AT_ROW_PACKED], table[AT_VALUES], table[FIRST_SWITCH]
    packed = _by_lane(at_packed, n + fixed + many)
    for i in range(fixed):
        store(at_packed, n + i, splat(constants[i]))
    filled = -1
    for row in range(0, rows, LANES):
        # A row at a limit belongs to the segment that ends there, as in the step.
        while piece < segments - 1 and grid[row] > times[piece + 1]:
            piece += 1
        final = min(row + LANES, rows) - 1
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
        at_from = at_window + 8 * row
        for c in range(count):
            store(at_packed, kept[c], load_any(at_from))
            at_from += _COLUMN
        store(at_packed, clock, load_any(at_grid + 8 * row))
        for c in range(switches):
            store(at_packed, first_switch + kept_switches[c], load_any(at_from))
            at_from += _COLUMN
        call(table[AT_FUNCTION], at_values + 8 * row * wanted, at_packed)
    # Column by column: memory takes neighbours faster.
    for c in range(wanted):
        at_to = at_out + column * output_columns[c]
        for row in range(0, rows, LANES):
            stream(at_to + 8 * row, load(at_values + 8 * row * wanted, c))
    numbers[PIECE, lane] = piece
