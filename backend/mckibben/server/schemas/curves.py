"""Request and answer of ``/api/curves``: the static characteristics of one muscle."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.quantity import Contraction, Length, Load, Pressure, Temperature, Volume
from mckibben.documents.strict import Series, Strict, si_field
from mckibben.server.schemas.common import Flag, MakerLimits

Direction = Annotated[
    Literal[-1, 0, 1],
    Field(description="Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none."),
]
Rows = Annotated[list[Series], Field(description="One row per pressure, one number per length.")]
_DEFAULT_PRESSURES = [1e5, 2e5, 3e5, 4e5, 5e5, 6e5]


class CurvesOptions(Strict):
    """Pressures, range and conditions of the curves."""

    pressures: list[Pressure] = Field(
        default=_DEFAULT_PRESSURES, min_length=1, max_length=12, description="Gauge pressures of the curves."
    )
    points: int = Field(200, ge=2, le=400, description="Points along the length.")
    direction: Direction = 0
    temperature: Temperature = Field(293.15, description="Temperature of the muscle.")
    unclipped: bool = Field(False, description="Also negative forces, which a muscle cannot exert.")
    dead_volume: Volume = Field(0.0, description="Gas volume outside the muscle, for the closed valve.")
    polytropic_exponent: float = Field(1.4, ge=1.0, le=1.7, description="1 isothermal, 1.4 adiabatic (air).")
    contraction_from: Contraction | None = Field(
        None, description="Start of the range; null: the pretension limit."
    )
    contraction_to: Contraction | None = Field(
        None, description="End of the range; null: the largest free contraction."
    )
    load: Load | None = Field(None, description="Constant load, for the operating points.")
    fixed_length: Length | None = Field(None, description="Fixed length, for force over pressure.")
    further_stiffness: bool = Field(
        False, description="Also the stiffness that the force implies, and the secant stiffness."
    )


class CurvesRequest(CurvesOptions):
    """A muscle, and the pressures and range of its curves."""

    muscle: MuscleInput = Field(description="The muscle.")
    effects: EffectsInput | None = Field(
        None, description="The effects of its model; null: those of the preset."
    )


class CurveLimits(MakerLimits):
    """Limits of the muscle; null where the preset does not state one."""

    ideal_max_contraction: float = si_field("1", "Contraction at which the ideal force is zero.")
    braid_lock_force: Series = si_field("N", "Ideal force of the fully stretched braid, per pressure.")


class Characteristics(Strict):
    """Figures of the muscle at one pressure."""

    pressure: float = si_field("Pa", "Gauge pressure.")
    blocked_force: float | None = si_field("N", "Force at the nominal length.")
    free_contraction: float | None = si_field("1", "Contraction without load.")
    free_contraction_flag: str | None = Field(
        description="Code of the limit that the free contraction crosses."
    )
    max_work: float | None = si_field("J", "Work of one stroke from nominal length to free contraction.")
    thread_tension_total: float | None = si_field("N", "Ideal tension of all threads at nominal length.")


class RhombusAnswer(Strict):
    """The lattice of the braid."""

    side: float = si_field("m", "Side of one rhombus.")
    along: float = si_field("1", "Rhombi along the muscle.")
    around: float = si_field("1", "Rhombi around the muscle.")


class MuscleGeometry(Strict):
    """The geometry of the muscle at rest in all forms."""

    braid_diameter: float = si_field("m", "Diameter of the braid at the braid angle.")
    braid_angle: float = si_field("rad", "Angle between thread and axis.")
    nominal_length: float = si_field("m", "Length at rest.")
    inside_diameter: float = si_field("m", "Bore.")
    wall_thickness: float = si_field("m", "Wall of the bladder; 0 when not stated.")
    thread_length: float = si_field("m", "Length of one thread.")
    turns: float = si_field("1", "Turns of one thread.")
    rhombus: RhombusAnswer | None = Field(description="The lattice, when the muscle was stated in this form.")


class ModelAnswer(Strict):
    """The effects used, with all their values in SI."""

    effects: dict[str, dict[str, float]] = Field(description="Effect id -> parameter -> value in SI.")


class OverPressureBranch(Strict):
    """Position over pressure in one direction of motion; null where the muscle cannot carry the load."""

    contraction: Series = si_field("1", "Contraction at the load.")
    length: Series = si_field("m", "Length at the load.")
    diameter: Series = si_field("m", "Braid diameter at the load.")
    outer_diameter: Series = si_field("m", "Outer diameter of the wall at the load.")


class ForceInterval(Strict):
    """Where new readings of the force are expected, where the model was measured; wider elsewhere."""

    low: Rows = si_field("N", "Lower ends.")
    high: Rows = si_field("N", "Upper ends.")
    share: float = si_field("1", "Share of the readings between them.")


class ForceAtLength(Strict):
    """Force over pressure at the fixed length, in both directions of motion."""

    filling: Series = si_field("N", "While shortening.")
    venting: Series = si_field("N", "While lengthening.")


class HysteresisLoop(Strict):
    """Width of the loop of filling and venting at the load, far from its ends; null where it is not held."""

    pressure: list[float] = si_field("Pa", "Gauge pressures of the curves.")
    stroke: Series = si_field("m", "Distance of the branches in length, at equal pressure.")
    share: Series = si_field("1", "The same as a share of the nominal length.")
    pressure_width: Series = si_field("Pa", "Distance of the branches in pressure, at equal length.")


class OverPressure(Strict):
    """Characteristics over pressure: position at the load, force and diameters at the fixed length."""

    pressure: list[float] = si_field("Pa", "Gauge pressure.")
    load: float | None = si_field("N", "The load.")
    filling: OverPressureBranch | None = Field(description="While shortening; null without a load.")
    venting: OverPressureBranch | None = Field(description="While lengthening; null without a load.")
    fixed_length: float | None = si_field("m", "The fixed length.")
    force_at_fixed_length: ForceAtLength | None = Field(
        description="Force over pressure; null without a fixed length."
    )
    diameter_at_fixed_length: Series | None = si_field("m", "Braid diameter; null without a fixed length.")
    outer_diameter_at_fixed_length: Series | None = si_field(
        "m", "Outer diameter of the wall; null without a fixed length."
    )
    loop: HysteresisLoop | None = Field(None, description="Width of the loop; null without a load.")


class OperatingPoint(Strict):
    """The state in which the muscle holds the load at one pressure."""

    pressure: float = si_field("Pa", "Gauge pressure.")
    contraction: float | None = si_field("1", "Contraction; null when out of reach.")
    length: float | None = si_field("m", "Length; null when out of reach.")
    force: float | None = si_field("N", "The load.")
    stiffness: float | None = si_field("N/m", "Stiffness at constant pressure.")
    stiffness_closed: float | None = si_field("N/m", "Stiffness with the valve closed.")
    diameter: float | None = si_field("m", "Braid diameter.")
    flags: list[str] = Field(description="Codes of the flags of this point.")


class CurvesAnswer(Strict):
    """Force, stiffness, volume and diameter over the length, per pressure."""

    pressure: list[float] = si_field("Pa", "Gauge pressures of the rows.")
    length: list[float] = si_field("m", "Lengths of the columns.")
    contraction: list[float] = si_field("1", "Contractions of the columns.")
    braid_angle: Series = si_field("rad", "Braid angle.")
    force: Rows = si_field("N", "Tension; 0 where the muscle would have to push, unless unclipped.")
    stiffness: Rows = si_field("N/m", "dF/dL at constant pressure.")
    stiffness_closed: Rows = si_field("N/m", "dF/dL at constant gas mass.")
    stiffness_from_force: Rows | None = si_field(
        "N/m",
        "Stiffness of the ideal muscle with this force at this length, 6 L F/(3 L² - b²); null unless asked "
        "for, and where it has no value.",
    )
    stiffness_secant: Rows | None = si_field(
        "N/m",
        "Stiffness of the straight line from the length without force, F/(L - L_min); null unless asked for.",
    )
    volume: Series = si_field("m3", "Enclosed volume at the highest pressure.")
    diameter: Series = si_field("m", "Braid diameter at the highest pressure.")
    outer_diameter: Series = si_field("m", "Outer diameter of the wall, at constant wall volume.")
    interval: ForceInterval | None = Field(
        description="Where new readings of the force are expected; null where the model was not fitted."
    )
    limits: CurveLimits = Field(description="Limits of the muscle.")
    characteristics: list[Characteristics] = Field(description="Figures of the muscle at each pressure.")
    geometry: MuscleGeometry = Field(description="Geometry of the muscle at rest, in all forms.")
    model: ModelAnswer = Field(description="The effects used, with all their values.")
    over_pressure: OverPressure | None = Field(description="Null without load and fixed length.")
    operating_points: list[OperatingPoint] = Field(
        description="The state at each pressure; empty without a load."
    )
    flags: list[Flag] = Field(description="Remarks on the answer.")
