"""Sealed measurements that try to make a comparison or a diagnosis say something false.

Every file is made from the closed formulas of this module, which share nothing with the program. A situation
carries its truth in words and the rule by which an answer is judged; both were written before the first
answer was seen. `python -m tests.benchmarks.claims` asks and judges.

A muscle is a thread of length b in n turns: tension p (3 L^2 - b^2)/(4 pi n^2), by virtual work. Its size
is the bore in mm; lengths, forces and noise scale with it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import cos, pi, radians, sin, sqrt, tan
from typing import Any
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Law = Callable[[Array, Array], Array]  # pressure [Pa], length [m] -> tension [N]

GRAVITY, BAR, ATMOSPHERE = 9.80665, 1e5, 101_325.0
NOISE = 0.004  # standard deviation of a force over the blocked force at 6 bar
NOISES = ("white", "ar09", "ar098", "swinging", "hum", "drift", "quantised", "heteroscedastic")
LEVELS = (1.4 * BAR, 2.4 * BAR, 3.5 * BAR, 4.6 * BAR, 5.8 * BAR)

# --- muscles


@dataclass(frozen=True)
class Muscle:
    """Dimensions at rest [m, rad]; ``braid`` is the diameter in the middle of the wall."""

    size: int
    rest: float
    braid: float
    wall: float
    angle: float

    @property
    def thread(self) -> float:
        return self.rest / cos(self.angle)

    @property
    def turns(self) -> float:
        return self.rest * tan(self.angle) / (pi * self.braid)

    @property
    def blocked(self) -> float:
        """Tension at the rest length and 6 bar [N]."""
        return float(self.ideal(np.array(6.0 * BAR), np.array(self.rest)))

    def ideal(self, pressure: Array, length: Array) -> Array:
        return pressure * (3.0 * length**2 - self.thread**2) / (4.0 * pi * self.turns**2)

    def diameter(self, length: Array) -> Array:
        return np.sqrt(self.thread**2 - length**2) / (pi * self.turns)

    def document(self) -> dict[str, Any]:
        """The muscle as arguments of a model."""
        return {
            "nominal_length": f"{1e3 * self.rest:.9g} mm",
            "inside_diameter": f"{1e3 * (self.braid - self.wall):.9g} mm",
            "braid_diameter": f"{1e3 * self.braid:.9g} mm",
            "braid_angle": f"{self.angle * 180.0 / pi:.9g} deg",
            "wall_thickness": f"{1e3 * self.wall:.9g} mm",
        }


MUSCLES = {
    size: Muscle(size, rest, braid, wall, radians(angle))
    for size, rest, braid, wall, angle in (
        (5, 0.1, 5.9e-3, 0.9e-3, 24.5),
        (12, 0.18, 13.3e-3, 1.3e-3, 25.2),
        (20, 0.3, 21.7e-3, 1.7e-3, 26.3),
        (40, 0.4, 42.4e-3, 2.4e-3, 26.0),
        (80, 0.6, 84e-3, 4e-3, 25.5),
    )
}

# --- laws of the length and the pressure


def neo_hookean(muscle: Muscle, modulus: float) -> Law:
    """W = modulus (I1 - 3) of a tube whose hoop stretch the braid dictates."""

    def tension(_: Array, length: Array) -> Array:
        q = 1.0 / tan(muscle.angle) ** 2
        along = length / muscle.rest
        hoop = 1.0 + q * (1.0 - along**2)  # squared
        slope = 2.0 * along - 2.0 * q * along
        slope = slope - (2.0 * along * hoop - 2.0 * q * along**3) / (along**2 * hoop) ** 2
        return pi * muscle.braid * muscle.wall * modulus * slope

    return tension


def gent(muscle: Muscle, modulus: float, limit: float) -> Law:
    """The wall of Gent, W = -modulus J ln(1 - (I1 - 3)/J), its slope by central differences."""

    def energy(length: Array) -> Array:
        along = length / muscle.rest
        around = muscle.diameter(length) / muscle.braid
        first = along**2 + around**2 + 1.0 / (along * around) ** 2 - 3.0
        return -pi * muscle.braid * muscle.wall * muscle.rest * modulus * limit * np.log1p(-first / limit)

    step = 1e-6 * muscle.rest
    return lambda _, length: (energy(length + step) - energy(length - step)) / (2.0 * step)


def stretched_threads(muscle: Muscle, strain: float) -> Law:
    """Threads that stretch by ``strain`` at 6 bar and the rest length, in proportion to p b L."""
    full = 6.0 * BAR * muscle.thread * muscle.rest

    def tension(pressure: Array, length: Array) -> Array:
        e = np.zeros_like(pressure)
        for _ in range(30):
            e = strain * pressure * muscle.thread * (1.0 + e) * length / full
        longer = muscle.thread * (1.0 + e)
        return pressure * (3.0 * length**2 - longer**2) / (4.0 * pi * muscle.turns**2)

    return tension


def late_bladder(muscle: Muscle, threshold: float, blur: float) -> Law:
    """The ideal muscle at the pressure that is left when the bladder has met the braid, softly."""

    def tension(pressure: Array, length: Array) -> Array:
        soft = blur * (
            np.logaddexp(0.0, (pressure - threshold) / blur) - np.logaddexp(0.0, -threshold / blur)
        )
        return muscle.ideal(soft, length)

    return tension


def soft_rig(muscle: Muscle, compliance: float) -> Law:
    """The muscle in a frame that gives way: the length that is read is longer by compliance F."""

    def tension(pressure: Array, length: Array) -> Array:
        force = muscle.ideal(pressure, length)
        for _ in range(60):
            force = 0.5 * force + 0.5 * muscle.ideal(pressure, length - compliance * force)
        return force

    return tension


# --- tests


@dataclass(frozen=True)
class Table:
    """Rows of a test, SI. ``level`` counts sweeps, ``side`` is the sign of dL/dt."""

    time: Array
    pressure: Array
    length: Array
    level: NDArray[np.int_]
    side: Array
    force: Array = field(default_factory=lambda: np.zeros(0))

    def adding(self, force: Array) -> Table:
        return replace(self, force=self.force + force)

    def picked(self, order: Array) -> Table:
        return Table(*(values[order] for values in vars(self).values()))


def loops(
    muscle: Muscle, law: Law, *, levels: tuple[float, ...] = LEVELS, rows: int = 60, step: float = 0.25,
    reserve: float = 0.04, speeds: tuple[float, ...] = (1.0,), deepest: float = 0.2,
) -> Table:  # fmt: skip
    """At each pressure from the rest length down and up again, as far as the muscle pulls with a reserve."""
    parts, begin = [], 0.0
    shares = 1.0 - np.abs(2.0 * (np.arange(rows) + 0.5) / rows - 1.0)
    grid = np.linspace(0.0, deepest, 201)
    for number, (pressure, speed) in enumerate((p, v) for v in speeds for p in levels):
        forces = law(np.full_like(grid, pressure), muscle.rest * (1.0 - grid))
        pulls = forces > reserve * muscle.blocked
        reach = grid[-1] if pulls.all() else grid[max(int(np.argmin(pulls)), 12)]
        time = begin + step / speed * np.arange(rows)
        begin = float(time[-1]) + 4.0 * step
        side = np.where(np.arange(rows) < rows // 2, -1.0, 1.0)
        length = muscle.rest * (1.0 - reach * shares)
        parts.append((time, np.full(rows, pressure), length, np.full(rows, number), side))
    columns = [np.concatenate(part) for part in zip(*parts, strict=True)]
    return Table(*columns, force=law(columns[1], columns[2]))


def clamped(muscle: Muscle, law: Law, *, rows: int = 60, step: float = 0.25, low: float = 0.6) -> Table:
    """At five lengths the pressure up and down between ``low`` and 6 bar."""
    parts, begin = [], 0.0
    shares = 1.0 - np.abs(2.0 * (np.arange(rows) + 0.5) / rows - 1.0)
    for number, contraction in enumerate((0.0, 0.035, 0.07, 0.105, 0.14)):
        time = begin + step * np.arange(rows)
        begin = float(time[-1]) + 4.0 * step
        pressure = BAR * (low + (6.0 - low) * shares)
        length = np.full(rows, muscle.rest * (1.0 - contraction))
        parts.append((time, pressure, length, np.full(rows, number), np.zeros(rows)))
    columns = [np.concatenate(part) for part in zip(*parts, strict=True)]
    return Table(*columns, force=law(columns[1], columns[2]))


def stops(muscle: Muscle, law: Law, *, hold: int = 20, step: float = 1.0) -> Table:
    """At three pressures the length goes in two rows to each of five places and rests there."""
    parts, begin = [], 0.0
    places = (0.0, 0.05, 0.11, 0.07, 0.02)
    for number, pressure in enumerate((2.6 * BAR, 4.1 * BAR, 5.7 * BAR)):
        contraction, last = [], 0.0
        for place in places:
            contraction += [last + (place - last) / 3.0, last + 2.0 * (place - last) / 3.0] + hold * [place]
            last = place
        length = muscle.rest * (1.0 - np.array(contraction))
        time = begin + step * np.arange(len(length))
        begin = float(time[-1]) + 60.0 * step
        side = np.sign(np.diff(length, prepend=length[0]))
        parts.append((time, np.full(len(length), pressure), length, np.full(len(length), number), side))
    columns = [np.concatenate(part) for part in zip(*parts, strict=True)]
    return Table(*columns, force=law(columns[1], columns[2]))


# --- parts that depend on the history


def dry(muscle: Muscle, table: Table, force: Array | float) -> Array:
    """Dry friction that builds up over 0.03 % of the rest length after each reversal, exponentially."""
    state, out = 0.0, np.zeros_like(table.length)
    for row, side in enumerate(table.side):
        fresh = row == 0 or table.level[row] != table.level[row - 1]
        moved = 0.0 if fresh else abs(table.length[row] - table.length[row - 1])
        moved = moved or 0.002 * muscle.rest  # it came here from outside
        state = side + (state - side) * np.exp(-moved / (3e-4 * muscle.rest))
        out[row] = state
    return force * out


def relaxing(muscle: Muscle, table: Table, stiffness: float, times: tuple[float, ...]) -> Array:
    """Maxwell arms of equal stiffness that were at rest before each pressure; exact between rows."""
    out = np.zeros_like(table.length)
    arms = np.zeros(len(times))
    for row in range(len(out)):
        if row == 0 or table.level[row] != table.level[row - 1]:
            arms[:] = 0.0
            continue
        moved = table.length[row] - table.length[row - 1]
        x = (table.time[row] - table.time[row - 1]) / np.array(times)
        arms = arms * np.exp(-x) + moved * (1.0 - np.exp(-x)) / x
        out[row] = stiffness / len(times) * float(np.sum(arms))
    return out


def speed_of(table: Table) -> Array:
    """dL/dt of a loop, constant in each of its branches [m/s]."""
    out = np.zeros_like(table.length)
    for level in np.unique(table.level):
        rows = np.flatnonzero(table.level == level)
        fastest = abs(table.length[rows[1]] - table.length[rows[0]])
        out[rows] = table.side[rows] * fastest / (table.time[rows[1]] - table.time[rows[0]])
    return out


def lagging(table: Table, values: Array, lag: float) -> Array:
    """A first-order instrument, exact for straight lines between rows."""
    out = values.copy()
    for row in range(1, len(values)):
        step = table.time[row] - table.time[row - 1]
        slope = (values[row] - values[row - 1]) / step
        rest = out[row - 1] - values[row - 1] + slope * lag
        out[row] = values[row] - slope * lag + rest * np.exp(-step / lag)
    return out


# --- noise


def noise_of(kind: str, rng: np.random.Generator, size: float, clean: Array) -> Array:
    """Noise along the rows, with about this standard deviation."""
    rows = len(clean)
    white = rng.standard_normal(rows)
    if kind == "white":
        return size * white
    if kind in ("ar09", "ar098"):
        keeps = 0.9 if kind == "ar09" else 0.98
        out = white.copy()
        for row in range(1, rows):
            out[row] = keeps * out[row - 1] + sqrt(1.0 - keeps**2) * white[row]
        return size * out
    if kind == "swinging":  # poles of magnitude 0.97, a period of 25 rows; 400 rows to settle
        out = np.zeros(rows + 400)
        drive = rng.standard_normal(rows + 400)
        for row in range(2, len(out)):
            out[row] = 1.94 * cos(2.0 * pi / 25.0) * out[row - 1] - 0.97**2 * out[row - 2] + drive[row]
        # Variance of the process with coefficients a1, a2.
        a1, a2 = 1.94 * cos(2.0 * pi / 25.0), -(0.97**2)
        variance = (1.0 - a2) / ((1.0 + a2) * ((1.0 - a2) ** 2 - a1**2))
        return size * out[400:] / sqrt(variance)
    if kind == "hum":
        return size * (1.2 * np.sin(2.0 * pi * np.arange(rows) / 5.3 + rng.uniform(0.0, 6.0)) + 0.5 * white)
    if kind == "drift":  # a random walk tied at both ends, and white noise
        walk = np.cumsum(rng.standard_normal(rows))
        walk -= np.linspace(0.0, walk[-1], rows)
        return size * (0.8 * walk / np.std(walk) + 0.6 * white)
    if kind == "quantised":
        unit = 3.0 * size
        return np.round((clean + 0.5 * size * white) / unit) * unit - clean
    if kind == "heteroscedastic":
        return size * (0.2 + 2.2 * np.abs(clean) / np.max(np.abs(clean))) * white
    raise ValueError(kind)


# --- files

#: Unit style -> head, factors from SI; time, pressure, length, force.
STYLES = {
    "bar": (("time [s]", "pressure [bar]", "length [mm]", "force [N]"), (1.0, 1e-5, 1e3, 1.0)),
    "SI": (("time [s]", "pressure [Pa]", "length [m]", "force [N]"), (1.0, 1.0, 1.0, 1.0)),
    "kN": (("time [ms]", "pressure [MPa]", "length [cm]", "force [kN]"), (1e3, 1e-6, 1e2, 1e-3)),
}


def text_of(table: Table, *, style: str = "bar", timed: bool = True, absolute: bool = False) -> str:
    """The CSV file of a table."""
    heads, factors = STYLES[style]
    pressure = table.pressure + (ATMOSPHERE if absolute else 0.0)
    columns = [table.time, pressure, table.length, table.force]
    cells = [factor * values for factor, values in zip(factors, columns, strict=True)]
    first = 0 if timed else 1
    lines = [",".join(heads[first:])]
    lines += [",".join(f"{value:.9g}" for value in row[first:]) for row in zip(*cells, strict=True)]
    return "\n".join(lines) + "\n"


# --- answers and rules


@dataclass(frozen=True)
class Said:
    """What the program says of a file; errors and noise in SI.

    Attributes:
        groups: effect that is named -> all that it says cannot be told from it, itself included.
        asked: entries that it asks about first.
        text: all that it prints.
    """

    status: str
    groups: Mapping[str, frozenset[str]]
    probabilities: Mapping[str, float]
    asked: tuple[str, ...]
    period: str | None
    before: float
    after: float
    noise: tuple[float, float] | None
    sentence: str
    text: str


@dataclass(frozen=True)
class Compared:
    """What a comparison with the start model says; ``status``: of its verdict."""

    rmse: float
    status: str
    text: str


Judgement = tuple[bool, str]  # right, and why not
Rule = Callable[["Situation", list[Said]], Judgement]


@dataclass(frozen=True)
class Situation:
    """A file or several, what a user says about it, the truth and the rule.

    Attributes:
        name: kind/what/size/....
        files: what is asked, one diagnosis each.
        muscle, effects: of the start model.
        options: of reading: rest length, load.
        truth: in words.
        rule: judges the answers; ``owes`` is the rule in words.
        added: whether what was proposed is added and asked again: the second answer.
        rms: of the noise of the file [N or m].
        accepted: names that are true.
    """

    name: str
    seed: int
    files: tuple[str, ...]
    muscle: dict[str, Any]
    truth: str
    owes: str
    rule: Rule
    effects: dict[str, dict[str, Any]] = field(default_factory=dict)
    options: dict[str, Any] = field(default_factory=dict)
    added: bool = False
    rms: float = 0.0
    accepted: frozenset[str] = frozenset()
    rows: tuple[int, ...] = ()  # of bad rows, counted from 1 in the table

    @property
    def kind(self) -> str:
        return self.name.split("/")[0]


def _false_names(accepted: frozenset[str], said: Said) -> list[str]:
    named = [name for name, group in said.groups.items() if not group & accepted]
    likely = [name for name, share in said.probabilities.items() if share > 0.5]
    inside = frozenset().union(*said.groups.values()) if said.groups else frozenset()
    return sorted({*named, *(name for name in likely if name not in accepted | inside)})


def nothing(situation: Situation, said: list[Said]) -> Judgement:
    """Adequate; no effect, no unknown one, no entry. A line of noise may be told as a period."""
    (one,) = said
    wrong = _false_names(situation.accepted, one)
    if wrong:
        return False, f"names {', '.join(wrong)}"
    if one.asked:
        return False, f"asks about {', '.join(one.asked)}"
    if one.status == "unknown_effect" and not (one.period and "/hum/" in situation.name):
        return False, "unknown effect"
    return True, ""


def the_effect(situation: Situation, said: list[Said]) -> Judgement:
    """Named (or its group), nothing else, no entry asked about first, and the error at the noise."""
    (one,) = said
    if one.asked and not set(one.asked) <= situation.accepted:
        return False, f"asks about {', '.join(one.asked)}"
    if one.asked:
        return True, ""
    wrong = _false_names(situation.accepted, one)
    if wrong:
        return False, f"names {', '.join(wrong)}"
    if not one.groups:
        return False, f"names nothing ({one.status})"
    if one.status == "unknown_effect":
        return False, "says that the rest is unknown"
    if one.after > 1.25 * situation.rms:
        return False, f"leaves {one.after / situation.rms:.2f} x noise"
    return True, ""


def the_comparison(situation: Situation, compared: Compared) -> Judgement:
    """Where nothing is hidden the error is the noise, and none else is proved; elsewhere it is not noise."""
    if situation.kind not in ("null", "true model"):
        adequate = compared.status == "adequate"
        return (False, "says that nothing is missing") if adequate else (True, "")
    if not 0.85 * situation.rms <= compared.rmse <= 1.15 * situation.rms:
        return False, f"error {compared.rmse:.4g}, noise {situation.rms:.4g}"
    proved = compared.status == "structure_left" and "repeats in step" not in compared.text
    return (False, "says that noise has structure") if proved else (True, "")


def unknown(situation: Situation, said: list[Said]) -> Judgement:
    """An unknown effect, or a period; no false name, and never that nothing is missing."""
    (one,) = said
    wrong = _false_names(situation.accepted, one)
    if wrong:
        return False, f"names {', '.join(wrong)}"
    if one.status == "adequate":
        return False, "says that nothing is missing"
    if one.status != "unknown_effect" and not one.period:
        return False, f"{one.status}{' asks about ' if one.asked else ''}{', '.join(one.asked)}"
    return True, ""


def repeats_at(period: float) -> Rule:
    """Unknown, and the period in the text within 3 %."""

    def rule(situation: Situation, said: list[Said]) -> Judgement:
        right, why = unknown(situation, said)
        if not right:
            return right, why
        told = re.findall(r"([\d.]+) (m?s)\b", said[0].period or "")
        seconds = [float(value) * (1e-3 if unit == "ms" else 1.0) for value, unit in told]
        if any(abs(value / period - 1.0) < 0.03 for value in seconds):
            return True, ""
        return False, f"the period of {period:g} s is not told: {said[0].period!r}"

    return rule


def no_false_cause(situation: Situation, said: list[Said]) -> Judgement:
    """Unknown; a period over the length is not told as a pitch, unless that over time is told beside it."""
    right, why = unknown(situation, said)
    if (
        right
        and re.search(r"thread, rack|pitch", said[0].text)
        and not re.search(r"\ds\b", said[0].period or "")
    ):
        return False, f"tells a cause that is not there: {said[0].period}"
    return right, why


def one_family(situation: Situation, said: list[Said]) -> Judgement:
    """The same file with and without its clock: the same names up to their groups, the same status."""
    first, other = said
    if (first.status == "unknown_effect") != (other.status == "unknown_effect"):
        return False, f"with time: {first.status}, without: {other.status}"
    for one, two, how in ((first, other, "with"), (other, first, "without")):
        for name in one.groups:
            if not any(name in group for group in two.groups.values()):
                return False, f"{name} is named {how} time and is in no group otherwise"
    return True, ""


def head_is_believed(situation: Situation, said: list[Said]) -> Judgement:
    """What the head states in words is not asked about; the effect is named."""
    (one,) = said
    if any("absolute" in entry for entry in one.asked) or "pressure is wrong" in " ".join(one.text.split()):
        return False, "doubts the word gauge in the head"
    return the_effect(situation, said)


def proposed_is_added(situation: Situation, said: list[Said]) -> Judgement:
    """Unknown before if and only if unknown after; nothing new is proposed for a complete proposal."""
    before, after = said
    if (before.status == "unknown_effect") != (after.status == "unknown_effect"):
        return False, f"before: {before.status}; after what it proposed was added: {after.status}"
    if before.status != "unknown_effect" and after.groups:
        return False, f"after what it proposed was added it proposes {', '.join(after.groups)}"
    if bool(before.asked) != bool(after.asked):
        return False, f"asks about {before.asked} before and about {after.asked} after"
    return True, ""


def one_verdict(situation: Situation, said: list[Said]) -> Judgement:
    """The same status, names, questions, and probabilities within 0.02."""
    first = said[0]
    for number, other in enumerate(said[1:], 2):
        if other.status != first.status:
            return False, f"file 1: {first.status}, file {number}: {other.status}"
        if set(other.groups) != set(first.groups) or other.asked != first.asked:
            return False, (
                f"file 1: {sorted(first.groups)} {first.asked}, file {number}: {sorted(other.groups)} "
                f"{other.asked}"
            )
        for name in {*first.probabilities, *other.probabilities}:
            pair = first.probabilities.get(name, 0.0), other.probabilities.get(name, 0.0)
            if abs(pair[0] - pair[1]) > 0.02:
                return (
                    False,
                    f"probability of {name}: {pair[0]:.2f} in file 1, {pair[1]:.2f} in file {number}",
                )
    return True, ""


_SUPERFLUOUS = re.compile(
    r"superfluous|not needed|needless|unnecessary|as well without|left out of the model|can be left out"
    r"|removed|take[sn]? (it )?away|adds nothing|does nothing|at zero|is 0\b|without (it|one of)",
    re.IGNORECASE,
)


def says_superfluous(*words: str) -> Rule:
    """A sentence names one of these titles and says that it is not needed; no effect is called missing."""

    def rule(situation: Situation, said: list[Said]) -> Judgement:
        (one,) = said
        wrong = _false_names(situation.accepted, one)
        if wrong:
            return False, f"names {', '.join(wrong)}"
        if one.status == "unknown_effect":
            return False, "unknown effect"
        # A console breaks its lines anywhere: a line of its own is one only where the text says so.
        texts = (one.text, " ".join(one.text.split()))
        sentences = [each for text in texts for each in re.split(r"(?<=[.:;])\s|\n(?=[a-z])", text)]
        for sentence in sentences:
            flat = " ".join(sentence.split())
            if _SUPERFLUOUS.search(flat) and any(word.lower() in flat.lower() for word in words):
                return True, ""
        return False, "does not say that it is superfluous"

    return rule


def names_the_rows(situation: Situation, said: list[Said]) -> Judgement:
    """The bad rows are named (number in the table or line of the file); nothing false is called missing."""
    (one,) = said
    wrong = _false_names(situation.accepted, one)
    if wrong:
        return False, f"names {', '.join(wrong)}"
    if one.asked:
        return False, f"asks about {', '.join(one.asked)}"
    flat = " ".join(one.text.split())
    told: set[int] = set()
    for match in re.finditer(r"\b(?:rows?|lines?) ((?:\d+(?:, | and | to |–|-)?)+)", flat):
        numbers = [int(number) for number in re.findall(r"\d+", match[1])]
        told.update(numbers)
        if re.search(r"to|–|-", match[1]) and len(numbers) == 2:
            told.update(range(numbers[0], numbers[1] + 1))
    missing = [row for row in situation.rows if not {row, row + 1} & told]
    if missing:
        return False, f"{one.status}; bad rows {', '.join(map(str, missing))} are not named"
    return True, ""


def tells_of_pushing(situation: Situation, said: list[Said]) -> Judgement:
    """It says that rows push; the rest is adequate."""
    (one,) = said
    wrong = _false_names(situation.accepted, one)
    if wrong:
        return False, f"names {', '.join(wrong)}"
    if one.asked:
        return False, f"asks about {', '.join(one.asked)}"
    if one.status == "unknown_effect":
        return False, "unknown effect"
    if not re.search(r"negative|push|below zero|compress|slack", one.text):
        return False, "says nothing of the negative forces"
    return True, ""


def asks_first(situation: Situation, said: list[Said]) -> Judgement:
    """The wrong entry is the first that it asks about."""
    (one,) = said
    if one.asked and one.asked[0] in situation.accepted:
        return True, ""
    if one.asked:
        return False, f"asks about {one.asked[0]} first"
    named = f", names {', '.join(one.groups)}" if one.groups else ""
    return False, f"{one.status}{named}; asks about no entry"


OWES = {
    nothing: "adequate; no effect, no unknown one, no entry",
    the_effect: "this effect or a group with it, nothing else, the error at the noise",
    unknown: "unknown or periodic, no false name, not adequate",
    proposed_is_added: "unknown before <=> unknown after, nothing new",
    one_verdict: "the same status, names, questions; probabilities within 0.02",
    names_the_rows: "these rows are named, no false effect",
    tells_of_pushing: "the negative forces are told, nothing else is missing",
    asks_first: "this entry is asked about first",
    no_false_cause: "unknown, and no cause that is not there",
    one_family: "the same names up to groups, with time and without",
    head_is_believed: "the effect, and no doubt of the word gauge in the head",
}

# --- the situations

Maker = Callable[[int], Situation]
_MAKERS: dict[str, Maker] = {}


def _known(muscle: Muscle) -> tuple[Law, dict[str, dict[str, Any]]]:
    return muscle.ideal, {}


def _rng(name: str, seed: int) -> np.random.Generator:
    return np.random.default_rng([crc32(name.encode()), seed])


def _measured(
    muscle: Muscle, table: Table, rng: np.random.Generator, noise: str = "white", share: float = NOISE
) -> tuple[Table, float]:
    added = noise_of(noise, rng, share * muscle.blocked, table.force)
    return table.adding(added), float(np.sqrt(np.mean(added**2)))


def _situation(
    name: str, seed: int, muscle: Muscle, tables: tuple[str, ...], truth: str, rule: Rule, **more: Any
) -> Situation:
    document = more.pop("document", None) or muscle.document()
    options = {"rest_length": document["nominal_length"], **more.pop("options", {})}
    owes = more.pop("owes", None) or OWES[rule]
    return Situation(name, seed, tables, document, truth, owes, rule, options=options, **more)


def _register(name: str, make: Callable[[str, np.random.Generator, int], Situation]) -> None:
    _MAKERS[name] = lambda seed: make(name, _rng(name, seed), seed)


def _null(size: int, noise: str, timed: bool, rig: str) -> None:
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table = (clamped if rig == "clamped" else loops)(muscle, muscle.ideal)
        table, rms = _measured(muscle, table, rng, noise)
        drifts = frozenset({"force_drift"}) if noise == "drift" else frozenset()
        truth = f"the ideal muscle and {noise} noise"
        text = text_of(table, timed=timed)
        return _situation(name, seed, muscle, (text,), truth, nothing, rms=rms, accepted=drifts)

    _register(f"null/{rig}/{noise}/{size} mm/{'time' if timed else 'no time'}", make)


for _number, _noise in enumerate(NOISES):
    _sizes = (5, 12, 20, 40, 80)
    _null(_sizes[_number % 5], _noise, True, "loops")
    _null(_sizes[(_number + 2) % 5], _noise, False, "loops")
_null(80, "ar098", True, "clamped")
_null(5, "swinging", True, "clamped")

Build = Callable[[Muscle, np.random.Generator], tuple[Table, dict[str, Any]]]


def _effect(
    what: str, size: int, accepted: str, build: Callable[[Muscle], Table], *, style: str = "bar",
    timed: bool = True, noise: str = "white", share: float = NOISE, rule: Rule = the_effect,
    kind: str = "effect", owes: str = "",
) -> None:  # fmt: skip
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table, rms = _measured(muscle, build(muscle), rng, noise, share)
        text = text_of(table, style=style, timed=timed)
        names = frozenset(accepted.split())
        return _situation(
            name, seed, muscle, (text,), what, rule, rms=rms, accepted=names, owes=owes or OWES.get(rule, "")
        )

    _register(f"{kind}/{what}/{size} mm/{style}/{'time' if timed else 'no time'}", make)


def _with_dry(share: float) -> Callable[[Muscle], Table]:
    def build(muscle: Muscle) -> Table:
        table = loops(muscle, muscle.ideal, reserve=0.04 + share)
        return table.adding(dry(muscle, table, share * muscle.blocked))

    return build


_RUBS = "coulomb_friction dahl bouc_wen maxwell_slip"
_effect("Coulomb friction of 3 %", 5, _RUBS, _with_dry(0.03))
_effect("Coulomb friction of 6 %", 12, _RUBS, _with_dry(0.06), style="SI", timed=False)
_effect("Coulomb friction of 6 %", 40, _RUBS, _with_dry(0.06), style="kN")
_effect("Coulomb friction of 4 %", 80, _RUBS, _with_dry(0.04), timed=False)


def _prestressed(muscle: Muscle, share: float = 0.03) -> Table:
    return loops(muscle, lambda p, x: muscle.ideal(p, x) - share * muscle.blocked)


_effect("prestress of 3 %", 5, "prestress force_offset", _prestressed)
_effect("prestress of 3 %", 80, "prestress force_offset", _prestressed, style="kN", timed=False)


def _walled(muscle: Muscle) -> Table:
    wall = gent(muscle, 0.35e6, 8.0)
    return loops(muscle, lambda p, x: muscle.ideal(p, x) + wall(p, x))


_effect("Gent wall", 12, "bladder_elasticity linear_elasticity", _walled, style="SI")
_effect("Gent wall", 40, "bladder_elasticity linear_elasticity", _walled, timed=False)


def _viscous(muscle: Muscle) -> Table:
    """Speeds over a decade; the coefficient falls a little with the speed."""
    table = loops(
        muscle, muscle.ideal, speeds=(1.0, 4.0, 12.0), levels=(2.4 * BAR, 4.1 * BAR, 5.8 * BAR), rows=40,
        reserve=0.1,
    )  # fmt: skip
    speed = speed_of(table)
    scale = float(np.max(np.abs(speed)))
    return table.adding(0.06 * muscle.blocked * speed / scale * (1.0 + (speed / scale) ** 2) ** -0.15)


_effect("viscous damping at three speeds", 20, "viscous_damping", _viscous)
_effect("viscous damping at three speeds", 80, "viscous_damping", _viscous, style="kN")
_THREADS = "thread_extensibility"
_effect("threads that stretch by 1 %", 20, _THREADS, lambda m: loops(m, stretched_threads(m, 0.01)))
_effect("threads that stretch by 1 %", 80, _THREADS, lambda m: clamped(m, stretched_threads(m, 0.01)))


def _creeping(muscle: Muscle) -> Table:
    table = stops(muscle, muscle.ideal)
    stiffness = 0.2 * muscle.blocked / (0.1 * muscle.rest)
    return table.adding(relaxing(muscle, table, stiffness, (3.0, 9.0, 27.0)))


_effect("creep after stops", 20, "creep", _creeping)
_effect("creep after stops", 5, "creep", _creeping, style="SI")
_SCALES = "force_scale effectiveness pressure_scale braid_diameter wall_thickness"
_effect("force cell reads 6 % too much", 40, _SCALES, lambda m: loops(m, lambda p, x: 1.06 * m.ideal(p, x)))


def _zero_of_pressure(muscle: Muscle) -> Table:
    table = clamped(muscle, muscle.ideal)
    return replace(table, pressure=table.pressure + 0.14 * BAR)


_effect("pressure gauge reads 0.14 bar too much", 12, "pressure_offset", _zero_of_pressure)
_effect("bladder meets the braid at 0.35 bar", 5, "threshold_pressure",
        lambda m: clamped(m, late_bladder(m, 0.35 * BAR, 0.05 * BAR), low=0.1))  # fmt: skip


def _crossing(muscle: Muscle) -> Table:
    """Threads that turn on each other: friction p D(L) cot(theta)."""
    table = loops(muscle, muscle.ideal, reserve=0.1)
    cosine = table.length / muscle.thread
    level = table.pressure * muscle.diameter(table.length) * cosine / np.sqrt(1.0 - cosine**2)
    return table.adding(dry(muscle, table, 0.06 * muscle.blocked * level / float(np.max(level))))


_effect("friction of crossing threads", 80, "pressure_friction contact_friction", _crossing, timed=False)
_effect("frame gives way by 0.6 % of the length", 80, "rig_compliance",
        lambda m: loops(m, soft_rig(m, 0.006 * m.rest / m.blocked)))  # fmt: skip


def _slow_cell(muscle: Muscle) -> Table:
    table = clamped(muscle, muscle.ideal, step=0.05)
    return replace(table, force=lagging(table, table.force, 0.08))


_effect("force cell with a lag of 80 ms", 20, "sensor_lag time_skew", _slow_cell)


# what no catalogue has


def _bump(muscle: Muscle) -> Table:
    def law(p: Array, x: Array) -> Array:
        k = 1.0 - x / muscle.rest
        return muscle.ideal(p, x) + 0.03 * muscle.blocked * np.exp(-(((k - 0.07) / 0.008) ** 2))

    return loops(muscle, law, levels=(2.9 * BAR, 3.6 * BAR, 4.4 * BAR, 5.1 * BAR, 5.8 * BAR))


def _swinging(amplitude: float, period: float, step: float) -> Callable[[Muscle], Table]:
    def build(muscle: Muscle) -> Table:
        table = loops(muscle, muscle.ideal, step=step, reserve=0.08)
        wave = np.sin(2.0 * pi * table.time / period + 0.7)
        return table.adding(amplitude * NOISE * muscle.blocked * wave)

    return build


def _ringing(muscle: Muscle) -> Table:
    """A frame that rings for a while after each reversal."""
    table = loops(muscle, muscle.ideal, reserve=0.08)
    turned = table.time.copy()
    for row in range(1, len(turned)):
        turning = table.side[row] == table.side[row - 1] and table.level[row] == table.level[row - 1]
        turned[row] = turned[row - 1] if turning else table.time[row]
    since = table.time - turned
    wave = np.exp(-since / 4.0) * np.sin(2.0 * pi * since / 1.7)
    return table.adding(8.0 * NOISE * muscle.blocked * wave)


def _band(muscle: Muscle) -> Table:
    """A bump over the pressure alone."""
    return clamped(
        muscle,
        lambda p, x: muscle.ideal(p, x) + 0.03 * muscle.blocked * np.exp(-(((p - 3.3e5) / 0.2e5) ** 2)),
    )


def _slipped(muscle: Muscle) -> Table:
    """A clamp that slips by 1.5 % of the length at three eighths of the test and back at six eighths."""
    table = loops(muscle, muscle.ideal, reserve=0.1)
    share = np.arange(len(table.time)) / len(table.time)
    gone = 0.008 * muscle.rest * ((share > 0.375) & (share < 0.75))
    return replace(table, force=muscle.ideal(table.pressure, table.length - gone))


for _size in (20, 80):
    _effect("bump over contraction", _size, "", _bump, kind="unknown", rule=unknown, timed=_size == 20)
for _size, _style in ((12, "bar"), (40, "kN")):
    _effect("hum of 60 s, 6 sigma", _size, "", _swinging(6.0, 60.0, 2.0), kind="unknown", style=_style,
            rule=repeats_at(60.0), owes="unknown, with the period of 60 s")  # fmt: skip
_effect("hum of 60 s, 3 sigma", 80, "", _swinging(3.0, 60.0, 2.0), kind="unknown",
        rule=repeats_at(60.0), owes="unknown, with the period of 60 s")  # fmt: skip
_effect("hum of 60 s, 6 sigma", 20, "", _swinging(6.0, 60.0, 2.0), kind="unknown", rule=unknown, timed=False)
_effect("frame rings after reversals", 12, "", _ringing, kind="unknown", rule=unknown)
_effect("bump over pressure", 40, "", _band, kind="unknown", rule=unknown)
_effect("clamp slips for a while", 5, "", _slipped, kind="unknown", rule=unknown)


# the same answer


def _shared_end(muscle: Muscle) -> Table:
    """Dry friction, and five readings at the far ends off by the same force."""
    table = _with_dry(0.04)(muscle)
    force = table.force.copy()
    force[np.arange(5) * 60 + 30] -= 12.0 * NOISE * muscle.blocked
    return replace(table, force=force)


def _walled_and_dry(muscle: Muscle) -> Table:
    wall = gent(muscle, 0.35e6, 8.0)
    table = loops(muscle, lambda p, x: muscle.ideal(p, x) + wall(p, x), reserve=0.1)
    return table.adding(dry(muscle, table, 0.03 * muscle.blocked))


def _prestressed_bump(muscle: Muscle) -> Table:
    return _bump(muscle).adding(np.full(300, -0.03 * muscle.blocked))


for _what, _size, _build, _noise, _timed in (
    ("five rows at a shared end", 20, _shared_end, "white", False),
    ("Coulomb friction of 6 %", 40, _with_dry(0.06), "white", True),
    ("Coulomb friction of 4 %, ar098", 12, _with_dry(0.04), "ar098", True),
    ("wall and dry friction, ar09", 80, _walled_and_dry, "ar09", False),
    ("prestress and a bump", 20, _prestressed_bump, "white", True),
    ("hum of 60 s, 6 sigma", 12, _swinging(6.0, 60.0, 2.0), "white", True),
):

    def _add(what: str, size: int, build: Callable[[Muscle], Table], noise: str, timed: bool) -> None:
        muscle = MUSCLES[size]

        def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
            table, rms = _measured(muscle, build(muscle), rng, noise)
            text = text_of(table, timed=timed)
            return _situation(name, seed, muscle, (text,), what, proposed_is_added, rms=rms, added=True)

        _register(f"add/{what}/{size} mm", make)

    _add(_what, _size, _build, _noise, _timed)


def _in_order(table: Table, order: tuple[int, ...]) -> Table:
    """The sweeps in another order, measured one after the other: their clock is started anew."""
    rows = np.concatenate([np.flatnonzero(table.level == level) for level in order])
    return replace(table.picked(rows), time=table.time)


for _what, _size, _build, _noise, _timed in (
    ("five rows at a shared end", 20, _shared_end, "white", False),
    ("Coulomb friction of 6 %", 40, _with_dry(0.06), "ar09", True),
    ("wall and dry friction", 80, _walled_and_dry, "white", True),
    ("prestress of 3 %", 5, _prestressed, "ar09", False),
    ("bump over contraction", 12, _bump, "white", False),
):

    def _same(what: str, size: int, build: Callable[[Muscle], Table], noise: str, timed: bool) -> None:
        muscle = MUSCLES[size]

        def make(how: str) -> Callable[[str, np.random.Generator, int], Situation]:
            def situation(name: str, _: np.random.Generator, seed: int) -> Situation:
                table, rms = _measured(muscle, build(muscle), _rng(f"same {what}", seed), noise)
                other = _in_order(table, (3, 0, 4, 1, 2)) if how == "order" else table
                style = "kN" if how == "units" else "bar"
                texts = (text_of(table, timed=timed), text_of(other, timed=timed, style=style))
                return _situation(name, seed, muscle, texts, what, one_verdict, rms=rms)

            return situation

        for how in ("order", "units"):
            _register(f"same {how}/{what}/{size} mm", make(how))

    _same(_what, _size, _build, _noise, _timed)


# one effect too many


def _too_many(
    what: str, size: int, build: Callable[[Muscle], Table], effects: Callable[[Muscle], dict[str, Any]],
    words: tuple[str, ...], *, timed: bool = True,
) -> None:  # fmt: skip
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table, rms = _measured(muscle, build(muscle), rng)
        return _situation(
            name, seed, muscle, (text_of(table, timed=timed),), what, says_superfluous(*words), rms=rms,
            effects=effects(muscle), owes="one is said to be superfluous; nothing is missing",
        )  # fmt: skip

    _register(f"superfluous/{what}/{size} mm", make)


_too_many(
    "Coulomb friction alone, Bouc-Wen and Coulomb stated", 20, _with_dry(0.03),
    lambda m: {"bouc_wen": {}, "coulomb_friction": {"force": 0.02 * m.blocked}}, ("Bouc", "Coulomb"),
)  # fmt: skip
_too_many(
    "no friction, Coulomb stated", 20, lambda m: loops(m, m.ideal),
    lambda m: {"coulomb_friction": {"force": 0.01 * m.blocked}}, ("Coulomb",), timed=False,
)  # fmt: skip
_too_many(
    "prestress alone, prestress and a zero of the cell stated", 20, _prestressed,
    lambda m: {"prestress": {"force": 0.02 * m.blocked}, "force_offset": {}}, ("prestress", "zero error"),
)  # fmt: skip
_too_many(
    "wall alone, wall and a linear spring stated", 20, _walled,
    lambda m: {"bladder_elasticity": {}, "linear_elasticity": {}}, ("elasticity",),
)  # fmt: skip
_too_many(
    "nothing, viscous damping stated", 40, lambda m: loops(m, m.ideal), lambda m: {"viscous_damping": {}},
    ("viscous",),
)  # fmt: skip


# bad rows


def _bad(
    what: str, build: Callable[[Muscle, np.random.Generator], tuple[Table, tuple[int, ...]]], size: int,
    rule: Rule = names_the_rows, accepted: str = "",
) -> None:  # fmt: skip
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table, rows = build(muscle, rng)
        rms = NOISE * muscle.blocked
        return _situation(
            name, seed, muscle, (text_of(table, timed=False),), what, rule, rms=rms, rows=rows,
            accepted=frozenset(accepted.split()),
        )  # fmt: skip

    _register(f"bad rows/{what}/{size} mm", make)


def _points(muscle: Muscle, rng: np.random.Generator, rows: int, deepest: float = 0.16) -> Table:
    """Single points of a map, in the order of the pressures."""
    pressure = np.repeat(np.linspace(2.0, 6.0, 6) * BAR, -(-rows // 6))[:rows]
    length = muscle.rest * (1.0 - np.tile(np.linspace(0.0, deepest, -(-rows // 6)), 6)[:rows])
    still = np.zeros(rows)
    table = Table(np.arange(rows) * 5.0, pressure, length, still.astype(int), still)
    force = muscle.ideal(pressure, length)
    return replace(table, force=force + noise_of("white", rng, NOISE * muscle.blocked, force))


def _wrong_force(rows: int, factor: float) -> Callable[[Muscle, np.random.Generator], Any]:
    def build(muscle: Muscle, rng: np.random.Generator) -> tuple[Table, tuple[int, ...]]:
        table = _points(muscle, rng, rows)
        row = int(rng.integers(3, rows - 3))
        force = table.force.copy()
        force[row] *= factor
        return replace(table, force=force), (row + 1,)

    return build


def _wrong_length(muscle: Muscle, rng: np.random.Generator) -> tuple[Table, tuple[int, ...]]:
    table = _points(muscle, rng, 30)
    row = int(rng.integers(3, 27))
    length = table.length.copy()
    length[row] -= 0.1 * muscle.rest  # a digit of the length was mistyped
    return replace(table, length=length), (row + 1,)


def _wrong_ends(muscle: Muscle, rng: np.random.Generator) -> tuple[Table, tuple[int, ...]]:
    table, _ = _measured(muscle, loops(muscle, muscle.ideal, reserve=0.08), rng)
    force = table.force.copy()
    rows = np.arange(5) * 60 + 30
    force[rows] -= 12.0 * NOISE * muscle.blocked
    return replace(table, force=force), tuple((rows + 1).tolist())


def _pushing(muscle: Muscle, rng: np.random.Generator) -> tuple[Table, tuple[int, ...]]:
    """Points beyond the shortest length, where a rod holds the muscle and pushes back less than it should."""
    table = _points(muscle, rng, 66, deepest=0.44)
    ideal = muscle.ideal(table.pressure, table.length)
    return replace(table, force=np.where(ideal < 0.0, 0.25 * ideal, ideal) + table.force - ideal), ()


_bad("one force of 17 is 1.8 times too large", _wrong_force(17, 1.8), 20)
_bad("one force of 30 is half", _wrong_force(30, 0.5), 80)
_bad("one length of 30 is 10 % short", _wrong_length, 12)
_bad("five rows at a shared reversal", _wrong_ends, 20)
_bad("negative forces beyond the shortest length", _pushing, 20, tells_of_pushing)
_bad("negative forces beyond the shortest length", _pushing, 5, tells_of_pushing)


# wrong entries


def _entry(
    what: str, size: int, accepted: str, build: Callable[[Muscle], Table],
    document: Callable[[Muscle], Muscle] = lambda m: m, *, absolute: bool = False, rule: Rule = asks_first,
    timed: bool = True,
) -> None:  # fmt: skip
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table, rms = _measured(muscle, build(muscle), rng)
        text = text_of(table, timed=timed, absolute=absolute)
        stated = document(muscle).document()
        return _situation(
            name, seed, muscle, (text,), what, rule, rms=rms, document=stated,
            accepted=frozenset(accepted.split()),
        )  # fmt: skip

    _register(f"entry/{what}/{size} mm", make)


def _ideal_loops(muscle: Muscle) -> Table:
    return loops(muscle, muscle.ideal, deepest=0.16)


for _size in (5, 40):
    _entry("rest length stated 3 % too long", _size, "rest_length nominal_length", _ideal_loops,
           lambda m: replace(m, rest=1.03 * m.rest))  # fmt: skip
for _size in (12, 80):
    _entry("braid diameter stated 5 % too large", _size, "braid_diameter", _ideal_loops,
           lambda m: replace(m, braid=1.05 * m.braid))  # fmt: skip
for _size in (20, 80):
    _entry("absolute pressure under a head without a word", _size, "absolute_pressure", _ideal_loops,
           absolute=True, timed=_size == 20)  # fmt: skip
_entry("rest length 3 % too short beside a Gent wall", 20, "rest_length nominal_length", _walled,
       lambda m: replace(m, rest=0.97 * m.rest))  # fmt: skip


# --- second round: written after the first answers were seen, and before their own


def _with_dry_and_wall(muscle: Muscle) -> tuple[Table, dict[str, dict[str, Any]]]:
    """Loops of the laws of a model with its numbers, and these."""
    wall, friction = neo_hookean(muscle, 0.3e6), 0.025 * muscle.blocked
    table = loops(muscle, lambda p, x: muscle.ideal(p, x) + wall(p, x), reserve=0.07)
    effects = {
        "bladder_elasticity": {"shear_modulus": 0.3e6},
        "coulomb_friction": {"force": friction},
    }
    return table.adding(friction * table.side), effects


def _true_model(size: int, noise: str, timed: bool) -> None:
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table, effects = _with_dry_and_wall(muscle)
        table, rms = _measured(muscle, table, rng, noise)
        truth = f"the model with its true numbers, {noise} noise"
        text = text_of(table, timed=timed)
        return _situation(name, seed, muscle, (text,), truth, nothing, rms=rms, effects=effects)

    _register(f"true model/{noise}/{size} mm/{'time' if timed else 'no time'}", make)


for _size, _noise, _timed in (
    (5, "white", True), (20, "white", False), (80, "white", False), (12, "ar09", True), (40, "ar09", False),
    (20, "quantised", False),
):  # fmt: skip
    _true_model(_size, _noise, _timed)

_NOISY = {"kind": "effect in noise"}
_effect("Coulomb friction of 4 %, ar098", 12, _RUBS, _with_dry(0.04), noise="ar098", **_NOISY)
_effect("Coulomb friction of 6 %, swinging", 80, _RUBS, _with_dry(0.06), noise="swinging", **_NOISY)
_effect("prestress of 3 %, ar09", 5, "prestress force_offset", _prestressed, noise="ar09", timed=False,
        **_NOISY)  # fmt: skip
_effect("Gent wall, ar098", 80, "bladder_elasticity linear_elasticity", _walled, noise="ar098", timed=False,
        **_NOISY)  # fmt: skip
_effect("Gent wall, quantised", 5, "bladder_elasticity linear_elasticity", _walled, noise="quantised",
        **_NOISY)  # fmt: skip
_effect("viscous damping, heteroscedastic", 40, "viscous_damping", _viscous, noise="heteroscedastic",
        **_NOISY)  # fmt: skip
_effect("frame rings, its cause", 12, "", _ringing, kind="unknown", rule=no_false_cause)
_effect("frame rings, its cause", 80, "", _ringing, kind="unknown", rule=no_false_cause, timed=False)


def _without_clock(what: str, size: int, build: Callable[[Muscle], Table], noise: str = "white") -> None:
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table, rms = _measured(muscle, build(muscle), rng, noise)
        texts = (text_of(table), text_of(table, timed=False))
        return _situation(name, seed, muscle, texts, what, one_family, rms=rms)

    _register(f"same clock/{what}/{size} mm", make)


_without_clock("Coulomb friction of 6 %", 40, _with_dry(0.06))
_without_clock("Coulomb friction of 3 %", 12, _with_dry(0.03))
_without_clock("wall and dry friction", 20, _walled_and_dry)
_without_clock("friction of crossing threads", 80, _crossing)
_without_clock("prestress of 3 %", 5, _prestressed)


def _spike(muscle: Muscle, rng: np.random.Generator) -> tuple[Table, tuple[int, ...]]:
    """A prestress, and one reading that is 60 sigma too high."""
    table, _ = _measured(muscle, _prestressed(muscle), rng)
    row = int(rng.integers(70, 230))
    force = table.force.copy()
    force[row] += 60.0 * NOISE * muscle.blocked
    return replace(table, force=force), (row + 1,)


_bad("prestress and one spike of 60 sigma in 300", _spike, 20, accepted="prestress force_offset")
_bad("prestress and one spike of 60 sigma in 300", _spike, 80, accepted="prestress force_offset")


def _gauge_head(size: int, shift: float) -> None:
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        table, rms = _measured(muscle, _ideal_loops(muscle), rng)
        text = text_of(replace(table, pressure=table.pressure + shift))
        text = text.replace("pressure [bar]", "gauge pressure [bar]", 1)
        names = frozenset({"pressure_offset", "threshold_pressure"})
        truth = f"the gauge reads {shift / BAR:g} bar too much"
        return _situation(name, seed, muscle, (text,), truth, head_is_believed, rms=rms, accepted=names)

    _register(f"entry/a head that says gauge, zero of {shift / BAR:g} bar/{size} mm", make)


_gauge_head(20, 1.0 * BAR)
_gauge_head(80, 0.3 * BAR)


# transients: a mass that hangs on the muscle, its pressure and length are read


def _drop(
    muscle: Muscle, *, mass: float, force: Callable[[float, float, float, float], float], rows: int = 1000
) -> tuple[Array, Array, Array]:
    """Time, pressure and length every 5 ms; steps of 1 ms of the rule of Runge and Kutta."""
    step = 1e-3
    levels = (2.2, 4.2, 3.0, 4.6, 2.6)

    def pressure(t: float) -> float:
        value = levels[0]
        for number in range(1, len(levels)):
            value += (levels[number] - levels[number - 1]) * 0.5 * (1.0 + np.tanh((t - number) / 0.06))
        return BAR * value

    def slopes(t: float, x: float, v: float) -> tuple[float, float]:
        return v, GRAVITY - force(t, pressure(t), x, v) / mass

    low, high = 0.65 * muscle.rest, 0.999 * muscle.thread
    for _ in range(60):  # where it hangs to begin with
        middle = 0.5 * (low + high)
        weak = force(0.0, pressure(0.0), middle, 0.0) < mass * GRAVITY
        low, high = (middle, high) if weak else (low, middle)
    x, v, out = middle, 0.0, []
    for number in range(5 * rows):
        t = number * step
        if number % 5 == 0:
            out.append((t, pressure(t), x))
        a = slopes(t, x, v)
        b = slopes(t + step / 2, x + step / 2 * a[0], v + step / 2 * a[1])
        c = slopes(t + step / 2, x + step / 2 * b[0], v + step / 2 * b[1])
        d = slopes(t + step, x + step * c[0], v + step * c[1])
        x += step / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
        v += step / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
    time, pressures, lengths = (np.array(column) for column in zip(*out, strict=True))
    return time, pressures, lengths


def _record(time: Array, pressure: Array, length: Array) -> str:
    lines = [f"{t:.6g},{1e-5 * p:.8g},{1e3 * x:.8g}" for t, p, x in zip(time, pressure, length, strict=True)]
    return "\n".join(["time [s],pressure [bar],length [mm]", *lines]) + "\n"


@dataclass(frozen=True)
class Hanging:
    """Mass and damping of the transient test of a muscle; the tension of muscle, wall and damper."""

    muscle: Muscle
    modulus: float = 0.3e6

    @property
    def mass(self) -> float:
        return float(f"{0.22 * self.muscle.blocked / GRAVITY:.3g}")

    @property
    def damping(self) -> float:
        stiffness = 6.0 * self.muscle.rest * 3.5 * BAR / (4.0 * pi * self.muscle.turns**2)
        return float(f"{0.5 * sqrt(stiffness * self.mass):.3g}")

    def tension(self, p: float, x: float, v: float) -> float:
        m = self.muscle
        ideal = p * (3.0 * x * x - m.thread**2) / (4.0 * pi * m.turns**2)
        q, along = 1.0 / tan(m.angle) ** 2, x / m.rest
        hoop = 1.0 + q * (1.0 - along * along)
        slope = 2.0 * along * (1.0 - q)
        slope -= (2.0 * along * hoop - 2.0 * q * along**3) / (along * along * hoop) ** 2
        return ideal + pi * m.braid * m.wall * self.modulus * slope + self.damping * v

    def effects(self) -> dict[str, dict[str, Any]]:
        return {
            "bladder_elasticity": {"shear_modulus": self.modulus},
            "viscous_damping": {"coefficient": self.damping},
        }


_READ = 4e-4  # noise of the length over the rest length


def _transient(
    what: str, size: int, accepted: str, rule: Rule,
    extra: Callable[[Hanging], Callable[[float, float, float, float], float]] | None = None, *,
    noise: str = "white", kind: str = "transient", known: tuple[str, ...] = (), owes: str = "",
) -> None:  # fmt: skip
    muscle = MUSCLES[size]

    def make(name: str, rng: np.random.Generator, seed: int) -> Situation:
        rig = Hanging(muscle)
        more = extra(rig) if extra else lambda t, p, x, v: 0.0
        time, pressure, length = _drop(
            muscle, mass=rig.mass, force=lambda t, p, x, v: rig.tension(p, x, v) + more(t, p, x, v)
        )
        added = noise_of(noise, rng, _READ * muscle.rest, length)
        effects = {name: values for name, values in rig.effects().items() if name not in known}
        return _situation(
            name, seed, muscle, (_record(time, pressure, length + added),), what, rule, effects=effects,
            options={"load": f"{rig.mass:g} kg"}, rms=float(np.sqrt(np.mean(added**2))),
            accepted=frozenset(accepted.split()), owes=owes or OWES[rule],
        )  # fmt: skip

    _register(f"{kind}/{what}/{size} mm/{noise}", make)


_transient("nothing hidden", 20, "", nothing)
_transient("nothing hidden", 5, "", nothing, noise="ar09")
_transient("nothing hidden", 80, "", nothing, noise="ar098")
_transient("damping alone is missing", 20, "viscous_damping", the_effect, known=("viscous_damping",))
_transient(
    "Coulomb friction of 4 % of the blocked force", 40, f"{_RUBS} guide_friction", the_effect,
    lambda rig: lambda t, p, x, v: 0.04 * rig.muscle.blocked * float(np.tanh(v / 2e-3)),
)  # fmt: skip
_transient(
    "a shaker on the load", 12, "", unknown,
    lambda rig: lambda t, p, x, v: 0.01 * rig.muscle.blocked * sin(2.0 * pi * 2.3 * t),
)  # fmt: skip


def situations(seeds: tuple[int, ...] = (0,), only: str = "") -> list[Situation]:
    """All whose name contains a text."""
    return [make(seed) for seed in seeds for name, make in _MAKERS.items() if only in name]


# --- intervals of fitted constants


@dataclass(frozen=True)
class Sample:
    """A file of the right model whose constants are fitted; ``constants``: (effect, parameter) -> truth."""

    text: str
    muscle: dict[str, Any]
    effects: dict[str, dict[str, Any]]
    options: dict[str, Any]
    constants: dict[tuple[str, str], float]


def sample(noise: str, seed: int, *, timed: bool = True) -> Sample:
    """Loops of 300 rows with a neo-Hookean wall, a prestress and ideal dry friction."""
    muscle = MUSCLES[(12, 20, 40)[seed % 3]]
    modulus, prestress, friction = 0.3e6, 0.02 * muscle.blocked, 0.025 * muscle.blocked
    wall = neo_hookean(muscle, modulus)
    table = loops(muscle, lambda p, x: muscle.ideal(p, x) + wall(p, x) - prestress, reserve=0.07)
    table = table.adding(friction * table.side)
    table, _ = _measured(muscle, table, _rng(f"interval {noise} {timed}", seed), noise)
    constants = {
        ("bladder_elasticity", "shear_modulus"): modulus,
        ("prestress", "force"): prestress,
        ("coulomb_friction", "force"): friction,
    }
    effects = {effect: {name: 0.8 * value} for (effect, name), value in constants.items()}
    document = muscle.document()
    options = {"rest_length": document["nominal_length"]}
    return Sample(text_of(table, timed=timed), document, effects, options, constants)


def transient_sample(noise: str, seed: int) -> Sample:
    """A run of 1000 rows with a wall and a damper."""
    rig = Hanging(MUSCLES[(12, 20, 40)[seed % 3]])
    time, pressure, length = _drop(rig.muscle, mass=rig.mass, force=lambda _, p, x, v: rig.tension(p, x, v))
    rng = _rng(f"interval transient {noise}", seed)
    added = noise_of(noise, rng, _READ * rig.muscle.rest, length)
    constants = {
        ("bladder_elasticity", "shear_modulus"): rig.modulus,
        ("viscous_damping", "coefficient"): rig.damping,
    }
    effects = {effect: {name: 0.8 * value} for (effect, name), value in constants.items()}
    document = rig.muscle.document()
    options = {"rest_length": document["nominal_length"], "load": f"{rig.mass:g} kg"}
    return Sample(_record(time, pressure, length + added), document, effects, options, constants)
