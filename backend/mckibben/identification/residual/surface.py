r"""A free surface on the residual of a fitted model: what further formulas of its variables could take.

The residual is followed by a sum of Gaussian processes, one for each block of one or two variables, in a sine
basis (Solin & Särkkä, Statistics and Computing 30 (2020) 419). With x in -1 ... 1, :math:`c = 1.5` and

.. math:: \phi_j(x) = c^{-1/2}\sin(\omega_j(x + c)),\quad \omega_j = \frac{\pi j}{2c},\qquad
   f(x) = \sum_j w_j\phi_j(x),\quad w_j \sim N(0, S(\omega_j)),\quad
   S(\omega) = a^2\sqrt{2\pi}\,\ell\,e^{-(\ell\omega)^2/2}

the n rows enter by their products with the k columns alone: :math:`O(n k^2)` once, and :math:`O(k^3)` for
each trial of the amplitudes a, lengths :math:`\ell` and the noise, which have the largest marginal likelihood
(Kennedy & O'Hagan, J. R. Statist. Soc. B 63 (2001) 425, for a surface on the residual of a physical model).

What acts through a reading, as the curve of a sensor that is not straight does, is a free function of that
reading times the model's derivative by it: a kink of a gauge is simple there, and in pressure and contraction
together it is not.

What the surface takes in sample is no proof: correlated noise is a surface as well. `Surface.gain` says what
it takes of rows that were left out, `likelihood_ratio` what it explains that correlated noise does not, and
`log_evidence` weighs models beside a surface: an effect is there if it is likelier than any formula.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise, product
from typing import Any, NamedTuple, Protocol

import numpy as np

from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import PredictedChannel, Predictor
from mckibben.identification.residual.correlated import Chain, Noise, Ways, tried_noises
from mckibben.identification.residual.profiles import variables_of
from mckibben.identification.thresholds import SURFACE

_MOST_ROWS = 2000  # for amplitudes, lengths and noise; more rows are thinned evenly

_EDGE = 1.5  # c: the basis ends half a half-width beyond the rows, where it would be 0
_RESOLVED = 3.0  # largest frequency times the shortest length: S falls to 1 % of its value at 0
_LONGEST = 6.0  # length beyond which a process is a straight line over the rows
_LEAST, _GREATEST = np.exp(-8.0), np.exp(3.0)  # amplitude over the rms of the residual
_LEAST_NOISE, _GREATEST_NOISE = 1e-3, 2.0  # the same of the noise
# Where the search for amplitudes and noise begins, over the rms. Of 94 residuals the first of them alone
# ended in a poor place, up to 1650 nats off, in 16; both in 7, up to 15 off.
_STARTS, _START_LENGTH = ((0.1, 0.5), (0.3, 0.15)), 0.7
_FLOOR = 1e-14  # of the squared amplitude; below, a column has no weight
_STEPS = 60  # of the search

# Functions of a block: of a pair, of what is swept finely, of a level, beside the sign of motion, of a play.
_PAIR, _FINE, _LEVEL, _SIGNED, _SIGNED_LEVEL, _PLAY = 8, 30, 12, 20, 8, 5
_CURVE = 20  # functions of what acts through a reading
_WITH_PLAY = 3  # functions of the level that a play goes with
_MOVING_PAIR = 6  # functions of a pair in a transient
_LEVELS = 12  # levels of a swept variable from which a fine block pays
_PLAYS = (0.03, 0.1, 0.25)  # half widths of the plays, share of the range of their variable
_LAGS = (0.02, 0.06, 0.2, 0.6, 2.0)  # s; times of the lagged variables of a transient

_MAIN = (
    "pressure",
    "contraction",
    "stroke",
    "load",
    "temperature",
    "command",
)  # no surface beyond their range
_BESIDE = 1e-3  # of the range; so far beyond the other rows is still within
_BLOCKS, _BLOCK_FOLDS = 40, 8  # short blocks of each run, left out in turn in so many folds
_DRAWS, _SEED = 2000, 0  # of the bootstrap over groups
_INTERVAL = (0.05, 0.95)

_AMPLITUDES = np.geomspace(1e-6, 1e4, 31)  # variance of the effect over that of the noise
_ROUGHNESSES = (0.2, 0.7)  # lengths of the processes whose columns are tried, of variables in -1 ... 1
_LATE = 2.0  # length of what is late alone: nearly in proportion
_WEIGHTY = 1e-2  # prior standard deviation of a column over the largest one, below which it is left out
_MOST_LINE_ROWS = 6000  # for the likelihood ratio; of more rows every second, third ... of each line is taken
_SIZED = 1e-11  # of the largest size of an effect, below which a direction of it has none
# The noises are tried with so many directions of an effect; then with all of them, until the log likelihood
# of the next one, with what these brought to others, is so far below the largest one.
_ROUGH, _NEAR = 80, 6.0
_PROJECTED = 1e-10  # of a sum of squares, below which a column lies among the others


class Fitted(Protocol):
    """What a surface needs of a `mckibben.identification.fit.fitted_model.FittedModel`."""

    @property
    def fit_model(self) -> FitModel:
        """The model with the fitted values."""
        ...

    @property
    def residual(self) -> np.ndarray:
        """Measured minus predicted, weighted, shape (values,)."""
        ...

    @property
    def jacobian(self) -> np.ndarray:
        """Derivatives of the prediction, weighted likewise, shape (values, free)."""
        ...

    @property
    def aside(self) -> np.ndarray | None:
        """Mask of values that were set aside; None for none."""
        ...

    @property
    def lost(self) -> int:
        """Number of values without a finite prediction."""
        ...

    @property
    def _linear(self) -> tuple[np.ndarray, ...]:
        """Of the inner parameters over their ranges: Jacobian, normal matrix, bounds, prior and its pull."""
        ...


@dataclass(frozen=True, eq=False)
class Surface:
    """A free surface on the residual of a model.

    Attributes:
        left: rms that model and surface would leave, in the units of the scaled residual:
            :math:`\\sqrt{RSS/(n - k)}` with k effective degrees of freedom.
        numbers: effective degrees of freedom, rounded up.
        gain: for each way of `foldings_of`, 1 - MSE(model + surface)/MSE(model) of left-out groups, over the
            rows within the range of the other groups; NaN where less than three groups have such rows.
        gain_low, gain_high: its 90 % interval, by a bootstrap of whole groups.
        inside: for each way, share of these rows; a surface corrects no other row and is not judged by it.
        independent: for each way, whether no sweep has rows in two of its groups. Otherwise correlated noise
            goes on from the rows of one group to those of the next one, and a gain proves nothing by itself.
        values: the surface at each value of the predictor, shape (values,).
        deviations: its standard deviation, shape (values,), if the noise were white.
        variables: the channels that matter, the most important first, each with the share of the surface
            that the blocks of it have.
        left_out: for each way, rms of model and surface over the rows inside; NaN likewise.
        rows_inside: for each way, these rows, a mask.
    """

    left: float
    numbers: int
    gain: tuple[float, ...]
    gain_low: tuple[float, ...]
    gain_high: tuple[float, ...]
    inside: tuple[float, ...]
    independent: tuple[bool, ...]
    values: np.ndarray
    deviations: np.ndarray
    variables: tuple[tuple[str, float], ...]
    left_out: tuple[float, ...] = ()
    rows_inside: tuple[np.ndarray, ...] = ()

    @property
    def sparing(self) -> bool:
        """Whether it has so few numbers that what it leaves says something: with more it interpolates."""
        return SURFACE.per_number * self.numbers <= len(self.values)


@dataclass(frozen=True, eq=False)
class Block:
    """A Gaussian process of one or two variables.

    Attributes:
        over: the channels that it is a function of.
        places: the variables, each from -1 to 1, shape (rows, variables).
        orders: functions of each variable.
        factor: that multiplies it, such as the sign of motion, shape (rows,).
        late: whether it is a function of what a channel was before.
    """

    over: tuple[str, ...]
    places: np.ndarray
    orders: tuple[int, ...]
    factor: np.ndarray | None = None
    late: bool = False

    @cached_property
    def waves(self) -> np.ndarray:
        """Frequencies, shape (columns, variables)."""
        numbers = product(*(range(1, order + 1) for order in self.orders))
        return np.array(list(numbers), dtype=float) * (np.pi / (2.0 * _EDGE))

    @property
    def shortest(self) -> np.ndarray:
        """Shortest length of each variable that the functions resolve."""
        return _RESOLVED * 2.0 * _EDGE / (np.pi * np.array(self.orders))

    def columns(self, places: np.ndarray, factor: np.ndarray | None) -> np.ndarray:
        """The functions at some places, shape (places, columns)."""
        first, *others = (
            np.sin(np.outer(place + _EDGE, np.arange(1, order + 1) * (np.pi / (2.0 * _EDGE))))
            / np.sqrt(_EDGE)
            for place, order in zip(places.T, self.orders, strict=True)
        )
        for other in others:
            first = (first[:, :, None] * other[:, None, :]).reshape(len(first), -1)
        return first if factor is None else first * factor[:, None]

    def at_rows(self) -> np.ndarray:
        """The functions at the rows, shape (rows, columns)."""
        return self.columns(self.places, self.factor)

    def clipped(self, rows: np.ndarray, others: np.ndarray) -> np.ndarray:
        """The functions at some rows (a mask), whose variables go to the range of the others."""
        low, high = np.min(self.places[others], axis=0), np.max(self.places[others], axis=0)
        factor = None if self.factor is None else self.factor[rows]
        return self.columns(np.clip(self.places[rows], low, high), factor)

    def variances(self, amplitude: float, lengths: np.ndarray) -> np.ndarray:
        """Prior variances of the weights, shape (columns,)."""
        exponent = -0.5 * np.sum((lengths * self.waves) ** 2, axis=1)
        size = amplitude**2
        return size * np.prod(np.sqrt(2.0 * np.pi) * lengths) * np.exp(exponent) + _FLOOR * size


@dataclass(frozen=True, eq=False)
class Likeliest:
    """Amplitudes, lengths and noise with the largest marginal likelihood.

    Attributes:
        logs: logarithms of amplitudes (over the rms), of lengths and of the noise (over the rms).
        log_evidence: log marginal likelihood.
        variances: prior variances of the weights, shape (columns,).
        noise: variance of the noise.
    """

    logs: np.ndarray
    log_evidence: float
    variances: np.ndarray
    noise: float

    @property
    def roots(self) -> np.ndarray:
        """Prior standard deviations of the weights."""
        return np.sqrt(self.variances)

    def weights(self, gram: np.ndarray, moment: np.ndarray) -> np.ndarray:
        """Mean of the weights from the products of the columns with themselves and with the residual."""
        roots = self.roots
        whole = roots[:, None] * gram * roots + self.noise * np.eye(len(roots))
        return roots * np.linalg.solve(whole, roots * moment)


class _Likelihood:
    """Negative log marginal likelihood of a residual, and its gradient, from products of columns.

    Args:
        blocks: in the order of the columns.
        gram, moment: products of the columns with themselves and with the residual.
        square: sum of squares of the residual.
        count: rows less the constants that were projected out of residual and columns.
    """

    def __init__(
        self, blocks: Sequence[Block], gram: np.ndarray, moment: np.ndarray, square: float, count: int
    ) -> None:
        self.blocks, self.count = blocks, count
        self.size = float(np.sqrt(max(square / max(count, 1), 1e-300)))
        self.gram, self.moment, self.square = gram, moment / self.size, square / self.size**2
        amplitudes, dimensions = len(blocks), [len(block.orders) for block in blocks]
        columns = [len(block.waves) for block in blocks]
        self.lengths = slice(amplitudes, amplitudes + sum(dimensions))
        self.of = np.repeat(np.arange(amplitudes), columns)
        # Of each column its squared frequencies, and the variables that it has.
        self.waves = np.zeros((sum(columns), sum(dimensions)))
        self.has = np.zeros_like(self.waves)
        row = column = 0
        for block in blocks:
            here = slice(row, row + len(block.waves)), slice(column, column + len(block.orders))
            self.waves[here], self.has[here] = block.waves**2, 1.0
            row, column = here[0].stop, here[1].stop
        self.whole = np.empty_like(gram, order="F")
        shortest = np.concatenate([np.minimum(block.shortest, 0.5 * _LONGEST) for block in blocks])
        self.low = np.log([*[_LEAST] * amplitudes, *shortest, _LEAST_NOISE])
        self.high = np.log([*[_GREATEST] * amplitudes, *[_LONGEST] * len(shortest), _GREATEST_NOISE])

    def starts(self, before: np.ndarray | None) -> list[np.ndarray]:
        """Where the search begins; after another one no amplitude begins at 0, where nothing changes it."""
        blocks, lengths = len(self.blocks), self.has.shape[1]
        if before is not None:
            usual = [np.concatenate([np.maximum(before[:blocks], np.log(0.1)), before[blocks:]])]
        else:
            usual = [
                np.log([amplitude] * blocks + [_START_LENGTH] * lengths + [noise])
                for amplitude, noise in _STARTS
            ]
        return [np.clip(start, self.low, self.high) for start in usual]

    def shapes(self, logs: np.ndarray) -> np.ndarray:
        """Prior variances of the weights of processes whose amplitude is 1, without the least one."""
        lengths = logs[self.lengths]
        sizes = self.has @ (lengths + 0.5 * np.log(2.0 * np.pi))
        return np.exp(sizes - 0.5 * (self.waves @ np.exp(2.0 * lengths)))

    def variances(self, logs: np.ndarray) -> np.ndarray:
        """Prior variances of the weights, as `Block.variances`."""
        return np.exp(2.0 * logs[: len(self.blocks)])[self.of] * (self.shapes(logs) + _FLOOR)

    def factor(self, roots: np.ndarray, noise: float) -> np.ndarray | None:
        """Cholesky's factor of the products of the columns over the noise, and 1 each; None without one."""
        np.multiply(self.gram, roots / noise, out=self.whole)
        self.whole *= roots[:, None]
        self.whole.reshape(-1, order="F")[:: len(roots) + 1] += 1.0
        factor, failed = _lapack().potrf(self.whole, lower=1, clean=1, overwrite_a=1)
        return None if failed else factor

    def alike(self, logs: np.ndarray) -> float:
        """Log marginal likelihood at the best size, with amplitudes and noise in the ratios of ``logs``."""
        noise = float(np.exp(2.0 * logs[-1]))
        roots = np.sqrt(self.variances(logs))
        factor = self.factor(roots, noise)
        if factor is None:
            return -np.inf
        right = _lapack().trtrs(factor, roots * self.moment, lower=1)[0]
        square = max(self.square - float(right @ right) / noise, 1e-12 * self.square)
        log_det = 2.0 * float(np.sum(np.log(np.diag(factor))))
        own = -0.5 * (self.count * (np.log(2.0 * np.pi * square / self.count) + 1.0) + log_det)
        return own - self.count * float(np.log(self.size))

    def __call__(self, logs: np.ndarray) -> tuple[float, np.ndarray]:
        shapes, amplitudes = self.shapes(logs), len(self.blocks)
        variances, noise = (
            np.exp(2.0 * logs[:amplitudes])[self.of] * (shapes + _FLOOR),
            np.exp(2.0 * logs[-1]),
        )
        roots = np.sqrt(variances)
        factor = self.factor(roots, noise)
        if factor is None:
            return 1e12, np.zeros_like(logs)
        log_det = 2.0 * float(np.sum(np.log(np.diag(factor))))
        weights = roots * _lapack().potrs(factor, roots * self.moment, lower=1)[0] / noise
        inverse = _lapack().trtri(factor, lower=1, overwrite_c=1)[0]
        diagonal = np.einsum("ij,ij->j", inverse, inverse)
        # At the best weights, so that their rounding errors count by their squares only.
        fit = float(weights @ self.moment)
        rest = max(self.square - 2.0 * fit + float(weights @ (self.gram @ weights)), 0.0)
        penalties = weights**2 / variances
        value = 0.5 * (self.count * np.log(2.0 * np.pi * noise) + log_det + rest / noise + np.sum(penalties))
        # By the logarithm of each variance, then by amplitude and lengths.
        by_variance = 0.5 * ((1.0 - diagonal) - penalties)
        free = by_variance * shapes / (shapes + _FLOOR)
        slope = np.concatenate([
            2.0 * np.bincount(self.of, by_variance, amplitudes),
            free @ self.has - np.exp(2.0 * logs[self.lengths]) * (free @ self.waves),
            [(self.count - len(variances) + np.sum(diagonal)) - rest / noise],
        ])  # fmt: skip
        return float(value), slope


