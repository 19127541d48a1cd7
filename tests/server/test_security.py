"""Only this machine, only this site, or only with the token; nothing too large, nothing outside."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben.server import security
from mckibben.server.app import create_app
from mckibben.server.security import JSON_LIMIT, SECURITY_HEADERS, UPLOAD_LIMIT, kept_token, new_token
from mckibben.server.settings import Settings, is_loopback
from tests.server.conftest import CSV, URL, assert_error

HEALTH = "/api/health"
JSON = {"content-type": "application/json"}
TOKEN = "a-token-of-43-characters-as-the-server-makes"

Open = Callable[..., TestClient]


@pytest.fixture
def opened(tmp_path: Path) -> Iterator[Open]:
    """A client of a server on some host with a token."""
    clients: list[TestClient] = []

    def make(host: str = "192.0.2.7", url: str = "http://192.0.2.7:8000", **settings: Any) -> TestClient:
        app = create_app(Settings(host=host, data=tmp_path, token=TOKEN, **settings))
        clients.append(TestClient(app, base_url=url, raise_server_exceptions=False, follow_redirects=False))
        return clients[-1]

    yield make
    for client in clients:
        client.close()


@pytest.mark.parametrize(
    "host",
    ["127.0.0.1", "127.0.0.1:8000", "localhost:8000", "LOCALHOST", "[::1]:8000", "[::1]", "127.0.0.1:9000"],
)
def test_loopback_names_are_answered(shared_client: TestClient, host: str) -> None:
    assert shared_client.get(HEALTH, headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "evil.example:8000",
        "127.0.0.1.evil.example",
        "localhost.evil.example",
        "192.168.1.5:8000",
        "0.0.0.0:8000",
        "127.0.0.1@evil.example",
        "127.0.0.1:port",
        "127.0.0.1/x",
        "[::1",
        "",
    ],
)
@pytest.mark.parametrize("path", [HEALTH, "/", "/vendor/plotly.min.js"])
def test_other_host_names_are_refused(shared_client: TestClient, host: str, path: str) -> None:
    assert_error(shared_client.get(path, headers={"host": host}), 403, code="host_refused")


@pytest.mark.parametrize(
    "headers",
    [
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": "http://127.0.0.1:8001"},
        {"origin": "http://127.0.0.1:8000", "sec-fetch-site": "cross-site"},
    ],
)
def test_other_sites_cannot_send_anything(shared_client: TestClient, headers: dict[str, str]) -> None:
    response = shared_client.post("/api/curves", content=b"{}", headers={**JSON, **headers})
    assert_error(response, 403, code="origin_refused")
    assert_error(shared_client.put("/api/measurements?name=a.csv", content=CSV, headers=headers), 403)


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"sec-fetch-site": "same-origin", "origin": URL},
        {"sec-fetch-site": "none"},
        {"origin": "http://127.0.0.1:8000"},
    ],
)
def test_the_own_site_can(shared_client: TestClient, headers: dict[str, str]) -> None:
    response = shared_client.post(
        "/api/curves", content=b'{"muscle": {"preset": "DMSP-20"}}', headers={**JSON, **headers}
    )
    assert response.status_code == 200


def test_a_preflight_of_another_site_gets_no_permission(shared_client: TestClient) -> None:
    response = shared_client.options(
        "/api/curves", headers={"origin": "http://evil.example", "access-control-request-method": "POST"}
    )
    assert_error(response, 403)
    assert not [name for name in response.headers if name.startswith("access-control")]


@pytest.mark.parametrize("path", [HEALTH, "/", "/vendor/plotly.min.js", "/nothing", "/api/nothing"])
def test_every_answer_carries_the_security_headers(shared_client: TestClient, path: str) -> None:
    for host in ("127.0.0.1", "evil.example"):
        response = shared_client.get(path, headers={"host": host})
        for name, value in SECURITY_HEADERS.items():
            assert response.headers.get_list(name) == [value]


def test_the_content_security_policy_allows_no_foreign_or_inline_script() -> None:
    directives = dict(
        part.strip().split(" ", 1) for part in SECURITY_HEADERS["content-security-policy"].split(";")
    )
    assert directives["default-src"] == "'self'"
    assert "script-src" not in directives
    for name in ("object-src", "base-uri", "frame-ancestors", "form-action"):
        assert directives[name] == "'none'"
    assert "unsafe-eval" not in str(directives)
    assert "http" not in str(directives)


def test_an_address_reachable_from_outside_needs_a_token() -> None:
    for host in ("0.0.0.0", "::", "192.0.2.7", "my-machine"):
        with pytest.raises(ValueError, match="token"):
            Settings(host=host)
    assert is_loopback("127.0.0.1")
    assert is_loopback("::1")
    assert is_loopback("localhost")
    assert len(new_token()) >= 43
    assert new_token() != new_token()


def test_without_the_token_nothing_is_answered(opened: Open) -> None:
    client = opened()
    for path in (
        HEALTH,
        "/",
        "/openapi.json",
        "/vendor/plotly.min.js",
        "/?token=wrong",
        "/?token=",
        "/?token=%FF",
    ):
        assert_error(client.get(path), 401, code="token_required")
    for header in (
        {"authorization": "Bearer wrong"},
        {"authorization": TOKEN},
        {"cookie": "mckibben-8000=wrong"},
    ):
        assert_error(client.get(HEALTH, headers=header), 401, code="token_required")
    assert_error(client.post(f"/api/curves?token={TOKEN}", content=b"{}", headers=JSON), 401)
    assert TOKEN not in client.get("/").text


def test_the_link_with_the_token_becomes_a_cookie_and_a_clean_address(opened: Open) -> None:
    client = opened()
    response = client.get(f"/?view=design&token={TOKEN}")
    assert response.status_code == 303
    assert response.headers["location"] == "/?view=design"
    cookie = response.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=lax" in cookie
    assert TOKEN not in response.headers["location"]
    assert client.get(HEALTH).status_code == 200
    assert client.get("/").status_code in (200, 404)


def test_the_link_of_the_opened_browser_works_once(opened: Open) -> None:
    """Other users see the arguments of programs, and with them the link."""
    client = opened(host="127.0.0.1", url=URL, once="a-code-that-works-once")
    assert_error(client.get("/?once=another"), 401)
    response = client.get("/?view=design&once=a-code-that-works-once")
    assert (response.status_code, response.headers["location"]) == (303, "/?view=design")
    assert client.get(HEALTH).status_code == 200
    assert client.get("/?once=a-code-that-works-once").headers["location"] == "/"  # of who is in already
    client.cookies.clear()
    assert_error(client.get("/?once=a-code-that-works-once"), 401)


def test_the_token_of_the_data_folder_is_kept_and_for_its_user_alone(tmp_path: Path) -> None:
    token = kept_token(tmp_path / "data")
    path = tmp_path / "data" / "token"
    assert kept_token(tmp_path / "data") == token
    if os.name == "posix":
        assert path.stat().st_mode & 0o777 == 0o600
        path.chmod(0o644)  # others may have read it
        assert kept_token(tmp_path / "data") != token
        assert path.stat().st_mode & 0o777 == 0o600
    path.write_text("short", "ascii")
    assert len(kept_token(tmp_path / "data")) == 43


def test_the_cookie_of_https_is_not_sent_in_clear_text(opened: Open) -> None:
    client = opened(url="https://192.0.2.7:8000")
    assert "; secure" in client.get(f"/?token={TOKEN}").headers["set-cookie"].lower()


def test_the_redirect_stays_on_this_server(opened: Open) -> None:
    for path in ("//evil.example/", "/%2F%2Fevil.example/", "/%5Cevil.example", "/\\evil.example"):
        response = opened().get(f"http://192.0.2.7:8000{path}?token={TOKEN}")
        assert response.status_code == 303
        location = response.headers["location"]
        assert location.startswith("/")
        assert not location.startswith(("//", "/\\"))


@pytest.mark.parametrize("scheme", ["Bearer", "bearer", "token"])
def test_the_token_can_come_in_the_authorization_header(opened: Open, scheme: str) -> None:
    assert opened().get(HEALTH, headers={"authorization": f"{scheme} {TOKEN}"}).status_code == 200


def test_on_every_interface_addresses_are_answered_but_foreign_names_are_not(opened: Open) -> None:
    bearer = {"authorization": f"Bearer {TOKEN}"}
    client = opened(host="0.0.0.0", url="http://192.168.1.5:8000")
    assert client.get(HEALTH, headers=bearer).status_code == 200
    assert_error(client.get(HEALTH, headers={**bearer, "host": "evil.example"}), 403, code="host_refused")


def test_a_declared_size_over_the_limit_is_refused_at_once(shared_client: TestClient) -> None:
    body = b" " * (JSON_LIMIT + 1)
    assert_error(shared_client.post("/api/curves", content=body, headers=JSON), 413, code="too_large")
    for length in (str(UPLOAD_LIMIT + 1), "9" * 5000):
        response = shared_client.put(
            "/api/measurements?name=a.csv", content=b"", headers={"content-length": length}
        )
        assert_error(response, 413, code="too_large")
    for length in ("-1", "1e3", "²"):
        response = shared_client.post(
            "/api/curves", content=b"", headers={b"content-length": length.encode()}
        )
        assert_error(response, 400)


def test_a_streamed_body_is_counted(shared_client: TestClient) -> None:
    def parts() -> Iterator[bytes]:
        for _ in range(12):
            yield b" " * 100_000

    assert_error(shared_client.post("/api/curves", content=parts(), headers=JSON), 413, code="too_large")


def test_a_measurement_may_be_larger_than_other_bodies(shared_client: TestClient) -> None:
    rows = "".join(f"{1 + row % 6};{0.25 + row % 50 / 1000:.3f};{row % 1000}\n" for row in range(100_000))
    content = b"pressure_bar;length_m;force_N\n" + rows.encode()
    assert len(content) > JSON_LIMIT
    assert shared_client.put("/api/measurements?name=big.csv", content=content).status_code == 200


@pytest.mark.parametrize(
    "path",
    [
        "/../pyproject.toml",
        "/..%2f..%2fpyproject.toml",
        "/%2e%2e/%2e%2e/pyproject.toml",
        "/js/..%2f..%2f..%2fREADME.md",
        "/..%5c..%5cpyproject.toml",
        "/%2e%2e%2f%2e%2e%2f%2e%2e%2f%2e%2e%2f%2e%2e%2fetc/passwd",
        "//etc/passwd",
        "/etc/passwd",
        "/index.html%00.js",
        "/.%2e/types/openapi.json",
        "/api/measurements/..%2f..%2fx",
        "/api/presets/muscles/..%2f..%2f..%2fpyproject",
        "/api/presets/..%2fmuscles/DMSP-20",
        "/vendor/..%2f..%2fplotly.min.js",
    ],
)
def test_no_path_leads_out_of_its_folder(shared_client: TestClient, path: str) -> None:
    assert_error(shared_client.get(f"{URL}{path}"), 404)


def test_the_own_account_needs_no_token_and_other_pages_do(
    opened: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whose connection it is, the kernel says (test_peer.py)."""
    monkeypatch.setattr(security, "is_own_account", lambda client, server: True)
    at = {"host": "127.0.0.1", "url": "http://127.0.0.1:8000"}
    assert opened(**at).get(HEALTH).status_code == 401
    client = opened(**at, own_account=True)
    assert client.get(HEALTH).status_code == 200  # a program
    for site, status in (("none", 200), ("same-origin", 200), ("same-site", 401), ("cross-site", 401)):
        assert client.get(HEALTH, headers={"sec-fetch-site": site}).status_code == status
    assert client.get(HEALTH, headers={"referer": "http://127.0.0.1:8000/"}).status_code == 401
    monkeypatch.setattr(security, "is_own_account", lambda client, server: False)
    assert opened(**at, own_account=True).get(HEALTH).status_code == 401
