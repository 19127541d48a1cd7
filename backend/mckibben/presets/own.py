"""The user's presets as kept data: list, rename, delete, restore."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from mckibben.folder import DELETED, delete, deleted, restore, size_of_deleted
from mckibben.physics.errors import InputError
from mckibben.presets.library import PresetLibrary, write, written
from mckibben.presets.reading import KINDS, BadDocumentError, parse, slug


class OwnPreset(NamedTuple):
    """A preset of the user: id, title, size of its file [bytes], when it was changed [s since 1970]."""

    id: str
    title: str
    size: int
    changed: float


class OwnPresets:
    """The presets of the user, as files of a folder that other programs may use at the same time.

    Args:
        library: that reads them.
    """

    def __init__(self, library: PresetLibrary) -> None:
        self._library = library

    def own(self, kind: str) -> list[OwnPreset]:
        """The user's valid presets of a kind, by id."""
        found = []
        for preset in self._library.list(kind):
            with suppress(OSError):
                if preset.origin == "user":
                    info = self._library.own_file(kind, preset.id).stat()
                    found.append(OwnPreset(preset.id, preset.title, info.st_size, info.st_mtime))
        return found

    def deleted(self, kind: str) -> list[OwnPreset]:
        """The user's presets of a kind that can be restored, the last one first."""
        found = []
        for path in [] if self._library.user_folder is None else deleted(self._library.user_folder / kind):
            with suppress(BadDocumentError, OSError):
                preset, info = self._library.load_own(kind, path), path.stat()
                found.append(OwnPreset(preset.id, preset.title, info.st_size, info.st_mtime))
        return found

    def rename(self, kind: str, preset_id: str, title: str, was: str | None = None) -> None:
        """Give a preset of the user another title.

        Raises:
            InputError: there is none of this id, the title cannot be used, or it has another one by now.
        """
        path, preset = self._library.own_file(kind, preset_id), self._library.get(kind, preset_id)
        if was is not None and preset.title != was:
            raise InputError(
                f"the preset is called '{preset.title}' by now", field="was",
                hint="reload the list", code="conflict",
            )  # fmt: skip
        try:
            renamed = parse(KINDS[kind], {**preset.to_document(), "title": title}, self._library.effects)
        except BadDocumentError as bad:
            first = bad.findings[0]
            raise InputError(first.message, field="name", hint=first.hint) from bad
        with self._library.changing(kind, path.name) as folder:
            write(folder, path.name, written(renamed))

    def size(self) -> tuple[int, int]:
        """What all presets of the user take, with what can be restored, and the latter alone [bytes]."""
        if self._library.user_folder is None:
            return 0, 0
        binned = sum(size_of_deleted(self._library.user_folder / kind) for kind in KINDS)
        return self._library.own_size() + binned, binned

    def empty_bin(self) -> None:
        """Erase what was deleted."""
        if self._library.user_folder is not None:
            for kind in KINDS:
                for path in deleted(self._library.user_folder / kind):
                    path.unlink(missing_ok=True)

    def delete(self, kind: str, preset_id: str, *, erase: bool = False) -> None:
        """Delete a preset of the user; it can be restored until its room is needed.

        Args:
            kind, preset_id: of the preset.
            erase: whether it shall be gone now, also where it was deleted before.

        Raises:
            InputError: there is none of this id; code ``conflict``: it is one of the program.
        """
        if erase and self._library.user_folder is not None and kind in KINDS:
            binned = self._library.user_folder / kind / DELETED / f"{slug(preset_id)}.json"
            if binned.is_file():
                binned.unlink()
                return
        path = self._library.own_file(kind, preset_id)
        with self._library.changing(kind, path.name):
            if erase:
                path.unlink()
                return
            delete(path)
            for old in reversed(deleted(path.parent)):
                if self.size()[0] > self._library.quota:
                    old.unlink(missing_ok=True)

    def restore(self, kind: str, preset_id: str) -> None:
        """Bring a deleted preset of the user back.

        Raises:
            InputError: it cannot be restored; code ``conflict``: there is another one of this id.
        """
        name = f"{slug(preset_id)}.json"
        if kind not in KINDS or self._library.user_folder is None or Path(name).name != name:
            raise _not_deleted(preset_id)
        try:
            with self._library.changing(kind, name) as folder:
                restore(folder, name)
        except FileNotFoundError:
            raise _not_deleted(preset_id) from None
        except FileExistsError:
            raise InputError(
                f"there is another preset '{preset_id}' by now", field="id",
                hint="delete or rename that one first", code="conflict",
            ) from None  # fmt: skip


def _not_deleted(preset_id: str) -> InputError:
    return InputError(f"there is no deleted preset '{preset_id[:80]}'", code="not_found")
