"""Bounds of the numbers of a muscle and of a drive: those that a document may state."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from typing import Any

from mckibben.documents import drive, drive_air, quantity
from mckibben.documents.quantity import QuantityField

# Constant -> the type of its field in a document. Gravity, stops and precontraction are computed from several
# fields, and the damping of a slack muscle is of the method: they have no bounds.
_FIELDS: Mapping[str, Any] = {
    "ambient_pressure": drive.Ambient,
    "ambient_temperature": quantity.Temperature,
    "fill_conductance": drive_air.Conductance,
    "fill_ratio": drive_air.Ratio,
    "exhaust_conductance": drive_air.Conductance,
    "exhaust_ratio": drive_air.Ratio,
    "regulator_range": quantity.PositivePressure,
    "regulator_time": drive_air.LagTime,
    "filling_restriction_ratio": drive_air.Ratio,
    "venting_restriction_ratio": drive_air.Ratio,
    "quick_exhaust_conductance": drive_air.OpenConductance,
    "quick_exhaust_ratio": drive_air.Ratio,
    "quick_exhaust_band": quantity.PositivePressure,
    "tube_volume": quantity.Volume,
    "tube_conductance": drive_air.Conductance,
    "tube_ratio": drive_air.Ratio,
    "fitting_volume": quantity.Volume,
    "polytropic_exponent": drive.Exponent,
    "wall_heat_transfer": drive.HeatTransfer,
    "mass": drive.Mass,
    "own_mass": drive.Mass,
    "spring": drive.Stiffness,
    "lever_ratio": drive.LeverRatio,
    "nominal_length": quantity.Length,
    "braid_diameter": quantity.Diameter,
    "wall_thickness": quantity.Thickness,
    "inside_diameter": quantity.Diameter,
}


def bounds_of(name: str) -> tuple[float | None, float | None]:
    """Smallest and largest value of a constant, where there are any; SI."""
    if name == "braid_angle":  # between thread and axis
        return 0.0, 0.5 * pi
    field = _FIELDS.get(name)
    if field is None:
        return None, None
    (own,) = (each for each in field.__metadata__ if isinstance(each, QuantityField))
    return own.above if own.at_least is None else own.at_least, own.at_most
