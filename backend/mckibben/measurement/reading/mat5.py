"""Variables of MATLAB files v5 to v7, by the published layout of the format (MAT-File Format, MathWorks).

Every length is checked before it is used, so a damaged file is refused and no memory is taken on its word.
What the compressed variables unpack to is known before the first is unpacked; unpacking stops at that size.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from math import prod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.reading.limits import WORD, Allowance, check_variables, inflated

HEADER = 128  # bytes before the first element
_MAX_DEPTH = 4
_MAX_DIMENSIONS = 32
_LONGEST_TEXT = 64_000_000  # bytes; a longer one is neither a condition nor a column of words
_LONGEST_NAME = 1000  # bytes; MATLAB's own end at 63
_TAG = 8  # bytes before the data of an element
_HEAD = 4096  # bytes of a compressed element in which its tag must be
_NUMBERS = {
    1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8",
}  # fmt: skip
_TEXTS = {16: "utf-8", 17: "utf-16", 18: "utf-32"}
_MATRIX, _COMPRESSED = 14, 15
_CELL, _STRUCT, _OBJECT, _CHAR, _SPARSE, _FUNCTION, _OPAQUE = 1, 2, 3, 4, 5, 16, 17
_NUMERIC = range(6, 16)
_COMPLEX = 0x0800


class DamagedError(ValueError):
    """Why a file cannot be read, as the end of a sentence."""


class Foreign(NamedTuple):
    """A variable that is a table, another object or a function: only its name is known."""

    kind: str


class _Element(NamedTuple):
    kind: int
    data: memoryview


def read_variables(data: bytes, file: str) -> dict[str, Any]:
    """Name -> array of numbers, text, list of values, mapping of fields, ``Foreign``, or None for the rest.

    Args:
        data: the file's bytes.
        file: its name, for the refusal of one that is too large.

    Raises:
        DamagedError: the file is not complete, or does not hold what it says.
        InputError: it unpacks to more than is read.
    """
    if len(data) < HEADER or data[126:128] not in (b"IM", b"MI"):
        raise DamagedError("the header is not complete")
    order = "<" if data[126:128] == b"IM" else ">"
    reader = _Mat5Reader(order, file, len(data))
    elements = []
    for element in reader.elements(memoryview(data)[HEADER:], "the file"):
        elements.append(element)
        check_variables(len(elements), file)
    if not elements:
        raise DamagedError("it holds no variable")
    sizes = [reader.unpacked_size(element, number) for number, element in enumerate(elements, start=1)]
    Allowance(file, len(data)).take(sum(sizes), f"variables 1 to {len(sizes)}")
    variables: dict[str, Any] = {}
    for number, (element, size) in enumerate(zip(elements, sizes, strict=True), start=1):
        if element.kind == _COMPRESSED:
            element = reader.unpacked(element, number, size)
        if element.kind != _MATRIX:
            raise DamagedError(f"variable {number} is of the unknown type {element.kind}")
        name, value = reader.matrix(element.data, f"variable {number}", 0)
        if name:  # the nameless one holds what objects are made of
            variables[name] = value
    return variables


class _Mat5Reader:
    """Elements of one byte order."""

    def __init__(self, order: str, file: str, size: int) -> None:
        self._order = order
        self._file = file
        self._allowance = Allowance(file, size)  # of the values, which may be written shorter than they are
        self._fields_seen = 0

    def elements(self, data: memoryview, where: str) -> Iterator[_Element]:
        """The elements that follow each other in some bytes."""
        position = 0
        while position < len(data):
            if position + 8 > len(data):
                raise DamagedError(f"{where} ends within an element")
            kind, size = struct.unpack_from(f"{self._order}II", data, position)
            if kind >> 16:  # a small element: type and size in one word, the data in the other
                kind, size = kind & 0xFFFF, kind >> 16
                if size > 4:
                    raise DamagedError(f"{where} holds a small element of {size} bytes")
                yield _Element(kind, data[position + 4 : position + 4 + size])
                position += 8
                continue
            begin, position = position + 8, position + 8 + size
            if position > len(data):
                raise DamagedError(f"{where} ends within an element")
            yield _Element(kind, data[begin:position])
            if kind != _COMPRESSED:
                position += -size % 8

    def unpacked_size(self, element: _Element, number: int) -> int:
        """Bytes of an element once it is unpacked, by what it says of itself."""
        if element.kind != _COMPRESSED:
            return len(element.data)
        try:
            head = zlib.decompressobj().decompress(bytes(element.data[:_HEAD]), _TAG)
        except zlib.error as error:
            raise DamagedError(f"variable {number} cannot be unpacked") from error
        if len(head) < _TAG:
            raise DamagedError(f"variable {number} is empty")
        kind, size = struct.unpack_from(f"{self._order}II", head)
        return _TAG if kind >> 16 else _TAG + size

    def unpacked(self, element: _Element, number: int, size: int) -> _Element:
        """The element inside a compressed one, of which it says that it has this size."""
        content = bytearray(size)
        end = 0
        try:
            for piece in inflated(element.data):
                if end + len(piece) > size + _TAG:  # it may be filled up to whole words
                    raise DamagedError(f"variable {number} unpacks to more than the {size} bytes it says")
                content[end : end + len(piece)] = piece
                end += len(piece)
        except zlib.error as error:
            raise DamagedError(f"variable {number} cannot be unpacked") from error
        if end < size:
            raise DamagedError(f"variable {number} is not complete")
        inner = next(self.elements(memoryview(content), f"variable {number}"), None)
        if inner is None:
            raise DamagedError(f"variable {number} is empty")
        return inner

    def matrix(self, data: memoryview, where: str, depth: int) -> tuple[str, Any]:
        """(name, value) of a matrix element."""
        if not data:
            return "", np.empty(0)
        parts = self.elements(data, where)
        flags = self._numbers(self._next(parts, where), where)
        if flags.dtype.kind not in "iu" or len(flags) < 1:
            raise DamagedError(f"{where} has no flags")
        kind, is_complex = int(flags[0]) & 0xFF, bool(int(flags[0]) & _COMPLEX)
        if kind == _OPAQUE:
            return self._text(self._next(parts, where)), Foreign("table or another object")
        sizes = self._numbers(self._next(parts, where), where)
        shape = tuple(int(size) for size in sizes[: _MAX_DIMENSIONS + 1])
        if not 2 <= len(shape) <= _MAX_DIMENSIONS or min(shape) < 0:
            raise DamagedError(f"{where} has the size {'x'.join(map(str, shape[:4]))}")
        name = self._text(self._next(parts, where))
        where = f"variable '{name}'" if name and depth == 0 else where
        if kind in (_OBJECT, _FUNCTION):
            return name, Foreign("object" if kind == _OBJECT else "function")
        if kind in _NUMERIC:
            values = self._numbers(self._next(parts, where), where)
            self._allowance.take(8 * len(values), where)
            if len(values) != prod(shape):
                raise DamagedError(
                    f"{where} holds {len(values)} numbers, its size is {'x'.join(map(str, shape))}"
                )
            return name, None if is_complex else values.reshape(shape, order="F")
        if kind == _CHAR:
            return name, self._characters(self._next(parts, where) if prod(shape) else None, shape, where)
        if kind in (_CELL, _STRUCT) and depth < _MAX_DEPTH:
            read = self._cells if kind == _CELL else self._fields
            return name, read(parts, prod(shape), where, depth)
        if kind in (_SPARSE, _CELL, _STRUCT):
            return name, None
        raise DamagedError(f"{where} is of the unknown class {kind}")

    def _next(self, parts: Iterator[_Element], where: str) -> _Element:
        part = next(parts, None)
        if part is None:
            raise DamagedError(f"{where} is not complete")
        return part

    def _numbers(self, element: _Element, where: str) -> NDArray:
        code = _NUMBERS.get(element.kind)
        if code is None:
            raise DamagedError(f"{where} holds values of the unknown type {element.kind}")
        dtype = np.dtype(self._order + code)
        if len(element.data) % dtype.itemsize:
            raise DamagedError(f"{where} ends within a number")
        return np.frombuffer(element.data, dtype).astype(dtype.newbyteorder("="), copy=False)

    def _text(self, element: _Element) -> str:
        if len(element.data) > _LONGEST_NAME:
            raise DamagedError(f"a name has {len(element.data)} characters")
        return bytes(element.data).rstrip(b"\0").decode("latin-1")

    def _characters(
        self, element: _Element | None, shape: tuple[int, ...], where: str
    ) -> str | list[str] | None:
        """The text, or one text per row; None = longer than any that is used."""
        if element is None:
            return ""
        if len(element.data) > _LONGEST_TEXT:
            return None
        rows, size = shape[0], prod(shape)
        if element.kind in _TEXTS:
            suffix = "" if element.kind == 16 else ("-le" if self._order == "<" else "-be")
            text = bytes(element.data).decode(_TEXTS[element.kind] + suffix, "replace")
            length = len(text)
        else:
            codes = self._numbers(element, where)
            if codes.dtype.kind not in "iu" or np.any((codes < 0) | (codes > 0xFFFF)):
                raise DamagedError(f"{where} holds something other than text")
            text = codes.astype("<u2").tobytes().decode("utf-16-le", "replace")
            length = len(codes)
        if length != size:
            raise DamagedError(f"{where} holds {length} characters, its size is {'x'.join(map(str, shape))}")
        self._allowance.take(4 * size + WORD * rows, where)
        if rows <= 1:
            return text
        return None if len(text) != size else [text[row::rows].rstrip() for row in range(rows)]

    def _cells(self, parts: Iterator[_Element], count: int, where: str, depth: int) -> list[Any]:
        """A cell array, column by column."""
        values = []
        for _ in range(count):
            self._allowance.take(WORD, where)
            values.append(self.matrix(self._next(parts, where).data, where, depth + 1)[1])
        return values

    def _fields(self, parts: Iterator[_Element], count: int, where: str, depth: int) -> Any:
        """The fields of a struct; of an array of structs a list of them."""
        width = self._numbers(self._next(parts, where), where)
        if len(width) != 1 or not 0 < int(width[0]) <= 1024:
            raise DamagedError(f"{where} has no field names")
        size, content = int(width[0]), bytes(self._next(parts, where).data)
        names = [
            content[begin : begin + size].partition(b"\0")[0].decode("latin-1")
            for begin in range(0, len(content) // size * size, size)
        ]
        structs = []
        for _ in range(count):
            self._fields_seen += max(1, len(names))
            check_variables(self._fields_seen, self._file)
            structs.append(
                {
                    name: self.matrix(self._next(parts, where).data, f"{where}, field '{name}'", depth + 1)[1]
                    for name in names
                }
            )
        return structs[0] if count == 1 else structs


def without_foreign(values: dict[str, Any]) -> dict[str, Any]:
    """The values without objects, at any depth."""
    result: dict[str, Any] = {}
    for key, value in values.items():
        if isinstance(value, dict):
            result[key] = _struct_array(without_foreign(value))
        elif isinstance(value, list):
            result[key] = [without_foreign(item) if isinstance(item, dict) else item for item in value]
        elif not isinstance(value, Foreign):
            result[key] = value
    return result


def _struct_array(fields: dict[str, Any]) -> Any:
    """An array of structs that is kept field by field, as v7.3 does, struct by struct."""
    lists = [value for value in fields.values() if isinstance(value, list)]
    if not lists or len(lists) != len(fields) or any(isinstance(v, str) for v in lists[0]):
        return fields
    count = len(lists[0])
    if count < 2 or any(len(value) != count for value in lists):
        return fields
    return [{key: value[number] for key, value in fields.items()} for number in range(count)]
