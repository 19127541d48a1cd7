"""The experiment behind each measurement of a question: what is said, what contradicts, what is assumed.

Every door states the same: a model (`QuestionModel`) and measurements (`QuestionMeasurement`). A value is
taken from the first of: the user's word for this measurement, the file, muscle or drive of the request, an
assumption. The rest length is the exception: a file and a muscle of which both state one must agree.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from mckibben.application.compare.specimens import Specimen, Specimens, specimens_of
from mckibben.application.measurement.rig_drive import drive_values, own_document, own_drive, passed_stop
from mckibben.documents.drive import DriveDocument
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.measurement.accuracy import CHANNELS, ChannelAccuracy, default_accuracy, sigma_of
from mckibben.measurement.experiment import (
    ACCURACY,
    FIELDS,
    FROM_DRIVE,
    LOAD_FORCE,
    Experiment,
    ExperimentValue,
    corrected,
    file_experiment,
    mattering,
    needed,
    shown_value,
)
from mckibben.measurement.measurement import UNIT_OF, Measurement, StatedValue
from mckibben.measurement.points import Points
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle

_SAME_LENGTH = 1e-3  # relative; rest lengths that differ by less are the same
_ONE_MUSCLE = 0.02  # relative; a fit may change a rest length by as much, so this is no contradiction
#: Question of a file -> field that answers it, whoever says it.
_ANSWERS = {
    "rest length": "rest_length", "load": "load", "supply": "supply", "zero of force": "force_zero",
}  # fmt: skip
#: Zero errors of the sensors where several specimens are mounted one after the other.
_REMOUNTED = {
    "length": ChannelAccuracy(0.5e-3, "m"),
    "force": ChannelAccuracy(0.002, "1"),
    "pressure": ChannelAccuracy(1e3, "Pa"),
}


@dataclass(frozen=True, slots=True)
class Assumption:
    """A value that a test of this kind needs, that nobody said, and that was assumed.

    Attributes:
        field: of the experiment; "unit of time" of a column.
        words: what is assumed, "a rest length of 300 mm, the preset's".
        option: what says otherwise on the command line.
        files: names of the measurements; empty for all.
    """

    field: str
    words: str
    option: str
    files: tuple[str, ...] = ()

    @property
    def sentence(self) -> str:
        """For the verdict."""
        return f"Assuming {self.words}{self._files}."

    @property
    def message(self) -> str:
        """For the beginning of an answer."""
        return f"assuming {self.words}{self._files}: {self.option} says otherwise"

    @property
    def _files(self) -> str:
        return f" for {', '.join(self.files)}" if self.files else ""


def assumptions_of(tests: Sequence[tuple[Measurement, Experiment]]) -> tuple[Assumption, ...]:
    """What is assumed of several measurements; the same words are said once.

    Args:
        tests: each measurement with its experiment.
    """
    found: dict[tuple[str, str], list[str]] = {}
    for measurement, values in tests:
        for name, words in _assumed(measurement, values):
            found.setdefault((name, words), []).append(measurement.name)
    result = []
    for (name, words), files in found.items():
        if name.startswith(UNIT_OF):
            option = "--column"
        else:
            option = "--accuracy" if name.startswith(ACCURACY) else FIELDS[name].option.split(" ")[0]
        if option == "--experiment":
            option = f'--experiment "{name}=..."'
        result.append(Assumption(name, words, option, () if len(files) == len(tests) else tuple(files)))
    return tuple(result)


def refuse_assumptions(
    measurement: Measurement, values: Experiment, field: Callable[[str], str | None]
) -> None:
    """Refuse a measurement of which something would be assumed.

    Args:
        measurement: the data.
        values: its experiment.
        field: path of a field of the experiment in the request.

    Raises:
        InputError: the first thing that is not stated, with what states it.
    """
    for name, words in _assumed(measurement, values):
        if name.startswith(UNIT_OF):
            raise InputError(
                f"{measurement.name}: the {name} is not stated (without --strict: {words})",
                hint=f'--column "{name.removeprefix(UNIT_OF)}=... [unit]"',
            )
        declared = FIELDS[name]
        raise InputError(
            f"{measurement.name}: {declared.title.lower()} is not stated (without --strict: {words})",
            field=field("accuracy" if name.startswith(ACCURACY) else name),
            hint=declared.option,
        )


def _assumed(measurement: Measurement, values: Experiment) -> list[tuple[str, str]]:
    """(field, words) of what a test of this kind needs and nobody said."""
    words = [
        (one.key, f"{one.value} as the unit of {one.where}")
        for one in measurement.stated
        if one.key.startswith(UNIT_OF) and one.origin == "assumed"
    ]
    for name in needed(measurement.kind, measurement.columns):
        value = values.get(name)
        if value is None:
            if name == "load" and measurement.kind == "isotonic":
                words.append((name, "nothing about the load, which is not stated and is fitted"))
        elif value.origin == "assumed":
            words.append((name, _in_words(name, value)))
    accuracies = [
        f"{shown_value(channel, value).partition(' of ')[0]} of {channel}"
        for channel in CHANNELS
        if (value := values.get(f"{ACCURACY}{channel}")) is not None and value.origin == "assumed"
    ]
    if accuracies:
        words.append((f"{ACCURACY}length", f"readings accurate to {' and '.join(accuracies)}"))
    return words


def _in_words(name: str, value: ExperimentValue) -> str:
    if name == "load":
        return "no load"
    whose = ", the preset's" if value.where.startswith("the preset") else ""
    return f"a {FIELDS[name].title.lower()} of {shown_value(name, value)}{whose}"


@dataclass(frozen=True)
class QuestionModel:
    """Muscle, effects and drive as they were stated.

    Attributes:
        start: the start model; takes the rest length of the measurement, used where nothing else gives one.
        length: rest length of the muscle, if it was said; the default length of a preset is not.
        muscle: name of the muscle, if it was said.
        drive: the drive document.
        where: name of the drive document in origins and errors.
        keep_length: whether the stated rest length holds, whatever the data of the model have shown.
    """

    start: Callable[[str, float | None], StartModel]
    length: ExperimentValue | None = None
    muscle: ExperimentValue | None = None
    drive: DriveDocument | None = None
    where: str = "drive"
    keep_length: bool = False


@dataclass(frozen=True)
class QuestionMeasurement:
    """A measurement and what the user says about its experiment.

    Attributes:
        points: the data.
        said: by the user; takes precedence over the file.
        validation: whether models are only judged by it.
        field: its path in the request, "." of the request itself, "" on the command line.
    """

    points: Points
    said: Experiment = field(default_factory=dict)
    validation: bool = False
    field: str = ""


@dataclass(frozen=True)
class Resolved:
    """The question behind what was stated.

    Attributes:
        start: the start model, with the rest length of the first measurement.
        specimens, validation: the measurements with their experiments.
        assumptions: what was assumed.
        remarks: further notes for the user.
    """

    start: StartModel
    specimens: Specimens
    validation: Specimens | None
    assumptions: tuple[Assumption, ...]
    remarks: tuple[str, ...]


@dataclass
class _One:
    """One measurement while its experiment is put together."""

    said: QuestionMeasurement
    values: dict[str, ExperimentValue]
    remarks: list[str] = field(default_factory=list)

    @property
    def measurement(self) -> Measurement:
        return self.said.points.measurement

    def at(self, name: str) -> str | None:
        """Path of a field in the request."""
        if not self.said.field:
            return None
        return f"{self.said.field}.experiment.{name}".removeprefix("..")


def stated_in(points: Points) -> dict[str, ExperimentValue]:
    """What a measurement states about its experiment; the conditions of a preset are the preset's."""
    measurement = points.measurement
    if measurement.stated or not measurement.conditions:
        found = file_experiment(measurement.stated)
    else:
        conditions = [StatedValue(key, value, "file", "") for key, value in measurement.conditions.items()]
        found = file_experiment(conditions)
    if points.source:
        found = {
            name: replace(value, origin="preset", where=measurement.name) for name, value in found.items()
        }
    if points.nominal_length is not None and "rest_length" not in found:
        found["rest_length"] = ExperimentValue(points.nominal_length, "m", "preset", measurement.name)
    return found


