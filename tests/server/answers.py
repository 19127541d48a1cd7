"""Answers of the server against their declarations."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

from pydantic import TypeAdapter


@cache
def _adapter(kind: type) -> TypeAdapter[Any]:
    return TypeAdapter(kind)


def valid(kind: type, answer: object) -> Any:
    """The answer, bytes or what was read from them, as what it is declared to be.

    Raises:
        pydantic.ValidationError: it is something else.
    """
    text = answer if isinstance(answer, bytes | str) else json.dumps(answer)
    return _adapter(kind).validate_json(text)
