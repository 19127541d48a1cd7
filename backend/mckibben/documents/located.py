"""Errors with the file and the field that they are about, in one line."""

from __future__ import annotations

from mckibben.physics.errors import InputError


def at_file(source: str, field: str | None, message: str, hint: str | None) -> InputError:
    """The error with the name of the file in front, unless it stands there; "" for none."""
    if source and message.startswith(f"{source}:"):
        return InputError(message, hint=hint)
    text = located(field, message).removesuffix(".")
    return InputError(f"{source}: {text}" if source else text, hint=hint)


def located(field: str | None, message: str) -> str:
    """The message with its field in front, unless the message names the field already."""
    if (
        not field
        or field in message.replace("'", "")
        or field.rpartition(".")[2].replace("_", " ") in message
    ):
        return message
    return f"{field}: {message}"


def one_line(error: InputError) -> str:
    """Where, what is wrong, what would be right, in one line."""
    hint = "" if not error.hint else f" ({error.hint.rstrip('.')})"
    return " ".join(f"{located(error.field, error.message)}{hint}".split())
