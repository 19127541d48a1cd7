"""The experiment that a measurement belongs to: what it was made with, each value with its origin.

Fields of an experiment, as the command line, requests and answers name them:

| field | value | needed for |
|---|---|---|
| `muscle` | id of a preset | everything |
| `rest_length` | length of the muscle without air and load [m] | everything |
| `load` | a mass [kg] or a force [N] | isotonic without force column, transient |
| `supply` | supply pressure, gauge [Pa] | transient with a command column |
| `valve`, `tube` | ids of presets; a tube also "4 mm x 1 m" or "none" | transient with a command column |
| `stops` | contractions between which the load can move, "0 % to 25 %" | transient |
| `inclination` | of the motion of the load from the horizontal [rad] | transient |
| `lever` | "30 mm", or a formula of the angle in rad that gives m | torque over angle |
| `contraction_at_zero` | contraction of the muscle at the angle 0; of both of a pair | torque over angle |
| `fixed_end` | which end of the muscle is fixed | |
| `force_zero`, `pressure_zero` | reading of the sensor at true zero [N, Pa]; subtracted | |
| `accuracy_*` | standard deviation of a channel, in its unit or as a share of its largest value | |
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from math import pi, sin
from types import MappingProxyType
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.result import result_class
from mckibben.measurement.accuracy import CHANNELS as ACCURACIES
from mckibben.measurement.accuracy import SENSORS, read_accuracy
from mckibben.measurement.kind import STROKES
from mckibben.measurement.measurement import CHANNEL_UNITS, MeasuredChannel, Measurement, StatedValue
from mckibben.physics.errors import InputError
from mckibben.physics.muscle_path import MusclePath, path_on_lever
from mckibben.physics.units import GRAVITY

#: Who says a value: the file, the user, a preset that was chosen, a proposal that the user took over, nobody.
Origin = Literal["file", "you", "preset", "suggested", "assumed"]

_ZEROS = {"force_zero": "force", "pressure_zero": "pressure"}


@result_class
class ExperimentValue:
    """One value of an experiment."""

    CORRECTING: ClassVar = ("where",)

    value: float | str
    """In SI, or a text."""
    unit: str
    """SI unit; "" of a text, "1" of a share."""
    origin: Origin
    """The file, the user (you), a preset that was chosen, a proposal that the user took over (suggested), or
    nobody (assumed).
    """
    where: str = ""
    """Line or cell of the file, option or field of the request, preset; "" where there is no place."""


#: Field -> value; fields that nobody stated and that have no sensible value are missing.
Experiment = Mapping[str, ExperimentValue]


@dataclass(frozen=True, slots=True)
class ExperimentField:
    """Declaration of a field, for forms and messages.

    Attributes:
        name: key in requests and answers.
        title: in words.
        unit: SI unit, "" of a text; of a load, that of a mass.
        units: units that a form offers.
        question: asked where nobody says it.
        why: what it is needed for.
        example: a value.
        least, most: allowed SI values.
        choices, closed: texts to choose from, and whether others are refused.
    """

    name: str
    title: str
    unit: str
    units: tuple[str, ...]
    question: str
    why: str
    example: str
    least: float | None = None
    most: float | None = None
    choices: tuple[str, ...] = ()
    closed: bool = False

    @property
    def option(self) -> str:
        """What says it on the command line."""
        own = {"muscle": "--muscle", "rest_length": "--rest-length", "load": "--load", "supply": "--supply"}
        if self.name in own:
            return f'{own[self.name]} "{self.example}"'
        if self.name.startswith(ACCURACY):
            return f'--accuracy "{self.name.removeprefix(ACCURACY)} {self.example}"'
        return f'--experiment "{self.name}={self.example}"'


#: Begin of the fields for the accuracy of a channel.
ACCURACY = "accuracy_"


def _accuracy(channel: str) -> ExperimentField:
    unit, units, example = {
        "length": ("m", ("mm", "%"), "1 mm"),
        "force": ("N", ("N", "%"), "0.5 %"),
        "pressure": ("Pa", ("mbar", "bar", "%"), "20 mbar"),
        "diameter": ("m", ("mm", "%"), "0.1 mm"),
    }[channel]
    return ExperimentField(
        f"{ACCURACY}{channel}",
        f"Accuracy of the {channel}",
        unit,
        units,
        f"How accurate is the {channel} (standard deviation, or % of the largest value)?",
        "an error within it does not point to a missing effect",
        example,
        0.0,
        None,
        tuple(name for name, sensor in SENSORS.items() if sensor.channel == channel),
    )


FIELDS: Mapping[str, ExperimentField] = MappingProxyType(
    {
        field.name: field
        for field in (
            ExperimentField(
                "muscle", "Muscle", "", (), "Which muscle is it?",
                "its geometry decides force and stroke", "DMSP-20",
            ),
            ExperimentField(
                "rest_length", "Rest length", "m", ("mm", "m", "cm", "in"),
                "How long is the muscle without air and load, between its fittings?",
                "contraction is measured from it", "300 mm", 1e-3, 50.0,
            ),
            ExperimentField(
                "load", "Load", "kg", ("kg", "N"), "Which mass or force does the muscle carry?",
                "the load decides how far the muscle shortens", "6 kg", 0.0, 1e5,
            ),
            ExperimentField(
                "supply", "Supply pressure", "Pa", ("bar", "kPa", "MPa", "psi"),
                "Which pressure feeds the valve?", "the valve fills the muscle from it", "6 bar", 1.0, 1e8,
            ),
            ExperimentField(
                "valve", "Valve", "", (), "Which valve fills and vents the muscle?",
                "its flow decides how fast the pressure follows the command", "MPYE-5-1/8-HF",
            ),
            ExperimentField(
                "tube", "Tube", "", (), "Which tube is between valve and muscle?",
                "it delays and slows the flow", "4 mm x 1 m", None, None, ("none",),
            ),
            ExperimentField(
                "stops", "End stops", "", (), "Between which contractions can the load move?",
                "a load rests on its stops", "0 % to 25 %",
            ),
            ExperimentField(
                "inclination", "Inclination", "rad", ("deg",),
                "At which angle to the horizontal does the load move?", "only its weight along it counts",
                "90 deg", -pi / 2.0, pi / 2.0,
            ),
            ExperimentField(
                "lever", "Lever", "", (), "At which lever does the muscle pull at the joint?",
                "length and force of the muscle follow from angle and torque by it",
                "30 mm", None, None, ("0.03 - 0.005*angle**2",),
            ),
            ExperimentField(
                "contraction_at_zero", "Contraction at the angle 0", "1", ("%",),
                "How far is the muscle contracted at the angle 0?", "its length is counted from there",
                "10 %", -0.2, 0.4,
            ),
            ExperimentField(
                "fixed_end", "Fixed end", "", (), "Which end of the muscle is fixed?",
                "it is recorded; no figure depends on it", "upper", None, None, ("upper", "lower", "both"),
                True,
            ),
            ExperimentField(
                "force_zero", "Zero of the force sensor", "N", ("N", "kN"),
                "What does the force sensor show without force?", "it is subtracted", "2.5 N", -1e6, 1e6,
            ),
            ExperimentField(
                "pressure_zero", "Zero of the pressure sensor", "Pa", ("mbar", "bar", "kPa"),
                "What does the pressure sensor show at atmospheric pressure?", "it is subtracted",
                "20 mbar", -1e7, 1e7,
            ),
            *(_accuracy(channel) for channel in ACCURACIES),
        )
    }
)  # fmt: skip

#: Condition of a file -> field of the experiment.
_OF_CONDITIONS = {
    "nominal_length": "rest_length", "load_mass": "load", "load_force": "load", "supply_pressure": "supply",
    "muscle": "muscle", "valve": "valve", "tube": "tube", "stops": "stops", "inclination": "inclination",
    "fixed_end": "fixed_end", "lever": "lever",
    "contraction_at_zero": "contraction_at_zero", "force_zero": "force_zero",
    "pressure_zero": "pressure_zero",
}  # fmt: skip


def needed(kind: str | None, channels: Collection[str]) -> tuple[str, ...]:
    """Fields without which a test of this kind cannot be compared, or only on an assumption.

    Args:
        kind: of the measurement; None while it is not known.
        channels: that were measured.
    """
    fields = ["muscle", "rest_length"]
    commanded = kind == "transient" and "command" in channels
    if kind == "transient" or (kind == "isotonic" and "force" not in channels):
        fields.append("load")
    fields += ["lever"] if _by_angle(channels) else []
    return (*fields, *(("supply", "valve") if commanded else ()))


def mattering(kind: str | None, channels: Collection[str]) -> tuple[str, ...]:
    """All fields that matter for a test of this kind, those that it needs among them."""
    also = {
        "load": kind in ("transient", "isotonic") and not (kind == "isotonic" and "force" in channels),
        "supply": "command" in channels,
        "valve": "command" in channels,
        "tube": "command" in channels,
        "stops": kind == "transient",
        "lever": _by_angle(channels),
        "contraction_at_zero": _by_angle(channels),
        "inclination": kind in ("transient", "isotonic"),
        "force_zero": "force" in channels,
        "pressure_zero": "pressure" in channels,
        **{f"{ACCURACY}{channel}": _measured(channel, channels) for channel in ACCURACIES},
    }
    return tuple(name for name in FIELDS if also.get(name, True))


def _by_angle(channels: Collection[str]) -> bool:
    """Whether length and force of the muscle follow from the angle of a joint and its torque alone."""
    return {"angle", "torque"} <= set(channels) and "force" not in channels


def _measured(channel: str, channels: Collection[str]) -> bool:
    return channel in channels or (channel == "length" and any(name in channels for name in STROKES))


#: Field of a force that acts in addition to the mass in "load".
LOAD_FORCE = "load_force"


def file_experiment(stated: Iterable[StatedValue]) -> dict[str, ExperimentValue]:
    """What the conditions of a measurement say about its experiment.

    A force beside a mass is `LOAD_FORCE`; an accuracy is one field per channel.
    """
    found: dict[str, ExperimentValue] = {}
    for condition in stated:
        origin: Origin = "you" if condition.origin == "you" else "file"
        if condition.key == "accuracy":
            found |= accuracy_values(str(condition.value), origin, condition.where)
            continue
        name = _OF_CONDITIONS.get(condition.key)
        if name is None:
            continue
        unit = "N" if condition.key == "load_force" else FIELDS[name].unit
        value = ExperimentValue(condition.value, unit, origin, condition.where)
        if name == "load" and "load" in found:  # a mass and a force
            mass, force = sorted((found["load"], value), key=lambda each: each.unit != "kg")
            found |= {"load": mass, LOAD_FORCE: force}
        else:
            found[name] = value
    return found


def accuracy_values(text: str, origin: Origin, where: str) -> dict[str, ExperimentValue]:
    """The fields of an accuracy in words.

    Raises:
        InputError: a channel, quantity or sensor that is not known.
    """
    return {
        f"{ACCURACY}{channel}": ExperimentValue(
            accuracy.value, accuracy.unit, origin, where or accuracy.sensor
        )
        for channel, accuracy in read_accuracy(text).items()
    }


#: Origin -> in words, for tables.
ORIGIN_WORDS: Mapping[Origin, str] = MappingProxyType(
    {
        "file": "the file", "you": "stated", "preset": "preset", "suggested": "suggestion accepted",
        "assumed": "assumed",
    }
)  # fmt: skip
_SHOWN = {"m": (1e3, "mm"), "rad": (180.0 / pi, "deg")}


def shown_value(name: str, value: ExperimentValue) -> str:
    """A value for people: ``300 mm``, ``6 bar``, ``0.5 % of the largest value``."""
    if isinstance(value.value, str):
        return value.value
    if value.unit == "1":
        return f"{100.0 * value.value:.3g} %{' of the largest value' if name.startswith(ACCURACY) else ''}"
    scale, unit = _SHOWN.get(value.unit, (1.0, value.unit))
    if value.unit == "Pa":
        scale, unit = (1e-5, "bar") if name == "supply" else (1e-2, "mbar")
    return f"{scale * value.value:.4g} {unit}"


def title_of(name: str) -> str:
    """A field in words."""
    return "Further force" if name == LOAD_FORCE else FIELDS[name].title


def place_of(value: ExperimentValue) -> str:
    """Who says a value and where: ``the file (line 4)``."""
    words = ORIGIN_WORDS[value.origin]
    return f"{words} ({value.where})" if value.where else words


def corrected(measurement: Measurement, values: Mapping[str, ExperimentValue]) -> Measurement:
    """The measurement with the zeros subtracted and the stated conditions.

    A mass that moves along an incline in an isotonic test counts with its share of weight along it.
    """
    columns: dict[str, NDArray] = {}
    for name, channel in _ZEROS.items():
        if name in values and channel in measurement.columns and float(values[name].value) != 0.0:
            shifted = measurement.columns[channel] - float(values[name].value)
            shifted.flags.writeable = False
            columns[channel] = shifted
    conditions = _conditions(measurement, values)
    if "lever" in values and _by_angle(measurement.columns):
        columns |= _along_path(measurement, values, conditions)
    if not columns and conditions == dict(measurement.conditions):
        return measurement
    known = {channel.name for channel in measurement.channels}
    channels = tuple(
        channel._replace(minimum=float(np.min(values)), maximum=float(np.max(values)))
        if (values := columns.get(channel.name)) is not None
        else channel
        for channel in (
            *measurement.channels,
            *(
                MeasuredChannel(name, FROM_PATH, CHANNEL_UNITS[name], 0.0, 0.0, CHANNEL_UNITS[name])
                for name in columns
                if name not in known
            ),
        )
    )
    return replace(
        measurement,
        columns=MappingProxyType({**measurement.columns, **columns}),
        channels=channels,
        conditions=MappingProxyType(conditions),
    )


#: Origin of a channel that follows from the angle of a joint.
FROM_PATH = "the path of the muscle"


def _along_path(
    measurement: Measurement, values: Mapping[str, ExperimentValue], conditions: dict[str, float | str]
) -> dict[str, NDArray]:
    """Length, lever and force of the (first) muscle of a joint, from angle and torque.

    The force is what the first muscle alone would pull; of a pair it only stands for the torque. The path is
    kept among the conditions.

    Raises:
        InputError: a lever that cannot be, or that vanishes at an angle of the rows.
    """
    length = float(values["rest_length"].value)
    contraction = float(values["contraction_at_zero"].value) if "contraction_at_zero" in values else 0.0
    conditions |= {LEVER: str(values["lever"].value), LENGTH_AT_ZERO: length * (1.0 - contraction)}
    path = path_of_joint(conditions, measurement.columns["angle"])
    assert path is not None  # noqa: S101 - just stated
    angle = measurement.columns["angle"]
    lever = np.broadcast_to(np.asarray(path.lever(angle), float), angle.shape).copy()
    found = {
        "length": np.asarray(path.length(angle), float),
        "lever": lever,
        "force": measurement.columns["torque"] / np.where(np.abs(lever) < _NO_LEVER, np.nan, lever),
    }
    if not np.all(np.isfinite(found["force"])):
        place = int(np.argmin(np.isfinite(found["force"])))
        raise InputError(
            f"the lever vanishes at {np.degrees(angle[place]):.4g} deg, where a torque was measured",
            field="lever",
            hint="another lever, or leave these rows out",
        )
    for values_of in found.values():
        values_of.flags.writeable = False
    return found


_NO_LEVER = 1e-6  # m
#: Conditions that hold the path of a muscle along a joint: lever as a text, length at the angle 0 [m].
LEVER, LENGTH_AT_ZERO = "lever", "length_at_zero"


def path_of_joint(conditions: Mapping[str, float | str], angle: NDArray) -> MusclePath | None:
    """The stated path of the (first) muscle of a joint over the measured angles; None where none is stated.

    Raises:
        InputError: a lever that cannot be.
    """
    if LENGTH_AT_ZERO not in conditions:
        return None
    return path_on_lever(
        lever=str(conditions[LEVER]),
        length=float(conditions[LENGTH_AT_ZERO]),
        low=float(np.min(angle)),
        high=float(np.max(angle)),
    )


def _conditions(measurement: Measurement, values: Mapping[str, ExperimentValue]) -> dict[str, float | str]:
    conditions = dict(measurement.conditions)
    loads = [values[name] for name in ("load", LOAD_FORCE) if name in values]
    if loads and any(load.origin != "assumed" and load.where != FROM_DRIVE for load in loads):
        conditions.pop("load_mass", None)
        conditions.pop("load_force", None)
        for load in loads:
            conditions["load_mass" if load.unit == "kg" else "load_force"] = float(load.value)
    inclination = values.get("inclination")
    if measurement.kind == "isotonic" and inclination is not None and "load_mass" in conditions:
        weight = float(conditions.pop("load_mass")) * GRAVITY * sin(float(inclination.value))
        conditions["load_force"] = float(conditions.get("load_force", 0.0)) + weight
    supply = values.get("supply")
    if supply is not None and supply.origin != "assumed" and supply.where != FROM_DRIVE:
        conditions["supply_pressure"] = float(supply.value)
    return conditions


#: Place of a value of the drive document, which the drive already has.
FROM_DRIVE = "the drive document"
