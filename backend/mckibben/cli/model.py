"""Muscle, effects and drive of ``compare`` and ``diagnose``, as the options state them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mckibben.application.experiment import SaidMeasurement, SaidModel
from mckibben.application.model_question import ModelQuestion, question_of
from mckibben.cli.drive_file import drive_document
from mckibben.cli.options import ModelOptions, at_file, is_file, start_model
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_files import read_document
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
) -> ModelQuestion:
    """The question of ``compare`` and ``diagnose``, from their options and measurements.

    Raises:
        InputError: names the file or option, what is wrong and what would be right.
    """
    for name in free:
        if name not in GEOMETRY:
            raise InputError(f"--free {name}: there is no such geometry", hint=did_you_mean(name, GEOMETRY))
    model = said_model(studio, options)
    return question_of(model, measurements, studio, free=tuple(free), noise=noise, strict=strict)


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
    where = f"--drive {options.drive}"
    return SaidModel(start, _said_length(studio, options), muscle, _drive(options, where), where)


def _said_length(studio: Studio, options: ModelOptions) -> ExperimentValue | None:
    """The rest length that the options state; the default length of a preset is not stated."""
    if options.muscle and not is_file(options.muscle, studio):
        length = options.muscle.partition(":")[2]
        where = f"--muscle {options.muscle}"
    elif options.muscle:
        document = _json(options.muscle)
        length = document.get("nominal_length") if "kind" not in document else None
        where = options.muscle
    elif options.drive:
        muscle = drive_document(options.drive).get("muscle")
        length = muscle.get("nominal_length") if isinstance(muscle, dict) else None
        where = "--drive"
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


def _drive(options: ModelOptions, where: str) -> DriveDocument | None:
    """The drive of a document that has a valve; its muscle and effects are those of the start model."""
    if not options.drive:
        return None
    document = drive_document(options.drive)
    if "valve" not in document:
        return None
    try:
        return read_document({**document, "effects": {}}, options.drive)
    except InputError as error:
        raise at_file(options.drive, error.field, error.message, error.hint) from error
