"""Nothing is missing, but the noise is a laboratory's: how often a diagnosis still says "adequate".

    python -m tests.benchmarks.nulls [--each 100] [--first 0] [--noise white] [--keep FILE]

Muscles, rigs, numbers of rows and noise are drawn anew for each case: loops at held pressures, whole and
nested, with rests, loops and steps of the pressure at held lengths, pressure cycles under loads, grids and
scattered points; half of them beside a known wall. An alarm is every verdict but "adequate", every effect
named and every right entry doubted.

On 26 November 2026, ``--each 100 --first 5000``, cases that nobody had looked at, 0.24 s of processor time in
the median, alarms and upper 95 % bound:

| noise | alarms | bound | wanted |
|---|---|---|---|
| white | 0 of 100 | 3.0 % | 3 % |
| correlated, AR(1) with 0.4 to 0.9 | 2 of 100 | 6.2 % | 10 % |
| spikes, heavy tails, growing with the force | 0 of 100 | 3.0 % | 10 % |
| coarse digits | 1 of 100 | 4.7 % | 10 % |
| noise of the inputs | 0 of 100 | 3.0 % | 10 % |
| all | 3 of 500 | 1.5 % | |

The same day, with richer laws of friction and ``--first 7000``: 0, 4, 0, 1 and 0 of 100, 5 of 500 in all; a
day later, ``--first 9000``: 0, 3, 0, 0 and 0 of 100, 3 of 500. On
24 and 25 November, other cases: 0, 4, 0, 2 and 0 of 100. Before that, correlated 6 and noise of the inputs
8 of 100: what neighbours in pressure and length predict was called unknown although no other curve shows it,
and noise of the pressure a lag of the force, which averages it.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any
from zlib import crc32

import numpy as np

from tests.benchmarks.diagnosis import say
from tests.benchmarks.entries import parts_of
from tests.benchmarks.workers import Examined, add_keep, examined, other_code, own_studio
from tests.truth.cases import Case
from tests.truth.composition import Record, Truth
from tests.truth.elastic_cases import known_wall
from tests.truth.experiments import held, isobaric, isometric, pressure_cycles, scattered
from tests.truth.laboratory import case_of
from tests.truth.muscle import Muscle, made

# --- rigs: each draws its levels, speeds and number of rows


def _levels(random: np.random.Generator, low: float = 1e5) -> list[float]:
    return np.linspace(random.uniform(low, 2.5e5), random.uniform(4e5, 7e5), random.integers(3, 7)).tolist()


def _contractions(random: np.random.Generator) -> list[float]:
    return np.linspace(0.0, random.uniform(0.12, 0.2), random.integers(3, 7)).tolist()


def _loops(truth: Truth, random: np.random.Generator) -> Record:
    speeds = (0.003, 0.03) if random.random() < 0.5 else (float(random.uniform(0.002, 0.02)),)
    return isobaric(truth, levels=_levels(random), speeds=speeds, rows=int(random.integers(16, 160)))


def _nested(truth: Truth, random: np.random.Generator) -> Record:
    turns = (1.0, float(random.uniform(0.3, 0.7)), 1.0, 0.0)
    return isobaric(truth, levels=_levels(random), turns=turns, rows=int(random.integers(40, 200)))


def _rests(truth: Truth, random: np.random.Generator) -> Record:
    stops = [0.01, *np.sort(random.uniform(0.03, 0.18, 3)).tolist(), 0.02]
    return held(truth, levels=_levels(random)[:3], stops=stops, speed=0.01, hold=float(random.uniform(5, 30)))


def _clamped(truth: Truth, random: np.random.Generator) -> Record:
    rows = int(random.integers(16, 140))
    return isometric(
        truth, contractions=_contractions(random), rates=(float(random.uniform(2e4, 2e5)),), rows=rows
    )


def _steps(truth: Truth, random: np.random.Generator) -> Record:
    rows = int(random.integers(40, 160))
    return isometric(
        truth, contractions=_contractions(random), steps=float(random.uniform(0.1, 0.5)), rows=rows
    )


def _lifts(truth: Truth, random: np.random.Generator) -> Record:
    loads = [
        float(share) * truth.muscle.blocked for share in random.uniform(0.05, 0.3, random.integers(1, 4))
    ]
    return pressure_cycles(low=2e5, high=6e5, loads=loads, rows=int(random.integers(50, 260)))


def _map(truth: Truth, random: np.random.Generator, *, scatter: bool = False) -> Record:
    levels = np.linspace(0.5e5, 6e5, random.integers(5, 13)).tolist()
    contractions = np.linspace(0.0, 0.25, random.integers(8, 37)).tolist()
    return scattered(truth, random, levels=levels, contractions=contractions, scatter=scatter)


def _scattered(truth: Truth, random: np.random.Generator) -> Record:
    return _map(truth, random, scatter=True)


#: Rig -> its record, the kind of measurement, and whether the start model has a wall.
RIGS: dict[str, tuple[Callable[[Truth, np.random.Generator], Record], str, bool]] = {
    "loops": (_loops, "isobaric", False),
    "nested loops": (_nested, "isobaric", True),
    "rests": (_rests, "isobaric", False),
    "clamped": (_clamped, "isometric", True),
    "clamped, steps": (_steps, "isometric", False),
    "lifts": (_lifts, "isotonic", False),
    "map": (_map, "static", True),
    "scattered map": (_scattered, "static", False),
}


def null(rig: str, seed: int) -> Case:
    """A measurement in which nothing is missing."""
    random = np.random.default_rng([crc32(f"null {rig}".encode()), seed])
    muscle: Muscle = made(
        int(random.choice([10, 20, 40])), random, length=round(float(random.uniform(0.12, 0.6)), 3)
    )
    record_of, kind, walled = RIGS[rig]
    effects, known = known_wall(muscle, float(random.uniform(0.1e6, 0.5e6))) if walled else ({}, ())
    truth = Truth(muscle, known=known)
    return case_of(f"null, {rig}", seed, truth, record_of(truth, random), kind, random, effects=effects)


# --- noises


def _white(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    return sigma * random.standard_normal(len(clean))


def _spikes(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    hit = random.random(len(clean)) < 0.02
    return _white(random, clean, sigma) + np.where(
        hit, 15.0 * sigma * random.standard_normal(len(clean)), 0.0
    )


def _students(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    return sigma * random.standard_t(3, len(clean)) / np.sqrt(3.0)


def _growing(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    share = np.abs(clean) / np.max(np.abs(clean))
    return sigma * (0.2 + 3.0 * share) * random.standard_normal(len(clean))


def _correlated(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    keeps = random.uniform(0.4, 0.9)
    noise, last = np.empty(len(clean)), 0.0
    for row, new in enumerate(random.standard_normal(len(clean))):
        last = keeps * last + np.sqrt(1.0 - keeps**2) * new
        noise[row] = sigma * last
    return noise


def _coarse(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    step = 4.0 * sigma
    return np.round((clean + 0.3 * _white(random, clean, sigma)) / step) * step - clean


NOISES: dict[str, Callable[[np.random.Generator, np.ndarray, float], np.ndarray]] = {
    "white": _white,
    "spikes": _spikes,
    "heavy tails": _students,
    "grows with force": _growing,
    "correlated": _correlated,
    "coarse digits": _coarse,
}
INPUTS = {"pressure noise": ("pressure", 1500.0), "length noise": ("stroke", 5e-5)}


#: What was promised: words, noises, largest share of alarms.
PROMISES = (
    ("white", ("white",), 0.03),
    ("correlated", ("correlated",), 0.10),
    ("spikes, heavy tails, growing", ("spikes", "heavy tails", "grows with force"), 0.10),
    ("coarse digits", ("coarse digits",), 0.10),
    ("noise of the inputs", tuple(INPUTS), 0.10),
)


@dataclass(frozen=True)
class Line:
    """What became of one case; errors over the noise that the diagnosis estimates."""

    rig: str
    noise: str
    seed: int
    rows: int
    status: str = ""
    named: tuple[str, ...] = ()
    doubted: tuple[str, ...] = ()
    error: float = float("nan")
    structure: float = float("nan")
    problem: str = ""

    @property
    def alarm(self) -> bool:
        """Whether something is said to be missing or wrong."""
        return self.status != "adequate" or bool(self.named or self.doubted)


def judged(asked: tuple[str, str, int]) -> Line:
    """The verdict for one rig, noise and seed."""
    from mckibben.identification.diagnose.diagnosis import diagnose
    from mckibben.identification.diagnose.entries import read_otherwise, statements
    from mckibben.identification.predict import predictor_of

    rig, noise, seed = asked
    case = null(rig, seed)
    predictor, start, measurement, _, _ = parts_of(case, own_studio())
    random = np.random.default_rng([seed, crc32(f"{rig} {noise}".encode())])
    (channel,) = predictor.channels
    name = channel.name
    if name == "length":
        name = next(n for n in ("length", "contraction", "displacement") if n in measurement.columns)
    columns: dict[str, Any] = dict(measurement.columns)
    unit = 1.0
    if channel.name == "length" and name != "length":
        unit = -1.0 if name == "displacement" else -1.0 / start.muscle.nominal_length
    clean, sigma = next(iter(case.clean.values())), next(iter(case.noise.values()))
    without = columns[name] - unit * (next(iter(case.measured.values())) - clean)
    columns[name] = without + unit * _drawn(noise, random, clean, sigma, predictor.inputs)
    if noise in INPUTS:
        what, size = INPUTS[noise]
        strokes = [n for n in ("length", "contraction", "displacement") if n in columns]
        for each in strokes if what == "stroke" else [what]:
            scale = 1.0 / start.muscle.nominal_length if each == "contraction" else 1.0
            columns[each] = columns[each] + scale * size * random.standard_normal(len(without))
    changed = replace(measurement, columns=MappingProxyType(columns))

    def again(readings: Any) -> Any:
        return predictor_of(read_otherwise(changed, readings), start.muscle)

    line = Line(rig, noise, seed, len(without))
    try:
        result = diagnose(
            again(()),
            start,
            catalogue=own_studio().catalogue,
            statements=statements(changed, start, again, elastic=own_studio().catalogue.values()),
        )
    except Exception as error:  # a case that breaks is a line of the table, not its end
        return replace(line, problem=f"{type(error).__name__}: {error}"[:90])
    return replace(
        line,
        status=result.status,
        named=result.added,
        doubted=tuple(each.entry.hypothesis for each in result.context if each.stands),
        error=float("nan") if result.noise is None else result.best.rmse / result.noise,
        structure=0.0 if result.judgement is None else result.judgement.predictable,
    )


def _drawn(
    noise: str, random: np.random.Generator, clean: np.ndarray, sigma: float, inputs: Any
) -> np.ndarray:
    """Noise of each row; correlated along the order of measuring, which the rows of a map do not have."""
    drawn = NOISES.get(noise, _white)(random, clean, sigma)
    if noise != "correlated" or "time" in inputs:
        return drawn
    order = np.lexsort((inputs["length"], np.round(inputs["pressure"], -4)))
    along = np.empty_like(drawn)
    along[order] = drawn
    return along


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--each", type=int, default=100, help="cases of each group of noises")
    parser.add_argument("--first", type=int, default=0, help="number of the first case: other draws")
    parser.add_argument("--noise", default="", help="part of the name of a noise")
    parser.add_argument("--rig", default="", help="part of the name of a rig")
    add_keep(parser)
    options = parser.parse_args()
    rigs = tuple(RIGS)
    todo = [
        (rigs[number % len(rigs)], noises[(number // len(rigs)) % len(noises)], number)
        for _, noises, _ in PROMISES
        for number in range(options.first, options.first + options.each)
    ]
    todo = [each for each in todo if options.noise in each[1] and options.rig in each[0]]
    lines: list[Examined[Line]] = []
    for line in examined(judged, todo, key=_key, keep=options.keep):
        lines.append(line)
        say(text_of(line))
    for text in summary(lines):
        say(text)


def _key(asked: tuple[str, str, int]) -> str:
    return " ".join(map(str, asked))


def text_of(examined_line: Examined[Line]) -> str:
    """A line of the table."""
    line = examined_line.result
    parts = [
        f"{'--' if line.alarm or line.problem else 'ok'} {line.rig:16}{line.noise:18}{line.seed:3d}",
        f"{line.rows:5d} rows {examined_line.seconds:5.1f} s  {line.status:16}{line.error:5.2f} x noise",
        f"structure {line.structure:.2f}",
        ", ".join((*line.named, *(f"doubted: {entry}" for entry in line.doubted))),
        line.problem,
    ]
    return "  ".join(part for part in parts if part)


def summary(examined_lines: Sequence[Examined[Line]]) -> list[str]:
    """Alarms of each group of noises, with the upper bound."""
    lines = [line.result for line in examined_lines]
    texts = [""]
    for words, noises, wanted in PROMISES:
        group = [line for line in lines if line.noise in noises]
        if group:
            texts.append(f"{_share(words, group)}, wanted {100.0 * wanted:.0f} %")
            texts += [
                _share(f"  {noise}", part)
                for noise in noises
                if len(noises) > 1 and (part := [line for line in group if line.noise == noise])
            ]
    texts.append(_share("all", lines))
    texts += [
        _share(f"  {rig}", part) for rig in RIGS if (part := [line for line in lines if line.rig == rig])
    ]
    seconds = sorted(line.seconds for line in examined_lines)
    if seconds:
        texts.append(
            f"processor time: median {seconds[len(seconds) // 2]:.2f} s, longest {seconds[-1]:.1f} s; "
            f"{sum(bool(line.problem) for line in lines)} cases broke"
        )
    return [*texts, *filter(None, [other_code(examined_lines)])]


def _share(words: str, lines: Sequence[Line]) -> str:
    wrong = sum(line.alarm for line in lines)
    bound = upper_bound(wrong, len(lines))
    return (
        f"{words:30}{wrong:3d} of {len(lines):3d}, {wrong / len(lines):5.1%}, upper 95 % bound {bound:5.1%}"
    )


def upper_bound(wrong: int, of: int) -> float:
    """Upper end of the one-sided 95 % interval of a share, after Clopper and Pearson."""
    from scipy.stats import beta

    return 1.0 if wrong == of else float(beta.ppf(0.95, wrong + 1, of - wrong))


if __name__ == "__main__":
    main()
