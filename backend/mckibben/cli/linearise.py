"""``mckibben linearise``: linear models of a drive, responses, loop, controller design."""

from __future__ import annotations

from dataclasses import dataclass

from mckibben.application.linear.linearise import LinearQuestion, linear_view
from mckibben.application.linear.text import condition_of, goals_of
from mckibben.cli.output import progress, write_json, write_summary
from mckibben.documents.drive_files import named_document
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.located import located
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.physics.units import si
from mckibben.report.summary.linear import summary_of
from mckibben.simulation.linear.bound import SLIDING_SPEED

_OPTIONS = ("at", "input", "output", "amplitudes", "design", "sliding_speed")


@dataclass(frozen=True, slots=True)
class Wanted:
    """The options as texts; None where left out."""

    at: str | None = None
    input: str = "command"
    output: str = "position"
    amplitudes: str | None = None
    design: str | None = None
    sliding_speed: str | None = None


def run(studio: Studio, *, drive: str, wanted: Wanted, as_json: bool) -> None:
    """Linearise a drive and print the tables, or the answer.

    Raises:
        InputError: names the file and field, or the option, what is wrong and what would be right.
    """
    try:
        at = None if wanted.at is None else condition_of(wanted.at)
        goals = None if wanted.design is None else goals_of(wanted.design)
        amplitudes = None if wanted.amplitudes is None else _amplitudes(wanted.amplitudes, wanted.input)
        stated = wanted.sliding_speed
        speed = SLIDING_SPEED if stated is None else si(stated, "m/s", field="sliding_speed")
    except InputError as error:
        raise InputError(f"{_option(error.field)} {error.message}", hint=error.hint) from error
    document = named_document(drive, studio)
    try:
        annotated = drive_of(document, studio, measured=True)
        question = LinearQuestion(
            annotated,
            at=at,
            input=wanted.input,
            output=wanted.output,
            amplitudes=amplitudes,
            goals=goals,
            sliding_speed=speed,
        )
        with progress("linearising") as watch:
            result = linear_view(question, watch)
    except InputError as error:
        if error.field in _OPTIONS:
            raise InputError(f"{drive}: {_option(error.field)}: {error.message}", hint=error.hint) from error
        raise InputError(f"{drive}: {located(error.field, error.message)}", hint=error.hint) from error
    if as_json:
        write_json(result)
    else:
        write_summary(summary_of(result, drive))


def _option(field: str | None) -> str:
    """The option that a field of the question is."""
    return f"--{(field or '').replace('_', '-')}"


def _amplitudes(text: str, source: str) -> tuple[float, ...]:
    """Amplitudes of sines; "none" for no sweep."""
    if text.strip().lower() == "none":
        return ()
    unit = "N" if source == "load_force" else "1"
    return tuple(si(part.strip(), unit, field="amplitudes") for part in text.split(","))
