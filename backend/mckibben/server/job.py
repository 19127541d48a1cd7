"""What a job of the server is: from the body of a request to the bytes of the answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore
from mckibben.simulation.outcome import Watch

#: What is left to do when a job is prepared: the bytes of the answer.
Prepared = Callable[[Watch], bytes]
#: Which processes do a job: those of long work, those that read files, those of models with typed terms.
LaneName = Literal["long", "files", "models"]
TIME_LIMIT = 10.0  # s, of a job that states no other
#: Of work that is bounded in steps: it must end by itself, with the same answer however busy the machine is.
LONGEST = 900.0  # s
_OVERTIME = 10.0  # s beyond its own time limit after which a job is ended


@dataclass(frozen=True, slots=True)
class Job:
    """One kind of work.

    Attributes:
        prepare: reads and checks; raises `InputError` for what cannot be used.
        time_limit: processor time after which it ends by itself, with what it has found where it can, or is
            ended where it does not look at the time [s].
        lane: of the processes that do it.
        looks: whether it looks at the time.
        hint: how it would take less time or memory, by what its question has.
    """

    prepare: Callable[[Any, Studio, MeasurementStore], Prepared]
    time_limit: float = TIME_LIMIT
    lane: LaneName = "long"
    looks: bool = True
    hint: str | None = None

    @property
    def ended_after(self) -> float:
        """Processor time after which its process is ended [s]."""
        return self.time_limit + _OVERTIME if self.looks else self.time_limit
