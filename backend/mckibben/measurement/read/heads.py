"""The head of a run of numbers: the rows of names and units above it, and what divides names."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from mckibben.measurement.read.channel_lists import listed_above
from mckibben.measurement.read.column_lists import listed_columns
from mckibben.measurement.read.grid import BLANKS, Grid, TextGrid
from mckibben.measurement.read.head_text import CHANNEL_NUMBER, taken_apart
from mckibben.measurement.read.held import held_quantities
from mckibben.measurement.read.locate import Run, TableHead, names_channel, texts_of
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.scales import scale_in
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.values import NUMBER, TEXT, kind_of
from mckibben.measurement.read.vocabulary import UNIT_WORDS, words_of

_HEAD_ROWS = 8  # most rows of a head
_UNITS_WITHIN = 40  # rows above a head in which its units may stand


def head_of(grid: Grid, run: Run, *, after: int = -1, at: int | None = None) -> TableHead:
    """The head of a run.

    Args:
        grid: the rows.
        run: the rows of numbers.
        after: row of the grid below which the head stands (the end of the run before).
        at: the row of the names, where the user says it.
    """
    if at is not None:
        rows = [index for index in range(at, run.first) if any(texts_of(grid.cells(index)))]
    else:
        rows = _rows_above(grid, run, after)
        if (listed := _listed(grid, run, rows)) is not None:
            return listed
    if not rows:
        return TableHead([""] * run.width, [None] * run.width, None, None, ())
    texts = {index: texts_of(grid.cells(index)) for index in rows}
    lists = {index: listed_above(grid, index) for index in rows}
    named = at if at is not None else _row_of_names(texts, rows, run, lists)
    said = lists[named]
    above = texts[named]
    full = any(sum(map(bool, texts[index])) >= run.width for index in rows if index > named)
    if not full and _without_row_names(grid, run, above):
        above = texts[named] = ["", *above]
    names = _padded(above, run.width)
    names = [f"{name} {said[name]}" if name in said else name for name in names]
    width = len(names)
    if isinstance(grid, TextGrid) and grid.separator == BLANKS:
        for index in rows:
            if index != named and (placed := _placed_units(grid.lines[named], grid.lines[index])):
                texts[index] = placed
    units_at = _row_of_units(texts, [index for index in rows if index != named], names)
    if units_at is None and not any(recognise(name).unit for name in names if name):
        below = [index for index in rows if index > named and _fitting(names, texts[index]) > 1]
        units_at = below[0] if below else None
    if units_at is None and not any(recognise(name).unit for name in names if name):
        units_at = _units_in_preamble(grid, named, names)
    if units_at is None and not any(recognise(name).unit for name in names if name):
        units_at = _labelled_units(grid, named, names)
    if units_at is not None and units_at > named and _divides(names, _padded(texts[units_at], width)):
        units_at = None  # units, and words that divide the names above
    units: list[str | None] = [None] * width
    in_cells = getattr(grid, "units", {})
    if units_at is not None:
        below = _padded(texts.get(units_at) or texts_of(grid.cells(units_at)), width)
        units = [cell if cell and unit_of(cell) is not None else None for cell in below]
    units = [unit or in_cells.get(column) for column, unit in enumerate(units)]
    for index in reversed(rows):
        if index in (named, units_at):
            continue
        if (more := _continued(grid, named, index, names)) is not None:
            names = more
            continue
        other = _padded(texts[index], width)
        if index > named and (values := _values_below(names, other)):
            names = [f"{name} {values[c]}" if c in values else name for c, name in enumerate(names)]
            continue
        if index > named and _divides(names, other):
            filled = _filled_on(names)
            names = [
                " ".join(filter(None, (f if name or o else "", o)))
                for name, f, o in zip(names, filled, other, strict=False)
            ]
            continue
        names = _completed(names, other)
    return TableHead(names, units, named, units_at, tuple(rows))


def _completed(names: Sequence[str], other: Sequence[str]) -> list[str]:
    """Names with what another row of the head says: "Label,Pressure" and "TIME,CH1" are TIME, CH1 Pressure.

    The first name may be that of the row; numbers of channels go before names that stand once.
    """
    channels = {recognise(name).channel for name in names if name}
    full = sum(map(bool, other)) >= sum(map(bool, names)) > 1
    # A row of its own, "Date,Time,ms", for the columns that a list of channels, "Tag,,,P1,F1", leaves out.
    beside = sum(map(bool, other)) > 1 and not any(
        name and cell for name, cell in list(zip(names, other, strict=False))[1:]
    )
    numbered = all(CHANNEL_NUMBER.fullmatch(cell) or names_channel(cell) for cell in other[1:] if cell)
    result = []
    for column, (name, cell) in enumerate(zip(names, other, strict=False)):
        label = column == 0 and not names_channel(name) and recognise(name).unit is None
        label = label and recognise(cell).channel == "time" and "time" not in channels
        label = label and ((full and numbered) or beside)
        if (not name or label) and (names_channel(cell) or (beside and unit_of(cell) is not None)):
            name = cell
        elif full and names_channel(name) and CHANNEL_NUMBER.fullmatch(cell) and list(names).count(name) == 1:
            name = f"{cell} {name}"
        result.append(name)
    return result


def _labelled_units(grid: Grid, named: int, names: Sequence[str]) -> int | None:
    """A row above the names that a word labels as units: "Vertical Units,V,V"; that of the times is none."""
    for index in range(named - 1, max(-1, named - 1 - _UNITS_WITHIN), -1):
        label, *cells = [*texts_of(grid.cells(index)), ""]
        units = [unit_of(cell) for cell in cells[: len(names) - 1]]
        if len(units) < len(names) - 1 or len(names) < 3 or not set(words_of(label)) & UNIT_WORDS:
            continue
        found = [dimension_of(unit.unit) for unit in units if unit is not None]
        if len(found) == len(names) - 1 and all(found) and set(found) != {"a time"}:
            return index
    return None


def _listed(grid: Grid, run: Run, rows: Sequence[int]) -> TableHead | None:
    """The head that a list of columns in the preamble gives, where no row above the numbers says as much."""
    found = listed_columns(grid, run.first, run.width)
    if found is None:
        return None
    listed = sum(recognise(name).channel is not None for name in found.names)
    for index in rows:
        named = [cell for cell in texts_of(grid.cells(index)) if names_channel(cell)]
        if index != found.row and len(named) >= listed and _fits(grid, index, run.width):
            return None
    if (own := _named_above(grid, run, found.row)) is not None:
        return TableHead(
            _explained(own, found.names), [None] * run.width, run.first - 1, None, (run.first - 1,)
        )
    return TableHead(found.names, [None] * run.width, found.row, None, ())


def _named_above(grid: Grid, run: Run, listed_at: int) -> list[str] | None:
    """The names in the row right above the numbers: one for each column, two of them with a channel or unit.

    None where that row is the list itself, a comment, or says less.
    """
    index = run.first - 1
    names = texts_of(grid.cells(index)) if index >= 0 and index != listed_at else []
    if len(names) != run.width or not all(kind_of(name) == TEXT for name in names):
        return None
    if isinstance(grid, TextGrid) and re.match(r"\s*(#|%|//)", grid.lines[index]):
        return None
    telling = [
        name for name in names if names_channel(name) or (recognise(name).unit and unit_of(name) is None)
    ]
    return names if len(telling) > 1 and len(set(names)) == len(names) else None


def _explained(names: Sequence[str], listed: Sequence[str]) -> list[str]:
    """Names, those that tell no channel with the words of a list: "len_mm" is "len_mm: length [mm]".

    The unit of the name itself counts where it has one.
    """
    result = []
    for name, words in zip(names, listed, strict=True):
        own, told = recognise(name), recognise(words)
        helps = own.channel is None and not own.otherwise and told.channel is not None
        if not helps:
            result.append(name)
            continue
        unit = own.unit or (unit.unit if (unit := unit_of(name)) is not None else None)
        plain = taken_apart(words)
        result.append(f"{name}: {plain.name} [{unit}]" if unit else f"{name}: {words}")
    return result


def _fits(grid: Grid, index: int, width: int) -> bool:
    """Whether a row has about as many cells as there are columns."""
    return abs(len([cell for cell in texts_of(grid.cells(index)) if cell]) - width) < 2


def _without_row_names(grid: Grid, run: Run, names: Sequence[str]) -> bool:
    """Whether a head lacks the name of the first column, which numbers or names the rows, as R writes it."""
    if len(names) != run.width - 1 or not all(names):
        return False
    first = [cells[0] for i in range(run.first, min(run.last, run.first + 20)) if (cells := grid.cells(i))]
    if len({str(cell) for cell in first}) < len(first):
        return False
    if all(kind_of(cell) == TEXT for cell in first):
        return True
    return all(
        kind_of(cell) == NUMBER and str(cell).strip().isdecimal() and int(str(cell)) - int(str(first[0])) == n
        for n, cell in enumerate(first)
    )


def _continued(grid: Grid, named: int, index: int, names: Sequence[str]) -> list[str] | None:
    """Names that go on in another line of fixed width, "MUSCLE" over "LENGTH"; None = they do not.

    Each word stands below or above one name, and together they name a channel, or what is none.
    """
    if not isinstance(grid, TextGrid) or grid.separator != BLANKS or abs(index - named) != 1:
        return None
    heads = list(re.finditer(r"\S+", grid.lines[named].expandtabs()))
    words = list(re.finditer(r"\S+", grid.lines[index].expandtabs()))
    if len(heads) != len(names) or not 0 < len(words) < len(heads):
        return None
    result = list(names)
    for word in words:
        over = [c for c, h in enumerate(heads) if h.start() <= word.end() and word.start() <= h.end()]
        if len(over) != 1 or unit_of(word[0]) is not None or word[0][0].isdigit():
            return None
        pair = (names[over[0]], word[0]) if index > named else (word[0], names[over[0]])
        result[over[0]] = " ".join(pair)
    for column, (name, longer) in enumerate(zip(names, result, strict=True)):
        known = recognise(longer)
        if recognise(name).channel is not None and known.channel is None and not known.otherwise:
            result[column] = name
    return result


def _placed_units(names: str, units: str) -> list[str] | None:
    """Units below names in columns of fixed width, one cell per name; None = it is no such line.

    A unit belongs to the name whose end or middle is nearest; the first column may have none.
    """
    heads = list(re.finditer(r"\S+(?:\s[\[(]\S+)?", names.expandtabs()))
    found = list(re.finditer(r"\([^()]*\)|\[[^\[\]]*\]|\S+", units.expandtabs()))
    if not found or len(found) > len(heads) or any(unit_of(word[0]) is None for word in found):
        return None
    cells = [""] * len(heads)
    for word in found:
        gaps = [
            min(
                abs(word.end() - head.end()),
                abs(word.start() - head.start()),
                abs(sum(word.span()) - sum(head.span())) // 2,
            )
            for head in heads
        ]
        nearest = gaps.index(min(gaps))
        if cells[nearest]:
            return None
        cells[nearest] = word[0]
    return cells


def _divides(names: Sequence[str], below: Sequence[str]) -> bool:
    """Whether a row of names is divided by the one below: "Kraft" over "Ist" and "Soll"."""
    pairs = list(zip(names, below, strict=False))
    gaps = [i for i, (name, under) in enumerate(pairs) if not name and under]
    parts = {*gaps, *(i - 1 for i in gaps)}  # the name above a gap stands for it too
    divided = [i for i in parts if i >= 0 and pairs[i][1]]
    loose = any(under and i not in parts for i, (_, under) in enumerate(pairs))
    everywhere = sum(map(bool, below)) >= sum(map(bool, names)) + len(gaps)
    return (
        bool(gaps)
        and len(divided) > len(gaps)
        and (everywhere or not loose)
        and not any(names_channel(b) for b in below if b)
    )


def _values_below(names: Sequence[str], below: Sequence[str]) -> dict[int, str]:
    """Column -> the value that a row below the names holds for one of several columns of the same name.

    Programs that keep a comment with each column write it so: "p = 0.2 MPa" and "p = 0.3 MPa" below "Force".
    """
    found: dict[int, str] = {}
    for column, (name, cell) in enumerate(zip(names, below, strict=False)):
        if name and sum(other.casefold() == name.casefold() for other in names) > 1:
            held = held_quantities(cell) if cell else []
            if len(held) == 1:
                found[column] = held[0].text
    return found if len(set(found.values())) > 1 else {}


def _filled_on(names: Sequence[str]) -> list[str]:
    """Names, each also for the columns without one behind it, as merged cells mean it."""
    filled: list[str] = []
    for name in names:
        filled.append(name or (filled[-1] if filled else ""))
    return filled


def _rows_above(grid: Grid, run: Run, after: int) -> list[int]:
    rows: list[int] = []
    for index in range(run.first - 1, after, -1):
        if _is_title(grid, index):
            continue
        if any(texts_of(grid.cells(index))):
            rows.insert(0, index)
        elif rows:
            break
        if len(rows) == _HEAD_ROWS:
            break
    return rows


def _is_title(grid: Grid, index: int) -> bool:
    """Whether a comment line says which value a block holds, and no more: ``# Last 25 N``."""
    if not isinstance(grid, TextGrid) or not re.match(r"\s*(#|%|//)", grid.lines[index]):
        return False
    text = " ".join(texts_of(grid.cells(index)))
    held = held_quantities(text)
    return len(held) == 1 and not re.search(r"\w", text.replace(held[0].text, "", 1))


