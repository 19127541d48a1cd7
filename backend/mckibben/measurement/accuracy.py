"""Accuracy of a measurement: how far a channel may be off all the time, by number or by kind of sensor.

An accuracy is a standard deviation. Noise averages out over many readings, an error within the accuracy does
not: it is common to a clamped length, or to a whole file.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from mckibben.measurement.kind import FORCE_KINDS, STROKES
from mckibben.measurement.measurement import Measurement
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import si

#: Channels with an accuracy -> SI unit; the length stands for any stroke.
CHANNELS: Mapping[str, str] = MappingProxyType(
    {"length": "m", "force": "N", "pressure": "Pa", "diameter": "m"}
)
SHARE = "1"  # unit of an accuracy that is a share of the largest value
_LARGEST_SHARE = 0.2
_SPLIT = re.compile(r"[;]|,(?!\d)|,\s")
_PART = re.compile(r"\s*([A-Za-z]+)\s+(.*\S)\s*")
_EXAMPLE = "e.g. 'length 1 mm, force 0.5 %, pressure 20 mbar'"


@dataclass(frozen=True, slots=True)
class Sensor:
    """The accuracy of a kind of sensor, as a standard deviation, and where the figure is from."""

    channel: str
    value: float
    unit: str
    source: str


#: Kinds of sensors by name. A limit of error e of a data sheet counts as a deviation of e/sqrt(3), that of an
#: even distribution within it (GUM 4.3.7), rounded.
SENSORS: Mapping[str, Sensor] = MappingProxyType(
    {
        "steel rule": Sensor("length", 0.5e-3, "m", "read to 1 mm by hand, clamp included; estimate"),
        "caliper": Sensor(
            "length", 0.1e-3, "m", "limit of error 0.05 mm (DIN 862) and the jaws' seat; estimate"
        ),
        "draw-wire sensor": Sensor("length", 0.3e-3, "m", "linearity 0.1 % of 500 mm; usual data sheet"),
        "linear potentiometer": Sensor("length", 0.2e-3, "m", "linearity 0.1 % of 300 mm; usual data sheet"),
        "laser triangulation": Sensor("length", 0.1e-3, "m", "linearity 0.1 % of 200 mm; usual data sheet"),
        "testing machine": Sensor("force", 0.003, SHARE, "class 0.5 of ISO 7500-1: limit of error 0.5 %"),
        "load cell": Sensor("force", 0.001, SHARE, "class 0.2: limit of error 0.2 % of the range"),
        "crane scale": Sensor("force", 0.005, SHARE, "limit of error 1 % of the range; usual data sheet"),
        "pressure transmitter": Sensor("pressure", 0.003, SHARE, "limit of error 0.5 % of the range"),
        "test gauge": Sensor("pressure", 0.0035, SHARE, "class 0.6 of EN 837-1"),
        "pressure gauge": Sensor("pressure", 0.01, SHARE, "class 1.6 of EN 837-1"),
    }
)


@dataclass(frozen=True, slots=True)
class ChannelAccuracy:
    """Standard deviation of one channel: in its SI unit, or a share of its largest value (unit "1")."""

    value: float
    unit: str
    sensor: str = ""


def read_accuracy(text: str) -> dict[str, ChannelAccuracy]:
    """Accuracies in words: ``length 1 mm, force 0.5 %, pressure transmitter``.

    Raises:
        InputError: a channel, quantity or sensor that is not known.
    """
    found: dict[str, ChannelAccuracy] = {}
    for part in filter(str.strip, _SPLIT.split(text)):
        channel, accuracy = _read_part(part)
        if channel in found:
            raise InputError(f"'{part.strip()}': the {channel} is given twice", hint="give it once")
        found[channel] = accuracy
    if not found:
        raise InputError("no accuracy is given", hint=_EXAMPLE)
    return found


def _read_part(part: str) -> tuple[str, ChannelAccuracy]:
    words = " ".join(part.split())
    lower = words.lower()
    if lower in SENSORS:
        return SENSORS[lower].channel, _of_sensor(lower)
    split = _PART.fullmatch(words)
    if split is None:
        raise InputError(f"'{words[:60]}' is not an accuracy", hint=_EXAMPLE)
    channel, rest = split[1].lower(), split[2]
    channel = "length" if channel in STROKES else channel
    if channel not in CHANNELS:
        raise InputError(
            f"'{words[:60]}': '{split[1]}' is not a channel or sensor",
            hint=did_you_mean(lower, (*CHANNELS, *SENSORS)),
        )
    if rest.lower() in SENSORS:
        sensor = rest.lower()
        if SENSORS[sensor].channel != channel:
            raise InputError(f"'{words[:60]}': a {sensor} measures {SENSORS[sensor].channel}", hint=_EXAMPLE)
        return channel, _of_sensor(sensor)
    if not re.match(r"[+-]?[0-9.]", rest):
        known = [name for name, sensor in SENSORS.items() if sensor.channel == channel]
        raise InputError(f"'{words[:60]}': '{rest[:40]}' is not known", hint=did_you_mean(rest, known))
    return channel, _quantity(channel, re.sub(r"^([+-]?\d+),(\d+)", r"\1.\2", rest), words)


def _of_sensor(name: str) -> ChannelAccuracy:
    sensor = SENSORS[name]
    return ChannelAccuracy(sensor.value, sensor.unit, name)


def _quantity(channel: str, text: str, words: str) -> ChannelAccuracy:
    unit = SHARE if text.rstrip().endswith("%") else CHANNELS[channel]
    if re.fullmatch(r"[+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?", text):
        raise InputError(f"'{words[:60]}' has no unit", hint=_EXAMPLE)
    try:
        value = si(text, unit)
    except InputError as error:
        raise InputError(f"'{words[:60]}': {error.message}", hint=error.hint or _EXAMPLE) from error
    if not 0.0 <= value < (_LARGEST_SHARE if unit == SHARE else float("inf")):
        raise InputError(f"'{words[:60]}' is out of range", hint="0 to 20 % of the largest value")
    return ChannelAccuracy(value, unit)


#: A length set by hand on a rule or a hole pattern, forces and pressures read from usual sensors at rest.
_PLATEAUS = {
    "length": ChannelAccuracy(1e-3, "m"),
    "force": ChannelAccuracy(0.005, SHARE),
    "pressure": ChannelAccuracy(2e3, "Pa"),
}


def default_accuracy(measurement: Measurement) -> dict[str, ChannelAccuracy]:
    """What is assumed where nobody says it: of plateaus at clamped lengths; else nothing.

    Plateaus are readings at rest, without time, at lengths that are set and not measured: in every group all
    rows have the same one.
    """
    columns = measurement.columns
    stroke = next((columns[name] for name in STROKES if name in columns), None)
    if measurement.kind != "isometric" or "time" in columns or stroke is None:
        return {}
    groups = columns["group"]
    if any(np.ptp(stroke[groups == label]) > 0.0 for label in np.unique(groups)):
        return {}
    return {channel: accuracy for channel, accuracy in _PLATEAUS.items() if _is_read(channel, measurement)}


def _is_read(channel: str, measurement: Measurement) -> bool:
    return channel in measurement.columns or (channel == "length" and measurement.kind in FORCE_KINDS)


def sigma_of(accuracy: ChannelAccuracy, channel: str, measurement: Measurement, rest_length: float) -> float:
    """The standard deviation in SI; a share counts of the largest value measured.

    Args:
        accuracy: of the channel.
        channel: one of `CHANNELS`.
        measurement: that it belongs to.
        rest_length: of the muscle [m]; a share of a length counts of it.
    """
    if accuracy.unit != SHARE:
        return accuracy.value
    if channel == "length":
        return accuracy.value * rest_length
    values = measurement.columns.get(channel)
    return 0.0 if values is None else accuracy.value * float(np.max(np.abs(values)))
