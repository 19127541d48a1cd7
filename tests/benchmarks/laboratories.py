"""Laboratories that nobody of the project has seen: their files through the command line, as a user types it.

    python -m tests.benchmarks.laboratories [--set third] [--only lab02,lab06] [--keep FILE]

`tests/laboratories` holds them. Each is diagnosed from the ideal muscle with the arguments of its user, the
model found is saved, and it predicts the files of the laboratory's second test. Errors are over the true
noise of the laboratory's predicted channel; a refused file is told with its message.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.benchmarks.diagnosis import say
from tests.benchmarks.workers import Examined, add_keep, examined, other_code

SETS = Path(__file__).parents[1] / "laboratories"
SURE = 0.9  # probability from which an effect is told as there
WANTED = 1.2  # largest error over the noise of a prediction that holds


@dataclass
class Line:
    """What became of one laboratory.

    Attributes:
        hidden: ids that are right answers, of each hidden effect; none for an effect that no catalogue has.
        told: the probability told of each named effect or group, and whether it is there.
        wrong: the entry that its user typed wrongly; empty for none.
        asked: the entry that is asked about first; it is then taken, as with one click.
        refusal: the message, where a file was not read or nothing was diagnosed.
    """

    laboratory: str
    kind: str
    hidden: list[list[str]]
    status: str = ""
    named: tuple[str, ...] = ()
    found: int = 0
    surplus: tuple[str, ...] = ()
    start: float = float("nan")
    after: float = float("nan")
    second: float = float("nan")
    told: tuple[tuple[float, bool], ...] = ()
    wrong: str = ""
    asked: str = ""
    refusal: str = ""

    @property
    def complete(self) -> bool:
        """Whether all hidden effects of the catalogue are named, or in a named group."""
        return self.found == sum(bool(ids) for ids in self.hidden)


def laboratories(chosen: str) -> list[str]:
    """Names of the laboratories of a set, as "set/lab01"."""
    with zipfile.ZipFile(SETS / f"{chosen}.zip") as archive:
        return sorted(
            f"{chosen}/{name.partition('/')[0]}" for name in archive.namelist() if name.endswith("truth.json")
        )


def mckibben(folder: Path, *arguments: str) -> dict[str, Any]:
    """The JSON that the program answers; with "refused" where it ends with an error."""
    command = [sys.executable, "-m", "mckibben", *arguments, "--json"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode:
        return {"refused": done.stderr.strip() or done.stdout.strip()}
    return json.loads(done.stdout)


def visited(name: str) -> Line:
    """Diagnose the first test of a laboratory, predict its second one, and open its answer."""
    chosen, laboratory = name.split("/")
    accepted = json.loads((SETS / "accepted.json").read_text())[chosen][laboratory]
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        with zipfile.ZipFile(SETS / f"{chosen}.zip") as archive:
            archive.extractall(folder, [item for item in archive.namelist() if item.startswith(laboratory)])
        home = folder / laboratory
        user, truth = (json.loads((home / f"{part}.json").read_text()) for part in ("user", "truth"))
        first, second = (sorted(map(str, (home / part).iterdir())) for part in ("files", "second"))
        line = Line(name, user["kind"], accepted)
        saved = str(folder / "model.json")
        stated = folder / "muscle.json"
        stated.write_text(json.dumps(json.loads((home / "muscle.json").read_text())["muscle"]))
        # A drive document holds the muscle as well.
        muscle = () if user.get("drive") else ("--muscle", str(stated), "--ideal")
        line.wrong = next((entry["entry"] for entry in truth.get("wrong", [])), "")
        question = ("diagnose", *first, *muscle, *user["arguments"], "--save", saved)
        found = mckibben(home, *question)
        line.asked = next((e["hypothesis"] for e in found.get("context", []) if e["asked"]), "")
        if line.asked:
            found = mckibben(home, *question, "--use", line.asked)
        if "refused" in found:
            line.refusal = found["refused"]
            return line
        verdict = found["verdict"]
        alike = verdict["indistinguishable"]
        groups = [{name, *(e for ids in alike if name in ids for e in ids)} for name in verdict["effects"]]
        known = [set(ids) for ids in accepted if ids]
        line.status, line.named = verdict["status"], tuple(verdict["effects"])
        line.found = sum(any(ids & group for group in groups) for ids in known)
        line.surplus = tuple(
            name
            for name, group in zip(verdict["effects"], groups, strict=True)
            if not any(group & ids for ids in known)
        )
        line.told = tuple(
            (verdict["probabilities"][name], any(group & ids for ids in known))
            for name, group in zip(verdict["effects"], groups, strict=True)
        )
        # Of several channels the program tells errors over their noise.
        noise = 1.0 if found["unit"] == "1" else truth["noise"]["first"]
        line.start, line.after = (found["path"][place]["rmse"] / noise for place in (0, -1))
        then = mckibben(home, "compare", *second, "--model", saved, *user["second_arguments"])
        if "refused" in then:
            line.refusal = then["refused"]
        else:
            error = then["channels"].get("displacement", then)["rmse"]
            line.second = error / truth["noise"]["second"]
        return line


def summary(lines: Sequence[Line]) -> list[str]:
    """The figures of the table; what no catalogue has is counted apart."""
    known = [line for line in lines if line.hidden and all(line.hidden)]
    nothing = [line for line in lines if not line.hidden]
    mistaken = [line for line in lines if line.wrong]
    sure = [true for line in lines for probability, true in line.told if probability >= SURE]
    held = [line.second <= WANTED for line in (*known, *nothing)]
    return [
        f"read and diagnosed                  {sum(not line.refusal for line in lines)} of {len(lines)}",
        f"all hidden effects found            {sum(line.complete for line in known)} of {len(known)}",
        f"with surplus effects                {sum(bool(line.surplus) for line in known)} of {len(known)}",
        f"nothing missing: false alarms       {sum(bool(line.named) for line in nothing)} of {len(nothing)}",
        f"wrong entry asked about first       {sum(line.asked == line.wrong for line in mistaken)} of "
        f"{len(mistaken)}, right entry {sum(bool(line.asked) for line in lines if not line.wrong)}",
        f"told with {100.0 * SURE:.0f} % or more, and there     {sum(sure)} of {len(sure)}",
        f"second test: error <= {WANTED} x noise   {sum(held)} of {len(held)}",
    ]


def text_of(line: Line) -> str:
    """A line of the table."""
    if line.refusal:
        return f"-- {line.laboratory} {line.kind:.40}: {line.refusal}"
    right = line.complete and not line.surplus
    return (
        f"{'ok' if right else '--'} {line.laboratory} {line.kind:40.40} {line.status:16}"
        f"{line.start:7.1f} ->{line.after:6.2f}  second {line.second:6.2f}  {', '.join(line.named)}"
        + (f"  surplus {', '.join(line.surplus)}" if line.surplus else "")
        + (
            ""
            if right
            else f"  hidden {'; '.join('/'.join(ids) or 'in no catalogue' for ids in line.hidden)}"
        )
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--set", default="first", help="which examiner's")
    parser.add_argument("--only", default="", help="laboratories, separated by commas")
    add_keep(parser)
    given = parser.parse_args()
    chosen = [f"{given.set}/{name}" for name in given.only.split(",") if name] or laboratories(given.set)
    kept: list[Examined[Line]] = []
    for one in examined(visited, chosen, keep=given.keep):
        kept.append(one)
        say(f"{text_of(one.result)}  {one.seconds:.0f} s of the processor")
    say(other_code(kept))
    lines = [one.result for one in kept]
    for text in summary(lines):
        say(text)


if __name__ == "__main__":
    sys.exit(main())
