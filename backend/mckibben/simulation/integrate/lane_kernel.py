"""Rodas4 for one or many parameter sets: every lane runs a set and takes the next one when it has ended.

Lanes share nothing but the instructions: each has its own instant, step, segment, switches and error. A run
alone is one lane, the others idle: a kernel of width 1 would take a third longer, because the outputs of a
run's rows are computed in lanes.

It holds no physics, so numba compiles it once per installation, whatever is simulated. A model is passed as
the addresses of functions of states, constants, inputs and switches: ``rates``, ``jacobian`` (-> rates,
nonzero entries of the Jacobian, derivatives by time, guards), ``outputs`` and ``guards``; and the linear
systems as ``factorise`` and ``solve``. Inputs are constant within a segment; switching instants are segment
ends, so no step crosses a jump. One state is the clock: it is known in advance and not part of the linear
systems.

A switch is 0 or 1. It changes where its guard falls below zero: the step is then repeated up to that instant,
so no step crosses such a change either. A switch that is an end stop also takes the speed, or turns it round
with a coefficient of restitution.

Method: Rodas4 of Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7: six stages, order
4 with an embedded order 3, L-stable, dense output of order 3.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.command import joint, pid, pwm
from mckibben.simulation.integrate import (
    coefficients,
    lane_control,
    lane_controller,
    lane_events,
    lane_rows,
    lane_step,
    lane_type,
    lane_writer,
    switching,
)
from mckibben.simulation.integrate.borrowed import borrowed
from mckibben.simulation.integrate.lane_control import (
    ACCEPTED,
    ACTIVE,
    END,
    ERROR,
    FRESH,
    HOPELESS,
    INSTANT,
    LANDING,
    LAST,
    NEXT_ROW,
    REACHED,
    REJECTED,
    TAKEN,
    WANTED,
    choose_steps,
    commit,
    judge,
)
from mckibben.simulation.integrate.lane_controller import LOOP, next_segment
from mckibben.simulation.integrate.lane_events import change, confirm, locate, settle, suspicious
from mckibben.simulation.integrate.lane_rows import (
    OWNER,
    ROW,
    SEGMENT,
    complete,
    write_rows,
)
from mckibben.simulation.integrate.lane_step import attempt
from mckibben.simulation.integrate.lane_type import (
    LANES,
    load,
    positive_bits,
    replaced,
    splat,
    store,
    where_positive,
)
from mckibben.simulation.integrate.stamp import kernel
from mckibben.simulation.integrate.switching import call

_ALL = (1 << LANES) - 1


class Status(IntEnum):
    """How a run of the kernel ended."""

    COMPLETED = 0
    STEP_TOO_SMALL = 1
    TOO_MANY_STEPS = 2
    NOT_FINITE = 3


@njit(error_model="numpy")
def _enter(lane: int, clock: int, numbers: np.ndarray, control: np.ndarray, given: Any, lanes: Any) -> None:
    """Begin the segment of a lane."""
    constants, _, _, times, inputs, _ = given
    state, packed, own, _ = lanes
    q, segment, first = numbers[OWNER, lane], numbers[SEGMENT, lane], state.shape[0] + constants.shape[1]
    wanted, limits = inputs[q % inputs.shape[0], segment], times[q % times.shape[0]]
    for i in range(wanted.shape[0]):
        packed[first + i, lane] = own[lane, first + i] = wanted[i]
    control[INSTANT, lane] = state[clock, lane] = limits[segment]
    control[END, lane] = limits[segment + 1]
    control[FRESH, lane] = 1.0


@njit(error_model="numpy")
def _begin(
    lane: int, q: int, first_step: np.ndarray, clock: int, numbers: np.ndarray, control: np.ndarray,
    given: Any, lanes: Any,
) -> None:  # fmt: skip
    """Give a lane a set."""
    constants, starts, switches, _, _, grids = given
    state, packed, own, _ = lanes
    n, first = state.shape[0], packed.shape[0] - switches.shape[1]
    for i in range(n):
        state[i, lane] = starts[q, i]
    for i in range(constants.shape[1]):
        packed[n + i, lane] = own[lane, n + i] = constants[q, i]
    for i in range(switches.shape[1]):
        packed[first + i, lane] = own[lane, first + i] = switches[q, i]
    numbers[:, lane] = 0
    numbers[OWNER, lane] = q
    control[:, lane] = 0.0
    control[ACTIVE, lane], control[LANDING, lane], control[WANTED, lane] = 1.0, -1.0, first_step[q]
    control[NEXT_ROW, lane] = grids[q % grids.shape[0], 0]
    _enter(lane, clock, numbers, control, given, lanes)


_ROWS = "float64[:,::1]"
_TABLE = "float64[:,:,::1]"
_SIGNATURE = (
    "void(UniTuple(int64,5),int64,uint64[::1],int64,int64,int64,UniTuple(int64,2),UniTuple(float64[::1],5),"
    f"{_ROWS},{_ROWS},{_ROWS},{_ROWS},{_ROWS},{_TABLE},float64[::1],{_ROWS},float64,float64[::1],"
    f"UniTuple(int64[::1],4),{_TABLE},{_ROWS},{_TABLE},int64[:,::1],int64[::1],int64,boolean,"
    f"int64,{LOOP},Tuple((UniTuple({_ROWS},7),UniTuple({_ROWS},2),{_ROWS},{_ROWS},{_ROWS},{_ROWS},{_TABLE},"
    f"Tuple((float64[::1],float64[::1],{_ROWS},{_ROWS},float64[::1],float64[::1])),"
    "Tuple((int64[:,::1],int64[::1])))))"
)


@kernel(
    _SIGNATURE,
    joint,
    pid,
    pwm,
    coefficients,
    switching,
    lane_control,
    lane_controller,
    lane_events,
    lane_rows,
    lane_step,
    lane_type,
    lane_writer,
    also=LANES,
)
def rodas4_lanes(
    functions: tuple[int, int, int, int, int],
    guards: int,
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
    first_step: np.ndarray,
    grids: np.ndarray,
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
    measured: int,
    loop: Any,
    arrays: Any,
) -> None:
    """Run the sets; arrays of several sets have them first, those marked * may have a single one for all.

    Args:
        functions: addresses of ``rates``, ``jacobian``, ``factorise``, ``solve`` and ``outputs`` (0: none) on
            rows of lanes.
        guards: address of the guards of one set.
        timed: rates that depend on time.
        entries, positions: numbers of entries of the Jacobian and of positions of
            `mckibben.simulation.integrate.elimination.Plan`.
        clock: number of the state that is time.
        moved: numbers of the states stroke and speed, which end stops act on; -1 without stops.
        switching_: of each switch the least guard; the coefficient of restitution, the speed [m/s] and the
            height [m] below which the load does not rebound, and the stiffness of guards of lengths [N/m]; of
            each switch the number of the length that follows (-1: none); the numbers of the states that
            guards depend on; and of each switch the direction of sliding that it is (0: none).
        stops: of each set the stroke of the end stop of each switch (NaN: none).
        constants, starts: of each set.
        switches: at the start, overwritten with the end.
        times*, inputs*: segment boundaries and inputs, shapes (sets, segments + 1), (sets, segments, inputs).
        first_step: first step to try, of each set; overwritten with the next step to try.
        grids*: instants of the rows, then at least LANES times infinity.
        columns: states to be kept; the column of each in ``out`` or -1; switches to be kept; columns of the
            outputs.
        rtol, atol: error per step: weighted root mean square below 1; ``atol`` has one entry per state.
        out: shape (sets, columns, room for the rows and LANES - 1 more).
        ends: states at the end.
        events: of each set, rows (instant, number of the switch, its new value, speed and acceleration just
            before); further events are counted, not written.
        counts: of each set accepted steps, rejected steps, grid rows written and events.
        statuses: of each set a `Status`.
        max_steps: of a set.
        together: the sets run in groups of LANES; those of a group take the steps of its first.
        measured: address of the reading of one set under a sampled controller, which writes times and inputs
            as it goes; 0 without one.
        loop: see `mckibben.simulation.integrate.lane_controller.next_segment`.
        arrays: room of `attempt`, twice the Jacobian, arguments, arguments of rows, dense output, arguments
            by lane, windows of rows, arrays for one lane, and
            whole numbers of lanes and the table of `mckibben.simulation.integrate.lane_rows`.
    """
    timed, stops, constants, starts, switches, times, inputs, grids, atol, out, ends, first_step = (
        borrowed(timed), borrowed(stops), borrowed(constants), borrowed(starts), borrowed(switches),
        borrowed(times), borrowed(inputs), borrowed(grids), borrowed(atol), borrowed(out), borrowed(ends),
        borrowed(first_step),
    )  # fmt: skip
    events, counts, statuses = borrowed(events), borrowed(counts), borrowed(statuses)
    room, (whole, following), packed, row_packed, dense, own, windows, of_lane, (numbers, table) = arrays
    packed, row_packed, dense, own, windows = (
        borrowed(packed), borrowed(row_packed), borrowed(dense), borrowed(own), borrowed(windows),
    )  # fmt: skip
    whole, following, numbers, table = (
        borrowed(whole), borrowed(following), borrowed(numbers), borrowed(table),
    )  # fmt: skip
    a, b, c, d, e, f, g = room
    room = borrowed(a), borrowed(b), borrowed(c), borrowed(d), borrowed(e), borrowed(f), borrowed(g)
    state, _, _, _, _, _, control = room
    a, b, c, d, e, f = of_lane
    of_lane = borrowed(a), borrowed(b), borrowed(c), borrowed(d), borrowed(e), borrowed(f)
    a, b, c, d, e = switching_
    switching_ = borrowed(a), borrowed(b), borrowed(c), borrowed(d), borrowed(e)
    h, i, j, k = columns
    columns = borrowed(h), borrowed(i), borrowed(j), borrowed(k)
    n, kinds, sets, segments = state.shape[0], switches.shape[1], starts.shape[0], inputs.shape[1]
    first_guard, first_switch = n + entries + timed.shape[0], packed.shape[0] - kinds
    places = (
        room[0].ctypes.data, room[1].ctypes.data, room[2].ctypes.data, room[3].ctypes.data,
        room[4].ctypes.data, room[5].ctypes.data, room[6].ctypes.data,
    )  # fmt: skip
    at_state, at_trial, at_u, _, _, at_values, at = places
    at_packed, sizes = packed.ctypes.data, (n, entries, positions, clock)
    at_switches = at_packed + 8 * LANES * first_switch
    given = constants, starts, switches, times, inputs, grids
    model, lanes, of_sets = (
        (guards, moved, switching_),
        (state, packed, own, of_lane),
        (stops, events, counts),
    )
    kept, column_of, kept_switches, output_columns = columns
    filled = np.array([
        n, constants.shape[1], inputs.shape[2], segments, clock, kept.shape[0], kept_switches.shape[0],
        output_columns.shape[0], out.shape[1], out.shape[2], first_switch,
        at, numbers.ctypes.data, at_state, at_trial, at_u, dense.ctypes.data, at_values,
        row_packed.ctypes.data, at_packed, windows.ctypes.data, out.ctypes.data, kept.ctypes.data,
        column_of.ctypes.data, kept_switches.ctypes.data, output_columns.ctypes.data, functions[4],
        grids.ctypes.data, grids.strides[0] if grids.shape[0] > 1 else 0,
        times.ctypes.data, times.strides[0] if times.shape[0] > 1 else 0,
        inputs.ctypes.data, inputs.strides[0] if inputs.shape[0] > 1 else 0,
        constants.ctypes.data, constants.strides[0],
    ], np.int64)  # fmt: skip
    for entry in range(filled.shape[0]):
        table[entry] = filled[entry]
    controlled, fixed = measured != 0, n + constants.shape[1]
    if controlled:
        for i in range(n):
            loop[8][i] = starts[0, i]
        next_segment(measured, times[0, 0], 0, fixed, times, inputs, loop)
    for lane in range(LANES if sets > 0 else 0):
        # Idle lanes need sound numbers as well.
        _begin(lane, min(lane, sets - 1), first_step, clock, numbers, control, given, lanes)
        if lane >= sets:
            control[ACTIVE, lane] = control[FRESH, lane] = 0.0
            for i in range(whole.shape[0]):
                whole[i, lane] = 0.0
    upcoming = active = min(LANES, sets)
    while active > 0:
        if positive_bits(load(at, FRESH)):
            settle(
                functions[1], whole, following, first_guard, numbers[OWNER], control, model, lanes, of_sets
            )
        choose_steps(at, together, control)
        attempt(functions, sizes, timed, rtol, atol, whole.ctypes.data, at_packed, places)
        short = judge(at, together, control)
        over = 0
        for lane in range(LANES if short else 0):
            if (short >> lane) & 1:
                worst = control[ERROR, 0] if together else control[ERROR, lane]
                statuses[numbers[OWNER, lane]] = 3 if worst >= HOPELESS else 1
                over |= 1 << lane
        accepted = positive_bits(load(at, ACCEPTED))
        if accepted:
            call(functions[1], following.ctypes.data, at_packed)
            at_guards = following.ctypes.data + 8 * LANES * first_guard
            rates = whole.ctypes.data, following.ctypes.data
            if suspicious(at, at_guards, at_state, at_trial, moved[1], rates, at_switches, model):
                locate(
                    clock, whole, following, first_guard, numbers[OWNER], together, room, model, lanes,
                    of_sets,
                )  # fmt: skip
                accepted = positive_bits(load(at, ACCEPTED))
            landing = positive_bits(where_positive(load(at, ACCEPTED), load(at, LANDING) + 1.0, splat(0.0)))
            if landing:
                confirm(landing, whole, following, first_guard, together, control)
            due = where_positive(load(at, NEXT_ROW) - load(at, REACHED), splat(0.0), load(at, ACCEPTED))
            crossing = positive_bits(due)
            if crossing:
                write_rows(crossing, table)
        if accepted == _ALL:
            whole, following = following, whole
            for i in range(n):
                store(at_state, i, load(at_trial, i))
        elif accepted:
            mask, at_whole, at_following = load(at, ACCEPTED), whole.ctypes.data, following.ctypes.data
            for i in range(n):
                store(at_state, i, replaced(mask, load(at_trial, i), load(at_state, i)))
            for i in range(whole.shape[0]):
                store(at_whole, i, replaced(mask, load(at_following, i), load(at_whole, i)))
        landed = commit(at)
        for lane in range(LANES if landed else 0):
            if not (landed >> lane) & 1:
                continue
            if control[LANDING, lane] >= 0.0:
                change(
                    int(control[LANDING, lane]), lane, numbers[OWNER, lane], control[INSTANT, lane], whole,
                    model, lanes, of_sets,
                )  # fmt: skip
                control[LANDING, lane], control[FRESH, lane] = -1.0, 1.0
            if control[LAST, lane] > 0.0:
                numbers[SEGMENT, lane] += 1
                more = numbers[SEGMENT, lane] < segments
                if controlled:
                    for i in range(n):
                        loop[8][i] = state[i, lane]
                    at_end = control[INSTANT, lane]
                    more = next_segment(measured, at_end, numbers[SEGMENT, lane], fixed, times, inputs, loop)
                if more:
                    _enter(lane, clock, numbers, control, given, lanes)
                else:
                    over |= 1 << lane
        tired = load(at, TAKEN) + load(at, REJECTED) - (max_steps - 0.5)
        late = positive_bits(where_positive(tired, load(at, ACTIVE), splat(0.0))) & ~over
        for lane in range(LANES if late else 0):
            if (late >> lane) & 1:
                statuses[numbers[OWNER, lane]] = 2
        over |= late
        for lane in range(LANES if over else 0):
            if not (over >> lane) & 1:
                continue
            q = numbers[OWNER, lane]
            counts[q, 0], counts[q, 1] = control[TAKEN, lane], control[REJECTED, lane]
            counts[q, 2] = numbers[ROW, lane]
            complete(lane, table)
            first_step[q] = control[WANTED, lane]
            for i in range(n):
                ends[q, i] = state[i, lane]
                if statuses[q] == 0 and not np.isfinite(state[i, lane]):
                    statuses[q] = 3
            for i in range(kinds):
                switches[q, i] = packed[first_switch + i, lane]
            control[ACTIVE, lane] = control[FRESH, lane] = 0.0
            active -= 1
            if not together and upcoming < sets:
                _begin(lane, upcoming, first_step, clock, numbers, control, given, lanes)
                upcoming += 1
                active += 1
        if together and active == 0:
            for lane in range(LANES):
                if upcoming < sets:
                    _begin(lane, upcoming, first_step, clock, numbers, control, given, lanes)
                    upcoming += 1
                    active += 1
