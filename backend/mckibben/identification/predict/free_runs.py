"""Lengths of a muscle with memory that carries a load: it remembers its own way, not the measured one.

A prediction is then a free run: it needs the pressure and the load alone, and noise of the measured length
does not make friction turn round.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from mckibben.identification.predict.evaluate import Evaluation, sorted_effects
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.memory import remembers
from mckibben.identification.predict.path import Path
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import GEOMETRY
from mckibben.simulation.drive.isotonic import isotonic_lengths
from mckibben.simulation.statics.model import StaticModel

_STEP = 1e-4  # relative step of a difference by a parameter
_SHARE = 0.01  # of the range between bounds, of which a step is a share where the value is smaller


def acting_of(fit_model: FitModel, names: Sequence[str] = ()) -> FitModel:
    """The model with the effects that do something, or of which derivatives are wanted.

    A search evaluates models with all candidates, most of them off.
    """
    wanted = {name.partition(".")[0] for name in names}
    acting = [e for e in fit_model.effects if e.id in wanted or not _is_off(e, fit_model.values[e.id])]
    if len(acting) == len(fit_model.effects):
        return fit_model
    values = {effect.id: fit_model.values[effect.id] for effect in acting}
    return replace(fit_model, effects=sorted_effects(acting), values=values)


def _is_off(effect: Effect, values: Mapping[str, float]) -> bool:
    switches = [p for p in effect.parameters if p.off is not None]
    return bool(switches) and all(values[p.name] == p.off for p in switches)


def remembered(fit_model: FitModel) -> bool:
    """Whether the muscle of a model has memory."""
    return any(map(remembers, fit_model.effects))


def followed_lengths(
    evaluation: Evaluation, fit_model: FitModel, names: Sequence[str]
) -> tuple[np.ndarray, np.ndarray]:
    """Length of each row [m], and its derivatives by the named parameters, shape (rows, names)."""
    task = evaluation.task
    models, steps = [fit_model], []
    for name in names:
        here, step = fit_model.number(name), _step_of(fit_model, name)
        models.append(fit_model.with_numbers([name], [here + step]))
        steps.append(step)
    effects, path = sorted_effects(fit_model.effects), evaluation.path
    clock = np.arange(len(task.measured), dtype=float) if task.time is None else task.time
    # What went before is the same for all, as they differ little; a strain then counts from the rest length.
    before = evaluation.history(fit_model)
    begins = _at_path(path, evaluation.begins(fit_model, before))
    begin_at = [
        _at_path(path, evaluation.begins(model, before)) if name == "nominal_length" else begins
        for model, name in zip(models, ("", *names), strict=True)
    ]
    with np.errstate(all="ignore"):
        lengths = isotonic_lengths(
            [StaticModel.of(model.muscle, effects, model.values) for model in models],
            time=clock[path.rows],
            pressure=task.state["pressure"][path.rows],
            load=np.array([task.state["load"][path.rows] + model.load for model in models]),
            temperature=task.state["temperature"][path.rows],
            records=task.records[path.rows],
            first=np.array([(task.measured + evaluation.moved(model))[path.rows] for model in models]),
            begins=begin_at,
        )
    lengths = path.everywhere(lengths)
    length = lengths[0]
    return length, ((lengths[1:] - length) / np.array(steps)[:, None]).T


def _at_path(path: Path, begins: Mapping[int, Mapping[str, float]]) -> dict[int, Mapping[str, float]]:
    """Number of the followed row -> what begins there, of rows."""
    return {int(path.before[row]): states for row, states in begins.items()}


def _step_of(fit_model: FitModel, name: str) -> float:
    """Step of a difference, away from the upper bound."""
    here = fit_model.number(name)
    if name in GEOMETRY:
        return _STEP * here
    effect_id, _, parameter = name.partition(".")
    effect = next((e for e in fit_model.effects if e.id == effect_id), None)
    if effect is None:  # a load
        return _STEP * max(abs(here), 1.0)
    declared = effect.parameter(parameter)
    step = _STEP * max(abs(here), _SHARE * (declared.upper - declared.lower))
    return step if here + step <= declared.upper else -step
