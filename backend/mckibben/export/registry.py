"""The formats: every file of ``formats/`` that declares ``FORMAT``; its name is the id."""

from __future__ import annotations

import importlib
import io
import pkgutil
import zipfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cache

from mckibben.export.subject import Subject
from mckibben.physics.errors import InputError, did_you_mean

# The earliest date of a zip file: a file must not tell when it was made, or two would differ.
_ANY_DATE = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True, slots=True)
class ExportedFile:
    """A file.

    Attributes:
        name: without a folder.
        content: of the file.
        media_type: of the content.
        remarks: what the user should know of how it was made, sentences.
    """

    name: str
    content: bytes
    media_type: str
    remarks: tuple[str, ...] = ()

    @classmethod
    def of_text(cls, name: str, text: str, media_type: str = "text/plain; charset=utf-8") -> ExportedFile:
        """A text in UTF-8 that ends with a line end."""
        return cls(name, f"{text.rstrip()}\n".encode(), media_type)


@dataclass(frozen=True, slots=True)
class Format:
    """A way to write a model down.

    Attributes:
        title: what it is called on screen.
        note: what is in it, a few words.
        write: files of a subject under a stem, the main one first. Names begin with the stem, which is made
            of letters, digits, ``-``, ``_`` and ``.``. Raises InputError for what the format cannot carry.
        drives: whether it can carry a whole drive; otherwise it takes the muscle of one.
        muscles: whether it can carry a muscle alone; otherwise it needs a drive.
        alternatives: whether its files are the same model in several forms: a path with the ending of one
            gets that one alone.
        identifier: whether the stem must be an identifier, because the program reads the file by its name.
        reserved: stems, in lower case, that mean something else to that program.
        compiles: whether a compiler is run, which takes seconds, and minutes the first time.
        id: name of the file that declares it, set by `formats`.
    """

    title: str
    note: str
    write: Callable[[Subject, str], tuple[ExportedFile, ...]]
    drives: bool = True
    muscles: bool = True
    alternatives: bool = False
    identifier: bool = False
    reserved: frozenset[str] = frozenset()
    compiles: bool = False
    id: str = ""


def zipped(files: Iterable[ExportedFile], name: str, media_type: str = "application/zip") -> ExportedFile:
    """Files as one zip file; the same files give the same bytes."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            entry = zipfile.ZipInfo(file.name, _ANY_DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, file.content)
    return ExportedFile(name, content.getvalue(), media_type)


@cache
def formats() -> dict[str, Format]:
    """All formats by id."""
    from mckibben.export import formats as folder

    found = {}
    for module in pkgutil.iter_modules(folder.__path__):
        declared = importlib.import_module(f"{folder.__name__}.{module.name}").FORMAT
        found[module.name] = replace(declared, id=module.name)
    return found


def format_named(name: str) -> Format:
    """The format of an id.

    Raises:
        InputError: there is none.
    """
    known = formats()
    if name not in known:
        raise InputError(f"there is no format '{name[:40]}'", field="as", hint=did_you_mean(name, known))
    return known[name]
