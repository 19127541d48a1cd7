"""``POST /api/curves``: shapes, physics at known points, limits and flags."""

from __future__ import annotations

import json
import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from fastapi.testclient import TestClient

from mckibben.application.curves.curves import CurvesResult
from tests.server.answers import valid
from tests.server.conftest import post

PAPER = {"braid_diameter": "10 mm", "braid_angle": "25 deg", "nominal_length": "100 mm"}
PRESSURES = ["1 bar", "3 bar", "6 bar"]


def curves(client: TestClient, muscle: dict, **options: object) -> dict:
    """A checked answer."""
    response = post(client, "/api/curves", {"muscle": muscle, **options})
    assert response.status_code == 200, response.text
    valid(CurvesResult, response.content)
    return response.json()


def test_the_shape_is_the_one_promised(shared_client: TestClient) -> None:
    answer = curves(shared_client, {"preset": "DMSP-20"}, pressures=PRESSURES, points=50)
    promised = {
        "pressure",
        "length",
        "contraction",
        "force",
        "stiffness",
        "volume",
        "diameter",
        "limits",
        "flags",
    }
    assert promised <= answer.keys()
    assert answer["pressure"] == [1e5, 3e5, 6e5]
    for name in ("length", "contraction", "volume", "diameter", "braid_angle"):
        assert len(answer[name]) == 50
    for name in ("force", "stiffness", "stiffness_closed"):
        assert [len(row) for row in answer[name]] == [50, 50, 50]
    assert answer["over_pressure"] is None
    assert answer["operating_points"] == []


def test_the_blocked_force_of_the_paper(shared_client: TestClient) -> None:
    answer = curves(shared_client, PAPER, pressures=PRESSURES)
    expected = [64.3855, 193.1566, 386.3132]
    assert [row[0] for row in answer["force"]] == pytest.approx(expected, abs=1e-4)
    assert [item["blocked_force"] for item in answer["characteristics"]] == pytest.approx(expected, abs=1e-4)


def test_characteristics_of_the_ideal_muscle(shared_client: TestClient) -> None:
    answer = curves(shared_client, PAPER, pressures=["6 bar"])
    figures = answer["characteristics"][0]
    assert figures["free_contraction"] == pytest.approx(0.3629645, abs=1e-7)
    assert figures["max_work"] == pytest.approx(6.49274, rel=1e-6)
    assert answer["limits"]["braid_lock_force"] == pytest.approx([527.6848], abs=1e-4)
    assert answer["limits"]["ideal_max_contraction"] == pytest.approx(0.3629645, abs=1e-7)
    assert answer["stiffness"][0][0] == pytest.approx(13003.11, abs=0.01)
    assert answer["stiffness_closed"][0][0] == pytest.approx(13003.11 + 51824.36, rel=1e-6)
    assert answer["volume"][0] == pytest.approx(7.853982e-6, rel=1e-6)
    assert answer["geometry"]["thread_length"] == pytest.approx(0.1103378, abs=1e-7)
    assert answer["geometry"]["turns"] == pytest.approx(1.4843034, abs=1e-7)


def test_the_three_forms_of_geometry_agree(shared_client: TestClient) -> None:
    first = curves(shared_client, PAPER, pressures=["6 bar"])
    geometry = first["geometry"]
    thread = {name: geometry[name] for name in ("thread_length", "turns", "nominal_length")}
    lattice = {"side": "1 mm", "along": geometry["thread_length"] / 2e-3}
    lattice["around"] = lattice["along"] / geometry["turns"]
    assert geometry["rhombus"] == pytest.approx(
        {"side": 2e-3, "along": lattice["along"] / 2, "around": lattice["around"] / 2}
    )
    for muscle in (thread, {"rhombus": lattice, "nominal_length": "100 mm"}):
        other = curves(shared_client, muscle, pressures=["6 bar"])
        assert other["force"][0] == pytest.approx(first["force"][0], rel=1e-9, abs=1e-6)
        assert other["geometry"]["braid_angle"] == pytest.approx(math.radians(25))
    assert other["geometry"]["rhombus"] == pytest.approx(
        {"side": 1e-3, **{k: lattice[k] for k in ("along", "around")}}
    )


