"""Text on why a candidate is rejected and what would help, with figures."""

from __future__ import annotations

from math import isfinite

from mckibben.sizing.catalogue import Group, MusclePart
from mckibben.sizing.design_table import Sheet, Shortfall
from mckibben.sizing.statics import contraction_limit
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial

_BAR = 1e5


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
                f"{length_text(sheet.duty.pull)} at {most * 100:.3g} % contraction needs a muscle of "
                f"{length_text(least)}; the longest {part.id} is {length_text(part.longest)}"
            )
        if part.shortest > room:
            return f"the shortest {part.id} is {length_text(part.shortest)}; {length_text(room)} is available"
        if least > room:
            return (
                f"{length_text(sheet.duty.pull)} at {most * 100:.3g} % contraction needs a muscle of "
                f"{length_text(least)}; {length_text(room)} is available"
            )
    index = lacking.best if lacking.best is not None else next(iter(lacking.remedies.values()))[0]
    at = (
        f"{who} of {length_text(rest.length[index])} at {rest.pressure[index] / _BAR:.3g} bar and "
        f"{rest.contraction[index] * 100:.3g} % contraction"
    )
    worst = min(sheet.margins, key=lambda name: float(sheet.margins[name][index]))
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


def remedies_text(sheet: Sheet, parallel: int, lacking: Shortfall, others: tuple[str, ...]) -> str:
    """Changes that would make this number of muscles suffice, least change first, another muscle last."""
    task, rest, part = sheet.task, sheet.rest, sheet.part
    texts: list[str] = []
    for name, (index, share) in sorted(lacking.remedies.items(), key=lambda item: item[1][1]):
        match name:
            case "length":
                more = rest.length[index] + task.limits.end_fittings - task.limits.max_length
                texts.append(f"{length_text(rest.length[index])} long (+{length_text(more)} of room)")
            case "pressure":
                more = rest.pressure[index] - task.available_pressure
                texts.append(f"{rest.pressure[index] / _BAR:.3g} bar ({more / _BAR:.2g} bar more)")
            case "contraction" if part.limits.max_contraction is not None:
                if rest.contraction[index] <= part.limits.max_contraction * (1.0 + 1e-9):
                    texts.append(f"{rest.contraction[index] * 100:.3g} % contraction")
            case "force" if rest.capacity[index] > 0.0:
                if rest.capacity[index] >= 1.0:
                    texts.append(f"a force reserve of {(rest.capacity[index] - 1.0) * 100:.2g} %")
                else:
                    texts.append(f"{share / (1.0 + share) * 100:.2g} % less load")
            case "diameter":
                more = rest.outer_diameter[index] - (task.limits.max_diameter or 0.0)
                texts.append(f"{rest.outer_diameter[index] * 1e3:.3g} mm of diameter (+{more * 1e3:.2g} mm)")
            case "suspended_mass":
                texts.append(f"{share / (1.0 + share) * 100:.2g} % less mass")
            case "stiffness":
                texts.append(f"{rest.stiffness[index]:.3g} N/m accepted")
            case "life":
                texts.append(f"{rest.life[index]:.2g} cycles accepted")
            case _:
                pass
    more_muscles = [
        count for count in range(parallel + 1, int(rest.parallel.max()) + 1) if len(sheet.sound(count))
    ]
    if more_muscles:
        texts.append(f"{more_muscles[0]} in parallel")
    if others:
        texts.append(f"{others[0]} instead")
    return "; or ".join(texts) if texts else "nothing that is in the catalogue"


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
            texts.append(f"{needed:.3g} s allowed (+{needed - demanded:.2g} s)")
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
