"""Request of ``/api/reports``: a report of a comparison, with or without a diagnosis."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.strict import Strict
from mckibben.server.schemas.comparisons import ComparisonRequest, ParameterPath


class HistoryStep(Strict):
    """An earlier model in the user's history."""

    label: str = Field(
        max_length=200, examples=["start model"], description="What the model is called in the report."
    )
    effects: EffectsInput | None = Field(None, description="As in the request.")
    freed: list[ParameterPath] = Field(
        default=[], max_length=64, description="Additional parameters that were fitted, as effect.parameter."
    )
    muscle: MuscleInput | None = Field(None, description="Null: that of the request.")


class ReportRequest(ComparisonRequest):
    """A comparison request, with further content of the report."""

    history: list[HistoryStep] = Field(default=[], max_length=32, description="Oldest first.")
    title: str = Field("", max_length=200, description="Empty = names of the measurements.")
    diagnose: bool = Field(True, description="Include a diagnosis; takes some seconds.")


ReportAnswer: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "A self-contained HTML file.",
        "content": {"text/html": {"schema": {"type": "string"}}},
    }
}
