"""Joint documents: what is wrong is named by its field; a pair on a pulley is one of them."""

from __future__ import annotations

from typing import Any

import pytest

import mckibben as mk

STOPS = {"min_angle": "-20 deg", "max_angle": "30 deg"}
WRONG: list[tuple[dict[str, Any], str, str]] = [
    ({"lever": "30 mm", "points": {"origin": [0, 0.3], "insertion": [0.03, 0]}}, "muscles.0.path.lever",
     "points and lever"),
    ({}, "muscles.0.path", "by no way"),
    ({"lever": "30 bar"}, "muscles.0.path.lever", "a length is needed"),
    ({"lever": "0.03*cosh(angle)"}, "muscles.0.path.lever", "there is no function 'cosh'"),
    ({"lever": "0.03*angel"}, "muscles.0.path.lever", "'angel' is not known in this formula"),
    ({"lever": "0.03*angle*c"}, "muscles.0.path.lever", "'c' is not known in this formula"),
    ({"lever": "0.03*sign(v)*angle"}, "muscles.0.path.lever", "no velocity v"),
    ({"lever": "1/angle"}, "muscles.0.path.lever", "no finite value|not smooth|the lever at"),
    ({"length": "300 mm"}, "muscles.0.path.length", "a constant length has no lever"),
    ({"lever": "30 mm", "tendon": "20 mm"}, "muscles.0.path.tendon", "only a path between two points"),
    ({"lever": "30 mm", "length": "300 mm", "contraction": 0.1}, "muscles.0.path.contraction",
     "give the length or"),
    ({"points": {"origin": [0, 0], "insertion": [0.03, 0]}}, "muscles.0.path.points.origin",
     "lies on the pivot"),
    ({"table": {"angle": [0, 1], "lever": ["3 mm"] * 3}}, "muscles.0.path.table.lever",
     "2 angles and 3 levers"),
    ({"table": {"angle": [0, 0.1], "lever": ["3 mm", "3 mm"]}}, "muscles.0.path.stops",
     "is stated from 0 to 5.73"),
    ({"lever": "30 mm", "way": 1}, "muscles.0.path.way", "is not a known field"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("path", "field", "message"), WRONG, ids=[f"{i} {w[2][:20]}" for i, w in enumerate(WRONG)]
)
def test_what_is_wrong_is_named(path: dict[str, Any], field: str, message: str) -> None:
    with pytest.raises(mk.Problem, match=message) as caught:
        mk.Joint([{"path": path}], muscle="DMSP-20:300mm", stops=STOPS)
    assert caught.value.field == field


def test_stops_and_muscles_have_to_be_said() -> None:
    with pytest.raises(mk.Problem, match=r"stops.min_angle is missing"):
        mk.Joint([{"path": {"lever": "30 mm"}}], muscle="DMSP-20")
    with pytest.raises(mk.Problem, match=r"muscles.1.muscle is missing"):
        mk.Joint(
            [{"muscle": "DMSP-20", "path": {"lever": "30 mm"}}, {"path": {"lever": "-30 mm"}}], stops=STOPS
        )
    with pytest.raises(mk.Problem, match="wrong order"):
        mk.Joint([{"path": {"lever": "1 mm"}}], muscle="DMSP-20", stops={"min_angle": 1.0, "max_angle": 0.5})
    with pytest.raises(mk.Problem, match="its load moves along a line"):
        mk.Joint.load("propneu-20")
    with pytest.raises(mk.Problem, match="2 pressures for 1 muscle"):
        mk.Joint([{"path": {"lever": "30 mm"}}], muscle="DMSP-20", stops=STOPS).statics(["1 bar, 2 bar"])


def test_a_pair_on_a_pulley_is_a_joint() -> None:
    """The drive states 300 mm, 30 mm, 10 % and stops at -2 and 22 %."""
    joint = mk.Joint.load("joint-20")
    assert joint.stops == (pytest.approx(-1.2), pytest.approx(1.2))
    assert float(joint.lever(0.5)) == pytest.approx(0.03)
    assert float(joint.lever(0.5, muscle=1)) == pytest.approx(-0.03)
    assert float(joint.length("0 deg", muscle=1)) == pytest.approx(0.27)
    model = mk.Model.preset("DMSP-20", length="300 mm")
    forces = [float(model.force(pressure=p, length=length)) for p, length in ((4e5, 0.264), (2e5, 0.276))]
    wanted = 0.03 * (forces[0] - forces[1])
    assert float(joint.torque(angle=0.2, pressures=["4 bar", 2e5])) == pytest.approx(wanted, rel=1e-12)
    document = {name: part for name, part in joint.document.items() if part is not None}
    assert mk.Joint(**{k: v for k, v in document.items() if k not in ("schema", "kind")}).document == document
