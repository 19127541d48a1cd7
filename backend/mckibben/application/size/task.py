"""From the document of a sizing task to a task in SI and its parts catalogue."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

from mckibben.documents.drive import TubeInput, ValveInput
from mckibben.documents.drive_parts import tube_of, unverified_of, valve_of
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask, TaskLoad
from mckibben.documents.value_names import value_names
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.presets import MusclePreset, Preset, TubePreset, ValvePreset
from mckibben.sizing import (
    DesignLimits,
    MusclePart,
    Pair,
    PartsCatalogue,
    Task,
    TubePart,
    Uncertainty,
    ValvePart,
)
from mckibben.sizing.catalogue import CataloguePart, Values

PartT = TypeVar("PartT", bound=CataloguePart)

_LEAST_TUBE = 0.05  # m; the formulas are not valid for shorter tubes
# Range of lengths of a muscle whose maker states none [m].
_SHORTEST, _LONGEST = 0.02, 10.0
# A muscle without these catalogue data is only used if the task names it.
_COMPLETE = ("min_temperature", "max_temperature")


def about_task(document: SizingTask) -> str:
    """The task in one sentence, from its figures alone: what heads everything that is found for it."""
    load, pair = document.load, document.load.pair
    if pair is not None:
        against = f" against {pair.torque:.4g} N·m" if pair.torque else ""
        inertia = f" with {pair.inertia:.4g} kg·m²" if pair.inertia else ""
        what = f"Turn a pulley{inertia} by {math.degrees(pair.angle):.4g}°{against} with an antagonist pair"
    else:
        moved = [f"{load.mass:.4g} kg"] if load.mass else []
        moved += [f"a spring of {load.spring / 1e3:.4g} N/mm"] if load.spring else []
        moved += [f"{load.force:.4g} N"] if load.force else []
        moved += ["a force over the stroke"] if load.force_over_stroke is not None else []
        verb = "Lift" if load.mass and load.inclination > 1.57 else "Pull"
        helped = f" with {load.counterweight:.4g} kg of counterweight" if load.counterweight else ""
        what = f"{verb} {' and '.join(moved)}{helped} by {(document.stroke or 0.0) * 1e3:.4g} mm"
    time = "" if document.time is None else f" in {document.time:.4g} s"
    if document.speed is not None:
        time = f" at {document.speed:.4g} m/s"
    return f"{what}{time}, with {document.supply_pressure / 1e5:.4g} bar"


def heading_of(about: str, name: str) -> str:
    """The heading of what is found for a task: its figures, beside the name that its user gave it."""
    return f"{name.strip()}: {about}" if name.strip() else about


def task_of(document: SizingTask) -> Task:
    """The task in SI.

    Raises:
        InputError: a missing or contradictory field; names the field.
    """
    load = document.load
    pair = None if load.pair is None else _pair(load)
    if pair is None and document.stroke is None:
        raise InputError("the task has no stroke", field="stroke", hint='e.g. "stroke": "60 mm"')
    if pair is not None and document.stroke is not None:
        raise InputError("an antagonist pair has an angle, no stroke", field="stroke", hint="omit the stroke")
    time = document.time
    if document.speed is not None:
        if time is not None:
            raise InputError("give the time or the speed, not both", field="speed")
        if document.stroke is None:
            raise InputError("the speed of a pair is not known; give the time", field="speed")
        time = document.stroke / document.speed
        if not 1e-3 < time <= 60.0:
            raise InputError(f"the stroke would take {time:.3g} s", field="speed", hint="1 ms to 60 s")
    task = Task(
        stroke=document.stroke or 0.0,
        mass=load.mass,
        inclination=load.inclination,
        force=load.force,
        force_over_stroke=_profile(load),
        spring=load.spring,
        counterweight=load.counterweight,
        lever_ratio=load.lever_ratio,
        pair=pair,
        time=time,
        time_down=document.time_down,
        cycle_time=document.cycle_time,
        supply_pressure=document.supply_pressure,
        temperature=document.ambient_temperature,
        limits=DesignLimits(stiffness=document.stiffness, **document.limits.model_dump()),
        uncertainty=Uncertainty(**document.uncertainty.model_dump()),
        rank_by=document.rank_by,
        max_proposals=document.max_proposals,
    )
    task.duties()
    return task


def _pair(load: TaskLoad) -> Pair:
    assert load.pair is not None  # noqa: S101 - asked before
    for name in load.model_fields_set - {"pair"}:
        raise InputError(
            f"an antagonist pair has no {name.replace('_', ' ')}",
            field=f"load.{name}",
            hint="give its inertia and torque in load.pair",
        )
    pair = load.pair
    return Pair(pair.angle, pair.torque, pair.inertia, pair.pulley_radius)


def _profile(load: TaskLoad) -> tuple[tuple[float, ...], tuple[float, ...]]:
    profile = load.force_over_stroke
    if profile is None:
        return (), ()
    if len(profile.strokes) != len(profile.forces):
        raise InputError(
            f"{len(profile.strokes)} strokes and {len(profile.forces)} forces", field="load.force_over_stroke"
        )
    if any(b <= a for a, b in zip(profile.strokes, profile.strokes[1:], strict=False)):
        raise InputError("the strokes must be in ascending order", field="load.force_over_stroke.strokes")
    return tuple(profile.strokes), tuple(profile.forces)


def catalogue_of(document: SizingTask, studio: Studio) -> PartsCatalogue:
    """The available parts, with the data of their presets.

    Raises:
        InputError: an unknown preset (with the nearest match), an unsuitable one, or an empty list.
    """
    parts = document.catalogue
    length = parts.tube_length
    if 0.0 < length < _LEAST_TUBE:
        raise InputError(
            f"a tube of {length * 1e3:.3g} mm is too short for its formulas",
            field="catalogue.tube_length",
            hint="0 for none, or at least 50 mm",
        )
    muscles = _parts(studio, "muscles", parts.muscles, lambda preset: _muscle(preset, studio), _complete)
    if parts.muscles is None:
        muscles = _different(muscles)
    valves = _parts(studio, "valves", parts.valves, lambda preset: _valve(preset, studio), _switches)
    if not length:
        return PartsCatalogue(muscles, valves, (TubePart("", tube=None),))
    tubes = _parts(studio, "tubes", parts.tubes, lambda preset: _tube(preset, studio, length), lambda _: True)
    return PartsCatalogue(muscles, valves, tubes)


def _parts(
    studio: Studio,
    kind: str,
    names: Sequence[str] | None,
    convert: Callable[[Preset], PartT],
    usual: Callable[[Preset], bool],
) -> tuple[PartT, ...]:
    if names is None:
        return tuple(convert(preset) for preset in studio.library.list(kind) if usual(preset))
    if not names:
        raise InputError(
            f"the list of {kind} is empty",
            field=f"catalogue.{kind}",
            hint="name at least one, or omit the list",
        )
    parts: dict[str, PartT] = {}
    for index, name in enumerate(names):
        field = f"catalogue.{kind}.{index}"
        try:
            part = convert(studio.library.get(kind, name))
        except InputError as error:
            code = "unknown_preset" if error.code == "not_found" else error.code
            raise error.at(field, code=code) from error
        parts[part.id] = part
    return tuple(parts.values())


def _different(muscles: tuple[MusclePart, ...]) -> tuple[MusclePart, ...]:
    """The muscles without duplicates of the same model under other names."""
    distinct: dict[str, MusclePart] = {}
    for part in muscles:
        geometry = part.muscle._replace(nominal_length=1.0)
        distinct.setdefault(repr((geometry, part.values, part.limits, part.shortest, part.longest)), part)
    return tuple(distinct.values())


def _complete(preset: Preset) -> bool:
    return isinstance(preset, MusclePreset) and all(name in preset.data for name in _COMPLETE)


def _switches(preset: Preset) -> bool:
    return isinstance(preset, ValvePreset) and preset.regulator is None and "sonic_conductance" in preset.data


def _muscle(preset: Preset, studio: Studio) -> MusclePart:
    assert isinstance(preset, MusclePreset)  # noqa: S101 - of its folder
    facts = studio.facts(preset.id)
    data = preset.data
    ends = [data[name].si("K") if name in data else None for name in _COMPLETE]
    return MusclePart(
        id=preset.id,
        effects=tuple(studio.catalogue[name] for name in facts.effects),
        values=facts.effects,
        unverified=value_names(facts.unverified, studio.catalogue),
        muscle=facts.muscle,
        limits=facts.limits,
        shortest=facts.shortest or _SHORTEST,
        longest=facts.longest or _LONGEST,
        hysteresis=data["max_hysteresis"].si("1") if "max_hysteresis" in data else 0.0,
        coldest=ends[0],
        hottest=ends[1],
        suspended_mass=facts.suspended_mass,
        extrapolated=preset.extrapolated,
        fit=preset.fit,
    )


def _valve(preset: Preset, studio: Studio) -> ValvePart:
    assert isinstance(preset, ValvePreset)  # noqa: S101 - of its folder
    if preset.regulator is not None:
        raise InputError(
            f"{preset.id} is a pressure regulator", hint="name a switching or proportional valve"
        )
    try:
        flow = valve_of(ValveInput.model_validate({"preset": preset.id}), preset)
    except InputError as error:
        raise InputError(error.message, hint="choose another valve") from error
    ends = (preset.data.get(name) for name in ("min_pressure", "max_pressure"))
    least, most = (None if end is None else end.si("Pa") for end in ends)
    effects, values = _effects(preset, studio)
    return ValvePart(
        id=preset.id,
        unverified=value_names(unverified_of(preset, with_effects=True), studio.catalogue),
        valve=flow,
        min_pressure=least,
        max_pressure=most,
        effects=effects,
        values=values,
    )


def _tube(preset: Preset, studio: Studio, length: float) -> TubePart:
    assert isinstance(preset, TubePreset)  # noqa: S101 - of its folder
    effects, values = _effects(preset, studio)
    return TubePart(
        id=preset.id,
        effects=effects,
        values=values,
        unverified=value_names(unverified_of(preset, with_effects=True), studio.catalogue),
        tube=tube_of(TubeInput(preset=preset.id, length=length), preset),
    )


def _effects(preset: ValvePreset | TubePreset, studio: Studio) -> tuple[tuple[Effect, ...], Values]:
    stated = preset.effect_values()
    effects = tuple(studio.catalogue[name] for name in stated)
    return effects, {effect.id: effect.defaults | stated[effect.id] for effect in effects}