def test_the_bore_is_the_braid_diameter_when_nothing_else_is_given(shared_client: TestClient) -> None:
    bore = {
        "inside_diameter": "10 mm",
        "braid_angle": "25 deg",
        "nominal_length": "100 mm",
        "wall_thickness": "1 mm",
    }
    answer = curves(shared_client, bore, pressures=["1 bar"])
    assert answer["geometry"]["braid_diameter"] == 0.01
    assert answer["geometry"]["wall_thickness"] == 0.001
    assert answer["force"][0][0] == pytest.approx(64.3855, abs=1e-4)


def test_fields_beside_a_preset_take_the_place_of_its_own(shared_client: TestClient) -> None:
    own = curves(shared_client, {"preset": "DMSP-20"})["geometry"]
    longer = curves(shared_client, {"preset": "DMSP-20", "nominal_length": "500 mm"})["geometry"]
    assert longer["nominal_length"] == 0.5
    assert longer["braid_angle"] == own["braid_angle"]
    wider = curves(shared_client, {"preset": "DMSP-20", "inside_diameter": "25 mm"})["geometry"]
    assert wider["braid_diameter"] == pytest.approx(own["braid_diameter"] + 0.005)
    thread = {"preset": "DMSP-20", "thread_length": own["thread_length"], "turns": own["turns"]}
    assert curves(shared_client, thread)["geometry"]["braid_angle"] == pytest.approx(own["braid_angle"])


def test_effects_null_are_the_presets_own_and_none_are_ideal(shared_client: TestClient) -> None:
    own = curves(shared_client, {"preset": "DMSP-20"})
    assert own["model"]["effects"]
    ideal = curves(shared_client, {"preset": "DMSP-20"}, effects={})
    assert ideal["model"]["effects"] == {}
    assert ideal["characteristics"][0]["blocked_force"] > own["characteristics"][0]["blocked_force"]
    assert curves(shared_client, PAPER)["model"]["effects"] == {}
    one = next(iter(own["model"]["effects"]))
    assert list(curves(shared_client, {"preset": "DMSP-20"}, effects={one: {}})["model"]["effects"]) == [one]


def test_an_assumed_wall_is_said_and_acts(shared_client: TestClient) -> None:
    ideal = curves(shared_client, PAPER)
    assert ideal["flags"] == []
    walled = curves(shared_client, PAPER, effects={"bladder_elasticity": {}})
    (flag,) = walled["flags"]
    assert (flag["code"], flag["field"]) == ("assumed", "muscle.wall_thickness")
    assert "is assumed" in flag["message"]
    assert walled["geometry"]["wall_thickness"] == pytest.approx(1.5e-3)
    assert walled["characteristics"][0]["free_contraction"] < ideal["characteristics"][0]["free_contraction"]
    stated = PAPER | {"wall_thickness": "1.5 mm"}
    assert curves(shared_client, stated, effects={"bladder_elasticity": {}})["force"] == walled["force"]


def test_units_of_a_request_do_not_matter(shared_client: TestClient) -> None:
    texts = curves(shared_client, PAPER, pressures=["600 kPa"], load="50 N", contraction_to="20 %")
    numbers = {"braid_diameter": 0.01, "braid_angle": math.radians(25), "nominal_length": 0.1}
    assert curves(shared_client, numbers, pressures=[6e5], load=50, contraction_to=0.2) == texts


