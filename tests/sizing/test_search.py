"""The search as a whole: its drives are what it says of them, it can be watched and ended."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from mckibben.application.json_text import to_json
from mckibben.application.run.simulate import SimulationQuestion, simulate
from mckibben.application.size.size import (
    Searched,
    SizingResult,
    drive_document,
    prepare,
    prepare_search,
    sizing_question,
)
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.transient import parameters_of
from mckibben.simulation.integrate.engine import compiled_drive
from mckibben.simulation.integrate.many import lane_kernels
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.sizing import Design, Proposal, size
from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Group
from mckibben.sizing.proposal import propose
from mckibben.sizing.trial import trial_of
from tests.looks import Looks
from tests.server.answers import valid
from tests.sizing.conftest import LIFT, sized, understood

PAIR: dict[str, Any] = {
    **LIFT,
    "load": {"pair": {"angle": "60 deg", "torque": "2 N*m", "inertia": 0.02, "pulley_radius": "30 mm"}},
    "limits": {"max_length": "300 mm"},
}
del PAIR["stroke"]
TASKS: dict[str, dict[str, Any]] = {
    "lift": LIFT,
    "both ways": {**LIFT, "time_down": "0.4 s", "cycle_time": "0.8 s"},
    "slope with a spring": {
        **LIFT,
        "load": {"mass": "30 kg", "inclination": "30 deg", "spring": "500 N/m"},
        "catalogue": {**LIFT["catalogue"], "tube_length": 0.0},
    },
    "lever": {**LIFT, "load": {"mass": "10 kg", "lever_ratio": 0.5}, "stroke": "120 mm"},
    "counterweight": {**LIFT, "load": {"mass": "30 kg", "counterweight": "10 kg"}},
    "force over the stroke": {
        **LIFT,
        "load": {"mass": "5 kg", "force_over_stroke": {"strokes": [0.0, 0.06], "forces": [20.0, 90.0]}},
    },
    "without a mass": {**LIFT, "load": {"force": "150 N", "spring": "1000 N/m"}, "time_down": "0.5 s"},
    "warm": {**LIFT, "ambient_temperature": "50 degC"},
    "pair": PAIR,
}


def answer_of(task: dict[str, Any], studio: Studio) -> dict[str, Any]:
    return sized(task, studio)


@pytest.fixture(scope="module")
def searched(studio: Studio) -> Callable[[str], Searched]:
    """The search of a task of `TASKS`, made once for all that is to be true of it."""
    questions = {
        name: sizing_question(SizingTask.model_validate(task), studio) for name, task in TASKS.items()
    }
    return cache(lambda name: prepare_search(questions[name])(Watch()))


@pytest.fixture
def answer(searched: Callable[[str], Searched], name: str) -> dict[str, Any]:
    """Its answer, as JSON tells it."""
    return json.loads(to_json(searched(name).result))


@pytest.mark.parametrize("name", TASKS)
def test_every_proposal_is_a_drive_that_runs_as_it_says(studio: Studio, answer: dict[str, Any]) -> None:
    assert answer["proposals"]
    for proposal in answer["proposals"]:
        document = read_document(proposal["drive"], "the drive")
        run = simulate(SimulationQuestion(drive_of(document, studio)))
        assert run.outcome == "completed"
        up, down = run.timing.extend, run.timing.retract
        assert up.positioning_time == pytest.approx(proposal["time"], rel=2e-3)
        if proposal["time_down"] is not None:
            assert down.positioning_time == pytest.approx(proposal["time_down"], rel=5e-3)
        share = proposal["parallel"]
        impacts = [share * (phase.impact_energy or 0.0) for phase in (up, down)]
        for impact, figure in zip(impacts, ("impact_energy_stroke", "impact_energy_return"), strict=True):
            assert impact == pytest.approx(proposal[figure], rel=0.02, abs=1e-3)
        assert proposal["impact_energy"] == pytest.approx(max(impacts), rel=0.02, abs=1e-3)
        assert proposal["max_speed"] == pytest.approx(max(up.max_speed, down.max_speed), rel=5e-3)
        cycle = up.supplied_volume_anr + down.supplied_volume_anr
        assert share * cycle == pytest.approx(proposal["air_volume_anr"], rel=2e-3)


def test_the_impact_is_that_of_all_that_moves(studio: Studio) -> None:
    # A balanced carriage of 3 kg moves with the load of 20 kg: E = (m + M) v^2/2 at the speed of arrival.
    task, catalogue = understood(LIFT, studio)
    plain, carriage = catalogue.muscles[1], studio.catalogue["moving_mass"]
    muscle = replace(
        plain,
        effects=(*plain.effects, carriage),
        values={**plain.values, "moving_mass": {"mass": 3.0, "hung": 0.0}},
    )
    group = Group(task.duties()[0], muscle, 1, catalogue.valves[0], catalogue.tubes[0])
    bench = Bench(task, Watch())
    found = propose(trial_of(Design(group, 0.4, 5e5), bench), bench)
    assert isinstance(found, Proposal)
    assert found.impacts[0] == pytest.approx(0.5 * 23.0 * found.end_speed**2, rel=1e-6)
    assert found.impact_energy == max(found.impacts)
    assert found.max_speed >= found.end_speed


@pytest.mark.parametrize("name", TASKS)
def test_the_document_means_the_numbers_that_were_simulated(
    studio: Studio, searched: Callable[[str], Searched], name: str
) -> None:
    task = searched(name).question.task
    for proposal in searched(name).sizing.proposals:
        design = proposal.design
        own = design.group.drive(task, design.length, design.pressure)
        given = drive_of(drive_document(design, task), studio).drive
        assert given.structure.effects == own.structure.effects
        compiled = compiled_drive(own.structure)
        assert parameters_of(given, compiled) == pytest.approx(parameters_of(own, compiled), rel=1e-12)


@pytest.mark.parametrize("name", TASKS)
def test_proposals_keep_every_limit(answer: dict[str, Any]) -> None:
    valid(SizingResult, answer)
    for proposal in answer["proposals"]:
        assert min(proposal["margins"].values()) >= -1e-9
        assert proposal["margins"][proposal["binding"]] == min(proposal["margins"].values())
        assert proposal["time"] <= 0.5
        assert proposal["installed_length"] <= 0.6
        assert proposal["pressure"] <= 6e5
        assert proposal["force_reserve"] >= 0.1
        assert proposal["drive"]["supply"]["pressure"] == proposal["pressure"]
        assert proposal["unverified"]


@pytest.mark.parametrize("aim", ["air", "time", "length", "reserve"])
def test_it_ranks_by_what_is_asked_for(studio: Studio, aim: str) -> None:
    figures = {
        "air": "air_volume_anr",
        "time": "time",
        "length": "nominal_length",
        "reserve": "force_reserve",
    }
    proposals = answer_of({**LIFT, "rank_by": aim}, studio)["proposals"]
    for reserved in (False, True):  # drives with a thin margin come after the others
        found = [item[figures[aim]] for item in proposals if bool(item["reservations"]) is reserved]
        assert found == sorted(found, reverse=aim == "reserve")
    assert [bool(item["reservations"]) for item in proposals] == sorted(
        bool(item["reservations"]) for item in proposals
    )


def test_it_ranks_by_probability(studio: Studio) -> None:
    task = {**LIFT, "rank_by": "probability", "uncertainty": {"specimens": 40}}
    found = [item["probability"] for item in answer_of(task, studio)["proposals"]]
    assert found == sorted(found, reverse=True)
    assert found[0] >= 0.9


def test_nothing_beats_the_front(studio: Studio) -> None:
    answer = answer_of({**LIFT, "catalogue": {**LIFT["catalogue"], "tubes": None, "valves": None}}, studio)
    names = {"air_volume_anr": 1, "time": 1, "nominal_length": 1, "force_reserve": -1, "stiffness": -1}
    parts = ("muscle", "parallel", "valve", "tube")
    listed = {tuple(item[name] for name in parts): item["front"] for item in answer["proposals"]}
    designs = list(answer["proposals"])
    for item in answer["explored"]:
        of_parts = tuple(item[name] for name in parts)
        if of_parts in listed:  # the same drive, refined: plot and list agree
            assert item["front"] is listed[of_parts]
        else:
            designs.append(item)
    assert len(designs) > len(listed)
    assert any(item["front"] for item in designs)
    for item in designs:
        beaten = any(
            all(sign * other[name] <= sign * item[name] for name, sign in names.items())
            and any(sign * other[name] < sign * item[name] for name, sign in names.items())
            for other in designs
        )
        assert item["front"] is not beaten


def test_what_would_help_does_help(studio: Studio) -> None:
    task = {
        **LIFT,
        "load": {"mass": "80 kg"},
        "stroke": "50 mm",
        "limits": {"max_length": "400 mm", "max_parallel": 1},
        "catalogue": {**LIFT["catalogue"], "muscles": ["DMSP-20"]},
    }
    (no,) = answer_of(task, studio)["rejected"]
    assert no["binding"] == "length"
    (needed,) = re.findall(r"(\d+) mm long", no["would_work_if"])
    task = {**task, "limits": {"max_length": f"{int(needed) + 1} mm", "max_parallel": 1}}
    assert answer_of(task, studio)["proposals"]


def test_a_search_tells_its_progress(studio: Studio) -> None:
    seen: list[float] = []
    watch = Watch()
    task, catalogue = understood({**LIFT, "uncertainty": {"specimens": 20}}, studio)
    asked = watch.ended
    watch.ended = lambda share: (seen.append(share), asked(share))[1]  # type: ignore[method-assign]
    size(task, catalogue, watch)
    assert seen == sorted(seen)
    assert 0.0 <= seen[0] < 0.2
    assert 0.7 < seen[-1] <= 1.0


def test_a_search_ends_when_nobody_waits(studio: Studio) -> None:
    task, catalogue = understood(LIFT, studio)
    found = size(task, catalogue, Watch(cancelled=lambda: True))
    assert found.outcome is Outcome.CANCELLED
    assert found.proposals == []
    assert found.simulated == 0


#: More designs than are run at a time.
MANY: dict[str, Any] = {
    **LIFT,
    "catalogue": {"muscles": ["DMSP-10", "DMSP-20", "DMSP-40"], "tubes": ["PUN-H-6x1", "PUN-H-4x0.75"]},
    "uncertainty": {"specimens": 10},
    "max_proposals": 3,
}


@pytest.fixture(scope="module")
def searched_to_the_end(studio: Studio) -> SizingResult:
    """`MANY` with all the time that it takes."""
    return prepare(sizing_question(SizingTask.model_validate(MANY), studio))(Watch(time_limit=1e9))


@pytest.mark.parametrize(
    ("looks", "said"),
    [
        (1, ["before any drive was simulated"]),
        (3, ["choices of parts", "the others were not tried", "not searched to the end", "0 of 3 prob"]),
        (12, ["not searched to the end", "0 of 3 probabilities"]),
    ],
)
def test_a_search_whose_time_is_over_keeps_the_drives_found_so_far(
    studio: Studio, searched_to_the_end: SizingResult, looks: int, said: list[str]
) -> None:
    lane_kernels.warm().join()  # or looks at the compiler count
    question = sizing_question(SizingTask.model_validate(MANY), studio)
    watch = Looks(looks)
    result = prepare(question)(watch)
    assert result.outcome == "timed_out"
    assert watch.time_limit == 7.0  # a search takes the limit that it is given
    for words in [*said, "The limit of 7 s"]:
        assert words in (result.message or ""), result.message
    assert [p.probability for p in result.proposals] == [None] * len(result.proposals)
    if looks == 1:
        assert result.proposals == []
        return
    assert len(result.proposals) == 3
    for p in result.proposals:  # each is a drive that does the task, by a run of its own
        run = simulate(SimulationQuestion(drive_of(p.drive, studio)))
        assert run.timing.extend.positioning_time == pytest.approx(p.time, rel=2e-3)
        assert p.time is not None
        assert p.time <= 0.5
    # Nothing is rejected for what was not tried: no choice of parts that could do the task is named.
    works = {(p.muscle, p.parallel, p.valve, p.tube) for p in searched_to_the_end.explored}
    assert not works & {(r.muscle, r.parallel, r.valve, r.tube) for r in result.rejected}


def test_a_search_that_nobody_waits_for_runs_nothing_more(studio: Studio) -> None:
    task, catalogue = understood(LIFT, studio)
    asked: list[int] = []

    def gone() -> bool:
        asked.append(1)
        return len(asked) > 3

    found = size(task, catalogue, Watch(cancelled=gone))
    assert found.outcome is Outcome.CANCELLED
    assert found.proposals == []


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"load": {"mass": 0.0}}, "load"),
        ({"load": {"mass": 20.0, "inclination": "-10 deg"}}, "load"),
        ({"stroke": None}, "stroke"),
        ({"speed": "1 m/s"}, "speed"),
        ({"load": {"pair": {"angle": 1.0}}}, "stroke"),
        ({"load": {"pair": {"angle": 1.0}, "mass": 2.0}, "stroke": None}, "load.mass"),
        ({"load": {"mass": 1.0, "force_over_stroke": {"strokes": [0.0], "forces": [1.0, 2.0]}}},
         "load.force_over_stroke"),
        ({"catalogue": {"muscles": ["DMSP-21"]}}, "catalogue.muscles.0"),
        ({"catalogue": {"valves": ["VPPM-6"]}}, "catalogue.valves.0"),
        ({"catalogue": {"valves": []}}, "catalogue.valves"),
        ({"catalogue": {"tube_length": "1 mm"}}, "catalogue.tube_length"),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused_with_its_field(
    studio: Studio, change: dict[str, Any], field: str
) -> None:
    with pytest.raises(InputError) as caught:
        answer_of({**LIFT, **change}, studio)
    assert caught.value.field == field
