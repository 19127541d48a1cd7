"""What a linear model at an operating point does not contain, as sentences."""

from __future__ import annotations

from mckibben.physics.gas import LAMINAR_RATIO
from mckibben.simulation.command.shapes import Signal
from mckibben.simulation.drive.transient import dead_times
from mckibben.simulation.linear.corner import Corner, slopes_in_words
from mckibben.simulation.linear.point import OperatingPoint


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