def resolved(
    model: QuestionModel, measurements: Sequence[QuestionMeasurement], studio: Studio, *, strict: bool = False
) -> Resolved:
    """The experiment of every measurement, and the start model.

    Raises:
        InputError: two statements that contradict each other, a value that nobody stated and that cannot be
            assumed, or with ``strict`` any that would be.
    """
    ones = [_One(each, stated_in(each.points) | dict(each.said)) for each in measurements]
    first = next(one for one in ones if not one.said.validation)
    named = str(first.values["muscle"].value) if "muscle" in first.values else ""
    start = model.start(named, _number(first.values.get("rest_length")))
    for one in ones:
        one.values["rest_length"] = _rest_length(one, model, start, alone=len(ones) == 1)
        _name_muscle(one, model, start)
        _tell_unused(one)
    length = float(first.values["rest_length"].value)
    if abs(float(start.muscle.nominal_length) - length) > 1e-12 * length:
        start = replace(start, muscle=start.muscle._replace(nominal_length=length), stated={})
    for one in ones:
        _add_accuracy(one)
        for name, value in drive_values(one.measurement, one.values, model.drive, start).items():
            one.values.setdefault(name, value)
    assumptions = assumptions_of([(one.measurement, one.values) for one in ones])
    if strict:
        for one in ones:
            refuse_assumptions(one.measurement, one.values, one.at)
    specimens = [_specimen(one, model, start, studio) for one in ones]
    for one in ones:
        if (passed := passed_stop(one.measurement, one.values, start.muscle.nominal_length)) is not None:
            one.remarks.append(passed)
    used = [each for each, one in zip(specimens, ones, strict=True) if not one.said.validation]
    judged = [each for each, one in zip(specimens, ones, strict=True) if one.said.validation]
    several = specimens_of(_with_zeros(used), start.muscle)
    remarks = tuple(dict.fromkeys(remark for one in ones for remark in one.remarks))
    return Resolved(
        start, several, specimens_of(judged, start.muscle) if judged else None, assumptions, remarks
    )


