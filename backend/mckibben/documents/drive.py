"""The drive document: muscle, valve or regulator, tube, load, command or controller."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidatorFunctionWrapHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.quantity import (
    Contraction,
    Diameter,
    Length,
    PositivePressure,
    Pressure,
    Quantity,
    Temperature,
    Volume,
)
from mckibben.documents.signals import Command, ForceOverTime, Reference
from mckibben.documents.strict import Id, Strict
from mckibben.physics.errors import InputError
from mckibben.physics.units import si

LONGEST = 600.0  # s

Mass = Annotated[float, Quantity("kg", "10 kg", at_least=0.0, at_most=1e5)]
Conductance = Annotated[float, Quantity("m^3/(s*Pa)", "1.2 l/(s*bar)", at_least=0.0, at_most=1e-5)]
Flow = Annotated[float, Quantity("m^3/s", "350 l/min", above=0.0, at_most=10.0)]
Ratio = Annotated[float, Quantity("1", "0.3", at_least=0.0, at_most=0.99)]
Inclination = Annotated[float, Quantity("rad", "90 deg", at_least=-1.5707963268, at_most=1.5707963268)]
Stiffness = Annotated[float, Quantity("N/m", "500 N/m", at_least=0.0, at_most=1e9)]
LeverRatio = Annotated[float, Quantity("1", "0.5", above=1e-3, at_most=1e3)]
PulleyRadius = Annotated[float, Quantity("m", "20 mm", above=1e-4, at_most=10.0)]
Exponent = Annotated[float, Quantity("1", "1.2", at_least=1.0, at_most=1.4)]
Duration = Annotated[float, Quantity("s", "4 s", above=0.0, at_most=LONGEST)]
LagTime = Annotated[float, Quantity("s", "50 ms", above=1e-5, at_most=100.0)]
Ambient = Annotated[float, Quantity("Pa", "1013.25 hPa", at_least=1e4, at_most=1e6)]


@dataclass(frozen=True, slots=True)
class AsGiven(Quantity):
    """A quantity that is checked but kept as given: what a plain number means is not SI."""

    def __call__(self, value: object) -> Any:
        """The value as given; InputError when it is no quantity of this unit."""
        si(value, self.unit)
        return value


Gain = Annotated[Any, AsGiven("1/m", "20 1/m")]
IntegralGain = Annotated[Any, AsGiven("1/(m*s)", "100 1/(m*s)")]
DerivativeGain = Annotated[Any, AsGiven("s/m", "0.1 s/m")]
Time = Annotated[Any, AsGiven("s", "5 ms")]
Share = Annotated[Any, AsGiven("1", "100 %")]


class SupplyInput(Strict):
    """The compressed-air supply."""

    pressure: PositivePressure = Field(600e3, description="Gauge pressure before the valve.")


class ValveInput(Strict):
    """A valve preset, or its flow both ways by value; values given besides a preset take its place."""

    preset: Id | None = None
    sonic_conductance: Conductance | None = Field(None, description="Conductance of filling, ISO 6358.")
    exhaust_conductance: Conductance | None = Field(
        None, description="Conductance of venting; that of filling when left out."
    )
    critical_pressure_ratio: Ratio | None = Field(
        None, description="Critical pressure ratio b of filling; 0.3 when neither preset nor value says it."
    )
    exhaust_critical_pressure_ratio: Ratio | None = Field(
        None, description="Critical pressure ratio of venting; that of filling when left out."
    )
    nominal_flow: Flow | None = Field(
        None,
        description="Standard nominal flow (6 to 5 bar gauge, normal litres) in place of a conductance.",
    )


class RegulatorInput(Strict):
    """Makes the valve a pressure regulator; a regulator preset has figures of its own."""

    range: PositivePressure | None = Field(None, description="Gauge pressure at full command.")
    time: LagTime | None = Field(None, description="Time constant of the regulated pressure.")


class TubeInput(Strict):
    """The tube between valve and muscle."""

    preset: Id | None = None
    inside_diameter: Diameter | None = None
    length: Length | None = Field(None, description="Its length; that of the preset's figures if left out.")


class LoadInput(Strict):
    """What the muscle pulls."""

    mass: Mass = Field(0.0, description="Mass of the load.")
    force: ForceOverTime = Field(
        0.0, description="External force against the pull: a constant, or a signal of time."
    )
    inclination: Inclination | None = Field(
        None, description="Of the way the load is pulled against the horizontal; 90 deg when left out."
    )
    arrangement: Literal["hanging", "inclined", "horizontal", "lever", "antagonist"] | None = Field(
        None,
        description="Hanging is 90 deg, horizontal 0 deg; a lever needs its ratio; an antagonist pair on a "
        "pulley needs its radius: a second, equal muscle with the mirrored command pulls the other way.",
    )
    spring: Stiffness = Field(0.0, description="Spring against the contraction, at the load.")
    lever_ratio: LeverRatio | None = Field(None, description="Stroke of the muscle per stroke of the load.")
    pulley_radius: PulleyRadius | None = Field(None, description="Of an antagonist pair's pulley.")
    precontraction: Contraction | None = Field(
        None, description="Of both muscles of a pair at the middle; 10 % when left out."
    )


class ControllerInput(Strict):
    """A sampled PID controller of the load's position; without a unit, gains are percent of full command
    per mm (and s).
    """

    type: Literal["pid"] = "pid"
    kp: Gain = Field(description="Proportional gain, %/mm.", examples=[2.0])
    ki: IntegralGain | None = Field(None, description="Integral gain, %/(mm s).", examples=[10.0])
    kd: DerivativeGain | None = Field(None, description="Derivative gain, % s/mm.", examples=[0.01])
    feed_forward: Gain | None = Field(None, description="Command per reference, %/mm.")
    derivative_filter: Time | None = Field(None, description="Filter of the derivative; 5 ms if left out.")
    sample_time: Time | None = Field(None, description="1 ms if left out.")
    output_min: Share | None = Field(None, description="Lowest command; -1 for a valve, 0 for a regulator.")
    output_max: Share | None = Field(None, description="Highest command; 1 if left out.")
    reference: Reference = Field(
        description="Position wanted, as a signal of time.",
        examples=[{"shape": "triangle", "amplitude": "20 mm", "period": "1 s"}],
    )


class GasInput(Strict):
    """The air and its surroundings."""

    polytropic_exponent: Exponent = Field(1.2, description="1 isothermal, 1.4 adiabatic.")
    temperature: Temperature = Field(293.15, description="Of the supply and the surroundings.")
    ambient_pressure: Ambient = Field(101_325.0, description="Absolute pressure of the surroundings.")
    dead_volume: Volume = Field(0.0, description="Gas volume besides muscle and tube: ports, a reservoir.")


class StopsInput(Strict):
    """End stops as contraction ratios; below 0 the muscle may be stretched."""

    min_contraction: Contraction = Field(0.0, description="The load rests here without pressure.")
    max_contraction: Contraction | None = Field(
        None, description="The limit of the muscle preset when left out, else 25 %."
    )


class DriveDocument(Strict):
    """A complete drive. Pressures are gauge, strokes are positive when the muscle gets shorter."""

    schema_version: Literal[1] = Field(1, alias="schema", description="Version of the document.")
    title: Annotated[str, Field(max_length=200)] = Field("", description="For people.")
    muscle: MuscleInput
    effects: EffectsInput | None = None
    supply: SupplyInput
    valve: ValveInput
    regulator: RegulatorInput | None = None
    tube: TubeInput | None = Field(
        None,
        description="Left out: the valve sits on the muscle, and a diagnosis tries a typical tube (4 mm, "
        "1 m) as an explanation. null: there is none, and none is tried.",
    )
    fittings: list[Id] = Field(
        default_factory=list, max_length=20, description="Fitting presets; they add their port volumes."
    )
    load: LoadInput = Field(default_factory=lambda: LoadInput.model_validate({}))
    command: Command | None = Field(
        None,
        description="Opening of the valve: 1 fill, 0 closed, -1 exhaust; of a regulator the share of its "
        "range. What a shape leaves open, e.g. outside a pulse, is exhaust (0 for a regulator). To be left "
        "out with a controller, or beside a measurement, which brings its own.",
        examples=[{"shape": "pulse", "on": "0 s", "off": "2 s"}],
    )
    controller: ControllerInput | None = Field(None, description="Gives the command instead.")
    gas: GasInput = Field(default_factory=lambda: GasInput.model_validate({}))
    stops: StopsInput = Field(default_factory=lambda: StopsInput.model_validate({}))
    duration: Duration = Field(4.0, description="Length of the run.")
    start_pressure: Pressure = Field(0.0, description="Gauge pressure in the muscle at t = 0.")


@dataclass(frozen=True, slots=True)
class _OrPreset:
    """Also takes the id of a preset; not a union, so that errors name the fields alone."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """A text is an id, anything else a document."""
        return core_schema.no_info_wrap_validator_function(_document_or_id, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Either of both."""
        preset = {"type": "string", "pattern": _ID.pattern, "examples": ["paper-step"]}
        return {"anyOf": [handler(schema), preset]}


_ID = re.compile(r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$")


def _document_or_id(value: object, handler: ValidatorFunctionWrapHandler) -> Any:
    if not isinstance(value, str):
        return handler(value)
    if _ID.match(value) is None:
        raise InputError("cannot be the id of a drive preset", hint="e.g. 'paper-step'")
    return value


DriveOrId = Annotated[DriveDocument, _OrPreset()]
