"""Muscle, effects and drive of ``compare`` and ``diagnose``, as the options state them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.compare.stated_question import SavedStart, stated_question
from mckibben.application.measurement.experiment import QuestionMeasurement, QuestionModel
from mckibben.application.measurement.files import FileOptions, measurements_of
from mckibben.cli.options import ModelOptions, start_model, stated_model
from mckibben.cli.output import standard_input
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import read_document
from mckibben.documents.located import at_file
from mckibben.documents.model_files import drive_document, saved_model
from mckibben.documents.muscle_files import is_file, muscle_alone
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.physics.errors import InputError
from mckibben.physics.units import si
from mckibben.presets.order_code import order_code


def model_question(
    studio: Studio,
    measurements: Sequence[QuestionMeasurement],
    options: ModelOptions,
    *,
    free: Sequence[str],
    noise: float | str | None = None,
    strict: bool = False,
    refit: bool = True,
) -> ModelQuestion:
    """The question of ``compare`` and ``diagnose``, from their options and measurements.

    Args:
        studio: presets and effects.
        measurements: the data.
        options: the model.
        free, noise, strict, refit: see `stated_question`.

    Raises:
        InputError: names the file or option, what is wrong and what would be right.
    """
    saved = None
    if options.model:
        document = saved_model(options.model)
        saved = SavedStart(document, options.model, _effects_of(options, document))
    return stated_question(
        model_of_question(studio, options),
        measurements,
        studio,
        saved=saved,
        free=free,
        noise=noise,
        strict=strict,
        refit=refit,
        use=options.use,
        keep=options.keep,
    )


def data_of(
    files: Sequence[str],
    studio: Studio,
    reading: FileOptions,
    options: ModelOptions,
    *,
    validate: Sequence[str] = (),
) -> list[QuestionMeasurement]:
    """The measurements of ``compare`` and ``diagnose``, those of ``--validate`` last.

    Args:
        files: to fit to.
        studio: presets and effects.
        reading: how files are read and prepared, and what is said of their experiment.
        options: the model.
        validate: files to check the model on.

    Raises:
        InputError: names the file or option, what is wrong and what would be right.
    """
    contents, length = standard_input([*files, *validate]), muscle_length(studio, options)
    with at_option():
        return [
            each
            for names, check in ((files, False), (validate, True))
            for each in measurements_of(
                names, studio, reading.correction, reading.said, contents=contents, muscle_length=length,
                prepare=reading.prepare, validation=check,
            )
        ]  # fmt: skip


@contextmanager
def at_option() -> Iterator[None]:
    """Errors of a step that prepares data name the option that states it."""
    try:
        yield
    except InputError as error:
        if error.field != "prepare" or not error.message.startswith("prepare"):
            raise
        raise InputError(f"--{error.message}", field=error.field, hint=error.hint) from error


def _effects_of(options: ModelOptions, saved: SavedModel) -> frozenset[str]:
    """Ids of the effects that the options leave of a saved model."""
    if options.ideal:
        return frozenset()
    return frozenset(saved.effects) & frozenset(options.effects or saved.effects)


def model_of_question(studio: Studio, options: ModelOptions) -> QuestionModel:
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
    length = _said_length(studio, options)
    return QuestionModel(start, length, muscle, *_drive(options, studio))


def muscle_length(studio: Studio, options: ModelOptions) -> float | None:
    """The rest length that the options state for the muscle [m]."""
    said = _said_length(studio, options)
    return said.value if said is not None and isinstance(said.value, float) else None


def _said_length(studio: Studio, options: ModelOptions) -> ExperimentValue | None:
    """The rest length that the options state; the default length of a preset is not stated."""
    if options.muscle and not is_file(options.muscle, studio):
        length = options.muscle.partition(":")[2] or _ordered(studio, options.muscle)
        where = f"--muscle {options.muscle}"
    elif options.muscle:
        document = muscle_alone(_json(options.muscle), options.muscle)
        stated = isinstance(document, dict) and "kind" not in document
        length = document.get("nominal_length") if stated else None
        where = options.muscle
    elif options.model or options.drive:
        muscle = stated_model(options, studio)[0].get("muscle")
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


def _ordered(studio: Studio, muscle: str) -> float | None:
    """The length that an order code states [m]."""
    known = [preset.id for preset in studio.library.list("muscles")]
    try:
        code = None if muscle in known else order_code(muscle, known)
    except InputError:
        return None  # told when the muscle is read
    return None if code is None else code.length


def _json(path: str) -> dict[str, object]:
    from mckibben.presets.reading import BadDocumentError, read_file

    try:
        document = read_file(Path(path), follow_links=True)
    except BadDocumentError:
        return {}  # told when the muscle is read
    return document if isinstance(document, dict) else {}


def _drive(options: ModelOptions, studio: Studio) -> tuple[DriveDocument | None, str]:
    """The drive of a document that has a valve, and the name of the document in origins and errors.

    Its muscle and effects are those of the start model. A saved model's own drive gives way to ``--drive``.
    """
    if not options.drive:
        own = saved_model(options.model).drive if options.model else None
        return own, f"--model {options.model}" if own is not None else "--drive "
    where = f"--drive {options.drive}"
    document = drive_document(options.drive, studio)
    if "valve" not in document:
        return None, where
    try:
        return read_document({**document, "effects": {}}, options.drive), where
    except InputError as error:
        raise at_file(options.drive, error.field, error.message, error.hint) from error