def _number(value: ExperimentValue | None) -> float | None:
    return None if value is None else float(value.value)


def _shown(value: float) -> str:
    return f"{1e3 * value:.4g} mm"


def _found_instead(
    own: ExperimentValue | None, model: QuestionModel, start: StartModel
) -> ExperimentValue | None:
    """The rest length that the data of a fitted model have shown, where the one they corrected is stated.

    With a saved model that is so also where the user types it again, with a preset where a file states it.
    """
    said, corrected = model.length, start.corrected_length
    if own is None or corrected is None or model.keep_length:
        return None
    if abs(float(own.value) - corrected) > _SAME_LENGTH * corrected:
        return None
    if start.stated or start.preset is None:
        return said
    length = float(start.preset.muscle.nominal_length)
    if own.origin != "file" or (said is not None and abs(float(said.value) - length) > _SAME_LENGTH * length):
        return None
    return ExperimentValue(length, "m", "preset", f"the preset {start.preset.id}")


def _rest_length(one: _One, model: QuestionModel, start: StartModel, *, alone: bool) -> ExperimentValue:
    """The rest length of a measurement.

    Raises:
        InputError: file and muscle state different ones, and the user decides for neither.
    """
    own, name = one.values.get("rest_length"), one.measurement.name
    said = model.length
    found = _found_instead(own, model, start)
    if own is not None and found is not None:
        one.remarks.append(
            f"rest length: {_shown(float(own.value))} was stated for the data of the model, too, "
            f"which showed {_shown(float(found.value))}: that is taken here as well; "
            "'--keep rest_length' takes what is stated"
        )
        return found
    if own is not None and own.origin in ("you", "suggested"):
        return own
    if own is None:
        if said is not None:
            return said
        preset = start.preset
        where = "" if preset is None else f"the preset {preset.id}"
        return ExperimentValue(float(start.muscle.nominal_length), "m", "assumed", where)
    if said is None:
        return own
    mine, theirs = float(said.value), float(own.value)
    apart = abs(mine - theirs) / theirs
    if apart <= _SAME_LENGTH:
        return own
    place = own.where.removeprefix(name).removeprefix(", ")
    at = f" ({place})" if place else ""
    both = f"{name} says a rest length of {_shown(theirs)}{at}, {said.where} says {_shown(mine)}"
    if own.origin == "file" and apart > _ONE_MUSCLE:
        raise InputError(
            both,
            field=one.at("rest_length"),
            hint=f'decide with --rest-length "{_shown(theirs)}" or --rest-length "{_shown(mine)}"'
            if alone
            else "leave the length of the muscle out: each file has its own; or decide with --rest-length",
        )
    one.remarks.append(f"{both}: the latter is taken; --rest-length decides")
    return said


def _name_muscle(one: _One, model: QuestionModel, start: StartModel) -> None:
    """The muscle of a measurement: the user's word for it, that of the request, else the file's."""
    own = one.values.get("muscle")
    if model.muscle is None or (own is not None and own.origin in ("you", "suggested")):
        if own is None:
            name = "by its geometry" if start.preset is None else start.preset.id
            one.values["muscle"] = ExperimentValue(name, "", "you", "")
        return
    if own is not None and start.preset is not None:
        other = str(own.value).partition(":")[0].upper()
        if other.startswith(("DMSP-", "MAS-")) and other != start.preset.id.upper():
            one.remarks.append(
                f"{one.measurement.name} names the muscle {own.value}, {model.muscle.where} "
                f"{start.preset.id}: the latter is taken"
            )
    one.values["muscle"] = model.muscle


