"""Answer of ``/api/studies``: the table of all runs, statistics, sensitivities, Pareto front."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.documents.study import Subject
from mckibben.server.schemas.common import streamed

_IN = "in the unit of the figure"


class StudyOptionsRequest(Strict):
    """Which subject."""

    subject: Subject = Field(description="What is to be studied.")


class StudyKeptAnswer(Strict):
    """What is kept of a study."""

    runs: int = Field(description="Runs that are kept from before.")


StudyEvents = streamed(
    '{"table": columns of new runs, "planned": runs of the plan, "kept": how many so far are from before} or '
    "absent; runs come as they end"
)
