#!/usr/bin/env python3
"""Writes a large triangle mesh: a bumpy torus that covers a grid of rows × columns of vertices.

    make_big_mesh.py FILE.(ply|obj|serialized) [--triangles 2000000] [--no-normals]

The torus is closed, so there are half as many vertices as triangles. PLY files are binary (little endian)
with float positions, normals unless --no-normals, and int indices; .serialized files are of version 4,
compressed at zlib's lowest level. The mesh is the same at each call. Needs numpy.
"""
import argparse
import struct
import zlib
from pathlib import Path

import numpy as np


def torus(triangles):
    """Positions, normals (float32, n × 3) and triangles (int32, m × 3) with m close to `triangles`."""
    rows = max(3, round((triangles / 8) ** 0.5))
    columns = max(3, round(triangles / (2 * rows)))
    phi = np.arange(rows)[:, None] * (2 * np.pi / rows)
    theta = np.arange(columns)[None, :] * (2 * np.pi / columns)

    # Radius of the tube, with bumps, and its derivatives.
    r = 0.3 + 0.02 * np.sin(15 * phi) * np.sin(40 * theta)
    r_phi = 0.3 * np.cos(15 * phi) * np.sin(40 * theta)
    r_theta = 0.8 * np.sin(15 * phi) * np.cos(40 * theta)

    def around(x, y, z):  # turns (x, y, z) about the z axis by theta
        return np.stack(np.broadcast_arrays(x * np.cos(theta) - y * np.sin(theta),
                                            x * np.sin(theta) + y * np.cos(theta), z), -1)

    ring = 1 + r * np.cos(phi)
    p = around(ring, 0, r * np.sin(phi))
    p_phi = around(r_phi * np.cos(phi) - r * np.sin(phi), 0, r_phi * np.sin(phi) + r * np.cos(phi))
    p_theta = around(r_theta * np.cos(phi), ring, r_theta * np.sin(phi))
    n = np.cross(p_theta, p_phi)
    n /= np.linalg.norm(n, axis=-1, keepdims=True)

    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing='ij')
    a, b = i * columns + j, i * columns + (j + 1) % columns
    c, d = (i + 1) % rows * columns + (j + 1) % columns, (i + 1) % rows * columns + j
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], 2)
    return (p.reshape(-1, 3).astype('<f4'), n.reshape(-1, 3).astype('<f4'),
            faces.reshape(-1, 3).astype('<i4'))


def write_ply(path, p, n, faces, uv=None):
    """Normals `n` and texture coordinates `uv`, n × 2, may be None."""
    names = ['x', 'y', 'z'] + (['nx', 'ny', 'nz'] if n is not None else []) + (['u', 'v'] if uv is not None else [])
    header = ['ply', 'format binary_little_endian 1.0', f'element vertex {len(p)}',
              *(f'property float {name}' for name in names), f'element face {len(faces)}',
              'property list uchar int vertex_indices', 'end_header', '']
    rows = np.empty(len(faces), [('count', 'u1'), ('v', '<i4', 3)])
    rows['count'], rows['v'] = 3, faces
    with open(path, 'wb') as file:
        file.write('\n'.join(header).encode())
        file.write(np.hstack([a for a in (p, n, uv) if a is not None]).tobytes())
        file.write(rows.tobytes())


def write_obj(path, p, n, faces):
    with open(path, 'w') as file:
        file.writelines('v %.7g %.7g %.7g\n' % tuple(row) for row in p.tolist())
        if n is None:
            file.writelines('f %d %d %d\n' % tuple(row) for row in (faces + 1).tolist())
        else:
            file.writelines('vn %.4f %.4f %.4f\n' % tuple(row) for row in n.tolist())
            file.writelines('f %d//%d %d//%d %d//%d\n' % (a, a, b, b, c, c)
                            for a, b, c in (faces + 1).tolist())


def write_serialized(path, p, n, faces):
    flags = 0x1000 | (0 if n is None else 1)
    data = struct.pack('<I', flags) + b'torus\0' + struct.pack('<QQ', len(p), len(faces))
    data += p.tobytes() + (b'' if n is None else n.tobytes()) + faces.tobytes()
    mesh = struct.pack('<HH', 0x041c, 4) + zlib.compress(data, 1)
    with open(path, 'wb') as file:
        file.write(mesh + struct.pack('<QI', 0, 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('file', type=Path)
    parser.add_argument('--triangles', type=int, default=2000000)
    parser.add_argument('--no-normals', action='store_true')
    arguments = parser.parse_args()
    writers = {'.ply': write_ply, '.obj': write_obj, '.serialized': write_serialized}
    if arguments.file.suffix not in writers:
        parser.error('the file must end in .ply, .obj or .serialized')
    p, n, faces = torus(arguments.triangles)
    writers[arguments.file.suffix](arguments.file, p, None if arguments.no_normals else n, faces)
    print(f'{arguments.file}: {len(p)} vertices, {len(faces)} triangles')


if __name__ == '__main__':
    main()
