"""Shorthands of documents, the same at every door: "DMSP-20:300mm" for a muscle, "6 bar" for a supply."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidatorFunctionWrapHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from mckibben.physics.errors import InputError
from mckibben.physics.units import MAX_TEXT_LENGTH, si


@dataclass(frozen=True, slots=True)
class OrText:
    """Also accepts a text that says the same. Not a union, whose errors would not name the field alone.

    Attributes:
        expand: from the text, or the number, to the document.
        example: a valid text.
        numbers: whether a number is one too, in SI.
    """

    expand: Callable[[Any], object]
    example: str
    numbers: bool = False

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """A text is expanded, everything else is a document."""
        return core_schema.no_info_wrap_validator_function(self._expanded, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """A document or a text."""
        text: JsonSchemaValue = {"type": "string", "maxLength": MAX_TEXT_LENGTH, "examples": [self.example]}
        return {"anyOf": [handler(schema), text, *([{"type": "number"}] if self.numbers else [])]}

    def _expanded(self, value: object, handler: ValidatorFunctionWrapHandler) -> Any:
        return handler(self.document(value))

    def document(self, value: object) -> object:
        """The document that a text stands for; anything else is returned itself."""
        if isinstance(value, str):
            if len(value) > MAX_TEXT_LENGTH:
                raise InputError(f"must have at most {MAX_TEXT_LENGTH} characters")
            return self.expand(value)
        if self.numbers and isinstance(value, int | float) and not isinstance(value, bool):
            return self.expand(value)
        return value


def _muscle(text: str) -> dict[str, object]:
    name, separator, length = text.partition(":")
    return {"preset": name.strip(), **({"nominal_length": length.strip()} if separator else {})}


def _preset(text: str) -> dict[str, object]:
    return {"preset": text}


def _supply(pressure: str | float) -> dict[str, object]:
    return {"pressure": pressure}


def _load(text: str) -> dict[str, object]:
    """A mass or a force, by the unit.

    Raises:
        InputError: it is neither.
    """
    for field, unit in (("mass", "kg"), ("force", "N")):
        try:
            si(text, unit)
        except InputError:
            continue
        return {field: text}
    raise InputError(f"'{text}' is neither a mass nor a force", hint='e.g. "12 kg" or "60 N"')


def _listed(text: str) -> list[str]:
    return [part.strip() for part in text.split(",")]


MUSCLE_TEXT = OrText(_muscle, "DMSP-20:300mm")
VALVE_TEXT = OrText(_preset, "MPYE-5-1/8-HF")
TUBE_TEXT = OrText(_preset, "PUN-H-6x1")
SUPPLY_TEXT = OrText(_supply, "6 bar", numbers=True)
LOAD_TEXT = OrText(_load, "12 kg")
LIST_TEXT = OrText(_listed, "1 bar, 3 bar")
