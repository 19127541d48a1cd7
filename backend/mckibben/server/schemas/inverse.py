"""Requests and answer of ``/api/inverse``: which pressure, which length, which range."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.quantity import Contraction, Length, Load, PositivePressure, Pressure, Temperature
from mckibben.documents.strict import Strict
from mckibben.server.schemas.common import Flag
from mckibben.server.schemas.curves import Direction


class _Question(Strict):
    muscle: MuscleInput
    effects: EffectsInput | None = None
    temperature: Temperature = Field(293.15, description="Temperature of the muscle.")
    direction: Direction = 0


class PressureQuestion(_Question):
    """Which pressure gives this force at this length (or contraction)?"""

    question: Literal["pressure"]
    force: Load = Field(description="The force wanted.")
    length: Length | None = Field(None, description="The length; or give the contraction.")
    contraction: Contraction | None = Field(None, description="The contraction; or give the length.")


class ContractionQuestion(_Question):
    """How far is the muscle contracted at this force and pressure?"""

    question: Literal["contraction"]
    force: Load = Field(description="The force held.")
    pressure: Pressure


class WorkingRangeQuestion(_Question):
    """Which stroke is there from the preload without pressure to the load at the highest pressure?

    It begins venting and ends filling, whatever ``direction`` says.
    """

    question: Literal["working_range"]
    load: Load
    pressure: PositivePressure = Field(description="The highest gauge pressure.")
    preload: Load = Field(0.0, description="Load at the start of the stroke.")


class StrokePressureQuestion(_Question):
    """Which pressure lifts this load by this stroke?"""

    question: Literal["stroke_pressure"]
    load: Load
    stroke: Length = Field(description="From the nominal length.")
    direction: Direction = -1


InverseRequest = Annotated[
    PressureQuestion | ContractionQuestion | WorkingRangeQuestion | StrokePressureQuestion,
    Field(discriminator="question"),
]


class InverseAnswer(Strict):
    """The value asked for, in SI, with what to know about it."""

    question: Literal["pressure", "contraction", "working_range", "stroke_pressure"]
    value: float | None = Field(description="The answer; null when there is none (a flag says why).")
    unit: str = Field(description="SI unit of the value.", examples=["Pa"])
    details: dict[str, float | None] = Field(description="Further figures in SI.")
    flags: list[Flag]
