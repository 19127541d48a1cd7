"""The start model with one more effect, and the path of single steps to the best model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mckibben.identification.diagnose.gauge_zero import GaugeZero
from mckibben.identification.diagnose.reason import ResidualTraits, why
from mckibben.identification.diagnose.reweighted import reweighted
from mckibben.identification.diagnose.score import better, effective_rows, score
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.physics.effect import Effect


@dataclass(frozen=True)
class SingleAddition:
    """The start model with one more effect, everything refitted.

    Attributes:
        effect: the added effect.
        fitted_model: the fitted model.
        gain: relative reduction of the rms error.
        score: change of the score of `mckibben.identification.diagnose.score`; negative is better.
        twins: candidates whose fitted predictions are the same on these data.
        why: the reason for or against it, one sentence.
    """

    effect: Effect
    fitted_model: FittedModel
    gain: float
    score: float
    twins: tuple[str, ...]
    why: str


@dataclass(frozen=True)
class PathStep:
    """One step of the path: the added effect, and the model fitted with it.

    ``refitted``: the start model with its own numbers fitted; effects are credited only with what is left.
    ``correction``: the added effect is not called missing, but the model predicts better with it.
    """

    added: str | None
    fitted_model: FittedModel
    refitted: bool = False
    correction: bool = False


def single_addition(
    fitter: Fitter,
    root: FittedModel,
    effect: Effect,
    fitted_model: FittedModel,
    before: ResidualTraits,
    twins: Sequence[str],
) -> SingleAddition:
    """A fitted single addition with its gain and reason.

    Args:
        fitter: of the search.
        root: the fitted start model.
        effect: the added effect.
        fitted_model: the model with it.
        before: traits of the residual without it.
        twins: candidates that predict the same.
    """
    rows = effective_rows(fitted_model.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    change = score(fitted_model, rows=rows, noise=fitter.noise) - score(root, rows=rows, noise=fitter.noise)
    gain = 1.0 - fitted_model.rmse / root.rmse if root.rmse > 0.0 else 0.0
    return SingleAddition(effect, fitted_model, gain, change, tuple(twins), why(effect, before, gain=gain))


def path_to(
    fitter: Fitter, start: FittedModel, root: FittedModel, best: FittedModel, vent: GaugeZero | None
) -> tuple[PathStep, ...]:
    """The path: the start model, its own numbers refitted, then the effect that lowers the error most, ...

    Args:
        fitter: of the search.
        start: the start model as given.
        root: the fitted start model.
        best: the best model.
        vent: zero error of the gauge, read from the vented muscle before the search.
    """
    steps = [PathStep(None, start)]
    root = with_own_constants(fitter, root, best)
    if vent is None and root.free:
        steps.append(PathStep(None, root, refitted=True))
    fitted_model, remaining = root, [e for e in best.fit_model.effects if e.id not in set(root.fit_model.ids)]
    added = []
    while len(remaining) > 1:
        trials = [(effect, fitter.adding(fitted_model, effect)) for effect in remaining]
        effect, fitted_model = min(trials, key=lambda pair: _shown_error(fitter, pair[1]))
        added.append(PathStep(effect.id, fitted_model))
        remaining.remove(effect)
    if remaining:
        added.append(PathStep(remaining[0].id, best))
    elif best is not root:
        added.append(PathStep(None, best))  # further constants were freed
    if vent is not None:
        added = _with_vent(fitter, start, root, added, vent)
    return (*steps, *added)


def known_path(fitter: Fitter, root: FittedModel) -> list[PathStep]:
    """The steps from the fitted start model to the best of the models that are fitted already.

    Only models that single additions lead to are considered, each of them fitted; empty where none is better
    than the start model.
    """
    present = frozenset(root.fit_model.ids)
    lowest: dict[frozenset[str], FittedModel] = {present: root}
    for model in sorted(fitter.known.values(), key=lambda each: each.rmse, reverse=True):
        effects = frozenset(model.fit_model.ids)
        if effects > present and model.implausible <= root.implausible:
            lowest[effects] = model
    before: dict[frozenset[str], frozenset[str]] = {}
    for effects in sorted(lowest, key=len):
        parents = [effects - {name} for name in effects - present]
        reached = [parent for parent in parents if parent == present or parent in before]
        if reached:
            before[effects] = min(reached, key=lambda parent: lowest[parent].rmse)
    rows = effective_rows(root.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    sound = [effects for effects in before if better(lowest[effects], root, rows=rows, noise=fitter.noise)]
    steps: list[PathStep] = []
    if sound:
        effects = min(sound, key=lambda each: score(lowest[each], rows=rows, noise=fitter.noise))
        while effects != present:
            (name,) = effects - before[effects]
            steps.insert(0, PathStep(name, lowest[effects]))
            effects = before[effects]
    return steps


def with_own_constants(fitter: Fitter, root: FittedModel, best: FittedModel) -> FittedModel:
    """The start model with those of its further constants free that the best model has freed.

    What the start model's own laws explain is credited to none of the added effects.
    """
    present = set(root.fit_model.ids)
    own = {name for name in best.freed - root.freed if name.partition(".")[0] in present}
    added = [name for name in best.fit_model.ids if name not in present]
    if not own or not added:
        return root
    # From both sides: the laws may have bent only beside an effect.
    below = best
    for name in added:
        below = fitter.dropping(below, name)
    above = fitter.fit(root.fit_model, root.freed | own, again=True)
    return min((root, above, below), key=lambda each: _shown_error(fitter, each))


def _with_vent(
    fitter: Fitter, start: FittedModel, root: FittedModel, added: Sequence[PathStep], vent: GaugeZero
) -> list[PathStep]:
    """The steps with that of the zero error of the gauge, where it first lowers the error.

    Its value is read and not fitted, so beside a model that lacks an effect it may raise the error.
    """
    before, after = start, root
    steps: list[PathStep] = []
    for number, step in enumerate(added):
        if _shown_error(fitter, after) <= _shown_error(fitter, before):
            return [*steps, PathStep(vent.effect.id, after), *added[number:]]
        before, after = fitter.dropping(step.fitted_model, vent.effect.id), step.fitted_model
        steps.append(PathStep(step.added, before))
    return [*steps, PathStep(vent.effect.id, after)]


def _shown_error(fitter: Fitter, fitted: FittedModel) -> float:
    """The error that a comparison with the model shows."""
    return reweighted(fitter.predictor, fitted).rmse
