"""Steps that prepare files, and files to check a model on: what is done, refused, and said of the noise."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import mckibben as mk
from tests.cli.conftest import Run, result_of, write
from tests.identification.synthetic import BRAID, text, truth

STEPS = ("range time 0.5 s to 60 s", "low pass 5 Hz")
NOISE = 2.0  # N
ROWS = 80  # of a sweep
HEADER = "time [s],pressure [bar],length [mm],force [N]"


def sweeps(*, seed: int = 5, rows: int = ROWS, **hidden: float) -> str:
    """Slow sweeps of a braid at three pressures, shortening and lengthening, with white noise."""
    random, lines, clock = np.random.default_rng(seed), [], 0.0
    friction = hidden.pop("friction", 0.0)
    for pressure, reach in ((2e5, 0.06), (4e5, 0.13), (6e5, 0.18)):
        for sense in (-1.0, 1.0):
            shares = np.linspace(0.0, 1.0, rows)[:: int(-sense)]
            for share in shares:
                length = 0.3 * (1.0 - reach * share)
                force = truth(pressure, length, friction=sense * friction, **hidden)
                force += random.normal(0.0, NOISE)
                lines.append(f"{clock:.3f},{pressure / 1e5:g},{1e3 * length:.5f},{force:.4f}")
                clock += 0.02
    return text(lines, HEADER)


MUSCLE = ("--muscle", "m.json")


@pytest.fixture
def files() -> tuple[str, str]:
    """A file of the ideal braid, and another one of it with other noise."""
    write("m.json", BRAID)
    return write("a.csv", sweeps()), write("b.csv", sweeps(seed=6))


def options(*steps: str) -> list[str]:
    return [part for step in steps for part in ("--prepare", step)]


def test_a_comparison_says_what_its_steps_did(run: Run, files: tuple[str, str]) -> None:
    code, out, err = run("compare", files[0], *MUSCLE, *options(*STEPS), "--json")
    assert code == 0, err
    answer = result_of(out)
    assert answer["rows"] == answer["rows_used"] + sum(answer["excluded"].values()) == 6 * ROWS
    done = answer["specimens"][0]["prepared"]
    assert [one["step"] for one in done] == list(STEPS)
    assert (done[0]["rows_before"], done[0]["rows_after"]) == (6 * ROWS, 6 * ROWS - 25)
    write("list.json", [{"file": "a.csv", "prepare": list(STEPS)}])
    code, out, err = run("compare", "list.json", *MUSCLE, "--json")
    assert code == 0, err
    assert result_of(out)["rmse"] == pytest.approx(answer["rmse"], rel=1e-12)
    model = mk.Model(**BRAID)
    for data in (mk.read(files[0], prepare=STEPS), mk.read(files[0]).prepared(*STEPS)):
        assert model.compare(data).rmse == pytest.approx(answer["rmse"], rel=1e-12)


def test_convert_writes_the_prepared_rows(run: Run, files: tuple[str, str]) -> None:
    code, out, err = run("convert", files[0], *options("range time 1 s to 2 s"))
    assert code == 0, err
    assert len([line for line in out.splitlines() if not line.startswith("#")]) == 1 + 51
    assert f"51 of {6 * ROWS} rows" in err


def test_a_step_that_cannot_be_done_is_one_line(run: Run, files: tuple[str, str]) -> None:
    for command in (("compare", *MUSCLE), ("diagnose", *MUSCLE), ("convert",)):
        for step, problem in (("lowpas 5 Hz", "is no step"), ("low pass 90 Hz", "not below half the rate")):
            code, out, err = run(command[0], files[0], *command[1:], *options(step))
            assert (code, out) == (2, "")
            assert len(err.strip().splitlines()) == 1
            assert err.startswith(f"mckibben: --prepare '{step}': ")
            assert problem in err
    write("list.json", [{"file": "a.csv", "prepare": ["lowpas 5 Hz"]}])
    code, out, err = run("compare", "list.json", *MUSCLE)
    assert (code, out) == (2, "")
    assert err.startswith("mckibben: list.json: prepare 'lowpas 5 Hz': ")
    with pytest.raises(mk.Problem, match="prepare 'lowpas 5 Hz': is no step"):
        mk.read(files[0], prepare="lowpas 5 Hz")


def test_of_a_filtered_file_without_anything_missing_nothing_is_missing(
    run: Run, files: tuple[str, str]
) -> None:
    """What a filter leaves of the noise is shared by neighbours: neither forgotten nor an effect."""
    code, out, err = run("diagnose", files[0], *MUSCLE, *options("low pass 2 Hz"), "--json")
    assert code == 0, err
    answer = result_of(out)
    assert answer["verdict"]["effects"] == []
    assert answer["verdict"]["status"] in ("adequate", "undecided")
    # White noise at 50 Hz, the response of the filter over all frequencies up to 25 Hz.
    ratio = np.tan(np.pi * np.linspace(0.0, 0.499, 5000)) / np.tan(np.pi * 2.0 / 50.0)
    passed = np.sqrt(np.mean((1.0 + (np.sqrt(2.0) - 1.0) * ratio**4) ** -2.0))
    assert answer["noise_floor"]["rmse"] == pytest.approx(passed * NOISE, rel=0.15)
    assert answer["path"][-1]["rmse"] < 1.2 * answer["noise_floor"]["rmse"]


def test_a_bad_row_has_its_number_of_the_file_after_a_range(run: Run) -> None:
    write("m.json", BRAID)
    random, bad = np.random.default_rng(7), 30  # row of the file, from 1, below the header
    rows = [
        f"{p / 1e5},{1e3 * length},{truth(p, length) + random.normal(0.0, NOISE)}"
        for p in (3e5, 4e5, 5e5, 6e5, 7e5)
        for length in np.linspace(0.255, 0.3, 12)
    ]
    pressure, length, force = rows[bad - 1].split(",")
    rows[bad - 1] = f"{pressure},{length},{float(force) + 40.0 * NOISE}"
    write("d.csv", text(rows, "pressure_bar,length_mm,force_N", "kind: static"))
    code, out, err = run("diagnose", "d.csv", *MUSCLE, *options("range rows 13 to 60"), "--json")
    assert code == 0, err
    suspects = result_of(out)["suspect_rows"]
    assert [(one["row"], one["file"]) for one in suspects] == [(bad, "d.csv")]
    assert f"row {bad}" in result_of(out)["verdict"]["sentence"]


def test_files_to_check_a_model_on(run: Run, files: tuple[str, str]) -> None:
    rubbing = write("e.csv", sweeps(seed=7, friction=15.0))
    code, out, err = run("compare", files[0], *MUSCLE, "--validate", rubbing, "--json")
    assert code == 0, err
    answer = result_of(out)
    assert answer["rmse"] == pytest.approx(NOISE, rel=0.1)
    assert answer["validation"]["rmse"] == pytest.approx((15.0**2 + NOISE**2) ** 0.5, rel=0.03)
    mine = mk.Model(**BRAID).compare(mk.read(files[0]), validate=rubbing)
    assert mine.validation is not None
    assert mine.validation.rmse == pytest.approx(answer["validation"]["rmse"], rel=1e-12)
    code, out, err = run("compare", files[0], *MUSCLE, "--validate", "nothing.csv")
    assert (code, out) == (2, "")
    assert err.startswith("mckibben: nothing.csv: there is no such file")


def test_a_missing_effect_is_found_behind_a_filter_and_its_model_checked(run: Run) -> None:
    write("m.json", BRAID)
    write("c.csv", sweeps(rows=60, prestress=40.0))
    other = write("f.csv", sweeps(rows=60, seed=8, prestress=40.0))
    steps = options("low pass 10 Hz")
    code, out, err = run(
        "diagnose", "c.csv", *MUSCLE, *steps, "--validate", other, "--json", "--save", "s.json"
    )  # fmt: skip
    assert code == 0, err
    answer = result_of(out)
    assert answer["baseline"]["rmse"] == pytest.approx(40.0, rel=0.1)
    assert answer["verdict"]["status"] in ("missing_effects", "ambiguous")
    assert "prestress" in answer["verdict"]["probabilities"]
    assert answer["validation"]["rmse"] < NOISE
    kept = json.loads(Path("s.json").read_text("utf-8"))["origin"]["files"]
    assert [one["prepared"] for one in kept] == [["low pass 10 Hz"]]
