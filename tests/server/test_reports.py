"""``POST /api/reports``: one well-formed file, the numbers of the other answers, nothing of a user's runs."""

from __future__ import annotations

import html
import json
import re
import shlex
from base64 import b64decode
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from fastapi.testclient import TestClient

from mckibben import cli
from mckibben.facts.comparison import COMPARISON
from tests.server.conftest import CSV, assert_error, post

NASTY = "<script>alert(1)</script>\"'&<img src=x onerror=alert(2)>"
MAP = {"muscle": {"preset": "DMSP-20"}, "measurement": "martens-dmsp-20-300"}


class Reader(HTMLParser):
    """Checks that tags are closed in order, and keeps what a browser would see."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: set[str] = set()
        self.attributes: list[tuple[str, str | None]] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.open.append(tag)
        self.handle_startendtag(tag, attrs)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes += attrs

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def report(client: TestClient, body: dict[str, Any]) -> str:
    """The file, checked: well-formed, self-contained, without anything that runs."""
    response = post(client, "/api/reports", body)
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "text/html; charset=utf-8"
    text = response.text
    page = Reader(text)
    assert not page.tags & {"script", "link", "img", "iframe", "object", "embed", "base", "form"}
    for name, value in page.attributes:
        assert not name.startswith("on"), name
        assert name not in ("src", "action", "style"), name
        # A link only saves a file that it holds itself.
        assert name != "href" or (value or "").startswith("data:application/json;base64,"), value
        assert name == "xmlns" or "://" not in (value or ""), (name, value)
    style = text[text.index("<style>") : text.index("</style>")]
    assert "url(" not in style
    assert "@import" not in style
    ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>\n"))
    return text


def attached(text: str) -> dict[str, str]:
    """Name and content of the files inside a report."""
    root = ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>\n"))
    return {
        link.attrib["download"]: b64decode(link.attrib["href"].partition(",")[2]).decode()
        for link in root.iter("a")
    }


def tables(text: str) -> dict[str, list[list[ElementTree.Element]]]:
    """Rows of cells by the first cell's text, over all tables."""
    root = ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>\n"))
    found: dict[str, list[list[ElementTree.Element]]] = {}
    for row in root.iter("tr"):
        cells = list(row)
        found.setdefault("".join(cells[0].itertext()), []).append(cells[1:])
    return found


def exact(cell: ElementTree.Element) -> float:
    """The exact value behind a figure."""
    (data,) = cell.iter("data")
    return float(data.attrib["value"])


@pytest.fixture(scope="module")
def diagnosed(shared_client: TestClient) -> tuple[str, dict[str, Any], dict[str, Any]]:
    """A report with the comparison and the diagnosis that it tells."""
    body = {**MAP, "effects": {}}
    answers = [post(shared_client, f"/api/{noun}", body).json() for noun in ("comparisons", "diagnoses")]
    return report(shared_client, body), *answers


def test_figures_are_those_of_the_comparison(diagnosed: tuple[str, dict, dict]) -> None:
    text, comparison, _ = diagnosed
    rows = tables(text)
    assert exact(rows["RMS error"][0][0]) == pytest.approx(comparison["rmse"], rel=1e-12)
    for name in ("nrmse_percent", "over_noise", "fit_percent"):
        assert exact(rows[COMPARISON[name].label][0][0]) == pytest.approx(comparison[name], rel=1e-12)
    assert exact(rows["Mean of the residual"][0][0]) == pytest.approx(comparison["residual_mean"])
    shown = "".join(rows["RMS error"][0][0].itertext())
    assert float(shown.split()[0]) == pytest.approx(comparison["rmse"], rel=1e-3)
    assert comparison["excluded"] == {"slack": 66}
    assert rows["Rows used"][0][0].text == "60 of 126"
    assert "Rows left out: 66 slack." in text
    assert comparison["sentences"][-1] in text
    for profile in comparison["where"]:
        assert any(exact(row[-1]) == pytest.approx(profile["rmse"]) for row in rows[profile["over"]])


def test_verdict_path_and_parameters_are_those_of_the_diagnosis(diagnosed: tuple[str, dict, dict]) -> None:
    text, _, diagnosis = diagnosed
    rows = tables(text)
    # A report is read by users of the command line.
    said = re.sub(r'"(use|keep)": \["(\w+)"\]', r"--\1 \2", diagnosis["verdict"]["sentence"])
    assert html.escape(said, quote=False) in text
    steps = diagnosis["path"]
    assert len(steps) > 1
    assert exact(rows["this model"][0][1]) == pytest.approx(steps[0]["rmse"])
    titles = {c["effect"]: c["title"] for c in diagnosis["candidates"]}
    for step in steps[1:]:
        cells = rows[f"+ {titles[step['added']]}"][0]
        assert exact(cells[1]) == pytest.approx(step["rmse"])
        assert exact(cells[2]) == pytest.approx(step["holdout_rmse"])
    values = {float(value) for value in re.findall(r'<data value="([^"]+)"', text)}
    for own in diagnosis["parameters"].values():
        for parameter in own.values():
            at_edge = parameter["at_bound"]
            assert at_edge or any(v == pytest.approx(parameter["value"], rel=1e-12) for v in values)
    assert ("stopped at its bound" in text) == any(
        p["at_bound"] for own in diagnosis["parameters"].values() for p in own.values()
    )


