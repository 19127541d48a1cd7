"""How the JavaScript modules may depend on each other: never upward, never in a circle, no view on a view.

From the bottom up: values and signals, the state, requests to the server, page elements, plots, what the
views share about muscles and drives, the views, the program that puts them together. A module imports only
from its own layer or from one below it. Types named in comments count too, except for circles.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest

MODULES = Path(__file__).resolve().parents[2] / "frontend" / "app" / "js"

# From the bottom up; a name ending in "/" is a folder.
LAYERS: tuple[tuple[str, ...], ...] = (
    ("types.js", "facts.js", "reactive.js", "format.js", "quantities.js", "paths.js"),
    ("state.js", "store.js"),
    ("server/",),
    ("dom.js", "ui/"),
    ("plots/",),
    ("muscle/", "drive/", "measurement/", "projects/"),
    ("views/",),
    ("link.js", "address.js", "design-tab.js", "shell.js", "commands.js", "main.js"),
)

_COMMENT = re.compile(r"/\*.*?\*/|^\s*//[^\n]*", re.DOTALL | re.MULTILINE)
_SPECIFIER = r"""["'](\.[^"']+)["']"""
_STATIC = (
    re.compile(rf"^\s*(?:import|export)\b[^;\"'()]*?\bfrom\s*{_SPECIFIER}", re.MULTILINE),
    re.compile(rf"^\s*import\s*{_SPECIFIER}", re.MULTILINE),
)
_ALL = (*_STATIC, re.compile(rf"\bimport\(\s*{_SPECIFIER}\s*\)"))


class Import(NamedTuple):
    """One module names another; both as paths relative to the folder of the modules."""

    source: str
    target: str

    def __str__(self) -> str:
        return f"{self.source} imports {self.target}"


def imported(source: str, text: str, patterns: Sequence[re.Pattern[str]]) -> Iterator[str]:
    """The modules a text names in one of these ways."""
    for pattern in patterns:
        for match in pattern.finditer(text):
            target = posixpath.normpath(posixpath.join(posixpath.dirname(source), match[1]))
            if not target.startswith(".."):  # the generated types lie beside the modules
                yield target


def modules() -> dict[str, str]:
    """The path of every module, relative to their folder, and its text."""
    return {
        path.relative_to(MODULES).as_posix(): path.read_text(encoding="utf-8")
        for path in sorted(MODULES.rglob("*.js"))
    }


def imports_of(texts: dict[str, str], *, types: bool) -> list[Import]:
    """Every import between the modules.

    Args:
        texts: path of each module -> its text.
        types: with those in comments, which only name types.
    """
    return [
        Import(source, target)
        for source, text in texts.items()
        for target in sorted(set(imported(source, text if types else _COMMENT.sub("", text), _ALL)))
    ]


def layer_of(module: str) -> int | None:
    """The layer of a module, 0 at the bottom; None when no layer names it."""
    for number, names in enumerate(LAYERS):
        if any(module == name or (name.endswith("/") and module.startswith(name)) for name in names):
            return number
    return None


def view_of(module: str) -> str | None:
    """The view a module belongs to."""
    folder, _, rest = module.partition("/")
    return rest.partition("/")[0] if folder == "views" else None


def circles(imports: list[Import]) -> list[list[str]]:
    """Groups of modules that import each other in a circle (strongly connected, more than one)."""
    graph: dict[str, list[str]] = {}
    for source, target in imports:
        graph.setdefault(source, []).append(target)
    order: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(module: str) -> None:
        order[module] = lowest[module] = len(order)
        stack.append(module)
        for target in graph.get(module, []):
            if target not in order:
                visit(target)
                lowest[module] = min(lowest[module], lowest[target])
            elif target in stack:
                lowest[module] = min(lowest[module], order[target])
        if lowest[module] == order[module]:
            at = stack.index(module)
            if len(stack) - at > 1 or module in graph.get(module, []):
                found.append(sorted(stack[at:]))
            del stack[at:]

    for module in graph:
        if module not in order:
            visit(module)
    return found


def folder_imports(imports: list[Import]) -> list[Import]:
    """The imports between the sub-folders of one view, as imports of folders."""
    folders = {
        Import(posixpath.dirname(source), posixpath.dirname(target))
        for source, target in imports
        if view_of(source) and view_of(source) == view_of(target) and target.count("/") > 2
    }
    return sorted(one for one in folders if one.source != one.target and one.source.count("/") > 1)


@pytest.fixture(scope="module")
def texts() -> dict[str, str]:
    return modules()


def test_imports_name_modules_that_exist(texts: dict[str, str]) -> None:
    missing = [str(one) for one in imports_of(texts, types=True) if one.target not in texts]
    assert not missing, "no such module:\n" + "\n".join(missing)


def test_every_module_has_a_layer(texts: dict[str, str]) -> None:
    without = [module for module in texts if layer_of(module) is None]
    assert not without, "give these modules a layer in LAYERS, or move them:\n" + "\n".join(without)


def test_no_import_goes_upward(texts: dict[str, str]) -> None:
    upward = [
        str(one)
        for one in imports_of(texts, types=True)
        if (layer_of(one.source) or 0) < (layer_of(one.target) or 0)
    ]
    assert not upward, "a module imports from a layer above its own:\n" + "\n".join(upward)


def test_no_view_imports_another(texts: dict[str, str]) -> None:
    across = [
        str(one)
        for one in imports_of(texts, types=True)
        if view_of(one.source) and view_of(one.target) and view_of(one.source) != view_of(one.target)
    ]
    assert not across, "what views share belongs below them (ui, plots, muscle, drive):\n" + "\n".join(across)


def test_no_circle_of_imports(texts: dict[str, str]) -> None:
    found = [" <-> ".join(group) for group in circles(imports_of(texts, types=False))]
    assert not found, "modules import each other in a circle:\n" + "\n".join(found)


def test_no_circle_of_folders_within_a_view(texts: dict[str, str]) -> None:
    found = [" <-> ".join(group) for group in circles(folder_imports(imports_of(texts, types=False)))]
    assert not found, "folders of a view import each other in a circle:\n" + "\n".join(found)


def test_only_the_server_folder_sends_requests(texts: dict[str, str]) -> None:
    """Aborting, the newest text and what is under way are the affair of server/question.js."""
    pattern = re.compile(r"\bfetch\(|\bnew AbortController\b|\bXMLHttpRequest\b|\bEventSource\b")
    found = [
        f"{module}: {match[0]}"
        for module, text in texts.items()
        if not module.startswith("server/") and module != "facts.js"  # it is there before all others
        for match in pattern.finditer(_COMMENT.sub("", text))
    ]
    assert not found, "ask through server/question.js or server/client.js:\n" + "\n".join(found)


WAYS = """
// import { no } from "./comment.js";
/** @typedef {import("./type.js").T} T */
import { a, b } from "./static.js";
import {
  c,
} from './lines.js';
import "../effect.js";
export { d } from "./again.js";
export * from "./all.js";
const later = () => import("./dynamic.js");
"""


def test_every_way_to_import_is_seen() -> None:
    code = {target for _, target in imports_of({"views/x/y.js": WAYS}, types=False)}
    assert code == {
        "views/x/static.js",
        "views/x/lines.js",
        "views/effect.js",
        "views/x/again.js",
        "views/x/all.js",
        "views/x/dynamic.js",
    }
    assert Import("views/x/y.js", "views/x/type.js") in imports_of({"views/x/y.js": WAYS}, types=True)


def test_circles_are_found() -> None:
    pairs = [("a", "b"), ("b", "c"), ("c", "a"), ("c", "d"), ("e", "e")]
    assert circles([Import(*pair) for pair in pairs]) == [["a", "b", "c"], ["e"]]


def test_the_page_preloads_what_it_starts_with(texts: dict[str, str]) -> None:
    """Else the browser learns of a module only when the modules that import it have arrived."""
    needed = ["main.js"]
    for module in needed:
        targets = dict.fromkeys(imported(module, _COMMENT.sub("", texts[module]), _STATIC))
        needed += [target for target in targets if target not in needed]
    page = (MODULES.parent / "index.html").read_text(encoding="utf-8")
    listed = re.findall(r'<link rel="modulepreload" href="/js/([^"]+)">', page)
    assert sorted(listed) == sorted(needed), (
        "index.html preloads other modules than main.js imports statically; "
        f"missing: {sorted(set(needed) - set(listed))}, not needed: {sorted(set(listed) - set(needed))}"
    )


def test_no_style_depends_on_what_is_inside_of_an_element():
    """With ``:has()`` every change below the element asks anew; on Plotly's measurements that froze pages."""
    sheets = {path.name: path.read_text(encoding="utf-8") for path in (MODULES.parent / "css").glob("*.css")}
    assert len(sheets) > 5
    assert [name for name, text in sheets.items() if ":has(" in text] == []
