"""Options and reports: records of the C interface as keywords and as attributes."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _abi
from ._library import STATUS_NAMES, Handle, InvalidError, array, indices, lib, pointer

#: Fields that callers never set: sizes, spare room, and what `_calls` fills in.
_HIDDEN = frozenset({"struct_size", "reserved", "progress", "user", "cancel", "out_stage"})

#: The bytes of each record with its defaults; made once, copied after that (asking the library costs 10 us).
_DEFAULTS: dict[type, bytes] = {}


def _with_defaults(kind: type) -> ctypes.Structure:
    known = _DEFAULTS.get(kind)
    if known is None:
        record = kind()
        init = getattr(lib, f"{kind.__name__}_init", None)
        if init is None:
            record.struct_size = ctypes.sizeof(record)
        else:
            init(ctypes.addressof(record), ctypes.sizeof(record))
        _DEFAULTS[kind] = known = bytes(record)
    return kind.from_buffer_copy(known)


def option_names(record: str) -> tuple[str, ...]:
    """The keywords that fill the record `planish_<record>`."""
    kind = getattr(_abi, "planish_" + record)
    return tuple(name for name, _ in kind._fields_ if name not in _HIDDEN and not name.startswith("out_"))


def options(record: str, _given: Mapping[str, Any] | None = None, **values: Any) -> ctypes.Structure:
    """The record `planish_<record>` with its defaults, changed by keywords.

    Words stand for enumerators, sets of words for bits, arrays for pointers, mappings for records in the record.
    What it points to lives as long as the record.

    _given: what the user wrote: an unknown name is a TypeError that lists the known ones.
    values: what this package fills in.
    """
    kind = getattr(_abi, "planish_" + record)
    filled = _with_defaults(kind)
    filled._kept = []
    if _given:
        known = option_names(record)
        for name in _given:
            if name not in known:
                raise TypeError(f"unknown option {name!r}; there are: {', '.join(known)}")
        for name, value in _given.items():
            _set(filled, kind, name, value)
            count = f"{name}_count"
            if count in known and count not in _given and value is not None and not isinstance(value, int):
                setattr(filled, count, len(value))
    for name, value in values.items():
        _set(filled, kind, name, value)
    return filled


def _set(record: ctypes.Structure, kind: type, name: str, value: Any) -> None:
    if value is None:
        return  # the default
    choices, bits = getattr(kind, "choices", {}), getattr(kind, "bits", {})
    of = _types(kind)[name]
    if name in bits and not isinstance(value, (int, np.integer)):
        words = {value} if isinstance(value, str) else value
        value = sum(_enumerator(name, bits[name], word) for word in words)
    elif isinstance(value, str) and name in choices:
        value = _enumerator(name, choices[name], value)
    elif isinstance(value, str):
        value = value.encode()
    elif isinstance(value, Mapping):
        value = options(_record_behind(kind, name), value)
    if isinstance(value, Handle):
        record._kept.append(value)
        value = value._as_parameter_
    elif isinstance(value, ctypes.Structure):
        record._kept.append(value)
        value = ctypes.addressof(value)
    elif of is ctypes.c_void_p and not isinstance(value, int):
        value = _array_of(kind, name, value)
        record._kept.append(value)
        value = pointer(value)
    elif isinstance(value, (bool, np.bool_)):
        value = int(value)
    elif hasattr(of, "_length_"):
        value = of(*value)
    try:
        setattr(record, name, value)
    except TypeError as error:
        raise TypeError(f"option {name}: {error}") from None


def _types(kind: type) -> dict[str, Any]:
    types = kind.__dict__.get("_types")
    if types is None:
        types = kind._types = dict(kind._fields_)
    return types


def _enumerator(option: str, enumeration: str, word: str) -> int:
    words = _abi.ENUMERATIONS[enumeration]
    if word not in words:
        raise InvalidError(f"{option} is {word!r}; the choices are {', '.join(map(repr, words))}")
    return words[word]


def _record_behind(kind: type, name: str) -> str:
    """Which record a pointer in a record names: its own name, if there is such a record."""
    candidate = f"{name}_options"
    if hasattr(_abi, "planish_" + candidate):
        return candidate
    raise TypeError(f"option {name} of {kind.__name__} takes no mapping")


def _array_of(kind: type, name: str, value: Any) -> np.ndarray:
    """The array behind a pointer. Numbers of nodes, edges and triangles travel as uint32, all else as doubles."""
    element = getattr(kind, "elements", {}).get(name, ctypes.c_double)
    if isinstance(value, np.ndarray) and value.dtype == np.dtype(element):
        if value.flags.c_contiguous and value.flags.aligned:
            return value
    if element is ctypes.c_uint32:
        return indices(value, what=name)
    return array(value, np.dtype(element), what=name)


class Report(_abi.ReportFields):
    """The numbers of a report, by the names they have in C; `remarks` is a frozenset of words.

    ``status`` tells how the call went: "ok", or a remark such as "tolerance_not_met". ``ok`` is whether it is "ok".
    What is said below of arrays holds for the calls whose text names them.
    """

    #: The error of each datum, and where it lies in the parameter plane.
    errors: np.ndarray
    uv: np.ndarray
    #: The face of a model on which each node lies.
    faces: np.ndarray
    #: The distance of each node with its sign, positive outside.
    signed: np.ndarray
    #: Numbers of the data that were left out as gross errors.
    left_out: np.ndarray
    #: The plane of symmetry: a place and the normal.
    plane: tuple[np.ndarray, np.ndarray]
    #: What there is to say of skins alone.
    skin: Report

    def __init__(self, record: ctypes.Structure, status: int = 0):
        kind = type(record)
        choices, bits = getattr(kind, "choices", {}), getattr(kind, "bits", {})
        self.status = STATUS_NAMES.get(status, str(status))
        for name, _ in kind._fields_:
            if name in _HIDDEN or name.startswith("reserved"):
                continue
            value = getattr(record, name)
            if name in bits:
                words = _abi.ENUMERATIONS[bits[name]]
                value = frozenset(word for word, bit in words.items() if value & bit)
            elif name in choices:
                words = _abi.ENUMERATIONS[choices[name]]
                value = next((word for word, number in words.items() if number == value), value)
            elif hasattr(value, "_length_"):
                value = tuple(value)
            setattr(self, name, value)

    @property
    def ok(self) -> bool:
        """Whether there is nothing to remark."""
        return self.status == "ok"

    def _rows(self) -> list[tuple[str, str]]:
        def text(value: Any) -> str:
            if isinstance(value, float):
                return f"{value:.6g}"
            if isinstance(value, frozenset):
                return ", ".join(sorted(value)) or "none"
            if isinstance(value, np.ndarray):
                return f"array of shape {value.shape}"
            return str(value)

        return [(name.replace("_", " "), text(value)) for name, value in vars(self).items()]

    def __repr__(self) -> str:
        return "Report(" + ", ".join(f"{name}: {text}" for name, text in self._rows()) + ")"

    def _repr_html_(self) -> str:
        import html

        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td style='text-align:right'>{html.escape(text)}</td></tr>"
            for name, text in self._rows()
        )
        return f"<table>{rows}</table>"


def report_record(record: str) -> ctypes.Structure:
    """An empty report for the library to fill."""
    kind = getattr(_abi, "planish_" + record)
    filled = kind()
    filled.struct_size = ctypes.sizeof(filled)
    return filled


def by_reference(record: ctypes.Structure | None) -> Any:
    """How a record is passed: by a reference that keeps it alive, which its bare address would not."""
    return None if record is None else ctypes.byref(record)