def test_the_range_begins_at_the_permitted_stretch_and_holds_the_nominal_length(
    shared_client: TestClient,
) -> None:
    answer = curves(shared_client, {"preset": "DMSP-20"}, pressures=["6 bar"])
    assert answer["contraction"][0] == -answer["limits"]["max_pretension"]
    assert 0.0 in answer["contraction"]
    at_rest = answer["contraction"].index(0.0)
    assert answer["force"][0][at_rest] == pytest.approx(answer["characteristics"][0]["blocked_force"])
    assert answer["contraction"][-1] == pytest.approx(answer["characteristics"][0]["free_contraction"])
    given = curves(
        shared_client, {"preset": "DMSP-20"}, contraction_from="5 %", contraction_to="10 %", points=2
    )
    assert given["contraction"] == pytest.approx([0.05, 0.1])


def test_a_slack_muscle_pulls_with_nothing_unless_asked(shared_client: TestClient) -> None:
    options = {"pressures": ["1 bar"], "contraction_to": "40 %"}
    assert min(curves(shared_client, PAPER, **options)["force"][0]) == 0.0
    assert min(curves(shared_client, PAPER, unclipped=True, **options)["force"][0]) < 0.0


def test_operating_points_hold_the_load(shared_client: TestClient) -> None:
    answer = curves(shared_client, {"preset": "DMSP-20"}, pressures=["3 bar", "6 bar"], load="500 N")
    for point in answer["operating_points"]:
        assert point["force"] == 500.0
        assert point["length"] == pytest.approx(0.3 * (1.0 - point["contraction"]))
        assert point["stiffness_closed"] > point["stiffness"] > 0.0
    over = answer["over_pressure"]
    assert over["load"] == 500.0
    assert over["pressure"][-1] == 6e5
    # Without a direction a point lies between the branches of the preset's loop.
    branches = [over[way]["contraction"][-1] for way in ("filling", "venting")]
    point = answer["operating_points"][1]["contraction"]
    assert branches[0] < point < branches[1]
    assert sum(branches) / 2.0 == pytest.approx(point, rel=1e-3)
    loop = over["loop"]
    assert loop["pressure"] == [3e5, 6e5]
    assert loop["share"][1] == pytest.approx(branches[1] - branches[0], rel=1e-9)
    assert loop["stroke"][1] == pytest.approx(0.3 * loop["share"][1], rel=1e-9)
    assert 0.1e5 < loop["pressure_width"][0] < loop["pressure_width"][1] < 1e5
    assert over["force_at_fixed_length"] is None


def test_force_over_pressure_at_a_fixed_length(shared_client: TestClient) -> None:
    over = curves(shared_client, PAPER, pressures=["6 bar"], fixed_length="100 mm")["over_pressure"]
    assert over["load"] is None
    assert over["filling"] is None
    assert over["force_at_fixed_length"]["venting"][-1] == pytest.approx(386.3132, abs=1e-4)


def test_diameters_over_pressure_at_a_fixed_length(shared_client: TestClient) -> None:
    held = {"pressures": ["6 bar"], "fixed_length": "98 mm"}
    rigid = curves(shared_client, PAPER, **held)["over_pressure"]
    assert rigid["diameter_at_fixed_length"] == pytest.approx([rigid["diameter_at_fixed_length"][0]] * 81)
    stretched = curves(shared_client, PAPER, **held, effects={"thread_extensibility": {"compliance": 1e-5}})
    over = stretched["over_pressure"]
    # D = sqrt(b'^2 - L^2)/(n pi) with b' = b/(1 - q), q = P b L c/(2 pi n^2), by hand.
    length, thread = 0.098, 0.1 / math.cos(math.radians(25.0))
    turns = 0.1 * math.tan(math.radians(25.0)) / (math.pi * 0.01)
    for pressure, diameter in zip(over["pressure"], over["diameter_at_fixed_length"], strict=True):
        share = pressure * thread * length * 1e-5 / (2.0 * math.pi * turns**2)
        longer = thread / (1.0 - share)
        assert diameter == pytest.approx(math.sqrt(longer**2 - length**2) / (turns * math.pi), rel=1e-12)
    outer = over["outer_diameter_at_fixed_length"]
    assert outer[0] < outer[-1]


