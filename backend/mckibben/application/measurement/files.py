"""Measurement files named by the user, each with what is said about its experiment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

from mckibben.application.measurement.experiment import QuestionMeasurement
from mckibben.application.measurement.together import TestFile, read_together
from mckibben.documents.experiment import ExperimentInput, stated_experiment
from mckibben.documents.kinds import refuse_other
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import FIELDS, ExperimentValue
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.points import POINT_PRESETS, Points, find_preset, is_preset, points_of
from mckibben.measurement.preparation import prepared_points, steps_of
from mckibben.measurement.reading import (
    Correction,
    column_names,
    notes_of,
    read_measurement,
    spoken_correction,
)
from mckibben.physics.errors import InputError, did_you_mean

#: How values are named that stand in no file: as options of the command line, or as arguments of Python.
OPTION, ARGUMENT = "--", ""
STANDARD_INPUT = "standard input"  # its name in messages
LARGEST_FILE = 200_000_000  # of a file; more are not even taken into memory
_READING = ("sheet", "head", "column", "ignore")  # of an entry: how its file is read
_PREPARE = "prepare"  # of an entry: the steps that prepare it, instead of those of the options
_LIST_EXAMPLE = '[{"file": "a.csv", "rest_length": "250 mm", "load": "3 kg"}]'

# What may answer a question of the file while it is read.
_CONDITIONS = (
    "force_zero", "pressure_zero", "inclination", "valve", "tube", "stops", "fixed_end", "lever",
    "contraction_at_zero",
)  # fmt: skip


def measurements_of(
    files: Sequence[str],
    studio: Studio,
    correction: Correction | None = None,
    said: Mapping[str, ExperimentValue] | None = None,
    contents: Mapping[str, bytes] | None = None,
    *,
    muscle_length: float | None = None,
    prepare: Sequence[str] = (),
    validation: bool = False,
) -> list[QuestionMeasurement]:
    """Files, presets where there is no such file, and lists of files in JSON.

    Args:
        files: names.
        studio: for presets.
        correction: how the files are to be read; it is for files, not for presets.
        said: about the experiment of all of them.
        contents: name -> content, of names that are no files: standard input.
        muscle_length: rest length of the muscle that is stated beside the files [m], if it is.
        prepare: steps of `mckibben.measurement.preparation` for each file that states none itself.
        validation: whether they are only to judge models by.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    entries = [(name, entry) for name in files for entry in _entries(name)]
    names = [Path(entry.name).name for _, entry in entries]
    ways: list[Correction] = []
    for place, (name, entry) in enumerate(entries):
        others = (*names[:place], *names[place + 1 :])
        way = replace(correction or Correction(), beside=others, muscle_length=muscle_length)
        ways.append(_read_as(entry.words, name, way) if entry.words else way)
    presets = {place: _preset(entry, studio, contents or {}) for place, (_, entry) in enumerate(entries)}
    read = read_together({
        place: _test_file(entry.name, ways[place], contents or {})
        for place, (_, entry) in enumerate(entries)
        if presets[place] is None
    })  # fmt: skip
    found = []
    for place, (name, entry) in enumerate(entries):
        points = presets[place]
        if points is not None and _says_columns(ways[place]):
            raise InputError(
                f"{entry.name}: a preset states how it is read",
                hint="leave --column, --sheet and the like out",
            )
        if points is None:
            if place not in read:
                continue  # notes, which the others were read with
            points = Points(read[place])
        own = dict(said or {}) | (_said_in(entry.words, name) if entry.words else {})
        points = _prepared(points, entry.words.get(_PREPARE), prepare, name)
        found.append(QuestionMeasurement(points, own, validation))
    return found


def _says_columns(correction: Correction) -> bool:
    return bool(correction.columns or correction.sheet or correction.head)


def _prepared(points: Points, own: object, shared: Sequence[str], source: str) -> Points:
    """The points after the steps of their entry, or those of the options.

    Raises:
        InputError: names the file or option, the step, what is wrong and what would be right.
    """
    steps = shared if own is None else [own] if isinstance(own, str) else own
    if not isinstance(steps, Sequence):
        raise InputError(f"{source}: {_PREPARE} is no list of texts", hint='["low pass 20 Hz"]')
    try:
        return prepared_points(points, steps)
    except InputError as error:
        message = error.message if own is None else f"{source}: {error.message}"
        raise InputError(message, field=_PREPARE, hint=error.hint) from error


@dataclass(frozen=True)
class _Entry:
    """One file or preset: its name, what a list says about it, and its document where it is a preset file."""

    name: str
    words: Mapping[str, Any] = field(default_factory=dict)
    preset: dict[str, Any] | None = None


