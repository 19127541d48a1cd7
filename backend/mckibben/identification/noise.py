"""How much of a residual is noise: what remains within a sweep once all smooth change is taken away."""

from __future__ import annotations

import numpy as np

from mckibben.identification.predict import Task

_SHORTEST_SWEEP = 8  # rows; fewer leave too few differences
_CHI2_MEDIAN = 0.4549364231195724  # median of chi squared with one degree of freedom


def noise_floor(task: Task, residual: np.ndarray) -> float | None:
    r"""Standard deviation of the noise, from third differences of the residual inside each sweep.

    The third difference of white noise has variance :math:`20\sigma^2`, that of a smooth residual is small;
    the median of its square is robust against the few steps that are not smooth. Sweeps are the groups, or
    for a map the lines of equal length, whichever are longer. None when no sweep has eight rows.
    """
    third = [np.diff(sweep, 3) for sweep in _sweeps(task, residual) if len(sweep) >= _SHORTEST_SWEEP]
    if not third:
        return None
    return float(np.sqrt(np.median(np.concatenate(third) ** 2) / (20.0 * _CHI2_MEDIAN)))


def _sweeps(task: Task, residual: np.ndarray) -> list[np.ndarray]:
    by_group = [residual[task.groups == label] for label in np.unique(task.groups)]
    if "length" not in task.state:
        return by_group
    lengths = np.round(task.state["length"], 6)
    levels = np.unique(lengths)
    if len(levels) >= len(by_group):
        return by_group
    lines = []
    for level in levels:
        chosen = lengths == level
        lines.append(residual[chosen][np.argsort(task.state["pressure"][chosen], kind="stable")])
    return lines
