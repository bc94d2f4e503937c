"""Rendering."""
from __future__ import annotations

import importlib
import numbers
import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from . import _duet
from ._image import Image
from ._scene import Scene, SceneWarning


def _bar() -> Any:
    """A bar of tqdm's if it is installed, or None."""
    try:
        tqdm = importlib.import_module("tqdm.auto")
    except ImportError:
        return None
    return tqdm.tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}")


def _whole(name: str, value: Any, least: int) -> Any:
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{name} is a whole number, not {type(value).__name__}")
    whole = int(value)
    if not least <= whole < 2**31:
        raise ValueError(f"{name}: {whole} is not between {least} and {2**31 - 1}")
    return whole


def _positive(name: str, value: Any) -> float | None:
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is a number, not {type(value).__name__}")
    positive = float(value)
    if not 0 < positive < float("inf"):
        raise ValueError(f"{name}: {value} is not a positive number")
    return positive


def _window(name: str, values: Iterable[int] | None, least: tuple[int, ...]) -> Any:
    if values is None:
        return None
    values = tuple(values)
    if len(values) != len(least):
        raise ValueError(f"{name} has {len(least)} numbers, not {len(values)}")
    return tuple(_whole(name, v, m) for v, m in zip(values, least))


def _texts(parameters: Mapping[str, Any]) -> list[tuple[str, str]]:
    def text(value: Any) -> str:
        return str(value).lower() if isinstance(value, bool) else str(value)
    return [(str(name), text(value)) for name, value in parameters.items()]


def _names(names: str | Iterable[str]) -> list[str]:
    """A sequence of names, or a text in which they are separated by commas."""
    return [n.strip() for n in names.split(",")] if isinstance(names, str) else list(names)


def render(scene: Scene, *, spp: int | None = None, time: float | None = None, target_error: float | None = None,
           integrator: str = "", parameters: Mapping[str, Any] | None = None, seed: int | None = None,
           size: tuple[int, int] | None = None, crop: tuple[int, int, int, int] | None = None, sensor: int = 0,
           aovs: Sequence[str] = (), cryptomatte: Sequence[str] = (), techniques: str | None = None,
           denoise: bool = False, strict_sampler: bool = False, threads: int = 0,
           progress: bool | Callable[[float, int, float], object] | None = None) -> Image:
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
                              the samples per pixel and the seconds; called about 20 times a second

    Other Python threads run meanwhile. Ctrl-C gets the image of the samples so far (`image.interrupted`), or
    KeyboardInterrupt if a pixel has none. Raises SceneError, ValueError and TypeError for settings that make no sense,
    IndexError for a sensor or a window that there is not, MemoryError if the image would not fit, and DenoiserError,
    before anything is rendered, if Open Image Denoise is asked for and cannot be loaded.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"a scene is a duet.Scene, not {type(scene).__name__}")
    if techniques not in (None, "weighted", "raw"):
        raise ValueError(f'techniques: "weighted" or "raw", not {techniques!r}')
    if seed is not None and not (isinstance(seed, numbers.Integral) and 0 <= seed < 2**64):
        raise ValueError(f"seed: {seed!r} is not a whole number from 0 to 2**64 - 1")
    settings = _duet.Settings()
    settings.spp = _whole("spp", spp, 1)
    settings.seconds = _positive("time", time)
    settings.target_error = _positive("target_error", target_error)
    settings.size = _window("size", size, (1, 1))
    settings.crop = _window("crop", crop, (0, 0, 1, 1))
    settings.integrator = integrator or ""
    settings.parameters = _texts(parameters or {})
    settings.layers = _names(aovs)
    settings.cryptomatte = _names(cryptomatte)
    settings.denoise = bool(denoise)
    settings.set_techniques(techniques or "")
    settings.seed = None if seed is None else int(seed)
    settings.strict_sampler = bool(strict_sampler)
    settings.threads = _whole("threads", threads, 0)
    settings.sensor = _whole("sensor", sensor, 0)
    bar = _bar() if progress is True else None
    watch = progress if callable(progress) else None
    if bar is not None:
        def watch(fraction: float, spp: int, seconds: float) -> object:
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
    if isinstance(films, (str, os.PathLike)):
        raise TypeError("films is a list of files")
    paths = [os.fspath(f) for f in films]
    if not paths:
        raise ValueError("there are no films")
    return Image(_duet.merge(paths))