class _Lapack(NamedTuple):
    potrf: Callable[..., Any]
    potrs: Callable[..., Any]
    trtri: Callable[..., Any]
    trtrs: Callable[..., Any]


@cache
def _lapack() -> _Lapack:
    from scipy.linalg import get_lapack_funcs

    return _Lapack(*get_lapack_funcs(_Lapack._fields, (np.empty((1, 1)),)))


def most_likely(
    blocks: Sequence[Block],
    gram: np.ndarray,
    moment: np.ndarray,
    square: float,
    count: int,
    *,
    before: np.ndarray | None = None,
) -> Likeliest:
    """Amplitudes, lengths and noise with the largest marginal likelihood.

    Args:
        blocks: in the order of the columns.
        gram: products of the columns with each other, shape (columns, columns).
        moment: products of the columns with the residual, shape (columns,).
        square: sum of squares of the residual.
        count: rows less the constants that were projected out of residual and columns.
        before: ``logs`` of a like problem, where the search begins.
    """
    from scipy.optimize import minimize

    likelihood = _Likelihood(blocks, gram, moment, square, count)
    bounds = list(zip(likelihood.low, likelihood.high, strict=True))
    options = {"maxiter": _STEPS, "ftol": 1e-7}
    ended = [
        minimize(likelihood, start, jac=True, method="L-BFGS-B", bounds=bounds, options=options)
        for start in likelihood.starts(before)
    ]
    found = min(ended, key=lambda each: each.fun)
    size = likelihood.size**2
    log_evidence = -float(found.fun) - 0.5 * count * np.log(size)
    variances, noise = likelihood.variances(found.x) * size, float(np.exp(2.0 * found.x[-1])) * size
    return Likeliest(found.x, float(log_evidence), variances, noise)


