"""The preset library: scans folders, loads valid presets, reports invalid files, saves the user's muscles."""

from __future__ import annotations

import builtins
import json
import os
import re
import tempfile
import threading
from collections.abc import Hashable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, cast, get_args

from mckibben.facts.result import result_class
from mckibben.folder import QUOTAS, is_full, locked, no_space
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets.quantity import Finding
from mckibben.presets.reading import KINDS, MAX_BYTES, BadDocumentError, parse, read_file, slug
from mckibben.presets.schema import EffectTable, MusclePreset, Origin, Preset

_MOST = 20  # files that are told
#: What a document says of its kind -> the folder of such documents.
_FOLDERS = {get_args(model.model_fields["kind"].annotation)[0]: folder for folder, model in KINDS.items()}


class Stray(NamedTuple):
    """A file that is not read: where it lies, the kind it most likely belongs to, what is wrong."""

    file: str
    kind: str
    finding: Finding


def strays(root: Path) -> list[Stray]:
    """The JSON files directly in the folder, in folders that are of no kind, and with another ending."""
    return [stray for stray, _ in zip(_strays(root), range(_MOST), strict=False)]


def _strays(root: Path) -> Iterator[Stray]:
    for path in _entries(root):
        if path.is_dir():
            for file in _entries(path):
                if path.name not in KINDS and file.suffix.lower() == ".json":
                    yield _misplaced(f"{path.name}/{file.name}", file, f"'{path.name}' is no kind of preset")
                elif path.name in KINDS and file.suffix.lower() == ".json" != file.suffix:
                    finding = Finding(None, f"ends in '{file.suffix}'", f"rename it to {file.stem}.json")
                    yield Stray(f"{path.name}/{file.name}", path.name, finding)
        elif path.suffix.lower() == ".json":
            yield _misplaced(path.name, path, "lies in no folder of a kind")


def _misplaced(name: str, path: Path, why: str) -> Stray:
    """A file that belongs into another folder: the one its document says, else the nearest by name."""
    try:
        document = read_file(path, follow_links=False)
    except BadDocumentError:
        document = None
    said = document.get("kind") if isinstance(document, dict) else None
    folder = _FOLDERS.get(said) if isinstance(said, str) else None
    if folder is not None:
        return Stray(name, folder, Finding(None, why, f"put it into {folder}/"))
    hint = did_you_mean(path.parent.name, KINDS) if "/" in name else None
    return Stray(name, "muscles", Finding(None, why, hint or f"put it into one of {', '.join(KINDS)}"))


def _entries(folder: Path) -> list[Path]:
    """What a folder holds, by name, without hidden files; nothing where it cannot be looked into."""
    try:
        return sorted(path for path in folder.iterdir() if not path.name.startswith("."))
    except OSError:
        return []


USER_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9-]{0,63}")

Signature = tuple[tuple[str, int, int, int], ...]


@result_class
class LibraryProblem:
    """A preset file that was not loaded."""

    file: str
    """The file."""
    field: str | None
    """Path of the field inside it."""
    message: str
    """What is wrong."""
    hint: str | None = None
    """What would be right."""


@dataclass
class _Shelf:
    """The valid presets of one folder, by lower-case slug, and the problems of the others."""

    presets: dict[str, Preset] = field(default_factory=dict)
    problems: list[LibraryProblem] = field(default_factory=list)


#: Folder, state of its files and effects that they were checked against -> shelf of each kind.
_SHARED: dict[Hashable, dict[str, _Shelf]] = {}
_MOST_SHARED = 4


def _hashable(effects: EffectTable) -> Hashable:
    return tuple(
        (name, *(table.items() if isinstance(table, Mapping) else table)) for name, table in effects.items()
    )


