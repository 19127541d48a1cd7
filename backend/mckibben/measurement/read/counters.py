"""What a text says of a column of counts: the time of a count, the period of samples, a valve's states."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from mckibben.measurement.read.scales import Scale, state_of
from mckibben.measurement.read.unit_words import unit_of
from mckibben.measurement.read.vocabulary import MOVES, VALVE_WORDS, has_word, words_of

_NUMBER = r"[+-]?[0-9]+(?:[.,][0-9]+)?"
_TIME = (
    rf"(?P<number>{_NUMBER}(?:[eE]-?[0-9]+)?)\s*(?P<unit>ns|us|µs|μs|ms|msec|s|sec|seconds?|Hz|kHz)(?![^\W_])"
)
_IS = r"\s*(?:=|≙|:|is|are|ist|entspricht|équivaut à)\s*"
_COUNTS = frozenset(["tick", "ticks", "count", "counts", "timer", "jiffies", "cycles", "takt", "takte"])
_SAMPLES = frozenset(
    ["sample", "samples", "scan", "scans", "index", "idx", "record", "i", "n", "no", "nr", "k"]
)
#: "sample period 2 ms", "sampling interval: 2 ms", "Abtastzeit = 2 ms", "sample rate 500 Hz".
_PERIOD = re.compile(
    r"(?i)\b(?:sampl(?:e|ing)|scan|abtast|messtakt|logging|log)[\s-]?"
    r"(?P<what>time|period|interval|step|rate|frequency|zeit|periode|intervall|rate|frequenz)"
    rf"(?:{_IS}|\s+(?:of|von)?\s*)(?i:{_TIME})"
)
#: "sampled at 200 Hz", "recorded every 5 ms".
_SAMPLED = re.compile(
    r"(?i:\b(?:sampled|recorded|logged|acquired|abgetastet|aufgezeichnet)\s+(?:at|with|every|mit|alle)\s+)"
    rf"(?i:{_TIME})"
)
#: The rate is not that of the rows.
_THINNED = re.compile(
    r"(?i)averag|decimat|down-?sampl|every\s+[0-9n]|gemittelt|jede[rsn]?\b|reduced|filter|mean of"
)
_EXHAUST = VALVE_WORDS["exhaust"] | MOVES["lengthening"]
_FILL = MOVES["shortening"]
_STATE = re.compile(rf"\s*(?P<number>{_NUMBER})\s*%?\s*(?:=|≙|:|->|→|is|means)\s*(?P<words>[^\d=]+?)\s*")


def time_of_count(header: str, texts: Sequence[tuple[str, str]], *, by_one: bool) -> Scale | None:
    """The time of one count of a column without a unit, as a scale in seconds.

    Args:
        header: of the column: ``tick``, ``sample``.
        texts: of the file, and where they stand.
        by_one: the column counts its rows: each is 1 more than the one before.

    >>> time_of_count("tick", [("1 tick = 0.5 ms", "line 2")], by_one=False).factor
    0.0005
    """
    words = [word for word in words_of(header) if not word.isdigit()]
    if len(words) not in (1, 2):
        return None
    counts, samples = set(words) & _COUNTS, bool(set(words) & _SAMPLES)
    found: dict[float, tuple[str, str]] = {}
    for text, where in texts:
        for name in counts:
            stem = re.escape(name.rstrip("s"))
            for pattern in (
                rf"(?i)(?:(?<![\w.,])(?:1|one|a|per|each)\s+)?(?<![\w]){stem}s?(?:\s+(?:length|period|time))?{_IS}{_TIME}",
                rf"(?i){_TIME}\s*(?:/|per|pro|je|par)\s*{stem}s?\b",
            ):
                for match in re.finditer(pattern, text):
                    if (seconds := _seconds(match)) is not None:
                        found.setdefault(seconds, (match[0].strip(), where))
        if by_one and samples and _THINNED.search(text) is None:
            for match in (*_PERIOD.finditer(text), *_SAMPLED.finditer(text)):
                if (seconds := _seconds(match)) is not None:
                    found.setdefault(seconds, (match[0].strip(), where))
    if len(found) != 1:
        return None
    ((seconds, (said, where)),) = found.items()
    return Scale(seconds, 0.0, "count", "s", "time", f"'{said}'", where)


def _seconds(found: re.Match[str]) -> float | None:
    number = float(found["number"].replace(",", "."))
    unit = found["unit"].replace("μ", "µ")
    if number <= 0.0:
        return None
    if unit.lower().endswith("hz"):
        return 1.0 / (number * (1e3 if unit.lower() == "khz" else 1.0))
    return number * _UNITS[unit.lower()]


_UNITS = {
    "ns": 1e-9, "us": 1e-6, "µs": 1e-6, "ms": 1e-3, "msec": 1e-3,
    "s": 1.0, "sec": 1.0, "second": 1.0, "seconds": 1.0,
}  # fmt: skip


def valve_states_of(name: str, unit: str | None, texts: Sequence[tuple[str, str]]) -> Scale | None:
    """The scale of a command by the states that a text gives numbers of: ``cmd: 100 = fill, 0 = closed``.

    The share of opening is 0 where the valve is closed, +1 where it fills, -1 where it exhausts. Both the
    closed and the filling state have to be stated, and the name of the column before them.
    """
    if unit is not None and ((known := unit_of(unit)) is None or known.unit not in ("%", "1")):
        return None
    for text, where in texts:
        found = re.match(
            rf"(?i)[\s#%*-]*{re.escape(name)}\s*(?:[\[(]\s*%?\s*[\])])?\s*[:,=-]\s*(?P<states>.+)", text
        )
        if not name or found is None:
            continue
        levels = _levels(found["states"])
        if levels is None or not {"closed", "open"} <= set(levels):
            continue
        span = levels["open"] - levels["closed"]
        other = levels.get("exhaust", levels["closed"] - span)
        if span == 0.0 or abs(other - (levels["closed"] - span)) > 0.01 * abs(span):
            continue
        # A unit of % counts hundredths, as the numbers of the text do.
        return Scale(
            1.0 / span, -levels["closed"] / span, "count", "1", "valve", f"'{found[0].strip(' #')}'", where
        )
    return None


def _levels(text: str) -> Mapping[str, float] | None:
    """State -> its number; None = a clause says none, or two clauses differ."""
    levels: dict[str, float] = {}
    for clause in re.split(r"[,;](?=\s)|\s/\s", text.strip(" .")):
        found = _STATE.fullmatch(clause)
        state = _state(found["words"]) if found else None
        if found is None or state is None or state in levels:
            return None
        levels[state] = float(found["number"].replace(",", "."))
    return levels


def _state(text: str) -> str | None:
    """The state in a clause; a valve that is "open to exhaust" exhausts."""
    words = words_of(text)
    exhausts, closed = has_word(words, _EXHAUST), has_word(words, VALVE_WORDS["closed"])
    if exhausts and not closed and not has_word(words, _FILL):
        return "exhaust"
    return None if exhausts else state_of(text)
