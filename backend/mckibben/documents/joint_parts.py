"""What turns a joint, as parts of documents: muscles on paths, a spring, a link, its bearing, its stops."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from mckibben.documents.muscle import EffectsInput, Muscle
from mckibben.documents.quantity import Contraction, QuantityField
from mckibben.documents.strict import Strict
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

_TURN = 2.0 * np.pi

JointAngle = Annotated[float, QuantityField("rad", "30 deg", at_least=-_TURN, at_most=_TURN)]
Lever = Annotated[float, QuantityField("m", "30 mm", at_least=-10.0, at_most=10.0)]
Coordinate = Annotated[float, QuantityField("m", "200 mm", at_least=-10.0, at_most=10.0)]
PathLength = Annotated[float, QuantityField("m", "300 mm", above=0.0, at_most=100.0)]
Tendon = Annotated[float, QuantityField("m", "50 mm", at_least=0.0, at_most=100.0)]
LinkMass = Annotated[float, QuantityField("kg", "1.5 kg", at_least=0.0, at_most=1e5)]
Distance = Annotated[float, QuantityField("m", "200 mm", at_least=-100.0, at_most=100.0)]
TorsionStiffness = Annotated[float, QuantityField("N*m/rad", "5 N*m/rad", at_least=0.0, at_most=1e9)]
Inertia = Annotated[float, QuantityField("kg*m^2", "0.01 kg*m^2", at_least=0.0, at_most=1e6)]
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
    inertia: Inertia = Field(
        0.0, description="Moment of inertia of all that turns, about the axis; in a drive it is needed."
    )
    stops: JointStopsInput = Field(
        default_factory=lambda: JointStopsInput.model_validate({}), description="The stops."
    )


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


def joint_stops(document: JointInput) -> tuple[float, float]:
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
