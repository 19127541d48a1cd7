"""The old reader beside the new one, over the same files.

    python -m tests.benchmarks.reading [--group corpus,failing,labs,tests] [--only TEXT] [--list wrong]

Groups: *corpus*, the files of laboratories' exporters beside this checkout, and *strangers*, the sets of
`tests/measurement/reading/strangers`, both judged by their index; *failing* and *data*, beside this checkout,
the first judged by `FAILING` below, the second by the old reader; *labs*, all files of `tests/laboratories`
with what their users type; *tests*, what the tests of the old reader give it, gathered by running them once.
For the last three the old reader's answer is the truth. A verdict of the new reader is

right     the same channels, values, rows, kind and conditions as the truth
asked     a question names what differs, or both ask
useful    refused, with a hint, where the truth refuses too, or with the obstacle named
poor      refused where the truth reads, or without a hint
part      a channel or a condition is missing, and nothing asks about it; all that is read is right
wrong     something differs from the truth and nothing asks
bold      read without a question where the truth refuses or asks
crashed   an exception that is no refusal
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import pickle
import re
import sys
import tempfile
import time
import traceback
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mckibben.measurement import reading as new_reader
from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES, Measurement
from mckibben.measurement.question import Question
from mckibben.measurement.read import _read_here as read_old
from mckibben.measurement.read.correction import Correction, spoken_correction
from mckibben.measurement.read.preview import preview_here as preview_old
from mckibben.physics.errors import InputError

ROOT = Path(__file__).parents[2]
SHARED = Path(__file__).parents[3] / "shared" / "data"
VERDICTS = ("right", "asked", "useful", "poor", "part", "wrong", "bold", "crashed")
CONDITIONS = (
    "nominal_length",
    "load_mass",
    "load_force",
    "supply_pressure",
    "force_zero",
    "ambient_pressure",
)
SAME = 1e-6  # of the largest value of a channel

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
    """One file with what its user says."""

    group: str
    name: str
    data: bytes = field(repr=False)
    correction: Correction = field(default_factory=Correction)
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


def answer(reader: Callable[..., Measurement], look: Callable[..., Any], case: Case) -> Answer:
    """Read one file with one reader."""
    start = time.process_time()
    questions: tuple[Question, ...] = ()
    try:
        try:
            found = reader(case.data, case.name, case.correction)
            return Answer(found, questions=found.questions, seconds=time.process_time() - start)
        except InputError as error:
            refusal, hint = error.message, str(error.hint or "")
            seconds = time.process_time() - start
            with contextlib.suppress(InputError):
                questions = look(case.data, case.name, case.correction).questions
            return Answer(None, refusal, hint, questions, seconds=seconds)
    except Exception:
        return Answer(crash=traceback.format_exc(), seconds=time.process_time() - start)


def differences(
    truth: Measurement, found: Measurement
) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """((subject, text) of what is wrong, of what is missing)."""
    wrong, missing = [], []
    if truth.kind != found.kind:
        wrong.append(("kind", f"kind {found.kind}, not {truth.kind}"))
    if truth.rows != found.rows:
        wrong.append(("rows", f"{found.rows} rows, not {truth.rows}"))
    a, b = _length(truth), _length(found)
    same_stroke = (
        a is not None
        and b is not None
        and len(a) == len(b)
        and np.allclose(a, b, rtol=0.0, atol=SAME * np.max(np.abs(a)))
    )
    for channel in CHANNEL_UNITS:
        if channel in ("group", "direction") or (same_stroke and channel in STROKES):
            continue
        if channel not in truth.columns:
            if channel in found.columns and channel not in ("time", "temperature", "velocity", "diameter"):
                wrong.append((channel, f"a {channel} that is not there"))
            continue
        if channel not in found.columns:
            missing.append((channel, f"{channel} not read"))
            continue
        if truth.rows == found.rows:
            a, b = np.asarray(truth.columns[channel]), np.asarray(found.columns[channel])
            if truth.kind == "static" and "time" not in truth.columns:
                a, b = a[_sorted(truth)], b[_sorted(found)]  # the order of a map says nothing
            if channel == "time":
                a, b = a - a.min(), b - b.min()
            if not np.allclose(a, b, rtol=0.0, atol=SAME * max(float(np.max(np.abs(a))), 1e-12)):
                wrong.append(
                    (channel, f"{channel} {b.min():.5g} to {b.max():.5g}, not {a.min():.5g} to {a.max():.5g}")
                )
    for key in CONDITIONS:
        mine, theirs = found.conditions.get(key), truth.conditions.get(key)
        if key in ("load_mass", "load_force") and "force" in truth.columns and truth.kind != "transient":
            continue
        if theirs is None and isinstance(mine, float) and key in ("nominal_length", "load_mass"):
            wrong.append((key, f"{key} {mine:.5g} that is not there"))
        elif isinstance(theirs, float) and (
            not isinstance(mine, float) or abs(mine - theirs) > 1e-6 * abs(theirs)
        ):
            (missing if mine is None else wrong).append((key, f"{key} {mine!r}, not {theirs!r}"))
    return wrong, missing


def _length(read: Measurement) -> np.ndarray | None:
    """The length of the muscle, whatever form of the stroke is read; None where it does not follow."""
    rest = read.conditions.get("nominal_length")
    if "length" in read.columns:
        return np.asarray(read.columns["length"])
    if "displacement" in read.columns and isinstance(rest, float):
        return rest - np.asarray(read.columns["displacement"])
    return None


def _sorted(read: Measurement) -> np.ndarray:
    """The order of rows by all channels."""
    keys = [
        np.round(np.asarray(read.columns[c], float), 9)
        for c in ("force", *STROKES, "pressure")
        if c in read.columns
    ]
    return np.lexsort(keys)


_SUBJECTS = {"nominal_length": "rest", "load_mass": "load", "load_force": "load",
             "displacement": "stroke", "length": "stroke",
             "contraction": "stroke", "supply_pressure": "supply"}  # fmt: skip


def named_in(subject: str, text: str, truth: Measurement, found: Measurement) -> bool:
    """Whether a question names a subject: the channel, its condition, or the column it is read from."""
    words = [subject, _SUBJECTS.get(subject, subject)]
    if _SUBJECTS.get(subject) == "stroke":
        words += STROKES
    words += [c.column for m in (truth, found) for c in m.channels if c.name == subject and len(c.column) > 1]
    return any(word and word.casefold() in text.casefold() for word in words)


def judged(truth: Answer, new: Answer) -> tuple[str, str]:
    """(verdict, why) of the new reader where the old one is the truth."""
    if new.crash:
        return "crashed", new.crash.strip().splitlines()[-1]
    if truth.measurement is None:
        if new.measurement is None:
            return ("useful" if new.hint or new.questions else "poor"), new.refusal
        named = bool(new.questions)
        return (
            "asked" if named else "bold"
        ), f"read as {new.measurement.kind}; the truth: {truth.refusal[:150]}"
    if new.measurement is None:
        if new.questions:
            return "asked", new.refusal
        return "poor", new.refusal
    wrong, missing = differences(truth.measurement, new.measurement)
    if not wrong and not missing:
        return "right", ""
    unsaid = [t for s, t in wrong if not named_in(s, new.asks, truth.measurement, new.measurement)]
    unsaid_missing = [t for s, t in missing if not named_in(s, new.asks, truth.measurement, new.measurement)]
    why = "; ".join(t for _, t in wrong + missing)
    if not unsaid and not unsaid_missing:
        return "asked", why
    causes = [s for s, _ in wrong + missing if s not in ("kind", "rows")]
    if set(unsaid) <= {t for s, t in wrong if s == "kind"} and causes and not unsaid_missing:
        return "asked", why  # the kind follows from what is asked
    return ("part" if not wrong else "wrong"), why


def of_corpus(case: Case, new: Answer) -> tuple[str, str]:
    """(verdict, why) by the index of the corpus."""
    from tests.benchmarks.formats import _examined

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
    makers = {
        "corpus": _corpus, "strangers": _strangers, "failing": _failing, "data": _data, "labs": _labs,
        "tests": _tests,
    }  # fmt: skip
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
                name = Path(entry["file"]).name
                yield Case(f"strangers {place.stem}", name, archive.read(names[name]), entry=entry)


def _failing() -> Iterator[Case]:
    for path in sorted((SHARED / "failing").glob("*")):
        if path.suffix in (".csv", ".xlsx"):
            yield Case("failing", path.name, path.read_bytes())


def _data() -> Iterator[Case]:
    for path in sorted(SHARED.glob("*.csv")) + sorted(SHARED.glob("*.TXT")):
        yield Case("data", path.name, path.read_bytes())


def _labs() -> Iterator[Case]:
    for place in sorted((ROOT / "tests" / "laboratories").glob("*.zip")):
        with zipfile.ZipFile(place) as archive:
            names = archive.namelist()
            for lab in sorted({n.partition("/")[0] for n in names if n.endswith("user.json")}):
                user = json.loads(archive.read(f"{lab}/user.json"))
                for part, key in (("files", "arguments"), ("second", "second_arguments")):
                    files = sorted(n for n in names if n.startswith(f"{lab}/{part}/") and not n.endswith("/"))
                    for file in files:
                        beside = tuple(f for f in files if f != file)
                        said = typed(user[key], beside)
                        name = file.rpartition("/")[2]
                        yield Case(f"labs {place.stem}/{lab}", name, archive.read(file), said)


def typed(arguments: Sequence[str], beside: tuple[str, ...]) -> Correction:
    """The correction that options of the command line make."""
    from dataclasses import replace

    said: dict[str, Any] = {"columns": [], "ignore": []}
    experiment: dict[str, Any] = {}
    for option, value in zip(arguments[::2], arguments[1::2], strict=False):
        match option:
            case "--column":
                said["columns"].append(value)
            case "--ignore":
                said["ignore"].append(value)
            case "--rest-length":
                said["rest_length"] = value
            case "--head":
                said["head"] = int(value)
            case "--load" | "--supply" | "--sheet":
                said[option[2:]] = value
            case "--experiment":
                key, _, text = value.partition("=")
                experiment[key] = text
            case _:
                pass
    from mckibben.measurement.read.conditions import condition_value

    more = {k: condition_value(k, v, where=k, field=k) for k, v in experiment.items()}
    correction = spoken_correction(**said)
    return replace(correction, beside=beside, conditions={**correction.conditions, **more})


class _Recorder:
    """A pytest plugin that keeps what the tests give the old reader."""

    def __init__(self) -> None:
        self.kept: dict[str, tuple[str, bytes, Correction]] = {}

    def keep(self, data: bytes, name: str, correction: Correction | None) -> None:
        """Keep a small file once."""
        correction = correction or Correction()
        if len(data) < 300_000:
            key = hashlib.sha256(data + name.encode() + correction.canonical().encode()).hexdigest()
            self.kept.setdefault(key, (name, data, correction))

    def pytest_sessionstart(self) -> None:
        """Put the recorder before the reader."""
        from mckibben.measurement import read

        inner_read, inner_preview = read._read_here, read.preview_here

        def reading(data: bytes, name: str, correction: Correction) -> Measurement:
            self.keep(data, name, correction)
            return inner_read(data, name, correction)

        def previewing(data: bytes, name: str, correction: Correction | None = None) -> Any:
            self.keep(data, name, correction)
            return inner_preview(data, name, correction)

        read._read_here, read.preview_here = reading, previewing  # type: ignore[assignment]


def _tests() -> Iterator[Case]:
    kept = Path(tempfile.gettempdir()) / "mckibben-reading-tests.pickle"  # by our own process, below
    if not kept.exists():
        import pytest

        recorder = _Recorder()
        pytest.main(
            [
                "-q",
                "-x",
                "--no-header",
                "-p",
                "no:cacheprovider",
                "-n",
                "0",
                "--dist",
                "no",
                str(ROOT / "tests/measurement/read"),
            ],
            [recorder],
        )
        kept.write_bytes(pickle.dumps(list(recorder.kept.values())))
    for name, data, correction in pickle.loads(kept.read_bytes()):
        yield Case("tests", name, data, correction)


def say(text: str) -> None:
    """Print a line at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def main() -> None:
    """Print the table and the list."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--group", default="corpus,failing,data,labs,tests")
    parser.add_argument("--only", default="")
    parser.add_argument(
        "--list", default="wrong,bold,poor,part,crashed,asked", help="verdicts whose files are listed"
    )
    parser.add_argument("--trace", action="store_true", help="print the traces of crashes")
    parser.add_argument("--save", help="folder into which the listed files are written")
    given = parser.parse_args()
    counts: Counter[tuple[str, str]] = Counter()
    seconds: Counter[str] = Counter()
    worse: Counter[str] = Counter()
    known = _old_answers()
    for number, case in enumerate(cases(given.group.split(","), given.only)):
        group = case.group.partition(" ")[0]
        old = known(case)
        new = answer(new_reader.read_here, new_reader.preview_here, case)
        if group in ("corpus", "strangers"):
            verdict, why = of_corpus(case, new)
            before, _ = of_corpus(case, old)
        elif case.name in FAILING:
            verdict, why = of_failing(case, new)
            before, _ = of_failing(case, old)
        else:
            verdict, why = judged(old, new)
            before = (
                "crashed"
                if old.crash
                else "right"
                if old.measurement is not None
                else "asked"
                if old.questions
                else "useful"
            )
        counts[f"{group} new", verdict] += 1
        counts[f"{group} old", before] += 1
        seconds[f"{group} new"] += new.seconds
        seconds[f"{group} old"] += old.seconds
        if before == "right" and verdict != "right":
            worse[f"{group}: right -> {verdict}"] += 1
        if verdict in given.list.split(","):
            say(
                f"{verdict:8} {number:4} {case.group} {case.name} {case.correction.canonical()[:80]}: "
                f"{why[:260]}"
            )
            if given.trace and new.crash:
                say(new.crash)
            if given.save:
                (Path(given.save) / f"{number:04}-{case.name.replace('/', '_')}").write_bytes(case.data)
    say("\n" + " ".join([f"{'':14}", *(f"{v:>8}" for v in VERDICTS), "       s"]))
    for group in sorted(seconds):
        row = [f"{counts[group, v]:8}" for v in VERDICTS]
        say(" ".join([f"{group:14}", *row, f"{seconds[group]:8.1f}"]))
    for text, number in worse.most_common():
        say(f"{number:5} {text}")


def _old_answers() -> Callable[[Case], Answer]:
    """The old reader's answers, which are kept in a file between runs."""
    kept = Path(tempfile.gettempdir()) / "mckibben-reading-old.pickle"
    answers: dict[str, Answer] = pickle.loads(kept.read_bytes()) if kept.exists() else {}

    def known(case: Case) -> Answer:
        said = f"{case.name}|{case.correction.canonical()}|{case.correction.beside}"
        key = hashlib.sha256(case.data + said.encode("utf-8", "surrogatepass")).hexdigest()
        if key not in answers:
            found = answer(read_old, preview_old, case)
            if found.measurement is not None:
                from dataclasses import replace

                plain = replace(found.measurement)
                for name in ("columns", "conditions", "excluded_rows", "skipped", "shared_noise", "cut_off"):
                    object.__setattr__(plain, name, dict(getattr(plain, name)))
                found = replace(found, measurement=plain)
            answers[key] = found
            kept.write_bytes(pickle.dumps(answers)) if len(answers) % 200 == 0 else None
        return answers[key]

    import atexit

    atexit.register(lambda: kept.write_bytes(pickle.dumps(answers)))
    return known


if __name__ == "__main__":
    main()
