"""Sheets of cells -> one table: runs of numeric rows, their heads and units, blocks, and the shapes of
tables.

A run is a number of rows whose numbers stand in the same columns. Its score is what its heads say times the
root of
its numbers; the best run is the measurement, others with the same heads are further blocks of it.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mckibben.measurement.reading.conditions import TEXT_CONDITIONS, key_of
from mckibben.measurement.reading.heads import head_claims, head_score, taken_apart, without_run
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.limits import MAX_COLUMNS, MAX_ROWS, MAX_TEXT, MAX_TEXTS, SPLIT
from mckibben.measurement.reading.model import Cell, Column, Sheet, Span, Table
from mckibben.measurement.reading.numbers import (
    CLOCK,
    EMPTY,
    MARK,
    NUMBER,
    TEXT,
    NumberStyle,
    kind_of,
    numbers_of,
    style_of,
)
from mckibben.measurement.reading.runs import Run, is_axis
from mckibben.measurement.reading.shapes import (
    TRAILING,
    NeedsCellsError,
    Part,
    column_of,
    parts_of,
    transposed,
)
from mckibben.measurement.reading.units import RAW, quantities, unit_of
from mckibben.physics.errors import InputError, did_you_mean

_ABOVE = 8  # rows above a run that may be its heads
_LOOK = 25  # rows above in which a labelled row of units or of descriptions is looked for
_GAP = 3  # rows without numbers that a run goes on behind
_INSIDE = 0.5  # share of the numbers of a row that stand where those of the run do
_HEAD_SHARE = 0.5  # of the columns of a run, that a row of heads fills
_UNITS_SHARE = 0.6  # of the cells of a row of units, that are units
_POOR_HEADS = 0.8  # nats a column, below which other names are looked for
_EMPTY_HEADS = 2.0  # score of a run without heads
_MOST_OF_A_HEAD = 3.0  # what one head adds to the score of its run
_SHOWN_ROWS, _SHOWN_BELOW, _SHOWN_ABOVE, _SHOWN_CELLS, _SHOWN_LENGTH = 60, 8, 20, 60, 80
_COMMENTS = ("#", "%", "!", "/", '"', "'", ";")
_LONGEST_HEAD = 300  # characters of a head
_LONGEST_WORDS = 32  # characters of a cell of a row that groups columns
_QUANTITY = re.compile(r"\s*[-+]?[0-9.,]+\s*\S{0,12}\s*")
_NOTES = 0.5  # of the rows of a table, that notes beside it fill
_LABELS = 3  # rows of labels, from which a column of them is one
NO_TABLE = "file"  # field of the error about a file without numbers and without heads
_HINT = "e.g. a header 'pressure_bar,length_mm,force_N'"


def table_of(
    sheets: Sequence[Sheet],
    name: str,
    *,
    wanted: str | None = None,
    head: int | None = None,
    _stripped: bool = False,
) -> Table:
    """The measurement among the sheets.

    Args:
        sheets: of the file.
        name: of the file, for messages.
        wanted: sheet that the user picks.
        head: number of the row of names that the user picks.

    Raises:
        InputError: no rows of numbers, or no such sheet or row.
    """
    if wanted is not None:
        chosen = [s for s in sheets if s.name == wanted or s.name.rstrip(".") == wanted]
        if not chosen:
            hint = did_you_mean(wanted, [s.name for s in sheets if s.name])
            raise InputError(f"{name}: there is no sheet '{wanted}'", field="sheet", hint=hint)
        others = {s.name: bool(s.arrays or _runs(s)) for s in sheets if s not in chosen}
        titles = [(s.name, s in chosen) for s in sheets if s in chosen or others[s.name]]
        beside = [replace(s, rows=s.rows[:200], arrays=None) for s in sheets if not others.get(s.name, True)]
        table = table_of([*chosen, *beside], name, head=head)
        return replace(table, tables=tuple(titles) if len(titles) > 1 else ())
    named = [_with_units_of_values(s) for s in sheets if s.arrays is not None]
    if named:
        sheets = [_with_units_of_values(s) for s in sheets]
        return _of_named(named, sheets, name)
    grids = [
        without_notes(without_statistics(cornered(without_words_of_slack(transposed(s))))) for s in sheets
    ]
    grids = [
        s.whole() if s.whole is not None and s is not old else s for s, old in zip(grids, sheets, strict=True)
    ]
    runs = [run for sheet in grids for run in _runs(sheet)]
    for run in runs:
        _head(run, head)
        known = sum(
            min(_MOST_OF_A_HEAD, max(0.0, head_score(h, run.units.get(c, "")))) for c, h in run.heads.items()
        )
        run.score = (_EMPTY_HEADS + known) * (len(run.rows) * len(run.columns)) ** 0.5
    if head is not None:
        runs = _headed(runs, head)
        if not runs:
            raise InputError(
                f"{name}, row {head}: there are no rows of numbers below it",
                field="head",
                hint="say a row with names above numbers: --head 3",
            )
    if not runs and head is None and not _stripped:
        bare = [without_units(s) for s in sheets]
        return table_of(bare, name, _stripped=True)
    if not runs:
        raise _no_table(sheets, name)
    best = max(runs, key=lambda run: run.score)
    for run in runs:  # a block without heads of its own goes on with those above
        if (
            not run.heads
            and run.sheet is best.sheet
            and run.columns == best.columns
            and run.rows[0] > best.rows[0]
        ):
            run.heads, run.units, run.more, run.described = best.heads, best.units, best.more, best.described
    alike = [run for run in runs if _is_same(run, best)]
    try:
        table = _joined(alike, best, runs, grids, name)
    except NeedsCellsError:
        whole = [s.whole() if s.whole is not None else s for s in sheets]
        return table_of(whole, name, head=head)
    if not table.rows:
        raise InputError(f"{name}: no row of the table holds a number", field="rows", hint=_HINT)
    return table


def _headed(runs: list[Run], line: int) -> list[Run]:
    """The runs whose names stand in a row that the user picks; if it is that of none, the first one below."""
    exact = [run for run in runs if run.head_row is not None and run.sheet.line(run.head_row) == line]
    below = [(run, [r for r in run.rows if run.sheet.line(r) > line]) for run in runs if not exact]
    first = next(((run, rows) for run, rows in below if rows), None)
    if first is None:
        return exact
    run, run.rows = first
    row = next((i for i in range(run.rows[0]) if run.sheet.line(i) == line), None)
    if row is None:
        return []
    cells = run.sheet.rows[row]
    width = max(len(cells), max(run.columns) + 1)
    run.heads = {c: _text(cells[c]) if c < len(cells) else "" for c in range(min(width, MAX_COLUMNS))}
    run.head_row, run.unit_row, run.units, run.more, run.described = row, None, {}, {}, {}
    return [run]


def _no_table(sheets: Sequence[Sheet], name: str) -> InputError:
    """The refusal of a file without rows of numbers, naming the row that could be the names of columns."""
    for sheet in sheets:
        for i, row in enumerate(sheet.rows[:_SHOWN_ROWS]):
            if sum(head_score(_text(c)) > 0.0 for c in row if c != "") < 2:
                continue
            below = next(
                (r for r in range(i + 1, len(sheet.rows)) if any(c != "" for c in sheet.rows[r])), None
            )
            shown = "" if below is None else f"; {sheet.place(below)} is '{sentence(sheet.rows[below])[:60]}'"
            heads = ", ".join(_text(c) for c in row if c != "")[:80]
            row_there = f"row {sheet.line(i)}"
            why = f"{name}, {row_there}: there are no rows of numbers below the header '{heads}'{shown}"
            return InputError(why, field=row_there, hint="it needs one row of numbers per reading")
    why = f"{name}: no table: no rows of numbers with at least two columns"
    return InputError(why, field=NO_TABLE, hint=_HINT)


def _with_units_of_values(sheet: Sheet) -> Sheet:
    """A sheet with "p: 1" and "p_unit: bar" of one place as "p: 1 bar"."""
    units = {
        span.where.rpartition(mark)[0]: span.text.rpartition(": ")[2]
        for span in sheet.texts
        for mark in ("_unit", ".unit")
        if span.where.lower().endswith(mark)
    }
    texts = [
        Span(span.where, f"{span.text} {units[span.where]}") if span.where in units else span
        for span in sheet.texts
    ]
    return replace(sheet, texts=tuple(texts)) if units else sheet


_CELL_WITH_UNIT = re.compile(r"([-+]?[0-9]{1,12}(?:[.,][0-9]{1,12})?)\s?([^\W\d_]{1,5}(?:/[^\W\d_]{1,4})?|%)")


def without_unit(cell: Cell) -> Cell:
    """The number of a cell ``2,00 bar``."""
    match = _CELL_WITH_UNIT.fullmatch(cell) if isinstance(cell, str) and len(cell) < 40 else None
    return match[1] if match and unit_of(match[2]) is not None else cell


def without_units(sheet: Sheet) -> Sheet:
    """A sheet whose cells hold their units, ``2,00 bar``, with these in a row of their own above the first of
    them.
    """
    rows, lines = sheet.rows, [sheet.line(i) for i in range(len(sheet.rows))]
    for i, row in enumerate(rows[:200]):
        found = [_CELL_WITH_UNIT.fullmatch(c) if isinstance(c, str) and len(c) < 40 else None for c in row]
        if sum(m is not None and unit_of(m[2]) is not None for m in found) >= 2:
            units: list[Cell] = [m[2] if m else "" for m in found]
            rows, lines = [*rows[:i], units, *rows[i:]], [*lines[:i], lines[i], *lines[i:]]
            break
    bare = [[without_unit(c) for c in row] for row in rows]
    style = style_of(cell for row in bare[:400] for cell in row)
    return replace(sheet, rows=bare, lines=tuple(lines), decimal=style.decimal, thousands=style.thousands)


def _joined(alike: list[Run], best: Run, runs: list[Run], sheets: Sequence[Sheet], name: str) -> Table:
    """The blocks of a table one below the other."""
    used = {
        (id(run.sheet), row)
        for run in alike
        for row in (*run.rows, run.head_row, run.unit_row)
        if row is not None
    }
    several = len({id(run.sheet) for run in alike}) > 1
    own = [{note.text for note in run.sheet.notes} for run in alike]
    common = set[str]().union(*own) if not several else set[str].intersection(*own)
    parts: list[Part] = []
    for run in alike:
        title = [*run.title, *(note for note in run.sheet.notes if note.text not in common)]
        title += [Span(f"sheet '{run.sheet.name}'", run.sheet.name)] if several else []
        parts += parts_of(run, title)
    parts = _with_results(parts, [run for run in runs if not any(run is one for one in alike)])
    texts = [t for s in sheets for t in s.texts] + _texts(sheets, used)
    texts += {n.text: n for s in sheets for n in s.notes if n.text in common}.values()
    texts += {span.text: span for part in parts for span in part.same}.values()
    if best.sheet.name and not several:
        texts.append(Span(f"name of sheet '{best.sheet.name}'", best.sheet.name))
    others = [
        (
            f"{run.sheet.name or 'table'}, {run.sheet.noun}s {run.sheet.line(run.rows[0])} to "
            f"{run.sheet.line(run.rows[-1])}",
            "it is in another table",
        )
        for run in runs
        if not any(run is one for one in alike)
    ]
    read = {run.sheet.name for run in alike}
    tables = tuple(dict.fromkeys((run.sheet.name, run.sheet.name in read) for run in runs if run.sheet.name))
    rivals = _rivals(alike, best, runs)
    if rivals:
        parts = [part for run in alike if run.sheet is best.sheet for part in parts_of(run, list(run.title))]
    head_row = None if best.head_row is None else best.sheet.line(best.head_row)
    whole = stacked(parts, texts)
    return replace(
        whole,
        where=f"{name}, sheet '{best.sheet.name}'" if best.sheet.name else name,
        format=best.sheet.format,
        head_row=head_row,
        unit_where="" if best.unit_row is None else best.sheet.place(best.unit_row),
        unit_row=None if best.unit_row is None else best.sheet.line(best.unit_row),
        others=tuple(others),
        tables=tables if len(tables) > 1 else (),
        rivals=rivals,
        raw=_shown(best.sheet, best.head_row),
        messages=(
            *(m for s in sheets for m in s.messages),
            *whole.messages,
            *_unread_rows(alike, best),
            *_as_runs([run.sheet.place(run.rows[0]) for run in alike if not rivals]),
            *([f"only the first {MAX_TEXTS} texts beside the table are searched"] * (len(texts) > MAX_TEXTS)),
        ),
        headless=not any(best.heads.values()),
    )


def _unread_rows(alike: Sequence[Run], best: Run) -> list[str]:
    """What is said of the texts between the rows of a table, and below its last one."""
    sheet, rows = best.sheet, best.sheet.rows
    last = max(run.rows[-1] for run in alike if run.sheet is sheet)
    below = [i for i in range(last + 1, min(len(rows), last + 200)) if any(c != "" for c in rows[i])]
    between = [
        i
        for run in alike
        if run.sheet is sheet
        for i in run.remarks
        if run.rows[0] < i < run.rows[-1]
        and not str(rows[i][0]).startswith(_COMMENTS)
        and not _is_statistic(_kinds(rows[i])[2])
    ]
    messages = []
    for found, where in ((between, "between the readings"), (below, "below the table")):
        if found:
            first, end = sheet.line(found[0]), sheet.line(found[-1])
            shown = ", ".join(f"'{sentence(rows[i])[:40]}'" for i in found[:4])
            place = f"row {first} {where} is" if first == end else f"rows {first} to {end} {where} are"
            messages.append(f"{place} not read: {shown}")
    return messages


def _with_results(parts: list[Part], others: Sequence[Run]) -> list[Part]:
    """Blocks with what a table of the file has in the row that is called like them: "Probe 1", 3.5 bar."""
    names = [[span.text.strip().casefold() for span in part.title] for part in parts]
    for run in others if len(parts) > 1 else ():
        labels = {_text(run.sheet.rows[r][0]).casefold(): r for r in run.rows if run.sheet.rows[r]}
        rows = [next((labels[name] for name in own if name in labels), None) for own in names]
        if None not in rows and len(set(rows)) == len(rows):
            return [
                part._replace(title=(*part.title, *_stated_in(run, row)))
                for part, row in zip(parts, rows, strict=True)
                if row is not None
            ]
    return parts


def _stated_in(run: Run, row: int) -> list[Span]:
    """The cells of a row with their heads and units, statistics left out."""
    cells = run.sheet.rows[row]
    return [
        Span(run.sheet.place(row), f"{run.heads[c]}: {_text(cells[c])} {run.units.get(c, '')}".strip())
        for c in run.columns
        if c < len(cells)
        and kind_of(cells[c]) == NUMBER
        and run.heads.get(c)
        and not word_set("statistic").among(words_of(run.heads[c]))
    ]


def _rivals(alike: list[Run], best: Run, runs: list[Run]) -> tuple[tuple[str, str], ...]:
    """Sheets with as good a table, of which nothing tells which one is meant, or whether they are runs of one
    test.
    """
    sheets = list(dict.fromkeys(run.sheet.name for run in alike))
    if len(sheets) > 1:
        if _are_runs(sheets) or any(
            run.title and any(quantities(t.text) for t in run.title) for run in alike
        ):
            return ()
        return tuple((sheet, ", ".join(h for h, _ in best.names)[:80]) for sheet in sheets)
    others = [
        run
        for run in runs
        if run.sheet.name and run.sheet.name not in sheets and _channels(run) >= max(2, _channels(best))
    ]
    if not others:
        return ()
    names = dict.fromkeys([best.sheet.name, *(run.sheet.name for run in others)])
    return tuple((sheet, "") for sheet in names)


def _are_runs(names: Sequence[str]) -> bool:
    """Whether names differ by a quantity, or by nothing than a number."""
    if all(quantities(name.replace("_", " ")) for name in names):
        return True
    plain = {re.sub(r"\d+(?:[.,]\d+)?", "#", name) for name in names}
    return len(plain) == 1


def _channels(run: Run) -> int:
    """Number of different channels that the heads of a run name."""
    return len(
        {c.value for h, u in run.names for c in head_claims(h[:200], u) if c.facet == "channel"}
        - {"group", "direction"}
    )


def stacked(parts: Sequence[Part], texts: Sequence[Span]) -> Table:
    """Blocks of the same columns as one table."""
    first = parts[0]
    columns = []
    bad: dict[int, str] = {}
    offset = 0
    for part in parts:
        bad |= {row + offset: what for row, what in part.bad.items()}
        offset += len(part.lines)
    for place, column in enumerate(first.columns):
        pieces = [part.columns[place] for part in parts if place < len(part.columns)]
        words = None
        if any(piece.words is not None for piece in pieces):
            words = tuple(w for piece in pieces for w in (piece.words or ("",) * len(piece.values)))
        gaps, offset = {}, 0
        for piece in pieces:
            gaps |= {row + offset: gap for row, gap in piece.gaps.items()}
            offset += len(piece.values)
        values = np.concatenate([piece.values for piece in pieces])
        columns.append(replace(column, values=values, words=words, gaps=gaps))
    own = {column.place for column in first.columns}
    also = {column.place for part in parts for column in part.columns} - own
    blocks = np.concatenate([np.full(len(part.columns[0].values), k) for k, part in enumerate(parts)])
    columns = [column for column in columns if len(column.values) == len(blocks)]
    return Table(
        columns=tuple(_keyed(columns)),
        texts=tuple(texts[:MAX_TEXTS]),
        blocks=blocks,
        titles=tuple(part.title for part in parts) if len(parts) > 1 else ((),),
        lines=np.concatenate([part.lines for part in parts]),
        bad=bad,
        also=tuple(sorted(place for place in also if place >= 0)),
        messages=tuple(dict.fromkeys(m for part in parts for m in part.messages)),
    )


def _keyed(columns: Sequence[Column]) -> list[Column]:
    """Columns with names that users can tell apart: the head, else the unit, else the place."""
    seen: Counter[str] = Counter()
    result = []
    for place, column in enumerate(columns):
        head = column.head.strip() or column.unit.strip("[]() ") or f"column {place + 1}"
        seen[head] += 1
        key = head if seen[head] == 1 else f"{head} #{seen[head]}"
        result.append(replace(column, head=column.head if column.head.strip() else key, key=key))
    return result


def _is_same(run: Run, best: Run) -> bool:
    """Whether a run has the heads of another one, numbers and names of runs in them apart."""
    if run is best:
        return True
    mine, theirs = (
        [(re.sub(r"\d+(?:[.,]\d+)?", "#", h), u) for h, u in r.names if h or u] for r in (run, best)
    )
    return bool(mine) and mine == theirs


def without_statistics(sheet: Sheet) -> Sheet:
    """A sheet without the rows of statistics between its heads and its readings."""
    for i, row in enumerate(sheet.rows[1:60], 1):
        _, _, first, _ = _kinds(row)
        if first and _is_statistic(first) and any(kind_of(c) == NUMBER for c in row):
            above = [c for c in sheet.rows[i - 1] if c != ""]
            if (len(above) > 1 and not _is_numeric(sheet.rows[i - 1])) or (
                i > 1 and _is_statistic(str(sheet.rows[i - 1][0]))
            ):
                rows = [r for j, r in enumerate(sheet.rows) if j != i]
                lines = tuple(sheet.line(j) for j in range(len(sheet.rows)) if j != i)
                return without_statistics(replace(sheet, rows=rows, lines=lines))
    return sheet


_OFTEN = 3  # times that a word stands where numbers stand


def without_words_of_slack(sheet: Sheet) -> Sheet:
    """A sheet whose one word that stands again and again in columns of numbers, instead of them, is a mark
    for no reading: "slack".
    """
    counts: Counter[str] = Counter()
    places: dict[str, set[int]] = {}
    numeric: Counter[int] = Counter()
    for row in sheet.rows[:_MOST_OF_SLACK]:
        kinds = [kind_of(cell) for cell in row[:MAX_COLUMNS]]
        numeric.update(j for j, kind in enumerate(kinds) if kind == NUMBER)
        if NUMBER in kinds[:2]:
            for j, kind in enumerate(kinds[1:], 1):
                if kind == TEXT:
                    word = str(row[j]).strip()
                    counts[word] += 1
                    places.setdefault(word, set()).add(j)
    often = [
        word
        for word, count in counts.items()
        if count >= _OFTEN and len(places[word]) > 1 and all(numeric[j] > 0 for j in places[word])
    ]
    if len(often) != 1:
        return sheet
    (word,) = often
    rows: list[list[Cell]] = [
        ["-" if j and isinstance(cell, str) and cell.strip() == word else cell for j, cell in enumerate(row)]
        if any(kind_of(cell) == NUMBER for cell in row[:2])
        else list(row)
        for row in sheet.rows
    ]
    said = f"'{word[:40]}' in {counts[word]} cells of numbers is read as no reading"
    return replace(sheet, rows=rows, messages=(*sheet.messages, said))


_MOST_OF_SLACK = 2000  # rows that are looked at


def without_notes(sheet: Sheet) -> Sheet:
    """A sheet without what stands beside its table, behind an empty column: notes, results of a few cells."""
    if sheet.bulk is not None or not sheet.rows:
        return sheet
    width = min(MAX_COLUMNS, max(len(row) for row in sheet.rows))
    filled = [any(c < len(row) and row[c] != "" for row in sheet.rows) for c in range(width)]
    empty = [c for c in range(1, width - 1) if not filled[c] and filled[c + 1]]
    for c in empty[-_GAP:]:
        sides = [[row[:c] for row in sheet.rows], [row[c + 1 :] for row in sheet.rows]]
        left, right = ([part for part in side if any(x != "" for x in part)] for side in sides)
        rows, beside = (sum(len(_kinds(part)[0]) > 1 for part in side) for side in (left, right))
        if rows >= _LABELS and beside < _LABELS and len(right) < _NOTES * len(left):
            notes = [
                Span(sheet.place(i), text)
                for i, row in enumerate(sheet.rows)
                if (text := sentence(row[c + 1 :]))
            ]
            return replace(sheet, rows=[row[:c] for row in sheet.rows], notes=tuple(notes))
    return sheet


def cornered(sheet: Sheet) -> Sheet:
    """A map whose axes are named in a line above, with these names in its corner."""
    for i, row in enumerate(sheet.rows[:60]):
        numbers = [j for j, c in enumerate(row) if kind_of(c) == NUMBER]
        corner = str(row[0]).strip() if row else ""
        if (
            len(numbers) < 2
            or 0 in numbers
            or numbers != list(range(1, len(row)))
            or i == 0
            or (corner and head_score(corner) < 2.0)
            or len([part for part in TRAILING.split(corner) if head_score(part.strip()) >= 2.0]) > 1
        ):
            continue
        below = sheet.rows[i + 1 : i + 3]
        if len(below) < 2 or any(kind_of(r[0] if r else "") != NUMBER or len(r) > len(row) for r in below):
            continue
        found: list[str] = []
        for above in sheet.rows[max(0, i - 3) : i]:
            found += [
                part
                for c in above
                if c != ""
                for part in re.split(
                    r"(?i)(?:,\s|\bcolumns?\s?:|\brows?\s?:|\bspalten\s?:|\bzeilen\s?:)", str(c)
                )
                if head_score(part.strip()) >= 3.0
            ]
        names = [*found, corner] if corner else found
        axes = [
            n.strip()
            for n in names
            if {c.value for c in head_claims(n.strip()[:200]) if c.facet == "channel"} - {"force"}
        ]
        values = [
            n.strip()
            for n in names
            if any(c.facet == "channel" and c.value == "force" for c in head_claims(n.strip()[:200]))
        ]
        if len(axes) == 2 and values:
            head: list[Cell] = [f"{axes[0]} / {axes[1]}", *row[1:]]
            title: list[Cell] = [values[0]]
            rows = [*sheet.rows[:i], title, head, *sheet.rows[i + 1 :]]
            lines = (
                *(sheet.line(j) for j in range(i)),
                sheet.line(i),
                *(sheet.line(j) for j in range(i, len(sheet.rows))),
            )
            return replace(sheet, rows=rows, lines=lines)
    return sheet


def _runs(sheet: Sheet) -> list[Run]:
    """The runs of a sheet; those of two rows where there is no longer one."""
    found: list[Run] = []
    current: Run | None = None
    gap: list[int] = []
    upto = 0
    for i, row in enumerate(sheet.rows):
        if i < upto:
            continue
        places, texts, first, marks = _kinds(row)
        is_data = len(places) >= 2 and texts <= len(places) and not _is_statistic(first)
        if is_data and first and gap and _is_statistic(_kinds(sheet.rows[gap[-1]])[2]):
            is_data = False  # one statistic beside another
        if (
            is_data
            and texts
            and current is not None
            and len(current.rows) > 2
            and len(places) < _INSIDE * len(current.columns)
        ):
            is_data = False
        if is_data and texts == len(places) and current is not None and len(current.rows) > 2 and first:
            is_data = _was_labelled(current)
        if is_data and first and gap and current is not None and not _was_labelled(current):
            words_above = any(any(c != "" for c in sheet.rows[g]) for g in gap)
            words_below = i + 1 < len(sheet.rows) and _kinds(sheet.rows[i + 1])[2] != ""
            is_data = not (words_above and words_below)  # the head of a next block
        if is_data and first and texts > 1 and texts == len(places):
            is_data = len({str(c) for c in row if kind_of(c) == TEXT}) > 1  # "Offset", 0, "Offset", 0
        if (
            not is_data
            and len(places) >= 1
            and (len(places) + marks >= 2 or (len(row) == 1 and not gap))
            and texts == 0
            and current is not None
        ):
            is_data = set(places) <= set(current.columns)
        if not is_data and current is not None and not gap and texts and _is_broken(sheet.rows, i):
            is_data = set(places) < set(current.columns)
        if not is_data and current is not None and _is_part_of_row(current, i):
            is_data = set(places) <= set(current.columns)
        if is_data and texts and first and current is None:
            is_data = _goes_on(sheet, i, places)
        if not is_data:
            if current is not None and (count := _page_head(current, i)):
                upto = i + count
                continue
            if current is not None:
                gap.append(i)
                filled = [c for c in row if c != ""]
                if len(gap) > _GAP or (len(filled) > 1 and texts > 1):
                    found.append(current)
                    current, gap = None, []
            continue
        if current is not None:
            inside = len(set(places) & set(current.columns)) >= _INSIDE * len(places)
            titled = any(_is_title(sheet.rows[g]) for g in gap)
            if not inside or titled:
                found.append(current)
                current = None
        if current is None:
            current = Run(sheet)
        current.remarks += [g for g in gap if any(c != "" for c in sheet.rows[g])]
        gap = []
        current.rows.append(i)
        if len(current.rows) < 50 or len(places) > len(current.columns):
            current.columns = sorted(set(current.columns) | set(places))
    if current is not None:
        found.append(current)
    long = [run for run in found if len(run.rows) >= 3]
    return long or [run for run in found if len(run.rows) >= 1 and len(run.columns) > 1]


_DIGITS = re.compile(r"[-+\d.,;|eE\s]+")


def _is_part_of_row(run: Run, i: int) -> bool:
    """Whether a line of a text right below a row of numbers is numbers as well: a row that breaks off, or is
    parted by other signs.
    """
    text = " ".join(str(c) for c in run.sheet.rows[i])
    below = len(run.rows) > 1 and run.rows[-1] == i - 1 and run.sheet.noun == "line"
    numbers = any(c.isdigit() for c in text) and _DIGITS.fullmatch(text) is not None
    return below and run.sheet.format == "csv" and numbers


def _page_head(run: Run, i: int) -> int:
    """Number of rows from a row on that stand above the run as well, where the first column counts on below
    them: the head of a page; 0 = there is none.
    """
    rows, first = run.sheet.rows, run.rows[0]
    for count in range(1, min(_LOOK, first, len(rows) - i - 1) + 1):
        if not all(_is_printed_again(rows[first - 1 - k], rows[i + count - 1 - k]) for k in range(count)):
            continue
        style = NumberStyle(run.sheet.decimal, run.sheet.thousands)
        counts = [rows[r][0] if rows[r] else "" for r in (*run.rows[-2:], i + count)]
        before, last, below = numbers_of([*[""] * (3 - len(counts)), *counts], style)[0]
        if last - before == below - last or (count == 1 and before < last < below):
            return count
    return 0


def _is_printed_again(row: Sequence[Cell], other: Sequence[Cell]) -> bool:
    """Whether two rows are the same but for numbers without a unit, as those of pages."""
    if list(row) == list(other):
        return True
    a, b = sentence(row), sentence(other)
    same = [(q.value, q.unit) for q in quantities(a)] == [(q.value, q.unit) for q in quantities(b)]
    return same and re.sub(r"\d+", "#", a) == re.sub(r"\d+", "#", b)


def _kinds(row: Sequence[Cell]) -> tuple[list[int], int, str, int]:
    """(places of the numbers, number of texts, the text before all numbers, number of marks for no
    reading).
    """
    places: list[int] = []
    texts = marks = 0
    first = ""
    for j, cell in enumerate(row[:MAX_COLUMNS]):
        if cell == "":
            continue
        kind = kind_of(cell)
        if kind in (NUMBER, CLOCK):
            places.append(j)
        elif kind == MARK:
            marks += 1
        elif kind == TEXT:
            texts += 1
            first = first or ("" if places else str(cell))
    return places, texts, first, marks


_DIGITS = re.compile(r"[-+.,'_]{0,3}[0-9][-+0-9.,;|'_xXeE\t ]{0,200}")


def _is_broken(rows: Sequence[Sequence[Cell]], i: int) -> bool:
    """Whether the texts of a row are broken readings: they are digits, or stand in the next or the last row
    too, where a footer says a word once.
    """
    texts = [cell if kind_of(cell) == TEXT else "" for cell in rows[i]]
    if all(_DIGITS.fullmatch(str(text)) for text in texts if text):
        return True
    beside = (rows[j] for j in (i - 1, i + 1) if 0 <= j < len(rows) and len(rows[j]) == len(texts))
    return any(texts == [cell if kind_of(cell) == TEXT else "" for cell in row] for row in beside)


def _was_labelled(run: Run) -> bool:
    """Whether the rows of a run so far begin with a text."""
    return _kinds(run.sheet.rows[run.rows[-1]])[2] != ""


def _is_statistic(text: str) -> bool:
    words = words_of(text[:60])
    return bool(words) and word_set("statistic").among((words[0], "".join(words[:2])))


def _is_title(row: Sequence[Cell]) -> bool:
    """Whether a row between others begins a new block: it names a quantity, or a run with its number."""
    text = " ".join(str(c) for c in row if c != "")[:MAX_TEXT]
    if not text or kind_of(text) in (NUMBER, CLOCK):
        return False
    return bool(quantities(text.replace("_", " "))) or without_run(f"x {text}")[1] != ""


def _goes_on(sheet: Sheet, i: int, places: list[int]) -> bool:
    """Whether the next rows have numbers at the same places: this one is a row of numbers with a label, or a
    map.
    """
    below = next((row for row in sheet.rows[i + 1 : i + 3] if any(c != "" for c in row)), [])
    at = {j for j, cell in enumerate(below) if kind_of(cell) in (NUMBER, CLOCK)}
    above = sheet.rows[i - 1] if i > 0 else []
    headed = sum(kind_of(c) == TEXT and c != "" for c in above) >= max(2, len(places))
    if len(at & set(places)) < len(places):
        return is_axis(sheet, i)
    return headed or is_axis(sheet, i) or kind_of(below[0] if below else "") == TEXT


def _head(run: Run, wanted: int | None) -> None:
    """Find the row of names, that of units and what else stands above; what is left is the title of the
    block.
    """
    rows = run.sheet.rows
    if is_axis(run.sheet, run.rows[0]):
        _titles(run, run.rows[0])
        return
    candidates = _candidates(run)
    units_at = next(
        (i for i in candidates if _unit_share(rows[i]) >= _UNITS_SHARE and not _names_with_units(rows[i])),
        None,
    )
    names = [i for i in candidates if i != units_at]
    if wanted is not None:
        names = [i for i in names if run.sheet.line(i) == wanted] or names
    if names and not run.heads:
        names = [i for i in names if not _is_row_of_values(rows[i])] or names
        names = [i for i in names if _can_name(run, rows[i])]
    if names and not run.heads:
        scored = {
            i: sum(head_score(_text(c)) for c in rows[i] if c != "") - 0.2 * k for k, i in enumerate(names)
        }
        best = max(scored, key=scored.__getitem__)
        width = range(min(MAX_COLUMNS, max(len(rows[r]) for r in (*run.rows[:50], best))))
        run.heads = {c: _text(rows[best][c]) if c < len(rows[best]) else "" for c in width}
        run.head_row = best
        _named_above(run, [i for i in names if i < best])
        own = {h.strip().casefold() for h in run.heads.values() if len(h.strip()) > 1}
        others = [
            i
            for i in candidates
            if i not in (best, units_at)
            and (
                _is_row_of_values(rows[i])
                or (i in names and _is_row_of_words(rows[i]) and _text(rows[i][0]).casefold() not in own)
            )
        ]
        run.more = {
            c: tuple(t for i in others if (t := _spanning(rows[i], c, carried=i < best))) for c in run.heads
        }
        if units_at is None:
            _second_row(run)
    elif names and run.head_row is None:
        run.head_row = names[0]
    run.above = list(candidates)
    if units_at is not None:
        run.units = {
            c: _text(rows[units_at][c]) for c in range(len(rows[units_at])) if rows[units_at][c] != ""
        }
        run.unit_row = units_at
        if not run.heads:
            run.head_row = units_at
    else:
        _labelled_units(run)
    _descriptions(run)
    _labelled_names(run)
    said = sum(_MOST_OF_A_HEAD if quantities(h) else head_score(h) for h in run.heads.values())
    if not run.described and said < _POOR_HEADS * len(run.columns):
        _listed_names(run)
    for i in range((run.head_row if run.head_row is not None else run.rows[0]) + 1, run.rows[0]):
        for c, head in run.heads.items():  # a cell below an empty head
            if not head and i != run.unit_row and c < len(rows[i]) and rows[i][c] != "":
                run.heads[c] = _text(rows[i][c])
    _completed(run)
    _shift_heads(run)
    _label_columns(run)
    if not run.described:
        _descriptions(run)
    _titles(run, min([run.rows[0], *run.above]))


def _named_above(run: Run, above: Sequence[int]) -> None:
    """Where a head is only a unit, the name stands in a row above it."""
    for c, head in list(run.heads.items()):
        cells = (_text(run.sheet.rows[i][c]) for i in above if c < len(run.sheet.rows[i]))
        name = next((t for t in cells if t and kind_of(t) == TEXT and unit_of(t) is None), "")
        named = any(claim.facet == "channel" for claim in head_claims(head))
        is_unit = head and unit_of(head) is not None and not named
        if name and is_unit:
            run.heads[c] = name
            if taken_apart(name).unit is None:
                run.units[c] = head


def _can_name(run: Run, row: Sequence[Cell]) -> bool:
    """Whether a row may hold the names of a run: it stands over half of its columns, or names a quantity."""
    over = sum(c < len(row) and row[c] != "" for c in run.columns)
    return 2 * over > len(run.columns) or any(head_score(_text(c)) > 0.0 for c in row if c != "")


def _is_note(rows: Sequence[Sequence[Cell]], i: int) -> bool:
    """Whether a row begins with the same word as the one above it, as the notes before a table do."""
    return i > 0 and kind_of(rows[i][0]) == TEXT and list(rows[i][:1]) == list(rows[i - 1][:1])


def _label_columns(run: Run) -> None:
    """Columns that have the labels of the rows above as their heads: "Name;p;Name;F" over "Unit;bar;Unit;N".
    They hold the time of the column beside.
    """
    cells = {c: (h, *run.more.get(c, ())) for c, h in run.heads.items() if c in run.columns}
    for c, labels in cells.items():
        if len(set(labels)) < _LABELS or sum(set(labels) == set(o) for o in cells.values()) < 2:
            continue
        units = [
            u for label in labels if (u := taken_apart(label).unit) is not None and u.dimension == "time"
        ]
        run.heads[c] = f"time [{units[0].name}]" if units else ""
        run.more.pop(c, None)
        run.units.pop(c, None)


def _names_with_units(row: Sequence[Cell]) -> bool:
    """Whether a row holds names with units: "Soll [bar]", and not units alone."""
    return any(
        unit_of(t) is None and taken_apart(t).unit is not None for c in row[:MAX_COLUMNS] if (t := _text(c))
    )


def _listed_names(run: Run) -> None:
    """Names of all columns in one line further above, where the heads themselves say nothing."""
    for i in range(run.rows[0] - 1, max(-1, run.rows[0] - _LOOK), -1):
        filled = [str(c) for c in run.sheet.rows[i] if c != ""]
        listed = len(filled) == len(run.columns) and _LISTED.match(filled[0]) is not None
        if len(filled) > 1 and (i in run.above or not listed):
            continue
        text = ";".join(filled)
        below = [str(c) for c in run.sheet.rows[i + 1] if c != ""]
        goes_on = text.rstrip().endswith(",") and len(below) == 1 and i + 1 < run.rows[0]
        names = _split_head(f"{text} {below[0]}" if goes_on else text, len(run.columns))
        if names and sum(head_score(n) for n in names) > sum(head_score(h) for h in run.heads.values()):
            run.heads = dict(zip(run.columns, names, strict=True))
            return


def _completed(run: Run) -> None:
    """Heads with the number of their channel from a row beside, and names where the best row has none."""
    for c, head in run.heads.items():
        for other in run.more.get(c, ()):
            if head_score(head) <= 0.0 and head_score(other) >= 2.0:
                run.heads[c] = other
                if unit_of(head) is not None:
                    run.units.setdefault(c, head)
            elif re.fullmatch(r"(?i)(?:ch|ai|chan|channel|kanal)[ _]?\d{1,2}", other) and other not in head:
                if unit_of(head) is not None:
                    run.units.setdefault(c, head)
                run.heads[c] = other if unit_of(head) is not None else f"{other} {head}"


def _shift_heads(run: Run) -> None:
    """Names that are one fewer than the columns, of which the first numbers the rows: they belong to the
    others.
    """
    filled = [c for c, h in run.heads.items() if h]
    rows = run.sheet.rows
    if run.units or len(run.columns) < 3 or filled != list(range(len(filled))) or run.head_row is None:
        return
    width = max(len([c for c in rows[r] if c != ""]) for r in run.rows[:3])
    if len(filled) != width - 1 or len(rows[run.head_row]) >= width:
        return
    first = [str(rows[r][0]).strip('"') for r in run.rows[:5]]
    if all(text.isdigit() and int(text) == int(first[0]) + k for k, text in enumerate(first)):
        run.heads = {0: "No.", **{c + 1: h for c, h in run.heads.items() if h}}


_HELD_CELL = re.compile(r"[^\W\d_]{0,12}0?\s?[=:@]?\s?[-+]?\d{1,7}(?:[.,]\d{1,6})?\s?[^\W\d_%]{0,5}%?")


def _is_row_of_values(row: Sequence[Cell]) -> bool:
    """Whether the cells of a row name values, "p = 0.2 MPa", and no columns."""
    filled = [str(c).strip() for c in row if c != ""]
    values = [c for c in filled if _HELD_CELL.fullmatch(c) and ("=" in c or "@" in c or quantities(c))]
    return len(filled) > 1 and len(values) > 0.5 * len(filled)


def _is_statement(row: Sequence[Cell]) -> bool:
    """Whether the cells of a row are a name, its value and its unit: "Muskellänge", "237,5", "mm"."""
    filled = [c for c in row if c != ""]
    return (
        [kind_of(c) for c in filled] == [TEXT, NUMBER, TEXT]
        and unit_of(str(filled[0])) is None
        and unit_of(str(filled[2])) is not None
    )


def _second_row(run: Run) -> None:
    """A row of units and of names with units below the heads: "Druck" over "Soll [bar]" and "Ist [bar]"."""
    rows = run.sheet.rows
    if run.head_row is None:
        return
    below = [i for i in range(run.head_row + 1, run.rows[0]) if any(c != "" for c in rows[i])]
    if len(below) != 1:
        return
    cells = {c: _text(cell) for c, cell in enumerate(rows[below[0]]) if cell != ""}
    with_unit = [
        c for c, text in cells.items() if unit_of(text) is not None or taken_apart(text).unit is not None
    ]
    if len(with_unit) < max(2, _UNITS_SHARE * len(cells)):
        return
    for c, text in cells.items():
        name = _spanning(rows[run.head_row], c, carried=True)
        if unit_of(text) is not None:
            run.units[c] = text
        run.heads[c] = name if unit_of(text) is not None else f"{name} {text}".strip()
    run.more = {}


def _candidates(run: Run) -> list[int]:
    """Rows right above a run that can be its heads, from below."""
    rows = run.sheet.rows
    found: list[int] = []
    i = run.rows[0] - 1
    while i >= 0 and len(found) < _ABOVE and run.rows[0] - i <= _ABOVE + 1:
        filled = [c for c in rows[i] if c != ""]
        if found and filled and _is_note(rows, i):
            break
        if not filled:
            if found:
                break
        elif (
            len(filled) >= max(2, _HEAD_SHARE * len(run.columns))
            and not _is_numeric(rows[i])
            and not _is_statement(rows[i])
        ):
            found.append(i)
        elif found:
            if (
                len(filled) >= 2
                and not _is_numeric(rows[i])
                and not _is_row_of_values(rows[i])
                and not any(quantities(str(c)) for c in filled)
                and len(found) == 1
            ):
                found.append(i)  # a row of groups above the heads
            break
        elif split := _split_head(str(filled[0]), len(run.columns)) if len(filled) == 1 else []:
            run.heads = dict(zip(run.columns, split, strict=True))
            run.head_row = i
            found.append(i)
        elif run.rows[0] - i > 2:
            break
        i -= 1
    return found


def _split_head(text: str, width: int) -> list[str]:
    """The names of columns in one cell: parted by signs, wide gaps or blanks, brackets kept with their
    name.
    """
    bare = re.sub(r"^[\s#%/!;*]+", "", text)
    bare = _LISTED.sub("", bare)
    ways = [re.split(r"\s?[,;\t|]\s?", bare), re.split(r"\s{2,}|\t", bare), _joined_units(bare.split())]
    for k, cells in enumerate(ways):
        cells = [_AND.sub("", cell.strip().strip('".')) for cell in cells if cell.strip()]
        if any(kind_of(cell) in (NUMBER, CLOCK) for cell in cells):
            continue
        least = max(2, 0.5 * width if k == len(ways) - 1 else 0)  # a sentence has blanks as well
        if len(cells) == width and sum(head_score(cell) > 0 for cell in cells) >= min(least, width):
            return cells
    return []


_LISTED = re.compile(  # "The four columns are:"
    r"(?i)^(?:[\w ]{0,30}(?<!\w))?(?:columns?|spalten?|colonnes?|fields?|header|legende?|units)"
    r"(?: \w{1,9})?\s?:\s?"
)
_AND = re.compile(r"(?i)^(?:and|und|et|e|y|en)\s+")


def _joined_units(cells: Sequence[str]) -> list[str]:
    """Words with the unit in brackets that follows them."""
    found: list[str] = []
    for cell in cells:
        if found and cell[:1] in "[(" and unit_of(cell) is not None:
            found[-1] += f" {cell}"
        else:
            found.append(cell)
    return found


def _is_row_of_words(row: Sequence[Cell]) -> bool:
    """Whether a row above the heads groups or describes columns: no sentences, no name and value."""
    texts = [str(c) for c in row if c != ""]
    named = sum(kind_of(c) == TEXT for c in texts)
    return (named > 1 or named == len(texts)) and all(
        len(t) <= _LONGEST_WORDS and not re.search(r"[:=]", t) for t in texts
    )


def _spanning(row: Sequence[Cell], place: int, *, carried: bool) -> str:
    """What stands over a column; a text over several of them stands over the first of these."""
    if place < len(row) and row[place] != "":
        return _text(row[place])
    if not carried:
        return ""
    return next((_text(row[j]) for j in range(min(place, len(row) - 1), -1, -1) if row[j] != ""), "")


def _text(cell: Cell) -> str:
    """A cell of the head as a text, without what marks a comment."""
    if isinstance(cell, float):
        return f"{cell:g}"
    text = str(cell)[:_LONGEST_HEAD].strip().strip('"')
    return text if text == "%" else text.lstrip("#%! ").strip()


def _is_numeric(row: Sequence[Cell]) -> bool:
    kinds = [kind for cell in row if cell != "" and (kind := kind_of(cell)) != EMPTY]
    return sum(kind in (NUMBER, CLOCK) for kind in kinds) > 0.5 * len(kinds)


def _unit_share(row: Sequence[Cell]) -> float:
    filled = [
        str(c).lstrip("#% ") for c in row if c != "" and str(c).lower() not in ("n.", "nr.", "no.", "#")
    ]
    good = sum(unit_of(c) is not None and not (len(c) > 3 and head_score(c) >= 2.0) for c in filled)
    return good / len(filled) if len(filled) > 1 else 0.0


def _labelled_units(run: Run) -> None:
    """A row further above that begins with the word for units, and has one for each column."""
    rows = run.sheet.rows
    for i in range(run.rows[0] - 1, max(-1, run.rows[0] - _LOOK), -1):
        cells = [c for c in rows[i] if c != ""]
        if len(cells) > 2 and "horizontal" in words_of(str(cells[0])[:40]):
            continue
        if (
            len(cells) > 2
            and word_set("unit").among(words_of(str(cells[0])[:40]))
            and _unit_share(cells[1:]) >= _UNITS_SHARE
        ):
            shift = 1 if run.columns and run.columns[0] == 0 and len(cells) - 1 < len(run.columns) else 0
            run.units = {c: _text(u) for c, u in zip(run.columns[shift:], cells[1:], strict=False)}
            run.unit_row = i
            return


def _labelled_names(run: Run) -> None:
    """A row further above that begins with a word for names, and has one text for each column or for all but
    the first: it describes them.
    """
    rows = run.sheet.rows
    for i in range(run.rows[0] - 1, max(-1, run.rows[0] - _LOOK), -1):
        cells = [_text(c) for c in rows[i] if c != ""]
        missing = len(run.columns) - len(cells) + 1
        if (
            i not in run.above
            and len(cells) > 2
            and missing in (0, 1)
            and word_set("name_row").among(words_of(cells[0][:40])[:1])
            and any(head_score(c[:200]) > 0.0 for c in cells[1:])
        ):
            for c, text in zip(run.columns[missing:], cells[1:], strict=True):
                run.described[c] = (*run.described.get(c, ()), Span(run.sheet.place(i), text))
            return


def _descriptions(run: Run) -> None:
    """Rows above that begin with the name of a column describe it."""
    rows = run.sheet.rows
    places = {h.casefold(): c for c, h in run.heads.items() if len(h) > 1 or h.isalpha()}
    names = {taken_apart(h).name.casefold() or h: c for h, c in places.items()}
    for i in range(max(0, run.rows[0] - _LOOK), run.rows[0]):
        if i in run.above or not rows[i]:
            continue
        place = places.get(_text(rows[i][0]).rstrip(":= ").casefold())
        if place is None:
            key, _, rest = sentence(rows[i]).lstrip("#%/;' ").partition(":")
            place = names.get(key.strip().casefold())
            if place is not None and len(rest) < _LONGEST_HEAD and not _QUANTITY.fullmatch(rest):
                said = Span(run.sheet.place(i), rest.strip())
                run.described[place] = (*run.described.get(place, ()), said)
            continue
        cells = [_text(c) for c in rows[i][1:] if c != ""]
        unit = next((c for c in reversed(cells) if unit_of(c) is not None and not c.isdigit()), "")
        if unit:
            run.units.setdefault(place, unit)
        said = (Span(run.sheet.place(i), cell) for cell in cells)
        run.described[place] = (*run.described.get(place, ()), *said)


def _titles(run: Run, top: int) -> None:
    """The texts right above the heads of a run."""
    rows = run.sheet.rows
    for i in range(run.rows[0] - 1, max(-1, top - 4), -1):
        filled = [str(c) for c in rows[i] if c != ""]
        if i in run.above or not filled:
            continue
        if _is_numeric(rows[i]) or len(run.title) > 1 or (run.title and i < top - 1):
            break
        run.title.append(Span(run.sheet.place(i), sentence(rows[i])))


def sentence(row: Sequence[Cell]) -> str:
    """The cells of a row as one text: ``Ruhelänge: 250 mm; Muskel: DMSP-20``."""
    text = ""
    before = EMPTY
    filled = [cell for cell in row if cell != ""]
    named = len(filled) == 2 and key_of(str(filled[0])[:40].strip("#: "))[0] in ("kind", *TEXT_CONDITIONS)
    for cell in row:
        if cell == "":
            continue
        shown = f"{cell:.12g}" if isinstance(cell, float) else str(cell).strip()
        kind = kind_of(cell)
        if not text:
            text = shown
        elif before == NUMBER and kind == TEXT and unit_of(shown) is not None:
            text += f" {shown}"
        elif text.endswith(":") or (
            before == TEXT
            and (named or kind == NUMBER or shown[:1].isdigit())
            and not text.endswith(("=", ":"))
        ):
            text += f": {shown}" if not text.endswith(":") else f" {shown}"
        else:
            text += f"; {shown}"
        before = kind
        if len(text) > MAX_TEXT:
            break
    return text[:MAX_TEXT]


def _texts(sheets: Sequence[Sheet], used: set[tuple[int, int]]) -> list[Span]:
    """All rows that belong to no run, as texts."""
    found: list[Span] = []
    for sheet in sheets:
        for i, row in enumerate(sheet.rows):
            if len(found) > MAX_TEXTS:  # one more, to be told
                return found
            if (id(sheet), i) not in used and (text := sentence(row)):
                found.append(Span(sheet.place(i), text))
    return found


def all_texts(sheets: Sequence[Sheet]) -> list[Span]:
    """All that sheets without a table hold, as texts."""
    return [text for sheet in sheets for text in sheet.texts] + _texts(sheets, set())


def _shown(sheet: Sheet, head: int | None) -> tuple[tuple[int, tuple[str, ...]], ...]:
    """The rows that are shown: the first ones, and those about a head further down."""
    last = max(_SHOWN_ROWS, (head or 0) + _SHOWN_BELOW)
    gap = (
        range(_SHOWN_ROWS - _SHOWN_BELOW - _SHOWN_ABOVE, (head or 0) - _SHOWN_ABOVE)
        if last > _SHOWN_ROWS
        else range(0)
    )
    return tuple(
        (
            sheet.line(i),
            tuple(
                ("" if c == "" else f"{c:g}" if isinstance(c, float) else str(c))[:_SHOWN_LENGTH]
                for c in row[:_SHOWN_CELLS]
            ),
        )
        for i, row in enumerate(sheet.rows[:last])
        if i not in gap
    )


def _of_named(named: Sequence[Sheet], sheets: Sequence[Sheet], name: str) -> Table:
    """The best of the tables whose columns the file names itself, with those that are alike."""
    tables: list[tuple[Sheet, list[Column]]] = []
    for sheet in named:
        said: dict[str, list[Span]] = {}  # "L_m: length between the clamps"
        for span in sheet.texts:
            key, _, rest = span.text.partition(": ")
            if rest and not _QUANTITY.fullmatch(rest):
                said.setdefault(key, []).append(Span(span.where, rest))
        columns = [
            column
            for head, values in (sheet.arrays or {}).items()
            if (
                column := column_of(
                    values if isinstance(values, np.ndarray) else list(values),
                    head=head,
                    unit=sheet.units.get(head, ""),
                    sheet=sheet,
                    where=f"{sheet.noun} '{head}'",
                    described=tuple(said.get(head, ())),
                )
            )
            is not None
        ]
        if columns:
            tables.append((sheet, columns))
    dropped = tuple((k, why) for sheet in named for k, why in sheet.dropped)
    most = max((len(t[0].values) for _, t in tables), default=0)
    if most > MAX_ROWS:
        raise InputError(f"{name}: it has {most} rows, at most {MAX_ROWS} are read", field="rows", hint=SPLIT)
    if not tables:
        if dropped:
            noun = named[0].noun
            why = "; ".join(f"{noun} '{k}': {why}" for k, why in dropped[:3])
            raise InputError(
                f"{name}: no array of numbers: {why}",
                field=f"{noun} {dropped[0][0]}",
                hint=_HINT,
            )
        raise InputError(f"{name}: no arrays of numbers of one length", field="file", hint=_HINT)

    def score(item: tuple[Sheet, list[Column]]) -> float:
        known = sum(min(_MOST_OF_A_HEAD, head_score(c.head, c.unit)) for c in item[1])
        return (_EMPTY_HEADS + known) * len(item[1][0].values) ** 0.5

    best_sheet, best = max(tables, key=score)
    heads = [(c.head, c.unit) for c in best]
    alike = [(s, t) for s, t in tables if [(c.head, c.unit) for c in t] == heads]
    unread = [
        (f"{s.name}/{c.head}".lstrip("/"), "it is in another table")
        for s, t in tables
        if (s, t) not in alike
        for c in t
    ]
    unread += [lost for s, _ in tables if s is not best_sheet for lost in s.dropped]
    parts = [
        Part(tuple(t), (*s.texts, Span(s.name, s.name)), np.arange(1, len(t[0].values) + 1)) for s, t in alike
    ]
    texts = list(dict.fromkeys(t for s in sheets for t in s.texts))
    read = {s.name for s, _ in alike}
    titles = tuple((s.name, s.name in read) for s, _ in tables if s.name)
    rivals = ()
    if len(alike) == 1:
        close = [
            s for s, t in tables if s is not best_sheet and s.name and _claimed(t) >= max(2, _claimed(best))
        ]
        rivals = tuple((s.name, "") for s in (best_sheet, *close)) if close else ()
    heads_read = {c.head for c in best}
    empty = [
        (head, "it holds no finite number") for head in best_sheet.arrays or {} if head not in heads_read
    ]
    where = f"{name}, {best_sheet.noun} '{best_sheet.name}'" if best_sheet.name and len(alike) == 1 else name
    return replace(
        stacked(parts, texts),
        where=where,
        noun=best_sheet.noun,
        format=best_sheet.format,
        others=tuple(unread),
        tables=titles,
        rivals=rivals,
        messages=(*(m for s in sheets for m in s.messages), *_as_runs([s.name for s, _ in alike])),
        dropped=(*best_sheet.dropped, *empty),
    )


def _as_runs(places: Sequence[str]) -> list[str]:
    """What is said of tables with the same columns that are read one after another."""
    if len(places) < 2:
        return []
    shown = ", ".join(repr(place) for place in places[:4]) + (", ..." if len(places) > 4 else "")
    return [f"{len(places)} tables with the same columns are read as runs: {shown}"]


def _claimed(columns: Sequence[Column]) -> int:
    found = {
        c.value
        for column in columns
        for c in head_claims(column.head, column.unit)
        if c.facet == "channel" and not _is_raw(column)
    }
    return len(found - {"group", "direction"})


def _is_raw(column: Column) -> bool:
    unit = taken_apart(column.head, column.unit).unit
    return unit is not None and unit.dimension in RAW
