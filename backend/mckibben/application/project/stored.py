"""What the user keeps on the disk: measurements and presets, their sizes, and what can be restored."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, cast

from mckibben.documents.studio import Studio
from mckibben.facts.result import result_class
from mckibben.measurement.store import KeptFile, MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.presets.own import OwnPreset, OwnPresets

KeptKind = Literal[
    "files", "muscles", "valves", "tubes", "fittings", "measurements", "curves", "designs", "drives", "tasks"
]  # fmt: skip

#: The kind of an item that is a measurement file; presets have the kind of their folder.
FILES: KeptKind = "files"


@result_class
class KeptItem:
    """A measurement file or a preset of the user."""

    kind: KeptKind
    """'files' for a measurement file, else the kind of preset."""
    id: str
    """Id of the measurement or preset."""
    name: str
    """File name or title."""
    size: int
    """Bytes on the disk."""
    changed: float
    """When it was stored, renamed or deleted, in seconds since 1970."""
    corrected: bool = False
    """Whether it is a measurement that is read with corrections of the user."""


@result_class
class KeptData:
    """All that is kept."""

    items: list[KeptItem]
    """Measurements and presets, the last one first."""
    deleted: list[KeptItem]
    """Those that can be restored, the last one first."""
    size: int
    """Bytes of all measurements on the disk, with deleted ones."""
    quota: int
    """Bytes that they may take at most."""


def kept(studio: Studio, store: MeasurementStore) -> KeptData:
    """Everything that the user keeps.

    Args:
        studio: for the presets.
        store: of the measurements.
    """
    own = OwnPresets(studio.library)
    kinds = cast(tuple[KeptKind, ...], studio.library.kinds)
    presets = [_of_preset(kind, preset) for kind in kinds for preset in own.own(kind)]
    restorable = [_of_preset(kind, preset) for kind in kinds for preset in own.deleted(kind)]
    return KeptData(
        _sorted([*map(_of_file, store.kept()), *presets]),
        _sorted([*map(_of_file, store.deleted()), *restorable]),
        store.size(),
        store.quota,
    )


def rename(
    studio: Studio, store: MeasurementStore, *, kind: str, identity: str, name: str, was: str | None = None
) -> None:
    """Give a measurement or preset another name; its id stays.

    Args:
        studio: for the presets.
        store: of the measurements.
        kind: of the item.
        identity: its id.
        name: the new name.
        was: the name that the user saw; None = whatever it is.

    Raises:
        InputError: code ``not_found``, there is none; code ``conflict``, it has another name by now, or
            another program changed it.
    """
    if not name.strip():
        raise InputError("the name is empty", field="name", hint="e.g. 'bench 3, 300 mm'")
    if kind == FILES:
        store.rename(identity, name, was)
    else:
        OwnPresets(studio.library).rename(kind, identity, name, was)


def delete(studio: Studio, store: MeasurementStore, *, kind: str, identity: str) -> None:
    """Delete a measurement or preset; `restore` brings it back.

    Raises:
        InputError: code ``not_found``, there is none; code ``conflict``, it comes with the program, or
            another program changed it.
    """
    if kind == FILES:
        store.delete(identity)
    else:
        OwnPresets(studio.library).delete(kind, identity)


def restore(studio: Studio, store: MeasurementStore, *, kind: str, identity: str) -> None:
    """Bring a deleted measurement or preset back.

    Raises:
        InputError: code ``not_found``, it cannot be restored; code ``conflict``, there is another one by now.
    """
    if kind == FILES:
        store.restore(identity)
    else:
        OwnPresets(studio.library).restore(kind, identity)


def _of_file(file: KeptFile) -> KeptItem:
    return KeptItem(FILES, file.id, file.name, file.size, file.changed, file.corrected)


def _of_preset(kind: KeptKind, preset: OwnPreset) -> KeptItem:
    return KeptItem(kind, preset.id, preset.title, preset.size, preset.changed)


def _sorted(items: Iterable[KeptItem]) -> list[KeptItem]:
    return sorted(items, key=lambda item: -item.changed)