def test_it_says_where_everything_comes_from(diagnosed: tuple[str, dict, dict]) -> None:
    text, comparison, _ = diagnosed
    assert "Actuators 2017" in text  # of the measurement
    assert "66 slack" in text
    assert comparison["excluded"] == {"slack": 66}
    assert "not verified" in text
    assert "DMSP-20" in text
    for program in ("mckibben ", "Python ", "numpy ", "scipy "):
        assert program in text
    assert text.count("<math") > 3
    assert text.count("<svg") >= 5


def test_without_a_diagnosis_it_tells_the_comparison_and_its_fit(shared_client: TestClient) -> None:
    body = {**MAP, "fit": True, "free": ["braid_angle"]}
    fitted = post(shared_client, "/api/comparisons", body).json()
    text = report(shared_client, {**body, "diagnose": False})
    assert "What is missing" not in text
    rows = tables(text)
    assert exact(rows["RMS error"][0][0]) == pytest.approx(fitted["rmse"])
    angle = fitted["parameters"]["geometry"]["braid_angle"]
    cells = rows["Braid angle to the axis"][0]
    assert exact(cells[0]) == pytest.approx(angle["value"])
    assert "±" in "".join(cells[0].itertext())
    assert cells[1].text == "fitted to these data"


def test_history_is_told_with_the_error_of_each_model(shared_client: TestClient) -> None:
    steps = [{"label": "start model", "effects": {}}, {"label": "+ preset's own", "freed": []}]
    text = report(shared_client, {**MAP, "history": steps, "diagnose": False, "title": "Two steps"})
    rows = tables(text)
    assert "Two steps" in text
    assert "Dahl friction, break strain: preset: " in text  # an unverified value of an effect of the preset
    for step in steps:
        body = {**MAP, **({"effects": step["effects"]} if "effects" in step else {})}
        error = post(shared_client, "/api/comparisons", body).json()["rmse"]
        assert [
            exact(cells[-1 if cells is rows[step["label"]][-1] else 1]) for cells in rows[step["label"]]
        ] == (pytest.approx([error] * 2))


def test_texts_of_users_are_shown_and_never_run(client: TestClient) -> None:
    csv = CSV.replace(b"# kind: static", f"# kind: static\n# sample: {NASTY}".encode())
    identity = client.put("/api/measurements", params={"name": f"{NASTY}.csv"}, content=csv).json()["id"]
    body = {
        "muscle": {"preset": "DMSP-20"},
        "measurements": [{"id": identity}, {"id": identity, "use": "validation"}],
        "effects": {"custom": {"term": "c1*P*kappa", "c1": 1e-4}},
        "history": [{"label": NASTY, "effects": {}}],
        "title": NASTY,
        "diagnose": False,
    }
    text = report(client, body)
    assert "<script" not in text
    assert "<img" not in text
    assert text.count("&lt;script&gt;") >= 3
    assert identity in text
    assert "c1*P*kappa" in text
    assert "validation" in text


def test_a_transient_shows_every_channel_over_time(shared_client: TestClient) -> None:
    found = {item["id"]: item for item in shared_client.get("/api/mysteries").json()}["slow-to-let-go"]
    body = {"drive": found["drive"], "measurements": [{"id": found["measurement"]}], "diagnose": False}
    text = report(shared_client, body)
    answer = post(
        shared_client, "/api/comparisons", {k: v for k, v in body.items() if k != "diagnose"}
    ).json()
    rows = tables(text)
    for name, channel in answer["channels"].items():
        word = {"displacement": "stroke"}.get(name, name)
        assert exact(rows[f"RMS error, {word}"][0][0]) == pytest.approx(channel["rmse"])
        assert f"Measured and modelled {word} over time" in text
    assert "× noise" in text


def test_the_command_repeats_the_figures(
    diagnosed: tuple[str, dict, dict],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsysbinary: pytest.CaptureFixture[bytes],
) -> None:
    text, comparison, _ = diagnosed
    root = ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>\n"))
    (lines,) = ["".join(element.itertext()) for element in root.iter("pre")]
    inside = attached(text)
    assert set(inside) == {"model.json", "comparison.json", "diagnosis.json"}
    assert json.loads(inside["comparison.json"])["rmse"] == comparison["rmse"]
    (tmp_path / "model.json").write_text(inside["model.json"], "utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MCKIBBEN_DATA", str(tmp_path))
    assert cli.run([*shlex.split(lines.splitlines()[0])[1:], "--json"]) == 0
    repeated = json.loads(capsysbinary.readouterr().out)
    assert repeated["rmse"] == pytest.approx(comparison["rmse"], rel=1e-9)


def test_bad_requests_say_where(shared_client: TestClient) -> None:
    assert_error(post(shared_client, "/api/reports", {**MAP, "title": "x" * 201}), 422, field="title")
    body = {**MAP, "history": [{"label": "a", "effects": {"no_such": {}}}]}
    error = post(shared_client, "/api/reports", body)
    assert_error(error, 422, code="unknown_effect", field="history.0.effects.no_such")
    assert_error(post(shared_client, "/api/reports", {**MAP, "measurement": "0" * 64}), 404)
