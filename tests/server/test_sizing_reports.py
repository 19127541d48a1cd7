"""``POST /api/sizings/reports``: numbers of the size answer, of the run and of closed forms; nothing runs."""

from __future__ import annotations

import hashlib
import json
import math
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from fastapi.testclient import TestClient

from mckibben import cli
from mckibben.documents.task import SizingTask
from mckibben.facts.sizing import LIMITS
from mckibben.facts.timing import TIMING
from mckibben.physics.errors import InputError
from mckibben.report.sizing.gather import prepare_report
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
from tests.server.conftest import assert_error, post
from tests.server.test_reports import NASTY, Reader, attached, exact, tables
from tests.server.test_sizings import IMPOSSIBLE, TASK
from tests.shipped import shipped_studio

PATH = "/api/sizings/reports"
GRAVITY = 9.80665
PAIR: dict[str, Any] = {
    "load": {"pair": {"angle": "60 deg", "torque": "2 N*m", "inertia": 0.02, "pulley_radius": "30 mm"}},
    "time": "0.5 s",
    "catalogue": {"muscles": ["DMSP-10", "DMSP-20"], "valves": ["MPYE-5-1/8-LF"], "tubes": ["PUN-H-6x1"]},
    "uncertainty": {"specimens": 0},
}
# One size 10 pulls 473 N at 6 bar at most, two carry 35 kg; the force falls, so the run takes another.
BESIDE: dict[str, Any] = {
    "title": "Side by side",
    "load": {"mass": "35 kg", "force_over_stroke": {"strokes": [0.0, "10 mm"], "forces": ["40 N", "0 N"]}},
    "stroke": "30 mm",
    "time": "0.5 s",
    "limits": {"max_length": "600 mm", "life": 1e5},
    "catalogue": {"muscles": ["DMSP-10"], "valves": ["MPYE-5-1/8-HF"], "tubes": ["PUN-H-6x1"]},
    "uncertainty": {"specimens": 0},
}
WHOLE = [
    "Result", "Margins", "Parts list", "Curves and operating points", "Motion", "Uncertainty",
    "Alternatives", "Rejected parts", "Task", "Assumptions", "Figures and their grades", "Equations",
    "How to reproduce",
]  # fmt: skip


def report(client: TestClient, body: dict[str, Any]) -> str:
    """The file, checked: well-formed, self-contained, without anything that runs or loads."""
    response = post(client, PATH, body)
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "text/html; charset=utf-8"
    assert "default-src 'self'" in response.headers["content-security-policy"]
    text = response.text
    page = Reader(text)
    assert not page.tags & {"script", "link", "img", "iframe", "object", "embed", "base", "form"}
    for name, value in page.attributes:
        assert not name.startswith("on"), name
        assert name not in ("src", "action", "style"), name
        # A link only saves a file that it holds itself.
        assert name != "href" or (value or "").startswith("data:application/json;base64,"), value
        assert name == "xmlns" or "://" not in (value or ""), (name, value)
    assert any((value or "").startswith("default-src 'none'") for _, value in page.attributes)
    style = text[text.index("<style>") : text.index("</style>")]
    assert "url(" not in style
    assert "@import" not in style
    return text


