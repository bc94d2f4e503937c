#!/usr/bin/env python3
"""Makes the images and meshes that the scenes under scenes/ use, from formulas.

    make_assets.py [SCENES_DIR]

Everything is deterministic and made here, so the assets carry no licence but the project's. Needs
numpy, and mitsuba for the one EXR file.
"""
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

SCENES = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / 'scenes'


def write_png(path, image):
    """Writes an array (height, width[, 3 or 4]) of bytes."""
    image = np.asarray(image, np.uint8)
    height, width = image.shape[:2]
    colour = {2: 0, 3: {3: 2, 4: 6}.get(image.shape[-1], 0)}[image.ndim]
    rows = b''.join(b'\0' + row.tobytes() for row in image)

    def chunk(tag, data):
        body = tag + data
        return struct.pack('>I', len(data)) + body + struct.pack('>I', zlib.crc32(body))

    path.write_bytes(b'\x89PNG\r\n\x1a\n' +
                     chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, colour, 0, 0, 0)) +
                     chunk(b'IDAT', zlib.compress(rows, 9)) + chunk(b'IEND', b''))


def to_bytes(values):
    return np.clip(np.round(255 * np.asarray(values)), 0, 255)


def grid(width, height):
    """Coordinates of texel centres in [0, 1), from the top left."""
    return np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)


def colour_texture():
    """Rings, bands and a bright corner: no symmetry, so that flips show."""
    u, v = grid(64, 48)
    rings = 0.5 + 0.5 * np.sin(40 * np.hypot(u - 0.3, v - 0.4))
    bands = (np.floor(6 * u + 3 * v) % 2)
    corner = np.exp(-8 * (u ** 2 + v ** 2))
    return to_bytes(np.stack([0.15 + 0.7 * rings * (1 - 0.5 * v), 0.2 + 0.5 * bands * u + 0.3 * corner,
                              0.1 + 0.8 * v * (1 - rings * 0.6)], axis=-1))


def height_field():
    u, v = grid(64, 64)
    tau = 2 * np.pi
    return 0.5 + 0.2 * np.sin(3 * tau * u) * np.cos(2 * tau * v) + 0.2 * np.cos(tau * (u + 2 * v))


def write_volume(path, values):
    """Writes an array (z, y, x[, channels]) as 32-bit numbers in a box of its own."""
    values = np.asarray(values, np.float32)
    depth, height, width = values.shape[:3]
    channels = values.shape[3] if values.ndim == 4 else 1
    path.write_bytes(b'VOL\3' + struct.pack('<5i6f', 1, width, height, depth, channels, -0.5, -0.5, -0.5, 0.5, 0.5, 0.5) +
                     values.tobytes())


def space(width, height, depth):
    """Coordinates of nodes in [0, 1) as arrays (z, y, x)."""
    z, y, x = np.meshgrid((np.arange(depth) + 0.5) / depth, (np.arange(height) + 0.5) / height,
                          (np.arange(width) + 0.5) / width, indexing='ij')
    return x, y, z


def smoke_volume():
    """Swirls in a ball, and nothing in the corners."""
    x, y, z = space(20, 24, 16)
    r = np.sqrt((x - 0.5) ** 2 + (y - 0.5) ** 2 + (z - 0.5) ** 2)
    swirl = 0.6 + 0.4 * np.sin(14 * x + 9 * y * y) * np.cos(11 * z + 5 * x)
    return np.maximum(0, 1 - 2 * r) * swirl


def colour_volume():
    """Each channel grows along an axis of its own."""
    x, y, z = space(6, 5, 4)
    return np.stack([0.2 + 0.75 * x, 0.2 + 0.75 * y, 0.9 - 0.6 * z], axis=-1)


def flake_volume():
    """Balls that grow along the x axis. Mitsuba 3.9.1 samples no other shape of flakes as it evaluates it."""
    x, _, _ = space(8, 1, 1)
    area = (0.2 + 0.7 * x) ** 2
    return np.stack([area, area, area, 0 * x, 0 * x, 0 * x], axis=-1)


def bump_texture():
    return to_bytes(height_field())


def normal_texture():
    h = height_field()
    du = (np.roll(h, -1, 1) - np.roll(h, 1, 1)) * 32 * 0.06
    dv = (np.roll(h, -1, 0) - np.roll(h, 1, 0)) * 32 * 0.06
    n = np.stack([-du, dv, np.ones_like(h)], axis=-1)
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    return to_bytes(0.5 * n + 0.5)


