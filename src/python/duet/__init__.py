"""Duet: renders Mitsuba (0.4 to 3.x) and pbrt (v3, v4) scene files.

    import duet
    scene = duet.load_file("room.xml", spp="64")
    image = duet.render(scene, integrator="auto", seed=1)
    image.save("room.exr")
    pixels = numpy.asarray(image)      # height × width × channels, float32, linear, without a copy

The images have the same bits as those of the command `duet` with the same settings.
"""
import atexit as _atexit
import os as _os

from . import util
from ._compare import Welch, compare, welch
from ._cornell_box import cornell_box
from ._duet import end_calls as _end_calls, forget_calls as _forget_calls, version as _version
from ._image import DenoiserError, Image
from ._render import merge, render
from ._scene import Scene, SceneError, SceneWarning, load_dict, load_file, load_string
from ._transform import Transform4f
from ._variant import set_variant, variant, variants

__version__ = _version()

# Renders of daemon threads end before the interpreter does; those of the parent are not there in a forked process.
_atexit.register(_end_calls)
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(after_in_child=_forget_calls)

#: Mitsuba 3's name for it.
ScalarTransform4f = Transform4f

__all__ = ["DenoiserError", "Image", "ScalarTransform4f", "Scene", "SceneError", "SceneWarning", "Transform4f", "Welch", "__version__",
           "compare", "cornell_box", "load_dict", "load_file", "load_string", "merge", "render", "set_variant", "util", "variant",
           "variants", "welch"]
