r"""Two steps at once from a model: steps that help together, and hardly or not at all one by one.

A search that adds an effect, or frees the further constants of one, and keeps what improves the score stays
where only two such steps together lead on: a wall that softens, ends that stay behind and a prestress act
alike on a force map, so that each of them is nearly explained by the others, but not all of them. To first
order a pair of steps reduces the sum of squares by

.. math:: g = \left|P_X\,(I - QQ^T)\,r\right|^2

with the residual r, an orthonormal basis Q of what the free parameters change, and the projection P on the
columns X of both steps beside it, their factors within the bounds of the parameters. This ranks all pairs at
the cost of small linear fits; those that promise most are fitted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter, between, gain, unexplained_by
from mckibben.identification.predict.fit_model import free_numbers
from mckibben.identification.thresholds import PAIRS
from mckibben.physics.effect import Effect

_DISTINCT = 1e-3  # share of a column beside the basis below which the free parameters do the same


@dataclass(frozen=True, eq=False)
class _Step:
    """An effect to add, or one of the model whose further constants to free, with the changes it makes.

    ``low`` and ``high`` are the bounds of the factors of its columns.
    """

    effect: Effect
    added: bool
    columns: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass(frozen=True, eq=False)
class _Pair:
    model: FittedModel
    first: _Step
    second: _Step
    left: float  # sum of squares that the pair leaves, to first order


def two_steps_ahead(fitter: Fitter, models: Sequence[FittedModel]) -> list[FittedModel]:
    """The fitted models that two steps at once from these models lead to.

    Args:
        fitter: of the search.
        models: from which to go on.
    """
    pairs = sorted((pair for model in models for pair in _pairs(fitter, model)), key=lambda pair: pair.left)
    return [fitted for pair in pairs[: PAIRS.fitted] for fitted in _fitted(fitter, pair)]


def _pairs(fitter: Fitter, model: FittedModel) -> Iterator[_Pair]:
    basis, unexplained = unexplained_by(model)
    whole = float(unexplained @ unexplained)
    steps = list(_steps(fitter, model, basis))
    alone = {step: whole - _left([step], unexplained) for step in steps}
    for first, second in combinations(steps, 2):
        # The bounds only raise what is left, so the pairs that promise nothing without them are done with.
        columns = np.hstack([first.columns, second.columns])
        least = PAIRS.together * max(alone[first], alone[second], PAIRS.least * whole)
        if gain(columns, basis, unexplained) <= least:
            continue
        left = _left([first, second], unexplained)
        if whole - left > least:
            # Effects first: their constants can be freed then.
            yield _Pair(model, *sorted((first, second), key=lambda step: not step.added), left)


def _left(steps: Sequence[_Step], unexplained: np.ndarray) -> float:
    """Sum of squares that steps leave within the bounds of their parameters, to first order."""
    from scipy.optimize import lsq_linear

    columns = np.hstack([step.columns for step in steps])
    low, high = (np.concatenate([getattr(step, end) for step in steps]) for end in ("low", "high"))
    return 2.0 * float(lsq_linear(columns, unexplained, (low, high)).cost)


def _steps(fitter: Fitter, model: FittedModel, basis: np.ndarray) -> Iterator[_Step]:
    """All steps from a model; columns beside the basis of what its free parameters change."""
    inside = set(model.fit_model.ids)
    for effect in fitter.candidates:
        off = {} if effect.id in inside else fitter.acting(model, effect)
        if off:
            reach = np.array([between(effect, off)[name] - value for name, value in off.items()])
            ranges = [(effect.parameter(name), value) for name, value in off.items()]
            bounds = np.array([p.bounds(model.fit_model.size) for p, _ in ranges])
            ends = (bounds - np.array([[value] for _, value in ranges])) / reach[:, None]
            yield from _step(effect, True, fitter.changes(model, effect), ends, basis)
    for effect in model.fit_model.effects:
        names = fitter.further(model, effect)
        free = [p for p in free_numbers(model.fit_model, (), names) if p.name in names]
        if free:
            columns = fitter.predictor.linearised(model.fit_model, free)[1]
            ends = np.array([(p.lower - p.start, p.upper - p.start) for p in free])
            yield from _step(effect, False, fitter.predictor.weighted(columns), ends, basis)


def _step(
    effect: Effect, added: bool, columns: np.ndarray, ends: np.ndarray, basis: np.ndarray
) -> Iterator[_Step]:
    low, high = np.min(ends, axis=1), np.max(ends, axis=1)
    rest = columns - basis @ (basis.T @ columns)
    size, whole = np.linalg.norm(rest, axis=0), np.linalg.norm(columns, axis=0)
    used = np.isfinite(size) & (size > _DISTINCT * whole) & (high > low)
    if np.any(used):
        size = size[used]
        yield _Step(effect, added, rest[:, used] / size, low[used] * size, high[used] * size)


def _fitted(fitter: Fitter, pair: _Pair) -> list[FittedModel]:
    return [
        model
        for begun in _taken(fitter, pair.model, pair.first)
        for model in _taken(fitter, begun, pair.second)
    ]


def _taken(fitter: Fitter, model: FittedModel, step: _Step) -> list[FittedModel]:
    return [fitter.adding(model, step.effect)] if step.added else fitter.freeing(model, step.effect)
