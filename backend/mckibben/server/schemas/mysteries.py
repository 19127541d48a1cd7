"""Answers of ``/api/mysteries``: measurements with hidden effects, and the solutions."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from mckibben.documents.strict import Name, Strict
from mckibben.server.schemas.comparisons import EffectsJson


class Mystery(Strict):
    """A measurement to practise on; without the solution."""

    id: str = Field(examples=["two-lines-per-pressure"], description="Its id.")
    title: str = Field(description="Its name.")
    story: str = Field(description="The situation, as an engineer would describe it.")
    kind: str = Field(description="Measurement kind.")
    muscle: dict[str, Any] = Field(description="In the form of a comparison request.")
    drive: dict[str, Any] | None = Field(
        description="In the form of a comparison request; null if not needed."
    )
    effects: EffectsJson = Field(description="The start model.")
    measurement: str = Field(description="Id of the measurement for comparisons and diagnoses.")


class RevealRequest(Strict):
    """The user's diagnosis."""

    effects: list[Name] = Field(
        default=[], max_length=64, description="Ids of the effects of the user's model.", examples=[[]]
    )


class Hidden(Strict):
    """One effect that the start model lacks."""

    title: str = Field(description="What is hidden, in a few words.")
    what: str = Field(description="What it does, and how it shows in the data.")
    effects: list[str] = Field(description="Effect ids accepted as right answers.")


class RevealAnswer(Strict):
    """The hidden effects, compared with the user's diagnosis."""

    hidden: list[Hidden] = Field(description="The hidden effects; none if the start model explains the data.")
    found: list[bool] = Field(description="For each hidden effect: whether the user named it.")
    surplus: list[str] = Field(
        description="Effects of the user that are neither hidden nor of the start model."
    )
    text: str = Field(description="The solution in words.")
