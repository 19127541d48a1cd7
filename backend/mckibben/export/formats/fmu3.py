"""FMU: FMI 3.0 for model exchange and co-simulation in one file, around the same C as FMI 2.0."""

from __future__ import annotations

from mckibben.export.fmu.build import compilers
from mckibben.export.fmu.dialects import FMI3
from mckibben.export.fmu.package import packed
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """The FMU, with a binary for each platform that can be compiled for here."""
    return (packed(subject, stem, compilers(), FMI3),)


FORMAT = Format(
    title="FMU of FMI 3.0",
    note="FMI 3.0 for model exchange and co-simulation, for programs that read it",
    write=write,
    compiles=True,
)
