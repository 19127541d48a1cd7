"""Measurements: files of any laboratory, presets, data frames, arrays."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike, fspath
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike, NDArray

from mckibben.application.json_text import to_json
from mckibben.application.measurement.convert import CHANNEL_HEADERS, converted
from mckibben.application.measurement.experiment import QuestionMeasurement, stated_in
from mckibben.application.measurement.files import ARGUMENT, FileOptions, file_options, measurements_of
from mckibben.application.measurement.summary import MeasurementSummary, details_of
from mckibben.application.measurement.summary import summary_of as facts_of
from mckibben.application.text_file import check_ending
from mckibben.documents.doors import in_words_of, result_in_words_of
from mckibben.door.frames import csv_of, frame_of
from mckibben.door.problem import reported
from mckibben.door.result import Result
from mckibben.door.values import Quantity, names_of
from mckibben.door.workspace import studio
from mckibben.facts.result import read_only
from mckibben.measurement.experiment import Experiment
from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.measurement import Measurement as Data
from mckibben.measurement.points import Points
from mckibben.measurement.preparation import prepared_points
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.report.figures import variable
from mckibben.report.summary import Summary, Table, experiment_table, figure

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


#: What columns are: channel -> "name", "name [unit]" or "-name [unit]"; or texts "channel=name [unit]".
Columns = Mapping[str, str] | Sequence[str]

#: Channel that an array may be -> unit that its values have where none is stated.
_ARRAY_UNITS = {**CHANNEL_UNITS, "load": "kg"}


class Measurement(Result):
    """A measurement in SI with its experiment; from `mckibben.read`, a data frame or arrays."""

    __slots__ = ("_said",)

    _said: QuestionMeasurement

    def __init__(self, said: QuestionMeasurement) -> None:
        self._set(_said=said)

    @classmethod
    @reported
    def from_frame(
        cls,
        frame: pd.DataFrame,
        *,
        name: str = "data frame",
        columns: Columns = (),
        ignore: str | Sequence[str] = (),
        kind: str | None = None,
        rest_length: Quantity | None = None,
        load: Quantity | None = None,
        supply: Quantity | None = None,
        accuracy: str | None = None,
        experiment: Mapping[str, object] | None = None,
        strict: bool = False,
    ) -> Measurement:
        """A measurement from a pandas data frame, read by the same rules as a file.

        Args:
            frame: the data; column names say channel and unit, "pressure [bar]". A named index is a column.
            name: for messages.
            columns: what columns are whose names do not say it.
            ignore: columns that are not wanted.
            kind: isobaric, isometric, isotonic, diameter, transient or static; None = detected.
            rest_length, load, supply, accuracy, experiment, strict: as in `mckibben.read`.

        Raises:
            Problem: names the column or row, what is wrong and what would be right.
        """
        options = _options(
            columns=columns, ignore=ignore, rest_length=rest_length, load=load, supply=supply,
            accuracy=accuracy, experiment=experiment, strict=strict,
        )  # fmt: skip
        if not hasattr(frame, "to_csv"):
            raise InputError(
                f"a {type(frame).__name__} is no data frame", hint="Measurement.from_arrays takes arrays"
            )
        return cls(_read_text(csv_of(frame), name, options, kind))

    @classmethod
    @reported
    def from_arrays(
        cls,
        channels: Mapping[str, ArrayLike],
        *,
        units: Mapping[str, str] | None = None,
        name: str = "arrays",
        kind: str | None = None,
        rest_length: Quantity | None = None,
        load: Quantity | None = None,
        supply: Quantity | None = None,
        accuracy: str | None = None,
        experiment: Mapping[str, object] | None = None,
        strict: bool = False,
    ) -> Measurement:
        """A measurement from one array for each channel.

        Args:
            channels: channel (pressure, force, length, contraction, displacement, diameter, time, velocity,
                command, temperature, direction, group) -> values, all of the same length. ``load`` is the
                mass [kg] that hangs on the muscle in each row, its weight the force.
            units: channel -> unit, "bar"; SI where not stated. Pressures are gauge, "bar(a)" is absolute.
            name: for messages.
            kind, rest_length, load, supply, accuracy, experiment, strict: as in `from_frame`.

        Raises:
            Problem: an unknown channel or unit, lengths that differ, values that are no measurement.
        """
        stated = dict(units or {})
        for channel in (*channels, *stated):
            if channel not in _ARRAY_UNITS:
                raise InputError(f"there is no channel '{channel}'", hint=did_you_mean(channel, _ARRAY_UNITS))
        rows = {channel: _length_of(channel, values) for channel, values in channels.items()}
        if len(set(rows.values())) > 1:
            counts = ", ".join(f"{channel} {count}" for channel, count in rows.items())
            raise InputError(f"the channels have different numbers of values: {counts}")
        if len(channels) < 2:
            raise InputError(
                f"{', '.join(channels) or 'no channel'} alone is no measurement",
                hint="a pressure, and the force or the stroke",
            )
        quantities = [channel for channel in channels if channel not in ("direction", "group")]
        options = _options(
            columns=[f"{c}={c} [{stated.get(c, _ARRAY_UNITS[c])}]" for c in quantities],
            rest_length=rest_length, load=load, supply=supply, accuracy=accuracy, experiment=experiment,
            strict=strict,
        )  # fmt: skip
        return cls(_read_text(csv_of(frame_of(dict(channels))), name, options, kind))

    @reported
    def stating(
        self,
        *,
        rest_length: Quantity | None = None,
        load: Quantity | None = None,
        supply: Quantity | None = None,
        accuracy: str | None = None,
        experiment: Mapping[str, object] | None = None,
    ) -> Measurement:
        """The same measurement with more said about its experiment; arguments as in `mckibben.read`.

        Raises:
            Problem: a value that cannot be used.
        """
        options = _options(
            rest_length=rest_length, load=load, supply=supply, accuracy=accuracy, experiment=experiment
        )
        return Measurement(replace(self._said, said={**self._said.said, **options.said}))

    @reported
    def prepared(self, *steps: str) -> Measurement:
        """The same measurement after these steps, in their order.

        Args:
            steps: "range time 2 s to 10 s" (or rows, or a channel), "detrend force" (or between two rests,
                "detrend force 0 s to 1 s, 59 s to 60 s"), "low pass 20 Hz" (or "low pass force 20 Hz"),
                "resample 100 Hz". ``messages`` says what each did.

        Raises:
            Problem: names the step, what is wrong with it and what would be right.
        """
        return Measurement(replace(self._said, points=prepared_points(self._said.points, steps)))

    @property
    def _data(self) -> Data:
        return self._said.points.measurement

    @property
    def name(self) -> str:
        """Name of the file or preset."""
        return self._data.name

    @property
    def kind(self) -> str:
        """isobaric, isometric, isotonic, diameter, transient or static."""
        return self._data.kind

    @property
    def rows(self) -> int:
        """Number of rows."""
        return self._data.rows

    @property
    def columns(self) -> Mapping[str, NDArray[Any]]:
        """Channel -> values in SI, read-only, shape (rows,); pressures are gauge."""
        return MappingProxyType({name: read_only(values) for name, values in self._data.columns.items()})

    @property
    def experiment(self) -> Experiment:
        """What is said about the test: field -> value, unit, who says it and where."""
        return MappingProxyType({**stated_in(self._said.points), **self._said.said})

    @property
    def messages(self) -> Sequence[str]:
        """What was assumed while reading."""
        return [in_words_of("python", message) for message in self._data.messages]

    @property
    def summary(self) -> MeasurementSummary:
        """Channels with their columns and units, sweeps, rows left out, open questions."""
        return facts_of(self._data)

    @property
    def said(self) -> QuestionMeasurement:
        """The measurement as the use cases take it."""
        return self._said

    def to_frame(self) -> pd.DataFrame:
        """The channels in SI, with names such as pressure_Pa that `from_frame` reads again."""
        columns = self._data.columns
        return frame_of({CHANNEL_HEADERS[name]: columns[name] for name in CHANNEL_HEADERS if name in columns})

    def plot(self) -> Figure:
        """The channels over time, or the measured points."""
        from mckibben.door.figures import measurement_figure

        return measurement_figure(self._data, self.name)

    def _files(self, path: Path) -> str:
        """``.csv``: the canonical file with conditions and origins; ``.json``: summary and columns."""
        if check_ending(path, (".csv", ".json")) == ".csv":
            return converted(self._data).text
        return to_json(self._answer()).decode() + "\n"

    def _answer(self) -> object:
        return result_in_words_of("python", details_of(self._data))

    def _summary(self) -> Summary:
        return _summary_of(self._data, self.experiment)

    def _title(self) -> str:
        return f"Measurement {self.name}: {self.kind}, {self.rows} rows"


@reported
def read(
    path: str | PathLike[str],
    *,
    columns: Columns = (),
    sheet: str | None = None,
    head: int | None = None,
    ignore: str | Sequence[str] = (),
    rest_length: Quantity | None = None,
    load: Quantity | None = None,
    supply: Quantity | None = None,
    accuracy: str | None = None,
    experiment: Mapping[str, object] | None = None,
    prepare: str | Sequence[str] = (),
    strict: bool = False,
) -> Measurement:
    """Read a measurement file (CSV, .xlsx, .mat, .tdms), or a measurement preset by its id.

    Args:
        path: the file or id.
        columns: what columns are whose heads do not say it, ``{"force": "-Kraft [kN]"}``: sign and unit.
        sheet: sheet, group or struct with the measurement.
        head: row of the column names, counted from 1.
        ignore: columns that are not wanted.
        rest_length: length of the muscle without air and load.
        load: mass or force on the muscle, "6 kg".
        supply: supply pressure, gauge, "6 bar".
        accuracy: standard deviation by channel, "length 1 mm, force 0.5 %", or a sensor.
        experiment: more about the test, ``{"force_zero": "2.5 N", "inclination": "45 deg"}``.
        prepare: steps that prepare the data, "low pass 20 Hz"; see `Measurement.prepared`.
        strict: refuse a file instead of assuming what it does not say.

    Raises:
        Problem: names the file, the row or field, what is wrong and what would be right.
    """
    options = _options(
        columns=columns, sheet=sheet, head=head, ignore=ignore, rest_length=rest_length, load=load,
        supply=supply, accuracy=accuracy, experiment=experiment, strict=strict, prepare=prepare,
    )  # fmt: skip
    found = measurements_of(
        [fspath(path)], studio(), options.correction, options.said, prepare=options.prepare
    )
    if len(found) > 1:
        raise InputError(
            f"{fspath(path)}: is a list of {len(found)} measurements",
            hint="read each file and pass them as a list",
        )
    return Measurement(found[0])


def _options(
    *,
    columns: Columns = (),
    sheet: str | None = None,
    head: int | None = None,
    ignore: str | Sequence[str] = (),
    rest_length: Quantity | None = None,
    load: Quantity | None = None,
    supply: Quantity | None = None,
    accuracy: str | None = None,
    experiment: Mapping[str, object] | None = None,
    prepare: str | Sequence[str] = (),
    strict: bool = False,
) -> FileOptions:
    if isinstance(columns, Mapping):
        columns = [f"{channel}={column}" for channel, column in columns.items()]
    return file_options(
        sheet=sheet,
        head=head,
        columns=names_of(columns),
        ignored=names_of(ignore),
        rest_length=rest_length,
        load=load,
        supply=supply,
        accuracy=accuracy,
        experiment=experiment,
        strict=strict,
        prepare=names_of(prepare),
        prefix=ARGUMENT,
    )


def _length_of(channel: str, values: ArrayLike) -> int:
    try:
        return len(values)  # type: ignore
    except TypeError:
        raise InputError(f"{channel}: is no array", hint="one value for each row") from None


def _read_text(text: str, name: str, options: FileOptions, kind: str | None) -> QuestionMeasurement:
    correction = options.correction if kind is None else replace(options.correction, kind=kind)
    return QuestionMeasurement(Points(read_measurement(text.encode(), name, correction)), dict(options.said))


def _summary_of(measurement: Data, experiment: Experiment) -> Summary:
    """The channels, the experiment, what was assumed, columns that are not read.

    Args:
        measurement: the data.
        experiment: what is said about the test.
    """
    rows = []
    for channel in measurement.channels:
        scale = variable(channel.name)[1]
        low, high = (figure(scale.of(value)) for value in (channel.minimum, channel.maximum))
        rows.append(
            [channel.name, channel.column, channel.source_unit, f"{low} to {high} {scale.unit}".strip()]
        )
    title = f"{measurement.name}: {measurement.kind}, {measurement.rows} rows in {measurement.groups} groups"
    summary: Summary = [Table(title, ["channel", "column", "in", "range"], rows)]
    if experiment:
        summary.append(experiment_table(measurement.name, experiment))
    summary += [in_words_of("python", message) for message in measurement.messages]
    summary += [f"column '{column}' is not read: {why}" for column, why in measurement.unread]
    return summary
