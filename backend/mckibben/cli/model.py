"""Muscle, effects and drive of ``compare`` and ``diagnose``, as the options state them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from mckibben.application.doubts import deciding
from mckibben.application.envelope import MeasuredRange
from mckibben.application.experiment import SaidMeasurement, SaidModel
from mckibben.application.model_question import ModelQuestion, question_of
from mckibben.cli.options import ModelOptions, start_model, stated_model
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_files import read_document
from mckibben.documents.located import at_file
from mckibben.documents.model_files import drive_document, saved_model
from mckibben.documents.muscle_files import is_file
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import GEOMETRY
from mckibben.physics.units import si


def model_question(
    studio: Studio,
    measurements: Sequence[SaidMeasurement],
    options: ModelOptions,
    *,
    free: Sequence[str],
    noise: float | None = None,
    strict: bool = False,
    refit: bool = True,
) -> ModelQuestion:
    """The question of ``compare`` and ``diagnose``, from their options and measurements.

    Args:
        studio: presets and effects.
        measurements: the data.
        options: the model.
        free: geometry, and constants as "effect.parameter", that fits may change as well.
        noise: standard deviation of the predicted channel [SI], if known.
        strict: refuse instead of assuming.
        refit: whether the numbers of a saved model are fitted again; what was freed for it is freed again.

    Raises:
        InputError: names the file or option, what is wrong and what would be right.
    """
    saved = saved_model(options.model) if options.model else None
    geometry, constants = _freed(free, studio, saved)
    if saved is not None and refit:
        geometry += tuple(name for name in saved.free if name not in geometry)
        kept = _effects_of(options, saved)
        constants += tuple(
            name for name in saved.freed if name not in constants and name.partition(".")[0] in kept
        )
    try:
        question = question_of(
            said_model(studio, options),
            measurements,
            studio,
            free=geometry,
            freed=constants,
            noise=noise,
            strict=strict,
        )
    except InputError as error:
        if (error.field or "").startswith("freed."):  # those of the options are known
            raise at_file(options.model, error.field, error.message, error.hint) from error
        raise
    for name in constants:
        effect = name.partition(".")[0]
        if effect not in question.start.effects:
            raise InputError(
                f"--free {name}: the start model has no effect {effect}", hint=f"add --effect {effect}"
            )
    if saved is not None:
        question = _of_saved(question, saved, options.model)
    try:
        return deciding(question, use=options.use, keep=options.keep)
    except InputError as error:
        if error.field in ("use", "keep"):
            raise InputError(f"--{error.field}: {error.message}", hint=error.hint) from error
        raise


def _freed(
    names: Sequence[str], studio: Studio, saved: SavedModel | None
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Geometry and constants of ``--free``.

    Raises:
        InputError: no such geometry or constant.
    """
    constants = [f"{effect.id}.{p.name}" for effect in studio.catalogue.values() for p in effect.parameters]
    if saved is not None:
        constants += [f"{effect}.{name}" for effect, values in saved.effects.items() for name in values]
    for name in names:
        if "." in name and name not in constants:
            similar = [each for each in constants if each.startswith(name.partition(".")[0])] or constants
            raise InputError(f"--free {name}: there is no such constant", hint=did_you_mean(name, similar))
        if "." not in name and name not in GEOMETRY:
            raise InputError(f"--free {name}: there is no such geometry", hint=did_you_mean(name, GEOMETRY))
    unique = tuple(dict.fromkeys(names))
    return tuple(name for name in unique if "." not in name), tuple(name for name in unique if "." in name)


def _effects_of(options: ModelOptions, saved: SavedModel) -> set[str]:
    """Ids of the effects that the options leave of a saved model."""
    if options.ideal:
        return set()
    return set(saved.effects) & set(options.effects or saved.effects)


def _of_saved(question: ModelQuestion, saved: SavedModel, path: str) -> ModelQuestion:
    """The question with what a saved model says of its data: where it was measured, and what was assumed."""
    remarks = question.remarks
    if saved.assumed:
        remarks += (f"{path}: the model was fitted assuming {'; '.join(saved.assumed)}",)
    load = 0.0
    if saved.load_force is not None and question.predictor.unknown_load is not None:
        load = saved.load_force
        remarks += (f"the load is not stated: {load:.4g} N is taken, which the model's own data showed",)
    ranges = {
        name: MeasuredRange(found.least, found.most, found.unit) for name, found in saved.envelope.items()
    }
    return replace(question, envelope=ranges, load_force=load, remarks=remarks)


def said_model(studio: Studio, options: ModelOptions) -> SaidModel:
    """What the options say about muscle, effects and drive.

    Raises:
        InputError: names the file or option, what is wrong and what would be right.
    """

    def start(named: str, rest_length: float | None) -> StartModel:
        return start_model(studio, options, named=named, rest_length=rest_length)

    muscle = None
    if options.muscle and not is_file(options.muscle, studio):
        muscle = ExperimentValue(options.muscle.partition(":")[0], "", "you", "--muscle")
    elif options.model and not options.muscle:
        preset = saved_model(options.model).muscle.preset
        muscle = None if preset is None else ExperimentValue(preset, "", "you", f"--model {options.model}")
    return SaidModel(start, _said_length(studio, options), muscle, *_drive(options))


def _said_length(studio: Studio, options: ModelOptions) -> ExperimentValue | None:
    """The rest length that the options state; the default length of a preset is not stated."""
    if options.muscle and not is_file(options.muscle, studio):
        length = options.muscle.partition(":")[2]
        where = f"--muscle {options.muscle}"
    elif options.muscle:
        document = _json(options.muscle)
        length = document.get("nominal_length") if "kind" not in document else None
        where = options.muscle
    elif options.model or options.drive:
        muscle = stated_model(options)[0].get("muscle")
        length = muscle.get("nominal_length") if isinstance(muscle, dict) else None
        where = f"--model {options.model}" if options.model else "--drive"
    else:
        return None
    if length is None or length == "":
        return None
    try:
        return ExperimentValue(si(length, "m"), "m", "you", where)
    except InputError:
        return None  # told with its field when the muscle is read


def _json(path: str) -> dict[str, object]:
    from mckibben.presets.reading import BadDocumentError, read_file

    try:
        document = read_file(Path(path), follow_links=True)
    except BadDocumentError:
        return {}  # told when the muscle is read
    return document if isinstance(document, dict) else {}


def _drive(options: ModelOptions) -> tuple[DriveDocument | None, str]:
    """The drive of a document that has a valve, and the name of the document in origins and errors.

    Its muscle and effects are those of the start model. A saved model's own drive gives way to ``--drive``.
    """
    if not options.drive:
        own = saved_model(options.model).drive if options.model else None
        return own, f"--model {options.model}" if own is not None else "--drive "
    where = f"--drive {options.drive}"
    document = drive_document(options.drive)
    if "valve" not in document:
        return None, where
    try:
        return read_document({**document, "effects": {}}, options.drive), where
    except InputError as error:
        raise at_file(options.drive, error.field, error.message, error.hint) from error
