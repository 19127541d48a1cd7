"""Rodas4 for many parameter sets: every lane runs a set of its own and takes the next one when it has ended.

Lanes share nothing but the instructions: each has its own instant, step, segment, switches and error. The
logic of a lane is that of `mckibben.simulation.integrate.rodas.advance`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.integrate import (
    coefficients,
    lane_outputs,
    lane_step,
    lane_type,
    lane_writer,
    switching,
)
from mckibben.simulation.integrate.lane_outputs import finish
from mckibben.simulation.integrate.lane_step import (
    ACCEPTED,
    ERROR,
    FACTOR,
    FLAG,
    HOPELESS,
    INSTANT,
    STEP,
    attempt,
    factor_of,
    write_column,
    write_dense,
)
from mckibben.simulation.integrate.lane_type import LANES, load, splat, store, where_positive
from mckibben.simulation.integrate.stamp import stamped_with
from mckibben.simulation.integrate.switching import call, change_switch, first_event

_LEAST_STEP = 1e-13  # of a step, as a share of the instant or of 1 s
# Numbers of a lane: rows of ``whole numbers`` and of ``reals``.
_OWNER, _SEGMENT, _ROW, _LAST, _FAILED, _LANDING, _CUT, _FRESH, _OVER = range(9)
_WHOLE = 9
_H, _END, _WANTED, _REACHED, _SHARE, _UNCUT = range(6)
_REALS = 6
_stamped = stamped_with(coefficients, switching, lane_type, lane_writer, lane_step, lane_outputs, also=LANES)


@njit(error_model="numpy")
def _change(
    k: int, lane: int, q: int, t: float, functions: Any, moved: tuple[int, int], switching_: Any, stops: np.ndarray,
    rates: np.ndarray, packed: np.ndarray, state: np.ndarray, own: np.ndarray, of_lane: Any, events: np.ndarray,
    counts: np.ndarray,
) -> None:  # fmt: skip
    """Change switch k of a lane; ``rates`` (rows of lanes) are those before."""
    least, bounce, follows = switching_
    start, end, _, guarded, switches = of_lane
    n, kinds = state.shape[0], switches.shape[0]
    first = packed.shape[0] - kinds
    for i in range(n):
        start[i], end[i] = state[i, lane], rates[i, lane]
    for i in range(kinds):
        switches[i] = packed[first + i, lane]
    change_switch(
        k, t, end, functions[5], moved, (least, stops[q], bounce, follows), own[lane], guarded, start, switches,
        events[q], counts[q],
    )  # fmt: skip
    for i in range(n):
        state[i, lane] = start[i]
    for i in range(kinds):
        packed[first + i, lane] = own[lane, first + i] = switches[i]


@njit(error_model="numpy")
def _event(
    lane: int, q: int, t: float, h: float, functions: Any, moved: tuple[int, int], switching_: Any,
    stops: np.ndarray, clock: int, ends: np.ndarray, first_guard: int, packed: np.ndarray, room: Any,
    own: np.ndarray, of_lane: Any,
) -> tuple[float, int]:  # fmt: skip
    """`first_event` of a lane."""
    least, bounce, follows = switching_
    state, trial, u, _, _, _, _ = room
    start, end, stages, guarded, switches = of_lane
    n, kinds = state.shape[0], switches.shape[0]
    first = packed.shape[0] - kinds
    for i in range(n):
        start[i], end[i] = state[i, lane], trial[i, lane]
        for j in range(6):
            stages[i, j] = u[6 * i + j, lane]
    for i in range(kinds):
        switches[i] = packed[first + i, lane]
    # `first_event` wants the guards in one array.
    column = np.empty(kinds)
    for i in range(kinds):
        column[i] = ends[first_guard + i, lane]
    return first_event(
        functions[5], t, h, column, 0, switches, moved, (least, stops[q], bounce, follows), clock, own[lane],
        guarded, start, end, stages,
    )  # fmt: skip


@njit(error_model="numpy")
def _enter(
    lane: int, q: int, clock: int, n: int, inputs: np.ndarray, times: np.ndarray, fixed: int, whole_numbers: np.ndarray,
    reals: np.ndarray, packed: np.ndarray, own: np.ndarray, state: np.ndarray, control: np.ndarray,
) -> None:  # fmt: skip
    """Begin the segment of a lane."""
    segment = whole_numbers[_SEGMENT, lane]
    given, limits = inputs[q % inputs.shape[0], segment], times[q % times.shape[0]]
    for i in range(given.shape[0]):
        packed[n + fixed + i, lane] = own[lane, n + fixed + i] = given[i]
    control[INSTANT, lane] = state[clock, lane] = limits[segment]
    reals[_END, lane] = limits[segment + 1]
    whole_numbers[_FRESH, lane] = 1


@njit(error_model="numpy")
def _begin(
    lane: int, q: int, constants: np.ndarray, starts: np.ndarray, switches: np.ndarray, first_step: float,
    whole_numbers: np.ndarray, reals: np.ndarray, packed: np.ndarray, own: np.ndarray, state: np.ndarray,
) -> None:  # fmt: skip
    """Give a lane a set."""
    n, first = state.shape[0], packed.shape[0] - switches.shape[1]
    for i in range(n):
        state[i, lane] = starts[q, i]
    for i in range(constants.shape[1]):
        packed[n + i, lane] = own[lane, n + i] = constants[q, i]
    for i in range(switches.shape[1]):
        packed[first + i, lane] = own[lane, first + i] = switches[q, i]
    whole_numbers[:, lane] = 0
    whole_numbers[_OWNER, lane], whole_numbers[_LANDING, lane] = q, -1
    reals[_H, lane] = first_step


_ROWS = "float64[:,::1]"
_TABLE = "float64[:,:,::1]"
_SIGNATURE = (
    "void(UniTuple(int64,6),uint64[::1],int64,int64,int64,UniTuple(int64,2),UniTuple(float64[::1],3),"
    f"{_ROWS},{_ROWS},{_ROWS},{_ROWS},{_ROWS},{_TABLE},float64,{_ROWS},int64,float64,float64[::1],"
    f"UniTuple(int64[::1],4),{_TABLE},{_ROWS},{_TABLE},int64[:,::1],int64[::1],int64,boolean,"
    f"Tuple((UniTuple({_ROWS},7),UniTuple({_ROWS},2),{_ROWS},{_ROWS},{_ROWS},{_ROWS},{_TABLE},"
    f"Tuple((float64[::1],float64[::1],{_ROWS},float64[::1],float64[::1])))))"
)


@njit(_SIGNATURE, error_model="numpy", cache=True, nogil=True)
@_stamped
def rodas4_lanes(
    functions: tuple[int, int, int, int, int, int],
    timed: np.ndarray,
    entries: int,
    positions: int,
    clock: int,
    moved: tuple[int, int],
    switching_: Any,
    stops: np.ndarray,
    constants: np.ndarray,
    starts: np.ndarray,
    switches: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    first_step: float,
    grids: np.ndarray,
    rows: int,
    rtol: float,
    atol: np.ndarray,
    columns: Any,
    out: np.ndarray,
    ends: np.ndarray,
    events: np.ndarray,
    counts: np.ndarray,
    statuses: np.ndarray,
    max_steps: int,
    together: bool,
    arrays: Any,
) -> None:
    """Run the sets; arrays of several sets have them first, those marked * may have a single one for all.

    Args:
        functions: addresses of ``rates``, ``jacobian``, ``factorise``, ``solve`` and ``outputs`` (0: none) on
            rows of lanes, and of ``guards`` of one set.
        timed, entries, positions, clock, moved: see `mckibben.simulation.integrate.kernels.rodas4`.
        switching_: least guards; restitution, slowest rebound and stiffness; lengths that follow.
        stops: stroke of the end stop of each switch.
        constants, starts: of each set.
        switches: at the start, overwritten with the end.
        times*, inputs*: segment boundaries and inputs, shapes (sets, segments + 1), (sets, segments, inputs).
        grids*: instants of the rows, longer than ``rows`` by at least LANES - 1.
        columns: states to be kept; the column of each in ``out`` or -1; switches to be kept; columns of the
            outputs.
        out: shape (sets, columns, at least rows + LANES - 1).
        ends: states at the end.
        events, counts: of each set, see `rodas4`.
        statuses: of each set, see `mckibben.simulation.integrate.kernels.Status`.
        max_steps: of a set.
        together: the sets run in groups of LANES; those of a group take all steps together.
        arrays: room for the step, twice the Jacobian, arguments, arguments of rows, dense output, arguments
            by lane, rows of lanes by lane, and what `first_event` needs of a lane.
    """
    room, jacobians, packed, row_packed, dense, own, scratch, of_lane = arrays
    state, trial, _, _, _, _, control = room
    whole, following = jacobians
    least, _, _ = switching_
    kept, column_of, kept_switches, _ = columns
    n, fixed, kinds, sets = state.shape[0], constants.shape[1], switches.shape[1], starts.shape[0]
    segments, first_guard = inputs.shape[1], n + entries + timed.shape[0]
    first_switch = packed.shape[0] - kinds
    at_state, at_trial, at_packed = state.ctypes.data, trial.ctypes.data, packed.ctypes.data
    at_control = control.ctypes.data
    ints, reals = np.zeros((_WHOLE, LANES), np.int64), np.zeros((_REALS, LANES))
    ints[_OWNER] = -1
    upcoming = active = 0
    one = splat(1.0)
    for lane in range(LANES):
        # Idle lanes need sound numbers as well.
        q = min(upcoming, sets - 1)
        _begin(lane, q, constants, starts, switches, first_step, ints, reals, packed, own, state)
        _enter(lane, q, clock, n, inputs, times, fixed, ints, reals, packed, own, state, control)
        control[STEP, lane] = first_step
        if upcoming < sets:
            upcoming += 1
            active += 1
        else:
            ints[_OWNER, lane], ints[_FRESH, lane] = -1, 0
    while active > 0:
        waiting = 0
        for lane in range(LANES):
            waiting += ints[_FRESH, lane]
        tries = 0
        while waiting > 0:
            # Inputs or switches have changed: a guard may be violated at once.
            for i in range(n):
                store(at_packed, i, load(at_state, i))
            call(functions[1], following.ctypes.data, at_packed)
            waiting = 0
            for lane in range(LANES):
                if ints[_FRESH, lane] == 0:
                    continue
                wrong = -1
                for k in range(kinds if tries < 2 * kinds + 1 else 0):
                    if following[first_guard + k, lane] < -least[k]:
                        wrong = k
                        break
                if wrong >= 0:
                    _change(
                        wrong, lane, ints[_OWNER, lane], control[INSTANT, lane], functions, moved, switching_, stops,
                        following, packed, state, own, of_lane, events, counts,
                    )  # fmt: skip
                    waiting += 1
                else:
                    for i in range(whole.shape[0]):
                        whole[i, lane] = following[i, lane]
                    ints[_FRESH, lane] = 0
            tries += 1
        for lane in range(LANES):
            if ints[_OWNER, lane] >= 0:
                t, h, end = control[INSTANT, lane], reals[_H, lane], reals[_END, lane]
                reals[_WANTED, lane] = h
                last = t + 1.0000001 * h >= end
                ints[_LAST, lane] = last
                control[STEP, lane] = end - t if last else h
                reals[_REACHED, lane] = end if last else t + control[STEP, lane]
        attempt(functions, timed, entries, positions, clock, rtol, atol, whole, packed, room)
        worst = 0.0
        if together:
            for lane in range(LANES):
                if ints[_OWNER, lane] >= 0:
                    worst = max(worst, control[ERROR, lane])
            store(at_control, FACTOR, factor_of(splat(worst)))
        tried = 0
        for lane in range(LANES):
            q = ints[_OWNER, lane]
            control[ACCEPTED, lane] = 0.0
            if q < 0:
                continue
            mine = control[ERROR, lane]
            squared = worst if together else mine
            if squared > 1.0:
                counts[q, 1] += 1
                ints[_FAILED, lane], ints[_LANDING, lane], ints[_CUT, lane] = 1, -1, 0
                h = reals[_H, lane] = control[STEP, lane] * control[FACTOR, lane]
                if h < _LEAST_STEP * max(1.0, abs(control[INSTANT, lane])):
                    if mine > 1.0:
                        statuses[q] = 3 if mine >= HOPELESS else 1
                    else:  # another of the group has failed
                        reals[_H, lane] = first_step
                if statuses[q] == 0 and counts[q, 0] + counts[q, 1] >= max_steps:
                    statuses[q] = 2
                ints[_OVER, lane] = statuses[q] != 0
            else:
                control[ACCEPTED, lane] = 1.0
                trial[clock, lane] = packed[clock, lane] = reals[_REACHED, lane]
                tried += 1
        if tried > 0:
            call(functions[1], following.ctypes.data, at_packed)
            flag = splat(0.0)
            for k in range(kinds):
                low = splat(-least[k]) - load(following.ctypes.data, first_guard + k)
                flag = where_positive(low, one, flag)
            if moved[1] >= 0:
                turned = splat(0.0) - load(at_state, moved[1]) * load(at_trial, moved[1])
                flag = where_positive(turned, one, flag)
            store(at_control, FLAG, flag)
            share = 2.0
            for lane in range(LANES):
                reals[_SHARE, lane] = 2.0
                if control[ACCEPTED, lane] == 0.0 or control[FLAG, lane] == 0.0 or ints[_LANDING, lane] >= 0:
                    continue
                reals[_SHARE, lane], ints[_LANDING, lane] = _event(
                    lane, ints[_OWNER, lane], control[INSTANT, lane], control[STEP, lane], functions, moved,
                    switching_, stops, clock, following, first_guard, packed, room, own, of_lane,
                )  # fmt: skip
                share = min(share, reals[_SHARE, lane])
            if share < 2.0:
                for lane in range(LANES):
                    q = ints[_OWNER, lane]
                    if control[ACCEPTED, lane] == 0.0:
                        continue
                    mine = reals[_SHARE, lane]
                    if together:
                        if mine != share:
                            ints[_LANDING, lane] = -1
                    elif mine == 2.0:
                        continue
                    used, t = control[STEP, lane], control[INSTANT, lane]
                    until = (share if together else mine) * used
                    counts[q, 1] += 1
                    control[ACCEPTED, lane] = 0.0
                    if until > _LEAST_STEP * max(1.0, abs(t)):
                        reals[_H, lane] = until
                        if ints[_CUT, lane] == 0:
                            ints[_CUT, lane], reals[_UNCUT, lane] = 1, reals[_WANTED, lane]
                    else:
                        reals[_H, lane] = used
                        if ints[_LANDING, lane] >= 0:
                            _change(
                                ints[_LANDING, lane], lane, q, t, functions, moved, switching_, stops, whole,
                                packed, state, own, of_lane, events, counts,
                            )  # fmt: skip
                            ints[_FRESH, lane] = 1
                        ints[_LANDING, lane] = -1
                    if counts[q, 0] + counts[q, 1] >= max_steps:
                        statuses[q] = 2
                        ints[_OVER, lane] = 1
        crossing, accepted = False, 0
        for lane in range(LANES):
            if control[ACCEPTED, lane] > 0.0:
                accepted += 1
                q, row = ints[_OWNER, lane], ints[_ROW, lane]
                if row < rows and grids[q % grids.shape[0], row] <= reals[_REACHED, lane]:
                    crossing = True
        if crossing:
            write_dense(kept, room, dense)
            for lane in range(LANES):
                q, first = ints[_OWNER, lane], ints[_ROW, lane]
                if control[ACCEPTED, lane] == 0.0:
                    continue
                grid = grids[q % grids.shape[0]]
                stop = first
                while stop < rows and grid[stop] <= reals[_REACHED, lane]:
                    stop += 1
                if stop == first:
                    continue
                ints[_ROW, lane] = counts[q, 2] = stop
                t, over, at_grid = control[INSTANT, lane], 1.0 / control[STEP, lane], grid.ctypes.data
                for c in range(kept.shape[0]):
                    into = out[q, column_of[c]] if column_of[c] >= 0 else scratch[lane, c]
                    write_column(dense, c, lane, at_grid, into.ctypes.data, t, over, first, stop)
                for c in range(kept_switches.shape[0]):
                    value = own[lane, first_switch + kept_switches[c]]
                    scratch[lane, kept.shape[0] + c, first:stop] = value
        if accepted == LANES:
            whole, following = following, whole
            for i in range(n):
                store(at_state, i, load(at_trial, i))
        elif accepted > 0:
            mask, at_whole, at_following = (
                load(at_control, ACCEPTED),
                whole.ctypes.data,
                following.ctypes.data,
            )
            for i in range(n):
                store(at_state, i, where_positive(mask, load(at_trial, i), load(at_state, i)))
            for i in range(whole.shape[0]):
                store(at_whole, i, where_positive(mask, load(at_following, i), load(at_whole, i)))
        for lane in range(LANES):
            q = ints[_OWNER, lane]
            if q < 0:
                continue
            if control[ACCEPTED, lane] > 0.0:
                counts[q, 0] += 1
                last, failed, factor = ints[_LAST, lane], ints[_FAILED, lane], control[FACTOR, lane]
                control[INSTANT, lane] = reals[_REACHED, lane]
                if ints[_LANDING, lane] >= 0:
                    _change(
                        ints[_LANDING, lane], lane, q, control[INSTANT, lane], functions, moved, switching_, stops,
                        whole, packed, state, own, of_lane, events, counts,
                    )  # fmt: skip
                    ints[_FRESH, lane] = 1
                if ints[_CUT, lane] > 0:
                    reals[_H, lane] = reals[_UNCUT, lane]
                else:
                    grown = control[STEP, lane] * (min(factor, 1.0) if failed else factor)
                    reals[_H, lane] = max(grown, reals[_WANTED, lane]) if last and not failed else grown
                ints[_FAILED, lane], ints[_LANDING, lane], ints[_CUT, lane] = 0, -1, 0
                if last:
                    ints[_SEGMENT, lane] += 1
                    if ints[_SEGMENT, lane] < segments:
                        _enter(
                            lane, q, clock, n, inputs, times, fixed, ints, reals, packed, own, state, control
                        )
                    else:
                        ints[_OVER, lane] = 1
                if ints[_OVER, lane] == 0 and counts[q, 0] + counts[q, 1] >= max_steps:
                    statuses[q] = 2
                    ints[_OVER, lane] = 1
            if ints[_OVER, lane] > 0:
                finish(
                    lane, functions[4], clock, ints[_ROW, lane], constants[q], times[q % times.shape[0]],
                    inputs[q % inputs.shape[0]], grids[q % grids.shape[0]], columns, out[q], scratch, row_packed, room,
                )  # fmt: skip
                for i in range(n):
                    ends[q, i] = state[i, lane]
                for i in range(kinds):
                    switches[q, i] = packed[first_switch + i, lane]
                ints[_OWNER, lane] = -1
                ints[_FRESH, lane] = ints[_OVER, lane] = 0
                active -= 1
                if not together and upcoming < sets:
                    _begin(
                        lane,
                        upcoming,
                        constants,
                        starts,
                        switches,
                        first_step,
                        ints,
                        reals,
                        packed,
                        own,
                        state,
                    )
                    _enter(
                        lane,
                        upcoming,
                        clock,
                        n,
                        inputs,
                        times,
                        fixed,
                        ints,
                        reals,
                        packed,
                        own,
                        state,
                        control,
                    )
                    upcoming += 1
                    active += 1
        if together and active == 0:
            for lane in range(LANES):
                if upcoming < sets:
                    _begin(
                        lane,
                        upcoming,
                        constants,
                        starts,
                        switches,
                        first_step,
                        ints,
                        reals,
                        packed,
                        own,
                        state,
                    )
                    _enter(
                        lane,
                        upcoming,
                        clock,
                        n,
                        inputs,
                        times,
                        fixed,
                        ints,
                        reals,
                        packed,
                        own,
                        state,
                        control,
                    )
                    upcoming += 1
                    active += 1
