"""The tables of an SQLite data base as sheets of cells; nothing of it is executed."""

from __future__ import annotations

import sqlite3
from typing import Any

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.limits import MAX_UNPACKED, WORD, Allowance, check_columns
from mckibben.measurement.read.source import RawTable
from mckibben.physics.errors import InputError

_MOST_TABLES = 20
_MOST_ROWS = 1_000_000
_MOST_CELLS = 8_000_000
_LONGEST_TEXT = 1000  # characters
_ALLOWED = (sqlite3.SQLITE_SELECT, sqlite3.SQLITE_READ)


def open_sqlite(data: bytes, name: str, correction: Correction | None = None) -> RawTable:
    """The table of a data base with most channels; other tables say what the test was.

    Raises:
        InputError: damaged, too large, or without a table of readings.
    """
    from mckibben.measurement.read.xlsx import open_sheets

    if len(data) > MAX_UNPACKED:
        raise _refused(name, "the database is larger than can be read", "export the table as CSV")
    base = sqlite3.connect(":memory:")
    try:
        base.deserialize(data)
        base.execute("PRAGMA trusted_schema = OFF")
        found = base.execute("SELECT name, sql FROM sqlite_master WHERE type = 'table'").fetchall()
        tables = [
            str(title)
            for title, sql in found
            if not str(title).startswith("sqlite_") and "virtual" not in str(sql).lower()[:40]
        ]
        base.set_authorizer(
            lambda action, *_: sqlite3.SQLITE_OK if action in _ALLOWED else sqlite3.SQLITE_DENY
        )
        allowance = Allowance(name, len(data))
        sheets = [
            (title[:40], rows)
            for title in tables[:_MOST_TABLES]
            if (rows := _rows(base, title, name, allowance))
        ]
    except (sqlite3.Error, UnicodeDecodeError) as error:
        raise _refused(name, f"the database is damaged ({error})", "export the table as CSV") from error
    finally:
        base.close()
    if not sheets:
        raise _refused(name, "the database holds no table with rows", "export the table as CSV")
    return open_sheets(sheets, name, correction)


def _rows(
    base: sqlite3.Connection, title: str, name: str, allowance: Allowance
) -> list[tuple[int, tuple[Cell, ...]]]:
    """The names of the columns, and the rows below them."""
    quoted = title.replace('"', '""')
    cursor = base.execute(f'SELECT * FROM "{quoted}" LIMIT {_MOST_ROWS + 1}')
    heads = tuple(str(column[0])[:120] for column in cursor.description)
    check_columns(len(heads), f"{name}, table '{title[:40]}'", "columns")
    rows: list[tuple[int, tuple[Cell, ...]]] = []
    for number, row in enumerate(cursor, start=2):
        if number > _MOST_ROWS or number * len(heads) > _MOST_CELLS:
            why = f"its table '{title[:40]}' has more than {_MOST_ROWS} rows or {_MOST_CELLS} cells"
            raise _refused(name, why, "export a part of it as CSV")
        cells = tuple(map(_plain, row))
        long = sum(len(cell) for cell in cells if isinstance(cell, str) and len(cell) > WORD)
        if long:
            allowance.take(long, f"table '{title[:40]}'")
        rows.append((number, cells))
    return [(1, heads), *rows] if rows else []


def _plain(value: Any) -> Cell:
    if value is None or isinstance(value, (int, float)):
        return value
    return str(value)[:_LONGEST_TEXT] if isinstance(value, str) else None


def _refused(name: str, why: str, hint: str) -> InputError:
    return InputError(f"{name}: no column can be read: {why}", field="file", hint=hint)
