"""Nested names (JSON, MATLAB, HDF5) -> sheets: columns are arrays of one length below one name, single values
are texts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.limits import MAX_COLUMNS, MAX_DEPTH, MAX_NODES, MAX_TEXT
from mckibben.measurement.reading.model import Sheet, Span
from mckibben.measurement.reading.unit_lists import names_of_columns, units_of_columns, units_said
from mckibben.measurement.reading.units import unit_of
from mckibben.physics.errors import InputError

_FEWEST = 2  # values of an array
_NAMES = ("name", "label", "title", "channel", "signal", "quantity", "id", "key")
_MOST_LISTS = 50  # lists of names further up that are tried for a matrix
_WIDEST = 12  # columns of a matrix without names
_FACTORS = ("scale", "factor", "gain", "scale_factor")  # of a channel whose values are kept smaller
_MOST_FIELDS = 12  # of a mapping that is one channel


@dataclass
class _Walk:
    """What has been found below the names so far."""

    format: str
    noun: str
    sheets: list[Sheet] = field(default_factory=list)
    texts: list[Span] = field(default_factory=list)
    messages: list[str] = field(default_factory=list)
    nodes: int = 0
    names: list[tuple[list[str], list[str]]] = field(default_factory=list)


def sheets_of_tree(tree: Any, format: str, noun: str) -> list[Sheet]:
    """The tables of nested names."""
    walk = _Walk(format, noun)
    _visit(walk, tree, "", (), {}, 0)
    if not walk.sheets and walk.texts:
        return [Sheet("", noun=noun, format=format, arrays={}, texts=tuple(walk.texts))]
    return walk.sheets


def _visit(
    walk: _Walk, node: Any, path: str, above: tuple[Span, ...], units: Mapping[str, str], depth: int
) -> None:
    walk.nodes += 1
    if isinstance(node, dict):
        walk.names += _name_lists(node)
    if depth > MAX_DEPTH or walk.nodes > MAX_NODES:
        return
    if isinstance(node, (list, tuple)) and node and all(isinstance(item, dict) for item in node):
        _of_list(walk, list(node), path, above, units, depth)
    elif isinstance(node, (list, tuple)) and _is_grid(node):
        _of_grid(walk, node, path, above, units)
    elif isinstance(node, dict):
        _of_names(walk, node, path, above, units, depth)


def _is_grid(node: Sequence[Any]) -> bool:
    """Whether a list holds rows of which the first is one of names."""
    return (
        len(node) > _FEWEST
        and all(isinstance(row, (list, tuple)) for row in node)
        and len(node[0]) > 1
        and all(isinstance(cell, str) for cell in node[0])
    )


def _of_grid(
    walk: _Walk, node: Sequence[Any], path: str, above: tuple[Span, ...], units: Mapping[str, str]
) -> None:
    heads = [str(cell) for cell in node[0]][:MAX_COLUMNS]
    body = node[1:]
    if all(isinstance(cell, str) and unit_of(cell) is not None for cell in body[0]):
        units = {**units, **dict(zip(heads, map(str, body[0]), strict=False))}
        body = body[1:]
    arrays = {head: [row[i] if i < len(row) else None for row in body] for i, head in enumerate(heads)}
    _emit(walk, path, arrays, units, above)


def _of_list(
    walk: _Walk,
    node: list[dict[str, Any]],
    path: str,
    above: tuple[Span, ...],
    units: Mapping[str, str],
    depth: int,
) -> None:
    """Records, named channels, or runs one after another."""
    ((keys_of_most, _),) = Counter(frozenset(item) for item in node).most_common(1)
    usual = [item for item in node if item.keys() == keys_of_most]
    if len(usual) > 2 and len(usual) > len(node) / 2 and _is_record(_flattened(usual[0])[0]):
        others = [item for item in node if item.keys() != usual[0].keys()]
        if others:
            walk.messages.append(
                f"{len(others)} of {len(node)} records hold no readings: they are read as texts"
            )
        for item in others[:20]:
            above = (*above, *_texts_of(item, path))
            units = {
                **units,
                **{
                    str(k): str(u)
                    for v in item.values()
                    if isinstance(v, dict)
                    for k, u in v.items()
                    if isinstance(u, str)
                },
            }
    if (
        all(_is_record(item) for item in usual)
        and len(usual) >= _FEWEST
        and not any(_channel(item) for item in node)
    ):
        keys = list(dict.fromkeys(k for item in usual[:1000] for k in item))[:MAX_COLUMNS]
        flat = {str(k): [_leaf(item.get(k)) for item in usual] for k in keys}
        _emit(walk, path, flat, units, above)
        return
    named = [_channel(item) for item in node]
    if all(named):
        _of_names(walk, {f"{i}": item for i, item in enumerate(node)}, path, above, units, depth + 1)
        return
    if (
        all(not isinstance(v, (list, np.ndarray)) for item in usual[:5] for v in item.values())
        and len(usual) > 2
    ):
        flat_items = [_flattened(item) for item in usual]
        if all(_is_record(item) for item, _ in flat_items[:5]):
            units = {**units, **flat_items[0][1]}
            _of_list(walk, [item for item, _ in flat_items], path, above, units, depth + 1)
            return
    for i, item in enumerate(node[:300]):
        _visit(walk, item, f"{path}({i + 1})", above, units, depth + 1)


def _is_record(item: Mapping[str, Any]) -> bool:
    return bool(item) and all(
        not isinstance(v, (dict, list, tuple)) and (not isinstance(v, np.ndarray) or v.size == 1)
        for v in item.values()
    )


def _flattened(
    item: Mapping[str, Any], before: str = "", depth: int = 0
) -> tuple[dict[str, Any], dict[str, str]]:
    """A record whose fields are records as one, and the units of its fields: ``p: {value: 2, unit: bar}``."""
    flat: dict[str, Any] = {}
    units: dict[str, str] = {}
    for key, value in item.items():
        name = f"{before}{key}"
        if (quantity := _quantity(value)) is not None:
            flat[name], units[name] = quantity
        elif isinstance(value, dict) and depth < 3:
            inner, more = _flattened(value, f"{name}.", depth + 1)
            flat, units = flat | inner, units | more
        else:
            flat[name] = value
    return flat, units


def _quantity(value: Any) -> tuple[float, str] | None:
    """The number and the unit of a mapping that holds one of each; None = it does not."""
    if not isinstance(value, dict) or len(value) > 4:
        return None
    texts = {str(k): v for k, v in value.items() if isinstance(v, str)}
    units = [v for k, v in texts.items() if _says_unit(k)]
    units = units or [v for v in texts.values() if len(value) == _FEWEST and unit_of(v) is not None]
    numbers = [v for v in value.values() if isinstance(v, (int, float)) and not isinstance(v, bool)]
    return (float(numbers[0]), units[0]) if numbers and units and units[0] else None


def _leaf(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return float(value.ravel()[0]) if value.size and value.dtype.kind in "biuf" else str(value)
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def _texts_of(item: Mapping[str, Any], path: str) -> list[Span]:
    """The single values of a mapping, at any depth, as texts."""
    found: list[Span] = []
    for key, value in item.items():
        if isinstance(value, dict):
            if (quantity := _quantity(value)) is not None:
                found.append(Span(f"{path}{key}", f"{key}: {quantity[0]:.12g} {quantity[1]}"))
            else:
                found += _texts_of(value, f"{path}{key}.")
        elif (text := _single(value)) is not None:
            found.append(Span(f"{path}{key}", f"{key}: {text}"[:MAX_TEXT]))
    return found


def _single(value: Any) -> str | None:
    """One value as a text; None = it is none, or several."""
    if isinstance(value, bool):
        return None
    if isinstance(value, str):
        return value
    if isinstance(value, (int, float)):
        return f"{value:.12g}"
    if isinstance(value, np.ndarray) and value.size == 1:
        return f"{value.ravel()[0]:.12g}" if value.dtype.kind in "iuf" else str(value.ravel()[0])
    return None


def _says_unit(key: str) -> bool:
    return word_set("unit").among(words_of(key))


def _channel(item: Any) -> tuple[str, Any, str, list[str]] | None:
    """(name, values, unit, remarks) of a mapping that is one channel: one array, a name or a unit beside
    it.
    """
    if (
        not isinstance(item, dict)
        or len(item) > _MOST_FIELDS
        or any(isinstance(v, dict) for v in item.values())
    ):
        return None
    arrays = [v for v in item.values() if isinstance(v, (list, tuple, np.ndarray)) and _size(v) > _FEWEST]
    if len(arrays) != 1 or (
        isinstance(arrays[0], (list, tuple)) and isinstance(arrays[0][0], (list, dict, tuple))
    ):
        return None
    texts = {str(k): v for k, v in item.items() if isinstance(v, str)}
    unit = next((v for k, v in texts.items() if _says_unit(k)), "")
    title = next((v for k, v in texts.items() if k.lower() in _NAMES), "")
    if not unit and not title:
        return None
    values = np.ravel(arrays[0]) if isinstance(arrays[0], np.ndarray) else list(arrays[0])
    return title, values, unit, [v for v in texts.values() if v not in (unit, title)]


def _scaled(walk: _Walk, name: str, item: Mapping[str, Any], values: Any) -> Any:
    """The values of a channel that is kept with a factor and an offset."""
    said = {str(key).lower(): v for key, v in item.items() if isinstance(v, (int, float))}
    factor = next((said[key] for key in _FACTORS if key in said), None)
    if factor is None or any(isinstance(v, str) for v in values[:50]):
        return values
    offset = float(said.get("offset", 0.0))
    walk.messages.append(f"'{name}' is kept with a scale: its values are times {factor:g}, plus {offset:g}")
    return np.array([np.nan if v is None else v for v in values], float) * factor + offset


def _size(value: Any) -> int:
    return int(value.size) if isinstance(value, np.ndarray) else len(value)


def _of_names(
    walk: _Walk,
    node: Mapping[str, Any],
    path: str,
    above: tuple[Span, ...],
    units: Mapping[str, str],
    depth: int,
) -> None:
    texts, arrays, below = [*above], {}, []
    lists = [*_name_lists(node), *reversed(walk.names[-_MOST_LISTS:])]
    own = dict(units)
    for key, value in node.items():
        if isinstance(value, dict) and not _has_arrays(value):
            texts += _texts_of({key: value}, path)
            if value and all(isinstance(v, str) and len(v) < 40 for v in value.values()):
                own |= {str(k): v for k, v in value.items()}
    flat: dict[str, Any] = {}
    lost: dict[str, str] = {}
    for key, value in node.items():  # a list of named arrays are columns of this level
        if isinstance(value, (list, tuple)) and len(value) > 1 and all(_channel(v) for v in value):
            flat |= {f"{key}({i + 1})": v for i, v in enumerate(value)}
        else:
            flat[str(key)] = value
    said = units_said(node)
    own |= {name: said[words] for name in flat if (words := words_of(name)) in said}
    for head, value in flat.items():
        channel = _channel(value)
        if channel is not None:
            name = channel[0] or head
            arrays[name] = _scaled(walk, name, value, channel[1])
            if channel[2]:
                own[name] = channel[2]
            texts += [Span(f"{path}{head}", f"{name}: {t}"[:MAX_TEXT]) for t in channel[3]]
        elif (columns := _matrix(value, lists)) is not None:
            arrays |= columns
        elif (
            isinstance(value, np.ndarray) and value.size >= _FEWEST and min(value.shape, default=0) == 1
        ) or (isinstance(value, np.ndarray) and value.ndim == 1 and value.size >= _FEWEST):
            arrays[head] = np.ravel(value)
        elif (
            isinstance(value, (list, tuple))
            and len(value) >= _FEWEST
            and all(not isinstance(v, (dict, list, tuple, np.ndarray)) for v in value[:50])
        ):
            arrays[head] = list(value)
        elif (text := _single(value)) is not None:
            unit = said.get(words_of(head)) if not isinstance(value, str) else None
            texts.append(Span(f"{path}{head}", f"{head}: {text} {unit or ''}".rstrip()[:MAX_TEXT]))
        elif isinstance(value, dict) and not _has_arrays(value):
            continue
        elif isinstance(value, (dict, list, tuple)):
            below.append((head, value))
        elif why := _no_column(value):
            lost[head] = why
    melted, messages = _map_of(node, arrays, walk.noun)
    arrays |= melted
    walk.messages += messages
    arrays |= _runs_of(node, arrays)
    if not arrays:
        for key, value in node.items():
            arrays |= _unnamed(str(key), value)
    dropped = [
        (f"{path}{k}", why)
        for k, why in lost.items()
        if not any(a == k or a.startswith(f"{k}(") for a in arrays)
    ]
    if arrays:
        own |= _listed_units(arrays, own)
    _emit(walk, path, arrays, own, tuple(texts), dropped)
    walk.texts += [t for t in texts if t not in above]
    for head, value in below:
        _visit(walk, value, f"{path}{head}.", tuple(texts), own, depth + 1)


def _no_column(value: Any) -> str:
    """Why a variable is no column; "" = it may be something else than one."""
    if value is None:
        return "it holds no real numbers that can be read"
    if isinstance(value, np.ndarray) and value.ndim > 1 and min(value.shape) > 1:
        shape = " x ".join(map(str, value.shape))
        return f"it is no vector of numbers, but a matrix of {shape}, and nothing names its columns"
    return ""


def _map_of(
    node: Mapping[str, Any], arrays: dict[str, Any], noun: str
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """A matrix over the two vectors whose lengths are its sides, as three columns, and what is said of it;
    these vectors are then taken away.

    Raises:
        InputError: either vector could be its rows.
    """
    matrices = [
        (k, v)
        for k, v in node.items()
        if isinstance(v, np.ndarray) and v.ndim == 2 and min(v.shape) > 1 and v.dtype.kind in "biuf"
    ]
    messages = tuple(
        f"{noun} '{k}' is not used: a matrix of {v.shape[0]} x {v.shape[1]} cells that fits no vectors"
        for k, v in matrices
        if k not in arrays
    )
    if len(matrices) != 1:
        return {}, messages
    name, matrix = matrices[0]
    size = f"a map of {matrix.shape[0]} x {matrix.shape[1]} cells"
    down = [k for k, v in arrays.items() if len(v) == matrix.shape[0] and not isinstance(v[0], str)]
    across = [
        k
        for k, v in arrays.items()
        if len(v) == matrix.shape[1] and k not in down[:1] and not isinstance(v[0], str)
    ]
    if len(down) < 1 or len(across) < 1:
        return {}, messages
    if matrix.shape[0] == matrix.shape[1]:
        raise InputError(
            f"'{name}': {size} over {' and '.join(map(repr, down))}, either of which could be its rows",
            field=f"{noun} {name}",
            hint="write its cells as rows of three columns, or one row more than columns",
        )
    first, second = np.asarray(arrays.pop(down[0]), float), np.asarray(arrays.pop(across[0]), float)
    return {
        down[0]: np.repeat(first, len(second)),
        across[0]: np.tile(second, len(first)),
        str(name): np.asarray(matrix, float).ravel(),
    }, (f"{noun} '{name}' is {size} over '{down[0]}' and '{across[0]}': each cell is read as a row",)


def _runs_of(node: Mapping[str, Any], arrays: dict[str, Any]) -> dict[str, Any]:
    """Matrices of one shape of which one side is as long as a vector, as the runs of a test one after
    another; the vectors are then repeated.
    """
    matrices = {
        str(k): v
        for k, v in node.items()
        if isinstance(v, np.ndarray) and v.ndim == 2 and min(v.shape) > 1 and v.dtype.kind in "biuf"
    }
    shapes = {v.shape for v in matrices.values()}
    sizes = {len(v) for v in arrays.values() if not isinstance(v[0], str)}
    if len(matrices) < 2 or len(shapes) != 1 or len(longs := sizes & set(shapes.pop())) == 0:
        return {}
    size = max(longs)
    turned = {k: v if v.shape[1] == size else v.T for k, v in matrices.items()}
    runs = len(next(iter(turned.values())))
    if runs == size:
        return {}
    made = {k: np.tile(np.asarray(v, float), runs) for k, v in arrays.items() if len(v) == size}
    made |= {k: np.repeat(np.asarray(v, float), size) for k, v in arrays.items() if len(v) == runs}
    return {
        "run": np.repeat(np.arange(1.0, runs + 1.0), size),
        **made,
        **{k: v.ravel() for k, v in turned.items()},
    }


def _has_arrays(value: Any, depth: int = 0) -> bool:
    """Whether a mapping holds an array at any depth."""
    if isinstance(value, dict):
        return depth > MAX_DEPTH or any(_has_arrays(v, depth + 1) for v in value.values())
    return (isinstance(value, (list, tuple)) and len(value) > 1) or (
        isinstance(value, np.ndarray) and value.size > 1
    )


def _listed_units(arrays: dict[str, Any], units: Mapping[str, str]) -> dict[str, str]:
    """The units of columns in a list of as many texts, which is no column."""
    del units
    for head, values in list(arrays.items()):
        if (
            isinstance(values, list)
            and values
            and all(isinstance(v, str) and unit_of(v) is not None for v in values)
        ):
            others = [name for name in arrays if name != head and not isinstance(arrays[name][0], str)]
            if len(others) == len(values):
                del arrays[head]
                return dict(zip(others, map(str, values), strict=True))
    return {}


def _matrix(value: Any, lists: Sequence[tuple[list[str], list[str]]]) -> dict[str, Any] | None:
    """The named columns of a matrix; None = it is none, or nothing names its columns."""
    array: np.ndarray | None = None
    if (
        isinstance(value, np.ndarray)
        and value.ndim == 2
        and min(value.shape) > 1
        and value.dtype.kind in "biuf"
    ):
        array = value
    elif (
        isinstance(value, (list, tuple))
        and len(value) > _FEWEST
        and all(isinstance(r, (list, tuple)) for r in value)
    ):
        width = len(value[0])
        if (
            width > 1
            and all(len(row) == width for row in value)
            and not any(isinstance(c, (dict, list)) for c in value[0])
        ):
            try:
                array = np.array([[np.nan if c is None else c for c in row] for row in value], float)
            except (TypeError, ValueError):  # words among them
                names = next((names for names, _ in lists if len(names) == width), [])
                return {name: [row[i] for row in value] for i, name in enumerate(names)} or None
    if array is None:
        return None
    for names, units in lists:
        if len(names) in array.shape:
            table = array if array.shape[1] == len(names) else array.T
            heads = [f"{name} [{unit}]" if unit else name for name, unit in zip(names, units, strict=True)]
            return {head: table[:, i] for i, head in enumerate(heads[:MAX_COLUMNS])}
    return None


def _unnamed(key: str, value: Any) -> dict[str, Any]:
    """The columns of a long matrix that nothing names, as MATLAB would write them: ``M(:,1)``."""
    if (
        not isinstance(value, np.ndarray)
        or value.ndim != 2
        or value.dtype.kind not in "biuf"
        or not 1 < value.shape[1] <= _WIDEST < value.shape[0]
    ):
        return {}
    return {f"{key}(:,{i + 1})": value[:, i] for i in range(value.shape[1])}


def _name_lists(node: Mapping[str, Any], depth: int = 0) -> list[tuple[list[str], list[str]]]:
    """Lists of names of columns, with their units: of texts, or of mappings with a name; those of inner
    mappings last.
    """
    found = [
        (names, [unit or "" for unit in units_of_columns(names, node)]) for names in names_of_columns(node)
    ]
    for other in node.values():
        if not isinstance(other, (list, tuple)) or not other:
            continue
        if all(isinstance(v, dict) and any(str(k).lower() in _NAMES for k in v) for v in other):
            names = [next(str(x) for k, x in v.items() if str(k).lower() in _NAMES) for v in other]
            units = [
                " ".join(
                    [
                        next((str(x) for k, x in v.items() if _says_unit(str(k))), ""),
                        next(
                            (
                                str(x)
                                for k, x in v.items()
                                if str(x).lower() in ("absolute", "gauge", "relative")
                            ),
                            "",
                        ),
                    ]
                ).strip()
                for v in other
            ]
            found.append((names, units))
    for other in node.values() if depth < 2 else ():
        if isinstance(other, dict):
            found += _name_lists(other, depth + 1)
    return found


def _emit(
    walk: _Walk,
    path: str,
    arrays: Mapping[str, Any],
    units: Mapping[str, str],
    texts: tuple[Span, ...],
    dropped: Sequence[tuple[str, str]] = (),
) -> None:
    """A sheet of the arrays of one length; the others are named beside it."""
    sizes = [len(v) for v in arrays.values()]
    if not sizes or max(sizes) < _FEWEST:
        if dropped:
            walk.sheets.append(
                Sheet(path.rstrip("."), noun=walk.noun, format=walk.format, arrays={}, dropped=tuple(dropped))
            )
        return
    size = max(set(sizes), key=lambda n: (sizes.count(n) > 1, sizes.count(n) * n))
    chosen = dict([(k, v) for k, v in arrays.items() if len(v) == size][:MAX_COLUMNS])
    rest = tuple(
        (f"{path}{k}", f"it has {len(v)} values, and the others {size}")
        for k, v in arrays.items()
        if len(v) != size
    )
    lists = tuple(
        Span(f"{path}{k}", f"{k}: {'; '.join(map(str, v))}"[:MAX_TEXT])
        for k, v in arrays.items()
        if len(v) != size and isinstance(v, list) and all(isinstance(t, str) for t in v)
    )
    walk.sheets.append(
        Sheet(
            path.rstrip("."),
            noun=walk.noun,
            format=walk.format,
            arrays=chosen,
            units={k: u for k in chosen if (u := units.get(k) or units.get(k.rpartition(".")[2], ""))},
            texts=(*texts, *lists),
            dropped=(*dropped, *rest),
            messages=tuple(walk.messages),
        )
    )
    walk.messages = []
