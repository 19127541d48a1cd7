r"""A rest that repeats: over the length, as on a thread or rack, over the pressure, or in time, as hum does.

For each coordinate x the sum

.. math:: (a \sin 2\pi x/p + b \cos 2\pi x/p)\,g,\qquad g = 1 \text{ or } P/\bar P

is fitted by least squares to the residual, from which each sweep's own polynomial is taken. All sweeps share
the phase; in time those of a record do. The chance that noise does as well somewhere among all periods tried
follows from the beta distribution of the explained share, with as many rows as are independent of each other.

Source: J. D. Scargle, Astrophys. J. 263 (1982) 835, for periods in unevenly spaced data.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import exp, lgamma, log

import numpy as np

from mckibben.identification.diagnose.score import effective_rows
from mckibben.identification.diagnose.swept_rows import COORDINATES, FEWEST_ROWS, Coordinate, Over, SweptRows
from mckibben.identification.thresholds import REPETITION

_MOST_CYCLES = 600
_GAPS = 2.5  # gaps between readings in the shortest period
_GRID = 8  # cells in the shortest period
_BETWEEN = 2.5  # chances between two independent frequencies, at each of which the best is taken
_FINER = 4  # frequencies per independent one
_BESIDE = 13  # exact periods tried around the best of the scan
_REACHES = (0.1, 0.2, 0.4)  # ways within which a ringing fades to 37 %, over the longest sweep
_PERIOD_BESIDE = np.linspace(0.94, 1.06, 13)  # periods that are compared, over the one that was found


@dataclass(frozen=True)
class Repetition:
    """A periodic part of a residual.

    Attributes:
        over: ``length``, ``pressure``, ``time``, or ``rows`` of a file without time.
        period: in it [m, Pa, s, -].
        share: of the mean square of the residual.
        amplitude: of the scaled residual, at the mean pressure where it grows with the pressure.
        grows: whether its amplitude is in proportion to the pressure.
        left_out: share that it explains of sweeps that it was not fitted to.
        parts, shown: number of records, and of those that a fit to the others explains.
        of_sweeps: whether the parts are sweeps: in time, and where there is one record.
        in_step: whether it swings in step throughout the file, as no noise does.
        fades: whether it begins anew at each turn of the motion and fades; None where the data cannot tell
            that from what is the same throughout.
        also: the same repetition over other coordinates, which these data cannot tell from it.
    """

    over: Over
    period: float
    share: float
    amplitude: float
    grows: bool
    left_out: float
    parts: int
    shown: int
    of_sweeps: bool = False
    in_step: bool = False
    fades: bool | None = None
    also: tuple[tuple[Coordinate, float], ...] = ()


def repetition(
    residual: np.ndarray, inputs: Mapping[str, np.ndarray], *, sweeps: Sequence[np.ndarray],
    records: np.ndarray,
) -> Repetition | None:  # fmt: skip
    """The repetition that explains most of a residual; None where there is none beyond doubt.

    Args:
        residual: shape (rows,).
        inputs: length [m], pressure [Pa] and time [s], shape (rows,); some may be missing.
        sweeps: rows of each sweep, in order.
        records: label of each row's uninterrupted record.
    """
    rows = SweptRows.of(residual, inputs, sweeps, records)
    if rows is None:
        return None
    scans = [scan for name in COORDINATES if name in inputs for scan in _scans(rows, name)]
    tried = sum(scan.cycles for scan in scans)
    found = [each for scan in scans if (each := _judged(rows, scan, tried)) is not None]
    if not found:
        return None
    best = max(found, key=lambda each: each.share)
    if best.over == "time" and _is_driven(rows, best.period):
        return None
    alike = {
        each.over: each.period
        for each in sorted(found, key=lambda each: each.share)
        if each.over != best.over and each.share > REPETITION.alike * best.share
    }
    return replace(best, fades=_fades(rows, best), also=tuple(alike.items()))


def _fades(rows: SweptRows, found: Repetition) -> bool | None:
    """Whether a repetition begins anew at each turn and fades, by the likelihood of both courses."""
    x = rows.inputs[found.over]
    since = np.empty(len(x))
    for label in np.unique(rows.record):
        inside = rows.record == label
        since[inside] = _since_turn(x[inside], REPETITION.turns * float(np.ptp(x)))
    after = np.isfinite(since)
    if np.count_nonzero(after) < FEWEST_ROWS:
        return None
    since, here = np.where(after, since, 0.0), rows.left[after]
    square = float(here @ here)

    def left(place: np.ndarray, reach: float) -> float:
        of_periods = []
        for factor in _PERIOD_BESIDE:
            angle = 2.0 * np.pi * factor / found.period * place
            waves = np.column_stack([np.sin(angle), np.cos(angle)]) * np.exp(-since / reach)[:, None]
            columns = rows.projected(np.where(after[:, None], waves, 0.0))[after]
            weights, *_ = np.linalg.lstsq(columns, here, rcond=None)
            of_periods.append(square - float(here @ (columns @ weights)))
        return max(min(of_periods), 1e-12 * square)

    steady, fading = left(x, np.inf), min(left(since, share * float(np.max(since))) for share in _REACHES)
    share = effective_rows(rows.left, rows.lines, ()) / len(rows.left)
    likelier = 0.5 * share * len(here) * log(steady / fading)
    return None if abs(likelier) < REPETITION.likelier else likelier > 0.0


@dataclass(frozen=True)
class _Scan:
    """The explained share over the frequency of one coordinate, with one way of growing.

    ``cycles``: most cycles in the range, which is also the number of independent frequencies.
    """

    over: Coordinate
    grows: bool
    growth: np.ndarray
    x: np.ndarray
    span: float
    cycles: float
    frequencies: np.ndarray  # in cycles per range
    shares: np.ndarray


def _scans(rows: SweptRows, name: Coordinate) -> Iterator[_Scan]:
    """The scans of one coordinate; of constant amplitude, and of one that grows with the pressure."""
    x = rows.inputs[name]
    in_time = name == "time"
    groups = [rows.record == label for label in np.unique(rows.record)] if in_time else [slice(None)]
    span = max(float(np.ptp(x[group])) for group in groups)
    if not span > 0.0:
        return
    cycles = min(float(_MOST_CYCLES), span / (_GAPS * max(_gap(x[group]) for group in groups)))
    if cycles <= REPETITION.periods:
        return
    cells = int(np.ceil(_GRID * cycles)) + 1
    size = 1 << int(np.ceil(np.log2(_FINER * cells)))
    frequencies = np.arange(size // 2 + 1) * (cells - 1) / size
    kept = frequencies <= cycles
    place = np.empty(len(x), dtype=np.intp)
    for group in groups:
        place[group] = np.rint((x[group] - np.min(x[group])) / span * (cells - 1)).astype(np.intp)
    square = float(rows.left @ rows.left)
    for grows, growth in _growths(rows, name):
        power = np.zeros(size // 2 + 1)
        for group in groups:
            cell = np.bincount(place[group], (rows.left * growth)[group], minlength=cells)
            power += 2.0 * np.abs(np.fft.rfft(cell, size)) ** 2 / float(np.sum(growth[group] ** 2))
        yield _Scan(name, grows, growth, x, span, cycles, frequencies[kept], power[kept] / square)


def _growths(rows: SweptRows, name: Coordinate) -> Iterator[tuple[bool, np.ndarray]]:
    yield False, np.ones(len(rows.left))
    pressure = rows.inputs.get("pressure")
    if pressure is not None and name != "pressure" and np.min(pressure) >= 0.0:
        mean = float(np.mean(pressure))
        if np.ptp(pressure) > 0.2 * mean > 0.0:
            yield True, pressure / mean


def _since_turn(x: np.ndarray, least: float) -> np.ndarray:
    """Way since the last turn, an extreme that the course leaves by ``least``; NaN before the first one."""
    since = np.full(len(x), np.nan)
    start, extreme = None, 0
    way = 0.0  # sign of the motion, once it is known
    for row, value in enumerate(x):
        if way == 0.0:
            way = float(np.sign(value - x[0])) if abs(value - x[0]) > least else 0.0
            extreme = row
        elif way * (value - x[extreme]) >= 0.0:
            extreme = row
        elif way * (x[extreme] - value) > least:
            start, way = extreme, -way
            since[start:row] = np.abs(x[start:row] - x[start])
            extreme = row
        if start is not None:
            since[row] = abs(value - x[start])
    return since


def _gap(x: np.ndarray) -> float:
    """The gap between neighbouring readings that half of the range has at least: steps count, not holds."""
    gaps = np.sort(np.diff(np.sort(x)))
    covered = np.cumsum(gaps)
    return float(gaps[np.searchsorted(covered, 0.5 * covered[-1])])


def _judged(rows: SweptRows, scan: _Scan, tried: float) -> Repetition | None:
    """The best period of a scan, where it stands every test."""
    fast = np.flatnonzero(scan.frequencies >= REPETITION.periods)
    if not len(fast):
        return None
    place = fast[np.argmax(scan.shares[fast])]
    peak = float(scan.shares[place])
    slow = (scan.frequencies >= REPETITION.first) & (
        scan.frequencies <= REPETITION.far * scan.frequencies[place]
    )
    before = (scan.frequencies >= scan.frequencies[place] - 1.0) & (np.arange(len(scan.shares)) < place)
    if (
        peak < 0.5 * REPETITION.share
        or np.any(scan.shares[slow] > REPETITION.slower * peak)
        or np.any(scan.shares[before] > peak)  # it is still falling where the scan begins
    ):
        return None
    beside = scan.frequencies[place] + np.linspace(-0.5, 0.5, _BESIDE)
    fits = [(_Fit.of(rows, scan, each), float(each)) for each in beside if each >= REPETITION.periods]
    fit, cycles = max(fits, key=lambda pair: pair[0].explained)
    square = float(rows.left @ rows.left)
    share, of_left = fit.explained / rows.whole, fit.explained / square
    if share < REPETITION.share:
        return None
    labels = np.zeros(len(rows.left), dtype=np.intp) if scan.over != "time" else rows.record
    pairs = int(labels.max()) + 1
    # The polynomials take the slowest part of noise that hangs together: it is judged by all of it.
    independent = effective_rows(rows.own - fit.values, rows.lines, ())
    chance = _BETWEEN * tried * _chance(share, independent, pairs)
    left_out = min(fit.left_out(rows, way) for way in _ways(rows, scan.over))
    if chance > REPETITION.false_alarm or left_out < REPETITION.holds * of_left:
        return None
    records = int(rows.record.max()) + 1  # of a map each row is one
    by_record = scan.over != "time" and 1 < records <= len(rows.parts)
    parts, shown = _shown(rows, fit, rows.record if by_record else rows.sweep)
    if shown < REPETITION.shown * parts or not _is_everywhere(
        rows, scan, fit, REPETITION.everywhere * of_left
    ):
        return None
    return Repetition(
        scan.over, scan.span / cycles, share, fit.amplitude, scan.grows,
        left_out * square / rows.whole, parts, shown, not by_record,
    )  # fmt: skip


@dataclass(frozen=True)
class _Fit:
    """Sine and cosine of one period, without what the polynomials follow, and their weights.

    ``labels``: rows of one label share the phase.
    """

    columns: np.ndarray
    labels: np.ndarray
    weights: np.ndarray
    explained: float

    @classmethod
    def of(cls, rows: SweptRows, scan: _Scan, cycles: float) -> _Fit:
        """The fit to all rows."""
        angle = 2.0 * np.pi * cycles / scan.span * scan.x
        columns = rows.projected(np.column_stack([np.sin(angle), np.cos(angle)]) * scan.growth[:, None])
        labels = rows.record if scan.over == "time" else np.zeros(len(angle), dtype=np.intp)
        weights = _weights(columns, rows.left, labels, np.ones(len(angle), bool))
        values = np.sum(columns * weights[labels], axis=1)
        return cls(columns, labels, weights, float(2.0 * values @ rows.left - values @ values))

    @property
    def values(self) -> np.ndarray:
        """The repetition at each row."""
        return np.sum(self.columns * self.weights[self.labels], axis=1)

    @property
    def amplitude(self) -> float:
        """Mean over the labels, in proportion to their rows."""
        return float(np.mean(np.hypot(*self.weights[self.labels].T)))

    def predicted_share(self, rows: SweptRows, out: np.ndarray) -> float:
        """Share of the rows left out that a fit to the others explains."""
        weights = _weights(self.columns, rows.left, self.labels, ~out)
        error = rows.left[out] - np.sum(self.columns[out] * weights[self.labels[out]], axis=1)
        return 1.0 - float(error @ error) / max(float(rows.left[out] @ rows.left[out]), 1e-300)

    def left_out(self, rows: SweptRows, half: np.ndarray) -> float:
        """The smaller share of the two halves, each explained by the fit to the other."""
        return min(self.predicted_share(rows, half), self.predicted_share(rows, ~half))


def _weights(columns: np.ndarray, left: np.ndarray, labels: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Weights of sine and cosine for each label, shape (labels, 2); 0 where no row is inside."""
    result = np.zeros((int(labels.max()) + 1, 2))
    for label in range(len(result)):
        chosen = inside & (labels == label)
        if np.count_nonzero(chosen) > 2:
            result[label] = np.linalg.lstsq(columns[chosen], left[chosen], rcond=None)[0]
    return result


