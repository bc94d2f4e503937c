"""Scenes: reading them from files, strings and dictionaries."""
from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from . import _checks, _duet
from ._xml import scene_xml


class SceneError(RuntimeError):
    """Errors in a scene. The text has all of them, a line each."""

    def __init__(self, message: str, file: str | None = None, line: int = 0, column: int = 0,
                 messages: Iterable[str] = ()) -> None:
        super().__init__(message)
        #: The file of the first error, or None if it is not known.
        self.file = file
        #: Its line and column, counted from 1; 0 if they are not known.
        self.line = line
        self.column = column
        #: All errors and warnings, each as "file:line:column: error: text".
        self.messages = list(messages)


class SceneWarning(UserWarning):
    """Something in a scene that is not rendered as its file says, or that may not be meant."""


class Scene:
    """A scene as its file describes it; it never changes. Several threads may render it at once."""

    def __init__(self, read: _duet.Scene) -> None:
        self._read = read

    @property
    def name(self) -> str:
        """The file's name, or "<string>"."""
        return self._read.name

    @property
    def warnings(self) -> list[str]:
        """What was noticed while it was read, as "file:line:column: warning: text"."""
        return self._read.warnings

    def info(self) -> dict[str, Any]:
        """What `duet info --json` prints, as a dict: integrator, sensors, shapes, materials, lights …"""
        described: dict[str, Any] = json.loads(self._read.json())
        return described

    def __repr__(self) -> str:
        return f"<duet.Scene {self.name}>"

    def __str__(self) -> str:
        return self._read.summary()


def _load(name: str, text: str | None, defines: Mapping[str, str | int | float | bool],
          search_paths: Sequence[str | os.PathLike[str]]) -> Scene:
    if isinstance(search_paths, (str, bytes, os.PathLike)) or not isinstance(search_paths, Iterable):
        raise TypeError("search_paths is a list of folders")
    values = [(_checks.text("the name of a parameter", n), _checks.setting(n, v)) for n, v in defines.items()]
    read = _duet.load(name, text, values, [_checks.path("a search path", p) for p in search_paths])
    for warning in read.warnings:
        warnings.warn(warning, SceneWarning, stacklevel=3)
    return Scene(read)


def load_file(path: str | os.PathLike[str], /, *, search_paths: Sequence[str | os.PathLike[str]] = (),
              **defines: str | int | float | bool) -> Scene:
    """Reads a scene file (.xml, .pbrt, .pbrt.gz).

    `defines` are values for the scene's `$name` parameters, as of `duet -D`; `search_paths` are further folders to look
    for files. Raises SceneError, with file, line and column; warnings are SceneWarning.
    """
    return _load(_checks.path("path", path), None, defines, search_paths)


def load_string(text: str, /, *, search_paths: Sequence[str | os.PathLike[str]] = (),
                **defines: str | int | float | bool) -> Scene:
    """Reads a scene from the text of a Mitsuba XML file. Its relative files are looked for from the current folder and
    in `search_paths`. Errors and parameters as with load_file()."""
    return _load("<string>", _checks.text("a scene", text), defines, search_paths)


def load_dict(scene: dict[str, Any], *, search_paths: Sequence[str | os.PathLike[str]] = ()) -> Scene:
    """Reads a scene from nested dicts, in Mitsuba 3's convention: {"type": "scene", "name": {"type": "sphere", …}, …}.

    Values are numbers, texts, bools, lists of three numbers (points and vectors), 4 × 4 arrays (transforms, column
    vectors), other dicts, {"type": "rgb", "value": …}, and {"type": "ref", "id": name} for something that an entry
    before has as its name or "id". Raises TypeError and ValueError for others, and SceneError.
    """
    return _load("<string>", scene_xml(scene), {}, search_paths)
