"""What FMI 2.0 and 3.0 write differently in ``modelDescription.xml`` and in the archive."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree

from mckibben.export.fmu.variables import INDICATOR, KIND, PLAY, TIME, Plant

Element = ElementTree.Element
_CAN = {"canHandleVariableCommunicationStepSize": "true"}


@dataclass(frozen=True, slots=True)
class Described:
    """A real variable as both versions state it.

    Attributes:
        attributes: name, description, causality, variability, perhaps initial.
        unit: "1" for none.
        numbers: min, max, nominal, start; those that are known.
        state: reference of the state that it is the rate of.
    """

    reference: int
    attributes: Mapping[str, str]
    unit: str
    numbers: Mapping[str, str]
    state: int | None = None

    @property
    def causality(self) -> str:
        """ "input", "output", "parameter" or "local"."""
        return self.attributes["causality"]


class Dialect(ABC):
    """A version of FMI.

    Attributes:
        version: "2.0" or "3.0".
        token: the attribute that holds the hash which the binary checks.
        header: types of this version's interface, which is ``fmi.h`` in the FMU.
    """

    version: str
    token: str
    header: str

    def root(self, plant: Plant) -> dict[str, str]:
        """More attributes of the root."""
        del plant
        return {}

    @abstractmethod
    def interfaces(self, root: Element, identifier: str, sources: Sequence[str]) -> None:
        """Add model exchange and co-simulation."""

    @abstractmethod
    def variable(self, parent: Element, variable: Described) -> None:
        """Add a real variable."""

    @abstractmethod
    def flag(self, parent: Element, description: str) -> None:
        """Add the Boolean that plays the command of the document."""

    @abstractmethod
    def structure(self, root: Element, variables: Sequence[Described], plant: Plant) -> None:
        """Add what depends on the states; all variables in their order."""

    def last(self, parent: Element, plant: Plant) -> None:
        """Add variables that only this version has."""
        del parent, plant

    def more_files(self, identifier: str, sources: Iterable[str]) -> dict[str, str]:
        """Texts beside the sources, by name."""
        del identifier, sources
        return {}


class Fmi2(Dialect):
    """FMI 2.0."""

    version, token = "2.0", "guid"
    header = "fmi2.h"

    def root(self, plant: Plant) -> dict[str, str]:
        """The number of event indicators."""
        return {"numberOfEventIndicators": str(len(plant.switches))}

    def interfaces(self, root: Element, identifier: str, sources: Sequence[str]) -> None:
        """With the sources in each."""
        common = {
            "modelIdentifier": identifier,
            "canNotUseMemoryManagementFunctions": "true",
            "canGetAndSetFMUstate": "true",
            "canSerializeFMUstate": "true",
            "providesDirectionalDerivative": "true",
        }
        for kind, more in (("ModelExchange", {}), ("CoSimulation", {**_CAN, "canInterpolateInputs": "true"})):
            own = ElementTree.SubElement(root, kind, {**common, **more})
            listed = ElementTree.SubElement(own, "SourceFiles")
            for name in sources:
                ElementTree.SubElement(listed, "File", name=name)

    def variable(self, parent: Element, variable: Described) -> None:
        """A ``ScalarVariable``."""
        head = {"valueReference": str(variable.reference), **variable.attributes}
        own = ElementTree.SubElement(parent, "ScalarVariable", head)
        unit = {} if variable.unit == "1" else {"unit": variable.unit}
        # States come first, so that their places are those of their references.
        derivative = {} if variable.state is None else {"derivative": str(variable.state % KIND + 1)}
        ElementTree.SubElement(own, "Real", {**unit, **variable.numbers, **derivative})

    def flag(self, parent: Element, description: str) -> None:
        """A ``Boolean``."""
        said = {"description": description, "causality": "parameter", "variability": "tunable"}
        own = ElementTree.SubElement(parent, "ScalarVariable", {"name": PLAY, "valueReference": "0", **said})
        ElementTree.SubElement(own, "Boolean", start="false")

    def structure(self, root: Element, variables: Sequence[Described], plant: Plant) -> None:
        """Variables by their place, from 1."""
        del plant
        structure = ElementTree.SubElement(root, "ModelStructure")
        numbered = list(enumerate(variables, 1))
        outputs = [n for n, each in numbered if each.causality == "output"]
        rates = [n for n, each in numbered if each.state is not None]
        for kind, unknowns in (
            ("Outputs", outputs), ("Derivatives", rates), ("InitialUnknowns", sorted([*outputs, *rates]))
        ):  # fmt: skip
            if unknowns:
                own = ElementTree.SubElement(structure, kind)
                for number in unknowns:
                    ElementTree.SubElement(own, "Unknown", index=str(number))


class Fmi3(Dialect):
    """FMI 3.0."""

    version, token = "3.0", "instantiationToken"
    header = "fmi3.h"

    def interfaces(self, root: Element, identifier: str, sources: Sequence[str]) -> None:
        """The sources are in ``buildDescription.xml``."""
        del sources
        common = {
            "modelIdentifier": identifier,
            "canGetAndSetFMUState": "true",
            "canSerializeFMUState": "true",
            "providesDirectionalDerivatives": "true",
        }
        for kind, more in (("ModelExchange", {}), ("CoSimulation", _CAN)):
            ElementTree.SubElement(root, kind, {**common, **more})

    def variable(self, parent: Element, variable: Described) -> None:
        """A ``Float64``."""
        unit = {} if variable.unit == "1" else {"unit": variable.unit}
        derivative = {} if variable.state is None else {"derivative": str(variable.state)}
        head = {"valueReference": str(variable.reference), **variable.attributes}
        ElementTree.SubElement(parent, "Float64", {**head, **unit, **derivative, **variable.numbers})

    def flag(self, parent: Element, description: str) -> None:
        """A ``Boolean``."""
        said = {"description": description, "causality": "parameter", "variability": "tunable"}
        ElementTree.SubElement(
            parent, "Boolean", {"name": PLAY, "valueReference": "0", **said, "start": "false"}
        )

    def last(self, parent: Element, plant: Plant) -> None:
        """The event indicators and the time, which are variables in 3.0."""
        for place, each in enumerate(plant.switches):
            own = {
                "name": f"indicator.{each.name.removeprefix('switch.')}",
                "valueReference": str(INDICATOR + place),
                "description": f"{each.name} changes where this falls through 0.",
                "causality": "local",
                "variability": "continuous",
            }
            ElementTree.SubElement(parent, "Float64", own)
        said = {"causality": "independent", "variability": "continuous", "unit": "s"}
        ElementTree.SubElement(parent, "Float64", {"name": "time", "valueReference": str(TIME), **said})

    def structure(self, root: Element, variables: Sequence[Described], plant: Plant) -> None:
        """Variables by their value reference."""
        structure = ElementTree.SubElement(root, "ModelStructure")
        outputs = [each.reference for each in variables if each.causality == "output"]
        rates = [each.reference for each in variables if each.state is not None]
        for kind, unknowns in (
            ("Output", outputs),
            ("ContinuousStateDerivative", rates),
            ("InitialUnknown", sorted([*outputs, *rates])),
            ("EventIndicator", [INDICATOR + place for place in range(len(plant.switches))]),
        ):
            for reference in unknowns:
                ElementTree.SubElement(structure, kind, valueReference=str(reference))

    def more_files(self, identifier: str, sources: Iterable[str]) -> dict[str, str]:
        """How the sources are compiled."""
        root = ElementTree.Element("fmiBuildDescription", fmiVersion=self.version)
        own = ElementTree.SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
        listed = ElementTree.SubElement(own, "SourceFileSet", language="C99")
        for name in sources:
            ElementTree.SubElement(listed, "SourceFile", name=name)
        ElementTree.SubElement(own, "Library", name="m", external="true")
        return {"buildDescription.xml": as_text(root)}


def as_text(root: Element) -> str:
    """The XML as a file."""
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'


FMI2, FMI3 = Fmi2(), Fmi3()
