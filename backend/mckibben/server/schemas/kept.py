"""Bodies and answers of ``/api/kept``: what the user keeps on the disk."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.measurement.store import MAX_NAME

KeptKind = Literal[
    "files", "muscles", "valves", "tubes", "fittings", "measurements", "curves", "designs", "drives", "tasks"
]  # fmt: skip


class KeptItem(Strict):
    """A measurement file or a preset of the user."""

    kind: KeptKind = Field(description="'files' for a measurement file, else the kind of preset.")
    id: str = Field(description="Id of the measurement or preset.")
    name: str = Field(description="File name or title.")
    size: int = Field(description="On the disk [bytes].")
    changed: float = Field(description="When it was stored, renamed or deleted [s since 1970].")
    corrected: bool = Field(description="Whether the file is read with corrections of the user.")


class KeptAnswer(Strict):
    """All that the user keeps."""

    items: list[KeptItem] = Field(description="Measurements and presets, the last one first.")
    deleted: list[KeptItem] = Field(description="Those that can be restored, the last one first.")
    size: int = Field(description="Of all measurements on the disk, with deleted ones [bytes].")
    quota: int = Field(description="Most that they may take [bytes].")


class RenameRequest(Strict):
    """A new name."""

    name: str = Field(
        min_length=1, max_length=MAX_NAME, description="The new name.", examples=["bench 3, 300 mm"]
    )
    was: str | None = Field(
        None, max_length=MAX_NAME, description="The name that the user saw; refused if it is another by now."
    )
