"""The shapes of tables: blocks side by side, wide tables, maps, tall tables and transposed ones, all as
columns.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.reading.heads import counts_runs, head_claims, head_score, taken_apart, without_run
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.model import Cell, Column, Gap, Sheet, Span
from mckibben.measurement.reading.numbers import (
    CLOCK,
    MARK,
    NUMBER,
    TEXT,
    NumberStyle,
    absolute_seconds,
    kind_of,
    numbers_of,
    seconds_of,
    with_units,
)
from mckibben.measurement.reading.runs import Run, is_axis
from mckibben.measurement.reading.units import quantities, unit_of

_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_MOST_GAPS = 1_000_000
_TRUTH = 0.3  # share of the cells that are numbers, from which a column is one of numbers
_CLOCKS = 0.7  # share of the cells that are times, from which a column is one of times
_FEWEST_ACROSS = 4  # numbers in a row of a transposed table
_FEWEST_DOWN = 2  # such rows
_MOST_NAMES = 12  # signals of a tall table
TRAILING = re.compile(r"\s{0,3}[\\/|]\s{0,3}")


class Part(NamedTuple):
    """A block of a table: its columns, what stands over it, the number of each row, what was done, and what a
    column says in all rows.
    """

    columns: tuple[Column, ...]
    title: tuple[Span, ...]
    lines: NDArray[np.int64]
    bad: Mapping[int, str] = MappingProxyType({})
    messages: tuple[str, ...] = ()
    same: tuple[Span, ...] = ()


def column_of(
    cells: Sequence[Cell] | NDArray[Any], *, head: str, sheet: Sheet, where: str, unit: str = "",
    above: tuple[str, ...] = (),
    described: tuple[Span, ...] = (), place: int = -1,
) -> Column | None:  # fmt: skip
    """A column of numbers, of times or of words; None = all of its cells are empty."""
    if isinstance(cells, np.ndarray) and cells.dtype.kind in "biuf":
        numbers = cells.astype(float).ravel()
        holes = {
            int(r): Gap("not a finite number", "nan")
            for r in np.flatnonzero(~np.isfinite(numbers))[:_MOST_GAPS]
        }
        numbers[~np.isfinite(numbers)] = np.nan
        holes |= without_marks(numbers)
        return (
            Column(head, numbers, where, unit, above, described, None, holes, False, place)
            if np.isfinite(numbers).any()
            else None
        )
    style = NumberStyle(sheet.decimal, sheet.thousands)
    cells = [
        float(c) if isinstance(c, (int, np.floating, np.integer)) and not isinstance(c, bool) else c
        for c in cells
    ]
    cells = [cell.strip() if isinstance(cell, str) else cell for cell in cells]
    filled = [cell for cell in cells if cell not in ("", None)]
    if not filled:
        return None
    values, gaps = numbers_of(cells, style)
    gaps |= without_marks(values)
    made = Column(head, values, where, unit, above, described, None, gaps, False, place)
    if np.isfinite(values).sum() < _TRUTH * len(filled):
        sample = filled[:400]
        if sum(absolute_seconds(c) is not None for c in sample) > _CLOCKS * len(sample):
            seconds = seconds_of(cells)
            return replace(
                made,
                values=seconds,
                gaps={r: g for r, g in gaps.items() if not np.isfinite(seconds[r])},
                clock=True,
            )
        bare, own = with_units([str(c) if not isinstance(c, float) else c for c in filled])
        if own and sum(
            isinstance(c, str) and _NUMBER.match(c.lstrip("+-")) is not None for c in bare
        ) > _CLOCKS * len(bare):
            stripped, _ = with_units([c if isinstance(c, (str, float)) else "" for c in cells])
            values, gaps = numbers_of(stripped, style)
            return replace(made, values=values, gaps=gaps, unit=own)
        words = tuple(
            "" if c is None else c if isinstance(c, str) else f"{c:g}" if isinstance(c, float) else str(c)
            for c in cells
        )
        return replace(made, values=values, words=words, gaps={})
    return made


_MARKS = (-9999.0, -999.0, 9999.0, -99999.0, 99999.0, -999.25, 1e30, -1e30,
          9.9e37, 9.91e37)  # fmt: skip  # of loggers and of instruments (SCPI) for a lost reading
_FAR = 0.5  # of a mark, below which all other readings are


def without_marks(values: NDArray[np.float64]) -> dict[int, Gap]:
    """Take numbers that stand for a lost reading out of a column: usual marks, and values of no physical
    size.
    """
    found: dict[int, Gap] = {}
    finite = np.isfinite(values)
    if not finite.any():
        return found
    for mark in _MARKS:
        here = values == mark
        others = finite & ~here
        if here.any() and others.any() and np.max(np.abs(values[others])) < _FAR * abs(mark):
            found |= {int(r): mark_gap(mark) for r in np.flatnonzero(here)}
    usual = float(np.median(np.abs(values[finite])))
    huge = finite & (np.abs(values) > max(1e9 * usual, 1e15)) & ~np.isin(values, _MARKS)
    if usual > 0.0:
        found |= {int(r): Gap("out of range", f"{values[r]:g}") for r in np.flatnonzero(huge)}
    values[list(found)] = np.nan
    return found


def mark_gap(mark: float) -> Gap:
    """What stands where a number stands that means none."""
    return Gap(f"{mark:g} means no reading", f"{mark:g}")


def parts_of(run: Run, title: list[Span]) -> list[Part]:
    """The blocks of a run: itself, or those that stand side by side in it."""
    sheet = run.sheet
    if not run.heads and _is_map(run):
        return [_melted(run, title)]
    lines = np.array([sheet.line(r) for r in run.rows], np.int64)
    columns = _columns(run)
    if sheet.bulk is not None:
        return [_with_bulk(run, columns, title, lines)]
    for way in (_two_ways, _side_by_side, _wide):
        if parts := way(run, columns, title, lines):
            return parts
    same = tuple(
        Span(c.where, f"{c.head}: {c.words[0]}")
        for c in columns.values()
        if c.words and len(set(c.words)) == 1 and len(c.words) > 1 and quantities(c.words[0])
    )
    wide = _tall(list(columns.values()), lines)
    if wide is not None:
        said = ("the table has one value per line: each signal is read as a column",)
        return [Part(tuple(wide[0]), tuple(title), wide[1], messages=said, same=same)]
    whole, messages = _joined_times(list(columns.values()))
    made = [_carried(c) for c in whole]
    messages += [
        f"column '{c.head}' has a value in the first row of each block only: it counts for the rows below"
        for c, old in zip(made, whole, strict=True)
        if c is not old
    ]
    beside = [
        Span(c.where, c.words[0]) for c in made if c.words and c.words[0].strip() and not any(c.words[1:])
    ]
    return [Part(tuple(made), (*title, *beside), lines, _ragged(run), tuple(messages), same)]


class NeedsCellsError(Exception):
    """The middle of a long table has to be read cell by cell."""


def _with_bulk(run: Run, columns: dict[int, Column], title: list[Span], lines: NDArray[np.int64]) -> Part:
    """A long table with the numbers of its middle.

    Raises:
        NeedsCellsError: it is no plain table, or its middle does not belong to this run.
    """
    at, bulk = run.sheet.bulk or (0, np.zeros((0, 0)))
    inside = at in run.rows and at - 1 in run.rows
    plain = not (
        _two_ways(run, columns, title, lines)
        or _side_by_side(run, columns, title, lines)
        or _wide(run, columns, title, lines)
    )
    if (
        not inside
        or not plain
        or any(c.words is not None or c.clock for c in columns.values())
        or max(columns) >= bulk.shape[1]
    ):
        raise NeedsCellsError
    k = run.rows.index(at)
    count = len(bulk)
    made = []
    for c, column in columns.items():
        middle = np.where(np.isfinite(bulk[:, c]), bulk[:, c], np.nan)
        values = np.concatenate([column.values[:k], middle, column.values[k:]])
        gaps = {r if r < k else r + count: gap for r, gap in column.gaps.items()}
        gaps |= {
            k + int(r): Gap("not a finite number", "nan") for r in np.flatnonzero(~np.isfinite(bulk[:, c]))
        }
        gaps |= without_marks(values)
        made.append(replace(column, values=values, gaps=gaps))
    first = int(lines[k - 1])
    numbers = np.concatenate([lines[:k], np.arange(first + 1, first + 1 + count), lines[k:]])
    return Part(tuple(made), tuple(title), numbers)


_CARRIED = 0.15  # share of the rows that hold a value, up to which it counts for the rows below as well


def _carried(column: Column) -> Column:
    """A column with a value where a block begins and empty cells below: it counts for these as well."""
    finite = np.isfinite(column.values)
    empty = {r for r, gap in column.gaps.items() if gap.reason == "empty"}
    count = int(finite.sum())
    if (
        column.words is not None
        or not finite[:1].any()
        or not 0 < count <= _CARRIED * len(finite)
        or len(empty) + count < len(finite)
    ):
        return column
    if count > 1 and np.min(np.diff(np.flatnonzero(finite))) < 3:
        return column
    last = np.maximum.accumulate(np.where(finite, np.arange(len(finite)), 0))
    return replace(column, values=column.values[last], gaps={})


def _joined_times(columns: list[Column]) -> tuple[list[Column], list[str]]:
    """A clock with the milliseconds in the column beside it as one column, and what is said of it."""
    for k, (clock, beside) in enumerate(pairwise(columns)):
        said = [f"the time is the sum of '{clock.head}' and '{beside.head}'"]
        unit = taken_apart(beside.head, beside.unit).unit
        is_ms = (
            any(text.strip().lower() == "ms" for text in beside.above)
            or (unit is not None and unit.name == "ms")
            or beside.head.strip().lower() in ("ms", "msec", "millis")
        )
        finite = beside.values[np.isfinite(beside.values)]
        fine = unit is not None and {"ns": 1e9, "us": 1e6, "µs": 1e6, "ms": 1e3}.get(unit.name, 0.0)
        own = taken_apart(clock.head, clock.unit).unit
        if (
            fine
            and own is not None
            and own.name == "s"
            and clock.words is None
            and len(finite)
            and finite.min() >= 0.0
            and finite.max() < fine
            and np.nanmin(clock.values) > 1e8
        ):
            values = (clock.values - clock.values[0]) + np.nan_to_num(beside.values) / fine
            return [*columns[:k], replace(clock, values=values - values[0]), *columns[k + 2 :]], said
        if (
            clock.clock
            and is_ms
            and np.any(np.diff(clock.values) == 0.0)
            and beside.words is None
            and len(finite)
            and finite.min() >= 0.0
            and finite.max() < 1000.0
        ):
            values = clock.values + np.nan_to_num(beside.values) / 1000.0
            return [*columns[:k], replace(clock, values=values - values[0]), *columns[k + 2 :]], said
    return columns, []


def _ragged(run: Run) -> dict[int, str]:
    """Rows of a text that have more or fewer cells than its head."""
    if run.head_row is None or run.sheet.noun != "line" or run.sheet.format != "csv":
        return {}
    rows = run.sheet.rows
    width = len(rows[run.head_row])
    usual = max({len(rows[r]) for r in run.rows}, key=lambda n: sum(len(rows[r]) == n for r in run.rows))
    if width < 2 or usual != width:
        return {}
    return {
        k: f"{len(rows[r])} cells, the header has {width}"
        for k, r in enumerate(run.rows)
        if len(rows[r]) > width and any(c != "" for c in rows[r][width:])
    }


def _too_short(cells: int, width: int) -> str:
    return f"{cells} {'cell' if cells == 1 else 'cells'}, the header has {width}"


def _columns(run: Run) -> dict[int, Column]:
    sheet, rows = run.sheet, run.sheet.rows
    width = min(1000, max([len(rows[r]) for r in run.rows[:200]] + [c + 1 for c in run.heads]))
    found: dict[int, Column] = {}
    for c in range(width):
        cells = [rows[r][c] if c < len(rows[r]) else "" for r in run.rows]
        column = column_of(
            cells,
            head=run.heads.get(c, ""),
            unit=run.units.get(c, ""),
            above=run.more.get(c, ()),
            described=run.described.get(c, ()),
            sheet=sheet,
            where=f"column {c + 1}"
            if run.head_row is None
            else f"{sheet.place(run.head_row)}, column {c + 1}",
            place=c,
        )
        if column is not None:
            short = (
                {k: len(rows[r]) for k, r in enumerate(run.rows) if len(rows[r]) <= c}
                if sheet.format == "csv" and sheet.noun == "line"
                else {}
            )
            if short and len(short) < 0.5 * len(run.rows):
                column = replace(
                    column,
                    gaps={
                        **column.gaps,
                        **{k: Gap("short", _too_short(n, width)) for k, n in short.items()},
                    },
                )
            found[c] = column
    return found


def _pattern(head: str) -> str:
    """A head without numbers and without the number of a run."""
    return _NUMBER.sub("#", without_run(head)[0])


def _two_ways(
    run: Run, columns: dict[int, Column], title: list[Span], lines: NDArray[np.int64]
) -> list[Part]:
    """Columns of one quantity for the way there and the way back: the rows once for each, with the way as a
    column.
    """
    ways = {c: _way(column.head) for c, column in columns.items()}
    pairs: dict[str, dict[str, int]] = {}
    for c, way in ways.items():
        if way is not None:
            pairs.setdefault(_without_way(columns[c].head), {})[way] = c
    whole = {name: pair for name, pair in pairs.items() if len(pair) == 2}
    names = list(dict.fromkeys(way for pair in whole.values() for way in pair))
    if not whole or len(names) != 2 or any(set(pair) != set(names) for pair in whole.values()):
        return []
    chosen = {c for pair in whole.values() for c in pair.values()}
    if any(_is_time(column) for c, column in columns.items() if c not in chosen):
        return []  # one time for both: they are two sensors
    if any(way is not None and c not in chosen for c, way in ways.items()):
        return []
    made = []
    for way in names:
        block = {c: column for c, column in columns.items() if c not in chosen}
        block |= {pair[way]: replace(columns[pair[way]], head=name) for name, pair in whole.items()}
        words = Column(
            "direction",
            np.full(len(lines), np.nan),
            columns[next(iter(chosen))].where,
            words=(way,) * len(lines),
        )
        made.append(({c: block[c] for c in sorted(block)}, words))
    back = _way_back(names, columns, whole)
    sides = []
    for way, (block, words) in zip(names, made, strict=True):
        inner = (
            _side_by_side(run, block, title, lines)
            or _wide(run, block, title, lines)
            or [Part(tuple(block.values()), tuple(title), lines)]
        )
        sides.append(
            [
                _turned(
                    part._replace(columns=(*part.columns, _cut(words, len(part.lines)))), back=way == back
                )
                for part in inner
            ]
        )
    return [part for pair in zip(*sides, strict=True) for part in pair]


def _is_time(column: Column) -> bool:
    claims = head_claims(column.head[:200], column.unit)
    return column.clock or any(c.facet == "channel" and c.value == "time" for c in claims)


def _way_back(
    names: Sequence[str], columns: Mapping[int, Column], pairs: Mapping[str, Mapping[str, int]]
) -> str:
    """The way that was gone from the last row up: the way back, but of loading and unloading the one on which
    the force would change the wrong way.
    """
    there = next((way for way in names if any(word_set(f"way_{w}").words >= {way} for w in _THERE)), names[0])
    other = names[1 - names.index(there)]
    if there not in word_set("loads").words:
        return other
    forces = [
        columns[pair[there]].values
        for name, pair in pairs.items()
        if any(c.facet == "channel" and c.value == "force" for c in head_claims(name))
    ]
    falls = any(v[0] > v[-1] for values in forces if len(v := values[np.isfinite(values)]) > 1)
    return there if falls else other


_THERE = ("shortening", "pressure_rises", "one_way")


def _turned(part: Part, *, back: bool) -> Part:
    """The rows of the way back from the last one up: the test went on from there."""
    if not back:
        return part
    order = np.arange(len(part.lines))[::-1]
    count = len(order)
    columns = tuple(
        replace(
            c,
            values=c.values[order],
            words=None if c.words is None else tuple(c.words[r] for r in order),
            gaps={count - 1 - r: gap for r, gap in c.gaps.items()},
        )
        for c in part.columns
    )
    return part._replace(columns=columns, lines=part.lines[order])


def _cut(words: Column, rows: int) -> Column:
    return replace(words, values=words.values[:rows], words=(words.words or ())[:rows])


def _way(head: str) -> str | None:
    """The one word of a head that says which way the test goes; None = none, or several."""
    found = [word for word in words_of(taken_apart(head).name) if word in word_set("ways").words]
    return found[0] if len(found) == 1 else None


def _without_way(head: str) -> str:
    way = _way(head)
    kept = [part for part in re.split(r"(\s+|_)", head) if words_of(part) != (way,)]
    return " ".join("".join(kept).split())


def _names_quantity(head: str) -> bool:
    """Whether a head names a quantity with its value, or a run with its number."""
    return bool(quantities(head.replace("_", " "))) or without_run(head)[1] != ""


def _side_by_side(
    run: Run, columns: dict[int, Column], title: list[Span], lines: NDArray[np.int64]
) -> list[Part]:
    """Blocks beside each other: each head comes again in the same order, alike or with another number."""
    keys = {c: (_pattern(column.head), column.unit) for c, column in columns.items() if column.head.strip()}
    groups: dict[tuple[str, str], list[int]] = {}
    for c, key in keys.items():
        groups.setdefault(key, []).append(c)
    repeats = {len(places) for places in groups.values()}
    if len(groups) < 2 or len(repeats) != 1 or (count := repeats.pop()) < 2:
        return []
    exact = all(len({columns[c].head for c in places}) == 1 for places in groups.values())
    if not exact and not all(_names_quantity(columns[c].head) for places in groups.values() for c in places):
        return []
    parts = []
    for k in range(count):
        chosen = sorted(places[k] for places in groups.values())
        upto = min((places[k + 1] for places in groups.values()), default=10**6) if k + 1 < count else 10**6
        over = [] if exact else [Span(columns[c].where, columns[c].head) for c in chosen]
        over += _texts_over(run, chosen[0], upto, {columns[c].head.strip() for c in chosen})
        block = [
            columns[c]
            if exact
            else replace(columns[c], head=_without_quantity(without_run(columns[c].head)[0]))
            for c in chosen
        ]
        keep = ~np.all(
            [np.isnan(c.values) for c in block if c.words is None] or [np.zeros(len(lines), bool)], axis=0
        )
        parts.append(Part(tuple(_kept(c, keep) for c in block), (*title, *over), lines[keep]))
    return parts


def _texts_over(run: Run, first: int, upto: int, heads: set[str]) -> list[Span]:
    """The texts above some columns that are no heads."""
    sheet = run.sheet
    begin = max(0, min(run.above or [run.rows[0]]) - 2)
    return [
        Span(sheet.place(i), str(sheet.rows[i][j]))
        for i in range(begin, run.rows[0])
        for j in range(first, min(upto, len(sheet.rows[i])))
        if sheet.rows[i][j] != "" and str(sheet.rows[i][j]).strip() not in heads and i != run.unit_row
    ]


def _kept(column: Column, keep: NDArray[np.bool_]) -> Column:
    """A column with some of its rows."""
    rows = np.flatnonzero(keep)
    place = {int(row): k for k, row in enumerate(rows)}
    words = None if column.words is None else tuple(column.words[row] for row in rows)
    gaps = {place[row]: gap for row, gap in column.gaps.items() if row in place}
    return replace(column, values=column.values[keep], words=words, gaps=gaps)


def _wide(run: Run, columns: dict[int, Column], title: list[Span], lines: NDArray[np.int64]) -> list[Part]:
    """A wide table: one quantity in several columns, whose heads differ in the value of another one."""
    groups: dict[str, list[int]] = {}
    columns = {c: _labelled(column, columns) for c, column in columns.items()}
    for c, column in columns.items():
        if (quantities(column.head.replace("_", " ")) and kind_of(column.head) != NUMBER) or _repeat(
            column.head
        ):
            groups.setdefault(_pattern(column.head), []).append(c)
    many = [places for places in groups.values() if len(places) > 1]
    if not many or len({len(places) for places in many}) != 1:
        return []
    shared = [
        column
        for c, column in columns.items()
        if not any(c in places for places in many) and not _is_statistic(column.head)
    ]
    if not shared:
        return []
    corner = ""  # a head over cells in another unit names the values: "Force [N]" over "300 mm"
    first = taken_apart(shared[0].head).unit
    if first is not None and shared[0].unit and unit_of(shared[0].unit) != first and len(shared) == 1:
        corner, shared = shared[0].head, [replace(shared[0], head="")]
    across = {
        q.unit.dimension for places in many for q in quantities(columns[places[0]].head.replace("_", " "))
    }
    subject = _subject(run, {*_channels([c.head for c in shared]), *across})
    parts = []
    for k in range(len(many[0])):
        chosen = [columns[places[k]] for places in many]
        block = [
            *shared,
            *(replace(c, head=_name_of_values(c.head, corner or subject)) for c in chosen),
        ]
        keep = ~np.all([np.isnan(c.values) for c in chosen], axis=0)
        over = [Span(c.where, c.head) for c in chosen]
        parts.append(Part(tuple(_kept(c, keep) for c in block), (*title, *over), lines[keep]))
    return parts


_NUMBERED = re.compile(r"(?P<number>\d{1,2})[.)]?\s(?P<word>[^\W\d_]{3,20})")


def _repeat(head: str) -> str:
    """The number of a run in a head, "Kraft Messung 2", "2. Messung"; "" = it has none."""
    found = _NUMBERED.fullmatch(head.strip())
    return found["number"] if found and counts_runs(found["word"]) else without_run(f"x {head}")[1]


def _is_statistic(head: str) -> bool:
    words = words_of(head[:60])
    return bool(words) and word_set("statistic").among(words[:1])


def _labelled(column: Column, columns: Mapping[int, Column]) -> Column:
    """A column whose head comes again, with the value that stands over it in its head."""
    again = sum(other.head == column.head for other in columns.values()) > 1
    over = next((text for text in column.above if quantities(text)), "") if again else ""
    return replace(column, head=f"{column.head} {over}") if over else column


def _name_of_values(head: str, subject: str) -> str:
    """What the values below a head are that names a quantity: "F @ 2 bar [N]" is "F [N]"; "Charge 50 N" names
    the load alone, and what stands elsewhere names the values.
    """
    rest = "" if _NUMBERED.fullmatch(head.strip()) else _without_quantity(without_run(f"x {head}")[0][2:])
    own = {q.unit.dimension for q in quantities(head.replace("_", " "))}
    return rest if rest and not (subject and _channels([rest]) and _channels([rest]) <= own) else subject


def _without_quantity(head: str) -> str:
    """A head without the quantity that it names: "F @ 2 bar [N]" is "F [N]"."""
    text = head.replace("_", " ")
    for quantity in reversed(quantities(text)):
        text = text[: quantity.begin] + text[quantity.end :]
    text = re.sub(r"(?:^|\s)[^\W\d_]{1,3}\s?=\s*(?=$|[\[(,;])", " ", text)
    text = re.sub(r"\s*(?:@|\bat\b|\bbei\b|[a-zA-Z]?\s?=)\s*(?=$|[\[(,;])", " ", text)
    text = re.sub(r"(?:^|\s)[^\W\d_]{1,3}\s?=\s*(?=$|[\[(,;])", " ", text)
    text = " ".join(text.split()).strip(" ,;@=")
    return "" if text in ("()", "[]") else text


def _subject(run: Run, axes: Collection[str], more: Sequence[str] = ()) -> str:
    """What the texts over a table say that its values are, and no axis is; the title first."""
    rows = run.sheet.rows
    strokes = {"length", "displacement", "contraction"}
    taken = {*axes, *(strokes if strokes & {*axes} else ())}
    found = _named_best([t.text for t in run.title[:1]], taken) or _named_best(
        [*(t.text for t in run.title), *more], taken
    )
    for r in range(run.rows[0] - 1, max(-1, run.rows[0] - _FAR_ABOVE), -1):
        found = found or _named_best([str(c) for c in rows[r] if c != "" and kind_of(c) == TEXT], taken)
    return found


def _channels(heads: Sequence[str]) -> set[str]:
    """The channels that some heads name."""
    return {c.value for head in heads for c in head_claims(head[:200]) if c.facet == "channel"}


def _is_map(run: Run) -> bool:
    """Whether the first row of a run is the upper axis of a map."""
    return is_axis(run.sheet, run.rows[0])


def _melted(run: Run, title: list[Span]) -> Part:
    """A map as columns: the axis down, the axis across, and the values; corner and titles name them."""
    sheet, rows = run.sheet, run.sheet.rows
    style = NumberStyle(sheet.decimal, sheet.thousands)
    top = rows[run.rows[0]]
    upper, _ = numbers_of(list(top[1:]), style)
    body = [rows[r] for r in run.rows[1:]]
    down, _ = numbers_of([row[0] for row in body], style)
    values = np.array(
        [numbers_of([*row[1 : len(top)], *[""] * (len(top) - len(row))], style)[0] for row in body]
    )
    where = sheet.place(run.rows[0])
    over = [str(c) for r in run.remarks for c in rows[r] if c != ""]
    down_name, across_name = _axes(run)
    if not down_name and _counts(down):
        down_name = "cycle"
    subject = _subject(run, _channels([down_name, across_name]), over)
    lines = np.array([sheet.line(r) for r in run.rows[1:]], np.int64)
    columns = (
        np.repeat(down, len(upper)),
        np.tile(upper, len(down)),
        values.ravel(),
        np.repeat(lines, len(upper)),
    )
    first, second, third, numbers = columns
    empty = np.isnan(third)
    made = (
        Column(down_name, first[~empty], where),
        Column(across_name, second[~empty], where),
        Column(subject, third[~empty], where),
    )
    said = f"a map of {len(down)} x {len(upper)} cells: each cell is read as a row"
    if empty.any():
        said += f"; {int(empty.sum())} empty cells hold no reading"
    return Part(made, tuple(title), numbers[~empty], messages=(said,))


def _axes(run: Run) -> tuple[str, str]:
    """What the corner of a map and the row above it call its axes, down and across.

    A name over the values is that of the axis across; the corner, with what stands above it, then names the
    one down: "Contrazione (%)" below "Pressione (bar)", or "(%)" below "contraction". A corner alone names
    both, "length / pressure", or the axis across.
    """
    rows = run.sheet.rows
    corner = str(rows[run.rows[0]][0])
    parts = [part.strip() for part in TRAILING.split(corner) if part.strip()]
    if len(parts) > 1:
        return parts[0], parts[-1]
    above = next((row for row in reversed(rows[: run.rows[0]][-2:]) if any(c != "" for c in row)), [])
    across = next((str(c) for c in above[1:] if kind_of(c) == TEXT and _names_axis(str(c))), "")
    if not across:
        return "", corner.strip()
    named = [part.strip() for part in _OVER_WHICH.split(across) if _channels([part])]
    across = named[-1] if len(named) > 1 else across  # "force [N] at a contraction of [%]"
    first = "" if _channels([corner]) else str(above[0])
    return f"{first} {corner}".strip(), across


_OVER_WHICH = re.compile(r"\b(?:at|bei|à|a|al|alla|over|über|sur|su|vs\.?|versus|bij|vid|ved|przy|při)\b")


def _names_axis(text: str) -> bool:
    return bool(_channels([text])) or taken_apart(text[:200]).unit is not None


_FAR_ABOVE = 12  # rows above a map in which its values may be named


def _named_best(texts: Sequence[str], axes: Collection[str] = ()) -> str:
    """The part of some texts that names a channel best, one that no axis is; "" = none does."""
    cut = rf"\s\((?=[^()]{{9}})|\b(?:of|von|for|für)\b|[:;]|\s[–—-]\s|,\s|{_OVER_WHICH.pattern}"
    parts = [part.strip() for text in texts for part in re.split(cut, text)]
    parts = [part for part in parts if not _is_statistic(part)]
    named = [p for p in parts if {c.value for c in head_claims(p[:200]) if c.facet == "channel"} - {*axes}]
    return max(named, key=head_score, default="")


def _counts(values: NDArray[np.float64]) -> bool:
    return len(values) > 1 and bool(np.all(np.diff(values) == 1.0)) and values[0] in (0.0, 1.0)


def _tall(columns: list[Column], lines: NDArray[np.int64]) -> tuple[list[Column], NDArray[np.int64]] | None:
    """A table with one value per line, a column of names and one of values, made wide; None = it is none."""
    numbers = [c for c in columns if c.words is None and np.isfinite(c.values).sum() > 1]
    named = [c for c in columns if c.words is not None and (_are_signals(c.words) or _are_tags(c, numbers))]
    if len(named) != 1 or not numbers:
        return None
    names = named[0]
    value = _value_column(numbers)
    if value is None:
        return None
    words = np.array([word.strip() for word in names.words or ()])
    signals = [word for word in dict.fromkeys(words.tolist()) if word]
    units = next((c for c in columns if c.words is not None and c is not names and _are_units(c.words)), None)
    keys = [
        c
        for c in numbers
        if c is not value
        and len(np.unique(c.values)) < len(c.values)
        and any(np.ptp(c.values[words == signal]) > 0.0 for signal in signals)  # no number of the signal
    ]
    counts = [int(np.sum(words == s)) for s in signals]
    if keys:
        labels = np.column_stack([np.nan_to_num(c.values, nan=-1e300) for c in keys])
        rows, first = np.unique(labels, axis=0, return_index=True)
        order = np.argsort(first)
        rows, first = rows[order], first[order]
        index = {tuple(row): k for k, row in enumerate(rows.tolist())}
        at = np.array([index[tuple(row)] for row in labels.tolist()])
        if len(rows) * len(signals) > 2 * len(words):
            return None
    elif len(set(counts)) == 1:
        at = (
            np.concatenate([[np.sum(words[:i] == words[i])] for i in range(len(words))])
            if len(words) < 5000
            else None
        )
        if at is None:
            return None
        first = np.array([int(np.flatnonzero(at == k)[0]) for k in range(counts[0])])
    else:
        return None
    result = [replace(c, values=c.values[first], gaps={}) for c in keys]
    lost = {**value.gaps, **_marked_bad([c for c in columns if c.words is not None and c is not names])}
    for signal in signals:
        column = np.full(len(first), np.nan)
        here = words == signal
        column[at[here]] = value.values[here]
        gaps = {int(at[r]): gap for r, gap in lost.items() if here[r]}
        gaps |= {int(r): Gap("no reading", "") for r in np.flatnonzero(np.isnan(column)) if r not in gaps}
        column[list(gaps)] = np.nan
        unit = "" if units is None or units.words is None else units.words[int(np.argmax(here))]
        result.append(
            replace(value, head=signal, unit=unit or value.unit, values=column, gaps=gaps, above=())
        )
    return result, lines[first]


def _marked_bad(columns: Sequence[Column]) -> dict[int, Gap]:
    """Rows whose state says that their reading is none: "Bad" beside it."""
    bad = word_set("bad_reading")
    return {
        row: Gap("no reading", word.strip()[:40])
        for column in columns
        if word_set("states").among(words_of(column.head))
        for row, word in enumerate(column.words or ())
        if bad.among(words_of(word))
    }


#: Words for the way of a row.
_WAYS = "way_shortening|way_lengthening|way_pressure_rises|way_pressure_falls|way_one_way|way_other_way"


def _are_signals(words: Sequence[str]) -> bool:
    """Whether words are the names of signals: few, each again and again, and two of them name channels."""
    names = {word.strip() for word in words if word.strip()}
    if not 2 <= len(names) <= _MOST_NAMES or len(words) < 2 * len(names):
        return False
    if all(word_set(_WAYS).among(words_of(name)) for name in names):
        return False  # they say which way each row goes
    claims = [
        c
        for name in names
        for c in head_claims(name[:200])
        if c.facet == "channel" and (c.rule != "letter" or len(name) > 1)
    ]
    return len({claim.value for claim in claims} - {"group", "direction"}) >= 2


_TAGS = frozenset([
    "tag", "signal", "channel", "kanal", "sensor", "name", "variable", "quantity", "grosse", "item",
    "point", "parameter",
])  # fmt: skip


def _are_tags(names: Column, numbers: Sequence[Column]) -> bool:
    """Whether a column called so holds a few names, and another one is called "value"."""
    words = {word.strip() for word in names.words or () if word.strip()}
    values = any(word_set("values").among(words_of(c.head)) for c in numbers)
    return (
        values
        and bool(_TAGS & set(words_of(names.head)))
        and 2 <= len(words) <= _MOST_NAMES
        and len(names.words or ()) >= 2 * len(words)
    )


def _are_units(words: Sequence[str]) -> bool:
    names = {word.strip() for word in words if word.strip()}
    return bool(names) and len(names) <= _MOST_NAMES and all(unit_of(name) is not None for name in names)


def _value_column(numbers: Sequence[Column]) -> Column | None:
    """The column of the values: it is called so, or it is the only one that names no channel."""
    called = [c for c in numbers if word_set("values").among(words_of(c.head))]
    if len(called) == 1:
        return called[0]
    free = [c for c in numbers if not any(claim.facet == "channel" for claim in head_claims(c.head, c.unit))]
    return free[-1] if free else (numbers[-1] if len(numbers) > 1 else None)


def transposed(sheet: Sheet) -> Sheet:
    """A sheet whose heads stand in its first column, with the readings beside them, turned; others as they
    are.
    """
    found: list[int] = []
    best: list[int] = []
    for i, row in enumerate([*sheet.rows[:400], []]):
        if _is_row_of_readings(row):
            found.append(i)
            continue
        if any(cell != "" for cell in row) or not row:
            best, found = (found if len(found) > len(best) else best), []
    if len(best) < _FEWEST_DOWN or len(best) > 40:
        return sheet
    rows = [sheet.rows[i] for i in best]
    across = max(len(row) for row in rows)
    channels = {c.value for row in rows for c in head_claims(str(row[0])[:200]) if c.facet == "channel"} - {
        "group",
        "direction",
    }
    if (
        len(channels) < 2
        or across - 1 < _FEWEST_ACROSS
        or (across - 1 <= len(rows) and len(channels) < len(rows))
    ):
        return sheet
    units = 1 if all(len(row) > 1 and kind_of(row[1]) == TEXT for row in rows) else 0
    heads: list[Cell] = [str(row[0]) + (f" [{row[1]}]" if units else "") for row in rows]
    body: list[list[Cell]] = [
        [row[j] if j < len(row) else "" for row in rows] for j in range(1 + units, across)
    ]
    before = [row for i, row in enumerate(sheet.rows) if i not in best and i < best[0]]
    after = [row for i, row in enumerate(sheet.rows) if i not in best and i > best[-1]]
    numbers = [sheet.line(i) for i in range(best[0])] + [sheet.line(best[0])] * (len(body) + 1)
    numbers += [sheet.line(i) for i in range(best[-1] + 1, len(sheet.rows))]
    message = "the heads stand in the first column: the table is read turned"
    return replace(
        sheet, rows=[*before, heads, *body, *after], lines=tuple(numbers), messages=(*sheet.messages, message)
    )


def _is_row_of_readings(row: Sequence[Cell]) -> bool:
    """Whether a row begins with the name of a channel and goes on with numbers, a unit between them
    perhaps.
    """
    if len(row) < 1 + _FEWEST_ACROSS or kind_of(row[0]) != TEXT:
        return False
    kinds = [kind_of(cell) for cell in row[1:]]
    numbers = sum(kind in (NUMBER, CLOCK) for kind in kinds)
    texts = sum(kind == TEXT for kind in kinds)
    return (
        numbers >= _FEWEST_ACROSS
        and texts <= 1
        and numbers + kinds.count(MARK) >= 0.7 * len(kinds)
        and head_score(str(row[0])[:200]) >= 2.0
    )
