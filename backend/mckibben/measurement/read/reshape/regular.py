"""Which way of writing a table a grid shows, and the grid as columns below a head."""

from __future__ import annotations

from typing import NamedTuple

from mckibben.measurement.read.grid import Grid
from mckibben.measurement.read.reshape.deviations import without_deviations
from mckibben.measurement.read.reshape.labelled import without_labels
from mckibben.measurement.read.reshape.tall import pivoted
from mckibben.measurement.read.reshape.transposed import transposed
from mckibben.measurement.read.reshape.united import without_units


class Regular(NamedTuple):
    """A grid of columns below a head, what was done to it, texts that left it, columns that are not read."""

    grid: Grid
    messages: list[str]
    unread: list[tuple[str, str]]
    rewritten: bool


def regular(grid: Grid) -> Regular:
    """The grid, rewritten where it shows another way of writing a table."""
    messages: list[str] = []
    unread: list[tuple[str, str]] = []
    rewritten = False
    for rewrite in (transposed, without_labels, pivoted, without_deviations, without_units):
        found = rewrite(grid)
        if found is not None:
            grid, said, left = found
            messages += said
            unread += left
            rewritten = True
    return Regular(grid, messages, unread, rewritten)
