"""The one exception of the Python door: the sentence that the command line prints for bad input."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from mckibben.documents.doors import error_in_words_of
from mckibben.documents.located import one_line
from mckibben.physics.errors import InputError
from mckibben.presets.reading import BadDocumentError

P = ParamSpec("P")
R = TypeVar("R")


class Problem(ValueError):  # noqa: N818 - the word for users
    """Input that cannot be used: where, what is wrong, and what would be right, in one line.

    Attributes:
        message: what is wrong.
        field: where, as a path in a document or a row and column of a file; None without a place.
        hint: what would be right; None where nothing can be said.
        code: machine-readable kind, e.g. "unknown_preset".
    """

    def __init__(
        self, text: str, *, message: str = "", field: str | None = None, hint: str | None = None,
        code: str = "bad_input",
    ) -> None:  # fmt: skip
        super().__init__(text)
        self.message = message or text
        self.field = field
        self.hint = hint
        self.code = code


Problem.__module__ = "mckibben"  # as users know it, in tracebacks


def reported(function: Callable[P, R]) -> Callable[P, R]:
    """The function with `Problem` instead of the errors of the use cases, without their traceback."""

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return function(*args, **kwargs)
        except InputError as error:
            problem = _problem(error)
        except BadDocumentError as bad:
            finding = bad.findings[0]
            problem = _problem(InputError(finding.message, field=finding.field, hint=finding.hint))
        # Outside of the handler, so that the inner error is not printed with it.
        raise problem

    return call


def _problem(error: InputError) -> Problem:
    error = error_in_words_of("python", error)
    return Problem(
        one_line(error), message=error.message, field=error.field, hint=error.hint, code=error.code
    )
