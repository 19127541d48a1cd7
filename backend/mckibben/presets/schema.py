"""The kinds of presets as pydantic models, one class per kind."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import Field, PrivateAttr

from mckibben.facts.run import curve_fit_of
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import Muscle
from mckibben.physics.parameter import UNKNOWN_SIZE, UNVERIFIED_GRADES, MuscleSize, Parameter
from mckibben.presets.fit import FitRecord
from mckibben.presets.quantity import (
    GRADES_IN_WORDS,
    Expected,
    Finding,
    Grade,
    Note,
    PresetModel,
    Quantity,
    Text,
    quantities,
    quantity_findings,
    range_findings,
    si_unit,
)

#: Effect id -> its parameters: their names, or each one's `Parameter` (then unit and bounds are checked).
EffectTable = Mapping[str, Collection[str] | Mapping[str, Parameter]]

Origin = Literal["built-in", "user"]
PresetId = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$")]
Key = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,63}$")]
FigureName = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_.]{0,127}$")]
Share = Annotated[float, Field(gt=0.0, le=1.0)]


class Preset(PresetModel):
    """Fields and methods of all presets."""

    schema_version: Literal[1] = Field(alias="schema", description="Version of the document.")
    kind: Any = Field(
        description="What kind of preset it is."
    )  # each kind of preset narrows it to its own word
    id: PresetId = Field(description="Its id; for the user's own, also the name of its file.")
    title: Annotated[str, Field(min_length=1, max_length=120, pattern=r"\S")] = Field(
        description="Its name for display."
    )
    maker: Annotated[str, Field(max_length=120)] = Field(
        "", description="Who makes the part; empty where nobody does."
    )
    description: Annotated[str, Field(max_length=2000)] = Field(
        "", description="What it is, in a few sentences."
    )
    references: list[Text] = Field(default_factory=list, description="Sources for further reading.")
    misprints: list[Text] = Field(
        default_factory=list, description="What its source prints there and cannot be right, with what is."
    )

    _origin: Origin = PrivateAttr(default="built-in")

    @property
    def origin(self) -> Origin:
        """Whether the preset came with the program or was saved by the user."""
        return self._origin

    def adopt(self, origin: Origin, effects: EffectTable | None) -> None:
        """Set the origin of the preset; called once by the library that loads it."""
        self._origin = origin

    @property
    def heading(self) -> str:
        """The title as lists show it."""
        return self.title

    @property
    def verified(self) -> bool:
        """Whether no value of the preset is general knowledge (M) or an estimate (E)."""
        return all(quantity.verified for _, quantity in quantities(self))

    def to_document(self) -> dict[str, Any]:
        """The preset as the JSON document of its file; absent optional values are left out."""
        return self.model_dump(mode="json", by_alias=True, exclude_none=True)

    def public(self) -> dict[str, Any]:
        """The document as the API shows it: with ``verified``, ``origin`` and the heading as its title."""
        return {**self.to_document(), "title": self.heading, "verified": self.verified, "origin": self.origin}

    def findings(self, effects: EffectTable | None = None) -> Iterator[Finding]:
        """Errors that the types cannot catch: units, ranges, column lengths, effects."""
        for path, quantity in quantities(self):
            if not path.startswith("effects."):
                yield from quantity_findings(path, quantity)


class Geometry(PresetModel):
    """The muscle at rest; an unknown wall thickness is left out."""

    inside_diameter: Quantity = Field(description="Bore.")
    braid_diameter: Quantity = Field(description="Diameter of the braid at the braid angle.")
    braid_angle: Quantity = Field(description="Angle between thread and axis.")
    nominal_length: Quantity = Field(description="Length between the fittings.")
    wall_thickness: Quantity | None = Field(default=None, description="Wall of the bladder.")


class Tolerance(PresetModel):
    """How far (+-) a fit may change a geometry value."""

    braid_angle: Quantity | None = Field(default=None, description="Of the braid angle.")
    braid_diameter: Quantity | None = Field(default=None, description="Of the braid diameter.")
    nominal_length: Quantity | None = Field(default=None, description="Of the length between the fittings.")
    wall_thickness: Quantity | None = Field(default=None, description="Of the wall of the bladder.")


class Limits(PresetModel):
    """Limits stated by the maker; unknown ones are left out."""

    max_pressure: Quantity | None = Field(default=None, description="Highest gauge pressure.")
    max_force: Quantity | None = Field(default=None, description="Highest force.")
    max_contraction: Quantity | None = Field(
        default=None, description="Highest contraction, share of the rest length."
    )
    max_pretension: Quantity | None = Field(
        default=None, description="Highest stretch beyond the rest length, share of it."
    )
    min_nominal_length: Quantity | None = Field(default=None, description="Shortest muscle that is made.")
    max_nominal_length: Quantity | None = Field(default=None, description="Longest muscle that is made.")


class _WithEffects(Preset):
    """A part with default effects in its model."""

    effects: dict[Key, dict[Key, Quantity]] = Field(
        default_factory=dict,
        description="Effect id -> parameter -> value: the effects that the model has by default.",
    )

    _parameter_units: dict[str, dict[str, str]] = PrivateAttr(default_factory=dict)

    def adopt(self, origin: Origin, effects: EffectTable | None) -> None:
        """Also stores the SI units that the effects declare for their parameters."""
        super().adopt(origin, effects)
        self._parameter_units = {
            name: {key: item.unit for key, item in table.items()}
            for name, table in (effects or {}).items()
            if isinstance(table, Mapping)
        }

    def effect_values(self) -> dict[str, dict[str, float]]:
        """Default effects as {effect id: {parameter: value in SI}}."""
        return {
            name: {
                key: quantity.si(self._effect_unit(name, key, quantity)) for key, quantity in table.items()
            }
            for name, table in self.effects.items()
        }

    def _effect_unit(self, effect: str, parameter: str, quantity: Quantity) -> str:
        unit = self._parameter_units.get(effect, {}).get(parameter) or si_unit(quantity.unit)
        if unit is None:
            raise InputError(
                f"'{quantity.unit}' is not a known unit", field=f"effects.{effect}.{parameter}.unit"
            )
        return unit

    def findings(self, effects: EffectTable | None = None) -> Iterator[Finding]:
        """Adds: effects and their parameters exist, with the right unit and inside their bounds."""
        yield from super().findings(effects)
        for name, table in self.effects.items():
            if effects is not None and name not in effects:
                yield Finding(f"effects.{name}", f"there is no effect '{name}'", did_you_mean(name, effects))
                continue
            for key, quantity in table.items():
                known = None if effects is None else effects[name]
                yield from _parameter_findings(f"effects.{name}.{key}", key, quantity, known, self._size())

    def _size(self) -> MuscleSize:
        """Of the muscle; not known of another part."""
        return UNKNOWN_SIZE


class MusclePreset(_WithEffects):
    """A muscle: geometry, limits, catalogue data and the effects its model has by default.

    Attributes:
        extrapolated: why its force is not known from a curve or a measurement; None when it is. Sizing ranks
            such a muscle behind all others.
    """

    kind: Literal["muscle"] = Field(description="Says that it is a muscle.")
    series: Annotated[str, Field(max_length=60)] = Field(default="", description="Series of the maker.")
    geometry: Geometry = Field(description="The muscle at rest.")
    tolerance: Tolerance = Field(default=Tolerance(), description="How far a fit may change the geometry.")
    limits: Limits = Field(default=Limits(), description="Limits stated by the maker.")
    data: dict[Key, Quantity] = Field(default_factory=dict, description="Further catalogue data, by name.")
    reference_curve: PresetId | None = Field(default=None, description="Id of a curve preset of the maker.")
    measurement: PresetId | None = Field(
        default=None, description="Id of a measurement preset of this muscle."
    )
    extrapolated: Text | None = Field(
        default=None, description="Why its force is not known from a curve or a measurement; null when it is."
    )
    stretched: Text | None = Field(
        default=None,
        description="How far its force is off its source where the muscle is longer than at rest; null where "
        "it was fitted there, or nothing is known.",
    )
    fit: FitRecord | None = Field(
        default=None,
        description="How its values were fitted to measurements; null where they were not. With it, answers "
        "have intervals and say where the muscle was not measured.",
    )

    def _size(self) -> MuscleSize:
        geometry = self.geometry
        stated = (geometry.nominal_length, "m"), (geometry.braid_diameter, "m"), (geometry.braid_angle, "rad")
        if any(si_unit(quantity.unit) != unit for quantity, unit in stated):
            return UNKNOWN_SIZE  # which is found elsewhere
        return Muscle(*(quantity.si(unit) for quantity, unit in stated)).size

    def findings(self, effects: EffectTable | None = None) -> Iterator[Finding]:
        """Adds: the braid is wider than the bore."""
        inherited = list(super().findings(effects))
        yield from inherited
        geometry = self.geometry
        unusable = any((item.field or "").startswith("geometry.") for item in inherited)
        if not unusable and geometry.braid_diameter.si("m") < geometry.inside_diameter.si("m"):
            yield Finding(
                "geometry.braid_diameter.value", "the braid is narrower than the bore", "bore + wall"
            )


def _parameter_findings(
    path: str,
    key: str,
    quantity: Quantity,
    known: Collection[str] | Mapping[str, Parameter] | None,
    size: MuscleSize,
) -> Iterator[Finding]:
    if known is not None and key not in known:
        yield Finding(path, f"the effect has no parameter '{key}'", did_you_mean(key, known))
    elif isinstance(known, Mapping):
        declared = known[key]
        bounds = declared.allowed(size)
        yield from range_findings(path, quantity, Expected(declared.unit, *bounds))
    elif si_unit(quantity.unit) is None:
        yield Finding(f"{path}.unit", f"'{quantity.unit}' is not a known unit", "e.g. 'MPa'")


class _Part(_WithEffects):
    data: dict[Key, Quantity] = Field(default_factory=dict, description="Catalogue data, by name.")


class RegulatorPart(PresetModel):
    """Figures of a pressure regulator."""

    range: Quantity = Field(description="Gauge pressure at full command.")
    time: Quantity = Field(description="Time constant with which it follows its set point.")
    damping: Quantity | None = Field(
        default=None, description="Damping ratio of a lag of second order; null: first order."
    )
    band: Quantity | None = Field(
        default=None, description="Pressure error at which an orifice is fully open."
    )
    dead_band: Quantity | None = Field(
        default=None, description="Width of the pressure error in which both orifices are closed."
    )


class ValvePreset(_Part):
    """A valve, or with ``regulator`` a pressure regulator; its conductances are needed to simulate it."""

    kind: Literal["valve"] = Field(description="Says that it is a valve.")
    function: Annotated[str, Field(min_length=1, max_length=120)] = Field(
        description='What it does: "5/3-way proportional valve".'
    )
    regulator: RegulatorPart | None = Field(
        default=None, description="Figures of a pressure regulator; null of a valve."
    )


class TubePreset(_Part):
    """A tube; its conductance is given for ``reference_length``."""

    kind: Literal["tube"] = Field(description="Says that it is a tube.")


class FittingPreset(_Part):
    """A fitting or silencer, with the dead volume of its port."""

    kind: Literal["fitting"] = Field(description="Says that it is a fitting.")


class DesignPreset(Preset):
    """An example document of the Design view; its content is checked when it is used."""

    kind: Literal["design"] = Field(description="Says that it is a design.")
    document: dict[str, Any] = Field(description="Its question, as /api/curves takes it.")
    view: dict[str, Any] = Field(
        default_factory=dict, description="What the Design view shows of the answer, and over what."
    )


class Ground(PresetModel):
    """Source of a value of a drive document."""

    source: Text = Field(description="Where the value comes from, in a few words.")
    grade: Grade = Field(description=GRADES_IN_WORDS)
    note: Note | None = Field(default=None, description="Remark on the value.")


class PaperFigures(PresetModel):
    """Published figures of a drive.

    Attributes:
        figure: number of the figure.
        figures: "extend.rise_time" -> value; names of the timing table, or explained in the description.
        tolerance: permitted relative deviation of a figure, by the same names.
        excluded: reason why a figure is not compared, by the same names.
    """

    figure: Text = Field(description="Number of the figure.")
    figures: dict[FigureName, Quantity] = Field(
        default_factory=dict,
        description="Figure of the timing table, as extend.rise_time -> published value.",
    )
    tolerance: dict[FigureName, Share] = Field(
        default_factory=dict, description="Permitted relative deviation of a figure, by the same names."
    )
    excluded: dict[FigureName, Text] = Field(
        default_factory=dict, description="Why a figure is not compared, by the same names."
    )


class _DocumentPreset(Preset):
    """An example document of the API; its content is checked when it is used.

    Attributes:
        grounds: sources of its values, by their path in the document.
    """

    document: dict[str, Any] = Field(description="The document to start from.")
    grounds: dict[FigureName, Ground] = Field(
        default_factory=dict, description="Path in the document -> source of the value."
    )

    @property
    def verified(self) -> bool:
        """Whether no value of the document is general knowledge (M) or an estimate (E)."""
        return super().verified and all(
            ground.grade not in UNVERIFIED_GRADES for ground in self.grounds.values()
        )


class DrivePreset(_DocumentPreset):
    """A drive document to start from; its content is checked when it is used."""

    kind: Literal["drive"] = Field(description="Says that it is a drive.")
    paper: PaperFigures | None = Field(
        default=None, description="Published figures of the drive; null where there are none."
    )

    @property
    def heading(self) -> str:
        """The title; that of a curve fit says that it is one."""
        of = self.document.get("curve_fit")
        return f"{self.title} ({curve_fit_of(of)})" if of else self.title


class TaskPreset(_DocumentPreset):
    """A sizing task to start from; its content is checked when it is used."""

    kind: Literal["task"] = Field(description="Says that it is a sizing task.")
