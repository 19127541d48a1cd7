"""An FMU of any version as one file: description, C sources, binaries, and the model as JSON."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from hashlib import sha256
from importlib.resources import files

from mckibben.export.fmu import model_c
from mckibben.export.fmu.build import Compiler, built
from mckibben.export.fmu.description import STARTS, description, page
from mckibben.export.fmu.dialects import FMI2, FMI3, Dialect
from mckibben.export.fmu.variables import Plant
from mckibben.export.formats import json
from mckibben.export.formats.c import sources as equations
from mckibben.export.language import C, words_of
from mckibben.export.registry import ExportedFile, zipped
from mckibben.export.subject import Subject

_FIXED = ("access.c", "access.h", "fmi.c", "plant.c", "plant.h", "solver.c")
_GENERATED = ("model.c", "model.h", "rodas4.h")


def packed(subject: Subject, stem: str, using: tuple[Compiler, ...], dialect: Dialect = FMI2) -> ExportedFile:
    """The FMU with the binaries of some compilers; sources and XML do not depend on them."""
    identifier = _identifier(stem)
    texts = sources(subject, identifier, dialect)
    code = {name: text for name, text in texts.items() if name.endswith((".c", ".h"))}
    more = dialect.more_files(identifier, compiled(code))
    done = built(code, identifier, using, tuples=dialect is FMI3)
    contents = [
        ("modelDescription.xml", texts["modelDescription.xml"].encode()),
        *((f"sources/{name}", text.encode()) for name, text in {**code, **more}.items()),
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


def sources(subject: Subject, identifier: str, dialect: Dialect = FMI2) -> dict[str, str]:
    """All texts of the FMU by name; the GUID is the hash of them."""
    plant = Plant(subject, identifier)
    own_header, own_source = equations(subject, identifier, tunable=subject.runnable is None)
    left_out = [STARTS] if plant.states else []
    texts = {
        **{name: _fixed(name) for name in _FIXED},
        "fmi.h": _fixed(dialect.header),
        f"{identifier}.c": f"{own_source}\n",
        f"{identifier}.h": f"{own_header}\n",
        "model.c": _joined(model_c.source(plant)),
        "rodas4.h": _joined(model_c.rodas4()),
        "index.html": _joined(page(subject.about.lines(left_out))),
    }

    def with_guid(guid: str) -> dict[str, str]:
        xml = description(plant, identifier, guid, compiled(texts), dialect)
        return {**texts, "model.h": _joined(model_c.header(plant, guid)), "modelDescription.xml": xml}

    whole = "\0".join(f"{name}\0{text}" for name, text in sorted(with_guid("").items()))
    return with_guid(f"{{{sha256(whole.encode()).hexdigest()}}}")


def compiled(texts: Iterable[str]) -> list[str]:
    """Names of the files that a compiler is given."""
    return sorted(name for name in texts if name.endswith(".c"))


def _identifier(stem: str) -> str:
    """Of the binaries and the model's functions; not one of the names of the other files."""
    name = words_of(stem)
    files = (*_FIXED, *_GENERATED)
    taken = {file.partition(".")[0] for file in files}
    return f"{name}_model" if name in C.reserved or name in taken else name


@cache
def _fixed(name: str) -> str:
    return (files("mckibben.export.fmu") / name).read_text("utf-8")


def _joined(lines: Iterable[str]) -> str:
    return "\n".join([*lines, ""])
