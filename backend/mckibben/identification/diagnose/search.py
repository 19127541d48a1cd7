"""Which effects are missing: models are built up in a beam, then every effect has to defend its place.

One effect at a time hides pairs that only help together, and near-twins share their credit, so several models
go on at once, ranked by `mckibben.identification.diagnose.score`. From each, every candidate is added and all
numbers are refitted jointly; further constants of an effect are freed before another effect is believed. At
the end each effect is dropped and exchanged, and what is not needed goes.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.identification.diagnose.score import LEAST_SCORE, better, effective_rows, score
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.physics.effect import Effect

_BEAM = 4
_TRIED = 8  # candidates fitted per model, by what they promise to first order
_PATIENCE = 2  # rounds without a better model
_ALIKE = 0.02  # of the mean square: models whose residuals differ by less go on as one
_DEEPEST = 7  # effects added
_NOTHING_LEFT = 1.05  # of the noise: below, a search can learn nothing more
_WITHIN = 1.15  # of the best error, near the floor


def search(fitter: Fitter, root: FittedModel, *, singles: Sequence[FittedModel]) -> FittedModel:
    """The best model that effects can make of a fitted start model.

    Args:
        fitter: fits.
        root: the start model.
        singles: the start model with each single candidate.
    """
    best, idle = root, 0
    if _at_floor(fitter, root):
        return root
    children = list(singles)
    for _ in range(_DEEPEST):
        children = [n for n in {child.key: child for child in children}.values() if n.rmse < root.rmse]
        if not children:
            break
        rows = _rows(fitter, min(children, key=lambda fitted_model: fitted_model.rmse))
        children.sort(key=lambda fitted_model: score(fitted_model, rows=rows, noise=fitter.noise))
        first = next((fitted_model for fitted_model in children if not fitted_model.implausible), children[0])
        fitter.listen(first)
        if _at_floor(fitter, first) and better(first, best, rows=_rows(fitter, first), noise=fitter.noise):
            best = first
            break
        beam = [with_further_constants(fitter, n, _examined(fitter, n, root)) for n in children[: 2 * _BEAM]]
        beam = _different(beam)[:_BEAM]
        leader = min(
            beam,
            key=lambda fitted_model: (
                fitted_model.implausible > 0,
                score(fitted_model, rows=rows, noise=fitter.noise),
            ),
        )
        whole = with_further_constants(fitter, leader)
        beam, leader = [whole if fitted_model is leader else fitted_model for fitted_model in beam], whole
        idle += 1
        fitter.listen(leader)
        if better(leader, best, rows=_rows(fitter, leader), noise=fitter.noise):
            best, idle = leader, 0
        if idle >= _PATIENCE or _at_floor(fitter, best):
            break
        if fitter.near_floor(best):  # what is far from it now will not come first
            beam = [fitted_model for fitted_model in beam if fitted_model.rmse < _WITHIN * best.rmse]
        children = []
        for fitted_model in beam:
            inside = set(fitted_model.fit_model.ids)
            others = [effect for effect in fitter.candidates if effect.id not in inside]
            children += [
                fitter.adding(fitted_model, effect)
                for effect in fitter.promising(fitted_model, others)[: min(_TRIED, fitter.effort.tried)]
            ]
    return _polished(fitter, best, root)


def _examined(fitter: Fitter, fitted_model: FittedModel, root: FittedModel) -> list[Effect]:
    """Effects whose further constants are tried in every model: all; where runs are dear what was added."""
    start = () if fitter.effort.thorough else root.fit_model.ids
    return [effect for effect in fitted_model.fit_model.effects if effect.id not in start]


def with_further_constants(
    fitter: Fitter, fitted_model: FittedModel, effects: Sequence[Effect] | None = None
) -> FittedModel:
    """The node with further constants freed where that earns its price: of some effects, or of all."""
    if _at_floor(fitter, fitted_model):
        return fitted_model
    for effect in fitted_model.fit_model.effects if effects is None else effects:
        others = [
            n
            for n in fitter.freeing(fitted_model, effect)
            if better(n, fitted_model, rows=_rows(fitter, n), noise=fitter.noise)
        ]
        if others:
            rows = _rows(fitter, min(others, key=lambda n: n.rmse))
            fitted_model = min(others, key=lambda n: score(n, rows=rows, noise=fitter.noise))
    return fitted_model


def exchanged(fitter: Fitter, less: FittedModel, effect: Effect) -> FittedModel:
    """A model with another effect in the place of one that was dropped."""
    return with_further_constants(fitter, fitter.adding(less, effect), [effect])


def lean(fitter: Fitter, fitted_model: FittedModel, root: FittedModel) -> FittedModel:
    """The node without freed constants that do not earn their price, which they may have done earlier."""
    while True:
        rows = _rows(fitter, fitted_model)
        less = [
            fitter.holding(fitted_model, name, _held(name, fitted_model, root))
            for name in sorted(fitted_model.freed - root.freed)
        ]
        less = [other for other in less if other.free and other.implausible <= fitted_model.implausible]
        found = min(less, key=lambda n: score(n, rows=rows, noise=fitter.noise), default=fitted_model)
        if score(found, rows=rows, noise=fitter.noise) >= score(fitted_model, rows=rows, noise=fitter.noise):
            return fitted_model
        fitted_model = found


def _held(name: str, fitted_model: FittedModel, root: FittedModel) -> float:
    """A further constant where no fit changes it: as the start model says, or the effect's default."""
    effect_id, _, parameter = name.partition(".")
    if effect_id in root.fit_model.ids:
        return root.fit_model.number(name)
    effect = next(effect for effect in fitted_model.fit_model.effects if effect.id == effect_id)
    return effect.parameter(parameter).default


