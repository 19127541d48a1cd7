"""``POST /api/inverse``: each question, its unit, its flags; answers fit the curves."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest
from fastapi.testclient import TestClient

from mckibben.application.curves.inverse import InverseFinding
from tests.server.answers import valid
from tests.server.conftest import post

DMSP = {"preset": "DMSP-20"}


def ask(client: TestClient, question: str, **given: object) -> dict:
    """A checked answer."""
    response = post(client, "/api/inverse", {"muscle": DMSP, "question": question, **given})
    assert response.status_code == 200, response.text
    valid(InverseFinding, response.content)
    return response.json()


def codes(answer: dict) -> set[str]:
    """The codes of an answer's flags."""
    return {flag["code"] for flag in answer["flags"]}


def test_pressure_and_contraction_are_inverse_to_each_other(shared_client: TestClient) -> None:
    pressure = ask(shared_client, "pressure", force="500 N", contraction="10 %")
    assert pressure["unit"] == "Pa"
    assert 3e5 < pressure["value"] < 6e5
    contraction = ask(shared_client, "contraction", force="500 N", pressure=pressure["value"])
    assert contraction["unit"] == "1"
    assert contraction["value"] == pytest.approx(0.1, abs=1e-6)


def test_a_length_is_as_good_as_a_contraction(shared_client: TestClient) -> None:
    by_length = ask(shared_client, "pressure", force=500, length="270 mm")
    assert by_length["value"] == pytest.approx(
        ask(shared_client, "pressure", force=500, contraction=0.1)["value"], rel=1e-9
    )


def test_the_stroke_pressure_is_the_pressure_at_the_end_of_the_stroke(shared_client: TestClient) -> None:
    stroke = ask(shared_client, "stroke_pressure", load=500, stroke="30 mm")
    assert stroke["branch"].startswith("while shortening")
    filling = ask(shared_client, "pressure", force=500, length=0.27, direction=-1)["value"]
    assert stroke["value"] == pytest.approx(filling)
    at_rest = ask(shared_client, "pressure", force=500, length=0.27)["value"]
    # The friction of the preset, 17 N: filling takes more pressure than the mean curve.
    assert 0.03e5 < filling - at_rest < 0.3e5


def test_the_working_range_ends_at_the_contraction_under_load(shared_client: TestClient) -> None:
    answer = ask(shared_client, "working_range", load=500, pressure="6 bar")
    assert answer["unit"] == "m"
    end = ask(shared_client, "contraction", force=500, pressure="6 bar", direction=-1)["value"]
    assert end < ask(shared_client, "contraction", force=500, pressure="6 bar")["value"]  # friction
    assert answer["details"]["end"] == pytest.approx(end)
    assert answer["value"] == pytest.approx(0.3 * (end - answer["details"]["start"]))


def test_the_pressure_for_a_stroke_lifts_the_load_whatever_direction(shared_client: TestClient) -> None:
    """At that pressure a muscle that fills hangs exactly there; no direction can be asked for."""
    stroke = ask(shared_client, "stroke_pressure", load=500, stroke="30 mm")
    held = ask(shared_client, "contraction", force=500, pressure=stroke["value"], direction=-1)
    assert held["value"] == pytest.approx(0.1, abs=1e-6)
    assert held["branch"] == stroke["branch"]
    body = {"muscle": DMSP, "question": "stroke_pressure", "load": 500, "stroke": "30 mm", "direction": 0}
    refused = post(shared_client, "/api/inverse", body)
    assert refused.status_code == 422
    assert "direction" in refused.text


def test_out_of_reach_is_an_answer_with_a_flag(shared_client: TestClient) -> None:
    answer = ask(shared_client, "pressure", force="100 kN", contraction="20 %")
    assert answer["value"] is None
    assert {"out_of_reach", "over_force_limit"} <= codes(answer)


def test_limits_are_flagged(shared_client: TestClient) -> None:
    assert "over_pressure" in codes(ask(shared_client, "pressure", force=1000, contraction="20 %"))
    assert "over_contraction_limit" in codes(ask(shared_client, "contraction", force=1, pressure="6 bar"))
    assert "unverified" in codes(ask(shared_client, "contraction", force=500, pressure="6 bar"))


def test_many_questions_at_once_give_what_they_give_one_by_one(shared_client: TestClient) -> None:
    requests = [
        {
            "muscle": {"preset": ("DMSP-10", "DMSP-20", "DMSP-40")[number % 3]},
            "effects": None if number % 2 else {},
            "question": "contraction",
            "force": 10 + number,
            "pressure": "5 bar",
        }
        for number in range(60)
    ]
    one_by_one = [post(shared_client, "/api/inverse", request).content for request in requests]
    with ThreadPoolExecutor(16) as pool:
        at_once = list(
            pool.map(lambda request: post(shared_client, "/api/inverse", request).content, requests)
        )
    assert at_once == one_by_one