def likely_at_least(
    blocks: Sequence[Block],
    gram: np.ndarray,
    moment: np.ndarray,
    square: float,
    count: int,
    *,
    logs: np.ndarray,
) -> float:
    """A lower bound of the log evidence of `most_likely`, from where a like problem ended, in little time.

    Args:
        blocks, gram, moment, square, count: as of `most_likely`.
        logs: of the like problem; amplitudes and noise keep their ratios.
    """
    return _Likelihood(blocks, gram, moment, square, count).alike(logs)


def play(values: np.ndarray, half_width: float, records: np.ndarray) -> np.ndarray:
    """What a part that is dragged along within a play does, row after row of each record.

    Args:
        values: of what drags it, shape (rows,).
        half_width: of the play, in the same unit.
        records: label of each row; each record begins in the middle of the play.
    """
    dragged = np.empty(len(values))
    for label in np.unique(records):
        rows = np.flatnonzero(records == label)
        place = float(values[rows[0]])
        course = []
        for value in values[rows].tolist():
            place = min(max(place, value - half_width), value + half_width)
            course.append(place)
        dragged[rows] = course
    return dragged


def lagged(values: np.ndarray, time: np.ndarray, lag: float, records: np.ndarray) -> np.ndarray:
    """The values after a lag of first order, from rest at the first row of each record."""
    behind = np.empty(len(values))
    for label in np.unique(records):
        rows = np.flatnonzero(records == label)
        shares = -np.expm1(-np.maximum(np.diff(time[rows], prepend=time[rows[0]]), 0.0) / lag)
        place = float(values[rows[0]])
        course = []
        for value, share in zip(values[rows].tolist(), shares.tolist(), strict=True):
            place += share * (value - place)
            course.append(place)
        behind[rows] = course
    return behind


