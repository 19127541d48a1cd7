"""How the figures of a report are had again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from mckibben.report.document import code, paragraph
from mckibben.report.html import Child, Html, html


@dataclass(frozen=True)
class Command:
    """Lines to type, files they need (name -> text), what they cannot say."""

    lines: Sequence[str]
    files: Mapping[str, str] = field(default_factory=dict)
    notes: Sequence[str] = ()


def command_section(command: Command) -> Html:
    """Lines and files to be copied."""
    parts: list[Child] = [code("\n".join(command.lines))]
    for name, text in command.files.items():
        parts += [paragraph(name, ":"), code(text)]
    parts += [paragraph(note, note=True) for note in command.notes]
    return html(parts)
