"""Statements of a question that may be wrong, and what a diagnosis says about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from mckibben.application.model_question import ModelQuestion
from mckibben.application.specimens import Specimens
from mckibben.identification.diagnose.contest import WrongEntry, sentence_of
from mckibben.identification.diagnose.entries import (
    Entry,
    Reading,
    Statements,
    read_otherwise,
    statements,
)
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict import Predictor
from mckibben.measurement.experiment import Experiment, ExperimentValue

_EXPERIMENT_FIELDS = {"muscle.nominal_length": "rest_length", "load": "load"}


@dataclass(frozen=True, slots=True)
class Doubts:
    """What the user has decided about doubtful statements.

    Attributes:
        use: hypotheses that are accepted.
        keep: hypotheses that are ruled out.
    """

    use: Sequence[str] = ()
    keep: Sequence[str] = ()


@dataclass(frozen=True, slots=True)
class DoubtfulEntry:
    """A statement that may be wrong, with the evidence.

    Attributes:
        hypothesis: id, as in ``use`` and ``keep``.
        field: what it is about: a field of the muscle, or a channel.
        stated: the stated value [SI]; None for a way of reading.
        value: the value that explains the data [SI], or the other way of reading in words.
        stderr: standard error of a value [SI].
        unit: SI unit of a value.
        explains: share of the start model's mean square above the noise that it explains by itself.
        rmse_after: error of the best model with it, in the unit of the diagnosis.
        confidence: probability against the best model without it.
        effects: effects that are missing with it.
        asked: whether it is to be answered before anything else.
        kept: whether it would be asked about, but the user has ruled it out.
        sentence: all of it in words.
    """

    hypothesis: str
    field: str
    stated: float | None
    value: float | str | None
    stderr: float | None
    unit: str
    explains: float
    rmse_after: float
    confidence: float
    effects: list[str]
    asked: bool
    kept: bool
    sentence: str


@dataclass(frozen=True)
class Doubted:
    """The data of a diagnosis after the decisions of the user.

    Attributes:
        statements: what may still be wrong.
        accepted: the accepted entries.
        predictor: the data, read in the accepted ways; None where nothing is read in another way.
    """

    statements: Statements
    accepted: tuple[Entry, ...]
    predictor: Predictor | None


def doubted(question: ModelQuestion, doubts: Doubts, most_rows: int | None) -> Doubted:
    """The statements of a question that may be wrong, with the decisions of the user applied.

    Args:
        question: model and data.
        doubts: the decisions.
        most_rows: of the predictor, as in `Specimens.predictor`.

    Raises:
        InputError: there is no such hypothesis for these data, or its data cannot be compared.
    """

    def predictor(readings: Sequence[Reading]) -> Predictor:
        specimens = _read_otherwise(question.specimens, readings)
        return specimens.predictor(question.start.muscle, most_rows)[0]

    found = statements(question.points.measurement, question.fit_model(), predictor)
    left, accepted = found.keeping(doubts.keep).using(doubts.use)
    return Doubted(left, accepted, predictor(left.readings) if left.readings else None)


def _read_otherwise(specimens: Specimens, readings: Sequence[Reading]) -> Specimens:
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


def with_accepted(experiment: Experiment, accepted: Sequence[Entry], best: FittedModel) -> Experiment:
    """The experiment with the accepted values, whose origin is a suggestion."""
    changed = dict(experiment)
    for entry in accepted:
        where = f"--use {entry.hypothesis}"
        if entry.reading is not None:
            words = f"read {entry.reading.words}"
            changed[entry.field] = ExperimentValue(words, "", "suggested", where)
        elif entry.free is not None:
            value = best.fit_model.number(entry.free.name)
            value += (entry.stated or 0.0) if entry.field == "load" else 0.0
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
                f"{sentence_of(found, titles)}: as well as the added effects do, so measure it first"
            )
    return notes
