"""The noise of a question as it is stated: a number in SI, or a text with a unit of the predicted channel."""

from __future__ import annotations

from dataclasses import replace

from mckibben.application.compare.question import ModelQuestion
from mckibben.identification.predict.predictor import Predictor
from mckibben.physics.errors import InputError
from mckibben.physics.units import si


def with_noise(question: ModelQuestion, noise: float | str | None, *, name: str = "noise") -> ModelQuestion:
    """The question with the standard deviation of the predicted channel; None leaves it to be estimated.

    Args:
        question: a comparison or diagnosis.
        noise: a number or its text in SI, or a text with a unit, "2 N".
        name: how the caller calls it, for messages.

    Raises:
        InputError: it is no number above 0, has no unit of the channel, or several channels are predicted.
    """
    if noise is None:
        return question
    level = _number(noise)
    if level is None:
        of_one_channel(question.predictor)
        unit = question.predictor.unit
        try:
            level = si(noise, unit)
        except InputError as error:
            raise InputError(
                f"{name} {noise}: is neither a number in {unit} nor one with a unit: {error.message}",
                field="noise",
                hint=error.hint,
            ) from error
    if not 0.0 < level < float("inf"):
        raise InputError(
            f"{name} {noise}: the noise is a standard deviation above 0",
            field="noise",
            hint="leave it out to have it estimated",
        )
    return replace(question, noise=level)


def of_one_channel(predictor: Predictor) -> None:
    """Refuse a stated noise where several channels are predicted.

    Raises:
        InputError: they are.
    """
    if len(predictor.channels) > 1:
        raise InputError(
            "one noise cannot be stated for several predicted channels", field="noise", hint="omit it"
        )


def _number(noise: float | str) -> float | None:
    if isinstance(noise, bool):
        return None
    try:
        return float(noise)
    except (TypeError, ValueError):
        return None
