"""Optimises the continuous variables of a design: nominal length and pressure."""

from __future__ import annotations

import numpy as np

from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design
from mckibben.sizing.statics import contraction_limit
from mckibben.sizing.trial import Trial, hard_trial_of

_RUNS = 32
_FIRST_STEP = (0.12, 0.2)  # of the logarithms of length and pressure


def refined(trial: Trial, bench: Bench) -> Trial:
    """The best design near a trial, found by the simplex method of Nelder and Mead."""
    from scipy.optimize import minimize  # 0.2 s import, not paid at start

    task, group = bench.task, trial.design.group
    part = group.muscle
    part_limits = [p for p in (part.limits.max_pressure, group.valve.max_pressure) if p is not None]
    highest = min(task.available_pressure, *part_limits) if part_limits else task.available_pressure
    lengths = (
        max(part.shortest, group.duty.pull / contraction_limit(part, task)),
        min(part.longest, task.limits.max_length - task.limits.end_fittings),
    )
    lowest = min(max(0.1 * highest, group.valve.min_pressure or 0.0), highest)
    low = np.log([lengths[0], lowest])
    high = np.log([max(lengths), highest])
    tried = [hard_trial_of(trial.design, bench)]

    def cost(point: np.ndarray) -> float:
        length, pressure = np.exp(np.clip(point, low, high))
        tried.append(hard_trial_of(Design(group, float(length), float(pressure)), bench))
        return tried[-1].cost()

    begin = np.log([trial.design.length, trial.design.pressure])
    steps = np.where(begin + _FIRST_STEP > high, -1.0, 1.0) * _FIRST_STEP
    simplex = begin + np.array([[0.0, 0.0], [steps[0], 0.0], [0.0, steps[1]]])
    options = {"maxfev": _RUNS, "initial_simplex": simplex, "xatol": 1e-3, "fatol": 1e-3}
    minimize(cost, begin, method="Nelder-Mead", options=options)
    good = [item for item in tried if item.keeps_limits]
    return min(good, key=lambda item: item.cost()) if good else trial
