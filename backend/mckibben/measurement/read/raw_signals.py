"""Questions about signals without a scale: volts, milliamperes and counts where a channel is missing."""

from __future__ import annotations

import numpy as np

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.question import Question
from mckibben.measurement.read.calibrations import is_raw_share
from mckibben.measurement.read.evidence import Evidence
from mckibben.measurement.read.head_text import is_voltage, taken_apart
from mckibben.measurement.read.joints import TORQUE, TORQUE_ON_RIM, column_of
from mckibben.measurement.read.left_out import UNKNOWN, Reason
from mckibben.measurement.read.questions import column_option
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.unit_words import BRIDGE, COUNT, FULL_SCALE, RAW_DIMENSIONS, dimension_of
from mckibben.measurement.read.vocabulary import (
    COUNTER_WORDS,
    LETTERS,
    channel_of_word,
    has_word,
    proper_channel,
    words_of,
)

_SCALES = {
    "pressure": ("bar", "0 to 10 bar"), "force": ("N", "0 to 2000 N"), "length": ("mm", "0 to 300 mm"),
    "displacement": ("mm", "0 to 100 mm"), "contraction": ("mm", "0 to 100 mm"),
}  # fmt: skip
_RAW_SPANS = {
    "V": "0 to 10 V", "mV": "0 to 20 mV", "mA": "4 to 20 mA", "A": "0.004 to 0.02 A",
    BRIDGE: "0 to 2 mV/V", FULL_SCALE: "0 to 100 %FS", "%": "0 to 100 %",
}  # fmt: skip
_CALIBRATED = tuple(dimension for dimension in RAW_DIMENSIONS if dimension != "a count")


def raw_questions(evidence: Evidence) -> list[Question]:
    """How a signal is to be read that must be a missing channel: its scale, or what a count means."""
    return [*_volts(evidence), *_strokes(evidence), *_torques(evidence)]


def _torques(evidence: Evidence) -> list[Question]:
    """Where a pressure has no force beside it: a torque, which is one on the rim of its pulley."""
    name = column_of(evidence, TORQUE)
    if name is None or "pressure" not in evidence.channels or "force" in evidence.channels:
        return []
    if any(
        winner.use == "pressure" and "you" not in (winner.origin, other.origin)
        for winner, other in evidence.meaning.rivals
    ):
        return []  # of a joint, perhaps: which muscle is meant comes first
    return [
        Question(
            "force",
            f"{evidence.noun} '{name}' holds a torque, and the file has no force; no text states the radius "
            "of its pulley; which torque is which force",
            column_option("force", name, TORQUE_ON_RIM),
            name,
        )
    ]


def _is_filled(evidence: Evidence, channel: str) -> bool:
    if channel in (*STROKES, "extension"):
        return bool(set(evidence.channels) & {*STROKES, "diameter"})
    return channel in evidence.channels


def _free(evidence: Evidence) -> list[int]:
    """Columns of numbers that nothing is read from."""
    used = {column.place for column in evidence.used.values()}
    used |= {column.place for column in evidence.meaning.constants}
    return [
        index
        for index in range(len(evidence.headers))
        if index not in used and index not in evidence.meaning.dismissed and evidence.numeric(index)
    ]


def _head(evidence: Evidence, index: int) -> tuple[str, str | None]:
    """Name and unit of a column."""
    apart = evidence.apart[index] if index < len(evidence.apart) else None
    head = taken_apart(evidence.headers[index], apart)
    return head.name or evidence.headers[index], head.unit


def _volts(evidence: Evidence) -> list[Question]:
    asked: dict[str, Question] = {}
    for index in _free(evidence):
        name, unit = _head(evidence, index)
        share = is_raw_share(name, unit)
        if unit is None or unit == COUNT or not (dimension_of(unit) in RAW_DIMENSIONS or share):
            continue
        channel = proper_channel(recognise(name).channel) or _of_voltage(name)
        if channel not in _SCALES or _is_filled(evidence, channel) or channel in asked:
            continue
        asked[channel] = scale_question(evidence.noun, evidence.headers[index], channel, name, unit, share)
    return list(asked.values())


