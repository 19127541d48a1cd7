"""The types of the fields of results, for pyright: it fails where one is not as stated here."""

from typing import assert_type

import numpy as np
from numpy.typing import NDArray

import mckibben as mk
from mckibben.application.curves.curves import CurveLimits
from mckibben.application.diagnose.result import CandidateResult, Verdict
from mckibben.application.linear.result import DesignResult, ModelResult
from mckibben.application.muscle_summary import Notice
from mckibben.application.run.simulate import SensorReadings
from mckibben.simulation.timing.table import TimingTable
from mckibben.studies.statistics import FigureSummary

Floats = NDArray[np.float64]


def of_a_model(model: mk.Model, data: mk.Measurement) -> None:
    curves = model.curves("1 bar")
    assert_type(curves.force, Floats)
    assert_type(curves.limits, CurveLimits)
    assert_type(curves.flags, list[Notice])
    if curves.interval is not None:
        low, high = curves.interval
        assert_type((low, high), tuple[Floats, Floats])
    compared = model.compare(data, fit=True)
    assert_type(compared.rmse, float)
    assert_type(compared.model, mk.Model)
    found = model.diagnose(data)
    assert_type(found.model, mk.Model)
    assert_type(found.verdict, Verdict)
    assert_type(found.candidates, list[CandidateResult])
    assert_type(found.noise_floor.rmse, float | None)


def of_a_drive(drive: mk.Drive) -> None:
    run = drive.run()
    assert_type(run.position, Floats)
    assert_type(run.contact, NDArray[np.bool_])
    assert_type(run.readings, SensorReadings | None)
    assert_type(run.timing, TimingTable)
    assert_type(run.timing.extend.rise_time, float | None)
    view = drive.linearise()
    assert_type(view.models, list[ModelResult])
    assert_type(view.design, DesignResult | None)
    assert_type(mk.study("study.json").summary, list[FigureSummary])
    best = mk.size("lift-20kg").proposals[0]
    assert_type(best.drive, mk.Drive)
    assert_type(best.stiffness, float)
