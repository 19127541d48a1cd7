"""The schedule of the next experiment: a table that a rig plays and this program reads back."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.application.diagnose.next_experiment import next_experiment, schedule_csv
from mckibben.identification.diagnose.design import DesignedExperiment, Separation
from mckibben.identification.diagnose.protocol import Schedule
from mckibben.measurement.reading import read_measurement

DESIGN = DesignedExperiment(
    group=("coulomb_friction", "viscous_damping"),
    words="loops at two speeds",
    minutes=2.5,
    schedule=Schedule(
        np.array([0, 0, 0, 1, 1, 1]),
        {
            "time": np.array([0.0, 2.0, 4.0, 0.0, 20.0, 40.0]),
            "pressure": np.full(6, 3e5),
            "length": np.array([0.3, 0.25, 0.3, 0.3, 0.25, 0.3]),
        },
    ),
    separations=(Separation("coulomb_friction", "viscous_damping", 7.0),),
)


def test_the_answer_holds_the_set_points_in_si() -> None:
    answer = next_experiment(DESIGN)
    assert answer.set_points["length"].unit == "m"
    assert list(answer.set_points["pressure"].values) == [3e5] * 6
    assert answer.separations[0].separation == 7.0
    assert list(answer.run) == [0, 0, 0, 1, 1, 1]


def test_the_table_can_be_read_back() -> None:
    text = schedule_csv(next_experiment(DESIGN))
    assert text.startswith(
        "# protocol: loops at two speeds\n# decides between: coulomb_friction, viscous_damping"
    )
    header, first = text.splitlines()[3:5]
    assert header == "run,time_s,pressure_bar,length_mm"
    assert first == "0,0,3,300"
    # A rig adds what it measures; the rest is read as it was written.
    lines = text.splitlines()
    played = "\n".join(
        [*lines[:3], f"{header},force_N", *(f"{line},{100 + i}" for i, line in enumerate(lines[4:]))]
    )
    back = read_measurement(played.encode(), "played.csv").columns
    assert back["pressure"] == pytest.approx(np.full(6, 3e5))
    assert back["length"] == pytest.approx(DESIGN.schedule.columns["length"])
    assert back["time"][:3] == pytest.approx([0.0, 2.0, 4.0])
