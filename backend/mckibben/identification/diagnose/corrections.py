"""Effects of a best model that are rather corrections of another effect's inexact form.

A search adds whatever lowers the error on the groups left out by more than chance. Where a formula of the
catalogue differs a little from the real muscle, that includes effects that the muscle does not have. They are
small beside the noise and beside what the whole model explains, so their calibrated probability is low.

They are not called missing. The model keeps them where it predicts better with them: an inexact form is an
error too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mckibben.identification.diagnose.probability import Loss, loss
from mckibben.identification.diagnose.score import better, effective_rows
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.thresholds import PROBABILITY

_IN_TIME = frozenset({"rate", "dynamic"})  # types of effects that depend on speed or time


@dataclass(frozen=True)
class Correction:
    """An effect that lowers the error but is not called missing.

    Attributes:
        effect: its id.
        before, after: error of the model without and with it, scaled as the residual.
        loss: what the model loses without it.
        kept: whether the model keeps it.
        share: of the visited models, by weight, that hold it or one that the data cannot tell from it; 1
            where its size alone speaks against it.
        formula: whether some formula of the same variables is likelier than it.
    """

    effect: str
    before: float
    after: float
    loss: Loss
    kept: bool = False
    share: float = 1.0
    formula: bool = False

    @property
    def probability(self) -> float:
        """Probability that it is missing nevertheless."""
        return self.share * self.loss.probability


def without_corrections(
    fitter: Fitter, best: FittedModel, root: FittedModel, noise: float
) -> tuple[FittedModel, tuple[Correction, ...]]:
    """The best model without the effects that are rather corrections, the least likely first.

    Args:
        fitter: of the search.
        best: its best model.
        root: the fitted start model.
        noise: of the scaled residual.
    """
    start = set(root.fit_model.ids)
    corrections: list[Correction] = []
    while True:
        names = [name for name in best.fit_model.ids if name not in start]
        if len(names) < 2:  # what a single effect explains is not a correction of another one
            return best, tuple(corrections)
        trials = {name: fitter.dropping(best, name) for name in names}
        losses = {name: loss(best, without, root, noise=noise) for name, without in trials.items()}
        least = min(names, key=lambda name: losses[name].probability)
        if losses[least].probability >= PROBABILITY.likely:
            return best, tuple(corrections)
        corrections.append(Correction(least, trials[least].rmse, best.rmse, losses[least]))
        best = trials[least]


def refined(
    fitter: Fitter, lean: FittedModel, searched: FittedModel, corrections: Sequence[Correction]
) -> tuple[list[tuple[str, FittedModel]], tuple[Correction, ...]]:
    """The models with one more kept correction each, and all corrections with what they do to the lean model.

    A correction is kept where it improves the score, which weighs the error on groups left out, and makes no
    parameter implausible. It brings no dependence on speed or time into a quasi-static model that has none:
    data that call for such an effect would have it among the missing ones, and other speeds than the measured
    ones would be predicted by a guess.

    Args:
        fitter: of the search.
        lean: the best model without corrections.
        searched: the best model of the search, with them.
        corrections: as found, the least likely first.
    """
    steps: list[tuple[str, FittedModel]] = []
    examined: list[Correction] = []
    here = lean
    types = {effect.type for effect in lean.fit_model.effects}
    for correction in reversed(corrections):
        effect = next(e for e in searched.fit_model.effects if e.id == correction.effect)
        own = {name for name in searched.freed if name.startswith(f"{effect.id}.")}
        trial = fitter.adding(here, effect)
        if own - trial.freed:
            trial = fitter.fit(trial.fit_model, trial.freed | own)
        rows = effective_rows(trial.residual, fitter.predictor.sweeps, fitter.predictor.folds)
        foreign = effect.type in _IN_TIME and not fitter.predictor.simulated and not types & _IN_TIME
        kept = not foreign and better(trial, here, rows=rows, noise=fitter.noise)
        examined.append(replace(correction, before=here.rmse, after=trial.rmse, kept=kept))
        if kept:
            steps.append((effect.id, trial))
            here = trial
    return steps, tuple(examined)
