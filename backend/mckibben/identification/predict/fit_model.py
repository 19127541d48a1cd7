"""A model with values, and which of them a fit may change."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import GEOMETRY, NEUTRAL_ANGLE, Muscle
from mckibben.physics.parameter import UNKNOWN_SIZE, MuscleSize, Parameter

#: Name of the unknown load of a measurement [N].
LOAD = "load_force"
#: Name of the supply pressure over the stated one [-].
SUPPLY = "supply_factor"

#: What `free` calls the starts of runs; and begins of their names: how far the stroke at the start lies
#: beyond its first reading [m], and the speed there [m/s]. A number follows where there are several runs.
START = "start"
START_STROKE, START_SPEED = "start_stroke", "start_speed"

_UNITS = {name: "rad" if name == "braid_angle" else "m" for name in GEOMETRY} | {LOAD: "N"}
# Tolerance of a geometry field when none is stated: angle in rad, others as a share of the value.
_DEFAULT_TOLERANCE = {"braid_angle": 0.06, "nominal_length": 0.02}
_DEFAULT_SHARE = 0.10


@dataclass(frozen=True)
class FitModel:
    """A muscle, its effects and their values, some of which a fit may change.

    Values are named "effect.parameter", by the field of the muscle, `LOAD`, `SUPPLY` or of a start.

    Attributes:
        muscle: geometry, SI.
        effects: the effects, in the order in which they were added.
        values: effect id -> parameter -> value, SI; complete.
        load: the unknown load of a measurement [N].
        assumed: fields of the muscle that an effect needs and that are not stated; they hold a typical value.
        supply_factor: supply pressure of a drive over the stated one [-].
        size: of the stated muscle, with which the bounds of parameters go.
        starts: of the runs of records in time, by their names; those left out begin at rest at the first
            reading.
    """

    muscle: Muscle
    effects: tuple[Effect, ...] = ()
    values: Mapping[str, Mapping[str, float]] = ()  # type: ignore
    load: float = 0.0
    assumed: frozenset[str] = frozenset()
    supply_factor: float = 1.0
    size: MuscleSize = UNKNOWN_SIZE
    starts: Mapping[str, float] = ()  # type: ignore

    def __post_init__(self) -> None:
        object.__setattr__(self, "starts", dict(self.starts))
        object.__setattr__(self, "values", {name: dict(inner) for name, inner in dict(self.values).items()})

    def number(self, name: str) -> float:
        """The value with this name."""
        if name == LOAD:
            return self.load
        if name == SUPPLY:
            return self.supply_factor
        if is_start(name):
            return self.starts.get(name, 0.0)
        if name in GEOMETRY:
            return float(getattr(self.muscle, name))
        effect, parameter = name.split(".")
        return self.values[effect][parameter]

    def with_numbers(self, names: Sequence[str], numbers: Sequence[float] | np.ndarray) -> FitModel:
        """The same model with some values replaced."""
        values = {effect: dict(inner) for effect, inner in self.values.items()}
        geometry: dict[str, float] = {}
        starts = dict(self.starts)
        load, supply = self.load, self.supply_factor
        for name, number in zip(names, numbers, strict=True):
            if name == LOAD:
                load = float(number)
            elif name == SUPPLY:
                supply = float(number)
            elif is_start(name):
                starts[name] = float(number)
            elif name in GEOMETRY:
                geometry[name] = float(number)
            else:
                effect, parameter = name.split(".")
                values[effect][parameter] = float(number)
        muscle = self.muscle._replace(**geometry) if geometry else self.muscle
        return replace(self, muscle=muscle, values=values, load=load, supply_factor=supply, starts=starts)

    def adding(self, effect: Effect, values: Mapping[str, float] | None = None) -> FitModel:
        """The model with one more effect, at its defaults unless values are given.

        Fields of the muscle that the effect needs and that are not stated are assumed.
        """
        effect_values = {**effect.defaults, **(values or {})}
        unstated = {name for name in effect.needs if getattr(self.muscle, name) == 0.0}
        return replace(
            self,
            muscle=self.muscle.assuming(unstated),
            effects=(*self.effects, effect),
            values={**self.values, effect.id: effect_values},
            assumed=self.assumed | unstated,
        )

    def without(self, effect_id: str) -> FitModel:
        """The model without an effect, and without assumptions made only for it."""
        effects = tuple(effect for effect in self.effects if effect.id != effect_id)
        idle = self.assumed - {name for effect in effects for name in effect.needs}
        return replace(
            self,
            muscle=self.muscle._replace(**dict.fromkeys(idle, 0.0)),
            effects=effects,
            values={name: parameters for name, parameters in self.values.items() if name != effect_id},
            assumed=self.assumed - idle,
        )

    @property
    def ids(self) -> tuple[str, ...]:
        """Ids of the effects."""
        return tuple(effect.id for effect in self.effects)


def is_start(name: str) -> bool:
    """Whether a value is one of the start of a run."""
    return name.startswith((START_STROKE, START_SPEED))


def free_numbers(
    fit_model: FitModel,
    geometry: Iterable[Free] = (),
    freed: Collection[str] = (),
    *,
    load: Free | None = None,
) -> tuple[Free, ...]:
    """The free parameters of a fit.

    Args:
        fit_model: the model; its values are the starts.
        geometry: geometry fields with their bounds (`free_geometry`), `SUPPLY`, or starts of runs.
        freed: names of constants that are free in addition to those declared as fitted.
        load: the unknown load with its bounds.
    """
    geometry = tuple(geometry)
    fixed = fixed_beside(geometry)
    of_effects = [
        _free(effect.id, p, fit_model.values[effect.id][p.name], p.bounds(fit_model.size))
        for effect in fit_model.effects
        for p in effect.parameters
        if (p.fitted or f"{effect.id}.{p.name}" in freed) and f"{effect.id}.{p.name}" not in fixed
    ]
    others = [Free(f.name, fit_model.number(f.name), f.lower, f.upper, f.unit) for f in geometry]
    if load is not None:
        others.append(Free(LOAD, fit_model.load, load.lower, load.upper, load.unit))
    return (*of_effects, *others)


def fixed_beside(free: Iterable[Free]) -> frozenset[str]:
    """The constants that keep their values beside these parameters."""
    return frozenset().union(*(each.fixes for each in free))


def _free(effect: str, p: Parameter, value: float, bounds: tuple[float, float]) -> Free:
    usual = abs(p.default) if p.off is None else abs(p.default - p.off)
    if not usual and p.natural:
        usual = p.upper - p.lower  # a share that is 0 by default
    return Free(
        name=f"{effect}.{p.name}",
        start=value,
        lower=bounds[0],
        upper=bounds[1],
        unit=p.unit,
        off=p.off,
        usual=usual or None,
        natural=p.natural,
        measured=p.measured,
    )


def free_geometry(muscle: Muscle, names: Iterable[str], tolerance: Mapping[str, float]) -> tuple[Free, ...]:
    """Geometry fields that a fit may change within their tolerance.

    Args:
        muscle: the muscle.
        names: fields.
        tolerance: field -> largest change in either direction, SI; by default 0.06 rad (braid angle), 2 %
            (nominal length) or 10 %.

    Raises:
        InputError: a name is not a geometry field, or its value is not known.
    """
    choice = []
    for name in dict.fromkeys(names):
        if name not in GEOMETRY:
            raise InputError(
                f"'{name}' is not a geometry field that can be freed",
                field="free",
                hint=did_you_mean(name, GEOMETRY),
            )
        value = float(getattr(muscle, name))
        width = tolerance.get(name, _DEFAULT_TOLERANCE.get(name, _DEFAULT_SHARE * value))
        if name == "nominal_length":
            width = tolerance.get(name, _DEFAULT_TOLERANCE[name] * value)
        if not width > 0.0:
            raise InputError(f"the muscle's {name.replace('_', ' ')} is not known", field=f"muscle.{name}")
        upper = min(value + width, 0.9999 * NEUTRAL_ANGLE) if name == "braid_angle" else value + width
        choice.append(Free(name, value, max(value - width, 1e-6), upper, _UNITS[name]))
    return tuple(choice)


@dataclass(frozen=True, slots=True)
class Free:
    """A free parameter: name, start, bounds, SI unit, the value at which it has no effect, a usual change.

    ``natural``: its bounds are those of its definition, such as 0 and 1 of a share. ``measured``: the range
    beyond which its value is implausible, where the bounds are wider. ``fixes``: constants of effects that
    act exactly as it does, and so keep their values beside it. ``ties``: constants that always have its
    value.
    """

    name: str
    start: float
    lower: float
    upper: float
    unit: str
    off: float | None = None
    usual: float | None = None
    natural: bool = False
    measured: tuple[float, float] | None = None
    fixes: frozenset[str] = frozenset()
    ties: tuple[str, ...] = ()

    @property
    def typical(self) -> float:
        """A change that matters: the usual one, or a hundredth of the range between the bounds."""
        return self.usual or 0.01 * (self.upper - self.lower)


def tied(free: Sequence[Free], ties: Mapping[str, str]) -> tuple[Free, ...]:
    """The free parameters where some constants always have the value of another one.

    Args:
        free: the parameters.
        ties: a constant -> the parameter that it follows; both as "effect.parameter".

    Raises:
        InputError: a parameter that is not free, or another unit.
    """
    units = {p.name: p.unit for p in free}
    for follower, leader in ties.items():
        for name in (follower, leader):
            if name not in units:
                raise InputError(
                    f"{name} is not fitted, so nothing can be tied to it", field="ties",
                    hint=did_you_mean(name, units) if units else "free it, and ask for a fit",
                )  # fmt: skip
        if leader in ties:
            raise InputError(f"{leader} is itself tied to {ties[leader]}", field="ties", hint=ties[leader])
        if units[follower] != units[leader]:
            raise InputError(
                f"{follower} is in {units[follower]} and {leader} in {units[leader]}", field="ties",
                hint="tie constants of one unit",
            )  # fmt: skip
    by_name = {p.name: p for p in free}
    return tuple(_leading(p, [by_name[f] for f, leader in ties.items() if leader == p.name])
                 for p in free if p.name not in ties)  # fmt: skip


def _leading(p: Free, followers: Sequence[Free]) -> Free:
    """The parameter with its followers, within the bounds of all."""
    if not followers:
        return p
    lower, upper = max(f.lower for f in (p, *followers)), min(f.upper for f in (p, *followers))
    return replace(
        p, ties=tuple(f.name for f in followers), lower=lower, upper=upper,
        start=min(max(p.start, lower), upper),
    )  # fmt: skip


def each(free: Sequence[Free]) -> tuple[Free, ...]:
    """Every parameter and every constant that follows one, as parameters of their own."""
    return tuple(replace(p, name=name, ties=()) for p in free for name in (p.name, *p.ties))


def places(free: Sequence[Free]) -> list[int]:
    """Of `each`, the number of the parameter that gives its value."""
    return [place for place, p in enumerate(free) for _ in (p.name, *p.ties)]


def with_values(fit_model: FitModel, free: Sequence[Free], numbers: Sequence[float] | np.ndarray) -> FitModel:
    """The model with these values of free parameters, and of what is tied to them."""
    names = [p.name for p in each(free)]
    return fit_model.with_numbers(names, [float(numbers[place]) for place in places(free)])


def together(slopes: np.ndarray, free: Sequence[Free]) -> np.ndarray:
    """Derivatives by free parameters, shape (values, free), of those by `each` of them."""
    found = np.zeros((len(slopes), len(free)))
    for column, place in enumerate(places(free)):
        found[:, place] += slopes[:, column]
    return found
