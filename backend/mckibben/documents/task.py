"""The task of ``/api/sizings`` and ``mckibben size``; the descriptions give the reason of each default."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Field, JsonValue

from mckibben.documents.drive import Inclination, LeverRatio, Mass, PulleyRadius, Stiffness
from mckibben.documents.json_document import JsonDocument
from mckibben.documents.quantity import Diameter, Force, PositivePressure, QuantityField, Temperature
from mckibben.documents.strict import Id, Strict

Stroke = Annotated[float, QuantityField("m", "60 mm", above=1e-5, at_most=10.0)]
TaskTime = Annotated[float, QuantityField("s", "0.5 s", above=1e-3, at_most=60.0)]
Speed = Annotated[float, QuantityField("m/s", "0.2 m/s", above=1e-4, at_most=50.0)]
Place = Annotated[float, QuantityField("m", "20 mm", at_least=0.0, at_most=10.0)]
Swing = Annotated[float, QuantityField("rad", "60 deg", above=1e-3, at_most=6.2832)]
Torque = Annotated[float, QuantityField("N*m", "5 N*m", at_least=0.0, at_most=1e5)]
Inertia = Annotated[float, QuantityField("kg*m^2", "0.02 kg*m^2", at_least=0.0, at_most=1e4)]
Reach = Annotated[float, QuantityField("1", "20 %", above=0.0, at_most=0.6)]
Reserve = Annotated[float, QuantityField("1", "10 %", at_least=0.0, at_most=10.0)]
Share = Annotated[float, QuantityField("1", "10 %", at_least=0.0, at_most=0.9)]
Room = Annotated[float, QuantityField("m", "600 mm", at_least=0.0, at_most=100.0)]
Energy = Annotated[float, QuantityField("J", "5 J", above=0.0, at_most=1e6)]
Cycles = Annotated[float, QuantityField("1", "1e6", above=0.0, at_most=1e12)]
AirPrice = Annotated[float, QuantityField("1/m^3", "0.025 1/m^3", at_least=0.0, at_most=1e3)]
TubeLength = Annotated[float, QuantityField("m", "1 m", at_least=0.0, at_most=100.0)]


class ForceOverStroke(Strict):
    """A force that depends on the position of the load, linear between the points."""

    strokes: list[Place] = Field(min_length=1, max_length=50, description="Strokes of the load, ascending.")
    forces: list[Force] = Field(
        min_length=1, max_length=50, description="Force against the pull at these strokes."
    )


class PairInput(Strict):
    """Two equal muscles that pull a pulley in opposite directions."""

    angle: Swing = Field(description="Total angle, from one end to the other.")
    torque: Torque = Field(
        0.0, description="Torque against the first muscle, over the whole angle. 0 = no torque."
    )
    inertia: Inertia = Field(0.0, description="Moment of inertia of all rotating parts. 0 = no inertia.")
    pulley_radius: PulleyRadius | None = Field(
        None, description="Radius of the pulley. Default: eight radii from 10 to 120 mm are tried."
    )


class TaskLoad(Strict):
    """The load. All values are those at the load; forces are positive against the pull."""

    mass: Mass = Field(0.0, description="Mass moved by the muscle. 0 = no mass.")
    inclination: Inclination = Field(
        1.5707963267948966,
        description="Angle between the motion and the horizontal. Default 90 deg: most loads hang.",
    )
    force: Force = Field(0.0, description="Constant force in addition to the weight. 0 = no force.")
    force_over_stroke: ForceOverStroke | None = Field(
        None,
        description="Additional force that depends on the stroke. Static calculations use it as it is; a "
        "simulation uses the lowest straight line that is nowhere below it and does not fall.",
    )
    spring: Stiffness = Field(
        0.0, description="Spring against the contraction, relaxed at the start of the stroke. 0 = no spring."
    )
    counterweight: Mass = Field(
        0.0, description="Mass on the other side of a pulley that pulls with the muscle. 0 = none."
    )
    lever_ratio: LeverRatio = Field(
        1.0, description="Stroke of the muscle per stroke of the load. 1 = the muscle pulls directly."
    )
    pair: PairInput | None = Field(
        None, description="An antagonist pair on a pulley. No other field of the load may be given with it."
    )


class TaskLimits(Strict):
    """Limits of a drive."""

    max_contraction: Reach = Field(
        0.2,
        description="Contraction at the end of the stroke. Default 20 %: makers allow 25 %, but there the "
        "force is small. A lower limit of the maker takes precedence.",
    )
    force_reserve: Reserve = Field(
        0.1,
        description="Least excess of the static force over the load on the whole stroke, as a share of the "
        "load. Default 10 %: specimens differ by this much.",
    )
    pressure_reserve: Share = Field(
        0.0,
        description="Unused share of the supply pressure. Default 0: its tolerance has a field of its own.",
    )
    max_length: Room = Field(
        1.0,
        description="Installed length without pressure. Default 1 m. Longer muscles exist.",
    )
    end_fittings: Room = Field(
        0.0, description="Length of both end fittings together. Default 0: no verified value is known."
    )
    max_diameter: Diameter | None = Field(
        None, description="Outside diameter at the end of the stroke. Leave empty for no limit."
    )
    max_parallel: Annotated[int, Field(ge=1, le=6)] = Field(
        2, description="Most parallel muscles. Default 2: more muscles rarely share a load evenly."
    )
    max_impact_energy: Energy | None = Field(
        None,
        description="Kinetic energy of the load at the end stop that the stop can take. Leave empty for no "
        "limit. A drive above it is proposed behind those below it.",
    )
    life: Cycles | None = Field(
        None,
        description="Load cycles. Leave empty for no limit. Makers publish no curve; the program uses an "
        "unverified estimate (100 000 cycles at full force or contraction, 10 million without load).",
    )


class TaskCatalogue(Strict):
    """Parts that may be used."""

    muscles: list[Id] | None = Field(
        None,
        max_length=40,
        description="Muscle presets. Default: all with complete catalogue data, because then every limit is "
        "known.",
        examples=[["DMSP-10", "DMSP-20", "DMSP-40"]],
    )
    valves: list[Id] | None = Field(
        None,
        max_length=40,
        description="Valve presets. Default: all switching and proportional valves with known flow.",
        examples=[["MPYE-5-1/8-HF"]],
    )
    tubes: list[Id] | None = Field(
        None, max_length=20, description="Tube presets. Default: all.", examples=[["PUN-H-6x1"]]
    )
    tube_length: TubeLength = Field(
        1.0, description="Tube length from the valve to each muscle; 0 for no tube. Default 1 m."
    )


class TaskOperation(Strict):
    """How the drive is used, for the cost of its air."""

    cycles_per_year: Cycles = Field(1e6, description="Cycles a year. Default one million.")
    air_price: AirPrice = Field(
        0.025,
        description="Price of a cubic metre of compressed air at ANR. Default 0.025, a usual figure in euro "
        "(general knowledge, not verified: 0.01 to 0.03).",
    )
    currency: Annotated[str, Field(max_length=12)] = Field("EUR", description="Currency of the price.")


class TaskUncertainty(Strict):
    """Expected deviations of real drives from the calculation."""

    blocked_force: Share = Field(
        0.1,
        description="Two standard deviations of the blocked force between specimens. Default 10 %: published "
        "curves of the same size differ by this much.",
    )
    hysteresis: Share | None = Field(
        None,
        description="Largest width of the loop, share of the nominal length. Default: that of the catalogue.",
    )
    supply_pressure: Share = Field(
        0.03, description="Largest deviation of the supply pressure. Default 3 %: a common service regulator."
    )
    specimens: Annotated[int, Field(ge=0, le=5000)] = Field(
        100, description="Simulated specimens of each proposal. 100 give the probability within 5 %."
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
        "title": "ProPneu, figure 24",
        "load": {"mass": "9.321 kg"}, "stroke": "200 mm", "time": "0.4 s",
        "limits": {"max_contraction": "25 %"},
        "catalogue": {"muscles": ["DMSP-20"], "valves": ["MPYE-5-1/4", "MPYE-5-3/8"]},
    },
    {
        "title": "ProPneu, the smaller muscle",
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
    """A task; only the load, and a stroke or a pair, are required. Plain numbers are in SI units."""

    model_config = ConfigDict(json_schema_extra={"examples": _EXAMPLES})

    schema_version: Literal[1] = Field(1, alias="schema", description="Version of the document.")
    title: Annotated[str, Field(max_length=200)] = Field(
        "", description="Name that its user gives the task, shown beside its figures."
    )
    load: TaskLoad = Field(description="The load.")
    stroke: Stroke | None = Field(None, description="Stroke of the load; a pair has an angle instead.")
    time: TaskTime | None = Field(None, description="Time for the stroke. Leave empty for no limit.")
    time_down: TaskTime | None = Field(
        None, description="Time for the return stroke. Leave empty for no limit."
    )
    cycle_time: TaskTime | None = Field(
        None, description="Time for both strokes together. Leave empty for no limit."
    )
    speed: Speed | None = Field(None, description="Average speed of the stroke, instead of the time.")
    stiffness: Stiffness | None = Field(
        None,
        description="Least stiffness at the load at the end of the stroke with an open valve (with a closed "
        "valve it is higher). Leave empty for no limit.",
    )
    supply_pressure: PositivePressure = Field(
        6e5, description="Gauge pressure of the supply. Default 6 bar, the limit of most muscles."
    )
    ambient_temperature: Temperature = Field(293.15, description="Ambient temperature. Default 20 °C.")
    limits: TaskLimits = Field(
        default_factory=lambda: TaskLimits.model_validate({}),
        description="What a proposed drive may need at most, and its reserves.",
    )
    catalogue: TaskCatalogue = Field(
        default_factory=lambda: TaskCatalogue.model_validate({}),
        description="Parts that may be used. Default: all that are known well enough.",
    )
    operation: TaskOperation = Field(
        default_factory=lambda: TaskOperation.model_validate({}),
        description="Cycles a year and price of air, for the cost of its air.",
    )
    uncertainty: TaskUncertainty = Field(
        default_factory=lambda: TaskUncertainty.model_validate({}),
        description="Expected deviations of real drives, for the probability of success.",
    )
    rank_by: Literal["balanced", "air", "time", "length", "reserve", "probability"] = Field(
        "balanced",
        description="Order of the proposals. Balanced: by air consumption times the square root of installed "
        "length and number of muscles. Drives that probably fail come last in any order.",
    )
    max_proposals: Annotated[int, Field(ge=1, le=30)] = Field(10, description="Most proposals. Default 10.")

    def completed(self) -> JsonDocument:
        """The task in SI with all assumed values; reading it again gives the same search."""
        whole = self.model_dump(mode="json", by_alias=True, exclude_none=True)
        if self.load.pair is not None:  # a pair allows no other field of the load
            whole["load"] = {"pair": whole["load"]["pair"]}
        return JsonDocument(whole)
