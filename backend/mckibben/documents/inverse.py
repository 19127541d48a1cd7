"""Inverse questions of a muscle as documents, the same in a request, in options and in Python."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field, TypeAdapter, ValidationError

from mckibben.documents.problems import first_problem
from mckibben.documents.quantity import Contraction, Length, Load, PositivePressure, Pressure, Temperature
from mckibben.documents.strict import Strict
from mckibben.physics.errors import InputError

Direction = Annotated[
    Literal[-1, 0, 1],
    Field(description="Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none."),
]


class _Question(Strict):
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


InverseDocument = PressureQuestion | ContractionQuestion | WorkingRangeQuestion | StrokePressureQuestion
_READER: TypeAdapter[InverseDocument] = TypeAdapter(
    Annotated[InverseDocument, Field(discriminator="question")]
)
_KINDS: dict[str, type[Strict]] = {
    "pressure": PressureQuestion, "contraction": ContractionQuestion,
    "working_range": WorkingRangeQuestion, "stroke_pressure": StrokePressureQuestion,
}  # fmt: skip


def read_inverse(document: Mapping[str, object]) -> InverseDocument:
    """An inverse question from its fields; those that are None are not stated.

    Raises:
        InputError: what is wrong, with ``field`` the name of the field.
    """
    stated = {name: value for name, value in document.items() if value is not None}
    try:
        return _READER.validate_python(stated)
    except ValidationError as error:
        problem = first_problem(error.errors(), None, stated, "the question")
        kind = _KINDS.get(str(stated.get("question")))
        takes = None if kind is None else f"'{stated['question']}' takes {', '.join(_fields_of(kind))}"
        raise InputError(problem.message, field=problem.field, hint=problem.hint or takes) from error


def _fields_of(kind: type[Strict]) -> list[str]:
    """The fields that a question can state."""
    return [name for name in kind.model_fields if name != "question"]
