"""What a measurement file leaves open."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Question:
    """One thing that nothing in a file tells.

    Attributes:
        about: what it is about, ``unit of pressure``, ``rest length``.
        text: the question in a sentence.
        option: what answers it on the command line, with the proposal where there is one.
        column: the column concerned, as in the file.
        proposed: the likeliest answer.
        choices: other answers.
        stops: without an answer the file is not read.
    """

    about: str
    text: str
    option: str
    column: str | None = None
    proposed: str | None = None
    choices: tuple[str, ...] = ()
    stops: bool = True
