"""Commands that reproduce the figures of a report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from mckibben.report.document import code, paragraph
from mckibben.report.html import Child, Html, html


@dataclass(frozen=True)
class Command:
    """Command lines, the files they need (name -> text), and remarks on what they do not cover."""

    lines: Sequence[str]
    files: Mapping[str, str] = field(default_factory=dict)
    notes: Sequence[str] = ()


def command_section(command: Command) -> Html:
    """Command lines and files, ready to copy."""
    parts: list[Child] = [code("\n".join(command.lines))]
    for name, text in command.files.items():
        parts += [paragraph(name, ":"), code(text)]
    parts += [paragraph(note, note=True) for note in command.notes]
    return html(parts)
