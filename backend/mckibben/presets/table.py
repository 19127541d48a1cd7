"""Presets that are tables of numbers: reference curves and published measurements."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from mckibben.physics.errors import InputError
from mckibben.physics.parameter import UNVERIFIED_GRADES
from mckibben.physics.units import convert
from mckibben.presets.quantity import (
    COLUMN_UNITS,
    GRADES_IN_WORDS,
    Column,
    Finding,
    Grade,
    Note,
    PresetModel,
    Quantity,
    Text,
)
from mckibben.presets.schema import EffectTable, Preset, PresetId


class Exclusion(PresetModel):
    """A row that is not used, and why."""

    index: Annotated[int, Field(ge=0)] = Field(description="Number of the row, from 0.")
    why: Text = Field(description="Why it is not used.")


class CurveColumns(PresetModel):
    """Force over pressure and contraction."""

    pressure: Column = Field(description="Gauge pressure.")
    contraction: Column = Field(description="Contraction ratio.")
    force: Column = Field(description="Force.")


class MeasurementColumns(PresetModel):
    """Force over pressure and length."""

    pressure: Column = Field(description="Gauge pressure.")
    length: Column = Field(description="Length of the muscle.")
    force: Column = Field(description="Force.")


class _Table(Preset):
    muscle: PresetId = Field(description="Id of the muscle preset that it belongs to.")
    data_columns: Any = Field(description="The numbers, column by column.")
    excluded: list[Exclusion] = Field(default_factory=list, description="Rows that are not used.")
    source: Text = Field(description="Where the numbers come from, in a few words.")
    grade: Grade = Field(description=GRADES_IN_WORDS)
    note: Note | None = Field(default=None, description="Remark on the numbers.")

    @property
    def verified(self) -> bool:
        """Whether the columns and all values were read in a source or computed."""
        return self.grade not in UNVERIFIED_GRADES and super().verified

    @property
    def used(self) -> NDArray[np.bool_]:
        """True for every row that is not excluded."""
        mask = np.ones(len(self.data_columns.pressure.values), dtype=bool)
        mask[[row.index for row in self.excluded]] = False
        return mask

    def si_columns(self) -> dict[str, NDArray[np.float64]]:
        """All columns in SI, excluded rows too (see `used`)."""
        return {name: _si_column(name, column) for name, column in self._columns().items()}

    def _columns(self) -> dict[str, Column]:
        return {name: getattr(self.data_columns, name) for name in type(self.data_columns).model_fields}

    def findings(self, effects: EffectTable | None = None) -> Iterator[Finding]:
        """Adds: column units and lengths, excluded rows that exist."""
        yield from super().findings(effects)
        columns = self._columns()
        rows = len(columns["pressure"].values)
        for name, column in columns.items():
            path = f"data_columns.{name}"
            try:
                _si_column(name, column)
            except InputError as error:
                yield Finding(f"{path}.unit", error.message, error.hint)
            if len(column.values) != rows:
                yield Finding(f"{path}.values", f"{len(column.values)} values", f"{rows} as in pressure")
        for position, row in enumerate(self.excluded):
            if row.index >= rows:
                path = f"excluded.{position}.index"
                yield Finding(path, f"there is no row {row.index}", f"0 to {rows - 1}")


def _si_column(name: str, column: Column) -> NDArray[np.float64]:
    return convert(column.values, column.unit, COLUMN_UNITS[name])


class CurvePreset(_Table):
    """A reference curve of the maker: not a measurement."""

    kind: Literal["curve"] = Field(description="Says that it is a reference curve.")
    data_columns: CurveColumns = Field(description="The numbers, column by column.")


class MeasurementPreset(_Table):
    """Published measured points; ``slack`` marks rows where the muscle did not pull (not a measured zero)."""

    kind: Literal["measurement"] = Field(description="Says that it is a measurement.")
    measurement_kind: Literal["isobaric", "isometric", "isotonic", "diameter", "transient", "static"] = Field(
        description="How it was measured."
    )
    nominal_length: Quantity = Field(description="Length of the muscle at rest.")
    sample: Text = Field(description="What was measured.")
    data_columns: MeasurementColumns = Field(description="The numbers, column by column.")
    slack: list[Literal[0, 1]] = Field(
        default_factory=list,
        description="1 for each row in which the muscle did not pull; empty: it pulled in all.",
    )

    def findings(self, effects: EffectTable | None = None) -> Iterator[Finding]:
        """Adds: one slack mark per row."""
        yield from super().findings(effects)
        rows = len(self.data_columns.pressure.values)
        if self.slack and len(self.slack) != rows:
            yield Finding("slack", f"{len(self.slack)} values", f"{rows} as in pressure")
