"""Options shared by several commands, and their conversion."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, cast

import typer

from mckibben.cli.drive_file import drive_document
from mckibben.physics.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from mckibben.documents.start_model import StartModel
    from mckibben.documents.studio import Studio

MuscleText = Annotated[
    str,
    typer.Option(
        metavar="M",
        help="A preset (DMSP-20), also with a length (DMSP-20:300mm), or a JSON file.",
        show_default=False,
    ),
]
DataFiles = Annotated[
    list[str],
    typer.Argument(metavar="DATA...", help="Measurement files, or ids of preset measurements and curves."),
]
Ideal = Annotated[bool, typer.Option("--ideal", help="The ideal model: no effects.")]
EffectIds = Annotated[
    list[str] | None,
    typer.Option("--effect", metavar="ID", help="Use it instead of the effects of the preset; repeatable."),
]
Free = Annotated[
    list[str] | None,
    typer.Option("--free", metavar="NAME", help="Geometry to fit as well, e.g. braid_angle; repeatable."),
]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON object on stdout.")]
PresetsFolder = Annotated[
    Path | None, typer.Option("--presets", metavar="DIR", help="Folder of your own presets.")
]
EffectsFolders = Annotated[
    list[Path] | None,
    typer.Option("--effects", metavar="DIR", help="Folder of your own effect files (Python); repeatable."),
]
DataFolder = Annotated[
    Path | None, typer.Option("--data", metavar="DIR", help="Where measurements and saved presets are kept.")
]


Effects = dict[str, dict[str, float | str]]


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """The options that name a model.

    Attributes:
        muscle: of ``--muscle``, "" without it.
        ideal: ``--ideal``: no effects.
        effects: ids of ``--effect``.
        drive: path of ``--drive``, "" without it; its muscle and effects are used where the others name none.
    """

    muscle: str
    ideal: bool = False
    effects: Sequence[str] = ()
    drive: str = ""


@dataclass(frozen=True, slots=True)
class Folders:
    """Folders of presets, effects and data."""

    user_presets: Path
    effects: tuple[Path, ...]
    data: Path


def folders(presets: Path | None, effects: Sequence[Path] | None, data: Path | None) -> Folders:
    """The folders of the options; those not named are in the user's data folder.

    Raises:
        InputError: a named folder is not a folder.
    """
    from mckibben.resources import user_folder

    for option, folder in (("--presets", presets), *(("--effects", path) for path in effects or [])):
        if folder is not None and not folder.is_dir():
            what = "is not a folder" if folder.exists() else "does not exist"
            raise InputError(f"{option} {folder}: {what}", hint="name an existing folder")
    if data is not None and data.exists() and not data.is_dir():
        raise InputError(f"--data {data}: is not a folder", hint="name a folder")
    data = data or user_folder()
    return Folders(presets or data / "presets", tuple(effects or ()), data)


def open_studio(presets: Path | None, effects: Sequence[Path] | None, data: Path | None) -> Studio:
    """Presets and effects for a command that runs without a server."""
    from mckibben.cli.problems import tell_problems
    from mckibben.documents.studio import Studio
    from mckibben.resources import presets_folder

    chosen = folders(presets, effects, data)
    with redirect_stdout(sys.stderr):  # what an effect file prints when it is loaded is no answer
        studio = Studio(presets=presets_folder(), user_presets=chosen.user_presets, effects=chosen.effects)
    tell_problems(studio, chosen.user_presets)
    return studio


def start_model(
    studio: Studio, options: ModelOptions, *, named: str = "", rest_length: float | None = None
) -> StartModel:
    """The muscle and effects of the options; without a muscle, the one that a measurement names.

    Where nothing else gives the length of the muscle, it is the rest length of the measurement [m].

    Raises:
        InputError: names the file or option, what is wrong and what would be right.
    """
    if options.ideal and options.effects:
        raise InputError("--ideal and --effect exclude each other", hint="use one of them")
    for effect in options.effects:
        if effect not in studio.catalogue:
            raise InputError(
                f"--effect {effect}: there is no such effect", hint=did_you_mean(effect, studio.catalogue)
            )
    document = drive_document(options.drive) if options.drive else {}
    chosen: Effects | None = {} if options.ideal else {effect: {} for effect in options.effects} or None
    if chosen is None and "effects" in document:
        chosen = cast(Effects, document["effects"])
    if not options.muscle and "muscle" in document:
        return _start_of_input(studio, _with_length(document["muscle"], rest_length), chosen, options.drive)
    muscle = options.muscle or named
    name, separator, length = muscle.partition(":")
    if not name:
        raise InputError("--muscle is missing", hint="e.g. --muscle DMSP-20:300mm")
    if is_file(muscle, studio):
        return _start_of_file(studio, Path(muscle), chosen, rest_length)
    document: dict[str, object] = {"preset": name}
    if separator:
        document["nominal_length"] = length
    return _start_of_input(studio, _with_length(document, rest_length), chosen, f"--muscle {muscle}")


def _with_length(document: object, rest_length: float | None) -> object:
    """A muscle of a document, with this length where it has none."""
    if not isinstance(document, dict) or rest_length is None or "nominal_length" in document:
        return document
    return {**document, "nominal_length": rest_length}


def is_file(muscle: str, studio: Studio) -> bool:
    """Whether it names a JSON file; a preset id with a slash, or a file named like a preset, does not."""
    if muscle.lower().endswith(".json"):
        return True
    known = {preset.id.lower() for preset in studio.library.list("muscles")}
    return muscle.partition(":")[0].lower() not in known and Path(muscle).exists()


def _start_of_file(
    studio: Studio, path: Path, effects: Effects | None, rest_length: float | None
) -> StartModel:
    """A muscle by geometry, or a whole preset file."""
    from mckibben.documents.start_model import StatedMuscle, preset_facts, start_model
    from mckibben.presets import MusclePreset
    from mckibben.presets.reading import BadDocumentError, parse, read_file

    try:
        document = read_file(path, follow_links=True)
        if not isinstance(document, dict) or "kind" not in document:
            return _start_of_input(studio, _with_length(document, rest_length), effects, str(path))
        preset = parse(MusclePreset, document, studio.effect_table)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        where = f"{path}: {finding.field}" if finding.field else str(path)
        raise InputError(f"{where}: {finding.message}", hint=finding.hint) from bad
    assert isinstance(preset, MusclePreset)  # noqa: S101 - parsed as one
    preset.adopt("user", studio.effect_table)
    facts = preset_facts(preset, studio.catalogue)
    try:
        return _usable(studio, start_model(StatedMuscle(), effects, preset=facts, catalogue=studio.catalogue))
    except InputError as error:
        raise at_file(str(path), error.field, error.message, error.hint) from error


def _usable(studio: Studio, start: StartModel) -> StartModel:
    """The same, after checking that a model can be built; here an error can name the file."""
    studio.static_model(start)
    return start


def _start_of_input(studio: Studio, document: object, effects: Effects | None, source: str) -> StartModel:
    from pydantic import ValidationError

    from mckibben.documents.convert import stated_muscle
    from mckibben.documents.muscle import MuscleInput
    from mckibben.documents.problems import first_problem

    try:
        muscle = stated_muscle(MuscleInput.model_validate(document))
        return _usable(studio, studio.start_model(muscle, effects))
    except ValidationError as error:
        problem = first_problem(error.errors(), MuscleInput, document, "the muscle")
        raise at_file(source, problem.field, problem.message, problem.hint) from error
    except InputError as error:
        raise at_file(
            source, (error.field or "").removeprefix("muscle."), error.message, error.hint
        ) from error


def at_file(source: str, field: str | None, message: str, hint: str | None) -> InputError:
    """The error with the name of the file in front."""
    return InputError(f"{source}: {located(field, message).removesuffix('.')}", hint=hint)


def located(field: str | None, message: str) -> str:
    """The message with its field in front, unless the message names the field already."""
    if (
        not field
        or field in message.replace("'", "")
        or field.rpartition(".")[2].replace("_", " ") in message
    ):
        return message
    return f"{field}: {message}"
