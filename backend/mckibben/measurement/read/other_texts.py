"""Texts that are no delimited tables: XML, web pages, YAML, TOML, scripts with vectors written out."""

from __future__ import annotations

import re
import tomllib
from dataclasses import replace
from pathlib import PurePath

from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.html_file import text_of_html
from mckibben.measurement.read.json_file import open_document
from mckibben.measurement.read.latex_file import is_latex, text_of_latex
from mckibben.measurement.read.mat import choose
from mckibben.measurement.read.script_file import vectors_of_script
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.xml_file import is_html, is_xml, open_xml
from mckibben.measurement.read.yaml_file import YamlError, document_of_yaml, documents_of_yaml
from mckibben.physics.errors import InputError

_LONGEST = 30_000_000  # characters
_LONGEST_SLOW = 8_000_000  # of web pages and YAML
#: Messages printed one after the other, as ``rostopic echo`` does.
_DOCUMENT_ENDS = re.compile(r"(?m)^---[ \t]*$")
_FEWEST_DOCUMENTS = 3
_SCRIPTS = re.compile(
    r"(?m)^[ \t]*[A-Za-z_][^\n=<:]{0,60}(?:=|<-|:=)[ \t]*[A-Za-z_.]*[ \t]*[\[({]+\s*[-+.0-9]"
)


def other_text(text: str, name: str, correction: Correction) -> tuple[str, RawTable | None]:
    """(the text as lines of a table, its source where it is read already).

    Raises:
        InputError: a text of such a kind that is damaged or holds no table.
    """
    if len(text) > _LONGEST:
        return text, None
    begin = text[:4000].lstrip("\ufeff \t\r\n")
    if begin[:1] == "<":
        if is_html(text):
            _check_length(text, name, "web page")
            return text_of_html(text), None
        return (text, open_xml(text, name, correction)) if is_xml(text) else (text, None)
    if is_latex(text):
        return text_of_latex(text), None
    if len(_DOCUMENT_ENDS.findall(text)) >= _FEWEST_DOCUMENTS and len(text) <= _LONGEST_SLOW:
        records = documents_of_yaml(text)
        if records is not None:
            return text, open_document(records, name, correction)
    suffix = PurePath(name).suffix.lower()
    if suffix in (".yaml", ".yml"):
        _check_length(text, name, "YAML text")
    if suffix in (".yaml", ".yml") or re.match(r"(?:%YAML[^\n]*\n)?---\s*\n\s*[^\s,;]+:", begin):
        return text, _of_yaml(text, name, correction)
    if suffix == ".toml":
        try:
            return text, open_document(tomllib.loads(text), name, correction)
        except tomllib.TOMLDecodeError as error:
            raise InputError(
                f"{name}: the TOML text is damaged ({error})", field="file", hint="save it as CSV"
            ) from error
    if _SCRIPTS.search(text[:200_000]) is not None and (found := vectors_of_script(text)) is not None:
        values, remarks = found
        return text, replace(choose(values, name, correction, remarks), format="csv")
    return text, None


def _check_length(text: str, name: str, what: str) -> None:
    """Refuse a text of a kind that is read slowly."""
    if len(text) > _LONGEST_SLOW:
        raise InputError(
            f"{name}: the {what} has {len(text)} characters, at most {_LONGEST_SLOW} are read", field="file",
            hint="save the table as CSV",
        )  # fmt: skip


def _of_yaml(text: str, name: str, correction: Correction) -> RawTable | None:
    try:
        document, comments = document_of_yaml(text)
    except YamlError as error:
        if PurePath(name).suffix.lower() not in (".yaml", ".yml"):
            return None
        raise InputError(
            f"{name}, row {error.line}: the line is not understood as YAML", field=f"row {error.line}",
            hint="plain names, lists and numbers, or save it as CSV or JSON",
        ) from error  # fmt: skip
    if not isinstance(document, (dict, list)):
        return None
    if comments and isinstance(document, dict):
        document = {**{f"comment {n}": comment for n, comment in enumerate(comments[:40], 1)}, **document}
    return open_document(document, name, correction)
