"""Files of a preset folder that are not read because of where they lie or how they are named."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple, get_args

from mckibben.physics.errors import did_you_mean
from mckibben.presets.quantity import Finding
from mckibben.presets.reading import KINDS, BadDocumentError, read_file

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
