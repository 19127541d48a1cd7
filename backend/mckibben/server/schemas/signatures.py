"""Request and answer of ``/api/signatures``: what an effect leaves in the residual of each kind of test."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.muscle import MuscleInput
from mckibben.documents.quantity import PositivePressure
from mckibben.documents.strict import Strict


class SignatureRequest(Strict):
    """An effect on a muscle."""

    muscle: MuscleInput = Field(description="The muscle.")
    effect: str = Field(description="Id of the effect.")
    values: dict[str, float] = Field(
        default_factory=dict, description="Its parameters in SI; missing ones take their usual size."
    )
    pressure: PositivePressure | None = Field(
        None, description="Largest gauge pressure of the tests; null: the muscle's limit, else 6 bar."
    )


class SignatureCurveAnswer(Strict):
    """The residual of one run, in the order of its motion."""

    level: float | None = Field(description="What the rig held: pressure, length or load; null in a drive.")
    x: list[float] = Field(description="What moved.")
    y: list[float] = Field(description="The residual: with the effect minus without it.")


class SignaturePictureAnswer(Strict):
    """What the effect leaves in one kind of test; SI."""

    kind: str = Field(description="Kind of the test.", examples=["isobaric"])
    quantity: str = Field(description="What is predicted: force, length, diameter, stroke or pressure.")
    unit: str = Field(description="Its SI unit.")
    x: str = Field(description="What moves: contraction, pressure or time.")
    x_unit: str = Field(description="Its SI unit.")
    held: str = Field(description="What the rig holds in each run; empty in a drive.")
    held_unit: str = Field(description="Its SI unit.")
    curves: list[SignatureCurveAnswer] = Field(description="One for each run.")
    rms: float = Field(description="Root mean square of the residual.")


class SignatureAnswer(Strict):
    """The pictures of an effect, each computed by the model of the muscle with and without it."""

    effect: str = Field(description="Id of the effect.")
    values: dict[str, float] = Field(description="All its parameters in SI.")
    pictures: list[SignaturePictureAnswer] = Field(description="One for each kind of test that shows it.")
    hidden: list[str] = Field(description="Kinds it names, but whose prediction does not contain it.")
    acts_on: list[str] = Field(description="Effects in both models, because it only changes what they do.")
    temperature: float = Field(description="Temperature of the tests [K].")
    pressure: float = Field(description="Largest gauge pressure of the tests [Pa].")
