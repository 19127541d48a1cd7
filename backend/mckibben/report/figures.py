"""Numbers for readers: common units, significant digits only, with the exact SI value in the markup."""

from __future__ import annotations

import math

from mckibben.facts.comparison import CHANNELS
from mckibben.facts.units import QUANTITIES, Scale, probability_text, quantity_of
from mckibben.report.html import Html, html, tag

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_SMALLEST, _LARGEST = 1e-3, 1e5  # outside, scientific notation is used
_LEAST_SHARE = 1e-5


PLAIN = Scale("")

_CONDUCTANCE = ("m^3/(s*Pa)", "m3/(s*Pa)")
_LEAK = 1e-9  # m3/(s Pa); a valve has more
_SHORT = 0.1  # s; below, times are in ms


def variable(name: str) -> tuple[str, Scale]:
    """Name of a channel or variable in words, and its display unit."""
    figure = CHANNELS.get(name)
    return (name.replace("_", " "), PLAIN) if figure is None else (figure.words, figure.scale)


def scale_of(unit: str, value: float | None = None, name: str = "") -> Scale:
    """Display unit of an SI unit; that of conductances and times depends on the value.

    Args:
        unit: SI.
        value: SI.
        name: of the parameter; moduli and constants of elasticity are in N/mm², pressures in bar.
    """
    if unit == "s" and 0.0 < abs(value or 0.0) < _SHORT:
        return Scale("ms", 1e-3)
    if unit in _CONDUCTANCE and 0.0 < abs(value or 0.0) < _LEAK:
        return Scale("ml/(s·bar)", 1e-11)
    if unit == "1":
        return PLAIN
    quantity = quantity_of(unit, name)
    return Scale(pretty(unit)) if quantity is None else QUANTITIES[quantity].scales["bar"]


def pretty(unit: str) -> str:
    """A unit with superscripts and middle dots: "N*s/m^2" becomes N·s/m²."""
    words = unit.replace("*", "·").split("^")
    if len(words) == 1:
        return words[0]
    powers = [word[:1].translate(_SUPERSCRIPT) + word[1:] for word in words[1:]]
    return "".join([words[0], *powers])


def plain(value: float | None, digits: int = 4, *, exact: bool = False) -> str:
    """A number with ``digits`` significant digits; a dash for None. ``exact`` drops trailing zeros."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    rounded = float(f"{value:.{digits - 1}e}")
    size = abs(rounded)
    if not _SMALLEST <= size < _LARGEST:
        exponent = math.floor(math.log10(size))
        factor = f"{rounded / 10.0**exponent:.{digits - 1}f}".rstrip("0").rstrip(".")
        return _signed(f"{factor}·10{str(exponent).translate(_SUPERSCRIPT)}")
    decimals = max(digits - 1 - math.floor(math.log10(size)), 0)
    text = f"{rounded:.{decimals}f}"
    return _signed(text.rstrip("0").rstrip(".") if exact and decimals else text)


def _signed(text: str) -> str:
    return text.replace("-", "\u2212")


def figure(value: float | None, scale: Scale = PLAIN, digits: int = 4, *, exact: bool = False) -> Html:
    """An SI value as ``<data value="SI">value unit</data>``; a dash for None. ``exact`` as in `plain`."""
    if value is None or not math.isfinite(value):
        return html("–")
    shown = plain(scale.of(value), digits, exact=exact)
    return tag("data", _with_unit(shown, scale.unit), value=repr(float(value)))


def with_error(value: float, error: float | None, scale: Scale) -> Html:
    """Value and standard error, rounded to two digits of the error: (0.9047 ± 0.0088) N/mm²."""
    if error is None or not math.isfinite(error) or error <= 0.0:
        return figure(value, scale, exact=True)
    shown, spread = scale.of(value), error / scale.factor
    # A value far below its error still shows one digit of the error.
    size = max(abs(shown), spread)
    digits = math.floor(math.log10(size)) - math.floor(math.log10(spread)) + 2
    if not _SMALLEST <= size < _LARGEST:
        exponent = math.floor(math.log10(size))
        small = [f"{part / 10.0**exponent:.{max(min(digits, 9) - 1, 0)}f}" for part in (shown, spread)]
        text = f"({small[0]} ± {small[1]})·10{str(exponent).translate(_SUPERSCRIPT)}"
    else:
        decimals = max(1 - math.floor(math.log10(spread)), 0)
        text = f"{shown:.{decimals}f} ± {spread:.{decimals}f}"
        text = f"({text})" if scale.unit else text
    return tag("data", _with_unit(_signed(text), scale.unit), value=repr(float(value)))


def percent(share: float | None, digits: int = 2) -> Html:
    """A share (1 = 100 %) in percent; a share that rounding of the computer can make is "< 0.001 %"."""
    if share is not None and 0.0 < abs(share) < _LEAST_SHARE:
        return tag("data", "< 0.001\N{NO-BREAK SPACE}%", value=repr(float(share)))
    return figure(share, Scale("%", 0.01), digits)


def probability(share: float | None) -> Html:
    """A probability in percent; near its ends no digits, because nothing is known that exactly."""
    return html("–" if share is None else probability_text(share).replace(" %", "\N{NO-BREAK SPACE}%"))


def _with_unit(text: str, unit: str) -> str:
    if not unit:
        return text
    return f"{text}{'' if unit == '°' else chr(0xA0)}{unit}"
