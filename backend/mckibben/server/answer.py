"""JSON in and out: answers written directly from numpy arrays, strict reading of requests."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Callable, Coroutine, Iterator
from typing import Any

import orjson
from fastapi import Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException

from mckibben.application.json_text import to_json
from mckibben.documents.doors import result_in_words_of

_LONGEST_PATH = 200  # most characters of a field's path in a message
_LARGE_BODY = 50_000  # bytes; larger bodies are parsed in a thread, so that other requests need not wait


class JsonAnswer(Response):
    """An answer written by `to_json`.

    An answer of this class is not validated at run time: that would take longer than the physics.
    The tests validate real answers against the declared models instead.
    """

    media_type = "application/json"

    def render(self, content: object) -> bytes:
        """Bytes of the answer; bytes pass unchanged."""
        return content if isinstance(content, bytes) else to_json(content)


def answer_of(result: object) -> bytes:
    """A result as JSON, its corrections in the words of HTTP."""
    return to_json(result_in_words_of("http", result))


class _DuplicateKeyError(ValueError):
    """A key that occurs twice in one JSON object."""


def _refuse_duplicates(pairs: list[tuple[str, object]]) -> dict[str, object]:
    document = dict(pairs)
    if len(document) < len(pairs):
        times = Counter(key for key, _ in pairs)
        raise _DuplicateKeyError(next(key for key in times if times[key] > 1))
    return document


class BodyError(HTTPException):
    """A body that is not strict JSON; ``field`` is the path of the error, if known."""

    def __init__(self, message: str, *, field: str | None = None, hint: str | None = None) -> None:
        super().__init__(400, message)
        self.field, self.hint = field, hint


def read_json(text: bytes) -> Any:
    """Strict JSON: no NaN, no number beyond double precision, no lone surrogate, no key twice.

    Raises:
        BodyError: what is wrong and where, as a sentence.
    """
    try:
        value = orjson.loads(text)
        # orjson silently keeps the last of two equal keys; such a request is ambiguous and refused.
        json.loads(text, object_pairs_hook=_refuse_duplicates, parse_int=float)
    except orjson.JSONDecodeError as error:
        raise _refusal(text, error) from error
    except RecursionError as error:
        raise BodyError("The body is nested too deeply.") from error
    except _DuplicateKeyError as error:
        raise BodyError(f"The key '{error}' occurs twice in one JSON object.") from error
    return value


def _refusal(text: bytes, error: orjson.JSONDecodeError) -> BodyError:
    """The error for a body that orjson refused; a more lenient reader finds the field where possible."""
    try:
        path, value = next(_unusable(json.loads(text, parse_int=float)))
    except (ValueError, RecursionError, StopIteration):
        return BodyError(f"The body is not valid JSON: {error}.")
    path = path[:_LONGEST_PATH]
    name = path or "The body"
    if isinstance(value, str):
        return BodyError(f"{name} holds half of a surrogate pair.", field=path or None, hint="Send a text.")
    shown = "NaN, which is not a number" if math.isnan(value) else "infinite, or too large for a number"
    return BodyError(f"{name} is {shown}.", field=path or None, hint="Send a finite number, or leave it out.")


def _unusable(value: object) -> Iterator[tuple[str, float | str]]:
    """Numbers and texts that JSON cannot hold, with their paths, in the order of the text."""
    waiting: list[tuple[str, object]] = [("", value)]  # a stack: recursion could exceed Python's limit
    while waiting:
        path, value = waiting.pop()
        inside: list[tuple[object, object]] = []
        if isinstance(value, dict):
            inside = list(value.items())
        elif isinstance(value, list):
            inside = list(enumerate(value))
        elif isinstance(value, float | str) and not _holds(value):
            yield path, value
        begin = f"{path}." if path else ""
        waiting += [(f"{begin}{str(key)[:80]}", item) for key, item in reversed(inside)]


def _holds(value: float | str) -> bool:
    """Whether JSON can represent the value."""
    if isinstance(value, str):
        return not any("\ud800" <= character <= "\udfff" for character in value)
    return math.isfinite(value)


class _StrictRequest(Request):
    async def json(self) -> Any:
        body = await self.body()
        if len(body) < _LARGE_BODY:
            return read_json(body)
        return await run_in_threadpool(read_json, body)


class StrictRoute(APIRoute):
    """A route whose JSON body is read by `read_json`, and only when it is declared as JSON."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """The handler of FastAPI behind the content type check."""
        handle = super().get_route_handler()
        wants_json = self.body_field is not None

        async def strict(request: Request) -> Response:
            if wants_json:
                declared = request.headers.get("content-type", "")
                if declared.partition(";")[0].strip().lower() != "application/json":
                    raise HTTPException(415, f"The body is declared as '{declared[:80]}', not as JSON.")
            return await handle(_StrictRequest(request.scope, request.receive))

        return strict
