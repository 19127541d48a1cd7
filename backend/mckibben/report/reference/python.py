"""The reference of the Python names: signatures and docstrings."""

from __future__ import annotations

import dataclasses
import inspect
from types import ModuleType

from mckibben.report.html import Child, Html, html, tag
from mckibben.report.reference.docstring import Anchors, rendered
from mckibben.report.reference.names import Member, members, public_names, returned_classes, signature
from mckibben.report.reference.page import entry, page


def python_reference(package: ModuleType) -> str:
    """A page with every public name of a package and every class that they return.

    Args:
        package: has ``__all__`` and a docstring.
    """
    names = public_names(package)
    public = {name: item for name, item in names.items() if callable(item)}
    returned = {cls.__name__: cls for cls in returned_classes(package)}
    known = {
        anchor
        for name, item in {**public, **returned}.items()
        for anchor in (name, *(f"{name}.{member.name}" for member in _members(item)))
    }
    values = {name: item for name, item in names.items() if not callable(item)}

    def anchors_in(scope: str) -> Anchors:
        def anchor(name: str) -> str | None:
            short = name.removeprefix(f"{package.__name__}.").removesuffix("()")
            return next((found for found in (f"{scope}.{short}", short) if found in known), None)

        return anchor

    def described(name: str, item: object) -> Html:
        return _entry(name, item, anchors_in(name))

    return page(
        "Python",
        rendered(package.__doc__ or "", anchors_in("")),
        tag("h2", "Names", id="names"),
        *(described(name, item) for name, item in public.items()),
        *(_value(name, item) for name, item in values.items()),
        tag("h2", "What they return", id="returned"),
        *(described(name, item) for name, item in returned.items()),
        path="/help/python",
        contents=[
            entry("names", "Names", *(_listed(name, item) for name, item in names.items())),
            entry("returned", "What they return", *(_listed(name, item) for name, item in returned.items())),
        ],
    )


def _members(item: object) -> list[Member]:
    return members(item) if isinstance(item, type) else []


def _listed(name: str, item: object) -> Html:
    below = [entry(f"{name}.{member.name}", member.name) for member in _members(item)]
    return entry(name, name, *below)


def _entry(name: str, item: object, anchors: Anchors) -> Html:
    """A class with its members, or a function."""
    if not isinstance(item, type):
        return tag(
            "section",
            tag("h3", name, tag("small", " function"), id=name),
            _call(name, item, bound=False),
            rendered(inspect.getdoc(item) or "", anchors),
        )
    own = item.__init__ is not object.__init__ and "__init__" in vars(item)
    made = _call(name, item.__init__, bound=True) if own and not dataclasses.is_dataclass(item) else None
    return tag(
        "section",
        tag("h3", name, tag("small", " class"), id=name),
        made,
        rendered(inspect.getdoc(item) or "", anchors),
        _fields(item),
        *(_member(name, member, anchors) for member in members(item)),
    )


def _call(name: str, function: object, *, bound: bool) -> Html:
    lines = signature(name, function, bound=bound)  # type: ignore
    if function is not None and getattr(function, "__name__", "") == "__init__":
        lines[-1] = lines[-1].removesuffix(" -> None")
    return tag("pre", "\n".join(lines), class_="signature", tabindex="0")


def _fields(cls: type) -> Html | None:
    """The fields of a data class with their types; the docstring says what they are."""
    if not dataclasses.is_dataclass(cls):
        return None
    shown: list[Child] = [
        html(tag("dt", tag("code", field.name)), tag("dd", tag("code", str(field.type))))
        for field in dataclasses.fields(cls)
        if not field.name.startswith("_")
    ]
    return tag("div", tag("p", "Types", class_="label"), tag("dl", *shown), class_="section")


def _member(owner: str, member: Member, anchors: Anchors) -> Html:
    name = f"{owner}.{member.name}"
    returns = inspect.unwrap(member.function).__annotations__.get("return", "")
    if member.kind == "property":
        call = tag("pre", f"{name}: {returns}", class_="signature", tabindex="0")
    else:
        call = _call(name, member.function, bound=member.kind != "static method")
    return tag(
        "div",
        tag("h4", member.name, tag("small", f" {member.kind}"), id=name),
        call,
        rendered(inspect.getdoc(member.function) or "", anchors),
        class_="member",
    )


def _value(name: str, item: object) -> Html:
    return tag(
        "section",
        tag("h3", name, tag("small", " value"), id=name),
        tag("pre", f"{name} = {item!r}", class_="signature", tabindex="0"),
    )
