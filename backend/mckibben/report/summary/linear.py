"""Summary of the linear view: operating point, poles, loop, sweep, design, what is lost."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from mckibben.application.linear.result import LinearResult, ModelResult
from mckibben.facts.figure import Group
from mckibben.facts.linear import (
    CONTROLLER,
    DESCRIBING,
    DESIGN,
    LINEAR_MODEL,
    LINEAR_POINT,
    MARGINS,
    POLE,
    STEP_DESIGN,
)
from mckibben.facts.units import QUANTITIES
from mckibben.report.summary import Summary, Table, figure, shown
from mckibben.simulation.linear.loop import Margins

RUN_BESIDE = "a run of the drive with these gains"
_GAINS = ("kp", "ki", "kd", "feed_forward")
_OF_STEPS = ("overshoot", "settling", "rise", "saturated")
_OF_POLES = ("frequency", "oscillation_frequency", "damping", "time_constant")


def summary_of(result: LinearResult, name: str) -> Summary:
    """Everything but the matrices and the curves.

    Args:
        result: the linear view.
        name: of the drive, for the title.
    """
    return [
        point_table(result, name),
        models_table(result),
        *(poles_table(model, result) for model in result.models if model.primary),
        *([] if result.loop is None else [loop_table(result.loop.margins)]),
        *sweep_table(result),
        *design_tables(result),
        *dead_band(result),
        *(f"{RUN_BESIDE}: {loop.run}" for loop in [result.loop] if loop is not None and loop.run),
        *(f"not in the model: {text}" for text in result.lost),
        *result.notes,
    ]


def _cells(group: Group, holder: object, names: Iterable[str]) -> list[str]:
    return [shown(group[name], getattr(holder, name)) for name in names]


def _labels(group: Group, names: Iterable[str]) -> list[str]:
    return [group[name].label for name in names]


def point_table(result: LinearResult, name: str) -> Table:
    """The operating point."""
    names = [each for each in LINEAR_POINT if getattr(result.point, each) is not None]
    rows = zip(_labels(LINEAR_POINT, names), _cells(LINEAR_POINT, result.point, names), strict=True)
    return Table(f"{name}: operating point", ["", ""], [list(row) for row in rows])


def dead_band(result: LinearResult) -> list[str]:
    """Between which commands nothing reacts, where there are such."""
    if result.dead_band is None:
        return []
    low, high = (shown(LINEAR_POINT["command"], each) for each in result.dead_band)
    return [f"nothing reacts to commands between {low} and {high}"]


def models_table(result: LinearResult) -> Table:
    """Static gain and bandwidth of the channel in each model."""
    gain_unit = f" {result.gain_unit}"
    rows = [
        [
            model.name + (" *" if model.primary and len(result.models) > 1 else ""),
            "integrates" if model.static_gain is None else figure(model.static_gain, unit=gain_unit),
            model.bandwidth_note or shown(LINEAR_MODEL["bandwidth"], model.bandwidth),
        ]
        for model in result.models
    ]
    title = f"{result.input.name} to {result.output.name}"
    if len(result.models) > 1:
        title += " (* the model of loop and design)"
    return Table(title, ["model", *_labels(LINEAR_MODEL, ("static_gain", "bandwidth"))], rows)


def poles_table(model: ModelResult, result: LinearResult) -> Table:
    """Poles and zeros of a model; a zero has a frequency only."""
    rows = [
        [
            pole.kind,
            _complex(pole.real, pole.imaginary),
            *_cells(POLE, pole, _OF_POLES),
            "no" if pole.cancelled else "yes",
        ]
        for pole in model.poles
    ]
    rows += [
        [
            "zero",
            _complex(zero.real, zero.imaginary),
            shown(POLE["frequency"], zero.frequency),
            *("–" for _ in _OF_POLES[1:]),
            "yes",
        ]
        for zero in model.zeros
    ]
    columns = ["pole", POLE["real"].unit, *_labels(POLE, _OF_POLES), f"in {result.output.name}"]
    return Table(f"{POLE.title}, {model.name}", columns, rows)


def _complex(real: float, imaginary: float) -> str:
    return figure(real) if abs(imaginary) < 1e-9 else f"{figure(real)} ± {figure(imaginary)}i"


def loop_table(margins: Margins) -> Table:
    """Margins of the loop with the drive's controller."""
    return Table(
        "Loop with the drive's controller",
        ["", ""],
        [
            ["Closed loop", "stable" if margins.stable else "unstable"],
            *([each.label, shown(each, getattr(margins, name))] for name, each in MARGINS.items()),
        ],
    )


