"""Which effects are missing: models are built up in a beam, then every effect has to defend its place.

One effect at a time hides pairs that only help together, and near-twins share their credit, so several models
go on at once, ranked by `mckibben.identification.score`. From each, every candidate is added and all numbers
are refitted jointly; further constants of an effect are freed before another effect is believed. At the end
each effect is dropped and exchanged, and what is not needed goes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from mckibben.identification.fit import Free
from mckibben.identification.node import Node, fitted_node
from mckibben.identification.score import LEAST_SCORE, better, effective_rows, score
from mckibben.identification.setting import Setting, free_numbers
from mckibben.identification.subjects.subject import Subject
from mckibben.physics.effect import Effect

_BEAM = 4
_TRIED = 8  # candidates fitted per model, by what they promise to first order
_PATIENCE = 2  # rounds without a better model
_ALIKE = 0.02  # of the mean square: models whose residuals differ by less go on as one
_DEEPEST = 7  # effects added
_AT_FLOOR = 1.05  # of the noise: below, nothing more can be learnt
_NEAR_FLOOR = 1.2  # of the noise: below, only an effect that shows by itself is tried
_WITHIN = 1.3  # of the best error, near the floor
_MOVED = 1e-3  # of its start: a number that moves less has not been looked for
_STUCK = 0.999  # of the error before: a fit that gains less starts once more
_LEAST_PROMISE = 0.02  # of the mean square, near the floor


class CancelledError(Exception):
    """Nobody waits for the diagnosis any more."""


@dataclass
class Search:
    """Fits models of one subject and remembers them.

    Attributes:
        subject: the data.
        geometry: geometry that every fit may change.
        candidates: effects that may be added.
        noise: of the residual over its scale, None when it cannot be told.
        held: names of numbers that no fit changes, because something else has told them.
        tell: told now and then what is being done; may raise `CancelledError`.
    """

    subject: Subject
    geometry: tuple[Free, ...]
    candidates: tuple[Effect, ...]
    noise: float | None
    held: frozenset[str] = frozenset()
    tell: Callable[[str], None] = lambda _: None
    known: dict[tuple[frozenset[str], frozenset[str]], Node] = field(default_factory=dict)
    twice: set[tuple[frozenset[str], frozenset[str]]] = field(default_factory=set)

    def fit(self, setting: Setting, freed: frozenset[str] = frozenset(), *, again: bool = False) -> Node:
        """The fitted model of a choice of effects and freed constants; found again when it was fitted.

        ``again`` fits from another start, once, and keeps the better end.
        """
        key = frozenset(setting.ids), freed
        if key not in self.known or (again and key not in self.twice):
            self.tell(", ".join(setting.ids))
            free = free_numbers(setting, self.geometry, freed, load=self.subject.unknown_load)
            free = [parameter for parameter in free if parameter.name not in self.held]
            node = fitted_node(self.subject, setting, free, freed=freed)
            if again:
                self.twice.add(key)
            if key not in self.known or node.rmse < self.known[key].rmse:
                self.known[key] = node
        return self.known[key]

    def adding(self, node: Node, effect: Effect) -> Node:
        """The model with one more effect, its numbers refitted from where they are."""
        off = {p.name: p.off for p in effect.parameters if p.fitted and p.off is not None}
        near, usual = node.setting.adding(effect, _between(effect, off)), node.setting.adding(effect)
        found = self.fit(near, node.freed)
        started = near.values[effect.id]
        still = all(
            abs(found.setting.values[effect.id][name] - started[name]) < _MOVED * abs(started[name])
            for name in off
        )
        if found.rmse > _STUCK * node.rmse or still:
            found = self.fit(usual, node.freed, again=True)
        return found

    def freeing(self, node: Node, effect: Effect) -> list[Node]:
        """The model with further constants of an effect freed: together, or each where that is too much."""
        names = {f"{effect.id}.{p.name}" for p in effect.parameters if not p.fitted} - node.freed
        names -= self._blind(node, names)
        if not names:
            return []
        whole = self.fit(node.setting, node.freed | names)
        if len(names) == 1 or whole.implausible <= node.implausible:
            return [whole]
        return [self.fit(node.setting, node.freed | {name}) for name in sorted(names)]

    def dropping(self, node: Node, effect_id: str) -> Node:
        """The model without an effect, refitted."""
        freed = frozenset(name for name in node.freed if not name.startswith(f"{effect_id}."))
        return self.fit(node.setting.without(effect_id), freed)

    def promising(self, node: Node, effects: Sequence[Effect]) -> list[Effect]:
        """Effects in the order of the error they would take away to first order."""
        inner = node.jacobian[:, node.inner]
        basis = np.linalg.qr(inner)[0] if inner.shape[1] else np.empty((len(node.residual), 0))
        left = node.residual - basis @ (basis.T @ node.residual)
        gains = []
        for effect in effects:
            columns = self.changes(node, effect)
            rest = columns - basis @ (basis.T @ columns)
            size, whole = np.linalg.norm(rest, axis=0), np.linalg.norm(columns, axis=0)
            seen = size > 1e-3 * whole
            found = (
                np.linalg.lstsq(rest[:, seen] / size[seen], left, rcond=1e-6)[0] if np.any(seen) else left[:0]
            )
            gains.append(float(np.sum((rest[:, seen] / size[seen] @ found) ** 2)))
        order = np.argsort(gains)[::-1]
        least = _LEAST_PROMISE * float(left @ left) if _near_floor(self, node) else 0.0
        return [effects[index] for index in order if gains[index] > least]

    def guessed(self, node: Node, effect: Effect) -> Node:
        """The model with one more effect of the size that is best to first order, nothing else refitted."""
        free = tuple(
            p
            for p in free_numbers(node.setting.adding(effect, effect.off), (), node.freed)
            if p.name.startswith(f"{effect.id}.")
        )
        off = {p.name: p.off for p in effect.parameters if p.off is not None and p.fitted}
        reach = np.array([_between(effect, off)[name] - value for name, value in off.items()])
        columns = self.changes(node, effect)
        size = np.linalg.lstsq(columns, node.residual, rcond=1e-6)[0] * reach
        named = {f"{effect.id}.{name}": value + x for (name, value), x in zip(off.items(), size, strict=True)}
        inside = {p.name: float(np.clip(named[p.name], p.lower, p.upper)) for p in free if p.name in named}
        setting = node.setting.adding(effect, effect.off)
        setting = setting.with_numbers(list(inside), list(inside.values()))
        left = (self.subject.measured - self.subject.trial(setting)) / self.subject.scale
        if float(np.mean(left**2)) > node.mean_square:
            setting, left = node.setting.adding(effect, effect.off), node.residual
        return Node(setting, node.free, node.freed, left, node.jacobian, node.folds)

    def changes(self, node: Node, effect: Effect) -> np.ndarray:
        """Change of the prediction by each number of an effect of moderate size, (values, numbers)."""
        off = {p.name: p.off for p in effect.parameters if p.off is not None and p.fitted}
        before = self.subject.measured - node.residual * self.subject.scale
        columns = []
        for name in off:
            single = effect.off | {name: _between(effect, off)[name]}
            trial = self.subject.trial(node.setting.adding(effect, single))
            columns.append((trial - before) / self.subject.scale)
        return np.column_stack(columns)

    def _blind(self, node: Node, names: set[str]) -> set[str]:
        """Those of some constants that change nothing in these data."""
        free = [p for p in free_numbers(node.setting, (), names) if p.name in names]
        if not free:
            return set()
        columns = self.subject.linearised(node.setting, free)[1]
        span = np.array([p.upper - p.lower for p in free])
        reach = np.linalg.norm(columns, axis=0) * span / np.sqrt(len(columns))
        least = 0.1 * (self.noise or 0.0)
        return {p.name for p, size in zip(free, reach, strict=True) if not size > least}


def _between(effect: Effect, off: dict[str, float]) -> dict[str, float]:
    """A third of the way from off to the default."""
    usual = effect.defaults
    return {name: value + (usual[name] - value) / 3.0 for name, value in off.items()}


def search(work: Search, root: Node, *, singles: Sequence[Node]) -> Node:
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
        if _at_floor(work, first) and better(first, best, rows=_rows(work, first), noise=work.noise):
            best = first
            break
        beam = _different([with_further_constants(work, node) for node in children[: 2 * _BEAM]])[:_BEAM]
        leader = min(beam, key=lambda node: (node.implausible > 0, score(node, rows=rows, noise=work.noise)))
        idle += 1
        if better(leader, best, rows=_rows(work, leader), noise=work.noise):
            best, idle = leader, 0
        if idle >= _PATIENCE or _at_floor(work, best):
            break
        if _near_floor(work, best):  # what is far from it now will not come first
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


def with_further_constants(work: Search, node: Node) -> Node:
    """The node with further constants of its effects freed where that earns its price."""
    if _at_floor(work, node):
        return node
    for effect in node.setting.effects:
        others = [
            n for n in work.freeing(node, effect) if better(n, node, rows=_rows(work, n), noise=work.noise)
        ]
        if others:
            rows = _rows(work, min(others, key=lambda n: n.rmse))
            node = min(others, key=lambda n: score(n, rows=rows, noise=work.noise))
    return node


def _polished(work: Search, best: Node, root: Node) -> Node:
    """Drop what is not needed, exchange what another effect does better, until nothing changes."""
    start = set(root.setting.ids)
    for _ in range(_DEEPEST):
        rows = _rows(work, best)
        before = best
        for effect_id in best.setting.ids:
            if effect_id in start:
                continue
            less = work.dropping(best, effect_id)
            if not better(best, less, rows=rows, noise=work.noise):
                best = less
                break
            if _at_floor(work, best):
                continue
            inside = set(best.setting.ids)
            others = [effect for effect in work.candidates if effect.id not in inside]
            swaps = [work.adding(less, effect) for effect in work.promising(less, others)[:_BEAM]]
            swaps = [with_further_constants(work, node) for node in swaps]
            here = score(best, rows=rows, noise=work.noise)
            found = min(swaps, key=lambda node: score(node, rows=rows, noise=work.noise), default=best)
            if score(found, rows=rows, noise=work.noise) < here - LEAST_SCORE:
                best = found
                break
        if best is before:
            return best
    return best


def _different(nodes: Sequence[Node]) -> list[Node]:
    """The nodes without those whose prediction an earlier one makes as well."""
    kept: list[Node] = []
    for node in nodes:
        if all(np.mean((node.residual - other.residual) ** 2) > _ALIKE * node.mean_square for other in kept):
            kept.append(node)
    return kept


def _rows(work: Search, node: Node) -> float:
    return effective_rows(node.residual, work.subject.sweeps, work.subject.folds)


def _near_floor(work: Search, node: Node) -> bool:
    return work.noise is not None and node.rmse < _NEAR_FLOOR * work.noise


def _at_floor(work: Search, node: Node) -> bool:
    return work.noise is not None and node.rmse <= _AT_FLOOR * work.noise
