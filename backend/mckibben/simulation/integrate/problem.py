"""Limits of a run, and what the integrator returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.simulation.outcome import Outcome

FIRST_STEP = 1e-4  # s
SLOWEST_REBOUND = 1e-3  # m/s; an impact that would leave less leaves the load at rest on its stop
LOWEST_REBOUND = 1e-7  # m; a lower one would be a matter of rounding, and leaves the load at rest too
MOST_EVENTS = 1024  # events of a run that are kept
EVENT_WIDTH = 5  # see `Solution.events`


def bounce_of(restitution: float) -> np.ndarray:
    """Restitution, slowest rebound, stiffness of guards of lengths and lowest rebound, for the kernels."""
    return np.array([restitution, SLOWEST_REBOUND, GUARD_STIFFNESS, LOWEST_REBOUND])


@dataclass(frozen=True)
class Solution:
    """Rows of states and outputs on the grid, and how the run went.

    Attributes:
        rows: shape (rows, states + outputs).
        end, switches: states and switches at the end.
        events: changes of switches and impacts, rows (instant, number of the switch, its new value, speed
            and acceleration just before).
        outcome, steps, rejected: how the run went.
        next_step: step to try next [s].
    """

    rows: np.ndarray
    end: np.ndarray
    switches: np.ndarray
    events: np.ndarray
    outcome: Outcome
    steps: int
    rejected: int
    next_step: float = FIRST_STEP


def outcome_of(status: int) -> Outcome:
    """The outcome that corresponds to a status of the kernel."""
    return {0: Outcome.COMPLETED, 2: Outcome.STUCK}.get(int(status), Outcome.DIVERGED)
