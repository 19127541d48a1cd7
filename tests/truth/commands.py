"""Commands of a valve over time, as the transient tests give them."""

from __future__ import annotations

import numpy as np

from tests.truth.muscle import Array

Corners = tuple[tuple[float, float], ...]

#: Commands as corners (time [s], opening); two at one time are a jump.
STEPS: Corners = (
    (0.0, 0.0), (0.1, 0.0), (0.1, 1.0), (0.5, 1.0), (0.5, 0.0), (0.9, 0.0), (0.9, -1.0), (1.25, -1.0),
    (1.25, 0.0), (1.6, 0.0), (1.6, 1.0), (1.8, 1.0), (1.8, 0.0), (2.2, 0.0), (2.2, -1.0), (2.35, -1.0),
    (2.35, 0.0), (2.6, 0.0),
)  # fmt: skip
#: A few fast moves and long rests with the valve closed.
RESTS: Corners = (
    (0.0, 0.0), (0.1, 0.0), (0.1, 1.0), (0.6, 1.0), (0.6, 0.0), (2.6, 0.0), (2.6, -1.0), (2.95, -1.0),
    (2.95, 0.0), (5.0, 0.0),
)  # fmt: skip
#: Partial openings, ramps and triangles.
PARTIAL: Corners = (
    (0.0, 0.0), (0.1, 0.0), (0.5, 0.5), (0.9, 0.0), (1.2, -0.35), (1.5, 0.0), (1.7, 0.25), (2.1, 0.25),
    (2.1, -0.25), (2.5, -0.25), (2.6, 0.15), (3.2, 0.15), (3.3, -0.15), (3.9, -0.15), (4.0, 0.0), (4.2, 0.0),
)  # fmt: skip
#: A train of short pulses.
PULSES: Corners = (
    (0.0, 0.0),
    *(corner for k in range(4) for corner in (
        (0.1 + 0.5 * k, 0.0), (0.1 + 0.5 * k, 1.0), (0.25 + 0.5 * k, 1.0), (0.25 + 0.5 * k, 0.0),
        (0.4 + 0.5 * k, 0.0), (0.4 + 0.5 * k, -1.0), (0.46 + 0.5 * k, -1.0), (0.46 + 0.5 * k, 0.0),
    )),
    (2.2, 0.0),
)  # fmt: skip
#: Partial openings of another shape.
GENTLE: Corners = (
    (0.0, 0.0), (0.1, 0.0), (0.4, 0.4), (0.7, 0.1), (1.0, -0.3), (1.3, 0.0), (1.5, 0.45), (1.8, 0.2),
    (2.0, -0.35), (2.3, -0.1), (2.6, 0.2), (2.9, 0.2), (3.0, 0.0), (3.4, 0.0),
)  # fmt: skip
#: What is to be predicted from a test: other moves, no wider open than it was.
OTHER = {STEPS: PULSES, RESTS: PULSES, PULSES: STEPS, PARTIAL: GENTLE}


def command_at(time: Array, corners: Corners) -> Array:
    """The command, at a jump already what follows."""
    times, values = (np.array(column) for column in zip(*corners, strict=True))
    # A time on the grid may be rounded to just before the jump that happens then.
    return np.interp(time + 1e-9, times, values)
