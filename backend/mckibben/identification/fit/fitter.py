"""Fits models to one set of data and remembers them, for search, alternatives and verdict."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np

from mckibben.identification.fit.effort import SearchEffort
from mckibben.identification.fit.fitted_model import FittedModel, refitted
from mckibben.identification.predict.fit_model import FitModel, Free, fixed_beside, free_numbers
from mckibben.identification.predict.predictor import Predictor
from mckibben.physics.effect import Effect
from mckibben.physics.parameter import Parameter
from mckibben.simulation.outcome import Outcome

_MOVED = 1e-3  # relative change of a parameter below which the fit has not left its start
_STUCK = 0.999  # error over the error before, above which a fit is repeated from another start
# Least first-order gain, share of the mean square, and near the noise: what improves a score has more.
_LEAST_PROMISE, _LEAST_NEAR_FLOOR = 0.01, 0.02
_ROUNDING = 1e-9  # rms change over rms of the measured values, below which nothing has changed
_LEAST_FREED = 0.03  # least first-order gain of freed constants, share of the mean square
_ELSEWHERE = (0.1, 0.4)  # shares of the way to the farther bound at which a hidden constant is tried
_NEAR_FLOOR = 1.2  # error over noise below which only effects with a clear gain of their own are tried

_ByModel = WeakKeyDictionary

_SLOWER = (1.0, 10.0, 100.0)
_PLACES = 12  # places tried of an effect that acts beyond some state only

_USUAL = 0.01  # share of the range: size of a parameter that is off by default


class CancelledError(Exception):
    """The watch ended the diagnosis; ``outcome`` says why."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(outcome.label)
        self.outcome = outcome


