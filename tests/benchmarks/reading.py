"""How files that somebody else has indexed are read.

    python -m tests.benchmarks.reading [--group corpus,strangers,failing] [--only TEXT] [--list wrong]

Groups: *corpus*, the files of laboratories' exporters beside this checkout, and *strangers*, the sets of
`tests/measurement/reading/strangers`, both judged by their index; *failing*, beside this checkout, judged by
`FAILING` below. A verdict is

right     the same channels, values, rows, kind and conditions as the truth
asked     a question names what differs
useful    refused, with a hint
poor      refused without a hint
part      a channel or a condition is missing, and nothing asks about it; all that is read is right
wrong     something differs from the truth and nothing asks
crashed   an exception that is no refusal
"""

from __future__ import annotations

import argparse
import contextlib
import json
import re
import sys
import time
import traceback
import zipfile
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.question import Question
from mckibben.measurement.reading import Correction, decide, preview_here, questions, read_here
from mckibben.physics.errors import InputError
from tests.benchmarks.formats import AS_PRINTED, _examined

ROOT = Path(__file__).parents[2]
SHARED = Path(__file__).parents[3] / "shared" / "data"
VERDICTS = ("right", "asked", "useful", "poor", "part", "wrong", "crashed")
GROUPS = ("corpus", "strangers", "failing")
#: Sets of strangers whose truths of absolute pressures are less the surrounding air.
GAUGE_TRUTHS = ("loggers", "machines", "notebooks")
#: File -> what must come of it: (kind, rows, channel -> (smallest, largest) in SI, words that a question must
#: name).
FAILING: Mapping[str, tuple[str, int, Mapping[str, tuple[float, float]], tuple[str, ...]]] = {
    "length_that_is_a_stroke.csv": ("", 0, {}, ("Pressure", "Length")),
    "wide_paper_table.csv": ("isotonic", 100, {"pressure": (0.0, 6e5), "displacement": (0.0, 0.0152)}, ()),
    "joint_with_moment_arm.csv": (
        "",
        17,
        {"pressure": (276.7e3, 612.6e3), "length": (0.3385, 0.401), "force": (26.507, 621.0)},
        (),
    ),
    "step_response.csv": ("", 600, {"pressure": (-2300.0, 6.008e5)}, ("U_valve",)),
    "Kraftkennfeld_DMSP20_250.xlsx": (
        "isobaric",
        360,
        {"pressure": (1e5, 6e5), "displacement": (0.0, 0.05)},
        (),
    ),
    "pushing_forces.csv": ("", 58, {"pressure": (0.0, 6e5), "contraction": (-0.04, 0.25)}, ()),
}


@dataclass(frozen=True)
class Case:
    """One file, with its entry of an index."""

    group: str
    name: str
    data: bytes = field(repr=False)
    entry: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class Answer:
    """What a reader says: a measurement or a refusal, the questions, or the trace of a crash."""

    measurement: Measurement | None = None
    refusal: str = ""
    hint: str = ""
    questions: tuple[Question, ...] = ()
    crash: str = ""
    seconds: float = 0.0

    @property
    def asks(self) -> str:
        """All that is asked or refused, as one text."""
        return " ".join(f"{q.about} {q.text} {q.option}" for q in self.questions) + " " + self.refusal


def answer(case: Case) -> Answer:
    """Read one file."""
    start = time.process_time()
    questions: tuple[Question, ...] = ()
    try:
        try:
            found = read_here(case.data, case.name, Correction())
            return Answer(found, questions=found.questions, seconds=time.process_time() - start)
        except InputError as error:
            refusal, hint = error.message, str(error.hint or "")
            seconds = time.process_time() - start
            with contextlib.suppress(InputError):
                questions = preview_here(case.data, case.name).questions
            return Answer(None, refusal, hint, questions, seconds=seconds)
    except Exception:
        return Answer(crash=traceback.format_exc(), seconds=time.process_time() - start)


def of_corpus(case: Case, new: Answer) -> tuple[str, str]:
    """(verdict, why) by the index of the corpus."""
    assert case.entry is not None
    if new.crash:
        return "crashed", new.crash.strip().splitlines()[-1]
    open_items = [
        i["about"] for i in case.entry["ask"] if not all(re.search(w, new.asks) for w in i["words"])
    ]
    if new.measurement is None:
        if case.entry["ask"] and not open_items:
            return "asked", new.refusal
        return ("asked" if new.questions else "useful" if new.hint else "poor"), new.refusal
    wrong, missing = _examined(case.entry, new.measurement)
    wrong += [f"guessed, not asked: {about}" for about in open_items]
    if wrong:
        return "wrong", "; ".join(wrong)
    return ("part", "; ".join(missing)) if missing else ("asked" if case.entry["ask"] else "right", "")


