"""What every model can do with itself: be written to a file, and be kept as a preset."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Self

from mckibben.application.model.saved import keep, model_text
from mckibben.application.text_file import write_text
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.studio import Studio
from mckibben.door.problem import reported
from mckibben.door.questions import StatedModel
from mckibben.door.result import Frozen
from mckibben.door.workspace import studio


class Savable(Frozen):
    """A model that can be saved."""

    __slots__ = ()

    @classmethod
    def of(cls, stated: StatedModel, of: Studio) -> Self:
        """The model of documents, for the rest of the door."""
        raise NotImplementedError

    def _saved(self) -> SavedModel:
        raise NotImplementedError

    @reported
    def save(self, path: str | PathLike[str]) -> None:
        """Write the model as JSON, for `mckibben.load` and the option ``--model`` of the command line.

        Raises:
            Problem: the file cannot be written.
        """
        write_text(Path(path), model_text(self._saved()))

    @reported
    def keep(self, id: str, *, title: str = "") -> Self:
        """Save the model as a muscle of your own, for `Model.preset`, sizing tasks, command line and page.

        A model of `diagnose`, or of `compare` with a fit, keeps how sure its values are and where it was
        measured: its curves and runs have intervals, and say where they leave that range.

        Args:
            id: of the preset, letters, digits and hyphens; one of your own with this id is replaced.
            title: its name for display; "" = the id.

        Returns:
            The model of the new preset.

        Raises:
            Problem: an id that cannot be used or belongs to the program, a model with a typed term.
        """
        of = studio()
        return self.of(StatedModel({"preset": keep(self._saved(), of, id=id, title=title).id}), of)
