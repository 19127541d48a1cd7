"""What leaves the page, how soon it is there, and what happens when the server is not."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import BrowserContext, Page, expect

from tests.frontend.axe import violations
from tests.frontend.comparing import measured, use
from tests.frontend.guard import PageGuard
from tests.frontend.views import enter, link_of, load, marked, open_catalogue, open_compare, open_design, run
from tests.running_server import opener

APP = Path(__file__).resolve().parents[2] / "frontend" / "app"


def test_requests_stay_on_the_origin(page: Page, server_url: str) -> None:
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    open_catalogue(page)
    network = [url for url in asked if urlsplit(url).scheme not in ("data", "blob", "about")]
    assert network
    assert {f"{urlsplit(url).scheme}://{urlsplit(url).netloc}" for url in network} == {server_url}


def test_no_file_of_the_frontend_names_another_origin() -> None:
    allowed = {"http://www.w3.org/2000/svg", "http://www.w3.org/1998/Math/MathML"}
    for path in APP.rglob("*"):
        if path.is_file() and path.parent.name != "fonts":  # the font, and its licence as it was given
            found = set(re.findall(r"https?://[^\s\"'<>)]+", path.read_text(encoding="utf-8")))
            assert found <= allowed, path


def test_no_effect_is_named_in_the_frontend(server_url: str) -> None:
    with opener().open(f"{server_url}/api/effects") as answer:
        effects = [effect["id"] for effect in json.load(answer)["effects"]]
    with opener().open(f"{server_url}/openapi.json") as answer:
        schemas = json.load(answer)["components"]["schemas"]
    # A muscle has a temperature and a wall whether or not effects of these names exist.
    fields = set(schemas["CurvesRequest"]["properties"]) | set(schemas["MuscleInput"]["properties"])
    effects = [name for name in effects if name not in fields]
    text = "\n".join(path.read_text(encoding="utf-8") for path in APP.rglob("*.js"))
    assert [name for name in effects if re.search(rf"\b{name}\b", text)] == []


def test_the_page_is_usable_before_the_plots(new_context: Callable[..., BrowserContext]) -> None:
    page = new_context().new_page()  # the first time: nothing is in the browser's cache
    page.goto("/")
    marked(page, '[data-ready="1"]')
    usable, plots_loaded = run(
        page,
        """
        const plots = performance.getEntriesByType("resource").find((entry) => entry.name.includes("plotly"));
        return [performance.getEntriesByName("usable")[0].startTime, plots?.responseEnd ?? Infinity];
        """,
    )
    assert usable < plots_loaded


def test_views_that_are_not_shown_are_fetched_when_they_are(page: Page) -> None:
    asked: list[str] = []
    page.on("request", lambda request: asked.append(urlsplit(request.url).path))
    open_design(page)
    pages = [f"/js/views/{view}/page.js" for view in ("transient", "compare", "catalogue", "studies")]
    assert not [path for path in asked if path.endswith(tuple(pages))]
    for name, path in zip(("Transient", "Compare & diagnose", "Catalogue", "Studies"), pages, strict=True):
        page.get_by_role("button", name=name, exact=True).click()
        expect(page.locator("main > div:visible")).not_to_contain_text("Loading")
        assert any(one.endswith(path) for one in asked)


def test_a_server_that_is_gone_and_comes_back(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow("Failed to load resource")
    open_design(page)
    page.route("**/api/curves", lambda route: route.abort())
    enter(page, "Rest length", "240")
    page.route("**/api/health", lambda route: route.abort())
    banner = page.locator(".banner")
    expect(banner).to_contain_text("server does not answer")
    for width in (1280, 390):  # its sign stands beside the text
        page.set_viewport_size({"width": width, "height": 720})
        sign, text = (banner.locator(part).first.bounding_box() for part in (".icon", "span"))
        assert sign
        assert text
        assert sign["x"] + sign["width"] <= text["x"]
        assert text["y"] - 4 <= sign["y"] <= text["y"] + text["height"] - sign["height"] + 4
    page.set_viewport_size({"width": 1280, "height": 720})
    expect(page.locator(".notice")).to_have_count(0)  # said once, for all views
    expect(page.locator(".centre")).to_have_class(re.compile("stale"))
    page.get_by_role("button", name="Catalogue", exact=True).click()
    expect(banner).to_be_visible()
    # A request that is held up while its route is taken away may never end: wait for the one of the view.
    with page.expect_event("requestfailed", lambda request: request.url.endswith("/api/curves")):
        page.get_by_role("button", name="Design", exact=True).click()
    with page.expect_response("**/api/curves"):
        page.unroute("**/api/curves")
        page.unroute("**/api/health")
    expect(banner).to_have_count(0)  # by itself
    expect(page.locator(".centre")).not_to_have_class(re.compile("stale"))

    # A server just installed says what makes it slow.
    for compiling, words in (("true", "compiles the simulation"), ("false", "takes long to answer")):
        run(
            page,
            f"""
            const server = await import("/js/server/connection.js"), ask = window.fetch;
            window.fetch = async () => new Response('{{"compiling": {compiling}}}');
            await server.look();
            window.fetch = ask;
            server.connection.value = "slow";
            """,
        )
        expect(banner).to_contain_text(words)
    run(page, '(await import("/js/server/connection.js")).connection.value = "up"')
    expect(banner).to_have_count(0)


def test_a_question_that_gets_lost_is_asked_again(blank: Page) -> None:
    """A network that sleeps answers nothing and refuses nothing: the page must not wait for it for ever."""
    limits, asked, before, after = run(
        blank,
        """
        const { connection, look, lost } = await import("/js/server/connection.js");
        const limits = [], timeout = AbortSignal.timeout;
        AbortSignal.timeout = (ms) => (limits.push(ms), timeout.call(AbortSignal, 20));
        let asked = 0;
        const found = { ok: true, json: async () => ({ compiling: false }) };
        window.fetch = (path, { signal } = {}) =>
          asked++ ? Promise.resolve(found) : new Promise((_, fail) => {
            signal?.addEventListener("abort", () => fail(signal.reason));
          });
        lost();
        await Promise.race([look(), new Promise((done) => setTimeout(done, 2000))]);
        const before = connection.peek();
        const pause = () => new Promise((done) => setTimeout(done, 20));
        for (let i = 0; i < 500 && connection.peek() !== "up"; i++) await pause();
        return [limits, asked, before, connection.peek()];
        """,
    )
    assert (before, after, asked) == ("gone", "up", 2)
    assert limits == [10_000, 10_000]


def test_nothing_to_start_with(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow("Failed to load resource")
    page.route("**/api/**", lambda route: route.abort())
    page.goto("/")
    expect(page.locator(".banner")).to_contain_text("server does not answer")
    page.unroute("**/api/**")
    # It also tries by itself, so the button may be gone already.
    run(page, "document.querySelector('.banner button')?.click();")
    expect(page.locator(".banner")).to_be_hidden()
    expect(page.locator('#preset option[value="DMSP-20"]')).to_be_attached(timeout=15_000)


def test_an_answer_that_is_not_json(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow("Failed to load resource")
    open_design(page)
    page.route("**/api/curves", lambda route: route.fulfill(status=418, body="<html>proxy</html>"))
    enter(page, "Rest length", "240")
    expect(page.locator(".notice")).to_contain_text("status 418")


LOST_TUBE = """
const { edit } = await import('/js/state.js');
const withTube = (t) => ({ ...t, drive: { ...t.drive, tube: { ...t.drive.tube, preset: "my-tube" } } });
edit((d) => ({ ...d, view: "transient", transient: withTube(d.transient) }), "tube");
"""


def test_a_preset_that_the_server_has_no_more(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow("status of 422")
    open_design(page)
    with page.expect_response("**/api/simulations"):
        run(page, LOST_TUBE)
    banner = page.locator(".banner")
    expect(banner).to_contain_text("The server does not have the tube “my-tube”")
    expect(page.locator(".notice")).to_have_count(0)
    page.keyboard.press("Control+z")
    expect(banner).to_have_count(0)


@pytest.mark.examination("test_a_preset_that_the_server_has_no_more")
def test_a_measurement_that_the_server_has_no_more(
    page: Page, page_guard: PageGuard, server_url: str, tmp_path: Path
) -> None:
    page_guard.allow("status of 4(04|22)")
    refused = {"error": {"message": "no diagnosis in this test"}}
    page.route("**/api/diagnoses", lambda route: route.fulfill(status=422, json=refused))
    content = measured(1).encode()
    path = tmp_path / "lost.csv"
    path.write_bytes(content)

    def lose() -> None:
        kept = page.request.get(f"{server_url}/api/kept").json()["items"]
        for one in (each for each in kept if each["name"] == "lost.csv"):
            assert page.request.delete(f"{server_url}/api/kept/files/{one['id']}").ok

    open_compare(page)
    page.locator("#measurement-files").set_input_files(path)
    use(page)
    number, banner, strip = page.locator("#error-now"), page.locator(".banner"), page.locator(".strip")
    expect(number).to_be_visible(timeout=20_000)
    error = number.inner_text()

    # While the page still has the file, it sends it again by itself.
    lose()
    with page.expect_response("**/api/measurements?*"):
        run(page, "(await import('/js/views/compare/answers.js')).editCompare({ noise: 3 }, 'noise');")
    expect(number).to_have_text(error, use_inner_text=True, timeout=20_000)
    expect(banner).to_have_count(0)

    # Later one banner says it, with what to do; the file of that name brings everything back.
    link = link_of(page)
    lose()
    load(page, link)
    expect(banner).to_contain_text("The server does not have “lost.csv”")
    expect(banner.get_by_role("button", name="Restore")).to_be_visible()
    expect(page.locator(".notice, .flag")).to_have_count(0)
    expect(strip.locator("#next-what")).to_have_text("Choose the file again")
    expect(page.locator("body")).not_to_contain_text("PUT")
    assert violations(page) == []
    page.get_by_role("button", name="Catalogue", exact=True).click()
    with page.expect_file_chooser() as chooser:
        banner.get_by_role("button", name="Choose the file…").click()
    chooser.value.set_files(path)  # the answers to its import are known
    expect(banner).to_have_count(0)
    expect(number).to_have_text(error, use_inner_text=True, timeout=20_000)

    # A deleted one is restored at a click, and so is what it holds.
    lose()
    load(page, link)
    banner.get_by_role("button", name="Restore").click()
    expect(banner).to_have_count(0)
    expect(number).to_have_text(error, use_inner_text=True, timeout=20_000)
