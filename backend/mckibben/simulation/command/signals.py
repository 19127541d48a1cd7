"""Commands, references and loads as shapes of time, read from a document.

Every shape gives linear segments for the integrator (`Signal.segments`) and its exact value for plots
(`Signal.value`). Straight shapes are in shapes.py, the others in waveforms.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import MISSING, Field, fields
from typing import Any

import numpy as np

from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import convert, si
from mckibben.simulation.command.segments import Array, Segments, delayed, merged
from mckibben.simulation.command.shapes import (
    MAX_SEGMENTS,
    SMOOTH_ERROR,
    Pulse,
    Ramp,
    Signal,
    Square,
    Step,
    Triangle,
)
from mckibben.simulation.command.waveforms import Chirp, Random, Sine, TableSignal

__all__ = [
    "MAX_SEGMENTS",
    "SHAPES",
    "SMOOTH_ERROR",
    "Chirp",
    "Pulse",
    "Ramp",
    "Random",
    "Segments",
    "Signal",
    "Sine",
    "Square",
    "Step",
    "TableSignal",
    "Triangle",
    "delayed",
    "merged",
    "signal_from",
]

_SI = {"time": "s", "share": "1", "frequency": "Hz", "angle": "rad"}

#: Keys that a document may use instead of a field.
SYNONYMS: dict[type[Signal], tuple[str, ...]] = {Square: ("amplitude",), Sine: ("period",)}

#: Name in a document -> shape.
SHAPES: dict[str, type[Signal]] = {
    kind.shape: kind for kind in (Step, Pulse, Square, Triangle, Ramp, Sine, Chirp, Random, TableSignal)
}


def signal_from(
    document: Mapping[str, Any],
    *,
    unit: str,
    field: str,
    rest: float = 0.0,
    limits: tuple[float, float] | None = None,
) -> Signal:
    """The signal of a part of a document: ``{"shape": "pulse", "on": "0 s", "off": "2 s"}``.

    Args:
        document: ``shape`` and its keys; values are numbers in SI or texts with a unit.
        unit: SI unit of the levels; for "1" a missing level or amplitude is 1, else it is required.
        field: path of the part, for messages ("command", "controller.reference").
        rest: the level before a step, outside a pulse, in the low part of a square, ramp or random.
        limits: permitted range of levels (±1 for a valve).

    Raises:
        InputError: not a mapping; unknown shape or key; missing, impossible or out-of-range value.
    """
    if not isinstance(document, Mapping):
        raise InputError(f"{field}: an object with a shape is needed", field=field, hint='{"shape": "step"}')
    name = document.get("shape")
    kind = SHAPES.get(name) if isinstance(name, str) else None
    if kind is None:
        problem = "the shape is missing" if name is None else f"there is no shape '{_shown(name)}'"
        hint = did_you_mean(_shown(name) if name else "", SHAPES)
        raise InputError(f"{field}: {problem}", field=f"{field}.shape", hint=hint)
    known = {item.metadata["name"] or item.name: item for item in fields(kind) if "kind" in item.metadata}
    given = {label: value for label, value in document.items() if label != "shape"}
    for label in given:
        if label not in known and label not in SYNONYMS.get(kind, ()):
            hint = did_you_mean(_shown(label), [*known, *SYNONYMS.get(kind, ())])
            message = f"{field}: a {name} has no '{_shown(label)}'"
            raise InputError(message, field=f"{field}.{_shown(label)}", hint=hint)
    if kind is Square:
        _level_of_amplitude(given, unit, field, rest)
    if kind is Sine:
        _frequency_of_period(given, field)
    values = {
        item.name: _value(item, given.get(label, MISSING), unit, f"{field}.{label}", rest)
        for label, item in known.items()
    }
    signal = kind(path=field, **values)
    if limits is not None and not (limits[0] <= signal.extent[0] and signal.extent[1] <= limits[1]):
        raise InputError(
            f"{field}: it runs from {signal.extent[0]:g} to {signal.extent[1]:g}, "
            f"outside {limits[0]:g} to {limits[1]:g}",
            field=field,
        )
    return signal


def _shown(text: object) -> str:
    """A text of the caller, shortened for a message."""
    return str(text) if len(str(text)) <= 40 else str(text)[:40] + "…"


def _value(item: Field[Any], raw: Any, unit: str, where: str, rest: float) -> Any:
    """The value of one field in SI, or its default."""
    kind, default = item.metadata["kind"], item.metadata["default"]
    if raw is MISSING:
        if default == "rest":
            return rest
        if default == "full" and unit == "1":
            return 1.0
        if default is MISSING or default == "full":
            raise InputError(f"{where} is missing", field=where)
        return default
    if kind == "word":
        return _shown(raw)
    if kind == "seed":
        if isinstance(raw, bool) or not isinstance(raw, int) or abs(raw) >= 2**63:
            raise InputError(f"{where}: '{_shown(raw)}' is not a whole number", field=where, hint="e.g. 7")
        return raw
    if kind == "column":
        return _column(raw, "s" if item.name == "times" else unit, where)
    return si(raw, _SI.get(kind, unit), field=where)


def _column(raw: Any, unit: str, where: str) -> Array:
    """A list of numbers in SI or texts with units, or ``{"unit": "ms", "values": [numbers]}``."""
    values, source = (raw.get("values"), raw.get("unit")) if isinstance(raw, Mapping) else (raw, unit)
    if isinstance(values, np.ndarray):
        values = values.tolist()
    if not isinstance(values, Sequence) or isinstance(values, str) or not isinstance(source, str):
        hint = f'e.g. [0, 0.5, 1] or {{"unit": "{unit}", "values": [0, 0.5, 1]}}'
        raise InputError(f"{where}: a list of values is needed", field=where, hint=hint)
    if len(values) > MAX_SEGMENTS:
        raise InputError(f"{where}: {len(values)} entries, at most {MAX_SEGMENTS}", field=where)
    if isinstance(raw, Mapping):
        numbers = [si(value, "1", field=f"{where}, entry {i}") for i, value in enumerate(values, start=1)]
        return convert(numbers, source, unit, field=where)
    numbers = [si(value, unit, field=f"{where}, entry {i}") for i, value in enumerate(values, start=1)]
    return np.array(numbers, dtype=np.float64)


def _level_of_amplitude(given: dict[str, Any], unit: str, field: str, rest: float) -> None:
    """Replace the amplitude of a square by the missing level: amplitude = level - initial."""
    if "amplitude" not in given:
        return
    where = f"{field}.amplitude"
    amplitude = si(given.pop("amplitude"), unit, field=where)
    if "level" not in given:
        given["level"] = si(given.get("initial", rest), unit, field=f"{field}.initial") + amplitude
    elif "initial" not in given:
        given["initial"] = si(given["level"], unit, field=f"{field}.level") - amplitude
    else:
        raise InputError(f"{where}: give two of level, initial and amplitude, not all three", field=where)


def _frequency_of_period(given: dict[str, Any], field: str) -> None:
    """Replace the period of a sine by its frequency."""
    if "period" not in given:
        return
    where = f"{field}.period"
    period = si(given.pop("period"), "s", field=where)
    if "frequency" in given:
        raise InputError(f"{where}: give the period or the frequency, not both", field=where)
    if not period > 0.0:
        raise InputError(f"{where}: {period:g} s is not positive", field=where, hint="e.g. '1 s'")
    given["frequency"] = 1.0 / period
