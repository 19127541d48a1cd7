"""Columns that follow from others: a force from a torque and its lever, row by row; a stroke from an angle
and a radius.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mckibben.measurement.reading.evidence import stated_marks
from mckibben.measurement.reading.heads import head_claims, taken_apart
from mckibben.measurement.reading.model import Column, Table
from mckibben.measurement.reading.shapes import mark_gap
from mckibben.measurement.reading.units import Unit, quantity_si

_FEW = 0.3  # share of the rows that may be lost


def without_stated_marks(table: Table) -> Table:
    """A table without the numbers that its texts say to stand for a lost reading."""
    marks = stated_marks(table)
    if not marks:
        return table
    columns = []
    for column in table.columns:
        here = np.isin(column.values, [mark for mark, _ in marks])
        if column.words is None and here.any() and not here.all() and np.mean(here) < _FEW:
            gaps = {int(r): mark_gap(column.values[r]) for r in np.flatnonzero(here)}
            column = replace(
                column, values=np.where(here, np.nan, column.values), gaps={**column.gaps, **gaps}
            )
        columns.append(column)
    return replace(table, columns=tuple(columns))


def with_derived(table: Table) -> Table:
    """A table with a force, where it holds a torque and the lever it acts on, and no force."""
    units = [taken_apart(c.head, c.unit).unit for c in table.columns]
    if any(u is not None and u.dimension == "force" for u in units):
        return table
    torque = _only(table.columns, units, "torque", None)
    lever = _only(table.columns, units, "length", "lever")
    if torque is None or lever is None:
        return table
    t, a = table.columns[torque], table.columns[lever]
    moment, arm = (
        c.values * quantity_si(1.0, u.name, si)
        for c, u, si in ((t, units[torque], "N*m"), (a, units[lever], "m"))
        if u
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        force = np.where(arm != 0.0, moment / arm, np.nan)
    made = Column(
        "force [N]",
        force,
        f"{t.where} over {a.where}",
        gaps={**t.gaps, **a.gaps},
        key=f"force = {t.title} / {a.title}",
    )
    message = f"force is {t.title} over {a.title}, row by row"
    return replace(table, columns=(*table.columns, made), messages=(*table.messages, message))


def _only(
    columns: Sequence[Column], units: Sequence[Unit | None], dimension: str, channel: str | None
) -> int | None:
    """The one column of numbers in a unit, with a channel of that name; None = there is none, or several."""
    found = [
        i
        for i, (c, u) in enumerate(zip(columns, units, strict=True))
        if c.words is None
        and u is not None
        and u.dimension == dimension
        and (
            channel is None
            or any(x.facet == "channel" and x.value == channel for x in head_claims(c.head[:200], c.unit))
        )
    ]
    return found[0] if len(found) == 1 else None
