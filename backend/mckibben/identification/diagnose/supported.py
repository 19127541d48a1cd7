"""Which effects of a model are called missing, and which it only holds to predict better."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mckibben.identification.diagnose.corrections import Correction
from mckibben.identification.diagnose.needed import needed
from mckibben.identification.diagnose.probability import (
    Evidence,
    ModelWeights,
    known_beside,
    loss,
    model_weights,
)
from mckibben.identification.diagnose.score import effective_rows
from mckibben.identification.diagnose.twins import Alternative
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.thresholds import PROBABILITY


@dataclass(frozen=True)
class Supported:
    """The effects of a model that are called missing.

    Attributes:
        firm: the model with these alone, refitted.
        evidence: of each of them.
        steps: the unlikely effects, the likeliest first, with the model that holds it and all before it.
        corrections: the same effects as corrections that are kept.
        weights: of the models that the search visited.
    """

    firm: FittedModel
    evidence: tuple[Evidence, ...]
    steps: tuple[tuple[str, FittedModel], ...]
    corrections: tuple[Correction, ...]
    weights: ModelWeights

    def without_any(self, root: FittedModel) -> Supported:
        """The same where none of its effects is called missing, nor held by the model."""
        further = tuple(
            Correction(item.effect, root.rmse, self.firm.rmse, item.loss, share=item.share * item.known)
            for item in self.evidence
        )
        dropped = tuple(replace(each, kept=False) for each in self.corrections)
        return replace(self, firm=root, evidence=(), steps=(), corrections=(*further, *dropped))


def supported(
    fitter: Fitter,
    model: FittedModel,
    root: FittedModel,
    others: Sequence[Alternative],
    *,
    noise: float,
    unknown: float | None = None,
    enough: bool = True,
) -> Supported:
    """The effects that the start model lacks, and those that are less likely than `PROBABILITY.likely`.

    Where the model with them leaves noise alone, the likeliest is always called missing: something is. Beside
    a rest that no effect explains, an effect is called missing that is likelier there than not.

    Args:
        fitter: of the search.
        model: the best model.
        root: the start model, fitted.
        others: effects that could replace its effects.
        noise: of the scaled residual.
        unknown: noise over which a rest is left that no effect explains; None without one.
        enough: whether what the model leaves is proved to be noise.
    """
    known = 1.0 if unknown is None else known_beside(model, root, noise=unknown)
    predictor = fitter.predictor
    weights = model_weights(
        fitter.known.values(),
        root,
        rows=effective_rows(model.residual, predictor.sweeps, predictor.folds),
        noise=fitter.noise,
        implausible=model.implausible,
    )
    rubbing = {effect.id for effect in (*model.fit_model.effects, *fitter.candidates) if effect.dry_friction}
    evidence = []
    for name in model.fit_model.ids:
        if name not in root.fit_model.ids:
            group = (name, *(other.effect for other in others if other.of == name))
            without = fitter.dropping(model, name)
            lost = loss(model, without, root, noise=noise)
            laws = rubbing.difference(model.fit_model.ids) if name in rubbing else frozenset()
            share = weights.share({*group, *laws}) * needed(model, without)
            evidence.append(Evidence(name, group, share, lost, known))
    ordered = sorted(evidence, key=lambda item: item.probability)
    some = ordered[:-1] if enough else ordered
    unlikely = [
        item
        for item in some
        if item.probability < (PROBABILITY.likely if unknown is None else PROBABILITY.even)
    ]
    # Where the data decide nothing, the model keeps nothing that is not called missing.
    kept = len(unlikely) < len(evidence) or unknown is not None
    firm, steps, corrections = model, [], []
    for item in unlikely:
        without = fitter.dropping(firm, item.effect)
        if kept:
            steps.insert(0, (item.effect, firm))
        share = item.share * item.known
        corrections.append(
            Correction(item.effect, without.rmse, firm.rmse, item.loss, kept=kept, share=share)
        )
        firm = without
    firmly = tuple(item for item in evidence if item not in unlikely)
    return Supported(firm, firmly, tuple(steps), tuple(corrections), weights)
