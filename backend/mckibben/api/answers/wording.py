"""The verdict of a diagnosis in words."""

from __future__ import annotations

from collections.abc import Mapping

from mckibben.identification.diagnosis import Diagnosis

_AT_FLOOR = 1.15  # of the noise: the error has reached it


def sentence_of(result: Diagnosis, titles: Mapping[str, str]) -> str:
    """What the verdict means, in one to three sentences."""
    # A length is told in millimetres.
    scaled = result.subject.unit == "1"
    unit, scale = {"1": ("times the noise", 1.0), "m": ("mm", 1e3)}.get(
        result.subject.unit, (result.subject.unit, 1.0)
    )
    before, after = scale * result.start.rmse, scale * result.best.rmse
    names = _joined([titles.get(name, name) for name in result.added])
    noise = None if result.noise is None or scaled else scale * result.noise
    level = "" if noise is None else f"{noise:.3g} {unit}"
    if result.status == "adequate":
        of_noise = f"is of the size of the noise ({level})" if level else "is noise"
        return f"Nothing is missing: the error of {before:.3g} {unit} {of_noise}."
    share = f"{100.0 * result.structure.share:.0f} %"
    follows = f"follows {_joined([name for name, _ in result.structure.variables[:2]]) or 'a pattern'}"
    if result.status == "unknown_effect" and not result.added:
        return f"No catalogued effect explains the error of {before:.3g} {unit}: {share} of it {follows}."
    at_floor = noise is not None and after <= _AT_FLOOR * noise
    floor = f", the noise of the data ({level})" if at_floor else f"; the noise is {level}" if level else ""
    these = "it" if len(result.added) == 1 else "them"
    text = f"Missing: {names}. With {these} the error falls from {before:.3g} to {after:.3g} {unit}{floor}."
    if result.status == "unknown_effect":
        return f"{text} No catalogued effect explains the rest: {share} of it {follows}."
    if result.status == "ambiguous":
        pairs = []
        for added in dict.fromkeys(other.of for other in result.alternatives):
            others = [
                titles.get(other.effect, other.effect) for other in result.alternatives if other.of == added
            ]
            pairs.append(f"{titles.get(added, added)} from {_joined(others, 'or')}")
        text += f" These data cannot tell {'; nor '.join(pairs)}."
    return text


def _joined(names: list[str], word: str = "and") -> str:
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {word} {names[-1]}"
