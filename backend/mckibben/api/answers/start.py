"""Parts of several answers: the muscle at rest, what is known of it, flags."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from mckibben.muscle_input import StartModel
from mckibben.physics.muscle import Muscle
from mckibben.presets import MusclePreset
from mckibben.presets.quantity import quantities
from mckibben.simulation.limits import Flag

Json = dict[str, Any]


def flag(code: str, message: str, field: str | None = None) -> Json:
    """A flag as JSON."""
    return {"code": code, "message": message, "field": field}


def flags_json(flags: Iterable[Flag]) -> list[Json]:
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
    if preset is None:
        return []
    found = []
    unverified = _unverified(preset)
    if unverified:
        found.append(
            flag(
                "unverified",
                f"{preset.id}: {', '.join(unverified)} {'is' if len(unverified) == 1 else 'are'} from general "
                "knowledge or estimated, not read in a source",
                "muscle.preset",
            )
        )
    length = start.muscle.nominal_length
    for name, beyond in (("min_nominal_length", "shorter"), ("max_nominal_length", "longer")):
        limit = getattr(preset.limits, name)
        if limit is None:
            continue
        bound = limit.si("m")
        if (length < bound * (1.0 - 1e-9)) if beyond == "shorter" else (length > bound * (1.0 + 1e-9)):
            found.append(
                flag(
                    "length_outside_range",
                    f"{length * 1e3:.4g} mm is {beyond} than the {bound * 1e3:.4g} mm {preset.id} is made in",
                    "muscle.nominal_length",
                )
            )
    return found


def _unverified(preset: MusclePreset) -> list[str]:
    """Figures that enter the curves and are not verified, in words."""
    model_parts = ("geometry.", "limits.max_pressure", "limits.max_force", "limits.max_c", "limits.max_pre", "effects.")
    return [
        path.rpartition(".")[2].replace("_", " ")
        for path, quantity in quantities(preset)
        if path.startswith(model_parts) and not quantity.verified
    ]
