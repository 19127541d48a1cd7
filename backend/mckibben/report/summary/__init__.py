"""Results as short tables and sentences, for terminals, notebooks and anything else that shows text."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from mckibben.facts.comparison import PARAMETER
from mckibben.facts.figure import Figure
from mckibben.facts.units import Scale
from mckibben.identification.fit.comparison import ParameterTable
from mckibben.measurement.experiment import Experiment, place_of, shown_value, title_of


@dataclass(frozen=True, slots=True)
class Table:
    """A table of texts.

    Attributes:
        title: what it shows.
        columns: heads of the columns; the first column holds names, the others figures.
        rows: cells.
    """

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]


#: Tables and sentences in the order in which they are read.
Summary = list[Table | str]


class CountedRows(Protocol):
    """A result that counts the rows of its data."""

    @property
    def rows(self) -> int:
        """Number of rows of the data."""
        ...

    @property
    def rows_used(self) -> int:
        """Number of rows used."""
        ...

    @property
    def excluded(self) -> Mapping[str, int]:
        """Reason for leaving rows out -> number of rows."""
        ...


def rows_of(result: CountedRows) -> str:
    """Number of rows that a comparison or diagnosis uses, with the reasons for leaving out others."""
    if result.rows_used == result.rows:
        return f"{result.rows} rows"
    reasons = "".join(f", {count} left out: {reason}" for reason, count in result.excluded.items())
    return f"{result.rows_used} of {result.rows} rows{reasons}"


def experiment_table(file: str, experiment: Experiment) -> Table:
    """What a test was made with, and who says it."""
    rows = [[title_of(name), shown_value(name, value), place_of(value)] for name, value in experiment.items()]
    return Table(f"Experiment of {file}", ["", "value", "who says it"], rows)


def parameter_tables(parameters: ParameterTable) -> list[Table]:
    """The table of a model's parameters, if it has any."""
    rows = [
        [
            f"{effect}.{name}",
            f"{item.value:.5g}",  # a conductance is below the rounding errors that a figure hides
            ("–" if item.stderr is None else f"{item.stderr:.2g}") if item.fitted else "given",
            item.unit,
            "at its limit" if item.at_bound else "",
        ]
        for effect, values in parameters.items()
        for name, item in values.items()
    ]
    columns = ["parameter", PARAMETER["value"].words, PARAMETER["stderr"].label, "unit", ""]
    return [Table(PARAMETER.title, columns, rows)] if rows else []


def in_unit(value: float | None, scale: Scale, digits: int = 4) -> str:
    """An SI value in a unit of people, or a dash."""
    space = "" if scale.unit in ("", "°") else " "
    return figure(None if value is None else scale.of(value), digits, f"{space}{scale.unit}")


def shown(of: Figure, value: float | None) -> str:
    """The SI value of a figure with its unit, or a dash."""
    return in_unit(value, of.scale)


def figure(value: float | None, digits: int = 4, unit: str = "") -> str:
    """A number with ``digits`` significant digits, or a dash."""
    if value is None or not math.isfinite(value):
        return "–"
    # A result this small is the rounding error of a sum.
    shown = 0.0 if abs(value) < 1e-9 else value
    return f"{shown:.{digits}g}{unit}"
