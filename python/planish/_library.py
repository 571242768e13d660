"""Loads the shared library and speaks its conventions: statuses, error messages, arrays.

Everything here follows from `include/planish.h`: a status below 0 is an error and leaves all outputs as they were, a
positive one is a success with a remark.
"""

from __future__ import annotations

import ctypes
import os
import sys
from typing import Any, TypeVar

import numpy as np

from . import _abi

_FILE_NAMES = {"darwin": "libplanish.dylib", "win32": "planish.dll"}


def _load() -> ctypes.CDLL:
    """The library beside this file; PLANISH_LIBRARY names another one, for those who build their own."""
    name = _FILE_NAMES.get(sys.platform, "libplanish.so")
    own = os.path.join(os.path.dirname(__file__), name)
    path = os.environ.get("PLANISH_LIBRARY") or (own if os.path.exists(own) else name)
    library = ctypes.CDLL(path)
    library.planish_version.restype = ctypes.c_char_p
    found = library.planish_version().decode()
    major, minor, _ = map(int, _abi.VERSION.split("."))
    check = getattr(library, "planish_check_version", None)
    if check is None or check(ctypes.c_uint32(major), ctypes.c_uint32(minor)) != 0:
        raise ImportError(f"{path} is planish {found}, this package needs {_abi.VERSION}")
    _abi.declare(library)
    return library


lib = _load()

#: The names of the statuses in lower case, by number.
STATUS_NAMES = {number: name for name, number in _abi.ENUMERATIONS["planish_status"].items()}


class Error(RuntimeError):
    """A call failed; nothing was changed.

    ``status`` is the name of the status in lower case ("not_finite"), ``index`` the number of the offending node,
    triangle, row or byte, or None. Each error is also what Python programs already catch: a ValueError, an IndexError,
    an OSError or a MemoryError.
    """

    def __init__(self, message: str, status: str = "invalid_argument", index: int | None = None):
        super().__init__(message)
        self.status = status
        self.index = index

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.status, self.index)


class InvalidError(Error, ValueError):
    """An argument, or the data in it, cannot be used."""


class RangeError(Error, IndexError):
    """A number names something that does not exist."""


class FileError(Error, OSError):
    """A file cannot be read or written."""

    __str__ = RuntimeError.__str__


class OutOfMemoryError(Error, MemoryError):
    """Memory for this is not to be had."""


class Cancelled(Error):
    """A callback, a key press or another thread ended the call."""


_CLASSES = {
    "null_pointer": InvalidError,
    "invalid_argument": InvalidError,
    "not_finite": InvalidError,
    "index": RangeError,
    "topology": InvalidError,
    "degenerate": InvalidError,
    "outside": InvalidError,
    "singular": InvalidError,
    "wrong_kind": InvalidError,
    "buffer_too_small": InvalidError,
    "too_large": InvalidError,
    "file": FileError,
    "format": FileError,
    "version": InvalidError,
    "cancelled": Cancelled,
    "out_of_memory": OutOfMemoryError,
}


def failure(status: int) -> Error:
    """This thread's last failure as an exception."""
    text = ctypes.create_string_buffer(lib.planish_error_message(None, 0) + 1)
    lib.planish_error_message(ctypes.addressof(text), len(text))
    index = lib.planish_error_index()
    name = STATUS_NAMES.get(status, str(status))
    message = text.value.decode("utf-8", "replace")
    return _CLASSES.get(name, Error)(message, name, None if index < 0 else index)


def call(name: str, *arguments: Any) -> int:
    """Calls a function that returns a status: remarks (positive) are returned, errors raised."""
    status = getattr(lib, name)(*arguments)
    if status < 0:
        raise failure(status)
    return status


#: Stands among the arguments of :func:`made` where the new handle goes.
OUT = object()