class PresetLibrary:
    """Presets of a built-in folder, and optionally of a second one for the user's own.

    Args:
        folder: holds one folder per kind (``muscles/``, ``valves/``, …) of ``<id>.json`` files.
        user_folder: same layout; created when the first preset is saved. None: saving is refused.
        effects: effect id -> parameters, to check the default effects of muscles; None: not checked.

    Raises:
        FileNotFoundError: ``folder`` does not exist.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        user_folder: str | os.PathLike[str] | None = None,
        effects: EffectTable | None = None,
    ) -> None:
        self._folder = Path(folder)
        if not self._folder.is_dir():
            raise FileNotFoundError(f"there is no preset folder {self._folder}")
        self.user_folder = None if user_folder is None else Path(user_folder)
        self.effects = effects
        #: Most bytes that the user's presets may take, with those that can be restored.
        self.quota = QUOTAS.presets
        self._lock = threading.RLock()
        self._built_in = self._shelves()
        self._user = {kind: _Shelf() for kind in KINDS}
        self._signatures: dict[str, Signature] = dict.fromkeys(KINDS, ())
        #: Kind -> the user's files as they were when somebody last looked at them here.
        self._seen = {kind: self._files_of(kind) for kind in KINDS}

    @property
    def kinds(self) -> tuple[str, ...]:
        """Names of the kinds: muscles, valves, …"""
        return tuple(KINDS)

    def list(self, kind: str) -> builtins.list[Preset]:
        """All valid presets of a kind, sorted by id with numbers in their natural order.

        Raises:
            InputError: code ``not_found``, there is no such kind.
        """
        with self._lock:
            presets = self._all(kind)
            self._seen[kind] = self._signatures[kind]
        return sorted(presets.values(), key=lambda preset: _natural(preset.id))

    def get(self, kind: str, preset_id: str) -> Preset:
        """One preset; letter case does not matter, and ``-`` may stand for ``/`` as in the file name.

        Raises:
            InputError: code ``not_found``, with the nearest known id as hint.
        """
        if self.is_built_in(kind, preset_id):  # wins over any file of the user: no need to look there
            return self._built_in[kind].presets[slug(preset_id).lower()]
        presets = self._all(kind)
        match = presets.get(slug(preset_id).lower())
        if match is None:
            known = [preset.id for preset in presets.values()]
            self._raise_refused(kind, preset_id)
            raise InputError(
                f"there is no preset '{preset_id[:80]}' among the {kind}",
                hint=did_you_mean(preset_id[:80], known),
                code="not_found",
            )
        return match

    def _raise_refused(self, kind: str, preset_id: str) -> None:
        """Say why the preset of this id is not there, if there is a file of its name that was refused."""
        wanted = slug(preset_id).lower()
        for problem in self._built_in[kind].problems + self._user[kind].problems:
            if Path(problem.file).stem.lower() == wanted:
                where = f"{problem.file}, {problem.field}" if problem.field else problem.file
                raise InputError(
                    f"the preset '{preset_id[:80]}' cannot be used: {where}: {problem.message}",
                    hint=problem.hint,
                    code="not_found",
                )

    def is_built_in(self, kind: str, preset_id: str) -> bool:
        """Whether a preset comes with the program; reads no file."""
        return kind in self._built_in and slug(preset_id).lower() in self._built_in[kind].presets

    def muscle(self, preset_id: str) -> MusclePreset:
        """`get` for muscles, typed."""
        preset = self.get("muscles", preset_id)
        return cast(MusclePreset, preset)

    def problems(self, kind: str | None = None) -> builtins.list[LibraryProblem]:
        """Files that were not loaded, of one kind or of all; with those of the user that lie elsewhere."""
        kinds = KINDS if kind is None else [kind]
        for name in kinds:
            self._refresh(name)
        found = [] if self.user_folder is None else strays(self.user_folder)
        return [
            problem
            for name in kinds
            for shelf in (self._built_in, self._user)
            for problem in shelf[name].problems
        ] + [LibraryProblem(f"user/{stray.file}", *stray.finding) for stray in found if stray.kind in kinds]

    def save_muscle(self, document: dict[str, Any]) -> MusclePreset:
        """Save a muscle of the user; replaces a user preset of the same id, never a built-in one.

        Raises:
            InputError: the document is not a valid muscle preset (``field`` says where); code ``conflict``:
                there is no user folder, or the id belongs to a built-in preset.
        """
        if self.user_folder is None:
            raise InputError(
                "muscles cannot be saved: no user folder is set",
                hint="start the server with a user folder",
                code="conflict",
            )
        try:
            preset = parse(MusclePreset, document, self.effects)
        except BadDocumentError as bad:
            first = bad.findings[0]
            raise InputError(first.message, field=first.field, hint=first.hint) from bad
        if USER_ID.fullmatch(preset.id) is None:
            raise InputError(
                f"'{preset.id}' cannot be the id of a user preset",
                field="id",
                hint="letters, digits and '-', e.g. 'my-muscle-20'",
            )
        content = written(preset)
        if len(content) > MAX_BYTES:
            raise InputError(f"the preset is larger than {MAX_BYTES // 1_000_000} MB")
        if (taken_space := self.own_size()) + len(content) > self.quota:
            raise no_space(
                "presets", taken=taken_space, quota=self.quota, needs=len(content), folder=self.user_folder
            )
        with self._lock:
            taken = self._all("muscles").get(preset.id.lower())
            if taken is not None and (taken.origin == "built-in" or taken.id != preset.id):
                raise InputError(
                    f"the id '{taken.id}' is taken by a {taken.origin} preset",
                    field="id",
                    hint="choose another id",
                    code="conflict",
                )
            with self.changing("muscles", f"{preset.id}.json") as folder:
                write(folder, f"{preset.id}.json", content)
            saved = self.muscle(preset.id)
        return saved

    def own_size(self) -> int:
        """What the presets of the user take on the disk, without those that can be restored [bytes]."""
        return sum(entry[2] for kind in KINDS for entry in self._files_of(kind))

    def own_file(self, kind: str, preset_id: str) -> Path:
        """The file of a preset of the user.

        Raises:
            InputError: there is none of this id; code ``conflict``: it comes with the program.
        """
        preset = self.get(kind, preset_id)
        if self.user_folder is None or preset.origin != "user":
            raise InputError(
                f"'{preset.id}' comes with the program",
                field="id",
                hint="only your own presets change",
                code="conflict",
            )
        return self.user_folder / kind / f"{slug(preset.id)}.json"

    def load_own(self, kind: str, path: Path) -> Preset:
        """A preset of the user from a file.

        Raises:
            BadDocumentError: it is none.
        """
        return self._load(kind, path, "user")

    @contextmanager
    def changing(self, kind: str, name: str) -> Iterator[Path]:
        """The user's folder of a kind, in which no other program writes meanwhile.

        Raises:
            InputError: code ``conflict``: another program has changed the file since it was last looked at
                here, or the folder cannot be written.
        """
        root = self.user_folder
        assert root is not None  # noqa: S101 - the callers have looked
        try:
            _refuse_link(root, kind)  # before the lock, which is a file in that folder
            with self._lock, locked(root / kind):
                _refuse_link(root, kind)
                now, seen = (
                    {entry[0]: entry for entry in signature}
                    for signature in (self._files_of(kind), self._seen[kind])
                )
                # A link is not a preset, so that nobody has looked at it; it is replaced.
                if name in now and now[name] != seen.get(name) and not (root / kind / name).is_symlink():
                    raise InputError(
                        f"another program has changed '{Path(name).stem}' in the meantime",
                        field="id",
                        hint="look at it (reload the page), or choose another id",
                        code="conflict",
                    )
                yield root / kind
                self._seen[kind] = tuple(
                    entry for entry in self._files_of(kind) if entry[0] == name or seen.get(entry[0]) == entry
                )
        except (FileNotFoundError, FileExistsError):
            raise
        except OSError as error:
            if is_full(error):
                raise no_space("presets", taken=self.own_size(), quota=self.quota, folder=root) from error
            raise InputError(
                f"the preset cannot be written: {error.strerror or error}", code="conflict"
            ) from error

    def _files_of(self, kind: str) -> Signature:
        return () if self.user_folder is None else _signature(self.user_folder / kind)

    def _all(self, kind: str) -> dict[str, Preset]:
        self._refresh(kind)
        return {**self._user[kind].presets, **self._built_in[kind].presets}

    def _refresh(self, kind: str) -> None:
        """Read the user's files of a kind again when one of them changed."""
        if kind not in KINDS:
            raise InputError(
                f"there is no kind of preset '{kind[:80]}'",
                hint=did_you_mean(kind[:80], KINDS),
                code="not_found",
            )
        if self.user_folder is None:
            return
        with self._lock:
            signature = _signature(self.user_folder / kind)
            if signature != self._signatures[kind]:
                self._user[kind] = self._scan(kind, "user", self._built_in[kind].presets)
                self._signatures[kind] = signature

    def _shelves(self) -> dict[str, _Shelf]:
        """The built-in presets; nothing changes them, so the libraries of a process share what they hold."""
        table = None if self.effects is None else _hashable(self.effects)
        key = (self._folder, tuple(_signature(self._folder / kind) for kind in KINDS), table)
        shelves = _SHARED.get(key)
        if shelves is None:
            shelves = {kind: self._scan(kind, "built-in", {}) for kind in KINDS}
            for oldest in list(_SHARED)[: 1 - _MOST_SHARED]:  # another thread may do the same
                _SHARED.pop(oldest, None)
            _SHARED[key] = shelves
        return shelves

    def _scan(self, kind: str, origin: Origin, taken: dict[str, Preset]) -> _Shelf:
        root = self._folder if origin == "built-in" else self.user_folder
        shelf = _Shelf()
        if root is None:
            return shelf
        for path in _files(root / kind):
            name = f"{kind}/{path.name}" if origin == "built-in" else f"user/{kind}/{path.name}"
            try:
                preset = self._load(kind, path, origin)
                key = slug(preset.id).lower()
                if key in taken or key in shelf.presets:
                    raise BadDocumentError(
                        [Finding("id", f"the id '{preset.id}' exists already", "another id")]
                    )
            except BadDocumentError as bad:
                shelf.problems.extend(LibraryProblem(name, *finding) for finding in bad.findings)
            else:
                shelf.presets[key] = preset
        return shelf

    def _load(self, kind: str, path: Path, origin: Origin) -> Preset:
        document = read_file(path, follow_links=origin == "built-in")
        preset = parse(KINDS[kind], document, self.effects)
        if slug(preset.id) != path.stem:
            raise BadDocumentError(
                [Finding("id", f"'{preset.id}' does not match the file name", f"{slug(preset.id)}.json")]
            )
        preset.adopt(origin, self.effects)
        return preset


