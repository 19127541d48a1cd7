"""The structure of a drive, and the names of its constants, inputs, states and outputs."""

from __future__ import annotations

from dataclasses import dataclass

from mckibben.physics.effect import Effect

# Constants of a run, SI. Pressures absolute; ratio = critical pressure ratio.
CONSTANTS = (
    "supply_pressure",
    "ambient_pressure",
    "ambient_temperature",
    "fill_conductance",
    "fill_ratio",
    "exhaust_conductance",
    "exhaust_ratio",
    "regulator_range",
    "regulator_time",
    "tube_volume",
    "tube_conductance",
    "tube_ratio",
    "fitting_volume",
    "polytropic_exponent",
    "mass",
    "own_mass",
    "gravity",
    "spring",
    "lever_ratio",
    "precontraction",
    "stop_low",
    "stop_high",
    "stop_stiffness",
    "stop_damping",
)
# Constants of a segment: command and external force change linearly from their values at ``begin``.
INPUTS = (
    "opening",
    "opening_slope",
    "counter_opening",
    "counter_opening_slope",
    "external_force",
    "external_force_slope",
    "begin",
)
# Outputs of a run besides its states.
OUTPUTS = (
    "acceleration",
    "force",
    "mass_flow",
    "supply_flow",
    "exhaust_flow",
    "opening",
    "fill_pressure_ratio",
    "exhaust_pressure_ratio",
    "gas_temperature",
    "volume",
    "diameter",
    "penetration",
    "external_force",
    "pressure_reading",
    "force_reading",
    "stroke_reading",
)
# Additional outputs for the second muscle of a pair; its states have the suffix as well.
COUNTER = "@counter"
COUNTER_OUTPUTS = tuple(
    f"{name}{COUNTER}" for name in ("force", "mass_flow", "supply_flow", "exhaust_flow", "volume", "diameter")
)


@dataclass(frozen=True, slots=True)
class DriveStructure:
    """The features of a drive that determine its equations.

    Attributes:
        effects: effects of muscle and drive; the same for both muscles of a pair.
        tube: whether the pressure in the tube is a state.
        regulator: whether a pressure regulator feeds the muscle instead of a valve.
        pair: whether a second muscle with its own valve pulls against the first (an antagonist pair).
    """

    effects: tuple[Effect, ...]
    tube: bool = False
    regulator: bool = False
    pair: bool = False


@dataclass(frozen=True, slots=True)
class StateInfo:
    """A state of the drive: name ("effect.state" for effects), value at rest, and scale for error control.

    All ``settled`` states start where their rates, linear in them, are zero.
    """

    name: str
    initial: float | None
    scale: float
    settled: bool = False
