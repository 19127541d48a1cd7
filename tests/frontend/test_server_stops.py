"""A real server that is stopped for some seconds, killed and started again: what each view shows."""

from __future__ import annotations

import os
import re
import signal
import socket
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.frontend.comparing import drop
from tests.frontend.importing import plain
from tests.frontend.views import enter, open_compare, run
from tests.running_server import AUTHORIZED, RunningServer

INNER_WORDS = re.compile(
    r"TypeError|NetworkError|Failed to fetch|\b(?:GET|PUT|POST)\b|\bat https?:|Traceback"
)
NOISE = "(await import('/js/views/compare/answers.js')).editCompare({ noise: argument }, 'noise');"
DIMMED = """
const all = [...document.querySelectorAll(argument)].filter((el) => el.checkVisibility());
return all.length ? Math.max(...all.map((el) => Number(getComputedStyle(el).opacity))) : 1;
"""


def tab(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).first.click()


def task(page: Page) -> None:
    tab(page, "Design")
    page.get_by_role("radio", name="Find a drive", exact=True).click()


def muscle(page: Page) -> None:
    tab(page, "Design")
    page.get_by_role("radio", name="Muscle", exact=True).click()


# How to get to a view, what to change there the nth time, and what is dimmed until the answer comes.
View = tuple[Callable[[Page], None], Callable[[Page, int], Any], str]
VIEWS: dict[str, View] = {
    "Design": (muscle, lambda page, n: enter(page, "Rest length", str(280 + n)), "#force"),
    "Transient": (
        lambda page: tab(page, "Transient"),
        lambda page, n: enter(page, "Mass", str(15 + n)),
        ".transient .runs .plot, .transient .results > .card",
    ),
    "Compare & diagnose": (
        lambda page: tab(page, "Compare & diagnose"),
        lambda page, n: run(page, NOISE, 3.0 + n),
        "#overlay-force, #residual, .heat, .error-value",
    ),
    "Catalogue": (
        lambda page: tab(page, "Catalogue"),
        lambda page, n: page.get_by_role("button", name=f"Festo DMSP-{(10, 40)[n]}", exact=True).click(),
        ".catalogue .detail .plot",
    ),
}


def opacity_is(page: Page, name: str, *, dimmed: bool) -> bool:
    """Whether all that a view dims is dimmed, or none of it."""
    return (run(page, DIMMED, VIEWS[name][2]) < 1) == dimmed


def comes(page: Page, true: Callable[[], bool], within: int = 200) -> bool:
    """Whether something becomes true within so many tenths of a second."""
    for _ in range(within):
        if true():
            return True
        page.wait_for_timeout(100)
    return False


def has_changed(page: Page, number: int) -> None:
    """Every view, changed while no answer comes, dims what is out of date, and one banner says why."""
    banner = page.locator(".banner")
    for name, (go, change, _) in VIEWS.items():
        go(page)
        change(page, number)
        assert comes(page, partial(opacity_is, page, name, dimmed=True)), name
        expect(banner, name).to_have_count(1, timeout=20_000)
        expect(page.locator(".notice:visible .error, .fault:visible"), name).to_have_count(0)
        assert INNER_WORDS.findall(page.locator("body").inner_text()) == [], name


def is_back(page: Page) -> None:
    """By itself, in every view."""
    expect(page.locator(".banner")).to_have_count(0, timeout=20_000)
    for name, (go, _, _) in VIEWS.items():
        go(page)
        assert comes(page, partial(opacity_is, page, name, dimmed=False)), name
        expect(page.locator(".banner"), name).to_have_count(0)


