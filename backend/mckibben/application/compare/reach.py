"""How far the runs of a compared model came."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from mckibben.facts.result import result_class
from mckibben.identification.predict.predictor import StoppedRun


@result_class
class RunReach:
    """How far the runs of the model came; all errors are of the rows that they reached."""

    status: Literal["complete", "partial", "failed"]
    """Whether they reached all rows, some, or none."""
    reason: str | None
    """Why the first one that stopped did; None where none did."""
    until: float | None
    """Time that it reached, from its first row on [s]; None where none stopped."""
    share: float
    """Share of the compared rows that were reached [-]."""


def reach_of(stopped: Sequence[StoppedRun]) -> RunReach:
    """How far the runs of a model came, from those that stopped."""
    if not stopped:
        return RunReach("complete", None, None, 1.0)
    first, share = stopped[0], max(1.0 - sum(run.share for run in stopped), 0.0)
    until = float(first.reached) if first.reached > 0.0 else 0.0
    return RunReach("partial" if share > 0.0 else "failed", first.reason, until, share)
