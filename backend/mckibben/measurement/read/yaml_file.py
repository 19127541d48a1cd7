"""The common part of YAML as a document: indented names, lists of dashes, lists and objects in brackets."""

from __future__ import annotations

import json
import re
from typing import Any

_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_KEY = re.compile(r"""(?P<key>"[^"]*"|'[^']*'|[^\s\[\]{},#:"'][^:#]*?)\s*:(?:\s+(?P<value>.*))?""")
_DEEPEST = 40
_LONGEST_FLOW = 20_000  # characters of lists in lists that are no JSON


class YamlError(ValueError):
    """A line that is not of the common part."""

    def __init__(self, line: int) -> None:
        super().__init__(f"line {line}")
        self.line = line


def document_of_yaml(text: str) -> tuple[Any, list[str]]:
    """(the document, its comments).

    Raises:
        YamlError: a line that is not understood.
    """
    comments: list[str] = []
    lines: list[tuple[int, int, str]] = []
    pending: list[str] = []
    indent = opened = 0
    for number, raw in enumerate(text.expandtabs(2).split("\n"), start=1):
        line, comment = _without_comment(raw)
        comments += [comment] if comment else []
        if not line.strip() or line.strip() in ("---", "...") or line.startswith("%YAML"):
            continue
        if not pending:
            indent, opened = len(line) - len(line.lstrip()), 0
        pending.append(line.strip())
        opened += _open_brackets(line)
        if opened <= 0:
            lines.append((number, indent, " ".join(pending)))
            pending = []
    if pending or not lines:
        raise YamlError(lines[-1][0] if lines else 1)
    reader = _Reader(lines)
    document = reader.block(lines[0][1], 0)
    if reader.at < len(lines):
        raise YamlError(lines[reader.at][0])
    return document, comments


def documents_of_yaml(text: str) -> list[dict[str, Any]] | None:
    """The objects of a text of several documents, each ended by ``---``; None = it is no such text.

    The last one may be cut off where the recording was stopped.
    """
    parts = [part for part in re.split(r"(?m)^---[ \t]*$", text) if part.strip()]
    found: list[dict[str, Any]] = []
    for number, part in enumerate(parts, start=1):
        try:
            document, _ = document_of_yaml(part)
        except YamlError:
            if number == len(parts) and number > 1:
                break
            return None
        if not isinstance(document, dict):
            return None
        found.append(document)
    if len(found) > 1 and found[-1].keys() != found[-2].keys():
        found.pop()
    return found


def _without_comment(line: str) -> tuple[str, str]:
    quoted = ""
    for position, character in enumerate(line):
        if character in "\"'" and quoted in ("", character):
            quoted = "" if quoted else character
        elif character == "#" and not quoted and (position == 0 or line[position - 1].isspace()):
            return line[:position].rstrip(), line[position:].strip("# ")
    return line.rstrip(), ""


def _open_brackets(text: str) -> int:
    bare = re.sub(r"\"[^\"]*\"|'[^']*'", "", text)
    return sum(bare.count(c) for c in "[{") - sum(bare.count(c) for c in "]}")


