"""Options shared by several commands, and their conversion."""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, cast

import typer

from mckibben.documents.model_files import drive_document, saved_model
from mckibben.documents.muscle_files import (
    Effects,
    NamedEffects,
    is_file,
    start_of_file,
    start_of_input,
    with_length,
)
from mckibben.physics.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from mckibben.application.measurement.files import FileOptions
    from mckibben.documents.start_model import StartModel
    from mckibben.documents.studio import Studio
    from mckibben.presets import DesignPreset

MuscleText = Annotated[
    str,
    typer.Option(
        metavar="M",
        help="A preset (DMSP-20), also with a length (DMSP-20:300mm), a JSON file, or an example design.",
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
    typer.Option(
        "--effect",
        metavar="ID",
        help="Use it instead of the effects of preset or document, with its numbers there; repeatable.",
    ),
]
Free = Annotated[
    list[str] | None,
    typer.Option(
        "--free",
        metavar="NAME",
        help="What to fit as well: geometry (braid_angle), EFFECT.CONSTANT, or the start of runs (start); "
        "repeatable.",
    ),
]
SavedModelFile = Annotated[
    str,
    typer.Option("--model", metavar="FILE", help="A model that 'diagnose --save' wrote; others override it."),
]
Sheet = Annotated[
    str | None, typer.Option("--sheet", metavar="NAME", help="Sheet, group or struct with the measurement.")
]
Head = Annotated[
    int | None, typer.Option("--head", metavar="ROW", help="Row of the column names, counted from 1.")
]
Columns = Annotated[
    list[str] | None,
    typer.Option(
        "--column",
        metavar="C=NAME",
        help='What a column is, e.g. "force=-Kraft [kN]": sign and unit; repeatable.',
    ),
]
Ignored = Annotated[
    list[str] | None,
    typer.Option("--ignore", metavar="NAME", help="A column that is not wanted; repeatable."),
]
RestLength = Annotated[
    str | None,
    typer.Option("--rest-length", help='Length of the muscle without air and load, e.g. "300 mm".'),
]
Load = Annotated[str | None, typer.Option("--load", help='Mass or force on the muscle, e.g. "6 kg".')]
Supply = Annotated[str | None, typer.Option("--supply", help='Supply pressure, gauge, e.g. "6 bar".')]
Accuracy = Annotated[
    str | None,
    typer.Option(
        "--accuracy", help='Standard deviation by channel, e.g. "length 1 mm, force 0.5 %", or a sensor.'
    ),
]
Experiment = Annotated[
    list[str] | None,
    typer.Option(
        "--experiment",
        metavar="FIELD=VALUE",
        help='More about the test, e.g. "force_zero=2.5 N" or "inclination=45 deg"; repeatable.',
    ),
]
Prepare = Annotated[
    list[str] | None,
    typer.Option(
        "--prepare",
        metavar="STEP",
        help='"range time 2 s to 10 s", "detrend force", "low pass 20 Hz" or "resample 100 Hz"; repeatable, '
        "in this order.",
    ),
]
Validate = Annotated[
    list[str] | None,
    typer.Option(
        "--validate", metavar="FILE", help="A file to check the model on, not fitted to; repeatable."
    ),
]
Strict = Annotated[
    bool, typer.Option("--strict", help="Refuse a file instead of assuming what it does not say.")
]
Use = Annotated[
    list[str] | None,
    typer.Option("--use", metavar="HYPOTHESIS", help="An entry that is wrong as stated: use what fits."),
]
Keep = Annotated[
    list[str] | None,
    typer.Option("--keep", metavar="HYPOTHESIS", help="An entry that is right as stated: do not ask."),
]


def _formats() -> str:
    """The formats of `mckibben.export`, one file each, without importing them."""
    folder = Path(__file__).parents[1] / "export" / "formats"
    return ", ".join(sorted(file.stem for file in folder.glob("*.py") if not file.stem.startswith("_")))


Exported = Annotated[
    str,
    typer.Argument(
        metavar="MODEL", help="A drive document, a saved model or a muscle (JSON file), or a preset."
    ),
]
ExportFormat = Annotated[str, typer.Option("--as", metavar="FORMAT", help=f"One of: {_formats()}.")]
ExportFile = Annotated[
    Path, typer.Option("--out", "-o", metavar="FILE", help="Several files stand beside it, or in it if .zip.")
]
DriveFile = Annotated[
    str, typer.Argument(metavar="DRIVE", help="A drive document (JSON file) or the id of a preset.")
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
ProjectsAddress = Annotated[
    str,
    typer.Option(
        "--projects",
        metavar="URL",
        envvar="MCKIBBEN_PROJECTS",
        help="Database of the projects, e.g. postgresql://user@host/name; default: in the data folder.",
        show_default=False,
    ),
]


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """The options that name a model.

    Attributes:
        muscle: of ``--muscle``, "" without it.
        ideal: ``--ideal``: no effects.
        effects: ids of ``--effect``.
        drive: path of ``--drive``, "" without it; its muscle and effects are used where the others name none.
        use, keep: of ``--use`` and ``--keep``: decisions about entries that may be wrong.
        model: path of ``--model``, "" without it: a saved model; its muscle and effects come before those of
            ``--drive``, and its drive is used without one.
    """

    muscle: str
    ideal: bool = False
    effects: Sequence[str] = ()
    drive: str = ""
    use: Sequence[str] = ()
    keep: Sequence[str] = ()
    model: str = ""


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


def open_studio(
    presets: PresetsFolder = None, effects: EffectsFolders = None, data: DataFolder = None
) -> Studio:
    """Presets and effects for a command that runs without a server."""
    from mckibben.documents.studio import Studio, unused_files
    from mckibben.resources import presets_folder

    chosen = folders(presets, effects, data)
    with redirect_stdout(sys.stderr):  # what an effect file prints when it is loaded is no answer
        studio = Studio(presets=presets_folder(), user_presets=chosen.user_presets, effects=chosen.effects)
    for sentence in unused_files(studio, chosen.user_presets):
        typer.echo(sentence, err=True)
    return studio


def reading(
    sheet: Sheet = None,
    head: Head = None,
    column: Columns = None,
    ignore: Ignored = None,
    rest_length: RestLength = None,
    load: Load = None,
    supply: Supply = None,
    accuracy: Accuracy = None,
    experiment: Experiment = None,
    prepare: Prepare = None,
    strict: Strict = False,
) -> FileOptions:
    """How measurement files are to be read, and what is said about their experiment."""
    from mckibben.application.measurement.files import file_options

    return file_options(
        sheet=sheet, head=head, columns=column, ignored=ignore, rest_length=rest_length, load=load,
        supply=supply, accuracy=accuracy, experiment=experiment, strict=strict, prepare=prepare,
    )  # fmt: skip


#: Parameter of a command -> what makes its value from the options that it stands for.
_SHARED: dict[str, Callable[..., object]] = {"reading": reading, "studio": open_studio}


def with_shared_options(command: Callable[..., None]) -> Callable[..., None]:
    """A command for typer: options of its own, and those that ``reading`` and ``studio`` stand for."""
    # Their types are known to type checkers only: importing them takes as long as some commands do.
    types = {"FileOptions": object, "Studio": object}
    shared = {
        name: inspect.signature(_SHARED[name], eval_str=True, locals=types).parameters.values()
        for name in inspect.signature(command).parameters
        if name in _SHARED
    }

    def run(**options: object) -> None:
        for name, parts in shared.items():
            options[name] = _SHARED[name](**{part.name: options.pop(part.name) for part in parts})
        command(**options)

    own = inspect.signature(command, eval_str=True, locals=types).parameters.values()
    parts = [part for each in own for part in shared.get(each.name, (each,))]
    functools.update_wrapper(run, command)
    run.__annotations__ = {}
    run.__signature__ = inspect.Signature(  # type: ignore - typer reads it
        [part.replace(kind=inspect.Parameter.KEYWORD_ONLY) for part in parts]
    )
    return run


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
    document, source = stated_model(options, studio)
    stated = cast("Effects | None", document.get("effects"))
    for effect in options.effects:
        if effect not in studio.catalogue and effect not in (stated or {}):
            raise InputError(
                f"--effect {effect}: there is no such effect", hint=did_you_mean(effect, studio.catalogue)
            )
    chosen = _chosen(options, stated)
    if not options.muscle and "muscle" in document:
        start = start_of_input(studio, with_length(document["muscle"], rest_length), chosen, source)
        if not options.model:
            if chosen is None and "valve" in document:
                from mckibben.documents.drive_reading import read_document, with_effects_of_parts

                start = with_effects_of_parts(start, read_document(document, source), studio)
            return start
        from mckibben.documents.saved_model import with_record

        return with_record(start, saved_model(options.model), studio)
    muscle = options.muscle or named
    if not muscle.partition(":")[0]:
        raise InputError("--muscle is missing", hint="e.g. --muscle DMSP-20:300mm")
    if is_file(muscle, studio):
        return start_of_file(studio, Path(muscle), chosen, rest_length)
    example = example_design(muscle, studio)
    if example is not None:
        of_example = cast("Effects | None", example.document.get("effects"))
        return start_of_input(
            studio, example.document["muscle"], _chosen(options, of_example), f"--muscle {muscle}"
        )
    return start_of_input(studio, with_length(muscle, rest_length), chosen, f"--muscle {muscle}")


def example_design(muscle: str, studio: Studio) -> DesignPreset | None:
    """The example design that --muscle names; None where it names something else."""
    if muscle not in {preset.id for preset in studio.library.list("designs")}:
        return None
    return cast("DesignPreset", studio.library.get("designs", muscle))


def stated_model(options: ModelOptions, studio: Studio) -> tuple[dict[str, object], str]:
    """Muscle and effects of ``--model`` or ``--drive`` as documents, and the file that states them.

    Raises:
        InputError: the file cannot be used.
    """
    if options.model:
        saved = saved_model(options.model).to_document()
        return {"muscle": saved["muscle"], "effects": saved["effects"]}, options.model
    return (drive_document(options.drive, studio) if options.drive else {}), options.drive


def _chosen(options: ModelOptions, stated: Effects | None) -> Effects | NamedEffects | None:
    """Effects of the options; None are those of the preset, named ones get the numbers of the preset."""
    if options.ideal:
        return {}
    if stated is None:
        return NamedEffects(tuple(options.effects)) if options.effects else None
    return NamedEffects(tuple(options.effects)).of(stated) if options.effects else stated
