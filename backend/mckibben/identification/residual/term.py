r"""A formula for a force residual that no catalogued effect explains: a short one, or a smooth description.

It is a sum of products

.. math:: c\,\kappa^a P^b\,g\,h,\qquad a \le 3,\; b \le 2,\; a + b \le 3

with g one of 1, sign(v), abs(v), v and h one of 1 and :math:`1 - e^{-t/\tau}`. They are finite at rest and
without pressure and bounded in time. A short one has at most three, and halves the error on the folds left
out. Where none does, a sum of bells over contraction and pressure,

.. math:: c\,e^{-((\kappa-\kappa_i)/w)^2}\,g,\qquad g \in \{1, P, \mathrm{sign}\,v\},

describes a part of the rest without a claim to explain it; outside the measured range they vanish.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.identification.thresholds import TERM

_CONTRACTION, _PRESSURE, _ORDER = 3, 2, 3  # highest powers, and their highest sum
_BELLS, _WIDTH = 9, 1.2  # most bells over a variable, and their half width over the distance of two
_FEWEST_LEVELS = 4  # of a variable with bells
_SETTLING = (0.1, 0.3, 1.0)  # time constants, shares of the duration
_CUTOFF = 1e-11  # share of the largest eigenvalue below which a direction is not determined
_SAME = 1e-5  # share of a column that is not a combination of others, below which it is one
#: Name in a term -> variable.
SYMBOLS = {"P": "pressure", "kappa": "contraction", "v": "velocity", "s": "direction", "t": "time"}


@dataclass(frozen=True)
class Term:
    """A proposed term of the tension [N].

    Attributes:
        formula: in the syntax of the ``custom`` effect.
        coefficients: name -> value, SI.
        share: of the residual's mean square that it explains.
        values: of the term at each row, shape (rows,).
        left_out: error with the term over the error without it, on the folds left out; of the way of folding
            with the largest.
        band: error with it on these folds [N], the standard deviation of what it predicts elsewhere.
        smooth: whether it only describes.
    """

    formula: str
    coefficients: dict[str, float]
    share: float
    values: np.ndarray
    left_out: float
    band: float = 0.0
    smooth: bool = False


@dataclass(frozen=True)
class _Form:
    """A product of the library: its text, its order and its value at each row."""

    text: str
    order: int
    column: np.ndarray


def proposed_term(
    residual: np.ndarray,
    variables: Mapping[str, np.ndarray],
    *,
    folds: Sequence[np.ndarray],
    basis: np.ndarray | None = None,
    weigh: Callable[[np.ndarray], np.ndarray] = lambda columns: columns,
    smooth: bool = False,
) -> Term | None:
    """The shortest sum of products that halves the error of the folds left out; None without one.

    Each fold is predicted by the term and the model's own parameters, fitted to the other folds.

    Args:
        residual: measured minus predicted force [N], shape (rows,).
        variables: pressure [Pa], contraction, velocity [m/s], direction, time since the record began [s];
            some may be missing.
        folds: ways of folding, each a label per row; the error has to be halved for each way.
        basis: derivatives of the model by its free parameters; what these can fit is not proposed.
        weigh: weights of the residual, applied to the columns of the term.
        smooth: a description of more products instead, which takes a part of the error.
    """
    symbols = {symbol: variables[name] for symbol, name in SYMBOLS.items() if name in variables}
    forms = _bells(symbols) if smooth else _library(symbols)
    ways = [labels for labels in folds if np.ptp(labels) > 0]
    if not forms or not ways or not np.any(residual):
        return None
    own = _independent(np.empty((len(residual), 0)) if basis is None else basis)
    columns = weigh(np.column_stack([form.column for form in forms]))
    norms = np.linalg.norm(columns, axis=0)
    outside = columns - own @ (own.T @ columns)
    seen = np.flatnonzero(np.linalg.norm(outside, axis=0) > _SAME * norms)
    if not len(seen):
        return None
    forms, columns = [forms[n] for n in seen], columns[:, seen] / norms[seen]
    sums = _LeftOut(np.column_stack([own, columns]), residual, ways)
    first = own.shape[1]
    chosen: list[int] = list(range(first))
    without = here = sums.squares(np.array([chosen], dtype=int))[0]
    for _ in range(TERM.smooth_terms if smooth else TERM.terms):
        others = np.setdiff1d(np.arange(first, first + len(forms)), chosen)
        if not len(others):
            break
        squares = sums.squares(np.array([[*chosen, other] for other in others], dtype=int))
        # The mean over the ways of folding, each relative to its error without a term.
        size = np.mean(squares / without, axis=1)
        order = np.array([forms[n - first].order for n in others])
        near = np.flatnonzero(size <= (1.0 + TERM.simpler) * np.min(size))
        best = near[np.lexsort((size[near], order[near]))[0]]
        if size[best] > (1.0 - TERM.worth) * np.mean(here / without):
            break
        chosen.append(int(others[best]))
        here = squares[best]
    left_out = float(np.sqrt(np.max(here / without)))
    if len(chosen) == first or left_out > (TERM.smooth if smooth else TERM.halved):
        return None
    picked = [n - first for n in chosen[first:]]
    design = np.column_stack([columns[:, picked], own])
    solution = np.linalg.lstsq(design, residual, rcond=None)[0]
    left = residual - design @ solution
    before = residual - own @ (own.T @ residual)
    weights = solution[: len(picked)] / norms[seen][picked]
    names = [f"c{number}" for number in range(1, len(picked) + 1)]
    return Term(
        formula=" + ".join(
            name if forms[n].text == "1" else f"{name}*{forms[n].text}"
            for name, n in zip(names, picked, strict=True)
        ),
        coefficients={name: float(weight) for name, weight in zip(names, weights, strict=True)},
        share=1.0 - float(left @ left) / float(before @ before),
        values=np.column_stack([forms[n].column for n in picked]) @ weights,
        left_out=left_out,
        band=float(np.sqrt(np.max(here))),
        smooth=smooth,
    )


class _LeftOut:
    """Mean squares of folds that are predicted by columns fitted to the other folds.

    Args:
        columns: shape (rows, columns), each of norm near 1.
        target: what is fitted, shape (rows,).
        ways: ways of folding.
    """

    def __init__(self, columns: np.ndarray, target: np.ndarray, ways: Sequence[np.ndarray]) -> None:
        self._ways = [
            [
                (columns[out].T @ columns[out], columns[out].T @ target[out], target[out] @ target[out])
                for out in (labels == label for label in np.unique(labels))
            ]
            for labels in ways
        ]
        self._rows = len(target)

    def squares(self, chosen: np.ndarray) -> np.ndarray:
        """Mean square over all folds left out, shape (models, ways).

        Args:
            chosen: the columns of each model, shape (models, columns).
        """
        pick = chosen[:, :, None], chosen[:, None, :]
        result = np.zeros((len(chosen), len(self._ways)))
        for way, parts in enumerate(self._ways):
            normal = np.sum([part[0] for part in parts], axis=0)
            right = np.sum([part[1] for part in parts], axis=0)
            for own_normal, own_right, square in parts:
                if not chosen.shape[1]:
                    result[:, way] += square
                    continue
                inverse = np.linalg.pinv((normal - own_normal)[pick], rcond=_CUTOFF, hermitian=True)
                weights = (inverse @ (right - own_right)[chosen][:, :, None])[:, :, 0]
                result[:, way] += (
                    square
                    - 2.0 * np.sum(weights * own_right[chosen], axis=1)
                    + np.einsum("mi,mij,mj->m", weights, own_normal[pick], weights)
                )
        return np.maximum(result, 0.0) / self._rows


def _independent(basis: np.ndarray) -> np.ndarray:
    """Orthonormal columns that span those of a matrix."""
    basis = basis[:, np.any(basis, axis=0)]
    if not basis.shape[1]:
        return basis
    left, sizes, _ = np.linalg.svd(basis / np.linalg.norm(basis, axis=0), full_matrices=False)
    return left[:, sizes > _SAME * sizes[0]]


def _library(symbols: Mapping[str, np.ndarray]) -> list[_Form]:
    """The products that change over the rows, and a constant; those of the lowest order first."""
    if not symbols:
        return []
    ones = np.ones(len(next(iter(symbols.values()))))
    powers = [
        _power("kappa", a, symbols, ones, _power("P", b, symbols, ones, _Form("", 0, ones)))
        for a in range(_CONTRACTION + 1 if "kappa" in symbols else 1)
        for b in range(_PRESSURE + 1 if "P" in symbols else 1)
        if a + b <= _ORDER
    ]
    forms = [
        _Form(
            "*".join(part.text for part in (power, motion, history) if part.text) or "1",
            power.order + motion.order + history.order,
            power.column * motion.column * history.column,
        )
        for power in powers
        for motion in _motions(symbols, ones)
        for history in _histories(symbols, ones)
    ]
    kept = [form for form in forms if form.text == "1" or np.ptp(form.column) > 0.0]
    return sorted(kept, key=lambda form: form.order)


def _bells(symbols: Mapping[str, np.ndarray]) -> list[_Form]:
    """Bells over contraction and pressure, alone, in proportion to the pressure and with the motion."""
    forms: list[_Form] = []
    for symbol in ("kappa", "P"):
        values = symbols.get(symbol)
        if values is None or len(np.unique(values)) < _FEWEST_LEVELS:
            continue
        levels = min(_BELLS, len(np.unique(values)))
        centres = np.linspace(np.min(values), np.max(values), levels)
        width = float(f"{_WIDTH * (centres[1] - centres[0]):.2g}")
        for centre in centres.tolist():
            place = float(f"{centre:.3g}")
            bell = f"exp(-(({symbol} - {place:g})/{width:g})**2)"
            column = np.exp(-(((values - place) / width) ** 2))
            forms.append(_Form(bell, 1, column))
            if symbol == "kappa" and "P" in symbols and np.ptp(symbols["P"]) > 0.0:
                forms.append(_Form(f"P*{bell}", 2, symbols["P"] * column))
            if "s" in symbols:
                forms.append(_Form(f"sign(v)*{bell}", 2, symbols["s"] * column))
    return [form for form in forms if np.ptp(form.column) > 0.0]


def _power(
    symbol: str, exponent: int, symbols: Mapping[str, np.ndarray], ones: np.ndarray, other: _Form
) -> _Form:
    """The product of a power of a variable and another form."""
    if not exponent:
        return other
    text = symbol if exponent == 1 else f"{symbol}**{exponent}"
    column = symbols.get(symbol, ones) ** exponent * other.column
    return _Form(f"{text}*{other.text}" if other.text else text, exponent + other.order, column)


def _motions(symbols: Mapping[str, np.ndarray], ones: np.ndarray) -> list[_Form]:
    """Factors of the motion; a tension that has a finite limit at rest."""
    factors = [_Form("", 0, ones)]
    if "s" in symbols:
        factors.append(_Form("sign(v)", 1, symbols["s"]))
    if "v" in symbols:
        factors += [_Form("v", 1, symbols["v"]), _Form("abs(v)", 1, np.abs(symbols["v"]))]
    return factors


def _histories(symbols: Mapping[str, np.ndarray], ones: np.ndarray) -> list[_Form]:
    """Factors that settle in time; a factor in proportion to the time would have no limit."""
    factors = [_Form("", 0, ones)]
    if "t" in symbols:
        time = symbols["t"]
        for share in _SETTLING:
            constant = float(f"{share * np.ptp(time):.2g}")
            if constant > 0.0:
                factors.append(_Form(f"(1 - exp(-t/{constant:g}))", 1, -np.expm1(-time / constant)))
    return factors
