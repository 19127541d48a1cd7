"""What a package offers: its public names, and the classes of what they return."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import ModuleType
from typing import Any

_NAME = re.compile(r"[A-Za-z_]\w*")


@dataclass(frozen=True, slots=True)
class Member:
    """A public method or property of a class.

    Attributes:
        name: of the member.
        kind: "method", "class method", "static method" or "property".
        function: what implements it.
    """

    name: str
    kind: str
    function: Callable[..., Any]


def public_names(package: ModuleType) -> dict[str, object]:
    """Everything in ``__all__`` of the package, in this order."""
    return {name: getattr(package, name) for name in package.__all__}


def returned_classes(package: ModuleType) -> list[type]:
    """Classes of the package that its public names return, directly or through one another, by name.

    Models of documents are left out: their fields are those of the HTTP interface.
    """
    public = public_names(package)
    found: dict[str, type] = {}
    waiting = [item for item in public.values() if callable(item)]
    known = {id(item) for item in waiting}
    while waiting:
        item = waiting.pop()
        functions = [member.function for member in members(item)] if isinstance(item, type) else [item]
        for cls in (cls for function in functions for cls in _classes_of(function)):
            ours = cls.__module__.split(".")[0] == package.__name__ and not hasattr(cls, "model_fields")
            if ours and id(cls) not in known:
                known.add(id(cls))
                found[cls.__name__] = cls
                waiting.append(cls)
    return [found[name] for name in sorted(found)]


def members(cls: type) -> list[Member]:
    """Public methods and properties that the package itself defines, by name."""
    package = cls.__module__.split(".")[0]
    found = []
    for name, item in inspect.getmembers_static(cls):
        if name.startswith("_"):
            continue
        member = _member(name, item)
        if member is not None and member.function.__module__.split(".")[0] == package:
            found.append(member)
    return found


def _member(name: str, item: object) -> Member | None:
    if isinstance(item, property) and item.fget is not None:
        return Member(name, "property", item.fget)
    if isinstance(item, classmethod):
        return Member(name, "class method", item.__func__)
    if isinstance(item, staticmethod):
        return Member(name, "static method", item.__func__)
    return Member(name, "method", item) if inspect.isfunction(item) else None


def _classes_of(function: object) -> Iterator[type]:
    """Classes that the return annotation of a function names."""
    unwrapped = inspect.unwrap(function) if callable(function) else function
    annotation = getattr(unwrapped, "__annotations__", {}).get("return", "")
    scope = getattr(unwrapped, "__globals__", {})
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", "")
    for name in _NAME.findall(text):
        if isinstance(scope.get(name), type):
            yield scope[name]


def signature(name: str, function: Callable[..., Any], *, bound: bool) -> list[str]:
    """The call as lines: one line, or one per argument where that is long.

    Args:
        name: how it is called, "Model.force".
        function: what implements it.
        bound: whether its first argument is the object or class.
    """
    found = inspect.signature(inspect.unwrap(function))
    parameters = list(found.parameters.values())[1 if bound else 0 :]
    arguments, keyword_only = [], False
    for position, parameter in enumerate(parameters):
        if parameter.kind is parameter.KEYWORD_ONLY and not keyword_only:
            keyword_only = True
            if not any(before.kind is before.VAR_POSITIONAL for before in parameters[:position]):
                arguments.append("*")
        arguments.append(_argument(parameter))
    returns = found.return_annotation
    arrow = "" if returns is found.empty else f" -> {_annotation(returns)}"
    line = f"{name}({', '.join(arguments)}){arrow}"
    if len(line) <= 88 or not arguments:
        return [line]
    return [f"{name}(", *(f"    {argument}," for argument in arguments), f"){arrow}"]


def _argument(parameter: inspect.Parameter) -> str:
    stars = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
    typed = "" if parameter.annotation is parameter.empty else f": {_annotation(parameter.annotation)}"
    if parameter.default is parameter.empty:
        return f"{stars}{parameter.name}{typed}"
    return f"{stars}{parameter.name}{typed}{' = ' if typed else '='}{parameter.default!r}"


def _annotation(annotation: object) -> str:
    """An annotation as it is written in the source."""
    if isinstance(annotation, str):
        return annotation
    return annotation.__name__ if isinstance(annotation, type) else str(annotation)
