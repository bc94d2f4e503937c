#!/usr/bin/env python3
"""Writes two interiors of more than 200,000 triangles, for comparisons of speed: FOLDER/hall and FOLDER/shelves.

    interiors.py FOLDER

Both have bitmaps, rough plastic and rough conductors, and are files of Mitsuba 3, the same at each call. `hall`: two
large sculptures and a curtain under lamps in the ceiling; `shelves`: sixty small bodies on boards, lit by a window and
a lamp. Needs numpy.
"""
import argparse
import random
from pathlib import Path

import numpy as np

from make_big_mesh import torus, write_ply
from memory import write_png

HEAD = """<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="{depth}"/></integrator>
<sensor type="perspective"><float name="fov" value="{fov}"/>
<transform name="to_world"><lookat origin="{origin}" target="{target}" up="0,0,1"/></transform>
<sampler type="independent"><integer name="sample_count" value="64"/></sampler>
<film type="hdrfilm"><integer name="width" value="320"/><integer name="height" value="240"/>
<rfilter type="box"/></film></sensor>
"""


def bitmap(name, file, repeat=1):
    return (f'<texture type="bitmap" name="{name}"><string name="filename" value="{file}"/>'
            f'<transform name="to_uv"><scale x="{repeat}" y="{repeat}"/></transform></texture>')


def rgb(name, red, green, blue):
    return f'<rgb name="{name}" value="{red:.3f},{green:.3f},{blue:.3f}"/>'


def diffuse(reflectance):
    return f'<bsdf type="twosided"><bsdf type="diffuse">{reflectance}</bsdf></bsdf>'


def plastic(reflectance, alpha):
    return (f'<bsdf type="roughplastic"><float name="alpha" value="{alpha:.3f}"/>'
            f'{reflectance.replace("reflectance", "diffuse_reflectance", 1)}</bsdf>')


def metal(material, alpha):
    return (f'<bsdf type="roughconductor"><string name="material" value="{material}"/>'
            f'<float name="alpha" value="{alpha:.3f}"/></bsdf>')


def placed(kind, inner, *steps):
    return f'<shape type="{kind}">{inner}<transform name="to_world">{"".join(steps)}</transform></shape>'


def scale(x, y=None, z=None):
    return f'<scale x="{x}" y="{x if y is None else y}" z="{x if z is None else z}"/>'


def rotate(axis, angle):
    return f'<rotate {axis}="1" angle="{angle:.3f}"/>'


def move(x, y, z):
    return f'<translate x="{x}" y="{y}" z="{z}"/>'


def room(walls, floor, width, depth, height):
    """From −width/2 to width/2 along x, 0 to depth along y, on z = 0; open where the camera stands."""
    half = width / 2
    return [placed("rectangle", floor, scale(half, depth / 2), move(0, depth / 2, 0)),
            placed("rectangle", walls, scale(half, depth / 2), rotate("x", 180), move(0, depth / 2, height)),
            placed("rectangle", walls, scale(half, height / 2), rotate("x", 90), move(0, depth, height / 2)),
            placed("rectangle", walls, scale(height / 2, depth / 2), rotate("y", 90), move(-half, depth / 2, height / 2)),
            placed("rectangle", walls, scale(height / 2, depth / 2), rotate("y", -90), move(half, depth / 2, height / 2))]


def lamp(width, depth, radiance, *steps):
    return placed("rectangle", f'<emitter type="area">{rgb("radiance", *radiance)}</emitter>', scale(width, depth), *steps)


