"""Linear models of a drive at an operating point, and what they lose.

Where the equations have one derivative there is one model. Where they have two there are more, each named:
a valve that is closed fills on one side of its command and vents on the other; a muscle with friction is held
at rest, and slides once the friction is overcome. A regulator at rest is on such a corner too; where the load
moves alike on both of its sides there is one model, their mean, and it says the slopes of both.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mckibben.physics.errors import InputError
from mckibben.physics.gas import LAMINAR_RATIO
from mckibben.simulation.command.pwm import PulseWidth
from mckibben.simulation.command.shapes import Signal
from mckibben.simulation.drive.joint import at_stiffness
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times
from mckibben.simulation.linear.bound import FASTEST_SLIDING, SLIDING_SPEED, BoundDrive
from mckibben.simulation.linear.corner import Corner, corners_of, slopes_in_words
from mckibben.simulation.linear.equations import COMMAND, COUNTER_COMMAND, LOAD_FORCE, POSITION, PRESSURE
from mckibben.simulation.linear.model import INPUT_SCALES, LinearModel, matrices, mean_of, model_of
from mckibben.simulation.linear.point import Condition, OperatingPoint, at_speed, operating_point


def losses(
    point: OperatingPoint,
    *,
    band: tuple[float, float] | None,
    sticks: bool,
    switches: bool,
    corners: tuple[Corner, ...],
) -> list[str]:
    """What linear models at this point do not contain.

    Args:
        point: the operating point.
        band: commands between which nothing reacts.
        sticks: whether friction holds the muscle.
        switches: whether filling and venting have models of their own.
        corners: of the regulators.
    """
    drive = point.bound.drive
    lever = drive.load.lever_ratio
    lowest = 0.0 if drive.regulator is not None else -1.0
    up, down = 1.0 - point.command, point.command - lowest
    part = "regulator" if drive.regulator is not None else "valve"
    lost = [
        f"saturation: from {point.command:.4g} the command can rise by {up:.3g} and fall by {down:.3g}",
    ]
    if point.on_stop:
        lost.append("end stops: the load rests on one and leaves it only when the net force pulls it off")
    else:
        low, high = ((stop - point.stroke) / lever * 1e3 for stop in drive.stops)
        lost.append(f"end stops: {-low:.4g} mm below and {high:.4g} mm above the operating point")
    if band is not None:
        lost.append(
            f"dead band: between {band[0]:.4g} and {band[1]:.4g} the command does nothing; the models are "
            "those at its edges"
        )
    if switches:
        lost.append(
            f"switching: the {part} has another flow for filling than for venting; each side has its model"
        )
    if sticks:
        lost.append("friction: it holds the muscle until it is overcome; one model holds, the others slide")
    delays = dead_times(drive)
    if max(delays) > 0.0:
        lost.append(
            f"dead time: {delays[0] * 1e3:.3g} ms on, {delays[1] * 1e3:.3g} ms off; not in A, B, C, D, but "
            f"{max(delays) * 1e3:.3g} ms are in every frequency response, margin and design"
        )
    if drive.regulator is not None:
        regulator = drive.regulator
        lost.append(
            f"regulator: its orifices are fully open at errors above {regulator.band / 1e5:.3g} bar; beyond, "
            "the flow does not grow with the error"
        )
        whose = "the model has the mean of both slopes"
        if switches:
            whose = "each model has the slope of its side"
            whose += ", on which the second muscle is on the other one" if drive.pair else ""
        lost.append(
            f"corner: at rest a regulator is between filling and venting, {slopes_in_words(corners)}; {whose}"
        )
        if regulator.dead_band > 0.0:
            lost.append(
                f"dead band of the regulator: errors within ±{regulator.dead_band / 2e2:.3g} mbar move no air"
            )
    if drive.flow_control is not None:
        lost.append("flow control: it throttles one direction only; each side has its own flow")
    if drive.quick_exhaust is not None:
        lost.append(
            "quick exhaust: while venting, its opening grows with the pressure difference up to "
            f"{drive.quick_exhaust.band / 1e2:.3g} mbar; beyond, it is open"
        )
    if drive.tube_in_use is not None:
        span = (1.0 - LAMINAR_RATIO) * (point.pressure + drive.ambient_pressure)
        lost.append(
            f"flow: it is proportional to the difference of two pressures up to {span:.3g} Pa only; beyond, "
            "it grows with the root"
        )
    if drive.stiffness is not None:
        lost.append(
            "stiffness: the loop of the joint's stiffness is not in the models; both muscles keep the "
            "command that they have in common"
        )
    if isinstance(drive.load.force, Signal):
        lost.append(f"load: the external force is constant, {point.bound.load_force:.4g} N as at the start")
    if not point.on_stop:
        tension = min(point.bound.tensions(point.state))
        lost.append(f"slack: the muscle must keep its tension, {tension:.4g} N at the operating point")
    return lost


Array = np.ndarray

_DIFFERENT = 1e-6  # relative difference of two derivatives [1/s, scaled] that are not the same
_SILENT = 1e-12  # relative response of the pressure to a command that does nothing
_SEEN = np.geomspace(1.0, 60.0, 12)  # rad/s; frequencies of motions that a regulator can follow
_SAME_RESPONSE = 0.1  # largest relative difference of two responses whose mean is one model
_PROBE = 10.0  # rad/s; where it is tested whether the command acts


@dataclass(frozen=True)
class Linearisation:
    """Linear models at an operating point.

    Attributes:
        point: the equilibrium.
        models: one where the equations are smooth or the motion does not show which side of a regulator acts,
            several where something sticks or switches.
        primary: the model for loop and design: the only one, or the mean of both directions.
        lost: what the linear models do not contain, as sentences.
        smooth: whether nothing sticks or switches at the point in a way that the motion shows.
        dead_band: commands between which nothing reacts, None if there is no such band.
    """

    point: OperatingPoint
    models: tuple[LinearModel, ...]
    primary: LinearModel
    lost: tuple[str, ...]
    smooth: bool
    dead_band: tuple[float, float] | None


class _Side(NamedTuple):
    """A side of the command: 1 or -1, and how far the command has to move until the drive reacts."""

    sign: int
    offset: float


def linearise(
    drive: Drive, condition: Condition | None = None, *, sliding_speed: float = SLIDING_SPEED
) -> Linearisation:
    """Linear models of a drive.

    Args:
        drive: any drive.
        condition: of the operating point; None is the middle of the positions that can be held.
        sliding_speed: of the load, at which models of a load that slides against dry friction have the slopes
            of friction and damping [m/s]; default: it just slides.

    Raises:
        InputError: there is no such equilibrium; the message says which there are (field "at"). Or the speed
            is not positive or above 10 m/s (field "sliding_speed").
    """
    if not 0.0 < sliding_speed <= FASTEST_SLIDING:
        raise InputError(
            f"a sliding speed of {sliding_speed:g} m/s is not between 0 and {FASTEST_SLIDING:g} m/s",
            field="sliding_speed",
            hint="e.g. '20 mm/s'",
        )
    if drive.stiffness is not None:
        drive, condition = _joint(drive, condition)
    bound = BoundDrive(replace(drive, pwm=None))
    with np.errstate(all="ignore"):
        found = _linearised(bound, condition, sliding_speed)
    if drive.pwm is None:
        return found
    return replace(found, lost=(*found.lost, _modulated(drive.pwm)))


def _modulated(pwm: PulseWidth) -> str:
    """What a linear model of modulated valves leaves out.

    Raises:
        InputError: the valve fills and vents in each period, which no mean opening describes. Field "pwm".
    """
    if pwm.valves == "one":
        raise InputError(
            "there is no linear model of one valve that fills and vents in every period: no opening has the "
            "mean of both flows",
            field="pwm.valves",
            hint='"two", or leave pwm out',
        )
    return (
        f"pulse-width modulation: the models and the points beside them have its mean opening; ripple at "
        f"{pwm.frequency:g} Hz, up to {pwm.period * 1e3:.3g} ms until a command is read, and pulses below "
        f"{pwm.min_on * 1e3:.3g} ms are left out"
    )


def _joint(drive: Drive, condition: Condition | None) -> tuple[Drive, Condition]:
    """A joint at the stiffness of its set point, and the condition; by default the angle of its set point."""
    lever = drive.load.lever_ratio
    if condition is None:
        middle = 0.0 if drive.reference is None else float(drive.reference.value(0.0))
        condition = Condition("position", middle)
    stroke = 0.0
    if condition.kind == "position":
        stroke = condition.value * lever
    elif condition.kind == "contraction":
        stroke = (condition.value - drive.precontraction) * drive.muscle.nominal_length
    return at_stiffness(drive, stroke), condition


def _linearised(bound: BoundDrive, condition: Condition | None, speed: float) -> Linearisation:
    rest = operating_point(bound, condition)
    sides = [side for sign in (1, -1) if (side := _side(rest, sign)) is not None]
    switches = len(sides) == 2 and (sides[0].offset != sides[1].offset or _differ(rest, sides[0], sides[1]))
    sticks = rest.on_stop is None and _sticks(rest)
    corners = corners_of(rest)
    opening, closing = dead_times(bound.drive)
    delays = {1: opening, -1: closing, 0: max(opening, closing)}
    ways = {1: "filling", -1: "venting"}
    chosen = sides if switches else (sides if len(sides) == 1 else [_Side(0, 0.0)])
    models: list[LinearModel] = []
    sliding: list[LinearModel] = []
    for side in chosen:
        way = ways[side.sign] if switches else ""
        plain = "mean of both sides" if corners else "smooth"
        name = " ".join(filter(None, ["held" if sticks else "", way])) or plain
        if rest.on_stop:
            name = " ".join(filter(None, ["on the stop", way]))
        text = _text(rest, way, sticks, bool(corners))
        late, offset = delays[side.sign], side.offset
        models.append(model_of(rest, name=name, text=text, side=side.sign, dead_time=late, offset=offset))
    notes: list[str] = []
    if sticks:
        for direction, word in ((1, "shorter"), (-1, "longer")):
            side = next((each for each in sides if each.sign == direction), chosen[0])
            way = ways[direction] if switches else ""
            try:
                point = operating_point(bound, Condition("position", rest.position), direction=direction)
                point = at_speed(point, speed)
            except InputError as error:
                notes.append(f"there is no model that slides {word}: {error.message}")
                continue
            # A play of the valve settles elsewhere at the command with which the muscle slides.
            side = (_side(point, direction) or side) if switches else side
            change = abs(point.pressure - rest.pressure)
            name = " ".join(filter(None, [f"sliding {word}", way]))
            text = (
                f"the muscle slides {word} against its friction, which takes {change / 1e5:.3g} bar "
                f"{'more' if point.pressure > rest.pressure else 'less'} than the balance without it"
                + ("" if speed == SLIDING_SPEED else f"; slopes at {speed * 1e3:.4g} mm/s")
            )
            sign = side.sign if switches else 0
            sliding.append(
                model_of(
                    point, name=name, text=text, side=sign, dead_time=delays[sign],
                    offset=side.offset if switches else 0.0,
                )
            )  # fmt: skip
    models += sliding
    primary = _primary(models, sliding, switches)
    if primary not in models:
        models.append(primary)
    band = _band(rest, sides)
    lost = (*losses(rest, band=band, sticks=sticks, switches=switches, corners=corners), *notes)
    return Linearisation(rest, tuple(models), primary, lost, not (sticks or switches), band)


def _primary(models: list[LinearModel], sliding: list[LinearModel], switches: bool) -> LinearModel:
    both = sliding if len(sliding) == 2 else ([] if sliding else models[:2])
    if len(both) == 2 and both[0].states == both[1].states:
        ways = "filling and venting" if switches else "both directions"
        text = f"mean of '{both[0].name}' and '{both[1].name}', between which a small oscillation switches"
        share = balanced_share(side_gains(both)) if switches else 0.5
        return mean_of(both[0], both[1], share=share, name=f"mean of {ways}", text=text)
    return sliding[0] if sliding else models[0]


def side_gains(models: list[LinearModel]) -> tuple[float, float] | None:
    """Rates of the pressure per command while filling and while venting; None where there is one."""
    gains = {}
    for model in models:
        names = [state.name for state in model.states]
        for way in ("filling", "venting"):
            if model.name.endswith(way) and not model.name.startswith(("mean", "held")):
                a, b, _, _ = model.channel(COMMAND.name, PRESSURE.name)
                response = np.linalg.solve(1j * _PROBE * np.eye(len(a)) - a, b)
                gains[way] = float(abs(response[names.index("pressure")]))
    return (gains["filling"], gains["venting"]) if len(gains) == 2 else None


def balanced_bias(
    gains: tuple[float, float], amplitude: float, band: tuple[float, float] = (0.0, 0.0)
) -> float:
    """Offset of a sine of the command with which as much air flows in as out.

    Args:
        gains: of filling and venting.
        amplitude: of the sine.
        band: commands between which nothing flows, from the middle of the sine.
    """
    from scipy.optimize import root_scalar

    turn = np.sin(2.0 * np.pi * (np.arange(720) + 0.5) / 720.0)

    def net(bias: float) -> float:
        command = bias + amplitude * turn
        into = np.maximum(command - band[1], 0.0) * gains[0]
        return float(np.mean(into - np.maximum(band[0] - command, 0.0) * gains[1]))

    if net(-amplitude) * net(amplitude) >= 0.0:
        return 0.0
    return float(root_scalar(net, bracket=(-amplitude, amplitude), xtol=1e-12).root)


def balanced_share(gains: tuple[float, float] | None) -> float:
    r"""Share of the filling side in the describing function of a valve that fills and vents in balance.

    .. math:: N = K_+ s + K_- (1 - s), \quad s = \frac{1}{\pi} \int_{\beta + \sin\varphi > 0}
       (\beta + \sin\varphi) \sin\varphi\, d\varphi

    with the bias beta of `balanced_bias` over the amplitude.
    """
    if gains is None:
        return 0.5
    bias = balanced_bias(gains, 1.0)
    turn = np.sin(2.0 * np.pi * (np.arange(7200) + 0.5) / 7200.0)
    return float(2.0 * np.mean(np.maximum(bias + turn, 0.0) * turn))


def _text(rest: OperatingPoint, way: str, sticks: bool, corner: bool) -> str:
    words = [f"the valve is {way}"] if way else []
    if rest.on_stop:
        words.append("the load rests on its end stop, so that only the air moves")
    elif rest.motion is None:
        up, down = rest.friction
        words.append(
            f"dry friction holds the load: it does not move until the net force on it has grown by {up:.3g} "
            f"N upwards or {down:.3g} N downwards; only the air moves"
        )
    elif sticks:
        words.append("friction holds the muscle: while it builds up it is a spring, until the muscle slides")
    if corner and not way:
        words.append("the regulator rests on a corner, between filling and venting: the mean of both slopes")
    return " and ".join(words) or "the equations are smooth here"


def _scaled(point: OperatingPoint, side: _Side) -> Array:
    """A and B over the magnitudes of states; one row of numbers."""
    scales = point.bound.scales
    a, b, _, _ = matrices(point, side=side.sign, motion=point.motion, offset=side.offset)
    b = b * np.array([INPUT_SCALES[port.name] for port in point.bound.equations.inputs])
    return np.concatenate([(a * scales / scales[:, None]).ravel(), (b / scales[:, None]).ravel()])


def _differ(point: OperatingPoint, first: _Side, second: _Side) -> bool:
    if point.bound.drive.regulator is not None:
        return _respond_differently(point, first, second)
    one, other = _scaled(point, first), _scaled(point, second)
    return bool(np.any(np.abs(one - other) > _DIFFERENT * (1.0 + np.maximum(np.abs(one), np.abs(other)))))


def _respond_differently(point: OperatingPoint, first: _Side, second: _Side) -> bool:
    """Whether the position lets one see if a regulator fills or vents.

    Its orifices pass different flows, but each closes a pressure error within milliseconds: what counts is
    the response of the drive, not a derivative.
    """
    scales, equations = point.bound.scales, point.bound.equations
    inputs = [equations.inputs.index(port) for port in (COMMAND, LOAD_FORCE)]
    position = equations.outputs.index(POSITION)
    responses: list[Array] = []
    for side in (first, second):
        a, b, c, _ = matrices(point, side=side.sign, motion=point.direction, offset=side.offset)
        scaled, columns = a * scales / scales[:, None], b[:, inputs] / scales[:, None]
        turns = [1j * w * np.eye(len(scales)) - scaled for w in _SEEN]
        responses.append(
            np.array([(c[position] * scales) @ np.linalg.solve(turn, columns) for turn in turns])
        )
    size = np.abs(responses[0]).max(axis=0)
    return bool(np.any(np.abs(responses[0] - responses[1]).max(axis=0) > _SAME_RESPONSE * size + 1e-9))


def _sticks(rest: OperatingPoint) -> bool:
    """Whether friction holds the load at rest, dry friction or friction with memory."""
    return bool(rest.bound.reached) or rest.motion is None


def _acts(point: OperatingPoint, sign: int, offset: float) -> bool:
    """Whether the pressure, of a pair both, reacts to a small change of the command on this side."""
    a, b, _, _ = matrices(point, side=sign, motion=point.motion, offset=offset)
    bound, scales = point.bound, point.bound.scales
    ports = bound.equations.inputs
    commands = [COMMAND, COUNTER_COMMAND] if bound.drive.pair else [COMMAND]
    scaled, responses = a * scales / scales[:, None], []
    for port, place in zip(commands, bound.places("pressure"), strict=True):
        column = b[:, ports.index(port)] / scales
        response = np.linalg.solve(1j * _PROBE * np.eye(len(scales)) - scaled, column)
        responses.append(abs(response[bound.independent.index(place)]))
    return min(responses) > _SILENT


def _side(point: OperatingPoint, sign: int) -> _Side | None:
    """The smallest change of the command in a direction from which on the drive reacts; None without one."""
    drive = point.bound.drive
    lowest = 0.0 if drive.regulator is not None else -1.0
    room = (1.0 - point.command) if sign > 0 else (point.command - lowest)
    if room < 1e-6:
        return None
    if _acts(point, sign, 0.0):
        return _Side(sign, 0.0)
    quiet, loud = 0.0, None
    for offset in np.geomspace(1e-4, room, 25):
        if _acts(point, sign, sign * float(offset)):
            loud = float(offset)
            break
        quiet = float(offset)
    if loud is None:
        return None
    while loud - quiet > 1e-10:
        middle = 0.5 * (quiet + loud)
        quiet, loud = (quiet, middle) if _acts(point, sign, sign * middle) else (middle, loud)
    return _Side(sign, sign * loud)


def _band(point: OperatingPoint, sides: list[_Side]) -> tuple[float, float] | None:
    edges = {side.sign: point.command + side.offset for side in sides}
    if len(edges) < 2 or edges[1] - edges[-1] < 1e-8:
        return None
    return edges[-1], edges[1]
