"""The answer of ``/api/order-codes``."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.strict import Strict


class CodePartAnswer(Strict):
    """A part of an order code."""

    text: str = Field(description="As it stands in the code.")
    meaning: str = Field(description="What it means.")


class OrderCodeAnswer(Strict):
    """What an order code says."""

    code: str = Field(description="As it was given.")
    preset: str = Field(description="Id of the muscle preset of its series and diameter.")
    nominal_length: float = Field(description="Length that it states [m].")
    parts: list[CodePartAnswer] = Field(description="Its parts, and what each means.")
