"""Transforms for dictionaries, by the names that Mitsuba 3 has for them."""
from __future__ import annotations

import math
from collections.abc import Sequence

import numpy


class _Step:
    """A transform that is applied before those that it is called on: Transform4f().translate(…).rotate(…). Called on
    the class it is the first one."""

    def __init__(self, matrix):
        self._matrix = matrix
        self.__doc__ = matrix.__doc__

    def __get__(self, transform, owner):
        before = owner() if transform is None else transform

        def step(*args, **kwargs):
            return before @ owner(self._matrix(*args, **kwargs))
        step.__doc__ = self.__doc__
        return step


def _vector(values, name: str) -> numpy.ndarray:
    vector = numpy.asarray(values, dtype=float)
    if vector.ndim == 0:
        vector = numpy.full(3, float(vector))
    if vector.shape != (3,) or not numpy.isfinite(vector).all():
        raise ValueError(f"{name} has three finite numbers")
    return vector


def _direction(values, name: str) -> numpy.ndarray:
    vector = _vector(values, name)
    length = numpy.linalg.norm(vector)
    if length == 0:
        raise ValueError(f"{name} has no length")
    return vector / length


def _translate(v: Sequence[float]) -> numpy.ndarray:
    """By a vector."""
    matrix = numpy.eye(4)
    matrix[:3, 3] = _vector(v, "v")
    return matrix


def _scale(v: Sequence[float] | float) -> numpy.ndarray:
    """By a factor, or by one along each axis."""
    return numpy.diag([*_vector(v, "v"), 1.0])


def _rotate(axis: Sequence[float], angle: float) -> numpy.ndarray:
    """Around an axis through the origin, by degrees, counterclockwise if the axis points to the viewer. Source:
    Rodrigues' formula."""
    x, y, z = _direction(axis, "axis")
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    radians = math.radians(angle)
    matrix = numpy.eye(4)
    matrix[:3, :3] += math.sin(radians) * cross + (1 - math.cos(radians)) * cross @ cross
    return matrix


def _look_at(origin: Sequence[float], target: Sequence[float], up: Sequence[float]) -> numpy.ndarray:
    """Of a sensor at a point that looks at another one; +z is where it looks, +x to the left."""
    origin = _vector(origin, "origin")
    forward = _direction(_vector(target, "target") - origin, "target - origin")
    left = _direction(numpy.cross(_vector(up, "up"), forward), "up × (target - origin)")
    matrix = numpy.eye(4)
    matrix[:3, :] = numpy.stack([left, numpy.cross(forward, left), forward, origin], axis=1)
    return matrix


class Transform4f:
    """A transform of points as a 4 × 4 matrix, for column vectors. `a @ b` applies b first, and steps that are called
    on a transform, such as `Transform4f().translate([0, 1, 0]).rotate([0, 1, 0], 30)`, come before it."""

    translate = _Step(_translate)
    scale = _Step(_scale)
    rotate = _Step(_rotate)
    look_at = _Step(_look_at)

    def __init__(self, matrix=None):
        #: 4 × 4 float64.
        self.matrix = numpy.eye(4) if matrix is None else numpy.array(matrix, dtype=float)
        if self.matrix.shape != (4, 4):
            raise ValueError("a transform has 4 × 4 numbers")

    def __matmul__(self, other: Transform4f) -> Transform4f:
        if not isinstance(other, Transform4f):
            return NotImplemented
        return type(self)(self.matrix @ other.matrix)

    def inverse(self) -> Transform4f:
        """Raises numpy.linalg.LinAlgError if there is none."""
        return type(self)(numpy.linalg.inv(self.matrix))

    def __repr__(self) -> str:
        return f"Transform4f({self.matrix.tolist()})"