@dataclass
class Fitter:
    """Fits models to one set of data and remembers them.

    Attributes:
        predictor: the data.
        geometry: geometry fields that every fit may change.
        candidates: effects that may be added.
        noise: of the scaled residual; None when it cannot be estimated.
        load: bounds of the load when it is unknown and fitted.
        effort: limits of fits and search.
        fixed: names of parameters that no fit changes, because they are known from elsewhere.
        before_fit: called before each fit; may raise `CancelledError`.
        estimate: estimates the noise from a model's residual. Missing effects may look like noise, so the
            search repeats the estimate with better models.
        known: the models fitted so far.
        off_values: effect id -> result of `acting`.
        refitted_keys: keys of the models that were fitted from a second start.
        known_gains, known_places: results of `gains` and `_placed`.
        known_columns: changes of the prediction that have been computed.
    """

    predictor: Predictor
    geometry: tuple[Free, ...]
    candidates: tuple[Effect, ...]
    noise: float | None
    load: Free | None
    effort: SearchEffort
    fixed: frozenset[str] = frozenset()
    before_fit: Callable[[], None] = lambda: None
    estimate: Callable[[FittedModel], float | None] = lambda _: None
    known: dict[tuple[frozenset[str], frozenset[str]], FittedModel] = field(default_factory=dict)
    off_values: dict[str, dict[str, float]] = field(default_factory=dict)
    refitted_keys: set[tuple[frozenset[str], frozenset[str]]] = field(default_factory=set)
    known_gains: _ByModel[FittedModel, dict[str, float]] = field(default_factory=_ByModel)
    known_columns: _ByModel[FittedModel, dict[tuple[str, ...], np.ndarray]] = field(default_factory=_ByModel)
    known_places: _ByModel[FittedModel, dict[str, dict[str, float]]] = field(default_factory=_ByModel)

    def fit(
        self, fit_model: FitModel, freed: frozenset[str] = frozenset(), *, again: bool = False
    ) -> FittedModel:
        """The fitted model of a choice of effects and freed constants, fitted only once.

        ``again`` fits once more from another start and keeps the better result.
        """
        key = frozenset(fit_model.ids), freed
        if key not in self.known or (again and key not in self.refitted_keys):
            fitted_model = self._fitted(fit_model, freed)
            if again:
                self.refitted_keys.add(key)
            first = self.known.get(key, fitted_model)
            self.known[key] = min(first, fitted_model, key=lambda each: each.rmse)
        return self.known[key]

    def at_constant(self, fitted_model: FittedModel, name: str, value: float) -> FittedModel:
        """The model with another value of a constant that is not free, refitted; it is not remembered."""
        return self._fitted(fitted_model.fit_model.with_numbers([name], [value]), fitted_model.freed)

    def _fitted(self, fit_model: FitModel, freed: frozenset[str]) -> FittedModel:
        self.before_fit()
        free = free_numbers(fit_model, self.geometry, freed, load=self.load)
        free = [parameter for parameter in free if parameter.name not in self.fixed]
        return refitted(self.predictor, fit_model, free, freed=freed, effort=self.effort.fit)

    def adding(self, fitted_model: FittedModel, effect: Effect) -> FittedModel:
        """The model with one more effect, refitted from the present values."""
        off = self.acting(fitted_model, effect)
        freed = fitted_model.freed | {f"{effect.id}.{n}" for n in off if not effect.parameter(n).fitted}
        start = self._placed(fitted_model, effect) | between(effect, off)
        for name in fixed_beside(self.geometry):
            owner, _, parameter = name.partition(".")
            if owner == effect.id and parameter in start:
                start[parameter] = effect.parameter(parameter).default
        started_model = fitted_model.fit_model.adding(effect, start)
        refitted_model = self.fit(started_model, freed)
        started = started_model.values[effect.id]
        unmoved = all(
            abs(refitted_model.fit_model.values[effect.id][name] - started[name])
            < _MOVED * abs(started[name])
            for name in off
        )
        if refitted_model.rmse > _STUCK * fitted_model.rmse or unmoved:
            refitted_model = self.fit(fitted_model.fit_model.adding(effect), freed, again=True)
        return refitted_model

    def acting(self, fitted_model: FittedModel, effect: Effect) -> dict[str, float]:
        """Parameters of an effect that change the prediction -> value at which they have no effect.

        These are the parameters declared as fitted, or the further constants if those change nothing.
        """
        if effect.id not in self.off_values:
            choices = [off_of(effect, fitted=fitted) for fitted in (True, False)]
            visible = (
                off
                for off in choices
                if np.any(self._sizes(self._columns(fitted_model, effect, off)) > self._least)
            )
            self.off_values[effect.id] = next(visible, choices[0])
        return self.off_values[effect.id]

    def freeing(self, fitted_model: FittedModel, effect: Effect) -> list[FittedModel]:
        """The model with further constants of an effect freed: all, and subsets if all are too many."""
        names = self.further(fitted_model, effect)
        hidden = self._blind(fitted_model.fit_model, names)
        seen = self._seen_from(fitted_model, effect, hidden)
        hidden -= set(seen)
        shown = names - hidden
        # What describes a part of the law that is off does not show until that part is there.
        together = {name: {name} | self._woken(fitted_model, effect, name, hidden) for name in sorted(shown)}
        names = set().union(*together.values())
        if not names:
            return []

        def moved(some: set[str]) -> FitModel:
            there = sorted(some & set(seen))
            return fitted_model.fit_model.with_numbers(there, [seen[name] for name in there])

        def fit(some: set[str]) -> FittedModel:
            return self.fit(moved(some), fitted_model.freed | some)

        if not self._would_matter(fitted_model, moved(names), names):
            return []
        whole = fit(names)
        if len(names) == 1 or whole.implausible <= fitted_model.implausible:
            return [whole]
        stuck = {p.name for p, at in zip(whole.free, whole.at_bound, strict=True) if at}
        fewer = [names - stuck] if 1 < len(names - stuck) < len(names) else []
        singles = [{name} for name in together]
        groups = [group for group in together.values() if len(group) > 1]
        return [fit(some) for some in (*fewer, *singles, *groups)]

    def further(self, fitted_model: FittedModel, effect: Effect) -> set[str]:
        """Names of the further constants of an effect that may still be freed."""
        names = {f"{effect.id}.{p.name}" for p in effect.parameters if not p.fitted and not p.reference}
        return names - fitted_model.freed - fixed_beside(self.geometry)

    def _would_matter(self, fitted_model: FittedModel, moved: FitModel, names: set[str]) -> bool:
        """Whether freeing constants may lower the error, by the linear model of their changes.

        Of the constants whose freeing improves a score, the least promising ones promise a share of the mean
        square four times as large.
        """
        basis, unexplained = unexplained_by(fitted_model)
        free = [p for p in free_numbers(moved, (), names) if p.name in names]
        columns = self.predictor.weighted(self.predictor.linearised(moved, free)[1])
        columns = columns[:, np.any(columns, axis=0)]
        if not np.all(np.isfinite(columns)):
            return True
        whole = fitted_model.mean_square * len(fitted_model.residual)
        return gain(columns, basis, unexplained) > _LEAST_FREED * whole

    def _seen_from(
        self, fitted_model: FittedModel, effect: Effect, hidden: Collection[str]
    ) -> dict[str, float]:
        """Of the constants that change nothing at their present value, those that do elsewhere, and where.

        A range of zero, say, has no slope: the place is taken that explains most of the residual.
        """
        places = {}
        for name in sorted(hidden):
            p, value = effect.parameter(name.partition(".")[2]), fitted_model.fit_model.number(name)
            end = p.upper if p.upper - value > value - p.lower else p.lower
            tried = [value + share * (end - value) for share in _ELSEWHERE]
            models = {there: fitted_model.fit_model.with_numbers([name], [there]) for there in tried}
            explained = self._explained(fitted_model, models)
            best = max(explained, key=lambda there: explained[there])
            if explained[best] > 0.0:
                places[name] = best
        return places

    def _woken(self, fitted_model: FittedModel, effect: Effect, name: str, hidden: set[str]) -> set[str]:
        """Of the hidden constants of an effect those that show once another one is not off."""
        p = effect.parameter(name.partition(".")[2])
        if not hidden or p.off is None or fitted_model.fit_model.number(name) != p.off:
            return set()
        there = between(effect, {p.name: p.off})[p.name]
        return hidden - self._blind(fitted_model.fit_model.with_numbers([name], [there]), hidden)

    def fixing(self, fitted_model: FittedModel, name: str, value: float) -> FittedModel:
        """The model with a freed constant fixed at a value again, refitted."""
        return self.fit(fitted_model.fit_model.with_numbers([name], [value]), fitted_model.freed - {name})

    def dropping(self, fitted_model: FittedModel, effect_id: str) -> FittedModel:
        """The model without an effect, refitted."""
        freed = frozenset(name for name in fitted_model.freed if not name.startswith(f"{effect_id}."))
        return self.fit(fitted_model.fit_model.without(effect_id), freed)

    def promising(self, fitted_model: FittedModel, effects: Sequence[Effect]) -> list[Effect]:
        """Effects by their first-order gain, the largest first; what gains little is left out."""
        gains = self.gains(fitted_model, effects)
        unexplained = unexplained_by(fitted_model)[1]
        share = _LEAST_NEAR_FLOOR if self.near_floor(fitted_model) else _LEAST_PROMISE
        least = share * float(unexplained @ unexplained)
        order = sorted(effects, key=lambda effect: -gains[effect.id])
        return [effect for effect in order if gains[effect.id] > least]

    def flexible(self, fitted_model: FittedModel, effects: Sequence[Effect], count: int) -> list[Effect]:
        """The effects with the largest first-order gain when their further constants are free as well.

        Only effects that have such constants: what a pressure fades in, say, does not show by its factor.
        """
        basis, unexplained = unexplained_by(fitted_model)
        gains = {}
        for effect in effects:
            off = {p.name: p.off for p in effect.parameters if p.off is not None}
            if len(off) > len(self.acting(fitted_model, effect)):
                gains[effect] = gain(self._columns(fitted_model, effect, off), basis, unexplained)
        return sorted(gains, key=lambda effect: -gains[effect])[:count]

    def gains(self, fitted_model: FittedModel, effects: Sequence[Effect]) -> dict[str, float]:
        """Effect -> first-order reduction of the sum of squares if it is added and all is refitted."""
        basis, unexplained = unexplained_by(fitted_model)
        gains = self.known_gains.setdefault(fitted_model, {})
        new = [effect for effect in effects if effect.id not in gains]
        self._try_ahead(fitted_model, new)
        for effect in new:
            gains[effect.id] = gain(self.changes(fitted_model, effect), basis, unexplained)
        return {effect.id: gains[effect.id] for effect in effects}

    def guess_ahead(self, fitted_model: FittedModel, effects: Sequence[Effect]) -> None:
        """Simulate side by side what `guessed` asks for effect by effect."""
        if self.predictor.simulated:
            self.predictor.try_ahead(self._guess(fitted_model, effect) for effect in effects)

    def guessed(self, fitted_model: FittedModel, effect: Effect) -> FittedModel:
        """The model with one more effect of the best first-order size; nothing else is refitted."""
        fit_model = self._guess(fitted_model, effect)
        residual = self._trial_residual(fit_model)
        if not float(np.mean(residual**2)) <= fitted_model.mean_square:  # also where its run stops
            fit_model, residual = fitted_model.fit_model.adding(effect, effect.off), fitted_model.residual
        return replace(fitted_model, fit_model=fit_model, residual=residual)

    def _guess(self, fitted_model: FittedModel, effect: Effect) -> FitModel:
        off = self.acting(fitted_model, effect)
        reach = np.array([between(effect, off)[name] - value for name, value in off.items()])
        columns = self.changes(fitted_model, effect)
        size = np.linalg.lstsq(columns, fitted_model.residual, rcond=1e-6)[0] * reach
        linear = {
            f"{effect.id}.{name}": value + x for (name, value), x in zip(off.items(), size, strict=True)
        }
        fit_model = fitted_model.fit_model.adding(effect, effect.off)
        free = [p for p in free_numbers(fit_model, (), fitted_model.freed) if p.name in linear]
        inside = [float(np.clip(linear[p.name], p.lower, p.upper)) for p in free]
        return fit_model.with_numbers([p.name for p in free], inside)

    def changes(self, fitted_model: FittedModel, effect: Effect) -> np.ndarray:
        """Change of the prediction by each parameter of an effect, shape (values, parameters)."""
        return self._columns(fitted_model, effect, self.acting(fitted_model, effect))

    def _columns(self, fitted_model: FittedModel, effect: Effect, off: dict[str, float]) -> np.ndarray:
        of_model = self.known_columns.setdefault(fitted_model, {})
        key = effect.id, *off
        if key not in of_model:
            of_model[key] = self._new_columns(fitted_model, effect, off)
        return of_model[key]

    def _new_columns(self, fitted_model: FittedModel, effect: Effect, off: dict[str, float]) -> np.ndarray:
        models = with_each(fitted_model.fit_model, effect, off, self._placed(fitted_model, effect))
        changes, *others = [
            self._changed(fitted_model, models, self.predictor.after(history))
            for history in self.predictor.histories((effect,))
        ]
        if others:
            basis, unexplained = unexplained_by(fitted_model)
            changes = max((changes, *others), key=lambda columns: gain(columns, basis, unexplained))
        # What changes nothing differs in the last digits, which would explain as much as any other column.
        return np.where(self._sizes(changes) > self._rounding, changes, 0.0)

    def _changed(
        self, fitted_model: FittedModel, models: Sequence[FitModel], predictor: Predictor
    ) -> np.ndarray:
        """Change of the prediction by each of the models, shape (values, models)."""
        measured, residual = predictor.measured, fitted_model.residual
        columns = [residual - predictor.weighted(measured - predictor.trial(model)) for model in models]
        return np.reshape(columns, (len(columns), len(residual))).T

    def _try_ahead(self, fitted_model: FittedModel, effects: Sequence[Effect]) -> None:
        """Simulate side by side what `gains` asks for one after the other."""
        if not self.predictor.simulated:
            return
        fit_model, places = fitted_model.fit_model, self.known_places.get(fitted_model, {})
        waiting = [(effect, place) for effect in effects if (place := place_of(effect)) is not None]
        self.predictor.try_ahead(
            model
            for effect, place in waiting
            if effect.id not in places
            for model in at_places(fit_model, effect, place).values()
        )
        known = self.known_columns.get(fitted_model, {})
        self.predictor.try_ahead(
            model
            for effect in effects
            for off in [self.off_values.get(effect.id, off_of(effect))]
            if (effect.id, *off) not in known
            for model in with_each(fit_model, effect, off, self._placed(fitted_model, effect))
        )

    def _placed(self, fitted_model: FittedModel, effect: Effect) -> dict[str, float]:
        """Where an effect begins that acts beyond some state only: the place that explains most.

        At its usual place it may lie beyond the data and would never be tried. Such a place is a fitted
        parameter without an off value; in logs of holds also the time by which an effect creeps.
        """
        place, known = place_of(effect), self.known_places.setdefault(fitted_model, {})
        place = place or (pace_of(effect) if len(self.predictor.histories((effect,))) > 1 else None)
        if place is None:
            return {}
        if effect.id not in known:
            explained = self._explained(fitted_model, at_places(fitted_model.fit_model, effect, place))
            size = float if place.fitted else abs  # a creep may go either way
            known[effect.id] = {place.name: max(explained, key=lambda value: size(explained[value]))}
        return known[effect.id]

    def _explained(self, fitted_model: FittedModel, changed: Mapping[float, FitModel]) -> dict[float, float]:
        """How much of the residual changes of the model explain, by the value that is changed.

        0 where it changes nothing that the free parameters do not change as well.
        """
        basis, unexplained = unexplained_by(fitted_model)
        self.predictor.try_ahead(changed.values())
        explained = {}
        for value, model in changed.items():
            column = fitted_model.residual - self._trial_residual(model)
            rest = column - basis @ (basis.T @ column)
            size = float(np.linalg.norm(rest))
            explained[value] = float(rest @ unexplained) / size if size > self._least else 0.0
        return explained

    def _trial_residual(self, fit_model: FitModel) -> np.ndarray:
        return self.predictor.weighted(self.predictor.measured - self.predictor.trial(fit_model))

    def _blind(self, fit_model: FitModel, names: set[str]) -> set[str]:
        """The constants that do not change the prediction."""
        free = [p for p in free_numbers(fit_model, (), names) if p.name in names]
        if not free:
            return set()
        columns = self.predictor.linearised(fit_model, free)[1]
        span = np.array([p.upper - p.lower for p in free])
        reach = self._sizes(columns) * span
        return {p.name for p, size in zip(free, reach, strict=True) if not size > self._least}

    def update_noise(self, fitted_model: FittedModel) -> None:
        """Lower the noise estimate if the residual of a better model has less."""
        estimated = self.estimate(fitted_model)
        if estimated is not None:
            self.noise = estimated if self.noise is None else min(self.noise, estimated)

    def near_floor(self, fitted_model: FittedModel) -> bool:
        """Whether the error is so near the noise that only clear gains count."""
        return self.noise is not None and fitted_model.rmse < _NEAR_FLOOR * self.noise

    @property
    def _least(self) -> float:
        """Smallest rms change that counts, a tenth of the noise."""
        return max(0.1 * (self.noise or 0.0), self._rounding)

    @cached_property
    def _rounding(self) -> float:
        """Rms change of a prediction that may be one of its last digits alone."""
        return _ROUNDING * float(self._sizes(self.predictor.weighted(self.predictor.measured)))

    @staticmethod
    def _sizes(columns: np.ndarray) -> np.ndarray:
        return np.sqrt(np.mean(columns**2, axis=0))


