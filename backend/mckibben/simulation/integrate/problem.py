"""What an integrator is given, and what it returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.simulation.integrate.system import CompiledDrive
from mckibben.simulation.outcome import Outcome

FIRST_STEP = 1e-4  # s
SLOWEST_REBOUND = 1e-3  # m/s; an impact that would leave less leaves the load at rest on its stop
LOWEST_REBOUND = 1e-7  # m; a lower one would be a matter of rounding, and leaves the load at rest too
MOST_EVENTS = 1024  # events of a run that are kept
EVENT_WIDTH = 5  # see `Solution.events`


@dataclass(frozen=True, kw_only=True, eq=False)
class Problem:
    """A run for an integrator.

    Attributes:
        drive: the compiled structure.
        constants: of the run, as the codes take them.
        stops: stroke of the end stop of each switch [m], NaN for others.
        restitution: share of the speed that an impact on an end stop leaves, in the opposite direction.
        state, switches: at the start; integrators overwrite them.
        times: segment boundaries.
        inputs: of each segment.
        grid: times of the rows.
        tolerance: relative error per step.
    """

    drive: CompiledDrive
    constants: np.ndarray
    stops: np.ndarray
    restitution: float
    state: np.ndarray
    switches: np.ndarray
    times: np.ndarray
    inputs: np.ndarray
    grid: np.ndarray
    tolerance: float

    @property
    def absolute(self) -> np.ndarray:
        """Absolute error per step of each state."""
        return self.tolerance * self.drive.scales


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
        outcome, steps, rejected, engine: how the run went.
        next_step: step to try next [s].
    """

    rows: np.ndarray
    end: np.ndarray
    switches: np.ndarray
    events: np.ndarray
    outcome: Outcome
    steps: int
    rejected: int
    engine: Literal["rodas", "lsoda"]
    next_step: float = FIRST_STEP


def outcome_of(status: int) -> Outcome:
    """The outcome that corresponds to a status of the kernel."""
    return {0: Outcome.COMPLETED, 2: Outcome.STUCK}.get(int(status), Outcome.DIVERGED)
