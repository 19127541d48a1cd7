"""Units at the interfaces: all other code uses SI; text such as ``"300 mm"`` is converted only here.

A regular expression splits a text into one number and a unit text. The unit text is checked against a small
grammar (names, single-digit exponents, ``* / ( )``) before pint reads it, so a user's text is never evaluated
as an expression of numbers.
"""

from __future__ import annotations

import math
import re
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mckibben.physics.errors import InputError

if TYPE_CHECKING:
    import pint

MAX_UNIT_LENGTH = 40
MAX_TEXT_LENGTH = 100

_NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*(.*?)\s*", re.DOTALL)

_NAME = r"[A-Za-zµμΩΩÅ°%‰_]+(?:2O|Hg)?"  # 2O: cmH2O is a unit name, its digit is not an exponent
_TOKEN = re.compile(
    rf"({_NAME})(?:(?:\^|\*\*)?([+-]?[1-9])|([⁺⁻]?[¹²³⁴⁵⁶⁷⁸⁹]))?(?![0-9^⁰¹²³⁴⁵⁶⁷⁸⁹])|([()*/]|\s+)"
)
# "bar(a)", "bara", "bar abs", "psig", "MPa (gauge)": a pressure unit that says what it is counted from.
_REFERENCED = re.compile(
    r"(?P<unit>[kKMmhd]?(?:Pa|pa|PA)|[mM]?(?:bar|Bar|BAR)|(?:psi|PSI|Psi))\s*"
    r"(?:\(\s*(?P<bracketed>g|a|gauge|rel|abs|absolute)\s*\)|(?P<bare>[ga]|gauge|rel|abs|absolute))\.?",
)
Reference = Literal["gauge", "absolute"]
STANDARD_ATMOSPHERE = 101_325.0  # Pa
GRAVITY = 9.80665  # m/s2, standard
_SUPERSCRIPT = str.maketrans("⁺⁻¹²³⁴⁵⁶⁷⁸⁹", "+-123456789")

# Spellings that pint lacks or reads differently: "pct" as a picocarat, "Nm" as a textile count.
_ALIASES = {
    "%": "percent", "pct": "percent", "‰": "permille", "°": "degree", "Nm": "N*m", "Nmm": "N*mm",
    "Bar": "bar", "BAR": "bar",
    "PSI": "psi", "Psi": "psi", "kpa": "kPa", "KPa": "kPa", "KPA": "kPa", "MPA": "MPa", "pa": "Pa",
    "MM": "mm", "CM": "cm", "sec": "s", "Sec": "s",
}  # fmt: skip

#: SI unit text -> (what it measures, an example value).
_MEANING = {
    "m": ("a length", "300 mm"),
    "Pa": ("a pressure", "6 bar"),
    "rad": ("an angle", "25 deg"),
    "N": ("a force", "120 N"),
    "1": ("a plain number or a share", "25 %"),
    "K": ("a temperature", "20 degC"),
    "kg": ("a mass", "12 kg"),
    "s": ("a time", "0.5 s"),
    "m/s": ("a speed", "0.2 m/s"),
    "m/s^2": ("an acceleration", "9.81 m/s^2"),
    "N/m": ("a stiffness", "2 N/mm"),
    "N*s/m": ("a damping coefficient", "120 N*s/m"),
    "N*m": ("an energy or a torque", "5 N*m"),
    "m^2": ("an area", "12 mm^2"),
    "m^3": ("a volume", "0.2 l"),
    "m^3/s": ("a volume flow", "300 l/min"),
    "m^3/(s*Pa)": ("a flow conductance", "1.2 l/(s*bar)"),
    "1/s": ("a rate", "5 1/s"),
    "Hz": ("a frequency", "10 Hz"),
    "kg/m": ("a mass per length", "94 g/m"),
    "W": ("a power", "5 W"),
    "V": ("a voltage", "5 V"),
    "A": ("a current", "0.02 A"),
}


class Factor(NamedTuple):
    """Conversion to SI: ``value * multiplier / divisor + offset``.

    The divisor keeps decimal units exact: 0.001 has no exact binary form, 1000 has.
    """

    multiplier: float
    divisor: float
    offset: float


class _UnitError(ValueError):
    """Why a unit text cannot be used; becomes an InputError once the field is known."""


@cache
def _registry() -> pint.UnitRegistry[Any]:
    """The pint registry, built once [20 ms with its disk cache, 250 ms without]."""
    import pint

    try:
        return pint.UnitRegistry(cache_folder=":auto:")
    except (
        Exception
    ):  # no writable or readable cache folder (OSError, RuntimeError, broken pickle): do without
        return pint.UnitRegistry()


