"""What a new effect would explain, by the change of the prediction that a small size of it makes."""

from __future__ import annotations

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.physics.effect import Effect

_USUAL = 0.01  # share of the range: size of a parameter that is off by default


def between(effect: Effect, off: dict[str, float]) -> dict[str, float]:
    """A third of the way from off to the default; to 1 % of the range where the default is off."""
    distances = {}
    for name, value in off.items():
        p = effect.parameter(name)
        distances[name] = p.default - value if p.default != value else _USUAL * (p.upper - value)
    return {name: value + distances[name] / 3.0 for name, value in off.items()}


def gain(columns: np.ndarray, basis: np.ndarray, unexplained: np.ndarray) -> float:
    """First-order reduction of the sum of squares by columns beside an orthonormal basis."""
    rest = columns - basis @ (basis.T @ columns)
    size, whole = np.linalg.norm(rest, axis=0), np.linalg.norm(columns, axis=0)
    distinct = size > 1e-3 * whole
    if not np.any(distinct):
        return 0.0
    directions = rest[:, distinct] / size[distinct]
    solution = np.linalg.lstsq(directions, unexplained, rcond=1e-6)[0]
    return float(np.sum((directions @ solution) ** 2))


def unexplained_by(fitted_model: FittedModel) -> tuple[np.ndarray, np.ndarray]:
    """Orthonormal basis of what the free parameters change, and the residual outside of it."""
    inner = fitted_model.jacobian[:, fitted_model.inner]
    basis = np.linalg.qr(inner)[0] if inner.shape[1] else np.empty((len(fitted_model.residual), 0))
    return basis, fitted_model.residual - basis @ (basis.T @ fitted_model.residual)
