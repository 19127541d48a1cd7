"""Switches of a lane: the event rules of `mckibben.simulation.integrate.switching` on its column."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.integrate.coefficients import DENSE_2, DENSE_3
from mckibben.simulation.integrate.lane_control import (
    ACCEPTED,
    CUT,
    FLAG,
    FRESH,
    INSTANT,
    LANDING,
    LEAST_STEP,
    REJECTED,
    SHARE,
    STEP,
    UNCUT,
    WANTED,
    WANTED_NEXT,
)
from mckibben.simulation.integrate.lane_type import LANES, load, positive_bits, splat, store, where_positive
from mckibben.simulation.integrate.switching import (
    call,
    change_switch,
    first_event,
    recedes,
    same_event,
)


@njit(error_model="numpy")
def change(k: int, lane: int, q: int, t: float, rates: np.ndarray, model: Any, lanes: Any, kept: Any) -> None:
    """Change switch k of a lane; ``rates`` (rows of lanes) are those before.

    Args:
        model: addresses of the guards and of the functions on rows of lanes, states moved, ``switching_``.
        lanes: state, arguments and arguments by lane; arrays for one lane.
        kept: of each set: strokes of stops, events, counts.
    """
    guards, moved, (least, bounce, follows, watched, slides) = model
    state, packed, own, (start, before, _, _, guarded, switches) = lanes
    stops, events, counts = kept
    n, kinds = state.shape[0], switches.shape[0]
    first = packed.shape[0] - kinds
    for i in range(n):
        start[i], before[i] = state[i, lane], rates[i, lane]
    for i in range(kinds):
        switches[i] = packed[first + i, lane]
    change_switch(
        k, t, before, guards, moved, (least, stops[q], bounce, follows, watched, slides), own[lane], guarded,
        start, switches, events[q], counts[q],
    )  # fmt: skip
    for i in range(n):
        state[i, lane] = start[i]
    for i in range(kinds):
        packed[first + i, lane] = own[lane, first + i] = switches[i]


@njit(inline="always", error_model="numpy")
def _gather(
    lane: int, whole: np.ndarray, ends: np.ndarray, first_guard: int, room: Any, model: Any, lanes: Any
) -> None:
    """The step of a lane into the arrays for one lane: what guards depend on, and the speed."""
    _, moved, (_, _, _, watched, _) = model
    state, packed, _, (start, end, dense, columns, _, switches) = lanes
    _, trial, u, _, _, _, _ = room
    n, kinds = state.shape[0], switches.shape[0]
    first = packed.shape[0] - kinds
    for place in range(watched.shape[0] + 1):
        i = int(watched[place]) if place < watched.shape[0] else moved[1]
        if i < 0:
            continue
        start[i], end[i] = state[i, lane], trial[i, lane]
        second = third = 0.0
        for j in range(5):
            second += DENSE_2[j] * u[n * j + i, lane]
            third += DENSE_3[j] * u[n * j + i, lane]
        dense[0, i], dense[1, i] = second, third
    for i in range(kinds):
        switches[i] = packed[first + i, lane]
        columns[0, i], columns[1, i] = whole[first_guard + i, lane], ends[first_guard + i, lane]


@njit(inline="always", error_model="numpy")
def _event(
    lane: int, q: int, clock: int, whole: np.ndarray, ends: np.ndarray, first_guard: int, room: Any,
    model: Any, lanes: Any, kept: Any,
) -> tuple[float, int]:  # fmt: skip
    """`first_event` of a lane."""
    guards, moved, (least, bounce, follows, watched, slides) = model
    _, _, own, (start, end, dense, columns, guarded, switches) = lanes
    control = room[6]
    _gather(lane, whole, ends, first_guard, room, model, lanes)
    return first_event(
        guards, control[INSTANT, lane], control[STEP, lane], columns[0], columns[1], 0, switches, moved,
        (least, kept[0][q], bounce, follows, watched, slides), clock, own[lane], guarded, start, end, dense,
    )  # fmt: skip


@njit(error_model="numpy")
def _same_event(
    lane: int, share: float, k: int, clock: int, whole: np.ndarray, ends: np.ndarray, first_guard: int,
    room: Any, model: Any, lanes: Any,
) -> float:  # fmt: skip
    """`same_event` of a lane."""
    guards, _, (least, _, _, watched, _) = model
    _, _, own, (start, end, dense, _, guarded, _) = lanes
    control = room[6]
    _gather(lane, whole, ends, first_guard, room, model, lanes)
    return same_event(
        guards, share, control[INSTANT, lane], control[STEP, lane], k, least[k], clock, watched, own[lane],
        guarded, start, end, dense,
    )  # fmt: skip


@njit(inline="always", error_model="numpy")
def settle(
    jacobian: int, whole: np.ndarray, following: np.ndarray, first_guard: int, owner: np.ndarray,
    control: np.ndarray, model: Any, lanes: Any, kept: Any,
) -> None:  # fmt: skip
    """Lanes whose inputs or switches have changed: change violated switches, then renew the Jacobian."""
    least = model[2][0]
    state, packed, _, _ = lanes
    n, kinds = state.shape[0], least.shape[0]
    at_state, at_packed = state.ctypes.data, packed.ctypes.data
    tries, waiting = 0, 1
    while waiting > 0:
        for i in range(n):
            store(at_packed, i, load(at_state, i))
        call(jacobian, following.ctypes.data, at_packed)
        waiting = 0
        for lane in range(LANES):
            if control[FRESH, lane] == 0.0:
                continue
            wrong = -1
            for k in range(kinds if tries < 2 * kinds + 1 else 0):
                if following[first_guard + k, lane] < -least[k]:
                    wrong = k
                    break
            if wrong >= 0:
                change(wrong, lane, owner[lane], control[INSTANT, lane], following, model, lanes, kept)
                waiting += 1
            else:
                for i in range(whole.shape[0]):
                    whole[i, lane] = following[i, lane]
                control[FRESH, lane] = 0.0
        tries += 1


@njit(inline="always", error_model="numpy")
def suspicious(
    at: int, at_guards: int, at_state: int, at_trial: int, speed: int, rates: tuple[int, int],
    at_switches: int, model: Any,
) -> int:  # fmt: skip
    """Accepted lanes in whose step a switch may change; those that end at a change already are left out.

    A guard may also be negative only inside the step: of a speed that is smallest there, and of a load that
    sticks. ``rates``: those before and after the step.
    """
    least, _, follows, _, slides = model[2]
    one, flag = splat(1.0), splat(0.0)
    for k in range(least.shape[0]):
        flag = where_positive(splat(-least[k]) - load(at_guards, k), one, flag)
    if speed >= 0:
        flag = where_positive(splat(0.0) - load(at_state, speed) * load(at_trial, speed), one, flag)
    free, dry = one, False
    for k in range(least.shape[0]):
        dry |= slides[k] != 0.0
        if follows[k] < 0.0:  # of stops and directions of sliding; without any of them the load sticks
            free = free - load(at_switches, k)
    if dry:
        turns = splat(0.0) - load(rates[0], speed) * load(rates[1], speed)
        flag = where_positive(turns, one, where_positive(free, one, flag))
    flag = where_positive(load(at, LANDING) + 1.0, splat(0.0), flag)
    flag = where_positive(load(at, ACCEPTED), flag, splat(0.0))
    store(at, FLAG, flag)
    return positive_bits(flag)


@njit(inline="always", error_model="numpy")
def locate(
    clock: int, whole: np.ndarray, following: np.ndarray, first_guard: int, owner: np.ndarray, together: bool,
    room: Any, model: Any, lanes: Any, kept: Any,
) -> None:  # fmt: skip
    """Find the changes in the flagged lanes; these lanes repeat the step up to there.

    Together only those of the first lane count; every lane repeats the step up to its own instant of the same
    change, which may lie somewhat outside its step.
    """
    control = room[6]
    for lane in range(LANES):
        control[SHARE, lane] = 2.0
        if control[FLAG, lane] > 0.0 and not (together and lane > 0):
            control[SHARE, lane], control[LANDING, lane] = _event(
                lane, owner[lane], clock, whole, following, first_guard, room, model, lanes, kept
            )
    if together and control[SHARE, 0] != 2.0:
        k, share = int(control[LANDING, 0]), control[SHARE, 0]
        for lane in range(LANES):
            if control[ACCEPTED, lane] > 0.0:
                found = _same_event(lane, share, k, clock, whole, following, first_guard, room, model, lanes)
                if lane == 0 and found == 2.0:
                    found = share
                control[SHARE, lane], control[LANDING, lane] = found, -1.0 if found == 2.0 else float(k)
    now = together and control[SHARE, 0] * control[STEP, 0] <= _least_step(control[INSTANT, 0])
    all_repeat = together and control[SHARE, 0] != 2.0
    for lane in range(LANES):
        mine = control[SHARE, lane]
        if control[ACCEPTED, lane] == 0.0 or (mine == 2.0 and not all_repeat):
            continue
        if mine == 2.0:  # runs apart from the first lane
            mine = control[SHARE, 0]
        used, t = control[STEP, lane], control[INSTANT, lane]
        control[REJECTED, lane] += 1.0
        control[ACCEPTED, lane] = 0.0
        if not now and (mine * used > _least_step(t) or together):
            # A step of no length cannot be solved for.
            control[WANTED_NEXT, lane] = mine * used if abs(mine * used) > _least_step(t) else _least_step(t)
            if control[CUT, lane] == 0.0:
                control[CUT, lane], control[UNCUT, lane] = 1.0, control[WANTED, lane]
        else:
            control[WANTED_NEXT, lane] = used
            if control[LANDING, lane] >= 0.0:
                change(int(control[LANDING, lane]), lane, owner[lane], t, whole, model, lanes, kept)
                control[FRESH, lane] = 1.0
            control[LANDING, lane] = -1.0


@njit(inline="always", error_model="numpy")
def _least_step(t: float) -> float:
    return LEAST_STEP * max(1.0, abs(t))


@njit(inline="always", error_model="numpy")
def confirm(
    landing: int, whole: np.ndarray, following: np.ndarray, first_guard: int, together: bool,
    control: np.ndarray,
) -> None:  # fmt: skip
    """Of accepted lanes that end at a change: leave the change out where the guard recedes.

    Together the first lane decides.
    """
    left_out = 0
    for lane in range(LANES):
        if (landing >> lane) & 1:
            guard = first_guard + int(control[LANDING, lane])
            if recedes(following[guard, lane], whole[guard, lane]):
                left_out |= 1 << lane
    if together:
        left_out = landing if left_out & 1 else 0
    for lane in range(LANES):
        if (left_out >> lane) & 1:
            control[LANDING, lane], control[CUT, lane] = -1.0, 0.0
