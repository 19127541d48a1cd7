"""A figure that people see, declared once: symbol, unit, label, definition, and when it exists."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from mckibben.facts.units import QUANTITIES, Scale, quantity_of


@dataclass(frozen=True, slots=True)
class Condition:
    """When a figure exists.

    Attributes:
        name: the condition, to be read after "exists when": "the load moves in the phase".
        otherwise: what is said where it does not hold; "" where it always holds. A result may say more, such
            as by how much.
    """

    name: str
    otherwise: str


ALWAYS = Condition("always", "")


@dataclass(frozen=True, slots=True)
class Figure:
    """One figure.

    Attributes:
        name: within its group: "rise_time".
        symbol: as in formulas, "t_r"; "" without one.
        unit: SI unit, "1" of a plain number or share; "" where it depends on what is measured, which the
            result says.
        label: in tables, a noun with what it depends on: "Rise time (10–90 %)".
        definition: one sentence with the formula, what it is measured against, and its limits.
        exists_when: the condition under which it exists.
        quantity: of `mckibben.facts.units.QUANTITIES`, which says how it is shown; "" for that of the unit.
        section: heading inside the table of its group; "" without one.
        default: SI value of an input that is left out; None without one.
        column: name of its column in the file of a run; "" of a figure without one. It is the name of a
            channel only where sign and reference are those of the channel.
        group: set by `Group`.
    """

    name: str
    symbol: str
    unit: str
    label: str
    definition: str
    exists_when: Condition = ALWAYS
    quantity: str = ""
    section: str = ""
    default: float | None = None
    column: str = ""
    group: str = ""

    @property
    def key(self) -> str:
        """Key among all figures: "timing.rise_time"."""
        return f"{self.group}.{self.name}"

    @property
    def words(self) -> str:
        """The label inside a sentence."""
        return f"{self.label[:1].lower()}{self.label[1:]}"

    @property
    def shown_as(self) -> str | None:
        """The quantity that says how it is shown; None where its unit is shown as it is."""
        return self.quantity or (quantity_of(self.unit, self.name) if self.unit else None)

    @property
    def scale(self) -> Scale:
        """The unit of reports and of the terminal."""
        quantity = self.shown_as
        return Scale(self.unit) if quantity is None else QUANTITIES[quantity].scales["bar"]


class Group(Mapping[str, Figure]):
    """Figures of one subject by their names, in the order in which tables show them."""

    __slots__ = ("_figures", "name", "title")

    def __init__(self, name: str, title: str, *figures: Figure) -> None:
        """Figures of a group.

        Raises:
            ValueError: a name occurs twice.
        """
        self.name, self.title = name, title
        named = {figure.name: replace(figure, group=name) for figure in figures}
        if len(named) < len(figures):
            raise ValueError(f"{name}: a figure is declared twice")
        self._figures = MappingProxyType(named)

    def __getitem__(self, name: str) -> Figure:
        return self._figures[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._figures)

    def __len__(self) -> int:
        return len(self._figures)
