"""Requests and answer of ``/api/inverse``: pressure, contraction or stroke for a requirement."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.quantity import Contraction, Length, Load, PositivePressure, Pressure, Temperature
from mckibben.documents.strict import Strict
from mckibben.server.schemas.curves import Direction


class _Question(Strict):
    muscle: MuscleInput = Field(description="The muscle.")
    effects: EffectsInput | None = Field(
        None, description="The effects of its model; null: those of the preset."
    )
    temperature: Temperature = Field(293.15, description="Temperature of the muscle.")


class PressureQuestion(_Question):
    """The pressure for a force at a length or contraction."""

    question: Literal["pressure"] = Field(description="Asks for a pressure.")
    force: Load = Field(description="The required force.")
    length: Length | None = Field(None, description="The length; or give the contraction.")
    contraction: Contraction | None = Field(None, description="The contraction; or give the length.")
    direction: Direction = 0


class ContractionQuestion(_Question):
    """The contraction at a force and pressure."""

    question: Literal["contraction"] = Field(description="Asks for a contraction.")
    force: Load = Field(description="The force of the muscle.")
    pressure: Pressure = Field(description="Gauge pressure in the muscle.")
    direction: Direction = 0


class WorkingRangeQuestion(_Question):
    """The stroke from the preload without pressure to the load at the highest pressure.

    The start is taken while venting and the end while filling.
    """

    question: Literal["working_range"] = Field(description="Asks for the stroke between two loads.")
    load: Load = Field(description="Load at the end of the stroke.")
    pressure: PositivePressure = Field(description="The highest gauge pressure.")
    preload: Load = Field(0.0, description="Load at the start of the stroke.")


class StrokePressureQuestion(_Question):
    """The pressure that lifts a load by a stroke, while filling."""

    question: Literal["stroke_pressure"] = Field(description="Asks for the pressure of a stroke.")
    load: Load = Field(description="The load to lift.")
    stroke: Length = Field(description="From the rest length.")


InverseRequest = Annotated[
    PressureQuestion | ContractionQuestion | WorkingRangeQuestion | StrokePressureQuestion,
    Field(discriminator="question"),
]