def test_the_stiffness_by_the_other_equations_of_the_paper(shared_client: TestClient) -> None:
    plain = curves(shared_client, PAPER, pressures=["3 bar", "6 bar"])
    assert (plain["stiffness_from_force"], plain["stiffness_secant"]) == (None, None)
    answer = curves(shared_client, PAPER, pressures=["3 bar", "6 bar"], further_stiffness=True)
    assert {name: answer[name] for name in plain if "stiffness_" not in name} == {
        name: plain[name] for name in plain if "stiffness_" not in name
    }
    # (20) of the ideal muscle is (19); its last column is the length without force, where it is the limit.
    for ours, tangent in zip(answer["stiffness_from_force"], answer["stiffness"], strict=True):
        assert ours[:-1] == pytest.approx(tangent[:-1], rel=1e-9)
    # (25) by hand: force over the way to b/sqrt(3).
    shortest = answer["geometry"]["thread_length"] / math.sqrt(3.0)
    for force, ours in zip(answer["force"], answer["stiffness_secant"], strict=True):
        lengths = answer["length"][:-1]
        by_hand = [f / (length - shortest) for f, length in zip(force[:-1], lengths, strict=True)]
        assert ours[:-1] == pytest.approx(by_hand, rel=1e-6)


def test_the_secant_of_a_real_muscle_begins_where_it_has_no_force(shared_client: TestClient) -> None:
    options = {"pressures": ["6 bar"], "further_stiffness": True, "unclipped": True, "contraction_to": "35 %"}
    answer = curves(shared_client, {"preset": "DMSP-20"}, **options)
    free = 0.3 * (1.0 - answer["characteristics"][0]["free_contraction"])
    columns = zip(answer["length"], answer["force"][0], answer["stiffness_secant"][0], strict=True)
    for length, force, secant in columns:
        assert secant == pytest.approx(force / (length - free), rel=1e-6)
    # The straight line of (20) has no value where only an ideal muscle has no force.
    ideal_shortest = answer["geometry"]["thread_length"] / math.sqrt(3.0)
    at = {
        "pressures": ["6 bar"],
        "further_stiffness": True,
        "unclipped": True,
        "contraction_from": 1.0 - ideal_shortest / 0.3,
        "contraction_to": 0.4,
    }
    there = curves(shared_client, {"preset": "DMSP-20"}, **at)
    assert there["stiffness_from_force"][0][0] is None
    ideal = curves(shared_client, {"preset": "DMSP-20"}, effects={}, **at)
    assert ideal["stiffness_from_force"][0][0] == pytest.approx(ideal["stiffness"][0][0], rel=1e-12)


def test_friction_separates_filling_from_venting(shared_client: TestClient) -> None:
    effects = {"coulomb_friction": {}}
    over = curves(shared_client, {"preset": "DMSP-20"}, effects=effects, load=300, fixed_length=0.28)[
        "over_pressure"
    ]
    assert over["filling"]["contraction"][-1] < over["venting"]["contraction"][-1]
    assert over["force_at_fixed_length"]["filling"][-1] < over["force_at_fixed_length"]["venting"][-1]


def codes(answer: dict) -> set[str]:
    """The codes of an answer's flags."""
    return {flag["code"] for flag in answer["flags"]}


def test_flags_name_the_limits_that_are_crossed(shared_client: TestClient) -> None:
    muscle = {"preset": "DMSP-20"}
    assert "unverified" in codes(curves(shared_client, muscle))
    assert "over_pressure" in codes(curves(shared_client, muscle, pressures=["7 bar"]))
    assert "over_force_limit" in codes(curves(shared_client, muscle, load="1600 N"))
    assert "over_contraction_limit" in codes(curves(shared_client, muscle, load="1 N"))
    assert "over_pretension_limit" in codes(curves(shared_client, muscle, load="1500 N", pressures=["1 bar"]))
    assert "length_outside_range" in codes(curves(shared_client, {**muscle, "nominal_length": "10 mm"}))
    assert codes(curves(shared_client, PAPER)) == set()


