"""Why nothing is read from a column: a reason for the program, and its text for people."""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple


class Reason(Enum):
    """What a column is instead of a channel, or what keeps it from being one."""

    UNKNOWN = "unknown"  # neither name nor unit tells what it is
    RAW = "raw"  # volts, milliamperes: it may be any channel before calibration
    COUNTS = "counts"
    SEVERAL = "several"  # its words name several channels
    UNFIT = "unfit"  # its unit is none of the channel that its name says
    VALUE = "a value"
    SET_VALUE = "a set value"
    SUPPLY = "the supply"
    AIR = "the surrounding air"
    AT_REST = "a length at rest"
    PRELOAD = "a preload"
    DEVIATION = "a deviation"
    TUBE_SIZE = "a size of the tube"
    NUMBER = "a running number"
    REMARK = "a remark"
    CONDITION = "a condition"
    RIVAL = "rival"  # the channel is read from another column
    DISMISSED = "dismissed"  # the user, or the file itself, does not want it


#: Reasons that a word of the name gives: the column is something else.
OF_WORDS = frozenset((
    Reason.SET_VALUE, Reason.SUPPLY, Reason.AIR, Reason.AT_REST, Reason.PRELOAD, Reason.DEVIATION,
    Reason.TUBE_SIZE, Reason.NUMBER, Reason.REMARK,
))  # fmt: skip
#: Reasons for good; the column is neither asked about nor proposed.
FINAL = frozenset((
    Reason.CONDITION, Reason.SUPPLY, Reason.AIR, Reason.AT_REST, Reason.TUBE_SIZE, Reason.PRELOAD,
    Reason.DEVIATION, Reason.DISMISSED,
))  # fmt: skip


class LeftOut(NamedTuple):
    """Why nothing is read from a column."""

    reason: Reason
    text: str


UNKNOWN = LeftOut(Reason.UNKNOWN, "its name is not known")
DISMISSED = LeftOut(Reason.DISMISSED, "you do not want it")
UNWANTED = LeftOut(Reason.DISMISSED, "the file says that it is no channel")


def by_word(reason: Reason) -> LeftOut:
    """A column that a word of its name makes something else.

    >>> by_word(Reason.SUPPLY).text
    'it is the supply'
    """
    return LeftOut(reason, f"it is {reason.value}")
