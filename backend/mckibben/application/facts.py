"""The declared figures and units, for whoever shows them."""

from __future__ import annotations

from mckibben.facts.groups import FIGURES
from mckibben.facts.result import result_class
from mckibben.facts.timing import PHASES
from mckibben.facts.units import CERTAIN, NAMES, QUANTITIES, SHIFTED, TYPED, System


@result_class
class DeclaredFigure:
    """One figure that people see."""

    key: str
    """Group and name, such as timing.rise_time."""
    symbol: str
    """Symbol in formulas; empty without one."""
    unit: str
    """SI unit; 1 of a plain number or a share; empty where it depends on what is measured."""
    label: str
    """Label in tables."""
    definition: str
    """What it is, in one sentence with its formula."""
    group: str
    """Name of its group."""
    section: str
    """Heading inside the table of its group; empty without one."""
    exists_when: str
    """The condition under which it exists."""
    otherwise: str
    """What is said where the condition does not hold; empty where it always holds."""
    quantity: str | None
    """Quantity of /api/units that says how it is shown; None for its SI unit."""
    default: float | None
    """SI value of an input that is left out; None without one."""
    column: str
    """Name of its column in the file of a run; empty of a figure without one."""


@result_class
class ShownUnit:
    """A unit in which values are shown."""

    unit: str
    """As it is written; empty of a plain number."""
    factor: float
    """SI value = shown value * factor + offset."""
    digits: int
    """Most decimals of a shown value."""
    offset: float
    """SI value of a shown zero."""
    decibels: bool
    """Whether the shown value is 20 lg of the SI value instead."""


@result_class
class UnitName:
    """A unit of which compound units in documents are made."""

    factor: float
    """Value of the unit, SI."""
    dimension: tuple[int, int, int, int, int]
    """Exponents of m, kg, s, K and rad."""


@result_class
class TypedUnit:
    """A unit that a form takes."""

    quantity: str
    """What it measures."""
    factor: float
    """SI value = typed value * factor + offset."""
    offset: float
    """SI value of a typed zero."""


@result_class
class Units:
    """How quantities are shown, which units are read, and the words that belong to no single figure."""

    scales: dict[str, dict[System, ShownUnit]]
    """Quantity -> unit system -> unit in which it is shown."""
    quantities: dict[str, str]
    """Quantity -> its SI unit."""
    typed: dict[str, TypedUnit]
    """Unit that a form takes, in lower case -> what it is."""
    names: dict[str, UnitName]
    """Name of a unit in documents -> what it is."""
    shifted: dict[str, tuple[float, float]]
    """Temperature scale -> factor and offset to SI; it cannot be part of a compound unit."""
    phases: dict[str, str]
    """Phase of a timing table, extend or retract -> what it is called."""
    certain: tuple[float, float]
    """A probability below the first is only said to be below it, above the second to be above it."""


def figures() -> list[DeclaredFigure]:
    """All figures, group by group."""
    return [
        DeclaredFigure(
            key=figure.key,
            symbol=figure.symbol,
            unit=figure.unit,
            label=figure.label,
            definition=figure.definition,
            group=figure.group,
            section=figure.section,
            exists_when=figure.exists_when.name,
            otherwise=figure.exists_when.otherwise,
            quantity=figure.shown_as,
            default=figure.default,
            column=figure.column,
        )
        for figure in FIGURES.values()
    ]


def units() -> Units:
    """All units."""
    return Units(
        scales={
            name: {system: ShownUnit(*scale) for system, scale in quantity.scales.items()}
            for name, quantity in QUANTITIES.items()
        },
        quantities={name: quantity.unit for name, quantity in QUANTITIES.items()},
        typed={unit: TypedUnit(*meaning) for unit, meaning in TYPED.items()},
        names={name: UnitName(factor, dimension) for name, (factor, dimension) in NAMES.items()},
        shifted=dict(SHIFTED),
        phases=dict(PHASES),
        certain=CERTAIN,
    )
