"""The verdict in words, for page, report and command line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mckibben.facts.units import probability_text
from mckibben.identification.diagnose.corrections import Correction
from mckibben.identification.diagnose.diagnosis import Diagnosis, Unfinished
from mckibben.identification.diagnose.judgement import PUSHES
from mckibben.identification.diagnose.judgement_words import shown_unit, undecided_text
from mckibben.identification.diagnose.probability import instead_of
from mckibben.identification.diagnose.repetition_words import repetition_text
from mckibben.identification.diagnose.verdict import Status, is_force
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.residual.digits import brief
from mckibben.identification.thresholds import PROBABILITY, SCORE, WORDS
from mckibben.physics.effect import Effect

_ROWS = 5  # rows that are listed
_FEW = 3  # alternatives that are listed without grouping them
_UNKNOWN_NOISE = (
    "The noise cannot be estimated from these data: state it to know whether the error exceeds it."
)


_TITLES: dict[Status, str] = {
    "adequate": "The model is adequate",
    "missing_effects": "Effects are missing",
    "ambiguous": "Effects are missing, and the data cannot tell all of them apart",
    "unknown_effect": "Something is missing that no catalogued effect explains",
    "undecided": "These data cannot tell whether something is missing",
    "unfinished": "Not finished: the limit of time ended the diagnosis",
}


_PARTLY = "Effects are missing, and the rest is unknown"
_NONE_LIKELY = "Something is missing, and no catalogued effect is likely"


def title_of(status: Status, *, added: bool, doubted: bool = False, none_likely: bool = False) -> str:
    """The status as a title.

    Args:
        status: of the verdict.
        added: whether effects were found to be missing.
        doubted: whether an entry has to be checked first.
        none_likely: whether it is likelier that none of these effects is missing.
    """
    if doubted:
        return "An entry may be wrong: check it before the physics"
    if none_likely:
        return _NONE_LIKELY
    return _PARTLY if added and status == "unknown_effect" else _TITLES[status]


def sentence_of(result: Diagnosis, catalogue: Mapping[str, Effect]) -> str:
    """The verdict in one to four sentences."""
    titles = {name: effect.title for name, effect in catalogue.items()}
    scaled = result.predictor.unit == "1"
    unit, scale = _unit_of(result)
    reached = [step.fitted_model for step in result.path if not step.correction]
    before, after = scale * result.start.rmse, scale * reached[-1].rmse
    refitted = scale * next((s.fitted_model for s in result.path if s.refitted), result.root).rmse
    doubted = any(entry.stands for entry in result.context)
    read = {item.effect for item in result.evidence if item.read}
    first = next((name for name in result.added if name not in read), "")
    names = _joined([
        titles.get(name, name) if doubted else _likely(result, name, titles, first=name == first)
        for name in result.added
    ])  # fmt: skip
    noise = None if result.noise is None else scale * result.noise
    highest = noise if result.noise_interval is None else scale * result.noise_interval.high
    if result.unfinished is not None:
        these = _joined([titles.get(name, name) for name in result.added])
        return _unfinished(result.unfinished, these, before, after, unit)
    level = ""
    if noise is not None and highest is not None and not scaled:
        level = f"{brief(noise)} {unit}"
        if highest > SCORE.at_floor * noise:
            level += " between neighbouring readings"
            if result.judgement is not None and result.judgement.undecided:
                highest = noise  # the rest may be noise, or not
            else:
                level += f", {brief(highest)} {unit} {_why_more(result)}"
    rest = _rest(result)
    if not result.added:
        if result.with_them is not None:
            before, after = after, scale * result.best.rmse
        error = f"the error of {brief(after)} {unit}"
        if result.with_them is not None:
            error += " of the other rows"
        elif after < WORDS.refitted * before:
            error += f" (with the numbers of the model refitted; before {brief(before)} {unit})"
        if doubted:
            return f"With the entries as stated no catalogued effect explains {error}."
        if result.status == "unknown_effect":
            unsure = "" if result.noise is not None else f" {_UNKNOWN_NOISE}"
            look = f" {where_to_look(result)}".rstrip()
            return f"No catalogued effect explains {error}: {rest}.{look}{unsure}"
        if result.status == "undecided":
            return f"No effect is proved to be missing behind {error}. {_undecided(result)}"
        of_noise = f"is of the size of the noise ({level})" if level else "is noise"
        return f"Nothing is missing: {error} {of_noise}."
    at_floor = highest is not None and after <= SCORE.at_floor * highest
    # A scaled error is a multiple of the noise already.
    floor = (
        "" if not level else f", the noise of the data ({level})" if at_floor else f"; the noise is {level}"
    )
    these = "it" if len(result.added) == 1 else "them"
    if doubted:
        would = "would fall" if at_floor else "would only fall"
        return (
            f"With the entries as stated, {names} would be missing, and the error {would} from "
            f"{brief(before)} to {brief(after)} {unit}{floor}."
        )
    falls = f"the error falls from {brief(before)} to {brief(after)} {unit}{floor}."
    text = f"Missing: {names}. With {these} {falls}"
    if result.root.free and refitted < WORDS.refitted * before:
        text = (
            f"Missing: {names}. The model's own numbers, refitted{_own_law(result, titles)}, lower the error "
            f"from {brief(before)} to {brief(refitted)} {unit}; with {these} the error falls to "
            f"{brief(after)} {unit}{floor}."
        )
    if result.none_likely:
        text += (
            " That effect is less likely than not: one that is in no catalogue may act in its place."
            if len(result.added) == 1
            else " It is likelier that none of them is missing: one in no catalogue may act in their place."
        )
    elif result.status == "unknown_effect":
        return f"{text} No catalogued effect explains the rest: {rest}. {where_to_look(result)}".rstrip()
    if result.judgement is not None and result.judgement.undecided:
        text += f" {_undecided(result)}"
    unexplained = highest is not None and scale * result.best.rmse > SCORE.at_floor * highest
    if unexplained and _predictable(result) >= WORDS.worth_telling:
        text += f" Of the rest, {_structured(result)}."
    if result.alternatives:
        pairs = []
        for added in dict.fromkeys(other.of for other in result.alternatives):
            others = [other.effect for other in result.alternatives if other.of == added]
            pairs.append(f"{titles.get(added, added)} from {by_mechanism(others, catalogue)}")
        text += f" These data cannot tell {'; nor '.join(pairs)}."
        text += "".join(
            f" The model holds {titles.get(name, name)}: {reason}."
            for name, reason in applied_reasons(result, catalogue).items()
        )
    return text


def _why_more(result: Diagnosis) -> str:
    """Why the error is above the scatter of neighbouring readings although it is noise."""
    best = None if result.judgement is None else result.judgement.likeliest
    if best is None or best.noise.white > WORDS.mostly_white:
        return "with the rows that are farther off than most"
    if best.noise.second and best.noise.length > WORDS.swings * best.noise.period:
        return f"with what swings over about {best.noise.period:.0f} rows"
    return f"with what stays alike over about {max(best.noise.length, 1.0):.0f} rows"


def _undecided(result: Diagnosis) -> str:
    return "" if result.judgement is None else undecided_text(result.judgement, *_unit_of(result))


def _own_law(result: Diagnosis, titles: Mapping[str, str]) -> str:
    """The further constants of the start model's effects that were freed, in brackets; else empty."""
    refitted = next((step.fitted_model for step in result.path if step.refitted), None)
    freed = [] if refitted is None else sorted(refitted.freed - result.root.freed)
    of_effects: dict[str, list[str]] = {}
    for name in freed:
        effect, _, constant = name.partition(".")
        of_effects.setdefault(effect, []).append(constant.replace("_", " "))
    parts = [f"{_joined(names)} of {titles.get(effect, effect)}" for effect, names in of_effects.items()]
    return f" (with {_joined(parts)} free)" if parts else ""


