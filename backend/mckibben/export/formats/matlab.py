"""MATLAB and Octave: one function file."""

from __future__ import annotations

from mckibben.export.matlab_drive import DriveMatlab
from mckibben.export.matlab_static import HELPERS, static_matlab
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """A function that returns the model as a structure of data and function handles."""
    drive = None if subject.runnable is None else DriveMatlab(subject.runnable)
    lines = [*static_matlab(subject, stem, [] if drive is None else list(drive.fields()))]
    if drive is not None:
        lines += drive.functions()
    text = "\n".join([*lines, *HELPERS.splitlines()])
    return (ExportedFile.of_text(f"{stem}.m", text, "text/x-matlab; charset=utf-8"),)


FORMAT = Format(
    title="MATLAB/Octave",
    note="one function file; of a drive its right-hand side, Jacobian and events too",
    write=write,
    identifier=True,
)
