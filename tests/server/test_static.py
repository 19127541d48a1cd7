"""The page, its files, and plotly.js."""

from __future__ import annotations

import gzip
import re
import sys
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from mckibben.resources import frontend_folder, plotly_javascript, presets_folder, user_folder
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.server.conftest import URL, assert_error

PAGE = '<!doctype html><link rel="icon" href="/icon.svg"><script src="/js/main.js"></script>'


@pytest.fixture
def page(tmp_path: Path) -> TestClient:
    """A server whose page is three small files."""
    folder = tmp_path / "page"
    (folder / "js").mkdir(parents=True)
    (folder / "index.html").write_text(PAGE, "utf-8")
    (folder / "js" / "main.js").write_text("export const long = 1;\n" * 200, "utf-8")
    (folder / "app.css").write_text("body {}", "utf-8")
    (tmp_path / "secret.txt").write_text("secret", "utf-8")
    (folder / "link.txt").symlink_to(tmp_path / "secret.txt")
    (folder / "js" / "out.js").symlink_to(tmp_path / "secret.txt")
    (folder / "js" / "nowhere.js").symlink_to(tmp_path / "none.js")
    return TestClient(create_app(Settings(data=tmp_path, frontend=folder)), base_url=URL)


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("/", "text/html"),
        ("/index.html", "text/html"),
        ("/js/main.js", "text/javascript"),
        ("/app.css", "text/css"),
    ],
)
def test_files_are_served_with_their_type_and_revalidated(page: TestClient, path: str, kind: str) -> None:
    response = page.get(path)
    assert response.status_code == 200
    assert response.headers["content-type"] == f"{kind}; charset=utf-8"
    assert response.headers["cache-control"] == "no-cache"
    again = page.get(path, headers={"if-none-match": response.headers["etag"]})
    assert again.status_code == 304
    assert not again.content


def test_what_the_page_links_is_kept_for_good_until_a_file_changes(page: TestClient, tmp_path: Path) -> None:
    text = page.get("/").text
    (link,) = re.findall(r'src="(/[0-9a-f]{16}/js/main.js)"', text)
    assert 'href="/icon.svg"' in text
    response = page.get(link)
    assert "immutable" in response.headers["cache-control"]
    assert response.content == page.get("/js/main.js").content
    (tmp_path / "page" / "js" / "other.js").write_text("export const other = 2;", "utf-8")
    (tmp_path / "page" / "js" / "main.js").write_text("export const long = 2;", "utf-8")
    # A page that is still open asks by the old name: it gets the file, which must not stay under that name.
    late = page.get(link)
    assert late.headers["cache-control"] == "no-cache"
    assert "long = 2" in late.text
    (new,) = re.findall(r'src="(/[0-9a-f]{16}/js/main.js)"', page.get("/").text)
    assert new != link
    assert "immutable" in page.get(new).headers["cache-control"]


def test_linked_files_are_compressed_and_the_same_each_time(page: TestClient) -> None:
    (link,) = re.findall(r'src="(/[0-9a-f]{16}/js/main.js)"', page.get("/").text)
    for _ in range(2):
        packed = page.get(link)
        plain = page.get(link, headers={"accept-encoding": "identity"})
        assert packed.headers["content-encoding"] == "gzip"
        assert "content-encoding" not in plain.headers
        assert packed.content == plain.content == page.get("/js/main.js").content
        for response in (packed, plain):
            assert response.headers["content-type"] == "text/javascript; charset=utf-8"
            assert response.headers["vary"].lower() == "accept-encoding"
    assert not page.head(link).content


@pytest.mark.parametrize(
    "path", ["js/none.js", "js/out.js", "index.html", "api/health", "link.txt", "js/../../secret.txt"]
)
def test_nothing_else_lies_under_that_name(page: TestClient, path: str) -> None:
    (name,) = re.findall(r'src="/([0-9a-f]{16})/js', page.get("/").text)
    assert_error(page.get(f"/{name}/{path}"), 404)


def test_larger_files_are_compressed(page: TestClient) -> None:
    assert page.get("/js/main.js").headers["content-encoding"] == "gzip"
    assert "content-encoding" not in page.get("/js/main.js", headers={"accept-encoding": "identity"}).headers


def test_a_folder_a_missing_file_and_a_link_out_are_not_found(page: TestClient) -> None:
    for path in ("/js", "/js/", "/main.js", "/link.txt"):
        assert_error(page.get(path), 404)


def test_head_answers_without_a_body(page: TestClient) -> None:
    response = page.head("/app.css")
    assert response.status_code == 200
    assert not response.content


def test_a_server_without_a_page_still_answers_the_api(tmp_path: Path) -> None:
    client = TestClient(create_app(Settings(data=tmp_path, frontend=tmp_path / "none")), base_url=URL)
    assert_error(client.get("/"), 404)
    assert client.get("/api/health").status_code == 200


def test_plotly_comes_from_its_wheel_and_is_kept_for_good(shared_client: TestClient) -> None:
    path, version = plotly_javascript()
    response = shared_client.get(f"/vendor/plotly.min.js?v={version}")
    assert response.headers["content-encoding"] == "gzip"
    assert response.headers["content-type"].startswith("text/javascript")
    assert "immutable" in response.headers["cache-control"]
    assert response.content == path.read_bytes()
    assert int(response.headers["content-length"]) < len(response.content) / 2
    assert shared_client.get("/api/health").json()["plotly"] == version


def test_plotly_without_the_right_version_is_revalidated(shared_client: TestClient) -> None:
    for query in ("", "?v=0.0.0"):
        response = shared_client.get(f"/vendor/plotly.min.js{query}", headers={"accept-encoding": "identity"})
        assert response.headers["cache-control"] == "no-cache"
        assert "content-encoding" not in response.headers
    again = shared_client.get("/vendor/plotly.min.js", headers={"if-none-match": response.headers["etag"]})
    assert again.status_code == 304


def test_the_compressed_bundle_is_made_once(shared_client: TestClient) -> None:
    bundle = shared_client.app.state.plotly  # type: ignore[attr-defined]
    assert bundle.compressed() is bundle.compressed()
    assert gzip.decompress(bundle.compressed()) == bundle.path.read_bytes()


def test_the_files_of_the_package_exist() -> None:
    assert (presets_folder() / "muscles").is_dir()
    assert (frontend_folder() / "index.html").is_file()


def test_the_data_folder_can_be_chosen(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("MCKIBBEN_DATA", str(tmp_path))
    assert user_folder() == tmp_path
    monkeypatch.delenv("MCKIBBEN_DATA")
    assert user_folder().name == "mckibben"


def test_the_user_folder_is_the_platforms_and_an_earlier_one_is_found_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("MCKIBBEN_DATA", raising=False)
    place, earlier = tmp_path / "platform" / "mckibben", tmp_path / "earlier" / "mckibben"
    monkeypatch.setattr("platformdirs.user_data_path", lambda *names, **options: place)
    monkeypatch.setattr("mckibben.resources._earlier_user_folder", lambda: earlier)
    assert user_folder() == place
    earlier.mkdir(parents=True)
    assert user_folder() == earlier
    place.mkdir(parents=True)
    assert user_folder() == place


@pytest.mark.skipif(sys.platform != "linux", reason="the places of Linux")
def test_the_user_folder_follows_the_desktop_standard(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("MCKIBBEN_DATA", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "share"))
    assert user_folder() == tmp_path / "share" / "mckibben"
    monkeypatch.delenv("XDG_DATA_HOME")
    assert user_folder() == tmp_path / ".local" / "share" / "mckibben"
