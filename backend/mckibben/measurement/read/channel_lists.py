"""Lists of channels above a head: what loggers say of ``CH1`` or ``U1-1`` in a row or a column of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mckibben.measurement.read.grid import BLANKS, Grid, TextGrid
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.locate import names_channel, texts_of
from mckibben.measurement.read.recognise import BY_UNIT, recognise
from mckibben.measurement.read.unit_words import DIMENSIONS, dimension_of, unit_of
from mckibben.measurement.read.vocabulary import reference_among, words_of

_WITHIN = 200  # rows above a head in which its channels may be listed
_FIRST_CELLS = 3  # of a row, among which the name of the channel stands
_BLOCK = 8  # rows between the names of a list and what it says of them


def listed_above(grid: Grid, index: int) -> dict[str, str]:
    """The names of a row of the head of which the file says above what they are.

    A list has a row for each channel, ``CH1,Pressure,DC,10V,kPa``, its name perhaps behind that of the
    module; or a column for each, ``CH,U1-1,U1-2`` over ``Comment,Pressure,Force``. It has to speak of two
    names and to name two channels, one of them perhaps by its unit only; a word beside the name that is no
    channel's says nothing. What a row says of absolute or gauge goes with it.
    """
    head = texts_of(grid.cells(index))
    unknown = {taken_apart(name).name: name for name in head if name and not names_channel(name)}
    unknown.pop("", None)
    return _by_rows(grid, index, unknown) or _by_columns(grid, index, unknown)


def _by_rows(grid: Grid, index: int, unknown: Mapping[str, str]) -> dict[str, str]:
    said: dict[str, str] = {}
    sure: set[str] = set()
    for above in range(max(0, index - _WITHIN), index):
        cells = [cell for cell in texts_of(grid.cells(above)) if cell]
        place = next((i for i, cell in enumerate(cells[:_FIRST_CELLS]) if cell in unknown), None)
        if place is None or len(cells) < place + 2 or sum(cell in unknown for cell in cells) > 1:
            continue
        name, cells = unknown[cells[place]], cells[place:]
        if name in sure:
            continue
        units = [cell for cell in cells[2:] if (unit := unit_of(cell)) and dimension_of(unit.unit)]
        plain = names_channel(cells[1])
        if not plain and not any(recognise(cells[1], u).channel and _lettered(cells[1], u) for u in units):
            continue
        said[name] = _with_reference(cells[1:])
        if plain:
            sure.add(name)
    return said if len(said) > 1 and sure else {}


def _by_columns(grid: Grid, index: int, unknown: Mapping[str, str]) -> dict[str, str]:
    if isinstance(grid, TextGrid) and grid.separator == BLANKS:
        return {}
    for above in range(max(0, index - _WITHIN), index):
        cells = texts_of(grid.cells(above))
        places = {column: unknown[cell] for column, cell in enumerate(cells) if cell in unknown}
        if len(places) < 2:
            continue
        best: dict[str, str] = {}
        for below in range(above + 1, min(above + 1 + _BLOCK, index)):
            row = texts_of(grid.cells(below))
            if not any(row):
                break
            said = {name: row[column] for column, name in places.items() if column < len(row) and row[column]}
            best = max(best, said, key=_named)
        if _named(best) > 1:
            return best
    return {}


def _named(said: Mapping[str, str]) -> int:
    """Number of channels that the words of a row say and the units of the head allow."""
    found: set[str] = set()
    for name, words in said.items():
        channel, unit = recognise(words).channel, taken_apart(name).unit
        fitting = channel is not None and (unit is None or dimension_of(unit) in DIMENSIONS.get(channel, ()))
        found |= {channel} if channel is not None and fitting and names_channel(words) else set()
    return len(found)


def _with_reference(cells: Sequence[str]) -> str:
    """What a list calls a channel, and whether another cell says that its pressure is absolute or gauge."""
    mark = next((c for c in cells[1:] if reference_among(words_of(c)) is not None), "")
    return cells[0] if reference_among(words_of(cells[0])) is not None or not mark else f"{cells[0]} {mark}"


def _lettered(name: str, unit: str) -> bool:
    """Whether a name says a channel by itself or by a letter that fits the unit, not by the unit alone."""
    return recognise(name, unit).penalty < BY_UNIT