def sweep_table(result: LinearResult) -> list[Table]:
    """Describing points: gain of the nonlinear drive, its phase, and how far it is from a sine."""
    amplitudes = sorted({point.amplitude for point in result.describing})
    frequencies = sorted({point.frequency for point in result.describing})
    if not frequencies:
        return []
    table = {(point.frequency, point.amplitude): point for point in result.describing}
    plain = result.input.unit == "1"
    rows = []
    for frequency in frequencies:
        cells = []
        for amplitude in amplitudes:
            point = table.get((frequency, amplitude))
            good = point is not None and math.isfinite(point.gain)
            cells.append(
                "–"
                if not (point and good)
                else f"{figure(point.gain)}  {math.degrees(point.phase):.0f}°  "
                f"{shown(DESCRIBING['distortion'], point.distortion)}"
                if math.isfinite(point.phase)
                else figure(point.gain)
            )
        rows.append([shown(DESCRIBING["frequency"], frequency), *cells])
    share = QUANTITIES["ratio"].scales["bar"]
    heads = [
        f"amplitude {figure(share.of(amplitude), unit=f' {share.unit}')}"
        if plain
        else f"amplitude {figure(amplitude, unit=f' {result.input.unit}')}"
        for amplitude in amplitudes
    ]
    title = f"{DESCRIBING.title}: gain in {result.gain_unit}, phase, distortion"
    return [Table(title, [DESCRIBING["frequency"].label, *heads], rows)]


def design_tables(result: LinearResult) -> Summary:
    """The controllers of a design, and how robust the refined one is."""
    design = result.design
    if design is None:
        return []
    goals = design.goals
    title = (
        f"Controllers: steps of {shown(DESIGN['step'], goals.step)} and back, overshoot at most "
        f"{shown(STEP_DESIGN['overshoot'], goals.overshoot)}, settled in "
        f"{shown(STEP_DESIGN['settling'], goals.settling)}" + (", no saturation" if goals.unsaturated else "")
    )
    margins = ("gain_margin", "phase_margin")
    rows = [
        *_rows(CONTROLLER, _GAINS, [trial.controller for trial in design.trials]),
        *_rows(STEP_DESIGN, _OF_STEPS, [trial.figures for trial in design.trials]),
        ["Linear loop", *("stable" if trial.margins.stable else "unstable" for trial in design.trials)],
        *_rows(MARGINS, margins, [trial.margins for trial in design.trials]),
        ["Meets the goals", *("yes" if trial.figures.meets else "no" for trial in design.trials)],
    ]
    of_robust = _OF_STEPS[:2]
    robust = Table(
        "The refined controller with another mass and supply",
        [*_labels(DESIGN, ("mass", "supply")), *_labels(STEP_DESIGN, of_robust), "Meets the goals"],
        [
            [
                *_cells(DESIGN, each, ("mass", "supply")),
                *_cells(STEP_DESIGN, each.figures, of_robust),
                "yes" if each.figures.meets else "no",
            ]
            for each in design.robust
        ],
    )
    ultimate = [
        f"{DESIGN[name].label.lower()} {shown(DESIGN[name], value)}"
        for name in ("ultimate_gain", "ultimate_period")
        if (value := getattr(design, name)) is not None
    ]
    rule = (
        f"rule: {', '.join([design.rule, *ultimate])}; refined in {design.evaluations} runs of the nonlinear "
        "drive"
    )
    return [Table(title, ["", *(trial.name for trial in design.trials)], rows), robust, rule, *design.remarks]


def _rows(group: Group, names: Iterable[str], holders: list[Any]) -> list[list[str]]:
    """A row for each figure, a column for each controller."""
    return [
        [group[name].label, *(shown(group[name], getattr(each, name)) for each in holders)] for name in names
    ]
