"""Structure that no catalogued effect explains: its size, its variables, and a term that describes it.

The share comes from a regression without any physics, cross-validated over blocks of rows. The term is found
by orthogonal matching pursuit over physically plausible products: powers of pressure, contraction, direction
and velocity, and sines and Gaussians of contraction, pressure and time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

_MOST_ROWS = 2000  # for the regression; more are thinned
_BLOCK = 12  # rows that are left out together
_FOLDS = 5
_TREES = 60
_TERMS = 3  # most terms of a proposal
_WORTH = 0.08  # least share of the remaining mean square that a proposed term explains
_PER_WAVE = 4.0  # fewest distinct values of a variable per period of a sine
_FINEST = 100  # resolution of a variable, steps over its range
_SEED = 0
#: Name in a term -> variable.
SYMBOLS = {"P": "pressure", "kappa": "contraction", "v": "velocity", "s": "direction", "t": "time"}


@dataclass(frozen=True)
class ResidualStructure:
    """The part of a residual that a regression without physics predicts.

    Attributes:
        share: of the mean square, cross-validated.
        variables: the important ones, the most important first, each with the share that is lost when the
            variable is shuffled.
    """

    share: float
    variables: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Term:
    """A proposed term of the tension [N].

    Attributes:
        formula: in the syntax of the ``custom`` effect.
        coefficients: name -> value, SI.
        share: of the residual's mean square that it explains.
        values: of the term at each row, shape (rows,).
    """

    formula: str
    coefficients: dict[str, float]
    share: float
    values: np.ndarray


def structure(residual: np.ndarray, variables: Mapping[str, np.ndarray]) -> ResidualStructure:
    """The part of a residual that a regression without physics predicts, and from which variables."""
    from sklearn.ensemble import ExtraTreesRegressor  # 1 s import, not paid at start

    names = [name for name in variables if name != "group"]
    if not names or len(residual) < 40 or not np.any(residual):
        return ResidualStructure(0.0, ())
    rows = np.arange(len(residual))
    if len(rows) > _MOST_ROWS:
        rows = np.unique(np.linspace(0, len(rows) - 1, _MOST_ROWS).astype(int))
    table = np.column_stack([variables[name][rows] for name in names])
    target = residual[rows]
    random = np.random.default_rng(_SEED)
    blocks = np.arange(len(rows)) // min(_BLOCK, max(2, len(rows) // (4 * _FOLDS)))
    fold = random.integers(0, _FOLDS, blocks[-1] + 1)[blocks]
    left, shuffled = np.zeros(len(rows)), np.zeros((len(names), len(rows)))
    for label in range(_FOLDS):
        out = fold == label
        if not np.any(out) or np.all(out):
            continue
        model = ExtraTreesRegressor(_TREES, min_samples_leaf=4, max_features=1.0, random_state=_SEED)
        model.fit(table[~out], target[~out])
        inputs = np.tile(
            table[out], (len(names) + 1, 1, 1)
        )  # copy i has variable i shuffled, the last copy none
        for column in range(len(names)):
            inputs[column, :, column] = random.permutation(inputs[column, :, column])
        predicted = model.predict(inputs.reshape(-1, len(names))).reshape(len(names) + 1, -1)
        shuffled[:, out], left[out] = target[out] - predicted[:-1], target[out] - predicted[-1]
    whole = float(np.mean(target**2))
    share = max(0.0, 1.0 - float(np.mean(left**2)) / whole)
    lost = (np.mean(shuffled**2, axis=1) - np.mean(left**2)) / whole
    order = np.argsort(lost)[::-1]
    return ResidualStructure(share, tuple((names[i], float(lost[i])) for i in order if lost[i] > 0.02))


def proposed_term(
    residual: np.ndarray, variables: Mapping[str, np.ndarray], basis: np.ndarray | None = None
) -> Term | None:
    """The product terms that explain most of a force residual, at most three; None without a relevant one.

    Args:
        residual: measured minus predicted force [N].
        variables: pressure [Pa], contraction, velocity [m/s], direction, time [s]; some may be missing.
        basis: derivatives of the model by its free parameters; what these can fit is not proposed.
    """
    symbols = {symbol: variables[name] for symbol, name in SYMBOLS.items() if name in variables}
    library = list(_library(symbols))
    if not library:
        return None
    columns = np.column_stack([column for _, group in library for column in group])
    sizes = [len(group) for _, group in library]
    starts = np.concatenate([[0], np.cumsum(sizes)])
    basis = np.empty((len(residual), 0)) if basis is None else basis[:, np.any(basis, axis=0)]
    explained = np.linalg.qr(basis)[0]
    left = residual - explained @ (explained.T @ residual)
    whole = float(left @ left)
    chosen: list[int] = []
    for _ in range(_TERMS):
        gains = []
        projected = columns - explained @ (explained.T @ columns)
        for number, start in enumerate(starts[:-1]):
            group = projected[:, start : starts[number + 1]]
            norm = np.linalg.norm(group, axis=0)
            if np.any(norm <= 1e-6 * np.linalg.norm(columns[:, start : starts[number + 1]], axis=0)):
                gains.append(0.0)
                continue
            solution = np.linalg.lstsq(group / norm, left, rcond=1e-8)[0]
            gains.append(float(np.sum((group / norm @ solution) ** 2)))
        best = int(np.argmax(gains))
        if gains[best] < _WORTH * float(left @ left):
            break
        chosen.append(best)
        group = columns[:, starts[best] : starts[best + 1]]
        explained = np.linalg.qr(np.column_stack([explained, group]))[0]
        left = residual - explained @ (explained.T @ residual)
    if not chosen:
        return None
    design = np.column_stack([columns[:, starts[n] : starts[n + 1]] for n in chosen])
    whole_design = np.column_stack([design, basis])
    weights = np.linalg.lstsq(whole_design / np.linalg.norm(whole_design, axis=0), residual, rcond=1e-10)[0]
    weights = (weights / np.linalg.norm(whole_design, axis=0))[: design.shape[1]]
    texts = [text for n in chosen for text in library[n][0]]
    names = [f"c{number}" for number in range(1, len(texts) + 1)]
    formula = " + ".join(f"{name}*{text}" for name, text in zip(names, texts, strict=True))
    share = 1.0 - float(left @ left) / whole
    return Term(formula, {n: float(w) for n, w in zip(names, weights, strict=True)}, share, design @ weights)


def _steps(values: np.ndarray) -> float:
    """Number of distinct values of a variable at 1 % resolution: few for set levels, many for a sweep."""
    low, span = float(np.min(values)), float(np.ptp(values))
    return float(len(np.unique(np.rint(_FINEST * (values - low) / span))))


def _library(symbols: Mapping[str, np.ndarray]) -> Iterator[tuple[Sequence[str], list[np.ndarray]]]:
    """Products as (texts, columns); a sine has two columns, so that its phase is free."""
    if not symbols:
        return
    shapes: list[tuple[list[str], list[np.ndarray]]] = [(["1"], [np.ones(len(next(iter(symbols.values()))))])]
    for symbol in ("kappa", "P", "t", "v"):
        if symbol not in symbols:
            continue
        x = symbols[symbol]
        powers: tuple[tuple[str, Callable[[np.ndarray], np.ndarray]], ...] = (
            (symbol, lambda x: x),
            (f"{symbol}**2", lambda x: x**2),
            (f"{symbol}**3", lambda x: x**3),
        )
        shapes += [([text], [make(x)]) for text, make in powers]
        low, span = float(np.min(x)), float(np.ptp(x))
        if symbol == "v" or not span > 0.0:
            shapes += [(["abs(v)"], [np.abs(x)]), (["v*abs(v)"], [x * np.abs(x)])]
            continue
        # Features narrower than the spacing of the data are not determined.
        steps = _steps(x)
        for periods in (*np.arange(1.0, 8.1, 0.5), *np.arange(9.0, 20.1, 1.0)):
            if periods > steps / _PER_WAVE:
                break
            rate = float(f"{2.0 * np.pi * periods / span:.5g}")
            shapes.append(
                ([f"sin({rate:g}*{symbol})", f"cos({rate:g}*{symbol})"], [np.sin(rate * x), np.cos(rate * x)])
            )
        for place in np.linspace(0.05, 0.95, 13):
            for width in (0.03, 0.06, 0.12, 0.25):
                if width < 2.0 / steps:
                    continue
                middle, scale = float(f"{low + place * span:.5g}"), float(f"{width * span:.4g}")
                text = f"exp(-(({symbol} - {middle:g})/{scale:g})**2)"
                shapes.append(([text], [np.exp(-(((x - middle) / scale) ** 2))]))
    factors: list[tuple[str, np.ndarray | float]] = [("", 1.0)]
    if "P" in symbols:
        factors.append(("P", symbols["P"]))
    if "s" in symbols:
        factors.append(("sign(v)", symbols["s"]))
        if "P" in symbols:
            factors.append(("sign(v)*P", symbols["s"] * symbols["P"]))
    if "v" in symbols:
        factors.append(("v", symbols["v"]))
    for texts, columns in shapes:
        for text, factor in factors:
            if text and text == texts[0]:
                continue
            products = [column * factor for column in columns]
            if all(np.ptp(column) > 0.0 or texts == ["1"] for column in products) and any(
                np.any(c) for c in products
            ):
                yield [f"{t}*{text}" if text and t != "1" else text or t for t in texts], products
