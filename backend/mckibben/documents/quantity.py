"""Quantities in requests: a number in SI units, or a text with a unit ("300 mm")."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from mckibben.physics.errors import InputError
from mckibben.physics.units import MAX_TEXT_LENGTH, Reference, si


@dataclass(frozen=True, slots=True)
class QuantityField:
    """Converts a value of a request to SI, and describes it in OpenAPI.

    Attributes:
        unit: SI unit of the result; a text must have a compatible unit.
        example: a valid text.
        above, at_least, at_most, below: bounds of the SI value.
        reference: "gauge" or "absolute" of a pressure; a text that says the other one is converted at the
            standard atmosphere.
    """

    unit: str
    example: str
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    below: float | None = None
    reference: Reference | None = None

    def __call__(self, value: object) -> float:
        """The value in SI.

        Raises:
            InputError: not a finite number, an unknown or wrong unit, or out of bounds.
        """
        number = si(value, self.unit, reference=self.reference)
        wrong = (
            (self.above is not None and number <= self.above and f"above {self.above:g}")
            or (self.at_least is not None and number < self.at_least and f"at least {self.at_least:g}")
            or (self.at_most is not None and number > self.at_most and f"at most {self.at_most:g}")
            or (self.below is not None and number >= self.below and f"below {self.below:g}")
        )
        if wrong:
            unit = "" if self.unit == "1" else f" {self.unit}"
            raise InputError(f"must be {wrong}{unit}, not {number:g}{unit}", hint=self._hint)
        return number

    @property
    def _hint(self) -> str:
        return f"e.g. '{self.example}'"

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validation by `__call__` instead of that of float."""
        return core_schema.no_info_plain_validator_function(self)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Number with bounds, or text; the SI unit as ``unit``."""
        bounds = {
            "exclusiveMinimum": self.above,
            "minimum": self.at_least,
            "maximum": self.at_most,
            "exclusiveMaximum": self.below,
        }
        number = {"type": "number"} | {name: bound for name, bound in bounds.items() if bound is not None}
        return {
            "anyOf": [number, {"type": "string", "minLength": 1, "maxLength": MAX_TEXT_LENGTH}],
            "unit": self.unit,
            "examples": [self.example],
        }


# Bounds far beyond any real design; they only protect the arithmetic from absurd values.
Length = Annotated[float, QuantityField("m", "300 mm", above=0.0, at_most=1e3)]
Diameter = Annotated[float, QuantityField("m", "20 mm", above=0.0, at_most=10.0)]
Thickness = Annotated[float, QuantityField("m", "1.8 mm", at_least=0.0, at_most=1.0)]
# Without bounds: the physics checks it with a better message ("… the muscle would lengthen …").
Angle = Annotated[float, QuantityField("rad", "25 deg")]
Turns = Annotated[float, QuantityField("1", "1.48", above=0.0, at_most=1e6)]
Pressure = Annotated[float, QuantityField("Pa", "6 bar", at_least=0.0, at_most=1e8, reference="gauge")]
PositivePressure = Annotated[float, QuantityField("Pa", "6 bar", above=0.0, at_most=1e8, reference="gauge")]
Force = Annotated[float, QuantityField("N", "500 N", at_least=-1e9, at_most=1e9)]
Load = Annotated[float, QuantityField("N", "500 N", at_least=0.0, at_most=1e9)]
Temperature = Annotated[float, QuantityField("K", "20 degC", at_least=150.0, at_most=600.0)]
Contraction = Annotated[float, QuantityField("1", "10 %", at_least=-5.0, at_most=1.0)]
Volume = Annotated[float, QuantityField("m3", "15 ml", at_least=0.0, at_most=10.0)]
