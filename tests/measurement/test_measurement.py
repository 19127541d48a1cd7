"""Kind, groups, slack and lengths of a measurement, from columns whose answer is known beforehand."""

import numpy as np
import pytest

from mckibben.measurement.kind import explain_kind
from mckibben.measurement.measurement import (
    KINDS,
    Measurement,
    build,
    group_rows,
    lengths,
)
from mckibben.physics.errors import InputError

RAMP = np.linspace(0.0, 1.0, 50)
LOOP = np.concatenate([RAMP, RAMP[::-1]])
#: A weight under three pressures, which creeps.
UNDER_STEPS = {
    "pressure": np.repeat([1e5, 2e5, 3e5], 20),
    "displacement": np.repeat([0.02, 0.04, 0.06], 20) + 1e-5 * np.arange(60),
}
RAMP_100 = np.clip(np.arange(100) / 60.0, 0.0, 1.0)
RNG = np.random.default_rng(7)


def make(columns, **more) -> Measurement:
    return build({k: np.asarray(v, float) for k, v in columns.items()}, name="a.csv", id="0" * 64, **more)


def grid(pressures, strokes):
    p, x = np.meshgrid(pressures, strokes, indexing="ij")
    return {"pressure": p.ravel(), "length": x.ravel(), "force": np.arange(1.0, p.size + 1)}


def sweeps(levels, *, noise=0.0):
    """Held levels, at each a loop of the other quantity from 0 to 1."""
    held = np.repeat(np.asarray(levels, float), len(LOOP))
    return held * (1 + noise * RNG.standard_normal(held.size)), np.tile(LOOP, len(levels))


HELD, SWEPT = sweeps([1e5, 2e5, 4e5], noise=0.001)
TIME = np.arange(len(HELD)) * 0.01
FORCE = 100.0 + 500.0 * RNG.random(len(HELD))
HELD_LENGTH = np.repeat([0.3, 0.28, 0.25], len(LOOP))

KIND_CASES = {
    "map": (grid(np.linspace(1e5, 6e5, 17), [0.25, 0.23, 0.21, 0.2, 0.19]), {}, "static"),
    "fine grid": (grid([1e5, 3e5, 5e5], np.linspace(0.2, 0.3, 40)), {}, "isobaric"),
    "one pressure": (
        {"pressure": np.full(50, 3e5), "length": 0.3 - 0.05 * RAMP, "force": 1 + RAMP},
        {},
        "isobaric",
    ),
    "one length": ({"pressure": 6e5 * RAMP, "length": np.full(50, 0.3), "force": 1 + RAMP}, {}, "isometric"),
    "isobaric in time": (
        {"time": TIME, "pressure": HELD, "length": 0.3 - 0.05 * SWEPT, "force": FORCE},
        {},
        "isobaric",
    ),
    "isometric in time": (
        {"time": TIME, "pressure": 6e5 * SWEPT, "length": HELD_LENGTH, "force": FORCE},
        {},
        "isometric",
    ),
    "held force": (
        {"pressure": 6e5 * RAMP, "contraction": 0.2 * RAMP, "force": np.full(50, 60.0)},
        {},
        "isotonic",
    ),
    "weights one after the other": (
        {
            "time": TIME,
            "pressure": 6e5 * SWEPT,
            "length": 0.3 - 0.05 * SWEPT + 0.0001 * HELD_LENGTH,
            "force": np.repeat([10.0, 30.0, 50.0], len(LOOP)),
        },
        {},
        "isotonic",
    ),
    "steps of force at held pressures": (
        {
            "time": TIME,
            "pressure": HELD,
            "length": 0.3 - 0.05 * SWEPT,
            "force": np.repeat([10.0, 30.0, 50.0], len(LOOP)),
        },
        {},
        "isobaric",
    ),
    "no force": ({"pressure": 6e5 * RAMP, "displacement": 0.04 * RAMP}, {"load_force": 60.0}, "isotonic"),
    "no force, in time": (
        {"time": RAMP, "pressure": 6e5 * RAMP, "displacement": 0.04 * RAMP},
        {},
        "transient",
    ),
    "log of a weight, one row in ten seconds": (
        {"time": 10.0 * np.arange(60), **UNDER_STEPS},
        {"load_mass": 6.0},
        "isotonic",
    ),
    "weight on steps of the pressure": (
        {"time": 0.05 * np.arange(60), **UNDER_STEPS},
        {"load_mass": 6.0},
        "transient",
    ),
    "command": ({"time": RAMP, "command": RAMP, "displacement": 0.04 * RAMP}, {}, "transient"),
    "command at clamped lengths": (
        {
            "time": TIME,
            "command": np.sign(np.sin(TIME)),
            "pressure": 3e5 + 2e5 * np.sin(TIME),
            "length": np.repeat([0.30, 0.28, 0.26], 100),
            "force": 500.0 + 300.0 * np.sin(TIME),
        },
        {},
        "isometric",
    ),
    "command while a load moves": (
        {
            "time": TIME,
            "command": np.sign(np.sin(TIME)),
            "pressure": 3e5 + 2e5 * np.sin(TIME),
            "length": 0.28 - 0.02 * np.sin(TIME),
            "force": 500.0 + 300.0 * np.sin(TIME),
        },
        {},
        "transient",
    ),
    "weights lifted fast": (
        {
            "time": np.tile(0.01 * np.arange(100), 3),
            "force": np.repeat([50.0, 100.0, 150.0], 100),
            "pressure": np.tile(4e5 * RAMP_100, 3),
            "displacement": np.tile(0.05 * RAMP_100, 3),
        },
        {},
        "transient",
    ),
    "the same weights lifted in a minute and a half": (
        {
            "time": np.tile(np.arange(100.0), 3),
            "force": np.repeat([50.0, 100.0, 150.0], 100),
            "pressure": np.tile(4e5 * RAMP_100, 3),
            "displacement": np.tile(0.05 * RAMP_100, 3),
        },
        {},
        "isotonic",
    ),
    "command and force": (
        {"time": RAMP, "command": RAMP, "pressure": RAMP, "length": 1 + RAMP, "force": RAMP},
        {},
        "transient",
    ),
    "mass in time": (
        {"time": RAMP, "pressure": RAMP * 1e5, "length": 1 + RAMP, "force": RAMP},
        {"load_mass": 5.0},
        "transient",
    ),
    "pressure in time": ({"time": RAMP, "pressure": 6e5 * RAMP}, {}, "transient"),
    "diameter": ({"pressure": 6e5 * RAMP, "diameter": 0.02 + 0.01 * RAMP}, {}, "diameter"),
    "diameter over length": ({"length": 0.3 - 0.1 * RAMP, "diameter": 0.02 + 0.01 * RAMP}, {}, "diameter"),
    "both vary in time": (
        {"time": TIME, "pressure": 6e5 * RNG.random(300), "length": 1 + RNG.random(300), "force": FORCE},
        {},
        "static",
    ),
}


