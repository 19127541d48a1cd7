"""Which effects of a model are called missing, and which it only holds to predict better."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from mckibben.identification.diagnose.corrections import Correction
from mckibben.identification.diagnose.needed import needed
from mckibben.identification.diagnose.probability import (
    Evidence,
    ModelWeights,
    known_beside,
    likelier_than_any_formula,
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

    def without_corrections(self) -> Supported:
        """The same where the model holds only what is called missing."""
        return replace(
            self, steps=(), corrections=tuple(replace(each, kept=False) for each in self.corrections)
        )

    def without_any(self, root: FittedModel) -> Supported:
        """The same where none of its effects is called missing, nor held by the model."""
        further = tuple(
            Correction(item.effect, root.rmse, self.firm.rmse, item.loss, share=item.share * item.known)
            for item in self.evidence
        )
        bare = self.without_corrections()
        return replace(bare, firm=root, evidence=(), corrections=(*further, *bare.corrections))


def supported(
    fitter: Fitter,
    model: FittedModel,
    root: FittedModel,
    others: Sequence[Alternative],
    *,
    noise: float,
    beside: Callable[[FittedModel], float | None] = lambda _: None,
    unknown: float | None = None,
    left: bool = False,
    enough: bool = True,
) -> Supported:
    """The effects that the start model lacks, without the least likely one after the other.

    Where the model with them leaves noise alone, the likeliest is called missing unless a free surface is
    likelier: something is. Beside a rest that no effect explains, an effect is called missing that is
    likelier there than not. The model keeps what is not called missing, because it predicts better with it.

    Args:
        fitter: of the search.
        model: the best model.
        root: the start model, fitted.
        others: effects that could replace its effects.
        noise: of the scaled residual.
        beside: log evidence of a model beside a free surface; None where the rows are too few for one.
        unknown: noise over which a rest is left that no effect explains; None without one.
        left: whether that rest is more than a free surface explains, so that the evidence beside it is no
            whole comparison.
        enough: whether what the model leaves is proved to be noise.
    """
    predictor = fitter.predictor
    weights = model_weights(
        fitter.known.values(),
        root,
        rows=effective_rows(model.residual, predictor.sweeps, predictor.folds),
        noise=fitter.noise,
        implausible=model.implausible,
    )
    rubbing = {effect.id for effect in (*model.fit_model.effects, *fitter.candidates) if effect.dry_friction}
    least_known = PROBABILITY.likely if unknown is None else PROBABILITY.even

    def evidence_of(held: FittedModel, name: str) -> Evidence:
        group = (name, *(other.effect for other in others if other.of == name))
        without = fitter.dropping(held, name)
        laws = rubbing.difference(held.fit_model.ids) if name in rubbing else frozenset()
        share = weights.share({*group, *laws}) * needed(held, without)
        known = likelier_than_any_formula(held, without, beside, noise=noise)
        if left and unknown is not None:
            known *= known_beside(held, root, noise=unknown)
        return Evidence(name, group, share, loss(held, without, root, noise=noise), known)

    firm, dropped = model, list[Evidence]()
    while True:
        names = [name for name in firm.fit_model.ids if name not in root.fit_model.ids]
        evidence = [evidence_of(firm, name) for name in names]
        least = min(evidence, key=lambda item: item.probability, default=None)
        last = enough and len(evidence) == 1
        if least is None or least.probability >= least_known or (last and least.known >= PROBABILITY.even):
            break
        dropped.append(least)
        firm = fitter.dropping(firm, least.effect)
    # Where the data decide nothing, the model keeps nothing that is not called missing.
    kept = [item.effect for item in dropped if evidence or unknown is not None]

    def holding(back: Sequence[str]) -> FittedModel:
        held = model
        for item in dropped:
            held = held if item.effect in back else fitter.dropping(held, item.effect)
        return held

    steps = [(name, holding(kept[place:])) for place, name in reversed(list(enumerate(kept)))]
    corrections, before = [], model
    for item in dropped:
        without = fitter.dropping(before, item.effect)
        corrections.append(
            Correction(
                item.effect, without.rmse, before.rmse, item.loss, kept=item.effect in kept,
                share=item.share * item.known, formula=item.known < PROBABILITY.even,
            )
        )  # fmt: skip
        before = without
    return Supported(firm, tuple(evidence), tuple(steps), tuple(corrections), weights)
