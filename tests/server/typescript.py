"""Write ``openapi.json`` and ``api.d.ts`` into `frontend/types`, from the server's own description.

    python -m tests.server.typescript

Neither is in git. The frontend's JavaScript is checked against ``api.d.ts``; a field renamed in a result is
an error there.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from mckibben.server.app import create_app

FOLDER = Path(__file__).resolve().parents[2] / "frontend" / "types"
COMMAND = "python -m tests.server.typescript"
_HEADER = f"// Generated from openapi.json by `{COMMAND}`. Do not edit.\n\n"
_SIMPLE = {"string": "string", "number": "number", "integer": "number", "boolean": "boolean", "null": "null"}
_METHODS = ("get", "put", "post", "delete", "patch")

Schema = dict[str, Any]


@cache
def published() -> Schema:
    """The OpenAPI document of a server with the settings as installed."""
    return json.loads(json.dumps(create_app().openapi()))


@cache
def generated_files() -> dict[str, str]:
    """File name -> text, the same on every machine."""
    document = published()
    return {
        "openapi.json": json.dumps(document, indent=2, sort_keys=True, ensure_ascii=False) + "\n",
        "api.d.ts": typescript(document),
    }


def typescript(document: Schema) -> str:
    """Declarations laid out as openapi-typescript does: ``paths``, ``components``, ``operations``."""
    schemas = document["components"]["schemas"]
    operations = {
        item[method]["operationId"]: item[method]
        for item in document["paths"].values()
        for method in _METHODS
        if method in item
    }
    lines: list[str] = ["export interface paths {"]
    for path, item in sorted(document["paths"].items()):
        lines.append(f"  {json.dumps(path)}: {{")
        present = {method: item[method]["operationId"] for method in _METHODS if method in item}
        lines += [f'    {method}: operations["{name}"];' for method, name in present.items()]
        lines.append("  };")
    lines += ["}", "", "export interface components {", "  schemas: {"]
    for name, schema in sorted(schemas.items()):
        lines += _comment(schema, 4)
        lines.append(f"    {_key(name)}: {_type(schema, 4)};")
    lines += ["  };", "}", "", "export interface operations {"]
    for name, operation in sorted(operations.items()):
        lines += _operation(name, operation)
    return _HEADER + "\n".join([*lines, "}", ""])


def _operation(name: str, operation: Schema) -> Iterator[str]:
    yield from _comment(operation, 2)
    yield f"  {name}: {{"
    groups: dict[str, list[Schema]] = {}
    for parameter in operation.get("parameters", []):
        groups.setdefault(parameter["in"], []).append(parameter)
    if groups:
        yield "    parameters: {"
        for place, parameters in sorted(groups.items()):
            inner = "; ".join(
                f"{_key(item['name'])}{'' if item.get('required') else '?'}: {_type(item['schema'], 6)}"
                for item in parameters
            )
            yield f"      {place}: {{ {inner} }};"
        yield "    };"
    if "requestBody" in operation:
        yield f"    requestBody: {{ content: {_content(operation['requestBody'])} }};"
    yield "    responses: {"
    for status, response in sorted(operation["responses"].items()):
        yield f"      {status}: {{ content: {_content(response)} }};"
    yield "    };"
    yield "  };"


def _content(part: Schema) -> str:
    kinds = part.get("content", {})
    return f"{{ {'; '.join(f'{json.dumps(kind)}: {_body(kinds[kind])}' for kind in sorted(kinds))} }}"


def _body(media: Schema) -> str:
    schema = media.get("schema", {})
    return "Blob | ArrayBuffer | string" if schema.get("format") == "binary" else _type(schema, 6)


def _type(schema: Schema, indent: int) -> str:
    """The TypeScript type of one JSON schema."""
    if "$ref" in schema:
        return f'components["schemas"]["{schema["$ref"].rpartition("/")[2]}"]'
    if "const" in schema:
        return json.dumps(schema["const"])
    if "enum" in schema:
        return " | ".join(json.dumps(value) for value in schema["enum"])
    for union in ("anyOf", "oneOf"):
        if union in schema:
            return " | ".join(dict.fromkeys(_type(part, indent) for part in schema[union]))
    kind = schema.get("type")
    if kind == "array" and "prefixItems" in schema:
        return f"[{', '.join(_type(part, indent) for part in schema['prefixItems'])}]"
    if kind == "array":
        inner = _type(schema.get("items", {}), indent)
        return f"({inner})[]" if " | " in inner else f"{inner}[]"
    if kind == "object":
        return _object(schema, indent)
    return _SIMPLE.get(str(kind), "unknown")


def _object(schema: Schema, indent: int) -> str:
    properties = schema.get("properties")
    if properties is None:
        values = schema.get("additionalProperties") or schema.get("patternProperties")
        if isinstance(values, dict) and not {"type", "$ref", "anyOf"} & values.keys():
            values = next(iter(values.values()), {})  # patternProperties: the pattern of the keys is lost
        return f"{{ [key: string]: {_type(values, indent) if isinstance(values, dict) else 'unknown'} }}"
    required = set(schema.get("required", ()))
    pad = " " * (indent + 2)
    lines = ["{"]
    for name, value in properties.items():
        lines += _comment(value, indent + 2)
        lines.append(f"{pad}{_key(name)}{'' if name in required else '?'}: {_type(value, indent + 2)};")
    return "\n".join([*lines, " " * indent + "}"])


def _comment(schema: Schema, indent: int) -> list[str]:
    text = " ".join(str(schema.get("description", "")).split()).replace("*/", "* /")
    unit = _unit(schema)
    if unit:
        text = f"{text} [{unit}]".strip()
    return [f"{' ' * indent}/** {text} */"] if text else []


def _unit(schema: Schema) -> str | None:
    parts = [schema, *schema.get("anyOf", [])]
    return next((part["unit"] for part in parts if "unit" in part), None)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z_$][\w$]*", name) else json.dumps(name)


def write() -> None:
    """Write both files."""
    FOLDER.mkdir(exist_ok=True)
    for name, text in generated_files().items():
        (FOLDER / name).write_text(text, "utf-8", newline="\n")


if __name__ == "__main__":
    write()
