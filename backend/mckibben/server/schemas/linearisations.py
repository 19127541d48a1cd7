"""Schemas of the linear view."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mckibben.application.linearise import MOST_AMPLITUDES
from mckibben.documents.drive import DriveOrId, Position
from mckibben.documents.quantity import Contraction, Pressure, QuantityField
from mckibben.documents.strict import Series, Strict, si_field

Share = Annotated[float, QuantityField("1", "5 %", at_least=0.0, at_most=1.0)]
Settling = Annotated[float, QuantityField("s", "0.5 s", at_least=0.01, at_most=20.0)]
Amplitude = Annotated[float, Field(gt=0.0, le=1e6)]
Matrix = list[list[float]]


class LinearPointInput(Strict):
    """The operating point by one value; the others stay null."""

    position: Position | None = Field(None, description="Position of the load, positive = muscle shorter.")
    contraction: Contraction | None = Field(None, description="Contraction ratio of the (first) muscle.")
    pressure: Pressure | None = Field(None, description="Gauge pressure in the (first) muscle.")
    command: Share | None = Field(None, description="Set point of a regulator as a share of its range.")


class DesignInput(Strict):
    """Goals of a position controller, for steps of the nonlinear drive."""

    overshoot: Share = Field(0.05, description="Largest overshoot as a share of the step.")
    settling: Settling = Field(1.0, description="Time until the position stays within 2 % of the step.")
    step: Position | None = Field(
        None, description="Height of the step. Default: a tenth of the range between the stops."
    )
    unsaturated: bool = Field(False, description="Whether the command must never reach its limits.")


class LinearisationRequest(Strict):
    """A drive, an operating point, and what to show of its linear view."""

    drive: DriveOrId = Field(description="A drive document, or the id of a drive preset.")
    at: LinearPointInput | None = Field(
        None, description="Operating point. Default: the middle of the positions that can be held."
    )
    input: str = Field(
        "command",
        max_length=40,
        description="Input of responses, poles and zeros: command, supply_pressure or load_force; "
        "counter_command of an antagonist pair.",
    )
    output: str = Field(
        "position",
        max_length=40,
        description="Output: position, velocity, pressure, force, mass_flow or position_reading; of an "
        "antagonist pair also counter_pressure, counter_force or counter_mass_flow.",
    )
    amplitudes: Annotated[list[Amplitude], Field(max_length=MOST_AMPLITUDES)] | None = Field(
        None,
        description="Amplitudes of sines for the nonlinear drive, in the SI unit of the input. Default: 1, 5 "
        "and 20 % of full command or of the tension; an empty list: no sweep.",
    )
    design: DesignInput | None = Field(None, description="Goals of a controller design; null: no design.")


class LinearPointAnswer(Strict):
    """Where the drive was linearised."""

    position: float = si_field("m", "Position of the load.")
    contraction: float = si_field("1", "Contraction ratio of the (first) muscle.")
    pressure: float = si_field("Pa", "Gauge pressure in the (first) muscle.")
    counter_pressure: float | None = si_field("Pa", "Gauge pressure in the second muscle of a pair.")
    command: float = si_field("1", "Command that holds the load there.")
    force: float = si_field("N", "Tension of the (first) muscle.")
    load_force: float = si_field("N", "External force on the load.")
    supply_pressure: float = si_field("Pa", "Gauge pressure of the supply.")
    on_stop: bool = Field(description="Whether the load rests on an end stop.")


class NamedValue(Strict):
    """A state, an input or an output."""

    name: str = Field(description="Name.", examples=["pressure"])
    unit: str = Field(description="SI unit.", examples=["Pa"])
    text: str = Field(description="What it is.")
    value: float = Field(description="Value at the operating point, in its unit; states of gas absolute.")


class Pole(Strict):
    """A pole; of a complex pair the one with the positive imaginary part."""

    real: float = si_field("rad/s", "Real part.")
    imaginary: float = si_field("rad/s", "Imaginary part.")
    frequency: float = si_field("Hz", "Magnitude.")
    damping: float | None = si_field("1", "Damping ratio; null for an integrator.")
    time_constant: float | None = si_field("s", "Time constant of the decay; null where nothing decays.")
    kind: Literal["integrator", "real", "oscillation", "unstable"] = Field(description="Kind of motion.")
    cancelled: bool = Field(description="Whether a zero hides it in the chosen channel.")


class Zero(Strict):
    """A zero of the channel; of a complex pair the one with the positive imaginary part."""

    real: float = si_field("rad/s", "Real part.")
    imaginary: float = si_field("rad/s", "Imaginary part.")


class LinearModelAnswer(Strict):
    """dx/dt = A x + B u, y = C x + D u: deviations from the operating point, in SI."""

    name: str = Field(description="Name.", examples=["sliding shorter"])
    text: str = Field(description="What it is a model of.")
    primary: bool = Field(description="Whether loop and design use it.")
    pressure: float = si_field("Pa", "Gauge pressure at which it was linearised.")
    dead_time: float = si_field("s", "Dead time of the command; in gain and phase, not in the matrices.")
    states: list[NamedValue] = Field(description="States, in the order of the matrices.")
    inputs: list[NamedValue] = Field(description="Inputs, in the order of the matrices.")
    outputs: list[NamedValue] = Field(description="Outputs, in the order of the matrices.")
    a: Matrix = Field(description="A, one list for each row.")
    b: Matrix = Field(description="B, one list for each row.")
    c: Matrix = Field(description="C, one list for each row.")
    d: Matrix = Field(description="D, one list for each row.")
    poles: list[Pole] = Field(description="Poles, slowest first.")
    zeros: list[Zero] = Field(description="Zeros of the channel that hide no pole.")
    static_gain: float | None = Field(
        description="Gain at 0 Hz in the units of output per input; null where the channel integrates."
    )
    bandwidth: float | None = si_field("Hz", "Frequency at which the gain has fallen by 3 dB.")
    bandwidth_note: str | None = Field(description="Why there is no bandwidth.")
    gain: Series = Field(description="Gain over `frequency`, in the units of output per input.")
    phase: Series = si_field("rad", "Phase over `frequency`, with the dead time.")


class DescribingPointAnswer(Strict):
    """The nonlinear drive under a sine: the fundamental of the output over the sine."""

    frequency: float = si_field("Hz", "Frequency.")
    amplitude: float = Field(description="Amplitude of the input, in its unit.")
    gain: float | None = Field(description="Gain, in the units of output per input; null without a run.")
    phase: float | None = si_field("rad", "Phase; null without a run.")
    distortion: float | None = si_field("1", "Share of everything but the fundamental in the output.")
    remark: str | None = Field(description="What kept it from being a clean oscillation.")


class ControllerAnswer(Strict):
    """A position controller in SI."""

    kp: float = si_field("1/m", "Proportional gain.")
    ki: float = si_field("1/(m*s)", "Integral gain.")
    kd: float = si_field("s/m", "Derivative gain.")
    feed_forward: float = si_field("1/m", "Command per reference.")
    derivative_filter: float = si_field("s", "Filter time of the derivative.")
    sample_time: float = si_field("s", "Sample time.")
    output_min: float = si_field("1", "Lowest command.")
    output_max: float = si_field("1", "Highest command.")
    document: dict[str, str] = Field(
        description="The part `controller` of a drive document, without its reference."
    )


class MarginsAnswer(Strict):
    """Stability of the closed loop of the linear model, and how far it is from its limit."""

    stable: bool = Field(description="Whether the sampled closed loop is stable.")
    gain_margin: float | None = si_field("1", "Factor of the gain up to the limit of stability.")
    gain_margin_at: float | None = si_field("Hz", "Frequency at which the phase is -180 degrees.")
    phase_margin: float | None = si_field("rad", "Phase left where the gain of the loop is 1.")
    crossover: float | None = si_field("Hz", "Frequency at which the gain of the loop is 1.")
    delay_margin: float | None = si_field("s", "Further dead time up to the limit of stability.")
    modulus_margin: float = si_field("1", "Least distance of the open loop from -1.")
    bandwidth: float | None = si_field("Hz", "Frequency at which the closed loop has fallen by 3 dB.")


class LoopAnswer(Strict):
    """The loop of the drive's controller with the primary model."""

    controller: ControllerAnswer = Field(description="The controller of the drive.")
    margins: MarginsAnswer = Field(description="Stability and margins.")
    frequency: list[float] = si_field("Hz", "Frequencies up to half the sampling frequency.")
    gain: Series = si_field("1", "Gain of the open loop.")
    phase: Series = si_field("rad", "Phase of the open loop.")
    closed_gain: Series = si_field("1", "Gain from the reference to the position.")


