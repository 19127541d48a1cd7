"""The joint document: muscles on paths about one axis, springs, a link, its bearing and its stops.

One form says what a muscle does to a joint: its path (`PathInput`). A pulley is a constant lever; today's
antagonist pair is two muscles with the levers +r and -r (`joint_of_drive`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import DEFAULT_PRECONTRACTION, named_document, stops_of
from mckibben.documents.kinds import kind_of, refuse_table
from mckibben.documents.located import at_file, located
from mckibben.documents.muscle import EffectsInput, Muscle
from mckibben.documents.problems import validated
from mckibben.documents.quantity import Contraction, QuantityField, Temperature
from mckibben.documents.start_model import StartModel, stated_muscle
from mckibben.documents.strict import Strict
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError, fields_inside
from mckibben.physics.muscle_path import (
    MusclePath,
    constant_lever,
    path_of_length,
    path_of_lever,
    path_of_table,
    quantity_or_formula,
    two_points,
)
from mckibben.physics.ops import Value
from mckibben.presets.reading import BadDocumentError, read_file
from mckibben.simulation.statics.joint import Joint, JointMuscle, weight_torque

_TURN = 2.0 * np.pi
_PAIR = ("first", "second")

JointAngle = Annotated[float, QuantityField("rad", "30 deg", at_least=-_TURN, at_most=_TURN)]
Lever = Annotated[float, QuantityField("m", "30 mm", at_least=-10.0, at_most=10.0)]
Coordinate = Annotated[float, QuantityField("m", "200 mm", at_least=-10.0, at_most=10.0)]
PathLength = Annotated[float, QuantityField("m", "300 mm", above=0.0, at_most=100.0)]
Tendon = Annotated[float, QuantityField("m", "50 mm", at_least=0.0, at_most=100.0)]
LinkMass = Annotated[float, QuantityField("kg", "1.5 kg", at_least=0.0, at_most=1e5)]
Distance = Annotated[float, QuantityField("m", "200 mm", at_least=-100.0, at_most=100.0)]
TorsionStiffness = Annotated[float, QuantityField("N*m/rad", "5 N*m/rad", at_least=0.0, at_most=1e9)]
FrictionTorque = Annotated[float, QuantityField("N*m", "0.2 N*m", at_least=0.0, at_most=1e6)]
Formula = Annotated[
    float | Annotated[str, Field(min_length=1, max_length=500)],
    Field(description="A quantity, or a formula of the angle in rad that gives m."),
]


class PointsInput(Strict):
    """Two attachment points in the plane of the motion, seen from the pivot."""

    origin: Annotated[list[Coordinate], Field(min_length=2, max_length=2)] = Field(
        description="x and y on the frame.", examples=[["0 mm", "300 mm"]]
    )
    insertion: Annotated[list[Coordinate], Field(min_length=2, max_length=2)] = Field(
        description="x and y on the link at the angle 0; the angle turns it from x to y.",
        examples=[["40 mm", "0 mm"]],
    )


class PathTableInput(Strict):
    """Rows of a measured path."""

    angle: Annotated[list[JointAngle], Field(min_length=2, max_length=2000)] = Field(
        description="Angles of the joint."
    )
    lever: Annotated[list[Lever], Field(min_length=2, max_length=2000)] | None = Field(
        None, description="Lever at each angle."
    )
    length: Annotated[list[PathLength], Field(min_length=2, max_length=2000)] | None = Field(
        None, description="Length of the muscle at each angle."
    )


class PathInput(Strict):
    """How a muscle runs along a joint: by its lever, its length, two points or a table.

    Lever and length obey virtual work, lever = -dL/d angle: the lever is positive where the muscle turns the
    joint to greater angles.
    """

    lever: Formula | None = Field(
        None,
        description="Lever: constant, or a formula of the angle in rad that gives m (a cam).",
        examples=["30 mm", "0.03 - 0.005*angle**2"],
    )
    length: Formula | None = Field(
        None,
        description="With a lever the length of the muscle at the angle 0. Default: its rest length. Without "
        "one a formula of the angle, whose derivative is the lever.",
        examples=["300 mm", "0.3 - 0.03*angle"],
    )
    contraction: Contraction | None = Field(
        None, description="With a lever the contraction of the muscle at the angle 0, instead of its length."
    )
    points: PointsInput | None = Field(None, description="Two attachment points.")
    tendon: Tendon = Field(
        0.0, description="Length of cord and fittings between the points that is not muscle."
    )
    table: PathTableInput | None = Field(None, description="Lever or length over the angle, or both.")
    sense: Literal["positive", "negative"] = Field(
        "positive", description="Negative: a lever or table counts for the muscle on the other side."
    )


class JointMuscleInput(Strict):
    """One muscle of a joint."""

    name: Annotated[str, Field(max_length=40)] = Field("", description="Its name, e.g. flexor.")
    muscle: Muscle | None = Field(None, description="The muscle; null: that of the document.")
    effects: EffectsInput | None = Field(
        None, description="The effects of its model; null: those of the document or of its preset."
    )
    path: PathInput = Field(description="The path along the joint.")


class TorsionSpringInput(Strict):
    """A spring about the axis."""

    stiffness: TorsionStiffness = Field(description="Its stiffness.")
    relaxed_at: JointAngle = Field(0.0, description="Angle without torque.")


class LinkInput(Strict):
    """The weight of what turns."""

    mass: LinkMass = Field(description="Its mass.")
    centre: Distance = Field(description="Distance of its centre of mass from the axis.")
    level_at: JointAngle = Field(
        0.0, description="Angle of the joint at which it is level; greater angles lift it."
    )


class JointStopsInput(Strict):
    """Where the joint stops."""

    min_angle: JointAngle | None = Field(None, description="Default: where a table of a path begins.")
    max_angle: JointAngle | None = Field(None, description="Default: where a table of a path ends.")


class JointInput(Strict):
    """Muscles about one axis, and what else turns it."""

    muscles: Annotated[list[JointMuscleInput], Field(min_length=1, max_length=8)] = Field(
        description="The muscles."
    )
    spring: TorsionSpringInput | None = Field(None, description="A torsion spring; null: there is none.")
    link: LinkInput | None = Field(None, description="The link, by its weight; null: it weighs nothing.")
    friction: FrictionTorque = Field(0.0, description="Torque of the bearing against the motion.")
    stops: JointStopsInput = Field(
        default_factory=lambda: JointStopsInput.model_validate({}), description="The stops."
    )


class JointDocument(JointInput):
    """A joint by itself, for its statics and for measurements of torque over angle."""

    schema_version: Literal[1] = Field(1, alias="schema", description="Version of the document.")
    kind: Literal["joint"] = Field("joint", description="The word 'joint'.")
    title: Annotated[str, Field(max_length=200)] = Field("", description="Title for display.")
    muscle: Muscle | None = Field(None, description="The muscle of all that state no own one.")
    effects: EffectsInput | None = Field(None, description="The effects of its model; null: of the preset.")
    temperature: Temperature = Field(293.15, description="Temperature of the muscles.")


@dataclass(frozen=True)
class StatedJoint:
    """A joint of a document.

    Attributes:
        joint: in SI.
        starts: the muscles with their effects, in their order.
        title: of the document.
        notes: what has to be said of it: disagreements of lengths and levers.
    """

    joint: Joint
    starts: tuple[StartModel, ...]
    title: str
    notes: tuple[str, ...]


def joint_of(document: JointDocument, studio: Studio) -> StatedJoint:
    """The joint of a document.

    Raises:
        InputError: an unknown preset or effect, a path that cannot be, stops that are missing or beyond it;
            ``field`` is the path in the document.
    """
    low, high = _stops(document)
    muscles, starts, notes = [], [], []
    for place, stated in enumerate(document.muscles):
        where = f"muscles.{place}"
        name = stated.name or f"muscle {place + 1}"
        muscle = stated.muscle or document.muscle
        if muscle is None:
            raise InputError(
                f"{where}.muscle is missing", field=f"{where}.muscle", hint="e.g. 'DMSP-20:300mm'"
            )
        shared = document.effects if stated.muscle is None else None
        effects = shared if stated.effects is None else stated.effects
        with fields_inside(where):
            start = studio.start_model(stated_muscle(muscle), effects)
            model = studio.slow_model(start)
            rest = float(start.muscle.nominal_length)
            path = path_of(stated.path, rest_length=rest, low=low, high=high)
        if path.disagreement is not None and path.disagreement.rms > 1e-9:
            notes.append(f"{name}: {path.disagreement.sentence}")
        muscles.append(JointMuscle(name, model, path))
        starts.append(start)
    spring, link = document.spring, document.link
    joint = Joint(
        tuple(muscles),
        low,
        high,
        spring=0.0 if spring is None else spring.stiffness,
        spring_rest=0.0 if spring is None else spring.relaxed_at,
        weight=0.0 if link is None else weight_torque(mass=link.mass, centre=link.centre),
        level_at=0.0 if link is None else link.level_at,
        friction=document.friction,
        temperature=document.temperature,
    )
    return StatedJoint(joint, tuple(starts), document.title, tuple(notes))


def path_of(stated: PathInput, *, rest_length: float, low: float, high: float) -> MusclePath:
    """The path of an input, checked between two angles [rad].

    Raises:
        InputError: it is stated in no way or in two, or cannot be; ``field`` begins with "path".
    """
    with fields_inside("path"):
        ways = {
            "points": stated.points is not None,
            "table": stated.table is not None,
            "lever": stated.lever is not None,
            "length": stated.length is not None and stated.lever is None and stated.table is None,
        }
        given = [name for name, there in ways.items() if there]
        if len(given) != 1:
            said = "no way" if not given else " and ".join(given)
            raise InputError(
                f"a path is stated by {said}; it is stated by one of lever, length, points, table",
                field=given[-1] if given else None,
                hint='e.g. "path": {"lever": "30 mm"}',
            )
        if stated.tendon and stated.points is None:
            raise InputError(
                "only a path between two points has a tendon", field="tendon", hint="leave it out"
            )
        if stated.contraction is not None:
            if stated.length is not None or (stated.table is not None and stated.table.length is not None):
                raise InputError(
                    "give the length or the contraction", field="contraction", hint="leave one out"
                )
            if stated.lever is None and stated.table is None:
                raise InputError(
                    "points and formulas of the length say the contraction themselves",
                    field="contraction",
                    hint="leave it out",
                )
            rest_length *= 1.0 - stated.contraction
        path = _path(stated, rest_length, low, high)
        if stated.sense == "negative":
            if stated.lever is None and (stated.table is None or stated.table.length is not None):
                raise InputError(
                    "lengths and points have their own sense", field="sense", hint="leave it out"
                )
            path = path.reversed()
        return path.checked(low, high)


def _path(stated: PathInput, rest_length: float, low: float, high: float) -> MusclePath:
    if stated.points is not None:
        origin, insertion = stated.points.origin, stated.points.insertion
        return two_points(
            origin=(origin[0], origin[1]), insertion=(insertion[0], insertion[1]), tendon=stated.tendon
        )
    if stated.table is not None:
        return _table(stated, rest_length)
    if stated.lever is None:
        length = quantity_or_formula(value=stated.length, field="length")
        if not callable(length):
            raise InputError(
                "a constant length has no lever", field="length", hint="a formula, e.g. '0.3 - 0.03*angle'"
            )
        return path_of_length(length=length, low=low, high=high)
    at_zero = rest_length
    if stated.length is not None:
        at_zero = quantity_or_formula(value=stated.length, field="length")
        if callable(at_zero):
            raise InputError(
                "with a lever the length is that at the angle 0", field="length", hint="e.g. '300 mm'"
            )
    lever = quantity_or_formula(value=stated.lever, field="lever")
    if callable(lever):
        return path_of_lever(lever=lever, length=at_zero, low=min(low, 0.0), high=max(high, 0.0))
    return constant_lever(lever=lever, length=at_zero)


def _table(stated: PathInput, rest_length: float) -> MusclePath:
    table = stated.table
    assert table is not None  # noqa: S101 - asked by its caller
    columns: dict[str, np.ndarray | None] = {}
    for name in ("lever", "length"):
        values: Sequence[float] | None = getattr(table, name)
        if values is not None and len(values) != len(table.angle):
            raise InputError(
                f"{len(table.angle)} angles and {len(values)} {name}s are no table", field=f"table.{name}"
            )
        columns[name] = None if values is None else np.array(values)
    at_zero: float | Callable[[Value], Value] = rest_length
    if stated.length is not None:
        at_zero = quantity_or_formula(value=stated.length, field="length")
        if callable(at_zero) or table.length is not None:
            raise InputError(
                "a table with lengths has no length at the angle 0"
                if table.length is not None
                else "with levers the length is that at the angle 0",
                field="length",
                hint="leave it out" if table.length is not None else "e.g. '300 mm'",
            )
    return path_of_table(
        angle=np.array(table.angle), lever=columns["lever"], length=columns["length"], length_at_zero=at_zero
    )


def _stops(document: JointInput) -> tuple[float, float]:
    """Angles between which the joint turns: the stated ones, else what the tables of its paths hold."""
    tables = [m.path.table.angle for m in document.muscles if m.path.table is not None]
    ends = {
        "min_angle": (document.stops.min_angle, [min(angles) for angles in tables], max),
        "max_angle": (document.stops.max_angle, [max(angles) for angles in tables], min),
    }
    found = []
    for name, (stated, known, of) in ends.items():
        if stated is None and not known:
            raise InputError(
                f"stops.{name} is missing",
                field=f"stops.{name}",
                hint="e.g. '-60 deg'; a table says it itself",
            )
        found.append(of(known) if stated is None else stated)
    low, high = found
    if not low < high:
        raise InputError(
            f"the stops are in the wrong order: {np.degrees(high):.4g} deg is not above "
            f"{np.degrees(low):.4g} deg",
            field="stops.max_angle",
        )
    return low, high


def joint_of_drive(document: DriveDocument, studio: Studio) -> JointDocument:
    """The joint document of an antagonist pair on a pulley.

    Raises:
        InputError: the drive has no joint.
    """
    load = document.load
    if load.arrangement != "antagonist" or load.pulley_radius is None:
        raise InputError(
            "this drive has no joint: its load moves along a line",
            field="load.arrangement",
            hint="an antagonist pair, or a joint document",
        )
    middle = DEFAULT_PRECONTRACTION if load.precontraction is None else load.precontraction
    start = studio.start_model(stated_muscle(document.muscle), document.effects)
    lowest, highest = stops_of(document, studio.static_model(start))
    turn = float(start.muscle.nominal_length) / load.pulley_radius
    return read_joint(
        {
            "title": document.title,
            "muscle": document.muscle.to_document(),
            "effects": document.effects,
            "muscles": [
                {"name": name, "path": {"lever": sense * load.pulley_radius, "contraction": middle}}
                for name, sense in zip(_PAIR, (1.0, -1.0), strict=True)
            ],
            "stops": {"min_angle": (lowest - middle) * turn, "max_angle": (highest - middle) * turn},
            "temperature": document.gas.temperature,
        }
    )


def read_joint(document: object, subject: str = "the joint") -> JointDocument:
    """A joint document from JSON.

    Raises:
        InputError: it is not valid; ``field`` is the path in it.
    """
    return validated(JointDocument, document, subject)


def named_joint(name: str, studio: Studio) -> JointDocument:
    """The joint of a file, or that of the drive of a file or preset.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    path = Path(name)
    if not (path.exists() or name.lower().endswith(".json")):
        return joint_of_drive(named_document(name, studio), studio)
    refuse_table(name, "joint")
    try:
        content: Any = read_file(path, follow_links=True)
        if isinstance(content, Mapping) and kind_of(content) == "drive":
            return joint_of_drive(named_document(name, studio), studio)
        return read_joint(content)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{name}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        raise at_file(name, error.field, error.message, error.hint) from error
