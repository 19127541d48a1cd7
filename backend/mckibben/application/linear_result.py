"""The linear view of a drive as a result: plain numbers, names and units."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mckibben.simulation.command.pid import PidController
from mckibben.simulation.linear.design import Design
from mckibben.simulation.linear.equations import COMMAND, READING, Port
from mckibben.simulation.linear.linearise import Linearisation
from mckibben.simulation.linear.loop import Margins, loop_response, margins
from mckibben.simulation.linear.model import LinearModel
from mckibben.simulation.linear.response import (
    Pole,
    bandwidth,
    frequencies_for,
    frequency_response,
    phase_of,
    poles_of,
    static_gain,
)
from mckibben.simulation.linear.sweep import DescribingPoint
from mckibben.simulation.linear.trials import StepFigures, Trial

Array = np.ndarray

_ROWS = 600  # of the run of a controller


@dataclass(frozen=True, slots=True)
class NamedValue:
    """A state, input or output: name, SI unit, what it is, and its value at the operating point."""

    name: str
    unit: str
    text: str
    value: float


@dataclass(frozen=True, slots=True)
class PointResult:
    """The operating point, SI; pressures gauge.

    Attributes:
        on_stop: whether the load rests on an end stop there.
        command: that holds it [-].
        load_force: external force on the load.
    """

    position: float
    contraction: float
    pressure: float
    counter_pressure: float | None
    command: float
    force: float
    load_force: float
    supply_pressure: float
    on_stop: bool


@dataclass(frozen=True, slots=True)
class Zero:
    """A zero of the channel [rad/s]."""

    real: float
    imaginary: float


@dataclass(frozen=True, slots=True)
class ModelResult:
    """A linear model and the response of the chosen channel.

    Attributes:
        name, text: what it is a model of.
        primary: whether loop and design use it.
        pressure: gauge pressure at which it was linearised [Pa].
        dead_time: of the command [s]; in ``gain`` and ``phase``, not in the matrices.
        a, b, c, d: matrices of deviations in SI.
        poles, zeros: of the model, of the channel.
        static_gain: of the channel; None where it integrates.
        bandwidth: -3 dB [Hz]; ``bandwidth_note`` says why there is none.
        gain, phase: over ``frequency`` of the result [rad].
    """

    name: str
    text: str
    primary: bool
    pressure: float
    dead_time: float
    states: list[NamedValue]
    inputs: list[NamedValue]
    outputs: list[NamedValue]
    a: Array
    b: Array
    c: Array
    d: Array
    poles: list[Pole]
    zeros: list[Zero]
    static_gain: float | None
    bandwidth: float | None
    bandwidth_note: str | None
    gain: Array
    phase: Array


@dataclass(frozen=True, slots=True)
class ControllerResult:
    """Gains of a position controller, SI, and as a drive document states them.

    Attributes:
        document: for the part ``controller`` of a drive document, without its reference.
    """

    kp: float
    ki: float
    kd: float
    feed_forward: float
    derivative_filter: float
    sample_time: float
    output_min: float
    output_max: float
    document: dict[str, str]


@dataclass(frozen=True, slots=True)
class LoopResult:
    """The open and the closed loop of a controller with the primary model.

    Attributes:
        frequency: [Hz], up to half the sampling frequency.
        gain, phase: of the open loop [rad].
        closed_gain: from the reference to the position.
    """

    controller: ControllerResult
    margins: Margins
    frequency: Array
    gain: Array
    phase: Array
    closed_gain: Array


@dataclass(frozen=True, slots=True)
class TrialResult:
    """A controller, the figures of its steps on the nonlinear drive, its margins, and the run.

    Attributes:
        name: "own", "rule" or "refined".
        reference, position: of the load [m]; the step begins at ``begins`` [s] and ends at ``returns``.
    """

    name: str
    controller: ControllerResult
    figures: StepFigures
    margins: Margins
    begins: float
    returns: float
    time: Array
    reference: Array
    position: Array
    command: Array


@dataclass(frozen=True, slots=True)
class VariationResult:
    """The refined controller with another mass and supply, as factors."""

    mass: float
    supply: float
    figures: StepFigures


@dataclass(frozen=True, slots=True)
class GoalsResult:
    """Goals of a design; the height of the step [m] is that of its runs."""

    overshoot: float
    settling: float
    step: float
    unsaturated: bool


@dataclass(frozen=True, slots=True)
class DesignResult:
    """A designed controller; see `mckibben.simulation.linear.design.Design`."""

    goals: GoalsResult
    rule: str
    ultimate_gain: float | None
    ultimate_period: float | None
    trials: list[TrialResult]
    robust: list[VariationResult]
    evaluations: int
    remarks: list[str]


@dataclass(frozen=True, slots=True)
class LinearResult:
    """The linear view of a drive, SI, angles in rad.

    Attributes:
        point: where it was linearised.
        smooth: whether nothing sticks or switches there in a way that the motion shows.
        lost: what the linear models do not contain.
        dead_band: commands between which nothing reacts.
        input, output: the channel of responses, poles and zeros.
        frequency: [Hz], of ``models``.
        models: one, or several where something sticks or switches.
        describing: the nonlinear drive under sines.
        loop: with the drive's controller; None without one.
        design: None unless it was asked for.
        notes: remarks, as sentences.
    """

    point: PointResult
    smooth: bool
    lost: list[str]
    dead_band: list[float] | None
    input: NamedValue
    output: NamedValue
    frequency: Array
    models: list[ModelResult]
    describing: list[DescribingPoint]
    loop: LoopResult | None
    design: DesignResult | None
    notes: list[str]

    @property
    def primary(self) -> ModelResult:
        """The model that loop and design use."""
        return next(model for model in self.models if model.primary)


def point_of(linear: Linearisation) -> PointResult:
    """The operating point of a linearisation."""
    point, drive = linear.point, linear.point.bound.drive
    pressures = point.pressures
    return PointResult(
        position=point.position,
        contraction=point.contraction,
        pressure=pressures[0],
        counter_pressure=pressures[1] if len(pressures) == 2 else None,
        command=point.command,
        force=point.force,
        load_force=point.bound.load_force,
        supply_pressure=drive.supply_pressure,
        on_stop=point.on_stop is not None,
    )


def named(port: Port, value: float) -> NamedValue:
    """A port with its value."""
    return NamedValue(port.name, port.unit, port.text, value)


def input_values(linear: Linearisation) -> dict[str, float]:
    """Inputs at the operating point."""
    point, drive = linear.point, linear.point.bound.drive
    return {
        "command": point.command,
        "counter_command": drive.counter(point.command),
        "supply_pressure": drive.supply_pressure,
        "load_force": point.bound.load_force,
    }


def model_result(
    linear: Linearisation, model: LinearModel, source: str, out: str, frequency: Array
) -> ModelResult:
    """A model with the response of its channel at frequencies [Hz]."""
    point, bound = model.point, model.point.bound
    poles, zeros = poles_of(model, source, out)
    width, why = bandwidth(model, source, out)
    response = frequency_response(model, source, out, frequency)
    outputs = bound.values(point.state, point.command, point.switches, slides=point.direction != 0).ports
    inputs = input_values(linear)
    return ModelResult(
        name=model.name,
        text=model.text,
        primary=model is linear.primary,
        pressure=point.pressure,
        dead_time=model.dead_time,
        states=[named(port, float(point.state[bound.names.index(port.name)])) for port in model.states],
        inputs=[named(port, inputs[port.name]) for port in model.inputs],
        outputs=[named(port, float(value)) for port, value in zip(model.outputs, outputs, strict=True)],
        a=model.a,
        b=model.b,
        c=model.c,
        d=model.d,
        poles=poles,
        zeros=[Zero(zero.real, zero.imag) for zero in zeros],
        static_gain=static_gain(model, source, out),
        bandwidth=width,
        bandwidth_note=why,
        gain=np.abs(response),
        phase=phase_of(model, source, out, frequency, response),
    )


def near(points: list[DescribingPoint], model: ModelResult, frequency: Array) -> list[DescribingPoint]:
    """The points with their phases within half a turn of those of a model."""

    def turned(point: DescribingPoint) -> DescribingPoint:
        if not math.isfinite(point.phase):
            return point
        expected = float(np.interp(math.log(point.frequency), np.log(frequency), model.phase))
        phase = point.phase + 2.0 * math.pi * round((expected - point.phase) / (2.0 * math.pi))
        return DescribingPoint(
            point.frequency, point.amplitude, point.gain, phase, point.distortion, point.remark
        )

    return [turned(point) for point in points]


def controller_result(controller: PidController) -> ControllerResult:
    """The gains of a controller."""
    texts = {
        "kp": f"{controller.kp:.9g} 1/m",
        "ki": f"{controller.ki:.9g} 1/(m*s)",
        "kd": f"{controller.kd:.9g} s/m",
        "feed_forward": f"{controller.feed_forward:.9g} 1/m",
        "derivative_filter": f"{controller.derivative_filter:.9g} s",
        "sample_time": f"{controller.sample_time:.9g} s",
        "output_min": f"{controller.output_min:.9g}",
        "output_max": f"{controller.output_max:.9g}",
    }
    return ControllerResult(
        controller.kp,
        controller.ki,
        controller.kd,
        controller.feed_forward,
        controller.derivative_filter,
        controller.sample_time,
        controller.output_min,
        controller.output_max,
        {"type": "pid", **texts},
    )


def loop_result(linear: Linearisation, controller: PidController) -> LoopResult:
    """The loop of a controller with the primary model."""
    axis = frequencies_for(linear.primary)
    frequency = axis[axis < 0.4999 / controller.sample_time]
    loop, closed = loop_response(linear.primary, controller, frequency)
    return LoopResult(
        controller=controller_result(controller),
        margins=margins(linear.primary, controller, axis),
        frequency=frequency,
        gain=np.abs(loop),
        phase=phase_of(linear.primary, COMMAND.name, READING.name, frequency, loop),
        closed_gain=np.abs(closed),
    )


def design_result(found: Design) -> DesignResult:
    """A design with its runs."""
    goals = found.goals
    return DesignResult(
        goals=GoalsResult(goals.overshoot, goals.settling, goals.step or 0.0, goals.unsaturated),
        rule=found.rule,
        ultimate_gain=found.ultimate_gain,
        ultimate_period=found.ultimate_period,
        trials=[_trial(trial, goals.settling) for trial in found.trials],
        robust=[VariationResult(each.mass, each.supply, each.figures) for each in found.robust],
        evaluations=found.evaluations,
        remarks=list(found.remarks),
    )


def _trial(trial: Trial, settling: float) -> TrialResult:
    rows = slice(None, None, max(1, len(trial.time) // _ROWS))
    return TrialResult(
        name=trial.name,
        controller=controller_result(trial.controller),
        figures=trial.figures,
        margins=trial.margins,
        begins=settling,
        returns=3.0 * settling,
        time=trial.time[rows],
        reference=trial.reference[rows],
        position=trial.position[rows],
        command=trial.command[rows],
    )
