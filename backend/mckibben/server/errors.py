"""One JSON form for all errors.

``{"error": {"code": …, "message": …, "field": …, "hint": …}}`` with a 4xx status for errors of the caller,
and 500 with an id (and the traceback in the log only) for errors of the server.
"""

from __future__ import annotations

import logging
import secrets
from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException

from mckibben.documents.doors import error_in_words_of
from mckibben.documents.problems import first_problem
from mckibben.physics.errors import InputError
from mckibben.server.answer import BodyError, JsonAnswer
from mckibben.server.lane import BusyError

log = logging.getLogger("mckibben.server")

_STATUS_OF_CODE = {"not_found": 404, "conflict": 409, "unavailable": 503, "no_space": 507}
_CODE_OF_STATUS = {
    400: "bad_json",
    401: "token_required",
    403: "forbidden",
    404: "not_found",
    405: "method_not_allowed",
    409: "conflict",
    413: "too_large",
    415: "unsupported_media_type",
    422: "bad_input",
    429: "busy",
    503: "unavailable",
    507: "no_space",
}
_HINTS = {
    400: 'Send one JSON object, e.g. {"muscle": {"preset": "DMSP-20"}}.',
    413: "Measurement files may have up to 64 MB, other requests up to 1 MB.",
    415: "Send 'Content-Type: application/json'; measurement files as 'text/csv'.",
}


def error_body(
    code: str, message: str, *, field: str | None = None, hint: str | None = None
) -> dict[str, dict[str, str | None]]:
    """The JSON body of an error."""
    return {"error": {"code": code, "message": message, "field": field, "hint": hint}}


def error_answer(
    status: int, message: str, *, code: str | None = None, field: str | None = None, hint: str | None = None
) -> JsonAnswer:
    """An error answer; the code follows from the status unless given."""
    code = code or _CODE_OF_STATUS.get(status, "error")
    hint = hint or _HINTS.get(status)
    body = error_body(code, _printable(message), field=_printable(field), hint=_printable(hint))
    return JsonAnswer(body, status)


def _printable(text: str | None) -> Any:
    """Text that can be encoded as UTF-8 (a path may hold lone surrogates)."""
    return text if text is None else text.encode("utf-8", "replace").decode("utf-8")


def input_error_answer(error: InputError) -> JsonAnswer:
    """422 for input that cannot be used, 404 for something unknown, 409 for a conflict."""
    error = error_in_words_of("http", error)
    status = _STATUS_OF_CODE.get(error.code, 422)
    return error_answer(status, error.message, code=error.code, field=error.field, hint=error.hint)


def unexpected_answer(error: Exception) -> JsonAnswer:
    """500 with an id under which the log has the traceback; the answer contains none of it."""
    reference = secrets.token_hex(4)
    log.error("unexpected error %s", reference, exc_info=error)
    return error_answer(
        500,
        f"The server met an unexpected error ({reference}).",
        code="internal_error",
        hint=f"Please report it with the lines of the server's log that follow '{reference}'.",
    )


def _nearest_path(path: str, paths: Sequence[str]) -> str:
    known = paths if path.startswith("/api") else ()  # browsers request others by themselves
    # What begins like a path with parameters is rather that path than one that is spelt alike.
    begun = [name for name in known if name.startswith(f"{path.rstrip('/')}/{{")]
    near = begun[:1] or get_close_matches(path[:200], known, n=1, cutoff=0.6)
    return f"Did you mean '{near[0]}'?" if near else "The list of paths is at /openapi.json."


def install(app: FastAPI, paths: Sequence[str]) -> None:
    """Register handlers so that every error of the application has this form.

    Args:
        app: the application.
        paths: of its interface, for those that nearly named one.
    """

    @app.exception_handler(InputError)
    async def _input_error(request: Request, error: InputError) -> JsonAnswer:
        return input_error_answer(error)

    @app.exception_handler(BusyError)
    async def _busy(request: Request, error: BusyError) -> JsonAnswer:
        seconds = max(1, round(error.seconds))
        answer = error_answer(
            429,
            f"The server is busy: {error.waiting} jobs wait already, for about {seconds} s.",
            hint=f"Try again in {seconds} s.",
        )
        answer.headers["Retry-After"] = str(seconds)
        return answer

    @app.exception_handler(RequestValidationError)
    async def _invalid_request(request: Request, error: RequestValidationError) -> JsonAnswer:
        body = getattr(request.scope.get("route"), "body_field", None)
        model = None if body is None else body.field_info.annotation
        problem = first_problem(error.errors(), model, error.body)
        if problem.place == "path":
            # A path parameter that does not match its pattern: nothing exists under that path.
            return error_answer(404, problem.message, field=problem.field, hint=problem.hint)
        return error_answer(422, problem.message, code=problem.code, field=problem.field, hint=problem.hint)

    @app.exception_handler(HTTPException)
    async def _http_error(request: Request, error: HTTPException) -> JsonAnswer:
        path, hint, field = request.url.path, None, None
        message = str(error.detail)
        if isinstance(error, BodyError):
            field, hint = error.field, error.hint
        elif error.status_code == 404:
            message, hint = f"There is nothing at {path[:200]}.", _nearest_path(path, paths)
        elif error.status_code == 405:
            allowed = (error.headers or {}).get("Allow", "GET")
            message, hint = f"{path[:200]} does not take {request.method}.", f"It takes {allowed}."
        answer = error_answer(error.status_code, message, field=field, hint=hint)
        answer.headers.update(error.headers or {})
        return answer
