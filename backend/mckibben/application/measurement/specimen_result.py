"""The experiment in an answer: every value, the error on each specimen, and what the accuracy absorbed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import field, replace
from typing import ClassVar

import numpy as np

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.measurement.summary import Preparation, preparations
from mckibben.facts.comparison import SPECIMEN
from mckibben.facts.result import result_class
from mckibben.identification.diagnose.left_out import LeftOutSpecimen
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.measurement.experiment import Experiment


@result_class
class SpecimenResult:
    """One measurement of a question."""

    FIGURES: ClassVar = SPECIMEN.name

    file: str
    """Name of the file or preset."""
    rows_used: int
    """Number of rows used."""
    rmse: float | None
    holdout_rmse: float | None
    experiment: Experiment
    """Values of its experiment, each with its origin."""
    left_out_rmse: float | None = None
    left_out_percent: float | None = None
    prepared: list[Preparation] = field(default_factory=list)
    """The steps that prepared its data, in their order."""


def common_experiment(question: ModelQuestion) -> Experiment:
    """The values in which all measurements agree, wherever each states them."""
    first, *others = (specimen.experiment for specimen in question.specimens.each)
    common = {}
    for name, value in first.items():
        each = [value, *(other.get(name) for other in others)]
        if all(one is not None and replace(one, where=value.where) == value for one in each):
            common[name] = value if all(one == value for one in each) else replace(value, where="each file")
    return common


def specimen_results(
    question: ModelQuestion,
    predictor: Predictor,
    residual: np.ndarray,
    fitted: FittedModel | None = None,
    left_out: Sequence[LeftOutSpecimen] = (),
) -> list[SpecimenResult]:
    """Each measurement with its error; of one measurement, or of several as one record, the whole.

    Args:
        question: the measurements.
        predictor: the data used.
        residual: measured minus predicted as fits see it (`Predictor.weighted`), shape (values,).
        fitted: the fitted model, for the held-out error.
        left_out: the specimens predicted by the model fitted to the others, in the same order.
    """
    labels = question.specimens.labels(predictor)
    apart = len(question.specimens.each) == 1 or question.specimens.several
    results = []
    for number, specimen in enumerate(question.specimens.each):
        if not apart:
            results.append(
                SpecimenResult(
                    specimen.name,
                    specimen.points.measurement.rows,
                    None,
                    None,
                    specimen.experiment,
                    prepared=preparations(specimen.points.measurement),
                )
            )
            continue
        rows = labels == number
        left = None
        if fitted is not None:
            folds = fitted.folds[0]
            inside = [label for label in np.unique(folds) if np.all(rows[folds == label])]
            squares = dict(zip(np.unique(folds).tolist(), fitted.fold_squares[0].tolist(), strict=True))
            counts = [int(np.count_nonzero(folds == label)) for label in inside]
            if sum(counts) == np.count_nonzero(rows):
                left = float(np.sqrt(np.average([squares[int(label)] for label in inside], weights=counts)))
        results.append(
            SpecimenResult(
                specimen.name,
                int(np.count_nonzero(rows)) // len(predictor.channels),
                float(np.sqrt(np.mean(residual[rows] ** 2))),
                left,
                specimen.experiment,
                left_out[number].rmse if left_out else None,
                100.0 * left_out[number].share if left_out and len(predictor.channels) == 1 else None,
                preparations(specimen.points.measurement),
            )
        )
    return results


def absorbed_message(absorbed: Iterable[AbsorbedError], unit: str) -> list[str]:
    """What the accuracy took up, in words; nothing where it took up nothing.

    Args:
        absorbed: the estimated errors.
        unit: of the predicted channel.
    """
    errors = list(absorbed)
    if not errors:
        return []
    scale, shown_unit = (1e3, "mm") if unit == "m" else (1.0, unit)
    parts = [
        f"{error.channel.replace('_', ' ')}{f' {error.of}' if error.of else ''} {_shown(error)} "
        f"({scale * error.rms:.3g} {shown_unit})"
        for error in errors
    ]
    far = [error for error in errors if abs(error.value) > 3.0 * error.accuracy]
    beyond = (
        f"; {len(far)} of them exceed three times the accuracy: that is no error of reading" if far else ""
    )
    return [
        "reading errors that the fit allows for within the accuracy (± one standard error): "
        f"{'; '.join(parts)}{beyond}"
    ]


def _shown(error: AbsorbedError) -> str:
    degree = float(np.degrees(1.0))
    scale, unit = {"m": (1e3, "mm"), "Pa": (1e-2, "mbar"), "rad": (degree, "°")}.get(
        error.unit, (1.0, error.unit)
    )
    return f"{scale * error.value:+.2g} ± {scale * error.stderr:.1g} {unit}"
