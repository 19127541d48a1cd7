"""Hysteresis operators: bounds, rate independence, branches after a reversal, loops within loops, play."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from mckibben.application.effect.runs import PRESSED, STRETCHED, Swing, driven, run
from mckibben.application.effect.states import MUSCLE
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.presliding import SLIDERS, shares_of_sliders

CATALOGUE = default_catalogue()
FRICTIONS = ("dahl", "bouc_wen", "maxwell_slip")


def along(
    effect_id: str, lengths: Sequence[float], values: dict[str, float] | None = None, *, rows: int = 400
) -> tuple[np.ndarray, np.ndarray]:
    """Length and force over straight ways from one length to the next, 1 s each, from rest."""
    effect = CATALOGUE[effect_id]
    time = np.linspace(0.0, len(lengths) - 1.0, rows * (len(lengths) - 1) + 1)
    corners = np.arange(len(lengths), dtype=float)
    speeds = np.diff(lengths)

    def at(t: float) -> dict[str, float]:
        return {"velocity": float(speeds[min(int(t), len(speeds) - 1)])}

    states = run(effect, at, time, values)
    place = {"pressure": 3e5, "length": MUSCLE.nominal_length, "muscle": MUSCLE, "velocity": speeds[-1]}
    force = effect.call("friction", place, {**effect.defaults, **(values or {}), **states})
    return np.interp(time, corners, lengths), force


@pytest.mark.parametrize("effect_id", FRICTIONS)
def test_force_stays_within_its_bound_and_reaches_it(effect_id: str) -> None:
    force, _ = driven(CATALOGUE[effect_id], STRETCHED, {"force": 10.0})
    assert np.abs(force).max() <= 10.0 + 1e-6
    assert np.abs(force).max() >= 10.0 * 0.98


def _warped(effect_id: str, *, warp: float) -> np.ndarray:
    # The same way in other times: tau = t + warp sin(t), whose rate stays positive below a warp of 1.
    effect = CATALOGUE[effect_id]
    time = np.linspace(0.0, 6.0 * np.pi, 1501)

    def path(t: float) -> dict[str, float]:
        tau, rate = t + warp * np.sin(t), 1.0 + warp * np.cos(t)
        return {
            "velocity": 0.006 * np.cos(1.5 * tau) * 1.5 * rate,
            "pressure_rate": 2e5 * np.cos(1.5 * tau) * 1.5 * rate,
        }

    at_rest = {"muscle": MUSCLE, "length": MUSCLE.nominal_length, "pressure": 3e5, "velocity": 0.0}
    force = effect.call("friction", at_rest, effect.defaults | run(effect, path, time))
    return np.interp(np.linspace(0.0, 6.0 * np.pi, 800), time + warp * np.sin(time), force)


@pytest.mark.parametrize("effect_id", [*FRICTIONS, "pressure_hysteresis"])
def test_force_depends_on_the_way_and_not_on_the_time(effect_id: str) -> None:
    plain, warped = (_warped(effect_id, warp=warp) for warp in (0.0, 0.8))
    # Rows are interpolated; a law with a rate in it differs by a quarter of the full force here.
    assert np.abs(plain - warped).max() <= 0.01 * np.abs(plain).max()


@pytest.mark.parametrize("effect_id", FRICTIONS)
def test_friction_that_follows_length_has_exactly_no_pressure_loop(effect_id: str) -> None:
    force, _ = driven(CATALOGUE[effect_id], PRESSED)
    assert np.array_equal(force, np.zeros_like(force))


def test_pressure_driven_loop_shows_at_constant_length() -> None:
    """Lower on filling, higher on venting, by the full width 2 F_p in the middle of the swing."""
    force, _ = driven(CATALOGUE["pressure_hysteresis"], PRESSED, {"force": 5.0, "break_pressure": 2e4})
    time = np.linspace(0.0, PRESSED.cycles * PRESSED.period, len(force))
    filling, venting = np.interp([8.0, 10.0], time, force)  # sin = 0, rising and falling
    assert filling == pytest.approx(-5.0, rel=1e-3)
    assert venting == pytest.approx(5.0, rel=1e-3)


def test_pressure_driven_loop_along_the_area_is_as_wide_in_pressure_at_every_length() -> None:
    """F_p A/A_0: with 1/A_0 of force per pressure, the same pressure at both lengths."""
    effect, braid = CATALOGUE["pressure_hysteresis"], MUSCLE.braid
    values = effect.defaults | {"force": 5.0, "along_area": 1.0, **{f"slip_{k}": 1.0 for k in range(1, 6)}}
    widths = []
    for length in (MUSCLE.nominal_length, 0.85 * MUSCLE.nominal_length):
        force = effect.call("friction", {"muscle": MUSCLE, "length": length, "pressure": 2e5}, values)
        gas = 3.0 * length**2 / braid.thread_length**2 - 1.0  # the ideal force over P b^2/(4 pi n^2)
        widths.append(force / gas)
    assert widths[1] == pytest.approx(widths[0], rel=1e-12)
    vented = {"muscle": MUSCLE, "length": 0.5 * MUSCLE.nominal_length, "pressure": 2e5}
    assert effect.call("friction", vented, values) == 0.0


def test_a_pressure_driven_loop_widens_with_a_power_of_the_pressure() -> None:
    """Full loops at 1.5 and 6 bar: 2^-q and 2^q of that at 3 bar; none of a vented muscle is infinite."""
    effect = CATALOGUE["pressure_hysteresis"]
    values = effect.defaults | {
        "force": 5.0,
        "pressure_power": 0.6,
        **{f"slip_{k}": 1.0 for k in range(1, 6)},
    }
    at = {"muscle": MUSCLE, "length": MUSCLE.nominal_length}
    low, middle, high, vented, below = (
        effect.call("friction", {**at, "pressure": pressure}, values)
        for pressure in (1.5e5, 3e5, 6e5, 0.0, -1e4)
    )
    assert middle == pytest.approx(-5.0, rel=1e-4)
    assert (low / middle, high / middle) == pytest.approx((2.0**-0.6, 2.0**0.6), rel=1e-4)
    assert vented == below
    assert -0.2 < vented < 0.0


@pytest.mark.parametrize("exponent", [0.8, 1.0, 1.7])
def test_sliders_in_parallel_turn_round_like_dahl(exponent: float) -> None:
    """From a full motion back: 1 - z with d(1 - z)/dx = -(1 - z)^i, as far as five sliders can follow."""
    shares = np.array(shares_of_sliders(exponent=exponent))
    assert np.sum(shares) == pytest.approx(1.0, abs=1e-12)
    assert np.all(shares >= 0.0)
    way = np.linspace(0.0, 5.0, 501)
    steps, left = np.empty_like(way), 2.0
    for place in range(len(way)):
        steps[place] = left
        left = max(left - (way[1] - way[0]) * left**exponent, 0.0)
    turned = -1.0 + 2.0 * shares @ np.minimum(way / (2.0 * np.array(SLIDERS)[:, None]), 1.0)
    assert np.max(np.abs(turned - (1.0 - steps))) < 0.08


def test_dahl_in_closed_form() -> None:
    """From rest F = F_c (1 - e^{-x/x_b}); back from F_1 along F_c (-1 + (1 + F_1/F_c) e^{-x/x_b})."""
    values = {"force": 20.0, "break_strain": 0.002}
    way = 0.002 * MUSCLE.nominal_length
    length, force = along("dahl", [0.0, 2.0 * way, 0.0], values)
    rising, falling = slice(0, 401), slice(400, 801)
    np.testing.assert_allclose(force[rising], 20.0 * (1.0 - np.exp(-length[rising] / way)), atol=1e-5)
    first = 1.0 - np.exp(-2.0)
    np.testing.assert_allclose(
        force[falling],
        20.0 * (-1.0 + (1.0 + first) * np.exp(-(2.0 * way - length[falling]) / way)),
        atol=1e-5,
    )


def test_dahl_with_exponent_2_in_closed_form() -> None:
    """From rest dz/dx = (1 - z)^2/x_b: F = F_c x/(x_b + x)."""
    way = 0.002 * MUSCLE.nominal_length
    length, force = along("dahl", [0.0, 4.0 * way], {"force": 20.0, "break_strain": 0.002, "exponent": 2.0})
    np.testing.assert_allclose(force, 20.0 * length / (way + length), atol=1e-3)


def test_bouc_wen_with_exponent_1_is_dahl() -> None:
    swing = Swing(stretch=0.003)
    dahl, _ = driven(CATALOGUE["dahl"], swing, {"break_strain": 0.002})
    same, _ = driven(
        CATALOGUE["bouc_wen"], swing, {"break_strain": 0.002, "exponent": 1.0, "unloading_share": 1.0}
    )
    np.testing.assert_allclose(same, dahl, atol=1e-4)


def test_bouc_wen_becomes_bilinear() -> None:
    """Straight to the bound, along it, and straight back down with the same slope."""
    way = 0.01 * MUSCLE.nominal_length
    values = {"force": 10.0, "break_strain": 0.01, "exponent": 60.0, "unloading_share": 0.5}
    length, force = along("bouc_wen", [0.0, 2.0 * way, 0.0], values)
    want = np.minimum(10.0 * length / way, 10.0)
    want[400:] = 10.0 * (1.0 - (2.0 * way - length[400:]) / way)
    assert np.abs(force - want).max() < 0.3


_SLIP = {"force": 12.0, "break_strain": 0.02, "ratio": 2.0}
_LAST = 0.02 * MUSCLE.nominal_length


def test_maxwell_slip_follows_its_cells() -> None:
    """The virgin curve is the sum of four elastic-perfectly sliding cells, up to the rounding of each."""
    length, force = along("maxwell_slip", [0.0, 1.5 * _LAST], _SLIP)
    limits = _LAST / 2.0 ** np.arange(4)
    want = 3.0 * np.minimum(length[:, None] / limits, 1.0).sum(axis=1)
    assert np.abs(force - want).max() < 0.04 * 12.0
    assert force[1] / length[1] == pytest.approx(3.0 * (1.0 / limits).sum(), rel=1e-6), (
        "sum of the stiffnesses"
    )
    slopes = np.diff(force)
    assert (np.diff(slopes) <= 1e-6).all(), "convex: it only bends over"


def test_maxwell_slip_branches_after_masing() -> None:
    """After a reversal F = F_r + 2 f((L - L_r)/2) with the virgin curve f."""
    virgin_length, virgin = along("maxwell_slip", [0.0, 2.0 * _LAST], _SLIP)
    length, force = along("maxwell_slip", [0.0, 2.0 * _LAST, -2.0 * _LAST], _SLIP)
    branch = slice(400, 801)
    gone = length[400] - length[branch]
    want = force[400] - 2.0 * np.interp(gone / 2.0, virgin_length, virgin)
    assert np.abs(force[branch] - want).max() < 0.04 * 12.0


@pytest.mark.parametrize("depth", [0.05, 0.3, 0.8])
def test_maxwell_slip_closes_small_loops(depth: float) -> None:
    """Back and forth ends where it left, and the branch goes on as if nothing had been; Dahl friction drifts.

    To 3 % of the full force: the band in which a cell goes from elastic to sliding is a tenth of its way.
    """
    turn, end = 0.6 * _LAST, 1.2 * _LAST
    way = [0.0, turn, turn - depth * _LAST, turn, end]
    gaps = {}
    for effect_id, values in (("maxwell_slip", _SLIP), ("dahl", {"force": 12.0, "break_strain": 0.005})):
        length, force = along(effect_id, way, values)
        gaps[effect_id] = abs(force[1200] - force[400]) / 12.0
        if effect_id == "maxwell_slip":
            direct_length, direct = along(effect_id, [0.0, end], values)
            went_on = np.interp(length[1200:], direct_length, direct)
            assert np.abs(force[1200:] - went_on).max() < 0.03 * 12.0
    assert gaps["maxwell_slip"] < 0.03
    assert gaps["dahl"] > gaps["maxwell_slip"]


def _play(commands: np.ndarray, width: float) -> np.ndarray:
    position, positions = 0.0, []
    for command in commands:
        position = max(command - 0.5 * width, min(command + 0.5 * width, position))
        positions.append(position)
    return np.array(positions)


@pytest.mark.parametrize("slowness", [1.0, 5.0])
def test_valve_hysteresis_is_the_play_operator(slowness: float) -> None:
    """For commands slow against 0.2 ms, at any speed; and it keeps within half a width of its command."""
    effect, width = CATALOGUE["valve_hysteresis"], 0.1
    time = np.linspace(0.0, 3.0 * slowness, 6001)
    commands = 0.6 * np.sin(2.0 * np.pi * time / slowness) * np.exp(-0.3 * time / slowness)

    def at(t: float) -> dict[str, float]:
        return {"opening": 0.6 * np.sin(2.0 * np.pi * t / slowness) * np.exp(-0.3 * t / slowness)}

    states = run(effect, at, time, {"width": width}, slot="drive_rates")
    got = effect.call("opening", {"opening": commands}, {"width": width, **states})
    np.testing.assert_allclose(got, _play(commands, width), atol=1e-3 / slowness)
    assert np.abs(got - commands).max() <= 0.5 * width + 1e-3 / slowness


@pytest.mark.parametrize("effect_id", FRICTIONS)
def test_friction_grows_with_powers_of_pressure_and_length(effect_id: str) -> None:
    """Three times the pressure and four fifths of the length: 3^(2/3) 0.8^2 times the force."""
    effect = CATALOGUE[effect_id]
    states = {state.name: 0.5 for state in effect.states}
    values = {**effect.defaults, "pressure_power": 2.0 / 3.0, "length_power": 2.0, **states}
    rest = MUSCLE.nominal_length
    here, there = (
        effect.call(
            "friction", {"muscle": MUSCLE, "pressure": pressure, "length": length, "velocity": 0.0}, values
        )
        for pressure, length in ((1.5e5, rest), (4.5e5, 0.8 * rest))
    )
    assert there / here == pytest.approx(3.0 ** (2.0 / 3.0) * 0.64, rel=1e-4)  # rounded below 10 mbar


@pytest.mark.parametrize("ratio", [0.5, 1.6])
def test_dahl_with_a_static_ratio_slides_as_stribeck_says(ratio: float) -> None:
    """After a long way at one speed v the friction is F_c (1 + (ratio - 1) exp(-(v/v_s)^2))."""
    for speed in (1e-3, 3e-3, 2e-2):
        values = {"force": 10.0, "static_ratio": ratio, "stribeck_speed": 3e-3}
        _, force = along("dahl", [0.3 + speed * second for second in range(20)], values)
        expected = 10.0 * (1.0 + (ratio - 1.0) * np.exp(-((speed / 3e-3) ** 2)))
        assert abs(force[-1]) == pytest.approx(expected, rel=1e-4)