def _row_of_names(
    texts: dict[int, list[str]], rows: Sequence[int], run: Run, lists: Mapping[int, Mapping[str, str]]
) -> int:
    def score(index: int) -> tuple[int, int, int]:
        cells = texts[index]
        if len(cells) == 1 and run.width > 1:
            return 0, 0, index
        inside = [cell for column, cell in enumerate(cells) if cell and column < run.width]
        units = sum(unit_of(cell) is not None for cell in inside)
        known = sum(
            (names_channel(cell) and scale_in(cell, "") is None) or cell in lists[index] for cell in inside
        )
        return known, 0 if inside and 2 * units > len(inside) else len(inside), index

    return max(rows, key=score)


def _row_of_units(texts: dict[int, list[str]], rows: Sequence[int], names: Sequence[str]) -> int | None:
    best, most = None, 0
    for index in rows:
        filled = [(column, cell) for column, cell in enumerate(texts[index]) if cell and column < len(names)]
        units = sum(unit_of(cell) is not None for _, cell in filled)
        physical = sum(  # the 1 of "Page 1" is no unit by itself
            bool(dimension_of(unit.unit)) and not cell.isdecimal()
            for _, cell in filled
            if (unit := unit_of(cell)) is not None
        )
        quantity = any(
            "=" in cell or re.search(r"[0-9]{2}", cell) for _, cell in filled if unit_of(cell) is None
        )
        if physical and not quantity and 2 * units >= len(filled) and units > most:
            best, most = index, units
    return best


def _units_in_preamble(grid: Grid, named: int, names: Sequence[str]) -> int | None:
    """A row far above that holds the units of the columns, as loggers write it; it begins with its label."""
    for index in range(named - 1, max(-1, named - 1 - _UNITS_WITHIN), -1):
        if _fitting(names, texts_of(grid.cells(index))) >= 2:
            return index
    return None


def _fitting(names: Sequence[str], cells: Sequence[str]) -> int:
    """Number of cells that are the unit of the channel whose name stands in their column."""
    fitting = 0
    for name, cell in zip(names, cells, strict=False):
        unit = unit_of(cell) if cell else None
        channel = recognise(name).channel if name else None
        fitting += bool(
            unit and channel and dimension_of(unit.unit) and recognise(name, cell).channel == channel
        )
    return fitting


def _padded(cells: Sequence[str], width: int) -> list[str]:
    return [*cells, *[""] * (width - len(cells))]
