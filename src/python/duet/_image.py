"""Images: rendered ones, and arrays."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _checks, _duet
from ._duet import DisplayForm as _DisplayForm, ExrForm as _ExrForm, Image as _Pixels

_CHANNELS = {1: ["Y"], 3: ["R", "G", "B"], 4: ["R", "G", "B", "A"]}


class DenoiserError(RuntimeError):
    """Open Image Denoise is asked for, and cannot be loaded or has failed."""


def pixels_of(image: ArrayLike, what: str = "the image") -> tuple[NDArray[numpy.float32], list[str]]:
    """An array as height × width × channels float32, and the names of its channels."""
    pixels = numpy.asarray(image)
    if pixels.dtype.kind not in "fiu":
        raise TypeError(f"{what}: an image is a file, a duet.Image or an array of numbers, not {type(image).__name__}")
    if pixels.ndim == 2:
        pixels = pixels[:, :, None]
    channels = image.channels if isinstance(image, Image) else _CHANNELS.get(pixels.shape[-1] if pixels.ndim else 0)
    if pixels.ndim != 3 or channels is None or 0 in pixels.shape:
        raise ValueError(f"{what}: an image has height × width × 1, 3 or 4 values, not "
                         f"{' × '.join(map(str, pixels.shape))}")
    return numpy.ascontiguousarray(pixels, dtype=numpy.float32), list(channels)


def _array_of(value: Any) -> Any:
    return value._pixels.pixels() if isinstance(value, Image) else value


def _exposure(value: float | str) -> tuple[float, bool]:
    """Stops, and whether they are on top of an automatic exposure."""
    if not isinstance(value, str):
        return _checks.real("exposure", value), False
    if not value.startswith("auto"):
        raise ValueError(f'exposure: a number of stops, "auto+1" or "auto", not {value!r}')
    return _duet.exposure(_checks.text("exposure", value))


class Image(NDArrayOperatorsMixin):
    """An image: height × width × channels linear values, float32, rows from the top.

    numpy.asarray(image) is its pixels without a copy, read-only; they stay as long as the array does. Calculations with
    images, such as image ** (1 / 2.2), give arrays; those in place, such as image *= 2, are a ValueError.
    """

    def __init__(self, pixels: _Pixels) -> None:
        if not isinstance(pixels, _Pixels):
            raise TypeError("images are made by duet.render() and Image.from_array()")
        self._pixels = pixels

    @classmethod
    def from_array(cls, pixels: ArrayLike) -> Image:
        """A copy of an array of linear values, height × width, or with 1, 3 or 4 channels: R, G, B, A, with one channel
        grey and with less than four opaque."""
        given, channels = pixels_of(pixels)
        if len(channels) > 4:
            raise ValueError("an image with layers cannot be copied")
        rgba = numpy.ones((*given.shape[:2], 4), numpy.float32)
        rgba[:, :, :3 if len(channels) < 4 else 4] = given
        return cls(_Pixels.from_rgba(rgba))

    @property
    def channels(self) -> Sequence[str]:
        """Names of the channels: "R", "G", "B", "A", then layers such as "depth.T", then mattes.

        A matte is three layers of four channels: "CryptoObject00.R" is the id of what covers most of the pixel, its bits
        those of the float (numpy's `view(numpy.uint32)`), and "CryptoObject00.G" the share of the pixel that it covers,
        from 0 to 1; B and A are the same of what comes second, and so on to the sixth in "CryptoObject02". The metadata
        have the names' ids.
        """
        return self._pixels.channels

    @property
    def metadata(self) -> dict[str, Any]:
        """What the header of an EXR file says: integrator, spp (samples per pixel), seed, relativeStandardError (a share of
        the mean, 0.01 is one percent) …"""
        return self._pixels.metadata

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the render before it had all samples."""
        return self._pixels.interrupted

    @property
    def denoised(self) -> Image | None:
        """The image without most of its noise if `denoise=True` asked for it, otherwise None: height × width × 3 or 4,
        linear, R, G, B and the A of this image, without its other layers.

        It is a guess by Open Image Denoise, biased by an unknown amount: its metadata have the "denoiser" and the "bias".
        This image is not changed by it. Raises DenoiserError if the denoiser has failed.
        """
        pixels = self._pixels.denoised
        return None if pixels is None else Image(pixels)

    @property
    def shape(self) -> tuple[int, int, int]:
        """(height, width, channels)."""
        height, width, channels = self._pixels.pixels().shape
        return height, width, channels

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, index: Any) -> Any:
        return self._pixels.pixels()[index]

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        pixels = self._pixels.pixels()
        if dtype is not None and numpy.dtype(dtype) != pixels.dtype:
            if copy is False:
                raise ValueError("another type of numbers needs a copy")
            return pixels.astype(dtype)
        return pixels.copy() if copy else pixels

    def __array_ufunc__(self, function: numpy.ufunc, method: str, *inputs: Any, **kwargs: Any) -> Any:
        # Images as `out` are refused by NumPy, as other arrays that are read-only.
        given = {name: tuple(map(_array_of, value)) if isinstance(value, tuple) else _array_of(value)
                 for name, value in kwargs.items()}
        return getattr(function, method)(*map(_array_of, inputs), **given)

    def save(self, path: str | os.PathLike[str], exposure: float | str = 0.0, tonemap: str | None = None, png_depth: int = 8,
             aov_names: str = "duet", exr_parts: bool = False) -> None:
        """Writes an image file: .exr (linear, all layers), .png or .jpg (for display). Files are replaced as a whole.

        `exposure` is in stops, from -100 to 100, or "auto": the mean of luminance becomes middle grey; "auto+1" is brighter. `tonemap` is "srgb", "aces", "agx" or
        "reinhard"; by default as the scene says. `png_depth` is the bits of a value in .png, 8 or 16. In .exr the layers
        have the names of "duet", "blender", "nuke" or "mitsuba" (`aov_names`), and with `exr_parts` each is a part of its
        own. Raises ValueError for others and OSError if it cannot be written.
        """
        stops, automatic = _exposure(exposure)
        display = _DisplayForm(stops, automatic, "" if tonemap is None else _checks.text("tonemap", tonemap),
                               _checks.whole("png_depth", png_depth))
        form = _ExrForm(_checks.text("aov_names", aov_names), _checks.flag("exr_parts", exr_parts))
        self._pixels.save(_checks.path("path", path), display, form)

    def _repr_png_(self) -> bytes | None:
        return self._pixels.png() if self.channels[0] == "R" else None

    def __repr__(self) -> str:
        height, width, _ = self.shape
        return f"<duet.Image {width}×{height}, {', '.join(self.channels)}>"
