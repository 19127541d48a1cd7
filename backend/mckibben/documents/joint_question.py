"""A question about a joint at rest as a document, the same in a request, in options and in Python."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from mckibben.documents.joint_parts import JointAngle
from mckibben.documents.problems import validated
from mckibben.documents.quantity import PositivePressure, Pressure, QuantityField
from mckibben.documents.shorthand import LIST_TEXT
from mckibben.documents.strict import Strict
from mckibben.physics.errors import InputError

Torque = Annotated[float, QuantityField("N*m", "5 N*m", at_least=-1e6, at_most=1e6)]
JointStiffness = Annotated[float, QuantityField("N*m/rad", "20 N*m/rad", at_least=-1e9, at_most=1e9)]
PressureSet = Annotated[list[Pressure], Field(min_length=1, max_length=8), LIST_TEXT]


class JointQuestionInput(Strict):
    """What is asked of a joint at rest."""

    pressures: Annotated[list[PressureSet], Field(min_length=1, max_length=12)] | None = Field(
        None,
        description="Sets of gauge pressures, one pressure for each muscle in a set. Default: 1 to 6 bar in "
        "the first muscle, with 6 to 1 bar in the second and 3 bar in others.",
        examples=[[["4 bar", "2 bar"]]],
    )
    points: int = Field(121, ge=2, le=1001, description="Angles between the stops.")
    direction: Literal[-1, 0, 1] = Field(
        0, description="Sign of the motion of the joint, for friction; 0: none."
    )
    torque: Torque = Field(0.0, description="External torque on the joint, positive to greater angles.")
    highest_pressure: PositivePressure = Field(
        6e5, description="Highest gauge pressure that the muscles can be given."
    )
    angle: JointAngle | None = Field(None, description="Angle at which the joint is to rest.")
    stiffness: JointStiffness | None = Field(
        None, description="Stiffness that it is to have there with the valves open; null: the least."
    )


def read_joint_question(document: Mapping[str, object]) -> JointQuestionInput:
    """The question of fields; those that are None are not stated.

    Raises:
        InputError: what is wrong, with ``field`` the name of the field.
    """
    stated = {name: value for name, value in document.items() if value is not None}
    found = validated(JointQuestionInput, stated, "the question")
    if found.stiffness is not None and found.angle is None:
        raise InputError("a stiffness is had at an angle", field="angle", hint="e.g. '10 deg'")
    return found
