"""Search for the missing effects: a beam search, then backward elimination and exchange.

A greedy search misses pairs of effects that only help together, and may pick the wrong one of two similar
effects. So the search keeps several models, ranked by `mckibben.identification.diagnose.score`. It adds each
candidate to each model and refits all parameters jointly. Further constants of an effect are freed before
another effect is added. At the end each effect is tentatively dropped or exchanged; effects that are not
needed are removed. Where the error is still far above the noise, two steps are tried at once
(`mckibben.identification.diagnose.two_steps`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from mckibben.identification.diagnose.extremes import reaching_farthest
from mckibben.identification.diagnose.score import better, effective_rows, score, score_within
from mckibben.identification.diagnose.two_steps import two_steps_ahead
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.thresholds import SCORE, SEARCH
from mckibben.physics.effect import Effect


def search(fitter: Fitter, root: FittedModel, *, singles: Sequence[FittedModel]) -> FittedModel:
    """The best extension of a fitted start model by effects of the catalogue.

    Args:
        fitter: fits the models.
        root: the start model.
        singles: the start model plus each single candidate, fitted.
    """
    best, idle = root, 0
    # A simulation that rings seems to be noise: what an effect takes away was none.
    nearest = min(singles, key=lambda single: single.rmse, default=root)
    if nearest.rmse < SEARCH.rang * root.rmse:
        fitter.update_noise(nearest)
    if _at_floor(fitter, root):
        return root
    children = list(singles)
    for _ in range(SEARCH.deepest):
        each = {child.key: child for child in children}.values()
        children = [child for child in each if not child.lost and child.rmse < root.rmse]
        if not children:
            break
        rows = _rows(fitter, min(children, key=lambda fitted_model: fitted_model.rmse))
        children.sort(key=lambda fitted_model: score(fitted_model, rows=rows, noise=fitter.noise))
        first = next((fitted_model for fitted_model in children if not fitted_model.implausible), children[0])
        fitter.update_noise(first)
        if _at_floor(fitter, first) and better(first, best, rows=_rows(fitter, first), noise=fitter.noise):
            best = first
            break
        beam = [
            with_further_constants(fitter, n, _examined(fitter, n, root)) for n in children[: 2 * SEARCH.beam]
        ]
        wide = SEARCH.first if fitter.effort.thorough and best is root else SEARCH.beam
        beam = _different(beam)[:wide]
        leader = min(
            beam,
            key=lambda fitted_model: (
                fitted_model.implausible > 0,
                score(fitted_model, rows=rows, noise=fitter.noise),
            ),
        )
        whole = with_further_constants(fitter, leader)
        if whole.implausible > best.implausible:
            # Constants that were freed while an effect was still missing may have no place beside it.
            whole = _plausible(fitter, whole, root)
        beam, leader = [whole if fitted_model is leader else fitted_model for fitted_model in beam], whole
        idle += 1
        fitter.update_noise(leader)
        if better(leader, best, rows=_rows(fitter, leader), noise=fitter.noise):
            best, idle = leader, 0
        costly = not fitter.effort.thorough and fitter.near_floor(best)
        if idle >= (1 if costly else SEARCH.patience) or _at_floor(fitter, best):
            break
        if fitter.near_floor(best):  # a model far above the noise cannot become the best any more
            beam = [fitted_model for fitted_model in beam if fitted_model.rmse < SEARCH.within * best.rmse]
        children = []
        for fitted_model in beam:
            inside = set(fitted_model.fit_model.ids)
            others = [effect for effect in fitter.candidates if effect.id not in inside]
            children += [
                fitter.adding(fitted_model, effect)
                for effect in fitter.promising(fitted_model, others)[: min(SEARCH.tried, fitter.effort.tried)]
            ]
    best = _two_steps_on(fitter, _polished(fitter, best, root), root)
    best = _with_fewer_effects(fitter, best, root)
    rows, known = _rows(fitter, best), fitter.known.values()
    start = root.fit_model.ids
    return reaching_farthest(best, known, fitter.predictor, rows=rows, noise=fitter.noise, start=start)


def _examined(fitter: Fitter, fitted_model: FittedModel, root: FittedModel) -> list[Effect]:
    """Effects whose further constants are tried: all, or only the added ones when predictions are costly."""
    start = () if fitter.effort.thorough else root.fit_model.ids
    return [effect for effect in fitted_model.fit_model.effects if effect.id not in start]


def with_further_constants(
    fitter: Fitter, fitted_model: FittedModel, effects: Sequence[Effect] | None = None
) -> FittedModel:
    """The model with further constants of some effects (default: all) freed where the score improves."""
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
    """The model with an effect in place of a dropped one."""
    return with_further_constants(fitter, fitter.adding(less, effect), [effect])


def lean(fitter: Fitter, fitted_model: FittedModel, root: FittedModel) -> FittedModel:
    """The model without freed constants that no longer improve the score.

    They are fixed at their value in the start model or the effect's default, or of a simulation where their
    definition ends: between a linear and a square-root law, say, data that are near one often fit a mixture
    as well. Static maps are told apart more sharply, and inexact forms repair each other by such mixtures.
    """
    while True:
        rows = _rows(fitter, fitted_model)
        freed = sorted(fitted_model.freed - root.freed)
        reduced = [
            fitter.fixing(fitted_model, name, _fixed_value(name, fitted_model, root)) for name in freed
        ]
        reduced += [
            fitter.at_constant(replace(fitted_model, freed=fitted_model.freed - {name}), name, value)
            for name in freed
            for value in (_ends_of(name, fitted_model) if fitter.predictor.simulated else ())
            if value != _fixed_value(name, fitted_model, root)
        ]
        reduced = [other for other in reduced if other.free and other.implausible <= fitted_model.implausible]
        candidate = min(reduced, key=lambda n: score(n, rows=rows, noise=fitter.noise), default=fitted_model)
        if score(candidate, rows=rows, noise=fitter.noise) >= score(
            fitted_model, rows=rows, noise=fitter.noise
        ):
            return fitted_model
        fitter.known[candidate.key] = fitted_model = candidate


def _plausible(fitter: Fitter, fitted_model: FittedModel, root: FittedModel) -> FittedModel:
    """The model with freed constants fixed again until no more of them are implausible than without them."""
    whole = fitted_model
    while fitted_model.implausible:
        rows = _rows(fitter, fitted_model)
        reduced = [
            fitter.fixing(fitted_model, name, _fixed_value(name, fitted_model, root))
            for name in sorted(fitted_model.freed - root.freed)
        ]
        reduced = [other for other in reduced if other.free]
        if not reduced:
            return whole
        fitted_model = min(reduced, key=lambda n: (n.implausible, score(n, rows=rows, noise=fitter.noise)))
    return fitted_model


def _fixed_value(name: str, fitted_model: FittedModel, root: FittedModel) -> float:
    """Value of a further constant that is fixed again: of the start model, or the effect's default."""
    effect_id, _, parameter = name.partition(".")
    if effect_id in root.fit_model.ids:
        return root.fit_model.number(name)
    effect = next(effect for effect in fitted_model.fit_model.effects if effect.id == effect_id)
    return effect.parameter(parameter).default


