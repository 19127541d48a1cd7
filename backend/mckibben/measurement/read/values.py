"""Cells of a table as people write them: numbers with thousands marks, times of day, dates, gaps."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime, timedelta
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from mckibben.measurement.read.cells import Cell, marker_of

NUMBER, CLOCK, TEXT, GAP = "n", "c", "t", ""

_PLAIN = re.compile(r"(?:[+-] *)?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][+-]?[0-9]+)?")
_GROUPED = re.compile(
    r"[+-]?[0-9]{1,3}(?:(?P<mark>[.,'’ \u00a0\u202f])[0-9]{3})(?:(?P=mark)[0-9]{3})*(?P<rest>[.,][0-9]*)?"
)
_DAY = r"(?:[0-9]{4}[-/.][0-9]{1,2}[-/.][0-9]{1,2}|[0-9]{1,2}[./-][0-9]{1,2}[./-][0-9]{2,4})"
_TIME = r"[0-9]{1,2}:[0-9]{2}(?::[0-9]{2}(?:[.,:][0-9]{1,9})?)?(?:\s*[aApP][mM])?"
_MINUTES = r"[0-9]{1,3}:[0-5][0-9][.,][0-9]{1,9}"  # and seconds: hours and minutes have no fraction
_HOURS = (
    r"([0-9]{1,2})\s?[hH]\s?([0-5][0-9])(?:\s?(?:m|min|mn|')?\s?([0-5][0-9])\s?(?:s|\")?)?"  # 14h02, 14h02m10
)
_CLOCK = re.compile(
    rf"{_TIME}|{_HOURS}|{_MINUTES}|{_DAY}(?:[T ]+{_TIME}(?:Z|\s*[+-][0-9]{{2}}:?[0-9]{{2}})?)?"
)


class NumberStyle(NamedTuple):
    """How numbers are written: the decimal sign, and the mark between thousands ("" = none)."""

    decimal: str
    thousands: str


@lru_cache(maxsize=65536)
def _kind_of_text(text: str) -> str:
    bare = text.strip()
    if not bare or marker_of(bare) is not None:
        return GAP
    if _PLAIN.fullmatch(bare):
        return NUMBER
    found = _GROUPED.fullmatch(bare)
    if found is not None and found["mark"] != (found["rest"] or " x")[0]:
        return NUMBER
    return CLOCK if _CLOCK.fullmatch(bare) else TEXT


def kind_of(cell: Cell) -> str:
    """Whether a cell is a number, a time or date, a text, or a gap."""
    if cell is None:
        return GAP
    if isinstance(cell, str):
        return _kind_of_text(cell) if len(cell) < 60 else TEXT
    if isinstance(cell, bool):
        return TEXT
    if isinstance(cell, (datetime, timedelta)):
        return CLOCK
    return NUMBER if cell == cell else GAP


def style_of(cells: Iterable[Cell]) -> NumberStyle:
    """The way the numbers of a table are written; a mark that could be both is a decimal sign."""
    commas = points = 0  # cells in which the sign can only be a decimal sign
    marks: set[str] = set()  # signs that can only part thousands
    unsure_commas = unsure_points = False
    for cell in cells:
        if not isinstance(cell, str):
            continue
        text = cell.strip()
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
    if commas and not points:
        thousands = "." if "." in marks or unsure_points else next(iter(marks - {","}), "")
        return NumberStyle(",", thousands)
    if points and not commas:
        thousands = "," if "," in marks or unsure_commas else next(iter(marks - {"."}), "")
        return NumberStyle(".", thousands)
    if unsure_commas and not unsure_points and not points:
        return NumberStyle(",", next(iter(marks - {","}), ""))
    return NumberStyle(".", next(iter(marks - {"."}), "") if not commas else "")


def number_of(cell: Cell, style: NumberStyle) -> Cell:
    """A cell as a number where it is one in this style; anything else as it is."""
    if not isinstance(cell, str):
        return cell
    text = cell.strip().replace("−", "-")
    if style.thousands and style.thousands in text and _GROUPED.fullmatch(text):
        text = text.replace(style.thousands, "")
        if style.thousands in " \u00a0\u202f":
            text = re.sub(r"[ \u00a0\u202f]", "", text)
    if _PLAIN.fullmatch(text) and (style.decimal in text or not re.search("[.,]", text)):
        return float(text.replace(",", ".").replace(" ", ""))
    return cell


class Clock:
    """A column of times of day or dates as seconds from its first cell; a day is added at midnight.

    Args:
        elapsed: times of two parts are minutes and seconds, not hours and minutes.
        falling: the rows run backwards in time.
    """

    def __init__(self, *, elapsed: bool = False, falling: bool = False) -> None:
        self._share = 1.0 / 60.0 if elapsed else 1.0
        self._sign = -1.0 if falling else 1.0
        self._origin: float | None = None
        self._last = 0.0
        self._days = 0.0

    def seconds(self, cell: Cell) -> Cell:
        """Seconds from the first cell; the cell itself where it is no time."""
        value = _absolute_seconds(cell)
        if value is None:
            return cell
        stamp, dated = value
        if not dated:
            if self._share != 1.0 and isinstance(cell, str) and cell.count(":") == 1:
                stamp *= self._share
            beyond = self._sign * (stamp + self._days - self._last)
            if self._origin is not None and beyond < -43_200.0:
                self._days += self._sign * 86_400.0
            stamp += self._days
            self._last = stamp
        if self._origin is None:
            self._origin = stamp
        return round(stamp - self._origin, 9)


def is_elapsed(cells: Sequence[Cell]) -> bool:
    """Whether times of two parts, ``0:03``, are minutes and seconds: they begin at zero, as no clock does."""
    times = [cell.strip() for cell in cells if isinstance(cell, str) and kind_of(cell) == CLOCK]
    return (
        bool(times)
        and all(re.fullmatch(r"[0-9]{1,3}:[0-9]{2}", t) for t in times)
        and times[0][:-3] in ("0", "00")
    )


def is_falling(cells: Sequence[Cell]) -> bool:
    """Whether most times of a column are earlier than the one before."""
    stamps = [value[0] for cell in cells if (value := _absolute_seconds(cell)) is not None]
    steps = [b - a for a, b in pairwise(stamps)]
    return sum(step < 0.0 for step in steps) > sum(step > 0.0 for step in steps)


def _absolute_seconds(cell: Cell) -> tuple[float, bool] | None:
    if isinstance(cell, datetime):
        return cell.replace(tzinfo=cell.tzinfo or UTC).timestamp(), True
    if isinstance(cell, timedelta):
        return cell.total_seconds(), False
    if not isinstance(cell, str) or not _CLOCK.fullmatch(cell.strip()):
        return None
    text = cell.strip()
    if spoken := re.fullmatch(_HOURS, text):
        text = ":".join(part for part in spoken.groups() if part)
    if re.fullmatch(_MINUTES, text):
        minutes, seconds = text.replace(",", ".").split(":")
        return 60.0 * int(minutes) + float(seconds), False
    day, rest = re.match(rf"({_DAY})?[T ]*(.*)", text).groups()  # type: ignore
    found = re.match(
        r"([0-9]{1,2}):([0-9]{2})(?::([0-9]{2})(?:[.,:]([0-9]{1,9}))?)?\s*([aApP][mM])?", rest or "0:00"
    )
    if found is None:
        return None
    hours, minutes, seconds, fraction, half = found.groups()
    value = 3600.0 * int(hours) + 60.0 * int(minutes) + int(seconds or 0)
    if half:
        value += 43_200.0 * ((half.lower() == "pm") - (int(hours) == 12))
    value += int(fraction) / 10 ** len(fraction) if fraction else 0.0
    if day is None:
        return value, False
    parts = [int(part) for part in re.split(r"[-/.]", day)]
    if len(day.split("-")[0].split("/")[0].split(".")[0]) != 4:
        parts = [parts[2] + (2000 if parts[2] < 100 else 0), parts[1], parts[0]]
        if parts[1] > 12:
            parts[1], parts[2] = parts[2], parts[1]
    try:
        return datetime(parts[0], parts[1], parts[2], tzinfo=UTC).timestamp() + value, True
    except ValueError:
        return None
