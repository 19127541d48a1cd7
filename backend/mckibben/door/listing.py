"""What there is: presets and effects, as mappings from id to a card."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from mckibben.door.frames import frame_of_rows
from mckibben.door.problem import reported
from mckibben.door.rendering import notebook_cell, plain_text
from mckibben.door.workspace import studio
from mckibben.physics.parameter import Parameter
from mckibben.report.summary import Summary, Table

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, slots=True)
class PresetCard:
    """A preset.

    Attributes:
        kind: "muscles", "valves" and the like.
        id, title, maker, description: what it is.
        verified: whether every value was read in a source.
        own: whether it is the user's own.
        document: its file, every value with unit, source and grade.
    """

    kind: str
    id: str
    title: str
    maker: str
    description: str
    verified: bool
    own: bool
    document: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class EffectCard:
    """A physical effect.

    Attributes:
        id, title: what it is.
        family: geometry, elastomer, friction, gas, valve, tube, supply, load or sensor.
        type: static, rate, hysteretic, dynamic or measurement.
        cause: why it exists.
        equation: LaTeX of what it adds or changes.
        parameters: name -> symbol, SI unit, default, bounds, source, description.
        kinds: kinds of measurements that reveal it.
        confused_with: effect -> the experiment that separates it.
    """

    id: str
    title: str
    family: str
    type: str
    cause: str
    equation: str
    parameters: Mapping[str, Parameter]
    kinds: frozenset[str]
    confused_with: Mapping[str, str]


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
        return Listing(kind.capitalize(), _cards(kind), ("id", "title", "maker", "verified"))
    cards = {f"{each}/{id}": card for each in library.kinds for id, card in _cards(each).items()}
    return Listing("Presets", cards, ("kind", "id", "title"))


def _cards(kind: str) -> dict[str, PresetCard]:
    return {
        preset.id: PresetCard(
            kind=kind,
            id=preset.id,
            title=preset.heading,
            maker=preset.maker,
            description=preset.description,
            verified=preset.verified,
            own=preset.origin == "user",
            document=MappingProxyType(preset.to_document()),
        )
        for preset in studio().library.list(kind)
    }


@reported
def effects() -> Listing[EffectCard]:
    """The physical effects, with equation, parameters and what they are confused with."""
    cards = {
        effect.id: EffectCard(
            id=effect.id,
            title=effect.title,
            family=effect.family,
            type=effect.type,
            cause=effect.cause,
            equation=effect.equation,
            parameters=MappingProxyType({p.name: p for p in effect.parameters}),
            kinds=frozenset(effect.kinds),
            confused_with=MappingProxyType({twin.effect: twin.separated_by for twin in effect.confused_with}),
        )
        for effect in studio().catalogue.values()
    }
    return Listing("Effects", cards, ("id", "title", "family", "type"))
