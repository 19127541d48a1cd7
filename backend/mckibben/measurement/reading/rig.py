"""What the files of one test say for each other: one rig has one sign, one reference and one scale of each
sensor, and notes beside the readings are texts of all of them.
"""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.measurement.measurement import RigText
from mckibben.measurement.reading.containers import sheets_of
from mckibben.measurement.reading.correction import Correction, Note
from mckibben.measurement.reading.layout import NO_TABLE, all_texts, table_of
from mckibben.measurement.reading.model import FILE, Evidence, Table
from mckibben.physics.errors import InputError

_OF_A_RIG = frozenset({"absolute", "sign_force", "sign_stroke", "scale"})
_MOST = 40  # texts that one file says for others


def rig_texts(table: Table, evidence: Sequence[Evidence]) -> tuple[RigText, ...]:
    """The texts beside a table that say how its sensors count."""
    texts = set(table.texts)
    return tuple(
        dict.fromkeys(
            RigText(
                e.facet,
                "" if e.target == FILE else table.columns[e.target].title,
                e.span.where,
                e.span.text,
            )
            for e in evidence
            if e.facet in _OF_A_RIG and e.target >= FILE and e.span in texts
        )
    )[:_MOST]


def heads_of(table: Table) -> tuple[str, ...]:
    """The names of the columns of a table, by which files of one rig are known."""
    return tuple(column.title for column in table.columns)


def heads_in(data: bytes, name: str, correction: Correction) -> tuple[str, ...]:
    """The names of the columns of a file; () = it holds no table."""
    try:
        return heads_of(table_of(sheets_of(data, name), name, wanted=correction.sheet, head=correction.head))
    except InputError:
        return ()


def notes_in(data: bytes, name: str) -> tuple[Note, ...]:
    """The texts of a file that holds no table of readings, nor a row that could be the head of one; () = it
    does, or holds no text.

    Raises:
        InputError: the file cannot be taken apart.
    """
    sheets = sheets_of(data, name)
    try:
        table_of(sheets, name)
    except InputError as error:
        if error.field != NO_TABLE:
            return ()
        return tuple(Note(f"{name}, {span.where}", span.text) for span in all_texts(sheets)[:_MOST])
    return ()
