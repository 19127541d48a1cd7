"""Answers of ``/api/measurements``."""

from __future__ import annotations

from pydantic import Field

from mckibben.api.schemas.common import Strict


class Channel(Strict):
    """One column of a measurement that is used."""

    name: str = Field(description="Name of the channel.", examples=["pressure"])
    column: str = Field(description="Header of the file.", examples=["p_bar"])
    unit: str = Field(description="Unit in the file.", examples=["bar"])
    si_unit: str = Field(description="SI unit of minimum, maximum and the columns.", examples=["Pa"])
    minimum: float | None = Field(description="Smallest value, SI.")
    maximum: float | None = Field(description="Largest value, SI.")


class MeasurementAnswer(Strict):
    """A measurement as it was understood."""

    id: str = Field(description="SHA-256 of the file's content.", pattern=r"^[0-9a-f]{64}$")
    name: str = Field(description="Name of the file.")
    kind: str = Field(description="isobaric, isometric, isotonic, diameter, transient or static.")
    kind_detected: bool = Field(description="Detected from the data, not given in the file.")
    rows: int
    channels: list[Channel]
    ignored: list[str] = Field(description="Columns that are not used.")
    conditions: dict[str, str | float | None] = Field(description="Conditions of the test, SI.")
    groups: int = Field(description="How many sweeps or cycles the rows belong to.")
    messages: list[str] = Field(description="What to know about the file.")


class MeasurementDetail(MeasurementAnswer):
    """A measurement with its data."""

    columns: dict[str, list[float | bool | None]] = Field(
        description="Channel -> values in SI; 'slack' marks rows without pulling force."
    )
