"""Inverse questions: which pressure, which contraction, which range."""

from __future__ import annotations

from typing import assert_never

from mckibben.application.start import Json, flags_json, start_flags
from mckibben.documents.convert import given_muscle
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.server.schemas.inverse import (
    ContractionQuestion,
    PressureQuestion,
    StrokePressureQuestion,
    WorkingRangeQuestion,
)
from mckibben.simulation.statics import inverse
from mckibben.simulation.statics.model import StaticModel

Question = PressureQuestion | ContractionQuestion | WorkingRangeQuestion | StrokePressureQuestion


def inverse_answer(request: Question, studio: Studio) -> Json:
    """The answer to one question, with the limits it crosses.

    Raises:
        InputError: the muscle, an effect or the question cannot be used.
    """
    start = studio.start_model(given_muscle(request.muscle), request.effects)
    answer = _ask(request, studio.static_model(start))
    return {
        "question": request.question,
        "value": answer.value,
        "unit": answer.unit,
        "details": answer.details,
        "flags": [*start_flags(start), *flags_json(answer.flags)],
    }


def _ask(request: Question, model: StaticModel) -> inverse.InverseResult:
    temperature = request.temperature
    match request:
        case PressureQuestion():
            return inverse.pressure_for_force(
                model,
                force=request.force,
                length=_length(request, model),
                direction=request.direction,
                temperature=temperature,
            )
        case ContractionQuestion():
            return inverse.contraction_for_force(
                model,
                force=request.force,
                pressure=request.pressure,
                direction=request.direction,
                temperature=temperature,
            )
        case WorkingRangeQuestion():
            return inverse.working_range(
                model,
                load=request.load,
                pressure=request.pressure,
                preload=request.preload,
                temperature=temperature,
            )
        case StrokePressureQuestion():
            rest = model.muscle.nominal_length
            if request.stroke >= 0.95 * rest:
                raise InputError(
                    f"no muscle of {rest * 1e3:.4g} mm makes a stroke of {request.stroke * 1e3:.4g} mm",
                    field="stroke",
                    hint="muscles contract by up to about a quarter of their length",
                )
            return inverse.stroke_pressure(
                model,
                load=request.load,
                stroke=request.stroke,
                direction=request.direction,
                temperature=temperature,
            )
        case _:
            assert_never(request)


def _length(request: PressureQuestion, model: StaticModel) -> float:
    """The length asked about, given as such or as a contraction."""
    rest = model.muscle.nominal_length
    if (request.length is None) == (request.contraction is None):
        raise InputError(
            "give either the length or the contraction",
            field="length",
            hint='e.g. "contraction": "10 %"',
        )
    if request.length is not None:
        field, length = "length", request.length
    else:
        field, length = "contraction", rest * (1.0 - (request.contraction or 0.0))
    if length < 0.05 * rest:
        raise InputError(
            f"no muscle of {rest * 1e3:.4g} mm contracts to {length * 1e3:.4g} mm",
            field=field,
            hint="e.g. '10 %'",
        )
    return length
