"""Documents on their way to JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol, runtime_checkable


@runtime_checkable
class HasDocument(Protocol):
    """A value that is written to JSON as a document: a drive, a task, an answer."""

    def to_document(self) -> Mapping[str, object]:
        """The keys and values of the document."""
        ...


@dataclass(frozen=True, slots=True)
class JsonDocument:
    """A document that is passed on as its author wrote it, with the author's units; nothing reads it here."""

    content: Mapping[str, object]

    def to_document(self) -> Mapping[str, object]:
        """The document itself."""
        return self.content

    @classmethod
    def __get_pydantic_core_schema__(cls, source: object, handler: object) -> Mapping[str, object]:
        """Any object, for the schemas of answers."""
        return {"type": "dict"}
