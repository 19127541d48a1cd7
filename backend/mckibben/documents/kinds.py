"""What a JSON file holds: by its ``kind``, or by the fields that only such a document has."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets import PresetLibrary


class DocumentKind(NamedTuple):
    """A kind of file.

    Attributes:
        title: what it is, with its article.
        use: the command that takes it.
        marks: fields that no other kind has; any of them tells it.
    """

    title: str
    use: str
    marks: tuple[str, ...]


# In this order: a study holds a drive or a task, a drive holds a muscle.
KINDS: dict[str, DocumentKind] = {
    "study": DocumentKind("a study", "mckibben study", ("subject", "quantities")),
    "model": DocumentKind("a saved model", "mckibben compare DATA --model", ("freed", "envelope")),
    "drive": DocumentKind("a drive", "mckibben simulate", ("valve", "command", "controller")),
    "joint": DocumentKind("a joint", "mckibben joint", ("muscles",)),
    "task": DocumentKind("a sizing task", "mckibben size", ("stroke", "catalogue", "rank_by")),
    "muscle": DocumentKind(
        "a muscle",
        "mckibben curves --muscle",
        ("preset", "nominal_length", "inside_diameter", "braid_angle", "thread_length", "rhombus"),
    ),
    "measurement": DocumentKind("a measurement", "mckibben diagnose", ()),
}
_TABLES = (
    ".csv",
    ".txt",
    ".tsv",
    ".dat",
    ".xlsx",
    ".xls",
    ".ods",
    ".mat",
    ".h5",
    ".hdf5",
    ".tdms",
    ".parquet",
)


def kind_of(content: object) -> str | None:
    """The kind of a document, None where it cannot be told."""
    if not isinstance(content, dict):
        return None
    if isinstance(stated := content.get("kind"), str):
        return stated
    return next((name for name, kind in KINDS.items() if any(mark in content for mark in kind.marks)), None)


def is_preset(content: object) -> bool:
    """Whether a document is that of a preset, which holds the drive or task inside."""
    return isinstance(content, dict) and "kind" in content and "document" in content


def refuse_table(path: str, wanted: str) -> None:
    """Refuse the file of a measurement where a document is wanted.

    Raises:
        InputError: its ending is one of tables.
    """
    if path.lower().endswith(_TABLES):
        raise _wrong("measurement", path, wanted)


def refuse_other(content: object, source: str, wanted: Iterable[str]) -> None:
    """Refuse a document of another kind than is wanted.

    Args:
        content: what the file holds.
        source: name of the file, "" where the caller says it.
        wanted: the kinds that can be used, the one that is meant first.

    Raises:
        InputError: it is of another known kind; says which, and what takes it.
    """
    first, *others = wanted
    found = kind_of(content)
    if found is not None and found not in (first, *others):
        raise _wrong(found, source, first)


def no_such(name: str, wanted: str, library: PresetLibrary) -> InputError:
    """The refusal of a name that is neither a file nor the id of a preset of a kind.

    Args:
        name: what was named.
        wanted: the kind.
        library: of the presets; one of another kind is said to be one.
    """
    for folder in library.kinds:
        found = "mystery" if folder == "mysteries" else folder.removesuffix("s")
        if found != wanted and library.is_built_in(folder, name):
            return _wrong(found, name, wanted)
    known = [preset.id for preset in library.list(f"{wanted}s")]
    return InputError(
        f"{name[:80]}: there is no such file and no such {wanted} preset", hint=did_you_mean(name[:80], known)
    )


def _wrong(found: str, source: str, wanted: str) -> InputError:
    kind = KINDS.get(found) or DocumentKind(f"a preset of the kind '{found[:40]}'", "mckibben presets", ())
    place = f"{source}: " if source else ""
    return InputError(
        f"{place}this is {kind.title}, not {KINDS[wanted].title}", hint=f"use {kind.use}", code="wrong_kind"
    )
