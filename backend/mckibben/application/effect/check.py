"""The check of one effect: its claims, where it is seen, and whether a diagnosis finds it again."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mckibben.application.diagnose.signatures import USUAL_PRESSURE
from mckibben.application.effect.broken import BrokenClaim
from mckibben.application.effect.claims import checks_of
from mckibben.application.effect.states import MUSCLE
from mckibben.application.listing import examples_folder
from mckibben.facts.result import result_class
from mckibben.identification.diagnose.atlas import SignaturePicture, pictures, stand_ins
from mckibben.identification.diagnose.trial import Trial, trial
from mckibben.identification.predict.fit_model import FitModel
from mckibben.physics.catalogue import default_catalogue, effect_of_file
from mckibben.physics.effect import KINDS, Effect, Kind
from mckibben.physics.errors import InputError, error_text
from mckibben.simulation.outcome import Watch

_TEMPLATE = "own/effects/seal_drag.py"
#: A kind of test that shows the effect is tried in this order: maps and loops are diagnosed quickly.
_TRIED: tuple[Kind, ...] = ("static", "isobaric", "isometric", "isotonic", "diameter", "transient")


@result_class
class ClaimFinding:
    """One claim of the effect."""

    claim: str
    """What must hold, one sentence."""
    holds: bool
    """Whether it does."""
    message: str
    """Where it does not hold, and by how much; empty if it holds."""


@result_class
class EffectCheck:
    """What an effect file claims, and what of it is so."""

    effect: str
    """Id of the effect, the name of its file."""
    title: str
    """Its title."""
    claims: list[ClaimFinding]
    """The claims, evaluated; the worked examples are among them."""
    seen: list[SignaturePicture]
    """What it leaves in the readings of each kind of test that it names."""
    unseen: list[str]
    """Kinds of tests that it names and in which nothing of it shows."""
    trials: list[Trial]
    """Simulated experiments with the effect hidden in them, diagnosed."""

    passed: bool
    """Whether all claims hold, it is seen where it says so, and all trials that are large enough find it."""


@dataclass(frozen=True, slots=True)
class CheckQuestion:
    """An effect, and how often it is hidden and looked for."""

    effect: Effect
    trials: int = 3


def check(question: CheckQuestion, watch: Watch | None = None) -> EffectCheck:
    """Evaluate an effect.

    Args:
        question: the effect.
        watch: is told the progress.

    Raises:
        InputError: the tests of the effect cannot be simulated.
    """
    effect = question.effect
    tell = (watch or Watch()).ended
    claims = checks_of(effect)
    total = len(claims) + 1 + 3 * question.trials
    findings = []
    for done, each in enumerate(claims):
        tell(done / total)
        findings.append(_finding(each, effect))
    catalogue = {**default_catalogue(), effect.id: effect}
    base = FitModel(MUSCLE)
    for name in stand_ins(effect, catalogue, {}):
        base = base.adding(catalogue[name])
    seen = pictures(base, effect, pressure=USUAL_PRESSURE)
    shown = {picture.kind for picture in seen if picture.rms > 0.0}
    trials = []
    kind = next((each for each in _TRIED if each in shown), None)
    for number in range(question.trials if kind else 0):
        assert kind is not None  # noqa: S101
        tell((len(claims) + 1 + 3 * number) / total)
        trials.append(trial(base, effect, kind, number=number, pressure=USUAL_PRESSURE, catalogue=catalogue))
    unseen: list[str] = [each for each in KINDS if each in effect.kinds and each not in shown]
    fair = [each for each in trials if each.outcome != "too small"]
    found = all(each.outcome != "not found" for each in fair) and bool(fair or not trials)
    passed = all(each.holds for each in findings) and not unseen and found
    return EffectCheck(effect.id, effect.title, findings, seen, unseen, trials, passed)


def _finding(each: Callable[[Effect], None], effect: Effect) -> ClaimFinding:
    said = " ".join((each.__doc__ or "").split("\n\n")[0].split())
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            each(effect)
    except BrokenClaim as broken:
        return ClaimFinding(said, False, str(broken))
    except Exception as error:  # the code of a stranger, evaluated far from where it was written
        return ClaimFinding(said, False, " ".join(error_text(error).split())[:300])
    return ClaimFinding(said, True, "")


def effect_to_check(name: str) -> Effect:
    """The effect of a file, or one of the program by its id.

    Raises:
        InputError: there is neither, or the file cannot be loaded.
    """
    if name in default_catalogue():
        return default_catalogue()[name]
    path = Path(name)
    if not path.exists():
        raise InputError(f"{name}: there is no such file", hint="mckibben effect new NAME writes one")
    return effect_of_file(path)


def write_template(name: str, folder: Path) -> Path:
    """Write a complete effect to begin with: a constant force that the user changes into his own.

    Raises:
        InputError: the name cannot be the id of an effect, the file exists, or it cannot be written.
    """
    if name in default_catalogue():
        raise InputError(f"an effect '{name}' exists already", hint=f"e.g. own_{name}")
    if not (name.isascii() and name.isidentifier() and name == name.lower()) or name.startswith("_"):
        raise InputError(f"'{name[:64]}' cannot be the id of an effect", hint="e.g. seal_drag")
    title = name.replace("_", " ").capitalize()
    text = (examples_folder() / _TEMPLATE).read_text("utf-8").replace("Seal drag", title)
    path = folder / f"{name}.py"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
    except FileExistsError as error:
        raise InputError(f"{path}: exists already", hint="name another effect") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror or error}") from error
    return path
