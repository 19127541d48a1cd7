"""The reference of the HTTP interface, from its OpenAPI document."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from mckibben.report.html import Child, Html, html, tag
from mckibben.report.reference.page import entry, page

_METHODS = ("get", "post", "put", "patch", "delete")
_CODE = re.compile(r"``?([^`]+)``?")

Schema = dict[str, Any]

_BOUNDS = (
    ("minimum", "at least"),
    ("exclusiveMinimum", "above"),
    ("maximum", "at most"),
    ("exclusiveMaximum", "below"),
    ("maxItems", "most entries:"),
)


def http_reference(document: dict[str, Any]) -> str:
    """A page with every path, an example of each request, and every property of every schema.

    Args:
        document: the OpenAPI document.
    """
    tags = [(item["name"], item["description"]) for item in document["tags"]]
    by_tag = {
        name: [found for found in _operations(document) if name in found[2]["tags"]] for name, _ in tags
    }
    sections = [
        tag(
            "section",
            tag("h2", name, id=f"tag-{name}"),
            tag("p", words),
            *(_operation(*found) for found in by_tag[name]),
        )
        for name, words in tags
    ]
    schemas = sorted(document["components"]["schemas"].items())
    return page(
        "HTTP",
        tag("p", document["info"]["description"]),
        tag("p", "The same for programs: ", tag("a", "/openapi.json", href="/openapi.json"), "."),
        *sections,
        tag("h2", "Objects", id="objects"),
        *(_object(name, schema) for name, schema in schemas),
        path="/help/http",
        contents=[
            *(
                entry(
                    f"tag-{name}",
                    name,
                    *(
                        entry(found["operationId"], _title(method, path))
                        for method, path, found in operations
                    ),
                )
                for name, operations in by_tag.items()
            ),
            entry("objects", "Objects", *(entry(name, name) for name, _ in schemas)),
        ],
    )


def _operations(document: dict[str, Any]) -> Iterator[tuple[str, str, Schema]]:
    for path, item in document["paths"].items():
        for method in _METHODS:
            if method in item:
                yield method, path, item[method]


def _title(method: str, path: str) -> str:
    return f"{method.upper()} {path}"


def _operation(method: str, path: str, operation: Schema) -> Html:
    body = operation.get("requestBody")
    parameters = [
        {"name": item["name"], "schema": {**item["schema"], **_words(item)}, "required": item.get("required")}
        for item in operation.get("parameters", [])
    ]
    table = {
        "properties": {item["name"]: item["schema"] for item in parameters},
        "required": [item["name"] for item in parameters if item["required"]],
    }
    return tag(
        "div",
        tag("h3", tag("code", _title(method, path)), id=operation["operationId"]),
        *(tag("p", _text(part)) for part in operation["description"].split("\n\n")),
        html(tag("p", "Parameters", class_="label"), properties_table(table)) if parameters else None,
        _request(body) if body else None,
        _answers(operation["responses"]),
        class_="member",
    )


def _words(item: Schema) -> Schema:
    return {"description": item["description"]} if item.get("description") else {}


def _text(words: str) -> Html:
    """Text with its code."""
    parts = _CODE.split(words)
    return html(tag("code", part) if index % 2 else part for index, part in enumerate(parts))


def _request(body: Schema) -> Html:
    """Type of the body, and its examples, each once."""
    content = body["content"]
    types = list(dict.fromkeys(type_of(media.get("schema", {})) for media in content.values()))
    shown: dict[str, str] = {}
    for media in content.values():
        if "example" in media:
            shown.setdefault(_written(media["example"]), "Example")
        for name, named in media.get("examples", {}).items():
            shown.setdefault(_written(named["value"]), f"Example: {name}")
    return html(
        tag("p", "Request", class_="label"),
        tag("p", ", ".join(content), ": ", *types),
        tag("p", _text(body["description"])) if "description" in body else None,
        *(
            html(tag("p", caption, class_="label"), tag("pre", example, tabindex="0"))
            for example, caption in shown.items()
        ),
    )


def _written(example: object) -> str:
    return example if isinstance(example, str) else _indented(example)


def _indented(value: object, column: int = 0) -> str:
    """JSON with short parts on one line."""
    line = json.dumps(value, ensure_ascii=False)
    if not isinstance(value, dict | list) or (column and len(line) + column < 80):
        return line
    pad = " " * (column + 2)
    if isinstance(value, dict):
        inner = [f"{json.dumps(key)}: {_indented(part, column + 2)}" for key, part in value.items()]
    else:
        inner = [_indented(part, column + 2) for part in value]
    ends = "{}" if isinstance(value, dict) else "[]"
    return f"{ends[0]}\n" + ",\n".join(pad + part for part in inner) + f"\n{' ' * column}{ends[1]}"


def _answers(responses: Schema) -> Html:
    """Status, content type and meaning of every answer."""
    items: list[Child] = []
    for status, response in sorted(responses.items()):
        kinds = response.get("content", {})
        items.append(tag("dt", tag("code", status)))
        shown = [html(kind, ": ", type_of(media.get("schema", {})), ". ") for kind, media in kinds.items()]
        notes = [_text(media["schema"]["description"]) for media in kinds.values() if _noted(media)]
        items.append(tag("dd", response.get("description", "").removesuffix("."), ". ", *shown, *notes))
    return html(tag("p", "Answers", class_="label"), tag("dl", *items))


def _noted(media: Schema) -> bool:
    return "description" in media.get("schema", {})


def _object(name: str, schema: Schema) -> Html:
    words = schema.get("description", "").split("\n\n")
    plain = None if "properties" in schema else tag("p", type_of(schema))
    return tag(
        "section",
        tag("h3", name, id=name),
        *(tag("p", _text(part)) for part in words),
        plain or properties_table(schema),
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
