"""Request of ``/api/sizings/reports``: a task and the rank of the proposal to report."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.documents.task import SizingTask


class SizingReportRequest(Strict):
    """The search runs again, so that no figure of the report comes from the caller."""

    task: SizingTask = Field(description="As for `/api/sizings`.")
    proposal: Annotated[int, Field(ge=1, le=30)] = Field(
        1, description="Rank of the proposal, 1 the best. A task without proposals also has a report."
    )
    title: str = Field(
        "", max_length=200, description="Name beside the figures of the task. Empty = that of the task."
    )
