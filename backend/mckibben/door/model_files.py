"""Models from files and from drive documents."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike, fspath
from pathlib import Path

from mckibben.documents.studio import Studio
from mckibben.door.model import Model
from mckibben.door.problem import reported
from mckibben.door.questions import StatedModel
from mckibben.door.workspace import studio


@reported
def load(path: str | PathLike[str]) -> Model:
    """The model in a JSON file.

    It may be what `Model.save` or ``mckibben diagnose --save`` wrote, a muscle by its geometry, a muscle
    preset, or a drive document, of which muscle and effects are taken.

    Raises:
        Problem: names the file, the field, what is wrong and what would be right.
    """
    of = studio()
    return Model.of(StatedModel.of_file(Path(fspath(path)), of), of)


def model_of_document(document: Mapping[str, object], of: Studio) -> Model:
    """The model of muscle and effects of a drive document."""
    return Model.of(StatedModel.of_parts(document, ""), of)
