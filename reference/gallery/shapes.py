"""Meshes for the scenes of the gallery, from formulas: turned vessels, boxes with round edges, tubes, surfaces over grids.

A mesh is a tuple (points, normals, texture coordinates, triangles) of arrays (n, 3), (n, 3), (n, 2) and (m, 3); lengths
are metres, z is up, and normals point out of what is solid. Needs numpy.
"""
import numpy as np


def turn(angle, axis='z'):
    """Matrix of a rotation by degrees."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    i, j = {'x': (1, 2), 'y': (2, 0), 'z': (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def placed(mesh, move=(0, 0, 0), *turns):
    """A mesh after rotations, one after the other, and a translation."""
    points, normals, uvs, triangles = mesh
    for matrix in turns:
        points, normals = points @ matrix.T, normals @ matrix.T
    return points + np.asarray(move, float), normals, uvs, triangles


def joined(*meshes):
    starts = np.cumsum([0] + [len(m[0]) for m in meshes])
    return tuple(np.concatenate([m[i] for m in meshes]) for i in range(3)) + (
        np.concatenate([m[3] + start for m, start in zip(meshes, starts)]),)


def surface(points, uvs):
    """A grid (rows, columns, 3) as a mesh whose normals are ∂p/∂column × ∂p/∂row, by central differences."""
    along = np.gradient(points, axis=1)
    across = np.gradient(points, axis=0)
    normals = np.cross(along, across)
    return grid_mesh(points, normals, uvs)


def grid_mesh(points, normals, uvs):
    """Two triangles for each cell; those without an area are left out."""
    rows, columns = points.shape[:2]
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    a, b, c, d = corner, corner + 1, corner + columns + 1, corner + columns
    triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    flat = points.reshape(-1, 3)
    p = flat[triangles]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    normals = normals.reshape(-1, 3)
    normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    return flat, normals, uvs.reshape(-1, 2), triangles[area > 1e-10]


def smooth(knots, steps):
    """A Catmull-Rom spline through knots (n, d), each stretch in so many steps."""
    k = np.asarray(knots, float)
    k = np.concatenate([[2 * k[0] - k[1]], k, [2 * k[-1] - k[-2]]])
    t = (np.arange(steps) / steps)[:, None]
    parts = [0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t ** 2 + (3 * b - a - 3 * c + d) * t ** 3)
             for a, b, c, d in zip(k, k[1:], k[2:], k[3:])]
    return np.concatenate(parts + [k[-2:-1]])


def lathe(curves, segments=48, steps=5, ripple=None):
    """Turns curves about the z axis. Each is a list of knots (radius, height), walked with what is solid on its left; it is
    smooth in itself, and has a corner where the next begins. `ripple(angle, height)` multiplies the radii."""
    angle = 2 * np.pi * np.arange(segments + 1) / segments
    meshes = []
    for knots in curves:
        profile = smooth(knots, steps if len(knots) > 2 else 1)
        radius = np.abs(profile[:, 0])[:, None] * (ripple(angle[None], profile[:, 1:2]) if ripple else np.ones_like(angle))
        points = np.stack([radius * np.cos(angle), radius * np.sin(angle), profile[:, 1:2] + 0 * angle], axis=-1)
        slope = np.gradient(profile, axis=0) if len(profile) > 2 else np.diff(profile, axis=0).repeat(2, 0)
        if ripple:
            around = np.gradient(points, axis=1)
            around[:, 0] = around[:, -1] = (points[:, 1] - points[:, -2]) / 2
            normals = np.cross(around, np.gradient(points, axis=0))
        else:
            normals = np.stack([slope[:, 1:] * np.cos(angle), slope[:, 1:] * np.sin(angle),
                                -slope[:, :1] + 0 * angle], axis=-1)
        length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
        uvs = np.stack([angle / (2 * np.pi) + 0 * length[:, None], length[:, None] / length[-1] + 0 * angle], axis=-1)
        meshes.append(grid_mesh(points, normals, uvs))
    return joined(*meshes)


def box(size, centre=(0, 0, 0), edge=0.004, steps=2):
    """A box with round edges, or sharp ones if `edge` is 0; texture coordinates are metres, u along its longest side.

    Round edges of few steps have normals far from those of their triangles, which makes light sub-paths noisy (Veach 1997,
    section 5.3): what is lit for methods with such paths has sharp edges, or many steps."""
    half = np.asarray(size, float) / 2
    edge = min(edge, *(0.499 * half))
    bend = edge * (1 - np.cos(np.linspace(0, np.pi / 2, steps + 1)[1:])) if edge else np.array([])
    meshes = []
    longest = int(np.argmax(half))
    for axis in range(3):
        i, j = [a for a in range(3) if a != axis]
        lines = [np.concatenate([-half[a] + np.concatenate([[0], bend]), half[a] - np.concatenate([[0], bend])[::-1]])
                 for a in (i, j)]
        for sign in (-1, 1):
            p = np.empty((len(lines[1]), len(lines[0]), 3))
            p[..., i], p[..., j] = np.meshgrid(lines[0], lines[1])
            p[..., axis] = sign * half[axis]
            inner = np.clip(p, edge - half, half - edge)
            normals = p - inner if edge else np.broadcast_to(sign * np.eye(3)[axis], p.shape)
            normals = normals / np.linalg.norm(normals, axis=-1, keepdims=True)
            u, v = (j, i) if j == longest else (i, j)
            uvs = np.stack([p[..., u], p[..., v]], axis=-1) + 0.37 * axis + np.asarray(centre)[[u, v]]
            points, n, t, triangles = grid_mesh(inner + edge * normals, normals, uvs)
            # The order of axes 0, 1, 2 without one of them turns the face round for axis 1.
            meshes.append((points, n, t, triangles if (sign > 0) == (axis != 1) else triangles[:, ::-1]))
    return placed(joined(*meshes), centre)


def tube(path, radii, sides=10, closed=False):
    """A tube about points (n, 3) with radii (n), with frames that do not twist."""
    path = np.asarray(path, float)
    radii = np.broadcast_to(radii, len(path))
    along = np.gradient(path, axis=0)
    if closed:
        along[0] = along[-1] = path[1] - path[-2]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    normal = np.cross(along[0], [0.31, 0.52, 0.8])
    frames = []
    for direction in along:
        normal = normal - direction * (normal @ direction)
        normal /= np.linalg.norm(normal)
        frames.append((normal, np.cross(direction, normal)))
    angle = 2 * np.pi * np.arange(sides + 1) / sides
    n = np.stack([np.cos(angle)[:, None] * a + np.sin(angle)[:, None] * b for a, b in frames])
    points = path[:, None] + radii[:, None, None] * n
    uvs = np.stack(np.meshgrid(angle / (2 * np.pi), np.linspace(0, 1, len(path))), axis=-1)
    mesh = grid_mesh(points, n, uvs)
    if closed:
        return mesh
    caps = []
    for end, sign in ((0, -1), (-1, 1)):
        ring, centre = points[end], path[end]
        cap = np.stack([np.broadcast_to(centre, ring.shape), ring])
        caps.append(grid_mesh(cap if sign < 0 else cap[::-1], np.broadcast_to(sign * along[end], cap.shape),
                              np.stack(np.meshgrid(angle, [0, 1]), axis=-1)))
    return joined(mesh, *caps)


def ball(radius, centre=(0, 0, 0), segments=32):
    theta = np.linspace(-np.pi / 2, np.pi / 2, segments // 2 + 1)
    curve = np.stack([radius * np.cos(theta), radius * np.sin(theta)], axis=-1)
    return placed(lathe([curve], segments, 1), centre)


def leaf(length, width, rise, droop, steps=12):
    """A leaf along x that rises and droops, bent like a gutter."""
    t = np.linspace(0, 1, steps)
    across = np.linspace(-1, 1, 7)
    wide = width * np.sin(np.pi * np.clip(0.04 + 0.96 * t, 0, 1)) ** 0.7 * (1 - 0.35 * t)
    x = length * (t - 0.18 * t ** 2)
    z = rise * t - droop * t ** 2.2
    points = np.stack([x + 0 * across[:, None], across[:, None] * wide, z + 0.25 * across[:, None] ** 2 * wide], axis=-1)
    uvs = np.stack([t + 0 * across[:, None], 0.5 + 0.5 * across[:, None] + 0 * t], axis=-1)
    return surface(points, uvs)


def shortened(values, bits):
    """32-bit floats with so many bits of their significands, for files that compress."""
    raw = np.ascontiguousarray(values, '<f4').view('<u4').astype(np.uint64)
    drop = 23 - bits
    raw = (raw + (1 << (drop - 1))) & ~np.uint64((1 << drop) - 1)
    return raw.astype('<u4').view('<f4')
