"""The linear view of a drive as a result: plain numbers, names and units."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import ClassVar

import numpy as np

from mckibben.facts.linear import CONTROLLER, DESIGN, LINEAR_MODEL, LINEAR_POINT, LOOP_RESPONSE, POLE
from mckibben.facts.result import FiniteRows, FiniteSeries, Series, result_class
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.linear.design import Design
from mckibben.simulation.linear.equations import COMMAND, READING, Port
from mckibben.simulation.linear.linearise import Linearisation
from mckibben.simulation.linear.loop import Margins, loop_response, margins
from mckibben.simulation.linear.model import LinearModel, name_of_state
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
from mckibben.simulation.linear.trials import StepFigures, Trial, TrialName

Array = np.ndarray

_ROWS = 600  # of the run of a controller


@result_class
class NamedValue:
    """A state, input or output: name, SI unit, what it is, and its value at the operating point."""

    name: str
    """Name."""
    unit: str
    """SI unit."""
    text: str
    """What it is."""
    value: float
    """Value at the operating point, in its unit."""


@result_class
class PointResult:
    """The operating point, SI; pressures gauge."""

    FIGURES: ClassVar = LINEAR_POINT.name

    position: float
    contraction: float
    pressure: float
    counter_pressure: float | None
    command: float
    force: float
    load_force: float
    supply_pressure: float
    on_stop: bool
    """Whether the load rests on an end stop."""


@result_class
class Zero:
    """A zero of the channel [rad/s]."""

    FIGURES: ClassVar = POLE.name

    real: float
    imaginary: float
    frequency: float


@result_class
class ModelResult:
    """A linear model and the response of the chosen channel."""

    FIGURES: ClassVar = LINEAR_MODEL.name

    name: str
    """Name."""
    text: str
    """What it is a model of."""
    primary: bool
    """Whether loop and design use it."""
    pressure: float
    dead_time: float
    states: list[NamedValue]
    """States, in the order of the matrices."""
    inputs: list[NamedValue]
    """Inputs, in the order of the matrices."""
    outputs: list[NamedValue]
    """Outputs, in the order of the matrices."""
    a: FiniteRows
    """A, one list for each row."""
    b: FiniteRows
    """B, one list for each row."""
    c: FiniteRows
    """C, one list for each row."""
    d: FiniteRows
    """D, one list for each row."""
    poles: list[Pole]
    """Poles, slowest first."""
    zeros: list[Zero]
    """Zeros of the channel that hide no pole."""
    static_gain: float | None
    bandwidth: float | None
    bandwidth_note: str | None
    """Why there is no bandwidth."""
    gain: Series
    phase: Series

    def __str__(self) -> str:
        return self.name


@result_class
class ControllerResult:
    """Gains of a position controller, SI, and as a drive document states them."""

    FIGURES: ClassVar = CONTROLLER.name

    kp: float
    ki: float
    kd: float
    feed_forward: float
    derivative_filter: float
    sample_time: float
    output_min: float
    output_max: float
    document: dict[str, str]
    """The part `controller` of a drive document, without its reference."""


@result_class
class LoopResult:
    """The open and the closed loop of a controller with the primary model."""

    FIGURES: ClassVar = LOOP_RESPONSE.name

    controller: ControllerResult
    """The controller of the drive."""
    margins: Margins
    """Stability and margins."""
    run: str | None
    """What a run of the drive with these gains does, and why where the loop promises something else; None of
    a run of very many samples, which is not made.
    """
    frequency: FiniteSeries
    gain: Series
    phase: Series
    closed_gain: Series


@result_class
class TrialResult:
    """A controller, the figures of its steps on the nonlinear drive, its margins, and the run."""

    FIGURES: ClassVar = DESIGN.name

    name: TrialName
    """Where the controller comes from."""
    controller: ControllerResult
    """Its gains."""
    figures: StepFigures
    """Figures of its steps."""
    margins: Margins
    """Margins of its loop."""
    begins: float
    returns: float
    time: FiniteSeries
    """Instants of the run [s]."""
    reference: Series
    """Reference [m]."""
    position: Series
    """Position of the load [m]."""
    command: Series
    """Command [-]."""


@result_class
class VariationResult:
    """The refined controller with another mass and supply, as factors."""

    FIGURES: ClassVar = DESIGN.name

    mass: float
    supply: float
    figures: StepFigures
    """Figures of its steps."""


@result_class
class GoalsResult:
    """Goals of a design; the height of the step [m] is that of its runs."""

    overshoot: float
    """Largest overshoot [-]."""
    settling: float
    """Latest settling time [s]."""
    step: float
    """Height of the step [m]."""
    unsaturated: bool
    """Whether the command must never reach its limits."""


@result_class
class DesignResult:
    """A designed controller; see `mckibben.simulation.linear.design.Design`."""

    FIGURES: ClassVar = DESIGN.name

    goals: GoalsResult
    """Goals, with the height of the step."""
    rule: str
    """Name and source of the rule."""
    ultimate_gain: float | None
    ultimate_period: float | None
    trials: list[TrialResult]
    """Own controller if there is one, rule, refined."""
    robust: list[VariationResult]
    """Mass and supply 20 % lower and higher."""
    evaluations: int
    remarks: list[str]
    """What to know about the design."""


@result_class
class LinearResult:
    """The linear view of a drive, SI, angles in rad."""

    FIGURES: ClassVar = LINEAR_MODEL.name

    point: PointResult
    """Where it was linearised."""
    smooth: bool
    """Whether nothing sticks or switches there in a way the motion shows: there is one model."""
    lost: list[str]
    """What the linear models do not contain."""
    dead_band: list[float] | None
    """Commands between which nothing reacts [-]."""
    input: NamedValue
    """Input of the chosen channel."""
    output: NamedValue
    """Output of the chosen channel."""
    gain_unit: str
    """SI unit of static gain and gain: that of the output per that of the input."""
    frequency: FiniteSeries
    models: list[ModelResult]
    """One model, or several where something sticks or switches: each names its case."""
    describing: list[DescribingPoint]
    """The nonlinear drive under sines."""
    loop: LoopResult | None
    """Loop of the drive's controller; None without one."""
    design: DesignResult | None
    """The designed controller; None unless asked for."""
    notes: list[str]
    """Remarks, as sentences."""

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


