"""Long calls: progress, Ctrl-C and cancelling.

A call that may take over a second runs on a worker thread while the main thread waits in slices, so that Ctrl-C arrives.
It then raises the library's cancel flag, waits until the library is back (within 50 ms, or when a factorization ends)
and raises KeyboardInterrupt: nothing was changed. What a progress callback raises travels the same way.
"""

from __future__ import annotations

import ctypes
import inspect
import threading
from collections.abc import Callable
from typing import Any

from . import _abi
from ._library import Cancelled, call

#: How long the main thread waits before it looks for a key press, in seconds.
_SLICE = 0.05

#: A callback ``progress(fraction, error, stage)`` or ``progress(fraction, error)``; False cancels. The error is NaN until it
#: is in model units; the stage is a word such as "solve".
ProgressCallback = Callable[..., Any]

_STAGES = {number: word for word, number in _abi.ENUMERATIONS["planish_stage"].items()}


def _hears_stage(function: ProgressCallback | None) -> bool:
    """Whether a callback takes three arguments; one that cannot say takes two."""
    try:
        inspect.signature(function).bind(0.0, 0.0, "")
    except (TypeError, ValueError):
        return False
    return True


class LongCall:
    """One long call: fills the fields `progress` and `cancel` of its options, runs it, and brings back what it raised."""

    def __init__(self, progress: ProgressCallback | None = None):
        self._function = progress
        self._raised: BaseException | None = None
        self._flag = ctypes.c_int32(0)
        self._stage = ctypes.c_uint32(0)
        self._hears_stage = _hears_stage(progress)
        self._callback = _abi.planish_progress(self._hear)

    def fields(self, record: str) -> dict[str, Any]:
        """What to fill into the options of the call."""
        names = {name for name, _ in getattr(_abi, "planish_" + record)._fields_}
        filled: dict[str, Any] = {}
        if "cancel" in names:
            filled["cancel"] = ctypes.addressof(self._flag)
        if "out_stage" in names and self._hears_stage:
            filled["out_stage"] = ctypes.addressof(self._stage)
        if "progress" in names and (self._function is not None or "cancel" not in names):
            filled["progress"] = self._callback
        return filled

    def cancel(self) -> None:
        """Ends the call soon; any thread may say so."""
        self._flag.value = 1

    def _hear(self, fraction: float, error: float, _user: Any) -> int:
        """What the library calls."""
        if self._flag.value:
            return 1
        try:
            if self._function is None:
                return 0
            stage = (_STAGES.get(self._stage.value, ""),) if self._hears_stage else ()
            return int(self._function(fraction, error, *stage) is False)
        except BaseException as raised:  # it cannot pass through the library
            self._raised = raised
            return 1

    def __call__(self, name: str, *arguments: Any) -> int:
        """Runs the call; returns its status if that is no error."""
        if threading.current_thread() is not threading.main_thread():
            return self._finish(self._attempt(name, arguments))
        result: list[int | BaseException] = []
        worker = threading.Thread(target=lambda: result.append(self._attempt(name, arguments)), name="planish")
        worker.start()
        interrupt: BaseException | None = None
        while worker.is_alive():
            try:
                worker.join(_SLICE)
            except BaseException as raised:  # KeyboardInterrupt, or what another signal raises
                interrupt = raised
                self.cancel()
        if interrupt is not None:
            raise interrupt
        return self._finish(result[0])

    def _attempt(self, name: str, arguments: tuple[Any, ...]) -> int | BaseException:
        """Calls on this thread, since the error message is the thread's."""
        try:
            return call(name, *arguments)
        except BaseException as raised:
            return raised

    def _finish(self, result: int | BaseException) -> int:
        if isinstance(result, Cancelled) and self._raised is not None:
            raise self._raised
        if isinstance(result, BaseException):
            raise result
        return result