def _natural(text: str) -> tuple[tuple[int, int, str], ...]:
    """Sort key: digits compare as numbers, so DMSP-5 comes before DMSP-10."""
    parts = re.findall(r"[0-9]+|[^0-9]+", text.lower())
    return tuple((0, int(part), "") if part.isdigit() else (1, 0, part) for part in parts)


def _files(folder: Path) -> list[Path]:
    """JSON files of a folder by name; hidden ones (half-written) are left out, a missing folder is empty."""
    try:
        return sorted(
            path for path in folder.iterdir() if path.suffix == ".json" and not path.name.startswith(".")
        )
    except OSError:
        return []


def _signature(folder: Path) -> Signature:
    """Name, time, size and inode of each file; changes when one is written."""
    result = []
    for path in _files(folder):
        try:
            info = path.lstat()
        except OSError:
            continue
        result.append((path.name, info.st_mtime_ns, info.st_size, info.st_ino))
    return tuple(result)


def written(preset: Preset) -> bytes:
    """The content of its file."""
    return json.dumps(preset.to_document(), indent=2, ensure_ascii=False).encode() + b"\n"


def write(folder: Path, name: str, content: bytes) -> None:
    """Write a file atomically: readers see the old or the new one, never a part."""
    handle, temporary = tempfile.mkstemp(dir=folder, prefix=".", suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        # Replaces a link of that name itself, not the file it points to.
        Path(temporary).replace(folder / name)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def _refuse_link(root: Path, kind: str) -> None:
    if (root / kind).resolve() != root.resolve() / kind:
        raise InputError("the user folder is a link to elsewhere", hint="a plain folder", code="conflict")
