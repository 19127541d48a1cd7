"""Answer of ``/api/sizings``: proposals, rejected candidates, the front."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from mckibben.documents.strict import Strict, si_field
from mckibben.server.schemas.common import Flag

Binding = Literal[
    "length", "pressure", "contraction", "force", "force_limit", "diameter", "stiffness", "life",
    "temperature", "time", "time_down", "cycle_time",
]  # fmt: skip
_MARGINS = "Limit -> share of it that is left; limits that are not set are left out."


class ExploredDesign(Strict):
    """A simulated design that does the task; coarse figures, for a picture of the choices."""

    muscle: str
    nominal_length: float = si_field("m", "Of each muscle.")
    parallel: int = Field(description="Muscles side by side.")
    valve: str
    tube: str | None
    pressure: float = si_field("Pa", "Of the supply, gauge.")
    time: float = si_field("s", "For the stroke.")
    air_volume_anr: float = si_field("m^3", "In a cycle.")
    force_reserve: float = si_field("1", "Share by which the static force exceeds the load.")
    stiffness: float = si_field("N/m", "At the load, valve open.")
    front: bool = Field(description="No other explored design is better in everything.")


class ProposalAnswer(Strict):
    """A drive that does the task. Figures of all muscles together where it says so, else of each."""

    muscle: str = Field(description="Id of the preset.")
    nominal_length: float = si_field("m", "Of each muscle.")
    parallel: int = Field(description="Muscles side by side (on each side of a pair).")
    muscles: int = Field(description="All muscles of the drive.")
    valve: str = Field(description="One for all parallel muscles; a pair has one on each side.")
    tube: str | None = Field(description="One from the valve to each muscle.")
    tube_length: float = si_field("m", "0 without a tube.")
    pulley_radius: float | None = si_field("m", "Of a pair.")
    pressure: float = si_field("Pa", "Of the supply at the valve, gauge; a regulator sets it.")
    time: float = si_field("s", "For the stroke, to the end stop.")
    time_down: float | None = si_field(
        "s", "For the way back; null when it does not end in the time watched."
    )
    contraction: float = si_field("1", "At the end of the stroke.")
    force_reserve: float = si_field("1", "Share by which the static force exceeds the load at least.")
    needed_pressure: float | None = si_field("Pa", "That just carries the load at the end of the stroke.")
    pressure_start: float = si_field("Pa", "In the muscle when the load leaves its stop.")
    pressure_end: float = si_field("Pa", "In the muscle on arrival.")
    air_volume_anr: float = si_field("m^3", "Of all muscles in a cycle.")
    impact_energy: float = si_field("J", "Of the whole load on the end stop.")
    end_speed: float = si_field("m/s", "Of the load there.")
    max_speed: float = si_field("m/s", "Of the load.")
    peak_force: float = si_field("N", "Largest tension of a muscle.")
    stiffness: float = si_field("N/m", "Of the load at the end of the stroke, valve open.")
    stiffness_closed: float = si_field("N/m", "The same with the valve closed.")
    installed_length: float = si_field("m", "Nominal length and end fittings.")
    diameter: float = si_field("m", "Outside, bulged at the end of the stroke.")
    life: float = si_field("1", "Load cycles; an estimate, not verified.")
    probability: float | None = si_field("1", "That what is built does the task; null without specimens.")
    probability_error: float | None = si_field("1", "Its standard error.")
    specimens: int = Field(description="Simulated for it.")
    margins: dict[str, float] = Field(description=_MARGINS)
    binding: Binding = Field(description="The limit with the least margin.")
    reason: str = Field(description="Why it stands where it stands.")
    front: bool = Field(description="No other proposal is better in everything.")
    notes: list[str] = Field(description="What to know when it is built.")
    unverified: list[str] = Field(description="Figures that enter and nobody verified, by preset.")
    drive: dict[str, Any] = Field(description="A drive document for /api/simulations; of one of the muscles.")


class RejectedAnswer(Strict):
    """A candidate that does not do."""

    muscle: str
    parallel: int
    valve: str | None = Field(description="Null: whatever the valve.")
    tube: str | None = Field(description="Null: whatever the tube.")
    why: str = Field(description="In figures.")
    binding: Binding = Field(description="The limit that must move by the least share when no other moves.")
    would_work_if: str = Field(description="What would help, least change first.")
    combinations: int = Field(description="How many combinations it stands for.")


class SizingAnswer(Strict):
    """Proposals best first, and everything else with its reason; SI, pressures gauge."""

    proposals: list[ProposalAnswer] = Field(description="Empty when nothing does; that is an answer too.")
    rejected: list[RejectedAnswer] = Field(description="Nearest first.")
    explored: list[ExploredDesign] = Field(description="One for each choice of parts that does the task.")
    combinations: int = Field(
        description="Muscle, length, number, pressure, valve and tube within the limits."
    )
    pruned: int = Field(description="Of these sorted out in closed form.")
    simulated: int = Field(description="Transients run, specimens left out.")
    specimens: int = Field(description="Transients run for probabilities.")
    outcome: Literal["completed", "timed_out", "cancelled"]
    message: str | None = Field(description="What to do when the search did not complete.")
    flags: list[Flag]
    wall_ms: float = Field(description="Time of the whole search in ms.")
