"""The air path of a drive document: supply, valve or regulator, tube, valves on the muscle."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mckibben.documents.quantity import Diameter, Length, PositivePressure, Pressure, QuantityField
from mckibben.documents.strict import Id, Strict

Conductance = Annotated[float, QuantityField("m^3/(s*Pa)", "1.2 l/(s*bar)", at_least=0.0, at_most=1e-5)]
OpenConductance = Annotated[float, QuantityField("m^3/(s*Pa)", "1.2 l/(s*bar)", above=0.0, at_most=1e-5)]
Frequency = Annotated[float, QuantityField("Hz", "50 Hz", at_least=0.1, at_most=1000.0)]
ShortTime = Annotated[float, QuantityField("s", "2 ms", at_least=0.0, at_most=10.0)]
Flow = Annotated[float, QuantityField("m^3/s", "350 l/min", above=0.0, at_most=10.0)]
Ratio = Annotated[float, QuantityField("1", "0.3", at_least=0.0, at_most=0.99)]
LagTime = Annotated[float, QuantityField("s", "50 ms", above=1e-5, at_most=100.0)]
Damping = Annotated[float, QuantityField("1", "0.7", at_least=0.05, at_most=10.0)]


class SupplyInput(Strict):
    """The compressed-air supply."""

    pressure: PositivePressure = Field(600e3, description="Gauge pressure before the valve.")


class ValveInput(Strict):
    """A valve preset, or flow values for filling and venting; values override those of the preset."""

    preset: Id | None = Field(
        None, description="Id of a valve or regulator preset; null: the flow values are stated."
    )
    sonic_conductance: Conductance | None = Field(None, description="Conductance of filling, ISO 6358.")
    exhaust_conductance: Conductance | None = Field(
        None, description="Conductance of venting. Default: that of filling."
    )
    critical_pressure_ratio: Ratio | None = Field(
        None, description="Critical pressure ratio b of filling. Default: that of the preset, else 0.3."
    )
    exhaust_critical_pressure_ratio: Ratio | None = Field(
        None, description="Critical pressure ratio of venting. Default: that of filling."
    )
    nominal_flow: Flow | None = Field(
        None,
        description="Standard nominal flow (6 to 5 bar gauge, normal litres) instead of a conductance.",
    )


class RegulatorInput(Strict):
    """Makes the valve a pressure regulator: two orifices, of filling and venting, that open with the
    difference between its set point and the pressure at its outlet. A regulator preset has its own values.
    """

    range: PositivePressure | None = Field(None, description="Gauge pressure at full command.")
    time: LagTime | None = Field(
        None,
        description="Time constant with which the regulator follows its set point; with a damping, that of a "
        "lag of second order, 1/(2 pi f).",
    )
    damping: Damping | None = Field(
        None,
        description="Damping ratio of a lag of second order. Default: that of the preset, else first order.",
    )
    band: PositivePressure | None = Field(
        None,
        description="Pressure error at which an orifice of the regulator is fully open. Default: that of the "
        "preset, else 5 % of the range, an estimate.",
    )
    dead_band: Pressure | None = Field(
        None,
        description="Width of the pressure error in which both orifices stay closed. Default: that of the "
        "preset, else 0.",
    )


class FlowControlInput(Strict):
    """A one-way flow control valve between tube (or valve) and muscle: it throttles the air in one direction,
    and lets it flow freely in the other.
    """

    meter: Literal["in", "out"] = Field(
        description="in: it throttles the filling of the muscle; out: its venting."
    )
    sonic_conductance: OpenConductance = Field(
        description="Conductance in the throttled direction, ISO 6358, as the screw is set.",
        examples=["0.3 l/(s*bar)"],
    )
    critical_pressure_ratio: Ratio | None = Field(
        None, description="Critical pressure ratio b of both directions. Default: 0.3."
    )
    free_conductance: OpenConductance | None = Field(
        None,
        description="Conductance in the free direction, through the check valve. Default: no resistance.",
        examples=["1.2 l/(s*bar)"],
    )


class QuickExhaustInput(Strict):
    """A quick exhaust valve on the muscle. As soon as the pressure in the tube is below that in the muscle,
    the muscle vents through it to the surroundings, and not back through tube and valve. It needs a tube.
    """

    sonic_conductance: OpenConductance = Field(
        description="Conductance of its exhaust, ISO 6358.", examples=["2 l/(s*bar)"]
    )
    critical_pressure_ratio: Ratio | None = Field(
        None, description="Critical pressure ratio b of its exhaust. Default: 0.3."
    )
    band: PositivePressure | None = Field(
        None,
        description="Pressure difference between muscle and tube at which it is fully open. Default: "
        "0.1 bar, an estimate.",
        examples=["0.1 bar"],
    )


class PwmInput(Strict):
    """Pulse-width modulation of switching valves. The command is read at the start of each period of a
    carrier; each valve is then open for its share of the period.
    """

    frequency: Frequency = Field(description="Frequency of the carrier.", examples=["50 Hz"])
    valves: Literal["two", "one"] = Field(
        "two",
        description="two: a valve fills while the command is positive and another one vents while it is "
        "negative, each for the share |u| of the period; between, both are closed. one: a valve with three "
        "ports fills for the share (1 + u)/2 and vents for the rest.",
    )
    min_on: ShortTime | None = Field(
        None, description="Shortest time a valve is open; shorter pulses are left out. Default: 0.",
        examples=["2 ms"],
    )  # fmt: skip
    min_off: ShortTime | None = Field(
        None, description="Shortest time a valve is closed; shorter pauses are left out. Default: 0.",
        examples=["2 ms"],
    )  # fmt: skip


class TubeInput(Strict):
    """The tube between valve and muscle."""

    preset: Id | None = Field(None, description="Id of a tube preset; null: diameter and length are stated.")
    inside_diameter: Diameter | None = Field(
        default=None, description="Bore of the tube. Default: that of the preset."
    )
    length: Length | None = Field(
        None, description="Length of the tube. Default: that for which the preset is specified."
    )
