"""Effects of the start model that the data do not need."""

from __future__ import annotations

from dataclasses import dataclass

from mckibben.identification.diagnose.score import better, effective_rows
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.thresholds import SCORE


@dataclass(frozen=True)
class Superfluous:
    """An effect without which the model describes the data as well.

    Attributes:
        effect: its id.
        rmse: error without it, and without those named before it; of the scaled residual.
    """

    effect: str
    rmse: float


def superfluous(fitter: Fitter, model: FittedModel, root: FittedModel) -> tuple[Superfluous, ...]:
    """The fitted effects of the start model that can be left out together, the least needed first.

    By the same comparison that takes an effect into a model: without it, and all else refitted, the model is
    as good. Two laws of the same friction are each superfluous beside the other, so that one is left out at a
    time. An effect of which nothing was fitted says what is known from elsewhere, and stays.

    Args:
        fitter: of the search.
        model: the best model.
        root: the start model, fitted.
    """
    fitted = {p.name.partition(".")[0] for p in root.free}
    left = [name for name in root.fit_model.ids if name in fitted]
    found: list[Superfluous] = []
    while left:
        rows = effective_rows(model.residual, fitter.predictor.sweeps, fitter.predictor.folds)
        without = {name: fitter.dropping(model, name) for name in left}
        spared = {
            name: less
            for name, less in without.items()
            if not less.lost
            and less.implausible <= model.implausible
            and less.rmse <= (1.0 + SCORE.least_gain) * model.rmse
            and not better(model, less, rows=rows, noise=fitter.noise)
        }
        if not spared:
            break
        name = min(spared, key=lambda each: spared[each].rmse)
        model = spared[name]
        found.append(Superfluous(name, model.rmse))
        left.remove(name)
    return tuple(found)
