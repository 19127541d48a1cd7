"""From a file to a preset, or to the list of its errors."""

from __future__ import annotations

import json
import math
import stat
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from types import UnionType
from typing import Any, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError

from mckibben.physics.errors import did_you_mean
from mckibben.presets.mystery import MysteryPreset
from mckibben.presets.quantity import Finding
from mckibben.presets.schema import (
    DesignPreset,
    DrivePreset,
    EffectTable,
    FittingPreset,
    MusclePreset,
    Preset,
    TaskPreset,
    TubePreset,
    ValvePreset,
)
from mckibben.presets.table import CurvePreset, MeasurementPreset

MAX_BYTES = 1_000_000
MAX_DEPTH = 32
MAX_FINDINGS = 20

#: Folder name -> model of the files in it.
KINDS: dict[str, type[Preset]] = {
    "muscles": MusclePreset,
    "valves": ValvePreset,
    "tubes": TubePreset,
    "fittings": FittingPreset,
    "measurements": MeasurementPreset,
    "curves": CurvePreset,
    "designs": DesignPreset,
    "drives": DrivePreset,
    "tasks": TaskPreset,
    "mysteries": MysteryPreset,
}


class BadDocumentError(Exception):
    """A document that cannot be used, with all errors found in it."""

    def __init__(self, findings: list[Finding]) -> None:
        super().__init__(findings[0].message)
        self.findings = findings


def slug(preset_id: str) -> str:
    """File name (without ``.json``) of a preset id; replaces the slash."""
    return preset_id.replace("/", "-")


def read_file(path: Path, *, follow_links: bool) -> object:
    """The JSON value of a file of at most `MAX_BYTES`; raises BadDocumentError for everything else.

    Of a file that ``mckibben export --as json`` wrote, it is the document inside.
    """
    try:
        mode = (path.stat() if follow_links else path.lstat()).st_mode
        if not stat.S_ISREG(mode):
            raise BadDocumentError(
                [Finding(None, "is not a plain file", "a JSON file, no link and no folder")]
            )
        with path.open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise BadDocumentError([Finding(None, f"cannot be read: {error.strerror or error}")]) from error
    if len(content) > MAX_BYTES:
        raise BadDocumentError([Finding(None, f"is larger than {MAX_BYTES // 1_000_000} MB")])
    try:
        return _inside_export(json.loads(content.decode("utf-8-sig"), object_pairs_hook=_unique))
    except UnicodeDecodeError as error:
        raise BadDocumentError([Finding(None, f"is not UTF-8 text (byte {error.start})")]) from error
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise BadDocumentError([Finding(where, f"is not JSON: {error.msg}")]) from error
    except RecursionError as error:
        raise BadDocumentError([_too_deep(None)]) from error
    except ValueError as error:  # what Python says of it is about Python
        what = "holds a number of thousands of digits"
        raise BadDocumentError([Finding(None, what, "a number below 9e18")]) from error


def _inside_export(document: object) -> object:
    """The document of an exported model, without what the file says of it; another value as it is."""
    if isinstance(document, dict) and document.get("kind") == "export":
        return document.get("document")
    return document


def parse(model: type[Preset], document: object, effects: EffectTable | None) -> Preset:
    """A validated preset of a JSON value; raises BadDocumentError with at most `MAX_FINDINGS` findings."""
    if not isinstance(document, dict):
        raise BadDocumentError([Finding(None, "is not a JSON object", '{"schema": 1, "kind": …}')])
    findings = list(_unusable(document, "", 0))
    if not findings:
        try:
            preset = model.model_validate(document)
        except ValidationError as error:
            findings = [_translate(item, model) for item in error.errors(include_url=False)]
            # A misspelt key before the key that is missing instead of it: it says more.
            findings.sort(key=lambda finding: finding.hint is None)
        else:
            findings = list(preset.findings(effects))
            if not findings:
                return preset
    raise BadDocumentError(findings[:MAX_FINDINGS])


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    result = dict(pairs)
    if len(result) < len(pairs):
        times = Counter(name for name, _ in pairs)
        twice = next(name for name in times if times[name] > 1)
        raise BadDocumentError([Finding(twice, f"'{twice}' occurs twice in one object", "each key once")])
    return result


def _too_deep(path: str | None) -> Finding:
    return Finding(path, f"is nested deeper than {MAX_DEPTH} levels")


def _unusable(value: object, path: str, depth: int) -> Iterator[Finding]:
    """Values JSON allows (or Python's reader lets through) that no field can use."""
    if depth > MAX_DEPTH:
        yield _too_deep(path)
    elif isinstance(value, dict):
        for name, item in value.items():
            yield from _text_findings(name, path)
            yield from _unusable(item, f"{path}.{name}" if path else name, depth + 1)
    elif isinstance(value, list):
        if all(type(item) in (int, float) and -(2**63) < item < 2**63 for item in value):
            return  # most of what presets hold are rows of numbers
        for index, item in enumerate(value):
            yield from _unusable(item, f"{path}.{index}", depth + 1)
    elif isinstance(value, str):
        yield from _text_findings(value, path)
    elif isinstance(value, float) and not math.isfinite(value):
        yield Finding(path, f"{value} is not a number that can be used", "a finite number")
    elif isinstance(value, int) and abs(value) >= 2**63:
        yield Finding(path, "the number is too large", "a number below 9e18")


def _text_findings(text: str, path: str) -> Iterator[Finding]:
    if not text.isascii() and any("\ud800" <= character <= "\udfff" for character in text):
        yield Finding(path or None, "holds half of a surrogate pair", "valid Unicode text")


def _translate(error: Any, model: type[BaseModel]) -> Finding:
    """A pydantic error as a finding with a dotted path and the nearest known key."""
    location = tuple(part for part in error["loc"] if part != "[key]")
    path = ".".join(map(str, location)) or None
    key = str(location[-1]) if location else ""
    match error["type"]:
        case "extra_forbidden":
            return Finding(
                path, f"'{key}' is not a known key", did_you_mean(key, _keys(model, location[:-1]))
            )
        case "missing":
            return Finding(path, f"'{key}' is missing")
        case "string_pattern_mismatch" if "[key]" in error["loc"]:
            return Finding(path, f"'{key}' is not a usable key", "lower case words joined by '_'")
    message = error["msg"].replace("Input should", "should")
    value = error.get("input")
    if isinstance(value, (str, int, float, bool)) and len(repr(value)) < 40:
        message += f" (not {value!r})"
    return Finding(path, message)


def _keys(model: Any, location: tuple[Any, ...]) -> list[str]:
    """Known keys of the object at ``location`` inside ``model``; empty where any key is allowed."""
    for part in location:
        if isinstance(model, type) and issubclass(model, BaseModel):
            fields = {info.alias or name: info.annotation for name, info in model.model_fields.items()}
            model = fields.get(part)
        else:
            model = get_args(model)[-1] if get_args(model) else None
        if get_origin(model) in (Union, UnionType):
            model = next(kind for kind in get_args(model) if kind is not type(None))
    if isinstance(model, type) and issubclass(model, BaseModel):
        return [info.alias or name for name, info in model.model_fields.items()]
    return []
