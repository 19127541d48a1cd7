"""Request of ``/api/reports``: a comparison, with or without a diagnosis, to be written down."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.strict import Strict
from mckibben.server.schemas.comparisons import ComparisonRequest, ParameterPath


class HistoryStep(Strict):
    """A model on the way to the one of the report."""

    label: str = Field(max_length=200, examples=["start model"])
    effects: EffectsInput | None = Field(None, description="As in the request itself.")
    freed: list[ParameterPath] = Field(default=[], max_length=64)
    muscle: MuscleInput | None = Field(None, description="Null: that of the request.")


class ReportRequest(ComparisonRequest):
    """What a comparison takes, and what else the report tells."""

    history: list[HistoryStep] = Field(default=[], max_length=32, description="The oldest first.")
    title: str = Field("", max_length=200, description="Empty: names of the measurements.")
    diagnose: bool = Field(True, description="Find out what the model is missing; takes some seconds.")


ReportAnswer: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "One HTML file that needs nothing else.",
        "content": {"text/html": {"schema": {"type": "string"}}},
    }
}