def by_mechanism(effects: Sequence[str], catalogue: Mapping[str, Effect]) -> str:
    """Titles of effects as alternatives; more than three are grouped by their family."""
    known = [catalogue[name] for name in effects if name in catalogue]
    if len(known) <= _FEW:
        return _joined([effect.title for effect in known], "or")
    families: dict[str, list[str]] = {}
    for effect in known:
        families.setdefault(effect.family, []).append(effect.title)
    groups = "; ".join(f"{family}: {', '.join(titles)}" for family, titles in families.items())
    return f"{len(known)} others ({groups})"


def applied_reasons(result: Diagnosis, catalogue: Mapping[str, Effect]) -> dict[str, str]:
    """Effect of the best model that has alternatives -> why the model holds this one of them."""
    reasons = {}
    for item in result.evidence:
        if len(item.group) < 2 or item.effect not in catalogue:
            continue
        others = [catalogue[name] for name in item.group[1:] if name in catalogue]
        own = catalogue[item.effect].prior
        likelier = max(others, key=lambda effect: effect.prior.share, default=None)
        if likelier is None or likelier.prior.share <= own.share:
            reasons[item.effect] = f"it is the most common of them; {own.why}"
        else:
            other = next(a for a in result.alternatives if (a.of, a.effect) == (item.effect, likelier.id))
            reasons[item.effect] = _against_the_likelier(result, likelier.title, other.fitted_model)
    return reasons