def mask_texture():
    u, v = grid(32, 32)
    return to_bytes(np.hypot((4 * u) % 1 - 0.5, (4 * v) % 1 - 0.5) < 0.35)


def sky():
    """A bright spot, a gradient and a dark ground as (32, 64, 3) floats."""
    u, v = grid(64, 32)
    phi, theta = 2 * np.pi * u, np.pi * v
    d = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi)], axis=-1)
    sun = np.array([0.5, 0.6, -0.62])
    glow = np.exp(40 * (d @ (sun / np.linalg.norm(sun)) - 1))
    above = np.clip(d[..., 1:2], 0, 1)
    base = np.where(d[..., 1:2] > 0, np.array([0.5, 0.7, 1.0]) * (0.3 + 0.5 * above),
                    np.array([0.15, 0.1, 0.07]))
    return (base + glow[..., None] * np.array([30.0, 25.0, 18.0])).astype(np.float32)


def lumpy_sphere(n):
    """Vertices and triangles of a sphere with lumps: n × 2n quads, poles shared."""
    theta, phi = np.pi * np.arange(n + 1) / n, 2 * np.pi * np.arange(2 * n) / (2 * n)
    t, p = np.meshgrid(theta, phi, indexing='ij')
    direction = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)
    lumps = (np.sin(9 * direction[..., 0]) * np.sin(8 * direction[..., 1] + 1) +
             0.5 * np.sin(17 * direction[..., 2] + 3 * direction[..., 0]))
    points = (direction * (1 + 0.08 * lumps)[..., None]).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(n), np.arange(2 * n), indexing='ij')
    a, b = i * 2 * n + j, i * 2 * n + (j + 1) % (2 * n)
    c, d = a + 2 * n, b + 2 * n
    upper = np.stack([a, c, b], axis=-1)[1:].reshape(-1, 3)   # the first ring has no upper triangles
    lower = np.stack([b, c, d], axis=-1)[:-1].reshape(-1, 3)
    triangles = np.concatenate([upper, lower])
    # The rings at the poles are single points.
    triangles[triangles < 2 * n] = 0
    triangles[triangles >= n * 2 * n] = n * 2 * n
    used = np.unique(triangles)
    remap = np.zeros(len(points), np.int64)
    remap[used] = np.arange(len(used))
    return points[used].astype('<f4'), remap[triangles].astype('<u4')


def write_serialized(path, *meshes):
    """Mitsuba's .serialized format, version 4: meshes as (name, points, normals or None, texture
    coordinates or None, triangles)."""
    content, offsets = b'', []
    for name, points, normals, uvs, triangles in meshes:
        flags = 0x1000 | (normals is not None) | 2 * (uvs is not None)  # single precision
        body = struct.pack('<I', flags) + name.encode() + b'\0' + struct.pack('<QQ', len(points), len(triangles))
        body += b''.join(np.asarray(a, '<f4').tobytes() for a in (points, normals, uvs) if a is not None)
        offsets.append(len(content))
        content += struct.pack('<HH', 0x041C, 4) + zlib.compress(body + np.asarray(triangles, '<u4').tobytes(), 9)
    path.write_bytes(content + struct.pack(f'<{len(offsets)}QI', *offsets, len(offsets)))


def strips():
    """The same bent strip without and with normals."""
    points = [(-1, -1, 0), (0, -1, .5), (1, -1, 0), (-1, 1, .1), (0, 1, .6), (1, 1, .2)]
    normals = [(-.4, -.2, .9), (0, -.3, .95), (.5, -.1, .85), (-.4, .2, .9), (0, .2, .98), (.4, .3, .86)]
    uvs = [(0, 0), (.5, .1), (1, 0), (0, 1), (.4, .9), (1, 1)]
    triangles = [(0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4)]
    return ('strip', points, None, uvs, triangles), ('smooth', points, normals, uvs, triangles)


