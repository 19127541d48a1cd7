"""The frame of a reference page: head, links between the pages, list of contents."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from mckibben.report.html import Child, Html, html, tag

_PAGES = {"/help": "Help", "/help/python": "Python", "/help/http": "HTTP"}

_WAYS: tuple[tuple[Child, Child], ...] = (
    (tag("a", "In the browser", href="/"), "This app. The key ? shows its keyboard shortcuts."),
    (
        tag("a", "From Python", href="/help/python"),
        (tag("code", "import mckibben as mk"), ": every name, with its arguments and errors."),
    ),
    (
        tag("a", "Over HTTP", href="/help/http"),
        (
            "Every path, with an example of its request and every field. The same for programs: ",
            tag("a", "/openapi.json", href="/openapi.json"),
            ".",
        ),
    ),
    ("In the terminal", (tag("code", "mckibben --help"), ": every command, with its options.")),
)


def page(title: str, *content: Child, path: str, contents: Iterable[Child] = ()) -> str:
    """A whole page. Style, and the script that follows the chosen theme, are files of the app.

    Args:
        title: of the page.
        content: of its main part.
        path: where it is served, for the links between the pages.
        contents: entries of the list of contents, if there is one.
    """
    entries = list(contents)
    links = [
        tag("a", name, href=address, aria_current="page" if address == path else None)
        for address, name in _PAGES.items()
    ]
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"{title} · mckibben"),
        tag("link", rel="icon", href="/icon.svg", type="image/svg+xml"),
        tag("link", rel="stylesheet", href="/css/app.css"),
        tag("link", rel="stylesheet", href="/css/help.css"),
        tag("script", type="module", src="/js/plots/theme.js"),
    )
    body = tag(
        "body",
        tag("a", "Skip to the content", class_="skip", href="#main"),
        tag(
            "header",
            tag("a", "mckibben", class_="brand", href="/"),
            tag("nav", *links, aria_label="Help"),
        ),
        tag(
            "div",
            tag("nav", tag("ul", *entries), class_="contents", aria_label="Contents") if entries else None,
            tag("main", tag("h1", title), *content, id="main", tabindex="-1"),
            class_="help",
        ),
        class_="reference",
    )
    return "<!doctype html>\n" + tag("html", head, body, lang="en")


def entry(anchor: str, name: str, *below: Child) -> Html:
    """An entry of the list of contents."""
    inner = html(tag("a", name, href=f"#{anchor}"))
    return tag("li", inner, tag("ul", *below) if below else None)


def overview(version: str, misprints: Mapping[str, Sequence[str]]) -> str:
    """The page that leads to the others.

    Args:
        version: of the program.
        misprints: title of a preset -> what its source prints there and cannot be right, with what is.
    """
    sources = (
        tag("h2", "Misprints of the sources"),
        tag("p", "Where a source prints what cannot be right, the presets that follow it say what is:"),
        tag(
            "dl",
            *(
                html(tag("dt", title), *(tag("dd", words) for words in found))
                for title, found in misprints.items()
            ),
        ),
    )
    return page(
        "Help",
        tag("p", f"mckibben {version} can be used in four ways. All give the same answers."),
        tag("dl", *(html(tag("dt", name), tag("dd", words)) for name, words in _WAYS)),
        *(sources if misprints else ()),
        path="/help",
    )
