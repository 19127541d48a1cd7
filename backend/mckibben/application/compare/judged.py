"""What is said of a model that was compared: status and proofs, rivals, and rows that do not fit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Literal

import numpy as np

from mckibben.application.compare.question import ModelQuestion
from mckibben.facts.result import result_class
from mckibben.identification.diagnose.judged import JudgedModel
from mckibben.identification.diagnose.judgement import PUSHES, Judgement
from mckibben.identification.diagnose.judgement_words import judged_text, open_proofs, shown_unit
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.identification.residual.digits import brief
from mckibben.identification.residual.rivals import rivals_of

#: What a comparison says of a model; without a search it does not know what is missing.
JudgedStatus = Literal["adequate", "structure_left", "undecided"]
_TITLES: dict[JudgedStatus, str] = {
    "adequate": "The model is adequate",
    "structure_left": "Something is left that is no noise",
    "undecided": "These data cannot tell whether something is missing",
}
_SHOWN = 5  # rows that are listed
_SURFACE = "free surface"


@result_class
class Proofs:
    """What "nothing is missing" rests on: whether each proof holds; None where it is not decided."""

    noise_known: bool | None
    """The noise is known apart from the model, and what is left does not last for whole sweeps."""
    white: bool | None
    """A free surface explains no more of what is left than noise does, and nothing repeats in step."""
    no_outliers: bool | None
    """Each row that counts fits beside the others."""
    rival_gains_nothing: bool | None
    """A free surface predicts groups that were left out no better than the model."""


@result_class
class Rival:
    """A model without physics beside the best one."""

    kind: str
    """What it is."""
    numbers: int
    """Its effective number of free numbers [-]."""
    rmse: float
    """Error that it leaves, SI; in the noise of each channel where there are several. A free surface is on
    what the best model leaves, the others stand alone."""
    holdout_rmse: float | None
    """The same on groups that were left out, over their rows within the range of the others; None where there
    are too few."""
    model_holdout_rmse: float | None
    """Error of the best model on the same rows, left out likewise."""


@result_class
class SuspectRow:
    """A row that does not fit, and counts for nothing in the verdict."""

    file: str
    """Name of its measurement."""
    row: int
    """Its number among the rows of readings, from 1."""
    residual: float
    """Measured minus predicted by the best model, SI."""
    why: str
    """Why it is set aside."""
    place: str
    """The row in words."""


@result_class
class ComparedVerdict:
    """What a comparison says of a model: a diagnosis of an adequate model says the same."""

    CORRECTING: ClassVar = ("sentence",)

    status: JudgedStatus
    """The verdict as a word for programs: all four proofs hold (adequate); what is left is no noise, and a
    diagnosis looks for what it is (structure_left); the data cannot tell (undecided).
    """
    title: str
    """The status in words."""
    proofs: Proofs
    """Of the compared model."""
    why_not: dict[str, str]
    """Proof that does not hold, or is not decided -> why."""
    sentence: str
    """The verdict in words, with the rows that were set aside."""


def proofs_of(judgement: Judgement) -> Proofs:
    """The proofs in the form of an answer."""
    return Proofs(**{name: holds for name, (holds, _) in judgement.proofs.items()})


def rivals_beside(model: FittedModel, predictor: Predictor, judgement: Judgement) -> list[Rival]:
    """Models without physics beside a model, the best on left-out groups first."""
    return [
        Rival(rival.kind, rival.numbers, rival.left, rival.left_out, rival.model_left_out)
        for rival in rivals_of(model, predictor, judgement.surface)
    ]


def rival_sentence(
    model: FittedModel, predictor: Predictor, judgement: Judgement, rivals: Sequence[Rival]
) -> str:
    """What the best rival leaves, under a verdict that is not adequate and has not said it; else empty."""
    if not rivals:
        return ""
    best, (unit, scale) = rivals[0], shown_unit(predictor.unit)
    if best.kind == _SURFACE and judgement.undecided:
        return ""  # the sentence of what the data cannot tell has named it
    left, where = brief(scale * best.rmse), ", without physics,"
    if best.kind == _SURFACE:
        where = " on what the model leaves"
    numbers = f"{best.numbers} number{'' if best.numbers == 1 else 's'}"
    text = (
        f"A {best.kind} with {numbers}{where} would leave {left} {unit}, the "
        f"model with its {len(model.free)} leaves {brief(scale * model.rmse)} {unit}"
    )
    if best.holdout_rmse is None or best.model_holdout_rmse is None:
        return f"{text}; too few groups can be left out to tell which predicts better."
    both = f"{brief(scale * best.holdout_rmse)} against {brief(scale * best.model_holdout_rmse)} {unit}"
    if best.holdout_rmse < best.model_holdout_rmse:
        return f"{text}; on groups that were left out, {both}."
    return f"{text}; on groups that were left out no such description is better: {both}."


def compared_verdict(
    judged: JudgedModel, suspects: Sequence[SuspectRow], rivals: Sequence[Rival]
) -> ComparedVerdict:
    """The verdict on a compared model."""
    found = judged.judgement
    status: JudgedStatus = (
        "structure_left" if found.structured else "undecided" if found.undecided else "adequate"
    )
    sentence = judged_text(found, *shown_unit(judged.predictor.unit))
    if status == "structure_left":
        beside = rival_sentence(judged.model, judged.predictor, found, rivals)
        sentence += f" {beside}" if beside else ""
    if suspects:
        more = [f"{len(suspects) - _SHOWN} more"] if len(suspects) > _SHOWN else []
        rows = ", ".join([*(each.place for each in suspects[:_SHOWN]), *more])
        they = "it does" if len(suspects) == 1 else "they do"
        sentence += f" Set aside, because {they} not fit beside the others: {rows}."
    return ComparedVerdict(status, _TITLES[status], proofs_of(found), open_proofs(found), sentence)


def suspects_of_comparison(question: ModelQuestion, judged: JudgedModel) -> list[SuspectRow]:
    """The rows that count for nothing in the verdict of a comparison."""
    if judged.first is None:
        return []
    predictor, rows = judged.predictor, judged.aside
    sizes = (predictor.residual(judged.model.fit_model) / predictor.scale)[rows]
    return suspect_rows(question, predictor, rows, sizes.tolist(), judged.first)


def suspect_rows(
    question: ModelQuestion,
    predictor: Predictor,
    rows: np.ndarray,
    sizes: Sequence[float],
    first: Judgement,
) -> list[SuspectRow]:
    """Rows that were set aside, with their files.

    Args:
        question: with the files.
        predictor: the data.
        rows: indices of the values.
        sizes: measured minus predicted, over the scale.
        first: the judgement with all rows.
    """
    several = len(question.specimens.each) > 1
    outlying = first.outlying
    alone = outlying.place is None or len(outlying.rows) != len(rows)
    why = "it does not fit beside the others" if alone or not outlying.place else outlying.place.sentence
    found = []
    for value, size in zip(rows.tolist(), sizes, strict=True):
        file, row = _place_in_file(question, predictor, value)
        place = f"row {row}{f' of {file}' if several else ''}"
        reason = PUSHES if value in first.pushing else why
        found.append(SuspectRow(file, row, float(size * predictor.scale[value]), reason, place))
    return found


def _place_in_file(question: ModelQuestion, predictor: Predictor, value: int) -> tuple[str, int]:
    """The file of a value of a predictor, and its row there, counted from 1 over the rows that were read."""
    each = [specimen.points.measurement for specimen in question.specimens.each]
    row = int(predictor.row_numbers[value])
    if isinstance(predictor, SpecimensPredictor):
        measurement = each[int(predictor.specimen[value])]
    else:  # several files as one record
        ends = np.cumsum([one.rows for one in each])
        number = min(int(np.searchsorted(ends, row, side="right")), len(each) - 1)
        measurement, row = each[number], row - int(ends[number] - each[number].rows)
    if measurement.source_rows is not None and row < measurement.rows:
        row = int(measurement.source_rows[row])
    return measurement.name, row + 1
