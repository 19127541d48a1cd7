"""A field of the experiment on a form."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FormField:
    """A field of a form; see `mckibben.measurement.experiment.ExperimentField` and ``ExperimentValue``.

    Attributes:
        required: this kind of test needs it.
        unanswered: required, and nobody says it.
        proposed: value that the data suggest, SI; never used unasked.
    """

    field: str
    title: str
    value: float | str | None
    unit: str
    units: tuple[str, ...]
    origin: str | None
    where: str
    required: bool
    unanswered: bool
    question: str
    why: str
    proposed: float | str | None
    least: float | None
    most: float | None
    choices: tuple[str, ...]
    closed: bool
    example: str
    option: str
