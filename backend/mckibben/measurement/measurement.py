"""A measurement: channels in SI, its kind, its groups and the rows in which the muscle is slack.

Every reader uses :func:`build`, so a file, a preset and a test give the same object.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.kind import (
    FORCE_KINDS,
    KINDS,
    STROKES,
    Array,
    explain_kind,
    group_rows,
)
from mckibben.measurement.question import Question
from mckibben.measurement.saturation import pushing_rows, unusable_rows
from mckibben.measurement.spikes import spiked_rows
from mckibben.measurement.sweeps import Sweeps, sweeps_of
from mckibben.physics.errors import InputError, did_you_mean

__all__ = [
    "CHANNEL_UNITS", "FORCE_KINDS", "KINDS", "STROKES", "MeasuredChannel", "Measurement", "PreparedStep",
    "StatedValue", "build", "group_rows", "lengths",
]  # fmt: skip

#: Canonical channel name -> SI unit. Pressure is gauge; displacement is a contraction stroke (positive =
#: shorter); command is the share of valve opening; direction is -1 shortening, +1 lengthening, 0 unknown;
#: angle and torque are those of a joint, lever that at which the muscle pulls, counter_pressure that of a
#: second muscle which pulls against it.
CHANNEL_UNITS: Mapping[str, str] = MappingProxyType({
    "time": "s", "pressure": "Pa", "force": "N", "length": "m", "contraction": "1", "displacement": "m",
    "diameter": "m", "velocity": "m/s", "command": "1", "temperature": "K", "angle": "rad", "torque": "N*m",
    "lever": "m", "counter_pressure": "Pa", "direction": "1", "group": "1",
})  # fmt: skip

_HARDLY_A_PRESSURE = 2e3  # Pa; too low to have an effect on a muscle


class MeasuredChannel(NamedTuple):
    """Origin and range of a channel in SI; ``source_unit`` is the unit in the file."""

    name: str
    column: str
    unit: str
    minimum: float
    maximum: float
    source_unit: str


#: Begin of the key of a stated value that is the unit of a channel.
UNIT_OF = "unit of "
#: Among the words of a file: whether its pressure is gauge or absolute.
REFERENCE = "reference"


class StatedValue(NamedTuple):
    """A condition of the test: value in SI or text, who says it, and where.

    ``origin`` is ``file`` or ``you``, or ``assumed`` for a unit that was taken as proposed (`UNIT_OF`).
    """

    key: str
    value: float | str
    origin: str
    where: str


class RigText(NamedTuple):
    """A text of a file about a sensor: what it claims, of which column (empty = of the file), and where."""

    facet: str
    column: str
    where: str
    text: str


class PreparedStep(NamedTuple):
    """A step that prepared a measurement: as it is written, what it did, and the rows before and after."""

    step: str
    done: str
    rows_before: int
    rows_after: int


@dataclass(frozen=True, eq=False)
class Measurement:
    """One measurement file, in SI.

    Attributes:
        name: file name.
        id: sha256 of the file's bytes, hexadecimal.
        kind: one of :data:`KINDS`.
        kind_detected: True when the file did not state its kind.
        columns: channel name -> read-only array, shape (rows,), keys of :data:`CHANNEL_UNITS`; ``group`` int.
        channels: origin and range of each column.
        ignored: column headers that are not used.
        conditions: ``load_mass`` [kg], ``load_force`` [N], ``supply_pressure`` [Pa, gauge] and the like as
            numbers, ``muscle``, ``sample`` and everything else as text.
        slack: bool array, shape (rows,): rows in which the muscle is slack; their force is not a measured 0
            N.
        messages: assumptions made while reading.
        excluded_rows: reason -> bool array, shape (rows,), of rows with a faulty reading (a saturated or
            stuck sensor); slack is not among them.
        skipped: reason -> rows of the file that could not be read and are not among ``rows``.
        starts: first row of each file of a joined measurement; signals are not continuous across it.
        kind_reason: why this kind was detected; empty when the file states it.
        segmented: segments known from the original rows of a reduced measurement.
        unread: columns that nothing is read from, and why.
        undecided: those among them of which neither name nor unit tells what they are.
        stated: the conditions with their origin.
        in_words: channels whose unit the file or the user says; `REFERENCE` where one of them says that the
            pressure is gauge or absolute.
        questions: what the file leaves open.
        by_rows: without time, the order of the rows is that of the test.
        prepared: the steps of `mckibben.measurement.preparation` that made it, in their order.
        source_rows: row of its file that each row comes from, from 0; None where they are the same.
        shared_noise: channel -> standard deviation of noise that neighbouring rows share, because a filter or
            another time step spread it over them [SI]; their differences do not show it.
        cut_off: channel -> frequency up to which these steps let it pass [Hz].
        heads: names of all columns of its file.
        rig: what the file says about signs, references and scales of its sensors, for others of the same rig.
    """

    name: str
    id: str
    kind: str
    kind_detected: bool
    columns: Mapping[str, NDArray[Any]]
    channels: tuple[MeasuredChannel, ...]
    ignored: tuple[str, ...]
    conditions: Mapping[str, float | str]
    slack: NDArray[np.bool_]
    messages: tuple[str, ...]
    excluded_rows: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)
    skipped: Mapping[str, int] = field(default_factory=dict)
    starts: tuple[int, ...] = (0,)
    kind_reason: str = ""
    segmented: Sweeps | None = None
    unread: tuple[tuple[str, str], ...] = ()
    undecided: tuple[str, ...] = ()
    stated: tuple[StatedValue, ...] = ()
    in_words: frozenset[str] = frozenset()
    questions: tuple[Question, ...] = ()
    by_rows: bool = False
    prepared: tuple[PreparedStep, ...] = ()
    source_rows: NDArray[np.intp] | None = None
    shared_noise: Mapping[str, float] = field(default_factory=dict)
    cut_off: Mapping[str, float] = field(default_factory=dict)
    heads: tuple[str, ...] = ()
    rig: tuple[RigText, ...] = ()

    @cached_property
    def usable(self) -> NDArray[np.bool_]:
        """Mask of the rows that are neither slack nor excluded, shape (rows,)."""
        result = ~self.slack
        for rows in self.excluded_rows.values():
            result &= ~rows
        result.flags.writeable = False
        return result

    @cached_property
    def exclusions(self) -> Mapping[str, int]:
        """Reason -> number of unusable rows; a row counts once, under its first reason."""
        counts, seen = {}, np.zeros(self.rows, bool)
        for reason, rows in {"slack": self.slack, **self.excluded_rows}.items():
            if count := int(np.count_nonzero(rows & ~seen)):
                counts[reason] = count
            seen |= rows
        return MappingProxyType(counts)

    @cached_property
    def segments(self) -> Sweeps:
        """Sweeps, cycles, directions and speeds, determined at the first access."""
        return self.segmented or sweeps_of(self.columns, self.kind, starts=self.starts)

    @property
    def in_order(self) -> bool:
        """Whether the rows follow each other as in the test: by their time, or without one by themselves."""
        return self.by_rows or "time" in self.columns

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self.slack)

    @property
    def groups(self) -> int:
        """Number of different group labels."""
        return len(np.unique(self.columns["group"]))


def build(
    columns: Mapping[str, NDArray],
    *,
    name: str,
    id: str,
    kind: str | None = None,
    origins: Mapping[str, tuple[str, str]] | None = None,
    ignored: Iterable[str] = (),
    conditions: Mapping[str, float | str] | None = None,
    marked_slack: NDArray[np.bool_] | None = None,
    messages: Iterable[str] = (),
    excluded_rows: Mapping[str, NDArray[np.bool_]] | None = None,
    skipped: Mapping[str, int] | None = None,
    starts: tuple[int, ...] = (0,),
) -> Measurement:
    """A Measurement from SI columns of equal length: detects the kind, groups the rows, finds slack rows.

    Args:
        columns: channel name -> finite SI values.
        name: file name.
        id: sha256 of the source.
        kind: as stated by the source; None = detect.
        origins: channel -> (source column header, source unit).
        ignored: headers that were not used.
        conditions: see :class:`Measurement`.
        marked_slack: rows the source marks as "no pulling force".
        messages: assumptions of the reader.
        excluded_rows: rows with a faulty reading; None = find them.
        skipped: rows of the source that could not be read.
        starts: see :class:`Measurement`.

    Raises:
        InputError: unknown kind, a kind whose channels are missing, or channels that fit no kind.
    """
    conditions = dict(conditions or {})
    notes = list(messages)
    detected, why = kind is None, ""
    if kind is None:
        try:
            kind, why = explain_kind(columns, conditions)
        except InputError as error:
            raise InputError(f"{name}: {error}", field=error.field, hint=error.hint) from error
        notes.append(f"kind detected: {kind}")
    elif kind not in KINDS:
        raise InputError(f"{name}: kind '{kind}' is not known", field="kind", hint=did_you_mean(kind, KINDS))
    _check_channels(columns, kind, name)
    table = dict(columns)
    rows = len(next(iter(table.values())))
    slack = np.zeros(rows, bool) if marked_slack is None else np.array(marked_slack, bool)
    if kind in FORCE_KINDS and "force" in table:
        exact_zero = table["force"] == 0.0
        if np.count_nonzero(exact_zero) >= 2:  # a sensor hardly shows exactly 0 twice, a clipped table does
            slack |= exact_zero
    highest = float(np.max(table["pressure"])) if "pressure" in table else 0.0
    if 0.0 < highest < _HARDLY_A_PRESSURE:
        notes.append(f"the pressure reaches only {highest:.3g} Pa: check its unit")
    if slack.any():
        notes.append(f"{np.count_nonzero(slack)} of {rows} rows hold no pulling force (slack)")
    if excluded_rows is None:
        excluded_rows = unusable_rows(table, kind, slack=slack)
        if "time" in table:
            excluded_rows |= spiked_rows(table)
        if kind in FORCE_KINDS and "force" in table and ("time" in table or "direction" in table):
            pushing = pushing_rows(table["force"])
            if pushing.any():
                excluded_rows |= {"the muscle pushes (force below zero)": pushing}
    notes += [
        f"{np.count_nonzero(bad)} of {rows} rows are excluded: {reason}"
        for reason, bad in excluded_rows.items()
    ]
    channels = []
    for channel, values in table.items():
        unit = CHANNEL_UNITS[channel]
        column, source_unit = (origins or {}).get(channel, (channel, unit))
        channels.append(
            MeasuredChannel(channel, column, unit, float(np.min(values)), float(np.max(values)), source_unit)
        )
    labels, rule = group_rows(table, kind)
    table["group"] = labels
    notes.append(f"grouped {rule}")
    table = {channel: values.view() for channel, values in table.items()}  # the caller's arrays stay writable
    for values in (*table.values(), slack, *excluded_rows.values()):
        values.flags.writeable = False  # a cached measurement is shared between requests
    return Measurement(
        name=name,
        id=id,
        kind=kind,
        kind_detected=detected,
        columns=MappingProxyType(table),
        channels=tuple(channels),
        ignored=tuple(ignored),
        conditions=MappingProxyType(conditions),
        slack=slack,
        messages=tuple(notes),
        excluded_rows=MappingProxyType(dict(excluded_rows)),
        skipped=MappingProxyType(dict(skipped or {})),
        starts=starts,
        kind_reason=why,
    )


def lengths(measurement: Measurement, nominal_length: float) -> Array:
    """Muscle length [m] of each row, shape (rows,).

    Taken from ``length``, else from ``contraction`` κ: L = L0 (1 - κ), else from ``displacement`` s (positive
    = shorter): L = L0 - s.

    Raises:
        InputError: none of the three was measured, or ``nominal_length`` is shorter than the stroke.
    """
    columns = measurement.columns
    if "length" in columns:
        return columns["length"]
    if "contraction" in columns:
        result = nominal_length * (1.0 - columns["contraction"])
    elif "displacement" in columns:
        result = nominal_length - columns["displacement"]
    else:
        raise InputError(
            f"{measurement.name}: the file has no length, contraction or displacement", field="length"
        )
    if not np.min(result) > 0.0:
        raise InputError(
            f"{measurement.name}: a rest length of {nominal_length:g} m is shorter than the stroke",
            field="nominal_length",
        )
    return result


def _check_channels(columns: Mapping[str, NDArray], kind: str, name: str) -> None:
    """Reject a stated kind whose channels are missing."""
    any_stroke, any_state = "/".join(STROKES), "/".join(("pressure", *STROKES))
    if "torque" in columns and "angle" in columns:
        any_stroke, force = f"{any_stroke}/angle", "force/torque"
    else:
        force = "force"
    needed = {
        "isotonic": ("pressure", any_stroke),
        "diameter": ("diameter", any_state),
        "transient": ("time", any_state),
    }.get(kind, ("pressure", any_stroke, force))
    for options in needed:
        if not any(option in columns for option in options.split("/")):
            raise InputError(
                f"{name}: a measurement of kind '{kind}' needs a column {options.replace('/', ' or ')}",
                field=options.split("/")[0],
                hint=f"known columns of this file: {', '.join(columns)}",
            )
