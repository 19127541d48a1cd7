"""The probability against a closed form, and what must hold of it."""

from __future__ import annotations

from math import radians, sin, sqrt, tan

import numpy as np
import pytest
from scipy.stats import norm

from mckibben.documents.studio import Studio
from mckibben.simulation.outcome import Watch
from mckibben.sizing.batch import Bench
from mckibben.sizing.catalogue import Design, Group
from mckibben.sizing.proposal import chance
from mckibben.sizing.spread import spread_of
from tests.sizing.conftest import LIFT, understood

PRESSURE, LENGTH, STROKE, MASS = 5e5, 0.2, 0.02, 21.8
SPECIMENS = 1000


def bench_of(studio: Studio, uncertainty: dict[str, object], **changes: object) -> tuple[Bench, Design]:
    """A muscle of 10 mm at 25 degrees without losses lifts 20 mm; only that is uncertain which is named."""
    document = {
        **LIFT,
        "load": {"mass": MASS},
        "stroke": STROKE,
        "time": None,
        "limits": {},
        "catalogue": {"muscles": ["paper"], "valves": ["MPYE-5-3/8"], "tube_length": 0.0},
        "uncertainty": {"blocked_force": 0.0, "hysteresis": 0.0, "supply_pressure": 0.0, **uncertainty},
        **changes,
    }
    task, catalogue = understood(document, studio)
    group = Group(task.duties()[0], catalogue.muscles[0], 1, catalogue.valves[0], catalogue.tubes[0])
    return Bench(task, Watch()), Design(group, LENGTH, PRESSURE)


def factors() -> tuple[float, float]:
    """F = p (a (1 - k)^2 - b)."""
    area, angle = np.pi / 4.0 * 0.01**2, radians(25.0)
    return 3.0 * area / tan(angle) ** 2, area / sin(angle) ** 2


def test_specimens_follow_the_closed_form(studio: Studio) -> None:
    # The shift of the contraction is normal, sigma = (spread/2) F0/|F'(0)|; a specimen holds the load when
    # its contraction at the end of the stroke is below that at which the muscle carries just this load.
    bench, design = bench_of(studio, {"blocked_force": 0.1})
    a, b = factors()
    sigma = 0.05 * (a - b) / (2.0 * a)
    most = 1.0 - sqrt((MASS * 9.80665 / PRESSURE + b) / a)
    expected = norm.cdf((most - STROKE / LENGTH) / sigma)
    assert 0.6 < expected < 0.95
    found = chance(bench, design, (0.0, 1.0), SPECIMENS)
    # The slope at the blocked force is a difference over 0.1 % of contraction.
    assert found.probability == pytest.approx(expected, abs=3e-3)
    assert found.error == pytest.approx(sqrt(expected * (1.0 - expected) / SPECIMENS), rel=0.02)


def test_supply_alone_follows_the_closed_form(studio: Studio) -> None:
    bench, design = bench_of(studio, {"supply_pressure": 0.1})
    a, b = factors()
    needed = MASS * 9.80665 / (a * (1.0 - STROKE / LENGTH) ** 2 - b)
    expected = (1.1 - needed / PRESSURE) / 0.2
    assert 0.1 < expected < 0.95
    assert chance(bench, design, (0.0, 1.0), SPECIMENS).probability == pytest.approx(expected, abs=3e-3)


def test_hysteresis_alone_follows_the_closed_form(studio: Studio) -> None:
    # Half of a loop of width w against the motion: w/2 u |F'|, u even between 0 and 1.
    width = 0.04
    bench, design = bench_of(studio, {"hysteresis": width})
    a, b = factors()
    left = 1.0 - STROKE / LENGTH
    spare = PRESSURE * (a * left**2 - b) - MASS * 9.80665
    expected = spare / (0.5 * width * PRESSURE * 2.0 * a * left)
    assert 0.1 < expected < 0.95
    # The slope is a difference over 0.1 % of contraction.
    assert chance(bench, design, (0.0, 1.0), SPECIMENS).probability == pytest.approx(expected, abs=4e-3)


def test_without_deviations_it_is_sure(studio: Studio) -> None:
    bench, design = bench_of(studio, {})
    found = chance(bench, design, (0.0, 1.0), 40)
    assert found.probability == 1.0
    assert found.error > 0.0


def test_less_time_is_less_likely(studio: Studio) -> None:
    found = []
    for time in (2.0, 0.12, 0.1, 0.08):
        bench, design = bench_of(studio, {"blocked_force": 0.1}, time=time)
        found.append(chance(bench, design, (0.0, 1.0), 100).probability)
    assert found == sorted(found, reverse=True)
    assert found[0] > found[-1]


def test_specimens_are_the_same_at_every_call(studio: Studio) -> None:
    bench, design = bench_of(studio, {"blocked_force": 0.1, "hysteresis": 0.02, "supply_pressure": 0.05})
    first, second = (spread_of(design, bench.task, 200) for _ in range(2))
    for name in ("shift", "friction", "pressure"):
        assert np.array_equal(getattr(first, name), getattr(second, name))
    assert first.pressure.min() >= 0.95
    assert first.pressure.max() <= 1.05
    assert first.shift.mean() == pytest.approx(0.0, abs=1e-4)
