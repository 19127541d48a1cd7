"""Part of every result: geometry of the muscle at rest, and notices about it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from mckibben.documents.start_model import StartModel
from mckibben.documents.value_names import value_names
from mckibben.facts.muscle import GEOMETRY, LIMITS
from mckibben.facts.result import result_class
from mckibben.facts.run import curve_fit_of
from mckibben.physics.braid import rhombus_of
from mckibben.physics.muscle import Muscle, assumption
from mckibben.simulation.statics.limits import LimitFlag

_USUAL_SIDE = 2e-3  # of the lattice of a braid that was not stated as one [m]
_STRETCH = 1e-3  # share of the rest length beyond which a muscle is called stretched


@result_class
class Notice:
    """Something the user should know about a result."""

    code: str
    """Kind of notice, e.g. "over_force_limit", "unverified", "assumed"."""
    message: str
    """Explanation for the user."""
    field: str | None = None
    """The input that it refers to, e.g. "muscle.preset"."""

    def __str__(self) -> str:
        return self.message


@result_class
class MakerLimits:
    """Limits stated by the maker; None where not known."""

    FIGURES: ClassVar = LIMITS.name

    max_pressure: float | None
    max_force: float | None
    max_contraction: float | None
    max_pretension: float | None


@result_class
class Lattice:
    """The braid as a lattice of rhombi: side [m], number along and around the muscle.

    A braid is a lattice of any side: it is the stated one, 2 mm where none was stated.
    """

    FIGURES: ClassVar = GEOMETRY.name

    side: float
    along: float
    around: float


@result_class
class GeometrySummary:
    """Geometry of the muscle at rest."""

    FIGURES: ClassVar = GEOMETRY.name

    braid_diameter: float
    braid_angle: float
    nominal_length: float
    inside_diameter: float
    wall_thickness: float
    thread_length: float
    turns: float
    rhombus: Lattice
    """The same braid as a lattice."""


def geometry_of(start: StartModel, muscle: Muscle | None = None) -> GeometrySummary:
    """The geometry of a start model, or of its muscle after a fit, in all forms."""
    of = start.muscle if muscle is None else muscle
    side = _USUAL_SIDE if start.rhombus is None else float(start.rhombus.side)
    return GeometrySummary(
        braid_diameter=of.braid_diameter,
        braid_angle=of.braid_angle,
        nominal_length=of.nominal_length,
        inside_diameter=of.inside_diameter,
        wall_thickness=of.wall_thickness,
        thread_length=of.braid.thread_length,
        turns=of.braid.turns,
        rhombus=Lattice(**rhombus_of(braid=of.braid, side=side)._asdict()),
    )


def limit_notices(flags: Iterable[LimitFlag]) -> list[Notice]:
    """Exceeded limits, each once."""
    unique = {(str(flag.code), flag.message): flag for flag in flags}
    return [Notice(str(flag.code), flag.message, flag.field) for flag in unique.values()]


def unverified_notice(figures: str, field: str) -> Notice:
    """Notice that these figures of a preset were not read in a source; ``figures``: "PRESET: name, name"."""
    why = "from general knowledge or estimated, not read in a source"
    return Notice("unverified", f"{figures}; {why}", field)


def curve_fit_notices(what: str) -> list[Notice]:
    """Notice that a drive is a curve fit of something; none where it is a drive, ``what`` = ""."""
    if not what:
        return []
    message = f"{curve_fit_of(what)}: its volumes and conductances are those of no parts"
    return [Notice("curve_fit", message)]


def why_not_stretched(start: StartModel) -> str | None:
    """Why the model does not hold where the muscle is stretched; None of a model that is not the preset's."""
    preset = start.preset
    if preset is None or start.fit is not None:
        return None
    # Effects beside them, as of a valve, change nothing of its force.
    is_of_preset = all(start.effects.get(name) == values for name, values in preset.effects.items())
    return preset.stretched if is_of_preset else None


def stretch_notices(start: StartModel, contraction: float, field: str) -> list[Notice]:
    """Notice that a muscle of this least contraction is stretched, where its model was not fitted."""
    why = why_not_stretched(start)
    return [Notice("stretched", why, field)] if why is not None and contraction < -_STRETCH else []


def start_notices(start: StartModel) -> list[Notice]:
    """Notices about the muscle.

    They name assumed fields, unverified values, and a length that the maker does not sell.
    """
    preset = start.preset
    notices = [Notice("assumed", assumption(start.muscle, name), f"muscle.{name}") for name in start.assumed]
    if preset is None:
        return notices
    if preset.unverified:
        names = value_names(preset.unverified, start.catalogue)
        notices.append(unverified_notice(f"{preset.id}: {', '.join(names)}", "muscle.preset"))
    length, bound, word = start.muscle.nominal_length, None, ""
    if preset.shortest is not None and length < preset.shortest * (1.0 - 1e-9):
        bound, word = preset.shortest, "shorter"
    if preset.longest is not None and length > preset.longest * (1.0 + 1e-9):
        bound, word = preset.longest, "longer"
    if bound is not None:
        message = (
            f"{length * 1e3:.4g} mm is {word} than the {bound * 1e3:.4g} mm in which {preset.id} is available"
        )
        notices.append(Notice("length_outside_range", message, "muscle.nominal_length"))
    return notices
