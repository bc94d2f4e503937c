"""What Mitsuba 3 has under the same name."""
from __future__ import annotations

import os

from numpy.typing import ArrayLike

from ._image import Image


def write_bitmap(filename: str | os.PathLike[str], data: Image | ArrayLike, write_async: bool = False, quality: int = -1) -> None:
    """Writes an Image, or an array of linear values (height × width, or with 1, 3 or 4 channels), to a file: .exr, .png or
    .jpg, as Image.save(). The file is there when the call returns, and JPEG files have one quality, whatever is asked for.
    """
    image = data if isinstance(data, Image) else Image.from_array(data)
    image.save(filename)