def _tell_unused(one: _One) -> None:
    """A remark on what the user states and a test of this kind has no use for."""
    measurement = one.measurement
    used = set(mattering(measurement.kind, measurement.columns))
    if measurement.kind == "transient":  # its channels are weighed by their noise
        used -= {name for name in used if name.startswith(ACCURACY)}
    for name, value in one.values.items():
        if value.origin in ("you", "suggested") and name not in used and name != LOAD_FORCE:
            title = FIELDS[name].title.lower()
            one.remarks.append(
                f"{measurement.name}: {title} ({shown_value(name, value)}) is stated, but not used in this "
                f"{measurement.kind} test"
            )


def _add_accuracy(one: _One) -> None:
    """The accuracies that are assumed where nobody says any."""
    for channel, accuracy in default_accuracy(one.measurement).items():
        value = ExperimentValue(accuracy.value, accuracy.unit, "assumed", "usual for readings at rest")
        one.values.setdefault(f"{ACCURACY}{channel}", value)


def _specimen(one: _One, model: QuestionModel, start: StartModel, studio: Studio) -> Specimen:
    points, values = one.said.points, one.values
    measurement = corrected(points.measurement, values)
    answered = {
        f"{question.text} ({question.option})"
        for question in measurement.questions
        if _ANSWERS.get(question.about) in values
    }
    if answered:
        kept = tuple(message for message in measurement.messages if message not in answered)
        measurement = replace(measurement, messages=kept)
    muscle = _own_geometry(one, start, studio)
    length = float(values["rest_length"].value)
    accuracy = {
        channel: sigma_of(ChannelAccuracy(float(value.value), value.unit), channel, measurement, length)
        for channel in CHANNELS
        if (value := values.get(f"{ACCURACY}{channel}")) is not None
    }
    own, where = replace(start, muscle=muscle), "" if model.drive is None else model.where
    try:
        document = own_document(measurement, values, model.drive, own, where)
        drive = own_drive(measurement, values, document, own, studio, where)
    except InputError as error:
        raise _of_statement(error, one) from error
    ordered = {name: values[name] for name in (*FIELDS, LOAD_FORCE) if name in values}
    return Specimen(
        replace(points, measurement=measurement, nominal_length=length),
        muscle,
        drive,
        ordered,
        accuracy,
        document=document,
    )


def _of_statement(error: InputError, one: _One) -> InputError:
    """An error of the drive at the statement that it comes from, if it comes from one."""
    path = (error.field or "").removeprefix("drive.").split(".")
    name = "inclination" if path[-1] == "inclination" else path[0]
    value = one.values.get(name)
    if value is None or value.origin == "assumed" or value.where == FROM_DRIVE:
        return error
    if one.said.field:
        return error.at(one.at(name))
    return InputError(f"{value.where}: {error.message}", hint=error.hint, code=error.code)


def _own_geometry(one: _One, start: StartModel, studio: Studio) -> Muscle:
    """The muscle of a measurement: that of the model, or another preset that the user or the file names."""
    length = float(one.values["rest_length"].value)
    named = one.values.get("muscle")
    if named is not None and start.preset is not None:
        preset = str(named.value).partition(":")[0]
        if preset.upper() != start.preset.id.upper():
            try:
                muscle = studio.facts(preset).muscle
            except InputError as error:
                if named.origin == "file":
                    return start.muscle._replace(nominal_length=length)
                raise error.at(one.at("muscle") or error.field) from error
            return muscle._replace(nominal_length=length)
    return start.muscle._replace(nominal_length=length)


def _with_zeros(specimens: Sequence[Specimen]) -> list[Specimen]:
    """Specimens of different geometry with a zero error of their own for every sensor."""
    first = specimens[0].muscle
    remounted = any(
        abs(a - b) > _SAME_LENGTH * max(abs(a), abs(b))
        for each in specimens[1:]
        for a, b in zip(each.muscle, first, strict=True)
    )
    result = []
    for each in specimens:
        measurement = each.points.measurement
        usual = {
            channel: sigma_of(accuracy, channel, measurement, float(each.muscle.nominal_length))
            for channel, accuracy in (_REMOUNTED if remounted else {}).items()
        }
        stated: Mapping[str, float] = each.accuracy if len(specimens) > 1 else {}
        zeros = {**usual, **stated}
        shown = {
            f"{ACCURACY}{channel}": ExperimentValue(
                accuracy.value, accuracy.unit, "assumed", "zero error of each specimen"
            )
            for channel, accuracy in (_REMOUNTED if remounted else {}).items()
            if channel not in each.accuracy and channel in usual and usual[channel] > 0.0
        }
        assumed = frozenset(usual.keys() - stated.keys())
        result.append(
            replace(each, zeros=zeros, assumed_zeros=assumed, experiment={**shown, **each.experiment})
        )
    return result
