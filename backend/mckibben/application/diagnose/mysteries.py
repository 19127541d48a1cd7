"""Mysteries: measurements with hidden effects, and the check of an answer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

from mckibben.documents.json_document import JsonDocument
from mckibben.facts.result import result_class
from mckibben.presets import MysteryPreset, PresetLibrary


@result_class
class MysterySummary:
    """A mystery without its answer: story, kind, start model, id of its measurement."""

    id: str
    """Its id."""
    title: str
    """Its name."""
    story: str
    """The situation, as an engineer would describe it."""
    kind: str
    """Measurement kind."""
    muscle: JsonDocument
    """In the form of a comparison request."""
    drive: JsonDocument | None
    """In the form of a comparison request; None if not needed."""
    effects: Mapping[str, Mapping[str, float | str]]
    """The start model."""
    measurement: str
    """Id of the measurement for comparisons and diagnoses."""


@result_class
class HiddenTruth:
    """A hidden effect: its name, its action, and the ids of the effects accepted as the answer."""

    title: str
    """What is hidden, in a few words."""
    what: str
    """What it does, and how it shows in the data."""
    effects: tuple[str, ...]
    """Effect ids accepted as right answers."""


@result_class
class Reveal:
    """The hidden effects, which of them were named, wrongly named effects, and the explanation."""

    hidden: list[HiddenTruth]
    """The hidden effects; none if the start model explains the data."""
    found: list[bool]
    """For each hidden effect: whether the user named it."""
    surplus: list[str]
    """Effects of the user that are neither hidden nor of the start model."""
    text: str
    """The solution in words."""


def mysteries(library: PresetLibrary) -> list[MysterySummary]:
    """All mysteries without their answers."""
    return [_summary(cast(MysteryPreset, preset)) for preset in library.list("mysteries")]


def _summary(preset: MysteryPreset) -> MysterySummary:
    return MysterySummary(
        id=preset.id,
        title=preset.title,
        story=preset.story,
        kind=preset.measurement_kind,
        muscle=JsonDocument(preset.muscle),
        drive=None if preset.drive is None else JsonDocument(preset.drive),
        effects=preset.effects,
        measurement=preset.id,
    )


def reveal(library: PresetLibrary, mystery_id: str, named_effects: Sequence[str]) -> Reveal:
    """The hidden effects, and which of them are among the named ones.

    Raises:
        InputError: code ``not_found``, unknown mystery.
    """
    preset = cast(MysteryPreset, library.get("mysteries", mystery_id))
    sealed = preset.answer()
    # Effects of the start model do not count as an answer.
    named = [effect for effect in dict.fromkeys(named_effects) if effect not in preset.effects]
    matches = matched(named, [hidden.effects for hidden in sealed.hidden])
    return Reveal(
        hidden=[HiddenTruth(hidden.title, hidden.what, tuple(hidden.effects)) for hidden in sealed.hidden],
        found=[name is not None for name in matches],
        surplus=[name for name in named if name not in matches],
        text=sealed.text,
    )


def matched(named: Sequence[str], accepted: Sequence[Sequence[str]]) -> list[str | None]:
    """The named effect matched to each hidden one: a maximum matching, each name at most once."""
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
