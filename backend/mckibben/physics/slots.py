"""The slots where an effect may act: the inputs of each, and how several effects in one slot combine.

A slot function has keyword-only arguments and requests its inputs by name: names of the context of its slot
below, and parameters of its effect. Other names are refused when the catalogue loads the file.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from mckibben.physics.ops import Value

# Inputs of most slots: the muscle at rest, true length [m] and gauge pressure [Pa] at the muscle,
# dL/dt [m/s] (> 0 lengthening), its sign, and the temperature of the elastomer [K]. At rest the sign may be
# any number from -1 to 1: a law of dry friction is the direction times its force, so that a load sticks in a
# run (`mckibben.physics.drive`); its value at zero velocity is the force that breaks it away.
_STATE = ("muscle", "length", "pressure", "velocity", "direction", "temperature")


class Shape(NamedTuple):
    """Enclosed gas volume [m^3] and braid diameter at mid-span [m]."""

    volume: Value
    diameter: Value


class Reading(NamedTuple):
    """A sensor: reading = scale * true + offset."""

    scale: Value
    offset: Value


# Inputs of rates of the drive: opening of the valve before this effect [-], mass flows [kg/s] from the
# supply, into the muscle and through the exhaust, whose conductance is that of the open valve [m^3/(s Pa)],
# pressures [Pa] (supply and ambient absolute, muscle gauge), the load's stroke and speed, and the sensor
# readings before any effect of the reading slots.
_DRIVE = (
    "opening",
    "supply_flow",
    "mass_flow",
    "exhaust_flow",
    "exhaust_conductance",
    "supply_pressure",
    "ambient_pressure",
    "pressure",
    "force",
    "stroke",
    "speed",
    "gas_temperature",
    "instant_pressure_reading",
    "instant_force_reading",
    "instant_stroke_reading",
)


@dataclass(frozen=True, slots=True)
class Slot:
    """Meaning of a slot, the names its functions may request, and the rule of combination."""

    meaning: str
    context: tuple[str, ...]
    combined_by: str


SLOTS: dict[str, Slot] = {
    "pressure": Slot(
        "gauge pressure at the muscle to the pressure that drives the braid [Pa]",
        ("muscle", "pressure"),
        "chain",
    ),
    "braid": Slot(
        "the thread: inextensible braid to the braid under load (a Braid); constant in -dV/dL, because the "
        "work of stretching is counted separately",
        ("muscle", "braid", "pressure", "length"),
        "chain",
    ),
    "shape": Slot(
        "the enclosed volume: wraps inner(length) -> Shape; the force follows as -P dV/dL, and the gas "
        "balance uses the same volume",
        ("muscle", "inner", "length", "pressure"),
        "chain",
    ),
    "force_factor": Slot("multiplies the force of the gas [-]", _STATE, "product"),
    "elastomer": Slot(
        "tension of the elastomer, from a stored energy of length [N]", ("muscle", "length"), "sum"
    ),
    "elastomer_factor": Slot("multiplies the tension of the elastomer [-]", _STATE, "product"),
    "tension": Slot(
        "any other additive tension without dissipation [N]", ("muscle", "length", "pressure"), "sum"
    ),
    "friction": Slot("additive tension that dissipates: friction, damping, relaxation [N]", _STATE, "sum"),
    "compliance": Slot("extension of the parts in series with the muscle, per force [m/N]", (), "sum"),
    "rates": Slot(
        "rates of the effect's states in the muscle, in their order",
        (*_STATE, "area", "pressure_rate"),
        "concatenate",
    ),
    "extra_volume": Slot("gas volume besides that of the braid [m^3]", ("muscle",), "sum"),
    "heat": Slot(
        "heat flow into the gas [W]; makes the chamber obey the energy balance instead of a polytrope",
        ("muscle", "length", "diameter", "gas_temperature", "ambient_temperature"),
        "sum",
    ),
    "leakage": Slot(
        "mass flow out of the muscle [kg/s]",
        ("absolute_pressure", "ambient_pressure", "gas_temperature"),
        "sum",
    ),
    "command_delay": Slot("dead time of opening and of closing, a pair [s]", ("tube_length",), "sum"),
    "opening": Slot("commanded to effective opening of the valve [-1, 1]", ("opening",), "chain"),
    "fill_conductance": Slot("sonic conductance of filling [m^3/(s Pa)]", ("conductance",), "chain"),
    "exhaust_conductance": Slot("sonic conductance of exhausting [m^3/(s Pa)]", ("conductance",), "chain"),
    "tube_conductance": Slot("sonic conductance of the tube [m^3/(s Pa)]", ("conductance",), "chain"),
    "supply": Slot("absolute supply pressure at the valve [Pa]", ("supply_pressure",), "chain"),
    "exhaust_sink": Slot("absolute pressure behind the exhaust [Pa]", ("sink_pressure",), "chain"),
    "inertia": Slot("mass that moves with the load [kg]", ("muscle",), "sum"),
    "hung_mass": Slot("mass whose weight acts on the load besides its own [kg]", (), "sum"),
    "load_factor": Slot("multiplies mass and force of the load [-]", (), "product"),
    "guide": Slot(
        "force of the guide against the motion [N]; load is the force of the load along it, unsigned",
        ("stroke", "speed", "direction", "load"),
        "sum",
    ),
    "joint_angle": Slot("measured to true angle of a joint [rad]", ("angle",), "chain"),
    "joint_lever": Slot("multiplies the levers of a joint [-]", (), "product"),
    "joint_torque": Slot(
        "torque on a joint to smaller angles, besides that of the muscles [N m]; direction is the sign of "
        "its motion",
        ("angle", "direction"),
        "sum",
    ),
    "drive_rates": Slot("rates of the effect's states in the drive, in their order", _DRIVE, "concatenate"),
    "pressure_reading": Slot("measured gauge pressure [Pa]", ("reading",), "chain"),
    "force_reading": Slot("measured force [N]", ("reading",), "chain"),
    "stroke_reading": Slot("measured stroke [m]", ("reading",), "chain"),
    "skew": Slot("delay of the force channel against the others [s]", (), "sum"),
    "pressure_sensor": Slot("true to measured gauge pressure (a Reading)", (), "chain"),
    "length_sensor": Slot("true to measured length (a Reading)", ("muscle",), "chain"),
    "force_sensor": Slot("true to measured force (a Reading)", ("temperature",), "chain"),
}
