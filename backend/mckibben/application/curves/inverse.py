"""Inverse problems: pressure, contraction or stroke for a given force or load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal, assert_never

from mckibben.application.muscle_summary import Notice, limit_notices, start_notices
from mckibben.application.operating_limits import load_notices, pressure_notices, temperature_notices
from mckibben.documents.inverse import (
    ContractionQuestion,
    InverseDocument,
    PressureQuestion,
    StrokePressureQuestion,
    WorkingRangeQuestion,
)
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.facts.muscle import branch_of
from mckibben.facts.result import result_class
from mckibben.physics.errors import InputError
from mckibben.simulation.statics import inverse
from mckibben.simulation.statics.characteristics import FILLING, VENTING
from mckibben.simulation.statics.model import StaticModel

QuestionName = Literal["pressure", "contraction", "working_range", "stroke_pressure"]

_LONGEST_STROKE = 0.95  # largest stroke accepted, share of the rest length
_SHORTEST = 0.05  # shortest length accepted, share of the rest length


@dataclass(frozen=True, slots=True)
class MuscleCondition:
    """The muscle and its temperature [K]."""

    start: StartModel
    temperature: float = 293.15


@dataclass(frozen=True, slots=True, kw_only=True)
class PressureForForce:
    """Which pressure gives this force [N] at this length [m] or contraction? Exactly one of them is given.

    ``direction`` is the sign of dL/dt, for friction.
    """

    NAME: ClassVar[QuestionName] = "pressure"

    condition: MuscleCondition
    force: float
    length: float | None = None
    contraction: float | None = None
    direction: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ContractionForForce:
    """How far is the muscle contracted at this force [N] and gauge pressure [Pa]?

    ``direction`` is the sign of dL/dt, for friction.
    """

    NAME: ClassVar[QuestionName] = "contraction"

    condition: MuscleCondition
    force: float
    pressure: float
    direction: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkingRange:
    """Which stroke from the preload [N] without pressure to the load [N] at the highest pressure [Pa]?

    It starts on the branch of venting and ends on that of filling.
    """

    NAME: ClassVar[QuestionName] = "working_range"

    condition: MuscleCondition
    load: float
    pressure: float
    preload: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PressureForStroke:
    """Which pressure lifts this load [N] by this stroke [m] from the rest length, while filling?"""

    NAME: ClassVar[QuestionName] = "stroke_pressure"

    condition: MuscleCondition
    load: float
    stroke: float


InverseQuestion = PressureForForce | ContractionForForce | WorkingRange | PressureForStroke


def question_of_document(document: InverseDocument, start: StartModel) -> InverseQuestion:
    """The question that a document asks of a muscle."""
    condition = MuscleCondition(start, document.temperature)
    match document:
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
            assert_never(document)


@result_class
class InverseFinding:
    """The answer to an inverse question; `mckibben.facts.muscle.INVERSE` says what each is."""

    question: QuestionName
    """The question that was asked."""
    value: float | None
    """The answer; NaN without a solution, with a flag that gives the reason."""
    unit: str
    """SI unit of the value."""
    branch: str
    """Which way friction acts in the answer."""
    details: Mapping[str, float | None]
    """Further figures in SI, those of `mckibben.facts.muscle.INVERSE_DETAILS`."""
    flags: list[Notice]
    """Remarks on the answer."""


def answer(question: InverseQuestion, studio: Studio) -> InverseFinding:
    """The answer to one question, with the limits that it exceeds.

    Raises:
        InputError: invalid muscle, effect or question; names the field of the question.
    """
    start = question.condition.start
    solution = _solve(question, studio.slow_model(start))
    return InverseFinding(
        question=question.NAME,
        value=solution.value,
        unit=solution.unit,
        branch=_branch(question),
        details=solution.details,
        flags=[
            *start_notices(start),
            *limit_notices(solution.flags),
            *pressure_notices({"pressure": getattr(question, "pressure", 0.0)}),
            *load_notices(start, getattr(question, "load", None)),
            *temperature_notices(start, question.condition.temperature, "temperature"),
        ],
    )


def _branch(question: InverseQuestion) -> str:
    match question:
        case WorkingRange():
            return f"start {branch_of(VENTING)}, end {branch_of(FILLING)}"
        case PressureForStroke():
            return branch_of(FILLING)
        case _:
            return branch_of(question.direction)


def _solve(question: InverseQuestion, model: StaticModel) -> inverse.InverseResult:
    temperature = question.condition.temperature
    match question:
        case PressureForForce(force=force, direction=direction):
            length = _length(question, model)
            return inverse.pressure_for_force(
                model, force=force, length=length, direction=direction, temperature=temperature
            )
        case ContractionForForce(force=force, pressure=pressure, direction=direction):
            return inverse.contraction_for_force(
                model, force=force, pressure=pressure, direction=direction, temperature=temperature
            )
        case WorkingRange(load=load, pressure=pressure, preload=preload):
            return inverse.working_range(
                model, load=load, pressure=pressure, preload=preload, temperature=temperature
            )
        case PressureForStroke(load=load, stroke=stroke):
            rest = model.muscle.nominal_length
            if stroke >= _LONGEST_STROKE * rest:
                raise InputError(
                    f"no muscle of {rest * 1e3:.4g} mm makes a stroke of {stroke * 1e3:.4g} mm",
                    field="stroke",
                    hint="muscles contract by up to about a quarter of their length",
                )
            return inverse.stroke_pressure(model, load=load, stroke=stroke, temperature=temperature)
        case _:
            assert_never(question)


def _length(question: PressureForForce, model: StaticModel) -> float:
    """The length of the question, given directly or as a contraction."""
    rest = model.muscle.nominal_length
    if question.length is not None and question.contraction is None:
        field, length = "length", question.length
    elif question.contraction is not None and question.length is None:
        field, length = "contraction", rest * (1.0 - question.contraction)
    else:
        raise InputError(
            "give either the length or the contraction",
            field="length",
            hint='e.g. "contraction": "10 %"',
        )
    if length < _SHORTEST * rest:
        raise InputError(
            f"no muscle of {rest * 1e3:.4g} mm contracts to {length * 1e3:.4g} mm",
            field=field,
            hint="e.g. '10 %'",
        )
    return length
