"""Request of ``/api/sizings/reports``: a task and which of its proposals to write down."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.documents.task import SizingTask


class SizingReportRequest(Strict):
    """The search is made again: no figure of the report comes from the caller."""

    task: SizingTask = Field(description="As for `/api/sizings`.")
    proposal: Annotated[int, Field(ge=1, le=30)] = Field(
        1, description="Rank of the proposal to write down, 1 the best. A task without any has a report too."
    )
    title: str = Field("", max_length=200, description="Empty: that of the task, else what it is about.")
