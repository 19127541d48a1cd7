"""Mysteries as JSON, and a diagnosis held against what is hidden."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from mckibben.application.start import Json
from mckibben.presets import MysteryPreset, PresetLibrary


def mysteries_answer(library: PresetLibrary) -> list[Json]:
    """All mysteries without their answers."""
    return [_told(cast(MysteryPreset, preset)) for preset in library.list("mysteries")]


def _told(preset: MysteryPreset) -> Json:
    return {
        "id": preset.id,
        "title": preset.title,
        "story": preset.story,
        "kind": preset.measurement_kind,
        "muscle": preset.muscle,
        "drive": preset.drive,
        "effects": preset.effects,
        "measurement": preset.id,
    }


def reveal_answer(library: PresetLibrary, mystery_id: str, given: Sequence[str]) -> Json:
    """What is hidden, and which of it is among the given effects.

    Raises:
        InputError: code ``not_found``, there is no such mystery.
    """
    preset = cast(MysteryPreset, library.get("mysteries", mystery_id))
    sealed = preset.answer()
    # What the start model has was no discovery.
    named = [effect for effect in dict.fromkeys(given) if effect not in preset.effects]
    taken = matched(named, [hidden.effects for hidden in sealed.hidden])
    return {
        "hidden": [hidden.model_dump() for hidden in sealed.hidden],
        "found": [name is not None for name in taken],
        "surplus": [name for name in named if name not in taken],
        "text": sealed.text,
    }


def matched(named: Sequence[str], accepted: Sequence[Sequence[str]]) -> list[str | None]:
    """For each hidden effect the given one that stands for it; as many as can be, each given one once."""
    by_name: dict[str, int] = {}

    def place(hidden: int, tried: set[str]) -> bool:
        for name in named:
            if name in accepted[hidden] and name not in tried:
                tried.add(name)
                if name not in by_name or place(by_name[name], tried):
                    by_name[name] = hidden
                    return True
        return False

    for hidden in range(len(accepted)):
        place(hidden, set())
    of_hidden = {hidden: name for name, hidden in by_name.items()}
    return [of_hidden.get(hidden) for hidden in range(len(accepted))]
