"""Figures of many runs at once, in the lanes of `mckibben.simulation.integrate.many`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.simulation.drive.initial_states import starts_of_many
from mckibben.simulation.integrate.many import integrate_many
from mckibben.sizing.prepared import NOTHING, TOLERANCE, Figures, Prepared, figures_of


@dataclass(frozen=True, eq=False)
class Case:
    """A run: a design with the parameters and inputs to run it with."""

    prepared: Prepared
    parameters: np.ndarray
    inputs: np.ndarray


def figures_of_many(cases: Sequence[Case], returns: bool) -> list[Figures]:
    """The figures of each run, `NOTHING` for one that never starts or fails; ``returns`` as for `figures`."""
    found = [NOTHING] * len(cases)
    alike: dict[tuple[object, ...], list[int]] = {}
    for index, case in enumerate(cases):
        line = case.prepared.timeline
        key = (
            id(case.prepared.compiled),
            case.prepared.drive.restitution,
            case.inputs.shape,
            line.grid.shape,
        )
        alike.setdefault(key, []).append(index)
    for indices in alike.values():
        for index, figures in zip(indices, _figures([cases[i] for i in indices], returns), strict=True):
            found[index] = figures
    return found


def _figures(cases: list[Case], returns: bool) -> list[Figures]:
    """The figures of runs with the same equations and as many segments and rows."""
    first = cases[0].prepared
    compiled = first.compiled
    starts = starts_of_many(
        [case.prepared.resting for case in cases],
        compiled,
        np.array([case.parameters for case in cases]),
        np.array([case.prepared.before for case in cases]),
    )
    found = [NOTHING] * len(cases)
    sound = [index for index, error in enumerate(starts.errors) if error is None]
    if not sound:
        return found
    chosen = [cases[index] for index in sound]
    solutions = integrate_many(
        compiled,
        parameters=np.array([case.parameters for case in chosen]),
        starts=starts.states[sound],
        switches=starts.switches[sound],
        restitution=first.drive.restitution,
        times=np.array([case.prepared.timeline.times for case in chosen]),
        inputs=np.array([case.inputs for case in chosen]),
        grid=np.array([case.prepared.timeline.grid for case in chosen]),
        tolerance=TOLERANCE,
        columns=first.columns,
    )
    runs = [case.prepared for case in chosen]
    for index, figures in zip(
        sound, figures_of(runs, solutions.rows, solutions.events, returns), strict=True
    ):
        found[index] = figures
    return found
