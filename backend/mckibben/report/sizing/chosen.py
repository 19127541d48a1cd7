"""Figures of a proposal for its report: curves, operating points, margins, spread of the specimens."""

from __future__ import annotations

import numpy as np

from mckibben.report.sizing.material import ForceCurves, Margin, SpecimenSpread
from mckibben.sizing import Design, Proposal, Task
from mckibben.sizing.spread import deviation_of
from mckibben.sizing.statics import contraction_limit, outputs

Array = np.ndarray

_COLUMNS, _PLACES = 121, 61
_BEYOND = 1.15  # end of the curves, as a multiple of the contraction at the end of the stroke
_BAR = 1e5
_FEW_BARS = 1.5  # supply [bar] below which the pressures of the curves are quarters of it


def curves_of(proposal: Proposal, task: Task) -> ForceCurves:
    """Force of one muscle over its contraction, and the force demanded over the stroke.

    Static values while filling, by the closed form that the search prunes with.
    """
    design, rest = proposal.design, proposal.trial.rest
    group, duty = design.group, design.group.duty
    reach = design.contraction
    contraction = np.linspace(0.0, max(_BEYOND * reach, contraction_limit(group.muscle, task)), _COLUMNS)
    pressures = _pressures(design.pressure)
    force = np.array([_force(design, task, contraction, pressure) for pressure in pressures])
    strokes = np.linspace(0.0, duty.stroke, _PLACES)
    places = reach * strokes / duty.stroke
    counter = np.zeros(_PLACES)
    if duty.pair:  # the second muscle is empty; it lengthens as the first one shortens
        counter = np.maximum(_force(design, task, places[::-1], 0.0), 0.0)
    share = duty.lever_ratio * group.parallel
    start, slope = duty.straight()
    straight = (duty.weight + start + slope * strokes) / share + counter
    demand = duty.load(strokes) / share + counter
    return ForceCurves(
        contraction=contraction.tolist(),
        pressures=pressures,
        force=force.tolist(),
        places=places.tolist(),
        demand=demand.tolist(),
        counter=counter.tolist(),
        carrying=(float(rest.lifting[0]), float(rest.holding[0])),
        run=() if np.allclose(straight, demand, rtol=1e-9, atol=1e-9) else straight.tolist(),
    )


def _pressures(supply: float) -> list[float]:
    """At most seven whole-bar pressures below the supply pressure, and the supply pressure itself."""
    if supply < _FEW_BARS * _BAR:
        return [supply * share for share in (0.25, 0.5, 0.75, 1.0)]
    step = max(round(supply / _BAR / 6.0), 1) * _BAR
    whole = [step * number for number in range(1, 8) if step * number < supply - 0.3 * step]
    return [*whole, supply]


def _force(design: Design, task: Task, contraction: Array, pressure: float) -> Array:
    rows = np.ones(len(contraction))
    return outputs(
        design.group.muscle,
        length=design.length * rows,
        contraction=contraction,
        pressure=pressure * rows,
        temperature=task.temperature,
    )["force"]


def margins_of(proposal: Proposal, task: Task) -> list[Margin]:
    """Allowed and actual value of each limit, the smallest margin first."""
    trial, design, rest, figures = (
        proposal.trial,
        proposal.design,
        proposal.trial.rest,
        proposal.trial.figures,
    )
    part, limits = design.group.muscle, task.limits
    up, down = figures.time or 0.0, figures.time_down or 0.0
    sides: dict[str, tuple[float | None, float, bool]] = {
        "length": (limits.max_length, design.length + limits.end_fittings, True),
        "pressure": (task.available_pressure, design.pressure, True),
        "contraction": (contraction_limit(part, task), design.contraction, True),
        "force": (1.0 + limits.force_reserve, float(rest.capacity[0]), False),
        "force_limit": (part.limits.max_force, max(float(rest.tension[0]), figures.peak_force), True),
        "suspended_mass": (
            part.suspended_mass,
            task.suspended_mass / (design.group.parallel * task.lever_ratio),
            True,
        ),
        "diameter": (limits.max_diameter, float(rest.outer_diameter[0]), True),
        "stiffness": (limits.stiffness, float(rest.stiffness[0]), False),
        "life": (limits.life, float(rest.life[0]), False),
        "time": (task.time, up, True),
        "time_down": (task.time_down, down, True),
        "cycle_time": (task.cycle_time, up + down, True),
    }
    margins = []
    for name, share in sorted(trial.margins.items(), key=lambda item: item[1]):
        allowed, actual, upper = sides[name]
        if allowed is not None:
            margins.append(Margin(name, allowed, actual, upper, share))
    return margins


def spread_of(proposal: Proposal, task: Task) -> SpecimenSpread | None:
    """How the simulated specimens differ; None if none were simulated."""
    if proposal.chance is None:
        return None
    uncertainty, part = task.uncertainty, proposal.design.group.muscle
    deviation = deviation_of(proposal.design, task)
    demands = ["it reaches the end of the stroke and stays there while the valve fills"]
    for words, demanded in (
        ("the stroke takes", task.time),
        ("the return takes", task.time_down),
        ("stroke and return together take", task.cycle_time),
    ):
        if demanded is not None:
            demands.append(f"{words} at most {demanded:.4g} s")
    return SpecimenSpread(
        blocked_force=uncertainty.blocked_force,
        shift=deviation.shift,
        hysteresis=(part.hysteresis or None) if uncertainty.hysteresis is None else uncertainty.hysteresis,
        friction=deviation.friction,
        supply=uncertainty.supply_pressure,
        demands=demands,
    )
