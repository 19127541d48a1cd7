"""FMU: FMI 2.0 for model exchange and co-simulation in one file, with C sources and compiled binaries."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from hashlib import sha256
from importlib.resources import files

from mckibben.export.fmu import model_c
from mckibben.export.fmu.build import Compiler, built, compilers
from mckibben.export.fmu.description import description, page
from mckibben.export.fmu.variables import Plant
from mckibben.export.formats import json
from mckibben.export.formats.c import sources as equations
from mckibben.export.language import C, words_of
from mckibben.export.registry import ExportedFile, Format, zipped
from mckibben.export.subject import Subject

_FIXED = ("fmi2.c", "fmi2.h", "plant.c", "plant.h", "solver.c")
_GENERATED = ("model.c", "model.h", "rodas4.h")


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """The FMU, with a binary for each platform that can be compiled for here."""
    return (packed(subject, stem, compilers()),)


def packed(subject: Subject, stem: str, using: tuple[Compiler, ...]) -> ExportedFile:
    """The FMU with the binaries of some compilers; sources and XML do not depend on them."""
    identifier = _identifier(stem)
    texts = sources(subject, identifier)
    code = {name: text for name, text in texts.items() if name.endswith((".c", ".h"))}
    done = built(code, identifier, using)
    contents = [
        ("modelDescription.xml", texts["modelDescription.xml"].encode()),
        *((f"sources/{name}", text.encode()) for name, text in code.items()),
        ("documentation/index.html", texts["index.html"].encode()),
        ("resources/model.json", json.write(subject, "model")[0].content),
        *done.binaries.items(),
    ]
    archive = zipped(
        [ExportedFile(name, content, "") for name, content in contents],
        f"{stem}.fmu",
        "application/vnd.fmi.fmu",
    )
    return ExportedFile(archive.name, archive.content, archive.media_type, done.remarks)


def sources(subject: Subject, identifier: str) -> dict[str, str]:
    """All texts of the FMU by name; the GUID is the hash of them."""
    plant = Plant(subject, identifier)
    own_header, own_source = equations(subject, identifier, tunable=subject.runnable is None)
    texts = {
        **{name: _fixed(name) for name in _FIXED},
        f"{identifier}.c": f"{own_source}\n",
        f"{identifier}.h": f"{own_header}\n",
        "model.c": _joined(model_c.source(plant)),
        "rodas4.h": _joined(model_c.rodas4()),
        "index.html": _joined(page(subject.about.lines())),
    }
    compiled = sorted(name for name in texts if name.endswith(".c"))

    def with_guid(guid: str) -> dict[str, str]:
        return {
            **texts,
            "model.h": _joined(model_c.header(plant, guid)),
            "modelDescription.xml": description(plant, identifier, guid, compiled),
        }

    whole = "\0".join(f"{name}\0{text}" for name, text in sorted(with_guid("").items()))
    return with_guid(f"{{{sha256(whole.encode()).hexdigest()}}}")


def _identifier(stem: str) -> str:
    """Of the binaries and the model's functions; not one of the names of the other files."""
    name = words_of(stem)
    taken = {file.partition(".")[0] for file in (*_FIXED, *_GENERATED)}
    return f"{name}_model" if name in C.reserved or name in taken else name


@cache
def _fixed(name: str) -> str:
    return (files("mckibben.export.fmu") / name).read_text("utf-8")


def _joined(lines: Iterable[str]) -> str:
    return "\n".join([*lines, ""])


FORMAT = Format(
    title="FMU",
    note="FMI 2.0 for model exchange and co-simulation, with C sources",
    write=write,
)