def _holds_readings(document: Any) -> bool:
    """Whether a JSON document is a measurement itself: lists in an object, or objects that name no file."""
    if isinstance(document, dict):
        return any(isinstance(value, list) for value in document.values())
    return isinstance(document, list) and bool(document) and not any(
        isinstance(entry, str) or (isinstance(entry, dict) and "file" in entry) for entry in document
    ) and any(isinstance(entry, (dict, list)) and len(entry) > 1 for entry in document)  # fmt: skip


def _entries(name: str) -> list[_Entry]:
    """The files of a list in JSON with what it says about each; a single file otherwise.

    Raises:
        InputError: the list cannot be used.
    """
    from mckibben.presets.reading import BadDocumentError

    try:
        document = _small_document(name)
    except BadDocumentError as bad:
        raise InputError(f"{name}: {bad.findings[0].message}", hint=bad.findings[0].hint) from bad
    if is_preset(document):
        return [_Entry(name, preset=document)]
    if document is None or _holds_readings(document):
        return [_Entry(name)]
    if not isinstance(document, list) or not document:
        refuse_other(document, name, ("measurement", "export"))
        raise InputError(f"{name}: is no list of measurements", hint=_LIST_EXAMPLE)
    entries = []
    known = ("file", *_READING, _PREPARE, *ExperimentInput.model_fields)
    for place, entry in enumerate(document):
        if not isinstance(entry, dict) or not isinstance(entry.get("file"), str):
            raise InputError(f"{name}: entry {place + 1} names no file", hint=_LIST_EXAMPLE)
        for key in entry:
            if key not in known:
                raise InputError(
                    f"{name}: entry {place + 1}: {key} is not known", hint=did_you_mean(str(key), known)
                )
        beside = Path(name).parent / entry["file"]
        file = str(beside) if beside.exists() else entry["file"]
        try:
            inner = _small_document(file)
        except BadDocumentError:
            inner = None  # told when it is read as a measurement
        words = {key: value for key, value in entry.items() if key != "file"}
        entries.append(_Entry(file, words, inner if is_preset(inner) else None))
    return entries


def _small_document(name: str) -> object:
    """The content of a JSON file that can be a list of files or a preset; None for everything else.

    Raises:
        BadDocumentError: it is not JSON.
    """
    from mckibben.presets.reading import MAX_BYTES, read_file

    path = Path(name)
    if not name.lower().endswith(".json") or not _exists(name) or path.stat().st_size > MAX_BYTES:
        return None
    return read_file(path, follow_links=True)


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
        notes=correction.notes,
        beside=correction.beside,
        muscle_length=correction.muscle_length,
    )


def _said_in(entry: Mapping[str, Any], source: str) -> dict[str, ExperimentValue]:
    values = {key: value for key, value in entry.items() if key not in ("file", *_READING, _PREPARE)}
    return said_values(values, source)


def said_values(values: Mapping[str, Any], source: str) -> dict[str, ExperimentValue]:
    """The values of an experiment from JSON or options.

    Args:
        values: field -> value.
        source: a file, `OPTION` or `ARGUMENT`, for messages and as the place of the values.

    Raises:
        InputError: a value that cannot be used, naming field or option.
    """
    from pydantic import ValidationError

    from mckibben.documents.problems import first_problem

    try:
        read = ExperimentInput.model_validate(dict(values))
    except ValidationError as error:
        problem = first_problem(error.errors(), ExperimentInput, dict(values), "the experiment")
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


def _preset(entry: _Entry, studio: Studio, contents: Mapping[str, bytes]) -> Points | None:
    """The points of a preset file, or of one of the catalogue when there is no such file; None = a table."""
    name = entry.name
    if name in contents:
        return None
    if entry.preset is not None and (preset := _points_in(entry.preset, name, studio)) is not None:
        return preset
    return None if _exists(name) else find_preset(name, studio.library)


def _points_in(document: dict[str, Any], name: str, studio: Studio) -> Points | None:
    """The points of the document of a preset file.

    Raises:
        InputError: a preset that cannot be used, or of a kind without points.
    """
    from mckibben.presets.reading import BadDocumentError, parse

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


