"""JSON schemas of an OpenAPI document in words and tables."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from mckibben.report.html import Child, Html, html, tag

Schema = dict[str, Any]

_BOUNDS = (
    ("minimum", "at least"),
    ("exclusiveMinimum", "above"),
    ("maximum", "at most"),
    ("exclusiveMaximum", "below"),
    ("maxItems", "most entries:"),
)


def type_of(schema: Schema) -> Html:
    """The type in a few words; a named schema is a link to its entry."""
    if "$ref" in schema:
        name = reference_of(schema)
        return tag("a", name, href=f"#{name}")
    if "const" in schema:
        return tag("code", json.dumps(schema["const"], ensure_ascii=False))
    if "enum" in schema:
        return _joined(tag("code", json.dumps(value, ensure_ascii=False)) for value in schema["enum"])
    for union in ("anyOf", "oneOf"):
        if union in schema:
            return _joined(type_of(part) for part in schema[union])
    kind = schema.get("type")
    if kind == "array":
        return html("list of ", type_of(schema.get("items", {})))
    if kind == "object":
        return html(schema.get("title", "object")) if "properties" in schema else _mapping(schema)
    return html(str(kind or "any"))


def _mapping(schema: Schema) -> Html:
    values = schema.get("additionalProperties") or next(
        iter(schema.get("patternProperties", {}).values()), {}
    )
    return html("object of ", type_of(values)) if isinstance(values, dict) and values else html("object")


def _joined(parts: Iterator[Html]) -> Html:
    """Alternatives, each once."""
    found: list[Child] = []
    for part in dict.fromkeys(parts):
        found += [" or ", part] if found else [part]
    return html(found)


def reference_of(schema: Schema) -> str:
    """Name of the schema that a ``$ref`` points to."""
    return schema["$ref"].rpartition("/")[2]


def unit_of(schema: Schema) -> str:
    """The SI unit of the numbers of a schema; "" without one."""
    parts = [schema, *schema.get("anyOf", []), schema.get("items", {})]
    return next((part["unit"] for part in parts if "unit" in part), "")


def properties_table(schema: Schema) -> Html:
    """Every property with type, unit and description; objects without a name of their own below it."""
    required = set(schema.get("required", ()))
    rows = [_row(name, part, name in required) for name, part in schema.get("properties", {}).items()]
    head = tag("tr", *(tag("th", text, scope="col") for text in ("Property", "Type", "Unit", "Meaning")))
    table = tag("table", tag("thead", head), tag("tbody", *rows))
    inner = [
        tag("details", tag("summary", f"{name}: {part.get('title', 'object')}"), _described(part))
        for name, within in schema.get("properties", {}).items()
        for part in _unnamed(within)
    ]
    return html(tag("div", table, class_="scroll", tabindex="0"), inner)


def _described(schema: Schema) -> Html:
    words = schema.get("description")
    return html(tag("p", words) if words else None, properties_table(schema))


def _row(name: str, schema: Schema, required: bool) -> Html:
    return tag(
        "tr",
        tag("th", tag("code", name), scope="row"),
        tag("td", type_of(schema)),
        tag("td", unit_of(schema)),
        tag("td", schema.get("description", ""), tag("small", _remarks(schema, required))),
    )


def _remarks(schema: Schema, required: bool) -> str:
    """Whether it is required, its default, bounds and example."""
    found = ["Required."] if required else []
    if not required and schema.get("default") is not None:
        found.append(f"Default {json.dumps(schema['default'], ensure_ascii=False)}.")
    for part in (schema, *schema.get("anyOf", [])):
        found += [f"{words} {part[key]:g}." for key, words in _BOUNDS if key in part]
    shown = next(
        (part["examples"][0] for part in (schema, *schema.get("anyOf", [])) if part.get("examples")), None
    )
    if shown is not None:
        found.append(f"E.g. {json.dumps(shown, ensure_ascii=False)}.")
    text = " ".join(dict.fromkeys(word[0].upper() + word[1:] for word in found))
    return f" {text}" if text else ""


def _unnamed(schema: Schema) -> Iterator[Schema]:
    """Objects with properties inside a schema that have no entry of their own."""
    if "properties" in schema:
        yield schema
        return
    for key in ("anyOf", "oneOf"):
        for part in schema.get(key, []):
            yield from _unnamed(part)
    for key in ("items", "additionalProperties"):
        if isinstance(schema.get(key), dict):
            yield from _unnamed(schema[key])
