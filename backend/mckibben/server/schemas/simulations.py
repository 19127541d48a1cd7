"""Request and answer of ``/api/simulations``: transient simulation of a drive."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mckibben.documents.drive import LONGEST, DriveOrId
from mckibben.documents.quantity import QuantityField
from mckibben.documents.strict import Series, Strict, si_field
from mckibben.server.schemas.common import Flag, MakerLimits, streamed
from mckibben.server.schemas.curves import ModelAnswer, MuscleGeometry
from mckibben.simulation.timing.table import FIGURE_UNITS

Instant = Annotated[float, QuantityField("s", "0.5 s", at_least=0.0, at_most=LONGEST)]


class SimulationRequest(Strict):
    """A drive, and the part of its run to return."""

    drive: DriveOrId = Field(description="A drive document, or the id of a drive preset.")
    points: Annotated[int, Field(ge=2, le=20_001)] = Field(2001, description="Rows of the answer.")
    begin: Instant | None = Field(None, alias="from", description="First row; 0 when left out.")
    end: Instant | None = Field(None, alias="to", description="Last row; the end of the run when left out.")


PhaseFigures = Annotated[
    dict[str, float | None],
    Field(
        description="Figures of one phase in SI: "
        + ", ".join(f"{name} [{unit}]" for name, unit in FIGURE_UNITS.items())
        + ". Speeds are magnitudes along the motion of the phase: shorter in extend, longer in "
        "retract. Accelerations are positive towards shorter in both phases, as in the columns. "
        "Null where it does not exist; see notes for the reason."
    ),
]


class Timing(Strict):
    """The timing table of the first fill and the exhaust after it."""

    extend: PhaseFigures
    retract: PhaseFigures
    notes: dict[str, str] = Field(description='"extend.rise_time" -> why it is null, or a remark on it.')


class Overshoot(Strict):
    """A step of the reference, and its overshoot."""

    time: float = si_field("s", "When.")
    size: float = si_field("m", "Signed height of the step.")
    overshoot: float = si_field("1", "Overshoot as a share of the height.")


class TrackingAnswer(Strict):
    """How well the position follows the reference."""

    rms: float = si_field("m", "Root mean square of the error over time.")
    max: float = si_field("m", "Largest error.")
    lag: float | None = si_field("s", "Delay with the best correlation; null if none fits.")
    overshoot: list[Overshoot] = Field(description="Every step of the reference.")
    notes: dict[str, str] = Field(description="Figure -> why it is null, or a remark on it.")


class Choked(Strict):
    """Interval in which the flow of the valve does not depend on the downstream pressure."""

    begin: float = Field(alias="from", description="Start.", json_schema_extra={"unit": "s"})
    end: float = Field(alias="to", description="End.", json_schema_extra={"unit": "s"})
    side: Literal["fill", "exhaust"] = Field(description="Air flows in (fill) or out (exhaust).")


class StartPosition(Strict):
    """Where the run starts, and why."""

    position: float = si_field("m", "Position of the load at t = 0.")
    contraction: float = si_field("1", "Contraction of the muscle at t = 0.")
    reason: str = Field(description="Why the run starts there, as a sentence.")


class DriveLimits(MakerLimits):
    """Limits stated by the maker (null = not known), and the end stops."""

    position_min: float = si_field("m", "Lower stop as a position of the load.")
    position_max: float = si_field("m", "Upper stop as a position of the load.")


class Readings(Strict):
    """Sensor readings."""

    pressure: Series = si_field("Pa", "Gauge pressure.")
    force: Series = si_field("N", "Force.")
    position: Series = si_field("m", "Position of the load.")


class PositionInterval(Strict):
    """Where new readings of the position are expected, where the model was measured; wider elsewhere."""

    low: Series = si_field("m", "Lower ends.")
    high: Series = si_field("m", "Upper ends.")
    share: float = si_field("1", "Share of the readings between them.")


class Joint(Strict):
    """The pulley of an antagonist pair, and its second muscle."""

    angle: Series = si_field("rad", "Pulley angle from the middle, positive as the first muscle pulls.")
    torque: Series = si_field("N*m", "Torque of both muscles on the pulley.")
    stiffness: Series = si_field("N*m/rad", "Stiffness of the joint at constant pressures.")
    counter_force: Series = si_field("N", "Tension of the second muscle.")
    counter_pressure: Series = si_field("Pa", "Pressure in the second muscle.")
    counter_command: Series = si_field("1", "Command of the second valve or regulator.")
    counter_mass_flow: Series = si_field("kg/s", "Mass flow into the second muscle.")
    counter_supply_flow: Series = si_field("kg/s", "Mass flow from the supply to the second muscle.")
    counter_exhaust_flow: Series = si_field("kg/s", "Mass flow from the second muscle to the atmosphere.")
    counter_diameter: Series = si_field("m", "Braid diameter of the second muscle at mid-span.")
    angle_reference: Series | None = si_field("rad", "Set point of the angle; null without a controller.")
    stiffness_reference: Series | None = si_field(
        "N*m/rad", "Set point of the stiffness; null where the stiffness is not controlled."
    )
    stiffness_error: float | None = si_field(
        "N*m/rad", "Root mean square of stiffness minus set point over the rows; null without one."
    )


class SimulationAnswer(Strict):
    """Columns over time, in SI; pressures gauge; positions, velocities and accelerations positive towards
    shorter.
    """

    time: list[float] = si_field("s", "Instants of the rows; fewer than requested if the run ended early.")
    position: Series = si_field("m", "Stroke of the load.")
    velocity: Series = si_field("m/s", "Velocity of the load, positive towards shorter.")
    acceleration: Series = si_field("m/s^2", "Acceleration of the load, positive towards shorter.")
    pressure: Series = si_field("Pa", "Pressure in the muscle.")
    force: Series = si_field("N", "Tension of the muscle.")
    mass_flow: Series = si_field("kg/s", "Mass flow into the muscle.")
    command: Series = si_field("1", "Command before dead times.")
    opening: Series = si_field("1", "Opening of the valve after all effects.")
    reference: Series | None = si_field("m", "Set point of the controller.")
    supply_flow: Series = si_field("kg/s", "Mass flow from the supply.")
    exhaust_flow: Series = si_field("kg/s", "Mass flow to the atmosphere.")
    tube_pressure: Series | None = si_field("Pa", "Pressure in the tube, if there is one.")
    regulator_pressure: Series | None = si_field(
        "Pa", "Set point of the regulator after its lag, if there is one."
    )
    volume: Series = si_field("m^3", "Gas volume of the muscle with all dead volumes.")
    diameter: Series = si_field("m", "Braid diameter at mid-span.")
    length: Series = si_field("m", "Length of the muscle.")
    contraction: Series = si_field("1", "Contraction ratio of the muscle.")
    load_force: Series = si_field("N", "External force on the load.")
    temperature: Series = si_field("K", "Temperature of the gas in the muscle.")
    contact: list[bool] = Field(description="Whether the load rests on an end stop.")
    slack: list[bool] = Field(
        description="Whether the muscle hangs slack: it is then longer than its fittings are apart."
    )
    start: StartPosition = Field(description="Where the load is at t = 0, and why there.")
    gas: str = Field(description="How the air in the muscle is modelled.")
    readings: Readings | None = Field(description="Null if no effect changes the sensor readings.")
    joint: Joint | None = Field(description="Joint of an antagonist pair.")
    interval: PositionInterval | None = Field(
        description="Where new readings of the position are expected; null where the model was not fitted."
    )
    choked: list[Choked] = Field(
        description="Choked intervals of the whole run, whatever rows are requested."
    )
    timing: Timing = Field(description="Times, speeds and air of the first fill and the exhaust after it.")
    tracking: TrackingAnswer | None = Field(description="Tracking figures of a controlled run.")
    outcome: Literal["completed", "stuck", "diverged", "timed_out", "cancelled"] = Field(
        description="How the run ended; only a completed one has all rows."
    )
    message: str | None = Field(description="Advice if the run did not complete.")
    wall_ms: float = Field(description="Computing time of the integration in ms.")
    engine: Literal["rodas", "lsoda"] = Field(description="The integrator used.")
    steps: int = Field(description="Steps of the integrator.")
    flags: list[Flag] = Field(description="Remarks on the run.")
    notes: dict[str, str] = Field(description="Field -> remark, including those of timing and tracking.")
    limits: DriveLimits = Field(description="Limits stated by the maker, and the end stops.")
    geometry: MuscleGeometry = Field(description="Geometry of the muscle at rest, in all forms.")
    model: ModelAnswer = Field(description="The effects used, with all their values.")
    duration: float = si_field("s", "Duration of the whole run.")


SimulationEvents = streamed()
