"""Answer of ``/api/sizings``: proposals, rejected candidates, Pareto front."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from mckibben.documents.strict import Strict, si_field
from mckibben.server.schemas.common import Flag

Binding = Literal[
    "length", "pressure", "contraction", "force", "force_limit", "diameter", "stiffness", "life",
    "temperature", "time", "time_down", "cycle_time", "suspended_mass", "valve_pressure",
]  # fmt: skip
_MARGINS = "Limit -> margin as a share of the limit; limits that are not set are left out."


class ExploredDesign(Strict):
    """A simulated design that fulfils the task; coarse figures, for a plot of the alternatives."""

    muscle: str = Field(description="Id of the preset.")
    nominal_length: float = si_field("m", "Nominal length of each muscle.")
    parallel: int = Field(description="Number of parallel muscles.")
    valve: str = Field(description="Id of the preset.")
    tube: str | None = Field(description="Id of the preset; null without a tube.")
    pressure: float = si_field("Pa", "Gauge pressure of the supply.")
    time: float = si_field("s", "Time for the stroke.")
    air_volume_anr: float = si_field("m^3", "Air per cycle at ANR.")
    force_reserve: float = si_field("1", "Share by which the static force exceeds the load.")
    stiffness: float = si_field("N/m", "Stiffness at the load, valve open.")
    front: bool = Field(description="On the Pareto front of the explored designs.")


class ProposalAnswer(Strict):
    """A drive that fulfils the task. Figures are per muscle unless stated otherwise."""

    muscle: str = Field(description="Id of the preset.")
    nominal_length: float = si_field("m", "Nominal length of each muscle.")
    parallel: int = Field(description="Number of parallel muscles (on each side of a pair).")
    muscles: int = Field(description="Number of all muscles of the drive.")
    valve: str = Field(
        description="Id of the preset; one for all parallel muscles, one on each side of a pair."
    )
    tube: str | None = Field(description="Id of the preset; one tube from the valve to each muscle.")
    tube_length: float = si_field("m", "Length of the tube; 0 without one.")
    pulley_radius: float | None = si_field("m", "Pulley radius of a pair.")
    pressure: float = si_field("Pa", "Gauge pressure of the supply at the valve, set by a regulator.")
    time: float = si_field("s", "Time for the stroke to the end stop.")
    time_down: float | None = si_field("s", "Time for the return; null if not reached in the simulated time.")
    contraction: float = si_field("1", "Contraction ratio at the end of the stroke.")
    force_reserve: float = si_field("1", "Least share by which the static force exceeds the load.")
    needed_pressure: float | None = si_field(
        "Pa", "Pressure that just carries the load at the end of the stroke."
    )
    pressure_start: float = si_field("Pa", "Pressure in the muscle when the load leaves its stop.")
    pressure_end: float = si_field("Pa", "Pressure in the muscle on arrival.")
    air_volume_anr: float = si_field("m^3", "Air of all muscles per cycle at ANR.")
    air_cost: float = Field(description="Cost of the air of a cycle, in the currency of the task.")
    air_cost_year: float = Field(description="Cost of the air of a year, in the currency of the task.")
    impact_energy: float = si_field("J", "Kinetic energy of the whole load at the end stop.")
    end_speed: float = si_field("m/s", "Speed of the load there.")
    max_speed: float = si_field("m/s", "Largest speed of the load.")
    peak_force: float = si_field("N", "Largest tension of a muscle.")
    stiffness: float = si_field("N/m", "Stiffness at the load at the end of the stroke, valve open.")
    stiffness_closed: float = si_field("N/m", "The same with the valve closed.")
    installed_length: float = si_field("m", "Nominal length and end fittings.")
    diameter: float = si_field("m", "Outside diameter at the end of the stroke.")
    life: float = si_field("1", "Load cycles; an estimate, not verified.")
    probability: float | None = si_field(
        "1", "Probability that a built drive fulfils the task; null without specimens."
    )
    probability_error: float | None = si_field("1", "Its standard error.")
    specimens: int = Field(description="Number of specimens simulated for it.")
    margins: dict[str, float] = Field(description=_MARGINS)
    binding: Binding = Field(description="The limit with the least margin.")
    reservations: list[str] = Field(
        description="What costs it rank: margins below 5 %, an impact above limits.max_impact_energy."
    )
    reason: str = Field(description="Explanation of its rank.")
    front: bool = Field(description="On the Pareto front of the proposals.")
    notes: list[str] = Field(description="Remarks for building it.")
    unverified: list[str] = Field(description="Unverified figures it depends on, by preset.")
    drive: dict[str, Any] = Field(description="Drive document for /api/simulations, of one of the muscles.")


class RejectedAnswer(Strict):
    """A rejected candidate."""

    muscle: str = Field(description="Id of the preset.")
    parallel: int = Field(description="Number of parallel muscles.")
    valve: str | None = Field(description="Null = with any valve.")
    tube: str | None = Field(description="Null = with any tube.")
    why: str = Field(description="The reason, with figures.")
    binding: Binding = Field(description="The limit that must move by the least share when no other moves.")
    would_work_if: str = Field(description="What would help, least change first.")
    combinations: int = Field(description="Number of combinations this entry covers.")


class SizingAnswer(Strict):
    """Proposals, best first, and rejected candidates with reasons; SI, pressures gauge."""

    about: str = Field(description="The task in one sentence, from its figures.")
    proposals: list[ProposalAnswer] = Field(description="Best first; empty if no candidate fulfils the task.")
    ranking: str | None = Field(description="Why the first comes before the second, in one sentence.")
    rejected: list[RejectedAnswer] = Field(description="Nearest first.")
    explored: list[ExploredDesign] = Field(
        description="The best design of each choice of parts that fulfils the task."
    )
    combinations: int = Field(
        description="Combinations of muscle, length, number, pressure, valve and tube within the limits."
    )
    pruned: int = Field(description="Number of them ruled out in closed form.")
    simulated: int = Field(description="Number of transient runs, without those of specimens.")
    specimens: int = Field(description="Number of transient runs for probabilities.")
    outcome: Literal["completed", "timed_out", "cancelled"] = Field(
        description="How the search ended; unless completed, the answer is what was found until then."
    )
    message: str | None = Field(
        description="How far a search came that did not complete, or what a completed one left out."
    )
    flags: list[Flag] = Field(description="Remarks on the task.")
    wall_ms: float = Field(description="Computing time of the search in ms.")
