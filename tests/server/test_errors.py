"""Every error has one shape, says where and what, and blames the right side."""

from __future__ import annotations

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from starlette.types import Message

from mckibben.server.settings import Settings
from tests.server.conftest import URL, assert_error, post, run_async

DMSP = {"preset": "DMSP-20"}

# path, body, status, field, words of the message or hint
REFUSED = [
    ("/api/curves", {}, "muscle", "missing"),
    ("/api/curves", {"muscle": DMSP, "presures": []}, "presures", "Did you mean 'pressures'?"),
    ("/api/curves", {"muscle": {"preset": "DMSP-21"}}, "muscle.preset", "Did you mean 'DMSP-20'?"),
    ("/api/curves", {"muscle": {"presett": "DMSP-20"}}, "muscle.presett", "Did you mean 'preset'?"),
    (
        "/api/curves",
        {"muscle": {**DMSP, "length": 0.3}},
        "muscle.length",
        "one of nominal_length, thread_length",
    ),
    ("/api/comparisons", {"muscle": DMSP, "measurement": "a" * 64, "noise": [2.0]}, "noise", "not a list"),
    (
        "/api/curves",
        {"muscle": DMSP, "effects": {"custom": {"term": "(" * 3000 + "P" + ")" * 3000}}},
        "effects.custom.term",
        "must have at most",
    ),
    (
        "/api/curves",
        {"muscle": {**DMSP, "nominal_length": "3 kg"}},
        "muscle.nominal_length",
        "a length is needed",
    ),
    ("/api/curves", {"muscle": {**DMSP, "nominal_length": -1}}, "muscle.nominal_length", "above 0 m"),
    ("/api/curves", {"muscle": {**DMSP, "nominal_length": True}}, "muscle.nominal_length", "300 mm"),
    ("/api/curves", {"muscle": {**DMSP, "braid_angle": "60 deg"}}, "muscle.braid_angle", "lengthen"),
    ("/api/curves", {"muscle": {**DMSP, "rhombus": {"side": 1}}}, "muscle.rhombus.along", "missing"),
    ("/api/curves", {"muscle": {}}, "muscle.nominal_length", "no length"),
    ("/api/curves", {"muscle": {"nominal_length": 0.3}}, "muscle", "no geometry"),
    (
        "/api/curves",
        {"muscle": {"nominal_length": 0.3, "braid_angle": 0.4}},
        "muscle.inside_diameter",
        "no diameter",
    ),
    (
        "/api/curves",
        {"muscle": {"nominal_length": 0.3, "inside_diameter": 0.02}},
        "muscle.braid_angle",
        "no braid angle",
    ),
    ("/api/curves", {"muscle": {"nominal_length": 0.3, "turns": 2}}, "muscle.thread_length", "without"),
    (
        "/api/curves",
        {"muscle": {"nominal_length": 0.3, "turns": 2, "thread_length": 0.2}},
        "muscle.thread_length",
        "not longer",
    ),
    (
        "/api/curves",
        {"muscle": {"nominal_length": 0.3, "turns": 2, "thread_length": 0.33, "braid_angle": 0.4}},
        "muscle.thread_length",
        "2 forms",
    ),
    ("/api/curves", {"muscle": DMSP, "effects": {"bladder": {}}}, "effects.bladder", "no effect"),
    (
        "/api/curves",
        {"muscle": DMSP, "effects": {"prestress": {"forse": 1}}},
        "effects.prestress.forse",
        "Did you mean 'force'?",
    ),
    (
        "/api/curves",
        {"muscle": DMSP, "effects": {"prestress": {"force": "1 bar"}}},
        "effects.prestress.force",
        "force",
    ),
    (
        "/api/curves",
        {"muscle": DMSP, "effects": {"prestress": {"force": 1e9}}},
        "effects.prestress.force",
        "typical",
    ),
    ("/api/curves", {"muscle": DMSP, "pressures": []}, "pressures", "at least 1"),
    ("/api/curves", {"muscle": DMSP, "pressures": [1e5] * 13}, "pressures", "at most 12"),
    ("/api/curves", {"muscle": DMSP, "pressures": [1e5, "x"]}, "pressures.1", "pressure"),
    ("/api/curves", {"muscle": DMSP, "points": 401}, "points", "at most 400"),
    ("/api/curves", {"muscle": DMSP, "points": 2.5}, "points", "whole number"),
    ("/api/curves", {"muscle": DMSP, "direction": 2}, "direction", "one of"),
    ("/api/curves", {"muscle": DMSP, "unclipped": "yes"}, "unclipped", "true or false"),
    ("/api/curves", {"muscle": DMSP, "contraction_from": "-30 %"}, "contraction_from", "braid lock"),
    ("/api/curves", {"muscle": DMSP, "contraction_to": "99 %"}, "contraction_to", "no muscle contracts"),
    (
        "/api/curves",
        {"muscle": DMSP, "contraction_from": 0.2, "contraction_to": 0.1},
        "contraction_to",
        "end of the range",
    ),
    ("/api/curves", {"muscle": DMSP, "fixed_length": "1 m"}, "fixed_length", "out of reach"),
    ("/api/curves", [], None, "must be an object, not a list"),
    ("/api/curves", None, None, "not null"),
    ("/api/inverse", {"muscle": DMSP}, "question", "missing"),
    ("/api/inverse", {"muscle": DMSP, "question": "presure"}, "question", "'pressure'"),
    ("/api/inverse", {"muscle": DMSP, "question": "pressure", "forc": 1, "length": 0.3}, "forc", "'force'"),
    ("/api/inverse", {"muscle": DMSP, "question": "pressure", "force": 1}, "length", "either"),
    (
        "/api/inverse",
        {"muscle": DMSP, "question": "pressure", "force": 1, "contraction": 1},
        "contraction",
        "contracts to 0 mm",
    ),
    (
        "/api/inverse",
        {"muscle": DMSP, "question": "stroke_pressure", "load": 1, "stroke": 1},
        "stroke",
        "no muscle",
    ),
    ("/api/comparisons", {"muscle": DMSP}, "measurements", "no measurement"),
    ("/api/comparisons", {"muscle": DMSP, "measurement": "a b"}, "measurement", "cannot be"),
    (
        "/api/comparisons",
        {"muscle": DMSP, "measurement": "x", "free": ["braid_angel"]},
        "free.0",
        "'braid_angle'",
    ),
]


