"""Checks of the types of arguments. What their values have to be the library says."""
from __future__ import annotations

import inspect
import numbers
import os
from collections.abc import Callable, Iterable
from typing import Any

import numpy


def plain(value: Any) -> Any:
    """NumPy's arrays of no dimension are the number that they have."""
    return value[()] if isinstance(value, numpy.ndarray) and value.ndim == 0 else value


def integral(name: str, value: Any) -> int:
    value = plain(value)
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{name} is a whole number, not {type(value).__name__}")
    return int(value)


def whole(name: str, value: Any) -> int:
    """A number that the library can hold."""
    number = integral(name, value)
    if not -2**31 <= number < 2**31:
        raise ValueError(f"{name}: {number} is too large")
    return number


def real(name: str, value: Any) -> float:
    value = plain(value)
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is a number, not {type(value).__name__}")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{name}: the number is too large") from None


def flag(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, numpy.bool_)):
        raise TypeError(f"{name} is True or False, not {type(value).__name__}")
    return bool(value)


def text(name: str, value: Any) -> str:
    """A text that is one in UTF-8, too."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is a str, not {type(value).__name__}")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{name}: {value!r} has a surrogate, which stands for no character") from None
    return value


def names(name: str, value: Any) -> list[str]:
    """A sequence of names, or a text in which they are separated by commas."""
    if isinstance(value, str):
        return [n.strip() for n in text(name, value).split(",")]
    if isinstance(value, (bytes, dict)) or not isinstance(value, Iterable):
        raise TypeError(f"{name} is a list of names, not {type(value).__name__}")
    return [text(f"{name}[{i}]", n) for i, n in enumerate(value)]


def wholes(name: str, value: Any, count: int) -> tuple[int, ...]:
    """So many whole numbers."""
    if isinstance(value, (str, bytes, dict)) or not isinstance(value, Iterable):
        raise TypeError(f"{name} is {count} whole numbers, not {type(value).__name__}")
    values = tuple(value)
    if len(values) != count:
        raise ValueError(f"{name} has {count} numbers, not {len(values)}")
    return tuple(whole(name, v) for v in values)


def path(name: str, value: Any) -> str:
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} is a str or a path object, not {type(value).__name__}")
    return text(name, os.fspath(value))


def setting(name: str, value: Any) -> str:
    """A number, a bool or a text as the text that scenes and methods take."""
    value = plain(value)
    if isinstance(value, (bool, numpy.bool_)):
        return str(bool(value)).lower()
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(real(name, value))
    if not isinstance(value, str):
        raise TypeError(f"{name}: a parameter is a text, a number or a bool, not {type(value).__name__}")
    return text(name, value)


def function(name: str, value: Any, *arguments: object) -> Callable[..., object]:
    """A function that can be called with these arguments."""
    if not callable(value):
        raise TypeError(f"{name} is a function, True or None, not {type(value).__name__}")
    called: Callable[..., object] = value
    try:
        signature = inspect.signature(called)
    except (TypeError, ValueError):
        return called  # a function that is not written in Python
    try:
        signature.bind(*arguments)
    except TypeError as error:
        raise TypeError(f"{name} is called with {len(arguments)} arguments: {error}") from None
    return called
