"""Answers of ``/api/mysteries``: measurements with hidden effects, and what is hidden when somebody asks."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from mckibben.documents.strict import Name, Strict
from mckibben.server.schemas.comparisons import EffectsJson


class Mystery(Strict):
    """A measurement to practise on; says nothing of what is hidden."""

    id: str = Field(examples=["two-lines-per-pressure"])
    title: str
    story: str = Field(description="What an engineer would tell of it.")
    kind: str = Field(description="Measurement kind.")
    muscle: dict[str, Any] = Field(description="As a comparison takes it.")
    drive: dict[str, Any] | None = Field(description="As a comparison takes it; null where none is needed.")
    effects: EffectsJson = Field(description="The start model.")
    measurement: str = Field(description="Id by which comparisons and diagnoses take the measurement.")


class RevealRequest(Strict):
    """The user's own diagnosis."""

    effects: list[Name] = Field(
        default=[], max_length=64, description="Ids of the effects of the user's model.", examples=[[]]
    )


class Hidden(Strict):
    """One thing that the start model lacks."""

    title: str
    what: str = Field(description="What it does, and how it shows.")
    effects: list[str] = Field(description="Effect ids that are right answers.")


class RevealAnswer(Strict):
    """What is hidden, beside what was found."""

    hidden: list[Hidden]
    found: list[bool] = Field(description="For each hidden effect: is it among the given ones?")
    surplus: list[str] = Field(description="Given effects that are neither hidden nor of the start model.")
    text: str
