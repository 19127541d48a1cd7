"""Request and answer of ``/api/diagnoses``: which physical effect a model is missing."""

from __future__ import annotations

from mckibben.server.schemas.common import streamed
from mckibben.server.schemas.comparisons import ModelRequest


class DiagnosisRequest(ModelRequest):
    """The start model and the measurements to explain."""


DiagnosisEvents = streamed("a candidate or null")
