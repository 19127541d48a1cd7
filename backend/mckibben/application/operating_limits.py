"""Limits of a preset on what is done with the muscle and its valve: mass, temperature, supply pressure,
switching frequency; and pressures that were probably meant in another unit.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import sin

from mckibben.application.muscle_summary import Notice
from mckibben.documents.drive_reading import AnnotatedDrive, ValveRating
from mckibben.documents.start_model import StartModel
from mckibben.physics.units import GRAVITY
from mckibben.simulation.command.pwm import PulseWidth
from mckibben.simulation.drive.parts import Load

OVER_MASS, OUTSIDE_TEMPERATURE, OUTSIDE_VALVE, OVER_FREQUENCY = (
    "over_suspended_mass",
    "outside_temperature",
    "outside_valve_pressure",
    "over_valve_frequency",
)
TINY_PRESSURE = "tiny_pressure"
_LEAST_PRESSURE = 1e3  # Pa; no muscle moves below 0.01 bar, and people write up to some hundred kPa or psi
_MOST_BAR = 16.0  # no muscle is given more, so that a larger number was meant in kPa
_HAIR = 1e-6  # share by which a limit is exceeded at least: rounding of unit conversions


def pressure_notices(pressures: Mapping[str, float]) -> list[Notice]:
    """Gauge pressures [Pa], by their field, so small that bar were probably meant; 0 is none of them."""
    return [
        Notice(
            TINY_PRESSURE,
            f"{pressure:g} Pa; did you mean {pressure:g} {'bar' if pressure <= _MOST_BAR else 'kPa'}? "
            "A number without a unit is in Pa",
            field,
        )
        for field, pressure in pressures.items()
        if 0.0 < pressure < _LEAST_PRESSURE
    ]


def load_notices(start: StartModel, load: float | None) -> list[Notice]:
    """The mass that a load [N] is when it hangs on the muscle, above the permitted one."""
    if load is None:
        return []
    mass = load / GRAVITY
    return _mass_notices(start, mass, f"a load of {load:.4g} N that hangs freely is {mass:.3g} kg", "load")


def suspended_notices(start: StartModel, load: Load) -> list[Notice]:
    """The mass whose weight the muscle carries, above the permitted one."""
    mass = load.mass * sin(load.inclination) / load.lever_ratio
    carried = f"the muscle carries the weight of {mass:.4g} kg"
    return _mass_notices(start, mass, carried, "load.mass")


def _mass_notices(start: StartModel, mass: float, what: str, field: str) -> list[Notice]:
    most = None if start.preset is None else start.preset.suspended_mass
    if most is None or mass <= most * (1.0 + _HAIR):
        return []
    return [Notice(OVER_MASS, f"{what}; the maker permits {most:.4g} kg freely suspended", field)]


def temperature_notices(start: StartModel, temperature: float, field: str) -> list[Notice]:
    """A temperature [K] for which the muscle is not made."""
    preset = start.preset
    if preset is None:
        return []
    low, high = preset.coldest, preset.hottest
    if (low is None or temperature >= low - _HAIR) and (high is None or temperature <= high + _HAIR):
        return []
    ends = " to ".join(f"{end - 273.15:.3g} °C" for end in (low, high) if end is not None)
    message = f"{temperature - 273.15:.3g} °C; {preset.id} is made for {ends}"
    return [Notice(OUTSIDE_TEMPERATURE, message, field)]


def valve_notices(annotated: AnnotatedDrive) -> list[Notice]:
    """A supply pressure, and a carrier of pulse-width modulation, that the valve is not made for."""
    rating = annotated.valve_rating
    if rating is None:
        return []
    return [
        *_pressure_outside(rating, annotated.drive.supply_pressure),
        *_too_fast(rating, annotated.drive.pwm),
    ]


def _too_fast(rating: ValveRating, pwm: PulseWidth | None) -> list[Notice]:
    highest = rating.highest_frequency
    if pwm is None or highest is None or pwm.frequency <= highest * (1.0 + _HAIR):
        return []
    message = (
        f"a carrier of {pwm.frequency:.4g} Hz; {rating.valve} can be switched at {highest:.4g} Hz at most "
        f"({rating.source})"
    )
    return [Notice(OVER_FREQUENCY, message, "pwm.frequency")]


def _pressure_outside(rating: ValveRating, supply: float) -> list[Notice]:
    low, high = rating.lowest_pressure, rating.highest_pressure
    if (low is None or supply >= low * (1.0 - _HAIR)) and (high is None or supply <= high * (1.0 + _HAIR)):
        return []
    ends = " to ".join(f"{end / 1e5:.4g} bar" for end in (low, high) if end is not None)
    message = f"the supply has {supply / 1e5:.4g} bar; {rating.valve} is made for {ends} ({rating.source})"
    return [Notice(OUTSIDE_VALVE, message, "supply.pressure")]
