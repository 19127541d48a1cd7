"""Requests of ``/api/curves``, ``/api/inverse`` and ``/api/joints``: muscles and joints at rest."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mckibben.documents import inverse
from mckibben.documents.inverse import Direction
from mckibben.documents.joint import JointDocument
from mckibben.documents.joint_question import JointQuestionInput
from mckibben.documents.muscle import EffectsInput, Muscle
from mckibben.documents.quantity import (
    Contraction,
    Length,
    Load,
    Pressure,
    Temperature,
    Volume,
)
from mckibben.documents.shorthand import LIST_TEXT
from mckibben.documents.strict import Strict

_DEFAULT_PRESSURES = [1e5, 2e5, 3e5, 4e5, 5e5, 6e5]


class AskedRequest(Strict):
    """A question typed in one line."""

    text: str = Field(description="The line.", max_length=300)


class CurvesOptions(Strict):
    """Pressures, range and conditions of the curves."""

    pressures: Annotated[list[Pressure], Field(min_length=1, max_length=12), LIST_TEXT] = Field(
        default=_DEFAULT_PRESSURES, description="Gauge pressures of the curves."
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
    at_pressure: Pressure | None = Field(
        None,
        description="Gauge pressure at which the load is asked about: how far it is lifted, how stiffly.",
    )
    at_contraction: Contraction | None = Field(
        None, description="The contraction whose pressure is asked for, under the load."
    )


class CurvesRequest(CurvesOptions):
    """A muscle, and the pressures and range of its curves."""

    muscle: Muscle = Field(description="The muscle.")
    effects: EffectsInput | None = Field(
        None, description="The effects of its model; null: those of the preset."
    )


class _OfMuscle(Strict):
    muscle: Muscle = Field(description="The muscle.")
    effects: EffectsInput | None = Field(
        None, description="The effects of its model; null: those of the preset."
    )


class PressureQuestion(_OfMuscle, inverse.PressureQuestion):
    """The pressure for a force at a length or contraction."""


class ContractionQuestion(_OfMuscle, inverse.ContractionQuestion):
    """The contraction at a force and pressure."""


class WorkingRangeQuestion(_OfMuscle, inverse.WorkingRangeQuestion):
    """The stroke from the preload without pressure to the load at the highest pressure.

    The start is taken while venting and the end while filling.
    """


class StrokePressureQuestion(_OfMuscle, inverse.StrokePressureQuestion):
    """The pressure that lifts a load by a stroke, while filling."""


class JointRequest(JointQuestionInput):
    """A joint, and what is asked of it."""

    joint: JointDocument = Field(description="The joint.")


InverseRequest = Annotated[
    PressureQuestion | ContractionQuestion | WorkingRangeQuestion | StrokePressureQuestion,
    Field(discriminator="question"),
]