def root_of(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>\n"))


def headings(text: str) -> list[str]:
    """Titles of the sections without their numbers."""
    return ["".join(h.itertext()).partition(" ")[2] for h in root_of(text).iter("h2")]


def words(cell: ElementTree.Element) -> str:
    return "".join(cell.itertext())


def commands(text: str) -> str:
    """What is to be copied."""
    (lines,) = [words(element) for element in root_of(text).iter("pre")]
    return lines


@pytest.fixture(scope="module")
def lifted(shared_client: TestClient) -> tuple[str, dict[str, Any]]:
    """The report of a plain lift, and the size answer it tells."""
    return report(shared_client, {"task": TASK}), post(shared_client, "/api/sizings", TASK).json()


@pytest.fixture(scope="module")
def swung(shared_client: TestClient) -> tuple[str, dict[str, Any]]:
    """The same of an antagonist pair."""
    return report(shared_client, {"task": PAIR}), post(shared_client, "/api/sizings", PAIR).json()


def test_every_section_is_there(lifted: tuple[str, dict], swung: tuple[str, dict]) -> None:
    for text, _ in (lifted, swung):
        assert headings(text) == WHOLE
        assert text.count("<svg") >= 11  # curves, two runs of four quantities, margins, alternatives
        assert text.count("<math") > 10


def test_operating_points_follow_from_weight_and_measured_curve(lifted: tuple[str, dict]) -> None:
    text, answer = lifted
    best, rows = answer["proposals"][0], tables(text)
    assert best["muscle"] == "DMSP-20"
    assert best["parallel"] == 1
    begin, end = rows["Force demanded of the muscle"][0]
    assert exact(begin) == exact(end) == pytest.approx(20.0 * GRAVITY)
    contraction = exact(rows["Contraction"][0][1])
    assert contraction == pytest.approx(0.06 / best["nominal_length"])
    lengths = [exact(cell) for cell in rows["Length between the fittings"][0]]
    assert lengths[0] - lengths[1] == pytest.approx(0.06)
    # MuscleSIM, the maker's tool: 1515 N blocked at 6 bar.
    blocked, held = (exact(cell) for cell in rows["Force of the muscle at supply pressure"][0])
    assert blocked * 6e5 / best["pressure"] == pytest.approx(1515.0, rel=0.05)
    assert 1.0 + best["force_reserve"] == pytest.approx(held / (20.0 * GRAVITY), rel=2e-3)


def test_the_needed_pressure_holds_the_load_on_the_curves(
    lifted: tuple[str, dict], shared_client: TestClient
) -> None:
    text, answer = lifted
    best, rows = answer["proposals"][0], tables(text)
    needed = exact(rows["Pressure that just carries the load, at rest"][0][1])
    assert needed == pytest.approx(best["needed_pressure"])
    end = best["contraction"]
    body = {
        "muscle": {"preset": best["muscle"], "nominal_length": best["nominal_length"]},
        "pressures": [needed], "direction": -1, "points": 2,
        "contraction_from": 0.0, "contraction_to": end,
    }  # fmt: skip
    force = post(shared_client, "/api/curves", body).json()["force"][0][1]
    assert force == pytest.approx(20.0 * GRAVITY, rel=2e-3)


def test_timing_is_that_of_the_run_of_the_drive(
    lifted: tuple[str, dict], swung: tuple[str, dict], shared_client: TestClient
) -> None:
    for text, answer in (lifted, swung):
        rows, best = tables(text), answer["proposals"][0]
        run = post(shared_client, "/api/simulations", {"drive": best["drive"], "points": 2}).json()
        for name in ("positioning_time", "delay_time", "rise_time", "max_speed"):
            for cell, phase in zip(rows[TIMING[name].label][0], ("extend", "retract"), strict=True):
                assert exact(cell) == pytest.approx(run["timing"][phase][name], rel=2e-3), (name, phase)
        energy = exact(rows["Impact energy"][0][0])
        mass = run["geometry"] and best["drive"]["load"]["mass"]
        assert energy == pytest.approx(0.5 * mass * best["end_speed"] ** 2, rel=5e-3)


def test_margins_are_shares_of_the_limits(lifted: tuple[str, dict]) -> None:
    text, answer = lifted
    best, rows = answer["proposals"][0], tables(text)
    for name, share in (
        ("Installed length", 0.6 / best["nominal_length"] - 1.0),
        ("Time for the stroke", 0.5 / best["time"] - 1.0),
        ("Force beyond the reserve", (1.0 + best["force_reserve"]) / 1.1 - 1.0),
        ("Outer diameter", 0.06 / best["outer_diameter"] - 1.0),
        ("Supply pressure", 6e5 / best["pressure"] - 1.0),
    ):
        (cells,) = (cells for cells in rows[name] if words(cells[0]).startswith("at "))
        assert exact(cells[2]) == pytest.approx(share, rel=1e-6, abs=1e-9), name
    assert f"nearest limit is {LIMITS[best['binding']].words}" in text


def test_probability_alternatives_and_rejections_are_those_of_the_answer(lifted: tuple[str, dict]) -> None:
    text, answer = lifted
    best, rows = answer["proposals"][0], tables(text)
    assert f"{100 * best['probability']:.3g} % of 20 simulated specimens succeed" in text
    error = math.sqrt(max(best["probability"] * (1 - best["probability"]), 1 / 20) / 20)
    assert f"Standard error {100 * error:.2g} %" in text
    for rank, item in enumerate(answer["proposals"], 1):
        (cells,) = (cells for cells in rows[f"{rank}"] if len(cells) == 6)
        assert item["muscle"] in words(cells[0])
        assert item["valve"] in words(cells[0])
        assert [exact(cell) for cell in cells[1:4]] == pytest.approx(
            [item["pressure"], item["time"], item["air_volume_anr"]]
        )
    told = {item["muscle"] for item in answer["rejected"]}
    section = text[text.index("Rejected parts") : text.index("9 Task")]
    for muscle in told:
        assert muscle in section
    assert answer["rejected"][0]["why"] in section
    assert answer["rejected"][0]["would_work_if"] in section


def test_parts_and_their_figures_have_source_and_grade(lifted: tuple[str, dict]) -> None:
    text, answer = lifted
    rows, best = tables(text), answer["proposals"][0]
    listed = {words(cells[0]): (first, cells) for first, cells in _rows(text) if len(cells) == 4}
    for part in (f"Muscle {best['muscle']}", f"Valve {best['valve']}", f"Tube {best['tube']}"):
        number, cells = listed[part]
        assert number == "1"
        assert words(cells[3]).startswith("no: ")
    order = words(listed[f"Muscle {best['muscle']}"][1][1])
    length = best["nominal_length"] * 1e3
    assert order == f"Festo DMSP-20, rest length {length:.4g} mm; order code DMSP-20-{length:.0f}N-…"
    preset = json.loads((presets_folder() / "muscles" / "DMSP-20.json").read_text("utf-8"))
    angle = preset["geometry"]["braid_angle"]
    value, source, grade, verified = rows["braid angle"][0]
    assert angle["unit"] == "deg"
    assert words(value) == f"{angle['value']}°"
    assert angle["source"] in words(source)
    assert (words(grade), words(verified)) == (angle["grade"], "yes")
    assert words(rows["max pressure"][0][3]) == "no"
    assert words(rows["E"][0][0]) == "engineering estimate, not verified"


def _rows(text: str) -> list[tuple[str, list[ElementTree.Element]]]:
    """First cell and the others of every row."""
    return [(words(first), others) for first, *others in root_of(text).iter("tr")]


def test_what_was_given_and_what_was_assumed_is_told(lifted: tuple[str, dict]) -> None:
    text, _ = lifted
    rows = tables(text)
    assert exact(rows["Mass"][0][0]) == 20.0
    assert words(rows["Stroke"][0][0]) == "60\xa0mm"
    assert words(rows["Ambient temperature"][0][0]) == "20\xa0°C"
    assert words(rows["Supply tolerance"][0][0]) == "3\xa0%"
    task = text[text.index("9 Task") : text.index("10 Assumptions")]
    assumed = text[text.index("Values the task does not state") :]
    assert "Ambient temperature" not in task
    assert "Ambient temperature" in assumed
    assert "PUN-H-4x0.75" in words(rows["Tubes"][0][0])


def test_a_pair_has_two_muscles_valves_and_an_angle(swung: tuple[str, dict]) -> None:
    text, answer = swung
    best, rows = answer["proposals"][0], tables(text)
    for kind in ("Muscle", "Valve", "Tube"):
        (number,) = {first for first, cells in _rows(text) if words(cells[0]).startswith(f"{kind} ")}
        assert number == "2"
    resisting = [exact(cell) for cell in rows["… of which to stretch the empty second muscle"][0]]
    demand = [exact(cell) for cell in rows["Force demanded of one muscle"][0]]
    for force, second in zip(demand, resisting, strict=True):
        assert force - second == pytest.approx(2.0 / 0.03)
    contraction = exact(rows["Contraction"][0][1])
    assert contraction == pytest.approx(math.radians(60.0) * 0.03 / best["nominal_length"])
    assert "Angle [°]" in text
    assert "second muscle" in text
    assert "No specimens were simulated" in text


def test_parallel_muscles_share_the_load_and_the_run_takes_a_straight_line(shared_client: TestClient) -> None:
    answer = post(shared_client, "/api/sizings", BESIDE).json()
    best = answer["proposals"][0]
    assert best["parallel"] == 2
    text = report(shared_client, {"task": BESIDE})
    rows = tables(text)
    demand = [exact(cell) for cell in rows["Force demanded of one muscle"][0]]
    assert demand == pytest.approx([(35.0 * GRAVITY + 40.0) / 2, 35.0 * GRAVITY / 2])
    assert "load in the run" in text
    assert "the lowest straight line that is nowhere below it" in text
    assert exact(rows["Impact energy"][0][0]) == pytest.approx(0.5 * 35.0 * best["end_speed"] ** 2, rel=5e-3)
    used = max(best["contraction"] / 0.25, demand[0] / 630.0)
    (cells,) = (cells for cells in rows["Load cycles (an estimate)"] if len(cells) == 4)
    assert exact(cells[1]) == pytest.approx(10.0 ** (7.0 - 2.0 * used), rel=1e-6)


FEW = {"muscles": ["DMSP-10"], "valves": ["MPYE-5-1/8-HF"], "tubes": ["PUN-H-6x1"]}
NONE = {"specimens": 0}


@pytest.mark.parametrize(
    ("task", "told"),
    [
        ({"load": {"mass": "5 kg"}, "stroke": "20 mm"}, ["Lift 5 kg by 20 mm, with 6 bar", "Lift 5 kg"]),
        (
            {"load": {"spring": "500 N/m", "force": "5 N", "inclination": 0}, "stroke": "40 mm"},
            ["No mass is moved", "a spring of 0.5 N/mm and 5 N"],
        ),
        (
            {"load": {"mass": "9 kg", "counterweight": "4 kg", "lever_ratio": 0.5}, "stroke": "40 mm"},
            ["9 kg with 4 kg of counterweight"],
        ),
        ({"load": {"pair": {"angle": "40 deg"}}}, ["ample", "Each muscle of the pair", ">free<"]),
        (
            {"load": {"mass": "5 kg"}, "stroke": "20 mm", "catalogue": {**FEW, "tube_length": 0}},
            ["the valve is mounted on the muscle", "No tube"],
        ),
        (
            {"load": {"mass": "5 kg"}, "stroke": "20 mm", "ambient_temperature": "90 degC"},
            ["No drive in the catalogue fulfils this task", "another place for it"],
        ),
    ],
    ids=["untimed", "spring", "lever", "free pair", "no tube", "too hot"],
)
def test_any_task_has_a_report(shared_client: TestClient, task: dict[str, Any], told: list[str]) -> None:
    text = report(shared_client, {"task": {"catalogue": FEW, "uncertainty": NONE, **task}})
    for words_ in told:
        assert words_ in text
    for number in ("nan", "inf", "None"):
        assert f">{number}<" not in text


def test_hashes_are_those_of_the_files_and_the_commands_repeat_it(
    lifted: tuple[str, dict],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsysbinary: pytest.CaptureFixture[bytes],
) -> None:
    text, answer = lifted
    assert "mckibben size task.json" in commands(text).splitlines()
    rows = tables(text)
    inside = attached(text)
    assert json.loads(inside.pop("sizing.json"))["proposals"][0] == answer["proposals"][0]
    assert set(inside) == {"task.json", "drive.json"}
    for name, content in inside.items():
        read = json.loads(content)
        plain = json.dumps(read, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
        assert words(rows[f"SHA-256 of {name}"][0][0]) == hashlib.sha256(plain.encode()).hexdigest()
        (tmp_path / name).write_text(content, "utf-8")
    assert json.loads(inside["drive.json"]) == answer["proposals"][0]["drive"]
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MCKIBBEN_DATA", str(tmp_path))
    assert cli.run(["size", "task.json", "--json"]) == 0
    repeated = json.loads(capsysbinary.readouterr().out)
    for name in ("proposals", "rejected", "explored"):
        assert repeated[name] == answer[name]
    for program in ("mckibben", "Python", "numpy", "scipy"):
        assert program in rows


def test_nothing_found_is_a_report_too(shared_client: TestClient) -> None:
    for proposal in (1, 3):
        text = report(shared_client, {"task": IMPOSSIBLE, "proposal": proposal})
        assert headings(text) == [
            "Result",
            "Rejected parts",
            "Task",
            "Assumptions",
            "How to reproduce",
        ]
        assert "No drive in the catalogue fulfils this task" in text
        answer = post(shared_client, "/api/sizings", IMPOSSIBLE).json()
        for item in answer["rejected"]:
            assert item["why"] in text
    near = {**TASK, "load": {"mass": "20 kg"}, "supply_pressure": "1 bar"}
    rejected = post(shared_client, "/api/sizings", near).json()["rejected"]
    text = report(shared_client, {"task": near})
    assert f"It would work with {rejected[0]['would_work_if']}" in text


def test_titles_are_shown_and_never_run(shared_client: TestClient) -> None:
    text = report(shared_client, {"task": {**IMPOSSIBLE, "title": NASTY}})
    assert "<script" not in text
    assert "<img" not in text
    assert text.count("&lt;script&gt;") >= 2
    other = report(shared_client, {"task": {**IMPOSSIBLE, "title": NASTY}, "title": "  Mine  "})
    assert "<h1>Mine: Lift 5000 kg by 60 mm in 0.5 s, with 6 bar</h1>" in other
    assert "<h1>Lift 5000 kg by 60 mm in 0.5 s, with 6 bar</h1>" in report(
        shared_client, {"task": IMPOSSIBLE}
    )


def test_the_heading_of_an_example_that_was_changed_tells_the_change(shared_client: TestClient) -> None:
    """The load of the example of 20 kg; its preset describes it, the report of another load does not."""
    preset = shared_client.get("/api/presets/tasks/lift-20kg").json()
    changed = {**preset["document"], "load": {"mass": "5000 kg"}}
    root = root_of(report(shared_client, {"task": changed}))
    (heading,), title = [words(h) for h in root.iter("h1")], words(next(root.iter("title")))
    assert heading == "Lift 5000 kg by 60 mm in 0.5 s, with 6 bar"
    assert title.startswith(heading)
    assert post(shared_client, "/api/sizings", changed).json()["about"] == heading


@pytest.mark.parametrize(
    ("body", "field", "code"),
    [
        ({"task": {**TASK, "load": {"mass": "20 kgg"}}}, "task.load.mass", "bad_input"),
        ({"task": {**TASK, "stroek": 1}}, "task.stroek", "unknown_field"),
        ({"task": {**TASK, "speed": "1 m/s"}}, "task.speed", "bad_input"),
        ({"task": {**TASK, "load": {"mass": 0}}}, "task.load", "bad_input"),
        (
            {"task": {**TASK, "catalogue": {"muscles": ["DMPS-20"]}}},
            "task.catalogue.muscles.0",
            "unknown_preset",
        ),
        ({"task": TASK, "proposal": 0}, "proposal", "bad_input"),
        ({"task": TASK, "proposal": 31}, "proposal", "bad_input"),
        ({"task": TASK, "title": "x" * 201}, "title", "bad_input"),
        ({"task": TASK, "rank": 1}, "rank", "unknown_field"),
        ({}, "task", "missing"),
    ],
)
def test_what_cannot_be_meant_is_refused(
    shared_client: TestClient, body: dict[str, Any], field: str, code: str
) -> None:
    assert_error(post(shared_client, PATH, body), 422, code=code, field=field)


def test_a_proposal_beyond_the_list_says_how_many_there_are(
    lifted: tuple[str, dict], shared_client: TestClient
) -> None:
    count = len(lifted[1]["proposals"])
    error = assert_error(
        post(shared_client, PATH, {"task": TASK, "proposal": count + 1}), 422, field="proposal"
    )
    assert f"there are {count} proposals" in error["message"].lower()
    last = report(shared_client, {"task": TASK, "proposal": count})
    assert f"Proposal {count} of {count}" in last


def test_a_search_that_was_stopped_is_no_report() -> None:
    studio = shipped_studio()
    work = prepare_report(SizingTask.model_validate(TASK), studio)
    with pytest.raises(InputError, match="cancelled"):
        work(Watch(cancelled=lambda: True))