@pytest.mark.parametrize("case", KIND_CASES)
def test_kind_is_detected(case):
    columns, conditions, expected = KIND_CASES[case]
    assert explain_kind(columns, conditions)[0] == expected
    result = make(columns, conditions=conditions)
    assert (result.kind, result.kind_detected) == (expected, True)
    assert f"kind detected: {expected}" in result.messages


@pytest.mark.parametrize(
    "columns", [{"pressure": RAMP}, {"force": RAMP, "time": RAMP}, {"temperature": RAMP}]
)
def test_no_kind(columns):
    with pytest.raises(InputError, match=r"^a.csv: no kind of measurement fits the columns") as caught:
        make(columns)
    assert "pressure" in caught.value.hint


def test_stated_kind_is_kept_and_checked():
    columns = {"time": TIME, "pressure": HELD, "length": 0.3 - 0.05 * SWEPT, "force": FORCE}
    for kind in KINDS:
        if kind != "diameter":
            result = make(columns, kind=kind)
            assert (result.kind, result.kind_detected) == (kind, False)
    with pytest.raises(InputError, match="kind 'diameter' needs a column diameter"):
        make(columns, kind="diameter")
    with pytest.raises(
        InputError, match="kind 'isobaric' needs a column length or contraction or displacement"
    ):
        make({"pressure": RAMP, "force": RAMP}, kind="isobaric")
    with pytest.raises(InputError, match="kind 'isobarik' is not known") as caught:
        make(columns, kind="isobarik")
    assert caught.value.hint == "Did you mean 'isobaric'?"


def test_groups_by_pressure_despite_noise():
    columns = {"time": TIME, "pressure": HELD, "length": 0.3 - 0.05 * SWEPT, "force": FORCE}
    labels, rule = group_rows(columns, "isobaric")
    np.testing.assert_array_equal(labels, np.repeat([0, 1, 2], 100))
    assert rule == "by pressure"


