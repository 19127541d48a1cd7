"""Measurements from HDF5 and from MATLAB files v7.3, which are HDF5: vectors by name, in groups or structs.

What programs other than MATLAB write has its units, names of columns and conditions in attributes.

HDF5 keeps a variable in pieces that may be compressed, and unpacks a piece whole, whatever size it says. So
every piece is unpacked here first, as far as its size, before HDF5 reads it.
"""

from __future__ import annotations

import zlib
from math import prod
from typing import Any

import numpy as np

from mckibben.measurement.reading.heads import taken_apart
from mckibben.measurement.reading.limits import WORD, Allowance, check_variables, inflated
from mckibben.measurement.reading.mat5 import Foreign
from mckibben.measurement.reading.packed import packed_values
from mckibben.measurement.reading.unit_lists import (
    names_of_columns,
    names_units,
    unit_among,
    unit_said,
    units_of_columns,
)
from mckibben.measurement.reading.units import reference_of, unit_of
from mckibben.physics.errors import InputError

_SHUFFLE, _DEFLATE, _CHECKSUM = 2, 1, 3  # filters that are built in: nothing is loaded for them
#: What MATLAB writes, in this order; anything else could unpack a piece twice.
_KNOWN_FILTERS = {
    (*shuffled, *packed, *checked)
    for shuffled in ((), (_SHUFFLE,)) for packed in ((), (_DEFLATE,)) for checked in ((), (_CHECKSUM,))
}  # fmt: skip
_CHECKSUM_SIZE = 4  # bytes
_MAX_PIECE = 32_000_000  # bytes that one piece unpacks to
_MAX_PIECES = 50_000
_MAX_WORDS = 200_000
_MAX_ATTRIBUTES = 200  # of a group or dataset
_LONGEST_ATTRIBUTE = 100_000  # bytes
_DEEPEST = 3  # structs within structs
_AT_ONCE = 4_000_000  # bytes; other threads come in between


def by_matlab(file: Any) -> bool:
    """Whether variables say their MATLAB class, or there are MATLAB's cells."""
    return "#refs#" in file or any(
        "MATLAB_class" in file[key].attrs for key in list(file)[:20] if file.get(key) is not None
    )


