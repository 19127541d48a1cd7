"""``/api/mysteries``: stories without answers, measurements that can be compared, answers when asked for."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.mysteries import MysterySummary, Reveal, matched
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.custom import CUSTOM
from mckibben.presets import MysteryPreset, PresetLibrary
from mckibben.presets.reading import BadDocumentError, parse
from mckibben.resources import presets_folder
from tests.server.answers import valid
from tests.server.conftest import assert_error, post
from tests.truth import mysteries as generator
from tests.truth.generate import case
from tests.truth.stories import MYSTERIES

FOLDER = presets_folder() / "mysteries"
CASES = {mystery.id: mystery for mystery in MYSTERIES}
PAIR = "two-lines-per-pressure"


@pytest.fixture(scope="module")
def library() -> PresetLibrary:
    return PresetLibrary(presets_folder())


@pytest.fixture(scope="module")
def listed(shared_client: TestClient) -> dict[str, dict[str, Any]]:
    """The answer by id."""
    response = shared_client.get("/api/mysteries")
    assert response.status_code == 200
    for item in response.json():
        valid(MysterySummary, item)
    return {item["id"]: item for item in response.json()}


def reveal(client: TestClient, mystery: str, *effects: str) -> dict[str, Any]:
    """A checked answer."""
    response = post(client, f"/api/mysteries/{mystery}/reveal", {"effects": effects})
    assert response.status_code == 200, response.text
    valid(Reveal, response.content)
    return response.json()


def request(mystery: dict[str, Any]) -> dict[str, Any]:
    """The body of a comparison with the start model."""
    model = {"drive": mystery["drive"]} if mystery["drive"] else {"muscle": mystery["muscle"]}
    return {**model, "effects": mystery["effects"], "measurements": [{"id": mystery["measurement"]}]}


def test_all_are_listed_and_none_tells_its_answer(listed: dict[str, dict[str, Any]]) -> None:
    assert set(listed) == set(CASES)
    assert len(listed) == 8
    kinds = {item["kind"] for item in listed.values()}
    assert {"isobaric", "static", "transient"} <= kinds
    for item in listed.values():
        assert 100 < len(item["story"]) < 600
        assert "hidden" not in item
        assert "sealed" not in item


@pytest.mark.parametrize("identity", CASES)
def test_regenerating_gives_the_same_data(identity: str) -> None:
    kept = json.loads((FOLDER / f"{identity}.json").read_text("utf-8"))
    fresh = generator.document(CASES[identity])
    assert {**kept, "data_columns": 0} == {**fresh, "data_columns": 0}
    for name, column in fresh["data_columns"].items():
        assert kept["data_columns"][name]["unit"] == column["unit"]
        # The last digit may be rounded the other way on another machine.
        step = 1.01 * 10.0 ** -generator.UNITS[name][2]
        assert np.allclose(kept["data_columns"][name]["values"], column["values"], rtol=0.0, atol=step)


@pytest.mark.parametrize("identity", CASES)
def test_readings_are_those_of_the_case(identity: str, library: PresetLibrary) -> None:
    preset = library.get("mysteries", identity)
    assert isinstance(preset, MysteryPreset)
    columns = preset.si_columns()
    rows = len(columns["pressure"])
    assert rows <= generator.MOST_ROWS
    told = CASES[identity]
    made = case(told.case, told.seed)
    assert made.rows >= rows
    for channel, values in made.measured.items():
        given = columns.get(channel)
        if given is None:  # a length that is kept as displacement, or the reverse
            continue
        step = -(-made.rows // generator.MOST_ROWS)
        assert np.max(np.abs(given - values[::step])) < 0.11 * made.noise[channel]


@pytest.mark.parametrize("identity", CASES)
def test_a_mystery_can_be_compared(
    identity: str, listed: dict[str, dict[str, Any]], shared_client: TestClient
) -> None:
    response = post(shared_client, "/api/comparisons", request(listed[identity]))
    assert response.status_code == 200, response.text
    answer = valid(ComparisonResult, response.content)
    assert answer.kind == listed[identity]["kind"]
    assert answer.rmse is not None
    told = CASES[identity]
    noise = case(told.case, told.seed).noise
    if len(noise) == 1:
        (level,) = noise.values()
        over = answer.rmse / level
        # What is hidden shows; where nothing is hidden only the noise is left.
        assert over > 3.0 if told.told else over == pytest.approx(1.0, abs=0.05)
    else:
        assert answer.rmse > 3.0  # over the noise already


def test_what_counts_as_right_exists(library: PresetLibrary) -> None:
    known = {*default_catalogue(), CUSTOM}
    for preset in library.list("mysteries"):
        assert isinstance(preset, MysteryPreset)
        for hidden in preset.answer().hidden:
            assert set(hidden.effects) <= known, preset.id
            assert not set(hidden.effects) & set(preset.effects), preset.id


def test_a_right_wrong_and_partial_diagnosis(shared_client: TestClient) -> None:
    accepted = [hidden["effects"] for hidden in reveal(shared_client, PAIR)["hidden"]]
    assert len(accepted) == 2
    right = [ids[0] for ids in accepted]
    assert reveal(shared_client, PAIR, *right)["found"] == [True, True]
    assert reveal(shared_client, PAIR, *right)["surplus"] == []
    assert reveal(shared_client, PAIR, accepted[1][-1])["found"] == [False, True]
    wrong = reveal(shared_client, PAIR, "leak", "no_such_effect")
    assert (wrong["found"], wrong["surplus"]) == ([False, False], ["leak", "no_such_effect"])
    # Two names for the same thing: one of them was not hidden.
    twice = reveal(shared_client, PAIR, *accepted[1])
    assert twice["found"] == [False, True]
    assert len(twice["surplus"]) == len(accepted[1]) - 1


def test_nothing_hidden_and_something_nobody_has_catalogued(
    listed: dict[str, dict[str, Any]], shared_client: TestClient
) -> None:
    nothing = reveal(shared_client, "much-ado")
    assert (nothing["hidden"], nothing["found"], nothing["surplus"]) == ([], [], [])
    assert nothing["text"]
    assert reveal(shared_client, "the-dip", CUSTOM)["found"] == [True]
    # The start model's own effects were no discovery and no mistake.
    start = reveal(shared_client, "the-dip", *listed["the-dip"]["effects"])
    assert (start["found"], start["surplus"]) == ([False], [])


def test_each_given_effect_stands_for_one_hidden_one() -> None:
    assert matched(["a"], [["a", "b"], ["a"]]) == ["a", None]
    # "a" has to give way so that both are found.
    assert matched(["a", "b"], [["a", "b"], ["a"]]) == ["b", "a"]
    assert matched([], [["a"]]) == [None]
    assert matched(["c"], []) == []


def test_an_unknown_mystery_names_the_nearest(shared_client: TestClient) -> None:
    error = assert_error(post(shared_client, "/api/mysteries/the-dop/reveal", {}), 404, code="not_found")
    assert error["hint"] == "Did you mean 'the-dip'?"
    assert_error(post(shared_client, "/api/mysteries/the-dip/reveal", {"effects": ["a b"]}), 422)
    assert_error(post(shared_client, "/api/mysteries/the-dip/reveal", {"guess": []}), 422)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"sealed": "bm90IGpzb24="}, "sealed"),
        ({"sealed": "%%%"}, "sealed"),
        ({"data_columns": {}}, "data_columns"),
        ({"data_columns": {"pressure": {"unit": "mm", "values": [1.0]}}}, "data_columns.pressure.unit"),
        (
            {
                "data_columns": {
                    "pressure": {"unit": "bar", "values": [1.0, 2.0]},
                    "force": {"unit": "N", "values": [1.0]},
                }
            },
            "data_columns.force.values",
        ),
    ],
)
def test_a_file_that_cannot_be_used_says_where(change: dict[str, Any], field: str) -> None:
    document = json.loads((FOLDER / "the-dip.json").read_text("utf-8")) | change
    with pytest.raises(BadDocumentError) as caught:
        parse(MysteryPreset, document, None)
    assert caught.value.findings[0].field == field
