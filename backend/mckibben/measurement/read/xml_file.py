"""Measurements from XML: elements of readings, lists of numbers, rows of cells, and what stands beside them.

Elements become objects of their attributes and children; those of one name in one element become a list.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import Any
from xml.etree.ElementTree import Element, ParseError, XMLParser

from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.json_file import open_document
from mckibben.measurement.read.source import RawTable
from mckibben.physics.errors import InputError

_MOST_ELEMENTS = 1_000_000
_DEEPEST = 40
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_LIST = re.compile(rf"\s*{_NUMBER.pattern}(?:[\s,;]+{_NUMBER.pattern})+\s*")
_VALUE = "value"  # the text of an element beside its attributes


def is_xml(text: str) -> bool:
    """Whether a text begins as XML that is no web page."""
    begin = text[:2000].lstrip("\ufeff \t\r\n")
    return begin.startswith("<?xml") or (
        re.match(r"<[A-Za-z][\w.:-]*[\s>/]", begin) is not None and not is_html(text)
    )


def is_html(text: str) -> bool:
    """Whether a text is a web page, or a table of one."""
    return (
        re.match(
            r"(?is)\s*(?:<\?xml.{0,200}?\?>\s*)?(?:<!--.{0,500}?-->\s*)*<(?:!doctype\s+html|html|table|body|head)\b",
            text[:2000],
        )
        is not None
    )


def open_xml(text: str, name: str, correction: Correction | None = None) -> RawTable:
    """The table of an XML text.

    Raises:
        InputError: damaged, with definitions of its own, too large, or without a table.
    """
    if "<!ENTITY" in text or "<!DOCTYPE" in text:
        raise InputError(
            f"{name}: the XML text defines entities of its own, which are not read", field="file",
            hint="export it without a DOCTYPE, or as CSV",
        )  # fmt: skip
    if text.count("<") > 2 * _MOST_ELEMENTS:
        raise InputError(
            f"{name}: the XML text has more than {_MOST_ELEMENTS} elements, more than can be read",
            field="file", hint="save it as CSV",
        )  # fmt: skip
    parser = XMLParser()
    try:
        parser.feed(re.sub(r"^\s*<\?xml[^>]*\?>", "", text.lstrip("\ufeff"), count=1))
        root = parser.close()
    except ParseError as error:
        line, _ = error.position
        raise InputError(
            f"{name}, row {line}: the XML text is damaged ({error.msg if hasattr(error, 'msg') else error})",
            field=f"row {line}", hint="export it again, or save it as CSV",
        ) from error  # fmt: skip
    found = _object(root, 0)
    document = found if isinstance(found, dict) else {_tag(root): found}
    source = open_document(document, name, correction)
    return source


def _tag(element: Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _object(element: Element, depth: int) -> Any:
    """An element as an object, a list, a number or a text."""
    if depth > _DEEPEST:
        return None
    result: dict[str, Any] = {key.rpartition("}")[2]: _plain(text) for key, text in element.attrib.items()}
    children = [(_tag(child), _object(child, depth + 1)) for child in element]
    counts = Counter(tag for tag, _ in children)
    text = _text(element.text or "")
    if not children:
        if not result:
            return text
        if text != "":
            result["values" if isinstance(text, list) else _VALUE] = text
        return result
    if len(counts) == 1 and len(children) > 1 and not result:
        return [value for _, value in children]
    for tag, value in children:
        if counts[tag] == 1:
            result[tag if tag not in result else f"{tag} element"] = value
        elif tag in result and isinstance(result[tag], list):
            result[tag].append(value)
        else:
            result[tag] = [value]
    return result


def _plain(text: str) -> Any:
    """A number where a text is one, else the text."""
    bare = text.strip()
    return float(bare) if _NUMBER.fullmatch(bare) else bare


def _text(text: str) -> Any:
    """A list of numbers, a number, or the text."""
    if _LIST.fullmatch(text):
        return [float(number) for number in re.split(r"[\s,;]+", text.strip())]
    return _plain(text)