def page_of_a_port(browser: Browser) -> tuple[Page, tuple[str, ...], list[str]]:
    """A page of a server yet to be started, the arguments that start it, the page's errors as they come."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    context = browser.new_context(
        base_url=f"http://127.0.0.1:{port}",
        viewport={"width": 1440, "height": 1000},
        extra_http_headers=AUTHORIZED,
    )
    page, faults = context.new_page(), list[str]()
    page.on("pageerror", lambda error: faults.append(str(error)))
    return page, ("--port", str(port)), faults


@pytest.mark.examination("tests/frontend/test_network.py::test_a_server_that_is_gone_and_comes_back")
def test_a_server_that_is_stopped_killed_and_started_again(browser: Browser, tmp_path: Path) -> None:
    page, arguments, faults = page_of_a_port(browser)
    with RunningServer(tmp_path, arguments=arguments) as server:
        open_compare(page)
        page.route("**/api/diagnoses", lambda route: None)
        page.locator(".tile", has_text="DMSP-20-300").click()
        expect(page.locator("#error-now")).to_be_visible(timeout=60_000)
        for go, _, dimmed in VIEWS.values():
            go(page)
            expect(page.locator(dimmed).first).to_be_visible(timeout=60_000)
        task(page)
        expect(page.get_by_role("button", name="Propose drives").first).to_be_visible()
        is_back(page)

        os.kill(server.pid, signal.SIGSTOP)
        has_changed(page, 0)
        expect(page.locator(".banner")).to_contain_text("takes long to answer")
        task(page)
        page.get_by_role("button", name="Propose drives").first.click()
        page.get_by_role("button", name=re.compile("^(Cancel|Stop)")).first.click()  # work that waits can end
        os.kill(server.pid, signal.SIGCONT)
        is_back(page)

        os.kill(server.pid, signal.SIGKILL)
        server.wait(10.0)
        has_changed(page, 1)
        expect(page.locator(".banner")).to_contain_text("does not answer")
        tab(page, "Compare & diagnose")
        drop(page, plain("dropped.csv"))
        expect(page.locator("dialog.import")).to_have_count(0)
        tab(page, "Studies")  # for the first time: its modules are not there yet
        expect(page.locator("main")).to_contain_text("This view loads when the server answers again")
    with RunningServer(tmp_path, arguments=arguments):
        # The file is looked at as soon as there is a server for it.
        expect(page.locator("dialog.import")).to_be_visible(timeout=60_000)
        page.keyboard.press("Escape")
        tab(page, "Studies")
        expect(page.locator(".studies")).to_contain_text("Many runs, one answer", timeout=20_000)
        is_back(page)
        assert INNER_WORDS.findall(page.locator("body").inner_text()) == []
        page.context.close()
    assert faults == []


RUNS = """
const { editStudy, study } = await import("/js/views/studies/model.js");
editStudy({ method: { ...study.peek().method, runs: argument } }, "runs");
"""


def study_of(page: Page, runs: int) -> None:
    """Start the study of the open view with so many runs."""
    run(page, RUNS, runs)
    page.get_by_role("button", name=f"Run {runs:,} runs").click()


def is_made(page: Page, runs: int) -> None:
    """The study is finished by itself, and nothing on the page says that it was not."""
    result = page.get_by_role("region", name="Result", exact=True)
    expect(result).to_contain_text(re.compile(rf"({runs}|{runs:,}) completed"), timeout=120_000)
    expect(page.locator(".banner")).to_have_count(0, timeout=20_000)
    assert INNER_WORDS.findall(page.locator("body").inner_text()) == []


@pytest.mark.examination("tests/frontend/test_network.py::test_a_server_that_is_gone_and_comes_back")
def test_a_study_goes_on_after_a_stop_and_after_a_restart(browser: Browser, tmp_path: Path) -> None:
    page, arguments, faults = page_of_a_port(browser)
    banner = page.locator(".banner")
    with RunningServer(tmp_path, arguments=arguments) as server:
        page.goto("/")
        tab(page, "Transient")
        page.get_by_role("button", name="How much does tolerance matter?").click(timeout=60_000)
        study_of(page, 40)
        is_made(page, 40)

        os.kill(server.pid, signal.SIGSTOP)
        study_of(page, 50)
        expect(banner).to_contain_text("takes long to answer", timeout=20_000)
        os.kill(server.pid, signal.SIGCONT)
        is_made(page, 50)

        study_of(page, 1200)
        expect(page.locator(".runs-table tbody tr").first).to_be_visible()
        expect(page.locator(".studies")).to_contain_text(re.compile(r"[1-9]\d* of 1,?200 runs"))
        os.kill(server.pid, signal.SIGKILL)  # in the middle of its runs
        server.wait(10.0)
        expect(banner).to_contain_text("does not answer", timeout=20_000)
        assert INNER_WORDS.findall(page.locator("body").inner_text()) == []
    with RunningServer(tmp_path, arguments=arguments) as server:
        is_made(page, 1200)

        os.kill(server.pid, signal.SIGKILL)
        server.wait(10.0)
        study_of(page, 60)  # asked of no server
        expect(banner).to_contain_text("does not answer", timeout=20_000)
    with RunningServer(tmp_path, arguments=arguments):
        is_made(page, 60)
        page.context.close()
    assert faults == []