def made(name: str, *arguments: Any, run: Any = call) -> tuple[int, ctypes.c_void_p]:
    """Calls a function that makes a handle; returns its status and the handle."""
    out = ctypes.c_void_p()
    status = run(name, *(ctypes.byref(out) if argument is OUT else argument for argument in arguments))
    return status, out


def array(values: Any, dtype: Any = np.float64, width: int | None = None, what: str = "the array") -> np.ndarray:
    """C-contiguous, aligned and of this type; no copy of what is so already. With `width` the last axis must have that length."""
    values = np.ascontiguousarray(values, dtype)
    if not values.flags.aligned:  # as arrays are that lie in a message or a mapped file
        values = values.copy()
    if width is not None and (values.ndim == 0 or values.shape[-1] != width):
        raise InvalidError(f"{what} needs rows of {width} numbers, its shape is {values.shape}")
    return values


def indices(values: Any, width: int | None = None, what: str = "the array") -> np.ndarray:
    """Numbers of nodes, triangles and the like as the library takes them; what is negative or no integer is refused."""
    values = np.asarray(values)
    if values.dtype != np.uint32:
        if values.size and not np.issubdtype(values.dtype, np.integer):
            raise InvalidError(f"{what} needs whole numbers, got {values.dtype}")
        if values.size and (values.min() < 0 or values.max() > 0xFFFF_FFFF):
            raise InvalidError(f"{what} has numbers outside 0 to 4294967295")
    return array(values, np.uint32, width, what)


def output(out: np.ndarray | None, shape: tuple[int, ...], dtype: Any = np.float64) -> np.ndarray:
    """The caller's array, checked, or a new one."""
    if out is None:
        return np.empty(shape, dtype)
    if out.shape != shape or out.dtype != dtype or not out.flags.c_contiguous or not out.flags.writeable:
        raise InvalidError(f"out must be a writeable C-contiguous array of {np.dtype(dtype)} and shape {shape}")
    return out


def pointer(values: np.ndarray | None) -> int | None:
    """Where an array begins; NULL for None."""
    return None if values is None else values.__array_interface__["data"][0]


_bytes_at = (ctypes.c_char * 0).from_buffer


def argument(values: np.ndarray) -> Any:
    """The same as an argument of a call, in less time; it cannot be kept in a record."""
    try:
        return _bytes_at(values)
    except (TypeError, ValueError):  # read-only
        return pointer(values)


def read_only(values: np.ndarray) -> np.ndarray:
    """A copy of what the library keeps: writing to it would change nothing, so it cannot be written to."""
    values.flags.writeable = False
    return values


def text_of(function: str, *arguments: Any) -> str:
    """A text that is asked for its length first."""
    ask = getattr(lib, function)
    text = ctypes.create_string_buffer(ask(*arguments, None, 0) + 1)
    ask(*arguments, ctypes.addressof(text), len(text))
    return text.value.decode("utf-8", "replace")


def path_of(path: str | os.PathLike) -> bytes:
    """A path as the library takes it."""
    return os.fsencode(path)


_Handle = TypeVar("_Handle", bound="Handle")


class Handle:
    """Owns one handle of the library; freed by `close`, by `with`, or with the object."""

    _free = ""
    __slots__ = ("_handle", "__weakref__", "__dict__")

    def __init__(self, handle: ctypes.c_void_p):
        self._handle = handle.value

    @classmethod
    def _own(cls, handle: ctypes.c_void_p) -> Any:
        new = cls.__new__(cls)
        Handle.__init__(new, handle)
        return new

    @property
    def _as_parameter_(self) -> int:
        """What ctypes passes for this object."""
        if not self._handle:
            raise InvalidError(f"this {type(self).__name__} is closed")
        return self._handle

    def close(self) -> None:
        """Frees the memory now; the object cannot be used any more. Closing twice is fine."""
        handle, self._handle = getattr(self, "_handle", None), None
        if handle:
            getattr(lib, self._free)(handle)

    def __del__(self) -> None:
        self.close()

    def __enter__(self: _Handle) -> _Handle:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()
