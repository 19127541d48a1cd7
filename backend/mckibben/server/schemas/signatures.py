"""Request and answer of ``/api/signatures``: what an effect leaves in the residual of each kind of test."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.muscle import MuscleInput
from mckibben.documents.quantity import PositivePressure
from mckibben.documents.strict import Strict


class SignatureRequest(Strict):
    """An effect on a muscle."""

    muscle: MuscleInput = Field(description="The muscle.")
    effect: str = Field(description="Id of the effect.")
    values: dict[str, float] = Field(
        default_factory=dict, description="Its parameters in SI; missing ones take their usual size."
    )
    pressure: PositivePressure | None = Field(
        None, description="Largest gauge pressure of the tests; null: the muscle's limit, else 6 bar."
    )
