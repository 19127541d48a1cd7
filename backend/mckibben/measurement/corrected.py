"""A measurement as its experiment has it: zeros of the sensors subtracted, load and supply as stated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import sin
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.experiment import LOAD_FORCE, ExperimentValue
from mckibben.measurement.measurement import Measurement

GRAVITY = 9.80665  # m/s2
_ZEROS = {"force_zero": "force", "pressure_zero": "pressure"}


def corrected(measurement: Measurement, values: Mapping[str, ExperimentValue]) -> Measurement:
    """The measurement with the zeros subtracted and the stated conditions.

    A mass that moves along an incline in an isotonic test counts with its share of weight along it.
    """
    columns: dict[str, NDArray] = {}
    for name, channel in _ZEROS.items():
        if name in values and channel in measurement.columns and float(values[name].value) != 0.0:
            shifted = measurement.columns[channel] - float(values[name].value)
            shifted.flags.writeable = False
            columns[channel] = shifted
    conditions = _conditions(measurement, values)
    if not columns and conditions == dict(measurement.conditions):
        return measurement
    channels = tuple(
        channel
        if channel.name not in columns
        else channel._replace(
            minimum=float(np.min(columns[channel.name])), maximum=float(np.max(columns[channel.name]))
        )
        for channel in measurement.channels
    )
    return replace(
        measurement,
        columns=MappingProxyType({**measurement.columns, **columns}),
        channels=channels,
        conditions=MappingProxyType(conditions),
    )


def _conditions(measurement: Measurement, values: Mapping[str, ExperimentValue]) -> dict[str, float | str]:
    conditions = dict(measurement.conditions)
    loads = [values[name] for name in ("load", LOAD_FORCE) if name in values]
    if loads and any(load.origin != "assumed" and load.where != FROM_DRIVE for load in loads):
        conditions.pop("load_mass", None)
        conditions.pop("load_force", None)
        for load in loads:
            conditions["load_mass" if load.unit == "kg" else "load_force"] = float(load.value)
    inclination = values.get("inclination")
    if measurement.kind == "isotonic" and inclination is not None and "load_mass" in conditions:
        weight = float(conditions.pop("load_mass")) * GRAVITY * sin(float(inclination.value))
        conditions["load_force"] = float(conditions.get("load_force", 0.0)) + weight
    supply = values.get("supply")
    if supply is not None and supply.origin != "assumed" and supply.where != FROM_DRIVE:
        conditions["supply_pressure"] = float(supply.value)
    return conditions


#: Place of a value of the drive document, which the drive already has.
FROM_DRIVE = "the drive document"
