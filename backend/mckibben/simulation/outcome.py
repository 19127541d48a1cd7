"""How a run ends, and how the caller or a time limit ends it early."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from typing import Literal, cast

MAX_STEPS = 400_000  # accepted and rejected steps of a run, unless its caller states another limit
_PROGRESS_EVERY = 0.1  # s


#: Short names of the outcomes, for programs.
OutcomeName = Literal["completed", "stuck", "diverged", "timed_out", "cancelled"]


class Outcome(Enum):
    """How a run ended; the value is advice for the user, see `advice`."""

    COMPLETED = "completed"
    STUCK = (
        "The solver needed more than {steps} steps: the drive chatters. Shorten the duration, lower the "
        "controller's gains, or give the load more mass."
    )
    DIVERGED = (
        "The solution left what a muscle can do. Check the load against the blocked force, the end stops and "
        "the volume of the muscle."
    )
    TIMED_OUT = (
        "The run took too long and was stopped. Shorten the duration, sample the controller less often, or "
        "remove the fastest effects."
    )
    CANCELLED = "The run was cancelled."

    def advice(self, steps: int = MAX_STEPS) -> str:
        """Why the run ended and what helps, for the user.

        Args:
            steps: the most steps that the run was allowed.
        """
        return self.value.format(steps=f"{steps:,}".replace(",", " "))

    @property
    def label(self) -> OutcomeName:
        """Short name for programs."""
        return cast(OutcomeName, self.name.lower())


@dataclass
class Watch:
    """Lets the caller follow a running computation and end it.

    Attributes:
        cancelled: returns whether the caller has cancelled the run.
        progress: called with the share of the run that is done, a few times a second.
        found: called with intermediate results as JSON.
        time_limit: processor time of this process from the first call of `ended` on [s]: the same work on a
            busy machine. What must have one answer, such as a run or the design of a controller, has none: it
            is bounded in steps.
    """

    cancelled: Callable[[], bool] | None = None
    progress: Callable[[float], None] | None = None
    found: Callable[[object], None] | None = None
    time_limit: float = float("inf")
    _began: float | None = field(default=None, init=False, repr=False)
    _told: float = field(default=0.0, init=False, repr=False)

    def ended(self, share: float) -> Outcome | None:
        """Why the run must end now; None to go on. ``share`` of it is done."""
        now, work = time.monotonic(), time.process_time()
        if self._began is None:
            self._began, self._told = work, now
        if self.cancelled is not None and self.cancelled():
            return Outcome.CANCELLED
        if work - self._began > self.time_limit:
            return Outcome.TIMED_OUT
        if self.progress is not None and now - self._told > _PROGRESS_EVERY:
            self._told = now
            self.progress(share)
        return None
