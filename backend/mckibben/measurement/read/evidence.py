"""What has been read of a file when it is asked what it leaves open."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.cells import Labels
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.header import Meaning
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.values import NUMBER, TEXT, kind_of

Array = NDArray[np.float64]


class Evidence(NamedTuple):
    """What has been read when questions are asked.

    Attributes:
        headers: of all columns; ``apart``: their units in a row of their own.
        meaning: which columns are used.
        used: channel -> its column.
        channels: channel -> values [SI]; of long tests a choice, for time rows that follow each
            other.
        numeric: whether a column that is not used holds numbers.
        pair: the numbers of two columns, row by row, None where they have none.
        labels: index of a column of words -> its words.
        conditions: of the test.
        choices: other tables of the file (option, columns).
        by_clock: the times are times of the day, whose unit nobody has to ask for.
        weighed: the force is that of stated weights, and was not read.
    """

    headers: Sequence[str]
    apart: Sequence[str | None]
    meaning: Meaning
    used: Mapping[str, HeaderColumn]
    channels: Mapping[str, Array]
    numeric: Callable[[int], bool]
    pair: Callable[[int, int], tuple[Array, Array] | None]
    labels: Mapping[int, Labels]
    conditions: Mapping[str, float | str]
    choices: Sequence[tuple[str, str]]
    noun: str = "column"
    by_clock: bool = False
    weighed: bool = False


def bare_name(column: HeaderColumn) -> str:
    """The name of a column as an option takes it: without its unit."""
    return taken_apart(column.header).name or column.header


def is_numeric(sample: Sequence[Sequence[str]], index: int) -> bool:
    """Whether a column holds numbers in the first rows."""
    kinds = [kind_of(row[index]) for row in sample if index < len(row)]
    return NUMBER in kinds and TEXT not in kinds
