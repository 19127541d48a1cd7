"""Python: one file that needs numpy alone."""

from __future__ import annotations

import sys

from mckibben.export.language import PYTHON
from mckibben.export.python_drive import DrivePython
from mckibben.export.python_static import static_python
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """One module."""
    lines = [
        *PYTHON.remarks(subject.about.lines()),
        "",
        '"""A pneumatic muscle, or a drive with one: functions of numbers and numpy arrays."""',
        "",
        "import numpy as np",
        "",
        *static_python(subject),
    ]
    if subject.runnable is not None:
        lines += ["", "", *DrivePython(subject.runnable).lines()]
    return (ExportedFile.of_text(f"{stem}.py", "\n".join(lines), "text/x-python; charset=utf-8"),)


FORMAT = Format(
    title="Python",
    note="one file, numpy only; of a drive its equations too",
    write=write,
    identifier=True,  # `import` knows no other names
    # A file of such a name would be imported in place of the module, by numpy too.
    reserved=PYTHON.reserved | {name.lower() for name in sys.stdlib_module_names},
)
