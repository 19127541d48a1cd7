"""Schemas of the linear view."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mckibben.application.linear.linearise import MOST_AMPLITUDES
from mckibben.documents.drive import DriveOrId, Position
from mckibben.documents.quantity import Contraction, Pressure, QuantityField
from mckibben.documents.strict import Strict
from mckibben.simulation.linear.bound import FASTEST_SLIDING

Share = Annotated[float, QuantityField("1", "5 %", at_least=0.0, at_most=1.0)]
Settling = Annotated[float, QuantityField("s", "0.5 s", at_least=0.01, at_most=20.0)]
SlidingSpeed = Annotated[float, QuantityField("m/s", "20 mm/s", above=0.0, at_most=FASTEST_SLIDING)]
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
    sliding_speed: SlidingSpeed | None = Field(
        None,
        description="Speed of the load at which models that slide against dry friction have the slopes of "
        "friction and damping. Default: they just slide.",
    )
    design: DesignInput | None = Field(None, description="Goals of a controller design; null: no design.")