def unit_range(values: np.ndarray) -> np.ndarray:
    """The values from -1 to 1."""
    span = float(np.ptp(values))
    return 2.0 * (values - float(np.min(values))) / (span if span > 0.0 else 1.0) - 1.0


def levels_of(values: np.ndarray) -> int:
    """Number of different values, to a thousandth of their range."""
    span = float(np.ptp(values))
    return len(np.unique(np.round((values - float(np.min(values))) / span, 3))) if span > 0.0 else 1


def ways_of(variables: Mapping[str, np.ndarray]) -> np.ndarray | None:
    """Sign of motion of each row, shape (rows,); None where the rows do not have both directions."""
    direction = variables.get("direction", variables.get("speed"))
    if direction is None:
        return None
    sign = np.sign(direction)
    both = min(np.count_nonzero(sign > 0.0), np.count_nonzero(sign < 0.0)) >= SURFACE.fewest_of_a_way
    return sign if both else None


def _single(
    over: tuple[str, ...],
    values: np.ndarray,
    order: int,
    factor: np.ndarray | None = None,
    *,
    late: bool = False,
) -> Block:
    order = min(order, max(2 * levels_of(values), 3))
    return Block(channels_of(over), unit_range(values)[:, None], (order,), factor, late)


def _pair(over: tuple[str, ...], first: np.ndarray, second: np.ndarray, orders: tuple[int, int]) -> Block:
    return Block(channels_of(over), np.column_stack([unit_range(first), unit_range(second)]), orders)


def channels_of(names: tuple[str, ...]) -> tuple[str, ...]:
    """Of a run's own variables the channels that they are predictions of."""
    of_runs = {"stroke": "displacement", "speed": "velocity"}
    return tuple(of_runs.get(name, name) for name in names)


def still_blocks(
    variables: Mapping[str, np.ndarray], records: np.ndarray | None = None, *, pair: int = _PAIR
) -> list[Block]:
    """Blocks of rows that are measured step by step.

    Args:
        variables: name -> shape (rows,).
        records: label of each row where the rows are in the order of the test; None for no plays.
        pair: functions of each variable of a pair.
    """
    main = {name: variables[name] for name in _MAIN if name in variables}
    blocks = []
    if len(main) > 1:
        first, second = list(main)[:2]
        blocks.append(_pair((first, second), main[first], main[second], (pair, pair)))
    for name, values in main.items():
        blocks.append(_single((name,), values, _FINE if levels_of(values) > _LEVELS else _LEVEL))
    sign = ways_of(variables)
    if sign is not None:
        for name, values in list(main.items())[:2]:
            order = _SIGNED if levels_of(values) > _LEVELS else _SIGNED_LEVEL
            blocks.append(_single(("direction", name), values, order, sign))
    if records is not None:
        blocks += _plays(main, records)
    return blocks


def _plays(main: Mapping[str, np.ndarray], records: np.ndarray) -> list[Block]:
    """Plays of contraction and pressure where these move within the records, beside the other of both."""
    blocks = []
    for name, beside in (("contraction", "pressure"), ("pressure", "contraction")):
        if name not in main:
            continue
        values, span = main[name], float(np.ptp(main[name]))
        for share in _PLAYS:
            ahead = values - play(values, share * span, records)
            if np.ptp(ahead) < share * span:
                continue
            over = (name, "direction")
            if beside in main:
                order = min(_WITH_PLAY, levels_of(main[beside]))
                blocks.append(_pair(over, ahead, main[beside], (_PLAY, order)))
            else:
                blocks.append(_single(over, ahead, _PLAY))
    return blocks


def moving_blocks(
    variables: Mapping[str, np.ndarray], time: np.ndarray, records: np.ndarray, *, late: bool = True
) -> list[Block]:
    """Blocks of a run: its predicted stroke and speed, its inputs, and all of them late.

    Args:
        variables: name -> shape (rows,).
        time: of each row [s].
        records: label of each row.
        late: whether lags and plays are among them.
    """
    blocks = []
    names = [name for name in ("stroke", "speed", "pressure", "command") if name in variables]
    for name in names:
        blocks.append(_single((name,), variables[name], _LEVEL))
    for first, second in (("stroke", "speed"), ("pressure", "stroke"), ("command", "pressure")):
        if first in variables and second in variables:
            pair = variables[first], variables[second]
            blocks.append(_pair((first, second), *pair, (_MOVING_PAIR, _MOVING_PAIR)))
    sign = ways_of(variables)
    if sign is not None:
        for name in ("stroke", "pressure"):
            if name in variables:
                blocks.append(_single(("direction", name), variables[name], _SIGNED_LEVEL, sign))
    if not late:
        return blocks
    duration = max(float(np.ptp(time[records == label])) for label in np.unique(records))
    steps = np.diff(time)[np.diff(records) == 0]
    step = float(np.median(steps)) if len(steps) else duration
    for name in ("stroke", "pressure", "command"):
        if name not in variables:
            continue
        values = variables[name]
        for lag in _LAGS:
            if not step < lag < 0.5 * duration:
                continue
            behind = values - lagged(values, time, lag, records)
            if np.ptp(behind) > 1e-6 * np.ptp(values):
                blocks.append(_single((name, "time"), behind, _PLAY, late=True))
    if "stroke" in variables:
        values = variables["stroke"]
        for share in _PLAYS[1:]:
            ahead = values - play(values, share * float(np.ptp(values)), records)
            blocks.append(_single(("stroke", "direction"), ahead, _PLAY))
    return blocks


