"""The refusal of a file that leaves something open, and the words that answer it on the command line."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from mckibben.measurement.question import Question
from mckibben.physics.errors import InputError

__all__ = ["DISMISSED", "ColumnSaid", "Question", "column_option", "columns_said", "ignore_option", "refusal"]

#: Why nothing is read from a column that the file itself says is none.
DISMISSED = "the file says that it is no channel"
_SAID = re.compile(
    r'--ignore "(?P<ignored>.*)"'
    r'|--column "(?P<channel>\w+)=(?P<minus>-?)(?P<column>.*?)(?: \[(?P<unit>[^\]]*)\])?"'
)


class ColumnSaid(NamedTuple):
    """What an answer says of a column: its channel (None: it is left out), unit, whether its sign turns."""

    column: str
    channel: str | None
    unit: str | None = None
    turned: bool = False


def refusal(name: str, questions: Sequence[Question], *, strict: bool = False) -> InputError | None:
    """The refusal of a file whose questions have no answer; None when all of them can wait.

    ``strict``: none of them can.
    """
    open_ones = [question for question in questions if question.stops or strict]
    if not open_ones:
        return None
    first = open_ones[0]
    asked = "; ".join(f"{question.text}: {question.option}" for question in open_ones)
    field = first.about.removeprefix("held ") if first.column is None else f"column {first.column}"
    if first.column is not None and field not in asked.replace("'", ""):
        field = first.column
    return InputError(
        f"{name}: {asked}",
        field=field,
        hint="answer all of them" if len(open_ones) > 1 else "answer it so",
    )


def column_option(channel: str, column: str, unit: str | None = None, *, sign: int = 1) -> str:
    """``--column "force=-Kraft [kN]"``."""
    minus = "-" if sign < 0 else ""
    return f'--column "{channel}={minus}{column}{f" [{unit}]" if unit else ""}"'


def ignore_option(column: str) -> str:
    """``--ignore "Traverse"``."""
    return f'--ignore "{column}"'


def columns_said(option: str) -> list[ColumnSaid]:
    """What the alternatives of an option say of columns, each; those about something else are left out.

    >>> [tuple(said) for said in columns_said('--ignore "F2" or --column "force=-Kraft [kN]"')]
    [('F2', None, None, False), ('Kraft', 'force', 'kN', True)]
    """
    found = (_SAID.fullmatch(each.strip()) for each in re.split(r" or (?=--)", option))
    return [
        ColumnSaid(said["column"], said["channel"], said["unit"] or None, bool(said["minus"]))
        if said["ignored"] is None
        else ColumnSaid(said["ignored"], None)
        for said in found
        if said is not None
    ]
