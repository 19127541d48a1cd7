"""The reference of the HTTP interface, from its OpenAPI document."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from mckibben.report.html import Child, Html, html, tag
from mckibben.report.reference.page import entry, page
from mckibben.report.reference.schema import Schema, properties_table, type_of

_METHODS = ("get", "post", "put", "patch", "delete")
_CODE = re.compile(r"``?([^`]+)``?")


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
