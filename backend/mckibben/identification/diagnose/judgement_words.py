"""What a judgement of a model says, in words, for comparisons and diagnoses alike."""

from __future__ import annotations

from mckibben.identification.diagnose.judgement import Judgement
from mckibben.identification.residual.digits import brief

#: Proof that does not hold -> what would decide it.
_DECIDED_BY = {
    "noise_known": "State the noise.",
    "no_outliers": "Look at these rows.",
    "white": "Repeat the run: what is missing comes again, noise does not.",
    "rival_gains_nothing": "Measure more, at other pressures or lengths.",
}
_STRUCTURE = ("white", "rival_gains_nothing")  # proofs that fail where a structure is left


def shown_unit(unit: str) -> tuple[str, float]:
    """Unit of shown errors, and their factor from SI; lengths are shown in millimetres."""
    return {"1": ("times the noise", 1.0), "m": ("mm", 1e3)}.get(unit, (unit, 1.0))


def open_proofs(judgement: Judgement) -> dict[str, str]:
    """Proof that does not hold, or cannot be told, -> why."""
    return {name: why for name, (holds, why) in judgement.proofs.items() if holds is not True}


def undecided_text(judgement: Judgement, unit: str, scale: float) -> str:
    """Which proof that nothing more is missing does not hold, and what would decide it; empty if decided.

    Args:
        judgement: of the model.
        unit: of the shown errors.
        scale: their factor from SI.
    """
    if not judgement.undecided:
        return ""
    proofs = open_proofs(judgement)
    text = f"These data cannot tell whether more is missing: {_joined(proofs)}."
    if judgement.proofs["white"][0] is False:
        text += _free_curve(judgement, unit, scale)
    return " ".join([text, *dict.fromkeys(_DECIDED_BY[name] for name in proofs)])


def judged_text(judgement: Judgement, unit: str, scale: float) -> str:
    """What is said of a model that was compared, without a search for what it lacks; see `undecided_text`."""
    if judgement.structured:
        shows = {name: why for name, why in open_proofs(judgement).items() if name in _STRUCTURE}
        seen = "it is far above the noise" if judgement.surface is None else _joined(shows)
        return (
            f"What is left is no noise: {seen}. A diagnosis tells which effect, constant or entry may be "
            "behind it."
        )
    if judgement.undecided:
        return undecided_text(judgement, unit, scale)
    return f"Nothing is missing: the error of {brief(scale * judgement.rmse)} {unit} is noise."


def _free_curve(judgement: Judgement, unit: str, scale: float) -> str:
    if judgement.surface is None or not judgement.surface.sparing:
        return ""
    left = f"{brief(scale * judgement.surface.left)} {unit}"
    numbers = judgement.surface.numbers
    return f" A free curve with {numbers} number{'' if numbers == 1 else 's'} would leave {left}."


def _joined(proofs: dict[str, str]) -> str:
    *first, last = list(dict.fromkeys(proofs.values())) or [""]
    return f"{', '.join(first)} and {last}" if first else last
