"""The reference of the Python names; pdoc makes it from signatures, docstrings and attribute docstrings."""

from __future__ import annotations

import pkgutil
import re
import sys
from collections.abc import Mapping
from dataclasses import is_dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from mckibben.facts.result import described
from mckibben.report.html import Html, tag
from mckibben.report.reference.page import page

if TYPE_CHECKING:
    from pdoc.doc import Module

#: What pdoc writes -> what a page shows.
_SHOWN = (
    # Sections of a docstring are no headings, and have no anchors: the same word stands in many.
    (re.compile(r'<h6 id="[^"]*">(.*?):</h6>'), r'<p class="label">\1</p>'),
    (re.compile("<pre>"), '<pre tabindex="0">'),  # scrolled by keyboard
    (re.compile(r"(?:typing\.)?Annotated\[(.*?), &lt;[\w.]+ object at \w+&gt;\]"), r"\1"),
    (
        re.compile(r"numpy\.ndarray\[tuple\[(?:typing\.)?Any, \.\.\.\], numpy\.dtype\[(.*?)\]\]"),
        r"NDArray[\1]",
    ),
)


def start_of(package: ModuleType) -> str:
    """Address of the page of the package, below that of the reference."""
    return f"{package.__name__}.html"


def python_reference(package: ModuleType, address: str) -> str:
    """A page of the reference.

    The package has a page with its public names, each module of its door one with its classes, and each
    module with result classes one with these.

    Args:
        package: has ``__all__`` and a docstring.
        address: of the page, "mckibben/door/curves.html".

    Raises:
        LookupError: there is no such page.
    """
    from pdoc import render

    modules = _documented(package)
    name = address.removesuffix(".html").replace("/", ".")
    if name not in modules or not address.endswith(".html"):
        raise LookupError(address)
    render.configure(
        docformat="google",
        search=False,
        show_source=False,
        template_directory=Path(__file__).parent / "templates",
    )
    written = render.html_module(modules[name], modules)
    for pattern, shown in _SHOWN:
        written = pattern.sub(shown, written)
    contents, text = written.split("\f")
    listed = tag("li", tag("strong", name), Html(contents))
    return page(name, tag("div", Html(text), class_="pdoc"), path="/help/python", contents=[listed])


@cache
def _documented(package: ModuleType) -> Mapping[str, Module]:
    """What pdoc is to know of each module: its public names, its classes, its result classes."""
    from pdoc.doc import Module

    door = import_module(f"{package.__name__}.door")
    for found in pkgutil.iter_modules(door.__path__, f"{door.__name__}."):
        import_module(found.name)
    shown = {package.__name__: {name: getattr(package, name) for name in package.__all__}}
    for name, module in list(sys.modules.items()):
        if name.startswith(f"{package.__name__}."):
            inside = name.startswith(f"{door.__name__}.")
            own = {
                key: item
                for key, item in vars(module).items()
                if getattr(item, "__module__", None) == name
                and isinstance(item, type)
                and not key.startswith("_")
                and (inside or "__pydantic_config__" in vars(item))
            }
            shown |= {name: own} if own else {}
    modules = {name: Module(_view(sys.modules[name], members)) for name, members in shown.items()}
    for entry in (cls for module in modules.values() for cls in module.classes):
        # pdoc 16 lets bases of a generic class come before the class itself, which declares fields anew.
        entry._bases = entry.obj.__mro__
        if is_dataclass(entry.obj):  # its fields say all, and nobody makes it by hand
            entry.members.pop("__init__", None)
        if hasattr(entry.obj, "FIGURES"):  # whose texts are declared with the figures
            for name, field in described(entry.obj).items():
                unit = "" if field.unit is None else f" [{field.unit}]"
                entry.members[name].docstring = entry.members[name].docstring or f"{field.text}{unit}"
    return modules


def _view(module: ModuleType, members: Mapping[str, Any]) -> ModuleType:
    """A module with some members of another; no submodules."""
    view = ModuleType(module.__name__, module.__doc__)
    vars(view).update(members, __all__=list(members))
    return view
