"""Linear models of a drive at places between its ends, for the format ``linear``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mckibben.application.linear.result import ModelResult, PointResult, model_result, point_of
from mckibben.export.subject import RunnableDrive
from mckibben.physics.errors import InputError
from mckibben.simulation.linear.bound import BoundDrive
from mckibben.simulation.linear.equations import COMMAND, POSITION
from mckibben.simulation.linear.linearise import linearise
from mckibben.simulation.linear.point import Condition, held_positions
from mckibben.simulation.linear.response import frequencies_for

# Places between the lowest and the highest position that can be held; the first that has one is the main one.
SHARES = (0.5, 0.1, 0.3, 0.7, 0.9)


@dataclass(frozen=True)
class LinearPoint:
    """An operating point with its models, the main one first marked as ``primary``.

    Attributes:
        share: place between the lowest and the highest position that can be held.
        lost: what the models do not contain, sentences.
    """

    share: float
    point: PointResult
    smooth: bool
    models: list[ModelResult]
    lost: tuple[str, ...]

    @property
    def primary(self) -> ModelResult:
        """The model that loop and design use."""
        return next(model for model in self.models if model.primary)


def linear_points(runnable: RunnableDrive) -> tuple[list[LinearPoint], list[str]]:
    """Models at the places of `SHARES` in rising order, and why one is missing.

    Raises:
        InputError: the load does not move, or no place has an equilibrium.
    """
    drive = runnable.drive
    try:
        with np.errstate(all="ignore"):
            low, high = held_positions(BoundDrive(drive))
    except InputError as error:
        raise _refused(error) from error
    found: list[LinearPoint] = []
    missing: list[str] = []
    last: InputError | None = None
    for share in sorted(SHARES):
        position = low + share * (high - low)
        try:
            linear = linearise(drive, Condition("position", position))
        except InputError as error:
            missing.append(f"A model at {position * 1e3:.4g} mm: {error.message}.")
            last = error
            continue
        with np.errstate(all="ignore"):
            axis = frequencies_for(linear.primary)
            models = [model_result(linear, each, COMMAND.name, POSITION.name, axis) for each in linear.models]
        found.append(LinearPoint(share, point_of(linear), linear.smooth, models, linear.lost))
    if last is not None and not found:
        raise _refused(last)
    return found, missing


def _refused(error: InputError) -> InputError:
    return InputError(f"there is no linear model: {error.message}", field="as", hint=error.hint)


def main_point(points: list[LinearPoint]) -> LinearPoint:
    """The point in the middle, or the next one that there is."""
    return min(points, key=lambda each: SHARES.index(each.share))
