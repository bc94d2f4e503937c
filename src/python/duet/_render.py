"""Rendering."""
from __future__ import annotations

import importlib
import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeVar

import numpy

from . import _checks, _duet
from ._image import Image
from ._scene import Scene, SceneWarning


_Checked = TypeVar("_Checked")


def _if_given(check: Callable[..., _Checked], name: str, value: Any, *more: Any) -> _Checked | None:
    return None if value is None else check(name, value, *more)


def _seed(name: str, value: Any) -> int:
    number = _checks.integral(name, value)
    if not 0 <= number < 2**64:
        raise ValueError(f"{name}: {number} is not a whole number from 0 to 2**64 - 1")
    return number


def _sensor(name: str, value: Any) -> int:
    number = _checks.whole(name, value)
    if number < 0:
        raise ValueError(f"{name}: sensors are counted from 0")
    return number


def _parameters(values: Any) -> list[tuple[str, str]]:
    if not isinstance(values, Mapping):
        raise TypeError(f"parameters is a dict, not {type(values).__name__}")
    return [(_checks.text("a name in parameters", n), _checks.setting(f"parameters[{n!r}]", v))
            for n, v in values.items()]


def _bar() -> Any:
    """A bar of tqdm's if it is installed, or None."""
    try:
        tqdm = importlib.import_module("tqdm.auto")
    except ImportError:
        return None
    return tqdm.tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}")


def render(scene: Scene, *, spp: int | None = None, time: float | None = None, target_error: float | None = None,
           integrator: str = "", parameters: Mapping[str, Any] | None = None, seed: int | None = None,
           size: tuple[int, int] | None = None, crop: tuple[int, int, int, int] | None = None, sensor: int = 0,
           aovs: Sequence[str] = (), cryptomatte: Sequence[str] = (), techniques: str | None = None,
           denoise: bool = False, strict_sampler: bool = False, threads: int = 0,
           progress: bool | Callable[[float, float, float], object] | None = None) -> Image:
    """Renders a scene to an Image, with the same bits as `duet` with the same settings.

    spp, time, target_error   when to stop: samples per pixel, seconds, relative standard error (0.01); the first that is
                              reached. By default the scene's samples per pixel.
    integrator, parameters    a method instead of the scene's ("auto", "bdpt", "vcm" …), and a dict of its parameters
    seed                      of the random numbers; by default the scene's
    size, crop                (width, height) instead of the scene's; the window (x, y, width, height), in pixels
    sensor                    which of the scene's sensors, from 0
    aovs                      further layers, such as ["albedo", "depth"]
    cryptomatte               mattes of the "object" and "material" of each pixel as further layers (Image.channels)
    techniques                "weighted" or "raw": a layer for each technique
    denoise                   whether the image has a denoised one as `image.denoised`, by Open Image Denoise
    strict_sampler            the sampler that the scene names, instead of Sobol' points
    threads                   0: all
    progress                  True for a bar (of tqdm, if it is installed), or a function of the fraction that is done,
                              the samples per pixel and the seconds; called about 20 times a second, and once when the
                              render has ended, with a fraction of 1 unless it was interrupted

    Other Python threads run meanwhile. Ctrl-C gets the image of the samples so far (`image.interrupted`), or
    KeyboardInterrupt if a pixel has none. Raises SceneError, ValueError and TypeError for settings that make no sense,
    IndexError for a sensor or a window that there is not, MemoryError if the image would not fit, and DenoiserError,
    before anything is rendered, if Open Image Denoise is asked for and cannot be loaded.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"a scene is a duet.Scene, not {type(scene).__name__}")
    if not (techniques is None or isinstance(techniques, str) and techniques in ("weighted", "raw")):
        raise ValueError(f'techniques: "weighted" or "raw", not {techniques!r}')
    settings = _duet.Settings()
    settings.spp = _if_given(_checks.whole, "spp", spp)
    settings.seconds = _if_given(_checks.real, "time", time)
    settings.target_error = _if_given(_checks.real, "target_error", target_error)
    settings.size = _if_given(_checks.wholes, "size", size, 2)
    settings.crop = _if_given(_checks.wholes, "crop", crop, 4)
    settings.integrator = _if_given(_checks.text, "integrator", integrator) or ""
    settings.parameters = _parameters({} if parameters is None else parameters)
    settings.layers = _checks.names("aovs", aovs)
    settings.cryptomatte = _checks.names("cryptomatte", cryptomatte)
    settings.denoise = _checks.flag("denoise", denoise)
    settings.set_techniques(techniques or "")
    settings.seed = _if_given(_seed, "seed", seed)
    settings.strict_sampler = _checks.flag("strict_sampler", strict_sampler)
    settings.threads = _checks.whole("threads", threads)
    settings.sensor = _sensor("sensor", sensor)
    shown = isinstance(progress, (bool, numpy.bool_))
    bar = _bar() if shown and progress else None
    watch = None if progress is None or shown else _checks.function("progress", progress, 0.0, 0.0, 0.0)
    if bar is not None:
        def watch(fraction: float, spp: float, seconds: float) -> object:
            return bar.update(100 * fraction - bar.n)
    try:
        rendered, messages = _duet.render(scene._read, settings, watch)
    finally:
        if bar is not None:
            bar.close()
    for message in messages:
        warnings.warn(message, SceneWarning, stacklevel=2)
    return Image(rendered)


def merge(films: Sequence[str | os.PathLike[str]]) -> Image:
    """Adds up raw films of one image (files, of `duet --raw`) to an Image, as `duet merge` does. Samples that are missing
    before the last are in its metadata ("missingSamples"). Raises OSError if a film cannot be read or does not go with
    the others, MemoryError if the image would not fit."""
    if isinstance(films, (str, bytes, os.PathLike)) or not isinstance(films, Iterable):
        raise TypeError("films is a list of files")
    paths = [_checks.path("a film", f) for f in films]
    if not paths:
        raise ValueError("there are no films")
    return Image(_duet.merge(paths))
