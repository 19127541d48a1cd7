"""Predictions that were simulated, kept for the next time that the same model is asked for.

A search asks for many of them twice: of a fit where it ended, of its derivatives where it goes on.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import Self

import numpy as np

from mckibben.identification.predict.fit_model import FitModel

_NUMBERS = 1_000_000  # kept, 8 MB


class KeptRuns:
    """The predictions of the models that were asked for last."""

    def __init__(self) -> None:
        self._known: dict[Hashable, np.ndarray] = {}

    def __reduce__(self) -> tuple[type[Self], tuple[()]]:
        """Copies in other processes begin empty."""
        return type(self), ()

    def of(
        self, fit_models: Sequence[FitModel], run: Callable[[list[FitModel]], Sequence[np.ndarray]]
    ) -> list[np.ndarray]:
        """The prediction of each model; ``run`` is called once with those that are not known."""
        keys = [_key(fit_model) for fit_model in fit_models]
        missing = {key: model for key, model in zip(keys, fit_models, strict=True) if key not in self._known}
        for key in keys:  # what is asked for again stays longest
            if key not in missing:
                self._known[key] = self._known.pop(key)
        new = dict(zip(missing, run(list(missing.values())), strict=True)) if missing else {}
        found = [new[key] if key in new else self._known[key] for key in keys]
        for key, prediction in new.items():
            self._keep(key, prediction, least=len(new))
        return found

    def __contains__(self, fit_model: FitModel) -> bool:
        return _key(fit_model) in self._known

    def keep(self, fit_model: FitModel, prediction: np.ndarray) -> None:
        """Keep a prediction that was found otherwise."""
        self._keep(_key(fit_model), prediction)

    def _keep(self, key: Hashable, prediction: np.ndarray, *, least: int = 1) -> None:
        self._known[key] = prediction
        while len(self._known) > max(_NUMBERS // max(len(prediction), 1), least):
            del self._known[next(iter(self._known))]


def _key(fit_model: FitModel) -> Hashable:
    """All that a run depends on."""
    values = frozenset((effect, *fit_model.values[effect.id].items()) for effect in fit_model.effects)
    return fit_model.muscle, fit_model.supply_factor, values
