"""What the kernel knows of each lane: rows of lanes in one array, and how a step changes them.

A condition is a row of ones and zeros.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from mckibben.simulation.integrate.lane_type import (
    inverse_root,
    larger,
    load,
    magnitude,
    positive_bits,
    replaced,
    smaller,
    splat,
    store,
    where_positive,
)

# Squared error of a step that is not solvable or not finite.
HOPELESS = 1e20
# A step shorter than this share of the instant, or of 1 s, cannot be taken.
LEAST_STEP = 1e-13

# Rows of the control array. Of a set: whether it runs, instant, end of the segment, instant of the next row,
# accepted and rejected steps, whether switches or inputs have just changed.
ACTIVE, INSTANT, END, NEXT_ROW, TAKEN, REJECTED, FRESH = range(7)
# Of the next step: length wanted; switch that changes at its end (-1: none); whether it was shortened for
# that, and from what; whether the one before was rejected.
WANTED, LANDING, CUT, UNCUT, FAILED = range(7, 12)
# Of this step: length, its reciprocal, end, whether it ends the segment, squared error, factor for the next
# one, whether it is accepted; whether a switch may change in it, the share of it after which one does, and
# the length wanted next if it is not accepted.
STEP, INVERSE, REACHED, LAST, ERROR, FACTOR, ACCEPTED, FLAG, SHARE, WANTED_NEXT = range(12, 22)
CONTROL_ROWS = 22


@njit(inline="always", error_model="numpy")
def choose_steps(at: int, together: bool, control: np.ndarray) -> None:
    """STEP, REACHED and LAST: the step wanted, or less to the end of the segment.

    Together, the first lane decides, and only a change of a switch has a step of its own in each lane.
    """
    t, wanted, end = load(at, INSTANT), load(at, WANTED), load(at, END)
    last = where_positive(end - (t + 1.0000001 * wanted), splat(0.0), splat(1.0))
    if together:
        last = splat(1.0 if control[INSTANT, 0] + 1.0000001 * control[WANTED, 0] >= control[END, 0] else 0.0)
        if control[LANDING, 0] < 0.0:
            wanted = splat(control[WANTED, 0])
    step = where_positive(last, end - t, wanted)
    store(at, LAST, last)
    store(at, STEP, step)
    store(at, REACHED, where_positive(last, end, t + step))


@njit(inline="always", error_model="numpy")
def judge(at: int, together: bool, control: np.ndarray) -> int:
    """ACCEPTED from ERROR; the rejected lanes get a shorter step. Returns the lanes whose step is too short.

    Together, the error is that of the first lane.
    """
    active, squared, t = load(at, ACTIVE), load(at, ERROR), load(at, INSTANT)
    if together:
        squared, t = splat(control[ERROR, 0]), splat(control[INSTANT, 0])
    # 0.9 times the fourth root of 1 / error, between 0.2 and 6; one step of Newton's for 8 digits
    sound = larger(squared, splat(1e-30))
    root = inverse_root(inverse_root(inverse_root(sound)))
    second = root * root
    fourth = second * second
    root = root + (0.125 * root) * (1.0 - sound * (fourth * fourth))
    factor = smaller(splat(6.0), larger(splat(0.2), 0.9 * root))
    accepted = where_positive(squared - 1.0, splat(0.0), active)
    rejected = active - accepted
    shorter = (splat(control[STEP, 0]) if together else load(at, STEP)) * factor
    store(at, FACTOR, factor)
    store(at, ACCEPTED, accepted)
    store(at, WANTED_NEXT, where_positive(rejected, shorter, load(at, WANTED)))
    store(at, FAILED, replaced(rejected, splat(1.0), load(at, FAILED)))
    store(at, CUT, replaced(rejected, splat(0.0), load(at, CUT)))
    store(at, LANDING, replaced(rejected, splat(-1.0), load(at, LANDING)))
    store(at, REJECTED, load(at, REJECTED) + rejected)
    short = LEAST_STEP * larger(splat(1.0), magnitude(t)) - shorter
    return positive_bits(where_positive(short, rejected, splat(0.0)))


@njit(inline="always", error_model="numpy")
def commit(at: int) -> int:
    """Advance the accepted lanes. Returns those at the end of a segment or where a switch changes."""
    accepted, factor, failed = load(at, ACCEPTED), load(at, FACTOR), load(at, FAILED)
    zero, one, wanted, last = splat(0.0), splat(1.0), load(at, WANTED), load(at, LAST)
    grown = load(at, STEP) * where_positive(failed, smaller(factor, one), factor)
    whole = where_positive(failed, zero, last)  # the last step of a segment is shorter than wanted
    grown = where_positive(whole, larger(grown, wanted), grown)
    grown = where_positive(load(at, CUT), load(at, UNCUT), grown)
    store(at, WANTED, where_positive(accepted, grown, load(at, WANTED_NEXT)))
    store(at, INSTANT, replaced(accepted, load(at, REACHED), load(at, INSTANT)))
    store(at, FAILED, replaced(accepted, zero, failed))
    store(at, CUT, replaced(accepted, zero, load(at, CUT)))
    store(at, TAKEN, load(at, TAKEN) + accepted)
    landed = where_positive(load(at, LANDING) + 1.0, one, last)
    return positive_bits(where_positive(accepted, landed, zero))
