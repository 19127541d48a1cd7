"""Where the tables of a grid are: runs of rows of numbers, and the head above each."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.grid import BLANKS, Grid, TextGrid
from mckibben.measurement.read.held import held_quantities
from mckibben.measurement.read.limits import MAX_BLOCKS
from mckibben.measurement.read.recognise import BY_UNIT, recognise
from mckibben.measurement.read.unit_words import unit_of
from mckibben.measurement.read.values import CLOCK, GAP, NUMBER, TEXT, kind_of
from mckibben.measurement.read.vocabulary import STATISTICS, words_of

_HEAD_ROWS = 8  # most rows of a head
_TITLE_ROWS = 12  # most rows between two blocks of one head
_NAME_WORDS = 8  # most words of a name; more are a remark
_QUICK = re.compile(r"[\s0-9.,;|+\-eE]*")


@dataclass
class Run:
    """Rows of numbers in the same columns: ``first`` to ``last`` (exclusive), odd rows between ``pieces``.

    ``headless``: the head of the run before is its own; a text between them says what it holds.
    ``numbers`` holds the columns of numbers, ``clocks`` those of times of day; ``rows`` counts the good rows,
    ``filled`` their numbers.
    """

    first: int
    last: int
    numbers: frozenset[int]
    width: int
    rows: int = 0
    filled: int = 0
    clocks: frozenset[int] = field(default_factory=frozenset)
    headless: bool = False
    pieces: list[tuple[int, int]] = field(default_factory=list)


@dataclass(frozen=True)
class TableHead:
    """The head of a run: name and unit of each column, where they stand, and the rows it takes.

    ``row`` is None where the table has no head; ``units_at`` None where the units stand in the names.
    """

    names: list[str]
    units: list[str | None]
    row: int | None
    units_at: int | None
    rows: tuple[int, ...]


def texts_of(cells: Sequence[Cell]) -> list[str]:
    """The cells as texts without blanks around them."""
    return ["" if cell is None else " ".join(str(cell).split()) for cell in cells]


def titles_of(grid: Grid, index: int) -> list[tuple[int, str]]:
    """(column, text) of a row that may be a title; between blanks stand words, the text is the whole line."""
    texts = texts_of(grid.cells(index))
    if isinstance(grid, TextGrid) and grid.separator == BLANKS:
        return [(0, " ".join(texts))] if any(texts) else []
    return [(column, text) for column, text in enumerate(texts) if text]


def find_runs(grid: Grid, until: int | None = None) -> list[Run]:
    """The runs of numbers in the first rows of a grid, in their order."""
    runs: list[Run] = []
    run: Run | None = None
    separators = -1
    for index in range(len(grid) if until is None else min(until, len(grid))):
        if run is not None and isinstance(grid, TextGrid) and len(grid.separator.strip() or "\t") == 1:
            line = grid.lines[index]
            if (
                line.count(grid.separator) == separators
                and _QUICK.fullmatch(line)
                and _tidy(line, grid.separator)
            ):
                run.last, run.rows, run.filled = index + 1, run.rows + 1, run.filled + separators + 1
                continue
        cells = grid.cells(index)
        kinds = [kind_of(cell) for cell in cells]
        numbers = {i for i, kind in enumerate(kinds) if kind in (NUMBER, CLOCK)}
        texts = kinds.count(TEXT)
        if not numbers and not texts:
            continue
        if not numbers or len(numbers) < texts or (run is None and _sums_up(grid, index)):
            run = None
            continue
        if run is not None and run.rows > 1 and texts and _is_remark(grid, index, run):
            run = None
            continue
        clocks = frozenset(i for i, kind in enumerate(kinds) if kind == CLOCK)
        if run is None or not _continues(run, kinds, numbers, clocks):
            run = Run(index, index, frozenset(numbers), len(cells), clocks=clocks)
            runs.append(run)
        separators = grid.lines[index].count(grid.separator) if isinstance(grid, TextGrid) else -1
        if clocks or len(numbers) < len(kinds):
            separators = -1
        run.last, run.rows, run.filled = index + 1, run.rows + 1, run.filled + len(numbers)
        run.numbers |= numbers
        run.width = max(run.width, len(cells))
    return runs


def _tidy(line: str, separator: str) -> bool:
    """Whether no cell of a line of numbers is empty."""
    return (
        separator + separator not in line
        and not line.startswith(separator)
        and not line.rstrip().endswith(separator)
    )


def _continues(run: Run, kinds: Sequence[str], numbers: set[int], clocks: frozenset[int]) -> bool:
    if any(column < len(kinds) and kinds[column] == TEXT for column in run.numbers):
        return False
    if any((column in clocks) != (column in run.clocks) for column in numbers & run.numbers):
        return False
    return bool(numbers & run.numbers)


def main_runs(grid: Grid, runs: Sequence[Run]) -> list[Run]:
    """The runs that are tables of readings: the largest one, its pieces behind odd rows, and blocks like it.

    What is left are statistics, counts of channels, small tables of results.
    """
    if not runs:
        return []
    largest = max(runs, key=lambda run: (run.filled, run.rows))
    head = _row_above(grid, largest)
    kept: list[Run] = []
    for run in runs:
        if len(kept) > MAX_BLOCKS:
            break  # whoever asked refuses them
        if run is not largest and run.last <= largest.first and _is_footer(grid, run):
            continue  # statistics above the readings
        alike = run.numbers == largest.numbers or (
            run.width == largest.width and run.numbers <= largest.numbers
        )
        headed = alike and (_is_headed(grid, run) or (len(head) > 1 and _row_above(grid, run) == head))
        follows = bool(kept) and run.first - kept[-1].last <= 3 and not headed
        if kept and alike and not headed and run.rows >= 2 and _is_titled(grid, kept[-1].last, run.first):
            run.headless = True
            kept.append(run)
        elif alike and follows and not _is_footer(grid, run) and not _is_summary(grid, kept[-1], run):
            last = kept[-1]
            between = range(last.last, run.first)
            broken = [(i, i + 1) for i in between if _is_broken(grid, i) and not _is_remark(grid, i, last)]
            last.pieces = last.pieces or [(last.first, last.last)]
            last.pieces += [*broken, (run.first, run.last)]
            last.last, last.rows, last.filled = run.last, last.rows + run.rows, last.filled + run.filled
        elif run is largest or (headed and run.rows >= 2 and alike and 20 * run.rows >= largest.rows):
            kept.append(run)
    return kept


def _row_above(grid: Grid, run: Run) -> list[str]:
    """The last row of texts above a run."""
    for index in range(run.first - 1, max(-1, run.first - 4), -1):
        if any(names := texts_of(grid.cells(index))):
            return [] if _is_remark(grid, index, run) else names
    return []


def _is_titled(grid: Grid, first: int, last: int) -> bool:
    """Whether a text between two runs says which pressure, stroke or load the next one holds."""
    return last - first <= _TITLE_ROWS and any(
        quantity.channel == "pressure" or quantity.named or quantity.worded
        for index in range(first, last)
        for _, text in titles_of(grid, index)
        if not recognise(text).otherwise
        for quantity in held_quantities(text)
    )


def _is_headed(grid: Grid, run: Run) -> bool:
    """Whether a row above a run names columns of it."""
    for index in range(run.first - 1, max(-1, run.first - 1 - _HEAD_ROWS), -1):
        names = texts_of(grid.cells(index))
        if not any(names):
            if index < run.first - 2:
                break
            continue
        if sum(names_channel(name) for name in names) >= min(2, len(run.numbers)):
            return True
    return False


def _is_broken(grid: Grid, index: int) -> bool:
    """Whether a row beside readings is one with a wrong cell: with a number, no title, no statistic."""
    if not any(kind_of(cell) in (NUMBER, CLOCK) for cell in grid.cells(index)) or _is_statistic(grid, index):
        return False
    remark = isinstance(grid, TextGrid) and re.match(r"\s*(#|%|//)", grid.lines[index])
    return not remark and not any(held_quantities(text) for _, text in titles_of(grid, index))


def _is_remark(grid: Grid, index: int, run: Run) -> bool:
    """Whether a row between readings tells an event: words, at most the time, and cells left empty."""
    kinds = [kind_of(cell) for cell in grid.cells(index)]
    shown = [kinds[column] if column < len(kinds) else GAP for column in sorted(run.numbers)]
    readings = sum(kind in (NUMBER, CLOCK) for kind in shown)
    worded = any(
        " " in text or text.isalpha()
        for text, kind in zip(texts_of(grid.cells(index)), kinds, strict=True)
        if kind == TEXT
    )
    return worded and len(shown) > 2 and readings <= 1 and GAP in shown


def _sums_up(grid: Grid, index: int) -> bool:
    """Whether a row of statistics stands above readings, which begin with a number."""
    if not _is_statistic(grid, index):
        return False
    below = (grid.cells(i) for i in range(index + 1, min(len(grid), index + 8)))
    return any(cells and kind_of(cells[0]) in (NUMBER, CLOCK) for cells in below)


def _is_statistic(grid: Grid, index: int) -> bool:
    """Whether a row begins with a word of statistics ("Mean")."""
    words = words_of(next((text for text in texts_of(grid.cells(index)) if text), ""))
    return bool(words) and words[0] in STATISTICS


def with_broken_rows(grid: Grid, run: Run, head: TableHead) -> None:
    """Take the rows next to a run into it that are readings with a wrong cell: reading them says so.

    Above, those between the head and the run that hold numbers; below, those that begin with one.
    """
    top = max(
        (row for row in (head.row, head.units_at) if row is not None and row < run.first), default=run.first
    )
    for index in range(top + 1, run.first):  # rows of settings may stand between the rows of a head
        kinds = [kind_of(cell) for cell in grid.cells(index)]
        if kinds.count(TEXT) > 1 and NUMBER not in kinds and CLOCK not in kinds:
            top = index
    above = [i for i in range(top + 1, run.first) if _is_broken(grid, i)] if head.row is not None else []
    last = run.last
    while last < len(grid) and (cells := [c for c in grid.cells(last) if kind_of(c) != GAP]):
        if kind_of(cells[0]) not in (NUMBER, CLOCK):
            break
        last += 1
    pieces = run.pieces or [(run.first, run.last)]
    if above:
        pieces = [(above[0], pieces[0][1]), *pieces[1:]]
    if last > run.last:
        pieces = [*pieces[:-1], (pieces[-1][0], last)]
    run.pieces = pieces if len(pieces) > 1 else []
    run.first, run.last = pieces[0][0], pieces[-1][1]


def _is_footer(grid: Grid, run: Run) -> bool:
    """Whether a piece below a table is its statistics: every row begins with a word ("Mean", "Max").

    Without an empty row above it has to be a word of statistics; any other may be a reading gone wrong.
    """
    parted = run.first > 0 and not any(texts_of(grid.cells(run.first - 1)))
    parted = parted or any(_is_statistic(grid, index) for index in range(run.first, run.last))
    for index in range(run.first, run.last):
        words = words_of(next((text for text in texts_of(grid.cells(index)) if text), ""))
        if not words or not (words[0] in STATISTICS or (parted and re.match(r"[^\W\d_]", words[0]))):
            return False
    return True


def _is_summary(grid: Grid, table: Run, run: Run) -> bool:
    """Whether a piece below a table is set apart from it and its rows begin with words: "Fmax", "Fmin".

    An empty row or a title without numbers sets it apart; the words stand where the table has numbers.
    """
    between = [texts_of(grid.cells(index)) for index in range(table.last, run.first)]
    filled = [[cell for cell in cells if cell] for cells in between]
    if not any(not cells or (len(cells) == 1 and kind_of(cells[0]) == TEXT) for cells in filled):
        return False
    for index in range(run.first, run.last):
        kinds = [kind_of(cell) for cell in grid.cells(index)]
        first = next((column for column, kind in enumerate(kinds) if kind != GAP), None)
        if first is None or first not in table.numbers or kinds[first] != TEXT:
            return False
    return True


def names_channel(name: str) -> bool:
    """Whether a text names a channel, not only a unit."""
    if not name or len(name) > 120 or len(name.split()) > _NAME_WORDS:
        return False
    known = recognise(name)
    return (known.channel is not None and known.penalty < BY_UNIT and unit_of(name) is None) or _is_letter(
        name
    )


def _is_letter(name: str) -> bool:
    return re.fullmatch(r"[tpxFLsDTκuUPX]", name.strip()) is not None
