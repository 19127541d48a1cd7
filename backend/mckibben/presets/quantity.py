"""A physical value of a preset: number, unit, source, grade; and dimension and range of each known key."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from typing import Annotated, Literal, NamedTuple

from pydantic import BaseModel, ConfigDict, Field

from mckibben.physics.errors import InputError
from mckibben.physics.muscle import NEUTRAL_ANGLE
from mckibben.physics.parameter import GRADES, UNVERIFIED_GRADES
from mckibben.physics.units import convert, is_unit

Grade = Literal["S", "S2", "C", "D", "M", "E", "user"]
GRADES_IN_WORDS = "; ".join(f"{key}: {meaning}" for key, meaning in GRADES.items())
Text = Annotated[str, Field(min_length=1, max_length=300, pattern=r"\S")]
# No physical value is near this size; without the bound a unit factor could overflow to infinity.
Number = Annotated[float, Field(ge=-1e30, le=1e30)]
Note = Annotated[str, Field(min_length=1, max_length=2000, pattern=r"\S")]


class Finding(NamedTuple):
    """One error in a document: where, what is wrong, what would be right."""

    field: str | None
    message: str
    hint: str | None = None


class PresetModel(BaseModel):
    """Base of all preset models: no unknown keys, no coercion of types, no nan or inf, immutable."""

    model_config = ConfigDict(
        strict=True, extra="forbid", frozen=True, allow_inf_nan=False, validate_by_name=False
    )


class Quantity(PresetModel):
    """A value with its unit (text), source (short) and grade (a key of `physics.parameter.GRADES`)."""

    value: Number = Field(description="The number, in its unit.")
    unit: Annotated[str, Field(min_length=1, max_length=40)] = Field(description="The unit, as a text.")
    source: Text = Field(description="Where the value comes from, in a few words.")
    grade: Grade = Field(description=GRADES_IN_WORDS)
    note: Note | None = Field(default=None, description="Remark on the value.")

    @property
    def verified(self) -> bool:
        """Whether the value was read in a source or computed from such values."""
        return self.grade not in UNVERIFIED_GRADES

    def si(self, unit: str, *, field: str | None = None) -> float:
        """The value in the SI unit ``unit`` ("m", "Pa", "rad", "1").

        Raises:
            InputError: the value's own unit is unknown or measures something else.
        """
        return float(convert(self.value, self.unit, unit, field=field))


class Column(PresetModel):
    """A column of numbers in one unit."""

    unit: Annotated[str, Field(min_length=1, max_length=40)] = Field(description="The unit, as a text.")
    values: Annotated[list[Number], Field(min_length=1, max_length=20_000)] = Field(
        description="The numbers, one per row."
    )


class Expected(NamedTuple):
    """SI unit of a key, and the plausible range [lower, upper] in SI."""

    unit: str
    lower: float = -math.inf
    upper: float = math.inf


_SIZE = Expected("m", 1e-6, 100.0)
_SHARE = Expected("1", 0.0, 1.0)
_PRESSURE = Expected("Pa", -101_325.0, 1e8)
_TIME = Expected("s", 0.0, 1e4)
_VOLTAGE = Expected("V")
_TEMPERATURE = Expected("K", 0.0)

#: Every known key of geometry, tolerance, limits, data and columns; other ``data`` keys may have any unit.
EXPECTED: dict[str, Expected] = {
    "inside_diameter": _SIZE,
    "outside_diameter": _SIZE,
    "braid_diameter": _SIZE,
    "tube_diameter": _SIZE,
    "thread_diameter": _SIZE,
    "wall_thickness": _SIZE,
    "nominal_length": _SIZE,
    "min_nominal_length": _SIZE,
    "max_nominal_length": _SIZE,
    "reference_length": _SIZE,
    "nominal_size": _SIZE,
    "braid_angle": Expected("rad", math.radians(1.0), NEUTRAL_ANGLE),
    "max_pressure": _PRESSURE,
    "min_pressure": _PRESSURE,
    "max_force": Expected("N", 0.0),
    "max_contraction": _SHARE,
    "max_pretension": _SHARE,
    "efficient_contraction": _SHARE,
    "max_hysteresis": _SHARE,
    "max_relaxation": _SHARE,
    "repetition_accuracy": _SHARE,
    "max_suspended_mass": Expected("kg", 0.0),
    "weight_per_length": Expected("kg/m", 0.0),
    "min_temperature": _TEMPERATURE,
    "max_temperature": _TEMPERATURE,
    "sonic_conductance": Expected("m^3/(s*Pa)", 0.0, 1e-5),
    "exhaust_conductance": Expected("m^3/(s*Pa)", 0.0, 1e-5),
    "critical_pressure_ratio": Expected("1", 0.0, 0.999),
    "nominal_flow": Expected("m^3/s", 0.0),
    "range": Expected("Pa", 1e3, 1e8),
    "time": _TIME,
    "damping": Expected("1", 0.05, 10.0),
    "band": Expected("Pa", 1.0, 1e8),
    "dead_band": Expected("Pa", 0.0, 1e8),
    "delay_on": _TIME,
    "delay_off": _TIME,
    "shortest_pulse": _TIME,
    "max_frequency": Expected("Hz", 0.0),
    "actuating_time": _TIME,
    "bandwidth": Expected("Hz", 0.0),
    "port_volume": Expected("m^3", 0.0),
    "command_min": _VOLTAGE,
    "command_max": _VOLTAGE,
    "command_middle": _VOLTAGE,
}
COLUMN_UNITS = {
    "pressure": "Pa", "contraction": "1", "length": "m", "displacement": "m", "force": "N", "time": "s",
    "command": "1",
}  # fmt: skip

# Tried in this order for a value of unknown dimension (an effect's parameter).
_SI_UNITS = (
    "1", "rad", "m", "Pa", "N", "s", "kg", "K", "N/m", "N*s/m", "m/s", "m^2", "m^3", "m^3/(s*Pa)", "1/s",
    "N/Pa", "1/Pa", "m/N", "1/K", "1/m", "N*m", "W", "W/K", "J/K", "kg/m", "kg/s", "m/s^2", "Pa*s", "s/m",
    "N*s/(m*Pa)", "Pa/m", "Pa/s", "Pa*s/m^3", "m^3/s", "W/(m^2*K)", "V",
)  # fmt: skip


@cache
def si_unit(unit: str) -> str | None:
    """The SI unit to which a unit text converts, or None for one that no model uses."""
    for candidate in _SI_UNITS:
        try:
            convert(1.0, unit, candidate)
        except InputError:
            continue
        return candidate
    return None


def quantities(part: object, path: str = "") -> Iterator[tuple[str, Quantity]]:
    """All quantities below a model or mapping, with their dotted path."""
    if isinstance(part, Quantity):
        yield path, part
        return
    items: Iterator[tuple[str, object]] = iter(())
    if isinstance(part, BaseModel):
        items = ((name, getattr(part, name)) for name in type(part).model_fields)
    elif isinstance(part, dict):
        items = iter(part.items())
    for name, value in items:
        yield from quantities(value, f"{path}.{name}" if path else name)


def quantity_findings(path: str, quantity: Quantity) -> Iterator[Finding]:
    """Errors in the unit or size of a quantity, judged by the last key of its path."""
    section, _, key = path.rpartition(".")
    expected = EXPECTED.get(key)
    if expected is None:
        if not is_unit(quantity.unit):
            yield Finding(f"{path}.unit", f"'{quantity.unit}' is not a known unit", "e.g. 'mm'")
        return
    # A tolerance is a +- width of the value of the same name: any size from zero up.
    bounds = expected._replace(lower=0.0) if section == "tolerance" else expected
    yield from range_findings(path, quantity, bounds)


def range_findings(path: str, quantity: Quantity, expected: Expected) -> Iterator[Finding]:
    """Whether a quantity has the expected dimension and lies in the expected range."""
    try:
        value = quantity.si(expected.unit)
    except InputError as error:
        yield Finding(f"{path}.unit", error.message, error.hint)
        return
    if not expected.lower <= value <= expected.upper:
        unit = "" if expected.unit == "1" else f" {expected.unit}"
        yield Finding(
            f"{path}.value",
            f"{quantity.value:g} {quantity.unit} is outside what makes sense",
            f"between {expected.lower:.6g}{unit} and {expected.upper:.6g}{unit}",
        )
