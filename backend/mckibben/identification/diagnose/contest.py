r"""Wrong entry or missing physics: each statement that may be wrong competes with the effects.

Elasticity alone imitates a wrong rest length, so an entry is changed **together with** effects: first in the
start model, then beside those of the best model, and for the most promising entries in a search of their own.
Models with and without it are counted alike: the odds of the mistake and of each effect before any data, and
the evidence Z of the model beside a free surface, which takes what is no law of the catalogue,

.. math:: \ln\frac{P}{1-P} = \ln\pi + \sum_{e\in E}\ln o_e - \sum_{e\in D}\ln o_e + \ln Z_E - \ln Z_D

with half the difference of the scores of `mckibben.identification.diagnose.score` in its place where the
rows are too few for a surface. An entry stands, and is asked about first, where it explains the data to the
noise as effects do, with fewer of them: a caliper is cheaper than an experiment. What the file says in words,
or the catalogue of the muscle, stands against it unless the effects leave more than the noise. An entry that
is less likely than some formula does not stand.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from weakref import WeakKeyDictionary

import numpy as np

from mckibben.identification.diagnose.entries import StatedEntry, Statements, predicted_scale
from mckibben.identification.diagnose.probability import log_odds
from mckibben.identification.diagnose.score import better, effective_rows, score
from mckibben.identification.diagnose.search import search
from mckibben.identification.diagnose.wrong_entry import WrongEntry, done_without
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.predict.fit_model import FitModel, fixed_beside
from mckibben.identification.residual.noise import allowing_for_errors, noise_of
from mckibben.identification.residual.surface import log_evidence
from mckibben.identification.thresholds import ENTRIES, SCORE
from mckibben.physics.errors import InputError


@dataclass(frozen=True)
class _Trial:
    """One entry changed: its data and fitter, and the start model fitted with it."""

    entry: StatedEntry
    fitter: Fitter
    root: FittedModel
    best: FittedModel
    scale: float

    def score(self, rows: float, floor: float | None) -> float:
        """Score of the best model, errors in the units of the stated data; a finer error does not count."""
        noise = None if floor is None else floor * self.scale
        return score(self.best, rows=rows, noise=noise) - 2.0 * rows * float(np.log(self.scale))

    def evidence(self, model: FittedModel) -> float | None:
        """Log evidence of a model with the entry beside a free surface, by the density of the stated data."""
        found = log_evidence(model, self.fitter.predictor)
        return None if found is None else found + len(model.residual) * float(np.log(self.scale))

    def likelier_wrong(self, of_root: Callable[[], float | None]) -> bool:
        """Whether it is likelier wrong than right, by the start model beside a surface; True if untold."""
        changed, stated = self.evidence(self.root), of_root()
        return changed is None or stated is None or changed - stated + float(np.log(self.entry.prior)) > 0.0

    @property
    def done(self) -> bool:
        """Whether it reaches the noise with the start model's effects alone: nothing is left to search."""
        noise = self.fitter.noise
        return self.best is self.root and noise is not None and self.root.rmse <= SCORE.at_floor * noise

    @property
    def rmse(self) -> float:
        """Error in the units of the stated data."""
        return self.best.rmse / self.scale


