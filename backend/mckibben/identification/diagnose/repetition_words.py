"""A repetition in words: what repeats, how often, and what does so."""

from __future__ import annotations

from mckibben.identification.diagnose.repetition import Repetition
from mckibben.identification.residual.digits import brief

_FEW_PER_SECOND = 1.0  # slower, the period is told


def repetition_text(found: Repetition, unit: str, scale: float) -> str:
    """What repeats, where it was seen, what does so, and how much of the rest it is.

    Args:
        found: the repetition.
        unit: of its amplitude.
        scale: from the scaled residual to that unit.
    """
    parts = "sweeps" if found.of_sweeps else "records"
    if found.in_step:
        seen = "in step throughout the file"
    elif found.parts < 2:
        seen = "in both halves of the sweep"
    elif found.shown == found.parts:
        seen = f"the same in all {found.parts} {parts}"
    else:
        seen = f"the same in {found.shown} of {found.parts} {parts}"
    if found.over == "time" and found.parts > 1:
        seen = seen.replace("the same in", "seen in")
    size = f"{100.0 * found.share:.0f} % of it, with an amplitude of {brief(scale * found.amplitude)} {unit}"
    grows = " that grows with the pressure" if found.grows else ""
    text = (
        f"it repeats {how_often(found.over, found.period)} ({seen}): {_cause(found)}; this is {size}{grows}"
    )
    if not found.also:
        return text
    others = " or ".join(how_often(over, period) for over, period in found.also)
    return f"{text}; these data cannot tell it from one {others}: repeat the run at another speed"


def how_often(over: str, period: float) -> str:
    """``every 3.2 mm of length``, ``12.5 times a second``."""
    if over == "length":
        return f"every {brief(1e3 * period)} mm of length"
    if over == "pressure":
        return f"every {brief(1e-5 * period)} bar of pressure"
    if over == "rows":
        return f"every {brief(period)} rows"
    if 1.0 / period < _FEW_PER_SECOND:
        return f"every {brief(period)} s"
    return f"{brief(1.0 / period)} times a second"


def _cause(found: Repetition) -> str:
    if found.over == "length":
        fades, pitch = "what rings after each turn of the motion", "a thread, rack or weave with that pitch"
        return f"{pitch}, or {fades}" if found.fades is None else fades if found.fades else pitch
    if found.over == "pressure":
        return "steps of that size in the regulator, the sensor or its converter"
    if found.over == "rows":
        return "hum, a pump or a vibration: the time of the rows would tell its frequency"
    if 1.0 / found.period < _FEW_PER_SECOND:
        return "a pump, a compressor or a regulator that hunts"
    return "hum of the mains, also as the sampling folds it, a pump or a vibration"
