"""Transforms for dictionaries, by the names that Mitsuba 3 has for them."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Generic, ParamSpec

import numpy
from numpy.typing import ArrayLike, NDArray

_Arguments = ParamSpec("_Arguments")
_Matrix = NDArray[numpy.float64]


class _Step(Generic[_Arguments]):
    """A transform that is applied before those that it is called on: Transform4f().translate(…).rotate(…). Called on
    the class it is the first one."""

    def __init__(self, matrix: Callable[_Arguments, _Matrix]) -> None:
        self._matrix = matrix
        self.__doc__ = matrix.__doc__

    def __get__(self, transform: Transform4f | None, owner: type[Transform4f]) -> Callable[_Arguments, Transform4f]:
        before = owner() if transform is None else transform

        def step(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> Transform4f:
            return before @ owner(self._matrix(*args, **kwargs))
        step.__doc__ = self.__doc__
        return step


def _real(values: ArrayLike) -> _Matrix:
    """A copy. NumPy would leave out the imaginary parts of complex numbers."""
    if numpy.iscomplexobj(values):
        raise TypeError("transforms have no complex numbers")
    return numpy.array(values, dtype=float)


def _vector(values: ArrayLike, name: str) -> _Matrix:
    vector = _real(values)
    if vector.ndim == 0:
        vector = numpy.full(3, float(vector))
    if vector.shape != (3,) or not numpy.isfinite(vector).all():
        raise ValueError(f"{name} has three finite numbers")
    return vector


def _direction(values: ArrayLike, name: str) -> _Matrix:
    vector = _vector(values, name)
    length = numpy.linalg.norm(vector)
    if length == 0:
        raise ValueError(f"{name} has no length")
    return numpy.asarray(vector / length)


def _translate(v: ArrayLike) -> _Matrix:
    """By a vector: three numbers in the unit of the scene's lengths."""
    matrix = numpy.eye(4)
    matrix[:3, 3] = _vector(v, "v")
    return matrix


def _scale(v: ArrayLike) -> _Matrix:
    """By a factor, or by three, one along each axis."""
    return numpy.diag([*_vector(v, "v"), 1.0])


def _rotate(axis: ArrayLike, angle: float) -> _Matrix:
    """Around an axis (three numbers) through the origin, by an angle in degrees, counterclockwise if the axis points to the
    viewer. Source: Rodrigues' formula."""
    x, y, z = _direction(axis, "axis")
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    radians = math.radians(angle)
    matrix = numpy.eye(4)
    matrix[:3, :3] += math.sin(radians) * cross + (1 - math.cos(radians)) * cross @ cross
    return matrix


def _look_at(origin: ArrayLike, target: ArrayLike, up: ArrayLike) -> _Matrix:
    """Of a sensor at the point `origin` that looks at `target`, three numbers each in the unit of the scene's lengths, with
    the direction `up` in the upper half of its image; +z is where it looks, +x to the left."""
    eye = _vector(origin, "origin")
    forward = _direction(_vector(target, "target") - eye, "target - origin")
    left = _direction(numpy.cross(_vector(up, "up"), forward), "up × (target - origin)")
    matrix = numpy.eye(4)
    matrix[:3, :] = numpy.stack([left, numpy.cross(forward, left), forward, eye], axis=1)
    return matrix


class Transform4f:
    """A transform of points as a 4 × 4 matrix, for column vectors. `a @ b` applies b first, and steps that are called
    on a transform, such as `Transform4f().translate([0, 1, 0]).rotate([0, 1, 0], 30)`, come before it."""

    translate = _Step(_translate)
    scale = _Step(_scale)
    rotate = _Step(_rotate)
    look_at = _Step(_look_at)

    def __init__(self, matrix: ArrayLike | None = None) -> None:
        #: 4 × 4 float64.
        self.matrix: _Matrix = numpy.eye(4) if matrix is None else _real(matrix)
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
