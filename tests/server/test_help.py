"""The help pages: every public name and every path, nothing from outside."""

from __future__ import annotations

import inspect
import re
from html.parser import HTMLParser
from typing import Any

import pytest
from fastapi.testclient import TestClient

import mckibben as mk
from mckibben.server.security import CONTENT_SECURITY_POLICY
from tests.door.test_names import CLASSES

PAGES = ("/help", "/help/python", "/help/http")
EMPTY = {"meta", "link"}


class Reading(HTMLParser):
    """Ids, links, loaded files and text of a page; refuses elements that are not closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.inline_scripts = 0
        self.text: list[str] = []
        self._open: list[str] = []
        self.feed(text)
        assert not self._open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        assert not [name for name in found if name.startswith("on") or name == "style"]
        if found.get("id"):
            self.ids.append(found["id"] or "")
        if tag == "a":
            self.links.append(found["href"] or "")
        else:
            self.loaded += [value or "" for name, value in attrs if name in ("src", "href", "data", "action")]
        self.inline_scripts += tag == "script" and "src" not in found
        if tag not in EMPTY:
            self._open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in EMPTY:
            assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text.append(data)


@pytest.fixture(scope="module", params=PAGES)
def any_page(request: pytest.FixtureRequest, shared_client: TestClient) -> Reading:
    """Each page in turn."""
    return Reading(shared_client.get(request.param).text)


@pytest.fixture(scope="module")
def python(shared_client: TestClient) -> Reading:
    """The reference of Python."""
    return Reading(shared_client.get("/help/python").text)


@pytest.fixture(scope="module")
def http(shared_client: TestClient) -> Reading:
    """The reference of HTTP."""
    return Reading(shared_client.get("/help/http").text)


@pytest.fixture(scope="module")
def document(shared_client: TestClient) -> dict[str, Any]:
    """The OpenAPI document."""
    return shared_client.get("/openapi.json").json()


@pytest.mark.parametrize("path", PAGES)
def test_a_page_is_served_under_the_policy_of_all_others(shared_client: TestClient, path: str) -> None:
    answer = shared_client.get(path)
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "text/html; charset=utf-8"
    assert answer.headers["content-security-policy"] == CONTENT_SECURITY_POLICY


def test_nothing_comes_from_outside(any_page: Reading, shared_client: TestClient) -> None:
    assert any_page.loaded
    assert not any_page.inline_scripts
    for address in any_page.loaded:
        assert re.match(r"/[^/]", address), address
        assert shared_client.get(address).status_code == 200, address


def test_every_link_leads_somewhere(any_page: Reading, shared_client: TestClient) -> None:
    assert len(set(any_page.ids)) == len(any_page.ids)
    for link in set(any_page.links):
        if link.startswith("#"):
            assert link[1:] in any_page.ids, link
        else:
            assert shared_client.get(link).status_code == 200, link


def test_every_public_name_has_an_entry(python: Reading) -> None:
    assert set(mk.__all__) <= set(python.ids)


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_every_public_member_has_an_entry_with_its_arguments(python: Reading, cls: type) -> None:
    for name, member in inspect.getmembers(cls):
        if name.startswith("_") or not (callable(member) or isinstance(member, property)):
            continue
        anchor = f"{cls.__name__}.{name}"
        assert anchor in python.ids
        assert f"#{anchor}" in python.links
        if not isinstance(member, property):
            call = next(part for part in python.text if part.startswith(f"{anchor}("))
            assert all(argument in call for argument in list(inspect.signature(member).parameters)[1:])


def test_docstrings_are_shown_whole(python: Reading) -> None:
    shown = re.sub(r"\W+", " ", "".join(f"{part} " for part in python.text))
    for item in (mk.read, mk.Model, mk.Model.force, mk.size, mk.Problem):
        for line in (inspect.getdoc(item) or "").splitlines():
            words = re.sub(r"\W+", " ", line.replace(":math:", "")).strip()
            assert words in shown, f"{item.__name__}: {line}"


def test_every_path_has_an_entry_with_its_example(http: Reading, document: dict[str, Any]) -> None:
    text = "".join(http.text)
    for path, item in document["paths"].items():
        for method, operation in item.items():
            assert operation["operationId"] in http.ids
            assert f"{method.upper()} {path}" in text
    bodies = sum(
        "requestBody" in operation for item in document["paths"].values() for operation in item.values()
    )
    assert bodies > 10
    assert sum(part.startswith("Example") for part in http.text) >= bodies


def test_every_property_is_explained(http: Reading, document: dict[str, Any]) -> None:
    shown = set(http.text)
    for name, schema in document["components"]["schemas"].items():
        assert name in http.ids
        for key, field in schema.get("properties", {}).items():
            assert key in shown
            assert field["description"] in shown, f"{name}.{key}"
            if "unit" in field:
                assert field["unit"] in shown
