"""Conversion of an inverse request."""

from __future__ import annotations

from typing import assert_never

from mckibben.application.inverse import (
    ContractionForForce,
    InverseQuestion,
    PressureForForce,
    PressureForStroke,
    WorkingRange,
)
from mckibben.documents.convert import stated_muscle
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
    direction, temperature = body.direction, body.temperature
    match body:
        case PressureQuestion():
            return PressureForForce(
                start=start, direction=direction, temperature=temperature,
                force=body.force, length=body.length, contraction=body.contraction,
            )  # fmt: skip
        case ContractionQuestion():
            return ContractionForForce(
                start=start, direction=direction, temperature=temperature,
                force=body.force, pressure=body.pressure,
            )  # fmt: skip
        case WorkingRangeQuestion():
            return WorkingRange(
                start=start, direction=direction, temperature=temperature,
                load=body.load, pressure=body.pressure, preload=body.preload,
            )  # fmt: skip
        case StrokePressureQuestion():
            return PressureForStroke(
                start=start, direction=direction, temperature=temperature,
                load=body.load, stroke=body.stroke,
            )  # fmt: skip
        case _:
            assert_never(body)
