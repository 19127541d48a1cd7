"""The guard of the browser tests catches what it says it catches."""

from __future__ import annotations

import pytest
from playwright.sync_api import Browser

from tests.frontend.guard import PageGuard
from tests.running_server import AUTHORIZED

# What a page must not do, and the beginning of the guard's complaint about it.
OFFENCES = {
    "console.error('e')": "console error: e",
    "console.warn('w')": "console warning: w",
    "void setTimeout(() => { throw new Error('thrown') })": "uncaught error in the page: thrown",
    "void Promise.reject(new Error('rejected'))": "uncaught error in the page: rejected",
    "void fetch('http://localhost:9999/').catch(() => {})": "request to another origin: GET http://localhost:9999/",
}


def complaint(browser: Browser, url: str, script: str, *, allow: str | None = None) -> str:
    """What the guard says about a page of the server that ran this script."""
    guard = PageGuard(url)
    if allow is not None:
        guard.allow(allow)
    context = browser.new_context(
        bypass_csp=True, extra_http_headers=AUTHORIZED
    )  # else the policy stops what the guard is to see
    guard.watch(context)
    page = context.new_page()
    page.goto(f"{url}/api/health")
    page.evaluate(script)
    page.evaluate("new Promise(resolve => setTimeout(resolve, 50))")
    context.close()
    try:
        guard.check()
    except pytest.fail.Exception as failure:
        return str(failure)
    return ""


@pytest.mark.parametrize(("script", "expected"), OFFENCES.items())
def test_offence_is_caught(browser: Browser, server_url: str, script: str, expected: str) -> None:
    assert expected in complaint(browser, server_url, script)


def test_quiet_page_passes(browser: Browser, server_url: str) -> None:
    assert complaint(browser, server_url, "console.info('hello')") == ""


def test_only_the_allowed_message_passes(browser: Browser, server_url: str) -> None:
    script = "console.error('meant: no such muscle'); console.error('not meant')"
    said = complaint(browser, server_url, script, allow="^meant")
    assert "console error: not meant" in said
    assert "no such muscle" not in said
