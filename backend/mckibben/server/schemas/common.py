"""Shared schemas: strict models, fields with units, errors, flags."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from mckibben.application.measurement.summary import UnreadableFile
from mckibben.documents.strict import Strict


class ErrorBody(Strict):
    """The body of every error."""

    error: UnreadableFile = Field(description="What is wrong.")


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
        401: "The token is missing or wrong.",
        403: "Host or origin refused.",
        404: "Not found.",
        409: "It conflicts with what is stored, or cannot be stored.",
        413: "The body is too large.",
        415: "The body is of another content type.",
        422: "The input cannot be used.",
        429: "Too many jobs wait; Retry-After says how long, about.",
        500: "The server failed; the log says more.",
        503: "Not at the moment: a database or a process that it needs does not answer; later it may.",
        507: "No space: what is kept takes all that it may, or the disk is full; with figures.",
    }.items()
}


def errors(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The documented errors of a route; 401, 403 and 500 belong to all."""
    return {status: ERRORS[status] for status in sorted({401, 403, 500, *statuses})}
