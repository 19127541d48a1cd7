"""``GET /api/effects``: everything an effect file declares, also of the user's own files."""

from __future__ import annotations

from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from mckibben.physics.catalogue import BUILT_IN_FOLDER
from mckibben.physics.errors import InputError
from mckibben.server.app import create_app
from mckibben.server.routes.effects import EffectsAnswer
from mckibben.server.settings import Settings
from tests.server.answers import valid
from tests.server.conftest import URL, assert_error, post


def test_every_effect_file_is_listed_as_declared(shared_client: TestClient) -> None:
    response = shared_client.get("/api/effects")
    valid(EffectsAnswer, response.content)
    body = response.json()
    files = {path.stem for path in BUILT_IN_FOLDER.glob("*.py") if not path.stem.startswith("_")}
    assert {effect["id"] for effect in body["effects"]} == files
    assert body["problems"] == []
    for effect in body["effects"]:
        assert effect["equation_mathml"].startswith("<math")
        assert all(parameter["symbol_mathml"].startswith("<math") for parameter in effect["parameters"])


def test_the_list_is_sent_once(shared_client: TestClient) -> None:
    first = shared_client.get("/api/effects")
    again = shared_client.get("/api/effects", headers={"if-none-match": first.headers["etag"]})
    assert again.status_code == 304
    assert not again.content


def test_a_new_effect_file_appears_everywhere(tmp_path: Path) -> None:
    source = (BUILT_IN_FOLDER / "prestress.py").read_text("utf-8")
    (tmp_path / "my_offset.py").write_text(source, "utf-8")
    (tmp_path / "broken.py").write_text("EFFECT = 1\n", "utf-8")
    (tmp_path / "prestress.py").write_text(source, "utf-8")
    settings = Settings(data=tmp_path / "data", effects=(tmp_path,))
    with TestClient(create_app(settings), base_url=URL) as client:
        body = client.get("/api/effects").json()
        assert "my_offset" in {effect["id"] for effect in body["effects"]}
        assert {problem["file"] for problem in body["problems"]} == {"broken.py", "prestress.py"}
        request = {"muscle": {"preset": "DMSP-20"}, "pressures": ["3 bar"], "contraction_from": 0}
        ideal = post(client, "/api/curves", {**request, "effects": {}}).json()
        with_it = post(client, "/api/curves", {**request, "effects": {"my_offset": {}}}).json()
        assert with_it["force"][0][0] < ideal["force"][0][0]
        assert_error(post(client, "/api/curves", {**request, "effects": {"broken": {}}}), 422)


# On numbers, as in its examples, it works.
LATER = "if not isinstance(force, float):\n        raise SystemExit('bye')\n    return -force"


def test_a_file_that_ends_the_program_is_told_and_the_server_goes_on(tmp_path: Path) -> None:
    source = (BUILT_IN_FOLDER / "prestress.py").read_text("utf-8")
    (tmp_path / "at_once.py").write_text("import sys\nsys.exit('bye')\n", "utf-8")
    (tmp_path / "later.py").write_text(source.replace("return -force", LATER), "utf-8")
    settings = Settings(data=tmp_path / "data", effects=(tmp_path,))
    with TestClient(create_app(settings), base_url=URL) as client:
        (problem,) = client.get("/api/effects").json()["problems"]
        assert problem["file"] == "at_once.py"
        assert problem["message"].startswith(
            "line 2: it ends the program (SystemExit: bye) when it is loaded"
        )
        for path, body in (
            ("/api/curves", {}),
            ("/api/diagnoses", {"measurement": "martens-dmsp-20-300"}),
        ):
            request = {"muscle": {"preset": "DMSP-20"}, "effects": {"later": {}}, **body}
            error = assert_error(post(client, path, request), 422, field="effects.later")
            assert "it ends the program (SystemExit: bye)" in error["message"]
        assert client.get("/api/health").status_code == 200


def test_a_missing_effects_folder_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        create_app(Settings(data=tmp_path, effects=(tmp_path / "none",)))
