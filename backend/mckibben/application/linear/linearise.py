"""The linear view of a drive: models at an operating point, responses, loop, sweep, controller design."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mckibben.application.linear.result import (
    LinearResult,
    design_result,
    gain_unit,
    input_values,
    loop_result,
    model_result,
    named,
    near,
    point_of,
)
from mckibben.documents.drive_reading import AnnotatedDrive
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.simulation.linear.bound import SLIDING_SPEED
from mckibben.simulation.linear.design import design
from mckibben.simulation.linear.equations import COMMAND, LOAD_FORCE, POSITION
from mckibben.simulation.linear.linearise import Linearisation, linearise
from mckibben.simulation.linear.point import Condition
from mckibben.simulation.linear.response import eigenvalues, frequencies_for
from mckibben.simulation.linear.sweep import SWEPT, DescribingPoint, describing_points
from mckibben.simulation.linear.trials import Goals
from mckibben.simulation.outcome import Watch

SHARES = (0.01, 0.05, 0.2)  # amplitudes of a sweep: of the full command, of the tension of the muscle
MOST_AMPLITUDES = 6
_SWEPT_FREQUENCIES = 10
_SWEEPABLE = ("position", "velocity", "pressure", "force", "mass_flow", "position_reading")


@dataclass(frozen=True, slots=True)
class LinearQuestion:
    """A drive, and what to show of its linear view.

    Attributes:
        annotated: the drive with notes on its parts.
        at: the operating point; None is the middle of the positions that can be held.
        input, output: the channel of responses, poles and zeros.
        amplitudes: of the sines for the nonlinear drive, in the unit of the input; None = `SHARES` of full
            command or tension, () = no sweep.
        goals: of a controller design; None = no design.
        sliding_speed: of the load, see `mckibben.simulation.linear.linearise.linearise` [m/s].
    """

    annotated: AnnotatedDrive
    at: Condition | None = None
    input: str = COMMAND.name
    output: str = POSITION.name
    amplitudes: tuple[float, ...] | None = None
    goals: Goals | None = None
    sliding_speed: float = SLIDING_SPEED


def linear_view(question: LinearQuestion, watch: Watch | None = None) -> LinearResult:
    """Answer a question.

    Raises:
        InputError: no such equilibrium (field "at"), channel ("input", "output"), amplitude ("amplitudes") or
            step ("design").
    """
    return prepare(question)(watch or Watch())


def prepare(question: LinearQuestion) -> Callable[[Watch], LinearResult]:
    """The linear models of a question, ready for sweep and design.

    Raises:
        InputError: as `linear_view`.
    """
    linear = linearise(question.annotated.drive, question.at, sliding_speed=question.sliding_speed)
    _check(question, linear)
    return lambda watch: _answer(question, linear, watch)


def _check(question: LinearQuestion, linear: Linearisation) -> None:
    model = linear.primary
    for field, name, ports in (
        ("input", question.input, model.inputs),
        ("output", question.output, model.outputs),
    ):
        known = [port.name for port in ports]
        if name not in known:
            raise InputError(
                f"there is no {field} '{name[:40]}'", field=field, hint=did_you_mean(name, known)
            )
    amplitudes = question.amplitudes or ()
    if len(amplitudes) > MOST_AMPLITUDES:
        raise InputError(f"{len(amplitudes)} amplitudes are more than {MOST_AMPLITUDES}", field="amplitudes")
    if any(not (math.isfinite(each) and each > 0.0) for each in amplitudes):
        raise InputError("an amplitude is not positive", field="amplitudes", hint="e.g. 5 %")


def _answer(question: LinearQuestion, linear: Linearisation, watch: Watch) -> LinearResult:
    source, out, drive = question.input, question.output, question.annotated.drive
    notes: list[str] = []
    with np.errstate(all="ignore"):
        frequency = frequencies_for(linear.primary, sweep_frequencies(linear))
        models = [model_result(linear, model, source, out, frequency) for model in linear.models]
        primary = next(model for model in models if model.primary)
        points = _swept(question, linear, watch, notes)
        loop = loop_found = None
        if drive.controller is not None and linear.point.on_stop is None:
            loop = loop_result(linear, drive.controller)
        if question.goals is not None:
            loop_found = design(linear, question.goals, watch)
    ports = {port.name: port for port in (*linear.primary.inputs, *linear.primary.outputs)}
    shown = {value.name: value.value for value in primary.outputs}
    return LinearResult(
        point=point_of(linear),
        smooth=linear.smooth,
        lost=list(linear.lost),
        dead_band=None if linear.dead_band is None else list(linear.dead_band),
        input=named(ports[source], input_values(linear)[source]),
        output=named(ports[out], shown[out]),
        gain_unit=gain_unit(ports[source], ports[out]),
        frequency=frequency,
        models=models,
        describing=near(points, primary, frequency),
        loop=loop,
        design=None if loop_found is None else design_result(loop_found),
        notes=notes,
    )


def _swept(
    question: LinearQuestion, linear: Linearisation, watch: Watch, notes: list[str]
) -> list[DescribingPoint]:
    """The sweep of the nonlinear drive, if the channel has one."""
    amplitudes = question.amplitudes
    if amplitudes == ():
        return []
    if linear.point.on_stop is not None:
        notes.append("no sweep: the load rests on its end stop")
        return []
    if question.input not in SWEPT or question.output not in _SWEEPABLE:
        notes.append(f"no sweep: it needs the input {' or '.join(SWEPT)} and an output of the first muscle")
        return []
    if question.input == LOAD_FORCE.name and question.annotated.drive.pair:
        notes.append("no sweep of the load force of an antagonist pair")
        return []
    if amplitudes is None:
        unit = 1.0 if question.input == COMMAND.name else max(linear.point.force, 1.0)
        amplitudes = tuple(share * unit for share in SHARES)
    points = describing_points(
        linear,
        source=question.input,
        out=question.output,
        frequencies=sweep_frequencies(linear),
        amplitudes=amplitudes,
        watch=watch,
    )
    if len(points) < len(amplitudes) * _SWEPT_FREQUENCIES:
        notes.append("the sweep was ended early: frequencies at the end are missing")
    return points


def sweep_frequencies(linear: Linearisation) -> list[float]:
    """Frequencies [Hz] around the slowest oscillation of the load, or from 0.1 to 3 Hz without one."""
    swinging = [abs(value) for value in eigenvalues(linear.primary) if value.imag > 0.1 * abs(value)]
    middle = min(swinging) / (2.0 * math.pi) if swinging else 1.0
    middle = min(max(middle, 0.2), 50.0)
    return [float(each) for each in np.geomspace(0.1 * middle, 3.0 * middle, _SWEPT_FREQUENCIES)]
