"""Statements of a question that may be wrong, and what a diagnosis says about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import ClassVar

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.compare.specimens import Specimens
from mckibben.documents.start_model import StartModel
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.facts.result import result_class
from mckibben.identification.diagnose.entries import (
    OtherReading,
    StatedEntry,
    Statements,
    read_otherwise,
    statements,
)
from mckibben.identification.diagnose.entry_words import sentence_of
from mckibben.identification.diagnose.wrong_entry import WrongEntry
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.fit_model import GEOMETRY, FitModel
from mckibben.measurement.experiment import Experiment, ExperimentValue

_EXPERIMENT_FIELDS = {"muscle.nominal_length": "rest_length", "load": "load"}


@result_class
class DoubtfulEntry:
    """A statement that may be wrong, with the evidence."""

    FIGURES: ClassVar = DIAGNOSIS.name

    hypothesis: str
    """Id, for 'use' and 'keep'."""
    field: str
    """What it is about: a field of the muscle, or a channel."""
    stated: float | None
    """Stated value, SI; None for a way of reading."""
    value: float | str | None
    stderr: float | None
    unit: str
    """SI unit of stated, value and stderr."""
    explains: float
    rmse_after: float
    confidence: float
    effects: list[str]
    """Effects that are missing with it."""
    asked: bool
    """Whether it is to be answered before anything else."""
    kept: bool
    """Whether it would be asked about, but the user has ruled it out."""
    sentence: str
    """The evidence, as a sentence."""


def with_decisions(
    question: ModelQuestion, *, use: Sequence[str] = (), keep: Sequence[str] = ()
) -> ModelQuestion:
    """The question after decisions about statements that may be wrong.

    Args:
        question: model and data.
        use: hypotheses that are accepted: channels are read in the other way, quantities are fitted.
        keep: hypotheses that are ruled out.

    Raises:
        InputError: there is no such hypothesis for these data, or the changed data cannot be compared.
    """
    if not use and not keep:
        return question
    left, accepted = statements_of(question).keeping(keep).using(use)
    specimens = _read_otherwise(question.specimens, left.readings)
    validation = question.validation
    if validation is not None:
        validation = _read_otherwise(validation, left.readings)
    return replace(
        question, specimens=specimens, validation=validation, accepted=accepted, kept=frozenset(keep)
    )


def statements_of(question: ModelQuestion, most_rows: int | None = None) -> Statements:
    """The statements of a question that may be wrong, without those that are settled.

    Args:
        question: model and data.
        most_rows: of the predictor, as in `Specimens.predictor`.
    """

    def predictor(readings: Sequence[OtherReading]) -> Predictor:
        specimens = _read_otherwise(question.specimens, readings)
        return specimens.predictor(question.start.muscle, most_rows)[0]

    found = statements(
        question.points.measurement,
        question.fit_model(),
        predictor,
        supply=None if question.drive is None else float(question.drive.supply_pressure),
        elastic=question.start.catalogue.values(),
        catalogued=_catalogued(question.start),
    )
    settled = {entry.field for entry in question.accepted}
    entries = tuple(entry for entry in found.entries if entry.field not in settled)
    return replace(found, entries=entries, kept=question.kept)


def _catalogued(start: StartModel) -> list[str]:
    """The fields of a muscle that are those of its preset; its length is chosen by the user."""
    if start.preset is None:
        return []
    own = start.preset.muscle
    names = [name for name in GEOMETRY if name != "nominal_length"]
    return [name for name in names if getattr(own, name) == getattr(start.muscle, name)]


def _read_otherwise(specimens: Specimens, readings: Sequence[OtherReading]) -> Specimens:
    if not readings:
        return specimens
    each = tuple(
        replace(one, points=replace(one.points, measurement=read_otherwise(one.points.measurement, readings)))
        for one in specimens.each
    )
    measurement = read_otherwise(specimens.points.measurement, readings)
    return replace(specimens, each=each, points=replace(specimens.points, measurement=measurement))


def doubtful_entries(context: Sequence[WrongEntry], titles: Mapping[str, str]) -> list[DoubtfulEntry]:
    """The evidence about entries in the form of an answer."""
    return [
        DoubtfulEntry(
            hypothesis=found.entry.hypothesis,
            field=found.entry.field,
            stated=found.entry.stated,
            value=found.value if found.entry.reading is None else found.entry.reading.words,
            stderr=found.stderr,
            unit=found.entry.unit,
            explains=found.explains,
            rmse_after=found.best.rmse,
            confidence=found.confidence,
            effects=list(found.effects),
            asked=found.stands,
            kept=found.kept,
            sentence=sentence_of(found, titles),
        )
        for found in context
    ]


def with_accepted(experiment: Experiment, accepted: Sequence[StatedEntry], model: FitModel) -> Experiment:
    """The experiment with the accepted values, whose origin is a suggestion."""
    changed = dict(experiment)
    for entry in accepted:
        where = f"--use {entry.hypothesis}"
        if entry.reading is not None:
            words = f"read {entry.reading.words}"
            changed[entry.field] = ExperimentValue(words, "", "suggested", where)
        elif entry.free is not None:
            value = entry.value(model.number(entry.free.name))
            name = _EXPERIMENT_FIELDS.get(entry.field, entry.field.removeprefix("muscle."))
            changed[name] = ExperimentValue(value, entry.unit, "suggested", where)
    return changed


def questions_of(context: Sequence[WrongEntry], titles: Mapping[str, str]) -> str:
    """What has to be answered first, in words; empty without a doubt."""
    standing = [found for found in context if found.stands]
    if not standing:
        return ""
    first = standing[0]
    hypothesis = first.entry.hypothesis
    others = [other.entry.title for other in standing[1:3]]
    also = f" {' or '.join(others).capitalize()} could be wrong instead." if others else ""
    return (
        f"Check an entry first: {sentence_of(first, titles)}.{also} '--use {hypothesis}' takes it, "
        f"'--keep {hypothesis}' rules it out."
    )


def notes_of(context: Sequence[WrongEntry], titles: Mapping[str, str]) -> list[str]:
    """Entries that explain the data as well as effects, and those that the user has ruled out."""
    notes = []
    for found in context:
        if found.kept:
            notes.append(f"{found.entry.title[4:]} is kept as stated, although {sentence_of(found, titles)}")
        elif not found.stands:
            notes.append(
                f"{sentence_of(found, titles)}. That is as good as the added effects: check it first"
            )
    return notes
