"""Summary of the linear view: operating point, poles, loop, sweep, design, what is lost."""

from __future__ import annotations

import math

from mckibben.application.linear.result import LinearResult, ModelResult, TrialResult
from mckibben.report.summary.parts import Summary, Table, figure
from mckibben.simulation.linear.loop import Margins
from mckibben.simulation.linear.response import Pole
from mckibben.simulation.linear.trials import StepFigures

_KINDS = {"oscillation": "oscillation", "real": "real", "integrator": "integrator", "unstable": "unstable"}


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
        *(f"not in the model: {text}" for text in result.lost),
        *result.notes,
    ]


def point_table(result: LinearResult, name: str) -> Table:
    """The operating point."""
    point = result.point
    rows = [
        ["position", figure(point.position * 1e3, unit=" mm")],
        ["contraction", figure(point.contraction * 100, unit=" %")],
        ["pressure", figure(point.pressure / 1e5, unit=" bar")],
        *(
            []
            if point.counter_pressure is None
            else [["pressure of the second muscle", figure(point.counter_pressure / 1e5, unit=" bar")]]
        ),
        ["command", figure(point.command * 100, unit=" %")],
        ["force of the muscle", figure(point.force, unit=" N")],
        ["external force", figure(point.load_force, unit=" N")],
    ]
    return Table(f"{name}: operating point", ["", ""], rows)


def models_table(result: LinearResult) -> Table:
    """Static gain and bandwidth of the channel in each model."""
    unit = f" {result.output.unit}" + ("" if result.input.unit == "1" else f"/{result.input.unit}")
    rows = [
        [
            model.name + (" *" if model.primary and len(result.models) > 1 else ""),
            "integrates" if model.static_gain is None else figure(model.static_gain, unit=unit),
            figure(model.bandwidth, unit=" Hz"),
        ]
        for model in result.models
    ]
    title = f"{result.input.name} to {result.output.name}"
    if len(result.models) > 1:
        title += " (* the model of loop and design)"
    return Table(title, ["model", "static gain", "bandwidth"], rows)


def poles_table(model: ModelResult, result: LinearResult) -> Table:
    """Poles and zeros of a model."""
    rows = [[*_pole_cells(pole), "no" if pole.cancelled else "yes"] for pole in model.poles]
    for zero in model.zeros:
        size = math.hypot(zero.real, zero.imaginary)
        damping = "–" if size == 0.0 else figure(-zero.real / size)
        rows.append(["zero", _complex(zero.real, zero.imaginary), _hertz(size), damping, "–", "yes"])
    columns = ["pole", "rad/s", "frequency", "damping", "time constant", f"in {result.output.name}"]
    return Table(f"Poles and zeros, {model.name}", columns, rows)


def _pole_cells(pole: Pole) -> list[str]:
    time = None if pole.time_constant is None else pole.time_constant * 1e3
    return [
        _KINDS[pole.kind],
        _complex(pole.real, pole.imaginary),
        _hertz(pole.frequency * 2.0 * math.pi),
        figure(pole.damping),
        figure(time, unit=" ms"),
    ]


def _complex(real: float, imaginary: float) -> str:
    return figure(real) if abs(imaginary) < 1e-9 else f"{figure(real)} ± {figure(imaginary)}i"


def _hertz(size: float) -> str:
    return figure(size / (2.0 * math.pi), unit=" Hz")


def loop_table(margins: Margins) -> Table:
    """Margins of the loop with the drive's controller."""
    phase = None if margins.phase_margin is None else math.degrees(margins.phase_margin)
    delay = None if margins.delay_margin is None else margins.delay_margin * 1e3
    rows = [
        ["closed loop", "stable" if margins.stable else "unstable"],
        ["gain margin", f"{_decibel(margins.gain_margin)} at {figure(margins.gain_margin_at, unit=' Hz')}"],
        ["phase margin", f"{figure(phase, unit='°')} at {figure(margins.crossover, unit=' Hz')}"],
        ["delay margin", figure(delay, unit=" ms")],
        ["least distance from -1", figure(margins.modulus_margin)],
        ["bandwidth", figure(margins.bandwidth, unit=" Hz")],
    ]
    return Table("Loop with the drive's controller", ["", ""], rows)


