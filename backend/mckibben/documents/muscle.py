"""A muscle in a request: a preset, possibly with changes, or one of three forms of geometry."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mckibben.documents.quantity import Angle, Diameter, Length, Thickness, Turns
from mckibben.documents.shorthand import MUSCLE_TEXT
from mckibben.documents.strict import Id, Name, Strict


class RhombusInput(Strict):
    """The lattice of the braid: side of the rhombi, and their numbers along and around the muscle."""

    side: Length = Field(description="Side of one rhombus.")
    along: Turns = Field(description="Rhombi along the muscle.", examples=[60])
    around: Turns = Field(description="Rhombi around the muscle.", examples=[20])


class MuscleInput(Strict):
    """A preset id, or a length with exactly one of: diameter and angle, thread length and turns, rhombus.

    With a preset, the stated fields override its values.
    """

    preset: Id | None = Field(None, description="Id of a muscle preset; null: the geometry is stated.")
    nominal_length: Length | None = Field(None, description="Length between the fittings at rest.")
    inside_diameter: Diameter | None = Field(None, description="Bore at rest.")
    braid_diameter: Diameter | None = Field(
        None, description="Diameter of the braid at the braid angle. Default: the inside diameter."
    )
    braid_angle: Angle | None = Field(None, description="Angle between thread and muscle axis at rest.")
    wall_thickness: Thickness | None = Field(None, description="Wall of the bladder at rest.")
    thread_length: Length | None = Field(None, description="Length of one thread of the braid.")
    turns: Turns | None = Field(None, description="Turns a thread makes around the muscle.")
    rhombus: RhombusInput | None = Field(
        None, description="The lattice of the braid, instead of diameter and angle."
    )


#: A muscle, or its preset and length as a text, "DMSP-20:300mm".
Muscle = Annotated[MuscleInput, MUSCLE_TEXT]

ParameterValue = Annotated[
    float | Annotated[str, Field(min_length=1, max_length=500)],
    Field(
        description="A number in SI units or a text with a unit; the term of a custom effect.",
        examples=["0.47 MPa"],
    ),
]
EffectsInput = Annotated[
    dict[Name, dict[Name, ParameterValue]],
    Field(
        max_length=64,
        description="Effect id -> its parameters; missing parameters take their defaults. {} is the ideal "
        "model; null means the effects of the preset (the ideal model for a muscle given by geometry).",
        examples=[{}],
    ),
]
