"""Typed terms that cannot be computed: an error at the term from every path that takes effects."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from tests.server.conftest import CSV, assert_error, post
from tests.server.test_simulations import LIFT

MUSCLE = {"preset": "DMSP-20"}
STATIC = "martens-dmsp-20-300"
PLACE = "effects.custom.term"
# Term -> what the error names.
NO_VALUE = {
    "c/t": "'c / t' has no finite value at t = 0",
    "sqrt(a)+c/t": "'c / t' in 'sqrt(a)+c/t' has no finite value at t = 0",
    "c + 1/t": "'1 / t' in 'c + 1/t' has no finite value at t = 0",
    "c*sqrt(t - 5)": "'sqrt(t - 5)' in 'c*sqrt(t - 5)' has no finite value at t = 0",
    "c*(t - 5)**0.5": "'(t - 5) ** 0.5' in",
    "c*(t + 10)**1000": "'(t + 10) ** 1000' in",
    "tanh(v/(c-c))": "'v / (c - c)' in 'tanh(v/(c-c))' has no finite value",
    "c*exp(P/(v-v))": "'P / (v - v)' in 'c*exp(P/(v-v))' has no finite value",
    "abs(" * 24 + "c*v" + ")" * 24: "is too large",
    "(" + "-" * 480 + "c)(P)": "nested too deeply",
}
# What only the whole model shows: in a drive sign(v) is v/sqrt(v**2 + 1e-6), and P a difference of pressures.
IN_A_DRIVE_ALONE = {
    "c/(sign(v)*sqrt(v*v + 1e-3**2) - v)": "has no finite value",
    "c*(-2)**(kappa**(P - P))": "cannot be computed together with the rest of the model",
}


def body_of(path: str, term: str) -> dict[str, Any]:
    effects = {"custom": {"term": term}}
    if path == "/api/simulations":
        return {"drive": {**LIFT, "effects": effects, "duration": "0.2 s"}, "points": 11}
    body: dict[str, Any] = {"muscle": MUSCLE, "effects": effects}
    return (
        body
        | {
            "/api/curves": {"pressures": ["2 bar"], "points": 5},
            "/api/inverse": {"question": "pressure", "force": 500, "contraction": 0.1},
            "/api/comparisons": {"measurement": STATIC},
            "/api/diagnoses": {"measurement": STATIC},
        }[path]
    )


PATHS = ("/api/curves", "/api/inverse", "/api/simulations", "/api/comparisons", "/api/diagnoses")


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("term", NO_VALUE, ids=lambda term: term[:20])
def test_a_term_that_cannot_be_computed_is_an_error_at_the_term(
    shared_client: TestClient, path: str, term: str
) -> None:
    field = f"drive.{PLACE}" if path == "/api/simulations" else PLACE
    error = assert_error(post(shared_client, path, body_of(path, term)), 422, field=field)
    assert NO_VALUE[term] in error["message"]
    assert "\n" not in error["message"]


@pytest.mark.parametrize("path", ["/api/comparisons", "/api/diagnoses"])
def test_so_is_one_beside_a_drive(shared_client: TestClient, path: str) -> None:
    drive = {**LIFT, "effects": {"custom": {"term": "c/t"}}}
    answer = shared_client.put("/api/measurements?name=map.csv", content=CSV)
    body = {"drive": drive, "measurement": answer.json()["id"]}
    assert "'c / t'" in assert_error(post(shared_client, path, body), 422, field=PLACE)["message"]


@pytest.mark.parametrize("term", IN_A_DRIVE_ALONE)
def test_a_term_that_fails_in_a_drive_alone_has_curves(shared_client: TestClient, term: str) -> None:
    curves = post(shared_client, "/api/curves", body_of("/api/curves", term))
    assert curves.status_code == 200, curves.text
    answer = post(shared_client, "/api/simulations", body_of("/api/simulations", term))
    error = assert_error(answer, 422, field=f"drive.{PLACE}")
    assert f"'{term}'" in error["message"]
    assert IN_A_DRIVE_ALONE[term] in error["message"]
