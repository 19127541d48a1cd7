"""Rows of a study: one for each run, whatever became of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.facts.result import result_class
from mckibben.studies.variable import Variable

Array = np.ndarray
COMPLETED = "completed"


@dataclass(frozen=True, slots=True)
class Row:
    """How a run ended.

    Attributes:
        outcome: "completed", or the name of what went wrong.
        figures: values of the figures in SI, NaN for one that does not exist.
        message: why the run failed, or why figures do not exist; "" if nothing is missing.
    """

    outcome: str
    figures: tuple[float, ...]
    message: str = ""


#: From points, shape (runs, variables), to rows in the same order. A row must not depend on the other points.
Evaluate = Callable[[Array], Sequence[Row]]


@result_class
class Figure:
    """A watched figure: its path and SI unit."""

    path: str
    """Path of the figure."""
    unit: str
    """SI unit."""


@dataclass(frozen=True, eq=False)
class StudyTable:
    """All runs that were made, ascending by number; SI.

    Attributes:
        variables, figures: the columns.
        runs: number of each run in the plan, shape (rows,).
        points: shape (rows, variables).
        values: shape (rows, figures); NaN where a figure does not exist.
        outcomes, messages: of each row.
    """

    variables: tuple[Variable, ...]
    figures: tuple[Figure, ...]
    runs: Array
    points: Array
    values: Array
    outcomes: tuple[str, ...]
    messages: tuple[str, ...]

    @classmethod
    def of(
        cls,
        variables: Sequence[Variable],
        figures: Sequence[Figure],
        points: Mapping[int, Array],
        rows: Mapping[int, Row],
    ) -> StudyTable:
        """The table of rows by the number of their run."""
        runs = sorted(rows)
        return cls(
            tuple(variables),
            tuple(figures),
            np.array(runs, np.int64),
            np.array([points[run] for run in runs]).reshape(len(runs), len(variables)),
            np.array([rows[run].figures for run in runs], float).reshape(len(runs), len(figures)),
            tuple(rows[run].outcome for run in runs),
            tuple(rows[run].message for run in runs),
        )

    @property
    def completed(self) -> Array:
        """Whether each run completed."""
        return np.array([outcome == COMPLETED for outcome in self.outcomes], bool)

    def figure(self, path: str) -> Array:
        """Values of a figure; NaN of a run that did not complete."""
        place = [figure.path for figure in self.figures].index(path)
        return np.where(self.completed, self.values[:, place], np.nan)

    def columns(self) -> dict[str, list[float | str | None]]:
        """The columns by name: run, quantities, figures, outcome, message; None for a missing figure."""
        columns: dict[str, list[float | str | None]] = {"run": self.runs.tolist()}
        for index, variable in enumerate(self.variables):
            columns[variable.name] = [variable.shown(value) for value in self.points[:, index].tolist()]
        for index, figure in enumerate(self.figures):
            values = self.values[:, index].tolist()
            columns[figure.path] = [None if value != value else value for value in values]
        columns["outcome"] = [*self.outcomes]
        columns["message"] = [*self.messages]
        return columns