def write_attribute_ply(path):
    """A disc of triangles with a colour per vertex and another per face, as ASCII PLY."""
    n = 24
    angle = 2 * np.pi * np.arange(n) / n
    rim = np.stack([np.cos(angle), np.sin(angle), np.zeros(n)], axis=-1)
    points = np.vstack([[0, 0, 0], rim])
    colours = np.vstack([[0.9, 0.9, 0.9], 0.5 + 0.4 * np.stack(
        [np.cos(angle), np.cos(angle - 2.1), np.cos(angle + 2.1)], axis=-1)])
    lines = ['ply', 'format ascii 1.0', f'element vertex {n + 1}']
    lines += [f'property float {name}' for name in ('x', 'y', 'z', 'r', 'g', 'b')]
    lines += [f'element face {n}', 'property list uchar int vertex_indices',
              'property float tint_r', 'property float tint_g', 'property float tint_b', 'end_header']
    lines += [' '.join(f'{x:.6g}' for x in [*p, *c]) for p, c in zip(points, colours)]
    lines += [f'3 0 {i + 1} {(i + 1) % n + 1} {0.2 + 0.3 * (i % 3):.3g} 0.5 {0.9 - 0.1 * (i % 5):.3g}'
              for i in range(n)]
    path.write_text('\n'.join(lines) + '\n')


def knot_distances():
    """Roughly the distances to a trefoil knot in the unit cube, negative inside."""
    z, y, x = np.meshgrid(*[np.linspace(0, 1, 20)] * 3, indexing='ij')
    t = np.linspace(0, 2 * np.pi, 600, endpoint=False)
    curve = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=-1)
    curve = 0.5 + curve * [0.125, 0.125, 0.25]
    nodes = np.stack([x, y, z], axis=-1)[..., None, :]
    return np.sqrt(((nodes - curve) ** 2).sum(axis=-1)).min(axis=-1) - 0.1


def write_curves(path, curves):
    """Curves as arrays of positions and radii."""
    path.write_text('\n'.join('\n'.join(' '.join(f'{x:.5g}' for x in point) for point in curve) + '\n'
                              for curve in curves))


def cables():
    """A few thick curves that bend and taper."""
    t = np.linspace(0, 1, 9)
    return [np.stack([-1 + 2 * t, 0.5 * np.sin(5 * t + k), 0.35 + 0.25 * np.cos(4 * t + 2 * k) + 0.3 * k,
                      0.1 + 0.06 * np.cos(9 * t + k)], axis=-1) for k in range(3)]


def fur(count=400, points=6):
    """Hairs on a unit ball that hang down and curl."""
    random = np.random.default_rng(7)
    curves = []
    for _ in range(count):
        z, phi = random.uniform(-0.2, 1), random.uniform(0, 2 * np.pi)
        n = np.array([np.sqrt(1 - z * z) * np.cos(phi), np.sqrt(1 - z * z) * np.sin(phi), z])
        side = np.cross(n, [0.3, 0.2, 1])
        s = np.linspace(-0.05, 1, points)[:, None]
        p = n * (1 + 0.4 * s) + s ** 2 * np.array([0, 0, -0.45]) + 0.12 * s * side * np.sin(5 * s + phi)
        curves.append(np.hstack([p, 0.02 * (1.1 - 0.8 * s)]))
    return curves


def write_ellipsoids(path):
    """Four ellipsoids as Mitsuba 3 reads them: radii as logarithms, the real part of rotations first."""
    names = ['x', 'y', 'z', 'nx', 'ny', 'nz', 'opacity', 'scale_0', 'scale_1', 'scale_2',
             'rot_0', 'rot_1', 'rot_2', 'rot_3']
    rows = [[-0.8, -0.9, 0.25, 0, 0, 1, 1, -3, -2.2, -2.5, 1, 0.2, 0.1, -0.3],
            [-0.3, -1.1, 0.2, 0, 0, 1, 1, -2.4, -3.2, -3, 0.5, -0.6, 0.2, 0.1],
            [0.3, -1.0, 0.25, 0, 0, 1, 1, -2.6, -2.6, -2.6, 1, 0, 0, 0],
            [0.85, -0.8, 0.3, 0, 0, 1, 1, -3.5, -2.5, -2, 0.3, 0.9, 0.4, 0.2]]
    lines = ['ply', 'format ascii 1.0', f'element vertex {len(rows)}']
    lines += [f'property float {name}' for name in names] + ['end_header']
    lines += [' '.join(f'{x:g}' for x in row) for row in rows]
    path.write_text('\n'.join(lines) + '\n')


