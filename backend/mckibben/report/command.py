"""Commands that reproduce the figures of a report."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from mckibben.report.document import code, paragraph
from mckibben.report.html import Child, Html, html, tag

_KILO = 1000


@dataclass(frozen=True)
class Command:
    """Command lines, the files they need (name -> text), and remarks on what they do not cover.

    ``results`` are files with the complete answers, name -> text.
    """

    lines: Sequence[str]
    files: Mapping[str, str] = field(default_factory=dict)
    notes: Sequence[str] = ()
    results: Mapping[str, str] = field(default_factory=dict)


def command_section(command: Command) -> Html:
    """Command lines to copy, and the files as attachments."""
    parts: list[Child] = [code("\n".join(command.lines))]
    for what, files in (
        ("Files the commands need, attached to this report", command.files),
        ("Complete answers with every number, attached to this report", command.results),
    ):
        if files:
            listed = [(", " if at else "", attachment(*one)) for at, one in enumerate(files.items())]
            parts.append(paragraph(f"{what} (a click in the HTML file saves them): ", *listed, "."))
    parts += [paragraph(note, note=True) for note in command.notes]
    return html(parts)


def attachment(name: str, text: str) -> Html:
    """A JSON file inside the report: its name, which a browser saves on a click, and its size.

    Args:
        name: under which it is saved.
        text: its content; UTF-8 in the file.
    """
    content = text.encode()
    size = f"{len(content)} bytes" if len(content) < _KILO else f"{len(content) / _KILO:.3g} kB"
    target = f"data:application/json;base64,{b64encode(content).decode()}"
    return html(tag("a", name, download=name, href=target), f" ({size})")
