"""Which effects are missing: models are built up in a beam, then every effect has to defend its place.

One effect at a time hides pairs that only help together, and near-twins share their credit, so several models
go on at once, ranked by `mckibben.identification.diagnose.score`. From each, every candidate is added and all
numbers are refitted jointly; further constants of an effect are freed before another effect is believed. At
the end each effect is dropped and exchanged, and what is not needed goes.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.identification.diagnose.score import LEAST_SCORE, better, effective_rows, score
from mckibben.identification.fit.fitted_model import Node
from mckibben.identification.fit.fitter import Fits
from mckibben.physics.effect import Effect

_BEAM = 4
_TRIED = 8  # candidates fitted per model, by what they promise to first order
_PATIENCE = 2  # rounds without a better model
_ALIKE = 0.02  # of the mean square: models whose residuals differ by less go on as one
_DEEPEST = 7  # effects added
_AT_FLOOR = 1.05  # of the noise: below, nothing more can be learnt
_WITHIN = 1.15  # of the best error, near the floor


def search(work: Fits, root: Node, *, singles: Sequence[Node]) -> Node:
    """The best model that effects can make of a fitted start model.

    Args:
        work: fits.
        root: the start model.
        singles: the start model with each single candidate.
    """
    best, idle = root, 0
    if _at_floor(work, root):
        return root
    children = list(singles)
    for _ in range(_DEEPEST):
        children = [n for n in {child.key: child for child in children}.values() if n.rmse < root.rmse]
        if not children:
            break
        rows = _rows(work, min(children, key=lambda node: node.rmse))
        children.sort(key=lambda node: score(node, rows=rows, noise=work.noise))
        first = next((node for node in children if not node.implausible), children[0])
        work.listen(first)
        if _at_floor(work, first) and better(first, best, rows=_rows(work, first), noise=work.noise):
            best = first
            break
        beam = [with_further_constants(work, n, _examined(work, n, root)) for n in children[: 2 * _BEAM]]
        beam = _different(beam)[:_BEAM]
        leader = min(beam, key=lambda node: (node.implausible > 0, score(node, rows=rows, noise=work.noise)))
        whole = with_further_constants(work, leader)
        beam, leader = [whole if node is leader else node for node in beam], whole
        idle += 1
        work.listen(leader)
        if better(leader, best, rows=_rows(work, leader), noise=work.noise):
            best, idle = leader, 0
        if idle >= _PATIENCE or _at_floor(work, best):
            break
        if work.near_floor(best):  # what is far from it now will not come first
            beam = [node for node in beam if node.rmse < _WITHIN * best.rmse]
        children = []
        for node in beam:
            inside = set(node.setting.ids)
            others = [effect for effect in work.candidates if effect.id not in inside]
            children += [
                work.adding(node, effect)
                for effect in work.promising(node, others)[: min(_TRIED, work.subject.tried)]
            ]
    return _polished(work, best, root)


def _examined(work: Fits, node: Node, root: Node) -> list[Effect]:
    """Effects whose further constants are tried in every model: all; where runs are dear what was added."""
    start = () if work.subject.thorough else root.setting.ids
    return [effect for effect in node.setting.effects if effect.id not in start]


def with_further_constants(work: Fits, node: Node, effects: Sequence[Effect] | None = None) -> Node:
    """The node with further constants freed where that earns its price: of some effects, or of all."""
    if _at_floor(work, node):
        return node
    for effect in node.setting.effects if effects is None else effects:
        others = [
            n for n in work.freeing(node, effect) if better(n, node, rows=_rows(work, n), noise=work.noise)
        ]
        if others:
            rows = _rows(work, min(others, key=lambda n: n.rmse))
            node = min(others, key=lambda n: score(n, rows=rows, noise=work.noise))
    return node


def exchanged(work: Fits, less: Node, effect: Effect) -> Node:
    """A model with another effect in the place of one that was dropped."""
    return with_further_constants(work, work.adding(less, effect), [effect])


def lean(work: Fits, node: Node, root: Node) -> Node:
    """The node without freed constants that do not earn their price, which they may have done earlier."""
    while True:
        rows = _rows(work, node)
        less = [work.holding(node, name, _held(name, node, root)) for name in sorted(node.freed - root.freed)]
        less = [other for other in less if other.free and other.implausible <= node.implausible]
        found = min(less, key=lambda n: score(n, rows=rows, noise=work.noise), default=node)
        if score(found, rows=rows, noise=work.noise) >= score(node, rows=rows, noise=work.noise):
            return node
        node = found


def _held(name: str, node: Node, root: Node) -> float:
    """A further constant where no fit changes it: as the start model says, or the effect's default."""
    effect_id, _, parameter = name.partition(".")
    if effect_id in root.setting.ids:
        return root.setting.number(name)
    effect = next(effect for effect in node.setting.effects if effect.id == effect_id)
    return effect.parameter(parameter).default


def _polished(work: Fits, best: Node, root: Node) -> Node:
    """Drop what is not needed, exchange what another effect does better, until nothing changes."""
    start = set(root.setting.ids)
    best = lean(work, best, root)
    for _ in range(_DEEPEST):
        rows = _rows(work, best)
        before = best
        for effect_id in best.setting.ids:
            if effect_id in start:
                continue
            less = work.dropping(best, effect_id)
            needed = better(best, less, rows=rows, noise=work.noise)
            if not needed and less.implausible <= best.implausible:
                best = less
                break
            if _at_floor(work, best):
                continue
            inside = set(best.setting.ids)
            others = [effect for effect in work.candidates if effect.id not in inside]
            swaps = [exchanged(work, less, effect) for effect in work.promising(less, others)[:_BEAM]]
            swaps = [lean(work, node, root) if _as_good(node, best) else node for node in swaps]
            swaps = [node for node in swaps if node.implausible <= best.implausible]
            here = score(best, rows=rows, noise=work.noise)
            found = min(swaps, key=lambda node: score(node, rows=rows, noise=work.noise), default=best)
            if score(found, rows=rows, noise=work.noise) < here - LEAST_SCORE:
                best = found
                break
        if best is before:
            return best
    return best


def _as_good(node: Node, best: Node) -> bool:
    return node.mean_square < (1.0 + _ALIKE) * best.mean_square


def _different(nodes: Sequence[Node]) -> list[Node]:
    """The nodes without those whose prediction an earlier one makes as well."""
    kept: list[Node] = []
    for node in nodes:
        if all(np.mean((node.residual - other.residual) ** 2) > _ALIKE * node.mean_square for other in kept):
            kept.append(node)
    return kept


def _rows(work: Fits, node: Node) -> float:
    return effective_rows(node.residual, work.subject.sweeps, work.subject.folds)


def _at_floor(work: Fits, node: Node) -> bool:
    return work.noise is not None and node.rmse <= _AT_FLOOR * work.noise
