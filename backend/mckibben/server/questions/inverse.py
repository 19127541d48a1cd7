"""Conversion of an inverse request."""

from __future__ import annotations

from typing import assert_never

from mckibben.application.curves.inverse import (
    ContractionForForce,
    InverseQuestion,
    MuscleCondition,
    PressureForForce,
    PressureForStroke,
    WorkingRange,
)
from mckibben.documents.start_model import stated_muscle
from mckibben.documents.studio import Studio
from mckibben.server.schemas.inverse import (
    ContractionQuestion,
    PressureQuestion,
    StrokePressureQuestion,
    WorkingRangeQuestion,
)

Body = PressureQuestion | ContractionQuestion | WorkingRangeQuestion | StrokePressureQuestion


def inverse_question(body: Body, studio: Studio) -> InverseQuestion:
    """The question of a request.

    Raises:
        InputError: an unknown preset, effect or parameter, or no complete muscle.
    """
    start = studio.start_model(stated_muscle(body.muscle), body.effects)
    condition = MuscleCondition(start, body.temperature)
    match body:
        case PressureQuestion(force=force, length=length, contraction=contraction, direction=direction):
            return PressureForForce(
                condition=condition, force=force, length=length, contraction=contraction, direction=direction
            )
        case ContractionQuestion(force=force, pressure=pressure, direction=direction):
            return ContractionForForce(
                condition=condition, force=force, pressure=pressure, direction=direction
            )
        case WorkingRangeQuestion(load=load, pressure=pressure, preload=preload):
            return WorkingRange(condition=condition, load=load, pressure=pressure, preload=preload)
        case StrokePressureQuestion(load=load, stroke=stroke):
            return PressureForStroke(condition=condition, load=load, stroke=stroke)
        case _:
            assert_never(body)
