"""The help pages: every public name and every path, nothing from outside."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from dataclasses import is_dataclass
from functools import cache
from html.parser import HTMLParser
from typing import Any
from urllib.parse import urljoin

import pytest
from fastapi.testclient import TestClient

import mckibben as mk
from mckibben.application.diagnose.result import Verdict
from mckibben.application.linear.result import ModelResult
from mckibben.door.curves import Curves
from mckibben.facts.result import described
from mckibben.server.security import CONTENT_SECURITY_POLICY
from mckibben.simulation.timing.table import PhaseFigures
from tests.door.test_names import CLASSES

PAGES = (
    "/help",
    "/help/python",
    "/help/python/mckibben/door/curves.html",
    "/help/python/mckibben/application/diagnose/result.html",
    "/help/http",
)
EMPTY = {"meta", "link", "br", "wbr", "hr", "input"}


class Reading(HTMLParser):
    """Ids, links, loaded files and text of a page; refuses elements that are not closed in order."""

    def __init__(self, text: str, address: str = "") -> None:
        super().__init__()
        self.address = address
        self.ids: list[str] = []
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.inline_scripts = 0
        self.text: list[str] = []
        self.entries: dict[str, str] = {}
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
        if self.ids:
            self.entries[self.ids[-1]] = self.entries.get(self.ids[-1], "") + data


@pytest.fixture(scope="module", params=PAGES)
def any_page(request: pytest.FixtureRequest, shared_client: TestClient) -> Reading:
    """Each page in turn."""
    answer = shared_client.get(request.param)
    return Reading(answer.text, str(answer.url))


@pytest.fixture(scope="module")
def python(shared_client: TestClient) -> Callable[[type], Reading]:
    """The page of the reference of Python on which a class stands."""

    @cache
    def reading(address: str) -> Reading:
        return Reading(shared_client.get(address).text)

    def page_of(cls: type) -> Reading:
        public = cls.__name__ in mk.__all__
        return reading("/help/python" + ("" if public else f"/{cls.__module__.replace('.', '/')}.html"))

    return page_of


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
    asked = cache(shared_client.get)
    for link in set(any_page.links):
        address, _, anchor = urljoin(any_page.address, link).partition("#")
        answer = asked(address)
        assert answer.status_code == 200, link
        if anchor:
            assert f'id="{anchor}"' in answer.text, link


def words(text: str) -> str:
    """The words of a text, one space between them."""
    return re.sub(r"\W+", " ", text).strip()


def test_every_public_name_has_an_entry(python: Callable[[type], Reading]) -> None:
    assert set(mk.__all__) <= set(python(mk.Model).ids)


def test_a_type_is_a_link_to_its_entry(python: Callable[[type], Reading]) -> None:
    assert "mckibben/door/curves.html#Curves" in python(mk.Model).links
    assert "../application/curves/curves.html#CurveLimits" in python(Curves).links


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_every_public_member_has_an_entry_with_its_arguments(
    python: Callable[[type], Reading], cls: type
) -> None:
    page = python(cls)
    for name, member in inspect.getmembers(cls):
        if name.startswith("_") or not (callable(member) or isinstance(member, property)):
            continue
        entry = page.entries[f"{cls.__name__}.{name}"]
        assert f"{name}(" in entry or isinstance(member, property)
        if not isinstance(member, property):
            assert all(argument in entry for argument in list(inspect.signature(member).parameters)[1:])


RESULTS = [cls for cls in (*CLASSES, PhaseFigures, ModelResult, Verdict) if is_dataclass(cls)]


@pytest.mark.parametrize("cls", RESULTS, ids=lambda cls: cls.__name__)
def test_every_field_of_a_result_has_an_entry_with_its_docstring(
    python: Callable[[type], Reading], cls: type
) -> None:
    for name, field in described(cls).items():
        entry = words(python(cls).entries[f"{cls.__name__}.{name}"])
        for part in field.text.split(". "):  # its unit stands in brackets behind the first words
            assert all(word in entry for word in words(part).split()), name
        assert field.unit in (None, "1") or words(field.unit) in entry, name


def test_docstrings_are_shown_whole(python: Callable[[type], Reading]) -> None:
    shown = words(" ".join(python(mk.Model).text))
    for item in (mk.read, mk.Model, mk.Model.force, mk.size, mk.Problem):
        for line in (inspect.getdoc(item) or "").splitlines():
            if line.strip() != "Args:":  # the heading is "Arguments"
                assert words(line) in shown, f"{item.__name__}: {line}"


@pytest.mark.examination("test_every_link_leads_somewhere")
def test_every_page_that_a_reader_reaches_is_well_formed(shared_client: TestClient) -> None:
    start = str(shared_client.get("/help/python").url)
    waiting, read = [start], set[str]()
    while waiting:
        address = waiting.pop()
        answer = shared_client.get(address)
        assert answer.status_code == 200, address
        page = Reading(answer.text)
        assert len(set(page.ids)) == len(page.ids), address
        assert " object at 0x" not in "".join(page.text), address
        read.add(address)
        found = {urljoin(address, link).partition("#")[0] for link in page.links}
        waiting += [link for link in found if "/help/python/" in link and link not in {*read, *waiting}]
    assert len(read) > 20


def test_another_address_is_no_page(shared_client: TestClient) -> None:
    for address in ("mckibben", "os.html", "mckibben/server/app.html", "../../etc/passwd", "mckibben.html/x"):
        assert shared_client.get(f"/help/python/{address}").status_code == 404, address


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


def test_the_help_lists_the_misprints_that_presets_state(client: TestClient) -> None:
    """Each word for word, under the title of its preset."""
    text = " ".join(Reading(client.get("/help").text).text)
    stated = 0
    for kind in ("designs", "drives", "muscles", "valves"):
        for preset in client.get(f"/api/presets/{kind}").json()["presets"]:
            for misprint in preset["misprints"]:
                stated += 1
                assert preset["title"] in text
                assert misprint in text
    assert stated > 5