def gain_unit(source: Port, out: Port) -> str:
    """SI unit of the gain of a channel; outputs have units."""
    return out.unit if source.unit == "1" else f"{out.unit}/{source.unit}"


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
    outputs = bound.values(point.state, point.command, point.switches, direction=point.motion).ports
    inputs = input_values(linear)
    return ModelResult(
        name=model.name,
        text=model.text,
        primary=model is linear.primary,
        pressure=point.pressure,
        dead_time=model.dead_time,
        states=[
            replace(named(port, float(point.state[bound.names.index(port.name)])), name=name_of_state(port))
            for port in model.states
        ],
        inputs=[named(port, inputs[port.name]) for port in model.inputs],
        outputs=[named(port, float(value)) for port, value in zip(model.outputs, outputs, strict=True)],
        a=model.a,
        b=model.b,
        c=model.c,
        d=model.d,
        poles=poles,
        zeros=[Zero(zero.real, zero.imag, abs(zero) / (2.0 * math.pi)) for zero in zeros],
        static_gain=static_gain(model, source, out),
        bandwidth=width,
        bandwidth_note=why,
        gain=np.abs(response),
        phase=phase_of(model, source, out, frequency, response),
    )


def near(points: list[DescribingPoint], model: ModelResult, frequency: Array) -> list[DescribingPoint]:
    """The points with their phases within half a turn of those of a model."""

    def within_half_a_turn(point: DescribingPoint) -> DescribingPoint:
        if not math.isfinite(point.phase):
            return point
        expected = float(np.interp(math.log(point.frequency), np.log(frequency), model.phase))
        phase = point.phase + 2.0 * math.pi * round((expected - point.phase) / (2.0 * math.pi))
        return replace(point, phase=phase)

    return [within_half_a_turn(point) for point in points]


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


def loop_result(
    linear: Linearisation, controller: PidController, stands_beside: Callable[[bool], str | None]
) -> LoopResult:
    """The loop of a controller with the primary model.

    Args:
        linear: the linear view.
        controller: of the drive.
        stands_beside: what a run says, of whether the loop is stable.
    """
    axis = frequencies_for(linear.primary)
    frequency = axis[axis < 0.4999 / controller.sample_time]
    loop, closed = loop_response(linear.primary, controller, frequency)
    found = margins(linear.primary, controller, axis)
    return LoopResult(
        controller=controller_result(controller),
        margins=found,
        run=stands_beside(found.stable),
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
