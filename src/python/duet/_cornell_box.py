"""The Cornell box, as Mitsuba 3 has it."""
from __future__ import annotations

from typing import Any

from ._transform import Transform4f

_Object = dict[str, Any]


def _rgb(*values: float) -> _Object:
    return {"type": "rgb", "value": list(values)}


def _diffuse(*reflectance: float) -> _Object:
    return {"type": "diffuse", "reflectance": _rgb(*reflectance)}


def _shape(kind: str, colour: str, to_world: Transform4f) -> _Object:
    return {"type": kind, "to_world": to_world, "bsdf": {"type": "ref", "id": colour}}


def cornell_box() -> _Object:
    """The Cornell box as a dictionary for load_dict(), which can be changed before: 256 × 256 pixels, 64 samples, paths of
    up to 8 segments, walls 2 units apart around the origin, light in W / (m² sr). Every call makes a new one.

    Source of the numbers: `mitsuba.cornell_box()` (Mitsuba 3, BSD licence); the box itself is that of Goral, Torrance,
    Greenberg and Battaile, Modeling the Interaction of Light Between Diffuse Surfaces, 1984.
    """
    at = Transform4f.translate
    x, y = [1, 0, 0], [0, 1, 0]
    lamp = _shape("rectangle", "white", at([0, 0.99, 0.01]).rotate(x, 90).scale([0.23, 0.19, 0.19]))
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 8},
        "sensor": {
            "type": "perspective", "fov_axis": "smaller", "fov": 39.3077,
            "near_clip": 0.001, "far_clip": 100.0, "focus_distance": 1000.0,
            "to_world": Transform4f.look_at(origin=[0, 0, 3.9], target=[0, 0, 0], up=y),
            "sampler": {"type": "independent", "sample_count": 64},
            "film": {"type": "hdrfilm", "width": 256, "height": 256, "rfilter": {"type": "gaussian"},
                     "pixel_format": "rgb", "component_format": "float32"},
        },
        "white": _diffuse(0.885809, 0.698859, 0.666422),
        "green": _diffuse(0.105421, 0.37798, 0.076425),
        "red": _diffuse(0.570068, 0.0430135, 0.0443706),
        "light": lamp | {"emitter": {"type": "area", "radiance": _rgb(18.387, 13.9873, 6.75357)}},
        "floor": _shape("rectangle", "white", at([0, -1, 0]).rotate(x, -90)),
        "ceiling": _shape("rectangle", "white", at([0, 1, 0]).rotate(x, 90)),
        "back": _shape("rectangle", "white", at([0, 0, -1])),
        "green-wall": _shape("rectangle", "green", at([1, 0, 0]).rotate(y, -90)),
        "red-wall": _shape("rectangle", "red", at([-1, 0, 0]).rotate(y, 90)),
        "small-box": _shape("cube", "white", at([0.335, -0.7, 0.38]).rotate(y, -17).scale(0.3)),
        "large-box": _shape("cube", "white", at([-0.33, -0.4, -0.28]).rotate(y, 18.25).scale([0.3, 0.61, 0.3])),
    }
