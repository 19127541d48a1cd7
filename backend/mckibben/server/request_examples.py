"""One worked example of each request body, for the OpenAPI document and the help page.

They are in request_examples.json; the tests send them as they stand. Their measurements are presets, so that
nothing has to be uploaded first.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

_EXAMPLES: dict[str, Any] = json.loads(Path(__file__).with_suffix(".json").read_text("utf-8"))

#: A measurement file.
FILE = "\n".join([*_EXAMPLES["file"], ""])


def worked(name: str) -> dict[str, Any]:
    """What a route adds to its operation (``openapi_extra``): the example of its JSON body."""
    return _body({"example": _EXAMPLES[name]})


def worked_each(name: str) -> dict[str, Any]:
    """The same for a body of several forms: one example of each, by name."""
    return _body({"examples": {form: {"value": example} for form, example in _EXAMPLES[name].items()}})


def _body(media: dict[str, Any]) -> dict[str, Any]:
    return {"requestBody": {"content": {"application/json": media}}}