class _Reader:
    """Reads indented blocks; ``at`` is the next line."""

    def __init__(self, lines: list[tuple[int, int, str]]) -> None:
        self._lines = lines
        self.at = 0

    def block(self, indent: int, depth: int) -> Any:
        """The object, list or value that begins at the next line with this indent."""
        if depth > _DEEPEST:
            raise YamlError(self._lines[self.at][0])
        number, _, text = self._lines[self.at]
        if text == "-" or text.startswith("- "):
            return self._list(indent, depth)
        if _KEY.fullmatch(text):
            return self._object(indent, depth)
        self.at += 1
        return _value(text, number)

    def _list(self, indent: int, depth: int) -> list[Any]:
        items: list[Any] = []
        while self.at < len(self._lines):
            number, here, text = self._lines[self.at]
            if here != indent or not (text == "-" or text.startswith("- ")):
                break
            rest = text[1:].strip()
            if not rest:
                self.at += 1
                items.append(self._inner(indent, depth))
            elif (_KEY.fullmatch(rest) or rest.startswith("- ")) and rest[0] not in "[{":
                self._lines[self.at] = (number, indent + len(text) - len(rest), rest)
                items.append(self.block(self._lines[self.at][1], depth + 1))
            else:
                self.at += 1
                items.append(_value(rest, number))
        return items

    def _object(self, indent: int, depth: int) -> dict[str, Any]:
        found: dict[str, Any] = {}
        while self.at < len(self._lines):
            number, here, text = self._lines[self.at]
            if here != indent:
                break
            match = _KEY.fullmatch(text)
            if match is None:
                raise YamlError(number)
            key = match["key"].strip().strip("\"'")
            self.at += 1
            value = (match["value"] or "").strip()
            if value in ("|", ">", "|-", ">-"):
                found[key] = self._folded(indent)
            else:
                found[key] = _value(value, number) if value else self._inner(indent, depth, dashed=True)
        return found

    def _inner(self, indent: int, depth: int, *, dashed: bool = False) -> Any:
        """What stands below a name or a dash; dashes may stand as far left as the name."""
        if self.at >= len(self._lines):
            return None
        _, here, text = self._lines[self.at]
        if here > indent or (dashed and here == indent and text.startswith("-")):
            return self.block(here, depth + 1)
        return None

    def _folded(self, indent: int) -> str:
        words = []
        while self.at < len(self._lines) and self._lines[self.at][1] > indent:
            words.append(self._lines[self.at][2])
            self.at += 1
        return " ".join(words)


def _value(text: str, number: int) -> Any:
    """A number, truth, text, or a list or object in brackets."""
    if text[:1] in ("[", "{"):
        try:
            return json.loads(text)
        except ValueError:
            pass
        if len(text) > _LONGEST_FLOW and re.search(r"[\[{\"']", text[1:]) is not None:
            raise YamlError(number)
        value, rest = _flow(text, number, 0)
        if rest.strip():
            raise YamlError(number)
        return value
    return _scalar(text)


def _scalar(text: str) -> Any:
    bare = text.strip()
    if bare[:1] in "\"'" and bare[-1:] == bare[:1] and len(bare) > 1:
        return bare[1:-1]
    if _NUMBER.fullmatch(bare):
        return float(bare)
    if bare.lower() in (".nan", "nan"):
        return float("nan")
    return {"null": None, "~": None, "": None, "true": True, "false": False}.get(bare.lower(), bare)


def _flow(text: str, number: int, depth: int) -> tuple[Any, str]:
    """(value, what stands behind it) of a list or object in brackets."""
    if depth > _DEEPEST:
        raise YamlError(number)
    text = text.lstrip()
    if text[:1] == "[":
        items: list[Any] = []
        rest = text[1:].lstrip()
        plain = rest.partition("]")[0]
        if not re.search(r"[\[{\"']", plain):  # a long list of numbers at once
            cells = [cell for cell in plain.split(",") if cell.strip()]
            return [_scalar(cell) for cell in cells], rest[len(plain) + 1 :]
        while rest and rest[0] != "]":
            item, rest = _flow(rest, number, depth + 1)
            items.append(item)
            rest = rest.lstrip().removeprefix(",").lstrip()
        if not rest:
            raise YamlError(number)
        return items, rest[1:]
    if text[:1] == "{":
        found: dict[str, Any] = {}
        rest = text[1:].lstrip()
        while rest and rest[0] != "}":
            key = re.match(r"""("[^"]*"|'[^']*'|[^:,{}\[\]]+?)\s*:\s*""", rest)
            if key is None:
                raise YamlError(number)
            found[key[1].strip("\"' ")], rest = _flow(rest[key.end() :], number, depth + 1)
            rest = rest.lstrip().removeprefix(",").lstrip()
        if not rest:
            raise YamlError(number)
        return found, rest[1:]
    quoted = re.match(r"""("[^"]*"|'[^']*')""", text)
    plain_end = quoted.end() if quoted else re.match(r"[^,\]}]*", text).end()  # type: ignore
    return _scalar(text[:plain_end]), text[plain_end:]
