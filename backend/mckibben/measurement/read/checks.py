"""Questions that the columns of a file and their numbers raise."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.kind import turning_points
from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.question import Question
from mckibben.measurement.read.blocks import UNNAMED
from mckibben.measurement.read.constants import constant_questions
from mckibben.measurement.read.correction import SAMPLE
from mckibben.measurement.read.counted_rows import counted_rows
from mckibben.measurement.read.evidence import Evidence, bare_name
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.joints import beside_chosen, joint_message
from mckibben.measurement.read.left_out import FINAL, Reason
from mckibben.measurement.read.physical_checks import context_questions, physical_questions
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.plausible import ENOUGH, is_plausible, median_step, proposal
from mckibben.measurement.read.propose import PROPOSED
from mckibben.measurement.read.questions import column_option, ignore_option
from mckibben.measurement.read.raw_signals import question_of_chosen, raw_questions
from mckibben.measurement.read.recognise import BY_WORDS
from mckibben.measurement.read.unit_words import dimension_of
from mckibben.physics.units import convert

Floats = NDArray[np.float64]

_CARRIES = {"a force": "force", "a pressure": "pressure", "a length": "length"}
_SAME = 0.01  # of the range; columns that differ by less are the same reading
_OPPOSED = -0.5  # correlation of the pressures of a pair, of which one is filled as the other is vented
_PROPORTIONAL = 0.98  # correlation of two strokes of one motion
_OF_A_PART = 0.8  # range of one of them over that of the other, below which it is of a part
_CLIPPED = 100  # the penalty of a clipped column
_RAW_PENALTY = 1  # between a column and its raw, filtered or clipped form


def questions_of(evidence: Evidence) -> list[Question]:
    """All questions, those that stop the reading first."""
    with np.errstate(all="ignore"):  # numbers near the largest there are
        return _questions(evidence)


def _questions(evidence: Evidence) -> list[Question]:
    rows = len(next(iter(evidence.channels.values()), ()))
    asked = _tables(evidence)
    if rows >= ENOUGH:
        asked += [
            *_units(evidence),
            *_proposed(evidence),
            *_unread(evidence),
            *raw_questions(evidence),
            *_rivals(evidence),
            *_specimens(evidence),
            *counted_rows(evidence),
        ]
        unit_doubts = {question.about for question in asked}
        if not any(about.startswith("unit of") for about in unit_doubts):
            asked += [*physical_questions(evidence)]
    asked += [*constant_questions(evidence, evidence.meaning.constants), *context_questions(evidence)]
    return sorted(asked, key=lambda question: not question.stops)


def _tables(evidence: Evidence) -> list[Question]:
    if not evidence.choices:
        return []
    titles = [title for title, _ in evidence.choices]
    return [
        Question(
            "sheet",
            f"{len(titles)} tables hold readings, {', '.join(map(repr, titles[:6]))}; which one is meant",
            f'--sheet "{titles[0]}"',
            None,
            titles[0],
            tuple(titles),
        )
    ]


def _units(evidence: Evidence) -> list[Question]:
    asked = []
    for channel, column in evidence.used.items():
        if (
            channel not in evidence.channels
            or column.unit_origin in ("you", "assumed")
            or channel in ("group", "direction")
            or (channel == "time" and evidence.by_clock)
        ):
            continue
        values = evidence.channels[channel]
        si, unit = CHANNEL_UNITS[channel], column.unit or CHANNEL_UNITS[channel]
        raw = convert(values, si, si) if unit == si else _back(values, unit, si)
        span = f"{np.min(raw):.4g} to {np.max(raw):.4g}"
        named = f"{evidence.noun} '{column.header}'"
        if column.unit_origin == "proposed" and (signal := question_of_chosen(evidence, channel)) is not None:
            asked.append(signal)
        elif column.unit_origin == "proposed":
            found = proposal(channel, raw)
            if found.si_will_do and not (channel == "force" and _open_force(evidence, found.choices)):
                continue
            *others, last = found.choices[:4] or ("",)
            likely = f"{', '.join(others)} or {last}" if others else last
            may = f"; they would be plausible in {likely}" if likely else ""
            asked.append(
                Question(
                    f"unit of {channel}",
                    f"{named} ({channel}) has no unit; its readings are {span}{may}",
                    column_option(channel, bare_name(column), found.unit),
                    column.header,
                    found.unit,
                    found.choices,
                )
            )
        elif not is_plausible(channel, values):
            stops = (
                channel != "pressure" or float(np.max(np.abs(values))) > _HARDLY or _forced(evidence, values)
            )
            better = [u for u in proposal(channel, raw).choices if u != unit]
            if channel == "time":
                step = median_step(values) or 0.0
                better = [u for u in ("ms",) if is_plausible("time", raw * 1e-3)]
                if not better or not _moves(evidence):
                    continue
                what = f"{named} would mean {step:.3g} s between readings"
            else:
                what = f"{named} ({channel}) holds {span} {unit}, which is implausible for a muscle"
            hint = better[0] if better else unit
            asked.append(
                Question(
                    f"unit of {channel}",
                    f"{what}. Is its unit {' or '.join([*better[:2], unit])}?",
                    column_option(channel, bare_name(column), hint),
                    column.header,
                    hint,
                    (*better, unit),
                    stops,
                )
            )
    return asked


def _open_force(evidence: Evidence, choices: tuple[str, ...]) -> bool:
    """Whether a force without unit may be in several: N is sure only where the whole file is in SI."""
    others = [
        (channel, column.unit)
        for channel, column in evidence.used.items()
        if channel in ("pressure", *STROKES, "diameter")
    ]
    return len(choices) > 1 and any(unit not in (None, CHANNEL_UNITS[channel]) for channel, unit in others)


_LONG_TEST = 900.0  # s; a test of readings by hand is shorter
_SWING = 0.1  # of the largest value; less is noise about a held value
_TURNS = 1
_JUMP, _JUMPS = 0.6, 2  # of the range of the pressure, between two rows
_HARDLY = 2e3  # Pa; below it a pressure moves no muscle
_LARGEST_AREA = 0.5  # m2, force over pressure; the largest catalogue muscle has 0.04


def _forced(evidence: Evidence, pressure: Floats) -> bool:
    """Whether the force is more than any muscle gives at such a pressure."""
    force = evidence.channels.get("force")
    if force is None:
        return False
    return bool(np.max(np.abs(force)) > _LARGEST_AREA * max(float(np.max(np.abs(pressure))), 1e-9))


def _back(values: Floats, unit: str, si: str) -> Floats:
    zero, one = convert([0.0, 1.0], unit, si)
    return (values - zero) / (one - zero)


def _moves(evidence: Evidence) -> bool:
    """Whether a test of many minutes goes up and down all the way, as no slow drift and no creep does.

    A log of holds does too, but there a pressure is another one from row to row, which in milliseconds no
    muscle follows.
    """
    time = evidence.channels["time"]
    if float(np.ptp(time)) < _LONG_TEST or _jumps(evidence.channels.get("pressure")):
        return False
    for channel in ("pressure", *STROKES, "force"):
        values = evidence.channels.get(channel)
        if values is not None and np.ptp(values) > _SWING * float(np.max(np.abs(values))):
            turns = turning_points(values, threshold=0.5 * float(np.ptp(values)))
            if np.count_nonzero(turns) >= _TURNS:
                return True
    return False


def _jumps(pressure: Floats | None) -> bool:
    """Whether a pressure goes most of its way between two rows, more than once."""
    if pressure is None or len(pressure) < ENOUGH:
        return False
    jumps = np.abs(np.diff(pressure)) > _JUMP * float(np.ptp(pressure))
    return bool(np.count_nonzero(jumps) >= _JUMPS)


def _unread(evidence: Evidence) -> list[Question]:
    """Columns in N, bar or mm that nothing is read from, and nothing says why."""
    meaning = evidence.meaning
    used = {column.place for column in evidence.used.values()}
    rivals = {other.place for _, other in meaning.rivals}
    filled = set(evidence.used)
    asked = []
    for index, header in enumerate(evidence.headers):
        if index in used or index in meaning.dismissed or index in rivals or not evidence.numeric(index):
            continue
        head = taken_apart(header, evidence.apart[index] if index < len(evidence.apart) else None)
        channel = "force" if header == UNNAMED else _CARRIES.get(dimension_of(head.unit))
        if dimension_of(head.unit) == "a mass" and "force" not in filled:
            channel = "force"  # a scale pulled by the muscle; beside a force it may be anything
        left_out = meaning.reasons.get(index)
        reason = Reason.UNKNOWN if left_out is None else left_out.reason
        if channel is None or reason in FINAL:
            continue
        is_filled = channel in filled or (channel == "length" and bool(filled & set(STROKES)))
        if reason is Reason.SET_VALUE and is_filled:
            continue
        name = head.name or header or f"column {index + 1}"
        target = "displacement" if channel == "length" else channel
        others = (target,) if target != "displacement" else ("displacement", "length", "diameter")
        doubt = (
            "; no text states its zero or whether it grows as the muscle shortens: is it "
            "the position of the muscle's end, and how does it count"
            if channel == "length" and not is_filled
            else "; what is it"
        )
        asked.append(
            Question(
                f"column '{name}'",
                f"{evidence.noun} '{header or name}' is in {head.unit or 'no unit'} and is not read"
                f"{'' if left_out is None else f' ({left_out.text})'}{doubt}",
                f"{ignore_option(name)} or {column_option(target, name)}",
                header or name,
                choices=("ignore", *others),
            )
        )
    return asked


def _proposed(evidence: Evidence) -> list[Question]:
    """Columns that only their unit and numbers tell: read, but said."""
    asked = []
    for channel, column in evidence.used.items():
        if column.origin == PROPOSED:
            other = "length" if channel == "displacement" else "displacement"
            name = bare_name(column)
            reversal = ", with its sign reversed," if column.sign < 0 else ""
            asked.append(
                Question(
                    f"column '{name}'",
                    f"{evidence.noun} '{column.header}' is read as {channel}{reversal} because of its unit "
                    f"'{column.unit}' and its numbers; its name does not say so",
                    f"{column_option(other, name)} or {ignore_option(name)}",
                    column.header,
                    channel,
                    (channel, other, "ignore"),
                    stops=False,
                )
            )
    return asked


def _rivals(evidence: Evidence) -> list[Question]:
    """Two columns for one channel that show different values."""
    asked = []
    for winner, other in evidence.meaning.rivals:
        if "you" in (winner.origin, other.origin) or winner.use not in evidence.channels:
            if winner.use == "pressure" and winner.origin == "you" and _are_opposed(evidence, winner, other):
                asked.append(beside_chosen(winner, other))
            continue
        if winner.use == "time":
            asked += _other_time(evidence, winner, other)
        if winner.use not in ("force", "pressure", *STROKES):
            continue
        if abs(_plainness(other) - _plainness(winner)) >= _RAW_PENALTY or not evidence.numeric(other.place):
            continue
        both = evidence.pair(winner.place, other.place)
        if both is None:
            continue
        si = CHANNEL_UNITS[winner.use]
        values, second = (convert(v, c.unit or si, si) for v, c in zip(both, (winner, other), strict=True))
        if float(np.max(np.abs(second - values))) <= _SAME * max(float(np.ptp(values)), 1e-12):
            continue
        first, later = bare_name(winner), bare_name(other)
        opposed = winner.use == "pressure" and _are_opposed(evidence, winner, other)
        which = f"'{winner.header}' and '{other.header}' are both {winner.use} and differ"
        if opposed:
            which = joint_message(evidence, winner, other)
        marked = _between_marks(winner, other, values, second)
        asked.append(
            Question(
                f"second {winner.use}",
                f"{evidence.noun}s {which}{marked}; which one acts on the muscle"
                f"{' that was tested by itself, if one was' if opposed else ''}",
                f"{column_option(winner.use, first)} or {column_option(winner.use, later)}",
                other.header,
                winner.header,
                (winner.header, other.header),
            )
        )
    return asked


def _are_opposed(evidence: Evidence, first: HeaderColumn, second: HeaderColumn) -> bool:
    """Whether two pressures run against each other, as in a joint."""
    both = evidence.pair(first.place, second.place) if evidence.numeric(second.place) else None
    if both is None or not all(np.ptp(values) > 0.0 for values in both):
        return False
    return float(np.corrcoef(both[0], both[1])[0, 1]) < _OPPOSED


def _between_marks(winner: HeaderColumn, other: HeaderColumn, values: Floats, second: Floats) -> str:
    """What is to be said of two strokes in proportion: one may be that of a part of the muscle."""
    if winner.use not in STROKES or not (np.ptp(values) > 0.0 and np.ptp(second) > 0.0):
        return ""
    alike = abs(float(np.corrcoef(values, second)[0, 1]))
    spans = sorted((float(np.ptp(values)), float(np.ptp(second))))
    if alike < _PROPORTIONAL or spans[0] > _OF_A_PART * spans[1]:
        return ""
    smaller = bare_name(winner if np.ptp(values) < np.ptp(second) else other)
    option = column_option("displacement", smaller, "0 to 100 mm = 0 to 300 mm")
    return (
        f"; '{smaller}' is {spans[0] / spans[1]:.2g} of the other: a stroke between marks belongs to their "
        f"distance, and of the whole muscle it is e.g. {option} for marks 100 mm apart on 300 mm"
    )


def _other_time(evidence: Evidence, winner: HeaderColumn, other: HeaderColumn) -> list[Question]:
    """A second column of times under the same name that runs otherwise: signals were sampled apart."""
    first, later = (re.sub(r"\s*#[0-9]+$", "", bare_name(column)) for column in (winner, other))
    both = evidence.pair(winner.place, other.place) if first == later else None
    if both is None or len(both[0]) < ENOUGH:
        return []
    apart = float(np.max(np.abs((both[0] - both[0][0]) - (both[1] - both[1][0]))))
    step = median_step(both[0])
    if step is None or apart <= 0.5 * step:
        return []
    return [
        Question(
            "second time",
            f"{evidence.noun} '{winner.header}' and {evidence.noun} '{other.header}' are times of different "
            f"signals and differ by up to {apart:.3g}, so the readings of a row are not simultaneous; bring "
            "the signals to one time axis, or leave out one signal and its time",
            ignore_option(f"column {other.place + 1}"),
            other.header,
        )
    ]


def _plainness(column: HeaderColumn) -> int:
    """How raw, filtered or clipped a column says to be, however its name was recognised."""
    return column.penalty if column.penalty >= _CLIPPED else column.penalty % BY_WORDS


def _specimens(evidence: Evidence) -> list[Question]:
    column = evidence.used.get(SAMPLE)
    labels = evidence.labels.get(column.place) if column else None
    words = [word for word in labels.words if word] if labels else []
    running = labels is not None and all(w.isdecimal() for w in words) and 2 * len(words) > len(labels.codes)
    if column is None or len(words) < 2 or column.origin == "you" or running:
        return []
    return [
        Question(
            "specimens",
            f"{evidence.noun} '{column.header}' names {len(words)} specimens, "
            f"{', '.join(map(repr, words[:4]))}; their readings belong to different muscles; split the "
            "file, or read all as one muscle",
            ignore_option(bare_name(column)),
            column.header,
            None,
            tuple(words[:8]),
        )
    ]
