r"""A frequency sweep of the nonlinear drive: describing points beside the linear response.

A sine :math:`u_0 + b + a \sin\omega t` of the command runs until the oscillation repeats itself; amplitude
and phase of the output at the fundamental, over those of the sine, are one point (the describing function:
Gelb & Vander Velde, Multiple-Input Describing Functions, 1968). A drive that hardly damps goes on swinging by
itself: that oscillation is fitted beside the sine, over more periods, and said. A valve that fills and vents
with different flows would drift away, so the bias b balances the two: equal areas of what flows in and out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from mckibben.facts.linear import DESCRIBING
from mckibben.facts.result import Number, result_class
from mckibben.simulation.command.waveforms import Sine
from mckibben.simulation.linear.equations import COMMAND, LOAD_FORCE
from mckibben.simulation.linear.linearise import Linearisation, balanced_bias, side_gains
from mckibben.simulation.linear.nonlinear import run_from
from mckibben.simulation.linear.response import eigenvalues
from mckibben.simulation.outcome import Outcome, Watch

Array = np.ndarray

SWEPT = (COMMAND.name, LOAD_FORCE.name)
_MEASURED = 2  # periods whose fundamental is taken
_LONGEST = 24  # most periods that are measured beside an oscillation of the drive itself
_SETTLING = (3, 24)  # least and most periods before
_ROWS = 48  # of a period
_TOLERANCE = 1e-5


# Outputs that are zero while the load does not move.
_OF_MOTION = ("position", "velocity", "position_reading")


@result_class
class DescribingPoint:
    """One frequency and amplitude."""

    FIGURES: ClassVar = DESCRIBING.name

    frequency: float
    amplitude: float
    gain: Number
    phase: Number
    distortion: Number
    remark: str | None
    """What kept it from being a clean oscillation; None if nothing did."""


def bias_of(linear: Linearisation, amplitude: float) -> float:
    """Offset of a sine of the command with which a valve lets in as much air as it lets out."""
    gains = side_gains(list(linear.models))
    if gains is None:
        return 0.0
    command = linear.point.command
    low, high = linear.dead_band or (command, command)
    return balanced_bias(gains, amplitude, (low - command, high - command))


def describing_points(
    linear: Linearisation,
    *,
    source: str,
    out: str,
    frequencies: Sequence[float],
    amplitudes: Sequence[float],
    watch: Watch | None = None,
) -> list[DescribingPoint]:
    """The nonlinear drive under sines, for each amplitude and frequency.

    Args:
        linear: where, and how the drive switches there.
        source: "command" or "load_force".
        out: name of an output of the models.
        frequencies: [Hz].
        amplitudes: in the unit of the input.
        watch: may end the sweep early; it then has fewer points.
    """
    found = []
    watch, total = watch or Watch(), len(frequencies) * len(amplitudes)
    for amplitude in amplitudes:
        bias = bias_of(linear, amplitude) if source == COMMAND.name else 0.0
        for frequency in frequencies:
            if watch.ended(len(found) / total) is not None:
                return found
            found.append(_point(linear, source, out, float(frequency), float(amplitude), bias))
    return found


def _point(
    linear: Linearisation, source: str, out: str, frequency: float, amplitude: float, bias: float
) -> DescribingPoint:
    point = linear.point
    drive = point.bound.drive
    slow = [-1.0 / value.real for value in eigenvalues(linear.primary) if value.real < -1e-3]
    oscillating = max((time for time in slow if time < 5.0), default=0.0)
    before = int(np.clip(math.ceil(4.0 * oscillating * frequency), *_SETTLING))
    ringing = _ringing(linear, before / frequency)
    measured = int(np.clip(math.ceil(3.0 * frequency / min(ringing, default=frequency)), _MEASURED, _LONGEST))
    duration = (before + measured) / frequency
    grid = np.linspace(before / frequency, duration, measured * _ROWS, endpoint=False)
    offset = point.command + bias
    if source == COMMAND.name:
        signal = Sine(amplitude=amplitude, offset=offset, frequency=frequency)
        lowest = 0.0 if drive.regulator is not None else -1.0
        clipped = offset + amplitude > 1.0 or offset - amplitude < lowest
        changed = replace(drive, command=signal, duration=duration)
    else:
        clipped = False
        force = Sine(amplitude=amplitude, offset=point.bound.load_force, frequency=frequency)
        held = Sine(amplitude=0.0, offset=point.command, frequency=1.0)
        changed = replace(drive, command=held, duration=duration, load=replace(drive.load, force=force))
    if clipped:
        return _nothing(frequency, amplitude, "the sine would leave the range of the command")
    run = run_from(point, changed, grid=grid, tolerance=_TOLERANCE)
    if run.outcome is not Outcome.COMPLETED:
        return _nothing(frequency, amplitude, f"the run ended early: {run.outcome.label}")
    if out in _OF_MOTION and not np.any(run.states["speed"]):
        return DescribingPoint(frequency, amplitude, 0.0, math.nan, math.nan, "dry friction holds the load")
    output = {
        "position": run.states["stroke"] / drive.load.lever_ratio,
        "velocity": run.states["speed"] / drive.load.lever_ratio,
        "pressure": run.pressure,
        "force": run.outputs["force"],
        "mass_flow": run.outputs["mass_flow"],
        "position_reading": run.outputs["stroke_reading"] / drive.load.lever_ratio,
    }[out]
    angle = 2.0 * math.pi * frequency * grid
    columns = np.column_stack([np.ones_like(grid), grid - grid.mean(), np.sin(angle), np.cos(angle)])
    fit = np.linalg.lstsq(columns, output, rcond=None)[0]
    rest, swinging = output - columns @ fit, 0.0
    apart = [own for own in ringing if abs(own - frequency) * measured > frequency]
    if apart:
        fit, rest, swinging = _beside_its_own(columns, output, grid, apart[0])
    fundamental = complex(fit[2], fit[3])
    total = math.sqrt(float(np.mean(rest**2)) + 0.5 * abs(fundamental) ** 2)
    distortion = math.sqrt(float(np.mean(rest**2))) / total if total > 0.0 else 0.0
    remark = None
    drift = abs(fit[1]) / frequency
    if np.any(run.outputs["contact"] != 0.0):
        remark = "the load touches an end stop"
    elif drift > 0.2 * abs(fundamental):
        remark = "the mean still drifts"
    elif len(ringing) > len(apart):
        remark = "the drive's own oscillation of nearly this frequency does not decay"
    elif swinging > 0.2 * abs(fundamental):
        remark = "the drive's own oscillation does not decay; it is taken off"
    return DescribingPoint(
        frequency, amplitude, abs(fundamental) / amplitude, float(np.angle(fundamental)), distortion, remark
    )


def _ringing(linear: Linearisation, seconds: float) -> list[float]:
    """Frequencies [Hz] of the drive's own oscillations that are not gone after a time, the lowest first."""
    values = [value for value in eigenvalues(linear.primary) if value.imag > 1e-6]
    return sorted(value.imag / (2.0 * math.pi) for value in values if -value.real * seconds < 3.0)


def _beside_its_own(
    columns: Array, output: Array, time: Array, frequency: float
) -> tuple[Array, Array, float]:
    """Fit beside an oscillation whose frequency is sought within 10 %; its rest, and its amplitude."""
    found: tuple[Array, Array, float] | None = None
    for share in np.linspace(0.9, 1.1, 41):
        angle = 2.0 * math.pi * frequency * share * time
        wider = np.column_stack([columns, np.sin(angle), np.cos(angle)])
        fit = np.linalg.lstsq(wider, output, rcond=None)[0]
        rest = output - wider @ fit
        if found is None or float(rest @ rest) < float(found[1] @ found[1]):
            found = fit, rest, math.hypot(fit[-2], fit[-1])
    assert found is not None  # noqa: S101 - there are shares
    return found


def _nothing(frequency: float, amplitude: float, remark: str) -> DescribingPoint:
    return DescribingPoint(frequency, amplitude, math.nan, math.nan, math.nan, remark)