def _ends_of(name: str, fitted_model: FittedModel) -> tuple[float, ...]:
    """The bounds of a constant whose definition ends there; none where muscles have a usual value.

    What equals that is told as unknown from the data (`mckibben.identification.diagnose.usual`).
    """
    effect_id, _, parameter = name.partition(".")
    effect = next((e for e in fitted_model.fit_model.effects if e.id == effect_id), None)
    declared = None if effect is None else effect.parameter(parameter)
    if declared is None or not declared.natural or declared.usual is not None:
        return ()
    return declared.lower, declared.upper


def ended(fitted_model: FittedModel, effects: Sequence[str]) -> list[str]:
    """Further constants of some effects that a fit has fixed where their definition ends."""
    found = []
    for effect in fitted_model.fit_model.effects:
        for p in effect.parameters if effect.id in effects else ():
            name = f"{effect.id}.{p.name}"
            value = fitted_model.fit_model.number(name)
            if not p.fitted and value != p.default and value in _ends_of(name, fitted_model):
                found.append(name)
    return found


def _polished(fitter: Fitter, best: FittedModel, root: FittedModel) -> FittedModel:
    """Drop effects that are not needed and exchange effects for better ones, until nothing changes."""
    start = set(root.fit_model.ids)
    best = lean(fitter, best, root)
    for _ in range(SEARCH.deepest):
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
            tried = fitter.promising(less, others)[: SEARCH.beam]
            if fitter.effort.thorough:
                tried += [e for e in fitter.flexible(less, others, SEARCH.flexible) if e not in tried]
            swaps = [exchanged(fitter, less, effect) for effect in tried]
            swaps = [
                lean(fitter, fitted_model, root) if _as_good(fitted_model, best) else fitted_model
                for fitted_model in swaps
            ]
            swaps = [fitted_model for fitted_model in swaps if fitted_model.implausible <= best.implausible]
            here = score(best, rows=rows, noise=fitter.noise)
            candidate = min(
                swaps,
                key=lambda fitted_model: score(fitted_model, rows=rows, noise=fitter.noise),
                default=best,
            )
            if score(candidate, rows=rows, noise=fitter.noise) < here - SCORE.least_score:
                best = candidate
                break
        if best is before:
            return best
    return best