class StepFiguresAnswer(Strict):
    """Figures of a step and back again on the nonlinear drive: the worse of the two."""

    overshoot: float | None = si_field("1", "Overshoot as a share of the step; null if the run failed.")
    settling: float | None = si_field("s", "Time until within 2 %; null where it does not settle.")
    rise: float | None = si_field("s", "Time from 10 to 90 %.")
    saturated: float = si_field("1", "Share of the time with the command at its limits.")
    error: float | None = si_field("1", "Root mean square of the error as a share of the step.")
    late_error: float | None = si_field("1", "The same over the second half of its time.")
    meets: bool = Field(description="Whether the goals are met.")


class TrialAnswer(Strict):
    """A controller, its steps on the nonlinear drive, and its margins on the primary model."""

    name: Literal["own", "rule", "refined"] = Field(description="Where the controller comes from.")
    controller: ControllerAnswer = Field(description="Its gains.")
    figures: StepFiguresAnswer = Field(description="Figures of its steps.")
    margins: MarginsAnswer = Field(description="Margins of its loop.")
    begins: float = si_field("s", "When the step begins.")
    returns: float = si_field("s", "When the step back begins.")
    time: list[float] = si_field("s", "Instants of the run.")
    reference: Series = si_field("m", "Reference.")
    position: Series = si_field("m", "Position of the load.")
    command: Series = si_field("1", "Command.")


