"""Rejected candidates: the reason, the binding limit, and what would help."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import ceil, floor, isfinite, log10

import numpy as np

from mckibben.sizing.catalogue import Group, MusclePart, PartsCatalogue
from mckibben.sizing.design_table import Sheet, Shortfall, shortfall
from mckibben.sizing.statics import HAIR, LimitName, at_rest, contraction_limit, margins
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial

_NEVER = float("inf")

_BAR = 1e5
_ROUNDING = 1e-6  # of the last digit that is shown


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


#: Muscle, number in parallel, and the limit that is moved (None: the number itself).
RemedyKey = tuple[str, int, LimitName | None]
#: Largest share of its time that a remedy takes, by a run with the load; infinite: it does not arrive.
Lateness = Mapping[RemedyKey, float]


@dataclass(frozen=True, eq=False)
class Unsound:
    """A muscle that the closed form rules out in a number, with any valve."""

    sheet: Sheet
    parallel: int
    lacking: Shortfall

    @property
    def designs(self) -> Iterator[tuple[RemedyKey, int, float, float]]:
        """What it takes to show a remedy with the load of the task: number of muscles, length, pressure.

        Where pressure is not what is moved, the full one that no other limit forbids may be quicker.
        """
        name, rest = self.sheet.part.id, self.sheet.rest
        for limit, remedy in self.lacking.remedies.items():
            if limit == "suspended_mass" or (limit == "force" and not remedy.rest.capacity[0] >= 1.0):
                continue
            length, pressure = float(remedy.rest.length[0]), float(remedy.rest.pressure[0])
            yield (name, self.parallel, limit), self.parallel, length, pressure
            if limit in ("length", "contraction"):
                most = self._full(length)
                if most > pressure:
                    yield (name, self.parallel, limit), self.parallel, length, most
        for count in range(self.parallel + 1, int(rest.parallel.max()) + 1):
            sound = self.sheet.sound(count)
            for index in sound[np.argsort(-rest.capacity[sound])][:1]:
                yield (name, count, None), count, float(rest.length[index]), float(rest.pressure[index])

    def _full(self, length: float) -> float:
        """The highest pressure of the task at which a length breaks no limit but its own [Pa]; 0 = none."""
        sheet = self.sheet
        pressures = np.unique(sheet.rest.pressure)
        alike = np.full(pressures.shape, length), pressures, np.full(pressures.shape, float(self.parallel))
        limits = margins(at_rest(sheet.part, sheet.duty, sheet.task, *alike), sheet.part, sheet.task)
        moved = ("length", "contraction")
        kept = np.all([each >= -HAIR for name, each in limits.items() if name not in moved], axis=0)
        return float(np.max(pressures[kept], initial=0.0))


def unsound(sheets: Sequence[Sheet], task: Task) -> list[Unsound]:
    """What the closed form rules out, by the sheet of each muscle that comes nearest."""
    counts = range(1, task.limits.max_parallel + 1)
    sound = {(sheet.part.id, count) for sheet in sheets for count in counts if len(sheet.sound(count))}
    return [
        Unsound(sheet, count, shortfall(sheet, count))
        for sheet in _nearest(sheets, task)
        for count in counts
        if (sheet.part.id, count) not in sound
    ]


def at_rest_rejections(
    ruled_out: Sequence[Unsound], catalogue: PartsCatalogue, task: Task, works: set[str], lateness: Lateness
) -> list[Rejection]:
    """Muscles that the closed form rules out with any valve; ``works`` names those that fulfil the task."""
    rejections = [
        Rejection(part.id, 1, why, "temperature", "another muscle, or another place for it")
        for part in catalogue.muscles
        if (why := temperature_text(part, task)) is not None
    ]
    pairs = len(catalogue.valves) * len(catalogue.tubes)
    for item in ruled_out:
        sheet, count, lacking = item.sheet, item.parallel, item.lacking
        name = sheet.part.id
        series = name.partition("-")[0]
        others = tuple(sorted(works - {name}, key=lambda other: (other.partition("-")[0] != series, other)))
        rejections.append(
            Rejection(
                name,
                count,
                why_at_rest(sheet, count, lacking),
                lacking.binding,
                remedies_text(sheet, count, lacking, others, lateness),
                nearness=min((each.share for each in lacking.remedies.values()), default=_NEVER),
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


def length_text(length: float) -> str:
    """A length in whole millimetres."""
    return f"{length * 1e3:.0f} mm"


def number_text(parallel: int, part: MusclePart) -> str:
    """Number and type of the muscles."""
    return f"one {part.id}" if parallel == 1 else f"{parallel} × {part.id} in parallel"


def why_at_rest(sheet: Sheet, parallel: int, lacking: Shortfall) -> str:
    """Why no design with this number of muscles keeps every limit at rest."""
    task, part, rest = sheet.task, sheet.part, sheet.rest
    who = number_text(parallel, part)
    most = contraction_limit(part, task)
    least = sheet.duty.pull / most
    room = task.limits.max_length - task.limits.end_fittings
    if lacking.best is None:
        if least > part.longest:
            return (
                f"{who}: {length_text(sheet.duty.pull)} at {most * 100:.3g} % contraction needs a muscle of "
                f"{length_text(least)}; the longest {part.id} is {length_text(part.longest)}"
            )
        if part.shortest > room:
            return f"the shortest {part.id} is {length_text(part.shortest)}; {length_text(room)} is available"
        if least > room:
            return (
                f"{who}: {length_text(sheet.duty.pull)} at {most * 100:.3g} % contraction needs a muscle of "
                f"{length_text(least)}; {length_text(room)} is available"
            )
    if lacking.best is None:
        nearest, (worst, only) = 0, next(iter(lacking.remedies.items()))
        rest = only.rest
    else:
        nearest = lacking.best
        worst = min(sheet.margins, key=lambda name: float(sheet.margins[name][nearest]))
    rest = rest.only(nearest)
    index = 0
    at = (
        f"{who} of {length_text(rest.length[index])} at {rest.pressure[index] / _BAR:.3g} bar and "
        f"{rest.contraction[index] * 100:.3g} % contraction"
    )
    match worst:
        case "force":
            share = rest.capacity[index]
            if share <= 0.0:
                return f"{at} does not pull at all"
            wanted = 1.0 + task.limits.force_reserve
            return f"{at} pulls {share:.3g} times the load; {wanted:.3g} times is required"
        case "force_limit":
            limit = part.limits.max_force
            return f"{at} carries {rest.tension[index]:.4g} N per muscle; the maker allows {limit:.4g} N"
        case "suspended_mass":
            return f"{who} {_carrying(task, part, parallel)}"
        case "diameter":
            room = task.limits.max_diameter or 0.0
            return (
                f"{at} bulges to {rest.outer_diameter[index] * 1e3:.3g} mm; {room * 1e3:.3g} mm is available"
            )
        case "stiffness":
            wanted = task.limits.stiffness or 0.0
            return f"{at} has a stiffness of {rest.stiffness[index]:.4g} N/m; {wanted:.4g} N/m is required"
        case "life":
            wanted = task.limits.life or 0.0
            return f"{at} lasts about {rest.life[index]:.2g} cycles (an estimate); {wanted:.2g} is required"
        case _:
            return f"{at} does not fit"


def _carrying(task: Task, part: MusclePart, parallel: int) -> str:
    """What hangs on each muscle, and what its maker permits."""
    mass = task.suspended_mass / (parallel * task.lever_ratio)
    each = "" if parallel == 1 else " each"
    return f"would carry {mass:.4g} kg{each}; the maker permits {part.suspended_mass:.4g} kg freely suspended"


def remedies_text(
    sheet: Sheet, parallel: int, lacking: Shortfall, others: tuple[str, ...], lateness: Lateness
) -> str:
    """Changes that would make this number of muscles suffice, least change first, another muscle last.

    Each is the least of its kind to a millimetre, 0.01 bar or three digits, rounded to where it suffices.
    A run says how long the stroke then takes; what does not arrive at all is no remedy.
    """
    task, part = sheet.task, sheet.part
    texts: list[str] = []

    def offer(text: str, count: int = parallel, limit: LimitName | None = None) -> None:
        late = lateness.get((part.id, count, limit))
        if late is None:
            texts.append(f"{text} (at rest; not simulated)")
        elif late <= 1.0 + _ROUNDING:
            texts.append(text)
        elif isfinite(late):
            texts.append(f"{text}, and {rounded_up(late, 3)} times the time allowed")

    for name, remedy in sorted(lacking.remedies.items(), key=lambda item: item[1].share):
        rest, share = remedy.rest, remedy.share
        match name:
            case "length":
                long = ceil(1e3 * float(rest.length[0]) - _ROUNDING)
                more = long - 1e3 * (task.limits.max_length - task.limits.end_fittings)
                offer(f"{long} mm long (+{more:.0f} mm of room)", limit=name)
            case "pressure":
                bar = ceil(1e2 * float(rest.pressure[0]) / _BAR - _ROUNDING) / 1e2
                more_bar = bar - task.available_pressure / _BAR
                offer(f"{bar:.4g} bar ({more_bar:.2g} bar more)", limit=name)
            case "contraction" if part.limits.max_contraction is not None:
                if rest.contraction[0] <= part.limits.max_contraction * (1.0 + 1e-9):
                    offer(f"{rounded_up(float(rest.contraction[0]) * 100, 3)} % contraction", limit=name)
            case "force" if rest.capacity[0] > 0.0:
                if rest.capacity[0] >= 1.0:
                    reserve = rounded_down((float(rest.capacity[0]) - 1.0) * 100, 2)
                    offer(f"a force reserve of {reserve} %", limit=name)
                else:
                    offer(f"{rounded_up(share / (1.0 + share) * 100, 2)} % less load", limit=name)
            case "diameter":
                wide = float(rest.outer_diameter[0])
                more = wide - (task.limits.max_diameter or 0.0)
                offer(
                    f"{rounded_up(wide * 1e3, 3)} mm of diameter (+{rounded_up(more * 1e3, 2)} mm)",
                    limit=name,
                )
            case "suspended_mass":
                offer(f"{rounded_up(share / (1.0 + share) * 100, 2)} % less mass", limit=name)
            case "stiffness":
                offer(f"{rounded_down(float(rest.stiffness[0]), 3)} N/m accepted", limit=name)
            case "life":
                offer(f"{rounded_down(float(rest.life[0]), 2)} cycles accepted", limit=name)
            case _:
                pass
    for count in range(parallel + 1, int(sheet.rest.parallel.max()) + 1):
        if len(sheet.sound(count)):
            before = len(texts)
            offer(f"{count} in parallel", count)
            if len(texts) > before:
                break
    if others:
        texts.append(f"{others[0]} instead")
    return "; or ".join(texts) if texts else "nothing that is in the catalogue"


def rounded_up(value: float, digits: int) -> str:
    """A positive number with so many digits, not below the value."""
    return _towards(value, digits, ceil)


def rounded_down(value: float, digits: int) -> str:
    """A positive number with so many digits, not above the value."""
    return _towards(value, digits, floor)


def _towards(value: float, digits: int, to: Callable[[float], int]) -> str:
    unit = 10.0 ** (floor(log10(value)) - digits + 1) if value > 0.0 else 1.0
    hair = -_ROUNDING if to is ceil else _ROUNDING
    return f"{to(value / unit + hair) * unit:.{digits}g}"


def group_text(group: Group) -> str:
    """The muscles with their valve and their tube."""
    tube = f"{group.tube.id}" if group.tube.id else "no tube"
    return f"{number_text(group.parallel, group.muscle)} with {group.valve.id} and {tube}"


def valve_text(group: Group, pressures: tuple[float, float]) -> str:
    """Why a valve does not suit the lowest and highest pressure at which the muscles carry the load [Pa]."""
    low, high = group.valve.min_pressure, group.valve.max_pressure
    ends = " to ".join(f"{end / _BAR:.3g} bar" for end in (low, high) if end is not None)
    needed = f"{pressures[0] / _BAR:.3g} to {pressures[1] / _BAR:.3g} bar"
    return f"the valve is made for {ends}, and the muscles need {needed}"


def slow_text(trial: Trial | None, task: Task) -> str:
    """Which requirement a run misses; without a run, the result of the closed form."""
    if trial is None:
        wanted = min(time or task.fill_time for time in (task.time, task.cycle_time))
        return f"even at choked flow the air for the stroke takes longer than the {wanted:.3g} s allowed"
    figures, design = trial.figures, trial.design
    at = f"{length_text(design.length)} at {design.pressure / _BAR:.3g} bar"
    if figures.time is None:
        reached = max(figures.reached, 0.0)
        return f"{at} reaches {length_text(reached)} within {task.fill_time:.3g} s"
    match trial.binding:
        case "time":
            return f"{at} takes {figures.time:.3g} s for the stroke; {task.time:.3g} s is required"
        case "time_down" if figures.time_down is None:
            return f"{at} does not return within {task.vent_time:.3g} s"
        case "time_down":
            return f"{at} takes {figures.time_down:.3g} s for the return; {task.time_down:.3g} s is required"
        case "cycle_time" if figures.time_down is None:
            return f"{at} does not return within {task.vent_time:.3g} s"
        case "cycle_time":
            both = figures.time + (figures.time_down or 0.0)
            return f"{at} takes {both:.3g} s for stroke and return; {task.cycle_time:.3g} s is required"
        case "force_limit":
            return f"{at} peaks at {figures.peak_force:.4g} N while it moves, above what the maker allows"
        case _:
            return f"{at} does not hold the load at the end of the stroke"


def slow_remedy(trial: Trial | None, task: Task, binding: str, works: bool) -> str:
    """Changes that would make such a group fast enough."""
    texts = []
    demanded = {"time": task.time, "time_down": task.time_down, "cycle_time": task.cycle_time}.get(binding)
    if trial is not None and demanded is not None:
        needed = demanded * trial.excess()
        if isfinite(needed):
            late = rounded_up(needed - demanded, 2)
            texts.append(f"{rounded_up(needed, 3)} s allowed (+{late} s, the least that was tried)")
    if binding == "force_limit":
        texts.append("a lower pressure, or a valve or tube with less flow")
    else:
        texts.append("a valve or tube with more flow" + (", as proposed" if works else ""))
    return "; or ".join(texts)


def temperature_text(part: MusclePart, task: Task) -> str | None:
    """Why the ambient temperature rules the muscle out; None if it does not."""
    low, high = part.coldest, part.hottest
    if (low is None or task.temperature >= low) and (high is None or task.temperature <= high):
        return None
    ends = [f"{end - 273.15:.3g} °C" for end in (low, high) if end is not None]
    return f"{part.id} is made for {' to '.join(ends)}; the task states {task.temperature - 273.15:.3g} °C"
