"""What a caller says about the experiment behind a measurement: values with units, and their origin.

Every field may be left out. A value is a quantity ("250 mm", or an SI number) or a text; or an object
``{"value": "250 mm", "origin": "suggested"}`` where it is not the user's own word: "suggested" is a proposal
of a preview that the user took over, "preset" was taken from a preset. Without it the origin is "you".
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, get_args

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from mckibben.documents.quantity import QuantityField
from mckibben.documents.strict import Strict
from mckibben.measurement.experiment import FIELDS, ExperimentValue, accuracy_values
from mckibben.physics.errors import InputError, did_you_mean

SaidOrigin = Literal["you", "suggested", "preset"]
_LONGEST_TEXT = 200


@dataclass(frozen=True, slots=True)
class Said:
    """A value in SI or a text, its SI unit ("" of a text), and who says it."""

    value: float | str
    unit: str
    origin: SaidOrigin = "you"


@dataclass(frozen=True)
class SaidQuantity:
    """Converts a value of an experiment; ``fields`` are the quantities that it can be, told apart by unit."""

    fields: tuple[QuantityField, ...]

    def __call__(self, value: object) -> Said:
        """The value in SI.

        Raises:
            InputError: not a finite number, an unknown or wrong unit, or out of bounds.
        """
        value, origin = _taken_apart(value)
        if len(self.fields) > 1 and not isinstance(value, str):
            units = " or ".join(field.unit for field in self.fields)
            raise InputError(f"must have a unit, {units}", hint=f"e.g. '{self.fields[0].example}'")
        errors = []
        for field in self.fields:
            try:
                return Said(field(value), field.unit, origin)
            except InputError as error:
                errors.append(error)
        fitting = [error for error in errors if str(error).startswith("must be")]
        raise (fitting or errors)[0]

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validation by `__call__`."""
        return core_schema.no_info_plain_validator_function(
            self, serialization=core_schema.plain_serializer_function_ser_schema(_as_given)
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Number or text, or an object with its origin; the SI unit as ``unit``."""
        plain: list[dict[str, Any]] = [{"type": "string", "minLength": 1, "maxLength": _LONGEST_TEXT}]
        if len(self.fields) == 1:
            plain.insert(0, {"type": "number"})
        return {
            "anyOf": [*plain, _with_origin({"anyOf": plain})],
            "unit": " or ".join(field.unit for field in self.fields),
            "examples": [field.example for field in self.fields],
        }


@dataclass(frozen=True)
class SaidText:
    """A text of an experiment, one of ``choices`` where there are any."""

    example: str
    choices: tuple[str, ...] = ()

    def __call__(self, value: object) -> Said:
        """The text.

        Raises:
            InputError: not a text, an empty or too long one, or none of the choices.
        """
        value, origin = _taken_apart(value)
        if not isinstance(value, str) or not value.strip() or len(value) > _LONGEST_TEXT:
            raise InputError(
                f"must be a text of 1 to {_LONGEST_TEXT} characters", hint=f"e.g. '{self.example}'"
            )
        text = re.sub(r"\s+", " ", value.strip())
        if self.choices and text not in self.choices:
            raise InputError(f"'{text[:80]}' is not known", hint=did_you_mean(text, self.choices))
        return Said(text, "", origin)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validation by `__call__`."""
        return core_schema.no_info_plain_validator_function(
            self, serialization=core_schema.plain_serializer_function_ser_schema(_as_given)
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Text, or an object with its origin."""
        text: dict[str, Any] = {"type": "string", "minLength": 1, "maxLength": _LONGEST_TEXT}
        if self.choices:
            text["enum"] = list(self.choices)
        return {"anyOf": [text, _with_origin(text)], "examples": [self.example]}


def _taken_apart(value: object) -> tuple[object, SaidOrigin]:
    if not isinstance(value, Mapping):
        return value, "you"
    for key in value:
        if key not in ("value", "origin"):
            raise InputError(f"'{key}' is not known", hint='e.g. {"value": "250 mm", "origin": "suggested"}')
    origin = value.get("origin", "you")
    if origin not in get_args(SaidOrigin):
        raise InputError(f"the origin '{origin}' is not known", hint="you, suggested or preset")
    if "value" not in value:
        raise InputError("has no value", hint='e.g. {"value": "250 mm", "origin": "suggested"}')
    return value["value"], origin


def _with_origin(value: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": {
            "value": {**value, "description": "The value itself."},
            "origin": {"enum": list(get_args(SaidOrigin)), "description": "Who says it. Default: you."},
        },
        "required": ["value"],
        "additionalProperties": False,
    }


def _as_given(said: Said) -> Any:
    text = said.value if isinstance(said.value, str) else f"{said.value!r} {said.unit}".strip()
    return {"value": text, "origin": said.origin}


_METRES = QuantityField("m", "250 mm", above=0.0, at_most=1e3)
_MASS = QuantityField("kg", "3 kg", at_least=0.0, at_most=1e5)
_LOAD_FORCE = QuantityField("N", "60 N", at_least=0.0, at_most=1e9)
_SUPPLY = QuantityField("Pa", "6 bar", above=0.0, at_most=1e8, reference="gauge")
_INCLINATION = QuantityField("rad", "90 deg", at_least=-1.5707963268, at_most=1.5707963268)
_FORCE_ZERO = QuantityField("N", "2.5 N", at_least=-1e6, at_most=1e6)
_PRESSURE_ZERO = QuantityField("Pa", "20 mbar", at_least=-1e7, at_most=1e7)

RestLength = Annotated[Said, SaidQuantity((_METRES,))]
LoadSaid = Annotated[Said, SaidQuantity((_MASS, _LOAD_FORCE))]
SupplySaid = Annotated[Said, SaidQuantity((_SUPPLY,))]
InclinationSaid = Annotated[Said, SaidQuantity((_INCLINATION,))]
ForceZero = Annotated[Said, SaidQuantity((_FORCE_ZERO,))]
PressureZero = Annotated[Said, SaidQuantity((_PRESSURE_ZERO,))]
MuscleSaid = Annotated[Said, SaidText("DMSP-20")]
ValveSaid = Annotated[Said, SaidText("MPYE-5-1/8-HF")]
TubeSaid = Annotated[Said, SaidText("4 mm x 1 m")]
LeverSaid = Annotated[Said, SaidText("30 mm")]
ContractionSaid = Annotated[Said, SaidQuantity((QuantityField("1", "10 %", at_least=-0.2, at_most=0.4),))]
StopsSaid = Annotated[Said, SaidText("0 % to 25 %")]
FixedEnd = Annotated[Said, SaidText("upper", ("upper", "lower", "both"))]
AccuracySaid = Annotated[Said, SaidText("length 1 mm, force 0.5 %, pressure 20 mbar")]


class ExperimentInput(Strict):
    """What the user says about the experiment behind one measurement; it takes precedence over the file."""

    muscle: MuscleSaid | None = Field(
        None, description="Id of the preset of this specimen. Default: the file's, else that of the request."
    )
    rest_length: RestLength | None = Field(
        None,
        description="Length of this specimen without air and load. Default: the file's, else the length of "
        "the request's muscle; the preset's default is assumed and the answer says so.",
    )
    load: LoadSaid | None = Field(
        None, description="A mass or a force. Default: the file's, else the drive's."
    )
    supply: SupplySaid | None = Field(None, description="Supply pressure, gauge. Default: file, drive.")
    valve: ValveSaid | None = Field(None, description="Id of a valve preset. Default: the drive's.")
    tube: TubeSaid | None = Field(
        None, description='Id of a tube preset, "4 mm x 1 m" or "none". Default: the drive\'s.'
    )
    stops: StopsSaid | None = Field(
        None, description="Contractions between which the load can move. Default: the drive's."
    )
    inclination: InclinationSaid | None = Field(
        None, description="Angle between the motion of the load and the horizontal. Default: drive, 90 deg."
    )
    lever: LeverSaid | None = Field(
        None,
        description='Lever of the muscle at a joint: "30 mm", or a formula of the angle in rad that gives m, '
        '"0.03 - 0.005*angle**2"; negative for a muscle that turns to smaller angles. The second muscle of a '
        "pair has the mirrored path.",
    )
    contraction_at_zero: ContractionSaid | None = Field(
        None, description="Contraction of the muscle at the angle 0; of both muscles of a pair. Default: 0."
    )
    fixed_end: FixedEnd | None = Field(
        None, description="Which end of the muscle is fixed. It is recorded; no figure depends on it."
    )
    force_zero: ForceZero | None = Field(
        None, description="Reading of the force sensor without force; it is subtracted."
    )
    pressure_zero: PressureZero | None = Field(
        None, description="Reading of the pressure sensor at atmospheric pressure; it is subtracted."
    )
    accuracy: AccuracySaid | None = Field(
        None,
        description="Standard deviation of each channel, as 'length 1 mm, force 0.5 %, pressure 20 mbar' "
        "(% of the largest value), or a sensor: 'length steel rule'. Default: that of the request.",
    )


def stated_experiment(
    values: ExperimentInput | None, field: str = "experiment"
) -> dict[str, ExperimentValue]:
    """The values of an input, by the fields of an experiment.

    Args:
        values: the input.
        field: its path in the request, for errors and as the place of the values.

    Raises:
        InputError: an accuracy that cannot be read.
    """
    if values is None:
        return {}
    found: dict[str, ExperimentValue] = {}
    for name in FIELDS:
        said: Said | None = getattr(values, name, None)
        if said is not None:
            found[name] = ExperimentValue(said.value, said.unit, said.origin, f"{field}.{name}")
    if values.accuracy is not None:
        found |= stated_accuracy(str(values.accuracy.value), f"{field}.accuracy", values.accuracy.origin)
    return found


def stated_accuracy(text: str | None, field: str, origin: SaidOrigin = "you") -> dict[str, ExperimentValue]:
    """The fields of an accuracy in words; none without a text.

    Raises:
        InputError: a channel, quantity or sensor that is not known.
    """
    if text is None:
        return {}
    try:
        return accuracy_values(text, origin, field)
    except InputError as error:
        raise error.at(field) from error
