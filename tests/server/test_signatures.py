"""``POST /api/signatures``: the atlas over HTTP."""

from __future__ import annotations

import pytest
from fastapi.testclient import TestClient

from tests.server.conftest import assert_error, post

MUSCLE = {"preset": "DMSP-20", "nominal_length": "300 mm"}


def test_the_pictures_of_an_effect(shared_client: TestClient) -> None:
    body = {"muscle": MUSCLE, "effect": "coulomb_friction", "values": {"force": 20}}
    answer = post(shared_client, "/api/signatures", body).json()
    assert answer["values"]["force"] == 20
    assert answer["pressure"] == 8e5 or answer["pressure"] == 6e5
    declared = shared_client.get("/api/effects").json()["effects"]
    kinds = next(effect["kinds"] for effect in declared if effect["id"] == body["effect"])
    assert sorted(picture["kind"] for picture in answer["pictures"]) == sorted(kinds)
    loops = next(picture for picture in answer["pictures"] if picture["kind"] == "isobaric")
    assert [curve["level"] for curve in loops["curves"]] == pytest.approx(
        [answer["pressure"] * share for share in (1 / 3, 2 / 3, 1)]
    )
    assert loops["rms"] == pytest.approx(20, rel=0.02)  # less where the motion turns


def test_bad_questions_say_where(shared_client: TestClient) -> None:
    unknown = post(shared_client, "/api/signatures", {"muscle": MUSCLE, "effect": "coulomb_frictio"})
    assert_error(unknown, 422, code="unknown_effect", field="effect")
    for values in ({"force": -1e9}, {"no_such": 1.0}):
        body = {"muscle": MUSCLE, "effect": "coulomb_friction", "values": values}
        assert post(shared_client, "/api/signatures", body).status_code == 422