class Hdf5Reader:
    """Datasets and groups to arrays, texts and mappings; counts what it reads."""

    def __init__(self, file: Any, name: str, data: bytes, *, by_matlab: bool) -> None:
        self._file = file
        self._by_matlab = by_matlab
        self._name = name
        self._size = len(data)
        self._allowance = Allowance(name, len(data))
        self._variables = 0
        self._pieces = 0
        self._words_seen = 0

    def group(self, group: Any, depth: int = 0) -> dict[str, Any]:
        """The members of a group (or struct) by name; links out of the file are not followed."""
        import h5py

        result: dict[str, Any] = {} if self._by_matlab else self._attributes(group)
        for key in group:
            self._variables += 1
            check_variables(self._variables, self._name)
            if key.startswith("#") or not isinstance(group.get(key, getlink=True), h5py.HardLink):
                continue
            member = group[key]
            kind = _text(member.attrs.get("MATLAB_class", b""))
            if "MATLAB_object_decode" in member.attrs:
                result[key] = Foreign(kind or "table or another object")
                continue
            if isinstance(member, h5py.Group):
                result[key] = self.group(member, depth + 1) if depth < _DEEPEST else None
            elif isinstance(member, h5py.Dataset) and self._by_matlab:
                result[key] = self._dataset(key, member, kind, depth)
            elif isinstance(member, h5py.Dataset):
                result |= self._plain(key, member)
        return result

    def _attributes(self, item: Any) -> dict[str, Any]:
        """Attributes as numbers, texts, lists of texts; a number with a unit is ``name [unit]``."""
        found: dict[str, Any] = {}
        for key in list(item.attrs)[:_MAX_ATTRIBUTES]:
            self._variables += 1
            check_variables(self._variables, self._name)
            if item.attrs.get_id(key).get_storage_size() > _LONGEST_ATTRIBUTE:
                continue
            value = item.attrs[key]
            if isinstance(value, (bytes, str)):
                found[key] = _text(value)
            elif isinstance(value, np.ndarray) and value.dtype.kind in "OSU" and value.ndim == 1:
                found[key] = [_text(word) for word in value]
            elif np.size(value) == 1 and np.asarray(value).dtype.kind in "biuf":
                found[key] = np.asarray(value, dtype=float).reshape(())
        for key in [key for key, value in found.items() if isinstance(value, np.ndarray)]:
            unit = unit_said(key, found)
            if unit is not None:
                found[f"{key} [{unit}]"] = found.pop(key)
        return found

    def _plain(self, key: str, dataset: Any) -> dict[str, Any]:
        """A dataset of another program: vectors with units, tables of named columns, texts."""
        attributes = self._attributes(dataset)
        unit = unit_among(key, attributes)
        if dataset.shape is None or dataset.dtype.kind not in "biufSOV":
            return {key: None}
        if dataset.dtype.kind in "SO":
            return self._words(key, dataset)
        if dataset.dtype.kind == "V":
            fields = dataset.dtype.names or ()
            if not all(
                dataset.dtype[field].kind in "biuf" and not dataset.dtype[field].shape for field in fields
            ):
                return {}
            table = self._read(key, dataset)
            units = units_of_columns(fields, attributes)
            columns = {_headed(f, u): table[f].astype(float) for f, u in zip(fields, units, strict=True)}
            return {key: _beside(attributes, columns)}
        values = packed_values(self._read(key, dataset), attributes)
        names = next((n for n in names_of_columns(attributes) if len(n) in values.shape), None)
        if values.ndim == 2 and names is not None:
            table = values if values.shape[1] == len(names) else values.T
            units = units_of_columns(names, attributes)
            columns = {_headed(n, u): table[:, i] for i, (n, u) in enumerate(zip(names, units, strict=True))}
            return {key: _beside(attributes, columns)}
        said = {k: v for k, v in attributes.items() if isinstance(v, str) and not names_units(k)}
        reference = next((v for v in said.values() if reference_of(v) is not None), None)
        head = _headed(key, unit)
        return {head if reference is None else f"{head} ({reference})": values}

    def _words(self, key: str, dataset: Any) -> dict[str, Any]:
        """A text, or a list of words."""
        import h5py

        if (
            h5py.check_string_dtype(dataset.dtype) is None
            or int(dataset.size) > _MAX_WORDS
            or (dataset.id.get_storage_size() > _MAX_PIECE or dataset.is_virtual or dataset.external)
        ):
            return {key: None}
        self._words_seen += int(dataset.size)
        if self._words_seen > _MAX_WORDS:
            raise self._refused(
                key, f"holds too many texts, at most {_MAX_WORDS} are read", "keep the readings only"
            )
        self._allowance.take(WORD * int(dataset.size), f"variable '{key}'")
        values = dataset[()]
        if isinstance(values, bytes):
            return {key: _text(values)[:1000]}
        return {key: [_text(word)[:1000] for word in np.asarray(values).reshape(-1)]}

    def _dataset(self, key: str, dataset: Any, kind: str, depth: int) -> Any:
        import h5py

        if "MATLAB_empty" in dataset.attrs or dataset.shape is None:
            return None
        if dataset.dtype == h5py.ref_dtype:
            return self._cell(key, dataset, depth)
        if dataset.dtype.kind not in "biuf":
            return None
        values = self._read(key, dataset)
        if kind == "char":
            return _characters(values)
        return values.T  # MATLAB keeps columns first

    def _cell(self, key: str, dataset: Any, depth: int) -> list[Any] | None:
        """A cell array, or a field of an array of structs; None = too deep, or texts that are too long."""
        import h5py

        self._words_seen += int(dataset.size)
        if self._words_seen > _MAX_WORDS:
            raise self._refused(
                key,
                f"holds {dataset.size} texts, at most {_MAX_WORDS} are read",
                "save the words as numbers, e.g. direction as -1 and 1",
            )
        words: list[Any] = []
        known: dict[Any, str] = {}
        for reference in self._read(key, dataset).reshape(-1):
            target = self._file[reference] if reference else None
            kind = _text(target.attrs.get("MATLAB_class", b"")) if target is not None else ""
            if kind != "char" or not isinstance(target, h5py.Dataset) or target.dtype.kind not in "iu":
                if target is None or depth >= _DEEPEST:
                    return None
                self._variables += 1
                check_variables(self._variables, self._name)
                is_group = isinstance(target, h5py.Group)
                words.append(
                    self.group(target, depth + 1) if is_group else self._dataset(key, target, kind, depth + 1)
                )
                continue
            if int(target.size or 0) > 1000:
                return None
            if target.id not in known:
                empty = "MATLAB_empty" in target.attrs
                known[target.id] = "" if empty else _characters(self._read(key, target))
            words.append(known[target.id])
            self._allowance.take(WORD, f"variable '{key}'")
        return words

    def _read(self, key: str, dataset: Any) -> np.ndarray:
        """The values of a dataset, which takes no more memory than its size says."""
        variable = f"variable '{key}'"
        self._allowance.take(max(8, dataset.dtype.itemsize) * int(dataset.size or 0), variable)
        plan = dataset.id.get_create_plist()
        filters = tuple(plan.get_filter(number)[0] for number in range(plan.get_nfilters()))
        if dataset.is_virtual or dataset.external or filters not in _KNOWN_FILTERS:
            raise self._refused(key, "is not kept in the file in a known way")
        if dataset.chunks is None or not dataset.size:
            return np.asarray(dataset[()])
        self._check_pieces(key, dataset, _DEFLATE in filters)
        return _in_parts(dataset)

    def _check_pieces(self, key: str, dataset: Any, packed: bool) -> None:
        """Refuse a dataset whose pieces unpack to more than they say."""
        size = prod(dataset.chunks) * dataset.dtype.itemsize
        if size > _MAX_PIECE:
            raise self._refused(key, f"is kept in pieces of {size} bytes, at most {_MAX_PIECE} are read")
        count = dataset.id.get_num_chunks()
        self._pieces += count
        if self._pieces > _MAX_PIECES:
            raise self._refused(
                key, f"is kept in {count} pieces, at most {_MAX_PIECES} of all variables are read"
            )
        if packed:
            places: list[Any] = []
            dataset.id.chunk_iter(places.append)
            for place in places:
                self._check_piece(key, dataset, place, size)

    def _check_piece(self, key: str, dataset: Any, place: Any, size: int) -> None:
        if place.size > self._size:
            raise self._refused(key, f"has a piece of {place.size} bytes, more than the file")
        skipped, content = dataset.id.read_direct_chunk(place.chunk_offset)
        if skipped:  # of its filters; MATLAB leaves none out
            raise self._refused(key, "is not kept in the file in a known way")
        unpacked = 0
        try:
            for piece in inflated(memoryview(content)):
                unpacked += len(piece)
                if unpacked > size + _CHECKSUM_SIZE:
                    raise self._refused(key, f"has a piece that unpacks to more than its {size} bytes")
        except zlib.error as error:
            raise self._refused(key, f"has a piece that cannot be unpacked ({error})") from error

    def _refused(self, key: str, why: str, hint: str = "save with -v7") -> InputError:
        return InputError(f"{self._name}: variable '{key}' {why}", field=f"variable {key}", hint=hint)