def _normalised(text: str) -> str:
    """Unit text in the spelling for pint; raises _UnitError when it violates the grammar."""
    if len(text) > MAX_UNIT_LENGTH:
        raise _UnitError(f"the unit is longer than {MAX_UNIT_LENGTH} characters")
    if "//" in text:
        raise _UnitError(f"'{text}' is not a unit")
    rest = text.replace("·", "*").replace("⋅", "*").replace("×", "*").strip()
    if rest in ("", "1", "-"):
        return ""
    parts = []
    if rest.startswith("1/"):
        parts, rest = ["1/"], rest[2:]
    position = 0
    while position < len(rest):
        token = _TOKEN.match(rest, position)
        if token is None:
            raise _UnitError(f"'{text}' is not a unit")
        name, exponent, superscript, sign = token.groups()
        if name:
            power = exponent or (superscript or "").translate(_SUPERSCRIPT)
            known = _ALIASES.get(name, name)
            parts.append(f"({known})**({power})" if power else f"({known})" if "*" in known else known)
        else:
            parts.append(" " if sign.isspace() else sign)
        position = token.end()
    return "".join(parts)


def _base(text: str) -> tuple[Any, float, str]:
    """(base units, factor, text for pint) of a unit text; angle and ratio stay different base units."""
    registry = _registry()
    name = _normalised(text)
    if not name:
        return registry.Unit(""), 1.0, ""
    try:
        scale, base = registry.get_base_units(registry.parse_units(name))
        return base, float(cast(float, scale)), name
    except (
        Exception
    ) as error:  # pint raises AssertionError, KeyError, tokenizer and other errors for bad text
        raise _UnitError(f"'{text}' is not a known unit") from error


@cache
def _meanings() -> dict[Any, str]:
    return {_base(text)[0]: meaning for text, (meaning, _) in reversed(_MEANING.items())}


def _expected(si_unit: str) -> tuple[str, str]:
    """(what is needed, example) for an SI unit text, whatever its spelling."""
    if si_unit in _MEANING:
        return _MEANING[si_unit]
    base = _base(si_unit)[0]
    same = (meaning for text, meaning in _MEANING.items() if _base(text)[0] == base)
    return next(same, (f"a value in {si_unit}", f"1 {si_unit}"))


@lru_cache(maxsize=2048)
def factor(unit_text: str, si_unit: str) -> Factor:
    """Conversion from ``unit_text`` to ``si_unit``; a ValueError (without field) when there is none."""
    base, scale, name = _base(unit_text)
    target, target_scale, _ = _base(si_unit)
    if base != target:
        raise _UnitError(f"{_meanings().get(base, f'in {base}')}, {_expected(si_unit)[0]} is needed")
    offset = 0.0
    if name:
        quantity = _registry().Quantity
        try:
            zero, one, two = (float(quantity(x, name).to(target).magnitude) for x in (0.0, 1.0, 2.0))
        except Exception as error:  # a temperature scale with an offset inside a product
            raise _UnitError(f"'{unit_text}' cannot be converted") from error
        if not math.isclose(two - one, one - zero, rel_tol=1e-9):
            raise _UnitError(f"'{unit_text}' is a logarithmic unit")
        offset = zero
    scale /= target_scale
    whole = round(1.0 / scale) if scale < 1.0 else 0
    if whole and math.isclose(whole * scale, 1.0, rel_tol=1e-12):
        return Factor(1.0, float(whole), offset)
    if scale >= 1.0 and math.isclose(scale, round(scale), rel_tol=1e-12):
        scale = float(round(scale))
    return Factor(scale, 1.0, offset)


def is_unit(text: str) -> bool:
    """Whether ``text`` is a known unit (of any kind)."""
    try:
        _base(text)
    except _UnitError:
        return False
    return bool(text.strip())


def meaning(unit_text: str) -> str | None:
    """What a unit measures ("a length"); None for an unknown or uncommon unit."""
    try:
        return _meanings().get(_base(unit_text)[0])
    except _UnitError:
        return None


def si(
    value: object,
    unit: str,
    *,
    field: str | None = None,
    reference: Reference | None = None,
    ambient: float = STANDARD_ATMOSPHERE,
) -> float:
    """A physical value of the caller in SI.

    Args:
        value: a number (already SI) or a text of number and unit, ``"300 mm"``, ``"25 %"``, ``"20 degC"``.
        unit: the SI unit the value must be compatible with (``"m"``, ``"rad"``, ``"1"``, ``"m3/(s*Pa)"`` …).
        field: path of the value, for the message ("muscle.nominal_length").
        reference: what a pressure is counted from in the result. A text may say what its number is counted
            from, "3 bar(a)", "30 psig", and is converted; without a word of it the number is as needed.
        ambient: absolute pressure of the surroundings, for that conversion [Pa].

    Raises:
        InputError: nan or inf, a boolean, an empty text, a text without unit (unless ``unit`` is ``"1"``), an
            unknown unit, a unit of another dimension. An angle is not a plain number: ``"25 deg"`` is refused
            for ``"1"``, ``"25 %"`` for ``"rad"``.

    >>> si("300 mm", "m")
    0.3
    >>> round(si("4.01325 bar(a)", "Pa", reference="gauge"))
    300000
    """
    if type(value) is float and math.isfinite(value):
        return value
    if isinstance(value, str):
        if unit != "Pa":
            return _from_text(value, unit, field)
        text, offset = _referenced(value, reference, ambient, field)
        return _from_text(text, unit, field) + offset
    return _from_number(value, unit, field)


