r"""Probability that an effect is missing, from all models that a search visited.

The weight of a visited model M is its prior times its evidence,

.. math:: w(M) \propto \prod_{e \in M} \frac{p_e}{1-p_e}\; e^{-S(M)/2}

with the prior :math:`p_e` of each added effect and the score S of
`mckibben.identification.diagnose.score`, whose difference is -2 times a log likelihood on groups left out.
The weight of an effect, or of a group of effects that the data cannot tell apart, is the share of the models
that hold it. Models of the search are never exact: an effect of a slightly wrong form lets another one in
that repairs it, with overwhelming weight. `Loss.probability` allows for that: such corrections are small
beside what the whole model explains. The laws of dry friction share one weight: two of them that repair each
other are no evidence against the friction of a third one.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mckibben.identification.diagnose.score import score, score_within
from mckibben.identification.diagnose.wrong_entry import WrongEntry
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.thresholds import PROBABILITY, SCORE
from mckibben.physics.effect import Effect

_TINY = 1e-12


@dataclass(frozen=True)
class ModelWeights:
    """Weights of the visited models by the effects that they add to the start model; they sum to 1."""

    weights: Mapping[frozenset[str], float]

    def share(self, effects: Collection[str]) -> float:
        """Share of the models that hold at least one of the effects."""
        wanted = set(effects)
        return float(sum(weight for added, weight in self.weights.items() if added & wanted))


def model_weights(
    models: Iterable[FittedModel],
    root: FittedModel,
    *,
    rows: float,
    noise: float | None,
    implausible: int = 0,
) -> ModelWeights:
    """Weights of models, one for each set of effects: the best of those that differ in freed constants.

    Args:
        models: the visited models; those without all effects of the start model do not count.
        root: the fitted start model.
        rows: effective number of rows, the same for all.
        noise: of the scaled residual.
        implausible: most parameters at bounds or not separable, those of the best model; models with more
            do not count, because no search would choose them.
    """
    start = frozenset(root.fit_model.ids)
    logarithms: dict[frozenset[str], float] = {}
    for model in (root, *models):
        present = frozenset(model.fit_model.ids)
        if not start <= present or model.lost:
            continue
        if model is not root and model.implausible > implausible:
            continue
        value = log_weight(model, rows=rows, noise=noise)
        key = present - start
        logarithms[key] = max(value, logarithms.get(key, -np.inf))
    highest = max(logarithms.values())
    powers = {added: float(np.exp(value - highest)) for added, value in logarithms.items()}
    total = sum(powers.values())
    return ModelWeights({added: power / total for added, power in powers.items()})


def log_weight(model: FittedModel, *, rows: float, noise: float | None) -> float:
    """Logarithm of a model's weight, up to a constant: prior odds of its effects and evidence."""
    return sum(map(log_odds, model.fit_model.effects)) - 0.5 * score(model, rows=rows, noise=noise)


def log_preference(model: FittedModel, *, rows: float, noise: float | None) -> float:
    """Like `log_weight`, but half of the evidence is the error within the data.

    Of two models that fit about as well, one group left out may prefer the worse law by chance.
    """
    evidence = score(model, rows=rows, noise=noise) + score_within(model, rows=rows, noise=noise)
    return sum(map(log_odds, model.fit_model.effects)) - 0.25 * evidence


def log_odds(effect: Effect) -> float:
    """Logarithm of the odds of an effect before any data."""
    return float(np.log(effect.prior.share / (1.0 - effect.prior.share)))


#: Logistic regression of "the effect is really missing" on the logarithms of its size and part, fitted by
#: `python -m tests.benchmarks.probabilities` to half of the cases; the other half shows how well it holds.
_CONSTANT, _BY_SIZE, _BY_PART = 1.97, 1.17, 1.14


@dataclass(frozen=True)
class Evidence:
    """What speaks for one effect of the best model.

    Attributes:
        effect: its id.
        group: it and the effects that the data cannot tell from it.
        share: of the visited models, by weight, that hold one of the group, times the probability that
            correlated noise does not explain it as well.
        loss: what the best model loses without it.
        known: probability that it does not imitate the unknown effect that remains beside it.
        entries_right: probability that no entry is wrong whose correction does without the group.
        read: whether it is read from the data before the search, so that no model does without it.
    """

    effect: str
    group: tuple[str, ...]
    share: float
    loss: Loss
    known: float = 1.0
    entries_right: float = 1.0
    read: bool = False

    @property
    def probability(self) -> float:
        """Probability that one of the group is really missing."""
        if self.read:
            return PROBABILITY.read
        return self.share * self.loss.probability * self.known * self.entries_right


