"""Measurements from MATLAB files v7.3, which are HDF5: vectors by variable name, or one struct of vectors."""

from __future__ import annotations

import io
from typing import Any

import numpy as np

from mckibben.measurement.read.mat import choose
from mckibben.measurement.read.mat5 import Foreign
from mckibben.measurement.read.source import RawTable
from mckibben.physics.errors import InputError

_MAX_VARIABLES = 2000
_MAX_VALUES = 64_000_000  # 512 MB as double
_KNOWN_FILTERS = {1, 2, 3}  # deflate, shuffle, checksum: built in, nothing is loaded for them


def open_mat73(data: bytes, name: str) -> RawTable:
    """The table of a MATLAB v7.3 file.

    Raises:
        InputError: damaged, or without vectors that are named like channels.
    """
    import h5py

    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            values = _Reader(file, name).group(file)
    except InputError:
        raise
    except Exception as error:  # h5py raises whatever a damaged file leads to
        raise InputError(
            f"{name}: no variable can be read: the MATLAB 7.3 file is damaged "
            f"({type(error).__name__}: {str(error)[:100]})",
            field="file", hint="save it again with -v7",
        ) from error  # fmt: skip
    return choose(values, name)


class _Reader:
    """Datasets and groups to arrays, texts and mappings; counts what it reads."""

    def __init__(self, file: Any, name: str) -> None:
        self._file = file
        self._name = name
        self._values = 0
        self._variables = 0

    def group(self, group: Any, depth: int = 0) -> dict[str, Any]:
        """The members of a group (or struct) by name; links out of the file are not followed."""
        import h5py

        result: dict[str, Any] = {}
        for key in group:
            self._variables += 1
            if self._variables > _MAX_VARIABLES:
                raise InputError(
                    f"{self._name}: more than {_MAX_VARIABLES} variables",
                    field="variables",
                    hint="save fewer",
                )
            if key.startswith("#") or not isinstance(group.get(key, getlink=True), h5py.HardLink):
                continue
            member = group[key]
            kind = _text(member.attrs.get("MATLAB_class", b""))
            if "MATLAB_object_decode" in member.attrs:
                result[key] = Foreign(kind or "table or another object")
                continue
            if isinstance(member, h5py.Group):
                result[key] = self.group(member, depth + 1) if depth < 3 else None
            elif isinstance(member, h5py.Dataset):
                result[key] = self._dataset(key, member, kind)
        return result

    def _dataset(self, key: str, dataset: Any, kind: str) -> Any:
        import h5py

        if "MATLAB_empty" in dataset.attrs or dataset.shape is None:
            return None
        self._values += int(dataset.size or 0)
        plan = dataset.id.get_create_plist()
        filters = {plan.get_filter(number)[0] for number in range(plan.get_nfilters())}
        if (
            dataset.is_virtual
            or dataset.external
            or not filters <= _KNOWN_FILTERS
            or self._values > _MAX_VALUES
        ):
            why = "is too large" if self._values > _MAX_VALUES else "is not kept in the file in a known way"
            raise InputError(
                f"{self._name}: variable '{key}' {why}", field=f"variable {key}", hint="save with -v7"
            )
        if dataset.dtype == h5py.ref_dtype:
            return self._words(dataset)
        if dataset.dtype.kind not in "biuf":
            return None
        values = np.asarray(dataset[()])
        if kind == "char":
            return _characters(values)
        return values.T  # MATLAB keeps columns first

    def _words(self, dataset: Any) -> list[str] | None:
        """A cell array of texts; None = of something else."""
        import h5py

        words = []
        for reference in np.asarray(dataset[()]).reshape(-1):
            target = self._file[reference] if reference else None
            if not isinstance(target, h5py.Dataset) or int(target.size or 0) > 1000:
                return None
            if _text(target.attrs.get("MATLAB_class", b"")) != "char":
                return None
            words.append("" if "MATLAB_empty" in target.attrs else _characters(np.asarray(target[()])))
        return words


def _text(value: Any) -> str:
    return value.decode("latin-1") if isinstance(value, bytes) else str(value)


def _characters(codes: Any) -> str:
    """UTF-16 code units, column by column, as one text."""
    units = np.asarray(codes).T.reshape(-1, order="C")[:1000].astype("<u2")
    return units.tobytes().decode("utf-16-le", "replace")
