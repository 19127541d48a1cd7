r"""Steps that prepare a measurement: a range of it, a drift taken away, a low pass, another time step.

| step | what it does |
|---|---|
| ``range time 2 s to 10 s`` | rows in this time; also ``range time from 2 s``, ``range time to 10 s`` |
| ``range rows 20 to 400`` | these rows of the file, counted from 1 |
| ``range pressure 1 bar to 5 bar`` | rows in which a channel lies in a range |
| ``detrend force`` | a linear drift over time, fitted to the whole record |
| ``detrend force 0 s to 1 s, 59 s to 60 s`` | a linear drift between two rests, by their means |
| ``low pass 20 Hz`` | every measured channel but times and commands; ``low pass force 20 Hz`` one |
| ``resample 100 Hz`` | an even step, also ``resample 10 ms``; a low pass before a longer one |

A low pass is a Butterworth filter of second order that runs forwards and backwards, so that nothing is late.
At the frequency f, with the sampling rate r and the cut-off c, at which the amplitude is 1/√2, it leaves

.. math:: 1 / (1 + (\sqrt 2 - 1) K^4), \qquad K = \tan(\pi f / r) / \tan(\pi c / r).

Within about a period of the cut-off from the ends of a part it has fewer rows and leaves more. Steps are
applied in their order. No step crosses a file, a step back in time or rows in which the muscle is
slack; faulty readings are bridged by a straight line before a filter and stay left out.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import CHANNEL_UNITS, Measurement, PreparedStep
from mckibben.measurement.noise import noise_floor
from mckibben.measurement.points import Points
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import si

#: Longest text of a step, and most steps of a measurement.
LONGEST, MOST = 120, 16
#: Form of each step, and an example.
STEPS = {
    "range": "range time 2 s to 10 s",
    "detrend": "detrend force",
    "low pass": "low pass 20 Hz",
    "resample": "resample 100 Hz",
}

_TWO_RESTS = "detrend force 0 s to 1 s, 59 s to 60 s"
_UNFILTERED = frozenset({"time", "command", "direction", "group"})
_HELD = frozenset({"command", "direction", "group"})  # take the last value when resampled
#: Order of a low pass, a Butterworth filter that runs both ways; and before a longer time step.
ORDER, _ALIAS_ORDER = 2, 8
_ALIAS = 0.8  # cut-off before a longer step, over half its rate
_UNEVEN = 0.1  # deviation of a time step from the usual one that a filter allows
_FEWEST = 3  # rows that a range leaves at least
_SHORTEST = 8  # rows of a part that a filter takes
_MOST_ROWS = 2_000_000  # after resampling

Array = NDArray[np.float64]


@dataclass(frozen=True)
class _Step:
    """A step: what is written, and what makes a measurement and words from one."""

    text: str
    apply: Callable[[Measurement], tuple[Measurement, str]]


def prepared(measurement: Measurement, steps: Sequence[str]) -> Measurement:
    """The measurement after these steps, which it then lists in ``prepared``.

    Args:
        measurement: as it was read.
        steps: in their order; none leave it as it is.

    Raises:
        InputError: names the step, what is wrong with it and what would be right.
    """
    for step in steps_of(steps):
        before = measurement.rows
        try:
            changed, words = step.apply(measurement)
        except InputError as error:
            raise _refused(step.text, f"{error.message} ({measurement.name})", error.hint) from error
        done = PreparedStep(step.text, words, before, changed.rows)
        left = before - changed.rows
        skipped = dict(changed.skipped)
        if left > 0:
            skipped[f"by '{step.text}'"] = left
        measurement = replace(
            changed,
            channels=tuple(
                channel._replace(
                    minimum=float(np.min(changed.columns[channel.name])),
                    maximum=float(np.max(changed.columns[channel.name])),
                )
                for channel in changed.channels
            ),
            skipped=MappingProxyType(skipped),
            prepared=(*measurement.prepared, done),
            messages=(*changed.messages, f"{step.text}: {words}"),
            segmented=None,
        )
    return measurement


def prepared_points(points: Points, steps: Sequence[str]) -> Points:
    """`prepared` of the measurement of some points; rows that a step leaves out are left out of them.

    Raises:
        InputError: as `prepared`.
    """
    return replace(points, measurement=prepared(points.measurement, steps)) if steps else points


def steps_of(texts: Sequence[str]) -> list[_Step]:
    """The steps that texts state.

    Raises:
        InputError: too many of them, or one that is none; names it.
    """
    if len(texts) > MOST:
        raise InputError(f"{len(texts)} steps prepare the data", field="prepare", hint=f"at most {MOST}")
    return [_step(text) for text in texts]


def _step(text: str) -> _Step:
    if not isinstance(text, str) or not text.strip() or len(text) > LONGEST:
        raise _refused(str(text)[:40], f"is no text of 1 to {LONGEST} characters", f"e.g. '{STEPS['range']}'")
    words = re.sub(r"\s+", " ", text.strip())
    for begin, read in _READERS.items():
        rest = re.match(rf"{begin}\b *(.*)$", words, re.IGNORECASE)
        if rest is not None:
            try:
                return _Step(words, read(rest[1]))
            except InputError as error:
                raise _refused(words, error.message, error.hint) from error
    raise _refused(words, "is no step", f"one of: {', '.join(map(repr, STEPS.values()))}")


def _refused(text: str, problem: str, hint: str | None) -> InputError:
    return InputError(f"prepare '{text}': {problem}", field="prepare", hint=hint)


def _channel(name: str, measurement: Measurement | None = None) -> str:
    """The name of a channel.

    Raises:
        InputError: there is none of this name, in general or in a measurement.
    """
    name = name.lower()
    if name not in CHANNEL_UNITS:
        raise InputError(f"there is no channel '{name}'", hint=did_you_mean(name, [*CHANNEL_UNITS, "rows"]))
    if measurement is not None and name not in measurement.columns:
        known = [each for each in measurement.columns if each != "group"]
        raise InputError(f"the file has no {name}", hint=f"its channels: {', '.join(known)}")
    return name


def _value(text: str, channel: str) -> float:
    """A value of a channel [SI]."""
    return si(text, CHANNEL_UNITS[channel], reference="gauge" if channel == "pressure" else None)


# -- range -------------------------------------------------------


def _read_range(rest: str) -> Callable[[Measurement], tuple[Measurement, str]]:
    parts = re.match(r"(\w+) (?:(?:from )?(.+?) to (.+)|from (.+)|to (.+))$", rest, re.IGNORECASE)
    if parts is None:
        raise InputError("is no range", hint=f"'{STEPS['range']}', 'range rows 20 to 400'")
    name, first, last = parts[1].lower(), parts[2] or parts[4], parts[3] or parts[5]
    if name in ("row", "rows"):
        low, high = (
            float("nan") if text is None else _row(text) for text in (first, last)
        )  # fmt: skip
        name = "rows"
    else:
        name = _channel(name)
        low, high = (float("nan") if text is None else _value(text, name) for text in (first, last))
    if low > high:
        raise InputError("begins above its end", hint="from the smaller value to the larger one")
    return lambda measurement: _within(measurement, name, low, high)


def _row(text: str) -> float:
    if not re.fullmatch(r"[0-9]{1,9}", text.strip()) or int(text) < 1:
        raise InputError(f"'{text[:20]}' is no row", hint="rows are counted from 1: 'range rows 20 to 400'")
    return float(int(text))


def _within(measurement: Measurement, name: str, low: float, high: float) -> tuple[Measurement, str]:
    """The rows in a range."""
    values = (
        1.0 + rows_of_file(measurement)
        if name == "rows"
        else measurement.columns[_channel(name, measurement)]
    )
    inside = ~(values < low) & ~(values > high)
    kept = int(np.count_nonzero(inside))
    if kept < _FEWEST:
        unit = "" if name == "rows" else CHANNEL_UNITS[name].replace("1", "")
        seen = f"{np.min(values):.5g} to {np.max(values):.5g} {unit}".strip()
        raise InputError(f"leaves {kept} of {measurement.rows} rows", hint=f"{name} goes from {seen}")
    rows = np.flatnonzero(inside)
    pieces = 1
    starts = _starts_among(measurement, rows)
    if measurement.in_order:  # no signal goes on over a gap
        starts = tuple(sorted({*starts, *(np.flatnonzero(np.diff(rows) > 1) + 1).tolist()}))
        pieces = len(starts) - len(measurement.starts) + 1
    words = f"{kept} of {measurement.rows} rows"
    if pieces > 1:
        words += f", in {pieces} parts, each of which begins anew"
    return _taken(measurement, rows, starts), words


def _starts_among(measurement: Measurement, rows: NDArray[np.intp]) -> tuple[int, ...]:
    """First row of each file among chosen rows."""
    found = np.unique(np.searchsorted(rows, measurement.starts))
    return tuple(start for start in found.tolist() if start < len(rows)) or (0,)


def _taken(measurement: Measurement, rows: NDArray[np.intp], starts: tuple[int, ...]) -> Measurement:
    """Some rows of a measurement, each with the number that it has in its file."""
    return replace(
        measurement,
        columns=_frozen({name: values[rows] for name, values in measurement.columns.items()}),
        slack=_still(measurement.slack[rows]),
        excluded_rows=MappingProxyType(
            {why: _still(bad[rows]) for why, bad in measurement.excluded_rows.items() if bad[rows].any()}
        ),
        starts=starts,
        source_rows=_still(rows_of_file(measurement)[rows]),
    )


def rows_of_file(measurement: Measurement) -> NDArray[np.intp]:
    """Number of the row of its file that each row of a measurement comes from, from 0."""
    found = measurement.source_rows
    return np.arange(measurement.rows, dtype=np.intp) if found is None else found


def _still(values: NDArray) -> NDArray:
    values = np.ascontiguousarray(values)
    values.flags.writeable = False  # a measurement is shared
    return values


def _frozen(columns: dict[str, NDArray]) -> MappingProxyType[str, NDArray]:
    return MappingProxyType({name: _still(values) for name, values in columns.items()})


# -- detrend -----------------------------------------------------


def _read_detrend(rest: str) -> Callable[[Measurement], tuple[Measurement, str]]:
    parts = re.match(r"(\w+)(?: (.+?) to (.+?)(?:,| and) ?(.+?) to (.+))?$", rest, re.IGNORECASE)
    if parts is None:
        raise InputError(
            "names no channel, or one rest only",
            hint=f"'{STEPS['detrend']}', or with two rests '{_TWO_RESTS}'",
        )
    name = _channel(parts[1])
    if name in _UNFILTERED:
        raise InputError(f"{name} has no drift", hint="a measured channel, e.g. force")
    if parts[2] is None:
        return lambda measurement: _without_drift(measurement, name, None)
    times = [_value(text, "time") for text in parts.groups()[1:]]
    if not times[0] <= times[1] <= times[2] <= times[3]:
        raise InputError("the rests are not one after the other", hint=f"e.g. '{_TWO_RESTS}'")
    return lambda measurement: _without_drift(measurement, name, times)


def _without_drift(
    measurement: Measurement, name: str, rests: Sequence[float] | None
) -> tuple[Measurement, str]:
    """A channel without its linear drift; it stays as it is where the drift begins."""
    values = measurement.columns[_channel(name, measurement)]
    time = _time(measurement)
    good = measurement.usable
    if rests is None:
        if np.count_nonzero(good) < _FEWEST:
            raise InputError("too few rows can be used")
        slope = float(np.polyfit(time[good] - time[good][0], values[good], 1)[0])
        begin, duration = float(time[0]), float(np.ptp(time))
    else:
        sides = [good & (time >= low) & (time <= high) for low, high in (rests[:2], rests[2:])]
        if not all(side.any() for side in sides):
            raise InputError(
                "no row lies in one of the rests",
                hint=f"times go from {time.min():.5g} to {time.max():.5g} s",
            )
        (begin, first), (end, last) = ((float(np.mean(time[s])), float(np.mean(values[s]))) for s in sides)
        duration = end - begin
        if not duration > 0.0:
            raise InputError("both rests are at the same time", hint="two rests apart")
        slope = (last - first) / duration
    unit = CHANNEL_UNITS[name].replace("1", "")
    changed = replace(
        measurement,
        columns=_frozen({**measurement.columns, name: values - slope * (time - begin)}),
    )
    how = "fitted to the whole record" if rests is None else "between the two rests"
    per = f"{slope:.3g} {unit}/s".replace(" /", " 1/")
    total = f"{slope * duration:.3g} {unit}".strip()
    return changed, f"a drift of {name} of {per}, {total} over {duration:.4g} s, {how}, was taken away"


def _time(measurement: Measurement) -> Array:
    if "time" not in measurement.columns:
        raise InputError("the file has no time", hint="it takes a column of times")
    return measurement.columns["time"]


# -- low pass ----------------------------------------------------


def _read_low_pass(rest: str) -> Callable[[Measurement], tuple[Measurement, str]]:
    parts = re.match(r"(?:([A-Za-z_]+) )?([0-9].*)$", rest)
    if parts is None:
        raise InputError("states no cut-off", hint=f"'{STEPS['low pass']}', 'low pass force 20 Hz'")
    name = None if parts[1] is None else _channel(parts[1])
    if name in _UNFILTERED:
        raise InputError(f"{name} is not filtered", hint="a measured channel, e.g. force")
    cut_off = si(parts[2], "Hz")
    if not cut_off > 0.0:
        raise InputError(f"a cut-off of {cut_off:g} Hz lets nothing pass", hint=f"e.g. '{STEPS['low pass']}'")
    return lambda measurement: _filtered(measurement, name, cut_off)


def _filtered(measurement: Measurement, name: str | None, cut_off: float) -> tuple[Measurement, str]:
    """Channels after a low pass without delay."""
    time = _time(measurement)
    chosen = [each for each in measurement.columns if each not in _UNFILTERED]
    if name is not None:
        chosen = [_channel(name, measurement)]
    step = _even_step(measurement, time)
    rate = 1.0 / step
    if cut_off >= 0.5 * rate:
        raise InputError(
            f"a cut-off of {cut_off:g} Hz is not below half the rate of the rows",
            hint=f"below {0.5 * rate:.4g} Hz; there is a row each {step:.4g} s",
        )
    bad = {each: _bridged(measurement, measurement.columns[each]) for each in chosen}
    parts = [part for part in parts_of(measurement) if len(part) >= _SHORTEST]
    columns: dict[str, NDArray] = dict(measurement.columns)
    for each in chosen:
        columns[each] = measurement.columns[each].astype(float).copy()
        for part in parts:
            columns[each][part] = low_passed(bad[each][part], cut_off, rate, ORDER)
    gain = _gain(cut_off, rate)
    changed = replace(measurement, columns=_frozen(columns), cut_off=_lowest(measurement, chosen, cut_off))
    changed = _with_shared_noise(changed, measurement, dict.fromkeys(chosen, gain))
    kept = [each for each in ("command",) if name is None and each in measurement.columns]
    also = f"; {kept[0]} is not filtered" if kept else ""
    return changed, (
        f"{' and '.join(chosen) if len(chosen) < 3 else ', '.join(chosen)} without delay, amplitude 1/√2 at "
        f"{cut_off:g} Hz of {0.5 * rate:.4g} Hz that the rows hold; neighbours then share their noise{also}"
    )


def low_passed(values: Array, cut_off: float, rate: float, order: int) -> Array:
    r"""Values of even times after a Butterworth filter of this order, forwards and backwards.

    Args:
        values: shape (rows,).
        cut_off: frequency at which the amplitude is 1/√2 after both passes [Hz].
        rate: of the rows [Hz]; more than twice the cut-off.
        order: of one pass.
    """
    from scipy.signal import butter, sosfiltfilt

    # Both passes leave 1/(1 + (K/k)^2n), so that k is a little above the cut-off.
    wide = np.tan(np.pi * cut_off / rate) / (np.sqrt(2.0) - 1.0) ** (1.0 / (2.0 * order))
    corner = np.arctan(wide) * rate / np.pi
    sections = butter(order, corner, fs=rate, output="sos")
    settling = int(np.ceil(rate / corner)) * order
    return sosfiltfilt(sections, values, padlen=min(3 * settling, len(values) - 1))


def _lowest(measurement: Measurement, channels: Iterable[str], cut_off: float) -> dict[str, float]:
    """The cut-offs of a measurement after a low pass of some channels."""
    before = measurement.cut_off
    return {**before, **{name: min(before.get(name, cut_off), cut_off) for name in channels}}


def _gain(cut_off: float, rate: float) -> float:
    """Standard deviation of white noise after a low pass, over that before it."""
    impulse = np.zeros(2 * int(np.ceil(10.0 * rate / cut_off)) + 1)
    impulse[len(impulse) // 2] = 1.0
    return float(np.linalg.norm(low_passed(impulse, cut_off, rate, ORDER)))


def _with_shared_noise(changed: Measurement, before: Measurement, gains: dict[str, float]) -> Measurement:
    """The changed measurement with what its neighbouring rows share of the noise that it had before.

    Args:
        changed: after a step.
        before: it.
        gains: channel -> standard deviation of white noise after the step, over that before.
    """
    shared = dict(before.shared_noise)
    old, new = (
        [part[~bad[part]] for part in parts_of(each)]
        for each, bad in ((each, ~each.usable) for each in (before, changed))
    )
    for name, gain in gains.items():
        white = noise_floor(before.columns[name], old) or 0.0
        left = float(np.hypot(gain * white, shared.get(name, 0.0)))
        seen = noise_floor(changed.columns[name], new) or 0.0
        shared[name] = float(np.sqrt(max(left**2 - seen**2, 0.0)))
    return replace(changed, shared_noise=MappingProxyType(shared))


def _bridged(measurement: Measurement, values: Array) -> Array:
    """Values with straight lines over faulty readings."""
    bad = np.zeros(measurement.rows, bool)
    for rows in measurement.excluded_rows.values():
        bad |= rows
    if not bad.any() or bad.all():
        return values
    good = np.flatnonzero(~bad)
    return np.interp(np.arange(measurement.rows), good, values[good])


def parts_of(measurement: Measurement) -> list[NDArray[np.intp]]:
    """Rows of each uninterrupted part: of a file, of ascending times, taut or slack."""
    new = np.zeros(measurement.rows, bool)
    new[list(measurement.starts)] = True
    if "time" in measurement.columns:
        new[1:] |= ~(np.diff(measurement.columns["time"]) > 0.0)
    new[1:] |= measurement.slack[1:] != measurement.slack[:-1]
    new[0] = False
    return np.split(np.arange(measurement.rows), np.flatnonzero(new))


def _even_step(measurement: Measurement, time: Array) -> float:
    """The step of times that are even within each part [s]."""
    steps = np.concatenate([np.diff(time[part]) for part in parts_of(measurement)])
    if not len(steps):
        raise InputError("no two rows follow each other in time", hint="a record over time")
    step = float(np.median(steps))
    if np.max(np.abs(steps - step)) > _UNEVEN * step:
        raise InputError(
            f"times are uneven: {np.min(steps):.3g} s to {np.max(steps):.3g} s from row to row",
            hint=f"first 'resample {float(f'{1.0 / step:.2g}'):g} Hz'",
        )
    return step


# -- resample ----------------------------------------------------


def _read_resample(rest: str) -> Callable[[Measurement], tuple[Measurement, str]]:
    try:
        rate = si(rest, "Hz")
    except InputError:
        try:
            step = si(rest, "s")
        except InputError as error:
            raise InputError(
                "states neither a rate nor a time step", hint="'resample 100 Hz', 'resample 10 ms'"
            ) from error
        rate = 1.0 / step if step > 0.0 else 0.0
    if not rate > 0.0:
        raise InputError("a rate is above 0", hint=f"e.g. '{STEPS['resample']}'")
    return lambda measurement: _resampled(measurement, rate)


def _resampled(measurement: Measurement, rate: float) -> tuple[Measurement, str]:
    """Rows at an even step, straight between the rows of the file; a low pass before a longer step."""
    time = _time(measurement)
    parts = parts_of(measurement)
    longest = sum(float(np.ptp(time[part])) for part in parts) * rate + len(parts)
    if longest > _MOST_ROWS:
        raise InputError(f"makes {longest:.3g} rows", hint=f"at most {_MOST_ROWS} rows: a lower rate")
    found: dict[str, list[NDArray]] = {name: [] for name in measurement.columns}
    nearest, spread, aliased = [], [], False
    begins, starts = 0, []
    for part in parts:
        own = time[part]
        count = int(np.floor((own[-1] - own[0]) * rate * (1.0 + 1e-12) + 1e-9)) + 1
        grid = own[0] + np.arange(count) / rate
        before = np.clip(np.searchsorted(own, grid + 1e-9 / rate, side="right") - 1, 0, len(own) - 1)
        after = np.minimum(before + 1, len(own) - 1)
        near = np.where(np.abs(own[after] - grid) < np.abs(own[before] - grid), after, before)
        steps = np.diff(own)
        shorter = len(own) >= _SHORTEST and 1.0 / rate > 1.5 * float(np.median(steps))
        aliased |= shorter
        share = (grid - own[before]) / np.maximum(own[after] - own[before], 1e-300)
        of_filter = _gain_of_aliases(own, rate) ** 2 * np.ones(count)
        spread.append(of_filter if shorter else (1.0 - share) ** 2 + share**2)
        for name, values in measurement.columns.items():
            if name == "time":
                found[name].append(grid)
            elif name in _HELD:
                found[name].append(values[part][before])
            else:
                smooth = _bridged(measurement, values)[part]
                fine = own
                if shorter:
                    fine, smooth = _without_aliases(own, smooth, rate)
                found[name].append(np.interp(grid, fine, smooth))
        if part[0] in measurement.starts:
            starts.append(begins)
        begins += count
        nearest.append(part[near])
    rows = np.concatenate(nearest)
    if len(rows) < _FEWEST:
        raise InputError(f"leaves {len(rows)} of {measurement.rows} rows", hint="a higher rate")
    taken = _taken(measurement, rows, tuple(starts) or (0,))
    columns = {name: np.concatenate(values) for name, values in found.items()}
    changed = replace(taken, columns=_frozen(columns))
    gains = {
        name: float(np.sqrt(np.mean(np.concatenate(spread))))
        for name in columns
        if name not in _HELD | {"time"}
    }
    if aliased:
        changed = replace(changed, cut_off=_lowest(measurement, gains, 0.5 * _ALIAS * rate))
    changed = _with_shared_noise(changed, measurement, gains)
    low = f", after a low pass of {0.5 * _ALIAS * rate:.4g} Hz without delay" if aliased else ""
    held = "; the command keeps its last value" if "command" in columns else ""
    return (
        changed,
        f"a row each {1.0 / rate:.4g} s, {len(rows)} instead of {measurement.rows} rows{low}{held}",
    )


def _gain_of_aliases(time: Array, rate: float) -> float:
    """Standard deviation of white noise after `_without_aliases`, over that before it."""
    return float(np.sqrt(min(_ALIAS * rate * float(np.median(np.diff(time))), 1.0)))


def _without_aliases(time: Array, values: Array, rate: float) -> tuple[Array, Array]:
    """Even times and values without what a longer step would fold back."""
    step = float(np.median(np.diff(time)))
    count = max(int(np.round((time[-1] - time[0]) / step)), 1) + 1
    fine = np.linspace(time[0], time[-1], count)
    return fine, low_passed(
        np.interp(fine, time, values), 0.5 * _ALIAS * rate, (count - 1) / (fine[-1] - fine[0]), _ALIAS_ORDER
    )


_READERS: dict[str, Callable[[str], Callable[[Measurement], tuple[Measurement, str]]]] = {
    "range": _read_range,
    "detrend": _read_detrend,
    "low[ -]?pass": _read_low_pass,
    "resample": _read_resample,
}
