"""Arrays of a simulation in place: NumPy arrays that know whether they are still the simulation's."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np


class View(np.ndarray):
    """An array of a simulation, without a copy: it shows what is there now, step after step.

    It keeps the simulation alive. Once grains change their rows (they are sorted by place now and then, added, removed),
    whatever is done with it raises StaleView: take it anew from the simulation. What is made of it (sums, copies, rows
    by a mask) are arrays of their own, which stay; slices are views like itself. What NumPy hands out as a plain array,
    np.asarray(view), is not told: its memory stays, and has NaN in it (-1, of whole numbers) once it is no longer the
    simulation's. While another thread steps the simulation, looking raises Busy.
    """

    _lent: Any

    @classmethod
    def of(cls, lent: Any, is_writable: bool) -> View:
        """@param lent the compiled part's LentArray"""
        array = lent.array
        if not is_writable:
            array.flags.writeable = False
        view = array.view(cls)
        view._lent = lent
        return view

    def __array_finalize__(self, parent: Any) -> None:
        # Made by NumPy out of another one: a slice is still the simulation's memory, a copy is not.
        lent = parent.__dict__.get("_lent") if isinstance(parent, View) else None
        self.__dict__["_lent"] = lent if lent is not None and not owns_memory(self) else None

    def __getattribute__(self, name: str) -> Any:
        if name not in UNCHECKED:
            check(self)
        return super().__getattribute__(name)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        out = options.get("out")
        if out is not None:
            options["out"] = tuple(plain(one) for one in out)
        result = getattr(ufunc, method)(*map(plain, inputs), **{name: plain(value) for name, value in options.items()})
        if out is None:
            return result
        return out[0] if len(out) == 1 else out

    def __array_function__(self, function: Any, types: Any, arguments: Any, options: Any) -> Any:
        check_all(arguments)
        check_all(options.values())
        return super().__array_function__(function, types, arguments, options)

    def __repr__(self) -> str:
        lent = self.__dict__["_lent"]
        if lent is not None and not lent.is_current:
            return f"<view of '{lent.name}', no longer of the simulation>"
        return repr(plain(self))

    def __reduce__(self) -> Any:  # of pickles and deep copies: an array of its own
        return plain(self).copy().__reduce__()


UNCHECKED = frozenset({"__class__", "__dict__", "_lent", "__array_finalize__", "__array_ufunc__", "__array_function__",
                       "__repr__", "__reduce__", "__reduce_ex__"})


def owns_memory(array: np.ndarray) -> bool:
    """Whether an array's numbers, or those that it is a slice of, are a copy that NumPy has made."""
    base: Any = array
    while isinstance(base, np.ndarray):
        if np.ndarray.flags.__get__(base).owndata:
            return True
        base = np.ndarray.base.__get__(base)
    return base is None


def check(view: Any) -> None:
    lent = view.__dict__["_lent"]
    if lent is not None:
        lent.check()


def check_all(arguments: Iterable[Any]) -> None:
    for one in arguments:
        if isinstance(one, View):
            check(one)
        elif isinstance(one, (list, tuple)):
            check_all(one)


def plain(value: Any) -> Any:
    """A view as the array that NumPy works on, checked; all else as it is."""
    if not isinstance(value, View):
        return value
    check(value)
    return np.ndarray.view(value, np.ndarray)


def checked(name: str) -> Callable[..., Any]:
    """What Python calls without asking for an attribute."""
    original = getattr(np.ndarray, name)

    def call(self: View, *arguments: Any, **options: Any) -> Any:
        check(self)
        return original(self, *arguments, **options)

    call.__name__, call.__doc__ = name, original.__doc__
    return call


for _name in ("__getitem__", "__setitem__", "__iter__", "__len__", "__contains__", "__bool__", "__float__", "__int__",
              "__complex__", "__index__", "__str__", "__format__", "__copy__", "__deepcopy__", "__matmul__",
              "__rmatmul__", "__imatmul__", "__eq__", "__ne__"):
    if hasattr(np.ndarray, _name):
        setattr(View, _name, checked(_name))
