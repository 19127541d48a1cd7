"""What the user keeps on the disk: measurements and presets, their sizes, and what can be restored."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from mckibben.documents.studio import Studio
from mckibben.measurement.store import KeptFile, MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.presets.own import OwnPreset, OwnPresets

#: The kind of an item that is a measurement file; presets have the kind of their folder.
FILES = "files"


@dataclass(frozen=True, slots=True)
class KeptItem:
    """A measurement file or a preset of the user.

    Attributes:
        kind: "files", or the kind of preset.
        id: of the measurement or preset.
        name: for people: file name or title.
        size: on the disk [bytes].
        changed: when it was stored, renamed or deleted [s since 1970].
        corrected: whether it is a measurement that is read with corrections of the user.
    """

    kind: str
    id: str
    name: str
    size: int
    changed: float
    corrected: bool = False


@dataclass(frozen=True, slots=True)
class KeptData:
    """All that is kept.

    Attributes:
        items: the measurements and presets, the last one first.
        deleted: those that can be restored, the last one first.
        size: of all measurements on the disk, with deleted ones [bytes].
        quota: most that they may take [bytes].
    """

    items: list[KeptItem]
    deleted: list[KeptItem]
    size: int
    quota: int


def kept(studio: Studio, store: MeasurementStore) -> KeptData:
    """Everything that the user keeps.

    Args:
        studio: for the presets.
        store: of the measurements.
    """
    own = OwnPresets(studio.library)
    kinds = studio.library.kinds
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


def _of_preset(kind: str, preset: OwnPreset) -> KeptItem:
    return KeptItem(kind, preset.id, preset.title, preset.size, preset.changed)


def _sorted(items: Iterable[KeptItem]) -> list[KeptItem]:
    return sorted(items, key=lambda item: -item.changed)
