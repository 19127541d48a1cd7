"""Cells as people write them: numbers with thousands marks, times of day, dates, gaps."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime, timedelta
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from mckibben.measurement.reading.lexicon import marker_of
from mckibben.measurement.reading.model import Array, Gap

NUMBER, CLOCK, TEXT, MARK, EMPTY = "n", "c", "t", "m", ""
_LONGEST = 60  # characters of a cell that may be a number

_PLAIN = re.compile(r"(?:[+-] {0,8})?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eEdD][+-]?[0-9]{1,3})?")
_GROUPED = re.compile(
    r"[+-]?[0-9]{1,3}(?:(?P<mark>[.,'’ \u00a0\u202f])[0-9]{3})(?:(?P=mark)[0-9]{3}){0,8}"
    r"(?P<rest>[.,][0-9]{0,15})?"
)
_TOLERANCE = re.compile(r"([+-]?[0-9]{1,12}(?:[.,][0-9]{1,12})?)\s?(?:±|\+/-|\+-)\s?[0-9.,]{1,12}")
_WITH_UNIT = re.compile(r"([+-]?[0-9]{1,12}(?:[.,][0-9]{1,12})?)\s?([^\W\d_]{1,5}(?:/[^\W\d_]{1,4})?|%)")
_DAY = r"(?:[0-9]{4}[-/.][0-9]{1,2}[-/.][0-9]{1,2}|[0-9]{1,2}[./-][0-9]{1,2}[./-][0-9]{2,4})"
_TIME = r"[0-9]{1,2}:[0-9]{2}(?::[0-9]{2}(?:[.,:][0-9]{1,9})?)?(?: ?[aApP][mM])?"
_MINUTES = r"[0-9]{1,3}:[0-5][0-9][.,][0-9]{1,9}"  # and seconds: hours and minutes have no fraction
_HOURS = r"([0-9]{1,2}) ?[hH] ?([0-5][0-9])(?: ?(?:m|min|mn|') ?([0-5][0-9]) ?(?:s|\")?)?"  # 14h02, 14h02m10
_CLOCK = re.compile(
    rf"{_TIME}|{_HOURS}|{_MINUTES}|{_DAY}(?:[T ]{{1,3}}{_TIME}(?:Z| ?[+-][0-9]{{2}}:?[0-9]{{2}})?)?"
)


_WIDE = {ord("０") + k: str(k) for k in range(10)} | {ord("－"): "-", ord("＋"): "+"}
_WIDE_POINT = re.compile(r"(?<=[0-9])．(?=[0-9])")


def narrow(text: str) -> str:
    """A text with the digits of wide letters as plain ones.

    >>> narrow("０．３")
    '0.3'
    """
    return text if text.isascii() else _WIDE_POINT.sub(".", text.translate(_WIDE))


class NumberStyle(NamedTuple):
    """How numbers are written: the decimal sign, and the mark between thousands ("" = none)."""

    decimal: str = "."
    thousands: str = ""


@lru_cache(maxsize=131072)
def _kind_of_text(text: str) -> str:
    bare = text.strip().replace("−", "-")
    if not bare:
        return EMPTY
    if _PLAIN.fullmatch(bare):
        return NUMBER
    if marker_of(bare) is not None:
        return MARK
    found = _GROUPED.fullmatch(bare)
    if found is not None and found["mark"] != (found["rest"] or "x")[0]:
        return NUMBER
    if _TOLERANCE.fullmatch(bare):
        return NUMBER
    return CLOCK if _CLOCK.fullmatch(bare) else TEXT


def kind_of(cell: Any) -> str:
    """Whether a cell is a number, a time or date, a text, a mark for no reading, or empty."""
    if isinstance(cell, str):
        return _kind_of_text(cell) if len(cell) < _LONGEST else TEXT
    if isinstance(cell, float):
        return NUMBER if cell == cell else MARK
    if isinstance(cell, (datetime, timedelta)):
        return CLOCK
    return EMPTY if cell is None else TEXT


_MOSTLY = 3  # cells with one decimal sign for each with the other one, which then is a mistake


def style_of(cells: Iterable[Any]) -> NumberStyle:
    """The way the numbers of a table are written; a mark that could be both is a decimal sign."""
    commas = points = 0  # cells in which the sign can only be a decimal sign
    marks: set[str] = set()  # signs that can only part thousands
    unsure_commas = unsure_points = False
    for cell in cells:
        if not isinstance(cell, str) or not cell or len(cell) > _LONGEST:
            continue
        text = cell.strip().replace("−", "-")
        if (longer := _TOLERANCE.fullmatch(text) or _WITH_UNIT.fullmatch(text)) is not None:
            text = longer[1]
        grouped = _GROUPED.fullmatch(text)
        if grouped is not None:
            mark, rest = grouped["mark"], grouped["rest"]
            if rest or mark not in ".," or text.count(mark) > 1:
                marks.add(mark)
                commas += bool(rest) and rest[0] == ","
                points += bool(rest) and rest[0] == "."
                continue
            if text.lstrip("+-").startswith("0"):
                commas, points = commas + (mark == ","), points + (mark == ".")
            unsure_commas |= mark == ","
            unsure_points |= mark == "."
        elif _PLAIN.fullmatch(text):
            commas, points = commas + ("," in text), points + ("." in text)
    if commas > _MOSTLY * points:
        return NumberStyle(",", "." if "." in marks or unsure_points else next(iter(marks - {","}), ""))
    if points > _MOSTLY * commas:
        return NumberStyle(".", "," if "," in marks or unsure_commas else next(iter(marks - {"."}), ""))
    if unsure_commas and not unsure_points and not points:
        return NumberStyle(",", next(iter(marks - {","}), ""))
    return NumberStyle(".", next(iter(marks - {"."}), "") if not commas else "")


def number_of(cell: Any, style: NumberStyle) -> float:
    """The number of a cell in this style; NaN where it holds none."""
    if isinstance(cell, float):
        return cell
    if not isinstance(cell, str) or not cell:
        return np.nan
    text = cell.strip().replace("−", "-")
    if style.thousands and style.thousands in text and _GROUPED.fullmatch(text):
        text = text.replace(style.thousands, "")
        if style.thousands in " \u00a0\u202f":
            text = text.replace(" ", "").replace("\u00a0", "").replace("\u202f", "")
    elif (found := _TOLERANCE.fullmatch(text)) is not None:
        text = found[1]
    if not _PLAIN.fullmatch(text) or (style.decimal not in text and ("," in text or "." in text)):
        return np.nan
    return float(text.replace(",", ".").replace(" ", "").replace("d", "e").replace("D", "e"))


def numbers_of(cells: Sequence[Any], style: NumberStyle) -> tuple[Array, dict[int, Gap]]:
    """The numbers of cells, NaN where they hold none, and what stands there."""
    values = np.empty(len(cells))
    gaps: dict[int, Gap] = {}
    plain = style == NumberStyle()
    for row, cell in enumerate(cells):
        try:
            value = (
                float(cell)
                if isinstance(cell, float) or (plain and cell.isascii() and "_" not in cell)
                else number_of(cell, style)
            )
        except (ValueError, TypeError, AttributeError):
            value = number_of(cell, style)
        if not np.isfinite(value):
            text = cell.strip() if isinstance(cell, str) else "" if cell is None else str(cell)
            gaps[row] = Gap(_why(cell, text, value, style), text[:40])
            value = np.nan
        values[row] = value
    return values, gaps


#: Reasons of cells that should hold a number and do not -> what is said of them.
BROKEN = {
    "broken": "is not a number", "too large": "is too large",
    "other sign": "has another decimal sign than the cells around it",
}  # fmt: skip


def _why(cell: Any, text: str, value: float, style: NumberStyle) -> str:
    if isinstance(cell, float):
        return "not a finite number"
    if not text:
        return "empty"
    if (marker := marker_of(text)) is not None:
        return marker
    if not _PLAIN.fullmatch(text):
        return "broken"
    return "too large" if np.isinf(value) else "other sign" if style.decimal not in text else "broken"


def with_units(cells: Sequence[Any]) -> tuple[list[Any], str]:
    """Cells ``12.5 bar`` as numbers and their one unit; the cells as they are where they have none in
    common.
    """
    texts = [cell.strip() for cell in cells if isinstance(cell, str) and cell.strip()]
    found = [_WITH_UNIT.fullmatch(text) for text in texts]
    units = {match[2] for match in found if match}
    if len(units) != 1 or sum(map(bool, found)) < 0.7 * len(texts):
        return list(cells), ""
    stripped = [
        match[1] if isinstance(cell, str) and (match := _WITH_UNIT.fullmatch(cell.strip())) else cell
        for cell in cells
    ]
    return stripped, units.pop()


def seconds_of(cells: Sequence[Any], *, falling: bool = False) -> Array:
    """Times of day or dates as seconds from the first; a day is added at midnight. NaN where a cell is
    none.
    """
    texts = [cell.strip() for cell in cells if isinstance(cell, str) and kind_of(cell) == CLOCK]
    elapsed = (
        bool(texts)
        and all(re.fullmatch(r"[0-9]{1,3}:[0-9]{2}", t) for t in texts)
        and texts[0][:-3] in ("0", "00")
    )
    stamps = [absolute_seconds(cell) for cell in cells]
    steps = [b[0] - a[0] for a, b in pairwise(s for s in stamps if s is not None)]
    falling = falling or sum(step < 0.0 for step in steps) > sum(step > 0.0 for step in steps)
    sign, origin, last, days = (-1.0 if falling else 1.0), None, 0.0, 0.0
    values = np.full(len(cells), np.nan)
    for row, stamp in enumerate(stamps):
        if stamp is None:
            continue
        seconds, dated = stamp
        if not dated:
            if elapsed:
                seconds /= 60.0
            if origin is not None and sign * (seconds + days - last) < -43_200.0:
                days += sign * 86_400.0
            seconds += days
            last = seconds
        origin = seconds if origin is None else origin
        values[row] = round(seconds - origin, 9)
    return values


@lru_cache(maxsize=65536)
def absolute_seconds(cell: Any) -> tuple[float, bool] | None:
    """(seconds, whether they hold the date) of a time of day or a date; None = the cell is none."""
    if isinstance(cell, datetime):
        return cell.replace(tzinfo=cell.tzinfo or UTC).timestamp(), cell.year > 1905
    if isinstance(cell, timedelta):
        return cell.total_seconds(), False
    if not isinstance(cell, str) or len(cell) > _LONGEST or not _CLOCK.fullmatch(cell.strip()):
        return None
    text = cell.strip()
    if spoken := re.fullmatch(_HOURS, text):
        text = ":".join(part for part in spoken.groups() if part)
    if re.fullmatch(_MINUTES, text):
        minutes, seconds = text.replace(",", ".").split(":")
        return 60.0 * int(minutes) + float(seconds), False
    found = re.match(rf"({_DAY})?[T ]{{0,3}}(.*)", text)
    day, rest = found.groups() if found else (None, "")
    time = re.match(
        r"([0-9]{1,2}):([0-9]{2})(?::([0-9]{2})(?:[.,:]([0-9]{1,9}))?)? ?([aApP][mM])?", rest or "0:00"
    )
    if time is None:
        return None
    hours, minutes, seconds, fraction, half = time.groups()
    value = 3600.0 * int(hours) + 60.0 * int(minutes) + int(seconds or 0)
    if half:
        value += 43_200.0 * ((half.lower() == "pm") - (int(hours) == 12))
    value += int(fraction) / 10 ** len(fraction) if fraction else 0.0
    if day is None:
        return value, False
    year, month, date = _parts_of_day(day)
    try:
        return datetime(year, month, date, tzinfo=UTC).timestamp() + value, True
    except ValueError:
        return None


def _parts_of_day(day: str) -> tuple[int, int, int]:
    parts = [int(part) for part in re.split(r"[-/.]", day)]
    if len(re.split(r"[-/.]", day)[0]) != 4:
        parts = [parts[2] + (2000 if parts[2] < 100 else 0), parts[1], parts[0]]
        if parts[1] > 12:
            parts[1], parts[2] = parts[2], parts[1]
    return parts[0], parts[1], parts[2]
