"""Rejected candidates: the reason, the binding limit, and what would help."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.sizing.catalogue import Group, PartsCatalogue
from mckibben.sizing.design_table import Sheet, shortfall
from mckibben.sizing.reasons import (
    group_text,
    remedies_text,
    slow_remedy,
    slow_text,
    temperature_text,
    valve_text,
    why_at_rest,
)
from mckibben.sizing.statics import LimitName
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial

_NEVER = float("inf")


@dataclass(frozen=True, slots=True)
class Rejection:
    """A number of muscles, or these with a valve and a tube, that cannot fulfil the task.

    Attributes:
        binding: the limit that prevents it.
        nearness: share by which one limit would have to move; infinite where moving one does not help.
        combinations: number of combinations this entry covers.
    """

    muscle: str
    parallel: int
    why: str
    binding: LimitName
    would_work_if: str
    valve: str | None = None
    tube: str | None = None
    nearness: float = _NEVER
    combinations: int = 0


def at_rest_rejections(
    sheets: Sequence[Sheet], catalogue: PartsCatalogue, task: Task, works: set[str]
) -> list[Rejection]:
    """Muscles that the closed form rules out with any valve; ``works`` names those that fulfil the task."""
    rejections = [
        Rejection(part.id, 1, why, "temperature", "another muscle, or another place for it")
        for part in catalogue.muscles
        if (why := temperature_text(part, task)) is not None
    ]
    counts = range(1, task.limits.max_parallel + 1)
    sound = {(sheet.part.id, count) for sheet in sheets for count in counts if len(sheet.sound(count))}
    pairs = len(catalogue.valves) * len(catalogue.tubes)
    for sheet in _nearest(sheets, task):
        name = sheet.part.id
        series = name.partition("-")[0]
        others = tuple(sorted(works - {name}, key=lambda other: (other.partition("-")[0] != series, other)))
        for count in counts:
            if (name, count) in sound:
                continue
            lacking = shortfall(sheet, count)
            rejections.append(
                Rejection(
                    name,
                    count,
                    why_at_rest(sheet, count, lacking),
                    lacking.binding,
                    remedies_text(sheet, count, lacking, others),
                    nearness=min((share for _, share in lacking.remedies.values()), default=_NEVER),
                    combinations=int(np.sum(sheet.allowed & (sheet.rest.parallel == count))) * pairs,
                )
            )
    return rejections


def _nearest(sheets: Sequence[Sheet], task: Task) -> list[Sheet]:
    """For each muscle the sheet that comes nearest; there is one sheet per pulley radius tried."""
    best_sheets: dict[str, Sheet] = {}
    for sheet in sheets:
        best = best_sheets.get(sheet.part.id)
        if best is None or _miss(sheet) < _miss(best):
            best_sheets[sheet.part.id] = sheet
    return list(best_sheets.values())


def _miss(sheet: Sheet) -> float:
    return -float(np.max(np.min(list(sheet.margins.values()), axis=0)))


@dataclass(frozen=True, slots=True)
class WrongPressure:
    """A valve that is not made for any pressure at which the muscles carry the load: lowest, highest [Pa]."""

    lowest: float
    highest: float


Failed = tuple[Group, Trial | WrongPressure | None]


def slow_rejections(failed: Sequence[Failed], task: Task, works: set[str]) -> list[Rejection]:
    """Groups that are strong enough but too slow, or whose valve does not stand the pressure; one entry per
    choice of valve and tube.
    """
    rejections: dict[tuple[str, int, str, str], Rejection] = {}
    for group, trial in failed:
        key = (group.muscle.id, group.parallel, group.valve.id, group.tube.id)
        if isinstance(trial, WrongPressure):
            rejections[key] = Rejection(
                group.muscle.id,
                group.parallel,
                f"{group_text(group)}: {valve_text(group, (trial.lowest, trial.highest))}",
                "valve_pressure",
                "a valve for this pressure",
                valve=group.valve.id,
                tube=group.tube.id,
                combinations=1,
            )
            continue
        excess = _NEVER if trial is None else trial.excess() - 1.0
        if key in rejections and rejections[key].nearness <= excess:
            continue
        binding = "time" if trial is None else trial.binding
        rejections[key] = Rejection(
            group.muscle.id,
            group.parallel,
            f"{group_text(group)}: {slow_text(trial, task)}",
            binding,
            slow_remedy(trial, task, binding, group.muscle.id in works),
            valve=group.valve.id,
            tube=group.tube.id,
            nearness=excess if excess > 0.0 else _NEVER,
            combinations=1,
        )
    return list(rejections.values())
