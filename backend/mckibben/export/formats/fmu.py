"""FMU: FMI 2.0 for model exchange and co-simulation in one file, with C sources and compiled binaries."""

from __future__ import annotations

from mckibben.export.fmu.build import compilers
from mckibben.export.fmu.package import packed
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """The FMU, with a binary for each platform that can be compiled for here."""
    return (packed(subject, stem, compilers()),)


FORMAT = Format(
    title="FMU",
    note="FMI 2.0 for model exchange and co-simulation, with C sources",
    write=write,
    compiles=True,
)
