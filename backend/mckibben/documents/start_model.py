"""From a muscle in a document to a start model: preset, overrides, three forms of geometry, effects.

Command line and HTTP interface both use it to make a `Muscle` and a choice of effects.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from mckibben.documents.muscle import MuscleInput
from mckibben.physics.braid import Braid, Rhombus, braid_from_rhombus, rest_diameter_and_angle
from mckibben.physics.catalogue import EffectCatalogue
from mckibben.physics.custom import CUSTOM, typed_effect
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.physics.parameter import MuscleSize
from mckibben.physics.units import si
from mckibben.presets import MusclePreset, Quantity
from mckibben.presets.fit import FitRecord
from mckibben.presets.quantity import quantities
from mckibben.simulation.statics.limits import MuscleLimits

EffectValues = dict[str, dict[str, float]]

# Paths of a preset's values that affect the curves or their limits.
_MODEL_PARTS = (
    "geometry.",
    "effects.",
    "limits.max_pressure",
    "limits.max_force",
    "limits.max_contraction",
    "limits.max_pretension",
)
# Fields that identify the three forms of geometry; a bore or a wall may be given with any of them.
_MARKS = {
    "diameter and angle": ("braid_angle", "braid_diameter"),
    "thread": ("thread_length", "turns"),
    "rhombus": ("rhombus",),
}


@dataclass(frozen=True, slots=True)
class StatedMuscle:
    """A muscle as stated by the caller; values in SI, None where not stated."""

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
class PresetFacts:
    """Values of a muscle preset, in SI.

    Attributes:
        id: id of the preset.
        muscle: geometry at rest.
        effects: the effects of the preset with all their parameters.
        limits: limits stated by the maker.
        tolerance: geometry field -> largest change by a fit, in either direction.
        shortest, longest: range of rest lengths that the maker sells, None where not known [m].
        unverified: paths in the preset of the unverified values that the model uses, "effects.ID.force".
        suspended_mass: largest mass that may hang freely on the muscle, None where not known [kg].
        coldest, hottest: ambient temperatures it is made for, None where not known [K].
        fit: how its values were fitted to measurements, None where they were not.
        stretched: how far the force is off its source where the muscle is stretched, None if it is fitted.
    """

    id: str
    muscle: Muscle
    effects: EffectValues
    limits: MuscleLimits
    tolerance: dict[str, float]
    shortest: float | None
    longest: float | None
    unverified: tuple[str, ...]
    suspended_mass: float | None = None
    coldest: float | None = None
    hottest: float | None = None
    fit: FitRecord | None = None
    stretched: str | None = None


@dataclass(frozen=True, slots=True)
class StartModel:
    """A complete muscle with the effects of its model.

    Attributes:
        muscle: geometry at rest.
        effects: effect id -> every parameter of it, SI.
        preset: facts of the preset it is based on.
        rhombus: the lattice, if the caller gave the geometry in this form.
        catalogue: the known effects, and the custom effect of the model if it has one.
        term: text of the custom term.
        assumed: fields of the muscle that an effect needs and that are not stated; they hold a typical value.
        fitted: how muscle and effects were fitted, where something else than the preset says so.
        stated: of a saved model, what was stated for geometry that its data corrected [SI].
    """

    muscle: Muscle
    effects: Mapping[str, Mapping[str, float]]
    preset: PresetFacts | None = None
    rhombus: Rhombus | None = None
    catalogue: Mapping[str, Effect] = field(default_factory=dict)
    term: str | None = None
    assumed: tuple[str, ...] = ()
    fitted: FitRecord | None = None
    stated: Mapping[str, float] = field(default_factory=dict)

    @property
    def corrected_length(self) -> float | None:
        """The rest length that was stated for data that showed another one [m]; None without such data.

        Those of a saved model or of a preset; other effects than theirs change nothing of it.
        """
        if self.stated or self.preset is None or self.preset.fit is None:
            return self.stated.get("nominal_length")
        own = self.preset.muscle._replace(nominal_length=self.muscle.nominal_length)
        return self.preset.fit.stated.get("nominal_length") if self.muscle == own else None

    @property
    def fit(self) -> FitRecord | None:
        """How the values were fitted to measurements; None where they were not, or were changed since.

        Another length is no change: what was measured says whether the model may be used at it.
        """
        preset = self.preset
        if self.fitted is not None or preset is None or preset.fit is None:
            return self.fitted
        own = preset.muscle._replace(nominal_length=self.muscle.nominal_length)
        return preset.fit if (self.muscle, self.effects) == (own, preset.effects) else None

    @property
    def limits(self) -> MuscleLimits:
        """Limits stated by the maker; none for a muscle stated by its geometry."""
        return MuscleLimits() if self.preset is None else self.preset.limits


def preset_facts(preset: MusclePreset, catalogue: EffectCatalogue) -> PresetFacts:
    """The preset in SI, with the defaults of its effects filled in."""
    geometry, limits = preset.geometry, preset.limits
    wall = geometry.wall_thickness
    muscle = Muscle(
        nominal_length=geometry.nominal_length.si("m"),
        braid_diameter=geometry.braid_diameter.si("m"),
        braid_angle=geometry.braid_angle.si("rad"),
        wall_thickness=0.0 if wall is None else wall.si("m"),
        inside_diameter=geometry.inside_diameter.si("m"),
    )
    size = muscle.size
    return PresetFacts(
        id=preset.id,
        muscle=muscle,
        effects={
            name: catalogue[name].defaults_of(size) | values
            for name, values in preset.effect_values().items()
        },
        limits=MuscleLimits(
            max_pressure=_optional(limits.max_pressure, "Pa"),
            max_force=_optional(limits.max_force, "N"),
            max_contraction=_optional(limits.max_contraction, "1"),
            max_pretension=_optional(limits.max_pretension, "1"),
        ),
        tolerance={
            name: width.si("rad" if name == "braid_angle" else "m")
            for name in GEOMETRY
            if (width := getattr(preset.tolerance, name, None)) is not None
        },
        shortest=_optional(limits.min_nominal_length, "m"),
        longest=_optional(limits.max_nominal_length, "m"),
        unverified=tuple(
            path
            for path, quantity in quantities(preset)
            if path.startswith(_MODEL_PARTS) and not quantity.verified
        ),
        suspended_mass=_optional(preset.data.get("max_suspended_mass"), "kg"),
        coldest=_optional(preset.data.get("min_temperature"), "K"),
        hottest=_optional(preset.data.get("max_temperature"), "K"),
        fit=preset.fit,
        stretched=preset.stretched,
    )


def _optional(quantity: Quantity | None, unit: str) -> float | None:
    return None if quantity is None else quantity.si(unit)


def start_model(
    stated: StatedMuscle,
    effects: Mapping[str, Mapping[str, float | str]] | None,
    *,
    preset: PresetFacts | None,
    catalogue: EffectCatalogue,
) -> StartModel:
    """The muscle and effects described by a request.

    Args:
        stated: the muscle; fields stated with a preset override its values.
        effects: effect id -> parameters (SI numbers or texts with units); {} is the ideal model, None the
            effects of the preset, or the ideal model without a preset.
        preset: facts of the preset that ``stated`` names.
        catalogue: the known effects.

    Raises:
        InputError: no geometry, an incomplete one or more than one form, an unknown effect or parameter, or a
            value with a wrong unit. Bounds are checked by the model.
    """
    muscle = _muscle(stated, None if preset is None else preset.muscle)
    if effects is None:
        preset_effects = {} if preset is None else preset.effects
        return _complete_model(StartModel(muscle, preset_effects, preset, stated.rhombus, catalogue), stated)
    known: Mapping[str, Effect] = catalogue
    term = None
    if CUSTOM in effects and CUSTOM not in catalogue:
        effect, term = typed_effect(effects[CUSTOM])
        known = {**catalogue, CUSTOM: effect}
        effects = {name: values if name != CUSTOM else effect.defaults for name, values in effects.items()}
    size = muscle.size
    chosen = {name: _effect_values(name, values, known, size) for name, values in effects.items()}
    return _complete_model(StartModel(muscle, chosen, preset, stated.rhombus, known, term), stated)


def _complete_model(start: StartModel, stated: StatedMuscle) -> StartModel:
    """The model with typical values in the fields that its effects need and that are not stated.

    A stated 0 is kept, and the model rejects it.
    """
    needed = dict.fromkeys(field for name in start.effects for field in start.catalogue[name].needs)
    assumed = tuple(name for name in needed if getattr(start.muscle, name) == 0.0 and not _has(stated, name))
    if not assumed:
        return start
    return replace(start, muscle=start.muscle.assuming(assumed), assumed=assumed)


def _muscle(stated: StatedMuscle, base: Muscle | None) -> Muscle:
    forms = [form for form, marks in _MARKS.items() if any(_has(stated, mark) for mark in marks)]
    if len(forms) > 1:
        raise InputError(
            f"the muscle is given in {len(forms)} forms at once: {' and '.join(forms)}",
            field=f"muscle.{_first_stated(stated, _MARKS[forms[1]])}",
            hint="give braid_angle with a diameter, or thread_length with turns, or rhombus",
        )
    form = forms[0] if forms else "diameter and angle"
    length = stated.nominal_length if stated.nominal_length is not None else base and base.nominal_length
    if length is None:
        raise InputError(
            "the muscle has no length", field="muscle.nominal_length", hint='e.g. "nominal_length": "300 mm"'
        )
    if form == "diameter and angle":
        return _by_diameter(stated, base, length)
    return _by_thread(stated, base, length)


def _first_stated(stated: StatedMuscle, names: tuple[str, ...]) -> str:
    return next(name for name in names if _has(stated, name))


def _has(stated: StatedMuscle, name: str) -> bool:
    return getattr(stated, name) is not None


def _by_diameter(stated: StatedMuscle, base: Muscle | None, length: float) -> Muscle:
    """The muscle from the braid diameter at the braid angle; without it from the bore."""
    if base is None:
        wall = stated.wall_thickness or 0.0
        bore = stated.inside_diameter
        braid = stated.braid_diameter if stated.braid_diameter is not None else bore
        if stated.braid_angle is None:
            raise InputError(
                "the muscle has no geometry" if braid is None else "the muscle has no braid angle",
                field="muscle" if braid is None else "muscle.braid_angle",
                hint="give a preset, or braid_angle with a diameter, or thread_length with turns, or rhombus",
            )
        if braid is None:
            raise InputError(
                "the muscle has a braid angle but no diameter",
                field="muscle.inside_diameter",
                hint='e.g. "inside_diameter": "20 mm"',
            )
        return Muscle(length, braid, stated.braid_angle, wall, bore if bore is not None else braid - wall)
    wall = base.wall_thickness if stated.wall_thickness is None else stated.wall_thickness
    bore = base.inside_diameter if stated.inside_diameter is None else stated.inside_diameter
    # A wider bore or a thicker wall increases the braid diameter.
    follows = base.braid_diameter + (bore - base.inside_diameter) + (wall - base.wall_thickness)
    braid = follows if stated.braid_diameter is None else stated.braid_diameter
    angle = base.braid_angle if stated.braid_angle is None else stated.braid_angle
    return Muscle(length, braid, angle, wall, bore)


def _by_thread(stated: StatedMuscle, base: Muscle | None, length: float) -> Muscle:
    if stated.rhombus is not None:
        braid = braid_from_rhombus(**stated.rhombus._asdict())
    else:
        for name, other in (("thread_length", "turns"), ("turns", "thread_length")):
            if getattr(stated, name) is None:
                raise InputError(
                    f"{other} is given without {name}",
                    field=f"muscle.{name}",
                    hint="the thread form needs thread_length, turns and nominal_length",
                )
        braid = Braid(stated.thread_length, stated.turns)
    try:
        diameter, angle = rest_diameter_and_angle(braid=braid, length=length)
    except InputError as error:
        raise error.inside("muscle") from error
    wall = stated.wall_thickness
    if wall is None:
        wall = base.wall_thickness if base is not None else 0.0
    bore = stated.inside_diameter if stated.inside_diameter is not None else max(diameter - wall, 0.0)
    return Muscle(length, diameter, angle, wall, bore)


def _effect_values(
    effect_id: str, stated: Mapping[str, float | str], catalogue: Mapping[str, Effect], size: MuscleSize
) -> dict[str, float]:
    """Every parameter of an effect in SI: the stated ones, defaults for this muscle for the rest."""
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
    values = effect.defaults_of(size)
    for name, value in stated.items():
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
            raise error.at(field) from error
    return values


def stated_muscle(muscle: MuscleInput) -> StatedMuscle:
    """The muscle of a request as a plain object."""
    lattice = muscle.rhombus
    return StatedMuscle(
        preset=muscle.preset,
        nominal_length=muscle.nominal_length,
        inside_diameter=muscle.inside_diameter,
        braid_diameter=muscle.braid_diameter,
        braid_angle=muscle.braid_angle,
        wall_thickness=muscle.wall_thickness,
        thread_length=muscle.thread_length,
        turns=muscle.turns,
        rhombus=None if lattice is None else Rhombus(lattice.side, lattice.along, lattice.around),
    )
