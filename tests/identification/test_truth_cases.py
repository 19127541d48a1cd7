"""The cases with hidden effects: complete, deterministic, visible, and readable as any measurement."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from math import pi, sin, tan
from pathlib import Path

import numpy as np
import pytest

from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.muscle import MuscleInput
from mckibben.documents.start_model import stated_muscle
from mckibben.measurement.measurement import lengths
from mckibben.measurement.reading import read_measurement
from mckibben.physics.catalogue import default_catalogue
from tests.shipped import shipped_studio
from tests.truth.cases import BOOK, Case
from tests.truth.generate import SEEDS, all_cases, answer_of, case, names, write

STUDIO = shipped_studio()
KINDS = {"isobaric", "isometric", "isotonic", "diameter", "static", "transient"}


@pytest.fixture(scope="module")
def cases(announce: Callable[[str], None]) -> list[Case]:
    """All of them, once or with as many seeds as ``MCKIBBEN_TRUTH_SEEDS`` says, as in a benchmark."""
    announce("making the measurements with hidden effects")
    return list(all_cases(SEEDS[: int(os.environ.get("MCKIBBEN_TRUTH_SEEDS", "1"))]))


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def test_the_set_is_complete(cases: list[Case]):
    first = [made for made in cases if made.seed == 0]
    assert len(cases) == len({made.seed for made in cases}) * len(names())
    assert {made.kind for made in first} == KINDS
    single = [made for made in first if len(made.hidden) == 1 and made.unknown is None]
    assert len(single) >= 40
    assert sum(len(made.hidden) == 2 for made in first) >= 12
    assert sum(len(made.hidden) == 3 for made in first) >= 4
    assert sum(made.status == "adequate" for made in first) >= 6
    assert sum(made.status == "unknown_effect" for made in first) >= 6
    found = {name for made in single for name in made.hidden[0]}
    # One that shows only among muscles of several lengths is never diagnosed from one.
    diagnosed = {name for name, effect in default_catalogue().items() if not effect.among_lengths}
    assert found == diagnosed, "every effect is an answer once, and every answer is an effect"


def test_hidden_effects_are_well_above_the_noise_and_not_absurd(cases: list[Case]):
    outside = {
        made.id: made.ratios for made in cases if made.ratios and not all(4 <= r <= 60 for r in made.ratios)
    }
    assert outside == {}


def test_residual_of_the_truth_is_the_declared_noise(cases: list[Case]):
    for made in cases:
        assert made.noise.keys() == made.clean.keys() == made.measured.keys()
        for channel, level in made.noise.items():
            assert rms(made.measured[channel] - made.clean[channel]) == pytest.approx(level, rel=1e-6)
            assert abs(np.mean(made.measured[channel] - made.clean[channel])) < level


def test_files_are_of_a_usual_size_and_say_the_kind_now_and_then(cases: list[Case]):
    said = 0
    for made in cases:
        assert 300 <= made.rows <= 4000, made.id
        said += any("# kind" in text for text in made.files.values())
    assert 0.2 < said / len(cases) < 0.8
    headers = {line for made in cases for line in next(iter(made.files.values())).splitlines()[:3]}
    for written in ("pressure_bar", "p [bar]", "Pressure (kPa)", "pressure_MPa", "pressure_abs_bar"):
        assert any(written in line for line in headers), written
    assert any("direction" in line for line in headers)
    assert any("run" in line for line in headers)


def of_each_kind_and_head(cases: list[Case]) -> list[Case]:
    """The first cases that bring a kind of experiment, or a name of a column, that none before them has."""
    seen: set[str] = set()
    chosen = []
    for made in cases:
        lines = next(iter(made.files.values())).splitlines()
        first = next(number for number, line in enumerate(lines) if line[:1].isdigit())
        new = {made.kind, *re.split("[;,\t]", lines[first - 1])} - seen
        if new:
            chosen.append(made)
        seen |= new
    return chosen


@pytest.mark.parametrize(
    "which",
    [
        of_each_kind_and_head,
        pytest.param(list, marks=pytest.mark.examination("test_files_read_as_what_was_measured")),
    ],
)
def test_files_read_as_what_was_measured(cases: list[Case], which: Callable[[list[Case]], list[Case]]):
    for made in which(cases):
        ((file, text),) = made.files.items()
        measurement = read_measurement(text.encode(), file)
        assert measurement.kind == made.kind, made.id
        muscle = STUDIO.start_model(stated_muscle(MuscleInput.model_validate(made.muscle)), {}).muscle
        assert measurement.rows == made.rows
        for channel, values in made.measured.items():
            read = lengths(measurement, muscle.nominal_length) if channel == "length" else None
            read = measurement.columns[channel] if read is None else read
            assert read == pytest.approx(values, rel=1e-6, abs=1e-7), f"{made.id} {channel}"


def test_users_documents_are_accepted(cases: list[Case]):
    catalogue = default_catalogue()
    for made in cases:
        assert made.effects.keys() <= catalogue.keys()
        if made.drive is not None:
            given = drive_of(DriveDocument.model_validate(made.drive), STUDIO)
            assert dict(given.start.effects).keys() == made.effects.keys(), made.id
            assert made.drive["muscle"] == made.muscle


def test_nothing_hidden_is_in_what_the_diagnosis_is_shown(cases: list[Case]):
    for made in cases:
        shown = json.dumps([made.muscle, made.drive, made.effects])
        text = next(iter(made.files.values()))
        for truth in made.truths:
            assert truth not in shown + text
        assert made.name not in text


def test_an_ideal_muscle_has_the_ideal_force_but_for_the_noise(cases: list[Case]):
    for made in cases:
        if made.name != "nothing-isobaric":
            continue
        ((file, text),) = made.files.items()
        measurement = read_measurement(text.encode(), file)
        muscle = STUDIO.start_model(stated_muscle(MuscleInput.model_validate(made.muscle)), {}).muscle
        lam = lengths(measurement, muscle.nominal_length) / muscle.nominal_length
        t = muscle.braid_angle
        ideal = measurement.columns["pressure"] * pi * muscle.braid_diameter**2 / 4
        ideal = ideal * (3 * lam**2 / tan(t) ** 2 - 1 / sin(t) ** 2)
        assert rms(measurement.columns["force"] - ideal) == pytest.approx(made.noise["force"], rel=0.01)


@pytest.mark.parametrize("name", ["iwan-nested-isobaric", "pair-flow-load-steps", "bladder-exponential-map"])
def test_the_same_name_and_seed_make_the_same_case(name: str):
    again, other = BOOK.make(name, 1), BOOK.make(name, 2)
    assert answer_of(again) == answer_of(BOOK.make(name, 1))
    assert next(iter(again.files.values())) == next(iter(BOOK.make(name, 1).files.values()))
    assert next(iter(again.files.values())) != next(iter(other.files.values()))


def test_a_kept_case_is_the_made_one(tmp_path: Path):
    made = case("prestress-isometric", 1, cache=tmp_path)
    kept = case("prestress-isometric", 1, cache=tmp_path)
    assert made.files == kept.files == BOOK.make("prestress-isometric", 1).files


def test_cases_can_be_written_down(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("tests.truth.generate.names", lambda: ("prestress-isometric", "load-steps"))
    answers = write(tmp_path, seeds=(0,))
    assert [answer["name"] for answer in answers] == ["prestress-isometric", "load-steps"]
    assert json.loads((tmp_path / "answers.json").read_text()) == answers
    assert json.loads((tmp_path / "load-steps-0.given.json").read_text())["drive"]["load"]
    assert (tmp_path / "prestress-isometric-0.csv").read_text() == next(
        iter(case("prestress-isometric", 0).files.values())
    )
