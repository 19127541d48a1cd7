"""The drive document: muscle, valve or regulator, tube, load, command or controller."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import (
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    ValidatorFunctionWrapHandler,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from mckibben.documents.drive_air import (
    FlowControlInput,
    PwmInput,
    QuickExhaustInput,
    RegulatorInput,
    SupplyInput,
    TubeInput,
    ValveInput,
)
from mckibben.documents.joint_parts import JointInput
from mckibben.documents.muscle import EffectsInput, Muscle
from mckibben.documents.quantity import (
    Contraction,
    Pressure,
    QuantityField,
    Temperature,
    Volume,
)
from mckibben.documents.shorthand import LOAD_TEXT, SUPPLY_TEXT, TUBE_TEXT, VALVE_TEXT
from mckibben.documents.signals import (
    AngleOverTime,
    Command,
    ForceOverTime,
    Reference,
    StiffnessOverTime,
)
from mckibben.documents.strict import Id, Strict
from mckibben.facts.linear import CONTROLLER
from mckibben.facts.run import curve_fit_of
from mckibben.physics import gas
from mckibben.physics.errors import InputError
from mckibben.physics.units import absolute_text, si

#: Gauge pressures of a drive document, by their path.
_GAUGE = (("supply", "pressure"), ("regulator", "range"), ("start_pressure",))


def with_gauge_pressures(document: Mapping[str, Any]) -> Mapping[str, Any]:
    """The document with its absolute pressures as gauge ones [Pa]; unchanged without an ambient pressure.

    What cannot be converted stays as it is, for the error at its field.
    """
    gas = document.get("gas")
    if "supply" in document:
        document = {**document, "supply": SUPPLY_TEXT.document(document["supply"])}
    if not isinstance(gas, Mapping) or "ambient_pressure" not in gas:
        return document
    try:
        ambient = si(gas["ambient_pressure"], "Pa", reference="absolute")
    except InputError:
        return document
    changed = dict(document)
    for section, *rest in _GAUGE:
        holder: Any = document.get(section) if rest else document
        name = rest[0] if rest else section
        value = holder.get(name) if isinstance(holder, Mapping) else None
        if not absolute_text(value):
            continue
        try:
            gauge = si(value, "Pa", reference="gauge", ambient=ambient)
        except InputError:
            continue
        if rest:
            changed[section] = {**holder, name: gauge}
        else:
            changed[name] = gauge
    return changed


LONGEST = 600.0  # s, of a run

Mass = Annotated[float, QuantityField("kg", "10 kg", at_least=0.0, at_most=1e5)]
Inclination = Annotated[float, QuantityField("rad", "90 deg", at_least=-1.5707963268, at_most=1.5707963268)]
Stiffness = Annotated[float, QuantityField("N/m", "500 N/m", at_least=0.0, at_most=1e9)]
LeverRatio = Annotated[float, QuantityField("1", "0.5", above=1e-3, at_most=1e3)]
PulleyRadius = Annotated[float, QuantityField("m", "20 mm", above=1e-4, at_most=10.0)]
Exponent = Annotated[float, QuantityField("1", "1.2", at_least=1.0, at_most=1.4)]
HeatTransfer = Annotated[float, QuantityField("W/(m^2*K)", "100 W/(m^2*K)", at_least=0.0, at_most=1e5)]
Restitution = Annotated[float, QuantityField("1", "0.3", at_least=0.0, at_most=0.9)]
Position = Annotated[float, QuantityField("m", "20 mm", at_least=-10.0, at_most=10.0)]
Duration = Annotated[float, QuantityField("s", "4 s", above=0.0, at_most=LONGEST)]
Ambient = Annotated[
    float, QuantityField("Pa", "1013.25 hPa", at_least=1e4, at_most=1e6, reference="absolute")
]


@dataclass(frozen=True, slots=True)
class AsGiven(QuantityField):
    """A quantity that is checked but not converted, because a plain number is not in SI."""

    def __call__(self, value: object) -> Any:
        """The value unchanged; InputError if it is not a quantity of this unit."""
        si(value, self.unit)
        return value


Gain = Annotated[Any, AsGiven("1/m", "20 1/m")]
IntegralGain = Annotated[Any, AsGiven("1/(m*s)", "100 1/(m*s)")]
DerivativeGain = Annotated[Any, AsGiven("s/m", "0.1 s/m")]
Time = Annotated[Any, AsGiven("s", "5 ms")]
Share = Annotated[Any, AsGiven("1", "100 %")]
Rate = Annotated[Any, AsGiven("1/s", "2 1/s")]


class LoadInput(Strict):
    """The load of the muscle."""

    mass: Mass = Field(0.0, description="Mass of the load.")
    force: ForceOverTime = Field(
        0.0, description="External force against the pull: a constant, or a signal of time."
    )
    inclination: Inclination | None = Field(
        None, description="Angle between the motion of the load and the horizontal. Default 90 deg."
    )
    arrangement: Literal["hanging", "inclined", "horizontal", "lever", "antagonist", "joint"] | None = Field(
        None,
        description="Hanging is 90 deg, horizontal 0 deg. A lever needs lever_ratio. An antagonist pair "
        "needs pulley_radius: a second, equal muscle with the mirrored command pulls in the other direction. "
        "A joint states 'joint' instead of mass, spring and lever.",
    )
    spring: Stiffness = Field(0.0, description="Spring against the contraction, at the load.")
    lever_ratio: LeverRatio | None = Field(None, description="Stroke of the muscle per stroke of the load.")
    pulley_radius: PulleyRadius | None = Field(
        None, description="Radius of the pulley of an antagonist pair."
    )
    precontraction: Contraction | None = Field(
        None, description="Contraction of both muscles of a pair in the middle position. Default 10 %."
    )
    joint: JointInput | None = Field(
        None,
        description="One muscle, or two against each other, at levers that change with the angle of a joint; "
        "the muscles are that of the drive. Its stops are those of the drive.",
    )


class StiffnessControlInput(Strict):
    """Second set point of a controlled antagonist joint: its stiffness, by the command that both muscles
    have in common. It is estimated from the angle and both pressures with the static model of the muscles;
    its error counts as the mean pressure that is missing, a share of the full one.
    """

    reference: StiffnessOverTime = Field(
        description="Desired stiffness of the joint at constant pressures: a constant, or a signal of time.",
        examples=["20 N*m/rad"],
    )
    kp: Share | None = Field(
        None, description="Proportional gain. Default: 2 for a valve, 0 for a regulator.", examples=[2.0]
    )
    ki: Rate | None = Field(
        None, description="Integral gain, 1/s. Default: 0 for a valve, 0.5 for a regulator.", examples=[2.0]
    )


def _gain(name: str) -> str:
    """What a gain is, and the unit of a plain number."""
    figure = CONTROLLER[name]
    return f"{figure.label}: {figure.definition} A plain number is in {figure.scale.unit}, not SI."


class ControllerInput(Strict):
    """A sampled PID controller of the load's position. A gain without a unit is in percent of full command
    per mm (and s), not in SI.
    """

    type: Literal["pid"] = Field("pid", description="Kind of the controller; there is one.")
    kp: Gain = Field(description=_gain("kp"), examples=[2.0])
    ki: IntegralGain | None = Field(None, description=_gain("ki"), examples=[10.0])
    kd: DerivativeGain | None = Field(None, description=_gain("kd"), examples=[0.01])
    feed_forward: Gain | None = Field(None, description=_gain("feed_forward"))
    derivative_filter: Time | None = Field(None, description="Filter time of the derivative. Default 5 ms.")
    sample_time: Time | None = Field(None, description="Sample time. Default 1 ms.")
    output_min: Share | None = Field(
        None, description="Lowest command. Default -1 for a valve, 0 for a regulator."
    )
    output_max: Share | None = Field(None, description="Highest command. Default 1.")
    reference: Reference | None = Field(
        None,
        description="Desired position, as a signal of time; a joint may state the angle instead.",
        examples=[{"shape": "triangle", "amplitude": "20 mm", "period": "1 s"}],
    )
    angle: AngleOverTime | None = Field(
        None,
        description="Desired angle of an antagonist joint instead of the position: a constant, or a signal "
        "of time.",
        examples=["10 deg"],
    )
    stiffness: StiffnessControlInput | None = Field(
        None,
        description="Second set point, of an antagonist joint only. The controller then gives half of the "
        "difference of both commands, between -0.5 and 0.5 of a regulator.",
    )


class GasInput(Strict):
    """The air and its surroundings."""

    polytropic_exponent: Exponent | None = Field(
        None,
        description="1 isothermal, 1.4 adiabatic. Default: none; the gas then has a temperature that follows "
        "from the energy balance with heat exchange, and its mass is conserved.",
    )
    wall_heat_transfer: HeatTransfer = Field(
        gas.WALL_HEAT_TRANSFER,
        description="Heat transfer coefficient between the gas in the muscle and its wall, for the energy "
        "balance. 0 is adiabatic. Not verified: 20 to 60 at rest, several hundred during a fast fill.",
    )
    temperature: Temperature = Field(293.15, description="Temperature of the supply and the surroundings.")
    ambient_pressure: Ambient = Field(101_325.0, description="Absolute pressure of the surroundings.")
    dead_volume: Volume = Field(
        0.0, description="Gas volume in addition to muscle and tube: ports, a reservoir."
    )


class StopsInput(Strict):
    """End stops as contraction ratios; below 0 the muscle may be stretched."""

    min_contraction: Contraction = Field(0.0, description="The load rests here without pressure.")
    max_contraction: Contraction | None = Field(
        None, description="Default: the limit of the muscle preset, else 25 %."
    )
    restitution: Restitution = Field(
        0.0, description="Share of the speed with which the load rebounds from a stop; 0 = it does not."
    )


class StartInput(Strict):
    """Where the load is at t = 0."""

    position: Position | None = Field(
        None,
        description="Position of the load, positive = muscle shorter; released there at t = 0. Default: "
        "where it rests at the start pressure; on the lower end stop where it would rest anywhere.",
    )
    reached: Literal["from below", "from above"] | None = Field(
        None,
        description="Where dry friction holds the load within a range of positions: the end of it at which "
        "the load has come to rest. Default: between both, where it would rest without that friction.",
    )


class DriveDocument(Strict):
    """A complete drive. Strokes are positive when the muscle gets shorter. Pressures are gauge; a text like
    "7 bar(a)" is converted with the ambient pressure of the document.
    """

    schema_version: Literal[1] = Field(1, alias="schema", description="Version of the document.")
    title: Annotated[str, Field(max_length=200)] = Field("", description="Title for display.")
    curve_fit: Annotated[str, Field(max_length=200)] = Field(
        "",
        description="What the drive was fitted to, where its volumes and conductances are those of no parts: "
        "then it is called a curve fit wherever it is shown. Empty: a drive.",
        examples=["Figure 24 of the paper"],
    )
    kind: Literal["drive"] = Field("drive", description="The word 'drive'.")
    muscle: Muscle = Field(description="The muscle; both muscles of an antagonist pair.")
    effects: EffectsInput | None = Field(
        None, description="The effects of the model; null: those of the presets."
    )
    supply: Annotated[SupplyInput, SUPPLY_TEXT] = Field(description="The compressed air before the valve.")
    valve: Annotated[ValveInput, VALVE_TEXT] = Field(description="The valve.")
    regulator: RegulatorInput | None = Field(
        None,
        description="States that the valve is a pressure regulator; null: it is one only if its preset is.",
    )
    tube: Annotated[TubeInput, TUBE_TEXT] | None = Field(
        None,
        description="Default: the valve is on the muscle, but a diagnosis tries a typical tube (4 mm, "
        "1 m) as an explanation. null: there is no tube, and a diagnosis tries none.",
    )
    flow_control: FlowControlInput | None = Field(
        None, description="A one-way flow control valve on the muscle; null: there is none."
    )
    quick_exhaust: QuickExhaustInput | None = Field(
        None, description="A quick exhaust valve on the muscle; null: there is none."
    )
    pwm: PwmInput | None = Field(
        None,
        description="Pulse-width modulation: the valves switch, and the command is their duty ratio; "
        "null: the valve opens as far as it is commanded.",
    )
    fittings: list[Id] = Field(
        default_factory=list, max_length=20, description="Fitting presets; they add their port volumes."
    )
    load: Annotated[LoadInput, LOAD_TEXT] = Field(
        default_factory=lambda: LoadInput.model_validate({}), description="The load. Default: none."
    )
    command: Command | None = Field(
        None,
        description="Opening of the valve: 1 fill, 0 closed, -1 vent; for a regulator, the share of its "
        "range. Where a shape has no value, e.g. outside a pulse, the valve exhausts (0 for a regulator). "
        "Not needed with a controller or a measurement, which supply the command.",
        examples=[{"shape": "pulse", "on": "0 s", "off": "2 s"}],
    )
    controller: ControllerInput | None = Field(None, description="Controller that generates the command.")
    gas: GasInput = Field(
        default_factory=lambda: GasInput.model_validate({}),
        description="How the air behaves, and what surrounds the drive.",
    )
    stops: StopsInput = Field(
        default_factory=lambda: StopsInput.model_validate({}), description="The end stops."
    )
    duration: Duration = Field(4.0, description="Length of the run.")
    start_pressure: Pressure = Field(0.0, description="Gauge pressure in the muscle at t = 0.")
    start: StartInput = Field(
        default_factory=lambda: StartInput.model_validate({}),
        description="Where the load is released at t = 0. Default: where it rests.",
    )

    def named(self, name: str) -> str:
        """A name of the drive as titles show it: that of a curve fit says that it is one."""
        return f"{name} ({curve_fit_of(self.curve_fit)})" if self.curve_fit else name

    @model_validator(mode="before")
    @classmethod
    def _gauge(cls, document: Any) -> Any:
        """Absolute pressures in texts as gauge pressures, where the document states its own ambient one."""
        return with_gauge_pressures(document) if isinstance(document, Mapping) else document


@dataclass(frozen=True, slots=True)
class OrPreset:
    """Also accepts the id of a preset. Not a union, whose errors would not name the field alone.

    Attributes:
        kind: of the preset, for messages.
        example: the id of one.
    """

    kind: str
    example: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """A string is an id, everything else a document."""
        return core_schema.no_info_wrap_validator_function(self._document_or_id, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """A document or an id."""
        preset = {"type": "string", "pattern": _ID.pattern, "examples": [self.example]}
        return {"anyOf": [handler(schema), preset]}

    def _document_or_id(self, value: object, handler: ValidatorFunctionWrapHandler) -> Any:
        if not isinstance(value, str):
            return handler(value)
        if _ID.match(value) is None:
            raise InputError(f"cannot be the id of a {self.kind} preset", hint=f"e.g. '{self.example}'")
        return value


_ID = re.compile(r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$")


DriveOrId = Annotated[DriveDocument, OrPreset("drive", "paper-step")]
