"""The verdict of a diagnosis in words."""

from __future__ import annotations

from collections.abc import Mapping

from mckibben.identification.diagnosis import Diagnosis


def sentence_of(result: Diagnosis, titles: Mapping[str, str]) -> str:
    """What the verdict means, in one to three sentences."""
    # A length is told in millimetres.
    scaled = result.subject.unit == "1"
    unit, scale = {"1": ("times the noise", 1.0), "m": ("mm", 1e3)}.get(
        result.subject.unit, (result.subject.unit, 1.0)
    )
    before, after = scale * result.start.rmse, scale * result.best.rmse
    names = _joined([titles.get(name, name) for name in result.added])
    falls = f"The error falls from {before:.3g} to {after:.3g} {unit}"
    floor = "" if result.noise is None or scaled else f"; the noise is {scale * result.noise:.3g} {unit}"
    if result.status == "adequate":
        return f"Nothing is missing: the error of {after:.3g} {unit} is noise{floor}."
    if result.status == "unknown_effect":
        share = 100.0 * result.structure.share
        variables = _joined([name for name, _ in result.structure.variables[:2]])
        rest = (
            f"{share:.0f} % of what remains still follows {variables or 'a pattern'}, and no catalogued "
            "effect explains it"
        )
        if not result.added:
            return f"No catalogued effect explains the error of {before:.3g} {unit}: {rest}."
        return f"Missing: {names}. {falls}{floor}. {rest[0].upper()}{rest[1:]}."
    text = f"Missing: {names}. {falls}{floor}."
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
