"""The paper's figures: where each is in the product, our numbers beside the printed ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from mckibben.application.curves.curves import CurvesResult, curves, example_question
from mckibben.documents.muscle_files import start_of_input
from mckibben.documents.studio import Studio
from mckibben.presets.schema import DesignPreset
from mckibben.resources import presets_folder
from tests.benchmarks.scenarios import Scenario, loop_width, rows_of, run_scenario, shown

ANSWER = "POST /api/curves"
CURVE_ONLY = "a curve without numbers"


@dataclass(frozen=True)
class Row:
    """An equation or figure.

    Attributes:
        number: of the paper.
        where: in the product: modules, presets, fields of an answer.
        ours, printed: numbers or words.
    """

    number: str
    where: tuple[str, ...]
    ours: str
    printed: str


@cache
def studio() -> Studio:
    """The studio with the presets of the program."""
    return Studio(presets=presets_folder())


@cache
def scenario(name: str) -> Scenario:
    """A scenario of the paper, run once."""
    return run_scenario(studio(), name)


def mm(value: Any) -> str:
    """A length."""
    return f"{float(value) * 1e3:.2f} mm"


def cm3(value: float) -> str:
    """A volume."""
    return f"{value * 1e6:.3f} cm³"


def joule(value: float) -> str:
    """An energy."""
    return f"{abs(value):.3f} J"


def newton(value: float) -> str:
    """A force."""
    return f"{value + 0.0:.2f} N"


def per_mm(value: float) -> str:
    """A stiffness."""
    return f"{value * 1e-3:.3f} N/mm"


@cache
def design(name: str) -> CurvesResult:
    """The curves of a figure's example."""
    preset = studio().library.get("designs", name)
    assert isinstance(preset, DesignPreset)
    start = start_of_input(studio(), preset.document["muscle"], preset.document.get("effects"), name)
    question = example_question(preset, start)
    return curves(question, studio())


