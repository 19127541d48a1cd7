"""What is said of dry friction: it holds and breaks away where a balance of forces by hand says so."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mckibben as mk

FRICTION = 50.0  # N
PULL = {"shape": "table", "times": [0, 1, 3, 5, 60], "values": [0, 0, 100, 0, 0]}


def lifted(**changes: Any) -> mk.Drive:
    """20 kg at 4 bar behind a closed valve, pulled down by 100 N between 1 s and 5 s."""
    drive = mk.Drive(
        muscle="DMSP-20:300mm", valve="MPYE-5-1/8-HF", start_pressure="4 bar", duration="60 s",
        effects={"bladder_elasticity": {}, "coulomb_friction": {"force": FRICTION}},
        load={"mass": "20 kg", "force": PULL},
        command={"shape": "step", "level": 0, "initial": 0},
    )  # fmt: skip
    return drive.changed(**changes) if changes else drive


def test_it_breaks_away_where_the_pull_exceeds_it_and_holds_from_then_on() -> None:
    found = lifted().run(points=6001)
    first = found.events[0]
    assert first.kind == "breaks_away_down"
    assert first.time == pytest.approx(1.0 + 2.0 * FRICTION / 100.0, abs=1e-3)  # 50 N/s
    late = found.position[found.time > 20.0]
    assert np.ptp(late) < 1e-9
    assert found.stuck[-1]
    assert found.position[-1] < found.position[0] - 1e-3  # the hysteresis stays


@pytest.mark.parametrize("force", [10.0, FRICTION])
def test_what_is_left_until_it_breaks_away_is_the_balance_of_forces(force: float) -> None:
    """The muscle without friction, at the pressure and length of the end, by its static model alone."""
    effects = {"bladder_elasticity": {}, "coulomb_friction": {"force": force}}
    found = lifted(effects=effects).run(points=601)
    muscle = mk.Model.preset("DMSP-20", length="300 mm").ideal().with_effect("bladder_elasticity")
    pull = float(muscle.force(pressure=float(found.pressure[-1]), contraction=float(found.contraction[-1])))
    excess = pull - 20.0 * 9.80665
    assert abs(excess) <= force + 1e-6
    assert f"{force - excess:.3g} N more upwards and {force + excess:.3g} N more downwards" in (
        found.rest or ""
    )


def test_the_start_is_an_interval_whose_ends_the_static_model_has_too() -> None:
    found = lifted().run(points=3).start
    muscle = mk.Model.preset("DMSP-20", length="300 mm").ideal().with_effect("bladder_elasticity")
    for end, way in ((found.lowest, 1.0), (found.highest, -1.0)):
        pull = float(muscle.force(pressure="4 bar", contraction=end / 0.3))
        assert pull - 20.0 * 9.80665 == pytest.approx(way * FRICTION, abs=1e-6)


def test_a_linear_model_that_is_held_has_no_way_and_one_that_slides_has() -> None:
    names = {model.name for model in lifted().linearise(amplitudes=()).models}
    assert any(name.startswith("held") for name in names)
    assert any(name.startswith("sliding") for name in names)
