"""The experiment over HTTP: asked in previews, stated per measurement, told in answers."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.measurement.form import ExperimentForms
from mckibben.application.measurement.summary import PreviewResult
from mckibben.measurement.experiment import FIELDS
from tests.application.truths import document, plateaus, specimen
from tests.measurement.reading.open_files import WRITERS, OpenFile
from tests.server.answers import valid
from tests.server.conftest import assert_error

#: What a file asks about its experiment -> field of the form.
ASKED = {"rest length": "rest_length", "load": "load", "supply": "supply"}


def put(client: TestClient, text: str, name: str = "a.csv") -> str:
    """Upload a file; its id."""
    response = client.put("/api/measurements", params={"name": name}, content=text.encode())
    assert response.status_code == 200, response.text
    return response.json()["id"]


def preview(client: TestClient, data: bytes, name: str = "a.csv", **query: str) -> dict[str, Any]:
    """The fields of the experiment of a preview, by name."""
    response = client.post("/api/measurements/preview", params={"name": name, **query}, content=data)
    assert response.status_code == 200, response.text
    valid(PreviewResult, response.content)
    return {field["field"]: field for field in response.json()["experiment"]}


def compare(client: TestClient, **body: Any) -> dict[str, Any]:
    """A comparison."""
    response = client.post("/api/comparisons", json={"effects": {}, **body})
    assert response.status_code == 200, response.text
    valid(ComparisonResult, response.content)
    return response.json()


@pytest.mark.parametrize("writer", WRITERS, ids=lambda writer: writer.__name__)
def test_a_preview_asks_what_the_file_leaves_open(client: TestClient, writer: Callable[[], OpenFile]) -> None:
    file = writer()
    fields = preview(client, file.data, file.name, muscle="DMSP-20")
    for about, name in ASKED.items():
        if about in file.about:
            assert fields[name]["required"]
            assert fields[name]["unanswered"]
            assert fields[name]["question"].endswith("?")
            assert re.match(r'"?\w+"?(: |$)', fields[name]["option"]), "in the words of a request"


def test_a_preview_knows_what_the_file_says(client: TestClient) -> None:
    said = preview(client, specimen(0.25).encode(), muscle="DMSP-20")
    rest = said["rest_length"]
    assert (rest["value"], rest["origin"], rest["where"]) == (0.25, "file", "a.csv, line 1")
    assert not rest["unanswered"]
    assert said["muscle"]["value"] == "DMSP-20"
    assert not said["muscle"]["unanswered"]
    assert "DMSP-40" in said["muscle"]["choices"]
    silent = preview(client, specimen(0.25, said=False).encode(), muscle="DMSP-20")
    rest = silent["rest_length"]
    assert (rest["value"], rest["origin"], rest["unanswered"]) == (0.3, "assumed", True)
    nobody = preview(client, specimen(0.25, said=False).encode())
    assert nobody["rest_length"]["value"] is None
    assert nobody["muscle"]["unanswered"]
    you = preview(
        client, specimen(0.25, said=False).encode(), mapping='{"rest_length": "0.26 m"}', muscle="DMSP-20"
    )
    assert (you["rest_length"]["value"], you["rest_length"]["origin"]) == (0.26, "you")
    response = client.post(
        "/api/measurements/preview", params={"name": "a.csv", "muscle": "DMSP-21"}, content=b"x\n1\n"
    )
    assert_error(response, 422)


def test_a_preview_offers_accuracies(client: TestClient) -> None:
    fields = preview(client, plateaus(np.zeros(4)).encode(), muscle="DMSP-20")
    length = fields["accuracy_length"]
    assert (length["value"], length["unit"], length["origin"]) == (1e-3, "m", "assumed")
    assert "caliper" in length["choices"]
    assert fields["accuracy_force"]["value"] == 0.005
    assert "accuracy_diameter" not in fields
    assert "supply" not in fields


def test_a_reading_at_rest_is_proposed_as_zero(client: TestClient) -> None:
    rows = ["# nominal_length: 300 mm", "pressure_bar,length_mm,force_N"]
    rows += [f"{0.001 * n},300,{12 + 0.1 * (n % 2)}" for n in range(20)]
    rows += [
        f"{p},{length},{12 + 200 * p - 3 * (300 - length)}" for p in (1, 2, 3) for length in (300, 280, 260)
    ]
    field = preview(client, "\n".join(rows).encode())["force_zero"]
    assert field["value"] is None  # a proposal is never used unasked
    assert field["proposed"] == pytest.approx(12.05, abs=0.06)


def test_each_measurement_states_its_own(client: TestClient) -> None:
    silent, said = put(client, specimen(0.25, said=False)), put(client, specimen(0.4, seed=2), "b.csv")
    answer = compare(
        client,
        muscle={"preset": "DMSP-20"},
        measurements=[
            {"id": silent, "experiment": {"rest_length": {"value": "250 mm", "origin": "suggested"}}},
            {"id": said},
        ],
        accuracy="force 0.2 %",
        experiment={"force_zero": "1 N"},
    )
    first, second = (each["experiment"] for each in answer["specimens"])
    assert first["rest_length"] == {
        "value": 0.25, "unit": "m", "origin": "suggested",
        "where": "measurements.0.experiment.rest_length",
    }  # fmt: skip
    assert (second["rest_length"]["value"], second["rest_length"]["origin"]) == (0.4, "file")
    for each in (first, second):
        assert each["accuracy_force"]["where"] == "accuracy"
        assert each["force_zero"]["where"] == "experiment.force_zero"
    assert answer["assumptions"] == []


def test_what_all_files_say_at_different_places_is_common(client: TestClient) -> None:
    rows = "pressure_bar,length_mm,force_N\n" + "".join(
        f"{p},{length},{100.0 * p - (300 - length)}\n" for p in (2, 4, 6) for length in range(250, 301, 5)
    )
    said = "# rest length: 300 mm\n"
    ids = [
        put(client, text, name) for name, text in (("a.csv", said + rows), ("b.csv", f"# b\n{said}{rows}"))
    ]
    told = compare(client, muscle={"preset": "DMSP-20"}, measurements=[{"id": one} for one in ids])
    found = told["experiment"]["rest_length"]
    assert (found["value"], found["origin"], found["where"]) == (0.3, "file", "each file")
    places = [one["experiment"]["rest_length"]["where"] for one in told["specimens"]]
    assert places[0] != places[1]


def test_every_door_takes_the_rest_length_of_the_file(client: TestClient) -> None:
    answer = compare(client, muscle={"preset": "DMSP-20"}, measurement=put(client, specimen(0.25)))
    assert answer["geometry"]["nominal_length"] == 0.25
    assert answer["experiment"]["rest_length"]["origin"] == "file"
    # A form sends the default length of its preset unasked.
    answer = compare(
        client,
        muscle={"preset": "DMSP-20", "nominal_length": 0.3},
        measurement=put(client, specimen(0.25)),
    )
    assert answer["geometry"]["nominal_length"] == 0.25
    # A muscle by its geometry needs no length of its own.
    answer = compare(client, muscle=document(), measurement=put(client, specimen(0.25)))
    assert answer["geometry"]["nominal_length"] == 0.25


@pytest.mark.parametrize("path", ["/api/comparisons", "/api/diagnoses", "/api/reports"])
def test_a_contradiction_is_refused_and_decided(client: TestClient, path: str) -> None:
    body: dict[str, Any] = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "451 mm"},
        "effects": {},
        "measurements": [{"id": put(client, specimen(0.25))}],
    }
    error = assert_error(client.post(path, json=body), 422, field="measurements.0.experiment.rest_length")
    for word in ("250 mm", "451 mm", "muscle.nominal_length", "a.csv"):
        assert word in error["message"]
    body["measurements"][0]["experiment"] = {"rest_length": "250 mm"}
    asked = client.post("/api/experiments", json=body)
    valid(ExperimentForms, asked.content)
    assert asked.json()["problem"] is None
    assert client.post("/api/comparisons", json=body).status_code == 200


def test_strict_refuses(client: TestClient) -> None:
    body = {
        "muscle": {"preset": "DMSP-20"},
        "measurement": put(client, specimen(0.25, said=False)),
        "strict": True,
    }
    error = assert_error(client.post("/api/comparisons", json=body), 422, field="experiment.rest_length")
    assert "rest length is not stated" in error["message"]
    assert error["hint"].startswith('"rest_length": "')


@pytest.mark.parametrize(
    ("experiment", "field"),
    [
        ({"rest_length": "3 bar"}, "rest_length"),
        ({"rest_length": -1.0}, "rest_length"),
        ({"load": 3}, "load"),
        ({"load": "3 bar"}, "load"),
        ({"fixed_end": "left"}, "fixed_end"),
        ({"accuracy": "speed 2 %"}, "accuracy"),
        ({"rest_length": {"value": "1 m", "origin": "assumed"}}, "rest_length"),
        ({"rest_length": {"origin": "you"}}, "rest_length"),
        ({"rest": "1 m"}, "rest"),
        ({"muscle": "DMSP-21"}, "muscle"),
    ],
)
def test_bad_statements_name_their_field(client: TestClient, experiment: dict[str, Any], field: str) -> None:
    body = {
        "muscle": {"preset": "DMSP-20"},
        "measurements": [{"id": put(client, specimen(0.25)), "experiment": experiment}],
    }
    assert_error(client.post("/api/comparisons", json=body), 422, field=f"measurements.0.experiment.{field}")


def test_what_an_answer_assumes_the_form_shows(client: TestClient) -> None:
    """Every assumed value of a diagnosis is in the form that comes before it, with the same value."""
    moving = [f"{0.1 * n},{3 + 0.1 * (n % 7)},{n % 9}" for n in range(60)]
    texts = (
        specimen(0.25, said=False),
        plateaus(np.zeros(4)),
        "\n".join(["time_s,pressure_bar,displacement_mm", *moving]),
    )
    for text in texts:
        identity = put(client, text)
        body = {"muscle": {"preset": "DMSP-20"}, "effects": {}, "measurement": identity}
        if "displacement" in text and "force" not in text:
            body["experiment"] = {"load": "6 kg"}
        fields = preview(client, text.encode(), muscle="DMSP-20")
        form = client.post("/api/experiments", json=body).json()
        assert form["problem"] is None
        answer = compare(client, **body)
        assert answer["assumptions"] == form["assumptions"]
        assumed = {n: v for n, v in answer["experiment"].items() if v["origin"] == "assumed"}
        assert assumed
        shown = {field["field"]: field for field in form["measurements"][0]["experiment"]}
        for name, value in assumed.items():
            for where in (fields, shown):
                assert where[name]["value"] == pytest.approx(value["value"]) or (
                    where[name]["value"] == value["value"]
                )
                assert where[name]["origin"] == "assumed"


def test_the_form_says_what_stands_in_the_way(client: TestClient) -> None:
    rows = ["time_s,command,pressure_bar,displacement_mm"]
    rows += [f"{0.01 * n},{int(n > 9)},{min(n, 60) / 10},{min(n, 50)}" for n in range(120)]
    identity = put(client, "\n".join(rows))
    body: dict[str, Any] = {"muscle": {"preset": "DMSP-20"}, "measurements": [{"id": identity}]}
    form = client.post("/api/experiments", json=body).json()
    assert "valve" in form["problem"]["message"]
    fields = {field["field"]: field for field in form["measurements"][0]["experiment"]}
    open_ones = {name for name, field in fields.items() if field["unanswered"]}
    assert open_ones == {"rest_length", "load", "supply", "valve"}
    assert fields["valve"]["value"] is None
    assert fields["supply"]["origin"] == "assumed"
    body["measurements"][0]["experiment"] = {
        "valve": "MPYE-5-1/8-HF", "load": "6 kg", "tube": "4 mm x 1 m", "stops": "0 % to 20 %",
        "rest_length": "300 mm", "supply": "6 bar",
    }  # fmt: skip
    form = client.post("/api/experiments", json=body).json()
    assert form["problem"] is None
    assert form["assumptions"] == []
    fields = {field["field"]: field for field in form["measurements"][0]["experiment"]}
    assert not any(field["unanswered"] for field in fields.values())
    answer = compare(client, **body)
    assert answer["experiment"]["valve"]["value"] == "MPYE-5-1/8-HF"


@pytest.mark.parametrize(
    ("name", "value"),
    [("valve", "MPYE"), ("tube", "2 mm of 1 m"), ("stops", "wide"), ("stops", "30 % to 20 %"),
     ("inclination", "100 deg")],
)  # fmt: skip
def test_a_bad_part_of_the_drive_names_its_field(client: TestClient, name: str, value: str) -> None:
    rows = ["time_s,command,pressure_bar,displacement_mm"]
    rows += [f"{0.01 * n},{int(n > 9)},{min(n, 60) / 10},{min(n, 50)}" for n in range(120)]
    said = {"valve": "MPYE-5-1/8-HF", "load": "6 kg", name: value}
    body = {
        "muscle": {"preset": "DMSP-20"},
        "measurements": [{"id": put(client, "\n".join(rows)), "experiment": said}],
    }
    answer = client.post("/api/comparisons", json=body)
    assert_error(answer, 422, field=f"measurements.0.experiment.{name}")


def test_a_diagnosis_tells_what_the_accuracy_took_up(client: TestClient) -> None:
    errors = np.array([1.2e-3, -0.8e-3, 0.5e-3, -1.5e-3, 0.9e-3])
    body = {
        "muscle": document(),
        "effects": {},
        "measurement": put(client, plateaus(errors)),
        "accuracy": "length 1 mm, force 0.1 %, pressure 2 mbar",
    }
    response = client.post("/api/diagnoses", json=body)
    answer = valid(DiagnosisResult, response.content)
    assert answer.verdict.status == "adequate"
    absorbed = {each.of: each for each in answer.absorbed}
    assert len(absorbed) == len(errors)
    assert all(each.channel == "length" and each.unit == "m" for each in answer.absorbed)
    # The clamps are listed from the shortest length; the first error belongs to the longest.
    found = np.array([each.value for each in answer.absorbed])[::-1]
    assert np.max(np.abs(found - errors)) < 0.4e-3
    assert any("clamped at" in message for message in answer.messages)
    assert answer.experiment["accuracy_length"].origin == "you"


def test_fields_of_requests_and_declarations_agree(client: TestClient) -> None:
    known = client.get("/openapi.json").json()["components"]["schemas"]["ExperimentInput"]["properties"]
    declared = {name for name in FIELDS if not name.startswith("accuracy_")} | {"accuracy"}
    assert set(known) == declared
    assert json.dumps(known["rest_length"]).count('"suggested"') == 1


def test_a_report_tells_who_says_what(client: TestClient) -> None:
    body = {
        "muscle": document(),
        "effects": {},
        "measurements": [
            {"id": put(client, specimen(0.25)), "experiment": {"force_zero": "1 N"}},
            {"id": put(client, specimen(0.4, seed=2), "b.csv")},
        ],
        "accuracy": "length caliper",
        "diagnose": False,
    }
    response = client.post("/api/reports", json=body)
    assert response.status_code == 200, response.text
    page = response.text
    for words in (
        "Who says it", "the file (a.csv, line 1)", "the file (b.csv, line 1)", "stated (accuracy)",
        "stated (measurements.0.experiment.force_zero)", "Errors of reading within the accuracy",
        "assumed (zero error of each specimen)",
    ):  # fmt: skip
        assert words in page, words
    # The command states what the user stated of all files, and leaves each its own length.
    command = page[page.rindex("mckibben compare") :]
    assert "--accuracy &#x27;length 0.1 mm&#x27;" in command or "--accuracy 'length 0.1 mm'" in command
    assert "nominal_length" not in command
