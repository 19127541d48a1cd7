"""Requests about drives: simulations, linearisations, sizings and studies."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mckibben.application.linear.linearise import MOST_AMPLITUDES
from mckibben.documents.drive import LONGEST, DriveOrId, Position
from mckibben.documents.quantity import Contraction, Pressure, QuantityField
from mckibben.documents.strict import Strict
from mckibben.documents.study import Subject
from mckibben.documents.task import SizingTask
from mckibben.server.schemas.common import streamed
from mckibben.simulation.linear.bound import FASTEST_SLIDING

Instant = Annotated[float, QuantityField("s", "0.5 s", at_least=0.0, at_most=LONGEST)]

Share = Annotated[float, QuantityField("1", "5 %", at_least=0.0, at_most=1.0)]
Settling = Annotated[float, QuantityField("s", "0.5 s", at_least=0.01, at_most=20.0)]
SlidingSpeed = Annotated[float, QuantityField("m/s", "20 mm/s", above=0.0, at_most=FASTEST_SLIDING)]
Amplitude = Annotated[float, Field(gt=0.0, le=1e6)]


class SimulationRequest(Strict):
    """A drive, and the part of its run to return."""

    drive: DriveOrId = Field(description="A drive document, or the id of a drive preset.")
    points: Annotated[int, Field(ge=2, le=20_001)] = Field(2001, description="Rows of the answer.")
    begin: Instant | None = Field(None, alias="from", description="First row; 0 when left out.")
    end: Instant | None = Field(None, alias="to", description="Last row; the end of the run when left out.")
    static: bool = Field(False, description="Whether the static contractions of each row are asked for.")


SimulationEvents = streamed()


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


class SizingReportRequest(Strict):
    """The search runs again, so that no figure of the report comes from the caller."""

    task: SizingTask = Field(description="As for `/api/sizings`.")
    proposal: Annotated[int, Field(ge=1, le=30)] = Field(
        1, description="Rank of the proposal, 1 the best. A task without proposals also has a report."
    )
    title: str = Field(
        "", max_length=200, description="Name beside the figures of the task. Empty = that of the task."
    )


class StudyOptionsRequest(Strict):
    """Which subject."""

    subject: Subject = Field(description="What is to be studied.")


class StudyKeptAnswer(Strict):
    """What is kept of a study."""

    runs: int = Field(description="Runs that are kept from before.")
    planned: int = Field(description="Runs of the plan; of an optimisation the most.")


StudyEvents = streamed(
    '{"table": columns of new runs, "planned": runs of the plan, "kept": how many so far are from before} or '
    "absent; runs come as they end"
)