@pytest.mark.parametrize(("path", "body", "field", "words"), REFUSED)
def test_a_request_that_cannot_be_used_names_the_field_and_what_would_be_right(
    shared_client: TestClient, path: str, body: object, field: str | None, words: str
) -> None:
    error = assert_error(post(shared_client, path, body), 422)
    assert error["field"] == field
    assert words in f"{error['message']} {error['hint']}"


BROKEN = {
    "nothing closed": b"{",
    "not a number": b'{"points": NaN}',
    "infinite": b'{"muscle": {"nominal_length": 1e400}}',
    "thousands of digits": b'{"points": ' + b"1" * 6000 + b"}",
    "a key twice": b'{"muscle": {}, "muscle": {}}',
    "deep": b"[" * 5000,
    "deep and closed": b"[" * 1010 + b"]" * 1010,
    "half a surrogate": b'{"muscle": {"preset": "\\ud800"}}',
    "not UTF-8": b'{"muscle": {"preset": "\xff"}}',
    "control character": b'{"muscle": "\x00"}',
}


@pytest.mark.parametrize("body", BROKEN.values(), ids=BROKEN.keys())
@pytest.mark.parametrize("path", ["/api/curves", "/api/inverse", "/api/comparisons", "/api/presets/muscles"])
def test_a_body_that_is_not_json_is_refused(shared_client: TestClient, path: str, body: bytes) -> None:
    response = shared_client.post(path, content=body, headers={"content-type": "application/json"})
    assert response.status_code in (400, 422)
    assert_error(response, response.status_code)


# body, field, words of the message
NOT_STRICT = [
    (b'{"points": NaN}', "points", "NaN"),
    (b'{"muscle": {"preset": "DMSP-20", "nominal_length": -Infinity}}', "muscle.nominal_length", "infinite"),
    (b'{"muscle": {"nominal_length": 1e400}, "points": NaN}', "muscle.nominal_length", "infinite"),
    (b'{"pressures": [1e5, {"a": [2, NaN]}], "points": NaN}', "pressures.1.a.1", "NaN"),
    (b'{"points": ' + b"1" * 6000 + b"}", "points", "infinite"),
    (b'{"muscle": {"preset": "\\ud800"}}', "muscle.preset", "surrogate"),
    (b'{"' + b"a" * 500 + b'": NaN}', "a" * 80, "NaN"),
    (b"NaN", None, "The body is NaN"),
    (b'{"points": 12, NaN}', None, "not valid JSON"),
    (b'{"points": "\xff"}', None, "not valid JSON"),
    (b'{"points": nan}', None, "not valid JSON"),
    (b'{".a": [{".b": NaN}]}', ".a.0..b", "NaN"),
    (b"[" * 900 + b"NaN" + b"]" * 900, "0." * 100, "NaN"),
    (b"[" * 100_000 + b"NaN", None, "not valid JSON"),
]


