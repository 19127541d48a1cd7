"""Models and drives as files for other programs."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

import warnings
from os import PathLike
from pathlib import Path

from mckibben.documents.studio import Studio
from mckibben.door.problem import reported
from mckibben.door.questions import StatedModel
from mckibben.door.result import Frozen
from mckibben.export.source import of_saved
from mckibben.export.subject import Stated
from mckibben.export.use_case import ExportQuestion, write_export


class Exportable(Frozen):
    """What can be taken along to other programs."""

    __slots__ = ()

    def _to_export(self) -> tuple[Stated, Studio]:
        raise NotImplementedError

    @reported
    def export(self, path: str | PathLike[str], *, as_: str) -> list[Path]:
        """Write it for other programs: source code, lookup tables, equations.

        Each file says where every constant comes from, where the model holds and what the file leaves out. Of
        a drive, code holds the right-hand side, Jacobian, outputs and events; of a model that was fitted to
        transient data, its drive too.

        Args:
            path: of the main file; several files stand beside it under its name, or in it if it ends with
                ``.zip``. A folder takes them under the name of the model.
            as_: "c", "fmu" (FMI 2.0), "fmu3" (FMI 3.0), "json", "latex", "linear" (of a drive: ``.mat`` or
                ``.json`` by the ending), "matlab", "modelica", "python" or "table". An FMU has a binary for
                each platform that a C compiler is found for; a warning names those that it lacks.

        Returns:
            the files written.

        Raises:
            Problem: an unknown format, a name that cannot be one of a file, a model without a length, or what
                the format cannot carry.

        >>> import tempfile
        >>> import mckibben as mk
        >>> muscle = mk.Model.preset("DMSP-20", length="300 mm")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     [file.name for file in muscle.export(f"{folder}/muscle.c", as_="c")]
        ['muscle.c', 'muscle.h']
        """
        stated, of = self._to_export()
        return write_export(ExportQuestion(stated, as_), Path(path), of, remark=_warned)


def _warned(sentence: str) -> None:
    """A remark on the files: a warning at the line that called `Exportable.export`."""
    warnings.warn(sentence, stacklevel=6)


def model_to_export(model: StatedModel, of: Studio, name: str) -> tuple[Stated, Studio]:
    """A model of the door as what is exported."""
    if model.saved is not None:
        return of_saved(model.saved, of, ""), of
    return Stated(model.start(of), name), of