def of_failing(case: Case, new: Answer) -> tuple[str, str]:
    """(verdict, why) by `FAILING`."""
    kind, rows, channels, words = FAILING[case.name]
    if new.crash:
        return "crashed", new.crash.strip().splitlines()[-1]
    unasked = [w for w in words if w not in new.asks]
    if new.measurement is None:
        return ("asked" if new.questions and not unasked else "useful" if new.hint else "poor"), new.refusal
    found = new.measurement
    wrong = [f"not asked: {w}" for w in unasked]
    wrong += [f"kind {found.kind}"] if kind and kind != found.kind else []
    wrong += [f"{found.rows} rows"] if rows and rows != found.rows else []
    for channel, (low, high) in channels.items():
        values = found.columns.get(channel)
        if values is None:
            wrong.append(f"{channel} not read")
        elif abs(values.min() - low) > 0.02 * (high - low) or abs(values.max() - high) > 0.02 * (high - low):
            wrong.append(f"{channel} {values.min():.5g} to {values.max():.5g}")
    return ("wrong", "; ".join(wrong)) if wrong else ("asked" if words else "right", "")


def cases(groups: Sequence[str], only: str) -> Iterator[Case]:
    """The files of some groups."""
    makers = dict(zip(GROUPS, (_corpus, _strangers, _failing), strict=True))
    for group in groups:
        for case in makers[group]():
            if only in case.name or only in f"{case.group}/{case.name}":
                yield case


def _corpus() -> Iterator[Case]:
    index = SHARED / "lab-formats" / "index.json"
    if not index.exists():
        say("corpus skipped: ../shared/data/lab-formats is not there")
        return
    for entry in json.loads(index.read_text(encoding="utf-8"))["files"]:
        yield Case(
            "corpus", Path(entry["file"]).name, (index.parent / entry["file"]).read_bytes(), entry=entry
        )


def _strangers() -> Iterator[Case]:
    for place in sorted((ROOT / "tests" / "measurement" / "reading" / "strangers").glob("*.zip")):
        with zipfile.ZipFile(place) as archive:
            names = {Path(name).name: name for name in archive.namelist() if not name.endswith("/")}
            for entry in json.loads(archive.read(names["index.json"]))["files"]:
                entry[AS_PRINTED] = place.stem not in GAUGE_TRUTHS
                name = Path(entry["file"]).name
                yield Case(f"strangers {place.stem}", name, archive.read(names[name]), entry=entry)


def _failing() -> Iterator[Case]:
    for path in sorted((SHARED / "failing").glob("*")):
        if path.name in FAILING:
            yield Case("failing", path.name, path.read_bytes())


#: Weights of the decision; the rules have theirs in `rules.toml`.
WEIGHTS = ("MARGIN", "GAUGE", "_PULL", "_SHORTER", "_NO_WORDS", "_RANK", "_UNFIT", "_MASS", "_UNREAD")


def sensitivity(groups: Sequence[str], only: str) -> None:
    """Print how the verdicts change with each weight at half and at double its value."""
    chosen = [case for case in cases(groups, only) if case.entry is not None]

    def verdicts() -> Counter[str]:
        return Counter(of_corpus(case, answer(case))[0] for case in chosen)

    say(f"{'as it is':16}{dict(verdicts())}")
    for name in WEIGHTS:
        value = getattr(decide, name)
        for factor in (0.5, 2.0):
            for module in (decide, questions):
                if hasattr(module, name):
                    setattr(module, name, factor * value)
            say(f"{name:10}{factor * value:6.2f}{dict(verdicts())}")
        for module in (decide, questions):
            if hasattr(module, name):
                setattr(module, name, value)


def say(text: str) -> None:
    """Print a line at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def main() -> None:
    """Print the table and the list."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--group", default=",".join(GROUPS))
    parser.add_argument("--only", default="")
    parser.add_argument("--list", default=",".join(VERDICTS[1:]), help="verdicts whose files are listed")
    parser.add_argument("--trace", action="store_true", help="print the traces of crashes")
    parser.add_argument("--save", help="folder into which the listed files are written")
    parser.add_argument(
        "--sensitivity",
        action="store_true",
        help="the counts with each weight of the decision halved and doubled",
    )
    given = parser.parse_args()
    if given.sensitivity:
        sensitivity(given.group.split(","), given.only)
        return
    counts: Counter[tuple[str, str]] = Counter()
    seconds: defaultdict[str, float] = defaultdict(float)
    for case in cases(given.group.split(","), given.only):
        found = answer(case)
        verdict, why = of_failing(case, found) if case.entry is None else of_corpus(case, found)
        counts[case.group, verdict] += 1
        seconds[case.group] += found.seconds
        if verdict in given.list.split(","):
            say(f"{verdict:8} {case.group} {case.name}: {why[:260]}")
            if given.trace and found.crash:
                say(found.crash)
            if given.save:
                (Path(given.save) / case.name.replace("/", "_")).write_bytes(case.data)
    say("\n" + " ".join([f"{'':20}", *(f"{v:>8}" for v in VERDICTS), "       s"]))
    for group in sorted(seconds):
        row = [f"{counts[group, v]:8}" for v in VERDICTS]
        say(" ".join([f"{group:20}", *row, f"{seconds[group]:8.1f}"]))


if __name__ == "__main__":
    main()
