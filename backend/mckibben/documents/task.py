"""The task of ``/api/sizings`` and ``mckibben size``; each default has its reason in its description."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field, JsonValue

from mckibben.documents.drive import Inclination, LeverRatio, Mass, PulleyRadius, Stiffness
from mckibben.documents.quantity import Diameter, Force, PositivePressure, Quantity, Temperature
from mckibben.documents.strict import Id, Strict

Stroke = Annotated[float, Quantity("m", "60 mm", above=1e-5, at_most=10.0)]
TaskTime = Annotated[float, Quantity("s", "0.5 s", above=1e-3, at_most=60.0)]
Speed = Annotated[float, Quantity("m/s", "0.2 m/s", above=1e-4, at_most=50.0)]
Place = Annotated[float, Quantity("m", "20 mm", at_least=0.0, at_most=10.0)]
Swing = Annotated[float, Quantity("rad", "60 deg", above=1e-3, at_most=6.2832)]
Torque = Annotated[float, Quantity("N*m", "5 N*m", at_least=0.0, at_most=1e5)]
Inertia = Annotated[float, Quantity("kg*m^2", "0.02 kg*m^2", at_least=0.0, at_most=1e4)]
Reach = Annotated[float, Quantity("1", "20 %", above=0.0, at_most=0.6)]
Reserve = Annotated[float, Quantity("1", "10 %", at_least=0.0, at_most=10.0)]
Share = Annotated[float, Quantity("1", "10 %", at_least=0.0, at_most=0.9)]
Room = Annotated[float, Quantity("m", "600 mm", at_least=0.0, at_most=100.0)]
Cycles = Annotated[float, Quantity("1", "1e6", above=0.0, at_most=1e12)]
TubeLength = Annotated[float, Quantity("m", "1 m", at_least=0.0, at_most=100.0)]


class ForceOverStroke(Strict):
    """A force that depends on where the load is, linear between the points."""

    strokes: list[Place] = Field(min_length=1, max_length=50, description="Strokes of the load, ascending.")
    forces: list[Force] = Field(min_length=1, max_length=50, description="Force against the pull there.")


class PairInput(Strict):
    """Two equal muscles that pull a pulley against each other."""

    angle: Swing = Field(description="Whole swing, from one end to the other.")
    torque: Torque = Field(
        0.0, description="Against the first muscle, over the whole swing. 0: a pulley turns about its centre."
    )
    inertia: Inertia = Field(
        0.0, description="Of everything that turns. 0: then the muscles' own air decides the time."
    )
    pulley_radius: PulleyRadius | None = Field(
        None, description="Left out, eight radii from 10 to 120 mm are tried: a free choice of the designer."
    )


class TaskLoad(Strict):
    """What is moved. Everything is counted at the load; forces are positive against the pull."""

    mass: Mass = Field(0.0, description="Moved mass. 0: only what is stated is moved.")
    inclination: Inclination = Field(
        1.5707963267948966,
        description="Of the way against the horizontal. 90 deg: a muscle can only pull, so most loads hang.",
    )
    force: Force = Field(
        0.0, description="Constant force besides the weight. 0: only what is stated pulls back."
    )
    force_over_stroke: ForceOverStroke | None = Field(
        None,
        description="Further force, by the stroke. The closed form takes it as it is; a run takes the lowest "
        "straight line that is nowhere below it and does not fall.",
    )
    spring: Stiffness = Field(
        0.0, description="Against the contraction, slack at the begin. 0: a weight pulls a muscle long again."
    )
    counterweight: Mass = Field(
        0.0, description="Hangs on the other side of a pulley and pulls with the muscle. 0: none is usual."
    )
    lever_ratio: LeverRatio = Field(
        1.0, description="Stroke of the muscle per stroke of the load. 1: the muscle pulls directly."
    )
    pair: PairInput | None = Field(
        None, description="An antagonist pair on a pulley instead: it takes no other field of the load."
    )


class TaskLimits(Strict):
    """What a drive must keep to."""

    max_contraction: Reach = Field(
        0.2,
        description="At the end of the stroke. 20 %: makers allow 25 %, but the last of it hardly pulls; the "
        "maker's own limit holds where it is lower.",
    )
    force_reserve: Reserve = Field(
        0.1,
        description="Share by which the static force exceeds the load everywhere on the stroke. 10 %: so "
        "much do specimens differ.",
    )
    pressure_reserve: Share = Field(
        0.0,
        description="Share of the supply that is not counted on. 0: the supply tolerance has its own field.",
    )
    max_length: Room = Field(
        1.0,
        description="Installed, without pressure. 1 m: longer muscles are made, machines seldom have room.",
    )
    end_fittings: Room = Field(
        0.0, description="What both end fittings take of it. 0: no verified figure is known; add yours."
    )
    max_diameter: Diameter | None = Field(
        None, description="Outside, bulged at the end of the stroke. None: the figure is told instead."
    )
    max_parallel: Annotated[int, Field(ge=1, le=6)] = Field(
        2, description="Muscles side by side. 2: more seldom share a load evenly."
    )
    life: Cycles | None = Field(
        None,
        description="Load cycles. None: makers publish no curve; what is told is an estimate (100 000 cycles "
        "at full force or contraction, 10 million without load, unverified).",
    )


class TaskCatalogue(Strict):
    """What may be used."""

    muscles: list[Id] | None = Field(
        None,
        max_length=40,
        description="Muscle presets. Left out: all with complete catalogue data, because then every limit is "
        "known.",
        examples=[["DMSP-10", "DMSP-20", "DMSP-40"]],
    )
    valves: list[Id] | None = Field(
        None,
        max_length=40,
        description="Valve presets. Left out: all whose flow is known; regulators switch too slowly.",
        examples=[["MPYE-5-1/8-HF"]],
    )
    tubes: list[Id] | None = Field(
        None, max_length=20, description="Tube presets. Left out: all.", examples=[["PUN-H-6x1"]]
    )
    tube_length: TubeLength = Field(
        1.0, description="From the valve to each muscle; 0 for none. 1 m: valves seldom sit on the muscle."
    )


class TaskUncertainty(Strict):
    """How far what is built may differ from what was computed."""

    blocked_force: Share = Field(
        0.1,
        description="Two standard deviations between specimens. 10 % of the blocked force: published curves "
        "of the same size differ by so much.",
    )
    hysteresis: Share | None = Field(
        None,
        description="Largest width of the loop, share of the nominal length. Left out: the catalogue's.",
    )
    supply_pressure: Share = Field(
        0.03, description="Largest deviation of the supply. 3 %: a usual service regulator."
    )
    specimens: Annotated[int, Field(ge=0, le=5000)] = Field(
        100, description="Simulated for each proposal; 0 for none. 100: within 5 % of the probability."
    )


_EXAMPLES: list[JsonValue] = [
    {
        "load": {"mass": "20 kg", "inclination": "90 deg", "force": "0 N"},
        "stroke": "60 mm",
        "time": "0.5 s",
        "supply_pressure": "6 bar",
        "limits": {
            "max_contraction": 0.2, "force_reserve": 0.1, "max_length": "600 mm", "max_diameter": "60 mm",
            "max_parallel": 2,
        },
        "catalogue": {
            "muscles": ["DMSP-10", "DMSP-20", "DMSP-40"], "valves": ["MPYE-5-1/8-HF"], "tube_length": "1 m",
        },
    },
    {
        "title": "ProPneu, figure 24: 200 mm at 6 bar with 20 mm",
        "load": {"mass": "10.41 kg"}, "stroke": "200 mm", "time": "0.4 s",
        "limits": {"max_contraction": "25 %"},
        "catalogue": {"muscles": ["DMSP-20"], "valves": ["MPYE-5-1/4", "MPYE-5-3/8"]},
    },
    {
        "title": "ProPneu: the same stroke with 10 mm",
        "load": {"mass": "9.79 kg"}, "stroke": "200 mm", "time": "0.4 s", "limits": {"max_length": "2 m"},
        "catalogue": {"muscles": ["DMSP-10"], "valves": ["MPYE-5-1/4", "MPYE-5-3/8"]},
    },
    {
        "title": "Joint of an antagonist pair",
        "load": {
            "pair": {"angle": "60 deg", "torque": "2 N*m", "inertia": 0.02, "pulley_radius": "30 mm"},
        },
        "time": "0.5 s", "catalogue": {"valves": ["MPYE-5-1/8-LF"]},
    },
]  # fmt: skip


class SizingTask(Strict):
    """A task; only the load, and a stroke or a pair, must be given. Plain numbers are in SI units."""

    model_config = ConfigDict(json_schema_extra={"examples": _EXAMPLES})

    schema_version: Literal[1] = Field(1, alias="schema", description="Version of the document.")
    title: Annotated[str, Field(max_length=200)] = Field("", description="For people.")
    load: TaskLoad
    stroke: Stroke | None = Field(None, description="Of the load; a pair has an angle instead.")
    time: TaskTime | None = Field(
        None, description="For the stroke. None: the drives are compared by what they take."
    )
    time_down: TaskTime | None = Field(None, description="For the way back. None: it may take its time.")
    cycle_time: TaskTime | None = Field(None, description="Up and down together. None: see the times.")
    speed: Speed | None = Field(
        None, description="Average speed in place of the time. None: the time says it."
    )
    stiffness: Stiffness | None = Field(
        None,
        description="Wanted against the load at the end of the stroke, valve open (a closed valve holds "
        "stiffer). None: it is told instead.",
    )
    supply_pressure: PositivePressure = Field(
        6e5, description="Gauge. 6 bar: the usual net, and the limit of most muscles."
    )
    ambient_temperature: Temperature = Field(293.15, description="20 °C: a workshop.")
    limits: TaskLimits = Field(default_factory=lambda: TaskLimits.model_validate({}))
    catalogue: TaskCatalogue = Field(default_factory=lambda: TaskCatalogue.model_validate({}))
    uncertainty: TaskUncertainty = Field(default_factory=lambda: TaskUncertainty.model_validate({}))
    rank_by: Literal["balanced", "air", "time", "length", "reserve", "probability"] = Field(
        "balanced",
        description="Balanced: air times the root of installed length and number of muscles, because air "
        "costs every day and room once. Drives that probably fail come last in any order.",
    )
    max_proposals: Annotated[int, Field(ge=1, le=30)] = Field(
        10, description="Proposals wanted. 10: more nobody compares."
    )
