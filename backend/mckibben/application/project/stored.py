"""What the user keeps on the disk: measurements and presets, what can be restored, and the space of it all.

There is one ledger of space: measurements, projects with their versions, rows of studies, presets.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeVar, cast

from mckibben.application.diagnose.kept import DiagnosisStore
from mckibben.application.study.store import StudyStore
from mckibben.documents.studio import Studio
from mckibben.facts.result import result_class
from mckibben.folder import DiskFullError, free_space
from mckibben.measurement.store import KeptFile, MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.presets.own import OwnPreset, OwnPresets

if TYPE_CHECKING:
    from mckibben.projects.store import ProjectStore

T = TypeVar("T")
SpaceKind = Literal["measurements", "projects", "studies", "diagnoses", "presets"]
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
class KeptSpace:
    """What one kind of what is kept takes on the disk."""

    kind: SpaceKind
    """'measurements', 'projects' with all versions, 'presets'; 'studies' and 'diagnoses' are results."""
    taken: int
    """Bytes, with what can be restored."""
    restorable: int
    """Bytes of it that can be erased without losing anything but what can be restored or made again."""
    quota: int
    """Bytes that they may take at most."""


@result_class
class KeptData:
    """All that is kept."""

    items: list[KeptItem]
    """Measurements and presets, the last one first."""
    deleted: list[KeptItem]
    """Those that can be restored, the last one first."""
    space: list[KeptSpace]
    """What each kind takes; without projects where their database does not answer."""
    free: int | None
    """Bytes that the disk has left; None = not known."""


@dataclass(frozen=True)
class Space:
    """Everything that is kept, and what it takes.

    Attributes:
        studio: for the presets.
        store: of the measurements.
        studies, diagnoses: rows and answers that can be made again.
        projects: opens their database.
    """

    studio: Studio
    store: MeasurementStore
    studies: StudyStore
    diagnoses: DiagnosisStore
    projects: Callable[[], ProjectStore]

    def ledger(self) -> list[KeptSpace]:
        """What each kind takes; without projects where their database does not answer."""
        presets = OwnPresets(self.studio.library).size()
        found = [
            KeptSpace(
                "measurements", self.store.size(), self.store.restorable(), self.store.quotas.measurements
            ),
            *(
                KeptSpace(kind, size, size, store.quota)
                for kind, store in self._made_again().items()
                for size in [store.size()]
            ),
            KeptSpace("presets", *presets, self.studio.library.quota),
        ]
        try:
            projects = self.projects()
            found.insert(1, KeptSpace("projects", *projects.size(), projects.quota))
        except InputError:
            pass
        return found

    def _made_again(self) -> dict[SpaceKind, StudyStore | DiagnosisStore]:
        return {"studies": self.studies, "diagnoses": self.diagnoses}

    def erase(self, kind: SpaceKind) -> None:
        """Erase what was deleted of a kind; all studies or diagnoses, which are made again when needed."""
        if kind == "measurements":
            self.store.empty_bin()
        elif kind == "presets":
            OwnPresets(self.studio.library).empty_bin()
        elif kind in self._made_again():
            self._made_again()[kind].erase()
        else:
            self.projects().empty_bin()

    def with_room(self, work: Callable[[], T]) -> T:
        """What the work returns; where the disk is full, once more after all bins have been emptied.

        Files go first: a database on a full disk cannot erase anything.
        """
        try:
            return work()
        except DiskFullError:
            self.erase("measurements")
            self.erase("presets")
            self.erase("projects")
            return work()


def kept(studio: Studio, store: MeasurementStore, space: Space) -> KeptData:
    """Everything that the user keeps.

    Args:
        studio: for the presets.
        store: of the measurements.
        space: what all of it takes.
    """
    own = OwnPresets(studio.library)
    kinds = cast(tuple[KeptKind, ...], studio.library.kinds)
    presets = [_of_preset(kind, preset) for kind in kinds for preset in own.own(kind)]
    restorable = [_of_preset(kind, preset) for kind in kinds for preset in own.deleted(kind)]
    return KeptData(
        _sorted([*map(_of_file, store.kept()), *presets]),
        _sorted([*map(_of_file, store.deleted()), *restorable]),
        space.ledger(),
        free_space(store.data),
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


def delete(studio: Studio, store: MeasurementStore, *, kind: str, identity: str, erase: bool) -> None:
    """Delete a measurement or preset; `restore` brings it back, unless it shall be erased at once.

    Raises:
        InputError: code ``not_found``, there is none; code ``conflict``, it comes with the program, or
            another program changed it.
    """
    if kind == FILES:
        store.delete(identity, erase=erase)
    else:
        OwnPresets(studio.library).delete(kind, identity, erase=erase)


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
