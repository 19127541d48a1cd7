"""The rows of a file as a preview shows them, where its columns stand in them, the points of its picture."""

from __future__ import annotations

import io
import json

import numpy as np
from fastapi.testclient import TestClient
from openpyxl import Workbook

from mckibben.application.measurement.summary import PreviewResult
from tests.server.answers import valid
from tests.server.conftest import assert_error

PREAMBLE = ["Prüfprotoll;Zwick", "Probe;DMSP-20", "", "Nr.;Druck;Hub;Kraft", ";bar;mm;N"]
READINGS = [f"{n};{3 + n % 2};{n / 2:.1f};{900 - 4 * n}" for n in range(90)]


def preview(client: TestClient, content: bytes, name: str, **mapping: object) -> dict:
    query = {"name": name, **({"mapping": json.dumps(mapping)} if mapping else {})}
    response = client.post("/api/measurements/preview", params=query, content=content)
    assert response.status_code == 200, response.text
    valid(PreviewResult, response.content)
    return response.json()


def text(lines: list[str]) -> bytes:
    return "\n".join(lines).encode()


def test_the_rows_stand_as_in_the_file_with_head_and_units(client: TestClient) -> None:
    body = preview(client, text(PREAMBLE + READINGS), "a.csv")
    raw = body["raw"]
    assert (raw["head"], raw["units"], raw["head_moves"]) == (4, 5, True)
    shown = {row["row"]: row["cells"] for row in raw["rows"]}
    lines = PREAMBLE + READINGS
    assert all(cells == lines[number - 1].split(";") for number, cells in shown.items())
    assert list(shown) == list(range(1, 61))
    assert raw["also"] == []
    heads = {column["header"]: shown[4][column["place"]] for column in body["columns"]}
    assert heads == {name: name for name in ("Nr.", "Druck", "Hub", "Kraft")}


def test_a_head_far_down_is_among_the_rows(client: TestClient) -> None:
    remarks = [f"remark {n};x" for n in range(300)]
    raw = preview(client, text(remarks + PREAMBLE + READINGS), "a.csv")["raw"]
    assert raw["head"] == 304
    numbers = [row["row"] for row in raw["rows"]]
    assert numbers[0] == 1
    assert {304, 305, 306} < set(numbers)
    assert len(numbers) < 70


def test_another_head_is_taken_from_the_user(client: TestClient) -> None:
    # The names are on the row above the one that would be taken: both name columns.
    lines = ["p [bar];s [mm];F [N]", "Druck;Hub;Kraft", *[f"{3 + n % 2};{n};{900 - n}" for n in range(50)]]
    for head in (1, 2):
        body = preview(client, text(lines), "a.csv", head=head)
        assert body["raw"]["head"] == head
    response = client.post(
        "/api/measurements/preview", params={"name": "a.csv", "mapping": '{"head": 60}'}, content=text(lines)
    )
    assert "row" in assert_error(response, 422)["message"]


def test_comments_and_plain_files_are_shown_too(client: TestClient) -> None:
    body = preview(
        client, b"# nominal_length: 300 mm\npressure_bar,length_mm\n" + b"1,290\n2,280\n" * 9, "a.csv"
    )
    assert body["raw"]["rows"][0]["cells"] == ["# nominal_length: 300 mm"]
    assert (body["raw"]["head"], body["raw"]["units"]) == (2, None)
    assert [column["place"] for column in body["columns"]] == [0, 1]


def test_every_sheet_can_be_picked_and_says_whether_it_is_read(client: TestClient) -> None:
    book = Workbook()
    for title, factor in (("slow", 1.0), ("fast", 2.0)):
        sheet = book.create_sheet(title)
        sheet.append(["time [s]", "pressure [bar]", "length [mm]", "force [N]"])
        for n in range(20):
            sheet.append([n / 10, 3 + n % 2, 300 - n, factor * (500 - n)])
    del book["Sheet"]
    file = io.BytesIO()
    book.save(file)
    body = preview(client, file.getvalue(), "a.xlsx")
    assert [table["name"] for table in body["tables"]] == ["slow", "fast"]
    assert body["questions"][0]["about"] == "sheet"
    body = preview(client, file.getvalue(), "a.xlsx", sheet="fast")
    assert [table["is_read"] for table in body["tables"]] == [False, True]
    assert body["raw"]["rows"][1]["cells"] == ["0", "3", "300", "1000"]
    assert max(body["points"]["force"]) == 1000.0


def test_the_points_are_si_values_of_evenly_chosen_rows(client: TestClient) -> None:
    lines = ["time [ms];pressure [bar];stroke [mm];force [kN]"]
    lines += [f"{n};4;{n / 10:.1f};{(1000 - n) / 1000:.3f}" for n in range(1000)]
    body = preview(client, text(lines), "a.csv")
    points = {name: np.array(values) for name, values in body["points"].items()}
    rows = np.arange(0, 1000, 3)  # at most 400
    np.testing.assert_allclose(points["time"], rows / 1000)
    np.testing.assert_allclose(points["force"], 1000 - rows)
    np.testing.assert_allclose(points["displacement"], rows / 10000)


def test_a_picture_is_there_while_a_unit_is_asked(client: TestClient) -> None:
    lines = ["p;x;F", *[f"{200 + 100 * (n % 2)};{n};{900 - 9 * n}" for n in range(80)]]
    body = preview(client, text(lines), "a.csv")
    assert body["measurement"] is None
    assert any(question["stops"] for question in body["questions"])
    assert len(body["points"]["force"]) == 80


def test_only_a_channel_with_a_unit_has_an_origin_of_it(client: TestClient) -> None:
    lines = ["p [bar];s [mm];F;cycle", *[f"3;{n};{900 - n};1" for n in range(40)]]
    columns = {c["header"]: c for c in preview(client, text(lines), "a.csv")["columns"]}
    assert columns["F"]["unit_origin"] == "proposed"
    assert columns["cycle"]["unit_origin"] is None


def test_columns_that_come_again_beside_the_first_ones_are_marked(client: TestClient) -> None:
    lines = [
        "s 2 bar [mm];F 2 bar [N];s 4 bar [mm];F 4 bar [N]",
        *[f"{n};{400 - 4 * n};{n};{800 - 4 * n}" for n in range(40)],
    ]
    body = preview(client, text(lines), "a.csv")
    assert [column["place"] for column in body["columns"][:2]] == [0, 1]
    assert body["raw"]["also"] == [2, 3]
    assert body["rows"] == 80