def write_tensors(path, fields):
    """The file format of the RGL material database."""
    types = {'uint8': 1, 'float32': 10}
    header = b'tensor_file\0\1\0' + struct.pack('<I', len(fields))
    offset = len(header) + sum(13 + len(name) + 8 * a.ndim for name, a in fields.items())
    data = b''
    for name, a in fields.items():
        header += struct.pack('<H', len(name)) + name.encode() + struct.pack(
            f'<HBQ{a.ndim}Q', a.ndim, types[str(a.dtype)], offset + len(data), *a.shape)
        data += a.tobytes()
    path.write_bytes(header + data)


def measured_material(anisotropic):
    """A glossy material in the form of measurements; its numbers are made up, not measured."""
    n, theta = 9, np.linspace(0, 1.5, 5)
    phi = np.linspace(-np.pi, 0, 5) if anisotropic else np.zeros(1)
    y, x = np.meshgrid(*[np.linspace(0, 1, n)] * 2, indexing='ij')
    p, t = phi[:, None, None, None], theta[None, :, None, None]
    turned = np.cos(2 * np.pi * y - (2 * p if anisotropic else 0))
    lobe = np.exp(-(5 + 2 * turned * anisotropic) * x ** 2) + 0.03
    vndf = lobe * (1 + 0.4 * np.sin(t) * turned * x)
    luminance = 1 + 0.5 * np.sin(t) * (x - 0.5) * turned
    colour = np.array([0.9, 0.6, 0.3])[:, None, None]
    rgb = (0.25 + 0.5 * x) * colour * np.ones((len(phi), len(theta), 1, 1, 1)) * (1 + 0.3 * np.sin(t))[:, :, None]
    single = lambda a: np.ascontiguousarray(a, np.float32)
    return {'description': np.frombuffer(b'made up', np.uint8), 'theta_i': single(theta), 'phi_i': single(phi),
            'ndf': single(2 * np.exp(-6 * x ** 2) + 0.05 + 0 * y), 'sigma': single(0.9 - 0.5 * x ** 2 + 0 * y),
            'vndf': single(vndf), 'luminance': single(np.broadcast_to(luminance, vndf.shape)), 'rgb': single(rgb),
            'jacobian': np.ones(1, np.uint8)}


def main():
    write_curves(SCENES / 'curves' / 'cables.txt', cables())
    write_ellipsoids(SCENES / 'curves' / 'ellipsoids.ply')
    write_curves(SCENES / 'bsdf-fibres' / 'fur.txt', fur())
    write_tensors(SCENES / 'bsdf-measured' / 'isotropic.bsdf', measured_material(False))
    write_tensors(SCENES / 'bsdf-measured' / 'anisotropic.bsdf', measured_material(True))

    for scene in ('textures', 'two-versions', 'lights-area', 'lights-delta', 'lights-placed', 'bsdf-wrappers',
                  'bsdf-plastics'):
        write_png(SCENES / scene / 'colours.png', colour_texture())
    for scene in ('bsdf-wrappers',):
        write_png(SCENES / scene / 'bumps.png', bump_texture())
        write_png(SCENES / scene / 'normals.png', normal_texture())
        write_png(SCENES / scene / 'holes.png', mask_texture())
    write_png(SCENES / 'texture-slots' / 'patches.png', colour_texture()[3::6, 4::8])
    write_attribute_ply(SCENES / 'textures' / 'attributes.ply')
    points, triangles = lumpy_sphere(120)
    write_serialized(SCENES / 'mesh-lumpy' / 'lumpy.serialized', ('lumpy sphere', points, None, None, triangles))
    write_serialized(SCENES / 'shapes-files' / 'meshes' / 'strips.serialized', *strips())

    folder = SCENES / 'media-heterogeneous'
    write_volume(folder / 'smoke.vol', smoke_volume())
    write_volume(folder / 'colours.vol', colour_volume())
    for scene in ('media-boundaries', 'texture-slots'):
        write_volume(SCENES / scene / 'patches.vol', colour_volume())
    folder = SCENES / 'media-phase'
    write_volume(folder / 'weight.vol', colour_volume()[..., 0])
    write_volume(folder / 'flakes.vol', flake_volume())
    write_volume(folder / 'ones.vol', np.ones((2, 2, 2)))

    write_volume(SCENES / 'sdf-grid' / 'knot.vol', knot_distances())

    import mitsuba as mi
    mi.set_variant('scalar_rgb')
    for scene in ('environment-map', 'bsdf-dielectrics', 'bsdf-conductors'):
        bitmap = mi.Bitmap(sky()).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float16, False)
        bitmap.write(str(SCENES / scene / 'sky.exr'))


if __name__ == '__main__':
    main()
