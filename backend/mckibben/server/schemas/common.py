"""Shared schemas: strict models, fields with units, errors, flags."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from mckibben.documents.strict import Strict, si_field


class ErrorDetail(Strict):
    """What is wrong, where, and what would be right."""

    code: str = Field(description="Machine-readable kind.", examples=["bad_input"])
    message: str = Field(description="What is wrong, for people.")
    field: str | None = Field(
        description="Path of the field in the request.", examples=["muscle.braid_angle"]
    )
    hint: str | None = Field(description="What would be right.", examples=["e.g. '25 deg'"])


class ErrorBody(Strict):
    """The body of every error."""

    error: ErrorDetail = Field(description="What is wrong.")


class Flag(Strict):
    """A remark on an answer: a crossed limit, a value out of reach, an unverified figure."""

    code: str = Field(examples=["over_force_limit"], description="Machine-readable kind.")
    message: str = Field(description="Explanation for the user.")
    field: str | None = Field(default=None, description="The input it belongs to.")


class MakerLimits(Strict):
    """Limits stated by the maker; null where not known."""

    max_pressure: float | None = si_field("Pa", "Highest gauge pressure.")
    max_force: float | None = si_field("N", "Highest force.")
    max_contraction: float | None = si_field("1", "Highest contraction.")
    max_pretension: float | None = si_field("1", "Highest stretch beyond the nominal length.")


class SourceText(Strict):
    """Source of a figure, and its grade."""

    text: str = Field(description="Short source.")
    grade: str = Field(
        description="S read in the source, S2 second-hand, C computed, D derived here, "
        "M general knowledge and E estimate (both unverified), user.",
        examples=["S"],
    )


def streamed(found: str = "") -> dict[int | str, dict[str, Any]]:
    """The documented stream of a route.

    Args:
        found: what a progress event may hold besides, in words; "" = nothing.
    """
    more = f', "found": {found}' if found else ""
    words = (
        f'With `Accept: text/event-stream`: events `progress` ({{"share": 0 to 1{more}}}; while it waits for '
        'a worker also "waiting": {"before": jobs before it, "seconds": until it begins}), then `done` '
        "(the answer) or `error` (the error body)."
    )
    return {200: {"content": {"text/event-stream": {"schema": {"type": "string", "description": words}}}}}


ERRORS: dict[int | str, dict[str, Any]] = {
    status: {"model": ErrorBody, "description": text}
    for status, text in {
        400: "The body or a header is malformed.",
        403: "Host, origin or token refused.",
        404: "Not found.",
        409: "It conflicts with what is stored, or cannot be stored.",
        413: "The body is too large.",
        415: "The body is of another content type.",
        422: "The input cannot be used.",
        429: "Too many jobs wait; Retry-After says how long, about.",
        500: "The server failed; the log says more.",
    }.items()
}


def errors(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The documented errors of a route; 403 and 500 belong to all."""
    return {status: ERRORS[status] for status in sorted({403, 500, *statuses})}