def _in_parts(dataset: Any) -> np.ndarray:
    """The values of a dataset that is kept in pieces, some whole pieces at a time."""
    values = np.empty(dataset.shape, dataset.dtype)
    axis = int(np.argmax(dataset.shape))
    step = dataset.chunks[axis]
    width = max(1, dataset.size // dataset.shape[axis] * dataset.dtype.itemsize * step)
    step *= max(1, _AT_ONCE // width)
    for begin in range(0, dataset.shape[axis], step):
        part = (*(slice(None),) * axis, slice(begin, begin + step))
        values[part] = dataset[part]
    return values


def _text(value: Any) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def _beside(attributes: dict[str, Any], columns: dict[str, Any]) -> dict[str, Any]:
    """The columns of a table with the single values that its attributes say."""
    said = {
        key: value
        for key, value in attributes.items()
        if not isinstance(value, list) and not names_units(key) and not key.startswith("FIELD_")
    }
    return {**said, **columns}


def _headed(name: str, unit: str | None) -> str:
    """A name with its unit, where it says none itself."""
    return (
        f"{name} [{unit}]" if unit and unit_of(unit) is not None and taken_apart(name).unit is None else name
    )


def _characters(codes: Any) -> str:
    """UTF-16 code units, column by column, as one text."""
    units = np.asarray(codes).T.reshape(-1, order="C")[:1000].astype("<u2")
    return units.tobytes().decode("utf-16-le", "replace")
