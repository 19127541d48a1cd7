"""What a caller says about a muscle, made complete: preset, overrides, three forms of geometry, effects.

The one place where the command line and the HTTP interface turn a muscle of `interfaces` form into the
physics' own `Muscle` and a choice of effects.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mckibben.physics.braid import Braid, Rhombus, braid_from_rhombus, rest_diameter_and_angle
from mckibben.physics.catalogue import Catalogue
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import Muscle
from mckibben.physics.units import si
from mckibben.presets import MusclePreset, PresetLibrary

EffectValues = dict[str, dict[str, float]]

# What tells the three forms of geometry apart; a bore or a wall goes with any of them.
_MARKS = {
    "diameter and angle": ("braid_angle", "braid_diameter"),
    "thread": ("thread_length", "turns"),
    "rhombus": ("rhombus",),
}


@dataclass(frozen=True, slots=True)
class GivenMuscle:
    """A muscle as the caller gives it; numbers in SI, None where not given."""

    preset: str | None = None
    nominal_length: float | None = None
    inside_diameter: float | None = None
    braid_diameter: float | None = None
    braid_angle: float | None = None
    wall_thickness: float | None = None
    thread_length: float | None = None
    turns: float | None = None
    rhombus: Rhombus | None = None


@dataclass(frozen=True, slots=True)
class StartModel:
    """A complete muscle with the effects its model has.

    Attributes:
        muscle: geometry at rest.
        effects: effect id -> every parameter of it, SI.
        preset: the preset it is based on, for limits, tolerances and sources.
        rhombus: the lattice, when the caller gave the geometry by it.
    """

    muscle: Muscle
    effects: EffectValues
    preset: MusclePreset | None = None
    rhombus: Rhombus | None = None


def start_model(
    given: GivenMuscle,
    effects: Mapping[str, Mapping[str, float | str]] | None,
    *,
    library: PresetLibrary,
    catalogue: Catalogue,
) -> StartModel:
    """The muscle and effects a request means.

    Args:
        given: the muscle; fields besides a preset take the place of the preset's own.
        effects: effect id -> parameters (SI numbers or texts with units); {} is the ideal model, None the
            preset's own effects, or the ideal model without a preset.
        library: where the preset is looked up.
        catalogue: the known effects.

    Raises:
        InputError: no or more than one form of geometry, something of it missing, an unknown preset, effect or
            parameter, a value outside the bounds of its parameter.
    """
    preset = None if given.preset is None else _preset(given.preset, library)
    muscle = _muscle(given, preset)
    if effects is None:
        own = {} if preset is None else preset.effect_values()
        chosen = {name: catalogue[name].defaults | values for name, values in own.items()}
    else:
        chosen = {name: _effect_values(name, values, catalogue) for name, values in effects.items()}
    return StartModel(muscle, chosen, preset, given.rhombus)


def _preset(preset_id: str, library: PresetLibrary) -> MusclePreset:
    try:
        return library.muscle(preset_id)
    except InputError as error:
        raise InputError(error.message, field="muscle.preset", hint=error.hint, code="unknown_preset") from error


def _muscle(given: GivenMuscle, preset: MusclePreset | None) -> Muscle:
    forms = [form for form, marks in _MARKS.items() if any(getattr(given, mark) is not None for mark in marks)]
    if len(forms) > 1:
        raise InputError(
            f"the muscle is given in {len(forms)} forms at once: {' and '.join(forms)}",
            field=f"muscle.{_first_given(given, _MARKS[forms[1]])}",
            hint="give braid_angle with a diameter, or thread_length with turns, or rhombus",
        )
    form = forms[0] if forms else "diameter and angle"
    base = None if preset is None else _preset_muscle(preset)
    length = given.nominal_length if given.nominal_length is not None else base and base.nominal_length
    if length is None:
        raise InputError(
            "the muscle has no length", field="muscle.nominal_length", hint="e.g. \"nominal_length\": \"300 mm\""
        )
    if form == "diameter and angle":
        return _by_diameter(given, base, length)
    return _by_thread(given, base, length)


def _first_given(given: GivenMuscle, names: tuple[str, ...]) -> str:
    return next(name for name in names if getattr(given, name) is not None)


def _preset_muscle(preset: MusclePreset) -> Muscle:
    geometry = preset.geometry
    wall = geometry.wall_thickness
    return Muscle(
        nominal_length=geometry.nominal_length.si("m"),
        braid_diameter=geometry.braid_diameter.si("m"),
        braid_angle=geometry.braid_angle.si("rad"),
        wall_thickness=0.0 if wall is None else wall.si("m"),
        inside_diameter=geometry.inside_diameter.si("m"),
    )


def _by_diameter(given: GivenMuscle, base: Muscle | None, length: float) -> Muscle:
    """D0 is the braid diameter at the braid angle; without it the bore is taken."""
    if base is None:
        if given.braid_angle is None:
            raise InputError(
                "the muscle has no braid angle" if _has_diameter(given) else "the muscle has no geometry",
                field="muscle.braid_angle" if _has_diameter(given) else "muscle",
                hint="give a preset, or braid_angle with a diameter, or thread_length with turns, or rhombus",
            )
        if not _has_diameter(given):
            raise InputError(
                "the muscle has a braid angle but no diameter",
                field="muscle.inside_diameter",
                hint="e.g. \"inside_diameter\": \"20 mm\"",
            )
        wall = given.wall_thickness or 0.0
        bore = given.inside_diameter
        braid = given.braid_diameter if given.braid_diameter is not None else bore
        return Muscle(length, braid, given.braid_angle, wall, bore if bore is not None else braid - wall)
    wall = base.wall_thickness if given.wall_thickness is None else given.wall_thickness
    bore = base.inside_diameter if given.inside_diameter is None else given.inside_diameter
    # A wider bore or a thicker wall carries the braid outwards with it.
    follows = base.braid_diameter + (bore - base.inside_diameter) + (wall - base.wall_thickness)
    braid = follows if given.braid_diameter is None else given.braid_diameter
    return Muscle(length, braid, base.braid_angle if given.braid_angle is None else given.braid_angle, wall, bore)


def _has_diameter(given: GivenMuscle) -> bool:
    return given.braid_diameter is not None or given.inside_diameter is not None


def _by_thread(given: GivenMuscle, base: Muscle | None, length: float) -> Muscle:
    if given.rhombus is not None:
        braid = braid_from_rhombus(**given.rhombus._asdict())
    else:
        for name, other in (("thread_length", "turns"), ("turns", "thread_length")):
            if getattr(given, name) is None:
                raise InputError(
                    f"{other} is given without {name}",
                    field=f"muscle.{name}",
                    hint="the thread form needs thread_length, turns and nominal_length",
                )
        braid = Braid(given.thread_length, given.turns)
    try:
        diameter, angle = rest_diameter_and_angle(braid=braid, length=length)
    except InputError as error:
        raise InputError(error.message, field=f"muscle.{error.field}", hint=error.hint) from error
    wall = given.wall_thickness
    if wall is None:
        wall = base.wall_thickness if base is not None else 0.0
    bore = given.inside_diameter if given.inside_diameter is not None else max(diameter - wall, 0.0)
    return Muscle(length, diameter, angle, wall, bore)


def _effect_values(effect_id: str, given: Mapping[str, float | str], catalogue: Catalogue) -> dict[str, float]:
    """Every parameter of an effect in SI: the given ones, defaults for the rest; bounds are the model's to check."""
    path = f"effects.{effect_id}"
    if effect_id not in catalogue:
        raise InputError(
            f"there is no effect '{effect_id}'",
            field=path,
            hint=did_you_mean(effect_id, catalogue),
            code="unknown_effect",
        )
    effect = catalogue[effect_id]
    units = {parameter.name: parameter.unit for parameter in effect.parameters}
    values = dict(effect.defaults)
    for name, value in given.items():
        field = f"{path}.{name}"
        if name not in units:
            raise InputError(
                f"the effect '{effect_id}' has no parameter '{name}'",
                field=field,
                hint=did_you_mean(name, units),
            )
        try:
            values[name] = si(value, units[name])
        except InputError as error:
            raise InputError(error.message, field=field, hint=error.hint) from error
    return values