def _moving_variables(
    fitted: Fitted, predictor: Predictor, rows: np.ndarray
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Variables of a run at some values, with what the model itself predicts, and their times."""
    inputs = {name: values[rows] for name, values in predictor.inputs.items()}
    predicted = predictor.predict(fitted.fit_model)
    of = {channel.name: predicted[channel.rows] for channel in predictor.channels}
    time, variables = inputs["time"], {}
    stroke = of.get("displacement", inputs.get("displacement"))
    if stroke is not None and len(stroke) == len(rows):
        records = predictor.records[rows]
        speed = np.zeros(len(rows))
        for label in np.unique(records):
            own = np.flatnonzero(records == label)
            if len(own) > 2:
                speed[own] = np.gradient(stroke[own], time[own])
        variables |= {"stroke": stroke, "speed": speed}
    pressure = of.get("pressure", inputs.get("pressure"))
    if pressure is not None:
        variables["pressure"] = pressure
    if "command" in inputs:
        variables["command"] = inputs["command"]
    return {
        name: values
        for name, values in variables.items()
        if len(values) == len(rows)
        and np.all(np.isfinite(values))
        and np.ptp(values) > 1e-9 * np.max(np.abs(values))
    }, time


def in_order(predictor: Predictor) -> bool:
    """Whether the rows are in the order of the test: they have a time, or directions that come of it."""
    ordered = all(np.all(np.diff(sweep) == 1) for sweep in predictor.sweeps)
    return ordered and ("time" in predictor.inputs or np.ptp(predictor.inputs.get("direction", [0.0])) > 0.0)


def surface_variables(
    fitted: Fitted, predictor: Predictor, rows: np.ndarray
) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
    """Variables of a surface at the values of a channel, and the times of a run.

    Args:
        fitted: the model, whose own stroke and speed are variables of a run.
        predictor: the data.
        rows: indices of the values of the channel.
    """
    if predictor.kind == "transient" and "time" in predictor.inputs:
        return _moving_variables(fitted, predictor, rows)
    known = {name: values[rows] for name, values in variables_of(predictor, fitted.fit_model).items()}
    return {name: values for name, values in known.items() if np.ptp(values) > 0.0}, None


def _through_blocks(
    fitted: Fitted, predictor: Predictor, channel: PredictedChannel, rows: np.ndarray
) -> list[Block]:
    """Blocks of what acts through a reading: functions of it, times the derivative of the prediction by it.

    For the predicted channel itself they are functions of what the model predicts.
    """
    curves = [(channel.name, predictor.predict(fitted.fit_model)[rows], None)]
    for name, over in (("pressure", "pressure"), ("length", "contraction"), ("load", "load")):
        if name in predictor.inputs and name != channel.name:
            slope = predictor.input_slope(fitted.fit_model, name)[rows]
            curves.append((over, predictor.inputs[name][rows], slope / max(np.max(np.abs(slope)), 1e-300)))
    return [
        _single((over,), values, _CURVE, factor)
        for over, values, factor in curves
        if np.all(np.isfinite(values))
        and np.ptp(values) > 1e-9 * np.max(np.abs(values))
        and (factor is None or np.any(factor))
    ]


def _blocks_of(
    fitted: Fitted, predictor: Predictor, channel: PredictedChannel, rows: np.ndarray, *, through: bool = True
) -> tuple[list[Block], list[np.ndarray]]:
    """Blocks of the values of a channel, and the variables beyond whose range nothing is corrected.

    ``through``: whether what acts through a reading is among them.
    """
    variables, time = surface_variables(fitted, predictor, rows)
    records = predictor.records[rows]
    if time is None:
        blocks = still_blocks(variables, records if in_order(predictor) else None)
        blocks += _through_blocks(fitted, predictor, channel, rows) if blocks and through else []
    else:
        blocks = moving_blocks(variables, time, records)
    return blocks, [unit_range(variables[name]) for name in _MAIN if name in variables]


def values_of(fitted: Fitted, channel: PredictedChannel) -> np.ndarray:
    """Indices of the values of a channel that were not set aside."""
    rows = np.arange(len(fitted.residual))[channel.rows]
    return rows if fitted.aside is None else rows[~fitted.aside[rows]]


def surface_of(fitted: Fitted, predictor: Predictor) -> Surface | None:
    """The free surface on the residual of a fitted model; None below twenty rows and after a stopped run.

    Left-out groups are predicted by the physical model with its constants refitted without them to first
    order, and by a surface that is fitted to the residual of the others. Three guards keep the surface from
    doing harm there: it corrects nothing beyond the range of the other rows, its variables go to that range,
    and it is multiplied by :math:`\\alpha = \\sum e c / \\sum c^2` of the other groups, within 0 ... 1.

    Args:
        fitted: the model.
        predictor: the data.
    """
    count = len(fitted.residual)
    values, deviations = np.zeros(count), np.zeros(count)
    square, numbers, counted = 0.0, 0, 0
    whole = 0.0
    shares: dict[str, float] = {}
    foldings = foldings_of(predictor)
    ways = [_Way(fitted, labels) for labels in foldings]
    found = False
    for channel in predictor.channels:
        rows = values_of(fitted, channel)
        counted += len(rows)
        if len(rows) < SURFACE.fewest or fitted.lost or not np.any(fitted.residual[rows]):
            square += float(np.sum(fitted.residual[rows] ** 2))
            continue
        blocks, edges = _blocks_of(fitted, predictor, channel, rows)
        if not blocks:
            square += float(np.sum(fitted.residual[rows] ** 2))
            continue
        found = True
        part = _Part(blocks, fitted.residual[rows])
        values[rows], deviations[rows] = part.values, part.deviations
        rest = float(np.sum((fitted.residual[rows] - part.values) ** 2))
        square += rest * len(rows) / max(len(rows) - part.freedom, 1.0)
        numbers += int(np.ceil(part.freedom))
        for block, share in part.shares:
            whole += share
            for name in block.over:
                shares[name] = shares.get(name, 0.0) + share
        for way in ways:
            way.correct(part, rows, edges)
    if not found:
        return None
    order = sorted(shares.items(), key=lambda pair: -pair[1])
    return Surface(
        left=float(np.sqrt(square / counted)),
        numbers=numbers,
        gain=tuple(way.gain for way in ways),
        gain_low=tuple(way.interval[0] for way in ways),
        gain_high=tuple(way.interval[1] for way in ways),
        left_out=tuple(way.left_out for way in ways),
        rows_inside=tuple(way.inside for way in ways),
        inside=tuple(float(np.mean(way.inside)) for way in ways),
        independent=tuple(
            all(np.ptp(labels[sweep]) == 0 for sweep in predictor.sweeps if len(sweep)) for labels in foldings
        ),
        values=values,
        deviations=deviations,
        variables=tuple((name, share / whole) for name, share in order if share > SURFACE.matters * whole),
    )


def foldings_of(predictor: Predictor) -> tuple[np.ndarray, ...]:
    """Ways of folding: those of the predictor, and of runs short blocks of time between others as well.

    A run is left out in blocks so long that a surface seldom holds what it would need there.
    """
    if predictor.kind != "transient":
        return predictor.folds
    labels = np.zeros(len(predictor.measured), dtype=np.int64)
    for record in np.unique(predictor.records):
        rows = np.flatnonzero(predictor.records == record)
        labels[rows] = np.arange(len(rows)) * _BLOCKS // len(rows) % _BLOCK_FOLDS
    return (*predictor.folds, labels)


class _Part:
    """The surface of one channel, fitted to all of its rows."""

    def __init__(self, blocks: Sequence[Block], residual: np.ndarray) -> None:
        self.blocks, self.residual = blocks, residual
        self.columns = np.hstack([block.at_rows() for block in blocks])
        self.gram, self.moment = self.columns.T @ self.columns, self.columns.T @ residual
        gram, moment, some = self.gram, self.moment, residual
        if len(residual) > _MOST_ROWS:
            thin = np.unique(np.linspace(0, len(residual) - 1, _MOST_ROWS).astype(int))
            columns, some = self.columns[thin], residual[thin]
            gram, moment = columns.T @ columns, columns.T @ some
        self.found = most_likely(blocks, gram, moment, float(some @ some), len(some))
        roots, noise = self.found.roots, self.found.noise
        inner = roots[:, None] * self.gram * roots
        inverse = np.linalg.inv(inner + noise * np.eye(len(roots)))
        self.freedom = float(np.sum(inverse * inner))
        weights = roots * (inverse @ (roots * self.moment))
        self.values = self.columns @ weights
        scaled = self.columns * roots
        self.deviations = np.sqrt(np.maximum(noise * np.sum((scaled @ inverse) * scaled, axis=1), 0.0))
        self.shares: list[tuple[Block, float]] = []
        place = 0
        for block in blocks:
            own = slice(place, place + len(block.waves))
            place = own.stop
            share = max(float(self.columns[:, own] @ weights[own] @ self.values), 0.0)
            self.shares.append((block, share))


class _Way:
    """A way of leaving out: the residual of each row with its group left out, without and with a surface."""

    def __init__(self, fitted: Fitted, labels: np.ndarray) -> None:
        self.labels, self.folds = labels, np.unique(labels)
        self.refitted = {label: residual_without(fitted, labels == label) for label in self.folds}
        self.model = _of_each_group(labels, self.refitted)
        self.rival, self.inside = self.model.copy(), np.zeros(len(labels), bool)

    def correct(self, part: _Part, rows: np.ndarray, edges: Sequence[np.ndarray]) -> None:
        """Take the surface of a channel from its left-out residuals."""
        labels, correction = self.labels[rows], np.zeros(len(rows))
        for label in np.unique(labels):
            out = labels == label
            if np.all(out):
                continue
            inside = out & np.all([within_others(edge, ~out) for edge in edges], axis=0) if edges else out
            inside &= _same_ways(part.blocks, out)
            self.inside[rows[inside]] = True
            if not np.any(inside):
                continue
            gone = part.columns[out]
            moment = part.columns[~out].T @ self.refitted[label][rows][~out]
            weights = part.found.weights(part.gram - gone.T @ gone, moment)
            columns = np.hstack([block.clipped(inside, ~out) for block in part.blocks])
            correction[inside] = columns @ weights
        left = self.model[rows]
        self.rival[rows] = left - _shrunk(left, correction, labels)

    @cached_property
    def _squares(self) -> tuple[np.ndarray, np.ndarray]:
        """Sums of squares of each group that has rows inside, without and with the surface."""
        place = np.searchsorted(self.folds, self.labels)[self.inside]
        before, after = (
            np.bincount(place, each[self.inside] ** 2, len(self.folds)) for each in (self.model, self.rival)
        )
        some = np.bincount(place, minlength=len(self.folds)) > 0
        return before[some], after[some]

    @property
    def gain(self) -> float:
        """1 - MSE(model + surface)/MSE(model) over the rows inside."""
        before, after = self._squares
        if len(before) < SURFACE.fewest_groups:
            return float("nan")
        return 1.0 - float(np.sum(after)) / max(float(np.sum(before)), 1e-300)

    @property
    def left_out(self) -> float:
        """Rms over the rows inside, with the surface."""
        some = self._squares[1]
        return (
            float(np.sqrt(np.sum(some) / np.sum(self.inside)))
            if len(some) >= SURFACE.fewest_groups
            else np.nan
        )

    @cached_property
    def interval(self) -> tuple[float, float]:
        """90 % interval of the gain."""
        before, after = self._squares
        groups = len(before)
        if groups < SURFACE.fewest_groups:
            return float("nan"), float("nan")
        drawn = np.random.default_rng(_SEED).integers(0, groups, (_DRAWS, groups))
        gains = 1.0 - after[drawn].sum(axis=1) / np.maximum(before[drawn].sum(axis=1), 1e-300)
        low, high = np.quantile(gains, _INTERVAL)
        return float(low), float(high)


def residual_without(fitted: Fitted, rows: np.ndarray) -> np.ndarray:
    """Residual of all rows with the constants refitted without some (a mask), to first order.

    As `FittedModel.square_without`, which returns the mean square of the rows left out.
    """
    jacobian, normal, low, high, prior, pull = fitted._linear
    if not jacobian.shape[1]:
        return fitted.residual
    out = jacobian[rows]
    inverse = np.linalg.pinv(normal - out.T @ out + np.diag(prior), rcond=1e-13, hermitian=True)
    return fitted.residual - jacobian @ np.clip(-inverse @ (out.T @ fitted.residual[rows] + pull), low, high)


def left_out_residual(fitted: Fitted, labels: np.ndarray) -> np.ndarray:
    """Residual of each group with the constants refitted without it, to first order, shape (values,)."""
    return _of_each_group(
        labels, {label: residual_without(fitted, labels == label) for label in np.unique(labels)}
    )


def _of_each_group(labels: np.ndarray, residuals: Mapping[int, np.ndarray]) -> np.ndarray:
    found = np.zeros(len(labels))
    for label, residual in residuals.items():
        found[labels == label] = residual[labels == label]
    return found


def within_others(values: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Mask of the rows within the range that a variable has in others (a mask)."""
    low, high = np.min(values[others]), np.max(values[others])
    return (values >= low - 2.0 * _BESIDE) & (values <= high + 2.0 * _BESIDE)


def _same_ways(blocks: Sequence[Block], out: np.ndarray) -> np.ndarray:
    """Mask of the rows whose sign of motion other rows have as well."""
    sign = next(
        (block.factor for block in blocks if "direction" in block.over and block.factor is not None), None
    )
    return np.ones(len(out), bool) if sign is None else np.isin(sign, np.unique(sign[~out]))


def _shrunk(left: np.ndarray, correction: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """The correction of each group times what the other groups show of it, from 0 to 1."""
    shrunk = np.zeros(len(left))
    products, squares = left * correction, correction**2
    for label in np.unique(labels):
        out = labels == label
        size = float(np.sum(squares[~out]))
        share = np.clip(float(np.sum(products[~out])) / size, 0.0, 1.0) if size > 0.0 else 0.0
        shrunk[out] = share * correction[out]
    return shrunk


def log_evidence(fitted: Fitted, predictor: Predictor) -> float | None:
    r"""Log evidence of a model beside a free surface; None where the rows are too few for one.

    With the n rows of a channel, the columns B of the surface with their variances D, and the derivatives K
    by the constants over their plausible ranges, each of which has half its range as its deviation before any
    data, :math:`r \sim N(0,\; s^2 + B D B^T + K K^T/4)`. Amplitudes, lengths and the noise s are those of the
    largest marginal likelihood beside constants that are free.

    Args:
        fitted: the model.
        predictor: the data.
    """
    constants = fitted._linear[0]
    total: float | None = None
    for channel in predictor.channels:
        rows = values_of(fitted, channel)
        rows = rows[np.unique(np.linspace(0, len(rows) - 1, min(len(rows), _MOST_ROWS)).astype(int))]
        if len(rows) < SURFACE.fewest or fitted.lost or not np.any(fitted.residual[rows]):
            continue
        blocks, _ = _blocks_of(fitted, predictor, channel, rows)
        if not blocks:
            continue
        columns = np.hstack([block.at_rows() for block in blocks])
        residual, own = fitted.residual[rows], constants[rows]
        own = own[:, np.any(own != 0.0, axis=0)]
        basis = np.linalg.qr(own)[0] if own.shape[1] else np.empty((len(rows), 0))
        outside, rest = columns - basis @ (basis.T @ columns), residual - basis @ (basis.T @ residual)
        found = most_likely(
            blocks, outside.T @ outside, outside.T @ rest, float(rest @ rest), len(rows) - basis.shape[1]
        )
        whole = np.hstack([columns * found.roots, 0.5 * own])
        factor = np.linalg.cholesky(whole.T @ whole / found.noise + np.eye(whole.shape[1]))
        moment = np.linalg.solve(factor, whole.T @ residual / found.noise)
        square = float(residual @ residual) / found.noise - float(moment @ moment)
        log_det = 2.0 * float(np.sum(np.log(np.diag(factor))))
        own_part = -0.5 * (len(rows) * float(np.log(2.0 * np.pi * found.noise)) + log_det + square)
        total = own_part if total is None else total + own_part
    return total


def likelihood_ratio(fitted: Fitted, predictor: Predictor) -> float:
    r"""Twice the gain in log likelihood by a free surface beside correlated noise; 0 where there is none.

    Of each channel, with its blocks as random effects of one common amplitude, see `ratio_of`; the largest
    one counts, of rough and smooth surfaces, and of what is late alone in a run.
    """
    largest = 0.0
    for channel, channel_lines in zip(predictor.channels, predictor.noise_lines, strict=True):
        rows = values_of(fitted, channel)
        if len(rows) < SURFACE.fewest or fitted.lost or not np.any(fitted.residual[rows]):
            continue
        blocks, _ = _blocks_of(fitted, predictor, channel, rows, through=False)
        if not blocks:
            continue
        columns = np.hstack([block.at_rows() for block in blocks])
        jacobian, residual = fitted.jacobian[rows], fitted.residual[rows]
        ways = [_thinned(lines, rows) for lines in channel_lines]
        largest = max(largest, ratio_of(jacobian, residual, columns, ways, _surfaces(blocks)))
    return largest


def ratio_of(
    jacobian: np.ndarray,
    residual: np.ndarray,
    columns: np.ndarray,
    ways: Ways,
    surfaces: Sequence[np.ndarray],
) -> float:
    r"""Twice the gain in log likelihood by a random effect, beside white noise and noise that is correlated.

    Without and with the effect the residual is :math:`r \sim N(K\beta, s^2(R + \lambda BDB^T))`, with the
    noises R of `mckibben.identification.residual.correlated`, of which both hypotheses choose for themselves,
    by restricted likelihood.

    Args:
        jacobian: K, shape (rows, constants).
        residual: r, shape (rows,).
        columns: B, shape (rows, columns).
        ways: lines in which the noise may be correlated, as indices of rows; the first holds all rows.
        surfaces: roots of D, each of shape (columns,); the one that gains most counts.
    """
    constants = jacobian[:, np.any(jacobian != 0.0, axis=0)]
    constants = constants / np.linalg.norm(constants, axis=0)
    own, freedom = constants.shape[1], len(residual) - constants.shape[1]
    if freedom < 2 or not np.any(residual):
        return 0.0
    square = float(residual @ residual)
    effects = [_principal(columns[:, surface > 0.0] * surface[surface > 0.0]) for surface in surfaces]
    without, beside = -np.inf, -np.inf
    for lines in ways:
        chain = Chain(lines)
        rows = chain.rows
        basis = np.linalg.qr(constants[rows])[0] if own else np.empty((len(rows), 0))
        noises = [each.noise for each in tried_noises(chain, basis, residual[rows])]
        beside_effects = _BesideEffects(
            chain, constants[rows], residual[rows], [effect[rows] for effect in effects], freedom, square
        )
        rough = beside_effects.likelihoods(noises, _ROUGH)
        without = max(without, *(alone for alone, _ in rough))
        more = 0.0  # by all directions
        for place in sorted(range(len(noises)), key=[-each[1] for each in rough].__getitem__):
            if rough[place][1] + more + _NEAR < beside:
                break
            ((_, whole),) = beside_effects.likelihoods([noises[place]], columns.shape[1])
            beside, more = max(beside, whole), max(more, whole - rough[place][1])
    return 2.0 * max(beside - without, 0.0)


@dataclass(frozen=True, eq=False)
class _BesideEffects:
    """A residual beside its constants and random effects, of the rows of a chain."""

    chain: Chain
    constants: np.ndarray
    residual: np.ndarray
    effects: Sequence[np.ndarray]
    freedom: int
    square: float

    def likelihoods(self, noises: Sequence[Noise], most: int) -> list[tuple[float, float]]:
        """For each noise the restricted log likelihood without an effect, and with the likeliest one.

        Args:
            noises: the noises.
            most: directions of an effect that are taken.
        """
        parts = [effect[:, :most] for effect in self.effects]
        ends = np.cumsum([1, *(part.shape[1] for part in parts)])  # after the residual
        table = np.column_stack([self.constants, self.residual, *parts])
        own, least = self.constants.shape[1], self.square / self.chain.longest
        found = []
        for products, log_det in self.chain.products(table, noises):
            plain, rest = _without_constants(products, own, self.freedom, least)
            gained = [
                _gained(rest[0, 0], rest[first:last, first:last], rest[0, first:last], self.freedom)
                for first, last in pairwise(ends)
            ]
            found.append((plain - 0.5 * log_det, plain + max(gained) - 0.5 * log_det))
        return found


def _principal(effect: np.ndarray) -> np.ndarray:
    """The same random effect with a mean square of 1, by columns of other directions, the largest first."""
    gram = effect.T @ effect
    sizes, turned = np.linalg.eigh(gram)
    kept = turned[:, sizes > _SIZED * sizes[-1]]
    return effect @ kept[:, ::-1] * np.sqrt(len(effect) / np.trace(gram))


def _without_constants(
    products: np.ndarray, own: int, freedom: int, least: float
) -> tuple[float, np.ndarray]:
    """Restricted log likelihood without the effect, and the products beside the constants.

    Args:
        products: of constants, residual and columns of the effect with each other.
        own: number of constants.
        freedom: rows less constants.
        least: that the generalised sum of squares can be; less is rounding error.
    """
    values, vectors = np.linalg.eigh(products[:own, :own]) if own else (np.ones(0), np.zeros((0, 0)))
    kept = values > _PROJECTED * np.max(values, initial=0.0)
    basis = vectors[:, kept] / np.sqrt(values[kept])
    shared = basis.T @ products[:own, own:]
    rest = products[own:, own:] - shared.T @ shared
    rest[0, 0] = max(float(rest[0, 0]), least)
    return -0.5 * (freedom * np.log(rest[0, 0] / freedom) + float(np.sum(np.log(values[kept])))), rest


def _gained(square: float, inner: np.ndarray, moment: np.ndarray, freedom: int) -> float:
    """Largest gain in log likelihood by an effect, over its amplitudes, for one noise."""
    from scipy.linalg import eigh

    sizes, turned = eigh(inner, driver="evd", check_finite=False)
    sizes, moments = np.maximum(sizes, 0.0), (turned.T @ moment) ** 2
    widened = 1.0 + _AMPLITUDES[:, None] * sizes
    shares = np.sum(_AMPLITUDES[:, None] * moments / widened, axis=1) / square
    gains = -0.5 * (freedom * np.log(np.maximum(1.0 - shares, 1e-12)) + np.sum(np.log(widened), axis=1))
    return float(np.max(gains, initial=0.0))


def _surfaces(blocks: Sequence[Block]) -> list[np.ndarray]:
    """Prior standard deviations of the columns, of processes of one length and one variance; 0 for none."""
    late = [block.late for block in blocks]
    kinds = [(length, [True] * len(blocks)) for length in _ROUGHNESSES]
    if any(late):
        kinds.append((_LATE, late))
    found = []
    for length, used in kinds:
        parts = []
        for block, taken in zip(blocks, used, strict=True):
            lengths = np.maximum(np.full(len(block.orders), length), block.shortest)
            roots = np.sqrt(block.variances(1.0, lengths)) * taken
            parts.append(np.where(roots > _WEIGHTY * np.max(roots), roots, 0.0))
        found.append(np.concatenate(parts))
    return found


def _thinned(lines: Sequence[np.ndarray], rows: np.ndarray) -> list[np.ndarray]:
    """The lines as places within ``rows``, thinned where there are many rows."""
    place = np.full(int(np.max(rows)) + 2, -1)  # the last one for a row that is not there
    place[rows] = np.arange(len(rows))
    step = -(-len(rows) // _MOST_LINE_ROWS)
    return [place[line][::step] for line in lines]