def figures() -> list[Row]:
    """A row for each of the 24 figures."""
    stiff, pull, wide, angle = (design(f"paper-fig-{n}") for n in (5, 6, 7, 9))

    def held(name: str) -> CurvesResult:
        return design(f"paper-fig-{name}")

    def last(name: str, pick: Callable[[Any], Any]) -> float:
        found = held(name).over_pressure
        assert found is not None
        return float(np.asarray(pick(found))[-1])

    forces = {name: last(name, lambda o: o.force_at_fixed_length.filling) for name in ("10a", "10b")}
    outer = {name: last(name, lambda o: o.filling.outer_diameter) for name in ("11a", "11b")}
    lengths = {name: last(name, lambda o: o.filling.length) for name in ("12a", "12b")}
    over = held("13").over_pressure
    assert over is not None
    assert over.outer_diameter_at_fixed_length is not None
    wider = over.outer_diameter_at_fixed_length[-1] - over.outer_diameter_at_fixed_length[0]
    follows = [scenario(f"paper-pid-{name}").result.tracking for name in ("triangle", "pulse", "random")]
    lags = [shown(found.lag, "s") for found in follows if found is not None]
    zero = float(np.interp(0.0, wide.force[-1][::-1], wide.length[::-1]))
    designs, drives = "presets/designs/paper-fig", "presets/drives"
    return [
        Row("1", ("backend/mckibben/physics/ideal.py",), "–", "a drawing"),
        Row("2", ("backend/mckibben/physics/effects/bladder_elasticity.py",), "–", "a drawing"),
        Row("3", ("backend/mckibben/physics/braid.py",), "–", "a drawing"),
        Row("4", ("mckibben.physics.braid.Rhombus",), "–", "a drawing"),
        Row("5", (f"{designs}-5.json",), _ends(stiff.stiffness, per_mm), CURVE_ONLY),
        Row("6", (f"{designs}-6.json",), _ends(pull.force, newton), CURVE_ONLY),
        Row(
            "7",
            (f"{designs}-7.json",),
            f"no force at {mm(zero)}, {newton(float(wide.force[-1][-1]))} at 10 mm and 6 bar",
            CURVE_ONLY,
        ),
        Row(
            "8",
            ("presets/measurements",),
            "the test bench: drop your own file in Compare & diagnose",
            "a picture",
        ),
        Row(
            "9",
            (f"{designs}-9.json",),
            ", ".join(f"{row[0]:.2f}" for row in angle.force) + " N",
            "64.39, 193.16, 386.32 N",
        ),
        Row("10a", (f"{designs}-10a.json",), f"{newton(forces['10a'])} at 6 bar", CURVE_ONLY),
        Row(
            "10b",
            (f"{designs}-10b.json",),
            f"{newton(forces['10b'])} at 6 bar, steeper than 10a",
            f"{CURVE_ONLY}; steeper than 10a",
        ),
        Row("11a", (f"{designs}-11a.json",), f"{mm(outer['11a'])} at 6 bar", CURVE_ONLY),
        Row("11b", (f"{designs}-11b.json",), f"{mm(outer['11b'])} at 6 bar", CURVE_ONLY),
        Row("12a", (f"{designs}-12a.json",), f"{mm(lengths['12a'])} of 274 mm at 6 bar", CURVE_ONLY),
        Row("12b", (f"{designs}-12b.json",), f"{mm(lengths['12b'])} of 750 mm at 6 bar", CURVE_ONLY),
        Row(
            "13",
            (f"{designs}-13.json", f"{ANSWER} over_pressure.outer_diameter_at_fixed_length"),
            f"{wider * 1e6:.0f} µm wider at 6 bar",
            "52 points, 92.3 % within a tolerance that is not stated",
        ),
        Row("14", ("backend/mckibben/physics/drive.py",), "–", "a drawing"),
        Row(
            "15",
            ("backend/mckibben/physics/drive.py",),
            "the equations of a drive, `mckibben export`",
            "a block diagram",
        ),
        Row(
            "16", ("backend/mckibben/physics/flow_path.py",), "supply, valve, tube, muscle", "a block diagram"
        ),
        Row("17", (f"{drives}/paper-ramp.json",), *_beside("paper-ramp")),
        Row("18", (f"{drives}/paper-step.json",), *_beside("paper-step")),
        Row(
            "19",
            (f"{drives}/paper-step-mpye.json",),
            "the valve with dead times of 5 and 7.5 ms",
            "a block diagram",
        ),
        Row("20", (f"{drives}/paper-step-mpye.json",), *_beside("paper-step-mpye")),
        Row(
            "21",
            (f"{drives}/paper-hysteresis.json",),
            f"{loop_width(scenario('paper-hysteresis')) / 1e5:.2f} bar wide at half the stroke",
            CURVE_ONLY,
        ),
        Row(
            "22",
            (
                f"{drives}/paper-pid-triangle.json",
                f"{drives}/paper-pid-pulse.json",
                f"{drives}/paper-pid-random.json",
            ),
            "lag " + ", ".join(lags),
            CURVE_ONLY,
        ),
        Row(
            "23",
            (f"{drives}/propneu-20.json", "presets/tasks/propneu-20.json"),
            "20 mm, 200 mm, 6 bar",
            "the same; the load only in the picture",
        ),
        Row(
            "24",
            (f"{drives}/propneu-20.json", f"{drives}/propneu-10.json"),
            *_beside(
                "propneu-20",
                "extend.positioning_time",
                "extend.max_speed",
                "retract.max_speed",
                how=" by a curve fit",
            ),
        ),
    ]


def _ends(rows: Any, text: Callable[[float], str]) -> str:
    """The ends of the last curve of figures 5 and 6."""
    return f"{text(float(rows[-1][0]))} at 50 mm and 6 bar, {text(float(rows[-1][-1]))} at 40 mm"


def _beside(name: str, *chosen: str, how: str = "") -> tuple[str, str]:
    """Our figures of a scenario, and the printed ones in the same order."""
    rows = [row for row in rows_of(scenario(name)) if not chosen or row.name in chosen]
    ours = ", ".join(shown(row.ours, row.unit) for row in rows)
    return ours + how, ", ".join(shown(row.paper, row.unit) for row in rows)
