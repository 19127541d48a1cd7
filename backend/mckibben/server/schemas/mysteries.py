"""Answers of ``/api/mysteries``: measurements with hidden effects, and the solutions."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.strict import Name, Strict


class RevealRequest(Strict):
    """The user's diagnosis."""

    effects: list[Name] = Field(
        default=[], max_length=64, description="Ids of the effects of the user's model.", examples=[[]]
    )
