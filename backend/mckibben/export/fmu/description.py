"""``modelDescription.xml`` of FMI 2.0."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from xml.etree import ElementTree

from mckibben.export.fmu.variables import (
    INPUT,
    OUTPUT,
    PARAMETER,
    PLAY,
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
_PLAYED = (
    "true: the document's course of the inputs {names} is played, with its dead times applied, and their "
    "values are ignored; false: the inputs act as set."
)


def description(plant: Plant, identifier: str, guid: str, sources: Iterable[str]) -> str:
    """The XML.

    Args:
        plant: the model.
        identifier: of the binaries.
        guid: of the FMU.
        sources: names of the C files.
    """
    about, drive = plant.subject.about, plant.drive
    root = ElementTree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=_text(about.title),
        guid=guid,
        description=_text(" ".join([f"Model {about.id}, sha256 {about.hash}.", *about.left_out])),
        version=about.hash[:12],
        generationTool=_text(about.program),
        variableNamingConvention="structured",
        numberOfEventIndicators=str(len(plant.switches)),
    )
    files = list(sources)
    common = {
        "modelIdentifier": identifier,
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
        "providesDirectionalDerivative": "true",
    }
    for kind, more in (
        ("ModelExchange", {}),
        ("CoSimulation", {"canHandleVariableCommunicationStepSize": "true", "canInterpolateInputs": "true"}),
    ):
        own = ElementTree.SubElement(root, kind, {**common, **more})
        listed = ElementTree.SubElement(own, "SourceFiles")
        for name in files:
            ElementTree.SubElement(listed, "File", name=name)
    variables = ElementTree.Element("ModelVariables")
    units: set[str] = set()
    index = _Indexed(variables, units)
    states = [
        index.add(each, STATE + n, "local", "continuous", initial="exact")
        for n, each in enumerate(plant.states)
    ]
    rates = [
        index.add(each, RATE + n, "local", "continuous", derivative=states[n])
        for n, each in enumerate(plant.rates())
    ]
    for n, each in enumerate(plant.inputs):
        index.add(each, INPUT + n, "input", "continuous")
    outputs = [index.add(each, OUTPUT + n, "output", "continuous") for n, each in enumerate(plant.outputs)]
    for n, each in enumerate(plant.switches):
        index.add(each, SWITCH + n, "local", "discrete", initial="exact")
    for n, each in enumerate(plant.parameters):
        index.add(each, PARAMETER + n, "parameter", "tunable")
    if plant.plays:
        names = ", ".join(each.name for each, own in zip(plant.inputs, plant.played, strict=True) if own)
        said = {
            "description": _PLAYED.format(names=names),
            "causality": "parameter",
            "variability": "tunable",
        }
        own = ElementTree.SubElement(
            variables, "ScalarVariable", {"name": PLAY, "valueReference": "0", **said}
        )
        ElementTree.SubElement(own, "Boolean", start="false")
    defined = ElementTree.SubElement(root, "UnitDefinitions")
    for unit in sorted(units):
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
    structure = ElementTree.SubElement(root, "ModelStructure")
    for kind, unknowns in (
        ("Outputs", outputs),
        ("Derivatives", rates),
        ("InitialUnknowns", sorted([*outputs, *rates])),
    ):
        if unknowns:
            own = ElementTree.SubElement(structure, kind)
            for number in unknowns:
                ElementTree.SubElement(own, "Unknown", index=str(number))
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'


class _Indexed:
    """Adds variables and counts them, as the structure refers to them by number."""

    def __init__(self, parent: ElementTree.Element, units: set[str]) -> None:
        self._parent, self._units, self._names = parent, units, set[str]()

    def add(
        self, variable: Variable, reference: int, causality: str, variability: str,
        initial: str | None = None, derivative: int | None = None,
    ) -> int:  # fmt: skip
        """Add a variable; returns its number, from 1."""
        assert variable.name not in self._names, variable.name  # noqa: S101 - names are made unique
        self._names.add(variable.name)
        attributes = {
            "name": variable.name, "valueReference": str(reference), "description": _text(variable.meaning),
            "causality": causality, "variability": variability,
        }  # fmt: skip
        if initial is not None:
            attributes["initial"] = initial
        own = ElementTree.SubElement(self._parent, "ScalarVariable", attributes)
        unit = {} if variable.unit == "1" else {"unit": variable.unit}
        self._units.update(unit.values())
        numbers = {"min": variable.least, "max": variable.most, "nominal": variable.nominal}
        numbers["start"] = variable.start
        real = {name: repr(float(number)) for name, number in numbers.items() if number is not None}
        if derivative is not None:
            real["derivative"] = str(derivative)
        ElementTree.SubElement(own, "Real", {**unit, **real})
        return len(self._names)


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
