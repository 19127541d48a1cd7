r"""Models without physics beside a fitted one: what an engineer would fit to the same rows.

A *static polynomial* of two variables x and y, usually pressure and contraction,

.. math:: F = \sum_{a\le A,\,b\le B} c_{ab}\,x^a y^b

with all these powers, or those with :math:`a/A + b/B \le 1`; the orders and which of both are those with the
smallest error on left-out groups; and a *Prandtl-Ishlinskii operator* beside
it, for rows in the order of the test that go there and back (Krejci & Kuhnen, IEE Proc. Control Theory Appl.
148 (2001) 185): with plays :math:`p_r` of the variable that moves,

.. math:: F = \sum c_{ab}x^ay^b + \sum_r (w_r + u_r P)\,(p_r(x) - x),\qquad w_r, u_r \ge 0

What they say of a left-out group counts only within the range of the other groups: beyond it a polynomial
says nothing. The error of the physical model that stands beside it is of the same rows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.profiles import variables_of
from mckibben.identification.residual.surface import (
    Fitted,
    Surface,
    foldings_of,
    in_order,
    left_out_residual,
    levels_of,
    play,
    unit_range,
    ways_of,
    within_others,
)
from mckibben.identification.thresholds import SURFACE

_VARIABLES = ("pressure", "contraction", "load")  # of a polynomial, the first two that change
_ORDERS = 3, 5  # highest powers of the first and the second variable
_FEWEST_GROUPS = 3  # with rows within the others, as of a surface
_SIMPLER = 1.02  # error over the smallest one up to which fewer numbers are taken
_RIDGE = 1e-10  # of the mean square of the columns
_PLAYS = (0.02, 0.05, 0.1, 0.2, 0.35, 0.5)  # half widths over the range of what moves


@dataclass(frozen=True)
class Rival:
    """A model without physics.

    Attributes:
        kind: in words.
        numbers: that are fitted.
        left: rms that it leaves, corrected for its numbers, in the units of the scaled residual.
        left_out: rms on left-out groups, over their rows within the range of the others; None where fewer
            than three groups have such rows.
        model_left_out: of the physical model, over the same rows.
    """

    kind: str
    numbers: int
    left: float
    left_out: float | None
    model_left_out: float | None

    @property
    def share(self) -> float | None:
        """Error on left-out groups over that of the physical model; None where it is not told."""
        return self.left_out / self.model_left_out if self.left_out and self.model_left_out else None


def rivals_of(fitted: Fitted, predictor: Predictor, surface: Surface | None) -> list[Rival]:
    """All rivals of a model, the best on left-out groups first; those of which that is not told come last.

    Args:
        fitted: the model.
        predictor: the data.
        surface: on the residual of the model.
    """
    found = plain_rivals(fitted, predictor)
    if surface is not None and surface.sparing:
        left_out = model = None
        if np.isfinite(surface.gain[0]):
            own = left_out_residual(fitted, foldings_of(predictor)[0])[surface.rows_inside[0]]
            left_out, model = surface.left_out[0], float(np.sqrt(np.mean(own**2)))
        found.append(Rival("free surface", surface.numbers, surface.left, left_out, model))
    return sorted(found, key=lambda rival: (rival.share is None, rival.share or rival.left))


def plain_rivals(fitted: Fitted, predictor: Predictor) -> list[Rival]:
    """The polynomial, and for loops the operator with plays; none for runs and for less than twenty rows."""
    counted = np.ones(len(predictor.measured), bool) if predictor.aside is None else ~predictor.aside
    rows = np.flatnonzero(counted)
    if (
        predictor.kind == "transient"
        or len(predictor.channels) > 1
        or len(rows) < SURFACE.fewest
        or fitted.lost
    ):
        return []
    known = variables_of(predictor, fitted.fit_model)
    variables = {name: known[name] for name in _VARIABLES if name in known}
    if not variables or not np.all(np.isfinite(predictor.measured)):
        return []
    plays = _plays(variables, known, predictor)
    for labels in predictor.folds:
        rival = _Plain(fitted, predictor, rows, variables, labels)
        if rival.powers is not None:
            polynomial = rival.made("static polynomial", None)
            return [polynomial] if plays is None else [polynomial, rival.made("polynomial with plays", plays)]
    return []


def _plays(
    variables: Mapping[str, np.ndarray], known: Mapping[str, np.ndarray], predictor: Predictor
) -> np.ndarray | None:
    """Plays of what moves within the sweeps, alone and times the pressure; None without loops."""
    if ways_of(known) is None or not in_order(predictor):
        return None
    moved = {
        name: float(np.mean([np.ptp(values[sweep]) for sweep in predictor.sweeps])) / float(np.ptp(values))
        for name, values in variables.items()
    }
    name = max(moved, key=lambda each: moved[each])
    values = variables[name]
    alone = np.column_stack([
        play(values, share * float(np.ptp(values)), predictor.records) - values for share in _PLAYS
    ])  # fmt: skip
    if name == "pressure" or "pressure" not in variables:
        return alone
    pressure = variables["pressure"]
    return np.hstack([alone, alone * (pressure / float(np.max(np.abs(pressure))))[:, None]])


class _Plain:
    """Polynomials of the rows, with groups left out in one way."""

    def __init__(
        self,
        fitted: Fitted,
        predictor: Predictor,
        rows: np.ndarray,
        variables: Mapping[str, np.ndarray],
        labels: np.ndarray,
    ) -> None:
        self.predictor, self.rows = predictor, rows
        self.places = [unit_range(variables[name][rows]) for name in list(variables)[:2]]
        self.labels, self.groups = labels[rows], np.unique(labels[rows])
        self.model = left_out_residual(fitted, labels)[rows]
        most = [min(order, levels_of(place) - 1) for place, order in zip(self.places, _ORDERS, strict=False)]
        self.most = [max(order, 1) for order in most]
        tables = [
            np.polynomial.legendre.legvander(place, order)
            for place, order in zip(self.places, self.most, strict=True)
        ]
        table = tables[0]
        for other in tables[1:]:
            table = (table[:, :, None] * other[:, None, :]).reshape(len(table), -1)
        self.columns = self._weighed(table)
        self.target = predictor.weighted(predictor.measured)[rows]
        self.number = np.array(list(product(*(range(order + 1) for order in self.most))))
        self.out = {label: self.labels == label for label in self.groups}

    def _weighed(self, table: np.ndarray) -> np.ndarray:
        whole = np.zeros((len(self.predictor.measured), table.shape[1]))
        whole[self.rows] = table
        return self.predictor.weighted(whole)[self.rows]

    def _inside(self, out: np.ndarray, others: np.ndarray) -> np.ndarray:
        """Mask of the rows of a group within the range of others."""
        return out & np.all([within_others(place, others) for place in self.places], axis=0)

    @cached_property
    def inside(self) -> dict[int, np.ndarray]:
        """Of each group its rows within the range of the others, where it has some."""
        found = {label: self._inside(out, ~out) for label, out in self.out.items() if not np.all(out)}
        return {label: mask for label, mask in found.items() if np.any(mask)}

    @cached_property
    def powers(self) -> tuple[int, ...] | None:
        """Columns with the smallest error on left-out groups; None where that cannot be told."""
        return None if len(self.inside) < _FEWEST_GROUPS else self._chosen(None)

    def _chosen(self, gone: int | None) -> tuple[int, ...] | None:
        """The columns that the groups besides one choose; None where these are too few."""
        left = np.ones(len(self.rows), bool) if gone is None else ~self.out[gone]
        parts = []
        for label, out in self.out.items():
            others = left & ~out
            inside = self._inside(out, others) if label != gone and np.any(others) else others & False
            if np.any(inside):
                columns = self.columns[others]
                parts.append((columns.T @ columns, columns.T @ self.target[others], inside, len(columns)))
        if not parts:
            return None
        found = {}
        for powers in self.candidates:
            used = np.array(powers)
            if SURFACE.per_number * len(used) > min(count for *_, count in parts):
                continue
            square = rows = 0.0
            for normal, right, inside, _ in parts:
                numbers = _solved(normal[np.ix_(used, used)], right[used])
                square += float(
                    np.sum((self.target[inside] - self.columns[np.ix_(inside, used)] @ numbers) ** 2)
                )
                rows += float(np.count_nonzero(inside))
            found[powers] = square / rows
        if not found:
            return None
        enough = _SIMPLER**2 * min(found.values())
        return min(
            (each for each in found if found[each] <= enough), key=lambda each: (len(each), found[each])
        )

    @cached_property
    def candidates(self) -> list[tuple[int, ...]]:
        """Columns of each polynomial that is tried."""
        found = {}
        for orders in product(*(range(1, order + 1) for order in self.most)):
            shares = self.number / np.array(orders)
            for kept in (np.max(shares, axis=1), np.sum(shares, axis=1)):
                found[tuple(np.flatnonzero(kept < 1.0 + 1e-9).tolist())] = None
        return list(found)

    @cached_property
    def _of_others(self) -> dict[int, tuple[int, ...] | None]:
        """The columns that the other groups choose, for each group."""
        return {label: self._chosen(label) for label in self.inside}

    def made(self, kind: str, plays: np.ndarray | None) -> Rival:
        """The rival, beside plays or alone."""
        weighed = None if plays is None else self._weighed(plays[self.rows])
        powers = self.powers or self.candidates[0]
        everywhere = np.ones(len(self.rows), bool)
        if weighed is not None:  # a length goes the other way than a force
            signed = [self._fitted(powers, sign * weighed, everywhere) for sign in (1.0, -1.0)]
            squares = [float(np.sum(residual**2)) for residual, _ in signed]
            weighed = weighed if squares[0] <= squares[1] else -weighed
        residual, numbers = self._fitted(powers, weighed, everywhere)
        freedom = max(len(self.rows) - numbers, 1)
        squares, model, count = 0.0, 0.0, 0
        for label, inside in self.inside.items():
            left = self._fitted(self._of_others[label] or powers, weighed, ~self.out[label])[0][inside]
            squares, count = squares + float(np.sum(left**2)), count + len(left)
            model += float(np.sum(self.model[inside] ** 2))
        return Rival(
            kind,
            numbers,
            float(np.sqrt(np.sum(residual**2) / freedom)),
            float(np.sqrt(squares / count)),
            float(np.sqrt(model / count)),
        )

    def _fitted(
        self, powers: Sequence[int], plays: np.ndarray | None, some: np.ndarray
    ) -> tuple[np.ndarray, int]:
        """Residual of all rows of what is fitted to some of them, and how many numbers it has."""
        from scipy.optimize import nnls

        columns, target, moved = self.columns[:, list(powers)], self.target, 0
        if plays is not None:
            basis = np.linalg.qr(columns[some])[0]
            outside = plays[some] - basis @ (basis.T @ plays[some])
            size = np.maximum(np.linalg.norm(outside, axis=0), 1e-300)
            weights = nnls(outside / size, target[some] - basis @ (basis.T @ target[some]))[0] / size
            target, moved = target - plays @ weights, int(np.count_nonzero(weights))
        numbers = np.linalg.lstsq(columns[some], target[some], rcond=None)[0]
        return target - columns @ numbers, columns.shape[1] + moved


def _solved(normal: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Numbers of least squares; what the rows do not determine stays small."""
    return np.linalg.solve(normal + _RIDGE * np.trace(normal) / len(normal) * np.eye(len(normal)), right)
