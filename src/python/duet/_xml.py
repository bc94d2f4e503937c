"""Dictionaries in Mitsuba 3's convention as the text of an XML scene."""
from __future__ import annotations

import numbers
import os
from collections.abc import Iterable
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy
import numpy.typing

from . import _checks, _duet

#: Types of entries that are values and not plugins, with their XML elements.
_COLOURS = {"rgb", "spectrum"}


def scene_xml(scene: dict[str, Any]) -> str:
    """The text of a scene. Raises TypeError and ValueError for what a scene cannot have."""
    if not isinstance(scene, dict):
        raise TypeError(f"a scene is a dict, not {type(scene).__name__}")
    if scene.get("type") != "scene":
        raise ValueError('the outermost dict has the "type" "scene"')
    return "\n".join(['<scene version="3.0.0">', *_entries(scene, "scene", "scene", ""), "</scene>"])


def _entries(entries: dict[Any, Any], kind: str, plugin: str, place: str, outer: tuple[int, ...] = ()) -> list[str]:
    """The lines of all that is in a plugin. `outer` are the ids of the dicts that it is in."""
    if id(entries) in outer:
        raise ValueError(f"{place}: the dict contains itself")
    lines = []
    for key, value in entries.items():
        if not isinstance(key, str):
            raise TypeError(f"{place or 'the scene'}: the keys of a dict are str, not {type(key).__name__}: {key!r}")
        inner = f"{place}.{key}" if place else key
        name = _checks.text(f"{place or 'the scene'}: a key", key)
        if name not in ("type", "id"):
            lines += _entry(name, value, kind, plugin, inner, (*outer, id(entries)))
    return lines


def _entry(name: str, value: Any, outer_kind: str, outer_type: str, place: str, outer: tuple[int, ...]) -> list[str]:
    """The lines of an entry of a plugin. `place` is what messages call it."""
    if isinstance(value, dict):
        return _plugin(name, value, outer_kind, place, outer)
    element, text = _value(value, _duet.parameter_type(outer_kind, outer_type, name), place)
    if element == "transform":
        return [f"<transform name={quoteattr(name)}><matrix value={quoteattr(text)}/></transform>"]
    return [f"<{element} name={quoteattr(name)} value={quoteattr(text)}/>"]


def _only(entries: dict[Any, Any], keys: set[str], place: str) -> None:
    for key in entries:
        if key not in keys:
            raise ValueError(f'{place}: "{entries["type"]}" has no {key!r}')


def _plugin(name: str, entries: dict[Any, Any], outer_kind: str, place: str, outer: tuple[int, ...]) -> list[str]:
    if "type" not in entries:
        raise ValueError(f'{place}: a dict has a "type"')
    kind = _checks.text(f"{place}.type", entries["type"])
    named = f"name={quoteattr(name)}"
    if kind == "ref":
        _only(entries, {"type", "id"}, place)
        return [f"<ref {named} id={quoteattr(_text_of(entries, 'id', place))}/>"]
    if kind in _COLOURS and "value" in entries:
        _only(entries, {"type", "value"}, place)
        return [f"<{kind} {named} value={quoteattr(_colour(entries['value'], place))}/>"]
    tags = _duet.plugin_kinds(kind, outer_kind)
    if not tags:
        raise ValueError(f'{place}: there is no plugin "{kind}" that can stand here')
    tag = tags[0]
    own_id = name if outer_kind == "scene" else None
    if "id" in entries:
        own_id = _text_of(entries, "id", place)
    head = f"<{tag} type={quoteattr(kind)} {named}"
    lines = [head + (f" id={quoteattr(own_id)}>" if own_id is not None else ">")]
    return [*lines, *_entries(entries, tag, kind, place, outer), f"</{tag}>"]


def _text_of(entries: dict[str, Any], key: str, place: str) -> str:
    if key not in entries:
        raise ValueError(f'{place}: there is no "{key}"')
    return _checks.text(f"{place}.{key}", entries[key])


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(repr(float(v)) for v in values)


def _colour(value: Any, place: str) -> str:
    if _is_number(value):
        return repr(_checks.real(place, value))
    if isinstance(value, str):
        return _checks.text(place, value)
    values = list(value) if isinstance(value, Iterable) and not isinstance(value, (bytes, dict)) else []
    if not values:
        raise TypeError(f"{place}: a colour is a number, a text or a list of numbers, not {type(value).__name__}")
    if values and all(isinstance(v, (tuple, list)) and len(v) == 2 for v in values):
        return ", ".join(f"{_checks.real(place, w)!r}:{_checks.real(place, v)!r}" for w, v in values)
    array = _array(values, place)
    if array.ndim != 1:
        raise ValueError(f"{place}: a colour is a number, a list of numbers, or of (wavelength, value)")
    return _numbers(array)


def _is_number(value: Any) -> bool:
    value = _checks.plain(value)
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, numpy.bool_))


def _array(value: Any, place: str) -> numpy.typing.NDArray[numpy.float64]:
    # Of other kinds of arrays, such as complex or bytes, numbers would be made that nobody has meant.
    try:
        array = numpy.asarray(value)
        if array.dtype.kind in "fiu" and array.ndim > 0:
            return array.astype(numpy.float64)
    except (TypeError, ValueError, OverflowError):
        pass
    raise TypeError(f"{place}: a value is a number, a text, a bool, a list of three numbers or a 4 × 4 array, not "
                    f"{type(value).__name__}")


def _value(value: Any, wanted: str, place: str) -> tuple[str, str]:
    """The XML element of a value, and its text. `wanted` is the type that the parameter has, as `duet plugins` prints it,
    or "" if it is not known."""
    value = _checks.plain(value)
    if isinstance(value, (bool, numpy.bool_)):
        return "boolean", "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return "string", _checks.path(place, value)
    if isinstance(value, numbers.Integral) and wanted in ("integer", ""):
        return "integer", str(int(value))
    if _is_number(value):
        return "float", repr(_checks.real(place, value))
    # Transforms of Mitsuba's and other libraries have the array as an attribute.
    array = _array(getattr(value, "matrix", value), place)
    if array.shape == (4, 4):
        return "transform", " ".join(repr(float(v)) for v in array.ravel())
    if array.shape == (3,):
        return "point", _numbers(array)
    raise ValueError(f"{place}: an array has 3 numbers or 4 × 4, not {' × '.join(map(str, array.shape)) or 'none'}")
