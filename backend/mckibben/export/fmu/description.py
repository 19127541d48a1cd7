"""``modelDescription.xml``."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from xml.etree import ElementTree

from mckibben.export.fmu.dialects import Described, Dialect, as_text
from mckibben.export.fmu.variables import (
    INPUT,
    OUTPUT,
    PARAMETER,
    RATE,
    STATE,
    SWITCH,
    Plant,
    Variable,
)
from mckibben.export.language import plain

# Exponents of kg, m, s, A, K, rad of the units that a model states.
_BASE = ("kg", "m", "s", "A", "K", "rad")
_UNITS: dict[str, tuple[int, ...]] = {
    "1": (0, 0, 0, 0, 0, 0),
    "kg": (1, 0, 0, 0, 0, 0),
    "m": (0, 1, 0, 0, 0, 0),
    "s": (0, 0, 1, 0, 0, 0),
    "A": (0, 0, 0, 1, 0, 0),
    "K": (0, 0, 0, 0, 1, 0),
    "rad": (0, 0, 0, 0, 0, 1),
    "Hz": (0, 0, -1, 0, 0, 0),
    "N": (1, 1, -2, 0, 0, 0),
    "Pa": (1, -1, -2, 0, 0, 0),
    "J": (1, 2, -2, 0, 0, 0),
    "W": (1, 2, -3, 0, 0, 0),
    "V": (1, 2, -3, -1, 0, 0),
}
_TOKEN = re.compile(r"([A-Za-z]+|1)(?:\^?(-?\d+))?|([*/()])")
# At 1e-6 an integrator of several steps' memory like CVode errs by 0.1 mm where a load lands.
_TOLERANCE = "1e-07"
STARTS = (
    "The states start where the document starts with its own parameters: they do not follow a parameter that "
    "is changed. Then set the states too, or let the model come to rest before its inputs move."
)
_PLAYED = (
    "true: the document's course of the inputs {names} is played, with its dead times applied, and their "
    "values are ignored; false: the inputs act as set."
)


def description(plant: Plant, identifier: str, guid: str, sources: Iterable[str], dialect: Dialect) -> str:
    """The XML.

    Args:
        plant: the model.
        identifier: of the binaries.
        guid: of the FMU.
        sources: names of the C files.
        dialect: version of FMI.
    """
    about, drive = plant.subject.about, plant.drive
    said = [f"Model {about.id}, sha256 {about.hash}.", *([STARTS] if plant.states else []), *about.left_out]
    root = ElementTree.Element(
        "fmiModelDescription",
        {
            "fmiVersion": dialect.version,
            "modelName": _text(about.title),
            dialect.token: guid,
            "description": _text(" ".join(said)),
            "version": about.hash[:12],
            "generationTool": _text(about.program),
            "variableNamingConvention": "structured",
            **dialect.root(plant),
        },
    )
    dialect.interfaces(root, identifier, list(sources))
    described = list(_described(plant))
    names = [each.attributes["name"] for each in described]
    assert len(set(names)) == len(names), names  # noqa: S101 - names are made unique
    variables = ElementTree.Element("ModelVariables")
    for each in described:
        dialect.variable(variables, each)
    if plant.plays:
        names = [each.name for each, own in zip(plant.inputs, plant.played, strict=True) if own]
        dialect.flag(variables, _PLAYED.format(names=", ".join(names)))
    dialect.last(variables, plant)
    defined = ElementTree.SubElement(root, "UnitDefinitions")
    for unit in sorted({each.unit for each in described} - {"1"} | {"s"}):
        own = ElementTree.SubElement(defined, "Unit", name=unit)
        exponents = dimension(unit)
        if exponents is not None:
            ElementTree.SubElement(
                own, "BaseUnit", {base: str(n) for base, n in zip(_BASE, exponents, strict=True) if n}
            )
    logged = ElementTree.SubElement(root, "LogCategories")
    ElementTree.SubElement(logged, "Category", name="logStatusError", description="Why a call has failed.")
    stop = 1.0 if drive is None else float(drive.drive.duration)
    times = {"startTime": "0.0", "stopTime": repr(stop), "tolerance": _TOLERANCE, "stepSize": "0.001"}
    ElementTree.SubElement(root, "DefaultExperiment", times)
    root.append(variables)
    dialect.structure(root, described, plant)
    return as_text(root)


def _described(plant: Plant) -> Iterator[Described]:
    """All real variables in their order; states first, then their rates."""
    for n, each in enumerate(plant.states):
        yield _real(each, STATE + n, "local", "continuous", initial="exact")
    for n, each in enumerate(plant.rates()):
        yield _real(each, RATE + n, "local", "continuous", state=STATE + n)
    for n, each in enumerate(plant.inputs):
        yield _real(each, INPUT + n, "input", "continuous")
    for n, each in enumerate(plant.outputs):
        yield _real(each, OUTPUT + n, "output", "continuous")
    for n, each in enumerate(plant.switches):
        yield _real(each, SWITCH + n, "local", "discrete", initial="exact")
    for n, each in enumerate(plant.parameters):
        yield _real(each, PARAMETER + n, "parameter", "tunable")


def _real(
    variable: Variable, reference: int, causality: str, variability: str,
    initial: str | None = None, state: int | None = None,
) -> Described:  # fmt: skip
    attributes = {
        "name": variable.name, "description": _text(variable.meaning),
        "causality": causality, "variability": variability,
    }  # fmt: skip
    if initial is not None:
        attributes["initial"] = initial
    numbers = {"min": variable.least, "max": variable.most, "nominal": variable.nominal}
    numbers["start"] = variable.start
    known = {name: repr(float(number)) for name, number in numbers.items() if number is not None}
    return Described(reference, attributes, variable.unit, known, state)


def _text(text: str) -> str:
    """A text for an attribute: one line, nothing invisible."""
    return plain(text)


def dimension(unit: str) -> tuple[int, ...] | None:
    """Exponents of kg, m, s, A, K, rad of a unit, "m^3/(s*Pa)"; None for one that is not made of SI units."""
    total, signs, sign = [0] * len(_BASE), [1], 1
    position = 0
    for token in _TOKEN.finditer(unit):
        if token.start() != position:
            return None
        position = token.end()
        name, exponent, mark = token.groups()
        if mark == "(":
            signs.append(signs[-1] * sign)
            sign = 1
        elif mark == ")":
            signs.pop()
        elif mark is not None:
            sign = -1 if mark == "/" else 1
        elif name not in _UNITS:
            return None
        else:
            factor = signs[-1] * sign * int(exponent or 1)
            total = [a + factor * b for a, b in zip(total, _UNITS[name], strict=True)]
    return tuple(total) if position == len(unit) else None


def page(lines: Iterable[str]) -> Iterator[str]:
    """``documentation/index.html``: what every file says of the model."""
    from html import escape

    yield '<!doctype html><html lang="en"><meta charset="utf-8"><title>Model</title><pre>'
    yield from (escape(plain_line(line)) for line in lines)
    yield "</pre></html>"


def plain_line(line: str) -> str:
    """A line without anything invisible, its indentation kept."""
    return f"{' ' * (len(line) - len(line.lstrip(' ')))}{plain(line)}"