def scale_question(
    noun: str, header: str, channel: str, name: str, unit: str, share: bool = False
) -> Question:  # fmt: skip
    """What a signal without a scale is asked; ``name`` is that of the column without its unit."""
    span = f"{_RAW_SPANS.get(unit, f'0 to 10 {unit}')} = {_SCALES[channel][1]}"
    return Question(
        f"scale of {channel}",
        f"{noun} '{header}' ({channel}) is a signal in {unit}{' of a range' if share else ''}, and no text "
        "of the file says its scale; which one is it",
        column_option(channel, name, span),
        header,
    )


def question_of_chosen(evidence: Evidence, channel: str) -> Question | None:
    """The question for a column whose channel the user says, where it holds a signal without a scale."""
    index = evidence.used[channel].place
    name, unit = _head(evidence, index)
    if unit is None or dimension_of(unit) not in _CALIBRATED or channel not in _SCALES:
        return None
    return scale_question(evidence.noun, evidence.headers[index], channel, name, unit)


def _of_voltage(name: str) -> str | None:
    """The channel that the index of a voltage says: "U_p" is of the pressure, "U_F1" of the force."""
    if not is_voltage(name):
        return None
    word = words_of(name)[1]
    letter = LETTERS.get(word.rstrip("0123456789"))
    return letter or proper_channel(channel_of_word(word))


def _strokes(evidence: Evidence) -> list[Question]:
    """Where a pressure has no stroke beside it: counts, or with a force a column of an unknown name."""
    channels = set(evidence.channels)
    if "pressure" not in channels or channels & {*STROKES, "diameter"}:
        return []
    if any(
        proper_channel(recognise(_head(evidence, index)[0]).channel) in STROKES
        and dimension_of(_head(evidence, index)[1]) in _CALIBRATED
        for index in _free(evidence)
    ):
        return []  # its scale is asked for
    for index in _free(evidence):
        name, unit = _head(evidence, index)
        counted = unit == COUNT or (unit is None and has_word(words_of(name), COUNTER_WORDS))
        if counted and (span := _span(evidence, index)) is not None:
            low, high = span
            header = evidence.headers[index]
            return [
                Question(
                    "stroke",
                    f"{evidence.noun} '{header}' holds counts of an encoder, {low:.6g} to {high:.6g}, and "
                    "the file has no other stroke; no text states the counts per mm, where the stroke "
                    "is 0, or whether it grows as the muscle shortens; which counts are which stroke",
                    column_option("displacement", name, f"{high:.6g} to {low:.6g} counts = 0 to 80 mm"),
                    header,
                )
            ]
    if "force" not in channels:
        return []
    for index in _free(evidence):
        name, unit = _head(evidence, index)
        if dimension_of(unit) == "an angle" and (span := _span(evidence, index)) is not None:
            header = evidence.headers[index]
            return [
                Question(
                    "stroke",
                    f"{evidence.noun} '{header}' holds an angle, {span[0]:.4g} to {span[1]:.4g} {unit}, and "
                    "the file has no other stroke; no text states the radius of its pulley; which angle is "
                    "which stroke",
                    column_option("displacement", name, "0 to 90 deg = 0 to 40 mm"),
                    header,
                )
            ]
    for index in _free(evidence):
        name, unit = _head(evidence, index)
        reason = evidence.meaning.reasons.get(index, UNKNOWN).reason
        if unit is None and reason is Reason.UNKNOWN and _span(evidence, index) is not None:
            return [
                Question(
                    "stroke",
                    f"the file holds a pressure and a force, but no stroke; is it {evidence.noun} "
                    f"'{evidence.headers[index]}', whose name is not known, and what is its unit",
                    column_option("displacement", name, "mm"),
                    evidence.headers[index],
                )
            ]
    return []


def _span(evidence: Evidence, index: int) -> tuple[float, float] | None:
    """Smallest and largest value of a column; None where it does not change."""
    both = evidence.pair(index, index)
    if both is None or not len(both[0]) or float(np.ptp(both[0])) == 0.0:
        return None
    return float(np.min(both[0])), float(np.max(both[0]))