def _decibel(factor: float | None) -> str:
    return "–" if factor is None or factor <= 0.0 else figure(20.0 * math.log10(factor), unit=" dB")


def sweep_table(result: LinearResult) -> list[Table]:
    """Describing points: gain of the nonlinear drive over that of the linear model."""
    amplitudes = sorted({point.amplitude for point in result.describing})
    frequencies = sorted({point.frequency for point in result.describing})
    if not frequencies:
        return []
    table = {(point.frequency, point.amplitude): point for point in result.describing}
    scale, unit = (100.0, " %") if result.input.unit == "1" else (1.0, f" {result.input.unit}")
    rows = []
    for frequency in frequencies:
        cells = []
        for amplitude in amplitudes:
            point = table.get((frequency, amplitude))
            good = point is not None and math.isfinite(point.gain)
            cells.append(f"{figure(point.gain)}  {math.degrees(point.phase):.0f}°" if point and good else "–")
        rows.append([figure(frequency, unit=" Hz"), *cells])
    heads = [f"amplitude {figure(scale * amplitude, unit=unit)}" for amplitude in amplitudes]
    return [Table("Gain and phase of the nonlinear drive", ["frequency", *heads], rows)]


def design_tables(result: LinearResult) -> Summary:
    """The controllers of a design, and how robust the refined one is."""
    design = result.design
    if design is None:
        return []
    goals = design.goals
    title = (
        f"Controllers: steps of {figure(goals.step * 1e3, unit=' mm')} and back, overshoot at most "
        f"{figure(goals.overshoot * 100, unit=' %')}, settled in {figure(goals.settling, unit=' s')}"
        + (", no saturation" if goals.unsaturated else "")
    )
    columns = ["", *(trial.name for trial in design.trials)]
    rows = [
        [label, *(cell(trial) for trial in design.trials)]
        for label, cell in (
            ("kp", lambda t: figure(t.controller.kp, unit=" 1/m")),
            ("ki", lambda t: figure(t.controller.ki, unit=" 1/(m s)")),
            ("kd", lambda t: figure(t.controller.kd, unit=" s/m")),
            ("feed forward", lambda t: figure(t.controller.feed_forward, unit=" 1/m")),
            ("overshoot", lambda t: _percent(t.figures.overshoot)),
            ("settling time", lambda t: figure(t.figures.settling, unit=" s")),
            ("rise time", lambda t: figure(t.figures.rise, unit=" s")),
            ("time at the limits", lambda t: _percent(t.figures.saturated)),
            ("linear loop", lambda t: "stable" if t.margins.stable else "unstable"),
            ("gain margin", lambda t: _decibel(t.margins.gain_margin)),
            ("phase margin", _phase_margin),
            ("meets the goals", lambda t: "yes" if t.figures.meets else "no"),
        )
    ]
    robust = Table(
        "The refined controller with another mass and supply",
        ["mass, supply", "overshoot", "settling time", "meets the goals"],
        [[f"{each.mass:.0%}, {each.supply:.0%}", *_robust_cells(each.figures)] for each in design.robust],
    )
    rule = f"rule: {design.rule}; refined in {design.evaluations} runs of the nonlinear drive"
    return [Table(title, columns, rows), robust, rule, *design.remarks]


def _robust_cells(figures: StepFigures) -> list[str]:
    settling = figure(figures.settling, unit=" s")
    return [_percent(figures.overshoot), settling, "yes" if figures.meets else "no"]


def _phase_margin(trial: TrialResult) -> str:
    margin = trial.margins.phase_margin
    return figure(None if margin is None else math.degrees(margin), unit="°")


def _percent(share: float) -> str:
    return figure(share * 100, unit=" %") if math.isfinite(share) else "–"