def _ways(rows: SweptRows, over: Coordinate) -> Iterator[np.ndarray]:
    """Halves of the rows: every other sweep, every other pair of them, every other record.

    A single sweep, and the sweeps of a record in time, have no others: they are cut in two.
    """
    sweeps = len(rows.parts)
    records = int(rows.record.max()) + 1
    per_record = [len(np.unique(rows.sweep[rows.record == label])) for label in range(records)]
    if sweeps < 2 or (over == "time" and min(per_record) < 2):
        half = np.zeros(len(rows.left), bool)
        for label in range(records):
            places = np.flatnonzero(rows.record == label)
            half[places[: len(places) // 2]] = True
        yield half
        return
    yield rows.sweep % 2 == 0
    if sweeps >= 4 and (over != "time" or min(per_record) >= 4):
        yield (rows.sweep // 2) % 2 == 0
    if 1 < records <= sweeps and over != "time":
        yield rows.record % 2 == 0


def _shown(rows: SweptRows, fit: _Fit, parts: np.ndarray) -> tuple[int, int]:
    """(number of parts, of those that the fit to the others explains); rows of a part share their phase."""
    number = int(parts.max()) + 1
    if number < 2:
        return 1, 1
    products = fit.columns[:, :, None] * fit.columns[:, None, :]
    normal, right = np.zeros((number, 2, 2)), np.zeros((number, 2))
    np.add.at(normal, parts, products)
    np.add.at(right, parts, fit.columns * rows.left[:, None])
    label = np.zeros(number, dtype=np.intp)
    label[parts] = fit.labels
    whole, whole_right = np.zeros((len(fit.weights), 2, 2)), np.zeros((len(fit.weights), 2))
    np.add.at(whole, label, normal)
    np.add.at(whole_right, label, right)
    inverse = np.linalg.pinv(whole[label] - normal, hermitian=True)
    weights = np.einsum("pij,pj->pi", inverse, whole_right[label] - right)
    explained = 2.0 * np.sum(weights * right, axis=1) - np.einsum("pi,pij,pj->p", weights, normal, weights)
    return number, int(np.count_nonzero(explained > 0.0))


def _is_everywhere(rows: SweptRows, scan: _Scan, fit: _Fit, least: float) -> bool:
    """Whether each third of the range shows it: one bump is no repetition."""
    place = (scan.x - np.min(scan.x)) / max(float(np.ptp(scan.x)), 1e-300)
    third = np.minimum((REPETITION.parts * place).astype(int), REPETITION.parts - 1)
    error = (rows.left - fit.values) ** 2
    squares = np.bincount(third, rows.left**2, minlength=REPETITION.parts)
    return bool(np.all(np.bincount(third, error, minlength=REPETITION.parts) <= (1.0 - least) * squares))


def _chance(share: float, rows: float, pairs: int) -> float:
    """Chance that noise has this share explained by so many pairs of sine and cosine.

    The share has the beta distribution with ``pairs`` and ``rows/2 - pairs``.
    """
    other = 0.5 * rows - pairs
    if other <= 0.0 or share >= 1.0:
        return 1.0 if other <= 0.0 else 0.0
    terms = [
        lgamma(other + k) - lgamma(other) - lgamma(k + 1.0) + k * log(share) + other * log(1.0 - share)
        for k in range(pairs)
    ]
    return min(1.0, sum(exp(term) for term in terms))


def _is_driven(rows: SweptRows, period: float) -> bool:
    """Whether a period of time may be a multiple of what drives the test.

    What the model lacks repeats with length and pressure, and with their multiples. A pull at one speed
    repeats nothing.
    """
    time = rows.inputs["time"]
    for values in (rows.inputs[name] for name in ("length", "pressure") if name in rows.inputs):
        for label in range(int(rows.record.max()) + 1):
            inside = np.flatnonzero(rows.record == label)
            inside = inside[np.argsort(time[inside])]
            grid = np.linspace(time[inside[0]], time[inside[-1]], 2 * len(inside))
            line = np.interp(grid, time[inside], values[inside])
            line -= np.polynomial.Polynomial.fit(grid, line, 1)(grid)
            if np.ptp(line) > REPETITION.moves * np.ptp(values):
                power = np.cumsum(np.abs(np.fft.rfft(line)) ** 2)
                cycles = float(np.searchsorted(power, REPETITION.driven * power[-1]))
                if float(np.ptp(grid)) / period < REPETITION.faster * cycles:
                    return True
    return False