def test_a_load_no_length_carries_is_null_and_flagged(shared_client: TestClient) -> None:
    answer = curves(shared_client, PAPER, pressures=["0 bar", "1 bar"], load="90 N")
    assert "out_of_reach" in codes(answer)
    point = answer["operating_points"][0]
    assert point["flags"] == ["out_of_reach"]
    assert [point[name] for name in ("contraction", "length", "force", "stiffness", "diameter")] == [None] * 5
    assert answer["over_pressure"]["filling"]["length"][0] is None


@pytest.mark.parametrize("pressure", [0, 1e-9, 1e8])
def test_extreme_pressures_give_numbers_or_null(shared_client: TestClient, pressure: float) -> None:
    answer = curves(shared_client, {"preset": "DMSP-20"}, pressures=[pressure], load=1e9, fixed_length=0.3)
    assert "NaN" not in json.dumps(answer)


def test_every_effect_gives_curves(shared_client: TestClient) -> None:
    muscle = {"preset": "DMSP-20"}
    for effect in shared_client.get("/api/effects").json()["effects"]:
        answer = curves(
            shared_client, muscle, effects={effect["id"]: {}}, load="300 N", fixed_length="280 mm"
        )
        parameters = {p["name"]: p["default"] for p in effect["parameters"]}
        assert answer["model"]["effects"] == {effect["id"]: pytest.approx(parameters)}


def test_many_requests_at_once_give_what_they_give_one_by_one(shared_client: TestClient) -> None:
    requests = [
        {
            "muscle": {
                "preset": "DMSP-20" if number % 2 else "DMSP-10",
                "nominal_length": f"{250 + number} mm",
            },
            "effects": None if number % 3 else {},
            "load": "100 N",
        }
        for number in range(50)
    ]
    one_by_one = [post(shared_client, "/api/curves", request).content for request in requests]
    with ThreadPoolExecutor(16) as pool:
        at_once = list(
            pool.map(lambda request: post(shared_client, "/api/curves", request).content, requests)
        )
    assert at_once == one_by_one


def test_a_free_muscle_still_has_its_stiffness(shared_client: TestClient) -> None:
    """At a load of zero the tension is zero up to rounding: that is balance, not slack."""
    request = {"muscle": {"preset": "MAS-10", "nominal_length": "274 mm"}, "load": 0.0, "points": 2}
    points = shared_client.post("/api/curves", json=request).json()["operating_points"]
    assert all(point["stiffness"] > 1000.0 for point in points if point["contraction"] > 0.0)


def test_curves_without_a_direction_leave_out_what_acts_in_motion_alone(shared_client: TestClient) -> None:
    """The mean of the two branches, which do hold the friction, and the answer lists every effect."""
    question = {"muscle": {"preset": "DMSP-20"}, "points": 9, "contraction_to": "20 %", "unclipped": True}
    mean, filling, venting = (
        shared_client.post("/api/curves", json={**question, "direction": way}).json() for way in (0, -1, 1)
    )
    assert {"dahl", "viscous_damping"} <= set(mean["model"]["effects"])
    assert mean["model"] == filling["model"]
    branches = np.array([filling["force"], venting["force"]])
    assert np.all(branches[1] > branches[0])
    np.testing.assert_allclose(mean["force"], branches.mean(axis=0), rtol=1e-9, atol=1e-9)


def test_there_is_no_work_where_the_muscle_does_not_contract(shared_client: TestClient) -> None:
    """Without pressure a muscle with a bladder cannot shorten by itself: the work is missing, not 0."""
    answer = curves(shared_client, {"preset": "DMSP-20"}, pressures=["0 bar", "3 bar"])
    still, lifting = answer["characteristics"]
    assert still["free_contraction"] <= 0.0
    assert still["max_work"] is None
    assert lifting["max_work"] > 0.0


def test_a_limit_that_the_free_contraction_crosses_is_a_sentence(shared_client: TestClient) -> None:
    answer = curves(shared_client, {"preset": "DMSP-20"}, pressures=["2 bar", "6 bar"])
    inside, outside = answer["characteristics"]
    assert inside["free_contraction_note"] is None
    assert outside["free_contraction_note"].endswith("% is above 25 %, the limit of the maker of the muscle")


