"""What several nouns share: strict models, fields with units, errors, flags."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from mckibben.documents.strict import Strict


class ErrorDetail(Strict):
    """What is wrong, where, and what would be right."""

    code: str = Field(description="Machine-readable kind.", examples=["bad_input"])
    message: str = Field(description="What is wrong, for people.")
    field: str | None = Field(
        description="Path of the field in the request.", examples=["muscle.braid_angle"]
    )
    hint: str | None = Field(description="What would be right.", examples=["e.g. '25 deg'"])


class ErrorBody(Strict):
    """The one shape of every error."""

    error: ErrorDetail


class Flag(Strict):
    """Something the user should know about an answer: a limit, a value out of reach, an unverified figure."""

    code: str = Field(examples=["over_force_limit"])
    message: str = Field(description="In physical words.")
    field: str | None = Field(default=None, description="The input it belongs to.")


class SourceText(Strict):
    """Where a figure comes from, and how sure it is."""

    text: str = Field(description="Short source.")
    grade: str = Field(
        description="S read in the source, S2 second-hand, C computed, D derived here, "
        "M general knowledge and E estimate (both unverified), user.",
        examples=["S"],
    )


ERRORS: dict[int | str, dict[str, Any]] = {
    status: {"model": ErrorBody, "description": text}
    for status, text in {
        400: "The body or a header is malformed.",
        403: "Host, origin or token refused.",
        404: "There is no such thing.",
        409: "It collides with what is kept, or cannot be kept.",
        413: "The body is too large.",
        415: "The body is of another content type.",
        422: "The input cannot be used.",
        500: "The server failed; the log says more.",
    }.items()
}


def errors(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The documented errors of a route; 403 and 500 belong to all."""
    return {status: ERRORS[status] for status in sorted({403, 500, *statuses})}
