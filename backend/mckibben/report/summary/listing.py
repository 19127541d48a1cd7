"""Summaries of what there is: presets, effects, examples."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mckibben.application.listing import EffectCard, ExampleCard, PresetCard
from mckibben.report.summary import Summary, Table


def presets_summary(kinds: Mapping[str, Iterable[PresetCard]]) -> Summary:
    """One table for each kind."""
    return [
        Table(
            kind.capitalize(),
            ["id", "title", "maker"],
            [[card.id, card.title, card.maker] for card in cards],
        )
        for kind, cards in kinds.items()
    ]


def effects_summary(cards: Iterable[EffectCard]) -> Summary:
    """All effects in one table."""
    rows = [[card.id, card.title, card.family, card.type] for card in cards]
    return [Table("Effects", ["id", "title", "family", "type"], rows)]


def effect_summary(card: EffectCard) -> Summary:
    """One effect: cause, law, parameters, what it is confused with."""
    parameters = [
        [
            name, p.unit, f"{p.default:g}", f"{p.lower:g}", f"{p.upper:g}",
            f"{p.source.text} ({p.source.grade})",
        ]
        for name, p in card.parameters.items()
    ]  # fmt: skip
    twins = [[name, separated_by] for name, separated_by in card.confused_with.items()]
    return [
        Table(
            f"{card.title} ({card.id})", ["parameter", "unit", "default", "from", "to", "source"], parameters
        ),
        *([Table("Confused with", ["effect", "separated by"], twins)] if twins else []),
        card.cause,
        f"law (LaTeX): {card.equation}",
        f"shows in: {', '.join(sorted(card.kinds))}",
    ]


def examples_summary(cards: Iterable[ExampleCard]) -> Summary:
    """The examples, each with the command that uses it."""
    return [Table("Examples", ["name", "what it is", "try"], [[c.name, c.title, c.tried_by] for c in cards])]
