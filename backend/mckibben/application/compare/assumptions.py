"""What a test needs, nobody said, and is assumed: in words, or refused."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mckibben.measurement.accuracy import CHANNELS
from mckibben.measurement.experiment import ACCURACY, FIELDS, Experiment, ExperimentValue, needed, shown_value
from mckibben.measurement.measurement import UNIT_OF, Measurement
from mckibben.physics.errors import InputError


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
