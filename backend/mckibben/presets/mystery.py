"""Mysteries: measurements with known hidden effects; the answer is encoded in the same file."""

from __future__ import annotations

import base64
import binascii
from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationError

from mckibben.physics.errors import InputError
from mckibben.physics.units import convert
from mckibben.presets.quantity import (
    COLUMN_UNITS,
    Column,
    Finding,
    Note,
    PresetModel,
    Quantity,
    Text,
    quantity_findings,
    si_unit,
)
from mckibben.presets.schema import EffectTable, Key, Preset


class MysteryColumns(PresetModel):
    """The measured channels, all of the same length."""

    time: Column | None = None
    pressure: Column | None = None
    length: Column | None = None
    displacement: Column | None = None
    force: Column | None = None
    command: Column | None = None

    def present(self) -> dict[str, Column]:
        """The channels present in the measurement."""
        return {name: column for name, column in self if column is not None}


class HiddenEffect(PresetModel):
    """One effect that the start model lacks.

    Attributes:
        title: its name.
        what: what it does, and how it shows in the data.
        effects: ids of the effects accepted as right answers.
    """

    title: Text
    what: Note
    effects: Annotated[list[Key], Field(min_length=1)]


class MysteryAnswer(PresetModel):
    """The hidden effects of a measurement; none if the start model explains it."""

    hidden: list[HiddenEffect]
    text: Note


class MysteryPreset(Preset):
    """A measurement to practise on, with its answer encoded so that nobody reads it by accident.

    Attributes:
        story: the situation, as an engineer would describe it.
        muscle, effects, drive: the start model of a comparison.
        conditions: conditions of the measurement, e.g. ``load_mass``.
        sealed: the answer as base64 of JSON.
    """

    kind: Literal["mystery"]
    story: Note
    measurement_kind: Literal["isobaric", "isometric", "isotonic", "transient", "static"]
    nominal_length: Quantity
    muscle: dict[str, Any]
    effects: dict[Key, dict[Key, float]] = Field(default_factory=dict)
    drive: dict[str, Any] | None = None
    conditions: dict[Key, Quantity] = Field(default_factory=dict)
    data_columns: MysteryColumns
    sealed: Annotated[str, Field(min_length=1, max_length=20_000)]

    def answer(self) -> MysteryAnswer:
        """The hidden effects.

        Raises:
            ValueError: ``sealed`` does not contain an answer.
        """
        return MysteryAnswer.model_validate_json(base64.b64decode(self.sealed, validate=True))

    def si_columns(self) -> dict[str, NDArray[np.float64]]:
        """Channel -> values in SI."""
        return {name: _si_column(name, column) for name, column in self.data_columns.present().items()}

    def si_conditions(self) -> dict[str, float | str]:
        """Condition -> value in SI."""
        return {
            name: quantity.si(si_unit(quantity.unit) or quantity.unit, field=f"conditions.{name}")
            for name, quantity in self.conditions.items()
        }

    def findings(self, effects: EffectTable | None = None) -> Iterator[Finding]:
        """Adds: units and lengths of the columns, units of the conditions, a valid ``sealed``."""
        yield from super().findings(effects)
        columns = self.data_columns.present()
        if not columns:
            yield Finding("data_columns", "there is no column")
        rows = max((len(column.values) for column in columns.values()), default=0)
        for name, column in columns.items():
            try:
                _si_column(name, column)
            except InputError as error:
                yield Finding(f"data_columns.{name}.unit", error.message, error.hint)
            if len(column.values) != rows:
                yield Finding(f"data_columns.{name}.values", f"{len(column.values)} values", f"{rows}")
        for name, quantity in self.conditions.items():
            yield from quantity_findings(f"conditions.{name}", quantity)
        try:
            self.answer()
        except (binascii.Error, UnicodeDecodeError, ValidationError):
            yield Finding("sealed", "is not base64 of an answer")


def _si_column(name: str, column: Column) -> NDArray[np.float64]:
    return convert(column.values, column.unit, COLUMN_UNITS[name])
