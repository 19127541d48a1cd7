"""JSON in and out: answers straight from numpy arrays, requests read strictly."""

from __future__ import annotations

import json
from collections.abc import Callable, Coroutine
from typing import Any

import numpy as np
import orjson
from fastapi import Request, Response
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException

_OPTIONS = orjson.OPT_SERIALIZE_NUMPY


def _unusual(value: object) -> object:
    """What orjson does not take by itself: arrays that are not contiguous, numpy scalars."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} has no JSON form")


def to_json(content: object) -> bytes:
    """JSON text of plain values and numpy arrays; NaN and infinity become null."""
    return orjson.dumps(content, option=_OPTIONS, default=_unusual)


class JsonAnswer(Response):
    """An answer written by `to_json`.

    A route that returns one is not validated again at run time: that would cost more than the physics.
    The tests validate real answers against the declared models instead.
    """

    media_type = "application/json"

    def render(self, content: object) -> bytes:
        """Bytes of the answer; bytes pass unchanged."""
        return content if isinstance(content, bytes) else to_json(content)


class _DuplicateKeyError(ValueError):
    """A key that occurs twice in one JSON object."""


def _refuse_duplicates(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found = dict(pairs)
    if len(found) < len(pairs):
        keys = [key for key, _ in pairs]
        raise _DuplicateKeyError(next(key for key in keys if keys.count(key) > 1))
    return found


def read_json(text: bytes) -> Any:
    """Strict JSON: no NaN, no number beyond double precision, no lone surrogate, no key twice.

    Raises:
        HTTPException: 400 with a sentence that says what is wrong and where.
    """
    try:
        value = orjson.loads(text)
        # orjson keeps the last of two equal keys silently; a request that says two things says nothing.
        json.loads(text, object_pairs_hook=_refuse_duplicates, parse_int=float)
    except orjson.JSONDecodeError as error:
        raise HTTPException(400, f"The body is not valid JSON: {error}.") from error
    except RecursionError as error:
        raise HTTPException(400, "The body is nested too deeply.") from error
    except _DuplicateKeyError as error:
        raise HTTPException(400, f"The key '{error}' occurs twice in one JSON object.") from error
    return value


class _StrictRequest(Request):
    async def json(self) -> Any:
        return read_json(await self.body())


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
