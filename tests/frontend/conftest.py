"""Fixtures of the browser tests: Chromium, the real server, and a guard over what the pages do.

A test takes pytest-playwright's ``page`` (or ``context``, ``new_context``). The pages of ``context`` share
its process, and with it compiled code and the browser's cache, from test to test; what a page stores or sets
does not outlast its test. A test of a browser that has never seen the page takes ``new_context``.

Every page is guarded: an error or warning on the console, an uncaught error, a request that leaves the
server's origin or an answer 5xx fails the test that caused it. Where a console message is meant, the test
says so: ``page_guard.allow("status of 422")``.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Page

from tests.frontend.browser import ARGUMENTS, NoBrowserError, find_or_get
from tests.frontend.diagnoses import keep_in
from tests.frontend.guard import PageGuard
from tests.frontend.views import KEPT, open_compare, run
from tests.running_server import AUTHORIZED, RunningServer

_RESTING = '<title>resting</title><link rel="icon" href="data:,">'  # else the browser asks for /favicon.ico


@pytest.fixture(scope="session")
def browser_type_launch_args(
    browser_type_launch_args: dict[str, Any], announce: Callable[[str], None]
) -> dict[str, Any]:
    """How pytest-playwright starts Chromium: found or fetched once per run."""
    try:
        browser = find_or_get(announce)
    except NoBrowserError as error:
        raise pytest.fail.Exception(str(error), pytrace=False) from None
    arguments = {**browser_type_launch_args, "args": [*ARGUMENTS]}
    return arguments if browser.executable is None else {**arguments, "executable_path": browser.executable}


@pytest.fixture(scope="session", autouse=True)
def delete_output_dir(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Instead of pytest-playwright's, which empties ``test-results`` in whatever folder pytest was started.

    Screenshots and traces (``--screenshot``, ``--tracing``) go to pytest's temporary folder unless
    ``--output`` names another.
    """
    if pytestconfig.getoption("--output") == "test-results":
        pytestconfig.option.output = str(tmp_path_factory.mktemp("browser"))


@pytest.fixture(scope="session", autouse=True)
def _diagnoses_of_the_run(tmp_path_factory: pytest.TempPathFactory) -> None:
    """What the server diagnosed for one worker is known to the others."""
    base = tmp_path_factory.getbasetemp()
    keep_in((base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base) / "diagnoses")


@pytest.fixture(scope="session")
def browser_context_args(browser_context_args: dict[str, Any]) -> dict[str, Any]:
    """What each context begins with: the token, as the link of the server gives it."""
    return {**browser_context_args, "extra_http_headers": AUTHORIZED}


@pytest.fixture(scope="session")
def base_url(server_url: str) -> str:
    """What ``page.goto("/")`` is relative to."""
    return server_url


@pytest.fixture
def page_guard(server: RunningServer) -> Iterator[PageGuard]:
    """The guard of this test's pages; it speaks after they are closed, so nothing they did is missed."""
    guard = PageGuard(server.url)
    yield guard
    server.check_alive()
    guard.check()


@pytest.fixture(scope="session")
def resting_page(browser: Browser, browser_context_args: dict[str, Any], base_url: str) -> Iterator[Page]:
    """A page of the server that stays open, so that the process of the pages lives on between the tests."""
    context = browser.new_context(**browser_context_args)
    page = context.new_page()
    page.route("**/resting", lambda route: route.fulfill(content_type="text/html", body=_RESTING))
    page.goto("/resting")
    yield page
    context.close()


@pytest.fixture
def context(
    request: pytest.FixtureRequest, pytestconfig: pytest.Config, page_guard: PageGuard
) -> Iterator[BrowserContext]:
    """The context of the resting page, watched, and as good as new after the test."""
    recorded = [pytestconfig.getoption(f"--{what}") for what in ("tracing", "video", "screenshot")]
    if recorded != ["off"] * 3:  # what is recorded of a test is that of its own context
        yield request.getfixturevalue("new_context")()
        return
    resting = request.getfixturevalue("resting_page")
    shared = resting.context
    page_guard.watch(shared)
    yield shared
    for page in shared.pages:
        if page != resting:
            page.close()
    page_guard.leave(shared)
    shared.unroute_all()
    shared.clear_permissions()
    shared.clear_cookies()
    left = resting.evaluate("(localStorage.clear(), indexedDB.databases())")
    assert left == [], "pages keep nothing but localStorage so far; clear what they keep now"


@pytest.fixture(scope="module")
def kept_page(browser: Browser, browser_context_args: dict[str, Any], base_url: str) -> Iterator[Page]:
    """The page of a module marked ``kept_page``; its tests begin with `views.load`, which empties it."""
    context = browser.new_context(**browser_context_args)
    page = context.new_page()
    KEPT.add(page)
    yield page
    context.close()


@pytest.fixture
def page(request: pytest.FixtureRequest, page_guard: PageGuard) -> Iterator[Page]:
    """A page of its own, or in a module marked ``kept_page`` the one of that module."""
    if request.node.get_closest_marker("kept_page") is None:
        yield request.getfixturevalue("context").new_page()
        return
    page = request.getfixturevalue("kept_page")
    page_guard.watch(page.context)
    page.bring_to_front()
    yield page
    for other in page.context.pages:
        if other != page:
            other.close()
    page.unroute_all(behavior="ignoreErrors")  # what the page still asks is answered for nobody
    page.keyboard.press("Escape")
    if page.locator("[role=dialog]:visible, dialog[open]").count():  # what still lies over the view
        page.goto("about:blank")
    page.mouse.move(0, 0)
    page.set_viewport_size({"width": 1280, "height": 720})
    page.emulate_media(color_scheme="light", reduced_motion="no-preference")
    page_guard.leave(page.context)


@pytest.fixture
def new_context(
    page_guard: PageGuard, new_context: Callable[..., BrowserContext]
) -> Callable[..., BrowserContext]:
    """pytest-playwright's, with the guard watching."""

    def create(**options: Any) -> BrowserContext:
        context = new_context(**options)
        page_guard.watch(context)
        return context

    return create


@pytest.fixture
def blank(page: Page) -> Page:
    """A page of the server's origin without the program: modules are imported one by one."""
    page.route("**/blank.html", lambda route: route.fulfill(content_type="text/html", body=_RESTING))
    page.goto("/blank.html")
    page.unroute_all()  # with a route the browser asks for every module anew
    return page


@pytest.fixture(scope="module")
def import_page(browser: Browser, browser_context_args: dict[str, Any], base_url: str) -> Iterator[Page]:
    """A page for the tests of the import of one module, which need not load it again for each of them."""
    context = browser.new_context(**browser_context_args)
    page = context.new_page()
    open_compare(page)
    yield page
    context.close()


@pytest.fixture
def case(import_page: Page, page_guard: PageGuard) -> Iterator[Page]:
    """The empty Compare & diagnose view of that page; no diagnosis comes, the tests end before it."""
    page_guard.watch(import_page.context)
    import_page.route("**/api/diagnoses", lambda route: None)
    yield import_page
    run(import_page, EMPTY)
    import_page.unroute_all()
    import_page.set_viewport_size({"width": 1280, "height": 720})
    page_guard.leave(import_page.context)


EMPTY = """
for (const dialog of document.querySelectorAll("dialog")) dialog.close();
localStorage.clear();
const { edit, readDoc } = await import("/js/state.js");
edit((d) => readDoc({ ...d, view: "compare", compare: undefined }), "empty");
"""