def _against_the_likelier(result: Diagnosis, title: str, other: FittedModel) -> str:
    """Why the model does not hold the alternative that is more common."""
    unit, scale = _unit_of(result)
    here, there = (brief(scale * model.rmse) for model in (result.lean, other))
    if here != there and result.lean.rmse < other.rmse:
        return f"it leaves {here} {unit}; {title}, which is more common, leaves {there} {unit}"
    if other.implausible > result.lean.implausible:
        return f"{title} is more common and fits as well, but only with values outside their usual range"
    if len(other.free) > len(result.lean.free):
        return f"{title} is more common and fits as well, but needs more values"
    return f"{title} is more common and fits as well; nothing in these data decides between them"


def correction_reason(item: Correction) -> str:
    """Why an effect that lowers the error is not called missing."""
    if item.formula:
        return "a formula of the same variables that no catalogue has is likelier"
    return "a slightly inexact form of another effect would explain as much"


def corrections_sentence(result: Diagnosis, titles: Mapping[str, str]) -> str:
    """Which effects lower the error and are not called missing; empty without any."""
    unit, scale = _unit_of(result)

    def listed(items: list[Correction]) -> str:
        return _joined([
            f"{titles.get(item.effect, item.effect)} (from {brief(scale * item.before)} to "
            f"{brief(scale * item.after)} {unit}, probability {probability_text(item.probability)})"
            for item in items
        ])  # fmt: skip

    texts = []
    for kept, what in ((True, "Not called missing, but kept in the model, which predicts better with it"),
                       (False, "Neither called missing nor kept")):  # fmt: skip
        items = [item for item in result.corrections if item.kept is kept]
        if not kept:
            items = [item for item in items if item.after < item.before and result.added]
        for reason in dict.fromkeys(map(correction_reason, items)):
            some = [item for item in items if correction_reason(item) == reason]
            texts.append(f"{what}: {listed(some)}; {reason}.")
    return " ".join(texts)


def aside_sentence(result: Diagnosis, places: Sequence[str], catalogue: Mapping[str, Effect]) -> str:
    """The rows that do not fit, and what is said with them; empty without any.

    Args:
        result: the diagnosis.
        places: names of these rows, in the order of the evidence.
        catalogue: of effects.
    """
    whole = result.with_them
    if whole is None or whole.judgement is None:
        return ""
    unit, scale = _unit_of(result)
    sizes = [brief(scale * abs(size)) for size in suspects_of(result)]
    away = [f"{place} ({size} {unit} off)" for place, size in zip(places, sizes, strict=True)]
    where = whole.judgement.outlying.place if len(whole.judgement.outlying.rows) == len(away) else None
    shown = _joined([*away[:_ROWS], *([f"{len(away) - _ROWS} more"] if len(away) > _ROWS else [])])
    they, these = ("it does", "it") if len(away) == 1 else ("they do", "them")
    rule = "a rule of the file or of the motion, no accidents"
    other = title_of(
        whole.status,
        added=bool(whole.added),
        doubted=any(entry.stands for entry in whole.context),
        none_likely=whole.none_likely,
    )
    named = _joined([catalogue[name].title for name in whole.added if name in catalogue])
    other = f"{other[:1].lower()}{other[1:]}" + (f" ({named})" if named else "")
    which = "" if where is None else f" They are {where.sentence}: {rule}."
    pushing = len(set(aside_of(result).tolist()) & set(whole.judgement.pushing))
    if pushing:
        which += f" In {pushing} of {'it' if len(away) == 1 else 'them'} {PUSHES}."
    return (
        f"Set aside, because {they} not fit: {shown}. The error without {these} is "
        f"{brief(scale * result.best.rmse)} {unit}.{which} With {these} the verdict would be: {other}."
    )


