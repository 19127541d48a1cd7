"""The refusal of a file that leaves something open, and the words that answer it on the command line."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.measurement.question import Question
from mckibben.physics.errors import InputError

__all__ = ["Question", "column_option", "ignore_option", "refusal"]


def refusal(name: str, questions: Sequence[Question], *, strict: bool = False) -> InputError | None:
    """The refusal of a file whose questions have no answer; None when all of them can wait.

    ``strict``: none of them can.
    """
    open_ones = [question for question in questions if question.stops or strict]
    if not open_ones:
        return None
    first = open_ones[0]
    asked = "; ".join(f"{question.text}: {question.option}" for question in open_ones)
    field = first.about if first.column is None else f"column {first.column}"
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
