"""The structure of a drive, and the names of its constants, inputs, states and outputs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

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
    "regulator_damping",
    "regulator_band",
    "regulator_dead_band",
    "filling_restriction",
    "filling_restriction_ratio",
    "venting_restriction",
    "venting_restriction_ratio",
    "quick_exhaust_conductance",
    "quick_exhaust_ratio",
    "quick_exhaust_band",
    "tube_volume",
    "tube_conductance",
    "tube_ratio",
    "fitting_volume",
    "polytropic_exponent",
    "wall_heat_transfer",
    "mass",
    "own_mass",
    "gravity",
    "spring",
    "lever_ratio",
    "precontraction",
    "stop_low",
    "stop_high",
    "slack_damping",
)
#: Degree of the polynomials that are the lengths of muscles over the angle of a joint in a run.
PATH_DEGREE = 16
# Further constants of a joint whose levers change with the angle: the radius at which its coordinate counts,
# the stroke at which its spring is relaxed, the middle and the half of its range of angles, and of each
# muscle the coefficients of length [m] and lever [m] by powers of (angle - middle) / half.
PATH_CONSTANTS = (
    "rim",
    "spring_rest",
    "path_middle",
    "path_half",
    *(f"path_length_{power}" for power in range(PATH_DEGREE + 1)),
    *(f"path_lever_{power}" for power in range(PATH_DEGREE)),
)
COUNTER_PATH_CONSTANTS = tuple(
    f"counter_{name}" for name in PATH_CONSTANTS if name.startswith(("path_length", "path_lever"))
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
    "contact",
    "net_force",
    "friction",
    "friction_share",
    "friction_left_up",
    "friction_left_down",
    "external_force",
    "pressure_reading",
    "force_reading",
    "stroke_reading",
)
# Switches: 0 or 1 during a step. A stop that holds the load, a muscle that hangs slack, and the two
# directions in which a load with dry friction slides; in neither of them it sticks.
LOW_STOP, HIGH_STOP, SLACK = "low_stop", "high_stop", "slack"
SLIDES_UP, SLIDES_DOWN = "slides_up", "slides_down"
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
        second_order: whether the regulator follows its set point by a lag of second order.
        pair: whether a second muscle with its own valve pulls against the first (an antagonist pair).
        flow_control: whether a flow control valve is between valve or tube and muscle.
        quick_exhaust: whether a quick exhaust valve is on the muscle; needs a tube.
        polytropic: whether the gas follows a stated polytropic exponent instead of the energy balance.
        path: whether the muscles turn a joint at levers that change with its angle.
    """

    effects: tuple[Effect, ...]
    tube: bool = False
    regulator: bool = False
    second_order: bool = False
    pair: bool = False
    flow_control: bool = False
    quick_exhaust: bool = False
    polytropic: bool = False
    path: bool = False

    @property
    def constants(self) -> tuple[str, ...]:
        """Names of the constants of a run."""
        if not self.path:
            return CONSTANTS
        return (*CONSTANTS, *PATH_CONSTANTS, *(COUNTER_PATH_CONSTANTS if self.pair else ()))


@dataclass(frozen=True, slots=True)
class StateInfo:
    """A state of the drive: name ("effect.state" for effects), value at rest, and scale for error control.

    All ``settled`` states start where their rates, linear in them, are zero.
    """

    name: str
    initial: float | None
    scale: float
    settled: bool = False


# Guards of lengths are multiplied by this stiffness, so that all guards are forces [N/m].
GUARD_STIFFNESS = 1e4
# Guards of speeds are multiplied by this damping [N s/m].
GUARD_DAMPING = 1e4
# Guards above minus this are rounding errors [N]; of a length 1 nm, of a speed 1 nm/s.
LEAST_GUARD = 1e-5


@dataclass(frozen=True, slots=True)
class Switch:
    """A condition that is 0 or 1 during a step, and the guard that ends it.

    While the guard is not negative the switch keeps its value. Where the guard falls below zero the switch
    changes to the other value.

    Attributes:
        name: `LOW_STOP`, `HIGH_STOP`, `SLIDES_UP`, `SLIDES_DOWN` or `SLACK`; of the second muscle of a pair
            with `COUNTER`.
        symbol: its symbol in the equations.
        guard: expression of states, constants, inputs and switches.
        least: guard values above minus this are rounding errors.
        stop: for an end stop the name of its constant: where the load lands when the switch becomes 1.
        follows: for a slack muscle the name of its length: set to the distance of the fittings at a change.
        slides: for a direction of sliding its sign, 1 up or -1 down: where it becomes 0 the speed is 0.
    """

    name: str
    symbol: Any
    guard: Any
    least: float
    stop: str | None = None
    follows: str | None = None
    slides: float = 0.0