@dataclass(frozen=True)
class Loss:
    """What a model loses without one of its effects.

    Attributes:
        size: root of the added mean square, in standard deviations of the noise.
        part: the same as a share of all that the model explains.
    """

    size: float
    part: float

    @property
    def probability(self) -> float:
        """Calibrated probability that the effect is missing, not a correction of another one's form."""
        logit = _CONSTANT + _BY_SIZE * np.log(self.size + _TINY) + _BY_PART * np.log(self.part + _TINY)
        return float(1.0 / (1.0 + np.exp(-np.clip(logit, -50.0, 50.0))))


def loss(best: FittedModel, without: FittedModel, root: FittedModel, *, noise: float) -> Loss:
    """What a model loses without an effect.

    Args:
        best: the model.
        without: the same without the effect, refitted; where its runs stop it counts as the start model, from
            which it differs by more free numbers.
        root: the fitted start model.
        noise: of the scaled residual.
    """
    without = root if without.lost else without
    lost = max(without.mean_square - best.mean_square, 0.0)
    explained = max(root.mean_square - best.mean_square, lost, 1e-300)
    return Loss(float(np.sqrt(lost)) / noise, float(np.sqrt(lost / explained)))


def likelier_than_any_formula(
    held: FittedModel,
    without: FittedModel,
    beside: Callable[[FittedModel], float | None],
    *,
    noise: float | None,
) -> float:
    r"""Probability that an effect is there, and not some formula of the same variables in its place.

    Both models stand beside a free surface, which takes what they leave:
    :math:`\ln\frac{P}{1-P} = \ln o_e + \ln Z_1 - \ln Z_0`. What acts as no effect of the catalogue does
    leaves a surface as likely alone as with the effects that together imitate it. Where the model leaves
    noise alone, so that the surface is needed without the effect only, the odds that nothing unknown acts
    come to it.

    Args:
        held: the model with the effect.
        without: the same without it, refitted.
        beside: log evidence of a model beside a surface; None where there is none, which proves nothing.
        noise: of the scaled residual.
    """
    with_it, without_it = (None, None) if without.lost else (beside(held), beside(without))
    if with_it is None or without_it is None:
        return 1.0
    odds = with_it - without_it
    if noise is not None and held.rmse <= SCORE.at_floor * noise < without.rmse:
        odds += float(np.log((1.0 - PROBABILITY.unknown) / PROBABILITY.unknown))
    odds += sum(log_odds(e) for e in held.fit_model.effects if e.id not in without.fit_model.ids)
    return float(1.0 / (1.0 + np.exp(-np.clip(odds, -50.0, 50.0))))


def known_beside(model: FittedModel, root: FittedModel, *, noise: float) -> float:
    r"""Probability that effects are there which stand beside a rest that no effect of the catalogue explains.

    What acts in such a rest may as well act in what the effects explain: :math:`(1 - l)^2`, with the share l
    of the start model's error above the noise that the rest has. Of 12 effects named beside an unknown one in
    the cases of other examiners 4 were there.

    Args:
        model: the best model.
        root: the start model, fitted.
        noise: of the scaled residual.
    """
    left, whole = (max(each.mean_square - noise**2, 0.0) for each in (model, root))
    return (1.0 - float(np.sqrt(min(left / whole, 1.0)))) ** 2 if whole > 0.0 else 1.0


def beside(evidence: Iterable[Evidence], context: Sequence[WrongEntry]) -> tuple[Evidence, ...]:
    """The evidence of effects beside the entries that may be wrong."""
    return tuple(replace(item, entries_right=entries_right(context, item.group)) for item in evidence)


def entries_right(context: Sequence[WrongEntry], group: Collection[str]) -> float:
    """Probability that no entry is wrong whose correction explains the data without a group of effects.

    One of them is wrong, or none: their odds against the effects add. What only explains the data as well has
    the odds of such a mistake, the same against a common effect as against a rare one; what the user has
    ruled out has none.

    Args:
        context: the evidence about entries.
        group: ids of the effects, which the data cannot tell apart.
    """
    odds = 0.0
    for found in instead_of(context, group):
        against = found.confidence / (1.0 - found.confidence)
        odds += against if found.stands else min(against, found.entry.prior)
    return 1.0 / (1.0 + odds)


def instead_of(context: Sequence[WrongEntry], group: Collection[str]) -> list[WrongEntry]:
    """The entries whose correction explains the data without a group of effects, but for those ruled out."""
    return [
        found
        for found in context
        if not found.kept and set(group) & set(found.instead_of) and not set(group) & set(found.effects)
    ]


def none_likely(evidence: Collection[Evidence]) -> bool:
    """Whether effects are named, and it is likelier that none of them is missing than that one is.

    With the entries as stated: a wrong one is asked about or named, and is no reason to look for new physics.

    Their probabilities count as independent: of two that each explain most of the error, one is missing.
    """
    return (
        bool(evidence)
        and float(np.prod([1.0 - item.probability for item in evidence])) > 1.0 - PROBABILITY.even
    )
