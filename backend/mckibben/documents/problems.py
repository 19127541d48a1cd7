"""Validation errors of pydantic as sentences: the field, what is wrong, and what would be right."""

from __future__ import annotations

import re
import types
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError

from mckibben.physics.errors import InputError, did_you_mean

# Requirement by pydantic's error type; {…} are filled with the values of the error.
_MUST_BE = {
    "greater_than": "must be greater than {gt}",
    "greater_than_equal": "must be at least {ge}",
    "less_than": "must be less than {lt}",
    "less_than_equal": "must be at most {le}",
    "literal_error": "must be one of {expected}",
    "enum": "must be one of {expected}",
    "too_long": "must have at most {max_length} entries",
    "too_short": "must have at least {min_length} entries",
    "string_too_long": "must have at most {max_length} characters",
    "string_too_short": "must have at least {min_length} characters",
    "union_tag_invalid": "must be one of {expected_tags}",
    "finite_number": "must be a finite number",
    "string_type": "must be a text",
    "string_unicode": "must be a text",
    "bool_type": "must be true or false",
    "bool_parsing": "must be true or false",
    "int_type": "must be a whole number",
    "int_parsing": "must be a whole number",
    "int_from_float": "must be a whole number",
    "int_parsing_size": "must be a smaller whole number",
    "float_type": "must be a number",
    "float_parsing": "must be a number",
    "list_type": "must be a list",
    "dict_type": "must be an object",
    "model_type": "must be an object",
    "model_attributes_type": "must be an object",
}
Model = TypeVar("Model", bound=BaseModel)
_PLACES = ("body", "query", "path", "header", "cookie")


@dataclass(frozen=True, slots=True)
class Problem:
    """One error in a request or file."""

    message: str
    field: str | None = None
    hint: str | None = None
    code: str = "bad_input"
    place: str = "body"


def _annotations(annotation: Any) -> list[Any]:
    """The models and containers in an annotation, without Annotated, Optional and unions."""
    origin = get_origin(annotation)
    if origin is Annotated:
        return _annotations(get_args(annotation)[0])
    if origin in (Union, types.UnionType):
        return [inner for part in get_args(annotation) for inner in _annotations(part)]
    return [annotation]


def _known_fields(annotations: list[Any], location: Sequence[int | str]) -> list[str]:
    """The field names of the model at this location of the request."""
    for step in location:
        inner: list[Any] = []
        for annotation in annotations:
            if isinstance(annotation, type) and issubclass(annotation, BaseModel):
                if step in annotation.model_fields:
                    inner += _annotations(annotation.model_fields[str(step)].annotation)
                elif step in _tags(annotation):
                    # pydantic names the chosen branch of a union in the location.
                    inner.append(annotation)
            elif get_args(annotation):
                inner += _annotations(get_args(annotation)[-1])
        annotations = inner
    return [
        name
        for annotation in annotations
        if isinstance(annotation, type) and issubclass(annotation, BaseModel)
        for name in (field.alias or name for name, field in annotation.model_fields.items())
    ]


def _tags(model: type[BaseModel]) -> list[Any]:
    return [tag for field in model.model_fields.values() for tag in get_args(field.annotation)]


def _path(location: Sequence[int | str], value: object) -> str | None:
    """The location as ``muscle.braid_angle``, without the union tags that pydantic adds."""
    steps: list[str] = []
    for step in location:
        if steps and not isinstance(value, Mapping | list):
            break  # a union's tag below a plain value
        if isinstance(value, Mapping):
            if step not in value and step in value.values():
                continue
            value = value.get(step)
        elif isinstance(value, list):
            if not isinstance(step, int):
                break  # the same where a list is none of the union's
            value = value[step] if step < len(value) else value
        steps.append(str(step)[:80])
    return ".".join(steps) or None


def _shown(value: object) -> str:
    if value is None or isinstance(value, bool):
        return {None: "null", True: "true", False: "false"}[value]
    if isinstance(value, dict | list):
        return "an object" if isinstance(value, dict) else "a list"
    text = repr(value) if isinstance(value, str) else str(value)
    return text if len(text) <= 60 else f"{text[:57]}…"


def _problem(error: Mapping[str, Any], model: Any, body: object, subject: str) -> Problem:
    location: tuple[int | str, ...] = tuple(error["loc"])
    place = str(location[0]) if location and location[0] in _PLACES else "body"
    if location and location[0] in _PLACES:
        location = location[1:]
    kind, context = error["type"], error.get("ctx") or {}
    field = _path(location, body)
    name = field or subject
    cause = context.get("error")

    if isinstance(cause, InputError):
        inner = ".".join(part for part in (field, cause.field) if part)
        return Problem(cause.message, inner or None, cause.hint, cause.code, place)
    if kind == "json_invalid":
        return Problem(f"The body is not valid JSON: {cause}.", code="bad_json")
    if kind == "missing":
        if field is None:
            return Problem(f"{subject} has no body.", None, "Send one JSON object.", "missing")
        return Problem(f"{name} is missing.", field, None, "missing", place)
    if kind == "extra_forbidden":
        known = _known_fields(_annotations(model), location[:-1])
        hint = did_you_mean(str(location[-1]), known)
        return Problem(f"{name} is not a known field.", field, hint, "unknown_field", place)
    if kind == "union_tag_not_found":
        tag = str(context.get("discriminator", "")).strip("'")
        return Problem(f"{tag} is missing.", tag, None, "missing", place)
    if kind == "union_tag_invalid":
        tag = str(context["discriminator"]).strip("'")
        return Problem(f"{tag} must be one of {context['expected_tags']}, not {_shown(context['tag'])}.", tag)
    shown = _shown(error.get("input"))
    if kind == "string_pattern_mismatch":
        form = f"its form is {context['pattern']}"
        return Problem(f"{name} cannot be {shown}.", field, form, "bad_input", place)
    if kind in _MUST_BE:
        options = re.findall(r"'([^']*)'", str(context.get("expected", "")))
        near = did_you_mean(str(error.get("input"))[:80], options) if options else None
        wanted = _MUST_BE[kind].format(**context)
        return Problem(f"{name} {wanted}, not {shown}.", field, near, "bad_input", place)
    message = str(error["msg"]).removeprefix("Value error, ")
    return Problem(f"{name}: {message}", field, None, "bad_input", place)


def first_problem(
    errors: Sequence[Mapping[str, Any]], model: Any = None, body: object = None, subject: str = "The request"
) -> Problem:
    """The first of pydantic's errors as a sentence.

    Args:
        errors: ``ValidationError.errors()``.
        model: the validated model, for suggestions of field names.
        body: the request, so that the field path contains only its keys.
        subject: name of the request or file in messages.
    """
    # A misspelt field explains a missing one, so it is reported first.
    first = min(errors, key=lambda error: error["type"] != "extra_forbidden")
    # A text that is too long for a number or a text is not a number either, which helps nobody.
    same = (error for error in errors if error.get("input") is first.get("input"))
    first = next((error for error in same if error["type"] == "string_too_long"), first)
    return _problem(first, model, body, subject)


def validated(model: type[Model], document: object, subject: str) -> Model:
    """A document from JSON as a model.

    Args:
        model: what it must be.
        document: parsed JSON.
        subject: name of the document in messages.

    Raises:
        InputError: what is wrong with it; ``field`` is the path in the document.
    """
    try:
        return model.model_validate(document)
    except ValidationError as error:
        problem = first_problem(error.errors(), model, document, subject)
        raise InputError(
            problem.message, field=problem.field, hint=problem.hint, code=problem.code
        ) from error
