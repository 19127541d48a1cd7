"""Units: how each quantity is shown in each unit system, and which units a form takes; all other code is SI.

SI value = shown value * factor + offset. Texts with units, such as ``"300 mm"``, are read by
`mckibben.physics.units`, which knows more of them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, NamedTuple

System = Literal["si", "bar", "us"]

_INCH, _POUND, _LBF = 0.0254, 0.45359237, 4.4482216152605
_FOOT, _PSI, _DEGREE = 12 * _INCH, _LBF / _INCH**2, math.pi / 180.0
_FAHRENHEIT, _CELSIUS_ZERO = 5.0 / 9.0, 273.15
_FAHRENHEIT_ZERO = _CELSIUS_ZERO - 32.0 * _FAHRENHEIT


class Scale(NamedTuple):
    """A unit in which values are shown.

    Attributes:
        unit: as it is written; "" of a plain number.
        factor, offset: SI value = shown value * factor + offset.
        digits: most decimals of a shown value.
        decibels: whether the shown value is 20 lg of the SI value, a factor; NaN of one that is not positive.
    """

    unit: str
    factor: float = 1.0
    digits: int = 4
    offset: float = 0.0
    decibels: bool = False

    def of(self, value: float) -> float:
        """An SI value in this unit."""
        if self.decibels:
            return 20.0 * math.log10(value) if value > 0.0 else math.nan
        return (value - self.offset) / self.factor

    def all(self, values: Iterable[float | None]) -> list[float]:
        """SI values in this unit; None becomes NaN."""
        return [math.nan if value is None else self.of(float(value)) for value in values]


@dataclass(frozen=True, slots=True)
class Quantity:
    """A kind of value, such as a pressure.

    Attributes:
        name: its key.
        unit: SI unit.
        scales: unit system -> how it is shown.
    """

    name: str
    unit: str
    scales: Mapping[System, Scale]


def _quantity(
    name: str, unit: str, shown: Scale, *, si: Scale | None = None, us: Scale | None = None
) -> Quantity:
    return Quantity(name, unit, MappingProxyType({"si": si or shown, "bar": shown, "us": us or shown}))


#: Name of a quantity -> how it is shown; the system "bar" is that of reports and of the terminal.
QUANTITIES: Mapping[str, Quantity] = MappingProxyType(
    {
        quantity.name: quantity
        for quantity in (
            _quantity("length", "m", Scale("mm", 1e-3, 1), us=Scale("in", _INCH, 3)),
            _quantity(
                "pressure", "Pa", Scale("bar", 1e5, 3), si=Scale("kPa", 1e3, 1), us=Scale("psi", _PSI, 2)
            ),
            _quantity(
                "modulus", "Pa", Scale("N/mm²", 1e6, 4), si=Scale("MPa", 1e6, 4), us=Scale("psi", _PSI, 1)
            ),
            _quantity("force", "N", Scale("N", 1.0, 1), us=Scale("lbf", _LBF, 2)),
            _quantity(
                "stiffness",
                "N/m",
                Scale("N/mm", 1e3, 2),
                si=Scale("kN/m", 1e3, 2),
                us=Scale("lbf/in", _LBF / _INCH, 1),
            ),
            _quantity("volume", "m^3", Scale("cm³", 1e-6, 2), us=Scale("in³", _INCH**3, 3)),
            _quantity(
                "temperature",
                "K",
                Scale("°C", 1.0, 1, _CELSIUS_ZERO),
                si=Scale("K", 1.0, 1),
                us=Scale("°F", _FAHRENHEIT, 1, _FAHRENHEIT_ZERO),
            ),
            _quantity("torque", "N*m", Scale("N·m", 1.0, 2), us=Scale("lbf·in", _LBF * _INCH, 2)),
            _quantity("rotary", "N*m/rad", Scale("N·m/rad", 1.0, 2), us=Scale("lbf·in/rad", _LBF * _INCH, 2)),
            _quantity("energy", "J", Scale("J", 1.0, 2), us=Scale("ft·lbf", _LBF * _FOOT, 2)),
            _quantity("angle", "rad", Scale("°", _DEGREE, 2)),
            _quantity("ratio", "1", Scale("%", 0.01, 2)),
            _quantity("number", "1", Scale("", 1.0, 4)),
            _quantity("cost", "1", Scale("per 1000 cycles", 1e-3, 4)),
            _quantity("percent", "%", Scale("%", 1.0, 2)),
            _quantity("level", "1", Scale("dB", digits=1, decibels=True)),
            _quantity("time", "s", Scale("s", 1.0, 4)),
            _quantity("lapse", "s", Scale("ms", 1e-3, 1)),
            _quantity("frequency", "Hz", Scale("Hz", 1.0, 3)),
            _quantity("mass", "kg", Scale("kg", 1.0, 3), us=Scale("lb", _POUND, 3)),
            _quantity("speed", "m/s", Scale("m/s", 1.0, 3), us=Scale("in/s", _INCH, 2)),
            _quantity("sweep", "m/s", Scale("mm/s", 1e-3, 1), us=Scale("in/s", _INCH, 2)),
            _quantity("acceleration", "m/s^2", Scale("m/s²", 1.0, 2), us=Scale("ft/s²", _FOOT, 2)),
            _quantity("conductance", "m^3/(s*Pa)", Scale("l/(s·bar)", 1e-8, 4)),
            _quantity(
                "rate", "m^3/s", Scale("l/min", 1e-3 / 60.0, 1), us=Scale("ft³/min", _FOOT**3 / 60.0, 2)
            ),
            _quantity("flow", "kg/s", Scale("g/s", 1e-3, 3), us=Scale("lb/min", _POUND / 60.0, 3)),
            _quantity("air", "kg", Scale("g", 1e-3, 3), us=Scale("oz", _POUND / 16.0, 4)),
            _quantity("normal", "m^3", Scale("l (ANR)", 1e-3, 3)),
            _quantity("area", "m^2", Scale("N/bar", 1e-5, 2), us=Scale("lbf/psi", _LBF / _PSI, 4)),
            _quantity("compliance", "m/N", Scale("mm/kN", 1e-6, 2)),
            _quantity("softness", "1/N", Scale("%/kN", 1e-5, 3)),
            _quantity("damping", "N*s/m", Scale("N/(m/s)", 1.0, 1)),
            _quantity("pressureDamping", "N*s/(m*Pa)", Scale("N/(m/s·bar)", 1e-5, 3)),
            _quantity("perKelvin", "1/K", Scale("%/K", 1e-2, 3)),
            _quantity("gain", "1/m", Scale("%/mm", 10.0, 4)),
            _quantity("integralGain", "1/(m*s)", Scale("%/(mm·s)", 10.0, 4)),
            _quantity("derivativeGain", "s/m", Scale("%·s/mm", 10.0, 4)),
            _quantity("resistance", "Pa*s/m^3", Scale("bar/(l/s)", 1e8, 3)),
        )
    }
)

#: A probability below the first or above the second is only said to be: nothing is known that exactly.
CERTAIN = (0.01, 0.99)


def probability_text(probability: float) -> str:
    """A probability for people, in whole percents: "94 %", "> 99 %", "< 1 %"."""
    least, most = CERTAIN
    if probability > most:
        return f"> {100.0 * most:.0f} %"
    if probability < least:
        return f"< {100.0 * least:.0f} %"
    return f"{100.0 * probability:.0f} %"


# Of a unit that several quantities have: the one that a value is shown as where nothing else is known.
_NOT_THE_FIRST = {"modulus", "ratio", "cost", "level", "lapse", "sweep", "air", "normal"}
_OF_UNIT = {item.unit: item.name for item in QUANTITIES.values() if item.name not in _NOT_THE_FIRST}
_MODULUS = re.compile("modulus|constant")


def quantity_of(unit: str, name: str = "") -> str | None:
    """The quantity of a value by its SI unit; None where the unit is shown as it is.

    Args:
        unit: SI, "m3" and "m^3" alike.
        name: of the value; moduli and constants of elasticity are shown in N/mm², pressures in bar.
    """
    if unit == "Pa" and _MODULUS.search(name):
        return "modulus"
    return "number" if unit == "" else _OF_UNIT.get(re.sub(r"(?<=[A-Za-z])(?=[23])", "^", unit))


#: Unit that a form takes, in lower case -> quantity, factor, offset to SI.
TYPED: Mapping[str, tuple[str, float, float]] = MappingProxyType(
    {
        spelling: (quantity, factor, offset)
        for quantity, factor, offset, spellings in (
            ("length", 1.0, 0.0, ("m",)),
            ("length", 1e-2, 0.0, ("cm",)),
            ("length", 1e-3, 0.0, ("mm",)),
            ("length", 1e-6, 0.0, ("um", "µm")),
            ("length", _INCH, 0.0, ("in", "inch", '"')),
            ("length", _FOOT, 0.0, ("ft",)),
            ("pressure", 1.0, 0.0, ("pa",)),
            ("pressure", 100.0, 0.0, ("hpa", "mbar")),
            ("pressure", 1e3, 0.0, ("kpa",)),
            ("pressure", 1e6, 0.0, ("mpa", "n/mm²", "n/mm2", "n/mm^2")),
            ("pressure", 1e5, 0.0, ("bar",)),
            ("pressure", _PSI, 0.0, ("psi",)),
            ("pressure", 101325.0, 0.0, ("atm",)),
            ("force", 1.0, 0.0, ("n",)),
            ("force", 1e3, 0.0, ("kn",)),
            ("force", _LBF, 0.0, ("lbf", "lb")),
            ("force", 9.80665, 0.0, ("kgf",)),
            ("stiffness", 1.0, 0.0, ("n/m",)),
            ("stiffness", 1e3, 0.0, ("kn/m", "n/mm")),
            ("stiffness", _LBF / _INCH, 0.0, ("lbf/in",)),
            ("volume", 1.0, 0.0, ("m3", "m³")),
            ("volume", 1e-3, 0.0, ("l",)),
            ("volume", 1e-6, 0.0, ("ml", "cm³", "cm3")),
            ("volume", 1e-9, 0.0, ("mm³", "mm3")),
            ("volume", _INCH**3, 0.0, ("in³", "in3")),
            ("temperature", 1.0, 0.0, ("k",)),
            ("temperature", 1.0, _CELSIUS_ZERO, ("°c", "degc", "c")),
            ("temperature", _FAHRENHEIT, _FAHRENHEIT_ZERO, ("°f", "degf", "f")),
            ("energy", 1.0, 0.0, ("j",)),
            ("energy", _LBF * _FOOT, 0.0, ("ft·lbf",)),
            ("angle", _DEGREE, 0.0, ("°", "deg")),
            ("angle", 1.0, 0.0, ("rad",)),
            ("ratio", 0.01, 0.0, ("%",)),
            ("time", 1.0, 0.0, ("s",)),
            ("lapse", 1e-3, 0.0, ("ms",)),
            ("time", 60.0, 0.0, ("min",)),
            ("frequency", 1.0, 0.0, ("hz",)),
            ("frequency", 1e3, 0.0, ("khz",)),
            ("mass", 1.0, 0.0, ("kg",)),
            ("mass", 1e-3, 0.0, ("g",)),
            ("mass", 1e3, 0.0, ("t",)),
            ("mass", _POUND, 0.0, ("lbm",)),
            ("speed", 1.0, 0.0, ("m/s",)),
            ("speed", 1e-3, 0.0, ("mm/s",)),
            ("conductance", 1e-8, 0.0, ("l/(s·bar)", "l/(s*bar)")),
            ("conductance", 1e-8 / 60.0, 0.0, ("l/(min·bar)", "l/(min*bar)")),
            ("conductance", 1.0, 0.0, ("m3/(s*pa)",)),
            ("rate", 1e-3 / 60.0, 0.0, ("l/min",)),
            ("rate", _FOOT**3 / 60.0, 0.0, ("ft^3/min", "ft³/min")),
        )
        for spelling in spellings
    }
)

#: Names of units in documents, of which compound units are made: factor, exponents of m, kg, s, K and rad.
NAMES: Mapping[str, tuple[float, tuple[int, int, int, int, int]]] = MappingProxyType(
    {
        name: (factor, dimension)
        for dimension, names in (
            ((0, 0, 0, 0, 0), {"%": 0.01, "1": 1.0}),
            (
                (1, 0, 0, 0, 0),
                {"m": 1.0, "cm": 1e-2, "CM": 1e-2, "mm": 1e-3, "MM": 1e-3, "um": 1e-6, "µm": 1e-6},
            ),
            ((1, 0, 0, 0, 0), {"in": _INCH, "inch": _INCH, "ft": _FOOT}),
            ((3, 0, 0, 0, 0), {"l": 1e-3, "L": 1e-3, "ml": 1e-6}),
            ((0, 1, 0, 0, 0), {"kg": 1.0, "g": 1e-3, "t": 1e3, "lb": _POUND}),
            ((0, 0, 1, 0, 0), {"s": 1.0, "sec": 1.0, "Sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6}),
            ((0, 0, 1, 0, 0), {"min": 60.0, "h": 3600.0}),
            ((0, 0, -1, 0, 0), {"Hz": 1.0, "kHz": 1e3}),
            ((0, 0, 0, 1, 0), {"K": 1.0}),
            ((0, 0, 0, 0, 1), {"rad": 1.0, "deg": _DEGREE, "°": _DEGREE}),
            ((1, 1, -2, 0, 0), {"N": 1.0, "mN": 1e-3, "kN": 1e3, "lbf": _LBF}),
            ((-1, 1, -2, 0, 0), {"Pa": 1.0, "pa": 1.0, "hPa": 100.0, "kPa": 1e3, "kpa": 1e3, "KPa": 1e3}),
            ((-1, 1, -2, 0, 0), {"KPA": 1e3, "MPa": 1e6, "MPA": 1e6, "GPa": 1e9, "mbar": 100.0}),
            ((-1, 1, -2, 0, 0), {"bar": 1e5, "Bar": 1e5, "BAR": 1e5, "atm": 101325.0}),
            ((-1, 1, -2, 0, 0), {"psi": _PSI, "PSI": _PSI, "Psi": _PSI}),
            ((2, 1, -2, 0, 0), {"J": 1.0, "kJ": 1e3}),
            ((2, 1, -3, 0, 0), {"W": 1.0}),
        )
        for name, factor in names.items()
    }
)

#: Temperature scales, which cannot be part of a compound unit: factor and offset.
SHIFTED: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "degC": (1.0, _CELSIUS_ZERO),
        "°C": (1.0, _CELSIUS_ZERO),
        "degF": (_FAHRENHEIT, _FAHRENHEIT_ZERO),
    }
)