def _polished(fitter: Fitter, best: FittedModel, root: FittedModel) -> FittedModel:
    """Drop what is not needed, exchange what another effect does better, until nothing changes."""
    start = set(root.fit_model.ids)
    best = lean(fitter, best, root)
    for _ in range(_DEEPEST):
        rows = _rows(fitter, best)
        before = best
        for effect_id in best.fit_model.ids:
            if effect_id in start:
                continue
            less = fitter.dropping(best, effect_id)
            needed = better(best, less, rows=rows, noise=fitter.noise)
            if not needed and less.implausible <= best.implausible:
                best = less
                break
            if _at_floor(fitter, best):
                continue
            inside = set(best.fit_model.ids)
            others = [effect for effect in fitter.candidates if effect.id not in inside]
            swaps = [exchanged(fitter, less, effect) for effect in fitter.promising(less, others)[:_BEAM]]
            swaps = [
                lean(fitter, fitted_model, root) if _as_good(fitted_model, best) else fitted_model
                for fitted_model in swaps
            ]
            swaps = [fitted_model for fitted_model in swaps if fitted_model.implausible <= best.implausible]
            here = score(best, rows=rows, noise=fitter.noise)
            found = min(
                swaps,
                key=lambda fitted_model: score(fitted_model, rows=rows, noise=fitter.noise),
                default=best,
            )
            if score(found, rows=rows, noise=fitter.noise) < here - LEAST_SCORE:
                best = found
                break
        if best is before:
            return best
    return best


def _as_good(fitted_model: FittedModel, best: FittedModel) -> bool:
    return fitted_model.mean_square < (1.0 + _ALIKE) * best.mean_square


def _different(fitted_models: Sequence[FittedModel]) -> list[FittedModel]:
    """The nodes without those whose prediction an earlier one makes as well."""
    kept: list[FittedModel] = []
    for fitted_model in fitted_models:
        if all(
            np.mean((fitted_model.residual - other.residual) ** 2) > _ALIKE * fitted_model.mean_square
            for other in kept
        ):
            kept.append(fitted_model)
    return kept


def _rows(fitter: Fitter, fitted_model: FittedModel) -> float:
    return effective_rows(fitted_model.residual, fitter.predictor.sweeps, fitter.predictor.folds)


def _at_floor(fitter: Fitter, fitted_model: FittedModel) -> bool:
    return fitter.noise is not None and fitted_model.rmse <= _NOTHING_LEFT * fitter.noise
