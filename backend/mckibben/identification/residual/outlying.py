r"""Rows that do not fit: told from a local effect by the evidence of both.

A robust loss takes a narrow effect for bad rows. Neighbours and other pressures that share a deviation tell
them apart, as they make a free surface cheaper than rows that are set aside one by one. Of n readings of
range R, m rows M are set aside as readings that may be anything, a share :math:`\varepsilon` of all rows:

.. math:: E_m = \ln p(r_{\setminus M} \mid K, f) + m\ln\frac{\varepsilon}{2R} + (n-m)\ln(1-\varepsilon)

The evidence p of the other rows has the constants of the model (columns K) integrated out, and has a free
surface f (`mckibben.identification.residual.surface`) or none, whichever is likelier. Rows are candidates in
the order of their deleted studentised residuals (Rosner, Technometrics 25 (1983) 165), beside the model alone
and, where a surface pays, beside model and surface.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np

from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.profiles import range_text
from mckibben.identification.residual.surface import (
    Block,
    Fitted,
    Likeliest,
    channels_of,
    levels_of,
    likely_at_least,
    most_likely,
    moving_blocks,
    still_blocks,
    surface_variables,
    values_of,
)
from mckibben.identification.thresholds import ROWS

# Log evidence that the search of another surface is given at most, and for each row set aside.
_FURTHER, _FURTHER_PER_ROW = 4.0, 2.0
_PART, _MOST, _MOST_OF_MANY, _MANY = 4, 12, 20, 1000  # candidates: n/4, at most 12, of 1000 rows and more 20
_LEVERAGE = 0.999  # of a row that determines a constant alone, so that it fits by itself
_ALIKE = 1e-7  # singular value of the normalised Jacobian below which a direction is no constant
_ROUNDING = 1e-9  # of the range; smaller residuals are rounding errors
_PAIR = 5  # functions of each variable of a pair, with which a surface costs little
# Noise that grows with the reading: its logarithm over that of the size of the prediction, from logarithms of
# the residual, whose standard deviation is 1.11 for normal noise. Few rows that do not fit change it little.
_LOG_SCATTER = 1.11
_LEAST_SIZE = 0.05  # of the largest prediction; the noise of smaller ones is that of this one

Kind = Literal[
    "after a turn", "before a turn", "first of a sweep", "last of a sweep", "in a row", "sweep", "level"
]


@dataclass(frozen=True)
class Place:
    """What all rows that do not fit have in common.

    Rows in a row are more likely a course that neither model nor surface follows than wrong readings.

    Attributes:
        kind: of the place; a "level" is one value of a variable.
        variable: of a level, else empty.
        value: of a level [SI]; the number of a sweep from 0; else NaN.
        named: number of rows that do not fit, all at this place.
        rows: number of rows at it.
        chance: bound of the probability that as many rows anywhere lie at one place of any kind.
    """

    kind: Kind
    variable: str
    value: float
    named: int
    rows: int
    chance: float

    @property
    def sentence(self) -> str:
        """It in words, in shown units."""
        where = {
            "after a turn": "first rows after a turn of the motion",
            "before a turn": "last rows before a turn of the motion",
            "first of a sweep": "first rows of a sweep",
            "last of a sweep": "last rows of a sweep",
            "in a row": "neighbouring rows",
            "sweep": f"rows of sweep {self.value + 1.0:.0f}",
            "level": f"rows at {range_text(self.variable, self.value, self.value)}" if self.variable else "",
        }[self.kind]
        return f"{self.named} of the {self.rows} {where}"


@dataclass(frozen=True)
class Outlying:
    """Rows that do not fit.

    Attributes:
        rows: their indices, in the order in which they were set aside.
        gain: log evidence gained by setting them aside.
        steps: log evidence gained by each further candidate, in the order of `candidates`; less than that for
            those that are far from being set aside.
        candidates: indices of all rows that were tried, of the order that was taken.
        surface: whether the other rows show a surface on the residual.
        place: what all of them have in common; None where that is chance, or of a single row.
    """

    rows: tuple[int, ...]
    gain: float
    steps: tuple[float, ...]
    candidates: tuple[int, ...]
    surface: bool
    place: Place | None = None


#: No row of these data.
NOTHING_OUTLYING = Outlying((), 0.0, (), (), surface=False)


def outlying_of(fitted: Fitted, predictor: Predictor) -> Outlying:
    """Rows of a fitted model that do not fit, of the channel that gains most by setting them aside.

    Args:
        fitted: the model.
        predictor: the data.
    """
    best = NOTHING_OUTLYING
    for channel in predictor.channels:
        rows = values_of(fitted, channel)
        if fitted.lost or len(rows) < ROWS.fewest:
            continue
        variables, time = surface_variables(fitted, predictor, rows)
        if time is None:
            blocks = still_blocks(variables, pair=_PAIR)
        else:
            blocks = moving_blocks(variables, time, predictor.records[rows], late=False)
        readings = (predictor.measured / predictor.scale)[rows]
        span = float(np.ptp(readings))
        residual = fitted.residual[rows]
        table = _Table(fitted.jacobian[rows], residual, blocks, span, None)
        noise = table.growing_noise(readings - residual)
        if noise is not None:
            table = _Table(fitted.jacobian[rows], residual, blocks, span, noise)
        found = table.outlying()
        if not found.rows and best is not NOTHING_OUTLYING:
            continue
        place = np.full(len(predictor.measured), -1)
        place[rows] = np.arange(len(rows))
        sweeps = [own[own >= 0] for own in (place[np.asarray(sweep)] for sweep in predictor.sweeps)]
        direction = predictor.inputs.get("direction")
        way = None if direction is None else direction[rows]
        told = Outlying(
            tuple(int(rows[row]) for row in found.rows),
            found.gain,
            found.steps,
            tuple(int(rows[row]) for row in found.candidates),
            surface=found.surface,
            place=common_place(
                found.rows,
                dict(zip(channels_of(tuple(variables)), variables.values(), strict=True)),
                sweeps,
                way,
            ),
        )
        if best is NOTHING_OUTLYING or told.gain > best.gain:
            best = told
    return best


def growing_noise(
    jacobian: np.ndarray,
    residual: np.ndarray,
    blocks: Sequence[Block],
    predicted: np.ndarray,
    *,
    span: float,
) -> np.ndarray | None:
    """Noise of each row over its geometric mean, where it grows with the prediction; None where it does not.

    Args:
        jacobian, residual, blocks, span: as of `outlying_rows`.
        predicted: prediction of each row, shape (rows,).
    """
    return _Table(jacobian, residual, blocks, span, None).growing_noise(predicted)


def outlying_rows(
    jacobian: np.ndarray,
    residual: np.ndarray,
    blocks: Sequence[Block],
    *,
    span: float,
    noise: np.ndarray | None = None,
) -> Outlying:
    """Rows that do not fit, of one channel.

    Args:
        jacobian: derivatives of the prediction by the constants, shape (rows, constants).
        residual: of the fitted model, shape (rows,).
        blocks: of the free surface; none for the model alone.
        span: range of the readings, in the unit of the residual.
        noise: of each row over its geometric mean, shape (rows,); None where it is the same.
    """
    return _Table(jacobian, residual, blocks, span, noise).outlying()


@dataclass(frozen=True, eq=False)
class _Evidence:
    """Log evidence with rows set aside: with and without a surface."""

    beside: float
    without: float
    likeliest: Likeliest | None

    @property
    def best(self) -> float:
        return max(self.beside, self.without)

    @property
    def pays(self) -> bool:
        return self.beside > self.without + ROWS.surface_pays


@dataclass(frozen=True, eq=False)
class _Path:
    """Candidates of one order: how many are set aside, what that gains, evidence after each."""

    order: list[int]
    evidences: list[float]
    count: int
    gain: float
    pays: bool


class _Table:
    """Residual and columns with the constants projected out, and the same with a few rows less.

    With an orthonormal basis U of the constants, the products of the other rows are those of all rows less
    those of the rows set aside; :math:`M = I - U_M^TU_M` is what is left of the basis.
    """

    def __init__(
        self,
        jacobian: np.ndarray,
        residual: np.ndarray,
        blocks: Sequence[Block],
        span: float,
        noise: np.ndarray | None,
    ) -> None:
        self.given = residual
        noise = np.ones(len(residual)) if noise is None else noise
        self.log_noise = np.log(noise)
        jacobian, residual = jacobian / noise[:, None], residual / noise
        scale = np.linalg.norm(jacobian, axis=0)
        used = jacobian[:, scale > 0.0] / scale[scale > 0.0]
        if used.shape[1]:
            basis, sizes, _ = np.linalg.svd(used, full_matrices=False)
            used = basis[:, sizes > _ALIKE * sizes[0]]
        self.basis, self.blocks, self.span = used, blocks, max(span, 1e-300)
        self.residual = residual - used @ (used.T @ residual)
        self.rows, self.constants = used.shape
        self.leverage = np.sum(used**2, axis=1)
        if blocks:
            self.columns = np.hstack([block.at_rows() for block in blocks]) / noise[:, None]
            self.gram, self.moment = self.columns.T @ self.columns, self.columns.T @ self.residual
            self.shared = used.T @ self.columns
        self.square = float(self.residual @ self.residual)

    @property
    def most_candidates(self) -> int:
        """At most a quarter of the rows, and as many as leave two degrees of freedom."""
        most = _MOST if self.rows < _MANY else _MOST_OF_MANY
        if self.rows < ROWS.fewest:
            return 0
        return max(min(most, self.rows // _PART, self.rows - self.constants - 2), 0)

    @cached_property
    def first(self) -> _Evidence:
        """The evidence of all rows."""
        return self.evidence((), None)

    def outlying(self) -> Outlying:
        """The rows that do not fit."""
        most = self.most_candidates
        if most < 1 or not np.any(self.given):
            return NOTHING_OUTLYING
        orders = [self.order(most, None)]
        if self.blocks and self.first.pays:
            orders.append(self.order(most, self.first.likeliest))
        paths = [self.path(order) for order in orders if order]
        if not paths:
            return Outlying((), 0.0, (), (), surface=self.first.pays)
        best = max(paths, key=lambda path: path.gain)
        count = best.count
        return Outlying(
            tuple(best.order[:count]),
            best.gain,
            tuple(float(step) for step in np.diff(best.evidences)),
            tuple(best.order),
            surface=best.pays,
        )

    def growing_noise(self, predicted: np.ndarray) -> np.ndarray | None:
        """Noise of each row over its geometric mean, where it grows with the prediction; else None."""
        rest = self.rest()
        size = np.abs(predicted)
        size = np.log(np.maximum(size, _LEAST_SIZE * float(np.max(size, initial=0.0))) + 1e-300)
        size = size - np.mean(size)
        spread = float(np.sqrt(np.sum(size**2)))
        rest = np.log(np.maximum(np.abs(rest), _ROUNDING * self.span) + 1e-300)
        if not spread > 0.0 or self.rows < ROWS.fewest:
            return None
        slope = float(size @ (rest - np.mean(rest))) / spread**2
        scatter = max(_LOG_SCATTER, float(np.std(rest - slope * size)))
        if slope * spread < ROWS.grows * scatter:
            return None
        return np.exp(min(slope, ROWS.steepest) * size)

    def rest(self) -> np.ndarray:
        """Residual over its deviation by constants and surface that are fitted to it, shape (rows,)."""
        found = self.first
        columns, penalty = self.basis, np.zeros(self.constants)
        if found.pays and found.likeliest is not None:
            columns = np.hstack([self.basis, self.columns * found.likeliest.roots])
            penalty = np.append(penalty, np.full(columns.shape[1] - self.constants, found.likeliest.noise))
        inverse = np.linalg.pinv(columns.T @ columns + np.diag(penalty), hermitian=True)
        leverage = np.minimum(np.sum((columns @ inverse) * columns, axis=1), _LEVERAGE)
        rest = self.residual - columns @ (inverse @ (columns.T @ self.residual))
        return rest / np.sqrt(1.0 - leverage)

    def order(self, most: int, surface: Likeliest | None) -> list[int]:
        """Rows in the order of their deleted studentised residuals, each without those before it."""
        columns = self.basis
        penalty = np.zeros(self.constants)
        if surface is not None:
            columns = np.hstack([self.basis, self.columns * surface.roots])
            penalty = np.append(penalty, np.full(columns.shape[1] - self.constants, surface.noise))
        inverse = np.linalg.pinv(columns.T @ columns + np.diag(penalty), hermitian=True)
        leverage = np.sum((columns @ inverse) * columns, axis=1)
        rest = self.residual - columns @ (inverse @ (columns.T @ self.residual))
        left, chosen = np.ones(self.rows, bool), []
        for _ in range(most):
            free = left & (leverage < _LEVERAGE)
            if not np.any(free):
                break
            size = np.abs(rest) / np.sqrt(np.maximum(1.0 - leverage, 1e-9))
            row = int(np.argmax(np.where(free, size, -1.0)))
            chosen.append(row)
            left[row] = False
            # Without the row (Sherman & Morrison, Ann. Math. Statist. 21 (1950) 124).
            moved = inverse @ columns[row]
            beside = columns @ moved
            share = 1.0 / (1.0 - leverage[row])
            inverse = inverse + share * np.outer(moved, moved)
            rest, leverage = rest + share * rest[row] * beside, leverage + share * beside**2
        return chosen

    def evidence(self, aside: Sequence[int], before: _Evidence | None, wanted: float = -np.inf) -> _Evidence:
        """Log evidence with some rows set aside.

        Args:
            aside: the rows.
            before: evidence of a like problem, where the search of the surface begins.
            wanted: evidence below which it need not be exact: there it is that of the surface of the like
                problem, at its best size.
        """
        out = np.asarray(aside, dtype=int)
        gone, basis = self.residual[out], self.basis[out]
        count = self.rows - len(out) - self.constants
        kept = np.eye(self.constants) - basis.T @ basis
        inverse = np.linalg.inv(kept) if self.constants else kept
        moved = -basis.T @ gone
        square = self.square - float(gone @ gone) - float(moved @ inverse @ moved)
        square = max(square, count * (_ROUNDING * self.span) ** 2)
        odds = len(out) * np.log(ROWS.share / (2.0 * self.span)) + (self.rows - len(out)) * np.log1p(
            -ROWS.share
        )
        odds += float(np.sum(self.log_noise[out]))
        fixed = odds - 0.5 * float(np.linalg.slogdet(kept)[1])
        without = fixed - 0.5 * count * (np.log(2.0 * np.pi * square / count) + 1.0)
        if not self.blocks:
            return _Evidence(-np.inf, float(without), None)
        columns = self.columns[out]
        shared = self.shared - basis.T @ columns
        gram = self.gram - columns.T @ columns - shared.T @ inverse @ shared
        moment = self.moment - columns.T @ gone - shared.T @ inverse @ moved
        given = self.blocks, gram, moment, square, count
        logs = None if before is None or before.likeliest is None else before.likeliest.logs
        if logs is not None:
            beside = fixed + likely_at_least(*given, logs=logs)
            if max(beside, without) < wanted:
                return _Evidence(float(beside), float(without), before.likeliest if before else None)
        found = most_likely(*given, before=logs)
        return _Evidence(fixed + found.log_evidence, float(without), found)

    def path(self, order: list[int]) -> _Path:
        """The evidence along an order, and how many rows of it are worth setting aside."""
        found = [self.first]
        best = 0
        for count in range(1, len(order) + 1):
            enough = found[best].best + ROWS.per_row * (count - best)
            further = _FURTHER + _FURTHER_PER_ROW * (count - best)
            found.append(self.evidence(order[:count], found[-1], enough - further))
            if found[count].best > enough:
                best = count
        gain = found[best].best - self.first.best
        return _Path(order, [each.best for each in found], best, float(gain), found[best].pays)


def common_place(
    named: Sequence[int],
    variables: Mapping[str, np.ndarray],
    sweeps: Sequence[np.ndarray],
    direction: np.ndarray | None = None,
) -> Place | None:
    """What all named rows have in common, if two rows or more anywhere would hardly have it.

    Args:
        named: rows that do not fit.
        variables: name -> shape (rows,); those with levels that rows share have places.
        sweeps: indices of the rows of each sweep, in order.
        direction: sign of motion of each row; None where it is not known.
    """
    if len(named) < 2:
        return None
    rows, wanted = sum(len(sweep) for sweep in sweeps), set(named)
    places: list[tuple[Kind, str, float, set[int], int]] = []
    long = [sweep for sweep in sweeps if len(sweep) > 2]
    if direction is not None:
        turns = [
            (int(before), int(after))
            for sweep in long
            for before, after in pairwise(sweep)
            if direction[before] * direction[after] < 0.0
        ]
        places.append(("after a turn", "", np.nan, {after for _, after in turns}, 1))
        places.append(("before a turn", "", np.nan, {before for before, _ in turns}, 1))
    if len(long) > 1:
        places.append(("first of a sweep", "", np.nan, {int(sweep[0]) for sweep in long}, 1))
        places.append(("last of a sweep", "", np.nan, {int(sweep[-1]) for sweep in long}, 1))
        for number, sweep in enumerate(sweeps):
            places.append(("sweep", "", float(number), set(sweep.tolist()), len(sweeps)))
    beside = _neighbours(wanted, long)
    if wanted <= beside:
        places.append(("in a row", "", np.nan, beside, 1))
    for name, values in variables.items():
        count = levels_of(values)
        if name == "direction" or not 1 < count <= ROWS.many_levels * len(values):
            continue
        near = np.abs(values - values[named[0]]) <= 1e-3 * float(np.ptp(values))
        places.append(("level", name, float(values[named[0]]), set(np.flatnonzero(near).tolist()), count))
    kinds = len({(kind, name) for kind, name, *_ in places})
    found = []
    for kind, name, value, inside, ways in places:
        if wanted <= inside:
            odds = _odds(len(wanted), len(inside), rows)
            if kind == "in a row":
                odds = _odds_of_neighbours(len(wanted), rows)
            found.append(
                Place(kind, name, value, len(wanted), len(inside), float(min(kinds * ways * odds, 1.0)))
            )
    found = [place for place in found if place.chance < ROWS.chance]
    # Rows in a row are one event each time, wherever it is.
    return min(found, key=lambda place: (place.kind != "in a row", place.chance), default=None)


def _neighbours(named: set[int], sweeps: Sequence[np.ndarray]) -> set[int]:
    """The named rows that have another one beside them, and the rows between."""
    found = set()
    for sweep in sweeps:
        inside = np.flatnonzero(np.isin(sweep, list(named)))
        for before, after in pairwise(inside):
            if after - before <= ROWS.beside:
                found.update(sweep[before : after + 1].tolist())
    return found


def _odds_of_neighbours(named: int, rows: int) -> float:
    """Bound of the probability that each of some rows anywhere has another one beside it."""
    return float((2 * ROWS.beside * named / rows) ** -(-named // 2))


def _odds(named: int, inside: int, rows: int) -> float:
    """Probability that so many rows of all lie among those inside."""
    taken = np.arange(named)
    return float(np.prod((inside - taken) / (rows - taken)))
