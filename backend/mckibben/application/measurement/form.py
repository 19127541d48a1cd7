"""The experiment as a form: every field that matters for a test, with value and origin, or a question."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from math import pi
from typing import ClassVar

import numpy as np

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.measurement.experiment import QuestionMeasurement, stated_in
from mckibben.application.measurement.rig_drive import assumed_stops
from mckibben.application.measurement.summary import FormField, UnreadableFile
from mckibben.documents.studio import Studio
from mckibben.facts.result import result_class
from mckibben.measurement.accuracy import default_accuracy
from mckibben.measurement.experiment import (
    ACCURACY,
    FIELDS,
    Experiment,
    ExperimentValue,
    file_experiment,
    mattering,
    needed,
)
from mckibben.measurement.measurement import STROKES, Measurement
from mckibben.measurement.reading import Preview
from mckibben.physics.errors import InputError

_CATALOGUES = {"muscle": "muscles", "valve": "valves", "tube": "tubes"}
_REST_ROWS = 5  # fewest rows at rest from which a zero is proposed
_AT_REST = 0.03e5  # Pa


@result_class
class StatedExperiment:
    """The experiment of one measurement as a form."""

    id: str
    """Id as in the request."""
    name: str
    """Name of the file or preset."""
    kind: str
    """Measurement kind."""
    experiment: list[FormField]
    """Its fields."""


@result_class
class ExperimentForms:
    """The forms of all measurements, what would be assumed, and what stands in the way."""

    CORRECTING: ClassVar = ("assumptions",)

    measurements: list[StatedExperiment]
    """One entry per measurement of the request."""
    assumptions: list[str]
    """What a diagnosis would assume, in the words with which it begins."""
    problem: UnreadableFile | None
    """A conflict, or a missing value without which the diagnosis is refused."""


def preview_form(preview: Preview, studio: Studio, muscle: str | None) -> list[FormField]:
    """The experiment of a file that is not stored yet.

    Args:
        preview: of the file.
        studio: for the presets.
        muscle: id of the preset that the user has chosen.

    Raises:
        InputError: there is no such preset.
    """
    values = file_experiment(preview.stated)
    if muscle is not None:
        values["muscle"] = ExperimentValue(studio.facts(muscle).id, "", "you", "muscle")
    measurement = preview.measurement
    if measurement is None:
        channels = tuple(column.channel for column in preview.columns if column.channel is not None)
        return _form(None, channels, values, studio, None)
    return _form(measurement.kind, tuple(measurement.columns), values, studio, measurement)


def experiment_forms(
    measurements: Sequence[tuple[str, QuestionMeasurement]],
    question: Callable[[], ModelQuestion],
    studio: Studio,
) -> ExperimentForms:
    """The experiments of the measurements of a question, also of one that cannot be asked yet.

    Args:
        measurements: id and measurement.
        question: puts the question.
        studio: for the presets.
    """
    problem, assumptions = None, []
    resolved: dict[str, Experiment] = {}
    try:
        asked = question()
        assumptions = [assumption.message for assumption in asked.assumptions]
        groups = [asked.specimens, *([asked.validation] if asked.validation else [])]
        resolved = {each.points.measurement.id: each.experiment for group in groups for each in group.each}
        _ = asked.predictor  # what a comparison needs beyond the experiment
    except InputError as error:
        problem = UnreadableFile(error.code, error.message, error.field, error.hint)
    forms = []
    for identity, said in measurements:
        measurement = said.points.measurement
        values = resolved.get(measurement.id) or {**stated_in(said.points), **said.said}
        fields = _form(measurement.kind, tuple(measurement.columns), values, studio, measurement)
        forms.append(StatedExperiment(identity, measurement.name, measurement.kind, fields))
    return ExperimentForms(forms, assumptions, problem)


def _form(
    kind: str | None,
    channels: Collection[str],
    values: Mapping[str, ExperimentValue],
    studio: Studio,
    measurement: Measurement | None,
) -> list[FormField]:
    required = needed(kind, channels)
    usual = _usual(kind, channels, values, studio, measurement)
    fields = []
    for name in mattering(kind, channels):
        declared = FIELDS[name]
        value = values.get(name) or usual.get(name)
        choices = declared.choices
        if name in _CATALOGUES:
            presets = tuple(preset.id for preset in studio.library.list(_CATALOGUES[name]))
            choices = (*declared.choices, *presets)
        fields.append(
            FormField(
                field=name,
                title=declared.title,
                value=None if value is None else value.value,
                unit=declared.unit if value is None else value.unit,
                units=declared.units,
                origin=None if value is None else value.origin,
                where="" if value is None else value.where,
                required=name in required,
                unanswered=name in required and (value is None or value.origin == "assumed"),
                question=declared.question,
                why=declared.why,
                proposed=_proposed(name, values, measurement),
                least=declared.least,
                most=declared.most,
                choices=choices,
                closed=declared.closed,
                example=declared.example,
                option=declared.option,
            )
        )
    return fields


def _usual(
    kind: str | None,
    channels: Collection[str],
    values: Mapping[str, ExperimentValue],
    studio: Studio,
    measurement: Measurement | None,
) -> dict[str, ExperimentValue]:
    """What a diagnosis would assume where nobody says it."""
    found: dict[str, ExperimentValue] = {}
    facts = None
    if "muscle" in values:
        try:
            facts = studio.facts(str(values["muscle"].value).partition(":")[0])
        except InputError:  # the file names a muscle that is not in the catalogue
            facts = None
    if facts is not None:
        length = float(facts.muscle.nominal_length)
        found["rest_length"] = ExperimentValue(length, "m", "assumed", f"the preset {facts.id}")
    if kind == "transient":
        found["inclination"] = ExperimentValue(pi / 2.0, "rad", "assumed")
        limit = None if facts is None else facts.limits.max_contraction
        rest = values.get("rest_length", found.get("rest_length"))
        length = None if rest is None else float(rest.value)
        found["stops"] = assumed_stops(measurement, length, limit, bare="command" not in channels)
        if "command" in channels:
            found["supply"] = ExperimentValue(6e5, "Pa", "assumed")
            found["tube"] = ExperimentValue("none", "", "assumed")
    for channel, accuracy in (default_accuracy(measurement) if measurement is not None else {}).items():
        found[f"{ACCURACY}{channel}"] = ExperimentValue(
            accuracy.value, accuracy.unit, "assumed", "usual for readings at rest"
        )
    return found


def _proposed(
    name: str, values: Mapping[str, ExperimentValue], measurement: Measurement | None
) -> float | str | None:
    """A value that the data suggest: the reading of a sensor at rest, the length of the vented muscle."""
    if measurement is None or name in values:
        return None
    columns = measurement.columns
    pressure = columns.get("pressure")
    if pressure is None:
        return None
    vented = np.abs(pressure) < _AT_REST
    if np.count_nonzero(vented) < _REST_ROWS:
        return None
    if name == "force_zero" and "force" in columns:
        return _zero_of_force(columns["force"], vented, columns)
    if name == "rest_length" and "length" in columns and "force" not in columns and "load" not in values:
        return float(np.median(columns["length"][vented]))
    return None


def _zero_of_force(force: np.ndarray, vented: np.ndarray, columns: Mapping[str, np.ndarray]) -> float | None:
    stroke = next((columns[name] for name in STROKES if name in columns), None)
    if stroke is None or not np.ptp(stroke) > 0.0:
        return None
    # Away from the rest position a vented muscle may push or pull.
    rest = np.max(stroke) if "length" in columns else np.min(stroke)
    rows = vented & (np.abs(stroke - rest) < 0.01 * np.ptp(stroke))
    if np.count_nonzero(rows) < _REST_ROWS:
        return None
    offset = float(np.median(force[rows]))
    return offset if abs(offset) > 0.005 * float(np.max(np.abs(force))) else None
