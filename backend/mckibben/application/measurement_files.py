"""Measurement files named by the user, each with what is said about its experiment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mckibben.application.experiment import SaidMeasurement
from mckibben.documents.experiment import ExperimentInput, stated_experiment
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import FIELDS, ExperimentValue
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.points import POINT_PRESETS, Points, find_preset, is_preset, points_of
from mckibben.measurement.read import Correction, read_measurement, spoken_correction
from mckibben.physics.errors import InputError, did_you_mean

#: How values are named that stand in no file: as options of the command line, or as arguments of Python.
OPTION, ARGUMENT = "--", ""
STANDARD_INPUT = "standard input"  # its name in messages
_MAX_BYTES = 200_000_000
_READING = ("sheet", "head", "column", "ignore")  # of an entry: how its file is read
_LIST_EXAMPLE = '[{"file": "a.csv", "rest_length": "250 mm", "load": "3 kg"}]'


def measurements_of(
    files: Sequence[str],
    studio: Studio,
    correction: Correction | None = None,
    said: Mapping[str, ExperimentValue] | None = None,
    given: Mapping[str, bytes] | None = None,
) -> list[SaidMeasurement]:
    """Files, presets where there is no such file, and lists of files in JSON.

    Args:
        files: names.
        studio: for presets.
        correction: how the files are to be read; it is for files, not for presets.
        said: about the experiment of all of them.
        given: name -> content, of names that are no files: standard input.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    found = []
    for name in files:
        for entry in _entries(name):
            reading = correction or Correction()
            own = dict(said or {})
            if len(entry) > 1:
                reading = _read_as(entry, name, reading)
                own |= _said_in(entry, name)
            found.append(SaidMeasurement(_read(str(entry["file"]), studio, reading, given or {}), own))
    return found


def _holds_readings(document: Any) -> bool:
    """Whether a JSON document is a measurement itself: lists in an object, or objects that name no file."""
    if isinstance(document, dict):
        return any(isinstance(value, list) for value in document.values())
    return isinstance(document, list) and bool(document) and not any(
        isinstance(entry, str) or (isinstance(entry, dict) and "file" in entry) for entry in document
    ) and any(isinstance(entry, (dict, list)) and len(entry) > 1 for entry in document)  # fmt: skip


def _entries(name: str) -> list[dict[str, Any]]:
    """The files of a list in JSON with what it says about each; a single file otherwise.

    Raises:
        InputError: the list cannot be used.
    """
    from mckibben.presets.reading import BadDocumentError, read_file

    if not name.lower().endswith(".json") or not _exists(name):
        return [{"file": name}]
    try:
        document = read_file(Path(name), follow_links=True)
    except BadDocumentError as bad:
        raise InputError(f"{name}: {bad.findings[0].message}", hint=bad.findings[0].hint) from bad
    if is_preset(document) or _holds_readings(document):
        return [{"file": name}]
    if not isinstance(document, list) or not document:
        raise InputError(f"{name}: is no list of measurements", hint=_LIST_EXAMPLE)
    entries = []
    known = ("file", *_READING, *ExperimentInput.model_fields)
    for place, entry in enumerate(document):
        if not isinstance(entry, dict) or not isinstance(entry.get("file"), str):
            raise InputError(f"{name}: entry {place + 1} names no file", hint=_LIST_EXAMPLE)
        for key in entry:
            if key not in known:
                raise InputError(
                    f"{name}: entry {place + 1}: {key} is not known", hint=did_you_mean(str(key), known)
                )
        beside = Path(name).parent / entry["file"]
        entries.append({**entry, "file": str(beside) if beside.exists() else entry["file"]})
    return entries


def _read_as(entry: Mapping[str, Any], source: str, correction: Correction) -> Correction:
    """How the file of an entry is to be read: as the options say, with the entry's own words over them."""
    words = {name: entry[name] for name in _READING if name in entry}
    load = entry.get("load")
    if isinstance(load, Mapping):
        load = load.get("value")
    if not words and load is None:
        return correction
    many = {"column", "ignore"} & words.keys()
    for name in many:
        if not isinstance(words[name], list):
            words[name] = [words[name]]
    spoken = spoken_correction(
        sheet=words.get("sheet"),
        head=words.get("head"),
        columns=words.get("column", ()),
        ignore=words.get("ignore", ()),
        load=load,  # decides the kind of a recording
        prefix=f"{source}: ",
    )
    return Correction(
        columns={**correction.columns, **spoken.columns},
        kind=correction.kind,
        conditions={**correction.conditions, **spoken.conditions},
        skip_bad_rows=correction.skip_bad_rows,
        sheet=spoken.sheet or correction.sheet,
        head=spoken.head or correction.head,
        strict=correction.strict,
    )


def _said_in(entry: Mapping[str, Any], source: str) -> dict[str, ExperimentValue]:
    given = {key: value for key, value in entry.items() if key not in ("file", *_READING)}
    return said_values(given, source)