def write_images(folder):
    """Planks with grain, and a pattern of tiles: 1,024² bytes of RGB each."""
    numbers = np.random.default_rng(3)
    y, x = np.mgrid[0:1024, 0:1024]
    grain = np.sin(x / 3 + 6 * np.sin(y / 90) + 4 * numbers.random(8)[y // 128]) * 18 + numbers.normal(0, 5, (1024, 1024))
    planks = np.array([128, 84, 50]) + grain[..., None] - 40.0 * (y % 128 < 3)[..., None]
    tiles = 190 + 25.0 * numbers.random((8, 8, 3))[y // 128, x // 128] - 90.0 * ((x % 128 < 4) | (y % 128 < 4))[..., None]
    for name, image in (("planks.png", planks), ("tiles.png", tiles)):
        write_png(folder / name, np.clip(image, 0, 255).astype(np.uint8))


def write_curtain(path):
    """A sheet in folds on the unit square of x and z, 60,000 triangles."""
    columns, rows = 300, 100
    u, v = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    p = np.stack([u, 0.04 * np.sin(40 * u) * (1 - 0.4 * v), v], -1).reshape(-1, 3).astype("<f4")
    i = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    faces = np.concatenate([np.stack([i, i + 1, i + columns + 2], -1), np.stack([i, i + columns + 2, i + columns + 1], -1)])
    write_ply(path, p, None, faces.astype("<i4"), np.stack([u, v], -1).reshape(-1, 2).astype("<f4"))


def ply(file, bsdf, *steps):
    return placed("ply", f'<string name="filename" value="{file}"/>{bsdf}', *steps)


def hall(folder):
    write_curtain(folder / "curtain.ply")
    write_ply(folder / "sculpture.ply", *torus(80_000))
    shapes = room(diffuse(rgb("reflectance", 0.75, 0.72, 0.66)), plastic(bitmap("reflectance", "planks.png", 3), 0.15), 8, 9, 4)
    shapes += [
        ply("sculpture.ply", metal("Cu", 0.15), rotate("x", 70), move(-1.6, 5, 1.3)),
        ply("sculpture.ply", plastic(rgb("reflectance", 0.1, 0.25, 0.5), 0.1), rotate("y", 60), move(1.9, 6.2, 1.3)),
        ply("curtain.ply", diffuse(bitmap("reflectance", "tiles.png", 4)), scale(5, 1, 3.4), move(-2.5, 8.7, 0.1)),
    ] + [lamp(0.4, 0.4, (9, 8, 7), rotate("x", 180), move(x, y, 3.99)) for x in (-2, 2) for y in (2, 5, 8)]
    (folder / "scene.xml").write_text(
        HEAD.format(depth=8, fov=55, origin="0,0.3,1.8", target="0,6,1.2") + "\n".join(shapes) + "\n</scene>\n")


def shelves(folder):
    numbers = random.Random(5)
    write_ply(folder / "body.ply", *torus(4000))
    board = plastic(bitmap("reflectance", "planks.png"), 0.2)
    shapes = room(diffuse(bitmap("reflectance", "tiles.png", 2)), diffuse(rgb("reflectance", 0.4, 0.35, 0.3)), 5, 4, 3)
    for row in range(5):
        z = 0.3 + 0.5 * row
        shapes.append(placed("cube", board, scale(2.2, 0.3, 0.02), move(0, 3.5, z)))
        for column in range(12):
            alpha = 0.05 + 0.3 * numbers.random()
            colour = rgb("reflectance", *(0.1 + 0.7 * numbers.random() for _ in range(3)))
            bsdf = numbers.choice([metal("Au", alpha), metal("Ag", alpha), plastic(colour, alpha), diffuse(colour)])
            shapes.append(ply("body.ply", bsdf, scale(0.13), rotate("x", 180 * numbers.random()),
                              rotate("z", 360 * numbers.random()), move(-2 + 0.36 * column, 3.45, z + 0.19)))
    shapes += [lamp(0.6, 0.8, (6, 7, 9), rotate("y", 90), move(-2.49, 1.5, 1.7)),
               lamp(0.25, 0.25, (14, 11, 7), rotate("x", 180), move(0.8, 1.8, 2.98))]
    (folder / "scene.xml").write_text(
        HEAD.format(depth=8, fov=60, origin="0.6,0.2,1.6", target="0,3.4,1.3") + "\n".join(shapes) + "\n</scene>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    for make in (hall, shelves):
        scene = folder / make.__name__
        scene.mkdir(parents=True, exist_ok=True)
        write_images(scene)
        make(scene)
        print(scene / "scene.xml")


if __name__ == "__main__":
    main()
