"""The parts of a drive, in SI: valve, regulator, tube and load; and the complete drive with a muscle."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians

import numpy as np
from numpy.typing import NDArray

from mckibben.physics import gas, ideal, joint
from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.command.pwm import PulseWidth
from mckibben.simulation.command.signals import Signal
from mckibben.simulation.drive.joint_path import JointPath
from mckibben.simulation.statics.model import StaticModel

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Valve:
    """Sonic conductances [m^3/(s Pa)] and critical pressure ratios for fill and exhaust."""

    fill_conductance: float
    exhaust_conductance: float
    fill_ratio: float = 0.3
    exhaust_ratio: float = 0.3


@dataclass(frozen=True, slots=True)
class Regulator:
    """A pressure regulator: two orifices that a lagging set point controls.

    Attributes:
        range: gauge pressure at full command [Pa].
        time: time constant of the lag of the set point [s]; with ``damping`` 1 / natural angular frequency.
        damping: damping ratio of a lag of second order; None = first order.
        band: pressure error at which an orifice is fully open [Pa].
        dead_band: width of the error in which both orifices are closed [Pa].
    """

    range: float
    time: float
    damping: float | None = None
    band: float = 0.3e5
    dead_band: float = 0.0


@dataclass(frozen=True, slots=True)
class FlowControl:
    """A flow control valve on the muscle: its restriction while filling and while venting.

    A conductance of infinity is free flow.
    """

    fill_conductance: float
    exhaust_conductance: float
    fill_ratio: float = 0.3
    exhaust_ratio: float = 0.3


@dataclass(frozen=True, slots=True)
class QuickExhaust:
    """A quick exhaust valve on the muscle, behind the tube.

    Once the pressure in the tube is below that in the muscle, no air flows back but all of it to the
    surroundings.

    Attributes:
        conductance: of its exhaust [m^3/(s Pa)].
        critical_ratio: critical pressure ratio.
        band: pressure difference at which it is fully open [Pa].
    """

    conductance: float
    critical_ratio: float = 0.3
    band: float = 0.1e5


@dataclass(frozen=True, slots=True)
class Tube:
    """Inside diameter and length [m]."""

    inside_diameter: float
    length: float

    @property
    def volume(self) -> float:
        """Volume of the air in it [m^3]."""
        return pi / 4.0 * self.inside_diameter**2 * self.length


@dataclass(frozen=True, slots=True)
class Load:
    """What the muscle pulls.

    Attributes:
        mass: moved mass [kg].
        inclination: angle of the direction of pull to the horizontal [rad]; 90 degrees = vertical lift.
        force: external force against the pull [N], a number or a signal of time.
        spring: stiffness against the contraction [N/m].
        lever_ratio: stroke of the muscle per stroke of the load [-].
    """

    mass: float = 0.0
    inclination: float = radians(90.0)
    force: float | Signal = 0.0
    spring: float = 0.0
    lever_ratio: float = 1.0


@dataclass(frozen=True, slots=True)
class StiffnessControl:
    """Second set point of an antagonist joint: its stiffness, by what both muscles are given in common.

    Attributes:
        reference: stiffness of the joint [N m/rad].
        kp, ki: gains [-], [1/s] of the missing mean pressure as a share of the full one.
    """

    reference: Signal
    kp: float
    ki: float


@dataclass(frozen=True)
class Drive:
    """A complete drive, SI; pressures gauge.

    Attributes:
        model: the muscle with its effects.
        valve, regulator, tube: the air path; a regulator's orifices have the valve's conductances.
        flow_control, quick_exhaust: valves on the muscle; a quick exhaust needs a tube.
        pwm: pulse-width modulation of switching valves; None = the valve opens as far as commanded.
        assumed_tube: used if no tube is stated and an effect of the model acts on one; None if the drive
            states that there is none.
        load: what the muscle pulls.
        command: opening of the valve, 1 fill, 0 closed, -1 exhaust; of a regulator the share of its range.
        supply_pressure: gauge pressure of the supply [Pa].
        min_contraction, max_contraction: end stops as contraction ratios of the (first) muscle.
        start_pressure: pressure in the muscle at t = 0 [Pa].
        start_position: of the load at t = 0 [m]; None = where it rests.
        start_reached: how the load has come to rest against its dry friction: 1 from below, -1 from above, 0
            as without that friction.
        restitution: share of the speed that an impact on an end stop leaves, in the opposite direction.
        own_mass: moving mass of muscle and fittings [kg].
        fitting_volume: dead volume of fittings [m^3].
        polytropic_exponent: of the gas, if stated; None = energy balance with heat exchange.
        wall_heat_transfer: heat transfer coefficient between gas and wall [W/(m^2 K)].
        pair: whether a second muscle pulls against the first; its command mirrors the first's (`counter`).
        precontraction: contraction ratio of both muscles of a pair in the middle position, where stroke = 0.
        pulley_radius: pulley radius of a pair [m].
        controller, reference: a position controller that replaces the command, and its set point [m].
        stiffness: second set point of a controlled pair; its controller then gives half the difference of
            both commands.
        common: command that both muscles of a pair have in common; None = 0.5 of a regulator, 0 of a valve.
        path: of the muscles of a joint whose levers change with its angle; None = pulley or straight line.
        curve_fit: what it was fitted to, with parts that do not exist; "" of a drive.
    """

    model: StaticModel
    valve: Valve
    load: Load
    command: Signal
    duration: float
    supply_pressure: float
    regulator: Regulator | None = None
    tube: Tube | None = None
    flow_control: FlowControl | None = None
    quick_exhaust: QuickExhaust | None = None
    pwm: PulseWidth | None = None
    assumed_tube: Tube | None = None
    min_contraction: float = 0.0
    max_contraction: float = 0.25
    start_pressure: float = 0.0
    start_position: float | None = None
    start_reached: int = 0
    restitution: float = 0.0
    own_mass: float = 0.0
    fitting_volume: float = 0.0
    polytropic_exponent: float | None = None
    wall_heat_transfer: float = gas.WALL_HEAT_TRANSFER
    pair: bool = False
    precontraction: float = 0.0
    pulley_radius: float | None = None
    controller: PidController | None = None
    reference: Signal | None = None
    stiffness: StiffnessControl | None = None
    common: float | None = None
    ambient_pressure: float = ideal.ATMOSPHERE
    temperature: float = 293.15
    path: JointPath | None = None
    curve_fit: str = ""

    @property
    def muscle(self) -> Muscle:
        """Geometry of the muscle."""
        return self.model.muscle

    @property
    def tube_in_use(self) -> Tube | None:
        """The stated tube, or the assumed one if an effect acts on it.

        None: the valve is mounted on the muscle.
        """
        if self.tube is None and any("tube_conductance" in effect.slots for effect in self.model.effects):
            return self.assumed_tube
        return self.tube

    @property
    def tube_assumption(self) -> str | None:
        """A note for the user if the assumed tube is in use."""
        tube = self.assumed_tube
        if tube is None or self.tube is not None or not any(e.of_tube for e in self.model.effects):
            return None
        return (
            f"the tube is not stated: {tube.inside_diameter * 1e3:.3g} mm bore and {tube.length:.3g} m "
            "length are assumed, because an effect acts on it; state the tube, or null if there is none"
        )

    @property
    def gas_closure(self) -> str:
        """How the air in the muscle is modelled, in words."""
        if any("heat" in effect.slots for effect in self.model.effects):
            return "energy balance with the heat exchange of the effect"
        if self.polytropic_exponent is not None:
            return f"polytropic exponent {self.polytropic_exponent:.3g} (1 isothermal, 1.4 adiabatic)"
        return f"energy balance, heat exchange with the wall {self.wall_heat_transfer:.3g} W/(m²·K)"

    @property
    def structure(self) -> DriveStructure:
        """The features of the drive that determine its equations."""
        return DriveStructure(
            self.model.effects,
            tube=self.tube_in_use is not None,
            regulator=self.regulator is not None,
            second_order=self.regulator is not None and self.regulator.damping is not None,
            pair=self.pair,
            flow_control=self.flow_control is not None,
            quick_exhaust=self.quick_exhaust is not None,
            polytropic=self.polytropic_exponent is not None,
            path=self.path is not None,
        )

    @property
    def stops(self) -> tuple[float, float]:
        """End stops as strokes of the muscle [m]; of a pair measured from the middle position.

        Of a joint with a path they are ways of its rim.
        """
        if self.path is not None:
            return self.path.low * self.path.rim, self.path.high * self.path.rim
        rest = self.muscle.nominal_length
        low, high = (c - self.precontraction for c in (self.min_contraction, self.max_contraction))
        return low * rest, high * rest

    def lengths(self, stroke: Array | float) -> tuple[Array, ...]:
        """Distance of the fittings of each muscle at strokes [m]; of a joint with what its effects change."""
        along = np.asarray(stroke, float)
        if self.path is not None:
            return tuple(self.held(along, number).length for number in range(1 + self.pair))
        rest = self.muscle.nominal_length
        middle = rest - self.precontraction * rest
        return (middle - along, middle + along)[: 1 + self.pair]

    def held(self, stroke: Array, number: int) -> joint.Held:
        """Length and lever of a muscle of a joint at ways of its rim [m], with what effects change."""
        if self.path is None:
            raise ValueError("only the muscles of a joint with a path have levers over its angle")
        effects = [effect for effect in self.model.effects if set(effect.slots) <= joint.JOINT_SLOTS]
        angle = stroke / self.path.rim
        path = self.path.path(number)
        return joint.held(model=Model(effects), values=self.model.values, angle=angle, path=path)

    def contraction(self, stroke: Array | float) -> Array:
        """Contraction ratio of the (first) muscle, by the distance of its fittings, at strokes [m]."""
        return 1.0 - self.lengths(stroke)[0] / self.muscle.nominal_length

    def counter(self, command: float) -> float:
        """Command of the second muscle of a pair: -u for a valve, 1 - u for a regulator, or 2 c - u."""
        return 2.0 * self.common_command - command

    @property
    def common_command(self) -> float:
        """Mean c of both commands of a pair."""
        if self.common is not None:
            return self.common
        return 0.5 if self.regulator is not None else 0.0
