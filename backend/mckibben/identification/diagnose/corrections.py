"""Effects of a best model that are rather corrections of another effect's inexact form.

A search adds whatever lowers the error on the groups left out by more than chance. Where a formula of the
catalogue differs a little from the real muscle, that includes effects that the muscle does not have. They are
small beside the noise and beside what the whole model explains, so their calibrated probability is low.
"""

from __future__ import annotations

from dataclasses import dataclass

from mckibben.identification.diagnose.probability import LIKELY, Loss, loss
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter


@dataclass(frozen=True)
class Correction:
    """An effect that lowers the error but is not called missing.

    Attributes:
        effect: its id.
        before, after: error of the model without and with it, scaled as the residual.
        loss: what the model loses without it.
    """

    effect: str
    before: float
    after: float
    loss: Loss

    @property
    def probability(self) -> float:
        """Probability that it is missing nevertheless."""
        return self.loss.probability


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
        if losses[least].probability >= LIKELY:
            return best, tuple(corrections)
        corrections.append(Correction(least, trials[least].rmse, best.rmse, losses[least]))
        best = trials[least]
