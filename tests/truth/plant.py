"""Numbers of a pneumatic drive: what the user states, and what is really different.

Every number that stands for an effect is 0 (or 1 for a factor) where that effect is absent.
"""

from __future__ import annotations

from typing import NamedTuple

CELLS = 12  # of a tube


class Plant(NamedTuple):
    """A muscle that lifts or pulls a load, fed through a valve and perhaps a tube; SI, pressures absolute."""

    # muscle: length, thread, turns, added tension c10 * table of the wall
    nominal: float
    thread: float
    turns: float
    damping: float = 0.0  # known linear damping [N s/m]
    # load
    mass: float = 8.0
    weight: float = 78.4532  # force at rest [N]
    spring: float = 0.0  # [N/m]
    # air
    supply: float = 701_325.0
    ambient: float = 101_325.0
    room: float = 293.15
    fill: float = 3e-9  # sonic conductance [m^3/(s Pa)]
    vent: float = 3e-9
    ratio: float = 0.3  # critical pressure ratio
    exponent: float = 1.2  # polytropic
    dead: float = 0.0  # known dead volume [m^3]
    # tube, 0 m = none; lumped = 1: one volume at the valve and Eckersten's conductance behind it
    tube_length: float = 0.0
    tube_bore: float = 4e-3
    tube_lumped: float = 1.0
    tube_loss: float = 0.0  # pressure heads lost besides wall friction, spread along the tube
    # hidden: air
    travel: float = 0.0  # time that the valve's flow takes along the tube, on average [s]
    travel_spread: float = 0.0  # how far its front has flattened [s]
    orifice: float = 0.0  # 1: Saint-Venant and Wantzel instead of the ISO ellipse
    flow_factor: float = 1.0
    extra_dead: float = 0.0  # at 1 bar gauge [m^3]
    dead_give: float = 0.0  # how it grows with gauge pressure [1/Pa]
    heat: float = 0.0  # heat transfer at 1 bar [W/(m^2 K)], 0: polytropic
    wall_capacity: float = 1.0  # of the wall node [J/K]
    leak_laminar: float = 0.0  # [kg/(s Pa^2)]
    silencer: float = 0.0  # conductance of a silencer behind the valve, 0: none
    reservoir: float = 0.0  # volume before the valve [m^3], 0: ideal supply
    droop: float = 0.0  # of its regulator [Pa/(kg/s)]
    # hidden: mechanics
    extra_mass: float = 0.0
    extra_mass_slope: float = 0.0  # growth along the stroke [1/m]
    load_factor: float = 1.0
    drag: float = 0.0  # [N (s/m)^m]
    drag_power: float = 0.8
    drag_pressure: float = 0.0  # [1/Pa]
    drag_ratio: float = 1.0  # on lengthening
    rub: float = 0.0  # LuGre friction of the muscle [N]
    rub_pressure: float = 0.0  # and per gauge pressure [m^2]
    rub_way: float = 2e-4  # break-away distance [m]
    guide: float = 0.0  # Stribeck friction of the guide [N]
    guide_rise: float = 0.3
    guide_way: float = 2e-4
    inertance: float = 0.0  # force q v^2 [kg/m]
    shake: float = 0.0  # [N]
    shake_frequency: float = 0.0
    # the pressure is given instead of the air
    driven: float = 0.0


class Trace(NamedTuple):
    """A run: one row per written sample; pressures absolute."""

    time: object
    stroke: object
    speed: object
    pressure: object
    force: object
    gas_mass: object
    entered: object  # mass through the valve into tube or muscle, net [kg]
    leaked: object
    supply: object
