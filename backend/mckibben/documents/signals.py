"""Signals of time in requests: described in OpenAPI here, read by `mckibben.simulation.command.signals`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from mckibben.physics.errors import InputError
from mckibben.physics.units import MAX_TEXT_LENGTH, si
from mckibben.simulation.command.signals import MAX_SEGMENTS, SHAPES, SYNONYMS

_UNITS = {"time": "s", "share": "1", "frequency": "Hz", "angle": "rad"}
_REPLACES = {"amplitude": "level", "period": "frequency"}  # a key -> the key that it may replace
_FROM_THE_MIDDLE = "From the middle to the peak, half the height: offset - amplitude to offset + amplitude."
# (shape, key) -> what the key is in this shape.
_MEANING = {
    ("triangle", "amplitude"): "Peak to peak, the full height: offset to offset + amplitude.",
    ("square", "amplitude"): "Peak to peak, the full height: level - initial.",
    ("sine", "amplitude"): _FROM_THE_MIDDLE,
    ("chirp", "amplitude"): _FROM_THE_MIDDLE,
    ("chirp", "from"): "Frequency at the start.",
    ("chirp", "to"): "Frequency at the end of the duration and after it.",
    ("chirp", "duration"): "How long the frequency changes.",
    ("ramp", "from"): "The value before the ramp.",
    ("ramp", "to"): "The value after the ramp.",
    ("ramp", "duration"): "How long the ramp lasts.",
}
# A key -> what it is in every shape that `_MEANING` does not name.
_KEYS = {
    "at": "When it steps.",
    "level": "The value after the step, inside the pulse, or in the first part of a period.",
    "initial": "The value before the step, outside the pulse, or in the second part of a period.",
    "on": "When the pulse begins.",
    "off": "When the pulse ends.",
    "period": "Duration of one period.",
    "frequency": "Periods per second; or give the period.",
    "duty": "Share of each period with the first level.",
    "amplitude": "Height of the wave.",
    "offset": "The value that the amplitude is added to.",
    "phase": "Angle at t = 0.",
    "start": "When the ramp begins.",
    "hold": "How long each level lasts.",
    "seed": "Number that the levels follow from; the same seed gives the same levels.",
    "lower": "Lowest level.",
    "upper": "Highest level.",
    "times": "Instants of the points, ascending.",
    "values": "Values of the points, as many as instants.",
    "interpolation": "Joined by lines, or each value held until the next.",
}
_EXAMPLES = {
    "s": "0.5 s",
    "1": "50 %",
    "Hz": "2 Hz",
    "rad": "90 deg",
    "m": "20 mm",
    "N": "120 N",
    "N*m/rad": "20 N*m/rad",
}


@dataclass(frozen=True, slots=True)
class SignalInput:
    """A signal that is not converted here, because its meaning depends on the rest of the document.

    Attributes:
        unit: SI unit of the levels.
        plain: whether a constant quantity is allowed too; it is converted to SI.
    """

    unit: str
    plain: bool = False

    def __call__(self, value: object) -> Any:
        """The object with the shape, or the constant in SI.

        Raises:
            InputError: the value is neither.
        """
        if self.plain and not isinstance(value, Mapping):
            return si(value, self.unit)
        if not isinstance(value, Mapping):
            raise InputError("must be an object with a shape", hint='e.g. {"shape": "step"}')
        return dict(value)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validation by `__call__` alone."""
        return core_schema.no_info_plain_validator_function(self)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """One object schema per shape, made from the fields of its class."""
        shapes = [_shape_schema(name, self.unit) for name in SHAPES]
        return {
            "anyOf": [*_quantity(self.unit)["anyOf"], *shapes] if self.plain else shapes,
            "unit": self.unit,
        }


def key_units(shape: str, unit: str) -> dict[str, str]:
    """The keys of a shape that are quantities, with their SI units; ``unit`` is that of the levels."""
    if shape not in SHAPES:
        return {}
    properties = _shape_schema(shape, unit)["properties"]
    scalar = {label: schema for label, schema in properties.items() if label not in ("times", "values")}
    return {label: schema["unit"] for label, schema in scalar.items() if "unit" in schema}


def _quantity(unit: str) -> JsonSchemaValue:
    text = {"type": "string", "minLength": 1, "maxLength": MAX_TEXT_LENGTH}
    return {"anyOf": [{"type": "number"}, text], "unit": unit, "examples": [_EXAMPLES[unit]]}


def _shape_schema(name: str, unit: str) -> JsonSchemaValue:
    kind = SHAPES[name]
    properties: dict[str, Any] = {
        "shape": {"const": name, "type": "string", "description": "Name of the shape."}
    }
    required = ["shape"]
    for item in fields(kind):
        if "kind" not in item.metadata:
            continue
        label, default = item.metadata["name"] or item.name, item.metadata["default"]
        properties[label] = _key_schema(item.name, item.metadata["kind"], unit)
        needed = default is MISSING or (default == "full" and unit != "1")
        if needed and not any(_REPLACES[synonym] == label for synonym in SYNONYMS.get(kind, ())):
            required.append(label)
    for label in SYNONYMS.get(kind, ()):
        properties[label] = _quantity("s" if label == "period" else unit)
    for label, schema in properties.items():
        if label != "shape":
            schema["description"] = _MEANING.get((name, label)) or _KEYS[label]
    description = " ".join((kind.__doc__ or "").split("\n\n")[0].split()).replace("``", "")
    return {
        "type": "object",
        "title": f"{name} signal",
        "description": description,
        "properties": properties,
        "required": required,
        "additionalProperties": False,
    }


def _key_schema(name: str, kind: str, unit: str) -> JsonSchemaValue:
    if kind == "seed":
        return {"type": "integer", "examples": [7]}
    if kind == "word":
        return {"type": "string", "enum": ["linear", "hold"]}
    if kind == "column":
        column_unit = "s" if name == "times" else unit
        entries = {"type": "array", "items": _quantity(column_unit), "maxItems": MAX_SEGMENTS}
        table = {
            "type": "object",
            "properties": {
                "unit": {"type": "string", "description": "Unit of the values."},
                "values": {"type": "array", "items": {"type": "number"}, "description": "The numbers."},
            },
            "required": ["unit", "values"],
        }
        return {"anyOf": [entries, table], "unit": column_unit}
    return _quantity(_UNITS.get(kind, unit))


Command = Annotated[dict[str, Any], SignalInput("1")]
Reference = Annotated[dict[str, Any], SignalInput("m")]
AngleOverTime = Annotated[Any, SignalInput("rad", plain=True)]
StiffnessOverTime = Annotated[Any, SignalInput("N*m/rad", plain=True)]
ForceOverTime = Annotated[Any, SignalInput("N", plain=True)]