def suspects_of(result: Diagnosis) -> list[float]:
    """Measured minus predicted by the best model of the rows that were set aside, SI over the scale."""
    whole = result.with_them
    if whole is None or whole.judgement is None:
        return []
    predictor = whole.predictor
    residual = predictor.residual(result.best.fit_model) / predictor.scale
    return residual[aside_of(result)].tolist()


def aside_of(result: Diagnosis) -> np.ndarray:
    """The values that were set aside, as indices."""
    aside = result.predictor.aside
    return np.flatnonzero(np.zeros(0, bool) if aside is None else aside)


def superfluous_sentence(result: Diagnosis, titles: Mapping[str, str]) -> str:
    """The effects of the start model that the data do not need; empty without any."""
    if not result.superfluous:
        return ""
    unit, scale = _unit_of(result)
    names = _joined([titles.get(item.effect, item.effect) for item in result.superfluous])
    these, are = ("it", "is") if len(result.superfluous) == 1 else ("them", "are")
    error = brief(scale * result.superfluous[-1].rmse)
    return (
        f"{names} {are} superfluous here: without {these}, and all else refitted, the error is {error} "
        f"instead of {brief(scale * result.best.rmse)} {unit}."
    )


def bounds_sentence(result: Diagnosis, catalogue: Mapping[str, Effect]) -> str:
    """The named effects whose values ended at the bound of the search; empty without any.

    A value at a bound of its definition, such as 0 and 1 of a share, is a value like others.
    """
    added = [effect for effect in result.best.fit_model.effects if effect.id in result.added]
    ended = dict(zip((p.name for p in result.best.free), result.best.at_bound.tolist(), strict=True))
    texts = []
    for effect in added:
        values = [
            f"{p.name.replace('_', ' ')} {brief(result.best.fit_model.number(f'{effect.id}.{p.name}'))}"
            f"{'' if p.unit == '1' else f' {p.unit}'}"
            for p in effect.parameters
            if ended.get(f"{effect.id}.{p.name}")
        ]
        if values:
            title = catalogue[effect.id].title if effect.id in catalogue else effect.id
            texts.append(f"{title} ({_joined(values)})")
    if not texts:
        return ""
    ends = "ends" if len(texts) == 1 else "end"
    return (
        f"{_joined(texts)} {ends} at the bound of the search: these data do not determine the size, and "
        "another cause may act in that place."
    )


def left_out_sentence(result: Diagnosis) -> str:
    """How well the model predicts a specimen that it was not fitted to; empty for a single one."""
    if not result.left_out:
        return ""
    unit, scale = _unit_of(result)
    worst = max(result.left_out, key=lambda each: each.rmse)
    if unit == "times the noise":
        errors = [f"{each.name} to {brief(each.rmse)} {unit}" for each in result.left_out]
    else:
        errors = [
            f"{each.name} to {brief(scale * each.rmse)} {unit} ({100.0 * each.share:.2g} %)"
            for each in result.left_out
        ]
    if len(errors) > _FEW:
        errors = [f"each of the {len(errors)} to at most {brief(scale * worst.rmse)} {unit}"]
    text = f"Fitted to the other specimens alone, the model predicts {_joined(errors)}."
    groups = result.best.holdout_rmse
    if worst.rmse > WORDS.different * max(groups, result.noise or 0.0):
        text += (
            f" On left-out groups of the same ones it errs by {brief(scale * groups)} {unit}: they differ by "
            "more than the model says."
        )
    return text


