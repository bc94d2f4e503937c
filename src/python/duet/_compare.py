"""Comparing images, and means of values."""
from __future__ import annotations

import json
import math
import os
import typing
from collections.abc import Iterable

import numpy.typing

from . import _checks, _duet
from ._image import Image, pixels_of


#: What is compared: a file, an image or an array.
_Comparable = typing.Union[str, os.PathLike[str], Image, numpy.typing.ArrayLike]


def _linear(image: _Comparable, what: str) -> _duet.ComparedImage:
    """A file, an Image or an array as linear colours."""
    if isinstance(image, (str, os.PathLike)):
        return _duet.ComparedImage.load(_checks.path(what, image))
    if isinstance(image, Image):
        return _duet.ComparedImage.from_image(image._pixels)
    return _duet.ComparedImage.from_pixels(*pixels_of(image, what))


def _samples(given: float | None, image: _Comparable, what: str) -> float:
    if given is not None:
        return _checks.real(f"{what}_spp", given)
    if isinstance(image, Image) and "spp" in image.metadata:
        return float(image.metadata["spp"])
    raise ValueError(f"with a variance, the samples per pixel of the {what} have to be known: {what}_spp")


class Welch(typing.NamedTuple):
    """What Welch's test says of a mean."""
    difference: float  #: of the mean of the values from what is expected
    error: float       #: its standard error
    p: float           #: the probability of a larger difference, if the expected one is zero
    z: float           #: the normal variate, not negative, that is as improbable


def welch(values: Iterable[float], expected: float, variance: float = 0.0) -> Welch:
    """Welch's t-test of whether independent values have the mean `expected`, whose variance is known.

    `values` and `expected` have one unit, whatever it is; `variance` has its square.
    Source: Welch, "The generalization of Student's problem when several different population variances are
    involved", Biometrika 34, 1947. Raises ValueError for fewer than two values, for
    numbers that are not finite, and for a negative variance.
    """
    numbers = [_checks.real("a value", v) for v in values]
    if len(numbers) < 2:
        raise ValueError("the variance of fewer than two values is not known")
    mean, square = _checks.real("expected", expected), _checks.real("variance", variance)
    if not all(map(math.isfinite, [*numbers, mean, square])):
        raise ValueError("values, expected and variance are finite numbers")
    if square < 0:
        raise ValueError(f"variance: {square} is negative")
    return Welch(*_duet.welch(numbers, mean, square))


def compare(image: _Comparable, reference: _Comparable, *, variance: _Comparable | None = None,
            image_spp: float | None = None, reference_spp: float | None = None) -> dict[str, typing.Any]:
    """The figures of `duet compare --json` as a dict: rmse, relrmse, flip, ssim …, "verdict".

    Images are files, duet.Image, or arrays of linear values (height × width, or with 1, 3 or 4 channels). `variance` is
    that of one sample of the reference, likewise; with it bias and noise are told apart ("bias_test"), for which the
    samples per pixel of both images are needed: their own if they are a duet.Image. Denoised images are biased, which
    the "warning" says then. Raises ValueError for images that do not go together and OSError for files that cannot be
    read.
    """
    noise = None
    if variance is not None:
        noise = _duet.Variance(_linear(variance, "variance"), _samples(image_spp, image, "image"),
                               _samples(reference_spp, reference, "reference"))
    figures: dict[str, typing.Any] = json.loads(
        _duet.compare(_linear(image, "image"), _linear(reference, "reference"), noise))
    return figures
