"""Static characteristics of a muscle: curves and key figures per pressure, position over pressure."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Literal

import numpy as np

from mckibben.application.envelope import MeasuredRange, range_of, use_notices
from mckibben.application.muscle_summary import (
    GeometrySummary,
    MakerLimits,
    Notice,
    geometry_of,
    limit_notices,
    start_notices,
    stretch_notices,
    why_not_stretched,
)
from mckibben.application.operating_limits import load_notices, pressure_notices, temperature_notices
from mckibben.application.prediction_interval import ForceInterval, force_interval
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.facts.muscle import CURVES, LIFT, LIMITS, LOOP, OVER_PRESSURE, branch_of
from mckibben.facts.result import FiniteSeries, Number, Rows, Series, result_class
from mckibben.physics.errors import InputError
from mckibben.physics.units import si
from mckibben.presets import DesignPreset
from mckibben.simulation.statics.characteristics import (
    FILLING,
    VENTING,
    Array,
    Characteristics,
    Conditions,
    ForceBranches,
    HeldContractions,
    OperatingPoint,
    PressureBranch,
    characteristics,
    diameters_at_length,
    force_at_length,
    further_stiffness,
    held_contractions,
    ideal_contraction,
    lock_forces,
    operating_points,
    pressure_branch,
)
from mckibben.simulation.statics.inverse import contraction_at, pressure_for_force
from mckibben.simulation.statics.model import Curves, StaticModel

#: Gauge pressures of curves where none are stated [Pa].
DEFAULT_PRESSURES = (1e5, 2e5, 3e5, 4e5, 5e5, 6e5)
_OVER_PRESSURE_POINTS = 81
_MAX_PRESSURES = 12  # of a family of curves
_SHORTEST = 0.05  # shortest length accepted, share of the rest length; no muscle contracts so far


@dataclass(frozen=True, slots=True)
class CurvesQuestion:
    """Muscle, pressures and range of the curves; SI.

    Attributes:
        start: the muscle with its effects.
        pressures: gauge pressures of the curves [Pa], at least one.
        points: number of points along the length, at least two.
        unclipped: whether to show negative forces, which a muscle cannot exert.
        contraction_from, contraction_to: the range; None = from the pretension limit to the end of the last
            curve.
        load: constant load for the operating points [N]; None without them.
        fixed_length: length at which the force is shown over the pressure [m]; None without it.
        conditions: direction of motion, temperature, volume behind a closed valve.
        further_stiffness: whether to answer the stiffness by its other definitions too.
        at_pressure: gauge pressure at which the load is asked about [Pa]; needs a load.
        at_contraction: the contraction whose pressure is asked for, under the load.
    """

    start: StartModel
    pressures: tuple[float, ...] = DEFAULT_PRESSURES
    points: int = 200
    unclipped: bool = False
    contraction_from: float | None = None
    contraction_to: float | None = None
    load: float | None = None
    fixed_length: float | None = None
    conditions: Conditions = field(default_factory=Conditions)
    further_stiffness: bool = False
    at_pressure: float | None = None
    at_contraction: float | None = None


def example_question(example: DesignPreset, start: StartModel) -> CurvesQuestion:
    """The question of an example design about a muscle, its own or that with other effects."""
    asked: dict[str, Any] = {
        name: value for name, value in example.document.items() if name not in ("muscle", "effects")
    }
    asked["pressures"] = tuple(asked["pressures"])
    return CurvesQuestion(start, **asked)


@result_class
class CurveLimits(MakerLimits):
    """Limits of the muscle, SI."""

    ideal_max_contraction: float
    braid_lock_force: Series
    stretched: str | None
    """Why the curves do not hold where the muscle is longer than at rest; None where they may."""


@result_class
class HysteresisLoop:
    """Distance of the branches of filling and venting at the load, at each pressure of the curves; SI.

    It is that of a slow loop far from its ends, where friction has built up after the reversal. NaN where the
    load cannot be held.
    """

    FIGURES: ClassVar = LOOP.name

    pressure: FiniteSeries
    stroke: Series
    share: Series
    pressure_width: Series


@result_class
class OverPressure:
    """Position at the load, force and diameters at the fixed length over the pressure."""

    FIGURES: ClassVar = OVER_PRESSURE.name

    pressure: FiniteSeries
    load: float | None
    filling: PressureBranch | None
    """While shortening; None without a load."""
    venting: PressureBranch | None
    """While lengthening; None without a load."""
    fixed_length: float | None
    force_at_fixed_length: ForceBranches | None
    """Force over pressure; None without a fixed length."""
    diameter_at_fixed_length: Series | None
    outer_diameter_at_fixed_length: Series | None
    loop: HysteresisLoop | None
    """Width of the loop of the two branches; None without a load."""


@result_class
class Lift:
    """What the muscle does with the load at one pressure, SI; NaN where it cannot."""

    FIGURES: ClassVar = LIFT.name

    pressure: float
    load: float
    contraction: Number
    contraction_vented: Number
    length: Number
    hanging_length: Number
    lift: Number
    stiffness: Number
    stiffness_closed: Number
    asked_contraction: float | None
    pressure_filling: float | None
    pressure_venting: float | None
    flags: list[Notice]
    """The limits that it crosses, and why a figure is missing."""


@result_class
class LimitUse:
    """How much of a limit of the maker is used."""

    FIGURES: ClassVar = LIMITS.name

    name: Literal["max_pressure", "max_force", "max_contraction"]
    """Name of the limit."""
    used: float
    """What is held against it, in its unit."""
    limit: float
    """The limit, in its unit."""
    share: float


@result_class
class EffectSettings:
    """Effect id -> parameter -> value, SI."""

    effects: Mapping[str, Mapping[str, float]]
    """Effect id -> parameter -> value in SI."""
    defaults: Mapping[str, Mapping[str, float]]
    """Effect id -> parameter -> default of this muscle in SI, where it depends on the size of a muscle."""


def settings_of(model: StaticModel, start: StartModel) -> EffectSettings:
    """The effects of a model, and the defaults that its muscle has by its size."""
    size = model.muscle.size
    scaled = {
        effect.id: {p.name: p.default_of(size) for p in effect.parameters if p.default_at is not None}
        for effect in start.catalogue.values()
    }
    return EffectSettings(model.values, {name: values for name, values in scaled.items() if values})


@result_class
class CurvesResult:
    """Force, stiffness, volume and diameter over the length, SI; P pressures (rows), N lengths (columns)."""

    FIGURES: ClassVar = CURVES.name

    pressure: FiniteSeries
    length: FiniteSeries
    contraction: FiniteSeries
    braid_angle: Series
    force: Rows
    stiffness: Rows
    stiffness_closed: Rows
    stiffness_from_force: Rows | None
    stiffness_secant: Rows | None
    volume: Series
    diameter: Series
    outer_diameter: Series
    branch: str
    """Which way friction acts in the force, stiffness, characteristics and operating points."""
    interval: ForceInterval | None
    """Where new readings of the force are expected; None where the model was not fitted."""
    limits: CurveLimits
    """Limits of the muscle."""
    characteristics: list[Characteristics]
    """Figures of the muscle at each pressure."""
    geometry: GeometrySummary
    """Geometry of the muscle at rest, in all forms."""
    model: EffectSettings
    """The effects used, with all their values."""
    over_pressure: OverPressure | None
    """None without load and fixed length."""
    operating_points: list[OperatingPoint]
    """The state at each pressure; empty without a load."""
    holds: OperatingPoint | None
    """The highest pressure that holds the load within the limits, or, if none does, that holds it at all."""
    lift: Lift | None
    """What the muscle does with the load at the asked pressure; None where none is asked about."""
    limits_used: list[LimitUse]
    """How much of each known limit is used: of the asked pressure, else of the largest of the curves."""
    flags: list[Notice]
    """Remarks on the answer."""


def pressures_of(values: Sequence[str | float], where: str) -> tuple[float, ...]:
    """The gauge pressures of curves [Pa], from numbers in Pa or texts with a unit.

    Args:
        values: at least one.
        where: option or argument that states them, for messages.

    Raises:
        InputError: a value that is no pressure, or too many.
    """
    if not 0 < len(values) <= _MAX_PRESSURES:
        raise InputError(f"{where}: {len(values)} pressures, at most {_MAX_PRESSURES} are possible")
    pressures = []
    for value in values:
        part = value.strip() if isinstance(value, str) else value
        try:
            pressure = si(part, "Pa", reference="gauge")
        except InputError as error:
            raise InputError(f"{where}: {error.message}", hint=f'e.g. {where} "1 bar,3 bar"') from error
        if not 0.0 <= pressure <= 1e8:
            raise InputError(f"{where}: {part} is not between 0 and 1000 bar", hint="gauge pressures")
        pressures.append(pressure)
    return tuple(pressures)


def curves(question: CurvesQuestion, studio: Studio) -> CurvesResult:
    """The curves of a muscle.

    Raises:
        InputError: impossible geometry, a parameter out of bounds or an invalid range; names the field of
            the question.
    """
    start, conditions = question.start, question.conditions
    one_curve = question.load is None and question.fixed_length is None  # no branches of filling and venting
    model = studio.slow_model(start, directed=not (one_curve and conditions.direction == 0.0))
    pressures = np.array(question.pressures)
    grid = np.empty(0) if one_curve else np.linspace(0.0, float(np.max(pressures)), _OVER_PRESSURE_POINTS)
    under_load = held_contractions(model, pressures, grid, question.load, conditions)
    contraction = _range(question, model, under_load.free)
    length = model.muscle.nominal_length * (1.0 - contraction)

    def curves_of(model: StaticModel) -> Curves:
        return model.curves(
            pressures,
            length,
            direction=conditions.direction,
            temperature=conditions.temperature,
            clipped=not question.unclipped,
            dead_volume=conditions.dead_volume,
            polytropic_exponent=conditions.polytropic_exponent,
        )

    columns = curves_of(model)
    further = None
    if question.further_stiffness:
        further = further_stiffness(model, columns, pressures, length, under_load.free)
    points: list[OperatingPoint] = []
    lift = _lift(question, model)
    crossed = [flag for p in question.pressures for flag in model.limits.flags(pressure=p)]
    if question.load is not None:
        points, flags = operating_points(model, pressures, question.load, under_load.loaded, conditions)
        crossed += flags
    # Volume, diameter and angle depend on the length only, unless an effect lets the pressure stretch the
    # braid; then they are those of the highest pressure.
    top = int(np.argmax(pressures))
    return CurvesResult(
        pressure=pressures,
        length=length,
        contraction=contraction,
        braid_angle=columns.braid_angle[top],
        force=columns.force,
        stiffness=columns.stiffness,
        stiffness_closed=columns.stiffness_closed,
        stiffness_from_force=further and further.from_force,
        stiffness_secant=further and further.secant,
        volume=columns.volume[top],
        diameter=columns.diameter[top],
        outer_diameter=columns.outer_diameter[top],
        branch=branch_of(conditions.direction),
        interval=force_interval(start.fit, model, columns, curves_of),
        limits=CurveLimits(
            max_pressure=model.limits.max_pressure,
            max_force=model.limits.max_force,
            max_contraction=model.limits.max_contraction,
            max_pretension=model.limits.max_pretension,
            ideal_max_contraction=ideal_contraction(model),
            braid_lock_force=lock_forces(model, pressures),
            stretched=why_not_stretched(start),
        ),
        characteristics=characteristics(model, pressures, under_load.free, conditions),
        geometry=geometry_of(start),
        model=settings_of(model, start),
        over_pressure=_over_pressure(question, model, grid, under_load),
        operating_points=points,
        holds=_holding(points),
        lift=lift,
        limits_used=_limits_used(model, question, points, lift),
        flags=[
            *start_notices(start),
            *limit_notices(crossed),
            *pressure_notices({f"pressures.{i}": p for i, p in enumerate(question.pressures)}),
            *load_notices(start, question.load),
            *stretch_notices(start, min([0.0, *_reached(points)]), "load"),
            *temperature_notices(start, conditions.temperature, "temperature"),
            *use_notices(start.fit, _use(question, model, contraction)),
        ],
    )


def _holding(points: Sequence[OperatingPoint]) -> OperatingPoint | None:
    """The point with the highest pressure among those within the limits, or else among all that hold."""
    at_rest = [point for point in points if math.isfinite(point.contraction)]
    return max(at_rest, key=lambda point: (not point.flags, point.pressure), default=None)


def _reached(points: Sequence[OperatingPoint]) -> list[float]:
    """Contractions at which the load is held."""
    return [point.contraction for point in points if math.isfinite(point.contraction)]


def _lift(question: CurvesQuestion, model: StaticModel) -> Lift | None:
    """What the muscle does with the load at the asked pressure."""
    pressure, load, conditions = question.at_pressure, question.load, question.conditions
    if pressure is None or load is None:
        return None
    # Held at the pressure while filling and while venting, and without pressure after venting.
    pressures, ways = np.array([pressure, pressure, 0.0]), np.array([FILLING, VENTING, VENTING])
    held = contraction_at(
        model, load=load, pressures=pressures, direction=ways, temperature=conditions.temperature
    )
    filled, vented, hanging = held.tolist()
    (point,), flags = operating_points(
        model, pressures[:1], load, held[:1], replace(conditions, direction=FILLING)
    )
    rest = model.muscle.nominal_length
    ends: list[float | None] = [None, None]
    if question.at_contraction is not None:
        length = rest * (1.0 - question.at_contraction)
        if length < _SHORTEST * rest:
            raise InputError(
                f"no muscle contracts by {question.at_contraction * 100:.4g} %",
                field="at_contraction",
                hint="e.g. '15 %'",
            )
        for index, way in enumerate((FILLING, VENTING)):
            found = pressure_for_force(
                model, force=load, length=length, direction=way, temperature=conditions.temperature
            )
            ends[index] = found.value
            if index == 0:
                flags += [flag for flag in found.flags if flag not in flags]
    return Lift(
        pressure=pressure,
        load=load,
        contraction=filled,
        contraction_vented=vented,
        length=rest * (1.0 - filled),
        hanging_length=rest * (1.0 - hanging),
        lift=rest * (filled - hanging),
        stiffness=point.stiffness,
        stiffness_closed=point.stiffness_closed,
        asked_contraction=question.at_contraction,
        pressure_filling=ends[0],
        pressure_venting=ends[1],
        flags=limit_notices(flags),
    )


def _limits_used(
    model: StaticModel, question: CurvesQuestion, points: Sequence[OperatingPoint], lift: Lift | None
) -> list[LimitUse]:
    reached, limits = _reached(points), model.limits
    highest = max(question.pressures)
    if lift is not None:
        highest, reached = lift.pressure, [x for x in (lift.contraction,) if math.isfinite(x)]
    return [
        LimitUse(name, used, limit, used / limit)
        for name, used, limit in (
            ("max_pressure", highest, limits.max_pressure),
            ("max_force", question.load, limits.max_force),
            ("max_contraction", max(0.0, *reached) if reached else None, limits.max_contraction),
        )
        if used is not None and limit
    ]


def _use(question: CurvesQuestion, model: StaticModel, contraction: Array) -> dict[str, MeasuredRange]:
    """The ranges in which curves use a model; slow ones, so without a speed."""
    use = (
        range_of("rest_length", model.muscle.nominal_length)
        | range_of("pressure", *question.pressures)
        | range_of("contraction", float(contraction[0]), float(contraction[-1]))
        | range_of("temperature", question.conditions.temperature)
    )
    return use if question.load is None else use | range_of("load", question.load)


def _range(question: CurvesQuestion, model: StaticModel, free: Array) -> Array:
    """Contractions of the columns; by default the permitted range, extended to the end of the last curve."""
    locked = 1.0 - model.longest / model.muscle.nominal_length
    first, last = question.contraction_from, question.contraction_to
    if first is None:
        first = max(-(model.limits.max_pretension or 0.0), locked)
        if last is not None and last <= first:
            first = max(last - 0.01, locked)
    if last is None:
        reached = float(np.max(free, initial=0.0, where=np.isfinite(free)))
        enough = max(first, 0.0) + 1e-3
        last = reached if reached > enough else max(ideal_contraction(model), enough)
        last = max(last, model.limits.max_contraction or 0.0)
    for name, value in (("contraction_from", first), ("contraction_to", last)):
        if value < locked:
            raise InputError(
                f"a stretch of {-value * 100:.3g} % is beyond the braid lock at {-locked * 100:.3g} %",
                field=name,
                hint=f"at least '{locked * 100:.3g} %'",
            )
        if value > 1.0 - _SHORTEST:
            raise InputError(f"no muscle contracts by {value * 100:.3g} %", field=name, hint="e.g. '25 %'")
    if not last > first:
        raise InputError(
            f"the end of the range, {last * 100:.3g} %, must be greater than its start, {first * 100:.3g} %",
            field="contraction_to" if question.contraction_to is not None else "contraction_from",
        )
    columns = np.linspace(first, last, question.points)
    nearest = int(np.argmin(np.abs(columns)))
    if 0 < nearest < len(columns) - 1:
        columns[nearest] = 0.0  # the rest length, at which the blocked force is shown
    return columns


def _over_pressure(
    question: CurvesQuestion, model: StaticModel, grid: Array, under_load: HeldContractions
) -> OverPressure | None:
    load, fixed = question.load, question.fixed_length
    if load is None and fixed is None:
        return None
    temperature = question.conditions.temperature
    forces, filling, venting, loop = None, None, None, None
    diameter, outer_diameter = None, None
    if fixed is not None:
        _check_fixed_length(fixed, model)
        forces = force_at_length(model, grid, fixed, temperature=temperature)
        diameter, outer_diameter = diameters_at_length(model, grid, fixed, temperature=temperature)
    if load is not None:
        filling, venting = (
            pressure_branch(model, grid, contraction, direction=direction, temperature=temperature)
            for contraction, direction in ((under_load.filling, FILLING), (under_load.venting, VENTING))
        )
        loop = _loop(np.array(question.pressures), grid, under_load, model.muscle.nominal_length)
    return OverPressure(grid, load, filling, venting, fixed, forces, diameter, outer_diameter, loop)


def _loop(
    pressures: Array, grid: Array, under_load: HeldContractions, nominal_length: float
) -> HysteresisLoop:
    """The width of the loop at some pressures, from both branches over a grid of pressures."""
    share = under_load.venting - under_load.filling
    if float(grid[-1]) > 0.0:
        slope = np.gradient(0.5 * (under_load.venting + under_load.filling), grid)
        with np.errstate(divide="ignore", invalid="ignore"):
            width = np.where(slope > 0.0, share / slope, np.nan)
    else:  # a single pressure of zero
        width = np.full(len(grid), np.nan)
    share, width = np.interp(pressures, grid, share), np.interp(pressures, grid, width)
    return HysteresisLoop(pressures, share * nominal_length, share, width)


def _check_fixed_length(length: float, model: StaticModel) -> None:
    shortest = _SHORTEST * model.muscle.nominal_length
    if not shortest <= length <= model.longest:
        raise InputError(
            f"a length of {length * 1e3:.4g} mm is out of reach",
            field="fixed_length",
            hint=f"between {shortest * 1e3:.4g} mm and the braid lock at {model.longest * 1e3:.4g} mm",
        )
