"""The judgement on a model that was compared, by the same function that judges the models of a diagnosis."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mckibben.identification.diagnose.judgement import Judgement, judged, without_suspects
from mckibben.identification.fit.comparison import Comparison
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.fit_model import each, together
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.noise import noise_of


@dataclass(frozen=True)
class JudgedModel:
    """A compared model, and what speaks for and against it.

    Attributes:
        predictor: the data, with the rows that were set aside.
        model: the model.
        judgement: without the rows that were set aside.
        first: with them; None where none were.
    """

    predictor: Predictor
    model: FittedModel
    judgement: Judgement
    first: Judgement | None = None

    @property
    def aside(self) -> np.ndarray:
        """The values that were set aside, as indices."""
        return np.flatnonzero(np.zeros(0, bool) if self.predictor.aside is None else self.predictor.aside)


def judged_comparison(comparison: Comparison) -> JudgedModel:
    """The judgement on a compared model; its values stay as they are.

    Rows that do not fit are named and set aside, as in a diagnosis; in a run they are an event.
    """
    predictor, model = comparison.predictor, _model(comparison)
    first = JudgedModel(predictor, model, judged(model, predictor, comparison.noise))

    def again(without: Predictor) -> JudgedModel:
        rest = replace(model, aside=without.aside)
        noise, _ = noise_of(without, comparison.residual / without.scale, comparison.stated_noise)
        return JudgedModel(without, rest, judged(rest, without, noise), first.judgement)

    return without_suspects(predictor, first, again, lambda found: found.judgement)


def _model(comparison: Comparison) -> FittedModel:
    predictor, free = comparison.predictor, comparison.free
    jacobian = np.empty((len(predictor.measured), 0))
    if free:
        slopes = predictor.linearised(comparison.fit_model, each(free))[1]
        jacobian = predictor.weighted(together(slopes, free))
    return FittedModel(
        comparison.fit_model,
        free,
        frozenset(),
        predictor.weighted(comparison.residual),
        jacobian,
        predictor.folds,
        noise_lines=predictor.noise_lines,
        aside=predictor.aside,
    )
