"""Requests of ``/api/curves`` and ``/api/inverse``: characteristics of one muscle, and inverse questions."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.quantity import (
    Contraction,
    Length,
    Load,
    PositivePressure,
    Pressure,
    Temperature,
    Volume,
)
from mckibben.documents.strict import Strict

Direction = Annotated[
    Literal[-1, 0, 1],
    Field(description="Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none."),
]
_DEFAULT_PRESSURES = [1e5, 2e5, 3e5, 4e5, 5e5, 6e5]


class CurvesOptions(Strict):
    """Pressures, range and conditions of the curves."""

    pressures: list[Pressure] = Field(
        default=_DEFAULT_PRESSURES, min_length=1, max_length=12, description="Gauge pressures of the curves."
    )
    points: int = Field(200, ge=2, le=400, description="Points along the length.")
    direction: Direction = 0
    temperature: Temperature = Field(293.15, description="Temperature of the muscle.")
    unclipped: bool = Field(False, description="Also negative forces, which a muscle cannot exert.")
    dead_volume: Volume = Field(0.0, description="Gas volume outside the muscle, for the closed valve.")
    polytropic_exponent: float = Field(1.4, ge=1.0, le=1.7, description="1 isothermal, 1.4 adiabatic (air).")
    contraction_from: Contraction | None = Field(
        None, description="Start of the range; null: the pretension limit."
    )
    contraction_to: Contraction | None = Field(
        None, description="End of the range; null: the largest free contraction."
    )
    load: Load | None = Field(None, description="Constant load, for the operating points.")
    fixed_length: Length | None = Field(None, description="Fixed length, for force over pressure.")
    further_stiffness: bool = Field(
        False, description="Also the stiffness that the force implies, and the secant stiffness."
    )


class CurvesRequest(CurvesOptions):
    """A muscle, and the pressures and range of its curves."""

    muscle: MuscleInput = Field(description="The muscle.")
    effects: EffectsInput | None = Field(
        None, description="The effects of its model; null: those of the preset."
    )


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