def test_groups_by_length():
    columns = {"time": TIME, "pressure": 6e5 * SWEPT, "length": HELD_LENGTH, "force": FORCE}
    labels, rule = group_rows(columns, "isometric")
    np.testing.assert_array_equal(labels, np.repeat([2, 1, 0], 100))  # labels ascend with length
    assert rule == "by stroke"


def test_groups_of_one_noisy_pressure_are_its_sweeps():
    pressure = 3e5 + 500.0 * RNG.standard_normal(200)
    columns = {"pressure": pressure, "length": 0.3 - 0.05 * np.tile(LOOP, 2), "force": np.ones(200)}
    labels, _ = group_rows(columns, "isobaric")
    np.testing.assert_array_equal(np.unique(labels), [0, 1, 2, 3])
    np.testing.assert_array_equal(np.bincount(labels), [50, 51, 49, 50])  # a doubled extreme ends its sweep


def test_groups_of_a_time_series_are_sweeps():
    noisy = 6e5 * np.tile(LOOP, 3) + 2e3 * RNG.standard_normal(300)
    labels, rule = group_rows({"time": TIME, "pressure": noisy}, "transient")
    assert labels.max() == 5
    assert rule == "by sweep (reversals)"
    assert group_rows({"time": RAMP, "pressure": RAMP}, "transient")[0].max() == 0
    assert group_rows({"time": RAMP[:1], "pressure": RAMP[:1]}, "transient")[0].tolist() == [0]


def test_groups_by_direction_and_by_column():
    direction = np.array([-1, -1, 1, 1, -1.0])
    columns = {"pressure": np.arange(5.0), "length": np.arange(1.0, 6.0), "direction": direction}
    assert group_rows(columns, "isotonic")[0].tolist() == [0, 0, 1, 1, 2]
    columns["group"] = np.array([4, 4, 4, 7, 7])
    labels, rule = group_rows(columns, "isotonic")
    assert labels.tolist() == [4, 4, 4, 7, 7]
    assert rule == "by the group column"
    assert make(columns).groups == 2


def test_many_reversals_stay_quick():
    signal = RNG.standard_normal(200_000)
    assert group_rows({"time": signal, "pressure": signal}, "transient")[0].max() > 50_000


def test_slack():
    columns = grid([1e5, 2e5], [0.2, 0.3, 0.4])
    assert not make(columns).slack.any()
    columns["force"][1] = 0.0
    assert not make(columns).slack.any(), "one exact zero may be a reading"
    columns["force"][4] = 0.0
    result = make(columns)
    assert np.flatnonzero(result.slack).tolist() == [1, 4]
    assert "2 of 6 rows hold no pulling force (slack)" in result.messages
    marked = make(columns, marked_slack=np.array([1, 0, 0, 0, 0, 0], bool))
    assert np.flatnonzero(marked.slack).tolist() == [0, 1, 4]
    isotonic = make({"pressure": RAMP, "length": 1 + RAMP, "force": 0 * RAMP}, kind="isotonic")
    assert not isotonic.slack.any(), "a load of 0 N is no slack"


def test_lengths():
    base = {"pressure": [1e5, 2e5]}
    np.testing.assert_array_equal(lengths(make({**base, "length": [0.3, 0.2]}), 9.0), [0.3, 0.2])
    np.testing.assert_allclose(lengths(make({**base, "contraction": [0.0, 0.25]}), 0.4), [0.4, 0.3])
    np.testing.assert_allclose(lengths(make({**base, "displacement": [-0.01, 0.1]}), 0.4), [0.41, 0.3])
    with pytest.raises(InputError, match=r"0\.05 m is shorter than the stroke"):
        lengths(make({**base, "displacement": [0.0, 0.1]}), 0.05)
    with pytest.raises(InputError, match="no length, contraction or displacement"):
        lengths(make({"time": RAMP, "pressure": RAMP}), 0.4)


def test_is_frozen():
    result = make(grid([1e5, 2e5], [0.2, 0.3]))
    with pytest.raises(AttributeError):
        result.kind = "static"
    with pytest.raises(ValueError, match="read-only"):
        result.columns["force"][0] = 1.0
    with pytest.raises(TypeError):
        result.columns["force"] = None


def test_channels_tell_origin_and_range():
    result = make(grid([1e5, 2e5], [0.2, 0.3]), origins={"length": ("len [mm]", "mm")})
    by_name = {channel.name: channel for channel in result.channels}
    assert by_name["length"] == ("length", "len [mm]", "m", 0.2, 0.3, "mm")
    assert by_name["pressure"] == ("pressure", "pressure", "Pa", 1e5, 2e5, "Pa")
    assert "group" not in by_name
    assert result.rows == 4
