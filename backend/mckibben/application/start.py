"""Parts of several answers: the muscle at rest, what is known of it, flags."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from mckibben.documents.start_model import StartModel
from mckibben.physics.muscle import Muscle, assumption
from mckibben.simulation.statics.limits import LimitFlag

Json = dict[str, Any]


def flag(code: str, message: str, field: str | None = None) -> Json:
    """A flag as JSON."""
    return {"code": code, "message": message, "field": field}


def flags_json(flags: Iterable[LimitFlag]) -> list[Json]:
    """Flags of the simulation as JSON, each once."""
    unique = {(str(item.code), item.message): item for item in flags}
    return [flag(str(item.code), item.message, item.field) for item in unique.values()]


def geometry_json(start: StartModel) -> Json:
    """The muscle at rest in all its forms."""
    muscle: Muscle = start.muscle
    lattice = start.rhombus
    return {
        "braid_diameter": muscle.braid_diameter,
        "braid_angle": muscle.braid_angle,
        "nominal_length": muscle.nominal_length,
        "inside_diameter": muscle.inside_diameter,
        "wall_thickness": muscle.wall_thickness,
        "thread_length": muscle.braid.thread_length,
        "turns": muscle.braid.turns,
        "rhombus": None if lattice is None else lattice._asdict(),
    }


def start_flags(start: StartModel) -> list[Json]:
    """What to know about the muscle itself: figures nobody verified, a length the maker does not sell."""
    preset = start.preset
    found = [flag("assumed", assumption(start.muscle, name), f"muscle.{name}") for name in start.assumed]
    if preset is None:
        return found
    if preset.unverified:
        why = "from general knowledge or estimated, not read in a source"
        found.append(
            flag("unverified", f"{preset.id}: {', '.join(preset.unverified)} {why}", "muscle.preset")
        )
    length, bound, word = start.muscle.nominal_length, None, ""
    if preset.shortest is not None and length < preset.shortest * (1.0 - 1e-9):
        bound, word = preset.shortest, "shorter"
    if preset.longest is not None and length > preset.longest * (1.0 + 1e-9):
        bound, word = preset.longest, "longer"
    if bound is not None:
        found.append(
            flag(
                "length_outside_range",
                f"{length * 1e3:.4g} mm is {word} than the {bound * 1e3:.4g} mm {preset.id} is made in",
                "muscle.nominal_length",
            )
        )
    return found
