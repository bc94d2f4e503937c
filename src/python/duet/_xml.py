"""Dictionaries in Mitsuba 3's convention as the text of an XML scene."""
from __future__ import annotations

import numbers
import os
from collections.abc import Iterable
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy
import numpy.typing

from . import _duet

#: Types of entries that are values and not plugins, with their XML elements.
_COLOURS = {"rgb", "spectrum"}


def scene_xml(scene: dict[str, Any]) -> str:
    """The text of a scene. Raises TypeError and ValueError for what a scene cannot have."""
    if not isinstance(scene, dict):
        raise TypeError(f"a scene is a dict, not {type(scene).__name__}")
    if scene.get("type") != "scene":
        raise ValueError('the outermost dict has the "type" "scene"')
    lines = ['<scene version="3.0.0">']
    for name, value in scene.items():
        if name != "type":
            lines += _entry(name, value, "scene", "scene", name)
    return "\n".join(lines + ["</scene>"])


def _entry(name: str, value: Any, outer_kind: str, outer_type: str, place: str) -> list[str]:
    """The lines of an entry of a plugin. `place` is what messages call it."""
    if isinstance(value, dict):
        return _plugin(name, value, outer_kind, place)
    if name == "id":
        return []
    element, text = _value(value, _duet.parameter_type(outer_kind, outer_type, name), place)
    if element == "transform":
        return [f"<transform name={quoteattr(name)}><matrix value={quoteattr(text)}/></transform>"]
    return [f"<{element} name={quoteattr(name)} value={quoteattr(text)}/>"]


def _plugin(name: str, entries: dict[str, Any], outer_kind: str, place: str) -> list[str]:
    kind = entries.get("type")
    if not isinstance(kind, str):
        raise ValueError(f'{place}: a dict has a "type"')
    named = f"name={quoteattr(name)}"
    if kind == "ref":
        return [f"<ref {named} id={quoteattr(_text_of(entries, 'id', place))}/>"]
    if kind in _COLOURS and "value" in entries:
        return [f"<{kind} {named} value={quoteattr(_colour(entries['value'], place))}/>"]
    tags = _duet.plugin_kinds(kind, outer_kind)
    if not tags:
        raise ValueError(f'{place}: there is no plugin "{kind}" that can stand here')
    tag = tags[0]
    own_id = entries.get("id", name) if outer_kind == "scene" or "id" in entries else None
    head = f"<{tag} type={quoteattr(kind)} {named}"
    lines = [head + (f" id={quoteattr(str(own_id))}>" if own_id is not None else ">")]
    for inner, value in entries.items():
        if inner not in ("type", "id"):
            lines += _entry(inner, value, tag, kind, f"{place}.{inner}")
    return lines + [f"</{tag}>"]


def _text_of(entries: dict[str, Any], key: str, place: str) -> str:
    text = entries.get(key)
    if not isinstance(text, str):
        raise ValueError(f'{place}: there is no "{key}"')
    return text


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(repr(float(v)) for v in values)


def _colour(value: Any, place: str) -> str:
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, str):
        return value
    values = list(value)
    if values and all(isinstance(v, (tuple, list)) and len(v) == 2 for v in values):
        return ", ".join(f"{float(w)!r}:{float(v)!r}" for w, v in values)
    array = _array(values, place)
    if array.ndim != 1:
        raise ValueError(f"{place}: a colour is a number, a list of numbers, or of (wavelength, value)")
    return _numbers(array)


def _array(value: Any, place: str) -> numpy.typing.NDArray[numpy.float64]:
    try:
        return numpy.asarray(value, dtype=numpy.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{place}: a value is a number, a text, a bool, a list of three numbers or a 4 × 4 array, not "
                        f"{type(value).__name__}") from None


def _value(value: Any, wanted: str, place: str) -> tuple[str, str]:
    """The XML element of a value, and its text. `wanted` is the type that the parameter has, as `duet plugins` prints it,
    or "" if it is not known."""
    if isinstance(value, (bool, numpy.bool_)):
        return "boolean", "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return "string", os.fspath(value)
    if isinstance(value, numbers.Integral) and wanted in ("integer", ""):
        return "integer", str(int(value))
    if isinstance(value, numbers.Real):
        return "float", repr(float(value))
    # Transforms of Mitsuba's and other libraries have the array as an attribute.
    array = _array(getattr(value, "matrix", value), place)
    if array.shape == (4, 4):
        return "transform", " ".join(repr(float(v)) for v in array.ravel())
    if array.shape == (3,):
        return "point", _numbers(array)
    raise ValueError(f"{place}: an array has 3 numbers or 4 × 4, not {' × '.join(map(str, array.shape)) or 'none'}")
