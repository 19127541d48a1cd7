"""The question of a comparison or diagnosis from a stated model, with what a saved model adds to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mckibben.application.compare.compare import preconditioned_model
from mckibben.application.compare.question import ModelQuestion, question_of
from mckibben.application.diagnose.doubts import with_decisions
from mckibben.application.envelope import Envelope, MeasuredRange
from mckibben.application.measurement.experiment import QuestionMeasurement, QuestionModel
from mckibben.application.measurement.files import OPTION
from mckibben.documents.located import at_file
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.studio import Studio
from mckibben.identification.predict.fit_model import START
from mckibben.identification.predict.predictor import Predictor
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import GEOMETRY
from mckibben.physics.units import si


@dataclass(frozen=True, slots=True)
class SavedStart:
    """A saved model that a question starts from.

    Attributes:
        document: of the model.
        name: its file, for messages; "" without one.
        effects: ids of its effects that the start model keeps.
    """

    document: SavedModel
    name: str
    effects: frozenset[str]


def stated_question(
    model: QuestionModel,
    measurements: Sequence[QuestionMeasurement],
    studio: Studio,
    *,
    saved: SavedStart | None = None,
    free: Sequence[str] = (),
    noise: float | str | None = None,
    strict: bool = False,
    refit: bool = True,
    use: Sequence[str] = (),
    keep: Sequence[str] = (),
    prefix: str = OPTION,
) -> ModelQuestion:
    """The question of a comparison or a diagnosis.

    Args:
        model: muscle, effects and drive.
        measurements: the data.
        studio: presets and effects.
        saved: the saved model that the start model comes from.
        free: geometry, and constants as "effect.parameter", that fits may change as well.
        noise: standard deviation of the predicted channel, if known: a number in SI or a text with a unit.
        strict: refuse instead of assuming.
        refit: whether the numbers of a saved model are fitted again; what was freed for it is freed again.
        use, keep: decisions about entries that may be wrong, see `with_decisions`.
        prefix: of the names of options in messages, `OPTION` or `ARGUMENT`.

    Raises:
        InputError: names the file or option, what is wrong and what would be right.
    """
    geometry, constants = _freed(free, studio, saved, prefix)
    if saved is not None and refit:
        geometry += tuple(name for name in saved.document.free if name not in geometry)
        constants += tuple(
            name
            for name in saved.document.freed
            if name not in constants and name.partition(".")[0] in saved.effects
        )
    model = replace(model, keep_length="rest_length" in keep)
    try:
        question = question_of(model, measurements, studio, free=geometry, freed=constants, strict=strict)
    except InputError as error:
        # Those of the caller are known.
        if saved is not None and (error.field or "").startswith("freed."):
            raise at_file(saved.name, error.field, error.message, error.hint) from error
        raise
    if START in geometry:
        try:
            question.predictor.free_starts()
        except InputError as error:
            raise InputError(f"{prefix}free start: {error.message}", field="free", hint=error.hint) from error
    for name in constants:
        effect = name.partition(".")[0]
        if effect not in question.start.effects:
            how = f"add --effect {effect}" if prefix == OPTION else f"add the effect {effect}"
            raise InputError(f"{prefix}free {name}: the start model has no effect {effect}", hint=how)
    if saved is not None:
        question = _of_saved(question, saved)
    elif (fit := question.start.fit) is not None:
        question = _going_on(question, {
            name: MeasuredRange(span.least, span.most, span.unit) for name, span in fit.envelope.items()
        })  # fmt: skip
    try:
        decided = with_decisions(question, use=use, keep=keep)
    except InputError as error:
        if error.field in ("use", "keep"):
            raise InputError(f"{prefix}{error.field}: {error.message}", hint=error.hint) from error
        raise
    return with_noise(decided, noise, name=f"{prefix}noise")


def _freed(
    names: Sequence[str], studio: Studio, saved: SavedStart | None, prefix: str
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Geometry and constants of ``free``.

    Raises:
        InputError: no such geometry or constant.
    """
    constants = [f"{effect.id}.{p.name}" for effect in studio.catalogue.values() for p in effect.parameters]
    if saved is not None:
        effects = saved.document.effects.items()
        constants += [f"{effect}.{name}" for effect, values in effects for name in values]
    for name in names:
        where = f"{prefix}free {name}"
        if "." in name and name not in constants:
            similar = [each for each in constants if each.startswith(name.partition(".")[0])] or constants
            raise InputError(f"{where}: there is no such constant", hint=did_you_mean(name, similar))
        if "." not in name and name not in (*GEOMETRY, START):
            raise InputError(
                f"{where}: there is no such geometry", hint=did_you_mean(name, (*GEOMETRY, START))
            )
    unique = tuple(dict.fromkeys(names))
    return tuple(name for name in unique if "." not in name), tuple(name for name in unique if "." in name)


def _of_saved(question: ModelQuestion, saved: SavedStart) -> ModelQuestion:
    """The question with what a saved model says of its data: where it was measured, and what was assumed."""
    document, remarks = saved.document, question.remarks
    if document.assumed:
        name = f"{saved.name}: " if saved.name else ""
        remarks += (f"{name}the model was fitted assuming {'; '.join(document.assumed)}",)
    load = 0.0
    if document.load_force is not None and question.predictor.unknown_load is not None:
        load = document.load_force
        remarks += (f"the load is not stated: {load:.4g} N is taken, which the model's own data showed",)
    ranges = {
        name: MeasuredRange(found.least, found.most, found.unit) for name, found in document.envelope.items()
    }
    return _going_on(replace(question, envelope=ranges, load_force=load, remarks=remarks), ranges)


def _going_on(question: ModelQuestion, ranges: Envelope) -> ModelQuestion:
    """The question of a muscle that its own measurements have changed for good, where these go on with it."""
    start = question.start
    if not any(state.lasting for name in start.effects for state in start.catalogue[name].states):
        return question  # without reading the data for it
    model, remark = preconditioned_model(question.predictor, question.fit_model(), ranges)
    if not remark:
        return question
    # What is stated of the muscle's past is part of the start model, so that fits and answers hold it.
    start = replace(start, effects=model.values)
    return replace(question, start=start, remarks=(*question.remarks, remark)).with_data_of(question)


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
