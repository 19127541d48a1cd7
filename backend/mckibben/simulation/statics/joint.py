r"""Statics of a joint: muscles on levers, a spring, the weight of a link, the friction of the bearing.

.. math::
   \tau(\varphi) = \sum_i r_i F_i(L_i(\varphi), p_i) - k(\varphi - \varphi_k) - m g c\cos(\varphi - \varphi_h)

with the lever :math:`r_i = -dL_i/d\varphi` of each muscle. Its stiffness is

.. math:: K = -\frac{d\tau}{d\varphi} = \sum_i\Bigl(r_i^2\frac{\partial F_i}{\partial L} - r_i' F_i\Bigr)
   + k - m g c\sin(\varphi - \varphi_h)

at constant pressures (valves open), and with the stiffness of a constant gas mass in place of
:math:`\partial F/\partial L` where the valves are closed. The second term is that of a lever which changes
with the angle; it may be negative. A slack muscle has neither force nor stiffness.

Source: virtual work; for pairs, Tondu & Lopez, IEEE Control Systems 20(2) (2000) 15, doi 10.1109/37.833638.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mckibben.physics import ideal
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.physics.muscle_path import MusclePath
from mckibben.physics.units import GRAVITY
from mckibben.simulation.statics.model import StaticModel

Array = NDArray[np.float64]

_GRID = 361  # angles between the stops from which equilibria are refined
_LEVELS = 81  # pressures of a pair from which a stiffness is refined
_TOLERANCE = 1e-13
_NEWTON_STEPS = 60
_STEP = 1e-8  # Pa; last step of Newton's method
_SAME = 1e-12  # share within which a torque or a stiffness is the wanted one


@dataclass(frozen=True, slots=True)
class JointMuscle:
    """One muscle of a joint: its static model, and the path it runs along."""

    name: str
    model: StaticModel
    path: MusclePath


@dataclass(frozen=True, slots=True)
class MuscleState:
    """A muscle along angles; arrays of their shape, SI.

    Attributes:
        length, lever: of its path [m].
        force: tension, 0 where it is slack [N].
        torque: on the joint [N m].
        torque_by_pressure: its derivative [N m/Pa].
        stiffness, stiffness_closed: its part of that of the joint, valves open and closed [N m/rad].
        slack: where it hangs slack.
    """

    length: Array
    lever: Array
    force: Array
    torque: Array
    torque_by_pressure: Array
    stiffness: Array
    stiffness_closed: Array
    slack: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """Where the joint rests under its pressures and an external torque.

    Attributes:
        angle: [rad].
        stiffness: of the joint there, valves open [N m/rad].
        at_stop: whether a stop holds it.
    """

    angle: float
    stiffness: float
    at_stop: bool


@dataclass(frozen=True, slots=True)
class PressuresFor:
    """Pressures of a pair for an angle and a stiffness.

    Attributes:
        pressures: of the muscles, in their order, gauge [Pa]; empty where there are none.
        least, most: stiffness that can be had at this angle and torque [N m/rad]; NaN where the torque cannot
            be had at all.
    """

    pressures: tuple[float, ...]
    least: float
    most: float


@dataclass(frozen=True, slots=True)
class Joint:
    """Muscles about one axis, with what else turns it.

    Attributes:
        muscles: at least one.
        low, high: stops [rad].
        spring: stiffness of a torsion spring [N m/rad].
        spring_rest: angle at which it is relaxed [rad].
        weight: m g c, of a link of the mass m with its centre at the distance c [N m].
        level_at: angle at which the link is level [rad]; greater angles lift it.
        friction: torque of the bearing against the motion [N m].
        temperature: of the muscles [K].
    """

    muscles: tuple[JointMuscle, ...]
    low: float
    high: float
    spring: float = 0.0
    spring_rest: float = 0.0
    weight: float = 0.0
    level_at: float = 0.0
    friction: float = 0.0
    temperature: float = ROOM_TEMPERATURE

    def muscle_at(
        self, index: int, *, angle: Array, pressure: Array | float, direction: float = 0.0,
        dead_volume: float = 0.0, polytropic_exponent: float = 1.4,
    ) -> MuscleState:  # fmt: skip
        """One muscle at angles [rad] and gauge pressures [Pa] that broadcast.

        Args:
            index: of the muscle.
            angle, pressure: see above.
            direction: sign of the motion of the joint, for friction of the muscles; 0 the mean.
            dead_volume: gas volume outside of the muscle, for the closed valve [m^3].
            polytropic_exponent: of the closed gas.
        """
        angle, pressure = np.broadcast_arrays(np.asarray(angle, float), np.asarray(pressure, float))
        muscle = self.muscles[index]
        length, lever, slope = (
            np.broadcast_to(np.asarray(of(angle), float), angle.shape)
            for of in (muscle.path.length, muscle.path.lever, muscle.path.lever_slope)
        )
        inside = np.minimum(length, muscle.model.longest)
        out = muscle.model.outputs(
            length=inside.ravel(),
            pressure=pressure.ravel(),
            direction=(-direction * np.sign(lever)).ravel(),
            temperature=self.temperature,
        )
        out = {name: values.reshape(angle.shape) for name, values in out.items()}
        pulling = (out["tension"] > 0.0) & (length <= muscle.model.longest)
        force = np.where(pulling, out["tension"], 0.0)
        bulk = polytropic_exponent * (pressure + ideal.ATMOSPHERE)
        volume = out["volume"] + dead_volume + bulk * out["volume_by_pressure"]
        open_ = out["tension_by_length"]
        closed = open_ - out["tension_by_pressure"] * bulk * out["volume_by_length"] / volume
        force = np.where(length <= muscle.model.longest, force, np.nan)

        def turned(stiffness: Array) -> Array:
            return np.where(pulling, lever**2 * stiffness - slope * force, 0.0)

        by_pressure = np.where(pulling, lever * out["tension_by_pressure"], 0.0)
        return MuscleState(
            length, lever, force, lever * force, by_pressure, turned(open_), turned(closed), ~pulling
        )

    def passive(self, angle: Array | float) -> Array:
        """Torque of spring and weight [N m]."""
        at = np.asarray(angle, float)
        return -self.spring * (at - self.spring_rest) - self.weight * np.cos(at - self.level_at)

    def passive_stiffness(self, angle: Array | float) -> Array:
        """Their stiffness [N m/rad]."""
        return self.spring - self.weight * np.sin(np.asarray(angle, float) - self.level_at)

    def torque(
        self, *, angle: Array | float, pressures: Sequence[Array | float], direction: float = 0.0
    ) -> Array:
        """Torque that the joint exerts on what holds it [N m]; NaN beyond the braid lock of a muscle.

        Args:
            angle: [rad].
            pressures: one of each muscle, gauge [Pa]; they broadcast with the angle.
            direction: sign of the motion; the bearing takes its friction off then.
        """
        at = np.asarray(angle, float)
        parts = [
            self.muscle_at(index, angle=at, pressure=pressure, direction=direction).torque
            for index, pressure in enumerate(pressures)
        ]
        return sum(parts, self.passive(at)) - direction * self.friction

    def stiffness(
        self, *, angle: Array | float, pressures: Sequence[Array | float], closed: bool = False
    ) -> Array:
        """Stiffness of the joint [N m/rad], valves open or closed; arguments as `torque`."""
        at = np.asarray(angle, float)
        states = [self.muscle_at(i, angle=at, pressure=p) for i, p in enumerate(pressures)]
        return sum(
            ((s.stiffness_closed if closed else s.stiffness) for s in states), self.passive_stiffness(at)
        )

    def equilibria(self, *, pressures: Sequence[float], torque: float = 0.0) -> list[Equilibrium]:
        """Stable angles between the stops under the pressures and an external torque [N m], ascending.

        A stop that the torques press the joint against is one of them.
        """
        from scipy.optimize import brentq

        grid = np.linspace(self.low, self.high, _GRID)

        def total(angle: Array | float) -> Array:
            return self.torque(angle=angle, pressures=pressures) + torque

        values = total(grid)
        found = []
        if values[0] < 0.0:
            found.append(self._rest(self.low, pressures, at_stop=True))
        for place in np.flatnonzero((values[:-1] >= 0.0) & (values[1:] < 0.0)).tolist():
            angle = brentq(lambda a: float(total(a)), grid[place], grid[place + 1], xtol=_TOLERANCE)
            found.append(self._rest(float(angle), pressures, at_stop=False))
        if values[-1] >= 0.0:
            found.append(self._rest(self.high, pressures, at_stop=True))
        return found

    def _rest(self, angle: float, pressures: Sequence[float], *, at_stop: bool) -> Equilibrium:
        return Equilibrium(angle, float(self.stiffness(angle=angle, pressures=pressures)), at_stop)

    def pressures_for(
        self, *, angle: float, highest: float, stiffness: float | None = None, torque: float = 0.0
    ) -> PressuresFor:
        """Pressures with which the joint rests at an angle under an external torque, with a stiffness.

        A pair has one family of pressures for the angle (co-contraction), along which the stiffness changes;
        a single muscle has one pressure and its stiffness.

        Args:
            angle: [rad].
            highest: gauge pressure that can be had [Pa].
            stiffness: of the joint, valves open [N m/rad]; None = the least.
            torque: external [N m].

        Raises:
            ValueError: more than two muscles, whose pressures are not determined.
        """
        if len(self.muscles) == 1:
            own = float(self._pressure_of(0, np.asarray(angle), self._needed(angle, torque), highest))
            if not np.isfinite(own):
                return PressuresFor((), float("nan"), float("nan"))
            value = float(self.stiffness(angle=angle, pressures=[own]))
            fits = stiffness is None or abs(value - stiffness) <= _SAME * max(abs(value), 1.0)
            return PressuresFor((own,) if fits else (), value, value)
        first, second = self.family(angle=np.array([angle]), highest=highest, torque=torque)
        there = np.isfinite(second[0])
        if not np.any(there):
            return PressuresFor((), float("nan"), float("nan"))
        first, second = first[0][there], second[0][there]
        values = self.stiffness(angle=angle, pressures=[first, second])
        least, most = float(values.min()), float(values.max())
        wanted = least if stiffness is None else stiffness
        if not least <= wanted <= most:
            return PressuresFor((), least, most)

        def off(pressure: float) -> float:
            other = self._balancing(np.array([angle]), np.array([pressure]), torque, highest)
            return float(self.stiffness(angle=angle, pressures=[pressure, other[0]])) - wanted

        exact = int(np.argmin(np.abs(values - wanted)))
        turns = np.flatnonzero(np.diff(np.sign(values - wanted)) != 0.0)
        if abs(values[exact] - wanted) <= _SAME * max(abs(wanted), 1.0) or not len(turns):
            return PressuresFor((float(first[exact]), float(second[exact])), least, most)
        from scipy.optimize import brentq

        place = int(turns[0])
        own = float(brentq(off, first[place], first[place + 1], xtol=1e-7, rtol=1e-14))
        other = self._balancing(np.array([angle]), np.array([own]), torque, highest)
        return PressuresFor((own, float(other[0])), least, most)

    def family(self, *, angle: Array, highest: float, torque: float = 0.0) -> tuple[Array, Array]:
        """Pressures of both muscles of a pair with which the joint rests at each angle [Pa].

        Shape (angles, levels): from the least pressure of the first muscle to the highest one. At both ends a
        pressure is 0 or the highest. NaN where the angle cannot be held.

        Raises:
            ValueError: the joint does not have two muscles.
        """
        if len(self.muscles) != 2:
            raise ValueError("an angle and a stiffness determine the pressures of two muscles")
        at = np.asarray(angle, float)
        ends = [np.zeros(at.shape), np.full(at.shape, highest)]
        for other in (0.0, highest):  # the first pressure where the second one is at an end
            counter = self.muscle_at(1, angle=at, pressure=other).torque
            ends.append(self._pressure_of(0, at, self._needed(at, torque) - counter, highest))
        firsts = np.concatenate(
            [
                np.broadcast_to(np.linspace(0.0, highest, _LEVELS), (len(at), _LEVELS)),
                np.stack(ends[2:], axis=1),
            ],
            axis=1,
        )
        firsts = np.sort(firsts, axis=1)
        wide = np.broadcast_to(at[:, None], firsts.shape)
        seconds = self._balancing(wide.ravel(), firsts.ravel(), torque, highest).reshape(firsts.shape)
        return np.where(np.isfinite(seconds), firsts, np.nan), seconds

    def _needed(self, angle: Array | float, torque: float) -> Array:
        """Torque that the muscles have to give [N m]."""
        return -torque - self.passive(angle)

    def _balancing(self, angle: Array, first: Array, torque: float, highest: float) -> Array:
        """Pressure of the second muscle for each one of the first; NaN where there is none."""
        known = np.isfinite(first)
        of_first = self.muscle_at(0, angle=angle, pressure=np.where(known, first, 0.0)).torque
        needed = self._needed(angle, torque) - of_first
        return np.where(known, self._pressure_of(1, angle, needed, highest), np.nan)

    def _pressure_of(self, index: int, angle: Array, torque: Array, highest: float) -> Array:
        """Pressure at which a muscle gives each torque [N m], of the shape of both; NaN where none does.

        Newton's method inside of a shrinking bracket.
        """
        angle, torque = np.broadcast_arrays(np.asarray(angle, float), np.asarray(torque, float))

        def off(pressure: Array) -> tuple[Array, Array]:
            state = self.muscle_at(index, angle=angle, pressure=pressure)
            return state.torque - torque, state.torque_by_pressure

        low, high = np.zeros(angle.shape), np.full(angle.shape, highest)
        at_low, at_high = off(low)[0], off(high)[0]
        size = _SAME * np.maximum(np.abs(torque), 1e-3)
        sense = np.where(at_high >= at_low, 1.0, -1.0)
        possible = (sense * at_low <= size) & (sense * at_high >= -size)
        found = np.where(np.abs(at_low) <= size, low, np.where(np.abs(at_high) <= size, high, np.nan))
        open_ = possible & np.isnan(found)
        pressure = 0.5 * (low + high)
        for _ in range(_NEWTON_STEPS):
            value, slope = off(pressure)
            above = sense * value >= 0.0
            low, high = np.where(above, low, pressure), np.where(above, pressure, high)
            with np.errstate(all="ignore"):
                newton = pressure - value / slope
            inside = (newton >= low) & (newton <= high)
            following = np.where(inside, newton, 0.5 * (low + high))
            step, pressure = np.abs(following - pressure), following
            if not np.any(open_ & (step > _STEP)):
                break
        return np.where(open_, pressure, found)

    def region(self, *, highest: float, angles: Array, torque: float = 0.0) -> Array:
        """Least and most stiffness with which a joint can rest at each angle [N m/rad]; NaN where it cannot.

        Shape (2, angles).
        """
        at = np.asarray(angles, float)
        if len(self.muscles) == 1:
            pressures = [self._pressure_of(0, at, self._needed(at, torque), highest)[:, None]]
        else:
            pressures = list(self.family(angle=at, highest=highest, torque=torque))
        known = np.isfinite(pressures[-1])
        values = self.stiffness(angle=at[:, None], pressures=[np.where(known, p, 0.0) for p in pressures])
        least = np.min(np.where(known, values, np.inf), axis=1)
        most = np.max(np.where(known, values, -np.inf), axis=1)
        none = ~np.any(known, axis=1)
        return np.where(none, np.nan, np.stack([least, most]))


def weight_torque(*, mass: float, centre: float) -> float:
    """m g c of a link [N m]; mass [kg], distance of its centre from the axis [m]."""
    return mass * GRAVITY * centre