def _with_fewer_effects(fitter: Fitter, best: FittedModel, root: FittedModel) -> FittedModel:
    """The best model, or one of fewer effects that the search passed by with more constants than it needs.

    One effect may do the work of two that were found one after the other: exchanging either of them alone
    leads nowhere.
    """
    start = set(root.fit_model.ids)
    nearest: dict[frozenset[str], FittedModel] = {}
    for model in sorted(fitter.known.values(), key=lambda each: each.rmse, reverse=True):
        effects = frozenset(model.fit_model.ids)
        fewer = start < effects and len(effects) < len(best.fit_model.ids)
        if fewer and model.implausible <= best.implausible and model.rmse < SEARCH.within * best.rmse:
            nearest[effects] = model
    models = sorted(nearest.values(), key=lambda each: each.rmse)[: SEARCH.beam]
    value = partial(score, rows=_rows(fitter, best), noise=fitter.noise)
    return min([best, *(lean(fitter, model, root) for model in models)], key=value)


def _two_steps_on(fitter: Fitter, best: FittedModel, root: FittedModel) -> FittedModel:
    """The best model, or what two steps at once from it or from others about as good lead to.

    Only where something is missing, the error is still far above the noise, and predictions cost little. The
    model there leaves out groups at least as well; half of the evidence is the error within the data.
    """
    start = set(root.fit_model.ids)
    while (
        best is not root and fitter.effort.thorough and fitter.noise and best.rmse > SEARCH.far * fitter.noise
    ):
        rows = _rows(fitter, best)
        value = partial(score, rows=rows, noise=fitter.noise)
        limit = value(best) + SCORE.least_score
        near = [
            model
            for model in fitter.known.values()
            if start <= set(model.fit_model.ids)
            and model.implausible <= best.implausible
            and value(model) <= limit
        ]
        near = _different(sorted([best, *near], key=value), SEARCH.exactly)[: 2 * SEARCH.beam]
        anew = [other for model in near for other in _chosen_anew(fitter, model, root)]
        near += [model for model in anew if value(model) <= limit]
        near = _different(sorted(near, key=value), SEARCH.exactly)[: 3 * SEARCH.beam]
        ahead = [lean(fitter, model, root) for model in two_steps_ahead(fitter, near)]
        ahead = [
            model
            for model in ahead
            if model.implausible <= best.implausible
            and model.mean_square < SEARCH.of_two * best.mean_square
            and value(model) <= value(best)
        ]

        def evidence(model: FittedModel, rows: float = rows) -> float:
            within = score_within(model, rows=rows, noise=fitter.noise)
            return 0.5 * (within + score(model, rows=rows, noise=fitter.noise))

        farther = min(ahead, key=evidence, default=best)
        if evidence(farther) >= evidence(best) - SCORE.least_score:
            break
        fitter.update_noise(farther)
        best = _polished(fitter, farther, root)
    return best


def _chosen_anew(fitter: Fitter, model: FittedModel, root: FittedModel) -> list[FittedModel]:
    """The model with other further constants of an effect in place of one that the search has freed."""
    found = []
    for name in sorted(model.freed - root.freed):
        effect = next(e for e in model.fit_model.effects if e.id == name.partition(".")[0])
        fixed = fitter.fixing(model, name, _fixed_value(name, model, root))
        found += [other for other in fitter.freeing(fixed, effect) if other.key != model.key]
    return found


def _as_good(fitted_model: FittedModel, best: FittedModel) -> bool:
    return fitted_model.mean_square < (1.0 + SEARCH.alike) * best.mean_square


def _different(fitted_models: Sequence[FittedModel], alike: float = SEARCH.alike) -> list[FittedModel]:
    """The models without those that predict the same as an earlier one."""
    kept: list[FittedModel] = []
    for fitted_model in fitted_models:
        if all(
            np.mean((fitted_model.residual - other.residual) ** 2) > alike * fitted_model.mean_square
            for other in kept
        ):
            kept.append(fitted_model)
    return kept


def _rows(fitter: Fitter, fitted_model: FittedModel) -> float:
    return effective_rows(fitted_model.residual, fitter.predictor.sweeps, fitter.predictor.folds)


def _at_floor(fitter: Fitter, fitted_model: FittedModel) -> bool:
    return fitter.noise is not None and fitted_model.rmse <= SEARCH.nothing_left * fitter.noise
