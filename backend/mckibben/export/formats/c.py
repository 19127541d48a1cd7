"""C99: one header, one source; static memory, only math.h."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mckibben.export.c_drive import DriveC
from mckibben.export.c_static import StaticC
from mckibben.export.language import C, words_of
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject

# Headers of the language and of Unix: one of such a name would be read in their place.
_HEADERS = frozenset({
    "assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "limits", "locale", "math", "setjmp",
    "signal", "stdarg", "stdbool", "stddef", "stdint", "stdio", "stdlib", "string", "tgmath", "time",
    "unistd", "wchar", "wctype",
})  # fmt: skip


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """Source and header."""
    header, source = sources(subject, stem)
    return (
        ExportedFile.of_text(f"{stem}.c", source, "text/x-c; charset=utf-8"),
        ExportedFile.of_text(f"{stem}.h", header, "text/x-c; charset=utf-8"),
    )


def sources(subject: Subject, stem: str, *, tunable: bool = False) -> tuple[str, str]:
    """Header and source; names begin with the stem as an identifier.

    Args:
        subject: the model.
        stem: of the two files.
        tunable: whether a caller may change the constants of the static model.
    """
    prefix = words_of(stem)
    if prefix in C.reserved:
        prefix = f"{prefix}_model"
    static = StaticC(subject, prefix, tunable=tunable)
    drive = None if subject.runnable is None else DriveC(subject.runnable, prefix)
    guard = f"{prefix.upper()}_H"
    comment = list(_comment(subject.about.lines()))
    header = [
        *comment, "", f"#ifndef {guard}", f"#define {guard}", "",
        "#ifdef __cplusplus", 'extern "C" {', "#endif", "",
        *static.header(), *([] if drive is None else ["", *drive.header()]),
        "", "#ifdef __cplusplus", "}", "#endif", "", "#endif",
    ]  # fmt: skip
    source = [
        *comment, "", f'#include "{stem}.h"', "", "#include <math.h>", "",
        *static.source(), *([] if drive is None else ["", *drive.source()]),
    ]  # fmt: skip
    return "\n".join(header), "\n".join(source)


def _comment(lines: Iterable[str]) -> Iterator[str]:
    yield "/*"
    yield from C.remarks(lines)
    yield " */"


FORMAT = Format(
    title="C99",
    note="header and source for a controller; of a drive its equations too",
    write=write,
    reserved=_HEADERS,
)
