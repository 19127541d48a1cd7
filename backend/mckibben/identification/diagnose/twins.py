"""Effects that the data cannot distinguish."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mckibben.identification.diagnose.probability import log_preference, log_weight
from mckibben.identification.diagnose.score import better, effective_rows, score
from mckibben.identification.diagnose.search import exchanged, lean
from mckibben.identification.diagnose.usual import as_usual
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.fit.misfit import penalised
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.identification.thresholds import TWINS
from mckibben.physics.effect import Effect


@dataclass(frozen=True)
class Alternative:
    """An effect that could replace one of the model.

    Attributes:
        of: the effect of the model.
        effect: the possible replacement.
        difference: rms difference of the fitted predictions over the noise; of several measurements, in the
            one where it is largest.
        fitted_model: the model with the exchange.
    """

    of: str
    effect: str
    difference: float
    fitted_model: FittedModel


def alternatives(fitter: Fitter, best: FittedModel, added: Sequence[str], noise: float) -> list[Alternative]:
    """The effects that fit as well when they replace an added effect and everything is refitted.

    Such an effect predicts the same within the noise, or has a parallel sensitivity, or its likelihood does
    not decide against it. One that only imitates the other is none: the data refute it as it is declared, and
    it fits where further constants make it act as the simpler one does, and neither the data nor the prior
    prefer it.
    """
    equivalent = []
    rows = effective_rows(best.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    for effect_id in added:
        less = fitter.dropping(best, effect_id)
        inside = set(best.fit_model.ids)
        others = [effect for effect in fitter.candidates if effect.id not in inside]
        replaced = next(effect for effect in best.fit_model.effects if effect.id == effect_id)
        sensitivity = fitter.changes(less, replaced)
        kept = _unfitted(fitter, best.fit_model.without(effect_id), less)
        for effect in _worth_fitting(fitter, less, others):
            fitted_model = exchanged(fitter, less, effect)
            if fitted_model.rmse > TWINS.as_good * best.rmse:
                fitted_model = _in_its_place(fitter, kept, effect, fitted_model)
            if TWINS.as_good * best.rmse < fitted_model.rmse < TWINS.near * best.rmse:
                fitted_model = _with_own_law(fitter, best, effect, fitted_model)
            difference = _difference(fitted_model, best, fitter.predictor) / noise
            cosine = _cosine(sensitivity, fitter.changes(less, effect))
            parallel = abs(cosine) > TWINS.cosine and fitted_model.rmse <= TWINS.as_good * best.rmse
            excess = (fitted_model.mean_square - best.mean_square) / noise**2
            if not (difference < TWINS.same or parallel or rows * excess < TWINS.undecided):
                continue
            if difference < TWINS.imitated and _imitates(
                fitter, best, fitted_model, fitter.adding(less, effect)
            ):
                continue
            equivalent.append(Alternative(effect_id, effect.id, difference, fitted_model))
        if fitter.effort.thorough and _beyond_declared(best, replaced):
            found = {each.effect for each in equivalent if each.of == effect_id}
            equivalent += _by_two(fitter, best, less, effect_id, found, noise)
    return equivalent


def _beyond_declared(best: FittedModel, effect: Effect) -> bool:
    """Whether a fit has changed further constants of an effect, free or fixed where their definition ends."""
    moved = (p for p in effect.parameters if not p.fitted)
    values = best.fit_model.values[effect.id]
    return any(f"{effect.id}.{p.name}" in best.freed or values[p.name] != p.default for p in moved)


def _unfitted(fitter: Fitter, fit_model: FitModel, like: FittedModel) -> FittedModel:
    """A model as it is, with the free numbers of a fitted one."""
    predictor = fitter.predictor
    residual, lost = penalised(predictor, predictor.residual(fit_model))
    return replace(like, fit_model=fit_model, residual=residual, lost=lost)


def _in_its_place(fitter: Fitter, kept: FittedModel, effect: Effect, exchange: FittedModel) -> FittedModel:
    """An exchange from another start, if that is closer to the data than where the fit ended.

    Without the dropped effect the others have taken over what they can of it, and a fit may not lead back.

    Args:
        fitter: of the search.
        kept: the best model without the dropped effect, the others as they are in the best one.
        effect: the one in its place.
        exchange: the fit that began where the others had taken over.
    """
    start = fitter.guessed(kept, effect)
    if start.rmse >= exchange.rmse:
        return exchange
    freed = kept.freed | {name for name in exchange.freed if name.startswith(f"{effect.id}.")}
    return min(fitter.fit(start.fit_model, freed, again=True), exchange, key=lambda each: each.rmse)


def _with_own_law(fitter: Fitter, best: FittedModel, effect: Effect, exchange: FittedModel) -> FittedModel:
    """An exchange with further constants of the effect, if left-out groups are closer to it than to the best
    model; the search counts constants, and so prefers a law that needs fewer.
    """
    rivals = [
        other
        for other in fitter.freeing(exchange, effect)
        if other.holdout_rmse < best.holdout_rmse and other.implausible <= best.implausible
    ]
    return min(rivals, key=lambda other: other.holdout_rmse, default=exchange)


def _by_two(
    fitter: Fitter, best: FittedModel, less: FittedModel, of: str, found: Collection[str], noise: float
) -> list[Alternative]:
    """Two effects in the place of one whose further constants act as a second effect does.

    Args:
        fitter, best: as of `alternatives`.
        less: the best model without the effect.
        of: the effect.
        found: effects that replace it alone.
        noise: of the scaled residual.
    """
    rows = effective_rows(best.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    inside = {*best.fit_model.ids, *found}
    others = [effect for effect in fitter.candidates if effect.id not in inside]
    ones = [(effect, exchanged(fitter, less, effect)) for effect in _worth_fitting(fitter, less, others)]
    pairs = []
    for first, one in sorted(ones, key=lambda pair: pair[1].rmse)[: TWINS.halves]:
        for second in fitter.promising(one, [e for e in others if e is not first])[: TWINS.seconds]:
            both = fitter.adding(one, second)
            excess = (both.mean_square - best.mean_square) / noise**2
            lean_enough = both.implausible <= best.implausible and len(both.free) <= len(best.free) + 1
            if lean_enough and rows * excess < TWINS.undecided:
                difference = _difference(both, best, fitter.predictor) / noise
                pairs.append(Alternative(of, first.id, difference, both))
                break
    return pairs


def _imitates(fitter: Fitter, best: FittedModel, other: FittedModel, declared: FittedModel) -> bool:
    """Whether a model that predicts the same only imitates the best one.

    Args:
        fitter: of both.
        best: the best model.
        other: with another effect, some further constants of which are free.
        declared: the same with those constants as the effect declares them.
    """
    if declared is other or len(other.free) <= len(best.free) or not fitter.noise:
        return False
    rows = effective_rows(best.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    excess = (declared.mean_square - best.mean_square) / fitter.noise**2
    refuted = (
        rows * excess >= TWINS.undecided
        and _difference(declared, best, fitter.predictor) >= TWINS.same * fitter.noise
    )
    weights = [log_weight(model, rows=rows, noise=fitter.noise) for model in (other, best)]
    return refuted and weights[0] <= weights[1]


def _difference(one: FittedModel, two: FittedModel, predictor: Predictor) -> float:
    """Rms difference of two predictions in the measurement where it is largest, of the scaled residual."""
    squares = (one.residual - two.residual) ** 2
    if not isinstance(predictor, SpecimensPredictor):
        return float(np.sqrt(np.mean(squares)))
    parts = [squares[predictor.specimen == number] for number in range(len(predictor.specimens))]
    return float(np.sqrt(max(np.mean(part) for part in parts if len(part))))


def likeliest(
    fitter: Fitter,
    best: FittedModel,
    added: Sequence[str],
    noise: float,
    *,
    root: FittedModel,
    never: Collection[str] = (),
) -> tuple[FittedModel, list[Alternative]]:
    """The likeliest of the models that fit as well, and the alternatives to its effects.

    Where an alternative has the larger weight, by prior and evidence, it takes the place of the effect; not
    where it is worse as soon as both models hold the corrections.

    Args:
        fitter: of the search.
        best: its best model.
        added: effects that may be replaced.
        noise: of the scaled residual.
        root: the start model, fitted.
        never: the corrections: effects that only corrected another one's form, and so do not take its place.
    """
    names = list(added)
    rows = effective_rows(best.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    others = alternatives(fitter, best, names, noise)
    for _ in range(len(names)):
        plausible = [
            other
            for other in others
            if other.fitted_model.implausible <= best.implausible and other.effect not in never
        ]
        preference = partial(log_preference, rows=rows, noise=fitter.noise)
        plausible.sort(key=lambda other: -preference(other.fitted_model))
        preferred = (
            other.fitted_model
            for other in plausible
            if preference(other.fitted_model) > preference(best)
            and not better(
                _with(fitter, best, never),
                _with(fitter, other.fitted_model, never),
                rows=rows,
                noise=fitter.noise,
            )
        )
        chosen = next(preferred, None)
        if chosen is None:
            break
        best = lean(fitter, chosen, root)
        names = [name for name in best.fit_model.ids if name not in root.fit_model.ids]
        others = alternatives(fitter, best, names, noise)
    value = partial(score, rows=rows, noise=fitter.noise)
    others = [
        replace(other, fitted_model=as_usual(fitter, other.fitted_model, {*names, other.effect}, value=value))
        for other in others
    ]
    return as_usual(fitter, best, names, value=value), others


def _with(fitter: Fitter, fitted_model: FittedModel, corrections: Collection[str]) -> FittedModel:
    """The model with corrections as well, refitted; itself where there are none."""
    for effect in fitter.candidates:
        if effect.id in corrections and effect.id not in fitted_model.fit_model.ids:
            fitted_model = fitter.adding(fitted_model, effect)
    return fitted_model


def _worth_fitting(fitter: Fitter, less: FittedModel, others: Sequence[Effect]) -> list[Effect]:
    """Effects in the place of a dropped one whose first-order gain is large, at least the first ones."""
    gains = fitter.gains(less, others)
    least = TWINS.promise * max(gains.values(), default=0.0)
    ordered = sorted(others, key=lambda effect: -gains[effect.id])
    return [
        effect for place, effect in enumerate(ordered) if place < TWINS.tried or gains[effect.id] >= least
    ]


def same_predictions(fitted_models: Sequence[tuple[str, FittedModel]], noise: float) -> dict[str, list[str]]:
    """Effect -> the others whose fitted model predicts the same."""
    twins: dict[str, list[str]] = {name: [] for name, _ in fitted_models}
    for number, (first, one) in enumerate(fitted_models):
        for second, two in fitted_models[number + 1 :]:
            if same(one, two, noise):
                twins[first].append(second)
                twins[second].append(first)
    return twins


def same(one: FittedModel, two: FittedModel, noise: float) -> bool:
    """Whether the predictions of two fitted models are the same within the noise."""
    return bool(np.mean((one.residual - two.residual) ** 2) < (TWINS.same * noise) ** 2)


def _cosine(first: np.ndarray, second: np.ndarray) -> float:
    pairs = [
        float(a @ b) / (np.linalg.norm(a) * np.linalg.norm(b))
        for a in first.T
        for b in second.T
        if np.any(a) and np.any(b)
    ]
    return float(max(pairs, key=abs, default=0.0))
