"""The task of ``/api/sizings`` and ``mckibben size``; `mckibben.facts.task` says what each field is."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, JsonValue

from mckibben.documents.drive import Inclination, LeverRatio, Mass, PulleyRadius, Stiffness
from mckibben.documents.json_document import JsonDocument
from mckibben.documents.kinds import is_preset, no_such, refuse_other, refuse_table
from mckibben.documents.quantity import Diameter, Force, PositivePressure, QuantityField, Temperature
from mckibben.documents.shorthand import LOAD_TEXT
from mckibben.documents.strict import Id, Strict
from mckibben.documents.studio import Studio
from mckibben.facts.task import TASK, usual
from mckibben.presets import TaskPreset
from mckibben.presets.reading import parse, read_file

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

    angle: Swing = Field(description=TASK["load.pair.angle"].definition)
    torque: Torque = Field(usual("load.pair.torque"), description=TASK["load.pair.torque"].definition)
    inertia: Inertia = Field(usual("load.pair.inertia"), description=TASK["load.pair.inertia"].definition)
    pulley_radius: PulleyRadius | None = Field(None, description=TASK["load.pair.pulley_radius"].definition)


class TaskLoad(Strict):
    """The load. All values are those at the load; forces are positive against the pull."""

    mass: Mass = Field(usual("load.mass"), description=TASK["load.mass"].definition)
    inclination: Inclination = Field(
        usual("load.inclination"), description=TASK["load.inclination"].definition
    )
    force: Force = Field(usual("load.force"), description=TASK["load.force"].definition)
    force_over_stroke: ForceOverStroke | None = Field(
        None, description=TASK["load.force_over_stroke"].definition
    )
    spring: Stiffness = Field(usual("load.spring"), description=TASK["load.spring"].definition)
    counterweight: Mass = Field(
        usual("load.counterweight"), description=TASK["load.counterweight"].definition
    )
    lever_ratio: LeverRatio = Field(
        usual("load.lever_ratio"), description=TASK["load.lever_ratio"].definition
    )
    pair: PairInput | None = Field(
        None, description="An antagonist pair on a pulley. No other field of the load may be given with it."
    )


class TaskLimits(Strict):
    """Limits of a drive."""

    max_contraction: Reach = Field(
        usual("limits.max_contraction"), description=TASK["limits.max_contraction"].definition
    )
    force_reserve: Reserve = Field(
        usual("limits.force_reserve"), description=TASK["limits.force_reserve"].definition
    )
    pressure_reserve: Share = Field(
        usual("limits.pressure_reserve"), description=TASK["limits.pressure_reserve"].definition
    )
    max_length: Room = Field(usual("limits.max_length"), description=TASK["limits.max_length"].definition)
    end_fittings: Room = Field(
        usual("limits.end_fittings"), description=TASK["limits.end_fittings"].definition
    )
    max_diameter: Diameter | None = Field(None, description=TASK["limits.max_diameter"].definition)
    max_parallel: Annotated[int, Field(ge=1, le=6)] = Field(
        int(usual("limits.max_parallel")), description=TASK["limits.max_parallel"].definition
    )
    max_impact_energy: Energy | None = Field(None, description=TASK["limits.max_impact_energy"].definition)
    life: Cycles | None = Field(None, description=TASK["limits.life"].definition)


class TaskCatalogue(Strict):
    """Parts that may be used."""

    muscles: list[Id] | None = Field(
        None,
        max_length=40,
        examples=[["DMSP-10", "DMSP-20", "DMSP-40"]],
        description=TASK["catalogue.muscles"].definition,
    )
    valves: list[Id] | None = Field(
        None, max_length=40, examples=[["MPYE-5-1/8-HF"]], description=TASK["catalogue.valves"].definition
    )
    tubes: list[Id] | None = Field(
        None, max_length=20, examples=[["PUN-H-6x1"]], description=TASK["catalogue.tubes"].definition
    )
    tube_length: TubeLength = Field(
        usual("catalogue.tube_length"), description=TASK["catalogue.tube_length"].definition
    )


class TaskOperation(Strict):
    """How the drive is used, for the cost of its air."""

    cycles_per_year: Cycles = Field(
        usual("operation.cycles_per_year"), description=TASK["operation.cycles_per_year"].definition
    )
    air_price: AirPrice = Field(
        usual("operation.air_price"), description=TASK["operation.air_price"].definition
    )
    currency: Annotated[str, Field(max_length=12)] = Field(
        "EUR", description=TASK["operation.currency"].definition
    )


class TaskUncertainty(Strict):
    """Expected deviations of real drives from the calculation."""

    blocked_force: Share = Field(
        usual("uncertainty.blocked_force"), description=TASK["uncertainty.blocked_force"].definition
    )
    hysteresis: Share | None = Field(None, description=TASK["uncertainty.hysteresis"].definition)
    supply_pressure: Share = Field(
        usual("uncertainty.supply_pressure"), description=TASK["uncertainty.supply_pressure"].definition
    )
    specimens: Annotated[int, Field(ge=0, le=5000)] = Field(
        int(usual("uncertainty.specimens")), description=TASK["uncertainty.specimens"].definition
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
    kind: Literal["task"] = Field("task", description="The word 'task'.")
    title: Annotated[str, Field(max_length=200)] = Field(
        "", description="Name that its user gives the task, shown beside its figures."
    )
    load: Annotated[TaskLoad, LOAD_TEXT] = Field(description="The load.")
    stroke: Stroke | None = Field(None, description=TASK["stroke"].definition)
    time: TaskTime | None = Field(None, description=TASK["time"].definition)
    time_down: TaskTime | None = Field(None, description=TASK["time_down"].definition)
    cycle_time: TaskTime | None = Field(None, description=TASK["cycle_time"].definition)
    speed: Speed | None = Field(None, description=TASK["speed"].definition)
    stiffness: Stiffness | None = Field(None, description=TASK["stiffness"].definition)
    supply_pressure: PositivePressure = Field(
        usual("supply_pressure"), description=TASK["supply_pressure"].definition
    )
    ambient_temperature: Temperature = Field(
        usual("ambient_temperature"), description=TASK["ambient_temperature"].definition
    )
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
        "balanced", description=TASK["rank_by"].definition
    )
    max_proposals: Annotated[int, Field(ge=1, le=30)] = Field(
        int(usual("max_proposals")), description=TASK["max_proposals"].definition
    )

    def completed(self) -> JsonDocument:
        """The task in SI with all assumed values; reading it again gives the same search."""
        whole = self.model_dump(mode="json", by_alias=True, exclude_none=True)
        if self.load.pair is not None:  # a pair allows no other field of the load
            whole["load"] = {"pair": whole["load"]["pair"]}
        return JsonDocument(whole)


def _content(path: Path, studio: Studio) -> object:
    """The content of a file, or the document inside a preset file."""
    refuse_table(path.name, "task")
    content = read_file(path, follow_links=True)
    refuse_other(content, "", ("task",))
    if not is_preset(content):
        return content
    preset = parse(TaskPreset, content, studio.effect_table)
    assert isinstance(preset, TaskPreset)  # noqa: S101 - parsed as one
    return preset.document


def read_task(document: object) -> SizingTask:
    """A task from JSON.

    Raises:
        InputError: what is wrong, with ``field`` the path in the document.
    """
    from mckibben.documents.problems import validated

    return validated(SizingTask, document, "the task")


def named_task(name: str, studio: Studio) -> SizingTask:
    """The task of a file, of a preset file, or of a preset.

    Raises:
        BadDocumentError: the file cannot be read, or its preset is not valid.
        InputError: what is wrong, with ``field`` the path in the document.
    """
    known = [preset.id for preset in studio.library.list("tasks")]
    if name in known or not (Path(name).exists() or name.lower().endswith(".json")):
        if name not in known:
            raise no_such(name, "task", studio.library)
        preset = studio.library.get("tasks", name)
        assert isinstance(preset, TaskPreset)  # noqa: S101 - of its folder
        return read_task(preset.document)
    return read_task(_content(Path(name), studio))