def test_the_highest_pressure_that_holds_within_the_limits(shared_client: TestClient) -> None:
    """Of pressures in any order."""
    muscle, pressures = {"preset": "DMSP-20"}, ["6 bar", "2 bar", "8 bar", "4 bar"]
    answer = curves(shared_client, muscle, pressures=pressures, load="300 N")
    assert answer["holds"]["pressure"] == 6e5
    assert answer["holds"] in answer["operating_points"]
    # Too far even at the lowest of them: then the highest that holds it at all.
    light = curves(shared_client, muscle, pressures=["8 bar", "7 bar"], load="1 N")
    assert light["holds"]["flags"]
    assert light["holds"]["pressure"] == 8e5
    assert curves(shared_client, PAPER, pressures=["0 bar"], load="90 N")["holds"] is None


def test_the_used_share_of_each_limit(shared_client: TestClient) -> None:
    answer = curves(shared_client, {"preset": "DMSP-20"}, pressures=["3 bar", "1 bar"], load="300 N")
    used = {each["name"]: each for each in answer["limits_used"]}
    assert used["max_pressure"]["share"] == pytest.approx(3.0 / 6.0)
    assert used["max_force"]["share"] == pytest.approx(300.0 / 1500.0)
    most = max(point["contraction"] for point in answer["operating_points"])
    assert used["max_contraction"]["used"] == pytest.approx(most)
    assert used["max_contraction"]["share"] == pytest.approx(most / 0.25)
    assert curves(shared_client, PAPER, load="10 N")["limits_used"] == []


@pytest.mark.parametrize(
    ("direction", "words"), [(-1, "while shortening"), (0, "without friction"), (1, "while lengthening")]
)
def test_an_answer_names_its_branch(shared_client: TestClient, direction: int, words: str) -> None:
    answer = curves(shared_client, {"preset": "DMSP-20"}, direction=direction)
    assert answer["branch"].startswith(words)


def test_a_load_at_one_pressure_agrees_with_the_inverse_questions(shared_client: TestClient) -> None:
    """Lift, rest and pressure of one answer are those that the inverse questions give one by one."""
    muscle, load = {"preset": "DMSP-20", "nominal_length": "300 mm"}, "196.133 N"
    lift = curves(
        shared_client, muscle, load=load, at_pressure="6 bar", at_contraction="15 %", pressures=["1 bar"]
    )["lift"]

    def asked(**question: object) -> dict:
        return post(shared_client, "/api/inverse", {"muscle": muscle, **question}).json()

    rest = asked(question="contraction", force=load, pressure="6 bar", direction=-1)
    hanging = asked(question="contraction", force=load, pressure=0.0, direction=1)
    assert lift["contraction"] == pytest.approx(rest["value"], rel=1e-9)
    assert lift["hanging_length"] == pytest.approx(0.3 * (1 - hanging["value"]), rel=1e-9)
    assert lift["lift"] == pytest.approx(lift["hanging_length"] - lift["length"], rel=1e-12)
    for way, direction in (("filling", -1), ("venting", 1)):
        found = asked(question="pressure", force=load, contraction="15 %", direction=direction)
        assert lift[f"pressure_{way}"] == pytest.approx(found["value"], rel=1e-12)
    assert lift["contraction_vented"] > lift["contraction"]  # dry friction holds what was contracted
    assert 0 < lift["stiffness"] < lift["stiffness_closed"]


def test_a_load_that_is_not_held_says_why(shared_client: TestClient) -> None:
    answer = curves(
        shared_client,
        {"preset": "DMSP-20"},
        effects={},
        load="5 kN",
        at_pressure="1 bar",
        pressures=["1 bar"],
    )
    assert answer["lift"]["lift"] is None
    assert any("braid lock" in flag["message"] for flag in answer["lift"]["flags"])
