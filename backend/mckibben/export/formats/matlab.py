"""MATLAB and Octave: one function file."""

from __future__ import annotations

import re
from collections.abc import Iterable

from mckibben.export.language import MATLAB
from mckibben.export.matlab_drive import DriveMatlab
from mckibben.export.matlab_static import HELPERS, static_matlab
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject
from mckibben.physics.errors import InputError

_FUNCTION = re.compile(r"@(\w+)|\b([A-Za-z]\w*)\(")  # handles, calls and indices


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """A function that returns the model as a structure of data and function handles.

    Raises:
        InputError: the name is one of a function that the file itself needs. Field "name".
    """
    drive = None if subject.runnable is None else DriveMatlab(subject.runnable)
    lines = [*static_matlab(subject, stem, [] if drive is None else list(drive.fields()))]
    if drive is not None:
        lines += drive.functions()
    lines += HELPERS.splitlines()
    if stem.lower() in _functions(lines[1:]):
        raise InputError(
            f"'{stem}' cannot be the name of the file: it uses a function or variable of that name itself",
            field="name",
            hint=f"e.g. {stem}_model",
        )
    text = "\n".join(lines)
    return (ExportedFile.of_text(f"{stem}.m", text, "text/x-matlab; charset=utf-8"),)


def _functions(lines: Iterable[str]) -> set[str]:
    """Names, in lower case, of what lines of code call or index."""
    code = (line for line in lines if not line.lstrip().startswith(MATLAB.comment))
    return {(handle or call).lower() for line in code for handle, call in _FUNCTION.findall(line)}


FORMAT = Format(
    title="MATLAB/Octave",
    note="one function file; of a drive its right-hand side, Jacobian and events too",
    write=write,
    identifier=True,
    reserved=MATLAB.reserved,
)