def off_of(effect: Effect, *, fitted: bool = True) -> dict[str, float]:
    """Parameters declared as fitted, or the others, that have a value at which they have no effect: these."""
    return {p.name: p.off for p in effect.parameters if p.off is not None and p.fitted is fitted}


def place_of(effect: Effect) -> Parameter | None:
    """Where an effect begins that acts beyond some state only: a fitted parameter without an off value."""
    places = [p for p in effect.parameters if p.off is None and p.fitted]
    return places[0] if len(places) == 1 else None


def pace_of(effect: Effect) -> Parameter | None:
    """The time by which an effect creeps, where a fit leaves it at its usual value at first."""
    times = [p for p in effect.parameters if p.off is None and not p.fitted and p.unit == "s"]
    return times[0] if len(times) == 1 and any(state.applied for state in effect.states) else None


def at_places(fit_model: FitModel, effect: Effect, place: Parameter) -> dict[float, FitModel]:
    """Places over its range, the usual one first -> the model with the effect acting from there.

    Of a time by which an effect creeps: ten and a hundred times as long as usual.
    """
    acting = effect.off | between(effect, off_of(effect))
    if place.fitted:
        places = [place.default, *np.linspace(place.lower, place.upper, _PLACES + 2)[1:-1].tolist()]
    else:  # a time: holds last from seconds to hours
        places = [place.default * times for times in _SLOWER if place.default * times <= place.upper]
    return {value: fit_model.adding(effect, acting | {place.name: value}) for value in places}


def with_each(
    fit_model: FitModel, effect: Effect, off: dict[str, float], placed: Mapping[str, float]
) -> list[FitModel]:
    """The model with each parameter of one more effect a little way from off, the others off.

    Args:
        fit_model: the model.
        effect: to add.
        off: its parameters and their off values.
        placed: where it begins.
    """
    there = between(effect, off)
    return [fit_model.adding(effect, {**effect.off, **placed, name: there[name]}) for name in off]


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
