"""What there is: presets and effects, as mappings from id to a card."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Generic, TypeVar

from mckibben.application.listing import EffectCard, PresetCard, effect_cards, preset_cards
from mckibben.door.frames import frame_of_rows
from mckibben.door.problem import reported
from mckibben.door.rendering import notebook_cell, plain_text
from mckibben.door.workspace import studio
from mckibben.report.summary import Summary, Table

if TYPE_CHECKING:
    import pandas as pd


CardT = TypeVar("CardT", PresetCard, EffectCard)


class Listing(Mapping[str, CardT], Generic[CardT]):
    """Cards by their ids, in order; prints as a table."""

    def __init__(self, title: str, cards: Mapping[str, CardT], shown: tuple[str, ...]) -> None:
        self._title = title
        self._cards = dict(cards)
        self._shown = shown

    def __getitem__(self, id: str) -> CardT:
        return self._cards[id]

    def __iter__(self) -> Iterator[str]:
        return iter(self._cards)

    def __len__(self) -> int:
        return len(self._cards)

    def to_frame(self) -> pd.DataFrame:
        """One row for each card."""
        return frame_of_rows(
            self._shown, [[getattr(card, name) for name in self._shown] for card in self._cards.values()]
        )

    def _summary(self) -> Summary:
        rows = [[str(getattr(card, name)) for name in self._shown] for card in self._cards.values()]
        return [Table(self._title, list(self._shown), rows)]

    def __str__(self) -> str:
        return plain_text(self._summary())

    def __repr__(self) -> str:
        return f"<{self._title}: {', '.join(self._cards)}>"

    def _repr_html_(self) -> str:
        return notebook_cell(self._title, (), self._summary())


@reported
def presets(kind: str | None = None) -> Listing[PresetCard]:
    """The presets of a kind, or all.

    Args:
        kind: muscles, valves, tubes, fittings, curves, measurements, designs, drives, tasks or mysteries;
            None for all of them, by "kind/id".

    Raises:
        Problem: there is no such kind, with the nearest match.
    """
    library = studio().library
    if kind is not None:
        return Listing(kind.capitalize(), preset_cards(studio(), kind), ("id", "title", "maker", "verified"))
    cards = {
        f"{each}/{id}": card for each in library.kinds for id, card in preset_cards(studio(), each).items()
    }
    return Listing("Presets", cards, ("kind", "id", "title"))


@reported
def effects() -> Listing[EffectCard]:
    """The physical effects, with equation, parameters and what they are confused with."""
    return Listing("Effects", effect_cards(studio()), ("id", "title", "family", "type"))
