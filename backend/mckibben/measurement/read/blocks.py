"""Tables that lie side by side, one below the other, or as a map, as parts of one table of columns."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.grid import Grid
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.held import HeldQuantity, held_quantities
from mckibben.measurement.read.locate import Run, TableHead, texts_of
from mckibben.measurement.read.map_axes import axes_of_map, value_of_map
from mckibben.measurement.read.plain_head import plainly_known
from mckibben.measurement.read.qualified import qualified_groups, way_of, without_way
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.values import GAP, NUMBER, TEXT, kind_of
from mckibben.measurement.read.vocabulary import folded

UNNAMED = "values at each pressure"  # a column of which only the pressure is said


@dataclass(frozen=True)
class Held:
    """A quantity held throughout a part, and where the file says so."""

    quantity: HeldQuantity
    where: str


@dataclass
class Part:
    """Rows of a table: its columns of the grid in the order of the heads.

    Attributes:
        grid: the rows.
        pieces: first and last (exclusive) rows; between them stand odd rows.
        columns: column of the grid of each head.
        own: those that are this part's alone; a row in which they are empty is not of this part.
        held: channel -> pressure, stroke or load of the part, where a title or head says it.
        clocks: columns of the grid with times of day or dates.
        carried: those whose value stands in the first row of a block only, as merged cells have it.
        way: what the head says of the way of the muscle or the test, where another part holds the other way.
    """

    grid: Grid
    pieces: list[tuple[int, int]]
    columns: tuple[int, ...]
    own: tuple[int, ...]
    held: dict[str, Held] = field(default_factory=dict)
    clocks: frozenset[int] = frozenset()
    carried: frozenset[int] = frozenset()
    way: str = ""

    def rows(self) -> Iterator[tuple[int, list[Cell]]]:
        """Row of the file and cells, in the order of the heads."""
        kept: dict[int, Cell] = {}
        for first, last in self.pieces:
            for index in range(first, last):
                cells = self.grid.cells(index)
                count = len(cells)
                if self.carried:
                    cells = [*cells, *[None] * (max(self.columns) + 1 - count)]
                    count = len(cells)
                    for column in self.carried:
                        if kind_of(cells[column]) != GAP:
                            kept[column] = cells[column]
                        cells[column] = kept.get(column)
                if all(
                    column >= count or (kind_of(cells[column]) == GAP and not _bad(cells[column]))
                    for column in self.own
                ):
                    continue
                yield self.grid.line(index), [cells[c] if c < count else None for c in self.columns]


class MapPart(Part):
    """A map: one quantity down, one across, the third in the cells."""

    def rows(self) -> Iterator[tuple[int, list[Cell]]]:
        """A row for each cell of the map."""
        for first, last in self.pieces:
            across = self.grid.cells(first)
            axis = self.columns[0]
            for index in range(first + 1, last):
                cells = self.grid.cells(index)
                for column in range(axis + 1, min(len(across), len(cells))):
                    if kind_of(across[column]) == NUMBER and kind_of(cells[column]) != GAP:
                        yield self.grid.line(index), [cells[axis], across[column], cells[column]]


@dataclass
class Table:
    """Columns of a file before they have a meaning, from one part or several.

    Attributes:
        place: file (and sheet), for messages.
        title: of the sheet, group or struct.
        names: heads of the columns as in the file.
        units: units that stand apart from the heads.
        unit_where: where they stand, for people.
        head_row, units_row: 1-based rows of the names and of the units; None where there is none.
        parts: where the values are.
        unread: columns, with the reason, that are left out of the parts.
        rest: texts that belong to no table, and where they stand.
    """

    place: str
    title: str
    names: list[str]
    units: list[str | None]
    unit_where: str
    head_row: int | None
    parts: list[Part]
    units_row: int | None = None
    unread: list[tuple[str, str]] = field(default_factory=list)
    rest: list[tuple[str, str]] = field(default_factory=list)
    messages: list[str] = field(default_factory=list)

    @property
    def signature(self) -> tuple[str, ...]:
        """The heads and units without case, to compare tables."""
        return tuple(folded(f"{n} {u or ''}").strip() for n, u in zip(self.names, self.units, strict=True))


def _bad(cell: Cell) -> bool:
    """A gap that is written down ("NaN") is a reading that failed, not the end of a shorter column."""
    return (isinstance(cell, str) and cell.strip() != "") or (isinstance(cell, float) and cell != cell)


def tables_of_run(grid: Grid, run: Run, head: TableHead, titles: Sequence[tuple[int, int, str]]) -> Table:
    """The table of one run of rows; ``titles`` are (row, column, text) of what stands above it."""
    if (found := _map(grid, run, head, titles)) is not None:
        return found
    pieces = run.pieces or [(run.first, run.last)]
    where = "" if head.units_at is None else grid.where(head.units_at)
    names, units = head.names, head.units
    used = [c for c in range(len(names)) if names[c] or units[c] or c in run.numbers]
    carried = _carried(grid, pieces, used)
    shared, groups, bases = _groups(names, used, run)
    table = Table(
        place=grid.place, title=grid.title, names=[], units=[], unit_where=where,
        head_row=None if head.row is None else grid.line(head.row), parts=[],
        units_row=None if head.units_at is None else grid.line(head.units_at),
    )  # fmt: skip
    first = groups[0]
    order = [*shared, *first]
    table.names = [bases.get(c, names[c]) for c in order]
    if bases and not any(bases.values()) and len(first) == 1:  # heads of nothing but values
        known = [recognise(names[c]).channel for c in shared]
        held = [quantity.channel for quantity in _held_in(names[first[0]])]
        value = value_of_map([*(text for _, _, text in titles), grid.title], [*held, *known])
        table.names[-1] = value or UNNAMED
    table.names = _told_apart(table.names)
    table.units = [units[c] for c in order]
    for c in sorted(carried):
        said = f"column '{names[c] or f'column {c + 1}'}' is filled in the first row of each block only: it "
        table.messages.append(f"{said}counts for the rows below too, down to the next one")
    spans = [
        (min(group), min(groups[i + 1]) if i + 1 < len(groups) else 10**6) for i, group in enumerate(groups)
    ]
    for group, span in zip(groups, spans, strict=True):
        own = tuple(c for c in group if c in run.numbers and c not in carried) or tuple(group)
        held = _held_of_group(grid, names, group, titles, span if len(groups) > 1 else None, head)
        inside = carried & {*shared, *group}
        way = _way_of(names, group)
        table.parts.append(Part(grid, pieces, (*shared, *group), own, held, run.clocks, inside, way))
    return table


def _way_of(names: Sequence[str], group: Sequence[int]) -> str:
    """The way that all heads of a part say; empty where they say none."""
    ways = {way_of(names[c]) for c in group}
    return ways.pop() if len(ways) == 1 else ""


def _carried(grid: Grid, pieces: Sequence[tuple[int, int]], used: Sequence[int]) -> frozenset[int]:
    """Columns filled in the first row of each block only: one cell and a gap, some dozens of times."""
    indices = list(islice((i for first, last in pieces for i in range(first, last)), _CARRIED_WITHIN))
    if len(indices) < 2 * _SHORTEST_BLOCK:
        return frozenset()
    rows = [grid.cells(index) for index in indices]
    found = set()
    for column in used:
        filled = [n for n, row in enumerate(rows) if column < len(row) and kind_of(row[column]) != GAP]
        if filled[:1] != [0] or len(filled) > _MOST_BLOCKS:
            continue
        gaps = [b - a for a, b in zip(filled, [*filled[1:], len(rows)], strict=True)]
        if min(gaps) < _SHORTEST_BLOCK or _is_slow_signal(gaps):
            continue
        marked = any(kind_of(c) == GAP and _bad(c) for c in (r[column] for r in rows if column < len(r)))
        if (
            not marked
            and len(rows) >= 2 * _SHORTEST_BLOCK * min(len(filled), 2)
            and _others_filled(rows, column, used)
        ):
            found.add(column)
    return frozenset(found)


def _is_slow_signal(gaps: Sequence[int]) -> bool:
    """Whether a column is filled every so many rows all along: a signal that was sampled more slowly."""
    return len(gaps) > _MOST_EVEN_BLOCKS and len(set(gaps[:-1])) == 1


def _others_filled(rows: Sequence[Sequence[Cell]], column: int, used: Sequence[int]) -> bool:
    """Whether two other columns are filled nearly throughout."""
    full = 0
    for other in used:
        count = sum(other < len(row) and kind_of(row[other]) != GAP for row in rows)
        full += other != column and count > 0.9 * len(rows)
    return full >= 2


_CARRIED_WITHIN = 2000  # rows that show it
_MOST_BLOCKS = 60
_MOST_EVEN_BLOCKS = 16
_SHORTEST_BLOCK = 3  # rows


def _told_apart(names: Sequence[str]) -> list[str]:
    """Names that occur twice get a number: ``"Kraft [N]"``, ``"Kraft #2 [N]"``.

    Those of the plain kind do not: two columns ``force_N`` are refused.
    """
    plain = {names[index].casefold() for index in plainly_known(names)}
    seen: dict[str, int] = {}
    result = []
    for name in names:
        count = seen[name.casefold()] = seen.get(name.casefold(), 0) + 1
        if count > 1 and name and name.casefold() not in plain:
            base, bracket, unit = name.partition("[") if "[" in name else name.partition("(")
            name = f"{base.strip()} #{count} {bracket}{unit}".strip()
        result.append(name)
    return result


def _held_of_group(
    grid: Grid, names: Sequence[str], group: Sequence[int], titles: Sequence[tuple[int, int, str]],
    span: tuple[int, int] | None, head: TableHead,
) -> dict[str, Held]:  # fmt: skip
    found = {
        quantity.channel: Held(quantity, grid.where(row, column))
        for row, column, text in titles
        if span is None or span[0] <= column < span[1]
        for quantity in held_quantities(text)
    }
    inside: dict[str, dict[tuple[float, str], HeldQuantity]] = {}
    for quantity in (q for c in group for q in _held_in(names[c])):
        inside.setdefault(quantity.channel, {})[quantity.value, quantity.unit] = quantity
    for channel, values in inside.items():
        if len(values) == 1 and head.row is not None:
            found[channel] = Held(next(iter(values.values())), grid.where(head.row))
    return found


def _held_in(name: str) -> list[HeldQuantity]:
    """The quantities that a head names: a pressure, else a stroke or a load."""
    held = taken_apart(name).held if name else None
    return [held] if held is not None else held_quantities(name) if name else []


def _groups(
    names: Sequence[str], used: Sequence[int], run: Run
) -> tuple[list[int], list[list[int]], dict[int, str]]:
    """(columns of all parts, columns of each part in the same order, their names without the pressure)."""
    for channel in ("pressure", "length", "contraction", "displacement", "force"):
        if (found := _groups_by(channel, names, used)) is not None:
            return found
    return qualified_groups(names, used) or _repeated(names, used, run)


def _groups_by(
    channel: str, names: Sequence[str], used: Sequence[int]
) -> tuple[list[int], list[list[int]], dict[int, str]] | None:
    """The groups of the values of one quantity that heads name, "L = 280 mm"; None = there are none."""
    by_value: dict[tuple[float, str], list[int]] = {}
    shared: list[int] = []
    for c in used:
        held = next((q for q in _held_in(names[c]) if q.channel == channel), None)
        by_value.setdefault((held.value, held.unit), []).append(c) if held else shared.append(c)
    groups = list(by_value.values())
    if len(groups) < 2:
        return None
    bases = {c: _without_held(names[c], channel) for group in groups for c in group}
    ways = {c: without_way(base) for c, base in bases.items()}
    if all(len({folded(ways[c]) for c in group}) == 1 for group in groups) and ways != bases:
        groups, bases = [[c] for group in groups for c in group], ways
    keys = [[folded(bases[c]) for c in group] for group in groups]
    if not all(sorted(key) == sorted(keys[0]) and len(set(key)) == len(key) for key in keys):
        return None
    ordered = [[group[key.index(k)] for k in keys[0]] for group, key in zip(groups, keys, strict=True)]
    return [c for c in shared if names[c]], ordered, bases


def _repeated(
    names: Sequence[str], used: Sequence[int], run: Run
) -> tuple[list[int], list[list[int]], dict[int, str]]:
    """Columns in groups that begin wherever a name comes again."""
    named = [c for c in used if names[c]]
    keys = {
        c: re.sub(r"[._ ][0-9]{1,2}$", "", folded(names[c])) if "." in names[c][-3:] else folded(names[c])
        for c in named
    }
    groups: list[list[int]] = []
    for c in named:
        if not groups or keys[c] in {keys[o] for o in groups[-1]}:
            groups.append([])
        groups[-1].append(c)
    if len(groups) < 2:
        return [], [list(used)], {}
    wanted = sorted(keys[c] for c in groups[-1])
    shared = [c for c in groups[0] if keys[c] not in wanted]
    groups[0] = [c for c in groups[0] if keys[c] in wanted]
    if any(sorted(keys[c] for c in group) != wanted for group in groups) or len(wanted) < 2:
        return [], [list(used)], {}
    first = [keys[c] for c in groups[0]]
    ordered = [[next(c for c in group if keys[c] == key) for key in first] for group in groups]
    del run
    return shared, ordered, {}


def _without_held(name: str, channel: str) -> str:
    """``"F bei 2 bar [N]"`` -> ``"F [N]"``."""
    held = next((q for q in _held_in(name) if q.channel == channel), None)
    text = name if held is None else name.replace("_", " ").replace(held.text, " ")
    return " ".join(text.split())


def _map(grid: Grid, run: Run, head: TableHead, titles: Sequence[tuple[int, int, str]]) -> Table | None:
    """The map whose first row holds the values of one axis; None = it is none."""
    if run.pieces or run.last - run.first < 3:
        return None
    corner = grid.cells(run.first)
    kinds = [kind_of(cell) for cell in corner]
    axis = min(run.numbers)
    if axis >= len(kinds) or kinds[axis] not in (TEXT, GAP):
        return None
    across = [c for c in range(axis + 1, len(kinds)) if kinds[c] == NUMBER]
    if len(across) < 2 or any(kind == TEXT for kind in kinds[axis + 1 :]):
        return None
    above = [text for _, _, text in titles] + [name for name in head.names if name]
    names = axes_of_map(texts_of(corner)[axis], axis, head.names, titles)
    channels = [recognise(name).channel for name in names]
    if len(names) != 2 or None in channels or channels[0] == channels[1]:
        return None
    above.insert(0, texts_of(corner)[axis])
    value = value_of_map(above, channels)
    if value is None:
        return None
    place = grid.where(run.first, axis)
    table = Table(
        place=grid.place, title=grid.title, names=[*names, value], units=[None] * 3, unit_where="",
        head_row=grid.line(run.first), parts=[],
    )  # fmt: skip
    table.parts.append(MapPart(grid, [(run.first, run.last)], (axis, axis, axis), (axis,)))
    empty = _empty_cells(grid, run, across)
    table.messages.append(
        f"{place}: a map, read as {channels[0]} down, {channels[1]} across, '{value}' in the cells"
        + (f"; {empty} empty cells hold no reading" if empty else "")
    )
    return table


def _empty_cells(grid: Grid, run: Run, across: Sequence[int]) -> int:
    """Number of cells of a map in which nothing stands."""
    return sum(
        column >= len(cells) or kind_of(cells[column]) == GAP
        for cells in (grid.cells(index) for index in range(run.first + 1, run.last))
        for column in across
    )