def contest(
    statements: Statements,
    *,
    fitter: Fitter,
    first: FitModel,
    root: FittedModel,
    best: FittedModel,
    stated_noise: float | None,
    beside: Callable[[FittedModel], float | None],
) -> tuple[WrongEntry, ...]:
    """The entries that explain the data better than the effects do, the most convincing first.

    Args:
        statements: what may be wrong.
        fitter: of the search with the entries as stated.
        first: the start model.
        root: the start model fitted.
        best: the best model of the search.
        stated_noise: noise stated by the user.
        beside: log evidence of a model with the entries as stated beside a free surface.
    """
    added = [name for name in best.fit_model.ids if name not in set(first.ids)]
    noise = fitter.noise
    if noise is not None and best.rmse <= SCORE.at_floor * noise and not added:
        return ()  # nothing is missing, so nothing is wrong
    trials = []
    for entry in statements.entries:
        trial = _tried(entry, statements, fitter, first, root, stated_noise)
        if trial is not None:
            trials.append(trial)
    rows = effective_rows(best.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    at_floor = noise is not None and best.rmse <= SCORE.at_floor * noise
    trials = [_with_effects(trial, best, root, added, rows, fewer=at_floor) for trial in trials]
    noise = _lowest_noise(noise, trials, best)
    here = score(best, rows=rows, noise=noise)
    trials.sort(key=lambda trial: trial.score(rows, noise))
    if at_floor:
        near = [trial for trial in trials if trial.rmse < ENTRIES.within_reach * best.rmse]
    else:
        here = score(best, rows=rows, noise=noise)
        near = [trial for trial in trials if trial.score(rows, noise) < here - SCORE.least_score]
    for trial in _promising(near, trials, best, added, fitter, partial(beside, root), at_floor=at_floor):
        trials[trials.index(trial)] = _searched(trial) if fitter.effort.thorough else _lighter(trial)
    if trials:
        noise = _lowest_noise(noise, trials, best)
        best = _at_its_best(fitter, trials[: ENTRIES.searched], best, added, rows, noise)
        here = score(best, rows=rows, noise=noise)
        trials.sort(key=lambda trial: trial.score(rows, noise))
    found = [
        entry
        for trial in trials
        if (
            entry := _evidence(
                trial,
                first,
                root,
                best,
                partial(beside, best),
                rows=rows,
                noise=noise,
                here=here,
                at_floor=at_floor,
            )
        )
        is not None
    ]
    found = [
        replace(each, stands=False, kept=True) if each.entry.hypothesis in statements.kept else each
        for each in found
    ]
    return tuple(sorted(found, key=lambda each: (not each.stands, not each.kept, -each.odds)))


def _at_its_best(
    fitter: Fitter,
    trials: Sequence[_Trial],
    best: FittedModel,
    added: Sequence[str],
    rows: float,
    noise: float | None,
) -> FittedModel:
    """The best model with the entries as stated, where what a trial has found serves them as well.

    A trial searches anew, and may find better laws than the first search did: that says nothing against the
    entry. So its effects are tried with the entries as stated, beside one of those that it does without.
    """
    known = {effect.id: effect for effect in fitter.candidates}
    models = [best]
    for trial in trials:
        found = trial.best
        if trial.entry.free is None or trial.score(rows, noise) >= score(best, rows=rows, noise=noise):
            continue
        as_stated = replace(
            found.fit_model,
            muscle=best.fit_model.muscle,
            load=best.fit_model.load,
            supply_factor=best.fit_model.supply_factor,
        )
        stated = fitter.fit(as_stated, found.freed)
        models += [
            fitter.adding(stated, known[name])
            for name in added
            if name in known and name not in found.fit_model.ids
        ]
    models = [model for model in models if model is best or model.implausible <= best.implausible]
    return min(models, key=lambda model: score(model, rows=rows, noise=noise))


def _promising(
    near: Sequence[_Trial],
    trials: Sequence[_Trial],
    best: FittedModel,
    added: Sequence[str],
    fitter: Fitter,
    of_root: Callable[[], float | None],
    *,
    at_floor: bool,
) -> list[_Trial]:
    """The trials that a search of their own may bring to do with fewer effects, the best first.

    ``near`` are those that come close to the best model without one; besides them the quantity that by itself
    explains more than any effect with as few numbers does. Where the best model is at the noise with one
    effect, an entry has to do without any, and needs no search. Nor does one that is likelier right than
    wrong with the start model alone, beside a free surface that does what the effects do.
    """
    if at_floor and len(added) < 2:
        return []
    open_ = [trial for trial in trials if not trial.done]
    chosen = [trial for trial in near if not trial.done][: ENTRIES.searched]
    quantities = [trial for trial in open_ if trial.entry.free is not None]
    alone = min(quantities, key=lambda trial: trial.root.rmse, default=None)
    if at_floor and fitter.effort.thorough and alone is not None and alone not in chosen:
        effects, numbers = len(best.fit_model.ids) - len(added) + 1, len(alone.root.free)
        singles = [
            model.rmse
            for (ids, _), model in fitter.known.items()
            if len(ids) == effects and len(model.free) <= numbers
        ]
        if alone.root.rmse < min(singles, default=0.0):
            chosen.append(alone)
    return [trial for trial in chosen if trial.likelier_wrong(of_root)]


def _lowest_noise(noise: float | None, trials: Sequence[_Trial], best: FittedModel) -> float | None:
    """The lowest noise of the models that are as good as the best: missing physics may look like noise."""
    levels = [noise, *(_level(trial) for trial in trials if trial.rmse <= best.rmse)]
    known = [value for value in levels if value is not None]
    return min(known) if known else None


def _level(trial: _Trial) -> float | None:
    """Noise in the units of the stated data."""
    return None if trial.fitter.noise is None else trial.fitter.noise / trial.scale


def _tried(
    entry: StatedEntry,
    statements: Statements,
    fitter: Fitter,
    first: FitModel,
    root: FittedModel,
    stated_noise: float | None,
) -> _Trial | None:
    """The start model with an entry changed; None where the data do not allow the change."""
    predictor, scale, load = fitter.predictor, 1.0, fitter.load
    geometry = fitter.geometry
    if entry.reading is not None:
        try:
            read = statements.read(entry.reading).prepared(first, fitter.candidates)
            predictor = allowing_for_errors(read, first)
        except InputError:
            return None
        scale = predicted_scale(predictor, entry.reading)
    if entry.free is not None:
        if entry.field == "load":
            if load is not None:
                return None
            load = entry.free
        elif entry.free.name in {free.name for free in geometry}:
            return None  # the user has freed it
        else:
            geometry = (*geometry, entry.free)
    own = replace(
        fitter,
        predictor=predictor,
        geometry=geometry,
        load=load,
        noise=None,
        known={},
        off_values={},
        refitted_keys=set(),
        known_gains=WeakKeyDictionary(),
        known_columns=WeakKeyDictionary(),
        estimate=lambda fitted: noise_of(predictor, fitted.residual, _scaled(stated_noise, scale))[0],
    )
    fitted = own.fit(first, root.freed)
    if fitted.lost:  # nothing is known of the data read so
        return None
    own.update_noise(fitted)
    return _Trial(entry, own, fitted, fitted, scale)


def _scaled(noise: float | None, scale: float) -> float | None:
    return None if noise is None else noise * scale


def _with_effects(
    trial: _Trial,
    best: FittedModel,
    root: FittedModel,
    added: Sequence[str],
    rows: float,
    *,
    fewer: bool,
) -> _Trial:
    """The entry with effects: all but one of the best model, single ones, and all unless ``fewer``."""
    fitter = trial.fitter
    if trial.done or (trial.entry.free is None and trial.rmse > root.rmse):
        return trial
    models = [trial.root]
    best = _with_usual_constants(best, fitter)
    if added:
        models += [] if fewer else [fitter.fit(best.fit_model, best.freed)]
        models += [fitter.dropping(best, name) for name in added] if len(added) > 1 else []
    if fitter.effort.thorough and not (fewer and len(added) < 2):
        promising = fitter.promising(trial.root, fitter.candidates)[: ENTRIES.singles]
        models += [fitter.adding(trial.root, effect) for effect in promising]
    for model in models:
        if model.rmse <= min(other.rmse for other in models):
            fitter.update_noise(model)
    noise = fitter.noise
    leading = min(models, key=lambda model: score(model, rows=rows, noise=noise))
    return replace(trial, best=leading) if better(leading, trial.root, rows=rows, noise=noise) else trial


def _with_usual_constants(best: FittedModel, fitter: Fitter) -> FittedModel:
    """The model with the default values of the constants that act as the entry does."""
    fixed = sorted(fixed_beside(fitter.geometry))
    values = {effect.id: effect.defaults for effect in best.fit_model.effects}
    names = [name for name in fixed if name.partition(".")[0] in values]
    usual = [values[name.partition(".")[0]][name.partition(".")[2]] for name in names]
    return replace(best, fit_model=best.fit_model.with_numbers(names, usual)) if names else best


def _lighter(trial: _Trial) -> _Trial:
    """The entry without the effects that it does not need."""
    fitter, leading = trial.fitter, trial.best
    start = set(trial.root.fit_model.ids)
    while True:
        rows = effective_rows(leading.residual, fitter.predictor.sweeps, fitter.predictor.folds)
        less = [fitter.dropping(leading, name) for name in leading.fit_model.ids if name not in start]
        candidate = min(less, key=lambda n: score(n, rows=rows, noise=fitter.noise), default=None)
        if candidate is None or better(leading, candidate, rows=rows, noise=fitter.noise):
            return replace(trial, best=leading)
        leading = candidate


def _searched(trial: _Trial) -> _Trial:
    """The best model of a search with the entry changed."""
    fitter = trial.fitter
    fitter.noise = fitter.estimate(trial.root)
    tried = fitter.promising(trial.root, fitter.candidates)[: fitter.effort.tried]
    singles = [fitter.adding(trial.root, effect) for effect in tried]
    best = search(fitter, trial.root, singles=singles)
    fitter.update_noise(best)
    rows = effective_rows(best.residual, fitter.predictor.sweeps, fitter.predictor.folds)
    one, two = (score(model, rows=rows, noise=fitter.noise) for model in (best, trial.best))
    return replace(trial, best=best if one <= two else trial.best)


def _evidence(
    trial: _Trial,
    first: FitModel,
    root: FittedModel,
    best: FittedModel,
    of_best: Callable[[], float | None],
    *,
    rows: float,
    noise: float | None,
    here: float,
    at_floor: bool,
) -> WrongEntry | None:
    """The entry with its evidence, beside that of the best model; None where it explains nothing."""
    entry, model = trial.entry, trial.best
    value, stderr = None, None
    if entry.free is not None:
        place = next(i for i, p in enumerate(model.free) if p.name == entry.free.name)
        number = model.free[place].start
        if model.at_bound[place]:
            return None
        stated, value = entry.stated or 0.0, entry.value(number)
        stderr = model.standard_errors[place]
        if stderr is not None:
            stderr = abs(entry.value(number + stderr) - value)
        if abs(value - stated) < ENTRIES.least_change * abs(stated):
            return None
    floor = noise or 0.0
    effects = tuple(name for name in model.fit_model.ids if name not in set(first.ids))
    added = len(best.fit_model.ids) - len(first.ids)
    drop = here - trial.score(rows, noise)
    gain = 1.0 - trial.rmse / best.rmse if best.rmse > 0.0 else 0.0
    excess, left = (max(rmse**2 - floor**2, 0.0) for rmse in (best.rmse, trial.rmse))
    simpler = len(effects) < added
    # With as many effects it may need fewer numbers: an angle and two constants for six of two effects.
    leaner = simpler or (len(effects) == added and len(model.free) < len(best.free))
    closer = gain > ENTRIES.least_gain and left <= ENTRIES.much * excess
    reaches = trial.rmse <= (ENTRIES.as_good * best.rmse if at_floor else SCORE.at_floor * floor)
    stands = (simpler and reaches and drop > -ENTRIES.as_much) or (
        drop > SCORE.least_score and (leaner or closer)
    )
    if entry.vouched:
        stands = stands and best.rmse > SCORE.at_floor * floor
    if not (stands or (trial.rmse <= ENTRIES.as_good * best.rmse and leaner and drop > -SCORE.least_score)):
        return None
    beside, beside_best = trial.evidence(model), of_best()
    worth = 0.5 * drop if beside is None or beside_best is None else beside - beside_best
    odds = float(np.log(entry.prior)) + worth
    odds += sum(map(log_odds, model.fit_model.effects)) - sum(map(log_odds, best.fit_model.effects))
    whole = max(root.mean_square - floor**2, 1e-300)
    alone = max(trial.root.mean_square / trial.scale**2 - floor**2, 0.0)
    return WrongEntry(
        entry=entry,
        value=value,
        stderr=stderr,
        explains=float(np.clip(1.0 - alone / whole, 0.0, 1.0)),
        best=model,
        noise=None if noise is None else noise * trial.scale,
        scale=trial.scale,
        effects=effects,
        instead_of=done_without(best, model),
        confidence=min(float(1.0 / (1.0 + np.exp(-np.clip(odds, -50.0, 50.0)))), ENTRIES.certain),
        odds=odds,
        stands=stands and worth > -0.5 * SCORE.least_score,
    )