def _unfinished(done: Unfinished, names: str, before: float, after: float, unit: str) -> str:
    """What was found until the time was over, and what was not tried."""
    found = (
        f"So far, with {names} the error falls from {brief(before)} to {brief(after)} {unit}."
        if names
        else f"So far no effect lowers the error of {brief(before)} {unit}."
    )
    return (
        f"{found} The limit of {done.limit:g} s of processor time ended the diagnosis after {done.tried} of "
        f"{done.candidates} effects had been tried alone and {done.models} models fitted: the other effects "
        "and combinations were not tried, nor was what else would explain the data as well."
    )


def _likely(result: Diagnosis, effect: str, titles: Mapping[str, str], *, first: bool) -> str:
    """Title of an effect and its probability, or that of its group; ``first``: say what the figure is."""
    title = titles.get(effect, effect)
    evidence = next((item for item in result.evidence if item.effect == effect), None)
    if evidence is not None and evidence.read:
        return f"{title} (read from the data)"
    probability = 1.0 if evidence is None else evidence.probability
    perhaps = "perhaps " if probability < PROBABILITY.even else ""
    figure = f"{'probability ' if first else ''}{probability_text(probability)}"
    instead = [] if evidence is None else instead_of(result.context, evidence.group)
    if instead:
        entries = list(dict.fromkeys(found.entry.title for found in instead))
        figure += f", or {_joined(entries[:_FEW], 'or')} is wrong instead"
    return f"{perhaps}{title[:-1]}, {figure})" if title.endswith(")") else f"{perhaps}{title} ({figure})"


def where_to_look(result: Diagnosis) -> str:
    """The ranges in which a rest without a formula is largest, one sentence; empty where nothing is left, or
    most of it repeats.
    """
    if result.status != "unknown_effect" or (result.term is not None and not result.term.smooth):
        return ""
    if _predictable(result) < WORDS.worth_telling or _mostly_repeats(result):
        return ""
    unit, scale = _unit_of(result)
    profiles = {profile.over: profile for profile in result.left_where}
    ranges = [
        f"{profiles[name].worst} ({brief(scale * profiles[name].rmse)} {unit})"
        for name in _depends_on(result)
        if name in profiles
    ]
    if not ranges:
        return ""
    no_formula = "No short formula halves it" if is_force(result.predictor) else "No formula is proposed"
    return f"{no_formula}; look where it is largest: {_joined(ranges)}."


def _unit_of(result: Diagnosis) -> tuple[str, float]:
    return shown_unit(result.predictor.unit)


def repeats(result: Diagnosis) -> str:
    """What of the last residual repeats, in words; empty without it."""
    return "" if result.repetition is None else repetition_text(result.repetition, *_unit_of(result))


def _rest(result: Diagnosis) -> str:
    """The variables that the last residual depends on, and what of it repeats."""
    if result.repetition is not None:
        if _predictable(result) < WORDS.worth_telling or _mostly_repeats(result):
            return repeats(result)
        return f"{_structured(result, ' of it')}; {repeats(result)}"
    if result.judgement is not None and result.judgement.surface is None:
        return "there are too few rows to tell what it depends on"
    if _predictable(result) < WORDS.worth_telling:
        if result.term is not None and not result.term.smooth:
            return f"the proposed term takes {100.0 * result.term.share:.0f} % of it"
        return "it depends on no measured variable; repeat the run to see whether it recurs"
    return _structured(result, " of it")


def _mostly_repeats(result: Diagnosis) -> bool:
    """Whether the repetition says more than the variables: a ripple depends on the contraction anyway."""
    return result.repetition is not None and result.repetition.share >= WORDS.most


def _structured(result: Diagnosis, of: str = "") -> str:
    variables = _depends_on(result)
    return f"{100.0 * _predictable(result):.0f} %{of} depends on {_joined(variables) or 'a pattern'}"


def _predictable(result: Diagnosis) -> float:
    return 0.0 if result.judgement is None else result.judgement.predictable


def _depends_on(result: Diagnosis) -> list[str]:
    """The two channels that the rest depends on most."""
    return [] if result.judgement is None else list(result.judgement.depends_on[:2])


def _joined(names: list[str], word: str = "and") -> str:
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {word} {names[-1]}"