def said_values(given: Mapping[str, Any], source: str) -> dict[str, ExperimentValue]:
    """The values of an experiment from JSON or options.

    Args:
        given: field -> value.
        source: a file, `OPTION` or `ARGUMENT`, for messages and as the place of the values.

    Raises:
        InputError: a value that cannot be used, naming field or option.
    """
    from pydantic import ValidationError

    from mckibben.documents.problems import first_problem

    try:
        read = ExperimentInput.model_validate(dict(given))
    except ValidationError as error:
        problem = first_problem(error.errors(), ExperimentInput, dict(given), "the experiment")
        name = str(problem.field or "").partition(".")[0]
        raise InputError(f"{_place(name, source)}: {problem.message}", hint=problem.hint) from error
    except InputError as error:
        raise InputError(f"{source or 'experiment'}: {error.message}", hint=error.hint) from error
    try:
        found = stated_experiment(read, source)
    except InputError as error:
        raise InputError(f"{_place('accuracy', source)}: {error.message}", hint=error.hint) from error
    return {
        name: ExperimentValue(
            value.value, value.unit, value.origin, source if _is_file(source) else _place(name, source)
        )
        for name, value in found.items()
    }


def _is_file(source: str) -> bool:
    return source not in (OPTION, ARGUMENT)


def _place(name: str, source: str) -> str:
    """What says a field of the experiment: an option, an argument, or the field of a file."""
    if source == OPTION:
        return option_of(name)
    return f"{source}: {name}" if _is_file(source) else name


def option_of(name: str) -> str:
    """The option that says a field of the experiment."""
    if name not in FIELDS:
        return "--accuracy" if name == "accuracy" else f"--experiment {name}"
    option = FIELDS[name].option.partition(" ")[0]
    return f"--experiment {name}" if option == "--experiment" else option


def _read(name: str, studio: Studio, correction: Correction, given: Mapping[str, bytes]) -> Points:
    """A file, the file of a preset with points, or a preset of the catalogue when there is no such file."""
    if name in given:
        return Points(read_file(name, correction, given[name]))
    preset = _preset_in(name, studio) if _exists(name) else find_preset(name, studio.library)
    if preset is not None:
        if correction.columns or correction.sheet or correction.head:
            raise InputError(
                f"{name}: a preset states how it is read", hint="leave --column, --sheet and the like out"
            )
        return preset
    return Points(read_file(name, correction))


def _document(name: str) -> object:
    """The content of a JSON file; None for everything else."""
    from mckibben.presets.reading import BadDocumentError, read_file

    if not name.lower().endswith(".json") or not _exists(name):
        return None
    try:
        return read_file(Path(name), follow_links=True)
    except BadDocumentError:
        return None  # told when it is read as a measurement


def _preset_in(name: str, studio: Studio) -> Points | None:
    """The points of a preset file; None for a file that is none.

    Raises:
        InputError: a preset that cannot be used, or of a kind without points.
    """
    from mckibben.presets.reading import BadDocumentError, parse

    document = _document(name)
    if not is_preset(document):
        return None
    kind = document["kind"]
    model = POINT_PRESETS.get(kind)
    if model is None:
        raise InputError(
            f"{name}: is a preset of kind '{kind}' and holds no measured points",
            hint=f"a file of kind {', '.join(POINT_PRESETS)}, or a table",
        )
    try:
        return points_of(parse(model, document, studio.effect_table))
    except BadDocumentError as bad:
        finding = bad.findings[0]
        where = f"{name}: {finding.field}" if finding.field else name
        raise InputError(f"{where}: {finding.message}", hint=finding.hint) from bad


def _exists(name: str) -> bool:
    try:
        return Path(name).exists()
    except (OSError, ValueError):  # no name of a file
        return False


def read_file(name: str, correction: Correction, content: bytes | None = None) -> Measurement:
    """The measurement in a file, or in the content that standard input gave.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    path = Path(name)
    try:
        if content is not None:
            return read_measurement(content, STANDARD_INPUT, correction)
        if not path.exists():
            raise InputError(f"{name}: there is no such file", hint=_near_file(path))
        if path.is_dir():
            raise InputError(f"{name}: is a folder", hint=f"name a file in it, e.g. {path / '*.csv'}")
        if path.stat().st_size > _MAX_BYTES:
            raise InputError(f"{name}: is larger than {_MAX_BYTES // 1_000_000} MB", hint="split the file")
        return read_measurement(path.read_bytes(), path.name, correction)
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{name[:200]!r}: cannot be read: {reason}", hint="name a readable file") from error


def _near_file(path: Path) -> str | None:
    folder = path.parent
    if not folder.is_dir():
        return f"there is no folder {folder}"
    names = [entry.name for entry in folder.iterdir() if entry.suffix == path.suffix]
    return did_you_mean(path.name, names)
