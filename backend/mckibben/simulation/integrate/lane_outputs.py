"""Outputs of the rows of a run, computed when many have been written: there the lanes are rows."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.integrate.lane_type import LANES, load, load_any, splat, store, store_any
from mckibben.simulation.integrate.switching import call

#: Rows after which the outputs are computed: until then their states stay in the cache.
WINDOW = 128


@njit(error_model="numpy")
def write_outputs(
    lane: int,
    outputs: int,
    clock: int,
    span: tuple[int, int],
    piece: int,
    constants: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    grid: np.ndarray,
    columns: Any,
    out: np.ndarray,
    scratch: np.ndarray,
    packed: np.ndarray,
    room: Any,
) -> int:
    """Compute the outputs of rows ``span`` of the set that runs in a lane; returns the segment of the last.

    Args:
        span: first row, a multiple of LANES, and last + 1.
        piece: a segment not after the first row.
        columns, scratch, room: see `mckibben.simulation.integrate.lane_kernel.rodas4_lanes`.
        out: of the set.
        packed: arguments of the outputs, LANES rows of the run side by side.
    """
    kept, column_of, kept_switches, output_columns = columns
    state, _, _, _, _, values, _ = room
    n, fixed, segments = state.shape[0], constants.shape[0], inputs.shape[0]
    begin, end = span
    for c in range(kept.shape[0]):
        if kept[c] == clock and column_of[c] >= 0:
            for row in range(begin, end):
                out[column_of[c], row] = grid[row]
    if outputs == 0:
        return piece
    first_switch = n + fixed + inputs.shape[1]
    at_packed, at_grid, at_values = packed.ctypes.data, grid.ctypes.data, values.ctypes.data
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
                for i in range(inputs.shape[1]):
                    packed[n + fixed + i, other] = inputs[at, i]
            filled = -1
        elif filled != piece:
            for i in range(inputs.shape[1]):
                store(at_packed, n + fixed + i, splat(inputs[piece, i]))
            filled = piece
        for c in range(kept.shape[0]):
            column = out[column_of[c]] if column_of[c] >= 0 else scratch[lane, c]
            store(at_packed, kept[c], load_any(column.ctypes.data + 8 * row))
        store(at_packed, clock, load_any(at_grid + 8 * row))
        for c in range(kept_switches.shape[0]):
            column = scratch[lane, kept.shape[0] + c]
            store(at_packed, first_switch + kept_switches[c], load_any(column.ctypes.data + 8 * row))
        call(outputs, at_values, at_packed)
        for c in range(output_columns.shape[0]):
            store_any(out[output_columns[c]].ctypes.data + 8 * row, load(at_values, c))
    return piece
