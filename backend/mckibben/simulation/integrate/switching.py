"""Where within a step a switch changes, and what happens there: the event rules of the kernel.

They hold no physics: guards are a compiled function, end stops and lengths that follow are given by
``switching``: ``switching_`` of `mckibben.simulation.integrate.lane_kernel.rodas4_lanes` with the stops after
its first entry. A step is known by its start and end and by the coefficients ``dense`` of the dense output
between them.
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

# Guards of a load that sticks are looked at so many times in a step, its end included.
SAMPLES = 4


@njit(inline="always", error_model="numpy")
def _interpolated(i: int, s: float, start: np.ndarray, end: np.ndarray, dense: np.ndarray) -> float:
    """A state at the share s of a step."""
    return start[i] * (1.0 - s) + s * (end[i] + (1.0 - s) * (dense[0, i] + s * dense[1, i]))


@njit(inline="always", error_model="numpy")
def _guards_at(
    guards: int, s: float, t: float, h: float, clock: int, watched: np.ndarray, packed: np.ndarray,
    values: np.ndarray, start: np.ndarray, end: np.ndarray, dense: np.ndarray,
) -> None:  # fmt: skip
    """Write the guards at the share s of a step into ``values``."""
    for place in range(watched.shape[0]):
        i = int(watched[place])
        packed[i] = _interpolated(i, s, start, end, dense)
    packed[clock] = t + s * h
    call(guards, values.ctypes.data, packed.ctypes.data)


@njit(error_model="numpy")
def _guard_at(
    guards: int, s: float, t: float, h: float, k: int, clock: int, watched: np.ndarray, packed: np.ndarray,
    values: np.ndarray, start: np.ndarray, end: np.ndarray, dense: np.ndarray,
) -> float:  # fmt: skip
    """Guard of switch k at the share s of a step."""
    _guards_at(guards, s, t, h, clock, watched, packed, values, start, end, dense)
    return values[k]


@njit(inline="always", error_model="numpy")
def _crossing(
    guards: int, upper: float, at_low: float, at_high: float, t: float, h: float, k: int, least: float,
    clock: int, watched: np.ndarray, packed: np.ndarray, values: np.ndarray, start: np.ndarray,
    end: np.ndarray, dense: np.ndarray,
) -> float:  # fmt: skip
    """Share of a step at which guard k falls below -least.

    Plus ``least`` the guard is ``at_low`` at the start and ``at_high`` at ``upper``. Regula falsi of the
    Illinois kind.
    """
    low, high, found, side = 0.0, upper, upper, 0
    if at_low <= 0.0:
        high = found = 0.0
    for _ in range(60):
        if high - low < 1e-12 or not at_high < 0.0:
            break
        middle = (low * at_high - high * at_low) / (at_high - at_low)
        _guards_at(guards, middle, t, h, clock, watched, packed, values, start, end, dense)
        value = values[k] + least
        if abs(value) <= 0.5 * least:
            found = middle
            break
        if value < 0.0:
            found = high = middle
            at_high = value
            if side == -1:
                at_low *= 0.5
            side = -1
        else:
            low, at_low = middle, value
            if side == 1:
                at_high *= 0.5
            side = 1
    return found


@njit(inline="always", error_model="numpy")
def _turning(i: int, start: np.ndarray, end: np.ndarray, dense: np.ndarray) -> float:
    """Share of a step at which a speed that changes its sign is zero, by the same method."""
    low, high, at_low, at_high, side = 0.0, 1.0, start[i], end[i], 0
    small = 1e-9 * max(abs(at_low), abs(at_high))
    for _ in range(30):
        middle = (low * at_high - high * at_low) / (at_high - at_low)
        value = _interpolated(i, middle, start, end, dense)
        if value * start[i] > 0.0:
            low, at_low = middle, value
            if side == 1:
                at_high *= 0.5
            side = 1
        else:
            high, at_high = middle, value
            if side == -1:
                at_low *= 0.5
            side = -1
        if abs(value) <= small or high - low < 1e-9:
            low = middle
            break
    return low


@njit(inline="always", error_model="numpy")
def _backmost(i: int, sense: float, start: np.ndarray, end: np.ndarray, dense: np.ndarray) -> float:
    """Share of a step at which a speed, times its sense, is smallest and negative inside; 0 if nowhere."""
    a, b, c = -3.0 * dense[1, i], 2.0 * (dense[1, i] - dense[0, i]), end[i] - start[i] + dense[0, i]
    inside = b * b - 4.0 * a * c
    if inside < 0.0:
        return 0.0
    q = -0.5 * (b + (np.sqrt(inside) if b > 0.0 else -np.sqrt(inside)))
    found, least = 0.0, 0.0
    for root in (q / a if a != 0.0 else -1.0, c / q if q != 0.0 else -1.0):
        if 0.0 < root < 1.0:
            value = sense * _interpolated(i, root, start, end, dense)
            if value < least:
                found, least = root, value
    return found


@njit(inline="always", error_model="numpy")
def first_event(
    guards: int, t: float, h: float, begins: np.ndarray, ends: np.ndarray, first_guard: int,
    switches: np.ndarray, moved: tuple[int, int], switching: Any, clock: int, packed: np.ndarray,
    guarded: np.ndarray, start: np.ndarray, end: np.ndarray, dense: np.ndarray,
) -> tuple[float, int]:  # fmt: skip
    """Share of a step at which a switch changes first, and its number; (2, -1) if none changes.

    ``begins`` and ``ends`` hold the guards at the start and at the end of the step from ``first_guard`` on;
    ``packed`` the constants, the inputs and the switches.
    """
    least, stops, _, _, watched, slides = switching
    share, landing, turn = 2.0, -1, 0.0
    if moved[1] >= 0 and start[moved[1]] * end[moved[1]] < 0.0:
        # A load that turns round within the step may have touched a stop.
        turn = _turning(moved[1], start, end, dense)
    for k in range(switches.shape[0]):
        upper, at_upper = 0.0, ends[first_guard + k]
        if at_upper < -least[k]:
            upper = 1.0
        elif turn > 0.0 and switches[k] == 0.0 and stops[k] == stops[k]:
            at_upper = _guard_at(guards, turn, t, h, k, clock, watched, packed, guarded, start, end, dense)
            upper = turn if at_upper < -least[k] else 0.0
        elif slides[k] != 0.0 and switches[k] == 1.0:
            # A load that has all but come to rest within the step may have stuck there.
            upper = _backmost(moved[1], slides[k], start, end, dense)
            if upper > 0.0:
                at_upper = _guard_at(
                    guards, upper, t, h, k, clock, watched, packed, guarded, start, end, dense
                )
                upper = upper if at_upper < -least[k] else 0.0
        elif slides[k] != 0.0:
            # One that sticks may have been pulled beyond its range only within the step.
            for part in range(1, SAMPLES):
                inside = part / SAMPLES
                at_upper = _guard_at(
                    guards, inside, t, h, k, clock, watched, packed, guarded, start, end, dense
                )
                if at_upper < -least[k]:
                    upper = inside
                    break
        if upper > 0.0:
            at = _crossing(
                guards, upper, begins[first_guard + k] + least[k], at_upper + least[k], t, h, k, least[k],
                clock, watched, packed, guarded, start, end, dense,
            )  # fmt: skip
            if at < share:
                share, landing = at, k
    return share, landing


@njit(error_model="numpy")
def same_event(
    guards: int, share: float, t: float, h: float, k: int, least: float, clock: int, watched: np.ndarray,
    packed: np.ndarray, values: np.ndarray, start: np.ndarray, end: np.ndarray, dense: np.ndarray,
) -> float:  # fmt: skip
    """Share of a step near ``share`` at which guard k is -least, also outside the step; 2 if there is none.

    Secants; for a run that differs little from one whose switch changes at ``share``.
    """
    here, other = share, share + 1e-3
    at_here = _guard_at(guards, here, t, h, k, clock, watched, packed, values, start, end, dense) + least
    at_other = _guard_at(guards, other, t, h, k, clock, watched, packed, values, start, end, dense) + least
    for _ in range(30):
        if at_here == at_other:
            break
        new = here - at_here * (other - here) / (at_other - at_here)
        if not abs(new - share) < 0.5:
            break
        other, at_other = here, at_here
        here, at_here = (
            new,
            _guard_at(guards, new, t, h, k, clock, watched, packed, values, start, end, dense) + least,
        )
        if abs(here - other) < 1e-13:
            break
    return here if abs(at_here) <= 0.5 * least and abs(here - share) < 0.5 else 2.0


@njit(inline="always", error_model="numpy")
def recedes(end: float, start: float) -> bool:
    """Whether a guard has moved away from its change in the step that was to end there.

    The dense output of a long step may dip where the motion does not: at the start of a stiff transient,
    which the short step then resolves. The switch stays, and steps grow again from the short one.
    """
    return end > start and end > 0.0


@njit(error_model="numpy")
def change_switch(
    k: int, t: float, rates: np.ndarray, guards: int, moved: tuple[int, int], switching: Any,
    packed: np.ndarray, guarded: np.ndarray, state: np.ndarray, switches: np.ndarray, events: np.ndarray,
    counts: np.ndarray,
) -> None:  # fmt: skip
    """Change switch k. ``rates`` are those before.

    An end stop stops the load or throws it back; then it sticks there or slides the other way. A load that
    ends to slide is at rest, unless it moves the other way already: where friction has just set in.
    """
    _, stops, bounce, follows, _, slides = switching
    speed = acceleration = 0.0
    if moved[1] >= 0:
        speed, acceleration = state[moved[1]], rates[moved[1]]
    to = 1.0 - switches[k]
    if to == 1.0 and stops[k] == stops[k]:
        state[moved[0]] = stops[k]
        state[moved[1]] = 0.0
        left = bounce[0] * abs(speed)
        pressing = acceleration if speed > 0.0 else -acceleration
        if left > bounce[1] and left * left > 2.0 * bounce[3] * pressing:
            state[moved[1]] = -bounce[0] * speed
            to = 0.0
        for j in range(switches.shape[0]):
            if slides[j] != 0.0:
                switches[j] = 1.0 if slides[j] * state[moved[1]] > 0.0 else 0.0
    if slides[k] != 0.0 and to == 0.0:
        if abs(speed) > bounce[1]:
            for j in range(switches.shape[0]):
                if slides[j] == -slides[k]:
                    switches[j] = 1.0
        else:
            state[moved[1]] = 0.0
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