def convert(
    values: ArrayLike, unit_text: str, si_unit: str, *, field: str | None = None
) -> NDArray[np.float64]:
    """A column of numbers in ``unit_text`` as a new array in ``si_unit``; nan passes through.

    Raises:
        InputError: the unit is unknown or of another dimension.
    """
    try:
        multiplier, divisor, offset = factor(unit_text, si_unit)
    except _UnitError as error:
        raise _refusal(_as_sentence(f"the unit '{unit_text}'", error), si_unit, field) from error
    result = np.array(values, dtype=np.float64)
    with np.errstate(over="ignore"):  # an overflow gives inf, which the caller refuses with its row
        if multiplier != 1.0:
            result *= multiplier
        if divisor != 1.0:
            result /= divisor
        if offset:
            result += offset
    return result


def absolute_text(value: object) -> bool:
    """Whether a value is the text of a pressure that says it is absolute."""
    return isinstance(value, str) and _split_reference(value)[1] == "absolute"


def _split_reference(value: str) -> tuple[str, Reference | None]:
    """The text without the word for the reference of its pressure, and the reference; None without one."""
    parsed = _QUANTITY.fullmatch(value) if len(value) <= MAX_TEXT_LENGTH else None
    found = _REFERENCED.fullmatch(parsed.group(2)) if parsed is not None else None
    if parsed is None or found is None:
        return value, None
    word = found["bracketed"] or found["bare"]
    return f"{parsed.group(1)} {found['unit']}", "absolute" if word.startswith("a") else "gauge"


def _referenced(value: str, wanted: Reference | None, ambient: float, field: str | None) -> tuple[str, float]:
    """The text without its reference, and what is to be added in Pa."""
    text, stated = _split_reference(value)
    if stated is None:
        return value, 0.0
    if wanted is None and stated == "absolute":
        raise _refusal(
            f"'{value.strip()}' is an absolute pressure, a gauge pressure or a difference is needed",
            "Pa",
            field,
        )
    if wanted is None or wanted == stated:
        return text, 0.0
    return text, -ambient if stated == "absolute" else ambient


def _from_number(value: Any, unit: str, field: str | None) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        shown = "empty" if value is None else f"of type {type(value).__name__}"
        raise _refusal(f"the value is {shown}, {_expected(unit)[0]} is needed", unit, field)
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise _refusal(
            f"{number} is not a number that can be used, {_expected(unit)[0]} is needed", unit, field
        )
    return number


def _from_text(value: str, unit: str, field: str | None) -> float:
    shown = value.strip() if len(value) <= MAX_UNIT_LENGTH else value[:MAX_UNIT_LENGTH].strip() + "…"

    def refuse(why: str) -> InputError:
        return _refusal(f"'{shown}' {why}" if shown else "the value is empty", unit, field)

    if len(value) > MAX_TEXT_LENGTH or (parsed := _QUANTITY.fullmatch(value)) is None:
        raise refuse(f"does not begin with a number, {_expected(unit)[0]} is needed")
    number, unit_text = parsed.groups()
    if not unit_text and unit != "1":
        raise refuse(f"has no unit, {_expected(unit)[0]} is needed")
    try:
        multiplier, divisor, offset = factor(unit_text, unit)
    except _UnitError as error:
        if re.match(r",[0-9]", unit_text):
            raise refuse("has a decimal comma, use a decimal point") from error
        if re.match(r"[0-9.]", unit_text) and not unit_text.startswith("1/"):
            raise refuse("is more than one number") from error
        raise _refusal(_as_sentence(f"'{shown}'", error), unit, field) from error
    result = float(number) * multiplier / divisor + offset
    if not math.isfinite(result):
        raise refuse("is too large")
    return result


def _as_sentence(subject: str, error: _UnitError) -> str:
    text = str(error)
    return f"{subject} is {text}" if text.endswith("needed") else f"{subject} cannot be used: {text}"


def _refusal(problem: str, unit: str, field: str | None) -> InputError:
    """The InputError of a value: field, what is wrong, an example of a valid value."""
    return InputError(
        f"{field}: {problem}" if field else problem, field=field, hint=f"e.g. '{_expected(unit)[1]}'"
    )