class VariationAnswer(Strict):
    """The refined controller on a drive with another mass and supply."""

    mass: float = si_field("1", "Factor of the mass.")
    supply: float = si_field("1", "Factor of the supply pressure.")
    figures: StepFiguresAnswer = Field(description="Figures of its steps.")


class GoalsAnswer(Strict):
    """The goals of a design."""

    overshoot: float = si_field("1", "Largest overshoot.")
    settling: float = si_field("s", "Latest settling time.")
    step: float = si_field("m", "Height of the step.")
    unsaturated: bool = Field(description="Whether the command must never reach its limits.")


class DesignAnswer(Strict):
    """A position controller by a published rule, then refined on nonlinear runs."""

    goals: GoalsAnswer = Field(description="Goals, with the height of the step.")
    rule: str = Field(description="Name and source of the rule.")
    ultimate_gain: float | None = si_field("1/m", "Gain at which a proportional loop oscillates.")
    ultimate_period: float | None = si_field("s", "Period of that oscillation.")
    trials: list[TrialAnswer] = Field(description="Own controller if there is one, rule, refined.")
    robust: list[VariationAnswer] = Field(description="Mass and supply 20 % lower and higher.")
    evaluations: int = Field(description="Runs of the nonlinear drive.")
    remarks: list[str] = Field(description="What to know about the design.")


class LinearisationAnswer(Strict):
    """The linear view of a drive at an operating point, in SI; angles in rad."""

    point: LinearPointAnswer = Field(description="Where it was linearised.")
    smooth: bool = Field(
        description="Whether nothing sticks or switches there in a way the motion shows: there is one model."
    )
    lost: list[str] = Field(description="What the linear models do not contain.")
    dead_band: list[float] | None = si_field("1", "Commands between which nothing reacts.")
    input: NamedValue = Field(description="Input of the chosen channel.")
    output: NamedValue = Field(description="Output of the chosen channel.")
    frequency: list[float] = si_field("Hz", "Frequencies of the models' gain and phase.")
    models: list[LinearModelAnswer] = Field(
        description="One model, or several where something sticks or switches: each names its case."
    )
    describing: list[DescribingPointAnswer] = Field(description="The nonlinear drive under sines.")
    loop: LoopAnswer | None = Field(description="Loop of the drive's controller; null without one.")
    design: DesignAnswer | None = Field(description="The designed controller; null unless asked for.")
    notes: list[str] = Field(description="Remarks.")