def read_file(name: str, correction: Correction, contents: Mapping[str, bytes]) -> Measurement:
    """The measurement in a single file, or in what standard input gave.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    return _test_file(name, correction, contents).read(correction)


def _test_file(name: str, correction: Correction, contents: Mapping[str, bytes]) -> TestFile:
    """A file on disk, or what standard input gave."""
    shown = STANDARD_INPUT if name in contents else Path(name).name
    seldom = cache(lambda: _content(name))
    content = (
        (lambda: _within(contents[name], shown))
        if name in contents
        else (lambda: _content(name))
        if _exists(name) and Path(name).is_file()
        else seldom  # a pipe gives its content once
    )
    return TestFile(
        shown,
        correction,
        lambda how: read_measurement(content(), shown, how),
        lambda: notes_of(content(), shown),
        lambda: column_names(content(), shown, correction),
    )


def _content(name: str) -> bytes:
    path = Path(name)
    try:
        if not path.exists():
            raise InputError(f"{name}: there is no such file", hint=_near_file(path))
        if path.is_dir():
            raise InputError(f"{name}: is a folder", hint=f"name a file in it, e.g. {path / '*.csv'}")
        with path.open("rb") as stream:
            return _within(stream.read(LARGEST_FILE + 1), name)  # pipes and devices do not tell their size
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{name[:200]!r}: cannot be read: {reason}", hint="name a readable file") from error


def _within(content: bytes, name: str) -> bytes:
    if len(content) > LARGEST_FILE:
        raise InputError(f"{name}: is larger than {LARGEST_FILE // 1_000_000} MB", hint="split the file")
    return content


def _near_file(path: Path) -> str | None:
    folder = path.parent
    if not folder.is_dir():
        return f"there is no folder {folder}"
    names = [entry.name for entry in folder.iterdir() if entry.suffix == path.suffix]
    return did_you_mean(path.name, names)


@dataclass(frozen=True)
class FileOptions:
    """What the options say about the files.

    Attributes:
        correction: how they are to be read.
        said: values of the experiment of all measurements.
        prepare: the steps that prepare them.
    """

    correction: Correction
    said: Mapping[str, ExperimentValue]
    prepare: tuple[str, ...] = ()


def file_options(
    *,
    sheet: str | None,
    head: int | None,
    columns: Sequence[str] | None,
    ignored: Sequence[str] | None,
    rest_length: str | float | None,
    load: str | float | None,
    supply: str | float | None,
    accuracy: str | None,
    experiment: Sequence[str] | Mapping[str, object] | None,
    strict: bool,
    prepare: Sequence[str] | None = None,
    prefix: str = OPTION,
) -> FileOptions:
    """What these options say about the files and their experiment.

    Args:
        sheet, head, columns, ignored, rest_length, load, supply, strict: see `spoken_correction`.
        accuracy: standard deviation by channel in words.
        experiment: further fields, as "field=value" or field -> value.
        prepare: steps of `mckibben.measurement.preparation`.
        prefix: of the names in messages, `OPTION` or `ARGUMENT`.

    Raises:
        InputError: names the option, what is wrong and what would be right.
    """
    correction = spoken_correction(
        sheet=sheet,
        head=head,
        columns=columns or (),
        ignore=ignored or (),
        rest_length=rest_length,
        load=load,
        supply=supply,
        strict=strict,
        prefix=prefix,
    )
    options = {"rest_length": rest_length, "load": load, "supply": supply, "accuracy": accuracy}
    values = _experiment(experiment or (), prefix)
    values |= {name: value for name, value in options.items() if value is not None}
    said = said_values(values, prefix)
    conditions = dict(correction.conditions)
    conditions |= {name: said[name].value for name in _CONDITIONS if name in said}
    if accuracy is not None:
        conditions["accuracy"] = accuracy
    steps = tuple(prepare or ())
    checked_steps(steps, prefix)
    return FileOptions(replace(correction, conditions=conditions), said, steps)


def checked_steps(steps: Sequence[str], prefix: str) -> None:
    """Check how the steps of a preparation are written, before a file is read.

    Raises:
        InputError: names the option, the step, what is wrong and what would be right.
    """
    try:
        steps_of(steps)
    except InputError as error:
        raise InputError(f"{prefix}{error.message}", field=_PREPARE, hint=error.hint) from error


def _experiment(stated: Sequence[str] | Mapping[str, object], prefix: str) -> dict[str, object]:
    """Field -> value of the further fields."""
    if isinstance(stated, Mapping):
        for name in stated:
            _check_field(str(name), f"{prefix}experiment {name!r}")
        return dict(stated)
    values: dict[str, object] = {}
    for text in stated:
        where = f"{prefix}experiment {text!r}"
        name, separator, value = (part.strip() for part in text.partition("="))
        if not separator or not value:
            raise InputError(
                f"{where}: is not 'field=value'", hint=f'e.g. {prefix}experiment "force_zero=2.5 N"'
            )
        _check_field(name, where)
        values[name] = value
    return values


def _check_field(name: str, where: str) -> None:
    if name not in ExperimentInput.model_fields:
        raise InputError(
            f"{where}: there is no field '{name}'", hint=did_you_mean(name, ExperimentInput.model_fields)
        )
