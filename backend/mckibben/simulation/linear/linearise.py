"""Linear models of a drive at an operating point, and what they lose.

Where the equations have one derivative there is one model. Where they have two there are more, each named:
a valve that is closed fills on one side of its command and vents on the other; a muscle with friction is held
at rest, and slides once the friction is overcome.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mckibben.physics.errors import InputError
from mckibben.physics.gas import LAMINAR_RATIO
from mckibben.simulation.command.shapes import Signal
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times
from mckibben.simulation.linear.bound import BoundDrive
from mckibben.simulation.linear.equations import COMMAND, PRESSURE
from mckibben.simulation.linear.model import INPUT_SCALES, LinearModel, matrices, mean_of, model_of, moving
from mckibben.simulation.linear.point import Condition, OperatingPoint, operating_point

Array = np.ndarray

_DIFFERENT = 1e-6  # relative difference of two derivatives [1/s, scaled] that are not the same
_SILENT = 1e-12  # relative response of the pressure to a command that does nothing
_PROBE = 10.0  # rad/s; where it is tested whether the command acts


@dataclass(frozen=True)
class Linearisation:
    """Linear models at an operating point.

    Attributes:
        point: the equilibrium.
        models: one where the equations are smooth, several where something sticks or switches.
        primary: the model for loop and design: the only one, or the mean of both directions.
        lost: what the linear models do not contain, as sentences.
        smooth: whether nothing sticks or switches at the point.
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


def linearise(drive: Drive, condition: Condition | None = None) -> Linearisation:
    """Linear models of a drive.

    Args:
        drive: any drive.
        condition: of the operating point; None is the middle of the positions that can be held.

    Raises:
        InputError: there is no such equilibrium; the message says which there are. Field "at".
    """
    bound = BoundDrive(drive)
    with np.errstate(all="ignore"):
        return _linearised(bound, condition)


def _linearised(bound: BoundDrive, condition: Condition | None) -> Linearisation:
    rest = operating_point(bound, condition)
    sides = [side for sign in (1, -1) if (side := _side(rest, sign)) is not None]
    switches = len(sides) == 2 and (sides[0].offset != sides[1].offset or _differ(rest, sides[0], sides[1]))
    sticks = rest.on_stop is None and _sticks(rest)
    delay = max(dead_times(bound.drive))
    ways = {1: "filling", -1: "venting"}
    chosen = sides if switches else (sides if len(sides) == 1 else [_Side(0, 0.0)])
    models: list[LinearModel] = []
    sliding: list[LinearModel] = []
    for side in chosen:
        way = ways[side.sign] if switches else ""
        name = " ".join(filter(None, ["held" if sticks else "", way])) or "smooth"
        if rest.on_stop:
            name = " ".join(filter(None, ["on the stop", way]))
        text = _text(rest, way, sticks)
        models.append(
            model_of(rest, name=name, text=text, side=side.sign, dead_time=delay, offset=side.offset)
        )
    notes: list[str] = []
    if sticks:
        for direction, word in ((1, "shorter"), (-1, "longer")):
            side = next((each for each in sides if each.sign == direction), chosen[0])
            way = ways[direction] if switches else ""
            try:
                point = operating_point(bound, Condition("position", rest.position), direction=direction)
            except InputError as error:
                notes.append(f"there is no model that slides {word}: {error.message}")
                continue
            change = abs(point.pressure - rest.pressure)
            name = " ".join(filter(None, [f"sliding {word}", way]))
            text = (
                f"the muscle slides {word} against constant friction, which takes {change / 1e5:.3g} bar "
                f"{'more' if point.pressure > rest.pressure else 'less'} than the balance without it"
            )
            sign = side.sign if switches else 0
            sliding.append(
                model_of(
                    point, name=name, text=text, side=sign, dead_time=delay,
                    offset=side.offset if switches else 0.0,
                )
            )  # fmt: skip
    models += sliding
    primary = _primary(models, sliding, switches)
    if primary not in models:
        models.append(primary)
    band = _band(rest, sides)
    lost = (*_losses(rest, band, sticks, switches), *notes)
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


def _text(rest: OperatingPoint, way: str, sticks: bool) -> str:
    words = [f"the valve is {way}"] if way else []
    if rest.on_stop:
        words.append("the load rests on its end stop, so that only the air moves")
    elif sticks:
        words.append(
            "friction holds the muscle: it creeps below 1 mm/s, as it does in a run, and hardly moves"
        )
    return " and ".join(words) or "the equations are smooth here"


def _scaled(point: OperatingPoint, side: _Side, *, slides: bool = False) -> Array:
    """A and B over the magnitudes of states; one row of numbers."""
    scales = point.bound.scales
    a, b, _, _ = matrices(point, side=side.sign, slides=slides, offset=side.offset)
    b = b * np.array([INPUT_SCALES[port.name] for port in point.bound.equations.inputs])
    return np.concatenate([(a * scales / scales[:, None]).ravel(), (b / scales[:, None]).ravel()])


def _differ(point: OperatingPoint, first: _Side, second: _Side) -> bool:
    one, other = _scaled(point, first), _scaled(point, second)
    return bool(np.any(np.abs(one - other) > _DIFFERENT * (1.0 + np.maximum(np.abs(one), np.abs(other)))))


def _sticks(rest: OperatingPoint) -> bool:
    """Whether friction acts: the derivatives of a sliding muscle are not those at rest."""
    if rest.bound.reached:
        return True
    neutral = _Side(0, 0.0)
    held, slides = _scaled(rest, neutral), _scaled(moving(rest, 1), neutral, slides=True)
    return bool(np.any(np.abs(held - slides) > _DIFFERENT * (1.0 + np.abs(slides))))


def _acts(point: OperatingPoint, sign: int, offset: float) -> bool:
    """Whether a pressure reacts to a small change of the command on this side."""
    a, b, _, _ = matrices(point, side=sign, slides=False, offset=offset)
    scales = point.bound.scales
    names = [point.bound.names[index] for index in point.bound.independent]
    scaled = a * scales / scales[:, None]
    column = b[:, 0] / scales
    response = np.linalg.solve(1j * _PROBE * np.eye(len(scales)) - scaled, column)
    return abs(response[names.index("pressure")]) > _SILENT


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


def _losses(
    point: OperatingPoint, band: tuple[float, float] | None, sticks: bool, switches: bool
) -> list[str]:
    """What linear models at this point do not contain."""
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
    if drive.tube_in_use is not None or drive.regulator is not None:
        span = (1.0 - LAMINAR_RATIO) * (point.pressure + drive.ambient_pressure)
        lost.append(
            f"flow: it is proportional to the difference of two pressures up to {span:.3g} Pa only; beyond, "
            "it grows with the root"
        )
    if isinstance(drive.load.force, Signal):
        lost.append(f"load: the external force is constant, {point.bound.load_force:.4g} N as at the start")
    if not point.on_stop:
        tension = min(point.bound.tensions(point.state))
        lost.append(f"slack: the muscle must keep its tension, {tension:.4g} N at the operating point")
    return lost