@pytest.mark.parametrize(("body", "field", "words"), NOT_STRICT, ids=range(len(NOT_STRICT)))
def test_what_json_cannot_hold_is_told_by_its_field(
    shared_client: TestClient, body: bytes, field: str | None, words: str
) -> None:
    response = shared_client.post("/api/curves", content=body, headers={"content-type": "application/json"})
    error = assert_error(response, 400, code="bad_json", field=field)
    assert error["field"] == field
    assert words in error["message"]
    assert error["hint"]


@pytest.mark.parametrize("text", ["a\\u0000b", "..", "../../etc/passwd", "a/../b", "\\u202e"])
def test_odd_ids_are_unknown_or_refused(shared_client: TestClient, text: str) -> None:
    body = f'{{"muscle": {{"preset": "{text}"}}}}'
    response = shared_client.post("/api/curves", content=body, headers={"content-type": "application/json"})
    assert_error(response, 422, field="muscle.preset")


def test_a_body_without_the_json_content_type_is_refused(shared_client: TestClient) -> None:
    for headers in (
        {"content-type": "text/plain"},
        {"content-type": "application/x-www-form-urlencoded"},
        {},
    ):
        assert_error(shared_client.post("/api/curves", content=b"{}", headers=headers), 415)


def test_an_empty_body_is_refused(shared_client: TestClient) -> None:
    response = shared_client.post("/api/curves", content=b"", headers={"content-type": "application/json"})
    assert_error(response, 422, code="missing")


@pytest.mark.parametrize(
    ("path", "hint"),
    [
        ("/api/curve", "/api/curves"),
        ("/api/presets", "/api/presets/"),
        ("/api/curves/", "/api/curves"),
        ("/nothing", "openapi.json"),
        ("/api/%00", None),
        ("/" + "x" * 5000, None),
    ],
)
def test_an_unknown_path_names_the_nearest(shared_client: TestClient, path: str, hint: str | None) -> None:
    error = assert_error(shared_client.get(path), 404, code="not_found")
    assert hint is None or hint in error["hint"]
    assert len(error["message"]) < 300


@pytest.mark.parametrize(
    ("method", "path"), [("GET", "/api/curves"), ("POST", "/"), ("DELETE", "/api/health")]
)
def test_a_wrong_method_names_the_right_one(shared_client: TestClient, method: str, path: str) -> None:
    response = shared_client.request(method, path)
    error = assert_error(response, 405)
    assert response.headers["allow"]
    assert "takes" in error["hint"]


def test_an_unexpected_error_has_an_id_and_stays_in_the_log(
    app: FastAPI, caplog: pytest.LogCaptureFixture
) -> None:
    @app.get("/api/broken")
    def broken() -> None:
        raise RuntimeError("the secret inside")

    with TestClient(app, base_url=URL) as client:
        response = client.get("/api/broken")
    error = assert_error(response, 500, code="internal_error")
    assert "secret" not in response.text
    reference = error["message"].partition("(")[2].partition(")")[0]
    assert reference
    assert reference in caplog.text
    assert "the secret inside" in caplog.text


def test_hanging_up_within_a_body_is_nobodys_error(
    app: FastAPI, settings: Settings, caplog: pytest.LogCaptureFixture
) -> None:
    parts: list[Message] = [
        {"type": "http.request", "body": b"time_s;p", "more_body": True},
        {"type": "http.disconnect"},
    ]
    sent: list[Message] = []

    async def receive() -> Message:
        return parts.pop(0)

    async def send(message: Message) -> None:
        sent.append(message)

    scope = {
        "type": "http",
        "method": "PUT",
        "path": "/api/measurements",
        "query_string": b"name=a.csv",
        "headers": [(b"host", b"127.0.0.1"), (b"content-length", b"1000")],
    }
    run_async(app(scope, receive, send))
    assert not caplog.records
    assert not sent
    assert not [path for path in settings.data.rglob("*") if path.is_file()]
